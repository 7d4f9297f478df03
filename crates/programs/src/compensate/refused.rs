//! Which files must not be written: those with an error, and those that share targets or calls with
//! one.

use crate::finding::{Finding, Severity};
use crate::program::{Before, Program, Source};
use std::collections::HashSet;

/// Whether each file has an error, or shares targets or calls with one that has.
pub(super) fn files(program: &Program, sources: &[Source], findings: &[Finding]) -> Vec<bool> {
    let errors = findings.iter().filter(|f| f.severity == Severity::Error);
    let names: HashSet<&str> = errors.map(|finding| finding.file.as_str()).collect();
    let mut groups: Vec<usize> = (0..sources.len()).collect();
    if sources.len() > 1 && !names.is_empty() {
        for motion in &program.moves {
            let file = motion.file as usize;
            if let Some(target) = program.target_of(motion) {
                join(&mut groups, file, target.file as usize);
            }
            for before in program.before(motion) {
                if let Before::One(before) = before {
                    let other = program.moves[*before as usize].file;
                    join(&mut groups, file, other as usize);
                }
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
