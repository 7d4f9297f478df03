//! Rows of several kinds, priors, and sets chosen under constraints.

use super::identify::{DEG, MM, commands, effect, hidden, known_tool, measure, nominal, worst_mm};
use poseshift::geometry::{Vector, norm, sub};
use poseshift::identify::IdentifyError;
use poseshift::identify::calibration::calibrate;
use poseshift::identify::measurements::Measurements;
use poseshift::identify::parameters::{Level, Selection};
use poseshift::identify::pick::Pick;
use poseshift::identify::plan::{Constraints, Request, plan};
use poseshift::identify::simulate::{Device, Session};
use poseshift::identify::validation::{Refit, validate};
use poseshift::model::Conditions;
use poseshift::model::effects::Kind;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

#[test]
fn rows_of_three_kinds_tell_together_what_none_tells_alone() {
    let mut random = StdRng::seed_from_u64(21);
    let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
    let from = vec![[1.0, 1.0, 0.2], [1.2, -0.9, 0.1], [-0.8, 0.9, 1.5]];
    let mut all = Measurements {
        rows: Vec::new(),
        columns: Vec::new(),
    };
    let options = known_tool(Level::Compliance);
    // 30, 30 and 30 numbers for 31 parameters
    for (device, count) in [
        (Device::Position, 10),
        (Device::Pose, 5),
        (Device::Distance(from), 30),
    ] {
        let session = Session {
            device,
            ..Session::default()
        };
        let seen = measure(&truth, &commands(&mut random, &truth, count), &session);
        let alone = calibrate(&nominal(), &seen, &options);
        assert!(
            matches!(alone, Err(IdentifyError::TooFew { .. })),
            "{count}: {:?}",
            alone.map(|found| found.after)
        );
        all.rows.extend(seen.rows);
    }
    let found = calibrate(&nominal(), &all, &options).expect("an answer");
    assert_eq!(found.problem.numbers(), 90);
    assert!(found.after.position.is_some() && found.after.orientation.is_some());
    assert!(found.after.range.is_some());
    let (_, max) = worst_mm(&found.profile(), &truth, 200);
    assert!(max < 1e-4, "{max} mm");
}

#[test]
fn orientations_count_by_what_the_device_says_of_them() {
    let mut random = StdRng::seed_from_u64(77);
    let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
    let session = Session {
        device: Device::Pose,
        noise_m: 0.02 * MM,
        noise_rad: 0.1 * DEG,
        seed: 3,
        ..Session::default()
    };
    // orientations are read to a tenth of a degree, much worse than 0.02 mm over 0.3 m
    let seen = measure(&truth, &commands(&mut random, &truth, 60), &session);
    let mean = |sigma_rad: Option<f64>| {
        let mut rows = seen.clone();
        for row in &mut rows.rows {
            row.sigma_rad = sigma_rad;
        }
        let found = calibrate(&nominal(), &rows, &known_tool(Level::Compliance));
        worst_mm(&found.expect("an answer").profile(), &truth, 200).0
    };
    let (said, far_too_sure) = (mean(Some(0.1 * DEG)), mean(Some(0.004 * DEG)));
    assert!(
        said < 0.5 * far_too_sure && said < 0.05,
        "{said} {far_too_sure} mm"
    );
    // where nothing is said their scatter says it
    let unsaid = mean(None);
    assert!(unsaid < 1.1 * said, "{unsaid} {said} mm");
}

#[test]
fn priors_help_where_rows_are_few_and_bound_the_uncertainty() {
    let (mut with, mut without) = (0.0, 0.0);
    for seed in 0..6 {
        let mut random = StdRng::seed_from_u64(100 + seed);
        let mut truth = hidden(&mut random, 0.1 * MM, 0.02 * DEG, false);
        // within what the priors take for typical, 1e-4
        for joint in 1..6 {
            let c = random.random_range(0.0..1e-4);
            truth
                .effects
                .push(effect(Kind::JointCompliance, joint, &[c]));
        }
        let session = Session {
            noise_m: 0.2 * MM,
            seed,
            ..Session::default()
        };
        let seen = measure(&truth, &commands(&mut random, &truth, 13), &session);
        let mut options = known_tool(Level::Compliance);
        let free = calibrate(&nominal(), &seen, &options).expect("an answer");
        options.selection.priors = true;
        let held = calibrate(&nominal(), &seen, &options).expect("an answer");
        without += worst_mm(&free.profile(), &truth, 200).0;
        with += worst_mm(&held.profile(), &truth, 200).0;
        for (parameter, _, sigma) in held.parameters() {
            let (Some(sigma), Some((_, prior))) = (sigma, parameter.prior) else {
                continue;
            };
            let most = prior * held.uncertainty.applied_factor;
            assert!(sigma < most, "{}: {sigma} of {most}", parameter.key);
        }
    }
    println!(
        "13 configurations: {:.3} mm, with priors {:.3} mm",
        without / 6.0,
        with / 6.0
    );
    assert!(with < 0.9 * without, "{with} {without}");
}

/// Elbow, wrist centre of the IRB 120 with base at the origin, metres: from its drawing, not from
/// the model.
fn elbow_and_wrist(q: &[f64; 6]) -> [Vector; 2] {
    let (s1, c1) = q[0].sin_cos();
    let (s2, c2) = q[1].sin_cos();
    let (s, c) = (q[1] + q[2]).sin_cos();
    let out = |r: f64, z: f64| [r * c1, r * s1, z];
    let (r, z) = (0.270 * s2, 0.290 + 0.270 * c2);
    [
        out(r, z),
        out(r + 0.070 * s + 0.302 * c, z + 0.070 * c - 0.302 * s),
    ]
}

#[test]
fn a_plan_stays_in_the_box_out_of_the_keep_outs_and_in_sight() {
    let profile = nominal();
    let tool = profile.tool("artifact").expect("its tool");
    let inside = [[0.1, -0.45, 0.15], [0.65, 0.45, 0.8]];
    let post = [[0.25, 0.0, 0.0], [0.7, 0.6, 0.45]];
    let device = [1.8, -0.5, 0.9];
    let request = Request {
        count: 25,
        candidates: 300,
        starts: 1,
        seed: 7,
        sigma_m: 0.05 * MM,
        poses: false,
        given: Vec::new(),
        given_stands: Vec::new(),
        stations: 11,
        constraints: Constraints {
            margin_rad: DEG,
            approach_rad: 5.0 * DEG,
            inside: Some(inside),
            keep_out: vec![post],
            sight: Some((device, 40.0 * DEG)),
        },
    };
    let selection = Selection {
        fix: known_tool(Level::Geometry).selection.fix,
        ..Selection::level(Level::Geometry)
    };
    let found = plan(&profile, &tool, &selection, &request).expect("a plan");
    assert_eq!(found.joints.len(), 25);
    assert!(found.admitted < 0.2, "{}", found.admitted);
    let model = profile.real_model(&tool, &Conditions::default());
    let holds = |b: &[Vector; 2], p: Vector| (0..3).all(|k| b[0][k] <= p[k] && p[k] <= b[1][k]);
    for q in &found.joints {
        let pose = model.forward(q, &Conditions::default());
        let tip = pose.translation;
        assert!(holds(&inside, tip), "{tip:?}");
        for point in elbow_and_wrist(q).into_iter().chain([tip]) {
            assert!(!holds(&post, point), "{point:?}");
        }
        let toward = sub(device, tip);
        let z = pose.rotation.axis(2);
        let cosine = (z[0] * toward[0] + z[1] * toward[1] + z[2] * toward[2]) / norm(toward);
        assert!(cosine.acos() < 40.0 * DEG);
    }
    // without them some configuration breaks each
    let mut free = request.clone();
    free.constraints = Constraints::default();
    let free = plan(&profile, &tool, &selection, &free).expect("a plan");
    assert!(
        free.joints
            .iter()
            .any(|q| { elbow_and_wrist(q).into_iter().any(|p| holds(&post, p)) })
    );
    let mut nowhere = request;
    nowhere.constraints.inside = Some([[3.0; 3], [4.0; 3]]);
    let error = plan(&profile, &tool, &selection, &nowhere).expect_err("out of reach");
    assert!(
        error.to_string().contains("0 meet the constraints"),
        "{error}"
    );
}

#[test]
fn lengths_that_grow_are_those_at_the_mean_temperature() {
    let mut random = StdRng::seed_from_u64(5);
    let mut truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, false);
    truth
        .effects
        .push(effect(Kind::ThermalGrowth, 0, &[1.8e-5, 18.0]));
    let session = Session {
        temperature_c: Some([18.0, 28.0]),
        ..Session::default()
    };
    let mut seen = measure(&truth, &commands(&mut random, &truth, 60), &session);
    seen.columns.push("temperature_c".into());
    let mut options = known_tool(Level::Geometry);
    options.selection.identify = Pick::parse_list("thermal_growth").expect("a word");
    let found = calibrate(&nominal(), &seen, &options).expect("an answer");
    let profile = found.profile();
    let grown = profile
        .effects
        .iter()
        .find(|e| e.kind == Kind::ThermalGrowth);
    let [per_k, reference_c, ..] = grown.expect("it was asked for").parameters;
    approx::assert_relative_eq!(per_k, 1.8e-5, max_relative = 1e-3);
    approx::assert_abs_diff_eq!(reference_c, 23.0, epsilon = 1e-6);
    // and the arm without a thermometer is the one at that temperature
    let at_mean = Session {
        temperature_c: Some([23.0, 23.0]),
        ..Session::default()
    };
    let fresh = measure(&truth, &commands(&mut random, &truth, 40), &at_mean);
    let missed = validate(&profile, &fresh, Refit::No, None).expect("a validation");
    let position = missed.real.quality.position.expect("positions");
    assert!(position.max < 1e-3, "{} mm", position.max);
}
