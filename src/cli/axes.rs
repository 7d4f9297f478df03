//! `axes`: base and tool from sweeps of single joints.

use super::failure::Failure;
use super::layout::{aligned, print_text, row};
use super::measurements::{identify_failure, tell_findings};
use super::page::ReportFile;
use super::registration::sigma_json;
use super::table::{JOINTS, POSE, Table};
use super::{Answer, Output, files, print, print_json};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Quaternion, norm};
use crate::identify::doubt::sweeps::{doubt, point_on_flange};
use crate::model::profile::{Mounted, Profile};
use crate::register::axes::outliers::without_outliers;
use crate::register::axes::sag::{Arm, Frame, Sag, sag};
use crate::register::axes::{AxesError, Axis, Placed, Row, Sweep, axis, base, tool};
use crate::register::frame_file::Sigma;
use crate::register::uncertainty::PoseCovariance;
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
        let name = self.sweeps.display();
        let fail = |error: &AxesError| Failure::new(format!("{name}: {error}"));
        let mut findings = Vec::new();
        let mut sweeps = Vec::new();
        for (sweep, lines) in self.read()? {
            let (kept, outliers) =
                without_outliers(&sweep, &profile).map_err(|error| fail(&error))?;
            sweeps.push(kept);
            findings.extend(outliers.iter().map(|outlier| Finding {
                id: "outlier",
                severity: Severity::Warning,
                file: name.to_string(),
                line: lines[outlier.row],
                column: 1,
                message: format!(
                    "left out: {:.3} mm from where the other rows of joint {}'s sweep have it; they are off by {:.4} mm (rms)",
                    mm_from_m(outlier.off_m),
                    sweep.joint + 1,
                    mm_from_m(outlier.others_m)
                ),
                hint: "measure it again".into(),
            }));
        }
        let axes = sweeps
            .iter()
            .map(|sweep| axis(sweep, &profile).map_err(|error| fail(&error)))
            .collect::<Result<Vec<_>, _>>()?;
        let of = |joint: usize| sweeps.iter().find(|sweep| sweep.joint == joint);
        let mut found = Frames::default();
        if let (Some(first), Some(second)) = (of(0), of(1)) {
            found.base = Some(base(first, second, &profile).map_err(|error| fail(&error))?);
        }
        if let (Some(fifth), Some(sixth)) = (of(4), of(5)) {
            found.tool = Some(tool(fifth, sixth, &profile).map_err(|error| fail(&error))?);
        }
        let pose = |placed: &Option<Placed>| placed.as_ref().map(|placed| placed.pose);
        let (base_pose, tool_pose) = (pose(&found.base), pose(&found.tool));
        let remarks = doubt(
            &profile,
            &sweeps,
            &axes,
            base_pose.as_ref(),
            tool_pose.as_ref(),
        )
        .map_err(|error| identify_failure(&name.to_string(), &error))?;
        findings.extend(report::identification::findings(
            &remarks,
            &name.to_string(),
        ));
        found
            .add_sag(&sweeps, &profile)
            .map_err(|error| fail(&error))?;
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
            let page = page::page(&drawn, &found.drawn(), &name.to_string(), &findings);
            files::write_all(self.report.output(Some(&page)).as_slice())?;
        }
        if output.json {
            let joints: Vec<Value> = axes.iter().map(joint_json).collect();
            print_json(&json!({
                "poseshift": "axes/1",
                "base": base_pose.as_ref().map(report::pose),
                "base_sigma": sigma(found.base.as_ref(), found.base_sag.as_ref()),
                "base_sag": found.base_sag.as_ref().map(sag_json),
                "tool": tool_pose.as_ref().map(report::pose),
                "tool_sigma": sigma(found.tool.as_ref(), found.tool_sag.as_ref()),
                "tool_sag": found.tool_sag.as_ref().map(sag_json),
                "tool_oriented": found.tool.as_ref().map(|p| p.oriented),
                "joints": joints,
                "findings": findings,
            }))?;
        } else {
            tell_findings(&findings, output);
            if !output.quiet {
                print_text(&text(&axes, &found))?;
                print(&self.report.told())?;
            }
        }
        Ok(Answer::Yes)
    }

    /// The sweeps by joint, and the lines of their rows.
    fn read(&self) -> Result<Vec<(Sweep, Vec<usize>)>, Failure> {
        let table = Table::read(&self.sweeps)?;
        table.require(&JOINTS)?;
        table.require(&POSE[..3])?;
        table.require(&["sweep"])?;
        let has_poses = POSE.iter().all(|c| table.has(c));
        let mut points = std::collections::BTreeSet::new();
        let mut sweeps: Vec<(Sweep, Vec<usize>)> = Vec::new();
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
            let known = sweeps.iter_mut().find(|(sweep, _)| sweep.joint == joint);
            if let Some((sweep, lines)) = known {
                sweep.rows.push(measured);
                lines.push(row.line);
            } else {
                let rows = vec![measured];
                sweeps.push((Sweep { joint, rows }, vec![row.line]));
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
        sweeps.sort_by_key(|(sweep, _)| sweep.joint);
        Ok(sweeps)
    }
}

/// The frames, and what the arm's sag is worth in each.
#[derive(Default)]
struct Frames {
    base: Option<Placed>,
    base_sag: Option<Sag>,
    tool: Option<Placed>,
    tool_sag: Option<Sag>,
}

impl Frames {
    fn add_sag(&mut self, sweeps: &[Sweep], profile: &Profile) -> Result<(), AxesError> {
        let world_from_base = self
            .base
            .as_ref()
            .map_or(profile.world_from_base, |base| base.pose);
        let mut tools = profile.tools.keys();
        let only = tools.next().filter(|_| tools.next().is_none());
        let mounted = only.and_then(|name| profile.tool(name));
        let mounted = mounted.unwrap_or_else(Mounted::flange);
        let arm = Arm {
            world_from_base,
            mounted: &mounted,
            point_m: self.tool.as_ref().map_or_else(
                || point_on_flange(profile, sweeps, &world_from_base),
                |tool| tool.pose.translation,
            ),
        };
        let pair = |joints: [usize; 2]| -> Option<[&Sweep; 2]> {
            let of = |joint: usize| sweeps.iter().find(|sweep| sweep.joint == joint);
            Some([of(joints[0])?, of(joints[1])?])
        };
        if let (Some(base), Some(pair)) = (&self.base, pair([0, 1])) {
            self.base_sag = sag(Frame::Base, pair, base, profile, &arm)?;
        }
        if let (Some(tool), Some(pair)) = (&self.tool, pair([5, 4])) {
            self.tool_sag = sag(Frame::Tool, pair, tool, profile, &arm)?;
        }
        Ok(())
    }

    /// Base and tool for the page.
    fn drawn(&self) -> [page::Frame; 2] {
        let frame = |name, joints, placed: Option<&Placed>, sag: Option<&Sag>| {
            let of = |covariance: &PoseCovariance| placed.map(|p| deviations(p, covariance));
            let whole = placed.and_then(|placed| whole(placed, sag));
            page::Frame {
                name,
                joints,
                pose: placed.map(|placed| placed.pose),
                sigma: whole
                    .and_then(|w| of(&w))
                    .unwrap_or_else(|| NO_NOISE.into()),
                sag: sag.and_then(|sag| of(&sag.covariance)),
            }
        };
        let (base, tool) = (self.base.as_ref(), self.tool.as_ref());
        [
            frame("world from base", "1 and 2", base, self.base_sag.as_ref()),
            frame("flange from tool", "5 and 6", tool, self.tool_sag.as_ref()),
        ]
    }
}

/// What is said of the noise where it is not known.
const NO_NOISE: &str = "not known: three rows a sweep leave nothing to tell the noise by";

/// Standard deviations of a frame.
fn deviations(placed: &Placed, covariance: &PoseCovariance) -> String {
    let sigma = as_sigma(covariance);
    let [x, y, z] = sigma.position_m.map(mm_from_m);
    let [rx, ry, rz] = sigma.rotation_rad.map(|r| r / DEG);
    let turn = if placed.oriented && norm([rx, ry, rz]) > 0.0 {
        format!("; {rx:.5} {ry:.5} {rz:.5} deg")
    } else {
        String::new()
    };
    format!("{x:.4} {y:.4} {z:.4} mm{turn}")
}

/// Noise and sag together; `None` where the noise is not known.
fn whole(placed: &Placed, sag: Option<&Sag>) -> Option<PoseCovariance> {
    let noise = placed.covariance?;
    Some(sag.map_or(noise, |sag| noise.and(&sag.covariance)))
}

fn as_sigma(covariance: &PoseCovariance) -> Sigma {
    Sigma {
        position_m: covariance.sigma_at_m(covariance.centre_m),
        rotation_rad: covariance.rotation_sigma_rad(),
    }
}

fn sigma(placed: Option<&Placed>, sag: Option<&Sag>) -> Option<Value> {
    Some(sigma_json(&as_sigma(&whole(placed?, sag)?)))
}

fn sag_json(sag: &Sag) -> Value {
    let mut value = sigma_json(&as_sigma(&sag.covariance));
    value["from"] = json!(if sag.typical { "typical" } else { "profile" });
    value
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
        "noise_mm": axis.noise_m.map(mm_from_m),
    })
}

fn text(axes: &[Axis], found: &Frames) -> String {
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
        (
            "base (world_from_base)",
            "1 and 2",
            &found.base,
            &found.base_sag,
        ),
        (
            "tool (flange_from_tool)",
            "5 and 6",
            &found.tool,
            &found.tool_sag,
        ),
    ];
    for (what, joints, placed, sag) in entries {
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
        match whole(placed, sag.as_ref()) {
            Some(covariance) => writeln!(text, "  sigma {}", deviations(placed, &covariance)),
            None => writeln!(text, "  sigma {NO_NOISE}"),
        }
        .expect(ok);
        if let Some(sag) = sag {
            let whose = if sag.typical {
                "as much as an arm of typical stiffness"
            } else {
                "by the profile's compliance"
            };
            let share = if placed.covariance.is_some() {
                "of it sag"
            } else {
                "sag alone"
            };
            writeln!(
                text,
                "  {share} under gravity, {whose}: {}",
                deviations(placed, &sag.covariance)
            )
            .expect(ok);
        } else {
            writeln!(
                text,
                "  sag under gravity is not in it: the profile has no masses"
            )
            .expect(ok);
        }
        if !placed.oriented {
            writeln!(text, "  orientation not measured, the flange's is told").expect(ok);
        }
    }
    text
}
