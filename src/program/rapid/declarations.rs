//! Declarations, parameters of routines, and what assignments set.

use super::aggregate::{
    BOOL, JOINTTARGET, LOADDATA, Leaf, NUM, ORIENT, POS, POSE, ROBTARGET, STRING, TOOLDATA,
    WOBJDATA,
};
use super::names::Symbol;
use super::reader::{Reader, index, keyword};
use super::syntax::{Component, Datum, Element, Part, Place, Stored, Type};
use super::tokens::{Fault, Kind};
use crate::program::{Shape, TargetId};

/// Most dimensions of an array in RAPID.
const DIMENSIONS: usize = 3;

/// What an assignment sets, and the value where it is written out.
type Assigned = (Component, Option<Part>, Option<TargetId>);

impl Reader<'_> {
    /// `CONST type name{sizes} := value;`, the present token is CONST, PERS or VAR. Whether it is data that robots use.
    pub(super) fn declaration(
        &mut self,
        start: u32,
        local: bool,
        constant: bool,
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
            value = match kind {
                Type::Robtarget | Type::Jointtarget => self.targets(kind, name, dimensions)?,
                Type::Tooldata | Type::Wobjdata if dimensions == 0 && self.token.is(b'[') => {
                    let template = if kind == Type::Tooldata {
                        TOOLDATA
                    } else {
                        WOBJDATA
                    };
                    Stored::Leaves(self.leaves(template)?)
                }
                Type::Num if constant && dimensions == 0 => self.constant()?,
                _ => Stored::Computed(self.expression()?),
            };
        } else if dimensions > 0 && kind != Type::Other {
            value = Stored::Computed((0, 0));
        }
        self.end_statement()?;
        let place = Place {
            file: self.file,
            offset: start,
        };
        self.notes.data.push(Datum {
            name,
            kind,
            context: self.context,
            place,
            local,
            parameter: false,
            constant,
            value,
        });
        Ok(kind != Type::Other)
    }

    fn type_name(&self) -> Type {
        let mut buffer = [0; 12];
        Type::named(keyword(self.text(self.token), &mut buffer))
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
                    return Err(Fault::Unclosed {
                        at,
                        what: "bracket",
                    });
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
        self.expression().map(Stored::Computed)
    }

    /// The value of a target or of an array of them.
    fn targets(&mut self, kind: Type, name: Symbol, dimensions: usize) -> Result<Stored, Fault> {
        if !self.token.is(b'[') || dimensions > DIMENSIONS {
            return self.expression().map(Stored::Computed);
        }
        let start = index(self.notes.elements.len());
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
                    Fault::Unclosed {
                        at: openers[level - 1],
                        what: "bracket",
                    }
                } else {
                    self.unexpected(",")
                });
            }
            self.advance()?;
            position[level - 1] += 1;
        }
        let elements = (start, index(self.notes.elements.len()));
        Ok(Stored::Elements { elements, sizes })
    }

    fn element(&mut self, kind: Type, name: Symbol, position: &[u32]) -> Result<(), Fault> {
        let offset = self.token.start;
        let element = if self.token.is(b'[') {
            let (template, shape) = match kind {
                Type::Jointtarget => (JOINTTARGET, Shape::Joints),
                _ => (ROBTARGET, Shape::Pose),
            };
            let leaves = self.aggregate(template)?;
            let spelled = self.notes.symbols.spelling(name);
            let full: Box<str> = match position {
                [] => spelled.into(),
                [i] => format!("{spelled}{{{i}}}").into(),
                [i, j] => format!("{spelled}{{{i},{j}}}").into(),
                [i, j, k, ..] => format!("{spelled}{{{i},{j},{k}}}").into(),
            };
            Element::Target(self.push_target(shape, Some(full), offset, leaves.as_slice()))
        } else {
            let first = self.token;
            let mentions = self.expression()?;
            match self.notes.mentions[mentions.0 as usize..mentions.1 as usize] {
                [other] if self.text(first).len() == self.notes.symbols.spelling(other).len() => {
                    Element::Named(other)
                }
                _ if self.token.start == first.start => return Err(self.unexpected("a target")),
                _ => Element::Computed,
            }
        };
        self.notes.elements.push(element);
        Ok(())
    }

    fn leaves(&mut self, template: &[u8]) -> Result<Part, Fault> {
        let leaves = self.aggregate(template)?;
        let start = index(self.notes.leaves.len());
        self.notes.leaves.extend_from_slice(leaves.as_slice());
        Ok((start, index(self.notes.leaves.len())))
    }

    /// `(robtarget p, \switch on | num x, PERS tooldata t)`
    pub(super) fn parameters(&mut self) -> Result<(), Fault> {
        let at = self.token.start;
        let (mut kind, mut last) = (Type::Other, None);
        loop {
            self.advance()?;
            match self.token.kind {
                Kind::Name => {
                    kind = match last {
                        Some(token) => {
                            let mut buffer = [0; 12];
                            Type::named(keyword(self.text(token), &mut buffer))
                        }
                        None => Type::Other,
                    };
                    last = Some(self.token);
                }
                Kind::Sign(b',' | b'|' | b')') => {
                    if let Some(token) = last.take() {
                        let name = self.notes.symbols.intern(self.text(token));
                        self.parameter(name, kind, token.start);
                    }
                    if self.token.is(b')') {
                        return self.advance();
                    }
                }
                Kind::End | Kind::Sign(b';') => {
                    return Err(Fault::Unclosed {
                        at,
                        what: "bracket",
                    });
                }
                _ => {}
            }
        }
    }

    fn parameter(&mut self, name: Symbol, kind: Type, offset: u32) {
        let place = Place {
            file: self.file,
            offset,
        };
        self.notes.data.push(Datum {
            name,
            kind,
            context: self.context,
            place,
            local: true,
            parameter: true,
            constant: false,
            value: Stored::Nothing,
        });
    }

    /// `.part.part` as far as it stands; `None` where it is no part of a tool or frame.
    pub(super) fn component(&mut self) -> Result<Option<(Component, &'static [u8])>, Fault> {
        let mut found = Some((Component::Whole, &b""[..]));
        while self.token.is(b'.') {
            self.advance()?;
            let word = self.text(self.token).to_ascii_lowercase();
            found = found.and_then(|(so_far, _)| part(so_far, &word));
            if found.is_none() {
                found = Some((Component::Other, &b""[..]));
            }
            self.advance()?;
            self.index()?;
        }
        Ok(found)
    }

    /// The value of an assignment, where it is written out.
    pub(super) fn assigned(
        &mut self,
        path: Option<(Component, &'static [u8])>,
    ) -> Result<Assigned, Fault> {
        let (component, template) = path.unwrap_or((Component::Other, b""));
        let mark = self.mark();
        let nothing = (component, None, None);
        let template = match component {
            Component::Leaves(_) => template,
            Component::Whole if self.token.is(b'[') => self.type_by_look()?,
            _ => return Ok(nothing),
        };
        self.rewind(mark);
        if template.is_empty() {
            return Ok(nothing);
        }
        let offset = self.token.start;
        let mentions = self.notes.mentions.len();
        let leaves = match self.aggregate(template) {
            Ok(leaves) if self.token.is(b';') || template.len() > 1 => leaves,
            Ok(_) | Err(Fault::Unexpected { .. }) => {
                self.rewind(mark);
                self.notes.mentions.truncate(mentions);
                return Ok(nothing);
            }
            Err(fault) => return Err(fault),
        };
        if template == ROBTARGET || template == JOINTTARGET {
            let shape = if template == ROBTARGET {
                Shape::Pose
            } else {
                Shape::Joints
            };
            let target = self.push_target(shape, None, offset, leaves.as_slice());
            return Ok((component, None, Some(target)));
        }
        let start = index(self.notes.leaves.len());
        self.notes.leaves.extend_from_slice(leaves.as_slice());
        let part = (start, index(self.notes.leaves.len()));
        Ok((component, Some(part), None))
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

/// The part of a tool or frame that a word names inside another part: first leaf and template.
fn part(inside: Component, word: &[u8]) -> Option<(Component, &'static [u8])> {
    let (first, template): (u8, &'static [u8]) = match (inside, word) {
        (Component::Whole, b"robhold") => (0, BOOL),
        (Component::Whole, b"tframe") => (1, POSE),
        (Component::Whole, b"tload") => (8, LOADDATA),
        (Component::Whole, b"ufprog") => (1, BOOL),
        (Component::Whole, b"ufmec") => (2, STRING),
        (Component::Whole, b"uframe") => (3, POSE),
        (Component::Whole, b"oframe") => (10, POSE),
        (Component::Leaves(8), b"mass") => (8, NUM),
        (Component::Leaves(8), b"cog") => (9, POS),
        (Component::Leaves(pose @ (1 | 3 | 10)), b"trans") => (pose, POS),
        (Component::Leaves(pose @ (1 | 3 | 10)), b"rot") => (pose + 3, ORIENT),
        (Component::Leaves(trans @ (1 | 3 | 9 | 10)), b"x") => (trans, NUM),
        (Component::Leaves(trans @ (1 | 3 | 9 | 10)), b"y") => (trans + 1, NUM),
        (Component::Leaves(trans @ (1 | 3 | 9 | 10)), b"z") => (trans + 2, NUM),
        (Component::Leaves(rot @ (4 | 6 | 13)), b"q1") => (rot, NUM),
        (Component::Leaves(rot @ (4 | 6 | 13)), b"q2") => (rot + 1, NUM),
        (Component::Leaves(rot @ (4 | 6 | 13)), b"q3") => (rot + 2, NUM),
        (Component::Leaves(rot @ (4 | 6 | 13)), b"q4") => (rot + 3, NUM),
        _ => return None,
    };
    Some((Component::Leaves(first), template))
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
        assert_eq!(path(&["tframe", "rot", "q4"]), Some(Component::Leaves(7)));
        assert_eq!(path(&["oframe", "trans", "x"]), Some(Component::Leaves(10)));
        assert_eq!(path(&["uframe", "rot"]), Some(Component::Leaves(6)));
        assert_eq!(path(&["trans", "x"]), None);
    }
}
