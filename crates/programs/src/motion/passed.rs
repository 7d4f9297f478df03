//! Where external axes stand when the robot passes the point of an arc.
//!
//! They go evenly from the beginning of the arc to its end; the values that are written for the
//! point are not looked at. The arc begins where the move before ends, seen with its own tool in its
//! own work frame.
//!
//! # Source
//! ABB, Technical reference manual RAPID Instructions, `MoveC`: the external axes of the circle
//! point are not used. KUKA, `CIRC`: only the position of the auxiliary point counts.

use super::course::{ToolCourse, ToolRotation};
use super::external::carrier;
use super::external_values::Known;
use super::placed::Placed;
use super::setting::Setting;
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector};
use crate::model::Conditions;
use crate::model::external::Listed;
use crate::profile::Profile;
use crate::program::script::short;
use crate::program::{
    Before, Displacement, FrameId, Language, Motion, Program, Settings, Source, Stand, TargetId,
    Value,
};
use std::collections::{BTreeMap, BTreeSet};

/// Values that differ by less are the same: metres, and radians.
const SAME_M: f64 = 1e-3;
const SAME_RAD: f64 = 0.1 * DEG;

/// An arc through a point: the moves where it begins and ends, and the part of it at the point; that
/// of the arc through the fake targets too, where these are known.
struct Arc {
    start: usize,
    end: usize,
    part: f64,
    fake_part: f64,
}

/// The fake targets of arcs on which external axes move, in their work frames: the controller passes
/// the point at another part of the arc through these.
pub(crate) type Fakes = BTreeMap<TargetId, Pose>;

/// The arcs of a program.
pub(super) struct Arcs<'a> {
    pub language: &'a dyn Language,
    pub settings: &'a Settings,
    pub program: &'a Program,
    pub sources: &'a [Source],
    pub profile: &'a Profile,
    pub setting: Setting,
    pub axes: &'a [Listed<'a>],
    pub fakes: &'a Fakes,
}

impl Arcs<'_> {
    /// Puts the values with which arcs pass their points in the place of those that are written, or
    /// kept where nothing is. The targets of the arcs on which an axis moves.
    pub(super) fn pass(
        &self,
        own: &[Option<f64>],
        values: &mut [Known],
        findings: &mut Vec<Finding>,
    ) -> BTreeSet<TargetId> {
        let count = self.axes.len();
        let mut ridden = BTreeSet::new();
        for via in 0..self.program.moves.len() {
            let arcs = self.through(via, values);
            let mut is_reported = false;
            // which beginning goes with which end nobody knows where there are several of both
            let is_one = |of: fn(&Arc) -> usize| arcs.iter().all(|arc| of(arc) == of(&arcs[0]));
            let are_sure = is_one(|arc| arc.start) || is_one(|arc| arc.end);
            let is_error = |k: usize| are_sure && arcs.iter().any(|arc| self.counts(via, arc, k));
            for (k, axis) in self.axes.iter().enumerate() {
                let value = |at: usize| match values[at * count + k] {
                    Known::Is(value) => Some(value),
                    _ => None,
                };
                let ends = arcs.iter().filter_map(|arc| {
                    let (from, to) = (value(arc.start)?, value(arc.end)?);
                    if differ(axis, from, to) {
                        let targets =
                            [arc.start, via, arc.end].map(|at| self.program.moves[at].target);
                        ridden.extend(targets.into_iter().flatten());
                    }
                    Some((arc, from, to))
                });
                let ends: Vec<_> = ends.collect();
                let passed: Vec<f64> = (ends.iter())
                    .map(|(arc, from, to)| from + arc.part * (to - from))
                    .collect();
                let here = via * count + k;
                let written = own[here].and(value(via));
                // of several the one that it is written for
                let off = |passed: &f64| written.map_or(0.0, |written| (passed - written).abs());
                let nearest =
                    (0..passed.len()).min_by(|a, b| off(&passed[*a]).total_cmp(&off(&passed[*b])));
                let Some(nearest) = nearest else {
                    if let (Some(kept), false) = (value(via), is_reported)
                        && self
                            .may_move(via, |at| value(at).is_none_or(|at| differ(axis, at, kept)))
                    {
                        is_reported = true;
                        findings.push(self.begins_unknown(via, axis, kept));
                    }
                    continue;
                };
                let first = passed[nearest];
                let (arc, from, to) = ends[nearest];
                values[here] = Known::Is(from + arc.fake_part * (to - from));
                let differs = |other: &f64| differ(axis, *other, first);
                let several = passed.iter().copied().find(differs);
                if let Some(other) = several.filter(|_| is_error(k)) {
                    is_reported = true;
                    findings.push(Finding {
                        severity: Severity::Error,
                        ..self.several(via, axis, [first, other])
                    });
                    continue;
                }
                let finding = match (written.filter(differs), several) {
                    (Some(written), _) => Some(self.elsewhere(via, axis, [written, first])),
                    (None, several) => several.map(|other| self.several(via, axis, [first, other])),
                };
                if let Some(finding) = finding.filter(|_| !is_reported) {
                    is_reported = true;
                    findings.push(finding);
                }
            }
        }
        ridden
    }

    /// Whether it matters to an arc where an axis stands: it carries the base, or what the arc is on.
    fn counts(&self, via: usize, arc: &Arc, axis: usize) -> bool {
        let external = &self.profile.external;
        let carries = |at: usize| {
            let frame = &self.program.frames[self.program.moves[at].frame];
            carrier(frame, external).ok().flatten().is_some_and(|at| {
                let first = external.first_of(at);
                (first..first + external.positioners[at].axes.len()).contains(&axis)
            })
        };
        axis < external.track.len() || [via, arc.start, arc.end].into_iter().any(carries)
    }

    /// Whether an axis may move on an arc through the point of a move: it stands elsewhere at one of
    /// the moves where that begins or ends.
    fn may_move(&self, via: usize, is_elsewhere: impl Fn(usize) -> bool) -> bool {
        let motion = &self.program.moves[via];
        if motion.motion != Motion::ArcVia || motion.target.is_none() {
            return false;
        }
        let mut starts = self.program.before(motion).iter();
        starts.any(|before| match before {
            Before::One(start) => is_elsewhere(*start as usize),
            _ => true,
        }) || ends_of(self.program, via).any(is_elsewhere)
    }

    /// The arcs through the point of a move, as far as they are known: several where a routine is
    /// called several times.
    fn through(&self, via: usize, values: &[Known]) -> Vec<Arc> {
        let motion = &self.program.moves[via];
        if motion.motion != Motion::ArcVia {
            return Vec::new();
        }
        let starts = self.program.before(motion).iter();
        let starts = starts.filter_map(|before| match before {
            Before::One(start) => Some(*start as usize),
            _ => None,
        });
        let ends = || ends_of(self.program, via);
        let arcs = starts.flat_map(|start| ends().map(move |end| (start, end)));
        arcs.filter_map(|(start, end)| {
            let part = self.part_at([start, via, end], values, None)?;
            let fake = (!self.fakes.is_empty())
                .then(|| self.part_at([start, via, end], values, Some(self.fakes)))
                .flatten();
            Some(Arc {
                start,
                end,
                part,
                fake_part: fake.unwrap_or(part),
            })
        })
        .collect()
    }

    /// The part of an arc at the point on its way; `None` where one of its three points is not known.
    fn part_at(
        &self,
        [start, via, end]: [usize; 3],
        values: &[Known],
        fakes: Option<&Fakes>,
    ) -> Option<f64> {
        let [point, last] = [via, end].map(|at| &self.program.moves[at]);
        if (point.frame, point.tool) != (last.frame, last.tool) {
            return None;
        }
        let stands_as = self.program.stands_as(short(start)) as usize;
        let from = self.start_of(stands_as, via, values, fakes)?;
        let [via, end] = [via, end].map(|at| match self.value(at, fakes) {
            Some(Value::Pose(pose)) => Some(pose.translation),
            _ => None,
        });
        let at = |translation: Vector| Pose {
            translation,
            ..Pose::identity()
        };
        let course = ToolCourse::arc(&at(from), via?, &at(end?), ToolRotation::Slerp);
        Some(course.part_at(via?)).filter(|part| part.is_finite())
    }

    /// Where an arc begins in its own work frame: its own tool where the move before ends.
    fn start_of(
        &self,
        start: usize,
        via: usize,
        values: &[Known],
        fakes: Option<&Fakes>,
    ) -> Option<Vector> {
        let value = self.value(start, fakes)?;
        let [start_move, arc] = [start, via].map(|at| &self.program.moves[at]);
        if let Value::Pose(pose) = &value
            && (start_move.frame, start_move.tool) == (arc.frame, arc.tool)
        {
            return Some(pose.translation);
        }
        let count = self.axes.len();
        let values = &values[start * count..(start + 1) * count];
        let tool = self.setting.tools[arc.tool].as_ref()?;
        let home_from_tool = match value {
            Value::Joints(q) => {
                let controller = self.profile.controller_model(tool);
                controller.forward(&q, &Conditions::default())
            }
            Value::Pose(pose) => {
                let before = self.setting.tools[start_move.tool].as_ref()?;
                let home_from_flange = self.home_from_frame(start_move.frame, values)?
                    * pose
                    * before.flange_from_tool.inverse();
                home_from_flange * tool.flange_from_tool
            }
        };
        let from = self.home_from_frame(arc.frame, values)?.inverse() * home_from_tool;
        Some(from.translation)
    }

    /// What the target of a move means, or its fake target, displaced as the text says; `None` where
    /// only the running program knows.
    fn value(&self, at: usize, fakes: Option<&Fakes>) -> Option<Value> {
        let motion = &self.program.moves[at];
        let target = motion.target?;
        let fake = fakes.and_then(|fakes| fakes.get(&target));
        let value = match fake {
            Some(fake) => Value::Pose(*fake),
            None => crate::program::value(self.language, self.program, self.settings, target)?,
        };
        match (value, &motion.displacement) {
            (value, Displacement::None) => Some(value),
            (Value::Pose(pose), Displacement::By(shift)) => Some(Value::Pose(shift.apply(&pose))),
            _ => None,
        }
    }

    /// A work frame as the controller's arm at home sees it, with external axes at these values.
    fn home_from_frame(&self, of: FrameId, values: &[Known]) -> Option<Pose> {
        let frame = &self.program.frames[of];
        let world_from_frame = self.setting.frames[of].as_ref()?.nominal;
        let value = |known: &Known| match known {
            Known::Is(value) => *value,
            _ => f64::NAN,
        };
        let stand = Stand {
            values: values.iter().map(value).collect(),
            directions: values.iter().map(|_| 0.0).collect(),
            positioner: carrier(frame, &self.profile.external).ok()?,
            on_base: frame.rides_on_base(),
            of_joints: false,
            from_other_side: None,
        };
        Some(Placed::at(self.profile, &stand, world_from_frame).nominal)
    }

    /// That the point of an arc is written for other values than those with which the robot passes
    /// it.
    fn elsewhere(&self, via: usize, axis: &Listed, values: [f64; 2]) -> Finding {
        let [written, passed] = values.map(|value| shown(axis, value));
        let message = format!(
            "the point of this arc is written for external axis {} at {written}, and the robot \
             passes it at {passed} if the axis goes evenly from the beginning of the arc to its \
             end: it is taken to be there",
            axis.name()
        );
        self.finding(
            via,
            message,
            "write the value with which the robot passes the point",
        )
    }

    /// That nobody knows with which value the robot passes the point of an arc.
    fn begins_unknown(&self, via: usize, axis: &Listed, kept: f64) -> Finding {
        let message = format!(
            "nobody knows where this arc begins, and so not at which value of external axis {} the \
             robot passes its point: it is corrected for {}",
            axis.name(),
            shown(axis, kept)
        );
        let hint = "write where the arc begins with numbers, or move the axis before or after it";
        self.finding(via, message, hint)
    }

    /// That the robot passes the point of an arc with several values.
    fn several(&self, via: usize, axis: &Listed, values: [f64; 2]) -> Finding {
        let [first, other] = values.map(|value| shown(axis, value));
        let message = format!(
            "this arc begins or ends at several places: the robot passes its point with external \
             axis {} at {first} or at {other}: the point can be corrected for one of them",
            axis.name()
        );
        let hint = "write the arc out for each place, with a point of its own";
        self.finding(via, message, hint)
    }

    fn finding(&self, via: usize, message: String, hint: &str) -> Finding {
        let motion = &self.program.moves[via];
        let source = &self.sources[motion.file as usize];
        let (id, severity) = ("arc-external", Severity::Warning);
        source.finding(motion.offset as usize, id, severity, message, hint)
    }
}

/// Whether two values of an axis are not the same.
fn differ(axis: &Listed, a: f64, b: f64) -> bool {
    let same = if axis.is_linear() { SAME_M } else { SAME_RAD };
    (a - b).abs() > same
}

/// The moves that end the arc through the point of a move.
pub(crate) fn ends_of(program: &Program, via: usize) -> impl Iterator<Item = usize> {
    let moves = &program.moves;
    let is_via = moves[via].motion == Motion::ArcVia;
    let end = if is_via { moves.len() } else { 0 };
    // moves of one statement follow each other, once for each state in which the robot comes there
    let mut behind = (via + 1..end)
        .skip_while(move |at| moves[*at].instruction == moves[via].instruction)
        .peekable();
    let last = behind.peek().map(|at| moves[*at].instruction);
    let ends = behind.take_while(move |at| Some(moves[*at].instruction) == last);
    let this = short(via);
    ends.filter(move |at| {
        let end = &moves[*at];
        end.motion == Motion::ArcEnd && program.before(end).contains(&Before::One(this))
    })
}

/// A value as programs write it.
fn shown(axis: &Listed, value: f64) -> String {
    let (value, unit) = if axis.is_linear() {
        (mm_from_m(value), "mm")
    } else {
        (value / DEG, "deg")
    };
    format!("{} {unit}", (value * 1e3).round() / 1e3)
}
