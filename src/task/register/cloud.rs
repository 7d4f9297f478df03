//! Clouds without known correspondence.

use super::points::Points;
use super::{Motion, Options, Registration, Residual, Search, Step};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::register::icp::{self, Concern, Metric, PointResidual, icp};
use crate::task::Failure;

/// Registers two clouds; a concernful result is an error finding.
pub(super) fn register(
    from: &Points,
    to: &Points,
    search: &icp::Options,
    options: &Options,
) -> Result<Registration, Failure> {
    let normals: Option<Vec<_>> = to.rows.iter().map(|row| row.normal).collect();
    let found = icp(
        &from.positions(),
        &to.positions(),
        normals.as_deref(),
        search,
    )
    .map_err(|error| {
        let message = format!("{} and {}: {error}", from.name, to.name);
        Failure::with_hint(message, error.hint())
    })?;
    let motion = Motion {
        method: match search.metric {
            Metric::PointToPlane => "icp, point to plane",
            Metric::PointToPoint => "icp, point to point",
        },
        to_from_from: found.to_from_from,
        covariance: found.covariance,
        rmsd_m: Some(found.rms_m),
        sigma_m: Some(found.expected_m),
        sigma_given: search.sigma_m.is_some(),
        points: Vec::new(),
    };
    let steps = found.steps.iter().map(|s| Step {
        points: s.points,
        rms_mm: mm_from_m(s.rms_m),
        moved_mm: mm_from_m(s.moved_m),
    });
    Ok(Registration {
        findings: found
            .concerns
            .iter()
            .map(|d| finding(d, &to.name))
            .collect(),
        icp: Some(Search {
            starts: found.starts,
            steps: steps.collect(),
            overlap: found.overlap,
            expected_mm: mm_from_m(found.expected_m),
            rms_mm: mm_from_m(found.rms_m),
            success: found.concerns.is_empty(),
        }),
        overlap: Some(found.overlap),
        rms_expected_mm: Some(mm_from_m(found.expected_m)),
        drawn: found
            .left
            .iter()
            .map(|one| residual(one, from, search.kept))
            .collect(),
        ..Registration::new(&from.name, &to.name, motion, options)
    })
}

fn finding(concern: &Concern, name: &str) -> Finding {
    let (id, hint) = match concern {
        Concern::Moving { .. } => ("icp-not-converged", "give a better --start"),
        Concern::Residual { .. } => (
            "icp-local-minimum",
            "give a --start, or --sigma-mm if the noise is known to be larger",
        ),
        Concern::Overlap { .. } => (
            "icp-overlap",
            "give a --start; where only a part was scanned, a smaller --keep and --min-overlap",
        ),
        Concern::Free { .. } => ("icp-free-motion", "scan more of the part"),
        Concern::Ambiguous { .. } => ("icp-ambiguous", "--start says which pose is meant"),
    };
    Finding::of_file(id, Severity::Error, name, concern.to_string()).hint(hint)
}

/// The residual of a point, for the page.
fn residual(one: &PointResidual, from: &Points, kept: f64) -> Residual {
    Residual {
        rejected: (!one.kept).then(|| format!("beyond the nearest {:.0} %", 100.0 * kept)),
        ..Residual::new(&from.rows[one.index].id, one.residual_m).at(one.at_m)
    }
}
