//! Runs of one robot in their order: since which it errs otherwise, and what `diagnose` finds in
//! the rows since.

use super::diagnose::{Diagnosis, diagnose, of_the_arm};
use super::failure::Failure;
use super::measurements::{Rows, identify_failure};
use super::profile_file::ProfileFile;
use crate::diagnose::drift::{LEAST_RUNS, before_last, changes};
use crate::diagnose::{Options, drift};
use crate::geometry::units::mm_from_m;
use crate::identify::measurements::Measurements;
use crate::identify::problem::Row;
use crate::identify::robust::{limit, scale_of};
use crate::identify::validation::{Refit, Validation, validate};
use schemars::JsonSchema;
use serde::Serialize;
use std::ops::Range;

/// Runs whose errors differ by more than so many times are not alike.
const GROSS: f64 = 3.0;

/// A run: what the profile misses of rows that it was not calibrated with.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Run {
    /// Its file.
    pub file: String,
    /// Rows of it.
    pub rows: usize,
    /// Root mean square of their errors; rows that do not fit the others count as rows at the limit
    /// of what is normal.
    pub rms_mm: f64,
}

/// A last run that is not like those before it, where no change is sure yet.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct LastApart {
    /// Geometric mean of the errors before.
    pub before_mm: f64,
    /// Its own error.
    pub rms_mm: f64,
}

/// A change of these errors.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Change {
    /// The first run with it.
    pub since: String,
    /// Its number, from 1.
    pub run: usize,
    /// The number of the run in which it was noticed.
    pub noticed: usize,
    /// Geometric mean of the errors before.
    pub before_mm: f64,
    /// And since.
    pub after_mm: f64,
}

/// The errors run by run.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Drift {
    /// The runs, the oldest first.
    pub runs: Vec<Run>,
    /// Changes, the oldest first: the rows since the last are diagnosed.
    pub changes: Vec<Change>,
    /// The last run, where its error is apart from the others and no change is sure yet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_apart: Option<LastApart>,
    /// The number of the run from which on rows are diagnosed.
    pub diagnosed_from: usize,
}

impl Drift {
    fn of(runs: Vec<Run>) -> Self {
        let errors: Vec<f64> = runs.iter().map(|run| run.rms_mm).collect();
        let change = |c: &drift::Change| Change {
            since: runs[c.since].file.clone(),
            run: c.since + 1,
            noticed: c.noticed + 1,
            before_mm: c.before,
            after_mm: c.after,
        };
        let last = before_last(&errors).zip(errors.last());
        let changes: Vec<Change> = changes(&errors).iter().map(change).collect();
        let since = changes.last().map_or(1, |change| change.run);
        Self {
            diagnosed_from: last.map_or(since, |_| runs.len()),
            changes,
            last_apart: last.map(|(before_mm, rms_mm)| LastApart {
                before_mm,
                rms_mm: *rms_mm,
            }),
            runs,
        }
    }

    /// How many times the smallest error of a run the largest is.
    fn ratio(&self) -> f64 {
        let errors = || self.runs.iter().map(|run| run.rms_mm);
        let largest = errors().fold(0.0, f64::max);
        largest
            / errors()
                .fold(f64::INFINITY, f64::min)
                .max(f64::MIN_POSITIVE)
    }

    /// What is to be said of it.
    #[must_use]
    pub fn sentence(&self) -> String {
        let count = self.runs.len();
        let apart = self.last_apart.as_ref().map(|last| {
            let word = if last.rms_mm > last.before_mm {
                "larger"
            } else {
                "smaller"
            };
            format!(
                "The error of the last run is {word}: {:.3} mm rms, {:.3} mm before. No change is \
                 sure yet: measure another run.",
                last.rms_mm, last.before_mm
            )
        });
        let rows = if self.diagnosed_from == count {
            "The rows of the last run are diagnosed.".to_owned()
        } else {
            format!(
                "They are too few alone: the rows from run {} on are diagnosed.",
                self.diagnosed_from
            )
        };
        match (self.changes.last(), apart) {
            (Some(c), apart) => format!(
                "The error has changed with run {} of {count}, {}: {:.3} mm rms before, {:.3} mm \
                 since. {}",
                c.run,
                c.since,
                c.before_mm,
                c.after_mm,
                apart.map_or_else(
                    || "The rows since are diagnosed.".to_owned(),
                    |said| format!("{said} {rows}")
                )
            ),
            (None, Some(apart)) => format!("{apart} {rows}"),
            (None, None) if self.ratio() > GROSS => format!(
                "The errors of the {count} runs differ by up to {:.0} times, and no change from \
                 one run on is sure. Their rows are diagnosed together: look at the runs one by \
                 one.",
                self.ratio()
            ),
            (None, None) => format!(
                "The error has not changed in {count} runs. Their rows are diagnosed together."
            ),
        }
    }
}

/// Rows of each file, in the order of the files.
fn by_file(all: &Measurements) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (index, pair) in all.rows.windows(2).enumerate() {
        if pair[0].line.file != pair[1].line.file {
            let start = runs.last().map_or(0, |run| run.end);
            runs.push(start..index + 1);
        }
    }
    let start = runs.last().map_or(0, |run| run.end);
    runs.push(start..all.rows.len());
    runs
}

/// Root mean square of the errors of positions, else of distances, metres; a row beyond the limit of
/// what is normal counts as one at it, as in the diagnosis.
fn typical_m(found: &Validation) -> f64 {
    let errors = found.problem.rows.iter().zip(&found.real.misses);
    let is_position = |row: &Row| row.observed.point_m().is_some();
    let of_positions = found.problem.rows.iter().any(is_position);
    let errors = errors.filter(|(row, _)| is_position(row) == of_positions);
    let (squares, counts): (Vec<f64>, Vec<usize>) = errors
        .map(|(row, miss)| (miss.length_m.powi(2), row.observed.count().min(3)))
        .unzip();
    let scale = scale_of(&squares, counts.iter().copied());
    let each = squares.iter().zip(&counts);
    let sum: f64 = each
        .map(|(square, count)| square.min((scale * limit(*count)).powi(2)))
        .sum();
    (sum / squares.len().max(1) as f64).sqrt()
}

/// As [`diagnose`], of rows whose files are runs of one robot, the oldest first: those of a last run
/// that is apart, else since the last change of the error, of all where there is none.
///
/// # Errors
/// Fewer runs than a change can be seen in; as [`diagnose`].
pub fn diagnose_runs(
    file: &ProfileFile,
    measurements: &Rows,
    options: &Options,
    hear: &mut dyn FnMut(&str),
) -> Result<Diagnosis, Failure> {
    let files = by_file(&measurements.all);
    if files.len() < LEAST_RUNS {
        let message = format!(
            "{} files are too few for a change to be seen between them: --runs needs {LEAST_RUNS}",
            files.len()
        );
        let hint = "give a file for each run, the oldest first, or leave --runs out";
        return Err(Failure::with_hint(message, hint));
    }
    let mut runs = Vec::with_capacity(files.len());
    for rows in &files {
        let line = &measurements.all.rows[rows.start].line;
        let name = line
            .file
            .as_deref()
            .unwrap_or(&measurements.name)
            .to_owned();
        hear(&name);
        let part = measurements.all.filtered(|row, _| rows.contains(&row));
        let (part, _) = of_the_arm(part, &name)?;
        let found = validate(&file.profile, &part, Refit::No, None)
            .map_err(|error| identify_failure(&name, &error))?;
        runs.push(Run {
            file: name,
            rows: part.rows.len(),
            rms_mm: mm_from_m(typical_m(&found)),
        });
    }
    let mut drift = Drift::of(runs);
    let since = |run: usize| {
        let from = files[run - 1].start;
        Rows {
            all: measurements.all.filtered(|row, _| row >= from),
            ..measurements.clone()
        }
    };
    let mut found = diagnose(file, since(drift.diagnosed_from), options, hear);
    // one run may have too few rows
    let before = drift.changes.last().map_or(1, |change| change.run);
    if found.is_err() && before < drift.diagnosed_from {
        drift.diagnosed_from = before;
        found = diagnose(file, since(before), options, hear);
    }
    let mut found = found.map_err(|mut failure| {
        if !drift.changes.is_empty() {
            failure.message = format!("{} {}", drift.sentence(), failure.message);
        }
        failure
    })?;
    found.drift = Some(drift);
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_last_run_that_is_apart_is_diagnosed_alone() {
        let run = |rms_mm: &f64| Run {
            file: "n.csv".into(),
            rows: 60,
            rms_mm: *rms_mm,
        };
        let of = |errors: &[f64]| Drift::of(errors.iter().map(run).collect());
        assert_eq!(of(&[0.05, 0.052, 0.048, 0.051, 0.05]).diagnosed_from, 1);
        let last = of(&[0.05, 0.052, 0.048, 0.051, 0.31]);
        assert_eq!((last.diagnosed_from, last.changes.len()), (5, 0));
        let said = last.sentence();
        assert!(
            said.ends_with("The rows of the last run are diagnosed."),
            "{said}"
        );
        let first = of(&[0.05, 0.31, 0.3, 0.32, 0.31]);
        assert_eq!(first.diagnosed_from, 2);
        assert!(first.sentence().contains("changed with run 2 of 5"));
    }

    #[test]
    fn runs_that_differ_grossly_are_said_to() {
        let sentence = |errors: &[f64]| {
            let run = |(number, rms_mm): (usize, &f64)| Run {
                file: format!("n{number}.csv"),
                rows: 20,
                rms_mm: *rms_mm,
            };
            Drift::of(errors.iter().enumerate().map(run).collect()).sentence()
        };
        let alike = sentence(&[0.05, 0.06, 0.05, 0.055, 0.05]);
        assert!(alike.contains("has not changed"), "{alike}");
        let to_and_fro = sentence(&[0.05, 0.2, 0.05, 0.2, 0.05, 0.2, 0.05]);
        assert!(to_and_fro.contains("by up to 4 times"), "{to_and_fro}");
        let changed = sentence(&[0.05, 0.052, 0.33, 0.32, 0.34, 0.33]);
        assert!(
            changed.contains("changed with run 3 of 6, n2.csv"),
            "{changed}"
        );
    }
}
