//! Statements that lead elsewhere: choices, loops, jumps, handlers.

use super::asked::Asked;
use super::errors::Handles;
use super::reader::{OpenLoop, Reader};
use super::syntax::{Counting, Expression, StatementKind};
use super::tokens::{Fault, Kind};
use crate::program::number;
use crate::program::numbers::rounds;

/// `WHILE condition DO`, whose condition calls functions.
const WHILE: StatementKind = StatementKind::Loop {
    may_pass: false,
    most: None,
};

/// Whether a word begins, parts or ends a block, or leaves one.
pub(super) fn is_block_word(word: &[u8]) -> bool {
    matches!(
        word,
        b"if"
            | b"elseif"
            | b"else"
            | b"endif"
            | b"while"
            | b"endwhile"
            | b"for"
            | b"endfor"
            | b"test"
            | b"case"
            | b"default"
            | b"endtest"
            | b"error"
            | b"undo"
            | b"backward"
            | b"goto"
            | b"return"
            | b"raise"
            | b"errraise"
            | b"raisetouser"
            | b"retry"
            | b"startmoveretry"
            | b"trynext"
            | b"exit"
            | b"exitcycle"
    )
}

impl Reader<'_> {
    /// A statement that starts with a word of blocks, the present token.
    pub(super) fn block(&mut self, start: u32, word: &[u8]) -> Result<(), Fault> {
        self.advance()?;
        match word {
            b"if" => {
                let first = self.token.start;
                let presence = self.presence()?;
                let is_block = self.condition()?;
                let asked = presence.or_else(|| self.value_asked(word, first));
                self.note(start, StatementKind::If(asked));
                self.short_ifs += u32::from(!is_block);
            }
            b"elseif" | b"case" => {
                let (first, at) = (self.token.start, self.parsed.statements.len());
                self.note(start, StatementKind::Else);
                self.condition()?;
                let asked = self.value_asked(word, first);
                self.parsed.statements[at].kind = match word {
                    b"case" => StatementKind::Case(asked),
                    _ => StatementKind::ElseIf(asked),
                };
            }
            b"else" | b"default" => {
                self.note(start, StatementKind::Else);
                if self.token.is(b':') {
                    self.advance()?;
                }
            }
            b"endif" | b"endtest" => self.note(start, StatementKind::EndChoice),
            b"while" => self.while_loop(start)?,
            b"for" => {
                let is_name = self.token.kind == Kind::Name;
                let counter = is_name.then(|| self.parsed.symbols.intern(self.text(self.token)));
                let first = self.token;
                self.condition()?;
                let (may_pass, most) = (true, self.rounds(first.start));
                let counting = counter.map(|counter| {
                    let behind = self.token.start;
                    self.parsed.loops.push(Counting {
                        counter,
                        file: self.file,
                        range: (first.start, behind),
                        inside: (behind, u32::MAX),
                        context: self.context,
                    });
                    self.parsed.loops.len() - 1
                });
                self.note(start, StatementKind::Loop { may_pass, most });
                self.loops.push(OpenLoop {
                    endless: false,
                    counting,
                });
            }
            b"endwhile" | b"endfor" => {
                let OpenLoop { endless, counting } = self.loops.pop().unwrap_or_default();
                if let Some(counting) = counting {
                    self.parsed.loops[counting].inside.1 = start;
                }
                self.note(start, StatementKind::EndLoop { endless });
            }
            b"test" => {
                let first = self.token.start;
                self.condition()?;
                let asked = self.value_asked(word, first);
                self.note(start, StatementKind::Test(asked));
            }
            b"error" | b"undo" | b"backward" => self.handler(start, word == b"error")?,
            b"goto" => {
                if self.token.kind == Kind::Name {
                    let label = self.parsed.symbols.intern(self.text(self.token));
                    self.note(start, StatementKind::Goto(label));
                }
                self.finish_statement()?;
            }
            b"return" => {
                let value = if self.token.is(b';') || self.at_statement(true) {
                    Expression::Nothing
                } else {
                    self.argument(None)?
                };
                self.end_statement()?;
                self.note(start, StatementKind::Return(value));
            }
            b"retry" | b"startmoveretry" | b"trynext" => {
                self.end_statement()?;
                let is_next = word == b"trynext";
                self.note(start, StatementKind::Retry { is_next });
            }
            b"exit" | b"exitcycle" => {
                self.end_statement()?;
                self.note(start, StatementKind::Exit);
            }
            _ => {
                if !self.token.is(b';') && !self.at_statement(true) {
                    self.finish_statement()?;
                } else {
                    self.end_statement()?;
                }
                self.note(start, StatementKind::Raise);
            }
        }
        Ok(())
    }

    /// How often `i FROM 1 TO 10 STEP 2 DO` runs: its counter cannot be written.
    fn rounds(&self, start: u32) -> Option<u32> {
        let text = &self.bytes[start as usize..self.token.start as usize];
        let words: Vec<_> = text
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty())
            .collect();
        let is = |at: usize, word: &str| {
            words
                .get(at)
                .is_some_and(|of| of.eq_ignore_ascii_case(word.as_bytes()))
        };
        let number = |at: usize| number::parse(words.get(at)?);
        let (from, to) = (number(2)?, number(4)?);
        let is_stepped = is(5, "step");
        let step = if is_stepped {
            number(6)?
        } else {
            1.0_f64.copysign(to - from)
        };
        let end = if is_stepped { 7 } else { 5 };
        let is_whole = words.len() == end || is(end, "do");
        let is_counted = is(1, "from") && is(3, "to") && is_whole;
        rounds(from, to, step).filter(|_| is_counted)
    }

    /// `WHILE condition DO`; functions in the condition are called each time round.
    fn while_loop(&mut self, start: u32) -> Result<(), Fault> {
        let forever = self.is_word(b"true");
        let at = self.parsed.statements.len();
        self.note(start, WHILE);
        let first = self.token;
        self.condition()?;
        let forever = forever
            && self.bytes[first.end as usize..]
                .trim_ascii_start()
                .get(..2)
                .is_some_and(|word| word.eq_ignore_ascii_case(b"do"));
        let calls = self.parsed.statements.len() > at + 1;
        if calls {
            self.note(start, StatementKind::If(None));
            self.note(start, StatementKind::Leave);
            self.note(start, StatementKind::EndChoice);
        } else if !forever {
            self.parsed.statements[at].kind = StatementKind::Loop {
                may_pass: true,
                most: None,
            };
        }
        self.loops.push(OpenLoop {
            endless: forever || calls,
            ..OpenLoop::default()
        });
        Ok(())
    }

    /// `ERROR`, `UNDO`, `BACKWARD`, with the numbers of errors in brackets.
    fn handler(&mut self, start: u32, is_error: bool) -> Result<(), Fault> {
        let is_listed = self.token.is(b'(');
        if is_listed {
            self.expression()?;
        }
        if let Some(routine) = self.context.routine {
            self.parsed.routines[routine as usize].has_handler = true;
        }
        let handles = match (is_error, is_listed) {
            (true, false) => Handles::Errors,
            (true, true) => Handles::SomeErrors,
            (false, _) => Handles::Other,
        };
        self.note(start, StatementKind::Handler(handles));
        Ok(())
    }

    /// The parameter that `Present(name)` or `NOT Present(name)` asks for, where that is the whole
    /// condition; nothing is passed over.
    fn presence(&mut self) -> Result<Option<Asked>, Fault> {
        let Some(routine) = self.context.routine else {
            return Ok(None);
        };
        let mark = self.mark();
        let mut asked = None;
        let wanted = !self.is_word(b"not");
        if !wanted {
            self.advance()?;
        }
        if self.is_word(b"present") {
            self.advance()?;
            if self.token.is(b'(') {
                self.advance()?;
                let name = self.token;
                if name.kind == Kind::Name {
                    self.advance()?;
                    let is_closed = self.token.is(b')');
                    self.advance()?;
                    let goes_on = [&b"and"[..], b"or", b"xor"]
                        .iter()
                        .any(|word| self.is_word(word));
                    if is_closed && self.token.kind == Kind::Name && !goes_on {
                        asked = Some((self.parsed.symbols.intern(self.text(name)), wanted));
                    }
                }
            }
        }
        self.rewind(mark);
        self.parsed
            .asked
            .extend(asked.map(|(name, _)| (routine, name)));
        Ok(asked.map(|(name, wanted)| Asked::Presence(name, wanted)))
    }

    /// `condition THEN`, `1,2:` and their like, without the statements behind; whether a word or
    /// colon ends it.
    fn condition(&mut self) -> Result<bool, Fault> {
        loop {
            self.expression()?;
            match self.token.kind {
                Kind::Sign(b',' | b'\\') | Kind::Assign => self.advance()?,
                Kind::Sign(b':') => return self.advance().map(|()| true),
                Kind::Name if self.is_word(b"then") || self.is_word(b"do") => {
                    return self.advance().map(|()| true);
                }
                _ => return Ok(false),
            }
        }
    }
}
