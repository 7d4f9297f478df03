//! `fk`: joint angles to poses of the tool.

use super::Document;
use super::circumstances::{Circumstances, Track};
use super::failure::Failure;
use super::parts::Pose;
use super::profile_file::ProfileFile;
use super::table::{JOINTS, POSE, Table, cell, text_cell};
use crate::finding::{Finding, Severity};
use crate::geometry::units::DEG;
use crate::model::{Conditions, Mechanism};
use crate::program::Source;
use schemars::JsonSchema;
use serde::Serialize;

/// Which arm is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Which {
    /// Nominal kinematics with every effect of the calibration.
    #[default]
    Real,
    /// What the controller computes with.
    Controller,
}

/// Whose arm, and with which tool.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Which arm.
    pub model: Which,
    /// Tool of the profile; `None` is its only one.
    pub tool: Option<String>,
}

/// A pose of the tool in the world.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ToolPose {
    /// The pose.
    #[serde(flatten)]
    pub pose: Pose,
    /// The row's id, or its number from 1.
    pub id: String,
}

/// Poses of the tool.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Poses {
    /// One a row.
    pub poses: Vec<ToolPose>,
    /// What should be looked at.
    pub findings: Vec<Finding>,
}

impl Document for Poses {
    const KIND: &'static str = "poses/1";
}

/// A joint so far beyond its limits stands there in no file of this robot: angles of another robot,
/// another unit or another order of columns.
const BEYOND_RAD: f64 = 5.0 * DEG;

/// Rows of joint angles that the robot cannot have.
#[derive(Default)]
pub(super) struct BeyondLimits {
    rows: usize,
    /// Line, joint, angle.
    first: Option<(usize, usize, f64)>,
}

impl BeyondLimits {
    /// Looks at one more row.
    pub(super) fn look(&mut self, mechanism: &Mechanism, line: usize, q: &[f64; 6]) {
        if let Some(joint) = mechanism.beyond_limit(q, BEYOND_RAD) {
            self.rows += 1;
            self.first.get_or_insert((line, joint, q[joint]));
        }
    }

    /// What is said of them.
    pub(super) fn findings(&self, mechanism: &Mechanism, name: &str) -> Vec<Finding> {
        let Some((line, joint, q)) = self.first else {
            return Vec::new();
        };
        let limits = &mechanism.joints[joint];
        let message = format!(
            "joint {} stands at {:.3} deg, its limits are {:.3} and {:.3} deg; rows beyond limits: {}",
            joint + 1,
            q / DEG,
            limits.min_rad / DEG,
            limits.max_rad / DEG,
            self.rows
        );
        let finding = Finding::of_file("beyond-limit", Severity::Warning, name, message);
        vec![Finding {
            line,
            column: 1,
            ..finding.hint(
                "check the order and the unit of the joint columns, and the limits in the profile",
            )
        }]
    }
}

/// The tool's pose for each row of joint angles; directions, moves, forces, temperature, time and the
/// places of a track are used where the table has them: without these the base stands at home.
///
/// # Errors
/// A table without joints, or with some of the columns of directions or forces only; a tool that
/// the profile does not have; a track beyond its limits.
pub fn fk(profile: &ProfileFile, joints: &Source, options: &Options) -> Result<Poses, Failure> {
    fk_telling(profile, joints, options, &mut |_, _| ())
}

/// As [`fk`]; `tell` hears how many of how many rows are done.
///
/// # Errors
/// As [`fk`].
pub fn fk_telling(
    profile: &ProfileFile,
    joints: &Source,
    options: &Options,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Poses, Failure> {
    let tool = profile.tool(options.tool.as_deref())?;
    let table = Table::read(joints)?;
    table.require(&JOINTS)?;
    let is_real = options.model == Which::Real;
    let model = if is_real {
        profile.profile.real_model(&tool, &Conditions::default())
    } else {
        profile.profile.controller_model(&tool)
    };
    let profile = &profile.profile;
    let track = Track::of(&table, profile)?;
    // the controller's model knows nothing else of a row
    let circumstances = if is_real {
        Some(Circumstances::of(&table, profile)?)
    } else {
        Circumstances::pass_over(&table);
        None
    };
    let mut beyond = BeyondLimits::default();
    let pose = |(number, row): (usize, super::table::Row)| {
        let q = row.joints()?;
        beyond.look(&profile.mechanism, row.line, &q);
        let stand = track.stand(&row)?;
        let pose = if let Some(circumstances) = &circumstances {
            let conditions = circumstances.conditions(&row)?;
            let own = circumstances
                .is_of_chain()
                .then(|| profile.real_model_at(&tool, &conditions, &stand));
            own.as_ref().unwrap_or(&model).forward(&q, &conditions)
        } else {
            let carried = profile.external.base_nominal(&stand.values);
            carried * model.forward(&q, &Conditions::default())
        };
        if !pose.translation.iter().all(|x| x.is_finite()) {
            let message =
                "the tool has no finite pose here: a value of the profile is beyond any arm";
            return Err(row.failure(message.into()));
        }
        Ok(ToolPose {
            pose: (&pose).into(),
            id: row.id(number + 1),
        })
    };
    let poses = table.rows_telling(tell).enumerate().map(pose);
    let poses = poses.collect::<Result<_, Failure>>()?;
    table.refuse_misspelt()?;
    Ok(Poses {
        poses,
        findings: beyond.findings(&profile.mechanism, &joints.name),
    })
}

impl Poses {
    /// The table of poses.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = format!("id,{}\n", POSE.join(","));
        for ToolPose { id, pose } in &self.poses {
            let cells: Vec<_> = pose
                .xyz_mm()
                .iter()
                .chain(&pose.quaternion)
                .map(|v| cell(*v))
                .collect();
            text += &format!("{},{}\n", text_cell(id), cells.join(","));
        }
        text
    }
}
