//! One set of numbers for all approaches of a target.

use super::approach::{Approach, Solved};
use super::rewrite::largest;
use super::{Job, approach, differing, displaced};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::geometry::{Pose, Rotation, Separation, add, scale};
use crate::model::Conditions;
use crate::program::{Shape, Value};
use std::collections::BTreeMap;

/// Numbers that differ by less serve all.
const SAME: Separation = Separation {
    distance_m: 0.002 * MM,
    angle_rad: 0.002 * DEG,
};

/// The fake target of one approach, or of several that agree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fake {
    /// `frame_from_tool` of its numbers where it is a pose.
    pub frame_from_tool: Pose,
    /// The controller's joints.
    pub q: [f64; 6],
}

impl Fake {
    pub(super) fn of(job: &Job, solved: &Solved) -> Self {
        let ground = &job.ground;
        let Solved {
            approach, outcome, ..
        } = solved;
        let equipped = ground.arm_with(approach.tool as usize);
        let world_from_tool = equipped
            .controller
            .forward(&outcome.q, &Conditions::default());
        let frame = ground.placed(approach.frame as usize).nominal;
        Self {
            frame_from_tool: approach.numbers_for(frame.inverse() * world_from_tool),
            q: outcome.q,
        }
    }
}

impl Fake {
    /// What the numbers of a target mean.
    pub(super) fn meant(job: &Job, approach: &Approach, numbers: &[f64]) -> Self {
        let ground = &job.ground;
        let layout = ground.program.targets[approach.target as usize].layout;
        match ground.language.value(layout, numbers, ground.settings) {
            Value::Pose(frame_from_tool) => Self {
                frame_from_tool,
                q: approach.nominal_q,
            },
            Value::Joints(q) => Self {
                frame_from_tool: Pose::identity(),
                q,
            },
        }
    }
}

/// One fake target for all approaches of a target, all of them solved.
///
/// # Errors
/// Where no numbers serve all: what each approach would miss with the mean, and the mean.
pub(super) fn common(job: &Job, group: &[Solved]) -> Result<Fake, (Finding, Fake)> {
    match best(job, group) {
        (fake, true) => Ok(fake),
        (mean, false) => Err((refused(job, group, &mean), mean)),
    }
}

/// The best fake target for all approaches of a target, and whether it serves them.
fn best(job: &Job, group: &[Solved]) -> (Fake, bool) {
    if let [only] = group {
        return (Fake::of(job, only), true);
    }
    let fakes: Vec<Fake> = group.iter().map(|solved| Fake::of(job, solved)).collect();
    let is_joints = job.ground.is_joints(group[0].approach.target as usize);
    let alike = |a: &Fake, b: &Fake| {
        if is_joints {
            return (0..6).all(|i| (a.q[i] - b.q[i]).abs() < SAME.angle_rad);
        }
        let gap = a.frame_from_tool.separation(&b.frame_from_tool);
        gap.distance_m < SAME.distance_m && gap.angle_rad < SAME.angle_rad
    };
    // where the robot stands goes before what it passes in the middle of arcs
    let mut stops = group
        .iter()
        .zip(&fakes)
        .filter(|(solved, _)| !solved.is_passed())
        .peekable();
    let are_stops = stops.peek().is_some();
    let meant: Vec<Fake> = if are_stops {
        stops.map(|(_, fake)| *fake).collect()
    } else {
        fakes.clone()
    };
    let mut mean = mean(&meant);
    if is_joints {
        // of another tool the same joints are another pose
        mean.frame_from_tool = fakes[0].frame_from_tool;
    }
    let passed = |solved: &&Solved| solved.is_passed();
    let is_near =
        |solved: &Solved| landing(job, solved, &mean).distance_m <= displaced::limit_m(job);
    let stops_agree = !are_stops
        || (0..meant.len()).all(|i| meant[..i].iter().all(|other| alike(&meant[i], other)));
    let serves = stops_agree && group.iter().filter(passed).all(is_near);
    (mean, serves)
}

/// How far from its wanted pose the real tool lands with numbers for all approaches of a target:
/// where the robot stands, and where it passes the middle of an arc that is not all it does there.
pub(super) fn landings(job: &Job, group: &[Solved], given: &Fake) -> [Separation; 2] {
    let mut farthest = [Separation::default(); 2];
    for solved in group {
        let is_other = group.len() > 1 && solved.is_passed();
        let most = &mut farthest[usize::from(is_other)];
        *most = largest(*most, landing(job, solved, given));
    }
    farthest
}

/// What arcs miss at a target that serves others too; `None` where that is nothing.
pub(super) fn passed(job: &Job, approach: &Approach, off: &Separation) -> Option<Finding> {
    (off.distance_m > SAME.distance_m).then(|| {
        let message = format!(
            "{} is passed in the middle of arcs in other rotations than it is written for: an arc \
             passes it up to {:.3} mm off its wanted path (the limit is {:.3} mm)",
            job.ground.name_of(approach.target as usize),
            mm_from_m(off.distance_m),
            mm_from_m(displaced::limit_m(job))
        );
        job.ground.at_target(
            "arc-shared",
            Severity::Note,
            approach.target as usize,
            message,
            "give the arc a point of its own; --max-derived-error sets the limit",
        )
    })
}

/// The mean of fake targets that lie near each other; joints as in the first.
fn mean(fakes: &[Fake]) -> Fake {
    let part = 1.0 / fakes.len() as f64;
    let first = fakes[0];
    let (mut translation, mut rotation, mut q) = ([0.0; 3], [0.0; 3], first.q);
    for fake in fakes {
        translation = add(translation, scale(part, fake.frame_from_tool.translation));
        let from_first = fake.frame_from_tool.rotation * first.frame_from_tool.rotation.transpose();
        rotation = add(rotation, scale(part, from_first.vector()));
        for i in 0..6 {
            q[i] += part * (fake.q[i] - first.q[i]);
        }
    }
    Fake {
        frame_from_tool: Pose {
            rotation: Rotation::from_vector(rotation) * first.frame_from_tool.rotation,
            translation,
        },
        q,
    }
}

/// What each approach misses with numbers that are meant for all.
fn refused(job: &Job, group: &[Solved], mean: &Fake) -> Finding {
    let misses: Vec<Separation> = group
        .iter()
        .map(|solved| landing(job, solved, mean))
        .collect();
    job.ground.at_target(
        "target-shared",
        Severity::Error,
        group[0].approach.target as usize,
        differing::message(job, group, &misses),
        if is_one_text_unlike(job, group) {
            "the approaches of one line are unlike: write the line out for each, with a target of its \
             own, or let the program come to it in one of them"
        } else if job.options.split_targets {
            "give each use a target of its own: the text of one of these moves cannot hold one"
        } else {
            "give each use a target of its own, or --split-targets"
        },
    )
}

/// Whether no target serves all approaches of a single move of the text.
fn is_one_text_unlike(job: &Job, group: &[Solved]) -> bool {
    let mut each: BTreeMap<Option<u32>, Vec<Solved>> = BTreeMap::new();
    for one in group {
        let instruction = approach::instruction(job, one.approach);
        each.entry(instruction).or_default().push(*one);
    }
    each.values().any(|alone| !best(job, alone).1)
}

/// How far from its wanted pose the real tool lands at the end of an approach, with given numbers.
pub(super) fn landing(job: &Job, solved: &Solved, given: &Fake) -> Separation {
    let ground = &job.ground;
    let Solved {
        approach, outcome, ..
    } = solved;
    let target = &ground.program.targets[approach.target as usize];
    let equipped = ground.arm_with(approach.tool as usize);
    let q = match target.layout.shape {
        Shape::Joints => given.q,
        Shape::Pose => {
            let world_from_tool = ground.placed(approach.frame as usize).nominal
                * approach.taken(given.frame_from_tool);
            equipped
                .controller_joints(&world_from_tool, approach.branch, &outcome.q)
                .0
        }
    };
    let real = &equipped.inverse.real;
    let gap = real
        .forward(&q, &approach.conditions(job))
        .separation(&solved.wanted(job));
    match approach.middle {
        // nobody goes by the orientation of these numbers
        Some(_) => Separation {
            angle_rad: 0.0,
            ..gap
        },
        None => gap,
    }
}
