//! The product's model against a second implementation that shares no code with it.

use crate::physics::{Moment, tool_pose};
use crate::support::{random_joints, shipped_profiles};
use crate::trial::truth::{faults, robot_of};
use poseshift::geometry::Pose;
use poseshift::model::effects::{BASE, Effect, MOST_PARAMETERS, Site, SiteKey, of_arm};
use poseshift::model::profile::Mounted;
use poseshift::model::{Conditions, Model};
use rand::{RngExt, SeedableRng};

/// The product adds small motions up, the other turns one after another: they differ by products of
/// small angles.
const SECOND_ORDER_M: f64 = 2e-7;
/// Rounding of poses of some metres.
const ROUNDING_M: f64 = 1e-12;

#[test]
fn every_effect_is_the_same_in_two_implementations() {
    let mut random = rand::rngs::StdRng::seed_from_u64(5);
    let mut compared = 0;
    for (name, mut profile) in shipped_profiles() {
        profile.effects.clear();
        profile.world_from_base = Pose::from_xyz_rxryrz([0.4, -0.2, 0.3, 0.1, -0.2, 0.7]);
        let tool = Mounted {
            name: "tool".into(),
            flange_from_tool: Pose::from_xyz_rxryrz([0.05, 0.02, 0.13, 0.1, -0.2, 0.3]),
            load: Some((2.0, [0.02, 0.01, 0.08])),
        };
        let robot = robot_of(&profile, &tool);
        let geometry = profile.geometry(&tool);
        // heavy and long arms bend less by the same torque: what is tested is the equation, not its
        // second order
        let reach: f64 = profile
            .links
            .iter()
            .map(|l| l.a_m.abs() + l.d_m.abs())
            .sum();
        let mass: f64 = profile.bodies.iter().map(|b| b.mass_kg).sum();
        let stiffness = (mass * reach * reach / 25.0).max(1.0);
        for kind in of_arm() {
            let definition = kind.definition();
            for _ in 0..4 {
                let waves = definition.site.contains(&SiteKey::Order);
                let mut site = Site {
                    order: if waves { 13_500 } else { 3 },
                    on: 0,
                    index: random.random_range(1..6),
                    tool: None,
                };
                if definition.site.contains(&SiteKey::JointOrBase) && random.random_range(0..2) == 0
                {
                    site.index = BASE;
                }
                let mut parameters = [0.0; MOST_PARAMETERS];
                for (value, p) in parameters.iter_mut().zip(definition.parameters) {
                    *value = 0.5 * p.prior_sigma * p.unit.in_si() * random.random_range(0.2..1.0);
                }
                if definition.deflects {
                    for value in &mut parameters {
                        *value /= stiffness;
                    }
                }
                let effect = Effect {
                    kind,
                    site,
                    parameters,
                };
                // what a joint drifts by is not also the base's
                let mut alone = effect.clone();
                if definition.site.contains(&SiteKey::JointOrBase) {
                    if effect.site.index == BASE {
                        alone.parameters[0] = 0.0;
                    } else {
                        alone.parameters[1..4].fill(0.0);
                    }
                }
                // the load shows by what bends under it
                let bent = Effect {
                    kind: poseshift::model::effects::Kind::by_id("joint_compliance")
                        .expect("it is in the registry"),
                    site: Site {
                        index: 1,
                        ..Site::default()
                    },
                    parameters: [1e-5 / stiffness, 0.0, 0.0, 0.0, 0.0, 0.0],
                };
                let effects = [bent, alone];
                let conditions = Conditions {
                    direction: [1.0, -1.0, 1.0, -1.0, 1.0, -1.0],
                    force_n: [20.0, -30.0, 10.0],
                    temperature_c: Some(27.0),
                    time_s: Some(900.0),
                    gravity_m_s2: None,
                    device_m: [0.0; 3],
                    point: u32::try_from(effects[1].site.index + random.random_range(0..2)).ok(),
                    row: Some(random.random_range(1..6)),
                    rows: random.random_range(6..20),
                    moved: [0.7, -1.1, 0.2, 2.0, -0.6, 0.9],
                };
                let moment = Moment {
                    direction: conditions.direction,
                    force: conditions.force_n,
                    temperature: 27.0,
                    time: 900.0,
                    point: conditions.point,
                    row: conditions.row.map_or(0, |r| r as usize),
                    rows: conditions.rows as usize,
                    moved: conditions.moved,
                };
                let q = random_joints(&mut random, &profile);
                let model = Model::build(&geometry, &profile.mechanism, &effects, &conditions);
                let mine = model.forward(&q, &conditions);
                let all: Vec<_> = effects.iter().map(faults).collect();
                let other = tool_pose(&robot, &all, &q, &moment);
                let gap = (0..3)
                    .map(|k| (mine.translation[k] - other[k][3]).powi(2))
                    .sum::<f64>()
                    .sqrt();
                let tolerance = if definition.bends {
                    SECOND_ORDER_M
                } else {
                    ROUNDING_M
                };
                assert!(
                    gap < tolerance,
                    "{name} {}: {gap:.1e} m",
                    effects[1].label()
                );
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 4 * of_arm().count() * shipped_profiles().len());
}
