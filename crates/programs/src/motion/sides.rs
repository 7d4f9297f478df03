//! From which side joints with backlash come to a position: what that is worth, and where the robot
//! goes back to a position of its own.

use super::arms::Equipped;
use super::follow::{self, course};
use super::ground::Ground;
use super::walk::{Arrival, Arrivals, WalkOptions};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Vector, add, norm, scale, sub};
use crate::model::Conditions;
use crate::program::{Before, Motion, Move};
use std::collections::BTreeMap;

/// What the sides are worth is reported beyond this, metres.
pub(crate) const LEAST_SIDE_M: f64 = 2e-6;
/// Name of the finding about moves to where the robot itself was.
const RUN_TIME_POSITION: &str = "run-time-position";

/// Where joints stand at the end of a move, but for their directions.
pub(crate) fn conditions(ground: &Ground, motion: &Move) -> Conditions {
    // of joint moves nobody need know the frame
    let placed = ground.setting.frames[ground.frame_of(motion)].as_ref();
    Conditions {
        gravity_m_s2: placed.and_then(|placed| placed.gravity_m_s2),
        ..ground.arm_with(motion.tool).inverse.conditions
    }
}

/// How far apart the tool may be where some joints come from one side and from the other, metres:
/// those with a direction from that or the other, those without from any.
pub(crate) fn apart_m(
    ground: &Ground,
    arrival: &Arrival,
    direction: [i8; 6],
    open: [bool; 6],
) -> f64 {
    let motion = &ground.program.moves[arrival.motion as usize];
    let real = &ground.arm_with(motion.tool).inverse.real;
    let taken = Conditions {
        direction: direction.map(f64::from),
        ..conditions(ground, motion)
    };
    let from = |conditions: &Conditions| real.forward(&arrival.q, conditions);
    let steps = (0..6).filter(|i| open[*i]).map(|i| {
        let choices = if direction[i] == 0 {
            &EITHER[..]
        } else {
            &OR_OTHER
        };
        (other_side(from, &taken, i), choices)
    });
    largest_sum(&steps.collect::<Vec<_>>())
}

/// A joint comes from the side that is taken, or from the other one.
pub(crate) const OR_OTHER: [f64; 2] = [0.0, 1.0];
/// From one side or the other, and so before.
const EITHER: [f64; 3] = [-1.0, 0.0, 1.0];

/// How the tool moves where a joint comes from the other side than it is taken to; from above and not
/// from below where none is.
pub(crate) fn other_side(
    landing: impl Fn(&Conditions) -> Pose,
    taken: &Conditions,
    joint: usize,
) -> Vector {
    let from = |side: f64| {
        let mut conditions = *taken;
        conditions.direction[joint] = side;
        landing(&conditions).translation
    };
    let side = taken.direction[joint];
    if side == 0.0 {
        sub(from(1.0), from(-1.0))
    } else {
        sub(from(-side), from(side))
    }
}

/// The longest sum of steps, each as often as one of its choices. Joints may cancel each other where all
/// come from the other side.
pub(crate) fn largest_sum(steps: &[(Vector, &[f64])]) -> f64 {
    fn add_to(sum: Vector, steps: &[(Vector, &[f64])]) -> f64 {
        let Some(((step, choices), rest)) = steps.split_first() else {
            return norm(sum);
        };
        let all = choices.iter();
        let all = all.map(|times| add_to(add(sum, scale(*times, *step)), rest));
        all.fold(0.0, f64::max)
    }
    add_to([0.0; 3], steps)
}

/// Joints that are taken to stand in the middle stand half their backlash from it, on either side.
const FROM_MIDDLE: [f64; 2] = [-0.5, 0.5];

/// How far the tool may be off where joints are taken to stand in the middle of their backlash, metres:
/// those with one and without a direction.
pub(crate) fn from_middle_m(equipped: &Equipped, q: &[f64; 6], conditions: &Conditions) -> f64 {
    let landing = |conditions: &Conditions| equipped.inverse.real.forward(q, conditions);
    let open = (0..6).filter(|i| equipped.has_backlash[*i] && conditions.direction[*i] == 0.0);
    let steps = open.map(|i| (other_side(landing, conditions, i), &FROM_MIDDLE[..]));
    largest_sum(&steps.collect::<Vec<_>>())
}

/// Says of which ends of moves nobody knows from which side joints with backlash come, and what that is
/// worth: once a move.
pub(crate) fn unknown(ground: &Ground, arrivals: &Arrivals, findings: &mut Vec<Finding>) {
    let mut worst: BTreeMap<u32, (f64, [bool; 6])> = BTreeMap::new();
    let followed = arrivals.all.iter();
    let followed = followed.filter(|arrival| arrival.known && !arrival.displaced);
    for arrival in followed {
        let motion = &ground.program.moves[arrival.motion as usize];
        let Some(equipped) = ground.equipped(motion.tool) else {
            continue;
        };
        let open = std::array::from_fn(|i| equipped.has_backlash[i] && arrival.direction[i] == 0);
        if !open.contains(&true) {
            continue;
        }
        let conditions = Conditions {
            direction: arrival.direction.map(f64::from),
            ..conditions(ground, motion)
        };
        let off_m = from_middle_m(equipped, &arrival.q, &conditions);
        let before = worst.entry(arrival.motion).or_insert((0.0, open));
        if off_m > before.0 {
            *before = (off_m, open);
        }
    }
    for (motion, (off_m, open)) in worst
        .into_iter()
        .filter(|(_, (off, _))| *off > LEAST_SIDE_M)
    {
        let joints = (0..6).filter(|i| open[*i]).map(|i| (i + 1).to_string());
        let message = format!(
            "nothing says from which side joint {} with backlash comes here: it is taken to stand in \
             the middle, and the tool may be {:.3} mm off",
            joints.collect::<Vec<_>>().join(", "),
            mm_from_m(off_m)
        );
        let motion = &ground.program.moves[motion as usize];
        let hint = "--start-joints says where the robot stands when the program starts";
        let (id, severity) = ("direction-uncertain", Severity::Warning);
        findings.push(ground.at_move(id, severity, motion, message, hint));
    }
}

/// Judges moves to where the robot itself was: its joints come back to the same angles, those with
/// backlash maybe from another side than they stood then.
pub(crate) fn revisits(
    ground: &Ground,
    arrivals: &Arrivals,
    walk_options: &WalkOptions,
    findings: &mut Vec<Finding>,
) {
    for (at, stood) in &ground.program.revisits {
        let motion = &ground.program.moves[*at as usize];
        let known = |before: &Before| match before {
            Before::One(before) => arrivals.at(*before as usize).collect(),
            _ => Vec::new(),
        };
        let each = |before: &[Before]| -> Vec<usize> { before.iter().flat_map(known).collect() };
        let starts = each(ground.program.before(motion));
        let mut worst: Option<(f64, [bool; 6])> = None;
        for there in each(ground.program.listed(stood)) {
            let there = &arrivals.all[there];
            let tool = ground.program.moves[there.motion as usize].tool;
            let Some(equipped) = ground.equipped(tool).filter(|_| there.known) else {
                continue;
            };
            let sides = starts.iter().map(|start| &arrivals.all[*start]);
            let mut sides: Vec<[i8; 6]> = sides
                .map(|start| sides_from(ground, walk_options, motion, start, there))
                .collect();
            if sides.is_empty() {
                sides.push([0; 6]);
            }
            for side in sides {
                let differs = |i: usize| there.direction[i] == 0 || side[i] != there.direction[i];
                let open = std::array::from_fn(|i| equipped.has_backlash[i] && differs(i));
                let off_m = apart_m(ground, there, there.direction, open);
                if worst.is_none_or(|(most_m, _)| off_m > most_m) {
                    worst = Some((off_m, open));
                }
            }
        }
        if let Some((off_m, open)) = worst.filter(|(off_m, _)| *off_m > LEAST_SIDE_M) {
            let found = uncertain(ground, motion, off_m, open);
            // that it is right as it is was said of the same move
            findings.retain(|said| {
                let place = |of: &Finding| (of.line, of.column);
                said.id != RUN_TIME_POSITION
                    || said.severity != Severity::Note
                    || said.file != found.file
                    || place(said) != place(&found)
            });
            findings.push(found);
        }
    }
}

/// From which side each joint comes back to where the robot stood; 0 where nothing says it.
pub(super) fn sides_from(
    ground: &Ground,
    walk_options: &WalkOptions,
    motion: &Move,
    start: &Arrival,
    there: &Arrival,
) -> [i8; 6] {
    let tool = ground.program.moves[there.motion as usize].tool;
    let is_followed = start.known && !start.displaced && !there.displaced;
    let is_arc = matches!(motion.motion, Motion::ArcVia | Motion::ArcEnd);
    let Some(equipped) = ground.equipped(tool).filter(|_| is_followed && !is_arc) else {
        return [0; 6];
    };
    let wanted = equipped
        .controller
        .forward(&there.q, &Conditions::default());
    let path = course(
        motion,
        equipped,
        &start.q,
        None,
        &wanted,
        &there.q,
        None,
        walk_options,
    );
    let ends = [&start.q, &there.q];
    let coming = follow::direction_of(motion, equipped, &path, ends, there.branch, start.direction);
    coming.direction
}

fn uncertain(ground: &Ground, motion: &Move, off_m: f64, open: [bool; 6]) -> Finding {
    let joints = (0..6).filter(|i| open[*i]).map(|i| (i + 1).to_string());
    let joints: Vec<String> = joints.collect();
    let message = format!(
        "this move goes to where the robot itself was; of joint {} with backlash nothing says that \
         it comes there from the side from which it came then: the tool may be {:.3} mm off",
        joints.join(", "),
        mm_from_m(off_m)
    );
    let hint = "come there from the same side both times, or go to a target with numbers";
    ground.at_move(RUN_TIME_POSITION, Severity::Warning, motion, message, hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_sum_is_not_that_of_all_where_steps_cancel() {
        let x = |mm: f64| [mm, 0.0, 0.0];
        let longest = |choices: &[f64]| largest_sum(&[(x(3.0), choices), (x(-2.0), choices)]);
        assert_eq!(longest(&OR_OTHER), 3.0);
        assert_eq!(longest(&EITHER), 5.0);
        assert_eq!(longest(&FROM_MIDDLE), 2.5);
        assert_eq!(largest_sum(&[]), 0.0);
    }
}
