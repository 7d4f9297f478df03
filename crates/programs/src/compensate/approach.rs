//! From where the robot comes to each target: with which tool, in which work frame, from where.

use super::led::Led;
use super::{Job, solve};
use crate::finding::{Finding, Severity};
use crate::geometry::{Pose, Rotation};
use crate::inverse::{Branch, Outcome};
use crate::model::Conditions;
use crate::motion::walk::{Arrival, Arrivals, NOWHERE};
use crate::program::script::short;
use crate::program::{Displacement, Move, Program, Shape, Shift, TargetId, Value};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Joints that differ by less are the same, radians.
pub(super) const SAME_RAD: f64 = 1e-7;

/// An approach of a target.
#[derive(Clone, Debug)]
pub(super) struct Approach {
    /// The controller's joints at the wanted pose.
    pub nominal_q: [f64; 6],
    /// Index in the program's targets.
    pub target: u32,
    /// Index of the move; [`NOWHERE`] where none goes there.
    pub motion: u32,
    /// Index of the arrival; [`NOWHERE`] where no move goes there.
    pub arrival: u32,
    pub tool: u32,
    pub frame: u32,
    pub branch: Branch,
    /// Direction in which each joint last moved, where an effect depends on it.
    pub direction: [i8; 6],
    /// The controller goes by the target's configuration data.
    pub honoured: bool,
    /// As [`crate::motion::walk::Arrival::middle`].
    pub middle: Option<Arc<Rotation>>,
    /// The program goes to no other place of the target than that, displaced by this.
    pub shift: Option<Arc<Shift>>,
}

impl Approach {
    /// Where the simulation wants the tool of the real arm, in the world of an arm at home.
    pub(super) fn wanted(&self, job: &Job) -> Pose {
        job.ground.placed(self.frame as usize).real * self.in_frame(job)
    }

    /// Where the simulation wants the tool of the controller's arm, on the part as it stands.
    pub(super) fn meant(&self, job: &Job) -> Pose {
        job.ground.placed(self.frame as usize).meant * self.in_frame(job)
    }

    /// Where the controller has the tool at a pose that the target's numbers give: displaced, and in
    /// the middle of an arc it looks at the position alone.
    pub(super) fn taken(&self, mut numbers: Pose) -> Pose {
        if let Some(shift) = self.shift.as_deref() {
            numbers = shift.apply(&numbers);
        }
        if let Some(middle) = self.middle.as_deref() {
            numbers.rotation = numbers.rotation * *middle;
        }
        numbers
    }

    /// The pose that the numbers must give for the controller to have the tool at one.
    pub(super) fn numbers_for(&self, mut taken: Pose) -> Pose {
        if let Some(middle) = self.middle.as_deref() {
            taken.rotation = taken.rotation * middle.transpose();
        }
        if let Some(shift) = self.shift.as_deref() {
            taken = shift.undo(&taken);
        }
        taken
    }

    /// Whether the robot goes there in another orientation than the target's numbers give.
    pub(super) fn is_turned(&self) -> bool {
        self.middle
            .as_deref()
            .is_some_and(|middle| *middle != Rotation::identity())
    }

    /// Where the tool is with the target's numbers, in the work frame.
    pub(super) fn in_frame(&self, job: &Job) -> Pose {
        self.taken(self.numbers_in_frame(job))
    }

    /// What the target's numbers say, in the work frame.
    pub(super) fn numbers_in_frame(&self, job: &Job) -> Pose {
        let ground = &job.ground;
        let target = self.target as usize;
        let value = crate::program::value(ground.language, ground.program, ground.settings, target)
            .expect("the target of an approach has numbers");
        ground.in_frame(&value, self.tool as usize)
    }

    /// The conditions of the real arm.
    pub(super) fn conditions(&self, job: &Job) -> Conditions {
        Conditions {
            direction: self.direction.map(f64::from),
            gravity_m_s2: job.ground.placed(self.frame as usize).gravity_m_s2,
            ..job.ground.arm_with(self.tool as usize).inverse.conditions
        }
    }
}

/// An approach with the joints found for it, and what its target's numbers mean.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solved<'a> {
    pub approach: &'a Approach,
    pub outcome: &'a Outcome,
    in_frame: Pose,
}

impl<'a> Solved<'a> {
    pub(super) fn of(job: &Job, approach: &'a Approach, outcome: &'a Outcome) -> Self {
        Self {
            approach,
            outcome,
            in_frame: approach.in_frame(job),
        }
    }

    /// Whether the robot goes through on an arc, in whatever orientation.
    pub(super) fn is_passed(&self) -> bool {
        self.approach.middle.is_some()
    }

    /// As [`Approach::wanted`].
    pub(super) fn wanted(&self, job: &Job) -> Pose {
        job.ground.placed(self.approach.frame as usize).real * self.in_frame
    }

    /// As [`Approach::meant`].
    pub(super) fn meant(&self, job: &Job) -> Pose {
        job.ground.placed(self.approach.frame as usize).meant * self.in_frame
    }

    /// Where the target's numbers say that the controller's tool is.
    pub(super) fn programmed(&self, job: &Job) -> Pose {
        job.ground.placed(self.approach.frame as usize).nominal * self.in_frame
    }
}

/// Whether a target stays as it is whatever moves go there.
pub(super) fn stays(job: &Job, target: TargetId) -> bool {
    let found = &job.ground.program.targets[target];
    found.blocked || (found.layout.shape == Shape::Joints && !job.options.correct_joint_targets)
}

/// Whether a move's tool and work frame must be known.
pub(super) fn needs(program: &Program, correct_joint_targets: bool, motion: &Move) -> bool {
    program.target_of(motion).is_some_and(|target| {
        !target.blocked && (target.layout.shape == Shape::Pose || correct_joint_targets)
    })
}

/// The approaches of all targets that do not stay, by target.
pub(super) fn gather(job: &Job, arrivals: &Arrivals, findings: &mut Vec<Finding>) -> Vec<Approach> {
    let ground = &job.ground;
    let program = ground.program;
    let mut led = Led::of(job, arrivals);
    let mut used = vec![false; program.targets.len()];
    for motion in &program.moves {
        if let Some(target) = motion.target {
            used[target] = true;
        }
    }
    let of = |(at, arrival): (usize, &Arrival)| {
        let motion = &program.moves[arrival.motion as usize];
        let target = motion.target.filter(|target| !stays(job, *target))?;
        if !arrival.known || ground.equipped(motion.tool).is_none() {
            return None;
        }
        Some(Approach {
            nominal_q: arrival.q,
            target: short(target),
            motion: arrival.motion,
            arrival: short(at),
            tool: short(motion.tool),
            frame: short(ground.frame_of(motion)),
            branch: arrival.branch,
            direction: arrival.direction,
            honoured: arrival.honoured,
            middle: arrival.middle.clone(),
            shift: None,
        })
    };
    let all = arrivals.all.par_iter().enumerate().map(of);
    let all: Vec<Option<Approach>> = all.collect();
    let mut approaches: Vec<Approach> = all.into_iter().flatten().collect();
    let others = approaches.iter().filter_map(|of| from_other_side(job, of));
    let others: Vec<Approach> = others.collect();
    approaches.extend(others);
    for approach in &approaches {
        led.look(job, approach);
    }
    let is_derived = |approach: &mut Approach| {
        program.moves[approach.motion as usize].displacement != Displacement::None
    };
    let derived: Vec<Approach> = approaches.extract_if(.., is_derived).collect();
    led.report(job, findings);
    sort(&mut approaches);
    add_derived(job, derived, &mut approaches);
    add_unused(job, &used, &mut approaches, findings);
    sort(&mut approaches);
    if !job.options.split_targets {
        drop_same(job, &mut approaches);
    }
    drop_served(job, arrivals, &mut approaches, findings);
    approaches
}

/// The same where external axes come from the other side, where they come from both.
fn from_other_side(job: &Job, approach: &Approach) -> Option<Approach> {
    let stand = job.ground.stand_in(approach.frame as usize)?;
    let other = stand.from_other_side?;
    Some(Approach {
        frame: short(other),
        ..approach.clone()
    })
}

/// By target; where the robot stands goes before what it passes in the middle of arcs.
fn sort(approaches: &mut [Approach]) {
    approaches.sort_by_key(|approach| {
        let is_passed = approach.middle.is_some();
        (
            approach.target,
            is_passed,
            approach.motion,
            approach.arrival,
        )
    });
}

/// Leaves each of the approaches of one target once.
fn drop_same(job: &Job, approaches: &mut Vec<Approach>) {
    let (mut kept, mut first) = (0, 0);
    for at in 0..approaches.len() {
        let approach = &approaches[at];
        if kept > 0 && approaches[kept - 1].target != approach.target {
            first = kept;
        }
        let known = approaches[first..kept]
            .iter()
            .any(|other| is_same(job, other, approach));
        if !known {
            approaches.swap(kept, at);
            kept += 1;
        }
    }
    approaches.truncate(kept);
}

/// Leaves out approaches of which nobody knows from which side some joints come, from where a program
/// starts or from a point that only the running program knows, where the numbers of another approach
/// serve them. A target that is written out at each move is served by those of its line.
fn drop_served(
    job: &Job,
    arrivals: &Arrivals,
    approaches: &mut Vec<Approach>,
    findings: &mut Vec<Finding>,
) {
    if !approaches.iter().any(|a| solve::has_unknown_side(job, a)) {
        return;
    }
    let all = approaches.clone();
    approaches.retain(|approach| {
        if !solve::has_unknown_side(job, approach) {
            return true;
        }
        let first = all.partition_point(|other| other.target < approach.target);
        let of_target = all[first..]
            .iter()
            .take_while(|other| other.target == approach.target);
        let mut of_line = of_target.filter(|other| {
            !job.options.split_targets || instruction(job, other) == instruction(job, approach)
        });
        let other = of_line.find(|other| serves(job, other, approach));
        let Some(other) = other.filter(|_| begins_unknown(job, arrivals, approach)) else {
            return true;
        };
        let found = solve::unknown_side(job, arrivals, approach, Some(other));
        if findings.last() != Some(&found) {
            findings.push(found);
        }
        false
    });
}

/// Whether the robot comes from where a program starts, or from a point that only the running program
/// knows.
fn begins_unknown(job: &Job, arrivals: &Arrivals, approach: &Approach) -> bool {
    let (program, at) = (job.ground.program, approach.arrival);
    arrivals.unknown_before(program, at).is_some() || arrivals.is_from_start(program, at)
}

/// The move of the text that an approach is of.
pub(super) fn instruction(job: &Job, approach: &Approach) -> Option<u32> {
    let motion = job.ground.program.moves.get(approach.motion as usize);
    motion.map(|motion| motion.instruction)
}

/// Whether an approach goes as another one of which less is known, as far as anybody knows.
fn serves(job: &Job, known: &Approach, other: &Approach) -> bool {
    let has_backlash = job.ground.arm_with(known.tool as usize).has_backlash;
    let sides = (0..6).filter(|i| has_backlash[*i]);
    let mut sides = sides.map(|i| (known.direction[i], other.direction[i]));
    let knows_more = sides.clone().any(|(known, other)| known != 0 && other == 0);
    knows_more
        && sides.all(|(known, other)| other == 0 || other == known)
        && has_same_posture(job, known, other)
}

/// Whether two approaches of one target ask for the same numbers.
fn is_same(job: &Job, a: &Approach, b: &Approach) -> bool {
    a.direction == b.direction && has_same_posture(job, a, b)
}

/// Whether two approaches of one target differ by nothing but the sides from which joints come.
fn has_same_posture(job: &Job, a: &Approach, b: &Approach) -> bool {
    let setting = &job.ground.setting;
    a.branch == b.branch
        && a.honoured == b.honoured
        && (0..6).all(|i| (a.nominal_q[i] - b.nominal_q[i]).abs() < SAME_RAD)
        && setting.same_tool(a.tool as usize, b.tool as usize)
        && setting.same_frame(a.frame as usize, b.frame as usize)
}

/// By what every move to some targets displaces them; nothing where moves to one differ.
fn displaced_alike(
    program: &Program,
    targets: impl Iterator<Item = u32>,
) -> BTreeMap<u32, Option<&Shift>> {
    let mut alike: BTreeMap<u32, Option<Option<&Shift>>> = targets.map(|of| (of, None)).collect();
    for motion in &program.moves {
        let target = motion.target.map(short);
        if let Some(known) = target.and_then(|target| alike.get_mut(&target)) {
            let own = match &motion.displacement {
                Displacement::By(shift) => Some(&**shift),
                _ => None,
            };
            *known = Some(known.unwrap_or(own).filter(|known| own == Some(*known)));
        }
    }
    let alike = alike.into_iter();
    alike.map(|(target, by)| (target, by.flatten())).collect()
}

/// Targets that moves only go near. Those that all moves displace alike are such that the robot comes
/// to the point there; others as if it went to the target itself, in the posture that it has nearby.
fn add_derived(job: &Job, mut derived: Vec<Approach>, approaches: &mut Vec<Approach>) {
    if derived.is_empty() {
        return;
    }
    let targets = derived.iter().map(|approach| approach.target);
    let alike = displaced_alike(job.ground.program, targets);
    let direct = approaches.len();
    derived.sort_by_key(|approach| approach.target);
    for of_target in derived.chunk_by(|a, b| a.target == b.target) {
        let mut approach = of_target[0].clone();
        let known = approaches[..direct]
            .binary_search_by_key(&approach.target, |other| other.target)
            .is_ok();
        if known {
            continue;
        }
        let are_same = of_target.iter().all(|of| is_same(job, of, &approach));
        let shift = alike.get(&approach.target).copied().flatten();
        if let Some(shift) = shift.filter(|_| are_same) {
            approach.shift = Some(Arc::new(*shift));
        } else {
            let wanted = approach.meant(job);
            let arm = &job.ground.arm_with(approach.tool as usize).arm;
            let near = arm.solve_branch(&wanted, approach.branch, &approach.nominal_q);
            if near.beyond == 0.0 {
                approach.nominal_q = near.q;
            }
        }
        approaches.push(approach);
    }
}

/// A target that no move in these files uses: its tool and frame are what the user gives for
/// unknown names.
fn add_unused(
    job: &Job,
    used: &[bool],
    approaches: &mut Vec<Approach>,
    findings: &mut Vec<Finding>,
) {
    let ground = &job.ground;
    let (tool, frame) = (ground.program.tools.len(), ground.program.frames.len());
    for target in 0..used.len() {
        if used[target] || stays(job, target) || ground.is_joints(target) {
            continue;
        }
        let equipped = ground.equipped(tool);
        let Some(equipped) = equipped.filter(|_| !ground.language.has_framed_positions()) else {
            findings.push(unused(job, target));
            continue;
        };
        // where a track stands then nobody says
        let carried = !ground.profile.external.track.is_empty();
        if carried || ground.setting.frames[frame].is_none() {
            findings.push(unused(job, target));
            continue;
        }
        let decoded =
            crate::program::meaning(ground.language, ground.program, ground.settings, target);
        let Some(decoded) = decoded else { continue };
        let Value::Pose(_) = decoded.value else {
            continue;
        };
        let wanted = ground.meant(&decoded.value, tool, frame);
        let configuration = &decoded.configuration;
        let arm = &equipped.arm;
        let posture = ground.posture_alone(arm, target, &wanted, configuration, findings);
        if let Some((branch, q)) = posture {
            approaches.push(Approach {
                nominal_q: q,
                target: short(target),
                motion: NOWHERE,
                arrival: NOWHERE,
                tool: short(tool),
                frame: short(frame),
                branch,
                direction: [0; 6],
                honoured: true,
                middle: None,
                shift: None,
            });
        }
    }
}

fn unused(job: &Job, target: TargetId) -> Finding {
    let name = job.ground.name_of(target);
    let (message, hint) = if job.ground.language.has_framed_positions() {
        (
            format!(
                "no move in these files uses {name}: with which tool and how the robot comes there is unknown"
            ),
            "give the files that use it together, or --keep-going to leave it as it is",
        )
    } else {
        (
            format!("no move in these files uses {name}: its tool and work frame are unknown"),
            "give the files that use it together, or --tool and --frame for it, or --keep-going to \
             leave it as it is",
        )
    };
    job.ground
        .at_target("target-unused", Severity::Error, target, message, hint)
}
