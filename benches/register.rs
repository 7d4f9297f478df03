//! The measuring side: Kabsch, hand-eye, hexapod, ICP.

use criterion::{Criterion, criterion_group, criterion_main};
use poseshift::geometry::{Pose, Rotation, Vector};
use poseshift::register::handeye::{HandEye, Method, Setup};
use poseshift::register::hexapod::{Design, Lengths, solve, spread};
use poseshift::register::icp::{Metric, Options, icp};
use poseshift::register::kabsch::kabsch;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::hint::black_box;

fn random_pose(random: &mut StdRng) -> Pose {
    let mut three = || -> [f64; 3] { std::array::from_fn(|_| random.random_range(-1.0..1.0)) };
    Pose {
        rotation: Rotation::from_vector(three()),
        translation: three(),
    }
}

fn small(random: &mut StdRng, size: f64) -> Vector {
    std::array::from_fn(|_| random.random_range(-size..size))
}

fn register(criterion: &mut Criterion) {
    let mut random = StdRng::seed_from_u64(1);
    let truth = random_pose(&mut random);
    let from: Vec<Vector> = (0..1_000_000).map(|_| small(&mut random, 0.5)).collect();
    let to: Vec<Vector> = from.iter().map(|p| truth.transform(*p)).collect();
    criterion.bench_function("kabsch, 1e6 points", |b| {
        b.iter(|| kabsch(black_box(&from), black_box(&to), None).expect("a good set"));
    });
    for n in [20, 1000] {
        let (camera, board) = (random_pose(&mut random), random_pose(&mut random));
        let robot: Vec<Pose> = (0..n).map(|_| random_pose(&mut random)).collect();
        let seen: Vec<Pose> = robot
            .iter()
            .map(|a| {
                let noise = Pose {
                    rotation: Rotation::from_vector(small(&mut random, 1e-3)),
                    translation: small(&mut random, 2e-4),
                };
                camera.inverse() * a.inverse() * board * noise
            })
            .collect();
        criterion.bench_function(&format!("hand-eye, {n} poses, checks"), |b| {
            b.iter(|| HandEye::new(Setup::EyeInHand, &robot, &seen).expect("a good set"));
        });
        let problem = HandEye::new(Setup::EyeInHand, &robot, &seen).expect("a good set");
        for method in Method::ALL {
            criterion.bench_function(&format!("hand-eye, {n} poses, {}", method.id()), |b| {
                b.iter(|| black_box(&problem).by(method).expect("a solution"));
            });
        }
        criterion.bench_function(&format!("hand-eye, {n} poses, refined"), |b| {
            b.iter(|| black_box(&problem).refined().expect("a solution"));
        });
    }
    let lengths = Lengths {
        base_m: [0.3; 3],
        tool_m: [0.15; 3],
        legs_m: [0.3001, 0.2999, 0.3002, 0.3, 0.3001, 0.2998],
    };
    let design = Design::parse("123/123").expect("a design");
    criterion.bench_function("hexapod, one pose", |b| {
        b.iter(|| solve(black_box(&lengths), &design, 2).expect("a pose"));
    });
    criterion.bench_function("hexapod, its uncertainty", |b| {
        b.iter(|| spread(black_box(&lengths), &design, 2));
    });
    let mut cloud = |pose: &Pose| -> Vec<Vector> {
        (0..100_000)
            .map(|_| {
                let (u, v): (f64, f64) = (
                    random.random_range(0.0..0.4),
                    random.random_range(0.0..0.25),
                );
                let z = 0.04 * (11.0 * u).sin() * (14.0 * v).cos() + 0.1 * u;
                let n = small(&mut random, 5e-5);
                pose.transform([u + n[0], v + n[1], z + n[2]])
            })
            .collect()
    };
    let (from, to) = (cloud(&Pose::identity()), cloud(&truth));
    let options = Options {
        metric: Metric::PointToPlane,
        start: None,
        kept: 0.9,
        min_overlap: 0.6,
        sigma_m: None,
    };
    let mut group = criterion.benchmark_group("icp");
    group.sample_size(10);
    group.bench_function("100 000 points on 100 000, normals and search", |b| {
        b.iter(|| {
            let found = icp(&from, &to, None, &options).expect("clouds");
            assert!(found.concerns.is_empty());
        });
    });
    group.finish();
}

criterion_group!(benches, register);
criterion_main!(benches);
