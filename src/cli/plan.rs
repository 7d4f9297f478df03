//! `plan`: which configurations to measure.

use super::driving::Driving;
use super::failure::Failure;
use super::layout::{aligned, print_text};
use super::measurements::{identify_failure, picks, tell_findings};
use super::page::ReportFile;
use super::progress::Progress;
use super::table::{JOINTS, Table, cell};
use super::{Answer, Output, files, print, print_json, values};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, m_from_mm};
use crate::identify::measurements::DIRECTION_COLUMNS;
use crate::identify::parameters::{Level, Selection};
use crate::identify::plan::{Constraints, Plan, Request, plan_telling};
use crate::report::approach::{self, Stop};
use crate::report::html::frames::plan_page;
use crate::report::identification;
use clap::Args;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Choose configurations to measure by observability
#[derive(Args)]
pub struct PlanCommand {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// How many configurations
    #[arg(long, value_name = "N")]
    count: usize,
    /// Joint angles to write (CSV); without it they are printed
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// A program that drives there, every joint arriving from below
    #[arg(long, value_name = "FILE")]
    program: Option<PathBuf>,
    /// Language of the program (default: that of the profile)
    #[arg(long, value_name = "NAME")]
    language: Option<String>,
    /// Random configurations to choose from
    #[arg(long, value_name = "N", default_value_t = 5000)]
    candidates: usize,
    /// Random sets to start from; the best set found is improved once more
    #[arg(long, value_name = "N", default_value_t = 4)]
    starts: usize,
    /// Seed of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// 0 frames alone; 1 and joint offsets and scales; 2 and link geometry; 3 and joint compliance
    #[arg(long, value_name = "0..3", default_value_t = 3, value_parser = clap::value_parser!(u8).range(0..=3))]
    level: u8,
    /// Effects to identify as well
    #[arg(long, value_name = "LIST")]
    identify: Option<String>,
    /// Effects that are known
    #[arg(long, value_name = "LIST")]
    fix: Option<String>,
    /// Tool of the profile (default: its only one)
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
    /// Standard deviation of a coordinate of the device
    #[arg(long, value_name = "MM", default_value_t = 0.05)]
    sigma_mm: f64,
    /// The device measures orientations too
    #[arg(long)]
    poses: bool,
    /// Configurations that are in the set already (CSV)
    #[arg(long, value_name = "FILE")]
    given: Option<PathBuf>,
    /// Distance from the joint limits
    #[arg(long, value_name = "DEG", default_value_t = 1.0)]
    margin_deg: f64,
    /// Every joint arrives from so far below
    #[arg(long, value_name = "DEG", default_value_t = 5.0)]
    approach_deg: f64,
    /// The tool is inside this box of the world wherever it is measured and approached from: x0,y0,z0,x1,y1,z1 in mm
    #[arg(long, value_name = "BOX", allow_hyphen_values = true)]
    inside_mm: Option<String>,
    /// Tool, wrist and elbow are outside this box wherever it is measured and approached from; may be given again
    #[arg(long, value_name = "BOX", allow_hyphen_values = true)]
    keep_out_mm: Vec<String>,
    /// Where the device stands: x,y,z in mm; the tool's z axis points to it within --cone-deg
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    device_mm: Option<String>,
    /// Half angle in which the reflector is seen
    #[arg(long, value_name = "DEG", default_value_t = 30.0)]
    cone_deg: f64,
    #[command(flatten)]
    report: ReportFile,
}

fn metres<const N: usize>(option: &str, text: &str) -> Result<[f64; N], Failure> {
    let parsed: Option<Vec<f64>> = text
        .split(',')
        .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
        .collect();
    let numbers: Option<[f64; N]> = parsed.and_then(|n| n.try_into().ok());
    let numbers = numbers.ok_or_else(|| {
        Failure::new(format!(
            "{option} {text}: expected {N} numbers with commas between"
        ))
    })?;
    Ok(numbers.map(m_from_mm))
}

fn metres_box(option: &str, text: &str) -> Result<[[f64; 3]; 2], Failure> {
    let [a, b, c, d, e, f] = metres::<6>(option, text)?;
    Ok([
        [a.min(d), b.min(e), c.min(f)],
        [a.max(d), b.max(e), c.max(f)],
    ])
}

impl PlanCommand {
    fn request(&self) -> Result<Request, Failure> {
        let given = match &self.given {
            None => Vec::new(),
            Some(path) => {
                let table = Table::read(path)?;
                table.require(&JOINTS)?;
                let rows = table
                    .rows()
                    .map(|row| Ok(row.numbers(JOINTS)?.map(|q| q * DEG)));
                rows.collect::<Result<Vec<_>, Failure>>()?
            }
        };
        for (option, value, most) in [
            ("--sigma-mm", self.sigma_mm, 1e6),
            ("--cone-deg", self.cone_deg, 180.0),
        ] {
            if !(1e-9..=most).contains(&value) {
                return Err(Failure::new(format!(
                    "{option} is {value:e}; it must be greater than 0 (1e-9 or more), and at most {most:e}"
                )));
            }
        }
        for (option, value) in [
            ("--margin-deg", self.margin_deg),
            ("--approach-deg", self.approach_deg),
        ] {
            if !(0.0..=90.0).contains(&value) {
                return Err(Failure::new(format!(
                    "{option} is {value}; it must be from 0 to 90"
                )));
            }
        }
        if self.count == 0 || self.candidates < self.count || self.candidates > 1_000_000 {
            return Err(Failure::new(format!(
                "{} of {} candidates: at least 1, and at most 1000000 to choose from",
                self.count, self.candidates
            )));
        }
        let keep_out = self
            .keep_out_mm
            .iter()
            .map(|t| metres_box("--keep-out-mm", t));
        let device = self
            .device_mm
            .as_deref()
            .map(|t| metres::<3>("--device-mm", t))
            .transpose()?;
        Ok(Request {
            count: self.count,
            candidates: self.candidates,
            starts: self.starts,
            seed: self.seed,
            sigma_m: m_from_mm(self.sigma_mm),
            poses: self.poses,
            given,
            constraints: Constraints {
                margin_rad: self.margin_deg * DEG,
                approach_rad: self.approach_deg * DEG,
                inside: self
                    .inside_mm
                    .as_deref()
                    .map(|t| metres_box("--inside-mm", t))
                    .transpose()?,
                keep_out: keep_out.collect::<Result<_, _>>()?,
                sight: device.map(|at| (at, self.cone_deg * DEG)),
            },
        })
    }

    /// Joint angles and, where each configuration is approached from below, the directions that the joints arrive in.
    fn table(&self, found: &Plan) -> String {
        let approached = self.approach_deg > 0.0;
        let mut header = vec!["id"];
        header.extend(JOINTS);
        header.extend(DIRECTION_COLUMNS.iter().filter(|_| approached));
        let mut table = header.join(",") + "\n";
        for (i, q) in found.joints.iter().enumerate() {
            let mut cells = vec![(i + 1).to_string()];
            cells.extend(q.iter().map(|q| cell(q / DEG)));
            cells.extend((0..6).filter(|_| approached).map(|_| "1".to_owned()));
            table += &(cells.join(",") + "\n");
        }
        table
    }

    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let request = self.request()?;
        let read = self.given.iter().chain([&self.profile]);
        let outputs = self.output.iter().chain(&self.program);
        self.report
            .refuse_over(read.map(PathBuf::as_path), outputs.map(PathBuf::as_path))?;
        let (profile, _) = files::read_profile(&self.profile)?;
        let tool = values::chosen_tool(self.tool.as_deref(), &profile)?;
        let selection = Selection {
            level: match self.level {
                0 => Level::Frames,
                1 => Level::Joints,
                2 => Level::Geometry,
                _ => Level::Compliance,
            },
            identify: picks("--identify", self.identify.as_deref())?,
            fix: picks("--fix", self.fix.as_deref())?,
            priors: false,
        };
        let name = self.profile.display().to_string();
        let progress = Progress::new(output, "choosing");
        let driving = Driving::new(&profile, &self.profile, &tool, &request.constraints)?;
        let mut found = plan_telling(
            &profile,
            &tool,
            &selection,
            &request,
            &|q| driving.admits(q),
            &mut |done, of| progress.tell(done, of),
        )
        .map_err(|error| identify_failure(&name, &error))?;
        drop(progress);
        let given = request.given.len();
        let order = driving.order(&found.joints[given..]);
        let (joints, chosen) = (found.joints.clone(), found.chosen.clone());
        for (to, from) in order.into_iter().enumerate() {
            found.joints[given + to] = joints[given + from];
            found.chosen[to] = chosen[from];
        }
        let table = self.table(&found);
        let mut findings = Vec::new();
        let mut written = Vec::new();
        let mut between = 0;
        if let Some(path) = &self.output {
            written.push((path.clone(), table.clone().into_bytes()));
        }
        if let Some(path) = &self.program {
            let language = self
                .language
                .as_deref()
                .or(profile.language.as_deref())
                .unwrap_or_default();
            let over = driving.over(&found.joints);
            let stops: Vec<Stop> = found
                .joints
                .iter()
                .zip(over)
                .map(|(q, over)| Stop { over, q: *q })
                .collect();
            between = stops.iter().map(|stop| stop.over.len()).sum();
            let text = approach::program(
                language,
                &stops,
                self.approach_deg * DEG,
                profile.pulses_per_deg,
            )
            .ok_or_else(|| {
                Failure::with_hint(
                    format!("no program can be written in `{language}`"),
                    format!(
                        "--language is one of: {}; inform needs controller.pulses_per_deg in the profile",
                        approach::LANGUAGES.join(", ")
                    ),
                )
            })?;
            findings = driving.findings(language, path, &text, &stops);
            written.push((path.clone(), text.into_bytes()));
        }
        if self.report.is_wanted() {
            let page = plan_page(&found, &profile, &tool, &name);
            written.extend(self.report.output(Some(&page)));
        }
        files::write_all(&written)?;
        if output.json {
            let mut report = report(&found);
            let names: Vec<String> = written
                .iter()
                .map(|(p, _)| p.display().to_string())
                .collect();
            report["output"] = json!(names);
            report["poses_between"] = json!(between);
            report["findings"] = json!(findings);
            return print_json(&report).map(|()| Answer::Yes);
        }
        tell_findings(&shown(findings, output), output);
        if self.output.is_none() {
            // the table is the answer; what it is worth stands beside it
            if !output.quiet {
                anstream::eprint!("{}", text(&found, self.sigma_mm));
            }
            print(&table)?;
        } else if !output.quiet {
            print_text(&text(&found, self.sigma_mm))?;
            if between > 0 {
                print(&format!(
                    "the program goes over {between} poses between that are not measured\n"
                ))?;
            }
            print(&self.report.told())?;
        }
        Ok(Answer::Yes)
    }
}

/// Findings of one name that are told before the rest is only counted.
const SHOWN: usize = 5;

/// What is told of many findings: notes with `--verbose` only, and of each name the first.
fn shown(findings: Vec<Finding>, output: Output) -> Vec<Finding> {
    let mut counts: std::collections::BTreeMap<&str, usize> = std::collections::BTreeMap::new();
    let mut told = Vec::new();
    for mut finding in findings {
        let count = counts.entry(finding.id).or_default();
        *count += 1;
        if *count > 1 {
            finding.hint.clear();
        }
        if output.verbose || (finding.severity > Severity::Note && *count <= SHOWN) {
            told.push(finding);
        }
    }
    for (id, count) in counts {
        if let Some(last) = told.iter_mut().rev().find(|finding| finding.id == id)
            && !output.verbose
            && count > SHOWN
        {
            last.hint = format!("and {} more: -v or --json tells all", count - SHOWN);
        }
    }
    told
}

fn report(found: &Plan) -> Value {
    let mut report = json!({"poseshift": "plan/1"});
    let observability = identification::observability(&found.observability);
    if let (Value::Object(report), Value::Object(own)) = (&mut report, observability) {
        report.extend(own);
    }
    let kept = found.identifiable.kept.iter().zip(&found.sigma);
    report["expected_sigma"] = kept
        .map(|(i, sigma)| {
            let p = &found.parameters[*i];
            json!({"key": p.key, "sigma": sigma / p.unit.in_si(), "unit": p.unit.symbol()})
        })
        .collect();
    report["not_determined"] = found
        .identifiable
        .dropped
        .iter()
        .map(|d| {
            let with: Vec<&str> = d
                .confounded_with
                .iter()
                .map(|i| found.parameters[*i].key.as_str())
                .collect();
            json!({"key": found.parameters[d.parameter].key, "confounded_with": with})
        })
        .collect();
    report["joints_deg"] = found
        .joints
        .iter()
        .map(|q| json!(q.map(|q| q / DEG)))
        .collect();
    report["starts_o1"] = json!(found.starts_o1);
    report["exchanges"] = json!(found.exchanges);
    report["admitted"] = json!(found.admitted);
    report
}

fn text(found: &Plan, sigma_mm: f64) -> String {
    let o = &found.observability;
    let mut out = format!(
        "{} configurations; {:.1} % of random ones meet the constraints\n",
        found.joints.len(),
        100.0 * found.admitted
    );
    out += &format!(
        "O1 {:.4}, condition number {:.3e}, rank {}\n",
        o.o1, o.condition_number, o.rank
    );
    out += &format!(
        "O2 {:.3e}, O3 {:.3e}, O4 {:.3e}, O5 {:.3e}\n\n",
        o.o2, o.o3, o.o4, o.o5
    );
    out += &format!("expected standard deviations with {sigma_mm} mm a coordinate\n");
    let mut rows = vec![["parameter", "sigma", "unit"].map(str::to_owned).to_vec()];
    for (i, sigma) in found.identifiable.kept.iter().zip(&found.sigma) {
        let p = &found.parameters[*i];
        rows.push(vec![
            p.key.clone(),
            format!("{:.3e}", sigma / p.unit.in_si()),
            p.unit.symbol().into(),
        ]);
    }
    out += &aligned(&rows);
    for dropped in &found.identifiable.dropped {
        out += &format!(
            "not determined: {}\n",
            found.parameters[dropped.parameter].key
        );
    }
    out
}
