//! KUKA KRL: programs (.src), data lists (.dat), submit programs (.sub).
//!
//! A position is `{X ..,Y ..,Z ..,A ..,B ..,C ..,S ..,T ..,E1 ..}`, mm and degrees, `R = Rz(A) · Ry(B) · Rx(C)`; S and T tell
//! the inverse solution (`status`) where the move is a PTP. Axes are `{A1 ..,...,A6 ..,E1 ..}`, degrees. External axes
//! stay as they are, and are not understood where they are in use. The pose is that of $TOOL in $BASE. Both are variables of
//! the controller, as are $LOAD, `$IPO_MODE`, what `FDAT_ACT` holds, and the entries of `TOOL_DATA`, `BASE_DATA`, `LOAD_DATA`
//! (`frames`); `$TOOL=`, BAS, inline forms and WITH write them (`states`). Positions that a statement writes, or that are
//! parameters, are variables too (`targets`); what of it reaches a move is worked out in [`crate::motion`].
//!
//! Files of one name are one module; `$config.dat` and GLOBAL data are seen everywhere. Of a data list everything keeps its
//! value from one run to the next. Routines of interrupts and triggers, and submit programs, run at any time.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! Positions in structures and sensor corrections are not followed. A routine outside the files is taken to change tool or
//! base only where moves use more than one. An arc to an angle (CA) is refused.

mod aggregate;
mod calls;
mod data;
mod drive;
mod frames;
mod insert;
mod moves;
mod names;
mod points;
mod reader;
mod remarks;
mod sniff;
mod statements;
mod states;
mod status;
mod targets;
mod tokens;

use super::kit::check_bytes;
use super::script::{NamedFrame, Part, Remark, Script, short};
use super::{
    About, Configuration, Decoded, Inserted, Insertion, Language, Layout, Marker, Posture, Program,
    ReadError, Role, Settings, Shape, Source, Step, Value,
};
use crate::geometry::Rotation;
use crate::geometry::units::{DEG, mm_from_m};
use reader::Reader;

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
        let pose = frames::pose_of(std::array::from_fn(|i| numbers[i]));
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

/// All files into one script: what they declare, then what they do.
fn script(sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
    let mut reader = Reader::new();
    for (file, source) in sources.iter().enumerate() {
        check_bytes(source)?;
        if !sniff::recognises(&source.bytes) {
            return Err(ReadError::NotThisLanguage {
                file: source.name.clone(),
                language: ABOUT.name,
                missing: "DEF, DEFDAT, a header (&ACCESS) or a move",
            });
        }
        let read = reader.declarations(source, short(file));
        read.map_err(|fault| fault.in_source(source, "the line"))?;
    }
    reader.settle();
    for (file, source) in sources.iter().enumerate() {
        let read = reader.statements(source, short(file));
        read.map_err(|fault| fault.in_source(source, "the line"))?;
    }
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

#[cfg(test)]
mod tests;
