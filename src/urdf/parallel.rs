//! Axes that are parallel, square to one another or meet but for the rounding of a file's numbers.
//!
//! A frame's angles, its place and an axis's direction are known to the last decimal that stands
//! there. What two axes are less apart than these leave open is taken as exact: the common normal of
//! axes that are nearly parallel would lie kilometres away, at a place that says nothing, and a wrist
//! whose axes nearly meet would have no closed-form inverse. Frames whose angles are multiples of
//! 45° leave nothing open.

use super::UrdfArm;
use crate::geometry::{Vector, add, cross, dot, norm, scale, sub};
use std::f64::consts::FRAC_PI_4;

/// So many units of the last decimal two axes may be apart: half a unit for each of three angles in
/// each of two frames, and for each coordinate of two axes, rarely all in one sense.
const UNITS: f64 = 4.0;
/// Axes farther apart are not parallel however few decimals stand there, radians.
const MOST_RAD: f64 = 1e-3;
/// Nor do axes that pass one another by more meet, metres.
const MOST_M: f64 = 1e-3;
/// What angles leave open moves a line by as much as far from its frame as this, metres.
const LEVER_M: f64 = 1.0;
/// Nor are numbers rounded that have as many decimals.
const ALL: usize = 12;
/// Less is rounding of the computation, radians and metres.
const NOTHING: f64 = 1e-15;

/// How many decimals the numbers have that say where an axis stands to the one before.
#[derive(Clone, Copy, Default)]
struct Of {
    angles: usize,
    places: usize,
    direction: usize,
}

/// The same of every axis.
#[derive(Default)]
pub(super) struct Digits {
    /// Of frames since the axis before.
    since: Of,
    axes: Vec<Of>,
}

/// Decimals of a number as it is written.
fn decimals(x: f64) -> usize {
    let written = format!("{}", x.abs());
    written
        .split_once('.')
        .map_or(0, |(_, behind)| behind.len())
}

fn most(numbers: &[f64]) -> usize {
    numbers.iter().map(|x| decimals(*x)).max().unwrap_or(0)
}

/// Units of the last of so many decimals; nothing of whole numbers, as 0 0 1: they are meant so.
fn units(decimals: usize) -> f64 {
    let power = i32::try_from(decimals).unwrap_or(i32::MAX);
    match decimals {
        0 | ALL.. => 0.0,
        _ => UNITS * 0.1_f64.powi(power),
    }
}

/// Two lines that do not run alike: the shortest step from the one to the other, and how far along
/// the first it is.
fn between((p, z): (Vector, Vector), (q, w): (Vector, Vector)) -> (Vector, f64) {
    let out = cross(z, w);
    let squared = dot(out, out);
    let step = sub(q, p);
    (
        scale(dot(step, out) / squared, out),
        dot(cross(step, w), out) / squared,
    )
}

impl Digits {
    /// A frame on the way to the next axis: its angles as they are taken, radians, and as they are
    /// written; its place, metres.
    pub(super) fn frame(&mut self, taken: [f64; 3], written: [f64; 3], place: &Vector) {
        let is_general = |angle: f64| {
            let parts = angle / FRAC_PI_4;
            (parts - parts.round()).abs() > 1e-12
        };
        let general = taken
            .iter()
            .zip(written)
            .filter(|(taken, _)| is_general(**taken));
        let general: Vec<f64> = general.map(|(_, written)| written).collect();
        self.since.angles = self.since.angles.max(most(&general));
        self.since.places = self.since.places.max(most(place));
    }

    /// An axis's direction as it is written, of any length.
    pub(super) fn axis(&mut self, direction: &Vector) {
        self.since.direction = most(direction);
        self.axes.push(self.since);
        self.since = Of::default();
    }

    /// What rounding leaves open of the angle between an axis and the one before, radians.
    fn open_rad(&self, axis: usize) -> f64 {
        let own = self.axes[axis];
        let all = [own.angles, own.direction, self.axes[axis - 1].direction];
        all.map(units).into_iter().fold(0.0, f64::max).min(MOST_RAD)
    }

    /// And of how far they pass one another, metres.
    fn open_m(&self, axis: usize) -> f64 {
        let angle = self.open_rad(axis);
        if angle > 0.0 {
            (units(self.axes[axis].places) + LEVER_M * angle).min(MOST_M)
        } else {
            0.0
        }
    }

    /// Makes exact what is so but for rounding, and says it.
    pub(super) fn make_exact(&self, arm: &mut UrdfArm) {
        let (mut most_rad, mut most_m) = (0.0_f64, 0.0_f64);
        for axis in 1..arm.joints.len() {
            let limit_rad = self.open_rad(axis);
            if limit_rad == 0.0 {
                continue;
            }
            let off_rad = turn(arm, axis, limit_rad);
            most_rad = most_rad.max(off_rad);
            most_m = most_m.max(shift(arm, axis, self.open_m(axis)));
            let [before, own] = [axis - 1, axis].map(|joint| line(arm, joint).1);
            if off_rad > 0.0 && norm(cross(before, own)) < NOTHING {
                arm.notes.push(format!(
                    "the axes of `{}` and `{}` are taken as parallel: they are {off_rad:.1e} rad \
                     apart, and the file's decimals leave {limit_rad:.1e} rad open; \
                     --exact-angles takes them as written",
                    arm.joints[axis - 1].name,
                    arm.joints[axis].name
                ));
            }
        }
        let turned = (most_rad > 0.0).then(|| {
            format!("within {most_rad:.1e} rad of a multiple of 45 deg to the one before")
        });
        let shifted =
            (most_m > 0.0).then(|| format!("that pass the one before by at most {most_m:.1e} m"));
        let which: Vec<String> = turned.into_iter().chain(shifted).collect();
        if !which.is_empty() {
            arm.notes.push(format!(
                "axes {} are taken as exact: the file's decimals leave that open; --exact-angles \
                 takes them as written",
                which.join(", and those ")
            ));
        }
    }
}

/// A point of an axis and its direction at zero, in the base.
fn line(arm: &UrdfArm, joint: usize) -> (Vector, Vector) {
    let frame = arm.frames()[joint + 1];
    (frame.translation, frame.rotation * arm.joints[joint].axis)
}

/// Turns an axis to a multiple of 45° from the one before where it is within a limit; by how much,
/// radians.
fn turn(arm: &mut UrdfArm, axis: usize, limit_rad: f64) -> f64 {
    let [before, own] = [axis - 1, axis].map(|joint| line(arm, joint).1);
    let across = cross(before, own);
    let angle = norm(across).atan2(dot(before, own));
    let parts = (angle / FRAC_PI_4).round();
    let off_rad = (angle - parts * FRAC_PI_4).abs();
    if off_rad < NOTHING || off_rad > limit_rad {
        return 0.0;
    }
    let exact = if parts == 0.0 || (parts - 4.0).abs() < 0.5 {
        scale(if parts == 0.0 { 1.0 } else { -1.0 }, before)
    } else {
        let square = cross(across, before);
        let square = scale(norm(square).recip(), square);
        let (sine, cosine) = (parts * FRAC_PI_4).sin_cos();
        let cosine = if (parts - 2.0).abs() < 0.5 {
            0.0
        } else {
            cosine
        };
        add(scale(cosine, before), scale(sine, square))
    };
    let frame = arm.frames()[axis + 1];
    arm.joints[axis].axis = frame.rotation.transpose() * exact;
    off_rad
}

/// Moves an axis, with all behind it, so that it meets the one before where it passes it within a
/// limit, and that where it is met by the one before it; by how much, metres.
fn shift(arm: &mut UrdfArm, axis: usize, limit_m: f64) -> f64 {
    let is_along = |arm: &UrdfArm, axis: usize| {
        let [before, own] = [axis - 1, axis].map(|joint| line(arm, joint).1);
        norm(cross(before, own)) < MOST_RAD
    };
    let mut moved_m = 0.0_f64;
    let mut by = |arm: &mut UrdfArm, step: Vector| {
        let far = norm(step);
        if far < NOTHING || far > limit_m {
            return far < NOTHING;
        }
        let joint = &arm.frames()[axis];
        let back = joint.rotation.transpose() * scale(-1.0, step);
        let place = &mut arm.joints[axis].before_from_joint.translation;
        *place = add(*place, back);
        moved_m = moved_m.max(far);
        true
    };
    if is_along(arm, axis) {
        return 0.0;
    }
    let (gap, _) = between(line(arm, axis - 1), line(arm, axis));
    let meets = by(arm, gap);
    if meets && axis > 1 && !is_along(arm, axis - 1) {
        let middle = line(arm, axis - 1);
        let (_, there) = between(middle, line(arm, axis));
        let (gap, first) = between(middle, line(arm, axis - 2));
        if norm(gap) < 1e-12 {
            by(arm, scale(there - first, middle.1));
        }
    }
    moved_m
}

#[cfg(test)]
mod tests {
    use crate::geometry::{Vector, cross, norm};
    use crate::inverse::Arm;
    use crate::model::profile::{Mounted, Profile};
    use crate::urdf::{About, Choice, UrdfArm, UrdfError, profile_text};

    /// Six axes in frames that are turned in any direction, with so many decimals; the third is
    /// tilted to the second, which it is else parallel to.
    fn arm(decimals: usize, tilt_rad: f64) -> String {
        const PLACES: [([f64; 3], [f64; 3], [f64; 3]); 6] = [
            ([0.0, 0.0, 0.3], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.1, 0.0, 0.1], [0.7, -0.4, 1.1], [0.0, 1.0, 0.0]),
            ([0.1, 0.0, 0.7], [-1.2, 0.6, 2.3], [0.0, 1.0, 0.0]),
            ([0.3, 0.0, 0.75], [2.9, 0.3, -0.8], [1.0, 0.0, 0.0]),
            ([0.7, 0.0, 0.75], [0.5, 1.1, 0.2], [0.0, 1.0, 0.0]),
            ([0.7, 0.0, 0.75], [-0.3, -0.9, 1.7], [1.0, 0.0, 0.0]),
        ];
        let mut text = String::from("<robot name='r'><link name='l0'/>");
        let mut before = crate::geometry::Pose::identity();
        for (k, (place, [roll, pitch, yaw], axis)) in PLACES.into_iter().enumerate() {
            let rotation = crate::geometry::Rotation::from_rzryrx([yaw, pitch, roll]);
            let frame = crate::geometry::Pose {
                rotation,
                translation: place,
            };
            let step = before.inverse() * frame;
            let tilted = [0.0, tilt_rad.cos(), tilt_rad.sin()];
            let own = rotation.transpose() * if k == 2 { tilted } else { axis };
            let r = step.rotation.0;
            let rpy = [
                r[2][1].atan2(r[2][2]),
                -r[2][0].asin(),
                r[1][0].atan2(r[0][0]),
            ];
            let three = |v: Vector| v.map(|x| format!("{x:.decimals$}")).join(" ");
            text += &format!(
                "<link name='l{0}'/><joint name='j{0}' type='revolute'><parent link='l{1}'/>\
                 <child link='l{0}'/><origin xyz='{2}' rpy='{3}'/><axis xyz='{4}'/>\
                 <limit lower='-2' upper='2' effort='1' velocity='1'/></joint>",
                k + 1,
                k,
                three(step.translation),
                three(rpy),
                three(own)
            );
            before = frame;
        }
        text + "</robot>"
    }

    fn made(text: &str, exact: bool) -> Result<(String, Vec<String>), UrdfError> {
        let choice = Choice {
            exact,
            ..Choice::default()
        };
        let arm = UrdfArm::read(text, &choice).expect("an arm");
        profile_text(&arm, &About::of("arm.urdf", &|_| None))
    }

    #[test]
    fn axes_that_rounding_tilts_are_parallel() {
        let parallel = |notes: &[String]| notes.iter().any(|note| note.contains("`j2` and `j3`"));
        let best = UrdfArm::read(&arm(16, 0.0), &Choice::default()).expect("an arm");
        for decimals in [4, 5, 6, 8] {
            let text = arm(decimals, 0.0);
            let (profile, notes) = made(&text, false).expect("a profile");
            assert!(parallel(&notes), "{decimals}: {notes:?}");
            let profile = Profile::from_yaml(&profile).expect("a profile");
            let inverse = Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism);
            assert!(inverse.is_ok(), "{decimals}: {:?}", inverse.err());
            let arm = UrdfArm::read(&text, &Choice::default()).expect("an arm");
            let frames = arm.frames();
            let axis = |i: usize| frames[i + 1].rotation * arm.joints[i].axis;
            assert!(norm(cross(axis(1), axis(2))) < 1e-15, "{decimals}");
            let q = [0.3, -0.7, 0.9, -1.1, 0.6, 1.4];
            let off = arm.forward(&q).separation(&best.forward(&q));
            let unit = 0.1_f64.powi(i32::try_from(decimals).expect("few"));
            assert!(off.distance_m < 10.0 * unit, "{decimals}: {off:?}");
        }
        let (_, notes) = made(&arm(16, 0.0), false).expect("a profile");
        assert!(!parallel(&notes), "{notes:?}");
    }

    #[test]
    fn what_was_not_rounded_is_not_said() {
        // the second axis is square to the first and passes it by what four decimals leave
        let square = "1.5707963267948966 0 0";
        let places = [
            ("0 0 0.3", "0 0 0"),
            ("0.0644 -0.0765 0.1", "1.5707963267948966 0 0.7"),
            ("0.3 0 0", "0 0 0"),
            ("0.1 0 0.05", square),
            ("0 0 0.2", square),
            ("0 0 0", square),
        ];
        let joints = places.iter().enumerate().map(|(k, (place, turn))| {
            format!(
                "<link name='l{0}'/><joint name='j{0}' type='revolute'><parent link='l{k}'/>\
                 <child link='l{0}'/><origin xyz='{place}' rpy='{turn}'/><axis xyz='0 0 1'/>\
                 <limit lower='-2' upper='2' effort='1' velocity='1'/></joint>",
                k + 1
            )
        });
        let joints: String = joints.collect();
        let text = format!("<robot name='r'><link name='l0'/>{joints}</robot>");
        let arm = UrdfArm::read(&text, &Choice::default()).expect("an arm");
        let notes = &arm.notes;
        let is_said = |words: &str| notes.iter().any(|note| note.contains(words));
        assert!(is_said("that pass the one before by at most"), "{notes:?}");
        assert!(!is_said("0.0e0"), "{notes:?}");
    }

    #[test]
    fn common_normals_far_away_are_refused_by_name() {
        let error = made(&arm(8, 0.0), true).expect_err("as it is written");
        let said = format!("{error} {}", error.hint());
        for words in ["`j2`", "`j3`", "common normal", "--exact-angles"] {
            assert!(said.contains(words), "{said}");
        }
        // tilted beyond what its decimals leave open
        let (_, notes) = made(&arm(8, 1e-2), false).expect("a profile");
        assert!(
            !notes.iter().any(|note| note.contains("as parallel")),
            "{notes:?}"
        );
    }
}
