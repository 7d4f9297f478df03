//! The diagnosis, against hidden truth: a reduced blind trial, and the command line.

mod changed;
mod clock;
mod commands;
mod doubted;
mod page;
mod physics;
mod real;
mod reference;
mod repeats;
mod session;
mod sessions;
mod standing;
mod written;

use crate::trial::{Case, GROUPS, Group, case, label};
use poseshift::diagnose::{Options, Standing, Verdict, diagnose};
use poseshift::identify::measurements::Measurements;

/// Poses of a case.
const ROWS: usize = 150;
/// Another seed than the example's.
const SEED: u64 = 77;

fn group(name: &str) -> &'static Group {
    GROUPS
        .iter()
        .find(|g| g.name == name)
        .expect("a group of the trial")
}

/// The same measurements, read again from a text.
fn with_csv(mut case: Case, csv: String) -> Case {
    case.measurements = Measurements::from_csv(csv.as_bytes()).expect("rows in the format");
    case.csv = csv;
    case
}

/// The same without the last column, `sigma_mm`.
fn without_sigma(case: Case) -> Case {
    let rows = case.csv.lines().map(|line| {
        let (cells, _) = line.rsplit_once(',').expect("several columns");
        cells.to_owned() + "\n"
    });
    let csv: String = rows.collect();
    assert!(case.csv.contains("sigma_mm") && !csv.contains("sigma_mm"));
    with_csv(case, csv)
}

fn right(group: &Group, number: usize) -> (bool, String) {
    let case = case(group, number, SEED, ROWS);
    let options = Options {
        quick: true,
        ..Options::default()
    };
    let found =
        diagnose(&case.profile, &case.measurements, &options, &mut |_| {}).expect("enough rows");
    let mut named: Vec<String> = found.found.iter().map(|f| label(&f.effect)).collect();
    named.sort();
    named.dedup();
    let right = if group.unregistered {
        found.verdict != Verdict::Explained
    } else {
        let wanted = if case.answer.is_empty() {
            Verdict::NothingMissing
        } else {
            Verdict::Explained
        };
        named == case.answer && found.verdict == wanted
    };
    let words = format!(
        "{} #{number}: {} was hidden, named {} ({}; {})",
        group.name,
        case.answer.join(" + "),
        named.join(" + "),
        found.verdict.id(),
        found.reasons.join("; ")
    );
    (right, words)
}

/// Cases of one group; at most `wrong` of them may be wrong.
fn trial(name: &str, numbers: impl Iterator<Item = usize>, wrong: usize) {
    let failures: Vec<String> = numbers
        .map(|n| right(group(name), n))
        .filter(|(right, _)| !right)
        .map(|(_, w)| w)
        .collect();
    assert!(failures.len() <= wrong, "{}", failures.join("\n"));
}

#[test]
fn one_effect_hidden_in_a_calibrated_robot_is_named() {
    // every kind once, robots and simulators in turn
    trial("calibrated", (0..20).map(|k| 4 * k + k % 4), 1);
}

#[test]
fn one_effect_hidden_in_a_nominal_robot_is_named_and_geometry_is_not() {
    trial("nominal", (0..16).map(|k| 4 * k + (k + 1) % 4), 1);
}

#[test]
fn outliers_and_heavy_tails_are_no_effect() {
    trial("rough", (0..8).map(|k| 8 * k + k % 4), 1);
}

#[test]
fn two_effects_are_both_named() {
    trial("pairs", (0..6).map(|k| 11 * k), 1);
}

#[test]
fn nothing_is_named_where_nothing_is_missing() {
    trial("clean", 0..8, 0);
}

#[test]
fn what_no_effect_explains_gets_no_confident_name() {
    trial("unregistered", 0..12, 2);
}

#[test]
fn distances_that_are_wrong_in_proportion_are_no_error_of_the_links() {
    // every pose measured by a length from one of four posts
    let case = case(group("devices"), 18, 314, ROWS);
    assert_eq!(case.answer, ["measurement_scale"]);
    assert!(case.csv.starts_with("q1_deg") && case.csv.contains("distance_mm"));
    let found = standing::found(&case, &Options::default());
    assert_eq!(found.verdict, Verdict::Explained, "{:?}", found.reasons);
    assert_eq!(found.found.len(), 1);
    let effect = &found.found[0].effect;
    assert_eq!(effect.label(), "measurement_scale");
    let hidden = case.effects[0].parameters[0];
    assert!((effect.parameters[0] / hidden - 1.0).abs() < 0.05);
}

#[test]
fn what_moves_places_is_seen_where_poses_are_measured_with_orientations_that_it_hardly_turns() {
    // poses whose orientations no column weighs
    for number in [19, 56] {
        let case = case(group("devices"), number, 314, ROWS);
        assert!(case.csv.contains("qw") && !case.csv.contains("sigma_deg"));
        let found = standing::found(&case, &Options::default());
        assert_eq!(found.verdict, Verdict::Explained, "{:?}", found.reasons);
        let named: Vec<String> = found.found.iter().map(|f| label(&f.effect)).collect();
        assert_eq!(named, case.answer);
    }
}

#[test]
fn an_effect_that_what_is_fitted_along_does_is_said_to_be_untested() {
    let untested = |name: &str| {
        let case = case(group(name), 0, SEED, ROWS);
        let options = Options {
            quick: true,
            ..Options::default()
        };
        let found = diagnose(&case.profile, &case.measurements, &options, &mut |_| {});
        let cannot = found.expect("enough rows").cannot_test;
        let ids = cannot.iter().map(|c| c.kind.definition().id);
        ids.map(str::to_owned).collect::<Vec<String>>()
    };
    // links of any length do what a device of any scale does
    assert_eq!(untested("nominal"), ["measurement_scale"]);
    assert!(untested("calibrated").is_empty());
}

#[test]
fn a_value_that_no_arm_has_is_not_certain() {
    // the tool's compliance is larger than any arm's, so that another stands in its place
    let case = case(group("devices"), 36, 21, ROWS);
    assert!(case.effects[0].beyond_usual().is_some());
    let found = standing::found(&case, &Options::default());
    assert_ne!(found.verdict, Verdict::Explained);
    let named = found
        .found
        .iter()
        .find(|f| f.effect.beyond_usual().is_some());
    let named = named.expect("a compliance larger than any arm's");
    assert_eq!(named.standing, Standing::Likely);
    let words = "and no arm has more than 5e-3";
    assert!(
        found.reasons.iter().any(|r| r.contains(words)),
        "{:?}",
        found.reasons
    );
}
