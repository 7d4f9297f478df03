//! Points that the running program derives from a target (`Offs`, `RelTool`) take its correction
//! along; here is found how far from their own wanted poses they land: with the tool, in the work
//! frame and where external axes stand at the move to them.

use super::approach::{Approach, stays};
use super::{Job, LEAST_SIDE_M, LIMIT_DERIVED_M, strides};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, add, norm, sub};
use crate::inverse::Branch;
use crate::model::Conditions;
use crate::motion::walk::{Arrival, Arrivals};
use crate::program::script::short;
use crate::program::{
    Displacement, Move, Readings, SOMEHOW_M, Shape, Shift, Stride, TargetId, Value,
};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::f64::consts::TAU;

/// So far from a target is looked how long its correction is right, metres.
const DISTANCES_M: [f64; 10] = [1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 0.1, 0.2, 0.5, 1.0];

fn is_displaced(motion: &Move) -> bool {
    motion.displacement != Displacement::None
}

/// The targets that points are derived from.
pub(super) fn bases(job: &Job) -> BTreeSet<usize> {
    let displaced = job.ground.program.moves.iter().filter(|m| is_displaced(m));
    let mut bases = BTreeSet::new();
    for motion in displaced {
        bases.extend(motion.target);
        bases.extend(readings(&motion.displacement).flat_map(Readings::targets));
    }
    bases
}

/// Coordinates that a displacement is worked out from.
pub(super) fn readings(displacement: &Displacement) -> impl Iterator<Item = &Readings> {
    let strides: &[Stride] = match displacement {
        Displacement::Within(strides) | Displacement::AtLeast(strides) => strides,
        _ => &[],
    };
    strides.iter().filter_map(|stride| match stride {
        Stride::Read { of, .. } => Some(of),
        _ => None,
    })
}

/// How far what is worked out from coordinates of targets comes to lie elsewhere at most, metres, where
/// these have become those of the fake targets.
fn reread_m(job: &Job, fakes: &BTreeMap<usize, Pose>, displacement: &Displacement) -> f64 {
    let ground = &job.ground;
    let by = |target: TargetId, part: u8| {
        let value = crate::program::value(ground.language, ground.program, ground.settings, target);
        let (Some(fake), Some(Value::Pose(pose))) = (fakes.get(&target), value) else {
            return 0.0;
        };
        match pose.translation.get(usize::from(part)) {
            Some(from) => mm_from_m(fake.translation[usize::from(part)] - from),
            None => pose.separation(fake).angle_rad / DEG,
        }
    };
    readings(displacement).map(|of| of.most(&by)).sum()
}

/// The known arrivals at moves to points that are derived from a target, by move; `sides` says from
/// which side joints come to one on the path between fake targets, 0 where that is not certain.
pub(super) fn arrivals(
    job: &Job,
    arrivals: &Arrivals,
    sides: &dyn Fn(usize) -> [i8; 6],
) -> BTreeMap<usize, Vec<Arrival>> {
    let moves = job.ground.program.moves.iter().enumerate();
    let displaced = moves.filter(|(_, motion)| is_displaced(motion));
    let known = |at: usize| {
        let here = arrivals.at(at).map(|index| Arrival {
            direction: sides(index),
            ..arrivals.all[index].clone()
        });
        here.filter(|arrival| arrival.known).collect()
    };
    displaced.map(|(at, _)| (at, known(at))).collect()
}

/// How far off its own wanted pose may land what takes the numbers of another.
pub(super) fn limit_m(job: &Job) -> f64 {
    job.options.max_derived_error_m.unwrap_or(LIMIT_DERIVED_M)
}

/// Adds a finding for each move to a displaced target; `fakes` has the fake targets of those that
/// points are derived from. Of the displacements with which one statement is come to the worst is
/// reported. Gives how far off the points may land that only the running program knows, by move.
pub(super) fn check(
    job: &Job,
    arrivals: &BTreeMap<usize, Vec<Arrival>>,
    approaches: &[Approach],
    fakes: &BTreeMap<usize, Pose>,
    findings: &mut Vec<Finding>,
) -> BTreeMap<usize, f64> {
    let ground = &job.ground;
    let mut judged = Judged::default();
    let mut unknown = BTreeMap::new();
    let mut of_statements: BTreeMap<_, (&Move, Vec<Verdict>)> = BTreeMap::new();
    let mut staying = BTreeSet::new();
    for (&at, arrivals) in arrivals {
        let motion = &ground.program.moves[at];
        let Some(target) = motion.target else {
            continue;
        };
        if stays(job, target) {
            if staying.insert((motion.file, motion.offset, target)) {
                findings.push(uncorrected(job, motion, target));
            }
            continue;
        }
        let first = approaches.partition_point(|approach| (approach.target as usize) < target);
        let approach = approaches
            .get(first)
            .filter(|approach| approach.target as usize == target);
        let (Some(approach), Some(fake)) = (approach, fakes.get(&target)) else {
            continue;
        };
        let base = Base {
            job,
            reach_m: reach_m(job, approach),
            uses: uses(job, arrivals, at, approach),
            name: ground.name_of(target),
            fake: *fake,
            limit_m: limit_m(job),
            reread_m: reread_m(job, fakes, &motion.displacement),
        };
        let Some(verdict) = base.judge(&motion.displacement, &mut judged) else {
            continue;
        };
        if !matches!(motion.displacement, Displacement::By(_)) {
            unknown.insert(at, verdict.off_m);
        }
        let statement = (motion.file, motion.offset, verdict.id, target);
        let (_, verdicts) = of_statements
            .entry(statement)
            .or_insert((motion, Vec::new()));
        if !verdicts.contains(&verdict) {
            verdicts.push(verdict);
        }
    }
    let hint = "give the point a target of its own if it must be exact; --max-derived-error \
        raises the limit";
    findings.extend(
        of_statements
            .into_values()
            .filter_map(|(motion, verdicts)| {
                let others = match verdicts.len() {
                    0 | 1 => String::new(),
                    2 => "; one other displacement leads here".into(),
                    count => format!("; {} other displacements lead here", count - 1),
                };
                let severity = |a: &Verdict, b: &Verdict| a.severity.cmp(&b.severity);
                let worst =
                    |a: &Verdict, b: &Verdict| severity(a, b).then(a.off_m.total_cmp(&b.off_m));
                let worst = verdicts.into_iter().max_by(worst)?;
                let message = format!("{}{others}", worst.message);
                Some(ground.at_use(worst.id, worst.severity, motion, message, hint))
            }),
    );
    unknown
}

/// Of a point that is derived from a target or from joints which stay as they are: it is a pose all
/// the same, and nothing corrects it.
fn uncorrected(job: &Job, motion: &Move, target: TargetId) -> Finding {
    let message = format!(
        "a point derived from {}, which stays as it is, is not corrected",
        job.ground.name_of(target)
    );
    let ground = &job.ground;
    let hint = match ground.program.targets[target].layout.shape {
        Shape::Joints => {
            "go to a target of its own if it must be exact, or correct joints, too \
             (--joint-targets correct)"
        }
        Shape::Pose => "go to a target of its own if it must be exact",
    };
    ground.at_use("displaced-target", Severity::Warning, motion, message, hint)
}

/// What is found of a displacement.
#[derive(PartialEq)]
struct Verdict {
    id: &'static str,
    severity: Severity,
    /// How far off the point lands at most, metres; infinite where nothing bounds it.
    off_m: f64,
    message: String,
}

/// A target and what takes its correction along.
struct Base<'a> {
    job: &'a Job<'a>,
    /// How the robot comes to what is derived from it; a direction is 0 where nothing says it.
    uses: Vec<Approach>,
    name: String,
    /// Its fake target.
    fake: Pose,
    reach_m: f64,
    limit_m: f64,
    /// What it is displaced by changes by so much where targets are rewritten, metres.
    reread_m: f64,
}

impl Base<'_> {
    /// What is to be said of a displacement; nothing where there is none.
    fn judge(&self, displacement: &Displacement, judged: &mut Judged) -> Option<Verdict> {
        Some(match displacement {
            Displacement::None => return None,
            Displacement::Unknown => self.unknown(),
            Displacement::Within(steps) => {
                let most = judged.most_m(displacement, &self.uses, || {
                    let places = strides::places(steps, self.reach_m, false)?;
                    Some(self.most_m(&mut places.into_iter()))
                });
                self.bounded_by(most, &|name| {
                    format!(
                        "a point derived from {name} takes its correction along, displaced {}: \
                         within reach",
                        strides::in_words(steps)
                    )
                })
            }
            Displacement::AtLeast(steps) => {
                let most = judged.most_m(displacement, &self.uses, || {
                    let known = strides::places(steps, self.reach_m, true)?.into_iter();
                    Some(self.most_m(&mut known.chain(strides::all_around(SOMEHOW_M))))
                });
                self.bounded_by(most, &|name| {
                    format!(
                        "a point derived from {name} at run time takes its correction along: the \
                         numbers of the text alone, with 1 for each factor that only the running \
                         program knows, displace it {}, and from there to the target, within \
                         reach,",
                        strides::in_words(steps)
                    )
                })
            }
            Displacement::Unbounded => self.unbounded(),
            Displacement::Overwritten => self.overwritten(),
            Displacement::By(shift) => self.by(shift),
        })
    }

    /// The verdict of a largest miss, whose message begins so; `None` where nothing bounds it.
    fn bounded_by(&self, most_m: Option<f64>, begin: &dyn Fn(&str) -> String) -> Verdict {
        match most_m {
            Some(most_m) => self.bounded(most_m + self.reread_m, &begin(&self.name)),
            None => self.unbounded(),
        }
    }

    /// A verdict whose message begins so.
    fn bounded(&self, off_m: f64, what: &str) -> Verdict {
        Verdict {
            id: "displacement-unknown",
            severity: self.severity_of(off_m),
            off_m,
            message: format!(
                "{what} that is up to {:.3} mm off{} ({})",
                mm_from_m(off_m),
                self.sides(),
                self.limit()
            ),
        }
    }

    fn unknown(&self) -> Verdict {
        let off_m = self.most_m(&mut strides::all_around(SOMEHOW_M));
        let what = format!(
            "a point derived from {} at run time takes its correction along: up to {:.0} mm from it",
            self.name,
            mm_from_m(SOMEHOW_M),
        );
        let verdict = self.bounded(off_m, &what);
        Verdict {
            message: format!("{}, and {}", verdict.message, self.holds()),
            ..verdict
        }
    }

    fn unbounded(&self) -> Verdict {
        let name = &self.name;
        Verdict {
            id: "displacement-unknown",
            severity: Severity::Error,
            off_m: f64::INFINITY,
            message: format!(
                "a copy of {name} is displaced in a way that the text does not bound, or that is \
                 not followed (again and again, by many steps, by where the robot is, by what is \
                 computed of other numbers): how far from {name} it comes is not known; its \
                 correction is right {} ({})",
                self.holds(),
                self.limit()
            ),
        }
    }

    fn overwritten(&self) -> Verdict {
        // of numbers that are all written over nothing is left, of others some
        let lost = self.uses.iter().flat_map(|of| {
            let numbers = of.numbers_in_frame(self.job);
            [numbers, self.fake].map(|given| {
                let off_m = landing_m(self.job, of, &given, &Shift::none());
                // where the arm cannot be followed there, as on axis 1, by the numbers
                off_m.unwrap_or_else(|| numbers.separation(&self.fake).distance_m)
            })
        });
        let off_m = lost.fold(0.0, f64::max);
        Verdict {
            id: "target-overwritten",
            severity: self.severity_of(off_m),
            off_m,
            message: format!(
                "the running program writes numbers over some of a copy of {}: these lose a \
                 correction of {:.3} mm{} ({})",
                self.name,
                mm_from_m(off_m),
                self.sides(),
                self.limit()
            ),
        }
    }

    fn by(&self, shift: &Shift) -> Verdict {
        let landings = self.uses.iter();
        let landings = landings.map(|of| landing_m(self.job, of, &self.fake, shift));
        let farthest = landings.reduce(|a, b| Some(a?.max(b?))).flatten();
        let name = &self.name;
        Verdict {
            id: "displaced-target",
            severity: if farthest.is_some_and(|off_m| off_m <= self.limit_m) {
                Severity::Note
            } else {
                Severity::Warning
            },
            off_m: farthest.unwrap_or(f64::INFINITY),
            message: match farthest {
                None => format!("a point derived from {name} is out of reach"),
                Some(off_m) => format!(
                    "a point derived from {name} takes its correction along and lands {}{:.3} mm \
                     off its own wanted pose{}",
                    if self.sides().is_empty() {
                        ""
                    } else {
                        "up to "
                    },
                    mm_from_m(off_m),
                    self.sides()
                ),
            },
        }
    }

    /// The largest miss at these places from the target.
    fn most_m(&self, shifts: &mut dyn Iterator<Item = Shift>) -> f64 {
        let of = |shift: &Shift, of: &Approach| landing_m(self.job, of, &self.fake, shift);
        let each = |shift: Shift| self.uses.iter().filter_map(move |at| of(&shift, at));
        shifts.flat_map(each).fold(0.0, f64::max)
    }

    /// The joints of which nothing says from which side they come, in words.
    fn sides(&self) -> String {
        let is_open = |joint: &usize| {
            self.uses
                .iter()
                .any(|of| side_m(self.job, of, *joint) > LEAST_SIDE_M)
        };
        let joints = (0..6).filter(is_open).map(|joint| (joint + 1).to_string());
        let joints: Vec<String> = joints.collect();
        if joints.is_empty() {
            return String::new();
        }
        let joints = joints.join(", ");
        format!(", from whichever side joint {joints} with backlash comes")
    }

    /// How far from the target its correction is worth the limit.
    fn holds(&self) -> String {
        let holds = |by: &f64| self.most_m(&mut strides::all_around(*by)) <= self.limit_m;
        match DISTANCES_M.iter().take_while(|by| holds(by)).last() {
            Some(by) => format!("within the limit up to {:.0} mm from it", mm_from_m(*by)),
            None => "within the limit for less than 1 mm from it".into(),
        }
    }

    fn limit(&self) -> String {
        format!("the limit is {:.3} mm", mm_from_m(self.limit_m))
    }

    fn severity_of(&self, off_m: f64) -> Severity {
        if off_m > self.limit_m {
            Severity::Error
        } else {
            Severity::Warning
        }
    }
}

/// Displacements that were judged last: many moves to the same target are displaced by the same
/// numbers, and each is judged at thousands of places.
#[derive(Default)]
struct Judged {
    last: VecDeque<(Displacement, Vec<Use>, Option<f64>)>,
}

/// Displacements that are remembered.
const MOST_JUDGED: usize = 16;

/// What the error of a use depends on: the target, with what the robot comes there and in which
/// posture, with whole rotations.
#[derive(Clone, PartialEq)]
struct Use {
    target: u32,
    tool: u32,
    frame: u32,
    branch: Branch,
    middle: bool,
    rotations: [f64; 6],
}

impl Use {
    fn of(approach: &Approach) -> Self {
        Self {
            target: approach.target,
            tool: approach.tool,
            frame: approach.frame,
            branch: approach.branch,
            middle: approach.middle.is_some(),
            rotations: approach.nominal_q.map(|q| (q / TAU).round()),
        }
    }
}

impl Judged {
    /// The largest miss of a displacement, worked out where it is none of the last; `None` where
    /// nothing bounds it.
    fn most_m(
        &mut self,
        displacement: &Displacement,
        uses: &[Approach],
        work_out: impl FnOnce() -> Option<f64>,
    ) -> Option<f64> {
        let uses: Vec<Use> = uses.iter().map(Use::of).collect();
        let is_arc = uses.iter().any(|of| of.middle);
        let same = |of: &&(Displacement, Vec<Use>, Option<f64>)| {
            of.0 == *displacement && of.1 == uses && !is_arc
        };
        if let Some((_, _, most)) = self.last.iter().find(same) {
            return *most;
        }
        let most = work_out();
        self.last.truncate(MOST_JUDGED - 1);
        self.last.push_front((displacement.clone(), uses, most));
        most
    }
}

/// Between two points that the tool reaches is no more than this, metres.
fn reach_m(job: &Job, approach: &Approach) -> f64 {
    let tool = approach.tool as usize;
    let equipped = job.ground.arm_with(tool);
    let links: f64 = equipped.inverse.real.reaches().iter().sum();
    let mounted = job.ground.setting.tools[tool].as_ref();
    2.0 * (links + mounted.map_or(0.0, |mounted| norm(mounted.flange_from_tool.translation)))
}

/// How the robot comes to a point that is derived from the target of an approach: with the posture
/// of that where the walk does not know its own, and from any side where it does not know the point.
fn uses(job: &Job, arrivals: &[Arrival], at: usize, approach: &Approach) -> Vec<Approach> {
    let motion = &job.ground.program.moves[at];
    let there = Approach {
        motion: short(at),
        tool: short(motion.tool),
        frame: short(job.ground.frame_of(motion)),
        direction: [0; 6],
        shift: None,
        ..approach.clone()
    };
    if arrivals.is_empty() {
        return vec![there];
    }
    let is_known = matches!(motion.displacement, Displacement::By(_));
    let of = |arrival: &Arrival| Approach {
        nominal_q: arrival.q,
        branch: arrival.branch,
        direction: if is_known { arrival.direction } else { [0; 6] },
        middle: arrival.middle.clone(),
        ..there.clone()
    };
    arrivals.iter().map(of).collect()
}

/// How far from its wanted pose a displaced use of a target lands whose numbers in the work frame
/// are given, from whichever sides joints may come; `None` where the controller does not reach it.
fn landing_m(job: &Job, approach: &Approach, given_in_frame: &Pose, shift: &Shift) -> Option<f64> {
    let ground = &job.ground;
    let placed = ground.placed(approach.frame as usize);
    let at = |numbers: &Pose| approach.taken(shift.apply(numbers));
    let wanted = placed.real * at(&approach.numbers_in_frame(job));
    let given = placed.nominal * at(given_in_frame);
    let equipped = ground.arm_with(approach.tool as usize);
    let (q, reached) = equipped.controller_joints(&given, approach.branch, &approach.nominal_q);
    if !reached {
        return None;
    }
    let conditions = approach.conditions(job);
    let real = |conditions: &Conditions| equipped.inverse.real.forward(&q, conditions).translation;
    let middle = real(&conditions);
    // a backlash is so narrow that those of several joints add up
    let mut gaps = vec![sub(middle, wanted.translation)];
    for joint in (0..6).filter(|joint| is_open(job, approach, *joint)) {
        let to = |side: f64| {
            let mut conditions = conditions;
            conditions.direction[joint] = side;
            sub(real(&conditions), middle)
        };
        let sides = [to(-1.0), to(1.0)];
        gaps = gaps
            .iter()
            .flat_map(|gap| sides.map(|side| add(*gap, side)))
            .collect();
    }
    Some(gaps.into_iter().map(norm).fold(0.0, f64::max))
}

/// Whether nothing says from which side a joint with backlash comes.
fn is_open(job: &Job, approach: &Approach, joint: usize) -> bool {
    let equipped = job.ground.arm_with(approach.tool as usize);
    equipped.has_backlash[joint] && approach.direction[joint] == 0
}

/// How far apart the tool is where a joint comes from one side and from the other, metres; 0 where
/// its side is known.
fn side_m(job: &Job, approach: &Approach, joint: usize) -> f64 {
    if !is_open(job, approach, joint) {
        return 0.0;
    }
    let from = |side: f64| {
        let mut conditions = approach.conditions(job);
        conditions.direction[joint] = side;
        let real = &job.ground.arm_with(approach.tool as usize).inverse.real;
        real.forward(&approach.nominal_q, &conditions)
    };
    from(-1.0).separation(&from(1.0)).distance_m
}
