//! The axes of a positioner from circles of a point on its plate.
//!
//! One axis goes at a time: the point runs on a circle about it. The circle says where the axis is
//! but for what lies along it and about it: these stay as the profile has them. An axis on another
//! one is found in the frame of that one, as it was found or, where it was not swept, as the
//! profile has it.
//!
//! # Source
//! The circle-point method: R. P. Judd, A. B. Knasinski, "A technique to calibrate industrial
//! robots with experimental verification" (1990).

use super::{Circle, Line, SHORT_RAD, STILL_RAD, span};
use crate::geometry::{Pose, Rotation, Vector, add, cross, dot, norm, scale, sub};
use crate::model::external::{ExternalAxes, Listed, RotaryAxis};
use crate::register::features::FeatureError;
use crate::register::frames::propagate;
use crate::register::uncertainty::PoseCovariance;

/// One measurement of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Where the external axes stood, in the order in which the profile lists them, radians.
    pub values: Vec<f64>,
    /// The measured point in the world, metres.
    pub point_m: Vector,
}

/// The measurements while one axis of a positioner moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The axis among all that the profile lists, from 0.
    pub axis: usize,
    /// In the order in which they were measured.
    pub rows: Vec<Row>,
}

/// What a sweep says about its axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The axis among all that the profile lists, from 0.
    pub axis: usize,
    /// The circle of the point.
    pub circle: Circle,
    /// Where the axis is, as profiles have it: the first in the world, another in the frame of the
    /// axis before it.
    pub at: Pose,
    /// What the noise of the points does to that; `None` where the noise is not known.
    pub covariance: Option<PoseCovariance>,
}

/// Why sweeps of a positioner give no axes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PositionerError {
    /// No circle.
    #[error("sweep of {axis}: {error}")]
    Circle {
        /// Its name.
        axis: String,
        /// Why.
        error: FeatureError,
    },
    /// Another axis of the positioner moves.
    #[error("sweep of {axis}: {other} moves too, by {moved_deg:.4} deg (limit {limit_deg:.4} deg)")]
    Moves {
        /// Its name.
        axis: String,
        /// The other's.
        other: String,
        /// How far.
        moved_deg: f64,
        /// The most that is accepted.
        limit_deg: f64,
    },
    /// The swept axis hardly moves.
    #[error("sweep of {axis}: it rotates by {rotated_deg:.3} deg only (limit {limit_deg:.1} deg)")]
    Short {
        /// Its name.
        axis: String,
        /// How far.
        rotated_deg: f64,
        /// The least that is accepted.
        limit_deg: f64,
    },
    /// Measured and commanded angles do not belong together.
    #[error(
        "sweep of {axis}: the points rotate by {measured_deg:.2} deg where the axis rotates by \
         {commanded_deg:.2} deg: another unit, another axis, or rows in another order"
    )]
    Unlike {
        /// Its name.
        axis: String,
        /// On the circle.
        measured_deg: f64,
        /// By the column.
        commanded_deg: f64,
    },
}

/// The rotary axes of a positioner, and the place of the first among all listed.
fn of_positioner(axes: &ExternalAxes, axis: usize) -> (&[RotaryAxis], usize) {
    let Some(Listed::Rotary(_, of, _)) = axes.listed().nth(axis) else {
        unreachable!("an axis of a positioner is swept")
    };
    (&axes.positioners[of].axes, axes.first_of(of))
}

/// The axes of positioners, in the order in which the profile lists them.
///
/// # Errors
/// Another axis than the swept one moves, the swept one hardly does, the points are on no circle or
/// go round otherwise than the angles say.
///
/// # Panics
/// If a sweep is of a linear axis: the caller's bug.
pub fn find(axes: &ExternalAxes, sweeps: &[Sweep]) -> Result<Vec<Found>, PositionerError> {
    let mut sorted: Vec<&Sweep> = sweeps.iter().collect();
    sorted.sort_by_key(|sweep| sweep.axis);
    let each = sorted.iter().enumerate();
    each.map(|(n, sweep)| of_sweep(axes, sweep, &sorted[..n]))
        .collect()
}

/// The axis of a sweep and those before it that were swept, by the points of all these sweeps.
struct Chain<'a> {
    own: &'a [RotaryAxis],
    first: usize,
    /// One of each axis that was swept, in the order of the axes.
    sweeps: Vec<&'a Sweep>,
}

impl Chain<'_> {
    /// By what an axis is turned in the rows of a sweep.
    fn turned(&self, sweep: &Sweep, k: usize) -> Vec<f64> {
        let values = sweep.rows.iter().map(|row| row.values[self.first + k]);
        let RotaryAxis { sign, zero_rad, .. } = &self.own[k];
        values.map(|e| sign * (e - zero_rad)).collect()
    }

    /// Where the axis of the last sweep is, and its circle, from these points of all.
    fn place(&self, points: &[Vector]) -> Result<(Pose, Circle), FeatureError> {
        let mut found: Vec<(usize, Pose)> = Vec::new();
        let mut rest = points;
        let mut last = None;
        for sweep in &self.sweeps {
            let (points, behind) = rest.split_at(sweep.rows.len());
            rest = behind;
            let index = sweep.axis - self.first;
            // the frame of the axis before, as it stands in this sweep
            let mut carrier = Pose::identity();
            for k in 0..index {
                let known = found.iter().find(|(axis, _)| *axis == k);
                let at = known.map_or(self.own[k].at, |(_, at)| *at);
                let turn = Rotation::about_z(self.turned(sweep, k)[0]);
                carrier = carrier * at * Pose::from_rotation(turn);
            }
            let circle = Circle::of(points, &self.turned(sweep, index))?;
            let nominal = carrier * self.own[index].at;
            let at = carrier.inverse() * moved_to(&nominal, &circle.line);
            found.push((index, at));
            last = Some((at, circle));
        }
        Ok(last.expect("its own sweep"))
    }
}

fn of_sweep(
    axes: &ExternalAxes,
    sweep: &Sweep,
    before: &[&Sweep],
) -> Result<Found, PositionerError> {
    let (own, first) = of_positioner(axes, sweep.axis);
    let index = sweep.axis - first;
    let name = |k: usize| own[k].axis.clone();
    let axis = name(index);
    let is_before = |of: &&&Sweep| (first..sweep.axis).contains(&of.axis);
    let chain = Chain {
        own,
        first,
        sweeps: before
            .iter()
            .filter(is_before)
            .copied()
            .chain([sweep])
            .collect(),
    };
    let turned = |k: usize| chain.turned(sweep, k);
    for other in (0..own.len()).filter(|k| *k != index) {
        let moved_rad = span(&turned(other));
        if moved_rad.is_nan() || moved_rad > STILL_RAD {
            return Err(PositionerError::Moves {
                axis,
                other: name(other),
                moved_deg: moved_rad.to_degrees(),
                limit_deg: STILL_RAD.to_degrees(),
            });
        }
    }
    let angle = turned(index);
    let turned_rad = span(&angle);
    if turned_rad.is_nan() || turned_rad < SHORT_RAD {
        return Err(PositionerError::Short {
            axis,
            rotated_deg: turned_rad.to_degrees(),
            limit_deg: SHORT_RAD.to_degrees(),
        });
    }
    let failed = |error| PositionerError::Circle {
        axis: axis.clone(),
        error,
    };
    let points_of = |of: &&Sweep| of.rows.iter().map(|row| row.point_m).collect::<Vec<_>>();
    let points: Vec<Vector> = chain.sweeps.iter().flat_map(points_of).collect();
    let (at, circle) = chain.place(&points).map_err(failed)?;
    if circle.is_unlike(&angle) {
        return Err(PositionerError::Unlike {
            axis,
            measured_deg: circle.span_rad.to_degrees(),
            commanded_deg: turned_rad.to_degrees(),
        });
    }
    // of each point the noise of its own circle
    let noise_of = |of: &&Sweep| {
        let own = Circle::of(&points_of(of), &chain.turned(of, of.axis - first)).ok()?;
        Some(vec![own.noise_m?; of.rows.len()])
    };
    let sigmas: Option<Vec<_>> = chain.sweeps.iter().map(noise_of).collect();
    let covariance = sigmas
        .map(|sigmas| {
            let place = |points: &[Vector]| chain.place(points).map(|(at, _)| at);
            propagate(&points, &sigmas.concat(), place)
        })
        .transpose()
        .map_err(failed)?;
    Ok(Found {
        axis: sweep.axis,
        at,
        covariance,
        circle,
    })
}

/// The frame nearest to `nominal` whose z is the line: turned by the least rotation, its origin
/// where the nominal one is nearest to the line.
fn moved_to(nominal: &Pose, line: &Line) -> Pose {
    let z = nominal.rotation.axis(2);
    let axis = cross(z, line.direction);
    let (sine, cosine) = (norm(axis), dot(z, line.direction));
    let turn = if sine > 0.0 {
        Rotation::from_vector(scale(sine.atan2(cosine) / sine, axis))
    } else {
        Rotation::identity()
    };
    let from = sub(nominal.translation, line.point_m);
    Pose {
        rotation: turn * nominal.rotation,
        translation: add(
            line.point_m,
            scale(dot(from, line.direction), line.direction),
        ),
    }
}
