//! Hidden truths found again, within the uncertainties that are reported.

use super::{noisy, normal, random_pose, seeded};
use poseshift::geometry::{Pose, Rotation, Vector, add, norm, scale, sub};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use poseshift::register::axes::outliers::without_outliers;
use poseshift::register::axes::{Row, Sweep, axis, base, tool};
use poseshift::register::frames::{TouchedPlane, points_and_planes};
use poseshift::register::handeye::{HandEye, Setup, refine_by_corners};
use poseshift::register::hexapod::{
    Design, Device, Lengths, legs_at, measurable, modes, near, set_base_frame, solve, spread,
};
use poseshift::register::icp::{Concern, Found, Metric, Options, icp};
use poseshift::register::kabsch::kabsch;
use poseshift::register::robust::robust;
use poseshift::register::uncertainty::PoseCovariance;
use rand::RngExt;
use rand::rngs::StdRng;

/// Squared error of a pose by its covariance: χ² with six degrees of freedom.
fn chi_squared(found: &Pose, truth: &Pose, covariance: &PoseCovariance) -> f64 {
    let turn = (found.rotation * truth.rotation.transpose()).vector();
    let back = truth.inverse();
    let centre = covariance.centre_m;
    // where the found motion puts the point that the true one puts at the centre
    let there = found.transform(back.transform(centre));
    let d = sub(there, centre);
    let error = nalgebra::Vector6::new(turn[0], turn[1], turn[2], d[0], d[1], d[2]);
    let matrix = nalgebra::Matrix6::from_fn(|i, j| covariance.matrix[i][j]);
    let solved = matrix.cholesky().expect("a covariance").solve(&error);
    error.dot(&solved)
}

/// The mean of many χ² with six degrees of freedom is 6; of 200 it strays by √(12/200) = 0.25.
fn assert_six(values: &[f64], slack: f64) {
    #[allow(clippy::cast_precision_loss)]
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    assert!((mean - 6.0).abs() < slack, "mean of chi squared {mean}");
}

#[test]
fn registration_errors_are_as_large_as_reported() {
    let mut random = seeded(11);
    let mut all = Vec::new();
    let mut far = Vec::new();
    for _ in 0..300 {
        let truth = random_pose(&mut random, 2.0);
        let from: Vec<Vector> = (0..9)
            .map(|_| std::array::from_fn(|_| random.random_range(-0.3..0.3)))
            .collect();
        let to: Vec<Vector> = from
            .iter()
            .map(|p| noisy(&mut random, truth.transform(*p), 5e-5))
            .collect();
        let fit = kabsch(&from, &to, None).expect("a good set");
        let covariance = fit.covariance(&from, None, 5e-5);
        all.push(chi_squared(&fit.to_from_from, &truth, &covariance));
        let point = [3.0, -1.0, 0.5];
        let there = fit.to_from_from.transform(point);
        let error = norm(sub(there, truth.transform(point)));
        let ellipsoid = covariance.ellipsoid(there);
        far.push(error / norm(ellipsoid.half_axes_m));
    }
    assert_six(&all, 0.6);
    #[allow(clippy::cast_precision_loss)]
    let square = far.iter().map(|f| f * f).sum::<f64>() / far.len() as f64;
    assert!((square - 1.0).abs() < 0.2, "{square}");
}

#[test]
fn bad_touches_are_found_and_named() {
    let mut random = seeded(12);
    for n in [6, 8, 40] {
        for _ in 0..20 {
            let truth = random_pose(&mut random, 2.0);
            let from: Vec<Vector> = (0..n)
                .map(|_| std::array::from_fn(|_| random.random_range(-0.3..0.3)))
                .collect();
            let mut to: Vec<Vector> = from
                .iter()
                .map(|p| noisy(&mut random, truth.transform(*p), 5e-5))
                .collect();
            let bad = random.random_range(0..n);
            to[bad] = add(to[bad], [0.0, 2e-3, -1e-3]);
            let found = robust(&from, &to, None, Some(5e-5)).expect("most agree");
            let names: Vec<usize> = found.rejected.iter().map(|b| b.index).collect();
            assert!(names.contains(&bad), "{n}: {bad} {names:?}");
            assert!(names.len() <= 2, "{names:?}");
            let gap = found.fit.to_from_from.separation(&truth);
            assert!(gap.distance_m < 1e-3, "{gap:?}");
        }
    }
}

#[test]
fn precise_points_among_rough_ones_are_not_taken_for_bad() {
    let mut random = seeded(21);
    let sigmas_m = [2e-5, 2e-5, 2e-5, 1e-4, 1e-4, 2e-4, 5e-5, 5e-5];
    let weights = sigmas_m.map(|sigma: f64| sigma.powi(-2));
    let mut left_out = 0;
    for _ in 0..200 {
        let truth = random_pose(&mut random, 2.0);
        let from: Vec<Vector> = (0..8)
            .map(|_| std::array::from_fn(|_| random.random_range(-0.3..0.3)))
            .collect();
        let to: Vec<Vector> = (from.iter().zip(sigmas_m))
            .map(|(p, sigma)| noisy(&mut random, truth.transform(*p), sigma))
            .collect();
        let found = robust(&from, &to, Some(&weights), Some(1.0)).expect("they agree");
        left_out += usize::from(!found.rejected.is_empty());
    }
    assert!(left_out <= 3, "{left_out} of 200");
}

#[test]
fn three_planes_and_two_points_with_a_probe_ball_place_a_part() {
    let mut random = seeded(13);
    let mut all = Vec::new();
    for _ in 0..100 {
        let truth = random_pose(&mut random, 1.0);
        let radius = 2e-3;
        let planes: Vec<TouchedPlane> = [[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]]
            .into_iter()
            .map(|normal: Vector| {
                let touches_m = (0..5)
                    .map(|_| {
                        let mut p: Vector = std::array::from_fn(|_| random.random_range(0.0..0.3));
                        for k in 0..3 {
                            if normal[k] != 0.0 {
                                p[k] = 0.0;
                            }
                        }
                        let ball = add(p, scale(radius, normal));
                        noisy(&mut random, truth.transform(ball), 2e-5)
                    })
                    .collect();
                TouchedPlane {
                    point_m: [0.0; 3],
                    normal,
                    touches_m,
                }
            })
            .collect();
        let points: Vec<(Vector, Vector)> = [[0.1, 0.2, -0.05], [0.25, 0.05, -0.1]]
            .into_iter()
            .map(|p| (p, noisy(&mut random, truth.transform(p), 2e-5)))
            .collect();
        let fit = points_and_planes(&points, &planes, radius, Some(2e-5)).expect("six are fixed");
        all.push(chi_squared(&fit.to_from_from, &truth, &fit.covariance));
    }
    assert_six(&all, 1.2);
}

/// A part without symmetry: a wavy plate with a step.
fn cloud(random: &mut StdRng, count: usize, pose: &Pose, sigma: f64) -> Vec<Vector> {
    (0..count)
        .map(|_| {
            let (u, v): (f64, f64) = (
                random.random_range(0.0..0.4),
                random.random_range(0.0..0.25),
            );
            let step = if u < 0.06 && v < 0.06 { 0.03 } else { 0.0 };
            let z = 0.04 * (11.0 * u).sin() * (14.0 * v).cos() + 0.1 * u + step;
            pose.transform(noisy(random, [u, v, z], sigma))
        })
        .collect()
}

const SEARCH: Options = Options {
    metric: Metric::PointToPlane,
    start: None,
    kept: 0.9,
    min_overlap: 0.6,
    sigma_m: None,
};

#[test]
fn clouds_are_laid_on_each_other_from_any_turn() {
    let mut random = seeded(14);
    for metric in [Metric::PointToPlane, Metric::PointToPoint] {
        for _ in 0..4 {
            let truth = random_pose(&mut random, 1.0);
            let from = cloud(&mut random, 6000, &Pose::identity(), 5e-5);
            let to = cloud(&mut random, 8000, &truth, 5e-5);
            let found = icp(&from, &to, None, &Options { metric, ..SEARCH }).expect("clouds");
            assert!(
                found.concerns.is_empty(),
                "{metric:?}: {:?}",
                found.concerns
            );
            let middle = [0.2, 0.12, 0.0];
            let error = norm(sub(
                found.to_from_from.transform(middle),
                truth.transform(middle),
            ));
            let limit = match metric {
                Metric::PointToPlane => 2e-5,
                // points are 4 mm apart: it creeps, and the sampling draws it
                Metric::PointToPoint => 1e-3,
            };
            assert!(error < limit, "{metric:?} {error}");
            assert!(found.overlap > 0.9, "{}", found.overlap);
            left_is_what_the_pose_leaves(&found, &from, &to, metric);
        }
    }
}

/// Places and residuals of the points that are reported, against the pose and all points.
fn left_is_what_the_pose_leaves(found: &Found, from: &[Vector], to: &[Vector], metric: Metric) {
    assert!(
        (1000..=2000).contains(&found.left.len()),
        "{}",
        found.left.len()
    );
    let mut squares = 0.0;
    for one in found.left.iter().filter(|one| one.kept) {
        let at = found.to_from_from.transform(from[one.index]);
        assert!(
            norm(sub(at, one.at_m)) < 1e-12,
            "{metric:?}: point {}",
            one.index
        );
        squares += norm(one.residual_m).powi(2);
    }
    let kept = found.left.iter().filter(|one| one.kept).count();
    assert!(
        kept * 10 >= found.left.len() * 8,
        "{kept} of {}",
        found.left.len()
    );
    let rms = (squares / kept as f64).sqrt();
    if metric == Metric::PointToPlane {
        assert!(
            (0.8..1.25).contains(&(rms / found.rms_m)),
            "{rms} is not {}",
            found.rms_m
        );
    } else {
        // the nearest of all points of TO, found one by one
        for one in found.left.iter().step_by(100) {
            let nearest = to
                .iter()
                .map(|p| norm(sub(*p, one.at_m)))
                .fold(f64::INFINITY, f64::min);
            assert!(
                (nearest - norm(one.residual_m)).abs() < 1e-12,
                "point {}",
                one.index
            );
        }
    }
}

#[test]
fn errors_of_fine_and_of_coarse_clouds_are_as_large_as_reported() {
    let mut random = seeded(24);
    // points of FROM and TO, noise: fine against the noise, and so coarse that the tangent planes
    // are off by more than it
    for (from_count, to_count, sigma) in [(4000, 5000, 5e-4), (1500, 2000, 5e-5)] {
        let mut all = Vec::new();
        for _ in 0..40 {
            let truth = random_pose(&mut random, 1.0);
            let from = cloud(&mut random, from_count, &Pose::identity(), sigma);
            let to = cloud(&mut random, to_count, &truth, sigma);
            let near = Pose::from_xyz_rxryrz([1e-3, -1e-3, 5e-4, 2e-3, 0.0, -2e-3]);
            let options = Options {
                start: Some(near * truth),
                ..SEARCH
            };
            let found = icp(&from, &to, None, &options).expect("clouds");
            assert!(found.concerns.is_empty(), "{:?}", found.concerns);
            let covariance = found.covariance.expect("no motion is free");
            all.push(chi_squared(&found.to_from_from, &truth, &covariance));
        }
        let mean = all.iter().sum::<f64>() / 40.0;
        println!("{from_count} points, {sigma} m: mean of chi squared {mean:.2}");
        // 6 is expected; a sigma that is half as large as it should be makes 24
        assert!((2.0..12.0).contains(&mean), "{from_count}: {mean}");
    }
}

#[test]
fn a_local_minimum_is_not_called_success() {
    let mut random = seeded(15);
    let from = cloud(&mut random, 3000, &Pose::identity(), 5e-5);
    let to = cloud(&mut random, 3000, &Pose::identity(), 5e-5);
    let over = Pose::from_xyz_rxryrz([0.0, 0.25, 0.03, std::f64::consts::PI, 0.0, 0.0]);
    let options = Options {
        start: Some(over),
        ..SEARCH
    };
    let found = icp(&from, &to, None, &options).expect("clouds");
    let is_local = |d: &Concern| matches!(d, Concern::Residual { .. } | Concern::Overlap { .. });
    assert!(found.concerns.iter().any(is_local), "{:?}", found.concerns);
}

#[test]
fn parts_that_slide_or_look_alike_turned_are_questioned() {
    let mut random = seeded(16);
    // a flat grid with many equal coordinates
    let grid = |shift: f64| -> Vec<Vector> {
        (0..50)
            .flat_map(|i| (0..40).map(move |j| (i, j)))
            .map(|(i, j)| [f64::from(i) * 0.01 + shift, f64::from(j) * 0.01, 0.0])
            .collect()
    };
    let found = icp(&grid(0.0), &grid(0.003), None, &SEARCH).expect("clouds");
    let slides = |d: &Concern| matches!(d, Concern::Free { .. });
    assert!(found.concerns.iter().any(slides), "{:?}", found.concerns);
    let mut brick = |pose: &Pose| -> Vec<Vector> {
        (0..6000)
            .map(|k| {
                let half = [0.2, 0.1, 0.05];
                let mut p: Vector = half.map(|h| random.random_range(-h..h));
                p[k % 3] = if k % 2 == 0 {
                    half[k % 3]
                } else {
                    -half[k % 3]
                };
                pose.transform(noisy(&mut random, p, 2e-5))
            })
            .collect()
    };
    let truth = Pose::from_xyz_rxryrz([0.5, 0.1, 0.0, 0.1, 0.2, 0.3]);
    let (from, to) = (brick(&Pose::identity()), brick(&truth));
    let found = icp(&from, &to, None, &SEARCH).expect("clouds");
    let alike = |d: &Concern| matches!(d, Concern::Ambiguous { .. });
    assert!(found.concerns.iter().any(alike), "{:?}", found.concerns);
}

#[test]
fn cameras_are_found_within_their_uncertainty() {
    let mut random = seeded(17);
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let mut all = Vec::new();
        for _ in 0..150 {
            let (camera, board) = (random_pose(&mut random, 0.3), random_pose(&mut random, 1.0));
            let (mut robot, mut seen) = (Vec::new(), Vec::new());
            for _ in 0..20 {
                let flange = random_pose(&mut random, 0.8);
                let a = match setup {
                    Setup::EyeInHand => flange,
                    Setup::EyeToHand => flange.inverse(),
                };
                let noise = Pose {
                    rotation: Rotation::from_vector(noisy(&mut random, [0.0; 3], 5e-4)),
                    translation: noisy(&mut random, [0.0; 3], 1e-4),
                };
                robot.push(flange);
                seen.push(camera.inverse() * a.inverse() * board * noise);
            }
            let problem = HandEye::new(setup, &robot, &seen).expect("a good set");
            let refined = problem.refined().expect("a solution");
            all.push(chi_squared(
                &refined.camera,
                &camera,
                &refined.camera_covariance,
            ));
            for row in &refined.rows {
                assert!(row.out_distance_m > 0.9 * row.distance_m);
            }
        }
        assert_six(&all, 1.3);
    }
}

#[test]
fn corners_are_accepted_only_where_left_out_ones_improve() {
    let mut random = seeded(18);
    let truth = random_pose(&mut random, 1.0);
    let seen: Vec<Vector> = (0..12)
        .map(|i| [0.03 * f64::from(i % 4), 0.03 * f64::from(i / 4), 0.5])
        .collect();
    let touched: Vec<Vector> = seen
        .iter()
        .map(|p| noisy(&mut random, truth.transform(*p), 3e-5))
        .collect();
    let off = Pose::from_xyz_rxryrz([1e-3, -5e-4, 8e-4, 1e-3, 0.0, -1e-3]) * truth;
    let better = refine_by_corners(&off, &seen, &touched).expect("corners");
    assert!(better.accepted && better.left_out_m < 1e-4, "{better:?}");
    let kept = refine_by_corners(&truth, &seen, &touched).expect("corners");
    assert!(!kept.accepted && kept.camera == truth, "{kept:?}");
}

fn device() -> Device {
    Device {
        base_m: [0.3, 0.3002, 0.2999],
        tool_m: [0.15, 0.1501, 0.1499],
        leg_m: 0.3,
        range_m: 1e-3,
    }
}

#[test]
fn lengths_of_all_designs_and_modes_give_their_pose_back() {
    let device = device();
    let mut random = seeded(19);
    let mut count = 0;
    for design in Design::all() {
        for mode in 1..=4 {
            let lengths = Lengths {
                base_m: device.base_m,
                tool_m: device.tool_m,
                legs_m: std::array::from_fn(|_| 0.3 + random.random_range(-1e-3..1e-3)),
            };
            let solved = solve(&lengths, &design, mode).expect("a pose");
            let legs = legs_at(device.base_m, &solved.tool_points_m, &design);
            for (a, b) in legs.iter().zip(lengths.legs_m) {
                assert!((a - b).abs() < 1e-13, "{design:?} {mode}");
            }
            let [t1, t2, t3] = solved.tool_points_m;
            for (a, b, side) in [(t1, t2, 0), (t2, t3, 1), (t3, t1, 2)] {
                assert!((norm(sub(a, b)) - device.tool_m[side]).abs() < 1e-13);
            }
            let turn = Rotation::from_vector([0.02, -0.03, 0.01]);
            let rough = Pose {
                rotation: turn * solved.pose.rotation,
                translation: add(solved.pose.translation, [0.004, 0.002, -0.003]),
            };
            assert_eq!(
                near(&lengths, &design, &rough).expect("one is near").mode,
                mode
            );
            count += 1;
        }
    }
    assert_eq!(count, 144);
    assert_eq!(measurable(&device).expect("poses").len(), 72);
}

#[test]
fn hexapod_poses_scatter_as_their_uncertainty_says() {
    let mut random = seeded(20);
    let design = Design::parse("231/312").expect("a design");
    let truth = Lengths {
        base_m: [0.3; 3],
        tool_m: [0.15; 3],
        legs_m: [0.3003, 0.2998, 0.2995, 0.3004, 0.3, 0.3001],
    };
    let exact = solve(&truth, &design, 2).expect("a pose");
    let spread = spread(&truth, &design, 2);
    let sigma = 1e-6;
    let mut all = Vec::new();
    for _ in 0..400 {
        let lengths = Lengths::from_all(truth.all().map(|l| l + sigma * normal(&mut random)));
        let found = solve(&lengths, &design, 2).expect("a pose");
        let covariance = PoseCovariance {
            centre_m: exact.pose.translation,
            matrix: spread.pose.map(|row| row.map(|v| v * sigma * sigma)),
        };
        all.push(chi_squared(&found.pose, &exact.pose, &covariance));
    }
    assert_six(&all, 0.6);
}

#[test]
fn a_wrong_ballbar_length_is_named() {
    let good = Lengths {
        base_m: [0.3; 3],
        tool_m: [0.15; 3],
        legs_m: [0.3; 6],
    };
    let design = Design::parse("123/123").expect("a design");
    let mut bad = good;
    bad.legs_m[4] = 0.93;
    let reported = modes(&bad, &design).expect_err("no pose").to_string();
    assert!(
        reported.contains("T2") && reported.contains("r22 is likely wrong"),
        "{reported}"
    );
    bad = good;
    bad.tool_m[1] = 0.5;
    let reported = modes(&bad, &design).expect_err("no pose").to_string();
    assert!(
        reported.contains("the tool is no triangle") && reported.contains("t23"),
        "{reported}"
    );
    bad = good;
    bad.legs_m[0] = -0.3;
    assert!(
        modes(&bad, &design)
            .expect_err("none")
            .to_string()
            .contains("r11")
    );
}

#[test]
fn three_taught_points_and_exact_distances_place_the_base() {
    let mut random = seeded(21);
    let base_m: [f64; 3] = [0.3, 0.3002, 0.2999];
    let x = (base_m[0].powi(2) + base_m[2].powi(2) - base_m[1].powi(2)) / (2.0 * base_m[0]);
    let y = (base_m[2].powi(2) - x * x).sqrt();
    let balls = [[0.0; 3], [base_m[0], 0.0, 0.0], [x, y, 0.0]];
    for _ in 0..50 {
        let truth = random_pose(&mut random, 1.0);
        let exact = set_base_frame(balls.map(|b| truth.transform(b)), base_m).expect("a frame");
        let gap = exact.robot_from_base.separation(&truth);
        assert!(gap.distance_m < 1e-14 && gap.angle_rad < 1e-14);
        let taught = balls.map(|b| noisy(&mut random, truth.transform(b), 3e-4));
        let found = set_base_frame(taught, base_m).expect("a frame");
        let gap = found.robot_from_base.separation(&truth);
        assert!(gap.distance_m < 2e-3 && gap.angle_rad < 6e-3, "{gap:?}");
    }
    let mut wrong = balls;
    wrong[2][0] += 0.08;
    assert!(set_base_frame(wrong, base_m).is_err());
}

#[test]
fn base_tool_and_backlash_come_out_of_sweeps() {
    let yaml = include_str!("../../../robots/abb_irb120.yaml");
    let world_from_base = Pose::from_xyz_rxryrz([2.1, -0.7, 0.4, 0.3, -0.2, 1.9]);
    let nominal = Profile::from_yaml(yaml).expect("a shipped profile");
    let backlash =
        "calibration:\n  effects:\n    - {effect: backlash, joint: 2, width_deg: 0.02}\n";
    let with_effect = format!(
        "{}\n{backlash}",
        yaml.split("\ncalibration:").next().expect("text")
    );
    let mut real = Profile::from_yaml(&with_effect).expect("a profile");
    real.world_from_base = world_from_base;
    let flange_from_tool = Pose::from_xyz_rxryrz([0.12, 0.05, 0.1, 0.1, 0.2, 0.3]);
    let mounted = Mounted {
        name: "probe".into(),
        flange_from_tool,
        load: None,
    };
    let mut random = seeded(22);
    let (mut base_chi, mut tool_errors) = (Vec::new(), Vec::new());
    for _ in 0..40 {
        let mut sweep = |joint: usize| {
            let mut rows = Vec::new();
            let turned = |k: f64| -0.8 + 1.6 * k / 19.0;
            let passes = (0..20).map(|k| (f64::from(k), 1.0));
            let back = (0..20).rev().map(|k| (f64::from(k), -1.0));
            for (k, direction) in passes.chain(back) {
                let mut q = [0.1, -0.2, 0.3, 0.2, 0.6, -0.3];
                q[joint] += turned(k);
                let mut conditions = Conditions::default();
                conditions.direction[joint] = direction;
                let pose = real
                    .real_model(&mounted, &conditions)
                    .forward(&q, &conditions);
                rows.push(Row {
                    q,
                    point_m: noisy(&mut random, pose.translation, 1e-5),
                    rotation: Some(pose.rotation),
                    direction,
                });
            }
            Sweep { joint, rows }
        };
        let sweeps: Vec<Sweep> = [0, 1, 4, 5].map(&mut sweep).into();
        for sweep in &sweeps {
            let (kept, outliers) = without_outliers(sweep, &nominal).expect("a sweep");
            assert!(outliers.is_empty() && kept == *sweep, "{outliers:?}");
            let mut spoilt = sweep.clone();
            spoilt.rows[7].point_m[2] += 1e-3;
            let (_, outliers) = without_outliers(&spoilt, &nominal).expect("a sweep");
            let [outlier] = outliers.as_slice() else {
                panic!("{outliers:?}")
            };
            assert!(outlier.row == 7 && (outlier.off_m - 1e-3).abs() < 2e-4);
        }
        let found = base(&sweeps[0], &sweeps[1], &nominal).expect("a base");
        base_chi.push(chi_squared(
            &found.pose,
            &world_from_base,
            &found.covariance.expect("many rows"),
        ));
        let placed = tool(&sweeps[2], &sweeps[3], &nominal).expect("a tool");
        let gap = placed.pose.separation(&flange_from_tool);
        let covariance = placed.covariance.expect("many rows");
        let sigma = norm(covariance.sigma_at_m(placed.pose.translation));
        tool_errors.push(gap.distance_m / sigma);
        assert!(gap.angle_rad < 1e-3, "{gap:?}");
        let second = axis(&sweeps[1], &nominal).expect("an axis");
        let (width, sigma) = second.backlash_rad.expect("both directions");
        assert!((width.to_degrees() - 0.02).abs() < 4.0 * sigma.to_degrees());
        assert!(sigma.to_degrees() < 0.001);
    }
    assert_six(&base_chi, 2.0);
    #[allow(clippy::cast_precision_loss)]
    let square = tool_errors.iter().map(|e| e * e).sum::<f64>() / tool_errors.len() as f64;
    assert!((0.5..1.8).contains(&square), "{square}");
}
