//! What changes in a session, or was there from its first row on: which of the arm, the device and
//! the tool it is.

use super::group;
use super::standing::{found, moved};
use crate::trial::{Case, case};
use poseshift::diagnose::{Diagnosis, Options, Standing};
use poseshift::model::Conditions;

/// A session of nothing but noise in which a joint is elsewhere, by this angle in radians from the
/// row's number.
fn turning(seed: u64, joint: usize, by: impl Fn(usize) -> f64) -> Case {
    let base = case(group("clean"), 0, seed, 150);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let model = base.profile.real_model(&tool, &Conditions::default());
    moved(base, |row, degrees| {
        let q = degrees.map(f64::to_radians);
        let mut turned = q;
        turned[joint] += by(row);
        let at = |q: &[f64; 6]| model.forward(q, &Conditions::default()).translation;
        let (a, b) = (at(&q), at(&turned));
        std::array::from_fn(|k| 1e3 * (b[k] - a[k]))
    })
}

fn diagnosed(case: &Case) -> Diagnosis {
    found(case, &Options::default())
}

fn is_drift(of: &poseshift::diagnose::Found) -> bool {
    of.effect.label().contains("drift")
}

#[test]
fn a_joint_at_an_end_of_the_arm_that_drifts_may_be_the_device_or_the_tool() {
    for (joint, size, words) in [
        (0, 4e-4, "turns about the axis of joint 1"),
        (5, 3e-3, "turns about the axis of joint 6"),
    ] {
        let d = diagnosed(&turning(4, joint, |row| size * row as f64 / 150.0));
        let drift = d.found.iter().find(|f| is_drift(f));
        let drift = drift.expect("a drift");
        assert_eq!(drift.effect.site.index, joint);
        assert_eq!(drift.standing, Standing::Likely);
        let first = drift.against.first().expect("a device or a tool");
        assert!(first.what.contains(words), "{}", first.what);
        assert!((first.odds - 1.0).abs() < 1e-12);
    }
    // a joint within the arm is none of them
    let d = diagnosed(&turning(4, 2, |row| 4e-4 * row as f64 / 150.0));
    assert_eq!(d.found.len(), 1);
    assert_eq!(d.found[0].standing, Standing::Certain);
}

#[test]
fn what_is_there_from_the_first_row_on_is_no_drift() {
    for seed in 1..9 {
        for joint in [0, 3] {
            let d = diagnosed(&turning(seed, joint, |_| 1.3e-4));
            let named: Vec<String> = d.found.iter().map(|f| f.effect.label()).collect();
            assert!(!d.found.iter().any(is_drift), "{seed} {joint}: {named:?}");
        }
    }
}

#[test]
fn a_device_that_tilts_slowly_is_not_surely_one_that_moved_at_once() {
    // about a stand 2 m away
    let base = case(group("clean"), 0, 4, 150);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let model = base.profile.real_model(&tool, &Conditions::default());
    let tilted = moved(base, |row, degrees| {
        let q = degrees.map(f64::to_radians);
        let p = model.forward(&q, &Conditions::default()).translation;
        let angle = 6e-5 * row as f64 / 150.0;
        let (y, z) = (p[1] - 0.5, p[2] + 1.2);
        [0.0, -1e3 * angle * z, 1e3 * angle * y]
    });
    let d = diagnosed(&tilted);
    for one in &d.found {
        let is_step = one.effect.definition().begins_at_a_row();
        assert!(!is_step || one.standing != Standing::Certain);
    }
}

#[test]
fn a_joint_that_scatters_has_no_certain_wave() {
    for seed in 1..5 {
        // numbers that no effect follows
        let by = |row: usize| (((row * row * 31 + 17 * row) % 211) as f64 / 211.0 - 0.5) * 2e-3;
        let d = diagnosed(&turning(seed, 3, by));
        for one in &d.found {
            let is_wave = one.effect.definition().is_wave();
            let is_high = is_wave && one.effect.site.periods() > 12.0;
            assert!(!is_high || one.standing != Standing::Certain, "{seed}");
        }
    }
}
