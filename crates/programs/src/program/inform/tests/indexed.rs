//! Moves to P variables by a number in another variable.

use super::*;

fn positions(more: &str) -> String {
    let p = |n: u32| format!("P{n:05}={n}.000,2.000,3.000,10.0000,20.0000,30.0000\n");
    format!("{USER}C00000={P6}\n{}{}{more}", p(10), p(11))
}

fn targets_of_move(program: &Program, at: usize) -> Vec<f64> {
    let moves = program.moves.iter().skip(at);
    let numbers = moves.filter_map(|to| program.target_of(to));
    numbers
        .map(|target| program.numbers_of(target)[0].value)
        .collect()
}

#[test]
fn they_go_to_each_of_the_files() {
    let program = read(&job(&positions(""), "MOVL C00000 V=5\nMOVL P[B000] V=5"));
    assert_eq!(targets_of_move(&program, 1), [10.0, 11.0]);
    assert!(program.targets.iter().all(|target| !target.blocked));
    assert!(ids(&program).contains(&"computed-target"));
    assert!(!ids(&program).contains(&"target-unused-here"));
}

#[test]
fn they_stay_where_there_may_be_others() {
    let other_tool = format!("///TOOL 4\nP00012={P6}\n");
    for (positions, instructions) in [
        (positions(&other_tool), "MOVL P[B000] V=5"),
        (positions(""), "MOVL P[B000] V=5\nGETS PX077 $PX000"),
        (positions(""), "SETE P[B000] (1) 5\nMOVL P[B000] V=5"),
        (format!("{USER}C00000={P6}\n"), "MOVL P[B000] V=5"),
    ] {
        let program = read(&job(
            &positions,
            &format!("MOVL C00000 V=5\n{instructions}"),
        ));
        assert_eq!(
            targets_of_move(&program, 1),
            [0.0; 0],
            "{instructions}: {:?}",
            program.findings
        );
        assert!(ids(&program).contains(&"computed-target"));
    }
}
