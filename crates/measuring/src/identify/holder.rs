//! What holds measured points: the arm's tool, or the plate of a positioner.

use super::problem::Estimate;
use crate::geometry::{Dual, Pose, Rotation, Scalar};
use crate::model::effects::Effect;
use crate::model::external::{At, ExternalAxes, Stand};
use crate::model::{Conditions, FourSensitivities, Motion, Sensitivity, Slot};

/// What holds the measured points of some rows, with its derivatives.
#[derive(Clone, Debug)]
pub enum Holder {
    /// The arm, whose tool is where the row's joints put it.
    Arm(Box<Sensitivity>),
    /// A plate where the positioner's axes stand.
    Plate(Plate),
}

/// A plate that stands somewhere.
#[derive(Clone, Debug)]
pub struct Plate {
    world_from_plate: Pose,
    motions: Vec<Motion>,
}

impl Holder {
    /// Where the points' frame is in the world at the controller's joint angles `q`, radians;
    /// `motions` receives one motion a parameter.
    pub fn evaluate(&self, q: &[f64; 6], conditions: &Conditions, motions: &mut [Motion]) -> Pose {
        match self {
            Self::Arm(arm) => arm.evaluate(q, conditions, motions),
            Self::Plate(plate) => {
                motions.copy_from_slice(&plate.motions);
                plate.world_from_plate
            }
        }
    }

    /// The arm for four postures side by side, where it can.
    #[inline(always)]
    pub(super) fn four(&self) -> Option<FourSensitivities<'_>> {
        match self {
            Self::Arm(arm) => arm.four(),
            Self::Plate(_) => None,
        }
    }

    /// Torques at the joints, newton metres: none of what the arm does not carry.
    #[must_use]
    pub fn torques(&self, q: &[f64; 6], conditions: &Conditions) -> [f64; 6] {
        match self {
            Self::Arm(arm) => arm.model().torques(q, conditions),
            Self::Plate(_) => [0.0; 6],
        }
    }
}

impl Plate {
    /// The plate of a positioner, by its index, with the derivatives by the parameters `slots`:
    /// one evaluation with a dual number each.
    #[must_use]
    pub fn of(
        axes: &ExternalAxes,
        (positioner, stand): (usize, &Stand),
        estimate: &Estimate,
        slots: &[Slot],
    ) -> Self {
        let values: Vec<Dual<1>> = stand.values.iter().map(|e| Dual::constant(*e)).collect();
        let at = At {
            values: &values,
            directions: &stand.directions,
        };
        let motions = slots.iter().map(|slot| {
            let mut dual: Vec<Effect<Dual<1>>> =
                estimate.effects.iter().map(Effect::cast).collect();
            dual[slot.effect].parameters[slot.parameter].slope = [1.0];
            motion_of(&axes.plate(positioner, at, &dual))
        });
        Self {
            world_from_plate: axes.plate(positioner, stand.at(), &estimate.effects),
            motions: motions.collect(),
        }
    }
}

/// How a frame moves along the world's axes: `dR Rᵀ` as a vector, and `dt`.
fn motion_of(pose: &Pose<Dual<1>>) -> Motion {
    let value = Rotation(pose.rotation.0.map(|row| row.map(|x| x.value)));
    let slope = Rotation(pose.rotation.0.map(|row| row.map(|x| x.slope[0])));
    Motion {
        turn_rad: (slope * value.transpose()).sine_axis(),
        shift_m: pose.translation.map(|x| x.slope[0]),
    }
}
