//! Calls that may leave the robot elsewhere than the text says before a move: of routines that are
//! not in the files, and searches that stop on their way.

use super::Job;
use super::approach::Approach;
use super::solve::is_directed;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use std::collections::{BTreeMap, BTreeSet};

/// A tool that the other sides of its joints put less off is not reported, metres.
const LEAST_M: f64 = 2e-5;

/// The worst of what calls do to the moves behind them.
pub(super) struct Led {
    is_directed: bool,
    /// By the call: how far the tool is off, metres, of which approach, and the moves behind it.
    worst: BTreeMap<u32, (f64, Approach, BTreeSet<u32>)>,
}

impl Led {
    pub(super) fn of(job: &Job) -> Self {
        Self {
            is_directed: !job.ground.program.led.is_empty() && is_directed(job),
            worst: BTreeMap::new(),
        }
    }

    /// Notes how far the tool is off at the end of a move where joints with backlash come from the
    /// other side than they do from the move before the call.
    pub(super) fn look(&mut self, job: &Job, approach: &Approach) {
        if !self.is_directed {
            return;
        }
        let ground = &job.ground;
        let led = &ground.program.led;
        let Ok(at) = led.binary_search_by_key(&approach.motion, |(motion, _)| *motion) else {
            return;
        };
        let equipped = ground.arm_with(approach.tool as usize);
        let side = |side: f64| {
            let mut conditions = approach.conditions(job);
            for (direction, has_backlash) in
                conditions.direction.iter_mut().zip(equipped.has_backlash)
            {
                if has_backlash {
                    *direction *= side;
                }
            }
            equipped
                .inverse
                .real
                .forward(&approach.nominal_q, &conditions)
        };
        let off_m = side(1.0).separation(&side(-1.0)).distance_m;
        if off_m < LEAST_M {
            return;
        }
        let new = || (0.0, *approach, BTreeSet::new());
        let (worst, of, moves) = self.worst.entry(led[at].1).or_insert_with(new);
        moves.insert(approach.motion);
        if off_m > *worst {
            (*worst, *of) = (off_m, *approach);
        }
    }

    /// One finding a call.
    pub(super) fn report(self, job: &Job, findings: &mut Vec<Finding>) {
        let ground = &job.ground;
        for (call, (off_m, approach, moves)) in self.worst {
            let (place, name) = &ground.program.calls[call as usize];
            let equipped = ground.arm_with(approach.tool as usize);
            let joints: Vec<String> = (0..6)
                .filter(|&i| equipped.has_backlash[i] && approach.direction[i] != 0)
                .map(|i| (i + 1).to_string())
                .collect();
            let line = ground.line_of(&ground.program.moves[approach.motion as usize]);
            let others = match moves.len() {
                1 => String::new(),
                2 => ", and at another move".to_owned(),
                count => format!(", and at {} other moves", count - 1),
            };
            let message = format!(
                "`{name}` may leave the robot elsewhere than the text says; if it does, joint {} \
                 with backlash may come from the other side to {} in line {line}, and the tool be \
                 {:.3} mm off{others}",
                joints.join(", "),
                ground.name_of(approach.target as usize),
                mm_from_m(off_m)
            );
            findings.push(ground.finding(
                "direction-uncertain",
                Severity::Warning,
                place.file,
                place.offset,
                message,
                "give the files of the routine with --with, or go to a point of the text first, \
                 from which the joints come as they should",
            ));
        }
    }
}
