//! What may leave the robot elsewhere than the text says before a move: calls of routines that are
//! not in the files, searches that stop on their way, interrupts that move the robot.

use super::Job;
use super::approach::Approach;
use super::solve::is_directed;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::program::Interrupt;
use std::collections::{BTreeMap, BTreeSet};

/// A tool that the other sides of its joints put less off is not reported, metres.
const LEAST_M: f64 = 2e-5;

/// What leads the robot elsewhere before a move.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum By {
    /// Index in [`crate::program::Program::calls`].
    Call(u32),
    /// Index in [`crate::program::Program::interrupts`].
    Interrupt(usize),
}

/// The worst of what calls and interrupts do to the moves behind them.
pub(super) struct Led {
    is_directed: bool,
    /// By the cause: how far the tool is off, metres, of which approach, and the moves behind it.
    worst: BTreeMap<By, (f64, Approach, BTreeSet<u32>)>,
}

impl Led {
    pub(super) fn of(job: &Job) -> Self {
        Self {
            is_directed: {
                let program = job.ground.program;
                let is_led = !program.led.is_empty() || !program.interrupts.is_empty();
                is_led && is_directed(job)
            },
            worst: BTreeMap::new(),
        }
    }

    /// Notes how far the tool is off at the end of a move where joints with backlash come from the
    /// other side than they do from the move before the call, or the interrupt.
    pub(super) fn look(&mut self, job: &Job, approach: &Approach) {
        if !self.is_directed {
            return;
        }
        let ground = &job.ground;
        let led = &ground.program.led;
        let called = led.binary_search_by_key(&approach.motion, |(motion, _)| *motion);
        let called = called.ok().map(|at| By::Call(led[at].1));
        let interrupts = ground.program.interrupts.iter().enumerate();
        let other =
            |(_, of): &(usize, &Interrupt)| of.moves.binary_search(&approach.motion).is_err();
        let others = interrupts.filter(other).map(|(at, _)| By::Interrupt(at));
        let causes: Vec<By> = called.into_iter().chain(others).collect();
        if causes.is_empty() {
            return;
        }
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
        for by in causes {
            let new = || (0.0, *approach, BTreeSet::new());
            let (worst, of, moves) = self.worst.entry(by).or_insert_with(new);
            moves.insert(approach.motion);
            if off_m > *worst {
                (*worst, *of) = (off_m, *approach);
            }
        }
    }

    /// One finding a cause.
    pub(super) fn report(self, job: &Job, findings: &mut Vec<Finding>) {
        let ground = &job.ground;
        for (by, (off_m, approach, moves)) in self.worst {
            let (place, name, does, hint) = match by {
                By::Call(call) => {
                    let (place, name) = &ground.program.calls[call as usize];
                    (
                        place,
                        name,
                        "may leave the robot elsewhere than the text says",
                        "give the files of the routine with --with, or go to a point of the text \
                         first, from which the joints come as they should",
                    )
                }
                By::Interrupt(at) => {
                    let of = &ground.program.interrupts[at];
                    (
                        &of.place,
                        &of.name,
                        "moves the robot, and may run between any two moves of the others",
                        "go back in it to where the program was, on a longer move, from where \
                         joints come as they did",
                    )
                }
            };
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
                "`{name}` {does}; if it does, joint {} with backlash may come from the other side to \
                 {} in line {line}, and the tool be {:.3} mm off{others}",
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
                hint,
            ));
        }
    }
}
