//! AS programs: what is derived from joints that stay, and the load that a program says.

use super::{PLAIN, done, errors, given, message, try_with};
use poseshift::compensate::{Compensation, Given, Options};
use poseshift::finding::{Finding, Severity};

/// A program at the home position of these tests, and two targets below.
fn program(lines: &str) -> String {
    format!(
        ".PROGRAM main()\nTOOL NULL\nBASE NULL\nJMOVE #h\n{lines}\n.END\n.TRANS\np 430 0 400 0 180 \
         0\nq 400 50 380 0 180 0\n.END\n.JOINTS\n#h 0 0 0 0 60 0\n.END\n"
    )
}

/// What is found of displaced targets, by line.
fn displaced(done: &Compensation) -> Vec<(usize, Severity, bool)> {
    let found = done.findings.iter().filter(|f| f.id == "displaced-target");
    let is_uncorrected =
        |message: &str| message.ends_with("`#h`, which stays as it is, is not corrected");
    found
        .map(|f| (f.line, f.severity, is_uncorrected(&f.message)))
        .collect()
}

#[test]
fn a_move_away_from_joints_that_stay_is_reported_as_not_corrected() {
    let lines = "LDEPART 50\nLMOVE p\nJMOVE #h\nDRAW 0,50,0\nJMOVE #h\nTDRAW 0,0,50\nTDRAW 0,0,-20";
    let text = program(lines);
    let stays = done(&[PLAIN], &[("t.as", &text)]);
    let reported = |line| (line, Severity::Warning, true);
    assert_eq!(displaced(&stays), [5, 8, 10, 11].map(reported));
    // corrected joints take their correction along
    let options = Options {
        correct_joint_targets: true,
        ..given()
    };
    let corrected = try_with(options, &[PLAIN], &[("t.as", &text)]).expect("read");
    let found = displaced(&corrected);
    assert!(found.iter().all(|(.., is_uncorrected)| !is_uncorrected));
    assert_eq!(found.len(), 4, "{:?}", corrected.findings);
    // poses that move away from poses are none of that
    let poses = done(&[PLAIN], &[("t.as", &program("LMOVE p\nLDEPART 50"))]);
    assert!(
        displaced(&poses)
            .iter()
            .all(|(.., is_uncorrected)| !is_uncorrected)
    );
}

/// Of joint 2, rad per N m.
const SOFT: &str = "{effect: joint_compliance, joint: 2, rad_per_n_m: 3.0e-5}";

fn height_mm(done: &Compensation, name: &str) -> f64 {
    let name_of = |at: usize| done.program.targets[at].name.as_deref();
    let is_it = |at: &usize| name_of(*at) == Some(name);
    let at = (0..done.targets.len()).find(is_it).expect("a target");
    1e3 * done.targets[at].fake.expect("a fake target").translation[2]
}

#[test]
fn a_load_that_the_program_says_bends_the_arm() {
    let with = |first: &str, second: &str| {
        let text = program(&format!("{first}\nLMOVE p\n{second}\nLMOVE q"));
        done(&[SOFT], &[("t.as", &text)])
    };
    let none = with("", "");
    let loaded = with("WEIGHT 6,0,0,100", "WEIGHT 0,0,0,0");
    assert_eq!(errors(&loaded), [""; 0]);
    // axis 2 lies at x = 0: 6 kg at 0.43 m turn it, and it lowers the tool 0.43 m away by that angle
    let sag_mm = 1e3 * 0.43 * (3e-5 * 6.0 * 9.81 * 0.43);
    let raised_mm = height_mm(&loaded, "p") - height_mm(&none, "p");
    assert!(
        (raised_mm - sag_mm).abs() < 0.02 * sag_mm,
        "{raised_mm} {sag_mm}"
    );
    let raised_mm = height_mm(&loaded, "q") - height_mm(&none, "q");
    assert!(raised_mm.abs() < 1e-6, "the load is off: {raised_mm}");
    // by constants and with moments of inertia behind
    let constant = with(".m = 6\nWEIGHT .m,0,0,100,0,0,0", "weight 0,0,0,0");
    assert_eq!(height_mm(&constant, "p"), height_mm(&loaded, "p"));
}

#[test]
fn a_load_that_the_text_does_not_say_is_reported_where_it_is_set() {
    for weight in [
        "WEIGHT SIG(1001)*6,0,0,100",
        "WEIGHT kg,0,0,100",
        "WEIGHT -6,0,0,100",
        "WEIGHT 6",
        "WEIGHT",
    ] {
        let text = program(&format!("{weight}\nLMOVE p\nLMOVE q"));
        let found = done(&[SOFT], &[("t.as", &text)]);
        let said = found.findings.iter();
        let said = said.filter(|f| f.id == "load-chosen-at-run-time");
        let said: Vec<_> = said.map(|f| (f.line, f.severity)).collect();
        assert_eq!(said, [(5, Severity::Warning)], "{weight}");
    }
}

/// As [`program`], with a tool and a third target.
fn with_tool(lines: &str) -> String {
    program(lines).replace(
        ".TRANS\n",
        ".TRANS\nr 450 -40 390 0 180 0\ngrip 0 0 20 0 0 0\n",
    )
}

#[test]
fn a_relative_move_of_a_known_step_keeps_the_posture() {
    for step in [
        "DRAW 0,0,20",
        "LDEPART 20",
        "TDRAW 0,0,-20,0,0,5",
        "JDEPART 15",
    ] {
        let text = with_tool(&format!("LMOVE p\nTOOL grip\n{step}\nLMOVE q\nLMOVE r"));
        let done = done(&[PLAIN], &[("t.as", &text)]);
        assert_eq!(errors(&done), [""; 0], "{step}: {:?}", done.findings);
        let assumed = done.findings.iter().find(|f| f.id == "posture-assumed");
        assert!(assumed.is_none(), "{step}: {assumed:?}");
        for name in ["q", "r"] {
            let is_it = |at: &usize| done.program.targets[*at].name.as_deref() == Some(name);
            let at = (0..done.targets.len()).find(is_it).expect("a target");
            let q = done.targets[at].q.expect("joints");
            assert!(q[4] > 0.0, "{step}: {q:?}");
        }
    }
}

#[test]
fn each_move_that_inherits_an_assumed_posture_is_named() {
    let text = with_tool("LMOVE p\nTOOL grip\nDRAW 0,0,SIG(1)*20\nLMOVE q\nLMOVE r");
    // tilted, so that the wrist reaches them on both sides
    let text = text
        .replace("380 0 180 0", "380 90 150 0")
        .replace("390 0 180 0", "390 90 150 0");
    let done = done(&[PLAIN], &[("t.as", &text)]);
    let said = message(&done, "posture-assumed");
    assert!(
        said.ends_with("the posture in line 9 follows from it"),
        "{said}"
    );
}

#[test]
fn text_that_nothing_reaches_needs_no_tool() {
    let text = program("GOTO 10\nLMOVE q\n10 LMOVE p");
    let of = |text: &str| {
        let options = Options {
            given: Given::default(),
            ..given()
        };
        try_with(options, &[PLAIN], &[("t.as", text)]).expect("no tool is asked for")
    };
    let of_label = of(&text);
    assert_eq!(errors(&of_label), [""; 0]);
    let said = |done: &Compensation, what: &str| {
        let found = |f: &Finding| f.id == "target-unused-here" && f.message.contains(what);
        done.findings.iter().any(found)
    };
    assert!(said(&of_label, "nothing reaches go to q"));
    let text = program("CALL s(1)").replace(
        ".TRANS\n",
        ".PROGRAM s(.n)\nCASE .n OF\nVALUE 1:\nLMOVE p\nVALUE 2:\nLMOVE q\nEND\n.END\n.TRANS\n",
    );
    let of_case = of(&text);
    assert_eq!(errors(&of_case), [""; 0]);
    assert!(said(&of_case, "nothing reaches go to q"));
}

#[test]
fn approaches_with_several_elements_of_an_array_name_each() {
    let lines = "FOR .i = 1 TO 2\nBASE b[.i]\nLMOVE p\nEND";
    let text = program(lines).replace(
        ".TRANS\n",
        ".TRANS\nb[1] 0 0 0 0 0 0\nb[2] -120 90 0 0 0 0\n",
    );
    let found = done(&[PLAIN], &[("t.as", &text)]);
    let shared = message(&found, "target-shared");
    for name in ["b[1]", "b[2]"] {
        let part = format!("t.as line 7 with the work frame `{name}` of line 6");
        assert!(shared.contains(&part), "{shared}");
    }
}
