//! Elements of a project's files, one after another, with the bytes where they stand.

use crate::program::kit::{Fault, content_start};
use crate::program::script::short;
use crate::program::{Number, number};
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// A tag that opens an element, or is all of it.
#[derive(Debug)]
pub(super) struct Tag<'a> {
    bytes: &'a [u8],
    /// Its name without prefix.
    pub name: &'a [u8],
    /// Its first byte.
    pub at: usize,
    /// Behind its last byte.
    pub end: usize,
    /// The element has nothing inside.
    pub is_empty: bool,
    start: BytesStart<'a>,
}

/// What is between two quotes, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attribute<'a> {
    pub name: &'a [u8],
    pub value: &'a [u8],
    /// First byte of the value.
    pub start: usize,
    /// Behind the quote that closes it.
    pub end: usize,
}

impl Attribute<'_> {
    /// The number in it.
    pub(super) fn number(&self) -> Result<Number, Fault> {
        let blanks = self.value.len() - self.value.trim_ascii_start().len();
        let text = self.value.trim_ascii();
        let start = self.start + blanks;
        match (number::parse(text), u16::try_from(text.len())) {
            (Some(value), Ok(length)) => Ok(Number {
                start: short(start),
                length,
                value,
            }),
            _ => Err(Fault::unexpected(start..start + text.len(), "a number")),
        }
    }
}

impl<'a> Tag<'a> {
    /// Its attributes in their order.
    pub(super) fn attributes(&self) -> Result<Vec<Attribute<'a>>, Fault> {
        let fault = || Fault::unexpected(self.at..self.end, "a tag with name=\"value\"");
        let mut found = Vec::with_capacity(12);
        for attribute in self.start.attributes() {
            let attribute = attribute.map_err(|_| fault())?;
            let start = offset_in(self.bytes, &attribute.value);
            // `xsi:type` is another than `type`
            let key = attribute.key;
            let name = offset_in(self.bytes, key.as_ref());
            found.push(Attribute {
                name: &self.bytes[name..name + key.as_ref().len()],
                value: &self.bytes[start..start + attribute.value.len()],
                start,
                end: start + attribute.value.len() + 1,
            });
        }
        Ok(found)
    }

    /// The value of one.
    pub(super) fn attribute(&self, name: &[u8]) -> Result<Option<Attribute<'a>>, Fault> {
        let all = self.attributes()?;
        Ok(all.into_iter().find(|one| one.name == name))
    }

    /// Behind its name.
    pub(super) fn behind_name(&self) -> usize {
        self.at + 1 + self.start.name().as_ref().len()
    }
}

/// What stands in a file.
#[derive(Debug)]
pub(super) enum Node<'a> {
    Open(Tag<'a>),
    /// The tag that closes an element: its name, first byte, and behind its last one.
    Close(&'a [u8], usize, usize),
}

/// The tags of a file.
pub(super) struct Nodes<'a> {
    bytes: &'a [u8],
    reader: Reader<&'a [u8]>,
    /// Open elements.
    depth: usize,
}

/// Elements in each other: a project has six.
const DEEPEST: usize = 64;

/// Where a part of some bytes begins in them.
fn offset_in(bytes: &[u8], part: &[u8]) -> usize {
    part.as_ptr() as usize - bytes.as_ptr() as usize
}

impl<'a> Nodes<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            reader: Reader::from_reader(&bytes[content_start(bytes)..]),
            depth: 0,
        }
    }

    fn tag(&self, start: BytesStart<'a>, is_empty: bool) -> Tag<'a> {
        let bytes = self.bytes;
        let local = start.local_name();
        let name = offset_in(bytes, local.as_ref());
        let name = &bytes[name..name + local.as_ref().len()];
        let inside = offset_in(bytes, &start);
        let end = inside + start.len() + 1 + usize::from(is_empty);
        Tag {
            bytes,
            name,
            at: inside - 1,
            end,
            is_empty,
            start,
        }
    }

    /// The next tag; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Node<'a>>, Fault> {
        loop {
            let event = self.reader.read_event().map_err(|_| {
                let at = usize::try_from(self.reader.error_position()).unwrap_or(0);
                let at = (at + content_start(self.bytes)).min(self.bytes.len());
                Fault::unexpected(at..self.bytes.len().min(at + 40), "well-formed XML")
            })?;
            match event {
                Event::Start(start) => {
                    let tag = self.tag(start, false);
                    self.depth += 1;
                    if self.depth > DEEPEST {
                        return Err(Fault::unexpected(tag.at..tag.end, "an element less deep"));
                    }
                    return Ok(Some(Node::Open(tag)));
                }
                Event::Empty(start) => return Ok(Some(Node::Open(self.tag(start, true)))),
                Event::End(end) => {
                    self.depth -= 1;
                    let whole = end.name();
                    let at = offset_in(self.bytes, whole.as_ref()) - 2;
                    let local = end.local_name();
                    let name = offset_in(self.bytes, local.as_ref());
                    let name = &self.bytes[name..name + local.as_ref().len()];
                    let rest = &self.bytes[at..];
                    let end = memchr::memchr(b'>', rest).map_or(rest.len(), |at| at + 1);
                    return Ok(Some(Node::Close(name, at, at + end)));
                }
                Event::Eof if self.depth > 0 => {
                    return Err(Fault::unclosed(self.bytes.len(), "an element"));
                }
                Event::Eof => return Ok(None),
                _ => {}
            }
        }
    }
}
