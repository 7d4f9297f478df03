//! Forward models and inverses of the thesis's IRB 120, a target; answers of a CRX-10iA; what is
//! refused.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use poseshift::geometry::Pose;
use poseshift::inverse::{Arm, Branch, Inverse, Targets, solve_batch};
use poseshift::model::profile::Profile;
use poseshift::model::{Conditions, Geometry, JointSense, Link, Mechanism, forward_batch};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::f64::consts::{FRAC_PI_2, PI};
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

/// FANUC's CRX-10iA (`tests/data/inverse_general/arms.csv)`: axis 6 passes axis 4 by 150 mm.
fn crx() -> Arm {
    let row = |alpha_rad, a_m, theta_rad, d_m| Link {
        alpha_rad,
        a_m,
        beta_rad: 0.0,
        theta_rad,
        d_m,
    };
    let geometry = Geometry {
        world_from_base: Pose::identity(),
        links: [
            row(0.0, 0.0, PI, 0.995),
            row(FRAC_PI_2, 0.0, FRAC_PI_2, 0.0),
            row(PI, 0.54, PI, 0.0),
            row(FRAC_PI_2, 0.0, PI, -0.54),
            row(FRAC_PI_2, 0.0, PI, 0.15),
            row(FRAC_PI_2, 0.0, 0.0, -0.16),
        ],
        link6_from_flange: Pose::identity(),
        flange_from_tool: Pose::identity(),
        flange_from_nominal_tool: Pose::identity(),
        bodies: Vec::new(),
        load: None,
        gravity_m_s2: [0.0, 0.0, -9.81],
        tool_name: String::new(),
        carried: None,
    };
    let joint = JointSense {
        sign: 1.0,
        offset_rad: 0.0,
        min_rad: -PI,
        max_rad: PI,
    };
    let mechanism = Mechanism {
        joints: [joint; 6],
        coupling: Vec::new(),
    };
    Arm::of(&geometry, &mechanism).expect("an offset wrist")
}

fn offset_wrist(criterion: &mut Criterion) {
    let arm = crx();
    let mut random = StdRng::seed_from_u64(2);
    let mut joints = || std::array::from_fn(|_| random.random_range(-PI..PI));
    let postures: Vec<[f64; 6]> = (0..COUNT).map(|_| joints()).collect();
    let given: Vec<[f64; 6]> = postures.iter().map(|q| q.map(|q| q + 0.01)).collect();
    let wanted: Vec<Pose> = postures.iter().map(|q| arm.forward(q)).collect();
    let mut group = criterion.benchmark_group("4096 targets, CRX-10iA");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function("nominal inverse, all answers", |b| {
        b.iter(|| {
            for (wanted, near) in wanted.iter().zip(&given) {
                black_box(arm.solve_all(wanted, near));
            }
        });
    });
    group.bench_function("nominal inverse, on the track", |b| {
        b.iter(|| {
            for (wanted, near) in wanted.iter().zip(&given) {
                black_box(arm.solve_near(wanted, near));
            }
        });
    });
    group.finish();
}

fn refused(criterion: &mut Criterion) {
    let work = work();
    let mut group = criterion.benchmark_group("4096 targets, refused");
    group.throughput(Throughput::Elements(COUNT as u64));
    let far = |pose: &Pose| Pose {
        translation: pose.translation.map(|x| x + x.signum()),
        ..*pose
    };
    let nowhere = |pose: &Pose| Pose {
        translation: [f64::NAN; 3],
        ..*pose
    };
    type Case<'a> = (&'a str, &'a dyn Fn(&Pose) -> Pose);
    let cases: [Case; 2] = [("out of reach", &far), ("not a number", &nowhere)];
    for (name, change) in cases {
        let poses: Vec<Pose> = work.wanted.iter().map(change).collect();
        group.bench_function(name, |b| {
            b.iter(|| {
                for ((wanted, branch), near) in poses.iter().zip(&work.branches).zip(&work.joints) {
                    black_box(work.inverse.solve(wanted, *branch, near));
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, kinematics, offset_wrist, refused);
criterion_main!(benches);
