//! Points and touches of planes together.

use super::matched::{Touched, UNLIKE, other_sigma, unlike, variance_of, warning, weights};
use super::points::Pair;
use super::{Motion, Options, Residual};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Vector, norm, scale};
use crate::register::RegisterError;
use crate::register::frames::{FeatureFit, Misfit, Part, TouchedPlane, weighted_points_and_planes};
use crate::task::Failure;

/// Points whose distances in both sets differ by this factor or more are in different units.
const UNITS: f64 = 1.5;

/// What was touched.
pub(super) struct Touches<'a> {
    pub points: &'a [Touched],
    /// With their ids.
    pub planes: &'a [(&'a str, TouchedPlane)],
    /// Every touch of every plane, in order.
    pub on_planes: &'a [Touched],
    /// How TO is named.
    pub name: &'a str,
}

impl Touches<'_> {
    pub(super) fn register(
        &self,
        options: &Options,
        findings: &mut Vec<Finding>,
    ) -> Result<Motion, Failure> {
        let name = self.name;
        if options.robust {
            return Err(Failure::new("--robust takes points only, no planes"));
        }
        self.refuse_other_units()?;
        let all: Vec<&Touched> = self.points.iter().chain(self.on_planes).collect();
        let (mut weights, absolute) = weights(&all, name)?;
        let mut given = options.sigma_m;
        if let (true, Some(weights)) = (absolute, &mut weights) {
            // relative to the surest row, so that deviations stay lengths
            let most = weights.iter().copied().fold(0.0, f64::max);
            for weight in weights.iter_mut() {
                *weight /= most;
            }
            given = Some(1.0 / most.sqrt());
        }
        let points: Vec<_> = self.points.iter().map(|t| (t.from_m, t.to_m)).collect();
        let planes: Vec<TouchedPlane> = self.planes.iter().map(|(_, p)| p.clone()).collect();
        let (radius, weights) = (options.probe_radius_m, weights.as_deref());
        let fit = weighted_points_and_planes(&points, &planes, weights, radius, given)
            .map_err(|error| Failure::with_hint(format!("{name}: {error}"), error.hint()))?;
        findings.extend(self.corner(&fit));
        let rows = self.residuals(&fit);
        let squares: Vec<f64> = rows.iter().map(|row| norm(row.1).powi(2)).collect();
        let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
        let whole: f64 = squares.iter().enumerate().map(|(i, s)| weight(i) * s).sum();
        let total: f64 = (0..squares.len()).map(weight).sum();
        self.refuse_unlike(&fit, (whole / total).sqrt())?;
        findings.extend(fit.misfits.iter().map(|misfit| self.contradicted(misfit)));
        if let Some(given) = given {
            let freedom = (3 * self.points.len() + self.on_planes.len()).saturating_sub(6);
            let times = (whole / freedom.max(1) as f64).sqrt() / given;
            findings.extend(other_sigma(times, freedom.max(1) as f64, name));
        }
        let count = squares.len() as f64;
        Ok(Motion {
            method: "points and planes",
            to_from_from: fit.to_from_from,
            // reported for a row of weight one, which is no length where the weights are 1/σ²
            sigma_m: (!absolute).then_some(fit.sigma_m),
            sigma_given: given.is_some(),
            covariance: Some(fit.covariance),
            rmsd_m: Some((squares.iter().sum::<f64>() / count).sqrt()),
            points: rows.into_iter().map(|(row, _)| row).collect(),
        })
    }

    /// Residuals of points and then of touches, as reported and in metres.
    fn residuals(&self, fit: &FeatureFit) -> Vec<(Residual, Vector)> {
        let points = self.points.iter().zip(&fit.points_m);
        let points = points.map(|(t, r)| (Residual::new(&t.id, *r).at(t.to_m), *r));
        let normals = self
            .planes
            .iter()
            .zip(&fit.planes_m)
            .flat_map(|((_, plane), left)| {
                let normal = fit.to_from_from.rotation * plane.normal;
                left.iter().map(move |along| scale(*along, normal))
            });
        let touches = self.on_planes.iter().zip(normals);
        let touches = touches.map(|(touch, r)| (Residual::new(&touch.id, r), r));
        points.chain(touches).collect()
    }

    fn corner(&self, fit: &FeatureFit) -> Option<Finding> {
        (fit.others > 0).then(|| {
            let message = format!(
                "{} other poses fit as well: the planes are taken as faces of a convex corner, of \
                 which no touch lies outside of another face",
                fit.others
            );
            Finding::of_file("convex-corner", Severity::Note, self.name, message)
                .hint("a point off the planes settles it")
        })
    }

    /// Refuses points that are farther apart, or nearer, than those of FROM.
    fn refuse_other_units(&self) -> Result<(), Failure> {
        let from_m = spread_m(self.points.iter().map(|t| t.from_m));
        let to_m = spread_m(self.points.iter().map(|t| t.to_m));
        let ratio = to_m / from_m;
        if !ratio.is_finite() || ratio > 1.0 / UNITS && ratio < UNITS {
            return Ok(());
        }
        let error = RegisterError::Units { ratio };
        let message = format!("{}: {error}", self.name);
        Err(Failure::with_hint(message, error.hint()))
    }

    /// Refuses touches that no motion lays on what they touched.
    fn refuse_unlike(&self, fit: &FeatureFit, rmsd_m: f64) -> Result<(), Failure> {
        let all = self.points.iter().chain(self.on_planes);
        let limit_m = UNLIKE * spread_m(all.map(|t| t.to_m));
        if rmsd_m <= limit_m {
            return Ok(());
        }
        let message = unlike(self.name, rmsd_m, limit_m);
        let worst = fit.misfits.first().map(|misfit| self.named(misfit.part));
        let worst = worst.map_or_else(String::new, |name| {
            format!("; the others contradict {name} most")
        });
        let hint = "do the ids of both files belong together, and do all normals point outward?";
        Err(Failure::with_hint(message, format!("{hint}{worst}")))
    }

    fn named(&self, part: Part) -> String {
        let first = |plane: usize| -> usize {
            let before = self.planes[..plane].iter();
            before.map(|(_, plane)| plane.touches_m.len()).sum()
        };
        match part {
            Part::Point(index) => self.points[index].id.clone(),
            Part::Touch(plane, touch) => self.on_planes[first(plane) + touch].id.clone(),
            Part::Plane(plane) => format!("plane {}", self.planes[plane].0),
        }
    }

    fn contradicted(&self, misfit: &Misfit) -> Finding {
        let message = format!(
            "{} is {:.3} mm from where the others put it, {:.1} standard deviations; it is in the \
             fit",
            self.named(misfit.part),
            mm_from_m(misfit.off_m),
            misfit.sigmas
        );
        warning("suspect-touch", self.name, message).hint(match misfit.part {
            Part::Plane(_) => "does its normal in FROM point outward, and is its point on it?",
            _ => "touch it again, or leave its row out",
        })
    }
}

/// Root mean square distance of points from their middle; zero of none.
pub(super) fn spread_m(points: impl Iterator<Item = Vector>) -> f64 {
    let points: Vec<Vector> = points.collect();
    let count = points.len().max(1) as f64;
    let squares = (0..3).map(|k| {
        let mean = points.iter().map(|p| p[k]).sum::<f64>() / count;
        points.iter().map(|p| (p[k] - mean).powi(2)).sum::<f64>() / count
    });
    squares.sum::<f64>().sqrt()
}

/// The touches of a plane.
pub(super) fn touches_of(pair: &Pair) -> impl Iterator<Item = Touched> {
    let from = pair.from;
    pair.to.iter().enumerate().map(move |(k, to)| Touched {
        id: format!("{}/{}", from.id, k + 1),
        from_m: from.point_m,
        to_m: to.point_m,
        variance_m2: variance_of([from.sigma_m, to.sigma_m]),
        weight: to.weight.or(from.weight),
        shape: None,
        of_touch: 1.0,
    })
}

pub(super) fn plane(pair: &Pair, from_name: &str) -> Result<TouchedPlane, Failure> {
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
