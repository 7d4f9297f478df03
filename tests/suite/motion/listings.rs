//! FANUC programs that may be meant by a call, and those of several controllers.

use super::registers::{AT, listing, point, read_named};
use super::{errors, fakes, message};
use poseshift::compensate::Compensation;

const MOVES: &str = "UFRAME_NUM=0\nUTOOL_NUM=1\nJ P[1] 10% FINE\n";

fn program(name: &str, lines: &str) -> String {
    let points = point(1, AT);
    listing(name, &format!("{MOVES}{lines}L P[1] 9mm/sec FINE"), &points)
}

/// SYSFRAME.VA of two tools, the first so long, millimetres.
fn tools(first: f64) -> String {
    let tool = |number: u32, z: f64| {
        format!("  [1,{number}] = \n  X: 0.000 Y: 0.000 Z: {z:.3}\n  W: 0.000 P: 0.000 R: 0.000\n")
    };
    format!(
        "[*SYSTEM*]$MNUTOOL  Storage: CMOS  Access: RW  : ARRAY[1,2] OF POSITION\n{}{}",
        tool(1, first),
        tool(2, 50.0)
    )
}

fn read(files: &[(&str, String)]) -> Compensation {
    let files: Vec<(&str, &str)> = files.iter().map(|(name, text)| (*name, &**text)).collect();
    read_named(&files)
}

#[test]
fn programs_of_one_name_that_is_called_are_named() {
    let sets = |tool: u32| listing("B", &format!("UTOOL_NUM={tool}"), "");
    let main = program("A", "CALL B\n");
    let main = main.replace("UT : 1", "UT : F");
    let with = |files: [(&str, String); 2]| {
        let [one, two] = files;
        read(&[
            ("a.ls", main.clone()),
            one,
            two,
            ("sysframe.va", tools(20.0)),
        ])
    };
    let done = with([("x/b.ls", sets(1)), ("y/b.ls", sets(2))]);
    let said = message(&done, "program-name-ambiguous");
    assert!(said.contains("x/b.ls") && said.contains("y/b.ls"), "{said}");
    assert_eq!(errors(&done), ["target-shared"]);
    let done = with([
        ("x/b.ls", sets(1)),
        ("y/c.ls", sets(2).replace("PROG B", "PROG C")),
    ]);
    assert!(
        done.findings
            .iter()
            .all(|f| f.id != "program-name-ambiguous")
    );
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
}

#[test]
fn a_call_of_a_program_that_a_register_names_is_said_to_be_one() {
    let main = program("A", "CALL SR[1]\n").replace("UT : 1", "UT : F");
    let other = listing("B", "UTOOL_NUM=2", "");
    let files = [
        ("a.ls", main),
        ("b.ls", other),
        ("sysframe.va", tools(20.0)),
    ];
    let done = read(&files);
    assert_eq!(errors(&done), ["frame-chosen-at-run-time"]);
    let said = message(&done, "frame-chosen-at-run-time");
    assert!(said.contains("which routine is called"), "{said}");
}

#[test]
fn each_program_has_the_frames_of_the_nearest_folder_where_folders_disagree() {
    let alone = |z: f64| read(&[("a.ls", program("A", "")), ("sysframe.va", tools(z))]);
    let expected = [fakes(&alone(20.0)), fakes(&alone(40.0))].concat();
    assert_ne!(expected[0], expected[1]);
    let files = [
        ("r1/sysframe.va", tools(20.0)),
        ("r1/tp/a.ls", program("A", "")),
        ("r2/a.ls", program("A", "")),
        ("r2/sysframe.va", tools(40.0)),
    ];
    let done = read(&files);
    assert_eq!(fakes(&done), expected);
    let said = message(&done, "several-controllers");
    assert!(
        said.contains("r1/sysframe.va") && said.contains("r2/sysframe.va"),
        "{said}"
    );
    // of one controller nothing is said
    let same = read(
        &files
            .each_ref()
            .map(|(name, text)| (*name, text.replace("40.000", "20.000"))),
    );
    assert_eq!(fakes(&same)[1], expected[0]);
    assert!(same.findings.iter().all(|f| f.id != "several-controllers"));
    // a folder with frames alone, or a program outside, does not say whose they are
    for place in ["a.ls", "r1/b.ls"] {
        let mut unclear = files.clone();
        unclear[2].0 = place;
        assert!(
            errors(&read(&unclear)).contains(&"frame-name-ambiguous"),
            "{place}"
        );
    }
}
