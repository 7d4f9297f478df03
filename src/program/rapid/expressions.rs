//! Expressions that are passed over, and the arguments of an instruction one after another.

use super::reader::{BLOCK_WORDS, KEYWORD, Reader, index, keyword};
use super::syntax::{Argument, Expression, Part, Verb};
use super::tokens::{Fault, Kind};
use super::verbs;

/// Words between operands.
const OPERATORS: [&[u8]; 9] = [
    b"and", b"or", b"xor", b"not", b"div", b"mod", b"from", b"to", b"step",
];

impl Reader<'_> {
    /// Ends a statement behind its last operand: at its semicolon, or before a name where that is forgotten.
    pub(super) fn end_statement(&mut self) -> Result<(), Fault> {
        match self.token.kind {
            Kind::Sign(b';') => self.advance(),
            Kind::Name => Ok(()),
            _ => self.finish_statement(),
        }
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
        let start = self.notes.arguments.len();
        let mut expecting = true;
        let mut positional = 0;
        loop {
            let first_of_all = self.notes.arguments.len() == start;
            match self.token.kind {
                Kind::Sign(b',') => {
                    expecting = true;
                    self.advance()?;
                }
                Kind::Sign(b'\\') => {
                    self.advance()?;
                    let option = Some(self.name("the name of an optional argument")?);
                    let expression = if self.token.kind == Kind::Assign {
                        self.advance()?;
                        self.argument(None)?
                    } else {
                        Expression::Nothing
                    };
                    self.notes.arguments.push(Argument { option, expression });
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
                    self.notes.arguments.push(Argument {
                        option: None,
                        expression,
                    });
                    positional += 1;
                    expecting = false;
                }
            }
        }
        if verb == Verb::Harmless {
            self.notes.arguments.truncate(start);
        }
        Ok((index(start), index(self.notes.arguments.len())))
    }

    /// Whether the present word starts a statement: the semicolon before it is missing. Data may be called like a move; what
    /// follows the name tells them apart.
    fn at_statement(&self, first_argument: bool) -> bool {
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
        if first_argument
            && as_verb
            && matches!(verbs::verb(self.text(self.token)), Verb::Move { .. })
        {
            return true;
        }
        let mut buffer = [0; KEYWORD];
        let word = keyword(self.text(self.token), &mut buffer);
        matches!(
            word,
            b"endproc" | b"endfunc" | b"endtrap" | b"endmodule" | b"elseif" | b"case"
        ) || BLOCK_WORDS.contains(&word)
    }

    /// Passes over an expression, to what ends it or to a name that follows an operand; notes the names in it.
    pub(super) fn expression(&mut self) -> Result<Part, Fault> {
        let start = index(self.notes.mentions.len());
        self.brackets.clear();
        let mut operand = false;
        let mut component = false;
        loop {
            let token = self.token;
            match token.kind {
                Kind::End | Kind::Sign(b';') => {
                    if let Some(&(_, at)) = self.brackets.last() {
                        return Err(Fault::Unclosed {
                            at,
                            what: "bracket",
                        });
                    }
                    break;
                }
                Kind::Sign(open @ (b'[' | b'(' | b'{')) => {
                    self.brackets.push((open, token.start));
                    operand = false;
                }
                Kind::Sign(close @ (b']' | b')' | b'}')) => match self.brackets.pop() {
                    None => break,
                    Some((open, _)) if closes(open, close) => operand = true,
                    Some(_) => return Err(self.unexpected("the bracket that closes the last one")),
                },
                Kind::Sign(b',' | b'\\' | b':') | Kind::Assign if self.brackets.is_empty() => break,
                Kind::Sign(_) | Kind::Assign => operand = false,
                Kind::Number | Kind::Text => operand = true,
                Kind::Name => {
                    let mut buffer = [0; KEYWORD];
                    if OPERATORS.contains(&keyword(self.text(token), &mut buffer)) {
                        operand = false;
                    } else if operand && self.brackets.is_empty() {
                        break;
                    } else {
                        if !component {
                            let name = self.notes.symbols.intern(self.text(token));
                            self.notes.mentions.push(name);
                        }
                        operand = true;
                    }
                }
            }
            component = token.is(b'.') || token.is(b'\\');
            self.advance()?;
        }
        Ok((start, index(self.notes.mentions.len())))
    }
}

fn closes(open: u8, close: u8) -> bool {
    matches!((open, close), (b'[', b']') | (b'(', b')') | (b'{', b'}'))
}
