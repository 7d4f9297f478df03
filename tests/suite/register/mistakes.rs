//! Input that fits more than one answer, or none: said, not guessed.

use crate::support::{run, scratch};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

/// Runs with files of the folder in the place of names that end in `.csv`.
fn registered(folder: &Path, arguments: &[&str]) -> (i32, Value, String) {
    let path = |name: &str| folder.join(name).to_str().expect("plain").to_owned();
    let words: Vec<String> = arguments
        .iter()
        .map(|word| match Path::new(word).extension() {
            Some(_) => path(word),
            None => (*word).to_owned(),
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

fn has(report: &Value, id: &str) -> bool {
    let findings = report["findings"].as_array().expect("findings");
    findings.iter().any(|finding| finding["id"] == id)
}

fn write(folder: &Path, name: &str, text: &str) {
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
