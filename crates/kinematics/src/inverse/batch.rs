//! Many targets at once, four side by side in vector registers.

use super::branch::Branch;
use super::closed_form::Stance;
use super::outcome::{Landed, Method, Methods, Outcome, Spent, Status};
use super::pose_shift::{Inverse, step, within};
use crate::geometry::{Four, Pose, Separation, WIDTH};
use crate::model::Model;
use crate::model::batch::side_by_side;
use pulp::Arch;

/// Steps after which the targets of a group that have not converged are left to the slow way.
const MOST_STEPS: u32 = 7;

/// What to solve: as many poses as branches and nearby joint angles.
#[derive(Clone, Copy, Debug)]
pub struct Targets<'a> {
    /// `world_from_tool` of each.
    pub wanted: &'a [Pose],
    /// The branch of each.
    pub branches: &'a [Branch],
    /// The controller's joint angles that each solution is nearest to by whole revolutions,
    /// radians.
    pub near: &'a [[f64; 6]],
}

/// Solves many targets with one tool under one set of conditions; the same outcomes as
/// [`Inverse::solve`] within its tolerances, in the same order.
///
/// The pose shift runs on four targets at a time with the widest vector instructions that this
/// processor has. Targets that do not converge in it are finished one by one.
///
/// # Panics
/// If the three slices differ in length: the caller's bug.
#[must_use]
pub fn solve_batch(inverse: &Inverse, targets: Targets) -> Vec<Outcome> {
    solve_batch_by(Methods::Auto, inverse, targets)
}

/// [`solve_batch`] with the methods that are allowed.
///
/// # Panics
/// If the three slices differ in length: the caller's bug.
#[must_use]
pub fn solve_batch_by(methods: Methods, inverse: &Inverse, targets: Targets) -> Vec<Outcome> {
    let count = targets.wanted.len();
    assert!(
        targets.branches.len() == count && targets.near.len() == count,
        "as many branches and seeds as poses"
    );
    let real = inverse.real.cast::<Four>();
    let mut outcomes = Vec::with_capacity(count);
    Arch::new().dispatch(Kernel {
        methods,
        inverse,
        real: &real,
        targets,
        outcomes: &mut outcomes,
    });
    outcomes
}

struct Kernel<'a> {
    methods: Methods,
    inverse: &'a Inverse,
    real: &'a Model<Four>,
    targets: Targets<'a>,
    outcomes: &'a mut Vec<Outcome>,
}

impl pulp::NullaryFnOnce for Kernel<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            methods,
            inverse,
            real,
            targets,
            outcomes,
        } = self;
        let count = targets.wanted.len();
        for start in (0..count).step_by(WIDTH) {
            // past the end the last target is repeated and its outcome dropped
            let lanes: [usize; WIDTH] = std::array::from_fn(|lane| (start + lane).min(count - 1));
            let wanted = gather(lanes.map(|i| &targets.wanted[i]));
            let near = side_by_side(lanes.map(|i| &targets.near[i]));
            let signs = side_by_side(lanes.map(|i| targets.branches[i].signs()).each_ref());
            let mut given = wanted;
            let mut iterations = 0;
            let last = loop {
                iterations += 1;
                let now = step(
                    &inverse.arm,
                    real,
                    &inverse.conditions,
                    &wanted,
                    &given,
                    signs,
                    &near,
                );
                let done = (0..WIDTH).all(|lane| within(now.distance.0[lane], now.angle.0[lane]));
                if done || iterations == MOST_STEPS {
                    break now;
                }
                given = now.next;
            };
            let angles = inverse.arm.angles(&last.turns, &near);
            let q = inverse.arm.mechanism().controller(&angles);
            let stance = inverse.arm.stance(&last.turns);
            for (lane, &target) in lanes.iter().enumerate().take(count - start) {
                let residual = Separation {
                    distance_m: last.distance.0[lane],
                    angle_rad: last.angle.0[lane],
                };
                let landed =
                    within(residual.distance_m, residual.angle_rad) && last.beyond.0[lane] == 0.0;
                let by_shift = landed.then(|| {
                    let stance = Stance {
                        wrist_rad: stance.wrist_rad.0[lane],
                        elbow_rad: stance.elbow_rad.0[lane],
                        shoulder_m: stance.shoulder_m.0[lane],
                    };
                    let landed = Landed {
                        q: q.map(|q| q.0[lane]),
                        stance: &stance,
                        residual,
                        method: Method::PoseShift,
                        spent: Spent {
                            shift: iterations,
                            newton: 0,
                        },
                        follows: false,
                    };
                    inverse.finish(targets.branches[target], &landed)
                });
                // what lands elsewhere than meant is looked at more closely
                let outcome = by_shift
                    .filter(|outcome| outcome.status == Status::Converged)
                    .unwrap_or_else(|| {
                        inverse.solve_by(
                            methods,
                            &targets.wanted[target],
                            targets.branches[target],
                            &targets.near[target],
                        )
                    });
                outcomes.push(outcome);
            }
        }
    }
}

#[inline(always)]
fn gather(poses: [&Pose; WIDTH]) -> Pose<Four> {
    let mut four = Pose::identity();
    for i in 0..3 {
        four.rotation.0[i] = side_by_side(poses.map(|p| &p.rotation.0[i]));
    }
    four.translation = side_by_side(poses.map(|p| &p.translation));
    four
}
