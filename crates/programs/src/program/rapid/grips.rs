//! What the gripper carries (`GripLoad`): with the load of the tool it is one load.
//!
//! # Source
//! ABB, Technical reference manual RAPID Instructions, Functions and Data types, `loaddata` and
//! `GripLoad`: the centre of gravity of what the gripper carries counts in the tool's frame, that of
//! the tool's own load in the frame of the wrist.

use super::records::{frame_of, part_of};
use super::resolved::Entity;
use super::syntax::{
    Argument, Base, Expression, Part, StatementKind, Storage, Stored, Type, Verb, indices,
};
use super::translate::Translator;
use crate::geometry::Pose;
use crate::program::Load;
use crate::program::names::{Meaning, Symbol};
use crate::program::script::{Expr, Held, Place, Remark, Variable, VariableId};
use std::collections::BTreeMap;

/// The tools of moves, where the program names loads.
#[derive(Debug, Default)]
pub(super) struct Grips {
    /// By datum.
    tools: BTreeMap<u32, Tool>,
    /// Some moves have tools that are not among them.
    has_others: bool,
}

/// A tool whose load is in the files, and the variable that holds what it weighs with what it
/// carries.
#[derive(Clone, Copy, Debug)]
struct Tool {
    flange_from_tool: Pose,
    own: Load,
    held: VariableId,
}

impl Tool {
    /// What it weighs with something in it.
    fn with(&self, part: Load) -> Load {
        let own = self.own;
        let mass_kg = own.mass_kg + part.mass_kg;
        let carried = self.flange_from_tool.transform(part.cog_m);
        let cog_m = [0, 1, 2]
            .map(|axis| (own.mass_kg * own.cog_m[axis] + part.mass_kg * carried[axis]) / mass_kg);
        Load { mass_kg, cog_m }
    }
}

impl Translator<'_> {
    /// Finds the tools of moves, where the program says what they carry.
    pub(super) fn find_grips(&mut self) {
        let resolved = self.resolved;
        let statements = &resolved.parsed.statements;
        let grips = |kind: &StatementKind| matches!(kind, StatementKind::Call(call) if call.verb == Verb::GripLoad);
        if !statements.iter().any(|of| grips(&of.kind)) {
            return;
        }
        for statement in statements {
            match statement.kind {
                StatementKind::Text { file, context } => {
                    self.here.file = file;
                    self.context = context;
                }
                StatementKind::Call(call) => {
                    let verb = self.meant(call.callee, call.verb, call.arguments);
                    if matches!(verb, Verb::Move { .. }) {
                        self.find_tool(verb, call.arguments);
                    }
                }
                _ => {}
            }
        }
    }

    fn find_tool(&mut self, verb: Verb, arguments: Part) {
        let all = &self.resolved.parsed.arguments[indices(arguments)];
        let tool = self.tool_of_move(verb, all).map(|at| &all[at]);
        let Some(datum) = tool.and_then(|tool| self.fixed_tool(tool)) else {
            self.grips.has_others = true;
            return;
        };
        if self.grips.tools.contains_key(&datum) {
            return;
        }
        let Some((flange_from_tool, own)) = self.weight_of(datum) else {
            self.grips.has_others = true;
            return;
        };
        let holds = self.held_load(own);
        let held = self.builder.script.variable(Variable {
            kept: true,
            ..Variable::new("GripLoad", Place::NOWHERE, holds)
        });
        let tool = Tool {
            flange_from_tool,
            own,
            held,
        };
        self.grips.tools.insert(datum, tool);
    }

    /// The tool that an argument names, where nothing writes it.
    fn fixed_tool(&self, argument: &Argument) -> Option<u32> {
        let Expression::Point {
            base: Base::Named { name, index: 0 },
            steps: (a, b),
        } = argument.expression
        else {
            return None;
        };
        let Meaning::One(datum) = self.resolved.meaning(name, self.context) else {
            return None;
        };
        let of = self.resolved.datum(datum);
        let is_fixed = a == b
            && of.kind == Type::Tooldata
            && !matches!(of.storage, Storage::Parameter { .. })
            && !self.resolved.is_written(Entity::Declared(datum));
        is_fixed.then_some(datum)
    }

    /// The frame and the load of a tool, where the files have both.
    fn weight_of(&self, datum: u32) -> Option<(Pose, Load)> {
        let of = self.resolved.datum(datum);
        let Stored::Leaves(leaves) = of.value else {
            return None;
        };
        let leaves = &self.resolved.parsed.leaves[indices(leaves)];
        let parts: Vec<_> = leaves.iter().map(|leaf| part_of(*leaf, of.place)).collect();
        let frame = frame_of(true, "", &parts, self.resolved.sources);
        let frame = frame.ok()?.ok()?;
        frame.pose.zip(frame.load)
    }

    /// What a tool weighs with what it carries.
    pub(super) fn gripped(&self, tool: &Argument) -> Expr {
        let tool = self
            .fixed_tool(tool)
            .and_then(|datum| self.grips.tools.get(&datum));
        tool.map_or(Expr::Absent, |tool| Expr::Variable(tool.held))
    }

    /// A load as a value.
    pub(super) fn held_load(&mut self, load: Load) -> Expr {
        let [x, y, z] = load.cog_m;
        let key = [load.mass_kg, x, y, z].map(f64::to_bits);
        let script = &mut self.builder.script;
        let value = self.loads.entry(key);
        Expr::Value(*value.or_insert_with(|| script.value(Held::Load(Some(load)))))
    }

    /// `GripLoad`
    pub(super) fn grip_load(&mut self, arguments: Part) {
        let resolved = self.resolved;
        let all = &resolved.parsed.arguments[indices(arguments)];
        let name = all.iter().find_map(super::moves::plain);
        let is_none = name.is_some_and(|name| self.weighs_nothing(name));
        let part = name.filter(|_| !is_none).and_then(|name| self.load(name));
        if !is_none && (part.is_none() || self.grips.has_others) {
            self.other_load(name);
        }
        let tools: Vec<Tool> = self.grips.tools.values().copied().collect();
        for tool in tools {
            let load = part.map_or(tool.own, |part| tool.with(part));
            let held = self.held_load(load);
            self.set(tool.held, held);
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
            "the robot carries {name} from here on (GripLoad); where that or the tool of a move is \
             chosen by a variable, a parameter or an element, or has no mass in the text, the \
             correction is that of the tool's load alone"
        );
        let hint = "where joints bend under load, name the load in data that nothing writes, or at the \
            moves with \\TLoad, or give the profile a tool with this load";
        self.say(Remark::warning_about("grip-load", message, hint));
    }
}
