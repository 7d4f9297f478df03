//! Where the controller's own rules decide how it comes to a target, the correction may tip them.

use super::{errors, given, profile_of, try_with};
use poseshift::compensate::{Options, compensate};
use poseshift::geometry::units::DEG;
use poseshift::program::{Source, language_of};

/// The tool ahead of the flange, so that joint 6 moves nothing but its orientation.
const ARM: &str = "robots/abb_irb120.yaml";

/// A program with a joint move to joints, and a move of this kind to a pose.
fn rapid(joints: [f64; 6], instruction: &str, pose: &str) -> String {
    let joints = joints.map(|q| q.to_string()).join(",");
    format!(
        "MODULE t\nPROC main()\nConfJ\\Off;\nConfL\\Off;\nMoveAbsJ \
         [[{joints}],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n{instruction} \
         [{pose},[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nENDPROC\nENDMODULE\n"
    )
}

/// A pose as RAPID has it: of the nominal arm in these joints.
fn pose_at(joints: [f64; 6]) -> String {
    let profile = profile_of(ARM, &[]);
    let tool = poseshift::model::profile::Mounted::flange();
    let pose = profile.controller_model(&tool).forward(
        &joints.map(|q| q * DEG),
        &poseshift::model::Conditions::default(),
    );
    let [x, y, z] = pose.translation.map(|m| m * 1e3);
    let [w, i, j, k] = pose.rotation.quaternion().0;
    format!("[{x:.6},{y:.6},{z:.6}],[{w:.9},{i:.9},{j:.9},{k:.9}]")
}

/// What is said of a move that the correction tips and whose pose is that of the first joints; of the
/// same move to the second, which it does not, nothing is.
fn tipped(
    effect: &str,
    instruction: &str,
    from: [f64; 6],
    [to, clear]: [[f64; 6]; 2],
    refused: &[&str],
) -> String {
    // from a move to joints, and from those of `--start-joints`
    let [first, second] = [to, clear].map(pose_at);
    let as_first = |program: String| {
        let lines = program.lines().filter(|line| !line.starts_with("MoveAbsJ"));
        lines.map(|line| line.to_owned() + "\n").collect::<String>()
    };
    let start_joints = Some(from.map(|q| q * DEG));
    let found = |pose: &str, starts: bool| {
        let program = rapid(from, instruction, pose);
        let (options, program) = if starts {
            let options = Options {
                start_joints,
                ..given()
            };
            (options, as_first(program))
        } else {
            (given(), program)
        };
        let done = try_with(options, &[effect], &[("t.mod", &program)]).expect("read");
        let about = done.findings.iter().find(|f| f.id == "several-postures");
        (errors(&done), about.map(|f| f.message.clone()))
    };
    for starts in [false, true] {
        assert_eq!(found(&second, starts), (vec![], None), "{starts}");
        assert_eq!(found(&first, starts).0, refused, "{starts}");
    }
    let [said, at_start] = [false, true].map(|starts| found(&first, starts).1.expect("a finding"));
    assert_eq!(said, at_start);
    said
}

#[test]
fn a_joint_move_that_the_correction_takes_past_half_a_rotation_is_reported_whatever_the_file_says()
{
    let to = [179.97, 170.0].map(|q6| [10.0, 10.0, 5.0, 5.0, 50.0, q6]);
    let effect = "{effect: link_geometry, link: 6, theta_deg: -0.1}";
    let said = tipped(effect, "MoveJ", [0.0, 0.0, 0.0, 0.0, 60.0, 0.0], to, &[]);
    assert!(
        said.contains("joint 6") && said.contains("-179.9"),
        "{said}"
    );
}

#[test]
fn a_joint_move_to_which_another_posture_is_nearer_with_the_correction_is_reported() {
    // the other posture turns joints 4 and 6 by half a rotation less: 92.0 deg there
    let to = [91.85, 80.0].map(|q4| [1.0, 17.0, 11.0, q4, 25.0, 88.0]);
    let effect = "{effect: link_geometry, link: 4, theta_deg: -0.3}";
    let said = tipped(effect, "MoveJ", [0.0, 15.0, 10.0, 0.0, 3.0, 0.0], to, &[]);
    assert!(said.contains("another posture is nearer"), "{said}");
}

#[test]
fn a_path_that_the_correction_takes_the_other_way_round_is_refused() {
    let from = [0.0, 15.0, 10.0, 0.0, 60.0, -85.0];
    let to = [94.97, 85.0].map(|q6| [0.0, 15.0, 10.0, 0.0, 60.0, q6]);
    let effect = "{effect: joint_scale, joint: 6, ratio: -5.0e-4}";
    let said = tipped(effect, "MoveL", from, to, &["several-postures"]);
    assert!(
        said.contains("another way") && said.contains("95.0"),
        "{said}"
    );
}

/// Of a straight move between two postures: the joints at its end, and what is said of others.
fn passed([from, to]: [[f64; 6]; 2], data: &str) -> ([f64; 6], Option<String>) {
    let text = rapid(from, "MoveL", &pose_at(to)).replace("[0,0,0,0]", data);
    let text = match data {
        "[0,0,0,0]" => text,
        _ => text.replace("ConfL\\Off;\n", ""),
    };
    let effect = "{effect: link_geometry, link: 3, theta_deg: 0.01}";
    let done = try_with(given(), &[effect], &[("t.mod", &text)]).expect("read");
    assert_eq!(errors(&done), Vec::<&str>::new(), "{:?}", done.findings);
    let about = done.findings.iter().find(|f| f.id == "several-postures");
    let q = done
        .targets
        .last()
        .and_then(|target| target.q)
        .expect("solved");
    (q.map(|q| q / DEG), about.map(|f| f.message.clone()))
}

#[test]
fn a_path_that_passes_the_singularity_of_the_wrist_says_which_posture_is_taken() {
    let arm = |q4: f64, q5: f64, q6: f64| [10.0, 15.0, 10.0, q4, q5, q6];
    // the sine of the distance is that of joint 5 times that of what joint 4 stands off the
    // shortest path over the singularity
    let ends = |distance: f64, aside: f64| {
        let q5 = (distance.to_radians().sin() / aside.to_radians().sin()).asin() / DEG;
        let sweep = 180.0 - 2.0 * aside;
        [arm(aside - 90.0, q5, 0.0), arm(90.0 - aside, q5, -sweep)]
    };
    let none = "[0,0,0,0]";
    // so far off nothing else is meant
    for (distance, aside) in [(3.0, 40.0), (1.2, 8.0)] {
        let (q, said) = passed(ends(distance, aside), none);
        assert!(
            q[4] > 2.0 && q[3] > 45.0 && said.is_none(),
            "{q:?} {said:?}"
        );
    }
    for (distance, aside) in [(0.6, 8.0), (0.7, 4.0), (0.9, 40.0)] {
        let (q, said) = passed(ends(distance, aside), none);
        let said = said.expect("a finding");
        assert!(q[4] > 0.5 && q[3] > 45.0, "{distance}: {q:?}");
        assert!(
            said.contains(&format!("by {distance:.1} deg")) && said.contains("taken to sweep"),
            "{said}"
        );
    }
    let (q, said) = passed(ends(0.3, 8.0), none);
    let said = said.expect("a finding");
    assert!(q[4] < -0.2 && q[3] < -90.0, "{q:?}");
    assert!(
        said.contains("by 0.3 deg") && said.contains("taken to go through"),
        "{said}"
    );
    // through the middle there is no other, wherever the samples of the path fall
    for (from, to) in [(15.0, -10.0), (4.0, -20.0), (50.0, -1.0)] {
        let near = |q5: f64| [10.0, 15.0, 10.0, 20.0, q5, 30.0];
        for (from, to) in [(from, to), (to, from)] {
            let (q, said) = passed([near(from), near(to)], none);
            assert!(
                (q[4] - to).abs() < 0.2 && said.is_none(),
                "{from} {to}: {q:?} {said:?}"
            );
        }
    }
    let (q, said) = passed([arm(20.0, 4.0, 0.0), arm(20.0, -4.0, 0.0)], none);
    assert!(q[4] < -3.9 && said.is_none(), "{q:?} {said:?}");
    // a path that ends, or begins, there does not pass it
    for (from, to) in [(20.0, 0.0), (2.0, 0.0), (0.0, 20.0), (0.0, -3.0)] {
        let near = |q5: f64| [10.0, 15.0, 10.0, 20.0, q5, 30.0];
        let (q, said) = passed([near(from), near(to)], none);
        assert!(
            (q[4] - to).abs() < 0.2 && said.is_none(),
            "{from} {to}: {q:?} {said:?}"
        );
    }
    // where the data are gone by, they say
    let (q, said) = passed(ends(0.8, 8.0), "[0,0,-2,0]");
    assert!(q[4] > 0.5 && said.is_none(), "{q:?} {said:?}");
}

#[test]
fn a_path_that_ends_nearer_to_the_singularity_of_the_wrist_than_it_passes_it_passes_it() {
    // it passes by 0.261 deg and ends at 0.233 deg, on the other side
    let text = "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nPTP {A1 41.42485,A2 -23.93208,A3 -47.34124,A4 \
        -90.55770,A5 -10.14360,A6 35.14089}\nLIN {X 23.8919018,Y 18.7130341,Z 913.6101353,A \
        -16.975914116,B 16.287426204,C -21.890734337}\nEND\n";
    let effect = "{effect: link_geometry, link: 3, theta_deg: 0.01}";
    let done = try_with(given(), &[effect], &[("t.src", text)]).expect("read");
    assert_eq!(errors(&done), Vec::<&str>::new(), "{:?}", done.findings);
    let q = done.targets[1].q.expect("solved").map(|q| q / DEG);
    assert!((q[3] + 90.6).abs() < 1.0 && q[4] > 0.1, "{q:?}");
    let said = done.findings.iter().find(|f| f.id == "several-postures");
    let said = &said.expect("a finding").message;
    assert!(said.contains("by 0.3 deg"), "{said}");
}

#[test]
fn a_coupled_joint_comes_from_the_side_of_the_angle_that_turns_it() {
    let fanuc = "robots/fanuc_lrmate200ic.yaml";
    // J3 falls on the pendant and rises with J2
    let program = "/PROG T\n/MN\n   1:J P[1] 10% FINE ;\n   2:J P[2] 10% FINE ;\n   3:J P[3] 10% FINE \
                   ;\n/POS\n\
                   P[1]{\n   GP1:\n    UF : 0, UT : 1,\n    J1 = 0.000 deg, J2 = 0.000 deg, J3 = 0.000 \
                   deg,\n    J4 = 0.000 deg, J5 = -50.000 deg, J6 = 0.000 deg\n};\n\
                   P[2]{\n   GP1:\n    UF : 0, UT : 1,\n    J1 = 0.000 deg, J2 = 20.000 deg, J3 = -5.000 \
                   deg,\n    J4 = 0.000 deg, J5 = -50.000 deg, J6 = 0.000 deg\n};\n\
                   P[3]{\n   GP1:\n    UF : 0, UT : 1,\n    J1 = 0.000 deg, J2 = 40.000 deg, J3 = \
                   -15.000 deg,\n    J4 = 0.000 deg, J5 = -50.000 deg, J6 = 0.000 deg\n};\n/END\n";
    let width_deg = 0.06;
    let effect = format!("{{effect: backlash, joint: 3, width_deg: {width_deg}}}");
    let options = Options {
        correct_joint_targets: true,
        ..given()
    };
    let sources = [Source::new("t.ls", program.as_bytes().to_vec())];
    let language = language_of(&sources[0]).expect("FANUC");
    let done =
        compensate(language, &sources, &profile_of(fanuc, &[&effect]), &options).expect("read");
    assert!(!done.is_refused(), "{:?}", done.findings);
    // whoever comes from below stands half the width too far up
    let q = done.targets[2].q.expect("joints");
    let off = q[2] / DEG + 15.0 + 0.5 * width_deg;
    assert!(off.abs() < 1e-6, "{off}");
}

#[test]
fn the_first_move_comes_from_where_start_joints_say_with_the_numbers_that_are_written() {
    let effect = ["{effect: backlash, joint: 2, width_deg: 0.2}"];
    let options = |q2: f64| Options {
        start_joints: Some([0.0, q2, 10.0, 0.0, 60.0, 0.0].map(|q| q * DEG)),
        ..given()
    };
    let to = pose_at([0.0, 15.0, 10.0, 0.0, 60.0, 0.0]);
    let body = format!(
        "MODULE t\nPROC main()\nConfJ\\Off;\nMoveJ \
         [{to},[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nENDPROC\nENDMODULE\n"
    );
    let shift_deg = |q2: f64| {
        let done = try_with(options(q2), &effect, &[("t.mod", &body)]).expect("read");
        assert_eq!(errors(&done), [""; 0]);
        done.targets[0].q.expect("joints")[1] / DEG - 15.0
    };
    // from 14.95 the nominal 15 lies above, and the numbers for that, 14.9, below
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a} {b}");
    close(shift_deg(10.0), -0.1);
    close(shift_deg(20.0), 0.1);
    close(shift_deg(14.85), -0.1);
    close(shift_deg(15.15), 0.1);
}

#[test]
fn a_path_that_winds_a_joint_beyond_its_limit_says_so() {
    let arm = |q6: f64| [10.0, 15.0, 10.0, 20.0, 40.0, q6];
    let beyond = |to: f64| {
        let program = rapid(arm(385.0), "MoveL", &pose_at(arm(to)));
        let effect = "{effect: link_geometry, link: 3, theta_deg: 0.01}";
        let done = try_with(given(), &[effect], &[("t.mod", &program)]).expect("read");
        assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
        let q = done.targets.last().and_then(|target| target.q);
        let said = done.findings.iter().find(|f| f.id == "beyond-limit");
        (
            q.expect("solved")[5] / DEG,
            said.map(|f| (f.message.clone(), f.line)),
        )
    };
    // joint 6 goes to 400 degrees
    let (q6, said) = beyond(395.0);
    assert!((q6 - 395.0).abs() < 0.1 && said.is_none(), "{q6} {said:?}");
    let (q6, said) = beyond(420.0);
    let (message, line) = said.expect("a finding");
    assert!((q6 - 60.0).abs() < 0.1, "{q6}");
    assert!(
        message.contains("turns joint 6 to 420.0 deg") && message.contains("-400.0 to 400.0"),
        "{message}"
    );
    assert_eq!(line, 6);
}

#[test]
fn a_path_through_the_singularity_of_the_wrist_says_so() {
    // in the plane of the arm: joint 5 goes through zero
    let straight = |q5: f64| [0.0, 10.0, 5.0, 0.0, q5, 0.0];
    let found = |from: f64, to: f64| {
        let text = rapid(straight(from), "MoveL", &pose_at(straight(to)));
        let effect = "{effect: link_geometry, link: 3, theta_deg: 0.01}";
        let done = try_with(given(), &[effect], &[("t.mod", &text)]).expect("read");
        assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
        let said = |f: &&poseshift::finding::Finding| f.message.contains("goes through the sing");
        done.findings.iter().find(said).map(|f| (f.id, f.line))
    };
    assert_eq!(found(10.0, -8.0), Some(("near-singularity", 6)));
    assert_eq!(found(10.0, 4.0), None);
}

#[test]
fn at_a_singularity_configuration_data_of_both_sides_hold() {
    // all joints at zero; joint 5 comes from either side
    let zero = "[374,0,630],[0.7071067811865476,0,0.7071067811865476,0]";
    for from in [20.0, -20.0] {
        let text = rapid([0.0, 0.0, 0.0, 0.0, from, 0.0], "MoveL", zero);
        let text = text.replace("ConfL\\Off;\n", "");
        let effect = "{effect: link_geometry, link: 3, theta_deg: 0.01}";
        let done = try_with(given(), &[effect], &[("t.mod", &text)]).expect("read");
        let id = "configuration-mismatch";
        let mismatch = done.findings.iter().find(|f| f.id == id);
        assert!(mismatch.is_none(), "{mismatch:?}");
    }
}
