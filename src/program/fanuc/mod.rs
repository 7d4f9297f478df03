//! FANUC TP: program listings (.LS), with the tools and user frames of SYSFRAME.VA or FRAME.DG where these are given too.
//!
//! A point is `P[n]{ GP1: UF : f, UT : t, CONFIG : '…', X = …, … W = …, P = …, R = … };`, mm and degrees, `Rz(R)·Ry(P)·Rx(W)`;
//! or J1 to J6 in degrees. It is the pose of tool t in user frame f; both are numbers, and 0 is the flange and the world.
//! `F` for a number is the one that `UTOOL_NUM` and `UFRAME_NUM` select; where the program selects none before, the tool or frame
//! is called `F`, and the user says where it is. Only group 1 is read and written; J3 of joint points is
//! FANUC's, measured from the horizontal (the profile's coupling). Listings of any dictionary are read: UF, UT and the names
//! of coordinates are in all of them, the configuration data are the only string in a group.
//!
//! Numbers stand in fields of a fixed width; a new number keeps the field's last column. The remarks that mark a
//! compensated program are explained in [`mark`].
//!
//! # Statements
//!
//! Each program is a routine. `CALL` and `RUN` bind to the programs in the files; `LBL`, `JMP`, `IF`, `SELECT`, `FOR`, `Skip,LBL` and
//! `TIMEOUT,LBL` are its flow; a word that nobody knows is a macro, which may select another tool. Tools, user frames, the numbers that
//! select them and position registers are variables that the controller keeps. A move to `PR[n]` goes with the active tool and
//! frame; where `PR[n]` is a copy of a point it goes to that point, beside it where something was added or one number changed. The
//! controller goes to a point only where the numbers are selected that it was taught with (else MOTN-018), so that
//! behind such a move they are the active ones.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! A move with `Offset`, `Tool_Offset` or `VOFFSET` goes to a point that only the running program knows: it takes the
//! correction of its point along, which is told as `displacement-unknown`. Where the robot stands behind a move that `Skip` or
//! `Search[…]` ended is unknown.
//!
//! # Limits
//!
//! Registers `R[n]` are not followed: what they select is unknown. A program that a local condition of a move (TB, TA) calls is
//! taken to run behind the move. `PAYLOAD` is not read: a tool's load is the profile's. A translated INC, RTCP, COORD, IF or CALL is
//! known in German only. That moves other than J stop where CONFIG names another posture than the path ends in (MOTN-063), and
//! MOTN-018, are *not verified on a controller*.

mod angles;
mod config;
mod constants;
mod controller;
mod drive;
mod frames;
mod insert;
mod lines;
pub mod mark;
mod moves;
mod points;
mod reader;
mod sections;
mod statements;
mod words;

use super::{
    About, Configuration, Decoded, Inserted, Insertion, Language, Layout, Marker, Posture, Program,
    ReadError, Role, Script, Settings, Shape, Source, Step, Value,
};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use points::{Fault, POSE_NUMBERS};
use sections::Sections;

/// FANUC TP.
#[derive(Debug)]
pub struct Fanuc;

static ABOUT: About = About {
    id: "fanuc",
    name: "FANUC TP",
    extensions: &["ls", "va", "dg"],
    rewrites: &[
        "points P[n] of group 1: X Y Z W P R, and J1 to J6",
        "CONFIG flags and turns, where an axis leaves its turn or the arm changes sides",
    ],
    leaves: &[
        "groups 2 and up, extended axes at zero, instructions, names, attributes, line ends, encoding",
        "points that no move uses",
        "moves to position registers that are no copies of points, with a warning",
        "offsets of moves (Offset, Tool_Offset, VOFFSET): the moved point takes the correction along, a warning says so",
        "SYSFRAME.VA and FRAME.DG, which tell tools and user frames",
    ],
    refuses: &[
        "increments (INC), moves with RTCP, COORD or line tracking, extended axes away from zero",
        "points that were never taught, or of robots with other axes",
        "tools and user frames that the running program assigns or chooses",
    ],
};

const POSE_ROLES: [Role; POSE_NUMBERS] = [
    Role::Position,
    Role::Position,
    Role::Position,
    Role::Orientation,
    Role::Orientation,
    Role::Orientation,
    Role::Configuration,
    Role::Configuration,
    Role::Configuration,
    Role::Configuration,
    Role::Configuration,
    Role::Configuration,
];
/// Numbers of a pose without configuration data.
const PLAIN: usize = 6;

impl Language for Fanuc {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        let bytes = &source.bytes;
        memchr::memchr(0, &bytes[..bytes.len().min(1 << 16)]).is_none()
            && (Sections::of(bytes).is_some() || frames::kind(bytes).is_some())
    }

    fn script(&self, sources: &[Source], _: &Settings) -> Result<Script, ReadError> {
        reader::script(sources)
    }

    fn roles(&self, layout: Layout) -> &'static [Role] {
        match (layout.shape, layout.variant) {
            (Shape::Pose, 0) => &POSE_ROLES,
            (Shape::Pose, _) => &POSE_ROLES[..PLAIN],
            (Shape::Joints, _) => &[Role::Joint; 6],
        }
    }

    fn decimals(&self, role: Role, millimetre_decimals: usize) -> usize {
        match role {
            Role::Position => millimetre_decimals,
            Role::Orientation | Role::Joint => millimetre_decimals + 2,
            Role::Configuration => 0,
        }
    }

    /// Fields of a fixed width have three decimals.
    fn least_decimals(&self, role: Role) -> usize {
        match role {
            Role::Position | Role::Orientation | Role::Joint => 3,
            Role::Configuration => 0,
        }
    }

    fn decode(&self, layout: Layout, numbers: &[f64], _: &Settings) -> Decoded {
        let first: [f64; PLAIN] = numbers[..PLAIN].try_into().expect("six numbers at least");
        match layout.shape {
            Shape::Pose => {
                let [x, y, z, w, p, r] = first;
                let pose = Pose {
                    rotation: angles::rotation([w, p, r]),
                    translation: [x, y, z].map(m_from_mm),
                };
                let data: Option<&[f64; 6]> = numbers[PLAIN..].try_into().ok();
                Decoded {
                    value: Value::Pose(pose),
                    configuration: data.map_or_else(Configuration::default, config::configuration),
                }
            }
            Shape::Joints => Decoded {
                value: Value::Joints(first.map(|degrees| degrees * DEG)),
                configuration: Configuration::default(),
            },
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
                numbers[3..PLAIN].copy_from_slice(&angles::nearest(&pose.rotation, present));
                config::update(before, after, &mut numbers[PLAIN..]);
            }
            (Shape::Joints, Value::Joints(joints)) => {
                numbers.copy_from_slice(&joints.map(|angle| angle / DEG));
            }
            _ => panic!("a value of the other shape"),
        }
    }

    fn write_configuration(
        &self,
        _: Layout,
        index: usize,
        value: f64,
        old: &[u8],
        out: &mut Vec<u8>,
    ) {
        config::write(index - PLAIN, value, old, out);
    }

    fn insert(
        &self,
        sources: &[Source],
        program: &Program,
        file: usize,
        insertions: &[Insertion],
    ) -> Inserted {
        insert::insert(&sources[file], program, file, insertions)
    }

    fn drive(&self, steps: &[Step], _: &Settings) -> Option<String> {
        Some(drive::drive(steps))
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        mark::mark(source, marker)
    }
}

/// A fault with its place in words.
fn in_source(fault: &Fault, source: &Source) -> ReadError {
    let (Fault::Unclosed { at, .. } | Fault::Unexpected { at, .. } | Fault::BadValue { at, .. }) =
        *fault;
    let (line, column) = source.line_column(at);
    let file = source.name.clone();
    match *fault {
        Fault::Unclosed { what, .. } => ReadError::Unclosed {
            file,
            line,
            column,
            what,
        },
        Fault::Unexpected { expected, .. } => ReadError::Unexpected {
            file,
            line,
            column,
            found: found(&source.bytes[at..]),
            expected,
        },
        Fault::BadValue { length, .. } => ReadError::BadValue {
            file,
            line,
            column,
            value: found(&source.bytes[at..at + length]),
            meaning: "coordinate, or number of a tool or frame",
            limit: "a plain number of at most 1000000 is wanted; angles of tools and frames go to 720 deg, their numbers to 255",
        },
    }
}

/// What stands at a place, in words.
fn found(rest: &[u8]) -> String {
    let word = rest
        .split(u8::is_ascii_whitespace)
        .next()
        .unwrap_or_default();
    match word {
        [] if rest.is_empty() => "the end of the file".into(),
        [] => "nothing".into(),
        word => format!("`{}`", Source::text(&word[..word.len().min(20)])),
    }
}

#[cfg(test)]
mod tests;
