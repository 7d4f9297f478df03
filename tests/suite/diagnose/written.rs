//! What is written is the model that was judged: it predicts the rows as was reported, and other
//! rows no worse than the profile did before.

use crate::support::{poseshift, report, repository, scratch};
use poseshift::model::effects::{Effect, Kind, Seen, Site};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::cell::Cell;
use std::fmt::Write;
use std::path::{Path, PathBuf};

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
pub(super) type Joints = [f64; 6];

/// Postures all over the work space.
pub(super) fn everywhere(seed: u64, count: usize) -> Vec<Joints> {
    let mut random = StdRng::seed_from_u64(seed);
    let limits = [130.0, 80.0, 70.0, 130.0, 95.0, 140.0];
    let one = |_| limits.map(|limit: f64| random.random_range(-limit..limit));
    (0..count).map(one).collect()
}

/// Postures along one path, which hardly show some parameters of the arm.
fn along_a_path(count: usize) -> Vec<Joints> {
    let one = |k: usize| {
        let t = k as f64 / count as f64;
        [
            -30.0 + 60.0 * t,
            20.0 + 8.0 * (5.0 * t).sin(),
            -15.0 + 10.0 * (7.0 * t).cos(),
            5.0 * (3.0 * t).sin(),
            60.0 + 6.0 * (4.0 * t).cos(),
            20.0 * t,
        ]
    };
    (0..count).map(one).collect()
}

/// The arm of a profile measured at postures at which each joint is off by what `hidden` says, in
/// degrees.
pub(super) fn measured(
    folder: &Path,
    (profile, name): (&Path, &str),
    (joints, noise_mm): (&[Joints], f64),
    hidden: impl Fn(&Joints) -> Joints,
) -> PathBuf {
    let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
    let row = |q: &Joints| q.map(|q| format!("{q:.6}")).join(",");
    let (mut asked, real) = (header.to_owned(), folder.join("joints.csv"));
    for q in joints {
        let off = hidden(q);
        let _ = writeln!(asked, "{}", row(&std::array::from_fn(|k| q[k] + off[k])));
    }
    std::fs::write(&real, asked).expect("a scratch file");
    let seen = folder.join("seen.csv");
    poseshift()
        .args(["simulate", "--tool", "artifact", "--seed", "7", "--profile"])
        .arg(profile)
        .args(["--noise-mm", &noise_mm.to_string(), "--joints"])
        .arg(&real)
        .arg("-o")
        .arg(&seen)
        .assert()
        .success();
    // at the angles that the controller believes
    let text = std::fs::read_to_string(&seen).expect("measurements");
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let first = columns.iter().position(|c| *c == "q1_deg").expect("joints");
    let mut csv = columns.join(",") + "\n";
    for (line, q) in lines.zip(joints) {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        for k in 0..6 {
            cells[first + k] = format!("{:.6}", q[k]);
        }
        csv += &(cells.join(",") + "\n");
    }
    let path = folder.join(name);
    std::fs::write(&path, csv).expect("a scratch file");
    path
}

/// The mean error of a profile on some rows, mm.
fn mean(profile: &Path, rows: &Path) -> f64 {
    let found = report(
        poseshift()
            .args(["validate", "--json", "--profile"])
            .arg(profile)
            .arg("--measurements")
            .arg(rows),
    );
    let mean = &found["position"]["real"]["mean_mm"];
    mean.as_f64().expect("positions")
}

/// Mean errors on the rows diagnosed and on others, before and after, and the answer.
fn written(joints: &[Joints], hidden: impl Fn(&Joints) -> Joints) -> ([f64; 4], Value) {
    let folder = scratch();
    let none = |_: &Joints| [0.0; 6];
    let calibrated = measured(
        folder.path(),
        (&repository(PROFILE), "first.csv"),
        (&everywhere(5, 80), 0.03),
        none,
    );
    let start = folder.path().join("start.yaml");
    poseshift()
        .args(["calibrate", "--level", "3", "--profile"])
        .arg(repository(PROFILE))
        .arg("--measurements")
        .arg(calibrated)
        .arg("-o")
        .arg(&start)
        .assert()
        .success();
    let rows = measured(
        folder.path(),
        (&repository(PROFILE), "rows.csv"),
        (joints, 0.03),
        &hidden,
    );
    let others = measured(
        folder.path(),
        (&repository(PROFILE), "others.csv"),
        (&everywhere(99, 200), 0.0),
        &hidden,
    );
    let better = folder.path().join("better.yaml");
    let run = poseshift()
        .args(["diagnose", "--json", "--profile"])
        .arg(&start)
        .arg("--measurements")
        .arg(&rows)
        .arg("-o")
        .arg(&better)
        .output()
        .expect("the program starts");
    let found: Value = serde_json::from_slice(&run.stdout).expect("JSON");
    let verdict = &found["verdict"];
    assert_eq!(better.exists(), run.status.code() == Some(0), "{verdict}");
    let after = if better.exists() {
        better
    } else {
        start.clone()
    };
    let means = [
        mean(&start, &rows),
        mean(&after, &rows),
        mean(&start, &others),
        mean(&after, &others),
    ];
    (means, found)
}

#[test]
fn nothing_is_moved_where_nothing_is_missing() {
    for joints in [along_a_path(120), everywhere(4, 150)] {
        let ([before, after, elsewhere, then], found) = written(&joints, |_| [0.0; 6]);
        assert_eq!(found["verdict"], "nothing_missing");
        assert!(after < 1.02 * before, "{before} {after}");
        assert!(then < 1.1 * elsewhere + 0.005, "{elsewhere} {then}");
    }
}

#[test]
fn what_no_effect_does_makes_no_profile_worse() {
    let of_two: fn(&Joints) -> Joints = |q| [0.0, 0.05 * q[1] * q[2] / 3000.0, 0.0, 0.0, 0.0, 0.0];
    let wave: fn(&Joints) -> Joints = |q| {
        let angle = (3.0 * (q[1] + q[2])).to_radians();
        [0.0, 0.0, 0.05 * angle.sin(), 0.0, 0.0, 0.0]
    };
    for (count, hidden) in [(150, of_two), (300, wave)] {
        let ([before, after, elsewhere, then], found) = written(&everywhere(31, count), hidden);
        let verdict = &found["verdict"];
        assert!(after <= before, "{verdict}: {before} {after}");
        assert!(then < 1.05 * elsewhere, "{verdict}: {elsewhere} {then}");
    }
}

/// A joint that loses its zero within the session: what is written is no worse for the robot as it is
/// now.
#[test]
fn a_joint_that_jumps_within_the_session_makes_no_profile_worse() {
    for (joint, from, size) in [(2, 75, 0.02), (1, 60, -0.02), (3, 90, 0.04)] {
        let row = Cell::new(0);
        let jumps = |_: &Joints| {
            row.set(row.get() + 1);
            let mut off = [0.0; 6];
            off[joint] = if row.get() > from { size } else { 0.0 };
            off
        };
        let ([.., elsewhere, then], found) = written(&everywhere(31, 150), jumps);
        let verdict = &found["verdict"];
        assert!(
            then < 1.05 * elsewhere,
            "{joint} {verdict}: {elsewhere} {then}"
        );
        let effects = found["effects"].as_array().expect("effects");
        let is_followed = effects.iter().all(|e| e["in_profile"] == true);
        let compared = &found["held_out"]["compared"];
        if verdict == "improved" && !is_followed {
            let [before, after] = ["before", "after"].map(|of| compared[of]["mean_mm"].as_f64());
            assert!(after < before, "{compared}");
        }
    }
}

/// Poses measured in cycles are no rows that were not used, wherever in the file they come again.
#[test]
fn poses_measured_again_later_do_not_prove_a_model() {
    let once = everywhere(61, 50);
    let cycles: Vec<Joints> = once.iter().cycle().take(150).copied().collect();
    let wobble = |q: &Joints| {
        let (sin, cos) = (2.0 * q[0]).to_radians().sin_cos();
        [
            0.0,
            0.04 * sin,
            0.04 * cos * (0.5 * q[1]).to_radians().cos(),
            0.0,
            0.0,
            0.0,
        ]
    };
    let ([before, after, elsewhere, then], found) = written(&cycles, wobble);
    let verdict = &found["verdict"];
    assert!(after <= before, "{verdict}: {before} {after}");
    assert!(then < 1.05 * elsewhere, "{verdict}: {elsewhere} {then}");
}

#[test]
fn a_wave_of_any_order_is_one_wave() {
    let wave = |q: &Joints| {
        let angle = (49.67 * q[1]).to_radians();
        [0.0, 0.03 * angle.sin(), 0.0, 0.0, 0.0, 0.0]
    };
    let ([.., elsewhere, then], found) = written(&everywhere(8, 150), wave);
    let effects = found["effects"].as_array().expect("effects");
    let orders: Vec<f64> = effects.iter().filter_map(|e| e["order"].as_f64()).collect();
    assert_eq!(effects.len(), 1, "{effects:?}");
    assert!((orders[0] - 49.67).abs() < 0.05, "{orders:?}");
    assert_eq!(found["verdict"], "explained");
    assert!(then < 0.5 * elsewhere, "{elsewhere} {then}");
}

#[test]
fn sentences_say_what_there_is_and_which_way() {
    let said = |kind: Kind, parameters: [f64; 6]| {
        let site = Site {
            order: 1,
            ..Site::default()
        };
        let effect = Effect {
            kind,
            site,
            parameters,
        };
        effect.sentence(&Seen::default())
    };
    let [place, turned, both] = [
        [1e-3, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, 2e-3],
        [1e-3, 0.0, 0.0, 0.0, 0.0, 2e-3],
    ]
    .map(|parameters| said(Kind::BaseFrame, parameters));
    assert!(
        place.contains("1.000 mm") && !place.contains('°'),
        "{place}"
    );
    assert!(
        turned.contains("0.115°") && !turned.contains("mm"),
        "{turned}"
    );
    assert!(
        both.contains("1.000 mm") && both.contains("0.115°"),
        "{both}"
    );
    // a moment has one direction: it bends about one axis or the other, or less about each
    let bends = [6e-7, -8e-7, 0.0, 0.0, 0.0, 0.0];
    for kind in [Kind::BaseCompliance, Kind::LinkCompliance] {
        let said = said(kind, bends);
        assert!(
            said.contains("0.0046° at most") || said.contains("4.6e-3° at most"),
            "{said}"
        );
    }
    let moved = said(Kind::PayloadError, [0.0, 0.2, 0.0, 0.0, 0.0, 0.0]);
    assert!(
        moved.contains("200.000 mm") && !moved.contains("kg"),
        "{moved}"
    );
    let lighter = said(Kind::PayloadError, [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert!(
        lighter.contains("1.000 kg lighter") && !lighter.contains(" mm"),
        "{lighter}"
    );
    for (ratio, words) in [(1.2e-4, "too far"), (-1.2e-4, "too little")] {
        let scale = said(Kind::JointScale, [ratio, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert!(scale.contains(&format!("0.011° {words}")), "{scale}");
    }
}
