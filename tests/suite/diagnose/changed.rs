//! Effects that the profile has and that are not what they were: where frames and geometry are
//! fitted anew these are, too, and what came out is named.

use super::written::{Joints, everywhere, measured};
use crate::support::{poseshift, report, repository, scratch, text};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A spring of the profile, and what it is in the arm that took its place.
const SPRINGS: [(&str, &str, f64, f64); 5] = [
    ("joint: 2", "3.2e-5", 3.2e-5, 6.5e-5),
    ("joint: 3", "1.3e-4", 1.3e-4, 2.6e-4),
    ("joint: 4", "6.05e-4", 6.05e-4, 8.05e-4),
    ("joint: 5", "4.19e-4", 4.19e-4, 2.2e-4),
    ("joint: 6", "6.47e-4", 6.47e-4, 9.9e-4),
];
/// The geometry of that arm.
const GEOMETRY: [(&str, &str); 6] = [
    (
        "alpha_deg: -0.006, a_mm: 0.134, theta_deg: 0.091",
        "alpha_deg: 0.03, a_mm: 0.434, theta_deg: 0.031",
    ),
    (
        "a_mm: 0.236, theta_deg: 0.054",
        "a_mm: -0.136, theta_deg: -0.04",
    ),
    (
        "alpha_deg: -0.009, a_mm: 0.138, theta_deg: -0.027",
        "alpha_deg: 0.05, a_mm: -0.2, theta_deg: 0.03",
    ),
    (
        "alpha_deg: -0.016, a_mm: -0.061, theta_deg: 0.067",
        "alpha_deg: 0.04, a_mm: 0.2, theta_deg: -0.06",
    ),
    ("alpha_deg: 0.031", "alpha_deg: -0.05"),
    ("theta_deg: -0.087", "theta_deg: 0.02"),
];

/// By how much joints 2 and 4 are off, as no effect is.
fn off(q: &Joints) -> Joints {
    let mut off = [0.0; 6];
    for (joint, size, times) in [(1, 0.02, 2.3), (3, 0.05, 1.7)] {
        off[joint] = size * (times * q[joint].to_radians()).sin().abs();
    }
    off
}

/// The profile of the other arm.
fn robot(folder: &Path) -> PathBuf {
    let mut robot = text("robots/abb_irb120_thesis.yaml");
    let springs = SPRINGS.map(|(place, was, _, now)| {
        let of = |value: &str| format!("{place}, rad_per_n_m: {value}");
        (of(was), of(&format!("{now:e}")))
    });
    let geometry = GEOMETRY.map(|(was, now)| (was.to_owned(), now.to_owned()));
    for (was, now) in springs.iter().chain(&geometry) {
        assert!(robot.contains(was), "{was}");
        robot = robot.replacen(was, now, 1);
    }
    let path = folder.join("robot.yaml");
    std::fs::write(&path, robot).expect("a scratch file");
    path
}

fn diagnose(rows: &Path, page: &Path) -> assert_cmd::Command {
    let mut command = poseshift();
    let profile = repository("robots/abb_irb120_thesis.yaml");
    command.arg("diagnose").arg("--profile").arg(profile);
    command.arg("--measurements").arg(rows);
    command.arg("--report").arg(page);
    command
}

#[test]
fn springs_of_the_profile_that_are_others_are_named_with_both_values() {
    let folder = scratch();
    let (robot, page) = (robot(folder.path()), folder.path().join("page.html"));
    let joints = (&everywhere(3, 150)[..], 0.02);
    let rows = measured(folder.path(), (&robot, "seen.csv"), joints, off);
    let found = report(diagnose(&rows, &page).arg("--json"));
    let changed = found["changed"].as_array().expect("a list");
    let absorbed = found["absorbed"].as_array().expect("a list");
    assert!(absorbed.contains(&Value::from("joint_compliance")));
    let out = diagnose(&rows, &page).assert().get_output().stdout.clone();
    let words = String::from_utf8(out).expect("UTF-8");
    let page = std::fs::read_to_string(&page).expect("the page");
    assert!(page.contains("What is not as the profile has it"));
    for (joint, (_, _, was, now)) in (2..).zip(SPRINGS).take(4) {
        let of = (changed.iter())
            .find(|c| c["effect"] == "joint_compliance" && c["joint"].as_u64() == Some(joint));
        let of = of.unwrap_or_else(|| panic!("joint {joint}: {changed:?}"));
        assert_eq!(of["was"]["rad_per_n_m"].as_f64(), Some(was));
        let value = of["parameters"]["rad_per_n_m"].as_f64().expect("a number");
        let sigma = of["sigma"]["rad_per_n_m"].as_f64().expect("a number");
        // the joints that are off leave some of it, too
        assert!(
            (value - now).abs() < 0.1 * (now - was).abs(),
            "{joint}: {value} {now}"
        );
        assert!(of["times_sigma"].as_f64() > Some(5.0) && sigma > 0.0);
        let line = format!("changed   joint_compliance joint {joint}: rad_per_n_m {was:.4e}");
        assert!(words.contains(&line), "{words}");
    }
}
