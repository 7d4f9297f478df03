//! Declarations, parameters of routines, and what assignments set.

use super::aggregate::{
    BOOL, JOINTTARGET, LOADDATA, Leaf, NUM, ORIENT, POS, POSE, ROBTARGET, STRING, TOOLDATA,
    WOBJDATA,
};
use super::arguments::Written;
use super::reader::{KEYWORD, Reader, keyword};
use super::syntax::{
    Assigned, Base, Component, Datum, Element, Expression, Part, Storage, Stored, Type,
};
use super::tokens::{Fault, Kind, Token};
use crate::program::Shape;
use crate::program::names::Symbol;
use crate::program::script::{Place, short};

/// Most dimensions of an array in RAPID.
const DIMENSIONS: usize = 3;

impl Reader<'_> {
    /// `CONST type name{sizes} := value;`, the present token is CONST, PERS or VAR. Whether it is
    /// data that robots use.
    pub(super) fn declaration(
        &mut self,
        start: u32,
        local: bool,
        storage: Storage,
    ) -> Result<bool, Fault> {
        self.advance()?;
        if self.token.kind != Kind::Name {
            return Err(self.unexpected("a type"));
        }
        let kind = self.type_name();
        self.advance()?;
        let name = self.name("the name of the data")?;
        let dimensions = self.dimensions()?;
        let mut value = Stored::Nothing;
        if self.token.kind == Kind::Assign {
            self.advance()?;
            let start = self.token.start;
            value = match kind {
                Type::Robtarget | Type::Jointtarget => self.targets(kind, name, dimensions)?,
                Type::Tooldata if self.token.is(b'[') => self.frames(TOOLDATA, dimensions)?,
                Type::Wobjdata if self.token.is(b'[') => self.frames(WOBJDATA, dimensions)?,
                Type::Loaddata if dimensions == 0 && self.token.is(b'[') => {
                    Stored::Leaves(self.leaves(LOADDATA)?)
                }
                Type::Num if storage == Storage::Constant && dimensions == 0 => self.constant()?,
                _ => {
                    let names = self.expression()?;
                    if storage == Storage::Constant && names.0 < names.1 {
                        let datum = short(self.parsed.data.len());
                        self.parsed.initial.push((datum, names));
                    }
                    Stored::Computed
                }
            };
            if kind == Type::Num {
                let bytes = (start, self.token.start);
                self.parsed
                    .values
                    .insert(short(self.parsed.data.len()), bytes);
            }
        } else if dimensions > 0 && kind != Type::Other {
            value = Stored::Computed;
        }
        self.end_statement()?;
        let place = Place::new(self.file, start);
        self.parsed.data.push(Datum {
            name,
            kind,
            context: self.context,
            place,
            local,
            storage,
            value,
        });
        Ok(kind != Type::Other)
    }

    /// The type that the present token names.
    pub(super) fn type_name(&self) -> Type {
        self.type_of(self.text(self.token))
    }

    fn type_of(&self, name: &[u8]) -> Type {
        let mut buffer = [0; KEYWORD];
        match Type::named(keyword(name, &mut buffer)) {
            Type::Other => {
                let alias = self.parsed.symbols.find(name);
                alias.map_or(Type::Other, |name| self.verbs.aliased(name))
            }
            known => known,
        }
    }

    /// `{3}` or `{2,n}`: how many sizes stand there.
    fn dimensions(&mut self) -> Result<usize, Fault> {
        if !self.token.is(b'{') {
            return Ok(0);
        }
        let at = self.token.start;
        let mut dimensions = 1;
        self.advance()?;
        loop {
            self.expression()?;
            match self.token.kind {
                Kind::Sign(b'}') => {
                    self.advance()?;
                    return Ok(dimensions);
                }
                Kind::Sign(b',') => {
                    dimensions += 1;
                    self.advance()?;
                }
                Kind::End => {
                    return Err(Fault::unclosed(at as usize, "bracket"));
                }
                _ => return Err(self.unexpected("}")),
            }
        }
    }

    fn constant(&mut self) -> Result<Stored, Fault> {
        let mark = self.mark();
        if let [Leaf::Number { value, .. }] = self.aggregate(NUM)?.as_slice()
            && self.token.is(b';')
        {
            return Ok(Stored::Number(*value));
        }
        self.rewind(mark);
        self.expression().map(|_| Stored::Computed)
    }

    /// The value of a target or of an array of them.
    fn targets(&mut self, kind: Type, name: Symbol, dimensions: usize) -> Result<Stored, Fault> {
        if dimensions > DIMENSIONS || dimensions > 0 && !self.token.is(b'[') {
            return self.expression().map(|_| Stored::Computed);
        }
        let start = short(self.parsed.elements.len());
        let mut position = [0; DIMENSIONS];
        let mut sizes = [0; DIMENSIONS];
        let mut level = 0;
        let mut openers = [0; DIMENSIONS];
        loop {
            while level < dimensions {
                if !self.token.is(b'[') {
                    return Err(self.unexpected("["));
                }
                openers[level] = self.token.start;
                self.advance()?;
                position[level] = 1;
                level += 1;
            }
            for (size, &at) in sizes.iter_mut().zip(&position) {
                *size = at.max(*size);
            }
            self.element(kind, name, &position[..dimensions])?;
            while level > 0 && self.token.is(b']') {
                self.advance()?;
                level -= 1;
            }
            if level == 0 {
                break;
            }
            if !self.token.is(b',') {
                let ends = self.token.kind == Kind::End || self.token.is(b';');
                return Err(if ends {
                    Fault::unclosed(openers[level - 1] as usize, "bracket")
                } else {
                    self.unexpected(",")
                });
            }
            self.advance()?;
            position[level - 1] += 1;
        }
        let elements = (start, short(self.parsed.elements.len()));
        Ok(Stored::Elements { elements, sizes })
    }

    fn element(&mut self, kind: Type, name: Symbol, position: &[u32]) -> Result<(), Fault> {
        let offset = self.token.start;
        let element = if self.token.is(b'[') {
            let (template, shape) = match kind {
                Type::Jointtarget => (JOINTTARGET, Shape::Joints),
                _ => (ROBTARGET, Shape::Pose),
            };
            let mentions = short(self.parsed.mentions.len());
            let leaves = self.aggregate(template)?;
            let spelled = self.parsed.symbols.spelling(name);
            let full: Box<str> = match position {
                [] => spelled.into(),
                [i] => format!("{spelled}{{{i}}}").into(),
                [i, j] => format!("{spelled}{{{i},{j}}}").into(),
                [i, j, k, ..] => format!("{spelled}{{{i},{j},{k}}}").into(),
            };
            match self.target(shape, Some(full), offset, &leaves, mentions) {
                Written::Base(Base::Target(target)) => Element::Target(target as usize),
                Written::Base(_) => Element::Computed,
                Written::Composed(composed) => Element::Composed(composed),
            }
        } else {
            let first = self.token;
            let mentions = self.expression()?;
            match self.parsed.mentions[mentions.0 as usize..mentions.1 as usize] {
                [other] if self.text(first).len() == self.parsed.symbols.spelling(other).len() => {
                    Element::Named(other)
                }
                _ if self.token.start == first.start => return Err(self.unexpected("a target")),
                _ => Element::Computed,
            }
        };
        self.parsed.elements.push(element);
        Ok(())
    }

    /// The value of a tool or work object, or of a row of them; the present token is its bracket.
    fn frames(&mut self, template: &[u8], dimensions: usize) -> Result<Stored, Fault> {
        if dimensions == 0 {
            return self.leaves(template).map(Stored::Leaves);
        }
        let mark = self.mark();
        let (first, mut count) = (short(self.parsed.leaves.len()), 0);
        self.advance()?;
        // names, and rows of rows, are not followed
        while dimensions == 1 && self.token.is(b'[') {
            match self.leaves(template) {
                Ok(_) => count += 1,
                Err(Fault::Unexpected { .. }) => break,
                Err(fault) => return Err(fault),
            }
            if self.token.is(b']') {
                self.advance()?;
                let leaves = (first, short(self.parsed.leaves.len()));
                return Ok(Stored::Row { leaves, count });
            }
            if !self.token.is(b',') {
                break;
            }
            self.advance()?;
        }
        self.rewind(mark);
        self.expression().map(|_| Stored::Computed)
    }

    pub(super) fn leaves(&mut self, template: &[u8]) -> Result<Part, Fault> {
        let leaves = self.aggregate(template)?;
        let start = short(self.parsed.leaves.len());
        self.parsed.leaves.extend_from_slice(leaves.as_slice());
        Ok((start, short(self.parsed.leaves.len())))
    }

    /// `(robtarget p, \switch on | num x, PERS tooldata t)`
    pub(super) fn parameters(&mut self) -> Result<(), Fault> {
        let at = self.token.start;
        let (mut kind, mut last) = (Type::Other, None);
        let (mut by_reference, mut optional) = (false, false);
        loop {
            self.advance()?;
            match self.token.kind {
                Kind::Name => {
                    let mut buffer = [0; KEYWORD];
                    let before =
                        last.map_or(&b""[..], |token| keyword(self.text(token), &mut buffer));
                    by_reference |= matches!(before, b"inout" | b"pers" | b"var" | b"ref");
                    kind = last.map_or(Type::Other, |token| self.type_of(self.text(token)));
                    last = Some(self.token);
                }
                Kind::Sign(sign @ (b'\\' | b',' | b'|' | b')')) => {
                    if let Some(token) = last.take() {
                        let storage = Storage::Parameter {
                            by_reference,
                            optional,
                        };
                        self.parameter(kind, token, storage);
                        by_reference = false;
                        optional &= sign == b'|';
                    }
                    optional |= sign == b'\\';
                    if sign == b')' {
                        return self.advance();
                    }
                }
                Kind::End | Kind::Sign(b';') => {
                    return Err(Fault::unclosed(at as usize, "bracket"));
                }
                _ => {}
            }
        }
    }

    fn parameter(&mut self, kind: Type, token: Token, storage: Storage) {
        let name = self.parsed.symbols.intern(self.text(token));
        let place = Place::new(self.file, token.start);
        self.parsed.data.push(Datum {
            name,
            kind,
            context: self.context,
            place,
            local: true,
            storage,
            value: Stored::Nothing,
        });
    }

    /// `.part.part` as far as it stands; `None` where it is no part of a tool or frame.
    pub(super) fn component(&mut self) -> Result<Option<(Component, &'static [u8])>, Fault> {
        let mut found = Some((Component::Whole, &b""[..]));
        while self.token.is(b'.') {
            self.advance()?;
            let word = self.text(self.token).to_ascii_lowercase();
            let before = found.map_or(Component::Other, |(so_far, _)| so_far);
            found = part(before, &word).or_else(|| {
                let is_place = match before {
                    Component::Whole => matches!(word.as_slice(), b"trans" | b"robax"),
                    before => before == Component::Place,
                };
                let other = if is_place {
                    Component::Place
                } else {
                    Component::Other
                };
                Some((other, &b""[..]))
            });
            self.advance()?;
            self.index()?;
        }
        Ok(found)
    }

    /// What an assignment sets, and to what.
    pub(super) fn assigned(
        &mut self,
        path: Option<(Component, &'static [u8])>,
    ) -> Result<(Component, Assigned), Fault> {
        let (component, template) = path.unwrap_or((Component::Other, b""));
        let mark = self.mark();
        let templates: [&[u8]; 2] = match component {
            Component::Leaves(..) => [template, b""],
            Component::Whole if self.token.is(b'[') => match self.type_by_look()? {
                ROBTARGET => [ROBTARGET, JOINTTARGET],
                other => [other, b""],
            },
            _ => [b""; 2],
        };
        self.rewind(mark);
        for template in templates
            .into_iter()
            .filter(|template| !template.is_empty())
        {
            let offset = self.token.start;
            let mentions = short(self.parsed.mentions.len());
            let leaves = match self.aggregate(template) {
                // of one that stands elsewhere in the text these leaves are looked for there
                Ok(leaves)
                    if matches!(component, Component::Leaves(..))
                        && leaves.as_slice().iter().all(|of| *of == Leaf::Computed) =>
                {
                    self.rewind(mark);
                    continue;
                }
                Ok(leaves) if self.token.is(b';') || template.len() > 1 => leaves,
                Ok(_) | Err(Fault::Unexpected { .. }) => {
                    self.rewind(mark);
                    continue;
                }
                Err(fault) => return Err(fault),
            };
            let shape = match template {
                ROBTARGET => Shape::Pose,
                JOINTTARGET => Shape::Joints,
                _ => {
                    let start = short(self.parsed.leaves.len());
                    self.parsed.leaves.extend_from_slice(leaves.as_slice());
                    let end = short(self.parsed.leaves.len());
                    return Ok((component, Assigned::Leaves((start, end))));
                }
            };
            let value = match self.target(shape, None, offset, &leaves, mentions) {
                Written::Base(base) => Expression::Point {
                    base,
                    steps: (0, 0),
                },
                Written::Composed(composed) => Expression::Composed(composed),
            };
            return Ok((component, Assigned::To(value)));
        }
        if self.token.is(b'[')
            && matches!(component, Component::Whole | Component::Place)
            && let Some(list) = self.list()?
        {
            return Ok((component, Assigned::To(list)));
        }
        self.argument(None)
            .map(|value| (component, Assigned::To(value)))
    }

    /// The template of a value whose type only its first words tell.
    fn type_by_look(&mut self) -> Result<&'static [u8], Fault> {
        self.advance()?;
        let truth = self.is_word(b"true") || self.is_word(b"false");
        if truth {
            self.advance()?;
            self.advance()?;
            return Ok(if self.token.is(b'[') {
                TOOLDATA
            } else {
                WOBJDATA
            });
        }
        Ok(if self.token.is(b'[') { ROBTARGET } else { b"" })
    }
}

/// The part of a tool or frame that a word names inside another part: its leaves and template.
pub(super) fn part(inside: Component, word: &[u8]) -> Option<(Component, &'static [u8])> {
    let inside = match inside {
        Component::Whole => None,
        Component::Leaves(first, _) => Some(first),
        Component::Place | Component::Other => return None,
    };
    let (first, count, template): (u8, u8, &'static [u8]) = match (inside, word) {
        (None, b"robhold") => (0, 1, BOOL),
        (None, b"tframe") => (1, 7, POSE),
        (None, b"tload") => (8, 11, LOADDATA),
        (None, b"ufprog") => (1, 1, BOOL),
        (None, b"ufmec") => (2, 1, STRING),
        (None, b"uframe") => (3, 7, POSE),
        (None, b"oframe") => (10, 7, POSE),
        (Some(8), b"mass") => (8, 1, NUM),
        (Some(8), b"cog") => (9, 3, POS),
        (Some(pose @ (1 | 3 | 10)), b"trans") => (pose, 3, POS),
        (Some(pose @ (1 | 3 | 10)), b"rot") => (pose + 3, 4, ORIENT),
        (Some(trans @ (1 | 3 | 9 | 10)), b"x") => (trans, 1, NUM),
        (Some(trans @ (1 | 3 | 9 | 10)), b"y") => (trans + 1, 1, NUM),
        (Some(trans @ (1 | 3 | 9 | 10)), b"z") => (trans + 2, 1, NUM),
        (Some(rot @ (4 | 6 | 13)), b"q1") => (rot, 1, NUM),
        (Some(rot @ (4 | 6 | 13)), b"q2") => (rot + 1, 1, NUM),
        (Some(rot @ (4 | 6 | 13)), b"q3") => (rot + 2, 1, NUM),
        (Some(rot @ (4 | 6 | 13)), b"q4") => (rot + 3, 1, NUM),
        _ => return None,
    };
    Some((Component::Leaves(first, count), template))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_frames_start_at_their_leaves() {
        let path = |words: &[&str]| {
            words.iter().try_fold(Component::Whole, |inside, word| {
                part(inside, word.as_bytes()).map(|(component, _)| component)
            })
        };
        let leaves = |first, count| Some(Component::Leaves(first, count));
        assert_eq!(path(&["tframe", "rot", "q4"]), leaves(7, 1));
        assert_eq!(path(&["oframe", "trans", "x"]), leaves(10, 1));
        assert_eq!(path(&["uframe", "rot"]), leaves(6, 4));
        assert_eq!(path(&["trans", "x"]), None);
    }
}
