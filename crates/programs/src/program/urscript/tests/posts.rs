//! Outputs of post-processors, compared with the trajectory they were made from.
//!
//! The outputs have no frame of their own: poses are in the base, so the work frame's pose is the
//! truth's frame times its pose. They are of one robot that is no UR; only targets and tools are
//! compared. The post that writes joints leaves the arcs out: it has 52 of the 60 points.

use super::*;

fn posts() -> Option<std::path::PathBuf> {
    let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("../shared/data/programs");
    if folder.exists() {
        return Some(folder);
    }
    eprintln!("{} does not exist: nothing compared", folder.display());
    None
}

fn pose(value: &serde_json::Value) -> Pose {
    let at = |i: usize, j: usize| value[i][j].as_f64().expect("a number");
    Pose {
        rotation: crate::geometry::Rotation(std::array::from_fn(|i| {
            std::array::from_fn(|j| at(i, j))
        })),
        translation: std::array::from_fn(|i| at(i, 3) / 1000.0),
    }
}

#[test]
fn outputs_of_post_processors_have_the_known_targets_and_tool() {
    let Some(folder) = posts() else { return };
    let text = std::fs::read_to_string(folder.join("truth.json")).expect("the truth");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    for name in [
        "Universal_Robots__PGA.script",
        "Universal_Robots_3D_Printing__PGA.script",
        "Universal_Robots_joints__PGA.script",
    ] {
        let bytes = std::fs::read(folder.join("urscript").join(name)).expect("a program");
        let source = Source::new(name, bytes.clone());
        assert!(UrScript.recognises(&source), "{name}");
        let program = read_sources(&[source]).expect("a program");
        assert_eq!(program.findings, [], "{name}");
        assert_eq!(Edits::default().apply(&bytes), bytes);
        let tool = &program.tools[program.moves[1].tool];
        if let Some(found) = tool.flange_from_tool {
            let gap = found.separation(&pose(&truth["tool"]));
            assert!(
                gap.distance_m < 1e-9 && gap.angle_rad < 1e-6,
                "{name} {gap:?}"
            );
        }
        let (mut poses, mut joints) = (0, 0);
        let points = truth["progs"]["PGA"].as_array().expect("a list");
        let near = |found: &[f64; 6], point: &serde_json::Value| {
            (0..6).all(|i| {
                let known = point["joints_deg"][i].as_f64().expect("an angle");
                (found[i] - known.to_radians()).abs() < 1e-6
            })
        };
        let mut k = 0;
        for used in &program.moves {
            let target = &program.targets[used.target.unwrap()];
            let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
            match UrScript
                .decode(target.layout, &numbers, &Settings::default())
                .value
            {
                Value::Joints(found) => {
                    let further = points[k..].iter().position(|point| near(&found, point));
                    k += further.unwrap_or_else(|| panic!("{name} {found:?}"));
                    joints += 1;
                }
                Value::Pose(found) => {
                    let wanted = pose(&truth["frame"]) * pose(&points[k]["pose_in_frame"]);
                    let gap = found.separation(&wanted);
                    assert!(
                        gap.distance_m < 1e-6 && gap.angle_rad < 2e-6,
                        "{name} {k} {gap:?}"
                    );
                    poses += 1;
                }
            }
            k += 1;
        }
        assert_eq!(k, 60, "{name}");
        assert_eq!(poses + joints, program.moves.len());
        eprintln!("{name}: {poses} poses, {joints} joints");
    }
}
