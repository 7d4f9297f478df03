//! KRL programs whose thin reading lands elsewhere: what each means, or that it is refused with
//! both places.

use super::{BACKLASH, PLAIN, done, errors, message};
use poseshift::compensate::Compensation;
use poseshift::finding::Severity;

/// Joint 2 gives way under the load.
const SOFT: &str = "{effect: joint_compliance, joint: 2, rad_per_n_m: 3.2e-5}";
/// Joint 5 is off: by the side of the wrist, to the other side.
const WRIST: &str = "{effect: link_geometry, link: 5, theta_deg: 0.1}";
/// A posture with the wrist on one side, and one with it on the other.
const UP: &str = "PTP {A1 0,A2 -20,A3 40,A4 -30,A5 70,A6 -60}\n";
const FLIPPED: &str = "PTP {A1 0,A2 -20,A3 40,A4 150,A5 -70,A6 120}\n";
/// Within the ranges of both.
const BOTH: &str = "LIN {X 225.0,Y -34,Z 440.0,A -112,B -25,C -167}\n";
const NEAR: &str = "LIN {X 420.0,Y 0,Z 430.0,A 160,B 20,C 180}\n";
const JOINT_MOVE: &str = "PTP {X 420.0,Y 0,Z 430.0,A 160,B 20,C 180}\n";

/// A module with a tool and a base, these statements, and whatever routines stand behind them.
fn module(body: &str) -> String {
    format!("DEF t()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\n{body}END\n")
}

fn plain(body: &str) -> Compensation {
    done(&[PLAIN], &[("t.src", &module(body))])
}

/// On which side the wrist is at each target.
fn sides(done: &Compensation) -> Vec<f64> {
    let joints = done.targets.iter().filter_map(|target| target.q);
    joints.map(|q| q[4].signum()).collect()
}

/// The findings of one id, with their severity and line.
fn found(done: &Compensation, id: &str) -> Vec<(Severity, usize)> {
    let of = done.findings.iter().filter(|finding| finding.id == id);
    of.map(|finding| (finding.severity, finding.line)).collect()
}

#[test]
fn a_called_routine_begins_in_the_posture_of_its_caller_and_gives_its_own_back() {
    // row f
    for (body, side) in [
        (format!("{UP}{BOTH}"), 1.0),
        (format!("{FLIPPED}{BOTH}"), -1.0),
        (format!("{UP}go()\nEND\nDEF go()\n{BOTH}"), 1.0),
        (format!("{FLIPPED}go()\nEND\nDEF go()\n{BOTH}"), -1.0),
        (format!("{FLIPPED}go()\n{BOTH}END\nDEF go()\n{UP}"), 1.0),
        (format!("{UP}go()\n{BOTH}END\nDEF go()\n{FLIPPED}"), -1.0),
    ] {
        let done = plain(&body);
        assert_eq!(errors(&done), [""; 0], "{body}{:?}", done.findings);
        assert_eq!(sides(&done), [side], "{body}");
    }
}

#[test]
fn axes_that_turn_from_where_the_robot_is_carry_its_posture() {
    for (body, side) in [
        (format!("{FLIPPED}PTP {{A4 -30,A5 70,A6 -60}}\n{BOTH}"), 1.0),
        (format!("{UP}PTP {{A1 5}}\n{BOTH}"), 1.0),
        (format!("{FLIPPED}PTP_REL {{A1 5}}\n{BOTH}"), -1.0),
        (
            format!("{FLIPPED}SPTP_REL {{A4 -180,A5 140,A6 -180}}\n{BOTH}"),
            1.0,
        ),
        (
            format!("{UP}PTP_REL {{A4 90}}\nPTP_REL {{A4 90,A5 -140,A6 180}}\n{BOTH}"),
            -1.0,
        ),
    ] {
        let done = plain(&body);
        assert_eq!(errors(&done), [""; 0], "{body}{:?}", done.findings);
        assert_eq!(sides(&done), [side], "{body}");
    }
    // on and on
    let done = plain(&format!("{UP}LOOP\nPTP_REL {{A6 0.5}}\nENDLOOP\n"));
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
    // the others are not known
    for body in [
        format!("PTP {{A4 -30,A5 70,A6 -60}}\n{BOTH}"),
        format!("{UP}away()\nPTP {{A1 5}}\n{BOTH}"),
        format!("{UP}PTP_REL off\n{BOTH}"),
    ] {
        let done = plain(&body);
        assert_ne!(
            done.findings
                .iter()
                .filter(|f| f.severity >= Severity::Warning)
                .count(),
            0
        );
        let ids: Vec<_> = done.findings.iter().map(|finding| finding.id).collect();
        let is_said = ids.contains(&"posture-assumed") || ids.contains(&"configuration-unknown");
        assert!(is_said, "{body}{ids:?}");
    }
}

#[test]
fn a_routine_that_is_called_in_two_postures_is_judged_in_both() {
    // row f
    let done = done(
        &[WRIST],
        &[(
            "t.src",
            &module(&format!("{UP}go()\n{FLIPPED}go()\nEND\nDEF go()\n{BOTH}")),
        )],
    );
    assert_eq!(errors(&done), ["target-shared"], "{:?}", done.findings);
    let reported = message(&done, "target-shared");
    assert!(
        reported.contains("2 approaches that differ in posture"),
        "{reported}"
    );
}

/// How far the tool lands from where it is wanted without correction, mm, with a tool and load set
/// so; and what is found.
fn sagging(set: &str) -> (f64, Vec<(Severity, usize)>) {
    let config = "DEFDAT $CONFIG\nFRAME TOOL_DATA[16]\nTOOL_DATA[1]={X 0,Y 0,Z 50,A 0,B 0,C \
        0}\nLOAD LOAD_DATA[16]\n\
        LOAD_DATA[1]={M 3.0,CM {X 0,Y 0,Z 40,A 0,B 0,C 0},J {X 0,Y 0,Z 0}}\n\
        LOAD_DATA[2]={M 1.0,CM {X 0,Y 0,Z 40,A 0,B 0,C 0},J {X 0,Y 0,Z 0}}\nENDDAT\n";
    let text = format!("DEF t()\n$BASE=$WORLD\n{set}\n{UP}{NEAR}END\n");
    let done = done(&[SOFT], &[("t.src", &text), ("$config.dat", config)]);
    assert_eq!(errors(&done), [""; 0], "{set}");
    (
        done.targets[1].before.expect("known").distance_m * 1e3,
        found(&done, "load-chosen-at-run-time"),
    )
}

#[test]
fn a_tool_that_is_written_out_keeps_the_load_that_was_set() {
    // row g
    let written = "$TOOL={X 0,Y 0,Z 50,A 0,B 0,C 0}";
    let (none, _) = sagging(written);
    let (heavy, _) = sagging("BAS(#TOOL,1)");
    let (light, _) = sagging("BAS(#TOOL,1)\n$LOAD=LOAD_DATA[2]");
    assert!(
        none + 0.02 < light && light + 0.02 < heavy,
        "{none} {light} {heavy}"
    );
    for set in [
        format!("BAS(#TOOL,1)\n{written}"),
        format!("$LOAD=LOAD_DATA[1]\n{written}"),
        format!("{written}\n$LOAD=LOAD_DATA[1]"),
        format!("{written}\n$LOAD={{M 3.0,CM {{X 0,Y 0,Z 40,A 0,B 0,C 0}},J {{X 0,Y 0,Z 0}}}}"),
        "$LOAD=LOAD_DATA[2]\nBAS(#TOOL,1)".to_owned(),
    ] {
        let (sag, reported) = sagging(&set);
        assert!((sag - heavy).abs() < 1e-9, "{set}: {sag} {heavy}");
        assert_eq!(reported, [], "{set}");
    }
}

#[test]
fn a_load_that_the_text_does_not_tell_is_said() {
    // row g
    for (set, line) in [
        ("BAS(#TOOL,1)\n$LOAD.M=2", 4),
        ("BAS(#TOOL,1)\n$LOAD=LOAD_DATA[n]", 4),
        ("BAS(#TOOL,1)\n$LOAD={M m1,CM {X 0,Y 0,Z 40}}", 4),
        ("LOAD_DATA[1].M=2\nBAS(#TOOL,1)", 3),
    ] {
        let (_, reported) = sagging(set);
        assert_eq!(reported, [(Severity::Warning, line)], "{set}");
    }
}

/// A program with base 1 of a $config.dat.
fn in_base(body: &str) -> Compensation {
    let config =
        "DEFDAT $CONFIG\nFRAME BASE_DATA[16]\nBASE_DATA[1]={X 0,Y 0,Z 0,A 0,B 0,C 0}\nENDDAT\n";
    let text = format!("DEF t()\n$TOOL=$NULLFRAME\n{body}END\n");
    done(&[PLAIN], &[("t.src", &text), ("$config.dat", config)])
}

/// Where the frame of each move is, mm along x.
fn frames(done: &Compensation) -> Vec<f64> {
    let frames = done
        .program
        .moves
        .iter()
        .map(|motion| &done.program.frames[motion.frame]);
    frames
        .map(|frame| (frame.world_from_frame.expect("known").translation[0] * 1e3).round())
        .collect()
}

#[test]
fn a_base_that_is_written_in_a_branch_is_refused_with_both_places() {
    // row h
    for write in [
        "BASE_DATA[1]={X 20,Y 0,Z 0,A 0,B 0,C 0}",
        "BASE_DATA[1].X=20",
    ] {
        for select in ["$BASE=BASE_DATA[1]", "BAS(#BASE,1)"] {
            let done = in_base(&format!("IF $IN[1] THEN\n{write}\nENDIF\n{select}\n{NEAR}"));
            assert_eq!(errors(&done), ["target-shared"], "{write}");
            let reported = message(&done, "target-shared");
            // the write, and where the declared one is selected
            assert!(
                reported.contains("work frame of line 4")
                    && reported.contains("work frame of line 6"),
                "{reported}"
            );
        }
    }
}

#[test]
fn a_base_that_is_written_behind_the_move_is_that_of_the_next_run() {
    // row h
    let write = "BASE_DATA[1].X=20\n";
    let select = "BAS(#BASE,1)\n";
    let behind = in_base(&format!("{select}{NEAR}{write}"));
    assert_eq!(errors(&behind), ["target-shared"]);
    let reported = message(&behind, "target-shared");
    assert!(
        reported.contains("work frame of line 3") && reported.contains("work frame of line 5"),
        "{reported}"
    );
    let before = in_base(&format!("{write}{select}{NEAR}"));
    assert_eq!(errors(&before), [""; 0]);
    assert_eq!(frames(&before), [20.0]);
}

#[test]
fn a_base_that_is_written_where_nothing_calls_stays_as_declared() {
    // row h
    let done = in_base(&format!(
        "BAS(#BASE,1)\n{NEAR}END\nDEF setup()\nBASE_DATA[1]={{X 20,Y 0,Z 0,A 0,B 0,C 0}}\n"
    ));
    assert_eq!(errors(&done), [""; 0]);
    assert_eq!(found(&done, "write-not-called"), [(Severity::Warning, 7)]);
    assert!(message(&done, "write-not-called").contains("BASE_DATA[1]"));
    assert_eq!(frames(&done), [0.0]);
}

#[test]
fn external_axes_in_use_are_refused_until_they_are_described() {
    // row i
    let one = |e: &str| {
        let done = plain(&format!("{UP}{}\n", NEAR.trim_end().replace('}', e)));
        (errors(&done), done.summary.compensated)
    };
    assert_eq!(one("}"), (vec![], 1));
    assert_eq!(one(",E1 0.0,E2 0}"), (vec![], 1));
    assert_eq!(one(",E1 9E+09}"), (vec![], 1));
    assert_eq!(one(",E1 1800.0}"), (vec!["external-axis-unknown"], 0));
    assert_eq!(one(",E1 -1800.0}"), (vec!["external-axis-unknown"], 0));
}

#[test]
fn arcs_to_an_angle_are_refused() {
    // row m
    let arc = "CIRC {X 420,Y 30,Z 430,A 160,B 20,C 180},{X 420,Y 60,Z 400,A 160,B 20,C 180}";
    let whole = plain(&format!("{UP}{NEAR}{arc}\n"));
    assert_eq!(errors(&whole), [""; 0], "{:?}", whole.findings);
    assert_eq!(whole.summary.compensated, 3);
    let angle = plain(&format!("{UP}{NEAR}{arc},CA 180\n"));
    // the points of the arc, and nothing else
    assert_eq!(found(&angle, "circular-angle"), [(Severity::Error, 6); 2]);
}

#[test]
fn a_move_to_axes_that_nobody_knows_is_a_move() {
    // row n: the posture before it is none of the move behind it, nor is the side from which the
    // joints came
    for unknown in ["PTP XHOME", "PTP_REL {A5 140}", "PTP $AXIS_RET"] {
        let done = plain(&format!("{FLIPPED}{unknown}\n{NEAR}"));
        assert_eq!(errors(&done), [""; 0]);
        assert_eq!(sides(&done), [1.0], "{unknown}");
        assert_eq!(done.program.moves.len(), 3, "{unknown}");
    }
    // to where it is it does not go
    let here = plain(&format!("{FLIPPED}PTP $AXIS_ACT\n{NEAR}"));
    assert_eq!(sides(&here), [-1.0]);
    let direction = |between: &str| {
        let from = "PTP {A1 0,A2 60,A3 -10,A4 -30,A5 70,A6 -60}\n";
        let text = module(&format!("{from}{between}{JOINT_MOVE}"));
        let done = done(&[BACKLASH], &[("t.src", &text)]);
        done.targets[1].q.expect("solved")[1]
    };
    let down = direction("");
    let unknown = direction("PTP XHOME\n");
    assert!((down - unknown).abs() > 1e-4, "{down} {unknown}");
}

#[test]
fn positions_are_bound_to_parameters_by_value_and_by_reference() {
    let data = "DEFDAT T\nDECL E6POS XP1={X 420.0,Y 0,Z 430.0,A 160,B 20,C 180,S 2,T 0}\n\
        DECL E6POS XP2={X 420.0,Y 50,Z 430.0,A 160,B 20,C 180,S 2,T 0}\nENDDAT\n";
    for manner in ["IN", "OUT"] {
        let body = format!("{UP}rm(XP1)\nrm(XP2)\nEND\nDEF rm(p:{manner})\nDECL E6POS p\nLIN p\n");
        let done = done(&[PLAIN], &[("t.src", &module(&body)), ("t.dat", data)]);
        assert_eq!(errors(&done), [""; 0], "{manner}: {:?}", done.findings);
        assert_eq!(done.summary.compensated, 2, "{manner}");
    }
    // what a routine writes comes back by reference alone
    for (manner, expected) in [("IN", vec![]), ("OUT", vec!["target-assigned-at-run-time"])] {
        let body = format!(
            "{UP}LIN XP1\nup(XP1)\nLIN XP1\nEND\nDEF up(p:{manner})\nDECL E6POS p\np.Z=p.Z+100\n"
        );
        let done = done(&[PLAIN], &[("t.src", &module(&body)), ("t.dat", data)]);
        assert_eq!(errors(&done), expected, "{manner}: {:?}", done.findings);
    }
}

#[test]
fn positions_that_the_robot_reported_itself_stay_with_a_note() {
    for reported in ["$POS_ACT", "$AXIS_ACT"] {
        let kind = if reported == "$POS_ACT" {
            "E6POS"
        } else {
            "E6AXIS"
        };
        let body = format!("DECL {kind} here\n{UP}here={reported}\n{NEAR}PTP here\n");
        let done = plain(&body);
        assert_eq!(errors(&done), [""; 0], "{reported}: {:?}", done.findings);
        assert_eq!(found(&done, "run-time-position"), [(Severity::Note, 8)]);
        assert_eq!(done.summary.compensated, 1);
    }
}

#[test]
fn what_an_fdat_says_besides_tool_and_frame_changes_nothing() {
    let data = "DEFDAT T\nDECL FDAT FP1={TOOL_NO 1,BASE_NO 0,IPO_FRAME #BASE,POINT2[] \" \",\
        TQ_STATE FALSE}\nDECL E6POS XP1={X 420.0,Y 0,Z 430.0,A 160,B 20,C 180,S 2,T 0}\nENDDAT\n";
    let run = |write: &str| {
        let body = format!(
            "{UP}other()\nFDAT_ACT=FP1\nBAS(#PTP_PARAMS,100)\nPTP XP1\nEND\nDEF other()\n{write}\n"
        );
        errors(&done(
            &[PLAIN],
            &[("t.src", &module(&body)), ("t.dat", data)],
        ))
    };
    assert_eq!(run("FP1.TQ_STATE = TRUE"), [""; 0]);
    assert_eq!(run("FP1.POINT2[] = \"XP1\""), [""; 0]);
    assert_eq!(run("FP1.TOOL_NO = n"), ["frame-chosen-at-run-time"]);
}
