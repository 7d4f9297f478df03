//! Routines: what they are given, give back and write, and when they run.

use super::*;

#[test]
fn parameters_are_what_each_call_gives() {
    let rm = "ENDPROC\nPROC rm(robtarget p\\switch fast|num slow\\robtarget via, PERS tooldata g)\n\
              MoveL p,v5,z5,g;\nIF Present(via) MoveL via,v5,z5,g;";
    let program = path(&format!(
        "rm p1,t;\nrm Offs(p2,0,0,5),t\\via:=p3;\nrm \\fast,p1,t2;\n{rm}"
    ));
    assert_eq!(to(&program), ["p1", "p2", "p1", "p3"]);
    assert_eq!(ids(&program), [""; 0]);
    let tools: Vec<_> = program
        .moves
        .iter()
        .map(|m| program.tools[m.tool].name.as_str())
        .collect();
    assert_eq!(tools, ["t", "t", "t2", "t"]);
    let program = path("rm;\nENDPROC\nPROC rm(\\robtarget p)\nMoveL p,v5,z5,t;");
    assert_eq!(ids(&program), ["computed-target"]);
}

#[test]
fn a_routine_that_asks_whether_a_parameter_is_given_goes_as_each_call_gives_it() {
    let calls = "rm p1;\nrm p2\\via:=p3\\g:=t2;";
    for (body, expected) in [
        (
            "IF Present(via) MoveL via,v5,z5,t;\nMoveL p,v5,z5,t;",
            vec!["p1", "p3", "p2"],
        ),
        (
            "IF NOT Present(via) THEN\nMoveL p,v5,z5,t;\nELSE\nMoveL via,v5,z5,t;\nENDIF",
            vec!["p1", "p3"],
        ),
        ("sub\\to?via;\nMoveL p,v5,z5,t;", vec!["p1", "p3", "p2"]),
    ] {
        let sub = if body.starts_with("sub") {
            "\nENDPROC\nPROC sub(\\robtarget to)\nIF Present(to) MoveL to,v5,z5,t;"
        } else {
            ""
        };
        let program = path(&format!(
            "{calls}\nENDPROC\nPROC rm(robtarget p\\robtarget via\\PERS tooldata g)\n{body}{sub}"
        ));
        let mut reached = to(&program);
        reached.sort_unstable();
        let mut expected = expected;
        expected.sort_unstable();
        assert_eq!((reached, ids(&program)), (expected, vec![]), "{body}");
    }
    let tools = "IF Present(g) THEN\nMoveL p,v5,z5,g;\nELSE\nMoveL p,v5,z5,t;\nENDIF";
    let program = path(&format!(
        "{calls}\nENDPROC\nPROC rm(robtarget p\\robtarget via\\PERS tooldata g)\n{tools}"
    ));
    let name = |m: &crate::program::Move| program.tools[m.tool].name.clone();
    let mut tools: Vec<_> = to(&program)
        .into_iter()
        .zip(program.moves.iter().map(name))
        .collect();
    tools.sort_unstable();
    assert_eq!(tools, [("p1", "t".into()), ("p2", "t2".into())]);
    // never given: the move to it runs nowhere
    let program = path(
        "rm p1;\nENDPROC\nPROC rm(robtarget p\\robtarget via)\nMoveL p,v5,z5,t;\nIF Present(via) \
         THEN\nMoveL Offs(via,0,0,1),v5,z5,t;\nENDIF",
    );
    assert_eq!((to(&program), ids(&program)), (vec!["p1"], vec![]));
    // what only the running program knows, and conditions with more than that, are followed both ways
    for condition in ["Present(via) AND n>1", "n=1 OR Present(via)", "Present(p)"] {
        let program = path(&format!(
            "rm p1;\nENDPROC\nPROC rm(robtarget p\\robtarget via)\nIF {condition} THEN\nMoveL \
             via,v5,z5,t;\nENDIF"
        ));
        assert_eq!(ids(&program), ["computed-target"], "{condition}");
    }
}

#[test]
fn parameters_by_reference_are_written_back() {
    let program = path(
        "set p3;\nMoveL p3,v5,z5,t;\nENDPROC\nPROC set(INOUT robtarget r)\nsub r;\nENDPROC\n\
         PROC sub(INOUT robtarget s)\ns:=p1;",
    );
    assert_eq!((to(&program), ids(&program)), (vec!["p1"], vec![]));
    let program = path(
        "set p3;\nMoveL p3,v5,z5,t;\nENDPROC\nPROC set(robtarget r)\nr:=p1;\nMoveL r,v5,z5,t;",
    );
    assert_eq!(to(&program), ["p3", "p1"], "a copy");
}

#[test]
fn a_tool_that_is_declared_with_an_expression_is_written_back() {
    let program = path(
        "PERS tooldata g:=f();\nset g;\nMoveL p1,v5,z5,g;\nENDPROC\nPROC set(INOUT tooldata \
         r)\nr:=t;",
    );
    assert_eq!(program.tools[program.moves[0].tool].name, "t");
    assert_eq!(ids(&program), [""; 0]);
}

#[test]
fn functions_give_positions_and_move() {
    let program = path(
        "MoveL f(p1),v5,z5,t;\nMoveL Offs(f(p2),0,0,5),v5,z5,t;\nMoveC \
         f(p1),f(p2),v5,z5,t;\nok:=g(1)+1;\n\
         ENDPROC\nFUNC robtarget f(robtarget a)\nRETURN Offs(a,1,2,3);\nENDFUNC\n\
         FUNC num g(num x)\nMoveL p3,v5,z5,t;\nRETURN 1;\nENDFUNC\nPROC last()",
    );
    assert_eq!(to(&program), ["p1", "p2", "p1", "p2", "p3"]);
    assert_eq!(ids(&program), [""; 0]);
    assert!(
        program.moves[..4]
            .iter()
            .all(|m| m.displacement != Displacement::None)
    );
}

#[test]
fn what_stands_before_the_end_of_an_arc_is_the_point_on_its_way() {
    let read = |via: &str, end: &str, rest: &str| {
        path(&format!(
            "MoveL p1,v5,z5,t;\nMoveC {via},{end},v5,z5,t;\nENDPROC\n{rest}\nPROC last()"
        ))
    };
    let chosen = "FUNC robtarget f(num k)\nIF k=1 RETURN p2;\nRETURN p1;\nENDFUNC";
    for (via, end, rest) in [
        ("f(1)", "p3", chosen),
        ("f(1)", "Offs(p3,0,0,5)", chosen),
        ("CRobT()", "p3", ""),
        ("fElsewhere(1)", "p3", ""),
        ("rPart.target", "p3", ""),
        ("pElsewhere", "p3", ""),
        ("p3", "f(2)", chosen),
        ("f(1)", "f(2)", chosen),
    ] {
        let program = read(via, end, rest);
        let kinds: Vec<_> = program.instructions.iter().map(|one| one.motion).collect();
        let expected = [Motion::Linear, Motion::ArcVia, Motion::ArcEnd];
        assert_eq!(kinds, expected, "{via} {end}");
        let said: Vec<_> = program.findings.iter().map(|of| &of.message).collect();
        assert!(said.iter().all(|of| !of.contains("v5")), "{via}: {said:?}");
        if end.ends_with("p3") {
            assert_eq!(to(&program).last(), Some(&"p3"), "{via}");
        }
    }
}

#[test]
fn routines_that_are_not_in_the_files_may_do_anything_with_targets() {
    for call in [
        "Pick p1;",
        "b:=fPlace(p1);",
        "IF fReady(1,p1) Stop;",
        "%\"Pick\"% p1;",
        "%name%p1;",
    ] {
        let program = path(&format!("{call}\nMoveL p1,v5,z5,t;"));
        assert_eq!(ids(&program), ["target-passed-to-routine"], "{call}");
        assert_eq!(blocked(&program), ["p1"], "{call}");
    }
    for call in [
        "d:=Distance(p1.trans,p2.trans);",
        "TPWrite \"x\"\\Pos:=p1.trans;",
        "Pick 1;",
    ] {
        let program = path(&format!("{call}\nMoveL p1,v5,z5,t;"));
        assert_eq!(ids(&program), [""; 0], "{call}");
    }
}

#[test]
fn late_bound_calls_find_their_routines() {
    let rest = "ENDPROC\nPROC Pick1()\nMoveL p2,v5,z5,t;\nENDPROC\nPROC Pick2()\nMoveL p3,v5,z5,t;";
    for call in ["%\"m:Pick1\"%;", "%\"pick1\"%;"] {
        let program = path(&format!("ConfL\\Off;\n{call}\n{rest}"));
        let configured: Vec<_> = program.moves.iter().map(|m| m.configured).collect();
        assert_eq!(configured, [false, true], "{call}");
    }
    for call in [
        "%\"Pick\"+ValToStr(i)%;",
        "CallByVar \"Pick\",i;",
        "%name%;",
    ] {
        let program = path(&format!("ConfL\\Off;\n{call}\n{rest}"));
        assert!(program.moves.iter().all(|m| !m.configured), "{call}");
    }
}

#[test]
fn handlers_may_run_between_any_statements() {
    for retry in ["RETRY", "StartMoveRetry"] {
        let program = path(&format!(
            "MoveL p1,v5,z5,t;\nConfL\\Off;\nMoveL p2,v5,z5,t;\nERROR\nIF ERRNO=1 THEN\nMoveL \
             p3,v5,z5,t;\n{retry};\nENDIF\nRAISE;",
        ));
        let all: Vec<_> = to(&program).into_iter().zip(&program.moves).collect();
        for name in ["p1", "p2", "p3"] {
            let mut configured = all
                .iter()
                .filter(|(to, _)| *to == name)
                .map(|(_, m)| m.configured);
            assert!(configured.clone().any(|c| c) && configured.any(|c| !c));
        }
        assert!(
            all.iter().all(|(_, m)| program.before(m).len() > 1),
            "the handler goes on anywhere: {retry}"
        );
    }
    let program = path("MoveL p1,v5,z5,t;\nMoveL p2,v5,z5,t;\nERROR\nWaitTime 1;\nRETRY;");
    assert_eq!(
        program.before(&program.moves[1]),
        [crate::program::Before::One(0)]
    );
}

#[test]
fn an_argument_in_parentheses_is_what_stands_in_them() {
    for call in [
        "sub(p1);",
        "sub (p1);",
        "sub(Offs(p1,0,0,5));",
        "sub(p1),5;",
    ] {
        let program = path(&format!(
            "{call}\nENDPROC\nPROC sub(robtarget q,\\num n)\nMoveL q,v5,z5,t;"
        ));
        assert_eq!(to(&program), ["p1"], "{call}");
        assert_eq!(ids(&program), [""; 0], "{call}");
    }
    let program = path("MoveL (p1),v5,z5,(t);");
    assert_eq!((to(&program), program.tools.len()), (vec!["p1"], 1));
}

#[test]
fn what_nothing_can_write_stays_what_it_is() {
    for call in [
        "ReportPos \"here\",tool0,wobj0;",
        "Search_1D d,p3,p2,v5,t\\WObj:=w;",
        "ArcRepL\\Start\\End,Layer_2,v5,s,e,b,z5,t\\WObj:=w;",
    ] {
        let program = path(&format!(
            "MoveL p1,v5,z5,t\\WObj:=w;\nMoveL p1,v5,z5,tool0;\n{call}\nMoveL \
             p1,v5,z5,tool0;\nMoveL p1,v5,z5,t\\WObj:=w;"
        ));
        let found = ids(&program);
        assert!(
            !found.iter().any(|id| id.starts_with("frame-")),
            "{call}: {found:?}"
        );
    }
    // one that is only called alike may
    let program = path("Search_tool t;\nMoveL p1,v5,z5,t;");
    assert_eq!(ids(&program), ["frame-chosen-at-run-time"]);
}

#[test]
fn traps_may_run_at_any_place() {
    let program = path("MoveL p3,v5,z5,t;\nENDPROC\nTRAP tr\np3:=CRobT();\nENDTRAP\nPROC last()");
    assert_eq!(
        (to(&program), ids(&program)),
        (vec!["p3", "?"], vec!["run-time-position"])
    );
}

/// A local datum of a trap is set by it alone, and anew each time it runs.
#[test]
fn no_other_time_of_a_trap_writes_its_local_data() {
    for value in ["", ":=[[0,0,0],[1,0,0,0],CONF"] {
        let program = path(&format!(
            "MoveL p1,v5,z5,t;\nENDPROC\nTRAP tr\nVAR robtarget back{value};\nback:=CRobT(\\Tool:=t);\nMoveL \
             p2,v5,z5,t;\nMoveL back,v5,z5,t;\nENDTRAP\nPROC last()"
        ));
        assert_eq!(ids(&program), ["run-time-position"], "{value}");
        assert_eq!(to(&program)[..2], ["p1", "p2"], "{value}");
    }
}

#[test]
fn a_trap_moves_with_what_the_interrupted_program_has_set() {
    for (connect, first) in [("CONNECT i1 WITH tr;\n", 120.0), ("", 100.0)] {
        let program = path(&format!(
            "t.tframe.trans.z:=120;\n{connect}MoveL p1,v5,z5,t;\nt.tframe.trans.z:=140;\nMoveL \
             p2,v5,z5,t;\nENDPROC\nTRAP tr\nMoveL p3,v5,z5,t;\nENDTRAP\nPROC last()"
        ));
        let of_trap = program.moves.iter().zip(to(&program));
        let of_trap = of_trap.filter(|(_, target)| *target == "p3");
        let length = |m: &crate::program::Move| {
            let tool = program.tools[m.tool].flange_from_tool.expect("a tool");
            (tool.translation[2] * 1e3).round()
        };
        let mut lengths: Vec<_> = of_trap.map(|(m, _)| length(m)).collect();
        lengths.sort_by(f64::total_cmp);
        lengths.dedup();
        // what is set before the interrupt is connected may hold later, too
        assert_eq!((lengths[0], lengths[lengths.len() - 1]), (first, 140.0));
    }
}

#[test]
fn a_routine_hides_the_instruction_or_function_of_its_name() {
    for name in ["Load", "Open", "Stop", "Reset", "Clear", "PDispOff", "sub"] {
        let program = path(&format!(
            "{name} p1,t2;\nENDPROC\nLOCAL PROC {name}(robtarget p,PERS tooldata g)\nMoveL \
             p,v5,z5,g;"
        ));
        assert_eq!(to(&program), ["p1"], "{name}");
        assert_eq!(program.tools[program.moves[0].tool].name, "t2", "{name}");
        assert_eq!(ids(&program), [""; 0], "{name}");
    }
    for name in ["Load", "Add"] {
        let program = path(&format!(
            "{name};\nMoveL p3,v5,z5,t;\nENDPROC\nPROC {name}()\np3:=p1;"
        ));
        assert_eq!(
            (to(&program), ids(&program)),
            (vec!["p1"], vec![]),
            "{name}"
        );
    }
    for name in ["Distance", "CRobT", "f"] {
        let program = path(&format!(
            "MoveL {name}(p1),v5,z5,t;\nENDPROC\nFUNC robtarget {name}(robtarget a)\nRETURN \
             a;\nENDFUNC\nPROC last()"
        ));
        assert_eq!(
            (to(&program), ids(&program)),
            (vec!["p1"], vec![]),
            "{name}"
        );
    }
}

#[test]
fn a_local_routine_hides_an_instruction_in_its_own_module_only() {
    let program = read_files(&[
        "MODULE a\nPROC main()\nPDispOn p,tool0;\nMoveL [[1,2,3],[1,0,0,0],CONF,v5,z5,tool0;\n\
         ENDPROC\nENDMODULE",
        "MODULE b\nLOCAL PROC PDispOn(robtarget p,PERS tooldata g)\nENDPROC\nENDMODULE",
    ])
    .expect("two modules");
    assert_eq!(ids(&program), ["displacement-active"]);
}

#[test]
fn a_local_function_hides_offs_in_its_own_module_only() {
    for name in ["Offs", "RelTool"] {
        let a = format!(
            "MODULE a\nCONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\nPROC main()\nMoveL \
             {name}(p1,0,0,5),v5,z5,tool0;\nother;\nENDPROC\nENDMODULE"
        );
        let b = format!(
            "MODULE b\nCONST robtarget p2:=[[4,5,6],[1,0,0,0],CONF;\nPROC other()\nMoveL \
             {name}(p2,0,0,5),v5,z5,tool0;\nENDPROC\nLOCAL FUNC robtarget {name}(robtarget p,num \
             x,num y,num z)\nRETURN p;\nENDFUNC\nENDMODULE"
        );
        let program = read_files(&[&a, &b]).expect("two modules");
        assert_eq!(to(&program), ["p1", "p2"], "{name}");
        let [in_a, in_b] = &program.moves[..] else {
            panic!("two moves");
        };
        assert!(matches!(in_a.displacement, Displacement::By(_)), "{name}");
        assert_eq!(in_b.displacement, Displacement::None, "{name}");
        assert_eq!(ids(&program), [""; 0], "{name}");
    }
}

#[test]
fn options_that_are_handed_on_are_left_out_where_nothing_is_given() {
    let program = path(
        "go p1,t;\ngo p2,t\\w2:=w;\nENDPROC\nPROC go(robtarget p,PERS tooldata g\\PERS wobjdata \
         w2)\nMoveL p,v5\\V?speed,z5,g\\WObj?w2;",
    );
    let all = program.moves.iter();
    let with: Vec<_> = all
        .map(|m| {
            let (tool, frame) = (&program.tools[m.tool], &program.frames[m.frame]);
            (tool.name.as_str(), frame.name.as_str())
        })
        .collect();
    assert_eq!(to(&program), ["p1", "p2"]);
    assert_eq!(with, [("t", "wobj0"), ("t", "w")]);
    assert_eq!(ids(&program), [""; 0]);
}
