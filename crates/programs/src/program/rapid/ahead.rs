//! Parts of a long text that are read side by side, ahead of their turn.
//!
//! A long program is calls of moves, one behind the other. A part that begins behind a semicolon at
//! the end of a line is read on its own, up to the first statement that is more than a call. When
//! the reader comes to a statement at its first word, what was read is put behind what stands
//! before it: every list is then as if the part had been read in its turn. Where the reader does not
//! come to it so (the semicolon ended a comment), the part is read again.

use super::reader::{KEYWORD, Reader, keyword};
use super::syntax::{
    Argument, Base, Called, Callee, Expression, Lengths, Parsed, Statement, StatementKind,
};
use super::tokens::Kind;
use super::verbs::Verbs;
use crate::program::names::Symbol;
use crate::program::script::short;
use crate::program::{Source, Target};
use rayon::prelude::*;
use std::ops::Range;

/// Bytes of a part, at least.
#[cfg(not(test))]
const SHORTEST: usize = 256 << 10;
#[cfg(test)]
const SHORTEST: usize = 64;

/// A part that was read.
pub(super) struct Part {
    /// Its first token.
    pub first: u32,
    /// Behind the semicolon of its last statement.
    pub end: usize,
    /// An instruction of the language was seen.
    pub recognised: bool,
    parsed: Parsed,
    verbs: Verbs,
    /// So many names are in it.
    names: usize,
}

/// What was read up to a statement that is more than a call.
#[derive(Clone, Copy)]
struct Read {
    end: u32,
    lengths: Lengths,
    arguments: usize,
    names: usize,
    recognised: bool,
}

/// The bytes of parts that may be read ahead, one for each processor but the first, which reads
/// what stands before them.
pub(super) fn parts(bytes: &[u8]) -> Vec<Range<usize>> {
    let count = rayon::current_num_threads().min(bytes.len() / SHORTEST);
    let mut starts: Vec<usize> = (1..count)
        .filter_map(|at| {
            let from = bytes.len() / count * at;
            let ends = memchr::memchr_iter(b'\n', &bytes[from..]).map(|at| from + at);
            let mut ends = ends.take(64);
            let end = ends.find(|&end| bytes[..end].trim_ascii_end().ends_with(b";"))?;
            Some(end + 1)
        })
        .collect();
    starts.dedup();
    let ends = starts.iter().skip(1).copied().chain([bytes.len()]);
    starts
        .iter()
        .copied()
        .zip(ends)
        .map(|(a, b)| a..b)
        .collect()
}

/// Reads parts side by side.
pub(super) fn read(source: &Source, file: u32, parts: &[Range<usize>]) -> Vec<Option<Part>> {
    let one = |part: &Range<usize>| {
        let (mut parsed, mut verbs) = (Parsed::default(), Verbs::default());
        parsed.reserve(part.len());
        let mut reader = Reader::at(source, file, part.start, &mut parsed, &mut verbs);
        let first = reader.advance().ok().map(|()| reader.token.start)?;
        let read = reader.calls_up_to(part.end)?;
        let mut part = Part {
            first,
            end: read.end as usize,
            recognised: read.recognised,
            names: read.names,
            parsed,
            verbs,
        };
        part.parsed.shorten(read.lengths);
        part.parsed.arguments.truncate(read.arguments);
        Some(part)
    };
    parts.par_iter().map(one).collect()
}

impl Reader<'_> {
    /// Reads calls, to an end or to the first other statement; nothing where that is the first.
    fn calls_up_to(&mut self, end: usize) -> Option<Read> {
        let mut read = None;
        let mut noted = 0;
        while self.token.kind == Kind::Name && (self.token.start as usize) < end {
            let mut buffer = [0; KEYWORD];
            let is_call = !Self::is_keyword(keyword(self.text(self.token), &mut buffer))
                && self.assignment_or_call().is_ok()
                && self.parsed.statements[noted..].iter().all(is_call)
                && self.parsed.has_calls_alone()
                && !self.verbs.has_functions()
                && self.bytes[..self.behind as usize].ends_with(b";");
            if !is_call {
                break;
            }
            noted = self.parsed.statements.len();
            read = Some(Read {
                end: self.behind,
                lengths: self.parsed.lengths(),
                arguments: self.parsed.arguments.len(),
                names: self.parsed.symbols.count(),
                recognised: self.recognised,
            });
        }
        read
    }

    /// Goes on behind a part that was read ahead.
    pub(super) fn take(&mut self, part: &Part) {
        let of = &part.parsed;
        let symbols: Vec<Symbol> = (0..short(part.names))
            .map(|at| {
                let spelling = of.symbols.spelling(Symbol(at)).as_bytes();
                let symbol = self.parsed.symbols.intern(spelling);
                if part.verbs.has_met(Symbol(at)) {
                    self.verbs.of(symbol, spelling, self.context.module);
                }
                symbol
            })
            .collect();
        let meant = |name: Symbol| symbols[name.0 as usize];
        let to = &mut *self.parsed;
        let [targets, numbers, mentions, arguments] = [
            to.targets.len(),
            to.numbers.len(),
            to.mentions.len(),
            to.arguments.len(),
        ];
        let behind = |(from, end): (u32, u32), before: usize| {
            let before = short(before);
            (from + before, end + before)
        };
        let expression = |expression: Expression| match expression {
            Expression::Point { base, steps } => Expression::Point {
                base: match base {
                    Base::Named { name, index } => Base::Named {
                        name: meant(name),
                        index,
                    },
                    Base::Target(target) => Base::Target(target + short(targets)),
                    base @ Base::Function(_) => base,
                },
                steps: behind(steps, to.steps.len()),
            },
            Expression::Member { name, index } => Expression::Member {
                name: meant(name),
                index,
            },
            Expression::Computed(names) => Expression::Computed(behind(names, mentions)),
            other => other,
        };
        to.arguments
            .extend(of.arguments.iter().map(|argument| Argument {
                option: argument.option.map(meant),
                expression: expression(argument.expression),
                span: argument.span,
            }));
        to.mentions
            .extend(of.mentions.iter().map(|&name| meant(name)));
        to.numbers.extend_from_slice(&of.numbers);
        to.targets.extend(of.targets.iter().map(|target| {
            let (start, end) = behind((target.numbers.start, target.numbers.end), numbers);
            Target {
                numbers: start..end,
                ..target.clone()
            }
        }));
        let external = of.external.iter();
        to.external
            .extend(external.map(|&(target, axis, value)| (target + targets, axis, value)));
        to.external_zeros.extend_from_slice(&of.external_zeros);
        to.statements.extend(of.statements.iter().map(|statement| {
            let kind = match statement.kind {
                StatementKind::Call(called) => StatementKind::Call(Called {
                    callee: match called.callee {
                        Callee::Named(name) => Callee::Named(meant(name)),
                        other => other,
                    },
                    arguments: behind(called.arguments, arguments),
                    ..called
                }),
                other => other,
            };
            Statement { kind, ..*statement }
        }));
        self.recognised |= part.recognised;
    }
}

/// Whether it is part of a call: see [`Reader::take`].
fn is_call(statement: &Statement) -> bool {
    matches!(
        statement.kind,
        StatementKind::Call(_) | StatementKind::If(None) | StatementKind::EndChoice
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Every list that a text gives, read with parts ahead or without.
    fn lists(text: &str, parts: &[Range<usize>]) -> String {
        let source = Source::new("a.mod", text.as_bytes().to_vec());
        let (mut parsed, mut verbs) = (Parsed::default(), Verbs::default());
        let read = Reader::read_with(&source, 0, parts, &mut parsed, &mut verbs);
        let names: Vec<&str> = (0..short(parsed.symbols.count()))
            .map(|at| parsed.symbols.spelling(Symbol(at)))
            .collect();
        let met: Vec<bool> = (0..short(names.len()))
            .map(|at| verbs.has_met(Symbol(at)))
            .collect();
        format!(
            "{read:?} {names:?} {met:?} {:?}",
            (
                (&parsed.statements, &parsed.arguments, &parsed.mentions),
                (&parsed.targets, &parsed.numbers, &parsed.external),
                (&parsed.external_zeros, &parsed.steps, &parsed.data),
                (&parsed.functions, &parsed.composed, &parsed.leaves),
            )
        )
    }

    /// Behind every line that ends in a semicolon a part begins.
    fn all_parts(text: &str) -> Vec<Range<usize>> {
        let starts: Vec<usize> = (0..text.len())
            .filter(|&at| at > 0 && text[..at].ends_with(";\n"))
            .collect();
        let ends = starts.iter().skip(1).copied().chain([text.len()]);
        starts
            .iter()
            .copied()
            .zip(ends)
            .map(|(a, b)| a..b)
            .collect()
    }

    const LINES: [&str; 22] = [
        "MoveL [[400,0,300],[0,0,1,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],v100,z1,t1;",
        "MoveL [[400,0,300],[0,0,1,0],[0,0,0,0],[12,9E+09,0,9E+09,9E+09,9E+09]],v1,z1,t2\\WObj:=w1;",
        "MoveL [[400,0,300],[0,0,2,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],v100,z1,t1;",
        "MoveJ p10,v100,fine,t1;",
        "MoveJ Offs(p10,1,2,3),v100,fine,t1;",
        "MoveC p20,P10,v100\\V:=5,z1,t1\\WObj:=w2;",
        "MoveL p{3},v100,z1,t1;",
        "MoveLSync p1,v5,z1,t1,\"later\";",
        "SetDO do1,1;",
        "WaitDI di1,1\\MaxTime:=3\\TimeFlag:=late;",
        "own p10,\\On;",
        "reg1:=reg1+1;",
        "again:",
        "IF reg1>3 MoveL p1,v5,z1,t1;",
        "IF reg1>3",
        "  reset;",
        "ENDIF",
        "MoveL p30, ! not the end;",
        "  v100,z1,t1;",
        "TPWrite \"a ; b\";",
        "ConfL\\Off;",
        "p10.trans.x:=Abs(reg1);",
    ];

    proptest! {
        #[test]
        fn parts_read_ahead_give_the_same_lists(lines in prop::collection::vec(0..LINES.len(), 1..40)) {
            let body: String = lines.iter().map(|&at| format!("{}\n", LINES[at])).collect();
            let text = format!("MODULE m\nPROC main()\n{body}ENDPROC\nENDMODULE\n");
            prop_assert_eq!(lists(&text, &all_parts(&text)), lists(&text, &[]));
        }
    }

    #[test]
    fn a_long_text_has_parts() {
        let text = format!(
            "PROC m()\n{}ENDPROC\n",
            "MoveJ p10,v100,fine,t1;\n".repeat(100)
        );
        let found = parts(text.as_bytes());
        assert_eq!(
            found.len(),
            rayon::current_num_threads().min(text.len() / SHORTEST) - 1
        );
        for part in &found {
            assert!(text[..part.start].ends_with(";\n"), "{part:?}");
        }
    }
}
