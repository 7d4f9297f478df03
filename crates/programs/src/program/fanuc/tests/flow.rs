//! Which tool and frame moves have, which moves there are, and what is refused.

use super::*;
use crate::program::Before;

const ACTIVE: &str = "UF : F, UT : F,\t\tCONFIG : 'N U T, 0, 0, 0',";

/// The tools of the moves to a point that names none.
fn tools(lines: &str) -> Vec<String> {
    tools_of(&[("a.ls", &listing(lines, &pose("1", ACTIVE)))])
}

pub(super) fn tools_of(files: &[(&str, &str)]) -> Vec<String> {
    let program = read_files(files).expect("a program");
    assert!(blocked(&program).is_empty(), "{files:?}");
    let moves = program
        .moves
        .iter()
        .filter(|motion| motion.target.is_some());
    let mut names: Vec<String> = moves
        .map(|motion| program.tools[motion.tool].name.clone())
        .collect();
    names.sort();
    names.dedup();
    names
}

#[test]
fn the_active_tool_is_the_one_that_the_program_selects() {
    for (lines, wanted) in [
        ("UTOOL_NUM=4 ;\nJ P[1] 100% FINE ;", vec!["4"]),
        (
            "UTOOL_NUM=4 ;\nLBL[1] ;\nJ P[1] 100% FINE ;\nJMP LBL[1] ;",
            vec!["4"],
        ),
        // nothing is selected: the user says what F is
        ("J P[1] 100% FINE ;", vec!["F"]),
        ("LBL[1] ;\nJ P[1] 100% FINE ;", vec!["F"]),
        (
            "UTOOL_NUM[GP1,GP2]= 4 ;\nUTOOL_NUM[GP2]=5 ;\nJ P[1] 100% FINE ;",
            vec!["4"],
        ),
        (
            "$MNUTOOLNUM[1]= 4 ;\n$MNUTOOLNUM[2]=1 ;\nJ P[1] 1% FINE ;",
            vec!["4"],
        ),
        (
            "UTOOL_NUM=4 ;\nLBL[1] ;\nJ P[1] 100% FINE ;\nUTOOL_NUM=5 ;\nJMP LBL[1] ;",
            vec!["4", "5"],
        ),
        (
            "UTOOL_NUM=4 ;\nIF (R[1]=1),UTOOL_NUM=5 ;\nJ P[1] 100% FINE ;",
            vec!["4", "5"],
        ),
        (
            "UTOOL_NUM=4 ;\nIF (R[1]=1) THEN ;\nUTOOL_NUM=5 ;\nENDIF ;\nJ P[1] 100% FINE ;",
            vec!["4", "5"],
        ),
        (
            "IF (R[1]=1) THEN ;\nUTOOL_NUM=5 ;\nELSE ;\nUTOOL_NUM=4 ;\nENDIF ;\nJ P[1] 1% FINE ;",
            vec!["4", "5"],
        ),
        (
            "SELECT R[1]=1,JMP LBL[1] ;\n       =2,JMP LBL[2] ;\n       ELSE,END ;\nLBL[1] \
             ;\nUTOOL_NUM=4 ;\nJMP LBL[3] ;\nLBL[2] ;\nUTOOL_NUM=5 ;\nLBL[3] ;\nJ P[1] 100% FINE ;",
            vec!["4", "5"],
        ),
        (
            "UTOOL_NUM=4 ;\nJMP LBL[R[1]] ;\nLBL[2] ;\nUTOOL_NUM=5 ;\nLBL[3] ;\nJ P[1] 100% FINE ;",
            vec!["4", "5"],
        ),
        (
            "UTOOL_NUM=4 ;\nWAIT DI[1]=ON TIMEOUT,LBL[2] ;\nUTOOL_NUM=5 ;\nLBL[2] ;\nJ P[1] 100% \
             FINE ;",
            vec!["4", "5"],
        ),
        (
            "UTOOL_NUM=4 ;\nFOR R[1]=1 TO 3 ;\nJ P[1] 100% FINE ;\nUTOOL_NUM=5 ;\nENDFOR ;",
            vec!["4", "5"],
        ),
        (
            "UTOOL_NUM=4 ;\nIF DI[1:FIN D'USINAGE]=ON,JMP LBL[2] ;\nUTOOL_NUM=5 ;\nLBL[2] ;\nJ \
             P[1] 100% FINE ;",
            vec!["4", "5"],
        ),
        // the controller keeps the number
        ("J P[1] 100% FINE ;\nUTOOL_NUM=4 ;", vec!["4", "F"]),
        ("UTOOL_NUM=4 ;\nEND ;\nJ P[1] 1% FINE ;", vec!["F"]),
        // a macro may select another: that matters where moves have more than one
        ("UTOOL_NUM=4 ;\nGRIP OPEN ;\nJ P[1] 100% FINE ;", vec!["4"]),
    ] {
        assert_eq!(tools(lines), wanted, "{lines}");
    }
    let program = read("UTOOL_NUM=R[1] ;\nJ P[1] 100% FINE ;", &pose("1", ACTIVE));
    assert_eq!(blocked(&program), ["P[1]"]);
    assert_eq!(ids(&program), ["frame-chosen-at-run-time"]);
}

#[test]
fn selections_last_across_calls_and_arguments_bind() {
    let main = |lines: &str| listing(lines, &pose("1", ACTIVE)).replace("TEST", "MAIN");
    let other = |lines: &str| listing(lines, "").replace("TEST", "OTHER");
    for (lines, called, wanted) in [
        ("CALL OTHER ;\nJ P[1] 1% FINE ;", "UTOOL_NUM=5 ;", vec!["5"]),
        (
            "UTOOL_NUM=4 ;\nCALL OTHER ;\nJ P[1] 1% FINE ;",
            "DO[1]=ON ;",
            vec!["4"],
        ),
        (
            "CALL OTHER(7) ;\nJ P[1] 1% FINE ;",
            "UTOOL_NUM=AR[1] ;",
            vec!["7"],
        ),
        (
            "IF R[1]=1,CALL OTHER(7) ;\nIF R[1]=2,CALL OTHER(8) ;\nJ P[1] 1% FINE ;",
            "UTOOL_NUM=AR[1] ;",
            vec!["7", "8", "F"],
        ),
        // next to it
        (
            "UTOOL_NUM=4 ;\nRUN OTHER ;\nJ P[1] 1% FINE ;",
            "UTOOL_NUM=5 ;",
            vec!["4", "5"],
        ),
    ] {
        let (a, b) = (main(lines), other(called));
        assert_eq!(tools_of(&[("a.ls", &a), ("b.ls", &b)]), wanted, "{lines}");
        assert_eq!(tools_of(&[("b.ls", &b), ("a.ls", &a)]), wanted, "{lines}");
    }
    // in both directions: the called program moves with what its caller selected
    let a = listing("UTOOL_NUM=4 ;\nCALL OTHER ;", "").replace("TEST", "MAIN");
    let b = listing("J P[1] 1% FINE ;", &pose("1", ACTIVE)).replace("TEST", "OTHER");
    assert_eq!(tools_of(&[("a.ls", &a), ("b.ls", &b)]), ["4"]);
}

#[test]
fn a_program_that_a_register_names_may_be_any_of_the_files() {
    let a = |lines: &str| listing(lines, &(pose("1", ACTIVE) + &usual("2"))).replace("TEST", "A");
    let b = listing("UTOOL_NUM=5 ;", "").replace("TEST", "B");
    let idle = listing("DO[1]=ON ;", "").replace("TEST", "B");
    for call in [
        "CALL SR[1]",
        "CALL AR[1]",
        "CALL PROG[R[1]](4)",
        "IF R[1]=1,CALL SR[1:which]",
        "J P[2] 1% FINE TB .10sec,CALL SR[1]",
        "RUN SR[1]",
    ] {
        let a = a(&format!("UTOOL_NUM=4 ;\n{call} ;\nJ P[1] 1% FINE ;"));
        let program = read_files(&[("a.ls", &a), ("b.ls", &b)]).expect("a program");
        let names = program.tools.iter().map(|tool| &*tool.name);
        let is_known = blocked(&program).is_empty();
        assert!(!is_known || names.eq(["4", "5"]), "{call}: {program:?}");
        // one that selects nothing leaves the tool as it is
        if !call.starts_with('J') {
            let a = listing(
                &format!("UTOOL_NUM=4 ;\n{call} ;\nJ P[1] 1% FINE ;"),
                &pose("1", ACTIVE),
            );
            let program = read_files(&[("a.ls", &a), ("b.ls", &idle)]).expect("a program");
            assert_eq!(ids(&program), [""; 0], "{call} {:?}", program.findings);
        }
    }
}

#[test]
fn what_a_move_calls_on_its_way_comes_some_time_later() {
    let b = listing("UTOOL_NUM=5 ;", "").replace("TEST", "B");
    for when in ["TA .50sec", "TB    .10sec", "DB 30.0mm"] {
        let lines = format!("UTOOL_NUM=4 ;\nL P[1] 9mm/sec FINE {when},CALL B ;\nJ P[1] 1% FINE ;");
        let a = listing(&lines, &pose("1", ACTIVE)).replace("TEST", "A");
        assert_eq!(
            tools_of(&[("a.ls", &a), ("b.ls", &b)]),
            ["4", "5"],
            "{when}"
        );
    }
}

#[test]
fn of_two_programs_with_one_name_either_is_called() {
    let a = listing("CALL B ;\nJ P[1] 1% FINE ;", &pose("1", ACTIVE)).replace("TEST", "A");
    let b = |number: u32| listing(&format!("UTOOL_NUM={number} ;"), "").replace("TEST", "B");
    let all = [("a.ls", &*a), ("b.ls", &b(5)), ("c/b.ls", &b(6))];
    assert_eq!(tools_of(&all), ["5", "6"]);
}

#[test]
fn a_number_that_has_just_been_written_selects_a_tool() {
    for lines in [
        "R[1]=5 ;\nUTOOL_NUM=R[1:grip] ;\nJ P[1] 1% FINE ;",
        "R[1]=4 ;\nUTOOL_NUM=R[1]+1 ;\nJ P[1] 1% FINE ;",
        "LR[1]=5 ;\nUTOOL_NUM=LR[1] ;\nJ P[1] 1% FINE ;",
    ] {
        assert_eq!(tools(lines), ["5"], "{lines}");
    }
    for lines in [
        "R[1]=5 ;\nCALL X ;\nUTOOL_NUM=R[1] ;\nJ P[1] 1% FINE ;",
        "R[1]=5.5 ;\nUTOOL_NUM=R[1] ;\nJ P[1] 1% FINE ;",
        "R[1]=5 ;\nUTOOL_NUM=LR[1] ;\nJ P[1] 1% FINE ;",
    ] {
        let program = read(lines, &pose("1", ACTIVE));
        assert_eq!(ids(&program), ["frame-chosen-at-run-time"], "{lines}");
    }
}

#[test]
fn several_loads_are_reported_once() {
    let go = "J P[1] 1% FINE ;\n";
    for (lines, wanted) in [
        (format!("PAYLOAD[1] ;\n{go}PAYLOAD[1:grip] ;\n{go}"), vec![]),
        (
            format!("PAYLOAD[GP2:1] ;\n{go}PAYLOAD[GP1:2] ;\n{go}"),
            vec![],
        ),
        (
            format!("PAYLOAD[1] ;\n{go}PAYLOAD[2] ;\n{go}PAYLOAD[3] ;\n{go}"),
            vec![("load-chosen-at-run-time", 7)],
        ),
        (
            format!("PAYLOAD[R[1]] ;\n{go}"),
            vec![("load-chosen-at-run-time", 5)],
        ),
    ] {
        let program = read(&lines, &usual("1"));
        let found = program.findings.iter();
        let found: Vec<_> = found.map(|found| (found.id, found.line)).collect();
        assert_eq!(found, wanted, "{lines}");
    }
}

#[test]
fn a_macro_between_moves_of_two_tools_is_uncertain() {
    let lines = "J P[2] 1% FINE ;\nUTOOL_NUM=4 ;\nGRIP OPEN ;\nJ P[1] 1% FINE ;";
    let program = read(lines, &(pose("1", ACTIVE) + &usual("2")));
    assert_eq!(blocked(&program), ["P[1]"]);
    assert!(ids(&program).contains(&"frame-chosen-at-run-time"));
}

#[test]
fn a_point_taught_with_another_number_than_is_selected_is_a_warning() {
    let lines = "UFRAME_NUM=2 ;\nUTOOL_NUM=4 ;\nJ P[1] 100% FINE ;\nL P[1] 9mm/sec FINE ;";
    let program = read(lines, &usual("1"));
    assert_eq!(ids(&program), ["frame-number-differs"]);
    let found = &program.findings[0];
    assert_eq!((found.line, found.severity), (6, Severity::Warning));
    assert!(blocked(&program).is_empty());
    // where it is not certain nothing is said
    for lines in [
        "UTOOL_NUM=4 ;\nGRIP OPEN ;\nJ P[1] 1% FINE ;",
        "UTOOL_NUM=4 ;\nIF R[1]=1,UTOOL_NUM=1 ;\nJ P[1] 1% FINE ;",
        "J P[1] 1% FINE ;",
    ] {
        assert_eq!(ids(&read(lines, &usual("1"))), [""; 0], "{lines}");
    }
}

#[test]
fn tools_and_frames_assigned_at_run_time_block_their_users() {
    let points = usual("1") + &pose("2", "UF : 6, UT : 0, CONFIG : 'N U T, 0, 0, 0',");
    let moves = "J P[1] 100% FINE ;\nJ P[2] 100% FINE ;";
    for (assignment, wanted) in [
        ("UFRAME[6]=PR[60] ;", vec!["P[2]"]),
        ("UTOOL[1:grip]=PR[9] ;", vec!["P[1]"]),
        ("UTOOL[R[2]]=PR[9] ;", vec!["P[1]"]),
        ("$MNUTOOL[1,1]=PR[9] ;", vec!["P[1]"]),
        ("$MNUFRAME[1,2]=PR[9] ;", vec!["P[1]"]),
        ("UFRAME[GP1:6]=PR[60] ;", vec!["P[2]"]),
        ("XYZ[6]=PR[60] ;", vec!["P[2]"]),
        ("UFRAME[GP2:6]=PR[60] ;", vec![]),
        ("UFRAME[9]=PR[60] ;", vec![]),
    ] {
        // before the moves, and after them: the controller keeps it
        for lines in [
            format!("{assignment}\n{moves}"),
            format!("{moves}\n{assignment}"),
        ] {
            let program = read(&lines, &points);
            assert_eq!(blocked(&program), wanted, "{lines}");
            let all = ids(&program);
            assert!(
                all.iter().all(|id| *id == "frame-assigned-at-run-time"),
                "{all:?}"
            );
        }
        // in a program that nothing calls: the declaration holds
        let other = listing(assignment, "").replace("TEST", "OTHER");
        let text = listing(moves, &points);
        let program = read_files(&[("a.ls", &text), ("b.ls", &other)]).expect("a program");
        assert!(blocked(&program).is_empty(), "{assignment}");
        assert!(ids(&program).iter().all(|id| *id == "write-not-called"));
        let text = listing(&format!("CALL OTHER ;\n{moves}"), &points);
        let program = read_files(&[("a.ls", &text), ("b.ls", &other)]).expect("a program");
        assert_eq!(blocked(&program), wanted, "called: {assignment}");
    }
}

#[test]
fn moves_that_cannot_be_compensated_are_errors() {
    for (line, id) in [
        ("L P[1] 9mm/sec FINE INC ;", "relative-move"),
        ("L P[1] 9mm/sec FINE RTCP ;", "stationary-tool"),
        (
            "L P[1] 9mm/sec CNT100 COORD PTH ;",
            "group-without-geometry",
        ),
        ("L P[9] 9mm/sec FINE ;", "target-not-in-files"),
        ("GOTO_P P[1],5 ;", "target-passed-to-routine"),
    ] {
        let program = read(line, &usual("1"));
        let error = program
            .findings
            .iter()
            .find(|f| f.severity == Severity::Error);
        assert_eq!(error.map(|f| f.id), Some(id), "{line}");
        assert_eq!(blocked(&program), ["P[1]"], "{line}");
    }
    let tracking = listing("L P[1] 9mm/sec FINE ;", &usual("1")).replace(
        "/MN",
        "/APPL\n  LINE_TRACK;\n    LINE_TRACK_SCHEDULE_NUMBER      : 1;\n/MN",
    );
    let program = read_files(&[("a.ls", &tracking)]).expect("a program");
    assert_eq!(ids(&program), ["moving-frame"]);
    let program = read_files(&[("a.ls", &tracking.replace(": 1;", ": 0;"))]).expect("a program");
    assert_eq!(program.findings, []);
}

#[test]
fn every_move_of_the_text_is_a_move() {
    let lines = "J P[2] 1% FINE ;\nJ PR[1] 1% FINE ;\nL PAL_1[BTM] 9mm/sec FINE ;\nL P[9] 9mm/sec \
        FINE ;\nIF R[1]=1,L P[1] 9mm/sec FINE ;\nL @P[2] 9mm/sec FINE ;";
    let program = read(lines, &(usual("1") + &usual("2")));
    let to: Vec<Option<usize>> = program.moves.iter().map(|m| m.target).collect();
    assert_eq!(to, [Some(1), None, None, None, Some(0), Some(1)]);
    // the last comes from the fourth, or from the fifth
    let before = program.before(&program.moves[5]);
    assert_eq!(before, [Before::One(3), Before::One(4)]);
}

#[test]
fn a_skipped_move_ends_at_its_point_or_nobody_knows_where() {
    let lines = "L P[1] 9mm/sec FINE Skip,LBL[1],PR[3]=LPOS ;\nL P[2] 9mm/sec FINE ;\nEND \
        ;\nLBL[1] ;\nL P[3] 9mm/sec FINE ;";
    let program = read(lines, &(usual("1") + &usual("2") + &usual("3")));
    let to: Vec<Option<usize>> = program.moves.iter().map(|m| m.target).collect();
    assert_eq!(to, [Some(0), None, Some(1), Some(2)]);
    assert_eq!(program.moves[2].before, Before::One(1));
    assert_eq!(program.moves[3].before, Before::One(0));
    assert_eq!(program.findings, []);
}

#[test]
fn rows_of_arcs_start_with_a_straight_line() {
    let points: String = (1..=5).map(|k| usual(&k.to_string())).collect();
    let lines = "A P[1] 9mm/sec FINE ;\nA P[2] 9mm/sec FINE ;\nWAIT 1.0(sec) ;\nA P[3] 9mm/sec \
        FINE ;\nC P[4]\n : P[5] 9mm/sec FINE ;";
    let program = read(lines, &points);
    let motions: Vec<Motion> = program.moves.iter().map(|used| used.motion).collect();
    use Motion::{ArcEnd, ArcVia, Linear, Spline};
    assert_eq!(motions, [Linear, ArcVia, ArcEnd, ArcVia, ArcEnd]);
    // of other numbers than three the controller alone knows the curve
    for count in [2, 4, 5] {
        let lines: String = (1..=count)
            .map(|k| format!("A P[{k}] 9mm/sec FINE ;\n"))
            .collect();
        let program = read(&lines, &points);
        let motions = program.moves.iter().map(|used| used.motion);
        let expected = std::iter::once(Linear).chain(std::iter::repeat_n(Spline, count - 1));
        assert!(motions.eq(expected), "{count}");
    }
}

#[test]
fn moves_have_configuration_data_but_where_the_orientation_is_free() {
    let lines = "J P[1] 1% FINE ;\nL P[1] 9mm/sec FINE ;\nL P[1] 9mm/sec FINE Wjnt ;";
    let program = read(lines, &usual("1"));
    let flags = program
        .moves
        .iter()
        .map(|m| (m.configured, m.free_orientation));
    assert!(flags.eq([(true, false), (true, false), (false, true)]));
}

#[test]
fn axes_besides_the_six_are_an_error_where_they_are_used() {
    let extended = usual("1").replace("-.287 deg", "-.287 deg,\n\tE1=  -345.000  mm");
    let program = read("J P[1] 100% FINE ;", &extended);
    assert_eq!(ids(&program), ["external-axis-unknown"]);
    assert_eq!(blocked(&program), ["P[1]"]);
    assert_eq!(values(&program, 0).len(), 12);
    let zero = extended.replace("-345.000", "0.000");
    assert_eq!(read("J P[1] 100% FINE ;", &zero).findings, []);
}

#[test]
fn moves_that_a_sensor_corrects_are_reported_once_a_place() {
    for (begin, end) in [
        ("Touch Offset PR[1]", "Touch Offset End"),
        ("Search Start[1] PR[1]", "Search End"),
        ("Track TAST[1]", "Track End"),
        ("MP Offset PR[1] RPM[1]", "MP Offset End"),
    ] {
        let lines = format!(
            "L P[1] 9mm/sec FINE ;\n{begin} ;\nL P[1] 9mm/sec FINE ;\nL P[2] 9mm/sec FINE ;\n{end} \
             ;\nL P[2] 9mm/sec FINE ;"
        );
        let program = read(&lines, &(usual("1") + &usual("2")));
        assert_eq!(ids(&program), ["corrected-by-sensor"], "{begin}");
        let found = &program.findings[0];
        assert_eq!((found.line, found.severity), (6, Severity::Warning));
        assert!(blocked(&program).is_empty());
        // it lasts across calls, and the end of it does
        let ended = read(
            &format!("{begin} ;\n{end} ;\nL P[1] 9mm/sec FINE ;"),
            &usual("1"),
        );
        assert_eq!(ended.findings, []);
    }
    let a = listing("Track TAST[1] ;\nCALL OTHER ;\nTrack End ;", "").replace("TEST", "MAIN");
    let b = listing("L P[1] 9mm/sec FINE ;", &usual("1")).replace("TEST", "OTHER");
    let program = read_files(&[("a.ls", &a), ("b.ls", &b)]).expect("a program");
    assert_eq!(ids(&program), ["corrected-by-sensor"]);
}

#[test]
fn offsets_of_moves_are_known_at_run_time_only() {
    let lines = "OFFSET CONDITION PR[1] ;\nL P[1] 9mm/sec FINE Offset ;\nL P[1] 9mm/sec FINE ;";
    let program = read(lines, &usual("1"));
    let displaced = program
        .moves
        .iter()
        .map(|m| m.displacement == Displacement::Unknown);
    assert!(displaced.eq([true, false]));
    assert_eq!(program.findings, []);
}

#[test]
fn comments_remarks_and_strings_are_no_instructions() {
    let lines = "  1:  !L P[1] 40mm/sec FINE ;\n  2:  --eg:L P[1] 40mm/sec FINE ;\n  3:  //C \
        P[1]\n    :  P[1] 40mm/sec FINE ;\n  4:  MESSAGE[L P[1] now] ;\n  5:  CALL LOG('P[1]') \
        ;\n   : ;\n  6:J P[1] 1% FINE ;\n  7:  ! no end\n";
    let program = read(lines, &usual("1"));
    assert_eq!((program.moves.len(), program.findings.len()), (1, 0));
}

#[test]
fn blocks_inside_moves_are_read_as_instructions() {
    let lines = "   5:J P[2] 100% CNT0 ACC100 TB    .10sec,P-SPS    ;\n      1:  TC_ONLINE (ON) \
        ;\n      2:  UTOOL_NUM=3 ;\n       ------ ;\n   6:J P[1] 100% CNT100 ;\n";
    let text = listing(lines, &(pose("1", ACTIVE) + &pose("2", ACTIVE)));
    let program = read_files(&[("a.ls", &text)]).expect("a program");
    let last = program.moves.last().expect("moves");
    assert_eq!(program.tools[last.tool].name, "3");
}

#[test]
fn options_behind_the_middle_of_an_arc_do_not_hide_its_end() {
    let points: String = ["1", "2", "3"].map(usual).concat();
    let arc = |middle: &str, end: &str| {
        let text = format!("J P[1] 1% FINE ;\nC P[2]{middle}\n    :  P[3] 9mm/sec FINE{end} ;");
        read(&text, &points)
    };
    for (middle, end, displaced) in [
        ("", "", [false, false]),
        (" Offset,PR[5]", "", [true, false]),
        (" Tool_Offset,PR[5]", " Offset,PR[6]", [true, true]),
        ("", " Offset,PR[5]", [true, true]),
        (" ACC50", "", [false, false]),
        (" Offset,\n    :  PR[5]", "", [true, false]),
    ] {
        let program = arc(middle, end);
        let found: Vec<_> = program
            .moves
            .iter()
            .map(|of| {
                let target = of.target.and_then(|of| program.targets[of].name.as_deref());
                (target, of.displacement != Displacement::None)
            })
            .collect();
        let wanted = [
            (Some("P[1]"), false),
            (Some("P[2]"), displaced[0]),
            (Some("P[3]"), displaced[1]),
        ];
        assert_eq!(found, wanted, "{middle}|{end}: {:?}", program.findings);
    }
}

#[test]
fn a_macro_is_the_program_of_its_name_where_the_files_have_one() {
    let main = listing(
        "UTOOL_NUM=4 ;\nOPEN_HAND ;\nJ P[1] 1% FINE ;",
        &pose("1", ACTIVE),
    );
    let hand = |line: &str| listing(line, "").replace("/PROG  TEST", "/PROG  OPEN_HAND");
    for (line, found) in [
        ("UTOOL_NUM=5 ;", &["frame-chosen-at-run-time"][..]),
        ("RO[1]=ON ;", &[]),
    ] {
        let files = [("a.ls", main.as_str()), ("open_hand.ls", &hand(line))];
        let program = read_files(&files).expect("programs");
        assert_eq!(ids(&program), found, "{line}");
    }
}
