use super::*;
use crate::geometry::Dual;
use crate::model::effects::{Kind, MOST_PARAMETERS, REGISTRY, Site, SiteKey};

/// Rounding of poses of some metres.
const TOLERANCE: f64 = 1e-12;

fn axes() -> ExternalAxes {
    let rail = |axis: &str, direction, up| TrackAxis {
        axis: axis.into(),
        direction,
        up,
        zero_m: 0.4,
        min_m: -0.2,
        max_m: 2.8,
        coordinates: Coordinates::World,
        pulses_per_mm: None,
    };
    let rotary = |axis: &str, at: [f64; 6], sign| RotaryAxis {
        axis: axis.into(),
        at: Pose::from_xyz_rxryrz(at),
        sign,
        zero_rad: 0.1,
        min_rad: -3.0,
        max_rad: 3.0,
        pulses_per_deg: None,
    };
    ExternalAxes {
        track: vec![
            rail("E1", [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]),
            rail("E2", [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
        ],
        positioners: vec![Positioner {
            name: "STN1".into(),
            follows: Follows::Frame,
            axes: vec![
                rotary("E3", [0.9, -0.2, 0.3, 0.0, 1.5, 3.0], 1.0),
                rotary("E4", [0.1, 0.0, 0.2, -1.5, 0.2, 0.0], -1.0),
            ],
            plate: Pose::from_xyz_rxryrz([0.0, 0.1, 0.2, 0.1, 0.2, 0.3]),
            points: BTreeMap::new(),
        }],
        other: Vec::new(),
    }
}

const VALUES: [f64; 4] = [2.1, 0.9, 0.7, -1.3];
const DIRECTIONS: [f64; 4] = [1.0, -1.0, 0.0, 0.0];
const ORIGIN: Vector = [0.3, -0.5, 0.8];

fn at() -> At<'static> {
    At {
        values: &VALUES,
        directions: &DIRECTIONS,
    }
}

#[test]
fn without_effects_the_real_base_and_plate_are_the_nominal_ones() {
    let all = axes();
    let gap = all
        .base_real(at(), ORIGIN, &[])
        .separation(&all.base_nominal(&VALUES));
    assert!(gap.distance_m < TOLERANCE && gap.angle_rad < TOLERANCE);
    // by hand: 1.7 m along (0.6, 0.8, 0), 0.5 m up
    let by = all.base_nominal(&VALUES).translation;
    for (a, b) in by.iter().zip([1.7 * 0.6, 1.7 * 0.8, 0.5]) {
        assert!((a - b).abs() < TOLERANCE);
    }
    assert_eq!(all.riding(&VALUES), Pose::identity());
    let zero = all.base_nominal(&[0.4, 0.4, 0.0, 0.0]);
    assert_eq!(zero, Pose::identity(), "at zero the base is at home");
}

/// The place of an effect of an external axis, as far as it applies.
fn site(kind: Kind) -> Site {
    let definition = kind.definition();
    let mut site = Site {
        index: usize::from(definition.id.starts_with("positioner")) * 3,
        order: 3,
        ..Site::default()
    };
    for place in definition.site {
        match place {
            SiteKey::Along(letters) | SiteKey::About(letters) => {
                site.on = usize::from(letters.starts_with('y'));
            }
            SiteKey::Period => site.order = 1_700_000,
            SiteKey::Order => site.order = 3 * place.one(),
            _ => {}
        }
    }
    site
}

fn moved<S: Scalar>(effect: Effect<S>) -> [Pose<S>; 2] {
    let all = axes();
    let values = VALUES.map(S::constant);
    let at = At {
        values: &values,
        directions: &DIRECTIONS,
    };
    let effects = [effect];
    [
        all.base_real(at, ORIGIN, &effects),
        all.plate(0, at, &effects),
    ]
}

#[test]
fn every_parameter_moves_base_or_plate_and_its_derivative_is_exact() {
    let mut seen = 0;
    for &kind in REGISTRY {
        let definition = kind.definition();
        if !definition.of_external_axis() {
            continue;
        }
        for (n, parameter) in definition.parameters.iter().enumerate() {
            let size = parameter.prior_sigma * parameter.unit.in_si();
            let with = |value: f64| {
                let mut parameters = [0.0; MOST_PARAMETERS];
                parameters[n] = value;
                let site = site(kind);
                moved(Effect {
                    kind,
                    site,
                    parameters,
                })
            };
            let mut parameters = [Dual::<1>::constant(0.0); MOST_PARAMETERS];
            parameters[n] = Dual::variable(size, 0);
            let site = site(kind);
            let dual = moved(Effect {
                kind,
                site,
                parameters,
            });
            let mut effect = 0.0_f64;
            for k in 0..2 {
                let (low, high) = (with(0.999 * size)[k], with(1.001 * size)[k]);
                let gap = with(size)[k].separation(&with(0.0)[k]);
                effect = effect.max(gap.distance_m).max(gap.angle_rad);
                for i in 0..3 {
                    let slope = (high.translation[i] - low.translation[i]) / (0.002 * size);
                    let exact = dual[k].translation[i].slope[0];
                    assert!(
                        (exact - slope).abs() < 1e-6 * slope.abs() + 1e-15 / size * 1e3,
                        "{} {}: {exact} {slope}",
                        definition.id,
                        parameter.key
                    );
                }
            }
            assert!(effect > 1e-6, "{} {}", definition.id, parameter.key);
            seen += 1;
        }
    }
    assert!(seen > 20);
}

#[test]
fn a_second_axis_is_carried_by_the_first() {
    // the first axis yaws by 0.01 at its end: what the second goes is rotated along
    let all = ExternalAxes {
        track: vec![
            TrackAxis {
                direction: [1.0, 0.0, 0.0],
                up: [0.0, 0.0, 1.0],
                ..axes().track[0].clone()
            },
            TrackAxis {
                direction: [0.0, 1.0, 0.0],
                up: [0.0, 0.0, 1.0],
                ..axes().track[0].clone()
            },
        ],
        ..ExternalAxes::default()
    };
    let yaw = Effect {
        kind: Kind::TrackRotation,
        site: Site {
            on: 2,
            order: 1,
            ..Site::default()
        },
        parameters: [0.01, 0.0, 0.0, 0.0, 0.0, 0.0],
    };
    let at = |values| At {
        values,
        directions: &[],
    };
    let effects = [yaw];
    let near = all.base_real(at(&[2.8, 0.4]), [0.0; 3], &effects);
    let far = all.base_real(at(&[2.8, 1.4]), [0.0; 3], &effects);
    let by = crate::geometry::sub(far.translation, near.translation);
    assert!((by[0] + 0.01_f64.sin()).abs() < TOLERANCE);
    assert!((by[1] - 0.01_f64.cos()).abs() < TOLERANCE);
}
