//! Real measurements, where the folder with them is there: held-out errors must meet the reference figures.

use crate::support::repository;
use poseshift::identify::calibration::{Options, calibrate};
use poseshift::identify::measurements::{Measurements, Purpose};
use poseshift::identify::parameters::{Level, Selection};
use poseshift::identify::statistics::Quality;
use poseshift::identify::validation::{Refit, validate};
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

/// Mean position errors in mm of configurations that were not fitted: with the frames alone, and with a level identified.
/// Fitted is every so many-th.
fn held_out(set: &str, level: Level, every: usize) -> Option<(f64, f64)> {
    let (profile, mut measurements) = read(set, "fit.csv")?;
    mark(&mut measurements, |number| number % every == 0);
    let options = Options {
        selection: Selection::level(level),
        ..Options::default()
    };
    let found = calibrate(&profile, &measurements, &options).expect("an answer");
    let (frames, full) = found.held_out.expect("rows for validation");
    let (frames, full) = (mean(&frames), mean(&full));
    println!("{set} {level:?} every {every}: {frames:.3} -> {full:.3} mm");
    Some((frames, full))
}

/// Which configurations are for fitting; the others for validation.
fn mark(measurements: &mut Measurements, is_for_fit: impl Fn(usize) -> bool) {
    let configurations = measurements.configurations();
    for (row, number) in measurements.rows.iter_mut().zip(configurations) {
        row.purpose = Some(if is_for_fit(number) {
            Purpose::Fit
        } else {
            Purpose::Validate
        });
    }
}

fn mean(quality: &Quality) -> f64 {
    quality.position.expect("positions").mean
}

#[test]
fn held_out_errors_meet_the_reference() {
    // mm; an independent fit of the same rows is within half a micrometre more, except the last of the MA1400
    for (set, every, frames, geometry, compliance) in [
        ("irb120_faro", 2, 0.729, 0.192, 0.105),
        ("irb120_faro", 12, 0.734, 0.192, 0.109),
        ("ur5_tracker", 2, 0.630, 0.105, 0.096),
        ("ma1400_leica", 2, 1.907, 1.429, 0.505),
    ] {
        let Some((alone, full)) = held_out(set, Level::Geometry, every) else {
            return;
        };
        assert!(alone < frames + 5e-4, "{set} frames: {alone}");
        assert!(full < geometry + 5e-4, "{set} geometry: {full}");
        let (_, full) = held_out(set, Level::Compliance, every).expect("the set is there");
        assert!(full < compliance + 5e-4, "{set} compliance: {full}");
    }
}

#[test]
fn folds_and_links_carried_over_meet_the_reference() {
    let Some((profile, fit)) = read("tx2_90l_tmac", "fit.csv") else {
        return;
    };
    let (_, mut points) = read("tx2_90l_tmac", "points.csv").expect("it is beside");
    let folded = |rows: &Measurements, level: Level, count: usize| {
        let options = Options {
            selection: Selection::level(level),
            ..Options::default()
        };
        let found = calibrate(&profile, rows, &options).expect("an answer");
        let judged = validate(&found.profile(), rows, Refit::No, Some(count)).expect("folds");
        let (_, full, frames) = judged.folds.expect("folds were asked for");
        let (frames, full) = (mean(&frames), mean(&full));
        println!("tx2_90l {count}-fold {level:?}: {frames:.3} -> {full:.3} mm");
        (found, full)
    };
    for (level, own, of_points, carried) in [
        (Level::Geometry, 0.135, 0.069, 0.082),
        (Level::Compliance, 0.057, 0.051, 0.055),
    ] {
        let (found, full) = folded(&fit, level, 8);
        assert!(full < own + 5e-4, "{full}");
        let (_, full) = folded(&points, level, 5);
        assert!(full < of_points + 5e-4, "{full}");
        // the device and the tool were set up anew between the files
        mark(&mut points, |number| number % 5 == 0);
        let others = validate(&found.profile(), &points, Refit::Others, None).expect("judged");
        assert_eq!(others.measurements.rows.len(), 240);
        let real = mean(&others.real.quality);
        let frames = mean(&others.frames_only.quality);
        println!("tx2_90l links carried over {level:?}: {frames:.3} -> {real:.3} mm");
        assert!(real < carried + 5e-4, "{real}");
        points.rows.iter_mut().for_each(|row| row.purpose = None);
    }
}
