//! Which tool and which work frame a target has.

use super::Job;
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::model::profile::Mounted;
use crate::program::Shape;
use std::collections::BTreeMap;

/// Two values of one tool or frame that differ by less than this are the same, metres and radians.
const SAME: f64 = 1e-9;

/// Tools and work frames that the user gives, by name in the program or, under `None`, for every name that is unknown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given {
    /// Tools.
    pub tools: BTreeMap<Option<String>, Mounted>,
    /// `world_from_frame` of work frames.
    pub frames: BTreeMap<Option<String>, Pose>,
}

/// A tool or frame that nobody knows.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}:{column}: {}", self.message())]
pub struct PlacementError {
    /// The file of a move that uses it.
    pub file: String,
    /// The move's line.
    pub line: usize,
    /// The move's column.
    pub column: usize,
    /// `tool` or `work frame`.
    pub what: &'static str,
    /// Its name in the program.
    pub name: String,
}

impl PlacementError {
    /// What is wrong, without the place.
    #[must_use]
    pub fn message(&self) -> String {
        let Self { what, name, .. } = self;
        format!(
            "neither the program files nor the profile nor the command line say where {what} `{name}` is"
        )
    }

    /// The way out.
    #[must_use]
    pub fn hint(&self) -> String {
        let option = if self.what == "tool" {
            "--tool"
        } else {
            "--frame"
        };
        format!(
            "give the file that declares it too, or `{option} {}=x,y,z,rx,ry,rz` (mm, deg)",
            self.name
        )
    }
}

/// The tool and frame of one target.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// Index of the tool in the program, or one past the last for a tool that the user gave for unused targets.
    pub tool: usize,
    pub mounted: Mounted,
    pub world_from_frame: Pose,
}

/// The place of each target; `None` where it stays as it is.
pub(super) fn place(
    job: &Job,
    findings: &mut Vec<Finding>,
) -> Result<Vec<Option<Place>>, PlacementError> {
    let program = job.program;
    let mut uses: Vec<Vec<usize>> = vec![Vec::new(); program.targets.len()];
    for (index, motion) in program.moves.iter().enumerate() {
        uses[motion.target].push(index);
    }
    let tools: Vec<_> = (0..program.tools.len())
        .map(|tool| tool_of(job, tool))
        .collect();
    let frames: Vec<_> = (0..program.frames.len())
        .map(|frame| frame_of(job, frame))
        .collect();
    let mut places = Vec::with_capacity(uses.len());
    for (index, target) in program.targets.iter().enumerate() {
        let left_alone = target.blocked
            || (target.layout.shape == Shape::Joints && !job.options.correct_joint_targets);
        let place = if left_alone {
            None
        } else {
            place_target(job, index, &uses[index], &tools, &frames, findings)?
        };
        places.push(place);
    }
    Ok(places)
}

fn place_target(
    job: &Job,
    index: usize,
    uses: &[usize],
    tools: &[Option<Mounted>],
    frames: &[Option<Pose>],
    findings: &mut Vec<Finding>,
) -> Result<Option<Place>, PlacementError> {
    let program = job.program;
    let is_joints = program.targets[index].layout.shape == Shape::Joints;
    let Some((&first, others)) = uses.split_first() else {
        return Ok(place_unused(job, index, findings));
    };
    let known = |use_: usize| -> Result<(usize, &Mounted, Pose), PlacementError> {
        let motion = &program.moves[use_];
        let unknown = |what, name: &str| {
            let source = &job.sources[motion.file as usize];
            let (line, column) = source.line_column(motion.offset as usize);
            PlacementError {
                file: source.name.clone(),
                line,
                column,
                what,
                name: name.into(),
            }
        };
        let tool = tools[motion.tool]
            .as_ref()
            .ok_or_else(|| unknown("tool", &program.tools[motion.tool].name))?;
        // joint targets have no work frame
        let frame = if is_joints {
            Some(Pose::identity())
        } else {
            frames[motion.frame]
        };
        let frame =
            frame.ok_or_else(|| unknown("work frame", &program.frames[motion.frame].name))?;
        Ok((motion.tool, tool, frame))
    };
    let (tool, mounted, world_from_frame) = known(first)?;
    for &other in others {
        let (_, other_mounted, other_frame) = known(other)?;
        let same = same_pose(&mounted.flange_from_tool, &other_mounted.flange_from_tool)
            && mounted.load == other_mounted.load
            && same_pose(&world_from_frame, &other_frame);
        if !same {
            let line = |use_: usize| {
                let motion = &program.moves[use_];
                job.sources[motion.file as usize]
                    .line_column(motion.offset as usize)
                    .0
            };
            let message = format!(
                "{} is used with different tools or work frames (lines {} and {}): one fake target cannot serve both",
                name_of(job, index),
                line(first),
                line(other)
            );
            let hint = "give each use a target of its own";
            findings.push(job.at_target("target-shared", Severity::Error, index, message, hint));
            return Ok(None);
        }
    }
    Ok(Some(Place {
        tool,
        mounted: mounted.clone(),
        world_from_frame,
    }))
}

/// A target that no move in these files uses: its tool and frame are what the user gives for unknown names.
fn place_unused(job: &Job, index: usize, findings: &mut Vec<Finding>) -> Option<Place> {
    if job.program.targets[index].layout.shape == Shape::Joints {
        return None;
    }
    let given = &job.options.given;
    if let (Some(mounted), Some(&world_from_frame)) =
        (given.tools.get(&None), given.frames.get(&None))
    {
        return Some(Place {
            tool: job.program.tools.len(),
            mounted: mounted.clone(),
            world_from_frame,
        });
    }
    let message = format!(
        "no move in these files uses {}: its tool and work frame are unknown",
        name_of(job, index)
    );
    let hint = "give the files that use it together, or --tool and --frame for it, or --keep-going to leave it as it is";
    findings.push(job.at_target("target-unused", Severity::Error, index, message, hint));
    None
}

/// A target's name for messages.
pub(super) fn name_of(job: &Job, index: usize) -> String {
    let target = &job.program.targets[index];
    target
        .name
        .as_ref()
        .map_or_else(|| "this target".into(), |name| format!("`{name}`"))
}

fn same_pose(a: &Pose, b: &Pose) -> bool {
    let gap = a.separation(b);
    gap.distance_m < SAME && gap.angle_rad < SAME
}

/// The tool as the files have it, else as the command line or the profile does; the load likewise.
fn tool_of(job: &Job, index: usize) -> Option<Mounted> {
    let tool = &job.program.tools[index];
    let given = &job.options.given.tools;
    let of_profile = job.profile.tool(&tool.name);
    let elsewhere = || {
        let named = given.get(&Some(tool.name.clone())).cloned();
        named
            .or_else(|| of_profile.clone())
            .or_else(|| given.get(&None).cloned())
    };
    match tool.flange_from_tool {
        Some(flange_from_tool) => {
            let load = tool.load.map(|load| (load.mass_kg, load.cog_m));
            let load = load.or_else(|| of_profile.as_ref().and_then(|tool| tool.load));
            Some(Mounted {
                name: tool.name.clone(),
                flange_from_tool,
                load,
            })
        }
        None => elsewhere().map(|found| Mounted {
            load: tool
                .load
                .map(|load| (load.mass_kg, load.cog_m))
                .or(found.load),
            ..found
        }),
    }
}

fn frame_of(job: &Job, index: usize) -> Option<Pose> {
    let frame = &job.program.frames[index];
    let given = &job.options.given.frames;
    let elsewhere = || {
        given
            .get(&Some(frame.name.clone()))
            .or_else(|| given.get(&None))
            .copied()
    };
    frame.world_from_frame.or_else(elsewhere)
}
