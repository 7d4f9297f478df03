//! The answer that a straight path of the tool leads to, and the one that a configuration means.
//!
//! Where a branch holds several answers, the letters that a program carries do not tell them apart.
//! What the arm does is known where it comes from a known posture: it follows one connected track.

use super::closed_form::{Answer, Arm};
use crate::geometry::{Pose, Rotation, add, scale, sub, wrap};

/// Steps that the path is cut into at first, and the shortest ones, as parts of it.
const STEPS: [f64; 2] = [1.0 / 8.0, 1.0 / 1024.0];
/// A joint rotates by less than this in one step, radians.
const MOST_STEP_RAD: f64 = 0.35;
/// Nearer to a fold than this, radians, two answers cannot be distinguished on the path: they are
/// some three degrees apart.
const NEAR_FOLD_RAD: f64 = 0.02;

/// A path on which the track of a posture ends.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the track of joint angles ends after {:.0} % of the straight path", 100.0 * after)]
pub struct TrackEnds {
    /// After which part of the path.
    pub after: f64,
}

/// A configuration that several answers of one branch have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{} answers share the configuration", candidates.len())]
pub struct Ambiguous {
    /// They, the nearest one first.
    pub candidates: Vec<Answer>,
}

impl Arm {
    /// The joint angles of the nominal arm at `to` when its tool goes there on a straight path,
    /// rotating evenly, from where it is at `from`: those on the same connected track.
    ///
    /// # Errors
    /// Where the track ends before: out of reach, or at a singularity (for an arm with an offset
    /// wrist at a fold), beyond which there are two ways to go on.
    pub fn follow(&self, from: &[f64; 6], to: &Pose) -> Result<[f64; 6], TrackEnds> {
        let start = self.forward(from);
        let turn = (to.rotation * start.rotation.transpose()).vector();
        let at = |s: f64| Pose {
            rotation: Rotation::from_vector(scale(s, turn)) * start.rotation,
            translation: add(
                start.translation,
                scale(s, sub(to.translation, start.translation)),
            ),
        };
        let (mut near, mut after, mut step) = (*from, 0.0, STEPS[0]);
        while after < 1.0 {
            let next = f64::min(after + step, 1.0);
            let pose = if next < 1.0 { at(next) } else { *to };
            let found = self.solve_near(&pose, &near);
            let follows = found.beyond == 0.0
                && (0..6).all(|i| (found.q[i] - near[i]).abs() < MOST_STEP_RAD)
                && self
                    .fold_rad(&found.q)
                    .is_none_or(|fold| fold > NEAR_FOLD_RAD);
            if follows {
                (near, after) = (found.q, next);
                step = (2.0 * step).min(STEPS[0]);
            } else if step > STEPS[1] {
                step *= 0.5;
            } else {
                return Err(TrackEnds { after });
            }
        }
        Ok(near)
    }

    /// The answer at a pose that a configuration means, nearest to `near`: where several answers of
    /// one branch have it, the one that [`Arm::follow`] leads to from the posture before.
    ///
    /// `is_meant` says what the program's data tells: branch, quadrants, turns. `Ok(None)` where no
    /// answer has it.
    ///
    /// # Errors
    /// The candidates, where several are on the branch of the nearest and no posture before tells
    /// which is meant.
    pub fn choose(
        &self,
        world_from_tool: &Pose,
        near: &[f64; 6],
        before: Option<&[f64; 6]>,
        is_meant: impl Fn(&Answer) -> bool,
    ) -> Result<Option<Answer>, Ambiguous> {
        let mut meant = self.solve_all(world_from_tool, near);
        meant.retain(|answer| is_meant(answer));
        let far = |a: &Answer| {
            let turned = (0..6).map(|i| (a.q[i] - near[i]).abs());
            turned.fold(0.0, f64::max)
        };
        meant.sort_by(|a, b| far(a).total_cmp(&far(b)));
        let Some(nearest) = meant.first().copied() else {
            return Ok(None);
        };
        let is_twin = |a: &&Answer| a.branch == nearest.branch;
        if meant.iter().filter(is_twin).count() == 1 {
            return Ok(Some(nearest));
        }
        let followed = before.and_then(|before| self.follow(before, world_from_tool).ok());
        let is_end = |a: &&Answer| {
            followed.is_some_and(|q| (0..6).all(|i| wrap(a.q[i] - q[i]).abs() < 1e-6))
        };
        if let Some(answer) = meant.iter().find(is_end) {
            return Ok(Some(*answer));
        }
        meant.retain(|answer| answer.branch == nearest.branch);
        Err(Ambiguous { candidates: meant })
    }
}
