//! Moves through calls, branches and what runs concurrently with the program.

use super::*;
use crate::program::Before;

/// For each move where it goes, and the moves that come before it, by index; `None` is the start or
/// anywhere.
fn chain(program: &Program) -> Vec<(&str, Vec<Option<u32>>)> {
    let before = |motion| {
        let before = program.before(motion).iter();
        before
            .map(|before| match before {
                Before::One(at) => Some(*at),
                _ => None,
            })
            .collect()
    };
    let befores = program.moves.iter().map(before);
    to(program).into_iter().zip(befores).collect()
}

const MOVE: &str = "DEF rm(p:IN, q:OUT)\nDECL E6POS p,q\nLIN p\nLIN q\nEND\n";

#[test]
fn positions_are_handed_to_routines_of_the_files() {
    let text = format!(
        "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,2)\nrm(XP1,XP2)\nBAS(#BASE,3)\nrm({{X 1,Y 2,Z 3,A 0,B \
         0,C 0}},XP3)\nEND\n{MOVE}"
    );
    let program = read_files(&[("m.src", &text), ("m.dat", DATA)]);
    let mut found: Vec<_> = program
        .moves
        .iter()
        .map(|m| {
            let name = program.targets[m.target.unwrap()].name.as_deref();
            (name.unwrap_or("-"), program.frames[m.frame].name.as_str())
        })
        .collect();
    found.sort_unstable();
    let expected = [
        ("-", "BASE_DATA[3]"),
        ("XP1", "BASE_DATA[2]"),
        ("XP2", "BASE_DATA[2]"),
        ("XP3", "BASE_DATA[3]"),
    ];
    assert_eq!(found, expected);
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn elements_are_handed_to_routines_of_the_files() {
    let data = "DEFDAT M\nDECL E6POS w[2]\nw[1]={X 1,Y 0,Z 0,A 0,B 0,C 0}\nw[2]={X 2,Y 0,Z 0,A 0,B \
        0,C 0}\nENDDAT\n";
    let text = "DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nto(w[1])\nFOR i=1 TO 2\nLIN \
        w[i]\nENDFOR\nEND\n\
        DEF to(p:IN)\nE6POS p\nPTP p\nEND\n";
    let program = read_files(&[("m.src", text), ("m.dat", data)]);
    assert_eq!(to(&program), ["w[1]", "w[2]", "w[1]"]);
    assert_eq!(ids(&program), [""; 0]);
}

#[test]
fn an_array_of_which_only_chosen_elements_are_written_holds_what_is_written() {
    for text in [
        "w[k]=XP2\nPTP w[k]",
        "FOR k=1 TO 2\nw[k]=XP2\nENDFOR\nPTP w[1]",
        "w[k]=XP1\nw[k]=XP2\nPTP w[n]",
    ] {
        let text = format!(
            "DEF M()\nDECL INT k,n\nDECL E6POS w[2]\n$TOOL=$NULLFRAME\n$BASE=$WORLD\n{text}\nEND\n"
        );
        let program = read_files(&[("m.src", &text), ("m.dat", DATA)]);
        assert!(to(&program).contains(&"XP2"), "{text}: {:?}", to(&program));
        assert_eq!(reported(&program), ["computed-target"], "{text}");
    }
}

#[test]
fn what_a_routine_writes_through_a_parameter_comes_back() {
    let text = "DEF M()\nDECL E6POS near\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nabove(near,XP1)\nLIN \
        near\nLIN XP1\nEND\n\
        DEF above(out:OUT,p:IN)\nDECL E6POS out,p\nout=p:{X 0,Y 0,Z -50,A 0,B 0,C 0}\nEND\n";
    let program = read_files(&[("m.src", text), ("m.dat", DATA)]);
    assert_eq!(to(&program), ["XP1", "XP1"]);
    assert!(matches!(program.moves[0].displacement, Displacement::By(_)));
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn routines_begin_where_the_caller_is_and_the_caller_goes_on_where_they_end() {
    let text = "DEF M()\nPTP XP1\nsub()\nLIN XP1\nEND\nDEF sub()\nLIN XP2\nIF $IN[1] THEN\nLIN \
        XP3\nENDIF\nEND\n";
    let program = read_files(&[("m.src", text), ("m.dat", DATA)]);
    let expected = [
        ("XP1", vec![None]),
        ("XP1", vec![Some(2), Some(3)]),
        ("XP2", vec![Some(0)]),
        ("XP3", vec![Some(2)]),
    ];
    assert_eq!(chain(&program), expected);
}

#[test]
fn moves_to_positions_nobody_knows_are_moves() {
    for (text, id, severity) in [
        ("PTP XHOME2", "joint-target-not-in-files", Severity::Note),
        ("PTP_REL {A6 -0.001}", "relative-joint-move", Severity::Note),
        ("PTP $POS_RET", "run-time-position", Severity::Note),
        ("PTP $NULLFRAME", "computed-target", Severity::Warning),
        (
            "DECL FRAME tg\ntg.X=n\nLIN tg",
            "computed-target",
            Severity::Warning,
        ),
        ("LIN nowhere", "target-not-in-files", Severity::Error),
        ("LIN_REL off", "relative-move", Severity::Error),
    ] {
        let program = path(&format!("PTP XP1\n{text}\nLIN XP2"));
        let expected = [
            ("XP1", vec![None]),
            ("?", vec![Some(0)]),
            ("XP2", vec![Some(1)]),
        ];
        assert_eq!(chain(&program), expected, "{text}");
        let found: Vec<_> = program.findings.iter().filter(|f| f.id == id).collect();
        assert_eq!(found.len(), 1, "{text}: {:?}", program.findings);
        assert_eq!(found[0].severity, severity, "{text}");
    }
    // to where it is the robot does not go
    for (here, ids) in [
        ("$AXIS_ACT", vec![]),
        ("$POS_ACT", vec!["run-time-position"]),
    ] {
        let program = path(&format!("PTP XP1\nPTP {here}\nLIN XP2"));
        assert_eq!(chain(&program)[1], ("XP2", vec![Some(0)]));
        assert_eq!(reported(&program), ids);
    }
}

#[test]
fn where_the_robot_was_is_a_pose_of_its_tool_and_base() {
    for (text, id) in [
        (
            "E6POS here\nhere=$POS_ACT\nBAS(#BASE,0)\nLIN here",
            "computed-target",
        ),
        (
            "E6AXIS here\nhere=$AXIS_ACT\nBAS(#BASE,0)\nPTP here",
            "run-time-position",
        ),
    ] {
        assert_eq!(reported(&path(&format!("DECL {text}"))), [id], "{text}");
    }
}

#[test]
fn run_time_positions_are_kept_in_variables() {
    let program =
        path("DECL E6POS here\nhere=$POS_ACT\nLIN XP1\nLIN here\nhere.Z=here.Z+10\nLIN here");
    assert_eq!(to(&program), ["XP1", "?", "?"]);
    let mut ids = reported(&program);
    ids.sort_unstable();
    assert_eq!(ids, ["run-time-position", "run-time-position"]);
    assert!(
        program
            .findings
            .iter()
            .all(|f| f.severity < Severity::Error)
    );
}

#[test]
fn external_axes_in_use_are_refused_by_name() {
    let at = |e: &str| format!("LIN {{X 1,Y 2,Z 3,A 0,B 0,C 0,{e}}}");
    for unused in ["E1 0.0,E2 0", "E1 9E+09,E2 9.0E9"] {
        assert_eq!(reported(&path(&at(unused))), [""; 0], "{unused}");
    }
    for (used, shown) in [
        ("E1 1800.0", "E1 is 1800"),
        ("E1 0,E3 -1500", "E3 is -1500"),
        ("E2 q", "E2 is an expression"),
    ] {
        let program = path(&at(used));
        assert_eq!(reported(&program), ["external-axis-unknown"], "{used}");
        assert_eq!(blocked(&program), ["-"], "{used}");
        assert!(program.findings[0].message.contains(shown), "{used}");
    }
    // in data, and only where a move goes there
    let data = DATA.replace("T 35,E1 0.0,", "T 35,E1 12.5,");
    for (text, count) in [("LIN XP1\nLIN XP1", 1), ("LIN XP2", 0)] {
        let text = format!("DEF M()\n{text}\nEND\n");
        let program = read_files(&[("m.src", &text), ("m.dat", &data)]);
        let found = program
            .findings
            .iter()
            .filter(|f| f.id == "external-axis-unknown");
        assert_eq!(found.count(), count, "{text}");
    }
}

#[test]
fn arcs_that_go_on_to_an_angle_are_refused() {
    let program =
        path("LIN XP1\nCIRC XP2,XP3,CA 180\nSCIRC XP2,{X 1,Y 2,Z 3,A 0,B 0,C 0}, CA 30.5 C_SPL");
    assert_eq!(reported(&program), ["circular-angle"; 3]);
    assert_eq!(blocked(&program), ["-", "XP2", "XP3"]);
    let program = path("LIN XP1\nCIRC XP2,XP3 C_DIS ; CA 180");
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn routines_of_interrupts_run_at_any_time() {
    for decl in [
        "GLOBAL INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO stop()",
        "INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO stop()",
        "TRIGGER WHEN DISTANCE=1 DELAY=0 DO stop() PRIO=-1",
    ] {
        let text = format!(
            "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,1)\n{decl}\nINTERRUPT ON\nLIN XP1\nLIN XP2\nEND\nDEF \
             stop()\nBRAKE\n$BASE=$WORLD\nLIN XP3\nEND\n"
        );
        let program = read_files(&[("m.src", &text), ("m.dat", DATA)]);
        assert_eq!(to(&program), ["XP1", "XP1", "XP2", "XP2", "XP3"], "{decl}");
        let found = program
            .moves
            .iter()
            .map(|m| program.frames[m.frame].name.as_str());
        let mut found: Vec<_> = found.collect();
        found.dedup();
        assert_eq!(found.last(), Some(&"$WORLD"), "{decl}");
        assert!(found.contains(&"BASE_DATA[1]"), "{decl}");
        assert_eq!(chain(&program)[4].1, [None], "{decl}");
    }
}

#[test]
fn routines_of_interrupts_move_with_what_the_program_has_set() {
    let program = read_files(&[
        (
            "m.src",
            "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,1)\nINTERRUPT DECL 5 WHEN $IN[1]==TRUE DO stop()\n\
             INTERRUPT ON 5\nLIN XP1\nBAS(#BASE,0)\nLIN XP2\nEND\nDEF stop()\nBRAKE\nLIN XP3\nEND\n",
        ),
        ("m.dat", DATA),
    ]);
    let moves = program.moves.iter().zip(to(&program));
    let of_routine = moves.filter(|(_, target)| *target == "XP3");
    let mut bases: Vec<_> = of_routine
        .map(|(m, _)| program.frames[m.frame].name.as_str())
        .collect();
    bases.sort_unstable();
    bases.dedup();
    assert_eq!(bases.len(), 2, "{bases:?}");
    assert!(bases.contains(&"BASE_DATA[1]"), "{bases:?}");
}

#[test]
fn what_was_set_before_an_interrupt_is_on_does_not_reach_it() {
    let bases = |around: [&str; 2], start: &str| {
        let text = format!(
            "DEF M()\nINTERRUPT DECL 5 WHEN $IN[1]==TRUE DO stop()\n{}BAS(#INITMOV,0)\nBAS(#TOOL,1)\nBAS(#BASE,0)\n\
             BAS(#BASE,1)\n{start}\nLIN XP1\n{}END\nDEF stop()\nBRAKE\nLIN XP3\nEND\n",
            around[0], around[1]
        );
        let program = read_files(&[("m.src", &text), ("m.dat", DATA)]);
        let moves = program.moves.iter().zip(to(&program));
        let of_routine = moves.filter(|(_, target)| *target == "XP3");
        let mut bases: Vec<String> = of_routine
            .map(|(m, _)| program.frames[m.frame].name.clone())
            .collect();
        bases.sort_unstable();
        bases.dedup();
        bases
    };
    for start in [
        "INTERRUPT ON 5",
        "TRIGGER WHEN DISTANCE=0 DELAY=0 DO stop() PRIO=-1",
    ] {
        assert_eq!(bases(["", ""], start), ["BASE_DATA[1]"], "{start}");
        // in a loop it is on when it begins again
        let all = bases(["LOOP\n", "ENDLOOP\n"], start);
        assert!(
            all.len() > 1 && all.contains(&"BASE_DATA[1]".into()),
            "{start}: {all:?}"
        );
    }
}

#[test]
fn what_another_program_sets_does_not_reach_an_interrupt() {
    let other = "DEF OTHER()\nBAS(#TOOL,2)\nBAS(#BASE,0)\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n";
    for decl in [
        "INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO stop()",
        "INTERRUPT DECL 5 WHEN $IN[1]==TRUE DO stop(1)",
        "TRIGGER WHEN PATH=0 DELAY=0 DO stop() PRIO=-1",
    ] {
        let text = format!(
            "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,1)\n{decl}\nINTERRUPT ON 5\nLIN XP1\nEND\nDEF \
             stop(n:IN)\nINT n\nLIN XP3\nEND\n"
        );
        let program = read_files(&[("m.src", &text), ("m.dat", DATA), ("o.src", other)]);
        let moves = program.moves.iter().zip(to(&program));
        let of_routine = moves.filter(|(_, target)| *target == "XP3");
        let bases: Vec<_> = of_routine
            .map(|(m, _)| program.frames[m.frame].name.as_str())
            .collect();
        assert!(
            !bases.is_empty() && bases.iter().all(|base| *base == "BASE_DATA[1]"),
            "{decl}: {bases:?}"
        );
    }
}

#[test]
fn what_interrupts_and_triggers_assign_may_hold_anywhere() {
    let names = |text: &str| {
        let program = path(text);
        let mut names: Vec<_> = to(&program).into_iter().map(str::to_owned).collect();
        names.sort_unstable();
        (names, reported(&program).join(" "))
    };
    // as a whole
    let trigger = "TRIGGER WHEN DISTANCE=0 DELAY=0 DO XP1=XP3";
    let (found, ids) = names(&format!("{trigger}\nLIN XP2\nLIN XP1"));
    assert_eq!(
        (found, &*ids),
        (vec!["XP1".into(), "XP2".into(), "XP3".into()], "")
    );
    // in parts: it is what the file has, or that with another number
    let trigger = "TRIGGER WHEN DISTANCE=1 DELAY=0 DO XP1.Z=XP1.Z+40";
    let (found, ids) = names(&format!("{trigger}\nLIN XP2\nLIN XP1"));
    assert_eq!(found, ["?", "XP1", "XP2"]);
    assert!(ids.contains("target-assigned-at-run-time"), "{ids}");
    // a number that chooses
    let program = path(
        "DECL INT n\nINTERRUPT DECL 5 WHEN $IN[5]==TRUE DO n=1\nn=2\n$TOOL=TOOL_DATA[n]\nLIN XP1",
    );
    let mut tools: Vec<_> = program
        .moves
        .iter()
        .map(|used| program.tools[used.tool].name.as_str())
        .collect();
    tools.sort_unstable();
    assert_eq!(tools, ["TOOL_DATA[1]", "TOOL_DATA[2]"]);
    // a signal changes nothing
    let (found, ids) = names("TRIGGER WHEN PATH=0 DELAY=0 DO $OUT[1]=TRUE\nLIN XP1");
    assert_eq!((found, &*ids), (vec!["XP1".into()], ""));
}

#[test]
fn an_element_that_only_the_running_program_knows_is_each_of_them() {
    let data = "DEFDAT M\nDECL E6POS w[2]\nw[1]={X 1,Y 0,Z 0,A 0,B 0,C 0}\nw[2]={X 2,Y 0,Z 0,A 0,B \
        0,C 0}\nENDDAT\n";
    let read = |call: &str, routine: &str| {
        let text = format!(
            "DEF M()\nINT k\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nFOR k=1 TO 2\n{call}\nENDFOR\nLIN \
             w[1]\nEND\n{routine}\nEND\n"
        );
        read_files(&[("m.src", &text), ("m.dat", data)])
    };
    let program = read("go(w[k])", "DEF go(p:IN)\nE6POS p\nLIN p");
    let mut found = to(&program);
    found.sort_unstable();
    assert_eq!(found, ["w[1]", "w[1]", "w[2]"]);
    assert_eq!(ids(&program), [""; 0]);
    // what the routine writes may be any of them
    let program = read("up(w[k])", "DEF up(q:OUT)\nE6POS q\nq.Z=q.Z+5");
    assert!(ids(&program).contains(&"target-assigned-at-run-time"));
    // all at once
    let program = read("all(w[])", "DEF all(r[]:IN)\nE6POS r[]\nLIN r[1]");
    let errors = program
        .findings
        .iter()
        .filter(|f| f.id == "target-passed-to-routine");
    assert!(errors.clone().count() > 0);
    assert!(
        errors
            .clone()
            .all(|f| !f.message.contains("not in the files"))
    );
}

#[test]
fn functions_that_are_not_in_the_files_may_move_to_what_they_are_given() {
    for text in [
        "b=place(XP1)",
        "IF place(XP1) THEN\nENDIF",
        "WAIT FOR place(XP1)",
        "$BASE=base(XP1)",
    ] {
        let program = path(&format!("{text}\nBAS(#BASE,2)\nLIN XP1"));
        assert_eq!(blocked(&program), ["XP1"], "{text}");
        assert!(
            reported(&program).contains(&"target-passed-to-routine"),
            "{text}"
        );
    }
    for text in [
        "b=ABS(x)+VARSTATE(\"XP1\")",
        "q=FORWARD(XHOME,err)",
        "b=INV_POS(XP1)",
    ] {
        let program = path(&format!("{text}\nLIN XP1"));
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
}

#[test]
fn instructions_keep_where_their_parts_stand() {
    let text = "DEF M()\n  LIN XP1 WITH $VEL={CP 0.25} C_DIS ; way\nCIRC {X 1,Y 2,Z 3,A 0,B 0,C 0} \
        , XP2\nEND\n";
    let program = read_files(&[("m.src", text), ("m.dat", DATA)]);
    let shown: Vec<_> = program
        .instructions
        .iter()
        .map(|i| {
            let target = i.target_span.range().map(|span| &text[span]);
            (
                &text[i.place.offset as usize..i.end as usize],
                target.unwrap_or(""),
            )
        })
        .collect();
    let arc = "CIRC {X 1,Y 2,Z 3,A 0,B 0,C 0} , XP2";
    assert_eq!(
        shown,
        [
            ("LIN XP1 WITH $VEL={CP 0.25} C_DIS", "XP1"),
            (arc, "{X 1,Y 2,Z 3,A 0,B 0,C 0}"),
            (arc, "XP2")
        ]
    );
    let speed_zone = program.speed_zone(&program.moves[0]);
    assert!(speed_zone.cuts_corner() && speed_zone.speed_m_s == Some(0.25));
    assert_eq!(program.speed_zone(&program.moves[2]).zone_m, Some(0.0));
}

#[test]
fn what_interrupts_and_triggers_hand_to_routines_is_followed() {
    let program = path(
        "TRIGGER WHEN PATH=0 DELAY=0 DO sub(XP1) PRIO=-1\nLIN XP1\nLIN XP2\nEND\nDEF \
         sub(q:OUT)\nE6POS q\nq.Z=q.Z+50",
    );
    assert_ne!(reported(&program), [""; 0], "XP1 is written at any time");
    let program = path(
        "INTERRUPT DECL 5 WHEN $IN[5]==TRUE DO isr(XP1)\nLIN XP2\nEND\nDEF isr(p:IN)\nE6POS p\nLIN \
         p",
    );
    let mut found = to(&program);
    found.sort_unstable();
    found.dedup();
    assert_eq!(found, ["XP1", "XP2"]);
}

/// The tool and base of the move to a position.
fn of<'p>(program: &'p Program, target: &str) -> (&'p str, &'p str) {
    let mut moves = program.moves.iter();
    let found = moves.find(|m| {
        let target_of = m.target.map(|of| &program.targets[of]);
        target_of.is_some_and(|of| of.name.as_deref() == Some(target))
    });
    let m = found.unwrap_or_else(|| panic!("no move to {target}: {:?}", to(program)));
    (&program.tools[m.tool].name, &program.frames[m.frame].name)
}

#[test]
fn points_behind_a_jump_have_the_tool_and_base_that_are_set_in_front_of_them() {
    let shown = "FDAT_ACT=FP1\nBAS(#FRAMES)\nLIN XP2";
    for text in [
        format!("GOTO done\n{shown}\ndone:"),
        format!("LOOP\nLIN XP1\nENDLOOP\n{shown}"),
        format!("RETURN\n{shown}"),
    ] {
        let text = format!("DEF M()\nBAS(#TOOL,5)\nBAS(#BASE,6)\nLIN XP3\n{text}\nEND\n");
        let program = read_files(&[("m.src", &text), ("m.dat", DATA)]);
        assert_eq!(
            of(&program, "XP2"),
            ("TOOL_DATA[1]", "BASE_DATA[2]"),
            "{text}"
        );
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
    // routines that call each other, and that nothing else calls
    let text = format!("DEF a()\n{shown}\nb()\nEND\nDEF b()\na()\nEND\nDEF c()\nEND\n");
    let program = read_files(&[("m.src", &text), ("m.dat", DATA)]);
    assert_eq!(of(&program, "XP2"), ("TOOL_DATA[1]", "BASE_DATA[2]"));
}

#[test]
fn what_is_set_behind_something_unknown_is_known() {
    for unknown in [
        "other()\nFDAT_ACT=FP1\nBAS(#FRAMES)\nLIN XP1",
        "FDAT_ACT=FHOME\nBAS(#PTP_PARAMS,100)\nPTP XHOME",
    ] {
        let set = format!("{unknown}\n$TOOL=TOOL_DATA[4]\n$BASE=BASE_DATA[3]\nLIN XP2");
        let read = |rest: &str| {
            let text = format!("DEF M()\n{set}\nEND\n{rest}");
            read_files(&[("m.src", &text), ("m.dat", DATA)])
        };
        let program = read("");
        assert_eq!(
            of(&program, "XP2"),
            ("TOOL_DATA[4]", "BASE_DATA[3]"),
            "{set}"
        );
        assert!(
            !reported(&program).contains(&"frame-chosen-at-run-time"),
            "{set}"
        );
        // somewhere the robot holds the work piece: with data that are not in the files it may, too
        let held = read("DEF s()\n$IPO_MODE=#tCp\nLIN XP3\nEND\n");
        let is_unknown = reported(&held).contains(&"frame-chosen-at-run-time");
        assert_eq!(is_unknown, unknown.contains("FHOME"), "{set}");
    }
    let loads =
        path("FDAT_ACT=FHOME\nBAS(#FRAMES)\n$TOOL=TOOL_DATA[4]\n$BASE=BASE_DATA[3]\nLIN XP2");
    assert_eq!(reported(&loads), ["load-chosen-at-run-time"]);
}

#[test]
fn a_frame_displaced_by_numbers_is_a_position() {
    let data = "DEFDAT M\nDECL FRAME w[2]\nw[2]={X 1,Y 0,Z 0,A 0,B 0,C 0}\nENDDAT\n";
    let text = "DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN w[2]\nLIN w[2]:{X 0,Y 5,Z 0,A 0,B 0,C \
        0}\nEND\n";
    let program = read_files(&[("m.src", text), ("m.dat", data)]);
    assert_eq!(ids(&program), [""; 0]);
    let [there, near] = &program.moves[..] else {
        panic!("{:?}", program.moves);
    };
    assert_eq!(there.target, near.target);
    assert!(matches!(near.displacement, Displacement::By(_)));
}

/// What an interrupt calls with arguments has the tool and base of where it is switched on.
#[test]
fn interrupts_with_arguments_begin_where_they_are_switched_on() {
    use super::frames::{CONFIG, used};
    let text = "DEF M()\nINTERRUPT DECL 3 WHEN $IN[1]==TRUE DO isr(XP1)\nINTERRUPT DECL 4 WHEN \
        $IN[2]==TRUE DO n=1\n$TOOL=TOOL_DATA[1]\n$BASE=BASE_DATA[1]\nINTERRUPT ON 3\nINTERRUPT ON \
        4\nLIN XP2\nEND\nDEF isr(p:IN)\nE6POS p\nLIN p\nEND\n";
    let files = [
        ("System/$config.dat", CONFIG),
        ("m.src", text),
        ("m.dat", DATA),
    ];
    let program = read_files(&files);
    let used = used(&program);
    assert_eq!(to(&program).len(), used.len());
    assert!(used.len() >= 2, "{used:?}");
    let wanted = ("TOOL_DATA[1]", "BASE_DATA[1]");
    assert!(used.iter().all(|of| *of == wanted), "{used:?}");
    assert_eq!(reported(&program), [""; 0]);
}
