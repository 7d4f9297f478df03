//! What branches ask of the parameters of routines: `IF n=2 THEN`, `TEST tool`. Where a call gives a
//! number, a constant, TRUE or FALSE, it runs the branch that it is given.

use super::reader::Reader;
use super::resolved::{Entity, Given, Resolved, named};
use super::syntax::{Argument, Part, Storage, Stored, Type, indices};
use super::translate::Translator;
use crate::program::contexts::Numbered;
use crate::program::kit::spread;
use crate::program::names::{Meaning, Symbol};
use crate::program::number;
use crate::program::numbers::{
    First, Literal, Question, cases, inside_brackets, names_asked, questions,
};
use crate::program::quantity::is_letter;
use crate::program::script::{Expr, Test, Tests, Variable, VariableId, Wanted};

/// The largest whole number that a num has with all its digits.
const MOST_WHOLE: u32 = 1 << 23;

/// What a condition asks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Asked {
    /// Whether an optional parameter is given: `Present(name)` (true) or `NOT Present(name)`.
    Presence(Symbol, bool),
    /// What parameters are: the bytes of the condition.
    Value(Part),
}

/// What stands in front of the word or sign that ends a condition; nothing where a comment stands in
/// it.
fn without_end(text: &[u8]) -> &[u8] {
    if text.contains(&b'!') {
        return b"";
    }
    let text = text.strip_suffix(b":").unwrap_or(text);
    let (rest, end) = text.split_at(text.len().saturating_sub(4));
    let is_word = rest.last().is_none_or(|b| !is_letter(*b));
    let is_end = is_word && end.eq_ignore_ascii_case(b"THEN");
    if is_end { rest } else { text }.trim_ascii()
}

impl Reader<'_> {
    /// What the condition of a word asks that has been read from there on.
    pub(super) fn value_asked(&mut self, word: &[u8], start: u32) -> Option<Asked> {
        let routine = self.context.routine?;
        let part = (start, self.behind.max(start));
        let text = without_end(&self.bytes[indices(part)]);
        let names = match word {
            b"case" => return Some(Asked::Value(part)),
            b"test" => vec![text],
            _ => names_asked(text),
        };
        let (first, end) = self.parsed.routines.get(routine as usize)?.parameters;
        let own = &self.parsed.data[indices((first, end))];
        let names = names
            .into_iter()
            .filter_map(|name| self.parsed.symbols.find(name));
        let of_parameters = names.filter(|name| own.iter().any(|datum| datum.name == *name));
        let of_parameters: Vec<Symbol> = of_parameters.collect();
        let asked = of_parameters.iter().map(|name| (routine, *name));
        self.parsed.values_asked.extend(asked);
        (!of_parameters.is_empty()).then_some(Asked::Value(part))
    }
}

impl Resolved<'_> {
    /// Parameters that are given to those that branches ask about are asked about, too.
    pub(super) fn find_asked(&mut self, calls: &[Given]) {
        if self.parsed.values_asked.is_empty() {
            return;
        }
        let mut pairs = Vec::new();
        for given in calls {
            let Some(caller) = given.context.routine else {
                continue;
            };
            let arguments = &self.list(given.of_function)[indices(given.arguments)];
            let callees = self.callees(given.callee, given.arguments, given.context, given.file);
            for &routine in &callees.routines {
                for (datum, argument) in self.parameters(routine, arguments) {
                    let name = argument.and_then(|of| named(&of.expression));
                    let parameter = (routine, self.datum(datum).name);
                    pairs.extend(name.map(|name| (parameter, (caller, name))));
                }
            }
        }
        spread(&mut self.parsed.values_asked, pairs);
    }

    fn condition_of(&self, file: u32, part: Part) -> &[u8] {
        without_end(&self.sources[file as usize].bytes[indices(part)])
    }

    /// Whether branches ask for what a parameter is, and nothing but calls gives it a value.
    fn is_value_asked(&self, parameter: u32) -> bool {
        let of = self.datum(parameter);
        let is_asked = |routine| self.parsed.values_asked.contains(&(routine, of.name));
        matches!(of.storage, Storage::Parameter { .. })
            && of.context.routine.is_some_and(is_asked)
            && !self.is_written(Entity::Declared(parameter))
            && (of.kind != Type::Num || self.is_only_given(self.number(parameter)))
    }
}

impl Translator<'_> {
    /// On what a condition depends.
    pub(super) fn tests_of(&mut self, asked: Option<Asked>) -> Tests {
        match asked {
            Some(Asked::Presence(name, wanted)) => {
                let routine = self.context.routine;
                let of = routine.and_then(|routine| self.presence(routine, name));
                of.map(|of| (of, Wanted::Flag(wanted))).into()
            }
            Some(Asked::Value(part)) => {
                let resolved = self.resolved;
                questions(
                    resolved.condition_of(self.here.file, part),
                    First::Comparisons,
                )
                .map(&mut |of| self.test(of.as_ref()?))
            }
            None => None.into(),
        }
    }

    fn test(&mut self, of: &Question) -> Option<Test> {
        let wanted = of.wanted(|text| self.literal(text))?;
        Some((self.asked_value(of.name)?, wanted))
    }

    /// About what a TEST asks.
    pub(super) fn tested(&mut self, asked: Asked) -> Option<VariableId> {
        match asked {
            Asked::Value(part) => {
                let resolved = self.resolved;
                self.asked_value(resolved.condition_of(self.here.file, part))
            }
            Asked::Presence(..) => None,
        }
    }

    /// The numbers of a CASE; none where it has another value.
    pub(super) fn cases(&self, asked: Asked) -> Vec<i64> {
        let Asked::Value(part) = asked else {
            return Vec::new();
        };
        let text = self.resolved.condition_of(self.here.file, part);
        cases(text, &mut |text| self.literal(text))
    }

    /// What a call gives a parameter about which branches ask, and its variable; `None` where the text
    /// does not tell.
    pub(super) fn choice_given(
        &mut self,
        parameter: u32,
        argument: Option<&Argument>,
    ) -> Option<(VariableId, Expr)> {
        let resolved = self.resolved;
        let argument = argument.filter(|_| resolved.is_value_asked(parameter))?;
        let file = self.here.file;
        let bytes = indices(resolved.value_bytes(file, argument));
        let text = inside_brackets(&resolved.sources[file as usize].bytes[bytes]);
        let value = match self.literal(text) {
            Some(literal) => self.builder.script.held(literal.held()),
            None => Expr::Variable(self.asked_value(text)?),
        };
        Some((self.choice(parameter), value))
    }

    /// The variable of a parameter of the present routine that branches ask about.
    fn asked_value(&mut self, name: &[u8]) -> Option<VariableId> {
        let resolved = self.resolved;
        let datum = self.named_here(name)?;
        let is_own = resolved.datum(datum).context.routine == self.context.routine;
        (is_own && resolved.is_value_asked(datum)).then(|| self.choice(datum))
    }

    /// The declaration that a name means; none where a loop counts with it, which hides others.
    fn named_here(&self, name: &[u8]) -> Option<u32> {
        let name = self.resolved.parsed.symbols.find(name)?;
        if self.resolved.parsed.counting(name, self.here).is_some() {
            return None;
        }
        match self.resolved.meaning(name, self.context) {
            Meaning::One(datum) => Some(datum),
            _ => None,
        }
    }

    fn choice(&mut self, parameter: u32) -> VariableId {
        if let Some(&known) = self.choices.get(&parameter) {
            return known;
        }
        let of = self.resolved.datum(parameter);
        let variable = self.builder.script.variable(Variable {
            routine: of.context.routine,
            ..Variable::new(self.resolved.spelling(of.name), of.place, Expr::Absent)
        });
        self.choices.insert(parameter, variable);
        variable
    }

    /// The value that a text is: TRUE, FALSE, a whole number or a constant that is one.
    fn literal(&self, text: &[u8]) -> Option<Literal> {
        let constant = || {
            let of = self.resolved.datum(self.named_here(text)?);
            match (of.storage, of.value) {
                (Storage::Constant, Stored::Number(value)) => Some(value),
                _ => None,
            }
        };
        let value = || number::parse(text).or_else(constant);
        Literal::flag(text).or_else(|| Literal::whole(value()?, MOST_WHOLE))
    }
}
