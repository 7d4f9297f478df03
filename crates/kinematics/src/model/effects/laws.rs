//! What holds for every effect of the registry.

use super::{Effect, Kind, MOST_PARAMETERS, REGISTRY, Site, SiteKey, of_arm};
use crate::geometry::{Dual, Pose, Scalar};
use crate::model::example;
use crate::model::{Conditions, Model, Motion, Sensitivity, Slot};

/// Postures, away from singularities and limits.
const POSTURES: [[f64; 6]; 3] = [
    [0.3, -0.4, 0.5, 0.6, -0.7, 0.8],
    [-1.1, 0.7, -0.6, 1.9, 0.9, -2.5],
    [2.0, 0.2, -0.9, -1.4, 0.5, 4.0],
];

fn conditions() -> Conditions {
    Conditions {
        direction: [1.0, -1.0, 1.0, 1.0, -1.0, 1.0],
        force_n: [20.0, -35.0, 10.0],
        temperature_c: Some(27.0),
        time_s: Some(300.0),
        gravity_m_s2: None,
        device_m: [0.4, -2.9, 1.1],
        point: Some(3),
        row: Some(7),
        rows: 20,
        moved: [0.4, -0.9, 0.3, 1.2, -0.5, 2.0],
    }
}

fn pose_with(kind: Kind, parameters: [f64; MOST_PARAMETERS], q: &[f64; 6]) -> Pose {
    let conditions = conditions();
    let effect = Effect {
        kind,
        site: site(kind),
        parameters,
    };
    Model::build(
        &example::geometry(),
        &example::mechanism(),
        &[compliance(), effect],
        &conditions,
    )
    .forward(q, &conditions)
}

/// Two periods in one revolution, or the second row.
fn site(kind: Kind) -> Site {
    let place = if kind.definition().begins_at_a_row() {
        SiteKey::Row
    } else {
        SiteKey::Order
    };
    Site {
        index: 3,
        on: 4,
        order: 2 * place.one(),
        tool: None,
    }
}

#[test]
fn names_and_keys_are_unique_and_keys_end_in_their_units() {
    for (i, kind) in REGISTRY.iter().enumerate() {
        let d = kind.definition();
        assert!(
            REGISTRY[..i]
                .iter()
                .all(|other| other.definition().id != d.id),
            "{}",
            d.id
        );
        assert!(
            !d.parameters.is_empty() && d.parameters.len() <= MOST_PARAMETERS,
            "{}",
            d.id
        );
        assert!(
            !d.summary.is_empty() && !d.equation.is_empty() && !d.source.is_empty(),
            "{}",
            d.id
        );
        for (j, parameter) in d.parameters.iter().enumerate() {
            assert!(
                d.parameters[..j]
                    .iter()
                    .all(|other| other.key != parameter.key),
                "{}",
                d.id
            );
            assert!(parameter.prior_sigma > 0.0, "{} {}", d.id, parameter.key);
            let ending = match parameter.unit.symbol() {
                "mm" => "_mm",
                "deg" => "_deg",
                "rad/(N m)" => "rad_per_n_m",
                "ppm" => "ppm",
                "rows" => "_rows",
                _ => "",
            };
            assert!(
                parameter.key.ends_with(ending) || parameter.key == parameter.unit.symbol(),
                "{} {}",
                d.id,
                parameter.key
            );
        }
    }
}

#[test]
fn zero_parameters_change_nothing() {
    for q in &POSTURES {
        let nominal = Model::build(
            &example::geometry(),
            &example::mechanism(),
            &[compliance()],
            &conditions(),
        )
        .forward(q, &conditions());
        for kind in of_arm() {
            let gap = pose_with(kind, [0.0; MOST_PARAMETERS], q).separation(&nominal);
            assert!(
                gap.distance_m < 1e-15 && gap.angle_rad < 1e-15,
                "{}",
                kind.definition().id
            );
        }
    }
}

/// Every parameter at its typical size, in SI.
fn typical(kind: Kind) -> [f64; MOST_PARAMETERS] {
    let mut parameters = [0.0; MOST_PARAMETERS];
    for (slot, parameter) in parameters.iter_mut().zip(kind.definition().parameters) {
        *slot = parameter.prior_sigma * parameter.unit.in_si();
    }
    parameters
}

/// A joint's compliance, through which an error of the load shows.
fn compliance<S: Scalar>() -> Effect<S> {
    let effect = Effect {
        kind: Kind::JointCompliance,
        site: site(Kind::JointCompliance),
        parameters: typical(Kind::JointCompliance),
    };
    effect.cast()
}

#[test]
fn every_parameter_moves_the_tool_or_its_orientation() {
    for kind in &of_arm().collect::<Vec<_>>() {
        let d = kind.definition();
        for (index, parameter) in d.parameters.iter().enumerate() {
            let mut parameters = typical(*kind);
            // a knee above every torque is none
            parameters[index] *= if parameter.key == "torque_n_m" {
                0.01
            } else {
                10.0
            };
            let moved = POSTURES.iter().any(|q| {
                let gap = pose_with(*kind, parameters, q).separation(&pose_with(
                    *kind,
                    typical(*kind),
                    q,
                ));
                gap.distance_m > 1e-7 || gap.angle_rad > 1e-7
            });
            assert!(moved, "{} {}", d.id, parameter.key);
        }
    }
}

#[test]
fn dual_derivatives_agree_with_central_differences() {
    let conditions = conditions();
    for kind in &of_arm().collect::<Vec<_>>() {
        let d = kind.definition();
        for (index, parameter) in d.parameters.iter().enumerate() {
            let at = 0.7 * parameter.prior_sigma * parameter.unit.in_si();
            let step = 1e-3 * parameter.prior_sigma * parameter.unit.in_si();
            let mut values = typical(*kind).map(Dual::<1>::constant);
            values[index] = Dual::variable(at, 0);
            let effect = Effect {
                kind: *kind,
                site: site(*kind),
                parameters: values,
            };
            let model = Model::build(
                &example::geometry(),
                &example::mechanism(),
                &[compliance(), effect],
                &conditions,
            );
            for q in &POSTURES {
                let dual = model.forward(
                    &q.map(|q| Dual {
                        value: q,
                        slope: [0.0],
                    }),
                    &conditions,
                );
                let plain = |by: f64| {
                    let mut parameters = typical(*kind);
                    parameters[index] = at + by;
                    pose_with(*kind, parameters, q).translation
                };
                let (low, high) = (plain(-step), plain(step));
                for i in 0..3 {
                    let slope = (high[i] - low[i]) / (2.0 * step);
                    let tolerance = 1e-9 / step.max(1e-9) * 1e-3 + 1e-6 * slope.abs();
                    assert!(
                        (dual.translation[i].slope[0] - slope).abs() < tolerance,
                        "{} {}",
                        d.id,
                        parameter.key
                    );
                }
            }
        }
    }
}

#[test]
fn an_entry_written_is_read_as_the_same_effect() {
    for kind in REGISTRY {
        let d = kind.definition();
        let mut site = Site::default();
        for place in d.site {
            match place {
                SiteKey::Link
                | SiteKey::Joint
                | SiteKey::JointOrBase
                | SiteKey::Axis
                | SiteKey::Point => {
                    site.index = 3;
                }
                SiteKey::On => site.on = 4,
                SiteKey::Order => site.order = 13_500,
                SiteKey::Row | SiteKey::Degree(..) => site.order = 2,
                SiteKey::Along(_) | SiteKey::About(_) => site.on = 1,
                SiteKey::Period => site.order = 12_567,
                SiteKey::Tool => site.tool = Some("gripper".into()),
            }
        }
        let mut parameters = [0.0; MOST_PARAMETERS];
        for (slot, parameter) in parameters.iter_mut().zip(d.parameters) {
            *slot = 0.3 * parameter.prior_sigma * parameter.unit.in_si();
        }
        let effect = Effect {
            kind: *kind,
            site,
            parameters,
        };
        let entry = effect
            .to_entry()
            .into_iter()
            .map(|(key, value)| (key.to_owned(), value))
            .collect();
        let back = Effect::from_entry(&entry).expect("an entry that was just written");
        assert!(back.same_place(&effect), "{}", d.id);
        for (a, b) in back.parameters.iter().zip(&effect.parameters) {
            assert!((a - b).abs() <= 1e-15 * b.abs(), "{}", d.id);
        }
    }
}

/// Rounding of derivatives of poses of some metres.
const SLOPE_TOLERANCE: f64 = 1e-11;

/// Every effect of the registry at once, none of its parameters zero, and a second compliance that
/// all torques reach.
fn all_effects() -> Vec<Effect> {
    let mut all: Vec<Effect> = of_arm()
        .map(|kind| {
            let mut parameters = [0.0; MOST_PARAMETERS];
            for (slot, parameter) in parameters.iter_mut().zip(kind.definition().parameters) {
                *slot = 2.0 * parameter.prior_sigma * parameter.unit.in_si();
            }
            Effect {
                kind,
                site: site(kind),
                parameters,
            }
        })
        .collect();
    for index in [0, 1, 2, 4, 5] {
        let mut effect = all
            .iter()
            .find(|e| e.kind == Kind::JointCompliance)
            .expect("it is in the registry")
            .clone();
        effect.site.index = index;
        all.push(effect);
    }
    all
}

#[test]
fn fast_derivatives_agree_with_full_duals() {
    let (mechanism, conditions) = (example::mechanism(), conditions());
    let mut geometry = example::geometry();
    geometry.world_from_base = Pose::from_xyz_rxryrz([2.0, -1.0, 0.5, 0.7, -0.4, 2.0]);
    let everything = all_effects();
    // effects that bend take another way through the derivatives: each with the plain ones, and the
    // plain ones alone
    let plain: Vec<Effect> = everything
        .iter()
        .filter(|effect| !effect.definition().bends)
        .cloned()
        .collect();
    for effects in [&plain, &everything] {
        let mut slots = Vec::new();
        for (effect, e) in effects.iter().enumerate() {
            let count = e.definition().parameters.len();
            slots.extend((0..count).map(|parameter| Slot { effect, parameter }));
        }
        let fast = Sensitivity::build(&geometry, &mechanism, effects, &slots, &conditions);
        let mut motions = vec![Motion::default(); slots.len()];
        for q in &POSTURES {
            let pose = fast.evaluate(q, &conditions, &mut motions);
            for (slot, motion) in slots.iter().zip(&motions) {
                let mut dual: Vec<Effect<Dual<1>>> = effects.iter().map(Effect::cast).collect();
                dual[slot.effect].parameters[slot.parameter].slope = [1.0];
                let model = Model::build(&geometry, &mechanism, &dual, &conditions);
                let full = model.forward(
                    &q.map(|q| Dual {
                        value: q,
                        slope: [0.0],
                    }),
                    &conditions,
                );
                let label = format!("{} {}", effects[slot.effect].label(), slot.parameter);
                for i in 0..3 {
                    assert!((full.translation[i].value - pose.translation[i]).abs() < 1e-14);
                    let gap = (full.translation[i].slope[0] - motion.shift_m[i]).abs();
                    assert!(gap < SLOPE_TOLERANCE, "{label}: {gap}");
                }
                // dR = [ω]× R
                let slope =
                    crate::geometry::Rotation(full.rotation.0.map(|r| r.map(|x| x.slope[0])));
                let turn = (slope * pose.rotation.transpose()).sine_axis();
                for i in 0..3 {
                    let gap = (turn[i] - motion.turn_rad[i]).abs();
                    assert!(gap < SLOPE_TOLERANCE, "{label}: {gap}");
                }
            }
        }
    }
}
