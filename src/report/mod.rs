//! What commands tell: texts for people and JSON for programs.

pub mod approach;
pub mod check;
pub mod compensation;
pub mod diagnosis;
pub mod findings;
pub mod html;
pub mod identification;
pub mod profile;

use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use serde_json::{Value, json};

/// A pose for reports: position, angles and quaternion.
pub fn pose(pose: &Pose) -> Value {
    let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
    let quaternion = pose.rotation.quaternion().0;
    json!({
        "x_mm": mm_from_m(x), "y_mm": mm_from_m(y), "z_mm": mm_from_m(z),
        "rx_deg": rx / DEG, "ry_deg": ry / DEG, "rz_deg": rz / DEG,
        "quaternion": quaternion,
    })
}

/// Nothing, a name, or a list of names.
fn one_or_many(names: &[String]) -> Value {
    match names {
        [] => Value::Null,
        [one] => json!(one),
        many => json!(many),
    }
}
