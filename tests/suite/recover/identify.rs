//! Robots with known errors, measured with noise: identification must find the errors within its
//! own uncertainty.

use crate::support::{random_joints, repository};
use poseshift::geometry::{Pose, norm, sub};
use poseshift::identify::base::BasePolicy;
use poseshift::identify::calibration::{Options, calibrate};
use poseshift::identify::measurements::{Measurements, Observed};
use poseshift::identify::parameters::{Level, Selection};
use poseshift::identify::pick::Pick;
use poseshift::identify::robust::Shape;
use poseshift::identify::simulate::{Command, Device, Session, simulate};
use poseshift::identify::validation::{Refit, validate};
use poseshift::identify::{Calibration, IdentifyError};
use poseshift::model::effects::{Effect, Kind, Site};
use poseshift::model::external::Stand;
use poseshift::model::profile::{Profile, rewritten};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

pub(super) const MM: f64 = 1e-3;
pub(super) const DEG: f64 = std::f64::consts::PI / 180.0;

/// The thesis's robot without its calibration.
pub(super) fn nominal() -> Profile {
    let text = std::fs::read_to_string(repository("robots/abb_irb120_thesis.yaml"))
        .expect("a shipped profile");
    let mut profile = Profile::from_yaml(&text).expect("a shipped profile");
    profile.effects.clear();
    profile
}

pub(super) fn effect(kind: Kind, index: usize, values: &[f64]) -> Effect {
    let mut parameters = [0.0; 6];
    parameters[..values.len()].copy_from_slice(values);
    let site = Site {
        index,
        ..Site::default()
    };
    Effect {
        kind,
        site,
        parameters,
    }
}

/// A robot with errors of these sizes in what a complete and minimal model has.
pub(super) fn hidden(
    random: &mut StdRng,
    length_m: f64,
    angle_rad: f64,
    compliant: bool,
) -> Profile {
    let mut profile = nominal();
    let mut even = |size: f64| size * random.random_range(-1.0..1.0);
    for link in 1..6 {
        let beta = if link == 2 { even(angle_rad) } else { 0.0 };
        // axes 2 and 3 are parallel: d of link 2 is that of link 3
        let d = if link == 1 { 0.0 } else { even(length_m) };
        let values = [even(angle_rad), even(length_m), beta, even(angle_rad), d];
        profile
            .effects
            .push(effect(Kind::LinkGeometry, link, &values));
    }
    let base = [
        even(length_m),
        even(length_m),
        even(length_m),
        even(angle_rad),
        even(angle_rad),
        even(angle_rad),
    ];
    profile.effects.push(effect(Kind::BaseFrame, 0, &base));
    if compliant {
        let c = [0.032e-3, 0.130e-3, 0.605e-3, 0.419e-3, 0.647e-3];
        for (joint, c) in c.into_iter().enumerate() {
            profile
                .effects
                .push(effect(Kind::JointCompliance, joint + 1, &[c]));
        }
    }
    profile
}

pub(super) fn commands(random: &mut StdRng, profile: &Profile, count: usize) -> Vec<Command> {
    let one = |_| Command {
        q: random_joints(random, profile),
        stand: Stand::default(),
        plate: None,
        direction: None,
        force_n: [0.0; 3],
    };
    (0..count).map(one).collect()
}

pub(super) fn measure(truth: &Profile, commands: &[Command], session: &Session) -> Measurements {
    let tool = truth.tool("artifact").expect("its tool");
    let points: Vec<_> = if truth.points.is_empty() {
        vec![(None, [0.0; 3])]
    } else {
        truth
            .points
            .iter()
            .map(|(name, p)| (Some(name.clone()), *p))
            .collect()
    };
    Measurements {
        rows: simulate(truth, &tool, &points, commands, session),
        columns: Vec::new(),
    }
}

/// The tool is known.
pub(super) fn known_tool(level: Level) -> Options {
    let mut selection = Selection::level(level);
    selection.fix = Pick::parse_list("tool_frame").expect("a word");
    Options {
        selection,
        shape: Shape::Squares,
        base: BasePolicy::Profile,
    }
}

fn true_value(truth: &Profile, key: &str) -> f64 {
    truth
        .effects
        .iter()
        .find_map(|e| {
            let all = e.definition().parameters.iter().zip(e.parameters);
            all.into_iter()
                .find_map(|(p, value)| (format!("{} {}", e.label(), p.key) == key).then_some(value))
        })
        .unwrap_or(0.0)
}

pub(super) fn worst_mm(calibrated: &Profile, truth: &Profile, count: usize) -> (f64, f64) {
    let mut random = StdRng::seed_from_u64(99);
    let check = commands(&mut random, truth, count);
    let seen = measure(truth, &check, &Session::default());
    let found = validate(calibrated, &seen, Refit::No, None).expect("a validation");
    let position = found.real.quality.position.expect("positions");
    (position.mean, position.max)
}

#[test]
fn without_noise_nothing_is_left_of_five_millimetres() {
    let mut random = StdRng::seed_from_u64(1);
    for _ in 0..5 {
        let truth = hidden(&mut random, 2.0 * MM, 0.3 * DEG, true);
        let seen = measure(
            &truth,
            &commands(&mut random, &truth, 50),
            &Session::default(),
        );
        let found =
            calibrate(&nominal(), &seen, &known_tool(Level::Compliance)).expect("an answer");
        assert!(found.before.position.expect("positions").max > 3.0);
        let (_, max) = worst_mm(&found.profile(), &truth, 300);
        assert!(max < 1e-6, "{max} mm");
    }
}

#[test]
fn the_truth_is_within_three_reported_sigmas() {
    let (mut inside, mut all) = (0_u32, 0_u32);
    for seed in 0..40 {
        let mut random = StdRng::seed_from_u64(seed);
        let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
        let session = Session {
            noise_m: 0.05 * MM,
            seed,
            ..Session::default()
        };
        let seen = measure(&truth, &commands(&mut random, &truth, 60), &session);
        let options = Options {
            base: BasePolicy::Profile,
            ..known_tool(Level::Compliance)
        };
        let found = calibrate(&nominal(), &seen, &options).expect("an answer");
        for (parameter, value, sigma) in found.parameters() {
            let Some(sigma) = sigma else { continue };
            all += 1;
            inside += u32::from((value - true_value(&truth, &parameter.key)).abs() < 3.0 * sigma);
        }
    }
    assert!(all > 1000);
    let part = f64::from(inside) / f64::from(all);
    // 99.73 % is expected; with some 1200 values it varies by 0.15 %
    assert!(part > 0.99, "{inside} of {all}");
}

#[test]
fn noise_and_wrong_masses_leave_less_than_a_tenth_of_a_millimetre() {
    let mut random = StdRng::seed_from_u64(5);
    let mut truth = hidden(&mut random, 1.0 * MM, 0.1 * DEG, true);
    for body in &mut truth.bodies {
        body.mass_kg *= 1.1;
    }
    let session = Session {
        noise_m: 0.070 * MM / 3.0_f64.sqrt(),
        ..Session::default()
    };
    let seen = measure(&truth, &commands(&mut random, &truth, 38), &session);
    let full = calibrate(&nominal(), &seen, &known_tool(Level::Compliance)).expect("an answer");
    let stiff = calibrate(&nominal(), &seen, &known_tool(Level::Geometry)).expect("an answer");
    let with = |found: &Calibration| {
        let mut profile = found.profile();
        profile.bodies.clone_from(&nominal().bodies);
        worst_mm(&profile, &truth, 1000)
    };
    let (mean, max) = with(&full);
    let (stiff_mean, _) = with(&stiff);
    println!("mean {mean:.4} max {max:.4} mm; without compliance mean {stiff_mean:.4} mm");
    assert!(mean < 0.1 && mean > 0.01, "{mean}");
    assert!(stiff_mean > 2.0 * mean, "{stiff_mean}");
}

#[test]
fn a_device_anywhere_and_an_unknown_tool_do_not_matter() {
    for (seed, pose) in [
        (1, [3.0, -2.0, 1.0, 0.0, 0.0, 2.5]),
        (2, [0.5, 1.0, 2.5, std::f64::consts::PI, 0.0, 0.4]),
        (3, [-4.0, 0.0, 0.3, 0.0, 1.5, -1.0]),
    ] {
        let mut random = StdRng::seed_from_u64(seed);
        let mut truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
        truth.world_from_base = Pose::from_xyz_rxryrz(pose);
        truth.points.insert("a".into(), [0.03, 0.05, 0.02]);
        truth.points.insert("b".into(), [-0.06, 0.01, 0.04]);
        let seen = measure(
            &truth,
            &commands(&mut random, &truth, 60),
            &Session::default(),
        );
        let options = Options {
            shape: Shape::Squares,
            base: BasePolicy::Device,
            ..Options::default()
        };
        let found = calibrate(&nominal(), &seen, &options).expect("an answer");
        assert!(found.base_replaced);
        let (_, max) = worst_mm(&found.profile(), &truth, 200);
        // angle and length of link 6 stand in the points instead, but not in where the tool's
        // weight pulls
        assert!(max < 3e-3, "{pose:?}: {max} mm");
    }
}

#[test]
fn a_device_that_stands_tilted_leaves_the_base_and_gravity_to_the_controller() {
    for (seed, pose) in [
        (1, [2.1, -3.4, 0.7, 0.0, 0.0, 2.3]),
        (2, [0.5, 1.0, 2.5, 0.4, -0.3, 0.4]),
        (3, [-4.0, 0.0, 0.3, 0.0, 1.5, -1.0]),
    ] {
        let mut random = StdRng::seed_from_u64(seed);
        let mut truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
        // where the real base is offset from the controller's, no device tells
        truth.effects.retain(|e| e.kind != Kind::BaseFrame);
        let options = Options {
            base: BasePolicy::Controller,
            ..known_tool(Level::Compliance)
        };
        let driven = commands(&mut random, &truth, 120);
        let in_world = measure(&truth, &driven, &Session::default());
        let device = Pose::from_xyz_rxryrz(pose);
        let seen = in_world.moved(&device.inverse());
        let found = calibrate(&nominal(), &seen, &options).expect("an answer");
        let profile = found.profile();
        assert_eq!(profile.world_from_base, nominal().world_from_base);
        // without noise the device is where it is, and the arm is found though the device hangs
        // askew
        let gap = profile.world_from_device().separation(&device);
        assert!(gap.distance_m < 1e-8 && gap.angle_rad < 1e-8, "{gap:?}");
        // and what reads measurements applies it
        let others = commands(&mut random, &truth, 200);
        let fresh = measure(&truth, &others, &Session::default()).moved(&device.inverse());
        let judged = validate(&profile, &fresh, Refit::No, None).expect("an answer");
        let missed = judged.real.quality.position.expect("positions").max;
        assert!(missed < 1e-5, "{pose:?}: {missed} mm");
        // a second session of the same device begins where the first one ended
        let again = calibrate(&profile, &seen, &options).expect("an answer");
        let gap = again.profile().world_from_device().separation(&device);
        assert!(gap.distance_m < 1e-8, "{gap:?}");
    }
}

#[test]
fn a_robot_on_a_slope_under_a_levelled_device_bends_as_the_device_says() {
    let mut random = StdRng::seed_from_u64(5);
    let mut truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
    truth.effects.retain(|e| e.kind != Kind::BaseFrame);
    // in the robot's own frame down is along the z of a device at 15 degrees
    let device = Pose::from_xyz_rxryrz([2.0, 1.0, 0.4, 15.0 * DEG, 0.0, 0.8]);
    let down = device.rotation.axis(2).map(|z| -9.81 * z);
    truth.gravity_m_s2 = down;
    let driven = commands(&mut random, &truth, 120);
    let seen = measure(&truth, &driven, &Session::default()).moved(&device.inverse());
    let options = Options {
        base: BasePolicy::Controller,
        ..known_tool(Level::Compliance)
    };
    let found = calibrate(&nominal(), &seen, &options).expect("an answer");
    assert!(found.remarks.iter().any(|r| r.id == "gravity-by-device"));
    assert!(found.remarks.iter().all(|r| r.id != "base-tilted"));
    let profile = found.profile();
    let apart = norm(sub(profile.gravity_m_s2, down));
    assert!(apart < 1e-5, "{apart} m/s\u{b2}");
    // judged in the controller's world
    let here = Profile {
        device: None,
        ..profile.clone()
    };
    let (_, max) = worst_mm(&here, &truth, 200);
    assert!(max < 1e-4, "{max} mm");
    // the file says it, and is read back
    let text = std::fs::read_to_string(repository("robots/abb_irb120_thesis.yaml"));
    let text = rewritten(&text.expect("a shipped profile"), &profile);
    let back = Profile::from_yaml(&text.expect("a plain layout")).expect("a profile");
    assert_eq!(back.gravity_m_s2, profile.gravity_m_s2);
}

#[test]
fn poses_and_distances_tell_as_positions_do() {
    let mut random = StdRng::seed_from_u64(8);
    let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
    let commands = commands(&mut random, &truth, 120);
    let from = vec![
        [1.0, 1.0, 0.2],
        [1.2, -0.9, 0.1],
        [-0.8, 0.9, 1.5],
        [-1.0, -1.0, 0.0],
    ];
    for device in [Device::Pose, Device::Distance(from)] {
        let session = Session {
            device,
            ..Session::default()
        };
        let seen = measure(&truth, &commands, &session);
        let found =
            calibrate(&nominal(), &seen, &known_tool(Level::Compliance)).expect("an answer");
        let (_, max) = worst_mm(&found.profile(), &truth, 200);
        assert!(max < 1e-5, "{max} mm");
    }
}

#[test]
fn wrong_rows_are_listed_and_do_not_bend_the_answer() {
    let mut random = StdRng::seed_from_u64(11);
    let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
    let commands = commands(&mut random, &truth, 100);
    let mut session = Session {
        noise_m: 0.03 * MM,
        ..Session::default()
    };
    let clean = measure(&truth, &commands, &session);
    session.outliers = 0.05;
    session.outlier_m = 3.0 * MM;
    let seen = measure(&truth, &commands, &session);
    let wrong = clean
        .rows
        .iter()
        .zip(&seen.rows)
        .filter(|(a, b)| a.observed != b.observed)
        .count();
    assert!(wrong >= 2);
    for (shape, most) in [(Shape::Huber, 0.06), (Shape::Tukey, 0.05)] {
        let options = Options {
            shape,
            ..known_tool(Level::Compliance)
        };
        let found = calibrate(&nominal(), &seen, &options).expect("an answer");
        assert_eq!(found.outliers.len(), wrong, "{shape:?}");
        let (mean, _) = worst_mm(&found.profile(), &truth, 300);
        assert!(mean < most, "{shape:?}: {mean} mm");
    }
    let options = known_tool(Level::Compliance);
    let bent = calibrate(&nominal(), &seen, &options).expect("an answer");
    assert!(worst_mm(&bent.profile(), &truth, 300).0 > 0.06);
}

#[test]
fn what_cannot_be_distinguished_is_named_and_stays_nominal() {
    let mut random = StdRng::seed_from_u64(13);
    let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, false);
    let seen = measure(
        &truth,
        &commands(&mut random, &truth, 60),
        &Session::default(),
    );
    let mut options = known_tool(Level::Geometry);
    options.selection.identify = Pick::parse_list("link_geometry").expect("a word");
    let found = calibrate(&nominal(), &seen, &options).expect("an answer");
    let names: Vec<&str> = found
        .solution
        .identifiable
        .dropped
        .iter()
        .map(|d| found.problem.parameters[d.parameter].key.as_str())
        .collect();
    // joint 1 rotates about the base's own axis, and its offset along it is the base's height
    for key in [
        "link_geometry link 1 theta_deg",
        "link_geometry link 1 d_mm",
        "link_geometry link 2 d_mm",
    ] {
        assert!(names.contains(&key), "{key} is not among {names:?}");
    }
    for (parameter, value, sigma) in found.parameters() {
        assert!(
            sigma.is_some() || value == 0.0,
            "{} wandered to {value}",
            parameter.key
        );
    }
    let (_, max) = worst_mm(&found.profile(), &truth, 200);
    assert!(max < 1e-6, "{max} mm");
}

#[test]
fn files_that_are_read_wrongly_are_found_out() {
    let mut random = StdRng::seed_from_u64(17);
    let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, false);
    let good = measure(
        &truth,
        &commands(&mut random, &truth, 40),
        &Session::default(),
    );
    let options = Options::default();
    let reported = |change: &dyn Fn(usize, &mut poseshift::identify::measurements::Measurement)| {
        let mut bad = good.clone();
        for (i, row) in bad.rows.iter_mut().enumerate() {
            change(i, row);
        }
        match calibrate(&nominal(), &bad, &options) {
            Err(error) => error.to_string(),
            Ok(found) => panic!("believed with {:?}", found.after),
        }
    };
    let moved = |observed: &mut Observed, by: &dyn Fn([f64; 3]) -> [f64; 3]| {
        if let Observed::Position(p) = observed {
            *p = by(*p);
        }
    };
    assert!(reported(&|_, row| row.q = row.q.map(|q| q * DEG)).contains("radians"));
    assert!(
        reported(&|_, row| moved(&mut row.observed, &|p| p.map(|x| x / 1000.0))).contains("metres")
    );
    assert!(
        reported(&|_, row| moved(&mut row.observed, &|[x, y, z]| [y, x, z])).contains("swapped")
    );
    assert!(reported(&|_, row| row.q.swap(1, 2)).contains("q2_deg and q3_deg are swapped"));
    assert!(reported(&|_, row| row.q[2] = -row.q[2]).contains("joint 3 counts the other way"));
    assert!(reported(&|i, row| row.observed = good.rows[(i + 1) % 40].observed).contains("row"));
    assert!(reported(&|_, row| row.q = [0.1; 6]).contains("same pose"));
    assert!(
        reported(&|i, row| row.observed = Observed::Position([i as f64 * 0.01, 0.0, 0.0]))
            .contains("one line")
    );
    let few = good.filtered(|i, _| i < 6);
    assert!(matches!(
        calibrate(&nominal(), &few, &options),
        Err(IdentifyError::TooFew { .. })
    ));
    let mut twice = good.clone();
    twice.rows.push(good.rows[0].clone());
    let found = calibrate(&nominal(), &twice, &options).expect("an answer");
    assert!(found.remarks.iter().any(|r| r.id == "duplicate-rows"));
    let mut still = truth.clone();
    still.effects.clear();
    let mut stopped = commands(&mut random, &truth, 60);
    for command in &mut stopped {
        command.q[3] = 0.2;
    }
    let found = calibrate(
        &nominal(),
        &measure(&still, &stopped, &Session::default()),
        &options,
    )
    .expect("an answer");
    assert!(
        found
            .remarks
            .iter()
            .any(|r| r.id == "joint-never-moved" && r.message.contains("joint 4"))
    );
}

#[test]
fn a_wrong_tool_and_rows_in_any_order_are_reported_with_the_evidence() {
    let mut random = StdRng::seed_from_u64(19);
    let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, false);
    let commands = commands(&mut random, &truth, 60);
    let mut longer = truth.clone();
    let mounted = longer.tools.get_mut("artifact").expect("its tool");
    mounted.flange_from_tool.translation[2] += 30.0 * MM;
    let seen = measure(&longer, &commands, &Session::default());
    let found = calibrate(&nominal(), &seen, &Options::default()).expect("an answer");
    let reported = found.remarks.iter().find(|r| r.id == "tool-elsewhere");
    let reported = &reported.expect("a warning").message;
    let gap: f64 = reported
        .split_whitespace()
        .find_map(|word| word.parse().ok())
        .expect("a number");
    assert!(
        reported.contains("`artifact`") && (gap - 30.0).abs() < 2.0,
        "{reported}"
    );

    // the place of the point in the file is that on the flange, or off by more than is believed
    let gap = |seen: &Measurements| -> Option<f64> {
        let found = calibrate(&nominal(), seen, &Options::default()).expect("an answer");
        let reported = found.remarks.iter().find(|r| r.id == "tool-elsewhere")?;
        let mut words = reported.message.split_whitespace();
        words.find_map(|word| word.parse().ok())
    };
    let mut stated = measure(&truth, &commands, &Session::default());
    assert_eq!(gap(&stated), None);
    for off_m in [0.03, 0.11, 0.3] {
        for row in &mut stated.rows {
            row.point_in_tool_m = Some([0.0, 0.0, off_m]);
        }
        let gap = gap(&stated).expect("a warning");
        assert!((gap - 1e3 * off_m).abs() < 3.0, "{off_m}: {gap}");
    }

    // every point in the file, none in its row
    let good = measure(&truth, &commands, &Session::default());
    let mut mixed = good.clone();
    for (i, row) in mixed.rows.iter_mut().enumerate() {
        row.observed = good.rows[(7 * i + 3) % 60].observed;
    }
    let error = calibrate(&nominal(), &mixed, &Options::default()).expect_err("nonsense");
    assert!(error.to_string().contains("mm rms"), "{error}");
    assert!(error.hint().contains("order"), "{}", error.hint());
}
