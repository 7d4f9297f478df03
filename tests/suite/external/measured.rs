//! A rail measured with a device far away: its errors are found, and named as the rail's.

mod planned;

use super::landing::{arm, inverse};
use super::{profile_text, tool};
use crate::physics::external::{Rail, RailFault, carried};
use crate::physics::matrix::{frame, point};
use crate::physics::{Moment, tool_pose};
use crate::support::{poseshift, scratch};
use crate::trial::truth::robot_of;
use poseshift::model::profile::Profile;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;

/// Standard deviation of a coordinate, mm.
const NOISE_MM: f64 = 0.03;
/// What is promised along the whole rail, mm.
const HELD_OUT_MM: f64 = 0.05;
const TRACK: &str = "external_axes:\n  track:\n    - {axis: E1, direction: [0.6, 0.8, 0.0], up: \
    [0, 0, 1], zero_mm: 500, min_mm: 0, max_mm: 3000}\n";

fn rail(faults: Vec<RailFault>) -> Rail {
    Rail {
        direction: [0.6, 0.8, 0.0],
        up: [0.0, 0.0, 1.0],
        zero: 0.5,
        low: 0.0,
        high: 3.0,
        faults,
    }
}

fn bent() -> Rail {
    let rad = f64::to_radians;
    rail(vec![
        RailFault::Scale(2.5e-4),
        RailFault::Direction(rad(0.05), rad(-0.04)),
        RailFault::Bent(1, 2, 0.8e-3),
        RailFault::Bent(2, 3, -0.5e-3),
        RailFault::Turned(0, 1, rad(0.06)),
        RailFault::Turned(1, 2, rad(-0.05)),
        RailFault::Turned(2, 1, rad(0.04)),
    ])
}

/// A profile with the tool of all programs here.
pub(super) fn with_tool(external: &str, effects: &[&str]) -> String {
    let text = profile_text(external, effects);
    assert!(text.contains("tools: {}"));
    let t = tool();
    let [x, y, z] = t.flange_from_tool.translation.map(|m| 1e3 * m);
    let [rx, ry, rz] = [0.1_f64, 0.2, -0.3].map(f64::to_degrees);
    let own = format!(
        "tools: {{t: {{frame: {{x_mm: {x}, y_mm: {y}, z_mm: {z}, rx_deg: {rx}, ry_deg: {ry}, \
         rz_deg: {rz}}}, mass_kg: 2.0, cog_mm: [10, 0, 60]}}}}"
    );
    text.replace("tools: {}", &own)
}

/// What a device sees of the real tool at random postures all along the rail, with the arm's own
/// errors.
fn measured(rail: &Rail, count: usize, noise_mm: f64, seed: u64) -> String {
    let nominal = Profile::from_yaml(&with_tool(TRACK, &[])).expect("a profile");
    let (_, faults) = arm();
    let plain = robot_of(&nominal, &tool());
    let device = inverse(&frame(&[2.1, -3.3, 0.4, 0.02, -0.03, 1.1]));
    let mut random = StdRng::seed_from_u64(seed);
    let mut text =
        "id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,e1_mm,dir_e1,x_mm,y_mm,z_mm,sigma_mm\n"
            .to_owned();
    let mut before = 0.0;
    for row in 0..count {
        let q: [f64; 6] = [150.0, 60.0, 50.0, 150.0, 110.0, 170.0]
            .map(|most: f64| random.random_range(-most..most).to_radians());
        let e = random.random_range(0.0..3.0_f64);
        let direction = if e < before { -1.0 } else { 1.0 };
        before = e;
        let mut robot = plain.clone();
        robot.base = carried(rail, &plain.base, e, direction);
        let pose = tool_pose(&robot, &faults, &q, &Moment::default());
        let place = point(&device, [pose[0][3], pose[1][3], pose[2][3]]);
        let mut numbers: Vec<f64> = q.iter().map(|q| q.to_degrees()).collect();
        numbers.extend([1e3 * e, direction]);
        numbers.extend(place.map(|m| 1e3 * m + noise_mm * crate::trial::normal(&mut random)));
        numbers.push(noise_mm.max(0.001));
        let cells: Vec<String> = numbers.iter().map(|x| format!("{x:.6}")).collect();
        text += &format!("{},{}\n", row + 1, cells.join(","));
    }
    text
}

pub(super) fn put(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a writable folder");
    path
}

pub(super) fn json(arguments: &[&str], files: &[(&str, &Path)]) -> Value {
    let done = run(arguments, files);
    let reported = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(0), "{reported}");
    serde_json::from_slice(&done.stdout).expect("JSON")
}

/// What a command says that refuses what it is given.
pub(super) fn refused(arguments: &[&str], files: &[(&str, &Path)]) -> String {
    let done = run(arguments, files);
    let reported = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(done.status.code(), Some(2), "{reported}");
    reported
}

fn run(arguments: &[&str], files: &[(&str, &Path)]) -> Output {
    let mut command = poseshift();
    command.args(arguments);
    for (option, path) in files {
        command.arg(option).arg(path);
    }
    command.output().expect("the program starts")
}

/// Error of the profile on poses without noise: mean and largest, mm.
fn held_out(profile: &Path, folder: &Path, rail: &Rail) -> [f64; 2] {
    let check = put(folder, "check.csv", &measured(rail, 200, 0.0, 99));
    let files = [("--profile", profile), ("--measurements", &check)];
    let found = json(&["validate", "--json"], &files);
    // every part of the rail
    let parts = found["parts"].as_array().expect("a list");
    let parts: Vec<f64> = parts
        .iter()
        .filter(|part| part["by"] == "track")
        .map(|part| part["error"]["mean_mm"].as_f64().expect("a number"))
        .collect();
    assert_eq!(parts.len(), 5, "{found:#}");
    assert!(parts.iter().all(|mean| *mean <= HELD_OUT_MM), "{parts:?}");
    ["mean_mm", "max_mm"].map(|key| found["position"]["real"][key].as_f64().expect("a number"))
}

#[test]
fn a_rail_is_identified_from_sixty_poses() {
    let (folder, rail) = (scratch(), bent());
    let (arm, _) = arm();
    let arm: Vec<&str> = arm.iter().map(String::as_str).collect();
    let csv = put(folder.path(), "m.csv", &measured(&rail, 60, NOISE_MM, 5));
    // nothing is known; the arm is known and held
    for (known, level, identify) in [(false, "3", None), (true, "0", Some("track"))] {
        let effects = if known { &arm[..] } else { &[] };
        let profile = put(folder.path(), "p.yaml", &with_tool(TRACK, effects));
        let found = folder.path().join("found.yaml");
        let mut arguments = vec![
            "calibrate",
            "--json",
            "--level",
            level,
            "--fix",
            "tool_frame",
        ];
        if let Some(word) = identify {
            arguments.extend(["--identify", word]);
        }
        let files = [
            ("--profile", profile.as_path()),
            ("--measurements", &csv),
            ("-o", &found),
        ];
        let report = json(&arguments, &files);
        let [mean, most] = held_out(&found, folder.path(), &rail);
        assert!(
            mean <= HELD_OUT_MM && most <= 2.0 * HELD_OUT_MM,
            "{mean} {most} {report:#}"
        );
        if known {
            let all = report["parameters"].as_array().expect("a list");
            for (key, value) in [
                ("track_scale axis 1 ratio", 2.5e-4),
                ("track_straightness axis 1 along y degree 2 mm", 0.8),
                ("track_straightness axis 1 along z degree 3 mm", -0.5),
                ("track_rotation axis 1 about x degree 1 deg", 0.06),
                ("track_rotation axis 1 about y degree 2 deg", -0.05),
            ] {
                let found = all.iter().find(|p| p["key"] == key).expect(key);
                let number = |name: &str| found[name].as_f64().expect(name);
                let (gap, sigma) = (number("value") - value, number("sigma"));
                assert!(gap.abs() < 4.0 * sigma, "{key}: {gap} of {sigma}");
            }
            // no power that the rail does not have
            let is_higher = |p: &&Value| {
                p["key"]
                    .as_str()
                    .is_some_and(|key| key.contains("degree 4"))
            };
            assert_eq!(all.iter().find(is_higher), None);
        }
        std::fs::remove_file(&found).expect("written");
    }
}

#[test]
fn powers_go_as_high_as_rows_left_out_are_predicted_better() {
    let (folder, mut rail) = (scratch(), bent());
    rail.faults.push(RailFault::Bent(2, 4, 1.6e-3));
    let (arm, _) = arm();
    let arm: Vec<&str> = arm.iter().map(String::as_str).collect();
    let csv = put(folder.path(), "m.csv", &measured(&rail, 90, NOISE_MM, 6));
    let profile = put(folder.path(), "p.yaml", &with_tool(TRACK, &arm));
    let key = "track_straightness axis 1 along z degree 4 mm";
    let calibrated = |word: &str, out: &str| {
        let found = folder.path().join(out);
        let files = [
            ("--profile", profile.as_path()),
            ("--measurements", &csv),
            ("-o", &found),
        ];
        let arguments = [
            "calibrate",
            "--json",
            "--level",
            "0",
            "--fix",
            "tool_frame",
            "--identify",
            word,
        ];
        let report = json(&arguments, &files);
        let all = report["parameters"].as_array().expect("a list").clone();
        (all.into_iter().find(|p| p["key"] == key), found)
    };
    let (of_degree, found) = calibrated("track", "a.yaml");
    let of_degree = of_degree.expect(key);
    let number = |name: &str| of_degree[name].as_f64().expect(name);
    let (gap, sigma) = (number("value") - 1.6, number("sigma"));
    assert!(gap.abs() < 4.0 * sigma && sigma < 0.1, "{gap} of {sigma}");
    let [mean, most] = held_out(&found, folder.path(), &rail);
    assert!(
        mean <= HELD_OUT_MM && most <= 2.0 * HELD_OUT_MM,
        "{mean} {most}"
    );
    // who says the degrees gets these
    let words = "track_scale,track_direction,track_straightness:1:y-z:2-3,track_rotation:1:x-z:1-2";
    assert_eq!(calibrated(words, "b.yaml").0, None);
}

#[test]
fn files_and_profiles_must_speak_of_the_same_axes() {
    let folder = scratch();
    let csv = measured(&bent(), 60, NOISE_MM, 5);
    let mismatch = |profile: &str, csv: &str, words: [&str; 2]| {
        let profile = put(folder.path(), "p.yaml", profile);
        let csv = put(folder.path(), "m.csv", csv);
        for command in ["calibrate", "validate", "diagnose"] {
            let files = [("--profile", profile.as_path()), ("--measurements", &csv)];
            let reported = refused(&[command], &files);
            assert!(
                words.iter().all(|word| reported.contains(word)),
                "{reported}"
            );
        }
    };
    let bare = with_tool("", &[]);
    mismatch(&bare, &csv, ["e1_mm", "external_axes"]);
    let track = with_tool(TRACK, &[]);
    let without = csv.replace("e1_mm", "note");
    mismatch(&track, &without, ["E1", "e1_mm"]);
    mismatch(&track, &csv.replace("e1_mm", "e1_deg"), ["e1_deg", "e1_mm"]);
    mismatch(&track.replace("3000", "900"), &csv, ["limits of E1", "900"]);
    let both = csv.replace("dir_e1", "e1_deg");
    mismatch(&track, &both, ["e1_mm", "e1_deg"]);
}

/// The effects of a diagnosis, and those that explain as much.
fn diagnosed(rail: &Rail, folder: &Path) -> (Vec<Value>, Vec<Value>) {
    let (arm, _) = arm();
    let arm: Vec<&str> = arm.iter().map(String::as_str).collect();
    let profile = put(folder, "p.yaml", &with_tool(TRACK, &arm));
    let csv = put(folder, "m.csv", &measured(rail, 60, NOISE_MM, 11));
    let files = [("--profile", profile.as_path()), ("--measurements", &csv)];
    let found = json(&["diagnose", "--json"], &files);
    let list = |key: &str| found[key].as_array().expect("a list").clone();
    (list("effects"), list("alternatives"))
}

#[test]
fn an_error_of_the_rail_is_named_as_the_rails() {
    let folder = scratch();
    let rad = f64::to_radians;
    // each moves the tool by about twice the noise, root mean square
    for (fault, effect, key, value) in [
        (
            RailFault::Turned(0, 1, rad(0.018)),
            "track_rotation",
            "about",
            "x",
        ),
        (
            RailFault::Turned(1, 1, rad(0.016)),
            "track_rotation",
            "about",
            "y",
        ),
        (
            RailFault::Direction(rad(0.007), 0.0),
            "track_direction",
            "axis",
            "",
        ),
        (
            RailFault::Bent(2, 2, 0.24e-3),
            "track_straightness",
            "along",
            "z",
        ),
        (RailFault::Scale(1.2e-4), "track_scale", "axis", ""),
    ] {
        let (effects, alternatives) = diagnosed(&rail(vec![fault.clone()]), folder.path());
        assert_eq!(effects.len(), 1, "{fault:?} {effects:#?}");
        assert_eq!(effects[0]["effect"], effect, "{effects:#?}");
        assert!(value.is_empty() || effects[0][key] == value, "{effects:#?}");
        let of_rail = |e: &Value| {
            e["effect"]
                .as_str()
                .is_some_and(|id| id.starts_with("track_"))
        };
        assert!(
            alternatives.iter().all(of_rail),
            "{fault:?} {alternatives:#?}"
        );
    }
    let (effects, _) = diagnosed(&rail(Vec::new()), folder.path());
    assert!(effects.is_empty(), "{effects:#?}");
}

#[test]
fn simulated_measurements_are_identified_again() {
    let folder = scratch();
    let truth = [
        "{effect: track_scale, axis: 1, ratio: 3.0e-4}",
        "{effect: track_straightness, axis: 1, along: y, degree: 4, mm: 0.6}",
        "{effect: track_ripple, axis: 1, along: x, period_mm: 25, cos_mm: 0.06, sin_mm: -0.04}",
        "{effect: track_backlash, axis: 1, width_mm: 0.15}",
    ];
    let robot = put(folder.path(), "robot.yaml", &with_tool(TRACK, &truth));
    let rows = measured(&rail(Vec::new()), 80, 0.0, 21);
    let joints: String = rows
        .lines()
        .map(|line| line.split(',').take(8).collect::<Vec<_>>().join(",") + "\n")
        .collect();
    let joints = put(folder.path(), "joints.csv", &joints);
    let made = folder.path().join("made.csv");
    let files = [
        ("--profile", robot.as_path()),
        ("--joints", &joints),
        ("-o", &made),
    ];
    json(&["simulate", "--json", "--noise-mm", "0.02"], &files);
    let text = std::fs::read_to_string(&made).expect("written");
    assert!(
        text.lines()
            .next()
            .is_some_and(|head| head.contains("e1_mm,dir_e1")),
        "{text}"
    );
    let nominal = put(folder.path(), "nominal.yaml", &with_tool(TRACK, &[]));
    let words = "track_scale,track_straightness:1:y:4,track_ripple:1:x:25,track_backlash";
    let arguments = [
        "calibrate",
        "--json",
        "--identify",
        words,
        "--fix",
        "tool_frame",
    ];
    let files = [("--profile", nominal.as_path()), ("--measurements", &made)];
    let report = json(&arguments, &files);
    let all = report["parameters"].as_array().expect("a list");
    for (key, value) in [
        ("track_scale axis 1 ratio", 3.0e-4),
        ("track_straightness axis 1 along y degree 4 mm", 0.6),
        ("track_ripple axis 1 along x period_mm 25 cos_mm", 0.06),
        ("track_ripple axis 1 along x period_mm 25 sin_mm", -0.04),
        ("track_backlash axis 1 width_mm", 0.15),
    ] {
        let found = all.iter().find(|p| p["key"] == key);
        let found = found.unwrap_or_else(|| panic!("{key}: {report:#}"));
        let number = |name: &str| found[name].as_f64().expect(name);
        let (gap, sigma) = (number("value") - value, number("sigma"));
        assert!(gap.abs() < 4.0 * sigma, "{key}: {gap} of {sigma}");
    }
    // a positioner is not seen on the tool, another axis is not there
    for (word, says) in [
        ("positioner_zero", "points on the plate"),
        ("track_scale:2", "linear axis of that number"),
        ("track_ripple:1:x", "period"),
    ] {
        let files = [("--profile", nominal.as_path()), ("--measurements", &made)];
        let reported = refused(&["calibrate", "--identify", word], &files);
        assert!(reported.contains(says), "{reported}");
    }
}

#[test]
fn fk_is_the_reference_along_the_rail() {
    let folder = scratch();
    let (arm, _) = arm();
    let mut effects: Vec<&str> = arm.iter().map(String::as_str).collect();
    effects.extend([
        "{effect: track_scale, axis: 1, ratio: 2.5e-4}",
        "{effect: track_direction, axis: 1, y_deg: 0.05, z_deg: -0.04}",
        "{effect: track_straightness, axis: 1, along: y, degree: 2, mm: 0.8}",
        "{effect: track_straightness, axis: 1, along: z, degree: 3, mm: -0.5}",
        "{effect: track_rotation, axis: 1, about: x, degree: 1, deg: 0.06}",
        "{effect: track_rotation, axis: 1, about: y, degree: 2, deg: -0.05}",
        "{effect: track_rotation, axis: 1, about: z, degree: 1, deg: 0.04}",
    ]);
    let profile = put(folder.path(), "p.yaml", &with_tool(TRACK, &effects));
    let seen = measured(&bent(), 25, 0.0, 4);
    let table = put(folder.path(), "m.csv", &seen);
    let done = poseshift()
        .args(["fk", "--profile"])
        .arg(&profile)
        .arg("--joints")
        .arg(&table)
        .output()
        .expect("the program starts");
    let reported = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(done.status.code(), Some(0), "{reported}");
    let text = String::from_utf8(done.stdout).expect("ASCII");
    let device = frame(&[2.1, -3.3, 0.4, 0.02, -0.03, 1.1]);
    let numbers = |line: &str, from: usize| -> [f64; 3] {
        let cells: Vec<f64> = line
            .split(',')
            .skip(from)
            .take(3)
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        cells.try_into().expect("three of them")
    };
    assert_eq!(text.lines().count(), 26);
    for (mine, row) in text.lines().zip(seen.lines()).skip(1) {
        // the file has six decimals of a degree and of a millimetre
        let place = point(&device, numbers(row, 9).map(|mm| 1e-3 * mm)).map(|m| 1e3 * m);
        let mine_mm = numbers(mine, 1);
        let gap = mine_mm.iter().zip(place).map(|(a, b)| (a - b).abs());
        assert!(gap.fold(0.0, f64::max) < 1e-4, "{mine} {place:?}");
    }
}
