//! Moves that come behind any of many: elements of an array that only the running program chooses.
//!
//! Those before that stand alike, on the same branch and within the same half rotations, are gone on
//! from as one. From which side joints come then nothing says.

use super::ground::Ground;
use super::walk::{Arrival, Behind, NOWHERE, Walker};
use crate::inverse::Branch;
use crate::program::script::short;
use crate::program::{Before, Motion, Move};
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

/// A row of moves: first, and behind the last.
type Row = (u32, u32);

/// How the robot stands as far as it tells arrivals apart: branch, half rotations of each joint, and
/// whether that is known, displaced, assumed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Stand {
    branch: Branch,
    halves: [i32; 6],
    is: [bool; 3],
}

impl Stand {
    fn of(arrival: &Arrival) -> Self {
        #[allow(
            clippy::cast_possible_truncation,
            reason = "joints are a few rotations"
        )]
        let halves = arrival.q.map(|q| (q / PI).round() as i32);
        let is = [arrival.known, arrival.displaced, arrival.assumed != 0];
        if arrival.known {
            let branch = arrival.branch;
            return Self { branch, halves, is };
        }
        Self {
            branch: Branch::ALL[0],
            halves: [0; 6],
            is,
        }
    }
}

/// The moves behind many, and what is known of these.
pub(super) struct Crowds {
    /// Each move with its row, and how many of the row's ends it has been gone on to from.
    behind: Vec<(u32, usize, usize)>,
    rows: Vec<Ends>,
    /// Arrivals that have been looked at.
    seen: usize,
}

/// How the robot stands behind a row of moves, each with an arrival that stands so.
struct Ends {
    row: Row,
    stands: HashSet<Stand>,
    from: Vec<u32>,
}

/// Whether a move is followed from any of many: of an arc the point on its way must be one.
fn is_followed(motion: &Move) -> bool {
    motion.motion != Motion::ArcEnd
}

/// Whether a move begins at what comes before, and not behind moves that are known.
pub(super) fn starts(motion: &Move, before: &Before) -> bool {
    match before {
        Before::One(_) => false,
        Before::AnyOf { .. } => !is_followed(motion),
        _ => true,
    }
}

impl Crowds {
    pub(super) fn of(ground: &Ground) -> Self {
        let mut crowds = Self {
            behind: Vec::new(),
            rows: Vec::new(),
            seen: 0,
        };
        let mut known: HashMap<Row, usize> = HashMap::new();
        for (at, motion) in ground.program.moves.iter().enumerate() {
            for before in ground.program.before(motion) {
                if let Before::AnyOf { first, end } = *before
                    && is_followed(motion)
                {
                    let row = (first, end);
                    let rows = &mut crowds.rows;
                    let ends = *known.entry(row).or_insert_with(|| {
                        rows.push(Ends {
                            row,
                            stands: HashSet::new(),
                            from: Vec::new(),
                        });
                        rows.len() - 1
                    });
                    crowds.behind.push((short(at), ends, 0));
                }
            }
        }
        crowds
    }

    /// Takes in the arrivals that have come since.
    fn look(&mut self, arrivals: &[Arrival]) {
        for (at, arrival) in arrivals.iter().enumerate().skip(self.seen) {
            for ends in &mut self.rows {
                let (first, end) = ends.row;
                if (first..end).contains(&arrival.motion) && ends.stands.insert(Stand::of(arrival))
                {
                    ends.from.push(short(at));
                }
            }
        }
        self.seen = arrivals.len();
    }
}

impl Walker<'_, '_> {
    /// Goes on to the moves behind many, until nothing new is found.
    pub(super) fn run_crowds(&mut self, behind: &Behind, crowds: &mut Crowds) {
        if crowds.behind.is_empty() {
            return;
        }
        while crowds.seen != self.arrivals.all.len() {
            crowds.look(&self.arrivals.all);
            let Crowds {
                behind: moves,
                rows,
                ..
            } = crowds;
            for (next, ends, done) in moves {
                let from = &rows[*ends].from;
                for &from in &from[*done..] {
                    let arrival = self.arrive(*next, from);
                    let arrival = Arrival {
                        from: NOWHERE,
                        direction: [0; 6],
                        ..arrival
                    };
                    self.add(behind, arrival);
                }
                *done = from.len();
            }
            self.run(behind);
        }
    }
}
