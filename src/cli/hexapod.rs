//! `hexapod`: ballbar lengths to poses with uncertainty, the base frame, and the poses that a robot can measure.

use super::failure::Failure;
use super::page::ReportFile;
use super::registration::sigma_json;
use super::table::{JOINTS, POSE, Row, Table, cell};
use super::{Answer, Output, files, print, print_json, values};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Quaternion};
use crate::register::frame_file::{Frame, Sigma};
use crate::register::hexapod::{
    Design, Device, HexapodError, Lengths, NAMES, Solved, Spread, modes, near, reach,
    set_base_frame, solve, spread,
};
use crate::register::uncertainty::PoseCovariance;
use crate::report;
use crate::report::html::frames::{Left, Uncertain, frame_page};
use crate::report::html::page::Page;
use clap::Args;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Turn ballbar lengths into tool poses with uncertainty
#[derive(Args)]
#[command(
    after_help = "LENGTHS: design (e.g. 123/123), b12_mm,b23_mm,b31_mm,t12_mm,t23_mm,t31_mm,r11_mm,r21_mm,r31_mm,r12_mm,r22_mm,\
r23_mm; optional mode (1 to 4) or a rough pose x_mm,y_mm,z_mm,qw,qx,qy,qz; q1_deg…q6_deg for -o.\nWith --taught: three points \
and --base-mm give the frame of the base balls. With --reach: the 72 measurable poses and the joints that go there."
)]
pub struct Hexapod {
    /// Lengths, one setting a row
    #[arg(value_name = "LENGTHS.csv", required_unless_present_any = ["taught", "reach"])]
    lengths: Option<PathBuf>,
    /// Standard deviation of every length, for uncertainties in mm and degrees
    #[arg(long, value_name = "MM", default_value_t = 0.001)]
    sigma_mm: f64,
    /// Where the base balls stand in the world: a frame file
    #[arg(long, value_name = "FRAME.yaml")]
    frame: Option<PathBuf>,
    /// Write measurements for `calibrate` (rows with joints), the frame file (--taught), or joints (--reach)
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// The base balls B1 B2 B3 as the robot was taught them (points): find their frame
    #[arg(long, value_name = "POINTS.csv", requires = "base_mm", conflicts_with_all = ["lengths", "reach"])]
    taught: Option<PathBuf>,
    /// List the measurable poses and whether the robot of --profile reaches them
    #[arg(long, requires_all = ["base_mm", "tool_mm", "profile", "frame"], conflicts_with = "lengths")]
    reach: bool,
    /// Exact distances B1B2,B2B3,B3B1
    #[arg(long, value_name = "B12,B23,B31")]
    base_mm: Option<String>,
    /// Exact distances T1T2,T2T3,T3T1
    #[arg(long, value_name = "T12,T23,T31")]
    tool_mm: Option<String>,
    /// Nominal length of the ballbar
    #[arg(long, value_name = "MM", default_value_t = 300.0)]
    leg_mm: f64,
    /// The ballbar measures so far to each side of it
    #[arg(long, value_name = "MM", default_value_t = 1.0)]
    range_mm: f64,
    /// Robot profile (YAML), for --reach
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
    /// Tool of the profile whose frame is that of the tool balls: origin T1, x to T2, T3 in the xy plane
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
    #[command(flatten)]
    report: ReportFile,
}

/// One row of lengths, solved.
struct Setting {
    id: String,
    design: Design,
    found: Vec<(Solved, Spread)>,
    q_deg: Option<[f64; 6]>,
}

impl Hexapod {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        if !(self.sigma_mm.is_finite() && self.sigma_mm >= 0.0) {
            return Err(Failure::new(format!(
                "--sigma-mm {}: it must be 0 or more",
                self.sigma_mm
            )));
        }
        if self.report.is_wanted() && self.lengths.is_none() {
            return Err(Failure::with_hint(
                "--report goes with LENGTHS only",
                "--taught and --reach have nothing to look at",
            ));
        }
        let given = self.taught.iter().chain(&self.profile);
        let read = self.lengths.iter().chain(&self.frame).chain(given);
        let outputs = self.output.iter().map(PathBuf::as_path);
        self.report
            .refuse_over(read.map(PathBuf::as_path), outputs)?;
        if let Some(path) = &self.taught {
            return self.set_base(path, output);
        }
        if self.reach {
            return self.list(output);
        }
        let path = self
            .lengths
            .as_ref()
            .expect("clap asks for LENGTHS where nothing else is asked");
        let table = Table::read(path)?;
        let columns = NAMES.map(|name| format!("{name}_mm"));
        table.require(&columns.each_ref().map(String::as_str))?;
        table.require(&["design"])?;
        let mut settings = Vec::new();
        for (number, row) in table.rows().enumerate() {
            settings.push(setting(&table, &row, number)?);
        }
        let several = settings.iter().filter(|s| s.found.len() > 1).count();
        let mut outputs = Vec::new();
        if let Some(out) = &self.output {
            let text = self.measurements(&settings, path)?;
            outputs.push((out.clone(), text.into_bytes()));
        }
        if self.report.is_wanted() {
            let page = self.drawn(&settings, path, several);
            outputs.extend(self.report.output(Some(&page)));
        }
        files::write_all(&outputs)?;
        if output.json {
            let poses: Vec<Value> = settings
                .iter()
                .flat_map(|setting| setting.found.iter().map(|f| self.pose_json(setting, f)))
                .collect();
            print_json(
                &json!({"poseshift": "hexapod/1", "poses": poses, "sigma_mm": self.sigma_mm, "undecided": several}),
            )?;
        } else if !output.quiet {
            print(&self.text(&settings, several))?;
            print(&self.report.told())?;
        }
        Ok(Answer::Yes)
    }

    fn covariance(&self, solved: &Solved, spread: &Spread) -> PoseCovariance {
        let square = m_from_mm(self.sigma_mm).powi(2);
        PoseCovariance {
            centre_m: solved.pose.translation,
            matrix: spread.pose.map(|row| row.map(|v| v * square)),
        }
    }

    fn sigma(&self, solved: &Solved, spread: &Spread) -> Sigma {
        Sigma::of(&self.covariance(solved, spread), &solved.pose)
    }

    /// The page: the tool balls of every pose with their ellipsoids.
    fn drawn(&self, settings: &[Setting], path: &Path, several: usize) -> Page {
        let mut ellipsoids = Vec::new();
        for setting in settings {
            for (solved, spread) in &setting.found {
                let covariance = self.covariance(solved, spread);
                for (k, ball) in solved.tool_points_m.iter().enumerate() {
                    let ellipsoid = covariance.ellipsoid(*ball);
                    ellipsoids.push(Uncertain {
                        name: format!("{} mode {} T{}", setting.id, solved.mode, k + 1),
                        place_m: *ball,
                        half_axes_m: ellipsoid.half_axes_m,
                        axes: std::array::from_fn(|i| ellipsoid.axes.axis(i)),
                    });
                }
            }
        }
        let poses: usize = settings.iter().map(|s| s.found.len()).sum();
        let largest = ellipsoids
            .iter()
            .map(|e| e.half_axes_m[0])
            .fold(0.0, f64::max);
        let points = ellipsoids.iter().map(|e| Left {
            id: e.name.clone(),
            place_m: e.place_m,
            left_m: [0.0; 3],
            rejected: None,
        });
        frame_page(&report::html::frames::Frame {
            title: "Ballbar hexapod".into(),
            lead: vec![format!(
                "{}, in the frame of the base balls; {} mm a length",
                path.display(),
                self.sigma_mm
            )],
            answer: format!("{poses} poses of {} rows", settings.len()),
            facts: vec![
                (
                    "largest uncertainty of a ball".into(),
                    format!("{:.5} mm", mm_from_m(largest)),
                ),
                ("rows with more than one mode".into(), several.to_string()),
            ],
            points: points.collect(),
            ellipsoids,
            findings: Vec::new(),
        })
    }

    fn pose_json(&self, setting: &Setting, (solved, spread): &(Solved, Spread)) -> Value {
        json!({
            "id": setting.id, "design": setting.design.name(), "mode": solved.mode,
            "tool_points_mm": solved.tool_points_m.map(|p| p.map(mm_from_m)),
            "sigma_tool_points": spread.points, "pose": report::pose(&solved.pose),
            "sigma": sigma_json(&self.sigma(solved, spread)),
        })
    }

    fn text(&self, settings: &[Setting], several: usize) -> String {
        let ok = "a string takes all text";
        let mut text = format!(
            "poses in the frame of the base balls; sigma for {} mm a length\n  id    design  mode {:>9} {:>9} {:>9}  mm {:>8} {:>8} {:>8} deg {:>8} mm\n",
            self.sigma_mm, "x", "y", "z", "rx", "ry", "rz", "sigma"
        );
        for setting in settings {
            for (solved, spread) in &setting.found {
                let [x, y, z, rx, ry, rz] = solved.pose.xyz_rxryrz();
                let [x, y, z] = [x, y, z].map(mm_from_m);
                let [rx, ry, rz] = [rx, ry, rz].map(|r| r / DEG);
                let largest = spread
                    .points
                    .iter()
                    .map(|p| p.iter().map(|s| s * s).sum::<f64>().sqrt())
                    .fold(0.0, f64::max);
                writeln!(
                    text,
                    "  {:<5} {} {:>5} {x:9.4} {y:9.4} {z:9.4}     {rx:8.4} {ry:8.4} {rz:8.4}     {:8.5}",
                    setting.id,
                    setting.design.name(),
                    solved.mode,
                    largest * self.sigma_mm
                )
                .expect(ok);
            }
        }
        if several > 0 {
            writeln!(
                text,
                "{several} rows have more than one mode: a column mode or a rough pose (x_mm … qz) chooses"
            )
            .expect(ok);
        }
        text
    }

    /// Positions of the three tool balls for each row with joints.
    fn measurements(&self, settings: &[Setting], path: &Path) -> Result<String, Failure> {
        let world_from_device = match &self.frame {
            Some(path) => files::read_frame(path)?.to_from_from,
            None => Pose::identity(),
        };
        let mut text = format!("id,{},point,x_mm,y_mm,z_mm,sigma_mm\n", JOINTS.join(","));
        for setting in settings {
            let row = format!("{}: row {}", path.display(), setting.id);
            let q = setting.q_deg.ok_or_else(|| {
                Failure::with_hint(
                    format!("{row}: no joints"),
                    "measurements need the columns q1_deg…q6_deg",
                )
            })?;
            let [(solved, spread)] = setting.found.as_slice() else {
                return Err(Failure::with_hint(
                    format!("{row}: {} assembly modes", setting.found.len()),
                    "a column mode or a rough pose chooses",
                ));
            };
            for (k, point) in solved.tool_points_m.iter().enumerate() {
                let p = world_from_device.transform(*point).map(mm_from_m);
                let square: f64 = spread.points[k].iter().map(|s| s * s).sum();
                let sigma = self.sigma_mm * (square / 3.0).sqrt();
                let numbers: Vec<String> = q.iter().map(|v| cell(*v)).collect();
                let place: Vec<String> = p.iter().map(|v| cell(*v)).collect();
                text += &format!(
                    "{}-T{},{},T{},{},{}\n",
                    setting.id,
                    k + 1,
                    numbers.join(","),
                    k + 1,
                    place.join(","),
                    cell(sigma)
                );
            }
        }
        Ok(text)
    }

    fn set_base(&self, path: &Path, output: Output) -> Result<Answer, Failure> {
        let points = super::points::Points::read(path)?;
        let base = three("--base-mm", self.base_mm.as_deref())?;
        let name = path.display();
        let taught = <[_; 3]>::try_from(points.positions()).map_err(|points| {
            Failure::new(format!(
                "{name}: {} points; the base has three: B1, B2, B3",
                points.len()
            ))
        })?;
        let found = set_base_frame(taught, base)
            .map_err(|error| Failure::new(format!("{name}: {error}")))?;
        let frame = Frame {
            to_from_from: found.robot_from_base,
            sigma: None,
            rmsd_m: Some(found.rms_m),
            points: Some(3),
            provenance: BTreeMap::from([
                ("method".into(), "three taught points".into()),
                ("to".into(), name.to_string()),
            ]),
        };
        if let Some(out) = &self.output {
            files::write_all(&[(out.clone(), frame.to_yaml().into_bytes())])?;
        }
        if output.json {
            print_json(&json!({
                "poseshift": "hexapod/1", "base": report::pose(&found.robot_from_base),
                "rmsd_mm": mm_from_m(found.rms_m), "residuals_mm": found.left_m.map(|v| v.map(mm_from_m)),
            }))?;
        } else if !output.quiet {
            print(&frame.to_yaml())?;
        }
        Ok(Answer::Yes)
    }

    fn list(&self, output: Output) -> Result<Answer, Failure> {
        let device = Device {
            base_m: three("--base-mm", self.base_mm.as_deref())?,
            tool_m: three("--tool-mm", self.tool_mm.as_deref())?,
            leg_m: m_from_mm(self.leg_mm),
            range_m: m_from_mm(self.range_mm),
        };
        let missing = "clap asks for it with --reach";
        let (profile, _) = files::read_profile(self.profile.as_ref().expect(missing))?;
        let frame = files::read_frame(self.frame.as_ref().expect(missing))?;
        let tool = values::chosen_tool(self.tool.as_deref(), &profile)?;
        crate::register::hexapod::measurable(&device)
            .map_err(|error| Failure::new(error.to_string()))?;
        let all = reach(&device, &frame.to_from_from, &profile, &tool)
            .map_err(|error| Failure::new(error.to_string()))?;
        let mut csv = format!("id,design,mode,branch,{}\n", JOINTS.join(","));
        for (number, reached) in all.iter().enumerate() {
            for (branch, q) in &reached.postures {
                let q: Vec<String> = q.iter().map(|v| cell(v / DEG)).collect();
                csv += &format!(
                    "{},{},{},{},{}\n",
                    number + 1,
                    reached.design.name(),
                    reached.solved.mode,
                    branch.number(),
                    q.join(",")
                );
            }
        }
        if let Some(out) = &self.output {
            files::write_all(&[(out.clone(), csv.into_bytes())])?;
        }
        let count = all.iter().filter(|r| r.measurable).count();
        if output.json {
            let rows: Vec<Value> = all
                .iter()
                .enumerate()
                .map(|(number, r)| {
                    let postures: Vec<Value> = r
                        .postures
                        .iter()
                        .map(|(branch, q)| {
                            json!({"branch": branch.number(), "joints_deg": q.map(|q| q / DEG)})
                        })
                        .collect();
                    json!({"id": number + 1, "design": r.design.name(), "mode": r.solved.mode,
                           "pose": report::pose(&r.solved.pose), "postures": postures,
                           "leg_error_mm": r.leg_error_m.map(mm_from_m), "measurable": r.measurable})
                })
                .collect();
            print_json(&json!({"poseshift": "hexapod/1", "measurable": count, "reach": rows}))?;
        } else if !output.quiet {
            let mut text = String::from("  id  design  mode  postures  leg error mm\n");
            for (number, r) in all.iter().enumerate() {
                let told = match r.leg_error_m {
                    None => "out of reach".to_owned(),
                    Some(e) if r.measurable => format!("{:.4}", mm_from_m(e)),
                    Some(e) => format!("{:.4}, beyond the ballbar", mm_from_m(e)),
                };
                text += &format!(
                    "{:4}  {} {:>5} {:>9}  {told}\n",
                    number + 1,
                    r.design.name(),
                    r.solved.mode,
                    r.postures.len()
                );
            }
            text += &format!("{count} of {} poses are measurable\n", all.len());
            print(&text)?;
        }
        Ok(Answer::Yes)
    }
}

/// Reads and solves a row.
fn setting(table: &Table, row: &Row, number: usize) -> Result<Setting, Failure> {
    let fail = |error: &HexapodError| row.failure(error.to_string());
    let columns = NAMES.map(|name| format!("{name}_mm"));
    let mut all = [0.0; 12];
    for (slot, column) in all.iter_mut().zip(&columns) {
        *slot = m_from_mm(row.number(column)?);
    }
    let lengths = Lengths::from_all(all);
    let design =
        Design::parse(row.text("design").unwrap_or_default()).map_err(|error| fail(&error))?;
    let solved = if table.has("mode") {
        let mode = row.number("mode")?;
        let whole = (1..=4_u8).find(|m| f64::from(*m) == mode);
        let whole = whole.ok_or_else(|| fail(&HexapodError::Mode { found: mode }))?;
        vec![solve(&lengths, &design, usize::from(whole)).map_err(|error| fail(&error))?]
    } else if POSE.iter().all(|c| table.has(c)) {
        let [x, y, z, w, i, j, k] = row.numbers(POSE)?;
        let rough = Pose::from_parts(
            [x, y, z].map(m_from_mm),
            Quaternion([w, i, j, k]).normalized(),
        );
        vec![near(&lengths, &design, &rough).map_err(|error| fail(&error))?]
    } else {
        modes(&lengths, &design).map_err(|error| fail(&error))?
    };
    let q_deg = if JOINTS.iter().all(|c| table.has(c)) {
        Some(row.numbers(JOINTS)?)
    } else {
        None
    };
    Ok(Setting {
        id: row.id(number + 1),
        design,
        found: solved
            .into_iter()
            .map(|s| (s, spread(&lengths, &design, s.mode)))
            .collect(),
        q_deg,
    })
}

/// Three lengths in mm.
fn three(option: &str, text: Option<&str>) -> Result<[f64; 3], Failure> {
    let text = text.unwrap_or_default();
    values::point(text)
        .filter(|lengths| lengths.iter().all(|l| *l > 0.0))
        .ok_or_else(|| {
            Failure::new(format!(
                "{option} {text}: it must be three lengths in mm, such as 300,300,300"
            ))
        })
}
