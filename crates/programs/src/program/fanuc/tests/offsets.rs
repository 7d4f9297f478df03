//! What offsets of moves come to.

use super::*;

/// All numbers of a register are nothing.
const ZERO: &str = "PR[7]=LPOS ;\nPR[7]=PR[7]-PR[7] ;\n";
const GO: &str = "L P[1] 9mm/sec FINE Offset,PR[7] ;\n";

/// What displaces the point of the last move.
fn last(files: &[(&str, &str)]) -> Displacement {
    let program = read_files(files).expect("a program");
    program.moves.last().expect("a move").displacement.clone()
}

fn of(lines: &str) -> Displacement {
    last(&[("a.ls", &listing(lines, &usual("1")))])
}

fn up(by: f64) -> Displacement {
    Displacement::By(Box::new(Shift::along([0.0, 0.0, by])))
}

/// The least and the greatest along z, of what the text tells all.
fn between(displacement: &Displacement) -> Option<[f64; 2]> {
    let Displacement::Within(strides) = displacement else {
        return None;
    };
    let mut ends = [0.0, 0.0];
    for stride in strides {
        let Stride::By { shift, most } = stride else {
            return None;
        };
        let by = shift.in_frame.translation[2] * f64::from((*most)?);
        ends[usize::from(by > 0.0)] += by;
    }
    Some(ends)
}

#[test]
fn what_was_written_last_counts() {
    let far = "PR[7,3]=300 ;\n";
    for lines in [
        format!("{ZERO}PR[7,3:z]=100 ;\n{GO}"),
        format!("{far}{GO}{ZERO}PR[7,3]=100 ;\n{GO}{far}"),
        format!("{ZERO}PR[7,3]=40 ;\nPR[7,3]=PR[7,3]*2+20 ;\n{GO}{far}"),
        format!("{ZERO}R[1]=40 ;\nR[2]=R[1] ;\nR[1]=999 ;\nPR[7,3]=(R[2]+R[2])+20 ;\n{GO}{far}"),
        format!("{ZERO}R[1]=11 DIV 2 ;\nPR[7,3]=R[1]*20 ;\n{GO}"),
    ] {
        assert_eq!(of(&lines), up(0.1), "{lines}");
    }
    assert_eq!(of(&format!("{ZERO}{GO}")), Displacement::None);
}

#[test]
fn names_of_registers_and_points_may_have_any_letters() {
    for name in ["z;", "z[", "z[1]", "it's", "z,1", "a;b[c"] {
        let lines = format!(
            "PR[7:{name}]=LPOS-LPOS ;\nR[1:{name}]=100 ;\nPR[7,3:{name}]=R[1:{name}] ;\n\
             L P[1:{name}] R[2:{name}]mm/sec FINE Offset,PR[7:{name}] ;\n"
        );
        assert_eq!(of(&lines), up(0.1), "{lines}");
    }
}

#[test]
fn registers_of_one_program_count_like_others() {
    for lines in [
        "LPR[7]=LPR[7]-LPR[7] ;\nLPR[7,3:z]=100 ;\nPR[7,3]=300 ;\nL P[1] 9mm/sec FINE \
         Offset,LPR[7] ;",
        "PR[7]=PR[7]-PR[7] ;\nLR[1]=100 ;\nR[1]=300 ;\nPR[7,3]=LR[1] ;\nL P[1] 9mm/sec FINE \
         Offset,PR[7] ;",
        "LPR[7]=LPR[7]-LPR[7] ;\nLPR[7,3]=100 ;\nOFFSET CONDITION LPR[7] ;\nL P[1] 9mm/sec FINE \
         Offset ;",
    ] {
        assert_eq!(of(lines), up(0.1), "{lines}");
    }
    // a copy of a point goes where the point goes
    let lines = "UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\nLPR[4]=P[1] ;\nLPR[4,3]=LPR[4,3]+100 ;\nL LPR[4] \
        9mm/sec FINE ;";
    let program = read(lines, &usual("1"));
    assert_eq!(program.findings, []);
    assert_eq!(program.moves.len(), 1);
    assert!(program.target_of(&program.moves[0]).is_some());
    assert_eq!(program.moves[0].displacement, up(0.1));
}

#[test]
fn elsewhere_a_register_is_any_of_what_is_written() {
    let lines = format!("{ZERO}PR[7,3]=100 ;\nCALL X ;\n{GO}");
    assert_eq!(of(&lines), up(0.1));
    // also behind the move: registers last from run to run
    let later = format!("{lines}PR[7,3]=(-300) ;");
    let ends = between(&of(&later)).expect("the text tells it");
    assert!(ends[0] < -0.3 + 1e-9 && ends[1] > 0.1 - 1e-9, "{ends:?}");
    // another program writes it at any time
    let a = listing(
        &format!("RUN OTHER ;\n{ZERO}PR[7,3]=100 ;\n{GO}"),
        &usual("1"),
    );
    let b = listing("PR[7,3]=300 ;", "").replace("TEST", "OTHER");
    assert_eq!(last(&[("a.ls", &a)]), up(0.1), "not in the files");
    assert_ne!(last(&[("a.ls", &a), ("b.ls", &b)]), up(0.1));
}

#[test]
fn a_register_keeps_what_it_held_where_a_way_passes_the_writes() {
    let some = format!("{ZERO}PR[7,3]=100 ;\n");
    for lines in [
        format!("IF DI[1]=ON,JMP LBL[1] ;\n{some}LBL[1] ;\n{GO}"),
        format!("IF (DI[1]) THEN ;\n{some}ENDIF ;\n{GO}"),
        format!("SELECT R[1]=1,PR[7,3]=100 ;\nELSE,JMP LBL[1] ;\nLBL[1] ;\n{GO}"),
        format!("JMP LBL[R[1]] ;\n{some}LBL[1] ;\n{GO}"),
        format!("{some}SOMETHING[PR[7]] ON ;\nWELD_IT PR[7] ;\n{GO}"),
    ] {
        let by = of(&lines);
        assert!(matches!(by, Displacement::AtLeast(_)), "{lines}: {by:?}");
    }
    // the way around leads to no move
    let around = format!("IF DI[1]=ON,JMP LBL[9] ;\n{some}CALL X ;\n{GO}LBL[9] ;");
    assert_eq!(of(&around), up(0.1));
}

#[test]
fn a_register_keeps_what_it_held_where_it_is_written_behind_the_move() {
    let set = "PR[7]=PR[7]-PR[7] ;\n";
    for lines in [
        format!("{GO}{set}"),
        format!("LBL[1] ;\n{GO}{set}JMP LBL[1] ;"),
        format!("PR[7]=PR[8] ;\n{GO}PR[8]=PR[8]-PR[8] ;"),
        format!("{set}PR[7,3]=R[5] ;\n{GO}R[5]=0 ;"),
        format!("OFFSET CONDITION PR[7] ;\nL P[1] 9mm/sec FINE Offset ;\n{set}"),
    ] {
        assert_eq!(of(&lines), Displacement::Unknown, "{lines}");
    }
    let program = |name: &str, lines: &str| listing(lines, &usual("1")).replace("TEST", name);
    let (go, reset) = (program("GO", GO), program("RESET", set));
    for (main, wanted) in [
        ("CALL GO ;\nCALL RESET ;", Displacement::Unknown),
        ("IF DI[1]=ON,CALL RESET ;\nCALL GO ;", Displacement::Unknown),
        (
            "IF DI[1]=ON,JMP LBL[1] ;\nCALL RESET ;\nLBL[1] ;\nCALL GO ;",
            Displacement::Unknown,
        ),
        ("RUN GO ;\nCALL RESET ;\nCALL GO ;", Displacement::Unknown),
        ("CALL RESET ;\nCALL GO ;", Displacement::None),
        ("CALL RESET ;\nIF DI[1]=ON,CALL GO ;", Displacement::None),
    ] {
        let main = program("MAIN", main);
        let all = [("g.ls", &*go), ("m.ls", &*main), ("r.ls", &*reset)];
        let program = read_files(&all).expect("a program");
        let moves = program.moves.iter().map(|of| of.displacement.clone());
        assert!(
            moves.clone().all(|by| by == wanted),
            "{main} {:?}",
            moves.collect::<Vec<_>>()
        );
    }
}

#[test]
fn a_program_that_is_called_may_pass_by_its_writes_or_set_another_condition() {
    let by = |main: &str, called: &str| {
        let main = listing(main, &usual("1"));
        let called = listing(called, "").replace("TEST", "SET");
        last(&[("m.ls", &main), ("s.ls", &called)])
    };
    let some = format!("{ZERO}PR[7,3]=100 ;");
    let main = format!("CALL SET ;\n{GO}");
    assert_eq!(by(&main, &some), up(0.1));
    for passes in [
        format!("IF DI[2]=OFF,JMP LBL[1] ;\n{some}\nLBL[1] ;"),
        format!("IF (DI[2]) THEN ;\n{some}\nENDIF ;"),
    ] {
        let by = by(&main, &passes);
        assert!(matches!(by, Displacement::AtLeast(_)), "{passes}: {by:?}");
    }
    // behind one that changes no register all is as before
    let main = |end: &str| format!("{some}\n{GO}CALL SET ;\n{GO}{end}");
    let quiet = "RO[1]=ON ;\nWAIT    .50(sec) ;\n! PART IN ;\nIF DI[1]=ON,JMP LBL[1] ;\nLBL[1] ;";
    assert_eq!(by(&main("PR[7,3]=300 ;"), quiet), up(0.1));
    for other in [
        "WELD_IT ;",
        "R[1]=5 ;",
        "CALL MORE ;",
        "IF R[1]=5,PR[7,3]=1 ;",
        "IF DI[1]=ON,R[9]=1 ;",
    ] {
        let other = format!("{quiet}\n{other}");
        assert_ne!(by(&main("PR[7,3]=300 ;"), &other), up(0.1), "{other}");
    }
    let main = |call: &str| {
        format!("{some}\nOFFSET CONDITION PR[7] ;\n{call}L P[1] 9mm/sec FINE Offset ;")
    };
    let other = "PR[8]=PR[8]-PR[8] ;\nPR[8,3]=300 ;\nOFFSET CONDITION PR[8] ;";
    assert_eq!(by(&main(""), other), up(0.1));
    let either = by(&main("CALL SET ;\n"), other);
    let ends = between(&either).expect("the text tells it");
    assert!(ends[1] > 0.3 - 1e-9, "{ends:?}");
}

#[test]
fn loops_count_and_jumps_do_not() {
    let grown = |head: &str, end: &str| {
        let step = "R[1]=R[1]+50 ;\nPR[7,3]=R[1] ;\n";
        of(&format!("{ZERO}R[1]=0 ;\n{head}\n{step}{GO}{end}"))
    };
    let ends = between(&grown("FOR R[2:i]=1 TO 4 ;", "ENDFOR ;")).expect("counted");
    assert!((ends[1] - 0.2).abs() < 1e-9, "{ends:?}");
    let down = between(&grown("FOR R[2]=4 DOWNTO 3 ;", "ENDFOR ;")).expect("counted");
    assert!((down[1] - 0.1).abs() < 1e-9, "{down:?}");
    for (head, end) in [
        ("LBL[1] ;", "JMP LBL[1] ;"),
        ("FOR R[2]=1 TO R[3] ;", "ENDFOR ;"),
        ("FOR R[2]=1 TO 4 ;\nIF DI[1]=ON,R[2]=1 ;", "ENDFOR ;"),
    ] {
        assert_eq!(between(&grown(head, end)), None, "{head}");
    }
    let counter = format!("{ZERO}FOR R[2]=1 TO 4 ;\nPR[7,3]=R[2]*10 ;\n{GO}ENDFOR ;");
    let ends = between(&of(&counter)).expect("counted");
    assert!((ends[1] - 0.04).abs() < 1e-9, "{ends:?}");
}

#[test]
fn what_the_robot_alone_knows_is_unknown_and_what_is_not_followed_has_no_bound() {
    for lines in [
        GO.to_owned(),
        format!("PR[7]=VR[1].OFFSET ;\n{GO}"),
        format!("{ZERO}PR[7,2]=GI[1] ;\n{GO}"),
        format!("{ZERO}PR[7,2]=ABS[GI[1]] ;\n{GO}"),
        format!("{ZERO}R[4]=R[5] ;\nPR[7,6]=R[4] ;\n{GO}"),
        "OFFSET CONDITION PR[1] ;\nL P[1] 9mm/sec FINE Offset ;".into(),
        "L P[1] 9mm/sec FINE Offset,PR[R[1]] ;".into(),
        format!("{ZERO}L P[1] 9mm/sec FINE VOFFSET,VR[1] ;"),
    ] {
        assert_eq!(of(&lines), Displacement::Unknown, "{lines}");
    }
    for lines in [
        format!("{ZERO}PR[7,5]=1 ;\n{GO}"),
        // where the robot is may be anywhere
        format!("PR[7]=LPOS ;\n{GO}"),
        format!("PR[7]=P[1] ;\n{GO}"),
        format!("{ZERO}R[1]=5 ;\nPR[7,2]=SIN[R[1]] ;\n{GO}"),
        format!("PR[7]=JPOS ;\nPR[7]=PR[7]-PR[7] ;\nPR[7,1]=5 ;\n{GO}"),
        format!("{ZERO}R[1]=0 ;\nLBL[1] ;\nR[1]=R[1]+AI[1] ;\nPR[7,1]=R[1] ;\n{GO}JMP LBL[1] ;"),
        format!("{ZERO}PR[7,1]=5 ;\nL P[1] 9mm/sec FINE Offset,PR[R[1]] ;"),
        format!(
            "{ZERO}PR[7,1]=5 ;\nOFFSET CONDITION PR[7],UFRAME[1] ;\nL P[1] 9mm/sec FINE Offset ;"
        ),
        format!("{ZERO}PR[7,1]=5 ;\nL P[1] 9mm/sec FINE UTENS_OFFSET,PR[7] ;"),
        format!("{ZERO}PR[R[1],3]=PR[R[1],3]+5 ;\n{GO}"),
    ] {
        assert_eq!(of(&lines), Displacement::Unbounded, "{lines}");
    }
    let same = format!(
        "{ZERO}PR[7,3]=100 ;\nOFFSET CONDITION PR[7],UFRAME[2] ;\nL P[1] 9mm/sec FINE Offset ;"
    );
    assert_eq!(of(&same), up(0.1), "the frame of the point");
}

/// POSREG.VA with one register.
fn posreg(number: u32, z: &str) -> String {
    format!(
        "[*POSREG*]$POSREG  Storage: CMOS  Access: RW  : ARRAY[1,100] OF Position Reg\r\n    \
         [1,{number}] =   'up' \r\n  Group: 1   Config: N U T, 0, 0, 0\r\n  X:     0.000   Y:     \
         0.000   Z:   {z}\r\n  W:     0.000   P:     0.000   R:     0.000\r\n"
    )
}

#[test]
fn a_register_that_no_program_writes_is_what_a_file_of_the_controller_shows() {
    let with = |lines: &str, shown: &str| {
        let program = listing(lines, &usual("1"));
        last(&[("a.ls", &program), ("posreg.va", shown)])
    };
    let shown = posreg(7, "100.000");
    for lines in [
        GO.to_owned(),
        format!("CALL X ;\nLBL[1] ;\n{GO}JMP LBL[1] ;"),
        format!("PR[8]=PR[7] ;\n{}", GO.replace('7', "8")),
        "OFFSET CONDITION PR[7] ;\nL P[1] 9mm/sec FINE Offset ;".into(),
    ] {
        assert_eq!(with(&lines, &shown), up(0.1), "{lines}");
    }
    // one of its numbers is written, or another register is meant
    let by = with(&format!("CALL X ;\nPR[7,3]=300 ;\n{GO}"), &shown);
    assert_eq!(by, up(0.3));
    // where it may not be written before the move, it is that, too
    for lines in [
        format!("IF DI[1]=ON,JMP LBL[1] ;\nPR[7,3]=5 ;\nLBL[1] ;\n{GO}"),
        format!("{GO}PR[7,3]=5 ;"),
        format!("PR[R[1],3]=5 ;\n{GO}"),
    ] {
        let by = with(&lines, &shown);
        let ends = between(&by).unwrap_or_else(|| panic!("{lines}: {by:?}"));
        assert_eq!(
            ends.map(|end| (end * 1e6).round() / 1e6),
            [0.0, 0.1],
            "{lines}"
        );
    }
    for lines in [
        GO.replace('7', "9"),
        format!("PR[7,3]=GI[1] ;\n{GO}"),
        format!("SEARCH_IT PR[7] ;\n{GO}"),
    ] {
        let by = with(&lines, &shown);
        assert!(
            matches!(by, Displacement::Unknown | Displacement::AtLeast(_)),
            "{lines}: {by:?}"
        );
    }
    for lines in [
        GO.replace("PR[7]", "PR[R[1]]"),
        format!("PR[7]=LPOS ;\n{GO}"),
    ] {
        assert_eq!(with(&lines, &shown), Displacement::Unbounded, "{lines}");
    }
    // two files that differ, and two that are alike
    let program = listing(GO, &usual("1"));
    let both = |a: &str, b: &str| {
        last(&[
            ("a.ls", &program),
            ("1/posreg.va", &posreg(7, a)),
            ("2/posreg.va", &posreg(7, b)),
        ])
    };
    assert_eq!(both("100.000", "200.000"), Displacement::Unknown);
    assert_eq!(both("100.000", "100.000"), up(0.1));
}

#[test]
fn counters_displace_through_numbers_of_registers_as_far_as_loops_count() {
    let of = |lines: &str| {
        let ends = between(&of(lines)).expect("counted");
        [ends[0], ends[1]].map(|end| (end * 1e6).round() / 1e6)
    };
    let step = "PR[7,3]=R[1]*50 ;\n";
    assert_eq!(
        of(&format!("{ZERO}FOR R[1]=1 TO 5 ;\n{step}{GO}ENDFOR ;")),
        [0.0, 0.25]
    );
}

/// Whether the last move shifts the rail by what only the running program knows.
fn shifts_the_rail(lines: &str) -> bool {
    let program = on_a_rail(lines);
    let last = program.moves.last().expect("a move").instruction;
    let mut shifts = program.external_shifts.iter();
    shifts.any(|(at, shift)| *at == last && shift.axis == 0 && shift.value.is_nan())
}

#[test]
fn an_offset_whose_axis_is_set_at_run_time_shifts_the_rail_somewhere() {
    let set = "PR[7,7]=R[61] ;\n";
    for lines in [
        format!("{ZERO}{set}{GO}"),
        format!("{set}{GO}"),
        format!("{GO}{set}"),
        format!("{ZERO}CALL X ;\nPR[7,7]=GI[1]*10 ;\n{GO}"),
        format!("{ZERO}PR[R[1],7]=R[61] ;\n{GO}"),
        format!("{ZERO}{set}L P[1] 9mm/sec FINE Tool_Offset,PR[7] ;\n"),
        format!("{ZERO}{set}OFFSET CONDITION PR[7] ;\nL P[1] 9mm/sec FINE Offset ;\n"),
        format!("{ZERO}{set}L P[1] 9mm/sec FINE Offset,PR[R[5]] ;\n"),
    ] {
        assert!(shifts_the_rail(&lines), "{lines}");
    }
    for lines in [
        GO.to_owned(),
        format!("{ZERO}{GO}"),
        format!("{ZERO}PR[7,3]=R[61] ;\n{GO}"),
        format!("PR[7]=PR[8] ;\n{GO}"),
        format!("{ZERO}PR[8,7]=R[61] ;\n{GO}"),
        format!("{ZERO}PR[7,8]=R[61] ;\n{GO}"),
        format!("{set}{ZERO}{GO}"),
        format!("{ZERO}R[61]=0 ;\n{set}{GO}"),
        format!("{ZERO}{set}L P[1] 9mm/sec FINE ;\n"),
    ] {
        assert!(!shifts_the_rail(&lines), "{lines}");
    }
}

#[test]
fn a_sum_with_such_a_register_is_nowhere_that_the_text_tells() {
    let sum = "PR[5]=P[1]+PR[7] ;\nL PR[5] 9mm/sec FINE ;\n";
    let by = |lines: &str| {
        let program = on_a_rail(&format!("UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\n{lines}{sum}"));
        program.moves.last().expect("a move").displacement.clone()
    };
    assert_eq!(by(&format!("{ZERO}PR[7,3]=100 ;\n")), up(0.1));
    let lines = format!("{ZERO}PR[7,3]=100 ;\nPR[7,7]=R[61] ;\n");
    assert_eq!(by(&lines), Displacement::Unbounded);
}
