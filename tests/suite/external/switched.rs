//! Units that are switched off and axes that move independently of the program: their values in
//! targets do not count.

use super::{errors, profile, rapid, run};
use poseshift::model::profile::Profile;

const TRACK: &str = "external_axes:\n  track:\n    - {axis: eax_a, direction: [1, 0, 0], zero_mm: \
    0, min_mm: 0, max_mm: 2000}\n";
const CELL: &str = "external_axes:\n  track:\n    - {axis: eax_a, direction: [1, 0, 0], zero_mm: \
    0, min_mm: 0, max_mm: 2000}\n  positioners:\n    - name: STN1\n      axes:\n        - {axis: \
    eax_b, at: {x_mm: 600, y_mm: 0, z_mm: 300, rx_deg: 0, ry_deg: 0, rz_deg: 0}, min_deg: -180, \
    max_deg: 180}\n  other: [GUN]\n";
const KRL_TRACK: &str = "external_axes:\n  track:\n    - {axis: E1, direction: [1, 0, 0], zero_mm: \
    0, min_mm: 0, max_mm: 2000}\n";
const ARM: &str = "{effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}";
const HOME: &str = "MoveAbsJ [[0,0,10,0,60,0],[0,0,9E9,9E9,9E9,9E9]],v100,fine,t;\n";
const GO: &str =
    "MoveJ [[640,200,700],[0,0.1,0.9949874371,0],[0,0,0,0],[100,0,9E9,9E9,9E9,9E9]],v100,fine,t;\n";

fn reported(profile: &Profile, body: &str) -> (Vec<&'static str>, String) {
    let text = rapid("", body);
    let done = run(profile, &[("t.mod", &text)]).expect("read");
    let messages: Vec<&str> = done.findings.iter().map(|f| f.message.as_str()).collect();
    (errors(&done), messages.join("\n"))
}

#[test]
fn a_unit_that_is_off_stands_where_no_target_says() {
    let rail = profile(TRACK, &[ARM]);
    let unknown = ["external-value-unknown"];
    for (body, expected) in [
        (format!("{HOME}{GO}"), &[][..]),
        (format!("ActUnit TRACK1;\n{HOME}{GO}"), &[]),
        (format!("{HOME}DeactUnit TRACK1;\n{GO}"), &unknown),
        (
            format!("{HOME}DeactUnit TRACK1;\nActUnit TRACK1;\n{GO}"),
            &[],
        ),
        (
            format!("{HOME}DeactUnit TRACK1;\nActUnit STN2;\n{GO}"),
            &unknown,
        ),
        (
            format!("{HOME}IF x THEN\nDeactUnit TRACK1;\nENDIF\n{GO}"),
            &unknown,
        ),
        // offsets do not switch it on
        (
            format!("{HOME}DeactUnit TRACK1;\nEOffsOff;\n{GO}"),
            &unknown,
        ),
        (
            format!(
                "{HOME}DeactUnit TRACK1;\nMoveAbsJ \
                 [[0,0,20,0,60,0],[100,0,9E9,9E9,9E9,9E9]]\\NoEOffs,v100,fine,t;\nActUnit \
                 TRACK1;\n{GO}"
            ),
            &[],
        ),
    ] {
        let (found, messages) = reported(&rail, &body);
        assert_eq!(found, expected, "{body}\n{messages}");
        if !expected.is_empty() {
            assert!(
                messages.contains("since line") && messages.contains("eax_a"),
                "{messages}"
            );
        }
    }
}

#[test]
fn only_axes_that_matter_to_the_move_are_asked_for() {
    let cell = profile(CELL, &[ARM]);
    // a fixed work object does not ask for the station; what is in `other` carries nothing
    for body in ["DeactUnit STN1;\n", "DeactUnit GUN;\n"] {
        let (found, messages) = reported(&cell, &format!("{HOME}{body}{GO}"));
        assert_eq!(found, [""; 0], "{body} {messages}");
    }
    let (found, _) = reported(&cell, &format!("{HOME}DeactUnit TRACK1;\n{GO}"));
    assert_eq!(found, ["external-value-unknown"]);
    let wobj = "PERS wobjdata w:=[FALSE,FALSE,\"STN1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];";
    let on_station = "MoveJ [[40,20,400],[0,0.1,0.9949874371,0],[0,0,0,0],[100,0,9E9,9E9,9E9,9E9]],v100,fine,t\\WObj:=w;\n";
    for (switch, expected) in [
        ("", &[][..]),
        ("DeactUnit STN1;\n", &["external-value-unknown"]),
    ] {
        let text = rapid(wobj, &format!("{HOME}{switch}{on_station}"));
        let done = run(&cell, &[("t.mod", &text)]).expect("read");
        assert_eq!(errors(&done), expected, "{:?}", done.findings);
    }
}

#[test]
fn asynchronous_axes_of_krl_are_not_where_targets_say() {
    let rail = profile(KRL_TRACK, &[ARM]);
    let home = "PTP {A1 0,A2 0,A3 10,A4 0,A5 60,A6 0,E1 100}\n";
    let go = "PTP {X 640,Y 200,Z 700,A 10,B 5,C 170,E1 100}\n";
    let unknown = ["external-value-unknown"];
    for (between, expected) in [
        ("", &[][..]),
        ("$ASYNC_AXIS='B0000'\n", &[]),
        ("$ACT_EX_AX=1\n", &[]),
        ("$ACT_EX_AX=0\n", &unknown),
        ("$ACT_EX_AX=0\n$ACT_EX_AX=6\n", &[]),
        ("$ASYNC_AXIS='B0001'\n", &unknown),
        ("ASYPTP {E1 500}\n", &unknown),
        // another axis, which the profile does not list
        ("ASYPTP {E2 500}\n", &[]),
        ("IF x THEN\nASYPTP {E1 500}\nENDIF\n", &unknown),
    ] {
        let text = format!("DEF t()\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\n{home}{between}{go}END\n");
        let done = run(&rail, &[("t.src", &text)]).expect("read");
        assert_eq!(errors(&done), expected, "{between}{:?}", done.findings);
    }
}

#[test]
fn an_interrupt_that_moves_an_axis_leaves_it_where_no_target_says() {
    let rail = profile(KRL_TRACK, &[ARM]);
    let found = |interrupt: &str, second: &str| {
        let text = format!(
            "DEF t()\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\nINTERRUPT DECL 3 WHEN $IN[1]==TRUE DO \
             ir()\nINTERRUPT ON 3\nPTP {{A1 0,A2 0,A3 10,A4 0,A5 60,A6 0,E1 100}}\nPTP {{X 640,Y \
             200,Z 700,A 10,B 5,C 170{second}}}\nEND\nDEF ir()\n{interrupt}END\n"
        );
        let done = run(&rail, &[("t.src", &text)]).expect("read");
        let messages: Vec<&str> = done.findings.iter().map(|f| f.message.as_str()).collect();
        (errors(&done), messages.join("\n"))
    };
    let away = "PTP {A1 5,A2 0,A3 10,A4 0,A5 60,A6 0,E1 650}\n";
    let (ids, messages) = found(away, "");
    assert_eq!(ids, ["external-value-unknown"], "{messages}");
    assert!(
        messages.contains("`ir`") && messages.contains("E1"),
        "{messages}"
    );
    let stays = "PTP {A1 5,A2 0,A3 10,A4 0,A5 60,A6 0,E1 100}\n";
    for (interrupt, second) in [(away, ",E1 100"), (stays, ""), ("$OUT[1]=TRUE\n", "")] {
        assert_eq!(found(interrupt, second).0, [""; 0], "{interrupt} {second}");
    }
}
