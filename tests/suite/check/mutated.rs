//! Readers of meshes, URDFs, profiles, cells and measurements, on files that were damaged at
//! random: an answer or an error, and nothing else. The same in every run; `fuzz/run.sh` looks
//! longer.

use crate::support::{files_below, repository};
use poseshift::check::cell::Cell;
use poseshift::check::mesh::Mesh;
use poseshift::identify::measurements::Measurements;
use poseshift::model::profile::Profile;
use poseshift::urdf::{About, Choice, UrdfArm, profile_text};
use std::path::Path;

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

/// Reads a sample as what it is; whether it was taken.
fn read(reader: &str, name: &str, bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    match reader {
        "urdf" => {
            let choice = Choice {
                shapes: true,
                ..Choice::default()
            };
            let arm = UrdfArm::read(&text, &choice);
            if let Ok(arm) = &arm
                && let Ok((text, _)) = profile_text(arm, &About::of("r.urdf", &|_| None))
            {
                Profile::from_yaml(&text).expect("what is made of a URDF is a profile");
            }
            arm.is_ok()
        }
        "profile" => Profile::from_yaml(&text).is_ok(),
        "cell" => Cell::from_yaml(&text).is_ok(),
        "measurements" => Measurements::from_csv(bytes).is_ok(),
        _ => {
            let nothing = |_: &str| Err(String::new());
            let mesh = Mesh::read(name, bytes, None, &nothing);
            if let Ok(mesh) = &mesh {
                assert!(mesh.bounds().iter().flatten().all(|x| x.is_finite()));
            }
            mesh.is_ok()
        }
    }
}

#[test]
fn damaged_files_end_with_an_answer() {
    let seeds = repository("fuzz/seeds");
    let mut samples: Vec<(String, String, Vec<u8>)> = files_below(&seeds)
        .iter()
        .map(|file| {
            let reader = file.parent().and_then(Path::to_str).expect("a reader");
            let bytes = std::fs::read(seeds.join(file)).expect("a sample");
            (reader.to_owned(), file.display().to_string(), bytes)
        })
        .collect();
    let profile = "robots/abb_irb120_thesis.yaml";
    let bytes = std::fs::read(repository(profile)).expect("a sample");
    samples.push(("profile".into(), profile.into(), bytes));
    assert_eq!(samples.len(), 12);
    for (reader, name, bytes) in &samples {
        assert!(read(reader, name, bytes), "{name} is taken as it is");
        let mut random = Random(bytes.len() as u64);
        let mut taken = 0;
        for _ in 0..COPIES {
            let mut copy = bytes.clone();
            for _ in 0..=random.below(3) {
                damage(&mut copy, &mut random);
            }
            taken += usize::from(read(reader, name, &copy));
        }
        assert!(taken < COPIES, "{name}: {taken} damaged copies are taken");
    }
}
