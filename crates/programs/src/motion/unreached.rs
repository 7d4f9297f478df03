//! Moves that nothing reaches: they need no tool and no work frame.

use super::setting::{Given, Setting};
use crate::finding::{Finding, Severity};
use crate::profile::Profile;
use crate::program::{Language, Move, Program, Source, TargetId};
use std::collections::BTreeSet;

/// Makes moves to nowhere of those that nothing reaches and whose tool or work frame nobody knows;
/// a target that no other move goes to stays as it is.
pub(crate) fn leave(
    language: &dyn Language,
    program: &mut Program,
    sources: &[Source],
    (profile, given): (&Profile, &Given),
    findings: &mut Vec<Finding>,
    needs: impl Fn(&Program, &Move) -> bool,
) {
    if !program.moves.iter().any(|motion| motion.is_dead) {
        return;
    }
    let setting = Setting::of(language, program, profile, given);
    let is_left = |motion: &Move| {
        let is_unknown = || setting.unknown(program, motion).next().is_some();
        motion.is_dead && needs(program, motion) && is_unknown()
    };
    let left: Vec<bool> = program.moves.iter().map(is_left).collect();
    let mut targets: BTreeSet<TargetId> = BTreeSet::new();
    for (motion, _) in program
        .moves
        .iter_mut()
        .zip(&left)
        .filter(|(_, left)| **left)
    {
        targets.extend(motion.target.take());
    }
    for motion in &program.moves {
        motion.target.inspect(|target| {
            targets.remove(target);
        });
    }
    for target in targets {
        let of = &mut program.targets[target];
        of.blocked = true;
        let name = of.name.as_deref().unwrap_or("this target");
        let message = format!(
            "only moves that nothing reaches go to {name}, and nothing says with which tool and in \
             which work frame: it stays as it is"
        );
        let hint = "give the files that call this with other values, or nothing if none does";
        let source = &sources[of.file as usize];
        let (id, severity) = ("target-unused-here", Severity::Note);
        findings.push(source.finding(of.offset as usize, id, severity, message, hint));
    }
}
