//! Where steps lead that the program may make or not, once or again and again.

use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Rotation, Vector, add, norm, scale, sub};
use crate::program::{Shift, Stride};
use std::f64::consts::{PI, TAU};

/// Places that are looked at of what steps lead to.
const MOST_PLACES: usize = 4000;
/// Repetitions of a step that rotates that are gone through.
const MOST_REPEATED: u32 = 100_000;
/// Places of those that rotate the tool, and of others with each of them at least.
const MOST_ROTATED: usize = 400;
const LEAST_PLACES: usize = 64;
/// Steps that rotate the tool that are looked at together.
const MOST_ROTATING: usize = 4;
/// Steps that are named one by one; more are named by what they come to.
const MOST_SAID: u32 = 1000;
/// A step shorter than this, metres, or a rotation smaller than this, radians, is none.
const NO_STEP: f64 = 1e-9;
/// How far the corners of a body with a corner on each of [`axes`], both ways, are from its middle,
/// where a ball of radius 1 fits into it, rounded up: |n| of the plane n·p = 1 through (1, 0, 0),
/// (1, 1, 0)/√2 and (1, 1, 1)/√3, with n = (1, √2-1, √3-√2).
const CORNER: f64 = 1.128_2;
/// Rotations by an unknown angle are looked at so far apart.
const TURN_RAD: f64 = 30.0 * DEG;

/// The displacements that are looked at, with none of the steps left out; no farther than
/// `reach_m`, beyond which no tool is at both ends. Where they are too many for all to be looked
/// at, or `filled` says so, all that lies between is meant, and looked at evenly. `None` where
/// these are too many to say anything.
pub(super) fn places(strides: &[Stride], reach_m: f64, filled: bool) -> Option<Vec<Shift>> {
    let each = |stride: &Stride| match stride {
        Stride::By { shift, most } => most
            .unwrap_or(u32::MAX)
            .min(within_reach(shift, reach_m))
            .saturating_add(1) as usize,
        Stride::Turned(angle) => turned(*angle).len(),
        Stride::Read { .. } => 1,
    };
    let count = |of: &mut dyn Iterator<Item = &Stride>| of.map(each).fold(1, usize::saturating_mul);
    if !filled && count(&mut strides.iter()) <= MOST_PLACES {
        return Some(product(strides.iter().map(|stride| match stride {
            Stride::By { shift, most } => repeated(shift, *most, reach_m, usize::MAX),
            Stride::Turned(angle) => turned(*angle),
            Stride::Read { .. } => vec![Shift::none()],
        })));
    }
    let is_straight = |stride: &&Stride| match stride {
        Stride::By { shift, .. } => line_of(shift).is_some(),
        Stride::Turned(_) | Stride::Read { .. } => false,
    };
    let steps = strides
        .iter()
        .filter(|of| !matches!(of, Stride::Read { .. }));
    let (straight, rotating): (Vec<&Stride>, Vec<&Stride>) = steps.partition(is_straight);
    if rotating.len() > MOST_ROTATING {
        return None;
    }
    let each = evenly(MOST_ROTATED, rotating.len());
    let rotated = product(rotating.into_iter().map(|stride| match stride {
        Stride::By { shift, most } => repeated(shift, *most, reach_m, each),
        Stride::Turned(angle) => {
            let all = turned(*angle);
            let every = all.len().div_ceil(each);
            all.into_iter().step_by(every).collect()
        }
        Stride::Read { .. } => vec![Shift::none()],
    }));
    let lines = lines(&straight, reach_m);
    let each = evenly((MOST_PLACES / rotated.len()).max(LEAST_PLACES), lines.len());
    let moved = product(lines.iter().map(|line| line.places(each)));
    Some(product([moved, rotated].into_iter()))
}

/// How many of each of so many sets are looked at for so many places altogether.
fn evenly(places: usize, sets: usize) -> usize {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss
    )]
    let each = (places as f64).powf(1.0 / sets.max(1) as f64) as usize;
    each.max(3)
}

/// One of each set after another.
fn product(sets: impl Iterator<Item = Vec<Shift>>) -> Vec<Shift> {
    sets.fold(vec![Shift::none()], |all, of_one| {
        all.iter()
            .flat_map(|before| of_one.iter().map(|next| before.then(next)))
            .collect()
    })
}

/// A straight line on which steps lead, from `least` to `most` along its direction.
struct Line {
    direction: Vector,
    in_tool: bool,
    least: f64,
    most: f64,
}

impl Line {
    fn at(&self, by_m: f64) -> Shift {
        let [x, y, z] = scale(by_m, self.direction);
        let by = Pose::from_translation(x, y, z);
        if self.in_tool {
            Shift {
                in_tool: by,
                ..Shift::none()
            }
        } else {
            Shift {
                in_frame: by,
                ..Shift::none()
            }
        }
    }

    /// So many places on it, its ends and none among them.
    fn places(&self, count: usize) -> Vec<Shift> {
        let count = u32::try_from(count).unwrap_or(u32::MAX);
        let part = |at: u32| f64::from(at) / f64::from(count.saturating_sub(2).max(1));
        let even =
            (0..count.saturating_sub(1)).map(|at| self.least + part(at) * (self.most - self.least));
        std::iter::once(0.0)
            .chain(even)
            .map(|by| self.at(by))
            .collect()
    }
}

/// The translation of a step that is no more, and whether it is in the tool.
fn line_of(shift: &Shift) -> Option<(Vector, bool)> {
    let is_none = |pose: &Pose| *pose == Pose::identity();
    let is_straight = |pose: &Pose| pose.rotation == Rotation::identity();
    match (is_none(&shift.in_frame), is_none(&shift.in_tool)) {
        (_, true) if is_straight(&shift.in_frame) => Some((shift.in_frame.translation, false)),
        (true, _) if is_straight(&shift.in_tool) => Some((shift.in_tool.translation, true)),
        _ => None,
    }
}

/// The lines on which straight steps lead: one of each direction, or along the three axes of the
/// work frame where there are more.
fn lines(strides: &[&Stride], reach_m: f64) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    let extend = |lines: &mut Vec<Line>, direction: Vector, in_tool: bool, by_m: f64| {
        let is_same = |line: &&mut Line| {
            line.in_tool == in_tool && norm(sub(line.direction, direction)) < NO_STEP
        };
        let back = scale(-1.0, direction);
        let is_back =
            |line: &&mut Line| line.in_tool == in_tool && norm(sub(line.direction, back)) < NO_STEP;
        if let Some(line) = lines.iter_mut().find(is_same) {
            line.most = (line.most + by_m).min(reach_m);
        } else if let Some(line) = lines.iter_mut().find(is_back) {
            line.least = (line.least - by_m).max(-reach_m);
        } else {
            lines.push(Line {
                direction,
                in_tool,
                least: 0.0,
                most: by_m.min(reach_m),
            });
        }
    };
    for stride in strides {
        if let Stride::By { shift, most } = stride
            && let Some((by, in_tool)) = line_of(shift)
        {
            let length = norm(by);
            if length > 0.0 {
                let far = most.map_or(reach_m, |most| length * f64::from(most));
                extend(&mut lines, scale(1.0 / length, by), in_tool, far);
            }
        }
    }
    if lines.len() <= 3 {
        return lines;
    }
    let mut all = Vec::new();
    let signed = |axis: usize, by: f64| {
        let mut direction = [0.0; 3];
        direction[axis] = by.signum();
        direction
    };
    for line in &lines {
        for axis in 0..3 {
            // however the tool stands, what is added in it is no longer in the work frame
            let longest = line.most.max(-line.least);
            let ends = if line.in_tool {
                [longest, -longest]
            } else {
                [line.most, line.least].map(|end| end * line.direction[axis])
            };
            for by in ends.into_iter().filter(|by| *by != 0.0) {
                extend(&mut all, signed(axis, by), false, by.abs());
            }
        }
    }
    all
}

/// The steps in words, behind *displaced*.
pub(super) fn in_words(strides: &[Stride]) -> String {
    let each = strides.iter().filter_map(|stride| match stride {
        Stride::By { shift, most } => {
            // so many steps stand for all between two places
            let all = most.filter(|most| *most > MOST_SAID);
            let times = match most {
                _ if all.is_some() => "by up to".into(),
                Some(1) => "by".into(),
                Some(most) => format!("up to {most} times by"),
                None => "any number of times by".into(),
            };
            let by = shift_in_words(shift, f64::from(all.unwrap_or(1)));
            (!by.is_empty()).then(|| format!("{times} {by}"))
        }
        Stride::Turned(Some(angle)) => Some(format!("turned by {:.1} deg", angle.abs() / DEG)),
        Stride::Turned(None) => Some("turned by what only the running program knows".into()),
        Stride::Read { .. } => Some(
            "by what the correction changes of the coordinates that this is worked out from".into(),
        ),
    });
    let mut each: Vec<String> = each.collect();
    let last = each.pop().unwrap_or_default();
    if each.is_empty() {
        return last;
    }
    format!("{} and {last}, or by some of these", each.join(", "))
}

/// So many times a shift; nothing where it is none.
fn shift_in_words(shift: &Shift, times: f64) -> String {
    let by = add(shift.in_frame.translation, shift.in_tool.translation);
    // no -0.0
    let [x, y, z] = scale(times, by).map(|m| mm_from_m(m) + 0.0);
    let angle = times * (shift.in_frame.rotation.angle() + shift.in_tool.rotation.angle()) / DEG;
    let mut words = Vec::new();
    if norm([x, y, z]) > NO_STEP {
        let n = decimals([x, y, z]);
        words.push(format!("({x:.n$}, {y:.n$}, {z:.n$}) mm"));
    }
    if angle > NO_STEP {
        words.push(format!("{angle:.*} deg", decimals([angle])));
    }
    words.join(" and ")
}

/// The decimals that numbers of a text have, as far as they show: one to five.
fn decimals<const N: usize>(numbers: [f64; N]) -> usize {
    let shows = |decimals: &usize| {
        let text = |x: f64| format!("{x:.decimals$}").parse();
        let is_exact = |x: f64| text(x).is_ok_and(|y: f64| (x - y).abs() < 1e-6);
        numbers.into_iter().all(is_exact)
    };
    (1..=5).find(shows).unwrap_or(5)
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

/// The corners of a body around all that is no farther than so much, along the axes of the work
/// frame and of the tool: an error that grows evenly is nowhere inside larger than at the worst of
/// them.
pub(super) fn all_around(by_m: f64) -> impl Iterator<Item = Shift> {
    axes().flat_map(move |axis| {
        [by_m, -by_m].into_iter().flat_map(move |by_m| {
            let Shift { in_frame, in_tool } = Shift::along(scale(CORNER * by_m, axis));
            // the axes of the tool rotate with the correction
            let swapped = Shift {
                in_frame: in_tool,
                in_tool: in_frame,
            };
            [Shift { in_frame, in_tool }, swapped]
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::array::uniform3;
    use proptest::prelude::*;

    fn by(shift: Shift, most: Option<u32>) -> Stride {
        Stride::By { shift, most }
    }

    fn every(strides: &[Stride]) -> Vec<Shift> {
        places(strides, 2.0, false).expect("few steps")
    }

    /// The place of these that is nearest to one, and how far from it.
    fn nearest(all: &[Shift], to: Vector) -> f64 {
        let gaps = all
            .iter()
            .map(|shift| norm(sub(shift.in_frame.translation, to)));
        gaps.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn places_near_the_target_are_looked_at_however_many_the_steps() {
        // six directions in steps of 0.1 mm: anywhere
        let jog: Vec<Stride> = (0..6)
            .map(|side| {
                let mut step = [0.0; 3];
                step[side / 2] = if side % 2 == 0 { 1e-4 } else { -1e-4 };
                by(Shift::along(step), None)
            })
            .collect();
        let all = every(&jog);
        assert!(all.len() <= MOST_PLACES);
        for to in [[0.0, 0.0, -0.3], [0.2, -0.2, 0.1], [-0.5, 0.5, 0.5]] {
            assert!(nearest(&all, to) < 0.25, "{to:?}: {}", nearest(&all, to));
        }
        // one step far beyond the reach, in many parts
        let far = every(&[by(Shift::along([0.0, 0.0, -0.03]), Some(4096))]);
        assert!(nearest(&far, [0.0, 0.0, -0.2]) < 0.02);
        // short ones and long ones: all that lies between
        let two = [1e-7, 0.02].map(|z| by(Shift::along([0.0, 0.0, -z]), None));
        assert!(nearest(&every(&two), [0.0, 0.0, -0.8]) < 0.01);
    }

    #[test]
    fn a_factor_that_nobody_knows_may_be_small_too() {
        let far = [by(Shift::along([0.0, 0.0, -5.0]), Some(1))];
        let filled = places(&far, 2.0, true).expect("one step");
        assert!(nearest(&filled, [0.0, 0.0, -0.2]) < 0.01);
        assert_eq!(every(&far).len(), 2);
    }

    #[test]
    fn steps_are_named_as_the_text_has_them_and_many_by_what_they_come_to() {
        let up = |z| Shift::along([0.0, 0.0, z]);
        let words = in_words(&[
            by(up(0.05), Some(1)),
            by(up(0.0), Some(1)),
            by(up(0.02), Some(3)),
            by(up(1e-7), None),
            by(up(-0.025), Some(4096)),
        ]);
        let wanted = "by (0.0, 0.0, 50.0) mm, up to 3 times by (0.0, 0.0, 20.0) mm, any number of \
            times by (0.0000, 0.0000, 0.0001) mm and by up to (0.0, 0.0, -102400.0) mm, or by some \
            of these";
        assert_eq!(words, wanted);
    }

    #[test]
    fn many_steps_that_rotate_are_not_looked_at() {
        let turn = Stride::Turned(None);
        let started = places(&vec![turn.clone(); 3], 2.0, false).expect("three");
        assert!(started.len() <= 2 * MOST_ROTATED, "{}", started.len());
        assert!(places(&vec![turn; 5], 2.0, false).is_none());
    }

    #[test]
    fn a_step_is_made_as_often_as_it_may_be_or_as_far_as_the_arm_reaches() {
        let down = Shift::along([0.0, 0.0, -0.02]);
        let lowest = |most| {
            let all = every(&[by(down, most)]);
            let z = all.iter().map(|shift| shift.in_frame.translation[2]);
            (all.len(), z.fold(0.0, f64::min))
        };
        assert_eq!(lowest(Some(3)).0, 4, "none, one, two, three");
        assert!((lowest(Some(3)).1 + 0.06).abs() < 1e-12);
        assert!((lowest(None).1 + 2.0).abs() < 1e-9, "{:?}", lowest(None));
        let short = every(&[by(Shift::along([1e-5, 0.0, 0.0]), None)]);
        let far = short.iter().map(|shift| shift.in_frame.translation[0]);
        assert!(short.len() <= MOST_PLACES && far.fold(0.0, f64::max) > 1.9999);
    }

    proptest! {
        #[test]
        fn corners_all_around_bound_what_grows_evenly(
            rows in uniform3(uniform3(-1.0..1.0)),
            constant in uniform3(-1.0..1.0),
            inside in uniform3(-1.0..1.0),
        ) {
            prop_assume!(norm(inside) > 0.0);
            let of = |by: Vector| {
                let grown = rows.map(|row: Vector| row.iter().zip(by).map(|(a, b)| a * b).sum());
                norm(add(constant, grown))
            };
            let corners = all_around(1.0).map(|shift| of(shift.in_frame.translation));
            let most = corners.fold(0.0, f64::max);
            prop_assert!(of(scale(1.0 / norm(inside), inside)) <= most);
        }
    }

    #[test]
    fn rotations_about_the_tool_go_round_once() {
        let turn = Shift {
            in_frame: Pose::identity(),
            in_tool: Pose::from_rotation(Rotation::about_z(90.0 * DEG)),
        };
        assert_eq!(every(&[by(turn, None)]).len(), 5);
    }

    #[test]
    fn two_steps_are_made_in_every_number() {
        let (x, y) = (Shift::along([0.1, 0.0, 0.0]), Shift::along([0.0, 0.2, 0.0]));
        let all = every(&[by(x, Some(2)), by(y, Some(1))]);
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
