//! What must hold for any bytes as a program: no panic, no hang; what is written reads back as the same program; a profile
//! without effects changes nothing. And for any bytes as a mesh, a URDF, a profile, a cell, or measurements: no panic, no hang;
//! what is taken has finite numbers, and a profile made of a URDF is one.

use poseshift::check::cell::Cell;
use poseshift::check::mesh::Mesh;
use poseshift::compensate::{Given, Options, compensate};
use poseshift::geometry::Pose;
use poseshift::identify::measurements::Measurements;
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use poseshift::program::{LANGUAGES, Marker, Settings, Source};
use poseshift::urdf::{About, Choice, UrdfArm, profile_text};
use std::sync::OnceLock;

/// A calibrated arm, and the same without its calibration.
fn profiles() -> &'static [Profile; 2] {
    static PROFILES: OnceLock<[Profile; 2]> = OnceLock::new();
    PROFILES.get_or_init(|| {
        let text = include_str!("../../robots/abb_irb120_thesis.yaml");
        let mut calibrated = Profile::from_yaml(text).expect("a shipped profile");
        calibrated.pulses_per_deg = Some([1000.0; 6]);
        let mut nominal = calibrated.clone();
        nominal.effects.clear();
        [calibrated, nominal]
    })
}

fn options() -> &'static Options {
    static OPTIONS: OnceLock<Options> = OnceLock::new();
    OPTIONS.get_or_init(|| {
        let mut given = Given::default();
        given.tools.insert(None, Mounted::flange());
        given
            .frames
            .insert(None, Pose::from_translation(0.3, 0.0, 0.4));
        Options {
            given,
            correct_joint_targets: true,
            ..Options::default()
        }
    })
}

/// What stands between the files of a program that has several: a byte that no text has.
const BETWEEN_FILES: u8 = 0;

/// Reads, compensates and reads again.
///
/// # Panics
/// Where something does not hold.
pub fn check(id: &str, bytes: &[u8]) {
    let language = LANGUAGES
        .iter()
        .find(|language| language.about().id == id)
        .expect("a language");
    let extensions = language.about().extensions;
    let sources: Vec<Source> = bytes
        .split(|byte| *byte == BETWEEN_FILES)
        .enumerate()
        .map(|(at, bytes)| {
            let name = format!("fuzz{at}.{}", extensions[at % extensions.len()]);
            Source::new(name, bytes.to_vec())
        })
        .collect();
    for source in &sources {
        let _ = language.recognises(source);
    }
    let [calibrated, nominal] = profiles();
    let settings = Settings {
        pulses_per_deg: calibrated.pulses_per_deg,
        ..Settings::default()
    };
    let Ok(program) = poseshift::motion::read(*language, &sources, &settings) else {
        return;
    };
    for target in &program.targets {
        let length = sources[target.file as usize].bytes.len();
        for number in program.numbers_of(target) {
            let end = number.start as usize + usize::from(number.length);
            assert!(end <= length && number.value.is_finite());
        }
    }
    let as_simulated = Options {
        work_offset: Some(Pose::identity()),
        ..options().clone()
    };
    if let Ok(same) = compensate(*language, &sources, nominal, &as_simulated) {
        assert!(
            same.edits.iter().all(poseshift::program::Edits::is_empty),
            "identity changes the file"
        );
    }
    if let Ok(compensation) = compensate(*language, &sources, calibrated, options()) {
        let is_marked = compensation.compensated.clone();
        // every number is read again and compared with what was meant
        let written = compensation
            .written(*language, &sources, &"0".repeat(64), false)
            .expect("what is written reads back as what was meant");
        for (at, source) in sources.iter().enumerate() {
            assert_eq!(
                Marker::find(&written.sources[at].bytes).is_some(),
                is_marked[at] || Marker::find(&source.bytes).is_some()
            );
        }
    }
}

/// Reads a mesh in the format of this ending, nothing next to it.
///
/// # Panics
/// Where something does not hold.
pub fn mesh(ending: &str, bytes: &[u8]) {
    let nothing = |_: &str| Err("there is none".to_owned());
    if let Ok(mesh) = Mesh::read(&format!("fuzz.{ending}"), bytes, Some([1.0; 3]), &nothing) {
        assert!(!mesh.triangles.is_empty());
        assert!(mesh.bounds().iter().flatten().all(|x| x.is_finite()));
    }
}

/// Reads a URDF, and the profile that is made of it.
///
/// # Panics
/// Where something does not hold.
pub fn urdf(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let choice = Choice {
        shapes: true,
        ..Choice::default()
    };
    if let Ok(arm) = UrdfArm::read(text, &choice)
        && let Ok((text, _)) = profile_text(&arm, &About::of("fuzz.urdf", &|_| None))
    {
        Profile::from_yaml(&text).expect("what is made of a URDF is a profile");
    }
}

/// Reads a profile.
///
/// # Panics
/// Where something does not hold.
pub fn profile(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    if let Ok(profile) = Profile::from_yaml(text) {
        let tool = Mounted::flange();
        let conditions = Conditions::default();
        let pose = profile.controller_model(&tool).forward(&[0.0; 6], &conditions);
        assert!(pose.translation.iter().all(|x| x.is_finite()));
    }
}

/// Reads a cell.
pub fn cell(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = Cell::from_yaml(text);
    }
}

/// Reads measurements.
///
/// # Panics
/// Where something does not hold.
pub fn measurements(bytes: &[u8]) {
    if let Ok(measurements) = Measurements::from_csv(bytes) {
        for row in &measurements.rows {
            assert!(row.q.iter().all(|x| x.is_finite()));
        }
    }
}
