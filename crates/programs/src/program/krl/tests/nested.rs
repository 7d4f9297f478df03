//! Functions in expressions: what they write counts wherever they are called.

use super::frames::used;
use super::*;

/// Functions that move.
const MOVING: &str = "END\nDEFFCT INT moves(n:IN)\nINT n\nPTP XHOME\nRETURN 1\nENDFCT\n\
    DEFFCT INT calls(n:IN)\nINT n\nRETURN moves(n)";

/// Functions that set a base or a position, and that do neither.
const FUNCTIONS: &str = "END\nDEFFCT INT three(n:IN)\nINT n\n$BASE=BASE_DATA[3]\nRETURN 1\nENDFCT\n\
    DEFFCT INT four(n:IN)\nINT n\n$BASE=BASE_DATA[4]\nRETURN 1\nENDFCT\n\
    DEFFCT INT raises(p:OUT)\nE6POS p\np.Z=p.Z+50\nRETURN 1\nENDFCT\n\
    DEFFCT INT counts(n:IN)\nINT n,m\nm=n+1\nRETURN abs(m)\nENDFCT\n\
    DEFFCT E6POS up(p:IN)\nE6POS p\np.Z=p.Z+10\nRETURN p\nENDFCT\n\
    DEFFCT E6POS over(p:IN)\nE6POS p\np.Z=p.Z+20\nRETURN p\nENDFCT\nDEF sub(n:IN)\nINT n\nHALT";

fn with_functions(statements: &str) -> Program {
    path(&format!("{statements}\n{FUNCTIONS}"))
}

#[test]
fn functions_are_seen_wherever_they_are_called() {
    for call in [
        "n=k[three(1)]",
        "k[three(1)]=2",
        "$OUT[three(1)]=TRUE",
        "sub(three(1))",
        "n=abs(three(1))",
        "n=counts(three(1))",
        "BAS(#ACC_CP,three(1))",
        "BAS(#TOOL,three(1))\nBAS(#TOOL,1)",
        "LIN w[three(1)]",
        "LIN {X three(1),Y 0,Z 0,A 0,B 0,C 0}",
        "LIN_REL {X three(1)}",
        "SPTP XP2 WITH $VEL_AXIS[1]=three(1)",
        "SLIN XP2 WITH $VEL.CP=three(1),$APO.CDIS=5 C_SPL",
        "SPLINE WITH $VEL.CP=three(1)\nSPL XP2\nENDSPLINE",
        "TRIGGER WHEN DISTANCE=0 DELAY=three(1) DO $OUT[1]=TRUE\nLIN XP2",
        "WHILE three(1)>2\nHALT\nENDWHILE",
        "FOR i=three(1) TO 2\nHALT\nENDFOR",
        "REPEAT\nHALT\nUNTIL three(1)>2",
        "SWITCH three(1)\nCASE 1\nHALT\nENDSWITCH",
        "WAIT FOR three(1)==1",
        // the one inside runs first
        "n=three(four(1))",
        "sub(three(four(1)))",
    ] {
        let program = with_functions(&format!("{call}\nLIN XP1"));
        let last = used(&program).pop();
        assert_eq!(last, Some(("TOOL_DATA[1]", "BASE_DATA[3]")), "{call}");
    }
    // it runs before the move
    let program = with_functions("SPTP XP2 WITH $VEL_AXIS[1]=three(1)");
    assert_eq!(used(&program), [("TOOL_DATA[1]", "BASE_DATA[3]")]);
    // what an interrupt does runs when it does
    let program = with_functions("TRIGGER WHEN DISTANCE=0 DELAY=0 DO n=counts(1)\nLIN XP1");
    assert_eq!(used(&program), [("TOOL_DATA[1]", "BASE_DATA[2]")]);
}

#[test]
fn what_functions_return_is_given_on_to_others() {
    for (text, count, height) in [
        ("LIN up(XP1)", 1, 0.01),
        ("LIN up(XP1) C_DIS", 1, 0.01),
        ("LIN over(up(XP1)) C_DIS", 1, 0.03),
        ("XP3=over(up(XP1))\nLIN XP3", 1, 0.03),
        ("CIRC over(XP2),up(XP1)", 2, 0.01),
    ] {
        let program = with_functions(text);
        assert_eq!(program.moves.len(), count, "{text}");
        let last = program.moves.last().expect("a move");
        let name = program.targets[last.target.expect("a target")]
            .name
            .as_deref();
        assert_eq!(name, Some("XP1"), "{text}");
        let along = Shift::along([0.0, 0.0, height]);
        let Displacement::By(shift) = &last.displacement else {
            panic!("{text}: {:?}", last.displacement);
        };
        let gap = shift.in_frame.separation(&along.in_frame);
        assert!(gap.distance_m < 1e-9, "{text}: {shift:?}");
    }
}

#[test]
fn relative_moves_behind_functions_that_move_start_anywhere() {
    for (call, ids) in [
        ("n=counts(1)", &[][..]),
        ("n=counts(counts(1))", &[]),
        ("n=moves(1)", &["relative-move"]),
        ("n=calls(1)", &["relative-move"]),
        ("sub(calls(1))", &["relative-move"]),
        ("n=three(1)", &["relative-move"]),
        // it does not move
        ("n=raises(XP2)", &[]),
    ] {
        let program = with_functions(&format!("LIN XP1\n{call}\nLIN_REL {{Z 10}}\n{MOVING}"));
        let mut found = reported(&program);
        found.retain(|id| *id == "relative-move");
        assert_eq!(found, ids, "{call}");
    }
}

#[test]
fn a_move_that_calls_functions_is_not_repeated() {
    for (text, may_be_repeated) in [
        ("SLIN XP1 WITH $VEL.CP=counts(1)", false),
        ("SLIN XP1 WITH $VEL=SVEL_CP(2.0, , LCPDAT1)", true),
    ] {
        let program = with_functions(text);
        let used = program.moves.last().expect("a move");
        let span = program.instructions[used.instruction as usize].target_span;
        assert_eq!(span.range().is_some(), may_be_repeated, "{text}");
    }
}

#[test]
fn relative_moves_with_angles_of_zero_go_straight() {
    for (text, along) in [
        ("LIN_REL {X 10,A 0,B 0,C 0}", Some([0.01, 0.0, 0.0])),
        (
            "LIN_REL {Z -5.0,A 0.0,B -0.0,C 0} #BASE",
            Some([0.0, 0.0, -0.005]),
        ),
        ("PTP_REL {X 0,Y 3,Z 0,A 0,B 0,C 0}", Some([0.0, 0.003, 0.0])),
        ("LIN_REL {X 10,A 1,B 0,C 0}", None),
        ("LIN_REL {X 10,A a}", None),
        ("LIN_REL {X 10,A 0,S 2}", None),
    ] {
        let program = path(&format!("LIN XP1\n{text}"));
        let moved = along.map(|by| Displacement::By(Box::new(Shift::along(by))));
        match moved {
            Some(moved) => {
                assert_eq!(reported(&program), [""; 0], "{text}");
                assert_eq!(program.moves[1].displacement, moved, "{text}");
            }
            None => assert_eq!(reported(&program), ["relative-move"], "{text}"),
        }
    }
}

#[test]
fn relative_moves_go_from_each_target_at_which_the_robot_may_stand() {
    let targets = |text: &str| {
        let program = path(text);
        assert_eq!(reported(&program), [""; 0], "{text}");
        to(&program).join(" ")
    };
    let choice = "IF $IN[1] THEN\nLIN XP1\nELSE\nLIN XP2\nENDIF\n";
    assert_eq!(
        targets(&format!("{choice}LIN_REL {{Z 100}} #BASE")),
        "XP1 XP2 XP1 XP2"
    );
    // and from there on
    let program = path(&format!("{choice}LIN_REL {{Z 100}}\nLIN_REL {{X 5}}"));
    let shift = Shift::along([0.005, 0.0, 0.1]);
    for last in &program.moves[4..] {
        assert_eq!(last.displacement, Displacement::By(Box::new(shift)));
    }
    assert_eq!(program.moves.len(), 6, "{:?}", reported(&program));
    let program = path("LIN XP1\nIF $IN[1] THEN\nLIN XP2\nENDIF\nLIN_REL {X 10} #TOOL");
    let by: Vec<_> = program.moves[2..]
        .iter()
        .map(|of| &of.displacement)
        .collect();
    let shift = Shift {
        in_tool: Pose::from_translation(0.01, 0.0, 0.0),
        ..Shift::none()
    };
    assert_eq!(by, [&Displacement::By(Box::new(shift)); 2]);
    // with another base, in a corner, in a loop
    for text in [
        "BAS(#BASE,2)\nLIN XP1\nIF $IN[1] THEN\nBAS(#BASE,3)\nENDIF\nLIN_REL {Z 10}",
        "IF $IN[1] THEN\nLIN XP1 C_DIS\nELSE\nLIN XP2\nENDIF\nLIN_REL {Z 10}",
        "LIN XP1\nLOOP\nLIN_REL {Z 10}\nENDLOOP",
    ] {
        let program = path(text);
        assert!(reported(&program).contains(&"relative-move"), "{text}");
    }
}
