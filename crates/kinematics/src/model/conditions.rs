//! What, besides the joint angles, decides where the tool is.

use crate::geometry::Vector;

/// The circumstances of one posture. Unknown ones stay at their default and switch off the effects
/// that need them.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Conditions {
    /// Direction in which each joint last moved: −1, +1, or 0 where it is unknown.
    pub direction: [f64; 6],
    /// How far each joint moved last, from the posture before, radians; 0 where that is unknown.
    pub moved: [f64; 6],
    /// External force on the tool's origin along the world's axes, newton.
    pub force_n: Vector,
    /// Temperature of the arm, °C.
    pub temperature_c: Option<f64>,
    /// Time since the session began, seconds.
    pub time_s: Option<f64>,
    /// Gravity along the axes of the arm's own world, m/s², where the base leans with a track;
    /// else that of the profile.
    pub gravity_m_s2: Option<Vector>,
    /// Where the origin of the measuring device's frame is in the world, of a distance where it is
    /// read from, metres.
    pub device_m: Vector,
    /// Row of the measurements, from 1; none outside a session of measurements.
    pub row: Option<u32>,
    /// Index of the named point of the tool that a row is of; none where it is of none.
    pub point: Option<u32>,
    /// How many rows there are; 0 outside a session of measurements.
    pub rows: u32,
}
