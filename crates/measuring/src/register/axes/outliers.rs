//! Single rows of a sweep that are on no circle with the others.

use super::{AxesError, Axis, Sweep, angles, fitted, mechanical, wrap};
use crate::geometry::{Vector, add, dot, norm, scale, sub};
use crate::profile::Profile;
use crate::register::features;

/// Sweeps with fewer rows keep all: the others could not tell which one is wrong.
pub const FEWEST: usize = 6;
/// A row counts as wrong where, without it, the mean square of the residual falls by more than this
/// many times itself a coordinate: beyond six standard deviations of the others.
const LIMIT: f64 = 40.0;
/// Rows nearer to the circle of the others than this are never left out, metres.
const NEAR_M: f64 = 3e-5;
/// Rows that are tried, those farthest off first.
const TRIED: usize = 10;

/// A row that was left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// Its place in the sweep, from 0.
    pub row: usize,
    /// How far it is from where the others have it, metres.
    pub off_m: f64,
    /// Root mean square distance of the others from their circle, metres.
    pub others_m: f64,
}

/// Squares of what the circle and the commanded angles leave.
fn squares(axis: &Axis) -> f64 {
    let sum = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
    let along = axis.circle.radius_m * axis.circle.radius_m * sum(&axis.circle.tangential_rad);
    sum(&axis.circle.radial_m) + sum(&axis.circle.axial_m) + along
}

/// How far a point is from where an axis found without it has it, metres.
fn off(axis: &Axis, sweep: &Sweep, row: usize, profile: &Profile) -> Result<f64, AxesError> {
    let points: Vec<Vector> = sweep.rows.iter().map(|row| row.point_m).collect();
    let turned = mechanical(sweep, profile)?;
    let round = features::Round {
        centre_m: axis.circle.line.point_m,
        radius_m: axis.circle.radius_m,
        axis: axis.circle.line.direction,
        residuals_m: Vec::new(),
        axial_m: Vec::new(),
        centre_covariance: [[0.0; 3]; 3],
        radius_sigma: 0.0,
    };
    let (angles, direction) = angles(&round, &points, &turned);
    let left = |i: usize| angles[i] - turned[i];
    let (c, s) = (0..points.len())
        .filter(|i| *i != row)
        .fold((0.0, 0.0), |(c, s), i| {
            (c + left(i).cos(), s + left(i).sin())
        });
    let from_centre = sub(points[row], axis.circle.line.point_m);
    let axial = dot(from_centre, direction);
    let radial = norm(add(from_centre, scale(-axial, direction))) - axis.circle.radius_m;
    let along = axis.circle.radius_m * wrap(left(row) - s.atan2(c));
    Ok(norm([axial, radial, along]))
}

/// The sweep without rows that are on no circle with the others, and these. At most a fifth is left
/// out, one at a time.
///
/// # Errors
/// As [`super::axis`].
pub fn without_outliers(
    sweep: &Sweep,
    profile: &Profile,
) -> Result<(Sweep, Vec<Outlier>), AxesError> {
    let mut kept = sweep.clone();
    let mut places: Vec<usize> = (0..sweep.rows.len()).collect();
    let mut found = Vec::new();
    while kept.rows.len() >= FEWEST && found.len() < sweep.rows.len() / 5 {
        let all = fitted(&kept, profile)?;
        let mut order: Vec<usize> = (0..kept.rows.len()).collect();
        let size = |i: &usize| {
            let along = all.circle.radius_m * all.circle.tangential_rad[*i];
            norm([all.circle.radial_m[*i], all.circle.axial_m[*i], along])
        };
        order.sort_by(|a, b| size(b).total_cmp(&size(a)));
        let mut best: Option<(f64, usize, Axis)> = None;
        for row in order.into_iter().take(TRIED) {
            let mut rest = kept.clone();
            rest.rows.remove(row);
            // a sweep that is none without this row keeps it
            let Ok(axis) = fitted(&rest, profile) else {
                continue;
            };
            let left = squares(&axis);
            if best.as_ref().is_none_or(|(least, ..)| left < *least) {
                best = Some((left, row, axis));
            }
        }
        let Some((left, row, axis)) = best else { break };
        #[allow(clippy::cast_precision_loss)]
        let (others, freedom) = (
            (kept.rows.len() - 1) as f64,
            (3 * kept.rows.len() - 10) as f64,
        );
        let gain = (squares(&all) - left) / 3.0;
        let off_m = off(&axis, &kept, row, profile)?;
        if gain <= LIMIT * left / freedom || off_m < NEAR_M {
            break;
        }
        found.push(Outlier {
            row: places.remove(row),
            off_m,
            others_m: (left / others).sqrt(),
        });
        kept.rows.remove(row);
    }
    Ok((kept, found))
}
