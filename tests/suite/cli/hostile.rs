//! Measurements that nobody measured: each is refused or reported with file, line, value and limit.

use crate::support::{poseshift, repository, scratch};
use serde_json::Value;
use std::path::Path;

const TRUTH: &str = "robots/abb_irb120_thesis.yaml";

/// Status, report and what is reported.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, Value, String) {
    let output = poseshift()
        .current_dir(folder)
        .args(arguments)
        .arg("--profile")
        .arg(repository(TRUTH))
        .arg("--json")
        .output()
        .expect("the program starts");
    (
        output.status.code(),
        serde_json::from_slice(&output.stdout).unwrap_or(Value::Null),
        String::from_utf8_lossy(&output.stderr).into_owned(),
    )
}

/// A folder with the measurements `m.csv` of 40 planned configurations, and these as cells; the
/// first row is the header.
fn measured() -> (tempfile::TempDir, Vec<Vec<String>>) {
    let folder = scratch();
    for arguments in [
        &[
            "plan",
            "--count",
            "40",
            "--candidates",
            "400",
            "-o",
            "q.csv",
        ][..],
        &[
            "simulate",
            "--joints",
            "q.csv",
            "--noise-mm",
            "0.03",
            "-o",
            "m.csv",
        ],
    ] {
        let (status, _, reported) = run(folder.path(), arguments);
        assert_eq!(status, Some(0), "{reported}");
    }
    let text = std::fs::read_to_string(folder.path().join("m.csv")).expect("measurements");
    let rows = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect());
    let rows = rows.collect();
    (folder, rows)
}

fn write(folder: &Path, name: &str, rows: &[Vec<String>]) {
    let lines: Vec<String> = rows.iter().map(|row| row.join(",")).collect();
    std::fs::write(folder.join(name), lines.join("\n") + "\n").expect("scratch");
}

fn column(rows: &[Vec<String>], name: &str) -> usize {
    let at = rows[0].iter().position(|column| column == name);
    at.expect("a column of the file")
}

fn finding<'a>(report: &'a Value, id: &str) -> &'a Value {
    let findings = report["findings"].as_array().expect("findings");
    let found = findings.iter().find(|finding| finding["id"] == id);
    found.unwrap_or_else(|| panic!("no {id} in {findings:?}"))
}

#[test]
fn numbers_and_points_out_of_the_world_are_refused_with_their_line() {
    let (folder, rows) = measured();
    for (name, value, words) in [
        (
            "x_mm",
            "1e300",
            ["m.csv:6:", "x_mm: 1e300 is beyond", "1e8 mm"],
        ),
        (
            "q2_deg",
            "-1e300",
            ["m.csv:6:", "q2_deg: -1e300 is beyond", "1e5 deg"],
        ),
        ("z_mm", "9e7", ["line 6", "8999", "limit is 100 times"]),
    ] {
        let mut bad = rows.clone();
        bad[5][column(&rows, name)] = value.into();
        write(folder.path(), "m.csv", &bad);
        for command in ["calibrate", "validate"] {
            let (status, _, reported) = run(folder.path(), &[command, "--measurements", "m.csv"]);
            assert_eq!(status, Some(2), "{command} {name}: {reported}");
            for word in words {
                assert!(reported.contains(word), "{command} {word}: {reported}");
            }
        }
    }
}

#[test]
fn points_in_one_place_and_poses_that_are_one_are_reported_with_the_evidence() {
    let (folder, rows) = measured();
    let x = column(&rows, "x_mm");
    let mut still = rows.clone();
    let first: Vec<String> = rows[1][x..x + 3].to_vec();
    for row in &mut still[1..] {
        row.splice(x..x + 3, first.clone());
    }
    write(folder.path(), "m.csv", &still);
    let (status, _, reported) = run(folder.path(), &["calibrate", "--measurements", "m.csv"]);
    assert!(
        status == Some(2) && reported.contains("all 40 measured points are in one place"),
        "{reported}"
    );

    let mut copies = vec![rows[0].clone()];
    copies.extend(std::iter::repeat_n(rows[1].clone(), 50));
    write(folder.path(), "m.csv", &copies);
    let (status, _, reported) = run(folder.path(), &["calibrate", "--measurements", "m.csv"]);
    assert_eq!(status, Some(2), "{reported}");
    for word in [
        "all 50 rows have the same pose",
        "49 rows repeat",
        "line 3",
        "0.5 deg",
    ] {
        assert!(reported.contains(word), "{word}: {reported}");
    }
    let (status, report, reported) = run(folder.path(), &["validate", "--measurements", "m.csv"]);
    assert_eq!(status, Some(0), "{reported}");
    assert_eq!(finding(&report, "duplicate-rows")["line"], 3);
    let variety = finding(&report, "little-variety")["message"].as_str();
    assert!(
        variety.is_some_and(|m| m.contains("all 50 rows")),
        "{variety:?}"
    );
}

#[test]
fn what_is_found_in_one_of_several_files_names_it() {
    let (folder, rows) = measured();
    let mut second = vec![rows[0].clone()];
    second.extend(rows[21..].iter().cloned());
    // a copy of a row of the other file, and a beam that was lost
    second[4] = rows[2].clone();
    let z = column(&rows, "z_mm");
    let lost = second[9][z].parse::<f64>().expect("a number") + 7.0;
    second[9][z] = lost.to_string();
    write(folder.path(), "a.csv", &rows[..21]);
    write(folder.path(), "b.csv", &second);
    let files = ["--measurements", "a.csv", "--measurements", "b.csv"];
    for command in ["calibrate", "validate"] {
        let arguments = [&[command][..], &files].concat();
        let (status, report, reported) = run(folder.path(), &arguments);
        assert_eq!(status, Some(0), "{reported}");
        let copy = finding(&report, "duplicate-rows");
        assert_eq!((&copy["file"], &copy["line"]), (&"b.csv".into(), &5.into()));
        let message = copy["message"].as_str().expect("a message");
        assert!(
            message.contains("in line 5 of b.csv that of line 3 of a.csv"),
            "{message}"
        );
        if command == "calibrate" {
            let remark = finding(&report, "outliers");
            assert_eq!(
                (&remark["file"], &remark["line"]),
                (&"b.csv".into(), &10.into())
            );
            let outlier = &report["outliers"][0];
            assert_eq!(
                (&outlier["file"], &outlier["line"]),
                (&"b.csv".into(), &10.into())
            );
        }
    }
    let tool = column(&rows, "tool");
    second[7][tool] = "gripper".into();
    write(folder.path(), "b.csv", &second);
    let (status, _, reported) = run(folder.path(), &[&["calibrate"][..], &files].concat());
    assert!(
        status == Some(2)
            && reported.contains("line 8 of b.csv: the profile has no tool `gripper`"),
        "{reported}"
    );
}

/// Numbers that no arm has, given to commands that compute without measurements: refused with the
/// number, or said in words.
#[test]
fn what_is_no_finite_number_is_never_an_answer() {
    let folder = scratch();
    let text =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("scratch");
    let truth = std::fs::read_to_string(repository(TRUTH)).expect("a profile");
    let effect = "  effects:\n    - {effect: joint_scale, joint: 1, ratio: 1e300, large: true, reason: wild}\n";
    text("wild.yaml", &truth.replacen("  effects:\n", effect, 1));
    text("truth.yaml", &truth);
    let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
    text("q.csv", &format!("{header}10,-20,30,40,50,60\n"));
    text("far.csv", &format!("{header}10,-20,30,40,1e300,60\n"));
    let robot = std::fs::read_to_string(repository("docs/measuring/robot.csv")).expect("poses");
    let mut rows: Vec<String> = robot.lines().map(str::to_owned).collect();
    let (_, rest) = rows[3].split_once(',').expect("cells");
    rows[3] = format!("1e160,{rest}");
    text("robot.csv", &(rows.join("\n") + "\n"));
    let board = repository("docs/measuring/board.csv");
    let board = board.to_str().expect("a name");
    let cases: [(&[&str], i32, &str); 12] = [
        (
            &["simulate", "--profile", "truth.yaml", "--joints", "far.csv"],
            2,
            "`1e300` is beyond \u{b1}1e12",
        ),
        (
            &["fk", "--profile", "truth.yaml", "--joints", "far.csv"],
            2,
            "`1e300` is beyond \u{b1}1e12",
        ),
        (
            &["simulate", "--profile", "wild.yaml", "--joints", "q.csv"],
            2,
            "has no finite position",
        ),
        (
            &["fk", "--profile", "wild.yaml", "--joints", "q.csv"],
            2,
            "has no finite pose",
        ),
        (
            &[
                "simulate",
                "--profile",
                "truth.yaml",
                "--joints",
                "q.csv",
                "--noise-mm",
                "1e308",
            ],
            2,
            "must be from 0 to 1000000",
        ),
        (
            &[
                "simulate",
                "--profile",
                "truth.yaml",
                "--joints",
                "q.csv",
                "--outlier-mm",
                "inf",
            ],
            2,
            "must be from 0 to 1000000",
        ),
        (
            &[
                "simulate",
                "--profile",
                "truth.yaml",
                "--joints",
                "q.csv",
                "--interval-s=inf",
            ],
            2,
            "--interval-s is inf; it must be from 0 to 1000000",
        ),
        (
            &[
                "simulate",
                "--profile",
                "truth.yaml",
                "--joints",
                "q.csv",
                "--interval-s=-1",
            ],
            2,
            "--interval-s is -1;",
        ),
        (
            &[
                "simulate",
                "--profile",
                "truth.yaml",
                "--joints",
                "q.csv",
                "--temperature-c=1e308,20",
            ],
            2,
            "it must be from -273.15 to 1000",
        ),
        (
            &[
                "simulate",
                "--profile",
                "truth.yaml",
                "--joints",
                "q.csv",
                "--kind",
                "distance",
                "--from=1e200,0,0",
            ],
            2,
            "it must be from -100000000 to 100000000",
        ),
        (
            &["profile", "show", "wild.yaml"],
            0,
            "at no finite distance",
        ),
        (
            &["handeye", "robot.csv", board, "--setup", "eye-in-hand"],
            2,
            "`1e160` is beyond \u{b1}1e12",
        ),
    ];
    for (arguments, status, said) in cases {
        let output = poseshift()
            .current_dir(folder.path())
            .args(arguments)
            .output()
            .expect("the program starts");
        let streams =
            [&output.stdout, &output.stderr].map(|s| String::from_utf8_lossy(s).into_owned());
        let words: Vec<&str> = streams.iter().flat_map(|s| s.split_whitespace()).collect();
        let all = words.join(" ");
        assert_eq!(output.status.code(), Some(status), "{arguments:?}: {all}");
        assert!(all.contains(said), "{arguments:?}: {all}");
        let is_none =
            |word: &str| matches!(word, "NaN" | "nan" | "-inf") || word == "inf" && status == 0;
        let mut pieces = all.split([' ', ',', '(', ')', ':']);
        assert!(!pieces.any(is_none), "{arguments:?}: {all}");
    }
}

#[test]
fn an_arm_that_is_nowhere_judges_neither_measurements_nor_programs() {
    let (folder, _) = measured();
    let at = folder.path();
    let truth = std::fs::read_to_string(repository(TRUTH)).expect("a profile");
    let scale = "  effects:\n    - {effect: joint_scale, joint: 1, ratio: 1e308, large: true, reason: wild}\n";
    let heavy = truth.replacen("  effects:\n", scale, 1);
    std::fs::write(at.join("heavy.yaml"), heavy).expect("scratch");
    std::fs::write(at.join("truth.yaml"), truth).expect("scratch");
    let sample = std::fs::read_to_string(repository("programs/rapid/olp/in/Deburr.mod"));
    let sample = sample.expect("a program");
    let load = "[1.4,[0,0,60]";
    assert!(sample.contains(load));
    let far = sample.replacen(load, "[1.4,[0,0,1e308]", 1);
    std::fs::write(at.join("a.mod"), sample).expect("scratch");
    std::fs::write(at.join("far.mod"), far).expect("scratch");
    let cases: [(&[&str], i32, &str); 6] = [
        (
            &["validate", "--measurements", "m.csv"],
            2,
            "m.csv: line 2: the model",
        ),
        (
            &["calibrate", "--measurements", "m.csv", "-o", "c.yaml"],
            2,
            "m.csv: line 2: the model",
        ),
        (
            &["diagnose", "--measurements", "m.csv"],
            2,
            "m.csv: line 2: the model",
        ),
        (
            &["plan", "--count", "20", "--level", "3"],
            2,
            "parameters shows",
        ),
        (
            &["check", "a.mod", "--max-path-error", "0.1"],
            1,
            "not-finite",
        ),
        (&["check", "a.mod", "--json"], 1, "not-finite"),
    ];
    for (arguments, status, said) in cases {
        let profile = ["--profile", "heavy.yaml"];
        refused(at, &[arguments, &profile].concat(), status, said);
        assert!(!at.join("c.yaml").exists());
    }
    let check = ["check", "far.mod", "--profile", "truth.yaml"];
    refused(at, &check, 2, "the centre of gravity of tool `rdkTool`");
    let check = ["check", "a.mod", "--profile", "heavy.yaml", "--json"];
    let report = refused(at, &check, 1, "not-finite");
    let report: Value = serde_json::from_str(&report).expect("a report");
    assert_eq!(report["summary"]["max_target_error_mm"], Value::Null);
}

/// Asserts that a command ends so and says this; its standard output.
#[test]
fn files_larger_than_any_that_is_meant_are_refused_at_once() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let large = |name: &str, bytes: u64| {
        let file = std::fs::File::create(folder.path().join(name)).expect("scratch");
        file.set_len(bytes).expect("a file of zeros");
    };
    large("large.yaml", 65 << 20);
    large("large.urdf", 65 << 20);
    large("huge.csv", (1 << 30) + 1);
    let truth = repository(TRUTH).display().to_string();
    let of_texts = "at most 67108864 are read";
    refused(
        folder.path(),
        &["profile", "show", &at("large.yaml")],
        2,
        of_texts,
    );
    let urdf = ["profile", "from-urdf", &at("large.urdf"), "-o", "p.yaml"];
    refused(folder.path(), &urdf, 2, of_texts);
    let program = repository("programs/rapid/olp/in/Deburr.mod")
        .display()
        .to_string();
    let cell = [
        "check",
        &program,
        "--profile",
        &truth,
        "--cell",
        &at("large.yaml"),
    ];
    refused(folder.path(), &cell, 2, of_texts);
    let rows = [
        "validate",
        "--profile",
        &truth,
        "--measurements",
        &at("huge.csv"),
    ];
    let of_others = "at most 1073741824 are read";
    refused(folder.path(), &rows, 2, of_others);
    let of_mesh = |name: &str| {
        large(name, (1 << 30) + 1);
        let text = format!("poseshift: cell/1\nbodies:\n  - {{name: wall, mesh: {name}}}\n");
        std::fs::write(folder.path().join("cell.yaml"), text).expect("scratch");
        let cell = at("cell.yaml");
        let check = ["check", &program, "--profile", &truth, "--cell", &cell];
        refused(folder.path(), &check, 2, of_others);
    };
    for name in ["wall.stl", "wall.obj", "wall.dae", "wall.gltf", "wall.glb"] {
        of_mesh(name);
    }
}

fn refused(folder: &Path, arguments: &[&str], status: i32, said: &str) -> String {
    let output = poseshift()
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program starts");
    let out = String::from_utf8_lossy(&output.stdout).into_owned();
    let all = out.clone() + &String::from_utf8_lossy(&output.stderr);
    let all = all.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {all}");
    assert!(all.contains(said), "{arguments:?}: {all}");
    out
}
