//! What must hold for any bytes as a program: no panic, no hang; what is written reads back as the same program; a profile
//! without effects changes nothing. And for any bytes as what every other reader takes: no panic, no hang; what is taken has
//! finite numbers, and profiles and frames that are made of it read back.

mod journal;
pub mod readers;

pub use journal::journal;

use poseshift::compensate::{Given, Options, compensate};
use poseshift::geometry::Pose;
use poseshift::model::profile::{Mounted, Profile};
use poseshift::program::{LANGUAGES, Marker, Settings};
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
    let sources = readers::files(bytes, extensions);
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
