//! Near which joints positions are, by what the text says of them elsewhere than at the move.

use super::Translator;
use crate::program::urscript::syntax::{Expr, FunctionId, Step};

impl Translator<'_, '_, '_> {
    /// A move says near which joints a position with a name is, to all moves that go there, and so it
    /// does where it never runs.
    pub(super) fn name_posture(&mut self, step: &Step, function: FunctionId) {
        let goals = &mut self.goals;
        let Some(target) = step.target else {
            return;
        };
        if let Expr::Kinematics {
            pose,
            near: Some(near),
            ..
        } = goals.parsed.expression(target)
            && matches!(goals.parsed.expression(pose), Expr::Name(..))
            && let (Expr::Literal(literal), _) = goals.variables.follow(pose, function)
            && let Some(target) = goals.targets[literal as usize]
            && let Some(joints) = goals.joints(near, function)
        {
            goals.builder.script.named.push((target, joints));
        }
    }

    /// `PolyScope` writes a waypoint as `Name_p`, its pose, and `Name_q`, the joints at which it was
    /// taught.
    pub(super) fn name_waypoints(&mut self) {
        let goals = &mut self.goals;
        for assignment in &goals.parsed.assignments {
            if let Expr::Literal(literal) = goals.parsed.expression(assignment.value)
                && let Some(target) = goals.targets[literal as usize]
                && let Some(stem) = goals.parsed.bytes(assignment.name).strip_suffix(b"_p")
                && let Some(name) = goals.parsed.known_symbol(&[stem, b"_q"].concat())
                && let Some(variable) = goals.variables.meaning(name, assignment.function)
                && let Some(taught) = goals.variables.fixed(variable)
                && let Some(joints) = goals.joints(taught.value, taught.function)
            {
                goals.builder.script.named.push((target, joints));
            }
        }
    }
}
