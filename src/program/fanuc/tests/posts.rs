//! Outputs of post-processors, compared with the trajectory they were made from.

use super::*;

#[test]
fn outputs_of_post_processors_have_the_known_targets() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/programs");
    if !folder.exists() {
        eprintln!("{} does not exist: nothing compared", folder.display());
        return;
    }
    let text = std::fs::read_to_string(folder.join("truth.json")).expect("the truth");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    for name in ["Fanuc_R30iA__PGA.LS", "Fanuc_RJ3__PGA.LS"] {
        let bytes = std::fs::read(folder.join("fanuc").join(name)).expect("a program");
        let source = Source::new(name, bytes);
        assert!(Fanuc.recognises(&source));
        let program = Fanuc
            .read(std::slice::from_ref(&source), &Settings::default())
            .expect("a program");
        assert_eq!((program.targets.len(), program.moves.len()), (60, 60));
        assert_eq!(program.findings, [], "{name}");
        let unchanged = crate::program::Edits::default().apply(&source.bytes);
        assert_eq!(unchanged, source.bytes);
        let mut turned = 0;
        for (k, used) in program.moves.iter().enumerate() {
            let target = &program.targets[used.target];
            let point = &truth["progs"]["PGA"][k];
            let joint = |i: usize| number(&point["joints_deg"][i]);
            let decoded = Fanuc.decode(
                target.layout,
                &values(&program, used.target),
                &Settings::default(),
            );
            match decoded.value {
                Value::Joints(joints) => {
                    for (i, angle) in joints.iter().enumerate() {
                        assert!((angle / DEG - joint(i)).abs() < 1e-3, "{name} {k} {i}");
                    }
                }
                Value::Pose(found) => {
                    let frame = &point["pose_in_frame"];
                    let known = Pose {
                        rotation: crate::geometry::Rotation(std::array::from_fn(|i| {
                            std::array::from_fn(|j| number(&frame[i][j]))
                        })),
                        translation: std::array::from_fn(|i| number(&frame[i][3]) / 1000.0),
                    };
                    let gap = found.separation(&known);
                    // three decimals
                    let near = gap.distance_m < 1e-6 && gap.angle_rad < 2e-5;
                    assert!(near, "{name} {k} {gap:?}");
                    // the post writes the turns of joints 1, 4 and 6
                    for i in [0, 3, 5] {
                        let (low, high) = decoded.configuration.joints[i].expect("a turn");
                        let angle = joint(i) * DEG;
                        assert!(low <= angle && angle < high, "{name} {k} {i}");
                        turned += usize::from(low > 0.0 || high < 0.0);
                    }
                }
            }
        }
        assert!(turned > 0, "some joints are beyond a half turn");
    }
}
