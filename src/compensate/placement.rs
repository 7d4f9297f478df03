//! Which tool and which work frame a target has.

use super::Job;
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::profile::{Mounted, Profile};
use crate::program::{Frame, Language, Move, Program, Shape, Tool};
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
    /// `world_from_frame` of work frames as they were measured, by name; the program must not say otherwise.
    pub measured_frames: BTreeMap<String, Pose>,
}

/// A measured work frame that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeasuredFrameError {
    /// The program has another value.
    #[error(
        "the program declares work frame `{name}` {distance_mm:.4} mm and {angle_deg:.5} deg beside the measured one"
    )]
    Conflict {
        /// Its name.
        name: String,
        /// Distance of the origins, mm.
        distance_mm: f64,
        /// Angle between the axes, degrees.
        angle_deg: f64,
    },
    /// The program does not use it.
    #[error("no move uses a work frame `{name}`; the programs use: {used}")]
    Unused {
        /// Its name.
        name: String,
        /// The names that are used.
        used: String,
    },
}

impl MeasuredFrameError {
    /// The way out.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Conflict { .. } => {
                "write the measured frame into the program and controller, and leave --wobj out; or keep the declared frame and give the part's displacement with --work-offset"
            }
            Self::Unused { .. } => "names are as the program writes them",
        }
    }
}

/// Measured frames must be used, and agree with what the program declares: the controller computes with its own.
pub(super) fn check_measured(program: &Program, given: &Given) -> Result<(), MeasuredFrameError> {
    for (name, measured) in &given.measured_frames {
        let Some(frame) = program.frames.iter().find(|frame| frame.name == *name) else {
            let used: Vec<_> = program.frames.iter().map(|f| f.name.as_str()).collect();
            return Err(MeasuredFrameError::Unused {
                name: name.clone(),
                used: used.join(", "),
            });
        };
        if let Some(declared) = frame.world_from_frame.filter(|d| !agrees(d, measured)) {
            let gap = declared.separation(measured);
            return Err(MeasuredFrameError::Conflict {
                name: name.clone(),
                distance_mm: mm_from_m(gap.distance_m),
                angle_deg: gap.angle_rad / DEG,
            });
        }
    }
    Ok(())
}

/// The same frame but for the digits of the files: 1 µm and 1e-5 degrees.
fn agrees(a: &Pose, b: &Pose) -> bool {
    let gap = a.separation(b);
    gap.distance_m < 1e-6 && gap.angle_rad < 1e-5 * DEG
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
        if name.is_empty() {
            return format!(
                "neither the program files nor the command line say where the {what} is"
            );
        }
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
        if self.name.is_empty() {
            return format!("give `{option} x,y,z,rx,ry,rz` (mm, deg) or its name in the profile");
        }
        format!(
            "give the file that declares it too, or `{option} {}=x,y,z,rx,ry,rz` (mm, deg)",
            self.name
        )
    }
}

/// The tool and frame of one target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Index in [`Setting::tools`].
    pub tool: usize,
    /// Index in [`Setting::frames`].
    pub frame: usize,
}

/// The tools and work frames of a program as far as anybody knows them.
pub(super) struct Setting {
    /// The program's, and one more: what the user gave for targets that no move uses.
    pub tools: Vec<Option<Mounted>>,
    /// The program's, and two more: what the user gave for targets that no move uses, and the world for joint targets.
    pub frames: Vec<Option<Pose>>,
}

impl Setting {
    pub fn of(
        language: &dyn Language,
        program: &Program,
        profile: &Profile,
        given: &Given,
    ) -> Self {
        let unframed = language.frame_of_unframed();
        let mut tools: Vec<_> = program
            .tools
            .iter()
            .map(|tool| tool_of(tool, profile, given))
            .collect();
        tools.push(given.tools.get(&None).cloned());
        let mut frames: Vec<_> = program
            .frames
            .iter()
            .map(|frame| {
                let is_unframed = Some(frame.name.as_str()) == unframed;
                frame_of(frame, given).or_else(|| is_unframed.then(Pose::identity))
            })
            .collect();
        frames.extend([given.frames.get(&None).copied(), Some(Pose::identity())]);
        Self { tools, frames }
    }

    /// Whether two places have tools and frames of the same values.
    fn is_same(&self, a: Place, b: Place) -> bool {
        let same_tool = match (&self.tools[a.tool], &self.tools[b.tool]) {
            (Some(a), Some(b)) => {
                same_pose(&a.flange_from_tool, &b.flange_from_tool) && a.load == b.load
            }
            _ => false,
        };
        let same_frame = match (&self.frames[a.frame], &self.frames[b.frame]) {
            (Some(a), Some(b)) => same_pose(a, b),
            _ => false,
        };
        (a.tool == b.tool || same_tool) && (a.frame == b.frame || same_frame)
    }
}

/// The place of each target; `None` where it stays as it is.
pub(super) fn place(
    job: &Job,
    findings: &mut Vec<Finding>,
) -> Result<Vec<Option<Place>>, PlacementError> {
    let program = job.program;
    let is_joints = |target: usize| program.targets[target].layout.shape == Shape::Joints;
    let stays = |target: usize| {
        program.targets[target].blocked || (is_joints(target) && !job.options.correct_joint_targets)
    };
    // the first move to each target, and whether another one contradicts it
    let mut first: Vec<Option<(usize, bool)>> = vec![None; program.targets.len()];
    let place_of = |motion: &Move| place_of(job, motion);
    for (index, motion) in program.moves.iter().enumerate() {
        let Some(target) = motion.target.filter(|target| !stays(*target)) else {
            continue;
        };
        let place = known(job, motion)?;
        match &mut first[target] {
            None => first[target] = Some((index, false)),
            Some((other, contradicted)) => {
                let before = &program.moves[*other];
                if !*contradicted && !job.setting.is_same(place_of(before), place) {
                    *contradicted = true;
                    findings.push(shared(job, before, motion));
                }
            }
        }
    }
    let place = |(target, first): (usize, Option<(usize, bool)>)| match first {
        _ if stays(target) => None,
        Some((index, false)) => Some(place_of(&program.moves[index])),
        Some((_, true)) => None,
        None => place_unused(job, target, findings),
    };
    Ok(first.into_iter().enumerate().map(place).collect())
}

/// The place that a move gives its target.
fn place_of(job: &Job, motion: &Move) -> Place {
    let target = motion.target.map(|target| &job.program.targets[target]);
    let is_joints = target.is_some_and(|target| target.layout.shape == Shape::Joints);
    let world = job.setting.frames.len() - 1;
    Place {
        tool: motion.tool,
        frame: if is_joints { world } else { motion.frame },
    }
}

/// The place that a move gives its target, whose tool and frame must be known.
pub(super) fn known(job: &Job, motion: &Move) -> Result<Place, PlacementError> {
    let (place, program) = (place_of(job, motion), job.program);
    if job.setting.tools[place.tool].is_none() {
        let name = &program.tools[motion.tool].name;
        return Err(unknown(job, motion, "tool", name));
    }
    if job.setting.frames[place.frame].is_none() {
        let name = &program.frames[motion.frame].name;
        return Err(unknown(job, motion, "work frame", name));
    }
    Ok(place)
}

fn unknown(job: &Job, motion: &Move, what: &'static str, name: &str) -> PlacementError {
    let source = &job.sources[motion.file as usize];
    let (line, column) = source.line_column(motion.offset as usize);
    PlacementError {
        file: source.name.clone(),
        line,
        column,
        what,
        name: name.into(),
    }
}

fn shared(job: &Job, a: &Move, b: &Move) -> Finding {
    let line = |motion: &Move| {
        job.sources[motion.file as usize]
            .line_column(motion.offset as usize)
            .0
    };
    let message = format!(
        "{} is used with different tools or work frames (lines {} and {}): one fake target cannot serve both",
        name_of(job, a.target.expect("moves that share a target have one")),
        line(a),
        line(b)
    );
    job.at_target(
        "target-shared",
        Severity::Error,
        a.target.expect("moves that share a target have one"),
        message,
        "give each use a target of its own",
    )
}

/// A target that no move in these files uses: its tool and frame are what the user gives for unknown names.
fn place_unused(job: &Job, target: usize, findings: &mut Vec<Finding>) -> Option<Place> {
    if job.program.targets[target].layout.shape == Shape::Joints {
        return None;
    }
    let place = Place {
        tool: job.program.tools.len(),
        frame: job.program.frames.len(),
    };
    if job.setting.tools[place.tool].is_some() && job.setting.frames[place.frame].is_some() {
        return Some(place);
    }
    let message = format!(
        "no move in these files uses {}: its tool and work frame are unknown",
        name_of(job, target)
    );
    let hint = "give the files that use it together, or --tool and --frame for it, or --keep-going to leave it as it is";
    findings.push(job.at_target("target-unused", Severity::Error, target, message, hint));
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
fn tool_of(tool: &Tool, profile: &Profile, given: &Given) -> Option<Mounted> {
    let load = tool.load.map(|load| (load.mass_kg, load.cog_m));
    let of_profile = profile.tool(&tool.name);
    let found = if let Some(flange_from_tool) = tool.flange_from_tool {
        let load = of_profile.and_then(|tool| tool.load);
        Some(Mounted {
            name: tool.name.clone(),
            flange_from_tool,
            load,
        })
    } else {
        let named = given.tools.get(&Some(tool.name.clone())).cloned();
        named
            .or(of_profile)
            .or_else(|| given.tools.get(&None).cloned())
    };
    found.map(|found| Mounted {
        load: load.or(found.load),
        ..found
    })
}

fn frame_of(frame: &Frame, given: &Given) -> Option<Pose> {
    let elsewhere = || {
        given
            .measured_frames
            .get(&frame.name)
            .or_else(|| given.frames.get(&Some(frame.name.clone())))
            .or_else(|| given.frames.get(&None))
            .copied()
    };
    frame.world_from_frame.or_else(elsewhere)
}
