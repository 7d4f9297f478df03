//! `SetDataVal` and `SetAllDataVal`, which write data by their names or types.

use super::resolved::{Entity, Resolved};
use super::syntax::{Argument, Base, Datum, Expression, Part, Storage, Type, indices};
use super::translate::Translator;
use crate::program::names::{Context, Symbol};
use crate::program::script::{Expr, How, Written};

impl Translator<'_> {
    /// Writes the data that are meant.
    pub(super) fn writes_named(&mut self, arguments: Part) {
        let resolved = self.resolved;
        for datum in resolved.moves_set_by_name(arguments, self.context, self.here.file) {
            if resolved.datum(datum).kind == Type::Loaddata {
                continue;
            }
            let variable = match self.held_by(datum) {
                Expr::Variable(variable) => Written::One(variable),
                Expr::Any { .. } => Written::AnyOf(self.table(Entity::Declared(datum))),
                _ => continue,
            };
            let how = How::PartSomehow(self.changed());
            self.emit_write(self.here, variable, how);
        }
    }
}

impl Resolved<'_> {
    /// The data of modules that may be written and that moves depend on.
    pub(super) fn moves_set_by_name(
        &self,
        arguments: Part,
        context: Context,
        file: u32,
    ) -> Vec<u32> {
        let mut meant = self.set_by_name(arguments, context, file);
        meant.retain(|datum| {
            let datum = self.datum(*datum);
            datum.kind.is_of_moves() && datum.context.routine.is_none()
        });
        meant
    }

    /// The data that may be written: of the name or the type that the first argument says, of any
    /// where only the running program knows that, and of the type of the value that is written.
    pub(super) fn set_by_name(&self, arguments: Part, context: Context, file: u32) -> Vec<u32> {
        let all = self.parsed.arguments[indices(arguments)].iter();
        let mut positional = all.filter(|of| of.option.is_none());
        let text = match positional.next().map(|of| of.expression) {
            Some(Expression::Text(start, end)) => {
                let bytes = &self.sources[file as usize].bytes;
                Some(bytes[indices((start, end))].to_ascii_lowercase())
            }
            _ => None,
        };
        let value = positional.next();
        let is_meant = |datum: &Datum| {
            let is_named = text.as_deref().is_none_or(|text| match Type::named(text) {
                // the name of data, or of a type that moves do not depend on
                Type::Other => {
                    datum.kind == Type::Other
                        || (self.spelling(datum.name).as_bytes()).eq_ignore_ascii_case(text)
                }
                kind => kind == datum.kind,
            });
            is_named
                && datum.storage != Storage::Constant
                && value.is_none_or(|value| self.may_give(value, datum.kind, context))
        };
        let data = (0..).zip(&self.parsed.data);
        let meant = data.filter(|(_, datum)| is_meant(datum));
        meant.map(|(at, _)| at).collect()
    }

    /// Whether an argument may give a value of a type: any where the files do not tell.
    fn may_give(&self, argument: &Argument, wanted: Type, context: Context) -> bool {
        let kind = |name: Symbol| {
            let is = |word: &str| self.spelling(name).eq_ignore_ascii_case(word);
            let kind = self.kind(name, context);
            kind.or_else(|| (is("true") || is("false")).then_some(Type::Other))
        };
        match argument.expression {
            Expression::Text(..) => wanted == Type::Other,
            Expression::Load(_) => wanted == Type::Loaddata,
            Expression::Point { base, steps } if steps.0 == steps.1 => match base {
                Base::Named { name, .. } => kind(name).is_none_or(|kind| kind == wanted),
                Base::Target(_) => true,
                Base::Function(function) => {
                    let name = self.parsed.functions[function as usize].name;
                    let routine = self.function_of(name, context);
                    let gives = |at: u32| self.parsed.routines[at as usize].gives;
                    routine.is_none_or(|at| gives(at) == wanted)
                }
            },
            Expression::Point { .. } => wanted == Type::Robtarget,
            Expression::Member { name, .. } => match kind(name) {
                Some(of) if of.is_target() || of == Type::Wobjdata => !wanted.is_of_moves(),
                Some(Type::Tooldata) => wanted == Type::Loaddata || !wanted.is_of_moves(),
                _ => true,
            },
            // what numbers come to is one
            Expression::Computed(_) => {
                let names = self.parsed.names_in(&argument.expression);
                let is_number = |&name: &Symbol| kind(name) == Some(Type::Num);
                wanted == Type::Num || !names.iter().all(is_number)
            }
            Expression::Nothing | Expression::Composed(_) | Expression::List(_) => true,
        }
    }
}
