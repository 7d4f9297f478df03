//! Comparisons of profiles.

use super::diff;
use crate::model::profile::Profile;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Every key that the schema of profiles has.
const FULL: &str = "poseshift: profile/1
robot: {manufacturer: ABB, model: IRB 120-3/0.6, serial: 120-500123, payload_kg: 3}
controller:
  language: rapid
  model: calibrated
  effects: [{effect: link_geometry, link: 2, alpha_deg: 0.01}]
  pulses_per_deg: [100, 101, 102, 103, 104, 105]
kinematics:
  base: {x_mm: 1, y_mm: 2, z_mm: 3, rx_deg: 4, ry_deg: 5, rz_deg: 6}
  joints:
    - {alpha_deg: 0, a_mm: 0, theta_deg: 0, d_mm: 290, min_deg: -165, max_deg: 165, speed_deg_s: 250, sign: 1, offset_deg: 1}
    - {alpha_deg: -90, a_mm: 0, theta_deg: -90, d_mm: 0, min_deg: -110, max_deg: 110, speed_deg_s: 250}
    - {alpha_deg: 0, a_mm: 270, theta_deg: 0, d_mm: 0, min_deg: -110, max_deg: 70, speed_deg_s: 250}
    - {alpha_deg: -90, a_mm: 70, theta_deg: 0, d_mm: 302, min_deg: -160, max_deg: 160, speed_deg_s: 320}
    - {alpha_deg: 90, a_mm: 0, theta_deg: 0, d_mm: 0, min_deg: -120, max_deg: 120, speed_deg_s: 320}
    - {alpha_deg: -90, a_mm: 0, theta_deg: 180, d_mm: 72, min_deg: -400, max_deg: 400, speed_deg_s: 420}
  coupling: [{joint: 3, on: 2, ratio: 1}]
  flange: {x_mm: 1, y_mm: 2, z_mm: 3, rx_deg: 4, ry_deg: 5, rz_deg: 6}
bodies: [{link: 2, mass_kg: 4.2, cog_mm: [140, 1, 2]}]
shapes:
  - {link: 1, capsule_mm: {from: [0, 1, 2], to: [50, 25, 100], radius: 20}, at: {x_mm: 1, y_mm: 2, z_mm: 3, rx_deg: 4, ry_deg: 5, rz_deg: 6}}
  - {link: 2, box_mm: [10, 20, 30]}
  - {link: 3, sphere_mm: {radius: 20}}
  - {link: 4, cylinder_mm: {radius: 20, height: 30}}
  - {link: 5, mesh: hand.stl, scale: 2}
external_axes:
  track:
    - {axis: eax_a, direction: [1, 1, 0], up: [0.1, 0, 1], zero_mm: 10, min_mm: 0, max_mm: 3000, coordinates: base, pulses_per_mm: 100}
  positioners:
    - name: STN1
      follows: always
      axes: [{axis: eax_b, at: {x_mm: 1000, y_mm: 2, z_mm: 3, rx_deg: 4, ry_deg: 5, rz_deg: 6}, sign: 1, zero_deg: 1, min_deg: -180, max_deg: 180, pulses_per_deg: 50}]
      plate: {x_mm: 1, y_mm: 2, z_mm: 3, rx_deg: 4, ry_deg: 5, rz_deg: 6}
      points: {nest: [10, 20, 30]}
  other: [eax_c]
gravity_m_s2: [0.1, 0.2, -9.81]
tools:
  gun: {frame: {x_mm: 50, y_mm: 25, z_mm: 100, rx_deg: 4, ry_deg: 5, rz_deg: 6}, mass_kg: 2.6, cog_mm: [-23, 1, 100]}
points: {nest1: [10, 20, 30]}
measurement:
  columns: {q1_deg: J1, q2_deg: [J2, A2]}
  units: [m]
  euler: zyx
calibration:
  effects: [{effect: link_geometry, link: 2, a_mm: 60, large: true, reason: a longer arm}]
  world_from_device:
    pose: {x_mm: 1, y_mm: 2, z_mm: 3, rx_deg: 4, ry_deg: 5, rz_deg: 6}
    sigma: {x_mm: 0.1, y_mm: 0.2, z_mm: 0.3, rx_deg: 0.4, ry_deg: 0.5, rz_deg: 0.6}
  quality: {}
  provenance: {}
";
/// What a comparison leaves out: the version of the format, and where a calibration comes from
/// and what it is worth.
const LEFT_OUT: [&str; 5] = [
    "poseshift",
    "calibration.quality",
    "calibration.provenance",
    "bodies.large",
    "bodies.reason",
];
/// Keys of effects are those of their definitions; a plane is no body of a link; angles stand
/// for a quaternion; a controller with effects of its own is a calibrated one.
const OTHERS: [&str; 4] = [
    ".effects.",
    "shapes.plane",
    ".quaternion",
    "controller.model",
];

fn keys_of_schema(schema: &Value, node: &Value, path: &str, keys: &mut BTreeSet<String>) {
    if !node.is_object() {
        return;
    }
    if let Some(name) = node["$ref"].as_str() {
        let name = name.rsplit('/').next().expect("a name");
        keys_of_schema(schema, &schema["$defs"][name], path, keys);
    }
    for which in ["anyOf", "oneOf", "allOf"] {
        for part in node[which].as_array().into_iter().flatten() {
            keys_of_schema(schema, part, path, keys);
        }
    }
    for (key, part) in node["properties"].as_object().into_iter().flatten() {
        let path = format!("{path}.{key}");
        keys.insert(path.trim_start_matches('.').to_owned());
        keys_of_schema(schema, part, &path, keys);
    }
    for part in [&node["items"], &node["additionalProperties"]] {
        if part.is_object() {
            keys_of_schema(schema, part, path, keys);
        }
    }
}

/// A place of a document, without numbers of lists and names of tools as the schema has it.
type Place = (String, Vec<Value>);

fn leaves(node: &Value, path: &str, steps: &[Value], found: &mut Vec<Place>) {
    let longer = |step: Value| [steps, &[step]].concat();
    match node {
        Value::Object(map) => {
            for (key, part) in map {
                let is_name = [".tools", ".points", ".external_axes.positioners.points"]
                    .contains(&path)
                    || path == ".measurement.columns";
                let path = if is_name {
                    format!("{path}/")
                } else {
                    format!("{path}.{key}")
                };
                leaves(part, &path, &longer(json!(key)), found);
            }
        }
        Value::Array(list) => {
            for (k, part) in list.iter().enumerate() {
                leaves(part, path, &longer(json!(k)), found);
            }
        }
        _ => found.push((
            path.trim_start_matches('.').replace('/', ""),
            steps.to_vec(),
        )),
    }
}

fn slot<'a>(mut document: &'a mut Value, steps: &[Value]) -> &'a mut Value {
    for step in steps {
        document = match step {
            Value::String(key) => &mut document[key.as_str()],
            step => {
                &mut document[usize::try_from(step.as_u64().expect("a number")).expect("small")]
            }
        };
    }
    document
}

/// Another value that may stand there.
fn other(path: &str, value: &Value) -> Value {
    match (path, value) {
        ("controller.language", _) => json!("krl"),
        ("external_axes.track.coordinates", _) => json!("world"),
        ("external_axes.positioners.follows", _) => json!("frame"),
        ("measurement.units", _) => json!("mm"),
        ("measurement.euler", _) => json!("xyz"),
        ("kinematics.coupling.joint" | "kinematics.coupling.on", value) => {
            json!(value.as_u64().expect("a joint") + 2)
        }
        ("bodies.link" | "shapes.link", value) => json!(value.as_u64().expect("a link") + 1),
        (path, value) if path.ends_with("sign") => json!(-value.as_i64().expect("a sign")),
        ("gravity_m_s2", Value::Number(number)) => {
            json!(number.as_f64().expect("finite") * 1.001)
        }
        (_, Value::Number(number)) => {
            let number = number.as_f64().expect("finite");
            json!(number * 1.01 + 0.001)
        }
        (_, Value::String(text)) => json!(format!("{text}x")),
        (path, value) => panic!("{path}: {value}"),
    }
}

#[test]
fn a_comparison_sees_every_key_of_the_schema() {
    let document: Value = serde_yaml::from_str(FULL).expect("a document");
    let read = |document: &Value| Profile::from_yaml(&document.to_string());
    let full = read(&document).expect("a profile");
    let mut places = Vec::new();
    leaves(&document, "", &[], &mut places);
    let schema = Profile::schema();
    let mut keys = BTreeSet::new();
    keys_of_schema(&schema, &schema, "", &mut keys);
    let skipped = |key: &str| {
        LEFT_OUT.iter().any(|out| key.starts_with(out))
            || OTHERS.iter().any(|part| key.contains(part))
    };
    for key in keys.iter().filter(|key| !skipped(key)) {
        let there = places.iter().any(|(path, _)| path.starts_with(key));
        assert!(there, "{key} of the schema is not in the full profile");
    }
    for (path, steps) in places.iter().filter(|(path, _)| !skipped(path)) {
        let mut changed = document.clone();
        let place = slot(&mut changed, steps);
        *place = other(path, place);
        let changed = read(&changed).unwrap_or_else(|error| panic!("{path}: {error}"));
        let found = diff(&full, &changed).differences;
        assert!(!found.is_empty(), "{path} {steps:?} is not seen");
    }
}
