//! Macros run jobs that the files do not say which.

use super::*;
use crate::program::{Displacement, Move};

/// The job `A`, and others by their names.
fn with_others(instructions: &str, others: &[(&str, &str)]) -> Program {
    let second = "4.000,5.000,6.000,10.0000,20.0000,30.0000";
    let third = "5.000,0.000,0.000,0.0000,0.0000,0.0000";
    let positions = format!(
        "{USER}{}P00001={P6}\nP00002={second}\nP00003={third}",
        points(2)
    );
    let mut texts = vec![job(&positions, instructions)];
    for (name, text) in others {
        let one = job(&format!("{USER}{}", points(1)), text);
        texts.push(one.replace("//NAME A", &format!("//NAME {name}")));
    }
    let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
    read_files(&texts, &Settings::default()).expect("jobs")
}

/// The targets that moves of the job `A` go to.
fn targets(program: &Program) -> Vec<&str> {
    let own = program.moves.iter().filter(|m| m.file == 0);
    let own = own.filter_map(|m| program.target_of(m)?.name.as_deref());
    let mut found: Vec<&str> = own.collect();
    found.sort_unstable();
    found.dedup();
    found
}

#[test]
fn what_a_job_that_nothing_names_writes_may_be_written_by_a_macro() {
    let main = "SET P020 P001\nMACRO1 MJ#(1) ARGF1\nMOVL P020";
    let next = "GETARG LB000 IARG#(1)\nIFTHEN LB000=1\nSET P020 P002\nENDIF";
    let both = with_others(main, &[("NEXT", next)]);
    assert_eq!(targets(&both), ["P001", "P002"]);
    // what is given to it nobody knows
    let given = with_others(main, &[("NEXT", "GETARG P020 IARG#(1)")]);
    assert!(ids(&given).contains(&"computed-target"));
    // a job that something names is no macro, nor is one that has the macro
    let named = with_others(main, &[("NEXT", next), ("OTHER", "CALL JOB:NEXT")]);
    assert_eq!(targets(&named), ["P001", "P002"]);
    let named = with_others(
        "SET P020 P001\nMACRO1 MJ#(1)\nMOVL P020\nCALL JOB:NEXT",
        &[("NEXT", next)],
    );
    assert_eq!(targets(&named), ["P001"]);
    let above = with_others(
        main,
        &[("MAIN", "SET P020 P002\nCALL JOB:A\nSET P020 P002")],
    );
    assert_eq!(targets(&above), ["P001"]);
}

#[test]
fn a_shift_that_a_macro_may_switch_on_is_seen() {
    let main = "MACRO2 MJ#(1)\nMOVL C00000\nSFTOF\nMOVL C00001";
    let is_refused = |others: &[(&str, &str)]| {
        let program = with_others(main, others);
        let own = program.moves.iter().filter(|m| m.file == 0);
        let own = own.filter_map(|m| program.target_of(m));
        own.map(|target| target.blocked).collect::<Vec<_>>()
    };
    assert_eq!(is_refused(&[("ON", "SFTON P077 UF#(12)")]), [true, false]);
    // through the job that it calls
    let through = [("FIRST", "CALL JOB:ON"), ("ON", "SFTON P077 UF#(12)")];
    assert_eq!(is_refused(&through), [true, false]);
    assert_eq!(
        is_refused(&[("PART", "SFTON P077 UF#(12)\nMOVL C00000\nSFTOF")]),
        [false, false]
    );
    // a shift of the text displaces the move, or does not
    let known = with_others(main, &[("ON", "SFTON P003 UF#(12)")]);
    let own = known.moves.iter().filter(|m| m.file == 0);
    assert_eq!(
        own.filter(|m| m.displacement != Displacement::None).count(),
        1
    );
}

#[test]
fn jobs_that_write_nothing_for_others_are_as_without_macros() {
    let main = "MOVL C00000\nMACRO1 MJ#(1)\nMOVL C00001";
    let part = "MOVL C00000\nMACRO1 MJ#(2)\nSFTON P077\nSFTOF\nSET P030 P001\nMOVL P030";
    let others = [("ONE", part), ("TWO", part)];
    let all = with_others(main, &others);
    let alone = with_others(main, &[]);
    let own = |program: &Program| {
        let own = program.moves.iter().filter(|m| m.file == 0);
        let name = |m: &Move| program.target_of(m).and_then(|target| target.name.clone());
        own.map(|m| (name(m), m.before, m.displacement.clone()))
            .collect::<Vec<_>>()
    };
    assert_eq!(own(&all), own(&alone));
    let is_error = |f: &crate::finding::Finding| f.severity == crate::finding::Severity::Error;
    assert!(!all.findings.iter().any(is_error), "{:?}", all.findings);
}
