//! Files that are read for what they declare only: their targets stay as they are.

use crate::finding::{Finding, Severity};
use crate::program::{Program, Shape, Source};
use std::collections::HashSet;

/// Leaves the targets of such files; a move of another file that goes to one is refused, to a joint
/// target where these are corrected too.
pub(super) fn leave(
    program: &mut Program,
    sources: &[Source],
    joints: bool,
    findings: &mut Vec<Finding>,
) {
    if !sources.iter().any(|source| source.is_context) {
        return;
    }
    let mut reported: HashSet<(u32, u32)> = HashSet::new();
    for motion in &program.moves {
        let source = &sources[motion.file as usize];
        let Some(target) = program.target_of(motion) else {
            continue;
        };
        let declared = &sources[target.file as usize];
        let is_uncorrected = target.layout.shape == Shape::Joints && !joints;
        let stays = !declared.is_context || target.blocked || is_uncorrected;
        if source.is_context || stays || !reported.insert((motion.file, motion.offset)) {
            continue;
        }
        let (line, _) = declared.line_column(target.offset as usize);
        let message = format!(
            "this move goes to {}, which is declared in {} line {line}: that file is read for its \
             declarations only",
            target
                .name
                .as_ref()
                .map_or_else(|| "a target".into(), |name| format!("`{name}`")),
            declared.name
        );
        findings.push(source.finding(
            motion.offset as usize,
            "target-in-context",
            Severity::Error,
            message,
            "give that file as a program too, so that it is rewritten with the others",
        ));
    }
    for target in &mut program.targets {
        target.blocked |= sources[target.file as usize].is_context;
    }
}
