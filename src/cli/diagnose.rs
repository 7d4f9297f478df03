//! `diagnose`: where model and measurement disagree, and which effect is missing.

use super::failure::Failure;
use super::layout::{SPREAD_HEADER, aligned, print_text, spread_row};
use super::measurements::{MeasurementFiles, identify_failure, picks, tell_findings};
use super::page::ReportFile;
use super::progress::Progress;
use super::{Answer, Output, files, print, print_json};
use crate::diagnose::{Diagnosis, NoiseSource, Options, Verdict, diagnose};
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::profile::rewritten;
use crate::report::{diagnosis as report, identification};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;

/// Find where model and measurements disagree, name the missing effect, add it
#[derive(Args)]
pub struct Diagnose {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    #[command(flatten)]
    measurements: MeasurementFiles,
    /// Improved profile to write (YAML)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Have this effect in the model whatever the evidence: `backlash:3`; may be given again
    #[arg(long, value_name = "EFFECT")]
    accept: Vec<String>,
    /// Leave this effect out: `joint_harmonic`, `link_compliance:2`; may be given again
    #[arg(long, value_name = "EFFECT")]
    reject: Vec<String>,
    /// Joint angles to write (CSV) that would tell the alternatives apart
    #[arg(long, value_name = "FILE")]
    poses: Option<PathBuf>,
    /// Leave out the check on rows not used
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    report: ReportFile,
}

impl Diagnose {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let options = Options {
            accept: picks("--accept", Some(&self.accept.join(",")))?,
            reject: picks("--reject", Some(&self.reject.join(",")))?,
            quick: self.quick,
            steps: self.report.is_wanted(),
        };
        let (profile, profile_hash) = files::read_profile(&self.profile)?;
        let read = self.measurements.paths().chain([self.profile.as_path()]);
        let outputs = self.output.iter().chain(&self.poses).map(PathBuf::as_path);
        self.report.refuse_over(read, outputs)?;
        let (measurements, hashes) = self.measurements.read()?;
        let name = self.measurements.name();
        let progress = Progress::new(output, "diagnosing");
        let found = diagnose(&profile, &measurements, &options, &mut |what| {
            progress.say(what);
        });
        drop(progress);
        let found = found.map_err(|error| identify_failure(&name, &error))?;
        let mut json = report::diagnosis(&found, &name);
        json["profile_sha256"] = json!(profile_hash);
        json["measurements_sha256"] = json!(hashes);
        let mut outputs = Vec::new();
        let sure = found.verdict != Verdict::Undetermined
            || !found.found.is_empty() && found.found.iter().all(|f| f.accepted);
        if let Some(path) = self.output.as_ref().filter(|_| sure) {
            let mut improved = found.profile.clone();
            improved.quality = None;
            improved.provenance = Some(json!({
                "program": format!("poseshift {}", env!("CARGO_PKG_VERSION")),
                "diagnosis": found.verdict.id(),
                "found": found.found.iter().map(|f| f.effect.label()).collect::<Vec<_>>(),
                "profile_sha256": profile_hash,
                "measurements_sha256": hashes,
                "rows": measurements.rows.len(),
            }));
            let text = rewritten(&files::read_text(&self.profile)?, &improved)
                .map_err(|error| Failure::new(format!("{}: {error}", self.profile.display())))?;
            outputs.push((path.clone(), text.into_bytes()));
            json["output"] = json!(path.display().to_string());
        }
        if let Some(path) = self.poses.as_ref().filter(|_| !found.telling.is_empty()) {
            let mut text = String::from("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n");
            for telling in &found.telling {
                let cells = telling.q.map(|q| format!("{:.4}", q / DEG));
                text += &format!("{}\n", cells.join(","));
            }
            outputs.push((path.clone(), text.into_bytes()));
            json["poses"] = json!(path.display().to_string());
        }
        if self.report.is_wanted() {
            let lines: Vec<usize> = measurements
                .rows
                .iter()
                .map(|row| row.line.number)
                .collect();
            let page = crate::report::html::diagnosis::page(&found, &lines, &name);
            outputs.extend(self.report.output(Some(&page)));
        }
        files::write_all(&outputs)?;
        let answer = if sure { Answer::Yes } else { Answer::No };
        if output.json {
            print_json(&json)?;
            return Ok(answer);
        }
        tell_findings(&identification::findings(&found.remarks, &name), output);
        if !output.quiet {
            print_text(&text(&found, output.verbose))?;
            for (path, _) in &outputs {
                print(&format!("\nwritten to {}\n", path.display()))?;
            }
            if self.output.is_some() && !sure {
                print("\nnothing written: --accept EFFECT overrules\n")?;
            }
            if self.poses.is_some() && found.telling.is_empty() {
                print("\nno alternatives to tell apart: no poses written\n")?;
            }
        }
        Ok(answer)
    }
}

/// A probability in few characters; what is too small for a number is said to be below one.
fn probability(p: f64) -> String {
    if p < 1e-300 {
        "< 1e-300".into()
    } else {
        format!("{p:.0e}")
    }
}

/// The effects found with their evidence, and their values under them.
fn values(found: &Diagnosis) -> String {
    let mut out = String::new();
    for f in &found.found {
        let (again, of) = f.found_again;
        let (label, p) = (f.effect.label(), probability(f.p_value));
        out += &format!("\n{label}: chi-squared -{:.0}, p {p}", f.gain);
        if of > 0 {
            out += &format!(", again {again}/{of}");
        }
        out.push('\n');
        for (number, sigma) in f.sought.iter().zip(&f.sigmas) {
            let p = &f.effect.definition().parameters[*number];
            let unit = p.unit.in_si();
            out += &format!(
                "  {:<16} {:>11.4e} ± {:.1e}\n",
                p.key,
                f.effect.parameters[*number] / unit,
                sigma / unit
            );
        }
    }
    out
}

/// The report for people.
fn text(found: &Diagnosis, all: bool) -> String {
    let mut out = report::summary(found);
    let mut rows = vec![SPREAD_HEADER.map(str::to_owned).to_vec()];
    if let Some((before, after)) = &found.held_out {
        rows.push(spread_row("present model", before));
        if let Some(s) = found.absorbed_only.filter(|_| found.absorbed) {
            rows.push(spread_row("frames, geometry fitted", &s));
        }
        for f in &found.found {
            rows.extend(
                f.after
                    .map(|s| spread_row(&format!("+ {}", f.effect.label()), &s)),
            );
        }
        if found.found.is_empty() {
            rows.push(spread_row("after", after));
        }
        out += "\nerrors in mm on rows not used for the choice\n";
        out += &aligned(&rows);
    }
    let source = match found.noise_source {
        NoiseSource::Given => "sigma_mm",
        NoiseSource::Repeats => "repeated poses",
        NoiseSource::Left => "what no model explains",
    };
    out += &format!(
        "\nnoise {:.4} mm a coordinate by {source}; left {:.4} mm\n",
        mm_from_m(found.noise_m),
        mm_from_m(found.left_m)
    );
    out += &values(found);
    let most = if all { usize::MAX } else { 5 };
    if !found.spots.is_empty() {
        out += "\nwhere the present model misses, strongest first\n";
        let mut rows = vec![
            ["column", "most at", "rms mm", "largest mm", "part", "p"]
                .map(str::to_owned)
                .to_vec(),
        ];
        for s in found.spots.iter().take(most) {
            rows.push(vec![
                s.column.clone(),
                s.values.clone(),
                format!("{:.3}", mm_from_m(s.size_m)),
                format!("{:.3}", mm_from_m(s.largest_m)),
                format!("{:.0} %", 100.0 * s.part),
                probability(s.p_value),
            ]);
        }
        out += &aligned(&rows);
    }
    if !found.rivals.is_empty() {
        out += "\nexplain the measurements nearly as well\n";
        for r in found.rivals.iter().take(most) {
            let of = &found.found[r.instead_of];
            out += &format!(
                "  {} instead of {} (behind by {:.1})\n",
                r.effect.label(),
                of.effect.label(),
                r.behind
            );
        }
    }
    if !found.stand_ins.is_empty() {
        out += "\ncompete with several of the effects found\n";
        for s in &found.stand_ins {
            out += &report::wrapped(&report::competes(s, found), "  ", "    ");
        }
    }
    for i in &found.impossible {
        out.push('\n');
        out += &report::wrapped(&report::impossibly(i, found), "", "  ");
    }
    if let Some(most) = found.telling.iter().map(|t| t.apart_m).reduce(f64::max) {
        out += &format!(
            "\n{} poses tell alternatives apart, by up to {:.3} mm: --poses FILE writes them\n",
            found.telling.len(),
            mm_from_m(most)
        );
    }
    if !found.cannot_test.is_empty() {
        out += "\ncould not be tested\n";
        for c in &found.cannot_test {
            out += &format!("  {}: needs {}\n", c.kind.definition().id, c.missing);
        }
    }
    if !found.outliers.is_empty() {
        out += &format!(
            "\n{} rows fit no model and hardly count\n",
            found.outliers.len()
        );
        for o in found.outliers.iter().take(most) {
            out += &format!(
                "  {}: {:.3} mm, {:.0} times the noise\n",
                o.line,
                mm_from_m(o.length_m),
                o.times
            );
        }
    }
    if !found.followed.is_empty() {
        out += &format!(
            "\n{} rows decide alone what the model says of them: no evidence for it\n",
            found.followed.len()
        );
        for f in found.followed.iter().take(most) {
            out += &format!("  {}: leverage {:.2}\n", f.line, f.leverage);
        }
    }
    out
}
