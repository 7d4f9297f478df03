//! Long rows of moves, walked in parts side by side.
//!
//! In a row each move has one move before it and one behind. In which joints the robot comes to its
//! middle is mostly known beforehand: those of the branch in which it stands where the row begins.
//! Another walker goes on from there. Where the first one comes to that move in the same joints, to
//! the last bit, and from the same sides, it would find the same; else the rest of the row is walked
//! in its turn.

use super::ground::Ground;
use super::posture;
use super::walk::{Arrival, Arrivals, Behind, NOWHERE, WalkOptions, Walker};
use crate::program::script::short;
use crate::program::{Before, Configuration, Displacement, Motion, Move, Value};
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};
use std::ops::Range;

/// Moves of a part, at least.
#[cfg(not(test))]
const SHORTEST: u32 = 1024;
#[cfg(test)]
const SHORTEST: u32 = 4;
/// Moves before a part that are walked too: behind them the sides from which joints come are those
/// of the moves, not those that were supposed.
const WARM_UP: u32 = 3;

/// A part of a row, walked from a supposed arrival.
struct Part {
    moves: Range<u32>,
    /// The arrivals at its moves and at the one before; up to the first one of which more is to be
    /// said than where the robot stands.
    found: Vec<Arrival>,
}

impl Walker<'_, '_> {
    /// Walks the row of moves that begins with this one; false where it is short, or nothing is
    /// known of it beforehand.
    pub(super) fn walk_row(&mut self, behind: &Behind, at: u32, from: u32) -> bool {
        if at < self.no_row_before {
            return false;
        }
        let end = self.end_of_row(behind, at, from);
        self.no_row_before = end.max(at + 1);
        let parts = short(rayon::current_num_threads());
        let length = (end - at) / parts;
        if parts < 2 || length < SHORTEST {
            return false;
        }
        let start = Arrival {
            from: NOWHERE,
            ..self.arrivals.all[from as usize].clone()
        };
        let (ground, walk_options) = (self.ground, self.walk_options);
        let walked = (0..parts).into_par_iter().map(|part| {
            let first = at + part * length;
            let is_last = part + 1 == parts;
            let moves = first..if is_last { end } else { first + length };
            let found = if part == 0 {
                scout(ground, walk_options, start.clone(), moves.clone())
            } else {
                let start = suppose(ground, &start, first - WARM_UP - 1);
                let walked = start.map(|start| {
                    let moves = first - WARM_UP..moves.end;
                    scout(ground, walk_options, start, moves)
                });
                let walked = walked.into_iter().flatten();
                walked.skip(WARM_UP as usize).collect()
            };
            Part { moves, found }
        });
        let walked: Vec<Part> = walked.collect();
        let mut last = from;
        for part in walked {
            let here = &self.arrivals.all[last as usize];
            let is_met = |supposed: &Arrival| last == from || is_identical(supposed, here);
            let mut found = part.found.into_iter();
            if !found.next().is_some_and(|supposed| is_met(&supposed)) {
                break;
            }
            let is_whole = found.len() == part.moves.len();
            for arrival in found {
                self.arrivals.add(Arrival {
                    from: last,
                    ..arrival
                });
                last = short(self.arrivals.all.len() - 1);
            }
            if !is_whole {
                break;
            }
        }
        if last == from {
            return false;
        }
        let motion = self.arrivals.all[last as usize].motion;
        for &next in behind.of_move(motion) {
            self.open.push(Reverse((next, last)));
        }
        true
    }

    /// Behind the last move of the row that begins at a move; the move itself where there is none.
    fn end_of_row(&self, behind: &Behind, at: u32, from: u32) -> u32 {
        let Some(start) = self.arrivals.all.get(from as usize) else {
            return at;
        };
        let moves = &self.ground.program.moves;
        let is_via = moves[start.motion as usize].motion == Motion::ArcVia;
        if !start.known || start.displaced || start.assumed != 0 || is_via {
            return at;
        }
        // what waits comes first in the text
        let waiting = self
            .open
            .peek()
            .map_or(u32::MAX, |Reverse((next, _))| *next);
        let mut before = start.motion;
        let mut end = at;
        while let Some(motion) = moves.get(end as usize) {
            let is_next = motion.before == Before::One(before)
                && (end == at || behind.of_move(before) == [end])
                && self.arrivals.at(end as usize).next().is_none();
            if end >= waiting || !is_next || !is_plain(self.ground, motion) {
                break;
            }
            before = end;
            end += 1;
        }
        end
    }
}

/// Whether nothing but where the robot stands decides how it comes to the end of a move.
fn is_plain(ground: &Ground, motion: &Move) -> bool {
    motion.target.is_some()
        && !matches!(motion.motion, Motion::ArcVia | Motion::ArcEnd)
        && motion.displacement == Displacement::None
        && ground.program.near(motion).is_none()
}

/// Walks moves from an arrival, which comes first in what is found, up to the first one of which
/// more is to be said than where the robot stands.
fn scout(
    ground: &Ground,
    walk_options: &WalkOptions,
    start: Arrival,
    moves: Range<u32>,
) -> Vec<Arrival> {
    let mut findings = Vec::new();
    let mut all = Vec::with_capacity(moves.len() + 1);
    all.push(start);
    let mut walker = Walker {
        ground,
        walk_options,
        findings: &mut findings,
        arrivals: Arrivals {
            all,
            first: Vec::new(),
            next: Vec::new(),
        },
        open: BinaryHeap::new(),
        many: false,
        // asked only of moves from nowhere
        named: HashMap::new(),
        beyond: HashSet::new(),
        assumed: super::inherited::Assumptions::default(),
        no_row_before: u32::MAX,
    };
    for at in moves {
        let from = short(walker.arrivals.all.len() - 1);
        let arrival = walker.arrive(at, from);
        if !arrival.known || arrival.assumed != 0 || !walker.findings.is_empty() {
            break;
        }
        walker.arrivals.all.push(arrival);
    }
    walker.arrivals.all
}

/// How the robot stands at the end of a move on the branch of an arrival before it.
fn suppose(ground: &Ground, before: &Arrival, at: u32) -> Option<Arrival> {
    let motion = &ground.program.moves[at as usize];
    let q = match ground.goal(motion)?.value {
        Value::Joints(q) => q,
        Value::Pose(_) if ground.is_adrift(motion) => return None,
        value @ Value::Pose(_) => {
            let arm = &ground.equipped(motion.tool)?.arm;
            let frame = ground.frame_of(motion);
            ground.setting.frames[frame].as_ref()?;
            let wanted = ground.meant(&value, motion.tool, frame);
            let any = Configuration::default();
            posture::on_branch(arm, &wanted, before.branch, &before.q, &any)?.q
        }
    };
    Some(Arrival {
        motion: at,
        q,
        ..before.clone()
    })
}

/// Whether what follows from two arrivals is the same to the last bit.
fn is_identical(a: &Arrival, b: &Arrival) -> bool {
    a.motion == b.motion
        && a.q.map(f64::to_bits) == b.q.map(f64::to_bits)
        && a.branch == b.branch
        && a.direction == b.direction
        && (a.known, a.displaced, a.assumed) == (b.known, b.displaced, b.assumed)
}
