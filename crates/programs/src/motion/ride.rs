//! What external axes do along a move: all go at constant rates from where they stand to where they
//! stand then.

use crate::geometry::{Pose, Rotation, Scalar, Vector};
use crate::model::effects::Effect;
use crate::model::external::{At, ExternalAxes};
use crate::profile::Profile;
use crate::program::Stand;
use std::sync::Arc;

/// What external axes do along a move.
#[derive(Debug)]
pub(crate) struct Ride {
    external: ExternalAxes,
    effects: Vec<Effect>,
    origin: Vector,
    from: Vec<f64>,
    to: Vec<f64>,
    directions: Vec<f64>,
    positioner: Option<usize>,
    on_base: bool,
    of_joints: bool,
    /// The path is relative to the part that a positioner carries, and not to what the positioner
    /// stands on.
    on_part: bool,
    /// Where it begins is known of all axes that matter.
    is_known: bool,
}

impl Ride {
    /// Of the move that ends with a stand, and begins where each listed axis stands as far as that
    /// is known; `coordinated` says that its path is relative to what a positioner carries.
    pub(crate) fn of(
        profile: &Profile,
        from: &[Option<f64>],
        to: &Stand,
        coordinated: bool,
    ) -> Arc<Self> {
        let at = |k: usize| from.get(k).copied().flatten().unwrap_or(f64::NAN);
        let mut is_known = true;
        let begin = to.values.iter().enumerate().map(|(k, &end)| {
            is_known &= end.is_nan() || !at(k).is_nan();
            if at(k).is_nan() { end } else { at(k) }
        });
        let begin = begin.collect();
        Arc::new(Self {
            external: profile.external.clone(),
            effects: profile.real_effects(),
            origin: profile.world_from_base.translation,
            from: begin,
            to: to.values.to_vec(),
            directions: to.directions.to_vec(),
            positioner: to.positioner,
            on_base: to.on_base,
            of_joints: to.of_joints,
            on_part: coordinated,
            is_known,
        })
    }

    /// Whether all that is said of the way holds.
    pub(crate) fn is_known(&self) -> bool {
        self.is_known
    }

    /// Whether anything moves on the way.
    pub(crate) fn moves(&self) -> bool {
        self.from
            .iter()
            .zip(&self.to)
            .any(|(from, to)| from != to && !to.is_nan())
    }

    /// Whether what is a straight line in the work frame is none for the arm.
    pub(crate) fn bends(&self) -> bool {
        self.on_part && self.positioner.is_some() && self.moves()
    }

    /// How far linear axes go, metres, and rotary ones, radians.
    pub(crate) fn lengths(&self) -> (f64, f64) {
        let (mut length, mut angle) = (0.0, 0.0);
        for (k, (from, to)) in self.from.iter().zip(&self.to).enumerate() {
            let by = (to - from).abs();
            if by.is_nan() {
                continue;
            }
            if k < self.external.track.len() {
                length += by;
            } else {
                angle += by;
            }
        }
        (length, angle)
    }

    fn values<S: Scalar>(&self, s: S) -> Vec<S> {
        let ends = self.from.iter().zip(&self.to);
        ends.map(|(from, to)| {
            // what no pose depends on is not looked at
            let (from, by) = if to.is_nan() {
                (0.0, 0.0)
            } else {
                (*from, to - from)
            };
            S::constant(from) + S::constant(by) * s
        })
        .collect()
    }

    fn plate<S: Scalar>(&self, values: &[S], effects: &[Effect<S>]) -> Pose<S> {
        let at = At {
            values,
            directions: &self.directions,
        };
        self.positioner
            .map_or(Pose::identity(), |n| self.external.plate(n, at, effects))
    }

    /// Where the world of the controller's arm at home is at `s`.
    pub(crate) fn world_from_nominal_home<S: Scalar>(&self, s: S) -> Pose<S> {
        self.external.base_nominal(&self.values(s))
    }

    /// Where the world of the real arm at home is at `s`.
    pub(crate) fn world_from_real_home<S: Scalar>(&self, s: S) -> Pose<S> {
        let values = self.values(s);
        let effects: Vec<Effect<S>> = self.effects.iter().map(Effect::cast).collect();
        let at = At {
            values: &values,
            directions: &self.directions,
        };
        self.external.base_real(at, self.origin, &effects)
    }

    /// Where the plate of a positioner is in the world at `s`, really or as the controller has it.
    pub(crate) fn world_from_plate<S: Scalar>(
        &self,
        positioner: usize,
        s: S,
        real: bool,
    ) -> Pose<S> {
        let effects = if real { self.effects.as_slice() } else { &[] };
        let effects: Vec<Effect<S>> = effects.iter().map(Effect::cast).collect();
        let at = At {
            values: &self.values(s),
            directions: &self.directions,
        };
        self.external.plate(positioner, at, &effects)
    }

    /// What stands still for the path of the move, seen from the controller's arm at home at `s`.
    pub(crate) fn home_from_part<S: Scalar>(&self, s: S) -> Pose<S> {
        let values = self.values(s);
        let base = self.external.base_nominal(&values);
        if self.of_joints {
            return base.inverse();
        }
        let riding = if self.on_base {
            base
        } else {
            self.external.riding(&values)
        };
        let still = base.inverse() * riding;
        if self.on_part {
            still * self.plate(&values, &[])
        } else {
            still
        }
    }

    /// The pose that the arm at home has halfway for what a point on the way of an arc is on the
    /// part: external axes are written for the point as for a place of its own, and the arc goes
    /// through it on the part.
    fn halfway(&self, point: &Self, pose: &Pose) -> Pose {
        self.home_from_part(0.5) * point.home_from_part(1.0).inverse() * *pose
    }

    /// From a pose that the controller's arm at home has to the one that the real arm at home has
    /// where the real part wants it.
    pub(crate) fn real_from_nominal<S: Scalar>(&self, s: S) -> Pose<S> {
        let values = self.values(s);
        let effects: Vec<Effect<S>> = self.effects.iter().map(Effect::cast).collect();
        let part = self.plate(&values, &effects) * self.plate(&values, &[]).inverse();
        let base = self.external.base_nominal(&values);
        let real = self.world_from_real_home(s).inverse();
        if self.on_base || self.of_joints {
            return real * part * base;
        }
        // what rides along is where the controller has it
        let riding = self.external.riding(&values);
        real * riding * part * riding.inverse() * base
    }

    /// Whether the base leans: gravity is another at each place.
    pub(crate) fn leans(&self) -> bool {
        leans(&self.world_from_real_home(1.0_f64).rotation)
    }
}

/// A base that is rotated by less stands upright, radians: what is left of a rotation and its
/// inverse.
const UPRIGHT_RAD: f64 = 1e-9;

/// Whether a base with this rotation leans.
pub(crate) fn leans(base: &Rotation) -> bool {
    base.angle() > UPRIGHT_RAD
}

/// Where an arc on a ride passes through, with what external axes are written for that point: see
/// [`Ride::halfway`].
pub(crate) fn through(pose: &Pose, point: Option<&Ride>, arc: Option<&Ride>) -> Pose {
    match (point, arc) {
        (Some(point), Some(arc)) => arc.halfway(point, pose),
        _ => *pose,
    }
}
