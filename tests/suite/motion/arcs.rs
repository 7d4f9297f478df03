//! The point in the middle of an arc: the robot passes it in the rotation of the path, whatever
//! orientation is written for it.

use super::{PLAIN, done, errors, fakes, given, message, profile, rapid, try_with};
use poseshift::compensate::{Compensation, Options};
use poseshift::finding::Severity;
use poseshift::geometry::{Pose, Rotation, add, cross, dot, norm, scale, sub};
use poseshift::inverse::Arm;
use poseshift::model::Conditions;
use poseshift::model::profile::Mounted;
use poseshift::program::Shape;

const EXTERNAL: &str = "[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
const HOME: &str = "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;";

/// An arc whose middle is written with an orientation.
fn rapid_arc(middle: &str) -> String {
    rapid(
        &format!("CONST robtarget m := [[400,60,420],{middle},{EXTERNAL};"),
        &format!(
            "{HOME}\nMoveL [[430,0,400],[0,0,1,0],{EXTERNAL},v100,fine,tool0;\nMoveC \
             m,[[370,0,440],[0,0,1,0],{EXTERNAL},v100,fine,tool0;"
        ),
    )
}

fn urscript_arc(middle: &str) -> String {
    let down = "0.0,3.1415927,0.0";
    format!(
        "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  movej([0,0,0,0,1.047,0])\n  \
         movel(p[0.43,0.0,0.4,{down}])\n  movec(p[0.40,0.06,0.42,{middle}],p[0.37,0.0,0.44,{down}])\nend\n"
    )
}

fn krl_arc(middle: &str) -> String {
    format!(
        "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nPTP {{A1 0,A2 0,A3 0,A4 0,A5 60,A6 0}}\nLIN {{X \
         430,Y 0,Z 400,A 0,B 180,C 0}}\nCIRC {{X 400,Y 60,Z 420,{middle}}},{{X 370,Y 0,Z 440,A 0,B \
         180,C 0}}\nEND\n"
    )
}

/// The fake target of the arc's middle: the second pose.
fn middle(done: &Compensation) -> Pose {
    let is_pose = |at: &usize| done.program.targets[*at].layout.shape == Shape::Pose;
    let mut poses = (0..done.targets.len()).filter(is_pose).collect::<Vec<_>>();
    poses.sort_by_key(|at| {
        let numbers = done.program.numbers_of(&done.program.targets[*at]);
        // only the middle is off the plane y = 0
        u8::from(numbers.iter().any(|n| n.value == 60.0 || n.value == 0.06))
    });
    let found = *poses.last().expect("poses");
    done.targets[found].fake.expect("a fake target")
}

#[test]
fn the_middle_of_an_arc_is_corrected_in_the_rotation_of_the_path() {
    for (name, along, other) in [
        (
            "t.mod",
            rapid_arc("[0,0,1,0]"),
            rapid_arc("[0.3420201433,0,0.9396926208,0]"),
        ),
        // a posture that the arm never has there: the flange upwards
        ("t.mod", rapid_arc("[0,0,1,0]"), rapid_arc("[1,0,0,0]")),
        (
            "t.script",
            urscript_arc("0.0,3.1415927,0.0"),
            urscript_arc("0,0,0"),
        ),
        ("t.src", krl_arc("A 0,B 180,C 0"), krl_arc("A 40,B 150,C 0")),
    ] {
        let [along, other] = [&along, &other].map(|text| done(&[PLAIN], &[(name, text)]));
        assert_eq!(errors(&along), [""; 0], "{name} {:?}", along.findings);
        assert_eq!(errors(&other), [""; 0], "{name} {:?}", other.findings);
        let (meant, found) = (middle(&along), middle(&other));
        let apart = sub(meant.translation, found.translation);
        let apart = apart.iter().fold(0.0_f64, |most, by| most.max(by.abs()));
        assert!(apart < 1e-7, "{name}: {apart} m");
        // the orientation that nobody looks at takes the same small correction along
        let [by, same] = [(&other, found), (&along, meant)].map(|(done, fake)| {
            let corrected = done.targets.iter().map(|report| report.shift.angle_rad);
            assert!(corrected.fold(0.0, f64::max) < 0.01, "{name}");
            fake.rotation
        });
        let rotated = (by * same.transpose()).angle();
        assert!(rotated > 0.1, "{name}: {rotated}");
    }
}

#[test]
fn the_posture_at_a_middle_is_that_of_the_arc() {
    // joint 5 does not come near zero on the arc; on the line to the middle it does
    let text = "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nPTP {A1 54.01680,A2 19.15640,A3 -21.22010,A4 \
        -80.50520,A5 -8.97790,A6 32.65710}\nCIRC {X 104.2547596,Y 471.6933625,Z 575.4539096,A -16.981665589,B \
        31.569130469,C -96.272575686},{X 197.3878693,Y 472.9838764,Z 505.6393018,A -39.003123716,B \
        36.824159438,C -108.460789838}\nEND\n";
    let done = done(&[PLAIN], &[("t.src", text)]);
    assert_eq!(errors(&done), Vec::<&str>::new());
    let postures = done.findings.iter().filter(|f| f.id == "several-postures");
    assert_eq!(postures.count(), 0, "{:?}", done.findings);
    for target in &done.targets[1..] {
        let q = target.q.expect("solved");
        assert!(q[4] < -0.1, "{q:?}");
    }
}

#[test]
fn a_middle_that_is_a_target_too_is_judged_for_both() {
    let text = rapid_arc("[0.3420201433,0,0.9396926208,0]");
    let there = "tool0;\nENDPROC";
    let both = text.replace(there, "tool0;\nMoveL m,v100,fine,tool0;\nENDPROC");
    assert_ne!(both, text);
    let with = |limit_m: f64| {
        let options = Options {
            max_derived_error_m: Some(limit_m),
            ..given()
        };
        try_with(options, &[PLAIN], &[("t.mod", &both)]).expect("read")
    };
    let found = with(1e-6);
    assert_eq!(errors(&found), ["target-shared"], "{:?}", found.findings);
    // what the arc misses is reported, and the straight move hits
    let found = with(1e-3);
    assert_eq!(errors(&found), [""; 0], "{:?}", found.findings);
    let off = message(&found, "arc-shared").split(" mm off").next();
    let off: f64 = off
        .and_then(|text| text.rsplit(' ').next()?.parse().ok())
        .expect("mm");
    assert!((0.01..1.0).contains(&off), "{off}");
    assert!(found.summary.max_rounding_m < 1e-6);
    // in the orientation of the path one set of numbers serves both
    let along = rapid_arc("[0,0,1,0]").replace(there, "tool0;\nMoveL m,v100,fine,tool0;\nENDPROC");
    let found = done(&[PLAIN], &[("t.mod", &along)]);
    assert_eq!(errors(&found), [""; 0], "{:?}", found.findings);
}

#[test]
fn an_arc_on_which_the_tool_may_turn_the_longer_way_is_reported() {
    // three quarters of a circle about (370, 0): as seen from the path a tool that turns with it
    // turns by 270 degrees, the shorter way by 90
    let arc = |end: &str| {
        rapid(
            &format!("CONST robtarget m := [[340,0,400],[0,0,1,0],{EXTERNAL};"),
            &format!(
                "{HOME}\nMoveL [[400,0,400],[0,0,1,0],{EXTERNAL},v100,fine,tool0;\nMoveC \
                 m,[[370,-30,400],{end},{EXTERNAL},v100,fine,tool0;"
            ),
        )
    };
    let said = |program: &str| {
        let done = done(&[PLAIN], &[("t.mod", program)]);
        let found = done.findings.iter().find(|f| f.id == "arc-rotation");
        found.map(|f| f.message.clone())
    };
    let turned = said(&arc("[0,0.70710678,0.70710678,0]")).expect("the longer way");
    assert!(turned.contains("the other way"), "{turned}");
    // a quarter of a circle, and a tool that turns with it
    let quarter = rapid(
        "",
        &format!(
            "{HOME}\nMoveL [[400,0,400],[0,0,1,0],{EXTERNAL},v100,fine,tool0;\nMoveC \
             [[391.213,21.213,400],[0,0,1,0],{EXTERNAL},[[370,30,400],[0,-0.70710678,0.70710678,0],\
             {EXTERNAL},v100,fine,tool0;"
        ),
    );
    assert_eq!(said(&quarter), None);
    assert_eq!(
        said(&rapid_arc("[0,0,1,0]")),
        None,
        "a tool that does not turn"
    );
}

#[test]
fn an_arc_that_no_circle_defines_is_an_error() {
    let start = "X 430,Y 0,Z 400,A 0,B 180,C 0";
    let arc = |point: &str, end: &str| {
        format!(
            "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nPTP {{A1 0,A2 0,A3 0,A4 0,A5 60,A6 0}}\nLIN \
             {{{start}}}\nCIRC {{{point}}},{{{end}}}\nEND\n"
        )
    };
    let (aside, end) = (
        "X 400,Y 60,Z 420,A 0,B 180,C 0",
        "X 370,Y 0,Z 440,A 0,B 180,C 0",
    );
    for text in [
        arc(aside, start),
        arc(start, end),
        arc(end, end),
        // behind the start, and beyond the end
        arc(
            "X 442,Y 0,Z 390,A 0,B 180,C 0",
            end.replace("440", "450").as_str(),
        ),
        arc("X 340,Y 0,Z 460,A 0,B 180,C 0", end),
    ] {
        let done = done(&[PLAIN], &[("t.src", &text)]);
        assert_eq!(
            errors(&done),
            ["arc-undefined"],
            "{text}\n{:?}",
            done.findings
        );
    }
    // a point between the others is a straight line
    for point in [aside, "X 400,Y 0,Z 420,A 0,B 180,C 0"] {
        let done = done(&[PLAIN], &[("t.src", &arc(point, end))]);
        assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
    }
}

#[test]
fn a_middle_whose_orientation_the_controller_takes_up_is_reported_where_it_differs() {
    let arc = |w: &str| {
        let point = |number: usize, xyz: [&str; 3], w: &str| {
            format!(
                "P[{number}]{{\n   GP1:\n    UF : 0, UT : 0, CONFIG : 'N U T, 0, 0, 0',\n    X = {} \
                 mm, Y = {} mm, Z = {} mm,\n    W = {w} deg, P = 0.000 deg, R = 0.000 deg\n}};\n",
                xyz[0], xyz[1], xyz[2]
            )
        };
        format!(
            "/PROG T\n/MN\n   1:J P[1] 10% FINE ;\n   2:C P[2]\n    :  P[3] 100mm/sec FINE \
             ;\n/POS\n{}{}{}/END\n",
            point(1, ["430.000", "0.000", "400.000"], "180.000"),
            point(2, ["400.000", "60.000", "420.000"], w),
            point(3, ["370.000", "0.000", "440.000"], "180.000"),
        )
    };
    let start = Options {
        start_joints: Some([0.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
        ..given()
    };
    let rotated = try_with(start.clone(), &[PLAIN], &[("t.ls", &arc("170.000"))]).expect("read");
    assert!(message(&rotated, "arc-rotation").contains("10.0 deg"));
    let reported = rotated.findings.iter().find(|f| f.id == "arc-rotation");
    assert!(reported.is_some_and(|f| f.severity == Severity::Warning && f.line == 4));
    let along = try_with(start, &[PLAIN], &[("t.ls", &arc("180.000"))]).expect("read");
    assert!(!along.findings.iter().any(|f| f.id == "arc-rotation"));
}

#[test]
fn an_arc_in_a_routine_is_corrected_alike_however_often_that_is_called() {
    let middle = "[0.3420201433,0,0.9396926208,0]";
    let written = |data: &str, main: &str, arc: &str| {
        let text = format!(
            "MODULE t\nCONST robtarget m := [[400,60,420],{middle},{EXTERNAL};\n{data}\nPROC \
             main()\n{HOME}\n{main}ENDPROC\nPROC r({arc}ENDPROC\nENDMODULE\n"
        );
        done(&[PLAIN], &[("t.mod", &text)])
    };
    let start = format!("MoveL [[430,0,400],[0,0,1,0],{EXTERNAL},v100,fine,tool0;\n");
    let end = format!("[[370,0,440],[0,0,1,0],{EXTERNAL}");
    let arc = format!(")\nMoveC m,{end},v100,fine,tool0;\n");
    let once = written("", &format!("{start}r;\n"), &arc);
    let twice = written("", &format!("{start}r;\n{start}r;\n"), &arc);
    let chosen = written(
        "",
        &format!("{start}IF x THEN\nr;\nELSE\nr;\nENDIF\n"),
        &arc,
    );
    for of in [&twice, &chosen] {
        assert_eq!(errors(of), [""; 0], "{:?}", of.findings);
        let gap = middle_of(of).separation(&middle_of(&once));
        assert!(gap.distance_m < 1e-7 && gap.angle_rad < 1e-6, "{gap:?}");
    }
    // a routine that ends it here and there
    let given = "robtarget e)\nMoveC m,e,v100,fine,tool0;\n";
    let data = format!(
        "CONST robtarget e1 := {end};\nCONST robtarget e2 := \
         [[370,0,440],[0.1736481777,0,0.9848077530,0],{EXTERNAL};"
    );
    let ids = |main: &str, of: &str| {
        let found = written(&data, main, of).findings;
        let ids = ["arc-rotation", "arc-shared", "target-shared"];
        let found = found.into_iter().filter(|f| ids.contains(&f.id));
        let found = found.filter(|f| f.id != "arc-rotation" || f.message.contains("several poses"));
        found.map(|f| f.id).collect::<Vec<_>>()
    };
    let calls = format!("{start}r e1;\n{start}r e2;\n");
    // by 10 degrees, within the limit
    assert_eq!(ids(&calls, given), ["arc-shared"]);
    // one arc whose end was chosen before
    let chosen = format!("VAR robtarget v;\nIF x THEN\nv:=e1;\nELSE\nv:=e2;\nENDIF\n{start}r v;\n");
    assert!(ids(&chosen, given).contains(&"arc-rotation"));
}

/// The fake target of the point `m`.
fn middle_of(done: &Compensation) -> Pose {
    let targets = &done.program.targets;
    let at = targets
        .iter()
        .position(|of| of.name.as_deref() == Some("m"));
    done.targets[at.expect("m")].fake.expect("a fake target")
}

/// The part of an arc from its beginning to its middle, of three points.
fn part_of_arc([a, m, b]: [[f64; 3]; 3]) -> f64 {
    let unit = |v: [f64; 3]| scale(1.0 / norm(v), v);
    // the angle at the circumference is half of that at the centre
    let angle_at = |p: [f64; 3], one: [f64; 3], other: [f64; 3]| {
        dot(unit(sub(one, p)), unit(sub(other, p))).acos()
    };
    let (to_middle, from_middle) = (angle_at(b, a, m), angle_at(a, m, b));
    to_middle / (to_middle + from_middle)
}

/// The tool rotates to the middle of the arc from where it really stands: at joint angles that stay as
/// they are the real tool is not where the simulation has it.
#[test]
fn the_middle_of_an_arc_behind_joint_angles_lands_with_the_rotation_that_it_has_then() {
    // what the rotation does to the place is small of second order
    let large = [
        "{effect: link_geometry, link: 3, theta_deg: 0.6, a_mm: 2}",
        "{effect: link_geometry, link: 5, alpha_deg: 0.5}",
    ];
    let profile = profile(&large);
    let tool = Mounted {
        name: "t".into(),
        flange_from_tool: Pose::from_translation(0.15, 0.0, 0.2),
        load: None,
    };
    let conditions = Conditions::default();
    let (nominal, real) = (
        profile.controller_model(&tool),
        profile.real_model(&tool, &conditions),
    );
    let arm = Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("an arm");
    let joints = |degrees: [f64; 6]| degrees.map(f64::to_radians);
    let (from, to) = (
        joints([0.0, 5.0, 0.0, 10.0, 60.0, 0.0]),
        joints([10.0, 9.0, 4.0, 46.0, 78.0, 60.0]),
    );
    let [start, end] = [from, to].map(|q| nominal.forward(&q, &conditions));
    let half = scale(0.5, add(start.translation, end.translation));
    let mut via = start;
    via.translation = add(half, [0.0, 0.0, 0.04]);
    let written = |pose: &Pose| {
        let ([x, y, z], [a, b, c]) = (pose.translation, pose.rotation.rzryrx(0.0));
        let [a, b, c] = [a, b, c].map(f64::to_degrees);
        format!(
            "{{X {:.6},Y {:.6},Z {:.6},A {a:.6},B {b:.6},C {c:.6}}}",
            1e3 * x,
            1e3 * y,
            1e3 * z
        )
    };
    let text = format!(
        "DEF t()\n$TOOL={{X 150,Y 0,Z 200,A 0,B 0,C 0}}\n$BASE=$WORLD\nPTP {{A1 0,A2 5,A3 0,A4 10,A5 60,A6 0}}\nCIRC \
         {},{}\nEND\n",
        written(&via),
        written(&end)
    );
    let done = done(&large, &[("t.src", &text)]);
    let fakes = fakes(&done);
    let [fake_via, fake_end] = fakes[..] else {
        panic!("{fakes:?}");
    };
    // the controller's path: an arc through the middle's position, rotated about one axis at a constant rate
    let places = [start, fake_via, fake_end].map(|pose| pose.translation);
    let turned = (start.rotation.transpose() * fake_end.rotation).vector();
    let passed = Pose {
        translation: fake_via.translation,
        rotation: start.rotation * Rotation::from_vector(scale(part_of_arc(places), turned)),
    };
    let q = arm.solve_branch(&passed, arm.posture(&from).0, &from).q;
    let apart = nominal.forward(&q, &conditions).separation(&passed);
    assert!(apart.distance_m < 1e-9, "{apart:?}");
    let missed = norm(sub(
        real.forward(&q, &conditions).translation,
        via.translation,
    ));
    assert!(missed < 5e-6, "{missed} m");
}

/// Where the robot goes back to a position that it read, the arc begins where it stood then.
#[test]
fn an_arc_behind_a_position_that_was_read_begins_where_the_robot_stood() {
    let written = "[0.3420201433,0,0.9396926208,0]";
    let plain = middle_of(&done(&[PLAIN], &[("t.mod", &rapid_arc(written))]));
    let end = format!("[[370,0,440],[0,0,1,0],{EXTERNAL}");
    let behind = |read: &str, corner: &str| {
        let start = format!("MoveL [[430,0,400],[0,0,1,0],{EXTERNAL},v100,{corner},tool0;");
        let away = format!("MoveL [[430,0,300],[0,0,1,0],{EXTERNAL},v100,fine,tool0;");
        let body = format!(
            "{HOME}\n{start}\n{read}\n{away}\nMoveL p9,v100,fine,tool0;\nMoveC m,{end},v100,fine,tool0;"
        );
        let data =
            format!("CONST robtarget m := [[400,60,420],{written},{EXTERNAL};\nVAR robtarget p9;");
        done(&[PLAIN], &[("t.mod", &rapid(&data, &body))])
    };
    let read = "p9:=CRobT(\\Tool:=tool0\\WObj:=wobj0);";
    let is_said = |of: &Compensation| of.findings.iter().any(|f| f.id == "arc-rotation");
    let known = behind(read, "fine");
    assert!(!is_said(&known), "{:?}", known.findings);
    let gap = middle_of(&known).separation(&plain);
    assert!(gap.distance_m < 1e-7 && gap.angle_rad < 1e-6, "{gap:?}");
    for unknown in [
        // in a corner, after a call of a routine that nobody knows, displaced by a sensor
        behind(read, "z10"),
        behind(&format!("search;\n{read}"), "fine"),
        behind(&format!("{read}\np9.trans.x:=AInput(ai1);"), "fine"),
    ] {
        assert!(is_said(&unknown), "{:?}", unknown.findings);
    }
    let krl = krl_arc("A 40,B 150,C 0").replace(
        "\nCIRC",
        "\nXA=$POS_ACT\nLIN {X 430,Y 0,Z 300,A 0,B 180,C 0}\nLIN XA\nCIRC",
    );
    let krl = krl.replace("$TOOL", "DECL POS XA\n$TOOL");
    let found = done(&[PLAIN], &[("t.src", &krl)]);
    assert!(!is_said(&found), "{:?}", found.findings);
    let along = done(&[PLAIN], &[("t.src", &krl_arc("A 0,B 180,C 0"))]);
    let [found, along] = [&found, &along].map(middle);
    let apart = norm(sub(found.translation, along.translation));
    assert!(apart < 1e-7, "{apart} m");
}

/// Joint 4 turns back shortly before the middle: how much of its backlash it has taken up there is that
/// of the path between the fake ends, in whose rotation the robot passes it.
#[test]
fn what_a_joint_has_taken_up_at_a_middle_is_that_of_the_path_between_fake_ends() {
    let backlash = "{effect: backlash, joint: 4, width_deg: -0.05}";
    let tool = Mounted {
        name: "t".into(),
        flange_from_tool: Pose::from_translation(0.03, 0.01, 0.12),
        load: None,
    };
    let profile = profile(&[backlash]);
    let arm = Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("an arm");
    let data = "PERS tooldata t:=[TRUE,[[30,10,120],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];";
    let down = "[0,-0.04361939,0.99904822,0]";
    let body = format!(
        "ConfL\\Off;\nMoveAbsJ [[0,0,0,0,45,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\nMoveL \
         [[377.309,-13.371,270],{down},{EXTERNAL},v100,fine,t;\nMoveC \
         [[413.671,29.963,270],{down},{EXTERNAL},[[437.952,-18.104,280],{down},{EXTERNAL},v100,fine,t;"
    );
    let done = done(&[backlash], &[("t.mod", &rapid(data, &body))]);
    let fakes = fakes(&done);
    let [start, via, end] = fakes[..] else {
        panic!("{fakes:?}");
    };
    // the controller's path: an arc, rotated about one axis at a constant rate
    let places = [start, via, end].map(|pose| pose.translation);
    let turned = (start.rotation.transpose() * end.rotation).vector();
    let middle = part_of_arc(places);
    let mut near = [0.0, 24.0, 3.0, 0.0, 63.0, -3.5].map(f64::to_radians);
    let angles: Vec<f64> = (0..=1000)
        .map(|k| {
            let part = middle * f64::from(k) / 1000.0;
            let pose = Pose {
                translation: on_arc(places, part / middle),
                rotation: start.rotation * Rotation::from_vector(scale(part, turned)),
            };
            near = arm.solve_branch(&pose, arm.posture(&near).0, &near).q;
            near[3].to_degrees()
        })
        .collect();
    let at_middle = angles[1000];
    let up = (at_middle - angles[999]).signum();
    let farthest = angles
        .iter()
        .fold(0.0_f64, |most, q| most.max(up * (at_middle - q)));
    assert!(farthest > 0.01 && farthest < 0.04, "{farthest}");
    let said = message(&done, "direction-uncertain");
    let said = said
        .split("joint 4: ")
        .nth(1)
        .and_then(|of| of.split(' ').next());
    let said: f64 = said.and_then(|of| of.parse().ok()).expect("degrees");
    assert!((said - farthest).abs() < 0.001, "{said} of {farthest}");
}

/// A point of the arc through three points, at a part of it from the first to the second.
fn on_arc([a, m, b]: [[f64; 3]; 3], part: f64) -> [f64; 3] {
    let (u, v) = (sub(m, a), sub(b, a));
    let normal = cross(u, v);
    let squared = dot(normal, normal);
    let out = sub(
        scale(dot(u, u), cross(v, normal)),
        scale(dot(v, v), cross(u, normal)),
    );
    let centre = add(a, scale(0.5 / squared, out));
    let (first, last) = (sub(a, centre), sub(m, centre));
    let axis = scale(squared.sqrt().recip(), normal);
    let angle = dot(axis, cross(first, last)).atan2(dot(first, last));
    let angle = angle.rem_euclid(std::f64::consts::TAU);
    add(
        centre,
        Rotation::from_vector(scale(part * angle, axis)) * first,
    )
}
