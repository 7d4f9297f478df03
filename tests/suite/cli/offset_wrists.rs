//! Straight moves of arms with an offset wrist end in the posture to which the path leads.

use super::robots::{profile, reported};
use crate::support::scratch;
use poseshift::geometry::{Pose, Quaternion, Rotation, add, norm, scale, sub};
use poseshift::inverse::Arm;
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};

/// A straight move of an arm of the catalogue: with which tool, from where, and its two ends.
struct Case {
    robot: &'static str,
    tool: [f64; 6],
    effects: &'static str,
    start_deg: [f64; 6],
    ends: [[f64; 7]; 2],
}

/// Far from the singularities of the arms: 7.4 and 19 are the smallest singular values of the Jacobian
/// (mm/rad, rotations at 300 mm) on these paths. Each leads to another of the answers at its
/// end than to the one with the least turns from where it begins.
const CASES: [Case; 2] = [
    Case {
        robot: "fanuc_crx10ia_l",
        tool: [0.0, 0.0, 100.0, 0.0, 0.0, 0.0],
        effects: "{effect: base_frame, x_mm: -0.11, y_mm: -0.273, z_mm: 0.077}, {effect: link_geometry, \
            link: 4, a_mm: 0.155, d_mm: 0.184}, {effect: link_geometry, link: 5, theta_deg: -0.056, d_mm: \
            -0.095}",
        start_deg: [-36.08, -48.55, -11.82, 107.07, 61.82, -32.39],
        ends: [
            [
                261.758,
                134.823,
                1403.737,
                0.132_348_85,
                0.615_895_42,
                0.543_754_76,
                0.554_515_44,
            ],
            [
                252.775,
                131.997,
                1348.985,
                0.148_597_30,
                0.668_073_40,
                0.490_095_11,
                0.539_818_08,
            ],
        ],
    },
    Case {
        robot: "abb_crb15000_5_95",
        tool: [20.0, 0.0, 100.0, 0.0, 30.0, 0.0],
        effects: "{effect: base_frame, y_mm: 0.27, z_mm: -0.213}, {effect: link_geometry, link: 3, \
            theta_deg: 0.035, d_mm: -0.079}, {effect: link_geometry, link: 4, theta_deg: -0.036}, {effect: \
            link_geometry, link: 5, theta_deg: 0.058, d_mm: 0.185}",
        start_deg: [-5.6436, -75.5551, 14.5364, 60.5949, 8.925, -31.2096],
        ends: [
            [
                -205.089,
                -11.940,
                1025.424,
                0.824_204_51,
                -0.032_360_50,
                0.524_098_14,
                0.212_039_77,
            ],
            [
                -117.315,
                -1.530,
                1190.964,
                0.892_079_73,
                0.084_187_69,
                0.427_914_14,
                0.118_303_35,
            ],
        ],
    },
];

fn pose([x, y, z, quaternion @ ..]: [f64; 7]) -> Pose {
    let translation = [x, y, z].map(|mm| mm / 1000.0);
    Pose::from_parts(translation, Quaternion(quaternion).normalized())
}

/// The joints at the end of a straight path, gone along in 4 000 steps.
fn walked(arm: &Arm, from: &Pose, to: &Pose, start: [f64; 6]) -> [f64; 6] {
    let turned = (from.rotation.transpose() * to.rotation).vector();
    let along = sub(to.translation, from.translation);
    let mut q = start;
    for step in 0..=4000 {
        let part = f64::from(step) / 4000.0;
        let on_path = Pose {
            translation: add(from.translation, scale(part, along)),
            rotation: from.rotation * Rotation::from_vector(scale(part, turned)),
        };
        let next = arm.solve_near(&on_path, &q);
        let most = (0..6).map(|i| (next.q[i] - q[i]).abs());
        let most = most.fold(0.0, f64::max);
        // where it begins it stands at the corrected pose
        let allowed = if step == 0 { 0.05 } else { 0.02 };
        assert!(next.beyond == 0.0 && most < allowed, "{part}: {most} rad");
        q = next.q;
    }
    q
}

fn landed(case: &Case, profile: &Profile, ends: [Pose; 2]) -> Pose {
    let tool = &profile.tools["t"];
    let mounted = Mounted {
        name: "t".into(),
        flange_from_tool: tool.flange_from_tool,
        load: tool.load,
    };
    let arm = Arm::of(&profile.geometry(&mounted), &profile.mechanism).expect("an arm");
    let q = walked(
        &arm,
        &ends[0],
        &ends[1],
        case.start_deg.map(f64::to_radians),
    );
    let conditions = Conditions::default();
    profile
        .real_model(&mounted, &conditions)
        .forward(&q, &conditions)
}

#[test]
fn a_straight_move_lands_in_the_posture_to_which_its_path_leads() {
    for case in &CASES {
        let folder = scratch();
        let new = ["profile", "new", "--robot", case.robot, "-o", "p.yaml"];
        let (status, _, error) = reported(folder.path(), &new);
        assert_eq!(status, Some(0), "{error}");
        let file = folder.path().join("p.yaml");
        let text = std::fs::read_to_string(&file).expect("a profile");
        let [x, y, z, rx, ry, rz] = case.tool;
        // targets are given from the arm's own base
        let text = text
            .replace("z_mm: -995", "z_mm: 0")
            .replace("effects: []", &format!("effects: [{}]", case.effects))
            .replace(
                "tools: {}",
                &format!(
                    "tools: {{t: {{frame: {{x_mm: {x}, y_mm: {y}, z_mm: {z}, rx_deg: {rx}, ry_deg: {ry}, rz_deg: \
                     {rz}}}}}}}"
                ),
            );
        std::fs::write(&file, text).expect("scratch");
        let profile = profile(&file);
        let rows = case.ends.iter().zip(1..).map(|(end, number)| {
            let numbers = end.map(|n| format!("{n:.8}")).join(",");
            format!("p{number},{numbers},t\n")
        });
        let header = "id,x_mm,y_mm,z_mm,qw,qx,qy,qz,tool\n";
        let program = header.to_owned() + &rows.collect::<String>();
        std::fs::write(folder.path().join("a.csv"), program).expect("scratch");
        let start = case.start_deg.map(|deg| deg.to_string()).join(",");
        let start = format!("--start-joints={start}");
        let command = [
            "compensate",
            "a.csv",
            "--profile",
            "p.yaml",
            "--language",
            "csv",
            "--decimals",
            "6",
            &start,
            "-o",
            "b.csv",
        ];
        let (status, out, error) = reported(folder.path(), &command);
        assert_eq!(status, Some(0), "{out}{error}");
        let written = std::fs::read_to_string(folder.path().join("b.csv")).expect("written");
        let rows = written.lines().filter(|line| line.starts_with('p'));
        let fakes: Vec<Pose> = rows
            .map(|row| {
                let numbers = row.split(',').skip(1).take(7);
                let numbers: Vec<f64> = numbers.map(|n| n.parse().expect("a number")).collect();
                pose(numbers.try_into().expect("seven"))
            })
            .collect();
        let wanted = pose(case.ends[1]);
        let fakes: [Pose; 2] = fakes.try_into().expect("two rows");
        let missed = norm(sub(
            landed(case, &profile, fakes).translation,
            wanted.translation,
        ));
        assert!(missed < 5e-6, "{}: {missed} m\n{out}{error}", case.robot);
        let uncorrected = landed(case, &profile, case.ends.map(pose));
        let before = norm(sub(uncorrected.translation, wanted.translation));
        assert!(before > 1e-4, "{before} m");
    }
}
