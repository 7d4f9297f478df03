//! Programs written by independent post-processors from known joints: the command reads those joints back, and with a
//! profile without effects writes every byte back.
//!
//! The files lie beside the repository (`../shared/data/programs`); without them the tests say that they are skipped.

use super::unmarked;
use crate::support::{poseshift, repository, scratch};
use serde_json::Value;
use std::path::PathBuf;

/// What the posts' decimals are worth in a joint near the wrist's and the elbow's singularities, degrees.
const JOINT_TOLERANCE_DEG: f64 = 0.01;

/// A post's output.
struct Post {
    /// Below the folder of the posts; one program each.
    files: &'static [&'static str],
    /// More words of the command line.
    options: &'static [&'static str],
    /// Points of the path in the order of the targets in the files.
    points: fn() -> Vec<usize>,
    /// Points that the post writes wrongly, and why.
    wrong: (&'static [usize], &'static str),
}

fn in_order() -> Vec<usize> {
    (0..60).collect()
}

const POSTS: &[Post] = &[
    Post {
        files: &["rapid/ABB_RAPID_IRC5__PGA.mod"],
        options: &[],
        points: in_order,
        wrong: (&[], ""),
    },
    Post {
        files: &["rapid/ABB_RAPID_IRC5_clad__PGA.mod"],
        options: &[
            "--tool",
            "t_StationaryLaserFineCone=120.5,-3.25,210.125,0,30,0",
            "--frame",
            "wobj_RobotPositioner=900,-250,350,0,0,15",
        ],
        points: in_order,
        wrong: (
            &[5, 6, 22, 23, 39, 40, 56, 57],
            "arcs are written with tool0 and wobj0 by mistake",
        ),
    },
    Post {
        files: &["rapid/ABB_RAPID_S4C__PGA.prg"],
        options: &[],
        points: in_order,
        wrong: (
            &[5, 6, 22, 23, 39, 40, 56, 57],
            "lines are in the base frame, arcs by mistake in the work frame",
        ),
    },
];

fn folder() -> Option<PathBuf> {
    let folder = repository("../shared/data/programs");
    if !folder.is_dir() {
        eprintln!("skipped: no {}", folder.display());
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
        let files: Vec<_> = post.files.iter().map(|file| folder.join(file)).collect();
        let mut command = poseshift();
        command
            .arg("compensate")
            .args(&files)
            .arg("-o")
            .arg(scratch.path().join("out"));
        command
            .arg("--profile")
            .arg(repository("tests/data/posts/generic.profile.yaml"));
        if files.len() > 1 {
            std::fs::create_dir(scratch.path().join("out")).expect("scratch");
        }
        let output = command
            .args(post.options)
            .arg("--json")
            .output()
            .expect("the program starts");
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{:?}: {told}", post.files);
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let targets = report["targets"].as_array().expect("a list");
        let points = (post.points)();
        assert_eq!(targets.len(), points.len(), "{:?}", post.files);
        let mut wrong = Vec::new();
        for (target, &point) in targets.iter().zip(&points) {
            let joints = joints(&target["joints_deg"])
                .or_else(|| joints(&target["wanted_joints_deg"]))
                .expect("a pose's joints or a joint target's");
            let beside = (0..6)
                .map(|i| (joints[i] - truth[point][i]).abs())
                .fold(0.0, f64::max);
            if beside > JOINT_TOLERANCE_DEG {
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
            assert_eq!(
                unmarked(&written),
                std::fs::read(file).expect("a post"),
                "{}",
                file.display()
            );
        }
    }
}
