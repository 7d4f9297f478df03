//! Paths that begin or end at targets that stay as they are.

use crate::support::{repository, run, scratch};

/// Between ends that are off, the path may be farther off: what is said has both.
#[test]
fn what_is_said_of_a_path_from_a_kept_target_has_all_of_it() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let plain = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("a profile");
    let plain = &plain[..plain.find("calibration:").expect("a list of effects")];
    // joint 1 goes through three periods on the move
    let effects =
        "calibration: {effects: [{effect: joint_harmonic, joint: 1, order: 9, cos_deg: 0.05}]}\n";
    std::fs::write(at("robot.yaml"), format!("{plain}{effects}")).expect("scratch");
    let program = "MODULE t\nCONST robtarget p:=[[450,350,250],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
        PROC main()\nMoveAbsJ [[-40,30,10,0,50,-40],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n\
        MoveL p,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
    std::fs::write(at("t.mod"), program).expect("scratch");
    let (profile, input, output) = (at("robot.yaml"), at("t.mod"), at("out.mod"));
    let limit = ["--profile", &profile, "--max-path-error", "0.02"];
    let (status, out, error) = run(&[&["compensate", &input, "-o", &output][..], &limit].concat());
    assert_eq!(status, 0, "{out}{error}");
    let number = |text: &str, before: &str| -> f64 {
        let behind = text
            .split(before)
            .nth(1)
            .unwrap_or_else(|| panic!("{before}: {text}"));
        let number = behind.split_whitespace().next().expect("a number");
        number.parse().expect("a number")
    };
    let of_path = out
        .split("path-from-kept-target")
        .find(|part| part.contains("between up to"))
        .unwrap_or_else(|| panic!("{out}"));
    let (ends, between) = (
        number(of_path, "begins or ends"),
        number(of_path, "between up to"),
    );
    let (_, checked, _) = run(&[&["check", &output, "--nominal", &input][..], &limit].concat());
    let path = number(&checked, "along the path never more than");
    assert!((between - path).abs() < 0.002, "{between} {path}");
    assert!(between > 1.5 * ends, "{between} {ends}");
}
