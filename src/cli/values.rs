//! Values on the command line.

use super::failure::Failure;
use crate::geometry::Pose;
use crate::geometry::units::{DEG, m_from_mm};
use crate::model::profile::{Mounted, Profile};

/// Six numbers `x,y,z,rx,ry,rz` in mm and degrees.
pub fn pose(text: &str) -> Option<Pose> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
        .collect::<Option<_>>()?;
    let [x, y, z, rx, ry, rz]: [f64; 6] = numbers.try_into().ok()?;
    Some(Pose::from_xyz_rxryrz([
        m_from_mm(x),
        m_from_mm(y),
        m_from_mm(z),
        rx * DEG,
        ry * DEG,
        rz * DEG,
    ]))
}

/// Joints `q1,…,q6` in degrees, as radians.
pub fn joints(text: &str) -> Result<[f64; 6], Failure> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
        .collect();
    let numbers = numbers.unwrap_or_default();
    if numbers.len() > 6 {
        return Err(Failure::with_hint(
            format!("--start-joints {text}: more than six joints"),
            "the profile describes no external axes",
        ));
    }
    let joints: Result<[f64; 6], _> = numbers.try_into();
    let joints = joints.map_err(|_| {
        Failure::with_hint(
            format!("--start-joints {text}: these are not six finite numbers"),
            "give the controller's joints in degrees: --start-joints 0,-90,90,0,90,0",
        )
    })?;
    Ok(joints.map(|q| q * DEG))
}

/// `[NAME=]VALUE`: the name, if there is one, and the value's text.
pub fn named(text: &str) -> (Option<String>, &str) {
    match text.split_once('=') {
        Some((name, value)) => (Some(name.trim().to_owned()), value.trim()),
        None => (None, text.trim()),
    }
}

/// A tool by name of the profile or by its pose on the flange.
pub fn tool(text: &str, profile: &Profile) -> Result<(Option<String>, Mounted), Failure> {
    let (name, value) = named(text);
    let found = profile.tool(value).or_else(|| {
        let flange_from_tool = pose(value)?;
        Some(Mounted {
            name: name.clone().unwrap_or_default(),
            flange_from_tool,
            load: None,
        })
    });
    let names: Vec<_> = profile.tools.keys().map(String::as_str).collect();
    let found = found.ok_or_else(|| {
        Failure::with_hint(
            format!("--tool {text}: `{value}` is neither a tool of the profile nor x,y,z,rx,ry,rz in mm and degrees"),
            if names.is_empty() { "the profile has no tools".into() } else { format!("tools of the profile: {}", names.join(", ")) },
        )
    })?;
    Ok((name, found))
}

/// A work frame by its pose in the world.
pub fn frame(text: &str) -> Result<(Option<String>, Pose), Failure> {
    let (name, value) = named(text);
    let pose = pose(value).ok_or_else(|| {
        Failure::new(format!(
            "--frame {text}: `{value}` is not x,y,z,rx,ry,rz in mm and degrees"
        ))
    })?;
    Ok((name, pose))
}

/// The tool that a command with `--tool NAME` means: that one, else the profile's only one, else the flange.
pub fn chosen_tool(name: Option<&str>, profile: &Profile) -> Result<Mounted, Failure> {
    let names: Vec<_> = profile.tools.keys().map(String::as_str).collect();
    match (name, names.as_slice()) {
        (Some(name), _) => profile.tool(name).ok_or_else(|| {
            Failure::with_hint(
                format!("the profile has no tool `{name}`"),
                format!("its tools: {}", names.join(", ")),
            )
        }),
        (None, []) => Ok(Mounted::flange()),
        (None, [only]) => Ok(profile.tool(only).expect("a key of the map")),
        (None, _) => Err(Failure::with_hint(
            "the profile has several tools",
            format!("choose one with --tool: {}", names.join(", ")),
        )),
    }
}

/// Three numbers `x,y,z` in mm.
pub fn point(text: &str) -> Option<crate::geometry::Vector> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
        .collect::<Option<_>>()?;
    let point: [f64; 3] = numbers.try_into().ok()?;
    Some(point.map(m_from_mm))
}
