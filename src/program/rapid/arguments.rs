//! Arguments of instructions: names, targets written out, Offs and `RelTool` around them.

use super::aggregate::{self, JOINTTARGET, Leaf, ROBTARGET};
use super::reader::{Reader, index};
use super::syntax::{Amount, BadValue, Base, Expression, Index, Path, Step, Verb};
use super::tokens::{Fault, Kind};
use crate::geometry::Quaternion;
use crate::program::{Layout, Number, Shape, Target, TargetId, number};

/// Calls inside calls that are followed; deeper ones are expressions like any other.
const DEEPEST: usize = 16;

/// Coordinates (mm) and angles (degrees) of targets are smaller: 9E9 means "not connected".
pub const LARGEST: f64 = 1e6;
/// Deviation of a quaternion's length from 1 that rounding explains.
pub const UNIT_TOLERANCE: f64 = 0.01;

/// Numbers of a pose that targets keep: the external axes stay as they are.
const POSE_NUMBERS: usize = 11;
const JOINT_NUMBERS: usize = 6;

impl Reader<'_> {
    /// Reads one argument; for the positional ones of an instruction its verb and position are known.
    pub(super) fn argument(&mut self, of: Option<(Verb, usize)>) -> Result<Expression, Fault> {
        let (mark, mentions) = (self.mark(), self.notes.mentions.len());
        let (steps, targets) = (self.notes.steps.len(), self.notes.targets.len());
        let (numbers, bad) = (self.notes.numbers.len(), self.notes.bad_values.len());
        if let Some(base) = self.point(of, 0)?
            && self.argument_ends()
        {
            let steps = (index(steps), index(self.notes.steps.len()));
            return Ok(Expression::Point { base, steps });
        }
        self.rewind(mark);
        self.notes.mentions.truncate(mentions);
        self.notes.steps.truncate(steps);
        self.notes.targets.truncate(targets);
        self.notes.numbers.truncate(numbers);
        self.notes.bad_values.truncate(bad);
        self.expression().map(Expression::Computed)
    }

    fn argument_ends(&self) -> bool {
        matches!(
            self.token.kind,
            Kind::End | Kind::Name | Kind::Sign(b',' | b';' | b'\\' | b')' | b']' | b'}')
        )
    }

    /// A name, a target, or Offs and `RelTool` of one. `None` where it is something else; then the place is lost.
    fn point(&mut self, of: Option<(Verb, usize)>, depth: usize) -> Result<Option<Base>, Fault> {
        let first = self.token;
        if first.is(b'[') {
            return match of {
                Some((verb, position)) => {
                    let target = self.written_target(verb, position)?;
                    Ok(target.map(|target| Base::Target(index(target))))
                }
                None => Ok(None),
            };
        }
        if first.kind != Kind::Name {
            return Ok(None);
        }
        self.advance()?;
        if self.token.is(b'(') {
            let relative = self.text(first).eq_ignore_ascii_case(b"reltool");
            if depth < DEEPEST && (relative || self.text(first).eq_ignore_ascii_case(b"offs")) {
                return self.displaced(of, relative, depth);
            }
            return Ok(None);
        }
        let name = self.notes.symbols.intern(self.text(first));
        let index = match self.index()? {
            Index::Whole => 0,
            other => {
                self.notes.indices.push(other);
                index(self.notes.indices.len())
            }
        };
        Ok(Some(Base::Named { name, index }))
    }

    /// `Offs(point, x, y, z)` or `RelTool(point, x, y, z \Rx:=a \Ry:=b \Rz:=c)`; the present token is the bracket.
    fn displaced(
        &mut self,
        of: Option<(Verb, usize)>,
        relative: bool,
        depth: usize,
    ) -> Result<Option<Base>, Fault> {
        self.advance()?;
        let Some(base) = self.point(of, depth + 1)? else {
            return Ok(None);
        };
        let mut amounts = [Amount::Number(0.0); 6];
        for amount in &mut amounts[..3] {
            if !self.token.is(b',') {
                return Ok(None);
            }
            self.advance()?;
            *amount = self.amount()?;
        }
        while relative && self.token.is(b'\\') {
            self.advance()?;
            let axis = match self.text(self.token).to_ascii_lowercase().as_slice() {
                b"rx" => 3,
                b"ry" => 4,
                b"rz" => 5,
                _ => return Ok(None),
            };
            self.advance()?;
            if self.token.kind != Kind::Assign {
                return Ok(None);
            }
            self.advance()?;
            amounts[axis] = self.amount()?;
        }
        if !self.token.is(b')') {
            return Ok(None);
        }
        self.advance()?;
        let [x, y, z, ..] = amounts;
        self.notes.steps.push(if relative {
            Step::RelTool(amounts)
        } else {
            Step::Offs([x, y, z])
        });
        Ok(Some(base))
    }

    /// A number or a name, with signs before it.
    fn amount(&mut self) -> Result<Amount, Fault> {
        let (mark, mut sign) = (self.mark(), 1.0);
        while let Kind::Sign(byte @ (b'-' | b'+')) = self.token.kind {
            sign = if byte == b'-' { -sign } else { sign };
            self.advance()?;
        }
        let token = self.token;
        let amount = match token.kind {
            Kind::Number => number::parse(self.text(token))
                .map_or(Amount::Computed, |value| Amount::Number(sign * value)),
            Kind::Name => Amount::Named(self.notes.symbols.intern(self.text(token)), sign),
            _ => Amount::Computed,
        };
        if amount != Amount::Computed {
            self.advance()?;
            if matches!(self.token.kind, Kind::Sign(b',' | b')' | b'\\')) {
                return Ok(amount);
            }
        }
        self.rewind(mark);
        self.expression()?;
        Ok(Amount::Computed)
    }

    /// `{2}` or `{1,3}` where it stands; its names are not noted.
    pub(super) fn index(&mut self) -> Result<Index, Fault> {
        if !self.token.is(b'{') {
            return Ok(Index::Whole);
        }
        let (mark, mentions) = (self.mark(), self.notes.mentions.len());
        self.advance()?;
        let mut constants = [0; 3];
        for constant in &mut constants {
            let digits = self.text(self.token);
            let parsed = std::str::from_utf8(digits)
                .ok()
                .and_then(|t| t.parse().ok());
            match parsed.filter(|&value: &u32| value > 0) {
                Some(value) => *constant = value,
                None => break,
            }
            self.advance()?;
            if self.token.is(b'}') {
                self.advance()?;
                return Ok(Index::At(constants));
            }
            if !self.token.is(b',') {
                break;
            }
            self.advance()?;
        }
        self.rewind(mark);
        self.braces()?;
        self.notes.mentions.truncate(mentions);
        Ok(Index::Variable)
    }

    /// Passes over `{…}`.
    fn braces(&mut self) -> Result<(), Fault> {
        let at = self.token.start;
        self.advance()?;
        loop {
            self.expression()?;
            match self.token.kind {
                Kind::Sign(b'}') => return self.advance(),
                Kind::Sign(b';') | Kind::End => {
                    return Err(Fault::Unclosed {
                        at,
                        what: "bracket",
                    });
                }
                Kind::Sign(b']' | b')') => return Err(self.unexpected("}")),
                _ => self.advance()?,
            }
        }
    }

    /// A target as an argument; `None` where it is data of another type.
    fn written_target(&mut self, verb: Verb, position: usize) -> Result<Option<TargetId>, Fault> {
        let offset = self.token.start;
        let (template, shape, wanted) = match verb {
            Verb::Move { path, first, .. } => {
                let last = usize::from(first) + usize::from(path == Path::Arc);
                let wanted = (usize::from(first)..=last).contains(&position);
                if path == Path::Absolute {
                    (JOINTTARGET, Shape::Joints, wanted)
                } else {
                    (ROBTARGET, Shape::Pose, wanted)
                }
            }
            _ => (ROBTARGET, Shape::Pose, false),
        };
        if matches!(verb, Verb::Harmless) {
            return Ok(None);
        }
        let (mark, mentions) = (self.mark(), self.notes.mentions.len());
        self.advance()?;
        let nested = self.token.is(b'[');
        self.rewind(mark);
        if !wanted && !nested {
            return Ok(None);
        }
        let leaves = match self.aggregate(template) {
            Ok(leaves) => leaves,
            // a value of another type, unless it stands where only a target can
            Err(Fault::Unexpected { .. }) if !wanted => {
                self.rewind(mark);
                self.notes.mentions.truncate(mentions);
                return Ok(None);
            }
            Err(fault) => return Err(fault),
        };
        self.notes.mentions.truncate(mentions);
        Ok(Some(self.push_target(
            shape,
            None,
            offset,
            leaves.as_slice(),
        )))
    }

    /// Notes a target with its numbers. One with expressions in it has no numbers and is blocked.
    pub(super) fn push_target(
        &mut self,
        shape: Shape,
        name: Option<Box<str>>,
        offset: u32,
        leaves: &[Leaf],
    ) -> TargetId {
        let target = self.notes.targets.len();
        let kept = match shape {
            Shape::Pose => POSE_NUMBERS,
            Shape::Joints => JOINT_NUMBERS,
        };
        let start = self.notes.numbers.len();
        for leaf in &leaves[..kept] {
            match *leaf {
                Leaf::Number {
                    value,
                    start,
                    length,
                } => self.notes.numbers.push(Number {
                    start,
                    length,
                    value,
                }),
                _ => self.notes.numbers.truncate(start),
            }
        }
        let blocked = self.notes.numbers.len() < start + kept;
        if blocked {
            self.notes.numbers.truncate(start);
        } else if let Some(fault) = bad_value(shape, &self.notes.numbers[start..]) {
            self.notes.bad_values.push(BadValue { target, fault });
        }
        self.notes.targets.push(Target {
            name,
            file: self.file,
            offset,
            layout: Layout { shape, variant: 0 },
            numbers: index(start)..index(self.notes.numbers.len()),
            blocked,
        });
        target
    }
}

/// The first number of a target that no robot can use.
fn bad_value(shape: Shape, numbers: &[Number]) -> Option<Fault> {
    let (lengths, meaning, limit) = match shape {
        Shape::Pose => (
            &numbers[..3],
            "coordinate",
            "the limit is 1000000 mm either way",
        ),
        Shape::Joints => (
            &numbers[..JOINT_NUMBERS],
            "joint angle",
            "the limit is 1000000 degrees either way",
        ),
    };
    let too_large = lengths.iter().find(|number| number.value.abs() >= LARGEST);
    if let Some(number) = too_large {
        return Some(fault_at(
            number.start,
            u32::from(number.length),
            meaning,
            limit,
        ));
    }
    if shape == Shape::Joints {
        return None;
    }
    let [w, x, y, z] = [3, 4, 5, 6].map(|i| numbers[i].value);
    (!is_unit([w, x, y, z])).then(|| {
        let (first, last) = (numbers[3], numbers[6]);
        let length = last.start + u32::from(last.length) - first.start;
        fault_at(
            first.start,
            length,
            "unit quaternion",
            aggregate::UNIT_LIMIT,
        )
    })
}

/// Whether a quaternion's length is 1 but for rounding.
pub fn is_unit(parts: [f64; 4]) -> bool {
    (Quaternion(parts).norm() - 1.0).abs() <= UNIT_TOLERANCE
}

fn fault_at(start: u32, length: u32, meaning: &'static str, limit: &'static str) -> Fault {
    Fault::BadValue {
        start,
        end: start + length,
        meaning,
        limit,
    }
}
