//! The noise of poses measured more than once: found again, and used.

use super::commands::diagnosed;
use super::{group, standing, with_csv, without_sigma};
use crate::trial::{Case, Group, NOISE_MM, case, case_of};
use poseshift::diagnose::estimator::table::Layout;
use poseshift::diagnose::question::noise::{Repeats, of_repeats};
use poseshift::diagnose::question::shifts::Shifts;
use poseshift::diagnose::question::{Trust, session};
use poseshift::diagnose::{Diagnosis, Found, NoiseSource, Options, Standing, Verdict, diagnose};
use poseshift::geometry::Pose;
use poseshift::identify::measurements::Observed;
use poseshift::identify::parameters::{Level, Selection};
use poseshift::identify::problem::{Problem, Row};
use poseshift::model::effects::{BASE, Kind};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::sync::Arc;

/// Poses, and how often each is measured.
const SESSION: (usize, usize) = (60, 3);

fn quick(case: &Case) -> Diagnosis {
    let options = Options {
        quick: true,
        ..Options::default()
    };
    diagnose(&case.profile, &case.measurements, &options, &mut |_| {}).expect("enough rows")
}

/// The measurements with something added to each row's place, mm.
fn moved(case: Case, mut by: impl FnMut(usize) -> [f64; 3]) -> Case {
    let mut lines = case.csv.lines();
    let header = lines.next().expect("a header").to_owned();
    let at = header.split(',').position(|c| c == "x_mm");
    let at = at.expect("a column");
    let mut csv = header + "\n";
    for (row, line) in lines.enumerate() {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        for (k, by) in by(row).into_iter().enumerate() {
            let value: f64 = cells[at + k].parse().expect("a number");
            cells[at + k] = format!("{:.6}", value + by);
        }
        csv += &(cells.join(",") + "\n");
    }
    with_csv(case, csv)
}

fn normal(random: &mut StdRng) -> f64 {
    // the sum of twelve: variance one
    (0..12).map(|_| random.random_range(-0.5..0.5)).sum()
}

/// What repeated poses say of residuals that are given, in a session of one pose measured `times`
/// times, then another, and so on, or of all poses once, then all again.
fn noise_of(
    in_turn: bool,
    change: impl Fn(&mut Vec<Row>),
    residual: impl Fn(usize, &mut StdRng) -> f64,
) -> Option<Repeats> {
    let case = case_of(group("clean"), 0, 5, SESSION);
    let base = case.profile.world_from_base;
    let selection = Selection::level(Level::Geometry);
    let (mut problem, _) =
        Problem::new(&case.profile, &case.measurements, &selection, base).expect("a problem");
    if in_turn {
        let (poses, times) = SESSION;
        let rows = problem.rows.clone();
        let other = (0..poses * times).map(|k| rows[k % poses * times].clone());
        problem.rows = Arc::new(other.collect());
        for (k, row) in Arc::make_mut(&mut problem.rows).iter_mut().enumerate() {
            row.observed = rows[k].observed;
            row.conditions.time_s = rows[k].conditions.time_s;
            row.conditions.temperature_c = Some(23.0);
        }
    }
    change(Arc::make_mut(&mut problem.rows));
    let mut random = StdRng::seed_from_u64(11);
    let layout = Layout::of(&problem);
    let residual: Vec<f64> = (0..layout.rows())
        .flat_map(|row| layout.row(row).map(move |_| row))
        .map(|row| residual(row, &mut random))
        .collect();
    of_repeats(
        &problem,
        &layout,
        &residual,
        &vec![true; problem.rows.len()],
    )
}

#[test]
fn noise_is_found_from_successive_repetitions() {
    // what the model misses at a pose is no noise
    let wrong = |row: usize| ((row / SESSION.1) as f64).sin() * 50.0;
    let found = noise_of(
        false,
        |_| {},
        |row, random| wrong(row) + 2.0 * normal(random),
    );
    let found = found.expect("enough repetitions");
    // two successive differences of three numbers tell as much as 1.6; some are not near in
    // temperature
    let all = (3 * SESSION.0) as f64 * 1.6;
    assert!(
        found.freedom > 0.7 * all && found.freedom <= all,
        "{}",
        found.freedom
    );
    let deviation = 2.0 / (2.0 * found.freedom).sqrt();
    assert!(
        (found.scale - 2.0).abs() < 3.0 * deviation,
        "{}",
        found.scale
    );
    assert!(found.least() < found.scale && found.least() > 0.7 * found.scale);
}

#[test]
fn one_wrong_reading_does_not_make_the_noise() {
    let found = noise_of(
        false,
        |_| {},
        |row, random| normal(random) + if row == 40 { 1e4 } else { 0.0 },
    );
    let found = found.expect("enough repetitions");
    assert!((found.scale - 1.0).abs() < 0.2, "{}", found.scale);
}

#[test]
fn drift_over_hours_is_no_noise_where_repetitions_follow_one_another() {
    let drift = |row: usize| 0.5 * row as f64;
    let near = noise_of(
        false,
        |_| {},
        |row, random| drift(row) + 2.0 * normal(random),
    );
    let near = near.expect("enough repetitions").scale;
    assert!((near - 2.0).abs() < 0.3, "{near}");
    // all poses once, then all again, an hour later: what drifts cannot be distinguished from noise
    let far = noise_of(true, |_| {}, |row, random| drift(row) + normal(random));
    let far = far.expect("enough repetitions").scale;
    assert!(far > 10.0, "{far}");
    // but where some poses were measured again at once, those tell
    let some = |rows: &mut Vec<Row>| {
        let before = rows.clone();
        for k in 0..10 {
            let (observed, conditions) = (rows[2 * k + 1].observed, rows[2 * k + 1].conditions);
            rows[2 * k + 1] = before[2 * k].clone();
            rows[2 * k + 1].observed = observed;
            rows[2 * k + 1].conditions = conditions;
            rows[2 * k + 1].conditions.direction = before[2 * k].conditions.direction;
        }
    };
    let both = noise_of(true, some, |row, random| drift(row) + 2.0 * normal(random));
    let both = both.expect("enough repetitions").scale;
    assert!((both - 2.0).abs() < 1.2, "{both}");
}

#[test]
fn other_directions_other_points_and_copies_are_no_repetitions() {
    let other_side = |rows: &mut Vec<Row>| {
        for (k, row) in rows.iter_mut().enumerate() {
            row.conditions.direction = [[-1.0, 0.0, 1.0][k % 3]; 6];
        }
    };
    assert_eq!(
        noise_of(false, other_side, |_, random| normal(random)),
        None
    );
    let copied = |rows: &mut Vec<Row>| {
        for k in 0..rows.len() {
            rows[k].observed = rows[k / SESSION.1 * SESSION.1].observed;
        }
    };
    assert_eq!(noise_of(false, copied, |_, random| normal(random)), None);
    // three numbers of one pose measured twice are too few
    let once = |rows: &mut Vec<Row>| {
        for (k, row) in rows.iter_mut().enumerate().skip(2) {
            row.q[0] += 1e-6 * k as f64;
        }
    };
    assert_eq!(noise_of(false, once, |_, random| normal(random)), None);
    let signs = |rows: &mut Vec<Row>| {
        for (k, row) in rows.iter_mut().enumerate() {
            row.q[5] = if k % 2 == 0 { 0.0 } else { -0.0 };
        }
    };
    assert!(noise_of(false, signs, |_, random| normal(random)).is_some());
}

#[test]
fn without_sigma_the_noise_comes_from_repeated_poses() {
    for (name, number) in [("clean", 0), ("clean", 3), ("calibrated", 13)] {
        let plain = case_of(group(name), number, 8, SESSION);
        let what = plain.what.clone();
        let case = without_sigma(plain);
        let found = quick(&case);
        assert_eq!(found.noise_source, NoiseSource::Repeats);
        let noise_mm = 1e3 * found.noise_m;
        // four standard deviations of an estimate from 200 degrees of freedom
        assert!(
            (noise_mm / NOISE_MM - 1.0).abs() < 0.2,
            "{what}: {noise_mm}"
        );
        let sure = if case.answer.is_empty() {
            Verdict::NothingMissing
        } else {
            Verdict::Explained
        };
        assert_eq!(found.verdict, sure, "{what}: {:?}", found.reasons);
    }
    let case = without_sigma(case_of(group("clean"), 0, 8, SESSION));
    let (status, out, error) = diagnosed(&case, &["--quick"]);
    assert_eq!(status, 0, "{error}");
    assert!(out.contains("mm a coordinate by repeated poses"), "{out}");
    let (_, out, _) = diagnosed(&case, &["--quick", "--json"]);
    let report: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(report["noise_source"], "repeats");
}

#[test]
fn stated_noise_is_taken_whatever_repeated_poses_show() {
    let found = quick(&case_of(group("clean"), 0, 8, SESSION));
    assert_eq!(found.noise_source, NoiseSource::Given);
    assert!((1e3 * found.noise_m - NOISE_MM).abs() < 1e-12);
}

#[test]
fn what_repeats_at_a_pose_and_no_function_tells_is_missing() {
    // an error of its own at each pose, the same each time it is measured
    let mut random = StdRng::seed_from_u64(4);
    let own: Vec<[f64; 3]> = (0..SESSION.0 * SESSION.1)
        .map(|_| std::array::from_fn(|_| 0.1 * normal(&mut random)))
        .collect();
    let times = SESSION.1;
    let hidden = |row: usize| own[row / times];
    let repeated = moved(
        without_sigma(case_of(group("clean"), 0, 8, SESSION)),
        hidden,
    );
    let found = quick(&repeated);
    assert_eq!(found.verdict, Verdict::Undetermined);
    let reported = found.reasons.iter();
    let reported = reported.filter(|r| r.contains("the noise that repeated poses show"));
    assert_eq!(reported.count(), 1, "{:?}", found.reasons);
    assert!(found.residual_m > 2.0 * found.noise_m);
    // measured once each there is no telling it from noise
    let once = moved(
        without_sigma(case(group("clean"), 0, 8, SESSION.0)),
        |row| own[row],
    );
    assert_eq!(quick(&once).noise_source, NoiseSource::Residuals);
}

#[test]
fn what_no_effect_explains_is_missing_by_the_noise_of_repeated_poses() {
    let mut sure = Vec::new();
    for number in 0..12 {
        let plain = case_of(group("unregistered"), number, 8, SESSION);
        let what = plain.what.clone();
        let found = quick(&without_sigma(plain));
        assert_eq!(found.noise_source, NoiseSource::Repeats);
        assert_ne!(found.verdict, Verdict::NothingMissing, "{what}");
        if found.verdict == Verdict::Explained {
            sure.push(what);
        }
    }
    assert!(sure.len() <= 1, "{sure:?}");
}

#[test]
fn what_the_rows_of_a_pose_share_is_no_evidence() {
    // joints that scatter move all reflectors of a pose alike
    let mut random = StdRng::seed_from_u64(5);
    let mut named = Vec::new();
    for number in 0..4 {
        let own: Vec<[f64; 3]> = (0..100)
            .map(|_| std::array::from_fn(|_| 0.1 * normal(&mut random)))
            .collect();
        let plain = case_of(group("clean"), number, 8, (100, 3));
        let case = moved(plain, |row| own[row / 3]);
        let found = standing::found(&case, &Options::default());
        let sure = |f: &&Found| f.standing == Standing::Certain;
        assert_eq!(found.found.iter().filter(sure).count(), 0);
        assert_ne!(found.verdict, Verdict::Improved, "{:?}", found.reasons);
        named.extend(found.found.iter().map(|f| f.effect.label()));
    }
    // a chance of some percent each; counted by rows there were several in each session
    assert!(named.len() <= 2, "{named:?}");
}

#[test]
fn outliers_that_are_reported_do_not_make_the_noise_louder() {
    let plain = case(group("clean"), 0, 3, 300);
    let case = moved(plain, |row| match row % 26 {
        5 => [2.0, -1.5, 1.0],
        18 => [-2.0, 1.5, -1.0],
        _ => [0.0; 3],
    });
    let found = quick(&case);
    assert_eq!(
        found.verdict,
        Verdict::NothingMissing,
        "{:?}",
        found.reasons
    );
    assert_eq!(found.outliers.len(), 23);
}

#[test]
fn a_base_that_drifts_may_be_a_device_that_does() {
    let plain = case(group("clean"), 0, 3, 150);
    let drift = |row: usize| [3e-3 * row as f64, -2e-3 * row as f64, 0.0];
    let case = moved(plain, drift);
    let found = diagnose(
        &case.profile,
        &case.measurements,
        &Options::default(),
        &mut |_| {},
    );
    let found = found.expect("enough rows").found;
    let base = found.iter().find(|f| f.effect.kind == Kind::WarmUpDrift);
    let base = base.expect("the drift is found");
    assert_eq!(base.effect.site.index, BASE);
    assert!(base.standing < Standing::Certain);
    assert!(base.against[0].what.contains("the measuring device"));
}

#[test]
fn orientations_weigh_by_what_they_scatter_where_no_column_says() {
    // poses with 0.03 mm and 1e-4 rad of noise
    let nothing = Group {
        hidden: 0,
        size: (0.0, 0.0),
        ..group("devices").clone()
    };
    let case = case(&nothing, 3, 5, 150);
    assert!(case.csv.contains(",qw,") && case.csv.contains("sigma_mm"));
    let sigma_rad = |more: f64, stated: Option<f64>| {
        let mut measurements = case.measurements.clone();
        let mut random = StdRng::seed_from_u64(3);
        for row in &mut measurements.rows {
            row.sigma_rad = stated;
            if let Observed::Pose(pose) = &mut row.observed {
                let by: [f64; 3] = std::array::from_fn(|_| more * normal(&mut random));
                *pose = *pose * Pose::from_xyz_rxryrz([0.0, 0.0, 0.0, by[0], by[1], by[2]]);
            }
        }
        let trust = Trust::Calibrated { g: 1.0 };
        let (session, _) = session(
            &case.profile,
            &measurements,
            trust,
            &|_| false,
            (&Shifts::default(), None),
        )
        .expect("enough rows");
        session.problem.rows[0].sigma_rad
    };
    for more in [0.0, 4e-4] {
        let expected = f64::hypot(1e-4, more);
        let found = sigma_rad(more, None);
        // each of two mean squares of 450 numbers is known to 7 %
        assert!((found / expected - 1.0).abs() < 0.1, "{more}: {found}");
    }
    assert!((sigma_rad(4e-4, Some(2e-4)) - 2e-4).abs() < 1e-12);
}
