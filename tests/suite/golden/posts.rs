//! Programs written by independent post-processors from known joints: the command reads those
//! joints back, and with a profile without effects writes every byte back.
//!
//! The files lie next to the repository (`../shared/data/programs`); without them the tests say
//! that they are skipped.

use super::unmarked;
use crate::support::{poseshift, report, repository, scratch, skipped, text};
use serde_json::Value;
use std::path::PathBuf;

/// A post's output.
struct Post {
    /// Below the folder of the posts; they belong together.
    files: &'static [&'static str],
    /// More words of the command line.
    options: &'static [&'static str],
    /// A replacement in the profile's text.
    profile: (&'static str, &'static str),
    /// Sense of the profile's joint 5.
    joint_5: f64,
    /// What the post's decimals are worth in a joint, 0.4 deg from the wrist's singularity,
    /// degrees.
    tolerance_deg: f64,
    /// Points of the path in the order of the targets in the files.
    points: fn() -> Vec<usize>,
    /// Points that the post does not write as they were, and why.
    wrong: (&'static [usize], &'static str),
}

const PLAIN: Post = Post {
    files: &[],
    options: &[],
    profile: ("", ""),
    joint_5: 1.0,
    tolerance_deg: 0.02,
    points: in_order,
    wrong: (&[], ""),
};

/// The trajectory counts joint 5 from the other side than FANUC does.
const FANUC: Post = Post {
    options: &[
        "--tool",
        "120.5,-3.25,210.125,0,30,0",
        "--frame",
        "900,-250,350,0,0,15",
    ],
    profile: (
        "min_deg: -130, max_deg: 130",
        "min_deg: -130, max_deg: 130, sign: -1",
    ),
    joint_5: -1.0,
    // joint points stay as the trajectory has them
    wrong: (&[0, 50], "the post does not turn joint 5 of joint points"),
    ..PLAIN
};

fn in_order() -> Vec<usize> {
    (0..60).collect()
}

/// The last points of arcs and the points between them.
const ARCS: [usize; 8] = [5, 6, 22, 23, 39, 40, 56, 57];
/// The points between: most controllers pass them in the rotation that goes from the beginning of
/// the arc to its end, which is a few degrees from the one that is written.
const MIDDLES: [usize; 4] = [5, 22, 39, 56];
const PASSED_DEG: f64 = 8.0;

const POSTS: &[Post] = &[
    Post {
        files: &["rapid/ABB_RAPID_IRC5__PGA.mod"],
        ..PLAIN
    },
    Post {
        files: &["rapid/ABB_RAPID_IRC5_clad__PGA.mod"],
        options: &[
            "--tool",
            "t_StationaryLaserFineCone=120.5,-3.25,210.125,0,30,0",
            "--frame",
            "wobj_RobotPositioner=900,-250,350,0,0,15",
        ],
        wrong: (&ARCS, "arcs are written with tool0 and wobj0 by mistake"),
        ..PLAIN
    },
    Post {
        files: &["rapid/ABB_RAPID_S4C__PGA.prg"],
        wrong: (
            &ARCS,
            "lines are in the base frame, arcs by mistake in the work frame",
        ),
        ..PLAIN
    },
    Post {
        files: &["krl/KUKA_KRC2__PGA.src"],
        ..PLAIN
    },
    Post {
        files: &["krl/KUKA_KRC4__PGA.src"],
        ..PLAIN
    },
    Post {
        files: &["krl/KUKA_KRC4_Config__PGA.src"],
        ..PLAIN
    },
    Post {
        files: &["krl/KUKA_KRC4_DAT__PGA.src", "krl/KUKA_KRC4_DAT__PGA.dat"],
        // arcs stand in the .src, the others in the .dat
        points: || {
            let others = (0..60).filter(|point| !ARCS.contains(point));
            ARCS.into_iter().chain(others).collect()
        },
        ..PLAIN
    },
    Post {
        files: &["fanuc/Fanuc_R30iA__PGA.LS"],
        ..FANUC
    },
    Post {
        files: &["fanuc/Fanuc_RJ3__PGA.LS"],
        ..FANUC
    },
    Post {
        files: &["urscript/Universal_Robots__PGA.script"],
        ..PLAIN
    },
    Post {
        files: &["urscript/Universal_Robots_3D_Printing__PGA.script"],
        ..PLAIN
    },
    Post {
        files: &["urscript/Universal_Robots_joints__PGA.script"],
        // the points between the ends of arcs are poses
        points: || {
            (0..60)
                .filter(|point| ![5, 22, 39, 56].contains(point))
                .collect()
        },
        ..PLAIN
    },
    Post {
        files: &["inform/Motoman__PGA.JBI"],
        options: &["--tool", "120.5,-3.25,210.125,0,30,0"],
        // two decimals of a degree
        tolerance_deg: 0.15,
        // the post writes pulses as whole degrees
        profile: (
            "controller: {model: nominal}",
            "controller: {model: nominal, pulses_per_deg: [1, 1, 1, 1, 1, 1]}",
        ),
        // arcs begin with the point before once more
        points: || {
            let twice = |point| 1 + usize::from([4, 21, 38, 55].contains(&point));
            (0..60)
                .flat_map(|point| vec![point; twice(point)])
                .collect()
        },
        wrong: (&[0, 50], "pulses are written as whole degrees"),
        ..PLAIN
    },
];

fn folder() -> Option<PathBuf> {
    let folder = repository("../shared/data/programs");
    if !folder.is_dir() {
        skipped(&format!("{} is not there", folder.display()));
        return None;
    }
    Some(folder)
}

fn truth(folder: &std::path::Path) -> Vec<[f64; 6]> {
    let text = std::fs::read_to_string(folder.join("truth.json")).expect("the posts' joints");
    let truth: Value = serde_json::from_str(&text).expect("JSON");
    let points = truth["progs"]["PGA"].as_array().expect("a list of points");
    points
        .iter()
        .map(|point| joints(&point["joints_deg"]).expect("joints"))
        .collect()
}

fn joints(value: &Value) -> Option<[f64; 6]> {
    let list = value.as_array()?;
    Some(std::array::from_fn(|i| list[i].as_f64().expect("an angle")))
}

#[test]
fn joints_that_were_meant_are_found_again() {
    let Some(folder) = folder() else { return };
    let truth = truth(&folder);
    assert_eq!(truth.len(), 60);
    for post in POSTS {
        let scratch = scratch();
        let profile = scratch.path().join("profile.yaml");
        let text = text("tests/data/posts/generic.profile.yaml");
        let (old, new) = post.profile;
        assert!(text.contains(old));
        std::fs::write(
            &profile,
            text.replacen(old, new, usize::from(!old.is_empty())),
        )
        .expect("scratch");
        let files: Vec<_> = post.files.iter().map(|file| folder.join(file)).collect();
        let mut command = poseshift();
        command
            .arg("compensate")
            .args(&files)
            .arg("-o")
            .arg(scratch.path().join("out"));
        command.arg("--profile").arg(&profile);
        if files.len() > 1 {
            std::fs::create_dir(scratch.path().join("out")).expect("scratch");
        }
        let report = report(command.args(post.options).arg("--json"));
        let targets = report["targets"].as_array().expect("a list");
        let points = (post.points)();
        assert_eq!(targets.len(), points.len(), "{:?}", post.files);
        let mut wrong = Vec::new();
        for (target, &point) in targets.iter().zip(&points) {
            let joints = joints(&target["joints_deg"])
                .or_else(|| joints(&target["wanted_joints_deg"]))
                .expect("a pose's joints or a joint target's");
            let given = (0..6)
                .map(|i| {
                    let sense = if i == 4 { post.joint_5 } else { 1.0 };
                    (joints[i] - sense * truth[point][i]).abs()
                })
                .fold(0.0, f64::max);
            let takes_up = ["fanuc", "inform"]
                .iter()
                .any(|id| post.files[0].starts_with(id));
            let is_passed = MIDDLES.contains(&point) && !takes_up;
            let tolerance = if is_passed {
                PASSED_DEG
            } else {
                post.tolerance_deg
            };
            if given > tolerance {
                wrong.push(point);
            }
        }
        assert_eq!(wrong, post.wrong.0, "{:?}: {}", post.files, post.wrong.1);
        for file in &files {
            let out = scratch.path().join("out");
            let out = if files.len() > 1 {
                out.join(file.file_name().expect("a file"))
            } else {
                out
            };
            let written = std::fs::read(out).expect("written");
            let before = std::fs::read(file).expect("a post");
            assert!(
                unmarked(&written, &before, file) == before,
                "{}",
                file.display()
            );
        }
    }
}
