//! What the gripper carries (`GripLoad`): with the load of the tool it is one load.
//!
//! # Source
//! ABB, Technical reference manual RAPID Instructions, Functions and Data types, `loaddata` and
//! `GripLoad`: the centre of gravity of what the gripper carries counts in the tool's frame, that of
//! the tool's own load in the frame of the wrist.

use super::resolved::Entity;
use super::syntax::{Part, StatementKind, Stored, Type, Verb, indices};
use super::translate::Translator;
use crate::program::Load;
use crate::program::names::{Meaning, Symbol};
use crate::program::script::{Expr, Held, Place, Remark, Variable};

impl Translator<'_> {
    /// Where the program says what the gripper carries: that is empty until it does.
    pub(super) fn find_grips(&mut self) {
        let mut statements = self.resolved.parsed.statements.iter();
        if statements
            .any(|of| matches!(&of.kind, StatementKind::Call(call) if call.verb == Verb::GripLoad))
        {
            let holds = self.load_value(true, None);
            let variable = Variable {
                kept: true,
                ..Variable::new("GripLoad", Place::NOWHERE, holds)
            };
            self.gripped = Some(self.builder.script.variable(variable));
        }
    }

    /// What the gripper carries at this place.
    pub(super) fn gripped(&self) -> Expr {
        self.gripped.map_or(Expr::Absent, Expr::Variable)
    }

    /// A load of the flange as a value.
    pub(super) fn held_load(&mut self, load: Load) -> Expr {
        self.load_value(false, Some(load))
    }

    fn load_value(&mut self, is_carried: bool, load: Option<Load>) -> Expr {
        let numbers = load.map(|load| {
            let [x, y, z] = load.cog_m;
            [load.mass_kg, x, y, z].map(f64::to_bits)
        });
        let held = if is_carried {
            Held::Carried
        } else {
            Held::Load
        };
        let script = &mut self.builder.script;
        let value = self.loads.entry((is_carried, numbers));
        Expr::Value(*value.or_insert_with(|| script.value(held(load))))
    }

    /// `GripLoad`
    pub(super) fn grip_load(&mut self, arguments: Part) {
        let all = &self.resolved.parsed.arguments[indices(arguments)];
        let name = all.iter().find_map(super::moves::plain);
        let is_none = name.is_some_and(|name| self.weighs_nothing(name));
        let part = name.filter(|_| !is_none).and_then(|name| self.load(name));
        if !is_none && part.is_none() {
            self.other_load(name);
        }
        if let Some(variable) = self.gripped {
            let held = self.load_value(true, part);
            self.set(variable, held);
        }
    }

    /// `load0`, or data of the files that nothing writes and that have no mass.
    fn weighs_nothing(&self, name: Symbol) -> bool {
        if self.resolved.spelling(name).eq_ignore_ascii_case("load0") {
            return true;
        }
        let Meaning::One(datum) = self.resolved.meaning(name, self.context) else {
            return false;
        };
        let of = self.resolved.datum(datum);
        let Stored::Leaves((first, _)) = of.value else {
            return false;
        };
        let mass = self.resolved.parsed.leaves[first as usize].number();
        of.kind == Type::Loaddata
            && !self.resolved.is_written(Entity::Declared(datum))
            && mass.is_some_and(|mass| mass <= 0.0)
    }

    fn other_load(&mut self, load: Option<Symbol>) {
        let name = load.map_or("something", |load| self.resolved.spelling(load));
        let message = format!(
            "the robot carries {name} from here on (GripLoad), whose mass is not in the text or is \
             written while the program runs: the correction is that of the tool's load alone"
        );
        let hint = "where joints bend under load, name the load in data that nothing writes, or at the \
            moves with \\TLoad, or give the profile a tool with this load";
        self.say(Remark::warning_about("grip-load", message, hint));
    }
}
