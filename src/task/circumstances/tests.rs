//! Columns besides the joint angles count for every command that reads joints or poses.

use crate::identify::simulate::Session;
use crate::program::Source;
use crate::task::axes::axes;
use crate::task::fk::{Options, Which, fk};
use crate::task::handeye::{Inputs, robot_poses};
use crate::task::ik::ik;
use crate::task::simulate::simulate;
use crate::task::{Failure, ProfileFile};

const IRB120: &str = include_str!("../../../robots/abb_irb120.yaml");
const JOINTS: &str = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg";
const TRACK: &str = "\nexternal_axes: {track: [{axis: eax_a, direction: [1, 0, 0], min_mm: 0, \
    max_mm: 3000}]}\n";

fn source(name: &str, text: &str) -> Source {
    Source::new(name, text.as_bytes().to_vec())
}

/// The arm with a track, or with these effects.
fn profile(more: &str, effects: &str) -> ProfileFile {
    let at = IRB120.find("\ncalibration:").expect("a section");
    let text = format!(
        "{}{more}\ncalibration: {{effects: [{effects}]}}\n",
        &IRB120[..at]
    );
    ProfileFile::read(&source("p.yaml", &text)).expect("a profile")
}

fn poses(profile: &ProfileFile, header: &str, rows: &str, which: Which) -> String {
    let table = source("q.csv", &format!("{JOINTS}{header}\n{rows}"));
    let options = Options {
        model: which,
        tool: None,
    };
    fk(profile, &table, &options).expect("poses").csv()
}

fn refusal<T>(found: Result<T, Failure>) -> String {
    let Err(failure) = found else {
        panic!("not refused");
    };
    failure.message
}

/// The joints that `ik` finds near these, of the pose that `fk` has with the same columns.
fn back(profile: &ProfileFile, header: &str, cells: &str, which: Which) -> [f64; 6] {
    let row = format!("60,0,-10,30,40,50{cells}\n");
    let pose = poses(profile, header, &row, which);
    let pose = pose.lines().nth(1).expect("a row");
    let text = format!(
        "id,x_mm,y_mm,z_mm,qw,qx,qy,qz,near1_deg,near2_deg,near3_deg,near4_deg,near5_deg,\
         near6_deg{header}\n{pose},60,0,-10,30,40,50{cells}\n"
    );
    let options = Options {
        model: which,
        tool: None,
    };
    let found = ik(profile, &source("x.csv", &text), &options, false).expect("joints");
    assert!(found.reached);
    found.solutions[0].joints_deg
}

#[test]
fn joints_of_a_pose_on_a_track_are_those_that_went_in() {
    let on_track = profile(TRACK, "");
    let at_home = poses(&on_track, "", "60,0,-10,30,40,50\n", Which::Real);
    let away = poses(&on_track, ",e1_mm", "60,0,-10,30,40,50,100\n", Which::Real);
    assert_ne!(at_home, away);
    for which in [Which::Real, Which::Controller] {
        let q = back(&on_track, ",e1_mm", ",100", which);
        for (q, expected) in q.iter().zip([60.0, 0.0, -10.0, 30.0, 40.0, 50.0]) {
            assert!((q - expected).abs() < 1e-5, "{q} {expected}");
        }
    }
}

#[test]
fn joints_of_a_pose_count_where_they_came_from() {
    let loose = profile("", "{effect: backlash, joint: 3, width_deg: 0.2}");
    let q = back(
        &loose,
        ",dir1,dir2,dir3,dir4,dir5,dir6",
        ",1,1,1,1,1,1",
        Which::Real,
    );
    assert!((q[2] + 10.0).abs() < 1e-5, "{q:?}");
}

#[test]
fn a_track_beyond_its_limits_and_one_that_is_not_there_are_refused() {
    let table = source(
        "q.csv",
        &format!("{JOINTS},e1_mm\n60,0,-10,30,40,50,150000\n"),
    );
    let message = refusal(fk(&profile(TRACK, ""), &table, &Options::default()));
    assert!(message.contains("150000; the limits of eax_a"), "{message}");
    let message = refusal(fk(&profile("", ""), &table, &Options::default()));
    assert!(message.contains("e1_mm"), "{message}");
}

#[test]
fn a_camera_is_seen_from_the_base_at_home() {
    let on_track = profile(TRACK, "");
    let flange = |header: &str, cells: &str| {
        let text = format!("{JOINTS}{header}\n60,0,-10,30,40,50{cells}\n");
        let table = source("robot.csv", &text);
        let inputs = Inputs {
            robot: &table,
            board: &table,
            profile: Some(&on_track),
            tool: None,
            corners: None,
        };
        robot_poses(&inputs).expect("poses")[0]
    };
    let [home, away] = [flange("", ""), flange(",e1_mm", ",1000")];
    let moved = away.translation[0] - home.translation[0];
    assert!((moved - 1.0).abs() < 1e-12, "{moved}");
}

#[test]
fn the_base_of_sweeps_on_a_track_is_that_at_home() {
    let on_track = profile(TRACK, "");
    let mut rows = String::new();
    for k in -6..=6 {
        rows += &format!("{},10,10,0,30,0,1000\n", 10 * k);
    }
    for k in -6..=6 {
        rows += &format!("0,{},10,0,30,0,1000\n", 8 * k);
    }
    let seen = poses(&on_track, ",e1_mm", &rows, Which::Controller);
    let sweeps = |at: fn(usize) -> f64| {
        let both = rows.lines().zip(seen.lines().skip(1)).enumerate();
        let lines = both.map(|(k, (q, pose))| {
            let q = q.rsplit_once(',').expect("e1_mm").0;
            let place: Vec<&str> = pose.split(',').skip(1).take(3).collect();
            let sweep = if k < 13 { 1 } else { 2 };
            format!("{q},{},{sweep},{}\n", at(k), place.join(","))
        });
        let lines: String = lines.collect();
        format!("{JOINTS},e1_mm,sweep,x_mm,y_mm,z_mm\n{lines}")
    };
    let found = axes(&on_track, &source("s.csv", &sweeps(|_| 1000.0)), None).expect("a base");
    let base = found.base.expect("joints 1 and 2");
    assert!(base.x_mm.abs() < 1e-3, "{base:?}");
    let moving = sweeps(|k| if k < 13 { 1000.0 } else { 1200.0 });
    let message = refusal(axes(&on_track, &source("s.csv", &moving), None));
    assert!(message.contains("one place"), "{message}");
}

fn three(text: &str, from: usize) -> [f64; 3] {
    let row = text.lines().nth(1).expect("a row");
    let cells: Vec<&str> = row.split(',').collect();
    std::array::from_fn(|k| cells[from + k].parse().expect("a number"))
}

#[test]
fn temperature_and_id_of_a_row_are_those_of_its_measurement() {
    let warm = profile("", "{effect: thermal_growth, per_k: 2e-5, reference_c: 20}");
    let row = "10,20,-10,30,40,50";
    let place = |header: &str, cells: &str| {
        let row = format!("{row}{cells}\n");
        three(&poses(&warm, header, &row, Which::Real), 1)
    };
    let (cold, hot) = (place("", ""), place(",temperature_c", ",45"));
    assert!((cold[0] - hot[0]).abs() > 0.05, "{cold:?} {hot:?}");
    let text = format!("id,{JOINTS},temperature_c,time_s\nA7,{row},45,3\n");
    let joints = source("q.csv", &text);
    let made = simulate(&warm, &joints, None, &Session::default()).expect("measurements");
    let csv = made.csv.expect("not written");
    assert!(csv.contains("\nA7,"), "{csv}");
    let seen = three(&csv, 7);
    assert!(
        (0..3).all(|k| (seen[k] - hot[k]).abs() < 1e-9),
        "{hot:?}: {csv}"
    );
    let session = Session {
        temperature_c: Some([20.0, 30.0]),
        ..Session::default()
    };
    let message = refusal(simulate(&warm, &joints, None, &session));
    assert!(message.contains("temperature_c"), "{message}");
}
