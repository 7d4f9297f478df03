//! A part that stands elsewhere than in the simulation: probed, registered, compensated, and the
//! real tool lands on it.

use super::{noisy, seeded};
use crate::support::{poseshift, repository, scratch};
use poseshift::geometry::{Pose, Quaternion, Vector, norm, sub};
use poseshift::inverse::{Arm, Branch};
use poseshift::model::Conditions;
use poseshift::model::profile::Profile;
use std::fmt::Write;
use std::path::Path;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const FRAME: [f64; 3] = [0.25, -0.1, 0.2];

fn csv(path: &Path, points: &[Vector]) {
    let mut text = String::from("id,x_mm,y_mm,z_mm\n");
    for (i, p) in points.iter().enumerate() {
        writeln!(text, "p{i},{},{},{}", p[0] * 1e3, p[1] * 1e3, p[2] * 1e3).expect("text");
    }
    std::fs::write(path, text).expect("scratch");
}

fn targets() -> Vec<Pose> {
    (0..12)
        .map(|k| {
            let k = f64::from(k);
            Pose::from_xyz_rxryrz([
                0.01 * k,
                0.1 + 0.008 * k,
                0.05 + 0.002 * k,
                std::f64::consts::PI - 0.02 * k,
                0.03 * k,
                0.1,
            ])
        })
        .collect()
}

fn program() -> String {
    let mut text = String::from(
        "MODULE Part\n  PERS tooldata \
         artifact:=[TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];\n  ",
    );
    let [x, y, z] = FRAME.map(|v| v * 1e3);
    writeln!(
        text,
        "PERS wobjdata wPart:=[FALSE,TRUE,\"\",[[{x},{y},{z}],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n  \
         PROC main()\n    MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;"
    )
    .expect("text");
    for pose in targets() {
        let t = pose.translation.map(|v| v * 1e3);
        let q = pose.rotation.quaternion().0;
        writeln!(
            text,
            "    MoveL [[{:.3},{:.3},{:.3}],[{:.8},{:.8},{:.8},{:.8}],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact\\WObj:=wPart;",
            t[0], t[1], t[2], q[0], q[1], q[2], q[3]
        )
        .expect("text");
    }
    text + "  ENDPROC\nENDMODULE\n"
}

/// Numbers of each inline target of a module: position in mm and quaternion.
fn read_back(text: &str) -> Vec<Pose> {
    text.lines()
        .filter(|line| line.contains("MoveL [["))
        .map(|line| {
            let numbers: Vec<f64> = line
                .split(['[', ']', ','])
                .filter_map(|word| word.trim().parse().ok())
                .collect();
            let t = [numbers[0], numbers[1], numbers[2]].map(|v| v / 1e3);
            let q = [numbers[3], numbers[4], numbers[5], numbers[6]];
            Pose::from_parts(t, Quaternion(q).normalized())
        })
        .collect()
}

#[test]
fn a_program_planned_in_simulation_lands_on_the_displaced_part() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name);
    let moved = Pose::from_xyz_rxryrz([0.008, -0.005, 0.004, 0.01, -0.015, 0.03]);
    let corners: Vec<Vector> = [
        [0.25, -0.1, 0.2],
        [0.45, -0.1, 0.2],
        [0.45, 0.15, 0.2],
        [0.25, 0.15, 0.2],
        [0.35, 0.0, 0.3],
        [0.3, 0.1, 0.26],
        [0.42, 0.03, 0.25],
        [0.27, -0.05, 0.24],
    ]
    .into();
    let mut random = seeded(31);
    let probed: Vec<Vector> = corners
        .iter()
        .map(|p| noisy(&mut random, moved.transform(*p), 5e-5))
        .collect();
    csv(&at("nominal.csv"), &corners);
    csv(&at("probed.csv"), &probed);
    std::fs::write(at("part.mod"), program()).expect("scratch");
    let profile = repository(PROFILE);
    let run = |arguments: &[&str]| {
        let output = poseshift()
            .current_dir(folder.path())
            .args(arguments)
            .output()
            .expect("the program starts");
        let reported = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), reported)
    };
    let (status, reported) = run(&["register", "nominal.csv", "probed.csv", "-o", "part.yaml"]);
    assert_eq!(status, Some(0), "{reported}");
    let profile_path = profile.to_str().expect("a plain path");
    let (status, reported) = run(&[
        "compensate",
        "part.mod",
        "--profile",
        profile_path,
        "--work-offset",
        "part.yaml",
        "-o",
        "out.mod",
    ]);
    assert_eq!(status, Some(0), "{reported}");
    // the controller goes to each fake target, and the real tool is somewhere else
    let profile = Profile::from_yaml(&std::fs::read_to_string(&profile).expect("a profile"))
        .expect("a profile");
    let tool = profile.tool("artifact").expect("its tool");
    let arm = Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("a spherical wrist");
    let frame = Pose::from_translation(FRAME[0], FRAME[1], FRAME[2]);
    let written = std::fs::read_to_string(at("out.mod")).expect("written");
    let fakes = read_back(&written);
    let wanted = targets();
    assert_eq!(fakes.len(), wanted.len());
    let mut worst = 0.0_f64;
    for (fake, wanted) in fakes.iter().zip(&wanted) {
        let near = [0.0, 0.2, 0.2, 0.0, 1.0, 0.0];
        let solution = arm.solve_branch(&(frame * *fake), Branch::ALL[0], &near);
        assert!(solution.beyond == 0.0);
        let landed = profile
            .real_model(&tool, &Conditions::default())
            .forward(&solution.q, &Conditions::default());
        let on_part = moved * frame * *wanted;
        worst = worst.max(norm(sub(landed.translation, on_part.translation)));
    }
    assert!(worst < 0.2e-3, "{worst}");
    // without the offset it misses the part by as much as the part was moved
    let miss = norm(sub(
        (moved * frame * wanted[0]).translation,
        (frame * wanted[0]).translation,
    ));
    assert!(miss > 5e-3);
}

#[test]
fn a_measured_work_object_must_agree_with_the_program() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("part.mod"), program()).expect("scratch");
    let frame = |x: f64| {
        format!(
            "poseshift: frame/1\npose: {{x_mm: {x}, y_mm: -100, z_mm: 200, rx_deg: 0, ry_deg: 0, \
             rz_deg: 0}}\n"
        )
    };
    std::fs::write(at("same.yaml"), frame(250.0)).expect("scratch");
    std::fs::write(at("other.yaml"), frame(251.0)).expect("scratch");
    let run = |wobj: &str, program: &str| {
        let output = poseshift()
            .current_dir(folder.path())
            .args([
                "compensate",
                program,
                "--wobj",
                wobj,
                "-o",
                "out.mod",
                "--profile",
            ])
            .arg(repository(PROFILE))
            .output()
            .expect("the program starts");
        (
            output.status.code(),
            String::from_utf8_lossy(&output.stderr).into_owned(),
        )
    };
    assert_eq!(run("wPart=same.yaml", "part.mod").0, Some(0));
    let (status, reported) = run("wPart=other.yaml", "part.mod");
    assert!(
        status == Some(2) && reported.contains("1.0000 mm") && reported.contains("--work-offset"),
        "{reported}"
    );
    let (status, reported) = run("wOther=same.yaml", "part.mod");
    assert!(
        status == Some(2) && reported.contains("wPart"),
        "{reported}"
    );
    // not declared in the files: the measured frame is what the controller is given
    let open: String = program()
        .lines()
        .filter(|l| !l.contains("wobjdata"))
        .map(|l| format!("{l}\n"))
        .collect();
    std::fs::write(at("open.mod"), open).expect("scratch");
    let (status, reported) = run("wPart=other.yaml", "open.mod");
    assert_eq!(status, Some(0), "{reported}");
}
