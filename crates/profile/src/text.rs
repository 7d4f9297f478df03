//! The text of a profile that was made, not read: another file's arm, or one of the catalogue.

use super::reading::HEAVY_KG;
use super::{ControllerModel, FORMAT, Profile};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector};
use crate::model::shape::{Form, LinkShape};
use crate::printable::printable;
pub(super) use crate::printable::quoted;

/// What a made profile says besides its numbers.
#[derive(Clone, Debug, Default)]
pub struct Comments {
    /// Lines at its top.
    pub top: Vec<String>,
    /// One behind each joint; nothing where it is empty.
    pub joints: [String; 6],
}

/// The line of gravity.
pub(super) fn gravity(profile: &Profile) -> String {
    let along = profile.gravity_m_s2.map(number).join(", ");
    format!("gravity_m_s2: [{along}]\n")
}

/// The shortest decimals that give the number again, without the noise of a change of units.
pub(super) fn number(value: f64) -> String {
    let rounded = (value * 1e9).round() / 1e9;
    let value = if (value - rounded).abs() <= 1e-12 * value.abs().max(1.0) {
        rounded
    } else {
        value
    };
    format!("{}", value + 0.0)
}

fn mm(metres: Vector) -> String {
    let parts = metres.map(|x| number(mm_from_m(x)));
    format!("[{}]", parts.join(", "))
}

/// A pose in flow style.
pub fn flow_pose(pose: &Pose) -> String {
    let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
    let [x, y, z] = [x, y, z].map(|x| number(mm_from_m(x)));
    let [rx, ry, rz] = [rx, ry, rz].map(|a| number(a / DEG));
    format!("{{x_mm: {x}, y_mm: {y}, z_mm: {z}, rx_deg: {rx}, ry_deg: {ry}, rz_deg: {rz}}}")
}

fn form(form: &Form) -> String {
    match form {
        Form::Box { size_m } => format!("box_mm: {}", mm(*size_m)),
        Form::Cylinder { radius_m, height_m } => format!(
            "cylinder_mm: {{radius: {}, height: {}}}",
            number(mm_from_m(*radius_m)),
            number(mm_from_m(*height_m))
        ),
        Form::Capsule {
            from_m,
            to_m,
            radius_m,
        } => format!(
            "capsule_mm: {{from: {}, to: {}, radius: {}}}",
            mm(*from_m),
            mm(*to_m),
            number(mm_from_m(*radius_m))
        ),
        Form::Sphere { radius_m } => {
            format!("sphere_mm: {{radius: {}}}", number(mm_from_m(*radius_m)))
        }
        Form::Plane { normal, offset_m } => format!(
            "plane: {{normal: [{}], offset_mm: {}}}",
            normal.map(number).join(", "),
            number(mm_from_m(*offset_m))
        ),
        Form::Mesh { file, scale } => {
            let scale = scale.map_or_else(String::new, |[scale, ..]| {
                format!(", scale: {}", number(scale))
            });
            format!("mesh: {}{scale}", quoted(file))
        }
    }
}

fn shape(shape: &LinkShape) -> String {
    format!(
        "  - {{link: {}, {}, at: {}}}\n",
        shape.link,
        form(&shape.shape.form),
        flow_pose(&shape.shape.frame_from_shape)
    )
}

/// `{frame: {…}, mass_kg: …, cog_mm: […]}`: a tool in flow style.
pub fn flow_tool(tool: &super::ToolOfProfile) -> String {
    let load = tool.load.map_or_else(String::new, |(kg, cog)| {
        format!(", mass_kg: {}, cog_mm: {}", number(kg), mm(cog))
    });
    format!("{{frame: {}{load}}}", flow_pose(&tool.flange_from_tool))
}

/// The text of a profile without points, calibration and a controller of its own kind, comments
/// above and behind its numbers. Reading it gives the profile again, its numbers to twelve digits.
#[must_use]
pub fn made(profile: &Profile, comments: &Comments) -> String {
    debug_assert!(
        profile.effects.is_empty() && profile.controller == ControllerModel::Nominal,
        "only nominal arms are made"
    );
    let mut out = String::new();
    for line in &comments.top {
        out += &format!("# {}\n", printable(line));
    }
    let serial = profile.serial.as_deref().unwrap_or("unknown");
    let language = profile
        .language
        .as_ref()
        .map_or_else(String::new, |language| {
            format!("language: {}, ", quoted(language))
        });
    out += &format!(
        "poseshift: {FORMAT}\nrobot: {{manufacturer: {}, model: {}, serial: {}}}\ncontroller: \
         {{{language}model: nominal}}\n\
         kinematics:\n  base: {}\n  joints:\n",
        quoted(&profile.manufacturer),
        quoted(&profile.model),
        quoted(serial),
        flow_pose(&profile.world_from_base)
    );
    for i in 0..6 {
        let (link, joint) = (&profile.links[i], &profile.mechanism.joints[i]);
        let mut row = format!(
            "    - {{alpha_deg: {}, a_mm: {}, theta_deg: {}, d_mm: {}, min_deg: {}, max_deg: {}",
            number(link.alpha_rad / DEG),
            number(mm_from_m(link.a_m)),
            number(link.theta_rad / DEG),
            number(mm_from_m(link.d_m)),
            number(joint.min_rad / DEG),
            number(joint.max_rad / DEG),
        );
        if let Some(speed) = profile.joint_speeds[i] {
            row += &format!(", speed_deg_s: {}", number(speed / DEG));
        }
        if joint.sign < 0.0 {
            row += ", sign: -1";
        }
        if joint.offset_rad != 0.0 {
            row += &format!(", offset_deg: {}", number(joint.offset_rad / DEG));
        }
        row.push('}');
        if !comments.joints[i].is_empty() {
            row += &format!("   # {}", printable(&comments.joints[i]));
        }
        out += &(row + "\n");
    }
    let couplings: Vec<String> = profile
        .mechanism
        .coupling
        .iter()
        .map(|c| {
            format!(
                "{{joint: {}, \"on\": {}, ratio: {}}}",
                c.joint + 1,
                c.on + 1,
                number(c.ratio)
            )
        })
        .collect();
    out += &format!(
        "  coupling: [{}]\n  flange: {}\n",
        couplings.join(", "),
        flow_pose(&profile.link6_from_flange)
    );
    out += if profile.bodies.is_empty() {
        "bodies: []\n"
    } else {
        "bodies:\n"
    };
    for body in &profile.bodies {
        let meant = if body.mass_kg < HEAVY_KG {
            ""
        } else {
            ", large: true, reason: \"what it is made of has it\""
        };
        out += &format!(
            "  - {{link: {}, mass_kg: {}, cog_mm: {}{meant}}}\n",
            body.link + 1,
            number(body.mass_kg),
            mm(body.cog_m)
        );
    }
    if !profile.shapes.is_empty() {
        out += "shapes:\n";
        out.extend(profile.shapes.iter().map(shape));
    }
    out += &super::external::section(&profile.external);
    out += &gravity(profile);
    out += if profile.tools.is_empty() {
        "tools: {}\n"
    } else {
        "tools:\n"
    };
    for (name, tool) in &profile.tools {
        out += &format!("  {}: {}\n", quoted(name), flow_tool(tool));
    }
    out + "points: {}\ncalibration:\n  effects: []\n"
}
