//! Tools that are given on the command line.

use crate::geometry::units::{DEG, m_from_mm};
use crate::geometry::{Pose, norm};
use crate::model::profile::{ToolOfProfile, is_tiny};
use crate::task::Failure;

/// No tool is rotated by more: two whole revolutions.
const MOST_ANGLE_DEG: f64 = 720.0;
/// A centre of gravity farther from the flange is in another unit.
const MOST_M: f64 = 10.0;

/// A tool `NAME=X,Y,Z,RX,RY,RZ[,KG[,CX,CY,CZ]]`: its frame on the flange in mm and degrees as
/// profiles have it (`Trans · Rx · Ry · Rz`), its mass, and its centre of gravity in the flange's
/// frame in mm; without that the mass counts at the flange, as in profiles.
///
/// # Errors
/// A text that is none, an angle or length in another unit, a mass that is none.
pub fn tool(text: &str) -> Result<(String, ToolOfProfile), Failure> {
    let refused = |why: String| {
        Failure::with_hint(
            format!("tool `{text}`: {why}"),
            "NAME=X,Y,Z,RX,RY,RZ[,KG[,CX,CY,CZ]] in mm, degrees and kg, such as \
             gripper=0,0,150,0,0,90,2.5,0,0,60",
        )
    };
    let (name, values) = text
        .split_once('=')
        .ok_or_else(|| refused("there is no `=` behind its name".into()))?;
    let name = name.trim();
    if name.is_empty() {
        return Err(refused("it has no name".into()));
    }
    let mut numbers = Vec::new();
    for value in values.split(',') {
        let value = value.trim();
        let number: Option<f64> = value.parse().ok().filter(|n: &f64| n.is_finite());
        numbers.push(number.ok_or_else(|| refused(format!("`{value}` is no number")))?);
    }
    let [x, y, z, rx, ry, rz, load @ ..] = &numbers[..] else {
        return Err(refused(format!(
            "{} numbers, at least 6 are needed",
            numbers.len()
        )));
    };
    if let Some(angle) = [rx, ry, rz].into_iter().find(|a| a.abs() > MOST_ANGLE_DEG) {
        return Err(refused(format!(
            "an angle is {angle}; the limit is {MOST_ANGLE_DEG} deg"
        )));
    }
    let [x, y, z] = [*x, *y, *z].map(m_from_mm);
    let flange_from_tool = Pose::from_xyz_rxryrz([x, y, z, rx * DEG, ry * DEG, rz * DEG]);
    if is_tiny(&flange_from_tool.translation) {
        return Err(refused(
            "it is less than 1 mm off the flange in each coordinate: lengths are in mm".into(),
        ));
    }
    let load = match *load {
        [] => None,
        [kg] => Some((kg, [0.0; 3])),
        [kg, x, y, z] => Some((kg, [x, y, z].map(m_from_mm))),
        _ => {
            return Err(refused(format!(
                "{} numbers; 6, 7 or 10 are taken",
                numbers.len()
            )));
        }
    };
    if let Some((kg, cog)) = load {
        if kg < 0.0 {
            return Err(refused(format!("its mass is {kg} kg")));
        }
        if is_tiny(&cog) {
            return Err(refused(
                "its centre of gravity is less than 1 mm from the flange in each coordinate: \
                 lengths are in mm"
                    .into(),
            ));
        }
        if norm(cog) > MOST_M {
            return Err(refused(format!(
                "its centre of gravity is {} m from the flange; the limit is {MOST_M} m",
                norm(cog)
            )));
        }
    }
    Ok((
        name.to_owned(),
        ToolOfProfile {
            flange_from_tool,
            load,
        },
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tool_has_a_frame_and_where_it_is_given_a_load() {
        let (name, gripper) = tool("gripper = 0, 0, 150, 0, 0, 90").expect("a tool");
        assert_eq!((name.as_str(), gripper.load), ("gripper", None));
        assert!((gripper.flange_from_tool.translation[2] - 0.15).abs() < 1e-15);
        let (_, heavy) = tool("t=0,0,150,0,0,0,2.5,10,0,60").expect("a tool");
        assert_eq!(heavy.load, Some((2.5, [0.01, 0.0, 0.06])));
        let (_, plain) = tool("t=0,0,150,0,0,0,2.5").expect("a tool");
        assert_eq!(plain.load, Some((2.5, [0.0; 3])));
    }

    #[test]
    fn what_is_no_tool_is_refused_with_what_is_wrong() {
        for (text, says) in [
            ("0,0,150,0,0,0", "no `=`"),
            ("=0,0,150,0,0,0", "no name"),
            ("t=0,0,150,0,0", "5 numbers"),
            ("t=0,0,150,0,0,0,1,2", "8 numbers"),
            ("t=0,0,150,0,0,x", "`x` is no number"),
            ("t=0,0,inf,0,0,0", "`inf` is no number"),
            ("t=0,0,0.15,0,0,0", "less than 1 mm"),
            ("t=0,0,150,0,0,1000", "720 deg"),
            ("t=0,0,150,0,0,0,-1", "-1 kg"),
            ("t=0,0,150,0,0,0,1,0,0,15000", "10 m"),
            ("t=0,0,150,0,0,0,1,0,0,0.08", "less than 1 mm"),
        ] {
            let error = tool(text).expect_err(text);
            assert!(error.message.contains(says), "{text}: {}", error.message);
            assert!(error.hint.contains("mm"), "{text}");
        }
    }
}
