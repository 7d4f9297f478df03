//! Branches that calls choose.

use super::flow::tools_of;
use super::*;

const ACTIVE: &str = "UF : F, UT : F,\t\tCONFIG : 'N U T, 0, 0, 0',";

/// The tools of the move behind these lines, which call a program with these.
fn tools(lines: &str, setup: &str) -> Vec<String> {
    let lines = format!("UTOOL_NUM=9 ;\n{lines}\nJ P[1] 1% FINE ;");
    let main = listing(&lines, &pose("1", ACTIVE));
    let setup = listing(setup, "").replace("TEST", "SETUP");
    tools_of(&[("test.ls", &main), ("setup.ls", &setup)])
}

const BY_IF: &str = "IF (AR[1:which]=1) THEN ;\nUTOOL_NUM=4 ;\nELSE ;\n\
    IF AR[1]<>3,UTOOL_NUM=5 ;\nENDIF ;";
const BY_SELECT: &str = "SELECT AR[1]=1,JMP LBL[1] ;\n       =2,JMP LBL[2] ;\n       ELSE,END ;\n\
    LBL[1] ;\nUTOOL_NUM=4 ;\nEND ;\nLBL[2] ;\nUTOOL_NUM=5 ;";
const BY_JUMP: &str = "IF AR[1]=1,JMP LBL[1] ;\nUTOOL_NUM=5 ;\nEND ;\nLBL[1] ;\nUTOOL_NUM=4 ;";

#[test]
fn arguments_choose_their_branch() {
    for (call, setup, tool) in [
        ("CALL SETUP(1) ;", BY_IF, "4"),
        ("CALL SETUP(2) ;", BY_IF, "5"),
        ("CALL SETUP(3) ;", BY_IF, "9"),
        ("CALL SETUP(1) ;", BY_SELECT, "4"),
        ("CALL SETUP(2) ;", BY_SELECT, "5"),
        ("CALL SETUP(7) ;", BY_SELECT, "9"),
        ("CALL SETUP(1) ;", BY_JUMP, "4"),
        ("CALL SETUP(1) ;\nCALL SETUP(2) ;", BY_JUMP, "5"),
        ("R[1]=1 ;\nCALL SETUP(R[1]) ;", BY_JUMP, "4"),
    ] {
        assert_eq!(tools(call, setup), [tool], "{call} {setup}");
    }
}

#[test]
fn what_words_join_chooses_the_branch_as_far_as_it_is_known() {
    let setup = "IF (AR[1]=1 OR AR[1]=2) THEN ;\nUTOOL_NUM=4 ;\nENDIF ;\n\
        IF AR[1]=3 AND AR[2]<>1,UTOOL_NUM=5 ;\nIF AR[1]=3 AND DI[1]=ON,UTOOL_NUM=6 ;";
    for (call, expected) in [
        ("CALL SETUP(1,1) ;", &["4"][..]),
        ("CALL SETUP(2,2) ;", &["4"]),
        ("CALL SETUP(3,2) ;", &["5", "6"]),
        ("CALL SETUP(3,1) ;", &["6", "9"]),
        ("CALL SETUP(4,2) ;", &["9"]),
    ] {
        let mut found = tools(call, setup);
        found.sort();
        assert_eq!(found, expected, "{call}");
    }
}

#[test]
fn what_chooses_may_be_handed_on() {
    let main = listing("CALL CELL(2) ;\nJ P[1] 1% FINE ;", &pose("1", ACTIVE));
    let cell = listing("CALL SETUP(AR[1]) ;", "").replace("TEST", "CELL");
    let setup = listing(BY_JUMP, "").replace("TEST", "SETUP");
    let files = [("a.ls", &*main), ("b.ls", &*cell), ("c.ls", &*setup)];
    assert_eq!(tools_of(&files), ["5"]);
}

/// What the text does not tell is not decided.
#[test]
fn branches_that_calls_do_not_choose_are_all_taken() {
    for (call, setup) in [
        ("CALL SETUP(R[1]) ;", BY_JUMP),
        ("CALL SETUP ;", BY_JUMP),
        ("CALL SETUP('a') ;", BY_JUMP),
        (
            "IF DI[1]=ON,CALL SETUP(1) ;\nIF DI[1]=OFF,CALL SETUP(2) ;",
            BY_IF,
        ),
        ("CALL SETUP(1) ;", "IF AR[1]=1 AND DI[1]=ON,UTOOL_NUM=4 ;"),
        ("CALL SETUP(1) ;", "IF AR[1]>=1,UTOOL_NUM=4 ;"),
        ("CALL SETUP(1) ;", "IF AR[1]=R[2],UTOOL_NUM=4 ;"),
        (
            "CALL SETUP(1) ;",
            "WAIT AR[1]=1 TIMEOUT,LBL[1] ;\nUTOOL_NUM=4 ;\nLBL[1] ;",
        ),
    ] {
        let tools = tools(call, setup);
        assert!(tools.len() > 1, "{call} {setup}: {tools:?}");
    }
}
