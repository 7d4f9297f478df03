//! Identification, distance errors of all pairs, and choosing configurations, on the thesis's IRB
//! 120.

use criterion::{Criterion, criterion_group, criterion_main};
use poseshift::identify::base::BasePolicy;
use poseshift::identify::calibration::{Options, calibrate};
use poseshift::identify::measurements::Measurements;
use poseshift::identify::parameters::{Level, Selection};
use poseshift::identify::pick::Pick;
use poseshift::identify::plan::{Constraints, Request, plan};
use poseshift::identify::problem::Problem;
use poseshift::identify::random::Random;
use poseshift::identify::robust::Shape;
use poseshift::identify::simulate::{Command, Session, simulate};
use poseshift::identify::solver::solve;
use poseshift::identify::statistics::pairs;
use poseshift::identify::uncertainty::Uncertainty;
use poseshift::model::external::Stand;
use poseshift::model::profile::Profile;
use std::hint::black_box;

fn truth() -> Profile {
    Profile::from_yaml(include_str!("../robots/abb_irb120_thesis.yaml")).expect("a shipped profile")
}

fn nominal() -> Profile {
    let mut profile = truth();
    profile.effects.clear();
    profile
}

/// 30 parameters: base, links 2 to 6 without the redundant ones, five compliances; the tool is
/// known.
fn selection() -> Selection {
    let mut selection = Selection::level(Level::Compliance);
    selection.fix = Pick::parse_list("tool_frame,link_geometry:6.d_mm").expect("words");
    selection
}

fn measured(count: usize) -> Measurements {
    let profile = truth();
    let tool = profile.tool("artifact").expect("its tool");
    let mut random = Random::new(1);
    let commands: Vec<Command> = (0..count)
        .map(|_| Command {
            q: profile
                .mechanism
                .joints
                .map(|j| random.between(j.min_rad, j.max_rad)),
            stand: Stand::default(),
            plate: None,
            direction: None,
            force_n: [0.0; 3],
        })
        .collect();
    let session = Session {
        noise_m: 5e-5,
        ..Session::default()
    };
    Measurements {
        rows: simulate(&profile, &tool, &[(None, [0.0; 3])], &commands, &session),
        columns: Vec::new(),
    }
}

fn identification(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("identify");
    group.sample_size(20);
    let profile = nominal();
    for count in [50, 9905] {
        let seen = measured(count);
        let (problem, start) = Problem::new(&profile, &seen, &selection(), profile.world_from_base)
            .expect("a problem");
        assert_eq!(problem.parameters.len(), 30);
        group.bench_function(
            format!("30 parameters from {count} positions, solve"),
            |b| {
                b.iter(|| {
                    let solved =
                        solve(&problem, start.clone(), Shape::Squares, true).expect("solved");
                    black_box(Uncertainty::of(&problem, &solved))
                });
            },
        );
        let options = Options {
            selection: selection(),
            shape: Shape::Huber,
            base: BasePolicy::Profile,
        };
        group.bench_function(
            format!("30 parameters from {count} positions, all of calibrate"),
            |b| {
                b.iter(|| black_box(calibrate(&profile, &seen, &options).expect("solved")));
            },
        );
    }
    group.finish();
}

fn all_pairs(criterion: &mut Criterion) {
    let mut random = Random::new(2);
    let measured: Vec<[f64; 3]> = (0..9905)
        .map(|_| [0.0; 3].map(|_: f64| random.between(-600.0, 600.0)))
        .collect();
    let expected: Vec<[f64; 3]> = measured
        .iter()
        .map(|p| p.map(|x| x + 0.1 * random.normal()))
        .collect();
    let mut group = criterion.benchmark_group("distances");
    group.sample_size(20);
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    group.bench_function("49 million pairs, one core", |b| {
        b.iter(|| one.install(|| black_box(pairs(&measured, &expected))));
    });
    group.bench_function("49 million pairs, all cores", |b| {
        b.iter(|| black_box(pairs(&measured, &expected)));
    });
    group.finish();
}

fn choosing(criterion: &mut Criterion) {
    let profile = truth();
    let tool = profile.tool("artifact").expect("its tool");
    let request = |starts| Request {
        count: 50,
        candidates: 5000,
        starts,
        seed: 1,
        sigma_m: 5e-5,
        poses: false,
        given: Vec::new(),
        given_stands: Vec::new(),
        stations: 11,
        constraints: Constraints::default(),
    };
    let mut group = criterion.benchmark_group("plan");
    group.sample_size(20);
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    for starts in [1, 4, 10] {
        let found = plan(&profile, &tool, &selection(), &request(starts)).expect("a plan");
        println!(
            "50 of 5000, {starts} starts: O1 {:.4} ({:?})",
            found.observability.o1, found.starts_o1
        );
        let planned =
            || black_box(plan(&profile, &tool, &selection(), &request(starts)).expect("a plan"));
        group.bench_function(format!("50 of 5000, {starts} starts, all cores"), |b| {
            b.iter(planned);
        });
        group.bench_function(format!("50 of 5000, {starts} starts, one core"), |b| {
            b.iter(|| one.install(planned));
        });
    }
    group.finish();
}

criterion_group!(benches, identification, all_pairs, choosing);
criterion_main!(benches);
