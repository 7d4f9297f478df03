//! `ik`: poses of the tool to joint angles.

use super::Document;
use super::circumstances::Circumstances;
use super::failure::Failure;
use super::fk::{Options, Which};
use super::profile_file::ProfileFile;
use super::table::{JOINTS, POSE, Row, Table, cell, pose, text_cell};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::inverse::{Arm, Branch, Inverse, Outcome, Status};
use crate::model::external::Stand;
use crate::model::profile::{Mounted, Profile};
use crate::model::{Conditions, Model};
use crate::program::Source;
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

const NEAR: [&str; 6] = [
    "near1_deg",
    "near2_deg",
    "near3_deg",
    "near4_deg",
    "near5_deg",
    "near6_deg",
];

/// Joint angles for a pose.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Solution {
    /// The row's id, or its number from 1.
    pub id: String,
    /// The branch: 4 behind axis 1, 2 behind the lower arm, 1 joint 5 negative, added.
    pub solution: usize,
    /// Which of the answers on the branch, from 0, where it may hold several: arms with an offset
    /// wrist.
    pub root: Option<u8>,
    /// The controller's joint angles.
    pub joints_deg: [f64; 6],
    /// Distance of the pose attained from the one asked for.
    pub residual_mm: f64,
    /// Their angle.
    pub residual_deg: f64,
    /// Steps of the search.
    pub iterations: u32,
    /// `converged`, or why not.
    pub status: &'static str,
}

/// Joint angles for poses.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Solutions {
    /// One a row, or one a branch of each row.
    pub solutions: Vec<Solution>,
    /// Whether every one was reached; of all branches, any.
    #[serde(skip)]
    pub reached: bool,
}

impl Document for Solutions {
    const KIND: &'static str = "solutions/1";
}

/// Joint angles for each row of poses: on the branch of its columns, or with `all` on every one.
/// Directions, moves, forces, temperature, time and the places of a track are used as in
/// [`fk`](super::fk::fk).
///
/// # Errors
/// A table that names no branch; an arm without an inverse; a track beyond its limits.
pub fn ik(
    file: &ProfileFile,
    poses: &Source,
    options: &Options,
    all: bool,
) -> Result<Solutions, Failure> {
    ik_telling(file, poses, options, all, &mut |_, _| ())
}

/// As [`ik`]; `tell` hears how many of how many rows are done.
///
/// # Errors
/// As [`ik`].
pub fn ik_telling(
    file: &ProfileFile,
    poses: &Source,
    options: &Options,
    all: bool,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Solutions, Failure> {
    let profile = &file.profile;
    let tool = file.tool(options.tool.as_deref())?;
    let table = Table::read(poses)?;
    table.require(&POSE)?;
    let has_near = table.group(&NEAR)?;
    if !all && !has_near && !table.group(&["branch"])? {
        let hint = "branch is a number from 0 to 7: 4 behind axis 1, 2 behind the lower arm, 1 \
            joint 5 negative";
        return Err(Failure::with_hint(
            "the table has neither a column branch nor near1_deg…near6_deg; or ask for --all",
            hint,
        ));
    }
    let circumstances = Circumstances::of(&table, profile)?;
    let at_home = inverse(profile, &tool, options.model, Conditions::default())?;
    let (mut solutions, mut found) = (Vec::new(), 0);
    for (number, row) in table.rows_telling(tell).enumerate() {
        let wanted = pose(&row)?;
        let own = if circumstances.is_none() {
            None
        } else {
            let (conditions, stand) = (circumstances.conditions(&row)?, circumstances.stand(&row)?);
            let own = inverse_at(profile, &tool, options.model, conditions, &stand)?;
            Some(own)
        };
        let inverse = own.as_ref().unwrap_or(&at_home);
        let near = if has_near {
            row.numbers(NEAR)?.map(|q| q * DEG)
        } else {
            middle(profile)
        };
        let mut put = |branch, root, outcome: &Outcome| {
            found += usize::from(outcome.status == Status::Converged);
            solutions.push(solution(row.id(number + 1), branch, root, outcome));
        };
        if !all && !table.has("branch") {
            let (branch, outcome) = nearest(inverse, &wanted, &near);
            put(branch, None, &outcome);
            continue;
        }
        let mut add = |branch, root, near: &[f64; 6]| {
            put(branch, root, &within_limits(inverse, &wanted, branch, near));
        };
        if all && inverse.arm.has_offset_wrist() {
            // the real arm's answer is sought from the nominal one
            for answer in inverse.arm.solve_all(&wanted, &near) {
                add(answer.branch, Some(answer.root), &answer.q);
            }
        } else {
            let branches = if all {
                Branch::ALL.to_vec()
            } else {
                vec![branch(&row)?]
            };
            for branch in branches {
                add(branch, None, &near);
            }
        }
    }
    table.refuse_misspelt()?;
    // of all branches some are usually beyond reach
    let reached = if all {
        found > 0 || table.rows().next().is_none()
    } else {
        found == solutions.len()
    };
    Ok(Solutions { solutions, reached })
}

/// The solution on a branch, by whole rotations nearest to joints that are given, within the limits
/// where another whole rotation is.
fn within_limits(inverse: &Inverse, wanted: &Pose, branch: Branch, near: &[f64; 6]) -> Outcome {
    let outcome = inverse.solve(wanted, branch, near);
    if !matches!(outcome.status, Status::JointLimit(_)) {
        return outcome;
    }
    let joints = &inverse.arm.mechanism().joints;
    let other: [f64; 6] = std::array::from_fn(|i| {
        let (q, joint) = (outcome.q[i], &joints[i]);
        let all = [q, q - TAU, q + TAU].into_iter();
        let mut within = all.filter(|q| (joint.min_rad..=joint.max_rad).contains(q));
        within.next().unwrap_or(q)
    });
    let again = inverse.solve(wanted, branch, &other);
    if again.status == Status::Converged {
        again
    } else {
        outcome
    }
}

/// The solution nearest to joints that are given, whatever its branch.
fn nearest(inverse: &Inverse, wanted: &Pose, near: &[f64; 6]) -> (Branch, Outcome) {
    let arm = &inverse.arm;
    let own = arm.posture(near).0;
    let of = |asked: Branch| {
        let outcome = within_limits(inverse, wanted, asked, near);
        let is_elsewhere = outcome.status == Status::BranchLost
            && arm.mechanism().beyond_limit(&outcome.q, 0.0).is_none();
        if is_elsewhere {
            let status = Status::Converged;
            return (arm.posture(&outcome.q).0, Outcome { status, ..outcome });
        }
        (asked, outcome)
    };
    let apart = |outcome: &Outcome| {
        let apart = outcome.q.iter().zip(near).map(|(q, near)| (q - near).abs());
        apart.fold(0.0, f64::max)
    };
    let others = Branch::ALL.into_iter().filter(|branch| *branch != own);
    let reached = std::iter::once(own).chain(others).map(of);
    let reached = reached.filter(|(_, outcome)| outcome.status == Status::Converged);
    let nearest = reached.min_by(|a, b| apart(&a.1).total_cmp(&apart(&b.1)));
    nearest.unwrap_or_else(|| (own, within_limits(inverse, wanted, own, near)))
}

fn branch(row: &Row) -> Result<Branch, Failure> {
    let number = row.number("branch")?;
    Branch::ALL
        .into_iter()
        .find(|b| f64::from(b.number()) == number)
        .ok_or_else(|| row.failure(format!("branch {number} is not a whole number from 0 to 7")))
}

fn solution(id: String, branch: Branch, root: Option<u8>, outcome: &Outcome) -> Solution {
    Solution {
        id,
        solution: usize::from(branch.number()),
        root,
        joints_deg: outcome.q.map(|q| q / DEG),
        residual_mm: mm_from_m(outcome.residual.distance_m),
        residual_deg: outcome.residual.angle_rad / DEG,
        iterations: outcome.iterations,
        status: outcome.status.id(),
    }
}

/// The inverse of a profile's arm with a tool.
///
/// # Errors
/// An arm without an inverse.
pub fn inverse(
    profile: &Profile,
    tool: &Mounted,
    which: Which,
    conditions: Conditions,
) -> Result<Inverse, Failure> {
    inverse_at(profile, tool, which, conditions, &Stand::default())
}

/// The same where a track stands so.
fn inverse_at(
    profile: &Profile,
    tool: &Mounted,
    which: Which,
    conditions: Conditions,
    stand: &Stand,
) -> Result<Inverse, Failure> {
    let mut geometry = profile.geometry(tool);
    let carried = profile.external.base_nominal(&stand.values);
    geometry.world_from_base = carried * geometry.world_from_base;
    let arm =
        Arm::of(&geometry, &profile.mechanism).map_err(|error| Failure::new(error.to_string()))?;
    let real = match which {
        Which::Real => profile.real_model_at(tool, &conditions, stand),
        Which::Controller => Model::build(
            &geometry,
            &profile.mechanism,
            &profile.controller_effects(),
            &Conditions::default(),
        ),
    };
    Ok(Inverse {
        arm,
        real,
        conditions,
    })
}

/// Zero, or the end of a joint's range that is nearest to it.
#[must_use]
pub fn middle(profile: &Profile) -> [f64; 6] {
    profile
        .mechanism
        .joints
        .map(|joint| 0.0_f64.clamp(joint.min_rad, joint.max_rad))
}

impl Solutions {
    /// The table of joints.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = format!(
            "id,solution,{},residual_mm,residual_deg,iterations,status\n",
            JOINTS.join(",")
        );
        for s in &self.solutions {
            let numbers: Vec<String> = s
                .joints_deg
                .into_iter()
                .chain([s.residual_mm, s.residual_deg])
                .map(cell)
                .collect();
            let root = s.root.map_or_else(String::new, |root| format!("/{root}"));
            text += &format!(
                "{},{}{root},{},{},{}\n",
                text_cell(&s.id),
                s.solution,
                numbers.join(","),
                s.iterations,
                s.status
            );
        }
        text
    }
}
