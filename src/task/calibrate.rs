//! `calibrate`: measurements to a profile.

use super::clock::{self, Answer, Doubted, any_timed};
use super::failure::Failure;
use super::measurements::{Rows, identify_failure};
use super::parts::{File, Observability, Pose, Quality, Sigma, WorstRow, findings};
use super::profile_file::ProfileFile;
use super::{Document, PROGRAM};
use crate::finding::{Finding, Severity};
use crate::geometry::add;
use crate::geometry::units::{DEG, mm_from_m};
use crate::identify::IdentifyError;
use crate::identify::calibration::{
    Calibration as Found, Options as Identification, STRONG_CORRELATION,
    calibrate_telling as identify,
};
use crate::identify::measurements::Measurements;
use crate::identify::off::Off;
use crate::identify::parameters::Selection;
use crate::identify::plates::calibrate_plates;
use crate::identify::statistics::misses;
use crate::model::effects::{Effect, Kind};
use crate::model::profile::{Profile, Tables};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Value, json};

/// A parameter of the model, in the unit of files.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Parameter {
    /// The standard deviation it would have; `null` where these data say nothing of it.
    pub sigma_if_identified: Option<f64>,
    /// Effect, place and name.
    pub key: String,
    /// Its value.
    pub value: f64,
    /// The unit of the numbers.
    pub unit: &'static str,
    /// Its standard deviation; `null` where it is left as it was.
    pub sigma: Option<f64>,
    /// Whether these data determine it.
    pub identifiable: bool,
    /// Parameters that these data cannot separate it from.
    pub confounded_with: Vec<String>,
    /// Whether the data say hardly more of it than its prior.
    pub is_prior: bool,
}

/// Two parameters that move together.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Correlation {
    /// The one.
    pub a: String,
    /// The other.
    pub b: String,
    /// From −1 to 1.
    pub correlation: f64,
}

/// A row that the model misses by far more than the others.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Outlier {
    /// Line, from 1.
    pub line: usize,
    /// Its id.
    pub id: String,
    /// Measured minus expected, of the place.
    pub residual_mm: f64,
    /// Of the orientation, of a pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_deg: Option<f64>,
    /// How many times the typical residual it is.
    pub times_typical: f64,
    /// From how many on a row is an outlier.
    pub limit: f64,
    /// The weight it had, 0 to 1.
    pub weight: f64,
    /// The part that is wrong in words.
    #[serde(skip)]
    pub off: String,
    /// The same in a sentence.
    pub reason: String,
    /// Its file.
    #[serde(flatten)]
    pub file: File,
}

/// A sphere or a plane that was touched.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Feature {
    /// Its name.
    pub feature: String,
    /// What it is.
    pub contact: &'static str,
    /// Its centre, or a point on it, in the device's frame.
    pub centre_mm: [f64; 3],
    /// Its radius.
    pub radius_mm: Option<f64>,
    /// Its outward normal.
    pub normal: Option<[f64; 3]>,
}

/// Errors of rows that were not used.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct HeldOut {
    /// With base, tool and points alone.
    pub frames_only: Quality,
    /// With everything.
    pub after: Quality,
}

/// What a calibration found.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Calibration {
    /// Every parameter, identified or not.
    pub parameters: Vec<Parameter>,
    /// How well the configurations show the parameters.
    pub observability: Observability,
    /// Parameters that move together.
    pub correlations: Vec<Correlation>,
    /// Rows that do not fit the others.
    pub outliers: Vec<Outlier>,
    /// Errors of the profile as it was.
    pub before: Quality,
    /// Errors with base, tool and points fitted.
    pub frames_only: Quality,
    /// Errors with everything.
    pub after: Quality,
    /// Rows used.
    pub rows: usize,
    /// Measured numbers in them.
    pub numbers: usize,
    /// Numbers less parameters.
    pub degrees_of_freedom: usize,
    /// Residuals in stated standard deviations.
    pub sigma_factor: f64,
    /// The factor that the sigmas of the parameters have been multiplied by.
    pub applied_factor: f64,
    /// How many times larger they are, about, because rows of one configuration miss alike; 1 where
    /// they do not.
    pub shared_factor: f64,
    /// Whether the standard deviations of the rows are assumed.
    pub sigma_assumed: bool,
    /// Orientations without `sigma_deg` weigh as positions this far away, by what they scatter; null
    /// where there are none, or too few.
    pub orientation_lever_mm: Option<f64>,
    /// Root mean square error that these sigmas let expect over the joint limits.
    pub expected_error_mm: Option<f64>,
    /// `world_from_base`.
    pub base: Pose,
    /// Whether the measured base replaces the profile's.
    pub base_replaced: bool,
    /// `world_from_device`: where the device stands in the controller's world, where that was
    /// identified.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub world_from_device: Option<Pose>,
    /// Standard deviations of its numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub world_from_device_sigma: Option<Sigma>,
    /// Passes of the solver.
    pub passes: usize,
    /// Why it stopped.
    pub stopped: String,
    /// What a person should look at.
    pub findings: Vec<Finding>,
    /// What was touched.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<Feature>,
    /// Errors of rows for `validate`, which were not used.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_out: Option<HeldOut>,
    /// The row with the largest error with everything.
    pub worst_row: Option<WorstRow>,
    /// What points on the plates of positioners found, in a file that has rows of the tool too:
    /// with the device where those put it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plates: Option<Box<Calibration>>,
    /// SHA-256 of the profile.
    pub profile_sha256: String,
    /// SHA-256 of each file of measurements.
    pub measurements_sha256: Vec<String>,
    /// The profile written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
    /// How the columns of the files were named, where it was said: the profile keeps it.
    #[serde(skip)]
    pub tables: Option<Tables>,
    /// The rows and models behind the numbers, which the page draws.
    #[serde(skip)]
    pub found: Found,
    /// How the files of measurements are named.
    #[serde(skip)]
    pub name: String,
}

impl Document for Calibration {
    const KIND: &'static str = "calibration/1";
}

/// Identifies a robot's effects from measurements, and those of positioners from rows on their
/// plates: of both, the arm's and the place of the device first. `hear` is called before each pass
/// over the rows of the tool.
///
/// # Errors
/// Measurements that do not determine anything, contradict the robot or themselves.
pub fn calibrate(
    profile: &ProfileFile,
    measurements: Rows,
    options: &Identification,
    hear: &mut dyn FnMut(),
) -> Result<Calibration, Failure> {
    let Rows {
        all,
        name,
        sha256,
        mut findings,
        tables,
    } = measurements;
    let failed = |error| identify_failure(&name, &error);
    let whole = |found: Found, findings: Vec<Finding>| {
        let tables = tables.clone();
        of_found(
            found,
            findings,
            (profile, name.clone(), sha256.clone(), tables),
        )
    };
    let (tool, plates) = all.split();
    let identify_plates = |profile: &Profile| {
        let options = Identification {
            selection: options.selection.of_plates(),
            ..options.clone()
        };
        calibrate_plates(profile, &plates, &options).map_err(failed)
    };
    if tool.rows.is_empty() {
        refuse_of_tool(&options.selection).map_err(failed)?;
        return Ok(whole(identify_plates(&profile.profile)?, findings));
    }
    if plates.rows.is_empty() {
        let found = identify(&profile.profile, &tool, options, hear).map_err(failed)?;
        findings.extend(late_clock(&profile.profile, &tool, options, &found, &name));
        return Ok(whole(found, findings));
    }
    let of_tool = Identification {
        selection: options.selection.of_tool(),
        ..options.clone()
    };
    let found = identify(&profile.profile, &tool, &of_tool, hear).map_err(failed)?;
    findings.extend(late_clock(&profile.profile, &tool, &of_tool, &found, &name));
    let on_plates = identify_plates(&found.profile())?;
    let mut both = whole(found, findings);
    both.plates = Some(Box::new(whole(on_plates, Vec::new())));
    Ok(both)
}

/// That a clock begins late, where an effect counts with it: one that is identified, unless the rows
/// say that the clock is right; one that the profile has, if they say that it is not.
fn late_clock(
    profile: &Profile,
    rows: &Measurements,
    options: &Identification,
    found: &Found,
    name: &str,
) -> Option<Finding> {
    let asked = options.selection.identify.iter();
    let is_asked = any_timed(asked.filter_map(|pick| pick.kind.as_ref()));
    if !is_asked && !any_timed(profile.effects.iter().map(|effect| &effect.kind)) {
        return None;
    }
    let doubted = Doubted::of(rows)?;
    let other = identify(profile, &doubted.from_first, options, &mut || ());
    let answer = other.map_or(Answer::Open, |other| {
        let [by_it, from_first] =
            [found, &other].map(|of| misses(&of.problem, &of.solution.estimate));
        clock::judged(&found.fit, &found.problem, &by_it, &from_first)
    });
    let is_doubtful = match answer {
        Answer::Wrong { .. } => true,
        Answer::Open => is_asked,
        Answer::Right => false,
    };
    is_doubtful.then(|| doubted.finding(name, &answer))
}

/// Effects of the arm that are asked for of points on plates alone.
fn refuse_of_tool(selection: &Selection) -> Result<(), IdentifyError> {
    let kinds = selection.identify.iter().filter_map(|pick| pick.kind);
    let mut ids = kinds.map(Kind::definition);
    match ids.find(|definition| !definition.of_positioner()) {
        Some(other) => Err(IdentifyError::Missing {
            id: other.id,
            need: "rows of the tool: points on a plate show nothing of the arm",
        }),
        None => Ok(()),
    }
}

/// What was found, as the command reports it.
fn of_found(
    found: Found,
    mut reported: Vec<Finding>,
    (profile, name, sha256, tables): (&ProfileFile, String, Vec<String>, Option<Tables>),
) -> Calibration {
    reported.extend(findings(&found.remarks, &name));
    reported.extend(left_with_data(&found, &name));
    let device = found
        .device
        .filter(|_| !found.base_replaced && !is_of_plates(&found));
    let u = &found.uncertainty;
    Calibration {
        parameters: parameters(&found),
        observability: (&found.observability).into(),
        correlations: correlations(&found),
        outliers: outliers(&found),
        before: (&found.before).into(),
        frames_only: (&found.frames_only_quality).into(),
        after: (&found.after).into(),
        rows: found.problem.rows.len(),
        numbers: found.problem.numbers(),
        degrees_of_freedom: u.degrees_of_freedom,
        sigma_factor: u.sigma_factor,
        applied_factor: u.applied_factor,
        shared_factor: u.shared_factor,
        sigma_assumed: found.problem.sigma_assumed,
        orientation_lever_mm: found.orientation_lever_m.map(mm_from_m),
        expected_error_mm: found.expected_m.map(mm_from_m),
        base: (&found.world_from_base).into(),
        base_replaced: found.base_replaced,
        world_from_device: device.map(|device| (&device.world_from_device).into()),
        world_from_device_sigma: device.and_then(|device| device.sigma).map(Into::into),
        passes: found.solution.passes,
        stopped: found.stop().describe(),
        findings: reported,
        features: features(&found),
        held_out: found.held_out.as_ref().map(|(frames, full)| HeldOut {
            frames_only: frames.into(),
            after: full.into(),
        }),
        worst_row: worst_row(&found),
        plates: None,
        profile_sha256: profile.sha256.clone(),
        measurements_sha256: sha256,
        output: None,
        tables,
        found,
        name,
    }
}

/// Effects of the data that were identified along: the profile is without them.
fn left_with_data(found: &Found, name: &str) -> Option<Finding> {
    let effects = found.solution.estimate.effects.iter();
    let of_data = effects.filter(|e| e.definition().of_data && !e.is_zero());
    let labels: Vec<String> = of_data.map(Effect::label).collect();
    if labels.is_empty() {
        return None;
    }
    let message = format!(
        "{}: of the measurements, not of the arm: the errors stated are with it, the profile is \
         without it, and what it moved stands as before the first row",
        labels.join(", ")
    );
    let finding = Finding::of_file("effect-of-data", Severity::Warning, name, message);
    Some(finding.hint("`poseshift diagnose -o` writes what moved as it stands after the last row"))
}

/// Whether it is of points on plates.
fn is_of_plates(found: &Found) -> bool {
    found.problem.rows.iter().any(|row| row.plate.is_some())
}

fn worst_row(found: &Found) -> Option<WorstRow> {
    let after = misses(&found.problem, &found.solution.estimate);
    let rows = &found.problem.rows;
    let offs = rows.iter().zip(&after);
    WorstRow::of(rows, &found.fit, offs.map(|(row, miss)| Off::of(row, miss)))
}

impl Calibration {
    /// The profile with what was found, its statistics and where it comes from; `date` as the user
    /// writes it.
    ///
    /// # Errors
    /// The profile's text is laid out so that the place of the calibration cannot be found.
    pub fn profile_text(
        &self,
        profile: &ProfileFile,
        date: Option<&str>,
    ) -> Result<String, Failure> {
        let last = self.plates.as_deref().unwrap_or(self);
        let mut calibrated = last.found.profile();
        if let Some(tables) = &self.tables {
            calibrated.tables.clone_from(tables);
        }
        let old = &profile.profile;
        let (mut quality, mut provenance) = if is_of_plates(&self.found) {
            let known = |block: &Option<Value>| block.clone().unwrap_or_else(|| json!({}));
            (known(&old.quality), known(&old.provenance))
        } else {
            (self.quality(), self.provenance(date))
        };
        if is_of_plates(&last.found) {
            quality["plates"] = last.quality();
            provenance["plates"] = last.provenance(date);
        }
        calibrated.quality = Some(quality);
        calibrated.provenance = Some(provenance);
        profile.rewritten(&calibrated)
    }

    /// The block `quality` of a profile: statistics, and the covariance in the units of files.
    fn quality(&self) -> Value {
        let u = &self.found.uncertainty;
        let parameters = &self.found.solution.parameters;
        let unit = |i: usize| parameters[i].scale / parameters[i].unit.in_si();
        let keys: Vec<Value> = parameters
            .iter()
            .zip(&u.sigma)
            .map(|(p, sigma)| json!({"key": p.key, "unit": p.unit.symbol(), "sigma": sigma / p.unit.in_si()}))
            .collect();
        let row = |i: usize| -> Vec<f64> {
            (0..=i)
                .map(|j| u.covariance[(i, j)] * unit(i) * unit(j))
                .collect()
        };
        let rows = &self.found.problem.rows;
        let seen: Vec<[f64; 3]> = rows.iter().filter_map(|r| r.observed.point_m()).collect();
        let sum = seen.iter().fold([0.0; 3], |sum, p| add(sum, *p));
        let mut quality = json!({
            "middle_mm": sum.map(|x| mm_from_m(x / seen.len().max(1) as f64)),
            "before": self.before,
            "frames_only": self.frames_only,
            "after": self.after,
            "observability": self.observability,
            "sigma_factor": u.sigma_factor,
            "shared_factor": u.shared_factor,
            "configurations": self.found.problem.configurations(),
            "degrees_of_freedom": u.degrees_of_freedom,
            "parameters": keys,
            "covariance_lower_triangle": (0..parameters.len()).map(row).collect::<Vec<_>>(),
            "strong_correlations": self.correlations,
        });
        let track = &self.found.problem.profile.external.track;
        if !track.is_empty() && !is_of_plates(&self.found) {
            let span = |k: usize| {
                let values = rows.iter().filter_map(|row| row.stand.values.get(k));
                values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], e| {
                    [low.min(*e), high.max(*e)]
                })
            };
            let spans = (0..track.len()).map(|k| span(k).map(mm_from_m));
            quality["track_mm"] = json!(spans.collect::<Vec<_>>());
        }
        quality
    }

    fn provenance(&self, date: Option<&str>) -> Value {
        let problem = &self.found.problem;
        let temperatures: Vec<f64> = problem
            .rows
            .iter()
            .filter_map(|r| r.conditions.temperature_c)
            .collect();
        let tools = problem
            .tools
            .iter()
            .map(|t| json!({"tool": t.name, "mass_kg": t.load.map_or(0.0, |(mass, _)| mass)}));
        let mut map = json!({
            "program": PROGRAM,
            "profile_sha256": self.profile_sha256,
            "measurements_sha256": self.measurements_sha256,
            "rows": self.rows,
            "stopped": self.stopped,
            "tools": tools.collect::<Vec<_>>(),
        });
        if !temperatures.is_empty() {
            map["temperature_c"] =
                json!(temperatures.iter().sum::<f64>() / temperatures.len() as f64);
        }
        if let Some(date) = date {
            map["date"] = json!(date);
        }
        map
    }
}

fn parameters(found: &Found) -> Vec<Parameter> {
    let names = &found.problem.parameters;
    let dropped = &found.solution.identifiable.dropped;
    found
        .parameters()
        .enumerate()
        .map(|(i, (parameter, value, sigma))| {
            let unit = parameter.unit.in_si();
            let dropped = dropped.iter().find(|d| d.parameter == i);
            let with = dropped.into_iter().flat_map(|d| &d.confounded_with);
            let prior = parameter.prior.zip(sigma);
            Parameter {
                sigma_if_identified: dropped
                    .and_then(|d| d.weak)
                    .map(|w| w * parameter.scale / unit),
                key: parameter.key.clone(),
                value: value / unit,
                unit: parameter.unit.symbol(),
                sigma: sigma.map(|s| s / unit),
                identifiable: sigma.is_some(),
                confounded_with: with.map(|other| names[*other].key.clone()).collect(),
                is_prior: prior.is_some_and(|((_, own), sigma)| sigma > 0.7 * own),
            }
        })
        .collect()
}

fn correlations(found: &Found) -> Vec<Correlation> {
    let names = &found.solution.parameters;
    let strong = found.uncertainty.strong_correlations(STRONG_CORRELATION);
    strong
        .into_iter()
        .map(|(i, j, correlation)| Correlation {
            a: names[i].key.clone(),
            b: names[j].key.clone(),
            correlation,
        })
        .collect()
}

fn outliers(found: &Found) -> Vec<Outlier> {
    let one = |o: &crate::identify::calibration::Outlier| {
        let off = o.off.words();
        Outlier {
            line: o.line.number,
            id: o.id.clone(),
            residual_mm: mm_from_m(o.off.length_m),
            residual_deg: o.off.angle_rad.map(|angle| angle / DEG),
            times_typical: o.times,
            limit: o.limit,
            weight: o.weight,
            reason: format!(
                "residual {off} is {:.1} times the typical one; the limit is {:.1}",
                o.times, o.limit
            ),
            off,
            file: (&o.line).into(),
        }
    };
    found.outliers.iter().map(one).collect()
}

fn features(found: &Found) -> Vec<Feature> {
    found
        .features()
        .map(|(feature, place)| Feature {
            feature: feature.name.clone(),
            contact: feature.kind.id(),
            centre_mm: place.centre_m.map(mm_from_m),
            radius_mm: place.radius_m.map(mm_from_m),
            normal: place.normal,
        })
        .collect()
}
