//! KUKA KRL: programs (.src), data lists (.dat), submit programs (.sub).
//!
//! A position is `{X ..,Y ..,Z ..,A ..,B ..,C ..,S ..,T ..,E1 ..}`, mm and degrees, `R = Rz(A) ·
//! Ry(B) · Rx(C)`; S and T tell the inverse solution (`status`) where the move is a PTP. Axes are
//! `{A1 ..,...,A6 ..,E1 ..}`, degrees. External axes stay as they are; what they carry the
//! profile says (docs/external-axes.md). The pose is that of $TOOL in $BASE. Both are variables of the controller, as
//! are $LOAD, `$IPO_MODE`, what `FDAT_ACT` holds, and the entries of `TOOL_DATA`, `BASE_DATA`,
//! `LOAD_DATA` (`frames`); `$TOOL=`, BAS, inline forms and WITH write them (`states`). Positions
//! that a statement writes, or that are parameters, are variables too (`targets`); what of it
//! reaches a move is worked out in [`crate::motion`].
//!
//! Files of one name are one module; `$config.dat` and GLOBAL data are seen everywhere. Of a data
//! list everything keeps its value from one run to the next. Routines of interrupts and triggers,
//! and submit programs, run at any time.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! What a sensor adds to moves is reported and not followed (`sensors`). A routine outside the files is
//! taken to change tool or base only where moves use more than one. An arc to an angle (CA) is
//! refused.

mod aggregate;
mod asked;
mod assignments;
mod calls;
mod components;
mod data;
mod deciding;
mod drive;
mod fdat;
mod frames;
mod given;
mod guards;
mod insert;
mod interrupts;
mod moves;
mod names;
mod numbers;
mod points;
mod quiet;
mod reader;
mod remarks;
mod sensors;
mod sniff;
mod statements;
mod states;
mod status;
mod structures;
mod targets;
mod tokens;
mod turning;

use super::kit::{has_ending, not_this_language};
use super::notation;
use super::script::{NamedFrame, Part, Remark, Script, short};
use super::{
    About, Configuration, Deciding, Inserted, Insertions, Language, Layout, Marker, Posture,
    ReadError, Role, Settings, Source, Step,
};
use crate::geometry::Pose;
use reader::Reader;

/// KUKA KRL.
#[derive(Debug)]
pub struct Krl;

static ABOUT: About = About {
    id: "krl",
    name: "KUKA KRL",
    extensions: &["src", "dat", "sub"],
    rewrites: &[
        "E6POS, E3POS, POS and FRAME that moves go to: in data lists, GLOBAL, in $config.dat, \
         arrays, and written out in \
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
    has: "DEF, DEFDAT, header (&ACCESS) or move",
};

/// Characters of a line that the controller takes.
const LONGEST_LINE: usize = 471;
/// Characters that a number may grow by.
const GROWTH: usize = 8;

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

    fn may_be_foreign(&self, source: &Source) -> bool {
        has_ending(&source.name, "dat") && !sniff::has_words(&source.bytes)
    }

    fn script(&self, sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
        script(sources, settings)
    }

    fn frame_of(
        &self,
        _: bool,
        name: &str,
        parts: &[Part],
        _: &[Source],
    ) -> Result<Result<NamedFrame, Remark>, ReadError> {
        Ok(frames::frame_of(name, parts))
    }

    fn pose_roles(&self, layout: Layout) -> &'static [Role] {
        &notation::WITH_ANGLES[..6 + layout.variant.count_ones() as usize]
    }

    fn pose_of(&self, _: Layout, numbers: &[f64]) -> Pose {
        frames::pose_of(std::array::from_fn(|i| numbers[i]))
    }

    fn write_pose(&self, _: Layout, pose: &Pose, numbers: &mut [f64]) {
        frames::write_pose(pose, numbers);
    }

    fn configuration(&self, layout: Layout, numbers: &[f64]) -> Configuration {
        let (status, turn) = bits_of(layout, numbers);
        status::configuration(status, turn)
    }

    fn update_configuration(
        &self,
        layout: Layout,
        before: &Posture,
        after: &Posture,
        numbers: &mut [f64],
    ) {
        let (status, turn) = bits_of(layout, numbers);
        if let Some(status) = status {
            numbers[6] = f64::from(status::update_status(before, after, status));
        }
        if let Some(turn) = turn {
            let last = numbers.len() - 1;
            numbers[last] = f64::from(status::update_turn(before, after, turn));
        }
    }

    fn write_configuration(&self, _: Layout, _: usize, value: f64, old: &[u8], out: &mut Vec<u8>) {
        status::write(whole(value), old, out);
    }

    fn insert(&self, into: &Insertions) -> Inserted {
        insert::MANNER.insert(into)
    }

    fn forbids_repeating(&self, text: &[u8]) -> Option<&'static str> {
        (insert::MANNER.forbids)(text)
    }

    fn is_in_form(&self, bytes: &[u8], at: usize) -> bool {
        insert::is_in_form(bytes, at)
    }

    fn drive(&self, steps: &[Step], _: &Settings) -> Option<String> {
        Some(drive::drive(steps))
    }

    fn deciding(&self) -> Option<&'static Deciding> {
        Some(&deciding::MANNER)
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        sniff::mark(source, marker)
    }
}

/// All files into one script: what they declare, then what they do.
fn script(sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
    let mut reader = Reader::new(settings);
    for source in sources {
        reader.types(source);
    }
    for (file, source) in sources.iter().enumerate() {
        if !sniff::recognises(&source.bytes) {
            return Err(not_this_language(&ABOUT, source));
        }
        let read = reader.declarations(source, short(file));
        read.map_err(|fault| fault.in_source(source))?;
    }
    reader.settle();
    for (file, source) in sources.iter().enumerate() {
        let read = reader.statements(source, short(file));
        read.map_err(|fault| fault.in_source(source))?;
    }
    reader.link_actions();
    Ok(reader.finish(sources, settings))
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

#[cfg(test)]
mod tests;
