//! At which temperature an arm is as its profile says, where nothing tells: a device whose lengths
//! are wrong does the same to the rows as another temperature.

use super::standing::{found, moved};
use super::{group, with_csv};
use crate::trial::{Case, case};
use poseshift::diagnose::{Diagnosis, Options, Standing, Verdict};
use poseshift::identify::pick::Pick;
use poseshift::model::Conditions;
use poseshift::model::effects::Kind;
use poseshift::model::profile::Profile;

const PER_K: f64 = 12e-6;

/// An arm that is as its profile says at one temperature and grows from there, seen at others by a
/// device whose lengths are wrong by a part.
struct Warm {
    case: Case,
    right_c: f64,
    rows_c: [f64; 2],
}

impl Warm {
    fn of(seed: u64, right_c: f64, rows_c: [f64; 2], ppm: f64) -> Self {
        let base = case(group("clean"), 0, seed, 150);
        let name = base.profile.tools.keys().next().expect("its tool").clone();
        let tool = base.profile.tool(&name).expect("its tool");
        let model = base.profile.real_model(&tool, &Conditions::default());
        let off = tool.flange_from_tool.inverse();
        let stands = base.profile.world_from_base.translation;
        let celsius = |row: usize| rows_c[0] + (rows_c[1] - rows_c[0]) * row as f64 / 149.0;
        let warm = moved(base, |row, degrees| {
            let q = degrees.map(f64::to_radians);
            let place = model.forward(&q, &Conditions::default());
            let flange = (place * off).translation;
            let grown = PER_K * (celsius(row) - right_c);
            std::array::from_fn(|k| {
                let truth = grown * (flange[k] - stands[k]);
                1e3 * (truth + 1e-6 * ppm * (place.translation[k] + truth))
            })
        });
        let mut lines = warm.csv.lines();
        let header = lines.next().expect("a header");
        let header = header.replace("temperature_c", "room");
        let mut csv = format!("{header},temperature_c\n");
        for (row, line) in lines.enumerate() {
            csv += &format!("{line},{:.2}\n", celsius(row));
        }
        Self {
            case: with_csv(warm, csv),
            right_c,
            rows_c,
        }
    }

    fn diagnosed(&self, reject: &str) -> Diagnosis {
        let options = Options {
            reject: Pick::parse_list(reject).expect("effects"),
            ..Options::default()
        };
        found(&self.case, &options)
    }

    /// What a profile misses of this arm in other postures, at the same temperatures, root mean
    /// square, mm: no device is between.
    fn missed_mm(&self, by: &Profile) -> f64 {
        let own = &self.case.profile;
        let name = own.tools.keys().next().expect("its tool");
        let (tool, their) = (own.tool(name), by.tool(name));
        let (tool, their) = (tool.expect("its tool"), their.expect("the same"));
        let off = tool.flange_from_tool.inverse();
        let stands = own.world_from_base.translation;
        let mut sum = 0.0_f64;
        let count = 200;
        for k in 0..count {
            let part = f64::from(k) / f64::from(count - 1);
            let celsius = self.rows_c[0] + part * (self.rows_c[1] - self.rows_c[0]);
            let q: [f64; 6] = std::array::from_fn(|i| {
                let turn = f64::from(k) * (0.61 + 0.23 * i as f64);
                [1.2, 0.7, 0.6, 1.4, 1.1, 2.0][i] * turn.sin()
            });
            let at = Conditions {
                temperature_c: Some(celsius),
                ..Conditions::default()
            };
            let place = own.real_model(&tool, &at).forward(&q, &at);
            let flange = (place * off).translation;
            let grown = PER_K * (celsius - self.right_c);
            let said = by.real_model(&their, &at).forward(&q, &at).translation;
            for k in 0..3 {
                let truth = place.translation[k] + grown * (flange[k] - stands[k]);
                sum += (1e3 * (said[k] - truth)).powi(2);
            }
        }
        (sum / f64::from(count)).sqrt()
    }
}

#[test]
fn a_scale_of_the_device_and_a_temperature_of_lengths_are_not_distinguished() {
    // 80 ppm are 6.7 degrees of growth
    for (right_c, rows_c, ppm, without_c) in [
        (20.0, [22.0, 30.0], 80.0, 13.3),
        (20.0, [22.0, 30.0], -80.0, 26.7),
        (20.0, [18.0, 24.0], 80.0, 13.3),
        (26.0, [26.0, 34.0], 0.0, 26.0),
        (18.0, [18.0, 26.0], 0.0, 18.0),
    ] {
        for seed in 1..4 {
            let warm = Warm::of(seed, right_c, rows_c, ppm);
            let d = warm.diagnosed("");
            let what = format!("{right_c} {rows_c:?} {ppm} {seed}");
            assert_eq!(d.verdict, Verdict::Explained, "{what}: {:?}", d.reasons);
            let [growth] = &d.found[..] else {
                let labels = d.found.iter().map(|f| f.effect.label());
                panic!("{what}: {:?}", labels.collect::<Vec<_>>());
            };
            assert_eq!(growth.effect.kind, Kind::ThermalGrowth, "{what}");
            let [per_k, reference_c, ..] = growth.effect.parameters;
            assert!((per_k - PER_K).abs() < 4e-6, "{what}: {per_k}");
            assert!(
                (reference_c - without_c).abs() < 3.0,
                "{what}: {reference_c}"
            );
            // of a right device some rows say that it is right
            assert!(ppm == 0.0 || growth.standing == Standing::Likely, "{what}");
            if growth.standing == Standing::Likely {
                let against = growth.against.first().expect("the device");
                let names_it = against.what.contains("measurement_scale");
                assert!(names_it, "{}", against.what);
                assert!(
                    (1.0..150.0).contains(&against.odds),
                    "{what}: {}",
                    against.odds
                );
                assert!(d.remarks.iter().any(|remark| remark.id == "reference-open"));
            }
            let (start, written) = (
                warm.missed_mm(&warm.case.profile),
                warm.missed_mm(&d.profile),
            );
            assert!(written < 0.95 * start, "{what}: {start} {written}");
        }
    }
}

#[test]
fn a_device_that_is_known_to_be_right_leaves_the_temperature_sure() {
    let warm = Warm::of(1, 26.0, [26.0, 34.0], 0.0);
    let d = warm.diagnosed("measurement_scale");
    assert_eq!(d.found.len(), 1);
    assert_eq!(d.found[0].standing, Standing::Certain);
    let (start, written) = (
        warm.missed_mm(&warm.case.profile),
        warm.missed_mm(&d.profile),
    );
    assert!(written < 0.3 * start, "{start} {written}");
    // and where the arm is as drawn at 20 degrees nothing is open
    let d = Warm::of(1, 20.0, [22.0, 30.0], 0.0).diagnosed("");
    assert_eq!(d.found[0].standing, Standing::Certain);
}
