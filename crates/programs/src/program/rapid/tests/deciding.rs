//! Decisions by numbers of targets.

use super::*;
use crate::compensate::{Options, compensate};
use crate::profile::{Profile, SHIPPED};
use crate::program::deciding::shown;

/// By which targets these statements decide behind moves to p1 and p2.
fn by(statements: &str) -> Vec<String> {
    shown(&path(&format!(
        "MoveJ p1,v5,z5,t;\nMoveL p2,v5,z5,t;\n{statements}"
    )))
}

#[test]
fn numbers_of_targets_that_moves_use_decide() {
    let function = "ENDPROC\nFUNC bool high(robtarget p)\nRETURN p.trans.z>3;\nENDFUNC\nPROC x()";
    for (statements, expected) in [
        ("IF p1.trans.z>=3 THEN\nStop;\nENDIF", &["p1"][..]),
        ("IF di1=1 AND p1.trans.z>=3 MoveL p2,v5,z5,t;", &["p1"]),
        ("IF Distance(p1.trans,p2.trans)>100 Stop;", &["p1", "p2"]),
        ("FOR i FROM 0 TO p1.trans.x/50 DO\nStop;\nENDFOR", &["p1"]),
        ("TEST Round(p1.trans.x)\nCASE 1:\nStop;\nENDTEST", &["p1"]),
        (
            "VAR num x;\nx:=p1.trans.z;\nIF x>=3 Stop;\nIF x<2 Stop;",
            &["p1>"],
        ),
        (
            "VAR num x;\nVAR bool b;\nx:=p1.trans.z;\nb:=x+1>3;\nWHILE NOT b DO\nStop;\nENDWHILE",
            &["p1>"],
        ),
        (
            "VAR num n;\nn:=p2.trans.x;\nMoveL q{n},v5,z5,t;\nIF a Stop;",
            &["p2>"],
        ),
        (
            "VAR robtarget q;\nq:=Offs(p1,0,0,5);\nIF q.trans.z>=3 Stop;",
            &["p1"],
        ),
        (
            "high p2;\nENDPROC\nPROC high(robtarget p)\nIF p.trans.z>3 Stop;",
            &["p2"],
        ),
        (&format!("IF high(p2) Stop;\n{function}"), &["p2"]),
        // what closes a block has no semicolon
        (
            "IF a THEN\nStop;\nENDIF\nhigh p2;\nENDPROC\nPROC high(robtarget p)\nIF p.trans.z>3 \
             Stop;",
            &["p2"],
        ),
        (
            "IF high() Stop;\nENDPROC\nFUNC bool high()\nIF a THEN\nStop;\nENDIF\nRETURN \
             p2.trans.z>3;\nENDFUNC\nPROC x()",
            &["p2>"],
        ),
    ] {
        assert_eq!(by(statements), expected, "{statements}");
    }
}

#[test]
fn what_is_followed_or_never_rewritten_decides_nothing() {
    for statements in [
        "IF p3.trans.z>=3 Stop;",
        "IF di1=1 MoveL p2,v5,z5,t;",
        "IF di1=1 THEN\nMoveL Offs(p2,p1.trans.x,0,0),v5,z5,t;\nENDIF",
        "VAR robtarget q;\nq:=p1;\nq.trans.x:=p1.trans.x+50;\nIF a MoveL q,v5,z5,t;",
        "IF p1.extax.eax_a>3 Stop;",
        "VAR robtarget q;\nq:=CRobT();\nIF q.trans.z>3 Stop;",
        "VAR num x;\nx:=p1.trans.z;\nIF a TPWrite \"\"\\Num:=x;",
        "! IF p1.trans.z>=3 Stop;\nIF a Stop;",
        "up;\nIF x>3 Stop;\nENDPROC\nPROC up()\nVAR num x;\nx:=p1.trans.z;",
    ] {
        assert_eq!(by(statements), [""; 0], "{statements}");
    }
}

#[test]
fn a_decision_by_a_rewritten_target_is_reported_with_its_shift() {
    let (_, profile) = SHIPPED
        .iter()
        .find(|(name, _)| *name == "abb_irb120_thesis")
        .expect("a shipped profile");
    let profile = Profile::from_yaml(profile).expect("a valid profile");
    let text = "MODULE m\nCONST robtarget p10:=[[400,0,300],[0,0,1,0],CONF;\n\
        CONST robtarget p20:=[[350,100,320],[0,0,1,0],CONF;\n\
        PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\n\
        PROC main()\nVAR num x;\nMoveJ p10,v5,fine,t;\nIF p10.trans.z>=300 THEN\n\
        MoveL p20,v5,fine,t;\nENDIF\nx:=p20.trans.x;\nWHILE x>349 DO\nx:=x-1;\nENDWHILE\n\
        ENDPROC\nENDMODULE\n"
        .replace("CONF", CONF);
    let sources = [Source::new("m.mod", text.into_bytes())];
    let done = compensate(&Rapid, &sources, &profile, &Options::default()).expect("compensated");
    let found = done.findings.iter().filter(|f| f.id == "numbers-read");
    let found: Vec<_> = found
        .map(|f| (f.line, f.message.split(": ").next().unwrap_or_default()))
        .collect();
    assert_eq!(
        found,
        [
            (8, "the program decides here by numbers of `p10`"),
            (
                11,
                "the program reads numbers of `p20` here and decides by them in line 12"
            ),
        ]
    );
    assert!(!done.is_refused());
}
