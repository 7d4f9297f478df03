//! Every reader of what is no program, on files that were damaged at random: an answer or an error,
//! and nothing else. The same in every run; `fuzz/run.sh` looks longer.

use crate::support::{files_below, poseshift, repository, scratch};
use std::collections::BTreeMap;
use std::path::Path;

#[path = "../../../fuzz/src/readers.rs"]
mod readers;

/// Damaged copies of each sample.
const COPIES: usize = 1_000;
/// What stands in place of a number.
const NUMBERS: [&str; 8] = [
    "0",
    "-1",
    "7",
    "1e308",
    "NaN",
    "4294967295",
    "18446744073709551615",
    "99999999999999999999999",
];

/// Numbers of splitmix64.
struct Random(u64);

impl Random {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        usize::try_from((z ^ (z >> 31)) % most.max(1) as u64).expect("below `most`")
    }
}

fn damage(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len());
    let end = (at + 1 + random.below(40)).min(bytes.len());
    match random.below(6) {
        _ if bytes.is_empty() => {}
        0 => bytes[at] ^= 1 << random.below(8),
        1 => drop(bytes.drain(at..end)),
        2 => {
            let again = bytes[at..end].to_vec();
            bytes.splice(at..at, again);
        }
        3 => bytes.truncate(at),
        _ => {
            let digit = |from: usize| bytes[from..].iter().position(u8::is_ascii_digit);
            let Some(start) = digit(at).map(|d| at + d) else {
                return;
            };
            let number = bytes[start..].iter();
            let long = number
                .take_while(|b| b.is_ascii_digit() || **b == b'.')
                .count();
            let other = NUMBERS[random.below(NUMBERS.len())];
            bytes.splice(start..start + long, other.bytes());
        }
    }
}

/// What stands between the files of one sample, and before the name of each.
const FILES: [u8; 2] = [0, 1];

/// Reads a sample as what it is; whether it was taken.
fn read(reader: &str, bytes: &[u8]) -> bool {
    match reader {
        "baseline" => readers::baseline(bytes),
        "cell" => readers::cell(bytes),
        "frame" => readers::frame(bytes),
        "handeye" => readers::handeye(bytes),
        "hexapod" => readers::hexapod(bytes),
        "joints" => readers::joints(bytes),
        "krc" => readers::krc(bytes),
        "measurements" => readers::measurements(bytes),
        "moc" => readers::moc(bytes),
        "profile" => readers::profile(bytes),
        "register" => readers::register(bytes),
        "sweeps" => readers::sweeps(bytes),
        "ur" => readers::ur(bytes),
        "urdf" => readers::urdf(bytes),
        "dae" | "gltf" | "obj" | "stl" => readers::mesh(reader, bytes),
        _ => panic!("no reader {reader}"),
    }
}

/// The seeds of the fuzz targets by reader and name; those of a folder are one.
fn samples() -> BTreeMap<(String, String), Vec<u8>> {
    let seeds = repository("fuzz/seeds");
    let mut samples: BTreeMap<(String, String), Vec<u8>> = BTreeMap::new();
    for file in files_below(&seeds) {
        let mut parts = file.iter().map(|part| part.to_str().expect("a plain name"));
        let reader = parts.next().expect("a reader").to_owned();
        let name = parts.next().expect("a sample").to_owned();
        let bytes = std::fs::read(seeds.join(&file)).expect("a sample");
        let sample = samples.entry((reader, name)).or_default();
        if let Some(part) = parts.next() {
            let [between, before] = FILES;
            if !sample.is_empty() {
                sample.push(between);
            }
            sample.push(before);
            sample.extend(part.bytes().chain([b'\n']));
        }
        sample.extend(bytes);
    }
    let profile = "abb_irb120_thesis.yaml";
    let bytes = std::fs::read(repository("robots").join(profile)).expect("a sample");
    samples.insert(("profile".into(), profile.into()), bytes);
    samples
}

#[test]
fn damaged_files_end_with_an_answer() {
    let mut readers: Vec<String> = Vec::new();
    for ((reader, name), bytes) in samples() {
        if reader == "journal" {
            continue;
        }
        assert!(read(&reader, &bytes), "{reader}/{name} is taken as it is");
        let mut random = Random(bytes.len() as u64);
        let mut taken = 0;
        for _ in 0..COPIES {
            let mut copy = bytes.clone();
            for _ in 0..=random.below(3) {
                damage(&mut copy, &mut random);
            }
            taken += usize::from(read(&reader, &copy));
        }
        assert!(taken < COPIES, "{name}: {taken} damaged copies are taken");
        readers.push(reader);
    }
    readers.dedup();
    // what is neither a language nor the journal, which the next test has
    let targets = files_below(&repository("fuzz/fuzz_targets"));
    let targets = targets.iter().filter_map(|file| file.file_stem()?.to_str());
    let languages = repository("programs");
    let others = targets.filter(|name| *name != "journal" && !languages.join(name).exists());
    assert_eq!(readers, others.collect::<Vec<_>>());
}

#[test]
fn a_damaged_journal_changes_no_other_file() {
    const COPIES: usize = 60;
    let folder = scratch();
    let at = |name: &str| folder.path().join(name);
    let of_journal = |key: &(String, String)| key.0 == "journal";
    let (mut refused, mut runs) = (0, 0);
    for ((_, name), bytes) in samples().into_iter().filter(|(key, _)| of_journal(key)) {
        let mut random = Random(bytes.len() as u64);
        for _ in 0..COPIES {
            let mut copy = bytes.clone();
            for _ in 0..=random.below(3) {
                damage(&mut copy, &mut random);
            }
            std::fs::write(at("kept.mod"), "kept").expect("scratch");
            std::fs::write(at(".poseshift-journal"), &copy).expect("scratch");
            std::fs::copy(repository("robots/abb_irb120.yaml"), at("p.yaml")).expect("scratch");
            let mut shown = poseshift();
            shown.args(["profile", "show", "p.yaml"]);
            let shown = shown
                .current_dir(folder.path())
                .output()
                .expect("it starts");
            let said = String::from_utf8_lossy(&shown.stderr);
            assert!(matches!(shown.status.code(), Some(0 | 2)), "{name}: {said}");
            let kept = std::fs::read(at("kept.mod")).expect("it is there");
            assert_eq!(kept, b"kept", "{name}: {said}");
            assert!(Path::new(&at("p.yaml")).exists(), "{name}: {said}");
            refused += usize::from(shown.status.code() == Some(2));
            runs += 1;
        }
    }
    assert_eq!(runs, 3 * COPIES);
    assert!((1..runs).contains(&refused), "{refused} of {runs}");
}
