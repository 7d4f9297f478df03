//! Kawasaki AS: saves of a controller (.as) and programs (.pg).
//!
//! A transformation is x, y, z in mm and O, A, T in degrees, `R = Rz(O) · Ry(A) · Rz(T)`; joints
//! are `#` values, degrees. They stand in `.TRANS` and `.JOINTS`, or are written out: `TRANS(…)`,
//! `#[…]`. The target of a move is the pose of TOOL in BASE, which statements set; what they are
//! before is not in the files. `a+b` is b in the axes of a. Numbers of other sections carry
//! checksums and are never touched.
//!
//! Poses tell no configuration: joint moves keep that of the posture before, straight moves and
//! arcs keep to their path. Begin with joints. Where words (`LEFTY`, `UWRIST`, …) switch it, poses
//! are refused until the next joint target.
//!
//! Zero of joint 1 points along y, and it counts clockwise from above; joint 3 is that of the
//! profile: arms with parallel rods count it otherwise (`coupling`). *Not verified on a
//! controller*; see docs/languages/kawasaki.md.
//!
//! What is found and what to do about it stands in [`crate::finding::TABLE`].
//!
//! # Limits
//!
//! Whether BASE NULL lies at the foot or at axis 2 is not known: `kinematics.base` of the profile
//! says. Sensors and conveyors are not seen.

mod arrays;
mod calls;
mod deciding;
mod insert;
mod keywords;
mod loads;
mod moves;
mod numbers;
mod plates;
mod reader;
mod remarks;
mod sections;
mod shown;
mod targets;
mod watches;

use super::drive::{self, Step};
use super::kit::{comments, line_behind, not_this_language};
use super::notation;
use super::script::Script;
use super::{
    About, Configuration, Deciding, Inserted, Insertions, Language, Layout, Marker, ReadError,
    Role, Settings, Source,
};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Rotation};
use sections::Sections;

/// Kawasaki AS.
#[derive(Debug)]
pub struct Kawasaki;

static ABOUT: About = About {
    id: "kawasaki",
    name: "Kawasaki AS",
    extensions: &["as", "pg", "lc"],
    rewrites: &[
        "transformations of .TRANS that JMOVE, LMOVE, HMOVE, C1MOVE, C2MOVE, LAPPRO and JAPPRO go \
         to",
        "TRANS(…) written out in a move; numbers that it leaves out at its end are put in, and reported",
        "joints (.JOINTS, #[…])",
    ],
    leaves: &[
        "all other sections: they carry checksums",
        "tools, bases, offsets, names that no move goes to",
        "moves to where the robot was (HERE), and to what the running program computes: reported",
        "comments, line ends, encoding",
    ],
    refuses: &[
        "TRANS(…) that leaves a number out between others as a target, values with another axis",
        "tools and bases that only the running program knows",
        "poses behind LEFTY, RIGHTY, ABOVE, BELOW, UWRIST, DWRIST until joints are gone to",
        "searches (XMOVE)",
    ],
    has: ".PROGRAM, .TRANS, .JOINTS or another section",
};

impl Language for Kawasaki {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        sections::recognises(&source.bytes)
    }

    fn accepts(&self, source: &Source) -> bool {
        self.recognises(source) || sections::accepts(source)
    }

    fn script(&self, sources: &[Source], _: &Settings) -> Result<Script, ReadError> {
        let mut sections = Sections::default();
        for (file, source) in (0..).zip(sources) {
            let is_one = sections.read(source, file);
            if !is_one.map_err(|fault| fault.in_source(source))? {
                return Err(not_this_language(&ABOUT, source));
            }
        }
        Ok(reader::script(sources, &sections))
    }

    fn turns_through_middle(&self) -> bool {
        true
    }

    fn pose_roles(&self, _: Layout) -> &'static [Role] {
        &notation::WITH_ANGLES[..6]
    }

    /// `TRANS(x,y,z)`
    fn around_missing(&self, _: Layout, _: usize) -> (String, &'static str) {
        (",".into(), "")
    }

    fn has_missing_in_order(&self) -> bool {
        true
    }

    fn pose_of(&self, _: Layout, numbers: &[f64]) -> Pose {
        pose_of(std::array::from_fn(|i| numbers[i]))
    }

    fn write_pose(&self, _: Layout, pose: &Pose, numbers: &mut [f64]) {
        let present = [numbers[3], numbers[4], numbers[5]];
        numbers[..3].copy_from_slice(&pose.translation.map(mm_from_m));
        numbers[3..6].copy_from_slice(&nearest_angles(&pose.rotation, present));
    }

    fn configuration(&self, _: Layout, _: &[f64]) -> Configuration {
        Configuration {
            kept: [true; 3],
            ..Configuration::default()
        }
    }

    fn insert(&self, into: &Insertions) -> Inserted {
        insert::insert(into)
    }

    fn drive(&self, steps: &[Step], _: &Settings) -> Option<String> {
        let mut out = ".PROGRAM measure()\n".to_owned();
        drive::add(
            &mut out,
            steps,
            "; ",
            "BREAK\nTWAIT 3\n",
            |axes, measured| {
                let speed = if measured { 5 } else { 20 };
                format!("SPEED {speed}\nJMOVE #[{}]\n", axes.join(","))
            },
        );
        Some(out + ".END\n")
    }

    /// Comments in the first program, else in one of their own at the end.
    fn deciding(&self) -> Option<&'static Deciding> {
        Some(&deciding::MANNER)
    }

    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        let (bytes, end) = (&source.bytes, source.line_end());
        let text = comments(source, marker, ";");
        let found = sections::read(source).unwrap_or_default();
        let first = found.programs.first();
        let first = first.map(|program| program.place.offset as usize);
        if let Some(at) = first.and_then(|at| line_behind(bytes, at)) {
            return (at, text);
        }
        let is_closed = bytes.last().is_none_or(|b| matches!(b, b'\n' | b'\r'));
        let before: &[u8] = if is_closed { b"" } else { end };
        let whole = [before, b".PROGRAM poseshift()", end, &text, b".END", end];
        (bytes.len(), whole.concat())
    }
}

/// The pose of `x y z O A T`.
fn pose_of(n: [f64; 6]) -> Pose {
    Pose {
        rotation: Rotation::about_z(n[3] * DEG)
            * Rotation::about_y(n[4] * DEG)
            * Rotation::about_z(n[5] * DEG),
        translation: [n[0], n[1], n[2]].map(m_from_mm),
    }
}

/// Below this sine of A only the sum or difference of O and T counts.
const SINGULAR: f64 = 1e-9;

/// O, A, T in degrees: of the two triples that every rotation has the one nearer to the present,
/// each angle by whole rotations; where A is 0 or 180 O stays as it is.
fn nearest_angles(rotation: &Rotation, present: [f64; 3]) -> [f64; 3] {
    let m = rotation.0;
    let sine = m[0][2].hypot(m[1][2]);
    if sine < SINGULAR {
        let o = present[0] * DEG;
        let turned = Rotation::about_z(-o).0;
        // what is left is Ry(A) · Rz(T)
        let row = |j: usize| turned[1][0] * m[0][j] + turned[1][1] * m[1][j];
        let t = row(0).atan2(row(1));
        return notation::near([present[0], sine.atan2(m[2][2]) / DEG, t / DEG], present);
    }
    let [o, a, t] = rotation.rzryrz().map(|angle| angle / DEG);
    notation::nearest_of([o, a, t], [o + 180.0, -a, t + 180.0], present, 0.0)
}

#[cfg(test)]
mod tests;
