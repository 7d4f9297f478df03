//! Values: literals, names, calls, and what is between brackets.

use super::literals::{self, Found};
use super::reader::{Read, Reader};
use super::syntax::{At, Expr, ExprId, List, Literal, OTHER, Symbol};
use super::tokens::{Kind, Token};
use super::verbs::{self, Verb};
use crate::program::kit::Fault;
use crate::program::number;
use crate::program::script::short;

/// Those calls inside each other whose values are looked into.
pub(super) const MOST_LOOKED_INTO: u32 = 8;

/// What one element of a list is.
#[derive(Clone, Copy)]
enum Piece {
    Nothing,
    One(ExprId),
    More,
}

impl Piece {
    fn and(&mut self, value: ExprId) {
        *self = match self {
            Self::Nothing => Self::One(value),
            _ => Self::More,
        };
    }

    fn take(&mut self) -> ExprId {
        match std::mem::replace(self, Self::Nothing) {
            Self::One(value) => value,
            _ => OTHER,
        }
    }
}

impl<'a> Reader<'a> {
    /// One token of an expression; a call with its arguments, a bracket with what is in it.
    pub(super) fn part(&mut self, token: Token) -> Read<()> {
        match token.kind {
            Kind::Word if verbs::may_pass(self.text(token)) => {
                self.may_pass = true;
                Ok(())
            }
            Kind::Word if self.scanner.peek().is(b'(') && !verbs::is_operator(self.text(token)) => {
                self.call(token).map(|_| ())
            }
            Kind::Sign(b'(' | b'[') => self.brackets(token),
            Kind::Sign(b')' | b']') => Err(self.unexpected(token, "an opening bracket before")),
            _ => Ok(()),
        }
    }

    /// To the bracket that closes `open`.
    pub(super) fn brackets(&mut self, open: Token) -> Read<()> {
        self.elements(open, None).map(|_| ())
    }

    /// To the bracket that closes `open`; how many elements are between its commas, and which where
    /// they are asked for. Calls are noted on the way.
    fn elements(&mut self, open: Token, mut values: Option<&mut Vec<ExprId>>) -> Read<u32> {
        let mut waiting: Vec<(u8, usize)> = vec![(closing(open.kind), open.start)];
        let mut elements = 1;
        let mut piece = Piece::Nothing;
        let may_pass = self.may_pass;
        loop {
            let token = self.next()?;
            let outside = waiting.len() == 1;
            let looks = values.is_some() && outside;
            match token.kind {
                Kind::Sign(byte @ (b')' | b']')) => {
                    let (wanted, _) = waiting.pop().expect("one is open");
                    if byte != wanted {
                        let expected = if wanted == b')' { "`)`" } else { "`]`" };
                        return Err(self.unexpected(token, expected));
                    }
                    if waiting.is_empty() {
                        self.may_pass = may_pass;
                        if let Some(values) = &mut values {
                            values.push(piece.take());
                        }
                        return Ok(elements);
                    }
                    continue;
                }
                Kind::Sign(b',') if outside => {
                    self.may_pass = may_pass;
                    elements += 1;
                    if let Some(values) = &mut values {
                        values.push(piece.take());
                    }
                    continue;
                }
                Kind::Line => continue,
                _ => {}
            }
            let mut value = OTHER;
            match token.kind {
                Kind::Sign(b'[') if looks => match self.six(token, token.start, false)? {
                    Some(literal) => value = literal,
                    None => waiting.push((b']', token.start)),
                },
                Kind::Sign(b'(' | b'[') => waiting.push((closing(token.kind), token.start)),
                Kind::Word => {
                    let text = self.text(token);
                    let next = self.scanner.peek();
                    self.may_pass |= verbs::may_pass(text);
                    if next.is(b'(') && !verbs::is_operator(text) {
                        match verbs::verb(text) {
                            _ if looks => value = self.call_of(token)?,
                            Verb::Known => {}
                            Verb::Other if self.depth >= MOST_LOOKED_INTO => {
                                self.called(token, Vec::new());
                            }
                            _ => {
                                self.call(token)?;
                            }
                        }
                    } else if verbs::starts_block(text) {
                        return Err(self.unclosed(open.start, "a bracket"));
                    } else if looks && text == b"p" && next.is(b'[') {
                        self.next()?;
                        match self.six(next, token.start, true)? {
                            Some(literal) => value = literal,
                            None => waiting.push((b']', next.start)),
                        }
                    } else if looks && !verbs::is_operator(text) {
                        value = self.name(text, token.start);
                    }
                }
                Kind::End => {
                    return Err(self.unclosed(waiting[0].1, "a bracket"));
                }
                _ => {}
            }
            if looks {
                piece.and(value);
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
        if let Expr::Name(name, _) | Expr::Element(name, At::Member(_)) =
            self.parsed.expression(value)
        {
            let entry = (name, self.function, short(statement));
            self.parsed.mentions.push(entry);
        }
    }

    /// The rest of a statement whose value is computed: the names in it are noted.
    fn mentions_of(&mut self, first: Token, statement: usize) -> Read<()> {
        let mut token = first;
        loop {
            if token.kind == Kind::Word && !self.scanner.peek().is(b'(') {
                let (symbol, _) = self.member(self.text(token));
                let entry = (symbol, self.function, short(statement));
                self.parsed.mentions.push(entry);
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

    /// One value: a literal, a name, a call. `statement` is where an assignment starts whose value
    /// it is.
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
                    return self.call_of(token);
                }
                if next.is(b'[') {
                    // an element of a list
                    self.next()?;
                    let number = self.constant_index();
                    self.brackets(next)?;
                    let (symbol, member) = self.member(text);
                    if let Some(statement) = statement {
                        let entry = (symbol, self.function, short(statement));
                        self.parsed.mentions.push(entry);
                    }
                    if self.scanner.peek().is(b'[') || member != At::Any {
                        return Ok(OTHER);
                    }
                    return Ok(self.parsed.add(Expr::Element(symbol, number)));
                }
                if verbs::is_operator(text) {
                    return Ok(OTHER);
                }
                Ok(self.name(text, token.start))
            }
            _ => Ok(OTHER),
        }
    }

    /// A function that is called, behind its name.
    fn call_of(&mut self, name: Token) -> Read<ExprId> {
        match verbs::value_of(self.text(name)) {
            Some(_) if self.depth >= MOST_LOOKED_INTO => {
                let open = self.next()?;
                self.brackets(open)?;
                Ok(OTHER)
            }
            Some(value) => self.pose_call(value),
            None => self.call(name),
        }
    }

    /// A variable, or the member of one: `x.name`.
    fn name(&mut self, text: &'a [u8], start: usize) -> ExprId {
        let expression = match self.member(text) {
            (symbol, At::Any) => Expr::Name(symbol, short(start)),
            (symbol, member) => Expr::Element(symbol, member),
        };
        self.parsed.add(expression)
    }

    /// A variable, and which of its members a name means where it has a dot; [`At::Any`] without.
    pub(super) fn member(&mut self, text: &'a [u8]) -> (Symbol, At) {
        let Some(dot) = memchr::memchr(b'.', text) else {
            return (self.parsed.symbol(text), At::Any);
        };
        let (symbol, member) = (&text[..dot], &text[dot + 1..]);
        let symbol = self.parsed.symbol(symbol);
        (symbol, At::Member(self.parsed.symbol(member)))
    }

    /// The number of an element where it is written out, behind the opening bracket.
    pub(super) fn constant_index(&self) -> At {
        let mut ahead = self.scanner;
        let (Ok(index), Ok(end)) = (ahead.next(), ahead.next()) else {
            return At::Any;
        };
        let number = number::whole(self.text(index)).filter(|_| end.is(b']'));
        number.map_or(At::Any, At::Number)
    }

    /// A literal whose bracket was just read.
    fn literal(&mut self, open: Token, start: usize, pose: bool) -> Read<ExprId> {
        if let Some(literal) = self.six(open, start, pose)? {
            return Ok(literal);
        }
        let mut values = Vec::new();
        let elements = self.elements(open, (!pose).then_some(&mut values))?;
        let mut literal = literals::other(start, self.scanner.at, pose, elements);
        self.look_into(&mut literal, open);
        self.parsed.literals.push(literal);
        let literal = short(self.parsed.literals.len() - 1);
        if values.iter().all(|value| *value == OTHER) {
            return Ok(self.parsed.add(Expr::Literal(literal)));
        }
        self.parsed.lists.push(List {
            literal,
            elements: values,
        });
        let list = short(self.parsed.lists.len() - 1);
        Ok(self.parsed.add(Expr::List(list)))
    }

    /// A literal of six numbers behind a bracket that was just read; nothing more is read where it
    /// is none.
    fn six(&mut self, open: Token, start: usize, pose: bool) -> Read<Option<ExprId>> {
        let first = short(self.parsed.numbers.len());
        let bytes = self.scanner.bytes;
        match literals::six(bytes, open.end, pose, &mut self.parsed.numbers) {
            Found::Six(content, end) => {
                self.scanner.at = end;
                self.parsed.literals.push(Literal {
                    offset: short(start),
                    end: short(end),
                    pose,
                    content,
                    numbers: first..first + 6,
                    elements: 6,
                    computed: false,
                    names: 0..0,
                });
                let id = short(self.parsed.literals.len() - 1);
                Ok(Some(self.parsed.add(Expr::Literal(id))))
            }
            Found::Bad(from, to, why) => self.fail(Fault::bad_value(from..to, "number", why)),
            Found::Else => Ok(None),
        }
    }
}

fn closing(open: Kind) -> u8 {
    if open == Kind::Sign(b'(') { b')' } else { b']' }
}
