//! `plan`: what holds for a configuration holds where it is approached from, and what the moves
//! between meet is reported.

use crate::support::{poseshift, repository, scratch};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use serde_json::Value;
use std::path::Path;

const PROFILE: &str = "robots/abb_irb120.yaml";

fn run(folder: &Path, command: &str) -> Value {
    let output = poseshift()
        .current_dir(folder)
        .args(command.split(' '))
        .arg("--json")
        .output()
        .expect("the program starts");
    let reported = String::from_utf8_lossy(&output.stderr);
    assert!(!output.stdout.is_empty(), "{command}: {reported}");
    serde_json::from_slice(&output.stdout).expect("JSON and nothing else")
}

fn joints(plan: &Value) -> Vec<[f64; 6]> {
    let rows = plan["joints_deg"].as_array().expect("rows");
    rows.iter()
        .map(|row| std::array::from_fn(|i| row[i].as_f64().expect("a number")))
        .collect()
}

/// The tool's place in mm, at these joints in degrees.
fn tip_mm(q: &[f64; 6], less: f64) -> [f64; 3] {
    let text = std::fs::read_to_string(repository(PROFILE)).expect("a shipped profile");
    let profile = Profile::from_yaml(&text).expect("a shipped profile");
    let nothing = Conditions::default();
    let arm = profile.real_model(&Mounted::flange(), &nothing);
    let q = q.map(|angle| (angle - less).to_radians());
    arm.forward(&q, &nothing).translation.map(|x| 1e3 * x)
}

#[test]
fn boxes_hold_where_a_configuration_is_approached_from_too() {
    let folder = scratch();
    let profile = repository(PROFILE).display().to_string();
    let plan = run(
        folder.path(),
        &format!(
            "plan --profile {profile} --count 20 --candidates 300 --starts 1 --level 1 \
             --inside-mm=-600,-600,100,600,600,900 --keep-out-mm=200,-150,0,600,150,900"
        ),
    );
    let inside = |p: [f64; 3], low: [f64; 3], high: [f64; 3]| {
        (0..3).all(|k| low[k] < p[k] && p[k] < high[k])
    };
    let all = joints(&plan);
    assert_eq!(all.len(), 20);
    for q in &all {
        for less in [0.0, 5.0] {
            let p = tip_mm(q, less);
            let room = inside(p, [-600.0, -600.0, 100.0], [600.0, 600.0, 900.0]);
            assert!(room, "{q:?} less {less}: {p:?}");
            let kept = inside(p, [200.0, -150.0, 0.0], [600.0, 150.0, 900.0]);
            assert!(!kept, "{q:?} less {less}: {p:?}");
        }
    }
}

#[test]
fn moves_of_the_program_on_which_the_arm_touches_itself_are_few_and_all_reported() {
    let folder = scratch();
    let profile = repository(PROFILE).display().to_string();
    let plan = run(
        folder.path(),
        &format!(
            "plan --profile {profile} --count 30 --candidates 500 --starts 1 -o q.csv --program \
             m.mod"
        ),
    );
    let check = run(folder.path(), &format!("check m.mod --profile {profile}"));
    let lines = |report: &Value, id: &str| -> Vec<u64> {
        let findings = report["findings"].as_array().expect("findings");
        let those = findings.iter().filter(|f| f["id"] == id);
        let mut lines: Vec<u64> = those.filter_map(|f| f["line"].as_u64()).collect();
        lines.sort_unstable();
        lines
    };
    let reported = lines(&plan, "collision");
    assert_eq!(reported, lines(&check, "collision"));
    assert!(reported.is_empty(), "{reported:?} of 60 moves");
}

#[test]
fn where_walls_stand_the_program_goes_over_poses_between_and_keeps_clear_all_the_way() {
    let folder = scratch();
    let profile = repository(PROFILE).display().to_string();
    let walls = [
        ([0.12, -0.3, -0.5], [0.9, -0.2, 2.0]),
        ([0.12, 0.2, -0.5], [0.9, 0.3, 2.0]),
    ];
    let plan = run(
        folder.path(),
        &format!(
            "plan --profile {profile} --count 30 --candidates 500 --starts 1 --level 1 \
             --keep-out-mm=120,-300,-500,900,-200,2000 --keep-out-mm=120,200,-500,900,300,2000 \
             -o q.csv --program m.mod"
        ),
    );
    assert_eq!(plan["findings"], serde_json::json!([]));
    let between = plan["poses_between"].as_u64().expect("a count");
    assert!(between > 0, "the walls are in nobody's way");
    let text = std::fs::read_to_string(folder.path().join("m.mod")).expect("a program");
    let places: Vec<[f64; 6]> = text
        .lines()
        .filter_map(|line| line.trim().strip_prefix("MoveAbsJ [["))
        .map(|rest| {
            let axes = rest.split(']').next().expect("axes").split(',');
            let axes: Vec<f64> = axes.map(|q| q.parse().expect("a number")).collect();
            axes.try_into().expect("six axes")
        })
        .collect();
    assert_eq!(places.len() as u64, 60 + between);
    // at samples far closer than the walls are thick
    let text = std::fs::read_to_string(repository(PROFILE)).expect("a shipped profile");
    let profile = Profile::from_yaml(&text).expect("a shipped profile");
    let nothing = Conditions::default();
    let arm = profile.real_model(&Mounted::flange(), &nothing);
    for ends in places.windows(2) {
        for k in 0..=1000 {
            let s = f64::from(k) / 1000.0;
            let q: [f64; 6] =
                std::array::from_fn(|i| (ends[0][i] + s * (ends[1][i] - ends[0][i])).to_radians());
            let frames = arm.link_frames(&q, &nothing);
            let arm_points = frames[3..].iter().map(|frame| frame.translation);
            for p in arm_points.chain([arm.forward(&q, &nothing).translation]) {
                let hit = walls
                    .iter()
                    .any(|(low, high)| (0..3).all(|i| low[i] < p[i] && p[i] < high[i]));
                assert!(!hit, "{p:?} on the way from {:?} to {:?}", ends[0], ends[1]);
            }
        }
    }
}

#[test]
fn joints_that_turn_more_than_once_stay_in_the_turn_about_zero() {
    let folder = scratch();
    let profile = repository("robots/universal_robots_ur5.yaml")
        .display()
        .to_string();
    let plan = run(
        folder.path(),
        &format!("plan --profile {profile} --count 20 --candidates 300 --starts 1 --level 1"),
    );
    let all = joints(&plan);
    assert!(all.iter().flatten().all(|q| q.abs() <= 180.0), "{all:?}");
}

#[test]
fn simulated_measurements_arrive_as_the_program_does() {
    let folder = scratch();
    let profile = repository(PROFILE).display().to_string();
    run(
        folder.path(),
        &format!(
            "plan --profile {profile} --count 12 --candidates 200 --starts 1 --level 1 -o q.csv \
             --program m.mod"
        ),
    );
    run(
        folder.path(),
        &format!("simulate --profile {profile} --joints q.csv -o s.csv"),
    );
    let text = std::fs::read_to_string(folder.path().join("s.csv")).expect("measurements");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let dir = header
        .iter()
        .position(|name| *name == "dir1")
        .expect("directions");
    let rows: Vec<_> = lines.collect();
    assert_eq!(rows.len(), 12);
    for row in rows {
        assert_eq!(row[dir..dir + 6], ["1"; 6]);
    }
}
