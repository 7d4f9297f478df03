//! Moves to joints before any tool is set: the flange alone goes along them.

use super::setting::{Given, Setting};
use crate::finding::{Finding, Severity};
use crate::profile::{Mounted, Profile};
use crate::program::{Language, Move, Program, Source};
use std::collections::BTreeSet;

/// What is given for the tools of a program; the flange for tools that nobody knows and that no move
/// to a pose has. `needs` says which moves are walked.
pub(crate) fn flange_for_joints(
    language: &dyn Language,
    program: &Program,
    sources: &[Source],
    (profile, given): (&Profile, &Given),
    findings: &mut Vec<Finding>,
    needs: impl Fn(&Move) -> bool,
) -> Given {
    let setting = Setting::of(language, program, profile, given);
    let mut given = given.clone();
    let walked = || program.moves.iter().filter(|motion| needs(motion));
    let unknown = |motion: &&Move| setting.tools[motion.tool].is_none();
    let name = |motion: &Move| program.tools[motion.tool].name.as_str();
    // what is given counts for every tool of the name, whatever its load
    let to_poses = walked().filter(|motion| unknown(motion) && program.goes_to_pose(motion));
    let mut left: BTreeSet<&str> = to_poses.map(name).collect();
    for motion in walked().filter(unknown) {
        if !left.insert(name(motion)) {
            continue;
        }
        let flange = Mounted {
            load: Some((0.0, [0.0; 3])),
            ..Mounted::flange()
        };
        let name = name(motion).to_owned();
        let message = format!(
            "only moves to joints have tool `{name}`, and nothing says where it is: the flange goes along them, \
             without a tool and without a load"
        );
        let hint = "begin with a tool, or give it with --tool";
        let source = &sources[motion.file as usize];
        let (id, severity) = ("tool-not-set", Severity::Warning);
        findings.push(source.finding(motion.offset as usize, id, severity, message, hint));
        given.tools.insert(Some(name), flange);
    }
    given
}
