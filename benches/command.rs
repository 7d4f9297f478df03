//! Programs of 100 000 targets in every language: reading and writing alone, on one core, and the
//! whole command.

#[path = "../tests/suite/path.rs"]
mod path;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use path::Prepared;
use poseshift::compensate::compensate;
use std::path::Path;
use std::process::Command;

const TARGETS: u32 = 100_000;

fn read_and_write(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("read and write");
    group.sample_size(10);
    for &(id, ending) in path::WRITTEN {
        let Prepared {
            language,
            sources,
            profile,
            settings,
            options,
        } = path::prepared((id, ending), TARGETS, 1);
        let bytes: usize = sources.iter().map(|source| source.bytes.len()).sum();
        group.throughput(Throughput::Bytes(bytes as u64));
        let compensated = compensate(language, &sources, &profile, &options);
        let edits = compensated.expect("compensated").edits;
        group.bench_function(id, |b| {
            b.iter_batched(
                || edits[0].clone(),
                |edits| {
                    let program =
                        poseshift::motion::read(language, &sources, &settings).expect("a program");
                    (program.targets.len(), edits.apply(&sources[0].bytes))
                },
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

fn command(criterion: &mut Criterion) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let mut group = criterion.benchmark_group("whole command");
    group
        .throughput(Throughput::Elements(u64::from(TARGETS)))
        .sample_size(10);
    for (id, ending) in path::WRITTEN {
        let (input, output) = (folder.join(id), folder.join(format!("{id}_out")));
        let profile = folder.join(format!("{id}.yaml"));
        std::fs::create_dir_all(&input).expect("the target folder is writable");
        let own = (format!("path.{ending}"), path::program(id, TARGETS, 1));
        let given = path::given(id, TARGETS).map(|(name, text)| (name.to_owned(), text));
        for (name, text) in [own].into_iter().chain(given) {
            std::fs::write(input.join(name), text).expect("the target folder is writable");
        }
        std::fs::write(&profile, path::profile(id)).expect("the target folder is writable");
        group.bench_function(*id, |b| {
            b.iter(|| {
                let status = Command::new(env!("CARGO_BIN_EXE_poseshift"))
                    .arg("compensate")
                    .arg(&input)
                    .args(["--tool", "artifact", "-q", "--profile"])
                    .arg(&profile)
                    .arg("-o")
                    .arg(&output)
                    .status();
                assert!(status.expect("the program starts").success());
            });
        });
    }
    group.finish();
}

criterion_group!(benches, read_and_write, command);
criterion_main!(benches);
