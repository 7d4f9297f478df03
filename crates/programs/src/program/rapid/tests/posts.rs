//! Outputs of post-processors, compared with the trajectory they were made from.

use super::*;

/// Outputs of post-processors with known tool and frame; kept next to the project.
fn posts() -> Option<std::path::PathBuf> {
    let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("../shared/data/programs");
    if folder.exists() {
        return Some(folder);
    }
    eprintln!("{} does not exist: nothing compared", folder.display());
    None
}

#[test]
fn outputs_of_post_processors_have_the_known_targets_and_frames() {
    let Some(folder) = posts() else { return };
    let text = std::fs::read_to_string(folder.join("truth.json")).expect("the truth");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let pose = |value: &serde_json::Value| {
        let at = |i: usize, j: usize| value[i][j].as_f64().expect("a number");
        Pose {
            rotation: crate::geometry::Rotation(std::array::from_fn(|i| {
                std::array::from_fn(|j| at(i, j))
            })),
            translation: std::array::from_fn(|i| at(i, 3) / 1000.0),
        }
    };
    for (name, tool_known, frame_known) in [
        ("ABB_RAPID_IRC5__PGA.mod", true, true),
        ("ABB_RAPID_IRC5_clad__PGA.mod", false, false),
        ("ABB_RAPID_S4C__PGA.prg", true, false),
    ] {
        let bytes = std::fs::read(folder.join("rapid").join(name)).expect("a program");
        let source = Source::new(name, bytes);
        assert!(Rapid.recognises(&source));
        let program = motion::read(&Rapid, &[source], &Settings::default()).expect("a program");
        // 50 straight moves, 2 joint moves, and 4 arcs of two points
        assert_eq!(
            (program.targets.len(), program.moves.len()),
            (60, 60),
            "{name}"
        );
        assert_eq!(program.findings, [], "{name}");
        let separated = |found: Option<Pose>, known: &serde_json::Value| {
            found.map(|found| found.separation(&pose(known)))
        };
        let tool = program.moves[1].tool;
        let frame = program.moves[1].frame;
        let tool = separated(program.tools[tool].flange_from_tool, &truth["tool"]);
        let frame = separated(program.frames[frame].world_from_frame, &truth["frame"]);
        assert_eq!(tool.is_some(), tool_known, "{name}");
        // numbers have 6 decimals at least
        assert!(tool.is_none_or(|s| s.distance_m < 1e-9 && s.angle_rad < 1e-5));
        if frame_known {
            assert!(frame.is_some_and(|s| s.distance_m < 1e-9 && s.angle_rad < 1e-5));
        }
        for (k, used) in program.moves.iter().enumerate() {
            let target = &program.targets[used.target.unwrap()];
            let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
            let decoded = Rapid.decode(target.layout, &numbers, &Settings::default());
            let point = &truth["progs"]["PGA"][k];
            match decoded.value {
                Value::Joints(joints) => {
                    let known = point["joints_deg"][1].as_f64().expect("an angle") * DEG;
                    assert!((joints[1] - known).abs() < 1e-6);
                }
                Value::Pose(found) if tool_known && frame_known => {
                    let gap = found.separation(&pose(&point["pose_in_frame"]));
                    assert!(
                        gap.distance_m < 1e-6 && gap.angle_rad < 1e-4,
                        "{name} {k} {gap:?}"
                    );
                }
                Value::Pose(_) => {}
            }
        }
    }
}
