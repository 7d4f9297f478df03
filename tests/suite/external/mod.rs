//! Tracks and positioners: where the real tool lands on the real part, by a reference that shares
//! no code with the product.

mod arcs;
mod attached;
mod checked;
mod coordinated;
mod derived;
mod joints;
mod landing;
mod measured;
mod named;
mod others;
mod plates;
mod programs;
mod refused;
mod switched;

use poseshift::compensate::{CompensateError, Compensation, Given, Options, compensate};
use poseshift::finding::Severity;
use poseshift::geometry::Pose;
use poseshift::model::profile::{Mounted, Profile};
use poseshift::program::{self, Source};

/// An IRB 120 with these external axes and effects.
fn profile(external: &str, effects: &[&str]) -> Profile {
    let text = profile_text(external, effects);
    Profile::from_yaml(&text).unwrap_or_else(|error| panic!("{error}\n{external}"))
}

/// The same with its base where controllers count from that know of no other.
fn profile_at_home(effects: &[&str]) -> Profile {
    Profile {
        world_from_base: Pose::identity(),
        ..profile("", effects)
    }
}

/// The same as a file.
fn profile_text(external: &str, effects: &[&str]) -> String {
    let text = crate::support::text("robots/abb_irb120.yaml");
    let plain = &text[..text.find("calibration:").expect("a list of effects")];
    let base = "base: {x_mm: 0, y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0}";
    assert!(plain.contains(base));
    let plain = plain.replace(
        base,
        "base: {x_mm: 250, y_mm: -100, z_mm: 400, rx_deg: 0.5, ry_deg: -0.3, rz_deg: 30}",
    );
    let effects = effects.join(", ");
    format!("{plain}{external}calibration: {{effects: [{effects}]}}\n")
}

fn options() -> Options {
    let mut given = Given::default();
    given.tools.insert(None, tool());
    given.frames.insert(None, Pose::identity());
    Options {
        given,
        ..Options::default()
    }
}

/// The tool of all programs here; its mass makes the joints give way.
fn tool() -> Mounted {
    Mounted {
        name: "t".into(),
        flange_from_tool: Pose::from_xyz_rxryrz([0.03, -0.02, 0.11, 0.1, 0.2, -0.3]),
        load: Some((2.0, [0.01, 0.0, 0.06])),
    }
}

fn sources(files: &[(&str, &str)]) -> Vec<Source> {
    let read = |(name, text): &(&str, &str)| Source::new(*name, text.as_bytes().to_vec());
    files.iter().map(read).collect()
}

fn run(profile: &Profile, files: &[(&str, &str)]) -> Result<Compensation, CompensateError> {
    let sources = sources(files);
    let language = program::language_of(&sources[0]).expect("a language");
    compensate(language, &sources, profile, &options())
}

fn errors(done: &Compensation) -> Vec<&'static str> {
    let found = done.findings.iter();
    let mut errors: Vec<_> = found
        .filter(|f| f.severity == Severity::Error)
        .map(|f| f.id)
        .collect();
    errors.sort_unstable();
    errors
}

/// The written text of the first file.
fn written(profile: &Profile, files: &[(&str, &str)]) -> String {
    let sources = sources(files);
    let language = program::language_of(&sources[0]).expect("a language");
    let done = compensate(language, &sources, profile, &options()).expect("read");
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
    let written = done
        .written(language, &sources, "", false)
        .expect("written");
    String::from_utf8(written.sources[0].bytes.clone()).expect("ASCII")
}

fn rapid(data: &str, body: &str) -> String {
    format!("MODULE t\n{data}\nPROC main()\nConfJ\\Off;\nConfL\\Off;\n{body}ENDPROC\nENDMODULE\n")
}
