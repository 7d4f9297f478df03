//! A profile's text from an arm.

use super::chain::rows;
use super::{UrdfArm, UrdfError, UrdfForm};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector};
use crate::model::Conditions;
use crate::model::profile::{Mounted, Profile};

/// How far the profile's chain may be from the URDF's own, metres and radians.
const AGREES: f64 = 1e-9;
/// Postures at which they are compared.
const POSTURES: u64 = 1000;

/// The shortest decimals that give the number again, without the noise of a change of units.
fn number(value: f64) -> String {
    let rounded = (value * 1e9).round() / 1e9;
    let value = if (value - rounded).abs() <= 1e-12 * value.abs().max(1.0) {
        rounded
    } else {
        value
    };
    format!("{}", value + 0.0)
}

fn mm(v: Vector) -> String {
    let parts = v.map(|x| number(mm_from_m(x)));
    format!("[{}]", parts.join(", "))
}

fn pose(pose: &Pose) -> String {
    let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
    let [x, y, z] = [x, y, z].map(|x| number(mm_from_m(x)));
    let [rx, ry, rz] = [rx, ry, rz].map(|a| number(a / DEG));
    format!("{{x_mm: {x}, y_mm: {y}, z_mm: {z}, rx_deg: {rx}, ry_deg: {ry}, rz_deg: {rz}}}")
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// The text of a profile for an arm, its chain compared with the URDF's own. `mesh` gives the path that a mesh's name in the
/// URDF stands for.
///
/// # Errors
/// If two axes are one line, a mesh is not found, or the chains differ.
pub fn profile_text(
    arm: &UrdfArm,
    source: &str,
    mesh: &dyn Fn(&str) -> Option<String>,
) -> Result<String, UrdfError> {
    let rows = rows(arm)?;
    let urdf = arm.frames();
    let mut out = format!(
        "# Made by `poseshift profile from-urdf` from {source}, {} to {}.\n",
        arm.ends[0], arm.ends[1]
    );
    for note in &arm.notes {
        out += &format!("# {note}\n");
    }
    out += &format!(
        "# Joints of the controller are taken to be those of the URDF: compare sense and zero with the pendant.\n\
         poseshift: profile/1\n\
         robot: {{manufacturer: unknown, model: {}, serial: unknown}}\n\
         controller: {{model: nominal}}\n\
         kinematics:\n  base: {}\n  joints:\n",
        quoted(&arm.name),
        pose(&rows.base)
    );
    for (link, joint) in rows.links.iter().zip(&arm.joints) {
        let speed = joint.speed_rad_s.map_or(String::new(), |v| {
            format!(", speed_deg_s: {}", number(v / DEG))
        });
        out += &format!(
            "    - {{alpha_deg: {}, a_mm: {}, theta_deg: {}, d_mm: {}, min_deg: {}, max_deg: {}{speed}}}   # {}\n",
            number(link.alpha_rad / DEG),
            number(mm_from_m(link.a_m)),
            number(link.theta_rad / DEG),
            number(mm_from_m(link.d_m)),
            number(joint.min_rad / DEG),
            number(joint.max_rad / DEG),
            joint.name.replace(['\n', '\r'], " "),
        );
    }
    out += &format!("  coupling: []\n  flange: {}\n", pose(&rows.flange));
    // from a joint's frame to the frame after its row, both at zero
    let seen = |moved_by: usize| rows.frames[moved_by].inverse() * urdf[moved_by];
    if !arm.masses.is_empty() {
        out += "bodies:\n";
    }
    for (moved_by, mass, cog) in &arm.masses {
        let cog = seen(*moved_by).transform(*cog);
        out += &format!(
            "  - {{link: {moved_by}, mass_kg: {}, cog_mm: {}}}\n",
            number(*mass),
            mm(cog)
        );
    }
    if !arm.shapes.is_empty() {
        out += "shapes:\n";
    }
    for shape in &arm.shapes {
        let place = seen(shape.moved_by) * shape.joint_from_shape;
        let form = match &shape.form {
            UrdfForm::Box(size) => format!("box_mm: {}", mm(*size)),
            UrdfForm::Cylinder(radius, long) => format!(
                "cylinder_mm: {{radius: {}, height: {}}}",
                number(mm_from_m(*radius)),
                number(mm_from_m(*long))
            ),
            UrdfForm::Capsule(radius, long) => format!(
                "capsule_mm: {{from: {}, to: {}, radius: {}}}",
                mm([0.0, 0.0, -0.5 * long]),
                mm([0.0, 0.0, 0.5 * long]),
                number(mm_from_m(*radius))
            ),
            UrdfForm::Sphere(radius) => {
                format!("sphere_mm: {{radius: {}}}", number(mm_from_m(*radius)))
            }
            UrdfForm::Mesh(file, scale) => {
                let found = mesh(file).ok_or_else(|| UrdfError::Mesh {
                    file: file.clone(),
                    link: shape.link.clone(),
                })?;
                format!(
                    "mesh: {}, scale: {}",
                    quoted(&found),
                    number(1000.0 * scale)
                )
            }
        };
        out += &format!(
            "  - {{link: {}, {form}, at: {}}}\n",
            shape.moved_by,
            pose(&place)
        );
    }
    out += "gravity_m_s2: [0, 0, -9.81]\ntools: {}\npoints: {}\ncalibration:\n  effects: []\n";
    compare(arm, &out)?;
    Ok(out)
}

/// Reads the text again and compares its chain with the URDF's.
fn compare(arm: &UrdfArm, text: &str) -> Result<(), UrdfError> {
    let profile = Profile::from_yaml(text).map_err(|error| UrdfError::Unreadable {
        message: format!("the profile made of it: {error}"),
    })?;
    let model = profile.controller_model(&Mounted::flange());
    let (mut gap_m, mut gap_rad) = (0.0_f64, 0.0_f64);
    // splitmix64: the same postures always
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut part = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    for _ in 0..POSTURES {
        let q: [f64; 6] = std::array::from_fn(|i| {
            let joint = &arm.joints[i];
            joint.min_rad + (joint.max_rad - joint.min_rad) * part()
        });
        let gap = model
            .forward(&q, &Conditions::default())
            .separation(&arm.forward(&q));
        gap_m = gap_m.max(gap.distance_m);
        gap_rad = gap_rad.max(gap.angle_rad);
    }
    if gap_m <= AGREES && gap_rad <= AGREES {
        Ok(())
    } else {
        Err(UrdfError::Differs { gap_m, gap_rad })
    }
}
