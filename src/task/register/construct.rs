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
    let datums = match kind {
        Construction::ThreePoints => Vec::new(),
        Construction::ThreeTwoOne => datums(table)?,
    };
    let normals = table.rows.iter().filter(|row| row.normal.is_some()).count();
    let has_normals = normals == table.rows.len();
    let build = |points: &[Vector]| -> Result<Pose, FrameError> {
        match kind {
            Construction::ThreePoints => three_points([points[0], points[1], points[2]]),
            Construction::ThreeTwoOne => {
                let mut sets = [const { Vec::new() }; 3];
                for (point, datum) in points.iter().zip(&datums) {
                    sets[*datum].push(*point);
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
        Construction::ThreeTwoOne if radius > 0.0 && normals > 0 && !has_normals => {
            return Err(fail(format!(
                "{normals} of {count} touches have a normal nx,ny,nz: --probe-radius-mm needs that \
                 of all, or of none, then the datums give the directions"
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

/// The datum of each touch: of the column, or where it is not there or empty by the order.
fn datums(table: &Points) -> Result<Vec<usize>, Failure> {
    let count = table.rows.len();
    let filled = table.rows.iter().filter(|row| row.datum.is_some()).count();
    let fail = |message: String| Err(Failure::new(format!("{}: {message}", table.name)));
    match filled {
        0 if count == BY_ORDER.len() => Ok(BY_ORDER.to_vec()),
        0 => fail(format!(
            "{count} touches without a column datum (1, 2 or 3); in order they must be 3 + 2 + 1"
        )),
        _ if filled < count => fail(format!(
            "{filled} of {count} touches have a datum (1, 2 or 3): it is needed of all, or of none \
             in the order 3 + 2 + 1"
        )),
        _ => {
            let cells = table.rows.iter().filter_map(|row| row.datum.clone());
            cells.collect()
        }
    }
}
