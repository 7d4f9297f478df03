//! The tasks of a controller, by the folders of a backup: each drives an arm of its own.
//!
//! # Source
//! ABB, application manual `MultiMove`: a motion task a mechanical unit group; operating manual
//! `RobotStudio`: a backup has `RAPID/TASK1/PROGMOD`, `RAPID/TASK2/PROGMOD`.

use crate::finding::{Finding, Severity};
use crate::program::Source;
use crate::program::script::{Expr, Script};
use foldhash::{HashMap, HashMapExt};

/// The folders above a task's and its name, of a module in one.
fn task(name: &str) -> Option<(&str, &str)> {
    let folders = name.match_indices(['/', '\\']).map(|(at, _)| at);
    let mut start = 0;
    let mut found = None;
    for end in folders {
        let folder = &name[start..end];
        let is_task = ["task", "t_rob"].into_iter().any(|word| {
            let (head, number) = folder.split_at_checked(word.len()).unwrap_or((folder, ""));
            head.eq_ignore_ascii_case(word)
                && !number.is_empty()
                && number.bytes().all(|byte| byte.is_ascii_digit())
        });
        if is_task {
            found = Some((&name[..start], folder));
        }
        start = end + 1;
    }
    found
}

/// That the moves of two tasks of one controller would be corrected for one arm.
pub(super) fn second_robot(script: &Script, sources: &[Source]) -> Vec<Finding> {
    let tasks: Vec<_> = sources.iter().map(|source| task(&source.name)).collect();
    let mut first: HashMap<&str, (&str, usize)> = HashMap::new();
    let mut found: HashMap<(&str, &str), Finding> = HashMap::new();
    let goes = |target| !matches!(target, Expr::Absent);
    let moves = script.instructions.iter().filter(|of| goes(of.target));
    for instruction in moves {
        let place = instruction.place;
        let file = place.file as usize;
        let Some((above, name)) = tasks[file].filter(|_| !sources[file].is_context) else {
            continue;
        };
        let (other, other_file) = *first.entry(above).or_insert((name, file));
        if other.eq_ignore_ascii_case(name) {
            continue;
        }
        found.entry((above, name)).or_insert_with(|| {
            sources[file].finding(
                place.offset as usize,
                "second-robot",
                Severity::Error,
                format!(
                    "{name} moves an arm, and {other} ({}) another: each task of a controller has an \
                     arm of its own, and the profile is of one",
                    sources[other_file].name
                ),
                "give the folder of each task alone, with the profile of its arm; --accept \
                 second-robot where only one of them moves",
            )
        });
    }
    let mut found: Vec<Finding> = found.into_values().collect();
    found.sort_by(|a, b| a.file.cmp(&b.file));
    found
}

#[cfg(test)]
mod tests {
    use super::task;
    use crate::motion::read;
    use crate::program::rapid::Rapid;
    use crate::program::{Settings, Source};

    #[test]
    fn moves_of_two_tasks_are_of_two_arms() {
        let module = |name: &str, statement: &str| {
            format!("MODULE {name}\nPROC main()\n{statement}\nENDPROC\nENDMODULE\n").into_bytes()
        };
        let go = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;";
        for (folders, statement, said) in [
            (["b/TASK1", "b/TASK2"], go, 1),
            (["T_ROB1", "T_ROB2"], go, 1),
            // a task that only computes, another controller, one task
            (["b/TASK1", "b/TASK2"], "WaitTime 1;", 0),
            (["a/TASK1", "b/TASK2"], go, 0),
            (["b/TASK1/PROGMOD", "b/TASK1/SYSMOD"], go, 0),
            (["b", "b"], go, 0),
        ] {
            let [one, two] = folders;
            let sources = [
                Source::new(format!("{one}/m.mod"), module("m", go)),
                Source::new(format!("{two}/n.mod"), module("n", statement)),
            ];
            let program = read(&Rapid, &sources, &Settings::default()).expect("two modules");
            let is_it = |found: &&crate::finding::Finding| found.id == "second-robot";
            let found: Vec<_> = program.findings.iter().filter(is_it).collect();
            assert_eq!(found.len(), said, "{folders:?} {statement}");
            assert!(
                found
                    .iter()
                    .all(|of| of.file == sources[1].name && of.line == 3)
            );
        }
    }

    #[test]
    fn a_task_is_a_folder_with_a_number() {
        for (name, is) in [
            ("RAPID/TASK1/PROGMOD/M.mod", Some(("RAPID/", "TASK1"))),
            ("T_ROB2/M.mod", Some(("", "T_ROB2"))),
            ("a\\task12\\M.mod", Some(("a\\", "task12"))),
            ("TASK1.mod", None),
            ("TASKS/M.mod", None),
            ("TASK/M.mod", None),
            ("täsk1/M.mod", None),
        ] {
            assert_eq!(task(name), is, "{name}");
        }
    }
}
