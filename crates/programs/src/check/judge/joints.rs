//! What a move asks of the joints: limits, singularities, the posture at its end, turns, and
//! speeds.

use super::Job;
use crate::check::limits::Asked;
use crate::check::walk::Stop;
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::inverse::Margins;
use crate::motion::course::Course;
use crate::motion::follow::follow;
use crate::motion::leg::Leg;

/// Two joint angles that differ by less are the same, radians.
const SAME_RAD: f64 = 0.5 * DEG;
/// Nearer than this to the border of the arm's reach a path is looked at in small steps.
const NEAR_BORDER_RAD: f64 = 15.0 * DEG;
const NEAR_BORDER_M: f64 = 50.0 * MM;

impl Job<'_> {
    pub(super) fn judge_limits(
        &self,
        index: usize,
        leg: &Leg,
        stop: &Stop,
        asked: &Asked,
        findings: &mut Vec<Finding>,
    ) {
        let limits = &asked.limits;
        let joints = &leg.equipped.arm.mechanism().joints;
        let span = |i: usize| {
            format!(
                "limits {:.2} to {:.2} deg",
                joints[i].min_rad / DEG,
                joints[i].max_rad / DEG
            )
        };
        if limits.margin_rad < -1e-9 {
            let mut beyond: Vec<usize> = (0..6).filter(|&i| asked.margin_rad[i] < -1e-9).collect();
            beyond.sort_by(|a, b| asked.margin_rad[*a].total_cmp(&asked.margin_rad[*b]));
            let each = beyond.iter().map(|&i| {
                format!(
                    "joint {} leaves its limits by {:.3} deg on this move ({})",
                    i + 1,
                    -asked.margin_rad[i] / DEG,
                    span(i)
                )
            });
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "joint-limit",
                Severity::Error,
                each.collect::<Vec<_>>().join("; "),
                "move the target, or another configuration",
            ));
        } else if limits.margin_rad < self.options.limit_margin_rad {
            let message = format!(
                "joint {} comes within {:.3} deg of its limits ({})",
                limits.joint + 1,
                limits.margin_rad / DEG,
                span(limits.joint)
            );
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "near-joint-limit",
                Severity::Warning,
                message,
                "",
            ));
        }
        let margins = &limits.margins;
        let least = self.options.singularity_rad;
        let by_tool = matches!(leg.course, Course::Tool(_));
        for (name, margin) in [("wrist", margins.wrist_rad), ("elbow", margins.elbow_rad)] {
            if by_tool && margin < least {
                let message = format!(
                    "this move passes {:.3} deg from the {name} singularity",
                    margin / DEG
                );
                findings.push(self.subject.finding(
                    self.walk.motion(index),
                    "near-singularity",
                    Severity::Warning,
                    message,
                    "joints move fast there",
                ));
            }
        }
        if by_tool && margins.shoulder_m < 5.0 * MM {
            let message = format!(
                "this move passes {:.2} mm from the shoulder singularity",
                mm_from_m(margins.shoulder_m)
            );
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "near-singularity",
                Severity::Warning,
                message,
                "joints move fast there",
            ));
        }
        self.judge_end(index, leg, stop, margins, findings);
        let wrist = [3, 5].map(|i| (i, asked.turn_rad[i].abs()));
        if let Some((i, turn)) = wrist
            .into_iter()
            .find(|(_, turn)| *turn > std::f64::consts::PI)
        {
            let message = format!(
                "joint {} rotates by {:.1} deg on this move",
                i + 1,
                turn / DEG
            );
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "large-turn",
                Severity::Note,
                message,
                "cables and hoses rotate along",
            ));
        }
        let speeds = &self.subject.profile.joint_speeds;
        let Some(duration) = limits.duration_s else {
            return;
        };
        // by how much each is too fast
        let over = |i: usize| Some((i, asked.rate_rad[i] / duration / speeds[i]?));
        let over = (0..6).filter_map(over).filter(|(_, over)| *over > 1.0);
        let over: Vec<(usize, f64)> = over.collect();
        let worst = over.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some(&(i, times)) = worst {
            let rate = asked.rate_rad[i] / duration / DEG;
            let others = match over.len() {
                1 => String::new(),
                2 => ", and another one is too fast".to_owned(),
                count => format!(", and {} others are too fast", count - 1),
            };
            let message = format!(
                "at the programmed speed joint {} would rotate at {rate:.1} deg/s; it can {:.1}{others}",
                i + 1,
                rate / times
            );
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "joint-speed",
                Severity::Warning,
                message,
                "the controller will slow down",
            ));
        }
    }

    /// A path of the tool must be within reach of the posture in which it begins, and end in that which
    /// its target asks for.
    fn judge_end(
        &self,
        index: usize,
        leg: &Leg,
        stop: &Stop,
        margins: &Margins,
        findings: &mut Vec<Finding>,
    ) {
        if !matches!(leg.course, Course::Tool(_)) {
            return;
        }
        let mut say = |id: &'static str, message: String, hint: &str| {
            let motion = self.walk.motion(index);
            let error = self
                .subject
                .finding(motion, id, Severity::Error, message, hint);
            findings.push(error);
        };
        let round = "go round with a target between, or a joint move";
        // near the borders of the reach a path may be beyond them for a little while
        let is_near = margins.elbow_rad < NEAR_BORDER_RAD || margins.shoulder_m < NEAR_BORDER_M;
        let samples = if is_near { 512 } else { 16 };
        let beyond = (1..=samples)
            .map(|k| f64::from(k) / f64::from(samples))
            .find(|s| leg.beyond(*s) > 0.0);
        if let Some(s) = beyond {
            let message = format!(
                "the straight or circular path is out of reach at {:.0} % of the move",
                100.0 * s
            );
            return say("path-out-of-reach", message, round);
        }
        let Some(end) = follow(leg.equipped, &leg.course, &leg.start, &stop.pose) else {
            let message = "the straight or circular path leaves the reach of the posture in which it \
                begins";
            return say("path-out-of-reach", message.into(), round);
        };
        let q = end.q;
        let aligned = leg.equipped.arm.posture(&stop.q).1.wrist_rad < SAME_RAD;
        let other = (0..6)
            .find(|&i| (q[i] - stop.q[i]).abs() > SAME_RAD && !(aligned && (i == 3 || i == 5)));
        if let Some(i) = other {
            let message = format!(
                "the target's configuration cannot be reached on this path: joint {} comes to \
                 {:.1} deg, and the target has {:.1}",
                i + 1,
                q[i] / DEG,
                stop.q[i] / DEG
            );
            say(
                "configuration-change",
                message,
                "a joint move can change it",
            );
        }
    }
}
