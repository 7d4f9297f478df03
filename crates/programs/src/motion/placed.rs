//! Where bases and work frames are in the world, by where external axes stand.

use super::ride;
use crate::geometry::{Pose, Vector};
use crate::model::effects::Effect;
use crate::model::external::At;
use crate::profile::Profile;
use crate::program::{Frame, Stand};

/// Where the real base and the nominal one are in the world, from where they are at home, on a work
/// piece that is carried where the controller has it: with each external axis at a part of its
/// travel that `draw` gives, from 0 to 1.
pub(crate) fn bases(profile: &Profile, mut draw: impl FnMut() -> f64) -> [Pose; 2] {
    let external = &profile.external;
    let mut values = Vec::new();
    for axis in external.listed() {
        let (low, high) = axis.limits();
        // a rotary axis goes round once at most: beyond, everything repeats
        let high = if axis.is_linear() {
            high
        } else {
            high.min(low + std::f64::consts::TAU)
        };
        values.push(low + (high - low) * draw());
    }
    if values.is_empty() {
        return [Pose::identity(); 2];
    }
    let effects = profile.real_effects();
    // where nothing asks for them none are drawn
    let is_directed = effects
        .iter()
        .any(|of| of.definition().needs_external_directions());
    let drawn = values.iter().filter(|_| is_directed);
    let directions: Vec<_> = drawn
        .map(|_| if draw() < 0.5 { -1.0 } else { 1.0 })
        .collect();
    let at = At {
        values: &values,
        directions: &directions,
    };
    let origin = profile.world_from_base.translation;
    let mut nominal = external.base_nominal(&values);
    let positioners = external.positioners.len();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    if positioners > 0 {
        let which = ((draw() * positioners as f64) as usize).min(positioners - 1);
        let part = external.plate(which, at, &effects) * external.plate(which, at, &[]).inverse();
        nominal = part * nominal;
    }
    [external.base_real(at, origin, &effects), nominal]
}

/// A work frame where external axes stand, seen from the world of an arm that stands at home: with
/// the base where it is with every axis of the track at zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    /// Of the controller: what a target's numbers are relative to.
    pub nominal: Pose,
    /// Of the controller, where the part as it stands has it.
    pub meant: Pose,
    /// Of the real arm, where the part as it stands has it.
    pub real: Pose,
    /// Where home is seen from the real world, nominally and really.
    pub home_from_world: [Pose; 2],
    /// Gravity in the world of the real arm where its base leans.
    pub gravity_m_s2: Option<Vector>,
}

impl Placed {
    /// A frame that stands still in the world.
    pub(crate) fn still(world_from_frame: Pose) -> Self {
        Self {
            nominal: world_from_frame,
            meant: world_from_frame,
            real: world_from_frame,
            home_from_world: [Pose::identity(); 2],
            gravity_m_s2: None,
        }
    }

    /// A frame of a program; `world_from_frame` is what its numbers say.
    pub(crate) fn of(profile: &Profile, frame: &Frame, world_from_frame: Pose) -> Self {
        match &frame.stand {
            None => Self::still(world_from_frame),
            Some(stand) => Self::at(profile, stand, world_from_frame),
        }
    }

    /// A frame where external axes stand.
    pub(crate) fn at(profile: &Profile, stand: &Stand, world_from_frame: Pose) -> Self {
        let external = &profile.external;
        let at = At {
            values: &stand.values,
            directions: &stand.directions,
        };
        let effects = profile.real_effects();
        let plate = |effects: &[Effect]| {
            stand.positioner.map_or(Pose::identity(), |positioner| {
                external.plate(positioner, at, effects)
            })
        };
        let base_nominal = external.base_nominal(at.values);
        let origin = profile.world_from_base.translation;
        let base_real = external.base_real(at, origin, &effects);
        let (nominal, real) = if stand.of_joints {
            (
                base_nominal,
                plate(&effects) * plate(&[]).inverse() * base_nominal,
            )
        } else {
            let riding = if stand.on_base {
                base_nominal
            } else {
                external.riding(at.values)
            };
            (
                riding * plate(&[]) * world_from_frame,
                riding * plate(&effects) * world_from_frame,
            )
        };
        let home_from_world = [base_nominal.inverse(), base_real.inverse()];
        let leans = ride::leans(&base_real.rotation);
        Self {
            nominal: home_from_world[0] * nominal,
            meant: home_from_world[0] * nominal,
            real: home_from_world[1] * real,
            home_from_world,
            gravity_m_s2: leans.then(|| home_from_world[1].rotation * profile.gravity_m_s2),
        }
    }

    /// With the part moved in the world from where the controller has it: what the positioner that
    /// carries it does wrong is in what was measured.
    pub(crate) fn moved(self, offset: &Pose) -> Self {
        let [nominal_home, real_home] = self.home_from_world;
        let world_from_frame = *offset * nominal_home.inverse() * self.nominal;
        Self {
            meant: nominal_home * world_from_frame,
            real: real_home * world_from_frame,
            ..self
        }
    }
}
