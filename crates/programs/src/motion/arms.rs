//! The arm with one of a program's tools.

use crate::geometry::Pose;
use crate::inverse::{Arm, Branch, Inverse, Status, Unsupported};
use crate::model::effects::Need;
use crate::model::{Conditions, Mechanism, Model};
use crate::profile::{Mounted, Profile};

/// An arm with one of the program's tools.
pub(crate) struct Equipped {
    pub arm: Arm,
    /// How the controller counts angles.
    pub mechanism: Mechanism,
    pub controller: Model,
    /// The inverse of a controller that computes with a calibrated chain of its own.
    pub calibrated_controller: Option<Inverse>,
    /// The real arm without conditions.
    pub inverse: Inverse,
    /// Joints of the real arm that stand elsewhere when they come from the other side.
    pub has_backlash: [bool; 6],
    /// The width of each joint's backlash, radians, where it is the same in all postures.
    steady_rad: Option<[f64; 6]>,
}

impl Equipped {
    /// The arm of a profile with one tool.
    ///
    /// # Errors
    /// An arm without an inverse.
    pub(crate) fn of(profile: &Profile, tool: &Mounted) -> Result<Self, Unsupported> {
        let conditions = Conditions::default();
        let arm = Arm::of(&profile.geometry(tool), &profile.mechanism)?;
        let inverse = Inverse {
            arm: arm.clone(),
            real: profile.real_model(tool, &conditions),
            conditions,
        };
        let controller = profile.controller_model(tool);
        let is_calibrated = !profile.controller_effects().is_empty();
        let calibrated_controller = is_calibrated.then(|| Inverse {
            arm: arm.clone(),
            real: controller.clone(),
            conditions,
        });
        let mut has_backlash = [false; 6];
        let mut is_steady = true;
        for effect in profile.real_effects() {
            let needs = effect.definition().needs;
            if !effect.is_zero() && needs.contains(&Need::Directions) {
                has_backlash[effect.site.index] = true;
                is_steady &= !needs.contains(&Need::Masses);
            }
        }
        let mut equipped = Self {
            arm,
            mechanism: profile.mechanism.clone(),
            controller,
            calibrated_controller,
            inverse,
            has_backlash,
            steady_rad: None,
        };
        if is_steady {
            equipped.steady_rad = Some(equipped.backlash_rad(&[0.0; 6], &conditions));
        }
        Ok(equipped)
    }

    /// How much farther each joint stands when it comes from the other side, radians.
    pub(crate) fn backlash_rad(&self, q: &[f64; 6], conditions: &Conditions) -> [f64; 6] {
        if let Some(steady_rad) = self.steady_rad {
            return steady_rad;
        }
        let from = |side: f64| {
            let conditions = Conditions {
                direction: [side; 6],
                ..*conditions
            };
            self.inverse.real.deflection(q, &conditions).joints
        };
        let (below, above) = (from(-1.0), from(1.0));
        std::array::from_fn(|i| (above[i] - below[i]).abs())
    }

    /// The joints that the controller computes for `world_from_tool` near others, and whether they
    /// reach it.
    pub(crate) fn controller_joints(
        &self,
        world_from_tool: &Pose,
        branch: Branch,
        near: &[f64; 6],
    ) -> ([f64; 6], bool) {
        let branch = if self.arm.has_offset_wrist() {
            // the track of such an arm may have left the branch on which it began
            self.arm.posture(near).0
        } else {
            branch
        };
        match &self.calibrated_controller {
            None => {
                let solution = self.arm.solve_branch(world_from_tool, branch, near);
                (solution.q, solution.beyond == 0.0)
            }
            Some(controller) => {
                let outcome = controller.solve(world_from_tool, branch, near);
                let missed = matches!(outcome.status, Status::OutOfReach | Status::NotConverged);
                (outcome.q, !missed)
            }
        }
    }
}
