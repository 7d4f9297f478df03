//! A profile file with another calibration: everything else stays as a person wrote it, comments
//! included.

use super::reading::beyond_payload;
use super::text::gravity;
use super::{Profile, ProfileError, Theirs};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::effects::Effect;
use crate::printable::{flow, quoted};
use serde_json::{Value, json};

/// Why a profile could not be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WriteError {
    /// The text that was made is no profile: a fault of the original's layout.
    #[error("the profile's layout is too unusual to change it in place: {error}")]
    Layout {
        /// What reading it back says.
        error: ProfileError,
    },
    /// The text that was made says something else.
    #[error("the profile's layout is too unusual to change `{key}` in place")]
    Differs {
        /// The part that is not what it should be.
        key: &'static str,
    },
}

/// One top key with its lines.
fn sections(text: &str) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = vec![(String::new(), String::new())];
    for line in text.split_inclusive('\n') {
        let starts = line
            .chars()
            .next()
            .is_some_and(|c| c.is_alphabetic() || c == '_' || c == '"');
        if let Some((key, _)) = line.split_once(':').filter(|_| starts) {
            all.push((key.trim().trim_matches('"').to_owned(), String::new()));
        }
        all.last_mut().expect("never empty").1.push_str(line);
    }
    all
}

/// A pose in flow style.
pub(super) fn flow_pose(pose: &Pose) -> String {
    let [x, y, z] = pose.translation.map(mm_from_m);
    let [_, _, _, rx, ry, rz] = pose.xyz_rxryrz();
    let [rx, ry, rz] = [rx, ry, rz].map(|angle| angle / DEG);
    format!(
        "{{x_mm: {}, y_mm: {}, z_mm: {}, rx_deg: {}, ry_deg: {}, rz_deg: {}}}",
        json!(x),
        json!(y),
        json!(z),
        json!(rx),
        json!(ry),
        json!(rz)
    )
}

/// `kinematics` with another base.
fn with_base(section: &str, base: &Pose) -> String {
    let line = format!("  base: {}\n", flow_pose(base));
    let mut out = String::new();
    let (mut done, mut inside) = (false, false);
    for (number, text) in section.split_inclusive('\n').enumerate() {
        let trimmed = text.trim_start();
        let indent = text.len() - trimmed.len();
        if inside {
            // the rest of an entry that goes over several lines
            let more = indent > 2 || trimmed.starts_with('}') || trimmed.is_empty();
            if more {
                continue;
            }
            inside = false;
        }
        if trimmed.starts_with("base:") && indent > 0 && !done {
            out += &" ".repeat(indent);
            out += line.trim_start();
            (done, inside) = (true, true);
            continue;
        }
        out += text;
        if number == 0 && !section.contains("base:") {
            out += &line;
            done = true;
        }
    }
    out
}

/// The effects that a profile has: those of one session's measurements are none of the robot's.
fn of_robot(profile: &Profile) -> impl Iterator<Item = &Effect> {
    let all = profile.effects.iter();
    all.filter(|effect| !effect.definition().of_data)
}

/// First line of a profile whose calibration is not that of the file it was made from.
const IDENTIFIED: &str = "# Its calibration was identified by poseshift from measurements (quality \
    and provenance below). The other comments are of the\n\
     # profile that it started from: what they say of effects is not of this one.\n";

/// Why an effect that was identified may be beyond the usual.
const IDENTIFIED_LARGE: &str = "identified from measurements";

/// The section `calibration`.
fn calibration(profile: &Profile) -> String {
    let mut out = String::from("calibration:\n");
    let mut effects = of_robot(profile).peekable();
    out += if effects.peek().is_none() {
        "  effects: []\n"
    } else {
        "  effects:\n"
    };
    for effect in effects {
        let mut entry = effect.to_entry();
        let reason = profile.large.calibration.get(&effect.label());
        let is_large = effect.beyond_usual().is_some()
            || beyond_payload(profile.payload_kg, &profile.tools, effect).is_some();
        let identified = || is_large.then_some(IDENTIFIED_LARGE);
        if let Some(reason) = reason.map(String::as_str).or_else(identified) {
            entry.push(("large", json!(true)));
            entry.push(("reason", json!(reason)));
        }
        let entry: Vec<String> = entry
            .into_iter()
            .map(|(key, value)| match value.as_str() {
                Some(id) if key == "effect" => format!("{key}: {id}"),
                _ => format!("{key}: {}", flow(&value)),
            })
            .collect();
        out += &format!("    - {{{}}}\n", entry.join(", "));
    }
    if let Some(device) = &profile.device {
        out += &device.lines();
    }
    for (key, value) in [
        ("quality", &profile.quality),
        ("provenance", &profile.provenance),
    ] {
        let Some(value) = value else { continue };
        match value.as_object() {
            Some(map) if !map.is_empty() => {
                out += &format!("  {key}:\n");
                for (key, value) in map {
                    out += &format!("    {key}: {}\n", rows(value));
                }
            }
            _ => out += &format!("  {key}: {}\n", flow(value)),
        }
    }
    out
}

/// A list of lists or objects has a line for each.
fn rows(value: &Value) -> String {
    match value.as_array() {
        Some(list) if list.iter().any(|item| item.is_array() || item.is_object()) => {
            let lines: Vec<String> = list
                .iter()
                .map(|item| format!("\n      - {}", flow(item)))
                .collect();
            lines.concat()
        }
        _ => flow(value),
    }
}

/// The section `points`.
fn points(profile: &Profile) -> String {
    if profile.points.is_empty() {
        return "points: {}\n".into();
    }
    let mut out = String::from("points:\n");
    for (name, point) in &profile.points {
        let [x, y, z] = point.map(|m| json!(mm_from_m(m)));
        out += &format!("  {}: [{x}, {y}, {z}]\n", quoted(name));
    }
    out
}

/// The section `measurement`.
fn measurement(profile: &Profile) -> String {
    let tables = &profile.tables;
    let mut out = String::from("measurement:\n");
    let pairs = tables.columns.iter();
    let pairs: Vec<String> = pairs
        .map(|(key, theirs)| match theirs {
            Theirs::One(name) => format!("{}: {}", quoted(key), quoted(name)),
            Theirs::Many(names) => {
                let names: Vec<String> = names.iter().map(|name| quoted(name)).collect();
                format!("{}: [{}]", quoted(key), names.join(", "))
            }
        })
        .collect();
    out += &format!("  columns: {{{}}}\n", pairs.join(", "));
    let units: Vec<String> = tables.units.iter().map(|unit| quoted(unit)).collect();
    out += &format!("  units: [{}]\n", units.join(", "));
    if let Some(euler) = &tables.euler {
        out += &format!("  euler: {}\n", quoted(euler));
    }
    out
}

/// The text of a profile file with the base, points and calibration of `profile`; every other
/// section is `text`'s.
///
/// # Errors
/// The text's layout does not allow it: what was made is read back and compared.
pub fn rewritten(text: &str, profile: &Profile) -> Result<String, WriteError> {
    let original = Profile::from_yaml(text).map_err(|error| WriteError::Layout { error })?;
    let mut out = String::new();
    let known = text.starts_with(IDENTIFIED);
    if profile.provenance.is_some() && profile.effects != original.effects && !known {
        out += IDENTIFIED;
    }
    let (mut had_points, mut had_calibration, mut had_measurement) = (false, false, false);
    let mut had_gravity = false;
    for (key, section) in sections(text) {
        match key.as_str() {
            "points" if original.points != profile.points => {
                had_points = true;
                out += &points(profile);
            }
            "measurement" if original.tables != profile.tables => {
                had_measurement = true;
                out += &measurement(profile);
            }
            "external_axes" if original.external != profile.external => {
                out += &super::external::section(&profile.external);
            }
            "calibration" => {
                had_calibration = true;
                out += &calibration(profile);
            }
            "gravity_m_s2" if original.gravity_m_s2 != profile.gravity_m_s2 => {
                had_gravity = true;
                out += &gravity(profile);
            }
            "kinematics" if original.world_from_base != profile.world_from_base => {
                out += &with_base(&section, &profile.world_from_base);
            }
            _ => out += &section,
        }
        if !out.is_empty() && !out.ends_with('\n') {
            out.push('\n');
        }
    }
    if !had_gravity && original.gravity_m_s2 != profile.gravity_m_s2 {
        out += &gravity(profile);
    }
    if !had_points && original.points != profile.points {
        out += &points(profile);
    }
    if !had_measurement && original.tables != profile.tables {
        out += &measurement(profile);
    }
    if !had_calibration {
        out += &calibration(profile);
    }
    let back = Profile::from_yaml(&out).map_err(|error| WriteError::Layout { error })?;
    let gap = back.world_from_base.separation(&profile.world_from_base);
    let differs = |key| Err(WriteError::Differs { key });
    if back.gravity_m_s2 != profile.gravity_m_s2 {
        return differs("gravity_m_s2");
    }
    if gap.distance_m > 1e-9 || gap.angle_rad > 1e-9 {
        return differs("base");
    }
    let apart = back
        .world_from_device()
        .separation(&profile.world_from_device());
    if back.device.is_some() != profile.device.is_some()
        || apart.distance_m > 1e-9
        || apart.angle_rad > 1e-9
    {
        return differs("world_from_device");
    }
    if back.effects.len() != of_robot(profile).count()
        || back
            .effects
            .iter()
            .zip(of_robot(profile))
            .any(|(a, b)| !a.same_place(b))
    {
        return differs("effects");
    }
    if back.tables != profile.tables {
        return differs("measurement");
    }
    let on_plates = |profile: &Profile| -> usize {
        let positioners = profile.external.positioners.iter();
        positioners.map(|positioner| positioner.points.len()).sum()
    };
    if on_plates(&back) != on_plates(profile) {
        return differs("external_axes");
    }
    if back.points.len() != profile.points.len() {
        return differs("points");
    }
    let same =
        back.links == profile.links && back.tools == profile.tools && back.bodies == profile.bodies;
    if !same {
        return differs("kinematics");
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::effects::{Kind, MOST_PARAMETERS, Site};

    #[test]
    fn comments_and_order_stay_and_the_calibration_is_read_back() {
        let text = include_str!("../../../robots/abb_irb120_thesis.yaml");
        let mut profile = Profile::from_yaml(text).expect("a shipped profile");
        profile.world_from_base = Pose::from_xyz_rxryrz([2.5, -1.0, 0.3, 0.2, -0.1, 3.0]);
        profile.points.insert("smr 1".into(), [0.01, -0.02, 0.1]);
        profile.effects.push(Effect {
            kind: Kind::ToolFrame,
            site: Site {
                tool: Some("artifact".into()),
                ..Site::default()
            },
            parameters: [1e-9; MOST_PARAMETERS],
        });
        profile.quality =
            Some(json!({"sigma_factor": 0.1, "track_mm": [[1.0, 2.5e-12], [0.0, 1.0]]}));
        let out = rewritten(text, &profile).expect("a plain layout");
        assert!(out.contains("# Bodies: the thesis."));
        assert!(out.contains("max_deg: 165, speed_deg_s: 250}"));
        let back = Profile::from_yaml(&out).expect("it was read back");
        assert_eq!(back.quality, profile.quality);
        for (a, b) in back.effects.iter().zip(&profile.effects) {
            for (x, y) in a.parameters.iter().zip(&b.parameters) {
                assert!((x - y).abs() <= 1e-15 * y.abs());
            }
        }
        assert_eq!(rewritten(&out, &profile).expect("its own layout"), out);
    }

    #[test]
    fn a_calibrated_profile_says_so_and_has_no_effect_of_the_data() {
        let text = include_str!("../../../robots/abb_irb120_thesis.yaml");
        let mut profile = Profile::from_yaml(text).expect("a shipped profile");
        profile.provenance = Some(json!({"rows": 50}));
        profile.effects[0].parameters[0] += 1e-4;
        profile.effects.push(Effect {
            kind: Kind::FrameShift,
            site: Site {
                order: 50,
                ..Site::default()
            },
            parameters: [1e-3; MOST_PARAMETERS],
        });
        let out = rewritten(text, &profile).expect("a plain layout");
        assert!(out.starts_with(IDENTIFIED) && !out.contains("frame_shift"));
        // once is enough
        let mut again = Profile::from_yaml(&out).expect("it was read back");
        again.effects[0].parameters[0] += 1e-4;
        let twice = rewritten(&out, &again).expect("its own layout");
        assert_eq!(twice.matches(IDENTIFIED).count(), 1);
    }

    #[test]
    fn a_base_over_several_lines_is_replaced_whole() {
        let text = include_str!("../../../robots/abb_irb120.yaml");
        let line = text
            .lines()
            .find(|l| l.trim_start().starts_with("base:"))
            .expect("a base");
        let long = line.replace(", y_mm", ",\n    y_mm");
        let text = text.replace(line, &long);
        let mut profile = Profile::from_yaml(&text).expect("a profile");
        profile.world_from_base = Pose::from_xyz_rxryrz([2.5, -1.0, 0.3, 0.2, -0.1, 3.0]);
        assert!(rewritten(&text, &profile).is_ok());
    }
}
