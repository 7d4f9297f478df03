//! `axes`: base and tool from sweeps of single joints.

use super::failure::Failure;
use super::layout::{aligned, print_text, row};
use super::page::ReportFile;
use super::registration::sigma_json;
use super::table::{JOINTS, POSE, Table};
use super::{Answer, Output, files, print, print_json};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Quaternion, norm};
use crate::register::axes::{Axis, Placed, Row, Sweep, axis, base, tool};
use crate::register::frame_file::Sigma;
use crate::report;
use crate::report::html::axes as page;
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;

/// Find base and tool frames from single-joint sweeps (circle fits)
#[derive(Args)]
#[command(
    after_help = "Sweeps: measurements (q1_deg…q6_deg, x_mm,y_mm,z_mm, optional qw,qx,qy,qz and dir1…dir6) with a column \
sweep, 1 to 6: the joint that moves in this row's sweep. Joints 1 and 2 give the base, 5 and 6 the tool."
)]
pub struct Axes {
    /// Measurements while one joint at a time moved
    #[arg(value_name = "SWEEPS.csv")]
    sweeps: PathBuf,
    /// Robot profile (YAML): the nominal arm
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Rows with this name in the column `point` only
    #[arg(long, value_name = "NAME")]
    point: Option<String>,
    #[command(flatten)]
    report: ReportFile,
}

const DIRECTIONS: [&str; 6] = ["dir1", "dir2", "dir3", "dir4", "dir5", "dir6"];

impl Axes {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        self.report
            .refuse_over([self.profile.as_path(), self.sweeps.as_path()], [])?;
        let (profile, _) = files::read_profile(&self.profile)?;
        let sweeps = self.read()?;
        let name = self.sweeps.display();
        let fail = |error: &dyn std::fmt::Display| Failure::new(format!("{name}: {error}"));
        let axes = sweeps
            .iter()
            .map(|sweep| axis(sweep, &profile).map_err(|error| fail(&error)))
            .collect::<Result<Vec<_>, _>>()?;
        let of = |joint: usize| sweeps.iter().find(|sweep| sweep.joint == joint);
        let placed_base = match (of(0), of(1)) {
            (Some(first), Some(second)) => {
                Some(base(first, second, &profile).map_err(|error| fail(&error))?)
            }
            _ => None,
        };
        let placed_tool = match (of(4), of(5)) {
            (Some(fifth), Some(sixth)) => {
                Some(tool(fifth, sixth, &profile).map_err(|error| fail(&error))?)
            }
            _ => None,
        };
        if self.report.is_wanted() {
            let drawn: Vec<_> = axes
                .iter()
                .zip(&sweeps)
                .map(|(axis, sweep)| page::Sweep {
                    joint: axis.joint + 1,
                    angle_rad: sweep.rows.iter().map(|row| row.q[sweep.joint]).collect(),
                    tangential_rad: axis.tangential_rad.clone(),
                    radial_m: axis.radial_m.clone(),
                    axial_m: axis.axial_m.clone(),
                    radius_m: axis.radius_m,
                    backlash_rad: axis.backlash_rad,
                })
                .collect();
            let pose = |placed: &Option<Placed>| placed.as_ref().map(|placed| placed.pose);
            let (base, tool) = (pose(&placed_base), pose(&placed_tool));
            let page = page::page(&drawn, base.as_ref(), tool.as_ref(), &name.to_string());
            files::write_all(self.report.output(Some(&page)).as_slice())?;
        }
        if output.json {
            let joints: Vec<Value> = axes.iter().map(joint_json).collect();
            print_json(&json!({
                "poseshift": "axes/1",
                "base": placed_base.as_ref().map(|p| report::pose(&p.pose)),
                "base_sigma": placed_base.as_ref().map(sigma),
                "tool": placed_tool.as_ref().map(|p| report::pose(&p.pose)),
                "tool_sigma": placed_tool.as_ref().map(sigma),
                "tool_oriented": placed_tool.as_ref().map(|p| p.oriented),
                "joints": joints,
            }))?;
        } else {
            print_text(&text(&axes, placed_base.as_ref(), placed_tool.as_ref()))?;
            print(&self.report.told())?;
        }
        Ok(Answer::Yes)
    }

    fn read(&self) -> Result<Vec<Sweep>, Failure> {
        let table = Table::read(&self.sweeps)?;
        table.require(&JOINTS)?;
        table.require(&POSE[..3])?;
        table.require(&["sweep"])?;
        let has_poses = POSE.iter().all(|c| table.has(c));
        let mut points = std::collections::BTreeSet::new();
        let mut sweeps: Vec<Sweep> = Vec::new();
        for row in table.rows() {
            let point = row.text("point").unwrap_or_default();
            if self.point.as_deref().is_some_and(|name| name != point) {
                continue;
            }
            points.insert(point.to_owned());
            let number = row.number("sweep")?;
            let joint = (1..=6_u8)
                .find(|j| f64::from(*j) == number)
                .map(|j| usize::from(j) - 1)
                .ok_or_else(|| {
                    row.failure(format!("sweep {number} is not a whole number from 1 to 6"))
                })?;
            let rotation = if has_poses {
                let q = Quaternion(row.numbers(["qw", "qx", "qy", "qz"])?);
                if (q.norm() - 1.0).abs() > 1e-3 {
                    return Err(row.failure(format!("the quaternion's length is {:.6}", q.norm())));
                }
                Some(q.normalized().rotation())
            } else {
                None
            };
            let direction = if table.has(DIRECTIONS[joint]) {
                row.number(DIRECTIONS[joint])?
            } else {
                0.0
            };
            let measured = Row {
                q: row.numbers(JOINTS)?.map(|q| q * DEG),
                point_m: row.numbers(["x_mm", "y_mm", "z_mm"])?.map(m_from_mm),
                rotation,
                direction,
            };
            match sweeps.iter_mut().find(|sweep| sweep.joint == joint) {
                Some(sweep) => sweep.rows.push(measured),
                None => sweeps.push(Sweep {
                    joint,
                    rows: vec![measured],
                }),
            }
        }
        if points.len() > 1 {
            let names: Vec<_> = points.into_iter().collect();
            return Err(Failure::with_hint(
                format!(
                    "{}: several measured points: {}",
                    self.sweeps.display(),
                    names.join(", ")
                ),
                "choose one with --point",
            ));
        }
        if sweeps.is_empty() {
            return Err(Failure::new(format!("{}: no rows", self.sweeps.display())));
        }
        sweeps.sort_by_key(|sweep| sweep.joint);
        Ok(sweeps)
    }
}

fn sigma(placed: &Placed) -> Value {
    sigma_json(&Sigma {
        position_m: placed.covariance.sigma_at_m(placed.covariance.centre_m),
        rotation_rad: placed.covariance.rotation_sigma_rad(),
    })
}

fn rms(values: &[f64]) -> f64 {
    #[allow(clippy::cast_precision_loss)]
    let mean = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
    mean.sqrt()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().map(|v| v.abs()).fold(0.0, f64::max)
}

fn joint_json(axis: &Axis) -> Value {
    let mm = |values: &[f64]| values.iter().map(|v| mm_from_m(*v)).collect::<Vec<_>>();
    json!({
        "joint": axis.joint + 1, "axis": axis.line.direction,
        "centre_mm": axis.line.point_m.map(mm_from_m), "radius_mm": mm_from_m(axis.radius_m),
        "tangential_deg": rms(&axis.tangential_rad) / DEG, "radial_mm": mm_from_m(rms(&axis.radial_m)),
        "axial_mm": mm_from_m(rms(&axis.axial_m)),
        "backlash_deg": axis.backlash_rad.map(|b| b.0 / DEG),
        "backlash_sigma_deg": axis.backlash_rad.map(|b| b.1 / DEG),
        "max_tangential_deg": largest(&axis.tangential_rad) / DEG,
        "max_radial_mm": mm_from_m(largest(&axis.radial_m)), "max_axial_mm": mm_from_m(largest(&axis.axial_m)),
        "rows": {"tangential_deg": axis.tangential_rad.iter().map(|t| t / DEG).collect::<Vec<_>>(),
                 "radial_mm": mm(&axis.radial_m), "axial_mm": mm(&axis.axial_m)},
        "noise_mm": mm_from_m(axis.noise_m),
    })
}

fn text(axes: &[Axis], base: Option<&Placed>, tool: Option<&Placed>) -> String {
    let ok = "a string takes all text";
    let mut rows = vec![
        row([
            "joint",
            "radius",
            "tangential",
            "",
            "radial",
            "",
            "axial",
            "",
            "backlash",
            "",
        ]),
        row([
            "", "mm", "rms mdeg", "max", "rms mm", "max", "rms mm", "max", "mdeg", "+/-",
        ]),
    ];
    for axis in axes {
        let mdeg = |angle: f64| format!("{:.2}", 1e3 * angle / DEG);
        let mm = |length: f64| format!("{:.4}", mm_from_m(length));
        let (backlash, sigma) = axis
            .backlash_rad
            .map_or(("-".to_owned(), "-".to_owned()), |b| (mdeg(b.0), mdeg(b.1)));
        rows.push(vec![
            (axis.joint + 1).to_string(),
            format!("{:.2}", mm_from_m(axis.radius_m)),
            mdeg(rms(&axis.tangential_rad)),
            mdeg(largest(&axis.tangential_rad)),
            mm(rms(&axis.radial_m)),
            mm(largest(&axis.radial_m)),
            mm(rms(&axis.axial_m)),
            mm(largest(&axis.axial_m)),
            backlash,
            sigma,
        ]);
    }
    let mut text = aligned(&rows);
    let entries = [
        ("base (world_from_base)", "1 and 2", base),
        ("tool (flange_from_tool)", "5 and 6", tool),
    ];
    for (what, joints, placed) in entries {
        let Some(placed) = placed else {
            writeln!(text, "{what}: needs the sweeps of joints {joints}").expect(ok);
            continue;
        };
        let [x, y, z, rx, ry, rz] = placed.pose.xyz_rxryrz();
        let [x, y, z] = [x, y, z].map(mm_from_m);
        // a zero has no sign
        let [rx, ry, rz] = [rx, ry, rz].map(|r| (r / DEG * 1e5).round() / 1e5 + 0.0);
        write!(
            text,
            "{what}\n  {{x_mm:\u{a0}{x:.4}, y_mm:\u{a0}{y:.4}, z_mm:\u{a0}{z:.4}, \
             rx_deg:\u{a0}{rx:.5}, ry_deg:\u{a0}{ry:.5}, rz_deg:\u{a0}{rz:.5}}}\n"
        )
        .expect(ok);
        let p = placed.covariance.sigma_at_m(placed.covariance.centre_m);
        let r = placed.covariance.rotation_sigma_rad().map(|r| r / DEG);
        let turn = if placed.oriented && norm(r) > 0.0 {
            format!("; {:.5} {:.5} {:.5} deg", r[0], r[1], r[2])
        } else if placed.oriented {
            String::new()
        } else {
            "; orientation not measured, the flange's is told".to_owned()
        };
        let p = p.map(mm_from_m);
        writeln!(text, "  sigma {:.4} {:.4} {:.4} mm{turn}", p[0], p[1], p[2]).expect(ok);
    }
    text
}
