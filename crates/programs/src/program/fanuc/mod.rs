//! FANUC TP: program listings (.LS), with the tools and user frames of SYSFRAME.VA or FRAME.DG and
//! the position registers of POSREG.VA where these are given too.
//!
//! A point is `P[n]{ GP1: UF : f, UT : t, CONFIG : '…', X = …, … W = …, P = …, R = … };`, mm and
//! degrees, `Rz(R)·Ry(P)·Rx(W)`; or J1 to J6 in degrees. It is the pose of tool t in user frame f;
//! both are numbers, and 0 is the flange and the world. `F` for a number is the one that
//! `UTOOL_NUM` and `UFRAME_NUM` select; where the program selects none before, the tool or frame is
//! called `F`, and the user says where it is. Only group 1 is read and written; J3 of joint points
//! is FANUC's, measured from the horizontal (the profile's coupling). Listings of any dictionary
//! are read: UF, UT and the names of coordinates are in all of them, the configuration data are the
//! only string in a group.
//!
//! Numbers stand in fields of a fixed width; a new number keeps the field's last column. The
//! remarks that mark a compensated program are explained in [`mark`].
//!
//! # Statements
//!
//! Each program is a routine. `CALL` and `RUN` bind to the programs in the files; `LBL`, `JMP`,
//! `IF`, `SELECT`, `FOR`, `Skip,LBL` and `TIMEOUT,LBL` are its flow; a word that nobody knows is a
//! macro, which may select another tool. Tools, user frames, the numbers that select them and
//! position registers are variables that the controller keeps. A move to `PR[n]` goes with the
//! active tool and frame; where `PR[n]` is a copy of a point it goes to that point, next to it
//! where something was added or one number changed. The controller goes to a point only where the
//! numbers are selected that it was taught with (else MOTN-018), so that behind such a move they
//! are the active ones.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! A move with `Offset` or `Tool_Offset` goes to a point that takes the correction of its own along,
//! displaced by the numbers of a register: `numbers` says what the programs write into these,
//! `offsets` what that displaces. Where only the running robot knows them, and with `VOFFSET`, that
//! is reported as `displacement-unknown`; where the text tells them in a way that is not followed,
//! nothing bounds it. Where the robot stands behind a move that `Skip` or `Search[…]` ended is
//! unknown.
//!
//! # Limits
//!
//! Which point or register a register `R[n]` selects is any that the programs may have written
//! (`indices`), and which tool or frame is unknown unless the program has just written its number. A program that a local condition of a move (TB, TA, DB) calls may not
//! have run yet at the moves behind it. `PAYLOAD` is not read, several are reported: a tool's load
//! is the profile's. `LR[n]` and `LPR[n]` are taken for one register of all programs. A translated
//! INC, RTCP, COORD, IF or CALL is known in German only. That moves other than J stop where CONFIG names another posture than the path ends in (MOTN-063), and
//! MOTN-018, are *not verified on a controller*.

mod asked;
mod config;
mod content;
mod controller;
mod deciding;
mod drive;
mod frames;
mod indices;
mod insert;
mod lines;
pub mod mark;
mod moves;
mod numbers;
mod offsets;
mod points;
mod posreg;
mod reader;
mod registers;
mod rides;
mod sections;
mod start;
mod statements;
mod words;
mod writes;

use super::notation;
use super::{
    About, Configuration, Deciding, Inserted, Insertions, Language, Layout, Marker, Posture,
    ReadError, Role, Script, Settings, Source, Step,
};
use crate::geometry::Pose;
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
        "groups 2 and up, values of extended axes, instructions, names, attributes, line ends, \
         encoding",
        "points that no move uses",
        "moves to position registers that are no copies of points, with a warning",
        "offsets of moves (Offset, Tool_Offset, VOFFSET): the moved point takes the correction \
         along; how far off it lands is said",
        "SYSFRAME.VA and FRAME.DG, which tell tools and user frames, and POSREG.VA, which tells \
         position registers",
    ],
    refuses: &[
        "increments (INC), moves with RTCP, COORD or line tracking, extended axes away from zero \
         that the profile does not describe",
        "points that were never taught, or of robots with other axes",
        "tools and user frames that the running program assigns or chooses",
    ],
    has: "/PROG and /MN, or $MNUTOOL and $MNUFRAME, or $POSREG,",
};

/// Printed with three decimals an angle up to this far beyond a half revolution is still 180.000.
const BEYOND_DEG: f64 = 0.0005;
/// Numbers of a pose without configuration data.
const PLAIN: usize = 6;

/// Logs of a backup, which end as programs do: those of nine backups in public repositories.
const RECORDS: [&str; 14] = [
    "erract", "errall", "errapp", "errcomm", "errcurr", "errext", "errhist", "errmot", "errpwd",
    "errsys", "hist", "logbook", "updtlog", "vtrndiag",
];

impl Language for Fanuc {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        let bytes = &source.bytes;
        memchr::memchr(0, &bytes[..bytes.len().min(1 << 16)]).is_none()
            && (Sections::of(bytes).is_some() || frames::kind(bytes).is_some())
    }

    fn script(&self, sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
        reader::script(sources, &settings.external)
    }

    fn turns_through_middle(&self) -> bool {
        true
    }

    fn pose_roles(&self, layout: Layout) -> &'static [Role] {
        match layout.variant {
            0 => &notation::WITH_ANGLES,
            _ => &notation::WITH_ANGLES[..PLAIN],
        }
    }

    /// Fields of a fixed width have three decimals.
    fn least_decimals(&self, role: Role) -> usize {
        match role {
            Role::Position | Role::Orientation | Role::Joint => 3,
            Role::Configuration => 0,
        }
    }

    fn is_record(&self, file: &str) -> bool {
        let lower = file.to_ascii_lowercase();
        match lower.rsplit_once('.') {
            Some((stem, "ls")) => RECORDS.contains(&stem),
            // all but those with the tools and frames; registers are recognised where there are any
            Some((stem, "va" | "dg")) => !stem.starts_with("sysframe") && stem != "frame",
            _ => false,
        }
    }

    fn has_framed_positions(&self) -> bool {
        true
    }

    fn pose_of(&self, _: Layout, numbers: &[f64]) -> Pose {
        notation::pose_of_angles(std::array::from_fn(|i| numbers[i]))
    }

    fn write_pose(&self, _: Layout, pose: &Pose, numbers: &mut [f64]) {
        notation::write_angles(pose, BEYOND_DEG, numbers);
    }

    fn configuration(&self, _: Layout, numbers: &[f64]) -> Configuration {
        let data: Option<&[f64; 6]> = numbers[PLAIN..].try_into().ok();
        data.map_or_else(Configuration::default, config::configuration)
    }

    fn update_configuration(
        &self,
        _: Layout,
        before: &Posture,
        after: &Posture,
        numbers: &mut [f64],
    ) {
        let of = config::data;
        notation::update(of, config::JOINTS, before, after, &mut numbers[PLAIN..]);
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

    fn insert(&self, into: &Insertions) -> Inserted {
        insert::insert(into)
    }

    fn drive(&self, steps: &[Step], _: &Settings) -> Option<String> {
        Some(drive::drive(steps))
    }

    fn deciding(&self) -> Option<&'static Deciding> {
        Some(&deciding::MANNER)
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        mark::mark(source, marker)
    }
}

#[cfg(test)]
mod tests;
