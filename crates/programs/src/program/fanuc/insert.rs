//! Moves between those of a program: the instruction again, to a new point below `/POS`.
//!
//! New lines have a colon and no number: controllers number the lines of a listing themselves when
//! they load it, and all other lines stay as they are.

use super::points::Points;
use super::sections::{Sections, line_end};
use crate::program::insert::{Added, Line, Repeated, line_start, sole_use, with_numbers};
use crate::program::script::Instruction;
use crate::program::{
    Inserted, Insertion, Insertions, Motion, Move, Program, Replacements, Target,
};
use std::ops::Range;

/// Most points of a program.
const MOST_POINTS: u32 = 32767;

/// The blanks, number and colon before an instruction; `None` where its line holds something else.
fn head(bytes: &[u8], offset: usize) -> Option<Range<usize>> {
    let start = line_start(bytes, offset);
    let text = bytes[start..offset].trim_ascii();
    let digits = text.strip_suffix(b":").unwrap_or(text).trim_ascii();
    let starts_alone = bytes[..start]
        .trim_ascii_end()
        .last()
        .is_none_or(|b| *b == b';' || b.is_ascii_uppercase());
    (starts_alone && digits.iter().all(u8::is_ascii_digit)).then_some(start..offset)
}

/// The points of a move as they stand in its instruction; `None` where its text does more than go
/// there.
fn points(program: &Program, index: usize) -> Option<Vec<Range<usize>>> {
    let both = match program.instructions[index].motion {
        Motion::ArcVia => index..index + 2,
        Motion::ArcEnd => index.checked_sub(1)?..index + 1,
        _ => index..index + 1,
    };
    let both = program.instructions.get(both)?;
    let is_one = |one: &Instruction| one.place == both[0].place && !one.does_more;
    let points = both.iter().map(|one| one.target_span.range());
    let points = points.collect::<Option<Vec<_>>>();
    points.filter(|_| both.iter().all(is_one))
}

/// What the copies of one move are made of.
struct Copied<'a> {
    repeated: Repeated<'a>,
    target: &'a Target,
    /// The move.
    motion: &'a Move,
    /// The text of its target below `/POS` behind the name.
    body: Range<usize>,
}

/// The text of a target with its semicolon, and its `P[3:"name"]`.
fn declared(bytes: &[u8], target: &Target) -> Option<(Range<usize>, Range<usize>)> {
    let Range { start, end } = target.span();
    let behind = bytes[end..].iter().take_while(|b| b.is_ascii_whitespace());
    let close = end + behind.count();
    let open = start + memchr::memchr(b'{', &bytes[start..end])?;
    let name = start..start + bytes[start..open].trim_ascii_end().len();
    (bytes.get(close) == Some(&b';')).then_some((start..close + 1, name))
}

/// Whether a target, its name aside, has other axes than the six of the arm.
fn has_more_axes(text: &[u8]) -> bool {
    let finds = |needle: &[u8]| memchr::memmem::find(text, needle).is_some();
    finds(b"GP2") || (1..=9).any(|axis| finds(format!("E{axis}").as_bytes()))
}

/// A number in the field of another: where blanks stand in front of that, its last column is that
/// of the field.
fn in_field(old: &[u8], new: &[u8]) -> Vec<u8> {
    let digits = new.trim_ascii_start();
    let blanks = match old.first() {
        Some(b' ') => old.len().saturating_sub(digits.len()).max(1),
        _ => 0,
    };
    let mut text = vec![b' '; blanks];
    text.extend_from_slice(digits);
    text
}

/// The text of a point with the number of another tool or user frame, whose field is called so;
/// `None` where the point has such a field and the other one no number. Fields with `F` are for any. Other
/// groups than the first have fields of their own.
fn with_frame(text: &[u8], field: &[u8], name: &str) -> Option<Vec<u8>> {
    let first = memchr::memmem::find(text, b"GP2").unwrap_or(text.len());
    let found = memchr::memmem::find_iter(&text[..first], field).find_map(|at| {
        let rest = &text[at + field.len()..];
        let colon = rest.len() - rest.trim_ascii_start().len();
        let behind = rest[colon..].strip_prefix(b":")?;
        let start = text.len() - behind.trim_ascii_start().len();
        let digits = text[start..].iter().take_while(|b| b.is_ascii_digit());
        let end = start + digits.count();
        (end > start).then_some(start..end)
    });
    let Some(own) = found else {
        return Some(text.to_vec());
    };
    let number: u32 = name.parse().ok()?;
    Some(
        [
            &text[..own.start],
            number.to_string().as_bytes(),
            &text[own.end..],
        ]
        .concat(),
    )
}

impl<'a> Copied<'a> {
    fn of(into: &Insertions<'a>, insertion: &Insertion) -> Option<Self> {
        let (source, program) = (&into.sources[into.file], into.program);
        let bytes = &source.bytes;
        let motion = sole_use(program, insertion.motion)?;
        let target = program.target_of(motion)?;
        let index = motion.instruction as usize;
        let instruction = &program.instructions[index];
        let span = instruction.span();
        let before = head(bytes, span.start)?;
        let targets = if insertion.is_split() {
            vec![instruction.target_span.range()?]
        } else {
            points(program, index)?
        };
        if target.file as usize != into.file || insertion.is_arc() != (targets.len() == 2) {
            return None;
        }
        let (held, name) = declared(bytes, target)?;
        let body = name.end..held.end;
        // of a split they stay as they are
        if !insertion.is_split() && has_more_axes(&bytes[body.clone()]) {
            return None;
        }
        // the column of the instruction stays
        let width = before.len();
        let mut head = vec![b' '; width.saturating_sub(1)];
        if bytes[before].contains(&b':') {
            head.push(b':');
        } else {
            head.resize(width, b' ');
        }
        let line = Line {
            span,
            targets,
            behind: source.line_end().to_vec(),
        };
        Some(Self {
            repeated: Repeated {
                source,
                before: head,
                lines: vec![line],
                longest: usize::MAX,
            },
            target,
            motion,
            body,
        })
    }

    /// The text of the move with new points, the first of this number.
    fn repeat(
        &self,
        program: &Program,
        insertion: &Insertion,
        first: u32,
        points: &mut Added,
    ) -> Option<Replacements> {
        let source = self.repeated.source;
        let own = program.numbers_of(self.target);
        self.repeated.insert(insertion, |_, numbers| {
            let fields = own.iter().zip(numbers);
            let fields = fields.map(|(old, new)| in_field(old.text(&source.bytes), new));
            let fields: Vec<Vec<u8>> = fields.collect();
            let body = with_numbers(&source.bytes, &self.body, own, &fields)?;
            // a copy in a register goes with what is selected at the move
            let body = with_frame(&body, b"UF", &program.frames[self.motion.frame].name)?;
            let body = with_frame(&body, b"UT", &program.tools[self.motion.tool].name)?;
            let number = first + points.count;
            if number > MOST_POINTS {
                return None;
            }
            let name = format!("P[{number}]").into_bytes();
            points.count += 1;
            points.text.extend_from_slice(&name);
            points.text.extend(body);
            points.text.extend_from_slice(source.line_end());
            Some(name)
        })
    }
}

/// The highest number of a point, and the byte behind the last one's line.
fn points_of(bytes: &[u8], sections: &Sections) -> (u32, usize) {
    let mut reader = Points::new(bytes, sections.points.start);
    let (mut highest, mut end) = (0, sections.points.start);
    while let Ok(Some(point)) = reader.next() {
        highest = highest.max(point.number);
        end = line_end(bytes, point.end as usize);
    }
    (highest, end)
}

/// See [`crate::program::Language::insert`].
pub(super) fn insert(into: &Insertions) -> Inserted {
    let bytes = &into.sources[into.file].bytes;
    let Some(sections) = Sections::of(bytes) else {
        return Inserted::none(into.list);
    };
    let (highest, behind_points) = points_of(bytes, &sections);
    let mut points = Added::default();
    let mut inserted = Inserted::each(into.list, |one| {
        let copied = Copied::of(into, one)?;
        points.attempt(|points| copied.repeat(into.program, one, highest + 1, points))
    });
    if points.count > 0 {
        let at = behind_points..behind_points;
        inserted.rest.push((at, points.text));
    }
    inserted
}

#[cfg(test)]
mod tests {
    use super::super::Fanuc;
    use super::*;
    use crate::program::{Between, Settings, Source};

    #[test]
    fn new_points_have_the_fields_of_the_old_one_whatever_its_name() {
        let text = "/PROG  T\n/MN\n1:L P[3] 9mm/sec FINE ;\n/POS\nP[3:\"TABLE1\"]{\n   GP1:\n\tUF \
            : 0, UT : 1,\n\tX =  1922.978  mm,\tY =  -163.122  mm,\tZ =   -54.328  mm,\n\tW =  \
            -179.532 deg,\tP =      .193 deg,\tR =     -.287 deg\n};\n/END\n";
        let source = Source::new("t.ls", text.as_bytes().to_vec());
        let sources = std::slice::from_ref(&source);
        let program = crate::motion::read(&Fanuc, sources, &Settings::default()).expect("read");
        let numbers = ["1600.161", "-99.500", "400.000", "180.000", ".250", "0.000"];
        let insertion = Insertion {
            motion: 0,
            between: vec![Between {
                via: None,
                end: numbers.map(|number| number.as_bytes().to_vec()).to_vec(),
            }],
            own: None,
        };
        let inserted = insert(&Insertions {
            sources,
            program: &program,
            file: 0,
            list: &[insertion],
        });
        assert!(inserted.moves[0].is_some());
        assert_eq!(
            Source::text(&inserted.rest[0].1),
            "P[4]{\n   GP1:\n\tUF : 0, UT : 1,\n\tX =  1600.161  mm,\tY =   -99.500  mm,\tZ =   \
             400.000  mm,\n\tW =   180.000 deg,\tP =      .250 deg,\tR =     0.000 deg\n};\n"
        );
    }
    #[test]
    fn a_move_that_does_more_gets_a_point_of_its_own_and_is_not_repeated() {
        let text = "/PROG  T\n/MN\n1:L P[3] 9mm/sec FINE TB .10sec,DO[1]=ON ;\n/POS\nP[3]{\n   GP1:\n\tUF : 0, UT \
            : 1,\n\tX =  1922.978  mm,\tY =  -163.122  mm,\tZ =   -54.328  mm,\n\tW =  -179.532 \
            deg,\tP =      .193 deg,\tR =     -.287 deg\n   GP2:\n\tUF : 0, UT : 1,\n\tJ1 = 1.0 \
            deg\n};\n/END\n";
        let source = Source::new("t.ls", text.as_bytes().to_vec());
        let sources = std::slice::from_ref(&source);
        let program = crate::motion::read(&Fanuc, sources, &Settings::default()).expect("read");
        let numbers = ["1600.161", "-99.500", "400.000", "180.000", ".250", "0.000"];
        let numbers = numbers.map(|number| number.as_bytes().to_vec()).to_vec();
        let insert = |between: Vec<Between>, own: Option<Vec<Vec<u8>>>| {
            let list = [Insertion {
                motion: 0,
                between,
                own,
            }];
            insert(&Insertions {
                sources,
                program: &program,
                file: 0,
                list: &list,
            })
        };
        let end = numbers.clone();
        assert_eq!(insert(vec![Between { via: None, end }], None).moves, [None]);
        let inserted = insert(Vec::new(), Some(numbers));
        let changed = inserted.moves[0].as_ref().expect("it can");
        assert_eq!(changed.len(), 1);
        assert_eq!(&text[changed[0].0.clone()], "P[3]");
        assert_eq!(Source::text(&changed[0].1), "P[4]");
        assert!(Source::text(&inserted.rest[0].1).contains("J1 = 1.0"));
    }
}
