//! Which load holds at a move.

use super::frames::{CONFIG, in_cell};
use super::*;

/// The mass that each move carries; none where the files tell none.
fn masses(program: &Program) -> Vec<Option<f64>> {
    let tools = program.moves.iter().map(|used| &program.tools[used.tool]);
    tools
        .map(|tool| tool.load.map(|load| load.mass_kg))
        .collect()
}

const USE: &str = "BAS(#TOOL,1)\nBAS(#BASE,1)";

#[test]
fn the_load_of_a_move_is_that_which_the_program_set_last() {
    let load = "{M 20,CM {X 0,Y 0,Z 100},J {X 0,Y 0,Z 0}}";
    for (text, expected) in [
        (format!("{USE}\nLIN XP1"), &[Some(5.5)][..]),
        (
            format!("LOAD_DATA[1]={load}\n{USE}\nLIN XP1"),
            &[Some(20.0)],
        ),
        (
            format!("{USE}\nLOAD_DATA[1]={load}\nLIN XP1\n$LOAD=LOAD_DATA[1]\nLIN XP1"),
            &[Some(5.5), Some(20.0)],
        ),
        (
            format!("{USE}\n$LOAD={load}\nLIN XP1\nSLIN XP2 WITH $LOAD=LOAD_DATA[1]\nLIN XP1"),
            &[Some(20.0), Some(5.5), Some(20.0)],
        ),
        // none, that of the tool, and none in the entry of the tool
        (
            format!(
                "{USE}\n$LOAD={}\nLIN XP1\n$LOAD={}\nLIN XP1",
                load.replace("M 20", "M 0.0"),
                load.replace("M 20", "M -1")
            ),
            &[None, Some(5.5)],
        ),
        (
            format!(
                "LOAD_DATA[1]={}\n{USE}\nLIN XP1",
                load.replace("M 20", "M 0")
            ),
            &[None],
        ),
        (
            format!("DECL INT n\nn=1\n{USE}\n$LOAD={load}\nSLIN XP2 WITH $LOAD=LOAD_DATA[n]"),
            &[Some(5.5)],
        ),
    ] {
        let program = in_cell(&text);
        let mut found = masses(&program);
        found.dedup();
        assert_eq!(found, expected, "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
}

#[test]
fn as_many_loads_as_are_kept_apart_speak_against_no_move() {
    let set = |mass: u32| {
        format!("CASE {mass}\n$LOAD={{M {mass},CM {{X 0,Y 0,Z 9}},J {{X 0,Y 0,Z 0}}}}\n")
    };
    let cases: String = [2, 3, 4].map(set).concat();
    let program = in_cell(&format!("{USE}\nSWITCH n\n{cases}ENDSWITCH\nLIN XP1"));
    let mut found = masses(&program);
    found.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    assert_eq!(found, [Some(2.0), Some(3.0), Some(4.0), Some(5.5)]);
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn a_load_of_one_move_that_is_not_known_is_said_of_that_move() {
    let unknown: &[&str] = &["load-chosen-at-run-time"];
    for (text, expected) in [
        ("SLIN XP1 WITH $LOAD=LOAD_DATA[k]", unknown),
        ("SLIN XP1 WITH $LOAD.M=20", unknown),
        ("SLIN XP1 WITH $LOAD.CM.X=20,$VEL.CP=1", unknown),
        ("SPLINE WITH $LOAD.M=20\nSPL XP1\nENDSPLINE", unknown),
        // one that is known, whatever $LOAD is
        ("$LOAD.M=3\nSLIN XP1 WITH $LOAD=LOAD_DATA[1]", &[]),
        (
            "$LOAD.M=3\nSLIN XP1 WITH $IPO_MODE=SIPO_MODE(FP1.IPO_FRAME)",
            unknown,
        ),
        ("SLIN XP1 WITH $LOAD.M=20\nSLIN XP2", unknown),
    ] {
        let program = in_cell(&format!("{USE}\n{text}"));
        assert_eq!(reported(&program), expected, "{text}");
    }
    let places = in_cell(&format!("{USE}\nSLIN XP2\nSLIN XP1 WITH $LOAD.M=20"));
    let found = places.findings.iter().find(|of| of.id == unknown[0]);
    assert_eq!(found.map(|of| of.line), Some(5));
}

#[test]
fn two_configs_with_different_loads_are_refused_where_one_is_used() {
    let text = "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,1)\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n";
    for (change, ids) in [
        (("M 5.5", "M 7.5"), &["frame-name-ambiguous"][..]),
        (("M 5.5", "M -1.0"), &["frame-name-ambiguous"]),
        (("M 5.5", "M 5.500001"), &[]),
        (("LOAD_DATA[2]={M -1.0", "LOAD_DATA[2]={M 4.0"), &[]),
    ] {
        let other = CONFIG.replace(change.0, change.1);
        let files = [
            ("a/$config.dat", CONFIG),
            ("b/$config.dat", &*other),
            ("m.src", text),
        ];
        assert_eq!(reported(&read_files(&files)), ids, "{change:?}");
    }
}

#[test]
fn an_entry_that_the_files_do_not_have_is_the_load_of_its_own_tool_alone() {
    let data = "DEFDAT $CONFIG\nTOOL_DATA[1]={X 0,Y 0,Z 100,A 0,B 0,C 0}\nTOOL_DATA[5]={X 0,Y 0,Z \
        150,A 0,B 0,C 0}\nLOAD_DATA[2]={M -1,CM {X 0,Y 0,Z 0},J {X 0,Y 0,Z 0}}\nENDDAT\n";
    let said = |text: &str| {
        let text = format!("DEF M()\n$BASE=$WORLD\n{text}\nEND\n");
        let program = read_files(&[("$config.dat", data), ("m.src", &text)]);
        let all = program.findings.iter();
        all.filter(|of| of.id == "load-chosen-at-run-time")
            .map(|of| (of.line, of.message.contains("LOAD_DATA[5]")))
            .collect::<Vec<_>>()
    };
    let go = "LIN {X 1,Y 2,Z 3,A 0,B 0,C 0}";
    for (text, expected) in [
        (
            format!("$TOOL=TOOL_DATA[1]\n$LOAD=LOAD_DATA[5]\n{go}"),
            &[(4, true)][..],
        ),
        (format!("$TOOL=TOOL_DATA[5]\n$LOAD=LOAD_DATA[5]\n{go}"), &[]),
        (format!("$LOAD=LOAD_DATA[5]\n$TOOL=TOOL_DATA[5]\n{go}"), &[]),
        (format!("BAS(#TOOL,5)\n{go}"), &[]),
        // an entry that nobody has filled in
        (format!("$TOOL=TOOL_DATA[1]\n$LOAD=LOAD_DATA[2]\n{go}"), &[]),
        (
            format!("$TOOL=TOOL_DATA[1]\nS{go} WITH $LOAD=LOAD_DATA[5]"),
            &[(4, true)],
        ),
        (
            format!("$TOOL=TOOL_DATA[5]\n$LOAD=LOAD_DATA[5]\n{go}\n$TOOL=TOOL_DATA[1]\n{go}"),
            &[(4, true)],
        ),
    ] {
        assert_eq!(said(&text), expected, "{text}");
    }
}
