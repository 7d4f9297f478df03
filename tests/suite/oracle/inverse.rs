//! The inverses against an independent search (tests/data/forward) and an independent closed form.

use crate::support::{gap, numbers_of, random_joints, shipped_profiles, table};
use poseshift::geometry::{Pose, Quaternion};
use poseshift::inverse::{Arm, Branch, Inverse, Status};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;

/// The search stops at 1e-6 mm and 1e-9 rad.
const POSITION_MM: f64 = 2e-6;
const ANGLE_RAD: f64 = 3e-9;

fn profile(file: &str) -> Profile {
    shipped_profiles()
        .into_iter()
        .find(|(name, _)| name == file)
        .expect("a shipped profile")
        .1
}

fn pose(numbers: [f64; 7]) -> Pose {
    let [x, y, z, w, i, j, k] = numbers;
    Pose::from_parts(
        [x, y, z].map(|mm| mm / 1e3),
        Quaternion([w, i, j, k]).normalized(),
    )
}

#[test]
fn calibrated_joints_and_fake_targets_agree_with_the_oracle() {
    let profile = profile("abb_irb120_thesis.yaml");
    let tool = profile.tool("artifact").expect("its tool");
    let arm = Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("a spherical wrist");
    let conditions = Conditions::default();
    let inverse = Inverse {
        real: profile.real_model(&tool, &conditions),
        arm,
        conditions,
    };
    let controller = profile.controller_model(&tool);
    let rows = table("tests/data/forward/inverse_irb120_thesis.csv");
    assert_eq!(rows.len(), 200);
    for row in &rows {
        let wanted = pose(row.numbers(["wx_mm", "wy_mm", "wz_mm", "wqw", "wqx", "wqy", "wqz"]));
        let near = row.joints("near{}_deg");
        let branch = inverse.arm.posture(&near).0;
        let outcome = inverse.solve(&wanted, branch, &near);
        assert!(
            matches!(outcome.status, Status::Converged | Status::JointLimit(_)),
            "{outcome:?}"
        );
        let expected = row.joints("q{}_deg");
        for i in 0..6 {
            assert!(
                (outcome.q[i] - expected[i]).abs() < 1e-7,
                "joint {i}: {} {}",
                outcome.q[i],
                expected[i]
            );
        }
        let fake = numbers_of(&controller.forward(&outcome.q, &conditions));
        let (distance, angle) = gap(
            fake,
            row.numbers(["fx_mm", "fy_mm", "fz_mm", "fqw", "fqx", "fqy", "fqz"]),
        );
        assert!(
            distance < POSITION_MM && angle < ANGLE_RAD,
            "{distance} mm {angle} rad"
        );
    }
}

/// Ortho-parallel parameters of the same robots in the convention of the independent crate, lengths
/// from the makers' drawings.
fn peers() -> [(&'static str, Parameters); 3] {
    let abb = |a1, a2, c1, c2, c3, c4| Parameters {
        a1,
        a2,
        c1,
        c2,
        c3,
        c4,
        offsets: [0.0, 0.0, -std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0],
        ..Parameters::new()
    };
    [
        (
            "abb_irb120.yaml",
            abb(0.0, -0.070, 0.290, 0.270, 0.302, 0.072),
        ),
        (
            "abb_irb2600_12_165.yaml",
            abb(0.150, -0.115, 0.445, 0.700, 0.795, 0.085),
        ),
        (
            "abb_irb1600_6_145.yaml",
            abb(0.150, 0.0, 0.4865, 0.700, 0.600, 0.065),
        ),
    ]
}

#[test]
fn every_solution_of_an_independent_closed_form_is_one_of_the_eight_branches() {
    let conditions = Conditions::default();
    for (file, parameters) in peers() {
        let profile = profile(file);
        let arm = Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism)
            .expect("a spherical wrist");
        let controller = profile.controller_model(&Mounted::flange());
        let peer = OPWKinematics::new(parameters);
        let mut random = StdRng::seed_from_u64(7);
        let mut compared = 0;
        for _ in 0..10_000 {
            let q = random_joints(&mut random, &profile);
            let margins = arm.posture(&q).1;
            if margins.wrist_rad < 0.01 || margins.elbow_rad < 0.01 || margins.shoulder_m < 0.005 {
                continue;
            }
            let wanted = controller.forward(&q, &conditions);
            let theirs = peer.forward(&q);
            let t = theirs.translation;
            let r = theirs.rotation;
            let (distance, angle) = gap(
                numbers_of(&wanted),
                [t.x * 1e3, t.y * 1e3, t.z * 1e3, r.w, r.x, r.y, r.z],
            );
            // the flange of the crate is rotated about its own z against the maker's
            assert!(distance < 1e-9, "{file} {distance} mm, {angle} rad");
            let ours: Vec<[f64; 6]> = Branch::ALL
                .iter()
                .map(|branch| arm.solve_branch(&wanted, *branch, &q))
                .filter(|solution| solution.beyond == 0.0)
                .map(|solution| solution.q)
                .collect();
            for solution in peer.inverse(&theirs) {
                let same = |mine: &&[f64; 6]| {
                    (0..6).all(|i| {
                        let by = (mine[i] - solution[i]).rem_euclid(std::f64::consts::TAU);
                        by.min(std::f64::consts::TAU - by) < 1e-6
                    })
                };
                assert!(
                    ours.iter().any(|mine| same(&mine)),
                    "{file}: {solution:?} of {ours:?}"
                );
                compared += 1;
            }
        }
        assert!(compared > 30_000, "{file}: {compared}");
    }
}
