//! `diagnose` with points on a plate: an error of the positioner is named as the positioner's, one
//! at a time, and nothing is where nothing was hidden.

use super::landing::arm;
use super::measured::{json, put, with_tool};
use super::plates::{Cell, NOISE_MM, REFLECTORS, section};
use crate::physics::external::TableFault;
use crate::support::{poseshift, scratch};
use rand::SeedableRng;
use rand::rngs::StdRng;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A value is within so many of its standard deviations.
const SIGMAS: f64 = 4.0;

/// A profile whose arm is known, and the plate's reflectors where `given`.
fn profile(axes: usize, given: bool) -> String {
    let (effects, _) = arm();
    let effects: Vec<&str> = effects.iter().map(String::as_str).collect();
    let mut section = section(axes);
    if given {
        let points: Vec<String> = REFLECTORS
            .iter()
            .enumerate()
            .map(|(k, [x, y, z])| format!("r{k}: [{}, {}, {}]", 1e3 * x, 1e3 * y, 1e3 * z))
            .collect();
        section += &format!("      points: {{{}}}\n", points.join(", "));
    }
    let text = with_tool(&section, &effects);
    assert!(text.contains("points: {}"));
    text.replace("points: {}", "points: {tcp: [0, 0, 0]}")
}

/// A positioner without an error.
fn clean(axes: usize) -> Cell {
    let mut cell = Cell::new(axes);
    for table in &mut cell.tables {
        table.faults.clear();
    }
    cell.fault = [0.0; 6];
    cell
}

/// The files of a session: profile and measurements.
fn session(
    folder: &Path,
    cell: &Cell,
    given: bool,
    (poses, stops, seed): (usize, usize, u64),
) -> [PathBuf; 2] {
    let mut random = StdRng::seed_from_u64(seed);
    let angles = cell.angles(stops, &mut random);
    let text = cell.header()
        + &cell.of_tool(poses, NOISE_MM, &mut random)
        + &cell.of_plate(&angles, NOISE_MM, &mut random);
    [
        put(folder, "p.yaml", &profile(cell.axes, given)),
        put(folder, "m.csv", &text),
    ]
}

fn diagnosed([profile, csv]: &[PathBuf; 2]) -> Value {
    let files = [
        ("--profile", profile.as_path()),
        ("--measurements", csv.as_path()),
    ];
    let mut report = json(&["diagnose", "--quick", "--json"], &files);
    assert!(
        !report["findings"]
            .to_string()
            .contains("plate-rows-left-out"),
        "{:#}",
        report["findings"]
    );
    let positioner = report["positioners"][0].take();
    assert_eq!(positioner["positioner"], "STN1", "{report:#}");
    positioner
}

/// What is hidden of an axis, and by which id and keys it is to be named.
struct Hidden {
    axes: usize,
    /// From 1.
    axis: usize,
    fault: TableFault,
    given: bool,
    id: &'static str,
    values: &'static [(&'static str, f64)],
}

fn names(hidden: &Hidden) {
    let folder = scratch();
    let mut cell = clean(hidden.axes);
    cell.tables[hidden.axis - 1].faults = vec![hidden.fault.clone()];
    let stops = if hidden.axes == 1 { 16 } else { 28 };
    let files = session(folder.path(), &cell, hidden.given, (60, stops, 11));
    let found = diagnosed(&files);
    let id = hidden.id;
    let effects = found["effects"].as_array().expect("a list");
    assert_eq!(effects.len(), 1, "{id}: {found:#}");
    let effect = &effects[0];
    assert!(
        effect["effect"] == id && effect["axis"] == hidden.axis,
        "{id}: {effect:#}"
    );
    let standing = effect["standing"].as_str().expect("a word");
    assert!(
        ["certain", "likely"].contains(&standing),
        "{id}: {effect:#}"
    );
    assert_eq!(found["verdict"], "explained", "{id}: {found:#}");
    for (key, is) in hidden.values {
        let [value, sigma] = ["parameters", "sigma"].map(|of| {
            effect[of][key]
                .as_f64()
                .unwrap_or_else(|| panic!("{id} {key}: {effect:#}"))
        });
        assert!(
            (value - is).abs() < SIGMAS * sigma && sigma < 0.5 * is.abs(),
            "{id} {key}: {value} ± {sigma}, not {is}"
        );
    }
    let said = effect["sentence"].as_str().expect("a sentence");
    assert!(!said.contains("000 times"), "{said}");
    let [before, after] = ["before", "after"].map(|of| found[of]["mean_mm"].as_f64());
    assert!(after < before, "{id}: {found:#}");
}

#[test]
fn an_axis_that_is_elsewhere_is_named() {
    names(&Hidden {
        axes: 1,
        axis: 1,
        fault: TableFault::Axis([0.12e-3, -0.08e-3, 0.02_f64.to_radians(), 0.0]),
        given: false,
        id: "positioner_axis",
        values: &[("x_mm", 0.12), ("rx_deg", 0.02)],
    });
}

#[test]
fn a_scale_is_named() {
    names(&Hidden {
        axes: 1,
        axis: 1,
        fault: TableFault::Scale(1.2e-4),
        given: false,
        id: "positioner_scale",
        values: &[("ratio", 1.2e-4)],
    });
}

#[test]
fn a_runout_is_named() {
    names(&Hidden {
        axes: 1,
        axis: 1,
        fault: TableFault::Runout(2, 1.0, 0.08e-3, 0.0),
        given: false,
        id: "positioner_runout",
        values: &[("cos_mm", 0.08)],
    });
}

#[test]
fn a_ripple_is_named() {
    names(&Hidden {
        axes: 1,
        axis: 1,
        fault: TableFault::Ripple(2.0, 0.0, 0.02_f64.to_radians()),
        given: false,
        id: "positioner_ripple",
        values: &[("sin_deg", 0.02)],
    });
}

#[test]
fn a_zero_is_named_where_the_plate_is_given() {
    names(&Hidden {
        axes: 1,
        axis: 1,
        fault: TableFault::Zero(0.02_f64.to_radians()),
        given: true,
        id: "positioner_zero",
        values: &[("deg", 0.02)],
    });
}

#[test]
fn the_second_of_two_axes_is_named() {
    names(&Hidden {
        axes: 2,
        axis: 2,
        fault: TableFault::Axis([0.0, 0.0, 0.025_f64.to_radians(), -0.02_f64.to_radians()]),
        given: false,
        id: "positioner_axis",
        values: &[("rx_deg", 0.025), ("ry_deg", -0.02)],
    });
    names(&Hidden {
        axes: 2,
        axis: 2,
        fault: TableFault::Scale(2.0e-4),
        given: false,
        id: "positioner_scale",
        values: &[("ratio", 2.0e-4)],
    });
}

#[test]
fn nothing_is_named_where_nothing_was_hidden() {
    // where few rows of the tool tell the device's place, many on the plate blame no axis for it
    for (axes, given, poses, stops, seed) in [
        (1, false, 60, 16, 3),
        (1, true, 60, 16, 4),
        (2, false, 60, 28, 5),
        (1, false, 24, 60, 6),
        (1, true, 24, 60, 7),
    ] {
        let folder = scratch();
        let files = session(folder.path(), &clean(axes), given, (poses, stops, seed));
        let found = diagnosed(&files);
        assert_eq!(found["effects"], serde_json::json!([]), "{found:#}");
        assert_eq!(found["verdict"], "nothing_missing", "{found:#}");
    }
}

#[test]
fn it_is_said_in_words_and_on_the_page() {
    let folder = scratch();
    let mut cell = clean(1);
    cell.tables[0].faults = vec![TableFault::Scale(2.0e-4)];
    let [profile, csv] = session(folder.path(), &cell, false, (60, 16, 12));
    let page = folder.path().join("page.html");
    let done = poseshift()
        .args(["diagnose", "--quick", "--profile"])
        .arg(&profile)
        .arg("--measurements")
        .arg(&csv)
        .arg("--report")
        .arg(&page)
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(
        said.contains("positioner STN1, 48 rows at 16 stops") && said.contains("external axis 1"),
        "{said}{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let labels = crate::report::column(&crate::report::data(&page), "positioner1", "effect", None);
    assert_eq!(labels, [Value::from("positioner_scale axis 1")]);
}
