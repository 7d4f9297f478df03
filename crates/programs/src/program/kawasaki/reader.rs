//! Programs as statements: blocks, labels, calls, and what they write.

use super::arrays::Given;
use super::calls::{Any, Handed, Runs, is_started, started};
use super::keywords::find;
use super::moves::{Verb, is_joints};
use super::numbers::Known;
use super::plates::Plates;
use super::remarks::{ARC_CHAIN, COMPUTED, SAVED, SWITCHED, declared_again};
use super::sections::{Entry, Program, Sections, Statement};
use super::shown::Shown;
use super::targets::{Elements, Name, Position};
use super::watches::{Watch, watches};
use crate::geometry::Pose;
use crate::program::contexts::Calls;
use crate::program::kit::label_key;
use crate::program::notation::mentions;
use crate::program::script::{
    Builder, Expr, Held, How, Place, Remark, RoutineId, Script, Start, Tests, UNBOUNDED, ValueId,
    Variable, VariableId, Written, short,
};
use crate::program::words::Words;
use crate::program::{Load, Number, Source, SpeedZone};
use foldhash::{HashMap, HashSet};
use std::cell::OnceCell;

/// Where the reader is.
#[derive(Default)]
pub(super) struct Here {
    pub file: u32,
    pub routine: RoutineId,
    /// The byte that the statement begins at.
    pub at: usize,
    /// Where the robot stands, as far as the text before tells.
    pub last: Option<Position>,
    /// Speed and corner of all moves, and of the next one alone.
    pub always: SpeedZone,
    pub next: Option<SpeedZone>,
    /// Where signals are watched.
    watched: Vec<Watch>,
}

/// The stem of a name, and the program that it belongs to; none where it is of all.
pub(super) type Owned = (Option<RoutineId>, Vec<u8>);

pub(super) struct Reader<'a> {
    pub sources: &'a [Source],
    pub sections: &'a Sections<'a>,
    pub builder: Builder,
    /// Names of each program, and of all.
    pub names: HashMap<Option<RoutineId>, HashMap<Vec<u8>, Elements>>,
    /// Names that a statement writes.
    pub assigned: HashSet<Owned>,
    /// Likewise, with the program that it stands in.
    pub written: HashSet<(RoutineId, Vec<u8>)>,
    /// Programs by name in small letters.
    pub programs: HashMap<Vec<u8>, Vec<RoutineId>>,
    /// Parameters of each program.
    pub parameters: Vec<Vec<Vec<u8>>>,
    /// What reals and transformations are, once a position asks.
    pub known: OnceCell<Known<'a>>,
    /// Names that programs only show, once a `DECOMPOSE` asks.
    pub shown: OnceCell<Shown>,
    /// Names whose numbers are added to those of others, by the program that they belong to.
    pub added: HashSet<(Option<RoutineId>, Name)>,
    /// What is written out and added to others, and what is said of it where moves go there.
    pub added_literals: Vec<(Place, Remark)>,
    /// Names whose numbers programs read out of them, and where first.
    pub apart: HashMap<Owned, Place>,
    /// Names that `POINT` writes, each with one in what it writes.
    pub copied: Vec<(Owned, Owned)>,
    /// Names that are work frames of objects on them.
    pub plates: Plates,
    /// Which calls of programs say by what these displace.
    pub by_calls: Calls,
    /// Elements of arrays that calls hand over.
    pub given: Given,
    /// Programs that another calls by name.
    pub called: HashSet<RoutineId>,
    /// What stands for programs that only the running program chooses.
    pub any: Vec<(Any, RoutineId)>,
    pub tool: VariableId,
    pub base: VariableId,
    /// What `WEIGHT` says that the flange carries.
    pub load: VariableId,
    /// The loads that it said: what is one load is one value.
    pub loads: Vec<(Load, Expr)>,
    /// Hold a reason while tool and base are as they were when the controller was saved.
    saved: [VariableId; 2],
    /// Holds a reason where the arm's configuration was switched, and the index of that in the
    /// script's guards.
    switched: VariableId,
    pub switches: u32,
    /// Likewise behind the first part of an arc, for another one.
    chained: VariableId,
    pub chains: u32,
    /// Nothing speaks against a move, its side of the arm, an arc behind the one before.
    off: Expr,
    other_side: Expr,
    chain: Expr,
    /// Configuration data count.
    pub honoured: ValueId,
    pub here: Here,
}

/// The statements of all files.
pub(super) fn script<'a>(sources: &'a [Source], sections: &'a Sections<'a>) -> Script {
    let mut builder = Builder::default();
    let honoured = builder.script.value(Held::Flag(true));
    let off = builder.script.held(Held::Flag(false));
    let state = |builder: &mut Builder, name: &str, declared: Expr| {
        let made = Variable::new(name, Place::NOWHERE, declared);
        builder.script.variable(made)
    };
    let load = state(&mut builder, "load", off);
    let switched = state(&mut builder, "configuration", off);
    let chained = state(&mut builder, "arc", off);
    let starts = [b"TOOL", b"BASE"].map(|name| start(sections, name));
    // each is one value: a move tells few of them apart
    let [as_saved, other_side, chain] = [SAVED, SWITCHED, ARC_CHAIN].map(|remark| {
        let remark = builder.script.remark(remark);
        builder.script.held(Held::Remark(remark))
    });
    let saved = starts.map(|pose| {
        state(
            &mut builder,
            "save",
            if pose.is_some() { as_saved } else { off },
        )
    });
    let mut reader = Reader {
        sources,
        sections,
        switches: builder.script.guard([switched, saved[0], saved[1], load]),
        chains: builder
            .script
            .guard([chained, switched, saved[0], saved[1], load]),
        load,
        loads: Vec::new(),
        saved,
        builder,
        switched,
        chained,
        off,
        other_side,
        chain,
        honoured,
        names: HashMap::default(),
        assigned: HashSet::default(),
        written: HashSet::default(),
        programs: HashMap::default(),
        parameters: Vec::new(),
        known: OnceCell::new(),
        shown: OnceCell::new(),
        apart: HashMap::default(),
        copied: Vec::new(),
        added: HashSet::default(),
        added_literals: Vec::new(),
        plates: Plates::default(),
        by_calls: Calls::default(),
        given: Given::default(),
        called: HashSet::default(),
        any: Vec::new(),
        tool: 0,
        base: 0,
        here: Here::default(),
    };
    let [tool, base] = [("TOOL", starts[0]), ("BASE", starts[1])].map(|(name, pose)| {
        let before = reader.frame_value(name, pose);
        state(&mut reader.builder, name, before)
    });
    (reader.tool, reader.base) = (tool, base);
    let mut handed = Vec::new();
    for entry in &sections.entries {
        reader.declare(entry);
    }
    for program in &sections.programs {
        let name = Source::text(program.name);
        let key = program.name.to_ascii_lowercase();
        let start = if is_started(&key) {
            Start::Concurrent
        } else {
            Start::Called
        };
        let ones = reader.programs.entry(key).or_default();
        if !ones.is_empty() {
            let remark = declared_again(&name);
            reader.builder.script.say(sources, program.place, remark);
        }
        ones.push(reader.builder.declare(name, program.place, start));
        reader.parameters.push(program.parameters.clone());
    }
    for (routine, program) in (0..).zip(&sections.programs) {
        reader.note_assigned(program, routine, &mut handed);
    }
    reader.note_handed(&handed);
    reader.note_written(&handed);
    reader.note_arrays(&handed);
    reader.find_plates(starts[1]);
    for (routine, program) in (0..).zip(&sections.programs) {
        reader.program(routine, program);
    }
    reader.refuse_apart();
    reader.keep_literals();
    reader.start_uncalled();
    reader.write_any();
    reader.hand_over_calls();
    let mut script = reader.builder.finish();
    let all = vec![true; script.targets.len()];
    script.keep(&all);
    script
}

/// The tool or base that a save of the controller has; `None` where there is none, or several
/// that differ.
fn start(sections: &Sections, name: &[u8]) -> Option<Pose> {
    let saved = sections.saved.iter();
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
    fn note_assigned(&mut self, program: &Program, routine: RoutineId, handed: &mut Vec<Handed>) {
        let file = program.place.file;
        let bytes = &self.sources[file as usize].bytes;
        // most lines write no name
        program.each(bytes, may_write, |line| {
            let part = line.words;
            self.note_apart(part, Place::new(file, short(line.start)), routine);
            if matches!(line.keyword, "POint" | "HEre") {
                let name = if part.is(1, b'/') { 3 } else { 1 };
                let defined = part.behind(name).before(b'=');
                if let Some((name, _)) = Name::defined(defined) {
                    let owned = (self.owner_in(&name, routine), name.stem.clone());
                    for of in self.names_in(part.behind(1 + defined.len()), routine) {
                        self.copied.push((owned.clone(), of));
                    }
                    self.written.insert((routine, name.stem.clone()));
                    let place = Place::new(file, short(line.start));
                    self.assign(&name, place, routine);
                }
            } else if line.keyword == "HSENSE" {
                let names = sensed(part).map(|name| (routine, name.stem));
                self.written.extend(names);
            } else if let Some(at) = find(part, "CAll") {
                Handed::note(part.behind(at + 1), routine, handed);
            }
        });
    }

    /// The names in words.
    fn names_in(&self, part: Words, routine: RoutineId) -> Vec<Owned> {
        let names = (0..part.len()).filter_map(|at| Name::of(part.behind(at)));
        let owned = |(name, _): (Name, usize)| (self.owner_in(&name, routine), name.stem);
        names.map(owned).collect()
    }

    /// Notes the names whose numbers `FRAME(a,b,c,d)`, `DECOMPOSE x[0]=a` and `TRANS(DX(a),…)` read.
    fn note_apart(&mut self, part: Words, place: Place, routine: RoutineId) {
        let decomposed = find(part, "DECompose").map(|_| part.behind(part.before(b'=').len() + 1));
        let decomposed = decomposed.filter(|_| !self.is_only_shown(part, routine));
        let frame = part.find(b"FRAME").filter(|at| part.is(at + 1, b'('));
        let framed = frame.map(|at| part.inside(at + 1).0);
        let is_part = |at: &usize| PARTS.iter().any(|part_of| part.is_word(*at, part_of));
        let parts = (0..part.len()).filter(|at| is_part(at) && part.is(at + 1, b'('));
        let parts = parts.filter(|_| part.find(b"TRANS").is_some());
        let parts = parts.map(|at| part.inside(at + 1).0);
        for read in decomposed.into_iter().chain(framed).chain(parts) {
            for name in self.names_in(read, routine) {
                self.apart.entry(name).or_insert(place);
            }
        }
    }

    fn program(&mut self, routine: RoutineId, program: &Program<'a>) {
        let file = program.place.file;
        let sources = self.sources;
        let bytes = &sources[file as usize].bytes;
        self.here = Here {
            file,
            routine,
            watched: watches(bytes, program),
            ..Here::default()
        };
        self.builder.open(routine);
        program.each(bytes, |_| true, |line| self.line(line));
        self.builder.close();
    }

    fn line(&mut self, line: &Statement<'a, '_>) {
        if let Some(label) = line.label {
            self.builder.label(key(label));
            self.here.last = None;
        }
        if line.words.is_empty() {
            return;
        }
        self.here.at = line.words.span().start;
        if let Some(verb) = Verb::of(line) {
            self.moves(line.words, verb);
        } else if !self.flow(line) && !self.calls(line) {
            self.statement(line);
        }
        // a signal may come at any time
        let watched = &self.here.watched;
        for watch in watched
            .iter()
            .filter(|one| one.lines.contains(&self.here.at))
        {
            self.builder.may_go_to(watch.label);
        }
    }

    // ---- blocks and jumps

    /// Whether a statement is of the flow.
    fn flow(&mut self, statement: &Statement<'a, '_>) -> bool {
        let part = statement.words;
        let has = |word: &[u8]| part.find(word).is_some();
        match statement.keyword {
            "IF" if has(b"THEN") => {
                let tests = self.tests(part);
                self.builder.begin_if(tests);
            }
            "IF" => self.jump(part, true),
            "ELSEIF" => {
                self.builder.next_branch(true);
                let tests = self.tests(part);
                self.builder.pass_branch(tests);
            }
            "VALUE" => {
                self.builder.next_branch(true);
                let numbers = part.behind(1).before(b':').whole_numbers();
                self.builder.pass_cases(&numbers);
            }
            "SVALUE" => self.builder.next_branch(false),
            "ELse" => self.builder.next_branch(true),
            "ANY" if part.len() == 1 || part.is(1, b':') => self.builder.next_branch(true),
            "CASE" => {
                let of = part.find(b"OF").unwrap_or(part.len());
                let of = self.given_number(part.part(1..of.max(1)));
                self.builder.begin_switch(of);
            }
            "SCASE" => self.builder.begin_choice(),
            "WHile" => self.builder.begin_loop(true),
            "FOR" => {
                let most = self.rounds(part);
                self.builder.begin_rounds(true, most);
            }
            "DO" => self.builder.begin_loop(false),
            "ENd" | "UNtil" => self.builder.end_block(),
            "GOto" => self.jump(part, has(b"IF")),
            "RETurn" | "RETURNE" => self.builder.back(),
            "STOp" | "HAlt" => self.builder.exit(),
            _ => return false,
        }
        self.here.last = None;
        true
    }

    /// What `IF .n==1 THEN` asks of numbers that calls give.
    fn tests(&mut self, part: Words) -> Tests {
        let end = part.find(b"THEN").unwrap_or(part.len());
        self.asked(part.part(1..end.max(1)))
    }

    /// Likewise a condition.
    fn asked(&mut self, condition: Words) -> Tests {
        condition.compared().map(&mut |compared| {
            let (name, wanted) = (*compared)?;
            Some((self.given_number(name)?, wanted))
        })
    }

    /// `GOTO label`
    fn jump(&mut self, part: Words, may_go_on: bool) {
        let Some(at) = find(part, "GOto") else { return };
        let label = Some(part.text(at + 1)).filter(|label| !label.is_empty());
        let Some(label) = label.map(key) else { return };
        if !may_go_on {
            return self.builder.go_to(label);
        }
        // `IF n==1 GOTO 10`, `GOTO 10 IF n==1`
        let asked = match part.find(b"IF") {
            Some(of) if of > at => part.behind(of + 1),
            _ => part.part(1..at.max(1)),
        };
        let tests = self.asked(asked);
        self.builder.begin_if(tests);
        self.builder.go_to(label);
        self.builder.end_choice();
    }

    // ---- statements

    fn statement(&mut self, statement: &Statement<'a, '_>) {
        let part = statement.words;
        let rest = part.behind(1);
        match statement.keyword {
            "TOOL" => {
                self.set_frame(self.tool, self.saved[0], rest);
            }
            "BAse" => {
                let base = self.set_frame(self.base, self.saved[1], rest);
                self.move_plates(base, rest);
            }
            "SPeed" => self.speed(rest),
            "ACCUracy" => {
                let zone_m = first_number(rest).map(|mm| mm * crate::geometry::units::MM);
                self.modal(rest, |of| of.zone_m = zone_m);
            }
            "POint" => self.point(rest),
            "HEre" => {
                if let Some((name, is_sum)) = Name::defined(rest) {
                    let plate = self.taught_on(rest);
                    let here = match plate {
                        Some(plate) => self.robot_in(plate),
                        None if is_sum => self.unknown(COMPUTED),
                        None => self.robot(name.is_joints()),
                    };
                    self.write_name(&name, How::Whole(here));
                }
            }
            "HSENSE" => {
                for name in sensed(part) {
                    let value = self.unknown(COMPUTED);
                    self.write_name(&name, How::Whole(value));
                }
            }
            "PCEXecute" | "ONE" => {
                let named = started(rest);
                if named.is_name(0) {
                    self.call(named, Runs::WithoutMoves);
                }
            }
            "ON" | "ONI" => {
                if let Some(at) = find(part, "CAll") {
                    self.call(part.behind(at + 1), Runs::AtAnyTime);
                }
            }
            "WEight" => self.weight(rest),
            "LEfty" | "RIghty" | "ABove" | "BElow" | "UWrist" | "DWrist" => self.switch(false),
            _ => {}
        }
    }

    /// `TOOL …`, `BASE …`
    fn set_frame(&mut self, frame: VariableId, saved: VariableId, words: Words<'a, '_>) -> Expr {
        let value = self.frame(words);
        self.write(Written::One(frame), How::Whole(value));
        self.write(Written::One(saved), How::Whole(self.off));
        // of where the robot stands the text tells no target with the new one
        self.here.last = None;
        value
    }

    /// The arm's configuration is switched, or known again.
    pub(super) fn switch(&mut self, is_known: bool) {
        let value = if is_known { self.off } else { self.other_side };
        self.write(Written::One(self.switched), How::Whole(value));
    }

    /// A part of an arc ends, or its first.
    pub(super) fn end_part(&mut self, is_end: bool) {
        let value = if is_end { self.off } else { self.chain };
        self.write(Written::One(self.chained), How::Whole(value));
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
            // the robot stands where it was before
            if self
                .here
                .last
                .as_ref()
                .is_some_and(|last| self.may_be(last.base, written))
            {
                self.here.last = None;
            }
            self.write(written, how);
        }
    }

    /// Whether a position is what a statement writes.
    fn may_be(&self, position: Expr, written: Written) -> bool {
        let script = &self.builder.script;
        match (position, written) {
            (Expr::Variable(variable), Written::One(one)) => variable == one,
            (Expr::Variable(variable), Written::AnyOf(table)) => {
                let mut entries = script.tables[table as usize].entries.values();
                entries.any(|one| *one == variable)
            }
            (Expr::Displaced { base, .. } | Expr::DisplacedByCall { base, .. }, _) => {
                self.may_be(script.lists[base as usize], written)
            }
            (Expr::Any { first, end }, _) => {
                let all = &script.lists[first as usize..end as usize];
                all.iter().any(|one| self.may_be(*one, written))
            }
            _ => false,
        }
    }

    /// `POINT p = …`, `POINT/X p = …`
    fn point(&mut self, part: Words<'a, '_>) {
        let is_partial = part.is(0, b'/');
        let part = part.behind(if is_partial { 2 } else { 0 });
        let defined = part.before(b'=');
        let Some((name, is_sum)) = Name::defined(defined) else {
            return;
        };
        let value = part.behind(defined.len() + 1);
        if is_partial {
            let remark = self.builder.script.remark(COMPUTED);
            let how = if is_sum || mentions(value.whole(), defined.whole()) {
                // worked out of itself in a way that is not followed
                How::PartBy(remark, UNBOUNDED)
            } else {
                How::PartNumber(remark)
            };
            return self.write_name(&name, how);
        }
        // joints of a pose, and a pose of joints, are those of the tool, base and posture of that
        // moment
        let here = usize::from(value.is(0, b'#'));
        let is_here = value.is_word(here, b"HERE") && value.len() == here + 1;
        let value = if is_sum || !is_here && is_joints(value) != name.is_joints() {
            self.unknown(COMPUTED)
        } else if is_here {
            self.robot(name.is_joints())
        } else {
            let position = self.position(value);
            self.expr(&position)
        };
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

/// Functions that read numbers of a position.
const PARTS: [&[u8]; 3] = [b"DX", b"DY", b"DZ"];

/// Whether a line may be one that writes a name, reads it, or hands one to a program.
fn may_write(line: &[u8]) -> bool {
    let has = |first: u8, other: u8, word: &[u8]| {
        let mut places = memchr::memchr2_iter(first, other, line);
        places.any(|at| {
            let here = line.get(at..at + word.len());
            here.is_some_and(|here| here.eq_ignore_ascii_case(word))
        })
    };
    // as short as the keywords may be
    has(b'P', b'p', b"PO")
        || has(b'H', b'h', b"HE")
        || has(b'H', b'h', b"HS")
        || has(b'C', b'c', b"CA")
        || has(b'F', b'f', b"FRAME")
        || has(b'D', b'd', b"DEC")
        || has(b'T', b't', b"TRANS") && PARTS.iter().any(|part| has(b'D', b'd', part))
}

/// The joints that `HSENSE number result,status,#joints,error,left` writes.
///
/// # Source
/// Kawasaki AS Language Reference Manual (90209-1022DED). *Not verified on a controller.*
fn sensed<'w>(part: Words<'w, 'w>) -> impl Iterator<Item = Name> + 'w {
    let given = part.behind(1).list().into_iter();
    given.filter_map(|given| {
        let (name, words) = Name::of(given)?;
        (words == given.len() && name.is_joints()).then_some(name)
    })
}

/// The number that words begin with.
fn first_number(part: Words) -> Option<f64> {
    part.part(0..part.len().min(1)).value()
}
