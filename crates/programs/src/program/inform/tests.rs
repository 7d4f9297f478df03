//! What jobs mean.

use super::*;
use crate::geometry::Rotation;
use crate::program::marker::WIDEST_COMMENT;
use crate::program::{Motion, Posture, Program, Shape, Value};

mod deciding;
mod followed;
mod indexed;
mod jumps;
mod macros;
mod parts;
mod posts;
mod robust;

fn read_files(texts: &[&str], settings: &Settings) -> Result<Program, ReadError> {
    let sources: Vec<_> = texts
        .iter()
        .enumerate()
        .map(|(i, text)| Source::new(format!("{i}.JBI"), text.as_bytes().to_vec()))
        .collect();
    crate::motion::read(&Inform, &sources, settings)
}

fn read(text: &str) -> Program {
    read_files(&[text], &Settings::default()).expect("a job")
}

/// A job of these positions and instructions.
fn job(positions: &str, instructions: &str) -> String {
    format!(
        "/JOB\n//NAME A\n//POS\n{positions}\n//INST\n///DATE 2024/01/01 10:00\n///ATTR \
         SC,RW\n///GROUP1 RB1\nNOP\n{instructions}\nEND\n"
    )
}

const USER: &str = "///USER 12\n///TOOL 3\n///POSTYPE USER\n///RECTAN\n///RCONF 1,0,0,0,0,0,0,0\n";
const P6: &str = "1.000,2.000,3.000,10.0000,20.0000,30.0000";

fn points(count: usize) -> String {
    (0..count).map(|i| format!("C{i:05}={P6}\n")).collect()
}

/// The ids of all findings but the one that most jobs here have: they start with a rectangular
/// position.
fn ids(program: &Program) -> Vec<&str> {
    let all = program.findings.iter().map(|f| f.id);
    all.filter(|id| *id != "wrist-not-told").collect()
}

#[test]
fn header_lines_hold_until_they_are_set_anew() {
    let positions = format!(
        "///NPOS 4,0,0,1,0,0\n///TOOL 0\n///POSTYPE \
         PULSE\n///PULSE\nC00000=0,10,-20,30,-40,50\n{USER}C00001={P6}\n\
         ///USER 4\nC00002= 1, -2.5 ,3,.5,+20.,-30\n///TOOL 5\n///POSTYPE BASE\nC00003={P6}\nP00018={P6}"
    );
    let moves = "MOVJ C00000 VJ=0.78\n'MOVL C00009\n  MOVL C00001 V=100.0\n//MOVL C00007 V=1\nMOVJ \
        C00002 VJ=5\nMOVL C00003\nMOVL P018 V=5";
    let settings = Settings {
        pulses_per_deg: Some([1000.0; 6]),
        ..Settings::default()
    };
    let program = read_files(&[&job(&positions, moves)], &settings).expect("a job");
    assert_eq!(ids(&program), ["position-variable"]);
    let placed: Vec<_> = program
        .moves
        .iter()
        .map(|m| {
            let frame = &program.frames[m.frame];
            (
                program.targets[m.target.unwrap()]
                    .name
                    .as_deref()
                    .expect("a name"),
                program.tools[m.tool].name.as_str(),
                frame.name.as_str(),
                frame.world_from_frame.is_some(),
            )
        })
        .collect();
    assert_eq!(
        placed,
        [
            ("C00000", "0", "BASE", true),
            ("C00001", "3", "12", false),
            ("C00002", "3", "4", false),
            ("C00003", "5", "BASE", true),
            ("P018", "5", "BASE", true)
        ]
    );
    let configured: Vec<_> = program.moves.iter().map(|m| m.configured).collect();
    assert_eq!(configured, [true, false, true, false, false]);
    let numbers: Vec<_> = program
        .numbers_of(&program.targets[2])
        .iter()
        .map(|n| n.value)
        .collect();
    assert_eq!(numbers, [1.0, -2.5, 3.0, 0.5, 20.0, -30.0]);
}

#[test]
fn postype_of_rectangular_positions_does_not_matter_to_pulses() {
    // some posts write POSTYPE BASE behind pulses, and PULSE without POSTYPE
    let positions =
        format!("///TOOL 1\n///POSTYPE BASE\n///PULSE\nC00000=1,2,3,4,5,6\n///RECTAN\nC00001={P6}");
    let program = read(&job(&positions, "MOVJ C00000 VJ=1\nMOVL C00001 V=5"));
    assert_eq!(ids(&program), ["pulses-per-degree-unknown"]);
    assert!(program.targets[0].blocked && program.targets[0].numbers.is_empty());
    assert_eq!(program.targets[0].layout.shape, Shape::Joints);
    assert!(!program.targets[1].blocked);
    assert_eq!(program.targets[1].layout.shape, Shape::Pose);
}

#[test]
fn pulses_and_angles_are_joints() {
    let settings = Settings {
        pulses_per_deg: Some([1000.0, -2000.0, 500.0, 100.0, 200.0, 400.0]),
        ..Settings::default()
    };
    let decoded = |variant, numbers: &[f64]| {
        let shape = Shape::Joints;
        let decoded = Inform.decode(Layout { shape, variant }, numbers, &settings);
        match decoded.value {
            Value::Joints(joints) => joints.map(|angle| (angle / DEG * 1e6).round() / 1e6),
            Value::Pose(_) => panic!("joints"),
        }
    };
    let pulses = [90_000.0, 20_000.0, -5000.0, 0.0, 200.0, 400.0];
    assert_eq!(
        decoded(PULSES, &pulses),
        [90.0, -10.0, -10.0, 0.0, 1.0, 1.0]
    );
    let angles = [90.0, -10.0, -10.0, 0.0, 1.0, 1.0];
    assert_eq!(decoded(DEGREES, &angles), angles);
    let posture = Posture {
        joints_rad: [0.0; 6],
        behind_axis_1: false,
        behind_lower_arm: false,
    };
    let layout = Layout {
        shape: Shape::Joints,
        variant: PULSES,
    };
    let value = Value::Joints(angles.map(|angle| angle * DEG));
    let mut numbers = [0.0; 6];
    Inform.encode(layout, &value, &posture, &posture, &settings, &mut numbers);
    assert!(
        numbers
            .iter()
            .zip(pulses)
            .all(|(a, b)| (a - b).abs() < 1e-6)
    );
    let text = job(
        "///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\nC00000=1.0000,2.0,3.0,4.0,5.0,6.0",
        "MOVJ C00000",
    );
    assert_eq!(read(&text).targets[0].layout.variant, DEGREES);
}

#[test]
fn arcs_go_through_each_two_points_behind_the_first() {
    use Motion::{ArcEnd, ArcVia, Linear, Spline};
    let moves = "MOVL C00000\nMOVC C00001\nMOVC C00002\nTIMER T=1.00\nMOVC C00003\nMOVL \
        C00004\nMOVC C00005\nMOVC C00006";
    let program = read(&job(&format!("{USER}{}", points(7)), moves));
    let motions: Vec<_> = program.moves.iter().map(|m| m.motion).collect();
    assert_eq!(
        motions,
        [Linear, Linear, ArcVia, ArcEnd, Linear, Linear, Spline]
    );
}

#[test]
fn positions_that_no_move_goes_to_stay() {
    let positions = format!(
        "{USER}{}///POSTYPE ROBOT\nP00001=0,0,100.000,0,0,0\nBC00000=0\n///PULSE\nEC00000=1,2\nBP00000=1\nEX00001=3,4",
        points(2)
    );
    let program = read(&job(&positions, "MOVL C00001\nREFP 1 C00000\nSET D000 5"));
    let blocked: Vec<_> = program.targets.iter().map(|t| t.blocked).collect();
    assert_eq!(blocked, [true, false, true]);
    assert_eq!(ids(&program), ["target-unused-here"]);
}

#[test]
fn a_frame_that_the_header_does_not_tell_is_an_error() {
    for (header, id) in [
        ("///TOOL 0\n///RECTAN\n", "frame-not-named"),
        ("///TOOL 0\n///POSTYPE USER\n///RECTAN\n", "frame-not-named"),
        (
            "///TOOL 0\n///POSTYPE PULSE\n///RECTAN\n",
            "frame-not-named",
        ),
        (
            "///TOOL 0\n///POSTYPE TOOL\n///RECTAN\n",
            "tool-coordinates",
        ),
        (
            "///TOOL 0\n///POSTYPE MTOOL\n///RECTAN\n",
            "tool-coordinates",
        ),
        (
            "///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\n",
            "target-not-six-axes",
        ),
    ] {
        let seven = if id == "target-not-six-axes" {
            ",7"
        } else {
            ""
        };
        let program = read(&job(&format!("{header}C00000={P6}{seven}"), "MOVL C00000"));
        assert_eq!(ids(&program), [id], "{header}");
        assert!(program.targets[0].blocked);
    }
}

#[test]
fn a_rectangular_position_with_more_than_six_numbers_is_refused() {
    let position = |numbers: &str| job(&format!("{USER}C00000={numbers}"), "MOVL C00000");
    let six = "525.000,60.000,-84.000,180.00,-6.00,25.00";
    // a decimal comma, also where the last number is zero, and the elbow angle of a seven-axis arm
    let zero = "525.000,60.000,-84.000,180.00,-6.00,0.00";
    for numbers in [
        six.replace("-6.00", "-6,00"),
        zero.replace("525.000", "525,000"),
        zero.replace("-6.00", "-6,00"),
        zero.replace(",0.00", ",0,00"),
        format!("{six},30.0"),
    ] {
        let program = read(&position(&numbers));
        assert_eq!(ids(&program), ["target-not-six-axes"], "{numbers}");
        assert!(program.targets[0].blocked);
    }
    let program = read(&position(&format!("{six},0.0000")));
    assert_eq!(ids(&program), [""; 0]);
    assert_eq!(program.numbers_of(&program.targets[0]).len(), 6);
    let two = position(&six.replace("-84.000", "-84,000").replace("-6.00", "-6,00"));
    let failed = read_files(&[&two], &Settings::default()).expect_err("seven numbers");
    assert!(failed.to_string().contains("decimal points"), "{failed}");
}

#[test]
fn what_states_the_first_solution_is_reported() {
    let found = |positions: &str, comment: &str, moves: &str| {
        let text = job(positions, moves).replace("///ATTR", &format!("///COMM {comment}\n///ATTR"));
        let program = read(&text);
        let ids: Vec<_> = program.findings.iter().map(|f| f.id).collect();
        let reported = |target: &crate::program::Target| {
            let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
            let decoded = Inform.decode(target.layout, &numbers, &Settings::default());
            decoded.configuration.behind_axis_1
        };
        (ids, reported(&program.targets[0]))
    };
    let joints = format!("{USER}C00001={P6}\n///POSTYPE ANGLE\n///ANGLE\nC00000={P6}");
    let moves = "MOVJ C00000 VJ=5\nMOVJ C00001 VJ=5\nMOVJ C00001 VJ=5";
    assert_eq!(found(&joints, "by hand", moves), (vec![], Some(false)));
    assert_eq!(
        found(&joints, "Generated using RoboDK", moves),
        (vec!["rconf-of-post"], None)
    );
    let begins = "MOVL C00001\nMOVJ C00000";
    assert_eq!(found(&joints, "", begins), (vec![], Some(false)));
    let open = joints.replace("RCONF 1,", "RCONF -1,");
    assert_eq!(
        found(&open, "", begins),
        (vec!["wrist-not-told"], Some(false))
    );
}

#[test]
fn a_moved_base_axis_does_not_matter_to_robot_coordinates_and_joints() {
    let positions = format!(
        "///TOOL 0\n///POSTYPE ROBOT\n///RECTAN\n{}///POSTYPE \
         ANGLE\n///ANGLE\nC00005={P6}\nBC00001=500",
        points(1)
    );
    let program = read(&job(&positions, "MOVL C00000 BC00001\nMOVJ C00005 BC00001"));
    assert_eq!(ids(&program), [""; 0]);
}

#[test]
fn condition_files_tell_tools_and_frames() {
    let sources = [
        Source::new(
            "TOOL.CND",
            b"//TOOL 3\n///NAME \
            GUN\n0.000,0.000,120.000,0.0000,0.0000,0.0000\n0.0,0.0,50.0\n2.000\n0,0,0\n"
                .to_vec(),
        ),
        Source::new(
            "UFRAME.CND",
            b"//UFRAME 12\n///NAME\n////BUSER \
            100.000,0.000,0.000,0.0000,0.0000,0.0000\n"
                .to_vec(),
        ),
        Source::new(
            "A.JBI",
            job(&format!("{USER}{}", points(1)), "MOVL C00000").into_bytes(),
        ),
    ];
    let program = crate::motion::read(&Inform, &sources, &Settings::default()).expect("files");
    let pose = program.tools[0].flange_from_tool.expect("a tool");
    assert!((pose.translation[2] - 0.12).abs() < 1e-12);
    assert!(program.tools[0].load.is_some());
    let frame = program.frames[0].world_from_frame.expect("a frame");
    assert!((frame.translation[0] - 0.1).abs() < 1e-12);
    assert_eq!((program.targets[0].file, program.moves[0].file), (2, 2));
}

#[test]
fn every_line_end_comment_and_second_job_is_read() {
    let text = job(
        &format!("///NPOS 2,0,0,0,0,0\n{USER}{}", points(2)),
        "MOVL C00000 V=5\n\tMOVL C00001",
    );
    for end in ["\n", "\r\n", "\r"] {
        let one = text.replace('\n', end);
        let program = read(&format!("'PP version 1{end}{one}"));
        assert_eq!(
            (program.targets.len(), program.moves.len()),
            (2, 2),
            "{end:?}"
        );
        assert_eq!(ids(&program), [""; 0]);
        let two = format!("\u{feff}{one}\u{1a}{end}{one}\u{1a}");
        let program = read(&two);
        assert_eq!(
            (program.targets.len(), program.moves.len()),
            (4, 4),
            "{end:?}"
        );
    }
    let local = text.replace(
        "NOP\n",
        "///LVARS 1,0,0,0,0,1,0,0\nLB000 counter\nLP000 P001\nNOP\n",
    );
    assert_eq!(ids(&read(&local)), [""; 0]);
    let short = text.replace("///NPOS 2", "///NPOS 3");
    assert_eq!(ids(&read(&short)), ["position-count"]);
    let double = text.replace("C00001=", "C00000=");
    assert!(ids(&read(&double)).contains(&"target-name-ambiguous"));
}

#[test]
fn broken_jobs_are_reported_with_line_and_column() {
    let text = job(&format!("{USER}{}", points(1)), "MOVL C00000 V=5");
    for (broken, place, message) in [
        (text.replace("\nEND", ""), (1, 1), "is not closed"),
        (text.replace("//INST", "//OTHER"), (1, 1), "is not closed"),
        (
            text.replace("2.000", "2.0OO"),
            (9, 14),
            "found `2.0OO`, where a number",
        ),
        (
            text.replace("2.000,", ""),
            (9, 1),
            "where x, y, z, Rx, Ry and Rz",
        ),
        (text.replace("2.000", ""), (9, 14), "found nothing"),
        (
            text.replace("C00000=1", "C00000 1"),
            (9, 1),
            "where a position such as",
        ),
        (
            text.replace("C00000=", "C0x000="),
            (9, 1),
            "where the number of a position",
        ),
        (
            text.replace("///TOOL 3", "///TOOL x"),
            (5, 1),
            "the number of a tool",
        ),
        (
            text.replace("///RECTAN\n", "")
                .replace("///POSTYPE USER\n", ""),
            (7, 1),
            "where ///PULSE",
        ),
        (
            "NOP\nMOVL C00000\nEND\n".into(),
            (0, 0),
            "it has no line /JOB",
        ),
    ] {
        let error = read_files(&[&broken], &Settings::default()).expect_err("broken");
        let (_, line, column) = error.place();
        assert_eq!((line, column), place, "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
    let zero = Source::new("x", b"/JOB\n\0".to_vec());
    assert!(matches!(
        crate::motion::read(&Inform, &[zero], &Settings::default()),
        Err(ReadError::Binary { .. })
    ));
}

#[test]
fn jobs_and_condition_files_are_recognised_and_others_not() {
    let recognised = |text: &str| Inform.recognises(&Source::new("x", text.as_bytes().to_vec()));
    let text = job(USER, "MOVL C00000");
    assert!(recognised(&text) && recognised(&format!("'PP 1\r\n{text}")));
    assert!(recognised("//TOOL 0\n///NAME\n") && recognised("//UFRAME 1\n"));
    for other in [
        "",
        "/PROG A\n/MN\n",
        "/JOB\n",
        "/JOB\nMOVL C00000\n",
        "2024/01/01 //TOOL 1",
        "MODULE m\nENDMODULE",
        "//PARAM 1\n",
    ] {
        assert!(!recognised(other), "{other}");
    }
}

#[test]
fn without_nop_the_marker_stands_before_the_end() {
    let text = job(&format!("{USER}{}", points(1)), "MOVL C00000 V=5").replace("NOP\n", "");
    let marker = Marker {
        version: "0.1.0".into(),
        profile_sha256: "a".repeat(64),
        source_sha256: "b".repeat(64),
        decided: Vec::new(),
    };
    let (at, _) = Inform.mark(&Source::new("x", text.clone().into_bytes()), &marker);
    assert_eq!(&text[at..], "END\n");
}

#[test]
fn the_marker_is_a_comment_behind_nop_in_short_lines() {
    let marker = Marker {
        version: "0.1.0".into(),
        profile_sha256: "a".repeat(64),
        source_sha256: "b".repeat(64),
        decided: Vec::new(),
    };
    for end in ["\n", "\r\n", "\r"] {
        let text = job(&format!("{USER}{}", points(1)), "MOVL C00000 V=5").replace('\n', end);
        let source = Source::new("x", text.clone().into_bytes());
        let (at, comment) = Inform.mark(&source, &marker);
        assert!(text[..at].ends_with(&format!("NOP{end}")));
        let marked = format!("{}{}{}", &text[..at], Source::text(&comment), &text[at..]);
        assert!(Marker::find(marked.as_bytes()).is_some());
        let lines: Vec<_> = Source::text(&comment)
            .split_terminator(end)
            .map(str::to_owned)
            .collect();
        assert!(
            lines
                .iter()
                .all(|line| line.starts_with('\'') && line.len() <= WIDEST_COMMENT + 1)
        );
        assert_eq!(lines.len(), 3);
        assert_eq!(read(&marked).moves.len(), 1);
    }
}
