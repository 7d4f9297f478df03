//! Which posture is assumed where neither configuration data nor the move before tell it.

use super::{PLAIN, done, errors, message};

/// Joints 16, 12, -2, 80, 60, 20 deg.
const HOME: &str = "p[0.388198,0.263919,0.530188,-0.744695,-2.258760,-1.863143]";
/// The wrist on the other side.
const FLIPPED: &str = "[0.279,0.209,-0.035,-1.745,-1.047,-2.793]";
const OF_FLIPPED: &str = "joints 16.0, 12.0, -2.0, -100.0, -60.0, -160.0 deg";
const OF_OTHER: &str = "joints 16.0, 12.0, -2.0, 80.0, 60.0, 20.0 deg";
/// The robot stands where only the running program knows.
const AWAY: &str = "away = get_actual_tcp_pose()\nmovel(away)\n";

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
