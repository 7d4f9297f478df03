//! Decisions of the program by numbers of targets that are rewritten.

use super::Job;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use std::collections::BTreeMap;

/// The targets by whose numbers the program decides; none is shifted yet.
pub(super) fn targets(job: &Job) -> BTreeMap<usize, f64> {
    let decided = job.ground.program.decided.iter();
    let targets = decided.flat_map(|decided| decided.targets.iter());
    targets.map(|target| (*target, f64::NEG_INFINITY)).collect()
}

/// Adds a finding for each statement that reads numbers of a target that is rewritten, and by which
/// the program decides.
pub(super) fn check(job: &Job, shifts: &BTreeMap<usize, f64>, findings: &mut Vec<Finding>) {
    let ground = &job.ground;
    for decided in &ground.program.decided {
        let shifts = decided.targets.iter().map(|target| shifts[target]);
        let shift_m = shifts.fold(f64::NEG_INFINITY, f64::max);
        if shift_m < 0.0 {
            continue;
        }
        let name = &decided.name;
        let here = match decided.decides {
            None => format!("the program decides here by numbers of `{name}`"),
            Some(place) => {
                let source = &ground.sources[place.file as usize];
                let (line, _) = source.line_column(place.offset as usize);
                let file = if place.file == decided.place.file {
                    String::new()
                } else {
                    format!(" of {}", source.name)
                };
                format!(
                    "the program reads numbers of `{name}` here and decides by them in line \
                     {line}{file}"
                )
            }
        };
        let message = format!(
            "{here}: they are those of the fake target then, {:.3} mm from what was programmed",
            mm_from_m(shift_m)
        );
        let hint = "see that the decision has room for the correction, or let it use numbers of \
            its own";
        let place = decided.place;
        let source = &ground.sources[place.file as usize];
        let (id, severity) = ("numbers-read", Severity::Warning);
        // of files that are read for their declarations nothing is reported
        let of_target = decided.targets.iter().next().filter(|_| source.is_context);
        findings.push(match of_target {
            Some(target) => {
                let (line, _) = source.line_column(place.offset as usize);
                let message = format!("line {line} of {}: {message}", source.name);
                ground.at_target(id, severity, *target, message, hint)
            }
            None => ground.finding(id, severity, place.file, place.offset, message, hint),
        });
    }
}
