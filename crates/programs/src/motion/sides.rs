//! From which side joints with backlash come to a position: what that is worth, and where the robot
//! goes back to a position of its own.

use super::follow::{self, course};
use super::ground::Ground;
use super::walk::{Arrival, Arrivals, WalkOptions};
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::model::Conditions;
use crate::program::{Before, Motion, Move};

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

/// How far apart the tool is where some joints come from one side and from the other, metres.
pub(crate) fn apart_m(
    ground: &Ground,
    arrival: &Arrival,
    direction: [i8; 6],
    open: [bool; 6],
) -> f64 {
    let motion = &ground.program.moves[arrival.motion as usize];
    let equipped = ground.arm_with(motion.tool);
    let from = |side: f64| {
        let of = |i: usize| match (open[i], direction[i]) {
            (true, 0) => side,
            (true, direction) => f64::from(direction) * side,
            (false, direction) => f64::from(direction),
        };
        let conditions = Conditions {
            direction: std::array::from_fn(of),
            ..conditions(ground, motion)
        };
        equipped.inverse.real.forward(&arrival.q, &conditions)
    };
    from(1.0).separation(&from(-1.0)).distance_m
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
fn sides_from(
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
