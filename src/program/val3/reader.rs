//! Programs as statements: blocks, calls, and what they write.

use super::data::Kind;
use super::line::{Index, Line, Reference};
use super::project::World;
use super::remarks::{computed, frame_assigned, library};
use super::targets::{Place as Found, Variables};
use super::tokens::{self, Statements};
use crate::program::Source;
use crate::program::script::{
    Argument, Builder, Call, Expr, Held, How, Place, RoutineId, Script, Start, VariableId, Write,
    Written, short,
};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// Built-in instructions, and which of their arguments they write.
///
/// # Source
/// Staubli, "VAL 3 Reference Manual", version 7, chapters on points, joints, frames, tools and on
/// collections. *Not verified on a controller.*
const WRITES: &[(&[u8], usize)] = &[
    (b"pointToJoint", 3),
    (b"setFrame", 3),
    (b"link", 0),
    (b"resize", 0),
    (b"append", 0),
    (b"insert", 0),
    (b"delete", 0),
];

/// The argument that a built-in instruction writes.
pub(super) fn written_argument(name: &[u8]) -> Option<usize> {
    let known = WRITES.iter().find(|(known, _)| *known == name);
    known.map(|(_, argument)| *argument)
}

/// A block that is open, for `break`.
#[derive(Clone, Copy)]
enum Block {
    If,
    Loop,
    /// The key of the label behind it.
    Switch(u64),
}

/// Where the reader is.
#[derive(Default)]
pub(super) struct Here {
    pub project: u32,
    pub routine: RoutineId,
    pub file: u32,
    blocks: Vec<Block>,
    switches: u64,
}

pub(super) struct Reader<'a> {
    pub sources: &'a [Source],
    pub world: World<'a>,
    pub builder: Builder,
    pub variables: Variables<'a>,
    /// Frames, transformations, descriptors and tools that the running program changes, by index
    /// in [`World::data`].
    pub assigned: HashSet<u32>,
    /// What each variable may be a copy of.
    pub copies: HashMap<VariableId, Vec<VariableId>>,
    /// Instructions, and the variables that their points are of.
    pub roots: Vec<(u32, Vec<VariableId>)>,
    pub here: Here,
}

/// The statements of all programs.
pub(super) fn script<'a>(sources: &'a [Source], world: World<'a>) -> Script {
    let mut builder = Builder::default();
    let variables = Variables::of(&mut builder, &world);
    let mut reader = Reader {
        sources,
        world,
        builder,
        variables,
        assigned: HashSet::new(),
        copies: HashMap::new(),
        roots: Vec::new(),
        here: Here::default(),
    };
    for program in &reader.world.programs {
        let place = Place {
            file: program.file,
            offset: program.at,
        };
        let name = Source::text(program.name);
        reader.builder.declare(name, place, Start::Called);
    }
    let count = reader.world.programs.len();
    (0..count).for_each(|program| reader.program(program, Reader::note_assigned));
    for program in 0..count {
        reader.builder.open(short(program));
        reader.program(program, Reader::statement);
        reader.builder.close();
    }
    reader.finish()
}

impl<'a> Reader<'a> {
    /// Each statement of a program.
    fn program(&mut self, program: usize, each: fn(&mut Self, Line<'a, '_>)) {
        let of = &self.world.programs[program];
        let bytes = &self.sources[of.file as usize].bytes;
        let mut statements = Statements::of(bytes, &of.code, of.is_escaped);
        self.here = Here {
            project: self.world.project_of_program[program],
            routine: short(program),
            file: of.file,
            ..Here::default()
        };
        let mut tokens = Vec::new();
        while statements.next(&mut tokens) {
            let tokens = &tokens[..];
            each(self, Line { bytes, tokens });
        }
    }

    pub(super) fn place(&self, offset: usize) -> Place {
        Place {
            file: self.here.file,
            offset: short(offset),
        }
    }

    // ---- what is changed anywhere

    /// Notes what a statement changes, whenever it runs.
    fn note_assigned(&mut self, line: Line<'a, '_>) {
        if let Some(target) = line.reference(0)
            && line.is(target.words, b'=')
        {
            self.note(&target);
        }
        for at in 0..line.tokens.len() {
            if !(line.is_name(at) && line.is(at + 1, b'(')) {
                continue;
            }
            let (arguments, _) = line.list(at + 1);
            if let Some(argument) = written_argument(line.text(at)) {
                let found = arguments.get(argument).and_then(|one| one.reference(0));
                if let Some(target) = found {
                    self.note(&target);
                }
            } else if let Some((callee, _)) = self.callee(&line, at) {
                for (number, argument) in arguments.iter().enumerate() {
                    let by_reference = callee.is_none_or(|callee| {
                        let declared = &self.world.programs[callee as usize].declared;
                        let mut parameters = declared.iter().filter(|one| one.is_parameter);
                        let parameter = parameters.nth(number);
                        parameter.is_none_or(|parameter| parameter.by_reference)
                    });
                    if let Some(target) = argument.reference(0).filter(|_| by_reference) {
                        self.note(&target);
                    }
                }
            }
        }
    }

    fn note(&mut self, target: &Reference<'a>) {
        if let Found::Datum(datum) = self.meaning(target) {
            self.assigned.insert(datum);
        }
    }

    /// The program that a call at a word calls, and its name; the program is `None` where the files
    /// do not have it.
    fn callee(&self, line: &Line<'a, '_>, at: usize) -> Option<(Option<RoutineId>, &'a [u8])> {
        let (project, first) = if at >= 2 && line.is(at - 1, b':') {
            (
                self.world.library(self.here.project, line.text(at - 2)),
                at - 2,
            )
        } else {
            (Some(self.here.project), at)
        };
        let is_call = first > 0 && line.text(first - 1) == b"call";
        let is_task = line.text(0).starts_with(b"taskCreate") && line.is_name(0);
        if !(is_call || is_task && first > 1) {
            return None;
        }
        let name = line.text(at);
        let known = project.and_then(|project| {
            let programs = &self.world.projects[project as usize].programs;
            programs.get(name).copied()
        });
        Some((known, name))
    }

    // ---- statements

    fn statement(&mut self, line: Line<'a, '_>) {
        match line.text(0) {
            b"begin" | b"end" => {}
            b"if" => {
                self.uses(&line);
                self.builder.begin_if();
                self.here.blocks.push(Block::If);
            }
            b"elseIf" => self.builder.next_branch(false),
            b"else" => self.builder.next_branch(true),
            b"while" | b"for" => {
                self.builder.begin_loop(true);
                self.here.blocks.push(Block::Loop);
            }
            b"do" => {
                self.builder.begin_loop(false);
                self.here.blocks.push(Block::Loop);
            }
            b"endWhile" | b"endFor" | b"until" => {
                self.uses(&line);
                self.builder.end_loop(false);
                self.here.blocks.pop();
            }
            b"switch" => {
                self.here.switches += 1;
                self.builder.begin_choice();
                self.here.blocks.push(Block::Switch(self.here.switches));
            }
            b"case" => self.builder.next_branch(false),
            b"default" => self.builder.next_branch(true),
            b"endIf" | b"endSwitch" => {
                self.builder.end_choice();
                if let Some(Block::Switch(key)) = self.here.blocks.pop() {
                    self.builder.label(key);
                }
            }
            b"break" => self.leave(),
            b"return" => self.builder.back(),
            b"call" => self.call(&line),
            first if first.starts_with(b"taskCreate") => self.call(&line),
            _ => {
                self.uses(&line);
                self.assignment(&line);
            }
        }
    }

    /// `break`: behind the innermost loop or switch.
    fn leave(&mut self) {
        for block in self.here.blocks.iter().rev() {
            match *block {
                Block::If => {}
                Block::Loop => return self.builder.leave_loop(),
                Block::Switch(key) => return self.builder.go_to(key),
            }
        }
    }

    /// Moves and built-in instructions of a statement.
    fn uses(&mut self, line: &Line<'a, '_>) {
        for at in 0..line.tokens.len() {
            if !(line.is_name(at) && line.is(at + 1, b'(')) {
                continue;
            }
            let name = line.text(at);
            if let Some(verb) = super::moves::Verb::of(name) {
                self.moves(line, at, verb);
            } else if name == b"libLoad" {
                self.load(line, at);
            } else if let Some(argument) = written_argument(name) {
                let (arguments, _) = line.list(at + 1);
                let found = arguments.get(argument).and_then(|one| one.reference(0));
                if let Some(target) = found {
                    self.write_something(&target, line.tokens[0].start, name == b"link");
                }
            }
        }
    }

    /// `alias:libLoad(path)`
    fn load(&mut self, line: &Line<'a, '_>, at: usize) {
        let alias = if at >= 2 { line.text(at - 2) } else { b"" };
        let (arguments, _) = line.list(at + 1);
        let path = arguments.first().filter(|path| path.tokens.len() == 1);
        let literal = path.filter(|path| path.tokens[0].kind == tokens::Kind::Text);
        let path = literal.map(|path| {
            let text = path.text(0);
            let text = text.strip_prefix(b"&quot;").unwrap_or(text);
            text.strip_suffix(b"&quot;").unwrap_or(text)
        });
        let is_known = path.is_some_and(|path| {
            let path = path.trim_ascii_start().strip_prefix(b"\"").unwrap_or(path);
            let path = path.strip_suffix(b"\"").unwrap_or(path);
            let found = self.world.at_path(self.here.project, path);
            found.is_some() && found == self.world.library(self.here.project, alias)
        });
        if is_known {
            return;
        }
        let place = self.place(line.tokens[0].start);
        let name = match path {
            Some(path) => format!("library {} ({})", Source::text(alias), Source::text(path)),
            None => format!("library {}", Source::text(alias)),
        };
        let remark = library(&name);
        let source = &self.sources[place.file as usize];
        let (offset, id) = (place.offset as usize, remark.id);
        let text = remark.text.into_string();
        let finding = source.finding(offset, id, remark.severity, text, remark.hint);
        self.builder.script.findings.push(finding);
    }

    /// `name = …`
    fn assignment(&mut self, line: &Line<'a, '_>) {
        let Some(target) = line.reference(0) else {
            return;
        };
        if !line.is(target.words, b'=') {
            return;
        }
        let kind = self.kind_of(&target);
        if !(kind.is_place() || kind == Kind::Tool) {
            return;
        }
        let value = line.part(target.words + 1..line.tokens.len());
        let offset = line.tokens[0].start;
        if target.has_field {
            if kind == Kind::Tool {
                return self.write_something(&target, offset, false);
            }
            let remark = self.builder.script.remark(computed());
            let text = match (value.tokens.first(), value.tokens.last()) {
                (Some(first), Some(last)) => &line.bytes[first.start..last.end],
                _ => b"",
            };
            return self.write(&target, offset, How::part(text, remark));
        }
        let (value, of) = match kind {
            Kind::Tool => self.tool(&value),
            Kind::Joint => match self.joints(&value) {
                Some(joints) => (joints, Vec::new()),
                None => self.position(&value),
            },
            _ => self.position(&value),
        };
        for variable in self.variables_of(&target) {
            self.copies.entry(variable).or_default().extend(&of);
        }
        self.write(&target, offset, How::Whole(value));
    }

    /// A built-in instruction changes something in a manner of its own.
    fn write_something(&mut self, target: &Reference<'a>, offset: usize, relinks: bool) {
        let remark = match self.kind_of(target) {
            Kind::Tool => frame_assigned(&Source::text(target.name)),
            Kind::Point if relinks => frame_assigned(&Source::text(target.name)),
            kind if kind.is_place() => computed(),
            _ => return,
        };
        let value = Expr::Unknown(self.builder.script.remark(remark));
        self.write(target, offset, How::Whole(value));
    }

    fn write(&mut self, target: &Reference<'a>, offset: usize, how: How) {
        let place = self.place(offset);
        if let Some(variable) = self.written_by(target) {
            self.builder.write(Write {
                place,
                variable,
                how,
            });
        }
    }

    // ---- calls

    /// `call alias:name(a,b)`, `taskCreate "name",100,name(a)`
    fn call(&mut self, line: &Line<'a, '_>) {
        let Some(at) = (0..line.tokens.len()).find(|at| {
            line.is_name(*at) && line.is(at + 1, b'(') && self.callee(line, *at).is_some()
        }) else {
            return;
        };
        let (callee, name) = self.callee(line, at).expect("it was found");
        let (given, _) = line.list(at + 1);
        let place = self.place(line.tokens[0].start);
        let mut arguments = Vec::new();
        let mut arrays = Vec::new();
        for (number, value) in given.iter().enumerate() {
            let Some(target) = value.reference(0) else {
                self.literal_argument(callee, number, &mut arguments);
                continue;
            };
            let kind = self.kind_of(&target);
            if !(kind.is_place() || kind == Kind::Tool) || target.words != value.tokens.len() {
                self.literal_argument(callee, number, &mut arguments);
                continue;
            }
            let (value, of) = match kind {
                Kind::Tool => self.tool(value),
                _ => self.position(value),
            };
            let parameter = callee.and_then(|callee| self.variables.parameter(callee, number));
            let is_written = callee.is_none() || parameter.is_some_and(|one| one.by_reference);
            let back = match value {
                Expr::Variable(variable) if is_written => Some(variable),
                _ => None,
            };
            if let Some(parameter) = parameter {
                let entry = self.copies.entry(parameter.variable).or_default();
                entry.extend(of);
                if parameter.by_reference && parameter.is_array {
                    arrays.push(target);
                }
            }
            arguments.push(Argument {
                parameter: parameter.map(|one| one.variable),
                value,
                back: back.filter(|_| callee.is_some()),
            });
        }
        let script = &mut self.builder.script;
        let first = short(script.arguments.len());
        script.arguments.extend(arguments);
        let call = Call {
            place,
            callees: callee.iter().copied().collect(),
            foreign: callee.is_none(),
            name: Source::text(name).into(),
            arguments: first..short(script.arguments.len()),
        };
        if line.text(0) == b"call" {
            self.builder.call(call);
        } else {
            for routine in &*call.callees {
                self.builder.script.routines[*routine as usize].start = Start::Concurrent;
            }
            self.builder.start(call);
        }
        // the other values of an array that is given with all of them
        for target in arrays {
            let target = Reference {
                index: Index::Any,
                ..target
            };
            self.builder.begin_if();
            self.write_something(&target, line.tokens[0].start, false);
            self.builder.end_choice();
        }
    }

    /// Whatever is given: what another call gave is there no more.
    fn literal_argument(
        &mut self,
        callee: Option<RoutineId>,
        number: usize,
        arguments: &mut Vec<Argument>,
    ) {
        let parameter = callee.and_then(|callee| self.variables.parameter(callee, number));
        if let Some(parameter) = parameter {
            let value = Expr::Unknown(self.builder.script.remark(computed()));
            arguments.push(Argument {
                parameter: Some(parameter.variable),
                value,
                back: None,
            });
        }
    }

    /// A value of the script.
    pub(super) fn value(&mut self, value: Held) -> Expr {
        Expr::Value(self.builder.script.value(value))
    }

    /// What is written where a name stands to the left.
    pub(super) fn written_by(&mut self, target: &Reference<'a>) -> Option<Written> {
        match self.slot(target) {
            super::targets::Slot::One(variable) => Some(Written::One(variable)),
            super::targets::Slot::Any(table) => Some(Written::AnyOf(table)),
            super::targets::Slot::Nothing(_) => None,
        }
    }
}
