//! `compensate` on INFORM jobs and CSV: tools and frames of the command line, turns that a header
//! cannot follow, sniffing.

use crate::support::{poseshift, repository, scratch};
use std::process::Output;

/// Runs `compensate NAME` on a file of this text; returns what it says and the written file.
fn compensated(name: &str, text: &str, options: &[&str]) -> (Output, Option<String>) {
    let folder = scratch();
    std::fs::write(folder.path().join(name), text).expect("scratch");
    let output = poseshift()
        .current_dir(folder.path())
        .args(["compensate", name, "-o", "out", "--profile"])
        .arg(repository("programs/inform/profile.yaml"))
        .args(options)
        .output()
        .expect("the program starts");
    let written = std::fs::read_to_string(folder.path().join("out")).ok();
    (output, written)
}

fn reported(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout)
}

/// The last line of a file.
fn last(text: Option<String>) -> String {
    let text = text.expect("a written file");
    text.lines().last().expect("a line").to_owned()
}

const HEAD: &str = "x_mm,y_mm,z_mm,qw,qx,qy,qz,tool,frame\n";
const IN_WORLD: &str = "455.0000,60.0000,30.0000,0.0000000,1.0000000,0.0000000,0.0000000,1";

#[test]
fn the_frame_of_the_command_line_is_for_poses_that_name_none() {
    let (output, world) = compensated("p.csv", &format!("{HEAD}{IN_WORLD},\n"), &[]);
    assert!(output.status.success(), "{}", reported(&output));
    let moved = IN_WORLD.replace("455.0000,60.0000,30.0000", "55.0000,60.0000,10.0000");
    let frame = ["--frame", "400,0,20,0,0,0"];
    let (_, framed) = compensated("p.csv", &format!("{HEAD}{moved},\n"), &frame);
    let numbers = |line: String| -> Vec<f64> {
        line.split(',')
            .take(7)
            .map(|n| n.parse().expect("a number"))
            .collect()
    };
    let world = last(world);
    let (a, b) = (numbers(world.clone()), numbers(last(framed)));
    assert!((a[0] - b[0] - 400.0).abs() < 1e-3 && (a[2] - b[2] - 20.0).abs() < 1e-3);
    assert!((a[0] - 455.0).abs() > 1e-3);
    // a cell that says world means it
    let both = format!("{HEAD}{moved},\n{IN_WORLD},world\n");
    let (_, named) = compensated("p.csv", &both, &frame);
    assert_eq!(last(named), format!("{world}world"));
    // and where all do, the frame is for nothing
    let (output, none) = compensated("p.csv", &format!("{HEAD}{IN_WORLD},world\n"), &frame);
    assert_eq!((output.status.code(), none), (Some(2), None));
    assert!(
        reported(&output).contains("--frame without a name"),
        "{}",
        reported(&output)
    );
    let (output, none) = compensated("p.csv", &format!("{HEAD}{IN_WORLD},nest\n"), &[]);
    assert_eq!((output.status.code(), none), (Some(2), None));
    assert!(
        reported(&output).contains("--frame nest="),
        "{}",
        reported(&output)
    );
}

#[test]
fn the_tool_of_a_table_without_one_is_asked_for() {
    let text = "x_mm,y_mm,z_mm,qw,qx,qy,qz\n455,60,30,0,1,0,0\n";
    let (output, none) = compensated("p.csv", text, &[]);
    assert_eq!((output.status.code(), none), (Some(2), None));
    assert!(
        reported(&output).contains("give `--tool x,y,z"),
        "{}",
        reported(&output)
    );
    let (output, _) = compensated("p.csv", text, &["--tool", "1"]);
    assert!(output.status.success(), "{}", reported(&output));
}

/// R at 179.99 degrees; the correction takes it beyond 180.
const NEAR_TURN: &str = "430.3495,0.0121,326.0512,179.9895,20.0000,179.9947";

/// A job that goes to a pose with axis R at this angle, R and T within half a turn as RCONF says.
fn near_a_turn(pose: &str, motion: &str) -> String {
    format!(
        "/JOB\n//NAME TURN\n//POS\n///NPOS 2,0,0,0,0,0\n///TOOL 0\n///POSTYPE \
         ANGLE\n///ANGLE\nC00000=0.0,-10.0,-20.0,170.0,60.0,0.0\n\
         ///POSTYPE BASE\n///RECTAN\n///RCONF 1,0,0,0,0,0,0,0\nC00001={pose}\n//INST\n///DATE 2024/01/01 10:00\n///ATTR SC,RW\n\
         ///GROUP1 RB1\nNOP\nMOVJ C00000 VJ=5.00\n{motion} C00001\nEND\n"
    )
}

#[test]
fn a_joint_move_whose_turn_rconf_cannot_follow_is_refused() {
    let (output, none) = compensated("t.JBI", &near_a_turn(NEAR_TURN, "MOVJ"), &[]);
    assert_eq!((output.status.code(), none), (Some(1), None));
    let reported_joint = reported(&output);
    assert!(
        reported_joint.contains("configuration-kept")
            && reported_joint.contains("joint 4 of `C00001`"),
        "{reported_joint}"
    );
    let (output, some) = compensated("t.JBI", &near_a_turn(NEAR_TURN, "MOVL"), &[]);
    assert!(
        output.status.success() && some.is_some(),
        "{}",
        reported(&output)
    );
}

#[test]
fn a_job_is_known_by_its_content_and_the_report_says_so() {
    let text =
        std::fs::read_to_string(repository("programs/inform/cam/in/TRIM.JBI")).expect("a job");
    let (output, _) = compensated("trim.txt", &text, &["--frame", "430,-40,-120,0,0,20"]);
    assert!(
        reported(&output).contains("1 file(s) of Yaskawa INFORM"),
        "{}",
        reported(&output)
    );
}
