//! INFORM jobs: postures that RCONF tells, jobs of several robots, positions that are computed.

use super::displaced::misses;
use super::{PLAIN, done, errors, message};
use poseshift::compensate::Compensation;
use poseshift::geometry::units::DEG;

const DOWN: &str = "430.000,0.000,400.000,180.0000,0.0000";
/// Fields of RCONF that say nothing.
const REST: &str = ",0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0";

fn job(name: &str, robot: &str, positions: &str, instructions: &str) -> String {
    format!(
        "/JOB\n//NAME {name}\n//POS\n///NPOS 2,0,0,2,0,0\n///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\n\
         C00000=0.0000,0.0000,0.0000,0.0000,60.0000,170.0000\n///POSTYPE BASE\n///RECTAN\n\
         {positions}//INST\n///DATE 2020/01/01 00:00\n///ATTR SC,RW\n///GROUP1 {robot}\nNOP\n\
         MOVJ C00000 VJ=10.00\n{instructions}END\n"
    )
}

/// What becomes of a joint move to a pose with these six fields of RCONF.
fn with_rconf(effects: &[&str], fields: &str, pose: &str) -> Compensation {
    let position = format!("///RCONF {fields}{REST}\nC00001={pose}\n");
    let text = job("T", "RB1", &position, "MOVJ C00001 VJ=10.00\n");
    done(effects, &[("t.jbi", &text)])
}

/// Joint 6 at the second position, degrees.
fn joint_6(done: &Compensation) -> f64 {
    let solved = done.targets[1].q.expect("a solution");
    solved[5] / DEG
}

#[test]
fn rconf_says_in_which_revolution_an_axis_stands() {
    let pose = format!("{DOWN},5.0000");
    let within = with_rconf(&[PLAIN], "0,0,0,0,0,0", &pose);
    let beyond = with_rconf(&[PLAIN], "0,0,0,0,1,0", &pose);
    for done in [&within, &beyond] {
        assert!(
            done.findings
                .iter()
                .all(|f| f.id != "configuration-mismatch")
        );
        assert_eq!(errors(done), [""; 0], "{:?}", done.findings);
    }
    let [within, beyond] = [&within, &beyond].map(joint_6);
    assert!((within.abs() - 175.0).abs() < 0.5, "{within}");
    assert!((beyond.abs() - 185.0).abs() < 0.5, "{beyond}");
    assert!((within + 360.0 * beyond.signum() - beyond).abs() < 0.01);
}

#[test]
fn a_correction_across_the_border_of_rconf_is_refused() {
    let turned = "{effect: link_geometry, link: 6, theta_deg: 0.05}";
    // joint 6 is 180 degrees less the rotation; the arm's own is 0.05 degrees more than commanded
    let at = |rotation: &str| {
        let pose = format!("{DOWN},{rotation}");
        with_rconf(&[turned], "0,0,0,0,1,0", &pose)
    };
    let across = at("-0.0200");
    assert_eq!(
        errors(&across),
        ["configuration-kept"],
        "{:?}",
        across.findings
    );
    let inside = at("0.0200");
    assert_eq!(errors(&inside), [""; 0], "{:?}", inside.findings);
    assert!(
        (joint_6(&inside) + 180.07).abs() < 0.001,
        "{}",
        joint_6(&inside)
    );
}

#[test]
fn which_elbow_reaches_to_the_rear_is_not_certain() {
    // joints 0, -70, -60, 0, -40, 0 and 0, -51.9, -93.9, 0, -24.2, 0 are both there
    let pose = "-572.368,0.000,581.198,0.0000,-80.0000,0.0000";
    for elbow in ["1,0,1,0,0,0", "1,1,1,0,0,0"] {
        let rear = with_rconf(&[PLAIN], elbow, pose);
        assert_eq!(errors(&rear), [""; 0], "{:?}", rear.findings);
        let said = message(&rear, "posture-assumed");
        assert!(said.contains("-60.0") && said.contains("-93.9"), "{said}");
    }
    let front = with_rconf(&[PLAIN], "0,0,0,0,0,0", &format!("{DOWN},10.0000"));
    assert!(front.findings.iter().all(|f| f.id != "posture-assumed"));
}

#[test]
fn jobs_of_several_robots_are_refused() {
    let pose = format!("///RCONF 0,0,0,0,0,0{REST}\nC00001={DOWN},10.0000\n");
    let of = |name: &str, robot: &str| job(name, robot, &pose, "MOVL C00001 V=100.0\n");
    let (first, second) = (of("A", "RB1"), of("B", "RB1,BS1"));
    let same = done(&[PLAIN], &[("a.jbi", &first), ("b.jbi", &second)]);
    assert_eq!(errors(&same), [""; 0], "{:?}", same.findings);
    let second = of("B", "RB2");
    let both = done(&[PLAIN], &[("a.jbi", &first), ("b.jbi", &second)]);
    assert_eq!(errors(&both), ["second-robot"; 2], "{:?}", both.findings);
    assert!(message(&both, "second-robot").contains("several robots"));
    let alone = done(&[PLAIN], &[("b.jbi", &second)]);
    assert_eq!(errors(&alone), [""; 0], "{:?}", alone.findings);
}

#[test]
fn what_is_computed_of_a_corrected_position_is_refused() {
    let positions = format!(
        "///RCONF 0,0,0,0,0,0{REST}\nC00001={DOWN},10.0000\nP00001={DOWN},15.0000\n\
         P00004=0.000,0.000,-100.000,0.0000,0.0000,0.0000\n"
    );
    let of = |line: &str, go: &str| {
        let lines = format!("MOVL P001 V=100.0\nMOVL C00001 V=100.0\n{line}\n{go}\n");
        done(&[PLAIN], &[("t.jbi", &job("T", "RB1", &positions, &lines))])
    };
    let go = "MOVL P003 V=100.0";
    for line in [
        "MULMAT P003 P001 P004",
        "SET P003 EXPRESS P001 + P004",
        "INVMAT P003 P001",
        "SET P003 P001 TL#(2)",
    ] {
        let computed = of(line, go);
        assert_eq!(
            errors(&computed),
            ["displacement-unknown"],
            "{line}: {:?}",
            computed.findings
        );
        let offset = &computed.targets[3];
        assert!(!offset.changed, "{line}: no move goes to P004");
    }
    // a copy of a step's position is that position
    let taught = of("GETPOS PX003 STEP#(3)", go);
    assert_eq!(errors(&taught), [""; 0], "{:?}", taught.findings);
    assert!(taught.findings.iter().all(|f| f.id != "computed-target"));
    let over = of("GETPOS PX003 STEP#(3)\nSETE P003 (3) 160000", go);
    assert_eq!(errors(&over), ["target-overwritten"], "{:?}", over.findings);
}

#[test]
fn condition_files_that_differ_are_refused() {
    let pose = format!("///RCONF 0,0,0,0,0,0{REST}\n///TOOL 3\nC00001={DOWN},10.0000\n");
    let text = job("T", "RB1", &pose, "MOVL C00001 V=100.0\n");
    let tool = |z: u32| {
        format!(
            "//TOOL 3\n///NAME A\n0.000,0.000,{z}.000,0.0000,0.0000,0.0000\n0.0,0.0,0.0\n0.000\n"
        )
    };
    let with = |second: u32| {
        let (a, b) = (tool(50), tool(second));
        done(
            &[PLAIN],
            &[("t.jbi", &text), ("a/TOOL.CND", &a), ("b/TOOL.CND", &b)],
        )
    };
    assert_eq!(errors(&with(50)), [""; 0], "{:?}", with(50).findings);
    assert_eq!(errors(&with(60)), ["frame-name-ambiguous"]);
}

#[test]
fn a_shift_whose_numbers_the_text_tells_is_judged_by_them() {
    let rconf = format!("///RCONF 0,0,0,0,0,0{REST}\n");
    let positions =
        format!("{rconf}C00001={DOWN},5.0000\nP00002=0.000,0.000,40.000,0.0000,0.0000,0.0000\n");
    let run = |lines: &str| done(&[PLAIN], &[("t.jbi", &job("T", "RB1", &positions, lines))]);
    let go = "MOVL C00001 V=50.0\n";
    let shifted = run(&format!("{go}SFTON P002 BF\n{go}SFTOF\n"));
    let copied = run(&format!("{go}SET LP001 C00001\n"));
    assert_eq!(errors(&shifted), [""; 0], "{:?}", shifted.findings);
    let off = misses(&shifted);
    assert_eq!((off.len(), misses(&copied).len()), (1, 0));
    // with what the job writes into it, and with what nobody knows
    let written = run(&format!(
        "{go}SETE P002 (3) 80000\nSFTON P002 BF\n{go}SFTOF\n"
    ));
    assert!(misses(&written)[0] > off[0], "{:?}", written.findings);
    let unknown = run(&format!(
        "{go}SETE P002 (3) D000\nSFTON P002 BF\n{go}SFTOF\n"
    ));
    assert_eq!(errors(&unknown), ["displacement-active"]);
}
