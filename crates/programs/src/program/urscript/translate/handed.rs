//! What functions that are not in the files are given: targets that moves go to, and poses that the
//! robot may go to in them.

use super::Translator;
use crate::program::script::{self, Argument, Remark};
use crate::program::urscript::syntax::{Called, Expr, ExprId, FunctionId};
use crate::program::urscript::variables::MOST_STEPS;
use foldhash::HashSet;

/// Poses in what one call is given, themselves or in lists and structures.
#[derive(Default)]
struct Handed {
    targets: Vec<(ExprId, FunctionId)>,
    /// What has been looked into.
    seen: HashSet<(ExprId, FunctionId)>,
    /// Poses that no move in the files goes to.
    has_others: bool,
}

impl Translator<'_, '_, '_> {
    /// The targets that a function which is not in the files is given.
    pub(super) fn handed(&mut self, call: &Called) -> Vec<Argument> {
        let mut handed = Handed::default();
        for &(_, value) in self.goals.parsed.arguments_of(call) {
            self.look_into(value, call.function, MOST_STEPS, &mut handed);
        }
        if handed.has_others {
            let name = self.goals.parsed.spelling(call.name);
            let message = format!(
                "a pose is given to `{name}`, which is not in the files: where the robot goes there \
                 it goes without correction"
            );
            let hint = "give the file that has the function too";
            let remark = Remark::warning_about("pose-passed-to-routine", message, hint);
            self.say(call.offset, remark);
        }
        let mut arguments: Vec<Argument> = Vec::new();
        for (value, function) in handed.targets {
            let target = self.goals.goal(value, function).target;
            let is_new = |target: script::Expr| arguments.iter().all(|of| of.value != target);
            if is_new(target) {
                arguments.push(Argument::new(None, target, None));
            }
        }
        arguments
    }

    fn look_into(&self, value: ExprId, function: FunctionId, steps: u32, found: &mut Handed) {
        let Some(steps) = steps
            .checked_sub(1)
            .filter(|_| found.seen.insert((value, function)))
        else {
            return;
        };
        let goals = &self.goals;
        if goals.has_target(value, function, MOST_STEPS) {
            found.targets.push((value, function));
            return;
        }
        let parsed = goals.parsed;
        match parsed.expression(value) {
            Expr::Literal(id) => found.has_others |= parsed.literal(id).pose,
            Expr::List(list) => {
                for &of in &parsed.lists[list as usize].elements {
                    self.look_into(of, function, steps, found);
                }
            }
            Expr::Name(name, _) => {
                let variable = goals.variables.meaning(name, function);
                let sources = variable.into_iter();
                for source in sources.flat_map(|of| goals.variables.sources(of)) {
                    self.look_into(source.value, source.function, steps / 2, found);
                }
            }
            Expr::Call(call) if goals.variables.is_structure(call) => {
                for &(_, of) in parsed.arguments_of(&parsed.calls[call as usize]) {
                    self.look_into(of, function, steps, found);
                }
            }
            Expr::Element(name, at) => {
                let elements = goals.variables.elements(name, at, function);
                for (of, function) in elements.into_iter().flat_map(|of| of.values) {
                    self.look_into(of, function, steps / 2, found);
                }
            }
            _ => (),
        }
    }
}
