//! Values on the command line.

use crate::geometry::units::{DEG, MM, m_from_mm};
use crate::geometry::{Pose, Separation, Vector};
use crate::identify::external::from_files;
use crate::model::external::Listed;
use crate::model::profile::{Mounted, Profile};
use crate::motion::Given;
use crate::nearest;
use crate::task::Failure;
use std::f64::consts::TAU;

/// No tool or frame is rotated by more, degrees.
const MOST_ANGLE_DEG: f64 = 720.0;

/// No limit of a shift is larger: farther no correction of an arm goes, mm and degrees.
const MOST_SHIFT_MM: f64 = 1000.0;
const MOST_SHIFT_DEG: f64 = 180.0;
/// No point is farther away, mm.
const MOST_POINT_MM: f64 = 1e6;
/// How far beyond its limits an external axis may stand: numbers round. Metres and radians.
const BORDER: f64 = 1e-6;

/// `30mm,3deg`, or the numbers alone.
pub(super) fn max_shift(text: &str) -> Result<Separation, Failure> {
    let part = |part: &str, unit: &str| {
        let part = part.trim();
        let number = part.strip_suffix(unit).unwrap_or(part).trim_end();
        let number: Option<f64> = number.parse().ok();
        number.filter(|number| number.is_finite() && *number > 0.0)
    };
    let parts = text.split_once(',');
    let parts = parts.and_then(|(mm, deg)| Some((part(mm, "mm")?, part(deg, "deg")?)));
    let (mm, deg) = parts.ok_or_else(|| {
        Failure::with_hint(
            format!("--max-shift {text}: this is no length and angle above 0"),
            "give millimetres and degrees: --max-shift 30mm,3deg",
        )
    })?;
    if mm > MOST_SHIFT_MM || deg > MOST_SHIFT_DEG {
        return Err(Failure::with_hint(
            format!(
                "--max-shift {text}: it is at most {MOST_SHIFT_MM} mm and {MOST_SHIFT_DEG} deg"
            ),
            "give millimetres and degrees: --max-shift 30mm,3deg",
        ));
    }
    Ok(Separation {
        distance_m: m_from_mm(mm),
        angle_rad: deg * DEG,
    })
}

/// A number of an option is finite and not below `least`, which is not negative.
pub(super) fn check_size(option: &str, value: f64, least: f64) -> Result<(), Failure> {
    if value >= least && value.is_finite() {
        return Ok(());
    }
    let range = if least > 0.0 {
        "above 0"
    } else {
        "not negative"
    };
    Err(Failure::new(format!(
        "{option} is {value}; it must be a finite number, {range}"
    )))
}

/// No tool or frame that is given has an angle that can only be in another unit.
fn check_angles(option: &str, text: &str, value: &str) -> Result<(), Failure> {
    let angles = list::<6>(value).map(|[_, _, _, angles @ ..]| angles);
    let endless = angles.and_then(|angles| {
        let beyond = |angle: &f64| angle.abs() > MOST_ANGLE_DEG;
        angles.into_iter().find(beyond)
    });
    match endless {
        Some(angle) => Err(Failure::with_hint(
            format!("{option} {text}: an angle is {angle}; the limit is {MOST_ANGLE_DEG} deg"),
            "angles are in degrees: write them between -360 and 360",
        )),
        None => Ok(()),
    }
}

/// Six numbers `x,y,z,rx,ry,rz` in mm and degrees.
pub(super) fn pose(text: &str) -> Option<Pose> {
    let [x, y, z, rx, ry, rz] = list::<6>(text)?;
    Some(Pose::from_xyz_rxryrz([
        m_from_mm(x),
        m_from_mm(y),
        m_from_mm(z),
        rx * DEG,
        ry * DEG,
        rz * DEG,
    ]))
}

/// Where the robot stands when a program starts.
#[derive(Debug, Default)]
pub(super) struct Start {
    pub joints_rad: Option<[f64; 6]>,
    /// The external axes that the profile lists, metres and radians; empty where they are not said.
    pub external: Vec<f64>,
}

/// `q1,…,q6[,e1,…]`: joints in degrees, then the external axes of the profile, in millimetres and
/// degrees.
pub(super) fn start(text: Option<&str>, profile: &Profile) -> Result<Start, Failure> {
    let Some(text) = text else {
        return Ok(Start::default());
    };
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
        .collect();
    let numbers = numbers.unwrap_or_default();
    let Some((joints, external)) = numbers.split_first_chunk::<6>() else {
        return Err(Failure::with_hint(
            format!("--start-joints {text}: these are not six finite numbers"),
            "give the controller's joints in degrees: --start-joints 0,-90,90,0,90,0",
        ));
    };
    let limits = profile
        .mechanism
        .joints
        .map(|joint| [joint.min_rad, joint.max_rad]);
    for (number, (q, [low, high])) in (1..).zip(joints.iter().zip(limits)) {
        if !(low - TAU..=high + TAU).contains(&(q * DEG)) {
            return Err(Failure::with_hint(
                format!(
                    "--start-joints {text}: joint {number} is {q:?} deg; its limits are {:.3} to \
                     {:.3} deg",
                    low / DEG,
                    high / DEG
                ),
                "no posture is more than a rotation beyond the limits: is it in degrees? correct \
                 it, or the limits of the profile",
            ));
        }
    }
    let axes: Vec<Listed> = profile.external.listed().collect();
    if !external.is_empty() && external.len() != axes.len() {
        let units = axes.iter().map(|axis| {
            let unit = if axis.is_linear() { "mm" } else { "deg" };
            format!("{} ({unit})", axis.name())
        });
        let hint = if axes.is_empty() {
            "the profile describes no external axes: give six numbers".to_owned()
        } else {
            let units: Vec<String> = units.collect();
            format!(
                "behind the joints come {}, or none of them",
                units.join(", ")
            )
        };
        let message = format!(
            "--start-joints {text}: {} numbers behind the six joints; external axes in the \
             profile: {}",
            external.len(),
            axes.len()
        );
        return Err(Failure::with_hint(message, hint));
    }
    for (axis, &place) in axes.iter().zip(external) {
        let (low, high) = axis.limits();
        let is_within = (low - BORDER..=high + BORDER).contains(&from_files(axis, place));
        if !is_within {
            let (one, unit) = if axis.is_linear() {
                (MM, "mm")
            } else {
                (DEG, "deg")
            };
            let (low, high) = (low / one, high / one);
            return Err(Failure::with_hint(
                format!(
                    "--start-joints {text}: external axis {} is at {place:?} {unit}; its limits are \
                     {low:.3} to {high:.3} {unit}",
                    axis.name()
                ),
                "correct it, or the limits under `external_axes` of the profile",
            ));
        }
    }
    let places = axes.iter().zip(external);
    Ok(Start {
        joints_rad: Some(joints.map(|q| q * DEG)),
        external: places
            .map(|(axis, &place)| from_files(axis, place))
            .collect(),
    })
}

/// `[NAME=]VALUE`: the name, if there is one, and the value's text. A name in front of a pose may have
/// a `=` in it.
pub(super) fn named(text: &str) -> (Option<String>, &str) {
    let last = text.rsplit_once('=');
    let before_pose = last.filter(|(_, value)| pose(value).is_some());
    match before_pose.or_else(|| text.split_once('=')) {
        Some((name, value)) => (Some(name.trim().to_owned()), value.trim()),
        None => (None, text.trim()),
    }
}

/// A tool by name of the profile or by its pose on the flange.
pub(super) fn tool(text: &str, profile: &Profile) -> Result<(Option<String>, Mounted), Failure> {
    let (name, value) = named(text);
    check_angles("--tool", text, value)?;
    let found = profile.tool(value).or_else(|| {
        let flange_from_tool = pose(value)?;
        Some(Mounted {
            name: name.clone().unwrap_or_default(),
            flange_from_tool,
            load: None,
        })
    });
    let found = found.ok_or_else(|| {
        Failure::with_hint(
            format!(
                "--tool {text}: `{value}` is neither a tool of the profile nor x,y,z,rx,ry,rz \
                in mm and degrees"
            ),
            nearest::hint(
                value,
                "tools of the profile",
                profile.tools.keys().map(String::as_str),
            ),
        )
    })?;
    Ok((name, found))
}

/// A work frame by its pose in the world.
pub(super) fn frame(text: &str) -> Result<(Option<String>, Pose), Failure> {
    let (name, value) = named(text);
    check_angles("--frame", text, value)?;
    let pose = pose(value).ok_or_else(|| {
        Failure::new(format!(
            "--frame {text}: `{value}` is not x,y,z,rx,ry,rz in mm and degrees"
        ))
    })?;
    Ok((name, pose))
}

/// Tools and frames of the command line, each name once.
pub(super) fn given(
    tools: &[String],
    frames: &[String],
    profile: &Profile,
) -> Result<Given, Failure> {
    let twice = |option: &str, name: &Option<String>| {
        let of = name
            .as_ref()
            .map_or(String::new(), |name| format!(" {name}"));
        Failure::with_hint(
            format!("{option}{of} is given twice"),
            format!(
                "one {option} a name: {option} NAME=x,y,z,rx,ry,rz, and at most one without a name"
            ),
        )
    };
    let mut given = Given {
        is_needed: true,
        ..Given::default()
    };
    for text in tools {
        let (name, tool) = tool(text, profile)?;
        if given.tools.insert(name.clone(), tool).is_some() {
            return Err(twice("--tool", &name));
        }
    }
    for text in frames {
        let (name, frame) = frame(text)?;
        if given.frames.insert(name.clone(), frame).is_some() {
            return Err(twice("--frame", &name));
        }
    }
    Ok(given)
}

/// So many finite numbers with commas between, the value of an option.
pub(super) fn numbers<const N: usize>(option: &str, text: &str) -> Result<[f64; N], Failure> {
    list(text).ok_or_else(|| {
        Failure::new(format!(
            "{option} {text}: expected {N} numbers with commas between"
        ))
    })
}

fn list<const N: usize>(text: &str) -> Option<[f64; N]> {
    let number = |n: &str| n.trim().parse().ok().filter(|n: &f64| n.is_finite());
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// Three numbers `x,y,z` in mm.
pub(super) fn point(text: &str) -> Option<Vector> {
    let near = |point: &[f64; 3]| point.iter().all(|x| x.abs() <= MOST_POINT_MM);
    let point = list::<3>(text).filter(near)?;
    Some(point.map(m_from_mm))
}

#[cfg(test)]
mod tests {
    use super::named;

    #[test]
    fn a_name_in_front_of_a_pose_may_have_an_equals_sign() {
        let split = |text: &'static str| {
            let (name, value) = named(text);
            (name.unwrap_or_default(), value)
        };
        let pose = "1,2,3,0,0,90";
        assert_eq!(split("nest=2=1,2,3,0,0,90"), ("nest=2".to_owned(), pose));
        assert_eq!(split("a = 1,2,3,0,0,90"), ("a".to_owned(), pose));
        assert_eq!(split("1,2,3,0,0,90"), (String::new(), pose));
        // a tool of the profile
        assert_eq!(split("a=b=2"), ("a".to_owned(), "b=2"));
    }
}
