//! Names of robots, links, joints and meshes.

use super::UrdfError;
use crate::printable::printable;
use std::collections::BTreeSet;
use urdf_rs::Robot;

/// What is wrong with names that hold control characters.
const STEERS: &str = "holds characters that no terminal shows";

/// Whether the path of a mesh leads out of the folder that its package is in.
pub(super) fn leads_out(file: &str) -> bool {
    let Some(path) = file.strip_prefix("package://") else {
        return false;
    };
    let mut depth = 0;
    path.split(['/', '\\']).any(|part| {
        depth += match part {
            ".." => -1,
            "." => 0,
            _ => 1,
        };
        depth < 0
    }) || path.starts_with(['/', '\\'])
}

/// Names that each stand for one thing, and that can be shown.
pub(super) fn judge_names(robot: &Robot) -> Result<(), UrdfError> {
    let fault = |what: String, name: &str, why: &'static str| {
        let shown = printable(name).into_owned();
        Err(UrdfError::Name { what, shown, why })
    };
    let is_plain = |name: &str| printable(name) == name;
    if !is_plain(&robot.name) {
        return fault("the robot".into(), &robot.name, STEERS);
    }
    let links: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    let joints: Vec<&str> = robot
        .joints
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    for (kind, names) in [("link", links), ("joint", joints)] {
        let mut seen = BTreeSet::new();
        for (number, name) in (1..).zip(names) {
            let why = if name.is_empty() {
                "is none"
            } else if !is_plain(name) {
                STEERS
            } else if !seen.insert(name) {
                "another one has, too"
            } else {
                continue;
            };
            return fault(format!("{kind} number {number}"), name, why);
        }
    }
    Ok(())
}
