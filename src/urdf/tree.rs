//! The way from the base to the tip.

use super::read::{self, Geometry, Joint, JointType, Link, Origin, Robot};
use super::{Choice, UrdfArm, UrdfError, UrdfForm, UrdfJoint, UrdfShape};
use crate::geometry::units::DEG;
use crate::geometry::{Pose, Rotation, Vector, norm, scale};
use std::collections::BTreeMap;

/// Angles of frames that are this near to a multiple of 45° are rounded ones of it, radians: files with four digits write
/// 1.571 for a right angle, 2.04e-4 off, and none of 348 files of makers means an angle so near to one.
const ROUNDED_RAD: f64 = 3e-4;
/// Names that a flange has by convention, best first.
const FLANGES: [&str; 3] = ["tool0", "flange", "ee_link"];

fn angle(found: f64, notes: &mut f64) -> f64 {
    let step = 45.0 * DEG;
    let exact = step * (found / step).round();
    let by = (found - exact).abs();
    if by < ROUNDED_RAD {
        *notes = notes.max(by);
        exact
    } else {
        found
    }
}

/// Exact rotations where the angles are multiples of 45°.
fn pose(origin: &Origin, rounded: &mut f64) -> Pose {
    let [r, p, y] = origin.rpy.map(|a| angle(a, rounded));
    Pose {
        rotation: Rotation::from_rzryrx([y, p, r]),
        translation: origin.xyz,
    }
}

struct Tree<'a> {
    robot: &'a Robot,
    links: BTreeMap<&'a str, &'a Link>,
    /// The joint above each link.
    above: BTreeMap<&'a str, &'a Joint>,
}

pub(super) fn read(text: &str, choice: &Choice) -> Result<UrdfArm, UrdfError> {
    let code = without_comments(text);
    if code.contains("<xacro:") || (code.contains("xmlns:xacro") && code.contains("${")) {
        return Err(UrdfError::Xacro);
    }
    let robot = read::robot(text)?;
    let tree = Tree::of(&robot)?;
    let base = tree.base(choice)?;
    let tip = tree.tip(base, choice)?;
    tree.arm(base, tip, choice)
}

/// XML without its comments.
fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("<!--") {
        out.push_str(before);
        rest = after.split_once("-->").map_or("", |(_, behind)| behind);
    }
    out + rest
}

impl<'a> Tree<'a> {
    fn of(robot: &'a Robot) -> Result<Self, UrdfError> {
        let links: BTreeMap<&str, &Link> =
            robot.links.iter().map(|l| (l.name.as_str(), l)).collect();
        let mut above: BTreeMap<&str, &Joint> = BTreeMap::new();
        for joint in &robot.joints {
            for link in [&joint.parent, &joint.child] {
                if !links.contains_key(link.as_str()) {
                    return Err(no_link(link, &links));
                }
            }
            let child = joint.child.as_str();
            if let Some(other) = above.insert(child, joint) {
                return Err(UrdfError::Loop {
                    link: child.into(),
                    first: other.name.clone(),
                    second: joint.name.clone(),
                });
            }
        }
        let tree = Self {
            robot,
            links,
            above,
        };
        // a circle has no second parent, and no end
        for link in tree.links.keys() {
            let mut at = *link;
            for _ in 0..=tree.links.len() {
                match tree.above.get(at) {
                    None => break,
                    Some(joint) => at = &joint.parent,
                }
            }
            if let Some(joint) = tree.above.get(at) {
                return Err(UrdfError::Loop {
                    link: at.into(),
                    first: joint.name.clone(),
                    second: joint.name.clone(),
                });
            }
        }
        Ok(tree)
    }

    fn base(&self, choice: &'a Choice) -> Result<&'a str, UrdfError> {
        if let Some(name) = &choice.base {
            let found = self.links.get_key_value(name.as_str());
            return found
                .map(|(name, _)| *name)
                .ok_or_else(|| no_link(name, &self.links));
        }
        let roots: Vec<&str> = self
            .links
            .keys()
            .copied()
            .filter(|link| !self.above.contains_key(link))
            .collect();
        match roots[..] {
            [one] => Ok(one),
            _ => Err(UrdfError::Roots {
                count: roots.len(),
                roots: roots.join(", "),
            }),
        }
    }

    /// The joints from the base to a link.
    fn way(&self, base: &str, tip: &str) -> Option<Vec<&'a Joint>> {
        let mut way = Vec::new();
        let mut at = tip;
        while at != base {
            let joint = self.above.get(at)?;
            way.push(*joint);
            at = &joint.parent;
        }
        way.reverse();
        Some(way)
    }

    fn tip(&self, base: &str, choice: &'a Choice) -> Result<&'a str, UrdfError> {
        if let Some(name) = &choice.tip {
            let found = self.links.get_key_value(name.as_str());
            return found
                .map(|(name, _)| *name)
                .ok_or_else(|| no_link(name, &self.links));
        }
        let axes = |link: &str| {
            let way = self.way(base, link).unwrap_or_default();
            way.iter()
                .filter(|j| j.joint_type != JointType::Fixed)
                .count()
        };
        for name in FLANGES {
            if let Some((name, _)) = self.links.get_key_value(name)
                && axes(name) > 0
            {
                return Ok(name);
            }
        }
        // ends that move, the farthest out; what hangs on fixed joints is no end of its own
        let most = self.links.keys().map(|link| axes(link)).max().unwrap_or(0);
        let is_moved = |link: &&&str| {
            self.above
                .get(**link)
                .is_some_and(|joint| joint.joint_type != JointType::Fixed)
        };
        let ends: Vec<&str> = self
            .links
            .keys()
            .filter(|link| axes(link) == most && most > 0)
            .filter(is_moved)
            .copied()
            .collect();
        match ends[..] {
            [one] => Ok(one),
            _ => Err(UrdfError::SeveralTips {
                ends: ends.join(", "),
            }),
        }
    }

    fn arm(&self, base: &str, tip: &str, choice: &Choice) -> Result<UrdfArm, UrdfError> {
        let way = self.way(base, tip).ok_or_else(|| UrdfError::NoWay {
            base: base.into(),
            tip: tip.into(),
        })?;
        let mut rounded = 0.0;
        let mut joints = Vec::new();
        let mut notes = Vec::new();
        let mut fixed = Pose::identity();
        for joint in &way {
            finite("an origin", &joint.name, &joint.origin)?;
            fixed = fixed * pose(&joint.origin, &mut rounded);
            match joint.joint_type {
                JointType::Fixed => continue,
                JointType::Revolute | JointType::Continuous => {}
                _ => {
                    return Err(UrdfError::Kind {
                        joint: joint.name.clone(),
                        kind: joint.joint_type.name().into(),
                    });
                }
            }
            if let Some(mimic) = &joint.mimic {
                return Err(UrdfError::Mimic {
                    joint: joint.name.clone(),
                    by: mimic.clone(),
                });
            }
            joints.push(turning(joint, fixed, &mut notes)?);
            fixed = Pose::identity();
        }
        if joints.len() != 6 {
            return Err(UrdfError::NotSix {
                found: joints.len(),
                base: base.into(),
                tip: tip.into(),
                names: joints
                    .iter()
                    .map(|j| j.name.clone())
                    .collect::<Vec<_>>()
                    .join(", "),
            });
        }
        let mut arm = UrdfArm {
            name: self.robot.name.clone(),
            ends: [base.into(), tip.into()],
            joints,
            last_from_tip: fixed,
            masses: Vec::new(),
            shapes: Vec::new(),
            notes,
        };
        self.contents(base, &mut arm, choice, &mut rounded)?;
        if rounded > 0.0 {
            arm.notes.push(format!(
                "angles of frames within {rounded:.1e} rad of a multiple of 45 deg are taken as exact"
            ));
        }
        Ok(arm)
    }

    /// Masses and shapes of all links that the six joints, or none of them, move.
    fn contents(
        &self,
        base: &str,
        arm: &mut UrdfArm,
        choice: &Choice,
        rounded: &mut f64,
    ) -> Result<(), UrdfError> {
        for (name, link) in &self.links {
            let Some(way) = self.way(base, name) else {
                continue;
            };
            let (mut moved_by, mut place) = (0, Pose::identity());
            let mut beside = false;
            for joint in way {
                let is_next = arm
                    .joints
                    .get(moved_by)
                    .is_some_and(|j| j.name == joint.name);
                if is_next {
                    moved_by += 1;
                    place = Pose::identity();
                } else if joint.joint_type == JointType::Fixed {
                    place = place * pose(&joint.origin, rounded);
                } else {
                    // a finger of a gripper or another arm
                    beside = true;
                }
            }
            if beside {
                continue;
            }
            let mass = link.mass_kg;
            if !mass.is_finite() || mass < 0.0 {
                return Err(UrdfError::Number {
                    what: "the mass",
                    name: (*name).into(),
                    found: mass.to_string(),
                });
            }
            if mass > 0.0 && moved_by > 0 {
                let cog = place.transform(link.centre.xyz);
                arm.masses.push((moved_by, mass, cog));
            }
            if choice.shapes {
                for collision in &link.collision {
                    finite("an origin", name, &collision.origin)?;
                    arm.shapes.push(UrdfShape {
                        moved_by,
                        link: (*name).into(),
                        joint_from_shape: place * pose(&collision.origin, rounded),
                        form: form(name, &collision.geometry)?,
                    });
                }
            }
        }
        Ok(())
    }
}

fn no_link(link: &str, links: &BTreeMap<&str, &Link>) -> UrdfError {
    UrdfError::NoLink {
        link: link.into(),
        known: links.keys().copied().collect::<Vec<_>>().join(", "),
    }
}

fn finite(what: &'static str, name: &str, origin: &Origin) -> Result<(), UrdfError> {
    let numbers = origin.xyz.into_iter().chain(origin.rpy);
    match numbers.into_iter().find(|x| !x.is_finite()) {
        None => Ok(()),
        Some(found) => Err(UrdfError::Number {
            what,
            name: name.into(),
            found: found.to_string(),
        }),
    }
}

fn turning(
    joint: &Joint,
    before_from_joint: Pose,
    notes: &mut Vec<String>,
) -> Result<UrdfJoint, UrdfError> {
    let number = |what: &'static str, found: String| UrdfError::Number {
        what,
        name: joint.name.clone(),
        found,
    };
    let axis: Vector = joint.axis;
    let long = norm(axis);
    if !(long.is_finite() && long > 1e-9) {
        return Err(number("the axis", format!("{axis:?}")));
    }
    let limit = &joint.limit;
    let full = 360.0 * DEG;
    let (min_rad, max_rad) = if joint.joint_type == JointType::Continuous {
        notes.push(format!(
            "joint `{}` turns without end; its limits here are \u{b1}360 deg",
            joint.name
        ));
        (-full, full)
    } else {
        (limit.lower, limit.upper)
    };
    if !(min_rad.is_finite() && max_rad.is_finite() && min_rad < max_rad) {
        return Err(number(
            "the range of the limit",
            format!("{min_rad} to {max_rad}"),
        ));
    }
    Ok(UrdfJoint {
        name: joint.name.clone(),
        before_from_joint,
        axis: scale(long.recip(), axis),
        min_rad,
        max_rad,
        speed_rad_s: Some(limit.velocity).filter(|v| v.is_finite() && *v > 0.0),
    })
}

fn form(link: &str, geometry: &Geometry) -> Result<UrdfForm, UrdfError> {
    let (form, numbers) = match geometry {
        Geometry::Box { size } => (UrdfForm::Box(*size), size.to_vec()),
        Geometry::Cylinder { radius, length } => {
            (UrdfForm::Cylinder(*radius, *length), vec![*radius, *length])
        }
        Geometry::Capsule { radius, length } => {
            (UrdfForm::Capsule(*radius, *length), vec![*radius, *length])
        }
        Geometry::Sphere { radius } => (UrdfForm::Sphere(*radius), vec![*radius]),
        Geometry::Mesh { filename, scale } => {
            let s = scale.unwrap_or([1.0; 3]);
            if !(s[0] > 0.0 && s[0] == s[1] && s[1] == s[2]) {
                return Err(UrdfError::Scale {
                    link: link.into(),
                    scale: s,
                });
            }
            (UrdfForm::Mesh(filename.clone(), s[0]), vec![s[0]])
        }
    };
    match numbers.into_iter().find(|x| !(x.is_finite() && *x > 0.0)) {
        None => Ok(form),
        Some(found) => Err(UrdfError::Number {
            what: "a size of the collision shape",
            name: link.into(),
            found: found.to_string(),
        }),
    }
}
