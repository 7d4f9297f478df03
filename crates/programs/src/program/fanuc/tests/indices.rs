//! Registers as indices.

use super::*;

/// The points that moves go to, and what displaces these.
fn to(program: &Program) -> Vec<(&str, Displacement)> {
    let moves = program.moves.iter();
    let all = moves.map(|motion| {
        let target = program.target_of(motion);
        let name = target.and_then(|target| target.name.as_deref());
        (name.unwrap_or("-"), motion.displacement.clone())
    });
    all.collect()
}

fn names(lines: &str) -> Vec<String> {
    let points = usual("1") + &usual("2") + &usual("3") + &usual("9").replace("UT : 1", "UT : 3");
    let program = read(&format!("UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\n{lines}"), &points);
    assert!(blocked(&program).iter().all(|name| !lines.contains(name)));
    let found = ids(&program);
    assert!(
        found.iter().all(|id| *id == "target-unused-here"),
        "{lines}: {found:?}"
    );
    to(&program)
        .into_iter()
        .map(|(name, _)| name.to_owned())
        .collect()
}

#[test]
fn an_index_means_the_points_that_its_register_may_tell() {
    let go = "L P[R[1]] 9mm/sec FINE ;\n";
    for (lines, wanted) in [
        (format!("R[1]=2 ;\n{go}"), vec!["P[2]"]),
        (
            format!("FOR R[1]=2 TO 3 ;\n{go}ENDFOR ;"),
            vec!["P[2]", "P[3]"],
        ),
        (
            format!("FOR R[1:n]=3 DOWNTO 2 ;\n{go}ENDFOR ;"),
            vec!["P[3]", "P[2]"],
        ),
        (
            format!("R[1]=1 ;\nFOR R[2]=1 TO 3 ;\n{go}R[1]=R[1]+1 ;\nENDFOR ;"),
            vec!["P[1]", "P[2]", "P[3]"],
        ),
        // in a branch of the loop, and behind it
        (
            format!("FOR R[1]=2 TO 3 ;\nIF DI[1]=ON,CALL X ;\nCALL Y ;\n{go}ENDFOR ;"),
            vec!["P[2]", "P[3]"],
        ),
        // the label goes round as often as it likes
        (
            format!("FOR R[1]=2 TO 3 ;\nLBL[1] ;\n{go}IF DI[1]=ON,JMP LBL[1] ;\nENDFOR ;"),
            vec!["P[2]", "P[3]"],
        ),
        (
            format!("R[1]=1 ;\nIF (DI[1]) THEN ;\nR[1]=3 ;\nENDIF ;\n{go}"),
            vec!["P[1]", "P[3]"],
        ),
        (
            format!("R[3]=2 ;\nR[1]=R[3]+1 ;\nCALL X ;\n{go}R[3]=0 ;"),
            vec!["P[3]"],
        ),
        (
            format!("FOR R[2]=1 TO 2 ;\nFOR R[1]=R[2] TO 2 ;\n{go}ENDFOR ;\nENDFOR ;"),
            vec!["P[1]", "P[2]", "P[2]"],
        ),
    ] {
        assert_eq!(names(&lines), wanted, "{lines}");
    }
    // an input, a register that a later line writes alone, one that nothing writes
    for lines in [
        format!("R[1]=GI[1] ;\n{go}"),
        format!("{go}R[1]=2 ;"),
        go.to_owned(),
    ] {
        let points = usual("1") + &usual("2") + &usual("3");
        let program = read(&lines, &points);
        assert_eq!(to(&program).len(), 3, "{lines}");
    }
    // no point has that number
    let program = read(&format!("R[1]=7 ;\n{go}J P[1] 9% FINE ;"), &usual("1"));
    assert_eq!(ids(&program), ["target-not-in-files"]);
    // of another program
    let a = listing(&format!("CALL SET ;\n{go}"), &(usual("1") + &usual("2")));
    let b = listing("R[1]=2 ;", "").replace("TEST", "SET");
    let program = read_files(&[("a.ls", &a), ("b.ls", &b)]).expect("programs");
    assert_eq!(to(&program), [("P[2]", Displacement::None)]);
    // what a call gives
    let a = listing("CALL GO(2) ;", "");
    let b = listing(&go.replace("R[1]", "AR[1]"), &(usual("1") + &usual("2")));
    let b = b.replace("TEST", "GO");
    let program = read_files(&[("a.ls", &a), ("b.ls", &b)]).expect("programs");
    assert_eq!(to(&program), [("P[2]", Displacement::None)]);
}

#[test]
fn a_register_by_an_index_is_the_one_that_it_tells() {
    let up = |by| Displacement::By(Box::new(Shift::along([0.0, 0.0, by])));
    let points = usual("1") + &usual("2") + &usual("3");
    let of = |lines: &str| {
        let head = "UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\nJ P[1] 9% FINE ;\n";
        let program = read(&format!("{head}{lines}"), &points);
        let found = ids(&program);
        assert!(
            found.iter().all(|id| *id == "target-unused-here"),
            "{lines}: {found:?}"
        );
        let all = to(&program).into_iter().skip(1);
        all.map(|(name, by)| (name.to_owned(), by))
            .collect::<Vec<_>>()
    };
    let two = |by: &dyn Fn(f64) -> Displacement| {
        vec![("P[2]".to_owned(), by(2.0)), ("P[3]".to_owned(), by(3.0))]
    };
    let none = |_| Displacement::None;
    for (lines, wanted) in [
        (
            "FOR R[1]=2 TO 3 ;\nPR[R[1]]=P[R[1]] ;\nL PR[R[1]] 9mm/sec FINE ;\nENDFOR ;",
            two(&none),
        ),
        (
            "FOR R[1]=2 TO 3 ;\nPR[R[1]]=P[R[1]] ;\nPR[R[1],3]=PR[R[1],3]+R[1]*50 ;\nL PR[R[1]] \
             9mm/sec FINE ;\nENDFOR ;",
            two(&|n| up(50.0 * n * 1e-3)),
        ),
        // a number of it by an index
        (
            "FOR R[1]=2 TO 3 ;\nR[2]=3 ;\nPR[9]=P[R[1]] ;\nPR[9,R[2]]=PR[9,R[2]]+50 ;\nL PR[9] \
             9mm/sec FINE ;\nENDFOR ;",
            two(&|_| up(0.05)),
        ),
    ] {
        assert_eq!(of(lines), wanted, "{lines}");
    }
    // offsets: one of a few
    let set = "PR[6]=PR[6]-PR[6] ;\nPR[7]=PR[6] ;\nPR[6,3]=50 ;\nPR[7,3]=60 ;\n";
    let lines = format!("{set}FOR R[1]=6 TO 7 ;\nL P[2] 9mm/sec FINE Offset,PR[R[1]] ;\nENDFOR ;");
    let wanted = [("P[2]".to_owned(), up(0.05)), ("P[2]".to_owned(), up(0.06))];
    assert_eq!(of(&lines), wanted);
}

#[test]
fn a_rail_stands_where_the_register_says() {
    let head = "UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\nPR[5]=P[1] ;\n";
    let go = "L PR[5] 9mm/sec FINE ;\n";
    let stands = |lines: &str| {
        let program = on_a_rail(&format!("{head}{lines}"));
        assert_eq!(ids(&program), [""; 0], "{lines}");
        let last = program.moves.last().expect("a move");
        assert_eq!(last.displacement, Displacement::None, "{lines}");
        assert!(last.target.is_some(), "{lines}");
        let mut all = program.externals_of_moves.iter();
        all.find(|(at, _)| *at == last.instruction)
            .map(|(_, external)| (external.axis, external.value))
    };
    assert_eq!(stands(go), None);
    assert_eq!(stands(&format!("PR[5,7]=500 ;\n{go}")), Some((0, 500.0)));
    assert_eq!(
        stands(&format!("R[2]=7 ;\nPR[5,R[2]]=500 ;\n{go}")),
        Some((0, 500.0))
    );
    // the point itself, again
    assert_eq!(stands(&format!("PR[5,7]=500 ;\nPR[5]=P[1] ;\n{go}")), None);
    assert_eq!(stands(&format!("{go}PR[6,7]=500 ;\n")), None);
    for lines in [
        format!("PR[5,7]=R[61] ;\n{go}"),
        format!("PR[5,7]=500 ;\nLBL[1] ;\n{go}"),
        format!("PR[R[1],7]=500 ;\nLBL[1] ;\n{go}"),
        format!("PR[6,7]=500 ;\nPR[5]=PR[6] ;\nPR[5]=P[1] ;\nIF DI[1]=ON,PR[5]=PR[6] ;\n{go}"),
    ] {
        let program = on_a_rail(&format!("{head}{lines}"));
        let all = program.externals_of_moves.iter();
        let found: Vec<_> = all.filter(|(_, of)| of.value.is_nan()).collect();
        assert!(!found.is_empty(), "{lines}");
    }
    // of an axis that nobody knows it is nothing at zero alone
    let unlisted = |lines: &str| {
        let program = read(&format!("{head}J P[1] 9% FINE ;\n{lines}"), &usual("1"));
        let all = ids(&program).into_iter().map(str::to_owned);
        all.collect::<Vec<_>>()
    };
    assert_eq!(unlisted(&format!("PR[5,7]=0 ;\n{go}")), [""; 0]);
    let found = unlisted(&format!("PR[5,7]=500 ;\n{go}"));
    assert_eq!(found, ["external-axis-unknown"]);
}

#[test]
fn a_register_that_is_written_number_by_number_is_no_copy() {
    let numbers = ["1000", "150", "420", "176", "(-4)", "10"];
    let six = (1..).zip(numbers);
    let six: String = six
        .map(|(at, value)| format!("PR[1,{at}]={value} ;\n"))
        .collect();
    for before in ["PR[1]=LPOS ;\n", "PR[1]=P[1] ;\n", ""] {
        let lines = format!("J P[1] 9% FINE ;\n{before}{six}L PR[1] 9mm/sec FINE ;");
        let program = read(&lines, &usual("1"));
        assert_eq!(ids(&program), ["computed-target"], "{lines}");
        let found = &program.findings[0];
        assert!(
            found.message.contains("writes all numbers"),
            "{}",
            found.message
        );
        assert_eq!(to(&program)[1], ("-", Displacement::None));
    }
    // of a part that only the running program knows the copy is left
    let lines = six.replace("=420", "=PR[1,3]+R[5]");
    let lines =
        format!("UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\nPR[1]=P[1] ;\n{lines}L PR[1] 9mm/sec FINE ;");
    let program = read(&lines, &usual("1"));
    assert_eq!(to(&program), [("P[1]", Displacement::Overwritten)]);
}

#[test]
fn a_signal_that_ends_a_move_writes_the_register_there() {
    let lines = "UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\nL P[1] 9mm/sec FINE Skip,LBL[1],PR[2]=LPOS ;\nL PR[2] \
        9mm/sec FINE ;\nLBL[1] ;\nL P[2] 9mm/sec FINE ;";
    let program = read(lines, &(usual("1") + &usual("2")));
    assert_eq!(ids(&program), ["run-time-position"]);
    assert_eq!(program.findings[0].severity, Severity::Note);
    let stops: Vec<bool> = program.moves.iter().map(|of| program.is_stop(of)).collect();
    assert_eq!(stops, [false, true, false, false]);
}
