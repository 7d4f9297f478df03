//! All answers of an arm with an offset wrist.
//!
//! Each of the four branches exists where the meeting point is within reach. Where it leaves the
//! reach of the stretched or folded arm, or comes too near to axis 1, the equation goes over into
//! that of another branch with a square root's vertical slope. So each stretch of joint 6 between
//! two such edges is counted by t with `q6 = middle − half cos t`, in which the equation is smooth
//! up to its ends, and its roots are searched there: a pair of them near an edge is one on either
//! branch.

use super::{Arm, Circle, LONGEST_RAD, MISSED_RAD, MOST_STEPS, Reached, SETTLED_RAD};
use crate::geometry::{AxisRotation, Pose, roots};
use std::f64::consts::{PI, TAU};

/// Cells in which edges are searched, a whole revolution of joint 6 or a stretch of it: waves of
/// the second order, and a square root's of the shoulder.
const EDGE_CELLS: u32 = 16;
/// Cells in which roots are searched, a whole revolution of joint 6 or a stretch of it.
const ROOT_CELLS: u32 = 24;
/// A minimum of the room within reach below this share of the most counts as an edge.
const PINCHED: f64 = 0.1;
/// Steps to such a minimum.
const PINCH_STEPS: u32 = 13;
/// The last step to the least that a target out of reach is missed by.
const LEAST_STEP_RAD: f64 = 1e-4;
/// Left out near an edge, in t: there the slope is a quotient of two zeros. A root in it lies
/// between what the equation is there on the two branches that meet.
const EDGE: f64 = 2e-5;
/// What the equation is at most next to an edge at which it has a root.
const AT_EDGE: f64 = 1e-3;

/// A stretch of joint 6 by a parameter.
#[derive(Clone, Copy, Debug)]
enum Stretch {
    /// The angle itself.
    Plain { from: f64, to: f64 },
    /// `middle − half cos t`, t from 0 to π, with an edge at one end at least.
    Between { middle: f64, half: f64 },
}

impl Stretch {
    fn ends(self) -> [f64; 2] {
        match self {
            Self::Plain { from, to } => [from, to],
            Self::Between { .. } => [EDGE, PI - EDGE],
        }
    }

    /// The angle at a parameter, and its slope.
    fn at(self, parameter: f64) -> (f64, f64) {
        match self {
            Self::Plain { .. } => (parameter, 1.0),
            Self::Between { middle, half } => {
                let (sine, cosine) = parameter.sin_cos();
                (middle - half * cosine, half * sine)
            }
        }
    }

    /// The parts on which `room` is not negative, by parameters, divided where it is little: `None`
    /// for the whole.
    fn parts(
        self,
        mut room: impl FnMut(f64) -> (f64, f64),
        edges: &mut Vec<f64>,
    ) -> Vec<Option<[f64; 2]>> {
        let [from, to] = self.ends();
        edges.clear();
        roots(&mut room, [from, to], EDGE_CELLS, edges);
        pinches(&mut room, [from, to], edges);
        edges.sort_by(f64::total_cmp);
        if edges.is_empty() {
            return if room(0.5 * (from + to)).0 > 0.0 {
                vec![None]
            } else {
                Vec::new()
            };
        }
        let mut ends = edges.clone();
        if let Self::Plain { .. } = self {
            // a whole revolution: the last part goes over into the first
            ends.push(edges[0] + TAU);
        } else {
            ends.insert(0, from);
            ends.push(to);
        }
        ends.windows(2)
            .filter(|pair| room(0.5 * (pair[0] + pair[1])).0 > 0.0)
            .map(|pair| Some([pair[0], pair[1]]))
            .collect()
    }
}

/// Where a function has a minimum that is little above zero, appended to `found`: the joints turn
/// fast there, as at an edge.
fn pinches(room: &mut impl FnMut(f64) -> (f64, f64), [from, to]: [f64; 2], found: &mut Vec<f64>) {
    let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(EDGE_CELLS);
    let samples: [(f64, f64); EDGE_CELLS as usize + 1] =
        std::array::from_fn(|k| room(from + (to - from) * k as f64 / f64::from(EDGE_CELLS)));
    let most = samples.iter().fold(0.0, |most: f64, s| most.max(s.0));
    for k in 0..EDGE_CELLS {
        let [low, high] = [k, k + 1].map(|k| samples[k as usize]);
        if !(low.1 < 0.0 && high.1 > 0.0 && low.0.min(high.0) < 2.0 * PINCHED * most) {
            continue;
        }
        // the slope's root by bisection and the secant in turn
        let (mut a, mut b) = ((at(k), low.1), (at(k + 1), high.1));
        for step in 0..PINCH_STEPS {
            let middle = if step % 2 == 0 {
                a.0 - a.1 * (b.0 - a.0) / (b.1 - a.1)
            } else {
                0.5 * (a.0 + b.0)
            };
            let (value, slope) = room(middle);
            if step + 1 == PINCH_STEPS && value > 0.0 && value < PINCHED * most {
                found.push(middle);
            }
            if slope < 0.0 {
                a = (middle, slope);
            } else {
                b = (middle, slope);
            }
        }
    }
}

/// A branch to the meeting point: front, before.
pub(in super::super) type ArmSigns = [f64; 2];

impl Arm {
    /// The rows at every root on the ways whose front sign is among `fronts` and whose elbow sign
    /// is among `befores`, handed to `each`.
    pub(in super::super) fn offset_roots(
        &self,
        target: &Pose,
        fronts: &[f64],
        befores: &[f64],
        mut each: impl FnMut([AxisRotation; 6]),
    ) {
        let circle = self.circle(target);
        let (mut edges, mut found) = (Vec::new(), Vec::new());
        for whole in self.stretches(&circle, &mut edges) {
            for &front in fronts {
                let room = |parameter: f64| {
                    let (angle, turned) = whole.at(parameter);
                    let (room, slope) = self.elbow_room(&circle, angle, front);
                    (room, slope * turned)
                };
                for part in whole.parts(room, &mut edges) {
                    for &before in befores {
                        found.clear();
                        self.search(&circle, whole, part, [front, before], &mut found);
                        for &angle in &found {
                            let sixth = AxisRotation::of(angle);
                            let here = self.reached(&circle.at(sixth), front, before);
                            each(self.rows_at(target, sixth, &here));
                        }
                    }
                }
            }
        }
    }

    /// The stretches of joint 6 on which the meeting point is far enough from axis 1.
    fn stretches(&self, circle: &Circle<f64>, edges: &mut Vec<f64>) -> Vec<Stretch> {
        let whole = Stretch::Plain { from: 0.0, to: TAU };
        let [fixed, across, along] = &circle.point;
        let swing = (across[0].hypot(across[1])).hypot(along[0].hypot(along[1]));
        if fixed[0].hypot(fixed[1]) > self.lateral_m.abs() + 1.5 * swing {
            return vec![whole];
        }
        let parts = whole.parts(|angle| self.shoulder_room(circle, angle), edges);
        let stretch = |part: Option<[f64; 2]>| match part {
            None => whole,
            Some([low, high]) => Stretch::Between {
                middle: 0.5 * (low + high),
                half: 0.5 * (high - low),
            },
        };
        parts.into_iter().map(stretch).collect()
    }

    /// Squared distance of the meeting point from the nearest place that the shoulder's offset
    /// allows, m², and its slope.
    fn shoulder_room(&self, circle: &Circle<f64>, angle: f64) -> (f64, f64) {
        let sixth = AxisRotation::of(angle);
        let ([x, y, _], [dx, dy, _]) = (circle.at(sixth).point, circle.slope(sixth).point);
        let room = x * x + y * y - self.lateral_m * self.lateral_m;
        (room, 2.0 * (x * dx + y * dy))
    }

    /// Squared sine of the elbow, negative out of reach, and its slope.
    fn elbow_room(&self, circle: &Circle<f64>, angle: f64, front: f64) -> (f64, f64) {
        let sixth = AxisRotation::of(angle);
        let (at, moved) = (circle.at(sixth).point, circle.slope(sixth).point);
        let (_, r, _) = self.shoulder(at, front);
        let (dr, _) = self.shoulder_slope([at[0], at[1]], [moved[0], moved[1]], r);
        let (u, v) = (r - self.a2_m, at[2]);
        let cosine = self.elbow_cosine(u, v);
        let slope = (u * dr + v * moved[2]) / (self.a3_m * self.forearm_m);
        (1.0 - cosine * cosine, -2.0 * cosine * slope)
    }

    /// The roots of the equation on one part of a stretch.
    fn search(
        &self,
        circle: &Circle<f64>,
        whole: Stretch,
        part: Option<[f64; 2]>,
        [front, before]: ArmSigns,
        found: &mut Vec<f64>,
    ) {
        let residual = |angle: f64| {
            let sixth = AxisRotation::of(angle);
            let at = circle.at(sixth);
            let here = self.reached(&at, front, before);
            (here.value, self.slope(&here, &at, &circle.slope(sixth)))
        };
        let by_stretch = |parameter: f64| {
            let (angle, turned) = whole.at(parameter);
            let (value, slope) = residual(angle);
            (value, slope * turned)
        };
        let part = part.map(|[low, high]| Stretch::Between {
            middle: 0.5 * (low + high),
            half: 0.5 * (high - low),
        });
        if let Some(part) = part {
            let mut by_part = |t: f64| {
                let (parameter, turned) = part.at(t);
                let (value, slope) = by_stretch(parameter);
                (value, slope * turned)
            };
            roots(&mut by_part, part.ends(), ROOT_CELLS, found);
            let other = |t: f64| {
                let sixth = AxisRotation::of(whole.at(part.at(t).0).0);
                self.reached(&circle.at(sixth), front, -before).value
            };
            for (end, inward) in [(0.0, 1.0), (PI, -1.0)] {
                let next = end + inward * EDGE;
                let (own, other) = (by_part(next).0, other(next));
                let is_crossed = own * other <= 0.0 && own != other;
                if is_crossed && own.abs().max(other.abs()) < AT_EDGE {
                    let inside = -EDGE * (own + other) / (own - other);
                    // else it is one of the other branch
                    if inside >= 0.0 {
                        found.push(end + inward * inside);
                    }
                }
            }
            for t in found.iter_mut() {
                *t = whole.at(part.at(*t).0).0;
            }
        } else {
            let mut by_stretch = by_stretch;
            roots(&mut by_stretch, whole.ends(), ROOT_CELLS, found);
            for t in found.iter_mut() {
                *t = whole.at(*t).0;
            }
        }
    }

    /// The root that Newton's method reaches from row 6 at `sixth` on one branch, with how far row
    /// 6 turned; `None` where it leaves the branch or does not settle.
    pub(in super::super) fn offset_root_near(
        &self,
        target: &Pose,
        start: AxisRotation,
        [front, before]: ArmSigns,
    ) -> Option<([AxisRotation; 6], f64)> {
        let circle = self.circle(target);
        let (mut sixth, mut turned) = (start, 0.0_f64);
        for _ in 0..MOST_STEPS {
            let at = circle.at(sixth);
            let here = self.reached(&at, front, before);
            if !(here.beyond == 0.0 && turned.abs() < LONGEST_RAD) {
                return None;
            }
            let step = -here.value / self.slope(&here, &at, &circle.slope(sixth));
            if step.abs() < SETTLED_RAD || (here.value == 0.0 && turned == 0.0) {
                let is_root = here.value.abs() < MISSED_RAD;
                return is_root.then(|| (self.rows_at(target, sixth, &here), turned));
            }
            turned += step;
            sixth = start.and(turned);
        }
        None
    }

    /// Where no root is: the rows on one branch that miss the target least of some samples, with
    /// how far they are beyond reach or how much the equation misses.
    pub(in super::super) fn offset_least(
        &self,
        target: &Pose,
        [front, before]: ArmSigns,
    ) -> ([AxisRotation; 6], f64) {
        let circle = self.circle(target);
        let missed = |angle: f64| {
            let here: Reached<f64> =
                self.reached(&circle.at(AxisRotation::of(angle)), front, before);
            here.beyond + here.value.abs()
        };
        let cell = TAU / f64::from(ROOT_CELLS);
        let (mut angle, mut beyond) = (0.0, f64::INFINITY);
        for sample in 0..ROOT_CELLS {
            let at = cell * f64::from(sample);
            let missed = missed(at);
            if missed < beyond {
                (angle, beyond) = (at, missed);
            }
        }
        // a finer comb about the best
        let mut step = 0.5 * cell;
        while step > LEAST_STEP_RAD {
            for at in [angle - step, angle + step] {
                let missed = missed(at);
                if missed < beyond {
                    (angle, beyond) = (at, missed);
                }
            }
            step *= 0.5;
        }
        let sixth = AxisRotation::of(angle);
        let here = self.reached(&circle.at(sixth), front, before);
        (
            self.rows_at(target, sixth, &here),
            beyond.max(f64::MIN_POSITIVE),
        )
    }
}
