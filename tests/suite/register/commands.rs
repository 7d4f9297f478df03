//! The commands: promised keys and bad input.

use crate::support::{poseshift, repository, scratch, text};
use serde_json::Value;
use std::path::Path;

fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = poseshift()
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program starts");
    (
        output.status.code(),
        String::from_utf8_lossy(&output.stdout).into_owned(),
        String::from_utf8_lossy(&output.stderr).into_owned(),
    )
}

fn data(name: &str) -> String {
    let path = repository("tests/data/register").join(name);
    path.to_str().expect("a plain path").to_owned()
}

#[test]
fn reports_have_the_promised_keys() {
    let folder = scratch();
    let cases: [(&[&str], &[&str]); 2] = [
        (
            &[
                "register",
                &data("from.csv"),
                &data("to.csv"),
                "--json",
                "--at",
                "1000,0,0",
            ],
            &[
                "poseshift",
                "rotation",
                "quaternion",
                "euler_xyz_deg",
                "translation_mm",
                "rmsd_mm",
                "residuals_mm",
                "sigma",
                "at",
            ],
        ),
        (
            &[
                "handeye",
                &data("robot.csv"),
                &data("board.csv"),
                "--setup",
                "eye-in-hand",
                "--json",
            ],
            &[
                "poseshift",
                "camera",
                "board",
                "by_method",
                "residual_mm",
                "residual_deg",
                "sigma",
            ],
        ),
    ];
    for (arguments, keys) in cases {
        let (status, out, reported) = run(folder.path(), arguments);
        assert_eq!(status, Some(0), "{reported}");
        let report: Value = serde_json::from_str(&out).expect("JSON and nothing else");
        for key in keys {
            assert!(!report[*key].is_null(), "{key}");
        }
    }
}

fn write(folder: &Path, name: &str, rows: &[[f64; 3]]) {
    let mut text = String::from("id,x_mm,y_mm,z_mm\n");
    for (i, [x, y, z]) in rows.iter().enumerate() {
        text += &format!("p{i},{x},{y},{z}\n");
    }
    std::fs::write(folder.join(name), text).expect("scratch");
}

#[test]
fn bad_point_sets_are_refused_by_name() {
    let folder = scratch();
    let at = folder.path();
    let good = [
        [0.0, 0.0, 0.0],
        [400.0, 0.0, 0.0],
        [400.0, 300.0, 0.0],
        [0.0, 300.0, 0.0],
        [200.0, 100.0, 90.0],
    ];
    write(at, "good.csv", &good);
    let moved = good.map(|[x, y, z]| [x + 10.0, y - 5.0, z + 2.0]);
    write(at, "two.csv", &moved[..2]);
    write(at, "line.csv", &good.map(|[x, _, _]| [x, 2.0 * x, 0.0]));
    write(at, "one.csv", &good.map(|_| [5.0, 5.0, 5.0]));
    write(at, "mirrored.csv", &good.map(|[x, y, z]| [-x, y, z]));
    write(at, "metres.csv", &moved.map(|p| p.map(|v| v / 1000.0)));
    let ids = std::fs::read_to_string(at.join("good.csv")).expect("scratch");
    std::fs::write(
        at.join("ids.csv"),
        ids.replace("p4", "q4").replace("90", "91"),
    )
    .expect("scratch");
    std::fs::write(at.join("nan.csv"), ids.replace("300", "NaN")).expect("scratch");
    write(at, "two_from.csv", &good[..2]);
    let cases = [
        ("good.csv", "good.csv", "identical"),
        ("two_from.csv", "two.csv", "2 points"),
        ("good.csv", "line.csv", "collinear"),
        ("good.csv", "one.csv", "coincide"),
        ("good.csv", "mirrored.csv", "mirror image"),
        ("good.csv", "metres.csv", "TO is in metres"),
        ("good.csv", "ids.csv", "without a partner"),
        ("good.csv", "nan.csv", "not a finite number"),
        ("good.csv", "missing.csv", "missing.csv"),
    ];
    for (from, to, message) in cases {
        let (status, out, reported) = run(at, &["register", from, to, "-o", "f.yaml"]);
        assert!(
            status == Some(2) && reported.contains(message),
            "{to}: {reported}"
        );
        assert!(out.is_empty() && !at.join("f.yaml").exists());
    }
}

#[test]
fn bad_hand_eye_sets_are_refused_with_the_reason() {
    let folder = scratch();
    let at = folder.path();
    let header = "x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
    let about_z = |sign: f64| -> String {
        (0..6)
            .map(|k| {
                let half = 0.1 * f64::from(k);
                format!(
                    "{},0,500,{},0,0,{}\n",
                    10 * k,
                    half.cos(),
                    sign * half.sin()
                )
            })
            .collect()
    };
    std::fs::write(at.join("robot.csv"), header.to_owned() + &about_z(1.0)).expect("scratch");
    std::fs::write(at.join("board.csv"), header.to_owned() + &about_z(-1.0)).expect("scratch");
    let (status, _, reported) = run(
        at,
        &[
            "handeye",
            "robot.csv",
            "board.csv",
            "--setup",
            "eye-in-hand",
        ],
    );
    assert!(
        status == Some(2) && reported.contains("one axis"),
        "{reported}"
    );
    let still: String = (0..5).map(|k| format!("{k},0,0,1,0,0,0\n")).collect();
    std::fs::write(at.join("still.csv"), header.to_owned() + &still).expect("scratch");
    let (status, _, reported) = run(
        at,
        &[
            "handeye",
            "still.csv",
            "still.csv",
            "--setup",
            "eye-in-hand",
        ],
    );
    assert!(
        status == Some(2) && reported.contains("do not rotate"),
        "{reported}"
    );
    // rows of the board one off
    let board = text("tests/data/register/board.csv");
    let lines: Vec<&str> = board.lines().collect();
    let mut shifted = vec![lines[0]];
    shifted.extend(&lines[2..]);
    shifted.push(lines[1]);
    std::fs::write(at.join("shifted.csv"), shifted.join("\n")).expect("scratch");
    let robot = data("robot.csv");
    let (status, _, reported) = run(
        at,
        &["handeye", &robot, "shifted.csv", "--setup", "eye-in-hand"],
    );
    assert!(
        status == Some(2) && reported.contains("different angles"),
        "{reported}"
    );
    // the camera is said to stand where it is carried
    let (status, _, reported) = run(
        at,
        &[
            "handeye",
            &robot,
            &data("board.csv"),
            "--setup",
            "eye-to-hand",
        ],
    );
    assert!(
        status == Some(2) && reported.contains("other --setup"),
        "{reported}"
    );
}

#[test]
fn bad_ballbar_lengths_are_refused_with_row_and_leg() {
    let folder = scratch();
    let at = folder.path();
    let head = "design,b12_mm,b23_mm,b31_mm,t12_mm,t23_mm,t31_mm,r11_mm,r21_mm,r31_mm,r12_mm,r22_mm,r23_mm";
    let good = "123/123,300,300,300,150,150,150,300,300,300,300,300,300";
    let joints = ",q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg";
    let swapped = |column: usize, cell: &str| {
        let mut cells: Vec<&str> = good.split(',').collect();
        cells[column] = cell;
        format!("{head}\n{}\n", cells.join(","))
    };
    for (text, word) in [
        (swapped(11, "930"), "r22 is likely wrong"),
        (swapped(5, "500"), "t23"),
        (swapped(7, "-300"), "r11"),
        (swapped(7, "x"), "r11_mm"),
        (swapped(7, "NaN"), "r11_mm"),
        (swapped(0, "124/123"), "124/123"),
        (format!("{head},mode\n{good},5\n"), "5"),
        (
            format!("{head}{joints}\n{good},1,2,3,4,5,6\n"),
            "4 assembly modes",
        ),
        (format!("{head},mode\n{good},1\n"), "no joints"),
    ] {
        std::fs::write(at.join("lengths.csv"), text).expect("scratch");
        let (status, out, reported) = run(at, &["hexapod", "lengths.csv", "-o", "m.csv"]);
        assert!(
            status == Some(2) && reported.contains(word),
            "{word}: {reported}"
        );
        assert!(out.is_empty() && !at.join("m.csv").exists(), "{word}");
    }
}
