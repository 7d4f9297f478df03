//! How the frames of what moves go through the world over a piece of a move.

use super::scene::On;
use crate::geometry::{Jet, Pose};

/// Bounds of how a frame moves in the world over a piece, by s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep {
    /// Angular speed and acceleration.
    pub(super) turn: f64,
    pub(super) gain: f64,
    /// Of its origin: distance from that of the world, speed and acceleration.
    pub(super) far: f64,
    pub(super) moving: f64,
    pub(super) rising: f64,
}

impl Sweep {
    pub(super) fn of(frame: &Pose<Jet>) -> Self {
        // dR = [ω] R: of each the largest that it can be
        let size = |part: fn(&Jet) -> f64| {
            let all = frame.rotation.0.iter().flatten();
            (0.5 * all.map(|x| part(x).powi(2)).sum::<f64>()).sqrt()
        };
        let length = |part: fn(&Jet) -> f64| {
            let all = frame.translation.iter();
            all.map(|x| part(x).powi(2)).sum::<f64>().sqrt()
        };
        Self {
            turn: size(|x| x.slope.magnitude()),
            gain: size(|x| x.bend.magnitude()),
            far: length(|x| x.value.magnitude()),
            moving: length(|x| x.slope.magnitude()),
            rising: length(|x| x.bend.magnitude()),
        }
    }

    /// Speed and acceleration of what is so far from its origin.
    pub(super) fn at(&self, far: f64) -> [f64; 2] {
        let speed = self.moving + self.turn * far;
        [
            speed,
            self.rising + (self.gain + self.turn * self.turn) * far,
        ]
    }
}

/// Bounds of the rates of a piece: what each joint adds to the speed and acceleration of what it
/// carries.
#[derive(Clone, Debug)]
pub(super) struct Rates {
    /// Angular speed of each joint, radians by s.
    pub(super) turn: [f64; 6],
    /// Angular acceleration of each.
    pub(super) gain: [f64; 6],
    /// Rotation and translation of the whole arm in the world: speed and acceleration.
    pub(super) world: [[f64; 2]; 2],
    /// Largest distance of that translation.
    pub(super) carried: f64,
    /// The plates that carry bodies.
    pub(super) plates: Vec<Sweep>,
}

/// The frames of all that moves: those of the links, and of the plates that carry bodies.
pub(super) struct Frames {
    pub(super) links: [Pose; 7],
    pub(super) plates: Vec<Pose>,
}

impl Frames {
    pub(super) fn of(&self, on: On) -> &Pose {
        match on {
            On::Link(link) => &self.links[link],
            On::Plate(plate) => &self.plates[plate],
        }
    }
}
