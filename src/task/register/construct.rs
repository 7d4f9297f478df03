//! A frame from touches of one file.

use super::points::{PointRow, Points};
use super::{Motion, Options, Registration};
use crate::geometry::{Pose, Vector};
use crate::register::features::compensated;
use crate::register::frames::{Datums, FrameError, propagate, three_points, three_two_one};
use crate::task::Failure;

/// How touches make a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Construction {
    /// Origin, a point on x, a point in the xy plane.
    ThreePoints,
    /// Three touches on the primary datum, two on the secondary, one on the tertiary, or more.
    ThreeTwoOne,
}

/// The datum of each touch by order, where no column says it.
const BY_ORDER: [usize; 6] = [0, 0, 0, 1, 1, 2];

pub(super) fn construct(
    table: &Points,
    kind: Construction,
    options: &Options,
) -> Result<Registration, Failure> {
    let radius = options.probe_radius_m;
    let touch = |row: &PointRow| match row.normal {
        Some(normal) => compensated(row.point_m, radius, normal),
        None => row.point_m,
    };
    let touches: Vec<Vector> = table.rows.iter().map(touch).collect();
    let datums: Vec<Option<usize>> = table.rows.iter().map(datum).collect();
    let has_normals = table.rows.iter().all(|row| row.normal.is_some());
    let build = |points: &[Vector]| -> Result<Pose, FrameError> {
        match kind {
            Construction::ThreePoints => three_points([points[0], points[1], points[2]]),
            Construction::ThreeTwoOne => {
                let mut sets = [const { Vec::new() }; 3];
                for (index, (point, datum)) in points.iter().zip(&datums).enumerate() {
                    sets[datum.unwrap_or_else(|| BY_ORDER[index.min(5)])].push(*point);
                }
                let [primary_m, secondary_m, tertiary_m] = sets;
                let datums = Datums {
                    primary_m,
                    secondary_m,
                    tertiary_m,
                };
                // normals of the table have done it already
                three_two_one(&datums, if has_normals { 0.0 } else { radius })
            }
        }
    };
    let fail = |message: String| Failure::new(format!("{}: {message}", table.name));
    let count = touches.len();
    match kind {
        Construction::ThreePoints if count != 3 => {
            return Err(fail(format!(
                "{count} points; a 3-point frame takes 3: origin, on x, in the xy plane"
            )));
        }
        Construction::ThreePoints if radius > 0.0 && !has_normals => {
            return Err(fail(
                "--probe-radius-mm needs the outward normals nx,ny,nz of the touched surfaces"
                    .into(),
            ));
        }
        Construction::ThreeTwoOne if datums.iter().any(Option::is_none) && count != 6 => {
            return Err(fail(format!(
                "{count} touches without a column datum (1, 2 or 3); in order they must be 3 + 2 + \
                 1"
            )));
        }
        _ => {}
    }
    let pose = build(&touches).map_err(|error| fail(error.to_string()))?;
    let covariance = options
        .sigma_m
        .map(|sigma| propagate(&touches, &vec![sigma; count], build))
        .transpose()
        .map_err(|error| fail(error.to_string()))?;
    let motion = Motion {
        method: match kind {
            Construction::ThreePoints => "3-point",
            Construction::ThreeTwoOne => "3-2-1",
        },
        // the part's own frame maps into the frame of the touches
        to_from_from: pose,
        covariance,
        sigma_m: options.sigma_m,
        sigma_given: true,
        rmsd_m: None,
        points: Vec::new(),
    };
    Ok(Registration::new("part", &table.name, motion, options))
}

fn datum(row: &PointRow) -> Option<usize> {
    match row.datum.as_deref() {
        Some("1") => Some(0),
        Some("2") => Some(1),
        Some("3") => Some(2),
        _ => None,
    }
}
