//! The posture in which the robot stands at the end of a move: that of its path, compared with the
//! configuration data, or the one that these name.

use super::follow::{Followed, Passing, SURELY_THROUGH_RAD, course, follow};
use super::posture::{self, Asked, Posture};
use super::ride::Ride;
use super::walk::{CONFIGURATION_CHANGE, Walker};
use crate::finding::Severity;
use crate::geometry::Pose;
use crate::geometry::units::DEG;
use crate::inverse::Branch;
use crate::program::{Configuration, Motion, Move, TargetId};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Joints nearer to their limit than this are at it, radians.
const SAME_RAD: f64 = 1e-4 * DEG;

impl Walker<'_, '_> {
    /// The posture at the end of a move.
    pub(super) fn posture(
        &mut self,
        motion: &Move,
        target: TargetId,
        wanted: &Pose,
        configuration: &Configuration,
        (start, via, ride): (Option<[f64; 6]>, Option<&Pose>, Option<Arc<Ride>>),
        last_known: Option<[f64; 6]>,
    ) -> Option<Posture> {
        let ground = self.ground;
        let equipped = ground.arm_with(motion.tool);
        let near = self.ground.program.near(motion).copied();
        let along = start.filter(|_| {
            motion.motion != Motion::Joint && !motion.free_orientation && near.is_none()
        });
        let mut leaves_reach = false;
        if let Some(start) = along {
            let course = course(
                motion,
                equipped,
                &start,
                via,
                wanted,
                &start,
                ride,
                self.walk_options,
            );
            if let Some(end) = follow(equipped, &course, &start, wanted) {
                let Followed { branch, q, .. } = end;
                let posture = self.compared(motion, target, wanted, configuration, branch, q);
                if let Some(passing) = end.passing
                    && !self.walk_options.strict
                {
                    let is_said = motion.configured && configuration.joint_5_negative.is_some();
                    self.say_passing(motion, target, &passing, &posture, is_said);
                }
                return Some(posture);
            }
            leaves_reach = true;
        }
        let asked = Asked {
            target,
            arm: &equipped.arm,
            wanted: self.programmed(motion, wanted),
            configuration: *configuration,
            honoured: motion.configured && near.is_none(),
            start: near.or(start),
            elsewhere: self.named.get(&target).copied().or(last_known),
            goes_on: last_known.is_some() && !self.named.contains_key(&target),
        };
        let said = self.findings.len();
        let Some(posture) = posture::choose(ground, &asked, self.findings) else {
            let uses = ground.among_uses(motion);
            for found in &mut self.findings[said..] {
                found.message.extend(uses.as_deref());
            }
            return None;
        };
        if leaves_reach && !self.walk_options.strict {
            let joints = posture.q.map(|q| format!("{:.1}", q / DEG)).join(", ");
            let message = format!(
                "the path to {} leaves the reach of the posture in which it begins, and the controller \
                 stops there; joints {joints} deg are taken at its end",
                ground.name_of(target)
            );
            let hint = "go round with a target between, or a joint move";
            let id = "path-out-of-reach";
            let finding = ground.at_move(id, Severity::Warning, motion, message, hint);
            self.findings.push(finding);
        }
        if near.is_some() {
            self.named.insert(target, posture.q);
        }
        self.carried(motion, target, wanted, posture)
    }

    /// The wrist's singularity is near a path: its posture at the end is not certain, unless
    /// configuration data say it; or the path goes through it.
    fn say_passing(
        &mut self,
        motion: &Move,
        target: TargetId,
        passing: &Passing,
        posture: &Posture,
        is_said: bool,
    ) {
        let ground = self.ground;
        if passing.by_rad < SURELY_THROUGH_RAD {
            let message = format!(
                "the path to {} goes through the singularity of the wrist: the corrected one passes it \
                 by a little, and a controller on which joints 4 and 6 sweep there slows down or stops",
                ground.name_of(target)
            );
            let hint = "check it (`poseshift check`), go through it on a joint move, or lead the path \
                past it";
            let finding =
                ground.at_move("near-singularity", Severity::Warning, motion, message, hint);
            self.findings.push(finding);
            return;
        }
        if is_said {
            return;
        }
        let joints = posture.q.map(|q| format!("{:.1}", q / DEG)).join(", ");
        let message = format!(
            "the path to {} passes the singularity of the wrist by {:.1} deg: {} comes in another posture",
            ground.name_of(target),
            passing.by_rad / DEG,
            if passing.is_through {
                format!(
                    "joint 5 is taken to go through zero, to joints {joints} deg; a controller on which \
                     joints 4 and 6 sweep"
                )
            } else {
                format!(
                    "joints 4 and 6 are taken to sweep, to joints {joints} deg; a controller whose joint \
                     5 goes through zero"
                )
            }
        );
        let hint = "go through it on a joint move, or lead the path past it";
        let finding = ground.at_move("several-postures", Severity::Warning, motion, message, hint);
        self.findings.push(finding);
    }

    /// A wanted pose where the program has it: the part may stand elsewhere.
    fn programmed(&self, motion: &Move, wanted: &Pose) -> Pose {
        let ground = self.ground;
        if !ground.part_moved {
            return *wanted;
        }
        let placed = ground.placed(ground.frame_of(motion));
        placed.nominal * (placed.meant.inverse() * *wanted)
    }

    /// The posture of the program where the part stands elsewhere: the same branch, and joints as
    /// near as can be.
    fn carried(
        &mut self,
        motion: &Move,
        target: TargetId,
        wanted: &Pose,
        posture: Posture,
    ) -> Option<Posture> {
        let ground = self.ground;
        if !ground.part_moved {
            return Some(posture);
        }
        let arm = &ground.arm_with(motion.tool).arm;
        let any = Configuration::default();
        if let Some(there) = posture::on_branch(arm, wanted, posture.branch, &posture.q, &any) {
            return Some(there);
        }
        let asked = Asked {
            target,
            arm,
            wanted: *wanted,
            configuration: any,
            honoured: false,
            start: Some(posture.q),
            elsewhere: None,
            goes_on: false,
        };
        posture::choose(ground, &asked, self.findings)
    }

    /// The posture at the end of a path, within the limits by whole rotations; its configuration
    /// data are compared where the controller does.
    fn compared(
        &mut self,
        motion: &Move,
        target: TargetId,
        wanted: &Pose,
        configuration: &Configuration,
        branch: Branch,
        q: [f64; 6],
    ) -> Posture {
        let ground = self.ground;
        // the configuration data are of the pose that the program has
        let as_programmed = if ground.part_moved && motion.configured {
            let arm = &ground.arm_with(motion.tool).arm;
            let there = self.programmed(motion, wanted);
            posture::on_branch(arm, &there, branch, &q, &Configuration::default())
                .map_or(q, |posture| posture.q)
        } else {
            q
        };
        let arm = &ground.arm_with(motion.tool).arm;
        if motion.configured && !posture::holds(arm, configuration, branch, &as_programmed) {
            let shown = q.map(|q| format!("{:.1}", q / DEG)).join(", ");
            let mut message = format!(
                "the path to {} ends in another configuration than the file gives (joints {shown} \
                 deg)",
                ground.name_of(target)
            );
            let hint = "check the configuration data, and that robot, tool and frame are those of \
                the program";
            let (id, severity) = if self.walk_options.strict {
                (CONFIGURATION_CHANGE, Severity::Error)
            } else {
                ("configuration-mismatch", Severity::Warning)
            };
            // the controller would stop there: where the program runs, it stands as the file says,
            // and stood so before
            let meant = self.meant(motion, target, wanted, configuration, &q);
            if meant.is_some() {
                message += "; the one of the file is taken, since the controller stops at another";
            }
            let finding = ground.at_target(id, severity, target, message, hint);
            self.findings.push(finding);
            if let Some(meant) = meant {
                return meant;
            }
        }
        let as_it_is = Posture {
            branch,
            q,
            configured: false,
            exactly: false,
            in_ranges: false,
        };
        let arm = &ground.arm_with(motion.tool).arm;
        let mechanism = arm.mechanism();
        if mechanism.beyond_limit(&q, 0.0).is_none() {
            return as_it_is;
        }
        // a whole rotation less, where that is within the limits
        let near = std::array::from_fn(|i| {
            let limits = &mechanism.joints[i];
            let back = TAU * f64::from(u8::from(q[i] > limits.max_rad));
            let on = TAU * f64::from(u8::from(q[i] < limits.min_rad));
            q[i] - back + on
        });
        let any = Configuration::default();
        let inside = posture::on_branch(arm, wanted, branch, &near, &any)
            .filter(|inside| mechanism.beyond_limit(&inside.q, 0.0).is_none());
        if inside.is_some() && !self.walk_options.strict {
            self.say_beyond(motion, target, &q);
        }
        inside
            .or_else(|| posture::on_branch(arm, wanted, branch, &q, &any))
            .unwrap_or(as_it_is)
    }

    /// A path winds a joint beyond its limit, and within the limits the posture at its end is reached
    /// by a whole rotation only.
    fn say_beyond(&mut self, motion: &Move, target: TargetId, q: &[f64; 6]) {
        let ground = self.ground;
        let joints = &ground.profile.mechanism.joints;
        let limits = |i: usize| (joints[i].min_rad, joints[i].max_rad);
        let Some(joint) = (0..6).find(|i| q[*i] < limits(*i).0 || q[*i] > limits(*i).1) else {
            return;
        };
        let (least, most) = limits(joint);
        let message = format!(
            "the path to {} turns joint {} to {:.1} deg; its limits are {:.1} to {:.1} deg, and the \
             controller stops there: the joint is taken to stand a whole rotation from that",
            ground.name_of(target),
            joint + 1,
            q[joint] / DEG,
            least / DEG,
            most / DEG
        );
        let hint = "go to the target on a joint move, or begin the path with the joint wound the other \
            way; --start-joints says where the robot stands when the program starts";
        let finding = ground.at_move("beyond-limit", Severity::Warning, motion, message, hint);
        self.findings.push(finding);
    }

    /// The posture that the configuration data of a path's end name; `None` where there is none, or
    /// the program is only looked at.
    fn meant(
        &mut self,
        motion: &Move,
        target: TargetId,
        wanted: &Pose,
        configuration: &Configuration,
        q: &[f64; 6],
    ) -> Option<Posture> {
        if self.walk_options.strict {
            return None;
        }
        let asked = Asked {
            target,
            arm: &self.ground.arm_with(motion.tool).arm,
            wanted: self.programmed(motion, wanted),
            configuration: *configuration,
            honoured: true,
            start: Some(*q),
            elsewhere: None,
            goes_on: false,
        };
        let posture = posture::choose(self.ground, &asked, &mut Vec::new())?;
        let meant = posture.configured.then_some(posture)?;
        self.carried(motion, target, wanted, meant)
    }

    /// Whether joints that a target says stand where no arm can: more than a rotation beyond their
    /// limits. Less than that may be within those of the controller.
    pub(super) fn stands_beyond(&mut self, target: TargetId, q: &[f64; 6]) -> bool {
        let ground = self.ground;
        let joints = &ground.profile.mechanism.joints;
        let by = |i: usize| (joints[i].min_rad - q[i]).max(q[i] - joints[i].max_rad);
        let farthest = (0..6).max_by(|a, b| by(*a).total_cmp(&by(*b)));
        let Some(joint) = farthest.filter(|joint| by(*joint) > SAME_RAD) else {
            return false;
        };
        let is_impossible = by(joint) > TAU;
        // whoever looks at a program's moves judges these joints there
        if !is_impossible && self.walk_options.strict {
            return false;
        }
        if !self.beyond.insert(target) {
            return is_impossible;
        }
        let message = format!(
            "joint {} of {} stands at {:.3} deg; its limits are {:.3} to {:.3} deg",
            joint + 1,
            ground.name_of(target),
            q[joint] / DEG,
            joints[joint].min_rad / DEG,
            joints[joint].max_rad / DEG
        );
        let (id, severity, hint) = if is_impossible {
            let hint = "is it in the unit of the language (radians in URScript, else degrees or \
                pulses)? no posture is more than a rotation beyond the limits";
            ("joint-limit", Severity::Error, hint)
        } else {
            let hint = "move the target; or correct the limits in the profile, if the controller's \
                are wider: the robot is taken to stand there";
            ("beyond-limit", Severity::Warning, hint)
        };
        self.findings
            .push(ground.at_target(id, severity, target, message, hint));
        is_impossible
    }
}
