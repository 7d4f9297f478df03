//! What the language reads, by behaviour.

mod asked;
mod deciding;
mod flow;
mod foreign;
mod frames;
mod loads;
mod nested;
mod posts;
mod products;
mod robust;
mod samples;
mod sensors;
mod structures;
mod turning;
mod writing;

use super::*;
use crate::finding::Severity;
use crate::geometry::Rotation;
use crate::geometry::units::DEG;
use crate::program::{Displacement, Motion, Program, Shape, Shift, Stride, Target, Tool, Value};

/// X Y Z A B C without S and T.
const POSE: Layout = Layout {
    shape: Shape::Pose,
    variant: 0,
};
/// With both.
const CONFIGURED: Layout = Layout {
    shape: Shape::Pose,
    variant: 3,
};

fn read_with(files: &[(&str, &str)], settings: &Settings) -> Result<Program, ReadError> {
    let sources: Vec<Source> = files
        .iter()
        .map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()))
        .collect();
    crate::motion::read(&Krl, &sources, settings)
}

fn read_files(files: &[(&str, &str)]) -> Program {
    read_with(files, &Settings::default()).expect("a program")
}

fn read(text: &str) -> Program {
    read_files(&[("m.src", text)])
}

/// A data list with points 1 to 3, home, and an FDAT.
const DATA: &str = "&ACCESS RVP\r\nDEFDAT M\r\n;FOLD EXTERNAL DECLARATIONS;%{PE}\r\nEXT BAS \
    (BAS_COMMAND :IN,REAL :IN )\r\n;ENDFOLD\r\n\
    DECL E6POS XP1={X 1.0,Y 2.0,Z 3.0,A 10.0,B 20.0,C 30.0,S 2,T 35,E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 \
        0.0,E6 0.0}\r\n\
    DECL FDAT FP1={TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \",TQ_STATE FALSE}\r\n\
    DECL PDAT PPDAT1={VEL 100.0,ACC 100.0,APO_DIST 100.0,APO_MODE #CPTP}\r\n\
    E6POS XP2={x 4.0,y 5.0,z 6.0,a 0.0,b 0.0,c 0.0,s 2,t 35}\r\n\
    DECL POS XP3={POS: Z 9.0,Y 8.0,X 7.0,C 0.0,B 0.0,A 0.0}\r\n\
    DECL E6AXIS XHOME={A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 0.0,A6 0.0,E1 0.0}\r\nENDDAT\r\n";

/// A module with that data list, and these statements behind tool 1 and base 2.
fn path(statements: &str) -> Program {
    let text = format!("DEF M()\nBAS(#INITMOV,0)\nBAS(#TOOL,1)\nBAS(#BASE,2)\n{statements}\nEND\n");
    read_files(&[("m.src", &text), ("m.dat", DATA)])
}

fn ids(program: &Program) -> Vec<&'static str> {
    program.findings.iter().map(|finding| finding.id).collect()
}

/// Findings that are not about targets no move goes to.
fn reported(program: &Program) -> Vec<&'static str> {
    let mut ids = ids(program);
    ids.retain(|id| *id != "target-unused-here");
    ids
}

/// Targets against which something is said.
fn blocked(program: &Program) -> Vec<&str> {
    let blocked = program.targets.iter().filter(|target| target.blocked);
    let name = |target: &'_ Target| target.name.clone().unwrap_or_else(|| "target".into());
    let said = blocked.filter(|target| {
        let subject = format!("{}: ", name(target));
        program
            .findings
            .iter()
            .any(|finding| finding.message.starts_with(&subject))
    });
    said.map(|target| target.name.as_deref().unwrap_or("-"))
        .collect()
}

fn to(program: &Program) -> Vec<&str> {
    let names = program
        .moves
        .iter()
        .map(|m| Some(program.targets[m.target?].name.as_deref().unwrap_or("-")));
    names.map(|name| name.unwrap_or("?")).collect()
}

fn values(program: &Program, target: usize) -> Vec<f64> {
    let numbers = program.numbers_of(&program.targets[target]);
    numbers.iter().map(|number| number.value).collect()
}

#[test]
fn taught_points_are_data_and_moves_use_them() {
    let program = path("PTP XHOME\nPTP xp1 C_PTP\nLIN XP2 C_DIS\nCIRC XP3,XP1 C_ORI");
    assert_eq!(to(&program), ["XHOME", "XP1", "XP2", "XP3", "XP1"]);
    let motions: Vec<_> = program.moves.iter().map(|used| used.motion).collect();
    assert_eq!(
        motions,
        [
            Motion::Joint,
            Motion::Joint,
            Motion::Linear,
            Motion::ArcVia,
            Motion::ArcEnd
        ]
    );
    let configured: Vec<_> = program.moves.iter().map(|used| used.configured).collect();
    assert_eq!(configured, [true, true, false, false, false]);
    assert_eq!(ids(&program), [""; 0]);
    assert_eq!(blocked(&program), [""; 0]);
}

/// A FRAME has neither S nor T, whatever it was copied from.
#[test]
fn the_configuration_of_a_position_counts_by_the_type_that_moves_have() {
    let frame = "{X 0,Y 0,Z 5,A 0,B 0,C 0}";
    let program = path(&format!(
        "DECL FRAME f\nDECL POS p\nf=XP1\np=XP1\nPTP XP1\nPTP f\nPTP p\nPTP {frame}:XP1\nPTP XP1:{frame}"
    ));
    let configured: Vec<_> = program.moves.iter().map(|used| used.configured).collect();
    assert_eq!(configured, [true, false, true, true, false]);
}

#[test]
fn keys_stand_in_any_case_and_order() {
    let program = path("LIN XP2\nLIN XP3\nPTP {A6 6,a5 5,A4 4,A3 3,A2 2,A1 1,E1 400}");
    let [first, second, third] = [0, 1, 2].map(|at| program.moves[at].target.unwrap());
    assert_eq!(
        values(&program, first),
        [4.0, 5.0, 6.0, 0.0, 0.0, 0.0, 2.0, 35.0]
    );
    assert_eq!(values(&program, second), [7.0, 8.0, 9.0, 0.0, 0.0, 0.0]);
    assert_eq!(values(&program, third), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(program.targets[first].layout, CONFIGURED);
    assert_eq!(program.targets[second].layout, POSE);
    assert_eq!(program.targets[third].layout.shape, Shape::Joints);
}

#[test]
fn targets_stand_in_moves_with_or_without_a_type() {
    let program = path(
        "LIN {X 18.715,Y 147.321,Z 458.168,A 0.000,B 23.131,C -180.000} C_DIS\n\
         SPTP {E6POS: X 1,Y 2,Z 3,A -180,B -0.0,C -.5,S 'B010',T 'B001010'}\n\
         SLIN {FRAME: X 1,Y 2,Z 3,A 0,B 0,C 1.5E-12}\n\
         SPTP {E6AXIS: A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 1.51745229E-12,A6 0.0,E1 0.0}",
    );
    assert_eq!(program.moves.len(), 4);
    assert_eq!(values(&program, 1)[5..], [-0.5, 2.0, 10.0]);
    assert_eq!(values(&program, 2)[5], 1.5e-12);
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn spline_blocks_are_moves_along_their_points() {
    let program = path(
        "SPLINE WITH $BASE=BASE_DATA[3]\nSPL XP1\nTIME_BLOCK START\nSLIN XP2 WITH $VEL={CP 0.5}\n\
         TIME_BLOCK PART=20\nSCIRC XP3,{X 1,Y 2,Z 3,A 0,B 0,C 0}\nTIME_BLOCK END=10\n\
         TRIGGER WHEN PATH=10 DELAY=0 DO $OUT[1]=TRUE\nENDSPLINE C_SPL\n\
         PTP_SPLINE\nSPTP XP1\nENDSPLINE\nLIN XP2",
    );
    assert_eq!(to(&program), ["XP1", "XP2", "XP3", "-", "XP1", "XP2"]);
    let frames: Vec<_> = program
        .moves
        .iter()
        .map(|used| program.frames[used.frame].name.as_str())
        .collect();
    assert_eq!(
        frames,
        [
            "BASE_DATA[3]",
            "BASE_DATA[3]",
            "BASE_DATA[3]",
            "BASE_DATA[3]",
            "BASE_DATA[2]",
            "BASE_DATA[2]"
        ]
    );
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn partial_positions_are_refused_by_name() {
    let program =
        path("LIN XP1\nLIN {Z 500} C_DIS\nLIN {X 1,Y 2,Z 3}\nLIN {X 0.0,Y 0.0,A 0.0,B 0.0,C 0.0}");
    assert_eq!(reported(&program), ["partial-target"; 3]);
    assert_eq!(blocked(&program), ["-"; 3]);
    // axes stay as they are anyway
    let program = path("PTP {A1 10.0}\nLIN XP1");
    assert_eq!(reported(&program), ["partial-target"]);
    let partial = program.findings.iter().find(|f| f.id == "partial-target");
    assert_eq!(partial.map(|f| f.severity), Some(Severity::Warning));
    // of which kind `{E1 0.0}` is nobody knows
    for (text, severity) in [
        ("PTP {E6AXIS: E1 0.0}", Severity::Warning),
        ("PTP {E1 0.0}", Severity::Error),
    ] {
        let program = path(text);
        assert_eq!(reported(&program), ["partial-target"], "{text}");
        assert_eq!(program.findings[0].severity, severity, "{text}");
    }
}

#[test]
fn expressions_are_refused() {
    let program = path(
        "LIN {X dx+1,Y 2,Z 3,A 0,B 0,C 0}\nLIN f(XP1)\nLIN XP1.X\nLIN nowhere\nPTP POS_HERE[i]",
    );
    assert_eq!(
        reported(&program),
        [
            "target-has-expressions",
            "target-copied",
            "computed-target",
            "target-not-in-files",
            "target-not-in-files",
            "target-passed-to-routine"
        ]
    );
    let errors = program
        .findings
        .iter()
        .filter(|f| f.severity == Severity::Error);
    assert_eq!(errors.count(), 5);
    assert_eq!(to(&program), ["-", "?", "?", "?", "?"]);
}

#[test]
fn moves_back_to_where_the_robot_was_are_no_targets() {
    let program = path("PTP $AXIS_ACT ; BCO\nPTP $POS_RET\nPTP $H_POS\nPTP XHOME1\nLIN XP1");
    // where the robot is it stays
    assert_eq!(to(&program), ["?", "?", "?", "XP1"]);
    assert_eq!(
        reported(&program),
        [
            "run-time-position",
            "joint-target-not-in-files",
            "joint-target-not-in-files"
        ]
    );
    assert!(
        program
            .findings
            .iter()
            .all(|f| f.severity == Severity::Note)
    );
}

#[test]
fn points_that_the_program_changes_are_refused() {
    for (change, moves, expected) in [
        (
            "XP1.X=XP1.X+10.0",
            vec!["XP1", "?", "?"],
            "target-assigned-at-run-time",
        ),
        ("xp1 = $POS_ACT", vec!["XP1", "?", "?"], "run-time-position"),
        (
            "XP1=INVERSE($AXIS_ACT,XP2,error)",
            vec!["XP1", "?", "?"],
            "target-copied",
        ),
        (
            "CREAD(handle,state,mode,time,offset,\"%r\",XP1)",
            vec!["XP1", "?", "?"],
            "computed-target",
        ),
        (
            "sensor(XP1)",
            vec!["XP1", "?", "?"],
            "target-passed-to-routine",
        ),
    ] {
        let program = path(&format!("LIN XP1\n{change}\nLIN XP1"));
        assert_eq!(to(&program), moves, "{change}");
        let blocks = expected.starts_with("target-") && expected != "target-copied";
        let expected_blocks = if blocks { vec!["XP1"] } else { vec![] };
        assert_eq!(blocked(&program), expected_blocks, "{change}");
        assert!(
            reported(&program).contains(&expected),
            "{change}: {:?}",
            program.findings
        );
    }
    // both are targets: the data list keeps what was written last
    let program = path("LIN XP1\nXP1={X 1,Y 2,Z 3,A 0,B 0,C 0}\nLIN XP1");
    assert_eq!(to(&program), ["-", "XP1", "-"]);
    assert_eq!(reported(&program), [""; 0]);
    // a comparison changes nothing
    let program = path("IF XP1.X==1.0 THEN\nLIN XP1\nENDIF\nWAIT FOR XP1.Z==2.0");
    assert_eq!(blocked(&program), [""; 0]);
}

#[test]
fn points_that_another_is_computed_from_are_displaced() {
    let program = path("DECL E6POS above\nabove=XP1\nabove.Z=above.Z+hop\nLIN above\nLIN XP1");
    assert_eq!(to(&program), ["XP1", "XP1"]);
    assert_eq!(program.moves[0].displacement, Displacement::Unknown);
    assert_eq!(program.moves[1].displacement, Displacement::None);
    let program = path("DECL E6POS above\nabove=XP1:{X 0,Y 0,Z -50,A 0,B 0,C 0}\nLIN above");
    assert!(matches!(program.moves[0].displacement, Displacement::By(_)));
}

#[test]
fn a_number_of_the_text_displaces_by_what_it_says() {
    let by = |lines: &str| {
        let program = path(&format!("DECL E6POS p\np=XP1\n{lines}\nLIN p"));
        assert_eq!(to(&program), ["XP1"], "{lines}");
        program.moves[0].displacement.clone()
    };
    let along = |by| Displacement::By(Box::new(Shift::along(by)));
    let turned =
        |degrees: f64| Displacement::Within(Box::new([Stride::Turned(Some(degrees * DEG))]));
    for (lines, wanted) in [
        ("p.Z=p.Z+200 ; up", along([0.0, 0.0, 0.2])),
        ("p.x = -50 + P.X", along([-0.05, 0.0, 0.0])),
        ("p.Z=p.Z+200\np.Y=p.Y-(10.0)", along([0.0, -0.01, 0.2])),
        ("p.Z=p.Z+hop", Displacement::Unknown),
        ("p.Z=XP1.Z+200", along([0.0, 0.0, 0.2])),
        (
            "p.X=XP1.X+10\nIF $IN[1] THEN\nENDIF\np.Z=XP1.Z-5",
            along([0.01, 0.0, -0.005]),
        ),
        ("p.Z=XP2.Z+200", Displacement::Overwritten),
        ("p.Z=hop", Displacement::Overwritten),
        ("p.A=p.A+10", turned(10.0)),
        ("p.B=p.B-2.5", turned(-2.5)),
        (
            "p.A=p.A+hop",
            Displacement::Within(Box::new([Stride::Turned(None)])),
        ),
        ("p.Z=200 ; down", Displacement::Overwritten),
        (
            "p.Z=p.Z+200\nIF $IN[1] THEN\nENDIF\np.Z=p.Z+1",
            along([0.0, 0.0, 0.201]),
        ),
    ] {
        assert_eq!(by(lines), wanted, "{lines}");
    }
    let Displacement::By(turned) = by("p.C=p.C+90") else {
        panic!("about the axis of the tool");
    };
    assert_eq!(turned.in_frame, Pose::identity());
    assert!((turned.in_tool.rotation.angle() - 90.0 * DEG).abs() < 1e-12);
    // numbers of axes are no millimetres
    let program = path("DECL E6AXIS q\nq=XHOME\nq.Z=q.Z+1\nPTP q");
    assert_eq!(program.moves[0].displacement, Displacement::Unbounded);
    // its own numbers: the controller keeps them
    let program = path("XP1.Z=XP1.Z+200\nLIN XP1");
    assert_eq!(blocked(&program), ["XP1"]);
}

#[test]
fn points_handed_to_routines_are_refused() {
    let program = path("approach(XP1, 5)\nLIN XP2");
    assert_eq!(reported(&program), ["target-passed-to-routine"]);
    assert_eq!(blocked(&program), ["XP1"]);
}

#[test]
fn arrays_have_elements_of_their_own() {
    let data = "DEFDAT M PUBLIC\nDECL GLOBAL E6POS work[2]\nwork[1]={X 1,Y 0,Z 0,A 0,B 0,C 0,S 2,T \
        2}\n\
        WORK[2]={X 2,Y 0,Z 0,A 0,B 0,C 0,S 2,T 2}\n;work[2]={X 100.0,Y 0,Z 0,A 0,B 0,C 0}\n\
        DECL POS grid[2,2]\ngrid[1,2]={X 3,Y 0,Z 0,A 0,B 0,C 0}\nENDDAT\n";
    let text = "DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN work[2]\nLIN grid[1,2]\nFOR i=1 TO \
        2\nLIN work[i]\nENDFOR\nEND\n";
    let program = read_files(&[("a/m.dat", data), ("A/M.SRC", text)]);
    assert_eq!(to(&program), ["WORK[2]", "grid[1,2]", "work[1]", "WORK[2]"]);
    assert_eq!(ids(&program), [""; 0]);
}

#[test]
fn global_points_of_another_list_are_found_and_local_ones_are_not() {
    let points = "DEFDAT POINTS PUBLIC\nDECL GLOBAL E6POS park={X 1,Y 0,Z 0,A 0,B 0,C 0}\nDECL \
        E6POS mine={X 1,Y 0,Z 0,A 0,B 0,C 0}\nENDDAT\n";
    let text = "DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN park\nLIN mine\nEND\n";
    let program = read_files(&[("points.dat", points), ("m.src", text)]);
    assert_eq!(to(&program), ["park", "?"]);
    assert_eq!(reported(&program), ["target-not-in-files"]);
}

#[test]
fn the_same_name_in_two_modules_is_two_points() {
    let module = |name: &str, x: u32| {
        (
            format!("DEF {name}()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN XP1\nEND\n"),
            format!("DEFDAT {name}\nDECL E6POS XP1={{X {x},Y 0,Z 0,A 0,B 0,C 0}}\nENDDAT\n"),
        )
    };
    let ((a, a_data), (b, b_data)) = (module("a", 1), module("b", 2));
    let files = [
        ("a.src", &*a),
        ("b.dat", &*b_data),
        ("b.src", &*b),
        ("a.dat", &*a_data),
    ];
    let program = read_files(&files);
    assert_eq!(program.moves.len(), 2);
    let x: Vec<f64> = program
        .moves
        .iter()
        .map(|used| values(&program, used.target.unwrap())[0])
        .collect();
    assert_eq!(x, [1.0, 2.0]);
}

#[test]
fn products_with_constant_frames_are_displaced_targets() {
    let statements =
        "SLIN XP1 : {X 0,Y 0,Z -50,A 0,B 0,C 0}\nLIN {X 0,Y 0,Z 100,A 0,B 0,C 0} : XP2\n";
    let program = path(statements);
    assert_eq!(to(&program), ["XP1", "XP2"]);
    let Displacement::By(first) = &program.moves[0].displacement else {
        panic!("{:?}", program.moves[0])
    };
    assert!((first.in_tool.translation[2] + 0.05).abs() < 1e-12);
    assert!(
        program.moves[1].displacement == Displacement::By(Box::new(Shift::along([0.0, 0.0, 0.1])))
    );
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn products_that_the_text_does_not_tell_are_unknown_displacements_or_errors() {
    let program =
        path("DECL FRAME off\nSLIN XP1 : off : $RECIPE.PiO\nSLIN XP1 : XP2\nSLIN off : here");
    assert_eq!(to(&program), ["XP1", "?", "?"]);
    assert!(program.moves[0].displacement == Displacement::Unknown);
    assert_eq!(reported(&program), ["target-copied", "computed-target"]);
}

#[test]
fn frames_of_the_text_displace_by_what_they_are() {
    let program = path("SLIN {X 10,Y 0,Z 0,A 90,B 0,C 0} : XP1 : {X 0,Y 0,Z 5,A 0,B 0,C 0}");
    let Displacement::By(shift) = &program.moves[0].displacement else {
        panic!("{:?}", program.moves[0].displacement);
    };
    assert!((shift.in_frame.rotation.angle() - 90.0 * DEG).abs() < 1e-12);
    let (before, behind) = (shift.in_frame.translation, shift.in_tool.translation);
    assert_eq!((before, behind), ([0.01, 0.0, 0.0], [0.0, 0.0, 0.005]));
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn relative_moves_go_from_the_target_before() {
    let program = path("LIN XP1\nLIN_REL {Z 100} #BASE\nLIN_REL {X -10}#TOOL C_DIS\nLIN XP2");
    assert_eq!(to(&program), ["XP1", "XP1", "XP1", "XP2"]);
    let by = |at: usize| match &program.moves[at].displacement {
        Displacement::By(shift) => (shift.in_frame.translation, shift.in_tool.translation),
        other => panic!("{other:?}"),
    };
    assert_eq!(by(1), ([0.0, 0.0, 0.1], [0.0; 3]));
    assert_eq!(by(2), ([0.0, 0.0, 0.1], [-0.01, 0.0, 0.0]));
    assert_eq!(reported(&program), [""; 0]);
    // both points of an arc count from where it begins
    let program = path("LIN XP1\nCIRC_REL {X 1},{X 2} C_DIS #TOOL\nLIN_REL {Y 3}");
    let by = |at: usize| match &program.moves[at].displacement {
        Displacement::By(shift) => (shift.in_frame.translation, shift.in_tool.translation),
        other => panic!("{other:?}"),
    };
    assert_eq!(by(1), ([0.0; 3], [0.001, 0.0, 0.0]));
    assert_eq!(by(2), ([0.0; 3], [0.002, 0.0, 0.0]));
    assert_eq!(by(3), ([0.0, 0.003, 0.0], [0.002, 0.0, 0.0]));
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn relative_moves_from_an_unknown_position_are_errors() {
    let rest = [
        "LIN_REL {Z 100}",
        "SLIN_REL {A 5}",
        "PTP_REL {X dx}",
        "CIRC_REL {X 1},{X 2}",
        "LIN_REL off",
    ];
    for text in rest {
        let program = path(&format!("LIN XP1\nWHILE TRUE\n{text}\nENDWHILE"));
        assert_eq!(reported(&program), ["relative-move"], "{text}");
        let found = program.findings.iter().find(|f| f.id == "relative-move");
        assert_eq!(found.map(|f| f.severity), Some(Severity::Error), "{text}");
    }
    let program = path("PTP_REL {A6 -0.001}\nLIN XP1");
    assert_eq!(reported(&program), ["relative-joint-move"]);
}

#[test]
fn points_of_accurate_robots_are_refused_unless_accepted() {
    let data = "DEFDAT M\nDECL E6POS XP1={X 1,Y 2,Z 3,A 0,B 0,C 0,S 18,T 35}\nENDDAT\n";
    let text = "DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN XP1\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0,S \
        'B10110',T 2}\nEND\n";
    let files = [("m.src", text), ("m.dat", data)];
    let program = read_files(&files);
    assert_eq!(ids(&program), ["absolutely-accurate"; 2]);
    assert_eq!(blocked(&program), ["-", "XP1"]);
    let settings = Settings {
        accept_absolutely_accurate: true,
        ..Settings::default()
    };
    let program = read_with(&files, &settings).expect("a program");
    assert_eq!(blocked(&program), [""; 0]);
    assert_eq!(ids(&program), ["absolutely-accurate"; 2]);
    assert!(
        program
            .findings
            .iter()
            .all(|f| f.severity == Severity::Warning)
    );
}

#[test]
fn data_of_other_kinds_are_no_targets() {
    let data = "DEFDAT M\nDECL LDAT LCPDAT1={VEL 2.0,ACC 100.0,APO_DIST 100.0}\nDECL FRAME \
        offset={X 1,Y 2,Z 3,A 0,B 0,C 0}\n\
        LOAD_DATA[1]={M 5.0,CM {X 0.0,Y 0.0,Z 80.0,A 0.0,B 0.0,C 0.0},J {X 0.0,Y 0.0,Z 0.0}}\n\
        DECL BOX ws={X 1.0,Y 2.0,Z 3.0,A 0.0,B 0.0,C 0.0,X1 1.0,Y1 1.0,Z1 1.0,X2 0.0,Y2 0.0,Z2 \
            0.0,MODE #INSIDE}\n\
        DECL E6POS REF_PT={X 1,Y 2,Z 3,A 0,B 0,C 0,S 2,T 2}\nENDDAT\n";
    let text = "DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\n$WORKSPACE[1]={X 1,Y 2,Z 3,A 0,B 0,C 0,X1 \
        1,Y1 1,Z1 1,X2 0,Y2 0,Z2 0,MODE #INSIDE}\n\
        ;LIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}\nEND\n";
    let program = read_files(&[("m.src", text), ("m.dat", data)]);
    assert_eq!(program.targets.len(), 2);
    assert!(program.targets[1].blocked, "REF_PT");
    assert_eq!(ids(&program), ["target-unused-here"]);
}

#[test]
fn line_ends_and_encodings_of_all_kinds_pass() {
    for end in ["\r", "\n", "\r\n"] {
        let text = [
            "\u{feff}&ACCESS RV",
            "DEF Gr\u{f6}\u{df}e()",
            "$TOOL=$NULLFRAME",
            "$BASE=$WORLD",
            "LIN {X 1,Y 2,Z 3,A 0,B 0,C 0}",
            "END",
        ];
        let program = read(&text.join(end));
        assert_eq!(program.moves.len(), 1, "{end:?}");
    }
    let latin = b"DEF m()\n;Gr\xf6\xdfe\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN {X 1,Y 2,Z 3,A 0,B \
        0,C 0}\nEND"
        .to_vec();
    let program = crate::motion::read(&Krl, &[Source::new("m.src", latin)], &Settings::default());
    assert_eq!(program.expect("a program").moves.len(), 1);
}

#[test]
fn look_alikes_are_not_recognised() {
    let shown = |text: &str| Krl.recognises(&Source::new("x", text.as_bytes().to_vec()));
    assert!(shown(DATA));
    assert!(shown("DEF m ( )\nBAS (#INITMOV,0 )\nEND\n"));
    assert!(shown("&ACCESS RVP\n"));
    assert!(shown("DEF m()\nPTP XHOME\nEND"));
    for text in [
        "",
        "MODULE m\nPROC main()\nMoveL p1,v5,z5,t;\nENDPROC\nENDMODULE",
        "/PROG A\n/ATTR\n/MN\n 1:J P[1] 100% FINE ;\n/POS\n/END\n",
        "def main():\n  movel(p[0,0,0,0,0,0])\nend\n",
        "def f(x):\n    return x\n",
        "/JOB\n//NAME A\n//POS\n",
        "2021-03-04 10:00 DEF error in LIN axis\n",
        "TOOLPNO,X,Y,Z\n1,2,3\n",
        "int main(void) { return 0; }\n",
        "\0\u{1}&ACCESS",
    ] {
        assert!(!shown(text), "{text}");
    }
}

#[test]
fn long_lines_are_reported() {
    let program = path(&format!(
        "LIN {{X 1,Y 2,Z 3,A 0,B 0,C 0}} C_DIS ;{}",
        "x".repeat(430)
    ));
    assert_eq!(reported(&program), ["long-line"]);
}

#[test]
fn arcs_on_which_the_tool_turns_with_the_path_are_refused() {
    for (before, with, is_refused) in [
        ("", "", false),
        ("$CIRC_TYPE=#PATH\n", "", true),
        (
            "$CIRC_TYPE=#PATH\nBAS(#INITMOV,0)\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\n",
            "",
            false,
        ),
        ("$CIRC_TYPE=#PATH\n$CIRC_TYPE=#BASE\n", "", false),
        ("$CIRC_MODE.AUX_PT.ORI=#CONSIDER\n", "", false),
        ("$CIRC_MODE.AUX_PT.ORI=#INTERPOLATE\n", "", true),
        ("$CIRC_MODE.TARGET_PT.ORI=#INTERPOLATE\n", "", false),
        ("$CIRC_MODE.TARGET_PT.ORI=#EXTRAPOLATE\n", "", true),
        ("", " WITH $CIRC_TYPE=#PATH", true),
        ("$CIRC_TYPE=#PATH\n", " WITH $CIRC_TYPE=#BASE", false),
    ] {
        let program = path(&format!("{before}LIN XP1\nSCIRC XP2,XP3{with}"));
        let refused: &[&str] = if is_refused {
            &["move-not-supported"]
        } else {
            &[]
        };
        let mut all = reported(&program);
        all.dedup();
        assert_eq!(all, refused, "{before}{with}");
    }
}

#[test]
fn a_routine_of_all_is_krl_by_its_first_line() {
    let text = "GLOBAL DEF move_up()\nPTP XHOME\nEND\n";
    let source = Source::new("move_up.src", text.into());
    assert!(crate::program::language_of(&source).is_some());
}
