//! `validate`: what a profile is worth on measurements it has not seen.

use super::failure::Failure;
use super::layout::{SPREAD_HEADER, aligned, print_text, spread_row};
use super::measurements::{MeasurementFiles, identify_failure};
use super::page::ReportFile;
use super::progress::Progress;
use super::{Answer, Output, files, print, print_json};
use crate::identify::measurements::{Measurement, Purpose};
use crate::identify::validation::{Judged, Refit, Validation, validate_telling};
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
            progress.tell(done, of)
        })
        .map_err(|error| identify_failure(&name, &error))?;
        drop(progress);
        if self.report.is_wanted() {
            let page = validate_page(&found, &profile, &name);
            let page = self.report.output(Some(&page));
            files::write_all(page.as_slice())?;
        }
        if output.json {
            let mut report = report(&found);
            report["profile_sha256"] = json!(hash);
            report["measurements_sha256"] = json!(hashes);
            print_json(&report)?;
        } else if !output.quiet {
            print_text(&text(&found, output.verbose))?;
            print(&self.report.told())?;
        }
        Ok(Answer::Yes)
    }
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
            json!({
                "line": r.line, "count": r.count, "accuracy_mm": r.accuracy_mm, "repeatability_mm": r.repeatability_mm,
                "multidirectional_variation_mm": r.variation_mm,
            })
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
    if !found.repeated.is_empty() {
        out += "\nrepeated poses, ISO 9283\n";
        let header = ["line", "count", "AP mm", "RP mm", "vAP mm"];
        let mut rows = vec![header.map(str::to_owned).to_vec()];
        let shown = if all { found.repeated.len() } else { 20 };
        for r in found.repeated.iter().take(shown) {
            rows.push(vec![
                r.line.to_string(),
                r.count.to_string(),
                format!("{:.4}", r.accuracy_mm),
                format!("{:.4}", r.repeatability_mm),
                r.variation_mm
                    .map_or_else(|| "-".into(), |v| format!("{v:.4}")),
            ]);
        }
        out += &aligned(&rows);
    }
    out
}
