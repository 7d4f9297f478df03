//! Random configurations that a robot may be sent to.

use super::error::IdentifyError;
use super::random::Random;
use crate::geometry::{Pose, Vector, dot, norm, sub};
use crate::model::{Conditions, Mechanism, Model};
use crate::profile::{Mounted, Profile};
use rayon::prelude::*;
use std::f64::consts::PI;

/// What the arm's effects may add to how fast its points move.
const EFFECTS: f64 = 1.05;
/// A path whose points come as near to a box is not distinguished from one that touches it, metres.
const TOUCH_M: f64 = 1e-4;
/// Configurations that are judged side by side.
const BATCH: usize = 512;
/// Draws for one candidate before the constraints count as impossible to meet.
const DRAWS: usize = 2000;

/// An axis-aligned box of the world, metres.
pub type Box3 = [Vector; 2];

/// What a configuration must meet.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Constraints {
    /// Distance from the joint limits, radians. Room for the approach comes in addition.
    pub margin_rad: f64,
    /// Every gearbox arrives from so far below, radians; 0 without such an approach.
    pub approach_rad: f64,
    /// The tool must be inside, there and where it is approached from.
    pub inside: Option<Box3>,
    /// The tool, the wrist and the elbow must be outside, there and where they are approached
    /// from.
    pub keep_out: Vec<Box3>,
    /// Where the measuring device stands, metres, and how far the tool's z axis may point away
    /// from it, radians.
    pub sight: Option<(Vector, f64)>,
}

impl Constraints {
    /// How far below each of the controller's joints is before it arrives: so far that every gearbox
    /// comes from [`Self::approach_rad`] below. A joint that counts another one in may be where it
    /// arrives, or come from above.
    fn below(&self, arm: &Mechanism) -> [f64; 6] {
        arm.controller(&[self.approach_rad; 6])
    }

    /// Where every joint is before it arrives.
    #[must_use]
    pub fn approach(&self, arm: &Mechanism, q: &[f64; 6]) -> [f64; 6] {
        let below = self.below(arm);
        std::array::from_fn(|i| q[i] - below[i])
    }
}

/// What a box does not allow, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Breach {
    /// The tool is so far outside the box it must be in.
    Outside(f64),
    /// Tool, wrist or elbow is so deep in a keep-out.
    KeptOut(f64),
}

impl Breach {
    /// How far, metres.
    #[must_use]
    pub fn depth_m(self) -> f64 {
        match self {
            Self::Outside(depth) | Self::KeptOut(depth) => depth,
        }
    }
}

/// Constraints of one arm with one tool.
pub struct Guard<'a> {
    profile: &'a Profile,
    tool: &'a Mounted,
    constraints: &'a Constraints,
    arm: Model,
}

/// How far a point is outside a box: 0 inside.
fn beyond(box3: &Box3, p: Vector) -> f64 {
    norm(std::array::from_fn(|k| {
        (box3[0][k] - p[k]).max(p[k] - box3[1][k]).max(0.0)
    }))
}

/// How deep a point is in a box; negative outside.
fn depth(box3: &Box3, p: Vector) -> f64 {
    (0..3)
        .map(|k| (p[k] - box3[0][k]).min(box3[1][k] - p[k]))
        .fold(f64::INFINITY, f64::min)
}

impl<'a> Guard<'a> {
    /// For one tool.
    #[must_use]
    pub fn new(profile: &'a Profile, tool: &'a Mounted, constraints: &'a Constraints) -> Self {
        let arm = profile.real_model(tool, &Conditions::default());
        Self {
            profile,
            tool,
            constraints,
            arm,
        }
    }

    /// The worst that the boxes do not allow at these joints.
    #[must_use]
    pub fn breach(&self, q: &[f64; 6]) -> Option<Breach> {
        let Constraints {
            inside, keep_out, ..
        } = self.constraints;
        if inside.is_none() && keep_out.is_empty() {
            return None;
        }
        let tip = self.tip(q).translation;
        let out = inside.map_or(0.0, |box3| beyond(&box3, tip));
        if out > 0.0 {
            return Some(Breach::Outside(out));
        }
        if keep_out.is_empty() {
            return None;
        }
        let arm = self.arm_points(q).into_iter();
        let deepest = arm
            .chain([tip])
            .flat_map(|p| keep_out.iter().map(move |box3| depth(box3, p)))
            .fold(f64::NEG_INFINITY, f64::max);
        (deepest >= 0.0).then_some(Breach::KeptOut(deepest))
    }

    /// How far tool, wrist and elbow are at least from what the boxes do not allow, metres:
    /// negative in a breach, infinite without boxes.
    fn room_m(&self, q: &[f64; 6]) -> f64 {
        let Constraints {
            inside, keep_out, ..
        } = self.constraints;
        if inside.is_none() && keep_out.is_empty() {
            return f64::INFINITY;
        }
        let tip = self.tip(q).translation;
        let room = inside.map_or(f64::INFINITY, |box3| depth(&box3, tip));
        if keep_out.is_empty() {
            return room;
        }
        let points = self.arm_points(q).into_iter().chain([tip]);
        points
            .flat_map(|p| keep_out.iter().map(move |box3| -depth(box3, p)))
            .fold(room, f64::min)
    }

    /// Elbow and wrist: the origins of the links' frames from the third on.
    fn arm_points(&self, q: &[f64; 6]) -> Vec<Vector> {
        let geometry = self.profile.geometry(self.tool);
        let chain = crate::model::Chain::of(&geometry, &self.profile.mechanism);
        let turns = crate::geometry::AxisRotation::of_each(&self.profile.mechanism.commanded(q));
        let places = chain.link_frames(&turns);
        places[2..].iter().map(|frame| frame.translation).collect()
    }

    /// Whether the boxes are kept everywhere on a move of the joints at constant rates, guaranteed
    /// by how fast the points move: no breach can be between two places that have more room
    /// together than the path between them is long.
    #[must_use]
    pub fn keeps(&self, from: &[f64; 6], to: &[f64; 6]) -> bool {
        let at = |s: f64| self.room_m(&std::array::from_fn(|i| from[i] + s * (to[i] - from[i])));
        let (first, last) = (at(0.0), at(1.0));
        if first == f64::INFINITY {
            return true;
        }
        let mechanism = &self.profile.mechanism;
        let (a, b) = (mechanism.commanded(from), mechanism.commanded(to));
        let reaches = self.arm.reaches();
        let zero = [0.0; 6];
        let last_link = self.arm.link_frames(&zero, &Conditions::default())[6];
        let tool_m = norm(sub(self.tip(&zero).translation, last_link.translation));
        // the farthest point that each joint carries, from its axis
        let way_m: f64 = (0..6)
            .map(|i| (b[i] - a[i]).abs() * (reaches[i + 1..].iter().sum::<f64>() + tool_m))
            .sum::<f64>()
            * EFFECTS;
        let mut open = vec![(0.0, first, 1.0, last)];
        while let Some((low, room, high, other)) = open.pop() {
            let between_m = way_m * (high - low);
            if room < 0.0 || other < 0.0 || (room + other <= between_m && between_m < TOUCH_M) {
                return false;
            }
            if room + other <= between_m {
                let middle = 0.5 * (low + high);
                let its = at(middle);
                open.extend([(low, room, middle, its), (middle, its, high, other)]);
            }
        }
        true
    }

    fn tip(&self, q: &[f64; 6]) -> Pose {
        self.arm.forward(q, &Conditions::default())
    }

    fn is_seen(&self, q: &[f64; 6]) -> bool {
        let Some((device, most)) = self.constraints.sight else {
            return true;
        };
        let tip = self.tip(q);
        let toward = sub(device, tip.translation);
        dot(tip.rotation.axis(2), toward) / norm(toward).max(1e-9) >= most.cos()
    }

    /// Whether a configuration meets the constraints, and all of the path from where it is approached
    /// from keeps the boxes.
    #[must_use]
    pub fn admits(&self, q: &[f64; 6]) -> bool {
        self.is_seen(q)
            && self.breach(q).is_none()
            && (self.constraints.approach_rad == 0.0
                || self.keeps(&self.constraints.approach(&self.profile.mechanism, q), q))
    }
}

/// Random configurations that meet the constraints, as near to zero as they can be: no joint makes
/// a whole revolution in vain. The second value is the part of draws that did.
///
/// # Errors
/// Constraints that no draw meets.
pub fn candidates(
    profile: &Profile,
    tool: &Mounted,
    constraints: &Constraints,
    count: usize,
    seed: u64,
) -> Result<(Vec<[f64; 6]>, f64), IdentifyError> {
    let guards = [Guard::new(profile, tool, constraints)];
    let (found, met) = candidates_where(&guards, count, seed, &|_| true)?;
    Ok((found.into_iter().map(|(_, q)| q).collect(), met))
}

/// Configurations, radians, each with the index of the place where it is.
pub(super) type Drawn = Vec<(usize, [f64; 6])>;

/// As [`candidates`], of those that are `admitted`, each at a random one of several places that an
/// arm's base is carried to, by its index: the constraints there. There is at least one.
pub(super) fn candidates_where(
    guards: &[Guard],
    count: usize,
    seed: u64,
    admitted: &(dyn Fn(&[f64; 6]) -> bool + Sync),
) -> Result<(Drawn, f64), IdentifyError> {
    let (mut random, mut places) = (Random::new(seed), Random::new(seed ^ 0x7ac4));
    let Guard {
        profile,
        constraints,
        ..
    } = &guards[0];
    let mut range = [[0.0; 2]; 6];
    let below = constraints.below(&profile.mechanism);
    for (i, joint) in profile.mechanism.joints.iter().enumerate() {
        let low = joint.min_rad + constraints.margin_rad + below[i].max(0.0);
        let high = joint.max_rad - constraints.margin_rad + below[i].min(0.0);
        if low >= high {
            return Err(IdentifyError::Suspicious {
                message: format!(
                    "joint {} has no room between its limits for the margin and the approach",
                    i + 1
                ),
                hint: "a smaller --margin-deg or --approach-deg".into(),
            });
        }
        // of a joint that rotates more than once, the turn about zero has every posture
        range[i] = if low < -PI && high > PI {
            [-PI, PI]
        } else {
            [low, high]
        };
    }
    let mut found = Vec::with_capacity(count);
    let mut draws = 0;
    while found.len() < count {
        let batch: Vec<(usize, [f64; 6])> = (0..BATCH)
            .map(|_| {
                let q = std::array::from_fn(|i| random.between(range[i][0], range[i][1]));
                (places.below(guards.len()), q)
            })
            .collect();
        // in the order in which they were drawn, however many judge them
        let met: Vec<bool> = batch
            .par_iter()
            .with_min_len(BATCH / 16)
            .map(|(place, q)| guards[*place].admits(q) && admitted(q))
            .collect();
        for (one, is_met) in batch.into_iter().zip(met) {
            draws += 1;
            if draws > DRAWS * (found.len() + 1) {
                return Err(IdentifyError::Suspicious {
                    message: format!(
                        "of {draws} random configurations {} meet the constraints; {count} are \
                         needed",
                        found.len()
                    ),
                    hint: "a larger box, fewer keep-outs, a wider cone, or fewer --candidates; \
                        shapes of the profile that touch \
                           wherever the arm is are too large"
                        .into(),
                });
            }
            if is_met {
                found.push(one);
            }
            if found.len() == count {
                break;
            }
        }
    }
    Ok((found, count as f64 / draws as f64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::units::DEG;
    use crate::model::Coupling;

    #[test]
    fn every_gearbox_comes_from_below_whatever_the_coupling() {
        let text = include_str!("../../../../robots/abb_irb120_thesis.yaml");
        let mut profile = Profile::from_yaml(text).expect("a shipped profile");
        let constraints = Constraints {
            margin_rad: DEG,
            approach_rad: 5.0 * DEG,
            ..Constraints::default()
        };
        let plain = profile.mechanism.clone();
        for (ratio, below_deg) in [(0.0, 5.0), (1.0, 0.0), (-1.0, 10.0), (2.0, -5.0)] {
            profile.mechanism = plain.clone();
            if ratio != 0.0 {
                profile.mechanism.coupling.push(Coupling {
                    joint: 2,
                    on: 1,
                    ratio,
                });
            }
            let arm = &profile.mechanism;
            let (found, _) = candidates(&profile, &Mounted::flange(), &constraints, 40, 3)
                .expect("there is room");
            for q in found {
                let from = constraints.approach(arm, &q);
                let (before, after) = (arm.commanded(&from), arm.commanded(&q));
                for (after, before) in after.iter().zip(before) {
                    let by = after - before;
                    assert!((by - 5.0 * DEG).abs() < 1e-12, "{ratio}: {by}");
                }
                assert!((q[2] - from[2] - below_deg * DEG).abs() < 1e-12, "{ratio}");
                assert_eq!(arm.beyond_limit(&from, 0.0), None, "{ratio}");
            }
        }
    }
}
