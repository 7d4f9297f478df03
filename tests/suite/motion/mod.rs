//! What a program makes the robot do: where straight moves end, from which side joints come, which
//! tool holds.

mod arcs;
mod assumed;
mod bounds;
mod calls;
mod decided;
mod displaced;
mod displaced_alone;
mod followed;
mod foreign;
mod given;
mod jobs;
mod kawasaki;
mod krl;
mod led;
mod listings;
mod nearest;
mod parts;
mod registers;
mod rotations;
mod rows;
mod split;
mod straight;
mod taken_up;
mod tipped;
mod wrist;

use crate::support::repository;
use poseshift::check::{Check, Scene, Subject, check};
use poseshift::compensate::{CompensateError, Compensation, Given, Options, compensate};
use poseshift::finding::Severity;
use poseshift::geometry::Pose;
use poseshift::model::profile::{Mounted, Profile};
use poseshift::program::{self, Source};

/// Effects of the arm of these tests.
const PLAIN: &str = "{effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}";
const BACKLASH: &str = "{effect: backlash, joint: 2, width_deg: -0.1}";

fn profile(effects: &[&str]) -> Profile {
    profile_of("robots/abb_irb120.yaml", effects)
}

fn profile_of(robot: &str, effects: &[&str]) -> Profile {
    let text = std::fs::read_to_string(repository(robot)).expect("a profile");
    let plain = &text[..text.find("calibration:").expect("a list of effects")];
    let effects = effects.join(", ");
    Profile::from_yaml(&format!("{plain}calibration: {{effects: [{effects}]}}\n"))
        .expect("a profile")
}

#[expect(clippy::needless_pass_by_value, reason = "each test makes its own")]
fn try_with(
    options: Options,
    effects: &[&str],
    files: &[(&str, &str)],
) -> Result<Compensation, CompensateError> {
    let sources: Vec<Source> = files
        .iter()
        .map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()))
        .collect();
    let language = program::language_of(&sources[0]).expect("a language");
    compensate(language, &sources, &profile(effects), &options)
}

fn given() -> Options {
    let mut given = Given::default();
    given.tools.insert(None, Mounted::flange());
    given.frames.insert(None, Pose::identity());
    Options {
        given,
        ..Options::default()
    }
}

fn done(effects: &[&str], files: &[(&str, &str)]) -> Compensation {
    try_with(given(), effects, files).expect("read")
}

fn errors(done: &Compensation) -> Vec<&'static str> {
    let errors = done
        .findings
        .iter()
        .filter(|f| f.severity == Severity::Error);
    errors.map(|f| f.id).collect()
}

/// What is written instead of the targets that change.
fn fakes(done: &Compensation) -> Vec<Pose> {
    assert_eq!(errors(done), [""; 0], "{:?}", done.findings);
    done.targets
        .iter()
        .filter_map(|target| target.fake)
        .collect()
}

/// The message of an error, which must be there.
fn message<'a>(done: &'a Compensation, id: &str) -> &'a str {
    let found = done.findings.iter().find(|f| f.id == id);
    &found
        .unwrap_or_else(|| panic!("{id} in {:?}", done.findings))
        .message
}

fn rapid(data: &str, body: &str) -> String {
    format!("MODULE t\n{data}\nPROC main()\n{body}\nENDPROC\nENDMODULE\n")
}

const P: &str = "[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

/// What `check` says of programs, next to those that they were made of.
fn checked(profile: &Profile, sources: &[Source], nominal: Option<&[Source]>) -> Check {
    let scene = Scene::default();
    let subject = Subject {
        language: program::language_of(&sources[0]).expect("a language"),
        sources,
        nominal,
        profile,
        scene: &scene,
    };
    let options = poseshift::check::Options {
        given: given().given,
        ..poseshift::check::Options::default()
    };
    check(&subject, &options).expect("checked")
}

/// The farthest that a written program lands from where the original wants the tool at targets that
/// are poses, mm.
fn landings(effects: &[&str], written: &[(&str, &str)], original: &[(&str, &str)]) -> f64 {
    let read = |files: &[(&str, &str)]| -> Vec<Source> {
        files
            .iter()
            .map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()))
            .collect()
    };
    let (written, original) = (read(written), read(original));
    let profile = profile(effects);
    let checked = checked(&profile, &written, Some(&original));
    let poses = checked
        .moves
        .iter()
        .filter(|m| !m.in_joints(&checked.program));
    1e3 * poses.map(|m| m.target_error.distance_m).fold(0.0, f64::max)
}
