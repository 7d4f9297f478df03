//! Values of external axes that only statements between targets tell, and points that are derived
//! from a target elsewhere on the rail.
//!
//! The rail goes 1/1000 farther than the controller believes, from the middle of its limits at 1000 mm,
//! and has no other error: at a value e along x everything lands (e − 1000)/1000 farther along x, so
//! the correction of a target is that by hand.

use super::{errors, profile, profile_text, rapid, run, written};
use crate::support::{poseshift, scratch};

const SCALE: &str = "{effect: track_scale, axis: 1, ratio: 0.001}";

fn rail(axis: &str) -> String {
    format!(
        "external_axes:\n  track:\n    - {{axis: {axis}, direction: [1, 0, 0], zero_mm: 0, min_mm: \
         0, max_mm: 2000}}\n"
    )
}

const HOME: &str = "MoveAbsJ [[0,0,10,0,60,0],[100,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\nMoveJ \
    p1,v100,fine,t;\n";
const POINT: &str = "CONST robtarget p1:=[[640,200,700],[0,0.1,0.9949874371,0],[0,0,0,0],\
    [100,9E9,9E9,9E9,9E9,9E9]];\nPERS wobjdata w:=[FALSE,TRUE,\"\",[[840,-440,0],\
    [0.7071067811865476,0,0,0.7071067811865476]],[[0,0,0],[1,0,0,0]]];";

#[test]
fn a_derived_point_is_judged_where_the_rail_and_the_frame_are_then() {
    let rail = profile(&rail("eax_a"), &[SCALE]);
    for (body, lands) in [
        ("MoveJ Offs(p1,0,0,1),v100,fine,t;\n", "lands 0.000 mm off"),
        // corrected by 0.9 mm, and 0.6 mm would be right
        (
            "EOffsSet [300,0,0,0,0,0];\nMoveJ Offs(p1,0,0,1),v100,fine,t;\n",
            "lands 0.300 mm off",
        ),
        // the correction along -x of the target's frame is one along -y of the world
        (
            "MoveJ Offs(p1,0,0,1),v100,fine,t\\WObj:=w;\n",
            "lands 1.273 mm off",
        ),
    ] {
        let text = rapid(POINT, &format!("{HOME}{body}"));
        let done = run(&rail, &[("t.mod", &text)]).expect("read");
        let mut said = done.findings.iter();
        let found = said.find(|finding| finding.id == "displaced-target");
        let message = &found.expect("a finding").message;
        assert!(message.contains(lands), "{body}: {message}");
    }
}

#[test]
fn a_composed_target_stands_where_its_own_numbers_say() {
    let rail = profile(&rail("eax_a"), &[SCALE]);
    let elsewhere = format!(
        "{POINT}\nCONST robtarget p2:=[[640,200,700],[0,0.1,0.9949874371,0],[0,0,0,0],\
         [400,9E9,9E9,9E9,9E9,9E9]];\nCONST extjoint e2:=[400,9E9,9E9,9E9,9E9,9E9];\nPERS extjoint \
         e3:=[400,9E9,9E9,9E9,9E9,9E9];"
    );
    for (axes, id, off) in [
        ("p1.extax", "displaced-target", "lands 0.000 mm off"),
        ("P1.Extax", "displaced-target", "lands 0.000 mm off"),
        ("p2.extax", "displaced-target", "lands 0.300 mm off"),
        ("e2", "displaced-target", "lands 0.300 mm off"),
        ("e3", "external-value-unknown", "eax_a"),
        (
            "[400,9E9,9E9,9E9,9E9,9E9]",
            "displaced-target",
            "lands 0.300 mm off",
        ),
        ("[x,9E9,9E9,9E9,9E9,9E9]", "external-value-unknown", "eax_a"),
    ] {
        let go = format!("MoveJ [p1.trans,p1.rot,p1.robconf,{axes}],v100,fine,t;\n");
        let text = rapid(&elsewhere, &format!("{HOME}{go}"));
        let done = run(&rail, &[("t.mod", &text)]).expect("read");
        let found = done.findings.iter().find(|finding| finding.id == id);
        let message = found.map(|finding| finding.message.as_str());
        assert!(
            message.is_some_and(|message| message.contains(off)),
            "{axes}: {:?}",
            done.findings
        );
    }
}

#[test]
fn a_position_of_rapid_with_other_external_axes_is_refused_by_name() {
    let data = format!(
        "{POINT}\nCONST robtarget p2:=[[640,200,700],[0,0.1,0.9949874371,0],[0,0,0,0],\
         [400,9E9,9E9,9E9,9E9,9E9]];\nCONST robtarget \
         p3:=[p1.trans,p1.rot,p1.robconf,p2.extax];\nVAR robtarget q;\nFUNC robtarget \
         at_rail(robtarget p,num e)\np.extax.eax_a:=e;\nRETURN p;\nENDFUNC\n"
    );
    for (statements, is_refused) in [
        ("q:=p1;\nMoveJ q,v100,fine,t;\n", false),
        ("q:=p1;\nq.extax.eax_b:=400;\nMoveJ q,v100,fine,t;\n", false),
        ("q:=p1;\nq.extax.eax_a:=400;\nMoveJ q,v100,fine,t;\n", true),
        ("q:=p1;\nq.extax:=p2.extax;\nMoveJ q,v100,fine,t;\n", true),
        (
            "q:=Offs(p1,0,0,1);\nq.extax.eax_a:=400;\nMoveJ q,v100,fine,t;\n",
            true,
        ),
        (
            "q:=[p1.trans,p1.rot,p1.robconf,p2.extax];\nMoveJ q,v100,fine,t;\n",
            true,
        ),
        ("MoveJ p3,v100,fine,t;\n", true),
        ("MoveJ at_rail(p1,400),v100,fine,t;\n", true),
    ] {
        let rail = profile(&rail("eax_a"), &[SCALE]);
        let done = run(
            &rail,
            &[("t.mod", &rapid(&data, &format!("{HOME}{statements}")))],
        );
        let done = done.expect("read");
        let mut said = done.findings.iter();
        let found = said.any(|finding| {
            finding.id == "external-value-unknown" && finding.message.contains("eax_a")
        });
        assert_eq!(found, is_refused, "{statements}: {:?}", done.findings);
    }
}

/// The first X of each line of a KRL program with one.
fn xs(text: &str) -> Vec<f64> {
    let behind = text.lines().filter_map(|line| line.split_once("{X "));
    let numbers = behind.map(|(_, rest)| rest.split(',').next().expect("a number"));
    numbers.map(|x| x.parse().expect("a number")).collect()
}

/// Half a unit of the last decimal that files have here, mm.
const ROUNDING_MM: f64 = 6e-4;

#[test]
fn a_relative_move_of_krl_moves_its_external_axes() {
    let rail = profile(&rail("E1"), &[SCALE]);
    let pose = "X 640.000,Y 200.000,Z 700.000,A 10.000,B 5.000,C 170.000";
    for (relative, x) in [
        ("PTP_REL {Z 1}", 640.9),
        ("PTP_REL {Z 1,E1 100}", 640.8),
        ("PTP {E6AXIS: E1 300}", 640.7),
        ("PTP {E6AXIS: A6 5,E1 300}", 640.7),
        ("PTP_REL {Z 1,E1 100}\nPTP_REL {Z 1}", 640.8),
        ("PTP_REL {Z 1,E1 100}\nPTP_REL {Z 1,E1 50}", 640.75),
    ] {
        let text = format!(
            "DEF t()\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\nPTP {{A1 0,A2 0,A3 10,A4 0,A5 60,A6 0,E1 \
             100}}\nPTP {{{pose},E1 100}}\n{relative}\nPTP {{{pose}}}\nEND\n"
        );
        let found = xs(&written(&rail, &[("t.src", &text)]));
        let [first, last] = found[..] else {
            panic!("{found:?}")
        };
        assert!((first - 640.9).abs() < ROUNDING_MM, "{relative}: {first}");
        assert!((last - x).abs() < ROUNDING_MM, "{relative}: {last}");
    }
}

/// The last factor of a product decides its type: a FRAME has no external axes, which stay where
/// they stand.
#[test]
fn a_product_of_krl_that_ends_with_a_frame_leaves_its_external_axes() {
    let rail = profile(&rail("E1"), &[SCALE]);
    let pose = "X 640.000,Y 200.000,Z 700.000,A 10.000,B 5.000,C 170.000";
    for (product, x) in [
        ("LIN XA", 640.9),
        ("LIN {X 0,Y 0,Z 1,A 0,B 0,C 0}:XA", 640.9),
        ("LIN XA:{X 0,Y 0,Z 1,A 0,B 0,C 0}", 640.8),
        ("PTP XA:FR", 640.8),
    ] {
        let text = format!(
            "DEF t()\nDECL E6POS XA={{{pose},E1 100}}\nDECL FRAME FR={{X 0,Y 0,Z 1,A 0,B 0,C 0}}\n\
             $TOOL=TOOL_DATA[1]\n$BASE=$WORLD\nPTP {{A1 0,A2 0,A3 10,A4 0,A5 60,A6 0,E1 \
             100}}\nPTP {{{pose},E1 200}}\n{product}\nPTP {{{pose}}}\nEND\n"
        );
        let done = run(&rail, &[("t.src", &text)]).expect("read");
        let stands = errors(&done);
        assert!(stands.is_empty(), "{product}: {:?}", done.findings);
        let found = xs(&written(&rail, &[("t.src", &text)]));
        let last = found.last().expect("a position");
        assert!((last - x).abs() < ROUNDING_MM, "{product}: {last}");
    }
    for (of, becomes, x) in [
        ("FRAME", "XA", 640.8),
        ("FRAME", "XA:FR", 640.8),
        ("POS", "XA", 640.8),
        ("E6POS", "XA", 640.9),
        ("E6POS", "FR:XA", 640.9),
    ] {
        let text = format!(
            "DEF t()\nDECL {of} XB\nDECL E6POS XA={{{pose},E1 100}}\nDECL FRAME FR={{X 0,Y 0,Z 1,A 0,B \
             0,C 0}}\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\nPTP {{A1 0,A2 0,A3 10,A4 0,A5 60,A6 0,E1 \
             100}}\nPTP {{{pose},E1 200}}\nXB={becomes}\nPTP XB\nPTP {{{pose}}}\nEND\n"
        );
        let found = xs(&written(&rail, &[("t.src", &text)]));
        let last = found.last().expect("a position");
        assert!((last - x).abs() < ROUNDING_MM, "{of}={becomes}: {last}");
    }
    for (assigned, id) in [
        ("XB=XA:FR", "run-time-target"),
        ("XB=XA:{X 0,Y 0,Z 1,A 0,B 0,C 0,E1 300}", "target-copied"),
    ] {
        let text = format!(
            "DEF t()\nDECL E6POS XB\nDECL E6POS XA={{{pose},E1 100}}\nDECL FRAME FR={{X 0,Y 0,Z 1,A 0,B \
             0,C 0}}\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\nPTP XA\n{assigned}\nPTP XB\nEND\n"
        );
        let done = run(&rail, &[("t.src", &text)]).expect("read");
        let said = errors(&done);
        assert!(said.contains(&id), "{assigned}: {said:?}");
    }
}

#[test]
fn a_position_of_krl_whose_axis_is_written_is_refused_by_name() {
    let rail = profile(&rail("E1"), &[SCALE]);
    let text = "DEF t()\nDECL E6POS XP1\nXP1={X 640.000,Y 200.000,Z 700.000,A 10.000,B 5.000,C \
        170.000,E1 100}\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\nPTP {A1 0,A2 0,A3 10,A4 0,A5 60,A6 \
        0,E1 100}\nXP1.E1=400\nPTP XP1\nEND\n";
    let done = run(&rail, &[("t.src", text)]).expect("read");
    assert_eq!(
        errors(&done),
        ["external-value-unknown"],
        "{:?}",
        done.findings
    );
    let mut said = done.findings.iter();
    assert!(said.any(|finding| finding.message.contains("external axis E1")));
}

/// A job with the rail at 100 and 400 mm.
fn job(lines: &str) -> String {
    format!(
        "/JOB\n//NAME T\n//POS\n///NPOS 3,3,0,0,1,0\n///TOOL 1\n///POSTYPE ANGLE\n///ANGLE\n\
         C00000=0,0,10,0,60,0\nBC00000=100\n///POSTYPE BASE\n///RECTAN\n///RCONF \
         0,0,0,0,0,0,0,0\nC00001=640.000,200.000,700.000,170.0000,0.0000,0.0000\nBC00001=100\n\
         C00002=640.000,210.000,700.000,170.0000,0.0000,0.0000\nBC00002=400\nBP001=100\n//INST\n\
         ///DATE 2024/01/01 10:00\n///ATTR SC,RW\n///GROUP1 RB1,BS1\nNOP\nMOVJ C00000 BC00000 \
         VJ=5.00\n{lines}END\n"
    )
}

#[test]
fn a_base_of_inform_that_moves_alone_counts_for_the_positions_behind_it() {
    let rail = profile(&rail("BC1"), &[SCALE]);
    let text = job("MOVJ C00001 BC00001 VJ=5.00\nMOVJ BC00002 VJ=5.00\nMOVJ C00002 VJ=5.00\n");
    let written = written(&rail, &[("T.JBI", &text)]);
    let x = |name: &str| -> f64 {
        let line = written.lines().find_map(|line| line.strip_prefix(name));
        let first = line.and_then(|line| line.split(',').next());
        first.and_then(|x| x.parse().ok()).expect("a position")
    };
    let (first, last) = (x("C00001="), x("C00002="));
    assert!((first - 640.9).abs() < ROUNDING_MM, "{first}");
    assert!((last - 640.6).abs() < ROUNDING_MM, "{last}");
}

#[test]
fn variables_of_the_base_that_a_job_writes_are_not_known() {
    let rail = profile(&rail("BC1"), &[SCALE]);
    let go = "MOVJ C00001 BP001 VJ=5.00\n";
    for (before, is_known) in [
        ("", true),
        ("SETE BP002 (1) 400000\n", true),
        ("'SETE BP001 (1) 400000\n", true),
        ("SETE BP001 (1) 400000\n", false),
        ("ADD BP001 BP002\n", false),
        ("CNVRT BP001 PX001 BF\n", false),
        ("SUB BP[I000] BP002\n", false),
    ] {
        let text = job(&format!("{before}{go}"));
        let done = run(&rail, &[("T.JBI", &text)]).expect("read");
        let found = errors(&done);
        assert_eq!(found.is_empty(), is_known, "{before}{:?}", done.findings);
        if !is_known {
            let mut said = done.findings.iter();
            assert!(said.any(|f| f.message.contains("BP001")), "{before}");
        }
    }
}

#[test]
fn where_external_axes_stand_at_the_start_tells_from_which_side_they_come() {
    let folder = scratch();
    let robot = profile_text(
        &rail("eax_a"),
        &["{effect: track_backlash, axis: 1, width_mm: 0.2}"],
    );
    let tool = "PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[2,[10,0,60],[1,0,0,0],0,0,0]];";
    let data = format!("{POINT}\n{tool}");
    let [program, profile] = ["t.mod", "p.yaml"].map(|name| folder.path().join(name));
    std::fs::write(&program, rapid(&data, "MoveJ p1,v100,fine,t;\n")).expect("scratch");
    std::fs::write(&profile, robot).expect("scratch");
    let out = folder.path().join("out.mod");
    let run = |start: Option<&str>| {
        let mut command = poseshift();
        command.arg("compensate").arg(&program).arg("--profile");
        command.arg(&profile).arg("-o").arg(&out);
        let start = start.map(|start| format!("--start-joints={start}"));
        let done = command.args(start).output().expect("the program starts");
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        (done.status.code(), said)
    };
    let x = || {
        let text = std::fs::read_to_string(&out).expect("written");
        let (_, behind) = text.split_once("p1:=[[").expect("the target");
        let x = behind.split(',').next().expect("a number");
        x.parse::<f64>().expect("a number")
    };
    // half the width against the way of the rail: from 0 to 100 mm, and from 500 back
    for (start, expected) in [("0,0,10,0,60,0,0", 639.9), ("0,0,10,0,60,0,500", 640.1)] {
        let (status, said) = run(Some(start));
        assert_eq!(status, Some(0), "{said}");
        assert!((x() - expected).abs() < 1e-3, "{start}: {}", x());
    }
    // by less than its width it does not take it up
    let (status, said) = run(Some("0,0,10,0,60,0,100.1"));
    assert_eq!(status, Some(0), "{said}");
    assert!((x() - 640.0).abs() < 1e-3, "{}", x());
    let (status, said) = run(Some("0,0,10,0,60,0"));
    assert_eq!(status, Some(0), "{said}");
    assert!((x() - 640.0).abs() < 1e-3, "{}", x());
    let (status, said) = run(Some("0,0,10,0,60,0,0,0"));
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("external axes in the profile: 1"), "{said}");
    assert!(said.contains("eax_a (mm)"), "{said}");
    let (status, said) = run(Some("0,0,10,0,60,0,9000"));
    assert!(
        status == Some(2) && said.contains("its limits are"),
        "{said}"
    );
}

#[test]
fn a_rail_that_comes_from_both_sides_or_from_behind_a_call_is_reported_as_joints_are() {
    let rail = profile(
        &rail("eax_a"),
        &["{effect: track_backlash, axis: 1, width_mm: 0.4}"],
    );
    let at = |e: u32| {
        format!(
            "MoveJ [[{},200,700],[0,0.1,0.9949874371,0],[0,0,0,0],[{e},9E9,9E9,9E9,9E9,9E9]],v100,\
             fine,t;\n",
            540 + e
        )
    };
    let home = HOME.lines().next().expect("joints first");
    let run_all = |body: String| run(&rail, &[("t.mod", &rapid(POINT, &body))]).expect("read");
    let said = |body: String| {
        let done = run_all(body);
        let all: Vec<String> = done
            .findings
            .iter()
            .map(|of| of.message.clone())
            .filter(|message| {
                let known = ["nothing says from which side", "no move uses"];
                !known.iter().any(|known| message.contains(known))
            })
            .collect();
        (errors(&done), all.join("\n"))
    };
    // forth and back, for ever: to the second from one side only but at the first
    let (found, messages) = said(format!(
        "{home}\nWHILE TRUE DO\n{}{}ENDWHILE\n",
        at(500),
        at(900)
    ));
    assert_eq!(found, ["target-shared"], "{messages}");
    assert!(messages.contains("+eax_a: 0.200 mm") && messages.contains("-eax_a: 0.200 mm"));
    // one target, two moves
    let (found, messages) = said(format!(
        "{home}\n{}MoveJ p1,v100,fine,t;\n{}MoveJ p1,v100,fine,t;\n",
        at(0),
        at(500)
    ));
    assert_eq!(found, ["target-shared"], "{messages}");
    assert!(
        messages.contains("side from which an external axis comes"),
        "{messages}"
    );
    // a routine that is not in the files, between two moves to one place
    let (found, messages) = said(format!("{home}\n{}Elsewhere;\n{}", at(500), at(500)));
    assert_eq!(found, [""; 0], "{messages}");
    assert!(
        messages.contains("`Elsewhere`")
            && messages.contains("external axis eax_a with backlash may come from the other side")
            && messages.contains("0.400 mm off"),
        "{messages}"
    );
    // a longer way behind it: from one side whatever it does
    let (found, messages) = said(format!("{home}\n{}{}{}", at(500), at(900), at(1200)));
    assert_eq!((found, messages.as_str()), (vec![], ""));
}
