//! ABB RAPID: modules (.mod, .modx, .prg) and system modules (.sys, .sysx).
//!
//! A robtarget is `[[x, y, z], [q1, q2, q3, q4], [cf1, cf4, cf6, cfx], [external axes]]`, mm and a unit quaternion with its
//! scalar first; a jointtarget is `[[six joints], [external axes]]`, degrees. External axes stay as they are. The pose is that
//! of the tool in `uframe · oframe` of the work object of the move, not of the declaration.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! Targets inside records, Load at run time of modules that are not given, and functions that move are not followed.

mod aggregate;
mod arguments;
mod blocks;
mod builtins;
mod calls;
mod confdata;
mod declarations;
mod drive;
mod expressions;
mod handlers;
mod insert;
mod moves;
mod reader;
mod records;
mod resolved;
mod sniff;
mod syntax;
mod tokens;
mod translate;
mod values;
mod verbs;

use super::kit::check_bytes;
use super::script::{NamedFrame, Part, Remark, Script, short};
use super::{
    About, Decoded, Language, Layout, Marker, Posture, Program, ReadError, Role, Settings, Shape,
    Source, Step, Value,
};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Quaternion};
use crate::program::{Configuration, Inserted, Insertion};
use foldhash::{HashSet, HashSetExt};
use reader::Reader;
use resolved::Resolved;
use syntax::Parsed;
use verbs::Verbs;

/// ABB RAPID.
#[derive(Debug)]
pub struct Rapid;

static ABOUT: About = About {
    id: "rapid",
    name: "ABB RAPID",
    extensions: &["mod", "modx", "prg", "sys", "sysx"],
    rewrites: &[
        "robtargets: CONST, PERS, VAR, LOCAL, TASK, arrays, and written out in any Move, Arc, Trigg or Search instruction",
        "jointtargets of MoveAbsJ",
        "confdata, where an axis leaves its quarter turn or the arm changes sides",
    ],
    leaves: &[
        "external axes, speeds, zones, tools, work objects, loads",
        "comments, strings, line ends, encoding, header",
    ],
    refuses: &[
        "targets that the running program changes, or with expressions in them",
        "tools and work objects that only the running program knows",
        "held work pieces, stationary tools, conveyors and other moving frames",
        "moves with a program displacement or external offset",
        "targets handed to routines, arrays of names of targets",
    ],
};

const POSE_ROLES: [Role; 11] = [
    Role::Position,
    Role::Position,
    Role::Position,
    Role::Orientation,
    Role::Orientation,
    Role::Orientation,
    Role::Orientation,
    Role::Configuration,
    Role::Configuration,
    Role::Configuration,
    Role::Configuration,
];

impl Language for Rapid {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        sniff::recognises(&source.bytes)
    }

    fn script(&self, sources: &[Source], _: &Settings) -> Result<Script, ReadError> {
        script(sources)
    }

    fn frame_of(
        &self,
        is_tool: bool,
        name: &str,
        parts: &[Part],
        sources: &[Source],
    ) -> Result<Result<NamedFrame, Remark>, ReadError> {
        records::frame_of(is_tool, name, parts, sources)
    }

    fn roles(&self, layout: Layout) -> &'static [Role] {
        match layout.shape {
            Shape::Pose => &POSE_ROLES,
            Shape::Joints => &[Role::Joint; 6],
        }
    }

    fn decimals(&self, role: Role, millimetre_decimals: usize) -> usize {
        match role {
            Role::Position => millimetre_decimals,
            // a thousandth of a millimetre is a millionth of a quaternion part at one metre, 6e-5 degrees
            Role::Orientation => millimetre_decimals + 3,
            Role::Joint => millimetre_decimals + 2,
            Role::Configuration => 0,
        }
    }

    fn decode(&self, layout: Layout, numbers: &[f64], _: &Settings) -> Decoded {
        match layout.shape {
            Shape::Pose => {
                let n: &[f64; 11] = numbers.try_into().expect("a pose has 11 numbers");
                let translation = [n[0], n[1], n[2]].map(m_from_mm);
                let rotation = Quaternion([n[3], n[4], n[5], n[6]]).normalized();
                Decoded {
                    value: Value::Pose(Pose::from_parts(translation, rotation)),
                    configuration: confdata::configuration([n[7], n[8], n[9], n[10]]),
                }
            }
            Shape::Joints => {
                let n: &[f64; 6] = numbers.try_into().expect("six joint angles");
                Decoded {
                    value: Value::Joints(n.map(|degrees| degrees * DEG)),
                    configuration: Configuration::default(),
                }
            }
        }
    }

    fn encode(
        &self,
        layout: Layout,
        value: &Value,
        before: &Posture,
        after: &Posture,
        _: &Settings,
        numbers: &mut [f64],
    ) {
        match (layout.shape, value) {
            (Shape::Pose, Value::Pose(pose)) => {
                let present = Quaternion([numbers[3], numbers[4], numbers[5], numbers[6]]);
                let new = pose.rotation.quaternion().nearest_to(&present);
                numbers[..3].copy_from_slice(&pose.translation.map(mm_from_m));
                numbers[3..7].copy_from_slice(&new.0);
                confdata::update(before, after, &mut numbers[7..]);
            }
            (Shape::Joints, Value::Joints(joints)) => {
                numbers.copy_from_slice(&joints.map(|angle| angle / DEG));
            }
            _ => panic!("a value of the other shape"),
        }
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

    fn drive(&self, steps: &[Step], _: &Settings) -> Option<String> {
        Some(drive::drive(steps))
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        sniff::mark(source, marker)
    }
}

/// Parsed what all files say, then puts it together.
fn script(sources: &[Source]) -> Result<Script, ReadError> {
    let (mut parsed, mut verbs) = (Parsed::default(), Verbs::default());
    for (file, source) in sources.iter().enumerate() {
        check_bytes(source)?;
        let recognised = Reader::read(source, short(file), &mut parsed, &mut verbs)
            .map_err(|fault| fault.in_source(source, "the file"))?;
        if !recognised {
            return Err(ReadError::NotThisLanguage {
                file: source.name.clone(),
                language: ABOUT.name,
                missing: "module, data of robots, routine or move",
            });
        }
    }
    let mut script = Script {
        targets: std::mem::take(&mut parsed.targets),
        numbers: std::mem::take(&mut parsed.numbers),
        ..Script::default()
    };
    let resolved = Resolved::new(parsed, verbs, sources);
    let mut dead = HashSet::new();
    for bad in &resolved.parsed.bad_values {
        let target = &mut script.targets[bad.target];
        if !resolved.is_written_target(bad.target) {
            return Err(bad
                .fault
                .in_source(&sources[target.file as usize], "the file"));
        }
        // its value is that of the last run, or none yet
        (target.numbers, target.blocked) = (0..0, true);
        dead.insert(bad.target);
    }
    Ok(translate::translate(&resolved, script, dead))
}

#[cfg(test)]
mod tests;
