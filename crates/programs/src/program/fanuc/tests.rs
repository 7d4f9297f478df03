//! What the language reads, by behaviour.

mod asked;
mod compensated;
mod deciding;
mod flow;
mod indices;
mod offsets;
mod posts;
mod registers;
mod robust;

use super::*;
use crate::finding::Severity;
use crate::geometry::units::{DEG, mm_from_m};
use crate::program::number::{Fraction, Style};
use crate::program::{Displacement, ExternalNames, Motion, Program, Shape, Shift, Stride, Value};

const POSE: Layout = Layout {
    shape: Shape::Pose,
    variant: 0,
};

/// A point as controllers write it.
fn pose(number: &str, head: &str) -> String {
    format!(
        "P[{number}]{{\n   GP1:\n\t{head}\n\tX =  1922.978  mm,\tY =  -163.122  mm,\tZ =   \
         -54.328  mm,\n\tW =  -179.532 deg,\tP =      .193 deg,\tR =     -.287 deg\n}};\n"
    )
}

fn usual(number: &str) -> String {
    pose(number, "UF : 2, UT : 1,\t\tCONFIG : 'N U T, 0, 0, -1',")
}

fn joints(number: &str) -> String {
    format!(
        "P[{number}]{{\n   GP1:\n\tUF : 2, UT : 1,\t\n\tJ1=   -41.180 deg,\tJ2=     1.000 \
         deg,\tJ3=     2.000 deg,\n\tJ4=     3.000 deg,\tJ5=     4.000 deg,\tJ6=      .500 \
         deg\n}};\n"
    )
}

fn listing(lines: &str, points: &str) -> String {
    format!("/PROG  TEST\n/ATTR\nLINE_COUNT = 1;\n/MN\n{lines}\n/POS\n{points}/END\n")
}

fn read_files(files: &[(&str, &str)]) -> Result<Program, ReadError> {
    read_with(files, &Settings::default())
}

fn read_with(files: &[(&str, &str)], settings: &Settings) -> Result<Program, ReadError> {
    let sources: Vec<Source> = files
        .iter()
        .map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()))
        .collect();
    crate::motion::read(&Fanuc, &sources, settings)
}

fn read(lines: &str, points: &str) -> Program {
    read_files(&[("a.ls", &listing(lines, points))]).expect("a program")
}

fn ids(program: &Program) -> Vec<&'static str> {
    program.findings.iter().map(|finding| finding.id).collect()
}

fn blocked(program: &Program) -> Vec<&str> {
    let blocked = program.targets.iter().filter(|target| target.blocked);
    blocked
        .map(|target| target.name.as_deref().unwrap_or("-"))
        .collect()
}

fn values(program: &Program, target: usize) -> Vec<f64> {
    let numbers = program.numbers_of(&program.targets[target]);
    numbers.iter().map(|number| number.value).collect()
}

/// A program whose point stands on a rail that the profile lists.
fn on_a_rail(lines: &str) -> Program {
    let rail = usual("1").replace("-.287 deg", "-.287 deg,\n\tE1=  -345.000  mm");
    let settings = Settings {
        external: ExternalNames {
            listed: vec!["E1".into()],
            linear: vec![true],
            ..ExternalNames::default()
        },
        ..Settings::default()
    };
    let files = [("a.ls", &*listing(lines, &rail))];
    read_with(&files, &settings).expect("a program")
}

#[test]
fn a_point_has_six_coordinates_flags_and_turns() {
    let program = read("1:J P[1] 100% FINE ;", &usual("1"));
    let wanted = [
        1922.978, -163.122, -54.328, -179.532, 0.193, -0.287, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0,
    ];
    assert_eq!(values(&program, 0), wanted);
    assert_eq!(program.targets[0].layout, POSE);
    let used = &program.moves[0];
    let names = (
        &*program.tools[used.tool].name,
        &*program.frames[used.frame].name,
    );
    assert_eq!((used.motion, names), (Motion::Joint, ("1", "2")));
    assert_eq!(program.tools[used.tool].flange_from_tool, None);
    assert!(used.configured && used.displacement == Displacement::None);
    assert_eq!(program.findings, []);
}

#[test]
fn points_have_names_of_any_kind() {
    for (number, line) in [
        ("2:\"Prise cloueur\"", "P[2:Prise cloueur]"),
        ("2:\"a/b: c]\"", "P[2:x]"),
        ("2:\"\"", "P[2]"),
        ("2 : \"x\"", "P[2]"),
        ("2:plain", "P[2]"),
        ("2:\"}{;'\"", "P[2]"),
    ] {
        let program = read(&format!("1:L {line} 9mm/sec FINE ;"), &usual(number));
        assert_eq!(program.moves.len(), 1, "{number}");
        assert_eq!(program.targets[0].name.as_deref(), Some("P[2]"));
    }
}

#[test]
fn joint_points_are_six_angles() {
    let program = read("1:J P[3] 100% FINE ;", &joints("3"));
    assert_eq!(
        values(&program, 0),
        [-41.18, 1.0, 2.0, 3.0, 4.0, 0.5],
        "degrees"
    );
    assert_eq!(program.targets[0].layout.shape, Shape::Joints);
    assert_eq!(program.findings, []);
}

#[test]
fn other_groups_are_left_alone() {
    let groups = usual("1").replace(
        "\n};",
        "\n   GP2:\n\tUF : 0, UT : 7,\t\n\tJ1=   300.000  mm\n   GP3:\n\tUF : F, UT : 1,\n\tJ1= \
         ********  mm\n};",
    );
    let alone = "P[2]{\n   GP2:\n\tUF : 0, UT : 1,\n\tJ1=     1.000 deg,\tJ2=     2.000 deg\n};\n";
    let program = read(
        "1:J P[1] 100% FINE ;\n2:J P[2] 100% FINE ;",
        &(groups + alone),
    );
    assert_eq!(values(&program, 0).len(), 12);
    // a point of another group is no target
    assert_eq!((program.moves.len(), program.targets.len()), (1, 1));
    assert_eq!(program.tools[0].name, "1");
    assert_eq!(ids(&program), ["other-group"]);
}

#[test]
fn a_point_of_two_robots_is_reported_once() {
    let both = |number: &str| {
        let other = usual("9").replace("GP1", "GP2");
        let other = &other["P[9]{\n".len()..];
        usual(number).replace("};\n", "") + other
    };
    let points = both("1") + &both("2");
    let program = read("1:J P[1] 100% FINE ;\n2:J P[2] 100% FINE ;", &points);
    assert_eq!((program.moves.len(), program.targets.len()), (2, 2));
    assert_eq!(ids(&program), ["other-group"]);
    assert!(program.findings[0].message.contains("another robot"));
}

#[test]
fn files_that_show_different_frames_are_named() {
    let shown = |z: f64| {
        let tool = format!(
            "[*SYSTEM*]$MNUTOOL  Storage: CMOS  Access: RW  : ARRAY[1,2] OF POSITION\n  [1,1] = \n  \
             X: 0.000 Y: 0.000 Z: {z:.3}\n  W: 0.000 P: 0.000 R: 0.000\n  [1,2] = \n  X: 0.000 Y: \
             0.000 Z: 9.000\n  W: 0.000 P: 0.000 R: 0.000\n"
        );
        let frame = tool
            .replace("TOOL", "FRAME")
            .replace(&format!("{z:.3}"), "1.000");
        tool + &frame
    };
    let text = listing("1:J P[1] 100% FINE ;", &usual("1"));
    let with = |other: f64| {
        let all = [
            ("r1/s.va", &*shown(150.0)),
            ("r2/s.va", &*shown(other)),
            ("a.ls", &*text),
        ];
        read_files(&all).expect("a program")
    };
    assert_eq!(with(150.0).findings, []);
    let program = with(150.1);
    assert_eq!(blocked(&program), ["P[1]"]);
    assert_eq!(ids(&program), ["frame-name-ambiguous"]);
    let message = &program.findings[0].message;
    for what in ["UTOOL[1]", "r1/s.va", "r2/s.va"] {
        assert!(message.contains(what), "{message}");
    }
}

#[test]
fn german_listings_are_read_like_others() {
    let text = b"/PROG  UP1\n/EIGN.\nKOMMENTAR\t= \"Gr\xf6\xdfe\";\nPROG_GR\xd6\xdfE = \
        1;\n/APPL\n/MN\n   1:  BENUTZER_NUM=0 ;\n   2:  WKZ_NUM=24 ;\n   3:J P[1] 100% CNT0 ACC100 \
        ZEIT VOR    .10sek,P-SPS    ;\n      1:  FB-PSPS (AN) ;\n       ------ ;\n   4:J P[1] 100% \
        FEIN WKZ_Offset,PR[1] ;\n/POS\nP[1]{\n   GP1:\n\tUF : 0, UT : 24,\t\tKONFIG : 'F D B, 0, \
        1, 0',\n\tX =   -46.468  mm,\tY =  -827.851  mm,\tZ =  1594.398  mm,\n\tW =   165.784 \
        deg,\tP =    10.653 deg,\tR =    -4.457 deg\n};\n/END\n";
    let source = Source::new("up1.ls", text.to_vec());
    assert!(Fanuc.recognises(&source));
    let program = crate::motion::read(&Fanuc, &[source], &Settings::default()).expect("read");
    assert_eq!(values(&program, 0)[6..], [1.0, 1.0, 1.0, 0.0, 1.0, 0.0]);
    let displaced: Vec<bool> = program
        .moves
        .iter()
        .map(|m| m.displacement == Displacement::Unknown)
        .collect();
    assert_eq!(displaced, [false, true]);
    assert_eq!(program.findings, []);
}

#[test]
fn a_point_without_configuration_data_has_six_numbers() {
    for head in ["UF : 0, UT : 1,\t\tCONFIG : '',", "UF : 0, UT : 1,"] {
        let program = read("1:J P[1] 100% FINE ;", &pose("1", head));
        assert_eq!(program.targets[0].layout.variant, 1);
        assert_eq!(values(&program, 0).len(), 6);
        assert!(blocked(&program).is_empty());
    }
}

#[test]
fn free_layouts_of_post_processors_are_read() {
    let point = "P[1]{\n        GP1:\n        UF : 1, UT : 1,        CONFIG: 'N U T, 0, 0, \
        0',\n        X = 1348.2 mm,\tY =\t1E1\tmm, Z=-.5mm,\n        W = 90.0 deg, P = -90 deg, R \
        = +0.0 deg\n}\n";
    let program = read("L P[1] 100mm/sec FINE;", point);
    assert_eq!(
        values(&program, 0)[..6],
        [1348.2, 10.0, -0.5, 90.0, -90.0, 0.0]
    );
    assert_eq!(program.findings, []);
}

#[test]
fn fields_keep_their_last_column_and_the_leading_zero_style() {
    let text = listing("1:J P[1] 100% FINE ;", &usual("1"));
    let program = read_files(&[("a.ls", &text)]).expect("a program");
    let numbers = program.numbers_of(&program.targets[0]);
    let field = |k: usize| {
        let number = &numbers[k];
        let start = number.start as usize;
        &text.as_bytes()[start..start + usize::from(number.length)]
    };
    let style = Style::of_group((3..6).map(field), 0, Fraction::Bare);
    let written = |k: usize, value: f64| {
        let mut out = Vec::new();
        style.write(field(k), value, &mut out);
        String::from_utf8(out).expect("ASCII")
    };
    assert_eq!(field(0), b"  1922.978");
    assert_eq!(written(0, -9.9996), "   -10.000");
    assert_eq!(written(4, -0.19), "     -.190");
    assert_eq!(written(5, 0.0), "     0.000");
    assert_eq!(written(3, 180.0), "   180.000");
    // a field of tabs has no width to keep
    let tabs = text.replace("X =  1922.978", "X =\t1922.978");
    let program = read_files(&[("a.ls", &tabs)]).expect("a program");
    assert_eq!(program.numbers[0].length, 8);
}

#[test]
fn flags_and_turns_are_written_in_place() {
    let text = listing("1:J P[1] 100% FINE ;", &usual("1"));
    let program = read_files(&[("a.ls", &text)]).expect("a program");
    let mut edits = crate::program::Edits::default();
    let numbers = program.numbers_of(&program.targets[0]);
    for (index, value) in [(6, 1.0), (11, 0.0), (9, -1.0)] {
        let span = numbers[index].start as usize
            ..numbers[index].start as usize + usize::from(numbers[index].length);
        let old = text.as_bytes()[span.clone()].to_vec();
        edits.replace(span, |out| {
            Fanuc.write_configuration(POSE, index, value, &old, out);
        });
    }
    let new = String::from_utf8(edits.apply(text.as_bytes())).expect("ASCII");
    assert!(new.contains("CONFIG : 'F U T, -1, 0, 0',"), "{new}");
}

#[test]
fn tool_and_frame_0_are_known_and_others_come_from_the_controllers_files() {
    let program = read(
        "1:J P[1] 100% FINE ;",
        &pose("1", "UF : 0, UT : 0, CONFIG : 'N U T, 0, 0, 0',"),
    );
    assert_eq!(program.tools[0].flange_from_tool, Some(Pose::identity()));
    assert_eq!(program.frames[0].world_from_frame, Some(Pose::identity()));
    let variables = "[*SYSTEM*]$CELL_FLOOR  Storage: SHADOW  Access: RW  : POSITION =\n  Group: \
        1   Config: N D B, 0, 0, 0\n  X:     9.000   Y:     9.000   Z:     9.000\n  W:     0.000   \
        P:     0.000   R:     0.000\n\n\
        [*SYSTEM*]$MNUFRAME  Storage: SHADOW  Access: RW  : ARRAY[4,20] OF POSITION\n    [1,1] = \
            \n  Group: 1   Config: N D B, 0, 0, 0\n  X:     7.000   Y:     7.000   Z:     7.000\n  \
            W:     0.000   P:     0.000   R:     0.000\n    [1,2] = \n  Group: 1   Config: N D B, \
            0, 0, 0\n  X:   884.000   Y: -3329.790   Z:  -133.190\n  W:     0.000   P:      .370   \
            R:    90.000\n    [1,3] =  Uninitialized\n    [2,2] = \n  Group: 2   Config: \n  \
            X:     1.000   Y:     0.000   Z:     0.000\n  W:     0.000   P:     0.000   R:     \
            0.000\n\n\
        [*SYSTEM*]$MNUTOOL  Storage: CMOS  Access: RW  : ARRAY[2,20] OF POSITION\n  [1,1] = 'GRIP \
            X: 7' Group: 1\n    X:   0.000   Y:   0.000   Z: 150.000\n    W:   0.000   P:   \
            0.000   R:   0.000\n[*SYSTEM*]$MNUTOOLNUM  Storage: CMOS  Access: RW  : ARRAY[2] OF \
            BYTE\n  [1] = 1\n";
    let list = "F Number: F270477\n$VERSION: V9.30126\n\nTool Frame\n  -1.3  -1090.6   150.1  \
        -180.0     0.0   -90.0 SSW\n\nJog Frame\n   5.0     0.0     0.0     0.0     0.0     0.0 \
        \n\nUser Frame\n   0.0     0.0     0.0     0.0     0.0     0.0 \n 884.0  -3329.8   \
        -133.2      .1      .0    90.0 FIX 1\n";
    let text = listing("1:J P[1] 100% FINE ;", &usual("1"));
    for (files, tool, frame) in [
        (vec![("s.va", variables)], 0.150, -3.32979),
        (vec![("f.dg", list)], 0.1501, -3.3298),
        (vec![("s.va", variables), ("f.dg", list)], 0.150, -3.32979),
        (vec![("f.dg", list), ("s.va", variables)], 0.150, -3.32979),
    ] {
        for (name, text) in &files {
            assert!(Fanuc.recognises(&Source::new(*name, text.as_bytes().to_vec())));
        }
        let all = [&files[..], &[("a.ls", &*text)]].concat();
        let program = read_files(&all).expect("a program");
        let used = &program.moves[0];
        let found = program.tools[used.tool].flange_from_tool.expect("a tool");
        assert!((found.translation[2] - tool).abs() < 1e-12);
        let found = program.frames[used.frame]
            .world_from_frame
            .expect("a frame");
        assert!((found.translation[1] - frame).abs() < 1e-12);
        assert!((found.rotation.0[1][0] - 1.0).abs() < 1e-4, "turned by R");
        let rounded = files.iter().any(|(name, _)| *name == "f.dg");
        assert_eq!(ids(&program), vec!["frames-rounded"; usize::from(rounded)]);
        assert!(program.targets.iter().all(|target| target.file != 0));
    }
}

#[test]
fn points_that_are_none_of_a_six_axis_arm_are_errors() {
    let replaced = |from: &str, to: &str| usual("1").replace(from, to);
    for (point, id) in [
        (replaced(" 1922.978", " ********"), "target-uninitialised"),
        (replaced("'N U T,", "'L,"), "configuration-not-understood"),
        (
            replaced("'N U T,", "'N R U T,"),
            "configuration-not-understood",
        ),
        (replaced("R =     -.287 deg", ""), "target-not-six-axes"),
        (replaced("-.287 deg", "-.287 rad"), "target-not-six-axes"),
        (joints("1").replace("J6=", "J9="), "target-not-six-axes"),
        (
            replaced("X =", "RX =").replace("Y =", "RY ="),
            "stationary-tool",
        ),
        (usual("1") + &usual("1"), "target-name-ambiguous"),
    ] {
        let program = read("L P[1] 9mm/sec FINE ;", &point);
        assert_eq!(ids(&program)[0], id, "{point}");
        assert!(program.targets.iter().all(|target| target.blocked));
    }
    // a point that nobody moves to does no harm
    let point = replaced(" 1922.978", " ********");
    let program = read("CALL X ;", &point);
    assert_eq!(ids(&program), ["target-unused-here"]);
    assert_eq!(program.findings[0].severity, Severity::Note);
}

#[test]
fn broken_text_is_an_error_with_its_place() {
    let good = listing("J P[1] 100% FINE ;", &usual("1"));
    let cut = good.trim_end().trim_end_matches("/END");
    for end in ["", "/E", "/END_"] {
        let error = read_files(&[("a.ls", &format!("{cut}{end}"))]).expect_err("cut");
        let wanted = "a.ls:1:8: the program (its last line is /END) is not closed";
        assert_eq!(error.to_string(), wanted);
    }
    for (from, to, wanted) in [
        (
            "};",
            "",
            "a.ls:13:1: found `/END`, where a coordinate or } belongs",
        ),
        ("GP1:", "", "a.ls:9:2: found `UF`, where GP1: belongs"),
        (
            "P[1]{",
            "P[x]{",
            "a.ls:7:3: found `x]{`, where the number of the point belongs",
        ),
        (
            "'N U T, 0, 0, -1',",
            "'N U T",
            "a.ls:9:28: a string is not closed",
        ),
        (
            " 1922.978",
            " 19-2",
            "a.ls:10:7: `19-2` is no coordinate, or number of a tool or frame: a plain number of \
             at most 1000000 is wanted; angles of tools and frames go to 720 deg, their numbers to \
             255",
        ),
        (
            "X =",
            "X ",
            "a.ls:10:6: found `1922.978`, where = or : belongs",
        ),
        (
            "P[1]{",
            "Q",
            "a.ls:7:1: found `Q`, where a point `P[1]{` or /END belongs",
        ),
    ] {
        let error = read_files(&[("a.ls", &good.replacen(from, to, 1))]).expect_err(wanted);
        assert_eq!(error.to_string(), wanted);
    }
    for (cut, wanted) in [
        (8, "a.ls:7:1: a point is not closed"),
        (
            20,
            "a.ls:11:46: found the end of the file, where a number belongs",
        ),
    ] {
        let error = read_files(&[("a.ls", &good[..good.len() - cut])]).expect_err("cut");
        assert_eq!(error.to_string(), wanted);
    }
    let log = "ERRALL.LS  Robot Name X\n 1\" 05-JAN-20 10:00 SRVO-002\n";
    assert!(!Fanuc.recognises(&Source::new("errall.ls", log.into())));
    let error = read_files(&[("errall.ls", log)]).expect_err("a log");
    assert!(matches!(error, ReadError::NotThisLanguage { .. }));
    let zero = good.replace("TEST", "TE\0ST");
    let error = read_files(&[("a.ls", &zero)]).expect_err("binary");
    assert!(matches!(error, ReadError::Binary { .. }));
}

#[test]
fn a_pose_is_w_p_r_about_fixed_axes_in_millimetres_and_degrees() {
    let settings = Settings::default();
    let numbers = [
        1000.0, 0.0, 0.0, 90.0, 30.0, 90.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    ];
    let decoded = Fanuc.decode(POSE, &numbers, &settings);
    let Value::Pose(pose) = decoded.value else {
        panic!("a pose")
    };
    assert!((pose.translation[0] - 1.0).abs() < 1e-12);
    let z = pose.rotation * [0.0, 0.0, 1.0];
    assert!((z[0] - 1.0).abs() < 1e-12);
    assert_eq!(decoded.configuration.joint_5_negative, Some(true));
    let posture = Posture {
        joints_rad: [0.0, 0.0, 0.0, 0.0, -1.0, 7.0],
        behind_axis_1: false,
        behind_lower_arm: false,
    };
    let mut back = numbers;
    Fanuc.encode(
        POSE,
        &Value::Pose(pose),
        &posture,
        &posture,
        &settings,
        &mut back,
    );
    for (new, old) in back.iter().zip(numbers) {
        assert!((new - old).abs() < 1e-9, "{back:?}");
    }
    let short = Layout {
        shape: Shape::Pose,
        variant: 1,
    };
    let decoded = Fanuc.decode(short, &numbers[..6], &settings);
    assert_eq!(decoded.configuration, Configuration::default());
    assert_eq!(Fanuc.roles(short).len(), 6);
}
