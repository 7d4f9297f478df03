//! Where steps lead that the program may make or not, once or again and again.

use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Rotation, Vector, add, norm, scale};
use crate::program::{Shift, Stride};
use std::f64::consts::{PI, TAU};

/// Places that are looked at of what steps lead to.
const MOST_PLACES: f64 = 4000.0;
/// Repetitions of one step that are looked at.
const MOST_OF_ONE: usize = 400;
/// Repetitions of a step that are gone through to find those.
const MOST_REPEATED: u32 = 100_000;
/// A step shorter than this, metres, or a rotation smaller than this, radians, is none.
const NO_STEP: f64 = 1e-9;
/// Rotations by an unknown angle are looked at so far apart.
const TURN_RAD: f64 = 30.0 * DEG;

/// The displacements that are looked at, with none of the steps left out; no farther than
/// `reach_m`, beyond which no tool is at both ends.
pub(super) fn places(strides: &[Stride], reach_m: f64) -> Vec<Shift> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let each = match strides.len() {
        0 | 1 => MOST_OF_ONE,
        count => MOST_PLACES.powf(1.0 / count as f64) as usize,
    };
    let mut all = vec![Shift::none()];
    for stride in strides {
        let of_one = match stride {
            Stride::By { shift, most } => repeated(shift, *most, reach_m, each),
            Stride::Turned(angle) => turned(*angle),
        };
        all = all
            .iter()
            .flat_map(|before| of_one.iter().map(|next| before.then(next)))
            .collect();
    }
    all
}

/// The steps in words, behind *takes its correction along*.
pub(super) fn in_words(strides: &[Stride]) -> String {
    let each = strides.iter().map(|stride| match stride {
        Stride::By { shift, most } => {
            let [x, y, z] = add(shift.in_frame.translation, shift.in_tool.translation);
            let by = [x, y, z].map(mm_from_m);
            let angle = shift.in_frame.rotation.angle() + shift.in_tool.rotation.angle();
            let mut words = Vec::new();
            if norm(by) > NO_STEP {
                words.push(format!("({:.1}, {:.1}, {:.1}) mm", by[0], by[1], by[2]));
            }
            if angle > NO_STEP {
                words.push(format!("{:.1} deg", angle / DEG));
            }
            let times = match most {
                Some(1) => "once".into(),
                Some(most) => format!("up to {most} times"),
                None => "any number of times".into(),
            };
            format!("{times} by {}", words.join(" and "))
        }
        Stride::Turned(Some(angle)) => format!("turned by {:.1} deg", angle.abs() / DEG),
        Stride::Turned(None) => "turned by what only the running program knows".into(),
    });
    each.collect::<Vec<_>>().join(" and ")
}

/// A step made 0 times, once, and so on to as often as it may be: some of these, evenly.
fn repeated(shift: &Shift, most: Option<u32>, reach_m: f64, each: usize) -> Vec<Shift> {
    let times = most.unwrap_or(u32::MAX).min(within_reach(shift, reach_m));
    let every = times
        .div_ceil(u32::try_from(each).unwrap_or(u32::MAX))
        .max(1);
    let mut all = vec![Shift::none()];
    let mut here = Shift::none();
    for count in 1..=times {
        here = here.then(shift);
        if count == 1 || count % every == 0 || count == times {
            all.push(here);
        }
    }
    all
}

/// After how many repetitions a step has left the reach, or gone round.
fn within_reach(shift: &Shift, reach_m: f64) -> u32 {
    let times = |of: f64, one: f64| {
        if one < NO_STEP {
            0.0
        } else {
            (of / one).ceil()
        }
    };
    let parts = [&shift.in_frame, &shift.in_tool].map(|pose| {
        let along = times(reach_m, norm(pose.translation));
        along.max(times(TAU, pose.rotation.angle()))
    });
    let most = parts[0].max(parts[1]).min(f64::from(MOST_REPEATED));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let most = most as u32;
    most
}

/// Rotations about the origin of the tool: by an angle where it is known, about axes all around.
fn turned(angle: Option<f64>) -> Vec<Shift> {
    let mut angles = Vec::new();
    if let Some(angle) = angle {
        angles.extend([angle, -angle]);
    } else {
        let mut at = TURN_RAD;
        while at < PI + NO_STEP {
            angles.extend([at, -at]);
            at += TURN_RAD;
        }
    }
    let mut all = vec![Shift::none()];
    for axis in axes() {
        all.extend(angles.iter().map(|angle| Shift {
            in_frame: Pose::identity(),
            in_tool: Pose::from_rotation(Rotation::from_vector(scale(*angle, axis))),
        }));
    }
    all
}

/// Directions to the middles of the faces, edges and corners of a cube, one of each opposite pair.
fn axes() -> impl Iterator<Item = Vector> {
    (14..27).map(|number: u32| {
        let part = |of: u32| f64::from(number / of % 3) - 1.0;
        let axis = [part(9), part(3), part(1)];
        scale(1.0 / norm(axis), axis)
    })
}

/// Along each axis of the work frame, both ways, by so much.
pub(super) fn along_each_axis(by_m: f64) -> impl Iterator<Item = Shift> {
    (0..6).map(move |side| {
        let mut by = [0.0; 3];
        by[side / 2] = if side % 2 == 0 { by_m } else { -by_m };
        Shift::along(by)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn by(shift: Shift, most: Option<u32>) -> Stride {
        Stride::By { shift, most }
    }

    #[test]
    fn a_step_is_made_as_often_as_it_may_be_or_as_far_as_the_arm_reaches() {
        let down = Shift::along([0.0, 0.0, -0.02]);
        let lowest = |most| {
            let all = places(&[by(down, most)], 2.0);
            let z = all.iter().map(|shift| shift.in_frame.translation[2]);
            (all.len(), z.fold(0.0, f64::min))
        };
        assert_eq!(lowest(Some(3)).0, 4, "none, one, two, three");
        assert!((lowest(Some(3)).1 + 0.06).abs() < 1e-12);
        assert!((lowest(None).1 + 2.0).abs() < 1e-9, "{:?}", lowest(None));
        let short = places(&[by(Shift::along([1e-5, 0.0, 0.0]), None)], 2.0);
        assert!(short.len() <= MOST_OF_ONE + 2);
    }

    #[test]
    fn rotations_about_the_tool_go_round_once() {
        let turn = Shift {
            in_frame: Pose::identity(),
            in_tool: Pose::from_rotation(Rotation::about_z(90.0 * DEG)),
        };
        assert_eq!(places(&[by(turn, None)], 2.0).len(), 5);
    }

    #[test]
    fn two_steps_are_made_in_every_number() {
        let (x, y) = (Shift::along([0.1, 0.0, 0.0]), Shift::along([0.0, 0.2, 0.0]));
        let all = places(&[by(x, Some(2)), by(y, Some(1))], 2.0);
        assert_eq!(all.len(), 6);
        let farthest = Shift::along([0.2, 0.2, 0.0]);
        assert!(all.contains(&farthest), "{all:?}");
    }

    #[test]
    fn an_angle_about_an_unknown_axis_is_looked_at_about_axes_all_around() {
        let all = turned(Some(0.3));
        assert_eq!(all.len(), 27);
        let angle = |shift: &Shift| shift.in_tool.rotation.angle();
        assert!(
            all[1..]
                .iter()
                .all(|shift| (angle(shift) - 0.3).abs() < 1e-12)
        );
        let about = |rotation: Rotation| {
            let mut near = all.iter();
            near.any(|shift| (shift.in_tool.rotation.transpose() * rotation).angle() < 1e-9)
        };
        assert!(about(Rotation::about_x(0.3)) && about(Rotation::about_z(-0.3)));
        assert!(!about(Rotation::about_y(0.2)));
    }
}
