//! Paths that begin or end at targets that stay as they are.

use crate::support::{repository, run, scratch};

/// What `compensate --max-path-error` prints of a program for an IRB 120 with one effect, and the status and
/// the output of `check` of what it writes.
fn judged(effect: &str, program: &str, limit_mm: &str) -> (String, i32, String) {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let plain = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("a profile");
    let plain = &plain[..plain.find("calibration:").expect("a list of effects")];
    let profile = format!("{plain}calibration: {{effects: [{effect}]}}\n");
    std::fs::write(at("robot.yaml"), profile).expect("scratch");
    std::fs::write(at("t.mod"), program).expect("scratch");
    let (profile, input, output) = (at("robot.yaml"), at("t.mod"), at("out.mod"));
    let limit = ["--profile", &profile, "--max-path-error", limit_mm];
    let (status, out, error) = run(&[&["compensate", &input, "-o", &output][..], &limit].concat());
    assert_eq!(status, 0, "{out}{error}");
    let (status, checked, _) =
        run(&[&["check", &output, "--nominal", &input][..], &limit].concat());
    (out, status, checked)
}

#[test]
fn a_kept_target_at_the_end_of_a_move_from_nowhere_is_a_warning_as_it_is_an_error_of_check() {
    let program = "MODULE t\nPROC main()\nMoveAbsJ \
        [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nENDPROC\nENDMODULE\n";
    // 0.3 mm of the upper arm's length, at the tool too
    let effect = "{effect: link_geometry, link: 3, a_mm: 0.3}";
    let (out, status, checked) = judged(effect, program, "0.05");
    assert!(out.contains("warning[path-from-kept-target]"), "{out}");
    assert!(status == 1 && checked.contains("path-error"), "{checked}");
}

/// Between ends that are off, the path may be farther off: what is said has both.
#[test]
fn what_is_said_of_a_path_from_a_kept_target_has_all_of_it() {
    let program = "MODULE t\nCONST robtarget p:=[[450,350,250],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
        PROC main()\nMoveAbsJ [[-40,30,10,0,50,-40],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n\
        MoveL p,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
    // joint 1 goes through two periods on the move
    let effect = "{effect: joint_harmonic, joint: 1, order: 9, cos_deg: 0.05}";
    let (out, _, checked) = judged(effect, program, "0.02");
    let number = |text: &str, before: &str| -> f64 {
        let behind = text.split(before).nth(1);
        let behind = behind.unwrap_or_else(|| panic!("{before}: {text}"));
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
    let path = number(&checked, "along the path never more than");
    assert!((between - path).abs() < 0.002, "{between} {path}");
    assert!(between > 1.5 * ends, "{between} {ends}");
}

/// Joint 2 goes from 35.06 to 33.42 degrees and never turns back: its offset, -0.015 degrees from that
/// side, is just that of its link.
#[test]
fn a_joint_that_goes_slowly_at_the_end_does_not_turn_back() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let (profile, program) = (at("p.yaml"), at("e.ls"));
    let made = run(&["profile", "new", "--robot", "fanuc_crx10ia", "-o", &profile]);
    assert_eq!(made.0, 0, "{}", made.2);
    let text = std::fs::read_to_string(&profile).expect("a profile").replace(
        "effects: []",
        "effects: [{effect: backlash, joint: 2, width_deg: 0.03}, {effect: link_geometry, link: 2, \
         theta_deg: 0.015}]",
    );
    std::fs::write(&profile, text).expect("scratch");
    let text = "/PROG  E3\n/ATTR\nDEFAULT_GROUP\t= 1,*,*,*,*;\n/MN\n   1:  UFRAME_NUM=0 ;\n   2:  \
        UTOOL_NUM=0 ;\n   3:J P[1] 20% FINE ;\n   4:L P[2] 200mm/sec FINE ;\n/POS\nP[1]{\n   GP1:\n\t\
        UF : 0, UT : 0,\n\tJ1= 24.45 deg,\tJ2= 35.06 deg,\tJ3= -11.12 deg,\n\tJ4= 20.96 deg,\tJ5= \
        -99.72 deg,\tJ6= 45.83 deg\n};\nP[2]{\n   GP1:\n\tUF : 0, UT : 0,\tCONFIG : 'N U T, 0, 0, \
        0',\n\tX = 836.0 mm,\tY = 82.4 mm,\tZ = 170.6 mm,\n\tW = 172.139 deg,\tP = 16.299 deg,\tR = \
        75.405 deg\n};\n/END\n";
    std::fs::write(&program, text).expect("scratch");
    let (status, out, error) = run(&[
        "check",
        &program,
        "--profile",
        &profile,
        "--start-joints",
        "30,45,-11,21,-99,45",
        "--max-path-error",
        "0.002",
    ]);
    assert_eq!(status, 0, "{out}{error}");
}
