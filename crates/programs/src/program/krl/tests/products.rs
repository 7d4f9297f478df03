//! Tools and bases that are products of frames, copies of others, or chosen by FDAT.

use super::*;

const CONFIG: &str = "DEFDAT $CONFIG\n\
    TOOL_DATA[1]={X 100,Y 0,Z 0,A 0,B 0,C 90}\nTOOL_DATA[2]={X 0,Y 0,Z 50,A 0,B 0,C 0}\n\
    BASE_DATA[1]={X 500,Y 0,Z 0,A 90,B 0,C 0}\nBASE_DATA[2]={X 0,Y 200,Z 0,A 0,B 0,C 0}\nENDDAT\n";
const FRAMES: &str = "DEFDAT M\nDECL FRAME F={X 10,Y 0,Z 0,A 0,B 0,C 0}\nDECL FRAME BF\n\
    DECL E6POS XP1={X 1,Y 0,Z 0,A 0,B 0,C 0}\n\
    DECL FDAT FP1={TOOL_NO 1,BASE_NO 1,IPO_FRAME #BASE}\n\
    DECL FDAT FP2={TOOL_NO 2,BASE_NO 2,IPO_FRAME #BASE}\nENDDAT\n";

fn with(statements: &str, settings: &Settings) -> Program {
    let text = format!("DEF M()\n$TOOL=TOOL_DATA[1]\n$BASE=BASE_DATA[1]\n{statements}\nEND\n");
    let files = [
        ("m.src", &*text),
        ("m.dat", FRAMES),
        ("$config.dat", CONFIG),
    ];
    read_with(&files, settings).expect("a program")
}

/// The tool and the base of the last move, in mm.
fn places(program: &Program) -> [[i64; 3]; 2] {
    let last = program.moves.last().expect("a move");
    let tool = program.tools[last.tool].flange_from_tool;
    let base = program.frames[last.frame].world_from_frame;
    // hundredths of a millimetre are enough
    #[allow(clippy::cast_possible_truncation)]
    [tool, base].map(|pose| {
        pose.expect("a pose")
            .translation
            .map(|m| (m * 1e3).round() as i64)
    })
}

const TOOL: [i64; 3] = [100, 0, 0];
const BASE: [i64; 3] = [500, 0, 0];

#[test]
fn products_of_frames_that_nothing_changes_are_tools_and_bases() {
    for (text, tool, base) in [
        // the base turns its own x into the world's y
        ("$BASE=BASE_DATA[1]:F", TOOL, [500, 10, 0]),
        ("$BASE=$WORLD:BASE_DATA[2]", TOOL, [0, 200, 0]),
        ("$BASE=F:F:BASE_DATA[2]", TOOL, [20, 200, 0]),
        // z of the second tool is -y of the first
        ("$TOOL=TOOL_DATA[1]:TOOL_DATA[2]", [100, -50, 0], BASE),
        (
            "$TOOL=TOOL_DATA[2]:{X 1,Y 0,Z 0,A 0,B 0,C 0}",
            [1, 0, 50],
            BASE,
        ),
        (
            "BASE_DATA[3]=BASE_DATA[0]:F\n$BASE=BASE_DATA[3]",
            TOOL,
            [10, 0, 0],
        ),
        // what the program has just assigned
        (
            "BF={X 0,Y 0,Z 25,A 0,B 0,C 0}\n$BASE=BASE_DATA[1]:BF",
            TOOL,
            [500, 0, 25],
        ),
        (
            "BF={X 1,Y 0,Z 0,A 0,B 0,C 0}\n$BASE=BASE_DATA[1]:BF\nBF={X 2,Y 0,Z 0,A 0,B 0,C 0}\n$BASE=$BASE:BF",
            TOOL,
            [500, 3, 0],
        ),
        ("$BASE=$BASE:F", TOOL, [500, 10, 0]),
        ("$TOOL=$TOOL:{X 1,Y 2,Z 3,A 0,B 0,C 0}", [101, -3, 2], BASE),
        ("BASE_DATA[1].X=5\n$BASE=BASE_DATA[1]:F", TOOL, [5, 10, 0]),
        (
            "IF $IN[1] THEN\nBF=BASE_DATA[2]\nELSE\nBF=BASE_DATA[2]\nENDIF\n$BASE=BF:F",
            TOOL,
            [10, 200, 0],
        ),
    ] {
        let program = with(&format!("{text}\nLIN XP1"), &Settings::default());
        assert_eq!(places(&program), [tool, base], "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
    for text in [
        "WHILE $IN[1]\n$BASE=$BASE:F\nENDWHILE",
        "FOR n=1 TO 3\n$BASE=$BASE:F\nENDFOR",
        "$BASE=BASE_DATA[n]:F",
        "$BASE=BASE_DATA[7]:F",
        "$BASE=BASE_DATA[1]:BF",
        "BF={X 1,Y 0,Z n,A 0,B 0,C 0}\n$BASE=BASE_DATA[1]:BF",
        "$BASE=BASE_DATA[1]:$POS_ACT",
        "vision(BASE_DATA[1])\n$BASE=BASE_DATA[1]:F",
        "F.X=F.X+1\n$BASE=BASE_DATA[1]:F",
    ] {
        let program = with(&format!("{text}\nLIN XP1"), &Settings::default());
        assert_eq!(blocked(&program), ["XP1"], "{text}");
    }
    // what the program may have written is one of two
    let program = with(
        "BASE_DATA[n]=F\n$BASE=BASE_DATA[1]:F\nLIN XP1",
        &Settings::default(),
    );
    let mut all = program.moves.iter().map(|motion| {
        let base = program.frames[motion.frame].world_from_frame;
        base.expect("it is known")
            .translation
            .map(|m| (1e3 * m).round())
    });
    assert!(all.clone().any(|base| base == [500.0, 10.0, 0.0]));
    assert!(all.any(|base| base == [20.0, 0.0, 0.0]));
}

#[test]
fn a_base_is_the_robots_own_where_the_profile_says_where_it_stands() {
    let settings = Settings {
        world_from_base: Some(Pose::from_translation(0.0, 0.0, 0.4)),
        ..Settings::default()
    };
    for (text, base) in [
        ("$BASE=$ROBROOT", [0, 0, 400]),
        ("$BASE=$ROBROOT:F", [10, 0, 400]),
    ] {
        let program = with(&format!("{text}\nLIN XP1"), &settings);
        assert_eq!(places(&program), [TOOL, base], "{text}");
        // on a track it stands wherever that is
        let program = with(&format!("{text}\nLIN XP1"), &Settings::default());
        assert_eq!(blocked(&program), ["XP1"], "{text}");
    }
}

#[test]
fn frames_become_tools_and_bases_and_are_written_part_by_part() {
    for (text, base) in [
        ("BF=BASE_DATA[2]", [0, 200, 0]),
        ("BF=BASE_DATA[2]\nBF.Z=120", [0, 200, 120]),
        ("BF=$BASE\nBF.X=1\nBF.Y=2", [1, 2, 0]),
        ("BF=$BASE\n$BASE=BASE_DATA[2]", [500, 0, 0]),
        ("BF=$NULLFRAME", [0, 0, 0]),
    ] {
        let program = with(&format!("{text}\n$BASE=BF\nLIN XP1"), &Settings::default());
        assert_eq!(places(&program), [TOOL, base], "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
    for text in [
        "BF=BASE_DATA[2]\nBF.Z=n",
        "BF=BASE_DATA[2]\nBF.Z=BF.Z+1",
        "BF=$POS_ACT\nBF.Z=1",
    ] {
        let program = with(&format!("{text}\n$BASE=BF\nLIN XP1"), &Settings::default());
        assert_eq!(blocked(&program), ["XP1"], "{text}");
    }
    // where the robot was, with another number in it
    let program = with("BF=$POS_ACT\nBF.Z=1\nLIN BF", &Settings::default());
    assert_eq!(reported(&program), ["computed-target"]);
}

#[test]
fn a_frame_that_displaces_is_no_target() {
    let program = with("LIN XP1:F", &Settings::default());
    assert_eq!(reported(&program), [""; 0]);
    // with other numbers it would displace by them
    for text in ["LIN F\nLIN XP1:F", "LIN F\n$BASE=BASE_DATA[1]:F\nLIN XP1"] {
        let program = with(text, &Settings::default());
        assert_eq!(blocked(&program), ["F"], "{text}");
        assert_eq!(reported(&program), ["target-used-as-frame"], "{text}");
    }
}

#[test]
fn positions_that_are_offsets_displace_others() {
    let by = |data: &str, point: &str| {
        let text = format!("DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN XP1\nLIN {point}\nEND\n");
        let data = format!("DEFDAT M\nDECL POS XP1={{X 1,Y 0,Z 0,A 0,B 90,C 0}}\n{data}\nENDDAT\n");
        read_files(&[("m.src", &text), ("m.dat", &data)])
    };
    let (off, turned) = (
        "={X 0,Y 0,Z 50,A 0,B 0,C 0}",
        Pose::from_translation(0.0, 0.0, 0.05),
    );
    let (frame, tool) = (
        Shift::along([0.0, 0.0, 0.05]),
        Shift {
            in_tool: turned,
            ..Shift::none()
        },
    );
    for (kind, point, shift) in [
        ("FRAME", "off:XP1", frame),
        ("CONST POS", "off:XP1", frame),
        ("CONST POS", "XP1:off", tool),
        ("CONST E6POS", "off:XP1", frame),
    ] {
        let program = by(&format!("DECL {kind} off{off}"), point);
        let last = program.moves.last().expect("a move");
        let name = program.targets[last.target.expect("known")].name.clone();
        assert_eq!(name.as_deref(), Some("XP1"), "{kind} {point}");
        assert_eq!(
            last.displacement,
            Displacement::By(Box::new(shift)),
            "{kind} {point}"
        );
        assert_eq!(reported(&program), [""; 0], "{kind} {point}");
    }
    // one that moves go to would displace by other numbers
    let program = by(&format!("DECL CONST POS off{off}"), "off\nLIN off:XP1");
    assert_eq!(reported(&program), ["target-used-as-frame"]);
    // and of two that may be taught either may be one
    let program = by(&format!("DECL POS off{off}"), "off:XP1");
    assert_eq!(reported(&program), ["target-copied"]);
}

#[test]
fn fdat_are_written_as_a_whole() {
    for (text, tool, base) in [
        ("FW=FP1", TOOL, BASE),
        ("FW=FP1\nFW.BASE_NO=2", TOOL, [0, 200, 0]),
        (
            "FW={TOOL_NO 2,BASE_NO 1,IPO_FRAME #BASE}\nFW.BASE_NO=2",
            [0, 0, 50],
            [0, 200, 0],
        ),
        ("FP1=FP2\nFW=FP1", [0, 0, 50], [0, 200, 0]),
        ("FDAT_ACT=FP1\nFW=FDAT_ACT\nFDAT_ACT=FP2", TOOL, BASE),
    ] {
        let text = format!("DECL FDAT FW\n{text}\nFDAT_ACT=FW\nBAS(#FRAMES)\nLIN XP1");
        let program = with(&text, &Settings::default());
        assert_eq!(places(&program), [tool, base], "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
    for text in ["FW=chosen(1)", "FW=FP1\nfill(FW)"] {
        let text = format!("DECL FDAT FW\n{text}\nFDAT_ACT=FW\nBAS(#FRAMES)\nLIN XP1");
        let program = with(&text, &Settings::default());
        assert_eq!(blocked(&program), ["XP1"], "{text}");
    }
}

#[test]
fn fdat_are_written_part_by_part() {
    let go = "FDAT_ACT=FP1\nBAS(#PTP_PARAMS,100)\nLIN XP1";
    for (text, tool, base) in [
        ("", TOOL, BASE),
        ("FP1.BASE_NO=2", TOOL, [0, 200, 0]),
        ("FP1.TOOL_NO=FP2.TOOL_NO", [0, 0, 50], BASE),
        ("FP1.BASE_NO=2\nFP1.BASE_NO=1", TOOL, BASE),
        ("FP1.TQ_STATE=TRUE", TOOL, BASE),
    ] {
        let program = with(&format!("{text}\n{go}"), &Settings::default());
        assert_eq!(places(&program), [tool, base], "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
    for text in [
        "FP1=chosen()",
        "FP1.BASE_NO=n",
        "other(FP1)",
        "FP1.BASE_NO=2\nother(FP1)",
        "set(FP1.BASE_NO)",
        "EKI_GETINT(a,b,FP1.TOOL_NO)",
    ] {
        let program = with(&format!("{text}\n{go}"), &Settings::default());
        assert_eq!(blocked(&program), ["XP1"], "{text}");
    }
    let program = with(
        "FP1.IPO_FRAME=#TCP\nFDAT_ACT=FP1\nBAS(#FRAMES)\nLIN XP1",
        &Settings::default(),
    );
    assert_eq!(reported(&program), ["held-work-piece"]);
}
