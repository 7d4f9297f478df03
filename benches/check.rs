//! A program of 10 000 targets certified continuously against the arm itself and a cell of 20 000
//! triangles; and the same arm at as many single postures by parry alone.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use parry::math::{Pose as ParryPose, Vector as Glam};
use parry::query;
use parry::shape::{Capsule, TriMesh};
use poseshift::check::cell::Cell;
use poseshift::check::mesh::Mesh;
use poseshift::check::{Meshes, Options, Scene, Subject, check};
use poseshift::geometry::Pose;
use poseshift::geometry::units::mm_from_m;
use poseshift::model::Conditions;
use poseshift::model::profile::Profile;
use poseshift::model::shape::Form;
use poseshift::program::Source;
use poseshift::program::rapid::Rapid;
use std::hint::black_box;

const TARGETS: u32 = 10_000;
/// Squares along one side of the wavy floor: 2 · 100² triangles.
const SIDE: u32 = 100;

fn joints(n: u32) -> [f64; 6] {
    let t = f64::from(n) * 1e-3;
    [
        0.6 * t.sin(),
        0.2 + 0.2 * (0.7 * t).sin(),
        0.2 * (1.1 * t).cos(),
        0.3 * (0.9 * t).sin(),
        1.0 + 0.2 * t.cos(),
        0.5 * t.sin(),
    ]
}

fn program(profile: &Profile) -> Source {
    let tool = profile.tool("artifact").expect("its tool");
    let controller = profile.controller_model(&tool);
    let mut text = String::from(
        "MODULE m\n PERS tooldata artifact:=[TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];\n PROC main()\n\
         MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n",
    );
    for n in 0..TARGETS {
        let q = joints(n);
        let pose = controller.forward(&q, &Conditions::default());
        let [x, y, z] = pose.translation.map(mm_from_m);
        let [w, i, j, k] = pose.rotation.quaternion().0;
        let cf = [q[0], q[3], q[5]].map(|a| if a < 0.0 { -1 } else { 0 });
        text += &format!(
            "MoveL [[{x:.3},{y:.3},{z:.3}],[{w:.8},{i:.8},{j:.8},{k:.8}],[{},{},{},0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,z1,artifact;\n",
            cf[0], cf[1], cf[2]
        );
    }
    Source::new("m.mod", (text + " ENDPROC\nENDMODULE\n").into_bytes())
}

/// A wavy floor below the tool and a ring of walls.
fn triangles() -> Vec<[[f64; 3]; 3]> {
    let point = |i: u32, j: u32| {
        let (u, v) = (
            f64::from(i) / f64::from(SIDE),
            f64::from(j) / f64::from(SIDE),
        );
        let (x, y) = (1.4 * u - 0.4, 1.4 * v - 0.7);
        [x, y, -0.06 + 0.03 * (9.0 * x).sin() * (7.0 * y).cos()]
    };
    let mut out = Vec::new();
    for i in 0..SIDE {
        for j in 0..SIDE {
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| point(i, j));
            out.push([a, b, c]);
            out.push([b, d, c]);
        }
    }
    out
}

fn bench(c: &mut Criterion) {
    let profile =
        Profile::from_yaml(include_str!("../robots/abb_irb120_thesis.yaml")).expect("a profile");
    let mesh = Mesh::of(&triangles(), 1.0).expect("a mesh");
    assert_eq!(mesh.triangles.len(), 20_000);
    let cell_text = "poseshift: cell/1\nclearance_mm: 5\nbodies: [{name: floor, mesh: floor.stl}]\n\
        attached: [{name: gun, to: flange, capsule_mm: {from: [0, 0, 0], to: [50, 25, 100], \
            radius: 10}}]\n\
        pairs: [{a: link1, b: floor, allow: true}, {a: link2, b: floor, allow: true}]\n";
    let cell = Cell::from_yaml(cell_text).expect("a cell");
    let meshes: Meshes = [("floor.stl".to_owned(), mesh.clone())].into();
    let scene = Scene::new(&profile, Some(&cell), &meshes).expect("all meshes");
    let sources = [program(&profile)];
    let empty = Scene::default();
    let subject = |scene| Subject {
        language: &Rapid,
        sources: &sources,
        nominal: None,
        profile: &profile,
        scene,
    };
    let found = check(&subject(&scene), &Options::default()).expect("a check");
    println!("{:?}", found.summary);
    let mut group = c.benchmark_group("check");
    group
        .sample_size(10)
        .throughput(Throughput::Elements(u64::from(TARGETS)));
    group.bench_function("10 000 targets, paths only", |b| {
        b.iter(|| black_box(check(&subject(&empty), &Options::default())));
    });
    group.bench_function("10 000 targets, paths, self, 20 000 triangles", |b| {
        b.iter(|| black_box(check(&subject(&scene), &Options::default())));
    });
    // the floor raised until the gun is 22 mm above it
    let near = cell_text.replace(
        "mesh: floor.stl}",
        "mesh: floor.stl, at: {x_mm: 0, y_mm: 0, z_mm: 340, rx_deg: 0, ry_deg: 0, rz_deg: 0}}",
    );
    let near = Cell::from_yaml(&near).expect("a cell");
    let near = Scene::new(&profile, Some(&near), &meshes).expect("all meshes");
    group.bench_function("10 000 targets, the floor 22 mm away", |b| {
        b.iter(|| black_box(check(&subject(&near), &Options::default())));
    });
    // parry alone: one posture a target, no guarantee between, is anything nearer than 105 mm?
    let vertices = mesh
        .triangles
        .iter()
        .flatten()
        .map(|p| Glam::new(p[0], p[1], p[2]))
        .collect();
    let faces = (0..20_000).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let floor = TriMesh::new(vertices, faces).expect("a mesh");
    let rods: Vec<(usize, Capsule)> = profile
        .shapes
        .iter()
        .filter(|shape| shape.link > 1)
        .filter_map(|shape| match shape.shape.form {
            Form::Capsule {
                from_m,
                to_m,
                radius_m,
            } => {
                let end = |p: [f64; 3]| Glam::new(p[0], p[1], p[2]);
                Some((shape.link, Capsule::new(end(from_m), end(to_m), radius_m)))
            }
            _ => None,
        })
        .collect();
    let tool = profile.tool("artifact").expect("its tool");
    let real = profile.real_model(&tool, &Conditions::default());
    let placed = |pose: &Pose| {
        let [w, x, y, z] = pose.rotation.quaternion().0;
        let [a, b, c] = pose.translation;
        ParryPose {
            rotation: glamx::DQuat::from_xyzw(x, y, z, w),
            translation: Glam::new(a, b, c),
        }
    };
    group.bench_function(
        "parry alone, 10 000 postures, capsules against 20 000 triangles",
        |b| {
            b.iter(|| {
                for n in 0..TARGETS {
                    let frames = real.link_frames(&joints(n), &Conditions::default());
                    for (link, rod) in &rods {
                        let place = placed(&frames[*link]);
                        black_box(query::closest_points(
                            &ParryPose::identity(),
                            &floor,
                            &place,
                            rod,
                            0.105,
                        ))
                        .ok();
                    }
                }
            });
        },
    );
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
