//! Where moves lead that go from where the robot stands.

use super::follow::{course, follow};
use super::posture;
use super::walk::Walker;
use crate::inverse::Branch;
use crate::model::Conditions;
use crate::program::{Configuration, Motion, Move, Shift};

impl Walker<'_, '_> {
    /// The joints at the end of a move that goes by a step of the text from where the robot stands:
    /// on the branch where it begins. `None` where that is not known, as of a joint move to which
    /// another posture is nearer.
    pub(super) fn stepped(
        &self,
        motion: &Move,
        step: &Shift,
        start: &[f64; 6],
    ) -> Option<[f64; 6]> {
        let ground = self.ground;
        if ground.is_adrift(motion) {
            return None;
        }
        let equipped = ground.equipped(motion.tool)?;
        let placed = ground.setting.frames[motion.frame].as_ref()?;
        let stands = equipped.controller.forward(start, &Conditions::default());
        let wanted = placed.nominal * step.apply(&(placed.nominal.inverse() * stands));
        if motion.motion != Motion::Joint {
            let options = self.walk_options;
            let path = course(motion, equipped, start, None, &wanted, start, None, options);
            return follow(equipped, &path, start, &wanted).map(|end| end.q);
        }
        let near = ground.program.near(motion).unwrap_or(start);
        let any = Configuration::default();
        let on = |branch| posture::on_branch(&equipped.arm, &wanted, branch, near, &any);
        let branch = equipped.arm.posture(near).0;
        let there = on(branch)?.q;
        let farthest = |q: &[f64; 6]| {
            let each = q.iter().zip(near).map(|(to, from)| (to - from).abs());
            each.fold(0.0, f64::max)
        };
        let others = Branch::ALL.into_iter().filter(|other| *other != branch);
        let mut others = others.filter_map(on);
        let is_nearer = others.any(|other| farthest(&other.q) <= farthest(&there));
        (!is_nearer).then_some(there)
    }
}
