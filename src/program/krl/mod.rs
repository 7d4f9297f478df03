//! KUKA KRL: programs (.src), data lists (.dat), submit programs (.sub).
//!
//! A position is `{X ..,Y ..,Z ..,A ..,B ..,C ..,S ..,T ..,E1 ..}`, mm and degrees, `R = Rz(A) · Ry(B) · Rx(C)`; S and T tell
//! the inverse solution (`status`) where the move is a PTP. Axes are `{A1 ..,...,A6 ..,E1 ..}`, degrees. External axes
//! stay as they are. The pose is that of $TOOL in $BASE, and both are variables of the controller: what they are at a move
//! is worked out over branches, loops and calls (`flow`), from $TOOL and $BASE themselves, BAS, FDAT of inline forms, WITH,
//! `TOOL_DATA` and `BASE_DATA` (`places`). Files of one name are one module; `$config.dat` and GLOBAL data are seen everywhere.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! For joint targets, which stay unless asked for, the first twelve are warnings.
//!
//! # Limits
//!
//! Positions in structures, routines called by interrupts and triggers, and sensor corrections are not followed. A routine
//! outside the files is taken to change tool or base only where moves use more than one.

mod aggregate;
mod findings;
mod flow;
mod insert;
mod moves;
mod notes;
mod pace;
mod places;
mod reader;
mod sniff;
mod state;
mod statements;
mod status;
mod tokens;
mod world;

use super::{
    About, Decoded, Language, Layout, Marker, Posture, Program, ReadError, Role, Settings, Shape,
    Source, Value,
};
use crate::finding::Severity;
use crate::geometry::Rotation;
use crate::geometry::units::{DEG, mm_from_m};
use crate::program::{Configuration, Inserted, Insertion, Move, Pace};
use findings::{Cause, Report};
use moves::Moves;
use notes::{DataKind, Index, Notes};
use reader::Reader;
use tokens::{Place, index};
use world::World;

/// KUKA KRL.
#[derive(Debug)]
pub struct Krl;

static ABOUT: About = About {
    id: "krl",
    name: "KUKA KRL",
    extensions: &["src", "dat", "sub"],
    rewrites: &[
        "E6POS, E3POS, POS and FRAME that moves go to: in data lists, GLOBAL, in $config.dat, arrays, and written out in \
         PTP, LIN, CIRC, SPTP, SLIN, SCIRC, SPL",
        "E6AXIS and AXIS targets",
        "S and T, where an axis crosses zero or the arm changes sides",
    ],
    leaves: &[
        "external axes, FDAT, PDAT, LDAT, tools, bases, loads, workspaces, machine data",
        "folds of inline forms, comments, strings, line ends, encoding, header",
    ],
    refuses: &[
        "targets that the running program changes, with expressions or without some of X Y Z A B C",
        "tools and bases that only the running program knows",
        "fixed tools (#TCP), bases on other kinematics",
        "points of absolutely accurate robots (S bit 4)",
        "_REL moves from unknown positions, products of frames without one known position",
    ],
};

/// Characters of a line that the controller takes.
const LONGEST_LINE: usize = 471;
/// Characters that a number may grow by.
const GROWTH: usize = 8;

const POSE_ROLES: [Role; 8] = [
    Role::Position,
    Role::Position,
    Role::Position,
    Role::Orientation,
    Role::Orientation,
    Role::Orientation,
    Role::Configuration,
    Role::Configuration,
];

/// Whether S and T stand in a position of this variant.
fn status_and_turn(layout: Layout) -> (bool, bool) {
    (layout.variant & 1 != 0, layout.variant & 2 != 0)
}

impl Language for Krl {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        sniff::recognises(&source.bytes)
    }

    fn read(&self, sources: &[Source], settings: &Settings) -> Result<Program, ReadError> {
        let mut notes = Notes::default();
        for (file, source) in sources.iter().enumerate() {
            check_bytes(source)?;
            if !sniff::recognises(&source.bytes) {
                return Err(ReadError::NotThisLanguage {
                    file: source.name.clone(),
                    language: ABOUT.name,
                    missing: "DEF, DEFDAT, a header (&ACCESS) or a move",
                });
            }
            Reader::read(source, index(file), &mut notes)
                .map_err(|fault| fault.in_source(source))?;
        }
        Ok(resolve(sources, notes, settings))
    }

    fn roles(&self, layout: Layout) -> &'static [Role] {
        let count = 6 + layout.variant.count_ones() as usize;
        match layout.shape {
            Shape::Pose => &POSE_ROLES[..count.min(POSE_ROLES.len())],
            Shape::Joints => &[Role::Joint; 6],
        }
    }

    fn decimals(&self, role: Role, millimetre_decimals: usize) -> usize {
        match role {
            Role::Position => millimetre_decimals,
            // a hundredth of a degree is 0.17 mm at one metre
            Role::Orientation | Role::Joint => millimetre_decimals + 2,
            Role::Configuration => 0,
        }
    }

    fn decode(&self, layout: Layout, numbers: &[f64], _: &Settings) -> Decoded {
        if layout.shape == Shape::Joints {
            let n: &[f64; 6] = numbers.try_into().expect("six joint angles");
            return Decoded {
                value: Value::Joints(n.map(|degrees| degrees * DEG)),
                configuration: Configuration::default(),
            };
        }
        let pose = places::pose_of(std::array::from_fn(|i| numbers[i]));
        let (status, turn) = bits_of(layout, numbers);
        Decoded {
            value: Value::Pose(pose),
            configuration: status::configuration(status, turn),
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
                let present = [numbers[3], numbers[4], numbers[5]];
                numbers[..3].copy_from_slice(&pose.translation.map(mm_from_m));
                numbers[3..6].copy_from_slice(&angles(&pose.rotation, present));
                let (status, turn) = bits_of(layout, numbers);
                if let Some(status) = status {
                    numbers[6] = f64::from(status::update_status(before, after, status));
                }
                if let Some(turn) = turn {
                    let last = numbers.len() - 1;
                    numbers[last] = f64::from(status::update_turn(before, after, turn));
                }
            }
            (Shape::Joints, Value::Joints(joints)) => {
                numbers.copy_from_slice(&joints.map(|angle| angle / DEG));
            }
            _ => panic!("a value of the other shape"),
        }
    }

    fn write_configuration(&self, _: Layout, _: usize, value: f64, old: &[u8], out: &mut Vec<u8>) {
        status::write(whole(value), old, out);
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

/// S and T of a position.
fn bits_of(layout: Layout, numbers: &[f64]) -> (Option<u32>, Option<u32>) {
    let (status, turn) = status_and_turn(layout);
    (
        status.then(|| whole(numbers[6])),
        turn.then(|| whole(numbers[numbers.len() - 1])),
    )
}

/// S or T, which the reader checked to be whole and small.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn whole(value: f64) -> u32 {
    value as u32
}

/// A, B, C in degrees: of all that make this rotation those nearest to the present ones, within ±180 where these are.
fn angles(rotation: &Rotation, present: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = rotation.rzryrx(present[2] * DEG).map(|angle| angle / DEG);
    let turned = |angle: f64, present: f64| {
        let near = angle + 360.0 * ((present - angle) / 360.0).round();
        if present.abs() <= 180.0 && near.abs() > 180.0 {
            near - 360.0_f64.copysign(near)
        } else {
            near
        }
    };
    let near =
        |angles: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| turned(angles[i], present[i])) };
    let distance = |angles: &[f64; 3]| -> f64 {
        let gap = |i: usize| {
            let gap = (angles[i] - present[i]).rem_euclid(360.0);
            gap.min(360.0 - gap)
        };
        (0..3).map(gap).fold(0.0, f64::max)
    };
    // B beyond ±90 turns A and C by half
    let (first, second) = (near([a, b, c]), near([a + 180.0, 180.0 - b, c + 180.0]));
    if distance(&first) <= distance(&second) {
        first
    } else {
        second
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

/// Puts together what was noted of all files.
fn resolve(sources: &[Source], notes: Notes, settings: &Settings) -> Program {
    let mut world = World::new(notes);
    let flows = flow::flows(&world);
    let (mut moves, states) = Moves::new(&world, Report::new(sources), flows);
    moves.list(&states);
    passed_targets(&world, &mut moves);
    assigned_targets(&world, &mut moves);
    unused_targets(&world, &mut moves);
    moves.flaws();
    let Moves {
        mut report, kept, ..
    } = moves;
    marked_targets(&world, &mut report, &kept, settings);
    long_lines(sources, &world, &mut report, &kept);
    report.program.numbers = std::mem::take(&mut world.notes.numbers);
    report.finish(&kept)
}

/// Blocks targets that are handed to routines.
fn passed_targets(world: &World, moves: &mut Moves) {
    for passed in &world.notes.passed {
        let callee = world.notes.symbols.spelling(passed.callee);
        for datum in world.candidates(passed.name, passed.context) {
            if !matches!(
                world.declared(datum).kind,
                DataKind::Position | DataKind::Frame
            ) {
                continue;
            }
            let at = if passed.index == Index::Whole {
                Index::Variable
            } else {
                passed.index
            };
            let (first, last) = world.range(datum, at);
            for value in first..last {
                if let notes::Stored::Target(target) = world.value(value).1 {
                    // a frame that no move goes to is an offset
                    let is_position = world.declared(datum).kind == DataKind::Position;
                    moves.kept[target] |= is_position;
                    let cause = Cause::Passed;
                    moves.report.block(target, cause, passed.place, callee);
                }
            }
        }
    }
}

/// Blocks targets that statements assign, and reports those that others are computed from.
fn assigned_targets(world: &World, moves: &mut Moves) {
    let mut blocked = std::collections::HashSet::new();
    for assigned in &world.notes.assigned {
        let spelled = world.notes.symbols.spelling(assigned.name);
        let key = (assigned.name, assigned.index, assigned.context);
        if blocked.insert(key) {
            moves.block_name(
                assigned.name,
                assigned.index,
                assigned.context,
                Cause::Assigned,
                assigned.place,
                spelled,
            );
        }
        for &other in &world.notes.mentions[notes::indices(assigned.mentions)] {
            let is_position = world.kind(other, assigned.context) == Some(DataKind::Position);
            let lead = world.lead(other, Index::Variable, assigned.context);
            if other != assigned.name && is_position && matches!(lead, world::Lead::Values { .. }) {
                let other = world.notes.symbols.spelling(other);
                let message = format!(
                    "{spelled} is computed from {other}, which may be compensated for other moves"
                );
                let hint = "look where the new position is used";
                let (id, severity) = ("target-copied", Severity::Warning);
                moves
                    .report
                    .say(id, severity, assigned.place, message, hint);
            }
        }
    }
}

/// Decides about targets that no move goes to: those that other files may use are kept, those of a data list whose program
/// is there are not.
fn unused_targets(world: &World, moves: &mut Moves) {
    for (datum, target) in world.named_targets() {
        if moves.kept[target] {
            continue;
        }
        let declared = world.declared(datum);
        let module = &world.notes.modules[declared.context.module as usize];
        if declared.kind != DataKind::Position || module.is_system || world.is_assigned(datum) {
            continue;
        }
        if declared.global || !module.has_source {
            moves.kept[target] = true;
            continue;
        }
        let found = &world.notes.targets[target];
        let place = Place {
            file: found.file,
            offset: found.offset,
        };
        let name = found.name.as_deref().unwrap_or("the target");
        let message = format!("no move of this program goes to {name}; it stays as it is");
        moves
            .report
            .say("target-never-used", Severity::Note, place, message, "");
    }
}

/// Blocks points of absolutely accurate robots; where they are to be rewritten, says so once a file.
fn marked_targets(world: &World, report: &mut Report, kept: &[bool], settings: &Settings) {
    let mut said = std::collections::HashSet::new();
    for (id, target) in world.notes.targets.iter().enumerate() {
        let (has_status, _) = status_and_turn(target.layout);
        if !kept[id] || !has_status {
            continue;
        }
        let status = world.notes.numbers[target.numbers.start as usize + 6].value;
        if whole(status) & status::ABSOLUTELY_ACCURATE == 0 {
            continue;
        }
        let place = Place {
            file: target.file,
            offset: target.offset,
        };
        if !settings.accept_absolutely_accurate {
            report.block(id, Cause::AbsolutelyAccurate, place, "");
        } else if said.insert(target.file) {
            let message = "S of this target has bit 4 (16): taught on an absolutely accurate robot; it is compensated all \
                           the same, as all of its kind in this file";
            let hint =
                "the correction of the controller must be off, or the robot is corrected twice";
            let (id, severity) = ("absolutely-accurate", Severity::Warning);
            report.say(id, severity, place, message.to_owned(), hint);
        }
    }
}

/// Warns where new numbers may make a line too long.
fn long_lines(sources: &[Source], world: &World, report: &mut Report, kept: &[bool]) {
    for (id, target) in world.notes.targets.iter().enumerate() {
        if !kept[id] || target.numbers.is_empty() {
            continue;
        }
        let bytes = &sources[target.file as usize].bytes;
        let at = target.offset as usize;
        let limit = LONGEST_LINE - GROWTH * target.numbers.len();
        let from = at.saturating_sub(LONGEST_LINE);
        let start =
            memchr::memrchr2(b'\n', b'\r', &bytes[from..at]).map_or(from, |end| from + end + 1);
        let rest = &bytes[at..bytes.len().min(at + LONGEST_LINE)];
        let end = memchr::memchr2(b'\n', b'\r', rest).map_or(at + rest.len(), |end| at + end);
        if end - start > limit {
            let place = Place {
                file: target.file,
                offset: target.offset,
            };
            let message = format!(
                "this line has {} characters; with new numbers it may exceed the {LONGEST_LINE} that the controller takes",
                end - start
            );
            report.say(
                "long-line",
                Severity::Warning,
                place,
                message,
                "split the line",
            );
        }
    }
}

#[cfg(test)]
mod tests;
