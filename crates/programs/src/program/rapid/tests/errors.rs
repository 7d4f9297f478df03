//! Errors that leave a routine.

use super::{ids, path, to};

/// Whether configuration data may count, and may not, at the moves to a target.
fn counts(text: &str, name: &str) -> [bool; 2] {
    let program = path(text);
    let names = to(&program);
    let all = names.iter().zip(&program.moves);
    let found: Vec<bool> = (all.filter(|(to, _)| **to == name))
        .map(|(_, motion)| motion.configured)
        .collect();
    [true, false].map(|wanted| found.contains(&wanted))
}

/// A procedure that switches configuration data off for a while.
const SUB: &str =
    "ENDPROC\nPROC sub()\nMoveL p1,v5,z5,t;\nConfL\\Off;\nMoveL p2,v5,z5,t;\nConfL\\On;\n";

#[test]
fn a_handler_goes_on_with_what_a_routine_had_done_before_its_error() {
    for (handler, behind, again) in [
        ("", [true, false], [true, false]),
        ("ERROR\nTRYNEXT;\n", [true, true], [true, false]),
        ("ERROR\nWaitTime 1;\nRETRY;\n", [true, false], [true, true]),
        (
            "ERROR\nIF ERRNO=1 THEN\nRETRY;\nELSE\nTRYNEXT;\nENDIF\n",
            [true, true],
            [true, true],
        ),
        (
            "ERROR\nMoveJ p1,v5,z5,t;\nTRYNEXT;\n",
            [true, true],
            [true, true],
        ),
        (
            "ERROR(ERR_PATH_STOP)\nTRYNEXT;\n",
            [true, true],
            [true, false],
        ),
        // it ends the routine
        ("ERROR\nStop;\n", [true, false], [true, false]),
        ("UNDO\nStop;\n", [true, false], [true, false]),
    ] {
        let text = format!("sub;\nMoveL p3,v5,z5,t;\n{handler}{SUB}");
        assert_eq!(counts(&text, "p3"), behind, "{handler}");
        if !handler.contains("MoveJ") {
            assert_eq!(counts(&text, "p1"), again, "{handler}");
        }
    }
}

#[test]
fn an_error_comes_through_routines_without_a_handler_and_from_handlers_that_raise_it() {
    let main = "middle;\nMoveL p3,v5,z5,t;\nERROR\nTRYNEXT;\n";
    for middle in [
        "sub;\n",
        "sub;\nERROR\nRAISE;\n",
        "sub;\nERROR(ERR_PATH_STOP)\nRETURN;\n",
        "IF stop THEN\nsub;\nENDIF\nERROR\nIF ERRNO=1 THEN\nRETURN;\nENDIF\nRAISE;\n",
    ] {
        let text = format!("{main}ENDPROC\nPROC middle()\n{middle}{SUB}");
        assert_eq!(counts(&text, "p3"), [true, true], "{middle}");
    }
    // one that goes on itself leaves nothing for the others
    let text = format!("{main}ENDPROC\nPROC middle()\nsub;\nERROR\nRETRY;\n{SUB}");
    assert_eq!(counts(&text, "p3"), [true, false]);
    assert_eq!(counts(&text, "p1"), [true, true]);
}

#[test]
fn a_raised_error_does_not_come_behind_its_call() {
    let sub = "ENDPROC\nPROC sub()\nConfL\\Off;\nIF bad RAISE 5;\nConfL\\On;\n";
    let main = "sub;\nMoveL p3,v5,z5,t;\n";
    assert_eq!(counts(&format!("{main}{sub}"), "p3"), [true, false]);
    // its own handler has it
    for handler in ["ERROR\nTRYNEXT;\n", "ERROR\nConfL\\On;\nRETURN;\n"] {
        let text = format!("{main}{sub}{handler}");
        assert_eq!(counts(&text, "p3"), [true, false], "{handler}");
    }
    let text = format!("{main}{sub}ERROR\nRETURN;\n");
    assert_eq!(counts(&text, "p3"), [true, true]);
    for raise in [
        "RAISE;",
        "ErrRaise \"ERR_MINE\",1,s,s,s,s,s;",
        "RaiseToUser\\Continue,5;",
    ] {
        let text = format!("{main}ERROR\nTRYNEXT;\n{}", sub.replace("RAISE 5;", raise));
        assert_eq!(counts(&text, "p3"), [true, true], "{raise}");
    }
}

#[test]
fn errors_of_routines_that_call_themselves_are_followed_to_an_end() {
    let sub = SUB.replace("MoveL p2", "IF again sub;\nMoveL p2");
    for handler in [
        "ERROR\nTRYNEXT;\n",
        "ERROR\nRETRY;\n",
        "ERROR\nConfL\\On;\nRETRY;\n",
    ] {
        let text = format!("sub;\nMoveL p3,v5,z5,t;\n{handler}{sub}");
        assert_eq!(ids(&path(&text)), [""; 0], "{handler}");
        assert!(counts(&text, "p1")[1], "{handler}");
    }
}

#[test]
fn what_a_function_was_to_give_is_not_written_where_it_fails() {
    let text = "VAR robtarget q:=[[1,2,3],[1,0,0,0],CONF;\nq:=p1;\nq:=f();\nMoveL q,v5,z5,t;\nERROR\n\
                TRYNEXT;\nENDPROC\nFUNC robtarget f()\nIF bad RAISE 5;\nRETURN p2;\nENDFUNC\nPROC more()";
    let program = path(text);
    let mut names = to(&program);
    names.sort_unstable();
    assert_eq!(names, ["p1", "p2"]);
}
