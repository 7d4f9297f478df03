//! Expressions that are passed over, and the arguments of an instruction one after another.

use super::blocks::is_block_word;
use super::builtins::{self, Known};
use super::reader::{KEYWORD, Reader, keyword};
use super::resolved::named;
use super::syntax::{Argument, Base, Expression, Function, Index, Part, StatementKind, Verb};
use super::tokens::{Fault, Kind, Token};
use super::verbs;
use crate::program::names::Symbol;
use crate::program::script::short;

/// Words between operands.
const OPERATORS: [&[u8]; 9] = [
    b"and", b"or", b"xor", b"not", b"div", b"mod", b"from", b"to", b"step",
];

impl Reader<'_> {
    /// Ends a statement behind its last operand: at its semicolon, or before a name where that is
    /// forgotten.
    pub(super) fn end_statement(&mut self) -> Result<(), Fault> {
        match self.token.kind {
            Kind::Sign(b';') => self.advance(),
            Kind::Name => Ok(()),
            _ => self.finish_statement(),
        }
    }

    /// Skips a statement whose words are none of an expression.
    pub(super) fn skip_statement(&mut self) -> Result<(), Fault> {
        while !matches!(self.token.kind, Kind::Sign(b';') | Kind::End) {
            self.advance()?;
        }
        if self.token.kind == Kind::End {
            return Ok(());
        }
        self.advance()
    }

    /// Passes over the rest of a statement.
    pub(super) fn finish_statement(&mut self) -> Result<(), Fault> {
        loop {
            let before = self.token.start;
            self.expression()?;
            match self.token.kind {
                Kind::Sign(b';') => return self.advance(),
                Kind::Sign(b']' | b')' | b'}') => return Err(self.unexpected("a semicolon")),
                Kind::End => return Ok(()),
                Kind::Name if self.token.start > before => return Ok(()),
                _ => self.advance()?,
            }
        }
    }

    /// Reads the arguments of an instruction, to the end of the statement.
    pub(super) fn arguments(&mut self, verb: Verb) -> Result<Part, Fault> {
        let start = self.parsed.arguments.len();
        let mut expecting = true;
        let mut positional = 0;
        loop {
            let first_of_all = self.parsed.arguments.len() == start;
            match self.token.kind {
                Kind::Sign(b',') => {
                    expecting = true;
                    self.advance()?;
                }
                Kind::Sign(b'\\') => {
                    let begin = self.token.start;
                    self.advance()?;
                    let is_load = self.is_word(b"tload");
                    let option = Some(self.name("the name of an optional argument")?);
                    let if_given = self.token.is(b'?');
                    let expression = if if_given || self.token.kind == Kind::Assign {
                        self.advance()?;
                        if if_given {
                            self.note_if_given();
                        }
                        if is_load && self.token.is(b'[') {
                            self.load()?
                        } else {
                            self.argument(None)?
                        }
                    } else {
                        Expression::Nothing
                    };
                    self.parsed.arguments.push(Argument {
                        option,
                        expression,
                        span: (begin, self.behind),
                    });
                    expecting = false;
                }
                Kind::Sign(b';') => {
                    self.advance()?;
                    break;
                }
                Kind::End => break,
                Kind::Name if !expecting || self.at_statement(first_of_all) => break,
                Kind::Sign(b']' | b')' | b'}') => return Err(self.unexpected("an argument")),
                _ => {
                    let before = self.token.start;
                    let expression = self.argument(Some((verb, positional)))?;
                    if self.token.start == before {
                        self.advance()?;
                    }
                    self.parsed.arguments.push(Argument {
                        option: None,
                        expression,
                        span: (before, self.behind),
                    });
                    positional += 1;
                    expecting = false;
                }
            }
        }
        if verb == Verb::Harmless {
            // what waits or asks may tell its result in an optional argument
            let given = self.parsed.arguments[start..].iter();
            let symbols = &self.parsed.symbols;
            let given = given.filter(|argument| {
                let option = argument.option.map(|option| symbols.spelling(option));
                option.is_some_and(|option| !builtins::is_shown(option))
            });
            let names = given.filter_map(|argument| named(&argument.expression));
            let results = names.map(|name| (name, self.context));
            self.parsed.results.extend(results);
            self.parsed.arguments.truncate(start);
        }
        Ok((short(start), short(self.parsed.arguments.len())))
    }

    /// `\WObj?name`: the option is there where the parameter of this name, the present token, is
    /// given.
    fn note_if_given(&mut self) {
        if let (Some(routine), Kind::Name) = (self.context.routine, self.token.kind) {
            let name = self.parsed.symbols.intern(self.text(self.token));
            self.parsed.if_given.insert((routine, name));
            self.parsed.asked.insert((routine, name));
        }
    }

    /// Whether the present word starts a statement: the semicolon before it is missing. Data may be
    /// called like a move; what follows the name tells them apart.
    pub(super) fn at_statement(&self, first_argument: bool) -> bool {
        let (start, end) = (self.token.start as usize, self.token.end as usize);
        let next = self.bytes[end..].iter().find(|b| !b.is_ascii_whitespace());
        let own_line = || {
            let before = self.bytes[..start].iter().rev();
            let mut blanks = before.take_while(|b| b.is_ascii_whitespace());
            blanks.any(|b| matches!(b, b'\n' | b'\r'))
        };
        let as_verb = match next {
            Some(b',' | b';' | b'{' | b'(' | b'.' | b'+' | b'-' | b'*' | b'/') | None => false,
            Some(b'\\') => own_line(),
            Some(_) => true,
        };
        if first_argument && as_verb && verbs::is_move(self.text(self.token)) {
            return true;
        }
        let mut buffer = [0; KEYWORD];
        let word = keyword(self.text(self.token), &mut buffer);
        matches!(word, b"endproc" | b"endfunc" | b"endtrap" | b"endmodule") || is_block_word(word)
    }

    /// Passes over an expression, to what ends it or to a name that follows an operand; parsed the
    /// names in it and the functions that it calls.
    pub(super) fn expression(&mut self) -> Result<Part, Fault> {
        let start = short(self.parsed.mentions.len());
        self.brackets.clear();
        self.calls.clear();
        self.given.clear();
        self.alone = None;
        let first = self.token.start;
        let mut operand = false;
        let mut component = false;
        let mut last_name = None;
        loop {
            let token = self.token;
            let mut name = None;
            match token.kind {
                Kind::End | Kind::Sign(b';') => {
                    if let Some(&(_, at)) = self.brackets.last() {
                        return Err(Fault::unclosed(at as usize, "bracket"));
                    }
                    break;
                }
                Kind::Sign(open @ (b'[' | b'(' | b'{')) => {
                    self.given_sign(token);
                    self.brackets.push((open, token.start));
                    if let (b'(', Some((name, offset))) = (open, last_name) {
                        self.open_call(name, offset);
                    }
                    operand = false;
                }
                Kind::Sign(close @ (b']' | b')' | b'}')) => match self.brackets.last() {
                    None => break,
                    Some(&(open, _)) if closes(open, close) => {
                        self.close_call(first);
                        self.brackets.pop();
                        operand = true;
                    }
                    Some(_) => return Err(self.unexpected("the bracket that closes the last one")),
                },
                Kind::Sign(b',' | b'\\' | b':') | Kind::Assign if self.brackets.is_empty() => break,
                Kind::Sign(_) | Kind::Assign => {
                    self.given_sign(token);
                    operand = false;
                }
                Kind::Number | Kind::Text => {
                    self.given_sign(token);
                    operand = true;
                }
                Kind::Name => {
                    if self.is_operator() {
                        self.given_sign(token);
                        operand = false;
                    } else if operand && self.brackets.is_empty() {
                        break;
                    } else {
                        let symbol = self.parsed.symbols.intern(self.text(token));
                        if !component {
                            self.parsed.mentions.push(symbol);
                            name = Some((symbol, token.start));
                        }
                        self.given_name(symbol);
                        operand = true;
                    }
                }
            }
            if !matches!(token.kind, Kind::Sign(b']' | b')' | b'}')) {
                self.alone = None;
            }
            component = token.is(b'.') || token.is(b'\\');
            last_name = name;
            self.advance()?;
        }
        Ok((start, short(self.parsed.mentions.len())))
    }

    /// Whether the present name is a word between operands.
    pub(super) fn is_operator(&self) -> bool {
        let mut buffer = [0; KEYWORD];
        OPERATORS.contains(&keyword(self.text(self.token), &mut buffer))
    }

    // ---- functions in an expression

    /// A function is called; the present token is its bracket.
    fn open_call(&mut self, name: Symbol, offset: u32) {
        let bytes = self.bytes;
        let token = &bytes[offset as usize..self.behind as usize];
        let known = self.verbs.function(name, token, self.context.module);
        // what is given to another function is a position near that of its own target
        let is_displaced = !self.calls.is_empty() && self.displaces(token).is_some();
        if known != Known::Harmless && !is_displaced {
            self.calls.push(OpenCall {
                name,
                offset,
                depth: self.brackets.len(),
                first: self.given.len(),
                known,
                argument: Given::Nothing,
                option: None,
                after_backslash: false,
                from: self.token.start + 1,
                mentions: short(self.parsed.mentions.len()),
            });
        }
    }

    /// A name in an expression.
    fn given_name(&mut self, symbol: Symbol) {
        let (depth, mentions) = (self.brackets.len(), self.parsed.mentions.len());
        let Some(call) = self.calls.last_mut() else {
            return;
        };
        if call.depth != depth {
            return;
        }
        if std::mem::take(&mut call.after_backslash) {
            call.option = Some(symbol);
            call.mentions = short(mentions);
            return;
        }
        call.argument = match call.argument {
            Given::Nothing => Given::Name(symbol),
            Given::Member(of) => Given::Member(of),
            _ => Given::Other,
        };
    }

    /// A sign, number or operator in an expression, but for brackets that close.
    fn given_sign(&mut self, token: Token) {
        let depth = self.brackets.len();
        let Some(call) = self.calls.last_mut() else {
            return;
        };
        if call.depth != depth {
            return;
        }
        match token.kind {
            Kind::Sign(b',') => self.give(),
            Kind::Sign(b'\\') => {
                self.give();
                if let Some(call) = self.calls.last_mut() {
                    call.after_backslash = true;
                }
            }
            Kind::Assign | Kind::Sign(b'?') => {}
            Kind::Sign(sign) => {
                call.argument = match (sign, call.argument) {
                    (b'{', Given::Name(of)) => Given::Element(of, token.start),
                    (b'.', Given::Name(of) | Given::Element(of, _) | Given::Member(of))
                    | (b'{', Given::Member(of)) => Given::Member(of),
                    _ => Given::Other,
                }
            }
            _ => call.argument = Given::Other,
        }
    }

    /// The present argument of the innermost call is complete.
    fn give(&mut self) {
        let end = short(self.parsed.mentions.len());
        let sign = self.token.start;
        let Some(call) = self.calls.last_mut() else {
            return;
        };
        let span = (call.from, sign);
        call.from = sign + 1;
        let named = |name, index| Expression::Point {
            base: Base::Named { name, index },
            steps: (0, 0),
        };
        let expression = match call.argument {
            Given::Nothing => Expression::Nothing,
            Given::Name(name) => named(name, 0),
            Given::Element(name, open) => {
                let index = index_at(self.bytes, open);
                named(name, self.parsed.keep_index(name, index))
            }
            Given::Member(name) => Expression::Member { name, index: 0 },
            Given::Other => Expression::Computed((call.mentions, end)),
        };
        if expression != Expression::Nothing || call.option.is_some() {
            self.given.push(Argument {
                option: call.option,
                expression,
                span,
            });
        }
        (call.argument, call.option, call.mentions) = (Given::Nothing, None, end);
    }

    /// A bracket closes; the call that it belongs to is noted.
    fn close_call(&mut self, first: u32) {
        let depth = self.brackets.len();
        if self.calls.last().is_none_or(|call| call.depth != depth) {
            return;
        }
        self.give();
        let call = self.calls.pop().expect("a call is open");
        let start = short(self.parsed.given.len());
        self.parsed.given.extend(self.given.drain(call.first..));
        let function = short(self.parsed.functions.len());
        self.parsed.functions.push(Function {
            name: call.name,
            offset: call.offset,
            arguments: (start, short(self.parsed.given.len())),
        });
        if call.known != Known::Actual {
            self.note(call.offset, StatementKind::Function(function));
        }
        if let Some(outer) = self.calls.last_mut()
            && outer.depth + 1 == depth
        {
            outer.argument = Given::Other;
        }
        self.alone = (depth == 1 && call.offset == first).then_some(function);
    }
}

/// A function whose call is not closed yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenCall {
    name: Symbol,
    offset: u32,
    /// Open brackets inside its own.
    depth: usize,
    /// Its first argument among those that are complete.
    first: usize,
    known: Known,
    /// The present argument.
    argument: Given,
    option: Option<Symbol>,
    after_backslash: bool,
    /// Where it begins, and the names in it.
    from: u32,
    mentions: u32,
}

/// The argument of a function as far as it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Given {
    Nothing,
    Name(Symbol),
    /// With the bracket of its index.
    Element(Symbol, u32),
    Member(Symbol),
    Other,
}

/// The index whose bracket opens there.
fn index_at(bytes: &[u8], open: u32) -> Index {
    let mut behind = bytes[open as usize + 1..].split(|b| *b == b'}');
    let mut place = [0; 3];
    for (at, text) in behind
        .next()
        .unwrap_or_default()
        .split(|b| *b == b',')
        .enumerate()
    {
        let digits = std::str::from_utf8(text.trim_ascii()).ok();
        let number = digits.and_then(|digits| digits.parse().ok());
        match (place.get_mut(at), number) {
            (Some(slot), Some(number @ 1..)) => *slot = number,
            _ => return Index::Variable,
        }
    }
    Index::At(place)
}

fn closes(open: u8, close: u8) -> bool {
    matches!((open, close), (b'[', b']') | (b'(', b')') | (b'{', b'}'))
}
