//! Every row of the catalogue: the chain by a plain computation from the row's own numbers, and its
//! inverse.

use crate::support::{Row, table, text};
use poseshift::geometry::{Pose, wrap};
use poseshift::inverse::Arm;
use poseshift::model::Conditions;
use poseshift::model::profile::{CatalogueArm, Mounted, Profile, SHIPPED, catalogue};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Postures an arm.
const FORWARD: usize = 20;
const INVERSE: usize = 100;
/// Rounding of numbers in mm and degrees on arms of up to four metres.
const POSITION_M: f64 = 1e-9;
const ANGLE_RAD: f64 = 1e-9;
/// An answer near a fold moves by the root of the rounding.
const SAME_RAD: f64 = 1e-5;
/// Of ten thousand postures so many may be missed: those on a fold.
const MISSED_OF_10_000: usize = 10;

type Matrix = [[f64; 4]; 4];

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// Craig's matrix of one row.
fn craig(alpha: f64, a: f64, theta: f64, d: f64) -> Matrix {
    let ((sa, ca), (st, ct)) = (alpha.sin_cos(), theta.sin_cos());
    [
        [ct, -st, 0.0, a],
        [st * ca, ct * ca, -sa, -sa * d],
        [st * sa, ct * sa, ca, ca * d],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

/// `Trans(x, y, z) Rx Ry Rz`, multiplied out by hand.
fn frame(text: &str) -> Matrix {
    let n = numbers(text);
    let [(sx, cx), (sy, cy), (sz, cz)] =
        [n[3], n[4], n[5]].map(|angle| angle.to_radians().sin_cos());
    [
        [cy * cz, -cy * sz, sy, n[0] * 1e-3],
        [
            cx * sz + sx * sy * cz,
            cx * cz - sx * sy * sz,
            -sx * cy,
            n[1] * 1e-3,
        ],
        [
            sx * sz - cx * sy * cz,
            sx * cz + cx * sy * sz,
            cx * cy,
            n[2] * 1e-3,
        ],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn numbers(text: &str) -> Vec<f64> {
    text.split(' ')
        .map(|n| n.parse().expect("a number"))
        .collect()
}

/// Where tool 0 is at the controller's joints, by the row's numbers alone.
fn forward(row: &Row, q: &[f64; 6]) -> Matrix {
    let mut u = *q;
    let coupling: Vec<&str> = row.text("coupling").split_whitespace().collect();
    if let [joint, on, ratio] = coupling[..] {
        let index = |text: &str| text.parse::<usize>().expect("a joint") - 1;
        u[index(joint)] += ratio.parse::<f64>().expect("a number") * q[index(on)];
    }
    let mut pose = frame(row.text("base"));
    for (i, u) in u.iter().enumerate() {
        let n = numbers(row.text(&format!("joint{}", i + 1)));
        let link = craig(
            n[0].to_radians(),
            n[1] * 1e-3,
            n[2].to_radians() + u,
            n[3] * 1e-3,
        );
        pose = times(&pose, &link);
    }
    times(&pose, &frame(row.text("flange")))
}

/// Largest difference of the positions, metres, and of the elements of the rotations.
fn gap(pose: &Pose, matrix: &Matrix) -> (f64, f64) {
    let mut gap = (0.0_f64, 0.0_f64);
    for i in 0..3 {
        gap.0 = gap.0.max((pose.translation[i] - matrix[i][3]).abs());
        for j in 0..3 {
            gap.1 = gap.1.max((pose.rotation.0[i][j] - matrix[i][j]).abs());
        }
    }
    gap
}

fn rows() -> Vec<(Row, CatalogueArm)> {
    let (rows, arms) = (table("robots/catalogue.csv"), catalogue());
    assert_eq!(rows.len(), arms.len());
    rows.into_iter().zip(arms).collect()
}

/// Joints of the file within its own ranges, and the controller's joints of the same posture.
fn postures(row: &Row, profile: &Profile, count: usize, seed: u64) -> Vec<[f64; 6]> {
    let mut random = StdRng::seed_from_u64(seed);
    let ranges: Vec<_> = (1..=6)
        .map(|i| {
            let n = numbers(row.text(&format!("joint{i}")));
            n[4].to_radians()..n[5].to_radians()
        })
        .collect();
    (0..count)
        .map(|_| {
            let u = std::array::from_fn(|i| random.random_range(ranges[i].clone()));
            profile.mechanism.controller(&u)
        })
        .collect()
}

#[test]
fn every_row_and_the_profile_that_is_written_of_it_move_as_its_numbers_say() {
    let rows = rows();
    let mut names = BTreeSet::new();
    for (row, arm) in &rows {
        assert_eq!(row.text("name"), arm.name);
        assert!(names.insert(arm.name.clone()), "{} twice", arm.name);
        for part in [
            &arm.manufacturer,
            &arm.model,
            &arm.repository,
            &arm.commit,
            &arm.path,
        ] {
            assert!(!part.is_empty(), "{}", arm.name);
        }
    }
    assert!(SHIPPED.iter().all(|(name, _)| !names.contains(*name)));
    assert_eq!(rows.len(), 376);
    rows.par_iter().for_each(|(row, arm)| {
        let text = arm.text();
        let written = Profile::from_yaml(&text);
        let written = written.unwrap_or_else(|error| panic!("{}: {error}\n{text}", arm.name));
        assert!(text.contains(&format!(
            "{} at {}, {}",
            arm.repository, arm.commit, arm.path
        )));
        for profile in [&arm.profile(), &written] {
            let model = profile.controller_model(&Mounted::flange());
            for q in postures(row, profile, FORWARD, 31) {
                let limits = profile.mechanism.beyond_limit(&q, 1e-9);
                assert_eq!(limits, None, "{} {q:?}", arm.name);
                let (m, turn) = gap(
                    &model.forward(&q, &Conditions::default()),
                    &forward(row, &q),
                );
                assert!(
                    m < POSITION_M && turn < ANGLE_RAD,
                    "{} {m} {turn}",
                    arm.name
                );
            }
        }
    });
}

#[test]
fn every_row_has_an_inverse_that_finds_each_posture_again() {
    let rows = rows();
    let tried: Vec<(usize, usize)> = rows
        .par_iter()
        .map(|(row, arm)| {
            let profile = arm.profile();
            let inverse = Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism);
            let inverse = inverse.unwrap_or_else(|error| panic!("{}: {error}", arm.name));
            let model = profile.controller_model(&Mounted::flange());
            let lost = postures(row, &profile, INVERSE, 32)
                .into_iter()
                .filter(|q| {
                    let wanted = model.forward(q, &Conditions::default());
                    let answers = inverse.solve_all(&wanted, q);
                    let same = |a: &[f64; 6]| (0..6).all(|i| wrap(a[i] - q[i]).abs() < SAME_RAD);
                    !answers.iter().any(|answer| same(&answer.q))
                });
            (INVERSE, lost.count())
        })
        .collect();
    let (tried, missed) = tried
        .iter()
        .fold((0, 0), |all, one| (all.0 + one.0, all.1 + one.1));
    println!("{missed} of {tried} missed");
    assert_eq!(tried, rows.len() * INVERSE);
    assert!(10_000 * missed <= MISSED_OF_10_000 * tried, "{missed}");
}

#[test]
fn fanucs_arms_stand_where_its_controllers_count_from() {
    // tool 0 at zero: the profiles were checked against each maker's controller frames
    let at_zero = |profile: &Profile| {
        let model = profile.controller_model(&Mounted::flange());
        model.forward(&[0.0; 6], &Conditions::default())
    };
    let fanuc = Profile::from_yaml(&text("robots/fanuc_r2000ic_165f.yaml")).expect("a profile");
    let (mut seen, mut racks) = (0, 0);
    for (_, arm) in rows() {
        if arm.manufacturer != "FANUC" || arm.name == "fanuc_m430ia2p" {
            continue;
        }
        let gap = at_zero(&arm.profile()).separation(&at_zero(&fanuc));
        // on a rack the forearm hangs down at zero
        let is_rack = ["100p", "100ph", "165r", "210r", "270r"];
        if is_rack
            .iter()
            .any(|kind| arm.name == format!("fanuc_r2000ic_{kind}"))
        {
            assert!(
                (gap.angle_rad.to_degrees() - 90.0).abs() < 1e-6,
                "{} {gap:?}",
                arm.name
            );
            racks += 1;
        } else {
            assert!(gap.angle_rad < 1e-9, "{} {gap:?}", arm.name);
        }
        // the world is at the height of axis 2
        let profile = arm.profile();
        let axis_2 = profile.world_from_base.translation[2]
            + profile.world_from_base.rotation.0[2][2] * profile.links[0].d_m;
        assert!(axis_2.abs() < 1e-9, "{} {axis_2}", arm.name);
        seen += 1;
    }
    assert_eq!((seen, racks), (86, 5));
}
