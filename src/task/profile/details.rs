//! What a profile says besides the chain, its tools and its effects.

use super::facts::{number, pose, triple};
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::profile::Profile;
use crate::model::shape::Form;

/// A fact each, name and value.
pub(super) fn details(profile: &Profile, fact: &mut impl FnMut(String, String)) {
    if let Some(kg) = profile.payload_kg {
        fact("payload".into(), format!("{} kg", number(kg)));
    }
    for (i, speed) in profile.joint_speeds.iter().enumerate() {
        if let Some(speed) = speed {
            let value = format!("{} deg/s", number(speed / DEG));
            fact(format!("speed of joint {}", i + 1), value);
        }
    }
    if let Some(pulses) = profile.pulses_per_deg {
        fact("pulses_per_deg".into(), pulses.map(number).join(" "));
    }
    if let Some(sigma) = profile.device.and_then(|device| device.sigma) {
        let [x, y, z, rx, ry, rz] = sigma;
        let numbers = [[x, y, z].map(mm_from_m), [rx, ry, rz].map(|a| a / DEG)];
        let numbers = numbers.concat().into_iter().map(number);
        let value = numbers.collect::<Vec<_>>().join(" ");
        fact("sigma of world_from_device".into(), value);
    }
    tables(profile, fact);
    shapes(profile, fact);
    for (whose, reasons) in [
        ("controller", &profile.large.controller),
        ("calibration", &profile.large.calibration),
    ] {
        for (effect, reason) in reasons {
            fact(format!("large in the {whose}: {effect}"), reason.clone());
        }
    }
}

/// How measurements name their columns.
fn tables(profile: &Profile, fact: &mut impl FnMut(String, String)) {
    let tables = &profile.tables;
    for (column, theirs) in &tables.columns {
        fact(
            format!("column {column} of measurements"),
            theirs.names().join(", "),
        );
    }
    if !tables.units.is_empty() {
        fact("units of measurements".into(), tables.units.join(", "));
    }
    if let Some(euler) = &tables.euler {
        fact("euler angles of measurements".into(), euler.clone());
    }
}

/// Bodies of the links, for collisions.
fn shapes(profile: &Profile, fact: &mut impl FnMut(String, String)) {
    for (i, of_link) in profile.shapes.iter().enumerate() {
        let value = format!(
            "link {}: {} at {}",
            of_link.link,
            form(&of_link.shape.form),
            pose(&of_link.shape.frame_from_shape)
        );
        fact(format!("shape {}", i + 1), value);
    }
}

fn form(form: &Form) -> String {
    let mm = |metres: &f64| number(mm_from_m(*metres));
    match form {
        Form::Capsule {
            from_m,
            to_m,
            radius_m,
        } => format!(
            "capsule from {} to {} radius {}",
            triple(*from_m),
            triple(*to_m),
            mm(radius_m)
        ),
        Form::Box { size_m } => format!("box {}", triple(*size_m)),
        Form::Sphere { radius_m } => format!("sphere radius {}", mm(radius_m)),
        Form::Cylinder { radius_m, height_m } => {
            format!("cylinder radius {} height {}", mm(radius_m), mm(height_m))
        }
        Form::Plane { normal, offset_m } => format!(
            "plane normal {} offset {}",
            normal.map(number).join(" "),
            mm(offset_m)
        ),
        Form::Mesh { file, scale } => {
            let scale = scale.map_or_else(String::new, |scale| {
                format!(" scale {}", scale.map(number).join(" "))
            });
            format!("mesh {file}{scale}")
        }
    }
}
