//! What is said of moves between whose targets none can be put, or where the robot stops then.

use super::{Change, Job, TAKEN_UP};
use crate::check::Subject;
use crate::check::walk::Walk;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::program::{Before, Insertion, Motion, Move};
use std::collections::BTreeMap;

const KEPT: &str = "path-from-kept-target";

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
    /// No targets between help where a target itself is off; between its ends the path may be
    /// farther off.
    pub(super) fn off_at_an_end(&self, motion: &Move, ends_m: f64, whole_m: f64) -> Finding {
        let [ends, whole] = [ends_m, whole_m].map(|off_m| format!("{:.3} mm", mm_from_m(off_m)));
        if whole_m > ends_m && whole != ends {
            self.kept_at_an_end(motion, &ends, &format!(", and between up to {whole}"))
        } else {
            self.kept_at_an_end(motion, &ends, "")
        }
    }

    fn kept_at_an_end(&self, motion: &Move, how_far: &str, between: &str) -> Finding {
        let message = format!(
            "this move begins or ends {how_far} off its wanted path{between} (limit {:.3} mm), at a \
             target that stays as it is or is off itself: no targets are inserted",
            mm_from_m(self.limit_m)
        );
        let hint = "--joint-targets correct shifts joint targets, too; give a point that is \
            derived from another a target of its own";
        self.subject
            .finding(motion, KEPT, Severity::Warning, message, hint)
    }

    /// Likewise where a move begins or ends at a point that only the running program knows: once for
    /// each move of the text, unless one of the changes says so already.
    pub(super) fn off_at_unknown_points(&self, changes: &[Option<Change>]) -> Vec<Finding> {
        let derived_off = &self.compensation.derived_off;
        if derived_off.is_empty() {
            return Vec::new();
        }
        let program = &self.walk.program;
        let off_m = |at: usize| derived_off.get(&at).copied().unwrap_or(0.0);
        let off_before_m = |before: &Before| match *before {
            Before::One(at) => off_m(at as usize),
            Before::AnyOf { first, end } => {
                let all = derived_off.range(first as usize..end as usize);
                all.map(|(_, off_m)| *off_m).fold(0.0, f64::max)
            }
            Before::Start | Before::Anywhere | Before::Several(_) => 0.0,
        };
        let begins_m = |motion: &Move| {
            let before = program.before(motion).iter();
            before.map(off_before_m).fold(0.0, f64::max)
        };
        let mut worst: BTreeMap<u32, (f64, &Move)> = BTreeMap::new();
        for (at, motion) in program.moves.iter().enumerate() {
            // an arc begins where the point on its way is gone to from
            let first = match (motion.motion, at.checked_sub(1)) {
                (Motion::ArcVia, _) => continue,
                (Motion::ArcEnd, Some(via)) if program.moves[via].motion == Motion::ArcVia => {
                    &program.moves[via]
                }
                _ => motion,
            };
            let ends_m = off_m(at).max(begins_m(first));
            let known = worst.entry(motion.instruction).or_insert((0.0, motion));
            if ends_m > known.0 {
                *known = (ends_m, motion);
            }
        }
        for (stop, change) in changes.iter().enumerate() {
            let finding = change.as_ref().and_then(|change| change.finding.as_ref());
            if finding.is_some_and(|finding| finding.id == KEPT) {
                worst.remove(&self.walk.motion(stop).instruction);
            }
        }
        let worst = worst.into_values().filter(|of| of.0 > self.limit_m);
        worst
            .map(|(ends_m, motion)| {
                if ends_m.is_finite() {
                    self.kept_at_an_end(motion, &format!("up to {:.3} mm", mm_from_m(ends_m)), "")
                } else {
                    self.kept_at_an_end(motion, "by what the text does not bound", "")
                }
            })
            .collect()
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
