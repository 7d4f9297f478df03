//! Data files (.dtx) of both generations: what is declared, and where its numbers stand.
//!
//! Since s7 a value is `<Value key="0" x=".." … fatherId="fPart[0]" />` in a `<Data name type>`;
//! before, `<valuePoint index>` with `<tpValue x=".." … />` and `<cpValue … />` in a `<point name>`
//! whose father has a tag of its own. Numbers that are left out are zero; sides of the arm that are
//! left out stay as they are.

use super::code::plain_key;
use crate::geometry::units::MM;
use crate::program::kit::Fault;
use crate::program::script::short;
use crate::program::xml::{Attribute, Node, Nodes, Tag};
use crate::program::{Number, Source, SpeedZone};
use foldhash::{HashSet, HashSetExt};

/// What a name is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    Point,
    Joint,
    Frame,
    Tool,
    Trsf,
    Mdesc,
    Num,
    /// A point or joints of an arm that has not six axes.
    OtherArm,
    Other,
}

impl Kind {
    /// The kind of a type's name, or of an old tag.
    pub(super) fn of(name: &[u8]) -> Self {
        match name {
            b"point" | b"pointRx" => Self::Point,
            b"joint" | b"jointRx" => Self::Joint,
            b"frame" => Self::Frame,
            b"tool" => Self::Tool,
            b"trsf" => Self::Trsf,
            b"mdesc" => Self::Mdesc,
            b"num" => Self::Num,
            _ if name.starts_with(b"point") || name.starts_with(b"joint") => Self::OtherArm,
            _ => Self::Other,
        }
    }

    /// Whether moves go there.
    pub(super) fn is_place(self) -> bool {
        matches!(self, Self::Point | Self::Joint)
    }
}

/// Attributes of a pose and of joints, in the order of the format.
pub(super) const POSE: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
pub(super) const JOINTS: [&str; 6] = ["j1", "j2", "j3", "j4", "j5", "j6"];
/// Attributes of the arm's sides, and what they are called: the first is 0, the second 1. `same`
/// and `free` leave the side open.
pub(super) const SIDES: [(&str, [&str; 2]); 3] = [
    ("shoulder", ["lefty", "righty"]),
    ("elbow", ["epositive", "enegative"]),
    ("wrist", ["wpositive", "wnegative"]),
];

/// `alias:name[index]`; no name where nothing is said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Father<'a> {
    pub alias: &'a [u8],
    pub name: &'a [u8],
    pub index: &'a [u8],
}

impl<'a> Father<'a> {
    /// The world, or nothing: what hangs there is where its numbers say.
    pub(super) fn is_world(&self) -> bool {
        matches!(self.name, b"" | b"world")
    }

    fn of(text: &'a [u8]) -> Self {
        let (alias, rest) = match memchr::memchr(b':', text) {
            Some(at) => (&text[..at], &text[at + 1..]),
            None => (&b""[..], text),
        };
        let (name, index) = match memchr::memchr(b'[', rest) {
            Some(at) => (&rest[..at], rest[at + 1..].trim_ascii_end()),
            None => (rest, &b"0"[..]),
        };
        Self {
            alias: alias.trim_ascii(),
            name: name.trim_ascii(),
            index: index.strip_suffix(b"]").unwrap_or(index).trim_ascii(),
        }
    }
}

/// One value of a name.
#[derive(Clone, Debug)]
pub(super) struct Element<'a> {
    pub key: &'a [u8],
    /// Its first byte, and behind its last.
    pub at: u32,
    pub end: u32,
    /// Of a pose or joints; of length 0 where they are left out.
    pub numbers: [Number; 6],
    /// Some of the numbers stand there.
    pub is_given: bool,
    /// Sides of the arm that are stated: 0 or 1.
    pub sides: [Option<Number>; 3],
    /// Sides that are free.
    pub free: [bool; 3],
    pub father: Father<'a>,
    pub speed_zone: SpeedZone,
}

impl<'a> Element<'a> {
    fn new(at: usize) -> Self {
        let nothing = Number {
            start: short(at),
            length: 0,
            value: 0.0,
        };
        Self {
            key: b"0",
            at: short(at),
            end: short(at),
            numbers: [nothing; 6],
            is_given: false,
            sides: [None; 3],
            free: [false; 3],
            father: Father::default(),
            speed_zone: SpeedZone {
                zone_m: Some(0.0),
                ..SpeedZone::default()
            },
        }
    }

    /// Reads what the attributes of a tag say.
    fn add(&mut self, kind: Kind, tag: &Tag<'a>) -> Result<(), Fault> {
        self.end = short(tag.end);
        if kind == Kind::Mdesc {
            self.key = tag.attribute(b"key")?.map_or(self.key, |key| key.value);
            self.speed_zone = speed_zone(tag)?;
            return Ok(());
        }
        if kind == Kind::Num {
            self.key = tag.attribute(b"key")?.map_or(self.key, |key| key.value);
            // a number that is none is refused where a move needs it
            let value = tag.attribute(b"value")?.map(|value| value.number());
            if let Some(Ok(value)) = value {
                (self.numbers[0], self.is_given) = (value, true);
            }
            return Ok(());
        }
        let has_numbers = tag.name != b"cpValue";
        if has_numbers && self.is_given {
            return Err(twice(tag));
        }
        let names = if kind == Kind::Joint { JOINTS } else { POSE };
        let (mut behind, mut ends) = (tag.behind_name(), [None; 6]);
        for attribute in tag.attributes() {
            let attribute = attribute?;
            let is = |name: &&str| name.as_bytes() == attribute.name;
            if let Some(at) = names.iter().position(is) {
                if has_numbers {
                    self.numbers[at] = attribute.number()?;
                    ends[at] = Some(attribute.end);
                    self.is_given = true;
                }
            } else if let Some(side) = SIDES.iter().position(|(name, _)| is(name)) {
                if self.sides[side].is_some() || self.free[side] {
                    return Err(twice(tag));
                }
                self.side(kind, side, &attribute)?;
            } else if attribute.name == b"fatherId" {
                self.father = Father::of(attribute.value);
            } else if attribute.name == b"key" {
                (self.key, behind) = (attribute.value, attribute.end);
            } else if is_nearly(&attribute, kind, &names) {
                let expected = if kind == Kind::Joint {
                    "j1 to j6, in small letters, of an arm with six joints"
                } else {
                    "x, y, z, rx, ry and rz in small letters"
                };
                return Err(Fault::unexpected(attribute.start..attribute.end, expected));
            }
        }
        if has_numbers {
            for (number, end) in self.numbers.iter_mut().zip(ends) {
                behind = end.unwrap_or(behind);
                if number.length == 0 {
                    number.start = short(behind);
                }
            }
        }
        Ok(())
    }

    fn side(&mut self, kind: Kind, side: usize, said: &Attribute) -> Result<(), Fault> {
        let (name, words) = SIDES[side];
        let stated = words.iter().position(|word| word.as_bytes() == said.value);
        let behind_letter = said.value.strip_prefix(&name.as_bytes()[..1]);
        let is = |word: &[u8]| said.value == word || behind_letter == Some(word);
        self.free[side] = is(b"free");
        if kind == Kind::Point && stated.is_none() && !self.free[side] && !is(b"same") {
            let expected = [
                "lefty, righty, ssame or sfree",
                "epositive, enegative, esame or efree",
                "wpositive, wnegative, wsame or wfree",
            ];
            let word = said.start..said.end - 1;
            return Err(Fault::unexpected(word, expected[side]));
        }
        self.sides[side] = stated.map(|stated| Number {
            start: short(said.start),
            length: u16::try_from(said.value.len()).expect("a known word is short"),
            value: if stated == 0 { 0.0 } else { 1.0 },
        });
        Ok(())
    }
}

/// Whether an attribute is a coordinate but for the case of its letters, or a joint more than six: what
/// else there is says nothing of where the arm goes.
fn is_nearly(attribute: &Attribute, kind: Kind, names: &[&str; 6]) -> bool {
    let is = |name: &&str| attribute.name.eq_ignore_ascii_case(name.as_bytes());
    let is_joint = || matches!(attribute.name, [b'j' | b'J', b'0'..=b'9', ..]);
    names.iter().any(is) || kind == Kind::Joint && is_joint()
}

/// A value whose numbers stand in two tags: which of them the controller takes, nobody knows.
fn twice(tag: &Tag) -> Fault {
    Fault::unexpected(tag.at..tag.end, "one tag with the numbers of a value")
}

/// Speed and corner of a motion descriptor: the tool's speed where it is limited, and where the
/// path is left.
fn speed_zone(tag: &Tag) -> Result<SpeedZone, Fault> {
    let number = |name: &[u8]| {
        let found = tag.attribute(name)?;
        found
            .map(|one| one.number().map(|number| number.value))
            .transpose()
    };
    let blends = tag
        .attribute(b"blend")?
        .is_some_and(|blend| blend.value != b"off");
    let leave = number(b"leave")?.unwrap_or(LEAVE_MM);
    let speed = number(b"tmax")?.filter(|speed| *speed < NO_LIMIT);
    Ok(SpeedZone {
        speed_m_s: speed.map(|mm| mm * MM),
        zone_m: Some(if blends { leave * MM } else { 0.0 }),
        blends: false,
    })
}

/// Where the path is left, mm, unless it is stated.
const LEAVE_MM: f64 = 50.0;
/// No tool is as fast, mm/s: the descriptor does not limit it.
const NO_LIMIT: f64 = 9999.0;

/// A name with its values.
#[derive(Clone, Debug)]
pub(super) struct Datum<'a> {
    pub name: &'a [u8],
    pub kind: Kind,
    /// Index in [`super::project::World::projects`].
    pub project: u32,
    pub file: u32,
    pub at: u32,
    pub elements: Vec<Element<'a>>,
}

impl Datum<'_> {
    /// The value of a key.
    pub(super) fn element(&self, key: &[u8]) -> Option<usize> {
        let key = &*plain_key(key);
        // keys mostly count up from 0
        let guess = std::str::from_utf8(key)
            .ok()
            .and_then(|key| key.parse().ok());
        let is_key = |at: &usize| self.elements.get(*at).is_some_and(|one| one.key == key);
        guess
            .filter(is_key)
            .or_else(|| (0..self.elements.len()).find(is_key))
    }

    /// The first value whose key another one before it has.
    fn again(&self) -> Option<&Element<'_>> {
        let is_read = !matches!(self.kind, Kind::Other | Kind::OtherArm | Kind::Num);
        let mut known = HashSet::new();
        let mut all = self.elements.iter().filter(|_| is_read);
        all.find(|one| !known.insert(plain_key(one.key)))
    }

    /// How a value is called.
    pub(super) fn name_of(&self, element: usize) -> String {
        let name = Source::text(self.name);
        match &self.elements[element] {
            one if one.key == b"0" && self.elements.len() == 1 => name.into_owned(),
            one => [&*name, "[", &*Source::text(one.key), "]"].concat(),
        }
    }
}

/// A data file.
#[derive(Debug, Default)]
pub(super) struct DataFile<'a> {
    pub data: Vec<Datum<'a>>,
    /// First byte of the last declaration of a point, and behind it: others can be put there.
    pub last_point: Option<(usize, usize)>,
    /// Its tags are those before s7.
    pub is_old: bool,
}

/// Reads a data file.
pub(super) fn read(bytes: &[u8], project: u32, file: u32) -> Result<DataFile<'_>, Fault> {
    let mut found = DataFile::default();
    let mut nodes = Nodes::of(bytes);
    let mut open: Option<Datum> = None;
    // of an old datum
    let mut father = Father::default();
    while let Some(node) = nodes.next()? {
        match node {
            Node::Open(tag) => match &mut open {
                None => {
                    let is_new = tag.name == b"Data";
                    let type_ = if is_new {
                        tag.attribute(b"type")?
                    } else {
                        None
                    };
                    let kind = Kind::of(type_.map_or(tag.name, |type_| type_.value));
                    let name = tag.attribute(b"name")?;
                    let (Some(name), true) = (name, is_new || kind != Kind::Other) else {
                        continue;
                    };
                    found.is_old |= !is_new;
                    father = Father::default();
                    let datum = Datum {
                        name: name.value,
                        kind,
                        project,
                        file,
                        at: short(tag.at),
                        elements: Vec::new(),
                    };
                    if tag.is_empty {
                        found.data.push(datum);
                    } else {
                        open = Some(datum);
                    }
                }
                Some(datum) => inside(datum, &tag, &mut father)?,
            },
            Node::Close(name, _, end) => {
                let ends = open
                    .as_ref()
                    .is_some_and(|_| name == b"Data" || Kind::of(name) != Kind::Other);
                if let Some(datum) = open.take_if(|_| ends) {
                    if let Some(again) = datum.again() {
                        let value = again.at as usize..again.end as usize;
                        return Err(Fault::unexpected(
                            value,
                            "a key that no value before it has",
                        ));
                    }
                    if datum.kind == Kind::Point {
                        found.last_point = Some((datum.at as usize, end));
                    }
                    found.data.push(datum);
                }
            }
        }
    }
    Ok(found)
}

/// A tag inside a declaration.
fn inside<'a>(datum: &mut Datum<'a>, tag: &Tag<'a>, father: &mut Father<'a>) -> Result<(), Fault> {
    match tag.name {
        b"pFather" | b"fFather" | b"tFather" => {
            if !datum.elements.is_empty() || *father != Father::default() {
                let expected = "one father, in front of all values";
                return Err(Fault::unexpected(tag.at..tag.end, expected));
            }
            *father = Father {
                alias: tag.value(b"alias")?,
                name: tag.value(b"name")?,
                index: tag.value(b"fatherIndex")?,
            };
        }
        b"Value" => {
            let mut element = Element::new(tag.at);
            element.add(datum.kind, tag)?;
            datum.elements.push(element);
        }
        name if name.starts_with(b"value") => {
            let mut element = Element::new(tag.at);
            element.key = tag
                .attribute(b"index")?
                .map_or(element.key, |key| key.value);
            element.father = *father;
            if datum.kind == Kind::Num {
                element.add(datum.kind, tag)?;
            }
            datum.elements.push(element);
        }
        name if name.ends_with(b"Value") => {
            if let Some(element) = datum.elements.last_mut() {
                element.add(datum.kind, tag)?;
            }
        }
        _ => {}
    }
    Ok(())
}

/// Where a comment can stand: behind the tag that the data are in.
pub(super) fn start_of_data(bytes: &[u8]) -> Option<usize> {
    let mut nodes = Nodes::of(bytes);
    while let Ok(Some(Node::Open(tag))) = nodes.next() {
        if matches!(tag.name, b"Datas" | b"dataList") && !tag.is_empty {
            return Some(tag.end);
        }
    }
    None
}
