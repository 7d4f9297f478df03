//! Postures that were assumed, and the moves that go on in them.

use super::ground::Ground;
use super::walk::Walker;
use crate::finding::Finding;
use foldhash::HashMap;
use std::collections::BTreeSet;

/// The findings about a posture that nothing tells, of one that the file gives and no solution has,
/// and of paths that other controllers end in another one, or stop on.
const ASSUMED: [&str; 4] = [
    "posture-assumed",
    "configuration-mismatch",
    "several-postures",
    "beyond-limit",
];

/// The postures that were assumed.
#[derive(Default)]
pub(super) struct Assumptions {
    /// The number of each, by what was said of it: what several arrivals say is one.
    numbers: HashMap<Finding, u32>,
    /// The moves to poses that inherit each.
    moves: Vec<BTreeSet<u32>>,
}

impl Walker<'_, '_> {
    /// The assumption that the posture at a move goes back to, from 1, where `said` findings were
    /// there before it was chosen; `before` is that of the move before, 0 none.
    pub(super) fn assumption(&mut self, at: u32, said: usize, before: u32) -> u32 {
        let own = self.findings[said..].iter();
        let own = own.rev().find(|found| ASSUMED.contains(&found.id));
        let assumed = &mut self.assumed;
        if let Some(own) = own {
            let next = crate::program::script::short(assumed.moves.len() + 1);
            let number = *assumed.numbers.entry(own.clone()).or_insert(next);
            if number == next {
                assumed.moves.push(BTreeSet::new());
            }
            return number;
        }
        if let Some(number) = before.checked_sub(1) {
            assumed.moves[number as usize].insert(at);
        }
        before
    }

    /// Says with each assumption which moves go on in it.
    pub(super) fn name_inherited(&mut self) {
        let assumed = std::mem::take(&mut self.assumed);
        let findings = self.findings.iter_mut();
        for found in findings.filter(|found| ASSUMED.contains(&found.id)) {
            let number = assumed.numbers.get(found);
            let moves = number.map(|number| &assumed.moves[*number as usize - 1]);
            if let Some(moves) = moves.filter(|moves| !moves.is_empty()) {
                let lines = lines(self.ground, moves);
                found.message += &format!("; the posture in {lines} follows from it");
            }
        }
    }
}

/// The lines of moves, moves in a row as one: `lines 4 to 9, 12`; those of each file with its name
/// where there are several.
fn lines(ground: &Ground, moves: &BTreeSet<u32>) -> String {
    let mut rows: Vec<(u32, [u32; 2])> = Vec::new();
    for &at in moves {
        let file = ground.program.moves[at as usize].file;
        match rows.last_mut() {
            Some((of, [_, last])) if *of == file && *last + 1 == at => *last = at,
            _ => rows.push((file, [at, at])),
        }
    }
    let line = |at: u32| ground.line_of(&ground.program.moves[at as usize]);
    let mut named: Vec<(u32, Vec<String>)> = Vec::new();
    for (file, [first, last]) in rows {
        let (first, last) = (line(first), line(last));
        let row = if first == last {
            first.to_string()
        } else {
            format!("{first} to {last}")
        };
        match named.last_mut() {
            Some((of, all)) if *of == file => all.push(row),
            _ => named.push((file, vec![row])),
        }
    }
    for (_, all) in &mut named {
        all.dedup();
    }
    let are_many = ground.sources.len() > 1;
    let named = named.iter().map(|(file, all)| {
        let is_one = all.len() == 1 && !all[0].contains(' ');
        let word = if is_one { "line" } else { "lines" };
        let of = format!("{word} {}", all.join(", "));
        if are_many {
            format!("{} {of}", ground.sources[*file as usize].name)
        } else {
            of
        }
    });
    named.collect::<Vec<_>>().join("; ")
}
