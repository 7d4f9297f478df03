//! Reads jobs: the state machine of their header, the positions under it, and the instructions.
//!
//! `///USER`, `///TOOL`, `///POSTYPE`, `///PULSE`, `///RECTAN`, `///ANGLE` and `///RCONF` hold for all positions below them until
//! they are set anew. What a position's numbers are is told by the last of PULSE, RECTAN and ANGLE; POSTYPE tells the frame
//! of rectangular ones. (Some posts write `POSTYPE BASE` behind pulse positions.)

use super::instruction::{self, Event};
use super::lines::{Line, Lines, add_numbers, after, index, numbers, unexpected, whole, words};
use super::rconf;
use crate::program::{Number, ReadError, Source};
use memchr::memmem;
use std::collections::{HashMap, HashSet};

/// How a post names itself in `///COMM` that writes rear, lower arm, flip where flip, lower arm, rear belong.
const POST: &[u8] = b"RoboDK";

/// What the numbers of a position are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    Pulses,
    Degrees,
    Rectangular,
}

/// Where the coordinates of a position count from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Origin {
    Base,
    Robot,
    User(u32),
    /// The tool or a master tool that another robot holds.
    Tool,
    Unknown,
}

/// `C` positions belong to the job, `P` are variables of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Letter {
    C,
    P,
}

/// A position of the robot.
#[derive(Clone, Debug)]
pub struct Point {
    pub letter: Letter,
    pub number: u32,
    /// First byte of its line.
    pub offset: u32,
    pub coordinates: Coordinates,
    pub tool: Option<u32>,
    pub origin: Origin,
    /// What RCONF tells about it.
    pub variant: u8,
    /// Its numbers in [`Job::numbers`]: those of the line, external axes and elbow angles too.
    pub numbers: (u32, u32),
}

/// One job.
#[derive(Debug)]
pub struct Job<'a> {
    pub file: u32,
    /// First byte of `/JOB`.
    pub offset: u32,
    pub name: &'a [u8],
    pub points: Vec<Point>,
    pub numbers: Vec<Number>,
    /// Where they start in the numbers of the whole program.
    pub numbers_start: u32,
    /// The position that each letter and number names.
    pub named: HashMap<(Letter, u32), u32>,
    /// Positions whose name stands twice.
    pub twice: HashSet<(Letter, u32)>,
    /// Whether the base axes stand elsewhere than at zero, by the number of their `BC` position.
    pub base_moved: HashMap<u32, bool>,
    /// What the instructions do, in the order of the text.
    pub events: Vec<Event<'a>>,
    /// `C` positions that the header announces, and where.
    pub announced: Option<(u32, u32)>,
    /// It comes from a post that writes the fields of RCONF in an order of its own.
    pub mixes_rconf: bool,
}

/// What the header lines above a position say.
#[derive(Clone, Copy, Default)]
struct State<'a> {
    tool: Option<u32>,
    user: Option<u32>,
    type_: &'a [u8],
    coordinates: Option<Coordinates>,
    variant: u8,
}

impl State<'_> {
    fn coordinates(&self) -> Option<Coordinates> {
        self.coordinates.or(match self.type_ {
            b"PULSE" => Some(Coordinates::Pulses),
            b"ANGLE" => Some(Coordinates::Degrees),
            b"" => None,
            _ => Some(Coordinates::Rectangular),
        })
    }

    fn origin(&self) -> Origin {
        match (self.type_, self.user) {
            (b"BASE", _) => Origin::Base,
            (b"ROBOT", _) => Origin::Robot,
            (b"USER", Some(user)) => Origin::User(user),
            (b"TOOL" | b"MTOOL", _) => Origin::Tool,
            _ => Origin::Unknown,
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Section {
    Outside,
    Header,
    Positions,
    Instructions,
}

/// Reads the jobs of a file; `false` where it has none.
pub fn read<'a>(source: &'a Source, file: u32, jobs: &mut Vec<Job<'a>>) -> Result<bool, ReadError> {
    let first = jobs.len();
    let mut section = Section::Outside;
    let mut state = State::default();
    for line in Lines::of(&source.bytes) {
        if line.text.is_empty() || line.text[0] == b'\'' {
            continue;
        }
        if line.text == b"/JOB" {
            if section != Section::Outside {
                return Err(unclosed(source, jobs));
            }
            section = Section::Header;
            state = State::default();
            jobs.push(Job::new(file, line.start));
            continue;
        }
        let Some(job) = jobs[first..].last_mut() else {
            // text before the first job
            continue;
        };
        #[allow(
            clippy::match_same_arms,
            reason = "the order of the arms is the order of the rules"
        )]
        match (section, line.text) {
            (Section::Outside, _) => {}
            (Section::Instructions, b"END") => section = Section::Outside,
            (Section::Instructions, [b'/', b'/', b'/', text @ ..]) => {
                job.mixes_rconf |= text.starts_with(b"COMM") && memmem::find(text, POST).is_some();
            }
            (Section::Instructions, [b'/', ..]) => {}
            (Section::Instructions, _) => instruction::read(line, &mut job.events),
            (_, [b'/', b'/', b'/', b'/', ..]) => {}
            (Section::Positions, [b'/', b'/', b'/', text @ ..]) => {
                state = state.after(text, job, line, source)?;
            }
            (Section::Header, [b'/', b'/', b'/', ..]) => {}
            (_, [b'/', b'/', text @ ..]) => {
                section = match words(text).next() {
                    Some(b"POS") => Section::Positions,
                    Some(b"INST") => Section::Instructions,
                    _ => Section::Header,
                };
                if let Some(name) = after(text, b"NAME") {
                    job.name = name;
                }
            }
            (Section::Positions, _) => job.position(&state, line, source)?,
            (Section::Header, _) => {}
        }
    }
    if section != Section::Outside {
        return Err(unclosed(source, jobs));
    }
    Ok(jobs.len() > first)
}

/// The last job has no end.
fn unclosed(source: &Source, jobs: &[Job]) -> ReadError {
    let at = jobs.last().map_or(0, |job| job.offset);
    let (line, column) = source.line_column(at as usize);
    ReadError::Unclosed {
        file: source.name.clone(),
        line,
        column,
        what: "a job (its END is missing)",
    }
}

impl<'a> State<'a> {
    /// The state below a `///` line.
    fn after(
        mut self,
        text: &'a [u8],
        job: &mut Job,
        line: Line,
        source: &Source,
    ) -> Result<Self, ReadError> {
        let mut parts = words(text);
        let (key, value) = (parts.next().unwrap_or_default(), parts.next());
        let number = || {
            value.and_then(whole).ok_or_else(|| {
                unexpected(
                    source,
                    line.start,
                    line.text,
                    "the number of a tool or frame",
                )
            })
        };
        match key {
            b"TOOL" => self.tool = Some(number()?),
            b"USER" => self.user = Some(number()?),
            b"POSTYPE" => self.type_ = value.unwrap_or_default(),
            b"PULSE" => self.coordinates = Some(Coordinates::Pulses),
            b"ANGLE" => self.coordinates = Some(Coordinates::Degrees),
            b"RECTAN" => self.coordinates = Some(Coordinates::Rectangular),
            b"RCONF" => self.variant = rconf::variant(&text[key.len()..]),
            b"NPOS" => {
                let count = value.and_then(|v| v.split(|&b| b == b',').next());
                job.announced = count
                    .and_then(whole)
                    .map(|count| (count, index(line.start)));
            }
            _ => {}
        }
        Ok(self)
    }
}

impl Job<'_> {
    fn new(file: u32, start: usize) -> Self {
        Self {
            file,
            offset: index(start),
            name: b"",
            points: Vec::new(),
            numbers: Vec::new(),
            numbers_start: 0,
            named: HashMap::new(),
            twice: HashSet::new(),
            base_moved: HashMap::new(),
            events: Vec::new(),
            announced: None,
            mixes_rconf: false,
        }
    }

    /// `C00012=1,2,3,...`
    fn position(&mut self, state: &State, line: Line, source: &Source) -> Result<(), ReadError> {
        let wrong = |expected| unexpected(source, line.start, line.text, expected);
        let Some(equals) = memchr::memchr(b'=', line.text) else {
            return Err(wrong("a position such as C00001=1,2,3,4,5,6"));
        };
        let name = line.text[..equals].trim_ascii_end();
        let letters = name.iter().take_while(|b| b.is_ascii_alphabetic()).count();
        let (from, to) = (line.start + equals + 1, line.start + line.text.len());
        let letter = match &name[..letters] {
            b"C" => Letter::C,
            b"P" => Letter::P,
            b"BC" => {
                let number = whole(&name[letters..]).ok_or_else(|| wrong("a BC position"))?;
                let moved = numbers(source, from, to)?.iter().any(|n| n.value != 0.0);
                self.base_moved.insert(number, moved);
                return Ok(());
            }
            // stations, and variables for base and station
            _ => return Ok(()),
        };
        let number = whole(&name[letters..]).ok_or_else(|| wrong("the number of a position"))?;
        let coordinates = state
            .coordinates()
            .ok_or_else(|| wrong("///PULSE, ///RECTAN or ///ANGLE before the first position"))?;
        let start = self.numbers.len();
        add_numbers(source, from, to, &mut self.numbers)?;
        if coordinates == Coordinates::Rectangular && self.numbers.len() - start < 6 {
            return Err(wrong("x, y, z, Rx, Ry and Rz"));
        }
        let place = index(self.points.len());
        if self.named.insert((letter, number), place).is_some() {
            self.twice.insert((letter, number));
        }
        self.points.push(Point {
            letter,
            number,
            offset: index(line.start),
            coordinates,
            tool: state.tool,
            origin: state.origin(),
            variant: state.variant,
            numbers: (index(start), index(self.numbers.len())),
        });
        Ok(())
    }
}
