//! How the tool stands at the point that an arc passes through.
//!
//! Three points are an arc; how the tool rotates on it goes from its beginning to its end. Most
//! controllers do not look at the orientation that is written for the point between: the robot
//! passes it in the rotation that the path has there, and it must be corrected in that one.

use super::arms::Equipped;
use super::course::{ToolCourse, ToolRotation};
use super::ground::Ground;
use super::passed;
use super::ride::Ride;
use super::walk::{Arrival, WalkOptions};
use crate::finding::{Finding, Severity};
use crate::geometry::units::DEG;
use crate::geometry::{Pose, Rotation};
use crate::model::Conditions;
use crate::program::{Before, Motion, Move};

/// A smaller rotation away from the path's is none.
const SAME_RAD: f64 = 0.01 * DEG;
/// A rotation that is seen from the path and a shorter one that differ by more are two: the
/// correction of a point does not change much within.
const MATTERS_RAD: f64 = 10.0 * DEG;
/// A rotation by more may be meant the longer way.
const LARGE_RAD: f64 = 90.0 * DEG;
/// The point between is taught on the longer way where it is as near to that.
const TAUGHT_RAD: f64 = 30.0 * DEG;
/// A larger one is reported where the controller takes up the orientation of the point.
const MOST_RAD: f64 = 1.0 * DEG;

/// From the tool as the numbers of an arc's middle point have it to the tool as the path has it
/// there: `path = numbers · middle`. `None` where the robot takes up the numbers' orientation, or
/// nobody knows the path.
pub(super) fn middle(
    ground: &Ground,
    walk_options: &WalkOptions,
    at: usize,
    start: &Arrival,
    wanted: &Pose,
    findings: &mut Vec<Finding>,
) -> Option<Rotation> {
    let motion = &ground.program.moves[at];
    if motion.motion != Motion::ArcVia {
        return None;
    }
    let ends: Vec<_> = ends_of(ground, at).collect();
    let equipped = ground.equipped(motion.tool)?;
    let from = start_pose(ground, equipped, start, walk_options);
    let of = |(end_at, end, _): &(usize, Pose, bool)| {
        let ride = ground.ride(Some(start.motion), &ground.program.moves[*end_at]);
        let ride = ride.filter(|ride| ride.moves());
        let on_part = |ride: &Ride, s: f64, pose: &Pose| ride.home_from_part(s).inverse() * *pose;
        let point = ground.ride(None, motion);
        let [from, via, end] = match ride.zip(point) {
            // it is an arc on the part
            Some((ride, point)) => [
                on_part(&ride, 0.0, &from),
                on_part(&point, 1.0, wanted),
                on_part(&ride, 1.0, end),
            ],
            None => [from, *wanted, *end],
        };
        let course = ToolCourse::arc(&from, via.translation, &end, walk_options.turning);
        let [from, to] = [from, end].map(|pose| pose.translation);
        let is_no_arc = ToolCourse::is_no_arc(from, via.translation, to);
        (course, via, end, is_no_arc)
    };
    let (course, via, end, is_no_arc) = of(ends.first()?);
    // with several beginnings or ends the text does not say which go together
    let is_one = ends.len() == 1 && ground.program.before(motion).len() == 1;
    if is_no_arc && is_one {
        findings.push(no_arc(ground, motion));
    }
    let there = course.rotation_at(via.translation);
    // as seen from the point: parts differ
    let middle = via.rotation.transpose() * there;
    let others = ends[1..].iter().map(|other| {
        let (course, via, ..) = of(other);
        let other = via.rotation.transpose() * course.rotation_at(via.translation);
        (middle.transpose() * other).angle()
    });
    let apart = others.fold(0.0, f64::max);
    if apart > SAME_RAD && !ground.language.turns_through_middle() {
        findings.push(ends_otherwise(ground, motion, apart));
    }
    if let Some(angle) = other_way(ground, &course, &end, &via, &there) {
        findings.push(turns_otherwise(ground, motion, angle));
    }
    if ground.language.turns_through_middle() {
        if middle.angle() > MOST_RAD {
            findings.push(rotated(ground, motion, middle.angle()));
        }
        return None;
    }
    let same = middle.angle() < SAME_RAD;
    Some(if same { Rotation::identity() } else { middle })
}

/// The point halfway to the middle of the arc that a move begins, from joints where it begins, the pose
/// of its middle and, where it is not as the program means it, that of its end; `None` where nobody
/// knows the arc, or it begins none. `ride`: what external axes do on the way to its middle.
pub(crate) fn halfway(
    ground: &Ground,
    turning: ToolRotation,
    at: usize,
    (start, via, to): (&[f64; 6], &Pose, Option<Pose>),
    ride: Option<&Ride>,
) -> Option<Pose> {
    let motion = &ground.program.moves[at];
    if motion.motion != Motion::ArcVia {
        return None;
    }
    let (end_at, end, moves_axes) = ends_of(ground, at).next()?;
    let controller = &ground.equipped(motion.tool)?.controller;
    let from = controller.forward(start, &Conditions::default());
    let half = |from: &Pose, via: &Pose, end: &Pose| {
        let course = ToolCourse::arc(from, via.translation, end, turning);
        course.pose(0.5 * course.part_at(via.translation))
    };
    if !moves_axes {
        return Some(half(&from, via, &to.unwrap_or(end)));
    }
    // it is an arc on the part
    let ride = ride.filter(|ride| ride.is_known())?;
    let last = ground.ride(None, &ground.program.moves[end_at])?;
    let on_part = |ride: &Ride, s: f64, pose: &Pose| ride.home_from_part(s).inverse() * *pose;
    let (from, via) = (on_part(ride, 0.0, &from), on_part(ride, 1.0, via));
    let there = half(&from, &via, &on_part(&last, 1.0, &end));
    Some(ride.home_from_part(0.5) * there)
}

/// By how much the tool may be rotated, on the way of an arc, away from where the shorter way from its
/// beginning to its end has it: as seen from the path, where the controller looks at it so, or since
/// the point between is taught on the longer way.
fn other_way(
    ground: &Ground,
    course: &ToolCourse,
    end: &Pose,
    via: &Pose,
    there: &Rotation,
) -> Option<f64> {
    let part = course.part_at(via.translation);
    if ground.language.turns_through_middle() {
        return None;
    }
    let away = |rotation: Rotation| (rotation.transpose() * *there).angle();
    if ground.language.turns_with_path() {
        let on_path = course.rotation_on_path(part, &end.rotation);
        return on_path.map(away).filter(|angle| *angle > MATTERS_RAD);
    }
    let (long, turned_by) = course.long_way(part)?;
    let to_long = (long.transpose() * via.rotation).angle();
    let is_taught = turned_by > LARGE_RAD && to_long < TAUGHT_RAD && to_long < away(via.rotation);
    is_taught.then(|| away(long))
}

/// Where the tool stands at an arrival. Joints of poses are those of the nominal arm where the walk
/// does not ask for a calibrated controller's own. Where a target stays as it is that is where the
/// real arm has it: the tool rotates from there.
fn start_pose(
    ground: &Ground,
    equipped: &Equipped,
    start: &Arrival,
    walk_options: &WalkOptions,
) -> Pose {
    let stands_as = ground.program.stands_as(start.motion);
    let before = &ground.program.moves[stands_as as usize];
    let is_in_joints = before.target.is_some_and(|of| ground.is_joints(of));
    let stays = before
        .target
        .is_none_or(|of| ground.program.targets[of].blocked)
        || is_in_joints && !walk_options.corrects_joints;
    let placed = &ground.setting.frames[ground.frame_of(before)];
    if let Some(placed) = placed.as_ref().filter(|_| walk_options.corrects && stays) {
        let conditions = Conditions {
            direction: start.direction.map(f64::from),
            gravity_m_s2: placed.gravity_m_s2,
            ..equipped.inverse.conditions
        };
        let real = equipped.inverse.real.forward(&start.q, &conditions);
        return placed.meant * placed.real.inverse() * real;
    }
    let is_own = walk_options.exact || is_in_joints;
    if is_own || equipped.calibrated_controller.is_none() {
        equipped
            .controller
            .forward(&start.q, &Conditions::default())
    } else {
        equipped.arm.forward(&start.q)
    }
}

/// The moves that end the arc through the point of a move, where they end, and whether external axes
/// move on them: several where a routine is called with several. None where nobody knows.
fn ends_of(ground: &Ground, at: usize) -> impl Iterator<Item = (usize, Pose, bool)> {
    passed::ends_of(ground.program, at).filter_map(move |end_at| {
        let (pose, moves_axes) = end_of(ground, at, &ground.program.moves[end_at])?;
        Some((end_at, pose, moves_axes))
    })
}

/// Where the arc through the point of a move ends with another one, and whether external axes move on
/// it; `None` where nobody knows.
fn end_of(ground: &Ground, at: usize, end: &Move) -> Option<(Pose, bool)> {
    let program = ground.program;
    end.target?;
    ground.equipped(end.tool)?;
    let frame = ground.frame_of(end);
    if ground.setting.frames[frame].is_none() || ground.is_adrift(end) {
        return None;
    }
    let before = program.before(&program.moves[at]).iter();
    let moves_axes = before
        .filter_map(|before| match before {
            Before::One(from) => ground.ride(Some(*from), end),
            _ => None,
        })
        .any(|ride| ride.moves());
    let goal = ground.goal(end).filter(|goal| !goal.is_near)?;
    Some((ground.meant(&goal.value, end.tool, frame), moves_axes))
}

/// That nobody knows how the tool is rotated where an arc begins.
pub(super) fn begins_unknown(ground: &Ground, motion: &Move) -> Finding {
    let message = "nobody knows where this arc begins, and so not in which rotation of the tool the \
        robot passes its middle: it is corrected in the one that is written";
    let hint = "write where the arc begins with numbers, or the middle in the rotation that the \
        path has there";
    let severity = Severity::Warning;
    ground.at_move("arc-rotation", severity, motion, message.into(), hint)
}

/// That nobody knows on which circle a move is.
fn no_arc(ground: &Ground, motion: &Move) -> Finding {
    let message = "no arc leads from where this one begins through its point to its end: two of the \
        three are one point, or they lie on a line and its point not between the others; \
        controllers stop there, and on corrected points may take any circle";
    let hint = "write the arc with three points apart, or a straight move";
    ground.at_move(
        "arc-undefined",
        Severity::Error,
        motion,
        message.into(),
        hint,
    )
}

/// That an arc ends now here and now there, in other rotations at its middle.
fn ends_otherwise(ground: &Ground, motion: &Move, angle_rad: f64) -> Finding {
    let message = format!(
        "this arc ends at several poses: its middle is corrected for the first, and the tool is \
         rotated there by up to {:.1} deg on the way to the others",
        angle_rad / DEG
    );
    let hint = "write the arc out for each end, with a middle of its own";
    ground.at_move("arc-rotation", Severity::Warning, motion, message, hint)
}

/// That the tool may turn otherwise on an arc than it is taken to.
fn turns_otherwise(ground: &Ground, motion: &Move, angle_rad: f64) -> Finding {
    let message = format!(
        "the tool may turn the other way on this arc: at its middle it would be rotated by {:.0} deg \
         from where the shorter way from beginning to end has it, for which the middle is \
         corrected",
        angle_rad / DEG
    );
    let hint = "divide the arc in two, each of less than half a revolution";
    ground.at_move("arc-rotation", Severity::Warning, motion, message, hint)
}

/// That a controller which takes up the orientation of the point is asked for more than the rotation
/// from the beginning to the end of the arc.
fn rotated(ground: &Ground, motion: &Move, angle_rad: f64) -> Finding {
    let message = format!(
        "the tool at the middle of this arc is rotated by {:.1} deg from where the rotation from \
         its beginning to its end has it there: the point is corrected as it is written, the path \
         is taken with the rotation from beginning to end",
        angle_rad / DEG
    );
    let hint = "write the middle in the orientation that the path has there, or divide the arc in \
        two";
    ground.at_move("arc-rotation", Severity::Warning, motion, message, hint)
}
