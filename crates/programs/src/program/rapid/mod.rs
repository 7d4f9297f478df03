//! ABB RAPID: modules (.mod, .modx, .prg) and system modules (.sys, .sysx).
//!
//! A robtarget is `[[x, y, z], [q1, q2, q3, q4], [cf1, cf4, cf6, cfx], [external axes]]`, mm and a
//! unit quaternion with its scalar first; a jointtarget is `[[six joints], [external axes]]`,
//! degrees. External axes stay as they are. The pose is that of the tool in `uframe · oframe` of
//! the work object of the move, not of the declaration.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! Targets computed inside records, Load at run time of modules that are not given, and functions
//! that move are not followed.

mod aggregate;
mod ahead;
mod arguments;
mod asked;
mod axes;
mod behind;
mod blocks;
mod builtins;
mod by_calls;
mod by_name;
mod calls;
mod conditions;
mod confdata;
mod deciding;
mod declarations;
mod derived;
mod drive;
mod elements;
mod errors;
mod expressions;
mod grips;
mod handlers;
mod insert;
mod modes;
mod moves;
mod numbers;
mod parts;
mod places;
mod poses;
mod reader;
mod records;
mod resolved;
mod shared;
mod sniff;
mod syntax;
mod tasks;
mod tokens;
mod translate;
mod values;
mod verbs;

use super::kit::{has_ending, not_this_language};
use super::names::Symbols;
use super::notation;
use super::script::{NamedFrame, Part, Remark, Script, short};
use super::{
    About, Configuration, Deciding, Inserted, Insertions, Language, Layout, Marker, Posture,
    ReadError, Role, Settings, Shape, Source, Step,
};
use crate::geometry::Pose;
use crate::geometry::units::DEG;
use arguments::NOT_CONNECTED;
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
        "robtargets: CONST, PERS, VAR, LOCAL, TASK, arrays, and written out in any Move, Arc, \
         Trigg or Search instruction",
        "jointtargets of MoveAbsJ",
        "confdata, where an axis leaves its quarter revolution or the arm changes sides",
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
    has: "module, data of robots, routine or move",
};

impl Language for Rapid {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        sniff::recognises(&source.bytes)
    }

    fn may_be_foreign(&self, source: &Source) -> bool {
        has_ending(&source.name, "sys") && !sniff::has_words(&source.bytes)
    }

    fn script(&self, sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
        script(sources, settings)
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

    /// Speed data of ABB's own have 500 deg/s (Technical reference manual, RAPID, `speeddata`).
    fn rotation_speed_rad_s(&self) -> Option<f64> {
        Some(500.0 * DEG)
    }

    fn decimals(&self, role: Role, millimetre_decimals: usize) -> usize {
        match role {
            Role::Position => millimetre_decimals,
            // a thousandth of a millimetre is a millionth of a quaternion part at one metre, 6e-5
            // degrees
            Role::Orientation => millimetre_decimals + 3,
            Role::Joint => millimetre_decimals + 2,
            Role::Configuration => 0,
        }
    }

    /// `CirPathMode\PathFrame`
    fn turns_with_path(&self) -> bool {
        true
    }

    fn pose_roles(&self, _: Layout) -> &'static [Role] {
        &notation::WITH_QUATERNION
    }

    fn pose_of(&self, _: Layout, numbers: &[f64]) -> Pose {
        notation::pose_of_quaternion(numbers)
    }

    fn write_pose(&self, _: Layout, pose: &Pose, numbers: &mut [f64]) {
        notation::write_quaternion(pose, numbers);
    }

    fn configuration(&self, _: Layout, numbers: &[f64]) -> Configuration {
        confdata::configuration([numbers[7], numbers[8], numbers[9], numbers[10]])
    }

    fn update_configuration(
        &self,
        _: Layout,
        before: &Posture,
        after: &Posture,
        numbers: &mut [f64],
    ) {
        let of = confdata::confdata;
        notation::update(of, confdata::JOINTS, before, after, &mut numbers[7..]);
    }

    fn insert(&self, into: &Insertions) -> Inserted {
        insert::MANNER.insert(into)
    }

    fn forbids_repeating(&self, text: &[u8]) -> Option<&'static str> {
        (insert::MANNER.forbids)(text)
    }

    fn deciding(&self) -> Option<&'static Deciding> {
        Some(&deciding::MANNER)
    }

    fn external_names(&self) -> [&'static str; 6] {
        EXTERNAL
    }

    fn drive(&self, steps: &[Step], _: &Settings) -> Option<String> {
        Some(drive::drive(steps))
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        sniff::mark(source, marker)
    }
}

/// External axes in their order.
const EXTERNAL: [&str; 6] = ["eax_a", "eax_b", "eax_c", "eax_d", "eax_e", "eax_f"];

/// Reads what all files say.
fn parse(sources: &[Source], symbols: Symbols, verbs: &mut Verbs) -> Result<Parsed, ReadError> {
    let mut parsed = Parsed {
        symbols,
        ..Parsed::default()
    };
    for (file, source) in sources.iter().enumerate() {
        let recognised = Reader::read(source, short(file), &mut parsed, verbs)
            .map_err(|fault| fault.in_source(source))?;
        if !recognised {
            return Err(not_this_language(&ABOUT, source));
        }
    }
    Ok(parsed)
}

/// Reads what all files say, then puts it together.
fn script(sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
    let mut verbs = Verbs::default();
    let mut parsed = parse(sources, Symbols::default(), &mut verbs)?;
    if verbs.hide(&parsed.routines) {
        parsed = parse(sources, parsed.symbols, &mut verbs)?;
    }
    let groups = shared::groups(&parsed, sources);
    let mut script = Script {
        targets: std::mem::take(&mut parsed.targets),
        numbers: std::mem::take(&mut parsed.numbers),
        ..Script::default()
    };
    let resolved = Resolved::new(parsed, verbs, &groups, sources);
    let mut dead = HashSet::new();
    for bad in &resolved.parsed.bad_values {
        let target = &mut script.targets[bad.target];
        // a rotation of zeros, and joints of 9E9, are data without a value: a move to them is an error of
        // the running program
        let numbers = &script.numbers[target.numbers.start as usize..target.numbers.end as usize];
        let is_blank = if target.layout.shape == Shape::Joints {
            numbers.iter().all(|number| number.value >= NOT_CONNECTED)
        } else {
            numbers.len() > 6 && numbers[3..7].iter().all(|number| number.value == 0.0)
        };
        if !resolved.may_be_another(bad.target, is_blank) {
            return Err(bad.fault.in_source(&sources[target.file as usize]));
        }
        // its value is that of the last run, or none yet
        (target.numbers, target.blocked) = (0..0, true);
        dead.insert(bad.target);
    }
    let mut script = translate::translate(&resolved, script, dead, settings);
    let several = tasks::second_robot(&script, sources);
    script.findings.extend(several);
    Ok(script)
}

#[cfg(test)]
mod tests;
