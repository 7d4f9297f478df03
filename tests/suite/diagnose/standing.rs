//! How sure an answer is: of each effect, of the whole, and what is written.

use super::commands::{case_with, diagnosed};
use super::{group, with_csv, without_sigma};
use crate::support::scratch;
use crate::trial::{Case, case, label};
use poseshift::diagnose::{Diagnosis, NoiseSource, Options, Standing, Verdict, diagnose};
use poseshift::identify::pick::Pick;
use poseshift::model::effects::{Effect, Kind, Site};
use poseshift::model::{Conditions, Model};
use serde_json::Value;

pub fn found(case: &Case, options: &Options) -> Diagnosis {
    diagnose(&case.profile, &case.measurements, options, &mut |_| {}).expect("enough rows")
}

/// The same rows, each place moved by this, mm, from the row's number and its joint angles in
/// degrees.
pub fn moved(case: Case, by: impl Fn(usize, [f64; 6]) -> [f64; 3]) -> Case {
    let mut lines = case.csv.lines();
    let mut csv = lines.next().expect("a header").to_owned() + "\n";
    for (row, line) in lines.enumerate() {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        let number = |cell: &String| cell.parse::<f64>().expect("a number");
        let joints: [f64; 6] = std::array::from_fn(|i| number(&cells[i]));
        for (k, by) in by(row, joints).into_iter().enumerate() {
            cells[6 + k] = format!("{:.6}", number(&cells[6 + k]) + by);
        }
        csv += &(cells.join(",") + "\n");
    }
    with_csv(case, csv)
}

/// Louder than `sigma_mm` says: numbers that no effect follows.
fn louder(case: Case) -> Case {
    moved(case, |row, _| {
        [7, 11, 13].map(|k| 0.3 * (((row * row * k + 5 * row) % 101) as f64 / 101.0 - 0.5))
    })
}

#[test]
fn what_predicts_better_is_written_though_something_is_left() {
    let case = louder(case_with("backlash"));
    let folder = scratch();
    let better = folder.path().join("better.yaml");
    let (status, out, error) = diagnosed(&case, &["--json", "-o", &better.to_string_lossy()]);
    assert_eq!(status, 0, "{error}");
    let report: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(report["verdict"], "improved", "{report:#}");
    let effect = &report["effects"][0];
    assert_eq!(
        (&effect["effect"], &effect["standing"]),
        (&"backlash".into(), &"certain".into())
    );
    let compared = &report["held_out"]["compared"];
    let mean = |which: &str| compared[which]["mean_mm"].as_f64().expect("a mean");
    assert!(mean("after") < mean("before"));
    assert!(compared["p_value"].as_f64().is_some_and(|p| p < 0.01));
    let left = report["unexplained"]["rms_mm"].as_f64().expect("a size");
    // 0.03 of the noise and 0.087 of what was added
    assert!((left - 0.09).abs() < 0.02, "{left}");
    let text = std::fs::read_to_string(&better).expect("the profile");
    assert!(
        text.contains("effect: backlash") && text.contains("certain"),
        "{text}"
    );
    let (_, out, _) = diagnosed(&case, &[]);
    let mut lines = out.lines();
    assert!(
        lines.next().is_some_and(|l| l.starts_with("Improved:")),
        "{out}"
    );
    assert!(
        out.contains("\ncertain   J") && out.contains("\nresidual  0.0"),
        "{out}"
    );
    assert!(
        out.contains("times the noise that sigma_mm states"),
        "{out}"
    );
}

#[test]
fn the_same_effects_accepted_are_the_same_model() {
    for (name, number) in [
        ("pairs", 11),
        ("pairs", 22),
        ("unregistered", 0),
        ("unregistered", 3),
    ] {
        let case = case(group(name), number, 5, 120);
        let first = found(&case, &Options::default());
        if first.found.is_empty() {
            continue;
        }
        let accept = Pick::parse_list(&first.accept()).expect("words that were written");
        let options = Options {
            accept,
            ..Options::default()
        };
        let again = found(&case, &options);
        let labels = |d: &Diagnosis| {
            let mut all: Vec<String> = d.found.iter().map(|f| f.effect.label()).collect();
            all.sort();
            all
        };
        assert_eq!(labels(&first), labels(&again), "{name} {number}");
        assert!(again.found.iter().all(|f| f.accepted));
        for one in &first.found {
            let other = again
                .found
                .iter()
                .find(|f| f.effect.label() == one.effect.label());
            let other = other.expect("the same labels");
            for (k, sigma) in one.sought.iter().zip(&one.sigmas) {
                let gap = one.effect.parameters[*k] - other.effect.parameters[*k];
                assert!(
                    gap.abs() < 0.05 * sigma,
                    "{name} {number}: {}",
                    one.effect.label()
                );
            }
        }
    }
}

#[test]
fn few_rows_without_a_noise_do_not_say_that_nothing_is_missing() {
    let few = without_sigma(case(group("clean"), 0, 3, 24));
    let d = found(&few, &Options::default());
    assert_eq!(d.noise_source, NoiseSource::Residuals);
    if d.found.is_empty() {
        assert_eq!(d.verdict, Verdict::Undetermined);
        assert!(
            d.reasons
                .iter()
                .any(|r| r.contains("nothing states the noise")),
            "{:?}",
            d.reasons
        );
    }
    // with it, or with more rows, they do
    let stated = found(&case(group("clean"), 0, 3, 24), &Options::default());
    assert_eq!(
        stated.verdict,
        Verdict::NothingMissing,
        "{:?}",
        stated.reasons
    );
}

#[test]
fn what_predicts_worse_is_never_explained() {
    // rows that the profile was calibrated with, few of them, and something that is in no effect
    for seed in 0..6 {
        let case = without_sigma(case(group("unregistered"), 3, seed, 40));
        let d = found(&case, &Options::default());
        let worse = d
            .judged
            .is_some_and(|j| j.found.mean > j.start.mean && j.p_value > 0.99);
        let sure = matches!(d.verdict, Verdict::Explained | Verdict::Improved);
        assert!(!(worse && sure), "{seed}: {:?}", d.judged);
        let seldom = |f: &&poseshift::diagnose::Found| 2 * f.found_again.0 < f.found_again.1;
        for one in d.found.iter().filter(seldom) {
            assert_eq!(one.standing, Standing::Possible);
            assert_ne!(d.verdict, Verdict::Explained, "{seed}");
        }
    }
}

#[test]
fn a_rectified_wave_is_no_zero_with_a_harmonic() {
    let rectified = (0..12).filter(|n| {
        let what = case(group("unregistered"), *n, 9, 20).what;
        what == "wave that is rectified"
    });
    for number in rectified {
        for seed in [9, 10, 11, 12] {
            let d = found(
                &case(group("unregistered"), number, seed, 150),
                &Options::default(),
            );
            assert_ne!(d.verdict, Verdict::Explained, "{seed}: {}", d.accept());
        }
    }
}

#[test]
fn a_drift_without_a_clock_is_a_drift() {
    let mut case = case_with("warm_up_drift");
    let hidden = case.effects[0].clone();
    // no temperature, no time: their columns are the two before sigma_mm
    let rows = case.csv.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let kept = [&cells[..15], &cells[17..]].concat();
        kept.join(",") + "\n"
    });
    let csv: String = rows.collect();
    assert!(csv.starts_with("q1_deg") && !csv.contains("time_s") && csv.contains("sigma_mm"));
    case = with_csv(case, csv);
    let d = found(&case, &Options::default());
    let named: Vec<String> = d.found.iter().map(|f| label(&f.effect)).collect();
    assert_eq!(named.len(), 1, "{named:?}");
    assert!(named[0].starts_with("session_drift"), "{named:?}");
    assert_eq!(d.found[0].effect.site.index, hidden.site.index);
}

#[test]
fn a_wave_of_the_gear_is_found_at_its_order() {
    // J2 by 26.5 waves a turn; a degree at J2 moves a point of this arm by some millimetres
    let base = case(group("clean"), 0, 4, 150);
    let joint = 1;
    let hidden = Effect {
        kind: Kind::by_id("joint_harmonic").expect("in the registry"),
        site: Site {
            index: joint,
            order: 26_500,
            ..Site::default()
        },
        parameters: [1.5e-4, -1e-4, 0.0, 0.0, 0.0, 0.0],
    };
    let mut truth = base.profile.clone();
    let name = truth.tools.keys().next().expect("its tool").clone();
    let tool = truth.tool(&name).expect("its tool");
    let plain = truth.real_model(&tool, &Conditions::default());
    truth.effects.push(hidden);
    let wavy = truth.real_model(&tool, &Conditions::default());
    let case = moved(base, |_, degrees| {
        let q = degrees.map(f64::to_radians);
        let at = |model: &Model| model.forward(&q, &Conditions::default()).translation;
        let (a, b) = (at(&plain), at(&wavy));
        std::array::from_fn(|k| 1e3 * (b[k] - a[k]))
    });
    let d = found(&case, &Options::default());
    assert_eq!(d.verdict, Verdict::Explained, "{:?}", d.reasons);
    assert_eq!(d.accept(), "joint_harmonic:2:26.5");
}

#[test]
fn a_device_that_moved_is_reported_where_the_robot_is() {
    let case = case_with("frame_shift");
    let (status, out, error) = diagnosed(&case, &["--json", "--quick"]);
    assert_eq!(status, 0, "{error}");
    let report: Value = serde_json::from_str(&out).expect("JSON");
    let effect = &report["effects"][0];
    assert_eq!(effect["effect"], "frame_shift");
    let sentence = effect["sentence"].as_str().expect("a sentence");
    assert!(sentence.contains("where the robot stands"), "{sentence}");
}
