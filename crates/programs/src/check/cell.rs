//! The cell file: what stands around the robot, what it carries, and how near they may come.

use crate::geometry::units::m_from_mm;
use crate::model::external::ExternalAxes;
use crate::model::shape::{Form, Shape};
use crate::profile::file::{self, Number};
use crate::profile::{Fault, ProfileError};
use poseshift_profile::with_shape;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_yaml::{Location, Spanned};

/// The format name that stands first in a cell file.
pub const FORMAT: &str = "cell/1";

/// What stands around a robot and what it carries.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Cell {
    /// Distance required between any two bodies, metres.
    pub clearance_m: f64,
    /// Bodies fixed in the world.
    pub bodies: Vec<Named>,
    /// Bodies that move with the arm or with positioners.
    pub attached: Vec<Attached>,
    /// What is required of some pairs.
    pub pairs: Vec<Pair>,
}

/// A body with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// Its shape in the world.
    pub shape: Shape,
}

/// A body on the arm or on a positioner.
#[derive(Clone, Debug, PartialEq)]
pub struct Attached {
    /// Its name.
    pub name: String,
    /// What it moves with.
    pub to: Carrier,
    /// Its shape in the carrier's frame.
    pub shape: Shape,
}

/// What an attached body moves with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// The flange.
    Flange,
    /// The base (0) or a link (1 to 6).
    Link(usize),
    /// The plate of a positioner of the profile, as written: `positioner1`, or `positioner STN1`.
    Positioner(String),
}

/// A body on a positioner that the profile does not have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{body}` is attached to `{to}`, which the profile does not have")]
pub struct UnknownPositioner {
    /// Name of the body.
    pub body: String,
    /// What it is attached to.
    pub to: String,
    /// What there is.
    pub known: Vec<String>,
}

impl Attached {
    /// Index of the positioner that carries it; `None` where the arm does.
    ///
    /// # Errors
    /// If the profile has no such positioner.
    pub fn positioner(&self, external: &ExternalAxes) -> Result<Option<usize>, UnknownPositioner> {
        let Carrier::Positioner(to) = &self.to else {
            return Ok(None);
        };
        let names = external.positioners.iter().zip(1..);
        let names: Vec<[String; 2]> = names
            .map(|(is, n)| {
                [
                    format!("{POSITIONER}{n}"),
                    format!("{POSITIONER} {}", is.name),
                ]
            })
            .collect();
        let found = names.iter().position(|names| names.contains(to));
        found.map(Some).ok_or_else(|| UnknownPositioner {
            body: self.name.clone(),
            to: to.clone(),
            known: names.into_iter().flatten().collect(),
        })
    }
}

/// How a carrier begins that is a positioner: its number from 1 follows, or its name behind a space.
const POSITIONER: &str = "positioner";

/// Why the clearance of two bodies is the same wherever the robot goes.
fn why_still(names: [&str; 2], attached: &[Attached]) -> Option<&'static str> {
    let own = names.map(|name| LINKS.iter().position(|link| *link == name));
    let carrier = |at: usize| {
        let body = attached.iter().find(|body| body.name == names[at]);
        let carried = body.map(|body| match &body.to {
            Carrier::Flange => Carrier::Link(6),
            other => other.clone(),
        });
        own[at].map(Carrier::Link).or(carried)
    };
    match [carrier(0), carrier(1)] {
        [None, None] => Some("neither of them moves"),
        [Some(a), Some(b)] if a == b => Some("they move together"),
        _ => match own {
            [Some(a), Some(b)] if a.abs_diff(b) == 1 => {
                Some("neighbouring links touch where they are joined")
            }
            _ => None,
        },
    }
}

/// What is required of two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Name of the one: a body, an attached body, or `link0` to `link6`.
    pub a: String,
    /// Name of the other.
    pub b: String,
    /// Their clearance, metres; `None` where they may touch.
    pub clearance_m: Option<f64>,
}

/// Names of the robot's own bodies.
pub const LINKS: [&str; 7] = [
    "link0", "link1", "link2", "link3", "link4", "link5", "link6",
];

/// A cell: what stands around a robot and what it carries.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CellFile {
    /// Format and version: `cell/1`.
    #[schemars(with = "String")]
    poseshift: Spanned<String>,
    /// Required between any two bodies.
    #[serde(default)]
    #[schemars(with = "Number")]
    clearance_mm: Option<Spanned<Number>>,
    /// Fixed in the world.
    #[serde(default)]
    #[schemars(with = "Vec<BodyFile>")]
    bodies: Vec<Spanned<BodyFile>>,
    /// Moving with the flange, a link, the carriage of a track, or the plate of a positioner.
    #[serde(default)]
    #[schemars(with = "Vec<AttachedFile>")]
    attached: Vec<Spanned<AttachedFile>>,
    /// Other clearance for some pairs.
    #[serde(default)]
    #[schemars(with = "Vec<PairFile>")]
    pairs: Vec<Spanned<PairFile>>,
}

with_shape! {
    /// A body fixed in the world.
    BodyFile {
        /// Its name.
        name: String,
    }
}

with_shape! {
    /// A body that moves with the arm or with a positioner.
    AttachedFile {
        /// Its name.
        name: String,
        /// `flange`, `link0` to `link6`, `track`: the carriage under the base, or `positioner1`: the
        /// plate of the profile's first positioner (`positioner STN1`: by its name).
        to: String,
    }
}

/// What is required of two bodies.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PairFile {
    /// Name of the one: a body, or `link0` to `link6`.
    a: String,
    /// Name of the other.
    b: String,
    /// Their clearance.
    #[serde(default)]
    clearance_mm: Option<Number>,
    /// They may touch.
    #[serde(default)]
    allow: bool,
}

impl Cell {
    /// Reads a cell file's text.
    ///
    /// # Errors
    /// Anything the format does not allow, with line and column.
    pub fn from_yaml(text: &str) -> Result<Self, ProfileError> {
        let file: CellFile =
            serde_yaml::from_str(text).map_err(|error| ProfileError::of(text, FORMAT, error))?;
        if file.poseshift.value != FORMAT {
            return Err(Fault::Format {
                found: file.poseshift.value,
                reads: FORMAT,
            }
            .at(file.poseshift.defined));
        }
        let clearance_m = match &file.clearance_mm {
            Some(number) => clearance(number.value, number.defined)?,
            None => 0.0,
        };
        let mut names: Vec<String> = LINKS.map(String::from).to_vec();
        let mut name = |name: &str, at: Location| {
            if names.iter().any(|known| known == name) {
                return Err(Fault::DuplicateBody { name: name.into() }.at(at));
            }
            names.push(name.into());
            Ok(name.to_owned())
        };
        let mut bodies = Vec::new();
        for body in &file.bodies {
            bodies.push(Named {
                name: name(&body.value.name, body.defined)?,
                shape: body.value.shape(body.defined)?,
            });
        }
        let mut attached = Vec::new();
        for body in &file.attached {
            let shape = body.value.shape(body.defined)?;
            let name = name(&body.value.name, body.defined)?;
            if matches!(shape.form, Form::Plane { .. }) {
                return Err(Fault::MovingPlane { name }.at(body.defined));
            }
            attached.push(Attached {
                name,
                to: carrier(&body.value.to, body.defined)?,
                shape,
            });
        }
        let mut pairs: Vec<Pair> = Vec::new();
        for pair in &file.pairs {
            let (at, pair) = (pair.defined, &pair.value);
            for name in [&pair.a, &pair.b] {
                if !names.contains(name) {
                    return Err(Fault::UnknownBody {
                        name: name.clone(),
                        known: names.clone(),
                    }
                    .at(at));
                }
            }
            let is_known = |known: &&Pair| {
                [&known.a, &known.b] == [&pair.a, &pair.b]
                    || [&known.b, &known.a] == [&pair.a, &pair.b]
            };
            if pairs.iter().any(|known| is_known(&known)) {
                return Err(Fault::PairTwice {
                    a: pair.a.clone(),
                    b: pair.b.clone(),
                }
                .at(at));
            }
            let clearance_m = match (pair.clearance_mm, pair.allow) {
                (Some(number), false) => Some(clearance(number, at)?),
                (None, true) => None,
                _ => return Err(Fault::PairMeaning.at(at)),
            };
            if clearance_m.is_some()
                && let Some(why) = why_still([&pair.a, &pair.b], &attached)
            {
                return Err(Fault::PairStill {
                    a: pair.a.clone(),
                    b: pair.b.clone(),
                    why,
                }
                .at(at));
            }
            pairs.push(Pair {
                a: pair.a.clone(),
                b: pair.b.clone(),
                clearance_m,
            });
        }
        Ok(Self {
            clearance_m,
            bodies,
            attached,
            pairs,
        })
    }

    /// The JSON Schema of the format.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        file::schema::<CellFile>(FORMAT)
    }
}

fn clearance(mm: Number, at: Location) -> Result<f64, ProfileError> {
    if mm.0 < 0.0 {
        return Err(Fault::OutOfRange {
            key: "clearance_mm",
            found: mm.0,
            low: 0.0,
            high: f64::INFINITY,
        }
        .at(at));
    }
    Ok(m_from_mm(mm.0))
}

fn carrier(name: &str, at: Location) -> Result<Carrier, ProfileError> {
    match name {
        "flange" => return Ok(Carrier::Flange),
        // what rides on the carriage rides with the base
        "track" => return Ok(Carrier::Link(0)),
        // which there are the profile says
        _ if name.starts_with(POSITIONER) => return Ok(Carrier::Positioner(name.to_owned())),
        _ => {}
    }
    let link = LINKS.iter().position(|link| *link == name);
    link.map(Carrier::Link).ok_or_else(|| {
        Fault::UnknownBody {
            name: name.into(),
            known: ["flange", "track", "positioner1"]
                .iter()
                .chain(&LINKS)
                .map(|name| (*name).to_owned())
                .collect(),
        }
        .at(at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "poseshift: cell/1
clearance_mm: 5
bodies:
  - {name: wall, box_mm: [1, 2000, 2000], at: {x_mm: 600, y_mm: 0, z_mm: 500, rx_deg: 0, ry_deg: 0, rz_deg: 0}}
  - {name: floor, plane: {normal: [0, 0, 2], offset_mm: -10}}
attached:
  - {name: gun, to: flange, capsule_mm: {from: [0, 0, 0], to: [50, 25, 100], radius: 20}}
pairs: [{a: gun, b: wall, clearance_mm: 0}, {a: link0, b: floor, allow: true}]
";

    #[test]
    fn lengths_become_metres_and_normals_unit() {
        let cell = Cell::from_yaml(TEXT).expect("a cell");
        assert_eq!(cell.clearance_m, 0.005);
        let plane = Form::Plane {
            normal: [0.0, 0.0, 1.0],
            offset_m: -0.01,
        };
        assert_eq!(cell.bodies[1].shape.form, plane);
        // of any length
        for long in ["1e200", "1e-8", "1.5e308"] {
            let text = TEXT.replace("[0, 0, 2]", &format!("[0, 0, {long}]"));
            let cell = Cell::from_yaml(&text).expect(long);
            assert_eq!(cell.bodies[1].shape.form, plane, "{long}");
        }
        assert_eq!(cell.pairs[1].clearance_m, None);
        assert_eq!(cell.attached[0].to, Carrier::Flange);
    }

    #[test]
    fn faults_are_reported_with_their_line() {
        let cases = [
            ("box_mm: [1,", "box_mm: [0,", 4, "above 0"),
            ("[1, 2000, 2000]", "[0.001, 0.9, 0.9]", 4, "in metres"),
            ("rz_deg: 0", "rz_deg: 1000", 4, "rz_deg"),
            ("name: floor", "name: wall", 5, "two bodies"),
            ("to: flange", "to: hand", 7, "no body is called `hand`"),
            ("allow: true", "allow: false", 8, "either clearance_mm"),
            ("b: wall", "b: door", 8, "no body is called `door`"),
            ("a: link0, b: floor", "a: wall, b: gun", 8, "stands twice"),
            (
                "a: gun, b: wall",
                "a: floor, b: wall",
                8,
                "neither of them moves",
            ),
            ("a: gun, b: wall", "a: gun, b: link6", 8, "move together"),
            (
                "a: gun, b: wall",
                "a: link3, b: link2",
                8,
                "where they are joined",
            ),
            ("cell/1", "cell/2", 1, "format"),
            ("capsule_mm", "capsule", 7, "capsule"),
            ("clearance_mm: 5", "clearance_mm: .nan", 2, "finite"),
            (
                "capsule_mm: {from: [0, 0, 0], to: [50, 25, 100], radius: 20}",
                "plane: {normal: [0, 0, 1], offset_mm: 0}",
                7,
                "cannot move",
            ),
        ];
        for (from, to, line, says) in cases {
            assert!(TEXT.contains(from));
            let error = Cell::from_yaml(&TEXT.replace(from, to)).expect_err(to);
            assert_eq!(error.line, line, "{error}");
            assert!(error.to_string().contains(says), "{error}");
        }
    }
}
