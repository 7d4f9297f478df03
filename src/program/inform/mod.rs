//! Yaskawa INFORM: jobs (.JBI), with TOOL.CND and UFRAME.CND of a backup.
//!
//! A position is `C00000=x,y,z,Rx,Ry,Rz`, mm and degrees, with `R = Rz · Ry · Rx`, or six axes S, L, U, R, B, T in encoder pulses
//! or degrees. Tool, frame and form stand in header lines above it (`job`). C positions belong to their job, P
//! positions are variables of the controller. External axes (`BC`, `EC`, `BP`, `EX`), elbow angles and RCONF stay as
//! they are.
//!
//! A tool's or user frame's name is its number. `BASE` and `ROBOT` coordinates are those of the robot's base.
//!
//! Each job is a routine: CALL JOB goes to jobs of the files and comes back, JUMP JOB does not; PSTART runs beside. What a P
//! variable holds, which frame MFRAME and which tool SETTOOL made, and whether a shift is on is followed through them. A move to
//! a place where the robot itself stood (`GETS PX001 $PX001`) is right as it is; one to a place that the running program
//! computes stays, and is told.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! Shifts that a job switches on which is not given or not called by name (macros) are not seen. The first of
//! successive MOVC is taken for a line, the others for arcs through each two; MOVS for lines. Robots with seven axes
//! are refused in pulses; the elbow angle of their rectangular positions is left. BASE and ROBOT are the world of the profile:
//! its base has to stand at zero. Pulses are taken to be proportional to the joint of their own; on arms whose wrist motors
//! are coupled (turning B moves T) PULSE positions come out wrong. The unit of base and station axes is not known.

mod cnd;
mod drive;
mod insert;
mod instruction;
mod job;
mod judge;
mod lines;
mod moves;
mod rconf;
mod reader;
mod remarks;
mod variables;

use super::kit::check_bytes;
use super::script::{Script, short};
use super::{
    About, Configuration, Decoded, Inserted, Insertion, Language, Layout, Marker, Posture, Program,
    ReadError, Role, Settings, Shape, Source, Step, Value,
};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Rotation};

/// Yaskawa INFORM.
#[derive(Debug)]
pub struct Inform;

static ABOUT: About = About {
    id: "inform",
    name: "Yaskawa INFORM",
    extensions: &["jbi", "cnd"],
    rewrites: &[
        "C and P positions that MOVJ, MOVL, MOVC or MOVS go to: RECTAN in base, robot and user coordinates",
        "PULSE and ANGLE positions, the former where the profile tells pulses_per_deg",
    ],
    leaves: &[
        "RCONF, external axes (BC, EC, BP, EX), speeds, positions that no move goes to",
        "moves to places that the running program computes (local and indexed variables) or reads from the robot: told",
        "PULSE positions without pulses_per_deg: told",
        "TOOL.CND and UFRAME.CND, which tell tools and user frames",
        "comments, line ends, encoding, header",
    ],
    refuses: &[
        "P variables of which instructions write some numbers",
        "moves while a shift (SFTON) may be on, incremental (IMOV), search (SRCH) and coordinated (SMOV) moves",
        "tools and frames that the running program sets (MFRAME, SETTOOL), tool coordinates",
        "positions of a second robot, with base or station axes that are not at zero, or without six axes",
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

/// Variant of joints in encoder pulses.
const PULSES: u8 = 0;
/// Variant of joints in degrees.
const DEGREES: u8 = 1;

/// Letters of a comment that every controller shows.
const COMMENT: usize = 32;

impl Language for Inform {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        memchr::memchr(0, &source.bytes).is_none()
            && (is_job(&source.bytes) || cnd::recognises(&source.bytes))
    }

    fn script(&self, sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
        script(sources, settings)
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
            // a thousandth of a millimetre is 6e-5 degrees at one metre
            Role::Orientation => millimetre_decimals + 2,
            // pulses are whole
            Role::Joint | Role::Configuration => 0,
        }
    }

    /// Fields have three decimals of a millimetre and four of a degree.
    fn least_decimals(&self, role: Role) -> usize {
        match role {
            Role::Position => 3,
            Role::Orientation => 4,
            Role::Joint | Role::Configuration => 0,
        }
    }

    fn decode(&self, layout: Layout, numbers: &[f64], settings: &Settings) -> Decoded {
        let n: &[f64; 6] = numbers.try_into().expect("a position has six numbers");
        let (value, configuration) = match layout.shape {
            Shape::Pose => (
                Value::Pose(pose_of(n)),
                rconf::configuration(layout.variant),
            ),
            Shape::Joints => {
                let unit = units_per_degree(layout, settings);
                let joints = std::array::from_fn(|i| n[i] / unit[i] * DEG);
                (Value::Joints(joints), Configuration::default())
            }
        };
        Decoded {
            value,
            configuration,
        }
    }

    fn encode(
        &self,
        layout: Layout,
        value: &Value,
        _: &Posture,
        _: &Posture,
        settings: &Settings,
        numbers: &mut [f64],
    ) {
        match (layout.shape, value) {
            (Shape::Pose, Value::Pose(pose)) => {
                numbers[..3].copy_from_slice(&pose.translation.map(mm_from_m));
                let angles = angles_near(&pose.rotation, [numbers[3], numbers[4], numbers[5]]);
                numbers[3..6].copy_from_slice(&angles);
            }
            (Shape::Joints, Value::Joints(joints)) => {
                let unit = units_per_degree(layout, settings);
                for i in 0..6 {
                    numbers[i] = joints[i] / DEG * unit[i];
                }
            }
            _ => panic!("a value of the other shape"),
        }
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

    fn drive(&self, steps: &[Step], settings: &Settings) -> Option<String> {
        Some(drive::drive(steps, settings.pulses_per_deg?))
    }

    /// Comments behind NOP, in lines short enough for every controller.
    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        let end = source.line_end();
        let mut text = Vec::new();
        let is_closed = |at: usize| at == 0 || matches!(source.bytes[at - 1], b'\n' | b'\r');
        let at = marker_place(&source.bytes);
        if !is_closed(at) {
            text.extend_from_slice(end);
        }
        for line in marker.lines() {
            let mut comment: Vec<u8> = Vec::new();
            for word in line.as_bytes().split(|&b| b == b' ') {
                for part in word.chunks(COMMENT) {
                    if !comment.is_empty() && comment.len() + 1 + part.len() > COMMENT {
                        push_comment(&comment, end, &mut text);
                        comment.clear();
                    }
                    if !comment.is_empty() {
                        comment.push(b' ');
                    }
                    comment.extend_from_slice(part);
                }
            }
            push_comment(&comment, end, &mut text);
        }
        (at, text)
    }
}

/// The statements of all jobs.
fn script(sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
    let mut conditions = cnd::Conditions::default();
    let usable = |pulses: &[f64; 6]| pulses.iter().all(|p| p.is_finite() && *p != 0.0);
    let mut positions = job::Positions {
        pulses_known: settings.pulses_per_deg.as_ref().is_some_and(usable),
        ..job::Positions::default()
    };
    for (file, source) in sources.iter().enumerate() {
        check_bytes(source)?;
        if cnd::recognises(&source.bytes) {
            cnd::read(source, &mut conditions)?;
        } else if !positions.read(source, short(file))? {
            return Err(ReadError::NotThisLanguage {
                file: source.name.clone(),
                language: ABOUT.name,
                missing: "line /JOB",
            });
        }
    }
    Ok(reader::script(sources, positions, &conditions))
}

fn push_comment(comment: &[u8], end: &[u8], text: &mut Vec<u8>) {
    text.push(b'\'');
    text.extend_from_slice(comment);
    text.extend_from_slice(end);
}

/// Behind the NOP of the first job, else at the end.
fn marker_place(bytes: &[u8]) -> usize {
    let mut lines = lines::Lines::of(bytes);
    while let Some(line) = lines.next() {
        if line.text == b"NOP" {
            let at = lines.position().min(bytes.len());
            let is_pair = at > 0 && bytes[at - 1] == b'\r' && bytes.get(at) == Some(&b'\n');
            return at + usize::from(is_pair);
        }
    }
    bytes.len()
}

/// Whether the first lines are those of a job; comments may stand before it.
fn is_job(bytes: &[u8]) -> bool {
    let mut lines = lines::Lines::of(bytes)
        .filter(|line| !line.text.is_empty() && line.text[0] != b'\'')
        .map(|line| line.text);
    lines.next() == Some(b"/JOB") && lines.next().is_some_and(|line| line.starts_with(b"//"))
}

/// The pose of x, y, z in mm and Rx, Ry, Rz in degrees.
fn pose_of(n: &[f64]) -> Pose {
    Pose {
        rotation: Rotation::from_rzryrx([n[5] * DEG, n[4] * DEG, n[3] * DEG]),
        translation: [n[0], n[1], n[2]].map(m_from_mm),
    }
}

/// What one degree of each joint is in the numbers of a layout.
fn units_per_degree(layout: Layout, settings: &Settings) -> [f64; 6] {
    if layout.variant == DEGREES {
        return [1.0; 6];
    }
    settings
        .pulses_per_deg
        .expect("targets in pulses are blocked without pulses per degree")
}

/// Rx, Ry and Rz in degrees: of the two ways and the turns that give the same rotation those nearest to the present numbers,
/// but within ±180° where these are.
fn angles_near(rotation: &Rotation, present: [f64; 3]) -> [f64; 3] {
    let [rz, ry, rx] = rotation.rzryrx(present[0] * DEG).map(|angle| angle / DEG);
    let near = |angles: [f64; 3]| {
        let mut near = [0.0; 3];
        for i in 0..3 {
            near[i] = angles[i] + 360.0 * ((present[i] - angles[i]) / 360.0).round();
        }
        near
    };
    let distance =
        |angles: &[f64; 3]| -> f64 { (0..3).map(|i| (angles[i] - present[i]).abs()).sum() };
    let (one, other) = (
        near([rx, ry, rz]),
        near([rx + 180.0, 180.0 - ry, rz + 180.0]),
    );
    // the second way has Ry beyond ±90°, which only files that have it already want
    let second = present[1].abs() > 90.0 && distance(&other) < distance(&one);
    let mut angles = if second { other } else { one };
    for i in 0..3 {
        if present[i].abs() <= 180.0 && angles[i].abs() > 180.0 {
            angles[i] -= 360.0_f64.copysign(angles[i]);
        }
    }
    angles
}

#[cfg(test)]
mod tests;
