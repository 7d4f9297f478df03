//! External axes: a track or gantry that carries the base, positioners that carry the work piece.
//!
//! ```text
//! track:       base(e) = Π over its axes of Trans(R · ((middle − zero) · x + p(e))) · (R · Rδ(e) · Rᵀ about the base's origin) · base
//!              R = [x y z]: x = direction, y = up × x, z = x × y;  d = e − middle;  s = d / half span of the limits
//!              p(e) = (1 + scale) · d · Ry(y) · Rz(z) · x + straightness + ripple + backlash
//! positioner:  plate(e) = Π over its axes of at · [Trans(x, y, 0) · Rx · Ry · Trans(runout)] · Rz(u · (1 + scale) + zero + ripple) · plate ·
//!              [plate error];  u = sign · (e − zero)
//! ```
//!
//! Without effects these are what the controller computes with. The arm's own models stand where
//! the base is with every axis of the track at `zero`: a wanted pose is brought into their world by
//! the inverse of the track's motion, and gravity rotated along.
//!
//! # Source
//! J. Kleinkes, W. Neddermeyer, M. Schnell, "Improved method for highly accurate integration of
//! track motions" (2006), with powers instead of splines; the positioner is the usual product of
//! rigid motions.

use super::effects::{AxisError, AxisState, Effect};
use crate::geometry::{Pose, Rotation, Scalar, Vector, add, cross, norm, scale};
use std::collections::BTreeMap;

/// What stands around an arm and moves: see the head of this file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExternalAxes {
    /// Linear axes that carry the base, from the floor up.
    pub track: Vec<TrackAxis>,
    /// What carries work pieces.
    pub positioners: Vec<Positioner>,
    /// Axes, by their names in programs, that move nothing a pose depends on.
    pub other: Vec<String>,
}

/// A linear axis that carries the base.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackAxis {
    /// Its name in programs.
    pub axis: String,
    /// Its direction in the world, of length 1.
    pub direction: Vector,
    /// Roughly up, in the world: not along the direction.
    pub up: Vector,
    /// Where the base stands as `kinematics.base` says, metres.
    pub zero_m: f64,
    /// Smallest value, metres.
    pub min_m: f64,
    /// Largest value, metres.
    pub max_m: f64,
    /// What the controller's poses are relative to.
    pub coordinates: Coordinates,
    /// Encoder pulses of one millimetre, for programs that count in pulses.
    pub pulses_per_mm: Option<f64>,
}

/// What the poses of a controller are relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Coordinates {
    /// The world: the axis is in them.
    #[default]
    World,
    /// The base: work frames ride along, the axis is not in them.
    Base,
}

/// What carries a work piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Positioner {
    /// Its name in programs.
    pub name: String,
    /// Which work frames it carries.
    pub follows: Follows,
    /// Its rotary axes, each in the frame of the one before as it stands at zero.
    pub axes: Vec<RotaryAxis>,
    /// The plate on the last axis.
    pub plate: Pose,
    /// Measured points by name, in the plate's frame, metres.
    pub points: BTreeMap<String, Vector>,
}

/// Which work frames a positioner carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Follows {
    /// Those of which the program says so.
    #[default]
    Frame,
    /// All.
    Always,
    /// None: it moves nothing that a pose depends on.
    Never,
}

/// A rotary axis.
#[derive(Clone, Debug, PartialEq)]
pub struct RotaryAxis {
    /// Its name in programs.
    pub axis: String,
    /// Where it is: its z is the axis.
    pub at: Pose,
    /// +1 or −1.
    pub sign: f64,
    /// The value at which it is at zero, radians.
    pub zero_rad: f64,
    /// Smallest value, radians.
    pub min_rad: f64,
    /// Largest value, radians.
    pub max_rad: f64,
    /// Encoder pulses of one degree, for programs that count in pulses.
    pub pulses_per_deg: Option<f64>,
}

/// One of the listed axes: those of the track first, then those of the positioners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Listed<'a> {
    /// Of the track.
    Track(&'a TrackAxis),
    /// Of a positioner, by its index, and whether it is its last.
    Rotary(&'a RotaryAxis, usize, bool),
}

impl Listed<'_> {
    /// Its name in programs.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Track(axis) => &axis.axis,
            Self::Rotary(axis, ..) => &axis.axis,
        }
    }

    /// Its limits, metres or radians.
    #[must_use]
    pub fn limits(&self) -> (f64, f64) {
        match self {
            Self::Track(axis) => (axis.min_m, axis.max_m),
            Self::Rotary(axis, ..) => (axis.min_rad, axis.max_rad),
        }
    }

    /// Whether it is linear.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        matches!(self, Self::Track(_))
    }
}

/// Where external axes stand, in the order in which they are listed: metres and radians, and the
/// direction in which each last moved.
#[derive(Clone, Copy, Debug)]
pub struct At<'a, S = f64> {
    /// Their values.
    pub values: &'a [S],
    /// −1, +1, or 0 where it is unknown.
    pub directions: &'a [f64],
}

/// Where external axes stand, as [`At`], kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stand {
    /// Metres and radians in the order in which they are listed; not a number of an axis of which
    /// nothing is known.
    pub values: Vec<f64>,
    /// −1, +1, or 0 where it is unknown; empty where nothing is known of any.
    pub directions: Vec<f64>,
}

impl Stand {
    /// The same, lent.
    #[must_use]
    pub fn at(&self) -> At<'_> {
        At {
            values: &self.values,
            directions: &self.directions,
        }
    }

    /// Whether it says of some axis from which side it came.
    #[must_use]
    pub fn is_directed(&self) -> bool {
        self.directions.iter().any(|direction| *direction != 0.0)
    }

    /// Its numbers bit by bit: what is the same has the same.
    #[must_use]
    pub fn bits(&self) -> Vec<u64> {
        let numbers = self.values.iter().chain(&self.directions);
        numbers.map(|x| x.to_bits()).collect()
    }
}

/// A track with what it carries: the base, from where it stands at home.
#[derive(Clone, Debug, PartialEq)]
pub struct Carried {
    /// The axes.
    pub axes: ExternalAxes,
    /// Where they stand.
    pub stand: Stand,
    /// Where the base stands nominally, metres: carriages turn about it.
    pub origin: Vector,
    /// Where the base really stands at home, where the track goes along with it: the world is then
    /// wherever the base is seen. Else the track stands in the world, wherever the base is.
    pub home: Option<Pose>,
}

impl Carried {
    /// The base where it is carried to.
    #[must_use]
    pub fn carry<S: Scalar>(&self, world_from_base: Pose<S>, effects: &[Effect<S>]) -> Pose<S> {
        let values: Vec<S> = self.stand.values.iter().map(|x| S::constant(*x)).collect();
        let at = At {
            values: &values,
            directions: &self.stand.directions,
        };
        let motion = self.axes.base_real(at, self.origin, effects);
        match self.home {
            None => motion * world_from_base,
            Some(home) => world_from_base * home.inverse().cast() * motion * home.cast(),
        }
    }
}

impl ExternalAxes {
    /// Whether nothing moves.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.track.is_empty() && self.positioners.is_empty() && self.other.is_empty()
    }

    /// The axes in the order in which values are given: e1, e2, …
    pub fn listed(&self) -> impl Iterator<Item = Listed<'_>> {
        let track = self.track.iter().map(Listed::Track);
        let rotary = self
            .positioners
            .iter()
            .zip(0..)
            .flat_map(|(positioner, of)| {
                let last = positioner.axes.len();
                let axes = positioner.axes.iter().zip(1..);
                axes.map(move |(axis, n)| Listed::Rotary(axis, of, n == last))
            });
        track.chain(rotary)
    }

    /// Every axis in the middle of its limits.
    #[must_use]
    pub fn middle(&self) -> Stand {
        let limits = self.listed().map(|axis| axis.limits());
        Stand {
            values: limits.map(|(low, high)| 0.5 * (low + high)).collect(),
            directions: Vec::new(),
        }
    }

    /// Index of the first listed axis of a positioner.
    #[must_use]
    pub fn first_of(&self, positioner: usize) -> usize {
        let before = &self.positioners[..positioner];
        self.track.len() + before.iter().map(|p| p.axes.len()).sum::<usize>()
    }

    /// Where the controller takes the base to be: the motion in the world from where it stands with
    /// every axis at zero.
    #[must_use]
    pub fn base_nominal<S: Scalar>(&self, values: &[S]) -> Pose<S> {
        self.travel(values, |_| true)
    }

    /// The part of that which the controller's poses do not include: work frames ride along.
    #[must_use]
    pub fn riding<S: Scalar>(&self, values: &[S]) -> Pose<S> {
        self.travel(values, |axis| axis.coordinates == Coordinates::Base)
    }

    fn travel<S: Scalar>(&self, values: &[S], which: impl Fn(&TrackAxis) -> bool) -> Pose<S> {
        let mut motion = Pose::identity();
        for (axis, &value) in self.track.iter().zip(values) {
            if which(axis) {
                let along = value - S::constant(axis.zero_m);
                let step = scale(along, axis.direction.map(S::constant));
                motion.translation = add(motion.translation, step);
            }
        }
        motion
    }

    /// Where the base really is: the motion in the world from where it stands with every axis at
    /// zero. It is rotated about `origin`, where the base stands nominally, metres.
    #[must_use]
    pub fn base_real<S: Scalar>(
        &self,
        at: At<S>,
        origin: Vector,
        effects: &[Effect<S>],
    ) -> Pose<S> {
        let to = Pose::from_translation(origin[0], origin[1], origin[2]);
        let (to, back): (Pose<S>, Pose<S>) = (to.cast(), to.inverse().cast());
        let mut motion = Pose::identity();
        for (n, axis) in self.track.iter().enumerate() {
            let k = S::constant;
            let middle = 0.5 * (axis.min_m + axis.max_m);
            let moved = at.values[n] - k(middle);
            let part = moved * k(2.0 / (axis.max_m - axis.min_m));
            let error = error_of(n, moved, part, at.directions, effects);
            let rail: Rotation<S> = axis.rail().cast();
            let along = Rotation::about_y(error.direction[0])
                * Rotation::about_z(error.direction[1])
                * [(S::one() + error.scale) * moved, S::zero(), S::zero()];
            let mut offset = add(along, error.offset);
            offset[0] += k(middle - axis.zero_m);
            let shift = Pose {
                rotation: Rotation::identity(),
                translation: rail * offset,
            };
            let [x, y, z] = error.turn;
            let turn = Rotation::about_x(x) * Rotation::about_y(y) * Rotation::about_z(z);
            let turn = Pose::from_rotation(rail * turn * rail.transpose());
            motion = motion * shift * to * turn * back;
        }
        motion
    }

    /// Where a positioner's plate is in the world: as the controller has it without effects.
    #[must_use]
    pub fn plate<S: Scalar>(&self, positioner: usize, at: At<S>, effects: &[Effect<S>]) -> Pose<S> {
        let first = self.first_of(positioner);
        let positioner = &self.positioners[positioner];
        let mut pose = Pose::identity();
        let mut plate = [S::zero(); 6];
        for (axis, n) in positioner.axes.iter().zip(first..) {
            let k = S::constant;
            let angle = k(axis.sign) * (at.values[n] - k(axis.zero_rad));
            let error = error_of(n, angle, S::zero(), at.directions, effects);
            let [x, y, rx, ry] = error.place;
            let place = Pose::from_xyz_rxryrz([x, y, S::zero(), rx, ry, S::zero()]);
            let [x, y, z] = error.offset;
            let turned = angle * (S::one() + error.scale) + error.angle;
            pose = pose
                * axis.at.cast()
                * place
                * Pose::from_translation(x, y, z)
                * Pose::from_rotation(Rotation::about_z(turned));
            plate = error.plate;
        }
        pose * positioner.plate.cast() * Pose::from_xyz_rxryrz(plate)
    }
}

impl TrackAxis {
    /// The axes of the rail in the world: along it, across it, and up.
    #[must_use]
    pub fn rail(&self) -> Rotation {
        let x = self.direction;
        let across = cross(self.up, x);
        let y = scale(1.0 / norm(across), across);
        let z = cross(x, y);
        Rotation(std::array::from_fn(|i| [x[i], y[i], z[i]]))
    }
}

/// What the effects say about one axis.
fn error_of<S: Scalar>(
    index: usize,
    moved: S,
    part: S,
    directions: &[f64],
    effects: &[Effect<S>],
) -> AxisError<S> {
    let mut error = AxisError::none();
    let at = AxisState {
        moved,
        part,
        direction: directions.get(index).copied().unwrap_or(0.0),
    };
    for effect in effects {
        if effect.site.index == index && effect.definition().of_external_axis() {
            effect.carry(&at, &mut error);
        }
    }
    error
}

#[cfg(test)]
mod tests;
