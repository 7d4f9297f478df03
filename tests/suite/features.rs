//! What the library costs without command line and pages, and where its features are written down.

use crate::support::text;
use std::collections::BTreeSet;
use std::process::Command;

/// The library alone builds with so much of the crates of the whole, or less.
const MOST_SHARE: f64 = 0.6;

/// The crates of others in a build, procedural macros among them.
fn crates(words: &[&str]) -> BTreeSet<String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args([
            "tree",
            "--offline",
            "--locked",
            "-e",
            "normal",
            "--prefix",
            "none",
        ])
        .args(words)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo starts");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    let lines = String::from_utf8(output.stdout).expect("UTF-8");
    // name and version; what stands behind says whether it is listed again
    let names = lines
        .lines()
        .map(|line| line.split(' ').take(2).collect::<Vec<_>>().join(" "));
    names
        .filter(|name| !name.is_empty() && !name.starts_with("poseshift"))
        .collect()
}

#[test]
fn the_library_alone_takes_60_percent_of_the_crates_or_fewer() {
    let whole = crates(&[]);
    let alone = crates(&["--no-default-features"]);
    assert!(alone.is_subset(&whole));
    assert!(alone.len() > 20, "{alone:?}");
    let share = alone.len() as f64 / whole.len() as f64;
    assert!(
        share <= MOST_SHARE,
        "{} of {} crates, {:.1} %: a feature should bring what is not always needed\n{}",
        alone.len(),
        whole.len(),
        100.0 * share,
        alone.into_iter().collect::<Vec<_>>().join("\n")
    );
}

#[test]
fn every_feature_is_documented() {
    let manifest = text("Cargo.toml");
    let (_, features) = manifest.split_once("\n[features]\n").expect("features");
    let names: Vec<&str> = features
        .lines()
        .take_while(|line| !line.starts_with('['))
        .filter(|line| line.starts_with(|c: char| c.is_ascii_lowercase()))
        .filter_map(|line| line.split_once(" = "))
        .map(|(name, _)| name)
        .collect();
    assert!(names.contains(&"cli") && names.len() > 4, "{names:?}");
    for file in ["docs/architecture.md", "src/lib.rs"] {
        let said = text(file);
        for name in names.iter().filter(|name| **name != "default") {
            assert!(said.contains(&format!("`{name}`")), "{file}: {name}");
        }
    }
}
