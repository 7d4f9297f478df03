//! `--report`: the page's numbers, what it may take the place of, and the way it draws.

mod forms;
mod pendant;
mod schema;
mod trace;

use crate::support::{repository, run, scratch};
use serde_json::Value;
use std::path::Path;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const PROGRAM: &str = "programs/rapid/olp/in/Deburr.mod";

pub fn name(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// The data of a page.
pub fn data(page: &Path) -> Value {
    let html = std::fs::read_to_string(page).expect("a page");
    let (_, rest) = html
        .split_once(r#"<script type="application/json" id="data">"#)
        .expect("data");
    let (json, _) = rest.split_once("</script>").expect("its end");
    serde_json::from_str(json).expect("JSON")
}

/// A column of a table of a page by heading.
pub fn column(data: &Value, table: &str, label: &str, unit: Option<&str>) -> Vec<Value> {
    let columns = data["tables"][table]["columns"].as_array().expect(table);
    let found = columns
        .iter()
        .find(|c| c["label"] == label && c["unit"].as_str() == unit);
    let values = &found.unwrap_or_else(|| panic!("{table}: {label}"))["values"];
    if let Some(values) = values.as_array() {
        return values.clone();
    }
    let named = |index: &Value| {
        let index = index.as_u64().and_then(|i| usize::try_from(i).ok());
        index.map_or(Value::Null, |i| values["names"][i].clone())
    };
    let index = values["index"].as_array().expect("indices");
    index.iter().map(named).collect()
}

/// Each number of a page is one of the report rounded to so many digits.
pub fn agree(shown: &[Value], reported: &[Value], digits: i32, what: &str) {
    assert_eq!(shown.len(), reported.len(), "{what}");
    assert!(!shown.is_empty(), "{what}");
    for (shown, reported) in shown.iter().zip(reported) {
        let (Some(a), Some(b)) = (shown.as_f64(), reported.as_f64()) else {
            assert_eq!(shown, reported, "{what}");
            continue;
        };
        let slack = 0.51 * b.abs() * 10.0_f64.powi(1 - digits);
        assert!((a - b).abs() <= slack + 1e-12, "{what}: {a} is not {b}");
    }
}

pub fn each(list: &Value, key: &str) -> Vec<Value> {
    let list = list.as_array().expect("a list").iter();
    list.map(|one| one[key].clone()).collect()
}

#[test]
fn the_page_of_compensate_has_the_numbers_of_its_json() {
    let page = compensated(PROGRAM, &[]);
    let cell = &page["sections"][0];
    let paths: Vec<&str> = each_name(&cell["paths"]);
    assert_eq!(paths, ["uncompensated", "compensated", "wanted"]);
}

#[test]
fn the_page_lists_no_targets_of_files_that_are_read_for_their_declarations() {
    let page = compensated(PROGRAM, &["--with", "programs/rapid/cam/in/cam.mod"]);
    assert_eq!(page["title"], "Compensation of Deburr.mod");
}

/// Compensates with a page, whose numbers are those of the JSON, and gives the page's data.
fn compensated(program: &str, more: &[&str]) -> Value {
    let folder = scratch();
    let (out, page) = (
        folder.path().join("out.mod"),
        folder.path().join("page.html"),
    );
    let arguments = [
        "compensate",
        program,
        "--profile",
        PROFILE,
        "-o",
        name(&out),
        "--report",
        name(&page),
        "--json",
    ];
    let (status, json, error) = run(&[&arguments[..], more].concat());
    assert_eq!(status, 0, "{error}");
    assert!(out.exists());
    let (report, data): (Value, _) = (serde_json::from_str(&json).expect("JSON"), data(&page));
    let targets = &report["targets"];
    for (label, unit, key, digits) in [
        ("line", None, "line", 9),
        ("name", None, "name", 9),
        ("tool", None, "tool", 9),
        ("shift", Some("mm"), "shift_mm", 5),
        ("shift", Some("deg"), "shift_deg", 4),
        ("residual", Some("mm"), "residual_mm", 2),
        ("error before", Some("mm"), "before_mm", 5),
        ("error after", Some("mm"), "rounding_mm", 3),
        ("method", None, "method", 9),
        ("shift evaluations", None, "shift_evaluations", 9),
        ("newton evaluations", None, "newton_evaluations", 9),
        ("branch", None, "branch", 9),
        ("status", None, "status", 9),
    ] {
        let shown = column(&data, "targets", label, unit);
        agree(&shown, &each(targets, key), digits, label);
    }
    data
}

fn each_name(list: &Value) -> Vec<&str> {
    let list = list.as_array().expect("a list").iter();
    list.map(|one| one["name"].as_str().expect("a name"))
        .collect()
}

/// The deviations' lengths of a path of a page, mm.
fn deviations(path: &Value) -> Vec<f64> {
    let by: Vec<f64> = path["by"]
        .as_array()
        .expect("deviations")
        .iter()
        .map(|x| x.as_f64().expect("a number"))
        .collect();
    by.chunks(3)
        .map(|d| d.iter().map(|x| x * x).sum::<f64>().sqrt())
        .collect()
}

#[test]
fn compensation_brings_the_drawn_path_onto_the_wanted_one() {
    let folder = scratch();
    let (out, page) = (
        folder.path().join("out.mod"),
        folder.path().join("page.html"),
    );
    let arguments = [
        "compensate",
        PROGRAM,
        "--profile",
        PROFILE,
        "-o",
        name(&out),
        "--report",
        name(&page),
    ];
    let (status, _, error) = run(&arguments);
    assert_eq!(status, 0, "{error}");
    let data = data(&page);
    let paths = &data["sections"][0]["paths"];
    let (before, after) = (deviations(&paths[0]), deviations(&paths[1]));
    assert_eq!(before.len(), after.len());
    // the first move starts at a joint target, which stays
    let skip = before.len() / 3;
    let largest = |list: &[f64]| list[skip..].iter().fold(0.0_f64, |a, b| a.max(*b));
    assert!(largest(&before) > 1.0, "{}", largest(&before));
    assert!(largest(&after) < 0.1, "{}", largest(&after));
}

#[test]
fn the_page_of_check_has_the_numbers_of_its_json() {
    let folder = scratch();
    let page = folder.path().join("page.html");
    let (status, json, error) = run(&[
        "check",
        PROGRAM,
        "--profile",
        PROFILE,
        "--cell",
        "tests/browser/cell.yaml",
        "--report",
        name(&page),
        "--json",
    ]);
    assert_eq!(status, 0, "{error}");
    let (report, data): (Value, _) = (serde_json::from_str(&json).expect("JSON"), data(&page));
    for (label, unit, key, digits) in [
        ("line", None, "line", 9),
        ("kind", None, "kind", 9),
        ("target error", Some("mm"), "target_error_mm", 5),
        ("path error", Some("mm"), "max_path_error_mm", 4),
        ("clearance", Some("mm"), "clearance_mm", 4),
        ("nominal clearance", Some("mm"), "nominal_clearance_mm", 4),
        ("joint margin", Some("deg"), "joint_margin_deg", 3),
    ] {
        let shown = column(&data, "moves", label, unit);
        agree(&shown, &each(&report["moves"], key), digits, label);
    }
    let bodies = each_name(&data["sections"][0]["bodies"]);
    assert_eq!(bodies, ["table", "post", "floor"]);
}

#[test]
fn pages_of_measurements_have_the_numbers_of_their_json() {
    let folder = scratch();
    let at = |file: &str| folder.path().join(file);
    let (joints, measured) = (at("joints.csv"), at("m.csv"));
    let plan = at("plan.html");
    let (status, json, error) = run(&[
        "plan",
        "--profile",
        PROFILE,
        "--count",
        "40",
        "--candidates",
        "200",
        "--starts",
        "1",
        "-o",
        name(&joints),
        "--report",
        name(&plan),
        "--json",
    ]);
    assert_eq!(status, 0, "{error}");
    let report: Value = serde_json::from_str(&json).expect("JSON");
    let shown = column(&data(&plan), "sigma", "expected sigma", None);
    agree(
        &shown,
        &each(&report["expected_sigma"], "sigma"),
        4,
        "expected sigma",
    );
    let (status, _, error) = run(&[
        "simulate",
        "--profile",
        PROFILE,
        "--joints",
        name(&joints),
        "-o",
        name(&measured),
        "--noise-mm",
        "0.03",
        "--seed",
        "4",
    ]);
    assert_eq!(status, 0, "{error}");
    let page = at("calibrate.html");
    let (status, json, error) = run(&[
        "calibrate",
        "--profile",
        PROFILE,
        "--measurements",
        name(&measured),
        "--report",
        name(&page),
        "--json",
    ]);
    assert_eq!(status, 0, "{error}");
    let report: Value = serde_json::from_str(&json).expect("JSON");
    let shown = data(&page);
    for (label, key, digits) in [
        ("parameter", "key", 9),
        ("value", "value", 6),
        ("sigma", "sigma", 3),
    ] {
        let column = column(&shown, "parameters", label, None);
        agree(&column, &each(&report["parameters"], key), digits, label);
    }
    // the rows' errors are those that the statistics are of
    for (model, key) in [
        ("before", "before"),
        ("frames only", "frames_only"),
        ("after", "after"),
    ] {
        let errors = column(&shown, "rows", &format!("error, {model}"), Some("mm"));
        let numbers: Vec<f64> = errors.iter().filter_map(Value::as_f64).collect();
        let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
        let reported = report[key]["position"]["mean_mm"].as_f64().expect("a mean");
        assert!(
            (mean - reported).abs() < 1e-4 * reported,
            "{model}: {mean} {reported}"
        );
    }
    let page = at("diagnose.html");
    let (status, json, error) = run(&[
        "diagnose",
        "--profile",
        PROFILE,
        "--measurements",
        name(&measured),
        "--quick",
        "--report",
        name(&page),
        "--json",
    ]);
    assert_eq!(status, 0, "{error}");
    let report: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(report["verdict"], "nothing_missing");
    let html = std::fs::read_to_string(&page).expect("a page");
    assert!(html.contains("Nothing is missing"));
}

#[test]
fn a_report_takes_the_place_of_nothing_that_is_read_or_written() {
    let folder = scratch();
    let (program, out) = (folder.path().join("t.mod"), folder.path().join("out.mod"));
    std::fs::copy(repository(PROGRAM), &program).expect("scratch");
    let before = std::fs::read(&program).expect("a program");
    for report in [&program, &out] {
        let (status, _, error) = run(&[
            "compensate",
            name(&program),
            "--profile",
            PROFILE,
            "-o",
            name(&out),
            "--report",
            name(report),
        ]);
        assert_eq!(status, 2, "{error}");
        assert!(error.contains(name(report)), "{error}");
        assert!(!out.exists());
    }
    assert_eq!(std::fs::read(&program).expect("a program"), before);
    let (status, _, error) = run(&[
        "check",
        name(&program),
        "--profile",
        PROFILE,
        "--report",
        PROFILE,
    ]);
    assert!(status == 2 && error.contains("written over"), "{error}");
}

#[test]
fn what_cannot_be_done_leaves_no_report_and_an_answer_of_no_has_one() {
    let folder = scratch();
    let (program, out, page) = (
        folder.path().join("t.mod"),
        folder.path().join("out.mod"),
        folder.path().join("page.html"),
    );
    let arguments = [
        "compensate",
        name(&program),
        "--profile",
        PROFILE,
        "-o",
        name(&out),
        "--report",
        name(&page),
    ];
    std::fs::write(&program, "MODULE t\n  PROC main()\n    MoveL [[1,").expect("scratch");
    let (status, _, _) = run(&arguments);
    assert!(status == 2 && !page.exists() && !out.exists());
    // one target within reach, one far beyond it
    let text = "MODULE t\n  PERS tooldata artifact := \
        [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];\n  PROC main()\n    \
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,artifact;\n    MoveL \
        [[400.000,0.000,300.000],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n    MoveL [[4000.000,0.000,300.000],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n  ENDPROC\nENDMODULE\n";
    std::fs::write(&program, text).expect("scratch");
    let (status, _, error) = run(&arguments);
    assert_eq!(status, 1, "{error}");
    assert!(!out.exists());
    let html = std::fs::read_to_string(&page).expect("a page");
    assert!(html.contains("Nothing is written"));
    let severities = column(&data(&page), "findings", "severity", None);
    assert!(severities.contains(&Value::from("error")));
}

#[test]
fn inserted_moves_are_reported_and_drawn_as_a_path_of_their_own() {
    let folder = scratch();
    let (program, out, page) = (
        folder.path().join("t.mod"),
        folder.path().join("out.mod"),
        folder.path().join("page.html"),
    );
    let text = "MODULE t\n  PERS tooldata artifact := \
        [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];\n  CONST robtarget p1 := \
        [[430.123,-200.456,300.789],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n  CONST \
        robtarget p2 := [[430.123,200.456,300.789],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n  PROC main()\n    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,artifact;\n    MoveJ p1,v200,fine,artifact;\n    MoveL p2,v100,fine,artifact;\n  ENDPROC\nENDMODULE\n";
    std::fs::write(&program, text).expect("scratch");
    let (status, _, error) = run(&[
        "compensate",
        name(&program),
        "--profile",
        PROFILE,
        "--max-path-error",
        "0.05",
        "--decimals",
        "5",
        "-o",
        name(&out),
        "--report",
        name(&page),
    ]);
    assert_eq!(status, 0, "{error}");
    let html = std::fs::read_to_string(&page).expect("a page");
    assert!(html.contains("moves inserted"));
    let data = data(&page);
    let sections = data["sections"].as_array().expect("sections");
    let drawn = sections.iter().find(|section| section["paths"].is_array());
    let paths = &drawn.expect("a cell")["paths"];
    let (before, after) = (deviations(&paths[0]), deviations(&paths[1]));
    assert!(after.len() > before.len());
    // the straight move, in parts, is within the limit
    let straight = &after[49..];
    assert!(straight.iter().all(|e| *e < 0.05), "{straight:?}");
    let items = paths[1]["items"].as_array().expect("items");
    let names = column(&data, "targets", "name", None);
    let p2 = names.iter().position(|name| name == "p2");
    assert!(p2.is_some());
    let of_p2 = |item: &Value| item.as_u64().and_then(|i| usize::try_from(i).ok()) == p2;
    assert!(items[49..].iter().all(of_p2));
}

#[test]
fn pages_of_repeated_poses_and_of_sweeps_have_what_is_reported() {
    let folder = scratch();
    let at = |file: &str| folder.path().join(file);
    let (once, repeated) = (at("once.csv"), at("repeated.csv"));
    let reported = |arguments: &[&str]| -> String {
        let (status, out, error) = run(arguments);
        assert_eq!(status, 0, "{error}");
        out
    };
    let joints = at("joints.csv");
    reported(&[
        "plan",
        "--profile",
        PROFILE,
        "--count",
        "12",
        "--candidates",
        "100",
        "--starts",
        "1",
        "--level",
        "1",
        "-o",
        name(&joints),
    ]);
    let measured = |seed: &str| {
        reported(&[
            "simulate",
            "--profile",
            PROFILE,
            "--joints",
            name(&joints),
            "-o",
            name(&once),
            "--noise-mm",
            "0.03",
            "--seed",
            seed,
        ]);
        let text = std::fs::read_to_string(&once).expect("measurements");
        text.lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let mut rows = measured("1");
    for seed in ["2", "3"] {
        rows.extend(measured(seed).into_iter().skip(1));
    }
    std::fs::write(&repeated, rows.join("\n")).expect("scratch");
    let page = at("validate.html");
    let json = reported(&[
        "validate",
        "--profile",
        PROFILE,
        "--measurements",
        name(&repeated),
        "--report",
        name(&page),
        "--json",
    ]);
    let report: Value = serde_json::from_str(&json).expect("JSON");
    let shown = data(&page);
    for (table, key, label, of) in [
        ("repeated", "iso_9283", "AP", "commanded_accuracy_mm"),
        ("repeated", "iso_9283", "AP, real model", "accuracy_mm"),
        ("repeated", "iso_9283", "RP", "repeatability_mm"),
        (
            "distances",
            "iso_9283_distances",
            "AD",
            "commanded_accuracy_mm",
        ),
        (
            "distances",
            "iso_9283_distances",
            "AD, real model",
            "accuracy_mm",
        ),
        ("distances", "iso_9283_distances", "RD", "repeatability_mm"),
    ] {
        agree(
            &column(&shown, table, label, Some("mm")),
            &each(&report[key], of),
            4,
            label,
        );
    }

    // one row of a sweep 3 mm off: it is left out, and the page says so
    let sweeps = at("sweeps.csv");
    let text = std::fs::read_to_string(repository("docs/measuring/sweeps.csv")).expect("sweeps");
    std::fs::write(&sweeps, text.replacen("341.3129", "344.3129", 1)).expect("scratch");
    let page = at("axes.html");
    let json = reported(&[
        "axes",
        name(&sweeps),
        "--profile",
        PROFILE,
        "--report",
        name(&page),
        "--json",
    ]);
    let report: Value = serde_json::from_str(&json).expect("JSON");
    let shown = column(&data(&page), "findings", "message", None);
    assert_eq!(shown, each(&report["findings"], "message"));
    let html = std::fs::read_to_string(&page).expect("a page");
    let sigma = report["base_sigma"]["x_mm"].as_f64().expect("a sigma");
    assert!(html.contains("base in the world, sigma"), "no sigma");
    assert!(html.contains(&format!("{sigma:.4}")), "{sigma}");
    assert!(html.contains(r#"class="verdict warning""#));
}
