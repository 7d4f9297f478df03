//! From listings to statements: what the files hold, before their instructions are gone through.

use super::ABOUT;
use super::content::gets_elements;
use super::controller::{Controller, Why};
use super::frames;
use super::indices::{Meant, has_index};
use super::lines::{Line, Lines};
use super::numbers::Known;
use super::offsets::{Condition, Copied, Offset};
use super::points::{Axis, Content, Point, Points, bad_value};
use super::registers::{Part, Sum};
use super::rides::Riding;
use super::sections::Sections;
use super::statements::{State, is_chosen};
use super::words::{Named, Register, is_word, word_length};
use crate::finding::{Finding, Severity};
use crate::program::kit::{Fault, not_this_language};
use crate::program::script::{
    Builder, Expr, How, Place, Remark, RoutineId, Script, Start, Variable, VariableId, short,
};
use crate::program::{
    External, ExternalNames, ExternalUse, Layout, ReadError, Shape, Source, SpeedZone, Target,
    TargetId,
};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
use std::collections::BTreeSet;
use std::ops::Range;

/// A tool, a frame, and any of the points taught with them.
pub(super) type Group = (Option<u32>, Option<u32>, Expr);

/// One program.
#[derive(Clone, Debug, Default)]
pub(super) struct Listing {
    pub routine: RoutineId,
    /// Index of its file.
    pub file: u32,
    lines: Range<usize>,
    /// Its points, in the order of the text.
    pub points: Vec<Taught>,
    /// The last point of each number.
    pub by_number: HashMap<u32, u32>,
    /// The points of one tool and frame that an index may tell which tells many, for moves to any of them.
    pub any: Option<(Meant, Vec<Group>)>,
    /// It follows a conveyor.
    pub tracks_line: bool,
    /// A positioner of the profile carries its frames: `COORD` is relative to these.
    pub is_carried: bool,
    /// Which tool and frame are selected matters to some of its moves.
    pub uses_active: bool,
    /// It selects by an argument of its call.
    pub uses_arguments: bool,
    /// Points that it writes.
    pub written: HashMap<TargetId, VariableId>,
    /// An instruction that nobody knows names any of its points.
    pub gives_any: bool,
    /// It has reported points of other groups.
    pub reported_group: bool,
}

/// A point as moves need it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taught {
    pub number: u32,
    /// `None` where it has no group 1.
    pub target: Option<TargetId>,
    pub tool: Option<u32>,
    pub frame: Option<u32>,
    pub is_joints: bool,
    /// It is a point of another arm too.
    pub has_other_arm: bool,
    /// The one before it with its number.
    pub twin: Option<u32>,
}

/// Reads programs into one script.
pub(super) struct Reader<'a> {
    pub builder: Builder,
    pub sources: &'a [Source],
    pub names: &'a ExternalNames,
    /// The present program, its file, where it is while it is read, and the present instruction.
    pub listing: Listing,
    pub bytes: &'a [u8],
    /// What stands behind the positions of the last move that is no more than plain, and how fast and
    /// how near that goes.
    pub plain_words: Option<(&'a [u8], SpeedZone)>,
    pub state: State,
    pub place: Place,
    pub controller: Controller,
    /// Routines by the names of their programs, and whether they select by arguments.
    pub by_name: HashMap<Box<str>, Vec<(RoutineId, bool)>>,
    /// Programs that change no register.
    pub quiet: HashSet<RoutineId>,
    pub arguments: HashMap<(RoutineId, u32), VariableId>,
    /// Registers that hold something the files know, and those that something reads.
    pub aliased: BTreeSet<u32>,
    pub read: BTreeSet<u32>,
    /// Any register is read.
    pub reads_any: bool,
    /// Numbers of position registers are written into others.
    pub gets_elements: bool,
    /// Copies of points into registers.
    pub copies: Vec<(Place, u32)>,
    /// Writes of tools and frames from registers.
    pub from_registers: Vec<(usize, u32)>,
    /// Moves to any register.
    pub to_any_register: Vec<usize>,
    /// What the numbers in registers may be.
    pub known: Known,
    /// Likewise once all programs are read, where they are gone through a second time.
    pub before: Option<Box<Known>>,
    pub copied: Copied,
    /// What depends on these.
    pub offsets: Vec<Offset>,
    pub conditions: Vec<Condition>,
    pub rides: Vec<Riding>,
    /// Of the programs with such a condition those that they come to, through calls.
    pub conditioned: HashMap<RoutineId, HashSet<RoutineId>>,
    pub sums: Vec<Sum>,
    pub parts: Vec<Part>,
    /// Loads that programs select; `None` where a register says which.
    pub payloads: BTreeSet<Option<u32>>,
    /// That they are several is reported.
    pub reported_payload: bool,
    /// Names of several programs that are reported.
    pub reported_names: HashSet<Box<str>>,
    /// Points that programs write.
    pub written_points: BTreeSet<TargetId>,
}

/// Whether a program runs another at the same time.
fn starts_others(bytes: &[u8], names: &HashMap<Box<str>, Vec<(RoutineId, bool)>>) -> bool {
    let has = |word: &[u8]| memchr::memmem::find(bytes, word).is_some();
    if !has(b"RUN") && !has(b"MONITOR") {
        return false;
    }
    Lines::new(bytes, 0..bytes.len()).any(|line| {
        let text = &bytes[line.text];
        let starts = |verb: &[u8], at: usize| {
            let (before, behind) = (&text[..at], &text[at + verb.len()..]);
            let ends = [before.last(), behind.first()];
            let is_alone = !ends.into_iter().flatten().any(|b| is_word(*b));
            let name = behind.trim_ascii_start();
            is_alone && (is_chosen(name) || names.contains_key(&called(&name[..word_length(name)])))
        };
        let mut verbs = [&b"RUN"[..], b"MONITOR"].into_iter();
        verbs.any(|verb| {
            let mut places = memchr::memmem::find_iter(text, verb);
            places.any(|at| starts(verb, at))
        })
    })
}

/// The statements of all files.
pub(super) fn script(sources: &[Source], names: &ExternalNames) -> Result<Script, ReadError> {
    let mut builder = Builder::default();
    let (mut shown, mut listings) = (Vec::new(), Vec::new());
    for (file, source) in sources.iter().enumerate() {
        if let Some(sections) = Sections::of(&source.bytes) {
            let listing = listing(&mut builder, source, short(file), &sections, names);
            listings.push(listing.map_err(|fault| fault.in_source(source))?);
        } else if let Some(kind) = frames::kind(&source.bytes) {
            let found = frames::read(&source.bytes, kind)
                .map_err(|bad| bad_value(bad.at, bad.length).in_source(source))?;
            if found.rounded {
                builder.script.findings.push(frames_rounded(source));
            }
            shown.push((&*source.name, found));
        } else {
            return Err(not_this_language(&ABOUT, source));
        }
    }
    builder.script.is_closed = true;
    let name_of = |listing: &Listing| &*sources[listing.file as usize].name;
    let controllers = frames::controllers(shown, listings, name_of);
    let shown: Vec<&str> = controllers.iter().map(|(file, ..)| *file).collect();
    if let [first, more @ ..] = &shown[..]
        && !more.is_empty()
    {
        let finding = several_controllers(first, more);
        builder.script.findings.push(finding);
    }
    for (_, values, listings) in controllers {
        let bytes_of = |listing: &Listing| {
            let bytes = &sources[listing.file as usize].bytes;
            &bytes[listing.lines.clone()]
        };
        let has_indices = listings.iter().any(|listing| has_index(bytes_of(listing)));
        let known = has_indices.then(|| {
            let (builder, values, listings) = (builder.clone(), values.clone(), listings.clone());
            let (_, known) = of_controller(builder, (sources, names), values, listings, None);
            Box::new(known)
        });
        (builder, _) = of_controller(builder, (sources, names), values, listings, known);
    }
    Ok(builder.finish())
}

fn several_controllers(first: &str, more: &[&str]) -> Finding {
    Finding {
        id: "several-controllers",
        severity: Severity::Warning,
        file: first.into(),
        line: 0,
        column: 0,
        message: format!(
            "{first} and {} show other tools or frames: each program has those of its folder, and \
             all are corrected for the one arm of the profile",
            more.join(", ")
        ),
        hint: "programs of another arm need its own profile: give the folders one by one".into(),
        accepted: false,
    }
}

/// Adds the programs of one controller; hands over what the numbers in registers may be.
fn of_controller(
    mut builder: Builder,
    (sources, names): (&[Source], &ExternalNames),
    mut values: frames::All,
    listings: Vec<Listing>,
    before: Option<Box<Known>>,
) -> (Builder, Known) {
    let mut known = Known::default();
    known.shown = std::mem::take(&mut values.registers);
    let controller = Controller::new(&mut builder.script, values);
    let mut by_name: HashMap<Box<str>, Vec<(RoutineId, bool)>> = HashMap::new();
    for listing in &listings {
        let name = &builder.script.routines[listing.routine as usize].name;
        let routine = (listing.routine, listing.uses_arguments);
        by_name.entry(name.clone()).or_default().push(routine);
    }
    let mut reader = Reader {
        builder,
        sources,
        names,
        listing: Listing::default(),
        plain_words: None,
        bytes: &[],
        state: State::default(),
        place: Place::NOWHERE,
        controller,
        by_name,
        quiet: HashSet::new(),
        arguments: HashMap::new(),
        aliased: BTreeSet::new(),
        read: BTreeSet::new(),
        reads_any: false,
        gets_elements: sources.iter().any(|source| gets_elements(&source.bytes)),
        copies: Vec::new(),
        from_registers: Vec::new(),
        to_any_register: Vec::new(),
        known,
        before,
        copied: Copied::default(),
        offsets: Vec::new(),
        conditions: Vec::new(),
        rides: Vec::new(),
        conditioned: HashMap::new(),
        sums: Vec::new(),
        parts: Vec::new(),
        payloads: BTreeSet::new(),
        reported_payload: false,
        reported_names: HashSet::new(),
        written_points: BTreeSet::new(),
    };
    reader.known.is_concurrent = listings.iter().any(|listing| {
        let bytes = &reader.sources[listing.file as usize].bytes;
        starts_others(&bytes[listing.lines.clone()], &reader.by_name)
    });
    let quiet = listings.iter().filter(|listing| {
        let bytes = &reader.sources[listing.file as usize].bytes;
        is_quiet(&bytes[listing.lines.clone()])
    });
    reader.quiet = quiet.map(|listing| listing.routine).collect();
    for listing in listings {
        reader.listing(listing);
    }
    reader.finish()
}

/// Whether the lines of a program change no register: signals, waits, messages, moves and jumps.
fn is_quiet(lines: &[u8]) -> bool {
    const KNOWN: [&str; 18] = [
        "DO[", "RO[", "GO[", "AO[", "F[", "M[", "SO[", "WAIT", "LBL[", "JMP", "IF ", "END",
        "MESSAGE[", "UALM[", "J ", "L ", "P[", "!",
    ];
    let has = |text: &[u8]| memchr::memmem::find(lines, text).is_some();
    // another program, or a register of any kind
    let changes = [&b"CALL"[..], b"RUN", b"R["];
    let is_known = |line: &[u8]| {
        let text = match memchr::memchr(b':', line) {
            Some(at) if line[..at].trim_ascii().iter().all(u8::is_ascii_digit) => &line[at + 1..],
            _ => line,
        };
        let text = text.trim_ascii();
        text.is_empty()
            || text == b";"
            || KNOWN.iter().any(|known| text.starts_with(known.as_bytes()))
    };
    !changes.into_iter().any(has) && lines.split(|b| *b == b'\n').all(is_known)
}

fn frames_rounded(source: &Source) -> Finding {
    Finding {
        id: "frames-rounded",
        severity: Severity::Note,
        file: source.name.clone(),
        line: 0,
        column: 0,
        message: "this list shows tools and user frames to 0.1 mm and 0.1 deg".into(),
        hint: "SYSFRAME.VA has them to 0.001".into(),
        accepted: false,
    }
}

/// One program and its points.
fn listing(
    builder: &mut Builder,
    source: &Source,
    file: u32,
    sections: &Sections,
    names: &ExternalNames,
) -> Result<Listing, Fault> {
    let bytes = &source.bytes;
    let lines = &bytes[sections.lines.clone()];
    let has = |text: &[u8]| memchr::memmem::find(lines, text).is_some();
    let name = program_name(&bytes[sections.name.clone()]);
    let offset = short(sections.name.start);
    let mut listing = Listing {
        routine: builder.declare(name, Place::new(file, offset), Start::Called),
        file,
        lines: sections.lines.clone(),
        tracks_line: tracks_line(&bytes[sections.head.clone()]),
        is_carried: names.carries_every_frame,
        uses_active: has(b"PR[") || has(b"LPOS"),
        uses_arguments: has(b"AR["),
        ..Listing::default()
    };
    let script = &mut builder.script;
    let mut points = Points::new(bytes, sections.points.start);
    points.numbers = std::mem::take(&mut script.numbers);
    while let Some(point) = points.next()? {
        add(script, &mut listing, &point, names);
    }
    script.numbers = points.numbers;
    if !sections.is_closed {
        let what = "the program (its last line is /END)";
        return Err(Fault::unclosed(sections.name.start, what));
    }
    Ok(listing)
}

/// Lists a point. Indices stay those of the text: points without group 1 are of another robot and
/// have no target.
fn add(script: &mut Script, listing: &mut Listing, point: &Point, names: &ExternalNames) {
    let index = short(listing.points.len());
    let target = point.content.map(|content| {
        let (shape, variant, trouble) = match content {
            Content::Pose { configured } => (Shape::Pose, u8::from(!configured), None),
            Content::Joints => (Shape::Joints, 0, None),
            Content::Trouble(trouble) => (Shape::Pose, 1, Some(trouble)),
        };
        script.targets.push(Target {
            name: Some(format!("P[{}]", point.number).into()),
            file: listing.file,
            offset: point.offset,
            end: point.end,
            layout: Layout { shape, variant },
            numbers: short(point.numbers.start)..short(point.numbers.end),
            blocked: trouble.is_some(),
        });
        let target = script.targets.len() - 1;
        if let Some(trouble) = trouble {
            script.refuse(target, trouble.remark());
        }
        // of a point that stays nothing else is said
        let external = if trouble.is_none() {
            &point.external[..]
        } else {
            &[]
        };
        for Axis { name, value, unit } in external {
            let value = *value;
            match names.meaning(name) {
                ExternalUse::Listed(axis) => {
                    let wanted = if names.linear[usize::from(axis)] {
                        "mm"
                    } else {
                        "deg"
                    };
                    if !unit.is_empty() && !unit.eq_ignore_ascii_case(wanted) {
                        script.refuse(target, other_unit(name, unit, wanted));
                    }
                    script.externals.push((target, External { axis, value }));
                }
                // a user frame that stands still does not feel other groups, and one that rides
                // feels all axes of its group
                ExternalUse::Unknown
                    if value != 0.0 && (!name.starts_with('G') || names.knows_group_of(name)) =>
                {
                    script.refuse(target, Remark::external_unknown(name, value));
                }
                _ => {}
            }
        }
        target
    });
    let twin = listing.by_number.insert(point.number, index);
    if let Some(twin) = twin {
        let both = [listing.points[twin as usize].target, target];
        for target in both.into_iter().flatten() {
            script.refuse(target, Why::Ambiguous.remark());
        }
    }
    listing.uses_active |= point.tool.is_none() || point.frame.is_none();
    listing.points.push(Taught {
        number: point.number,
        target,
        tool: point.tool,
        frame: point.frame,
        is_joints: point.content == Some(Content::Joints),
        has_other_arm: point.has_other_arm,
        twin,
    });
}

/// An axis that the profile has in another unit.
fn other_unit(name: &str, unit: &str, wanted: &str) -> Remark {
    Remark::error_about(
        "external-axis-unknown",
        format!("external axis {name} is written in `{unit}`, and the profile has it in {wanted}"),
        "is this the profile of this cell? describe the axis under `external_axes` as it is",
    )
}

/// The first word behind `/PROG`, in capitals.
fn program_name(text: &[u8]) -> Box<str> {
    let word = text.split(u8::is_ascii_whitespace).next();
    called(word.unwrap_or_default())
}

/// A program's name, in capitals.
pub(super) fn called(name: &[u8]) -> Box<str> {
    Source::text(&name.to_ascii_uppercase()).into()
}

/// Whether the application data name a line tracking schedule other than 0.
fn tracks_line(head: &[u8]) -> bool {
    const KEY: &[u8] = b"LINE_TRACK_SCHEDULE_NUMBER";
    let Some(at) = memchr::memmem::find(head, KEY) else {
        return false;
    };
    let rest = head[at + KEY.len()..].trim_ascii_start();
    let value = rest.strip_prefix(b":").unwrap_or(rest).trim_ascii_start();
    let mut digits = value.iter().take_while(|b| b.is_ascii_digit());
    digits.any(|&digit| digit != b'0')
}

impl Reader<'_> {
    fn listing(&mut self, listing: Listing) {
        self.listing = listing;
        let file = self.listing.file;
        self.bytes = &self.sources[file as usize].bytes;
        let script = &self.builder.script;
        let (lists, arguments) = (script.lists.len(), script.arguments.len());
        let (instructions, writes) = (script.instructions.len(), script.writes.len());
        self.builder.open(self.listing.routine);
        self.known.begin(self.listing.routine);
        let lines: Vec<Line> = Lines::new(self.bytes, self.listing.lines.clone()).collect();
        self.lines(file, &lines);
        self.end();
        self.builder.close();
        // points that the program writes are variables wherever it names them
        let written = std::mem::take(&mut self.listing.written);
        if written.is_empty() {
            return;
        }
        let replace = |value: &mut Expr| {
            if let Expr::Target(target) = *value
                && let Some(&variable) = written.get(&target)
            {
                *value = Expr::Variable(variable);
            }
        };
        let script = &mut self.builder.script;
        script.lists[lists..].iter_mut().for_each(replace);
        let instructions = script.instructions[instructions..].iter_mut();
        instructions.for_each(|instruction| replace(&mut instruction.target));
        let arguments = script.arguments[arguments..].iter_mut();
        arguments.for_each(|argument| replace(&mut argument.value));
        for write in &mut script.writes[writes..] {
            if let How::Whole(value) = &mut write.how {
                replace(value);
            }
        }
    }

    /// The targets that a position may be.
    pub(super) fn targets(&self, named: Named) -> Vec<TargetId> {
        let points = &self.listing.points;
        match named {
            Named::Point(number) => {
                let index = self.listing.by_number.get(&number);
                index
                    .and_then(|index| points[*index as usize].target)
                    .into_iter()
                    .collect()
            }
            Named::AnyPoint => points.iter().filter_map(|point| point.target).collect(),
            Named::Register(_) | Named::Computed => Vec::new(),
        }
    }

    /// The variable of a point that the program writes.
    pub(super) fn written(&mut self, target: TargetId) -> VariableId {
        self.written_points.insert(target);
        let script = &mut self.builder.script;
        *self.listing.written.entry(target).or_insert_with(|| {
            let Target { name, .. } = script.targets[target].clone();
            let place = script.targets[target].place();
            script.variable(Variable {
                kept: true,
                ..Variable::new(name.unwrap_or_default(), place, Expr::Target(target))
            })
        })
    }

    /// The variable of an argument of a routine's call, `AR[n]`.
    pub(super) fn argument(&mut self, routine: RoutineId, number: u32) -> VariableId {
        let (script, chosen) = (&mut self.builder.script, self.controller.chosen);
        *self.arguments.entry((routine, number)).or_insert_with(|| {
            script.variable(Variable {
                routine: Some(routine),
                ..Variable::new(format!("AR[{number}]"), self.place, Expr::Unknown(chosen))
            })
        })
    }

    /// The variable of a position register.
    pub(super) fn register(&mut self, number: u32) -> VariableId {
        self.controller.register(&mut self.builder.script, number)
    }

    /// Notes that a register is read; its number where it is one, as a whole.
    pub(super) fn reads(&mut self, register: Register) -> Option<u32> {
        match register.number {
            Some(number) => _ = self.read.insert(number),
            None => self.reads_any = true,
        }
        register.number.filter(|_| !register.is_element)
    }

    /// A finding of the reader.
    pub(super) fn say(&mut self, place: Place, remark: Remark) {
        self.builder.script.say(self.sources, place, remark);
    }

    /// What depends on all programs: what registers hold.
    fn finish(mut self) -> (Builder, Known) {
        self.copies.dedup();
        for (place, register) in std::mem::take(&mut self.copies) {
            if !self.reads_any && !self.read.contains(&register) {
                let message = "a point is copied into a register here, which nothing in the files \
                    goes to; it takes its correction along";
                let hint = "look where the register is used, or give those programs too";
                self.say(place, Remark::warning("target-copied", message, hint));
            }
        }
        for (write, number) in std::mem::take(&mut self.from_registers) {
            if self.aliased.contains(&number) {
                let variable = self.register(number);
                self.builder.script.writes[write].how = How::Whole(Expr::Variable(variable));
            }
        }
        let copied = self.finish_offsets();
        self.finish_registers(&copied);
        let mut all = vec![Expr::Unknown(self.controller.computed)];
        for number in std::mem::take(&mut self.aliased) {
            all.push(Expr::Variable(self.register(number)));
        }
        if all.len() > 1 && !self.to_any_register.is_empty() {
            let any = self.builder.script.any(all);
            for instruction in self.to_any_register {
                self.builder.script.instructions[instruction].target = any;
            }
        }
        (self.builder, self.known)
    }
}
