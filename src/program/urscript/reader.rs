//! Statements: functions, blocks, assignments, moves.

use super::literals::{self, Found};
use super::syntax::{
    Assignment, Content, Event, Expr, ExprId, Function, FunctionId, Literal, Notes, Reach, Step,
    index,
};
use super::tokens::{Kind, Scanner, Token};
use super::verbs::{self, Verb};
use crate::program::{Load, Motion, ReadError, Source};

/// Blocks inside each other that a program may have.
const MOST_BLOCKS: usize = 200;
/// Calls of moves and poses inside each other that a program may have.
const MOST_CALLS: u32 = 16;
/// Those whose values are looked into.
const MOST_LOOKED_INTO: u32 = 8;
/// The value of everything that is not looked into.
const OTHER: ExprId = 0;

/// An argument of a call: its name where it has one, its value, and its first token.
type Argument<'a> = (Option<&'a [u8]>, ExprId, Token);

#[derive(Clone, Copy, PartialEq, Eq)]
enum BlockKind {
    Function,
    Branch,
    Loop,
}

struct Block {
    kind: BlockKind,
    offset: usize,
    what: &'static str,
}

/// Reads one file.
pub struct Reader<'a> {
    source: &'a Source,
    scanner: Scanner<'a>,
    pub notes: Notes<'a>,
    function: FunctionId,
    blocks: Vec<Block>,
    depth: u32,
    /// The file has a function, a move or another word of the language.
    pub recognised: bool,
}

type Read<T> = Result<T, ReadError>;

impl<'a> Reader<'a> {
    pub fn new(source: &'a Source) -> Self {
        let mut notes = Notes::default();
        notes.add(Expr::Other);
        notes.functions.push(Function::default());
        Self {
            source,
            scanner: Scanner::new(&source.bytes),
            notes,
            function: 0,
            blocks: Vec::new(),
            depth: 0,
            recognised: false,
        }
    }

    /// Reads the whole file.
    ///
    /// # Errors
    /// Where a block, bracket or text is not closed, or something else stands where the language wants one thing.
    pub fn read(mut self) -> Read<Self> {
        loop {
            let token = self.next()?;
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

    fn next(&mut self) -> Read<Token> {
        self.scanner
            .next()
            .map_err(|open| self.unclosed(open.start, "a string"))
    }

    fn text(&self, token: Token) -> &'a [u8] {
        &self.scanner.bytes[token.start..token.end]
    }

    fn place(&self, offset: usize) -> (String, usize, usize) {
        let (line, column) = self.source.line_column(offset);
        (self.source.name.clone(), line, column)
    }

    fn unclosed(&self, offset: usize, what: &'static str) -> ReadError {
        let (file, line, column) = self.place(offset);
        ReadError::Unclosed {
            file,
            line,
            column,
            what,
        }
    }

    fn unexpected(&self, token: Token, expected: &'static str) -> ReadError {
        let (file, line, column) = self.place(token.start);
        let found = match token.kind {
            Kind::End => "the end of the file".into(),
            Kind::Line => "the end of the line".into(),
            _ => {
                let text = self.text(token);
                format!("`{}`", Source::text(&text[..text.len().min(40)]))
            }
        };
        ReadError::Unexpected {
            file,
            line,
            column,
            found,
            expected,
        }
    }

    fn event(&mut self, event: Event) {
        self.notes.functions[self.function as usize]
            .events
            .push(event);
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
                self.header()?;
                self.open(BlockKind::Branch, first, "`if`")?;
                self.event(Event::If);
                Ok(())
            }
            b"elif" => {
                self.branch(first)?;
                self.event(Event::ElseIf);
                self.header()
            }
            b"else" => {
                self.branch(first)?;
                self.header()?;
                self.event(Event::Else);
                Ok(())
            }
            b"while" => {
                self.open(BlockKind::Loop, first, "`while`")?;
                self.event(Event::Loop);
                self.header()
            }
            b"switch" if self.scanner.peek().kind != Kind::Sign(b'=') => {
                self.header()?;
                self.open(BlockKind::Branch, first, "`switch`")?;
                self.event(Event::If);
                Ok(())
            }
            b"case" | b"default" if self.in_branch() && !self.assigns() => {
                self.header()?;
                self.event(Event::ElseIf);
                Ok(())
            }
            b"end" => self.end(first),
            b"break" => self.leave(Event::Break),
            b"continue" => self.leave(Event::Continue),
            b"return" => {
                let next = self.scanner.peek();
                let word = next.kind == Kind::Word && verbs::starts_statement(self.text(next));
                if !word {
                    let next = self.next()?;
                    self.rest(next)?;
                }
                self.leave(Event::Return)
            }
            b"halt" => self.leave(Event::Return),
            b"global" => self.declared(Reach::Global),
            b"local" => self.declared(Reach::Local),
            _ => self.plain(first, Reach::Plain),
        }
    }

    fn leave(&mut self, event: Event) -> Read<()> {
        self.event(event);
        Ok(())
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
                    let symbol = self.notes.symbol(self.text(token));
                    parameters.push(symbol);
                    wants_name = false;
                }
                _ => {}
            }
        }
        self.header()?;
        let symbol = self.notes.symbol(self.text(name));
        self.notes.functions.push(Function {
            name: Some(symbol),
            parent: self.function,
            thread,
            parameters,
            events: Vec::new(),
        });
        self.function = index(self.notes.functions.len() - 1);
        Ok(())
    }

    fn end(&mut self, token: Token) -> Read<()> {
        let Some(block) = self.blocks.pop() else {
            return Err(self.unexpected(token, "a statement outside blocks"));
        };
        match block.kind {
            BlockKind::Function => {
                self.function = self.notes.functions[self.function as usize].parent;
            }
            BlockKind::Branch => self.event(Event::EndIf),
            BlockKind::Loop => self.event(Event::EndLoop),
        }
        Ok(())
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
        if next.is(b'=') {
            self.next()?;
            if self.scanner.bytes.get(self.scanner.at) == Some(&b'=') {
                return self.rest(next);
            }
            let value = self.value(name.start)?;
            return self.assign(name, reach, value, false);
        }
        if next.is(b'[') {
            self.next()?;
            self.brackets(next)?;
            while self.scanner.peek().is(b'[') {
                let more = self.next()?;
                self.brackets(more)?;
            }
            let after = self.scanner.peek();
            let compared = self.scanner.bytes.get(after.end) == Some(&b'=');
            if after.is(b'=') && !compared {
                self.next()?;
                let value = self.value(name.start)?;
                return self.assign(name, reach, value, true);
            }
            return Ok(());
        }
        self.part(name)
    }

    fn assign(&mut self, name: Token, reach: Reach, value: ExprId, part: bool) -> Read<()> {
        let text = self.text(name);
        // `a.b = …` changes a part of a
        let dot = memchr::memchr(b'.', text);
        let symbol = self.notes.symbol(&text[..dot.unwrap_or(text.len())]);
        self.notes.assignments.push(Assignment {
            name: symbol,
            function: self.function,
            reach,
            value,
            offset: index(name.start),
            part: part || dot.is_some(),
        });
        Ok(())
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

    /// One token of an expression; a call with its arguments, a bracket with what is in it.
    fn part(&mut self, token: Token) -> Read<()> {
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
    fn brackets(&mut self, open: Token) -> Read<()> {
        self.elements(open).map(|_| ())
    }

    /// To the bracket that closes `open`; how many elements are between its commas. Calls are noted on the way.
    fn elements(&mut self, open: Token) -> Read<u32> {
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
    fn value(&mut self, statement: usize) -> Read<ExprId> {
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
    fn operand(&mut self, statement: Option<usize>) -> Read<ExprId> {
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

    /// The arguments of a call whose name was just read: values by position and by name.
    fn arguments(&mut self) -> Read<Vec<Argument<'a>>> {
        let open = self.next()?;
        if self.depth >= MOST_CALLS {
            return Err(self.unexpected(open, "a call inside fewer others"));
        }
        self.depth += 1;
        let arguments = self.arguments_of(open);
        self.depth -= 1;
        arguments
    }

    fn arguments_of(&mut self, open: Token) -> Read<Vec<Argument<'a>>> {
        let mut arguments = Vec::new();
        loop {
            let mut first = self.scanner.peek();
            match first.kind {
                Kind::Line => {
                    self.next()?;
                    continue;
                }
                Kind::Sign(b')') => {
                    self.next()?;
                    return Ok(arguments);
                }
                _ => {}
            }
            let mut name = None;
            if first.kind == Kind::Word {
                let mut ahead = self.scanner;
                let second = ahead.next().and_then(|_| ahead.next());
                if let Ok(second) = second
                    && second.is(b'=')
                    && self.scanner.bytes.get(second.end) != Some(&b'=')
                {
                    name = Some(self.text(first));
                    self.scanner = ahead;
                    first = self.scanner.peek();
                }
            }
            let mut value = self.operand(None)?;
            loop {
                let token = self.next()?;
                match token.kind {
                    Kind::Sign(b',') => {
                        arguments.push((name, value, first));
                        break;
                    }
                    Kind::Sign(b')') => {
                        arguments.push((name, value, first));
                        return Ok(arguments);
                    }
                    Kind::Line => {}
                    Kind::End => return Err(self.unclosed(open.start, "a bracket")),
                    Kind::Word if verbs::starts_block(self.text(token)) => {
                        return Err(self.unclosed(open.start, "a bracket"));
                    }
                    _ => {
                        value = OTHER;
                        self.part(token)?;
                    }
                }
            }
        }
    }

    fn pose_call(&mut self, call: verbs::PoseCall) -> Read<ExprId> {
        let arguments = self.arguments()?;
        let at = |position: usize, names: &[&[u8]]| argument(&arguments, position, names);
        let expression = match call {
            verbs::PoseCall::Trans => at(0, &[b"p_from", b"T_from"])
                .zip(at(1, &[b"p_from_to", b"T_from_to"]))
                .map(|(a, b)| Expr::Trans(a, b)),
            verbs::PoseCall::Add => at(0, &[b"p_1"])
                .zip(at(1, &[b"p_2"]))
                .map(|(a, b)| Expr::Add(a, b)),
            verbs::PoseCall::Inverse => at(0, &[b"p_from"]).map(Expr::Inverse),
            verbs::PoseCall::Kinematics => at(0, &[b"x"]).map(|pose| Expr::Kinematics {
                pose,
                near: at(1, &[b"qnear"]),
                tcp: at(4, &[b"tcp", b"tcp_offset"]),
            }),
        };
        Ok(expression.map_or(OTHER, |expression| self.notes.add(expression)))
    }

    /// A call whose name was just read, with its arguments.
    fn call(&mut self, name: Token) -> Read<()> {
        let text = self.text(name);
        let verb = verbs::verb(text);
        self.recognised |= verb != Verb::Other;
        let offset = index(name.start);
        match verb {
            Verb::Other => {
                let symbol = self.notes.symbol(text);
                self.event(Event::Call(symbol));
                let open = self.next()?;
                self.brackets(open)
            }
            Verb::Known => {
                let open = self.next()?;
                self.brackets(open)
            }
            Verb::Odd(oddity) => {
                self.notes.oddities.push((oddity, offset));
                let open = self.next()?;
                self.brackets(open)
            }
            Verb::Tool => {
                let arguments = self.arguments()?;
                let pose = argument(&arguments, 0, &[b"pose"]);
                let pose = pose.unwrap_or(OTHER);
                self.event(Event::Tool(pose, offset));
                Ok(())
            }
            Verb::Load => {
                let arguments = self.arguments()?;
                let load = self.load(&arguments);
                self.event(Event::Load(load));
                Ok(())
            }
            Verb::Move(motion) => {
                let arguments = self.arguments()?;
                let names: [&[u8]; 3] = [b"pose", b"q", b"path"];
                let target = argument(&arguments, 0, &names);
                self.step(offset, motion, target, false);
                Ok(())
            }
            Verb::Stream => {
                let arguments = self.arguments()?;
                let target = argument(&arguments, 0, &[b"pose", b"q"]);
                self.step(offset, Motion::Joint, target, true);
                Ok(())
            }
            Verb::Arc => {
                let arguments = self.arguments()?;
                let via = argument(&arguments, 0, &[b"pose_via"]);
                let end = argument(&arguments, 1, &[b"pose_to"]);
                self.step(offset, Motion::ArcVia, via, false);
                self.step(offset, Motion::ArcEnd, end, false);
                Ok(())
            }
        }
    }

    fn step(&mut self, offset: u32, motion: Motion, target: Option<ExprId>, streamed: bool) {
        let target = target.unwrap_or(OTHER);
        self.notes.steps.push(Step {
            offset,
            function: self.function,
            motion,
            target,
            streamed,
        });
        let step = index(self.notes.steps.len() - 1);
        self.event(Event::Step(step));
    }

    /// `set_payload(mass, [x, y, z])` with numbers.
    fn load(&self, arguments: &[Argument]) -> Option<Load> {
        let (mass, cog) = (arguments.first()?, arguments.get(1)?);
        let number = |text: &[u8]| crate::program::number::parse(text);
        let mass_kg = number(self.text(mass.2))?;
        if mass.2.kind != Kind::Number || mass_kg <= 0.0 {
            return None;
        }
        let Expr::Literal(id) = self.notes.expression(cog.1) else {
            return None;
        };
        let literal = self.notes.literal(id);
        let start = literal.offset as usize + 1;
        let rest = &self.scanner.bytes[start..];
        let inside = &rest[..memchr::memchr(b']', &rest[..rest.len().min(400)])?];
        let mut values = inside
            .split(|b| *b == b',')
            .map(<[u8]>::trim_ascii)
            .map(number);
        let cog_m = [values.next()??, values.next()??, values.next()??];
        (literal.elements == 3 && !literal.pose).then_some(Load { mass_kg, cog_m })
    }
}

fn closing(open: Kind) -> u8 {
    if open == Kind::Sign(b'(') { b')' } else { b']' }
}

/// The argument at a position, or by one of its names.
fn argument(arguments: &[Argument], position: usize, names: &[&[u8]]) -> Option<ExprId> {
    let named = arguments
        .iter()
        .find(|(name, _, _)| name.is_some_and(|name| names.contains(&name)));
    let placed = arguments
        .get(position)
        .filter(|(name, _, _)| name.is_none());
    named.or(placed).map(|(_, value, _)| *value)
}
