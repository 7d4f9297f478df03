//! What is followed through instructions and jobs: what moves go to, with what, from where, and
//! what is said of it.

use super::*;
use crate::program::Before;

/// The ids of errors.
fn errors(program: &Program) -> Vec<&str> {
    let errors = program
        .findings
        .iter()
        .filter(|f| f.severity == crate::finding::Severity::Error);
    errors.map(|f| f.id).collect()
}

/// A job in a user frame, with base, station and variables.
fn cell(instructions: &str) -> Program {
    let positions = format!(
        "{USER}{}P00001={P6}\n///PULSE\nBC00000=0\nBC00001=0,500\nEC00000=0.0\nEC00001=-45.0,0",
        points(3)
    );
    read(&job(&positions, instructions))
}

#[test]
fn moves_that_cannot_be_compensated_are_errors() {
    for (instructions, id) in [
        (
            "SMOVL C00000 BC00000 V=1000.0 +MOVJ EC00000",
            "moving-frame",
        ),
        ("MOVL C00000 V=5 SRCH RIN#(1)=ON", "search-move"),
        ("IMOV P001 V=5.0 RF", "relative-move"),
        ("MOVJ C00000 +MOVJ C00001", "second-robot"),
        ("SYMOVL C00000 V=5 CV#(1)", "moving-frame"),
        ("MOVL V=5", "move-not-supported"),
        (
            "SVSPOTMOV C00000 V=1500.0 PLIN=0 CLF#(1) GUN#(1)",
            "move-not-supported",
        ),
        ("MOVL C00009 V=5", "target-not-in-files"),
        ("MOVL P077 V=5", "target-not-in-files"),
        ("MOVL C00000 BC00001 V=5", "external-axis-unknown"),
        ("MOVL C00000 BC00007 V=5", "external-axis-unknown"),
        ("MOVL C00000 LBP001 V=5", "external-axis-unknown"),
        ("MOVJ C00000 VJ=5.0  +MOVJ EC00001", "external-axis-unknown"),
        (
            "SFTON P001 UF#(1)\nMOVL C00000 V=5\nSFTOF",
            "displacement-active",
        ),
        (
            "MFRAME UF#(12) P001 P002 P003\nMOVL C00000",
            "frame-assigned-at-run-time",
        ),
        (
            "MFRAME UF#(I000) P001\nMOVL C00000",
            "frame-assigned-at-run-time",
        ),
        (
            "SETTOOL TL#(3) PX000\nMOVL C00000",
            "frame-assigned-at-run-time",
        ),
        (
            "MOVL P001 V=5\nSETE P001 (3) 100",
            "target-assigned-at-run-time",
        ),
        (
            "MOVL P001 V=5\nSUB P[B000] P002",
            "target-assigned-at-run-time",
        ),
        (
            "MOVL P001 V=5\nADD P001 P002",
            "target-assigned-at-run-time",
        ),
    ] {
        let program = cell(instructions);
        assert_eq!(
            errors(&program),
            [id],
            "{instructions}: {:?}",
            program.findings
        );
        let line = program.findings.iter().find(|f| f.id == id).map(|f| f.line);
        assert!(line.is_some_and(|line| line > 3));
    }
}

#[test]
fn a_moved_axis_is_reported_with_its_value() {
    let program = cell("MOVL C00000 BC00001 V=5");
    let found = program
        .findings
        .iter()
        .find(|f| f.id == "external-axis-unknown");
    let message = &found.expect("an error").message;
    assert!(
        message.contains("axis 2 of the base stands at 500 (BC00001)"),
        "{message}"
    );
    for still in [
        "MOVL C00000 BC00000 V=5",
        "MOVJ C00000 EC00000 VJ=5",
        "MOVL C00000 V=5  +MOVJ EC00000 VJ=5",
    ] {
        assert_eq!(errors(&cell(still)), [""; 0], "{still}");
    }
}

#[test]
fn what_the_running_program_computes_stays_and_is_reported_once_a_place() {
    for (instructions, ids_of) in [
        ("MOVL LP000 V=5", &["computed-target"][..]),
        (
            "MOVL P[I000] V=5",
            &["computed-target", "position-variable"],
        ),
        (
            "MOVL P[I000] V=5\nSETE P[I000] (1) 5",
            &["computed-target", "position-variable"],
        ),
        (
            "MOVL P[I000] V=5\nGETS PX077 $PX000",
            &["computed-target", "position-variable"],
        ),
        ("MOVL LP[I000] V=5", &["computed-target"]),
        ("GETS PX077 $PX002\nMOVL P077 V=5", &["computed-target"]),
        (
            "MULMAT PX077 PX078 PX079\nMOVL P077 V=5",
            &["computed-target"],
        ),
        (
            "GETS LPX001 $PX000\nCNVRT LPX001 LPX001 BF\nMOVL LP001 V=5",
            &["run-time-position"],
        ),
        ("GETS PX077 $PX001\nMOVL P077 V=5", &["run-time-position"]),
        // the position of the files holds in the first run
        (
            "MOVL P001 V=5\nGETS PX001 $PX000",
            &["position-variable", "run-time-position"],
        ),
        (
            "GETS LPX001 $PX000\nADD LP001 P001\nMOVL LP001 V=5",
            &["computed-target"],
        ),
    ] {
        let program = cell(&format!("MOVL C00000\n{instructions}\nMOVL C00001"));
        assert_eq!(errors(&program), [""; 0], "{instructions}");
        let mut found = ids(&program);
        found.retain(|id| *id != "target-unused-here");
        found.sort_unstable();
        assert_eq!(found, ids_of, "{instructions}");
        // the move is there, and the next one comes from it
        let at = |name: &str| {
            let target = program
                .targets
                .iter()
                .position(|t| t.name.as_deref() == Some(name));
            program.moves.iter().position(|m| m.target == target)
        };
        let (first, last) = (at("C00000").expect("a move"), at("C00001").expect("a move"));
        assert!(last > first + 1, "{instructions}");
        assert_ne!(
            program.moves[last].before,
            Before::One(u32::try_from(first).expect("few moves")),
            "{instructions}"
        );
    }
}

#[test]
fn the_next_move_knows_that_an_incremental_one_moved_the_robot() {
    let program = cell("MOVL C00000\nIMOV P001 V=5.0 RF\nMOVL C00001");
    assert_eq!(errors(&program), ["relative-move"]);
    assert_eq!(program.moves[1].target, None);
    assert_eq!(program.moves[2].before, Before::One(1));
}

#[test]
fn copies_of_positions_are_those_positions() {
    let program = cell("SET LP001 P001\nSET LP002 LP001\nMOVL LP002 V=5\nMOVL C00000");
    assert_eq!(errors(&program), [""; 0]);
    let motion = &program.moves[0];
    assert_eq!(
        program.target_of(motion).and_then(|t| t.name.as_deref()),
        Some("P001")
    );
    assert_eq!(program.tools[motion.tool].name, "3");
    assert_eq!(program.frames[motion.frame].name, "12");
    // one variable, two tools
    let positions = format!("{USER}P00001={P6}\n///TOOL 4\nP00002={P6}");
    let moves = "IFTHEN IN#(1)=ON\nSET LP001 P001\nELSE\nSET LP001 P002\nENDIF\nMOVL LP001 V=5";
    let program = read(&job(&positions, moves));
    assert_eq!(errors(&program), [""; 0]);
    let mut pairs: Vec<_> = program
        .moves
        .iter()
        .filter_map(|m| {
            let name = program.target_of(m)?.name.as_deref()?;
            Some((name, program.tools[m.tool].name.as_str()))
        })
        .collect();
    pairs.sort_unstable();
    // what goes together in a branch is not followed: each with either is refused, being shared
    let each = |name| [(name, "3"), (name, "4")];
    assert_eq!(pairs, [each("P001"), each("P002")].concat());
}

#[test]
fn frames_are_unknown_only_where_the_write_reaches() {
    // kept from run to run: the second run begins with what the first one left
    let after = "MOVL C00000\nMFRAME UF#(12) P001 P002 P003";
    assert_eq!(errors(&cell(after)), ["frame-assigned-at-run-time"]);
    let other = "MFRAME UF#(15) P001 P002 P003\nMOVL C00000";
    assert_eq!(errors(&cell(other)), [""; 0]);
}

#[test]
fn jobs_take_positions_as_arguments() {
    let positions = format!("{USER}P00001={P6}\nP00002={P6}\nC00000={P6}");
    let main = job(
        &positions,
        "CALL JOB:GO ARGFI001 ARGFP001\nCALL JOB:GO ARGF5 ARGF P002",
    );
    let go = job("", "GETARG LP003 IARG#(2)\nMOVL LP003 V=5").replace("//NAME A", "//NAME GO");
    let program = read_files(&[&main, &go], &Settings::default()).expect("jobs");
    assert_eq!(errors(&program), [""; 0]);
    let mut names: Vec<_> = program
        .moves
        .iter()
        .filter_map(|m| program.target_of(m)?.name.clone())
        .collect();
    names.sort_unstable();
    assert_eq!(names, ["P001".into(), "P002".into()] as [Box<str>; 2]);
    // what one call gives the next does not find there
    let main = job(
        &positions,
        "CALL JOB:GO ARGFP001 ARGFP001\nCALL JOB:GO ARGFP001 ARGFI001",
    );
    let program = read_files(&[&main, &go], &Settings::default()).expect("jobs");
    assert!(program.findings.iter().any(|f| f.id == "computed-target"));
    // and what it does not give, the one before does not give either
    let main = job(
        &positions,
        "CALL JOB:GO ARGFP001 ARGFP001\nCALL JOB:GO ARGFP001",
    );
    let program = read_files(&[&main, &go], &Settings::default()).expect("jobs");
    assert!(program.findings.iter().any(|f| f.id == "computed-target"));
    // nor does a job find what it left in its own variables
    let main = job(&positions, "CALL JOB:GO\nCALL JOB:GO");
    let go = job("", "MOVL LP003 V=5\nSET LP003 P001").replace("//NAME A", "//NAME GO");
    let program = read_files(&[&main, &go], &Settings::default()).expect("jobs");
    assert!(program.findings.iter().any(|f| f.id == "computed-target"));
    assert!(program.moves.iter().all(|m| m.target.is_none()));
    // to a job that nobody has
    let program = read(&job(&positions, "CALL JOB:GO ARGFP001\nMOVL P001"));
    assert_eq!(errors(&program), ["target-passed-to-routine"]);
}

#[test]
fn jobs_take_positions_of_steps_each_with_its_own_frame() {
    let other = USER.replace("12", "13");
    let positions = format!("{USER}C00000={P6}\n{other}C00001={P6}");
    let main = "CALL JOB:GO ARGFC00000\nCALL JOB:GO ARGFC00001";
    let go = job("", "GETARG LP000 IARG#(1)\nMOVL LP000").replace("//NAME A", "//NAME GO");
    let program = read_files(&[&job(&positions, main), &go], &Settings::default()).expect("jobs");
    assert_eq!(errors(&program), [""; 0]);
    let mut named: Vec<_> = program
        .moves
        .iter()
        .filter_map(|m| {
            let name = program.target_of(m)?.name.clone()?;
            Some((name, program.frames[m.frame].name.as_str()))
        })
        .collect();
    named.sort_unstable();
    assert_eq!(named, [("C00000".into(), "12"), ("C00001".into(), "13")]);
    // a variable that is one after the other
    let one = job(
        &positions,
        "SET P001 C00000\nMOVL P001\nSET P001 C00001\nMOVL P001",
    );
    let program = read(&one);
    let frames = program.moves.iter().map(|m| &program.frames[m.frame].name);
    assert_eq!(frames.collect::<Vec<_>>(), ["12", "13"]);
    // to a job that nobody has
    let program = read(&job(&positions, "CALL JOB:OTHER ARGFC00000\nMOVL C00000"));
    assert_eq!(errors(&program), ["target-passed-to-routine"]);
}

#[test]
fn a_macro_or_a_numbered_job_may_do_what_the_text_does_not_say() {
    let positions = format!("{USER}{}P00001={P6}", points(1));
    for call in [
        "MACRO1 MJ#(28) ARGFP001",
        "CALL S000 ARGFP001",
        "CALL IG#(1) ARGFP001",
    ] {
        let program = read(&job(&positions, &format!("{call}\nMOVL P001")));
        assert_eq!(errors(&program), ["target-passed-to-routine"], "{call}");
    }
    // which is one of the files, or another
    let shifting = "SFTON P002 UF#(12)\nRET";
    for (call, name, is_shifted) in [
        ("CALL IG#(1)", "1", true),
        ("CALL B000", "1", true),
        ("CALL I000", "ON", false),
        ("CALL S000", "ON", true),
        ("CALL JOB:2", "1", false),
    ] {
        let main = job(&positions, &format!("{call}\nMOVL C00000"));
        let other = job("", shifting).replace("//NAME A", &format!("//NAME {name}"));
        let program = read_files(&[&main, &other], &Settings::default()).expect("jobs");
        let found = errors(&program).contains(&"displacement-active");
        assert_eq!(found, is_shifted, "{call} {name}");
    }
}

#[test]
fn jobs_begin_where_their_callers_stand() {
    let positions = format!("{USER}{}", points(2)).replace("RCONF 1,", "RCONF -1,");
    let named = |name: &str, text: &str| {
        job(&positions, text).replace("//NAME A", &format!("//NAME {name}"))
    };
    let befores = |main: &str, sub: &str| {
        let files = [named("MAIN", main), named("SUB", sub)];
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        let program = read_files(&files, &Settings::default()).expect("jobs");
        let reported = program.findings.iter().filter(|f| f.id == "wrist-not-told");
        let reported: Vec<_> = reported.map(|f| f.file.clone()).collect();
        (
            program.moves.iter().map(|m| m.before).collect::<Vec<_>>(),
            reported,
        )
    };
    let main = "MOVL C00000\nCALL JOB:SUB\nMOVL C00001";
    let (found, reported) = befores(main, "MOVL C00000");
    assert_eq!(found, [Before::Start, Before::One(2), Before::One(0)]);
    assert_eq!(reported, ["0.JBI"]);
    // JUMP does not come back: what follows is dead
    let (found, _) = befores("MOVL C00000\nJUMP JOB:SUB\nMOVL C00001", "MOVL C00000");
    assert_eq!(found, [Before::Start, Before::Anywhere, Before::One(0)]);
    // a job that runs concurrently
    let (found, reported) = befores("PSTART JOB:SUB SUB1\nMOVL C00000", "MOVL C00000");
    assert_eq!(found, [Before::Start, Before::Anywhere]);
    assert_eq!(reported.len(), 2);
}

#[test]
fn jobs_relative_to_a_station_are_recognised_in_every_line_end() {
    let text = job(&format!("{USER}{}", points(1)), "MOVL C00000");
    let relative = text
        .replace("SC,RW\n", "SC,RW,RJ\n")
        .replace("RB1\n", "RB1\n///GROUP2 ST1\n");
    for end in ["\n", "\r\n", "\r"] {
        let program = read(&relative.replace('\n', end));
        assert_eq!(errors(&program), ["moving-frame"], "{end:?}");
        assert_eq!(errors(&read(&text.replace('\n', end))), [""; 0], "{end:?}");
    }
}

#[test]
fn jobs_that_a_call_gives_another_user_frame_are_refused() {
    let positions = format!(
        "{USER}{}///TOOL 3\n///POSTYPE ANGLE\n///ANGLE\nC00001={P6}",
        points(1)
    );
    let sub = |line: &str| job(&positions, line).replace("NAME A", "NAME SUB");
    let sub = sub("MOVJ C00001\nMOVL C00000").replace("SC,RW\n", "SC,RW,RJ\n");
    let pose = format!("{USER}{}", points(1));
    for (call, is_refused) in [
        ("CALL JOB:SUB UF#(4)", true),
        ("CALL JOB:SUB ARGF1 UF#(B000) IF IN#(1)=ON", true),
        ("JUMP JOB:SUB UF#(4)", true),
        ("CALL IG#(1) UF#(4)", true),
        ("CALL JOB:SUB UF#(12)", false),
        ("CALL JOB:OTHER UF#(4)", false),
        ("CALL JOB:SUB", false),
    ] {
        let main = job(&pose, &format!("MOVL C00000\n{call}"));
        let program = read_files(&[&main, &sub], &Settings::default()).expect("two jobs");
        let refused = program
            .findings
            .iter()
            .find(|f| f.id == "frame-assigned-at-run-time");
        assert_eq!(
            refused.is_some(),
            is_refused,
            "{call}: {:?}",
            program.findings
        );
        if let Some(refused) = refused {
            let says = "0.JBI line 17 calls the job with ";
            assert!(refused.message.contains(says), "{}", refused.message);
        }
        let blocked: Vec<bool> = program.targets.iter().map(|t| t.blocked).collect();
        assert_eq!(blocked, [false, is_refused, false], "{call}");
    }
}

#[test]
fn rconf_tells_the_wrist_where_a_job_begins_with_a_pose() {
    let begins = |fields: usize| {
        let rconf = format!("///RCONF 1{}\n", ",0".repeat(fields - 1));
        let positions = format!(
            "///TOOL 0\n///POSTYPE BASE\n///RECTAN\n{rconf}{}",
            points(1)
        );
        let program = read(&job(&positions, "MOVL C00000 V=5"));
        let numbers: Vec<f64> = program.numbers.iter().map(|n| n.value).collect();
        let layout = program.targets[0].layout;
        let decoded = Inform.decode(layout, &numbers, &Settings::default());
        let reported = program.findings.iter().all(|f| f.id != "wrist-not-told");
        let stated = decoded.configuration;
        (reported, stated.joint_5_negative, stated.beyond[3])
    };
    assert_eq!(begins(24), (true, Some(true), None));
    assert_eq!(begins(8), (true, None, Some(std::f64::consts::FRAC_PI_2)));
}

#[test]
fn a_shift_is_followed_through_branches_loops_and_calls() {
    let body = |instructions: &str| {
        let program = read(&job(&format!("{USER}{}", points(3)), instructions));
        let target = |m: &crate::program::Move| program.target_of(m).expect("a target").blocked;
        program.moves.iter().map(target).collect::<Vec<_>>()
    };
    let (go, on) = ("MOVL C00000", "MOVL C00001");
    assert_eq!(
        body(&format!("{go}\nSFTON P000\n{on}\nSFTOF\nMOVL C00002")),
        [false, true, false]
    );
    assert_eq!(
        body(&format!(
            "IFTHEN IN#(1)=ON\nSFTON P000\nENDIF\n{on}\nSFTOF\n{go}"
        )),
        [true, false]
    );
    assert_eq!(
        body(&format!("SFTON P000\nIFTHEN IN#(1)=ON\nSFTOF\nENDIF\n{go}")),
        [true]
    );
    assert_eq!(
        body(&format!(
            "SFTON P000\nIFTHEN IN#(1)=ON\nSFTOF\nELSEIF IN#(2)=ON\nSFTOF\nELSE\nSFTOF\nENDIF\n{go}"
        )),
        [false]
    );
    assert_eq!(
        body(&format!(
            "SWITCH B000 CASE 1\nSFTON P000\n{on}\nCASE 2\n{go}\nENDSWITCH\nSFTOF\nMOVL C00002"
        )),
        [true, false, false]
    );
    assert_eq!(
        body(&format!("*L\n{go}\nSFTON P000\nJUMP *L IF IN#(1)=ON")),
        [true]
    );
    assert_eq!(
        body(&format!(
            "*L\n{go}\nJUMP *L IF IN#(1)=ON\nSFTON P000\nSFTOF"
        )),
        [false]
    );
    assert_eq!(
        body(&format!(
            "FOR I000= 0 TO 3\n{on}\nSFTON P000\nNEXT I000\nSFTOF\n{go}"
        )),
        [true, false]
    );
    assert_eq!(body(&format!("SFTOF3D\n{go}")), [false]);
    assert_eq!(body(&format!("SFTON3D P000\n{go}")), [true]);
    assert_eq!(
        body(&format!("SFTON P000\nSFTOF IF IN#(1)=ON\n{go}")),
        [true]
    );

    let positions = format!("{USER}{}", points(1));
    let named = |name: &str, text: &str| {
        job(&positions, text).replace("//NAME A", &format!("//NAME {name}"))
    };
    let main = named(
        "MAIN",
        "CALL JOB:ON\nMOVL C00000\nCALL JOB:OFF\nSFTOF\nCALL JOB:PART-2 IF IN#(1)=ON",
    );
    let on = named("ON", "SFTON P010 RF");
    let off = named("OFF", "MOVL C00000\nSFTOF");
    let part = named("PART-2", "MOVL C00000");
    let program = read_files(&[&main, &on, &off, &part], &Settings::default()).expect("jobs");
    let shifted: Vec<_> = program
        .moves
        .iter()
        .map(|m| program.target_of(m).expect("a target").blocked)
        .collect();
    assert_eq!(shifted, [true, true, false]);
}

#[test]
fn moves_that_the_arc_corrects_are_reported_once_a_place() {
    let positions = format!("{USER}{}", points(3));
    let read_body = |instructions: &str| read(&job(&positions, instructions));
    let program = read_body(
        "MOVL C00000\nCOMARCON #(1) U/D=25.00 L/R=0.0\nMOVL C00001 V=5\nMOVL C00002 V=5\nCOMARCOF\n\
         MOVL C00000",
    );
    assert_eq!(ids(&program), ["corrected-by-sensor"]);
    let (found, severity) = (&program.findings[0], crate::finding::Severity::Warning);
    assert_eq!((found.line, found.severity), (19, severity));
    assert!(program.targets.iter().all(|target| !target.blocked));
    // it lasts through calls, and the end of it does
    let ended = read_body("COMARCON #(1)\nCOMARCOF\nMOVL C00000\nMOVL C00001\nMOVL C00002");
    assert_eq!(ids(&ended), [""; 0]);
    let (main, weld) = (
        job("", "COMARCON #(1)\nCALL JOB:B\nCOMARCOF"),
        job(&positions, "MOVL C00000\nMOVL C00001\nMOVL C00002").replace("//NAME A", "//NAME B"),
    );
    let program = read_files(&[&main, &weld], &Settings::default()).expect("jobs");
    assert_eq!(ids(&program), ["corrected-by-sensor"]);
}

#[test]
fn variables_belong_to_all_jobs() {
    let holder = job(&format!("{USER}P00018={P6}\nP00019={P6}"), "MOVL P019");
    let user = job("", "MOVJ P018 VJ=5").replace("//NAME A", "//NAME B");
    let program = read_files(&[&holder, &user], &Settings::default()).expect("jobs");
    assert_eq!(program.targets.len(), 2);
    assert_eq!(
        (program.moves[1].file, program.moves[1].target.unwrap()),
        (1, 0)
    );
    assert_eq!(ids(&program), ["position-variable"]);
    // the same variable with another value
    let other =
        job(&format!("{USER}P00018=5,5,5,0,0,0"), "MOVL P018").replace("//NAME A", "//NAME C");
    let program = read_files(&[&holder, &user, &other], &Settings::default()).expect("jobs");
    let ambiguous = program
        .findings
        .iter()
        .filter(|f| f.id == "target-name-ambiguous");
    assert_eq!(ambiguous.count(), 2);
    // the same value in a job that does not go there: whichever is loaded last counts, so both are
    // targets
    let copy = job(&format!("{USER}P00018={P6}"), "").replace("//NAME A", "//NAME C");
    let program = read_files(&[&holder, &user, &copy], &Settings::default()).expect("jobs");
    let files: Vec<_> = program.targets.iter().map(|t| t.file).collect();
    assert_eq!(files, [0, 0, 2]);
    let mut gone: Vec<_> = program.moves.iter().map(|m| m.target.unwrap()).collect();
    gone.sort_unstable();
    assert_eq!(gone, [0, 1, 2]);
    // assigned in one job, used in the other
    let writer = job("", "SET P018 P019").replace("//NAME A", "//NAME D");
    let program = read_files(&[&holder, &user, &writer], &Settings::default()).expect("jobs");
    assert_eq!(ids(&program), ["position-variable", "write-not-called"]);
}
