//! Values: literals, names, calls, and what is between brackets.

use super::literals::{self, Found};
use super::reader::{Read, Reader};
use super::syntax::{Content, Event, Expr, ExprId, Literal, index};
use super::tokens::{Kind, Token};
use super::verbs::{self, Verb};
use crate::program::{ReadError, Source};

/// Those calls inside each other whose values are looked into.
const MOST_LOOKED_INTO: u32 = 8;
/// The value of everything that is not looked into.
pub(super) const OTHER: ExprId = 0;

impl Reader<'_> {
    /// One token of an expression; a call with its arguments, a bracket with what is in it.
    pub(super) fn part(&mut self, token: Token) -> Read<()> {
        match token.kind {
            Kind::Word if self.scanner.peek().is(b'(') && !verbs::is_operator(self.text(token)) => {
                self.call(token)
            }
            Kind::Sign(b'(' | b'[') => self.brackets(token),
            Kind::Sign(b')' | b']') => Err(self.unexpected(token, "an opening bracket before")),
            _ => Ok(()),
        }
    }

    /// To the bracket that closes `open`.
    pub(super) fn brackets(&mut self, open: Token) -> Read<()> {
        self.elements(open).map(|_| ())
    }

    /// To the bracket that closes `open`; how many elements are between its commas. Calls are noted on the way.
    pub(super) fn elements(&mut self, open: Token) -> Read<u32> {
        let mut waiting: Vec<(u8, usize)> = vec![(closing(open.kind), open.start)];
        let mut elements = 1;
        loop {
            let token = self.next()?;
            match token.kind {
                Kind::Sign(byte @ (b')' | b']')) => {
                    let (wanted, _) = waiting.pop().expect("one is open");
                    if byte != wanted {
                        let expected = if wanted == b')' { "`)`" } else { "`]`" };
                        return Err(self.unexpected(token, expected));
                    }
                    if waiting.is_empty() {
                        return Ok(elements);
                    }
                }
                Kind::Sign(b'(' | b'[') => waiting.push((closing(token.kind), token.start)),
                Kind::Sign(b',') if waiting.len() == 1 => elements += 1,
                Kind::Word => {
                    let text = self.text(token);
                    let called = self.scanner.peek().is(b'(');
                    if called && !verbs::is_operator(text) {
                        match verbs::verb(text) {
                            Verb::Other => {
                                let symbol = self.notes.symbol(text);
                                self.event(Event::Call(symbol));
                            }
                            Verb::Known => {}
                            Verb::Odd(oddity) => {
                                self.notes.oddities.push((oddity, index(token.start)));
                            }
                            _ => self.call(token)?,
                        }
                    } else if verbs::starts_block(text) {
                        return Err(self.unclosed(open.start, "a bracket"));
                    }
                }
                Kind::End => {
                    return Err(self.unclosed(waiting[0].1, "a bracket"));
                }
                _ => {}
            }
        }
    }

    /// The value up to the end of the statement; what does not fit is [`Expr::Other`].
    pub(super) fn value(&mut self, statement: usize) -> Read<ExprId> {
        let value = self.operand(Some(statement))?;
        let next = self.scanner.peek();
        let ends = matches!(next.kind, Kind::Line | Kind::End)
            || next.kind == Kind::Word && verbs::starts_statement(self.text(next));
        if ends {
            return Ok(value);
        }
        let first = self.next()?;
        self.mention(value, statement);
        self.mentions_of(first, statement)?;
        Ok(OTHER)
    }

    fn mention(&mut self, value: ExprId, statement: usize) {
        if let Expr::Name(name) = self.notes.expression(value) {
            let entry = (name, self.function, index(statement));
            self.notes.mentions.push(entry);
        }
    }

    /// The rest of a statement whose value is computed: the names in it are noted.
    fn mentions_of(&mut self, first: Token, statement: usize) -> Read<()> {
        let mut token = first;
        loop {
            if token.kind == Kind::Word && !self.scanner.peek().is(b'(') {
                let symbol = self.notes.symbol(self.text(token));
                let entry = (symbol, self.function, index(statement));
                self.notes.mentions.push(entry);
            }
            match token.kind {
                Kind::Line | Kind::End => return Ok(()),
                _ => self.part(token)?,
            }
            let next = self.scanner.peek();
            if next.kind == Kind::Word && verbs::starts_statement(self.text(next)) {
                return Ok(());
            }
            token = self.next()?;
        }
    }

    /// One value: a literal, a name, a call. `statement` is where an assignment starts whose value it is.
    pub(super) fn operand(&mut self, statement: Option<usize>) -> Read<ExprId> {
        let token = self.scanner.peek();
        match token.kind {
            Kind::Sign(b'[') => {
                self.next()?;
                self.literal(token, token.start, false)
            }
            Kind::Word => {
                let text = self.text(token);
                let after = self.scanner.bytes.get(token.end).copied();
                self.next()?;
                let next = self.scanner.peek();
                if text == b"p" && (after == Some(b'[') || next.is(b'[')) {
                    let open = self.next()?;
                    return self.literal(open, token.start, true);
                }
                if next.is(b'(') && !verbs::is_operator(text) {
                    return match verbs::value_of(text) {
                        Some(_) if self.depth >= MOST_LOOKED_INTO => {
                            let open = self.next()?;
                            self.elements(open)?;
                            Ok(OTHER)
                        }
                        Some(value) => self.pose_call(value),
                        None => {
                            self.call(token)?;
                            Ok(OTHER)
                        }
                    };
                }
                if next.is(b'[') {
                    // an element of a list
                    self.next()?;
                    self.brackets(next)?;
                    if let Some(statement) = statement {
                        let symbol = self.notes.symbol(text);
                        let entry = (symbol, self.function, index(statement));
                        self.notes.mentions.push(entry);
                    }
                    return Ok(OTHER);
                }
                if text.contains(&b'.') || verbs::is_operator(text) {
                    return Ok(OTHER);
                }
                let symbol = self.notes.symbol(text);
                Ok(self.notes.add(Expr::Name(symbol)))
            }
            _ => Ok(OTHER),
        }
    }

    /// A literal whose bracket was just read.
    fn literal(&mut self, open: Token, start: usize, pose: bool) -> Read<ExprId> {
        let first = index(self.notes.numbers.len());
        let bytes = self.scanner.bytes;
        let literal = match literals::six(bytes, open.end, pose, &mut self.notes.numbers) {
            Found::Six(content, end) => {
                self.scanner.at = end;
                Literal {
                    offset: index(start),
                    pose,
                    content,
                    numbers: first..first + 6,
                    elements: 6,
                }
            }
            Found::TooLarge(from, to) => {
                let (file, line, column) = self.place(from);
                return Err(ReadError::BadValue {
                    file,
                    line,
                    column,
                    value: Source::text(&bytes[from..to]),
                    meaning: "number",
                    limit: "it is too large",
                });
            }
            Found::Else => {
                let elements = self.elements(open)?;
                literals::other(start, pose, elements)
            }
        };
        debug_assert!(literal.content == Content::Expressions || literal.elements == 6);
        self.notes.literals.push(literal);
        let id = index(self.notes.literals.len() - 1);
        Ok(self.notes.add(Expr::Literal(id)))
    }
}

fn closing(open: Kind) -> u8 {
    if open == Kind::Sign(b'(') { b')' } else { b']' }
}
