//! `validate`: what a profile is worth on measurements it has not seen.

use super::Document;
use super::clock::{self, Answer, Doubted, any_timed};
use super::failure::Failure;
use super::measurements::{Rows, identify_failure};
use super::parts::{File, Pairs, Quality, SpreadDeg, SpreadMm, WorstRow, findings};
use super::profile_file::ProfileFile;
use crate::diagnose::as_calibrated::{self as standing, Unsaid, as_calibrated};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::identify::IdentifyError;
use crate::identify::measurements::{Measurement, Measurements, Purpose};
use crate::identify::off::Off;
use crate::identify::plates::validate_plates;
use crate::identify::validation::{
    self, Folds as Leaving, Refit, Validation as Found, validate as validate_rows, validate_telling,
};
use crate::model::profile::Profile;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::borrow::Cow;

/// How to validate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Fit base, tool and points first: the device or the tool was set up anew.
    pub refit_frames: bool,
    /// Identify the effects again without each of so many parts of the configurations.
    pub folds: Option<Leaving>,
    /// Use rows of every set, not only those for `validate`.
    pub all_sets: bool,
    /// Say whether the arm errs as it did when it was calibrated.
    pub as_calibrated: bool,
}

/// One number a model.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Models<T> {
    /// What the controller computes with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub controller: Option<T>,
    /// The controller's model with base, tool and points fitted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames_only: Option<T>,
    /// The calibrated model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub real: Option<T>,
}

impl<T> Models<T> {
    /// Each with its name, in the order of the keys.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &T)> {
        let all = [
            ("controller", &self.controller),
            ("frames only", &self.frames_only),
            ("real", &self.real),
        ];
        all.into_iter()
            .filter_map(|(name, one)| Some((name, one.as_ref()?)))
    }

    fn of(found: &Found, of: impl Fn(&validation::Judged) -> Option<T>) -> Option<Self> {
        let all = Self {
            controller: of(&found.controller),
            frames_only: of(&found.frames_only),
            real: of(&found.real),
        };
        let is_empty = all.named().next().is_none();
        (!is_empty).then_some(all)
    }
}

/// Errors of the real model on a part of the rows.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Part {
    /// What divides: `point`, `tool`, `set`, `region`, `track`, `positioner`.
    pub by: &'static str,
    /// Which part.
    pub name: String,
    /// Its errors.
    pub error: SpreadMm,
}

/// Accuracy and repeatability of a pose that was measured several times (ISO 9283, 7.2).
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Repeated {
    /// Its first line.
    pub line: usize,
    /// How often it was measured.
    pub count: usize,
    /// The mean from what the real model expects.
    pub accuracy_mm: f64,
    /// AP: the mean from the commanded pose.
    pub commanded_accuracy_mm: f64,
    /// RP.
    pub repeatability_mm: f64,
    /// vAP; `null` from one direction only.
    pub multidirectional_variation_mm: Option<f64>,
    /// Its file.
    #[serde(flatten)]
    pub file: File,
}

/// Accuracy and repeatability of the distance of two such poses (ISO 9283, 7.3).
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct RepeatedDistance {
    /// Their first lines.
    pub lines: [usize; 2],
    /// How many pairs.
    pub count: usize,
    /// Mean distance.
    pub distance_mm: f64,
    /// How far it is from what the real model expects.
    pub accuracy_mm: f64,
    /// AD: how far it is from the distance of the commanded poses.
    pub commanded_accuracy_mm: f64,
    /// RD.
    pub repeatability_mm: f64,
    /// Their files, where several are read as one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub files: Option<[String; 2]>,
}

/// Errors of rows by models that were identified without them.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Folds {
    /// How many parts.
    pub count: usize,
    /// The whole model.
    pub real: Quality,
    /// Base, tool and points alone.
    pub frames_only: Quality,
}

/// Whether the arm errs as it did when it was calibrated.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct AsCalibrated {
    /// `as calibrated` or `measure again`.
    pub answer: &'static str,
    /// Root mean square of the errors.
    pub rms_mm: f64,
    /// Their mean square over that which is expected of an arm as it was calibrated: one, about.
    pub ratio: f64,
    /// Beyond this the answer is `measure again`.
    pub limit: f64,
    /// Probability of such an error, or a larger one, of an arm as it was calibrated.
    pub p_value: f64,
    /// Probability that such an arm is measured again.
    pub significance: f64,
    /// Probability with which the changes below are seen.
    pub power: f64,
    /// A change that moves these poses by so much, root mean square.
    pub sees_mm: f64,
    /// A joint that stands off by so much; `null` where these poses do not show it.
    pub sees_joints_deg: [Option<f64>; 6],
}

impl AsCalibrated {
    fn of(found: &standing::AsCalibrated) -> Self {
        Self {
            answer: if found.is_so {
                "as calibrated"
            } else {
                "measure again"
            },
            rms_mm: mm_from_m(found.rms_m),
            ratio: found.ratio,
            limit: found.limit,
            p_value: found.p_value,
            significance: standing::SIGNIFICANCE,
            power: standing::POWER,
            sees_mm: mm_from_m(found.sees_m),
            sees_joints_deg: found.sees_rad.map(|angle| angle.map(|a| a / DEG)),
        }
    }

    /// Whether it does.
    #[must_use]
    pub fn is_so(&self) -> bool {
        self.answer == "as calibrated"
    }

    /// The answer with its numbers, and what would have been seen.
    #[must_use]
    pub fn sentences(&self) -> [String; 2] {
        let joints = self.sees_joints_deg.iter().enumerate();
        let joints = joints.filter_map(|(k, deg)| Some(format!("J{} {:.3}°", k + 1, (*deg)?)));
        [
            format!(
                "{}: {:.3} mm rms, {:.2} times the mean square expected; {:.0} % of arms as \
                 calibrated exceed {:.2}",
                self.answer,
                self.rms_mm,
                self.ratio,
                100.0 * self.significance,
                self.limit
            ),
            format!(
                "seen with {:.0} % probability: {:.3} mm rms at these poses, or one joint off by \
                 {}",
                100.0 * self.power,
                self.sees_mm,
                joints.collect::<Vec<_>>().join(", ")
            ),
        ]
    }
}

/// What a validation found.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Validation {
    /// Rows judged.
    pub rows: usize,
    /// Whether base, tool and points were fitted to rows first.
    pub frames_refitted: bool,
    /// Root mean square of residuals in stated standard deviations.
    pub normalised_rms: Option<f64>,
    /// Errors of positions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<Models<SpreadMm>>,
    /// Errors of distances between all pairs of points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<Models<Pairs>>,
    /// Errors of orientations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Models<SpreadDeg>>,
    /// Errors of distances from fixed points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<Models<SpreadMm>>,
    /// Errors of the real model by parts.
    pub parts: Vec<Part>,
    /// Repeated poses.
    pub iso_9283: Vec<Repeated>,
    /// Distances of repeated poses.
    pub iso_9283_distances: Vec<RepeatedDistance>,
    /// Errors by models identified without the rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub folds: Option<Folds>,
    /// Whether the arm errs as it did when it was calibrated, where that was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub as_calibrated: Option<AsCalibrated>,
    /// The row with the largest error of the real model.
    pub worst_row: Option<WorstRow>,
    /// The same of points on plates of positioners, in a file that has rows of the tool too.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plates: Option<Box<Validation>>,
    /// SHA-256 of the profile.
    pub profile_sha256: String,
    /// SHA-256 of each file of measurements.
    pub measurements_sha256: Vec<String>,
    /// What a person should look at.
    pub findings: Vec<Finding>,
    /// The rows and models behind the numbers, which the page draws.
    #[serde(skip)]
    pub found: Found,
    /// The profile judged.
    #[serde(skip)]
    pub profile: Profile,
    /// How the files of measurements are named.
    #[serde(skip)]
    pub name: String,
}

impl Document for Validation {
    const KIND: &'static str = "validation/1";
}

/// Judges a profile's models by measurements; `hear` is called with how many of how many folds are
/// done.
///
/// # Errors
/// Too few rows, or rows that contradict the robot or themselves.
pub fn validate(
    file: &ProfileFile,
    measurements: Rows,
    options: &Options,
    hear: &mut dyn FnMut(usize, usize),
) -> Result<Validation, Failure> {
    let Rows {
        mut all,
        name,
        sha256,
        findings: mut read,
        ..
    } = measurements;
    let is_timed = any_timed(file.profile.effects.iter().map(|effect| &effect.kind));
    let mut doubted = Doubted::of(&all).filter(|_| is_timed);
    let is_for = |row: &Measurement| row.purpose == Some(Purpose::Validate);
    let some = all.rows.iter().any(is_for) && !options.all_sets;
    let refit = match options.refit_frames {
        false => Refit::No,
        true if some && !all.rows.iter().all(is_for) => Refit::Others,
        true => Refit::Judged,
    };
    if some && refit != Refit::Others {
        all = all.filtered(|_, row| is_for(row));
        if let Some(doubted) = &mut doubted {
            doubted.from_first = doubted.from_first.filtered(|_, row| is_for(row));
        }
    }
    let (tool, plates) = all.split();
    let judged = (!plates.rows.is_empty())
        .then(|| of_plates(file, &plates, refit, options.folds.is_some(), &name));
    let on_plates = judged.transpose()?;
    let judge = |found: Found, read: Vec<Finding>| {
        let mut reported: Vec<Finding> = seen_before(file, &found, &sha256, &name)
            .into_iter()
            .collect();
        reported.extend(read);
        reported.extend(findings(&found.remarks, &name));
        of_found(found, reported, (file, &name, &sha256))
    };
    if let (true, Some(found)) = (tool.rows.is_empty(), &on_plates) {
        if options.as_calibrated {
            return Err(Failure::with_hint(
                format!("{name} has points on plates alone, which show nothing of the arm"),
                "measure poses of the tool for --as-calibrated",
            ));
        }
        return Ok(judge(found.clone(), read));
    }
    let tool = Cow::Owned(tool);
    let found = validate_telling(&file.profile, tool, refit, options.folds, hear)
        .map_err(|error| too_few(&name, &error))?;
    if let Some(doubted) = doubted {
        read.extend(late_clock(&file.profile, &doubted, &found, &name));
    }
    let standing = if options.as_calibrated {
        Some(standing_of(file, &found)?)
    } else {
        None
    };
    let mut both = judge(found, read);
    if let Some(standing) = standing.as_ref().filter(|standing| !standing.is_so()) {
        let [message, _] = standing.sentences();
        both.findings.push(
            Finding::of_file("not-as-calibrated", Severity::Error, &name, message)
                .hint("measure as for a calibration, and let `diagnose` say what has changed"),
        );
    }
    both.as_calibrated = standing;
    both.plates = on_plates.map(|found| Box::new(judge(found, Vec::new())));
    Ok(both)
}

/// That a clock begins late, where the rows say that it does not count from switching the robot on:
/// with a clock that counts from the first row the profile misses less.
fn late_clock(profile: &Profile, doubted: &Doubted, found: &Found, name: &str) -> Option<Finding> {
    let (tool, _) = doubted.from_first.clone().split();
    let other = validate_rows(profile, &tool, found.refit, None).ok()?;
    let missed = (&found.real.misses, &other.real.misses);
    let answer = clock::judged(&found.measurements, &found.problem, missed.0, missed.1);
    matches!(answer, Answer::Wrong { .. }).then(|| doubted.finding(name, &answer))
}

/// Points on plates by the profile's positioners.
fn of_plates(
    file: &ProfileFile,
    plates: &Measurements,
    refit: Refit,
    folds: bool,
    name: &str,
) -> Result<Found, Failure> {
    if folds {
        return Err(Failure::with_hint(
            format!("{name}: --folds identifies the arm anew; the file has points on plates"),
            "leave --folds out and mark rows `validate` in the column `set`, or take the rows on \
             plates out",
        ));
    }
    validate_plates(&file.profile, plates, refit).map_err(|error| identify_failure(name, &error))
}

/// What was found, as the command reports it.
fn of_found(
    found: Found,
    findings: Vec<Finding>,
    (file, name, sha256): (&ProfileFile, &str, &[String]),
) -> Validation {
    Validation {
        rows: found.problem.rows.len(),
        frames_refitted: found.refit != Refit::No,
        normalised_rms: found.normalised_rms,
        position: Models::of(&found, |j| j.quality.position.map(Into::into)),
        distance: Models::of(&found, |j| {
            j.distance
                .filter(|_| j.quality.position.is_some())
                .map(Into::into)
        }),
        orientation: Models::of(&found, |j| j.quality.orientation.map(Into::into)),
        range: Models::of(&found, |j| j.quality.range.map(Into::into)),
        parts: found
            .parts
            .iter()
            .map(|p| Part {
                by: p.by,
                name: p.name.clone(),
                error: p.spread.into(),
            })
            .collect(),
        iso_9283: found.repeated.iter().map(Into::into).collect(),
        iso_9283_distances: found.repeated_distances.iter().map(Into::into).collect(),
        folds: found.folds.as_ref().map(|(count, full, alone)| Folds {
            count: *count,
            real: full.into(),
            frames_only: alone.into(),
        }),
        as_calibrated: None,
        worst_row: WorstRow::of(
            &found.problem.rows,
            &found.measurements,
            (found.problem.rows.iter().zip(&found.real.misses))
                .map(|(row, miss)| Off::of(row, miss)),
        ),
        profile_sha256: file.sha256.clone(),
        plates: None,
        measurements_sha256: sha256.to_vec(),
        findings,
        found,
        profile: file.profile.clone(),
        name: name.to_owned(),
    }
}

/// Whether the arm errs as it did when it was calibrated.
fn standing_of(file: &ProfileFile, found: &Found) -> Result<AsCalibrated, Failure> {
    let name = &file.name;
    let standing = as_calibrated(&file.profile, found).map_err(|unsaid| match unsaid {
        Unsaid::TooFew { .. } => Failure::with_hint(
            unsaid.to_string(),
            "measure more poses, or leave --refit-frames out where the device stands as it did",
        ),
        Unsaid::Key { .. } => Failure::with_hint(
            format!("{name}: {unsaid}"),
            "`calibrate` writes that block: take it as it was written, or calibrate again",
        ),
        Unsaid::NoQuality => Failure::with_hint(
            format!("{name} {unsaid}"),
            "`calibrate` writes that into the profile, under quality",
        ),
    })?;
    Ok(AsCalibrated::of(&standing))
}

fn too_few(name: &str, error: &IdentifyError) -> Failure {
    let IdentifyError::TooFew { numbers, rows, .. } = error else {
        return identify_failure(name, error);
    };
    Failure::with_hint(
        format!(
            "{name}: {rows} rows give {numbers} numbers: too few for base and tool, which the \
             comparison fits"
        ),
        "validate on more configurations: 20 and more say something of the workspace",
    )
}

/// A warning where the profile was identified with the rows that it is judged by.
fn seen_before(
    file: &ProfileFile,
    found: &Found,
    hashes: &[String],
    name: &str,
) -> Option<Finding> {
    let provenance = file.profile.provenance.as_ref();
    let used = provenance.and_then(|it| it.get("measurements_sha256")?.as_array())?;
    let is_used = |hash: &String| used.iter().any(|u: &Value| u == hash);
    let rows = &found.measurements.rows;
    // `calibrate` leaves rows for `validate` out
    let seen = rows
        .iter()
        .filter(|row| row.purpose != Some(Purpose::Validate))
        .count();
    (seen > 0 && hashes.iter().any(is_used)).then(|| {
        let message = format!(
            "the profile was calibrated with this file: {seen} of {} rows are not news to it, and \
             its error on them is too small",
            rows.len()
        );
        Finding::of_file("seen-before", Severity::Warning, name, message).hint(
            "mark rows `validate` in the column `set` before calibrating, measure others, or \
                use --folds",
        )
    })
}

impl RepeatedDistance {
    /// The first line of the one or the other, as a cell of a table.
    #[must_use]
    pub fn line(&self, which: usize) -> String {
        let file = self.files.as_ref().map(|files| files[which].clone());
        File { file }.line(self.lines[which])
    }
}

impl From<&validation::Repeated> for Repeated {
    fn from(r: &validation::Repeated) -> Self {
        Self {
            line: r.line.number,
            count: r.count,
            accuracy_mm: r.accuracy_mm,
            commanded_accuracy_mm: r.commanded_accuracy_mm,
            repeatability_mm: r.repeatability_mm,
            multidirectional_variation_mm: r.variation_mm,
            file: (&r.line).into(),
        }
    }
}

impl From<&validation::RepeatedDistance> for RepeatedDistance {
    fn from(r: &validation::RepeatedDistance) -> Self {
        let files = match r.lines.each_ref().map(|line| line.file.as_deref()) {
            [Some(first), Some(second)] => Some([first.to_owned(), second.to_owned()]),
            _ => None,
        };
        Self {
            lines: r.lines.each_ref().map(|line| line.number),
            count: r.count,
            distance_mm: r.distance_mm,
            accuracy_mm: r.accuracy_mm,
            commanded_accuracy_mm: r.commanded_accuracy_mm,
            repeatability_mm: r.repeatability_mm,
            files,
        }
    }
}
