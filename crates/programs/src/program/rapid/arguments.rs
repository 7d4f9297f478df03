//! Arguments of instructions: names, targets written out, Offs and `RelTool` around them.

use super::aggregate::{self, JOINTTARGET, LOADDATA, Leaf, Leaves, ROBTARGET};
use super::reader::Reader;
use super::syntax::{Amount, BadValue, Base, Composed, Expression, Index, Part, Path, Step, Verb};
use super::tokens::{Fault, Kind};
use super::verbs::Displaces;
use crate::geometry::Quaternion;
use crate::program::script::{Place, short};
use crate::program::{Layout, Number, Shape, Target, number};

/// Calls inside calls that are followed; deeper ones are expressions like any other.
const DEEPEST: usize = 16;

/// Coordinates (mm) and angles (degrees) of targets are smaller: 9E9 means "not connected".
pub(super) const LARGEST: f64 = 1e6;
/// External axes from here on are not connected: 9E9, or what is left of it in 32 bits.
pub(super) const NOT_CONNECTED: f64 = 8e9;
/// Deviation of a quaternion's length from 1 that rounding explains.
pub(super) const UNIT_TOLERANCE: f64 = 0.01;

/// Numbers of a pose that targets keep: the external axes stay as they are.
const POSE_NUMBERS: usize = 11;
const JOINT_NUMBERS: usize = 6;

impl Reader<'_> {
    /// Reads one argument; for the positional ones of an instruction its verb and position are
    /// known.
    pub(super) fn argument(&mut self, of: Option<(Verb, usize)>) -> Result<Expression, Fault> {
        let first = self.token;
        if first.kind == Kind::Text {
            self.advance()?;
            if self.argument_ends() {
                return Ok(Expression::Text(first.start + 1, first.end - 1));
            }
            // an expression of strings
            return self.expression().map(Expression::Computed);
        }
        let mark = self.mark();
        let steps = short(self.parsed.steps.len());
        // `go(p10);`
        if first.is(b'(') {
            self.advance()?;
            let point = self.point(None, 0)?;
            if self.token.is(b')')
                && let Some(Written::Base(base)) = point
            {
                self.advance()?;
                if self.argument_ends() {
                    let steps = (steps, short(self.parsed.steps.len()));
                    return Ok(Expression::Point { base, steps });
                }
            }
            self.rewind(mark);
            return self.expression().map(Expression::Computed);
        }
        match self.point(of, 0)? {
            Some(Written::Base(base)) => {
                let steps = (steps, short(self.parsed.steps.len()));
                let is_name = matches!(base, Base::Named { .. }) && steps.0 == steps.1;
                if is_name && self.token.is(b'.') {
                    self.members()?;
                    if let Base::Named { name, index } = base
                        && self.argument_ends()
                    {
                        return Ok(Expression::Member { name, index });
                    }
                } else if self.argument_ends() {
                    return Ok(Expression::Point { base, steps });
                }
            }
            Some(Written::Composed(composed)) if self.argument_ends() => {
                return Ok(Expression::Composed(composed));
            }
            _ => {}
        }
        self.rewind(mark);
        self.expression().map(Expression::Computed)
    }

    /// A load that is written out, the present token is its bracket.
    pub(super) fn load(&mut self) -> Result<Expression, Fault> {
        let mark = self.mark();
        match self.leaves(LOADDATA) {
            Ok(leaves) if self.argument_ends() => return Ok(Expression::Load(leaves)),
            Ok(_) | Err(Fault::Unexpected { .. }) => {}
            Err(fault) => return Err(fault),
        }
        self.rewind(mark);
        self.argument(None)
    }

    /// `.trans.x`, the present token is the point.
    fn members(&mut self) -> Result<(), Fault> {
        while self.token.is(b'.') {
            self.advance()?;
            if self.token.kind == Kind::Name {
                self.advance()?;
            }
            self.index()?;
        }
        Ok(())
    }

    fn argument_ends(&self) -> bool {
        match self.token.kind {
            // a semicolon is forgotten
            Kind::Name => !self.is_operator(),
            Kind::End | Kind::Sign(b',' | b';' | b'\\' | b')' | b']' | b'}') => true,
            _ => false,
        }
    }

    /// A name, a target, or Offs and `RelTool` of one. `None` where it is something else; then the
    /// place is lost.
    fn point(&mut self, of: Option<(Verb, usize)>, depth: usize) -> Result<Option<Written>, Fault> {
        let first = self.token;
        if first.is(b'[') {
            return match of {
                Some((verb, position)) => self.written_target(verb, position),
                None => Ok(None),
            };
        }
        if first.kind != Kind::Name {
            return Ok(None);
        }
        let mark = self.mark();
        self.advance()?;
        if self.token.is(b'(') {
            if depth < DEEPEST
                && let Some(how) = self.displaces(self.text(first))
            {
                return self.displaced(of, how == Displaces::InTool, depth);
            }
            self.rewind(mark);
            self.expression()?;
            let function = self.alone.map(Base::Function);
            return Ok(function.map(Written::Base));
        }
        let name = self.parsed.symbols.intern(self.text(first));
        let index = self.index()?;
        let index = self.parsed.keep_index(name, index);
        Ok(Some(Written::Base(Base::Named { name, index })))
    }

    /// How the function of this name displaces a position, where no routine of the files hides it.
    pub(super) fn displaces(&mut self, name: &[u8]) -> Option<Displaces> {
        let how = Displaces::named(name)?;
        let name = self.parsed.symbols.intern(name);
        let is_built_in = self.verbs.displaces(name, self.context.module);
        is_built_in.then_some(how)
    }

    /// `Offs(point, x, y, z)` or `RelTool(point, x, y, z \Rx:=a \Ry:=b \Rz:=c)`; the present token
    /// is the bracket.
    fn displaced(
        &mut self,
        of: Option<(Verb, usize)>,
        relative: bool,
        depth: usize,
    ) -> Result<Option<Written>, Fault> {
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
        while relative && matches!(self.token.kind, Kind::Sign(b',' | b'\\')) {
            // a comma may stand before each
            if self.token.is(b',') {
                self.advance()?;
            }
            if !self.token.is(b'\\') {
                return Ok(None);
            }
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
        self.parsed.steps.push(if relative {
            Step::RelTool(amounts)
        } else {
            Step::Offs([x, y, z])
        });
        Ok(Some(base))
    }

    /// A number, or an expression.
    fn amount(&mut self) -> Result<Amount, Fault> {
        let start = self.token.start;
        self.expression()?;
        let end = self.token.start;
        let text = self.bytes[start as usize..end as usize].trim_ascii();
        Ok(number::parse(text).map_or(Amount::Text(start, end), Amount::Number))
    }

    /// `{2}` or `{1,3}` where it stands. Its names are of no expression; they stay in the list, as
    /// what functions in it are given may refer to them.
    pub(super) fn index(&mut self) -> Result<Index, Fault> {
        if !self.token.is(b'{') {
            return Ok(Index::Whole);
        }
        let mark = self.mark();
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
                    return Err(Fault::unclosed(at as usize, "bracket"));
                }
                Kind::Sign(b']' | b')') => return Err(self.unexpected("}")),
                _ => self.advance()?,
            }
        }
    }

    /// A target as an argument; `None` where it is data of another type.
    fn written_target(&mut self, verb: Verb, position: usize) -> Result<Option<Written>, Fault> {
        let offset = self.token.start;
        let (template, shape, wanted) = match verb {
            Verb::Move { path, led, .. } => {
                let first = usize::from(led.first());
                let last = first + usize::from(path == Path::Arc);
                let wanted = (first..=last).contains(&position);
                if path == Path::Absolute {
                    (JOINTTARGET, Shape::Joints, wanted)
                } else {
                    (ROBTARGET, Shape::Pose, wanted)
                }
            }
            Verb::Other => (ROBTARGET, Shape::Pose, false),
            _ => return Ok(None),
        };
        let mark = self.mark();
        self.advance()?;
        let nested = self.token.is(b'[');
        self.rewind(mark);
        if !wanted && !nested {
            return Ok(None);
        }
        let mark = self.mark();
        let mentions = short(self.parsed.mentions.len());
        let leaves = match self.aggregate(template) {
            Ok(leaves) => leaves,
            // a value of another type, unless it stands where only a target can
            Err(Fault::Unexpected { .. }) if !wanted => {
                self.rewind(mark);
                return self.written_joints(offset, mentions);
            }
            Err(fault) => return Err(fault),
        };
        Ok(Some(self.target(shape, None, offset, &leaves, mentions)))
    }

    /// Joints in the argument of a routine, `ArcMoveAbsJ [[0,10,10,0,30,0],[…]],…`; `None` where it is
    /// data of another type.
    fn written_joints(&mut self, offset: u32, mentions: u32) -> Result<Option<Written>, Fault> {
        let mark = self.mark();
        match self.aggregate(JOINTTARGET) {
            Ok(leaves) => Ok(Some(self.target(
                Shape::Joints,
                None,
                offset,
                &leaves,
                mentions,
            ))),
            Err(Fault::Unexpected { .. }) => {
                self.rewind(mark);
                Ok(None)
            }
            Err(fault) => Err(fault),
        }
    }

    /// Parsed a target with its numbers. One with expressions in it has none; the names in them
    /// begin at `mentions`.
    pub(super) fn target(
        &mut self,
        shape: Shape,
        name: Option<Box<str>>,
        offset: u32,
        all: &Leaves,
        mentions: u32,
    ) -> Written {
        let target = self.parsed.targets.len();
        let (kept, places) = match shape {
            Shape::Pose => (POSE_NUMBERS, 3),
            Shape::Joints => (JOINT_NUMBERS, JOINT_NUMBERS),
        };
        let leaves = all.as_slice();
        let start = self.parsed.numbers.len();
        for leaf in &leaves[..kept] {
            let Leaf::Number {
                value,
                start: at,
                length,
            } = *leaf
            else {
                self.parsed.numbers.truncate(start);
                let at = Place::new(self.file, offset);
                return Written::Composed(self.compose(mentions, all.names(places), at));
            };
            self.parsed.numbers.push(Number {
                start: at,
                length,
                value,
            });
        }
        if let Some(fault) = bad_value(shape, &self.parsed.numbers[start..]) {
            self.parsed.bad_values.push(BadValue { target, fault });
        }
        let mut zeros = 0;
        for (axis, leaf) in (0..6).zip(&leaves[leaves.len() - 6..]) {
            match leaf.number() {
                Some(0.0) => zeros |= 1 << axis,
                Some(value) if value.abs() < NOT_CONNECTED => {
                    self.parsed.external.push((target, axis, value));
                }
                _ => {}
            }
        }
        self.parsed.external_zeros.push(zeros);
        let place = Place::new(self.file, offset);
        self.parsed.targets.push(Target {
            name,
            numbers: short(start)..short(self.parsed.numbers.len()),
            ..Target::new(place, self.behind, Layout::of(shape))
        });
        Written::Base(Base::Target(short(target)))
    }

    /// Notes a value with expressions in it, whose names begin at `mentions`.
    fn compose(&mut self, mentions: u32, places: &[Part], at: Place) -> u32 {
        self.parsed.composed.push(Composed {
            names: (mentions, short(self.parsed.mentions.len())),
            places: places.into(),
            at,
        });
        short(self.parsed.composed.len() - 1)
    }

    /// `[x, y + 1, 150]`, the present token is the bracket; `None` where something else follows it,
    /// then nothing is passed over.
    pub(super) fn list(&mut self) -> Result<Option<Expression>, Fault> {
        let mark = self.mark();
        let mentions = short(self.parsed.mentions.len());
        let place = Place::new(self.file, self.token.start);
        let mut places = Vec::new();
        loop {
            self.advance()?;
            places.push(self.expression()?);
            if !self.token.is(b',') {
                break;
            }
        }
        if self.token.is(b']') {
            self.advance()?;
            if self.argument_ends() {
                return Ok(Some(Expression::List(
                    self.compose(mentions, &places, place),
                )));
            }
        }
        self.rewind(mark);
        Ok(None)
    }
}

/// What stands where a target belongs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Written {
    Base(Base),
    /// Parts of it are expressions: index in [`super::syntax::Parsed::composed`].
    Composed(u32),
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
pub(super) fn is_unit(parts: [f64; 4]) -> bool {
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
