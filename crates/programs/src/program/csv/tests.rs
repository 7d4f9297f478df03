//! Tables of poses and joints.

use super::*;
use crate::finding::Severity;
use crate::program::{Posture, Program};

fn read(text: &str) -> Result<Program, ReadError> {
    crate::motion::read(
        &Csv,
        &[Source::new("p.csv", text.as_bytes().to_vec())],
        &Settings::default(),
    )
}

fn values(program: &Program, target: usize) -> Vec<f64> {
    let numbers = program.numbers_of(&program.targets[target]);
    numbers.iter().map(|n| n.value).collect()
}

#[test]
fn poses_in_any_order_of_columns_with_names_of_tool_and_frame() {
    let text = "# made by hand\r\nid,qw,qx,qy,qz,speed,z_mm,y_mm,x_mm,tool,frame,branch\r\n\
                a,1,0,0,0,fast,3,-2.50,\" 1.5 \",gun,bench,0\r\n\r\n# half\r\n\"b, \
                    \"\"c\",0,1,0,0,slow,6,5,4,gun,world,5\r\n";
    let program = read(text).expect("a table");
    assert_eq!(values(&program, 0), [1.5, -2.5, 3.0, 1.0, 0.0, 0.0, 0.0]);
    assert_eq!(values(&program, 1)[..3], [4.0, 5.0, 6.0]);
    let names: Vec<_> = program.targets.iter().map(|t| t.name.as_deref()).collect();
    assert_eq!(names, [Some("a"), Some("b, \"c")]);
    let tools: Vec<_> = program
        .tools
        .iter()
        .map(|t| (t.name.as_str(), t.flange_from_tool))
        .collect();
    assert_eq!(tools, [("gun", None)]);
    let frames: Vec<_> = program
        .frames
        .iter()
        .map(|f| (f.name.as_str(), f.world_from_frame))
        .collect();
    assert_eq!(frames, [("bench", None), ("world", Some(Pose::identity()))]);
    assert!(
        program
            .moves
            .iter()
            .all(|m| m.configured && m.motion == Motion::Linear)
    );
    let decoded = Csv.decode(
        program.targets[1].layout,
        &values(&program, 1),
        &Settings::default(),
    );
    let c = decoded.configuration;
    assert_eq!(
        [c.behind_axis_1, c.behind_lower_arm, c.joint_5_negative],
        [Some(true), Some(false), Some(true)]
    );
}

#[test]
fn only_a_cell_makes_a_frame_the_world_for_good() {
    let head = "x_mm,y_mm,z_mm,qw,qx,qy,qz,frame\n";
    let program = read(&format!(
        "{head}1,2,3,1,0,0,0,\n1,2,3,1,0,0,0,world\n1,2,3,1,0,0,0,\n"
    ));
    let program = program.expect("a table");
    let frames: Vec<_> = program
        .moves
        .iter()
        .map(|used| program.frames[used.frame].world_from_frame.is_some())
        .collect();
    assert_eq!(frames, [false, true, false]);
    let unframed = &program.frames[program.moves[0].frame].name;
    assert_eq!(Csv.frame_of_unframed(), Some(unframed.as_str()));
}

#[test]
fn joints_and_joints_to_start_from() {
    let program =
        read("q6_deg,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg\n6,1,2,3,4,5\n").expect("a table");
    assert_eq!(values(&program, 0), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(program.moves[0].motion, Motion::Joint);
    assert_eq!(
        (
            program.tools[0].name.as_str(),
            program.frames[0].name.as_str()
        ),
        ("", "world")
    );
    let text = "x_mm,y_mm,z_mm,qw,qx,qy,qz,near1_deg,near2_deg,near3_deg,near4_deg,near5_deg,near6_deg\n1,2,3,1,0,0,0,90,0,0,0,0,-180\n";
    let program = read(text).expect("a table");
    let near = program.near(&program.moves[0]).expect("joints");
    assert!((near[0] - 90.0 * DEG).abs() < 1e-12 && (near[5] + 180.0 * DEG).abs() < 1e-12);
    assert!(!program.moves[0].configured);
}

#[test]
fn broken_tables_are_reported_with_line_and_column() {
    let head = "x_mm,y_mm,z_mm,qw,qx,qy,qz";
    for (text, place, message) in [
        (
            format!("{head}\n1,2,,1,0,0,0\n"),
            (2, 5),
            "found an empty cell, where a finite number",
        ),
        (
            format!("# a\n{head}\n1,2,3,1,0,0,0\n1,nan,3,1,0,0,0"),
            (4, 3),
            "found `nan`",
        ),
        (
            format!("{head}\n1,2,1e400,1,0,0,0\n"),
            (2, 5),
            "found `1e400`",
        ),
        (
            format!("{head}\n1,2,\"3x\",1,0,0,0\n"),
            (2, 6),
            "found `3x`",
        ),
        (format!("{head}\n1,2,3\n"), (2, 6), "found a row of 3 cells"),
        (
            format!("{head}\n1,2,3,1,0,0,0,9\n"),
            (2, 16),
            "found a row of 8 cells",
        ),
        (
            format!("{head}\n1,2,3,0,0,0,0\n"),
            (2, 7),
            "the length must be 1",
        ),
        (
            format!("{head},branch\n1,2,3,1,0,0,0,8\n"),
            (2, 15),
            "found `8`, where a branch",
        ),
        (
            format!("{head},branch\n1,2,3,1,0,0,0,\n"),
            (2, 15),
            "an empty cell",
        ),
        (
            format!("{head},near1_deg\n1,2,3,1,0,0,0,8\n"),
            (1, 1),
            "near6_deg or none",
        ),
        (
            format!("{head},x_mm\n1,2,3,1,0,0,0,8\n"),
            (1, 28),
            "`x_mm` once more",
        ),
        (
            format!("{head}\n1,2,\"3,1,0,0,0\n"),
            (2, 5),
            "a quoted cell is not closed",
        ),
        ("x,y,z\n1,2,3\n".into(), (0, 0), "no header with"),
        (
            "x_mm,y_mm,z_mm\n1,2,3\n".into(),
            (1, 1),
            "a header without `qw`",
        ),
        (String::new(), (0, 0), "no header with"),
        (
            format!("{head},branch,near1_deg,near2_deg,near3_deg,near4_deg,near5_deg,near6_deg\n"),
            (1, 28),
            "`branch` next to near1_deg",
        ),
        (
            format!("{head},wobj\n"),
            (1, 28),
            "found `wobj`, where the column `frame` belongs",
        ),
        (
            format!("{head},Tool Name\n"),
            (1, 28),
            "where the column `tool` belongs",
        ),
        (
            format!("{head},ext1\n"),
            (1, 28),
            "where a column `e1_mm` or `e1_deg` belongs",
        ),
        (
            format!("{head},near_1\n"),
            (1, 28),
            "where one of the columns `near1_deg`",
        ),
        (
            format!("{head},tool,Tool\n"),
            (1, 33),
            "found `Tool` once more",
        ),
        (
            format!("{head},e1_mm,E1_MM\n"),
            (1, 34),
            "found `E1_MM` once more",
        ),
        (
            "id;x_mm;y_mm;z_mm;qw;qx;qy;qz\n".into(),
            (1, 1),
            "a semicolon or a tab between cells",
        ),
        (
            "x_mm,y_mm,z_mm,q_w,qx,qy,qz\n".into(),
            (1, 1),
            "a header without `qw`",
        ),
        (
            "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg\n".into(),
            (1, 1),
            "a header without `q6_deg`",
        ),
        (
            format!("{head},e1_mm,e1_deg\n1,2,3,1,0,0,0,8,9\n"),
            (1, 34),
            "`e1_deg` once more",
        ),
        (
            format!("{head},e1_mm\n1,2,3,1,0,0,0,\n"),
            (2, 15),
            "an empty cell",
        ),
        (
            format!("{head},q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n"),
            (1, 1),
            "poses and joints",
        ),
    ] {
        let error = read(&text).expect_err("broken");
        let (_, line, column) = error.place();
        assert_eq!((line, column), place, "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
    assert!(matches!(read("x_mm\0"), Err(ReadError::Binary { .. })));
}

#[test]
fn names_of_columns_may_have_capitals() {
    let text = "ID,X_MM,Y_mm,Z_mm,QW,QX,QY,QZ,FRAME,Tool,Near1_deg,NEAR2_DEG,near3_deg,near4_deg,\
                near5_deg,near6_deg,E1_mm\na,1,2,3,1,0,0,0,nest,gun,90,0,0,0,0,-180,500\n";
    let program = read(text).expect("a table");
    assert_eq!(values(&program, 0)[..3], [1.0, 2.0, 3.0]);
    assert_eq!(program.frames[0].name, "nest");
    assert_eq!(program.tools[0].name, "gun");
    let near = program.near(&program.moves[0]).expect("joints");
    assert!((near[0] - 90.0 * DEG).abs() < 1e-12 && (near[5] + 180.0 * DEG).abs() < 1e-12);
    let ids: Vec<_> = program.findings.iter().map(|found| found.id).collect();
    assert_eq!(ids, ["external-axis-unknown"]);
    assert!(Csv.recognises(&Source::new("x", text.as_bytes().to_vec())));
}

#[test]
fn columns_that_nothing_is_read_from_are_named_once_a_file() {
    let found = |columns: &str, cells: &str| {
        let row = format!("1,2,3,1,0,0,0,{cells}\n");
        let text = format!("x_mm,y_mm,z_mm,qw,qx,qy,qz,{columns}\n{row}{row}");
        let program = read(&text).expect("a table");
        let each = program.findings.into_iter();
        let each = each.map(|f| (f.id, f.severity, f.line, f.column, f.message));
        each.collect::<Vec<_>>()
    };
    let all = found(
        "speed,dir1,fz_n,Temperature_C,operator",
        "100,1,-200,20,ann",
    );
    let [other, (id, severity, line, column, message)] = &all[..] else {
        panic!("{all:?}");
    };
    assert_eq!(
        (*id, *severity, *line, *column),
        ("columns-not-read", Severity::Warning, 1, 34)
    );
    assert!(
        message.starts_with("`dir1`, `fz_n`, `Temperature_C`:"),
        "{message}"
    );
    let (id, severity, line, column, message) = other;
    assert_eq!(
        (*id, *severity, *line, *column),
        ("columns-not-read", Severity::Note, 1, 28)
    );
    assert!(message.ends_with(": `speed`, `operator`"), "{message}");
    let many: Vec<String> = (0..11).map(|at| format!("c{at}")).collect();
    let all = found(&many.join(","), "0,0,0,0,0,0,0,0,0,0,0");
    assert!(all[0].4.ends_with("`c7`, 3 more"), "{all:?}");
    assert_eq!(found("id,tool,frame,branch,", "a,t,f,0,"), []);
}

#[test]
fn external_axes_are_read_or_refused() {
    let read = |columns: &str, value: &str, linear: &[bool]| {
        let settings = Settings {
            external: ExternalNames {
                listed: linear.iter().map(|_| "E1".to_owned()).collect(),
                linear: linear.to_vec(),
                ..ExternalNames::default()
            },
            ..Settings::default()
        };
        let text = format!("x_mm,y_mm,z_mm,qw,qx,qy,qz,{columns}\n1,2,3,1,0,0,0,{value}\n");
        let source = Source::new("p.csv", text.into_bytes());
        crate::motion::read(&Csv, &[source], &settings)
    };
    let program = read("e1_mm,e2_deg", "1000,-30", &[true, false]).expect("a table");
    let found: Vec<_> = program
        .externals
        .iter()
        .map(|(_, one)| (one.axis, one.value))
        .collect();
    assert_eq!(found, [(0, 1000.0), (1, -30.0)]);
    assert!(!program.targets[0].blocked);
    // the profile does not say what it carries
    let program = read("e1_mm", "1000", &[]).expect("a table");
    let found = &program.findings[0];
    assert_eq!(found.id, "external-axis-unknown");
    assert!(found.message.contains("e1_mm is 1000"), "{}", found.message);
    assert!(program.targets[0].blocked);
    let program = read("e1_mm", "0", &[]).expect("a table");
    assert_eq!((program.findings.len(), program.externals.len()), (0, 0));
    let error = read("e1_deg", "1000", &[true]).expect_err("another unit");
    assert!(error.to_string().contains("the axis is linear"), "{error}");
}

#[test]
fn only_tables_of_poses_or_joints_are_recognised() {
    let recognised = |text: &str| Csv.recognises(&Source::new("x", text.as_bytes().to_vec()));
    assert!(recognised("#\n\"qz\",x_mm , y_mm,z_mm,qw,qx,qy,extra\r\n"));
    assert!(recognised(
        "\u{feff}q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n"
    ));
    for other in [
        "",
        "a,b\n",
        "x_mm,y_mm,z_mm\n",
        "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n",
        "x_mm;y_mm;z_mm;qw;qx;qy;qz\n",
        "GOTO/1.0,2.0,3.0,0.0,0.0,1.0\n",
        "/JOB\n//NAME A\n",
    ] {
        assert!(!recognised(other), "{other}");
    }
}

#[test]
fn quaternions_keep_their_sign() {
    let program = read("x_mm,y_mm,z_mm,qw,qx,qy,qz\n1,2,3,-0.5,-0.5,0.5,-0.5\n").expect("a table");
    let target = &program.targets[0];
    let mut numbers = values(&program, 0);
    let decoded = Csv.decode(target.layout, &numbers, &Settings::default());
    let posture = Posture {
        joints_rad: [0.0; 6],
        behind_axis_1: false,
        behind_lower_arm: false,
    };
    let before = numbers.clone();
    Csv.encode(
        target.layout,
        &decoded.value,
        &posture,
        &posture,
        &Settings::default(),
        &mut numbers,
    );
    assert!(
        numbers
            .iter()
            .zip(&before)
            .all(|(a, b)| (a - b).abs() < 1e-12)
    );
}

#[test]
fn the_marker_is_a_comment_at_the_top() {
    let marker = Marker {
        version: "1".into(),
        profile_sha256: "a".repeat(64),
        source_sha256: "b".repeat(64),
        decided: Vec::new(),
    };
    let text = "\u{feff}q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\r\n1,2,3,4,5,6\r\n";
    let source = Source::new("x", text.as_bytes().to_vec());
    let (at, comment) = Csv.mark(&source, &marker);
    assert_eq!(at, 3);
    let marked = format!("{}{}{}", &text[..at], Source::text(&comment), &text[at..]);
    assert_eq!(marked.matches("\r\n").count(), 5);
    assert_eq!(read(&marked).expect("a table").targets.len(), 1);
    assert!(Csv.recognises(&Source::new("x", marked.into_bytes())));
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]

    #[test]
    fn mutated_tables_never_panic(
        random in proptest::collection::vec(0_u8..=255, 0..200),
        changes in proptest::collection::vec((0_usize..500, proptest::sample::select(&MUTATIONS[..])), 1..6)
    ) {
        let mut bytes = SAMPLE.as_bytes().to_vec();
        for (at, (cut, text)) in changes {
            let at = at % bytes.len().max(1);
            let end = (at + cut).min(bytes.len());
            bytes.splice(at..end, text.bytes());
        }
        for bytes in [bytes, random] {
            let source = Source::new("x", bytes);
            let _ = Csv.recognises(&source);
            if let Ok(program) = crate::motion::read(&Csv, std::slice::from_ref(&source), &Settings::default()) {
                for number in &program.numbers {
                    let start = number.start as usize;
                    let text = &source.bytes[start..start + usize::from(number.length)];
                    assert_eq!(number::parse(text), Some(number.value));
                }
            }
        }
    }
}

/// What mutations cut, and put in its place.
const MUTATIONS: [(usize, &str); 12] = [
    (1, ""),
    (30, ""),
    (0, "\""),
    (0, "\"\""),
    (0, ","),
    (0, "\n"),
    (0, "\r"),
    (0, "#"),
    (0, "\n#"),
    (0, " "),
    (0, "1e400"),
    (0, "-"),
];

const SAMPLE: &str = "id,x_mm,y_mm,z_mm,qw,qx,qy,qz,branch,tool\n# \
    c\n1,\"1.0\",2,3,1,0,0,0,3,\"a\"\"b\"\n\n2, 4 ,5,6,0,1,0,0,0,t\r\n";
