//! `/POS`: the points of a program.

use super::controller::Why;
use super::sections::line_end;
use crate::program::kit::Fault;
use crate::program::script::short;
use crate::program::{Number, Source, number};
use std::ops::Range;

/// Bytes of a number and the blanks before it.
const WIDEST_FIELD: usize = 4096;
/// Bytes of a wrong word that an error shows.
const LONGEST_WORD: usize = 20;
/// Millimetres or degrees.
const LARGEST: f64 = 1e6;
/// What group 1 of a point holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Content {
    /// X Y Z W P R, and configuration data where there are any.
    Pose { configured: bool },
    /// J1 to J6.
    Joints,
    /// Nothing that can be rewritten.
    Trouble(Why),
}

/// One point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point {
    /// Its number.
    pub number: u32,
    /// First byte.
    pub offset: u32,
    /// Behind its last brace.
    pub end: u32,
    /// Group 1; `None` where it has none: another robot or a positioner.
    pub content: Option<Content>,
    /// Its numbers among those of its listing.
    pub numbers: Range<usize>,
    /// Its work frame, `UF : 2`; none where that is the one that is active when the robot goes
    /// there, `UF : F`.
    pub frame: Option<u32>,
    /// A group besides the first is another arm.
    pub has_other_arm: bool,
    /// Its tool, likewise.
    pub tool: Option<u32>,
    /// Axes besides the six of the arm, of other groups as `G2J1`, and their values; not a number
    /// where they were never taught.
    pub external: Vec<Axis>,
}

/// A number that no robot can use.
pub(super) fn bad_value(at: usize, length: usize) -> Fault {
    Fault::bad_value(
        at..at + length,
        "coordinate, or number of a tool or frame",
        "a plain number of at most 1000000 is wanted; angles of tools and frames go to 720 deg, \
         their numbers to 255",
    )
}

/// Reads the points of a section.
pub(super) struct Points<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The numbers of all points so far.
    pub numbers: Vec<Number>,
}

impl<'a> Points<'a> {
    /// The points from `at` on.
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self {
            bytes,
            at,
            numbers: Vec::new(),
        }
    }

    fn byte(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        while self.byte().is_some_and(|b| b.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    fn skip_blanks_in_line(&mut self) {
        while matches!(self.byte(), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    fn expect(&mut self, byte: u8, expected: &'static str) -> Result<(), Fault> {
        self.skip_blanks();
        if self.byte() == Some(byte) {
            self.at += 1;
            return Ok(());
        }
        Err(self.unexpected(expected))
    }

    fn unexpected(&self, expected: &'static str) -> Fault {
        self.unexpected_at(self.at, expected)
    }

    /// The word at a byte stands where something else belongs.
    fn unexpected_at(&self, at: usize, expected: &'static str) -> Fault {
        let word = self.bytes[at..].iter().take(LONGEST_WORD);
        let length = word.take_while(|b| !b.is_ascii_whitespace()).count();
        Fault::unexpected(at..at + length, expected)
    }

    /// The next point; `None` at the end of the section.
    pub(super) fn next(&mut self) -> Result<Option<Point>, Fault> {
        loop {
            self.skip_blanks();
            match self.byte() {
                None | Some(b'/' | 0x1a) => return Ok(None),
                Some(b';') => self.at += 1,
                Some(b'!') => self.at = line_end(self.bytes, self.at),
                Some(_) => return self.point().map(Some),
            }
        }
    }

    fn point(&mut self) -> Result<Point, Fault> {
        let start = self.at;
        if !matches!(self.byte(), Some(b'P' | b'p')) {
            return Err(self.unexpected("a point `P[1]{` or /END"));
        }
        self.at += 1;
        self.expect(b'[', "[")?;
        self.skip_blanks();
        let number = self
            .whole_number()
            .ok_or_else(|| self.unexpected("the number of the point"))?;
        self.name(start)?;
        let mut point = Point {
            number,
            offset: short(start),
            end: short(start),
            content: None,
            numbers: 0..0,
            frame: None,
            tool: None,
            has_other_arm: false,
            external: Vec::new(),
        };
        self.expect(b'{', "{")?;
        self.groups(start, &mut point)?;
        point.end = short(self.at);
        Ok(point)
    }

    fn whole_number(&mut self) -> Option<u32> {
        let (value, length) = number::whole_start(&self.bytes[self.at..])?;
        self.at += length;
        Some(value)
    }

    /// `:"a name"]` or `]`.
    fn name(&mut self, start: usize) -> Result<(), Fault> {
        let end = line_end(self.bytes, self.at);
        let line = &self.bytes[self.at..end];
        let quoted = line
            .trim_ascii_start()
            .strip_prefix(b":")
            .is_some_and(|rest| rest.trim_ascii_start().starts_with(b"\""));
        let close = if quoted {
            memchr::memmem::find(line, b"\"]").map(|k| k + 1)
        } else {
            memchr::memchr(b']', line)
        };
        match close {
            Some(close) => {
                self.at += close + 1;
                Ok(())
            }
            None => Err(Fault::unclosed(start, "the name of a point")),
        }
    }

    /// What stands between the braces of a point.
    fn groups(&mut self, start: usize, point: &mut Point) -> Result<(), Fault> {
        let mut group = None;
        let mut first = Group::default();
        loop {
            self.skip_blanks();
            match self.byte() {
                None => return Err(Fault::unclosed(start, "a point")),
                Some(b'}') => {
                    self.at += 1;
                    break;
                }
                Some(b',' | b';') => self.at += 1,
                Some(_) => {
                    let key = self.key()?;
                    self.skip_blanks_in_line();
                    match self.byte() {
                        Some(b':') => {
                            self.at += 1;
                            if let Some(number) = group_number(&self.bytes[key.clone()]) {
                                group = Some(number);
                                first.there |= number == 1;
                            } else {
                                let within = self.in_group(group, &key)?;
                                self.setting(key, within, &mut first, point)?;
                            }
                        }
                        Some(b'=') => {
                            self.at += 1;
                            let within = self.in_group(group, &key)?;
                            self.value(key, group, within, &mut first)?;
                        }
                        _ => return Err(self.unexpected("= or :")),
                    }
                }
            }
        }
        if first.there {
            first.finish(point, &mut self.numbers);
        }
        Ok(())
    }

    /// Whether what stands here is of group 1.
    fn in_group(&self, group: Option<u32>, key: &Range<usize>) -> Result<bool, Fault> {
        match group {
            Some(number) => Ok(number == 1),
            None => Err(self.unexpected_at(key.start, "GP1:")),
        }
    }

    fn key(&mut self) -> Result<Range<usize>, Fault> {
        let word = |b: &&u8| b.is_ascii_alphanumeric() || **b == b'_' || !b.is_ascii();
        let length = self.bytes[self.at..].iter().take_while(word).count();
        if length == 0 {
            return Err(self.unexpected("a coordinate or }"));
        }
        self.at += length;
        Ok(self.at - length..self.at)
    }

    /// `UF : 1`, `CONFIG : 'N U T, 0, 0, 0'`.
    fn setting(
        &mut self,
        key: Range<usize>,
        within: bool,
        first: &mut Group,
        point: &mut Point,
    ) -> Result<(), Fault> {
        self.skip_blanks_in_line();
        if self.byte() == Some(b'\'') {
            let end = line_end(self.bytes, self.at);
            let inside = self.at + 1;
            let Some(length) = memchr::memchr(b'\'', &self.bytes[inside..end]) else {
                return Err(Fault::unclosed(self.at, "a string"));
            };
            self.at = inside + length + 1;
            if within {
                first.configuration(self.bytes, inside..inside + length);
            } else {
                point.has_other_arm = true;
            }
            return Ok(());
        }
        let length = self.bytes[self.at..]
            .iter()
            .take_while(|b| !matches!(b, b',' | b'}') && !b.is_ascii_whitespace())
            .count();
        let text = &self.bytes[self.at..self.at + length];
        let selected = match text {
            b"F" | b"f" | b"" => Some(None),
            stars if stars.iter().all(|&b| b == b'*') => Some(None),
            digits => number::whole(digits)
                .filter(|number| *number <= 255)
                .map(Some),
        };
        if within {
            let place = match &self.bytes[key] {
                b"UF" => Some(&mut point.frame),
                b"UT" => Some(&mut point.tool),
                _ => None,
            };
            if let Some(place) = place {
                *place = selected.ok_or(bad_value(self.at, length))?;
            }
        }
        self.at += length;
        Ok(())
    }

    /// `X =  1922.978  mm`
    fn value(
        &mut self,
        key: Range<usize>,
        group: Option<u32>,
        within: bool,
        first: &mut Group,
    ) -> Result<(), Fault> {
        let field = self.at;
        self.skip_blanks_in_line();
        let digits = self.at;
        let rest = &self.bytes[digits..];
        let part = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'+' | b'-' | b'.' | b'*');
        // a unit may follow without a blank
        let ends = |at: usize| {
            rest.get(at)
                .is_none_or(|b| matches!(b, b'm' | b'd') || !part(b))
        };
        let stars = rest.iter().take_while(|b| **b == b'*').count();
        let quick = number::parse_start(rest).filter(|(_, length)| ends(*length));
        let value = if stars > 0 && ends(stars) {
            self.at += stars;
            None
        } else if let Some((value, length)) = quick {
            self.at += length;
            Some(value)
        } else {
            let length = rest.iter().take_while(|b| part(b)).count();
            if length == 0 {
                return Err(self.unexpected("a number"));
            }
            self.at += length;
            let value = number::parse(&rest[..length]);
            Some(value.ok_or(bad_value(digits, length))?)
        };
        let (end, length) = (self.at, self.at - digits);
        if length > WIDEST_FIELD || value.is_some_and(|value| value.abs() > LARGEST) {
            return Err(bad_value(digits, length));
        }
        self.skip_blanks_in_line();
        let letters = self.bytes[self.at..]
            .iter()
            .take_while(|b| b.is_ascii_alphabetic());
        let letters = letters.count();
        let unit = &self.bytes[self.at..self.at + letters];
        self.at += letters;
        if let (Some(other), [b'J', _]) =
            (group.filter(|group| *group != 1), &self.bytes[key.clone()])
        {
            let name = format!("G{other}{}", Source::text(&self.bytes[key.clone()]));
            let unit = Source::text(unit).into();
            let value = value.unwrap_or(f64::NAN);
            first.external.push(Axis { name, value, unit });
        }
        if within {
            // the field keeps its last column where blanks stand before the number; a tab is none
            // of its
            let blanks = self.bytes[field..digits].iter().rev();
            let blanks = blanks.take_while(|&&b| b == b' ').count();
            let start = digits - blanks.min(WIDEST_FIELD);
            let length = u16::try_from(end - start).expect("two widths of a field");
            let start = short(start);
            let found = value.map(|value| Number {
                start,
                length,
                value,
            });
            first.coordinate(&self.bytes[key], found, unit);
        }
        Ok(())
    }
}

/// An axis besides the six of the arm, as it is written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    /// `E1`, or of another group as `G2J1`.
    pub name: String,
    /// Not a number where it was never taught.
    pub value: f64,
    pub unit: String,
}

/// 2 of `GP2`.
fn group_number(key: &[u8]) -> Option<u32> {
    let digits = key
        .strip_prefix(b"GP")
        .or_else(|| key.strip_prefix(b"gp"))?;
    number::whole(digits)
}

/// Group 1 of a point while it is read.
#[derive(Default)]
#[allow(clippy::struct_excessive_bools, clippy::option_option)]
struct Group {
    there: bool,
    uninitialised: bool,
    remote: bool,
    other: bool,
    /// Axes besides the six that stand somewhere: name and value, not a number where it was never
    /// taught.
    external: Vec<Axis>,
    pose: [Option<Number>; 6],
    joints: [Option<Number>; 6],
    /// The six numbers of the configuration data, or that they are not understood.
    flags: Option<Option<[Number; 6]>>,
}

impl Group {
    fn coordinate(&mut self, key: &[u8], found: Option<Number>, unit: &[u8]) {
        let (slot, wanted) = match key {
            b"X" => (&mut self.pose[0], "mm"),
            b"Y" => (&mut self.pose[1], "mm"),
            b"Z" => (&mut self.pose[2], "mm"),
            b"W" => (&mut self.pose[3], "deg"),
            b"P" => (&mut self.pose[4], "deg"),
            b"R" => (&mut self.pose[5], "deg"),
            [b'J', digit @ b'1'..=b'6'] => (&mut self.joints[usize::from(*digit - b'1')], "deg"),
            [b'R', b'X' | b'Y' | b'Z' | b'W' | b'P' | b'R'] => {
                self.remote = true;
                return;
            }
            [b'E', b'1'..=b'9'] | [b'J', b'7'..=b'9'] => {
                let value = found.map_or(f64::NAN, |number| number.value);
                let (name, unit) = (Source::text(key).into(), Source::text(unit).into());
                self.external.push(Axis { name, value, unit });
                return;
            }
            _ => {
                self.other = true;
                return;
            }
        };
        self.uninitialised |= found.is_none();
        self.other |= slot.is_some() || !unit.eq_ignore_ascii_case(wanted.as_bytes());
        *slot = found;
    }

    /// The letters and numbers between the quotes.
    fn configuration(&mut self, bytes: &[u8], inside: Range<usize>) {
        let text = &bytes[inside.clone()];
        if text.trim_ascii().is_empty() {
            return;
        }
        self.flags = Some(flags(text, inside.start));
    }

    fn finish(self, point: &mut Point, numbers: &mut Vec<Number>) {
        let start = numbers.len();
        point.external = self.external;
        let complete = |numbers: [Option<Number>; 6]| numbers.iter().all(Option::is_some);
        let trouble = if self.uninitialised {
            Some(Why::Uninitialised)
        } else if self.remote {
            Some(Why::StationaryTool)
        } else if self.other || complete(self.pose) == complete(self.joints) {
            Some(Why::Axes)
        } else if complete(self.pose) && self.flags == Some(None) {
            Some(Why::Configuration)
        } else {
            None
        };
        point.content = Some(match trouble {
            Some(trouble) => Content::Trouble(trouble),
            None if complete(self.joints) => {
                numbers.extend(self.joints.into_iter().flatten());
                Content::Joints
            }
            None => {
                numbers.extend(self.pose.into_iter().flatten());
                let configuration = self.flags.flatten();
                numbers.extend(configuration.into_iter().flatten());
                Content::Pose {
                    configured: configuration.is_some(),
                }
            }
        });
        point.numbers = start..numbers.len();
    }
}

/// The numbers of `N U T, 0, 0, 0`; `None` where the text is anything else.
fn flags(text: &[u8], start: usize) -> Option<[Number; 6]> {
    let mut found = [Number {
        start: 0,
        length: 1,
        value: 0.0,
    }; 6];
    let mut at = 0;
    for (k, number) in found.iter_mut().enumerate() {
        while matches!(text.get(at), Some(b' ' | b'\t' | b',')) {
            at += 1;
        }
        let rest = text.get(at..).filter(|rest| !rest.is_empty())?;
        let (value, length) = if let Some([zero, one]) = super::config::LETTERS.get(k) {
            let letter = rest[0];
            let value = if letter == *zero {
                0.0
            } else if letter == *one {
                1.0
            } else {
                return None;
            };
            (value, 1)
        } else {
            let sign = usize::from(matches!(rest[0], b'-' | b'+'));
            let digits = rest[sign..].iter().take_while(|b| b.is_ascii_digit());
            let length = sign + digits.take(3).count();
            (number::parse(&rest[..length])?, length)
        };
        *number = Number {
            start: short(start + at),
            length: u16::try_from(length).ok()?,
            value,
        };
        at += length;
    }
    text[at..].trim_ascii().is_empty().then_some(found)
}
