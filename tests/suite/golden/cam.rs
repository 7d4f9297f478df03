//! Programs as long as CAM writes them, generated, compensated, and read back by a reader and an
//! inverse that are not the program's own.

use super::generated::{Generated, compensated};
use super::landing::{TOLERANCE_MM, closed_form};
use crate::path;
use poseshift::geometry::{Pose, Rotation};
use poseshift::model::Conditions;
use poseshift::model::profile::Profile;

const POINTS: u32 = 4000;
const EVERY: u32 = 2;

/// The number of `name="…"` in a tag.
fn attribute(tag: &str, name: &str) -> f64 {
    let behind = tag.split(&format!(" {name}=\"")).nth(1);
    let text = behind.and_then(|rest| rest.split('"').next());
    text.and_then(|text| text.parse().ok())
        .unwrap_or_else(|| panic!("{name} in {tag}"))
}

/// The numbers of the targets of straight moves: x, y, z in mm, three angles in degrees.
fn numbers(language: &str, text: &str) -> Vec<[f64; 6]> {
    match language {
        "val3" => {
            let tags = text.lines().filter(|line| line.contains(" x=\""));
            let of = |tag| ["x", "y", "z", "rx", "ry", "rz"].map(|name| attribute(tag, name));
            tags.map(of).collect()
        }
        "kawasaki" => {
            let moves = text.split("LMOVE TRANS(").skip(1);
            let of = |rest: &str| {
                let inside = rest.split(')').next().expect("a bracket that closes");
                let all: Vec<f64> = inside.split(',').map(|n| n.parse().expect(n)).collect();
                all.try_into().expect("six numbers")
            };
            moves.map(of).collect()
        }
        _ => panic!("{language} is not read here"),
    }
}

/// The pose that they are.
fn pose(language: &str, [x, y, z, a, b, c]: [f64; 6]) -> Pose {
    let [a, b, c] = [a, b, c].map(f64::to_radians);
    let rotation = match language {
        "val3" => Rotation::about_x(a) * Rotation::about_y(b) * Rotation::about_z(c),
        _ => Rotation::about_z(a) * Rotation::about_y(b) * Rotation::about_z(c),
    };
    Pose {
        rotation,
        translation: [x, y, z].map(|mm| mm * 1e-3),
    }
}

/// What is no number in the lines of a text that have this.
fn around(text: &str, having: &str) -> Vec<String> {
    let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-');
    let lines = text
        .split_inclusive('\n')
        .filter(|line| line.contains(having));
    lines.map(|line| line.replace(is_number, "")).collect()
}

#[test]
fn programs_as_long_as_cam_writes_them_land() {
    for (language, ending, having) in [("val3", "dtx", " x=\""), ("kawasaki", "as", "TRANS(")] {
        let Generated { folder, targets } = compensated((language, ending), POINTS, EVERY);
        let at = |name: &str| folder.path().join(name);
        let before = path::program(language, POINTS, EVERY);
        let file = format!("path.{ending}");
        let after = std::fs::read_to_string(at("out").join(&file)).expect("it was written");
        assert_eq!(
            around(&after, having),
            around(&before, having),
            "{language}"
        );
        if let Some((name, text)) = path::given(language, POINTS) {
            let written = std::fs::read_to_string(at("out").join(name));
            assert_eq!(written.expect("all of a project is written"), text);
        }
        let (wanted, fake) = (numbers(language, &before), numbers(language, &after));
        let count = POINTS as usize;
        assert_eq!(
            (wanted.len(), fake.len(), targets.len()),
            (count, count, count)
        );
        let profile = Profile::from_yaml(&path::profile(language)).expect("a valid profile");
        let tool = profile.tool("artifact").expect("its tool");
        let real = profile.real_model(&tool, &Conditions::default());
        for ((wanted, fake), reported) in wanted.into_iter().zip(fake).zip(&targets) {
            let near: Vec<f64> =
                serde_json::from_value(reported["joints_deg"].clone()).expect("joints");
            let near = std::array::from_fn(|i| near[i].to_radians());
            let q = closed_form(&pose(language, fake), &tool, &near);
            let landed = real.forward(&q, &Conditions::default());
            let offset_mm = 1e3 * landed.separation(&pose(language, wanted)).distance_m;
            let rounding_mm = reported["rounding_mm"].as_f64().expect("a number");
            assert!(
                (offset_mm - rounding_mm).abs() < TOLERANCE_MM,
                "{language}: {reported} {offset_mm}"
            );
            assert!(wanted != fake, "the arm is calibrated");
        }
    }
}
