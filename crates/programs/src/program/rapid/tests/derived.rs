//! Targets with parts from elsewhere: which parts take the correction along.

use super::*;

/// By what each move is displaced from its target.
fn displaced(statements: &str) -> Vec<Displacement> {
    let program = path(&format!("VAR robtarget q;\n{statements}"));
    let moves = program.moves.iter();
    moves.map(|m| m.displacement.clone()).collect()
}

#[test]
fn coordinates_that_come_from_no_target_lose_its_correction() {
    let numbers = "VAR pos s:=[1,2,3];\nPERS num up:=150;\nq:=p1;\n";
    for statements in [
        "MoveL [[150,35,82],p1.rot,p1.robconf,p1.extax],v5,z5,t;",
        "MoveL [[p1.trans.x,p1.trans.y,150],p1.rot,p1.robconf,p1.extax],v5,z5,t;",
        "q:=[[150,35,82],p1.rot,p1.robconf,p1.extax];\nMoveL q,v5,z5,t;",
        "VAR pos s:=[1,2,3];\nq:=[s,p1.rot,p1.robconf,p1.extax];\nMoveL q,v5,z5,t;",
        "VAR num z;\nq:=p1;\nIF a z:=150;\nIF b z:=p1.trans.z;\nq.trans.z:=z;\nMoveL q,v5,z5,t;",
        "VAR pos s;\nq:=p1;\ns:=[p1.trans.x,p1.trans.y,9];\nq.trans:=s;\nMoveL q,v5,z5,t;",
        "q:=p1;\nlift q,150;\nENDPROC\nPROC lift(robtarget p,num z)\np.trans.z:=z;\nMoveL \
         p,v5,z5,t;",
        "CONST jointtarget j:=[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]];\nMoveAbsJ \
         [[0,0,j.robax.rax_3,0,0,0],j.extax],v5,z5,t;",
    ] {
        let all = displaced(statements);
        assert!(
            !all.is_empty() && all.iter().all(|by| *by == Displacement::Overwritten),
            "{statements}: {all:?}"
        );
    }
    for write in [
        "q.trans:=s;",
        "q.trans.z:=up;",
        "q.trans.z:=-up+5;",
        "q.trans.x:=nCamera;",
        "q.trans:=[p1.trans.x,p1.trans.y,150];",
    ] {
        let all = displaced(&format!("{numbers}{write}\nMoveL q,v5,z5,t;"));
        assert_eq!(all, [Displacement::Overwritten], "{write}");
    }
}

#[test]
fn coordinates_computed_from_a_target_keep_its_correction() {
    let functions = "\nENDPROC\nFUNC num up(num z)\nRETURN z+50;\nENDFUNC\nFUNC num \
                     height()\nRETURN p1.trans.z+50;\nENDFUNC\nPROC last()";
    for write in [
        "q.trans.z:=q.trans.z+h;",
        "q.trans:=p2.trans;",
        "q.trans:=[p1.trans.x,p2.trans.y,p1.trans.z+50];",
        "q.trans:=CPos(\\Tool:=t);",
        "q.trans.z:=up(p1.trans.z);",
        "q.trans.z:=height();",
        "z:=p1.trans.z+50;\nz:=z+1;\nq.trans.z:=z;",
        "s:=[p1.trans.x,p2.trans.y,p1.trans.z];\nq.trans:=s;",
        "s:=p1.trans;\nset z;\nq.trans.z:=z;",
        // other parts than coordinates
        "q.rot:=o;",
        "q.extax.eax_a:=rail;",
    ] {
        let all = displaced(&format!(
            "VAR num z:=0;\nVAR pos s;\nq:=p1;\n{write}\nMoveL q,v5,z5,t;\nENDPROC\nPROC set(INOUT \
             num z)\nz:=p1.trans.z;{functions}"
        ));
        assert_eq!(all, [Displacement::Unknown], "{write}");
    }
    for target in [
        "[p2.trans,p1.rot,p1.robconf,p1.extax]",
        "[[p1.trans.x,p1.trans.y,p1.trans.z+h],o,p1.robconf,p1.extax]",
    ] {
        for all in [
            displaced(&format!("MoveL {target},v5,z5,t;")),
            displaced(&format!("q:={target};\nMoveL q,v5,z5,t;")),
        ] {
            assert!(
                !all.is_empty() && all.iter().all(|by| *by == Displacement::Unknown),
                "{target}: {all:?}"
            );
        }
    }
}

#[test]
fn targets_inside_records_are_named() {
    let program = path("MoveL s.above,v5,z5,t;\nMoveL s.below,v5,z5,t;");
    assert_eq!(ids(&program), ["computed-target"; 2]);
    assert!(said(&program)[0].message.contains("s.above"));
    assert!(said(&program)[1].message.contains("s.below"));
}

#[test]
fn a_position_computed_from_joints_of_the_text_is_not_corrected() {
    let joints = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    for given in ["j", "js{1}", joints] {
        for go in [
            format!("MoveJ CalcRobT({given},t\\WObj:=w),v5,z5,t\\WObj:=w;"),
            format!("q:=CalcRobT({given},t);\nMoveJ q,v5,z5,t;"),
        ] {
            let program = path(&format!(
                "VAR robtarget q;\nCONST jointtarget j:={joints};\nCONST jointtarget \
                 js{{1}}:=[{joints}];\n{go}"
            ));
            assert_eq!(ids(&program), ["computed-target"], "{go}");
        }
    }
    let program = path("VAR jointtarget j;\nj:=CJointT();\nMoveJ CalcRobT(j,t),v5,z5,t;");
    assert_eq!(ids(&program), ["run-time-position"]);
}

#[test]
fn a_seam_tracker_corrects_the_path() {
    let program =
        path("ArcL p1,v5,seam,weld,fine,t\\WObj:=w\\Track:=trk;\nArcL p2,v5,seam,weld,fine,t;");
    assert_eq!(ids(&program), ["corrected-by-sensor"]);
    assert!(said(&program)[0].message.contains("\\Track"));
}
