//! XML as a tree, read without recursion and within limits: what nests deeper, or has more
//! elements, is refused.
//!
//! # Source
//! W3C, "Extensible Markup Language (XML) 1.0"; entities that a document defines itself are not
//! expanded.

use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use std::borrow::Cow;

/// Elements in each other: robots and meshes have a few dozen.
const DEEPEST: usize = 256;
/// Elements of a file.
const MOST: usize = 2_000_000;
/// Attributes of an element.
const MOST_ATTRIBUTES: usize = 256;

/// Why a text is no XML that is read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct XmlError {
    /// Line, from 1.
    pub line: usize,
    /// What is wrong there.
    pub message: String,
}

/// An element with what is in it.
#[derive(Debug, Default)]
pub struct Element<'a> {
    /// Its name, with its prefix where it has one.
    pub name: String,
    /// Names and values.
    attributes: Vec<(String, String)>,
    /// The text directly in it, one piece after another.
    pub text: Cow<'a, str>,
    /// The elements directly in it.
    pub children: Vec<Element<'a>>,
    /// Its line, from 1.
    pub line: usize,
}

impl Element<'_> {
    /// The value of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        let mut attributes = self.attributes.iter();
        attributes
            .find(|(other, _)| other == name)
            .map(|(_, value)| value.as_str())
    }

    /// The elements of this name directly in it.
    pub fn all<'e>(&'e self, name: &'e str) -> impl Iterator<Item = &'e Self> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// The first of them.
    pub fn first(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name == name)
    }

    /// Something wrong with it.
    pub fn fault(&self, message: impl Into<String>) -> XmlError {
        XmlError {
            line: self.line,
            message: message.into(),
        }
    }

    fn of(start: &BytesStart, line: usize) -> Result<Self, String> {
        let name = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let mut attributes = Vec::new();
        for attribute in start.attributes() {
            let attribute = attribute.map_err(|error| error.to_string())?;
            if attributes.len() == MOST_ATTRIBUTES {
                return Err(format!(
                    "an element has more than {MOST_ATTRIBUTES} attributes"
                ));
            }
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            let value = value.map_err(|error| error.to_string())?;
            attributes.push((name(attribute.key.as_ref()), value.into_owned()));
        }
        Ok(Self {
            name: name(start.name().as_ref()),
            attributes,
            line,
            ..Self::default()
        })
    }
}

/// Reads a document.
///
/// # Errors
/// What is no XML, is cut off, or is beyond the limits.
#[allow(
    clippy::missing_panics_doc,
    reason = "the document itself is never closed"
)]
pub fn read(text: &str) -> Result<Element<'_>, XmlError> {
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = Lines::of(text);
    let mut reader = Reader::from_str(text);
    let mut open = vec![Element {
        line: 1,
        ..Element::default()
    }];
    let mut count = 0;
    loop {
        let at = lines.at(reader.buffer_position());
        let fault = |message: String| XmlError { line: at, message };
        let event = reader
            .read_event()
            .map_err(|error| fault(error.to_string()))?;
        let depth = open.len() - 1;
        let top = open.last_mut().expect("the document is never closed");
        match event {
            Event::Start(start) => {
                open.push(Element::of(&start, at).map_err(fault)?);
                count += 1;
                if depth == DEEPEST {
                    return Err(fault(format!("elements nest deeper than {DEEPEST}")));
                }
            }
            Event::Empty(start) => {
                top.children.push(Element::of(&start, at).map_err(fault)?);
                count += 1;
            }
            Event::End(_) => close(&mut open),
            Event::Text(text) => {
                add(
                    top,
                    text.decode().map_err(|error| fault(error.to_string()))?,
                );
            }
            Event::CData(text) => {
                add(
                    top,
                    text.decode().map_err(|error| fault(error.to_string()))?,
                );
            }
            Event::GeneralRef(entity) => {
                let character = entity
                    .resolve_char_ref()
                    .map_err(|error| fault(error.to_string()))?;
                let name = entity.decode().map_err(|error| fault(error.to_string()))?;
                match character {
                    Some(character) => add(top, character.to_string().into()),
                    None => match resolve_predefined_entity(&name) {
                        Some(text) => add(top, text.into()),
                        None => return Err(fault(format!("the entity `&{name};` is not known"))),
                    },
                }
            }
            Event::Eof if depth == 0 => break,
            Event::Eof => {
                return Err(fault(format!(
                    "the file ends inside of <{}> of line {}",
                    top.name, top.line
                )));
            }
            Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::DocType(_) => {}
        }
        if count > MOST {
            return Err(fault(format!("more than {MOST} elements")));
        }
    }
    let mut document = open.pop().expect("the document is never closed");
    match (document.children.len(), document.text.trim()) {
        (1, "") => Ok(document.children.remove(0)),
        (0, _) => Err(document.fault("there is no element")),
        _ => Err(document.fault("more than one element, or text next to it")),
    }
}

fn close(open: &mut Vec<Element>) {
    let closed = open.pop().expect("the reader compares the names of ends");
    let above = open.last_mut().expect("the document is never closed");
    above.children.push(closed);
}

fn add<'a>(element: &mut Element<'a>, text: Cow<'a, str>) {
    if element.text.is_empty() {
        element.text = text;
    } else {
        element.text.to_mut().push_str(&text);
    }
}

/// Numbers of lines, counted once from the start to the end.
struct Lines<'a> {
    text: &'a [u8],
    seen: usize,
    line: usize,
}

impl<'a> Lines<'a> {
    fn of(text: &'a str) -> Self {
        Self {
            text: text.as_bytes(),
            seen: 0,
            line: 1,
        }
    }

    /// The line of a byte that is not before the one asked for last.
    fn at(&mut self, offset: u64) -> usize {
        let offset = usize::try_from(offset).map_or(self.text.len(), |at| at.min(self.text.len()));
        let passed = &self.text[self.seen.min(offset)..offset];
        self.line += memchr::memchr_iter(b'\n', passed).count();
        self.seen = offset.max(self.seen);
        self.line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_have_attributes_text_and_a_line() {
        let text = "\u{feff}<?xml version='1.0'?>\n<!-- <x> -->\n<a n='1 &amp; 2'>\n \
            x&#65;<![CDATA[<]]>\n<b/><c:b>2</c:b></a>\n";
        let root = read(text).expect("XML");
        assert_eq!(
            (root.name.as_str(), root.attribute("n")),
            ("a", Some("1 & 2"))
        );
        assert_eq!(root.text.trim(), "xA<");
        let names: Vec<_> = root
            .children
            .iter()
            .map(|c| (c.name.as_str(), c.line))
            .collect();
        assert_eq!(names, [("b", 5), ("c:b", 5)]);
        assert_eq!(root.first("c:b").expect("a child").text, "2");
    }

    #[test]
    fn what_is_no_xml_or_beyond_the_limits_is_an_error_with_its_line() {
        let deep = "<a>\n".repeat(100_000);
        let many: String = (0..300).map(|i| format!(" a{i}=''")).collect();
        for (text, line, says) in [
            ("", 1, "no element"),
            ("text", 1, "no element"),
            ("<a/><b/>", 1, "more than one"),
            ("<a>\n<b>\n", 3, "ends inside of <b> of line 2"),
            ("<a>\n</b>", 2, "b"),
            ("</a>", 1, "a"),
            ("<a>&bomb;</a>", 1, "not known"),
            ("<a n='&bomb;'/>", 1, "bomb"),
            ("<a n='1' n='2'/>", 1, "duplicate"),
            (&deep, 257, "deeper than 256"),
            (&format!("<a{many}/>"), 1, "more than 256 attributes"),
        ] {
            let error = read(text).expect_err(says);
            let short: String = text.chars().take(40).collect();
            assert!(error.to_string().contains(says), "{short}: {error}");
            assert_eq!(error.line, line, "{short}: {error}");
        }
    }
}
