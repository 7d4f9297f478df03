//! What a program says: its targets with the bytes where their numbers stand, and its moves.
//! Nothing is computed with a robot.

use super::Document;
use super::check::kind;
use super::failure::Failure;
use super::parts::Pose;
use super::programs::{common_language, explain};
use crate::compensate::CompensateError;
use crate::finding::Finding;
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::profile::Profile;
use crate::motion;
use crate::motion::external::settings_of;
use crate::program::{self, Language, Program, Settings, Shape, Source, Value, meaning};
use schemars::JsonSchema;
use serde::Serialize;

/// A target with its numbers.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Target {
    /// Its file.
    pub file: String,
    /// Its line, from 1.
    pub line: usize,
    /// Its column, from 1.
    pub column: usize,
    /// Its name, where it has one.
    pub name: Option<String>,
    /// Its first byte.
    pub start: usize,
    /// Behind its last byte.
    pub end: usize,
    /// `pose` or `joints`.
    pub shape: &'static str,
    /// The tool in the work frame.
    pub pose: Option<Pose>,
    /// The controller's joint angles.
    pub joints_deg: Option<[f64; 6]>,
    /// First byte and length of each number; length 0 where the text leaves it out.
    pub spans: Vec<[usize; 2]>,
    /// The numbers as they stand there, in the units of the language.
    pub values: Vec<f64>,
    /// It stays as it is; a finding says why.
    pub blocked: bool,
}

/// A move to a target.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Move {
    /// Its file.
    pub file: String,
    /// Its line, from 1.
    pub line: usize,
    /// `joint`, `linear`, `arc-via` or `arc`.
    pub kind: &'static str,
    /// Number of its target, from 0; `null` where only the running program knows.
    pub target: Option<usize>,
    /// Its tool.
    pub tool: String,
    /// Its work frame.
    pub frame: String,
    /// Programmed speed of the tool.
    pub speed_mm_s: Option<f64>,
    /// Radius of the corner; 0 where the robot stops.
    pub zone_mm: Option<f64>,
    /// First byte of its instruction.
    pub start: usize,
    /// Behind its last byte.
    pub end: usize,
}

/// What program files hold.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Reading {
    /// Their language.
    pub language: &'static str,
    /// All targets with numbers, by file and place.
    pub targets: Vec<Target>,
    /// The moves to them, by file and place.
    pub moves: Vec<Move>,
    /// What a person should look at.
    pub findings: Vec<Finding>,
}

impl Document for Reading {
    const KIND: &'static str = "program/1";
}

/// Reads programs that belong together. A profile knows pulses and external axes, and the language
/// of a controller.
///
/// # Errors
/// Files of no known language, of several, or broken ones.
pub fn read(
    sources: &[Source],
    profile: Option<&Profile>,
    language: Option<&'static dyn Language>,
) -> Result<Reading, Failure> {
    let language = match language {
        Some(language) => language,
        None => common_language(sources, profile)?,
    };
    let settings = profile.map_or_else(
        || Settings {
            accept_absolutely_accurate: true,
            ..Settings::default()
        },
        |profile| settings_of(profile, true),
    );
    let program = motion::read(language, sources, &settings)
        .map_err(|error| explain(&CompensateError::Read(error), sources))?;
    let target = |(index, target): (usize, &program::Target)| {
        let source = &sources[target.file as usize];
        let (line, column) = source.line_column(target.offset as usize);
        let numbers = program.numbers_of(target);
        let value = meaning(language, &program, &settings, index).map(|decoded| decoded.value);
        Target {
            file: source.name.clone(),
            line,
            column,
            name: target.name.as_deref().map(str::to_owned),
            start: target.offset as usize,
            end: target.end as usize,
            shape: match target.layout.shape {
                Shape::Pose => "pose",
                Shape::Joints => "joints",
            },
            pose: match &value {
                Some(Value::Pose(pose)) => Some(pose.into()),
                _ => None,
            },
            joints_deg: match value {
                Some(Value::Joints(q)) => Some(q.map(|q| q / DEG)),
                _ => None,
            },
            spans: numbers
                .iter()
                .map(|n| [n.start as usize, n.length.into()])
                .collect(),
            values: numbers.iter().map(|n| n.value).collect(),
            blocked: target.blocked,
        }
    };
    Ok(Reading {
        language: language.about().id,
        targets: program.targets.iter().enumerate().map(target).collect(),
        moves: program
            .moves
            .iter()
            .map(|one| step(&program, sources, one))
            .collect(),
        findings: program.findings.clone(),
    })
}

fn step(program: &Program, sources: &[Source], one: &program::Move) -> Move {
    let source = &sources[one.file as usize];
    let instruction = &program.instructions[one.instruction as usize];
    let said = program.speed_zone(one);
    Move {
        file: source.name.clone(),
        line: source.line_column(one.offset as usize).0,
        kind: kind(one.motion),
        target: one.target,
        tool: program.tools[one.tool].name.clone(),
        frame: program.frames[one.frame].name.clone(),
        speed_mm_s: said.speed_m_s.map(mm_from_m),
        zone_mm: said.zone_m.map(mm_from_m),
        start: one.offset as usize,
        end: instruction.end as usize,
    }
}
