//! Outputs of post-processors, compared with the trajectory they were made from.

use super::*;
use crate::inverse::Arm;
use crate::profile::Profile;
use std::path::{Path, PathBuf};

/// Outputs of post-processors with known joints; kept next to the project.
fn posts() -> Option<PathBuf> {
    let folder =
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("../shared/data/programs");
    if folder.exists() {
        return Some(folder);
    }
    eprintln!("{} does not exist: nothing compared", folder.display());
    None
}

fn sources(folder: &Path, names: &[&str]) -> Vec<Source> {
    let read = |name: &&str| {
        let bytes = std::fs::read(folder.join("krl").join(name)).expect("a program");
        Source::new(*name, bytes)
    };
    names.iter().map(read).collect()
}

fn truth(folder: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(folder.join("truth.json")).expect("the truth");
    serde_json::from_str(&text).expect("JSON")
}

fn pose(value: &serde_json::Value) -> Pose {
    let at = |i: usize, j: usize| value[i][j].as_f64().expect("a number");
    Pose {
        rotation: Rotation(std::array::from_fn(|i| std::array::from_fn(|j| at(i, j)))),
        translation: std::array::from_fn(|i| at(i, 3) / 1000.0),
    }
}

fn joints(point: &serde_json::Value) -> [f64; 6] {
    std::array::from_fn(|i| point["joints_deg"][i].as_f64().expect("an angle") * DEG)
}

const POSTS: [&[&str]; 4] = [
    &["KUKA_KRC2__PGA.src"],
    &["KUKA_KRC4__PGA.src"],
    &["KUKA_KRC4_Config__PGA.src"],
    &["KUKA_KRC4_DAT__PGA.dat", "KUKA_KRC4_DAT__PGA.src"],
];

#[test]
fn outputs_of_post_processors_have_the_known_targets_and_frames() {
    let Some(folder) = posts() else { return };
    let truth = truth(&folder);
    for names in POSTS {
        let sources = sources(&folder, names);
        assert!(sources.iter().all(|source| Krl.recognises(source)));
        let program = crate::motion::read(&Krl, &sources, &Settings::default()).expect("a program");
        // 50 straight moves, 2 joint moves, and 4 arcs of two points
        let counts = (program.targets.len(), program.moves.len());
        assert_eq!(counts, (60, 60), "{names:?}");
        assert_eq!(program.findings, [], "{names:?}");
        for (k, used) in program.moves.iter().enumerate() {
            let numbers = values(&program, used.target.unwrap());
            let layout = program.targets[used.target.unwrap()].layout;
            let decoded = Krl.decode(layout, &numbers, &Settings::default());
            let point = &truth["progs"]["PGA"][k];
            match decoded.value {
                Value::Joints(found) => {
                    let gap = |(a, b): (&f64, f64)| (a - b).abs();
                    let most = found.iter().zip(joints(point)).map(gap).fold(0.0, f64::max);
                    assert!(most < 1e-6, "{names:?} {k} {most}");
                }
                Value::Pose(found) => {
                    // three decimals of mm and deg
                    let gap = found.separation(&pose(&point["pose_in_frame"]));
                    let near = gap.distance_m < 1e-6 && gap.angle_rad < 2e-5;
                    assert!(near, "{names:?} {k} {gap:?}");
                    let tool = program.tools[used.tool].flange_from_tool.expect("a tool");
                    let frame = program.frames[used.frame].world_from_frame.expect("a base");
                    let gap = tool.separation(&pose(&truth["tool"]));
                    assert!(gap.distance_m < 1e-9 && gap.angle_rad < 1e-9, "{names:?}");
                    let gap = frame.separation(&pose(&truth["frame"]));
                    assert!(gap.distance_m < 1e-9 && gap.angle_rad < 1e-9, "{names:?}");
                }
            }
        }
    }
}

#[test]
fn status_and_turn_of_known_joints_are_those_of_the_post() {
    let Some(folder) = posts() else { return };
    let truth = truth(&folder);
    let manifest = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let text = std::fs::read_to_string(manifest.join("tests/data/posts/generic.profile.yaml"));
    let profile = Profile::from_yaml(&text.expect("a profile")).expect("a valid profile");
    let tool = profile.tool("torch").expect("the tool");
    let arm = Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("a known arm");
    let program = crate::motion::read(&Krl, &sources(&folder, POSTS[2]), &Settings::default());
    let program = program.expect("a program");
    let mut compared = 0;
    for (k, used) in program.moves.iter().enumerate() {
        let point = &truth["progs"]["PGA"][k];
        let joints_rad = joints(point);
        let (branch, _) = arm.posture(&joints_rad);
        let posture = Posture {
            joints_rad,
            behind_axis_1: branch.behind_axis_1,
            behind_lower_arm: branch.behind_lower_arm,
        };
        let flags = [
            status::status(&posture) & 1,
            status::status(&posture) >> 1 & 1,
        ];
        let [rear, lower, flip] = [0, 1, 2].map(|i| point["RLF"][i] != 0.0);
        assert_eq!(flags, [u32::from(rear), u32::from(!lower)], "{k}");
        assert_eq!(status::status(&posture) >> 2 == 1, flip, "{k}");
        if program.targets[used.target.unwrap()].layout != CONFIGURED {
            continue;
        }
        let numbers = values(&program, used.target.unwrap());
        let found = (whole(numbers[6]), whole(numbers[7]));
        assert_eq!(
            found,
            (status::status(&posture), status::turn(&posture)),
            "{k}"
        );
        let windows = status::configuration(Some(found.0), Some(found.1));
        for (angle, window) in joints_rad.iter().zip(windows.joints) {
            let (low, high) = window.expect("a window");
            assert!((low..high).contains(angle), "{k}");
        }
        compared += 1;
    }
    // the via points of four arcs and two joint targets have neither
    assert_eq!(compared, 54);
}
