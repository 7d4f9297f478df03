//! The whole command on a RAPID program of 100 000 inline targets: start, read, solve, write, sync.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use poseshift::geometry::units::mm_from_m;
use poseshift::model::Conditions;
use poseshift::model::profile::Profile;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

const TARGETS: u32 = 100_000;

/// A smooth path through the work space of the thesis's IRB 120.
fn program() -> String {
    let profile = Profile::from_yaml(include_str!("../robots/abb_irb120_thesis.yaml"))
        .expect("a shipped profile");
    let tool = profile.tool("artifact").expect("its tool");
    let controller = profile.controller_model(&tool);
    let mut text = String::from(
        "MODULE Path\r\n  PERS tooldata artifact:=[TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];\r\n  PROC main()\r\n    \
         MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\r\n",
    );
    for n in 0..TARGETS {
        let t = f64::from(n) * 1e-3;
        let q = [
            0.6 * t.sin(),
            0.2 + 0.2 * (0.7 * t).sin(),
            0.2 * (1.1 * t).cos(),
            0.3 * (0.9 * t).sin(),
            1.0 + 0.2 * t.cos(),
            0.5 * t.sin(),
        ];
        let pose = controller.forward(&q, &Conditions::default());
        let [x, y, z] = pose.translation.map(mm_from_m);
        let [w, i, j, k] = pose.rotation.quaternion().0;
        let quadrant = |angle: f64| if angle < 0.0 { -1 } else { 0 };
        let (cf1, cf4, cf6) = (quadrant(q[0]), quadrant(q[3]), quadrant(q[5]));
        writeln!(
            text,
            "    MoveL [[{x:.3},{y:.3},{z:.3}],[{w:.8},{i:.8},{j:.8},{k:.8}],[{cf1},{cf4},{cf6},0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,z1,artifact;\r"
        )
        .expect("a string takes all text");
    }
    text + "  ENDPROC\r\nENDMODULE\r\n"
}

fn command(criterion: &mut Criterion) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (input, output) = (folder.join("path.mod"), folder.join("path_out.mod"));
    std::fs::write(&input, program()).expect("the target folder is writable");
    let mut group = criterion.benchmark_group("whole command");
    group
        .throughput(Throughput::Elements(u64::from(TARGETS)))
        .sample_size(10);
    group.bench_function("compensate 100 000 RAPID targets", |b| {
        b.iter(|| {
            let status = Command::new(env!("CARGO_BIN_EXE_poseshift"))
                .arg("compensate")
                .arg(&input)
                .args([
                    "--profile",
                    concat!(env!("CARGO_MANIFEST_DIR"), "/robots/abb_irb120_thesis.yaml"),
                    "-q",
                    "-o",
                ])
                .arg(&output)
                .status();
            assert!(status.expect("the program starts").success());
        });
    });
    group.finish();
}

criterion_group!(benches, command);
criterion_main!(benches);
