//! Every six-axis arm has an inverse: all answers, the one on a track, and the posture it came
//! from.

use super::postures;
use crate::support::{offset_wrist_arms, shipped_profiles};
use nalgebra::SMatrix;
use poseshift::geometry::{Pose, wrap};
use poseshift::inverse::{Arm, Inverse, Method, Methods, Status};
use poseshift::model::profile::Mounted;
use poseshift::model::{Conditions, Geometry, Mechanism, Model};

/// Random postures an arm.
const POSES: usize = 500;
/// Rounding of an arm of three metres; near an edge of the reach the last steps of joint 6 are
/// coarser.
const POSITION_M: f64 = 1e-10;
const ANGLE_RAD: f64 = 1e-10;
/// An answer near a fold moves by the root of the rounding.
const SAME_RAD: f64 = 1e-5;
/// Of ten thousand postures so many may be missed.
const MISSED_OF_10_000: usize = 10;
/// Evaluations of the real arm after which a refusal comes: no search was begun.
const AT_ONCE: u32 = 1;

fn is_same(a: &[f64; 6], b: &[f64; 6], tolerance: f64) -> bool {
    (0..6).all(|i| wrap(a[i] - b[i]).abs() < tolerance)
}

/// An arm whose every length and angle is a little off.
fn bent(geometry: &Geometry) -> Geometry {
    let mut real = geometry.clone();
    for (i, link) in real.links.iter_mut().enumerate() {
        let by = |k: f64| (k * (i as f64 + 1.0)).sin();
        link.a_m += 0.5e-3 * by(1.3);
        link.d_m += 0.5e-3 * by(2.1);
        link.alpha_rad += 1e-3 * by(3.7);
        link.theta_rad += 2e-3 * by(4.9);
        link.beta_rad += 0.5e-3 * by(5.3);
    }
    real
}

fn inverse_of(geometry: &Geometry, mechanism: &Mechanism) -> Inverse {
    let conditions = Conditions::default();
    Inverse {
        arm: Arm::of(geometry, mechanism).expect("an inverse"),
        real: Model::build(&bent(geometry), mechanism, &[], &conditions),
        conditions,
    }
}

/// Every shipped arm and those with an offset wrist, nominal.
fn every_arm() -> Vec<(String, Geometry, Mechanism)> {
    let shipped = shipped_profiles().into_iter().map(|(name, profile)| {
        let geometry = profile.geometry(&Mounted::flange());
        (name, geometry, profile.mechanism)
    });
    shipped.chain(offset_wrist_arms()).collect()
}

#[test]
fn every_posture_is_among_the_answers_at_its_pose() {
    let conditions = Conditions::default();
    let (mut tried, mut missed, mut twins) = (0, 0, 0);
    for (name, geometry, mechanism) in offset_wrist_arms() {
        let arm = Arm::of(&geometry, &mechanism).expect("an inverse");
        assert!(arm.has_offset_wrist(), "{name}");
        let model: Model = Model::build(&geometry, &mechanism, &[], &conditions);
        for q in postures(&mechanism, POSES, 21) {
            let wanted = model.forward(&q, &conditions);
            let answers = arm.solve_all(&wanted, &q);
            tried += 1;
            missed += usize::from(!answers.iter().any(|a| is_same(&a.q, &q, SAME_RAD)));
            assert!(answers.len() <= 16, "{name} {q:?}");
            for (i, answer) in answers.iter().enumerate() {
                let gap = model.forward(&answer.q, &conditions).separation(&wanted);
                assert!(
                    gap.distance_m < POSITION_M && gap.angle_rad < ANGLE_RAD,
                    "{name} {q:?} {gap:?}"
                );
                let (branch, margins) = arm.posture(&answer.q);
                let on_border =
                    margins.wrist_rad.min(margins.elbow_rad) < 1e-6 || margins.shoulder_m < 1e-6;
                assert!(branch == answer.branch || on_border, "{name} {q:?}");
                let before = &answers[..i];
                assert!(before.iter().all(|b| !is_same(&b.q, &answer.q, 1e-8)));
                let namesakes = before.iter().filter(|b| b.branch == answer.branch).count();
                assert_eq!(usize::from(answer.root), namesakes);
                twins += usize::from(answer.root == 1);
            }
        }
    }
    println!("{missed} of {tried} missed, {twins} answers share their branch with another");
    assert_eq!(tried, 10 * POSES);
    assert!(10_000 * missed <= MISSED_OF_10_000 * tried, "{missed}");
    assert!(10 * twins > tried, "{twins}");
}

#[test]
fn a_track_is_followed_from_branch_to_branch() {
    let conditions = Conditions::default();
    let (mut steps, mut changes) = (0, 0);
    for (name, geometry, mechanism) in offset_wrist_arms() {
        let arm = Arm::of(&geometry, &mechanism).expect("an inverse");
        let model: Model = Model::build(&geometry, &mechanism, &[], &conditions);
        for ends in postures(&mechanism, 40, 22).chunks_exact(2) {
            let mut near = ends[0];
            let mut branch = arm.posture(&near).0;
            for k in 1..=2000 {
                let s = f64::from(k) / 2000.0;
                let q = std::array::from_fn(|i| ends[0][i] + s * (ends[1][i] - ends[0][i]));
                let wanted = model.forward(&q, &conditions);
                // where two answers meet, either may be meant
                let answers = arm.solve_all(&wanted, &q);
                let given = answers.iter().filter(|a| is_same(&a.q, &q, 0.05));
                if arm.fold_rad(&q).expect("an offset wrist") < 0.03 || given.count() > 1 {
                    near = q;
                    continue;
                }
                let found = arm.solve_near(&wanted, &near);
                steps += 1;
                assert!(
                    found.beyond == 0.0 && is_same(&found.q, &q, 1e-6),
                    "{name} {q:?} {:?}",
                    found.q
                );
                let now = arm.posture(&q).0;
                changes += usize::from(now != branch);
                (near, branch) = (found.q, now);
            }
        }
    }
    println!("{steps} steps, {changes} changes of branch");
    assert!(changes > 100, "{changes}");
}

#[test]
fn any_real_posture_is_solved_again_from_itself() {
    for (name, geometry, mechanism) in every_arm() {
        let inverse = inverse_of(&geometry, &mechanism);
        for q in postures(&mechanism, 1024, 23) {
            let wanted = inverse.real.forward(&q, &inverse.conditions);
            let outcome = inverse.solve_near(&wanted, &q);
            assert_eq!(
                outcome.status,
                Status::Converged,
                "{name} {q:?} {outcome:?}"
            );
            assert_eq!(
                outcome.iterations,
                outcome.shift_evaluations + outcome.newton_evaluations
            );
        }
    }
}

#[test]
fn the_pose_shift_alone_says_where_it_stalls() {
    let (mut stalled, mut tried) = (0, 0);
    for (name, geometry, mechanism) in every_arm() {
        let inverse = inverse_of(&geometry, &mechanism);
        for q in postures(&mechanism, 256, 24) {
            let wanted = inverse.real.forward(&q, &inverse.conditions);
            let branch = inverse.arm.posture(&q).0;
            let outcome = inverse.solve_by(Methods::PoseShift, &wanted, branch, &q);
            assert_eq!(outcome.method, Method::PoseShift, "{name}");
            assert_eq!(outcome.newton_evaluations, 0, "{name}");
            tried += 1;
            stalled += usize::from(outcome.status != Status::Converged);
            if outcome.status != Status::Converged {
                let auto = inverse.solve(&wanted, branch, &q);
                assert_eq!(auto.method, Method::Newton, "{name} {auto:?}");
            }
        }
    }
    assert!(stalled > 0 && 20 * stalled < tried, "{stalled} of {tried}");
}

/// How the joints move the tool: columns of a Jacobian by central differences.
fn jacobian(real: &Model, q: &[f64; 6]) -> SMatrix<f64, 6, 6> {
    let conditions = Conditions::default();
    let here = real.forward(q, &conditions);
    SMatrix::from_fn(|row, joint| {
        let step = 1e-5;
        let at = |by: f64| {
            let mut q = *q;
            q[joint] += by;
            let pose = real.forward(&q, &conditions);
            let turned = (pose.rotation * here.rotation.transpose()).vector();
            [pose.translation, turned].concat()[row]
        };
        (at(step) - at(-step)) / (2.0 * step)
    })
}

#[test]
fn a_little_beyond_the_stretched_real_arm_is_out_of_reach() {
    let mut tried = 0;
    for (name, geometry, mechanism) in every_arm() {
        let inverse = inverse_of(&geometry, &mechanism);
        // the elbow at which the nominal arm is straight, then that of the real one
        let elbow = |angle: f64| [0.1, 0.6, angle, 0.4, 0.9, 0.6];
        let bent = |angle: &f64| inverse.arm.posture(&elbow(*angle)).1.elbow_rad;
        let angles = (-30_000..30_000).map(|k| f64::from(k) * 1e-4);
        let straight = angles.min_by(|a, b| bent(a).total_cmp(&bent(b)));
        let straight = straight.expect("an angle");
        let slope = |angle: f64| jacobian(&inverse.real, &elbow(angle)).determinant();
        let (mut low, mut high) = (straight - 0.03, straight + 0.03);
        if slope(low) * slope(high) > 0.0 {
            continue;
        }
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if slope(low) * slope(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let q = elbow(low);
        let decomposed = jacobian(&inverse.real, &q).svd(true, false);
        let weakest = decomposed.u.expect("vectors").column(5).into_owned();
        let reached = inverse.real.forward(&q, &inverse.conditions);
        let long = weakest.fixed_rows::<3>(0).norm();
        let pushed = |by_m: f64| {
            let moved = std::array::from_fn(|i| reached.translation[i] + by_m * weakest[i] / long);
            Pose {
                translation: moved,
                ..reached
            }
        };
        tried += 1;
        for by_m in [2e-5, 3e-4] {
            let mut answers = [by_m, -by_m].map(|by_m| {
                let near = elbow(low + 0.02);
                let branch = inverse.arm.posture(&near).0;
                inverse.solve(&pushed(by_m), branch, &near).status.id()
            });
            answers.sort_unstable();
            let is_right = answers[1] == "out-of-reach"
                && answers[0] != "not-converged"
                && answers[0] != "out-of-reach";
            assert!(is_right, "{name}, {by_m} m: {answers:?}");
        }
    }
    assert!(tried > 5, "{tried}");
}

#[test]
fn out_of_reach_and_not_a_number_are_refused_at_once() {
    for (name, geometry, mechanism) in every_arm() {
        let inverse = inverse_of(&geometry, &mechanism);
        let near = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
        let branch = inverse.arm.posture(&near).0;
        let reached = inverse.real.forward(&near, &inverse.conditions);
        let far = Pose {
            translation: reached.translation.map(|x| 20.0 * x + 20.0),
            ..reached
        };
        let outcome = inverse.solve(&far, branch, &near);
        assert!(outcome.iterations <= AT_ONCE, "{name} {outcome:?}");
        assert_eq!(outcome.status, Status::OutOfReach, "{name}");
        assert!(inverse.arm.solve_all(&far, &near).is_empty(), "{name}");
        for (pose, near) in [
            (
                Pose {
                    translation: [f64::NAN, 0.0, 0.0],
                    ..reached
                },
                near,
            ),
            (reached, [0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0]),
            (
                Pose {
                    translation: [f64::INFINITY, 0.0, 0.0],
                    ..reached
                },
                near,
            ),
        ] {
            let outcome = inverse.solve(&pose, branch, &near);
            assert_eq!(outcome.status, Status::NotConverged, "{name}");
            assert_eq!(outcome.iterations, 0, "{name}");
        }
        let nowhere = Pose {
            translation: [f64::NAN; 3],
            ..reached
        };
        assert!(inverse.arm.solve_all(&nowhere, &near).is_empty(), "{name}");
    }
}
