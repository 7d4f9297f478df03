//! Which posture is assumed where neither configuration data nor the move before tell it.

use super::{PLAIN, done, errors, message, rapid};

/// Joints 16, 12, -2, 80, 60, 20 deg.
const HOME: &str = "p[0.388198,0.263919,0.530188,-0.744695,-2.258760,-1.863143]";
/// The wrist on the other side.
const FLIPPED: &str = "[0.279,0.209,-0.035,-1.745,-1.047,-2.793]";
const OF_FLIPPED: &str = "joints 16.0, 12.0, -2.0, -100.0, -60.0, -160.0 deg";
const OF_OTHER: &str = "joints 16.0, 12.0, -2.0, 80.0, 60.0, 20.0 deg";
/// The robot stands where only the running program knows.
const AWAY: &str = "away = get_actual_tcp_pose()\naway[2] = x\nmovel(away)\n";

fn assumed(body: &str) -> String {
    let text = format!("def t():\nset_tcp(p[0,0,0.1,0,0,0])\n{body}end\nt()\n");
    let done = done(&[PLAIN], &[("t.script", &text)]);
    assert_eq!(errors(&done), [""; 0], "{body}: {:?}", done.findings);
    message(&done, "posture-assumed").to_owned()
}

#[test]
fn a_later_move_to_the_target_names_it() {
    let later = format!("movej(get_inverse_kin(home_p, qnear={FLIPPED}))\n");
    let found = assumed(&format!("home_p = {HOME}\nmovel(home_p)\n{later}"));
    assert!(found.contains(OF_FLIPPED), "{found}");
}

#[test]
fn the_joints_at_which_a_waypoint_was_taught_name_it() {
    for (joints, expected) in [
        ("", OF_OTHER),
        (
            "home_q = [0.279,0.209,-0.035,-1.745,-1.047,-2.793]\n",
            OF_FLIPPED,
        ),
        // of another waypoint
        (
            "rome_q = [0.279,0.209,-0.035,-1.745,-1.047,-2.793]\n",
            OF_OTHER,
        ),
        // changed
        (
            "home_q = [0.279,0.209,-0.035,-1.745,-1.047,-2.793]\nhome_q[5] = x\n",
            OF_OTHER,
        ),
    ] {
        let found = assumed(&format!("home_p = {HOME}\n{joints}movel(home_p)\n"));
        assert!(found.contains(expected), "{joints}: {found}");
    }
}

#[test]
fn behind_a_position_that_nobody_knows_the_robot_goes_on_as_it_stood() {
    for (joints, expected) in [
        ("[0.279,0.209,-0.035,1.396,1.047,0.349]", OF_OTHER),
        (FLIPPED, OF_FLIPPED),
    ] {
        let found = assumed(&format!("movej({joints})\n{AWAY}{AWAY}movej({HOME})\n"));
        assert!(found.contains(expected), "{joints}: {found}");
    }
}

/// What is said of postures in a RAPID program that begins in these joints.
fn postures(q4_q5: &str, body: &str) -> usize {
    // of joints 5, 15, 10, -82, 35, 20 deg; `other` has the data of the flipped wrist
    let pose = "[[426.1436,-3.7691,456.4762],[0.29947917,-0.32294611,0.77780059,-0.4483796]";
    let target = |name: &str, cf: &str| {
        format!("CONST robtarget {name} := {pose},{cf},[9E9,9E9,9E9,9E9,9E9,9E9]];\n")
    };
    let data = target("p", "[0,-1,0,0]") + &target("other", "[0,1,-2,0]") + "VAR jointtarget j;";
    let start =
        format!("MoveAbsJ [[4,20,0,{q4_q5},20],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;");
    let text = rapid(&data, &format!("{start}\n{body}"));
    let done = done(&[PLAIN], &[("t.mod", &text)]);
    assert_eq!(errors(&done), [""; 0], "{body}: {:?}", done.findings);
    let found = done.findings.iter();
    found.filter(|f| f.id == "posture-assumed").count()
}

#[test]
fn a_joint_move_by_a_step_goes_to_the_nearest_posture() {
    let step = |by: &str| {
        format!(
            "ConfJ\\Off;\nConfL\\Off;\nMoveJ RelTool(CRobT(\\Tool:=tool0\\WObj:=wobj0),0,0,0\\Ry:={by}),v100,fine,tool0;\n\
             MoveL p,v100,fine,tool0;"
        )
    };
    assert_eq!(postures("-70,8", &step("-30")), 1);
    assert_eq!(postures("-70,60", &step("-3")), 0);
}

#[test]
fn data_that_the_controller_does_not_go_by_say_nothing_behind_a_move_that_nobody_knows() {
    let away = "j:=CJointT();\nj.robax.rax_6:=j.robax.rax_6+90;\nMoveAbsJ j,v100,fine,tool0;\n";
    let body = |away: &str| format!("ConfL\\Off;\n{away}MoveL other,v100,fine,tool0;");
    assert_eq!(postures("-70,30", &body(away)), 1);
    assert_eq!(postures("-70,30", &body("")), 0);
}

#[test]
fn data_that_the_controller_does_not_go_by_name_no_rotations() {
    let fake = |cf: &str| {
        let data = format!(
            "CONST robtarget p := [[52.36174,-304.57487,304.84003],[0.36420504,0.54464963,0.65494239,\
             -0.37651287],{cf},[9E9,9E9,9E9,9E9,9E9,9E9]];"
        );
        let body = "ConfL\\Off;\nConfJ\\Off;\nMoveAbsJ [[4.45,12.44,14.6,83.6,25.4,185.4],\
            [9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ p,v100,fine,tool0;";
        let done = done(&[PLAIN], &[("t.mod", &rapid(&data, body))]);
        done.targets
            .iter()
            .find_map(|target| target.fake)
            .expect("a fake target")
    };
    let [one, other] = ["[-1,1,-1,0]", "[-1,1,1,0]"].map(fake);
    assert_eq!(one, other);
}

#[test]
fn moves_that_go_on_in_a_posture_which_the_file_does_not_give_are_named() {
    let target = |name: &str, x: f64, cf: &str| {
        format!(
            "CONST robtarget {name} := [[{x},-3.77,456.5],[0.29947917,-0.32294611,0.77780059,-0.4483796],\
             {cf},[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        )
    };
    let data = target("p", 426.0, "[2,-1,0,0]") + &target("q", 400.0, "[0,-1,0,0]");
    let body = "ConfL\\Off;\nMoveAbsJ [[4,20,0,-70,30,20],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n\
        MoveJ p,v100,fine,tool0;\nMoveL q,v100,fine,tool0;";
    let text = rapid(&data, body);
    let line = text
        .lines()
        .position(|line| line.contains("MoveL q"))
        .expect("a move")
        + 1;
    let done = done(&[PLAIN], &[("t.mod", &text)]);
    let said = message(&done, "configuration-mismatch");
    assert!(
        said.ends_with(&format!("the posture in line {line} follows from it")),
        "{said}"
    );
}

#[test]
fn a_step_goes_near_the_joints_that_it_names() {
    let corrected = |near: &str| {
        let step = "pose_trans(get_actual_tcp_pose(), p[0,0,0,-0.15,0,0])";
        let text = format!(
            "def t():\nset_tcp(p[0,0,0.1,0,0,0])\nmovej([0.279,0.209,-0.035,1.396,1.047,0.349])\n\
             movej(get_inverse_kin({step}{near}))\nmovel({HOME})\nend\nt()\n"
        );
        let wrist = "{effect: link_geometry, link: 5, theta_deg: 0.1}";
        let done = done(&[wrist], &[("t.script", &text)]);
        assert_eq!(errors(&done), [""; 0], "{near}: {:?}", done.findings);
        let mut fakes = done.targets.iter().filter_map(|target| target.fake);
        fakes.next_back().expect("a fake target")
    };
    assert_eq!(
        corrected(""),
        corrected(", qnear=[0.279,0.209,-0.035,1.396,1.047,0.349]")
    );
    assert_ne!(corrected(""), corrected(&format!(", qnear={FLIPPED}")));
}
