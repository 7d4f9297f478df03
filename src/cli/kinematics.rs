//! `fk` and `ik`: the models themselves, over tables.

use super::failure::Failure;
use super::table::{JOINTS, POSE, Table, cell};
use super::{Answer, Output, files, print, print_json, values};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Quaternion};
use crate::inverse::{Arm, Branch, Inverse, Status};
use crate::model::Conditions;
use crate::model::profile::{Mounted, Profile};
use clap::{Args, ValueEnum};
use serde_json::json;
use std::path::PathBuf;

/// How far a quaternion of a table may be from length 1.
const UNIT_TOLERANCE: f64 = 1e-3;

/// Which arm is meant
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Which {
    /// Nominal kinematics with every effect of the calibration
    Real,
    /// What the controller computes with
    Controller,
}

/// Print the tool's poses for joint angles
#[derive(Args)]
pub struct Fk {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Joint angles (CSV with `q1_deg…q6_deg`, optional dir1…dir6 and `fx_n,fy_n,fz_n`)
    #[arg(long, value_name = "FILE")]
    joints: PathBuf,
    /// Which arm
    #[arg(long, value_enum, default_value = "real")]
    model: Which,
    /// Tool of the profile (default: its only one)
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
}

/// Print the joint angles for poses of the tool
#[derive(Args)]
pub struct Ik {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Poses (CSV with `x_mm,y_mm,z_mm,qw,qx,qy,qz` and branch, 0 to 7, or `near1_deg…near6_deg`)
    #[arg(long, value_name = "FILE")]
    poses: PathBuf,
    /// Which arm
    #[arg(long, value_enum, default_value = "real")]
    model: Which,
    /// Tool of the profile (default: its only one)
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
    /// Every solution: one a branch, or as many as there are with an offset wrist (`branch/number`)
    #[arg(long)]
    all: bool,
}

const DIRECTIONS: [&str; 6] = ["dir1", "dir2", "dir3", "dir4", "dir5", "dir6"];
const FORCES: [&str; 3] = ["fx_n", "fy_n", "fz_n"];
const NEAR: [&str; 6] = [
    "near1_deg",
    "near2_deg",
    "near3_deg",
    "near4_deg",
    "near5_deg",
    "near6_deg",
];

impl Fk {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let (profile, _) = files::read_profile(&self.profile)?;
        let tool = values::chosen_tool(self.tool.as_deref(), &profile)?;
        let table = Table::read(&self.joints)?;
        table.require(&JOINTS)?;
        let model = match self.model {
            Which::Real => profile.real_model(&tool, &Conditions::default()),
            Which::Controller => profile.controller_model(&tool),
        };
        let mut poses = Vec::new();
        for (number, row) in table.rows().enumerate() {
            let q = row.numbers(JOINTS)?.map(|q| q * DEG);
            let mut conditions = Conditions::default();
            if self.model == Which::Real && DIRECTIONS.iter().all(|c| table.has(c)) {
                conditions.direction = row.numbers(DIRECTIONS)?;
            }
            if self.model == Which::Real && FORCES.iter().all(|c| table.has(c)) {
                conditions.force_n = row.numbers(FORCES)?;
            }
            poses.push((row.id(number + 1), model.forward(&q, &conditions)));
        }
        if output.json {
            let rows: Vec<_> = poses
                .iter()
                .map(|(id, pose)| {
                    let mut row = crate::report::pose(pose);
                    row["id"] = json!(id);
                    row
                })
                .collect();
            print_json(&json!({"poseshift": "poses/1", "poses": rows}))?;
        } else {
            let mut text = format!("id,{}\n", POSE.join(","));
            for (id, pose) in &poses {
                let t = pose.translation.map(mm_from_m);
                let q = pose.rotation.quaternion().0;
                let cells: Vec<_> = t.iter().chain(&q).map(|v| cell(*v)).collect();
                text.push_str(&format!("{id},{}\n", cells.join(",")));
            }
            print(&text)?;
        }
        Ok(Answer::Yes)
    }
}

struct Solved {
    id: String,
    branch: u8,
    /// Which of the answers on the branch, where it may hold several.
    root: Option<u8>,
    outcome: crate::inverse::Outcome,
}

impl Ik {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let (profile, _) = files::read_profile(&self.profile)?;
        let tool = values::chosen_tool(self.tool.as_deref(), &profile)?;
        let table = Table::read(&self.poses)?;
        table.require(&POSE)?;
        let has_near = NEAR.iter().all(|c| table.has(c));
        if !self.all && !has_near && !table.has("branch") {
            let hint = "branch is a number from 0 to 7: 4 behind axis 1, 2 behind the lower arm, 1 joint 5 negative";
            return Err(Failure::with_hint(
                "the table has neither a column branch nor near1_deg…near6_deg; or ask for --all",
                hint,
            ));
        }
        let inverse = self.inverse(&profile, &tool)?;
        let mut solved = Vec::new();
        for (number, row) in table.rows().enumerate() {
            let [x, y, z, w, i, j, k] = row.numbers(POSE)?;
            let quaternion = Quaternion([w, i, j, k]);
            let norm = quaternion.norm();
            if (norm - 1.0).abs() > UNIT_TOLERANCE {
                return Err(row.failure(format!(
                    "the quaternion's length is {norm:.6}; it may differ from 1 by {UNIT_TOLERANCE}"
                )));
            }
            let wanted = Pose::from_parts([x, y, z].map(m_from_mm), quaternion.normalized());
            let near = if has_near {
                row.numbers(NEAR)?.map(|q| q * DEG)
            } else {
                middle(&profile)
            };
            if self.all && inverse.arm.has_offset_wrist() {
                // the real arm's answer is sought from the nominal one
                for answer in inverse.arm.solve_all(&wanted, &near) {
                    solved.push(Solved {
                        id: row.id(number + 1),
                        branch: answer.branch.number(),
                        root: Some(answer.root),
                        outcome: inverse.solve(&wanted, answer.branch, &answer.q),
                    });
                }
                continue;
            }
            let branches = if self.all {
                Branch::ALL.to_vec()
            } else if table.has("branch") {
                let number = row.number("branch")?;
                let branch = Branch::ALL
                    .into_iter()
                    .find(|b| f64::from(b.number()) == number);
                vec![branch.ok_or_else(|| {
                    row.failure(format!("branch {number} is not a whole number from 0 to 7"))
                })?]
            } else {
                vec![inverse.arm.posture(&near).0]
            };
            for branch in branches {
                let outcome = inverse.solve(&wanted, branch, &near);
                solved.push(Solved {
                    id: row.id(number + 1),
                    branch: branch.number(),
                    root: None,
                    outcome,
                });
            }
        }
        let reached = solved.iter().all(|s| s.outcome.status == Status::Converged);
        print_solutions(&solved, output)?;
        Ok(if reached || self.all {
            Answer::Yes
        } else {
            Answer::No
        })
    }

    fn inverse(&self, profile: &Profile, tool: &Mounted) -> Result<Inverse, Failure> {
        let arm = Arm::of(&profile.geometry(tool), &profile.mechanism)
            .map_err(|error| Failure::new(error.to_string()))?;
        let conditions = Conditions::default();
        let real = match self.model {
            Which::Real => profile.real_model(tool, &conditions),
            Which::Controller => profile.controller_model(tool),
        };
        Ok(Inverse {
            arm,
            real,
            conditions,
        })
    }
}

/// Zero, or the end of a joint's range that is nearest to it.
fn middle(profile: &Profile) -> [f64; 6] {
    profile
        .mechanism
        .joints
        .map(|joint| 0.0_f64.clamp(joint.min_rad, joint.max_rad))
}

fn print_solutions(solved: &[Solved], output: Output) -> Result<(), Failure> {
    if output.json {
        let rows: Vec<_> = solved
            .iter()
            .map(|s| {
                json!({
                    "id": s.id, "solution": s.branch, "root": s.root, "joints_deg": s.outcome.q.map(|q| q / DEG),
                    "residual_mm": mm_from_m(s.outcome.residual.distance_m), "residual_deg": s.outcome.residual.angle_rad / DEG,
                    "iterations": s.outcome.iterations, "status": s.outcome.status.id(),
                })
            })
            .collect();
        return print_json(&json!({"poseshift": "solutions/1", "solutions": rows}));
    }
    let mut text = format!(
        "id,solution,{},residual_mm,residual_deg,iterations,status\n",
        JOINTS.join(",")
    );
    for s in solved {
        let numbers = s
            .outcome
            .q
            .iter()
            .map(|q| cell(q / DEG))
            .collect::<Vec<_>>()
            .join(",");
        let residual = [
            mm_from_m(s.outcome.residual.distance_m),
            s.outcome.residual.angle_rad / DEG,
        ]
        .map(cell)
        .join(",");
        let root = s.root.map_or_else(String::new, |root| format!("/{root}"));
        text.push_str(&format!(
            "{},{}{root},{numbers},{residual},{},{}\n",
            s.id,
            s.branch,
            s.outcome.iterations,
            s.outcome.status.id()
        ));
    }
    print(&text)
}
