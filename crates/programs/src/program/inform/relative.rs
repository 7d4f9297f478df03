//! Jobs that may run in another user frame than their positions name: relative jobs (RJ) of
//! stations, and those to which a call gives a frame.

use super::instruction::numbered;
use super::job::{Header, Job, Origin};
use super::lines::{Line, words};
use super::variables::always;
use crate::program::Source;
use crate::program::script::{Builder, Place, Remark, VariableId, short};

/// A call that gives its job a user frame: `CALL JOB:A UF#(4)`.
#[derive(Debug)]
pub(super) struct Given<'a> {
    /// `None` where only the running program knows which job.
    job: Option<&'a [u8]>,
    /// `None` where only the running program knows which frame.
    frame: Option<u32>,
    place: Place,
}

/// Those calls of all jobs.
pub(super) fn given<'a>(jobs: &[Job], lines: &[Vec<Line<'a>>]) -> Vec<Given<'a>> {
    let mut found = Vec::new();
    for (job, lines) in jobs.iter().zip(lines) {
        for line in lines {
            let mut words = words(line.text);
            let is_call = matches!(words.next(), Some(b"CALL" | b"JUMP" | b"PSTART"));
            let name = words.next().filter(|_| is_call);
            let frame = words.find(|word| word.starts_with(b"UF#"));
            if let (Some(name), Some(frame)) = (name, frame) {
                let place = Place::new(job.file, short(line.start));
                found.push(Given {
                    job: name.strip_prefix(b"JOB:"),
                    frame: numbered(frame, b"UF#"),
                    place,
                });
            }
        }
    }
    found
}

/// The user frames that calls give to one job, and why positions in others must stay.
#[derive(Debug, Default)]
pub(super) struct Frames(Vec<(Option<u32>, VariableId)>);

impl Frames {
    /// Those of the job of a name.
    pub(super) fn of(
        builder: &mut Builder,
        sources: &[Source],
        given: &[Given],
        (name, is_relative): (&[u8], bool),
    ) -> Self {
        let mut frames: Vec<(Option<u32>, VariableId)> = Vec::new();
        for one in given {
            let is_this = one.job.map_or(is_relative, |job| job == name);
            if !is_this || frames.iter().any(|(frame, _)| *frame == one.frame) {
                continue;
            }
            let source = &sources[one.place.file as usize];
            let (line, _) = source.line_column(one.place.offset as usize);
            let which = one.frame.map_or_else(
                || "a user frame (UF#) that only the running program knows".to_owned(),
                |number| format!("user frame {number} (UF#)"),
            );
            let remark = Remark::error_about(
                "frame-assigned-at-run-time",
                format!("{} line {line} calls the job with {which}", source.name),
                "call the job without UF#, with its positions in the frame that it runs in",
            );
            frames.push((one.frame, always(builder, remark)));
        }
        Self(frames)
    }

    /// What speaks against a position below a header.
    pub(super) fn against<'s>(&'s self, header: &Header) -> impl Iterator<Item = VariableId> + 's {
        let own = match header.origin() {
            Origin::User(number) => Some(number),
            _ => None,
        };
        let others = self.0.iter();
        let others = others.filter(move |(frame, _)| frame.is_none() || *frame != own);
        others.map(|(_, reason)| *reason)
    }
}

/// Whether jobs move more than one robot: `///GROUP1 RB1` and `///GROUP1 RB2`. Jobs that are given
/// for what they declare count for nothing.
pub(super) fn are_of_several_robots(sources: &[Source], jobs: &[Job], lines: &[Vec<Line>]) -> bool {
    let is_own = |(job, _): &(&Job, _)| !sources[job.file as usize].is_context;
    let own = jobs.iter().zip(lines).filter(is_own);
    let heads = own.flat_map(|(_, lines)| lines);
    let groups = heads.filter_map(|line| line.text.strip_prefix(b"///GROUP1"));
    let robots = groups.flat_map(|group| group.split(|b| b.is_ascii_whitespace() || *b == b','));
    let mut robots = robots.filter(|word| word.starts_with(b"RB"));
    let first = robots.next();
    robots.any(|robot| Some(robot) != first)
}

/// Whether the head of a job says that it is relative: `///ATTR SC,RW,RJ`; and whether it is to a
/// station: there is a group `ST1`.
pub(super) fn is_relative(lines: &[Line]) -> (bool, bool) {
    let head = || {
        lines
            .iter()
            .filter_map(|line| line.text.strip_prefix(b"///"))
    };
    let has = |line: &[u8], is: &dyn Fn(&[u8]) -> bool| {
        let mut words = line.split(|b| b.is_ascii_whitespace() || *b == b',');
        words.any(is)
    };
    let relative = |line: &[u8]| line.starts_with(b"ATTR") && has(line, &|word| word == b"RJ");
    let station = |line: &[u8]| line.starts_with(b"GROUP") && has(line, &|w| w.starts_with(b"ST"));
    let is_relative = head().any(relative);
    (is_relative, is_relative && head().any(station))
}
