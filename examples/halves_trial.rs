//! What a diagnosis of one half of real measurements is worth on the other half.
//!
//! `cargo run --release --example halves_trial -- FOLDER`, with a folder for each robot that has
//! `profile.yaml` and `fit.csv`. Every other configuration calibrates the robot (level 3) and is
//! diagnosed; the profile written is validated on the others, and conversely. How far each joint
//! moved last is by the order of the whole file.

use clap::Parser;
use poseshift::diagnose::{Options, Verdict, diagnose};
use poseshift::identify::calibration::{Options as Calibrating, calibrate};
use poseshift::identify::measurements::{Measurements, last_moves};
use poseshift::identify::validation::{Refit, validate};
use poseshift::model::profile::Profile;
use std::path::{Path, PathBuf};

/// Diagnose halves of real measurements and judge the profiles on the other halves
#[derive(Parser)]
struct Trial {
    /// Folder with a folder for each robot
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Robots, by the names of their folders; all without
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
}

/// Mean position error on rows that a profile was not made with, mm.
fn mean_mm(profile: &Profile, rows: &Measurements) -> f64 {
    let judged = validate(profile, rows, Refit::No, None).expect("rows of this robot");
    judged.real.quality.position.expect("positions").mean
}

/// The rows of every other configuration.
fn half(all: &Measurements, which: usize) -> Measurements {
    let configurations = all.configurations();
    all.filtered(|row, _| configurations[row] % 2 == which)
}

/// Prints one robot's halves.
fn halves(folder: &Path, name: &str) {
    let read = |name: &str| std::fs::read(folder.join(name)).expect("a file of the folder");
    let text = String::from_utf8(read("profile.yaml")).expect("a text");
    let nominal = Profile::from_yaml(&text).expect("a profile");
    let mut all = Measurements::from_csv(&read("fit.csv")).expect("measurements");
    let postures: Vec<[f64; 6]> = all.rows.iter().map(|row| row.q).collect();
    for (row, moved) in all.rows.iter_mut().zip(last_moves(&postures)) {
        row.conditions.moved = moved;
    }
    let mut named: Vec<Vec<String>> = Vec::new();
    for which in 0..2 {
        let (own, others) = (half(&all, which), half(&all, 1 - which));
        let calibrated = calibrate(&nominal, &own, &Calibrating::default());
        let profile = calibrated.expect("enough rows").profile();
        let found = diagnose(&profile, &own, &Options::default(), &mut |_| ());
        let found = found.expect("a diagnosis");
        let written = match found.verdict {
            Verdict::Undetermined => "nothing written".to_owned(),
            _ => format!("{:.3} mm", mean_mm(&found.profile, &others)),
        };
        let labels: Vec<String> = found.found.iter().map(|f| f.effect.label()).collect();
        println!(
            "{name}, half {}: level 3 {:.3} mm, diagnosed {written} [{}] {}",
            which + 1,
            mean_mm(&profile, &others),
            found.verdict.id(),
            labels.join(", ")
        );
        for reason in &found.reasons {
            println!("    {reason}");
        }
        named.push(labels);
    }
    let both = named[0].iter().filter(|label| named[1].contains(label));
    let both: Vec<&str> = both.map(String::as_str).collect();
    println!("{name}, both: {}", both.join(", "));
}

fn main() {
    let asked = Trial::parse();
    let folders = std::fs::read_dir(&asked.folder).expect("a folder");
    let folders = folders.map(|entry| entry.expect("an entry").path());
    let mut folders: Vec<PathBuf> = folders
        .filter(|path| path.join("profile.yaml").is_file())
        .collect();
    folders.sort();
    for folder in folders {
        let name = folder.file_name().expect("a name").to_string_lossy();
        if asked.only.is_empty() || asked.only.iter().any(|only| *only == name) {
            halves(&folder, &name);
        }
    }
}
