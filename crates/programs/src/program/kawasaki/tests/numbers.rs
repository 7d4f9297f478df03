//! Displacements by what statements write into reals and transformations.

use super::*;
use crate::program::{Shift, Stride};

/// What the last move of lines is displaced by, with these programs behind them.
fn by(code: &str, others: &str) -> Displacement {
    let text = format!(
        ".PROGRAM main()\nTOOL grip\nBASE NULL\n{code}\n.END\n{others}{POINTS}.REALS\nup = \
         300\n.END\n"
    );
    let program = read_files(&[&text]).expect("programs");
    program.moves.last().expect("a move").displacement.clone()
}

fn in_tool(numbers: [f64; 3]) -> Displacement {
    let [x, y, z] = numbers;
    Displacement::By(Box::new(Shift {
        in_tool: Pose::from_translation(x, y, z),
        ..Shift::none()
    }))
}

fn along(numbers: [f64; 3]) -> Displacement {
    Displacement::By(Box::new(Shift::along(numbers)))
}

#[test]
fn what_the_text_writes_displaces_by_that() {
    for code in [
        "POINT .off = TRANS(0,0,200)\nLMOVE p1+.off",
        ".h = 100\n.h2 = .h*2\nLMOVE p1+TRANS(0,0,.h2)",
        "LMOVE p1+TRANS(0,0,up-100)",
        "POINT .off = TRANS(0,0,-200)\nLMOVE p1-.off",
        "POINT .a = TRANS(0,0,150)\nPOINT .b = .a+TRANS(,,50)\nLMOVE p1+.b",
        "LMOVE p1+TRANS(0,0,200)",
        "LMOVE p1\nTDRAW 0,0,up-100",
        ".h = -200\nLAPPRO p1,.h",
        ".h = -200\nLMOVE p1\nLDEPART .h",
        "POINT/Z .off = TRANS(0,0,200)\nPOINT/X .off = TRANS(0,0,200)\nPOINT/Y .off = \
         TRANS(1,0,2)\nPOINT/OAT .off = NULL\nLMOVE p1+.off",
    ] {
        assert_eq!(by(code, ""), in_tool([0.0, 0.0, 0.2]), "{code}");
    }
    for code in [
        ".h = 20\nLMOVE SHIFT(p1 BY 0,0,.h)",
        ".h = 20\nLMOVE p1\nDRAW 0,0,.h",
    ] {
        assert_eq!(by(code, ""), along([0.0, 0.0, 0.02]), "{code}");
    }
    let other = ".PROGRAM go(.t,.h)\nLMOVE p1+.t+TRANS(0,0,.h)\n.END\n";
    let given = by("CALL go(off,30)", other);
    let Displacement::By(given) = given else {
        panic!("{given:?}");
    };
    assert!((given.in_tool.translation[2] + 0.02).abs() < 1e-12);
}

#[test]
fn what_may_be_several_is_judged_as_each() {
    let step = |z: f64, most| Stride::By {
        shift: Shift::along([0.0, 0.0, z]),
        most: Some(most),
    };
    for code in [
        "FOR .i = 0 TO 4\nLMOVE SHIFT(p1 BY 0,0,.i*40)\nEND",
        ".n = 0\nFOR .i = 1 TO 4\n.n = .n+1\nLMOVE SHIFT(p1 BY 0,0,.n*40)\nEND",
    ] {
        let Displacement::Within(found) = by(code, "") else {
            panic!("{code}: {:?}", by(code, ""));
        };
        let Stride::By { shift, most } = &found[found.len() - 1] else {
            panic!("{found:?}");
        };
        let reach = shift.in_frame.translation[2] * f64::from(most.expect("counted"));
        assert!(
            (0.16 - 1e-9..0.2 + 1e-9).contains(&reach),
            "{code}: {found:?}"
        );
    }
    let either = "IF x > 1 THEN\n.h = 10\nELSE\n.h = 50\nEND\nLMOVE SHIFT(p1 BY 0,0,.h)";
    let Displacement::Within(found) = by(either, "") else {
        panic!("{:?}", by(either, ""));
    };
    assert_eq!(found[..], [step(0.01, 1), step(0.04, 1)]);
}

/// How far along z the farthest of the steps of a displacement leads, mm.
fn reach_mm(code: &str, others: &str) -> f64 {
    match by(code, others) {
        Displacement::By(shift) => shift.in_frame.translation[2] * 1e3,
        Displacement::Within(found) => {
            let each = found.iter().map(|stride| match stride {
                Stride::By { shift, most } => {
                    shift.in_frame.translation[2] * f64::from(most.expect("counted"))
                }
                _ => panic!("nothing turns"),
            });
            each.sum::<f64>() * 1e3
        }
        other => panic!("{code}: {other:?}"),
    }
}

#[test]
fn conditions_of_loops_and_jumps_bound_what_adds_up() {
    let (go, by_i) = ("LMOVE SHIFT(p1 BY 0,0,h)", "LMOVE SHIFT(p1 BY 0,0,i*30)");
    for code in [
        format!("h = 0\nWHILE h < 120 DO\n{go}\nh = h+30\nEND"),
        format!("h = 0\nDO\n{go}\nh = h+30\nUNTIL h >= 120"),
        format!("h = 0\ni = 0\nDO\n{go}\nh = h+30\ni = i+1\nUNTIL i == 4"),
        format!("i = 0\n10 {by_i}\ni = i+1\nIF i < 4 GOTO 10"),
        format!("i = 0\n10 {by_i}\ni = i+1\nGOTO 10 IF i < 4 AND SIG(1)"),
        format!("i = 0\nup: IF i >= 4 GOTO out\n{by_i}\ni = i+1\nGOTO up\nout: BREAK"),
        format!("i = 0\n10 {by_i}\ni = i+1\nIF i >= 4 THEN\nRETURN\nEND\nGOTO 10"),
    ] {
        let reach = reach_mm(&code, "");
        assert!((reach - 120.0).abs() < 1e-9, "{code}: {reach}");
    }
    for code in [
        format!("i = 0\n10 {by_i}\ni = i+1\nIF j < 4 GOTO 10"),
        format!("i = 0\n10 {by_i}\ni = i+1\nGOTO 10 IF i < 4 OR SIG(1)"),
        format!("i = 0\nON 1001 GOTO 10\n10 {by_i}\ni = i+1\nIF i < 4 GOTO 10"),
        format!("10 {by_i}\ni = i+1\nIF i < 4 GOTO 10"),
    ] {
        let found = by(&code, "");
        let is_bounded = match &found {
            Displacement::Within(all) => all
                .iter()
                .all(|stride| matches!(stride, Stride::By { most: Some(_), .. })),
            _ => false,
        };
        assert!(!is_bounded, "{code}: {found:?}");
    }
}

#[test]
fn inside_its_loop_a_counter_is_what_the_loop_counts() {
    let go = "LMOVE SHIFT(p1 BY 0,0,i*30)";
    let other = ".PROGRAM go()\nFOR i = 0 TO 8\nEND\n.END\n";
    let up = ".PROGRAM up(.h)\nLMOVE SHIFT(p1 BY 0,0,.h)\n.END\n";
    for (code, others, expected) in [
        (format!("FOR i = 0 TO 1\n{go}\nEND"), "", 30.0),
        (format!("FOR i = 0 TO 5 STEP 2\n{go}\nEND"), "", 120.0),
        (
            "FOR i = 1 TO 2\nLMOVE SHIFT(p1 BY 0,0,(i-1)*30)\nEND".to_owned(),
            "",
            30.0,
        ),
        (
            "FOR j = 0 TO 1\nFOR i = 0 TO j\nLMOVE SHIFT(p1 BY 0,0,i*30)\nEND\nEND".to_owned(),
            "",
            30.0,
        ),
        (
            "FOR i = 0 TO 1\nh = i*30\nLMOVE SHIFT(p1 BY 0,0,h)\nEND".to_owned(),
            "",
            30.0,
        ),
        ("FOR i = 0 TO 1\nCALL up(i*30)\nEND".to_owned(), up, 30.0),
        // other loops of the same name run before and behind it
        (
            format!("FOR i = 0 TO 8\nEND\nFOR i = 0 TO 1\n{go}\nEND"),
            other,
            30.0,
        ),
        // behind its loop it is a step further
        (format!("FOR i = 0 TO 1\nEND\n{go}"), "", 60.0),
        // what writes it in the loop counts, too
        (
            format!("FOR i = 0 TO 1\nFOR i = 0 TO 8\nEND\n{go}\nEND"),
            "",
            270.0,
        ),
        (format!("FOR i = 0 TO 1\nCALL go\n{go}\nEND"), other, 270.0),
        (
            format!("PCEXECUTE 1: go\nFOR i = 0 TO 1\n{go}\nEND"),
            other,
            270.0,
        ),
        (
            format!("FOR i = 0 TO 1\n10 {go}\nEND\nIF x GOTO 10"),
            "",
            60.0,
        ),
    ] {
        let found = reach_mm(&code, others);
        assert!((found - expected).abs() < 1e-9, "{code}: {found}");
    }
}

/// Where moves go, and how far back along the tool, mm: each once.
fn backs(code: &str, others: &str) -> Vec<(String, f64)> {
    let text =
        format!(".PROGRAM main()\nTOOL grip\nBASE NULL\n{code}\n.END\n{others}{POINTS}.END\n");
    let program = read_files(&[&text]).expect("programs");
    let mut all = Vec::new();
    for one in &program.moves {
        let back = match &one.displacement {
            Displacement::None => 0.0,
            Displacement::By(shift) => {
                let [x, y, z] = shift.in_tool.translation;
                assert_eq!((x, y), (0.0, 0.0));
                (-z * 1e6).round() / 1e3
            }
            _ => f64::NAN,
        };
        let one = (target(&program, one).expect("a target").to_owned(), back);
        if !all.contains(&one) {
            all.push(one);
        }
    }
    all
}

#[test]
fn numbers_of_a_call_are_those_of_that_call() {
    let pick = ".PROGRAM pick(.p,.h)\nLAPPRO .p,.h\nLMOVE .p\nLDEPART .h/2\n.END\n";
    let of = |name: &str, back: f64| {
        [
            (name.to_owned(), back),
            (name.to_owned(), 0.0),
            (name.to_owned(), back / 2.0),
        ]
    };
    let mut both = [of("p1", 10.0), of("p[1]", 80.0)].concat();
    let sort = |all: &mut Vec<(String, f64)>| {
        all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    };
    sort(&mut both);
    let through = ".PROGRAM go(.q,.n)\nCALL pick(.q,.n+10)\n.END\n";
    let through = format!("{through}{pick}");
    let deeper = format!(".PROGRAM by(.q,.n)\nCALL go(.q,.n*2)\n.END\n{through}");
    for (code, others) in [
        ("CALL pick(p1,10)\nCALL pick(p[1],80)", pick),
        ("h = 80\nCALL pick(p1,10)\nCALL pick(p[1],h)", pick),
        ("CALL go(p1,0)\nCALL go(p[1],70)", &through),
        ("CALL pick(p1,10)\nCALL go(p[1],70)", &through),
        ("CALL by(p1,0)\nCALL by(p[1],35)", &deeper),
    ] {
        let mut found = backs(code, others);
        sort(&mut found);
        assert_eq!(found, both, "{code}");
    }
    // a shift that a statement writes, and what a transformation brings
    let kept = ".PROGRAM pick(.p,.h)\nPOINT .q = .p-TRANS(0,0,.h)\nLMOVE .q\n.END\n";
    let brought = ".PROGRAM pick(.p,.t)\nLMOVE .p+.t\n.END\n";
    let each = [("p1".to_owned(), 10.0), ("p[1]".to_owned(), 80.0)];
    assert_eq!(backs("CALL pick(p1,10)\nCALL pick(p[1],80)", kept), each);
    let code = "POINT a = TRANS(0,0,-10)\nPOINT b = TRANS(0,0,-80)\nCALL pick(p1,a)\nCALL \
        pick(p[1],b)";
    assert_eq!(backs(code, brought), each);
    // one call may give several
    let by = "IF x > 1 THEN\nh = 10\nELSE\nh = 50\nEND\nCALL pick(p1,h)\nCALL pick(p[1],80)";
    let found = backs(by, pick);
    assert!(
        found
            .iter()
            .any(|(name, back)| name == "p1" && back.is_nan())
    );
    assert!(found.contains(&("p[1]".to_owned(), 80.0)));
    // what something else writes is as all calls have it
    let own = ".PROGRAM pick(.p,.h)\n.h = .h+1\nLAPPRO .p,.h\n.END\n";
    let found = backs("CALL pick(p1,10)\nCALL pick(p[1],80)", own);
    assert!(found.iter().all(|(_, back)| back.is_nan()), "{found:?}");
    // a program that calls itself
    let own = ".PROGRAM pick(.p,.h)\nLAPPRO .p,.h\nIF x THEN\nCALL pick(.p,.h+1)\nEND\n.END\n";
    let found = backs("CALL pick(p1,10)\nCALL pick(p[1],80)", own);
    for (name, back) in each {
        let of = |(at, of): &(String, f64)| *at == name && (*of == back || of.is_nan());
        assert!(found.iter().filter(|one| of(one)).count() >= 2, "{found:?}");
    }
}

#[test]
fn what_a_loop_of_another_program_counts_comes_back() {
    // 300 of .REALS, or what the other program makes of it
    let other = ".PROGRAM go(.n)\nFOR .n = 0 TO 4\nEND\n.END\n";
    let found = by("CALL go(up)\nLAPPRO p1,up", other);
    assert_eq!(found, Displacement::Unbounded);
    let kept = by("CALL go(up+1)\nLAPPRO p1,up", other);
    assert_eq!(kept, in_tool([0.0, 0.0, -0.3]));
}

#[test]
fn only_what_no_text_tells_is_taken_for_a_sensor() {
    for (code, wanted) in [
        ("LMOVE p1+cam", Displacement::Unknown),
        ("HERE .h\nLMOVE p1+.h", Displacement::Unbounded),
        ("LMOVE p1+TRANS(0,0,BITS(1,8))", Displacement::Unknown),
        ("LMOVE p1\nLDEPART x", Displacement::Unknown),
        (
            "TCP_RECV .ret,1,.x\nLMOVE p1+TRANS(.x)",
            Displacement::Unknown,
        ),
        (
            ".h = ABS(-up)\nLMOVE p1+TRANS(0,0,.h)",
            in_tool([0.0, 0.0, 0.3]),
        ),
        ("LMOVE p1+FRAME(a,b,c,d)", Displacement::Unbounded),
        ("LMOVE p1+TRANS(0,0,DZ(p[1]))", Displacement::Unbounded),
        (
            "DO\n.h = .h+SQRT(.h)\nLAPPRO p1,.h\nUNTIL x",
            Displacement::Unbounded,
        ),
    ] {
        assert_eq!(by(code, ""), wanted, "{code}");
    }
    let own = read("TOOL NULL\nBASE NULL\nPOINT q = p1\nPOINT/Z q = q+TRANS(0,0,50)\nLMOVE q");
    assert_eq!(own.moves[0].displacement, Displacement::Unbounded);
}

#[test]
fn numbers_that_a_move_goes_to_and_that_are_added_stay() {
    for code in [
        "LMOVE p1\nLMOVE p[1]+p1",
        "POINT .o = p1\nLMOVE p1\nLMOVE p[1]+.o",
        "LMOVE p1\nPOINT f = FRAME(p1,p[1],p[2],p1)",
        "LMOVE p1\nDECOMPOSE x[0]=p1",
        "LMOVE p1\nPOINT q = p1\nDECOMPOSE x[0] = q",
    ] {
        let program = read(&format!("TOOL NULL\nBASE NULL\n{code}"));
        let found = program.findings.iter();
        let mut found = found.filter(|found| found.id == "target-used-as-frame");
        let line = 4 + code.matches('\n').count();
        let named = found
            .next()
            .expect("refused")
            .message
            .contains(&format!("line {line}"));
        assert!(named, "{code}: {:?}", program.findings);
    }
    let other = ".PROGRAM take(.p)\nDECOMPOSE .x[0] = .p\n.END\n";
    let text = format!(
        ".PROGRAM a()\nTOOL NULL\nBASE NULL\nLMOVE p1\nCALL take(p1)\n.END\n{other}{POINTS}"
    );
    let program = read_files(&[&text]).expect("programs");
    assert!(ids(&program).contains(&"target-used-as-frame"));
    // points that only make a frame are no targets
    let program = read("TOOL NULL\nBASE NULL\nLMOVE p1\nPOINT f = FRAME(p[1],p[2],p[1],p[2])");
    assert_eq!(ids(&program), [""; 0]);
}

#[test]
fn an_arc_on_an_arc_is_refused_however_the_program_comes_to_it() {
    let refused = |code: &str| {
        // states that are written several times stay apart
        let program = read(&format!(
            "TOOL NULL\nBASE NULL\nJMOVE #home\nTOOL grip\nBASE grip\nJMOVE #home\nLMOVE p1\n{code}"
        ));
        ids(&program).contains(&"arc-chain")
    };
    assert!(refused("FOR .i = 1 TO 2\nC1MOVE p[.i]\nEND\nC2MOVE p1"));
    assert!(refused("10 C1MOVE p[1]\nIF x GOTO 10\nC2MOVE p1"));
    assert!(!refused("FOR .i = 1 TO 2\nC1MOVE p[1]\nC2MOVE p[2]\nEND"));
    assert!(!refused(
        "C1MOVE p[1]\nSPEED 10\nC2MOVE p[2]\nC1MOVE p[1]\nC2MOVE p1"
    ));
}

#[test]
fn what_a_call_gives_next_to_a_number_is_not_added_up() {
    let read = |code: &str, others: &str| {
        let text = format!(
            ".PROGRAM main()\nTOOL grip\nBASE NULL\nJMOVE #home\n{code}\n.END\n{others}{POINTS}"
        );
        read_files(&[&text]).expect("programs")
    };
    // the height is looked up among all that the call gives, and then something is added up
    let pick = ".PROGRAM pick(.p,.h)\nLAPPRO .p,.h\nLMOVE .p+TRANS(0,0,.h)\nLMOVE p[1]+off\n.END\n";
    let program = read("CALL pick(p1,10)\nCALL pick(p[2],20)", pick);
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
    // what is added up stays, by whatever way it comes, and however often it is looked up
    for (code, others) in [
        ("CALL go(p1)", ".PROGRAM go(.t)\nLMOVE p[1]+.t\n.END\n"),
        ("POINT .q = p1\nLMOVE p[1]+.q", ""),
        ("POINT .q = (p1)+TRANS(0,0,5)\nLMOVE p[1]+.q", ""),
        ("LMOVE p[1]+SHIFT(p1 BY 0,0,1)", ""),
        (
            "CALL go(p1,5)",
            ".PROGRAM go(.t,.h)\nLAPPRO p[1],.h\nLMOVE p[1]+.t\n.END\n",
        ),
    ] {
        let program = read(&format!("{code}\nLMOVE p1"), others);
        let found = program.findings.iter();
        let added = found.filter(|found| found.id == "target-used-as-frame");
        let added: Vec<_> = added.map(|found| &found.message[..3]).collect();
        assert_eq!(added, ["p1:"], "{code}: {:?}", program.findings);
    }
}

#[test]
fn shifts_of_shifts_add_up() {
    for code in [
        "LMOVE SHIFT(SHIFT(p1 BY 10,0,0) BY 0,20,0)",
        "POINT b = SHIFT(SHIFT(p1 BY 10,0,0) BY 0,20,0)\nLMOVE b",
        "POINT b = SHIFT(p1 BY 10,0,0)\nLMOVE SHIFT(b BY 0,20,0)",
        "LMOVE TRANS(10,0,0)+SHIFT(p1 BY 0,20,0)",
        "LMOVE NULL+TRANS(4,0,0)+SHIFT(SHIFT(p1 BY 6) BY 0,20)",
        "LMOVE SHIFT(TRANS(10,0,0)+p1 BY 0,20,0)",
    ] {
        assert_eq!(by(code, ""), along([0.01, 0.02, 0.0]), "{code}");
    }
    // in the axes of the base, before the tool's own
    let both = by("LMOVE SHIFT(SHIFT(p1 BY 10,0,0)+off BY 0,20,0)", "");
    let expected = Displacement::By(Box::new(Shift {
        in_frame: Pose::from_translation(0.01, 0.02, 0.0),
        in_tool: Pose::from_translation(0.0, 0.0, -0.05),
    }));
    assert_eq!(both, expected);
    // as a step: what it shifts begins there
    let step = by("LMOVE p1+SHIFT(SHIFT(off BY 10,0,0) BY 0,20,0)", "");
    assert_eq!(step, in_tool([0.01, 0.02, -0.05]));
}

#[test]
fn a_name_is_written_where_it_means_the_same() {
    let text = |others: &str| {
        let text = format!(
            ".PROGRAM main()\nTOOL grip\nBASE NULL\nJMOVE #home\nLMOVE p1\nLMOVE p1+off\n.END\n{others}{POINTS}"
        );
        read_files(&[&text]).expect("programs")
    };
    let plain = text("");
    for others in [
        ".PROGRAM a(p1,off)\nPOINT p1 = FRAME(q,r,s,q)\nPOINT off = p1\nBASE p1\n.END\n",
        ".PROGRAM a()\nPOINT .p1 = FRAME(q,r,s,q)\nDECOMPOSE .x[0] = .p1\n.END\n",
        ".PROGRAM a(p1)\nDECOMPOSE .x[0] = p1\nCALL b(.x[0])\n.END\n",
    ] {
        let program = text(others);
        let both = [&plain, &program].map(|of| &of.moves.last().expect("a move").displacement);
        assert_eq!(both[0], both[1], "{others}");
        let blocked = program.targets.iter().filter(|of| of.blocked);
        let blocked: Vec<_> = blocked.filter_map(|of| of.name.as_deref()).collect();
        assert!(!blocked.contains(&"p1"), "{others}: {:?}", program.findings);
    }
}

#[test]
fn a_position_that_a_call_works_out_displaces_its_target() {
    let go = ".PROGRAM go(.p)\nLMOVE .p\n.END\n";
    for (given, expected) in [
        ("p1+TRANS(0,0,200)", in_tool([0.0, 0.0, 0.2])),
        ("SHIFT(p1 BY 10,0,0)", along([0.01, 0.0, 0.0])),
        ("TRANS(10,0,0)+p1", along([0.01, 0.0, 0.0])),
    ] {
        assert_eq!(
            by(&format!("CALL go(p[1])\nCALL go({given})"), go),
            expected,
            "{given}"
        );
    }
    // what is written out is a target, but not where its numbers are added up, too
    let blocked = |others: &str| {
        let text = format!(
            ".PROGRAM main()\nTOOL grip\nBASE NULL\nJMOVE #home\nCALL go(TRANS(1,2,3,4,5,6))\n.END\n{others}{POINTS}"
        );
        let program = read_files(&[&text]).expect("programs");
        let moved = program.moves.iter().filter_map(|of| program.target_of(of));
        let written_out = moved.filter(|target| target.name.is_none());
        written_out.map(|target| target.blocked).collect::<Vec<_>>()
    };
    assert_eq!(blocked(go), [false]);
    let both = ".PROGRAM go(.p)\nLMOVE p1+.p\nLMOVE .p\n.END\n";
    assert_eq!(blocked(both), [true]);
    let behind = ".PROGRAM go(.p)\nLMOVE .p\nLMOVE p1+.p\n.END\n";
    assert_eq!(blocked(behind), [true]);
}

#[test]
fn what_a_loop_adds_to_a_copy_counts_as_often_as_the_text_says() {
    let grown = |most| {
        let shift = Shift::along([0.012, 0.0, 0.0]);
        Displacement::Within(Box::new([Stride::By { shift, most }]))
    };
    let step = "POINT q = SHIFT(q BY 12,0,0)\nLMOVE q\nEND";
    for (text, most) in [
        (format!("FOR i = 1 TO 3\n{step}"), Some(3)),
        (format!("FOR i = 3 TO 1 STEP -1\n{step}"), Some(3)),
        (format!("FOR i = 1 TO n\n{step}"), None),
        (
            format!("FOR i = 1 TO 3\nIF SIG(1) THEN\ni = 1\nEND\n{step}"),
            None,
        ),
        (
            format!("FOR i = 1 TO 3\n10 TWAIT 1\nIF SIG(1) GOTO 10\n{step}"),
            None,
        ),
        (format!("WHILE SIG(1) DO\n{step}"), None),
    ] {
        assert_eq!(
            by(&format!("POINT q = p1\n{text}"), ""),
            grown(most),
            "{text}"
        );
    }
}
