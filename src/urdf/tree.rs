//! The way from the base to the tip.

use super::names::{judge_names, leads_out};
use super::parallel::Digits;
use super::text::{has_macros, judge_size, without_comments, without_looks};
use super::{Choice, UrdfArm, UrdfError, UrdfForm, UrdfJoint, UrdfShape};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Rotation, Vector, norm, scale};
use std::collections::{BTreeMap, BTreeSet};
use urdf_rs::{Geometry, Joint, JointType, Link, Robot};

/// Angles of frames that are this near to a multiple of 45° are rounded ones of it, radians: files
/// with four digits write 1.571 for a right angle, 2.04e-4 off, and none of 348 files of makers
/// means an angle so near to one.
const ROUNDED_RAD: f64 = 3e-4;
/// No joint has a limit beyond this: ten revolutions.
const MOST_LIMIT_RAD: f64 = 3600.0 * DEG;
/// No frame is rotated beyond this about an axis: one revolution, and some rounding.
const MOST_ANGLE_RAD: f64 = 361.0 * DEG;
/// No frame is farther from the one before, and no shape larger, metres.
pub const MOST_M: f64 = 1000.0;
/// No link is heavier, kg.
const MOST_MASS_KG: f64 = 1e4;
/// Names that a flange has by convention, best first.
const FLANGES: [&str; 4] = ["tool0", "fanuc_flange", "flange", "ee_link"];
/// Names of links where controllers count from, best first, and whose convention that is.
const BASES: [(&str, &str); 2] = [
    (
        "base",
        "by ROS's convention where the controller counts from",
    ),
    ("wbase", "in FANUC's files where the controller counts from"),
];

/// Stands in files whose angles are meant as they are written, such as exported calibrations.
pub(crate) const EXACT: &str = "poseshift: every angle is exact";

/// What is taken differently from what stands in frames.
#[derive(Clone, Copy)]
struct Rounding {
    /// Nothing is.
    exact: bool,
    /// Angles that were taken as multiples of 45°: how far they are off at most, radians.
    by: f64,
}

impl Rounding {
    fn angle(&mut self, found: f64) -> f64 {
        let step = 45.0 * DEG;
        let exact = step * (found / step).round();
        let by = (found - exact).abs();
        if !self.exact && by < ROUNDED_RAD {
            self.by = self.by.max(by);
            exact
        } else {
            found
        }
    }

    /// Exact rotations where the angles are multiples of 45°.
    fn pose(&mut self, origin: &urdf_rs::Pose) -> Pose {
        let [r, p, y] = origin.rpy.0.map(|a| self.angle(a));
        Pose {
            rotation: Rotation::from_rzryrx([y, p, r]),
            translation: origin.xyz.0,
        }
    }
}

fn kind(joint: &Joint) -> &'static str {
    match joint.joint_type {
        JointType::Revolute => "revolute",
        JointType::Continuous => "continuous",
        JointType::Prismatic => "prismatic",
        JointType::Fixed => "fixed",
        JointType::Floating => "floating",
        JointType::Planar => "planar",
        JointType::Spherical => "spherical",
    }
}

struct Tree<'a> {
    robot: &'a Robot,
    /// Whether angles are taken as they are written.
    exact: bool,
    links: BTreeMap<&'a str, &'a Link>,
    /// The joint above each link.
    above: BTreeMap<&'a str, &'a Joint>,
}

pub(super) fn read(text: &str, choice: &Choice) -> Result<UrdfArm, UrdfError> {
    let code = without_comments(text);
    if has_macros(&code) {
        return Err(UrdfError::Xacro);
    }
    judge_size(text)?;
    let robot = urdf_rs::read_from_string(&without_looks(&code)).map_err(|error| {
        UrdfError::Unreadable {
            message: error.to_string(),
        }
    })?;
    let tree = Tree::of(&robot, choice.exact || text.contains(EXACT))?;
    let mut notes = Vec::new();
    let base = tree.base(choice, &mut notes)?;
    let tip = tree.tip(tree.foot(base).0, choice)?;
    let mut arm = tree.arm(base, tip, choice)?;
    arm.notes.splice(0..0, notes);
    let packages = code.split("package://").skip(1);
    let names = packages.filter_map(|rest| rest.split(['/', '"', '\'']).next());
    arm.packages = names.map(str::to_owned).collect();
    Ok(arm)
}

/// Where a frame is, for people.
fn place(pose: &Pose) -> String {
    let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
    let mm = [x, y, z].map(|x| (mm_from_m(x) * 1e3).round() / 1e3 + 0.0);
    let deg = [rx, ry, rz].map(|a| (a / DEG * 1e3).round() / 1e3 + 0.0);
    format!(
        "{} {} {} mm, rotated {} {} {} deg",
        mm[0], mm[1], mm[2], deg[0], deg[1], deg[2]
    )
}

impl<'a> Tree<'a> {
    fn of(robot: &'a Robot, exact: bool) -> Result<Self, UrdfError> {
        judge_names(robot)?;
        let links: BTreeMap<&str, &Link> =
            robot.links.iter().map(|l| (l.name.as_str(), l)).collect();
        let mut above: BTreeMap<&str, &Joint> = BTreeMap::new();
        for joint in &robot.joints {
            for link in [&joint.parent.link, &joint.child.link] {
                if !links.contains_key(link.as_str()) {
                    return Err(no_link(link, &links));
                }
            }
            let child = joint.child.link.as_str();
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
            exact,
            links,
            above,
        };
        // a circle has no second parent, and no end
        for link in tree.links.keys() {
            let mut at = *link;
            for _ in 0..=tree.links.len() {
                match tree.above.get(at) {
                    None => break,
                    Some(joint) => at = &joint.parent.link,
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

    fn link(&self, name: &str) -> Result<&'a str, UrdfError> {
        let found = self.links.get_key_value(name);
        found
            .map(|(name, _)| *name)
            .ok_or_else(|| no_link(name, &self.links))
    }

    /// Where the world is, and why it is there where that was not asked for.
    fn base(&self, choice: &Choice, notes: &mut Vec<String>) -> Result<&'a str, UrdfError> {
        if let Some(name) = &choice.base {
            return self.link(name);
        }
        let free = |link: &&str| !self.above.contains_key(*link);
        let roots: Vec<&str> = self.links.keys().copied().filter(free).collect();
        let [root] = roots[..] else {
            return Err(UrdfError::Roots {
                count: roots.len(),
                roots: roots.join(", "),
            });
        };
        for (name, whose) in BASES {
            let Some((name, _)) = self.links.get_key_value(name) else {
                continue;
            };
            if self.foot(name).0 == root {
                if *name != root {
                    notes.push(format!(
                        "the world is link `{name}`, {whose}: {} in the root `{root}`; --base \
                         {root} has the root instead",
                        place(&self.foot(name).1)
                    ));
                }
                return Ok(name);
            }
        }
        if let Some((foot, _)) = self.links.get_key_value("base_link")
            && self.foot(foot).0 == root
            && norm(self.foot(foot).1.translation) > 1e-9
        {
            notes.push(format!(
                "link `base_link` is {} in the root `{root}`, as on a pedestal: --base base_link \
                 leaves that out",
                place(&self.foot(foot).1)
            ));
        }
        Ok(root)
    }

    fn rounding(&self) -> Rounding {
        Rounding {
            exact: self.exact,
            by: 0.0,
        }
    }

    /// The highest link that a link is fixed to, and where the link is in its frame.
    fn foot(&self, link: &'a str) -> (&'a str, Pose) {
        let (mut at, mut seen) = (link, Pose::identity());
        while let Some(joint) = self
            .above
            .get(at)
            .filter(|j| j.joint_type == JointType::Fixed)
        {
            seen = self.rounding().pose(&joint.origin) * seen;
            at = &joint.parent.link;
        }
        (at, seen)
    }

    /// The joints from a link down to another one.
    fn way(&self, from: &str, to: &str) -> Option<Vec<&'a Joint>> {
        let mut way = Vec::new();
        let mut at = to;
        while at != from {
            let joint = self.above.get(at)?;
            way.push(*joint);
            at = &joint.parent.link;
        }
        way.reverse();
        Some(way)
    }

    /// The tip, where `foot` is the highest link that the base is fixed to.
    fn tip(&self, foot: &str, choice: &Choice) -> Result<&'a str, UrdfError> {
        if let Some(name) = &choice.tip {
            return self.link(name);
        }
        let axes = |link: &str| {
            let way = self.way(foot, link).unwrap_or_default();
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
            [] => Err(UrdfError::NoAxes),
            _ => Err(UrdfError::SeveralTips {
                ends: ends.join(", "),
            }),
        }
    }

    fn arm(&self, base: &'a str, tip: &'a str, choice: &Choice) -> Result<UrdfArm, UrdfError> {
        let (foot, foot_from_base) = self.foot(base);
        let way = self.way(foot, tip).ok_or_else(|| self.no_way(base, tip))?;
        let mut rounding = self.rounding();
        let mut joints = Vec::new();
        let mut notes = Vec::new();
        let mut digits = Digits::default();
        let base_from_foot = foot_from_base.inverse();
        let mut fixed = base_from_foot;
        for joint in &way {
            finite("an origin", &joint.name, &joint.origin)?;
            fixed = fixed * rounding.pose(&joint.origin);
            let written = joint.origin.rpy.0;
            digits.frame(
                written.map(|a| rounding.angle(a)),
                written,
                &joint.origin.xyz.0,
            );
            match joint.joint_type {
                JointType::Fixed => continue,
                JointType::Revolute | JointType::Continuous => {}
                _ => {
                    return Err(UrdfError::Kind {
                        joint: joint.name.clone(),
                        kind: kind(joint).into(),
                    });
                }
            }
            if let Some(mimic) = &joint.mimic {
                return Err(UrdfError::Mimic {
                    joint: joint.name.clone(),
                    by: mimic.joint.clone(),
                });
            }
            joints.push(turning(joint, fixed, &mut notes)?);
            digits.axis(&joint.axis.xyz.0);
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
            packages: BTreeSet::new(),
            notes,
        };
        if !rounding.exact {
            digits.make_exact(&mut arm);
        }
        self.contents((foot, base_from_foot), &mut arm, choice, &mut rounding)?;
        if rounding.by > 0.0 {
            arm.notes.push(format!(
                "angles of frames within {:.1e} rad of a multiple of 45 deg are taken as exact; \
                 --exact-angles takes them as written",
                rounding.by
            ));
        }
        Ok(arm)
    }

    /// Why there is no way: the tip hangs elsewhere, or a joint that moves is between it and the
    /// base's side.
    fn no_way(&self, base: &'a str, tip: &'a str) -> UrdfError {
        let mut above_base = vec![base];
        while let Some(joint) = self.above.get(above_base[above_base.len() - 1]) {
            above_base.push(&joint.parent.link);
        }
        let mut at = tip;
        while !above_base.contains(&at) {
            let Some(joint) = self.above.get(at) else {
                return UrdfError::NoWay {
                    base: base.into(),
                    tip: tip.into(),
                };
            };
            at = &joint.parent.link;
        }
        let below = above_base.iter().take_while(|link| **link != at);
        let moving = below
            .filter_map(|link| self.above.get(link))
            .find(|joint| joint.joint_type != JointType::Fixed);
        UrdfError::MovingBase {
            base: base.into(),
            tip: tip.into(),
            joint: moving.map_or_else(String::new, |joint| joint.name.clone()),
        }
    }

    /// Masses and shapes of all links that the six joints, or none of them, move; the foot with the
    /// base's view of it.
    fn contents(
        &self,
        (foot, base_from_foot): (&str, Pose),
        arm: &mut UrdfArm,
        choice: &Choice,
        rounding: &mut Rounding,
    ) -> Result<(), UrdfError> {
        for (name, link) in &self.links {
            let Some(way) = self.way(foot, name) else {
                continue;
            };
            let (mut moved_by, mut place) = (0, base_from_foot);
            let mut has_text = false;
            for joint in way {
                let is_next = arm
                    .joints
                    .get(moved_by)
                    .is_some_and(|j| j.name == joint.name);
                if is_next {
                    moved_by += 1;
                    place = Pose::identity();
                } else if joint.joint_type == JointType::Fixed {
                    place = place * rounding.pose(&joint.origin);
                } else {
                    // a finger of a gripper or another arm
                    has_text = true;
                }
            }
            if has_text {
                continue;
            }
            let mass = link.inertial.mass.value;
            if !(0.0..=MOST_MASS_KG).contains(&mass) {
                return Err(UrdfError::Number {
                    what: "the mass",
                    name: (*name).into(),
                    found: format!("{mass:?} kg; it is from 0 to {MOST_MASS_KG} kg"),
                });
            }
            if mass > 0.0 && moved_by > 0 {
                let centre = link.inertial.origin.xyz.0;
                if let Some(found) = centre.into_iter().find(|x| !is_near(*x)) {
                    return Err(UrdfError::Number {
                        what: "the centre of gravity",
                        name: (*name).into(),
                        found: format!("{found:?} m; the limit is {MOST_M} m"),
                    });
                }
                let cog = place.transform(centre);
                arm.masses.push((moved_by, mass, cog));
            }
            if choice.shapes {
                for collision in &link.collision {
                    finite("an origin", name, &collision.origin)?;
                    arm.shapes.push(UrdfShape {
                        moved_by,
                        link: (*name).into(),
                        joint_from_shape: place * rounding.pose(&collision.origin),
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
        known: links.keys().map(|name| (*name).to_owned()).collect(),
    }
}

/// Whether a coordinate may be one of a robot, metres.
fn is_near(x: f64) -> bool {
    x.abs() <= MOST_M
}

fn finite(what: &'static str, name: &str, origin: &urdf_rs::Pose) -> Result<(), UrdfError> {
    let number = |found: String| UrdfError::Number {
        what,
        name: name.into(),
        found,
    };
    let mut numbers = origin.xyz.0.into_iter().chain(origin.rpy.0);
    if let Some(found) = numbers.find(|x| !x.is_finite()) {
        return Err(number(found.to_string()));
    }
    if let Some(found) = origin.xyz.0.into_iter().find(|x| !is_near(*x)) {
        return Err(number(format!("{found:?} m; the limit is {MOST_M} m")));
    }
    let mut angles = origin.rpy.0.into_iter();
    match angles.find(|angle| angle.abs() > MOST_ANGLE_RAD) {
        None => Ok(()),
        Some(found) => Err(number(format!("rpy {found} rad, which looks like degrees"))),
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
    let axis: Vector = joint.axis.xyz.0;
    let long = norm(axis);
    if !(long.is_finite() && long > 1e-9) {
        return Err(number("the axis", format!("{axis:?}")));
    }
    let limit = &joint.limit;
    let full = 360.0 * DEG;
    let (min_rad, max_rad) = if joint.joint_type == JointType::Continuous {
        notes.push(format!(
            "joint `{}` rotates without end; its limits here are \u{b1}360 deg",
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
    if min_rad.abs().max(max_rad.abs()) > MOST_LIMIT_RAD {
        return Err(number(
            "the range of the limit",
            format!("{min_rad} to {max_rad} rad; limits look like degrees"),
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
        Geometry::Box { size } => (UrdfForm::Box(size.0), size.0.to_vec()),
        Geometry::Cylinder { radius, length } => {
            (UrdfForm::Cylinder(*radius, *length), vec![*radius, *length])
        }
        Geometry::Capsule { radius, length } => {
            (UrdfForm::Capsule(*radius, *length), vec![*radius, *length])
        }
        Geometry::Sphere { radius } => (UrdfForm::Sphere(*radius), vec![*radius]),
        Geometry::Mesh { filename, scale } => {
            let s = scale.map_or([1.0; 3], |scale| scale.0);
            if !(s[0] > 0.0 && s[0] == s[1] && s[1] == s[2]) {
                return Err(UrdfError::Scale {
                    link: link.into(),
                    scale: s,
                });
            }
            (UrdfForm::Mesh(filename.clone(), s[0]), vec![s[0]])
        }
    };
    if let UrdfForm::Mesh(file, _) = &form
        && leads_out(file)
    {
        return Err(UrdfError::Outside {
            file: file.clone(),
            link: link.into(),
        });
    }
    let is_size = |x: &f64| *x > 0.0 && *x <= MOST_M;
    match numbers.into_iter().find(|x| !is_size(x)) {
        None => Ok(form),
        Some(found) => Err(UrdfError::Number {
            what: "a size of the collision shape",
            name: link.into(),
            found: format!("{found:?}; it is above 0 and at most {MOST_M}"),
        }),
    }
}
