//! How far the real tool is from the wanted path anywhere along a move.
//!
//! Between two samples at a and b a function e with |e''| ≤ B is within B (b − a)² / 8 of the
//! straight line between its values there. With e the difference of the real tool's pose and the
//! wanted one, B from [`Jet`]s over the whole interval, and halving where the bound is not yet near
//! the largest sample, the bound that is reported holds everywhere, and is near.
//!
//! The pose's difference has twelve components: three of the position, and nine of the rotation
//! matrices, whose Frobenius norm is `2√2 sin(φ/2)` at an angle φ.

use super::larger;
use crate::geometry::{Jet, Pose, Scalar, Separation, norm, sub};
use crate::model::{Conditions, Model};
use crate::motion::leg::{Leg, Piece};

/// Halving ends where the bound is within this of the largest sample, metres and radians, …
const CLOSE_M: f64 = 1e-6;
const CLOSE_RAD: f64 = 2e-6;
/// … or within this part of it.
const CLOSE_PART: f64 = 0.01;
/// Intervals are halved at most so often; what remains open is reported with its bound.
const DEEPEST: u32 = 12;
/// … and so often where the joints' rates have no bound, so that there are only samples.
const SAMPLED: u32 = 5;
/// Where not all of a move is certain a bound says nothing that is farther than this from the samples,
/// metres and radians.
const SAYS_M: f64 = 1e-3;
const SAYS_RAD: f64 = 0.02;

/// The error of a tool's path.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct PathError {
    /// Nowhere along the move is the tool farther from where it should be than this.
    pub bound: Separation,
    /// The farthest sample.
    pub sampled: Separation,
    /// Where along the move, 0 to 1, the farthest sample is.
    pub at: f64,
    /// The bound is guaranteed; else it is only that of the samples.
    pub certified: bool,
}

/// The models that a move is judged with.
pub(crate) struct Models<S> {
    pub real: Model<S>,
    pub controller: Model<S>,
}

/// The move that says where the tool is wanted: this one in the controller's own belief, or a part
/// of another one.
pub(crate) struct Wanted<'a> {
    pub leg: &'a Leg<'a>,
    pub from: f64,
    pub to: f64,
    pub controller: &'a Model,
    pub controller_jet: &'a Model<Jet>,
    /// It is the move itself: what the joints are need not be found again.
    pub own: bool,
}

impl Wanted<'_> {
    fn along(&self, s: f64) -> f64 {
        self.from + s * (self.to - self.from)
    }

    pub(super) fn at(&self, s: f64, joints: &[f64; 6]) -> Pose {
        if self.own {
            let pose = self.leg.controller_pose(s, joints, self.controller);
            return self.leg.real_from_nominal(s, pose);
        }
        let s = self.along(s);
        let joints = self.leg.joints(s, &self.leg.start);
        let pose = self.leg.controller_pose(s, &joints, self.controller);
        self.leg.real_from_nominal(s, pose)
    }

    fn over(&self, from: f64, to: f64, joints: &[Jet; 6]) -> Pose<Jet> {
        let s = Jet::variable(from, to);
        if self.own {
            let pose = self.leg.controller_pose(s, joints, self.controller_jet);
            return self.leg.real_from_nominal(s, pose);
        }
        let k = Jet::constant;
        let s = k(self.from) + s * k(self.to - self.from);
        // of another move only a joint path needs its joints, which are linear in s
        let joints = match &self.leg.course {
            crate::motion::course::Course::Joint { from, to } => {
                std::array::from_fn(|i| k(from[i]) + k(to[i] - from[i]) * s)
            }
            crate::motion::course::Course::Tool(_) => *joints,
        };
        let pose = self.leg.controller_pose(s, &joints, self.controller_jet);
        self.leg.real_from_nominal(s, pose)
    }
}

/// A sample of the difference.
#[derive(Clone, Copy)]
struct Sample {
    s: f64,
    joints: [f64; 6],
    distance_m: f64,
    /// Frobenius norm of the difference of the rotation matrices.
    turned: f64,
}

struct Open<'a> {
    a: Sample,
    b: Sample,
    conditions: &'a Conditions,
    /// How often it may still be halved.
    depth: u32,
}

fn angle(turned: f64) -> f64 {
    let sine = turned / (2.0 * std::f64::consts::SQRT_2);
    2.0 * if sine > 1.0 { 1.0 } else { sine }.asin()
}

/// The error of the real tool's path against the wanted one.
pub(crate) fn path_error(
    leg: &Leg,
    pieces: &[Piece],
    wanted: &Wanted,
    models: &Models<f64>,
    jets: &Models<Jet>,
) -> PathError {
    let sample = |s: f64, near: &[f64; 6], conditions: &Conditions| {
        let joints = leg.joints(s, near);
        let real = models.real.forward(&joints, conditions);
        let wanted = wanted.at(s, &joints);
        let (a, b) = (&real.rotation.0, &wanted.rotation.0);
        let turned = (0..9)
            .map(|i| (a[i / 3][i % 3] - b[i / 3][i % 3]).powi(2))
            .sum::<f64>();
        Sample {
            s,
            joints,
            distance_m: norm(sub(real.translation, wanted.translation)),
            turned: turned.sqrt(),
        }
    };
    let mut found = PathError {
        certified: true,
        ..PathError::default()
    };
    let mut low = (0.0, 0.0);
    let mut seen = |sample: &Sample, low: &mut (f64, f64)| {
        if sample.distance_m > low.0 {
            found.at = sample.s;
        }
        *low = (
            larger(low.0, sample.distance_m),
            larger(low.1, sample.turned),
        );
    };
    let mut open = Vec::new();
    let mut all_certain = true;
    let mut last: Option<(Sample, &Conditions)> = None;
    for piece in pieces {
        let before = last.filter(|(sample, conditions)| {
            sample.s == piece.from && **conditions == piece.conditions
        });
        let begin = before.map_or_else(
            || sample(piece.from, &piece.start, &piece.conditions),
            |(sample, _)| sample,
        );
        let end = sample(piece.to, &begin.joints, &piece.conditions);
        seen(&begin, &mut low);
        seen(&end, &mut low);
        all_certain &= piece.certified;
        open.push(Open {
            a: begin,
            b: end,
            conditions: &piece.conditions,
            depth: if piece.is_bounded() { DEEPEST } else { SAMPLED },
        });
        last = Some((end, &piece.conditions));
    }
    if low.0.is_nan() || low.1.is_nan() {
        // halving ends nowhere
        open.clear();
    }
    let (mut high, mut far) = ((0.0_f64, 0.0_f64), (0.0_f64, 0.0_f64));
    while let Some(Open {
        a,
        b,
        conditions,
        depth,
    }) = open.pop()
    {
        let middle = sample(0.5 * (a.s + b.s), &a.joints, conditions);
        seen(&middle, &mut low);
        let enclosed = leg.enclose(a.s, b.s, &middle.joints);
        let real = jets.real.forward(&enclosed.joints, conditions);
        let wish = wanted.over(a.s, b.s, &enclosed.joints);
        let mut bends = [0.0; 2];
        for i in 0..3 {
            let bend = (real.translation[i] - wish.translation[i]).bend.magnitude();
            bends[0] += bend * bend;
            for j in 0..3 {
                let bend = (real.rotation.0[i][j] - wish.rotation.0[i][j])
                    .bend
                    .magnitude();
                bends[1] += bend * bend;
            }
        }
        // both halves have the middle as a sample: a quarter of the gap
        let half = 0.5 * (b.s - a.s);
        let [line, turn] = bends.map(|bend| bend.sqrt() * half * half / 8.0);
        let bound = (
            a.distance_m.max(b.distance_m).max(middle.distance_m) + line,
            a.turned.max(b.turned).max(middle.turned) + turn,
        );
        let close = |bound: f64, low: f64, slack: f64| bound <= low + slack.max(CLOSE_PART * low);
        let is_whole =
            !enclosed.certified || (enclosed.holds(&a.joints) && enclosed.holds(&b.joints));
        let is_near = bound.0 < low.0 + SAYS_M && bound.1 < low.1 + SAYS_RAD;
        let is_close = close(bound.0, low.0, CLOSE_M) && close(bound.1, low.1, CLOSE_RAD);
        if is_close && is_whole {
            high = (high.0.max(bound.0), high.1.max(bound.1));
        } else if depth > 0 {
            for (a, b) in [(a, middle), (middle, b)] {
                open.push(Open {
                    a,
                    b,
                    conditions,
                    depth: depth - 1,
                });
            }
        } else if is_whole && is_near {
            high = (high.0.max(bound.0), high.1.max(bound.1));
        } else if is_whole && enclosed.certified && bound.0.is_finite() && bound.1.is_finite() {
            far = (far.0.max(bound.0), far.1.max(bound.1));
        } else {
            // it leaps from one posture to another, or at a singularity nothing bounds the joints'
            // rates: what is between the samples is unknown
            found.certified = false;
        }
    }
    found.certified &= all_certain;
    if found.certified {
        high = (high.0.max(far.0), high.1.max(far.1));
    }
    found.sampled = Separation {
        distance_m: low.0,
        angle_rad: angle(low.1),
    };
    found.bound = Separation {
        distance_m: larger(high.0, low.0),
        angle_rad: angle(larger(high.1, low.1)),
    };
    found
}
