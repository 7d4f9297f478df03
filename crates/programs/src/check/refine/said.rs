//! What is said of moves between whose targets none can be put, or where the robot stops then.

use super::{Job, TAKEN_UP};
use crate::check::Subject;
use crate::check::walk::Walk;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::program::{Insertion, Move};

/// What is said of a file where moves that end in an exact stop were repeated: the robot stops at
/// each of the new targets.
pub(super) fn stops<'a>(
    subject: &Subject,
    walk: &Walk,
    inserted: impl Iterator<Item = &'a Insertion>,
) -> Option<Finding> {
    let program = &walk.program;
    let mut first: Option<&Move> = None;
    let mut count = 0;
    for insertion in inserted {
        let motion = &program.moves[insertion.motion];
        let speed_zone = program.speed_zone(motion);
        if speed_zone.zone_m != Some(0.0) || speed_zone.cuts_corner() {
            continue;
        }
        // the last part of an arc is the arc itself
        count += insertion.between.len() - usize::from(insertion.is_arc());
        let before = first.filter(|first| first.offset <= motion.offset);
        first = before.or(Some(motion));
    }
    let first = first.filter(|_| count > 0)?;
    let message = if count == 1 {
        "the target that comes in before this move stops the robot as the move itself does".into()
    } else {
        format!(
            "{count} of the targets that come in stop the robot as the moves do that they are on \
             the way of, the first before this one"
        )
    };
    let hint = "let a move that must not stop on its way end in a corner (zone, C_DIS, CNT, PL, r)";
    Some(subject.finding(first, "stops-inserted", Severity::Note, message, hint))
}

impl Job<'_> {
    /// No targets between help where a target itself is off.
    pub(super) fn off_at_an_end(&self, motion: &Move, ends_m: f64) -> Finding {
        let message = format!(
            "this move begins or ends {:.3} mm off its wanted path (limit {:.3} mm), at a target \
             that stays as it is or is off itself: no targets are inserted",
            mm_from_m(ends_m),
            mm_from_m(self.limit_m)
        );
        let hint = "--joint-targets correct shifts joint targets, too; give a point that is \
            derived from another a target of its own";
        self.subject.finding(
            motion,
            "path-from-kept-target",
            Severity::Warning,
            message,
            hint,
        )
    }

    /// Joints with backlash reverse where a move begins.
    pub(super) fn off_until_taken_up(&self, motion: &Move, most_m: f64) -> Finding {
        let message = format!(
            "joints with backlash reverse where this move begins: the tool is up to {:.3} mm off \
             the wanted path (limit {:.3} mm) until a target at {:.1} % of it",
            mm_from_m(most_m),
            mm_from_m(self.limit_m),
            100.0 * TAKEN_UP
        );
        let hint = "no target avoids that; come to where the move begins from the side to which \
            it leaves";
        self.subject
            .finding(motion, "path-at-reversal", Severity::Warning, message, hint)
    }

    /// What of its text forbids to repeat a move.
    pub(super) fn forbidden(&self, motion: &Move) -> Option<&'static str> {
        let program = &self.walk.program;
        let span = program.instructions[motion.instruction as usize].span();
        let bytes = &self.subject.sources[motion.file as usize].bytes;
        self.subject.language.forbids_repeating(&bytes[span])
    }

    /// No targets can be inserted where they are needed.
    pub(super) fn failed(&self, motion: &Move, whole_m: f64, why: &str) -> Finding {
        let message = format!(
            "the path of this move is up to {:.3} mm off the wanted one (limit {:.3} mm), and no \
             targets can be inserted: {why}",
            mm_from_m(whole_m),
            mm_from_m(self.limit_m)
        );
        let hint = "a larger --max-path-error, or shorter moves";
        self.subject
            .finding(motion, "path-not-refined", Severity::Error, message, hint)
    }
}
