//! Whether the controller comes to the fake targets in the postures that they are made for: where
//! its own rules decide, the correction itself may tip them.

use super::Job;
use super::approach::Approach;
use super::ends::{Begin, Path};
use super::solve::fake_joints;
use crate::finding::{Finding, Severity};
use crate::geometry::units::DEG;
use crate::inverse::Outcome;
use crate::model::Conditions;
use crate::motion::walk::{Arrival, Arrivals, WalkOptions};
use crate::motion::{follow, posture};
use crate::program::{Configuration, Displacement, Motion, Move, TargetId, Value};
use std::cell::LazyCell;
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

/// Corrections move a joint by less than this, radians.
const NEAR_HALF_RAD: f64 = 0.1;
/// On a move that takes each joint less far no other posture, and no other rotation, is near.
const SHORT_RAD: f64 = 30.0 * DEG;
/// Nearer to alignment joint 5 may go through.
const NEAR_WRIST_RAD: f64 = 5.0 * DEG;
/// Joints that differ by more are another posture, radians.
const OTHER_RAD: f64 = 1.0 * DEG;

/// A move whose posture at the end is looked at again.
struct Asked<'a> {
    job: &'a Job<'a>,
    arrival: &'a Arrival,
    motion: &'a Move,
    target: TargetId,
    configuration: Configuration,
    start: [f64; 6],
    end: [f64; 6],
}

/// Reports moves on which the controller comes to a fake target in other joints than it is made for.
pub(super) fn others(
    job: &Job,
    arrivals: &Arrivals,
    walk_options: &WalkOptions,
    approaches: &[Approach],
    outcomes: &[Option<Outcome>],
    findings: &mut Vec<Finding>,
) {
    let ground = &job.ground;
    let mut reported = BTreeSet::new();
    let fakes = LazyCell::new(|| fake_joints(job, arrivals, approaches, outcomes));
    let nominal = LazyCell::new(|| arrivals.all.iter().map(|of| of.q).collect::<Vec<_>>());
    for (at, arrival) in arrivals.all.iter().enumerate() {
        let motion = &ground.program.moves[arrival.motion as usize];
        let Some(begin) = Begin::of(job, arrivals, walk_options, arrival) else {
            continue;
        };
        let from = begin.joints(|at| &arrivals.all[at].q);
        let (Some(target), true) = (motion.target, is_wide(from, &arrival.q)) else {
            continue;
        };
        let is_other = motion.motion == Motion::ArcVia
            || motion.displacement != Displacement::None
            || ground.program.near(motion).is_some();
        if is_other || reported.contains(&target) {
            continue;
        }
        let goal = ground.goal(motion);
        let Some(goal) = goal.filter(|goal| !matches!(goal.value, Value::Joints(_))) else {
            continue;
        };
        let asked = Asked {
            job,
            arrival,
            motion,
            target,
            configuration: goal.configuration,
            start: *begin.joints(|at| &fakes[at]),
            end: fakes[at],
        };
        let is_path = motion.motion != Motion::Joint && !motion.free_orientation;
        let found = if is_path {
            let end_of = |joints: &[[f64; 6]]| {
                let path = Path::of(job, arrivals, walk_options, joints, at)?;
                Some(follow::follow(path.equipped, &path.course, &path.start, &path.end)?.q)
            };
            // a path that ends elsewhere without the correction, too, has a finding of its own
            let is_meant = || end_of(&nominal).is_some_and(|q| !differ(&q, &arrival.q));
            let other = end_of(&fakes).filter(|q| differ(q, &asked.end) && is_meant());
            other.map(|other| asked.elsewhere(&other))
        } else {
            asked.rotation(from).or_else(|| asked.nearer())
        };
        if let Some(finding) = found {
            reported.insert(target);
            findings.push(finding);
        }
    }
}

/// Whether another posture at the end of a move, or another rotation, can be near.
fn is_wide(from: &[f64; 6], to: &[f64; 6]) -> bool {
    let near_wrist = |q: &[f64; 6]| q[4].sin().abs() < NEAR_WRIST_RAD.sin();
    near_wrist(from) || near_wrist(to) || (0..6).any(|i| (to[i] - from[i]).abs() > SHORT_RAD)
}

fn differ(a: &[f64; 6], b: &[f64; 6]) -> bool {
    (0..6).any(|i| (a[i] - b[i]).abs() > OTHER_RAD)
}

fn shown(q: &[f64; 6]) -> String {
    q.map(|q| format!("{:.1}", q / DEG)).join(", ")
}

impl Asked<'_> {
    /// A joint move on which the correction takes a joint farther than half a rotation from where it
    /// stands, so that a controller that takes the nearest rotation goes the other way round.
    fn rotation(&self, nominal: &[f64; 6]) -> Option<Finding> {
        let (start, end) = (&self.start, &self.end);
        let by = |from: &[f64; 6], to: &[f64; 6], i: usize| (to[i] - from[i]).abs();
        let is_far =
            |i: &usize| (PI - NEAR_HALF_RAD..PI).contains(&by(nominal, &self.arrival.q, *i));
        let says = &self.configuration;
        let is_free = |i: &usize| {
            !self.arrival.honoured || says.joints[*i].is_none() && says.beyond[*i].is_none()
        };
        let limits = &self.job.ground.profile.mechanism.joints;
        let other = |i: usize| end[i] - TAU.copysign(end[i] - start[i]);
        let fits = |i: &usize| (limits[*i].min_rad..=limits[*i].max_rad).contains(&other(*i));
        let is_beyond = |i: &usize| by(start, end, *i) > PI;
        let joint = (0..6).find(|i| is_far(i) && is_free(i) && is_beyond(i) && fits(i))?;
        let message = format!(
            "the correction takes joint {} farther than half a rotation from where it stands: a \
             controller that takes the nearest goes from {:.2} deg the other way round to {:.2} deg, \
             not to {:.2} deg, on its way to {}",
            joint + 1,
            start[joint] / DEG,
            other(joint) / DEG,
            end[joint] / DEG,
            self.job.ground.name_of(self.target)
        );
        let hint =
            "see that nothing on the arm is wound up, or go to a target between the two first";
        Some(self.finding(Severity::Warning, message, hint))
    }

    /// A joint move to a target whose posture is the nearest: with the correction that is another.
    fn nearer(&self) -> Option<Finding> {
        let ground = &self.job.ground;
        let says = &self.configuration;
        let is_said = [
            says.behind_axis_1,
            says.behind_lower_arm,
            says.joint_5_negative,
        ];
        let is_open = is_said == [None; 3] && says.joints == [None; 6] && says.beyond == [None; 6];
        if self.arrival.honoured && !is_open {
            return None;
        }
        let equipped = ground.equipped(self.motion.tool)?;
        let asked = posture::Asked {
            target: self.target,
            arm: &equipped.arm,
            wanted: equipped
                .controller
                .forward(&self.end, &Conditions::default()),
            configuration: self.configuration,
            honoured: self.arrival.honoured,
            goes_on: false,
            start: Some(self.start),
            elsewhere: None,
        };
        let other = posture::choose(ground, &asked, &mut Vec::new())?.q;
        differ(&other, &self.end).then(|| {
            let message = format!(
                "with the correction another posture is nearer on the way to {}: a controller that takes \
                 the nearest goes to joints {} deg, not to {} deg, for which it is made",
                ground.name_of(self.target),
                shown(&other),
                shown(&self.end)
            );
            let hint = "go to joints, or to a target between the two, first";
            self.finding(Severity::Warning, message, hint)
        })
    }

    /// A path that ends in other joints with the correction.
    fn elsewhere(&self, other: &[f64; 6]) -> Finding {
        let message = format!(
            "the correction takes the path to {} another way: it ends at joints {} deg, not at {} deg, for \
             which it is made",
            self.job.ground.name_of(self.target),
            shown(other),
            shown(&self.end)
        );
        let hint = "the tool rotates by half a revolution, or passes a singularity: put a target between \
            the two";
        self.finding(Severity::Error, message, hint)
    }

    fn finding(&self, severity: Severity, message: String, hint: &str) -> Finding {
        let ground = &self.job.ground;
        ground.at_move("several-postures", severity, self.motion, message, hint)
    }
}
