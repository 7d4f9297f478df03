//! The text of `axes`.

use crate::report::Style;
use crate::report::layout::{aligned, row};
use crate::task::axes::positioner::PositionerAxis;
use crate::task::axes::{Axes, Circle};
use crate::task::parts::{Pose, Sigma};

/// What is said of the noise where it is not known.
const NO_NOISE: &str = "not known: three rows a sweep leave nothing to estimate the noise from";

pub(super) fn text(found: &Axes, style: Style) -> String {
    let mut rows = vec![
        row([
            "joint",
            "radius",
            "tangential",
            "",
            "radial",
            "",
            "axial",
            "",
            "backlash",
            "",
        ]),
        row([
            "", "mm", "rms mdeg", "max", "rms mm", "max", "rms mm", "max", "mdeg", "+/-",
        ]),
    ];
    rows.extend(found.joints.iter().map(|of| {
        let backlash_deg = [of.backlash_deg, of.backlash_sigma_deg];
        sweep(of.joint.to_string(), &of.circle, backlash_deg)
    }));
    rows.extend(found.positioner_axes.iter().map(|of| {
        let name = format!("e{}", of.external_axis);
        sweep(name, &of.circle, [None; 2])
    }));
    let mut text = aligned(&rows, style.width);
    text += &format!("{}\n", world(found));
    for axis in &found.positioner_axes {
        text += &positioner(axis);
    }
    for frame in frames(found) {
        let Some(pose) = frame.pose else {
            if found.joints.is_empty() {
                continue;
            }
            text += &format!(
                "{}: needs the sweeps of joints {}\n",
                frame.key, frame.joints
            );
            continue;
        };
        text += &format!(
            "{}\n  {}\n  sigma {}\n",
            frame.key,
            entry(pose),
            frame.sigma
        );
        text += &match &frame.sag {
            Some((typical, sag)) => {
                let whose = if *typical {
                    "as much as an arm of typical stiffness"
                } else {
                    "by the profile's compliance"
                };
                let share = if frame.sigma == NO_NOISE {
                    "sag alone"
                } else {
                    "of it sag"
                };
                format!("  {share} under gravity, {whose}: {sag}\n")
            }
            None => "  sag under gravity is not in it: the profile has no masses\n".into(),
        };
        if !frame.oriented {
            text += "  orientation not measured: the flange's is given\n";
        }
    }
    text
}

/// A frame as profiles have it.
fn entry(pose: &Pose) -> String {
    let [x, y, z] = pose.xyz_mm();
    // a zero has no sign
    let [rx, ry, rz] = pose.rxryrz_deg().map(|r| (r * 1e5).round() / 1e5 + 0.0);
    format!(
        "{{x_mm:\u{a0}{x:.4}, y_mm:\u{a0}{y:.4}, z_mm:\u{a0}{z:.4}, \
         rx_deg:\u{a0}{rx:.5}, ry_deg:\u{a0}{ry:.5}, rz_deg:\u{a0}{rz:.5}}}"
    )
}

/// An axis of a positioner: where it is, and how far from where the profile has it.
fn positioner(of: &PositionerAxis) -> String {
    let [x, y, z] = of.direction;
    let [a, b, c] = of.circle.centre_mm;
    let sigma = of.at_sigma.as_ref().map_or_else(
        || NO_NOISE.to_owned(),
        |sigma| {
            let ([x, y, z], [rx, ry, _]) = (sigma.xyz_mm(), sigma.rxryrz_deg());
            format!("{x:.4} {y:.4} {z:.4} mm; about x and y {rx:.5} {ry:.5} deg")
        },
    );
    format!(
        "axis {} of {} (e{})\n  along ({x:.6} {y:.6} {z:.6}) through ({a:.4}, {b:.4}, {c:.4}) \
         mm\n  \
         at: {}\n  sigma {sigma}\n  {:.4} mm and {:.4} deg from where the profile has it\n",
        of.axis,
        of.positioner,
        of.external_axis,
        entry(&of.at),
        of.moved_mm,
        of.rotated_deg
    )
}

/// What the world is in which frames are given.
pub(in crate::report) fn world(found: &Axes) -> &'static str {
    if !found.device_known && found.base.is_some() && !found.positioner_axes.is_empty() {
        "the world is the measuring device's frame; axes of positioners are in the controller's, \
         by the base"
    } else if found.device_known {
        "the world is the controller's (the profile's calibration.world_from_device)"
    } else {
        "the world is the measuring device's frame"
    }
}

/// The row of a sweep, by the name of its axis; `-` where nothing is known of its backlash.
fn sweep(name: String, of: &Circle, backlash_deg: [Option<f64>; 2]) -> Vec<String> {
    let mdeg = |angle: f64| format!("{:.2}", 1e3 * angle);
    let mm = |length: f64| format!("{length:.4}");
    let [width, sigma] = backlash_deg.map(|angle| angle.map_or_else(|| "-".to_owned(), mdeg));
    vec![
        name,
        format!("{:.2}", of.radius_mm),
        mdeg(of.tangential_deg),
        mdeg(of.max_tangential_deg),
        mm(of.radial_mm),
        mm(of.max_radial_mm),
        mm(of.axial_mm),
        mm(of.max_axial_mm),
        width,
        sigma,
    ]
}

/// A frame that sweeps give, in words.
pub(in crate::report) struct Frame<'a> {
    /// Its name and that of the transform.
    pub key: &'static str,
    /// The joints whose sweeps give it.
    pub joints: &'static str,
    /// Where it is; `None` without those sweeps.
    pub pose: Option<&'a Pose>,
    /// Its standard deviations, or why they are not known.
    pub sigma: String,
    /// Whether the sag in them is that of a typical arm, and how much it is.
    pub sag: Option<(bool, String)>,
    /// Whether its orientation was measured.
    pub oriented: bool,
}

/// Base and tool as frames, where they were found.
pub(super) fn poses(found: &Axes) -> Vec<(String, Pose)> {
    let found = frames(found).into_iter();
    let known = found.filter_map(|frame| Some((frame.key.to_owned(), *frame.pose?)));
    known.collect()
}

/// Base and tool.
pub(in crate::report) fn frames(found: &Axes) -> [Frame<'_>; 2] {
    let oriented = found.tool_oriented.unwrap_or(true);
    let of = |sigma: &Sigma, oriented: bool| {
        let [x, y, z] = sigma.xyz_mm();
        let [rx, ry, rz] = sigma.rxryrz_deg();
        let rotation = if oriented && [rx, ry, rz] != [0.0; 3] {
            format!("; {rx:.5} {ry:.5} {rz:.5} deg")
        } else {
            String::new()
        };
        format!("{x:.4} {y:.4} {z:.4} mm{rotation}")
    };
    let frame = |key, joints, pose, sigma: &Option<Sigma>, sag: &Option<_>, oriented| Frame {
        key,
        joints,
        pose,
        sigma: sigma.map_or_else(|| NO_NOISE.into(), |sigma| of(&sigma, oriented)),
        sag: sag
            .as_ref()
            .map(|sag: &crate::task::axes::Sag| (sag.from == "typical", of(&sag.sigma, oriented))),
        oriented,
    };
    [
        frame(
            "base (world_from_base)",
            "1 and 2",
            found.base.as_ref(),
            &found.base_sigma,
            &found.base_sag,
            true,
        ),
        frame(
            "tool (flange_from_tool)",
            "5 and 6",
            found.tool.as_ref(),
            &found.tool_sigma,
            &found.tool_sag,
            oriented,
        ),
    ]
}
