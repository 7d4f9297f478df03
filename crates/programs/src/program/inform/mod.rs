//! Yaskawa INFORM: jobs (.JBI), with TOOL.CND and UFRAME.CND of a backup.
//!
//! A position is `C00000=x,y,z,Rx,Ry,Rz`, mm and degrees, with `R = Rz · Ry · Rx`, or six axes S,
//! L, U, R, B, T in encoder pulses or degrees. Tool, frame and form stand in header lines above it
//! (`job`). C positions belong to their job, P positions are variables of the controller. External
//! axes (`BC`, `EC`, `BP`, `EX`), elbow angles and RCONF stay as they are.
//!
//! A tool's or user frame's name is its number. `BASE` and `ROBOT` coordinates are those of the
//! robot's base.
//!
//! Each job is a routine: CALL JOB goes to jobs of the files and comes back, JUMP JOB does not;
//! PSTART runs concurrently. A job that an input group or a variable names is any of the files whose
//! name is a number, or another; a macro runs one that nothing names, or another. What a P variable holds, which frame MFRAME and which tool SETTOOL
//! made, and whether a shift is on, and by what, is followed through them. A move to a place where
//! the robot itself stood (`GETS PX001 $PX001`) is right as it is; one to a place that the running
//! program computes stays, and is reported.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! Shifts that a job switches on which is not given are not seen, nor those of macros in macros.
//! The first of successive MOVC is taken for a line, the others for arcs through each two; MOVS for
//! lines. Robots with seven axes are refused in pulses; the elbow angle of their rectangular
//! positions is left. BASE and ROBOT are the world of the profile: its base has to stand at zero.
//! Pulses are taken to be proportional to the joint of their own; on arms whose wrist motors
//! are coupled (turning B moves T) PULSE positions come out wrong. The unit of base and station
//! axes is not known.

mod calls;
mod cnd;
mod deciding;
mod drive;
mod indexed;
mod insert;
mod instruction;
mod job;
mod judge;
mod jumps;
mod lines;
mod moves;
mod numbers;
mod parts;
mod rconf;
mod reader;
mod relative;
mod remarks;
mod shifts;
mod variables;

use super::kit::{MOST_BASE_GAP_M, judge_base, line_behind, not_this_language};
use super::notation;
use super::script::{Place, Remark, Script, short};
use super::{
    About, Configuration, Deciding, Inserted, Insertions, Language, Layout, Marker, ReadError,
    Role, Settings, Shape, Source, Step,
};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};

/// Yaskawa INFORM.
#[derive(Debug)]
pub struct Inform;

static ABOUT: About = About {
    id: "inform",
    name: "Yaskawa INFORM",
    extensions: &["jbi", "cnd"],
    rewrites: &[
        "C and P positions that MOVJ, MOVL, MOVC or MOVS go to: RECTAN in base, robot and user \
         coordinates",
        "PULSE and ANGLE positions, the former where the profile tells pulses_per_deg",
    ],
    leaves: &[
        "RCONF, external axes (BC, EC, BP, EX), speeds, positions that no move goes to",
        "moves to places that the running program computes (local and indexed variables) or reads \
         from the robot: reported",
        "PULSE positions without pulses_per_deg: reported",
        "TOOL.CND and UFRAME.CND, which tell tools and user frames",
        "comments, line ends, encoding, header",
    ],
    refuses: &[
        "P variables of which instructions write some numbers",
        "moves while a shift (SFTON) may be on that is not followed, incremental (IMOV), search \
         (SRCH) and coordinated (SMOV) moves",
        "tools and frames that the running program sets (MFRAME, SETTOOL), tool coordinates",
        "positions of a second robot, with base or station axes that are not at zero, or without \
         six axes",
    ],
    has: "line /JOB",
};

/// Variant of joints in encoder pulses.
const PULSES: u8 = 0;
/// Variant of joints in degrees.
const DEGREES: u8 = 1;

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

    fn is_record(&self, file: &str) -> bool {
        // conditions of weaving, of welding and others
        let lower = file.to_ascii_lowercase();
        lower
            .strip_suffix(".cnd")
            .is_some_and(|stem| !stem.contains("tool") && !stem.contains("frame"))
    }

    fn turns_through_middle(&self) -> bool {
        true
    }

    fn pose_roles(&self, _: Layout) -> &'static [Role] {
        &notation::WITH_ANGLES[..6]
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

    fn has_framed_positions(&self) -> bool {
        true
    }

    fn pose_of(&self, _: Layout, numbers: &[f64]) -> Pose {
        notation::pose_of_angles(std::array::from_fn(|i| numbers[i]))
    }

    fn write_pose(&self, _: Layout, pose: &Pose, numbers: &mut [f64]) {
        notation::write_angles(pose, 0.0, numbers);
    }

    fn joint_units(&self, layout: Layout, settings: &Settings) -> [f64; 6] {
        if layout.variant == DEGREES {
            return [DEG; 6];
        }
        let pulses = settings.pulses_per_deg;
        let pulses = pulses.expect("targets in pulses are blocked without pulses per degree");
        pulses.map(|pulses| DEG / pulses)
    }

    fn configuration(&self, layout: Layout, _: &[f64]) -> Configuration {
        rconf::configuration(layout.variant)
    }

    fn insert(&self, into: &Insertions) -> Inserted {
        insert::insert(into)
    }

    fn external_names(&self) -> [&'static str; 6] {
        ["BC1", "BC2", "BC3", "EC1", "EC2", "EC3"]
    }

    fn drive(&self, steps: &[Step], settings: &Settings) -> Option<String> {
        Some(drive::drive(steps, settings.pulses_per_deg?))
    }

    /// Comments behind NOP, in lines short enough for every controller.
    fn deciding(&self) -> Option<&'static Deciding> {
        Some(&deciding::MANNER)
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        let end = source.line_end();
        let mut text = Vec::new();
        let is_closed = |at: usize| at == 0 || matches!(source.bytes[at - 1], b'\n' | b'\r');
        let at = marker_place(&source.bytes);
        if !is_closed(at) {
            text.extend_from_slice(end);
        }
        for line in marker.short_lines() {
            text.push(b'\'');
            text.extend_from_slice(line.as_bytes());
            text.extend_from_slice(end);
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
        world_from_robot: settings.world_from_base_at_home,
        ..job::Positions::default()
    };
    for (file, source) in sources.iter().enumerate() {
        if cnd::recognises(&source.bytes) {
            cnd::read(source, &mut conditions)?;
        } else if !positions.read(source, short(file))? {
            return Err(not_this_language(&ABOUT, source));
        }
    }
    let mut script = reader::script(sources, positions, &conditions, &settings.external);
    // BASE counts from the height of axis 2; with external axes the world is that of BASE
    if settings.external.listed.is_empty() {
        judge_base(
            &mut script,
            sources,
            settings,
            ("base-not-of-controller", true),
        );
        judge_height(&mut script, sources, settings);
    }
    Ok(script)
}

/// Says from where positions count where that is not the robot's base.
fn judge_height(script: &mut Script, sources: &[Source], settings: &Settings) {
    let base = settings.world_from_base.filter(|_| !sources.is_empty());
    let height_m = base.map_or(0.0, |base| base.translation[2]);
    let mut shapes = script.targets.iter().map(|target| target.layout.shape);
    if height_m.abs() <= MOST_BASE_GAP_M || !shapes.any(|shape| shape == Shape::Pose) {
        return;
    }
    let side = if height_m > 0.0 { "below" } else { "above" };
    let message = format!(
        "positions are taken to count from the world's origin, which the profile has {:.1} mm {side} \
         the robot's base (`kinematics.base`)",
        mm_from_m(height_m.abs())
    );
    let hint = "right only if the pendant shows the flange at the height that `poseshift fk` has at \
        the same joints; else correct `z_mm` of `kinematics.base`";
    let remark = Remark::warning_about("base-height", message, hint);
    script.say(sources, Place::new(0, 0), remark);
}

/// Behind the NOP of the first job, where none has one before the last END, else at the end.
fn marker_place(bytes: &[u8]) -> usize {
    let mut end = bytes.len();
    for line in lines::Lines::of(bytes) {
        match line.text {
            b"NOP" => return line_behind(bytes, line.start).unwrap_or(bytes.len()),
            b"END" => end = line.start,
            _ => {}
        }
    }
    end
}

/// Whether the first lines are those of a job; comments may stand before it.
fn is_job(bytes: &[u8]) -> bool {
    let mut lines = lines::Lines::of(bytes)
        .filter(|line| !line.text.is_empty() && line.text[0] != b'\'')
        .map(|line| line.text);
    lines.next() == Some(b"/JOB") && lines.next().is_some_and(|line| line.starts_with(b"//"))
}

#[cfg(test)]
mod tests;
