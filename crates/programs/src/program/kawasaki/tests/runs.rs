//! What runs after what, and what programs hand to each other.

use super::*;

/// The targets that moves go to, each once.
fn targets(program: &Program) -> Vec<&str> {
    let all = program.moves.iter().filter_map(|m| target(program, m));
    let mut all: Vec<_> = all.collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// A program with these lines behind `TOOL` and `BASE`, and another.
fn read_two(code: &str, other: &str) -> Program {
    let text = format!(
        ".PROGRAM main()\nTOOL grip\nBASE NULL\n{code}\n.END\n.PROGRAM {other}\n.END\n{POINTS}"
    );
    read_files(&[&text]).expect("programs")
}

#[test]
fn parameters_are_joints_and_poses_and_bring_back_what_is_written() {
    for (code, other, expected) in [
        ("CALL put(&p1)", "put(.&p)\nLMOVE .p", "p1"),
        ("CALL put(p1)", "put(.p)\nLMOVE .&p", "p1"),
        ("CALL go(#home)", "go(.#p)\nJMOVE .#p", "#home"),
        ("CALL go(#home)", "go(.p)\nJMOVE .#p", "#home"),
        ("CALL get(p1)\nLMOVE p1", "get(.t)\nPOINT .t = p[2]", "p[2]"),
        (
            "CALL get(&p1)\nLMOVE p1",
            "get(.&t)\nPOINT .t = p[2]",
            "p[2]",
        ),
    ] {
        let program = read_two(code, other);
        assert_eq!(targets(&program), [expected], "{code}");
    }
    let program = read_two(
        "CALL get(off)\nTOOL off\nLMOVE p1",
        "get(.t)\nPOINT .t = grip",
    );
    let tool = &program.tools[program.moves[0].tool];
    let tip = tool.flange_from_tool.expect("known").translation;
    assert_eq!(tip, [0.0, 0.0, 0.15]);
}

#[test]
fn a_number_that_a_call_gives_chooses_the_branch() {
    let code = "CALL take(1)\nLMOVE p1\nCALL take(2)\nLMOVE p[1]";
    let placed = |code: &str, take: &str| -> Vec<String> {
        let program = read_two(code, take);
        let moves = program.moves.iter();
        let placed = moves.map(|m| {
            let tool = &program.tools[m.tool].name;
            format!("{} {tool}", target(&program, m).unwrap_or_default())
        });
        placed.collect()
    };
    for take in [
        "IF .n==1 THEN\nTOOL grip\nELSE\nTOOL off\nEND",
        "IF .n<>1 THEN\nTOOL off\nELSE\nTOOL grip\nEND",
        "IF SIG(1) THEN\nTOOL grip\nELSEIF .n==2 THEN\nTOOL off\nELSE\nTOOL grip\nEND",
        "IF .n==3 OR .n==1 THEN\nTOOL grip\nELSEIF .n==2 AND .n<>1 THEN\nTOOL off\nEND",
        "CASE .n OF\nVALUE 1:\nTOOL grip\nVALUE 2:\nTOOL off\nEND",
        "CASE .n OF\nVALUE 2:\nTOOL off\nANY :\nTOOL grip\nEND",
        "CASE .n OF\nVALUE 3, 2:\nTOOL off\nVALUE 7,1:\nTOOL grip\nEND",
    ] {
        let found = placed(code, &format!("take(.n)\n{take}"));
        if take.contains("SIG") {
            // what a signal may choose either way
            assert_eq!(found, ["p1 grip", "p[1] grip", "p[1] off"], "{take}");
        } else {
            assert_eq!(found, ["p1 grip", "p[1] off"], "{take}");
        }
    }
    let choice = "CASE .n OF\nVALUE 1:\nTOOL grip\nANY :\nTOOL off\nEND";
    for (code, take) in [
        ("CALL take(k)", "take(.n)"),
        ("CALL take(1)", "take(.n)\n.n = .n+1"),
        ("CALL take(1)", "take(.n)\nFOR .n = 1 TO 3\nEND"),
        ("CALL take(1)", "take(.n)\nCALL elsewhere(.n)"),
        (
            "CALL take(1)",
            "more(.m)\n.m = 2\n.END\n.PROGRAM take(.n)\nCALL more(.n)",
        ),
    ] {
        let found = placed(&format!("{code}\nLMOVE p1"), &format!("{take}\n{choice}"));
        assert_eq!(found, ["p1 grip", "p1 off"], "{take}");
    }
}

#[test]
fn a_parameter_is_the_name_that_the_call_gives() {
    // written by the one name or the other, in the program that is called or one that that calls
    for (go, expected) in [
        ("go(.p)\nPOINT p1 = p[2]\nLMOVE .p", ["p[2]"]),
        ("go(.p)\nPOINT .p = p[2]\nLMOVE p1", ["p[2]"]),
        (
            "go(.p)\nCALL set\nLMOVE .p\n.END\n.PROGRAM set\nPOINT p1 = p[2]",
            ["p[2]"],
        ),
        (
            "go(.p)\nCALL inner(.p)\n.END\n.PROGRAM inner(.q)\nPOINT p1 = p[2]\nLMOVE .q",
            ["p[2]"],
        ),
        (
            "go(.p)\nCALL inner(.p)\nLMOVE .p\n.END\n.PROGRAM inner(.q)\nPOINT .q = p[2]\nLMOVE p1",
            ["p[2]"],
        ),
        // another name stays what it is
        ("go(.p)\nPOINT p[1] = p[2]\nLMOVE .p", ["p1"]),
    ] {
        let program = read_two("CALL go(p1)", go);
        assert_eq!(targets(&program), expected, "{go}");
    }
    let program = read_two(
        "HERE p[2]\nCALL go(p1)",
        "go(.p)\nPOINT p1 = p[2]\nLMOVE .p",
    );
    assert!(
        ids(&program).contains(&"run-time-position"),
        "{:?}",
        program.findings
    );
}

#[test]
fn what_a_program_writes_that_it_is_handed_is_no_constant() {
    let get = "get(.t)\nPOINT .t = p[2]";
    let pass = format!("pass(.o)\nCALL get(.o)\n.END\n.PROGRAM {get}");
    for (code, other) in [("CALL get(off)", get), ("CALL pass(off)", &pass)] {
        let program = read_two(&format!("{code}\nLMOVE p1+off"), other);
        assert_eq!(program.moves[0].displacement, Displacement::Unbounded);
    }
    let program = read_two("CALL put(off)\nLMOVE p1+off", "put(.p)\nx = DX(.p)");
    assert!(matches!(program.moves[0].displacement, Displacement::By(_)));
}

#[test]
fn the_last_branch_of_a_choice_needs_no_colon() {
    for any in ["ANY", "ANY :"] {
        let program = read(&format!(
            "TOOL NULL\nBASE NULL\nPOINT q = p[1]\nCASE n OF\nVALUE 1:\nPOINT q = p1\n{any}\nPOINT \
             q = p[2]\nEND\nLMOVE q"
        ));
        assert_eq!(targets(&program), ["p1", "p[2]"], "{any}");
    }
}

#[test]
fn of_a_sum_the_last_name_is_defined() {
    for code in ["HERE p1+off", "POINT p1+off = p[2]"] {
        let program = read(&format!(
            "TOOL NULL\nBASE NULL\n{code}\nLMOVE p1\nLMOVE p1+off"
        ));
        assert_eq!(targets(&program), ["p1"], "{code}");
        assert_eq!(program.moves[0].displacement, Displacement::None);
        assert_eq!(
            program.moves[1].displacement,
            Displacement::Unbounded,
            "{code}"
        );
    }
}

#[test]
fn programs_are_called_by_texts_and_jumped_to() {
    let program = read_two("SCALL \"Other\"\nLMOVE p1", "other()\nTOOL off");
    assert_eq!(program.tools[program.moves[0].tool].name, "off");
    for jump in ["JUMP other", "SJUMP \"other\""] {
        let program = read_two(&format!("LMOVE p1\n{jump}"), "other()\nLMOVE p[2]");
        let tools = program.moves.iter().map(|m| &program.tools[m.tool].name);
        assert_eq!(tools.collect::<Vec<_>>(), ["grip", "grip"], "{jump}");
    }
    // only the running program knows which
    for call in ["SCALL $name,err", "EXTCALL"] {
        let program = read_two(&format!("{call}\nLMOVE p1"), "pg1()\nPOINT p1 = p[2]");
        assert_eq!(targets(&program), ["p1", "p[2]"], "{call}");
    }
    let program = read_two("EXTCALL\nLMOVE p1", "page()\nPOINT p1 = p[2]");
    assert_eq!(targets(&program), ["p1"]);
}

#[test]
fn a_signal_goes_to_its_label_until_it_is_ignored() {
    let program = read(
        "TOOL NULL\nBASE NULL\nPOINT q = p1\nONI/LVL 1001 GOTO 100\nPOINT q = p[1]\nIGNORE \
         1001\nPOINT q = p[2]\nRETURN\n100 LMOVE q",
    );
    assert_eq!(targets(&program), ["p1", "p[1]"]);
}

#[test]
fn a_signal_is_watched_wherever_the_program_may_come_with_it() {
    for (code, expected) in [
        // the branch may not have run
        (
            "POINT q = p1\nON 1001 GOTO 100\nIF x THEN\nIGNORE 1001\nEND\nPOINT q = p[1]\nSTOP\n100 \
             LMOVE q",
            &["p1", "p[1]"][..],
        ),
        // the program comes back to what stands before
        (
            "5\nPOINT q = p1\nPOINT q = p[1]\nON 1001 GOTO 100\nPOINT q = p[2]\nGOTO 5\n100 LMOVE q",
            &["p1", "p[1]", "p[2]"],
        ),
        // what stands before runs once
        (
            "POINT q = p1\nPOINT q = p[1]\nON 1001 GOTO 100\nSTOP\n100 LMOVE q",
            &["p[1]"],
        ),
    ] {
        let program = read(&format!("TOOL NULL\nBASE NULL\n{code}"));
        assert_eq!(targets(&program), expected, "{code}");
    }
}

#[test]
fn programs_are_started_by_errors_and_without_a_number() {
    for start in ["PCEXECUTE other,-1", "PCEXECUTE 2: other", "PCEX other"] {
        let program = read_two(&format!("{start}\nLMOVE p1"), "other()\nPOINT p1 = p[2]");
        assert_eq!(targets(&program), ["p1", "p[2]"], "{start}");
    }
    let program = read_two("ONE other\nLMOVE p1", "other()\nPOINT p1 = p[2]\nRETURNE");
    assert_eq!(targets(&program), ["p1", "p[2]"]);
    // behind it nothing runs
    let program = read_two("CALL other\nLMOVE p1", "other()\nRETURNE\nTOOL off");
    assert_eq!(program.tools[program.moves[0].tool].name, "grip");
}

#[test]
fn keywords_may_be_cut_short() {
    let program = read(
        "TOOL NULL\nBA NULL\nJM #home\nx = 5\npo[1] = 3\nLM p1\nPO q = p[2]\nIF SIG(1) GO 10\nPO q = \
         p[1]\n10 lmov q\nLE\nJA p1,50",
    );
    assert_eq!(targets(&program), ["#home", "p1", "p[1]", "p[2]"]);
    assert!(ids(&program).contains(&"configuration-not-understood"));
    let program = read("TOOL NULL\nBASE NULL\nX p1 TILL 1001");
    assert!(ids(&program).contains(&"search-move"));
}

#[test]
fn tools_and_bases_are_sums_and_tools_have_a_shape() {
    let program = read("TOOL grip,1\nBASE off+off\nLMOVE p1");
    let motion = &program.moves[0];
    assert_eq!(program.tools[motion.tool].name, "grip");
    let base = program.frames[motion.frame].world_from_frame;
    assert_eq!(base.expect("known").translation, [0.0, 0.0, -0.1]);
}

#[test]
fn a_name_that_is_added_to_another_is_no_target() {
    for code in [
        "TOOL grip+off\nLMOVE p1\nTOOL NULL\nLMOVE off",
        "BASE p1+off\nLMOVE p[1]\nBASE NULL\nLMOVE off",
        "LMOVE p1+off\nBASE grip\nLMOVE off",
        "BASE off+grip\nLMOVE p1\nBASE NULL\nLMOVE off",
    ] {
        let program = read(&format!("TOOL NULL\nBASE NULL\nJMOVE #home\n{code}"));
        let found = (program.findings.iter()).find(|finding| finding.id == "target-used-as-frame");
        let found = found.expect(code);
        assert!(
            found.message.starts_with("off: ") && found.message.contains("(see 0.as line 5)"),
            "{code}: {}",
            found.message
        );
    }
    // what no move goes to stays as it is
    let program = read("TOOL NULL\nBASE grip+off\nJMOVE #home\nLMOVE p1+off");
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
}

#[test]
fn elements_of_an_array_are_those_of_the_call() {
    let tools = |program: &Program| -> Vec<String> {
        let moves = program.moves.iter().filter(|one| one.target.is_some());
        let name = |one: &Move| program.tools[one.tool].name.clone();
        moves.map(name).collect()
    };
    let program = read_two("CALL sub(p[])", "sub(.q[])\nLMOVE .q[2]");
    assert_eq!(targets(&program), ["p[2]"]);
    let program = read_two("CALL sub(p[],1)", "sub(.q[],.n)\nTOOL off\nLMOVE .q[.n]");
    assert_eq!(targets(&program), ["p[1]", "p[2]"]);
    assert_eq!(tools(&program), ["off", "off"]);
    assert_eq!(ids(&program), [""; 0]);
    // handed on, and written
    let program = read_two(
        "CALL sub(p[])\nLMOVE p[1]\nLMOVE p[2]",
        "sub(.q[])\nCALL put(.q[])\n.END\n.PROGRAM put(.r[])\nPOINT/Z .r[2] = 300",
    );
    assert_eq!(targets(&program), ["p[1]"]);
    assert!(ids(&program).contains(&"target-assigned-at-run-time"));
    // to a program that the files do not have
    let program = read_two("CALL away(p[])\nLMOVE p[2]", "other()");
    assert!(ids(&program).contains(&"target-passed-to-routine"));
}

#[test]
fn what_is_added_to_a_plate_is_a_target_on_it() {
    let used = |program: &Program| -> Vec<(String, String, Option<[f64; 3]>, Displacement)> {
        let each = program.moves.iter().map(|one| {
            let frame = &program.frames[one.frame];
            let at = frame.world_from_frame.map(|pose| pose.translation);
            let name = target(program, one).unwrap_or_default().to_owned();
            (name, frame.name.clone(), at, one.displacement.clone())
        });
        each.collect()
    };
    let on = |name: &str, frame: &str, at: [f64; 3]| {
        (
            name.to_owned(),
            frame.to_owned(),
            Some(at),
            Displacement::None,
        )
    };
    // the numbers of p1
    let at = [0.1, 0.9, 0.2];
    let program = read_two(
        "LMOVE p1+p[1]\nLMOVE p1+p[i]\nLMOVE off\nLMOVE p1+TRANS(1,2,3,4,5,6)",
        "other()",
    );
    assert_eq!(
        used(&program),
        [
            on("p[1]", "p1", at),
            on("p[1]", "p1", at),
            on("p[2]", "p1", at),
            on("off", "NULL", [0.0; 3]),
            on("here", "p1", at),
        ]
    );
    assert_eq!(ids(&program), [""; 0]);
    let program = read_two(
        "BASE off\nLMOVE p1+p[2]\nBASE NULL\nLMOVE p1+p[2]",
        "other()",
    );
    let both = used(&program);
    assert_eq!(
        (both[0].1.as_str(), &both[1]),
        ("off+p1", &on("p[2]", "p1", at))
    );
    let height = both[0].2.expect("known")[2];
    assert!((height - 0.15).abs() < 1e-12);
    // along the base: p1 is rotated by half a revolution about an axis in its plane
    let program = read_two("LMOVE p1+p[2]\nDRAW 0,0,10\nLDEPART 5", "other()");
    let Displacement::By(draw) = &program.moves[1].displacement else {
        panic!("{:?}", program.moves[1]);
    };
    assert!((draw.in_frame.translation[2] + 0.01).abs() < 1e-12);
    assert_eq!(used(&program)[2].1, "p1");
    // a move goes to p1 itself, the offset is another's, too, or is written or handed over
    for (code, other) in [
        ("LMOVE p1+off\nLMOVE p1", "other()"),
        ("LMOVE p1+off\nLMOVE p[1]+off", "other()"),
        ("LMOVE p1+off\nTOOL off", "other()"),
        ("LMOVE p1+off\nPOINT q = off", "other()"),
        ("LMOVE p1+off\nCALL put(off)", "put(.p)\nx = DX(.p)"),
        ("LMOVE p1+off\nCALL put(p1)", "put(.p)\nLMOVE .p"),
    ] {
        let program = read_two(code, other);
        let (name, frame, _, displacement) = &used(&program)[0];
        assert_eq!((name.as_str(), frame.as_str()), ("p1", "NULL"), "{code}");
        assert!(matches!(displacement, Displacement::By(_)), "{code}");
    }
}

/// Target, work frame and its place of each move, mm.
fn on_frames(program: &Program) -> Vec<(String, String, Option<[i64; 3]>)> {
    let each = program.moves.iter().map(|one| {
        let frame = &program.frames[one.frame];
        let at = frame.world_from_frame.map(|pose| pose.translation);
        #[allow(clippy::cast_possible_truncation)]
        let at = at.map(|at| at.map(|along| (along * 1e3).round() as i64));
        let name = target(program, one).unwrap_or_default().to_owned();
        (name, frame.name.clone(), at)
    });
    each.collect()
}

#[test]
fn a_plate_may_be_a_sum_itself() {
    let points = ".TRANS\npal 100 900 200 0 0 0\nat 10 0 5 0 0 0\no1 1 2 3 4 5 6\no2 1 2 3 4 5 \
         7\nup 0 0 -50 0 0 0\ngrip 0 0 150 0 0 0\n.END\n";
    let with = |code: &str| {
        let text = format!(".PROGRAM a()\nTOOL grip\nBASE NULL\n{code}\n.END\n{points}");
        read_files(&[&text]).expect("programs")
    };
    let on = |name: &str, frame: &str, at: [i64; 3]| (name.to_owned(), frame.to_owned(), Some(at));
    let both = [
        on("o1", "pal+at", [110, 900, 205]),
        on("o2", "pal+at", [110, 900, 205]),
    ];
    let program = with("LMOVE pal+at+o1\nLMOVE pal+at+o2");
    assert_eq!(on_frames(&program), both);
    assert_eq!(ids(&program), [""; 0]);
    let program = with("LAPPRO pal+at+o1,50\nLMOVE SHIFT(pal+at+o2 BY 0,0,10)\nDRAW 0,0,1");
    assert_eq!(on_frames(&program)[..2], both);
    assert!(
        program
            .moves
            .iter()
            .all(|one| matches!(one.displacement, Displacement::By(_)))
    );
    // one of them is a plate by itself, too
    let program = with("LMOVE pal+at+o1\nLMOVE pal+o2");
    assert_eq!(
        on_frames(&program),
        [both[0].clone(), on("o2", "pal", [100, 900, 200])]
    );
    // what is added to several objects is no object
    let program = with("LMOVE pal+o1+up\nLMOVE pal+o1\nLMOVE pal+o2+up");
    let plain = ["o1", "o1", "o2"].map(|name| on(name, "pal", [100, 900, 200]));
    assert_eq!(on_frames(&program), plain);
    let displaced = |at: usize| matches!(program.moves[at].displacement, Displacement::By(_));
    assert_eq!([0, 1, 2].map(displaced), [true, false, true]);
}

#[test]
fn what_is_taught_on_a_plate_is_the_object() {
    let main = "LMOVE p1+p[1]";
    let (name, frame) = ("p[1]".to_owned(), "p1".to_owned());
    let gone = |code: &str, other: &str| {
        let program = read_two(code, other);
        let all = on_frames(&program).into_iter();
        let all = all.map(|(name, frame, _)| (name, frame));
        all.collect::<Vec<_>>()
    };
    assert_eq!(
        gone(main, "teach()\nHERE p1+p[2]"),
        [(name.clone(), frame.clone())]
    );
    // the last name is written, and nothing else
    let program = read_two("HERE p1+p[1]\nLMOVE p1+p[1]\nLMOVE p1+p[2]", "other()");
    let is_as_read = program.findings.iter().any(|f| f.id == "run-time-position");
    assert!(is_as_read, "{:?}", program.findings);
    assert_eq!(
        on_frames(&program)
            .last()
            .map(|(name, frame, _)| (&**name, &**frame)),
        Some(("p[2]", "p1"))
    );
    assert!(!targets(&program).contains(&"p1"), "{program:?}");
    let program = read_two("LMOVE p1+q\nLMOVE p1+p[2]", "teach()\nHERE p1+q");
    assert_eq!(targets(&program), ["p[2]"]);
}

#[test]
fn six_literals_of_a_point_of_joints_are_joints() {
    let program = read("TOOL grip\nBASE NULL\nJMOVE #PPOINT(10,20,-90,0,-60,0)\nLMOVE p1");
    let first = program.target_of(&program.moves[0]).expect("joints");
    assert_eq!(first.layout.shape, Shape::Joints);
    let numbers = program.numbers_of(first).iter().map(|number| number.value);
    assert!(numbers.eq([10.0, 20.0, -90.0, 0.0, -60.0, 0.0]));
    assert_eq!(ids(&program), [""; 0]);
    let program = read("TOOL grip\nBASE NULL\nJMOVE #PPOINT(x,20,-90,0,-60,0)");
    assert_eq!(ids(&program), ["computed-target"]);
}

#[test]
fn the_program_that_the_controller_starts_by_itself_runs_at_any_time() {
    let program = read_two("LMOVE p1", "AutoStart2.pc\nPOINT p1 = p[2]");
    assert_eq!(targets(&program), ["p1", "p[2]"]);
    assert!(!ids(&program).contains(&"write-not-called"));
    let program = read_two("LMOVE p1", "other.pc\nPOINT p1 = p[2]");
    assert!(ids(&program).contains(&"write-not-called"));
}

#[test]
fn programs_of_one_name_are_reported_and_both_are_followed() {
    let other = ".PROGRAM GO\nLMOVE p[2]\n.END\n";
    let main = format!(
        ".PROGRAM main()\nTOOL grip\nBASE NULL\nCALL go\n.END\n.PROGRAM go()\nLMOVE p1\n.END\n\
         {POINTS}"
    );
    let program = read_files(&[&main, other]).expect("programs");
    assert_eq!(targets(&program), ["p1", "p[2]"]);
    let found = program.findings.iter();
    let mut found = found.filter(|found| found.id == "target-name-ambiguous");
    let only = found.next().expect("a warning");
    let place = (only.severity, only.file.as_str(), only.line);
    assert_eq!(place, (Severity::Warning, "1.as", 1));
    assert!(found.next().is_none());
}

#[test]
fn a_file_may_have_reals_alone() {
    let reals = ".REALS\nup = 30\n.END\n";
    assert!(Kawasaki.recognises(&Source::new("b.as", reals.as_bytes().to_vec())));
    let main = format!(".PROGRAM main()\nTOOL grip\nBASE NULL\nLAPPRO p1,up\n.END\n{POINTS}");
    let program = read_files(&[&main, reals]).expect("programs");
    let Displacement::By(by) = &program.moves[0].displacement else {
        panic!("{:?}", program.moves[0].displacement);
    };
    assert_eq!(by.in_tool.translation, [0.0, 0.0, -0.03]);
}

#[test]
fn a_target_of_whose_numbers_another_is_built_is_not_corrected() {
    for code in [
        "POINT x = TRANS(DX(p1)+50,DY(p1),DZ(p1),0,180,0)\nLMOVE x\nLMOVE p1",
        "LMOVE p1\nLMOVE TRANS(dx(p1),0,0,0,180,0)",
    ] {
        let program = read(&format!("TOOL grip\nBASE NULL\n{code}"));
        assert!(ids(&program).contains(&"target-used-as-frame"), "{code}");
    }
    let program = read("TOOL grip\nBASE NULL\nLMOVE p1\n.h = DZ(p1)\nTYPE DX(p1)");
    assert_eq!(ids(&program), [""; 0]);
}

#[test]
fn a_tool_or_base_that_turns_many_times_is_in_another_unit() {
    for (tool, base, expected) in [
        ("700", "700", None),
        ("2500", "0", Some("angle-too-large")),
        ("0", "-1e5", Some("angle-too-large")),
    ] {
        let text = format!(
            ".PROGRAM a()\nTOOL t\nBASE b\nJMOVE #h\nLMOVE p1\n.END\n.TRANS\nt 0 0 100 0 {tool} 0\nb 0 \
             0 9 {base} 0 0\np1 400 0 300 0 180 0\n.END\n.JOINTS\n#h 0 0 -90 0 -60 0\n.END\n"
        );
        let program = read_files(&[&text]).expect("a program");
        let errors = program
            .findings
            .iter()
            .filter(|f| f.severity == Severity::Error);
        let ids: Vec<_> = errors.map(|f| f.id).collect();
        assert_eq!(
            ids,
            expected.into_iter().collect::<Vec<_>>(),
            "{tool} {base}"
        );
    }
}

#[test]
fn an_element_that_the_running_program_chooses_is_what_programs_make_of_it() {
    let last = |code: &str, more: &str| {
        let text = format!("{more}.PROGRAM main()\nTOOL grip\nBASE NULL\n{code}\n.END\n{POINTS}");
        let program = read_files(&[&text]).expect("a program");
        targets(&program).join(" ")
    };
    // written by number before any text names one of the array
    let set = ".PROGRAM sub(.i)\nPOINT w[.i] = p1\n.END\n";
    let code = "POINT w[1] = p[1]\nCALL sub(1)\nLMOVE w[1]";
    assert_eq!(last(code, set), "p1 p[1]");
    // handed over by number
    let set = ".PROGRAM rd(.x)\nPOINT .x = p1\n.END\n.PROGRAM through(.y)\nCALL rd(.y)\n.END\n";
    for name in ["rd", "through"] {
        let code = format!("FOR i = 1 TO 2\nCALL {name}(p[i])\nEND\nLMOVE p[2]");
        assert_eq!(last(&code, set), "p1 p[2]");
    }
    // a program that only reads it leaves it
    let goes = ".PROGRAM rd(.x)\nLMOVE .x\n.END\n";
    assert_eq!(last("CALL rd(p[i])\nLMOVE p[1]", goes), "p[1] p[2]");
}

#[test]
fn an_array_of_which_only_chosen_elements_are_written_holds_what_is_written() {
    for name in ["w", ".w"] {
        let copy = format!("FOR .i = 1 TO 2\nPOINT {name}[.i] = p[.i]\nEND");
        for goes in [format!("LMOVE {name}[.i]"), format!("LMOVE {name}[1]")] {
            let text =
                format!(".PROGRAM main()\nTOOL grip\nBASE NULL\n{copy}\n{goes}\n.END\n{POINTS}");
            let program = read_files(&[&text]).expect("a program");
            assert_eq!(targets(&program), ["p[1]", "p[2]"], "{goes}");
        }
    }
}

#[test]
fn a_jump_asks_the_number_that_a_call_gives() {
    for ask in ["IF .n==1 GOTO 10", "GOTO 10 IF .n==1", "IF .n<>2 GOTO 10"] {
        let text = format!(
            ".PROGRAM main()\nBASE NULL\nCALL sw(1)\nLMOVE p1\nCALL sw(2)\nLMOVE p[1]\n.END\n\
             .PROGRAM sw(.n)\n{ask}\nTOOL TRANS(0,0,150)\nRETURN\n10 TOOL TRANS(20,0,100)\n.END\n\
             {POINTS}"
        );
        let program = read_files(&[&text]).expect("programs");
        let tools = program.moves.iter().map(|motion| {
            let tool = program.tools[motion.tool].flange_from_tool.expect("a tool");
            (
                target(&program, motion).expect("a target"),
                tool.translation,
            )
        });
        let expected = [("p1", [0.02, 0.0, 0.1]), ("p[1]", [0.0, 0.0, 0.15])];
        assert_eq!(tools.collect::<Vec<_>>(), expected, "{ask}");
        assert!(
            program
                .findings
                .iter()
                .all(|of| of.severity == Severity::Note),
            "{ask}"
        );
    }
}
