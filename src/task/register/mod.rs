//! `register`: the rigid motion between two sets of points, or a frame from probe touches.

mod balls;
#[cfg(feature = "icp")]
mod cloud;
mod construct;
mod matched;
mod planes;
pub(super) mod points;

pub use construct::Construction;

use super::Document;
use super::failure::Failure;
use super::parts::{Pose as PoseNumbers, Sigma};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, norm};
use crate::program::Source;
use crate::register::frame_file::{Frame, Sigma as Six};
#[cfg(feature = "icp")]
use crate::register::icp;
use crate::register::uncertainty::PoseCovariance;
use points::{Feature as Kind, PointRow, Points};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// How to register; lengths in metres.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Standard deviation of one coordinate of a point, both sets together; `None`: from the
    /// residuals.
    pub sigma_m: Option<f64>,
    /// Leave out touches that disagree with the others.
    pub robust: bool,
    /// Radius of the probe's ball: TO holds its centres.
    pub probe_radius_m: f64,
    /// Points of FROM whose error ellipsoids are asked for.
    pub at_m: Vec<Vector>,
    /// Leave out rows whose id the other file does not have.
    pub drop_unmatched: bool,
}

/// How the second set is found in the first.
pub enum Pairing<'a> {
    /// By `id` or by order.
    Rows(&'a Source),
    /// By nearness.
    #[cfg(feature = "icp")]
    Nearness(&'a Source, icp::Options),
    /// There is no second one: touches make a frame.
    Frame(Construction),
}

/// The residual of one point.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Residual {
    /// Its id.
    pub id: String,
    /// Measured minus mapped, along the axes of TO.
    pub residual_mm: [f64; 3],
    /// Its length.
    pub distance_mm: f64,
    /// Why it was left out; `null` where it was not.
    pub rejected: Option<String>,
    /// Where it was measured, in TO.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place_mm: Option<[f64; 3]>,
}

impl Residual {
    fn new(id: &str, residual_m: Vector) -> Self {
        Self {
            id: id.into(),
            residual_mm: residual_m.map(mm_from_m),
            distance_mm: mm_from_m(norm(residual_m)),
            rejected: None,
            place_mm: None,
        }
    }

    /// A point without a residual.
    #[must_use]
    pub fn still(id: &str, place_mm: [f64; 3]) -> Self {
        Self {
            place_mm: Some(place_mm),
            ..Self::new(id, [0.0; 3])
        }
    }

    /// It is here in TO.
    fn at(self, place_m: Vector) -> Self {
        Self {
            place_mm: Some(place_m.map(mm_from_m)),
            ..self
        }
    }
}

/// The error ellipsoid of one standard deviation at a point.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Ellipsoid {
    /// The point in FROM.
    pub from_mm: [f64; 3],
    /// The same in TO.
    pub to_mm: [f64; 3],
    /// Standard deviations along the axes of TO.
    pub sigma_mm: [f64; 3],
    /// Half axes, the longest first.
    pub half_axes_mm: [f64; 3],
    /// Their directions in TO.
    pub axes: [[f64; 3]; 3],
}

/// How many times as large TO is as FROM.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Scale {
    /// The factor.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
}

/// A sphere or a hole that was touched.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Feature {
    /// Its id.
    pub id: String,
    /// `sphere` or `hole`.
    pub feature: &'static str,
    /// How often it was touched.
    pub touches: usize,
    /// Its centre in TO.
    pub centre_mm: [f64; 3],
    /// Its radius.
    pub radius_mm: f64,
    /// Standard deviation of a touch; `null` where too few show it.
    pub noise_mm: Option<f64>,
}

/// One step of the search by nearness.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Step {
    /// Points of FROM in it.
    pub points: usize,
    /// Root mean square residual before it.
    pub rms_mm: f64,
    /// How far the outermost point moved.
    pub moved_mm: f64,
}

/// The search by nearness.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Search {
    /// Starts that were tried.
    pub starts: usize,
    /// Steps of the last stages.
    pub steps: Vec<Step>,
    /// Share of FROM that lies on TO.
    pub overlap: f64,
    /// What the roughness of both surfaces explains.
    pub expected_mm: f64,
    /// Root mean square residual of the pairs kept.
    pub rms_mm: f64,
    /// Whether nothing is uncertain.
    pub success: bool,
}

/// A rigid motion, and how well it is known.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Registration {
    /// How it was found.
    pub method: &'static str,
    /// What maps.
    pub from: String,
    /// Into what.
    pub to: String,
    /// Rows of the rotation matrix.
    pub rotation: [[f64; 3]; 3],
    /// w, x, y, z.
    pub quaternion: [f64; 4],
    /// Angles about the fixed axes x, y, z in turn.
    pub euler_xyz_deg: [f64; 3],
    /// Where FROM's origin is in TO.
    pub translation_mm: [f64; 3],
    /// The same transform as files have it.
    pub pose: PoseNumbers,
    /// Root mean square distance of the points.
    pub rmsd_mm: Option<f64>,
    /// Distances of the points.
    pub residuals_mm: Vec<f64>,
    /// Residuals of the points.
    pub points: Vec<Residual>,
    /// Standard uncertainties of FROM's origin and of rotations about the axes of TO.
    pub sigma: Option<Sigma>,
    /// Standard deviation of one coordinate of a point.
    pub noise_mm: Option<f64>,
    /// Where that comes from: `given` or `residuals`.
    pub noise_from: &'static str,
    /// What a person should look at.
    pub findings: Vec<Finding>,
    /// The frame file written.
    pub output: Option<String>,
    /// How many times as large TO is as FROM.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<Scale>,
    /// Spheres and holes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<Feature>,
    /// The error ellipsoid at FROM's origin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub origin: Option<Ellipsoid>,
    /// Error ellipsoids at the points asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Vec<Ellipsoid>>,
    /// The search by nearness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub icp: Option<Search>,
    /// Share of FROM that lies on TO.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap: Option<f64>,
    /// What the roughness of both surfaces explains.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms_expected_mm: Option<f64>,
    /// Points of the page alone: some of very many.
    #[serde(skip)]
    pub drawn: Vec<Residual>,
    /// The motion and its uncertainty as the frame file has them.
    #[serde(skip)]
    frame: (Pose, Option<PoseCovariance>),
}

impl Document for Registration {
    const KIND: &'static str = "registration/1";
}

/// A motion found, before it is reported.
struct Motion {
    method: &'static str,
    to_from_from: Pose,
    covariance: Option<PoseCovariance>,
    sigma_m: Option<f64>,
    sigma_given: bool,
    rmsd_m: Option<f64>,
    points: Vec<Residual>,
}

/// Finds the rigid motion that maps FROM into TO.
///
/// # Errors
/// Rows without partners, too few points, points in a line, other units.
pub fn register(
    from: &Source,
    pairing: &Pairing,
    options: &Options,
) -> Result<Registration, Failure> {
    let from = Points::read(from)?;
    refuse_ignored(pairing, options)?;
    match pairing {
        Pairing::Frame(kind) => {
            refuse_small(&[&from])?;
            refuse_two_sigmas(&[&from], options)?;
            construct::construct(&from, *kind, options)
        }
        Pairing::Rows(to) => {
            let to = distinct(&from, to)?;
            refuse_two_sigmas(&[&from, &to], options)?;
            refuse_small(&[&from, &to])?;
            matched::register(&from, &to, options)
        }
        #[cfg(feature = "icp")]
        Pairing::Nearness(to, icp) => {
            let to = distinct(&from, to)?;
            refuse_small(&[&from, &to])?;
            cloud::register(&from, &to, icp, options)
        }
    }
}

/// Refuses what this kind of registration would not use.
fn refuse_ignored(pairing: &Pairing, options: &Options) -> Result<(), Failure> {
    let (how, takes_radius) = match pairing {
        Pairing::Rows(_) => return Ok(()),
        Pairing::Frame(_) => ("--frame", true),
        #[cfg(feature = "icp")]
        Pairing::Nearness(..) => ("--icp", false),
    };
    let given = [
        ("--robust", options.robust),
        ("--drop-unmatched", options.drop_unmatched),
        (
            "--probe-radius-mm",
            options.probe_radius_m > 0.0 && !takes_radius,
        ),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((option, _)) => Err(Failure::with_hint(
            format!("{option} has no effect with {how}"),
            format!("leave {option} out; it is for points that are matched by id or by order"),
        )),
        None => Ok(()),
    }
}

/// Refuses a deviation of all points next to one of each.
fn refuse_two_sigmas(sets: &[&Points], options: &Options) -> Result<(), Failure> {
    let has_own = |set: &&&Points| set.rows.iter().any(|row| row.sigma_m.is_some());
    match sets
        .iter()
        .find(has_own)
        .filter(|_| options.sigma_m.is_some())
    {
        Some(set) => Err(Failure::with_hint(
            format!(
                "{}: the column sigma_mm and --sigma-mm cannot both be given",
                set.name
            ),
            "leave --sigma-mm out: the column says it of each point",
        )),
        None => Ok(()),
    }
}

/// Sets of points that spread over less, all of them, are in another unit.
const SMALLEST_M: f64 = 3e-3;

/// Refuses points in metres.
fn refuse_small(sets: &[&Points]) -> Result<(), Failure> {
    // where the point of a plane lies on it says nothing
    let is_point = |row: &&PointRow| row.feature != Kind::Plane;
    let spread_m = |set: &&Points| {
        let points = set.rows.iter().filter(is_point);
        planes::spread_m(points.map(|row| row.point_m))
    };
    let largest = sets.iter().map(spread_m).fold(0.0, f64::max);
    if largest >= SMALLEST_M || sets.iter().any(|set| set.rows.is_empty()) {
        return Ok(());
    }
    let names: Vec<&str> = sets.iter().map(|set| set.name.as_str()).collect();
    Err(Failure::with_hint(
        format!(
            "{}: the points spread over {:.6} mm only (limit {:.0} mm): are they in metres?",
            names.join(" and "),
            mm_from_m(largest),
            mm_from_m(SMALLEST_M)
        ),
        "files are in mm",
    ))
}

/// The second set. The same numbers twice are a copy, not a measurement.
fn distinct(from: &Points, to: &Source) -> Result<Points, Failure> {
    let to = Points::read(to)?;
    if !from.rows.is_empty() && from.positions() == to.positions() {
        return Err(Failure::with_hint(
            format!(
                "{} and {} are identical: nothing was measured",
                from.name, to.name
            ),
            "give the measured points as the second file",
        ));
    }
    Ok(to)
}

impl Registration {
    fn new(from: &str, to: &str, motion: Motion, options: &Options) -> Self {
        let pose = motion.to_from_from;
        let [c, b, a] = pose.rotation.rzryrx(0.0);
        let covariance = motion.covariance;
        let ellipsoid = |p: &Vector| covariance.map(|c| ellipsoid(&c, &pose, *p));
        Self {
            method: motion.method,
            from: from.into(),
            to: to.into(),
            rotation: pose.rotation.0,
            quaternion: pose.rotation.quaternion().0,
            euler_xyz_deg: [a, b, c].map(|angle| angle / DEG),
            translation_mm: pose.translation.map(mm_from_m),
            pose: (&pose).into(),
            rmsd_mm: motion.rmsd_m.map(mm_from_m),
            residuals_mm: motion.points.iter().map(|row| row.distance_mm).collect(),
            points: motion.points,
            sigma: covariance.map(|c| (&Six::of(&c, &pose)).into()),
            noise_mm: motion.sigma_m.map(mm_from_m),
            noise_from: if motion.sigma_given {
                "given"
            } else {
                "residuals"
            },
            findings: Vec::new(),
            output: None,
            scale: None,
            features: Vec::new(),
            origin: ellipsoid(&[0.0; 3]),
            at: covariance.and_then(|_| options.at_m.iter().map(ellipsoid).collect()),
            icp: None,
            overlap: None,
            rms_expected_mm: None,
            drawn: Vec::new(),
            frame: (pose, covariance),
        }
    }

    /// Whether the answer is no: an uncertain result is not written.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        self.findings
            .iter()
            .any(|finding| finding.severity == Severity::Error)
    }

    /// The frame file's text.
    #[must_use]
    pub fn frame_text(&self) -> String {
        let (to_from_from, covariance) = &self.frame;
        let used = self.points.iter().filter(|row| row.rejected.is_none());
        Frame {
            to_from_from: *to_from_from,
            sigma: covariance.map(|c| Six::of(&c, to_from_from)),
            rmsd_m: self.rmsd_mm.map(crate::geometry::units::m_from_mm),
            points: (!self.points.is_empty()).then(|| used.count()),
            provenance: provenance([
                ("method", self.method),
                ("from", &self.from),
                ("to", &self.to),
            ]),
        }
        .to_yaml()
    }
}

/// Where a frame comes from, with the program's version.
pub(super) fn provenance<const N: usize>(words: [(&str, &str); N]) -> BTreeMap<String, String> {
    let version = ("version", env!("CARGO_PKG_VERSION"));
    let words = words.into_iter().chain([version]);
    words
        .map(|(key, word)| (key.to_owned(), word.to_owned()))
        .collect()
}

fn ellipsoid(covariance: &PoseCovariance, to_from_from: &Pose, from_m: Vector) -> Ellipsoid {
    let there = to_from_from.transform(from_m);
    let found = covariance.ellipsoid(there);
    Ellipsoid {
        from_mm: from_m.map(mm_from_m),
        to_mm: there.map(mm_from_m),
        sigma_mm: covariance.sigma_at_m(there).map(mm_from_m),
        half_axes_mm: found.half_axes_m.map(mm_from_m),
        axes: std::array::from_fn(|i| found.axes.axis(i)),
    }
}

#[cfg(test)]
mod tests;
