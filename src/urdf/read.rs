//! What a URDF says of links and joints, as it is written.
//!
//! # Limits
//! Links and joints at the top of the file, 2 000 at most; looks, inertia and transmissions are not read.
//!
//! # Source
//! ROS, "URDF/XML": link, joint, origin (with `quat_xyzw` from version 1.1), limit (without bounds where they are left out, from
//! version 1.2).

use super::UrdfError;
use crate::geometry::{Quaternion, Vector};
use crate::xml::{self, Element, XmlError};

/// Links of a file: several arms with their grippers have some hundred.
const MOST_LINKS: usize = 2_000;

/// All of it.
pub(super) struct Robot {
    pub name: String,
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
}

/// A body.
#[derive(Default)]
pub(super) struct Link {
    pub name: String,
    pub mass_kg: f64,
    /// Where its mass is.
    pub centre: Origin,
    pub collision: Vec<Collision>,
}

/// A shape of a link.
pub(super) struct Collision {
    pub origin: Origin,
    pub geometry: Geometry,
}

/// What it looks like, metres.
pub(super) enum Geometry {
    Box {
        size: Vector,
    },
    Cylinder {
        radius: f64,
        length: f64,
    },
    Capsule {
        radius: f64,
        length: f64,
    },
    Sphere {
        radius: f64,
    },
    Mesh {
        filename: String,
        scale: Option<Vector>,
    },
}

/// A frame: metres, and roll, pitch, yaw about fixed axes, radians.
#[derive(Clone, Copy, Default)]
pub(super) struct Origin {
    pub xyz: Vector,
    pub rpy: Vector,
}

/// What holds two links together.
pub(super) struct Joint {
    pub name: String,
    pub joint_type: JointType,
    pub origin: Origin,
    pub parent: String,
    pub child: String,
    pub axis: Vector,
    pub limit: Limit,
    /// The joint that drives it.
    pub mimic: Option<String>,
}

/// How it moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JointType {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
    Floating,
    Planar,
    Spherical,
}

impl JointType {
    const ALL: [(&str, Self); 7] = [
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("fixed", Self::Fixed),
        ("floating", Self::Floating),
        ("planar", Self::Planar),
        ("spherical", Self::Spherical),
    ];

    /// Its name in files.
    pub(super) fn name(self) -> &'static str {
        let mut all = Self::ALL.iter();
        let found = all.find(|(_, kind)| *kind == self);
        found.map_or("", |(name, _)| name)
    }
}

/// How far and how fast it moves.
#[derive(Clone, Copy, Default)]
pub(super) struct Limit {
    pub lower: f64,
    pub upper: f64,
    pub velocity: f64,
}

/// The versions that mean something else by what they leave out.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Version {
    First,
    WithQuaternions,
    WithoutLimits,
}

/// Reads a file's text.
pub(super) fn robot(text: &str) -> Result<Robot, UrdfError> {
    let unreadable = |error: XmlError| UrdfError::Unreadable {
        message: error.to_string(),
    };
    let root = xml::read(text).map_err(unreadable)?;
    let found = root.all("link").count().max(root.all("joint").count());
    if found > MOST_LINKS {
        return Err(UrdfError::TooMany {
            found,
            most: MOST_LINKS,
        });
    }
    contents(&root).map_err(unreadable)
}

fn contents(root: &Element) -> Result<Robot, XmlError> {
    if root.name != "robot" {
        return Err(root.fault(format!("the file is a <{}>, not a <robot>", root.name)));
    }
    let written = root.attribute("version").unwrap_or("1.0").trim();
    let version = match written
        .split_once('.')
        .map(|(major, minor)| (major.parse(), minor.parse()))
    {
        Some((Ok(1), Ok(0u32))) => Version::First,
        Some((Ok(1), Ok(1))) => Version::WithQuaternions,
        Some((Ok(1u32..), Ok(_))) => Version::WithoutLimits,
        _ => Version::First,
    };
    let links = root.all("link").map(|link| self::link(link, version));
    let joints = root.all("joint").map(|joint| self::joint(joint, version));
    Ok(Robot {
        name: root.attribute("name").unwrap_or_default().into(),
        links: links.collect::<Result<_, _>>()?,
        joints: joints.collect::<Result<_, _>>()?,
    })
}

fn link(link: &Element, version: Version) -> Result<Link, XmlError> {
    let mut out = Link {
        name: needed(link, "name")?.into(),
        ..Link::default()
    };
    if let Some(inertial) = link.first("inertial") {
        out.mass_kg = number(child(inertial, "mass")?, "value")?;
        out.centre = origin(inertial, version)?;
    }
    for collision in link.all("collision") {
        out.collision.push(Collision {
            origin: origin(collision, version)?,
            geometry: geometry(child(collision, "geometry")?)?,
        });
    }
    Ok(out)
}

fn joint(joint: &Element, version: Version) -> Result<Joint, XmlError> {
    let kind = needed(joint, "type")?;
    let mut kinds = JointType::ALL.iter();
    let Some((_, joint_type)) = kinds.find(|(name, _)| *name == kind) else {
        return Err(joint.fault(format!("a joint of the type `{kind}` is not known")));
    };
    let open = version == Version::WithoutLimits;
    let limit = match joint.first("limit") {
        None => Limit::default(),
        Some(limit) => {
            let of = |name: &str, open_end: f64| {
                let default = if open { open_end } else { 0.0 };
                limit
                    .attribute(name)
                    .map_or(Ok(default), |_| number(limit, name))
            };
            Limit {
                lower: of("lower", f64::NEG_INFINITY)?,
                upper: of("upper", f64::INFINITY)?,
                velocity: of("velocity", f64::INFINITY)?,
            }
        }
    };
    let axis = joint
        .first("axis")
        .and_then(|axis| Some((axis, axis.attribute("xyz")?)));
    let mimic = joint.first("mimic").map(|mimic| needed(mimic, "joint"));
    Ok(Joint {
        name: needed(joint, "name")?.into(),
        joint_type: *joint_type,
        origin: origin(joint, version)?,
        parent: needed(child(joint, "parent")?, "link")?.into(),
        child: needed(child(joint, "child")?, "link")?.into(),
        axis: axis.map_or(Ok([1.0, 0.0, 0.0]), |(axis, text)| numbers(axis, text))?,
        limit,
        mimic: mimic.transpose()?.map(str::to_owned),
    })
}

fn geometry(geometry: &Element) -> Result<Geometry, XmlError> {
    let Some(shape) = geometry.children.first() else {
        return Err(geometry.fault("a geometry without a shape"));
    };
    let of = |name: &str| number(shape, name);
    let vector = |name: &str| numbers(shape, needed(shape, name)?);
    Ok(match shape.name.as_str() {
        "box" => Geometry::Box {
            size: vector("size")?,
        },
        "cylinder" => Geometry::Cylinder {
            radius: of("radius")?,
            length: of("length")?,
        },
        "capsule" => Geometry::Capsule {
            radius: of("radius")?,
            length: of("length")?,
        },
        "sphere" => Geometry::Sphere {
            radius: of("radius")?,
        },
        "mesh" => Geometry::Mesh {
            filename: needed(shape, "filename")?.into(),
            scale: shape
                .attribute("scale")
                .map(|text| numbers(shape, text))
                .transpose()?,
        },
        other => return Err(shape.fault(format!("a shape <{other}> is not known"))),
    })
}

/// The frame of an element; that of what it belongs to where it has none.
fn origin(of: &Element, version: Version) -> Result<Origin, XmlError> {
    let Some(origin) = of.first("origin") else {
        return Ok(Origin::default());
    };
    let vector = |name: &str| {
        let text = origin.attribute(name);
        text.map(|text| numbers::<3>(origin, text)).transpose()
    };
    let (xyz, mut rpy) = (vector("xyz")?.unwrap_or_default(), vector("rpy")?);
    let quaternion = origin.attribute("quat_xyzw");
    if let Some(text) = quaternion.filter(|_| version >= Version::WithQuaternions) {
        if rpy.is_some() {
            return Err(
                origin.fault("an <origin> with `rpy` and `quat_xyzw`: one of them is meant")
            );
        }
        let [x, y, z, w] = numbers::<4>(origin, text)?;
        let long = [x, y, z, w]
            .iter()
            .map(|part| part * part)
            .sum::<f64>()
            .sqrt();
        if !(long.is_finite() && long > 0.0) {
            return Err(origin.fault(format!("the quaternion `{text}` has no direction")));
        }
        let unit = Quaternion([w, x, y, z].map(|part| part / long));
        let [yaw, pitch, roll] = unit.rotation().rzryrx(0.0);
        rpy = Some([roll, pitch, yaw]);
    }
    Ok(Origin {
        xyz,
        rpy: rpy.unwrap_or_default(),
    })
}

fn child<'e, 'a>(of: &'e Element<'a>, name: &str) -> Result<&'e Element<'a>, XmlError> {
    of.first(name)
        .ok_or_else(|| of.fault(format!("a <{}> without <{name}>", of.name)))
}

fn needed<'e>(of: &'e Element, name: &str) -> Result<&'e str, XmlError> {
    of.attribute(name)
        .ok_or_else(|| of.fault(format!("a <{}> without `{name}`", of.name)))
}

fn number(of: &Element, name: &str) -> Result<f64, XmlError> {
    let text = needed(of, name)?;
    text.trim()
        .parse()
        .map_err(|_| of.fault(format!("`{name}` is `{text}`, no number")))
}

fn numbers<const N: usize>(of: &Element, text: &str) -> Result<[f64; N], XmlError> {
    let all: Result<Vec<f64>, _> = text.split_whitespace().map(str::parse).collect();
    let all = all.ok().and_then(|all| all.try_into().ok());
    all.ok_or_else(|| of.fault(format!("`{text}`: {N} numbers are needed")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn only_joint(version: &str, more: &str) -> Result<Joint, UrdfError> {
        let text = format!(
            "<robot name='r' version='{version}'><material name='a'/><material name='a'/><link name='a'/><link name='b'/>\n\
             <joint name='j' type='revolute'><parent link='a'/><child link='b'/>\n{more}</joint></robot>"
        );
        Ok(robot(&text)?.joints.remove(0))
    }

    #[test]
    fn a_quaternion_counts_from_version_1_1_and_open_limits_from_1_2() {
        let turned = "<origin xyz='1 2 3' quat_xyzw='0 0 1 1'/>";
        assert_eq!(
            only_joint("1.0", turned).expect("a joint").origin.rpy,
            [0.0; 3]
        );
        let [r, p, y] = only_joint("1.1", turned).expect("a joint").origin.rpy;
        assert!(r.abs() + p.abs() + (y - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        let limit = "<limit upper='1'/>";
        assert_eq!(only_joint("1.0", limit).expect("a joint").limit.lower, 0.0);
        let open = only_joint("1.2", limit).expect("a joint").limit;
        assert_eq!((open.lower, open.upper), (f64::NEG_INFINITY, 1.0));
    }

    #[test]
    fn what_is_missing_or_no_number_is_an_error_with_its_line() {
        for (more, says) in [
            ("<axis xyz='1 0'/>", "line 3: `1 0`: 3 numbers"),
            ("<limit lower='x'/>", "line 3: `lower` is `x`"),
            ("<mimic/>", "line 3: a <mimic> without `joint`"),
            ("<origin rpy='1 0 0' quat_xyzw='0 0 0 1'/>", "one of them"),
            ("<origin quat_xyzw='0 0 0 0'/>", "no direction"),
        ] {
            let error = only_joint("1.1", more).err().expect(says).to_string();
            assert!(error.contains(says), "{error}");
        }
        let shape = "<robot><link name='a'><collision><geometry><cone/></geometry></collision></link></robot>";
        let error = robot(shape).err().expect("a cone").to_string();
        assert!(error.contains("<cone> is not known"), "{error}");
    }
}
