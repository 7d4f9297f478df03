//! All answers at a pose, the one nearest to a posture, and their names.

use super::offset::ArmSigns;
use super::{Arm, Rotated, Solution, Wrist};
use crate::geometry::{AxisRotation, Pose, wrap};
use crate::inverse::Branch;

/// A posture that no joint leaves by more than this, radians, follows the one before.
const CLOSE_RAD: f64 = 0.35;
/// An answer that Newton's method finds from a posture is taken where no joint leaves it by more:
/// near a fold it may be the other one of two, and all are looked at.
const NEAR_RAD: f64 = 0.05;
/// Answers with no joint farther apart than this, radians, are one.
const SAME_RAD: f64 = 1e-7;
const BOTH: [f64; 2] = [1.0, -1.0];

/// One posture that reaches a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Its branch.
    pub branch: Branch,
    /// Which of the answers on this branch, from 0, in the order of the angle of joint 6 in (−π,
    /// π]. Always 0 but for arms with an offset wrist.
    pub root: u8,
    /// The controller's joint angles, radians.
    pub q: [f64; 6],
}

impl Arm {
    /// Whether a branch may hold several answers: axes 4 and 5 meet, and axis 6 passes one of them
    /// at a distance.
    #[must_use]
    pub fn has_offset_wrist(&self) -> bool {
        self.wrist == Wrist::Offset
    }

    /// Every posture that brings the nominal tool to `world_from_tool`, by whole revolutions
    /// nearest to `near`, in the order of the branches; joint limits are not looked at.
    ///
    /// Up to eight, up to sixteen with an offset wrist. None out of reach, or where the pose is not
    /// finite.
    #[must_use]
    pub fn solve_all(&self, world_from_tool: &Pose, near: &[f64; 6]) -> Vec<Answer> {
        let mut answers = Vec::with_capacity(16);
        if self.wrist != Wrist::Offset {
            for branch in Branch::ALL {
                let Solution { q, beyond } = self.solve_branch(world_from_tool, branch, near);
                if beyond == 0.0 {
                    answers.push(Answer { branch, root: 0, q });
                }
            }
            return answers;
        }
        self.each_root(world_from_tool, &BOTH, &BOTH, |turns| {
            let stance = self.stance(&turns);
            let q = self.solution(&Rotated { turns, beyond: 0.0 }, near).q;
            let is_same = |other: &Answer| apart(&other.q, &q) < SAME_RAD;
            if !answers.iter().any(is_same) {
                let branch = stance.branch();
                answers.push(Answer { branch, root: 0, q });
            }
        });
        answers.sort_by(|a, b| {
            let sixth = |answer: &Answer| wrap(answer.q[5]);
            let by_branch = a.branch.number().cmp(&b.branch.number());
            by_branch.then(sixth(a).total_cmp(&sixth(b)))
        });
        for i in 1..answers.len() {
            if answers[i].branch == answers[i - 1].branch {
                answers[i].root = answers[i - 1].root + 1;
            }
        }
        answers
    }

    /// The posture that brings the nominal tool to `world_from_tool` on the track of `near`, by
    /// whole revolutions nearest to it: on its branch, or with an offset wrist the nearest answer
    /// of all, since such an arm passes from branch to branch without a singularity.
    ///
    /// Where nothing is in reach [`Solution::beyond`] is positive, as with [`Arm::solve_branch`].
    #[must_use]
    pub fn solve_near(&self, world_from_tool: &Pose, near: &[f64; 6]) -> Solution {
        let turns = AxisRotation::of_each(&self.mechanism.commanded(near));
        if self.wrist != Wrist::Offset {
            let branch = self.stance(&turns).branch();
            return self.solve_branch(world_from_tool, branch, near);
        }
        self.solution(&self.offset_follow(world_from_tool, &turns), near)
    }

    /// The posture on a path that runs on one branch: the one on it nearest to `near`, or with an
    /// offset wrist the one on the track of `near`, wherever that leads.
    #[must_use]
    pub fn solve_along(&self, world_from_tool: &Pose, branch: Branch, near: &[f64; 6]) -> Solution {
        if self.wrist == Wrist::Offset {
            self.solve_near(world_from_tool, near)
        } else {
            self.solve_branch(world_from_tool, branch, near)
        }
    }

    /// Every root of the offset wrist's equation on some of the branches, as turns of the
    /// mechanical joints.
    fn each_root(
        &self,
        world_from_tool: &Pose,
        fronts: &[f64],
        befores: &[f64],
        mut each: impl FnMut([AxisRotation; 6]),
    ) {
        let target = self.last_row(world_from_tool);
        self.offset_roots(&target, fronts, befores, |rows| each(self.turns_of(rows)));
    }

    /// The answer of an arm with an offset wrist nearest to a posture.
    pub(in crate::inverse) fn offset_follow(
        &self,
        world_from_tool: &Pose,
        posture: &[AxisRotation; 6],
    ) -> Rotated {
        let arm = self.arm_branch(posture);
        if let Some(turns) = self.offset_near(world_from_tool, posture, arm) {
            return Rotated { turns, beyond: 0.0 };
        }
        let mut nearest = Nearest::to(posture);
        self.each_root(world_from_tool, &BOTH, &BOTH, |turns| nearest.offer(turns));
        nearest.found().unwrap_or_else(|| {
            let target = self.last_row(world_from_tool);
            self.least(self.offset_least(&target, arm))
        })
    }

    /// The answer of an arm with an offset wrist to start from on one branch: that on the track of
    /// a posture of this branch, or at its border, wherever that leads, or the one on the branch that
    /// is nearest to the posture.
    pub(in crate::inverse) fn offset_start(
        &self,
        world_from_tool: &Pose,
        branch: Branch,
        near: &[f64; 6],
    ) -> Rotated {
        let posture = AxisRotation::of_each(&self.mechanism.commanded(near));
        let on_branch = self.stance(&posture).is_on(branch);
        let arm = self.arm_branch(&posture);
        if let Some(turns) = self
            .offset_near(world_from_tool, &posture, arm)
            .filter(|_| on_branch)
        {
            return Rotated { turns, beyond: 0.0 };
        }
        if on_branch {
            let nearest = self.offset_follow(world_from_tool, &posture);
            if nearest.beyond == 0.0 && is_close(&nearest.turns, &posture) {
                return nearest;
            }
        }
        self.offset_on_branch(world_from_tool, branch, near)
    }

    /// The answer of an arm with an offset wrist on one branch nearest to a posture.
    pub(in crate::inverse) fn offset_on_branch(
        &self,
        world_from_tool: &Pose,
        branch: Branch,
        near: &[f64; 6],
    ) -> Rotated {
        let posture = AxisRotation::of_each(&self.mechanism.commanded(near));
        let [front, before, _] = branch.signs();
        let offset = self.offset_near(world_from_tool, &posture, [front, before]);
        let is_meant = |turns: &[AxisRotation; 6]| {
            self.stance(turns).branch().joint_5_negative == branch.joint_5_negative
        };
        if let Some(turns) = offset.filter(is_meant) {
            return Rotated { turns, beyond: 0.0 };
        }
        let mut nearest = Nearest::to(&posture);
        self.each_root(world_from_tool, &[front], &[before], |turns| {
            if is_meant(&turns) {
                nearest.offer(turns);
            }
        });
        nearest.found().unwrap_or_else(|| {
            let target = self.last_row(world_from_tool);
            self.least(self.offset_least(&target, [front, before]))
        })
    }

    fn least(&self, (rows, beyond): ([AxisRotation; 6], f64)) -> Rotated {
        Rotated {
            turns: self.turns_of(rows),
            beyond,
        }
    }

    /// The branch of the arm to the meeting point.
    fn arm_branch(&self, posture: &[AxisRotation; 6]) -> ArmSigns {
        let [front, before, _] = self.stance(posture).branch().signs();
        [front, before]
    }

    /// The answer on one branch that Newton's method reaches from a posture, if it is close to it.
    fn offset_near(
        &self,
        world_from_tool: &Pose,
        posture: &[AxisRotation; 6],
        arm: ArmSigns,
    ) -> Option<[AxisRotation; 6]> {
        let target = self.last_row(world_from_tool);
        let start = self.row(5, posture[5]);
        let (rows, _) = self.offset_root_near(&target, start, arm)?;
        let turns = self.turns_of(rows);
        is_within(&turns, posture, NEAR_RAD).then_some(turns)
    }
}

/// Whether no joint leaves a posture by more than a track does from one target to the next.
pub(in crate::inverse) fn is_close(a: &[AxisRotation; 6], b: &[AxisRotation; 6]) -> bool {
    is_within(a, b, CLOSE_RAD)
}

fn is_within(a: &[AxisRotation; 6], b: &[AxisRotation; 6], limit_rad: f64) -> bool {
    let least = limit_rad.cos();
    (0..6).all(|i| (a[i] * b[i].inverse()).cosine > least)
}

/// The posture least far from another by its largest joint.
struct Nearest<'a> {
    to: &'a [AxisRotation; 6],
    best: Option<(f64, [AxisRotation; 6])>,
}

impl<'a> Nearest<'a> {
    fn to(to: &'a [AxisRotation; 6]) -> Self {
        Self { to, best: None }
    }

    fn offer(&mut self, turns: [AxisRotation; 6]) {
        let cosines = (0..6).map(|i| (turns[i] * self.to[i].inverse()).cosine);
        let closeness = cosines.fold(f64::INFINITY, f64::min);
        if self.best.is_none_or(|(best, _)| closeness > best) {
            self.best = Some((closeness, turns));
        }
    }

    fn found(&self) -> Option<Rotated> {
        self.best.map(|(_, turns)| Rotated { turns, beyond: 0.0 })
    }
}

/// The largest difference of a joint, by whole revolutions, radians.
fn apart(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    (0..6).map(|i| wrap(a[i] - b[i]).abs()).fold(0.0, f64::max)
}
