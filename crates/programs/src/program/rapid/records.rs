//! Tools, work objects and loads of their parts (see [`super::aggregate::TOOLDATA`],
//! [`super::aggregate::WOBJDATA`]).

use super::aggregate::{Leaf, UNIT_LIMIT};
use super::arguments::{LARGEST, is_unit};
use super::tokens::Fault;
use crate::geometry::units::m_from_mm;
use crate::geometry::{Pose, Quaternion};
use crate::program::script::{NamedFrame, Part, PartValue, Place, Remark};
use crate::program::{Load, ReadError, Source};

/// Parts of the load of a tool begin here.
pub(super) const TOOL_LOAD: usize = 8;

/// Leaves as parts of a record.
pub(super) fn part_of(leaf: Leaf, place: Place) -> Part {
    let at = |start| Place::new(place.file, start);
    let (value, place, length) = match leaf {
        Leaf::Number {
            value,
            start,
            length,
        } => (PartValue::Number(value), at(start), length),
        Leaf::Bool(flag) => (PartValue::Flag(flag), place, 0),
        Leaf::Text { start, length } => {
            let empty = length == 2;
            (PartValue::Text { empty }, at(start), length)
        }
        Leaf::Computed => (PartValue::Computed, place, 0),
        Leaf::Missing => (PartValue::Missing, place, 0),
    };
    Part {
        value,
        place,
        length,
    }
}

/// The parts of a record, one after another; behind the last they are missing.
struct Parts<'a> {
    parts: &'a [Part],
    sources: &'a [Source],
}

impl Parts<'_> {
    fn value(&self, at: usize) -> PartValue {
        self.parts
            .get(at)
            .map_or(PartValue::Missing, |part| part.value)
    }

    fn number(&self, at: usize) -> Option<f64> {
        match self.value(at) {
            PartValue::Number(number) => Some(number),
            _ => None,
        }
    }

    fn are_missing(&self, mut all: std::ops::Range<usize>) -> bool {
        all.all(|at| self.value(at) == PartValue::Missing)
    }

    fn is(&self, at: usize, truth: bool) -> bool {
        self.value(at) == PartValue::Flag(truth)
    }

    /// What is wrong with a number.
    fn bad_value(&self, at: usize, meaning: &'static str, limit: &'static str) -> ReadError {
        let Part { place, length, .. } = self.parts[at];
        let fault = Fault::BadValue {
            start: place.offset,
            end: place.offset + u32::from(length),
            meaning,
            limit,
        };
        fault.in_source(&self.sources[place.file as usize])
    }

    /// The pose whose seven parts start at `first`; `None` where they are missing. Of data that the
    /// files do not declare, the program may write some: what the others are then nobody knows.
    fn pose(&self, first: usize) -> Result<Result<Option<Pose>, Remark>, ReadError> {
        if self.are_missing(first..first + 7) {
            return Ok(Ok(None));
        }
        let mut values = [0.0; 7];
        for (value, at) in values.iter_mut().zip(first..) {
            let Some(number) = self.number(at) else {
                return Ok(Err(ASSIGNED));
            };
            *value = number;
        }
        let [x, y, z, quaternion @ ..] = values;
        let far = [x, y, z].iter().position(|v| v.abs() >= LARGEST);
        let wrong = match far {
            Some(at) => Some((at, "coordinate", "the limit is 1000000 mm either way")),
            None if !is_unit(quaternion) => Some((3, "unit quaternion", UNIT_LIMIT)),
            None => None,
        };
        if let Some((at, meaning, limit)) = wrong {
            return Err(self.bad_value(first + at, meaning, limit));
        }
        let translation = [x, y, z].map(m_from_mm);
        let rotation = Quaternion(quaternion).normalized();
        Ok(Ok(Some(Pose::from_parts(translation, rotation))))
    }

    /// The mechanical unit that carries a work object: its user frame is not fixed (`ufprog` FALSE)
    /// and `ufmec` names the unit.
    fn unit(&self) -> Result<Option<Box<str>>, Remark> {
        let fixed = match self.value(1) {
            PartValue::Flag(fixed) => fixed,
            PartValue::Missing => true,
            _ => return Err(ASSIGNED),
        };
        let PartValue::Text { empty } = self.value(2) else {
            let unknown = !fixed || self.value(2) == PartValue::Computed;
            return if unknown { Err(ASSIGNED) } else { Ok(None) };
        };
        if fixed {
            // a name next to a fixed frame means nothing
            return Ok(None);
        }
        if empty {
            return Err(Remark::error(
                "moving-frame",
                "the user frame is not fixed (ufprog FALSE), and ufmec names no unit that carries \
                 it",
                "name the unit, or set ufprog TRUE",
            ));
        }
        let Part { place, length, .. } = self.parts[2];
        let start = place.offset as usize + 1;
        let bytes = &self.sources[place.file as usize].bytes;
        let name = Source::text(&bytes[start..start + usize::from(length).saturating_sub(2)]);
        let capital = name.to_ascii_uppercase();
        if capital.starts_with("CNV") {
            return Err(Remark::error_about(
                "moving-frame",
                format!("the conveyor `{name}` moves the work object"),
                "moves on a conveyor are not compensated",
            ));
        }
        if capital.starts_with("ROB_") {
            return Err(Remark::error_about(
                "two-robots",
                format!("the robot `{name}` carries the work object"),
                "moves relative to another robot are not compensated",
            ));
        }
        Ok(Some(name.into()))
    }

    /// The load whose parts start at `first`, where it has a mass.
    fn load(&self, first: usize) -> Option<Load> {
        let number = |at: usize| self.number(first + at);
        let mass_kg = number(0).filter(|&mass| mass > 0.0)?;
        let cog_m = [number(1)?, number(2)?, number(3)?].map(m_from_mm);
        Some(Load { mass_kg, cog_m })
    }
}

/// The running program changes a part of a tool or work object.
pub(super) const ASSIGNED: Remark = Remark::error(
    "frame-assigned-at-run-time",
    "the running program changes the tool or work object",
    "assign it once, with numbers, or declare one for each place",
);

/// See [`crate::program::Language::frame_of`].
pub(super) fn frame_of(
    is_tool: bool,
    name: &str,
    parts: &[Part],
    sources: &[Source],
) -> Result<Result<NamedFrame, Remark>, ReadError> {
    let parts = Parts { parts, sources };
    let unit = if is_tool { Ok(None) } else { parts.unit() };
    let unit = match unit {
        Ok(unit) => unit,
        Err(remark) => return Ok(Err(remark)),
    };
    let pose = if is_tool {
        tool(name, &parts)?
    } else {
        work_object(name, &parts, unit.is_some())?
    };
    Ok(pose.map(|pose| NamedFrame {
        on: unit.into_iter().collect(),
        load: is_tool.then(|| parts.load(TOOL_LOAD)).flatten(),
        ..NamedFrame::still(name, pose)
    }))
}

type Found = Result<Result<Option<Pose>, Remark>, ReadError>;

fn tool(name: &str, parts: &Parts) -> Found {
    if parts.is(0, false) {
        return Ok(Err(Remark::error(
            "stationary-tool",
            "the tool does not hang on the robot (robhold FALSE)",
            "moves with a stationary tool are not compensated",
        )));
    }
    let load = TOOL_LOAD..TOOL_LOAD + 4;
    // of a tool that the files do not declare, a part of the load alone is no load
    let is_declared = !parts.are_missing(1..TOOL_LOAD);
    if load
        .clone()
        .any(|at| parts.value(at) == PartValue::Computed)
        || !is_declared && !parts.are_missing(load)
    {
        return Ok(Err(ASSIGNED));
    }
    if parts.number(TOOL_LOAD).is_some_and(|mass_kg| mass_kg < 0.0) {
        return Err(parts.bad_value(TOOL_LOAD, "mass", "a tool weighs 0 kg or more"));
    }
    let or_tool0 = |pose: Option<Pose>| {
        pose.or_else(|| name.eq_ignore_ascii_case("tool0").then(Pose::identity))
    };
    Ok(parts.pose(1)?.map(or_tool0))
}

fn work_object(name: &str, parts: &Parts, carried: bool) -> Found {
    if parts.is(0, true) {
        return Ok(Err(Remark::error(
            "held-work-piece",
            "the robot holds the work object (robhold TRUE)",
            "moves with a held work piece are not compensated",
        )));
    }
    let user = match parts.pose(3)? {
        Ok(user) => user,
        Err(remark) => return Ok(Err(remark)),
    };
    let object = match parts.pose(10)? {
        Ok(object) => object,
        Err(remark) => return Ok(Err(remark)),
    };
    if carried {
        // the user frame is that of the unit: what the file has in its place is not used
        return Ok(Ok(object));
    }
    Ok(match (user, object) {
        (Some(user), Some(object)) => Ok(Some(user * object)),
        (None, None) => Ok(name.eq_ignore_ascii_case("wobj0").then(Pose::identity)),
        _ => Err(ASSIGNED),
    })
}

/// The load of leaves of a loaddata.
pub(super) fn load_of(leaves: &[Leaf]) -> Option<Load> {
    let place = Place::NOWHERE;
    let parts: Vec<Part> = leaves.iter().map(|&leaf| part_of(leaf, place)).collect();
    let parts = Parts {
        parts: &parts,
        sources: &[],
    };
    parts.load(0)
}
