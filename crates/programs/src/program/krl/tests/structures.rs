//! Positions in structures, of other data lists, and that functions return.

use super::*;

const TYPES: &str = "DEFDAT $CONFIG\nGLOBAL STRUC part E6POS P,Q,INT n\nSTRUC pallet part first,REAL \
    x\nENDDAT\n";
const POINTS: &str = "DEFDAT M\nDECL part s={P {X 1,Y 0,Z 0,A 0,B 0,C 0},Q {X 2,Y 0,Z 0,A 0,B 0,C \
    0},n 3}\n\
    DECL part many[2]\nmany[1]={P {X 3,Y 0,Z 0,A 0,B 0,C 0},n 1}\nmany[2]={P {X 4,Y 0,Z 0,A 0,B 0,C \
    0},n 1}\n\
    DECL pallet p={first {P {X 5,Y 0,Z 0,A 0,B 0,C 0},n 1},x 2.0}\n\
    DECL E6POS XP1={X 6,Y 0,Z 0,A 0,B 0,C 0}\nENDDAT\n";

fn with_types(statements: &str, behind: &str) -> Program {
    let text = format!("DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\n{statements}\nEND\n{behind}");
    read_files(&[("m.src", &text), ("m.dat", POINTS), ("$config.dat", TYPES)])
}

fn first_numbers(program: &Program) -> Vec<Option<f64>> {
    let moves = program.moves.iter();
    moves
        .map(|motion| Some(values(program, motion.target?)[0]))
        .collect()
}

#[test]
fn members_of_structures_are_positions() {
    let program = with_types("LIN s.P\nLIN S.q\nPTP many[2].P\nLIN p.first.P", "");
    assert_eq!(to(&program), ["s.P", "s.Q", "many[2].P", "p.first.P"]);
    let all = [1.0, 2.0, 4.0, 5.0].map(Some);
    assert_eq!(first_numbers(&program), all);
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn members_are_written_one_by_one() {
    let program = with_types(
        "s.P=XP1\nLIN s.P\nLIN s.Q\nmany[1].P=s.Q\nLIN many[1].P",
        "",
    );
    assert_eq!(to(&program), ["XP1", "s.Q", "s.Q"]);
    let program = with_types("s.P.Z=s.P.Z+10\nLIN s.P\nLIN s.Q", "");
    assert_eq!(blocked(&program), ["s.P"]);
    assert_eq!(to(&program), ["?", "s.Q"]);
    // what is in one is not in another
    let program = with_types("FOR i=1 TO 2\nLIN many[i].P\nENDFOR", "");
    assert_eq!(first_numbers(&program), [Some(3.0), Some(4.0)]);
}

#[test]
fn structures_are_written_given_and_returned_as_a_whole() {
    let routines = "DEF fill(a:OUT)\nDECL part a\na.P=XP1\nEND\n\
        DEFFCT part make(a:IN)\nDECL E6POS a\nDECL part t\nt.P=a:{X 0,Y 0,Z 10,A 0,B 0,C 0}\nRETURN t\nENDFCT\n";
    let go = "DEF go(a:IN)\nDECL part a\nLIN a.Q\nEND\n";
    for (text, wanted) in [
        ("s=many[1]", "many[1].P"),
        ("s = MANY[2] ; all of it", "many[2].P"),
        ("fill(s)", "XP1"),
        ("p.first=many[2]\ns=p.first", "many[2].P"),
        ("s=make(XP1)", "XP1"),
    ] {
        let program = with_types(&format!("{text}\nLIN s.P"), routines);
        assert_eq!(to(&program), [wanted], "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
    let program = with_types("s=make(XP1)\nLIN s.P", routines);
    let Displacement::By(shift) = &program.moves[0].displacement else {
        panic!("{:?}", program.moves[0]);
    };
    assert_eq!(shift.in_tool.translation, [0.0, 0.0, 0.01]);
    let program = with_types("s.Q=XP1\ngo(s)\nLIN XP1", go);
    let mut all = to(&program);
    all.sort_unstable();
    assert_eq!(all, ["XP1", "XP1"]);
    // what routines that are not here, and the controller, write into one
    for text in [
        "other(s)",
        "CREAD(h,stat,mode,time,off,\"%r\",s)",
        "s=other(XP1)",
        "p.first=s\ns=p.first",
    ] {
        let program = with_types(&format!("s.P=XP1\n{text}\nLIN s.P"), routines);
        if text.starts_with("p.first") {
            assert_eq!(to(&program), ["XP1"], "{text}");
        } else {
            assert_eq!(to(&program), ["?"], "{text}");
            assert!(reported(&program).contains(&"computed-target"), "{text}");
        }
    }
    let program = with_types("p=p\nLIN p.first.P\nLIN s.P", routines);
    assert_eq!(to(&program), ["?", "s.P"]);
}

#[test]
fn one_member_is_handed_to_a_routine() {
    let above = "DEF above(a:IN)\nDECL E6POS a\nLIN a\nEND\n";
    let program = with_types("above(s.P)\nLIN s.Q", above);
    let mut all = to(&program);
    all.sort_unstable();
    assert_eq!(all, ["s.P", "s.Q"]);
    assert_eq!(reported(&program), [""; 0]);
    let lift = "DEF lift(a:OUT)\nDECL E6POS a\na={X 9,Y 0,Z 0,A 0,B 0,C 0}\nEND\n";
    let program = with_types("lift(s.P)\nLIN s.P\nLIN s.Q", lift);
    assert_eq!(first_numbers(&program), [Some(9.0), Some(2.0)]);
}

#[test]
fn types_that_files_declare_differently_are_none() {
    let text = "DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN s.P\nEND\n";
    let other = "DEFDAT N\nSTRUC part FRAME P\nENDDAT\n";
    let files = [
        ("m.src", text),
        ("m.dat", POINTS),
        ("$config.dat", TYPES),
        ("n.dat", other),
    ];
    let program = read_files(&files);
    assert_eq!(reported(&program), ["computed-target"]);
}

#[test]
fn functions_return_positions() {
    let pick = "DEFFCT E6POS pick(i:IN)\nINT i\nIF i>1 THEN\nRETURN s.Q\nELSE\nRETURN XP1\nENDIF\nENDFCT\n\
        DEFFCT E6POS up(a:IN)\nDECL E6POS a\nRETURN a:{X 0,Y 0,Z 10,A 0,B 0,C 0}\nENDFCT\n";
    let program = with_types("LIN pick(1)\nLIN up(s.P)", pick);
    assert_eq!(to(&program), ["s.Q", "XP1", "s.P"]);
    let Displacement::By(shift) = &program.moves[2].displacement else {
        panic!("{:?}", program.moves[2]);
    };
    assert_eq!(shift.in_tool.translation, [0.0, 0.0, 0.01]);
    assert_eq!(reported(&program), [""; 0]);
    // each call returns its own
    let program = with_types("CIRC up(s.P),up(s.Q)\nXP1=up(s.Q)\nLIN XP1", pick);
    assert_eq!(to(&program), ["s.P", "s.Q", "s.Q"]);
    // what the one inside returns is given to the other
    let program = with_types("LIN up(up(s.P))", pick);
    assert_eq!(to(&program), ["s.P"]);
    // which of its calls that was is not followed: it may add any times
    let displacement = &program.moves[0].displacement;
    assert!(
        matches!(displacement, Displacement::Within(_)),
        "{displacement:?}"
    );
}

#[test]
fn a_function_in_a_move_may_write_what_it_is_given() {
    let take = "DEFFCT E6POS take(a:OUT)\nDECL E6POS a\na={X 9,Y 0,Z 0,A 0,B 0,C 0}\nRETURN \
        a\nENDFCT\n";
    let program = with_types("LIN take(XP1)\nLIN XP1", take);
    assert_eq!(first_numbers(&program), [Some(9.0), Some(9.0)]);
}

#[test]
fn imported_data_are_those_of_the_other_list() {
    let data = "DEFDAT M\nIMPORT E6POS near IS /R1/PTS..XP7\nIMPORT FRAME work IS \
        /R1/PTS..f1\nIMPORT E6POS gone IS /R1/OTHER..XP1\nENDDAT\n";
    let points = "DEFDAT PTS PUBLIC\nDECL E6POS XP7={X 7,Y 0,Z 0,A 0,B 0,C 0}\nDECL FRAME F1={X \
        500,Y 0,Z 0,A 0,B 0,C 0}\nENDDAT\n";
    let read = |statements: &str| {
        let text = format!("DEF M()\n$TOOL=$NULLFRAME\n$BASE=work\n{statements}\nEND\n");
        read_files(&[("m.src", &text), ("m.dat", data), ("R1/pts.dat", points)])
    };
    let program = read("LIN near");
    assert_eq!(to(&program), ["XP7"]);
    let base = program.frames[program.moves[0].frame].world_from_frame;
    assert_eq!(base.expect("a base").translation, [0.5, 0.0, 0.0]);
    assert_eq!(reported(&program), [""; 0]);
    let program = read("near.X=near.X+1\nLIN near");
    assert_eq!(blocked(&program), ["XP7"]);
    assert_eq!(reported(&read("LIN gone")), ["target-not-in-files"]);
}
