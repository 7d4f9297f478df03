//! Points whose partners are known: Kabsch, robustly or with planes.

use super::balls::round;
use super::planes::{Touches, plane, touches_of};
use super::points::{Feature, Pair, PointRow, Points, matched};
use super::{Motion, Options, Registration, Residual, Scale};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Vector, add, scale};
use crate::register::RegisterError;
use crate::register::features::compensated;
use crate::register::kabsch::{Fit, Redundancy, kabsch, largest_variance, noise_m};
use crate::register::robust::{self, robust};
use crate::task::Failure;
use crate::task::copies::{self, copies, without};

/// A residual above so many standard deviations of a coordinate is worth a look.
const SUSPECT: f64 = 4.35;
/// The same of fewer points than `--robust` needs: one in eight good sets of five has a residual
/// above [`SUSPECT`] of what the other four leave, one in 25 above this.
const SUSPECT_OF_FIVE: f64 = 8.0;
/// Fewest points of which one is suspected.
const FEWEST_SUSPECTED: usize = 5;
/// A scale that differs from 1 by more than this and its uncertainty is a finding.
const SCALE: f64 = 2e-5;
/// Points that the best motion leaves farther from their partners than this part of their spread do
/// not belong together.
pub(super) const UNLIKE: f64 = 0.05;
/// Shifts of rows that are tried.
const FARTHEST_SHIFT: usize = 100;
/// Residuals beyond this factor of what is stated contradict it,
const SIGMA_FACTOR: f64 = 1.5;
/// and beyond so many standard deviations of chance.
const SIGMA_CHANCE: f64 = 4.0;
/// Linear thermal expansion of steel and of aluminium, 1/K.
const EXPANSION: [f64; 2] = [11.5e-6, 23.0e-6];

/// A point of both sets.
pub(super) struct Touched {
    pub id: String,
    pub from_m: Vector,
    pub to_m: Vector,
    pub variance_m2: Option<f64>,
    pub weight: Option<f64>,
    /// Its covariance as a part of the mean of the three variances, along the axes of TO, where
    /// that is not alike in all directions.
    pub shape: Option<[[f64; 3]; 3]>,
    /// That mean over the variance of a touch: of a fitted centre, how well its touches fix it.
    pub of_touch: f64,
}

pub(super) fn warning(id: &'static str, file: &str, message: impl Into<String>) -> Finding {
    Finding::of_file(id, Severity::Warning, file, message)
}

pub(super) fn register(
    from: &Points,
    to: &Points,
    options: &Options,
) -> Result<Registration, Failure> {
    let (mut pairs, dropped) = matched(from, to, options.drop_unmatched)?;
    let mut findings = Vec::new();
    if !dropped.is_empty() {
        let message = format!("left out, for want of a partner: {}", dropped.join(", "));
        findings.push(warning("unmatched-ids", &to.name, message));
    }
    for pair in &mut pairs {
        findings.extend(touched_once(pair, &to.name));
    }
    let repeated = copies(pairs.iter().map(numbers));
    findings.extend(copies::finding(&repeated, &to.name, |row| {
        pairs[row].from.id.clone()
    }));
    let pairs = without(pairs, &repeated);
    let radius = options.probe_radius_m;
    let (mut touched, mut planes, mut on_planes) = (Vec::new(), Vec::new(), Vec::new());
    let mut features = Vec::new();
    for pair in &pairs {
        match pair.from.feature {
            Feature::Point => touched.push(point(pair, radius, &to.name)?),
            Feature::Plane => {
                planes.push((pair.from.id.as_str(), plane(pair, &from.name)?));
                on_planes.extend(touches_of(pair));
            }
            Feature::Sphere | Feature::Hole => {
                let (centre, feature) = round(pair, radius, &to.name, &mut findings)?;
                touched.push(centre);
                features.push(feature);
            }
        }
    }
    let (motion, scale) = if planes.is_empty() {
        by_points(&touched, options, &mut findings, &to.name)?
    } else {
        let planes = Touches {
            points: &touched,
            planes: &planes,
            on_planes: &on_planes,
            name: &to.name,
        };
        (planes.register(options, &mut findings)?, None)
    };
    Ok(Registration {
        findings,
        scale,
        features,
        ..Registration::new(&from.name, &to.name, motion, options)
    })
}

/// Leaves out touches of a feature that repeat an earlier one.
fn touched_once(pair: &mut Pair, name: &str) -> Option<Finding> {
    let repeated = copies(pair.to.iter().map(|row| row.point_m));
    pair.to = without(std::mem::take(&mut pair.to), &repeated);
    let id = &pair.from.id;
    let named = |touch: usize| format!("touch {} of {id}", touch + 1);
    copies::finding(&repeated, name, named)
}

/// What a pair of rows says.
fn numbers(pair: &Pair) -> Vec<f64> {
    let rows = std::iter::once(&pair.from).chain(&pair.to);
    let number = |row: &&PointRow| {
        let normal = row.normal.into_iter().flatten();
        row.point_m.into_iter().chain(normal).collect::<Vec<f64>>()
    };
    rows.flat_map(number).collect()
}

fn by_points(
    touched: &[Touched],
    options: &Options,
    findings: &mut Vec<Finding>,
    name: &str,
) -> Result<(Motion, Option<Scale>), Failure> {
    let from: Vec<Vector> = touched.iter().map(|t| t.from_m).collect();
    let to: Vec<Vector> = touched.iter().map(|t| t.to_m).collect();
    let (weights, absolute) = weights(&touched.iter().collect::<Vec<_>>(), name)?;
    // weights are 1/σ² in 1/m²: at weight one the deviation is one metre
    let given = if absolute { Some(1.0) } else { options.sigma_m };
    let named =
        |error: &RegisterError| Failure::with_hint(format!("{name}: {error}"), error.hint());
    let weights = weights.as_deref();
    let (fit, used, rejected): (Fit, Option<Vec<f64>>, Vec<robust::BadTouch>) = if options.robust {
        let found = robust(&from, &to, weights, given).map_err(|error| named(&error))?;
        (found.fit, Some(found.weights), found.rejected)
    } else {
        let fit = kabsch(&from, &to, weights).map_err(|error| named(&error))?;
        (fit, weights.map(<[f64]>::to_vec), Vec::new())
    };
    let used = used.as_deref();
    let residuals = fit.residuals_m(&from, &to);
    let exact = touched.len() <= 3 && given.is_none();
    let shapes = shapes(touched, weights.is_some(), given.is_some());
    let redundancy = match &shapes {
        Some(shapes) => fit.redundancy_of_shapes(&from, used, shapes),
        None => isotropic(fit.count),
    };
    let noise = || noise_m(&residuals, used) * (isotropic(fit.count).mean / redundancy.mean).sqrt();
    let sigma = given.unwrap_or_else(noise);
    for bad in &rejected {
        let message = format!(
            "{} is left out: {:.3} mm from where the others put it, {:.1} standard deviations \
             (limit {})",
            touched[bad.index].id,
            mm_from_m(bad.distance_m),
            bad.sigmas,
            robust::LIMIT
        );
        findings.push(warning("bad-touch", name, message));
    }
    let spread_m = (fit.from_spread_m2 / total_weight(used, touched.len())).sqrt();
    let sets = Sets {
        from: &from,
        to: &to,
        name,
    };
    sets.refuse_reversed(&rejected, spread_m)?;
    let times = given.map(|given| noise() / given);
    let contradicted = times.and_then(|times| other_sigma(times, redundancy.freedom, name));
    let mut bad = None;
    if !options.robust {
        let quiet = contradicted.is_some();
        let judging = shapes.as_ref().map(|shapes| surest(shapes, weights));
        let judging = judging.as_deref().or(weights);
        bad = suspect(touched, &sets, judging, given, spread_m, quiet, findings);
    }
    sets.refuse_unlike(&fit, used, spread_m, bad)?;
    findings.extend(contradicted);
    findings.extend(turned_over(
        &fit,
        fit.rmsd_m(&from, &to, used),
        spread_m,
        name,
    ));
    if exact {
        findings.push(Finding::of_file(
            "few-points",
            Severity::Note,
            name,
            "three points check each other little: the noise comes from three redundant distances",
        ));
    }
    let scale = Scale {
        value: fit.scale,
        // a stated deviation that the residuals contradict makes no scale sure
        sigma: fit.scale_sigma(sigma * times.unwrap_or(1.0).max(1.0)),
    };
    findings.extend(other_scale(&scale, touched.len(), name));
    let mut rows: Vec<Residual> = touched
        .iter()
        .zip(&residuals)
        .map(|(t, r)| Residual::new(&t.id, *r).at(t.to_m))
        .collect();
    for bad in &rejected {
        rows[bad.index].rejected = Some(format!("{:.1} standard deviations", bad.sigmas));
    }
    let motion = Motion {
        method: if options.robust {
            "kabsch, robust"
        } else {
            "kabsch"
        },
        to_from_from: fit.to_from_from,
        covariance: Some(match &shapes {
            Some(shapes) => fit.covariance_of_shapes(&from, used, sigma, shapes),
            None => fit.covariance(&from, used, sigma),
        }),
        // reported for a point of weight one, which is no length where the weights are 1/σ²
        sigma_m: (!absolute).then_some(sigma),
        sigma_given: given.is_some(),
        rmsd_m: Some(fit.rmsd_m(&from, &to, used)),
        points: rows,
    };
    Ok((motion, Some(scale)))
}

/// The covariance of each point at weight one, of noise of standard deviation one; `None` where all
/// are alike in all directions.
///
/// Weights say how sure points are next to one another. Without them a stated deviation is that of a
/// touch, by which a fitted centre is more or less sure; where none is stated it is the mean of all.
fn shapes(touched: &[Touched], weighted: bool, stated: bool) -> Option<Vec<[[f64; 3]; 3]>> {
    if touched.iter().all(|t| t.shape.is_none()) {
        return None;
    }
    let alike = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mean = touched.iter().map(|t| t.of_touch).sum::<f64>() / touched.len() as f64;
    let shape = |t: &Touched| {
        let size = match (weighted, stated) {
            (true, _) => 1.0,
            (false, true) => t.of_touch,
            (false, false) => t.of_touch / mean,
        };
        t.shape
            .unwrap_or(alike)
            .map(|row| row.map(|one| size * one))
    };
    Some(touched.iter().map(shape).collect())
}

/// What the residuals of so many points come to that are alike in all directions.
fn isotropic(points: usize) -> Redundancy {
    let freedom = (3 * points) as f64 - 6.0;
    Redundancy {
        mean: freedom.max(1.0),
        freedom: freedom.max(1.0),
    }
}

/// Weights by which no point is farther off than its noise lets it be in its worst direction.
fn surest(shapes: &[[[f64; 3]; 3]], weights: Option<&[f64]>) -> Vec<f64> {
    let each = shapes.iter().enumerate();
    each.map(|(i, shape)| weights.map_or(1.0, |w| w[i]) / largest_variance(shape))
        .collect()
}

fn other_scale(scale: &Scale, points: usize, name: &str) -> Option<Finding> {
    let off = scale.value - 1.0;
    (points > 3 && off.abs() > SCALE && off.abs() > 4.0 * scale.sigma).then(|| {
        let [steel, aluminium] = EXPANSION.map(|expansion| off / expansion);
        let message = format!(
            "TO is {:.6} times as large as FROM (± {:.6}): other units, or a part {steel:+.0} K \
             (steel) or {aluminium:+.0} K (aluminium) from the temperature of its drawing",
            scale.value, scale.sigma
        );
        warning("scale", name, message)
    })
}

fn total_weight(weights: Option<&[f64]>, count: usize) -> f64 {
    weights.map_or(count as f64, |w| w.iter().sum())
}

/// A stated deviation that the residuals contradict, by χ² of as many degrees of freedom.
pub(super) fn other_sigma(times: f64, freedom: f64, name: &str) -> Option<Finding> {
    // Wilson and Hilferty: the cube root of χ²/ν is nearly normal
    let spread = 2.0 / (9.0 * freedom);
    let chance = |sign: f64| {
        let root = 1.0 - spread + sign * SIGMA_CHANCE * spread.sqrt();
        root.max(0.0).powf(1.5)
    };
    let (least, most) = (
        chance(-1.0).min(SIGMA_FACTOR.recip()),
        chance(1.0).max(SIGMA_FACTOR),
    );
    if times > most {
        let message = format!(
            "residuals are {times:.1} times the stated standard deviations (limit {most:.1}): these \
             are too small, or the points are not those of FROM; the uncertainties here come from \
             what is stated"
        );
        let hint = "sigma_mm is one standard deviation of a coordinate in mm; without it the noise \
                    comes from the residuals";
        return Some(warning("sigma-small", name, message).hint(hint));
    }
    (times < least).then(|| {
        let message = format!(
            "residuals are {times:.3} times the stated standard deviations (limit {least:.3}): \
             these are too large"
        );
        let hint = "sigma_mm is one standard deviation of a coordinate in mm, not in micrometres";
        warning("sigma-large", name, message).hint(hint)
    })
}

/// Matched points of two files.
struct Sets<'a> {
    from: &'a [Vector],
    to: &'a [Vector],
    name: &'a str,
}

impl Sets<'_> {
    /// Refuses points that no motion and no change of size lays on their partners.
    /// `bad` says which few rows are to blame, where the others fit.
    fn refuse_unlike(
        &self,
        fit: &Fit,
        used: Option<&[f64]>,
        spread_m: f64,
        bad: Option<String>,
    ) -> Result<(), Failure> {
        let limit_m = UNLIKE * spread_m;
        let rmsd_m = fit.rmsd_m(self.from, self.to, used);
        if rmsd_m <= limit_m {
            return Ok(());
        }
        // another size is a finding of its own
        let total = total_weight(used, self.from.len());
        let of_size = (fit.scale - 1.0).powi(2) * fit.from_spread_m2 / total;
        if rmsd_m.powi(2) - of_size <= limit_m.powi(2) {
            return Ok(());
        }
        let message = unlike(self.name, rmsd_m, limit_m);
        // the reverse order explains all rows, what is bad in this one only the others
        let reversed = self
            .reversed(limit_m)
            .map(|left_m| self.in_order("in the reverse order", left_m));
        let hint = reversed.or(bad).unwrap_or_else(|| self.shifted(limit_m));
        Err(Failure::with_hint(message, hint))
    }

    /// Refuses to leave touches out where all of them fit in the reverse order.
    fn refuse_reversed(&self, rejected: &[robust::BadTouch], spread_m: f64) -> Result<(), Failure> {
        let distances = rejected.iter().map(|bad| bad.distance_m);
        let Some(farthest_m) = distances.reduce(f64::max) else {
            return Ok(());
        };
        let limit_m = (UNLIKE * spread_m).min(CLEARLY_NEARER * farthest_m);
        let Some(left_m) = self.reversed(limit_m) else {
            return Ok(());
        };
        let message = format!(
            "{}: {} of {} touches do not fit, by up to {:.3} mm",
            self.name,
            rejected.len(),
            self.to.len(),
            mm_from_m(farthest_m)
        );
        Err(Failure::with_hint(
            message,
            self.in_order("in the reverse order", left_m),
        ))
    }

    /// What the rows leave in the reverse order, where they fit.
    fn reversed(&self, limit_m: f64) -> Option<f64> {
        let turned: Vec<Vector> = self.to.iter().rev().copied().collect();
        left_m(self.from, &turned, limit_m)
    }

    /// That the rows fit in another order.
    fn in_order(&self, order: &str, left_m: f64) -> String {
        format!(
            "with the rows of {} taken {order} they fit to {:.3} mm: put them in the order of FROM, or \
             give both files a column id",
            self.name,
            mm_from_m(left_m)
        )
    }

    /// By how many rows they have to be shifted to fit.
    fn shifted(&self, limit_m: f64) -> String {
        let n = self.from.len();
        let mut found: Vec<(f64, String)> = Vec::new();
        // so many are left that they do not fit by chance
        for by in 1..=(n / 2).min(FARTHEST_SHIFT).min(n.saturating_sub(4)) {
            let rest = n - by;
            let shifts = [
                (&self.from[..rest], &self.to[by..], "later"),
                (&self.from[by..], &self.to[..rest], "earlier"),
            ];
            for (from, to, whither) in shifts {
                let left = left_m(from, to, limit_m);
                found.extend(left.map(|left| (left, format!("{by} row(s) {whither}"))));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.first().map_or_else(
            || "do the rows of both files belong together? a column id in both matches them".into(),
            |(left, order)| self.in_order(order, *left),
        )
    }
}

/// What the best motion leaves, where that is no more than a limit.
fn left_m(from: &[Vector], to: &[Vector], limit_m: f64) -> Option<f64> {
    let fit = kabsch(from, to, None).ok()?;
    Some(fit.rmsd_m(from, to, None)).filter(|left| *left <= limit_m)
}

/// Without --robust: a point that the others contradict is reported, not left out. Which these are
/// and the way out, where the others fit.
fn suspect(
    touched: &[Touched],
    sets: &Sets,
    weights: Option<&[f64]>,
    given: Option<f64>,
    spread_m: f64,
    sigma_contradicted: bool,
    findings: &mut Vec<Finding>,
) -> Option<String> {
    if touched.len() > 2000 {
        return None;
    }
    let Sets { from, to, name } = *sets;
    let found = match robust::agreeing(from, to, weights, given, FEWEST_SUSPECTED) {
        Ok(found) => found,
        Err(error @ RegisterError::NoAgreement { .. }) => {
            if !sigma_contradicted {
                let finding = warning("no-agreement", name, error.to_string());
                findings.push(finding.hint(error.hint()));
            }
            return None;
        }
        Err(_) => return None,
    };
    let (enough, hint) = if touched.len() < robust::FEWEST {
        (SUSPECT_OF_FIVE, "touch it again; --robust needs six points")
    } else {
        (SUSPECT, "--robust leaves such touches out")
    };
    let mut named = Vec::new();
    for bad in found.rejected.iter().filter(|bad| bad.sigmas > enough) {
        let id = &touched[bad.index].id;
        let distance_mm = mm_from_m(bad.distance_m);
        let message = format!(
            "{id} is {distance_mm:.3} mm from where the others put it, {:.1} standard deviations; \
             it is in the fit",
            bad.sigmas
        );
        findings.push(warning("suspect-touch", name, message).hint(hint));
        named.push(format!("{id} ({distance_mm:.3} mm)"));
    }
    let left_m = found.fit.rmsd_m(from, to, Some(&found.weights));
    let more = named.len().saturating_sub(NAMED);
    named.truncate(NAMED);
    (!named.is_empty() && left_m <= UNLIKE * spread_m).then(|| {
        let and = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        format!(
            "the others fit to {:.3} mm without {}{and}: are rows exchanged? {hint}",
            mm_from_m(left_m),
            named.join(", ")
        )
    })
}

/// Another order leaves less than this part of how far bad touches are off.
const CLEARLY_NEARER: f64 = 0.1;
/// So many bad rows are named in an error.
const NAMED: usize = 6;
/// A mirror image fits as well that leaves less than this times what the motion does.
const AS_WELL: f64 = 2.0;

/// Points on a plane, to within their noise, that the motion lays on TO with the plane upside down:
/// a mirrored reading would do the same.
fn turned_over(fit: &Fit, rmsd_m: f64, spread_m: f64, name: &str) -> Option<Finding> {
    let turned = fit.across_turned_rad;
    let rounding_m = 1e-6 * spread_m;
    let as_well = fit.mirrored_m <= AS_WELL * rmsd_m + rounding_m;
    (as_well && turned > std::f64::consts::FRAC_PI_2).then(|| {
        let message = format!(
            "the points lie on a plane, to within their noise, and fit with it turned over by {:.1} \
             deg ({:.3} mm are left): a mirror image of them fits as well ({:.3} mm)",
            turned.to_degrees(),
            mm_from_m(rmsd_m),
            mm_from_m(fit.mirrored_m)
        );
        warning("plane-turned-over", name, message).hint(
            "if the part does not lie upside down in TO, a set has an axis turned round or two \
             coordinates swapped; a point off the plane settles it",
        )
    })
}

/// Weights of points: 1/σ² of `sigma_mm` (absolute), or the column `weight`.
pub(super) fn weights(
    touched: &[&Touched],
    name: &str,
) -> Result<(Option<Vec<f64>>, bool), Failure> {
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
                    "{to_name}: point {}: --probe-radius-mm needs the outward normal nx,ny,nz of \
                     the touched surface in FROM or TO",
                    from.id
                );
                return Err(Failure::with_hint(message, "spheres and holes need none"));
            }
        }
    }
    Ok(Touched {
        id: from.id.clone(),
        from_m,
        to_m,
        variance_m2: variance_of([from.sigma_m, to.sigma_m]),
        weight: to.weight.or(from.weight),
        shape: None,
        of_touch: 1.0,
    })
}

/// The variance of a difference of which one or both deviations are known.
pub(super) fn variance_of(sigmas_m: [Option<f64>; 2]) -> Option<f64> {
    match sigmas_m.map(|s| s.map(|s| s * s)) {
        [None, None] => None,
        [a, b] => Some(a.unwrap_or(0.0) + b.unwrap_or(0.0)),
    }
}

/// That no motion lays the points of TO on those of FROM.
pub(super) fn unlike(name: &str, rmsd_m: f64, limit_m: f64) -> String {
    format!(
        "{name}: the points do not lie as those of FROM: the best motion leaves {:.3} mm root mean \
         square (limit {:.3} mm, 5 % of their spread)",
        mm_from_m(rmsd_m),
        mm_from_m(limit_m)
    )
}
