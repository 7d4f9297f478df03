//! Input that fits more than one answer, or none: said, not guessed.

use crate::support::{run, scratch};
use poseshift::geometry::{Pose, norm};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

/// Runs with files of the folder in the place of names that end in `.csv`.
pub(super) fn registered(folder: &Path, arguments: &[&str]) -> (i32, Value, String) {
    let path = |name: &str| folder.join(name).to_str().expect("plain").to_owned();
    let words: Vec<String> = arguments
        .iter()
        .map(|word| match Path::new(word).extension() {
            Some(ending) if ending == "csv" => path(word),
            _ => (*word).to_owned(),
        })
        .collect();
    let mut all: Vec<&str> = words.iter().map(String::as_str).collect();
    all.push("--json");
    let (status, out, reported) = run(&all);
    (
        status,
        serde_json::from_str(&out).unwrap_or_default(),
        reported,
    )
}

pub(super) fn has(report: &Value, id: &str) -> bool {
    let findings = report["findings"].as_array().expect("findings");
    findings.iter().any(|finding| finding["id"] == id)
}

pub(super) fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("scratch");
}

const CORNER: &str = "id,x_mm,y_mm,z_mm,feature,nx,ny,nz
A,0,0,0,plane,0,0,1
B,0,0,0,plane,0,-1,0
C,0,0,0,plane,-1,0,0
";
const TOUCHES: [(&str, [f64; 3]); 12] = [
    ("A", [20.0, 20.0, 0.01]),
    ("A", [280.0, 30.0, -0.01]),
    ("A", [150.0, 180.0, 0.02]),
    ("A", [30.0, 150.0, 0.0]),
    ("B", [20.0, 0.01, -10.0]),
    ("B", [280.0, -0.02, -20.0]),
    ("B", [150.0, 0.01, -70.0]),
    ("B", [50.0, 0.0, -60.0]),
    ("C", [0.02, 20.0, -10.0]),
    ("C", [-0.01, 180.0, -20.0]),
    ("C", [0.01, 100.0, -70.0]),
    ("C", [0.0, 60.0, -50.0]),
];

fn touches() -> String {
    let mut text = String::from("id,x_mm,y_mm,z_mm\n");
    for (id, [x, y, z]) in TOUCHES {
        writeln!(text, "{id},{x},{y},{z}").expect("text");
    }
    text
}

#[test]
fn three_planes_alone_are_the_faces_of_a_convex_corner() {
    let folder = scratch();
    let at = folder.path();
    write(at, "from.csv", CORNER);
    write(at, "to.csv", &touches());
    let (status, report, reported) = registered(at, &["register", "from.csv", "to.csv"]);
    assert_eq!(status, 0, "{reported}");
    for k in 0..3 {
        let on_axis = report["rotation"][k][k].as_f64().expect("a number");
        assert!(on_axis > 0.9999, "{report}");
    }
    assert!(has(&report, "convex-corner"), "{report}");
    // the walls of a pocket: no turn of them makes a convex corner
    let normals = CORNER.replace("0,-1,0", "0,1,0").replace("-1,0,0", "1,0,0");
    write(at, "from.csv", &normals);
    write(at, "to.csv", &touches().replace(",-", ","));
    let (status, _, reported) = registered(at, &["register", "from.csv", "to.csv"]);
    assert!(
        status == 2 && reported.contains("another pose fits as well"),
        "{status} {reported}"
    );
    // a point off the planes settles it
    write(at, "from.csv", &format!("{normals}q,150,100,30,point,,,\n"));
    let with_point = touches().replace(",-", ",") + "q,150,100,30.01\n";
    write(at, "to.csv", &with_point);
    let (status, report, reported) = registered(at, &["register", "from.csv", "to.csv"]);
    assert_eq!(status, 0, "{reported}");
    assert!(report["rotation"][0][0].as_f64().expect("a number") > 0.9999);
    assert!(!has(&report, "convex-corner"), "{report}");
}

#[test]
fn a_plane_and_two_holes_in_it_do_not_say_which_side_is_up() {
    let folder = scratch();
    let at = folder.path();
    let plane = "id,x_mm,y_mm,z_mm,feature,nx,ny,nz\ntop,150,100,0,plane,0,0,1\n";
    let touched = |depth: f64| {
        let mut text = String::from("id,x_mm,y_mm,z_mm\n");
        for [x, y] in [[10, 20], [290, 30], [250, 190], [20, 170]] {
            writeln!(text, "top,{x},{y},0").expect("text");
        }
        for (id, [x, y]) in [("h1", [50, 50]), ("h2", [250, 150])] {
            for [dx, dy] in [[6, 0], [-6, 0], [0, 6], [0, -6]] {
                writeln!(text, "{id},{},{},{depth}", x + dx, y + dy).expect("text");
            }
        }
        text
    };
    for (depth, expected) in [(0.0, 2), (-5.0, 0)] {
        let holes = format!("h1,50,50,{depth},hole,,,\nh2,250,150,{depth},hole,,,\n");
        write(at, "from.csv", &format!("{plane}{holes}"));
        write(at, "to.csv", &touched(depth));
        let (status, _, reported) = registered(at, &["register", "from.csv", "to.csv"]);
        assert_eq!(status, expected, "{depth}: {reported}");
        assert_eq!(
            reported.contains("another pose fits as well"),
            expected == 2,
            "{reported}"
        );
    }
}

#[test]
fn touches_of_planes_count_by_their_deviations() {
    let folder = scratch();
    let at = folder.path();
    write(at, "from.csv", &format!("{CORNER}q,150,100,-30,point,,,\n"));
    // one touch is a millimetre off, and says that it is off by ten
    let off = touches().replace("150,180,0.02", "150,180,1.02") + "q,150,100,-30\n";
    write(at, "to.csv", &off);
    let z = |report: &Value| report["translation_mm"][2].as_f64().expect("a number");
    let (_, report, _) = registered(at, &["register", "from.csv", "to.csv"]);
    assert!(z(&report).abs() > 0.05, "{report}");
    for (column, sure, unsure) in [("sigma_mm", "0.01", "10"), ("weight", "1", "0.000001")] {
        let mut rows = off.lines();
        let mut text = format!("{},{column}\n", rows.next().expect("a header"));
        for row in rows {
            let value = if row.ends_with("1.02") { unsure } else { sure };
            writeln!(text, "{row},{value}").expect("text");
        }
        write(at, "to.csv", &text);
        let (status, report, reported) = registered(at, &["register", "from.csv", "to.csv"]);
        assert_eq!(status, 0, "{reported}");
        assert!(z(&report).abs() < 0.05, "{column}: {report}");
    }
}

#[test]
fn datums_of_touches_are_named_and_normals_are_of_all_or_of_none() {
    let folder = scratch();
    let at = folder.path();
    let rows = [
        [10, 10, 0],
        [190, 10, 0],
        [100, 90, 0],
        [20, 0, -10],
        [180, 0, -10],
        [0, 50, -10],
    ];
    let datums = |cells: [&str; 6]| {
        let mut text = String::from("x_mm,y_mm,z_mm,datum\n");
        for ([x, y, z], cell) in rows.iter().zip(cells) {
            writeln!(text, "{x},{y},{z},{cell}").expect("text");
        }
        write(at, "datums.csv", &text);
        registered(at, &["register", "datums.csv", "--frame", "3-2-1"])
    };
    for cells in [
        ["1", "1", "1", "2", "2", "3"],
        ["1.0", "1.0", "1.0", "2.0", "2.0", "3.0"],
        [""; 6],
    ] {
        let (status, _, reported) = datums(cells);
        assert_eq!(status, 0, "{cells:?}: {reported}");
    }
    for (cells, words) in [
        (["A", "A", "A", "B", "B", "C"], "datums.csv:2:"),
        (["1", "1", "1", "2", "2", "4"], "column datum"),
        (["1", "1", "1", "2", "2", ""], "5 of 6"),
    ] {
        let (status, _, reported) = datums(cells);
        assert!(
            status == 2 && reported.contains(words),
            "{cells:?}: {status} {reported}"
        );
    }
    let mut text = String::from("x_mm,y_mm,z_mm,nx,ny,nz\n");
    for (index, [x, y, z]) in rows.iter().enumerate() {
        let normal = if index < 3 { "0,0,1" } else { ",," };
        writeln!(text, "{x},{y},{z},{normal}").expect("text");
    }
    write(at, "datums.csv", &text);
    let with_ball = [
        "register",
        "datums.csv",
        "--frame",
        "3-2-1",
        "--probe-radius-mm",
        "2",
    ];
    let (status, _, reported) = registered(at, &with_ball);
    assert!(
        status == 2 && reported.contains("3 of 6 touches have a normal"),
        "{status} {reported}"
    );
}

const EIGHT: [[f64; 3]; 8] = [
    [-238.39, -120.91, 307.11],
    [-408.08, 60.06, 264.28],
    [-312.1, -266.91, 37.48],
    [157.43, 37.36, -24.97],
    [-67.37, 101.58, 111.39],
    [133.18, 280.46, 241.53],
    [-108.38, -187.65, 72.98],
    [11.07, 234.73, 287.78],
];
/// What one coordinate of each is off by, mm.
const OFF: [[f64; 3]; 8] = [
    [0.9, -1.1, 0.4],
    [-1.3, 0.2, 1.2],
    [0.3, 1.4, -0.8],
    [-0.7, -0.5, 1.0],
    [1.2, 0.8, -1.1],
    [-0.2, -1.3, -0.6],
    [1.1, 0.6, 0.9],
    [-1.0, 0.1, -1.2],
];

/// The eight points moved, each off by so many times [`OFF`].
fn measured(times: f64) -> Vec<[f64; 3]> {
    let one = |(p, off): (&[f64; 3], &[f64; 3])| {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|k| p[k] + times * off[k]);
        [100.0 - y, 50.0 + x, 20.0 + z]
    };
    EIGHT.iter().zip(&OFF).map(one).collect()
}

pub(super) fn points(rows: &[[f64; 3]]) -> String {
    rows.iter()
        .fold(String::from("x_mm,y_mm,z_mm\n"), |text, [x, y, z]| {
            format!("{text}{x:.4},{y:.4},{z:.4}\n")
        })
}

#[test]
fn rows_in_another_order_are_refused_and_the_order_is_named() {
    let folder = scratch();
    let at = folder.path();
    write(at, "from.csv", &points(&EIGHT));
    let good = measured(0.01);
    let mut reversed = good.clone();
    reversed.reverse();
    let mut shifted = good.clone();
    shifted.rotate_right(1);
    let mut mixed = good.clone();
    mixed.swap(0, 5);
    mixed.swap(1, 3);
    mixed.swap(2, 7);
    mixed.swap(4, 6);
    for (rows, words) in [
        (&reversed, "in the reverse order"),
        (&shifted, "1 row(s) later"),
        (&mixed, "do the rows of both files belong together"),
    ] {
        write(at, "to.csv", &points(rows));
        for more in [&[][..], &["--robust"]] {
            let mut words_of = vec!["register", "from.csv", "to.csv"];
            words_of.extend(more);
            let (status, _, reported) = registered(at, &words_of);
            assert_eq!(status, 2, "{more:?} {reported}");
            // --robust may see first that no motion has a majority
            if more.is_empty() {
                assert!(reported.contains(words), "{reported}");
            }
        }
    }
    // one bad touch among good ones is named, and refused only beyond 5 % of their spread
    let mut bad = good.clone();
    bad[3][2] += 15.0;
    write(at, "to.csv", &points(&bad));
    let (status, report, reported) = registered(at, &["register", "from.csv", "to.csv"]);
    assert_eq!(status, 0, "{reported}");
    assert!(has(&report, "suspect-touch"), "{report}");
}

/// Corners of a rectangle, with a point before and one behind: four of six rows fit in both orders.
#[test]
fn a_reverse_order_in_which_all_rows_fit_goes_before_bad_touches() {
    let folder = scratch();
    let at = folder.path();
    let corners = [
        [40.0, 60.0, 50.0],
        [0.0, 0.0, 0.0],
        [300.0, 0.0, 0.0],
        [300.0, 200.0, 0.0],
        [0.0, 200.0, 0.0],
        [250.0, 90.0, 35.0],
    ];
    let mut probed = corners.map(|[x, y, z]: [f64; 3]| [x + 10.01, y + 19.99, z + 30.0]);
    write(at, "from.csv", &points(&corners));
    write(at, "to.csv", &points(&probed));
    let (status, _, reported) = registered(at, &["register", "from.csv", "to.csv", "--robust"]);
    assert_eq!(status, 0, "{reported}");
    probed.reverse();
    write(at, "to.csv", &points(&probed));
    for more in [&[][..], &["--robust"]] {
        let command = [&["register", "from.csv", "to.csv"], more].concat();
        let (status, _, reported) = registered(at, &command);
        assert_eq!(status, 2, "{more:?} {reported}");
        assert!(reported.contains("in the reverse order"), "{reported}");
    }
}

#[test]
fn a_stated_deviation_that_the_residuals_contradict_is_said() {
    let folder = scratch();
    let at = folder.path();
    write(at, "from.csv", &points(&EIGHT));
    write(at, "to.csv", &points(&measured(1.0)));
    for (sigma, small, large) in [
        ("0.01", true, false),
        ("1", false, false),
        ("100", false, true),
    ] {
        let words = ["register", "from.csv", "to.csv", "--sigma-mm", sigma];
        let (status, report, reported) = registered(at, &words);
        assert_eq!(status, 0, "{reported}");
        assert_eq!(has(&report, "sigma-small"), small, "{sigma}: {report}");
        assert_eq!(has(&report, "sigma-large"), large, "{sigma}: {report}");
        if small {
            let scale = report["scale"]["sigma"].as_f64().expect("a number");
            // 1 mm over the root of eight squared arms of 370 mm
            assert!((5e-4..2e-3).contains(&scale), "{scale}");
        }
    }
}

pub(super) fn boards(poses: &[Pose]) -> String {
    let mut text = String::from("x_mm,y_mm,z_mm,qw,qx,qy,qz\n");
    for pose in poses {
        let [x, y, z] = pose.translation.map(|v| v * 1e3);
        let [qw, qx, qy, qz] = pose.rotation.quaternion().0;
        writeln!(text, "{x},{y},{z},{qw},{qx},{qy},{qz}").expect("text");
    }
    text
}

/// Robot and board of these tests.
pub(super) const HANDEYE: [&str; 5] = [
    "handeye",
    "robot.csv",
    "board.csv",
    "--setup",
    "eye-in-hand",
];

#[test]
fn an_inverted_board_is_one_of_the_readings_that_fit() {
    let folder = scratch();
    let at = folder.path();
    let robot = super::poses("tests/data/register/robot.csv");
    let board = super::poses("tests/data/register/board.csv");
    write(at, "robot.csv", &boards(&robot));
    write(at, "board.csv", &boards(&board));
    let (status, report, reported) = registered(at, &HANDEYE);
    assert_eq!(status, 0, "{reported}");
    assert!(!has(&report, "scale"), "{report}");
    let camera = ["x_mm", "y_mm", "z_mm"].map(|k| report["camera"][k].as_f64().expect("mm"));
    let inverted: Vec<Pose> = board.iter().map(Pose::inverse).collect();
    write(at, "board.csv", &boards(&inverted));
    let (status, _, reported) = registered(at, &HANDEYE);
    assert_eq!(status, 2, "{reported}");
    let reading = format!("camera_from_board; {:.0} mm from the flange)", norm(camera));
    for word in [
        "other --setup",
        "ROBOT inverted",
        "BOARD inverted",
        &reading,
    ] {
        assert!(reported.contains(word), "{word}: {reported}");
    }
}

#[test]
fn quaternions_with_the_scalar_last_are_named() {
    let folder = scratch();
    let at = folder.path();
    let robot = boards(&super::poses("tests/data/register/robot.csv"));
    let board = boards(&super::poses("tests/data/register/board.csv"));
    // what stands under qw, qx, qy, qz is x, y, z, w
    let last = |text: &str| {
        let mut lines = text.lines();
        let mut moved = lines.next().expect("a header").to_owned() + "\n";
        for line in lines {
            let mut cells: Vec<&str> = line.split(',').collect();
            cells[3..].rotate_left(1);
            moved += &(cells.join(",") + "\n");
        }
        moved
    };
    for (names, texts) in [
        ("BOARD's", [robot.clone(), last(&board)]),
        ("ROBOT's", [last(&robot), board.clone()]),
        ("both files'", [last(&robot), last(&board)]),
    ] {
        write(at, "robot.csv", &texts[0]);
        write(at, "board.csv", &texts[1]);
        let (status, _, reported) = registered(at, &HANDEYE);
        assert_eq!(status, 2, "{names}: {reported}");
        let advice = format!("with {names} quaternions in the order x, y, z, w it fits");
        assert!(reported.contains(&advice), "{names}: {reported}");
        assert!(!reported.contains("inverted"), "{reported}");
    }
}

#[test]
fn a_board_of_another_size_is_found() {
    let folder = scratch();
    let at = folder.path();
    let robot = super::poses("tests/data/register/robot.csv");
    let board: Vec<Pose> = super::poses("tests/data/register/board.csv")
        .into_iter()
        .map(|pose| Pose {
            translation: pose.translation.map(|v| 1.02 * v),
            ..pose
        })
        .collect();
    write(at, "robot.csv", &boards(&robot));
    write(at, "board.csv", &boards(&board));
    let (status, report, reported) = registered(at, &HANDEYE);
    assert_eq!(status, 0, "{reported}");
    assert!(has(&report, "scale"), "{report}");
    // 1 / 1.02
    assert!(report.to_string().contains("times 0.980"), "{report}");
}

#[test]
fn positions_in_another_unit_are_refused_with_its_name() {
    let folder = scratch();
    let at = folder.path();
    let robot = super::poses("tests/data/register/robot.csv");
    let board = super::poses("tests/data/register/board.csv");
    let of = |poses: &[Pose], factor: f64| -> Vec<Pose> {
        let poses = poses.iter().map(|pose| Pose {
            translation: pose.translation.map(|v| v * factor),
            ..*pose
        });
        poses.collect()
    };
    for (unit_mm, name) in [(1e3, "metres"), (10.0, "centimetres"), (25.4, "inches")] {
        for (who, factors) in [
            ("ROBOT", [1.0 / unit_mm, 1.0]),
            ("BOARD", [1.0, 1.0 / unit_mm]),
        ] {
            write(at, "robot.csv", &boards(&of(&robot, factors[0])));
            write(at, "board.csv", &boards(&of(&board, factors[1])));
            let (status, _, reported) = registered(at, &HANDEYE);
            assert_eq!(status, 2, "{who}, {name}: {reported}");
            let advice = format!("with {who}'s positions times {unit_mm} ({name}) it fits");
            assert!(reported.contains(&advice), "{advice}: {reported}");
        }
    }
}

#[test]
fn options_that_would_count_for_nothing_are_refused() {
    let folder = scratch();
    let at = folder.path();
    write(at, "from.csv", &points(&EIGHT));
    write(at, "to.csv", &points(&measured(0.1)));
    for (more, words) in [
        (&["--sigma-mm", "0"][..], "above 0"),
        (&["--icp", "--probe-radius-mm", "3"], "no effect with --icp"),
        (&["--icp", "--robust"], "no effect with --icp"),
        (&["--icp", "--drop-unmatched"], "no effect with --icp"),
    ] {
        let mut words_of = vec!["register", "from.csv", "to.csv"];
        words_of.extend(more);
        let (status, _, reported) = registered(at, &words_of);
        assert!(
            status == 2 && reported.contains(words),
            "{more:?}: {status} {reported}"
        );
    }
    let profile = crate::support::repository("robots/abb_irb120_thesis.yaml");
    let profile = profile.to_str().expect("plain");
    let plan = ["plan", "--profile", profile, "--count", "10"];
    for (more, missing) in [
        (["--cone-deg", "20"], "--device-mm"),
        (["--language", "krl"], "--program"),
    ] {
        let (status, _, reported) = run(&[&plan[..], &more[..]].concat());
        assert!(
            status == 2 && reported.contains(missing),
            "{more:?}: {status} {reported}"
        );
    }
    let joints = at.join("q.csv");
    let row = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,10,20,0,30,0\n";
    write(at, "q.csv", row);
    let joints = joints.to_str().expect("plain");
    let simulate = ["simulate", "--profile", profile, "--joints", joints];
    let (status, _, reported) = run(&[&simulate[..], &["--outlier-mm", "5"]].concat());
    assert!(
        status == 2 && reported.contains("--outliers"),
        "{status} {reported}"
    );
}
