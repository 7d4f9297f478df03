//! Straight moves that leave the reach of the posture in which they begin, and arcs with two beginnings.

use super::command::name;
use crate::support::{poseshift, repository, run, scratch};
use serde_json::Value;

const THESIS: &str = "robots/abb_irb120_thesis.yaml";
const KR210: &str = "robots/kuka_kr210_r2700.yaml";

/// The status of `check`, and its report.
fn checked(arguments: &[&str]) -> (i32, Value) {
    let (status, out, said) = run(&[&["check", "--json"], arguments].concat());
    let report = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{status}: {said}"));
    (status, report)
}

fn ids(report: &Value) -> Vec<(&str, &str)> {
    let findings = report["findings"].as_array().expect("a list").iter();
    let of = |finding: &'_ Value, key| finding[key].as_str().expect("a text").to_owned().leak();
    findings
        .map(|one| (&*of(one, "id"), &*of(one, "severity")))
        .collect()
}

fn krl(moves: &str) -> String {
    format!(
        "DEF t()\n$TOOL={{X 0,Y 0,Z 0,A 0,B 0,C 0}}\n$BASE={{X 0,Y 0,Z 0,A 0,B 0,C 0}}\n{moves}\nEND\n"
    )
}

#[test]
fn a_line_beyond_the_stretched_arm_does_not_end_on_the_other_side_of_axis_1() {
    let folder = scratch();
    let file = folder.path().join("t.src");
    let line = "PTP {A1 20,A2 -120,A3 20,A4 0,A5 40,A6 0}\nLIN {X -455.984,Y 165.965,Z 3063.399,A \
        -20.00000,B 30.00000,C 0.00000}";
    std::fs::write(&file, krl(line)).expect("scratch");
    let (status, report) = checked(&[name(&file), "--profile", KR210]);
    assert_eq!(status, 1);
    let error = ("path-out-of-reach", "error");
    assert!(ids(&report).contains(&error), "{:?}", ids(&report));
    let said = poseshift()
        .current_dir(repository(""))
        .args([
            "compensate",
            name(&file),
            "--profile",
            "programs/krl/profile.yaml",
        ])
        .arg("-o")
        .arg(folder.path().join("out.src"))
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&said.stdout).into_owned();
    assert!(said.contains("warning[path-out-of-reach]"), "{said}");
}

#[test]
fn a_short_part_of_a_path_that_is_out_of_reach_is_found() {
    let folder = scratch();
    let file = folder.path().join("t.src");
    // from 50.5 to 55.8 % of the line
    let line = "PTP {A1 -2.5680,A2 -94.0710,A3 18.7590,A4 4.8570,A5 15.3400,A6 -2.4610}\n\
        LIN {X 553.500,Y 20.000,Z 3187.583,A -0.00000,B 30.00000,C -0.00000}\n\
        LIN {X -286.500,Y 20.000,Z 3187.583,A -0.00000,B 30.00000,C -0.00000}";
    std::fs::write(&file, krl(line)).expect("scratch");
    let (status, report) = checked(&[name(&file), "--profile", KR210]);
    assert_eq!(status, 1);
    let error = ("path-out-of-reach", "error");
    assert!(ids(&report).contains(&error), "{:?}", ids(&report));
}

#[test]
fn an_arc_is_compared_with_that_from_the_same_beginning() {
    let worst = |(_, report): &(i32, Value)| {
        let moves = report["moves"].as_array().expect("moves").iter();
        let errors = moves.filter_map(|one| one["max_path_error_mm"].as_f64());
        errors.fold(0.0, f64::max)
    };
    let folder = scratch();
    let file = folder.path().join("t.src");
    let arcs = "IF $IN[1] THEN\nLIN {X 1500,Y -300,Z 1000,A 0,B 0,C 180}\nELSE\nLIN {X 1500,Y -100,Z 1000,A 0,B 0,C \
        180}\nENDIF\nCIRC {X 1600,Y 0,Z 1000},{X 1500,Y 100,Z 1000,A 0,B 0,C 180}";
    let start = "PTP {A1 0,A2 -90,A3 90,A4 0,A5 90,A6 0}\n";
    std::fs::write(&file, krl(&(start.to_owned() + arcs))).expect("scratch");
    let file = name(&file);
    let profile = "programs/krl/profile.yaml";
    let alone = worst(&checked(&[file, "--profile", profile]));
    let with_itself = worst(&checked(&[file, "--profile", profile, "--nominal", file]));
    assert!(
        (alone - with_itself).abs() < 1e-6 && alone > 0.1,
        "{alone} {with_itself}"
    );
    // samples with arcs in routines that are called from several places
    for (folder, most) in [("urscript/olp", 1.0), ("krl/backup", 5.0)] {
        let [language, _] = [folder.split_once('/').expect("a folder").0, folder];
        let [given, written] = ["in", "out"].map(|of| format!("programs/{folder}/{of}"));
        let profile = format!("programs/{language}/profile.yaml");
        let compared = checked(&[&written, "--profile", &profile, "--nominal", &given]);
        assert!(worst(&compared) < most, "{folder}: {}", worst(&compared));
    }
}

#[test]
fn through_the_wrists_singularity_the_joints_next_to_it_stand_all_along() {
    let folder = scratch();
    let file = folder.path().join("t.mod");
    let program = "MODULE M\nPERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1.4,[5,-3,60],[1,0,0,0],0,0,0]];\n\
        PROC main()\nConfJ\\Off;\nConfL\\Off;\n\
        MoveAbsJ [[0,-3.58647,-16.7361,0,20.32257,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
        MoveL [[414,0,530],[0.70710678,0,0.70710678,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
        ENDPROC\nENDMODULE\n";
    std::fs::write(&file, program).expect("scratch");
    let (status, report) = checked(&[name(&file), "--profile", THESIS]);
    assert_eq!(status, 0, "{:?}", ids(&report));
    // joint 4 stands at zero, far from its limits
    let last = report["moves"].as_array().and_then(|moves| moves.last());
    let margin = last.expect("a move")["joint_margin_deg"].as_f64();
    assert!(margin > Some(20.0), "{margin:?}");
}

#[test]
fn close_by_the_wrists_singularity_joint_4_does_not_sweep_to_it_and_leap() {
    let folder = scratch();
    let file = folder.path().join("t.mod");
    // by 0.16 degrees
    let program = "MODULE M\nPERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1.4,[5,-3,60],[1,0,0,0],0,0,0]];\n\
        PROC main()\nConfJ\\Off;\nConfL\\Off;\n\
        MoveAbsJ [[0,-3.58647,-16.7361,1.0,20.32257,-0.94],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
        MoveL [[414,0,530],[0.70710678,0,0.70710678,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
        ENDPROC\nENDMODULE\n";
    std::fs::write(&file, program).expect("scratch");
    let (status, report) = checked(&[name(&file), "--profile", THESIS]);
    assert_eq!(status, 0, "{:?}", ids(&report));
    let last = &report["moves"][1];
    assert!(last["wrist_deg"].as_f64() < Some(0.2), "{last}");
    // joint 5 turns by 37 degrees in some two seconds
    let speed = last["max_joint_speed_deg_s"].as_f64().expect("a speed");
    assert!((10.0..100.0).contains(&speed), "{speed}");
    assert!(!ids(&report).iter().any(|(id, _)| *id == "joint-speed"));
}

#[test]
fn from_an_aligned_wrist_the_error_is_that_of_samples() {
    let folder = scratch();
    let file = folder.path().join("t.mod");
    let program = "MODULE M\nPERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1.4,[5,-3,60],[1,0,0,0],0,0,0]];\n\
        PROC main()\nConfJ\\Off;\nConfL\\Off;\n\
        MoveAbsJ [[30,10,-10,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
        MoveL [[391.09965,200.4425,665.89809],[-0.6830127,0.1830127,-0.6830127,-0.1830127],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
        MoveL [[451.09965,260.4425,625.89809],[-0.6830127,0.1830127,-0.6830127,-0.1830127],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
        ENDPROC\nENDMODULE\n";
    std::fs::write(&file, program).expect("scratch");
    let (status, report) = checked(&[name(&file), "--profile", THESIS]);
    assert_eq!(status, 0, "{:?}", ids(&report));
    let bound = report["summary"]["max_path_error_mm"].as_f64();
    assert!(bound < Some(3.0), "{bound:?}");
}
