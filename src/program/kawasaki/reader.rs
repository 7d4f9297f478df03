//! Programs as statements: blocks, labels, calls, and what they write.

use super::moves::Verb;
use super::remarks::Cause;
use super::sections::{Program, Sections, lines};
use super::targets::{Elements, Name, Position};
use super::words::{Kind, Part, Word, words};
use crate::program::script::{
    Argument, Builder, Call, Expr, Held, How, Place, RoutineId, Script, Start, ValueId, Variable,
    VariableId, Write, Written, short,
};
use crate::program::{Source, SpeedZone};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// A block that is open.
#[derive(Clone, Copy, PartialEq)]
enum Block {
    Choice,
    Loop,
}

/// Where the reader is.
#[derive(Default)]
pub(super) struct Here {
    pub file: u32,
    pub routine: RoutineId,
    /// The byte that the statement begins at.
    pub at: usize,
    /// Names in small letters.
    pub parameters: Vec<Vec<u8>>,
    blocks: Vec<Block>,
    /// Where the robot stands, as far as the text before tells.
    pub last: Option<Position>,
    /// Speed and corner of all moves, and of the next one alone.
    pub always: SpeedZone,
    pub next: Option<SpeedZone>,
    /// Points of the present arc.
    pub arc: usize,
}

pub(super) struct Reader<'a> {
    pub sources: &'a [Source],
    pub builder: Builder,
    /// Names of all programs, and of each.
    pub names: HashMap<Vec<u8>, Elements>,
    pub locals: HashMap<RoutineId, HashMap<Vec<u8>, Elements>>,
    /// Names that a statement writes.
    pub assigned: HashSet<Vec<u8>>,
    programs: HashMap<Vec<u8>, Vec<RoutineId>>,
    /// Parameters of each program.
    parameters: Vec<Vec<Vec<u8>>>,
    pub tool: VariableId,
    pub base: VariableId,
    /// Holds a reason where the arm's configuration was switched, and the index of that in the
    /// script's guards.
    switched: VariableId,
    pub switches: u32,
    /// Configuration data count.
    pub honoured: ValueId,
    pub here: Here,
}

const NOWHERE: Place = Place { file: 0, offset: 0 };

/// The statements of all files.
pub(super) fn script(sources: &[Source], sections: &[Sections]) -> Script {
    let mut builder = Builder::default();
    let honoured = builder.script.value(Held::Flag(true));
    let off = Expr::Value(builder.script.value(Held::Flag(false)));
    let state = |builder: &mut Builder, name: &str, declared: Expr| {
        builder.script.variable(Variable {
            shared: true,
            ..Variable::new(name, NOWHERE, declared)
        })
    };
    let switched = state(&mut builder, "configuration", off);
    builder.script.guards.push([switched].into());
    let mut reader = Reader {
        sources,
        switches: short(builder.script.guards.len() - 1),
        tool: 0,
        base: 0,
        builder,
        names: HashMap::new(),
        locals: HashMap::new(),
        assigned: HashSet::new(),
        programs: HashMap::new(),
        parameters: Vec::new(),
        switched,
        honoured,
        here: Here::default(),
    };
    // what the controller has them at is not in the files
    for (name, is_tool) in [("TOOL", true), ("BASE", false)] {
        let unknown = reader.frame_value(name, None);
        let made = state(&mut reader.builder, name, unknown);
        *(if is_tool {
            &mut reader.tool
        } else {
            &mut reader.base
        }) = made;
    }
    for (file, of) in sections.iter().enumerate() {
        for entry in &of.entries {
            reader.declare(entry, short(file));
        }
        for program in &of.programs {
            reader.note_assigned(&sources[file], program);
            let place = Place {
                file: short(file),
                offset: program.at,
            };
            let name = Source::text(program.name);
            let routine = reader.builder.declare(name, place, Start::Called);
            let name = program.name.to_ascii_lowercase();
            reader.programs.entry(name).or_default().push(routine);
            let parameters = program.parameters.iter();
            let parameters = parameters.map(|name| name.to_ascii_lowercase());
            reader.parameters.push(parameters.collect());
        }
    }
    let mut routine = 0;
    for (file, of) in sections.iter().enumerate() {
        for program in &of.programs {
            reader.program(short(file), routine, program);
            routine += 1;
        }
    }
    let mut script = reader.builder.finish();
    let all = vec![true; script.targets.len()];
    script.keep(&all);
    script
}

/// A label as a number: FNV-1a. Two labels of one program with the same would be one; at 64 bits
/// there are none.
fn key(label: &[u8]) -> u64 {
    let first = 0xcbf2_9ce4_8422_2325_u64;
    label.iter().fold(first, |hash, byte| {
        (hash ^ u64::from(byte.to_ascii_lowercase())).wrapping_mul(0x0100_0000_01b3)
    })
}

impl<'a> Reader<'a> {
    pub(super) fn place(&self, offset: usize) -> Place {
        Place {
            file: self.here.file,
            offset: short(offset),
        }
    }

    /// Notes the names that a program writes, whenever it runs.
    fn note_assigned(&mut self, source: &Source, program: &Program) {
        let mut found = Vec::new();
        for line in lines(&source.bytes, program.lines.clone()) {
            words(line.text, line.start, &mut found);
            let part = Part(&found);
            if part.is_word(0, b"POINT") || part.is_word(0, b"HERE") {
                let name = if part.is(1, b'/') { 3 } else { 1 };
                if let Some((name, _)) = Name::of(part.behind(name)) {
                    self.assigned.insert(name.stem);
                }
            }
        }
    }

    fn program(&mut self, file: u32, routine: RoutineId, program: &Program<'a>) {
        self.here = Here {
            file,
            routine,
            parameters: self.parameters[routine as usize].clone(),
            ..Here::default()
        };
        self.builder.open(routine);
        let sources = self.sources;
        let bytes = &sources[file as usize].bytes;
        let mut found = Vec::new();
        for line in lines(bytes, program.lines.clone()) {
            words(line.text, line.start, &mut found);
            self.line(&found);
        }
        self.builder.close();
    }

    fn line(&mut self, words: &[Word<'a>]) {
        let mut part = Part(words);
        let Some(first) = words.first() else { return };
        if first.kind == Kind::Number || part.is(1, b':') && !first.is_word(b"ANY") {
            self.builder.label(key(first.text));
            self.here.last = None;
            part = part.behind(if part.is(1, b':') { 2 } else { 1 });
        }
        let Some(first) = part.0.first() else { return };
        self.here.at = first.start;
        if let Some(verb) = Verb::of(part) {
            return self.moves(part, verb);
        }
        if !self.flow(part) {
            self.statement(part);
        }
    }

    // ---- blocks and jumps

    /// Whether the words are of the flow.
    fn flow(&mut self, part: Part<'a, '_>) -> bool {
        let has = |word: &[u8]| part.0.iter().any(|one| one.is_word(word));
        let behind = |word: &[u8]| {
            let at = part.0.iter().position(|one| one.is_word(word));
            at.and_then(|at| part.0.get(at + 1))
                .map(|label| key(label.text))
        };
        let is = |word: &[u8]| part.is_word(0, word);
        if is(b"IF") && !has(b"THEN") {
            if let Some(label) = behind(b"GOTO") {
                self.builder.may_go_to(label);
            }
        } else if is(b"IF") {
            self.builder.begin_if();
            self.here.blocks.push(Block::Choice);
        } else if is(b"ELSEIF") {
            self.builder.next_branch(false);
        } else if is(b"ELSE") {
            self.builder.next_branch(true);
        } else if is(b"CASE") || is(b"SCASE") {
            self.builder.begin_choice();
            self.here.blocks.push(Block::Choice);
        } else if is(b"VALUE") || is(b"SVALUE") {
            self.builder.next_branch(false);
        } else if is(b"ANY") && part.is(1, b':') {
            self.builder.next_branch(true);
        } else if is(b"WHILE") || is(b"FOR") {
            self.builder.begin_loop(true);
            self.here.blocks.push(Block::Loop);
        } else if is(b"DO") {
            self.builder.begin_loop(false);
            self.here.blocks.push(Block::Loop);
        } else if is(b"END") || is(b"UNTIL") {
            match self.here.blocks.pop() {
                Some(Block::Loop) => self.builder.end_loop(false),
                Some(Block::Choice) => self.builder.end_choice(),
                None => {}
            }
        } else if is(b"GOTO") {
            if let Some(label) = behind(b"GOTO") {
                if has(b"IF") {
                    self.builder.may_go_to(label);
                } else {
                    self.builder.go_to(label);
                }
            }
        } else if is(b"RETURN") {
            self.builder.back();
        } else if is(b"STOP") || is(b"HALT") {
            self.builder.exit();
        } else {
            return false;
        }
        self.here.last = None;
        true
    }

    // ---- statements

    fn statement(&mut self, part: Part<'a, '_>) {
        let rest = part.behind(1);
        let is = |word: &[u8]| part.is_word(0, word);
        if is(b"TOOL") || is(b"BASE") {
            let value = self.frame(rest);
            let variable = if is(b"TOOL") { self.tool } else { self.base };
            self.write(Written::One(variable), How::Whole(value));
        } else if is(b"SPEED") {
            self.speed(rest);
        } else if is(b"ACCURACY") {
            let zone_m = rest
                .behind(0)
                .0
                .first()
                .and_then(|one| Part(&[*one]).number());
            let zone_m = zone_m.map(|mm| mm * crate::geometry::units::MM);
            self.modal(rest, |of| of.zone_m = zone_m);
        } else if is(b"POINT") {
            self.point(rest);
        } else if is(b"HERE") {
            let here = Expr::Value(self.builder.script.value(Held::Actual));
            if let Some((name, _)) = Name::of(rest) {
                self.write_name(&name, How::Whole(here));
            }
        } else if is(b"CALL") {
            self.call(rest, false);
            self.here.last = None;
        } else if is(b"ON") || is(b"ONI") || is(b"PCEXECUTE") {
            let at = part.0.iter().position(|word| word.is_word(b"CALL"));
            let colon = part.0.iter().position(|word| word.is(b':'));
            if let Some(at) = at.or(colon) {
                self.call(part.behind(at + 1), true);
            }
        } else if SWITCHES.iter().any(|word| is(word)) {
            let remark = self.builder.script.remark(Cause::Switched.remark());
            self.switch(Held::Remark(remark));
        }
    }

    /// The arm's configuration is switched, or known again.
    pub(super) fn switch(&mut self, value: Held) {
        let value = Expr::Value(self.builder.script.value(value));
        self.write(Written::One(self.switched), How::Whole(value));
    }

    fn write(&mut self, variable: Written, how: How) {
        let place = self.place(self.here.at);
        self.builder.write(Write {
            place,
            variable,
            how,
        });
    }

    fn write_name(&mut self, name: &Name, how: How) {
        let written = match name.key {
            Some(_) => Some(Written::One(self.variable(name))),
            None => self.table(name).map(Written::AnyOf),
        };
        if let Some(written) = written {
            self.write(written, how);
        }
    }

    /// `POINT p = …`, `POINT/X p = …`
    fn point(&mut self, part: Part<'a, '_>) {
        let is_partial = part.is(0, b'/');
        let part = part.behind(if is_partial { 2 } else { 0 });
        let Some((name, words)) = Name::of(part) else {
            return;
        };
        let value = part.behind(words + 1);
        if is_partial {
            let remark = self.builder.script.remark(Cause::Computed.remark());
            let how = match value.number() {
                Some(_) => How::PartNumber(remark),
                None => How::PartSomehow(remark),
            };
            return self.write_name(&name, how);
        }
        let position = self.position(value);
        let value = self.expr(position);
        self.write_name(&name, How::Whole(value));
    }

    /// What holds for all moves behind `ALWAYS`, else for the next.
    fn modal(&mut self, part: Part<'a, '_>, set: impl Fn(&mut SpeedZone)) {
        let is_always = part.0.iter().any(|word| word.is_word(b"ALWAYS"));
        if is_always {
            set(&mut self.here.always);
        }
        if let Some(next) = &mut self.here.next {
            set(next);
        } else if !is_always {
            let mut next = self.here.always;
            set(&mut next);
            self.here.next = Some(next);
        }
    }

    /// `SPEED 100 MM/S ALWAYS`
    fn speed(&mut self, part: Part<'a, '_>) {
        let value = part.0.first().and_then(|one| Part(&[*one]).number());
        let unit = |length: &[u8], time: &[u8]| {
            part.is_word(1, length) && part.is(2, b'/') && part.is_word(3, time)
        };
        let m_s = match () {
            () if unit(b"MM", b"S") => Some(1e-3),
            () if unit(b"M", b"S") => Some(1.0),
            () if unit(b"MM", b"MIN") => Some(1e-3 / 60.0),
            () if unit(b"CM", b"MIN") => Some(1e-2 / 60.0),
            () => None,
        };
        let speed_m_s = value.zip(m_s).map(|(value, unit)| value * unit);
        self.modal(part, |of| of.speed_m_s = speed_m_s);
    }

    // ---- calls

    /// `name(a,b)`
    fn call(&mut self, part: Part<'a, '_>, concurrent: bool) {
        let Some(name) = part.0.first() else { return };
        let known = self.programs.get(&name.text.to_ascii_lowercase());
        let callees: Box<[RoutineId]> = known.map_or_else(Box::default, |all| all[..].into());
        let mut arguments = Vec::new();
        if part.is(1, b'(') {
            let (inside, _) = part.behind(1).inside(0);
            for (number, given) in inside.list().into_iter().enumerate() {
                self.argument(given, number, &callees, &mut arguments);
            }
        }
        let place = self.place(self.here.at);
        let script = &mut self.builder.script;
        let first = short(script.arguments.len());
        script.arguments.extend(arguments);
        let call = Call {
            place,
            foreign: callees.is_empty(),
            callees,
            name: Source::text(name.text).into(),
            arguments: first..short(script.arguments.len()),
        };
        if concurrent {
            for routine in &*call.callees {
                self.builder.script.routines[*routine as usize].start = Start::Concurrent;
            }
            self.builder.start(call);
        } else {
            self.builder.call(call);
        }
    }

    fn argument(
        &mut self,
        given: Part<'a, '_>,
        number: usize,
        callees: &[RoutineId],
        arguments: &mut Vec<Argument>,
    ) {
        let name = Name::of(given);
        let name = name.filter(|(_, words)| *words == given.0.len());
        let position = name.filter(|(name, _)| self.is_known(name));
        let value = match &position {
            Some(_) => {
                let position = self.position(given);
                self.expr(position)
            }
            None if callees.is_empty() => return,
            None => self.unknown(Cause::Computed.remark()),
        };
        let back = match value {
            Expr::Variable(variable) => Some(variable),
            _ => None,
        };
        if callees.is_empty() {
            arguments.push(Argument {
                parameter: None,
                value,
                back: None,
            });
        }
        for &callee in callees {
            let Some(name) = self.parameters[callee as usize].get(number).cloned() else {
                continue;
            };
            // a parameter that is joints has its sign in the program that uses it
            let stems = [name.clone(), [b"#", &name[..]].concat()];
            for stem in stems {
                let caller = std::mem::replace(&mut self.here.routine, callee);
                let own = self.parameters[callee as usize].clone();
                let before = std::mem::replace(&mut self.here.parameters, own);
                let parameter = self.variable(&Name {
                    stem,
                    key: Some(Vec::new()),
                });
                self.here.routine = caller;
                self.here.parameters = before;
                arguments.push(Argument {
                    parameter: Some(parameter),
                    value,
                    back,
                });
            }
        }
    }
}

/// Words that switch the arm's configuration.
const SWITCHES: &[&[u8]] = &[
    b"LEFTY", b"RIGHTY", b"ABOVE", b"BELOW", b"UWRIST", b"DWRIST",
];
