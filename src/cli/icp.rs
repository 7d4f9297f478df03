//! `register --icp`: clouds without known correspondence.

use super::failure::Failure;
use super::points::Points;
use super::register::{Register, note, refuse_identical};
use super::registration::{Measured, Registration};
use super::values;
use crate::finding::Severity;
use crate::geometry::units::{m_from_mm, mm_from_m};
use crate::register::icp::{Doubt, Left, Metric, Options, icp};
use clap::{Args, ValueEnum};
use serde_json::json;

/// How clouds are matched.
#[derive(Args)]
pub struct IcpOptions {
    /// Match points by nearness (iterative closest point): correspondence is unknown
    #[arg(long)]
    icp: bool,
    /// What is made small; normals are TO's nx,ny,nz or estimated
    #[arg(long, value_enum, default_value = "plane", requires = "icp")]
    icp_metric: IcpMetric,
    /// First guess x,y,z,rx,ry,rz of the transform in mm and degrees (default: a search)
    #[arg(
        long,
        value_name = "POSE",
        allow_hyphen_values = true,
        requires = "icp"
    )]
    start: Option<String>,
    /// Share of the nearest pairs that is kept in each step
    #[arg(long, value_name = "SHARE", default_value_t = 0.9, requires = "icp")]
    keep: f64,
    /// Share of FROM that must lie on TO
    #[arg(long, value_name = "SHARE", default_value_t = 0.6, requires = "icp")]
    min_overlap: f64,
}

/// What ICP makes small
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum IcpMetric {
    /// Distance from the tangent plane at the nearest point
    Plane,
    /// Distance from the nearest point
    Point,
}

impl IcpOptions {
    pub fn is_asked(&self) -> bool {
        self.icp
    }

    fn options(&self, sigma_mm: Option<f64>) -> Result<Options, Failure> {
        for (name, value) in [("--keep", self.keep), ("--min-overlap", self.min_overlap)] {
            if !(value > 0.0 && value <= 1.0) {
                return Err(Failure::new(format!(
                    "{name} {value}: it must be above 0 and at most 1"
                )));
            }
        }
        let start = self
            .start
            .as_deref()
            .map(|text| {
                values::pose(text).ok_or_else(|| {
                    Failure::new(format!(
                        "--start {text}: it must be x,y,z,rx,ry,rz in mm and degrees"
                    ))
                })
            })
            .transpose()?;
        Ok(Options {
            metric: match self.icp_metric {
                IcpMetric::Plane => Metric::PointToPlane,
                IcpMetric::Point => Metric::PointToPoint,
            },
            start,
            kept: self.keep,
            min_overlap: self.min_overlap,
            sigma_m: sigma_mm.map(m_from_mm),
        })
    }
}

/// What is left at a point, for the page.
fn left(one: &Left, from: &Points, kept: f64) -> Measured {
    let measured = Measured::new(&from.rows[one.index].id, one.left_m).at(one.at_m);
    Measured {
        rejected: (!one.kept).then(|| format!("beyond the nearest {:.0} %", 100.0 * kept)),
        ..measured
    }
}

/// Registers two clouds; a doubtful result is an error finding.
pub fn run(command: &Register, from: &Points, to: &Points) -> Result<Registration, Failure> {
    refuse_identical(from, to)?;
    let options = command.icp.options(command.sigma_mm)?;
    let normals: Option<Vec<_>> = to.rows.iter().map(|row| row.normal).collect();
    let found = icp(
        &from.positions(),
        &to.positions(),
        normals.as_deref(),
        &options,
    )
    .map_err(|error| {
        Failure::with_hint(
            format!("{} and {}: {error}", from.name, to.name),
            error.hint(),
        )
    })?;
    let findings = found
        .doubts
        .iter()
        .map(|doubt| {
            let (id, hint) = match doubt {
                Doubt::Moving { .. } => ("icp-not-converged", "give a better --start"),
                Doubt::Residual { .. } => (
                    "icp-local-minimum",
                    "give a --start, or --sigma-mm if the noise is known to be larger",
                ),
                Doubt::Overlap { .. } => (
                    "icp-overlap",
                    "give a --start; where only a part was scanned, a smaller --keep and --min-overlap",
                ),
                Doubt::Free { .. } => ("icp-free-motion", "scan more of the part"),
                Doubt::Ambiguous { .. } => ("icp-ambiguous", "--start says which pose is meant"),
            };
            let mut finding = note(id, Severity::Error, &to.name, doubt.to_string());
            finding.hint = hint.into();
            finding
        })
        .collect();
    let steps: Vec<_> = found
        .steps
        .iter()
        .map(|s| {
            json!({"points": s.points, "rms_mm": mm_from_m(s.rms_m), "moved_mm": mm_from_m(s.moved_m)})
        })
        .collect();
    let last = found.steps.last().map_or(0.0, |s| mm_from_m(s.moved_m));
    let more = vec![
        (
            "icp",
            json!({"starts": found.starts, "steps": steps, "overlap": found.overlap,
                   "expected_mm": mm_from_m(found.expected_m), "rms_mm": mm_from_m(found.rms_m),
                   "success": found.doubts.is_empty()}),
            format!(
                "search: {} starts, {} steps, the last moved points by {last:.1e} mm",
                found.starts,
                found.steps.len()
            ),
        ),
        (
            "overlap",
            json!(found.overlap),
            format!("overlap: {:.3} of FROM lies on TO", found.overlap),
        ),
        (
            "rms_expected_mm",
            json!(mm_from_m(found.expected_m)),
            format!(
                "residual: {:.4} mm; the points' roughness explains {:.4} mm",
                mm_from_m(found.rms_m),
                mm_from_m(found.expected_m)
            ),
        ),
    ];
    Ok(Registration {
        method: match options.metric {
            Metric::PointToPlane => "icp, point to plane",
            Metric::PointToPoint => "icp, point to point",
        },
        from: from.name.clone(),
        to: to.name.clone(),
        to_from_from: found.to_from_from,
        covariance: found.covariance,
        rmsd_m: Some(found.rms_m),
        sigma_m: Some(found.expected_m),
        sigma_given: options.sigma_m.is_some(),
        more,
        findings,
        drawn: found
            .left
            .iter()
            .map(|one| left(one, from, options.kept))
            .collect(),
        ..Registration::default()
    })
}
