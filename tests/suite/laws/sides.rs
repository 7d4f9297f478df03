//! On which side of axis 1 and of the lower arm a posture stands is the arm's matter, not that of
//! how its chain is written.

use super::postures;
use crate::support::shipped_profiles;
use poseshift::geometry::{Pose, Rotation};
use poseshift::inverse::Arm;
use poseshift::model::profile::Mounted;
use poseshift::model::profile::catalogue;
use poseshift::model::{Geometry, Mechanism};
use std::f64::consts::PI;

const POSES: usize = 200;

/// The same arm with z of its base down: axis 1 rotates the other way about it.
fn upside_down(geometry: &mut Geometry, mechanism: &mut Mechanism) {
    let [first, second] = [0, 1].map(|i| geometry.links[i]);
    assert_eq!((first.alpha_rad, first.a_m), (0.0, 0.0));
    let flip = Pose {
        rotation: Rotation::about_x(PI),
        ..Pose::identity()
    };
    geometry.world_from_base = geometry.world_from_base * flip;
    geometry.links[0].theta_rad = -first.theta_rad;
    geometry.links[0].d_m = -first.d_m;
    geometry.links[1].alpha_rad = second.alpha_rad - PI;
    let joint = &mut mechanism.joints[0];
    (joint.sign, joint.offset_rad) = (-joint.sign, -joint.offset_rad);
}

/// The same arm with x of the frame that axis 1 turned backwards.
fn backwards(geometry: &mut Geometry, _: &mut Mechanism) {
    geometry.links[0].theta_rad += PI;
    let second = &mut geometry.links[1];
    second.alpha_rad = -second.alpha_rad;
    second.a_m = -second.a_m;
    second.theta_rad -= PI;
}

#[test]
fn the_sides_of_an_arm_do_not_depend_on_how_its_chain_is_written() {
    for (name, profile) in shipped_profiles() {
        let geometry = profile.geometry(&Mounted::flange());
        let arm = Arm::of(&geometry, &profile.mechanism).expect("an inverse");
        let rewrites: [fn(&mut Geometry, &mut Mechanism); 2] = [backwards, upside_down];
        // at the height of axis 2 a base does not tell where it is above
        let has_height = geometry.links[0].d_m != 0.0;
        for rewrite in &rewrites[..=usize::from(has_height)] {
            let (mut other, mut mechanism) = (geometry.clone(), profile.mechanism.clone());
            rewrite(&mut other, &mut mechanism);
            let same = Arm::of(&other, &mechanism).expect("an inverse");
            for q in postures(&profile.mechanism, POSES, 5) {
                let gap = arm.forward(&q).separation(&same.forward(&q));
                assert!(gap.distance_m < 1e-12 && gap.angle_rad < 1e-12, "{name}");
                assert_eq!(arm.posture(&q).0, same.posture(&q).0, "{name}: {q:?}");
            }
        }
    }
}

/// A posture that every arm of a maker takes: over its front, the wrist in front of the lower arm.
const IN_FRONT: [(&str, [f64; 6]); 6] = [
    ("abb_", [10.0, 20.0, -10.0, 20.0, 40.0, 10.0]),
    ("fanuc_", [10.0, 20.0, -10.0, 20.0, -40.0, 10.0]),
    ("kuka_", [10.0, -80.0, 100.0, 20.0, 40.0, 10.0]),
    ("staubli_", [10.0, 30.0, 60.0, 20.0, 40.0, 10.0]),
    ("yaskawa_", [10.0, 20.0, -10.0, 20.0, -40.0, 10.0]),
    ("kawasaki_", [10.0, 20.0, -60.0, 20.0, -40.0, 10.0]),
];

#[test]
fn configuration_data_mean_the_same_for_every_arm_of_a_maker() {
    let mut tried = 0;
    for of_catalogue in catalogue() {
        let mut makers = IN_FRONT.iter();
        let maker = makers.find(|(maker, _)| of_catalogue.name.starts_with(maker));
        let Some((_, degrees)) = maker else { continue };
        let profile = of_catalogue.profile();
        let q = degrees.map(f64::to_radians);
        let mut joints = profile.mechanism.joints.iter().zip(&q);
        // the URDF of a KR 210 counts from other zeros
        if !joints.all(|(joint, q)| (joint.min_rad..=joint.max_rad).contains(q)) {
            continue;
        }
        let Ok(arm) = Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism) else {
            continue;
        };
        let branch = arm.posture(&q).0;
        let sides = (branch.behind_axis_1, branch.behind_lower_arm);
        assert_eq!(sides, (false, false), "{}", of_catalogue.name);
        tried += 1;
    }
    assert!(tried > 200, "{tried}");
}
