//! Many postures at once, four side by side in vector registers.

use super::{Conditions, Model};
use crate::geometry::{Four, Pose, Scalar, WIDTH};
use pulp::Arch;

/// [`Model::forward`] of many postures, with the widest vector instructions that this processor
/// has.
#[must_use]
pub fn forward_batch(model: &Model, conditions: &Conditions, q: &[[f64; 6]]) -> Vec<Pose> {
    let four = model.cast::<Four>();
    let mut poses = Vec::with_capacity(q.len());
    Arch::new().dispatch(Kernel {
        model: &four,
        conditions,
        q,
        poses: &mut poses,
    });
    poses
}

struct Kernel<'a> {
    model: &'a Model<Four>,
    conditions: &'a Conditions,
    q: &'a [[f64; 6]],
    poses: &'a mut Vec<Pose>,
}

impl pulp::NullaryFnOnce for Kernel<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let count = self.q.len();
        for start in (0..count).step_by(WIDTH) {
            // past the end the last posture is repeated and its pose dropped
            let lanes: [usize; WIDTH] = std::array::from_fn(|lane| (start + lane).min(count - 1));
            let q = side_by_side(lanes.map(|i| &self.q[i]));
            let pose = self.model.forward_here(&q, self.conditions);
            for lane in 0..WIDTH.min(count - start) {
                self.poses.push(lane_of(&pose, lane));
            }
        }
    }
}

/// Rows of numbers as numbers of rows.
#[inline(always)]
pub fn side_by_side<const N: usize>(rows: [&[f64; N]; WIDTH]) -> [Four; N] {
    let mut columns = [Four::zero(); N];
    for (lane, row) in rows.iter().enumerate() {
        for i in 0..N {
            columns[i].0[lane] = row[i];
        }
    }
    columns
}

/// One of four poses.
#[inline(always)]
pub fn lane_of(pose: &Pose<Four>, lane: usize) -> Pose {
    let mut one = Pose::identity();
    for i in 0..3 {
        for j in 0..3 {
            one.rotation.0[i][j] = pose.rotation.0[i][j].0[lane];
        }
        one.translation[i] = pose.translation[i].0[lane];
    }
    one
}
