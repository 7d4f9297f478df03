//! The tools and work frames of a program, as far as files, profile and command line tell them.

use super::placed::Placed;
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::printable::shell_word;
use crate::profile::{Mounted, Profile};
use crate::program::{Frame, FrameId, Language, Load, Move, Program, Source, Tool, ToolId};
use std::collections::BTreeMap;

/// Two values of one tool or frame that differ by less than this are the same, metres and radians.
const SAME: f64 = 1e-9;

/// Tools and work frames that the user gives, by name in the program or, under `None`, for every
/// name that is unknown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given {
    /// Tools.
    pub tools: BTreeMap<Option<String>, Mounted>,
    /// `world_from_frame` of work frames.
    pub frames: BTreeMap<Option<String>, Pose>,
    /// `world_from_frame` of work frames as they were measured, by name; the program must not say
    /// otherwise.
    pub measured_frames: BTreeMap<String, Pose>,
    /// A value under `None` that nothing needs is an error: who gave it meant something by it.
    pub is_needed: bool,
}

/// A measured work frame that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeasuredFrameError {
    /// The program has another value.
    #[error(
        "the program declares work frame `{name}` {distance_mm:.4} mm and {angle_deg:.5} deg from \
         the measured one"
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
                "write the measured frame into the program and controller, and leave --wobj out; \
                 or keep the declared frame and give the part's displacement with --work-offset"
            }
            Self::Unused { .. } => "names are as the program writes them",
        }
    }
}

/// Measured frames must be used, and agree with what the program declares: the controller computes
/// with its own.
pub(crate) fn check_measured(program: &Program, given: &Given) -> Result<(), MeasuredFrameError> {
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

/// A tool or work frame that the user gives, and that does not count.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GivenError {
    /// No move has it.
    #[error("{option} {name}: no move of these files uses a {what} `{name}`; they use: {used}")]
    Unused {
        /// The option.
        option: &'static str,
        /// `tool` or `work frame`.
        what: &'static str,
        /// The name.
        name: String,
        /// The names that are used.
        used: String,
    },
    /// The files tell it themselves.
    #[error(
        "{option} {name}: the files define {what} `{name}` themselves, and the controller computes \
         with that"
    )]
    Defined {
        /// The option.
        option: &'static str,
        /// `tool` or `work frame`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// All of them are known.
    #[error(
        "{option} without a name: every {what} that the files use is known without it, from the \
         files, the profile or another option"
    )]
    Needless {
        /// The option.
        option: &'static str,
        /// `tool` or `work frame`.
        what: &'static str,
    },
}

impl GivenError {
    /// The way out.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Unused { .. } => "names are as the program writes them; leave the option out",
            Self::Defined { what: "tool", .. } => {
                "leave the option out, or correct the value in the file; its mass is that of the \
                 profile's tool of this name: rename the tool in the profile"
            }
            Self::Defined { .. } | Self::Needless { .. } => {
                "leave the option out, or correct the value in the file"
            }
        }
    }
}

/// Tools and work frames that are given by name must be used, and not be known already; those that
/// are given for any name must be needed. The programs are those of one run.
pub(crate) fn check_given(
    language: &dyn Language,
    profile: &Profile,
    programs: &[&Program],
    given: &Given,
) -> Result<(), GivenError> {
    let tools = programs.iter().flat_map(|program| &program.tools);
    let tools: Vec<(&str, bool)> = tools
        .map(|tool| (tool.name.as_str(), tool.flange_from_tool.is_some()))
        .collect();
    let frames = programs.iter().flat_map(|program| &program.frames);
    let frames: Vec<(&str, bool)> = frames
        .map(|frame| (frame.name.as_str(), frame.world_from_frame.is_some()))
        .collect();
    let tool_names = given.tools.keys().flatten();
    let frame_names = given.frames.keys().flatten();
    let asked = tool_names
        .map(|name| ("--tool", "tool", name, &tools))
        .chain(frame_names.map(|name| ("--frame", "work frame", name, &frames)));
    // moves whose tool or frame only the running program knows are refused, and do not name it
    let mut findings = programs.iter().flat_map(|program| &program.findings);
    let is_changed = findings.any(|f| f.severity == Severity::Error && f.id.starts_with("frame-"));
    for (option, what, name, known) in asked {
        let name = name.clone();
        let mut of_name = known.iter().filter(|(of, _)| *of == name).peekable();
        if of_name.peek().is_none() {
            if is_changed {
                continue;
            }
            let mut used: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
            used.sort_unstable();
            used.dedup();
            used.retain(|name| !name.is_empty());
            return Err(GivenError::Unused {
                option,
                what,
                name,
                used: if used.is_empty() {
                    "none by name".into()
                } else {
                    used.join(", ")
                },
            });
        }
        if of_name.all(|(_, is_defined)| *is_defined) {
            return Err(GivenError::Defined { option, what, name });
        }
    }
    // the same tool by its name in the profile does no harm
    let is_other = |known: &Mounted| given.tools.get(&None) != Some(known);
    let is_tool_known = |name: &str| {
        let named = given.tools.get(&Some(name.to_owned())).cloned();
        named
            .or(profile.tool(name))
            .is_some_and(|known| is_other(&known))
    };
    let is_frame_known = |name: &str| {
        let is_given = given.frames.contains_key(&Some(name.to_owned()));
        is_given || given.measured_frames.contains_key(name)
    };
    let all = |known: &[(&str, bool)], is_known: &dyn Fn(&str) -> bool| {
        let mut all = known.iter();
        !(known.is_empty() && is_changed)
            && all.all(|(name, is_defined)| *is_defined || is_known(name))
    };
    let is_for_unused = || {
        let mut programs = programs.iter();
        !language.has_framed_positions() && programs.any(|program| has_unused(program))
    };
    // joints need no work frame
    let needs = |program: &&Program| {
        let mut needs = vec![false; program.frames.len()];
        for motion in program
            .moves
            .iter()
            .filter(|motion| program.goes_to_pose(motion))
        {
            needs[motion.frame] = true;
        }
        needs
    };
    let needed = programs.iter().flat_map(needs);
    let frames = frames.iter().copied().zip(needed);
    let frames: Vec<_> = frames
        .filter(|(_, needs)| *needs)
        .map(|(frame, _)| frame)
        .collect();
    let unnamed = [
        (
            "--tool",
            "tool",
            given.tools.contains_key(&None) && all(&tools, &is_tool_known),
        ),
        (
            "--frame",
            "work frame",
            given.frames.contains_key(&None) && all(&frames, &is_frame_known),
        ),
    ];
    for (option, what, is_needless) in unnamed {
        if given.is_needed && is_needless && !is_for_unused() {
            return Err(GivenError::Needless { option, what });
        }
    }
    Ok(())
}

/// Whether there are targets that no move uses, and that do not stay for that: their tool and frame are
/// those given for any name.
fn has_unused(program: &Program) -> bool {
    let mut used = vec![false; program.targets.len()];
    for target in program.moves.iter().filter_map(|motion| motion.target) {
        used[target] = true;
    }
    let mut all = program.targets.iter().zip(used);
    all.any(|(target, is_used)| !is_used && !target.blocked)
}

/// The same frame but for the digits of the files: 1 µm and 1e-5 degrees.
pub(crate) fn agrees(a: &Pose, b: &Pose) -> bool {
    let gap = a.separation(b);
    gap.distance_m < 1e-6 && gap.angle_rad < 1e-5 * DEG
}

/// Tools and frames that nobody knows, each with the first move that uses it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlacementError {
    /// At least one, by file and place.
    pub missing: Vec<Missing>,
}

/// A tool or frame that nobody knows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
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

impl Missing {
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
            "neither the program files nor the profile nor the command line say where {what} \
             `{name}` is"
        )
    }

    /// The option of the command line that would give it.
    #[must_use]
    pub fn option(&self) -> String {
        let option = if self.what == "tool" {
            "--tool"
        } else {
            "--frame"
        };
        if self.name.is_empty() {
            return format!("{option} x,y,z,rx,ry,rz");
        }
        let value = format!("{}=x,y,z,rx,ry,rz", self.name);
        format!("{option} {}", shell_word(&value))
    }
}

impl PlacementError {
    /// What is wrong, without the place of the first.
    #[must_use]
    pub fn message(&self) -> String {
        let mut message = self.missing[0].message();
        for other in &self.missing[1..] {
            let Missing { file, line, .. } = other;
            message.push_str(&format!("; {file} line {line}: {}", other.message()));
        }
        message
    }

    /// The way out.
    #[must_use]
    pub fn hint(&self) -> String {
        let options: Vec<String> = self.missing.iter().map(Missing::option).collect();
        let options = options.join(" ");
        if self.missing.iter().all(|missing| missing.name.is_empty()) {
            return format!("give `{options}` (mm, deg) or a name in the profile");
        }
        format!("give the files that declare them too, or `{options}` (mm, deg)")
    }
}

impl std::fmt::Display for PlacementError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Missing {
            file, line, column, ..
        } = &self.missing[0];
        write!(f, "{file}:{line}:{column}: {}", self.message())
    }
}

impl std::error::Error for PlacementError {}

/// Makes an error of each tool and frame that nobody knows, and leaves the targets of the moves
/// that need it.
pub(crate) fn block_unplaced(
    language: &dyn Language,
    program: &mut Program,
    sources: &[Source],
    profile: &Profile,
    given: &Given,
    findings: &mut Vec<Finding>,
    needs: impl Fn(&Program, &Move) -> bool,
) {
    let setting = Setting::of(language, program, profile, given);
    let mut blocked = Vec::new();
    let mut reported = std::collections::BTreeSet::new();
    for motion in program.moves.iter().filter(|motion| needs(program, motion)) {
        for (what, name) in setting.unknown(program, motion) {
            blocked.extend(motion.target);
            if reported.insert((motion.file, what, name)) {
                let missing = Missing::at(&sources[motion.file as usize], motion, what, name);
                let error = PlacementError {
                    missing: vec![missing],
                };
                findings.push(sources[motion.file as usize].finding(
                    motion.offset as usize,
                    "frame-unknown",
                    Severity::Error,
                    error.message(),
                    &error.hint(),
                ));
            }
        }
    }
    for target in blocked {
        program.targets[target].blocked = true;
    }
}

impl Missing {
    /// What a move lacks.
    pub(crate) fn at(source: &Source, motion: &Move, what: &'static str, name: &str) -> Self {
        let (line, column) = source.line_column(motion.offset as usize);
        Self {
            file: source.name.clone(),
            line,
            column,
            what,
            name: name.into(),
        }
    }
}

/// The tools and work frames of a program as far as anybody knows them.
pub(crate) struct Setting {
    /// The program's, and one more: what the user gave for targets that no move uses.
    pub tools: Vec<Option<Mounted>>,
    /// The program's, and two more: what the user gave for targets that no move uses, and the
    /// world for joint targets.
    pub frames: Vec<Option<Placed>>,
}

impl Setting {
    /// What a move needs and nobody knows: `tool` or `work frame`, and its name.
    pub(crate) fn unknown<'p>(
        &self,
        program: &'p Program,
        motion: &Move,
    ) -> impl Iterator<Item = (&'static str, &'p str)> {
        let tool = self.tools[motion.tool]
            .is_none()
            .then(|| ("tool", program.tools[motion.tool].name.as_str()));
        // joints stand in the world
        let frame = (program.goes_to_pose(motion) && self.frames[motion.frame].is_none())
            .then(|| ("work frame", program.frames[motion.frame].name.as_str()));
        tool.into_iter().chain(frame)
    }

    pub(crate) fn of(
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
                let known = frame_of(frame, given).or_else(|| is_unframed.then(Pose::identity));
                known.map(|pose| Placed::of(profile, frame, pose))
            })
            .collect();
        let unused = given.frames.get(&None).copied().map(Placed::still);
        frames.extend([unused, Some(Placed::still(Pose::identity()))]);
        Self { tools, frames }
    }

    /// Whether two tools are of the same values.
    pub(crate) fn same_tool(&self, a: ToolId, b: ToolId) -> bool {
        a == b
            || match (&self.tools[a], &self.tools[b]) {
                (Some(a), Some(b)) => {
                    same_pose(&a.flange_from_tool, &b.flange_from_tool) && a.load == b.load
                }
                _ => false,
            }
    }

    /// Whether two work frames are of the same values.
    pub(crate) fn same_frame(&self, a: FrameId, b: FrameId) -> bool {
        a == b
            || match (&self.frames[a], &self.frames[b]) {
                (Some(a), Some(b)) => {
                    same_pose(&a.nominal, &b.nominal) && same_pose(&a.real, &b.real)
                }
                _ => false,
            }
    }

    /// The work frame that stands for the world.
    pub(crate) fn world(&self) -> FrameId {
        self.frames.len() - 1
    }
}

fn same_pose(a: &Pose, b: &Pose) -> bool {
    let gap = a.separation(b);
    gap.distance_m < SAME && gap.angle_rad < SAME
}

/// The tool as the files have it, else as the command line or the profile does. Its load is that of
/// the files; where they give none that of the profile's tool of its name. What it carries counts
/// where its own load is known: where that is not, [`super::plausibility`] says that it counts as
/// nothing.
fn tool_of(tool: &Tool, profile: &Profile, given: &Given) -> Option<Mounted> {
    let of_profile = profile.tool(&tool.name);
    let load_by_name = of_profile.as_ref().and_then(|tool| tool.load);
    let is_in_profile = of_profile.is_some();
    let found = if let Some(flange_from_tool) = tool.flange_from_tool {
        Some(Mounted {
            name: tool.name.clone(),
            flange_from_tool,
            load: None,
        })
    } else {
        let named = given.tools.get(&Some(tool.name.clone())).cloned();
        named
            .or(of_profile)
            .or_else(|| given.tools.get(&None).cloned())
    };
    found.map(|found| {
        let of_profile = found.load.or(load_by_name);
        let of_profile = of_profile.map(|(mass_kg, cog_m)| Load { mass_kg, cog_m });
        let empty = is_in_profile.then_some(Load {
            mass_kg: 0.0,
            cog_m: [0.0; 3],
        });
        let own = tool.load.or(of_profile);
        let load = match tool.carried {
            Some(part) => own
                .or(empty)
                .map(|own| own.with(part, &found.flange_from_tool)),
            None => own,
        };
        Mounted {
            load: load.map(|load| (load.mass_kg, load.cog_m)),
            ..found
        }
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
