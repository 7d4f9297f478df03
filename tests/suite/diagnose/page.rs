//! The page of `diagnose --report`: what the report says, shown.

use super::commands::{case_with, diagnosed};
use crate::report::{agree, column, data, each, name};
use crate::support::{repository, run, scratch};
use serde_json::Value;

#[test]
fn the_page_shows_each_step_against_the_clock_or_the_joint() {
    let case = case_with("frame_shift");
    let folder = scratch();
    let page = folder.path().join("page.html");
    let (status, _, error) = diagnosed(&case, &["--quick", "--report", &page.to_string_lossy()]);
    assert_eq!(status, 0, "{error}");
    let text = std::fs::read_to_string(&page).expect("a page");
    assert!(text.contains("without it") && text.contains("fitted again"));
    assert!(text.contains("\"time\""), "the step stands against time_s");
}

#[test]
fn the_page_shows_what_cannot_be_and_rows_that_decide_alone() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name);
    let (hidden, without, joints) = (at("hidden.yaml"), at("without.yaml"), at("joints.csv"));
    let (measured, page) = (at("measured.csv"), at("page.html"));
    let robot = std::fs::read_to_string(repository("robots/abb_irb120_thesis.yaml"));
    let robot = robot.expect("a shipped profile");
    // a spring that pushes against its load, which no robot has and no effect may be
    let spring = "joint: 2, rad_per_n_m: 3.2e-5";
    let lines = |keep: &dyn Fn(&str) -> bool| -> String {
        let kept = robot.lines().filter(|line| keep(line));
        kept.map(|line| line.to_owned() + "\n").collect()
    };
    let changed = robot.replace(spring, "joint: 2, rad_per_n_m: -6e-5");
    assert_ne!(changed, robot);
    std::fs::write(&hidden, changed).expect("scratch");
    std::fs::write(&without, lines(&|line| !line.contains(spring))).expect("scratch");
    let done = |arguments: &[&str]| {
        let (status, _, error) = run(arguments);
        assert_eq!(status, 0, "{error}");
    };
    let hidden = name(&hidden);
    done(&[
        "plan",
        "--profile",
        hidden,
        "--count",
        "80",
        "-o",
        name(&joints),
    ]);
    done(&[
        "simulate",
        "--profile",
        hidden,
        "--joints",
        name(&joints),
        "--noise-mm",
        "0.02",
        "--seed",
        "1",
        "-o",
        name(&measured),
    ]);
    // a reflector that is seen once and nobody knows where it is on the tool
    let csv = std::fs::read_to_string(&measured).expect("measurements");
    let mut rows = csv.lines().filter(|line| !line.starts_with('#'));
    let header = rows.next().expect("a header").to_owned() + ",point\n";
    let named = rows.enumerate().map(|(row, line)| {
        let point = if row == 40 { "seen_once" } else { "known" };
        format!("{line},{point}\n")
    });
    std::fs::write(&measured, header + &named.collect::<String>()).expect("scratch");
    let (status, json, error) = run(&[
        "diagnose",
        "--profile",
        name(&without),
        "--measurements",
        name(&measured),
        "--quick",
        "--json",
        "--report",
        name(&page),
    ]);
    assert_eq!(status, 1, "{error}");
    let report: Value = serde_json::from_str(&json).expect("JSON");
    let shown = data(&page);
    let spring = &report["impossible"][0]["effects"][0];
    assert_eq!(spring["effect"], "joint_compliance");
    let needed = spring["parameters"]["rad_per_n_m"].clone();
    assert!(needed.as_f64().is_some_and(|x| x < 0.0), "{needed}");
    let column_of = |table, label, unit| column(&shown, table, label, unit);
    agree(
        &column_of("impossible", "it would need", None)[..1],
        &[needed],
        3,
        "a spring",
    );
    let labels = column_of("impossible", "effect", None);
    assert_eq!(labels[0], "joint_compliance joint 2");
    let rows = each(&report["leverage"], "leverage");
    assert!(rows[0].as_f64().is_some_and(|x| x > 0.99), "{rows:?}");
    agree(
        &column_of("leverage", "leverage", None),
        &rows,
        3,
        "leverage",
    );
    assert_eq!(
        column_of("leverage", "line", None),
        each(&report["leverage"], "line")
    );
}
