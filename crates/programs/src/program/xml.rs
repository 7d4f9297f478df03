//! Elements of XML files, one after another, with the bytes where they stand.

use crate::program::kit::{Fault, content_start};
use crate::program::{Number, number};
use quick_xml::events::{BytesStart, Event};
use quick_xml::name::QName;
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
        let text = self.value.trim_ascii();
        let start = self.start + self.value.len() - self.value.trim_ascii_start().len();
        let fault = || Fault::unexpected(start..start + text.len(), "a number");
        number::placed(text, start).ok_or_else(fault)
    }
}

impl<'a> Tag<'a> {
    /// Its attributes in their order; `xsi:type` is another than `type`.
    pub(super) fn attributes(&self) -> impl Iterator<Item = Result<Attribute<'a>, Fault>> {
        let content = self.at + 1;
        let mut seen = 0_u64;
        let part = move |part: &[u8]| {
            let at = content + (part.as_ptr() as usize - self.start.as_ptr() as usize);
            (at, &self.bytes[at..at + part.len()])
        };
        // whether a name stands twice is asked where letters and length are those of another
        let mut all = self.start.attributes();
        all.with_checks(false);
        all.map(move |attribute| {
            let fault = || Fault::unexpected(self.at..self.end, "a tag with name=\"value\"");
            let attribute = attribute.map_err(|_| fault())?;
            let (start, value) = part(&attribute.value);
            let name = part(attribute.key.as_ref()).1;
            let bit = 1_u64 << (mixed(name) & 63);
            if seen & bit != 0 && self.count(name) > 1 {
                return Err(fault());
            }
            seen |= bit;
            Ok(Attribute {
                name,
                value,
                start,
                end: start + value.len() + 1,
            })
        })
    }

    /// How many of its attributes have this name.
    fn count(&self, name: &[u8]) -> usize {
        let mut all = self.start.attributes();
        let named = all.with_checks(false).flatten();
        named.filter(|one| one.key.as_ref() == name).count()
    }

    /// One of them.
    pub(super) fn attribute(&self, name: &[u8]) -> Result<Option<Attribute<'a>>, Fault> {
        let mut found = None;
        for one in self.attributes() {
            let one = one?;
            found = found.or(Some(one).filter(|one| one.name == name));
        }
        Ok(found)
    }

    /// Its value; nothing where there is none.
    pub(super) fn value(&self, name: &[u8]) -> Result<&'a [u8], Fault> {
        Ok(self.attribute(name)?.map_or(b"", |one| one.value))
    }

    /// Behind its name.
    pub(super) fn behind_name(&self) -> usize {
        self.at + 1 + self.start.name().as_ref().len()
    }
}

/// A number that differs for most names of one tag.
fn mixed(name: &[u8]) -> usize {
    let letter = |at: usize| name.get(at).map_or(0, |byte| usize::from(*byte));
    letter(0) + 5 * letter(1) + 17 * name.len()
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

/// Elements in each other: files of programs have six.
const DEEPEST: usize = 64;

impl<'a> Nodes<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            reader: Reader::from_reader(&bytes[content_start(bytes)..]),
            depth: 0,
        }
    }

    /// Where the reader is.
    fn place(&self, position: u64) -> usize {
        let place = usize::try_from(position).unwrap_or(self.bytes.len());
        (content_start(self.bytes) + place).min(self.bytes.len())
    }

    /// A name at a byte without its prefix.
    fn local(&self, at: usize, name: QName) -> &'a [u8] {
        let end = at + name.as_ref().len();
        &self.bytes[end - name.local_name().as_ref().len()..end]
    }

    /// The next tag; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Node<'a>>, Fault> {
        loop {
            let at = self.place(self.reader.buffer_position());
            let event = self.reader.read_event().map_err(|_| {
                let at = self.place(self.reader.error_position());
                Fault::unexpected(at..self.bytes.len().min(at + 40), "well-formed XML")
            })?;
            let end = self.place(self.reader.buffer_position());
            let is_empty = matches!(event, Event::Empty(_));
            match event {
                Event::Start(start) | Event::Empty(start) => {
                    self.depth += usize::from(!is_empty);
                    if self.depth > DEEPEST {
                        return Err(Fault::unexpected(at..end, "an element less deep"));
                    }
                    return Ok(Some(Node::Open(Tag {
                        bytes: self.bytes,
                        name: self.local(at + 1, start.name()),
                        at,
                        end,
                        is_empty,
                        start,
                    })));
                }
                Event::End(tag) => {
                    self.depth -= 1;
                    let name = self.local(at + 2, tag.name());
                    return Ok(Some(Node::Close(name, at, end)));
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
