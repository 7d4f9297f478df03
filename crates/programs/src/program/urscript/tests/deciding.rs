//! Decisions by numbers of poses.

use super::*;
use crate::program::deciding::shown;

fn by(lines: &str) -> Vec<String> {
    shown(&path(&format!(
        "p1=p[.1,.2,.3,0,0,1]\nglobal p2=p[.1,.2,.4,0,0,1]\nmovel(p1)\nmovel(p2)\n{lines}"
    )))
}

#[test]
fn numbers_of_poses_that_moves_use_decide() {
    for (lines, expected) in [
        ("if p1[2]>=0.3:\nsync()\nend", &["p1"][..]),
        ("if pose_dist(p1,p2)>0.1:\nsync()\nend", &["p1", "p2"]),
        ("z=p1[2]\nwhile z>0.2:\nz=z-0.1\nend", &["p1>"]),
        ("d=point_dist(p1,p2)\nif d>1:\nsync()\nend", &["p1>", "p2>"]),
        (
            "local h=p2[2]*1000\nif True:\nsync()\nelif h>3:\nsync()\nend",
            &["p2>"],
        ),
        ("def f(p):\nif p[2]>1:\nsync()\nend\nend\nf(p2)", &["p2"]),
        (
            "def f():\nreturn p2[2]>1\nend\nif f():\nsync()\nend",
            &["p2>"],
        ),
    ] {
        assert_eq!(by(lines), expected, "{lines}");
    }
}

#[test]
fn what_is_followed_or_never_rewritten_decides_nothing() {
    for lines in [
        "p3=p[.1,.2,.3,0,0,2]\nif p3[2]>0.1:\nsync()\nend",
        "q=get_actual_tcp_pose()\nif q[2]>0.1:\nsync()\nend",
        "if get_standard_digital_in(0):\nmovel(pose_trans(p1,p[0,0,.1,0,0,0]))\nend",
        "q=p1\nq[2]=p1[2]+0.1\nif a:\nmovel(q)\nend",
        "# if p1[2]>0.1:\nif a:\nsync()\nend",
        "def f(p1):\nsync()\nend\nif a:\nsync()\nend",
    ] {
        assert_eq!(by(lines), [""; 0], "{lines}");
    }
}
