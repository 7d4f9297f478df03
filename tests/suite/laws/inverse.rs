//! The nominal and the calibrated inverse undo the forward models.

use crate::support::{random_joints, shipped_profiles};
use poseshift::geometry::{Pose, Separation};
use poseshift::inverse::{
    Arm, Branch, Inverse, Status, TOLERANCE_M, TOLERANCE_RAD, Targets, solve_batch,
};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use rand::SeedableRng;
use rand::rngs::StdRng;

/// Random postures a robot.
const POSES: usize = 10_000;
/// Rounding of an arm of three metres, amplified at most a thousand times near singularities.
const POSITION_M: f64 = 1e-11;
const ANGLE_RAD: f64 = 1e-11;
/// An offset wrist's equation is solved to this where the elbow is nearer to straight than the
/// other, radians.
const AT_EDGE_RAD: f64 = 1e-10;
const EDGE_RAD: f64 = 1e-4;

fn is_small(gap: Separation) -> bool {
    gap.distance_m < POSITION_M && gap.angle_rad < ANGLE_RAD
}

fn mounted() -> Mounted {
    let flange_from_tool = Pose::from_xyz_rxryrz([0.05, -0.02, 0.13, 0.4, -0.9, 2.0]);
    Mounted {
        name: "probe".into(),
        flange_from_tool,
        load: Some((2.0, [0.01, 0.02, 0.08])),
    }
}

fn arms() -> Vec<(String, Profile, Arm)> {
    let with_arm = |(name, profile): (String, Profile)| {
        let arm = Arm::of(&profile.geometry(&mounted()), &profile.mechanism).ok()?;
        Some((name, profile, arm))
    };
    shipped_profiles()
        .into_iter()
        .filter_map(with_arm)
        .collect()
}

#[test]
fn every_shipped_robot_has_an_inverse_and_its_kind_is_reported() {
    let kinds: Vec<_> = shipped_profiles()
        .iter()
        .map(|(name, profile)| {
            let arm = Arm::of(&profile.geometry(&mounted()), &profile.mechanism);
            (name.clone(), arm.map(|arm| arm.kind()))
        })
        .collect();
    for (name, kind) in kinds {
        let kind = kind.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(
            kind.starts_with("offset"),
            name.starts_with("yaskawa_ma1400"),
            "{name} {kind}"
        );
    }
}

#[test]
fn nominal_inverse_of_a_forward_pose_gives_the_joints_back_on_their_branch() {
    for (name, profile, arm) in arms() {
        let mut random = StdRng::seed_from_u64(1);
        let controller = profile.controller_model(&mounted());
        for _ in 0..POSES {
            let q = random_joints(&mut random, &profile);
            let wanted = controller.forward(&q, &Conditions::default());
            let (branch, margins) = arm.posture(&q);
            let found = arm.solve_branch(&wanted, branch, &q);
            if found.beyond > 0.0 && !arm.is_only_posture(&margins) {
                // it is reported that nothing was found
                continue;
            }
            assert!(
                is_small(
                    controller
                        .forward(&found.q, &Conditions::default())
                        .separation(&wanted)
                ),
                "{name} {q:?}"
            );
            if margins.wrist_rad > 1e-4 && margins.elbow_rad > 1e-3 && margins.shoulder_m > 1e-4 {
                for i in 0..6 {
                    assert!(
                        (found.q[i] - q[i]).abs() < 1e-9,
                        "{name} joint {i}: {q:?} {:?}",
                        found.q
                    );
                }
            }
        }
    }
}

#[test]
fn all_eight_branches_reach_the_pose_or_say_that_they_do_not() {
    for (name, profile, arm) in arms() {
        let mut random = StdRng::seed_from_u64(2);
        let controller = profile.controller_model(&mounted());
        let mut reached = 0;
        for _ in 0..POSES {
            let q = random_joints(&mut random, &profile);
            let wanted = controller.forward(&q, &Conditions::default());
            for branch in Branch::ALL {
                let found = arm.solve_branch(&wanted, branch, &q);
                if found.beyond > 0.0 {
                    continue;
                }
                reached += 1;
                let gap = controller
                    .forward(&found.q, &Conditions::default())
                    .separation(&wanted);
                let (is, margins) = arm.posture(&found.q);
                let at_edge = arm.kind().starts_with("offset") && margins.elbow_rad < EDGE_RAD;
                let good = is_small(gap)
                    || (at_edge && gap.distance_m < POSITION_M && gap.angle_rad < AT_EDGE_RAD);
                assert!(good, "{name} {q:?} {branch} {gap:?} {found:?}");
                assert!(
                    is == branch
                        || margins.wrist_rad < 1e-6
                        || margins.elbow_rad < 1e-6
                        || margins.shoulder_m < 1e-6,
                    "{name} {branch} {is} {margins:?}"
                );
            }
        }
        assert!(reached > 4 * POSES, "{name}: {reached}");
    }
}

fn thesis() -> (Profile, Inverse) {
    let (_, profile) = shipped_profiles()
        .into_iter()
        .find(|(name, _)| name == "abb_irb120_thesis.yaml")
        .expect("shipped");
    let tool = profile.tool("artifact").expect("its tool");
    let arm = Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("a spherical wrist");
    let conditions = Conditions::default();
    let real = profile.real_model(&tool, &conditions);
    (
        profile,
        Inverse {
            arm,
            real,
            conditions,
        },
    )
}

/// Targets that the real robot reaches within its limits: made by the real model from random
/// joints.
fn reachable(
    profile: &Profile,
    inverse: &Inverse,
    count: usize,
    seed: u64,
    change: impl Fn(&mut [f64; 6]),
) -> Vec<([f64; 6], Pose)> {
    let mut random = StdRng::seed_from_u64(seed);
    let one = |_| {
        let mut q = random_joints(&mut random, profile);
        change(&mut q);
        (q, inverse.real.forward(&q, &inverse.conditions))
    };
    (0..count).map(one).collect()
}

/// How many targets do not converge on the branch of the joints they were made from, and how.
fn failures(inverse: &Inverse, targets: &[([f64; 6], Pose)]) -> Vec<Status> {
    let failed = targets.iter().filter_map(|(q, wanted)| {
        let (branch, _) = inverse.arm.posture(q);
        let outcome = inverse.solve(wanted, branch, q);
        if outcome.status == Status::Converged {
            let gap = inverse
                .real
                .forward(&outcome.q, &inverse.conditions)
                .separation(wanted);
            assert!(gap.distance_m < TOLERANCE_M && gap.angle_rad < TOLERANCE_RAD);
            assert_eq!(inverse.arm.posture(&outcome.q).0, branch);
        }
        (outcome.status != Status::Converged && !matches!(outcome.status, Status::JointLimit(_)))
            .then_some(outcome.status)
    });
    failed.collect()
}

#[test]
fn calibrated_inverse_converges_on_9999_of_10_000_random_targets() {
    let (profile, inverse) = thesis();
    let failed = failures(&inverse, &reachable(&profile, &inverse, 10_000, 3, |_| {}));
    assert!(failed.len() <= 1, "{} {failed:?}", failed.len());
}

#[test]
fn a_wrist_a_tenth_of_a_degree_from_alignment_converges_on_its_branch() {
    let (profile, inverse) = thesis();
    let targets = reachable(&profile, &inverse, 2_000, 4, |q| {
        q[4] = 0.1_f64.to_radians() * q[4].signum();
    });
    let failed = failures(&inverse, &targets);
    assert!(failed.len() <= 10, "{} {failed:?}", failed.len());
}

#[test]
fn an_elbow_a_fifth_of_a_degree_from_stretched_converges() {
    let (profile, inverse) = thesis();
    // stretched: the forearm (70, 302) in line with the upper arm
    let straight = -(302.0_f64).atan2(70.0);
    let targets = reachable(&profile, &inverse, 2_000, 5, |q| {
        q[2] = straight + 0.2_f64.to_radians() * q[2].signum();
    });
    let near = targets
        .iter()
        .filter(|(q, _)| inverse.arm.posture(q).1.elbow_rad < 0.5_f64.to_radians())
        .count();
    assert_eq!(near, targets.len());
    let failed = failures(&inverse, &targets);
    assert!(failed.is_empty(), "{} {failed:?}", failed.len());
}

#[test]
fn a_batch_gives_what_single_solutions_give() {
    let (profile, inverse) = thesis();
    let targets = reachable(&profile, &inverse, 1_001, 6, |_| {});
    let wanted: Vec<_> = targets.iter().map(|t| t.1).collect();
    let near: Vec<_> = targets.iter().map(|t| t.0).collect();
    let branches: Vec<_> = near.iter().map(|q| inverse.arm.posture(q).0).collect();
    let batch = solve_batch(
        &inverse,
        Targets {
            wanted: &wanted,
            branches: &branches,
            near: &near,
        },
    );
    assert_eq!(batch.len(), targets.len());
    for (i, outcome) in batch.iter().enumerate() {
        let single = inverse.solve(&wanted[i], branches[i], &near[i]);
        assert_eq!(outcome.status, single.status);
        let gap = inverse
            .real
            .forward(&outcome.q, &inverse.conditions)
            .separation(&wanted[i]);
        assert!(
            outcome.status != Status::Converged
                || (gap.distance_m < TOLERANCE_M && gap.angle_rad < TOLERANCE_RAD)
        );
    }
}
