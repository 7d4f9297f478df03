//! Where external axes stand when the robot passes the point of an arc.
//!
//! They go evenly from the beginning of the arc to its end; the values that are written for the
//! point are not looked at.
//!
//! # Source
//! ABB, Technical reference manual RAPID Instructions, `MoveC`: the external axes of the circle
//! point are not used. KUKA, `CIRC`: only the position of the auxiliary point counts.

use super::course::{ToolCourse, ToolRotation};
use super::external_values::Known;
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector};
use crate::model::external::Listed;
use crate::program::{Before, Displacement, Language, Motion, Move, Program, Role, Shape, Source};

/// Values that differ by less are the same: metres, and radians.
const SAME_M: f64 = 1e-3;
const SAME_RAD: f64 = 0.1 * DEG;

/// Puts the values with which arcs pass their points in the place of those that are written, or kept
/// where nothing is.
pub(super) fn pass_arcs(
    language: &dyn Language,
    program: &Program,
    sources: &[Source],
    axes: &[Listed],
    (own, values): (&[Option<f64>], &mut [Known]),
    findings: &mut Vec<Finding>,
) {
    let only_before = |motion: &Move| match program.before(motion) {
        [Before::One(before)] => Some(*before as usize),
        _ => None,
    };
    for (end, motion) in program.moves.iter().enumerate() {
        let via = only_before(motion).filter(|_| motion.motion == Motion::ArcEnd);
        let via = via.filter(|via| program.moves[*via].motion == Motion::ArcVia);
        let arc = via.and_then(|via| Some([only_before(&program.moves[via])?, via, end]));
        let Some(part) = arc.and_then(|arc| part_at(language, program, arc)) else {
            continue;
        };
        let [start, via, end] = arc.expect("an arc has a part");
        let mut is_reported = false;
        for (k, axis) in axes.iter().enumerate() {
            let at = |motion: usize| motion * axes.len() + k;
            let (Known::Is(from), Known::Is(to)) = (values[at(start)], values[at(end)]) else {
                continue;
            };
            let passed = from + part * (to - from);
            let written = std::mem::replace(&mut values[at(via)], Known::Is(passed));
            let same = if axis.is_linear() { SAME_M } else { SAME_RAD };
            match written {
                Known::Is(written)
                    if own[at(via)].is_some()
                        && (written - passed).abs() > same
                        && !is_reported =>
                {
                    is_reported = true;
                    let motion = &program.moves[via];
                    findings.push(elsewhere(motion, sources, axis, [written, passed]));
                }
                _ => {}
            }
        }
    }
}

/// The part of an arc at the point on its way; `None` where its three points are not written in one
/// frame for one tool.
fn part_at(language: &dyn Language, program: &Program, arc: [usize; 3]) -> Option<f64> {
    let position = |at: usize| -> Option<Vector> {
        let motion = &program.moves[at];
        let target = program.target_of(motion)?;
        let is_plain =
            target.layout.shape == Shape::Pose && motion.displacement == Displacement::None;
        let roles = language.roles(target.layout).iter();
        let numbers = program.numbers_of(target).iter().zip(roles);
        let mut of = numbers.filter(|(_, role)| **role == Role::Position);
        let mut next = || of.next().map(|(number, _)| number.value);
        is_plain.then_some([next()?, next()?, next()?])
    };
    let [start, via, end] = arc.map(|at| &program.moves[at]);
    let is_alike = |other: &Move| (other.frame, other.tool) == (via.frame, via.tool);
    if !is_alike(start) || !is_alike(end) {
        return None;
    }
    let [start, via, end] = arc.map(position);
    let at = |translation: Vector| Pose {
        translation,
        ..Pose::identity()
    };
    let course = ToolCourse::arc(&at(start?), via?, &at(end?), ToolRotation::Slerp);
    Some(course.part_at(via?))
}

/// That the point of an arc is written for other values than those with which the robot passes it.
fn elsewhere(motion: &Move, sources: &[Source], axis: &Listed, values: [f64; 2]) -> Finding {
    let unit = if axis.is_linear() { "mm" } else { "deg" };
    let [written, passed] = values.map(|value| {
        let value = if axis.is_linear() {
            mm_from_m(value)
        } else {
            value / DEG
        };
        (value * 1e3).round() / 1e3
    });
    let message = format!(
        "the point of this arc is written for external axis {} at {written} {unit}, and the robot \
         passes it at {passed} {unit} if the axis goes evenly from the beginning of the arc to its \
         end: it is taken to be there",
        axis.name()
    );
    let hint = "write the value with which the robot passes the point";
    let source = &sources[motion.file as usize];
    let (id, severity) = ("arc-external", Severity::Warning);
    source.finding(motion.offset as usize, id, severity, message, hint)
}
