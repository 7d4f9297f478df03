//! Programs as statements: blocks, calls, and what they write.

use super::arrays::Arrays;
use super::code::{Code, Reference};
use super::data::{Kind, POSE};
use super::frames::{Composed, Framing};
use super::moves::Verb;
use super::numbers::{axis, turned_by_any};
use super::project::{Program, World};
use super::remarks::{COMPUTED, REORDERED, frame_assigned, library};
use super::targets::{Known, Of, Variables};
use crate::program::Source;
use crate::program::contexts::Calls;
use crate::program::displacing::grown_by_any;
use crate::program::notation::mentions;
use crate::program::script::{
    Argument, Builder, Call, Expr, Held, How, Place, RoutineId, Script, Start, Tests, UNBOUNDED,
    VariableId, Written, short,
};
use crate::program::transformations::{EACH, Entries};
use crate::program::words::{self, Words, unquoted};
use foldhash::{HashMap, HashSet};

/// Built-in instructions, and which of their arguments they write.
///
/// # Source
/// Staubli, "VAL 3 Reference Manual", version 7, chapters on points, joints, frames, tools and on
/// collections. *Not verified on a controller.*
const WRITES: &[(&[u8], usize)] = &[
    (b"pointToJoint", 3),
    (b"setFrame", 3),
    (b"link", 0),
    (b"getLatch", 0),
    (b"toNum", 1),
    (b"sioGet", 1),
    (b"get", 0),
    (b"fromBinary", 3),
    (b"resize", 0),
    (b"insert", 0),
    (b"delete", 0),
];
/// Those of them after which values have other keys.
const REORDER: &[&[u8]] = &[b"resize", b"insert", b"delete"];

/// The argument that a built-in instruction writes.
pub(super) fn written_argument(name: &[u8]) -> Option<usize> {
    let known = WRITES.iter().find(|(known, _)| *known == name);
    known.map(|(_, argument)| *argument)
}

/// Where the reader is.
#[derive(Default)]
pub(super) struct Here {
    pub project: u32,
    pub routine: RoutineId,
    pub file: u32,
    /// The byte that the statement begins at.
    pub at: u32,
}

#[derive(Default)]
pub(super) struct Reader<'a> {
    pub sources: &'a [Source],
    pub world: World<'a>,
    pub builder: Builder,
    pub variables: Variables<'a>,
    /// Frames, transformations, descriptors and tools that the running program changes, by index
    /// in [`World::data`], and where first.
    pub assigned: HashMap<u32, Place>,
    /// Arrays of data that programs fill by an index that only the running program knows.
    pub filled_anywhere: HashSet<u32>,
    /// Values of data that programs write, by key.
    filled: Vec<(Known, &'a [u8])>,
    /// What each variable may be a copy of.
    pub copies: HashMap<VariableId, Vec<VariableId>>,
    pub arrays: Arrays<'a>,
    /// Nothing new was found about arrays.
    pub is_settled: bool,
    pub composed: Vec<Composed<'a>>,
    /// Points that `setFrame` makes frames of.
    pub framing: Vec<Framing>,
    /// Frames that programs name elsewhere, where any is made so.
    pub named_frames: HashSet<u32>,
    /// Tools and frames that the files do not have: what they are asked for by, what has them, and
    /// the project that asks.
    pub asked: Vec<(Expr, (String, String), u32)>,
    /// What numbers and transformations are.
    pub entries: Entries<'a>,
    /// Which calls of programs say by what these displace.
    pub by_calls: Calls,
    pub here: Here,
}

/// The statements of all programs.
pub(super) fn script<'a>(sources: &'a [Source], mut world: World<'a>) -> Script {
    let code = |program: &Program| {
        let bytes = &sources[program.file as usize].bytes;
        Code::of(bytes, program.code.clone(), program.is_escaped)
    };
    let codes: Vec<Code<'a>> = world.programs.iter().map(code).collect();
    let mut declared = world.programs.iter().flat_map(|program| &program.declared);
    let takes_arrays = declared.any(|one| one.is_parameter && one.is_array);
    let mut builder = Builder::default();
    builder.script.findings.append(&mut world.findings);
    let variables = Variables::of(&mut builder, &world);
    let mut reader = Reader {
        sources,
        world,
        builder,
        variables,
        is_settled: !takes_arrays,
        ..Reader::default()
    };
    for program in &reader.world.programs {
        let place = Place::new(program.file, program.at);
        let name = Source::text(program.name);
        reader.builder.declare(name, place, Start::Called);
    }
    reader.declare_numbers();
    for (program, code) in codes.iter().enumerate() {
        reader.entries.begin(short(program));
        reader.program(program, code, Reader::note_assigned);
    }
    reader.entries.finish();
    // an index that only the running program knows may be any that some program writes
    for (known, key) in std::mem::take(&mut reader.filled) {
        reader.element(known, key);
    }
    while !std::mem::replace(&mut reader.is_settled, true) {
        for (program, code) in codes.iter().enumerate() {
            reader.program(program, code, Reader::note_given);
        }
    }
    for (program, code) in codes.iter().enumerate() {
        reader.builder.open(short(program));
        reader.program(program, code, Reader::statement);
        reader.builder.close();
    }
    reader.finish()
}

impl<'a> Reader<'a> {
    /// Each statement of a program.
    fn program(&mut self, program: usize, code: &Code<'a>, each: fn(&mut Self, Words<'a, '_>)) {
        let of = &self.world.programs[program];
        self.here = Here {
            project: of.project,
            routine: short(program),
            file: of.file,
            at: 0,
        };
        for statement in code.statements() {
            self.here.at = short(statement.span().start);
            each(self, statement);
        }
    }

    pub(super) fn place(&self, offset: usize) -> Place {
        Place::new(self.here.file, short(offset))
    }

    // ---- what is changed anywhere

    /// Notes what a statement changes, whenever it runs.
    fn note_assigned(&mut self, line: Words<'a, '_>) {
        self.tell(line);
        // `for n=0 to 3` writes what it counts with
        let set = line.behind(usize::from(line.text(0) == b"for"));
        if let Some(target) = Reference::of(set)
            && set.is(target.words, b'=')
        {
            self.note(&target);
        }
        for at in functions(line) {
            let (known, callee) = (written_argument(line.text(at)), self.callee(line, at));
            if known.is_none() && callee.is_none() {
                continue;
            }
            for (number, given) in line.inside(at + 1).0.list().into_iter().enumerate() {
                let parameter = callee.and_then(|(callee, _)| self.parameter(callee?, number));
                let is_written = match known {
                    Some(argument) => argument == number,
                    None => parameter.is_none_or(|parameter| parameter.by_reference),
                };
                let is_array = parameter.is_some_and(|parameter| parameter.is_array);
                if let Some(target) = Reference::of(given).filter(|_| is_written) {
                    self.note(&target);
                    if is_array {
                        self.note(&Reference {
                            key: None,
                            ..target
                        });
                    }
                }
            }
        }
    }

    fn note(&mut self, target: &Reference<'a>) {
        let Some(known) = self.meaning(target) else {
            return;
        };
        if let Of::Project(datum) = known.of {
            let place = self.place(self.here.at as usize);
            self.assigned.entry(datum).or_insert(place);
            if target.key.is_none() && !target.has_field {
                self.filled_anywhere.insert(datum);
            }
            if known.kind.is_place() || known.kind == Kind::Tool {
                self.filled.extend(target.key.map(|key| (known, key)));
            }
        }
    }

    /// The program that a call at a word calls, and its name; the program is `None` where the files
    /// do not have it.
    pub(super) fn callee(
        &self,
        line: Words<'a, '_>,
        at: usize,
    ) -> Option<(Option<RoutineId>, &'a [u8])> {
        let has_alias = at >= 2 && line.is(at - 1, b':');
        let first = if has_alias { at - 2 } else { at };
        let alias = if has_alias { line.text(first) } else { b"" };
        let is_call = first > 0 && line.text(first - 1) == b"call";
        let is_task = line.text(0).starts_with(b"taskCreate") && line.is_name(0);
        let name = line.text(at);
        (is_call || is_task && first > 1)
            .then(|| (self.world.program(self.here.project, alias, name), name))
    }

    /// The number that a call gives.
    fn number_given(&mut self, words: Words<'a, '_>) -> Expr {
        if let Some(number) = words.whole_number() {
            return self.builder.script.held(Held::Number(number));
        }
        let given = self.given_number(words).map(Expr::Variable);
        // whatever it is: what another call gave is there no more
        given.unwrap_or_else(|| self.unknown(COMPUTED))
    }

    // ---- statements

    fn statement(&mut self, line: Words<'a, '_>) {
        match line.text(0) {
            b"begin" | b"end" => {}
            b"if" => {
                self.uses(line);
                let tests = self.tests(line.behind(1));
                self.builder.begin_if(tests);
            }
            b"switch" => {
                self.uses(line);
                let of = self.given_number(line.behind(1));
                self.builder.begin_switch(of);
            }
            // what a head does counts in all branches behind it, too
            b"elseIf" => {
                self.builder.next_branch(true);
                self.uses(line);
                let tests = self.tests(line.behind(1));
                self.builder.pass_branch(tests);
            }
            b"case" => {
                self.builder.next_branch(true);
                self.uses(line);
                self.builder.pass_cases(&line.behind(1).whole_numbers());
            }
            b"else" | b"default" => self.builder.next_branch(true),
            b"endIf" | b"endSwitch" => self.builder.end_choice(),
            b"while" => {
                self.builder.begin_loop(false);
                self.uses(line);
                self.builder.begin_if(None);
                self.builder.leave_loop();
                self.builder.end_choice();
            }
            b"for" => {
                self.uses(line);
                let most = self.rounds();
                self.builder.begin_rounds(true, most);
            }
            b"do" => self.builder.begin_loop(false),
            b"endWhile" | b"endFor" | b"until" => {
                self.uses(line);
                self.builder.end_loop(false);
            }
            b"break" => self.builder.leave_block(),
            b"return" => {
                self.uses(line);
                self.builder.back();
            }
            b"call" => self.call(line),
            first if first.starts_with(b"taskCreate") => self.call(line),
            _ => {
                self.uses(line);
                self.assignment(line);
            }
        }
    }

    /// What a condition asks of numbers that calls give.
    fn tests(&mut self, words: Words<'a, '_>) -> Tests {
        words.compared().map(&mut |compared| {
            let (name, wanted) = (*compared)?;
            Some((self.given_number(name)?, wanted))
        })
    }

    /// The parameter that words are where it is a number that nothing but calls writes.
    fn given_number(&mut self, words: Words<'a, '_>) -> Option<VariableId> {
        let routine = self.here.routine;
        let name = Reference::whole(words).filter(|name| name.words == 1)?;
        let declared = self.world.programs[routine as usize].declared.iter();
        let own = declared.filter(|one| one.is_parameter && !one.is_array && one.kind == Kind::Num);
        let own = own.map(|one| one.name).find(|own| *own == name.name)?;
        let number = self.variables.table_of_local(routine, own) * EACH;
        let is_only_given = self.entries.is_only_given(number);
        is_only_given.then(|| self.local(routine, own))
    }

    /// Moves and built-in instructions of a statement.
    fn uses(&mut self, line: Words<'a, '_>) {
        self.note_frames(line);
        for at in functions(line) {
            let name = line.text(at);
            if let Some(verb) = Verb::of(name) {
                self.moves(line, at, verb);
            } else if name == b"libLoad" {
                self.load(line, at);
            } else if name == b"setFrame" {
                self.set_frame(line, at);
            } else if let Some(argument) = written_argument(name) {
                let given = line.inside(at + 1).0.list();
                let target = given.get(argument).and_then(|one| Reference::of(*one));
                if let Some(target) = target {
                    let (offset, relinks) = (line.span().start, name == b"link");
                    if REORDER.contains(&name) && self.kind_of(&target).is_place() {
                        self.reorder(&target, offset);
                    } else {
                        self.write_something(&target, offset, relinks);
                    }
                }
            }
        }
    }

    /// `alias:libLoad(path)`
    fn load(&mut self, line: Words<'a, '_>, at: usize) {
        let alias = if at >= 2 { line.text(at - 2) } else { b"" };
        let given = line.inside(at + 1).0.list();
        let is_literal = |path: &&Words| path.len() == 1 && path.kind(0) == Some(words::Kind::Text);
        let path = given
            .first()
            .filter(is_literal)
            .map(|path| unquoted(path.text(0)));
        let found = path.and_then(|path| self.world.at_path(self.here.project, path));
        if found.is_some() && found == self.world.library(self.here.project, alias) {
            return;
        }
        let place = self.place(line.span().start);
        let name = match path {
            Some(path) => format!(
                "library {} (\"{}\")",
                Source::text(alias),
                Source::text(path)
            ),
            None => format!("library {}", Source::text(alias)),
        };
        let script = &mut self.builder.script;
        script.say(self.sources, place, library(&name));
    }

    /// `name = …`
    fn assignment(&mut self, line: Words<'a, '_>) {
        let Some(target) = Reference::of(line).filter(|target| line.is(target.words, b'=')) else {
            return;
        };
        let kind = self.kind_of(&target);
        if !(kind.is_place() || kind == Kind::Tool) {
            return;
        }
        let value = line.behind(target.words + 1);
        let offset = line.span().start;
        if target.has_field {
            if kind == Kind::Tool {
                return self.write_something(&target, offset, false);
            }
            let how = self.part_becomes(line.part(0..target.words), value);
            return self.write(&target, offset, how);
        }
        let value = self.given(kind, value);
        let of = self.roots(value);
        if kind != Kind::Tool {
            for variable in self.variables_of(&target) {
                self.copies.entry(variable).or_default().extend(&of);
            }
        }
        self.write(&target, offset, How::Whole(value));
    }

    /// The tool or position that words are.
    fn given(&mut self, kind: Kind, value: Words<'a, '_>) -> Expr {
        match kind {
            Kind::Tool => self.tool(value),
            Kind::Joint => (self.joints(value)).unwrap_or_else(|| self.position(value)),
            _ => self.position(value),
        }
    }

    /// What `p.trsf.z=` makes of a point: it displaces it by 200 mm where `p.trsf.z+200` is behind
    /// it, or that of the point that it is a copy of.
    fn part_becomes(&mut self, field: Words<'a, '_>, value: Words<'a, '_>) -> How {
        let letters = |text: &[u8]| -> Vec<u8> {
            let letters = text.iter().filter(|b| !b.is_ascii_whitespace());
            letters.copied().collect()
        };
        let remark = self.builder.script.remark(COMPUTED);
        let own = letters(field.whole());
        let last = field.len().checked_sub(3);
        let last = last.filter(|last| field.text(*last) == b"trsf");
        let at = last.and_then(|last| axis(field.text(last + 2)));
        let found = self.term_and_rest(value.whole(), letters);
        if let (Some(at), Some((term, by))) = (at, found) {
            let displacement = match at {
                0..=2 => grown_by_any(at, by),
                // Rx · Ry · Rz
                _ => turned_by_any(&by),
            };
            if term == own {
                return match displacement {
                    Some(by) => self.builder.script.part_by(remark, by),
                    None => How::part(true, at > 2, remark),
                };
            }
            let is_same = term.ends_with(&[b".trsf.", POSE[at].as_bytes()].concat());
            let others = (0..value.len()).filter_map(|start| {
                let other = Reference::of(value.behind(start))?;
                let end = start + other.words;
                let is_it = other.words > 4 && letters(value.part(start..end).whole()) == term;
                is_it.then(|| value.part(start..end - 4))
            });
            let other = others.into_iter().next().filter(|_| is_same && at < 3);
            if let (Some(other), Some(by)) = (other, displacement) {
                let of = self.given(Kind::Point, other);
                let by = self.builder.script.displacement(by);
                return How::PartOf {
                    remark,
                    of,
                    axis: at,
                    by,
                };
            }
        }
        if mentions(&letters(value.whole()), &own) {
            // worked out of itself in a way that is not followed
            How::PartBy(remark, UNBOUNDED)
        } else {
            How::PartNumber(remark)
        }
    }

    /// A built-in instruction changes something in a manner of its own.
    fn write_something(&mut self, target: &Reference<'a>, offset: usize, relinks: bool) {
        let remark = match self.kind_of(target) {
            Kind::Tool => frame_assigned(&Source::text(target.name), None),
            // its numbers are in another frame then
            Kind::Point if relinks => {
                let remark = self.builder.script.remark(COMPUTED);
                return self.write(target, offset, How::PartSomehow(remark));
            }
            kind if kind.is_place() => COMPUTED,
            _ => return,
        };
        let value = self.unknown(remark);
        self.write(target, offset, How::Whole(value));
    }

    /// The values of an array get other keys: each of them may be any.
    fn reorder(&mut self, target: &Reference<'a>, offset: usize) {
        let Some(known) = self.meaning(target) else {
            return;
        };
        let table = self.all(known, target.name);
        let value = self.unknown(REORDERED);
        let place = self.place(offset);
        let entries = &self.builder.script.tables[table as usize].entries;
        let all: Vec<VariableId> = entries.values().copied().collect();
        for variable in all {
            let how = How::Whole(value);
            (self.builder).write(place, Written::One(variable), how);
        }
        self.builder.script.refuse_all(table, REORDERED);
    }

    fn write(&mut self, target: &Reference<'a>, offset: usize, how: How) {
        let place = self.place(offset);
        if let Ok(variable) = self.written_by(target) {
            self.builder.write(place, variable, how);
        }
    }

    // ---- calls

    /// `call alias:name(a,b)`, `taskCreate "name",100,name(a)`
    fn call(&mut self, line: Words<'a, '_>) {
        let mut calls = functions(line).map(|at| (at, self.callee(line, at)));
        let Some((at, (callee, name))) = calls.find_map(|(at, called)| Some((at, called?))) else {
            return;
        };
        let given = line.inside(at + 1).0;
        self.uses(given);
        let given = given.list();
        let (mut arguments, mut written, mut chosen) = (Vec::new(), Vec::new(), Vec::new());
        for (number, value) in given.into_iter().enumerate() {
            let parameter =
                callee.and_then(|callee| Some((callee, self.parameter(callee, number)?)));
            let target = Reference::of(value).filter(|name| name.words == value.len());
            // of what is no name, such as `appro(p,{…})`, the parameter says it
            let kind = match (target, parameter) {
                (Some(target), _) => self.kind_of(&target),
                (None, None) if matches!(value.text(0), b"appro" | b"compose") => Kind::Point,
                (None, parameter) => parameter.map_or(Kind::Other, |(_, one)| one.kind),
            };
            let is_given = kind.is_place() || kind == Kind::Tool;
            if let Some(parameter) = parameter.filter(|(_, one)| one.is_array && is_given) {
                if !self.give_array(parameter, value, &mut arguments) && parameter.1.by_reference {
                    written.extend(target.map(|all| Reference { key: None, ..all }));
                }
                continue;
            }
            if callee.is_none() && kind.is_place() {
                self.give_away(value, &mut arguments);
            }
            let by_reference = parameter.is_some_and(|(_, one)| one.by_reference && is_given);
            written.extend(target.filter(|one| by_reference && one.has_field));
            let parameter = parameter.map(|(callee, one)| self.local(callee, one.name));
            let value = if is_given {
                self.given(kind, value)
            } else if parameter.is_some() {
                self.number_given(value)
            } else {
                continue;
            };
            if let (Some(parameter), true) = (parameter, kind.is_place()) {
                let of = self.roots(value);
                self.copies.entry(parameter).or_default().extend(of);
            }
            let back = value.variable().filter(|_| by_reference);
            if by_reference && back.is_none() {
                chosen.extend(target.filter(|one| !one.has_field).zip(parameter));
            }
            arguments.push(Argument::new(parameter, value, back));
        }
        let (place, callees) = (self.place(line.span().start), callee.into_iter().collect());
        let arguments = self.builder.script.give(arguments);
        let call = Call::of(place, callees, Source::text(name), arguments);
        if line.text(0) == b"call" {
            self.builder.call(call);
        } else {
            self.builder.start(call, true);
        }
        // an element that only the running program chooses is then what the parameter is
        for (target, parameter) in chosen {
            let how = How::Whole(Expr::Variable(parameter));
            self.write(&target, line.span().start, how);
        }
        // arrays whose elements are not followed, and parts of points
        for target in written {
            self.builder.begin_if(None);
            self.write_something(&target, line.span().start, false);
            self.builder.end_choice();
        }
    }
}

/// The words of a statement with a list in brackets behind them.
pub(super) fn functions<'w>(line: Words<'w, 'w>) -> impl Iterator<Item = usize> + 'w {
    (0..line.len()).filter(move |at| line.is_name(*at) && line.is(at + 1, b'('))
}
