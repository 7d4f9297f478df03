//! Programs as statements: blocks, labels, calls, and what they write.

use super::arrays::Given;
use super::calls::{Any, Handed};
use super::keywords::{begins_with, find};
use super::moves::Verb;
use super::plates::Plates;
use super::remarks::{COMPUTED, SAVED, SWITCHED};
use super::sections::{Entry, Program, Sections, lines};
use super::targets::{Elements, Name, Position};
use super::watches::{Watch, watches};
use crate::geometry::Pose;
use crate::program::kit::label_key;
use crate::program::notation::mentions;
use crate::program::script::{
    Builder, Expr, Held, How, Place, RoutineId, Script, Start, ValueId, Variable, VariableId,
    Written, short,
};
use crate::program::words::{Kind, Words};
use crate::program::{Number, Source, SpeedZone};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// Where the reader is.
#[derive(Default)]
pub(super) struct Here {
    pub file: u32,
    pub routine: RoutineId,
    /// The byte that the statement begins at.
    pub at: usize,
    /// Names in small letters.
    pub parameters: Vec<Vec<u8>>,
    /// Where the robot stands, as far as the text before tells.
    pub last: Option<Position>,
    /// Speed and corner of all moves, and of the next one alone.
    pub always: SpeedZone,
    pub next: Option<SpeedZone>,
    /// Points of the present arc.
    pub arc: usize,
    /// Where signals are watched.
    watched: Vec<Watch>,
}

#[derive(Default)]
pub(super) struct Reader<'a> {
    pub sources: &'a [Source],
    pub builder: Builder,
    /// Names of all programs, and of each.
    pub names: HashMap<Vec<u8>, Elements>,
    pub locals: HashMap<RoutineId, HashMap<Vec<u8>, Elements>>,
    /// Names that a statement writes.
    pub assigned: HashSet<Vec<u8>>,
    /// Likewise, with the program that it stands in.
    pub written: HashSet<(RoutineId, Vec<u8>)>,
    /// Programs by name in small letters.
    pub programs: HashMap<Vec<u8>, Vec<RoutineId>>,
    /// Parameters of each program.
    pub parameters: Vec<Vec<Vec<u8>>>,
    /// Names that are work frames of objects on them.
    pub plates: Plates,
    /// Elements of arrays that calls hand over.
    pub given: Given,
    /// Programs that another calls by name.
    pub called: HashSet<RoutineId>,
    /// What stands for programs that only the running program chooses.
    pub any: Vec<(Any, RoutineId)>,
    pub tool: VariableId,
    pub base: VariableId,
    /// Hold a reason while tool and base are as they were when the controller was saved.
    saved: [VariableId; 2],
    /// Holds a reason where the arm's configuration was switched, and the index of that in the
    /// script's guards.
    switched: VariableId,
    pub switches: u32,
    /// Configuration data count.
    pub honoured: ValueId,
    pub here: Here,
}

/// The statements of all files.
pub(super) fn script(sources: &[Source], sections: &[Sections]) -> Script {
    let mut builder = Builder::default();
    let honoured = builder.script.value(Held::Flag(true));
    let off = builder.script.held(Held::Flag(false));
    let state = |builder: &mut Builder, name: &str, declared: Expr| {
        let made = Variable::new(name, Place::NOWHERE, declared);
        builder.script.variable(made)
    };
    let switched = state(&mut builder, "configuration", off);
    let starts = [b"TOOL", b"BASE"].map(|name| start(sections, name));
    let saved = starts.map(|pose| {
        let remark = builder.script.remark(SAVED);
        let reason = builder.script.held(Held::Remark(remark));
        state(
            &mut builder,
            "save",
            if pose.is_some() { reason } else { off },
        )
    });
    let mut reader = Reader {
        sources,
        switches: builder.script.guard([switched, saved[0], saved[1]]),
        saved,
        builder,
        switched,
        honoured,
        ..Reader::default()
    };
    let [tool, base] = [("TOOL", starts[0]), ("BASE", starts[1])].map(|(name, pose)| {
        let before = reader.frame_value(name, pose);
        state(&mut reader.builder, name, before)
    });
    (reader.tool, reader.base) = (tool, base);
    let mut handed = Vec::new();
    for (file, of) in sections.iter().enumerate() {
        for entry in &of.entries {
            reader.declare(entry, short(file));
        }
        for program in &of.programs {
            let place = Place::new(short(file), program.at);
            let name = Source::text(program.name);
            let routine = reader.builder.declare(name, place, Start::Called);
            let name = program.name.to_ascii_lowercase();
            reader.programs.entry(name).or_default().push(routine);
            reader.parameters.push(program.parameters.clone());
            reader.note_assigned(&sources[file], program, routine, &mut handed);
        }
    }
    reader.note_handed(&handed);
    reader.note_arrays(&handed);
    reader.find_plates(sections, starts[1]);
    let mut routine = 0;
    for (file, of) in sections.iter().enumerate() {
        for program in &of.programs {
            reader.program(short(file), routine, program);
            routine += 1;
        }
    }
    reader.start_uncalled();
    reader.write_any();
    let mut script = reader.builder.finish();
    let all = vec![true; script.targets.len()];
    script.keep(&all);
    script
}

/// The tool or base that a save of the controller has; `None` where there is none, or several
/// that differ.
fn start(sections: &[Sections], name: &[u8]) -> Option<Pose> {
    let saved = sections.iter().flat_map(|of| &of.saved);
    let values = |entry: &Entry| <[Number; 6]>::try_from(&entry.numbers[..]).ok();
    let mut all = saved.filter(|entry| entry.name == name).map(values);
    let first = all.next()??.map(|number| number.value);
    let is_same = |other: Option<[Number; 6]>| other.is_some_and(|o| o.map(|n| n.value) == first);
    all.all(is_same).then(|| super::pose_of(first))
}

/// A label as a number, in any case.
pub(super) fn key(label: &[u8]) -> u64 {
    label_key(&label.to_ascii_lowercase())
}

impl<'a> Reader<'a> {
    pub(super) fn place(&self, offset: usize) -> Place {
        Place::new(self.here.file, short(offset))
    }

    /// Notes the names that a program writes, whenever it runs, and those that it hands to others.
    fn note_assigned(
        &mut self,
        source: &Source,
        program: &Program,
        routine: RoutineId,
        handed: &mut Vec<Handed>,
    ) {
        let mut found = Vec::new();
        for line in lines(&source.bytes, program.lines.clone()) {
            // most lines write no name
            if !may_write(line.text) {
                continue;
            }
            let (_, part) = behind_label(line.words(&source.bytes, &mut found));
            if begins_with(part, b"POINT") || begins_with(part, b"HERE") {
                let name = if part.is(1, b'/') { 3 } else { 1 };
                if let Some((name, _)) = Name::defined(before_equals(part.behind(name))) {
                    self.written.insert((routine, name.stem));
                }
            } else if let Some(at) = find(part, b"CALL") {
                Handed::note(part.behind(at + 1), routine, handed);
            }
        }
    }

    fn program(&mut self, file: u32, routine: RoutineId, program: &Program<'a>) {
        let sources = self.sources;
        let bytes = &sources[file as usize].bytes;
        self.here = Here {
            file,
            routine,
            parameters: self.parameters[routine as usize].clone(),
            watched: watches(bytes, program.lines.clone()),
            ..Here::default()
        };
        self.builder.open(routine);
        let mut found = Vec::new();
        for line in lines(bytes, program.lines.clone()) {
            self.line(line.words(bytes, &mut found));
        }
        self.builder.close();
    }

    fn line(&mut self, line: Words<'a, '_>) {
        let (label, part) = behind_label(line);
        if let Some(label) = label {
            self.builder.label(key(label));
            self.here.last = None;
        }
        if part.is_empty() {
            return;
        }
        self.here.at = part.span().start;
        if let Some(verb) = Verb::of(part) {
            self.moves(part, verb);
        } else if !self.flow(part) && !self.calls(part) {
            self.statement(part);
        }
        // a signal may come at any time
        let at = self.here.at;
        for watch in self
            .here
            .watched
            .iter()
            .filter(|one| one.lines.contains(&at))
        {
            self.builder.may_go_to(watch.label);
        }
    }

    // ---- blocks and jumps

    /// Whether the words are of the flow.
    fn flow(&mut self, part: Words<'a, '_>) -> bool {
        let has = |word: &[u8]| part.find(word).is_some();
        let label = find(part, b"GOTO").map(|at| part.text(at + 1));
        let label = label.filter(|label| !label.is_empty()).map(key);
        let is = |word: &[u8]| begins_with(part, word);
        if is(b"IF") && !has(b"THEN") {
            if let Some(label) = label {
                self.builder.may_go_to(label);
            }
        } else if is(b"IF") {
            self.builder.begin_if(None);
        } else if is(b"ELSEIF") {
            self.builder.next_branch(false);
        } else if is(b"ELSE") {
            self.builder.next_branch(true);
        } else if is(b"CASE") || is(b"SCASE") {
            self.builder.begin_choice();
        } else if is(b"VALUE") || is(b"SVALUE") {
            self.builder.next_branch(false);
        } else if is(b"ANY") && (part.len() == 1 || part.is(1, b':')) {
            self.builder.next_branch(true);
        } else if is(b"WHILE") || is(b"FOR") {
            self.builder.begin_loop(true);
        } else if is(b"DO") {
            self.builder.begin_loop(false);
        } else if is(b"END") || is(b"UNTIL") {
            self.builder.end_block();
        } else if is(b"GOTO") {
            if let Some(label) = label {
                if has(b"IF") {
                    self.builder.may_go_to(label);
                } else {
                    self.builder.go_to(label);
                }
            }
        } else if is(b"RETURN") || is(b"RETURNE") {
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

    fn statement(&mut self, part: Words<'a, '_>) {
        let rest = part.behind(1);
        let is = |word: &[u8]| begins_with(part, word);
        if is(b"TOOL") || is(b"BASE") {
            let value = self.frame(rest);
            let off = self.builder.script.held(Held::Flag(false));
            let (variable, saved) = if is(b"TOOL") {
                (self.tool, self.saved[0])
            } else {
                (self.base, self.saved[1])
            };
            self.write(Written::One(variable), How::Whole(value));
            self.write(Written::One(saved), How::Whole(off));
            if is(b"BASE") {
                self.move_plates(value, rest);
            }
            // of where the robot stands the text tells no target with the new one
            self.here.last = None;
        } else if is(b"SPEED") {
            self.speed(rest);
        } else if is(b"ACCURACY") {
            let zone_m = first_number(rest).map(|mm| mm * crate::geometry::units::MM);
            self.modal(rest, |of| of.zone_m = zone_m);
        } else if is(b"POINT") {
            self.point(rest);
        } else if is(b"HERE") {
            if let Some((name, is_sum)) = Name::defined(rest) {
                let here = if is_sum {
                    self.unknown(COMPUTED)
                } else {
                    self.builder.script.held(Held::Actual)
                };
                self.write_name(&name, How::Whole(here));
            }
        } else if is(b"PCEXECUTE") || is(b"ONE") {
            // the number of the process may stand before the name
            let colon = (0..rest.len()).find(|at| rest.is(*at, b':'));
            let named = rest.behind(colon.map_or(0, |at| at + 1));
            if named.is_name(0) {
                self.call(named, true);
            }
        } else if is(b"ON") || is(b"ONI") {
            if let Some(at) = find(part, b"CALL") {
                self.call(part.behind(at + 1), true);
            }
        } else if SWITCHES.iter().any(|word| is(word)) {
            let remark = self.builder.script.remark(SWITCHED);
            self.switch(Held::Remark(remark));
        }
    }

    /// The arm's configuration is switched, or known again.
    pub(super) fn switch(&mut self, value: Held) {
        let value = self.builder.script.held(value);
        self.write(Written::One(self.switched), How::Whole(value));
    }

    pub(super) fn write(&mut self, variable: Written, how: How) {
        let place = self.place(self.here.at);
        self.builder.write(place, variable, how);
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
    fn point(&mut self, part: Words<'a, '_>) {
        let is_partial = part.is(0, b'/');
        let part = part.behind(if is_partial { 2 } else { 0 });
        let defined = before_equals(part);
        let Some((name, is_sum)) = Name::defined(defined) else {
            return;
        };
        let value = part.behind(defined.len() + 1);
        if is_partial {
            let remark = self.builder.script.remark(COMPUTED);
            let is_own = is_sum || mentions(value.whole(), defined.whole());
            let how = How::part(is_own, false, remark);
            return self.write_name(&name, how);
        }
        if is_sum {
            let value = self.unknown(COMPUTED);
            return self.write_name(&name, How::Whole(value));
        }
        let position = self.position(value);
        let value = self.expr(&position);
        self.write_name(&name, How::Whole(value));
    }

    /// What holds for all moves behind `ALWAYS`, else for the next.
    fn modal(&mut self, part: Words<'a, '_>, set: impl Fn(&mut SpeedZone)) {
        let is_always = part.find(b"ALWAYS").is_some();
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
    fn speed(&mut self, part: Words<'a, '_>) {
        let value = first_number(part);
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
}

/// Whether a line may be one that writes a name, or hands one to a program.
fn may_write(line: &[u8]) -> bool {
    let has = |first: u8, other: u8, word: &[u8]| {
        let mut places = memchr::memchr2_iter(first, other, line);
        places.any(|at| {
            let here = line.get(at..at + word.len());
            here.is_some_and(|here| here.eq_ignore_ascii_case(word))
        })
    };
    // as short as the keywords may be
    has(b'P', b'p', b"PO") || has(b'H', b'h', b"HE") || has(b'C', b'c', b"CA")
}

/// What stands before `=`; all where there is none.
fn before_equals<'a, 'w>(part: Words<'a, 'w>) -> Words<'a, 'w> {
    let equals = (0..part.len()).find(|at| part.is(*at, b'='));
    part.part(0..equals.unwrap_or(part.len()))
}

/// The number or name that a line begins with to be jumped to, and what is behind it.
pub(super) fn behind_label<'a, 'w>(line: Words<'a, 'w>) -> (Option<&'a [u8]>, Words<'a, 'w>) {
    let has_colon = line.is(1, b':') && !line.is_word(0, b"ANY");
    if line.kind(0) == Some(Kind::Number) || has_colon {
        let words = if line.is(1, b':') { 2 } else { 1 };
        return (Some(line.text(0)), line.behind(words));
    }
    (None, line)
}

/// The number that words begin with.
fn first_number(part: Words) -> Option<f64> {
    part.part(0..part.len().min(1)).value()
}

/// Words that switch the arm's configuration.
const SWITCHES: &[&[u8]] = &[
    b"LEFTY", b"RIGHTY", b"ABOVE", b"BELOW", b"UWRIST", b"DWRIST",
];
