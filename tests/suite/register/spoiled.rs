//! Points on a plane, rows that spoil the motion of all others, and copies of rows.

use super::mistakes::{has, points, registered, write};
use super::{noisy, seeded};
use crate::support::{repository, scratch, text};
use poseshift::geometry::{Pose, Vector};
use rand::RngExt;
use rand::rngs::StdRng;
use serde_json::Value;

/// Twelve points of a plate, mm.
fn plate(random: &mut StdRng, thickness: f64) -> Vec<Vector> {
    let mut even = |size: f64| random.random_range(-size..=size);
    (0..12)
        .map(|_| [even(350.0), even(380.0), even(1.0) * thickness])
        .collect()
}

/// The same as a device sees them that stands nearly upright, mm.
fn probed(random: &mut StdRng, nominal: &[Vector], noise: f64) -> Vec<Vector> {
    let pose = Pose::from_xyz_rxryrz([50.0, -80.0, 12.0, 0.03, -0.02, 0.3]);
    let each = nominal.iter().map(|p| pose.transform(*p));
    each.map(|p| noisy(random, p, noise)).collect()
}

#[test]
fn a_plate_that_comes_out_upside_down_is_said() {
    let folder = scratch();
    let at = folder.path();
    let mut random = seeded(54);
    for thickness in [0.0, 0.12] {
        let nominal = plate(&mut random, thickness);
        let seen = probed(&mut random, &nominal, 0.04);
        write(at, "from.csv", &points(&nominal));
        let swapped: Vec<Vector> = seen.iter().map(|[x, y, z]| [*y, *x, *z]).collect();
        let mirrored: Vec<Vector> = seen.iter().map(|[x, y, z]| [*x, -*y, *z]).collect();
        for (rows, over) in [(&seen, false), (&swapped, true), (&mirrored, true)] {
            write(at, "to.csv", &points(rows));
            let (status, report, reported) = registered(at, &["register", "from.csv", "to.csv"]);
            assert_eq!(status, 0, "{reported}");
            let said = has(&report, "plane-turned-over");
            assert_eq!(said, over, "{thickness}: {report}");
        }
    }
    // a plate of some thickness is a mirror image by itself, and one that lies upside down is none
    let nominal = plate(&mut random, 20.0);
    let seen = probed(&mut random, &nominal, 0.04);
    write(at, "from.csv", &points(&nominal));
    let mirrored: Vec<Vector> = seen.iter().map(|[x, y, z]| [*x, -*y, *z]).collect();
    write(at, "to.csv", &points(&mirrored));
    let (status, _, reported) = registered(at, &["register", "from.csv", "to.csv"]);
    assert!(status == 2 && reported.contains("mirrored"), "{reported}");
    let over: Vec<Vector> = seen.iter().map(|[x, y, z]| [*x, -*y, -*z]).collect();
    write(at, "to.csv", &points(&over));
    let (status, report, reported) = registered(at, &["register", "from.csv", "to.csv"]);
    assert_eq!(status, 0, "{reported}");
    assert!(!has(&report, "plane-turned-over"), "{report}");
}

#[test]
fn one_row_that_spoils_the_motion_is_an_error_that_names_it() {
    let folder = scratch();
    let at = folder.path();
    let mut random = seeded(55);
    let nominal = plate(&mut random, 200.0);
    let seen = probed(&mut random, &nominal, 0.04);
    write(at, "from.csv", &points(&nominal));
    let mut far = seen.clone();
    far[5][2] += 1000.0;
    let mut exchanged = seen.clone();
    exchanged.swap(2, 8);
    for (rows, names) in [(&far, &["6 ("][..]), (&exchanged, &["3 (", "9 ("])] {
        write(at, "to.csv", &points(rows));
        let (status, _, reported) = registered(at, &["register", "from.csv", "to.csv"]);
        assert_eq!(status, 2, "{reported}");
        let flat = reported.split_whitespace().collect::<Vec<_>>().join(" ");
        for word in ["5 % of their spread", "--robust"].iter().chain(names) {
            assert!(flat.contains(word), "{word}: {flat}");
        }
        let robust = ["register", "from.csv", "to.csv", "--robust"];
        let (status, report, reported) = registered(at, &robust);
        assert_eq!(status, 0, "{reported}");
        assert!(report["rmsd_mm"].as_f64().expect("mm") < 0.2, "{report}");
    }
}

#[test]
fn copies_of_points_and_of_rows_of_sweeps_count_once() {
    let folder = scratch();
    let at = folder.path();
    let mut random = seeded(56);
    let nominal = plate(&mut random, 200.0);
    let seen = probed(&mut random, &nominal, 0.04);
    let run = |count: usize, times: usize| {
        write(at, "from.csv", &points(&nominal[..count].repeat(times)));
        write(at, "to.csv", &points(&seen[..count].repeat(times)));
        let (status, report, reported) = registered(at, &["register", "from.csv", "to.csv"]);
        assert_eq!(status, 0, "{reported}");
        assert_eq!(has(&report, "duplicate-rows"), times > 1, "{report}");
        report
    };
    for count in [3, 8] {
        let (once, often) = (run(count, 1), run(count, 4));
        assert_eq!(once["sigma"], often["sigma"]);
        assert_eq!(has(&often, "few-points"), count == 3);
    }

    let profile = repository("robots/abb_irb120_thesis.yaml");
    let profile = profile.to_str().expect("plain");
    let sweeps = text("docs/measuring/sweeps.csv");
    let (head, rows) = sweeps.split_once('\n').expect("a header");
    let run = |times: usize| -> Value {
        write(at, "sweeps.csv", &format!("{head}\n{}", rows.repeat(times)));
        let words = ["axes", "sweeps.csv", "--profile", profile];
        let (status, report, reported) = registered(at, &words);
        assert_eq!(status, 0, "{reported}");
        assert_eq!(has(&report, "duplicate-rows"), times > 1, "{report}");
        report
    };
    let (once, thrice) = (run(1), run(3));
    assert_eq!(once["base_sigma"], thrice["base_sigma"]);
    assert_eq!(once["tool_sigma"], thrice["tool_sigma"]);
}
