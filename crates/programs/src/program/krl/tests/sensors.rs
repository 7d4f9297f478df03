//! Sensors that correct moves.

use super::frames::in_cell;
use super::*;

const USE: &str = "BAS(#TOOL,1)\nBAS(#BASE,1)";

#[test]
fn moves_that_a_sensor_corrects_are_reported_once_a_place() {
    for (on, off) in [
        ("RSI_ON(#RELATIVE)", "RSI_OFF()"),
        ("n=rsi_on(#ABSOLUTE)", "n=RSI_OFF()"),
        ("n=ST_ON1(#BASE,1)", "ST_OFF()"),
    ] {
        let program = in_cell(&format!(
            "DECL INT n\n{USE}\nPTP XP1\n{on}\nLIN XP1\nLIN XP2\n{off}\nLIN XP1"
        ));
        assert_eq!(reported(&program), ["corrected-by-sensor"], "{on}");
        let mut used = program.moves.iter().filter_map(|of| program.target_of(of));
        assert!(used.all(|target| !target.blocked), "{on}");
        let ended = in_cell(&format!("DECL INT n\n{USE}\n{on}\n{off}\nLIN XP1"));
        assert_eq!(reported(&ended), [""; 0], "{on}");
    }
}

#[test]
fn where_a_sensor_leaves_the_robot_only_the_running_program_knows() {
    let begins = |text: &str| {
        let program = in_cell(&format!("DECL INT n\n{USE}\nPTP XP1\n{text}\nLIN XP2"));
        let last = program.moves.len() - 1;
        program.led.iter().any(|led| led.0 as usize == last)
    };
    assert!(!begins("n=1"));
    assert!(begins("RSI_MOVECORR()") && begins("n=RSI_MOVECORR()"));
}
