//! Outputs of post-processors, compared with the trajectory they were made from.
//!
//! Known to be wrong in them: the joint start is in degrees where pulses belong (the post had no
//! pulse ratios), RCONF has another order of fields than the manual's and a turn where 0 or 1
//! belongs. Frame BASE is right: the post wrote the poses in the base frame.

use super::*;

/// Decimals of the post: 0.001 mm, 0.01 degrees.
const DISTANCE_M: f64 = 1e-6;
const ANGLE_RAD: f64 = 2e-4;

#[test]
fn outputs_of_post_processors_have_the_known_targets() {
    let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("../shared/data/programs");
    if !folder.exists() {
        eprintln!("{} does not exist: nothing compared", folder.display());
        return;
    }
    let text = std::fs::read_to_string(folder.join("truth.json")).expect("the truth");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let pose = |value: &serde_json::Value| {
        let at = |i: usize, j: usize| value[i][j].as_f64().expect("a number");
        Pose {
            rotation: Rotation(std::array::from_fn(|i| std::array::from_fn(|j| at(i, j)))),
            translation: std::array::from_fn(|i| at(i, 3) / 1000.0),
        }
    };
    let mut files = 0;
    for entry in std::fs::read_dir(folder.join("inform")).expect("a folder") {
        let path = entry.expect("a file").path();
        let bytes = std::fs::read(&path).expect("a job");
        let source = Source::new(path.display().to_string(), bytes);
        assert!(Inform.recognises(&source));
        let settings = Settings {
            pulses_per_deg: Some([1.0; 6]),
            ..Settings::default()
        };
        let program = crate::motion::read(&Inform, &[source], &settings).expect("a job");
        // 50 straight moves, 2 joint moves, and 4 arcs, each with its first point once more
        assert_eq!((program.targets.len(), program.moves.len()), (64, 64));
        assert_eq!(program.findings, []);
        let points = truth["progs"]["PGA"].as_array().expect("points");
        let base_from_frame = pose(&truth["frame"]);
        let mut compared = 0;
        let mut known = points.iter();
        let mut before: Option<Pose> = None;
        for used in &program.moves {
            let target = &program.targets[used.target.unwrap()];
            let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
            let value = Inform.decode(target.layout, &numbers, &settings).value;
            match value {
                Value::Joints(joints) => {
                    let point = known.next().expect("a point");
                    let angles = point["joints_deg"].as_array().expect("angles");
                    for (joint, angle) in joints.iter().zip(angles) {
                        // whole degrees
                        let angle = angle.as_f64().expect("an angle");
                        assert!((joint / DEG - angle).abs() < 1.0);
                    }
                    before = None;
                }
                Value::Pose(found) => {
                    // the first point of an arc is the last one of the move before
                    let again = before.is_some_and(|before| {
                        let gap = before.separation(&found);
                        gap.distance_m < DISTANCE_M && gap.angle_rad < ANGLE_RAD
                    });
                    before = Some(found);
                    if again {
                        continue;
                    }
                    let point = known.next().expect("a point");
                    let wanted = base_from_frame * pose(&point["pose_in_frame"]);
                    let gap = found.separation(&wanted);
                    assert!(
                        gap.distance_m < DISTANCE_M && gap.angle_rad < ANGLE_RAD,
                        "{} {gap:?}",
                        target.name.as_deref().unwrap_or_default()
                    );
                }
            }
            compared += 1;
        }
        assert_eq!((compared, known.len()), (60, 0));
        files += 1;
    }
    assert_eq!(files, 1);
}
