//! What validation says of rows whose errors are known.

use super::identify::{DEG, MM, commands, hidden, known_tool, measure, nominal};
use poseshift::geometry::{Vector, norm, scale, sub};
use poseshift::identify::calibration::calibrate;
use poseshift::identify::measurements::{Measurements, Observed};
use poseshift::identify::parameters::Level;
use poseshift::identify::simulate::Session;
use poseshift::identify::validation::{REGIONS, Refit, validate};
use poseshift::model::effects::{Effect, Kind, Site};
use poseshift::model::profile::Profile;
use rand::SeedableRng;
use rand::rngs::StdRng;

fn exact(profile: &Profile, count: usize) -> Measurements {
    let mut random = StdRng::seed_from_u64(31);
    measure(
        profile,
        &commands(&mut random, profile, count),
        &Session::default(),
    )
}

fn position(observed: &mut Observed) -> &mut Vector {
    match observed {
        Observed::Position(p) => p,
        _ => panic!("positions were simulated"),
    }
}

#[test]
fn pose_accuracy_and_repeatability_are_those_worked_out_by_hand() {
    let profile = nominal();
    let mut seen = exact(&profile, 20);
    let first = seen.rows[0].clone();
    // mean (0.2, 0, 0); distances from it 0.2, 0.2, 0.1, 0.1
    let gaps = [[0.4, 0.0, 0.0], [0.0; 3], [0.2, 0.1, 0.0], [0.2, -0.1, 0.0]];
    seen.rows.remove(0);
    for (k, gap) in gaps.iter().enumerate() {
        let mut row = first.clone();
        let p = position(&mut row.observed);
        for i in 0..3 {
            p[i] += gap[i] * MM;
        }
        // the first and third from above: means (0.3, 0.05, 0) and (0.1, -0.05, 0)
        row.conditions.direction = [if k % 2 == 0 { 1.0 } else { -1.0 }; 6];
        row.line = (100 + k).into();
        seen.rows.push(row);
    }
    let found = validate(&profile, &seen, Refit::No, None).expect("a validation");
    let [repeated] = found.repeated.as_slice() else {
        panic!("{:?}", found.repeated);
    };
    assert_eq!((repeated.line.number, repeated.count), (100, 4));
    assert!((repeated.accuracy_mm - 0.2).abs() < 1e-9);
    // 0.15 + 3 sqrt(4 · 0.05² / 3)
    assert!((repeated.repeatability_mm - 0.323_205_080_756_888).abs() < 1e-9);
    // sqrt(0.2² + 0.1²)
    let variation = repeated.variation_mm.expect("two directions");
    assert!((variation - 0.223_606_797_749_979).abs() < 1e-9);
}

#[test]
fn unknown_directions_are_no_direction_and_distances_are_those_worked_out_by_hand() {
    let profile = nominal();
    let mut seen = exact(&profile, 20);
    let [a, b] = [seen.rows[0].clone(), seen.rows[1].clone()];
    seen.rows.drain(..2);
    let apart = |a: Vector, b: Vector| norm(sub(a, b)) / MM;
    let [pa, pb] = [&a, &b].map(|row| row.observed.point_m().expect("a position"));
    let along = scale(1.0 / norm(sub(pb, pa)), sub(pb, pa));
    // the first cycle tells no direction and is far off; the second pose is 0.1, 0.2, 0.3 mm too
    // far
    let mut line = 100;
    for cycle in 0..3 {
        for (row, far) in [(&a, 0.0), (&b, 0.1 * f64::from(cycle + 1))] {
            let mut row = row.clone();
            let p = position(&mut row.observed);
            *p = std::array::from_fn(|k| p[k] + far * MM * along[k]);
            if cycle == 0 {
                row.conditions.direction = [0.0; 6];
            } else {
                let way = if cycle == 1 { 1.0 } else { -1.0 };
                row.conditions.direction = [0.0, way, 0.0, way, 0.0, 0.0];
            }
            row.line = line.into();
            line += 1;
            seen.rows.push(row);
        }
    }
    let found = validate(&profile, &seen, Refit::No, None).expect("a validation");
    let [first, second] = found.repeated.as_slice() else {
        panic!("{:?}", found.repeated);
    };
    assert!(first.variation_mm.expect("two directions") < 1e-9);
    // 0.2 and 0.3 mm, not 0.1
    assert!((second.variation_mm.expect("two directions") - 0.1).abs() < 1e-9);
    // the controller is the real arm here
    assert!((second.commanded_accuracy_mm - second.accuracy_mm).abs() < 1e-9);
    let [distance] = found.repeated_distances.as_slice() else {
        panic!("{:?}", found.repeated_distances);
    };
    let lines = distance.lines.each_ref().map(|line| line.number);
    assert_eq!((lines, distance.count), ([100, 101], 3));
    assert!((distance.distance_mm - apart(pa, pb) - 0.2).abs() < 1e-9);
    assert!((distance.accuracy_mm - 0.2).abs() < 1e-9);
    assert!((distance.commanded_accuracy_mm - 0.2).abs() < 1e-9);
    assert!((distance.repeatability_mm - 0.3).abs() < 1e-9);
}

#[test]
fn regions_hold_the_rows_at_their_distance_from_the_calibration() {
    let mut profile = nominal();
    let middle = [0.3, 0.1, 0.4];
    profile.quality = Some(serde_json::json!({"middle_mm": [300.0, 100.0, 400.0]}));
    let mut seen = exact(&profile, 400);
    let distance = |row: &poseshift::identify::measurements::Measurement| {
        norm(sub(row.observed.point_m().expect("a position"), middle))
    };
    let far = seen.rows.iter().map(distance).fold(0.0, f64::max);
    let width = far / REGIONS as f64;
    // none near a border, which the errors move a little; the farthest row has no error
    let keep = |row: &_| {
        let part = distance(row) / width;
        (part - part.round()).abs() * width > 2.0 * MM || distance(row) == far
    };
    seen.rows.retain(keep);
    let mut counts = [0; REGIONS];
    for row in &mut seen.rows {
        let away = distance(row);
        let ring = (1..REGIONS).filter(|k| away >= *k as f64 * width).count();
        counts[ring] += 1;
        if away < far {
            let p = position(&mut row.observed);
            let inward = scale(-0.1 * MM * (ring + 1) as f64 / away, sub(*p, middle));
            *p = poseshift::geometry::add(*p, inward);
        }
    }
    let found = validate(&profile, &seen, Refit::No, None).expect("a validation");
    let regions: Vec<_> = found.parts.iter().filter(|p| p.by == "region").collect();
    assert_eq!(regions.len(), REGIONS);
    for (ring, part) in regions.iter().enumerate() {
        assert_eq!(part.spread.n, counts[ring], "{}", part.name);
        let last = ring + 1 == REGIONS;
        let expected = 0.1 * (ring + 1) as f64 * (counts[ring] - usize::from(last)) as f64
            / counts[ring] as f64;
        assert!((part.spread.mean - expected).abs() < 1e-9, "{}", part.name);
    }
}

#[test]
fn fifty_configurations_hold_on_9905_others_and_their_49_million_pairs() {
    let mut random = StdRng::seed_from_u64(41);
    let mut truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
    // an effect that the model lacks, of the size that the thesis's second robot was left with
    for (joint, size) in [(1, 1.5e-4), (2, 1.5e-4), (4, 3e-4)] {
        let mut parameters = [0.0; 6];
        parameters[0] = size;
        truth.effects.push(Effect {
            kind: Kind::JointHarmonic,
            site: Site {
                index: joint,
                order: 2000,
                ..Site::default()
            },
            parameters,
        });
    }
    let session = Session {
        noise_m: 0.03 * MM,
        ..Session::default()
    };
    let fit = measure(&truth, &commands(&mut random, &truth, 50), &session);
    let found = calibrate(&nominal(), &fit, &known_tool(Level::Compliance)).expect("an answer");
    let others = measure(&truth, &commands(&mut random, &truth, 9905), &session);
    let judged = validate(&found.profile(), &others, Refit::No, None)
        .expect("a validation")
        .real;
    let position = judged.quality.position.expect("positions");
    let distance = judged.distance.expect("pairs");
    println!(
        "50 -> 9905: mean {:.3} std {:.3} max {:.3} mm; {} pairs: mean {:.3} std {:.3} max {:.3} \
         mm",
        position.mean,
        position.std,
        position.max,
        distance.pairs,
        distance.mean,
        distance.std,
        distance.max
    );
    assert_eq!(position.n, 9905);
    assert_eq!(distance.pairs, 49_049_560);
    assert!(
        position.mean > 0.03 && position.mean < 0.2,
        "{}",
        position.mean
    );
    // every pair in a plain loop
    let (mut sum, mut squares, mut most) = (0.0, 0.0, 0.0_f64);
    let points: Vec<(Vector, Vector)> = others
        .rows
        .iter()
        .zip(&judged.misses)
        .map(|(row, miss)| (row.observed.point_m().expect("a position"), miss.expected_m))
        .collect();
    for (i, a) in points.iter().enumerate() {
        for b in &points[i + 1..] {
            let error = 1e3 * (norm(sub(a.0, b.0)) - norm(sub(a.1, b.1))).abs();
            sum += error;
            squares += error * error;
            most = most.max(error);
        }
    }
    let n = 49_049_560.0;
    let mean = sum / n;
    let std = ((squares - n * mean * mean) / (n - 1.0)).sqrt();
    assert!(
        (distance.mean / mean - 1.0).abs() < 2e-6,
        "{} {mean}",
        distance.mean
    );
    assert!(
        (distance.std / std - 1.0).abs() < 1e-5,
        "{} {std}",
        distance.std
    );
    assert!(
        (distance.max / most - 1.0).abs() < 1e-5,
        "{} {most}",
        distance.max
    );
}
