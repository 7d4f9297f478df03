//! `simulate`: measurements of the robot that a profile describes.

use super::failure::Failure;
use super::table::{JOINTS, Table, cell};
use super::{Answer, Output, files, print, print_json, values};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::identify::measurements::{
    DIRECTION_COLUMNS, DISTANCE_COLUMNS, FORCE_COLUMNS, Measurement, Observed, POSITION_COLUMNS,
    QUATERNION_COLUMNS,
};
use crate::identify::simulate::{Command, Device, Session, simulate};
use crate::model::Conditions;
use clap::{Args, ValueEnum};
use serde_json::json;
use std::path::PathBuf;

/// What the imagined device gives
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Positions
    Position,
    /// Positions and orientations
    Pose,
    /// Distances from the points of --from
    Distance,
}

/// Make measurements of the robot that a profile describes
#[derive(Args)]
pub struct Simulate {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Joint angles (CSV with `q1_deg…q6_deg`, optional dir1…dir6 and `fx_n,fy_n,fz_n`)
    #[arg(long, value_name = "FILE")]
    joints: PathBuf,
    /// Measurements to write (CSV); without it they are printed
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Standard deviation of a coordinate or distance
    #[arg(long, value_name = "MM", default_value_t = 0.0)]
    noise_mm: f64,
    /// Standard deviation of an angle about each axis
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    noise_deg: f64,
    /// Seed of the noise
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// What the device gives
    #[arg(long, value_enum, default_value = "position")]
    kind: Kind,
    /// A point that distances are measured from: x,y,z in mm; several in turn
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    from: Vec<String>,
    /// Tool of the profile (default: its only one)
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
    /// Part of the rows that are wrong, 0 to 1
    #[arg(long, value_name = "PART", default_value_t = 0.0)]
    outliers: f64,
    /// Size of a wrong row's error
    #[arg(long, value_name = "MM", default_value_t = 10.0)]
    outlier_mm: f64,
    /// Temperature of the first and last row
    #[arg(long, value_name = "C,C")]
    temperature_c: Option<String>,
    /// Seconds from row to row
    #[arg(long, value_name = "S")]
    interval_s: Option<f64>,
}

fn numbers<const N: usize>(option: &str, text: &str) -> Result<[f64; N], Failure> {
    let parsed: Option<Vec<f64>> = text
        .split(',')
        .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
        .collect();
    parsed.and_then(|n| n.try_into().ok()).ok_or_else(|| {
        Failure::new(format!(
            "{option} {text}: expected {N} numbers with commas between"
        ))
    })
}

impl Simulate {
    fn session(&self) -> Result<Session, Failure> {
        let sizes = [
            ("--noise-mm", self.noise_mm, f64::INFINITY),
            ("--noise-deg", self.noise_deg, 180.0),
            ("--outliers", self.outliers, 1.0),
            ("--outlier-mm", self.outlier_mm, f64::INFINITY),
        ];
        for (option, value, most) in sizes {
            if !(0.0..=most).contains(&value) || !value.is_finite() {
                return Err(Failure::new(format!(
                    "{option} is {value}; it must be from 0 to {most}"
                )));
            }
        }
        let from = self
            .from
            .iter()
            .map(|t| Ok(numbers::<3>("--from", t)?.map(m_from_mm)));
        let from: Vec<[f64; 3]> = from.collect::<Result<_, Failure>>()?;
        if (self.kind == Kind::Distance) == from.is_empty() {
            return Err(Failure::new("--kind distance and --from belong together"));
        }
        Ok(Session {
            device: match self.kind {
                Kind::Position => Device::Position,
                Kind::Pose => Device::Pose,
                Kind::Distance => Device::Distance(from),
            },
            noise_m: m_from_mm(self.noise_mm),
            noise_rad: self.noise_deg * DEG,
            outliers: self.outliers,
            outlier_m: m_from_mm(self.outlier_mm),
            temperature_c: self
                .temperature_c
                .as_deref()
                .map(|t| numbers("--temperature-c", t))
                .transpose()?,
            interval_s: self.interval_s,
            seed: self.seed,
        })
    }

    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let session = self.session()?;
        files::refuse_over(
            [self.profile.as_path(), self.joints.as_path()],
            self.output.as_deref(),
        )?;
        let (profile, _) = files::read_profile(&self.profile)?;
        let tool = values::chosen_tool(self.tool.as_deref(), &profile)?;
        let table = Table::read(&self.joints)?;
        table.require(&JOINTS)?;
        let directions = DIRECTION_COLUMNS.iter().all(|c| table.has(c));
        let forces = FORCE_COLUMNS.iter().all(|c| table.has(c));
        let mut commands = Vec::new();
        for row in table.rows() {
            let mut conditions = Conditions::default();
            if directions {
                conditions.direction = row.numbers(DIRECTION_COLUMNS)?;
            }
            if forces {
                conditions.force_n = row.numbers(FORCE_COLUMNS)?;
            }
            commands.push(Command {
                q: row.numbers(JOINTS)?.map(|q| q * DEG),
                conditions: (directions || forces).then_some(conditions),
            });
        }
        let mut points: Vec<(Option<String>, [f64; 3])> = profile
            .points
            .iter()
            .map(|(name, p)| (Some(name.clone()), *p))
            .collect();
        if points.is_empty() {
            points.push((None, [0.0; 3]));
        }
        let rows = simulate(&profile, &tool, &points, &commands, &session);
        let text = csv(&rows, forces, profile.tools.contains_key(&tool.name));
        if let Some(path) = &self.output {
            files::write_all(&[(path.clone(), text.into_bytes())])?;
            if output.json {
                print_json(
                    &json!({"poseshift": "simulation/1", "rows": rows.len(), "output": path.display().to_string()}),
                )?;
            } else if !output.quiet {
                print(&format!(
                    "{} rows written to {}\n",
                    rows.len(),
                    path.display()
                ))?;
            }
        } else if output.json {
            print_json(&json!({"poseshift": "simulation/1", "rows": rows.len(), "csv": text}))?;
        } else {
            print(&text)?;
        }
        Ok(Answer::Yes)
    }
}

/// A file of measurements; every number is read back as it is.
fn csv(rows: &[Measurement], forces: bool, named_tool: bool) -> String {
    let Some(first) = rows.first() else {
        return format!("{}\n", JOINTS.join(","));
    };
    let mut header: Vec<&str> = vec!["id"];
    header.extend(JOINTS);
    match first.observed {
        Observed::Position(_) => header.extend(POSITION_COLUMNS),
        Observed::Pose(_) => header.extend(POSITION_COLUMNS.iter().chain(&QUATERNION_COLUMNS)),
        Observed::Distance { .. } => header.extend(DISTANCE_COLUMNS),
        Observed::Contact(_) => {}
    }
    header.extend(DIRECTION_COLUMNS);
    header.extend(FORCE_COLUMNS.iter().filter(|_| forces));
    let optional = [
        (named_tool, "tool"),
        (first.point.is_some(), "point"),
        (first.conditions.temperature_c.is_some(), "temperature_c"),
        (first.conditions.time_s.is_some(), "time_s"),
        (first.sigma_m.is_some(), "sigma_mm"),
    ];
    header.extend(
        optional
            .iter()
            .filter(|(there, _)| *there)
            .map(|(_, name)| *name),
    );
    let mut out = header.join(",") + "\n";
    let quoted = |text: &str| {
        if text.contains([',', '"', '\n']) {
            format!("\"{}\"", text.replace('"', "\"\""))
        } else {
            text.to_owned()
        }
    };
    for row in rows {
        let mut cells = vec![row.id.clone()];
        cells.extend(row.q.map(|q| cell(q / DEG)));
        match row.observed {
            Observed::Position(p) => cells.extend(p.map(|x| cell(mm_from_m(x)))),
            Observed::Pose(pose) => {
                cells.extend(pose.translation.map(|x| cell(mm_from_m(x))));
                cells.extend(pose.rotation.quaternion().0.map(cell));
            }
            Observed::Distance { distance_m, from_m } => {
                cells.push(cell(mm_from_m(distance_m)));
                cells.extend(from_m.map(|x| cell(mm_from_m(x))));
            }
            // no simulated device touches
            Observed::Contact(_) => {}
        }
        cells.extend(row.conditions.direction.map(cell));
        if forces {
            cells.extend(row.conditions.force_n.map(cell));
        }
        cells.extend(row.tool.as_deref().filter(|_| named_tool).map(quoted));
        cells.extend(row.point.as_deref().map(quoted));
        cells.extend(row.conditions.temperature_c.map(cell));
        cells.extend(row.conditions.time_s.map(cell));
        cells.extend(row.sigma_m.map(|s| cell(mm_from_m(s))));
        out += &(cells.join(",") + "\n");
    }
    out
}
