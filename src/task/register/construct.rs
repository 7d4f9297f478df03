//! A frame from touches of one file.

use super::matched::other_sigma;
use super::points::{PointRow, Points};
use super::{Motion, Options, Registration, Residual};
use crate::geometry::units::DEG;
use crate::geometry::{Pose, Vector, add, dot, scale};
use crate::register::features::compensated;
use crate::register::frames::{
    Datums, FrameError, propagate, redundancy, three_points, three_two_one,
};
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
/// Outward directions of the datums in the frame that they make.
const OUTWARD: [(&str, Vector); 3] = [
    ("z", [0.0, 0.0, 1.0]),
    ("-y", [0.0, -1.0, 0.0]),
    ("-x", [-1.0, 0.0, 0.0]),
];
/// A normal that is farther from its datum's direction is not that of the surface touched.
const NORMAL_RAD: f64 = 5.0 * DEG;

/// Touches that make a frame.
struct Touched<'a> {
    table: &'a Points,
    kind: Construction,
    /// Places, without the ball where normals say in which direction it stood.
    points: Vec<Vector>,
    /// The datum of each, from 0; empty for three points.
    datums: Vec<usize>,
    /// What is left of the ball.
    radius_m: f64,
}

pub(super) fn construct(
    table: &Points,
    kind: Construction,
    options: &Options,
) -> Result<Registration, Failure> {
    let touched = Touched::new(table, kind, options.probe_radius_m)?;
    let fail = |error: FrameError| touched.failure(&error);
    let pose = touched.frame(&touched.points).map_err(fail)?;
    touched.refuse_other_normals(&pose)?;
    let sigmas = sigmas(table, options)?;
    let covariance = sigmas
        .as_ref()
        .map(|sigmas| propagate(&touched.points, sigmas, |points| touched.frame(points)))
        .transpose()
        .map_err(fail)?;
    // six touches leave nothing
    let residuals = touched.residuals(&touched.points, &pose);
    let is_checked = residuals.len() > BY_ORDER.len();
    let mut findings = Vec::new();
    if let Some(sigmas) = sigmas.filter(|_| is_checked) {
        let again = |points: &[Vector]| Ok(touched.residuals(points, &touched.frame(points)?));
        let expected = redundancy(&touched.points, &sigmas, again).map_err(fail)?;
        let squares = residuals.iter().zip(sigmas).map(|(r, s)| (r / s).powi(2));
        let times = (squares.sum::<f64>() / expected.mean).sqrt();
        findings.extend(other_sigma(times, expected.freedom, &table.name));
    }
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let reported = is_checked.then(|| touched.reported(&pose, &residuals));
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
        rmsd_m: is_checked.then(|| (squares / residuals.len() as f64).sqrt()),
        points: reported.unwrap_or_default(),
    };
    Ok(Registration {
        findings,
        ..Registration::new("part", &table.name, motion, options)
    })
}

impl<'a> Touched<'a> {
    fn new(table: &'a Points, kind: Construction, radius_m: f64) -> Result<Self, Failure> {
        let count = table.rows.len();
        let normals = table.rows.iter().filter(|row| row.normal.is_some()).count();
        let fail = |message: String| Err(Failure::new(format!("{}: {message}", table.name)));
        match kind {
            Construction::ThreePoints if count != 3 => {
                return fail(format!(
                    "{count} points; a 3-point frame takes 3: origin, on x, in the xy plane"
                ));
            }
            Construction::ThreePoints if radius_m > 0.0 && normals < count => {
                return fail(
                    "--probe-radius-mm needs the outward normals nx,ny,nz of the touched surfaces"
                        .into(),
                );
            }
            Construction::ThreeTwoOne if radius_m > 0.0 && normals > 0 && normals < count => {
                return fail(format!(
                    "{normals} of {count} touches have a normal nx,ny,nz: --probe-radius-mm needs \
                     that of all, or of none, then the datums give the directions"
                ));
            }
            _ => {}
        }
        let touch = |row: &PointRow| match row.normal {
            Some(normal) => compensated(row.point_m, radius_m, normal),
            None => row.point_m,
        };
        Ok(Self {
            table,
            kind,
            points: table.rows.iter().map(touch).collect(),
            datums: match kind {
                Construction::ThreePoints => Vec::new(),
                Construction::ThreeTwoOne => datums(table)?,
            },
            // normals of the table have done it already
            radius_m: if normals == count { 0.0 } else { radius_m },
        })
    }

    fn frame(&self, points: &[Vector]) -> Result<Pose, FrameError> {
        if self.kind == Construction::ThreePoints {
            return three_points([points[0], points[1], points[2]]);
        }
        let mut sets = [const { Vec::new() }; 3];
        for (point, datum) in points.iter().zip(&self.datums) {
            sets[*datum].push(*point);
        }
        let [primary_m, secondary_m, tertiary_m] = sets;
        let outward = |of: usize| {
            let rows = self.table.rows.iter().zip(&self.datums);
            let rows = rows.filter(|(_, datum)| **datum == of);
            rows.filter_map(|(row, _)| row.normal).reduce(add)
        };
        let datums = Datums {
            primary_m,
            primary_outward: outward(0),
            secondary_m,
            secondary_outward: outward(1),
            tertiary_m,
        };
        three_two_one(&datums, self.radius_m)
    }

    fn failure(&self, error: &FrameError) -> Failure {
        let mut message = format!("{}: {error}", self.table.name);
        if let FrameError::OtherSide { touches, .. } = error {
            let row = |(of, index): &(usize, usize)| {
                let rows = self.table.rows.iter().zip(&self.datums);
                let mut rows = rows.filter(|(_, datum)| *datum == of);
                rows.nth(*index).map(|(row, _)| row.id.clone())
            };
            let ids: Vec<String> = touches.iter().filter_map(row).collect();
            message += &format!(" (rows {})", ids.join(", "));
        }
        Failure::with_hint(message, error.hint())
    }

    /// Refuses normals that are not those of the datums.
    fn refuse_other_normals(&self, pose: &Pose) -> Result<(), Failure> {
        for (row, datum) in self.table.rows.iter().zip(&self.datums) {
            let Some(normal) = row.normal else { continue };
            let (name, outward) = OUTWARD[*datum];
            let cosine = dot(normal, pose.rotation * outward);
            let off_rad = cosine.clamp(-1.0, 1.0).acos();
            if off_rad > NORMAL_RAD {
                let message = format!(
                    "{}: touch {} of datum {}: its normal is {:.1} deg from {name} of the frame \
                     that the touches make (limit {:.0} deg)",
                    self.table.name,
                    row.id,
                    datum + 1,
                    off_rad / DEG,
                    NORMAL_RAD / DEG
                );
                let hint = "normals point out of the part, along the axes that the touches have \
                            (not those of the drawing)";
                return Err(Failure::with_hint(message, hint));
            }
        }
        Ok(())
    }

    /// What each touch is off along its datum's direction; none of three points.
    fn residuals(&self, points: &[Vector], pose: &Pose) -> Vec<f64> {
        let to_part = pose.inverse();
        let touches = points.iter().zip(&self.datums);
        let along = |(point, datum): (&Vector, &usize)| {
            dot(to_part.transform(*point), OUTWARD[*datum].1) - self.radius_m
        };
        touches.map(along).collect()
    }

    fn reported(&self, pose: &Pose, residuals: &[f64]) -> Vec<Residual> {
        let rows = self.table.rows.iter().zip(&self.datums).zip(residuals);
        let reported = |((row, datum), left): ((&PointRow, &usize), &f64)| {
            let outward = pose.rotation * OUTWARD[*datum].1;
            Residual::new(&row.id, scale(*left, outward)).at(row.point_m)
        };
        rows.map(reported).collect()
    }
}

/// The deviation of each touch: of the column, or one for all.
fn sigmas(table: &Points, options: &Options) -> Result<Option<Vec<f64>>, Failure> {
    let own: Vec<f64> = table.rows.iter().filter_map(|row| row.sigma_m).collect();
    let count = table.rows.len();
    match own.len() {
        0 => Ok(options.sigma_m.map(|sigma| vec![sigma; count])),
        filled if filled == count => Ok(Some(own)),
        _ => Err(Failure::new(format!(
            "{}: sigma_mm is given for some points only",
            table.name
        ))),
    }
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
