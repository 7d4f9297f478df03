//! Profiles from URDFs: any chain of six rotating joints, and what is refused.

use super::part;
use crate::support::{poseshift, scratch};
use poseshift::inverse::Arm;
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use poseshift::urdf::{About, Choice, UrdfArm, UrdfError, profile_text};

/// A URDF with six joints of these origins (xyz, rpy) and axes, a flange behind, and some more.
fn urdf(joints: &[([f64; 6], [f64; 3])], more: &str) -> String {
    let mut text = String::from("<robot name=\"r\"><link name=\"l0\"/>");
    for (i, (o, a)) in joints.iter().enumerate() {
        text += &format!(
            "<link name=\"l{0}\"><inertial><origin xyz=\"0.1 0 0\"/><mass value=\"{0}\"/><inertia \
             ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>\
             <collision><origin xyz=\"0 0 0.05\" rpy=\"0 0.3 0\"/><geometry><cylinder \
                 radius=\"0.04\" length=\"0.1\"/></geometry></collision></link>\
             <joint name=\"j{0}\" type=\"revolute\"><parent link=\"l{i}\"/><child link=\"l{0}\"/>\
             <origin xyz=\"{1} {2} {3}\" rpy=\"{4} {5} {6}\"/><axis xyz=\"{7} {8} {9}\"/><limit \
                 lower=\"-2.5\" upper=\"2\" effort=\"1\" velocity=\"3\"/></joint>",
            i + 1,
            o[0],
            o[1],
            o[2],
            o[3],
            o[4],
            o[5],
            a[0],
            a[1],
            a[2]
        );
    }
    text += &format!(
        "<link name=\"tool0\"/><joint name=\"f\" type=\"fixed\"><parent link=\"l{}\"/><child \
         link=\"tool0\"/><origin xyz=\"0.1 0.02 0\" rpy=\"0.1 0.2 0.3\"/></joint>{more}</robot>",
        joints.len()
    );
    text
}

fn choice() -> Choice {
    Choice {
        shapes: true,
        ..Choice::default()
    }
}

fn convert(text: &str) -> Result<(UrdfArm, Profile), UrdfError> {
    let arm = UrdfArm::read(text, &choice())?;
    let (yaml, _) = profile_text(&arm, &About::of("r.urdf", &|_| None))?;
    Ok((
        arm,
        Profile::from_yaml(&yaml).expect("its text is a profile"),
    ))
}

fn usual() -> Vec<([f64; 6], [f64; 3])> {
    let h = std::f64::consts::FRAC_PI_2;
    vec![
        ([0.0, 0.0, 0.3, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ([0.1, 0.0, 0.2, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ([0.0, 0.0, 0.5, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ([0.0, 0.0, 0.1, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.4, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ([0.1, 0.0, 0.0, h, 0.0, 0.0], [1.0, 0.0, 0.0]),
    ]
}

#[test]
fn chains_of_any_six_axes_move_like_their_urdf() {
    let mut state = 5;
    let mut seen = 0;
    for kind in 0..60 {
        let joints: Vec<_> = (0..6)
            .map(|i| {
                let mut number = |size: f64| size * (2.0 * part(&mut state) - 1.0);
                if kind % 3 == 0 {
                    // axes along the frames' axes, parallel and meeting ones among them
                    let (mut o, mut a) = usual()[i];
                    o[i % 3] += number(0.2);
                    a[i % 3] *= if number(1.0) > 0.0 { 2.0 } else { -1.0 };
                    if a == [0.0; 3] || kind % 2 == 0 {
                        a = usual()[i].1;
                    }
                    (o, a)
                } else {
                    (
                        std::array::from_fn(|k| number(if k < 3 { 0.5 } else { 3.0 })),
                        [number(1.0), number(1.0), number(1.0)],
                    )
                }
            })
            .collect();
        let (arm, profile) = convert(&urdf(&joints, "")).expect("a chain");
        let model = profile.controller_model(&Mounted::flange());
        for _ in 0..100 {
            let q = std::array::from_fn(|_| -2.5 + 4.5 * part(&mut state));
            let gap = model
                .forward(&q, &Conditions::default())
                .separation(&arm.forward(&q));
            assert!(gap.distance_m <= 1e-9 && gap.angle_rad <= 1e-9, "{gap:?}");
        }
        // a mass and a shape stay where they are on their link: seen from the tip at zero
        assert_eq!((profile.bodies.len(), profile.shapes.len()), (6, 6));
        seen += 1;
    }
    assert_eq!(seen, 60);
    // a macro in a comment is none
    let text = urdf(&usual(), "<!-- <xacro:macro name=\"m\"/> -->");
    assert!(convert(&text).is_ok());
}

#[test]
fn a_right_angle_written_with_three_decimals_is_one_and_said_so() {
    let mut joints = usual();
    joints[5].0[3] = 1.571;
    let (arm, profile) = convert(&urdf(&joints, "")).expect("a chain");
    assert!(
        arm.notes.iter().any(|note| note.contains("2.0e-4 rad")),
        "{:?}",
        arm.notes
    );
    let kind = |profile: &Profile| {
        let geometry = profile.geometry(&Mounted::flange());
        Arm::of(&geometry, &profile.mechanism).map(|arm| arm.kind())
    };
    let (_, exact) = convert(&urdf(&usual(), "")).expect("a chain");
    assert_eq!(kind(&profile), Ok("spherical wrist"));
    assert_eq!(kind(&profile), kind(&exact));
    // half a degree is meant
    joints[5].0[3] = 1.58;
    let (arm, _) = convert(&urdf(&joints, "")).expect("a chain");
    assert!(
        arm.notes
            .iter()
            .all(|note| !note.contains("multiple of 45"))
    );
}

#[test]
fn the_urdf_that_ros_would_compute_is_the_one_that_is_read() {
    // by hand: roll about x, then pitch about y, then yaw about z, all fixed axes
    let (arm, _) = convert(&urdf(&usual(), "")).expect("a chain");
    let q = [std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0, 0.0, 0.0];
    let pose = arm.forward(&q);
    // at zero the flange is at x 0.1 + 0.4 + 0.1 + 0.1, y 0 (0.02 turned up by the last frame), z
    // 1.1 + 0.02
    let expected = [0.0, 0.7, 1.12];
    for (a, b) in pose.translation.iter().zip(expected) {
        assert!((a - b).abs() < 1e-12, "{pose:?}");
    }
}

#[test]
fn what_is_no_chain_of_six_turning_joints_is_refused_by_name() {
    let text = urdf(&usual(), "");
    let error = |text: &str| convert(text).expect_err("refused").to_string();
    let cases = [
        (
            text.replace(
                "name=\"j3\" type=\"revolute\"",
                "name=\"j3\" type=\"prismatic\"",
            ),
            "`j3` is \
            prismatic",
        ),
        (urdf(&usual()[..5], ""), "5 axes"),
        (
            urdf(
                &usual(),
                "<link name=\"x\"/><joint name=\"j7\" type=\"revolute\"><parent \
                link=\"tool0\"/><child link=\"x\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" \
                upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>",
            )
            .replace("tool0", "t"),
            "7 axes",
        ),
        (
            urdf(
                &usual(),
                "<joint name=\"back\" type=\"fixed\"><parent link=\"tool0\"/><child \
                link=\"l2\"/></joint>",
            ),
            "two parents",
        ),
        (
            text.replace("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>"),
            "the axis",
        ),
        (text.replace("upper=\"2\"", "upper=\"-2.5\""), "the range"),
        (
            text.replace("<child link=\"l4\"/>", "<child link=\"nowhere\"/>"),
            "no link `nowhere`",
        ),
        (
            text.replace(
                "<robot name=\"r\">",
                "<robot xmlns:xacro=\"http://ros.org\" \
            name=\"r\"><xacro:macro name=\"m\"/>",
            ),
            "xacro",
        ),
        (
            text.replace("xyz=\"0.1 0 0.2\"", "xyz=\"nan 0 0.2\""),
            "NaN",
        ),
        ("<html/>".into(), ""),
        (text.replace("</robot>", ""), ""),
    ];
    for (text, says) in cases {
        let reported = error(&text);
        assert!(reported.contains(says), "{says}: {reported}");
    }
}

#[test]
fn the_command_writes_a_profile_and_says_what_the_inverse_supports() {
    let folder = scratch();
    let (file, out) = (folder.path().join("r.urdf"), folder.path().join("r.yaml"));
    std::fs::write(&file, urdf(&usual(), "")).expect("scratch");
    let command = || {
        let mut command = poseshift();
        command.args(["profile", "from-urdf"]).arg(&file);
        command
    };
    let output = command().arg("-o").arg(&out).output().expect("it starts");
    let reported = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success() && reported.contains("spherical wrist"),
        "{reported} {output:?}"
    );
    Profile::from_yaml(&std::fs::read_to_string(&out).expect("written")).expect("a profile");
    let with_mesh = urdf(&usual(), "").replace(
        "<cylinder radius=\"0.04\" length=\"0.1\"/>",
        "<mesh filename=\"package://arm/link.stl\"/>",
    );
    std::fs::write(&file, with_mesh).expect("scratch");
    let output = command().output().expect("it starts");
    let reported = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        reported.contains("package://arm/link.stl") && reported.contains("--package-path"),
        "{reported}"
    );
    assert!(
        command()
            .arg("--no-shapes")
            .output()
            .expect("it starts")
            .status
            .success()
    );
    std::fs::create_dir(folder.path().join("arm")).expect("scratch");
    std::fs::write(folder.path().join("arm/link.stl"), "solid x\nendsolid x\n").expect("scratch");
    let output = command()
        .arg("--package-path")
        .arg(folder.path())
        .output()
        .expect("it starts");
    assert!(
        String::from_utf8_lossy(&output.stdout).contains("link.stl"),
        "{output:?}"
    );
}
