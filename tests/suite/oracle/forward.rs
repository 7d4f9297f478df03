//! The forward model against an independent one in 50-digit arithmetic (tests/data/forward).

use crate::support::{gap, numbers_of, table, text};
use poseshift::model::Conditions;
use poseshift::model::profile::Profile;

/// Rounding of a few hundred operations on numbers of a metre.
const POSITION_MM: f64 = 2e-10;
const ANGLE_RAD: f64 = 1e-13;
const TORQUE_N_M: f64 = 1e-10;

const POSE: [&str; 7] = ["x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"];
const CONTROLLER_POSE: [&str; 7] = ["cx_mm", "cy_mm", "cz_mm", "cqw", "cqx", "cqy", "cqz"];
const DIRECTIONS: [&str; 6] = ["dir1", "dir2", "dir3", "dir4", "dir5", "dir6"];
const FORCES: [&str; 3] = ["fx_n", "fy_n", "fz_n"];

#[test]
fn real_and_controller_poses_torques_and_deflections_agree_with_the_oracle() {
    let folder = "tests/data/forward";
    let cases = table(&format!("{folder}/cases.csv"));
    let mut rows_seen = 0;
    for case in &cases {
        let name = case.text("case");
        let profile =
            Profile::from_yaml(&text(&format!("{folder}/{}", case.text("profile")))).expect(name);
        let tool = profile.tool(case.text("tool")).expect("the case's tool");
        let controller = profile.controller_model(&tool);
        let joints = table(&format!("{folder}/{}", case.text("joints")));
        let expected = table(&format!("{folder}/{}", case.text("expected")));
        assert_eq!(joints.len(), expected.len(), "{name}");
        for (row, want) in joints.iter().zip(&expected) {
            let q = row.joints("q{}_deg");
            let conditions = Conditions {
                direction: DIRECTIONS.map(|c| row.number_or_zero(c)),
                force_n: FORCES.map(|c| row.number_or_zero(c)),
                ..Conditions::default()
            };
            let real = profile.real_model(&tool, &conditions);
            let (distance, angle) = gap(
                numbers_of(&real.forward(&q, &conditions)),
                want.numbers(POSE),
            );
            assert!(
                distance < POSITION_MM && angle < ANGLE_RAD,
                "{name}: {distance} mm {angle} rad"
            );
            let (distance, angle) = gap(
                numbers_of(&controller.forward(&q, &Conditions::default())),
                want.numbers(CONTROLLER_POSE),
            );
            assert!(
                distance < POSITION_MM && angle < ANGLE_RAD,
                "{name}, controller: {distance} mm {angle} rad"
            );
            let torques = real.torques(&q, &conditions);
            let deflection = real.deflection(&q, &conditions);
            for i in 0..6 {
                let torque = want.number(&format!("tau{}_n_m", i + 1));
                assert!(
                    (torques[i] - torque).abs() < TORQUE_N_M,
                    "{name}: torque {} {torque}",
                    torques[i]
                );
                let delta = want.number(&format!("delta{}_deg", i + 1)).to_radians();
                assert!(
                    (deflection.joints[i] - delta).abs() < ANGLE_RAD,
                    "{name}: joint {i} {delta}"
                );
            }
            rows_seen += 1;
        }
    }
    assert_eq!((cases.len(), rows_seen), (13, 470));
}
