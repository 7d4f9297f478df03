//! Targets between those of a program, where the real path would otherwise leave the wanted one.
//!
//! A compensated program meets its targets; between them the controller still interpolates in its
//! own model. A move whose path error is above the limit is halved, each half again, until every
//! part is within it: the new targets are poses of the wanted path, brought through the real
//! inverse like all others. An arc stays an arc, through a new point for each part.

mod said;
mod several;

use super::deviation::{self, Models, Wanted};
use super::walk::Walk;
use super::{CheckError, Options, Subject};
use crate::compensate::Compensation;
use crate::finding::Finding;
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Jet, Pose};
use crate::inverse::{Inverse, Status};
use crate::model::Conditions;
use crate::motion::course::{Course, ToolCourse};
use crate::motion::external;
use crate::motion::leg::Leg;
use crate::program::number::{Fraction, Style};
use crate::program::{
    Between, Displacement, FrameId, Insertion, Motion, Posture, Role, Settings, Value,
};
use rayon::prelude::*;

/// A move is cut into at most so many parts.
const MOST_HALVINGS: u32 = 7;
/// The bound is asked to be below this part of the limit: written numbers are rounded.
const ROOM: f64 = 0.96;
/// Where joints reverse at the start of a move, a target so far along it takes the backlash up.
const TAKEN_UP: f64 = 1.0 / 64.0;
/// Decimals of a millimetre that new targets have at least.
const DECIMALS: usize = 3;

/// A pose on the path, as commanded.
#[derive(Clone, Copy)]
struct Point {
    s: f64,
    /// The controller's joints at which the real tool is there.
    q: [f64; 6],
    /// Where the controller believes to be then.
    fake: Pose,
}

/// Adds moves to a compensated program so that no path is farther from the wanted one than
/// `limit_m`.
///
/// # Errors
/// As [`super::check`] for the original program.
pub fn refine(
    subject: &Subject,
    options: &Options,
    limit_m: f64,
    decimals: Option<usize>,
    compensation: &mut Compensation,
) -> Result<(), CheckError> {
    let walk = Walk::of(subject, subject.sources, options)?;
    let job = Job {
        subject,
        options,
        walk: &walk,
        compensation,
        limit_m,
        decimals: decimals.unwrap_or(0).max(DECIMALS),
        settings: external::settings_of(subject.profile, false),
    };
    let changes: Vec<Option<Change>> = (0..walk.stops.all.len())
        .into_par_iter()
        .map(|index| job.refine_move(index))
        .collect();
    let at_unknown_points = job.off_at_unknown_points(&changes);
    let changes = job.one_each(changes);
    let refusals: Vec<Option<Finding>> = changes
        .iter()
        .map(|change| {
            let insertion = change.insertion.as_ref()?;
            let mut why = "the text of this move cannot be repeated".to_owned();
            let motion = &walk.program.moves[insertion.motion];
            if let Some(because) = job.forbidden(motion) {
                why = format!("{why}: {because}");
            }
            Some(job.failed(motion, change.whole_m, &why))
        })
        .collect();
    compensation.findings.extend(at_unknown_points);
    for file in 0..subject.sources.len() {
        let (mut insertions, mut refused) = (Vec::new(), Vec::new());
        let of_file = changes.iter().zip(&refusals);
        for (change, refusal) in of_file.filter(|(change, _)| change.file == file) {
            compensation.findings.extend(change.finding.clone());
            insertions.extend(change.insertion.clone());
            refused.extend(refusal.clone());
        }
        if insertions.is_empty() {
            continue;
        }
        let (language, sources) = (subject.language, subject.sources);
        let done = compensation.insert(language, sources, &walk.program, file, &insertions);
        let inserted = insertions.iter().zip(&done).filter(|(_, done)| **done);
        let stops = said::stops(subject, &walk, inserted.map(|(insertion, _)| insertion));
        compensation.findings.extend(stops);
        let failed = done.iter().zip(refused).filter(|(done, _)| !**done);
        compensation
            .findings
            .extend(failed.map(|(_, refusal)| refusal));
    }
    Ok(())
}

/// What a move needs.
struct Change {
    file: usize,
    /// How far its path is from the wanted one, metres.
    whole_m: f64,
    /// Moves before it; none where nothing can be done.
    insertion: Option<Insertion>,
    /// What stays off the path.
    finding: Option<Finding>,
}

struct Job<'a> {
    subject: &'a Subject<'a>,
    options: &'a Options,
    walk: &'a Walk,
    compensation: &'a Compensation,
    limit_m: f64,
    decimals: usize,
    settings: Settings,
}

impl Job<'_> {
    /// The joints at a stop when the compensated program runs.
    fn joints_at(&self, index: usize) -> Option<[f64; 6]> {
        let stop = self.walk.stops.all[index]?;
        if let Some(q) = self.compensation.own_joints.get(&self.walk.index(index)) {
            return Some(*q);
        }
        let motion = self.walk.motion(index);
        let report = &self.compensation.targets[motion.target?];
        let Some(q) = report.q.filter(|_| report.changed) else {
            return Some(stop.q);
        };
        let (Displacement::By(shift), Some(fake)) = (&motion.displacement, &report.fake) else {
            return Some(q);
        };
        // a derived point takes the correction of its target along
        let given = self.nominal_frame(motion.frame) * shift.apply(fake);
        let equipped = self.walk.equipped(&stop);
        let (q, reached) = equipped.controller_joints(&given, stop.branch, &stop.q);
        reached.then_some(q)
    }

    /// Where the controller has a work frame.
    fn nominal_frame(&self, frame: FrameId) -> Pose {
        self.walk.frames[frame].map_or_else(Pose::identity, |placed| placed.nominal)
    }

    fn refine_move(&self, index: usize) -> Option<Change> {
        let program = &self.walk.program;
        let motion = self.walk.motion(index);
        let Some(leg) = self.walk.leg(index, self.options.turning) else {
            return self.end_alone(index);
        };
        let stop = self.walk.stops.all[index]?;
        let begin = self.walk.start(index)?;
        let is_pose = program.goes_to_pose(motion);
        let via = self.walk.via(index);
        let start = self.joints_at(begin)?;
        let end = self.joints_at(index)?;
        let arms = self.walk.arms(&stop);
        let controller = |q: &[f64; 6]| arms.plain.controller.forward(q, &Conditions::default());
        let [first, last] = [(0.0, start), (1.0, end)].map(|(s, q)| Point {
            s,
            q,
            fake: controller(&q),
        });
        // the point of the arc as the program has it
        let through = match via {
            Some(via) => Some(controller(&self.joints_at(via)?)),
            None => None,
        };
        let whole = self.error(&leg, index, &first, &last, through.as_ref());
        if whole <= self.limit_m {
            return None;
        }
        let change = |insertion, finding| {
            Some(Change {
                file: motion.file as usize,
                whole_m: whole,
                insertion,
                finding,
            })
        };
        let failed = |why: &str| change(None, Some(self.failed(motion, whole, why)));
        let gap = |point: &Point, conditions: &Conditions| {
            let nominal = leg.joints(point.s, &leg.start);
            let wanted = leg.controller_pose(point.s, &nominal, &arms.plain.controller);
            let wanted = leg.real_from_nominal(point.s, wanted);
            let landed = arms.plain.real.forward(&point.q, conditions);
            landed.separation(&wanted).distance_m
        };
        // a target that is off as the robot comes to it: no target between helps there
        let arrived = self.walk.conditions(&self.walk.stops.all[begin]?);
        let ends = gap(&first, &arrived).max(gap(&last, &leg.conditions));
        if ends > self.limit_m {
            return change(None, Some(self.off_at_an_end(motion, ends, whole)));
        }
        if !is_pose {
            return failed("its target is given in joints");
        }
        if let Some(call) = program.call_before(self.walk.index(index)) {
            return failed(&format!(
                "`{call}` before it may leave the robot elsewhere than the text says, and new targets \
                 would lead it back (--with gives files of routines)"
            ));
        }
        if motion.free_orientation {
            return failed(
                "the tool rotates on it as the joints of the wrist do, which targets between would \
                 change",
            );
        }
        if motion.displacement != Displacement::None {
            return failed("its target is displaced at run time");
        }
        if leg.ride.as_ref().is_some_and(|ride| ride.moves()) {
            return failed("external axes move on it");
        }
        // as the robot leaves: joints with backlash that reverse are off until it is taken up
        let pieces = self.part(&leg, &first, &last, through.as_ref()).pieces();
        let leaving = pieces.iter().take_while(|piece| piece.from <= 0.0);
        let reversed = leaving
            .map(|piece| gap(&first, &piece.conditions))
            .fold(0.0, f64::max);
        let mut points = vec![first];
        let mut finding = None;
        let is_split = if reversed > ROOM * self.limit_m {
            let most = self.take_up(&leg, index, &first, &last, &mut points);
            let over = most.filter(|most| *most > self.limit_m);
            finding = over.map(|most| self.off_until_taken_up(motion, most));
            most.is_some()
        } else {
            self.split(&leg, index, &first, &last, 0, &mut points)
        };
        if !is_split {
            return failed(
                "the path passes a singularity or leaves the reach, or a joint with backlash \
                 reverses on it",
            );
        }
        points.remove(0);
        points.pop();
        if let Some(why) = self.too_far(&leg, index, &points) {
            return failed(&why);
        }
        let between = self.between(&leg, index, &first, &points, &last, via.is_some());
        let Some(between) = between else {
            return failed("an arc's part cannot be reached");
        };
        let insertion = Insertion {
            motion: self.walk.index(index),
            between,
            own: None,
        };
        change(Some(insertion), finding)
    }

    /// Of a move that begins nobody knows where the end alone is judged.
    fn end_alone(&self, index: usize) -> Option<Change> {
        let stop = self.walk.stops.all[index]?;
        let motion = self.walk.motion(index);
        if motion.motion == Motion::ArcVia {
            return None;
        }
        let (real, conditions) = (
            &self.walk.arms(&stop).plain.real,
            self.walk.conditions(&stop),
        );
        let landed = real.forward(&self.joints_at(index)?, &conditions);
        let off_m = landed.separation(self.walk.stops.wanted(&stop)).distance_m;
        (off_m > self.limit_m).then(|| Change {
            file: motion.file as usize,
            whole_m: off_m,
            insertion: None,
            finding: Some(self.off_at_an_end(motion, off_m, off_m)),
        })
    }

    /// Appends the points behind the first where joints reverse there, the next one near it: how
    /// far the path before that is off at most, metres. `None` as [`Job::split`] is false.
    fn take_up(
        &self,
        leg: &Leg,
        index: usize,
        first: &Point,
        last: &Point,
        out: &mut Vec<Point>,
    ) -> Option<f64> {
        let near = self.point(leg, index, TAKEN_UP, &first.q)?;
        let through = self.via(leg, index, first, &near).ok()?;
        let most = self.error(leg, index, first, &near, through.as_ref());
        out.push(near);
        self.split(leg, index, &near, last, 1, out).then_some(most)
    }

    /// That a target between would be shifted farther than targets with its tool may be.
    fn too_far(&self, leg: &Leg, index: usize, points: &[Point]) -> Option<String> {
        let limit = (*self
            .compensation
            .shift_limits
            .get(self.walk.motion(index).tool)?)?;
        let arms = self.walk.arms(&self.walk.stops.all[index]?);
        points.iter().find_map(|point| {
            let nominal = leg.joints(point.s, &leg.start);
            let wanted = leg.controller_pose(point.s, &nominal, &arms.plain.controller);
            let shift = wanted.separation(&point.fake);
            let is_within =
                shift.distance_m <= limit.distance_m && shift.angle_rad <= limit.angle_rad;
            (!is_within).then(|| {
                format!(
                    "a target between would be shifted by {:.3} mm and {:.3} deg, the limit of \
                     shifts is {:.3} mm and {:.3} deg \
                     (--max-shift)",
                    mm_from_m(shift.distance_m),
                    shift.angle_rad / DEG,
                    mm_from_m(limit.distance_m),
                    limit.angle_rad / DEG
                )
            })
        })
    }

    /// The real inverse of the wanted pose at `s`.
    fn point(&self, leg: &Leg, index: usize, s: f64, near: &[f64; 6]) -> Option<Point> {
        let stop = self.walk.stops.all[index]?;
        let arms = self.walk.arms(&stop);
        let nominal = leg.joints(s, near);
        let wanted = leg.controller_pose(s, &nominal, &arms.plain.controller);
        let wanted = leg.real_from_nominal(s, wanted);
        let inverse = Inverse {
            conditions: leg.conditions,
            ..leg.equipped.inverse.clone()
        };
        let branch = leg.equipped.arm.posture(&nominal).0;
        let found = inverse.solve(&wanted, branch, &nominal);
        (found.status == Status::Converged).then(|| Point {
            s,
            q: found.q,
            fake: arms
                .plain
                .controller
                .forward(&found.q, &Conditions::default()),
        })
    }

    /// The path from one point to another as the controller goes.
    fn part<'a>(&self, leg: &Leg<'a>, a: &Point, b: &Point, through: Option<&Pose>) -> Leg<'a> {
        let turning = self.options.turning;
        let course = match (&leg.course, through) {
            (Course::Joint { .. }, _) => Course::Joint { from: a.q, to: b.q },
            (Course::Tool(_), Some(via)) => {
                Course::Tool(ToolCourse::arc(&a.fake, via.translation, &b.fake, turning))
            }
            (Course::Tool(_), None) => {
                Course::Tool(ToolCourse::straight(&a.fake, &b.fake, turning))
            }
        };
        Leg {
            equipped: leg.equipped,
            course,
            start: a.q,
            // at its beginning it may be open
            branch: leg.equipped.arm.posture(&b.q).0,
            conditions: leg.conditions,
            // moves on which something rides along are not divided
            ride: leg.ride.clone(),
            crossing: None,
        }
        .with_crossing()
    }

    /// The bound of the error of a part, metres.
    fn error(&self, leg: &Leg, index: usize, a: &Point, b: &Point, through: Option<&Pose>) -> f64 {
        let stop = self.walk.stops.all[index].expect("a leg ends at a stop");
        let arms = self.walk.arms(&stop);
        let part = self.part(leg, a, b, through);
        let wanted = Wanted {
            leg,
            from: a.s,
            to: b.s,
            controller: &arms.plain.controller,
            controller_jet: &arms.jets.controller,
            own: false,
        };
        let models: (&Models<f64>, &Models<Jet>) = (&arms.plain, &arms.jets);
        let found = deviation::path_error(&part, &part.pieces(), &wanted, models.0, models.1);
        found.bound.distance_m
    }

    /// The point through which a part of an arc goes; none on other courses, an error where it
    /// cannot be reached.
    fn via(&self, leg: &Leg, index: usize, a: &Point, b: &Point) -> Result<Option<Pose>, ()> {
        let is_arc = matches!(&leg.course, Course::Tool(course) if course.is_arc());
        if !is_arc {
            return Ok(None);
        }
        let middle = self.point(leg, index, 0.5 * (a.s + b.s), &a.q);
        middle.map(|point| Some(point.fake)).ok_or(())
    }

    /// Appends the points behind `a` up to `b`; false where one cannot be reached or too many would
    /// be needed.
    fn split(
        &self,
        leg: &Leg,
        index: usize,
        a: &Point,
        b: &Point,
        depth: u32,
        out: &mut Vec<Point>,
    ) -> bool {
        let Ok(through) = self.via(leg, index, a, b) else {
            return false;
        };
        // the whole move is known to be too far off
        if depth > 0 && self.error(leg, index, a, b, through.as_ref()) <= ROOM * self.limit_m {
            out.push(*b);
            return true;
        }
        if depth == MOST_HALVINGS {
            return false;
        }
        let Some(middle) = self.point(leg, index, 0.5 * (a.s + b.s), &a.q) else {
            return false;
        };
        self.split(leg, index, a, &middle, depth + 1, out)
            && self.split(leg, index, &middle, b, depth + 1, out)
    }

    /// The numbers of the new targets as text: each new move's, and where the move is an arc, the
    /// points of all parts.
    fn between(
        &self,
        leg: &Leg,
        index: usize,
        first: &Point,
        points: &[Point],
        last: &Point,
        is_arc: bool,
    ) -> Option<Vec<Between>> {
        let mut before = *first;
        let mut between = Vec::new();
        for point in points.iter().chain(is_arc.then_some(last)) {
            let via = if is_arc {
                let s = 0.5 * (before.s + point.s);
                Some(self.numbers(leg, index, &self.point(leg, index, s, &before.q)?))
            } else {
                None
            };
            between.push(Between {
                via,
                end: self.numbers(leg, index, point),
            });
            before = *point;
        }
        Some(between)
    }

    /// The text of each number of a target at a point, in the manner of the move's own target.
    fn numbers(&self, leg: &Leg, index: usize, point: &Point) -> Vec<Vec<u8>> {
        let (program, language) = (&self.walk.program, self.subject.language);
        let motion = self.walk.motion(index);
        let target = program
            .target_of(motion)
            .expect("moves that are refined have a target");
        let source = &self.subject.sources[target.file as usize];
        let numbers = program.numbers_of(target);
        let text = |i: usize| numbers[i].text(&source.bytes);
        let roles = language.roles(target.layout);
        let mut values: Vec<f64> = numbers.iter().map(|n| n.value).collect();
        let value = Value::Pose(self.nominal_frame(motion.frame).inverse() * point.fake);
        let posture = |q: &[f64; 6]| {
            let (branch, _) = leg.equipped.arm.posture(q);
            Posture {
                joints_rad: *q,
                behind_axis_1: branch.behind_axis_1,
                behind_lower_arm: branch.behind_lower_arm,
            }
        };
        let stop = self.walk.stops.all[index].expect("a leg ends at a stop");
        let (before, after) = (posture(&stop.q), posture(&point.q));
        language.encode(
            target.layout,
            &value,
            &before,
            &after,
            &self.settings,
            &mut values,
        );
        let fraction = (0..numbers.len())
            .find_map(|i| Fraction::shown_by(text(i)))
            .unwrap_or(Fraction::Zero);
        (0..numbers.len())
            .map(|i| {
                let mut out = Vec::new();
                if values[i] == numbers[i].value {
                    out.extend_from_slice(text(i));
                } else if roles[i] == Role::Configuration {
                    language.write_configuration(target.layout, i, values[i], text(i), &mut out);
                } else {
                    let alike = (0..numbers.len())
                        .filter(|j| roles[*j] == roles[i])
                        .map(text);
                    let at_least = language.decimals(roles[i], self.decimals);
                    Style::of_group(alike, at_least, fraction).write(text(i), values[i], &mut out);
                }
                out
            })
            .collect()
    }
}
