//! `register`: the rigid motion between two sets of points, or a frame from probe touches.

use super::failure::Failure;
use super::page::ReportFile;
use super::points::{Feature, Pair, PointRow, Points, matched};
use super::registration::{Measured, Registration, Touched, tell};
use super::{Answer, Output, values};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{m_from_mm, mm_from_m};
use crate::geometry::{Pose, Vector, add, norm, scale, sub};
use crate::register::RegisterError;
use crate::register::features::{self, FeatureError, Round, compensated, noise_of};
use crate::register::frames::{
    Datums, FrameError, TouchedPlane, points_and_planes, propagate, three_points, three_two_one,
};
use crate::register::kabsch::{Fit, kabsch, noise_m};
use crate::register::robust::{self, robust};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Find the rigid transform that maps the points of FROM into TO
#[derive(Args)]
#[command(
    after_help = "Points: CSV with x_mm,y_mm,z_mm; optional id (rows are matched by it), weight or sigma_mm, nx,ny,nz \
(outward normal).\nFeatures: FROM with feature (point, sphere, hole, plane), several rows of TO with the same id are its \
touches.\nWith --frame one file of touches is enough; 3-2-1 takes a column datum (1, 2, 3)."
)]
pub struct Register {
    /// Points as they should be (simulation, drawing), or touches with --frame
    #[arg(value_name = "FROM.csv")]
    pub(super) from: PathBuf,
    /// Points as measured
    #[arg(
        value_name = "TO.csv",
        required_unless_present = "frame",
        conflicts_with = "frame"
    )]
    pub(super) to: Option<PathBuf>,
    /// Make a frame from touches of one file
    #[arg(long, value_enum)]
    frame: Option<Construction>,
    /// Write the frame file (for `compensate --work-offset` or --wobj)
    #[arg(short, long, value_name = "FRAME.yaml")]
    pub(super) output: Option<PathBuf>,
    /// Standard deviation of one coordinate of a point, both sets together (default: from the residuals)
    #[arg(long, value_name = "MM")]
    pub(super) sigma_mm: Option<f64>,
    /// Leave out touches that disagree with the others, and tell why
    #[arg(long)]
    robust: bool,
    /// Radius of the probe's ball: TO holds the centres of the ball
    #[arg(long, value_name = "MM", default_value_t = 0.0)]
    probe_radius_mm: f64,
    /// Tell the error ellipsoid at this point of FROM (may be given several times)
    #[arg(long = "at", value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(super) at: Vec<String>,
    /// Leave out rows whose id the other file does not have
    #[arg(long)]
    drop_unmatched: bool,
    /// Match points by nearness (unknown correspondence) instead of by id or order
    #[command(flatten)]
    pub(super) icp: super::icp::IcpOptions,
    #[command(flatten)]
    report: ReportFile,
}

/// How touches make a frame
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Construction {
    /// Origin, a point on x, a point in the xy plane
    #[value(name = "3-point")]
    ThreePoints,
    /// Three touches on the primary datum, two on the secondary, one on the tertiary, or more
    #[value(name = "3-2-1")]
    ThreeTwoOne,
}

/// A residual above so many standard deviations of a coordinate is worth a look.
const SUSPECT: f64 = 4.35;
/// A scale that differs from 1 by more than this and its uncertainty is a finding.
const SCALE: f64 = 2e-5;

impl Register {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        for (name, value) in [
            ("--sigma-mm", self.sigma_mm),
            ("--probe-radius-mm", Some(self.probe_radius_mm)),
        ] {
            if let Some(value) = value.filter(|v| !v.is_finite() || *v < 0.0) {
                return Err(Failure::new(format!(
                    "{name} {value}: it must be 0 or more"
                )));
            }
        }
        let read = [&self.from].into_iter().chain(&self.to);
        let outputs = self.output.iter().map(PathBuf::as_path);
        self.report
            .refuse_over(read.map(PathBuf::as_path), outputs)?;
        let registration = match (&self.to, self.frame) {
            (_, Some(kind)) => self.construct(kind)?,
            (Some(to), None) => {
                let (from, to) = (Points::read(&self.from)?, Points::read(to)?);
                if self.icp.is_asked() {
                    super::icp::run(self, &from, &to)?
                } else {
                    self.register(&from, &to)?
                }
            }
            (None, None) => unreachable!("clap asks for TO where there is no --frame"),
        };
        let at = self
            .at
            .iter()
            .map(|text| {
                values::point(text)
                    .ok_or_else(|| Failure::new(format!("--at {text}: it must be x,y,z in mm")))
            })
            .collect::<Result<Vec<_>, _>>()?;
        tell(
            &registration,
            &at,
            self.output.as_deref(),
            &self.report,
            output,
        )
    }

    fn construct(&self, kind: Construction) -> Result<Registration, Failure> {
        let table = Points::read(&self.from)?;
        let radius = m_from_mm(self.probe_radius_mm);
        let touches: Vec<Vector> = table
            .rows
            .iter()
            .map(|row| match row.normal {
                Some(normal) => compensated(row.point_m, radius, normal),
                None => row.point_m,
            })
            .collect();
        let datums: Vec<Option<usize>> = table.rows.iter().map(datum).collect();
        let build = |points: &[Vector]| -> Result<Pose, FrameError> {
            match kind {
                Construction::ThreePoints => three_points([points[0], points[1], points[2]]),
                Construction::ThreeTwoOne => {
                    let mut sets = [const { Vec::new() }; 3];
                    for (index, (point, datum)) in points.iter().zip(&datums).enumerate() {
                        let by_order = [0, 0, 0, 1, 1, 2];
                        sets[datum.unwrap_or_else(|| by_order[index.min(5)])].push(*point);
                    }
                    let [primary_m, secondary_m, tertiary_m] = sets;
                    let datums = Datums {
                        primary_m,
                        secondary_m,
                        tertiary_m,
                    };
                    // normals of the table have done it already
                    let has_normals = table.rows.iter().all(|row| row.normal.is_some());
                    three_two_one(&datums, if has_normals { 0.0 } else { radius })
                }
            }
        };
        let fail = |message: String| Failure::new(format!("{}: {message}", table.name));
        match kind {
            Construction::ThreePoints if table.rows.len() != 3 => {
                return Err(fail(format!(
                    "{} points; a 3-point frame takes 3: origin, on x, in the xy plane",
                    table.rows.len()
                )));
            }
            Construction::ThreePoints
                if radius > 0.0 && table.rows.iter().any(|row| row.normal.is_none()) =>
            {
                return Err(fail(
                    "--probe-radius-mm needs the outward normals nx,ny,nz of the touched surfaces"
                        .into(),
                ));
            }
            Construction::ThreeTwoOne
                if datums.iter().any(Option::is_none) && touches.len() != 6 =>
            {
                return Err(fail(format!(
                    "{} touches without a column datum (1, 2 or 3); in order they must be 3 + 2 + 1",
                    touches.len()
                )));
            }
            _ => {}
        }
        let pose = build(&touches).map_err(|error| fail(error.to_string()))?;
        let covariance = self
            .sigma_mm
            .map(|sigma| propagate(&touches, &vec![m_from_mm(sigma); touches.len()], build))
            .transpose()
            .map_err(|error| fail(error.to_string()))?;
        Ok(Registration {
            method: match kind {
                Construction::ThreePoints => "3-point",
                Construction::ThreeTwoOne => "3-2-1",
            },
            from: "part".into(),
            to: table.name.clone(),
            // the part's own frame maps into the frame of the touches
            to_from_from: pose,
            covariance,
            sigma_m: self.sigma_mm.map(m_from_mm),
            sigma_given: true,
            rmsd_m: None,
            ..Registration::default()
        })
    }

    fn register(&self, from: &Points, to: &Points) -> Result<Registration, Failure> {
        refuse_identical(from, to)?;
        let (pairs, dropped) = matched(from, to, self.drop_unmatched)?;
        let mut findings = Vec::new();
        if !dropped.is_empty() {
            findings.push(note(
                "unmatched-ids",
                Severity::Warning,
                &to.name,
                format!("left out, for want of a partner: {}", dropped.join(", ")),
            ));
        }
        let radius = m_from_mm(self.probe_radius_mm);
        let mut touched = Vec::new();
        let mut planes = Vec::new();
        let mut plane_ids = Vec::new();
        let mut features = Vec::new();
        for pair in &pairs {
            match pair.from.feature {
                Feature::Point => touched.push(point(pair, radius, &to.name)?),
                Feature::Plane => {
                    planes.push(plane(pair, &from.name)?);
                    plane_ids.push(pair.from.id.clone());
                }
                Feature::Sphere | Feature::Hole => {
                    let (centre, feature) = round(pair, radius, &to.name, &mut findings)?;
                    touched.push(centre);
                    features.push(feature);
                }
            }
        }
        let mut registration = if planes.is_empty() {
            self.by_points(&touched, &mut findings, &to.name)?
        } else {
            if self.robust {
                return Err(Failure::new("--robust takes points only, no planes"));
            }
            let points: Vec<_> = touched.iter().map(|t| (t.from_m, t.to_m)).collect();
            let sigma = self.sigma_mm.map(m_from_mm);
            let fit = points_and_planes(&points, &planes, radius, sigma)
                .map_err(|error| Failure::new(format!("{}: {error}", to.name)))?;
            let mut rows: Vec<Measured> = touched
                .iter()
                .zip(&fit.points_m)
                .map(|(t, r)| Measured::new(&t.id, *r).at(t.to_m))
                .collect();
            let mut sum: f64 = fit.points_m.iter().map(|r| norm(*r).powi(2)).sum();
            for ((id, left), plane) in plane_ids.iter().zip(&fit.planes_m).zip(&planes) {
                let normal = fit.to_from_from.rotation * plane.normal;
                for (k, along) in left.iter().enumerate() {
                    sum += along * along;
                    rows.push(Measured::new(
                        &format!("{id}/{}", k + 1),
                        scale(*along, normal),
                    ));
                }
            }
            #[allow(clippy::cast_precision_loss)]
            let rmsd = (sum / rows.len() as f64).sqrt();
            Registration {
                method: "points and planes",
                to_from_from: fit.to_from_from,
                sigma_m: Some(fit.sigma_m),
                sigma_given: sigma.is_some(),
                covariance: Some(fit.covariance),
                rmsd_m: Some(rmsd),
                rows,
                ..Registration::default()
            }
        };
        registration.from.clone_from(&from.name);
        registration.to.clone_from(&to.name);
        registration.features = features;
        registration.findings = findings;
        Ok(registration)
    }

    fn by_points(
        &self,
        touched: &[Touched],
        findings: &mut Vec<Finding>,
        name: &str,
    ) -> Result<Registration, Failure> {
        let from: Vec<Vector> = touched.iter().map(|t| t.from_m).collect();
        let to: Vec<Vector> = touched.iter().map(|t| t.to_m).collect();
        let (weights, absolute) = weights(touched, name)?;
        let given = match self.sigma_mm {
            Some(sigma) if !absolute => Some(m_from_mm(sigma)),
            // weights are 1/σ² in 1/m²: at weight one the deviation is one metre
            _ if absolute => Some(1.0),
            _ => None,
        };
        let named =
            |error: &RegisterError| Failure::with_hint(format!("{name}: {error}"), error.hint());
        let weights = weights.as_deref();
        let (fit, used, rejected): (Fit, Option<Vec<f64>>, Vec<robust::BadTouch>) = if self.robust {
            let found = robust(&from, &to, weights, given).map_err(|error| named(&error))?;
            (found.fit, Some(found.weights), found.rejected)
        } else {
            let fit = kabsch(&from, &to, weights).map_err(|error| named(&error))?;
            (fit, weights.map(<[f64]>::to_vec), Vec::new())
        };
        let used = used.as_deref();
        let left = fit.residuals_m(&from, &to);
        let exact = touched.len() <= 3 && given.is_none();
        let sigma = given.unwrap_or_else(|| noise_m(&left, used));
        for bad in &rejected {
            let place = mm_from_m(bad.distance_m);
            findings.push(note(
                "bad-touch",
                Severity::Warning,
                name,
                format!(
                    "{} is left out: {place:.3} mm from where the others put it, {:.1} standard deviations (limit {})",
                    touched[bad.index].id, bad.sigmas, robust::LIMIT
                ),
            ));
        }
        if !self.robust {
            suspect(touched, &from, &to, weights, given, findings, name);
        }
        if exact {
            findings.push(note(
                "few-points",
                Severity::Note,
                name,
                "three points check each other little: the noise comes from three redundant distances".into(),
            ));
        }
        let scale_sigma = fit.scale_sigma(sigma);
        let off = fit.scale - 1.0;
        if touched.len() > 3 && off.abs() > SCALE && off.abs() > 4.0 * scale_sigma {
            let (steel, aluminium) = (off / 11.5e-6, off / 23.0e-6);
            let message = format!(
                "TO is {:.6} times as large as FROM (± {scale_sigma:.6}): other units, or a part {steel:+.0} K (steel) or {aluminium:+.0} K (aluminium) from the temperature of its drawing",
                fit.scale
            );
            findings.push(note("scale", Severity::Warning, name, message));
        }
        let mut rows: Vec<Measured> = touched
            .iter()
            .zip(&left)
            .map(|(t, r)| Measured::new(&t.id, *r).at(t.to_m))
            .collect();
        for bad in &rejected {
            rows[bad.index].rejected = Some(format!("{:.1} standard deviations", bad.sigmas));
        }
        Ok(Registration {
            method: if self.robust {
                "kabsch, robust"
            } else {
                "kabsch"
            },
            to_from_from: fit.to_from_from,
            covariance: Some(fit.covariance(&from, used, sigma)),
            // told for a point of weight one, which is no length where the weights are 1/σ²
            sigma_m: (!absolute).then_some(sigma),
            sigma_given: given.is_some(),
            rmsd_m: Some(fit.rmsd_m(&from, &to, used)),
            scale: Some((fit.scale, scale_sigma)),
            rows,
            ..Registration::default()
        })
    }
}

/// Without --robust: a point that the others contradict is told, not left out.
fn suspect(
    touched: &[Touched],
    from: &[Vector],
    to: &[Vector],
    weights: Option<&[f64]>,
    given: Option<f64>,
    findings: &mut Vec<Finding>,
    name: &str,
) {
    if touched.len() < robust::FEWEST || touched.len() > 2000 {
        return;
    }
    let Ok(found) = robust(from, to, weights, given) else {
        return;
    };
    for bad in found.rejected.iter().filter(|bad| bad.sigmas > SUSPECT) {
        findings.push(Finding {
            hint: "--robust leaves such touches out".into(),
            ..note(
                "suspect-touch",
                Severity::Warning,
                name,
                format!(
                    "{} is {:.3} mm from where the others put it, {:.1} standard deviations; it is in the fit",
                    touched[bad.index].id,
                    mm_from_m(bad.distance_m),
                    bad.sigmas
                ),
            )
        });
    }
}

/// Weights of points: 1/σ² of `sigma_mm` (absolute), or the column `weight`.
fn weights(touched: &[Touched], name: &str) -> Result<(Option<Vec<f64>>, bool), Failure> {
    let sigmas = touched.iter().filter(|t| t.variance_m2.is_some()).count();
    let relative = touched.iter().filter(|t| t.weight.is_some()).count();
    if sigmas > 0 && relative > 0 {
        return Err(Failure::new(format!(
            "{name}: sigma_mm and weight cannot both be given"
        )));
    }
    if sigmas > 0 {
        let each = touched.iter().map(|t| t.variance_m2.map(|v| 1.0 / v));
        let all: Option<Vec<f64>> = each.collect();
        let all = all.ok_or_else(|| {
            Failure::new(format!("{name}: sigma_mm is given for some points only"))
        })?;
        return Ok((Some(all), true));
    }
    if relative > 0 {
        let each = touched.iter().map(|t| t.weight.unwrap_or(1.0));
        return Ok((Some(each.collect()), false));
    }
    Ok((None, false))
}

fn datum(row: &PointRow) -> Option<usize> {
    match row.datum.as_deref() {
        Some("1") => Some(0),
        Some("2") => Some(1),
        Some("3") => Some(2),
        _ => None,
    }
}

fn point(pair: &Pair, radius: f64, to_name: &str) -> Result<Touched, Failure> {
    let (from, to) = (pair.from, pair.to[0]);
    let (mut from_m, mut to_m) = (from.point_m, to.point_m);
    if radius > 0.0 {
        match (to.normal, from.normal) {
            (Some(normal), _) => to_m = compensated(to_m, radius, normal),
            // the centre of the ball at the nominal point
            (None, Some(normal)) => from_m = add(from_m, scale(radius, normal)),
            (None, None) => {
                let message = format!(
                    "{to_name}: point {}: --probe-radius-mm needs the outward normal nx,ny,nz of the touched surface in FROM or TO",
                    from.id
                );
                return Err(Failure::with_hint(message, "spheres and holes need none"));
            }
        }
    }
    let variances = [from.sigma_m, to.sigma_m].map(|s| s.map(|s| s * s));
    let variance_m2 = match variances {
        [None, None] => None,
        [a, b] => Some(a.unwrap_or(0.0) + b.unwrap_or(0.0)),
    };
    Ok(Touched {
        id: from.id.clone(),
        from_m,
        to_m,
        variance_m2,
        weight: to.weight.or(from.weight),
    })
}

fn plane(pair: &Pair, from_name: &str) -> Result<TouchedPlane, Failure> {
    let normal = pair.from.normal.ok_or_else(|| {
        Failure::new(format!(
            "{from_name}: plane {} needs its outward normal nx,ny,nz",
            pair.from.id
        ))
    })?;
    Ok(TouchedPlane {
        point_m: pair.from.point_m,
        normal,
        touches_m: pair.to.iter().map(|row| row.point_m).collect(),
    })
}

fn round(
    pair: &Pair,
    probe_radius_m: f64,
    to_name: &str,
    findings: &mut Vec<Finding>,
) -> Result<(Touched, serde_json::Value), Failure> {
    let touches: Vec<Vector> = pair.to.iter().map(|row| row.point_m).collect();
    let id = &pair.from.id;
    let fail = |error: FeatureError| Failure::new(format!("{to_name}: {id}: {error}"));
    let is_sphere = pair.from.feature == Feature::Sphere;
    let (fit, parameters): (Round, usize) = if is_sphere {
        (features::sphere(&touches).map_err(fail)?, 4)
    } else {
        (features::circle(&touches).map_err(fail)?, 3)
    };
    // the ball stands outside a sphere and inside a hole
    let radius_m = if is_sphere {
        fit.radius_m - probe_radius_m
    } else {
        fit.radius_m + probe_radius_m
    };
    let noise = noise_of(&fit.residuals_m, parameters);
    if let Some(nominal) = pair.from.radius_m {
        let off = radius_m - nominal;
        let limit = noise.map_or(5e-5, |n| (5.0 * n * fit.radius_sigma).max(2e-5));
        if off.abs() > limit {
            findings.push(Finding {
                hint: "is the probe's radius right?".into(),
                ..note(
                    "feature-radius",
                    Severity::Warning,
                    to_name,
                    format!(
                        "{id}: radius {:.4} mm instead of {:.4} mm (limit {:.4} mm)",
                        mm_from_m(radius_m),
                        mm_from_m(nominal),
                        mm_from_m(limit)
                    ),
                )
            });
        }
    }
    let feature = serde_json::json!({
        "id": id, "feature": if is_sphere { "sphere" } else { "hole" }, "touches": touches.len(),
        "centre_mm": fit.centre_m.map(mm_from_m), "radius_mm": mm_from_m(radius_m),
        "noise_mm": noise.map(mm_from_m),
    });
    let touched = Touched {
        id: id.clone(),
        from_m: pair.from.point_m,
        to_m: fit.centre_m,
        variance_m2: None,
        weight: pair.from.weight,
    };
    Ok((touched, feature))
}

/// The same numbers twice are a copy, not a measurement.
pub(super) fn refuse_identical(from: &Points, to: &Points) -> Result<(), Failure> {
    let same = from.rows.len() == to.rows.len()
        && from
            .rows
            .iter()
            .zip(&to.rows)
            .all(|(a, b)| norm(sub(a.point_m, b.point_m)) == 0.0);
    if same && !from.rows.is_empty() {
        return Err(Failure::with_hint(
            format!(
                "{} and {} are identical: nothing was measured",
                from.name, to.name
            ),
            "give the measured points as the second file",
        ));
    }
    Ok(())
}

pub(super) fn note(id: &'static str, severity: Severity, file: &str, message: String) -> Finding {
    Finding {
        id,
        severity,
        file: file.into(),
        line: 0,
        column: 0,
        message,
        hint: String::new(),
    }
}
