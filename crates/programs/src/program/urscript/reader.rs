//! Statements: functions, blocks, assignments.

use super::syntax::{Assignment, At, Event, Expr, Function, FunctionId, OTHER, Parsed, Reach};
use super::tokens::{Kind, Scanner, Token};
use super::verbs;
use crate::program::kit::Fault;
use crate::program::script::short;
use crate::program::{ReadError, Source, number};

/// Blocks inside each other that a program may have.
const MOST_BLOCKS: usize = 200;

#[derive(Clone, Copy, PartialEq, Eq)]
enum BlockKind {
    Function,
    Branch,
    Loop { endless: bool },
}

struct Block {
    kind: BlockKind,
    offset: usize,
    what: &'static str,
}

/// Which part of a variable is assigned.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    None,
    /// An element, and its number where that is written out.
    Element(At),
    /// A part of an element.
    Deep,
}

/// Reads one file.
pub(super) struct Reader<'a> {
    source: &'a Source,
    pub(super) scanner: Scanner<'a>,
    pub parsed: Parsed<'a>,
    pub(super) function: FunctionId,
    blocks: Vec<Block>,
    /// Calls around the one that is being read.
    pub(super) depth: u32,
    /// It stands behind `and` or `or`: whether it is called, what stands before them decides.
    pub(super) may_pass: bool,
    /// Where the next file of the text begins.
    files: std::iter::Peekable<std::vec::IntoIter<u32>>,
    /// The file has a function, a move, another word of the language or an assignment.
    pub recognised: bool,
}

pub(super) type Read<T> = Result<T, ReadError>;

impl<'a> Reader<'a> {
    pub(super) fn new(source: &'a Source) -> Self {
        let mut parsed = Parsed::default();
        parsed.text = &source.bytes;
        parsed.add(Expr::Other);
        parsed.functions.push(Function::default());
        Self {
            source,
            scanner: Scanner::new(&source.bytes),
            parsed,
            function: 0,
            blocks: Vec::new(),
            depth: 0,
            may_pass: false,
            files: Vec::new().into_iter().peekable(),
            recognised: false,
        }
    }

    /// Where the files of a text of several begin: of each the text outside functions is one.
    pub(super) fn of_files(mut self, starts: impl Iterator<Item = u32>) -> Self {
        self.files = starts.collect::<Vec<u32>>().into_iter().peekable();
        self
    }

    /// Whether what is read is a program: a library of poses and of what makes them moves nothing
    /// itself.
    pub(super) fn is_program(&self) -> bool {
        self.recognised || self.parsed.has_poses()
    }

    /// The text outside functions of a file that begins before a byte.
    fn begin_files(&mut self, at: usize) {
        while let Some(offset) = self.files.next_if(|start| *start as usize <= at) {
            self.function = short(self.parsed.functions.len());
            self.parsed.functions.push(Function {
                offset,
                unit: self.function,
                ..Function::default()
            });
        }
    }

    /// Reads the whole text.
    ///
    /// # Errors
    /// Where a block, bracket or text is not closed, or something else stands where the language
    /// wants one thing.
    pub(super) fn read(mut self) -> Read<Self> {
        loop {
            self.may_pass = false;
            let token = self.next()?;
            self.begin_files(token.start);
            match token.kind {
                Kind::End => break,
                Kind::Line => {}
                Kind::Word => self.statement(token)?,
                _ => self.rest(token)?,
            }
        }
        match self.blocks.last() {
            Some(block) => Err(self.unclosed(block.offset, block.what)),
            None => Ok(self),
        }
    }

    pub(super) fn next(&mut self) -> Read<Token> {
        self.scanner
            .next()
            .map_err(|open| self.unclosed(open.start, "a string"))
    }

    pub(super) fn text(&self, token: Token) -> &'a [u8] {
        &self.scanner.bytes[token.start..token.end]
    }

    pub(super) fn fail<T>(&self, fault: Fault) -> Read<T> {
        Err(fault.in_source(self.source))
    }

    pub(super) fn unclosed(&self, offset: usize, what: &'static str) -> ReadError {
        Fault::unclosed(offset, what).in_source(self.source)
    }

    pub(super) fn unexpected(&self, token: Token, expected: &'static str) -> ReadError {
        Fault::unexpected(token.start..token.end, expected).in_source(self.source)
    }

    pub(super) fn event(&mut self, event: Event) {
        let events = &mut self.parsed.functions[self.function as usize].events;
        if self.may_pass && event.is_of_call() {
            events.extend([Event::If, event, Event::EndIf]);
        } else {
            events.push(event);
        }
    }

    /// A statement by its first word.
    fn statement(&mut self, first: Token) -> Read<()> {
        match self.text(first) {
            b"def" => self.function(first, false),
            b"thread" => self.function(first, true),
            b"sec" | b"secondary" if self.scanner.peek().kind == Kind::Word => {
                self.function(first, true)
            }
            b"if" => {
                let never = self.is_never_true();
                let start = self.scanner.at;
                self.header()?;
                self.note_question(b"if", start);
                self.open(BlockKind::Branch, first, "`if`")?;
                self.event(if never { Event::Never } else { Event::If });
                Ok(())
            }
            b"elif" => {
                self.branch(first)?;
                self.event(Event::Branch { is_last: true });
                let start = self.scanner.at;
                self.header()?;
                self.note_question(b"elif", start);
                self.event(Event::ElseIf);
                Ok(())
            }
            b"else" => {
                self.branch(first)?;
                self.header()?;
                self.event(Event::Branch { is_last: true });
                Ok(())
            }
            b"while" => {
                let endless = self.is_always_true();
                self.open(BlockKind::Loop { endless }, first, "`while`")?;
                self.event(Event::Loop);
                let start = short(self.scanner.at);
                self.header()?;
                if !endless {
                    let end = short(self.scanner.at);
                    self.event(Event::Condition(start, end));
                }
                Ok(())
            }
            b"switch" if self.scanner.peek().kind != Kind::Sign(b'=') => {
                let start = self.scanner.at;
                self.header()?;
                self.note_question(b"switch", start);
                self.open(BlockKind::Branch, first, "`switch`")?;
                self.event(Event::Switch);
                Ok(())
            }
            b"case" | b"default" if self.in_branch() && !self.assigns() => {
                let start = self.scanner.at;
                self.header()?;
                let is_last = self.text(first) == b"default";
                if !is_last {
                    self.note_question(b"case", start);
                }
                self.event(Event::Branch { is_last });
                Ok(())
            }
            b"end" => self.end(first),
            b"break" => {
                self.event(Event::Break);
                Ok(())
            }
            b"continue" => {
                self.event(Event::Continue);
                Ok(())
            }
            b"return" => {
                let next = self.scanner.peek();
                let ends = matches!(next.kind, Kind::Line | Kind::End)
                    || next.kind == Kind::Word && verbs::starts_statement(self.text(next));
                let value = if ends {
                    OTHER
                } else {
                    self.value(first.start)?
                };
                self.event(Event::Return(value, short(first.start)));
                Ok(())
            }
            b"halt" => {
                self.event(Event::Halt);
                Ok(())
            }
            b"global" => self.declared(Reach::Global),
            b"local" => self.declared(Reach::Local),
            _ => self.plain(first, Reach::Plain),
        }
    }

    /// `while True`
    fn is_always_true(&self) -> bool {
        let mut ahead = self.scanner;
        let mut next = || ahead.next().ok();
        let mut token = next();
        while token.is_some_and(|token| token.is(b'(')) {
            token = next();
        }
        let is_true = token.is_some_and(|token| {
            token.kind == Kind::Word && matches!(self.text(token), b"True" | b"true")
        });
        let mut end = next();
        while end.is_some_and(|token| token.is(b')')) {
            end = next();
        }
        is_true && end.is_some_and(|end| end.is(b':') || end.kind == Kind::Line)
    }

    fn assigns(&self) -> bool {
        self.scanner.peek().is(b'=')
    }

    fn in_branch(&self) -> bool {
        self.blocks
            .last()
            .is_some_and(|block| block.kind == BlockKind::Branch)
    }

    fn branch(&self, token: Token) -> Read<()> {
        if self.in_branch() {
            Ok(())
        } else {
            Err(self.unexpected(token, "a statement outside `if`"))
        }
    }

    fn open(&mut self, kind: BlockKind, at: Token, what: &'static str) -> Read<()> {
        if self.blocks.len() >= MOST_BLOCKS {
            return Err(self.unexpected(at, "a block inside at most 199 others"));
        }
        self.blocks.push(Block {
            kind,
            offset: at.start,
            what,
        });
        Ok(())
    }

    /// `def name(parameters):`
    fn function(&mut self, first: Token, thread: bool) -> Read<()> {
        let what = if thread { "`thread`" } else { "`def`" };
        let name = self.next()?;
        if name.kind != Kind::Word {
            return Err(self.unexpected(name, "the name of a function"));
        }
        self.open(BlockKind::Function, first, what)?;
        self.recognised = true;
        let mut parameters = Vec::new();
        let open = self.next()?;
        if !open.is(b'(') {
            return Err(self.unexpected(open, "an opening bracket"));
        }
        let mut wants_name = true;
        loop {
            let token = self.next()?;
            match token.kind {
                Kind::Sign(b')') => break,
                Kind::End => return Err(self.unclosed(open.start, "a bracket")),
                Kind::Sign(b',') => wants_name = true,
                Kind::Word if wants_name => {
                    let symbol = self.parsed.symbol(self.text(token));
                    let mut value = None;
                    if self.assigns() {
                        self.next()?;
                        value = Some(self.operand(None)?);
                    }
                    parameters.push((symbol, value));
                    wants_name = false;
                }
                _ => {}
            }
        }
        self.header()?;
        let symbol = self.parsed.symbol(self.text(name));
        self.parsed.functions.push(Function {
            name: Some(symbol),
            offset: short(first.start),
            parent: self.function,
            unit: self.parsed.functions[self.function as usize].unit,
            thread,
            parameters,
            events: Vec::new(),
        });
        self.function = short(self.parsed.functions.len() - 1);
        Ok(())
    }

    fn end(&mut self, token: Token) -> Read<()> {
        let Some(block) = self.blocks.pop() else {
            return Err(self.unexpected(token, "a statement outside blocks"));
        };
        match block.kind {
            BlockKind::Function => {
                self.function = self.parsed.functions[self.function as usize].parent;
            }
            BlockKind::Branch => self.event(Event::EndIf),
            BlockKind::Loop { endless } => self.event(Event::EndLoop { endless }),
        }
        Ok(())
    }

    /// Whether a condition is two numbers that are not the same, `1 == 2`, or `False`.
    fn is_never_true(&self) -> bool {
        let mut ahead = self.scanner;
        let mut next = || {
            ahead.next().unwrap_or(Token {
                kind: Kind::End,
                start: 0,
                end: 0,
            })
        };
        let mut token = next();
        let in_brackets = token.is(b'(');
        if in_brackets {
            token = next();
        }
        let is_false = token.kind == Kind::Word && matches!(self.text(token), b"False" | b"false");
        if !is_false {
            let signs = [next(), next()];
            let (a, b) = (token, next());
            let value = |token: Token| number::parse(self.text(token));
            let (Some(a), Some(b)) = (value(a), value(b)) else {
                return false;
            };
            if !signs.iter().all(|sign| sign.is(b'=')) || a.total_cmp(&b).is_eq() {
                return false;
            }
        }
        if in_brackets && !next().is(b')') {
            return false;
        }
        let end = next();
        end.is(b':') || end.kind == Kind::Line
    }

    /// What follows `if`, `while`, `def name()`: to the colon or the end of the line.
    fn header(&mut self) -> Read<()> {
        loop {
            let token = self.next()?;
            match token.kind {
                Kind::Line | Kind::End | Kind::Sign(b':') => return Ok(()),
                _ => self.part(token)?,
            }
        }
    }

    fn declared(&mut self, reach: Reach) -> Read<()> {
        let name = self.next()?;
        match name.kind {
            Kind::Word => self.plain(name, reach),
            Kind::Line | Kind::End => Ok(()),
            _ => self.rest(name),
        }
    }

    /// `name = …`, `name[…] = …`, or any other expression.
    fn plain(&mut self, name: Token, reach: Reach) -> Read<()> {
        let next = self.scanner.peek();
        if next.kind == Kind::End && self.recognised {
            return Err(self.unclosed(name.start, "a statement"));
        }
        if next.is(b'=') {
            self.next()?;
            if self.scanner.bytes.get(self.scanner.at) == Some(&b'=') {
                return self.rest(next);
            }
            return self.assign(name, reach, Part::None);
        }
        if next.is(b'[') {
            self.next()?;
            let element = self.constant_index();
            self.brackets(next)?;
            let deep = self.scanner.peek().is(b'[');
            while self.scanner.peek().is(b'[') {
                let more = self.next()?;
                self.brackets(more)?;
            }
            let after = self.scanner.peek();
            let compared = self.scanner.bytes.get(after.end) == Some(&b'=');
            if after.is(b'=') && !compared {
                self.next()?;
                let part = if deep {
                    Part::Deep
                } else {
                    Part::Element(element)
                };
                return self.assign(name, reach, part);
            }
            return Ok(());
        }
        self.part(name)
    }

    /// `= …` behind a name or an element of it.
    fn assign(&mut self, name: Token, reach: Reach, part: Part) -> Read<()> {
        let alone = self.number_alone();
        let mut value = self.value(name.start)?;
        if let Some(known) = alone.and_then(number::parse) {
            value = self.parsed.add(Expr::Number(known));
        }
        self.recognised = true;
        let text = self.text(name);
        // `a.b = …` changes a part of a
        let (symbol, member) = self.member(text);
        let (is_deep, element) = match (part, member) {
            (Part::None, At::Member(_)) => (false, member),
            (Part::None, _) => (false, At::Any),
            (Part::Element(element), At::Any) => (false, element),
            _ => (true, At::Any),
        };
        self.parsed.assignments.push(Assignment {
            name: symbol,
            function: self.function,
            reach,
            value,
            offset: short(name.start),
            part: part != Part::None || member != At::Any,
            deep: is_deep,
            element,
            is_number: alone.is_some(),
            in_block: self
                .blocks
                .last()
                .is_some_and(|block| block.kind != BlockKind::Function),
        });
        let number = short(self.parsed.assignments.len() - 1);
        self.event(Event::Assign(number));
        Ok(())
    }

    /// The number that stands alone up to the end of the statement.
    fn number_alone(&self) -> Option<&'a [u8]> {
        let mut ahead = self.scanner;
        let first = ahead.next().ok()?;
        let number = match first.kind {
            Kind::Sign(b'-' | b'+') => ahead.next().ok()?,
            _ => first,
        };
        let ends = matches!(ahead.peek().kind, Kind::Line | Kind::End);
        let is_alone = number.kind == Kind::Number && ends;
        is_alone.then(|| &self.scanner.bytes[first.start..number.end])
    }

    /// Everything to the end of the line.
    fn rest(&mut self, first: Token) -> Read<()> {
        let mut token = first;
        loop {
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
}
