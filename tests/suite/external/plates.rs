//! Positioners measured by reflectors on their plates: hidden errors are found, and what cannot
//! tell them is refused.

mod circles;

use super::landing::{arm, inverse};
use super::measured::{json, put, refused, with_tool};
use super::tool;
use crate::physics::external::{Table, TableFault, plate};
use crate::physics::matrix::{M4, cross, dot, frame, point, times, turn_z};
use crate::physics::{Moment, tool_pose};
use crate::support::{poseshift, scratch};
use crate::trial::truth::robot_of;
use poseshift::model::profile::Profile;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::path::Path;

/// Standard deviation of a coordinate, mm.
pub(super) const NOISE_MM: f64 = 0.03;
/// What is promised at angles that were not measured, mm.
const HELD_OUT_MM: f64 = 0.05;
/// Where the device stands.
const DEVICE: [f64; 6] = [2.1, -3.3, 0.4, 0.02, -0.03, 1.1];
const ONE: &str = "        - {axis: E1, at: {x_mm: 700, y_mm: -150, z_mm: 600, rx_deg: 5, ry_deg: \
    20, rz_deg: 40}, sign: -1, zero_deg: 10, min_deg: -180, max_deg: 180}\n";
const TWO: &str = "        - {axis: E2, at: {x_mm: 40, y_mm: 0, z_mm: 120, rx_deg: -85, ry_deg: 3, \
    rz_deg: 0}, min_deg: -180, max_deg: 180}\n";
pub(super) const REFLECTORS: [[f64; 3]; 3] = [
    [0.30, 0.05, 0.02],
    [-0.18, 0.24, 0.11],
    [-0.05, -0.28, 0.19],
];
const ON_AXIS: [f64; 6] = [0.02, -0.01, 0.05, 0.1, -0.2, 0.3];

pub(super) fn section(axes: usize) -> String {
    let [x, y, z, rx, ry, rz] = ON_AXIS;
    let [x, y, z] = [x, y, z].map(|m| 1e3 * m);
    let [rx, ry, rz] = [rx, ry, rz].map(f64::to_degrees);
    let head = "external_axes:\n  positioners:\n    - name: STN1\n      axes:\n";
    let axes = [ONE, TWO][..axes].concat();
    format!(
        "{head}{axes}      plate: {{x_mm: {x}, y_mm: {y}, z_mm: {z}, rx_deg: {rx}, ry_deg: {ry}, \
         rz_deg: {rz}}}\n"
    )
}

/// A profile with these external axes whose device stands where it is known to.
fn in_world(section: &str) -> String {
    let place = "world_from_device: {pose: {x_mm: 2100, y_mm: -3300, z_mm: 400, rx_deg: \
        1.1459155902616465, ry_deg: -1.7188733853924696, rz_deg: 63.02535746439057}}";
    let plain = with_tool(section, &[]);
    assert!(plain.contains("calibration: {"));
    plain.replace("calibration: {", &format!("calibration: {{{place}, "))
}

/// What is hidden. The zero of the last axis and the plate are where the reflectors are.
fn hidden(axes: usize) -> (Vec<Table>, [f64; 6]) {
    let rad = f64::to_radians;
    let mut first = vec![
        TableFault::Axis([1.1e-3, -0.7e-3, rad(0.08), rad(-0.06)]),
        TableFault::Scale(2.0e-4),
        TableFault::Ripple(2.0, rad(0.01), rad(-0.02)),
        TableFault::Runout(2, 1.0, 0.1e-3, 0.05e-3),
    ];
    if axes == 1 {
        first.push(TableFault::Zero(rad(0.05)));
    }
    let mut tables = vec![Table {
        at: frame(&[0.7, -0.15, 0.6, rad(5.0), rad(20.0), rad(40.0)]),
        sign: -1.0,
        zero: rad(10.0),
        faults: first,
    }];
    if axes == 2 {
        tables.push(Table {
            at: frame(&[0.04, 0.0, 0.12, rad(-85.0), rad(3.0), 0.0]),
            sign: 1.0,
            zero: 0.0,
            faults: vec![
                TableFault::Axis([-0.5e-3, 0.4e-3, rad(-0.03), rad(0.05)]),
                TableFault::Scale(-1.5e-4),
                TableFault::Zero(rad(-0.04)),
            ],
        });
    }
    let fault = [0.6e-3, -0.4e-3, 0.3e-3, rad(0.04), rad(-0.05), rad(0.06)];
    (tables, fault)
}

/// A cell with one or two axes, and a device that sees both its tool and its plate.
pub(super) struct Cell {
    pub(super) axes: usize,
    pub(super) tables: Vec<Table>,
    pub(super) fault: [f64; 6],
    device: M4,
}

impl Cell {
    pub(super) fn new(axes: usize) -> Self {
        let (tables, fault) = hidden(axes);
        Self {
            axes,
            tables,
            fault,
            device: inverse(&frame(&DEVICE)),
        }
    }

    pub(super) fn header(&self) -> String {
        let e = ["e1_deg", "e2_deg"][..self.axes].join(",");
        format!(
            "id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,{e},x_mm,y_mm,z_mm,sigma_mm,on,point\n"
        )
    }

    fn cells(&self, place: [f64; 3], noise_mm: f64, random: &mut StdRng) -> String {
        let seen = point(&self.device, place);
        let seen = seen.map(|m| 1e3 * m + noise_mm * crate::trial::normal(random));
        let cells = seen.map(|x| format!("{x:.6}"));
        format!("{},{}", cells.join(","), noise_mm.max(0.001))
    }

    /// The tool at random postures.
    pub(super) fn of_tool(&self, count: usize, noise_mm: f64, random: &mut StdRng) -> String {
        let nominal = Profile::from_yaml(&with_tool("", &[])).expect("a profile");
        let robot = robot_of(&nominal, &tool());
        let (_, faults) = arm();
        let mut rows = String::new();
        for row in 0..count {
            let q: [f64; 6] = [150.0, 60.0, 50.0, 150.0, 110.0, 170.0]
                .map(|most: f64| random.random_range(-most..most).to_radians());
            let pose = tool_pose(&robot, &faults, &q, &Moment::default());
            let joints = q.map(|q| format!("{:.6}", q.to_degrees())).join(",");
            let none = ",".repeat(self.axes - 1);
            let seen = self.cells([pose[0][3], pose[1][3], pose[2][3]], noise_mm, random);
            rows += &format!("t{row},{joints},{none},{seen},tool,tcp\n");
        }
        rows
    }

    /// Reflectors on the plate at angles.
    pub(super) fn of_plate(
        &self,
        angles: &[Vec<f64>],
        noise_mm: f64,
        random: &mut StdRng,
    ) -> String {
        let mut rows = String::new();
        for (n, e) in angles.iter().enumerate() {
            let rad: Vec<f64> = e.iter().map(|e| e.to_radians()).collect();
            let pose = plate(&self.tables, &frame(&ON_AXIS), &self.fault, &rad);
            for (k, reflector) in REFLECTORS.iter().enumerate() {
                let e: Vec<String> = e.iter().map(|e| format!("{e:.4}")).collect();
                let seen = self.cells(point(&pose, *reflector), noise_mm, random);
                let e = e.join(",");
                rows += &format!("p{n},,,,,,,{e},{seen},plate:STN1,r{k}\n");
            }
        }
        rows
    }

    /// Angles all round, of several axes every one at several of the others.
    pub(super) fn angles(&self, count: usize, random: &mut StdRng) -> Vec<Vec<f64>> {
        let one = |_| -> Vec<f64> {
            let each = (0..self.axes).map(|_| random.random_range(-170.0..170.0_f64));
            each.map(|e| (e * 100.0).round() / 100.0).collect()
        };
        (0..count).map(one).collect()
    }
}

/// What `calibrate` finds of a positioner: its parameters by key.
fn value(list: &Value, key: &str) -> (f64, f64) {
    let all = list.as_array().expect("a list");
    let found = all.iter().find(|p| p["key"] == key);
    let found = found.unwrap_or_else(|| panic!("{key} of {list:#}"));
    let number = |name: &str| {
        found[name]
            .as_f64()
            .unwrap_or_else(|| panic!("{key}: {found}"))
    };
    (number("value"), number("sigma"))
}

/// Mean and largest error of a profile on points that were not measured, without noise, mm.
fn held_out(profile: &Path, folder: &Path, cell: &Cell) -> [f64; 2] {
    let mut random = StdRng::seed_from_u64(77);
    let angles = cell.angles(60, &mut random);
    let text = cell.header() + &cell.of_plate(&angles, 0.0, &mut random);
    let check = put(folder, "check.csv", &text);
    let files = [("--profile", profile), ("--measurements", &check)];
    let found = json(&["validate", "--json"], &files);
    // every part of the turn
    let parts = found["parts"].as_array().expect("a list");
    let parts: Vec<f64> = parts
        .iter()
        .filter(|part| part["by"] == "positioner")
        .map(|part| part["error"]["mean_mm"].as_f64().expect("a number"))
        .collect();
    assert_eq!(parts.len(), 5 * cell.axes, "{found:#}");
    assert!(parts.iter().all(|mean| *mean <= HELD_OUT_MM), "{parts:?}");
    ["mean_mm", "max_mm"].map(|key| found["position"]["real"][key].as_f64().expect("a number"))
}

/// Hidden errors of a positioner with so many axes, the arm's as well or known.
fn recovers(axes: usize, stops: usize, arm_known: bool) {
    let (folder, cell) = (scratch(), Cell::new(axes));
    let mut random = StdRng::seed_from_u64(5);
    let angles = cell.angles(stops, &mut random);
    let text = cell.header()
        + &cell.of_tool(60, NOISE_MM, &mut random)
        + &cell.of_plate(&angles, NOISE_MM, &mut random);
    let csv = put(folder.path(), "m.csv", &text);
    let (effects, _) = arm();
    let effects: Vec<&str> = effects.iter().map(String::as_str).collect();
    let effects = if arm_known { &effects[..] } else { &[] };
    let text = with_tool(&section(axes), effects).replace("points: {}", "points: {tcp: [0, 0, 0]}");
    assert!(text.contains("tcp"));
    let profile = put(folder.path(), "p.yaml", &text);
    let found = folder.path().join("found.yaml");
    let files = [
        ("--profile", profile.as_path()),
        ("--measurements", &csv),
        ("-o", &found),
    ];
    let mut arguments = vec!["calibrate", "--json", "--fix", "tool_frame"];
    if arm_known {
        arguments.extend(["--level", "0", "--identify", "positioner"]);
    }
    let report = json(&arguments, &files);
    let plates = &report["plates"];
    let mean = |of: &str| {
        plates[of]["position"]["mean_mm"]
            .as_f64()
            .expect("a number")
    };
    assert!(mean("frames_only") > 0.3, "{plates:#}");
    let [error, most] = held_out(&found, folder.path(), &cell);
    assert!(
        error <= HELD_OUT_MM && most <= 2.0 * HELD_OUT_MM,
        "{error} {most} {plates:#}"
    );
    println!(
        "{axes} axes: {} before, held out {error} mean, {most} largest",
        mean("frames_only")
    );
    for (key, is) in [
        ("positioner_scale axis 1 ratio", 2.0e-4),
        ("positioner_ripple axis 1 order 2 sin_deg", -0.02),
        ("positioner_runout axis 1 along z order 1 cos_mm", 0.1),
    ] {
        let (found, sigma) = value(&plates["parameters"], key);
        assert!((found - is).abs() < 4.0 * sigma, "{key}: {found} ± {sigma}");
    }
    if axes == 2 {
        let (found, sigma) = value(&plates["parameters"], "positioner_scale axis 2 ratio");
        assert!((found + 1.5e-4).abs() < 4.0 * sigma, "{found} ± {sigma}");
    }
    // where the reflectors are stays in the profile, the zero and the plate as they were
    let text = std::fs::read_to_string(&found).expect("written");
    let back = Profile::from_yaml(&text).expect("its own profile");
    assert_eq!(back.external.positioners[0].points.len(), REFLECTORS.len());
    assert!(!text.contains("positioner_zero") && !text.contains("positioner_plate"));
}

#[test]
fn a_diagnosis_needs_rows_of_the_tool() {
    let (folder, cell) = (scratch(), Cell::new(1));
    let mut random = StdRng::seed_from_u64(8);
    let angles = cell.angles(6, &mut random);
    let plates = cell.of_plate(&angles, NOISE_MM, &mut random);
    let tool = cell.of_tool(50, NOISE_MM, &mut random);
    let (effects, _) = arm();
    let effects: Vec<&str> = effects.iter().map(String::as_str).collect();
    let text = with_tool(&section(1), &effects).replace("points: {}", "points: {tcp: [0, 0, 0]}");
    let profile = put(folder.path(), "p.yaml", &text);
    let run = |texts: &[String]| {
        let mut command = poseshift();
        command
            .args(["diagnose", "--json", "--profile"])
            .arg(&profile);
        for (number, text) in texts.iter().enumerate() {
            let csv = put(folder.path(), &format!("m{number}.csv"), text);
            command.arg("--measurements").arg(csv);
        }
        if texts.len() > 1 {
            command.arg("--runs");
        }
        let done = command.output().expect("the program starts");
        let all = [done.stdout, done.stderr].concat();
        String::from_utf8_lossy(&all).into_owned()
    };
    let both = cell.header() + &tool + &plates;
    let reported = run(std::slice::from_ref(&both));
    assert!(!reported.contains("plate-rows-left-out"), "{reported}");
    // rows are named by their lines, whatever stands before them
    let worst = |text: String| -> u64 {
        let reported = run(&[text]);
        let end = reported.rfind('}').expect("JSON") + 1;
        let report: Value = serde_json::from_str(&reported[..end]).expect("JSON");
        report["worst_row"]["line"].as_u64().expect("a line")
    };
    let behind = worst(cell.header() + &plates + &tool);
    assert_eq!(behind, worst(both) + 18);
    let plates = cell.header() + &plates;
    let none = "every row is of a point on a plate";
    let reported = run(std::slice::from_ref(&plates));
    assert!(reported.contains(none), "{reported}");
    // of runs too
    let runs: Vec<String> = (0..5)
        .map(|_| cell.header() + &cell.of_tool(20, NOISE_MM, &mut random))
        .collect();
    let mut mixed = runs.clone();
    mixed[2] += plates.split_once('\n').expect("rows").1;
    let reported = run(&mixed);
    assert!(reported.contains("\"positioner\": \"STN1\""), "{reported}");
    assert_eq!(reported.matches("\"rows\": 20").count(), 5, "{reported}");
    let reported = run(&[&runs[..4], &[plates]].concat());
    assert!(
        reported.contains(none) && reported.contains("m4.csv"),
        "{reported}"
    );
}

#[test]
fn an_axis_is_identified_together_with_the_arm() {
    recovers(1, 14, false);
}

#[test]
fn an_axis_is_identified_with_a_known_arm() {
    recovers(1, 14, true);
}

#[test]
fn two_axes_are_identified_with_a_known_arm() {
    recovers(2, 24, true);
}

/// The options that name these files.
fn of<'a>(profile: &'a Path, csv: &'a Path) -> [(&'static str, &'a Path); 2] {
    [("--profile", profile), ("--measurements", csv)]
}

#[test]
fn angles_that_cannot_tell_an_axis_are_refused_by_name() {
    let (folder, cell) = (scratch(), Cell::new(2));
    let mut random = StdRng::seed_from_u64(9);
    let known = in_world(&section(2));
    let profile = put(folder.path(), "p.yaml", &known);
    let all: Vec<Vec<f64>> = (0..12)
        .map(|k| vec![f64::from(30 * k - 165), f64::from(25 * (k % 5) - 50)])
        .collect();
    let file = |angles: &[Vec<f64>], random: &mut StdRng| {
        cell.header() + &cell.of_plate(angles, NOISE_MM, random)
    };
    let good = file(&all, &mut random);
    let csv = put(folder.path(), "m.csv", &good);
    let files = of(&profile, &csv);
    let report = json(&["calibrate", "--json"], &files);
    assert!(
        report["plates"].is_null() && report["after"]["position"]["mean_mm"].as_f64() < Some(0.1),
        "{report:#}"
    );
    let narrow: Vec<Vec<f64>> = all.iter().map(|e| vec![e[0], 0.2 * e[1]]).collect();
    let still: Vec<Vec<f64>> = all.iter().map(|e| vec![15.0, 2.0 * e[1]]).collect();
    let one = |text: &str| -> String {
        let rows = text
            .lines()
            .filter(|row| !row.ends_with(",r1") && !row.ends_with(",r2"));
        rows.map(|row| format!("{row}\n")).collect()
    };
    for (text, more, says) in [
        (
            file(&narrow, &mut random),
            &[][..],
            ["E2 over 20.0 deg", "3 angles over 60 deg"],
        ),
        (
            file(&still, &mut random),
            &[],
            ["1 angles of E1", "--identify positioner_axis:2"],
        ),
        (
            good.replace("plate:STN1", "plate:STN2"),
            &[],
            ["no such positioner", "STN1"],
        ),
        (good.replace("e2_deg", "note"), &[], ["E2", "e2_deg"]),
        (
            good.replace("plate:STN1", "tool_in_plate:STN1"),
            &[],
            ["`tool_in_plate:STN1` is not tool", "plate:NAME"],
        ),
        (
            good.replace(",r0\n", ",\n"),
            &[],
            ["column point", "an empty cell"],
        ),
        (
            good.clone(),
            &["--identify", "positioner_zero:2"],
            ["positioner_zero", "known coordinates"],
        ),
        (
            good.clone(),
            &["--identify", "joint_scale"],
            ["joint_scale", "nothing of the arm"],
        ),
        (
            one(&file(&all[..4], &mut random)),
            &[],
            ["too few", "parameters"],
        ),
    ] {
        let csv = put(folder.path(), "bad.csv", &text);
        let reported = refused(&[&["calibrate"], more].concat(), &of(&profile, &csv));
        for word in says {
            assert!(reported.contains(word), "{word}: {reported}");
        }
    }
    // an axis by name is sought where the other stood still
    let csv = put(folder.path(), "still.csv", &file(&still, &mut random));
    let files = of(&profile, &csv);
    let words = "positioner_axis:2,positioner_scale:2";
    let report = json(&["calibrate", "--json", "--identify", words], &files);
    assert!(value(&report["parameters"], "positioner_axis axis 2 x_mm").1 < 0.1);
    // a device that stands elsewhere than the profile has it, and an axis that goes the other way
    let csv = put(folder.path(), "m.csv", &good);
    let elsewhere = put(folder.path(), "q.yaml", &with_tool(&section(2), &[]));
    let reported = refused(&["calibrate"], &of(&elsewhere, &csv));
    assert!(
        reported.contains("from where the profile has it") || reported.contains("do not go round"),
        "{reported}"
    );
    let other = put(
        folder.path(),
        "q.yaml",
        &known.replace("sign: -1", "sign: 1"),
    );
    let reported = refused(&["calibrate"], &of(&other, &csv));
    assert!(
        reported.contains("from where the profile has it") || reported.contains("do not go round"),
        "{reported}"
    );
}

#[test]
fn a_known_plate_tells_the_zero_or_itself() {
    let (folder, cell) = (scratch(), Cell::new(1));
    let mut random = StdRng::seed_from_u64(3);
    let angles = cell.angles(14, &mut random);
    let points = REFLECTORS.map(|p| p.map(|m| (1e3 * m).to_string()).join(", "));
    let [a, b, c] = points;
    let known = format!(
        "{}      points: {{r0: [{a}], r1: [{b}], r2: [{c}]}}\n",
        section(1)
    );
    let text = in_world(&known);
    let profile = put(folder.path(), "p.yaml", &text);
    let csv = cell.header() + &cell.of_plate(&angles, NOISE_MM, &mut random);
    let csv = put(folder.path(), "m.csv", &csv);
    let files = of(&profile, &csv);
    // the hidden zero turns the plate as well
    let report = json(&["calibrate", "--json"], &files);
    let (rz, sigma) = value(&report["parameters"], "positioner_plate axis 1 x_mm");
    assert!((rz - 0.6).abs() < 4.0 * sigma + 0.3, "{rz} ± {sigma}");
    let words = "positioner_axis,positioner_zero,positioner_scale";
    let report = json(&["calibrate", "--json", "--identify", words], &files);
    let (zero, sigma) = value(&report["parameters"], "positioner_zero axis 1 deg");
    assert!(sigma < 0.05 && zero.abs() < 0.5, "{zero} ± {sigma}");
    let keys = report["parameters"].as_array().expect("a list");
    assert!(keys.iter().all(|p| {
        !p["key"]
            .as_str()
            .is_some_and(|k| k.starts_with("positioner_plate"))
    }));
}

#[test]
fn angles_are_planned_simulated_and_found_again() {
    let folder = scratch();
    let profile = put(folder.path(), "p.yaml", &in_world(&section(2)));
    let table = folder.path().join("plan.csv");
    let arguments = [
        "plan",
        "--json",
        "--plate",
        "stn1",
        "--count",
        "16",
        "--candidates",
        "400",
        "--starts",
        "2",
        "--reflector",
        "300,50,20",
        "--reflector",
        "-180,240,110",
        "--sigma-mm",
        "0.03",
        "--level",
        "0",
        "--identify",
        "positioner_axis,positioner_scale",
    ];
    let files = [("--profile", profile.as_path()), ("-o", &table)];
    let plan = json(&arguments, &files);
    let expected = plan["expected_sigma"].as_array().expect("a list");
    assert_eq!(expected.len(), 16, "{plan:#}");
    let text = std::fs::read_to_string(&table).expect("written");
    assert_eq!(text.lines().next(), Some("id,e1_deg,e2_deg,on"));
    assert_eq!(text.lines().count(), 17);
    // measured on a robot with these errors
    let points = "      points: {r1: [300.4, 50.2, 19.7], r2: [-180.3, 239.8, 110.6]}\n";
    let effects = "effects: [{effect: positioner_axis, axis: 2, x_mm: 0.8, ry_deg: 0.05}, {effect: \
        positioner_scale, axis: 1, ratio: 2.0e-4}";
    let real = in_world(&(section(2) + points)).replace("effects: [", effects);
    let real = put(folder.path(), "real.yaml", &real);
    let made = folder.path().join("m.csv");
    let files = [
        ("--profile", real.as_path()),
        ("--joints", &table),
        ("-o", &made),
    ];
    json(&["simulate", "--json", "--noise-mm", "0.03"], &files);
    let rows = std::fs::read_to_string(&made).expect("written");
    assert_eq!(rows.lines().count(), 33, "{rows}");
    let files = of(&profile, &made);
    let words = "positioner_axis,positioner_scale";
    let found = json(&["calibrate", "--json", "--identify", words], &files);
    for (key, is) in [
        ("positioner_axis axis 2 x_mm", 0.8),
        ("positioner_axis axis 2 ry_deg", 0.05),
        ("positioner_axis axis 1 x_mm", 0.0),
        ("positioner_scale axis 1 ratio", 2.0e-4),
    ] {
        let (value, sigma) = value(&found["parameters"], key);
        assert!((value - is).abs() < 4.0 * sigma, "{key}: {value} ± {sigma}");
        // and as well as the plan expects
        let planned = expected.iter().find(|p| p["key"] == key).expect(key);
        let planned = planned["sigma"].as_f64().expect("a number");
        assert!(
            sigma < 2.0 * planned && planned < 2.0 * sigma,
            "{key}: {sigma} {planned}"
        );
    }
    for (more, says) in [
        (["--plate", "STN2"], "no such positioner"),
        (["--plate", "STN1"], "no `points`"),
    ] {
        let words = ["plan", "--count", "9", "--candidates", "50"];
        let words = [&words[..], &more[..]].concat();
        let reported = refused(&words, &[("--profile", &profile)]);
        assert!(reported.contains(says), "{reported}");
    }
}
