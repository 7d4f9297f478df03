//! What something else carries or moves is refused, each with its reason: conveyors, other robots,
//! groups without geometry, a seventh joint.

use super::landing::inverse;
use super::programs::{Said, numbers_of, pose_of, written_numbers};
use super::{profile, profile_at_home, rapid, run, tool, written};
use crate::physics::external::{Rail, carried};
use crate::physics::matrix::{shift, times, turn_z};
use crate::physics::{Moment, Robot, tool_pose};
use crate::trial::truth::robot_of;
use poseshift::finding::Severity;
use poseshift::geometry::Pose;
use poseshift::model::profile::Profile;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

const ARM: &str = "{effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}";

/// The errors of some files: their ids and what they say.
fn refused(profile: &Profile, files: &[(&str, &str)]) -> (Vec<&'static str>, String) {
    let done = run(profile, files).expect("read");
    let all = done
        .findings
        .iter()
        .filter(|f| f.severity == Severity::Error);
    let mut ids: Vec<&'static str> = all.clone().map(|f| f.id).collect();
    ids.sort_unstable();
    ids.dedup();
    (ids, all.map(|f| f.message.clone() + "\n").collect())
}

/// That exactly this is found, and says this.
fn says(files: &[(&str, &str)], id: &[&str], words: &str) {
    let of_base = [".JBI", ".script"]
        .iter()
        .any(|end| files[0].0.ends_with(end));
    let robot = if of_base {
        profile_at_home(&[ARM])
    } else {
        profile("", &[ARM])
    };
    let (ids, reported) = refused(&robot, files);
    assert_eq!(ids, id, "{reported}\n{}", files[0].1);
    assert!(reported.contains(words), "{words}: {reported}");
}

#[test]
fn conveyors_are_refused_in_every_language() {
    let data = "PERS wobjdata w:=[FALSE,FALSE,\"CNV1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];";
    let body = "MoveAbsJ [[0,0,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\nActUnit CNV1;\nWaitWObj w\\RelDist:=10;\nMoveL [[640,200,700],[0,0.1,0.9949874371,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t\\WObj:=w;\nDropWObj w;\n";
    says(
        &[("t.mod", &rapid(data, body))],
        &["moving-frame"],
        "conveyor `CNV1`",
    );
    let krl = "DEF t()\n$TOOL=TOOL_DATA[1]\n$BASE=EK(MACHINE_DEF[3].ROOT,#EASYS,{X 0,Y 0,Z 0,A 0,B 0,C 0})\nPTP {A1 0,A2 0,A3 10,A4 0,A5 60,A6 0}\nPTP {X 640,Y 200,Z 700,A 10,B 5,C 170}\nEND\n";
    let (ids, reported) = refused(&profile("", &[ARM]), &[("t.src", krl)]);
    assert!(
        ids == ["moving-frame"] || ids == ["positioner-unknown"],
        "{ids:?} {reported}"
    );
    // ConveyorTech: until a base is set
    let fixed = "$BASE={X 0,Y 0,Z 0,A 0,B 0,C 0}\n";
    let conveyor = |behind: &str| {
        format!(
            "DEF t()\n$TOOL=TOOL_DATA[1]\n{fixed}PTP {{A1 0,A2 0,A3 10,A4 0,A5 60,A6 0}}\nCONV_FOLLOW(1,100)\n{behind}LIN {{X 640,Y 200,Z 700,A 10,B 5,C 170}}\nEND\n"
        )
    };
    says(
        &[("t.src", &conveyor(""))],
        &["moving-frame"],
        "since CONV_FOLLOW the base may follow a conveyor",
    );
    says(&[("t.src", &conveyor(fixed))], &[], "");
    let own = conveyor("") + "DEF CONV_FOLLOW(n:IN,m:IN)\nINT n,m\nEND\n";
    says(&[("t.src", &own)], &[], "");
    let points = "P[1]{\n   GP1:\n\tUF : 1, UT : 1,\tCONFIG : 'N U T, 0, 0, 0',\n\tX =  640.000  mm,\tY =  200.000  mm,\tZ =  700.000  mm,\n\tW =  170.000 deg,\tP =    5.000 deg,\tR =   10.000 deg\n};\n";
    let fanuc = format!(
        "/PROG  TEST\n/ATTR\nLINE_COUNT = 1;\n/APPL\n  LINE_TRACK;\n    LINE_TRACK_SCHEDULE_NUMBER      : 1;\n/MN\n   1:L P[1] 100mm/sec FINE    ;\n/POS\n{points}/END\n"
    );
    says(&[("t.ls", &fanuc)], &["moving-frame"], "conveyor");
    let job = job(
        "",
        "SYSTART CV#(1) STP=100.0\nSYMOVL C00001 V=30.0 CV#(1)\nSYEND CV#(1)\n",
    );
    says(&[("T.JBI", &job)], &["moving-frame"], "conveyor (SYMOV)");
}

/// A job with three positions: the first in joints.
fn job(groups: &str, moves: &str) -> String {
    format!(
        "/JOB\n//NAME T\n//POS\n///NPOS 3,0,0,0,0,0\n///TOOL 1\n///POSTYPE ANGLE\n///ANGLE\nC00000=0,0,10,0,60,0\n///USER 3\n///POSTYPE USER\n///RECTAN\n///RCONF 0,0,0,0,0,0,0,0\nC00001=640,200,700,170,5,10\nC00002=600,150,650,170,5,10\n//INST\n///DATE 2024/01/01 10:00\n///ATTR SC,RW\n///GROUP1 RB1\n{groups}NOP\nMOVJ C00000 VJ=5.00\n{moves}END\n"
    )
}

#[test]
fn moves_with_a_second_robot_are_refused_in_every_language_that_has_them() {
    let data = |unit: &str, fixed: &str| {
        format!(
            "PERS wobjdata w:=[FALSE,{fixed},\"{unit}\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\nPERS tasks both{{2}}:=[[\"T_ROB1\"],[\"T_ROB2\"]];\nVAR syncident s;"
        )
    };
    let body = "MoveAbsJ [[0,0,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\nSyncMoveOn s,both;\nMoveL [[640,200,700],[0,0.1,0.9949874371,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\ID:=10,v100,fine,t\\WObj:=w;\nSyncMoveOff s;\n";
    let relative = rapid(&data("ROB_2", "FALSE"), body);
    says(&[("t.mod", &relative)], &["two-robots"], "robot `ROB_2`");
    // each task for itself, in a fixed frame
    let own = rapid(&data("", "TRUE"), body);
    says(&[("t.mod", &own)], &[], "");
    // RoboTeam: on what another robot carries, and waiting for it in a frame of one's own
    let krl = |base: &str, with: &str| {
        format!(
            "DEF t()\n$TOOL=TOOL_DATA[1]\n{base}\nPTP {{A1 0,A2 0,A3 10,A4 0,A5 60,A6 0}}\nSLIN {{X 640,Y 200,Z 700,A 10,B 5,C 170}}{with}\nEND\n"
        )
    };
    let linked = krl(
        "$BASE=LK(MACHINE_DEF[2].ROOT,MACHINE_DEF[2].MECH_TYPE,BASE_DATA[3])",
        "",
    );
    says(
        &[("t.src", &linked)],
        &["two-robots"],
        "another robot carries the base (LK)",
    );
    let waits = krl(
        "$BASE={X 0,Y 0,Z 0,A 0,B 0,C 0}",
        " WITH $SYNC_ID[]=\"AutoSync\", $SYNC_LIST='B0011'",
    );
    says(&[("t.src", &waits)], &[], "");
    for (moves, words) in [
        ("MOVL C00001 V=30.0 +MOVL C00002\n", "second robot"),
        ("SMOVL C00001 V=30.0 +MOVL C00002\n", "SMOV"),
    ] {
        let job = job("///GROUP2 RB2\n", moves);
        let (ids, reported) = refused(&profile("", &[ARM]), &[("T.JBI", &job)]);
        assert!(
            !ids.is_empty() && reported.contains(words),
            "{ids:?} {reported}"
        );
    }
}

#[test]
fn moves_coordinated_with_a_group_without_geometry_are_refused() {
    let listing = |group: &str, line: &str| {
        let joints = "P[1]{\n   GP1:\n\tUF : 1, UT : 1,\t\n\tJ1= 0 deg,\tJ2= 0 deg,\tJ3= 10 deg,\tJ4= 0 deg,\tJ5= 60 deg,\tJ6= 0 deg\n};\n";
        let point = format!(
            "P[2]{{\n   GP1:\n\tUF : 1, UT : 1,\tCONFIG : 'N U T, 0, 0, 0',\n\tX =  640.000  mm,\tY =  200.000  mm,\tZ =  700.000  mm,\n\tW =  170.000 deg,\tP =    5.000 deg,\tR =   10.000 deg{group}\n}};\n"
        );
        format!(
            "/PROG  TEST\n/ATTR\nLINE_COUNT = 2;\n/MN\n   1:J P[1] 10% FINE    ;\n   2:{line}    ;\n/POS\n{joints}{point}/END\n"
        )
    };
    let plain = "L P[2] 100mm/sec FINE";
    let turned = "\n   GP2:\n\tUF : 1, UT : 1,\t\n\tJ1= 30.000 deg";
    let cartesian = "\n   GP2:\n\tUF : 1, UT : 1,\tCONFIG : 'N U T, 0, 0, 0',\n\tX =  1.000  mm,\tY =  2.000  mm,\tZ =  3.000  mm,\n\tW =  0.000 deg,\tP =    0.000 deg,\tR =   0.000 deg";
    // a user frame that stands still feels nothing of other groups, gripping or robots
    for group in [turned, cartesian] {
        let text = listing(group, plain);
        says(&[("t.ls", &text)], &[], "");
        let text = listing(group, "L P[2] 100mm/sec FINE COORD");
        says(
            &[("t.ls", &text)],
            &["group-without-geometry"],
            "coordinated with a positioner (COORD)",
        );
    }
}

#[test]
fn the_seventh_joint_of_an_arm_is_no_external_axis() {
    let body = "MoveAbsJ [[0,0,10,0,60,0],[0,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\nMoveL [[640,200,700],[0,0.1,0.9949874371,0],[0,0,0,1010],[-101.9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n";
    let text = rapid("", body);
    says(&[("t.mod", &text)], &["seven-axis-arm"], "seventh joint");
}

/// A program of an arm on a rail with the configuration data of the controller, whose cell has the
/// rail along `direction` and the base rotated by `yaw_deg` more than the profile's: at places of the
/// rail between two.
fn configured(direction: f64, yaw_deg: f64, [low_m, high_m]: [f64; 2]) -> String {
    let plain = profile("", &[]);
    let mut random = StdRng::seed_from_u64(4);
    let rail = Rail {
        direction: [0.6 * direction, 0.8 * direction, 0.0],
        up: [0.0, 0.0, 1.0],
        zero: 1.5,
        low: 0.0,
        high: 3.0,
        faults: Vec::new(),
    };
    let mut robot = robot_of(&plain, &tool());
    let place: [f64; 3] = std::array::from_fn(|i| robot.base[i][3]);
    robot.base = times(
        &times(&shift(place), &turn_z(yaw_deg.to_radians())),
        &times(&shift(place.map(|x| -x)), &robot.base),
    );
    let mut body = String::new();
    for _ in 0..12 {
        let q: [f64; 6] = [
            [-150.0, 150.0],
            [-20.0, 40.0],
            [-20.0, 30.0],
            [-80.0, 80.0],
            [20.0, 90.0],
            [-170.0, 170.0],
        ]
        .map(|[low, high]| random.random_range(low..high));
        let e = random.random_range(low_m..high_m);
        let at = Robot {
            base: carried(&rail, &robot.base, e, 1.0),
            ..robot.clone()
        };
        let rad = q.map(f64::to_radians);
        let pose = tool_pose(&at, &[], &rad, &Moment::default());
        let n = numbers_of(Said::Rapid, &pose);
        // quarters of a revolution; the arm stands forward, elbow up, wrist down
        let [cf1, _, _, cf4, _, cf6] = q.map(|q| (q / 90.0).floor());
        let list = |n: &[f64]| {
            n.iter()
                .map(|x| format!("{x:.6}"))
                .collect::<Vec<_>>()
                .join(",")
        };
        body += &format!(
            "MoveJ [[{}],[{}],[{cf1},{cf4},{cf6},0],[{:.4},9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n",
            list(&n[..3]),
            list(&n[3..]),
            1e3 * e
        );
    }
    format!("MODULE t\nPROC main()\nConfJ\\On;\n{body}ENDPROC\nENDMODULE\n")
}

#[test]
fn a_rail_that_contradicts_the_configuration_data_is_reported() {
    let track = "external_axes:\n  track:\n    - {axis: eax_a, direction: [0.6, 0.8, 0.0], up: [0, 0, 1], zero_mm: 1500, min_mm: 0, max_mm: 3000}\n";
    let of = |text: &str| {
        let done = run(&profile(track, &[ARM]), &[("t.mod", text)]);
        done.map(|done| {
            let found = done.findings.iter();
            let said = found.filter(|f| f.id == "external-axis-direction");
            said.map(|f| f.message.clone()).collect::<Vec<_>>()
        })
    };
    let near = [1.2, 1.8];
    // as it is
    let said = of(&configured(1.0, 0.0, near)).expect("read");
    assert!(said.is_empty(), "{said:?}");
    for (direction, yaw_deg, words) in [
        (-1.0, 0.0, "eax_a in the opposite direction 12 are"),
        (1.0, 180.0, "the base rotated by 180 deg about z 12 are"),
        (1.0, 90.0, "the base rotated by 90 deg about z 12 are"),
    ] {
        let said = of(&configured(direction, yaw_deg, near)).expect("some are within reach");
        assert!(
            said.len() == 1 && said[0].ends_with(words),
            "{direction} {yaw_deg}: {said:?}"
        );
    }
    // metres from where the rail is zero nothing is within reach the other way round
    let error = of(&configured(-1.0, 0.0, [2.6, 3.0])).expect_err("nothing is within reach");
    let said = error.to_string();
    assert!(
        said.contains("none of the 12 targets") && said.contains("eax_a in the opposite direction"),
        "{said}"
    );
}

#[test]
fn a_base_elsewhere_is_refused_where_the_controller_counts_from_its_own() {
    let script = "def t():\nset_tcp(p[0,0,0.1,0,0,0])\nmovej([0,0,0.1,0,1,0])\n\
        movel(p[0.4,0.1,0.3,0,3.1,0])\nend\n";
    let job = "/JOB\n//NAME T\n//POS\n///NPOS 1,0,0,0,0,0\n///TOOL 1\n///POSTYPE BASE\n///RECTAN\n\
        ///RCONF 0,0,0,0,0,0,0,0\nC00000=400,100,300,170,5,10\n//INST\n///DATE 2024/01/01 10:00\n\
        ///ATTR SC,RW\n///GROUP1 RB1\nNOP\nMOVJ C00000 VJ=5.00\nEND\n";
    let is_refused = |base: Pose, name: &str, text: &str| {
        let robot = Profile {
            world_from_base: base,
            ..profile("", &[ARM])
        };
        let done = run(&robot, &[(name, text)]).expect("read");
        done.findings
            .iter()
            .any(|f| f.id == "base-not-of-controller")
    };
    let at = |x, y, z, rz_deg: f64| Pose::from_xyz_rxryrz([x, y, z, 0.0, 0.0, rz_deg.to_radians()]);
    for (base, of_script, of_job) in [
        (at(0.0, 0.0, 0.0, 0.0), false, false),
        // INFORM counts from the height of axis 2
        (at(0.0, 0.0, -0.29, 0.0), true, false),
        (at(0.001, 0.0, 0.0, 0.0), true, true),
        (at(0.0, 0.0, 0.0, 0.5), true, true),
    ] {
        assert_eq!(is_refused(base, "t.script", script), of_script, "{base:?}");
        assert_eq!(is_refused(base, "T.JBI", job), of_job, "{base:?}");
    }
}

#[test]
fn robot_coordinates_of_inform_stand_where_the_base_does_and_ride_on_the_rail() {
    let external = "external_axes:\n  track: [{axis: BC1, direction: [0.6, 0.8, 0], min_mm: 0, \
        max_mm: 2000}]\n";
    let robot = profile(external, &[ARM, "{effect: base_frame, x_mm: 1}"]);
    let truth = robot_of(&robot, &tool());
    let rail = Rail {
        direction: [0.6, 0.8, 0.0],
        up: [0.0, 0.0, 1.0],
        zero: 0.0,
        low: 0.0,
        high: 2.0,
        faults: Vec::new(),
    };
    let q_deg = [30.0, 20.0, -10.0, 15.0, 60.0, 20.0];
    let base = carried(&rail, &truth.base, 0.5, 1.0);
    let there = Robot {
        base,
        ..truth.clone()
    };
    let place = tool_pose(&there, &[], &q_deg.map(f64::to_radians), &Moment::default());
    let fake = |system: &str, pose: &[[f64; 4]; 4]| {
        let numbers = numbers_of(Said::Inform, pose);
        let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:.5}")).collect();
        let numbers = numbers.join(",");
        let job = format!(
            "/JOB\n//NAME T\n//POS\n///NPOS 2,2,0,0,0,0\n///TOOL 1\n///POSTYPE ANGLE\n///ANGLE\n\
             C00000=30,20,-10,15,60,20\nBC00000=500\n///TOOL 1\n///POSTYPE {system}\n///RECTAN\n\
             ///RCONF 0,0,0,0,0,0,0,0\nC00001={numbers}\nBC00001=500\n//INST\n///DATE \
             2024/01/01 10:00\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\nMOVJ C00000 BC00000 VJ=5.00\n\
             MOVL C00001 BC00001 V=30.0\nEND\n"
        );
        let text = written(&robot, &[("T.JBI", &job)]);
        pose_of(Said::Inform, &written_numbers(Said::Inform, &text)[0])
    };
    let in_base = fake("BASE", &place);
    let in_robot = times(&base, &fake("ROBOT", &times(&inverse(&base), &place)));
    let moved = [0, 1, 2].map(|i: usize| (in_base[i][3] - place[i][3]).abs());
    assert!(moved.iter().sum::<f64>() > 1e-3, "{moved:?}");
    for i in 0..3 {
        for j in 0..4 {
            let apart = (in_base[i][j] - in_robot[i][j]).abs();
            assert!(apart < 5e-6, "{i} {j}: {apart}");
        }
    }
}

#[test]
fn what_a_relative_move_of_krl_adds_goes_onto_a_value_that_was_kept() {
    let external = "external_axes:\n  track: [{axis: E1, direction: [1, 0, 0], min_mm: 0, max_mm: \
        3000}]\n";
    let robot = profile(
        external,
        &[ARM, "{effect: track_scale, axis: 1, ratio: 0.001}"],
    );
    let rail = Rail {
        direction: [1.0, 0.0, 0.0],
        up: [0.0, 0.0, 1.0],
        zero: 0.0,
        low: 0.0,
        high: 3.0,
        faults: Vec::new(),
    };
    let truth = robot_of(&robot, &tool());
    let there = Robot {
        base: carried(&rail, &truth.base, 0.15, 1.0),
        ..truth
    };
    let q_deg = [0.0, 10.0, -10.0, 0.0, 60.0, 0.0];
    let pose = tool_pose(&there, &[], &q_deg.map(f64::to_radians), &Moment::default());
    let n = numbers_of(Said::Krl, &pose);
    let target = |x: f64| {
        let along = n[0] + x;
        format!(
            "X {along:.4},Y {:.4},Z {:.4},A {:.5},B {:.5},C {:.5}",
            n[1], n[2], n[3], n[4], n[5]
        )
    };
    let text = |kept: &str, last: &str| {
        format!(
            "DEF t()\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\nPTP {{A1 0,A2 10,A3 -10,A4 0,A5 60,A6 0,E1 \
             150}}\nLIN {{{}{kept}}}\nLIN_REL {{X 10,E1 10}}\nLIN_REL {{X 10,E1 10}}\nLIN \
             {{{}{last}}}\nEND\n",
            target(0.0),
            target(40.0)
        )
    };
    let first = |done: &str| -> Vec<String> {
        let lines = done.lines().filter(|line| line.starts_with("LIN {X"));
        lines
            .map(|line| line.split(",E1").next().expect("numbers").replace('}', ""))
            .collect()
    };
    let kept = written(&robot, &[("t.src", &text("", ""))]);
    let said = written(&robot, &[("t.src", &text(",E1 150", ",E1 170"))]);
    let other = written(&robot, &[("t.src", &text(",E1 150", ",E1 160"))]);
    assert_eq!(first(&kept), first(&said));
    assert_ne!(first(&kept), first(&other));
}
