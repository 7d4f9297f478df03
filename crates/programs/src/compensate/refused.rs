//! Which files must not be written: those with an error, and those that share data or calls with one.

use super::displaced::readings;
use crate::finding::{Finding, Severity};
use crate::program::script::Place;
use crate::program::{Before, Program, Readings, Source};
use std::collections::HashSet;

/// Whether each file has an error, or shares data or calls with one that has.
pub(super) fn files(program: &Program, sources: &[Source], findings: &[Finding]) -> Vec<bool> {
    let errors = findings.iter().filter(|f| f.severity == Severity::Error);
    let names: HashSet<&str> = errors.map(|finding| finding.file.as_str()).collect();
    let mut groups: Vec<usize> = (0..sources.len()).collect();
    // what is only read is not written, and does not change
    let is_read = |file: usize| sources[file].is_context;
    let shares = |file: usize, other: usize| !is_read(file) && !is_read(other);
    let is_wrong = |file: usize| names.contains(sources[file].name.as_str());
    if sources.len() > 1 && !names.is_empty() {
        for motion in &program.moves {
            let file = motion.file as usize;
            let read = readings(&motion.displacement).flat_map(Readings::targets);
            for target in motion.target.into_iter().chain(read) {
                let other = program.targets[target].file as usize;
                if !is_read(other) || is_wrong(other) {
                    join(&mut groups, file, other);
                }
            }
            for written in [motion.tool_written, motion.frame_written] {
                let written = written.filter(|place| *place != Place::NOWHERE);
                let other = written.map(|place| place.file as usize);
                if let Some(other) = other.filter(|other| shares(file, *other)) {
                    join(&mut groups, file, other);
                }
            }
            for before in program.before(motion) {
                if let Before::One(before) = before {
                    let other = program.moves[*before as usize].file;
                    join(&mut groups, file, other as usize);
                }
            }
        }
        for decided in &program.decided {
            let file = decided.place.file as usize;
            for target in &decided.targets {
                let other = program.targets[*target].file as usize;
                if shares(file, other) {
                    join(&mut groups, file, other);
                }
            }
        }
        for (file, other) in &program.writes_into {
            let (file, other) = (*file as usize, *other as usize);
            if shares(file, other) {
                join(&mut groups, file, other);
            }
        }
    }
    let mut refused = vec![false; sources.len()];
    for (file, source) in sources.iter().enumerate() {
        if names.contains(source.name.as_str()) {
            refused[top(&mut groups, file)] = true;
        }
    }
    (0..sources.len())
        .map(|file| refused[top(&mut groups, file)])
        .collect()
}

fn top(groups: &mut [usize], mut at: usize) -> usize {
    while groups[at] != at {
        groups[at] = groups[groups[at]];
        at = groups[at];
    }
    at
}

fn join(groups: &mut [usize], a: usize, b: usize) {
    if a != b {
        let (a, b) = (top(groups, a), top(groups, b));
        groups[a.max(b)] = a.min(b);
    }
}
