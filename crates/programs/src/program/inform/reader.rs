//! Jobs as statements.

use super::calls::is_macro;
use super::cnd::Conditions;
use super::indexed::Indexed;
use super::instruction::{Effect, Operand, effect, is_actual, is_move, numbered};
use super::job::{Coordinates, Letter, Positions};
use super::jumps::{condition, is_label};
use super::lines::{Line, Lines, words};
use super::numbers::{Known, shared};
use super::parts::{Added, Computed, known_numbers};
use super::relative::{Frames, Given, are_of_several_robots, given, is_relative};
use super::remarks::Cause;
use super::shifts::Shifted;
use super::variables::{Variables, always};
use crate::program::number::whole;
use crate::program::script::{
    Builder, Expr, Held, How, Place, Remark, RoutineId, Script, Start, TableId, ValueId, Variable,
    VariableId, Written, short,
};
use crate::program::{External, ExternalNames, ExternalUse, Source, TargetId};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// The statements of all jobs.
pub(super) fn script<'a>(
    sources: &'a [Source],
    positions: Positions<'a>,
    conditions: &Conditions,
    external_names: &'a ExternalNames,
) -> Script {
    let lines = positions.other_lines(sources);
    let mut builder = Builder::default();
    let variables = Variables::of(&mut builder, &positions, conditions);
    let named = vec![false; positions.targets.len()];
    builder.script.instructions.reserve(named.len());
    builder.script.statements.reserve(named.len());
    let honoured = builder.script.value(Held::Flag(true));
    let mut reader = Reader {
        sources,
        builder,
        variables,
        named,
        names: HashMap::new(),
        honoured,
        copies: HashMap::new(),
        frames_of_copies: HashMap::new(),
        copied: Vec::new(),
        written: HashSet::new(),
        all_written: HashSet::new(),
        starts: Vec::new(),
        called: HashSet::new(),
        macros: Vec::new(),
        indexed: Indexed::default(),
        shifts: false,
        shifts_axes: false,
        tracks_seams: false,
        here: Here::default(),
        external_names,
        several_robots: are_of_several_robots(sources, &positions.jobs, &lines),
        written_external: written_external(&lines),
        given_frames: given(&positions.jobs, &lines),
        known_numbers: known_numbers(&lines),
        written_parts: HashSet::new(),
        written_any: HashSet::new(),
        converted: HashSet::new(),
        added: Vec::new(),
        computed: Vec::new(),
        shifted: Vec::new(),
        numbers: Known::default(),
        gets_parts: sources
            .iter()
            .any(|source| memchr::memmem::find(&source.bytes, b"GETE").is_some()),
        positions,
    };
    for job in &reader.positions.jobs {
        let place = Place::new(job.file, job.offset);
        let name = Source::text(job.name);
        let routine = reader.builder.declare(name, place, Start::Called);
        reader.names.entry(job.name).or_default().push(routine);
    }
    [reader.numbers.calls_others, reader.numbers.is_concurrent] =
        shared(&reader.positions.jobs, &lines);
    reader.declare_numbers();
    for job in 0..reader.positions.jobs.len() {
        reader.job(job, &lines[job]);
    }
    reader.finish()
}

/// Where the reader is.
#[derive(Default)]
pub(super) struct Here {
    /// Index of the job, which is also that of its routine.
    pub job: usize,
    pub file: u32,
    pub arc: Arc,
    /// A move to a position of the files has been read.
    pub is_moving: bool,
    /// Its user frame turns with a station.
    pub is_relative: bool,
    /// User frames that calls give it.
    pub frames: Frames,
    /// Keys of its labels so far; it has a jump to any of them.
    pub labels: Vec<u64>,
    pub jumps_anywhere: bool,
    /// It has been said that RCONF of the post is not used.
    pub said_rconf: bool,
    /// Reasons against moves with base and station axes that do not stand at zero.
    pub external: [Option<VariableId>; 2],
}

/// Successive MOVC: how many so far, and the last one among the instructions.
#[derive(Default)]
pub(super) struct Arc {
    pub points: usize,
    pub last: usize,
}

pub(super) struct Reader<'a> {
    pub sources: &'a [Source],
    pub positions: Positions<'a>,
    /// The jobs are of more than one robot.
    pub several_robots: bool,
    pub builder: Builder,
    pub variables: Variables,
    /// Targets that a move names.
    pub named: Vec<bool>,
    pub(super) names: HashMap<&'a [u8], Vec<RoutineId>>,
    /// Configuration data count.
    pub honoured: ValueId,
    /// What each variable may be a copy of.
    pub copies: HashMap<VariableId, Vec<Expr>>,
    /// The tool and the work frame of the position that a variable was last given.
    frames_of_copies: HashMap<VariableId, [VariableId; 2]>,
    /// Where something is computed from a P variable.
    pub copied: Vec<(Place, u32)>,
    /// Variables that instructions write.
    pub written: HashSet<VariableId>,
    /// Tables of which an instruction writes any entry.
    pub all_written: HashSet<TableId>,
    /// The first move of jobs that begin with a pose whose wrist nothing tells.
    pub starts: Vec<(RoutineId, Place)>,
    /// Jobs that others call.
    pub called: HashSet<RoutineId>,
    /// Calls of macros, and the jobs that have them.
    pub(super) macros: Vec<(usize, RoutineId)>,
    /// Moves to P variables by a number that is not written out.
    pub(super) indexed: Indexed,
    /// Whether any job switches a shift, one of external axes, or a seam tracker on.
    pub shifts: bool,
    pub shifts_axes: bool,
    pub tracks_seams: bool,
    pub here: Here,
    /// External axes that the profile describes.
    pub(super) external_names: &'a ExternalNames,
    /// Variables with axes of a base or a station that some job writes.
    written_external: HashSet<WrittenExternal>,
    /// Calls that give jobs a user frame.
    given_frames: Vec<Given<'a>>,
    /// Numbers of positions are written into others (`GETE`).
    pub(super) gets_parts: bool,
    /// Variables with numbers that the text writes.
    pub(super) known_numbers: HashSet<&'a [u8]>,
    /// Positions of which the text tells what is written into them.
    pub(super) written_parts: HashSet<VariableId>,
    pub(super) written_any: HashSet<TableId>,
    /// What holds a position in the coordinates of another frame than that of its target (`CNVRT`).
    pub(super) converted: HashSet<VariableId>,
    /// Writes that add one position to another.
    pub(super) added: Vec<Added>,
    /// Positions of which others are computed.
    pub(super) computed: Vec<Computed>,
    /// Shifts that are switched on.
    pub(super) shifted: Vec<Shifted>,
    pub(super) numbers: Known,
}

/// The letters of variables with axes of a base or a station, and their number; none where only the
/// running program knows which of them.
type WrittenExternal = ([u8; 2], Option<u32>);

/// The variables with axes of a base or a station that the instructions of all jobs write.
fn written_external(lines: &[Vec<Line>]) -> HashSet<WrittenExternal> {
    let lines = lines.iter().flatten();
    let is_comment = |line: &&Line| matches!(line.text, [b'\'' | b'/', ..]);
    let written = lines.filter(|line| !is_comment(line)).filter_map(|line| {
        let mut words = words(line.text);
        let (first, second) = (words.next()?, words.next()?);
        let (letters, digits) = second.split_first_chunk()?;
        let number = whole(digits);
        let is_named = number.is_some() || digits.starts_with(b"[");
        let is_variable = matches!(letters, b"BP" | b"EX") && is_named;
        let changes = !is_move(first) && effect(first) != Effect::None;
        (is_variable && changes).then_some((*letters, number))
    });
    written.collect()
}

impl<'a> Reader<'a> {
    fn job(&mut self, job: usize, others: &[Line]) {
        let (sources, of) = (self.sources, &self.positions.jobs[job]);
        let source = &sources[of.file as usize];
        let range = of.instructions.clone();
        let (relative, of_station) = is_relative(others);
        let (builder, given) = (&mut self.builder, &self.given_frames);
        self.here = Here {
            job,
            file: of.file,
            is_relative: of_station,
            frames: Frames::of(builder, sources, given, (of.name, relative)),
            ..Here::default()
        };
        self.builder.open(short(job));
        self.numbers.begin(short(job));
        for line in Lines::from(&source.bytes[..range.end], range.start) {
            match line.text {
                [] | [b'\'' | b'/', ..] => {}
                [b'*', name @ ..] => self.label(first_word(name)),
                _ => self.line(line),
            }
        }
        self.end_arc();
        self.end_labels();
        self.builder.close();
    }

    pub(super) fn routine(&self) -> RoutineId {
        short(self.here.job)
    }

    pub(super) fn place(&self, offset: usize) -> Place {
        Place::new(self.here.file, short(offset))
    }

    fn line(&mut self, line: Line<'a>) {
        let mut rest = words(line.text);
        let first = rest.next().unwrap_or_default();
        if is_move(first) {
            self.moves(line);
            return;
        }
        match first {
            b"FOR" => {
                let next = self.builder.script.loops.len();
                let most = self.numbers.begin_loop(&line.text[3..], next);
                self.builder.begin_rounds(true, most);
            }
            b"WHILE" | b"WHILEEXP" => {
                self.numbers.begin_while(&line.text[first.len()..]);
                self.builder.begin_loop(true);
            }
            b"NEXT" | b"ENDWHILE" => {
                self.numbers.close();
                self.builder.end_loop(false);
            }
            b"IFTHEN" | b"IFTHENEXP" => {
                self.numbers.open(&line.text[first.len()..]);
                self.builder.begin_if(None);
            }
            b"SWITCH" => {
                self.numbers.open(&[]);
                self.builder.begin_choice();
                if rest.any(|word| word == b"CASE") {
                    self.builder.next_branch(false);
                }
            }
            b"ELSEIF" | b"ELSEIFEXP" | b"CASE" | b"ELSE" | b"DEFAULT" => {
                self.numbers.branch();
                let is_last = matches!(first, b"ELSE" | b"DEFAULT");
                self.builder.next_branch(is_last);
            }
            b"ENDIF" | b"ENDSWITCH" => {
                self.numbers.close();
                self.builder.end_choice();
            }
            b"NOP" | b"COMM" => {}
            // the name of a local variable, below ///LVARS
            [b'L', .., b'0'..=b'9'] => {}
            _ => self.instruction(line, first),
        }
    }

    /// An instruction that may have a condition behind it.
    fn instruction(&mut self, line: Line<'a>, first: &'a [u8]) {
        let condition = condition(line.text);
        let second = words(line.text).nth(1).unwrap_or_default();
        if first == b"JUMP" && is_label(second) {
            return self.jump(second, condition);
        }
        if let Some(condition) = condition {
            self.numbers.open(condition);
            self.builder.begin_if(None);
        }
        match first {
            b"RET" => {
                self.numbers.stop();
                self.builder.back();
            }
            b"CALL" | b"JUMP" => {
                let call = self.call(line, second);
                let caller = self.routine();
                let others = call.callees.iter().filter(|job| **job != caller);
                self.called.extend(others);
                self.builder.call(call);
                if first == b"JUMP" {
                    // the caller goes on where the other job ends
                    self.numbers.stop();
                    self.builder.back();
                }
            }
            b"PSTART" => {
                let call = self.call(line, second);
                for &routine in &*call.callees {
                    self.builder.script.routines[routine as usize].start = Start::Concurrent;
                }
                // it moves another control group
                self.builder.start(call, false);
            }
            _ if is_macro(first) => {
                let call = self.call(line, second);
                self.builder.call(call);
            }
            _ if first.starts_with(b"SFTON") => self.shift(line, true),
            _ if first.starts_with(b"SFTOF") => self.shift(line, false),
            b"COMARCON" => self.track_seam(line, true),
            b"COMARCOF" => self.track_seam(line, false),
            _ => self.writes(line, first, second),
        }
        if condition.is_some() {
            self.numbers.close();
            self.builder.end_choice();
        }
    }

    pub(super) fn write(&mut self, line: Line, variable: Written, how: How) {
        let place = self.place(line.start);
        self.builder.write(place, variable, how);
    }

    /// Something that nobody knows.
    pub(super) fn unknown(&mut self, cause: Cause) -> Expr {
        self.builder.script.unknown(cause.remark())
    }

    /// What a position that an instruction names holds.
    pub(super) fn value(&mut self, operand: Operand, place: Place) -> Expr {
        if let Operand::C(number) = operand {
            let target = self.target(number).map(Expr::Target);
            return target.unwrap_or_else(|| self.unknown(Cause::NotInFiles));
        }
        match self.written_by(operand, place) {
            Some(Written::One(variable)) => Expr::Variable(variable),
            _ => self.unknown(Cause::Computed),
        }
    }

    /// What a position that an instruction names is when it is written.
    pub(super) fn written_by(&mut self, operand: Operand, place: Place) -> Option<Written> {
        let routine = self.routine();
        let (builder, variables) = (&mut self.builder, &mut self.variables);
        Some(match operand {
            Operand::C(_) => return None,
            Operand::P(number) => Written::One(variables.position(builder, number, place)),
            Operand::Local(number) => {
                Written::One(variables.local(builder, routine, number, place))
            }
            Operand::AnyP => Written::AnyOf(variables.positions),
            Operand::AnyLocal => Written::AnyOf(variables.locals(builder, routine)[0]),
        })
    }

    pub(super) fn note_copy(&mut self, written: Written, value: Expr) {
        if !matches!(value, Expr::Variable(_) | Expr::Target(_)) {
            return;
        }
        let all: Vec<VariableId> = match written {
            Written::One(to) => vec![to],
            Written::AnyOf(table) => {
                let entries = &self.builder.script.tables[table as usize].entries;
                entries.values().copied().collect()
            }
        };
        for to in all {
            self.copies.entry(to).or_default().push(value);
        }
    }

    /// What a copy gives the tool and the work frame of a variable.
    pub(super) fn frames_given(
        &mut self,
        to: VariableId,
        value: Expr,
    ) -> Option<[(VariableId, Expr); 2]> {
        let of = match value {
            Expr::Target(target) => <[Expr; 2]>::from(self.frames_of(target)),
            Expr::Variable(from) => self.frames_of_copy(from).map(Expr::Variable),
            _ => return None,
        };
        let [tool, frame] = self.frames_of_copy(to);
        Some([(tool, of[0]), (frame, of[1])])
    }

    /// The variables that hold the tool and the work frame of what another is given.
    pub(super) fn frames_of_copy(&mut self, of: VariableId) -> [VariableId; 2] {
        if let Some(&known) = self.frames_of_copies.get(&of) {
            return known;
        }
        let declared = match self.targets_of(Expr::Variable(of))[..] {
            [one] => self.frames_of(one).into(),
            _ => [(); 2].map(|()| self.unknown(Cause::FrameCopied)),
        };
        let script = &mut self.builder.script;
        let Variable { kept, routine, .. } = script.variables[of as usize];
        let made = declared.map(|declared| {
            script.variable(Variable {
                kept,
                routine,
                ..Variable::new("", Place::NOWHERE, declared)
            })
        });
        self.frames_of_copies.insert(of, made);
        made
    }

    /// An instruction that may write what it names first.
    fn writes(&mut self, line: Line<'a>, first: &[u8], second: &[u8]) {
        let is_setting = first == b"MFRAME" || first.starts_with(b"SET");
        match second {
            [b'U', b'F', b'#', ..] if is_setting => self.frame(line, self.variables.frames, second),
            [b'T', b'L', b'#', ..] if is_setting => self.frame(line, self.variables.tools, second),
            _ => {}
        }
        if first == b"GETE" {
            return self.get_element(line);
        }
        if self.numbers.instruction(line.text) {
            return;
        }
        let (place, effect) = (self.place(line.start), effect(first));
        let operand = Operand::of(second).filter(|_| effect != Effect::None);
        let Some((operand, written)) =
            operand.and_then(|operand| Some((operand, self.written_by(operand, place)?)))
        else {
            return;
        };
        match written {
            Written::One(variable) => self.written.insert(variable),
            Written::AnyOf(table) => self.all_written.insert(table),
        };
        let third = words(line.text).nth(2).unwrap_or_default();
        self.note_known(effect, third, written);
        if first != b"SETE" {
            self.position_becomes(line, (first, effect), written);
        }
        let value = match effect {
            // with another tool it is another place
            Effect::Copy if !words(line.text).any(|word| word.starts_with(b"TL#")) => {
                Operand::of(third).map(|operand| self.value(operand, place))
            }
            Effect::System if is_actual(third) => Some(self.builder.script.held(Held::Actual)),
            Effect::Argument => numbered(third, b"IARG#").map(|number| {
                let (routine, builder) = (self.routine(), &mut self.builder);
                Expr::Variable(self.variables.parameter(builder, routine, number, place))
            }),
            Effect::Taught => self.taught_at(third).map(Expr::Target),
            _ => None,
        };
        if let Some(value) = value {
            self.note_copy(written, value);
            if first == b"CNVRT" {
                match written {
                    Written::One(to) => _ = self.converted.insert(to),
                    Written::AnyOf(table) => {
                        let entries = &self.builder.script.tables[table as usize].entries;
                        self.converted.extend(entries.values());
                    }
                }
            }
            if let Written::One(to) = written {
                for (to, of) in self.frames_given(to, value).into_iter().flatten() {
                    self.write(line, Written::One(to), How::Whole(of));
                }
            }
            self.write(line, written, How::Whole(value));
            return;
        }
        if matches!(effect, Effect::Copy | Effect::Computed) {
            let value = self.computed_from(line, written);
            self.write(line, written, How::Whole(value));
            return;
        }
        self.note_sources(line, Some(operand));
        let computed = self.builder.script.remark(Cause::Computed.remark());
        match effect {
            Effect::Part => {
                let how = self.part_becomes(line, written, computed);
                self.write(line, written, how);
            }
            Effect::Perhaps => {
                self.builder.begin_if(None);
                self.write(line, written, How::Whole(Expr::Unknown(computed)));
                self.builder.end_choice();
            }
            _ => self.write(line, written, How::Whole(Expr::Unknown(computed))),
        }
    }

    /// Notes the P variables that something is computed from.
    fn note_sources(&mut self, line: Line, target: Option<Operand>) {
        let place = self.place(line.start);
        for operand in words(line.text).skip(2).filter_map(Operand::of) {
            if let Operand::P(number) = operand
                && Some(operand) != target
            {
                self.copied.push((place, number));
            }
        }
    }

    /// MFRAME and SETTOOL: what the frame or tool is then only the running program knows.
    fn frame(&mut self, line: Line, table: TableId, name: &[u8]) {
        self.note_sources(line, None);
        let unknown = self.unknown(Cause::FrameAssigned);
        let entries = &self.builder.script.tables[table as usize].entries;
        let written = match numbered(name, &name[..3]) {
            None => Written::AnyOf(table),
            Some(number) => match entries.get(&i64::from(number)) {
                Some(variable) => Written::One(*variable),
                // no position needs it
                None => return,
            },
        };
        self.write(line, written, How::Whole(unknown));
    }

    /// Notes where the axes of the base or of a station stand at the present move. Why positions of
    /// the job must stay: the first of these axes that does not stand at zero and of which
    /// nobody knows what it carries.
    pub(super) fn external(&mut self, name: &[u8]) -> Option<VariableId> {
        let is_station = name.starts_with(b"E") || name.starts_with(b"LE");
        let known = &self.positions.jobs[self.here.job].external;
        let named = super::job::external(name);
        let named = named.filter(|named| !self.is_written_external(*named));
        let moved = named.and_then(|external| known.get(&external));
        let what = if is_station { "station" } else { "base" };
        let shown = Source::text(&name[..name.len().min(20)]);
        let (is_known, mut unknown) = (moved.is_some(), None);
        let counts = moved.is_some_and(|moved| moved.coordinates == Some(Coordinates::Pulses));
        let letters = if is_station { "EC" } else { "BC" };
        // of none is anything known where only the running program knows
        let values = moved.map_or_else(
            || vec![f64::NAN; self.external_names.listed.len()],
            |moved| moved.values.clone(),
        );
        for (n, value) in (1..).zip(values) {
            match self.external_names.meaning(&format!("{letters}{n}")) {
                ExternalUse::Listed(axis) => {
                    let value = value / self.pulses_of(axis, counts);
                    let external = External { axis, value };
                    let script = &mut self.builder.script;
                    let at = short(script.instructions.len());
                    script.externals_of_moves.push((at, external));
                }
                ExternalUse::Unknown if is_known && value != 0.0 && unknown.is_none() => {
                    unknown = Some((n, value));
                }
                _ => {}
            }
        }
        let text = match (is_known, unknown) {
            (true, None) => return None,
            (_, Some((axis, value))) => {
                format!("axis {axis} of the {what} stands at {value} ({shown}), not at zero")
            }
            (false, None) => {
                format!("only the running program knows where the {what} stands ({shown})")
            }
        };
        let remark = Remark::error_about(
            "external-axis-unknown",
            text,
            "describe the axis under `external_axes` of the profile (BC1…, EC1…), or write the \
             position in robot coordinates (POSTYPE ROBOT) or in pulses",
        );
        let builder = &mut self.builder;
        let reason = &mut self.here.external[usize::from(is_station)];
        Some(*reason.get_or_insert_with(|| always(builder, remark)))
    }

    /// Whether a job writes a variable with the axes of a base or station.
    pub(super) fn is_written_external(&self, (letters, number): super::job::External) -> bool {
        let any = (letters, None);
        let one = (letters, Some(number));
        self.written_external.contains(&any) || self.written_external.contains(&one)
    }

    /// How much a value that counts in pulses is of one millimetre or degree; not a number where
    /// nobody knows.
    pub(super) fn pulses_of(&self, axis: u8, counts: bool) -> f64 {
        let pulses = self.external_names.pulses.get(usize::from(axis));
        match pulses.copied().flatten() {
            _ if !counts => 1.0,
            pulses => pulses.unwrap_or(f64::NAN),
        }
    }

    /// A `C` position of the present job.
    pub(super) fn target(&self, number: u32) -> Option<TargetId> {
        let job = &self.positions.jobs[self.here.job];
        job.named.get(&(Letter::C, number)).copied()
    }
}

fn first_word(text: &[u8]) -> &[u8] {
    words(text).next().unwrap_or_default()
}
