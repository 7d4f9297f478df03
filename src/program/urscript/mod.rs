//! Universal Robots `URScript`: .script, .urscript.
//!
//! A pose is `p[x, y, z, rx, ry, rz]`, metres and a rotation vector in radians; joints are `[q0, …, q5]`, radians, or
//! `d2r(…)` of degrees. The pose is that of the tool of the last `set_tcp` in the controller's base; `pose_trans(feature,
//! pose)` puts it in a feature. A variable that is assigned once stands for its value.
//!
//! `get_inverse_kin(pose, qnear=joints)`: the pose is the target, the joints tell which of its solutions is meant and stay.
//! `pose_trans(target, offset)` of a target that other moves go to, and `pose_add`, are displacements of it.
//!
//! # Findings
//!
//! | id | severity | meaning |
//! |---|---|---|
//! | `target-assigned-at-run-time` | error | the variable is assigned more than once, or a part of it is |
//! | `target-has-expressions` | error | parts of the pose are expressions, not numbers |
//! | `joints-have-expressions` | warning | the same of joints, which stay unless the user asks for them |
//! | `computed-target` | error | a move goes to a pose that only the running program knows |
//! | `target-passed-to-function` | error | a move goes to a parameter of its function |
//! | `target-not-in-file` | error | a move goes to a variable that the file does not assign |
//! | `frame-assigned-at-run-time` | error | the feature's variable is assigned more than once |
//! | `frame-known-at-run-time` | error | the feature is computed, or is itself a target |
//! | `tool-known-at-run-time` | error | several tools may be set at a move, or one that the text does not tell |
//! | `target-used-as-offset` | error | a target is also the offset of another |
//! | `streamed-motion` | error | servoj or servoc to a pose |
//! | `moving-frame` | error | conveyor tracking, path offsets, parts that move |
//! | `target-copied` | warning | a value is computed from a target |
//! | `motion-without-target` | note | `speedl`, `force_mode` and their like |
//!
//! # Limits
//!
//! Each file stands for itself. The pendant opens .urp, not .script: a compensated script is sent or run as a script.

mod calls;
mod expressions;
mod findings;
mod flow;
mod insert;
mod literals;
mod moves;
mod pace;
mod reader;
mod rotation;
mod sniff;
mod syntax;
mod tokens;
mod variables;
mod verbs;

use super::{
    About, Configuration, Decoded, Language, Layout, Marker, Posture, Program, ReadError, Role,
    Settings, Shape, Source, Value,
};
use crate::geometry::units::DEG;
use crate::program::{Inserted, Insertion, Move, Pace};
use moves::Moves;
use reader::Reader;

/// Universal Robots `URScript`.
#[derive(Debug)]
pub struct UrScript;

static ABOUT: About = About {
    id: "urscript",
    name: "Universal Robots URScript",
    extensions: &["script", "urscript", "urs"],
    rewrites: &[
        "poses in movej, movel, movep, movec, and in get_inverse_kin, pose_trans and pose_add there",
        "poses of variables that are assigned once and that moves go to",
        "joints in movej, movel, movep, servoj",
    ],
    leaves: &[
        "qnear of get_inverse_kin, features, set_tcp, loads, speeds, blends",
        "comments, annotations, strings, line ends, encoding",
        "speedj, speedl, force_mode and other motion without a target",
    ],
    refuses: &[
        "targets with expressions, variables that are assigned more than once or by their parts",
        "features and tools that only the running program knows",
        "poses as parameters of functions, servoing to poses",
        "conveyor tracking and path offsets",
    ],
};

const POSE_ROLES: [Role; 6] = [
    Role::Position,
    Role::Position,
    Role::Position,
    Role::Orientation,
    Role::Orientation,
    Role::Orientation,
];

impl Language for UrScript {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        sniff::recognises(&source.bytes)
    }

    fn read(&self, sources: &[Source], _: &Settings) -> Result<Program, ReadError> {
        let mut program = Program::default();
        for (file, source) in sources.iter().enumerate() {
            check_bytes(source)?;
            let mut reader = Reader::new(source).read()?;
            if !reader.recognised {
                return Err(ReadError::NotThisLanguage {
                    file: source.name.clone(),
                    language: ABOUT.name,
                    missing: "a function, a move or set_tcp",
                });
            }
            Moves::new(&mut program, source, file).list(&reader.notes);
            program.numbers.append(&mut reader.notes.numbers);
        }
        Ok(program)
    }

    fn roles(&self, layout: Layout) -> &'static [Role] {
        match layout.shape {
            Shape::Pose => &POSE_ROLES,
            Shape::Joints => &[Role::Joint; 6],
        }
    }

    fn decimals(&self, role: Role, millimetre_decimals: usize) -> usize {
        match role {
            // metres; and radians, of which a millionth is a thousandth of a millimetre at one metre
            Role::Position | Role::Orientation | Role::Joint => millimetre_decimals + 3,
            Role::Configuration => 0,
        }
    }

    fn decode(&self, layout: Layout, numbers: &[f64], _: &Settings) -> Decoded {
        let n: [f64; 6] = numbers.try_into().expect("every target has six numbers");
        let degrees = layout.variant == 1;
        let value = match layout.shape {
            Shape::Pose => Value::Pose(rotation::pose(n, degrees)),
            Shape::Joints => {
                Value::Joints(n.map(|angle| if degrees { angle * DEG } else { angle }))
            }
        };
        Decoded {
            value,
            configuration: Configuration::default(),
        }
    }

    fn encode(
        &self,
        layout: Layout,
        value: &Value,
        _: &Posture,
        _: &Posture,
        _: &Settings,
        numbers: &mut [f64],
    ) {
        let degrees = layout.variant == 1;
        let new = match (layout.shape, value) {
            (Shape::Pose, Value::Pose(pose)) => {
                let present: &[f64; 6] = (&*numbers).try_into().expect("a pose has six numbers");
                rotation::numbers(pose, *present, degrees)
            }
            (Shape::Joints, Value::Joints(joints)) => {
                joints.map(|angle| if degrees { angle / DEG } else { angle })
            }
            _ => panic!("a value of the other shape"),
        };
        numbers.copy_from_slice(&new);
    }

    fn pace(&self, source: &Source, motion: &Move) -> Pace {
        pace::pace(&source.bytes, motion.offset as usize)
    }

    fn insert(
        &self,
        sources: &[Source],
        program: &Program,
        _: usize,
        insertions: &[Insertion],
    ) -> Inserted {
        Inserted::each(insertions, |one| insert::insert(sources, program, one))
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        sniff::mark(source, marker)
    }
}

/// No text has a zero byte, and places are kept in 32 bits.
fn check_bytes(source: &Source) -> Result<(), ReadError> {
    let limit = u32::MAX as usize;
    let (file, size) = (source.name.clone(), source.bytes.len());
    if size >= limit {
        return Err(ReadError::TooLarge { file, size, limit });
    }
    match memchr::memchr(0, &source.bytes) {
        Some(offset) => Err(ReadError::Binary {
            file,
            byte: 0,
            offset,
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
