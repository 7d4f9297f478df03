//! Many postures at once, four side by side in vector registers.

use super::{Conditions, Model};
use crate::geometry::{Lanes, Pose, Rotation};
use pulp::Arch;

/// Postures or targets side by side.
pub(crate) const WIDTH: usize = 4;
/// That many numbers.
pub(crate) type Four = Lanes<WIDTH>;

/// [`Model::forward`] of many postures, with the widest vector instructions that this processor has.
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
            let rows: [[f64; 6]; WIDTH] =
                std::array::from_fn(|lane| self.q[(start + lane).min(count - 1)]);
            let pose = self.model.forward(&side_by_side(rows), self.conditions);
            self.poses
                .extend((0..WIDTH.min(count - start)).map(|lane| lane_of(&pose, lane)));
        }
    }
}

/// Rows of numbers as numbers of rows.
#[inline(always)]
pub(crate) fn side_by_side<const N: usize>(rows: [[f64; N]; WIDTH]) -> [Four; N] {
    std::array::from_fn(|i| Lanes(rows.map(|row| row[i])))
}

#[inline(always)]
fn lane_of(pose: &Pose<Four>, lane: usize) -> Pose {
    Pose {
        rotation: Rotation(pose.rotation.0.map(|row| row.map(|x| x.0[lane]))),
        translation: pose.translation.map(|x| x.0[lane]),
    }
}
