//! Reads the statements of one file.
//!
//! A statement ends at its semicolon, or where a name follows an operand: some posts forget
//! semicolons, and a short IF has its statement behind its condition. Nothing here recurses on the
//! text's brackets.

use super::ahead;
use super::blocks::is_block_word;
use super::expressions::OpenCall;
use super::syntax::{
    Argument, Called, Callee, Component, Expression, Lengths, Parsed, Routine, Statement,
    StatementKind, Storage, Type, Verb,
};
use super::tokens::{Fault, Kind, Scanner, Token};
use super::verbs::{self, Verbs};
use crate::program::Source;
use crate::program::names::{Context, Symbol};
use crate::program::script::{Place, short};
use std::ops::Range;

/// A place to go back to.
#[derive(Clone, Copy)]
pub(super) struct Mark<'a>(Scanner<'a>, Token, u32, Lengths);

/// A loop that is not closed yet.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct OpenLoop {
    /// Only its own statements leave it.
    pub endless: bool,
    /// One of [`Parsed::loops`].
    pub counting: Option<usize>,
}

/// Reads one file into the parsed of all.
pub(super) struct Reader<'a> {
    pub(super) bytes: &'a [u8],
    scanner: Scanner<'a>,
    /// The token that is not used yet.
    pub(super) token: Token,
    /// Behind the token before it.
    pub(super) behind: u32,
    pub(super) parsed: &'a mut Parsed,
    pub(super) verbs: &'a mut Verbs,
    pub(super) file: u32,
    pub(super) context: Context,
    /// Where the open module and routine start.
    module: Option<u32>,
    routine: Option<u32>,
    /// Open brackets of the present expression.
    pub(super) brackets: Vec<(u8, u32)>,
    /// Functions that are called in it and not closed yet, and arguments of theirs.
    pub(super) calls: Vec<OpenCall>,
    pub(super) given: Vec<Argument>,
    /// The function whose call the last expression is, if it is nothing else.
    pub(super) alone: Option<u32>,
    /// Loops that are open.
    pub(super) loops: Vec<OpenLoop>,
    /// Short IFs whose statement has not come yet.
    pub(super) short_ifs: u32,
    /// Anything of the language was seen.
    pub(super) recognised: bool,
}

/// Longest keyword.
pub(super) const KEYWORD: usize = 14;

/// A name in lower case where it is short enough for a keyword, else nothing.
pub(super) fn keyword<'b>(name: &[u8], buffer: &'b mut [u8; KEYWORD]) -> &'b [u8] {
    let Some(word) = buffer.get_mut(..name.len()) else {
        return b"";
    };
    word.copy_from_slice(name);
    word.make_ascii_lowercase();
    word
}

impl<'a> Reader<'a> {
    /// Reads a file; whether it has anything of the language.
    pub(super) fn read(
        source: &'a Source,
        file: u32,
        parsed: &'a mut Parsed,
        verbs: &'a mut Verbs,
    ) -> Result<bool, Fault> {
        // what calls mean does not depend on what stands elsewhere as long as nothing is hidden
        let parts = if verbs.hides_nothing() {
            ahead::parts(&source.bytes)
        } else {
            Vec::new()
        };
        Self::read_with(source, file, &parts, parsed, verbs)
    }

    /// Reads a file, and these parts of it ahead.
    pub(super) fn read_with(
        source: &'a Source,
        file: u32,
        parts: &[Range<usize>],
        parsed: &'a mut Parsed,
        verbs: &'a mut Verbs,
    ) -> Result<bool, Fault> {
        let start = content_start(&source.bytes)?;
        parsed.reserve(source.bytes.len());
        let context = outside(parsed, None);
        let mut reader = Self {
            context,
            ..Self::at(source, file, start, parsed, verbs)
        };
        reader.text_begins(0);
        reader.advance()?;
        if let Some(first) = parts.first() {
            let own = || reader.statements(first.start);
            let (done, parts) = rayon::join(own, || ahead::read(source, file, parts));
            done?;
            for part in parts.iter().flatten() {
                reader.statements(part.first as usize)?;
                if reader.token.start == part.first
                    && reader.short_ifs == 0
                    && reader.routine.is_some()
                {
                    reader.take(part);
                    reader.jump(part.end)?;
                }
            }
        }
        reader.statements(usize::MAX)?;
        let open = reader
            .routine
            .map(|at| (at, "routine"))
            .or_else(|| reader.module.map(|at| (at, "module")));
        match open {
            None => Ok(reader.recognised),
            Some((at, what)) => Err(Fault::unclosed(at as usize, what)),
        }
    }

    /// Starts at a byte of a file.
    pub(super) fn at(
        source: &'a Source,
        file: u32,
        start: usize,
        parsed: &'a mut Parsed,
        verbs: &'a mut Verbs,
    ) -> Self {
        Self {
            bytes: &source.bytes,
            scanner: Scanner::new(&source.bytes, start),
            token: Token {
                kind: Kind::End,
                start: 0,
                end: 0,
            },
            context: Context {
                module: 0,
                routine: None,
            },
            behind: 0,
            parsed,
            verbs,
            file,
            module: None,
            routine: None,
            brackets: Vec::new(),
            calls: Vec::new(),
            given: Vec::new(),
            alone: None,
            loops: Vec::new(),
            short_ifs: 0,
            recognised: false,
        }
    }

    pub(super) fn advance(&mut self) -> Result<(), Fault> {
        self.behind = self.token.end;
        self.token = self.scanner.next()?;
        Ok(())
    }

    /// Goes on at a byte.
    pub(super) fn jump(&mut self, at: usize) -> Result<(), Fault> {
        self.scanner = Scanner::new(self.bytes, at);
        self.advance()?;
        self.behind = short(at);
        Ok(())
    }

    pub(super) fn mark(&self) -> Mark<'a> {
        Mark(self.scanner, self.token, self.behind, self.parsed.lengths())
    }

    /// Goes back, and takes back what was noted since.
    pub(super) fn rewind(&mut self, mark: Mark<'a>) {
        (self.scanner, self.token, self.behind) = (mark.0, mark.1, mark.2);
        self.parsed.shorten(mark.3);
    }

    pub(super) fn text(&self, token: Token) -> &'a [u8] {
        &self.bytes[token.start as usize..token.end as usize]
    }

    pub(super) fn is_word(&self, word: &[u8]) -> bool {
        self.token.kind == Kind::Name && self.text(self.token).eq_ignore_ascii_case(word)
    }

    pub(super) fn unexpected(&self, expected: &'static str) -> Fault {
        Fault::unexpected(self.token.start as usize..self.token.end as usize, expected)
    }

    /// The name that must stand here.
    pub(super) fn name(&mut self, expected: &'static str) -> Result<Symbol, Fault> {
        if self.token.kind != Kind::Name {
            return Err(self.unexpected(expected));
        }
        let name = self.parsed.symbols.intern(self.text(self.token));
        self.advance()?;
        Ok(name)
    }

    /// Reads statements, to the first that begins at a byte or behind it.
    fn statements(&mut self, until: usize) -> Result<(), Fault> {
        while self.token.kind != Kind::End && (self.token.start as usize) < until {
            let guarded = self.short_ifs;
            match self.token.kind {
                Kind::Name => self.statement()?,
                Kind::Sign(b'%') => self.late_bound_call()?,
                Kind::Sign(b'<') => self.placeholder()?,
                Kind::Sign(b']' | b')' | b'}') => {
                    return Err(self.unexpected("a statement"));
                }
                Kind::Sign(b'[' | b'(' | b'{') => {
                    self.expression()?;
                }
                _ => self.advance()?,
            }
            // the statement of a short IF has come
            if guarded > 0 && guarded == self.short_ifs {
                for _ in 0..std::mem::take(&mut self.short_ifs) {
                    self.note(self.token.start, StatementKind::EndChoice);
                }
            }
        }
        Ok(())
    }

    /// Whether a statement that begins with this word is no call, label or assignment: see
    /// [`Self::statement`].
    pub(super) fn is_keyword(word: &[u8]) -> bool {
        let others: [&[u8]; 17] = [
            b"module",
            b"endmodule",
            b"local",
            b"const",
            b"pers",
            b"var",
            b"task",
            b"proc",
            b"func",
            b"trap",
            b"endproc",
            b"endfunc",
            b"endtrap",
            b"record",
            b"endrecord",
            b"connect",
            b"alias",
        ];
        others.contains(&word) || is_block_word(word)
    }

    fn statement(&mut self) -> Result<(), Fault> {
        let first = self.token;
        let mut buffer = [0; KEYWORD];
        match keyword(self.text(first), &mut buffer) {
            b"module" => self.open_module(),
            b"endmodule" => self.close_module(),
            b"local" => {
                self.advance()?;
                if let Some(found) = self.routine_or_data(first.start, true)? {
                    self.recognised |= found;
                }
                Ok(())
            }
            b"const" | b"pers" | b"var" | b"task" | b"proc" | b"func" | b"trap" => {
                if let Some(found) = self.routine_or_data(first.start, false)? {
                    self.recognised |= found;
                }
                Ok(())
            }
            b"endproc" | b"endfunc" | b"endtrap" => {
                if self.routine.take().is_none() {
                    return Err(self.unexpected("a statement"));
                }
                self.context.routine = None;
                self.text_begins(self.token.end);
                self.advance()
            }
            b"record" => {
                while !self.is_word(b"endrecord") {
                    if self.token.kind == Kind::End {
                        return Err(Fault::unclosed(first.start as usize, "record"));
                    }
                    self.advance()?;
                }
                self.advance()
            }
            b"connect" => self.connect(first.start),
            b"alias" => {
                self.advance()?;
                let of = self.type_name();
                self.advance()?;
                if self.token.kind == Kind::Name && of != Type::Other {
                    let name = self.parsed.symbols.intern(self.text(self.token));
                    self.verbs.alias(name, of);
                }
                self.skip_statement()
            }
            word if is_block_word(word) => self.block(first.start, word),
            _ => self.assignment_or_call(),
        }
    }

    /// `CONNECT i1 WITH trap;`
    fn connect(&mut self, start: u32) -> Result<(), Fault> {
        while !self.is_word(b"with") && !matches!(self.token.kind, Kind::Sign(b';') | Kind::End) {
            self.advance()?;
        }
        if self.is_word(b"with") {
            self.advance()?;
            if self.token.kind == Kind::Name {
                let trap = self.parsed.symbols.intern(self.text(self.token));
                self.note(start, StatementKind::Connect(trap));
            }
        }
        self.skip_statement()
    }

    /// What follows `LOCAL`, or a declaration or routine without it; whether it is of the language,
    /// where anything is.
    fn routine_or_data(&mut self, start: u32, local: bool) -> Result<Option<bool>, Fault> {
        let of_task = self.is_word(b"task");
        if of_task {
            self.advance()?;
        }
        let persistent = if local || of_task {
            Storage::Persistent
        } else {
            Storage::Shared
        };
        let mut buffer = [0; KEYWORD];
        match keyword(self.text(self.token), &mut buffer) {
            b"const" => self.declaration(start, local, Storage::Constant).map(Some),
            b"pers" => self.declaration(start, local, persistent).map(Some),
            b"var" => self.declaration(start, local, Storage::Variable).map(Some),
            b"proc" | b"func" | b"trap" => self.open_routine(local).map(|()| Some(true)),
            _ => Ok(None),
        }
    }

    fn open_module(&mut self) -> Result<(), Fault> {
        if let Some(at) = self.module {
            return Err(Fault::unclosed(at as usize, "module"));
        }
        self.module = Some(self.token.start);
        self.advance()?;
        let name = self.name("the name of a module")?;
        if self.token.is(b'(') {
            self.expression()?;
        }
        self.context = outside(self.parsed, Some(name));
        self.text_begins(self.token.start);
        self.recognised = true;
        Ok(())
    }

    fn close_module(&mut self) -> Result<(), Fault> {
        if let Some(at) = self.routine {
            return Err(Fault::unclosed(at as usize, "routine"));
        }
        if self.module.take().is_none() {
            return Err(self.unexpected("a statement"));
        }
        self.context = outside(self.parsed, None);
        self.text_begins(self.token.end);
        self.advance()
    }

    fn open_routine(&mut self, local: bool) -> Result<(), Fault> {
        if let Some(at) = self.routine {
            return Err(Fault::unclosed(at as usize, "routine"));
        }
        self.routine = Some(self.token.start);
        let place = Place::new(self.file, self.token.start);
        let (is_function, is_trap) = (self.is_word(b"func"), self.is_word(b"trap"));
        self.advance()?;
        let mut gives = Type::Other;
        if is_function {
            gives = self.type_name();
            self.name("the type of a function")?;
        }
        let name = self.name("the name of a routine")?;
        let routine = short(self.parsed.routines.len());
        let first = short(self.parsed.data.len());
        self.parsed.routines.push(Routine {
            name,
            module: self.context.module,
            place,
            local,
            gives,
            is_procedure: !is_function && !is_trap,
            is_trap,
            parameters: (first, first),
            has_handler: false,
        });
        self.context.routine = Some(routine);
        self.loops.clear();
        self.text_begins(place.offset);
        if self.token.is(b'(') {
            self.parameters()?;
            let end = short(self.parsed.data.len());
            self.parsed.routines[routine as usize].parameters = (first, end);
        }
        Ok(())
    }

    /// What follows stands in the present context.
    fn text_begins(&mut self, offset: u32) {
        let kind = StatementKind::Text {
            file: self.file,
            context: self.context,
        };
        self.note(offset, kind);
    }

    /// `<SMT>`, where a statement is still to be written.
    fn placeholder(&mut self) -> Result<(), Fault> {
        self.advance()?;
        if self.token.kind == Kind::Name {
            self.advance()?;
        }
        if self.token.is(b'>') {
            self.advance()?;
        }
        Ok(())
    }

    /// `%"Module:Routine"%;`
    fn late_bound_call(&mut self) -> Result<(), Fault> {
        let start = self.token.start;
        self.advance()?;
        let name = self.token;
        while !self.token.is(b'%') && !self.token.is(b';') && self.token.kind != Kind::End {
            self.advance()?;
        }
        let is_text = name.kind == Kind::Text && self.behind == name.end;
        let callee = if is_text {
            Callee::Text(name.start + 1, name.end - 1)
        } else {
            Callee::Late
        };
        if self.token.is(b'%') {
            self.advance()?;
        }
        self.call(start, callee, Verb::Other)
    }

    fn call(&mut self, start: u32, callee: Callee, verb: Verb) -> Result<(), Fault> {
        let arguments = self.arguments(verb)?;
        let end = self.behind;
        if verb != Verb::Harmless {
            let called = Called {
                callee,
                verb,
                arguments,
                end,
            };
            self.note(start, StatementKind::Call(called));
        }
        Ok(())
    }

    pub(super) fn assignment_or_call(&mut self) -> Result<(), Fault> {
        let first = self.token;
        let name = self.parsed.symbols.intern(self.text(first));
        self.advance()?;
        match self.token.kind {
            Kind::Sign(b':') => {
                self.note(first.start, StatementKind::Label(name));
                self.advance()
            }
            Kind::Assign | Kind::Sign(b'{' | b'.') => self.assignment(first.start, name),
            _ => {
                let module = self.context.module;
                let verb = self.verbs.of(name, self.text(first), module);
                self.recognised |= matches!(verb, Verb::Move { .. } | Verb::Mode(..));
                self.call(first.start, Callee::Named(name), verb)?;
                if matches!(verb, Verb::Move { .. }) && verbs::calls(self.text(first)) {
                    self.called_on_the_way(first.start);
                }
                Ok(())
            }
        }
    }

    /// The procedure that the last argument of `MoveLSync` names: it is called in the corner, and may
    /// have run or not where the next statement does.
    fn called_on_the_way(&mut self, start: u32) {
        let name = self.parsed.arguments.last().map(|last| last.expression);
        let callee = match name {
            Some(Expression::Text(from, to)) => Callee::Text(from, to),
            _ => Callee::Late,
        };
        let end = short(self.parsed.arguments.len());
        let called = Called {
            callee,
            verb: Verb::Other,
            arguments: (end, end),
            end: self.behind,
        };
        self.note(start, StatementKind::If(None));
        self.note(start, StatementKind::Call(called));
        self.note(start, StatementKind::EndChoice);
    }

    pub(super) fn note(&mut self, offset: u32, kind: StatementKind) {
        self.parsed.statements.push(Statement { offset, kind });
    }

    /// `name{i}.part := value`; the present token is what follows the name.
    fn assignment(&mut self, start: u32, name: Symbol) -> Result<(), Fault> {
        let index = self.index()?;
        self.parsed.note_place(name, index);
        let path = self.component()?;
        if self.token.kind != Kind::Assign {
            // a call of something like `record.component`: nothing of the language, passed over
            return self.finish_statement();
        }
        self.advance()?;
        let (component, value) = self.assigned(path)?;
        self.end_statement()?;
        self.recognised = self.recognised || component != Component::Whole;
        let kind = StatementKind::Assign {
            name,
            index,
            component,
            value,
        };
        self.note(start, kind);
        Ok(())
    }
}

/// A context outside routines, of its own.
fn outside(parsed: &mut Parsed, name: Option<Symbol>) -> Context {
    parsed.modules.push(name);
    Context {
        module: short(parsed.modules.len() - 1),
        routine: None,
    }
}

/// The byte after a byte order mark and a `%%%` header.
pub(super) fn content_start(bytes: &[u8]) -> Result<usize, Fault> {
    let start = crate::program::kit::content_start(bytes);
    let blanks = bytes[start..]
        .iter()
        .take_while(|b| b.is_ascii_whitespace());
    let header = start + blanks.count();
    if !bytes[header..].starts_with(b"%%%") {
        return Ok(start);
    }
    memchr::memmem::find(&bytes[header + 3..], b"%%%")
        .map(|length| header + length + 6)
        .ok_or_else(|| Fault::unclosed(header, "header"))
}
