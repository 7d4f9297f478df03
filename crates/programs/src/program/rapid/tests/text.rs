//! Text: what is recognised, what is broken, where the marker stands.

use super::*;

#[test]
fn missing_semicolons_short_ifs_and_headers_do_not_hide_moves() {
    let program = read(
        "%%%\n VERSION:1\n LANGUAGE:ENGLISH\n%%%\n\nMODULE m(SYSMODULE, NOSTEPIN)\nPROC a()\n \
         SetDO d, 1\n SetDO d, 0\n\
         IF di1=1 MoveL [[1,2,3],[1,0,0,0],CONF,v5,z5,tool0;\n TEST n\n CASE 1,2:\n\
         MoveL [[4,2,3],[1,0,0,0],CONF,v5,z5,tool0;\n DEFAULT:\n Stop;\n ENDTEST\n FOR i FROM 1 TO \
             3 DO\n\
         MoveL [[5,2,3],[1,0,0,0],CONF,v5,z5,tool0;\n ENDFOR\nERROR\n RETRY;\nENDPROC\nENDMODULE",
    );
    assert_eq!((program.targets.len(), program.moves.len()), (3, 3));
    assert_eq!(program.findings, []);
}

#[test]
fn broken_text_is_an_error_with_its_place() {
    for (text, place, word) in [
        ("MODULE m\nPROC a()\nENDPROC\n", (1, 1), "module"),
        ("MODULE m\nPROC a()\n", (2, 1), "routine"),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3],[1,0,0,0];\nENDMODULE",
            (2, 20),
            "bracket",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3,4],[1,0,0,0],CONF;\nENDMODULE",
            (2, 27),
            "]",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3],[1,0,0,0],CONF];\nENDMODULE",
            (2, 75),
            "semicolon",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1e400,2,3],[1,0,0,0],CONF;\nENDMODULE",
            (2, 22),
            "number",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[NaN,2,3],[1,0,0,0],CONF;\nENDMODULE",
            (2, 22),
            "number",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1.#QNAN,2,3],[1,0,0,0],CONF;\nENDMODULE",
            (2, 22),
            "number",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,9E9,3],[1,0,0,0],CONF;\nENDMODULE",
            (2, 24),
            "coordinate",
        ),
        (
            "MODULE m\nPROC a()\nMoveL [[1,2,3],[0,0,0,0],CONF,v5,z5,t;\nENDPROC\nENDMODULE",
            (3, 17),
            "quaternion",
        ),
        (
            "MODULE m\nCONST robtarget p:=[[1,2,3],[1,0.2,0,0],CONF;\nENDMODULE",
            (2, 30),
            "quaternion",
        ),
        (
            "MODULE m\nPROC a()\nTPWrite \"open;\nENDPROC\nENDMODULE",
            (3, 9),
            "string",
        ),
    ] {
        let error = read_files(&[text]).expect_err(text);
        let (_, line, column) = error.place();
        assert_eq!((line, column), place, "{error}");
        assert!(error.to_string().contains(word), "{error}");
    }
    assert!(matches!(
        read_files(&["hello resolved"]),
        Err(ReadError::NotThisLanguage { .. })
    ));
    assert!(matches!(
        read_files(&["MODULE\0"]),
        Err(ReadError::Binary { .. })
    ));
}

#[test]
fn the_marker_stands_behind_the_module_line() {
    let marker = Marker {
        version: "1".into(),
        profile_sha256: "a".into(),
        source_sha256: "b".into(),
        decided: Vec::new(),
    };
    for (text, before) in [
        (
            "%%%\r\n  VERSION:1\r\n%%%\r\nMODULE m(SYSMODULE) ! x\r\nENDMODULE\r\n",
            "ENDMODULE",
        ),
        ("CONST robtarget p:=[[1,2,3],[1,0,0,0],CONF;\n", "CONST"),
        ("MODULE m ENDMODULE", "MODULE"),
    ] {
        let source = Source::new("a", text.replace("CONF", CONF).into_bytes());
        let (at, lines) = Rapid.mark(&source, &marker);
        assert!(source.bytes[at..].starts_with(before.as_bytes()), "{text}");
        assert!(lines.ends_with(source.line_end()) && lines.starts_with(b"  ! "));
        let mut marked = source.bytes.clone();
        marked.splice(at..at, lines);
        let marked = [Source::new("a", marked)];
        assert!(motion::read(&Rapid, &marked, &Settings::default()).is_ok());
    }
}

#[test]
fn rapid_is_distinguished_from_other_text() {
    for text in [
        "%%%\nVERSION:1\n%%%\nMODULE m\nENDMODULE",
        "! c\nMODULE x(NOSTEPIN)\nEND",
        "CONST robtarget p:=[[1",
        "MoveL p10, v100, z10, tool0;",
        "MoveJ [[1,2,3],[1,0,0,0]",
    ] {
        assert!(Rapid.recognises(&Source::new("a", text.into())), "{text}");
    }
    for text in [
        "1 MOV P1\n2 MVS P2",
        "PROCEDURE x\n SET TALK OFF\nRETURN",
        "module foo\n implicit none\nend module",
        "module foo(a, b);\n input a;\nendmodule",
        "/PROG A\n/MN\n",
        "DEF x()\nPTP HOME\nEND",
        "",
    ] {
        assert!(!Rapid.recognises(&Source::new("a", text.into())), "{text}");
    }
}

#[test]
fn nothing_before_a_move_swallows_it() {
    for before in [
        "<SMT>",
        "sub\n",
        "Set do1\n",
        "x:=y",
        "x:=1\n",
        "label:",
        "<SMT>;",
        "Stop",
        "IF a=1",
        "IF a THEN\n",
    ] {
        let program = path(&format!("{before} MoveL p1,v5,z5,t;\nMoveL p2,v5,z5,t;"));
        assert_eq!(to(&program), ["p1", "p2"], "{before}");
    }
}

#[test]
fn numbers_have_their_sign_apart_or_another_base() {
    let program = read(
        "MODULE m\nPROC main()\nMoveL [[- 20,+ 0x1F,0b101],[1,0,0,0],[0,0,-\t1,0o7],[9E9,9E9,9E9,9E9,9E9,9E9]],v5,z5,tool0;\n\
         MoveL [[- ! up\n 20,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v5,z5,tool0;\nENDPROC\nENDMODULE\n",
    );
    let numbers = program.numbers_of(&program.targets[0]);
    let values: Vec<f64> = numbers.iter().map(|number| number.value).collect();
    assert_eq!(values[..3], [-20.0, 31.0, 5.0]);
    assert_eq!(values[7..], [0.0, 0.0, -1.0, 7.0]);
    // a remark is no part of a number
    assert_eq!(ids(&program), ["target-has-expressions"]);
}

#[test]
fn types_have_other_names() {
    let data = "MODULE d\n PERS spot p1:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
                LOCAL PROC go(spot p)\n MoveL p,v5,z5,tool0;\nENDPROC\nPROC main()\n go p1;\nENDPROC\nENDMODULE\n";
    let alias = "MODULE a\nALIAS robtarget spot;\nENDMODULE\n";
    let program = read_files(&[data, alias]).expect("a program");
    assert_eq!(to(&program), ["p1"]);
    assert_eq!(ids(&program), [""; 0]);
    // of two types by one name neither is meant
    let other = "MODULE b\nALIAS jointtarget spot;\nENDMODULE\n";
    let program = read_files(&[data, alias, other]).expect("a program");
    assert!(to(&program).iter().all(|name| *name == "?"));
}

#[test]
fn data_without_an_orientation_yet_are_an_error_of_the_move_to_them() {
    let blank = "[[0,0,0],[0,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let module = |data: &str, statements: &str| {
        read_files(&[&format!(
            "MODULE m\nPERS robtarget q{data};\nPERS tooldata \
                 t:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\nCONST robtarget \
                 p:=[[1,2,3],[1,0,0,0],{CONF};\nPROC main()\nMoveL p,v5,z5,t;\n{statements}\n\
                 ENDPROC\nENDMODULE"
        )])
    };
    for data in [format!(":={blank}"), format!("{{2}}:=[{blank},{blank}]")] {
        let program = module(&data, "").expect("a program");
        assert_eq!(ids(&program), [""; 0], "{data}");
    }
    let used = module(&format!(":={blank}"), "MoveL q,v5,z5,t;").expect("a program");
    assert_eq!(ids(&used), ["computed-target"]);
    // constants that mark what is not set
    let none = "[[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let constants = format!(":={blank};\nCONST robtarget u:={blank};\nCONST jointtarget n:={none}");
    let program = module(&constants, "").expect("a program");
    assert_eq!(ids(&program), [""; 0]);
    for go in ["MoveL u,v5,z5,t;", "MoveAbsJ n,v5,z5,t;"] {
        let program = module(&constants, go).expect("a program");
        assert_eq!(ids(&program), ["target-uninitialised"], "{go}");
        let is_error = |finding: &Finding| finding.severity == Severity::Error;
        assert!(
            said(&program).iter().all(|finding| is_error(finding)),
            "{go}"
        );
    }
    assert!(module("", &format!("MoveAbsJ {none},v5,z5,t;")).is_err());
    assert!(
        module(
            ":=[[0,0,0],[0.5,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]",
            ""
        )
        .is_err()
    );
    assert!(module("", &format!("MoveL {blank},v5,z5,t;")).is_err());
}
