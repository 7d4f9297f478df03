//! Calls and interrupts that may leave the robot elsewhere than the text says: the side from which
//! joints with backlash come behind them, and the posture.

use super::given::{CONFIG, DATA, START};
use super::{P, PLAIN, done, given, profile, profile_of, registers};
use poseshift::compensate::compensate;
use poseshift::program::{Source, language_of};

#[test]
fn a_routine_that_may_lead_the_robot_elsewhere_makes_directions_uncertain() {
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    let body = "LIN {X 340.0,Y 10.0,Z 420.0,A 160,B 20,C 180}\nhome()\nLIN XP1\nLIN {X 340.0,Y \
        10.0,Z 300.0,A 160,B 20,C 180}\n";
    let text = format!("DEF t()\n{START}{body}END\n");
    let files = [
        ("$config.dat", CONFIG),
        ("t.dat", DATA),
        ("t.src", text.as_str()),
    ];
    let line = text
        .lines()
        .position(|line| line == "home()")
        .expect("the call")
        + 1;
    let reported = |effects: &[&str], files: &[(&str, &str)]| {
        let done = done(effects, files);
        let found = done
            .findings
            .iter()
            .filter(|f| f.id == "direction-uncertain");
        found
            .map(|f| (f.line, f.message.clone()))
            .collect::<Vec<_>>()
    };
    let found = reported(&[backlash], &files);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, line);
    assert!(
        found[0].1.contains("`home`") && found[0].1.contains("joint 2"),
        "{found:?}"
    );
    // a width of 0.1 deg at joint 2, half a metre from the tool: some 0.9 mm between the two sides
    let off: f64 = found[0]
        .1
        .split(" mm off")
        .next()
        .and_then(|text| text.rsplit(' ').next())
        .and_then(|text| text.parse().ok())
        .expect("a number");
    assert!((0.5..1.2).contains(&off), "{off}");
    // without backlash, or with the routine in the files, nothing is uncertain
    assert_eq!(reported(&[PLAIN], &files), []);
    let whole = format!("{text}DEF home()\nEND\n");
    assert_eq!(
        reported(&[backlash], &[files[0], files[1], ("t.src", &whole)]),
        []
    );
}

#[test]
fn a_search_that_stops_leaves_the_robot_on_its_way() {
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    for (switch, call, expected) in [
        ("\\Stop,", "", 1),
        ("\\SStop,", "", 1),
        ("", "", 0),
        ("", "rHome;\n", 1),
        ("", "TPWrite \"x\";\nSet do1;\nReset do1;\n", 0),
    ] {
        let data = format!(
            "CONST robtarget a := [[330,10,420],{P};\nCONST robtarget b := [[330,10,380],{P};\nCONST \
             robtarget c := [[330,10,330],{P};\nVAR robtarget f;"
        );
        let body = format!(
            "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveL \
             a,v100,fine,tool0;\nSearchL{} di1,f,b,v100,tool0;\n{call}MoveL c,v100,fine,tool0;",
            switch.trim_end_matches(',')
        );
        let body = body.replace("Stop di1", "Stop,di1");
        let done = done(&[backlash], &[("t.mod", &super::rapid(&data, &body))]);
        let found = done
            .findings
            .iter()
            .filter(|f| f.id == "direction-uncertain");
        assert_eq!(
            found.count(),
            expected,
            "{switch} {call} {:?}",
            done.findings
        );
    }
}

#[test]
fn resume_leaves_the_robot_anywhere_in_the_routine_that_is_interrupted() {
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    let away = "LIN {X 340.0,Y 10.0,Z 420.0,A 160,B 20,C 180}\n";
    let declared = "INTERRUPT DECL 4 WHEN $IN[1]==TRUE DO hit()\nINTERRUPT ON 4\n";
    for (declared, ending, expected) in [
        (declared, "RESUME\n", 1),
        (declared, "", 0),
        ("", "RESUME\n", 0),
    ] {
        let text = format!(
            "DEF t()\n{START}{declared}{away}seek()\nLIN XP1\nEND\nDEF seek()\nLIN {{X 340.0,Y \
             10.0,Z 440.0,A 160,B 20,C 180}}\nEND\nDEF hit()\nBRAKE\n{ending}END\n"
        );
        let done = done(
            &[backlash],
            &[("$config.dat", CONFIG), ("t.dat", DATA), ("t.src", &text)],
        );
        let led = |f: &&poseshift::finding::Finding| {
            f.id == "direction-uncertain" && f.message.contains("`RESUME`")
        };
        assert_eq!(
            done.findings.iter().filter(led).count(),
            expected,
            "{text}{:?}",
            done.findings
        );
    }
}

#[test]
fn an_interrupt_that_moves_the_robot_makes_directions_uncertain() {
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    let trap = |inside: &str| {
        let data = format!(
            "VAR intnum i1;\nCONST robtarget a := [[330,10,420],{P};\nCONST robtarget b := \
             [[330,10,380],{P};\nCONST robtarget c := [[330,10,330],{P};\nTRAP tr\n{inside}\nENDTRAP"
        );
        let body = "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nCONNECT i1 \
            WITH tr;\nISignalDI di1,1,i1;\nMoveL a,v100,fine,tool0;\nMoveL b,v100,fine,tool0;";
        super::rapid(&data, body)
    };
    let said = |effects: &[&str], inside: &str| {
        let done = done(effects, &[("t.mod", &trap(inside))]);
        let found = done.findings.into_iter();
        let found = found.filter(|f| f.id == "direction-uncertain" && f.message.contains("`tr`"));
        found.map(|f| (f.line, f.message)).collect::<Vec<_>>()
    };
    let moves = "StopMove;\nStorePath;\nMoveL c,v100,fine,tool0;\nRestoPath;\nStartMove;";
    let found = said(&[backlash], moves);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].0, 6, "where the trap stands");
    let message = &found[0].1;
    assert!(
        message.contains("joint 2") && message.contains("and at another move"),
        "{message}"
    );
    assert_eq!(said(&[backlash], "TPWrite \"x\";"), []);
    assert_eq!(said(&[PLAIN], moves), []);
}

#[test]
fn what_fanuc_monitors_or_resumes_with_may_move_the_robot() {
    let point = |number: u32, z: f64| registers::point(number, [450.0, 60.0, z, 180.0, 0.0, 20.0]);
    let points = point(1, 250.0) + &point(2, 230.0) + &point(3, 180.0);
    let main = |lines: &str| {
        let lines = format!(
            "UFRAME_NUM=0\nUTOOL_NUM=1\nJ P[1] 10% FINE\n{lines}\nL P[2] 9mm/sec FINE\nL P[3] \
             9mm/sec FINE"
        );
        registers::listing("T", &lines, &points)
    };
    let condition = "/PROG CH1\n/MN\n : WHEN DI[1]=ON,CALL UP ;\n/POS\n/END\n";
    let up = |lines: &str| registers::listing("UP", lines, &point(1, 300.0));
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    let said = |lines: &str, up: Option<&str>| {
        let mut files = vec![("t.ls", main(lines)), ("c.ls", condition.to_owned())];
        files.extend(up.map(|up| ("u.ls", up.to_owned())));
        let sources = files.into_iter();
        let sources = sources.map(|(name, text)| Source::new(name, text.into_bytes()));
        let sources: Vec<Source> = sources.collect();
        let language = language_of(&sources[0]).expect("FANUC");
        let robot = profile_of("robots/fanuc_lrmate200ic.yaml", &[backlash]);
        let done = compensate(language, &sources, &robot, &given()).expect("read");
        let found = done.findings.into_iter();
        // where the program starts no side is known either
        let found =
            found.filter(|f| f.id == "direction-uncertain" && f.message.contains("any two moves"));
        found.map(|f| (f.line, f.message)).collect::<Vec<_>>()
    };
    let moves = up("UFRAME_NUM=0\nUTOOL_NUM=1\nL P[1] 9mm/sec FINE");
    for lines in [
        "MONITOR CH1",
        "RESUME_PROG[1]=UP",
        "RESUME_PROG=UP",
        "ERROR_PROG=UP",
    ] {
        let found = said(lines, Some(&moves));
        assert!(!found.is_empty(), "{lines}");
        assert!(found.iter().all(|(_, said)| said.contains("joint 2")));
        // what it runs moves nothing, or ends
        assert_eq!(said(lines, Some(&up("DO[1]=ON"))), [], "{lines}");
    }
    assert_eq!(said("MONITOR END CH1", Some(&moves)), []);
    let unknown = said("MONITOR CH1", None);
    assert!(
        matches!(&unknown[..], [(_, said), ..] if said.contains("`UP`")),
        "{unknown:?}"
    );
}

/// Another error on each side of the wrist.
const WRIST: &str = "{effect: link_geometry, link: 5, theta_deg: 0.1}";

/// An AS program, and what is said of postures that are not certain: line and message.
fn postures(lines: &str, more: &str) -> Vec<(usize, String)> {
    let text = format!(
        ".PROGRAM main()\nTOOL NULL\nBASE NULL\nJMOVE #h\n{lines}\n.END\n{more}.TRANS\np 430 0 400 90 150 \
         0\nq 400 50 380 90 150 0\n.END\n.JOINTS\n#h 0 0 0 0 60 0\n#k 0 0 0 90 -60 0\n.END\n"
    );
    let done = done(&[WRIST], &[("t.as", &text)]);
    let found = done.findings.iter().filter(|f| f.id == "posture-assumed");
    found.map(|f| (f.line, f.message.clone())).collect()
}

#[test]
fn a_routine_that_is_not_in_the_files_may_leave_the_robot_in_another_posture() {
    let found = postures("LMOVE p\nCALL ext\nLMOVE q\nCALL ext\nLMOVE p", "");
    let [(line, said)] = &found[..] else {
        panic!("{found:?}")
    };
    assert_eq!(*line, 6);
    assert!(
        said.contains("`ext`")
            && said.contains("another posture")
            && said.ends_with("at another move"),
        "{said}"
    );
    // joints behind the call, or the routine itself, say where the robot is
    let none: [(usize, String); 0] = [];
    assert_eq!(postures("LMOVE p\nCALL ext\nJMOVE #h\nLMOVE q", ""), none);
    let own = ".PROGRAM ext()\nSIGNAL 1\n.END\n";
    assert_eq!(postures("LMOVE p\nCALL ext\nLMOVE q", own), none);
}

#[test]
fn an_interrupt_may_leave_the_robot_in_another_posture() {
    let lines = "LMOVE p\nONI 1001 CALL er\nLMOVE q\nIGNORE 1001";
    let handler = |to: &str| format!(".PROGRAM er()\nJMOVE #h\n{to}\n.END\n");
    let found = postures(lines, &handler("JMOVE #k"));
    assert!(
        matches!(&found[..], [(_, said)] if said.contains("`er`") && said.contains("another posture")),
        "{found:?}"
    );
    assert_eq!(postures(lines, &handler("JMOVE #h")), []);
}

#[test]
fn an_interrupt_whose_routine_is_not_in_the_files_may_leave_the_robot_in_another_posture() {
    let lines = "LMOVE p\nONI 1001 CALL er\nLMOVE q\nIGNORE 1001";
    let found = postures(lines, "");
    let [(line, said)] = &found[..] else {
        panic!("{found:?}")
    };
    assert_eq!(*line, 6, "where the interrupt is set");
    assert!(
        said.contains("`er`, which is not in the files")
            || said.contains("`er` is not in the files"),
        "{said}"
    );
    // likewise where it calls one that is not
    let calls = ".PROGRAM er()\nCALL ext\n.END\n";
    let found = postures(lines, calls);
    assert!(
        matches!(&found[..], [(_, said)] if said.contains("`er` calls `ext`, which is not in the files")),
        "{found:?}"
    );
    // a process may not move the robot
    for more in ["", calls] {
        assert_eq!(postures("LMOVE p\nPCEXECUTE er\nLMOVE q", more), []);
    }
    // which program a text names nobody knows
    let any = ".PROGRAM er()\nSCALL $name\n.END\n";
    assert_eq!(postures(lines, any).len(), 1);
    assert_eq!(postures(lines, ".PROGRAM er()\nSIGNAL 1\n.END\n"), []);
}

#[test]
fn what_a_routine_of_context_may_do_is_said_of_the_program() {
    let main = "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nPTP {A1 0,A2 0,A3 0,A4 0,A5 60,A6 0}\n\
        INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO er()\nINTERRUPT ON 5\n\
        LIN {X 430,Y 0,Z 400,A 90,B 150,C 0}\nEND\n";
    let found = |er: &str, is_context: bool| {
        let bytes = |text: &str| text.as_bytes().to_vec();
        let er = format!("DEF er()\n{er}\nEND\n");
        let er = if is_context {
            Source::context("er.src", bytes(&er))
        } else {
            Source::new("er.src", bytes(&er))
        };
        let sources = [Source::new("t.src", bytes(main)), er];
        let language = language_of(&sources[0]).expect("KRL");
        let done = compensate(language, &sources, &profile(&[WRIST]), &given()).expect("read");
        let found = done
            .findings
            .into_iter()
            .filter(|f| f.id == "posture-assumed");
        found
            .map(|f| (f.file, f.line, f.message))
            .collect::<Vec<_>>()
    };
    for (does, says) in [
        ("outer()", "`er` calls `outer`"),
        ("PTP {A4 90,A5 -60}", "`er` moves the robot"),
    ] {
        let alone = found(does, true);
        assert!(
            matches!(&alone[..], [(file, 7, said)] if file == "t.src" && said.contains(says)),
            "{alone:?}"
        );
        let together = found(does, false);
        assert!(
            matches!(&together[..], [(file, 1, said)] if file == "er.src" && said.contains("line 7 of t.src")),
            "{together:?}"
        );
    }
    assert_eq!(found("$OUT[1]=TRUE", true), []);
}

/// What is said of postures that are not certain in a KRL program: line and message.
fn krl_postures(head: &str, more: &str) -> Vec<(usize, String)> {
    let text = format!(
        "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\n{head}\nPTP {{A1 0,A2 0,A3 0,A4 0,A5 60,A6 0}}\n\
         LIN {{X 430,Y 0,Z 400,A 90,B 150,C 0}}\nLIN {{X 400,Y 50,Z 380,A 90,B 150,C 0}}\nEND\n{more}"
    );
    let done = done(&[WRIST], &[("t.src", &text)]);
    let found = done.findings.iter().filter(|f| f.id == "posture-assumed");
    found.map(|f| (f.line, f.message.clone())).collect()
}

#[test]
fn of_interrupts_and_triggers_of_krl_the_first_alone_may_move_the_robot() {
    let declared = "INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO outer()\n";
    let found = krl_postures(&format!("{declared}INTERRUPT ON 5"), "");
    assert!(
        matches!(&found[..], [(5, said)] if said.contains("`outer` is not in the files")),
        "{found:?}"
    );
    let with_arguments = "INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO outer(3)\nINTERRUPT ON 5";
    let found = krl_postures(with_arguments, "");
    assert!(
        matches!(&found[..], [(5, said)] if said.contains("`outer` is not in the files")),
        "{found:?}"
    );
    let none: [(usize, String); 0] = [];
    assert_eq!(krl_postures(declared, ""), none, "never switched on");
    let stop = "INTERRUPT DECL 3 WHEN $STOPMESS==TRUE DO IR_STOPM()\nINTERRUPT ON 3";
    assert_eq!(krl_postures(stop, ""), none);
    for trigger in ["outer()", "outer(3)", "own()", "given(2)"] {
        let head = format!("TRIGGER WHEN DISTANCE=0 DELAY=0 DO {trigger}");
        let own = "DEF own()\ndeeper()\nEND\nDEF deeper()\nouter()\nEND\nDEF given(n:IN)\nINT n\nouter()\nEND\n";
        assert_eq!(krl_postures(&head, own), none, "{trigger}");
    }
    // of a number that nothing in the files declares nobody knows what runs
    let found = krl_postures("INTERRUPT ON 7", "");
    assert!(
        matches!(&found[..], [(4, said)] if said.contains("`INTERRUPT 7` is not in the files")),
        "{found:?}"
    );
    // once, however often it is switched on
    let often = format!("{declared}INTERRUPT ON 05\nINTERRUPT OFF 5\nINTERRUPT ON 5");
    assert_eq!(krl_postures(&often, "").len(), 1);
    let assigned = "INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO $OUT[1]=TRUE\nINTERRUPT ON 5";
    assert_eq!(krl_postures(assigned, ""), none);
    let own = "INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO own()\nINTERRUPT ON 5";
    let found = krl_postures(own, "DEF own()\nouter()\nEND\n");
    assert!(
        matches!(&found[..], [(_, said)] if said.contains("`own` calls `outer`")),
        "{found:?}"
    );
}

#[test]
fn where_force_has_moved_the_robot_is_not_known() {
    let moves = "movej([0,0,0,0,1.2,0])\nforce_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,9,0,0,0],2,\
        [1,1,1,1,1,1])\nsleep(1)\nend_force_mode()\nmovel(p[0.33,0.01,0.42,0,3.14159,0])\n";
    let text = format!("def t():\nset_tcp(p[0,0,0,0,0,0])\n{moves}end\nt()\n");
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    let done = done(&[backlash], &[("t.script", &text)]);
    let found = done
        .findings
        .iter()
        .filter(|f| f.id == "direction-uncertain");
    assert_eq!(found.count(), 1, "{:?}", done.findings);
}

#[test]
fn a_frame_of_another_file_is_named_with_it() {
    let main = ".PROGRAM main()\nTOOL NULL\nBASE NULL\nJMOVE #h\nIF SIG(1) THEN\nCALL other\nEND\n\
                LMOVE p\n.END\n.TRANS\np 430 0 400 90 150 0\n.END\n.JOINTS\n#h 0 0 0 0 60 0\n.END\n";
    let other = ".PROGRAM other()\nSIGNAL 1\nBASE TRANS(10,30,20,15,0,0)\n.END\n";
    let done = done(&[WRIST], &[("t.as", main), ("o.as", other)]);
    let mut shared = done.findings.iter().filter(|f| f.id == "target-shared");
    let message = &shared.next().expect("two bases").message;
    assert!(message.contains("the work frame of line 3: "), "{message}");
    assert!(message.contains("line 3 of o.as: "), "{message}");
}
