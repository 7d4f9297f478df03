//! A URDF of an arm.

use super::tree::EXACT;
use crate::geometry::{Pose, Vector};
use crate::model::Axes;
use crate::printable::printable;

/// What goes into a URDF.
pub struct Drawing<'a> {
    /// The robot's name.
    pub name: &'a str,
    /// Lines of the comment at its top.
    pub comments: &'a [String],
    /// The six axes from the world to the flange.
    pub axes: &'a Axes,
    /// Smallest and largest angle of each joint, radians.
    pub limits: [[f64; 2]; 6],
    /// Largest speed of each joint where it is known, rad/s.
    pub speeds: [Option<f64>; 6],
    /// Mass in kg and centre of gravity of what each joint carries up to the next one, in the
    /// frame that the joint turns.
    pub masses: [Option<(f64, Vector)>; 6],
    /// Tools by name: `flange_from_tool`.
    pub tools: Vec<(&'a str, Pose)>,
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// Whether a name may stand in XML and on one line: of W3C, "Extensible Markup Language (XML) 1.0",
/// `Char`, without the ends of lines.
#[must_use]
pub fn is_name(text: &str) -> bool {
    printable(text) == text && !text.contains(NO_XML)
}

/// Signs that are no control characters, and that XML has not.
const NO_XML: [char; 2] = ['\u{fffe}', '\u{ffff}'];

/// `xyz` and `rpy` of a frame: `Trans · Rz(yaw) · Ry(pitch) · Rx(roll)`.
fn origin(pose: &Pose) -> String {
    let [yaw, pitch, roll] = pose.rotation.yaw_pitch_roll();
    let [x, y, z] = pose.translation.map(|x| x + 0.0);
    format!("<origin xyz=\"{x} {y} {z}\" rpy=\"{roll} {pitch} {yaw}\"/>")
}

/// The text of a URDF: `base_link` and `base` at the world, `link_1` to `link_6` with frames on the
/// joints' axes, `tool0` at the flange, a link `tool_NAME` for each tool. Numbers have all their
/// digits; a comment says that they are meant so.
#[must_use]
pub fn urdf_text(drawing: &Drawing) -> String {
    let mut out = String::from("<?xml version=\"1.0\"?>\n<!--\n");
    for line in drawing.comments {
        let line = printable(line).replace(NO_XML, "\u{fffd}");
        // two hyphens end a comment
        out += &format!("  {}\n", escaped(&line).replace("--", "- -"));
    }
    out += &format!(
        "  {EXACT}\n-->\n<robot name=\"{}\">\n",
        escaped(drawing.name)
    );
    let fixed = |name: &str, parent: &str, child: &str, pose: &Pose| {
        format!(
            "  <joint name=\"{name}\" type=\"fixed\"><parent link=\"{parent}\"/><child \
             link=\"{child}\"/>{}</joint>\n",
            origin(pose)
        )
    };
    out += "  <link name=\"base_link\"/>\n  <link name=\"base\"/>\n";
    out += &fixed("base_link-base", "base_link", "base", &Pose::identity());
    for i in 0..6 {
        let (joint, [lower, upper]) = (i + 1, drawing.limits[i]);
        let above = match i {
            0 => "base_link".to_owned(),
            _ => format!("link_{i}"),
        };
        let mass = drawing.masses[i].map_or_else(String::new, |(kg, [x, y, z])| {
            format!(
                "<inertial><origin xyz=\"{x} {y} {z}\"/><mass value=\"{kg}\"/><inertia ixx=\"0\" \
                 ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial>"
            )
        });
        let speed = drawing.speeds[i].unwrap_or(0.0);
        out += &format!(
            "  <link name=\"link_{joint}\">{mass}</link>\n  <joint name=\"joint_{joint}\" \
             type=\"revolute\"><parent link=\"{above}\"/><child link=\"link_{joint}\"/>{}\
             <axis xyz=\"0 0 1\"/><limit lower=\"{lower}\" upper=\"{upper}\" effort=\"0\" \
                 velocity=\"{speed}\"/></joint>\n",
            origin(&drawing.axes.steps[i])
        );
    }
    out += "  <link name=\"tool0\"/>\n";
    out += &fixed("link_6-tool0", "link_6", "tool0", &drawing.axes.last);
    for (name, flange_from_tool) in &drawing.tools {
        let link = format!("tool_{}", escaped(name));
        out += &format!("  <link name=\"{link}\"/>\n");
        out += &fixed(&format!("tool0-{link}"), "tool0", &link, flange_from_tool);
    }
    out + "</robot>\n"
}
