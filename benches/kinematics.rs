//! Forward models and inverses of the thesis's IRB 120, a target.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use poseshift::geometry::Pose;
use poseshift::inverse::{Arm, Branch, Inverse, Targets, solve_batch};
use poseshift::model::profile::Profile;
use poseshift::model::{Conditions, forward_batch};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::hint::black_box;

const COUNT: usize = 4096;

struct Work {
    inverse: Inverse,
    controller: poseshift::model::Model,
    joints: Vec<[f64; 6]>,
    wanted: Vec<Pose>,
    branches: Vec<Branch>,
}

fn work() -> Work {
    let profile = Profile::from_yaml(include_str!("../robots/abb_irb120_thesis.yaml"))
        .expect("a shipped profile");
    let tool = profile.tool("artifact").expect("its tool");
    let arm = Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("a spherical wrist");
    let conditions = Conditions::default();
    let real = profile.real_model(&tool, &conditions);
    let controller = profile.controller_model(&tool);
    let mut random = StdRng::seed_from_u64(1);
    let mut joints = Vec::new();
    while joints.len() < COUNT {
        let q = profile
            .mechanism
            .joints
            .map(|j| random.random_range(j.min_rad..j.max_rad));
        let margins = arm.posture(&q).1;
        if margins.wrist_rad > 0.1 && margins.elbow_rad > 0.1 && margins.shoulder_m > 0.03 {
            joints.push(q);
        }
    }
    let wanted = joints
        .iter()
        .map(|q| controller.forward(q, &conditions))
        .collect();
    let branches = joints.iter().map(|q| arm.posture(q).0).collect();
    Work {
        inverse: Inverse {
            arm,
            real,
            conditions,
        },
        controller,
        joints,
        wanted,
        branches,
    }
}

fn kinematics(criterion: &mut Criterion) {
    let work = work();
    let conditions = Conditions::default();
    let mut group = criterion.benchmark_group("4096 targets");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function("nominal forward", |b| {
        b.iter(|| {
            work.joints.iter().for_each(|q| {
                black_box(work.controller.forward(q, &conditions));
            });
        });
    });
    group.bench_function("calibrated forward", |b| {
        b.iter(|| {
            work.joints.iter().for_each(|q| {
                black_box(work.inverse.real.forward(q, &conditions));
            });
        });
    });
    group.bench_function("calibrated forward, batch", |b| {
        b.iter(|| black_box(forward_batch(&work.inverse.real, &conditions, &work.joints)));
    });
    group.bench_function("nominal inverse, one branch", |b| {
        b.iter(|| {
            for ((wanted, branch), near) in work.wanted.iter().zip(&work.branches).zip(&work.joints)
            {
                black_box(work.inverse.arm.solve_branch(wanted, *branch, near));
            }
        });
    });
    group.bench_function("calibrated inverse, single", |b| {
        b.iter(|| {
            for ((wanted, branch), near) in work.wanted.iter().zip(&work.branches).zip(&work.joints)
            {
                black_box(work.inverse.solve(wanted, *branch, near));
            }
        });
    });
    group.bench_function("calibrated inverse, batch", |b| {
        let targets = Targets {
            wanted: &work.wanted,
            branches: &work.branches,
            near: &work.joints,
        };
        b.iter(|| black_box(solve_batch(&work.inverse, targets)));
    });
    group.finish();
}

criterion_group!(benches, kinematics);
criterion_main!(benches);
