//! One value of a profile's text changed: every other byte stays, comments included.

use crate::printable::quoted;
use granit_parser::{Event, Parser, StructureStyle};
use serde_json::Value;
use std::ops::Range;

/// Why a value cannot be set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// No YAML that can be read.
    #[error("line {line}: {message}")]
    Yaml {
        /// Line, from 1.
        line: usize,
        /// What the parser says.
        message: String,
    },
    /// The path to the value ends before it.
    #[error("`{path}` has no `{key}`")]
    NoSuch {
        /// The path so far.
        path: String,
        /// What is not there.
        key: String,
        /// What is there.
        known: Vec<String>,
    },
    /// A value over several lines.
    #[error("`{path}` is a block of several lines: set what is in it")]
    Block {
        /// The path to it.
        path: String,
    },
    /// A number with a decimal comma.
    #[error("`{value}` is no number")]
    Comma {
        /// The value as it was given.
        value: String,
    },
    /// What came out is not what was meant.
    #[error("the file's layout is too unusual to set `{path}` in place")]
    Layout {
        /// The path to the value.
        path: String,
    },
}

/// A node of the text.
#[derive(Debug)]
struct Node {
    /// Its bytes; those of a block end somewhere behind its last value.
    bytes: Range<usize>,
    content: Content,
}

#[derive(Debug)]
enum Content {
    Scalar,
    List(Vec<Node>),
    /// Whether it is written in braces; names with where they start.
    Map(bool, Vec<(String, usize, Node)>),
}

/// The text with the value at a path (`kinematics.joints.3.min_deg`: keys, and numbers from 1 in
/// lists) replaced by YAML of one line, or put into the map that does not have it yet.
///
/// # Errors
/// A path that leads nowhere, a value over several lines, a layout that is not understood: what was
/// made is read again and compared as data.
pub fn with_value(text: &str, path: &str, value: &str) -> Result<String, EditError> {
    let (root, data) = (tree(text)?, data(text)?);
    let steps: Vec<&str> = path.split('.').collect();
    let out = put(text, &root, &steps, value)?;
    let mut meant = data;
    let layout = || EditError::Layout { path: path.into() };
    let digits = value.strip_prefix('-').unwrap_or(value);
    if let Some((whole, part)) = digits.split_once(',')
        && [whole, part]
            .iter()
            .all(|half| !half.is_empty() && half.bytes().all(|b| b.is_ascii_digit()))
    {
        return Err(EditError::Comma {
            value: value.into(),
        });
    }
    let new: Value = serde_yaml::from_str(value).map_err(|_| layout())?;
    set(&mut meant, &steps, new).ok_or_else(layout)?;
    if self::data(&out).is_ok_and(|found| found == meant) {
        Ok(out)
    } else {
        Err(layout())
    }
}

/// The text as data.
fn data(text: &str) -> Result<Value, EditError> {
    serde_yaml::from_str(text).map_err(|error| EditError::Yaml {
        line: error
            .location()
            .map_or(1, |place| usize::try_from(place.line()).unwrap_or(1)),
        message: error.to_string(),
    })
}

/// The same change to data.
fn set(data: &mut Value, steps: &[&str], new: Value) -> Option<()> {
    let Some((step, rest)) = steps.split_first() else {
        *data = new;
        return Some(());
    };
    match data {
        Value::Array(list) => set(list.get_mut(index(step)?)?, rest, new),
        Value::Object(map) => set(map.entry(*step).or_insert(Value::Null), rest, new),
        Value::Null => {
            *data = Value::Object(serde_json::Map::new());
            set(data, steps, new)
        }
        _ => None,
    }
}

/// Numbers of lists are counted from 1.
fn index(step: &str) -> Option<usize> {
    step.parse::<usize>().ok()?.checked_sub(1)
}

fn put(text: &str, root: &Node, steps: &[&str], value: &str) -> Result<String, EditError> {
    let mut node = root;
    for (at, step) in steps.iter().enumerate() {
        let so_far = || match at {
            0 => "the profile".to_owned(),
            _ => steps[..at].join("."),
        };
        match &node.content {
            Content::Map(in_braces, entries) => {
                if let Some((_, _, inner)) = entries.iter().find(|(key, ..)| key == step) {
                    node = inner;
                    continue;
                }
                // what is not there yet is put in, with all that is on the way to it
                let mut entry = value.to_owned();
                for step in steps[at + 1..].iter().rev() {
                    entry = format!("{{{}: {entry}}}", key(step));
                }
                let entry = format!("{}: {entry}", key(step));
                return Ok(if *in_braces {
                    into_braces(text, node, entries.is_empty(), &entry)
                } else {
                    into_block(text, node, entries, &entry)
                });
            }
            Content::List(items) => {
                let found = index(step).and_then(|index| items.get(index));
                node = found.ok_or_else(|| EditError::NoSuch {
                    path: so_far(),
                    key: (*step).to_owned(),
                    known: (1..=items.len()).map(|n| n.to_string()).collect(),
                })?;
            }
            Content::Scalar => {
                return Err(EditError::NoSuch {
                    path: so_far(),
                    key: (*step).to_owned(),
                    known: Vec::new(),
                });
            }
        }
    }
    let written = &text[node.bytes.clone()];
    let is_block = match &node.content {
        Content::Map(in_braces, _) => !in_braces,
        Content::List(_) => !written.starts_with('['),
        Content::Scalar => written.contains('\n'),
    };
    if is_block {
        return Err(EditError::Block {
            path: steps.join("."),
        });
    }
    let Range { start, end } = node.bytes;
    Ok(format!("{}{value}{}", &text[..start], &text[end..]))
}

fn key(name: &str) -> String {
    let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    // YAML reads these as other than text, YAML 1.1 also `on` and `y`
    let words = ["null", "true", "false", "yes", "off"];
    let is_word = words.iter().any(|word| name.eq_ignore_ascii_case(word));
    if plain && !is_word && name.len() > 2 && !name.starts_with(|c: char| c.is_ascii_digit()) {
        name.to_owned()
    } else {
        quoted(name)
    }
}

fn into_braces(text: &str, node: &Node, is_empty: bool, entry: &str) -> String {
    let end = node.bytes.end - 1;
    let before = text[..end].trim_end();
    let between = if is_empty { "" } else { ", " };
    format!("{before}{between}{entry}{}", &text[end..])
}

fn into_block(text: &str, node: &Node, entries: &[(String, usize, Node)], entry: &str) -> String {
    let first = entries.first().map_or(node.bytes.start, |entry| entry.1);
    let line = text[..first].rfind('\n').map_or(0, |at| at + 1);
    let indent = " ".repeat(text[line..first].chars().count());
    let last = entries.last().map_or(first, |entry| end(&entry.2));
    let end = text[last..].find('\n').map_or(text.len(), |at| last + at);
    let before = text[..end].trim_end_matches('\r');
    let line_end = if before.len() < end { "\r\n" } else { "\n" };
    format!("{before}{line_end}{indent}{entry}{}", &text[before.len()..])
}

/// Where the last value in a node ends.
fn end(node: &Node) -> usize {
    match &node.content {
        Content::Map(false, entries) => entries.last().map_or(node.bytes.start, |e| end(&e.2)),
        Content::List(items) if !items.is_empty() => items.last().map_or(node.bytes.end, end),
        _ => node.bytes.end,
    }
}

/// A collection that is read, and what of a map waits for its value.
struct Open {
    node: Node,
    key: Option<(String, usize)>,
}

/// The nodes of a text with their bytes.
fn tree(text: &str) -> Result<Node, EditError> {
    let mut open: Vec<Open> = Vec::new();
    let mut root = None;
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| EditError::Yaml {
            line: error.marker().line(),
            message: error.to_string(),
        })?;
        let bytes = span.byte_range().unwrap_or_default();
        let closed = match event {
            Event::Scalar(word, ..) => {
                if let Some(Open {
                    node:
                        Node {
                            content: Content::Map(..),
                            ..
                        },
                    key: key @ None,
                }) = open.last_mut()
                {
                    *key = Some((word.into_owned(), bytes.start));
                    continue;
                }
                Some(Node {
                    bytes,
                    content: Content::Scalar,
                })
            }
            Event::SequenceStart(..) => {
                open.push(Open::of(bytes, Content::List(Vec::new())));
                None
            }
            Event::MappingStart(style, ..) => {
                let in_braces = style == StructureStyle::Flow;
                open.push(Open::of(bytes, Content::Map(in_braces, Vec::new())));
                None
            }
            Event::SequenceEnd | Event::MappingEnd => open.pop().map(|mut open| {
                open.node.bytes.end = bytes.end;
                open.node
            }),
            // a value that stands elsewhere is changed there
            Event::Alias(_) => Some(Node {
                bytes,
                content: Content::Scalar,
            }),
            _ => None,
        };
        let Some(node) = closed else { continue };
        match open.last_mut() {
            None => root = Some(node),
            Some(Open { node: above, key }) => match &mut above.content {
                Content::List(items) => items.push(node),
                Content::Map(_, entries) => {
                    if let Some((key, at)) = key.take() {
                        entries.push((key, at, node));
                    }
                }
                Content::Scalar => {}
            },
        }
    }
    root.ok_or_else(|| EditError::Yaml {
        line: 1,
        message: "the file is empty".into(),
    })
}

impl Open {
    fn of(bytes: Range<usize>, content: Content) -> Self {
        Self {
            node: Node { bytes, content },
            key: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# ümlaut: stays\nrobot: {model: \"a b\", serial: unknown}   # who\n\
        kinematics:\n  joints:\n    - {min_deg: -1, max_deg: 2}   # one\n    - {min_deg: -3, \
            max_deg: 4}\n  flange: {x_mm: 0}\n\
        tools: {}\ncontroller:\n  # which\n  model: nominal   # it is\nlast: 1\n";

    fn changed(path: &str, value: &str, old: &str, new: &str) {
        assert!(TEXT.contains(old));
        let found = with_value(TEXT, path, value).expect(path);
        assert_eq!(found, TEXT.replacen(old, new, 1), "{path}");
    }

    #[test]
    fn one_value_changes_and_nothing_else() {
        changed("robot.serial", "\"12-3\"", "unknown", "\"12-3\"");
        changed(
            "kinematics.joints.2.max_deg",
            "170",
            "max_deg: 4",
            "max_deg: 170",
        );
        changed(
            "controller.model",
            "calibrated",
            "model: nominal",
            "model: calibrated",
        );
        changed("tools", "{t: 1}", "tools: {}", "tools: {t: 1}");
    }

    #[test]
    fn what_is_not_there_is_put_where_it_belongs() {
        changed(
            "robot.payload_kg",
            "3",
            "serial: unknown",
            "serial: unknown, payload_kg: 3",
        );
        changed(
            "tools.gripper",
            "{m: 1}",
            "tools: {}",
            "tools: {gripper: {m: 1}}",
        );
        changed(
            "controller.language",
            "krl",
            "model: nominal   # it is",
            "model: nominal   # it is\n  language: krl",
        );
        changed(
            "points.nest.x",
            "1",
            "last: 1",
            "last: 1\npoints: {nest: {\"x\": 1}}",
        );
        let windows = TEXT.replace('\n', "\r\n");
        let found = with_value(&windows, "controller.language", "krl").expect("a layout");
        assert_eq!(found.matches("\r\n").count(), found.matches('\n').count());
        let block = "tools:\n  a:\n    x: 1\n  # behind\nlast: 2\n";
        let found = with_value(block, "tools.torch", "{x: 2}").expect("a layout");
        assert_eq!(
            found,
            "tools:\n  a:\n    x: 1\n  torch: {x: 2}\n  # behind\nlast: 2\n"
        );
    }

    #[test]
    fn a_path_that_leads_nowhere_says_what_there_is() {
        let error = with_value(TEXT, "kinematics.joints.3.min_deg", "1").expect_err("two joints");
        assert_eq!(error.to_string(), "`kinematics.joints` has no `3`");
        let error = with_value(TEXT, "last.x", "1").expect_err("a number");
        assert_eq!(error.to_string(), "`last` has no `x`");
        let error = with_value(TEXT, "kinematics", "1").expect_err("a block");
        assert!(error.to_string().contains("several lines"), "{error}");
        assert!(with_value("a: [", "a", "1").is_err());
        assert!(with_value("", "a", "1").is_err());
        assert!(with_value(TEXT, "robot.serial", "{").is_err());
    }

    #[test]
    fn names_that_are_no_text_to_yaml_are_quoted() {
        for name in ["no", "Null", "TRUE", "yes", "Off", "1e3", "a: b", "x\u{85}"] {
            assert!(key(name).starts_with('"'), "{}", key(name));
        }
        assert_eq!(key("torch"), "torch");
        let block = "tools:\n  a:\n    x: 1\nlast: 2\n";
        let found = with_value(block, "tools.null", "{x: 2}").expect("a layout");
        let tools = &data(&found).expect("YAML")["tools"];
        assert_eq!(tools["null"]["x"], 2, "{found}");
    }
}
