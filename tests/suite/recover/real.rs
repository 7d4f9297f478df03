//! Real measurements, where the folder with them is there: held-out errors must meet the reference figures.

use crate::support::repository;
use poseshift::identify::calibration::{Options, calibrate};
use poseshift::identify::measurements::{Measurements, Purpose};
use poseshift::identify::parameters::{Level, Selection};
use poseshift::identify::validation::validate;
use poseshift::model::profile::Profile;

/// A set's profile and measurements; `None`, told, where the folder is not there.
fn read(set: &str, file: &str) -> Option<(Profile, Measurements)> {
    let folder = repository("../shared/data/real").join(set);
    let Ok(text) = std::fs::read_to_string(folder.join("profile.yaml")) else {
        println!("skipped: {} is not there", folder.display());
        return None;
    };
    let bytes = std::fs::read(folder.join(file)).expect("measurements beside the profile");
    let profile = Profile::from_yaml(&text).expect("a profile");
    Some((
        profile,
        Measurements::from_csv(&bytes).expect("measurements"),
    ))
}

/// Mean position error in mm on the other half, even configurations fitted.
fn held_out(set: &str, level: Level, every: usize) -> Option<f64> {
    let (profile, mut measurements) = read(set, "fit.csv")?;
    let configurations = measurements.configurations();
    for (row, number) in measurements.rows.iter_mut().zip(configurations) {
        row.purpose = Some(if number % every == 0 {
            Purpose::Fit
        } else {
            Purpose::Validate
        });
    }
    let options = Options {
        selection: Selection::level(level),
        ..Options::default()
    };
    let found = calibrate(&profile, &measurements, &options).expect("an answer");
    let (frames, full) = found.held_out.expect("rows for validation");
    let (frames, full) = (
        frames.position.expect("positions"),
        full.position.expect("positions"),
    );
    println!(
        "{set} {level:?} every {every}: {:.3} -> {:.3} mm (max {:.3})",
        frames.mean, full.mean, full.max
    );
    Some(full.mean)
}

#[test]
fn held_out_errors_meet_the_reference() {
    for (set, every, geometry, compliance) in [
        ("irb120_faro", 2, 0.192, 0.106),
        ("irb120_faro", 12, 0.192, 0.110),
        ("ur5_tracker", 2, 0.106, 0.097),
        ("ma1400_leica", 2, 1.43, 0.505),
    ] {
        let Some(mean) = held_out(set, Level::Geometry, every) else {
            return;
        };
        assert!(mean < geometry + 5e-4, "{set} geometry: {mean}");
        let mean = held_out(set, Level::Compliance, every).expect("the set is there");
        assert!(mean < compliance + 5e-4, "{set} compliance: {mean}");
    }
}

#[test]
fn folds_and_links_carried_over_meet_the_reference() {
    let Some((profile, fit)) = read("tx2_90l_tmac", "fit.csv") else {
        return;
    };
    let (_, points) = read("tx2_90l_tmac", "points.csv").expect("it is beside");
    for (level, folds, carried) in [
        (Level::Geometry, 0.136, 0.0835),
        (Level::Compliance, 0.058, 0.0560),
    ] {
        let options = Options {
            selection: Selection::level(level),
            ..Options::default()
        };
        let found = calibrate(&profile, &fit, &options).expect("an answer");
        let own = validate(&found.profile(), &fit, false, Some(8)).expect("a validation");
        let (_, full, frames) = own.folds.expect("folds were asked for");
        let (full, frames) = (
            full.position.expect("positions"),
            frames.position.expect("positions"),
        );
        println!(
            "tx2_90l 8-fold {level:?}: {:.3} -> {:.3} mm",
            frames.mean, full.mean
        );
        assert!(full.mean < folds, "{}", full.mean);
        let others = validate(&found.profile(), &points, true, None).expect("a validation");
        let real = others.real.quality.position.expect("positions");
        println!("tx2_90l links carried over {level:?}: {:.3} mm", real.mean);
        assert!(real.mean < carried, "{}", real.mean);
    }
}
