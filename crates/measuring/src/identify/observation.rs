//! What a model expects of a row: residual and derivatives.

use super::contact::{ContactKind, Touch};
use super::measurements::Observed;
use super::problem::{PointRef, Row};
use crate::geometry::{Pose, Rotation, Vector, add, cross, dot, norm, sub};
use crate::model::Motion;

/// Most numbers a row has.
pub const MOST_NUMBERS: usize = 6;

/// Measured minus expected, in standard deviations, and what the parameters do to the expectation.
#[derive(Clone, Copy, Debug)]
pub struct Observation<'a> {
    row: &'a Row,
    world_from_tool: Pose,
    /// The measured point from the tool's origin, along the world's axes.
    arm: Vector,
    /// Direction of a distance.
    toward: Vector,
    /// What a contact leaves and what its feature does.
    touch: Touch,
}

impl<'a> Observation<'a> {
    /// What is expected at this pose of the tool with the point at `point_in_tool_m`.
    #[inline(always)]
    #[must_use]
    pub fn new(row: &'a Row, world_from_tool: Pose, point_in_tool_m: Vector) -> Self {
        let arm = world_from_tool.rotation * point_in_tool_m;
        let mut toward = [0.0; 3];
        if let Observed::Distance { from_m, .. } = row.observed {
            let gap = sub(add(world_from_tool.translation, arm), from_m);
            let length = norm(gap);
            if length > 0.0 {
                toward = gap.map(|x| x / length);
            }
        }
        Self {
            row,
            world_from_tool,
            arm,
            toward,
            touch: Touch::default(),
        }
    }

    /// With what its contact leaves.
    #[inline(always)]
    pub(super) fn touch(&mut self, touch: Touch) {
        self.toward = touch.toward;
        self.touch = touch;
    }

    /// Where the point is expected in the world, metres.
    #[inline(always)]
    #[must_use]
    pub fn expected_m(&self) -> Vector {
        add(self.world_from_tool.translation, self.arm)
    }

    /// Measured minus expected in metres: three coordinates, then three components of the rotation
    /// vector in radians for a pose, or one distance. The first [`Observed::count`] numbers
    /// hold.
    #[inline(always)]
    #[must_use]
    pub fn gap(&self) -> [f64; MOST_NUMBERS] {
        let expected = self.expected_m();
        match self.row.observed {
            Observed::Position(seen) => {
                let [x, y, z] = sub(seen, expected);
                [x, y, z, 0.0, 0.0, 0.0]
            }
            Observed::Pose(seen) => {
                let [x, y, z] = sub(seen.translation, expected);
                let turn: Rotation = seen.rotation * self.world_from_tool.rotation.transpose();
                let [a, b, c] = turn.vector();
                [x, y, z, a, b, c]
            }
            Observed::Distance { distance_m, from_m } => {
                let length = norm(sub(expected, from_m));
                [distance_m - length, 0.0, 0.0, 0.0, 0.0, 0.0]
            }
            Observed::Contact(_) => {
                let [x, y, z] = self.touch.gap;
                [x, y, z, 0.0, 0.0, 0.0]
            }
        }
    }

    /// One over the standard deviation of each number.
    #[inline(always)]
    #[must_use]
    pub fn weights(&self) -> [f64; MOST_NUMBERS] {
        let length = 1.0 / self.row.sigma_m;
        let angle = 1.0 / self.row.sigma_rad;
        [length, length, length, angle, angle, angle]
    }

    /// What a motion of the tool does to the expectation.
    ///
    /// The gap of a touched point is taken along axes that turn with the tool: it is as long, and
    /// turns of the arm and of the unknown point together leave it as it is, whatever is left
    /// of it.
    #[inline(always)]
    #[must_use]
    pub fn slope(&self, motion: &Motion) -> [f64; MOST_NUMBERS] {
        let arm = match self.row.observed {
            Observed::Contact(ContactKind::Point) => add(self.arm, self.touch.gap),
            _ => self.arm,
        };
        let shift = add(motion.shift_m, cross(motion.turn_rad, arm));
        self.of_shift(shift, motion.turn_rad)
    }

    /// What growth of one coordinate of the point in the tool frame does; zero where `point` is
    /// another one.
    #[inline(always)]
    #[must_use]
    pub fn slope_of_point(&self, point: usize, axis: usize) -> [f64; MOST_NUMBERS] {
        if self.row.point == PointRef::Named(point) {
            self.of_shift(self.world_from_tool.rotation.axis(axis), [0.0; 3])
        } else {
            [0.0; MOST_NUMBERS]
        }
    }

    /// What growth of one number of a touched feature does; zero where the row touches another one.
    #[inline(always)]
    #[must_use]
    pub fn slope_of_feature(&self, feature: usize, value: usize) -> [f64; MOST_NUMBERS] {
        let mut slope = [0.0; MOST_NUMBERS];
        match (self.row.observed, self.row.touched) {
            (Observed::Contact(kind), Some((mine, _))) if mine == feature => match kind {
                ContactKind::Point => slope[value] = -1.0,
                _ => slope[0] = self.touch.by_feature[value],
            },
            _ => {}
        }
        slope
    }

    #[inline(always)]
    fn of_shift(&self, [x, y, z]: Vector, turn: Vector) -> [f64; MOST_NUMBERS] {
        match self.row.observed {
            Observed::Position(_) | Observed::Contact(ContactKind::Point) => {
                [x, y, z, 0.0, 0.0, 0.0]
            }
            Observed::Pose(_) => [x, y, z, turn[0], turn[1], turn[2]],
            Observed::Distance { .. } | Observed::Contact(_) => {
                [dot(self.toward, [x, y, z]), 0.0, 0.0, 0.0, 0.0, 0.0]
            }
        }
    }
}
