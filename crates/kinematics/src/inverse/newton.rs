//! Damped Newton on the exact Jacobian, for postures where the pose shift stalls.
//!
//! Levenberg–Marquardt: `(Jᵀ J + λ D) δq = Jᵀ e` with the six components of the missing motion `e`,
//! the Jacobian from dual numbers, and λ raised until the error falls. Near an aligned wrist or a
//! stretched elbow the first posture may be on the wrong side of a ridge, so a few starts next to
//! it are tried, all on the wanted branch.
//!
//! # Source
//! D. W. Marquardt, J. SIAM 11 (1963); S. R. Buss, "Introduction to inverse kinematics" (2004) for
//! the error vector.

use super::branch::Branch;
use super::closed_form::{Arm, Margins};
use super::pose_shift::{Inverse, within};
use crate::geometry::{Dual, Pose, Rotation, Separation, norm, sub};
use crate::model::{Conditions, Model};
use nalgebra::{SMatrix, SVector};

const MOST_ITERATIONS: u32 = 60;
/// Evaluations after which no further start is tried: where an answer is to be had, it is mostly
/// found within some dozens.
const MOST_EVALUATIONS: u32 = 2000;
/// A descent that does not lower the error by this share in so many steps has come to rest.
const STALLS: (f64, u32) = (0.01, 4);
/// A posture with the tool nearer to the target than this is a start of its own, metres and
/// radians.
const NEAR_TARGET: (f64, f64) = (0.1, 0.3);
/// Where the joints bring the tool nearer at less than this rate, metres and radians a radian, the
/// descent is at its least error.
const AT_REST: f64 = 0.03;
const LEAST_DAMPING: f64 = 1e-12;
const MOST_DAMPING: f64 = 1e6;
/// Larger steps could jump to another branch.
const MOST_STEP_RAD: f64 = 0.5;
/// Where the arm is straight or the wrist aligned, starts this far from it are tried, radians.
const ASIDE_RAD: [f64; 3] = [0.003, 0.03, 0.2];
/// Where the wrist centre lies on axis 1, starts on rings about it are tried: how many on each, and
/// their radii in metres.
const RING: u32 = 12;
const RINGS_M: [f64; 4] = [0.0005, 0.001, 0.002, 0.004];
/// A wrist centre nearer to axis 1, and a joint nearer to straight, is searched around.
const NEAR_AXIS_1_M: f64 = 0.008;
const NEAR_STRAIGHT_RAD: f64 = 0.15;
/// Where the two first starts end farther from the wanted pose, no other start can help: the pose
/// is out of reach.
const HOPELESS_M: f64 = 0.002;
/// A metre at the tip counts as much as so many radians where not all can be had.
const TIP_FIRST: f64 = 1e4;
/// Turns of joint 4 against joint 6 that are tried at an aligned wrist, as parts of a right angle.
const WRIST_TURNS: [f64; 4] = [0.0, 1.0, 2.0, 3.0];

/// The best posture found.
pub(super) struct Found {
    pub q: [f64; 6],
    pub residual: Separation,
    pub iterations: u32,
    /// Whether no joint brings the tool nearer.
    pub is_at_rest: bool,
}

impl Found {
    pub(super) fn is_done(&self) -> bool {
        within(self.residual.distance_m, self.residual.angle_rad)
    }

    fn size(&self) -> f64 {
        self.residual.distance_m + self.residual.angle_rad
    }
}

/// The descent from `near`, where the real tool is near to `wanted` there.
pub(super) fn from_near(inverse: &Inverse, wanted: &Pose, near: &[f64; 6]) -> Option<Found> {
    let Inverse {
        real, conditions, ..
    } = inverse;
    let gap = real.forward(near, conditions).separation(wanted);
    let is_near = gap.distance_m < NEAR_TARGET.0 && gap.angle_rad < NEAR_TARGET.1;
    is_near.then(|| descend(&real.cast(), conditions, wanted, near, None))
}

/// The descent from `near` with one joint held where it is: the tool's tip goes to `wanted`, its
/// orientation as near as may be.
pub(super) fn held(inverse: &Inverse, wanted: &Pose, near: &[f64; 6], joint: usize) -> Found {
    let Inverse {
        real, conditions, ..
    } = inverse;
    descend(&real.cast(), conditions, wanted, near, Some(joint))
}

/// Searches from the given start and the nominal solution, then from starts besides the
/// singularities that these are near to, until one ends at `wanted` on `branch`.
pub(super) fn solve(
    inverse: &Inverse,
    wanted: &Pose,
    branch: Branch,
    near: &[f64; 6],
    start: &[f64; 6],
    nominal: &[f64; 6],
) -> Found {
    let Inverse {
        arm,
        real,
        conditions,
    } = inverse;
    let is_meant = |found: &Found| {
        found.is_done() && (arm.posture(&found.q).0 == branch || inverse.follows(&found.q, nominal))
    };
    let mut best: Option<Found> = None;
    let mut spent = 0;
    let real = real.cast();
    let (first, then) = (
        [*start, *nominal],
        near_singularities(arm, wanted, branch, near, *nominal),
    );
    for (number, q) in first.into_iter().chain(then).enumerate() {
        if spent > MOST_EVALUATIONS {
            break;
        }
        let found = descend(&real, conditions, wanted, &q, None);
        spent += found.iterations;
        if is_meant(&found) {
            return Found {
                iterations: spent,
                ..found
            };
        }
        if best
            .as_ref()
            .is_none_or(|best| !best.is_done() && found.size() < best.size())
        {
            best = Some(found);
        }
        let hopeless = best
            .as_ref()
            .is_some_and(|best| best.residual.distance_m > HOPELESS_M);
        if hopeless && number + 1 == first.len() {
            break;
        }
    }
    let best = best.expect("there is at least one start");
    Found {
        iterations: spent,
        ..best
    }
}

/// Postures besides each singularity that `nominal` is near to, on the wanted branch.
fn near_singularities(
    arm: &Arm,
    wanted: &Pose,
    branch: Branch,
    near: &[f64; 6],
    nominal: [f64; 6],
) -> impl Iterator<Item = [f64; 6]> {
    let margins = arm.posture(&nominal).1;
    let rings = if margins.shoulder_m < NEAR_AXIS_1_M {
        &RINGS_M[..]
    } else {
        &[]
    };
    let steps = if margins.wrist_rad.min(margins.elbow_rad) < NEAR_STRAIGHT_RAD {
        &ASIDE_RAD[..]
    } else {
        &[]
    };
    let around = rings.iter().flat_map(move |&radius| {
        (0..RING).map(move |k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(RING);
            arm.solve_branch(&arm.displaced(wanted, radius, angle), branch, near)
                .q
        })
    });
    let aside = move |q: [f64; 6]| {
        let turned = |by: f64| {
            WRIST_TURNS
                .iter()
                .map(move |turn| (by, turn * std::f64::consts::FRAC_PI_2))
        };
        steps
            .iter()
            .flat_map(move |&by| turned(by))
            .map(move |(by, turn)| near_singularity(arm, &q, branch, by, turn))
    };
    around
        .clone()
        .chain(aside(nominal))
        .chain(around.flat_map(aside))
}

/// A posture near the singularities that `q` is near to, on the wanted side of each.
fn near_singularity(arm: &Arm, q: &[f64; 6], branch: Branch, by: f64, turn: f64) -> [f64; 6] {
    let mut q = *q;
    let Margins {
        wrist_rad,
        elbow_rad,
        ..
    } = arm.posture(&q).1;
    // a step in either direction of the joint: keep the one that ends on the wanted side
    let mut step = |joint: usize, margin: f64, by: f64, wanted: fn(Branch) -> bool| {
        if margin < by {
            let tried = [1.0, -1.0].map(|side| {
                let mut tried = q;
                tried[joint] += side * (by + margin);
                tried
            });
            let side = tried
                .iter()
                .find(|t| wanted(arm.posture(t).0) == wanted(branch));
            q = *side.unwrap_or(&tried[0]);
        }
    };
    step(2, elbow_rad, by, |b| b.behind_lower_arm);
    step(4, wrist_rad, by, |b| b.joint_5_negative);
    if wrist_rad < by {
        q[3] += turn;
        q[5] -= turn;
    }
    q
}

/// The arm near one posture: what is missing, and how the joints change it.
struct Linearized {
    error: SVector<f64, 6>,
    jacobian: SMatrix<f64, 6, 6>,
    gap: Separation,
}

impl Linearized {
    /// Without one joint; with six demands on five joints those of the tip go first.
    fn hold(&mut self, joint: usize) {
        self.jacobian.column_mut(joint).fill(0.0);
        for row in 0..3 {
            self.error[row] *= TIP_FIRST;
            self.jacobian.row_mut(row).scale_mut(TIP_FIRST);
        }
    }
}

/// Levenberg–Marquardt from one start; with a joint held, distances count more than angles.
fn descend(
    real: &Model<Dual<6>>,
    conditions: &Conditions,
    wanted: &Pose,
    start: &[f64; 6],
    held: Option<usize>,
) -> Found {
    let linearize = |q: &[f64; 6]| {
        let mut here = linearize(real, conditions, wanted, q);
        if let Some(joint) = held {
            here.hold(joint);
        }
        here
    };
    let mut q = *start;
    let mut here = linearize(&q);
    let mut lambda = LEAST_DAMPING;
    let mut iterations = 1;
    let mut idle = 0;
    while iterations < MOST_ITERATIONS && lambda < MOST_DAMPING && idle < STALLS.1 {
        let trial = stepped(&q, &here, lambda);
        let there = linearize(&trial);
        iterations += 1;
        let (before, after) = (here.error.norm(), there.error.norm());
        if after < before {
            let settled = within(here.gap.distance_m, here.gap.angle_rad);
            let is_idle = after > (1.0 - STALLS.0) * before;
            idle = if is_idle { idle + 1 } else { 0 };
            (q, here) = (trial, there);
            lambda = (0.1 * lambda).max(LEAST_DAMPING);
            if settled {
                break;
            }
        } else if within(here.gap.distance_m, here.gap.angle_rad) {
            break;
        } else {
            lambda *= 10.0;
        }
    }
    let slope = here.jacobian.transpose() * here.error;
    Found {
        q,
        residual: here.gap,
        iterations,
        is_at_rest: slope.norm() < AT_REST * here.error.norm(),
    }
}

fn linearize(
    real: &Model<Dual<6>>,
    conditions: &Conditions,
    wanted: &Pose,
    q: &[f64; 6],
) -> Linearized {
    let variables = std::array::from_fn(|i| Dual::variable(q[i], i));
    let reached = real.forward(&variables, conditions);
    let rotation = Rotation(reached.rotation.0.map(|row| row.map(|x| x.value)));
    let missing = wanted.rotation * rotation.transpose();
    let distance = sub(wanted.translation, reached.translation.map(|x| x.value));
    let turn = missing.vector();
    let error = SVector::from([
        distance[0],
        distance[1],
        distance[2],
        turn[0],
        turn[1],
        turn[2],
    ]);
    let mut jacobian = SMatrix::zeros();
    for j in 0..6 {
        // dR/dq · Rᵀ is the cross-product matrix of the angular velocity
        let slope = Rotation(reached.rotation.0.map(|row| row.map(|x| x.slope[j])));
        let spin = (slope * rotation.transpose()).sine_axis();
        for i in 0..3 {
            jacobian[(i, j)] = reached.translation[i].slope[j];
            jacobian[(i + 3, j)] = spin[i];
        }
    }
    let gap = Separation {
        distance_m: norm(distance),
        angle_rad: norm(turn),
    };
    Linearized {
        error,
        jacobian,
        gap,
    }
}

/// One damped step, no joint by more than [`MOST_STEP_RAD`].
fn stepped(q: &[f64; 6], here: &Linearized, lambda: f64) -> [f64; 6] {
    let mut normal = here.jacobian.transpose() * here.jacobian;
    for i in 0..6 {
        normal[(i, i)] += lambda * (normal[(i, i)] + 1e-6);
    }
    let right = here.jacobian.transpose() * here.error;
    let step = normal
        .cholesky()
        .map_or(right * 1e-3, |factors| factors.solve(&right));
    let scale = (MOST_STEP_RAD / step.amax()).min(1.0);
    std::array::from_fn(|i| q[i] + scale * step[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::effects::{Effect, Kind, Site};
    use crate::model::{Model, example};

    #[test]
    fn jacobian_agrees_with_central_differences() {
        let conditions = Conditions::default();
        let effect = |kind, index, parameters: [f64; 2]| Effect {
            kind,
            site: Site {
                index,
                ..Site::default()
            },
            parameters: [parameters[0], parameters[1], 0.0, 0.0, 0.0, 0.0],
        };
        let effects = [
            effect(Kind::JointCompliance, 1, [3.2e-5, 0.0]),
            effect(Kind::JointCompliance, 4, [4.19e-4, 0.0]),
            effect(Kind::LinkGeometry, 2, [1e-3, 2e-4]),
        ];
        let (geometry, mechanism) = (example::geometry(), example::mechanism());
        let real = Model::build(&geometry, &mechanism, &effects, &conditions);
        let q = [0.3, -0.4, 0.5, 0.6, -0.7, 0.8];
        let wanted = real.forward(&q, &conditions);
        let here = linearize(&real.cast(), &conditions, &wanted, &q);
        assert!(here.error.norm() < 1e-14);
        let step = 1e-6;
        for j in 0..6 {
            let moved = |by: f64| {
                let mut q = q;
                q[j] += by;
                linearize(&real.cast(), &conditions, &wanted, &q).error
            };
            let slope = (moved(-step) - moved(step)) / (2.0 * step);
            assert!((slope - here.jacobian.column(j)).norm() < 1e-9, "joint {j}");
        }
    }
}
