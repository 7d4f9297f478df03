//! Reads the positions of jobs: the state machine of their header, and the positions under it.
//!
//! `///USER`, `///TOOL`, `///POSTYPE`, `///PULSE`, `///RECTAN`, `///ANGLE` and `///RCONF` hold for
//! all positions below them until they are set anew. What a position's numbers are is stated by the
//! last of PULSE, RECTAN and ANGLE; POSTYPE tells the frame of rectangular ones. (Some posts write
//! `POSTYPE BASE` behind pulse positions.)

use super::lines::{Line, Lines, add_numbers, after, other_than_moves, unexpected, words};
use super::{DEGREES, PULSES, rconf};
use crate::geometry::Pose;
use crate::program::kit::Fault;
use crate::program::script::{Place, Span, short};
use crate::program::{Layout, Number, ReadError, Shape, Source, Target, TargetId, number};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
use memchr::memmem;
use std::ops::Range;

/// How a post names itself in `///COMM` that writes rear, lower arm, flip where flip, lower arm,
/// rear belong.
const POST: &[u8] = b"RoboDK";

/// Bytes of a position's line at least: its name and six numbers.
const SHORTEST_POSITION: usize = 16;

/// What the numbers of a position are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coordinates {
    Pulses,
    Degrees,
    Rectangular,
}

/// Where the coordinates of a position count from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Origin {
    Base,
    Robot,
    User(u32),
    /// The tool or a master tool that another robot holds.
    Tool,
    Unknown,
}

/// `C` positions belong to the job, `P` are variables of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Letter {
    C,
    P,
}

/// A name such as `BC00001`, `BP001`, `EC00001` or `EX001`: a position of the base or of a station.
pub(super) type External = ([u8; 2], u32);

/// The position of other axes that a name means; `None` where only the running program knows.
pub(super) fn external(name: &[u8]) -> Option<External> {
    let (letters, digits) = name.split_first_chunk()?;
    let is_known = matches!(letters, b"BC" | b"BP" | b"EC" | b"EX");
    number::whole(digits)
        .filter(|_| is_known)
        .map(|number| (*letters, number))
}

/// Where the axes of the base or of a station stand.
#[derive(Debug, Clone)]
pub(super) struct Moved {
    /// What the numbers are.
    pub coordinates: Option<Coordinates>,
    /// One for each axis; not a number where the text is none.
    pub values: Vec<f64>,
}

/// Header lines that hold for the positions below them, in the order in which jobs have them.
pub(super) const HEADERS: usize = 5;

/// Which of those a header line is.
fn header_line(key: &[u8]) -> Option<usize> {
    match key {
        b"USER" => Some(0),
        b"TOOL" => Some(1),
        b"POSTYPE" => Some(2),
        b"PULSE" | b"RECTAN" | b"ANGLE" => Some(3),
        b"RCONF" => Some(4),
        _ => None,
    }
}

/// What the header lines above a position say.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Header<'a> {
    pub tool: Option<u32>,
    user: Option<u32>,
    type_: &'a [u8],
    stated: Option<Coordinates>,
    /// What RCONF tells.
    pub variant: u8,
    /// The lines themselves.
    pub lines: [Option<&'a [u8]>; HEADERS],
}

impl<'a> Header<'a> {
    pub(super) fn coordinates(&self) -> Option<Coordinates> {
        self.stated.or(match self.type_ {
            b"PULSE" => Some(Coordinates::Pulses),
            b"ANGLE" => Some(Coordinates::Degrees),
            b"" => None,
            _ => Some(Coordinates::Rectangular),
        })
    }

    /// Where rectangular coordinates count from; joints count from nowhere.
    pub(super) fn origin(&self) -> Origin {
        if self.coordinates() != Some(Coordinates::Rectangular) {
            return Origin::Base;
        }
        match (self.type_, self.user) {
            (b"BASE", _) => Origin::Base,
            (b"ROBOT", _) => Origin::Robot,
            (b"USER", Some(user)) => Origin::User(user),
            (b"TOOL" | b"MTOOL", _) => Origin::Tool,
            _ => Origin::Unknown,
        }
    }

    /// Whether positions below both have the same meaning.
    pub(super) fn means_the_same(&self, other: &Self) -> bool {
        let of = |header: &Self| {
            let coordinates = header.coordinates();
            (coordinates, header.tool, header.origin(), header.variant)
        };
        of(self) == of(other)
    }

    /// The state below a `///` line.
    fn after(mut self, text: &'a [u8], line: Line<'a>, source: &Source) -> Result<Self, ReadError> {
        let mut parts = words(text);
        let (key, value) = (parts.next().unwrap_or_default(), parts.next());
        let Some(which) = header_line(key) else {
            return Ok(self);
        };
        let number = || {
            value.and_then(number::whole).ok_or_else(|| {
                let expected = "the number of a tool or frame";
                unexpected(source, line.start, line.text, expected)
            })
        };
        match key {
            b"TOOL" => self.tool = Some(number()?),
            b"USER" => self.user = Some(number()?),
            b"POSTYPE" => self.type_ = value.unwrap_or_default(),
            b"PULSE" => self.stated = Some(Coordinates::Pulses),
            b"ANGLE" => self.stated = Some(Coordinates::Degrees),
            b"RECTAN" => self.stated = Some(Coordinates::Rectangular),
            _ => self.variant = rconf::variant(&text[key.len()..]),
        }
        self.lines[which] = Some(line.text);
        Ok(self)
    }
}

/// What is known of a target besides its numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub letter: Letter,
    pub number: u32,
    /// Index in [`Positions::headers`].
    pub header: u32,
}

/// One job.
#[derive(Debug)]
pub(super) struct Job<'a> {
    pub file: u32,
    /// First byte of `/JOB`.
    pub offset: u32,
    pub name: &'a [u8],
    /// Its positions.
    pub targets: Range<TargetId>,
    /// The position that each letter and number names.
    pub named: HashMap<(Letter, u32), TargetId>,
    /// Positions whose name stands twice.
    pub twice: HashSet<(Letter, u32)>,
    pub external: HashMap<External, Moved>,
    /// First byte of the last position, of whatever axes.
    pub last_position: u32,
    /// `C` positions that the header announces, and where.
    pub announced: Option<(u32, Span)>,
    /// Its instructions, up to END.
    pub instructions: Range<usize>,
    /// It comes from a post that writes the fields of RCONF in an order of its own.
    pub mixes_rconf: bool,
}

impl Job<'_> {
    fn new(file: u32, start: usize, targets: TargetId) -> Self {
        Self {
            file,
            offset: short(start),
            name: b"",
            targets: targets..targets,
            named: HashMap::new(),
            twice: HashSet::new(),
            external: HashMap::new(),
            last_position: 0,
            announced: None,
            instructions: 0..0,
            mixes_rconf: false,
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

/// The jobs of files and their positions, each of which is a target.
#[derive(Debug, Default)]
pub(super) struct Positions<'a> {
    pub jobs: Vec<Job<'a>>,
    pub targets: Vec<Target>,
    /// Of each target.
    pub points: Vec<Point>,
    pub numbers: Vec<Number>,
    pub headers: Vec<Header<'a>>,
    /// Whether the profile tells the pulses of a degree.
    pub pulses_known: bool,
    /// Where ROBOT coordinates are with every axis of a track at zero; at the origin of BASE ones
    /// where there are no external axes.
    pub world_from_robot: Option<Pose>,
}

impl<'a> Positions<'a> {
    /// What the header above a target says.
    pub(super) fn header(&self, target: TargetId) -> &Header<'a> {
        &self.headers[self.points[target].header as usize]
    }

    /// The lines of each job's instructions but for plain moves to `C` positions.
    pub(super) fn other_lines(&self, sources: &'a [Source]) -> Vec<Vec<Line<'a>>> {
        let of = |job: &Job| {
            let bytes = &sources[job.file as usize].bytes;
            other_than_moves(bytes, job.instructions.clone()).collect()
        };
        self.jobs.iter().map(of).collect()
    }

    /// Adds the jobs of a file; `false` where it has none.
    pub(super) fn read(&mut self, source: &'a Source, file: u32) -> Result<bool, ReadError> {
        let first = self.jobs.len();
        let mut section = Section::Outside;
        for line in Lines::of(&source.bytes) {
            if line.text.is_empty() || line.text[0] == b'\'' {
                continue;
            }
            if line.text == b"/JOB" {
                if section != Section::Outside {
                    return Err(self.unclosed(source));
                }
                section = Section::Header;
                self.headers.push(Header::default());
                let job = Job::new(file, line.start, self.targets.len());
                self.jobs.push(job);
                continue;
            }
            let Some(job) = self.jobs[first..].last_mut() else {
                // text before the first job
                continue;
            };
            section = match (section, line.text) {
                (Section::Instructions, b"END") => {
                    job.instructions.end = line.start;
                    self.end_job();
                    Section::Outside
                }
                (Section::Instructions, [b'/', b'/', b'/', text @ ..]) => {
                    job.mixes_rconf |=
                        text.starts_with(b"COMM") && memmem::find(text, POST).is_some();
                    section
                }
                (Section::Outside | Section::Instructions, _)
                | (_, [b'/', b'/', b'/', b'/', ..])
                | (Section::Header, [b'/', b'/', b'/', ..]) => section,
                (Section::Positions, [b'/', b'/', b'/', text @ ..]) => {
                    self.header_line(text, line, source)?;
                    section
                }
                (_, [b'/', b'/', text @ ..]) => {
                    if let Some(name) = after(text, b"NAME") {
                        job.name = name;
                    }
                    match words(text).next() {
                        Some(b"POS") => Section::Positions,
                        Some(b"INST") => {
                            job.instructions.start = line.start + line.text.len();
                            Section::Instructions
                        }
                        _ => Section::Header,
                    }
                }
                (Section::Positions, _) => {
                    self.position(line, source)?;
                    section
                }
                (Section::Header, _) => section,
            };
        }
        if section != Section::Outside {
            return Err(self.unclosed(source));
        }
        Ok(self.jobs.len() > first)
    }

    /// The last job has no end.
    fn unclosed(&self, source: &Source) -> ReadError {
        let at = self.jobs.last().map_or(0, |job| job.offset);
        Fault::unclosed(at as usize, "a job (its END is missing)").in_source(source)
    }

    /// What can be said once the whole job is known.
    fn end_job(&mut self) {
        let job = self.jobs.last_mut().expect("a job ends");
        job.targets.end = self.targets.len();
        if job.mixes_rconf {
            for target in &mut self.targets[job.targets.clone()] {
                if target.layout.shape == Shape::Pose {
                    target.layout.variant = 0;
                }
            }
        }
    }

    fn header_line(
        &mut self,
        text: &'a [u8],
        line: Line<'a>,
        source: &Source,
    ) -> Result<(), ReadError> {
        let job = self.jobs.last_mut().expect("the header is that of a job");
        if let Some(counts) = after(text, b"NPOS") {
            let first = counts.split(|&b| b == b',' || b == b' ').next();
            let first = first.unwrap_or_default();
            let at = line.start + line.text.len() - counts.len();
            let span = Span::of(at..at + first.len());
            job.announced = number::whole(first).map(|count| (count, span));
            // no more than the file can hold
            let most = source.bytes.len() / SHORTEST_POSITION;
            let announced = job.announced.map_or(0, |(count, _)| count as usize);
            job.named.reserve(announced.min(most));
            return Ok(());
        }
        let present = self.headers.pop().expect("a job begins with a header");
        let changed = present.after(text, line, source)?;
        let used = self.points.last().map(|point| point.header as usize);
        if used == Some(self.headers.len()) {
            self.headers.push(present);
        }
        self.headers.push(changed);
        Ok(())
    }

    /// `C00012=1,2,3,...`
    fn position(&mut self, line: Line, source: &Source) -> Result<(), ReadError> {
        let job = self.jobs.last_mut().expect("the position is that of a job");
        let wrong = |expected| unexpected(source, line.start, line.text, expected);
        let Some(equals) = memchr::memchr(b'=', line.text) else {
            return Err(wrong("a position such as C00001=1,2,3,4,5,6"));
        };
        job.last_position = short(line.start);
        let name = line.text[..equals].trim_ascii_end();
        let (letter, digits) = match name {
            [b'C', digits @ ..] => (Letter::C, digits),
            [b'P', digits @ ..] => (Letter::P, digits),
            _ => {
                if let Some(external) = external(name) {
                    let coordinates = self.headers.last().and_then(Header::coordinates);
                    let values = moved(&line.text[equals + 1..]);
                    let moved = Moved {
                        coordinates,
                        values,
                    };
                    job.external.insert(external, moved);
                }
                return Ok(());
            }
        };
        let number = number::whole(digits).ok_or_else(|| wrong("the number of a position"))?;
        let header = self.headers.last().expect("a job begins with a header");
        let coordinates = header
            .coordinates()
            .ok_or_else(|| wrong("///PULSE, ///RECTAN or ///ANGLE before the first position"))?;
        let start = self.numbers.len();
        let (from, to) = (line.start + equals + 1, line.start + line.text.len());
        add_numbers(source, from, to, &mut self.numbers)?;
        let count = self.numbers.len() - start;
        let (layout, has_six) = match coordinates {
            Coordinates::Rectangular if count < 6 => {
                return Err(wrong("x, y, z, Rx, Ry and Rz"));
            }
            Coordinates::Rectangular if count > 7 => {
                return Err(wrong(
                    "x, y, z, Rx, Ry and Rz, of a seven-axis arm Re, with decimal points",
                ));
            }
            // Re that is not zero is the elbow angle of a seven-axis arm; a number without a point among
            // seven may be one half of a number with a decimal comma
            Coordinates::Rectangular => {
                let has_point = |number: &Number| {
                    let at = number.start as usize;
                    source.bytes[at..at + usize::from(number.length)].contains(&b'.')
                };
                let numbers = &self.numbers[start..];
                let is_zero = || numbers[6].value == 0.0 && numbers.iter().all(has_point);
                ((Shape::Pose, header.variant), count == 6 || is_zero())
            }
            Coordinates::Pulses => ((Shape::Joints, PULSES), count == 6 && self.pulses_known),
            Coordinates::Degrees => ((Shape::Joints, DEGREES), count == 6),
        };
        let target = self.targets.len();
        if job.named.insert((letter, number), target).is_some() {
            job.twice.insert((letter, number));
        }
        let (width, first) = match letter {
            Letter::C => (5, 'C'),
            Letter::P => (3, 'P'),
        };
        // mostly it stands there as it is shown
        let is_shown = digits.len() == width || digits.len() > width && digits[0] != b'0';
        let name: Box<str> = if is_shown {
            Source::text(name).into()
        } else {
            format!("{first}{number:0width$}").into()
        };
        let numbers = short(start);
        let place = Place::new(job.file, short(line.start));
        let (shape, variant) = layout;
        let layout = Layout { shape, variant };
        self.targets.push(Target {
            name: Some(name),
            numbers: numbers..numbers + if has_six { 6 } else { 0 },
            blocked: !has_six,
            ..Target::new(place, short(to), layout)
        });
        self.points.push(Point {
            letter,
            number,
            header: short(self.headers.len() - 1),
        });
        Ok(())
    }
}

/// Where each axis stands; one that is no number stands nowhere.
fn moved(text: &[u8]) -> Vec<f64> {
    let values = text.split(|&b| b == b',').map(<[u8]>::trim_ascii);
    values
        .map(|text| number::parse(text).unwrap_or(f64::NAN))
        .collect()
}
