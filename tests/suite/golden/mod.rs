//! Sample programs: each folder `programs/<language>/<case>` has `in/`, `out/` and `case.yaml`.
//!
//! `POSESHIFT_BLESS=1 cargo test golden` writes the present output into `out/`: look at the
//! difference before it is kept.

mod agree;
mod cam;
mod generated;
mod landing;
mod posts;
mod tampered;

use crate::support::{files_below, poseshift, repository, scratch};
use poseshift::program::{self, Marker, Source};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// What a sample says of itself.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// One sentence.
    pub about: String,
    /// Profile, relative to the sample's folder.
    pub profile: String,
    /// More words of the command line.
    pub options: Vec<String>,
    /// The command's exit status.
    #[serde(default)]
    pub status: i32,
}

/// Every sample's folder with what it says.
pub fn cases() -> Vec<(PathBuf, Case)> {
    let top = repository("programs");
    let found = files_below(&top)
        .into_iter()
        .filter(|path| path.file_name().is_some_and(|name| name == "case.yaml"));
    let read = |path: PathBuf| {
        let folder = top.join(path.parent().expect("a case has a folder"));
        let text = std::fs::read_to_string(folder.join("case.yaml")).expect("a readable case");
        let case: Case = serde_yaml::from_str(&text)
            .unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        (folder, case)
    };
    found.map(read).collect()
}

/// Runs the command of a case into `out`; returns its standard output.
pub fn run(folder: &Path, case: &Case, out: &Path, more: &[&str]) -> Vec<u8> {
    let mut command = poseshift();
    command
        .current_dir(folder)
        .args(["compensate", "in", "--profile", &case.profile, "-o"])
        .arg(out);
    let output = command
        .args(&case.options)
        .args(more)
        .output()
        .expect("the program starts");
    let reported = String::from_utf8_lossy(&output.stderr);
    assert_eq!(
        output.status.code(),
        Some(case.status),
        "{}: {reported}{}",
        folder.display(),
        String::from_utf8_lossy(&output.stdout)
    );
    output.stdout
}

#[test]
fn every_sample_gives_its_golden_output() {
    let bless = std::env::var_os("POSESHIFT_BLESS").is_some();
    let cases = cases();
    assert!(cases.len() >= 4, "{} samples", cases.len());
    for (folder, case) in cases {
        assert!(!case.about.is_empty());
        let scratch = scratch();
        let written = if bless {
            folder.join("out")
        } else {
            scratch.path().join("out")
        };
        run(&folder, &case, &written, &[]);
        let golden = folder.join("out");
        assert_eq!(
            files_below(&written),
            files_below(&golden),
            "{}",
            folder.display()
        );
        for file in files_below(&golden) {
            let (is, should) = (
                std::fs::read(written.join(&file)),
                std::fs::read(golden.join(&file)),
            );
            let same = is.expect("written") == should.expect("golden");
            assert!(
                same,
                "{}: {} differs from out/ (POSESHIFT_BLESS=1 writes it anew)",
                folder.display(),
                file.display()
            );
        }
    }
}

#[test]
fn a_profile_without_effects_changes_nothing_but_the_header() {
    for (folder, case) in cases() {
        let scratch = scratch();
        let profile = std::fs::read_to_string(folder.join(&case.profile)).expect("a profile");
        let plain = without_effects(&profile);
        std::fs::write(scratch.path().join("plain.yaml"), plain).expect("scratch");
        let offset = scratch.path().join("offset.yaml");
        std::fs::write(&offset, NO_OFFSET).expect("scratch");
        let mut options = case.options.clone();
        options.extend(["--work-offset".into(), offset.display().to_string()]);
        let case = Case {
            profile: scratch.path().join("plain.yaml").display().to_string(),
            options,
            ..case
        };
        let out = scratch.path().join("out");
        run(&folder, &case, &out, &[]);
        for file in files_below(&folder.join("in")) {
            let Ok(after) = std::fs::read(out.join(&file)) else {
                continue;
            };
            let before = std::fs::read(folder.join("in").join(&file)).expect("a sample");
            assert_eq!(
                unmarked(&after, &before, &file),
                before,
                "{} {}",
                folder.display(),
                file.display()
            );
        }
    }
}

/// A part that stands where it was simulated: without it a profile without effects is refused.
const NO_OFFSET: &str = "poseshift: frame/1
pose: {x_mm: 0, y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0}
";

/// A profile's text with an empty list of effects.
fn without_effects(profile: &str) -> String {
    let start = profile.find("calibration:").expect("a calibrated profile");
    format!("{}calibration: {{effects: []}}\n", &profile[..start])
}

/// The file without its marker: what stands where its language puts one, as many bytes as it has
/// grown by.
fn unmarked(after: &[u8], before: &[u8], file: &Path) -> Vec<u8> {
    let source = Source::new(file.display().to_string(), before.to_vec());
    let language = program::language_of(&source).expect("a known language");
    let marker = Marker {
        version: String::new(),
        profile_sha256: String::new(),
        source_sha256: String::new(),
        decided: Vec::new(),
    };
    let (at, _) = language.mark(&source, &marker);
    let grown = after.len().saturating_sub(before.len());
    let inserted = &after[at..at + grown];
    assert!(grown == 0 || Marker::find(inserted).is_some());
    [&after[..at], &after[at + grown..]].concat()
}
