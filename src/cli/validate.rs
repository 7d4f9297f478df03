//! `validate`: what a profile is worth on measurements it has not seen.

use super::failure::Failure;
use super::layout::{SPREAD_HEADER, aligned, print_text, spread_row};
use super::measurements::{MeasurementFiles, identify_failure, tell_findings};
use super::page::ReportFile;
use super::progress::Progress;
use super::{Answer, Output, files, print, print_json};
use crate::finding::{Finding, Severity};
use crate::identify::IdentifyError;
use crate::identify::measurements::{Measurement, Purpose};
use crate::identify::validation::{Judged, Refit, Validation, validate_telling};
use crate::model::profile::Profile;
use crate::report::html::measurements::validate_page;
use crate::report::identification;
use clap::Args;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Print the errors of a profile's models on measurements
#[derive(Args)]
pub struct Validate {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    #[command(flatten)]
    measurements: MeasurementFiles,
    /// Fit base, tool and points first, to the rows not marked for `validate` where there are both, else to those judged: the
    /// device or the tool was set up anew
    #[arg(long)]
    refit_frames: bool,
    /// Identify the profile's effects again without each of so many parts of the configurations
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(2..=1000))]
    folds: Option<u32>,
    /// Use rows of every set, not only those for `validate`
    #[arg(long)]
    all_sets: bool,
    #[command(flatten)]
    report: ReportFile,
}

impl Validate {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let (profile, hash) = files::read_profile(&self.profile)?;
        let read = self.measurements.paths().chain([self.profile.as_path()]);
        self.report.refuse_over(read, [])?;
        let (mut measurements, hashes) = self.measurements.read()?;
        let is_for = |row: &Measurement| row.purpose == Some(Purpose::Validate);
        let some = measurements.rows.iter().any(is_for) && !self.all_sets;
        let refit = match self.refit_frames {
            false => Refit::No,
            true if some && !measurements.rows.iter().all(is_for) => Refit::Others,
            true => Refit::Judged,
        };
        if some && refit != Refit::Others {
            measurements = measurements.filtered(|_, row| is_for(row));
        }
        let name = self.measurements.name();
        let folds = self.folds.map(|n| n as usize);
        let progress = Progress::new(output, "validating");
        let found = validate_telling(&profile, &measurements, refit, folds, &mut |done, of| {
            progress.tell(done, of);
        })
        .map_err(|error| match error {
            IdentifyError::TooFew {
                numbers,
                rows,
                parameters,
            } => Failure::with_hint(
                format!(
                    "{name}: {rows} rows give {numbers} numbers; base and tool, which the comparison fits, have {parameters} unknowns: more \
                     numbers are needed"
                ),
                "validate on more configurations: 20 and more tell something of the workspace",
            ),
            error => identify_failure(&name, &error),
        })?;
        drop(progress);
        let mut findings = seen_before(&profile, &found, &hashes, &name);
        findings.extend(identification::findings(&found.remarks, &name));
        if self.report.is_wanted() {
            let mut page = validate_page(&found, &profile, &name);
            page.findings(&findings);
            let page = self.report.output(Some(&page));
            files::write_all(page.as_slice())?;
        }
        if output.json {
            let mut report = report(&found);
            report["profile_sha256"] = json!(hash);
            report["measurements_sha256"] = json!(hashes);
            report["findings"] = json!(findings);
            print_json(&report)?;
        } else if !output.quiet {
            tell_findings(&findings, output);
            print_text(&text(&found, output.verbose))?;
            print(&self.report.told())?;
        }
        Ok(Answer::Yes)
    }
}

/// A warning where the profile was identified with the rows that it is judged by.
fn seen_before(
    profile: &Profile,
    found: &Validation,
    hashes: &[String],
    name: &str,
) -> Vec<Finding> {
    let used = profile
        .provenance
        .as_ref()
        .and_then(|provenance| provenance.get("measurements_sha256")?.as_array());
    let is_used = |hash: &String| used.is_some_and(|used| used.iter().any(|u| u == hash));
    let rows = &found.measurements.rows;
    // `calibrate` leaves rows for `validate` out
    let seen = rows
        .iter()
        .filter(|row| row.purpose != Some(Purpose::Validate));
    let count = seen.count();
    if count == 0 || !hashes.iter().any(is_used) {
        return Vec::new();
    }
    vec![Finding {
        id: "seen-before",
        severity: Severity::Warning,
        file: name.into(),
        line: 0,
        column: 0,
        message: format!(
            "the profile was calibrated with this file: {count} of {} rows are not news to it, and its error on them is too small",
            rows.len()
        ),
        hint: "mark rows `validate` in the column `set` before calibrating, measure others, or use --folds".into(),
    }]
}

fn models(found: &Validation) -> [(&'static str, &'static str, &Judged); 3] {
    [
        ("controller", "controller", &found.controller),
        ("frames_only", "frames only", &found.frames_only),
        ("real", "real", &found.real),
    ]
}

fn report(found: &Validation) -> Value {
    let mut report = json!({
        "poseshift": "validation/1", "rows": found.problem.rows.len(), "frames_refitted": found.refit != Refit::No,
        "normalised_rms": found.normalised_rms,
    });
    for (key, _, judged) in models(found) {
        let q = &judged.quality;
        if q.position.is_some() {
            report["position"][key] = identification::spread(q.position, "mm");
            report["distance"][key] = identification::pairs(judged.distance);
        }
        if q.orientation.is_some() {
            report["orientation"][key] = identification::spread(q.orientation, "deg");
        }
        if q.range.is_some() {
            report["range"][key] = identification::spread(q.range, "mm");
        }
    }
    report["parts"] = found
        .parts
        .iter()
        .map(|p| json!({"by": p.by, "name": p.name, "error": identification::spread(Some(p.spread), "mm")}))
        .collect();
    report["iso_9283"] = found
        .repeated
        .iter()
        .map(|r| {
            let found = json!({
                "line": r.line.number, "count": r.count, "accuracy_mm": r.accuracy_mm,
                "commanded_accuracy_mm": r.commanded_accuracy_mm, "repeatability_mm": r.repeatability_mm,
                "multidirectional_variation_mm": r.variation_mm,
            });
            identification::with_file(found, &r.line)
        })
        .collect();
    report["iso_9283_distances"] = found
        .repeated_distances
        .iter()
        .map(|r| {
            let mut found = json!({
                "lines": [r.lines[0].number, r.lines[1].number], "count": r.count, "distance_mm": r.distance_mm, "accuracy_mm": r.accuracy_mm,
                "commanded_accuracy_mm": r.commanded_accuracy_mm, "repeatability_mm": r.repeatability_mm,
            });
            if let [Some(first), Some(second)] = r.lines.each_ref().map(|line| &line.file) {
                found["files"] = json!([**first, **second]);
            }
            found
        })
        .collect();
    if let Some((count, full, alone)) = &found.folds {
        report["folds"] = json!({
            "count": count, "real": identification::quality(full), "frames_only": identification::quality(alone),
        });
    }
    report
}

fn text(found: &Validation, all: bool) -> String {
    let mut out = format!("{} rows\n", found.problem.rows.len());
    if let Some(told) = found.refit.told() {
        out += &format!("{told}\n");
    }
    out.push('\n');
    let mut rows = vec![SPREAD_HEADER.map(str::to_owned).to_vec()];
    for (_, name, judged) in models(found) {
        let q = &judged.quality;
        for (what, spread) in [
            ("position mm", q.position),
            ("orientation deg", q.orientation),
            ("distance mm", q.range),
        ] {
            rows.extend(spread.map(|s| spread_row(&format!("{name}, {what}"), &s)));
        }
    }
    if let Some((count, full, alone)) = &found.folds {
        for (name, q) in [("frames only", alone), ("real", full)] {
            rows.extend(
                q.main()
                    .map(|s| spread_row(&format!("{name}, {count} folds"), &s)),
            );
        }
    }
    out += &aligned(&rows);
    let mut rows = vec![
        [
            "distance of pairs, mm",
            "pairs",
            "mean",
            "std",
            "mean + 3 std",
            "max",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    for (_, name, judged) in models(found) {
        rows.extend(judged.distance.map(|p| {
            let numbers = [p.mean, p.std, p.mean_plus_3std(), p.max].map(|v| format!("{v:.3}"));
            let mut row = vec![name.to_owned(), p.pairs.to_string()];
            row.extend(numbers);
            row
        }));
    }
    if rows.len() > 1 {
        out += &format!("\n{}", aligned(&rows));
    }
    if !found.parts.is_empty() {
        let mut rows = vec![SPREAD_HEADER.map(str::to_owned).to_vec()];
        rows[0][0] = "real model by part, mm".into();
        rows.extend(
            found
                .parts
                .iter()
                .map(|p| spread_row(&format!("{} {}", p.by, p.name), &p.spread)),
        );
        out += &format!("\n{}", aligned(&rows));
    }
    if let Some(rms) = found.normalised_rms {
        out += &format!("\nresiduals are {rms:.2} times the given standard deviations (rms)\n");
    }
    out += &iso_9283(found, if all { usize::MAX } else { 20 });
    out
}

/// Repeated poses and the distances between them.
fn iso_9283(found: &Validation, most: usize) -> String {
    let mut out = String::new();
    if found.repeated.is_empty() {
        return out;
    }
    let digits = |v: f64| format!("{v:.4}");
    let table = |header: &[&str], rows: Vec<Vec<String>>| {
        let header = header.iter().map(|name| (*name).to_owned()).collect();
        let all: Vec<_> = std::iter::once(header).chain(rows).collect();
        aligned(&all)
    };
    out += "\nrepeated poses, ISO 9283, mm; AP: the mean from the commanded pose, and from the real model's\n";
    let rows = found.repeated.iter().take(most).map(|r| {
        let variation = r.variation_mm.map_or_else(|| "-".into(), digits);
        let [commanded, real, rp] =
            [r.commanded_accuracy_mm, r.accuracy_mm, r.repeatability_mm].map(digits);
        vec![
            r.line.short(),
            r.count.to_string(),
            commanded,
            real,
            rp,
            variation,
        ]
    });
    out += &table(
        &["line", "count", "AP", "AP real", "RP", "vAP"],
        rows.collect(),
    );
    if found.repeated_distances.is_empty() {
        return out;
    }
    out += "\ndistances of repeated poses, mm; AD: the mean from the commanded distance, and from the real model's\n";
    let rows = found.repeated_distances.iter().take(most).map(|r| {
        let mut row = vec![
            format!("{} to {}", r.lines[0].short(), r.lines[1].short()),
            r.count.to_string(),
            format!("{:.3}", r.distance_mm),
        ];
        let numbers = [r.commanded_accuracy_mm, r.accuracy_mm, r.repeatability_mm];
        row.extend(numbers.map(digits));
        row
    });
    out += &table(
        &["lines", "count", "distance", "AD", "AD real", "RD"],
        rows.collect(),
    );
    out
}
