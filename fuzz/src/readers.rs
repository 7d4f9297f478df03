//! Readers of what is no program: meshes, URDF, profiles, cells, frames, stored runs, tables, and what controllers have.
//! Each says whether it took the bytes, and panics where something does not hold that must hold for any. The suite damages
//! the seeds and calls the same functions.

use poseshift::check::baseline as stored;
use poseshift::check::cell::Cell;
use poseshift::check::mesh::Mesh;
use poseshift::geometry::Pose;
use poseshift::identify::measurements::Measurements;
use poseshift::identify::simulate::Session;
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use poseshift::program::Source;
use poseshift::register::frame_file::Frame;
use poseshift::register::handeye::Setup;
use poseshift::task::register::{Construction, Options, Pairing, register as registered};
use poseshift::task::{ProfileFile, Rows, Said};
use poseshift::task::{axes, fk, handeye as camera, hexapod as ballbar, ik, plan, profile as arm};
use poseshift::task::{frame as frame_of, simulate};
use poseshift::urdf::{About, Choice, UrdfArm, profile_text};
use std::sync::OnceLock;

/// What stands between files where several are read: a byte that no text has.
const BETWEEN_FILES: u8 = 0;
/// What stands before the name of a file that has one of its own; a line feed ends the name.
const BEFORE_NAME: u8 = 1;

/// A file's name, where it has one of its own, and its bytes.
fn named(bytes: &[u8]) -> (Option<String>, &[u8]) {
    if let Some((&BEFORE_NAME, named)) = bytes.split_first()
        && let Some(end) = named.iter().position(|byte| *byte == b'\n')
    {
        let name = String::from_utf8_lossy(&named[..end]).into_owned();
        return (Some(name), &named[end + 1..]);
    }
    (None, bytes)
}

/// The files that some bytes are; those without a name of their own have these endings in turn.
pub fn files(bytes: &[u8], endings: &[&str]) -> Vec<Source> {
    let parts = bytes.split(|byte| *byte == BETWEEN_FILES).enumerate();
    let file = |(at, part): (usize, &[u8])| {
        let (name, bytes) = named(part);
        let name = name.unwrap_or_else(|| format!("fuzz{at}.{}", endings[at % endings.len()]));
        Source::new(name, bytes.to_vec())
    };
    parts.map(file).collect()
}

/// A file of some bytes.
fn file(name: &str, bytes: &[u8]) -> Source {
    Source::new(name, bytes.to_vec())
}

/// A calibrated arm, and one of each maker whose controllers' files are read: ABB, KUKA, Universal Robots.
fn arms() -> &'static [ProfileFile; 4] {
    static ARMS: OnceLock<[ProfileFile; 4]> = OnceLock::new();
    ARMS.get_or_init(|| {
        [
            include_str!("../../robots/abb_irb120_thesis.yaml"),
            include_str!("../../robots/abb_irb120.yaml"),
            include_str!("../../robots/kuka_kr6_r900.yaml"),
            include_str!("../../robots/universal_robots_ur5.yaml"),
        ]
        .map(|text| {
            ProfileFile::read(&file("arm.yaml", text.as_bytes())).expect("a shipped profile")
        })
    })
}

/// What is written as a frame reads back as one.
fn is_frame(text: &str) -> bool {
    let frame = Frame::from_yaml(text).expect("a frame that is written reads back");
    let place = frame.to_from_from.translation;
    assert!(place.iter().all(|x| x.is_finite()));
    true
}

/// What is written as a profile reads back as one.
fn is_profile(text: &str) -> bool {
    Profile::from_yaml(text).expect("a profile that is written reads back");
    true
}

/// A mesh in the format of this ending. Behind a text and a zero byte stands the file that it names.
pub fn mesh(ending: &str, bytes: &[u8]) -> bool {
    let is_text = matches!(bytes.first(), Some(&(BEFORE_NAME | b'{')));
    let between = bytes.iter().position(|byte| *byte == BETWEEN_FILES);
    let (own, next_to_it) = match between.filter(|_| is_text) {
        Some(at) => (&bytes[..at], Some(&bytes[at + 1..])),
        None => (bytes, None),
    };
    let neighbour = |_: &str| {
        let found = next_to_it.map(|bytes| named(bytes).1.to_vec());
        found.ok_or_else(|| "there is none".to_owned())
    };
    let (_, own) = named(own);
    let name = format!("fuzz.{ending}");
    let mut is_taken = false;
    for scale in [None, Some([1.0; 3])] {
        if let Ok(mesh) = Mesh::read(&name, own, scale, &neighbour) {
            assert!(!mesh.triangles.is_empty());
            assert!(mesh.bounds().iter().flatten().all(|x| x.is_finite()));
            is_taken = true;
        }
    }
    is_taken
}

/// A URDF, and the profile that is made of it.
pub fn urdf(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return false;
    };
    let choice = Choice {
        shapes: true,
        ..Choice::default()
    };
    let read = UrdfArm::read(text, &choice);
    if let Ok(arm) = &read
        && let Ok((text, _)) = profile_text(arm, &About::of("fuzz.urdf", &|_| None))
    {
        is_profile(&text);
    }
    read.is_ok()
}

/// A profile, also changed, written and exported.
pub fn profile(bytes: &[u8]) -> bool {
    let Ok(read) = ProfileFile::read(&file("fuzz.yaml", bytes)) else {
        return false;
    };
    let model = read.profile.controller_model(&Mounted::flange());
    let pose = model.forward(&[0.0; 6], &Conditions::default());
    assert!(pose.translation.iter().all(|x| x.is_finite()));
    let _ = arm::show(&read.profile);
    let _ = arm::export(&read, None);
    let values = ["robot.serial=120-500123", "kinematics.joints.3.max_deg=70"];
    if let Ok(changed) = arm::set(&read, &values.map(str::to_owned), "set.yaml") {
        is_profile(&changed.text);
    }
    if let Ok(text) = read.rewritten(&read.profile) {
        is_profile(&text);
    }
    true
}

/// A cell.
pub fn cell(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|text| Cell::from_yaml(text).is_ok())
}

/// Measurements; two files are joints and points.
pub fn measurements(bytes: &[u8]) -> bool {
    if let Ok(measurements) = Measurements::from_csv(bytes) {
        let mut rows = measurements.rows.iter();
        assert!(rows.all(|row| row.q.iter().all(|x| x.is_finite())));
    }
    let (said, profile) = (Said::default(), &arms()[0].profile);
    match files(bytes, &["csv"]).as_slice() {
        [joints, points] => Rows::joined(joints, points, &said, profile).is_ok(),
        // UTF-16 has zero bytes
        _ => Rows::read(&[file("fuzz.csv", bytes)], &said, profile).is_ok(),
    }
}

/// The file of a frame.
pub fn frame(bytes: &[u8]) -> bool {
    frame_of(&file("fuzz.yaml", bytes)).is_ok_and(|frame| is_frame(&frame.to_yaml()))
}

/// A stored run of `check`, compared with itself.
pub fn baseline(bytes: &[u8]) -> bool {
    let text = std::str::from_utf8(bytes).ok();
    let Some(run) = text.and_then(|text| stored::read(text).ok()) else {
        return false;
    };
    let compared = stored::compare(&run, &run, stored::Tolerances::default());
    let _ = stored::text(&compared);
    true
}

/// Points and those that they are matched with; one file alone has touches that make a frame.
pub fn register(bytes: &[u8]) -> bool {
    let parts = files(bytes, &["csv"]);
    let pairings = match parts.as_slice() {
        [_, to, ..] => vec![Pairing::Rows(to)],
        _ => vec![
            Pairing::Frame(Construction::ThreePoints),
            Pairing::Frame(Construction::ThreeTwoOne),
        ],
    };
    let mut is_taken = false;
    for pairing in &pairings {
        if let Ok(found) = registered(&parts[0], pairing, &Options::default()) {
            is_taken |= found.is_refused() || is_frame(&found.frame_text());
        }
    }
    is_taken
}

/// Poses of a robot, those of a board, and corners.
pub fn handeye(bytes: &[u8]) -> bool {
    let parts = files(bytes, &["csv"]);
    let [robot, board, corners @ ..] = parts.as_slice() else {
        return false;
    };
    let mut is_taken = false;
    // joints need an arm, poses have none
    for profile in [None, Some(&arms()[0])] {
        let corners = corners.first();
        let inputs = camera::Inputs {
            robot,
            board,
            profile,
            tool: None,
            corners,
        };
        for setup in [Setup::EyeToHand, Setup::EyeInHand] {
            if let Ok(found) = camera::handeye(&inputs, setup) {
                is_taken |= is_frame(&found.frame_text);
            }
        }
    }
    is_taken
}

/// Lengths of a ballbar, or the taught balls of its base.
pub fn hexapod(bytes: &[u8]) -> bool {
    let source = file("fuzz.csv", bytes);
    let poses = ballbar::poses(&source, 1e-6);
    if let Ok(poses) = &poses {
        let _ = poses.measurements(&Pose::identity());
    }
    let base = ballbar::base(&source, [0.3; 3]);
    poses.is_ok() | base.is_ok_and(|base| is_frame(&base.frame_text))
}

/// Sweeps of single joints.
pub fn sweeps(bytes: &[u8]) -> bool {
    axes::axes(&arms()[0], &file("fuzz.csv", bytes), None).is_ok()
}

/// Joint angles, or poses of the tool.
pub fn joints(bytes: &[u8]) -> bool {
    let (arm, table) = (&arms()[0], file("fuzz.csv", bytes));
    let there = fk::fk(arm, &table, &fk::Options::default());
    let back = ik::ik(arm, &table, &fk::Options::default(), true);
    let _ = plan::given(&table, &arm.profile);
    let _ = simulate::simulate(arm, &table, None, &Session::default());
    there.is_ok() | back.is_ok()
}

/// The calibration of a Universal Robots controller: `calibration.conf`, or the file of its ROS driver.
pub fn ur(bytes: &[u8]) -> bool {
    arm::import_ur(&file("fuzz.conf", bytes), &arms()[3], "ur.yaml")
        .is_ok_and(|imported| is_profile(&imported.text))
}

/// `MOC.cfg` of an ABB controller.
pub fn moc(bytes: &[u8]) -> bool {
    let chosen = (None, Some("eax_a"));
    arm::import_moc(&file("MOC.cfg", bytes), &arms()[1], chosen, "moc.yaml")
        .is_ok_and(|changed| is_profile(&changed.text))
}

/// `$machine.dat` and `$config.dat` of a KUKA controller.
pub fn krc(bytes: &[u8]) -> bool {
    arm::import_krc(&files(bytes, &["dat"]), &arms()[2], "krc.yaml")
        .is_ok_and(|changed| is_profile(&changed.text))
}
