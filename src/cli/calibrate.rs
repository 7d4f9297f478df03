//! `calibrate`: measurements to a profile.

use super::failure::Failure;
use super::layout::{SPREAD_HEADER, aligned, print_text, spread_row};
use super::measurements::{MeasurementFiles, identify_failure, picks, tell_findings};
use super::page::ReportFile;
use super::progress::Progress;
use super::{Answer, Output, files, print, print_json};
use crate::geometry::units::{DEG, mm_from_m};
use crate::identify::calibration::{
    BasePolicy, Calibration, Options, STRONG_CORRELATION, calibrate,
};
use crate::identify::measurements::Purpose;
use crate::identify::parameters::{Level, Selection};
use crate::identify::robust::Shape;
use crate::model::profile::rewritten;
use crate::report::html::measurements::calibrate_page;
use crate::report::identification;
use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Loss of a residual
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LossName {
    /// Its square
    Squares,
    /// Its square, in proportion to it beyond 3 standard deviations
    Huber,
    /// Rows far beyond do not count at all
    Tukey,
}

impl LossName {
    /// The shape of this name.
    pub const fn shape(self) -> Shape {
        match self {
            Self::Squares => Shape::Squares,
            Self::Huber => Shape::Huber,
            Self::Tukey => Shape::Tukey,
        }
    }
}

/// What becomes of the measured place of the base
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BaseName {
    /// `profile` where they are within 20 mm and 1 deg, else `device`
    Auto,
    /// It replaces the profile's base: the world is the device's frame
    Device,
    /// The profile's base stays: the difference is the effect `base_frame`
    Profile,
}

/// Identify a robot's effects from measurements
#[derive(Args)]
pub struct Calibrate {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    #[command(flatten)]
    measurements: MeasurementFiles,
    /// Calibrated profile to write (YAML)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// 0 frames alone; 1 and joint offsets and scales; 2 and link geometry; 3 and joint compliance
    #[arg(long, value_name = "0..3", value_parser = clap::value_parser!(u8).range(0..=3))]
    level: Option<u8>,
    /// Identify these effects, with --level as well as that, else beside base and tool alone:
    /// `joint_compliance:2-6,joint_harmonic:6:1`
    #[arg(long, value_name = "LIST")]
    identify: Option<String>,
    /// Leave these as they are: `tool_frame,link_geometry:6.theta_deg`
    #[arg(long, value_name = "LIST")]
    fix: Option<String>,
    /// Count each effect's typical size as one more measurement
    #[arg(long)]
    priors: bool,
    /// How residuals count
    #[arg(long, value_enum, default_value = "huber")]
    loss: LossName,
    /// What becomes of the measured place of the base
    #[arg(long, value_enum, default_value = "auto")]
    base: BaseName,
    /// Date for the profile's provenance, as you write it
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
    #[command(flatten)]
    report: ReportFile,
}

impl Calibrate {
    fn options(&self) -> Result<Options, Failure> {
        let identify = picks("--identify", self.identify.as_deref())?;
        if self.identify.is_some() && identify.is_empty() {
            let hint = "`poseshift effects` lists them; without --identify the --level says which";
            return Err(Failure::with_hint("--identify names no effect", hint));
        }
        // a list without a level is meant alone
        let level = match (self.level, &self.identify) {
            (Some(0), _) | (None, Some(_)) => Level::Frames,
            (Some(1), _) => Level::Joints,
            (Some(2), _) => Level::Geometry,
            _ => Level::Compliance,
        };
        Ok(Options {
            selection: Selection {
                level,
                identify,
                fix: picks("--fix", self.fix.as_deref())?,
                priors: self.priors,
            },
            shape: self.loss.shape(),
            base: match self.base {
                BaseName::Auto => BasePolicy::Nearest,
                BaseName::Device => BasePolicy::Device,
                BaseName::Profile => BasePolicy::Profile,
            },
        })
    }

    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let options = self.options()?;
        let (profile, profile_hash) = files::read_profile(&self.profile)?;
        let read = self.measurements.paths().chain([self.profile.as_path()]);
        let outputs = self.output.iter().map(PathBuf::as_path);
        self.report.refuse_over(read, outputs)?;
        let (measurements, hashes) = self.measurements.read()?;
        let name = self.measurements.name();
        let progress = Progress::new(output, "identifying");
        let found = calibrate(&profile, &measurements, &options)
            .map_err(|error| identify_failure(&name, &error))?;
        drop(progress);
        let mut report = identification::calibration(&found, &name);
        report["profile_sha256"] = json!(profile_hash);
        report["measurements_sha256"] = json!(hashes);
        let mut outputs = Vec::new();
        if let Some(path) = &self.output {
            let mut calibrated = found.profile();
            calibrated.quality = Some(identification::profile_quality(&found));
            calibrated.provenance = Some(self.provenance(&found, &profile_hash, &hashes));
            let text = rewritten(&files::read_text(&self.profile)?, &calibrated)
                .map_err(|error| Failure::new(format!("{}: {error}", self.profile.display())))?;
            outputs.push((path.clone(), text.into_bytes()));
            report["output"] = json!(path.display().to_string());
        }
        if self.report.is_wanted() {
            let fit = measurements.filtered(|_, row| row.purpose != Some(Purpose::Validate));
            let written = self.output.as_ref().map(|path| path.display().to_string());
            let page = calibrate_page(&found, &fit, &name, written.as_deref());
            outputs.extend(self.report.output(Some(&page)));
        }
        files::write_all(&outputs)?;
        if output.json {
            print_json(&report)?;
            return Ok(Answer::Yes);
        }
        tell_findings(&identification::findings(&found.remarks, &name), output);
        if !output.quiet {
            print_text(&text(&found, output.verbose))?;
            if let Some(path) = &self.output {
                print(&format!("\nwritten to {}\n", path.display()))?;
            }
            print(&self.report.told())?;
        }
        Ok(Answer::Yes)
    }

    fn provenance(&self, found: &Calibration, profile: &str, measurements: &[String]) -> Value {
        let rows = &found.problem.rows;
        let temperatures: Vec<f64> = rows
            .iter()
            .filter_map(|r| r.conditions.temperature_c)
            .collect();
        let mut map = json!({
            "program": format!("poseshift {}", env!("CARGO_PKG_VERSION")),
            "profile_sha256": profile,
            "measurements_sha256": measurements,
            "rows": rows.len(),
            "stopped": found.stop().describe(),
            "tools": found.problem.tools.iter().map(|t| json!({
                "tool": t.name, "mass_kg": t.load.map_or(0.0, |(mass, _)| mass),
            })).collect::<Vec<_>>(),
        });
        if !temperatures.is_empty() {
            map["temperature_c"] =
                json!(temperatures.iter().sum::<f64>() / temperatures.len() as f64);
        }
        if let Some(date) = &self.date {
            map["date"] = json!(date);
        }
        map
    }
}

/// The report for people.
fn text(found: &Calibration, all: bool) -> String {
    let mut out = format!(
        "{} rows, {} numbers, {} of {} parameters determined\n",
        found.problem.rows.len(),
        found.problem.numbers(),
        found.solution.parameters.len(),
        found.problem.parameters.len(),
    );
    out += &format!(
        "stopped after {} passes: {}\n\n",
        found.solution.passes,
        found.stop().describe()
    );
    let mut rows = vec![SPREAD_HEADER.map(str::to_owned).to_vec()];
    let mut models = vec![
        ("before", &found.before),
        ("frames only", &found.frames_only_quality),
        ("after", &found.after),
    ];
    if let Some((frames, full)) = &found.held_out {
        models.extend([("held out, frames only", frames), ("held out, after", full)]);
    }
    for (name, quality) in models {
        for (what, spread) in [
            ("mm", quality.position),
            ("deg", quality.orientation),
            ("distance mm", quality.range),
        ] {
            rows.extend(spread.map(|s| spread_row(&format!("{name}, {what}"), &s)));
        }
    }
    out += &aligned(&rows);
    let u = &found.uncertainty;
    let given = if found.problem.sigma_assumed {
        "assumed"
    } else {
        "given"
    };
    out += &format!(
        "\nresiduals are {:.2} times the {given} standard deviations; sigmas below are scaled by {:.2}\n",
        u.sigma_factor, u.applied_factor
    );
    if let Some(expected_m) = found.expected_m {
        out += &format!(
            "expected error over the joint limits, by these sigmas: {:.4} mm rms\n",
            mm_from_m(expected_m)
        );
    }
    let o = &found.observability;
    out += &format!(
        "O1 {:.4}, condition number {:.3e}, rank {}\n\n",
        o.o1, o.condition_number, o.rank
    );
    let mut rows = vec![
        ["parameter", "value", "sigma", "unit"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for (parameter, value, sigma) in found.parameters() {
        if let Some(sigma) = sigma {
            rows.push(vec![
                parameter.key.clone(),
                parameter.digits(value),
                parameter.digits(sigma),
                parameter.unit.symbol().into(),
            ]);
        }
    }
    out += &aligned(&rows);
    for (feature, place) in found.features() {
        let [x, y, z] = place.centre_m.map(mm_from_m);
        out += &format!(
            "{} {} at ({x:.3}, {y:.3}, {z:.3}) mm",
            feature.kind.id(),
            feature.name
        );
        if let Some(radius_m) = place.radius_m {
            out += &format!(", radius {:.4} mm", mm_from_m(radius_m));
        }
        if let Some([x, y, z]) = place.normal {
            out += &format!(", normal ({x:.6}, {y:.6}, {z:.6})");
        }
        out.push('\n');
    }
    let as_prior: Vec<&str> = found
        .parameters()
        .filter(
            |(p, _, sigma)| matches!((p.prior, sigma), (Some((_, own)), Some(s)) if *s > 0.7 * own),
        )
        .map(|(p, _, _)| p.key.as_str())
        .collect();
    if !as_prior.is_empty() {
        let told = format!(
            "the data tell hardly more than the prior of {} of these: {}",
            as_prior.len(),
            as_prior.join(", ")
        );
        out += &format!("\n{told}\n");
    }
    let names = &found.problem.parameters;
    if !found.solution.identifiable.dropped.is_empty() {
        out += "\nnot determined by these data, left as they were\n";
    }
    for dropped in &found.solution.identifiable.dropped {
        let with: Vec<&str> = dropped
            .confounded_with
            .iter()
            .take(3)
            .map(|i| names[*i].key.as_str())
            .collect();
        let weak = dropped.weak.map(|w| {
            let p = &names[dropped.parameter];
            format!(
                "sigma would be {} {}; ",
                p.digits(w * p.scale),
                p.unit.symbol()
            )
        });
        let why = if with.is_empty() {
            "does not show in what was measured".to_owned()
        } else {
            format!("like {}", with.join(", "))
        };
        out += &format!(
            "  {}: {}{why}\n",
            names[dropped.parameter].key,
            weak.unwrap_or_default()
        );
    }
    let strong = u.strong_correlations(STRONG_CORRELATION);
    if !strong.is_empty() {
        out += &format!(
            "\n{} pairs of parameters are correlated by more than {STRONG_CORRELATION}\n",
            strong.len()
        );
        let shown = if all { strong.len() } else { 5 };
        for (i, j, c) in strong.iter().take(shown) {
            let keys = &found.solution.parameters;
            out += &format!("  {c:+.3}  {} / {}\n", keys[*i].key, keys[*j].key);
        }
    }
    if found.base_replaced {
        let [x, y, z, rx, ry, rz] = found.solution.estimate.world_from_base.xyz_rxryrz();
        out += &format!(
            "\nthe base stands at ({:.3}, {:.3}, {:.3}) mm,\n  turned by ({:.5}, {:.5}, {:.5}) deg in the device's frame\n",
            mm_from_m(x),
            mm_from_m(y),
            mm_from_m(z),
            rx / DEG,
            ry / DEG,
            rz / DEG
        );
    }
    if !found.outliers.is_empty() {
        out += &format!("\n{} rows do not fit the others\n", found.outliers.len());
        let shown = if all { found.outliers.len() } else { 10 };
        let mut rows = vec![
            ["line", "id", "residual mm", "times typical", "weight"]
                .map(str::to_owned)
                .to_vec(),
        ];
        for o in found.outliers.iter().take(shown) {
            rows.push(vec![
                o.line.short(),
                o.id.clone(),
                format!("{:.3}", mm_from_m(o.length_m)),
                format!("{:.1} (limit {:.1})", o.times, o.limit),
                format!("{:.2}", o.weight),
            ]);
        }
        out += &aligned(&rows);
    }
    out
}
