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
//! # Findings
//!
//! | id | severity | meaning |
//! |---|---|---|
//! | `target-uninitialised` | error | a move goes to a point that was never taught |
//! | `target-not-six-axes` | error | group 1 of the point is not that of an arm with six joints |
//! | `configuration-not-understood` | error | other letters than `N F`, `U D`, `T B`, or not three of them and three turns |
//! | `target-declared-twice` | error | two points have one number |
//! | `target-used-by-instruction` | error | an instruction that is no move changes or uses the point |
//! | `target-not-in-files` | error | a move goes to a point that is not in /POS |
//! | `computed-target` | error | a move goes to a position register |
//! | `incremental-move` | error | INC |
//! | `remote-tool` | error | RTCP, or a point RX RY RZ RW RP RR: the robot holds the work piece |
//! | `coordinated-move` | error | COORD: a positioner moves the work piece |
//! | `line-tracking` | error | the program follows a conveyor |
//! | `frame-assigned-at-run-time` | error | `UFRAME[n]=`, `UTOOL[n]=` of the point's frame or tool in any of the programs |
//! | `frame-chosen-at-run-time` | error | `UF : F` or `UT : F`, and what the program selects is not certain |
//! | `frame-number-differs` | warning | another number is selected than the point was taught with |
//! | `extended-axis` | warning | an axis beside the six of the arm is away from zero |
//! | `target-copied` | warning | the point is copied into a position register |
//! | `target-unused-here` | note | no move of the program uses these points |
//! | `other-group` | note | moves to points that have no group 1 |
//! | `frames-rounded` | note | FRAME.DG shows tools and frames with one decimal |
//!
//! A move with `Offset`, `Tool_Offset` or `VOFFSET` goes to a point that only the running program knows: it takes the
//! correction of its point along, which is told as `displacement-unknown`.
//!
//! # Limits
//!
//! Local conditions of moves (TB, TA, DB) and calls are not followed. A translated INC, RTCP or COORD is known in German only.

mod angles;
mod config;
mod findings;
mod frames;
mod insert;
mod instructions;
pub mod mark;
mod meaning;
mod pace;
mod points;
mod resolve;
mod sections;

use super::{
    About, Configuration, Decoded, Inserted, Insertion, Language, Layout, Marker, Move, Pace,
    Posture, Program, ReadError, Role, Settings, Shape, Source, Value,
};
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use frames::Frames;
use instructions::Instructions;
use points::{Fault, POSE_NUMBERS, Points, offset};
use resolve::Listing;
use sections::{Sections, check_bytes};

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
        "groups 2 and up, extended axes, instructions, names, attributes, line ends, encoding",
        "points that no move uses",
        "offsets of moves (Offset, Tool_Offset, VOFFSET): the moved point takes the correction along, a warning says so",
        "SYSFRAME.VA and FRAME.DG, which tell tools and user frames",
    ],
    refuses: &[
        "moves to position registers, increments (INC), moves with RTCP, COORD or line tracking",
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

    fn read(&self, sources: &[Source], _: &Settings) -> Result<Program, ReadError> {
        let mut listings = Vec::new();
        let (mut values, mut rounded) = (Frames::default(), Vec::new());
        for (file, source) in sources.iter().enumerate() {
            check_bytes(source)?;
            let file = offset(file);
            if let Some(sections) = Sections::of(&source.bytes) {
                let listing = listing(source, file, &sections);
                listings.push(listing.map_err(|fault| in_source(&fault, source))?);
            } else if let Some(kind) = frames::kind(&source.bytes) {
                let found = frames::read(&source.bytes, kind).map_err(|bad| {
                    let (at, length) = (bad.at, bad.length);
                    in_source(&Fault::BadValue { at, length }, source)
                })?;
                rounded.extend(found.rounded.then(|| source.name.clone()));
                values.add(found);
            } else {
                return Err(ReadError::NotThisLanguage {
                    file: source.name.clone(),
                    language: ABOUT.name,
                    missing: "/PROG and /MN, or $MNUTOOL and $MNUFRAME,",
                });
            }
        }
        let mut program = resolve::resolve(sources, &mut listings, &values);
        program
            .findings
            .extend(rounded.into_iter().map(frames_rounded));
        Ok(program)
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

    fn pace(&self, source: &Source, motion: &Move) -> Pace {
        pace::pace(&source.bytes, motion.offset as usize)
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

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        mark::mark(source, marker)
    }
}

impl Frames {
    /// Takes in the frames of another file: those of variables are exact and go before those of a list.
    fn add(&mut self, other: Self) {
        let (exact, rough) = if other.rounded {
            (std::mem::take(self), other)
        } else {
            (other, std::mem::take(self))
        };
        *self = rough;
        self.tools.extend(exact.tools);
        self.frames.extend(exact.frames);
        self.rounded = false;
    }
}

/// One program.
fn listing(source: &Source, file: u32, sections: &Sections) -> Result<Listing, Fault> {
    let bytes = &source.bytes;
    let mut listing = Listing {
        file,
        name: program_name(&bytes[sections.name.clone()]),
        tracks_line: tracks_line(&bytes[sections.head.clone()]),
        ..Listing::default()
    };
    let lines = Instructions::new(bytes, sections.lines.clone());
    lines.each(|offset, event| listing.events.push((offset, event)));
    let mut points = Points::new(bytes, sections.points.start);
    while let Some(point) = points.next()? {
        listing.points.push(point);
    }
    listing.numbers = points.numbers;
    Ok(listing)
}

/// The first word behind `/PROG`, in capitals.
fn program_name(text: &[u8]) -> Box<[u8]> {
    let word = text.split(u8::is_ascii_whitespace).next();
    word.unwrap_or_default().to_ascii_uppercase().into()
}

/// Whether the application data name a line tracking schedule other than 0.
fn tracks_line(head: &[u8]) -> bool {
    const KEY: &[u8] = b"LINE_TRACK_SCHEDULE_NUMBER";
    let Some(at) = memchr::memmem::find(head, KEY) else {
        return false;
    };
    let rest = head[at + KEY.len()..].trim_ascii_start();
    let value = rest.strip_prefix(b":").unwrap_or(rest).trim_ascii_start();
    let digits: Vec<u8> = value
        .iter()
        .copied()
        .take_while(u8::is_ascii_digit)
        .collect();
    digits.iter().any(|&digit| digit != b'0')
}

fn frames_rounded(file: String) -> Finding {
    Finding {
        id: "frames-rounded",
        severity: Severity::Note,
        file,
        line: 0,
        column: 0,
        message: "this list shows tools and user frames to 0.1 mm and 0.1 deg".into(),
        hint: "SYSFRAME.VA has them to 0.001".into(),
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
            limit: "a plain number of at most 1000000 is wanted; numbers of tools and frames go to 255",
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
