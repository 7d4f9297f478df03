//! Several tasks: what they share, and what one writes while another moves.

use super::*;

const TOOL: &str = "PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n\
                    CONST robtarget p:=[[1,2,3],[1,0,0,0],CONF;\n";
const WORK: &str = "[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]";
const HERE: &str = "[[7,8,9],[1,0,0,0],CONF";

/// A task with a tool that runs these statements, and another one with these declarations and
/// statements, in either order.
fn two(data: &str, moves: &str, other: &str, statements: &str) -> [Program; 2] {
    let first = format!("MODULE a\n{TOOL}{data}\nPROC main()\n{moves}\nENDPROC\nENDMODULE");
    let second = format!(
        "MODULE b\n{other}\nPROC main()\nWHILE TRUE DO\n{statements}\nENDWHILE\nENDPROC\nENDMODULE"
    );
    [[&first, &second], [&second, &first]]
        .map(|files| read_files(&files.map(String::as_str)).expect("two modules"))
}

fn heights(program: &Program) -> Vec<f64> {
    let frame = |m: &crate::program::Move| program.frames[m.frame].world_from_frame;
    let z = |m| (frame(m).expect("a frame").translation[2] * 1e3).round();
    let mut all: Vec<_> = program.moves.iter().map(z).collect();
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn a_work_object_that_another_task_writes_is_known_at_run_time_only() {
    let data = format!("PERS wobjdata w:={WORK};");
    let go = "MoveL p,v5,z5,t\\WObj:=w;";
    for other in ["PERS wobjdata w;".to_owned(), data.clone()] {
        for program in two(&data, go, &other, "w.oframe.trans:=[nX,nY,0];") {
            assert_eq!(ids(&program), ["frame-assigned-at-run-time"], "{other}");
        }
        for program in two(&data, go, &other, "w.oframe.trans:=[0,0,50];") {
            assert_eq!(heights(&program), [0.0, 50.0], "{other}");
        }
        // what the task itself writes holds one after the other
        let own = format!("w.oframe.trans:=[0,0,50];\n{go}");
        for program in two(&data, &own, &other, "x:=w.oframe.trans.z;") {
            assert_eq!(
                (heights(&program), ids(&program)),
                (vec![50.0], vec![]),
                "{other}"
            );
        }
    }
    for other in [
        "TASK PERS wobjdata w;",
        "LOCAL PERS wobjdata w;",
        "VAR wobjdata w;",
    ] {
        for program in two(&data, go, other, "w.oframe.trans:=[0,0,50];") {
            assert_eq!(heights(&program), [0.0], "{other}");
        }
    }
}

#[test]
fn a_target_that_another_task_writes_is_not_corrected() {
    let data = format!("PERS robtarget s:={HERE};");
    let go = "MoveL s,v5,z5,t;";
    for statement in [
        "s.trans.z:=5;",
        "set s;",
        "VAR robtarget own;\nown:=[[1,1,1],[1,0,0,0],CONF;\nown.trans.z:=nX;\ns:=own;",
    ] {
        let other = "PERS robtarget s;\nPROC set(INOUT robtarget r)\nr.trans.z:=nX;\nENDPROC";
        for program in two(&data, go, other, statement) {
            assert_eq!(
                ids(&program),
                ["target-assigned-at-run-time"],
                "{statement}"
            );
        }
    }
    for program in two(
        &data,
        go,
        "PERS robtarget s;",
        "s:=[[4,5,6],[1,0,0,0],CONF;",
    ) {
        let mut used: Vec<_> = program.moves.iter().map(|m| m.target).collect();
        used.sort_unstable();
        assert_eq!((used.len(), ids(&program)), (2, vec![]), "{used:?}");
        assert!(used[0] != used[1] && !used.contains(&None));
    }
    for program in two(&data, go, "TASK PERS robtarget s;", "s.trans.z:=5;") {
        assert_eq!((to(&program), ids(&program)), (vec!["s"], vec![]));
    }
}

#[test]
fn every_declaration_of_a_shared_target_is_rewritten() {
    let data = format!("PERS robtarget s:={HERE};");
    let go = "MoveL s,v5,z5,t;";
    for program in two(&data, go, &data, "Stop;") {
        assert_eq!((to(&program), ids(&program)), (vec!["s", "s"], vec![]));
        assert!(program.moves[0].target != program.moves[1].target);
    }
    for program in two(&data, go, &data.replace('7', "7.5"), "Stop;") {
        assert_eq!(ids(&program), ["target-name-ambiguous"; 2]);
    }
    let data = format!("PERS wobjdata w:={WORK};");
    for (other, said) in [
        (data.clone(), vec![]),
        (
            data.replacen("[[0,", "[[5,", 1),
            vec!["frame-name-ambiguous"],
        ),
    ] {
        for program in two(&data, "MoveL p,v5,z5,t\\WObj:=w;", &other, "Stop;") {
            assert_eq!(ids(&program), said, "{other}");
        }
    }
}
