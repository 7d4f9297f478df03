//! Whole rotations of joints where no data of them are in the file.

use super::{PLAIN, done};
use poseshift::model::Conditions;
use poseshift::model::profile::Mounted;

#[test]
fn a_correction_across_half_a_rotation_from_where_a_joint_stands_is_reported() {
    // a program without data of rotations: the controller takes the nearest one
    let wrist = |deg: f64| format!("{{effect: link_geometry, link: 6, theta_deg: {deg}}}");
    let plain = super::profile(&[PLAIN]);
    let at = |j6: f64| {
        let q = [10.0, 20.0, -10.0, 30.0, 60.0, j6].map(f64::to_radians);
        let controller = plain.controller_model(&Mounted::flange());
        let pose = controller.forward(&q, &Conditions::default());
        let numbers = [pose.translation, pose.rotation.vector()].concat();
        numbers
            .iter()
            .map(|x| format!("{x:.7}"))
            .collect::<Vec<_>>()
            .join(",")
    };
    let program = |j6: f64| {
        format!(
            "movej([0.1745,0.3491,-0.1745,0.5236,1.0472,-1.5707963])\nmovej(p[{}])\n",
            at(j6)
        )
    };
    // the first takes joint 6 to 90.05 deg, half a rotation from -90 is 90
    for (deg, j6, expected) in [(-0.1, 89.95, 1), (0.1, 89.95, 0), (-0.1, 89.0, 0)] {
        let text = program(j6);
        let done = done(&[&wrist(deg)], &[("t.script", &text)]);
        let found: Vec<_> = done
            .findings
            .iter()
            .filter(|f| f.id == "several-postures")
            .collect();
        assert_eq!(
            found.len(),
            expected,
            "{deg} {j6} {:?} {:?}",
            done.findings,
            done.targets[0].q
        );
        for found in found {
            assert!(
                found.message.contains("joint 6") && found.message.contains("90.05 deg"),
                "{found:?}"
            );
        }
    }
}
