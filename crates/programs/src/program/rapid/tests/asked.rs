//! Branches that calls choose.

use super::*;

/// The tools with which the moves of a program run that calls `setup`, and what is said of it.
fn set_up(statements: &str, setup: &str) -> (Vec<String>, Vec<&'static str>) {
    let rest = "[1,0,0,0]],[1.5,[0,0,50],[1,0,0,0],0,0,0]];";
    let program = read(&format!(
        "MODULE m\n CONST num GRIP:=1;\n CONST num DRILL:=2;\n VAR num k;\n\
         CONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\n\
         PERS tooldata tg:=[TRUE,[[0,0,100],{rest}\n\
         PERS tooldata td:=[TRUE,[[0,0,200],{rest}\n\
         PERS tooldata t:=[TRUE,[[0,0,300],{rest}\n\
         PROC main()\n{statements}\nMoveJ p1,v5,z5,t;\nENDPROC\n{setup}\nENDMODULE\n"
    ));
    let tools = program.moves.iter();
    let mut tools: Vec<_> = tools
        .map(|of| program.tools[of.tool].name.clone())
        .collect();
    tools.sort();
    tools.dedup();
    (tools, said(&program).iter().map(|of| of.id).collect())
}

const BY_TEST: &str = "PROC setup(num n)\nTEST n\nCASE GRIP:\nt:=tg;\nCASE DRILL,3:\nt:=td;\n\
    DEFAULT:\nStop;\nENDTEST\nENDPROC";

fn of(tool: &str) -> (Vec<String>, Vec<&'static str>) {
    (vec![tool.to_owned()], vec![])
}

#[test]
fn numbers_and_constants_choose_their_branch() {
    let by_if = "PROC setup(num n)\nIF n=GRIP THEN\nt:=tg;\nELSEIF (n <> 3) THEN\nt:=td;\n\
        ENDIF\nENDPROC";
    for (call, text, tool) in [
        ("setup 1;", BY_TEST, "tg"),
        ("setup GRIP;", BY_TEST, "tg"),
        ("setup 2;", BY_TEST, "td"),
        ("setup 3;", BY_TEST, "td"),
        ("setup(4);", BY_TEST, "t"),
        ("setup 1;", by_if, "tg"),
        ("setup DRILL;", by_if, "td"),
        ("setup 3;", by_if, "t"),
        ("setup 2;\nsetup 1;", by_if, "tg"),
    ] {
        assert_eq!(set_up(call, text), of(tool), "{call} {text}");
    }
}

#[test]
fn flags_and_optional_numbers_choose_their_branch() {
    let flag = "PROC setup(bool grips\\num n)\nIF NOT grips THEN\nt:=td;\nELSE\nt:=tg;\nENDIF\n\
        IF n=5 t:=td;\nENDPROC";
    assert_eq!(set_up("setup TRUE\\n:=4;", flag), of("tg"));
    assert_eq!(set_up("setup FALSE\\n:=4;", flag), of("td"));
    assert_eq!(set_up("setup true\\n:=5;", flag), of("td"));
    // whether it is given does not tell what it is
    let (tools, _) = set_up("setup TRUE;", flag);
    assert_eq!(tools, ["td", "tg"]);
}

#[test]
fn what_words_join_chooses_the_branch_as_far_as_it_is_known() {
    let text = "PROC setup(num n,bool b)\nIF n=1 AND (b OR di1=1) THEN\nt:=tg;\n\
        ELSEIF n=2 OR n=DRILL+1 OR NOT (n<>5) THEN\nt:=td;\nENDIF\nENDPROC";
    for (call, tools) in [
        ("setup 1,TRUE;", &["tg"][..]),
        ("setup 1,FALSE;", &["t", "td", "tg"]),
        ("setup 2,TRUE;", &["td"]),
        ("setup 5,TRUE;", &["td"]),
        ("setup 4,TRUE;", &["t", "td"]),
    ] {
        assert_eq!(set_up(call, text).0, tools, "{call}");
    }
}

/// An operator that is a word belongs to the argument, and what a loop counts hides other names.
#[test]
fn flags_that_are_worked_out_choose_no_branch() {
    let flag = "PROC setup(bool grips)\nIF grips THEN\nt:=tg;\nELSE\nt:=td;\nENDIF\nENDPROC";
    for call in [
        "setup TRUE AND b;",
        "setup FALSE OR DInput(di1)=1;",
        "setup (TRUE) XOR b;",
    ] {
        let (tools, _) = set_up(call, flag);
        assert_eq!(tools, ["td", "tg"], "{call}");
    }
    let (tools, _) = set_up("FOR GRIP FROM 1 TO 2 DO\nsetup GRIP;\nENDFOR", BY_TEST);
    assert!(tools.len() > 1, "{tools:?}");
}

#[test]
fn what_chooses_may_be_handed_on() {
    let text = format!("PROC cell(num m)\nsetup m;\nENDPROC\n{BY_TEST}");
    assert_eq!(set_up("cell GRIP;", &text), of("tg"));
    assert_eq!(set_up("cell 3;", &text), of("td"));
}

/// What the text does not tell is not decided.
#[test]
fn branches_that_calls_do_not_choose_are_all_taken() {
    let before = |statements: &str| BY_TEST.replace("TEST n", &format!("{statements}\nTEST n"));
    let counted = before("FOR n FROM 1 TO 3 DO").replace("ENDTEST", "ENDTEST\nENDFOR");
    let by_reference = "PROC other(INOUT num m)\nm:=m+1;\nENDPROC";
    for (call, text) in [
        ("setup k;", BY_TEST.to_owned()),
        ("setup GRIP+1;", BY_TEST.to_owned()),
        (
            "IF di1=1 THEN\nsetup 1;\nELSE\nsetup 2;\nENDIF",
            BY_TEST.to_owned(),
        ),
        ("setup k MOD 2;", BY_TEST.to_owned()),
        (
            "setup 1;",
            BY_TEST.replace("TEST n", "IF di1=1 ! and n=2\nRETURN;\nTEST n"),
        ),
        ("setup GRIP DIV k;", BY_TEST.to_owned()),
        ("setup 1;", counted),
        ("setup 1;", before("n:=2;")),
        ("setup 1;", before("Incr n;")),
        ("setup 1;", before("outside n;")),
        (
            "setup 1;",
            format!("{}\n{by_reference}", before("other n;")),
        ),
    ] {
        let (tools, _) = set_up(call, &text);
        assert!(tools.len() > 1, "{call} {text}: {tools:?}");
    }
}
