//! No output takes the place of what is read, nor of another output, whatever the command.

use crate::support::{poseshift, repository, scratch};
use std::collections::BTreeMap;
use std::path::Path;

/// Files that the commands read.
const FILES: [(&str, &str); 7] = [
    ("p.yaml", "robots/abb_irb120_thesis.yaml"),
    ("a.csv", "docs/measuring/nominal.csv"),
    ("b.csv", "docs/measuring/probed.csv"),
    ("robot.csv", "docs/measuring/robot.csv"),
    ("board.csv", "docs/measuring/board.csv"),
    ("taught.csv", "docs/measuring/taught.csv"),
    ("t.mod", "docs/measuring/program.mod"),
];
const JOINTS: &str = "id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n\
                      a,0,0,0,0,30,0,400,0,600\nb,10,20,-30,0,30,0,500,40,300\n";

fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = std::fs::read_dir(folder).expect("scratch");
    files
        .map(|file| {
            let file = file.expect("a file");
            let name = file.file_name().to_string_lossy().into_owned();
            (name, std::fs::read(file.path()).expect("a file"))
        })
        .collect()
}

#[test]
fn no_output_takes_the_place_of_an_input_or_of_another_output() {
    let scratch = scratch();
    let folder = scratch.path();
    for (name, from) in FILES {
        std::fs::copy(repository(from), folder.join(name)).expect("scratch");
    }
    std::fs::write(folder.join("j.csv"), JOINTS).expect("scratch");
    std::fs::write(folder.join("m.csv"), JOINTS).expect("scratch");
    std::fs::write(folder.join("base.json"), "{}").expect("scratch");
    let before = content(folder);
    let commands = [
        "calibrate --profile p.yaml --measurements m.csv -o m.csv",
        "calibrate --profile p.yaml --measurements m.csv -o p.yaml",
        // another name of the same file
        "calibrate --profile p.yaml --measurements m.csv -o ./m.csv",
        "calibrate --profile p.yaml --measurements m.csv -o new.yaml --report new.yaml",
        "validate --profile p.yaml --measurements m.csv --report m.csv",
        "plan --profile p.yaml --count 3 -o p.yaml",
        "plan --profile p.yaml --count 3 --program p.yaml",
        "plan --profile p.yaml --count 3 --given j.csv -o j.csv",
        "plan --profile p.yaml --count 3 -o z.csv --program z.csv",
        "plan --profile p.yaml --count 3 -o z.csv --program ./z.csv",
        "simulate --profile p.yaml --joints j.csv -o p.yaml",
        "simulate --profile p.yaml --joints j.csv -o j.csv",
        "axes m.csv --profile p.yaml --report p.yaml",
        "register a.csv b.csv -o b.csv",
        "register a.csv b.csv -o f.yaml --report f.yaml",
        "handeye robot.csv board.csv --setup eye-to-hand -o board.csv",
        "hexapod --taught taught.csv --base-mm 300,300,300 -o taught.csv",
        "diagnose --profile p.yaml --measurements m.csv -o m.csv",
        "diagnose --profile p.yaml --measurements m.csv --poses p.yaml",
        "diagnose --profile p.yaml --measurements m.csv -o d.yaml --poses d.yaml",
        "check t.mod --profile p.yaml --junit t.mod",
        "check t.mod --profile p.yaml --baseline base.json --update-baseline --junit base.json",
        "check t.mod --profile p.yaml --baseline base.json --update-baseline --report ./base.json",
        "compensate t.mod --profile p.yaml -o p.yaml",
        "compensate t.mod ./t.mod --profile p.yaml --in-place",
        "compensate t.mod --profile p.yaml --in-place --report t.mod",
        "profile new --robot abb_irb120 -o p.yaml",
    ];
    for command in commands {
        let output = poseshift()
            .current_dir(folder)
            .args(command.split(' '))
            .output()
            .expect("the program starts");
        let reported = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{command}: {reported}");
        assert!(reported.contains("written"), "{command}: {reported}");
        assert_eq!(content(folder), before, "{command}");
    }
}
