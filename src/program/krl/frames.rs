//! Tools, bases, loads and modes: `$TOOL`, `$BASE`, `$LOAD`, `$IPO_MODE`, the tables they are taken from, BAS and FDAT.

use super::aggregate;
use super::names::{Fdat, Index, Stored, whole};
use super::reader::{Reader, fdat, is_external, load};
use super::targets::Owner;
use super::tokens::{Cursor, Kind, Read, Token, capitals};
use crate::finding::Severity;
use crate::geometry::units::{DEG, m_from_mm};
use crate::geometry::{Pose, Rotation};
use crate::program::script::{
    Expr, Held, How, NamedFrame, Part, PartValue, Place, Remark, Script, TableId, ValueId,
    Variable, VariableId, Write, Written, short,
};
use crate::program::{Load, Number, number};
use std::collections::{HashMap, HashSet};

/// A table of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Table {
    Tool,
    Base,
    Load,
}

impl Table {
    /// The table of a name in capitals.
    pub fn named(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"TOOL_DATA" => Self::Tool,
            b"BASE_DATA" => Self::Base,
            b"LOAD_DATA" => Self::Load,
            _ => return None,
        })
    }

    fn name(self) -> &'static str {
        ["TOOL_DATA", "BASE_DATA", "LOAD_DATA"][self as usize]
    }
}

/// What data lists say of one entry.
#[derive(Clone, Copy, Debug)]
enum Entry {
    Frame([Part; 6]),
    Missing,
    /// Several data lists say several things.
    Ambiguous,
}

/// Tools, bases and loads of data lists.
#[derive(Debug, Default)]
pub struct Declared {
    entries: HashMap<(Table, u32), Entry>,
    pub loads: HashMap<u32, Load>,
    /// Bases that hang on another kinematic.
    pub moving: HashSet<u32>,
}

impl Declared {
    pub fn add(&mut self, table: Table, at: u32, frame: Option<[Number; 6]>, file: u32) {
        let new = frame.map(|numbers| numbers.map(|number| part(number, file)));
        let entry = self.entries.entry((table, at)).or_insert(Entry::Missing);
        *entry = match (&*entry, new) {
            (Entry::Missing, Some(parts)) => Entry::Frame(parts),
            (Entry::Missing, None) => Entry::Missing,
            (Entry::Frame(old), Some(new)) if is_same(old, &new) => Entry::Frame(new),
            _ => Entry::Ambiguous,
        };
    }
}

fn part(number: Number, file: u32) -> Part {
    Part {
        value: PartValue::Number(number.value),
        place: Place {
            file,
            offset: number.start,
        },
        length: number.length,
    }
}

/// Whether two frames are one, as far as the controller's numbers of 32 bits tell.
fn is_same(a: &[Part; 6], b: &[Part; 6]) -> bool {
    let near = |(a, b): (&Part, &Part)| match (a.value, b.value) {
        (PartValue::Number(a), PartValue::Number(b)) => (a - b).abs() <= 1e-6 * a.abs().max(1.0),
        _ => false,
    };
    a.iter().zip(b).all(near)
}

/// A state of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    Tool,
    Base,
    Load,
    Ipo,
    FdatTool,
    FdatBase,
    FdatIpo,
    ActTool,
    ActBase,
}

impl State {
    const NAMES: [&str; 9] = [
        "$TOOL",
        "$BASE",
        "$LOAD",
        "$IPO_MODE",
        "FDAT_ACT.TOOL_NO",
        "FDAT_ACT.BASE_NO",
        "FDAT_ACT.IPO_FRAME",
        "$ACT_TOOL",
        "$ACT_BASE",
    ];

    /// The state of a name in capitals.
    pub fn named(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"$TOOL" => Self::Tool,
            b"$BASE" => Self::Base,
            b"$LOAD" => Self::Load,
            b"$IPO_MODE" => Self::Ipo,
            b"$ACT_TOOL" => Self::ActTool,
            b"$ACT_BASE" => Self::ActBase,
            _ => return None,
        })
    }
}

/// A number that chooses an entry of a table.
#[derive(Clone, Copy, Debug)]
enum Choice {
    Entry(u32),
    /// The number that a variable holds.
    By(VariableId),
}

/// States of the controller in the script, and values that are needed often.
#[derive(Debug)]
pub struct Modal {
    states: [VariableId; 9],
    tables: [TableId; 3],
    entries: HashMap<(Table, u32), VariableId>,
    /// What $TOOL and $BASE were before the program.
    initial: [ValueId; 2],
    zero: [Option<ValueId>; 2],
    /// Frames that the files do not declare, by name.
    undeclared: HashMap<Box<str>, ValueId>,
    numbers: HashMap<u32, ValueId>,
    pub on: ValueId,
    off: ValueId,
    external: ValueId,
    /// Indices in the script's guards: by `$IPO_MODE`, by it and an angle, by a fixed tool, by an unknown mode.
    pub guards: u32,
    pub angle_guards: u32,
    fixed_guards: u32,
    chosen_guards: u32,
}

fn record(script: &mut Script, name: &str, parts: &[Part]) -> ValueId {
    let first = short(script.parts.len());
    script.parts.extend_from_slice(parts);
    let parts = first..short(script.parts.len());
    script.value(Held::Record {
        name: name.into(),
        parts,
    })
}

const NOWHERE: Place = Place { file: 0, offset: 0 };

fn parts_of(value: PartValue) -> [Part; 6] {
    [Part {
        value,
        place: NOWHERE,
        length: 0,
    }; 6]
}

impl Modal {
    pub fn new(script: &mut Script) -> Self {
        let missing = parts_of(PartValue::Missing);
        let initial = ["$TOOL", "$BASE"].map(|name| record(script, name, &missing));
        let [on, off] = [true, false].map(|flag| script.value(Held::Flag(flag)));
        let tables = [Table::Tool, Table::Base, Table::Load].map(|table| {
            script.tables.push(crate::program::script::Table {
                name: table.name().into(),
                ..Default::default()
            });
            short(script.tables.len() - 1)
        });
        let chosen = script.remark(chosen());
        let states = std::array::from_fn(|at| {
            let declared = match at {
                0 | 1 => Expr::Value(initial[at]),
                2 => Expr::Value(off),
                3 => Expr::Value(on),
                _ => Expr::Unknown(chosen),
            };
            script.variable(Variable {
                name: State::NAMES[at].into(),
                place: NOWHERE,
                declared,
                kept: false,
                shared: true,
                routine: None,
            })
        });
        let external = script.remark(external());
        let external = script.value(Held::Remark(external));
        let angle = script.remark(super::moves::angle());
        let angle = script.value(Held::Remark(angle));
        let [angle, fixed, chosen] = [
            Expr::Value(angle),
            Expr::Value(external),
            Expr::Unknown(chosen),
        ]
        .map(|declared| {
            script.variable(Variable {
                name: "the move".into(),
                place: NOWHERE,
                declared,
                kept: false,
                shared: false,
                routine: None,
            })
        });
        let mode = states[State::Ipo as usize];
        let mut guard = |of: &[VariableId]| {
            script.guards.push(of.into());
            short(script.guards.len() - 1)
        };
        Self {
            guards: guard(&[mode]),
            angle_guards: guard(&[mode, angle]),
            fixed_guards: guard(&[fixed]),
            chosen_guards: guard(&[chosen]),
            states,
            tables,
            entries: HashMap::new(),
            initial,
            zero: [None; 2],
            undeclared: HashMap::new(),
            numbers: HashMap::new(),
            on,
            off,
            external,
        }
    }

    /// What a state holds.
    pub fn expr(&self, state: State) -> Expr {
        Expr::Variable(self.states[state as usize])
    }

    /// What speaks against a move with a mode of its own.
    pub fn guards_of(&self, mode: Expr) -> u32 {
        match mode {
            Expr::Value(value) if value == self.on => 0,
            Expr::Value(_) => self.fixed_guards,
            _ => self.chosen_guards,
        }
    }
}

/// Only the running program knows the tool or base.
pub fn chosen() -> Remark {
    Remark {
        id: "frame-chosen-at-run-time",
        severity: Severity::Error,
        text: "only the running program knows the tool or base".into(),
        hint: "set $TOOL and $BASE before the move in the same routine",
    }
}

fn assigned() -> Remark {
    Remark {
        id: "frame-assigned-at-run-time",
        severity: Severity::Error,
        text: "the running program changes the tool or base".into(),
        hint: "assign it with numbers, or use another entry for each place",
    }
}

fn ambiguous() -> Remark {
    Remark {
        id: "frame-name-ambiguous",
        severity: Severity::Error,
        text: "the tool or base is declared more than once with different values".into(),
        hint: "pass one $config.dat only",
    }
}

fn moving() -> Remark {
    Remark {
        id: "moving-frame",
        severity: Severity::Error,
        text: "another kinematic moves the base (EK, MACHINE_FRAME_DAT)".into(),
        hint: "moves in a moving base are not compensated",
    }
}

fn external() -> Remark {
    Remark {
        id: "external-tcp",
        severity: Severity::Error,
        text: "the robot holds the work piece and the tool stands still (#TCP)".into(),
        hint: "moves with a fixed tool are not compensated",
    }
}

/// `X Y Z A B C` in mm and degrees as a pose.
pub fn pose_of([x, y, z, a, b, c]: [f64; 6]) -> Pose {
    Pose {
        rotation: Rotation::from_rzryrx([a * DEG, b * DEG, c * DEG]),
        translation: [x, y, z].map(m_from_mm),
    }
}

/// See [`crate::program::Language::frame_of`]: X Y Z A B C, and of a tool of the table its load.
pub fn frame_of(name: &str, parts: &[Part]) -> Result<NamedFrame, Remark> {
    let mut numbers = [0.0; 10];
    let (mut missing, mut given) = (0, 0);
    for (at, part) in parts.iter().enumerate().take(10) {
        match part.value {
            PartValue::Number(value) => {
                numbers[at] = value;
                given += u32::from(at < 6);
            }
            PartValue::Missing => missing += u32::from(at < 6),
            _ => return Err(assigned()),
        }
    }
    if missing > 0 && given > 0 {
        return Err(Remark {
            text: "the running program changes a part of the tool or base, and the files do not tell the rest".into(),
            hint: "give the $config.dat that declares it, too",
            ..assigned()
        });
    }
    let [frame @ .., mass_kg, x, y, z] = numbers;
    Ok(NamedFrame {
        name: name.into(),
        pose: (missing == 0).then(|| pose_of(frame)),
        load: (parts.len() == 10).then_some(Load {
            mass_kg,
            cog_m: [x, y, z],
        }),
    })
}

impl Reader {
    /// A tool or base that only the running program knows.
    pub(super) fn chosen(&mut self) -> Expr {
        self.unknown(chosen())
    }

    pub(super) fn unknown(&mut self, remark: Remark) -> Expr {
        Expr::Unknown(self.builder.script.remark(remark))
    }

    /// Sets a state of the controller.
    pub(super) fn set(&mut self, place: Place, state: State, value: Expr) {
        if matches!(state, State::Tool | State::Base | State::Ipo) {
            self.last = None;
        }
        let variable = self.modal.states[state as usize];
        self.put(place, variable, value);
    }

    pub(super) fn put(&mut self, place: Place, variable: VariableId, value: Expr) {
        self.builder.write(Write {
            place,
            variable: Written::One(variable),
            how: How::Whole(value),
        });
    }

    /// An entry of a table.
    fn entry(&mut self, table: Table, at: u32) -> VariableId {
        if let Some(&known) = self.modal.entries.get(&(table, at)) {
            return known;
        }
        let name = format!("{}[{at}]", table.name());
        let declared = self.declared.entries.get(&(table, at)).copied();
        let declared = match declared.unwrap_or(Entry::Missing) {
            _ if table == Table::Load => self.load_value(self.declared.loads.get(&at).copied()),
            _ if table == Table::Base && self.declared.moving.contains(&at) => {
                self.unknown(moving())
            }
            Entry::Ambiguous => self.unknown(ambiguous()),
            Entry::Frame(parts) => Expr::Value(self.frame_value(table, &name, at, &parts)),
            Entry::Missing => {
                let zero = at == 0;
                let value = if zero {
                    PartValue::Number(0.0)
                } else {
                    PartValue::Missing
                };
                Expr::Value(self.frame_value(table, &name, at, &parts_of(value)))
            }
        };
        let script = &mut self.builder.script;
        let made = script.variable(Variable {
            name: name.into(),
            place: NOWHERE,
            declared,
            kept: true,
            shared: false,
            routine: None,
        });
        let entries = &mut script.tables[self.modal.tables[table as usize] as usize].entries;
        entries.insert(i64::from(at), made);
        self.modal.entries.insert((table, at), made);
        made
    }

    /// A frame, and behind it the load that belongs to a tool.
    fn frame_value(&mut self, table: Table, name: &str, at: u32, parts: &[Part; 6]) -> ValueId {
        let load = self.declared.loads.get(&at);
        let mut parts = parts.to_vec();
        if let (Table::Tool, Some(load)) = (table, load) {
            let [x, y, z] = load.cog_m;
            parts.extend([load.mass_kg, x, y, z].map(|value| Part {
                value: PartValue::Number(value),
                place: NOWHERE,
                length: 0,
            }));
        }
        record(&mut self.builder.script, name, &parts)
    }

    fn load_value(&mut self, load: Option<Load>) -> Expr {
        Expr::Value(match load {
            Some(_) => self.builder.script.value(Held::Load(load)),
            // the tool's own, if any
            None => self.modal.off,
        })
    }

    pub(super) fn number_value(&mut self, number: u32) -> Expr {
        let script = &mut self.builder.script;
        let numbers = &mut self.modal.numbers;
        let value = numbers.entry(number);
        let value = value.or_insert_with(|| script.value(Held::Number(i64::from(number))));
        Expr::Value(*value)
    }

    fn mode_value(&mut self, is_external: Option<bool>) -> Expr {
        match is_external {
            Some(false) => Expr::Value(self.modal.on),
            Some(true) => Expr::Value(self.modal.external),
            None => self.chosen(),
        }
    }

    /// What the chosen entry of a table holds.
    fn element(&mut self, table: Table, choice: Option<Choice>) -> Expr {
        match choice {
            Some(Choice::Entry(at)) => Expr::Variable(self.entry(table, at)),
            Some(Choice::By(number)) => Expr::Element {
                table: self.modal.tables[table as usize],
                number,
            },
            None => self.chosen(),
        }
    }

    /// The number of a tool, base or load up to the end of the cursor: `3`, `n`, `FP1.TOOL_NO`.
    fn choice(&mut self, mut cursor: Cursor, table: Table) -> Option<Choice> {
        let token = cursor.next();
        if token.kind == Kind::Number {
            let alone = cursor.peek().kind == Kind::End;
            let value = whole(number::parse(cursor.text(token))).filter(|_| alone)?;
            self.foresee(value);
            return Some(Choice::Entry(value));
        }
        if token.kind != Kind::Name {
            return None;
        }
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(token), &mut buffer);
        if let (Some(state @ (State::ActTool | State::ActBase)), Kind::End) =
            (State::named(word), cursor.peek().kind)
        {
            return Some(Choice::By(self.modal.states[state as usize]));
        }
        let is_active = word == b"FDAT_ACT";
        let name = self.symbol(&cursor, token);
        let at = Index::of(cursor.brackets().ok()?, &cursor);
        if cursor.take(b'.') {
            let mut buffer = [0; 24];
            let part = cursor.next();
            let is_tool = match capitals(cursor.text(part), &mut buffer) {
                b"TOOL_NO" => true,
                b"BASE_NO" => false,
                _ => return None,
            };
            if is_active {
                let state = if is_tool {
                    State::FdatTool
                } else {
                    State::FdatBase
                };
                return Some(Choice::By(self.modal.states[state as usize]));
            }
            let fdat = self.fdat_of(name, at)?;
            let number = if is_tool { fdat.tool } else { fdat.base };
            return number.map(Choice::Entry);
        }
        if cursor.peek().kind != Kind::End {
            return None;
        }
        if let Some(fdat) = self.fdat_of(name, at) {
            let number = if table == Table::Base {
                fdat.base
            } else {
                fdat.tool
            };
            return number.map(Choice::Entry);
        }
        let context = self.context();
        if let Some(Stored::Number(number)) = self.names.constant(name, at, context) {
            return Some(Choice::Entry(number));
        }
        if !self.names.choosing.contains(&name) || at != Index::Whole {
            return None;
        }
        match self.named(name, at) {
            Some(Expr::Variable(variable)) => Some(Choice::By(variable)),
            _ => None,
        }
    }

    /// A number that may choose an entry: that is one, then.
    pub(super) fn foresee(&mut self, number: u32) {
        for table in [Table::Tool, Table::Base, Table::Load] {
            self.entry(table, number);
        }
    }

    /// The FDAT of a name, where the files have it and no statement changes it.
    fn fdat_of(&self, name: crate::program::names::Symbol, at: Index) -> Option<Fdat> {
        match self.names.constant(name, at, self.context())? {
            Stored::Fdat(fdat) => Some(fdat),
            _ => None,
        }
    }

    /// The value given to a state, up to a comma or the end of the line.
    pub(super) fn state_value(&mut self, state: State, cursor: &mut Cursor) -> Read<Expr> {
        let value = match state {
            State::Tool => self.frame(Table::Tool, "$TOOL", cursor)?,
            State::Base => self.frame(Table::Base, "$BASE", cursor)?,
            State::Load => self.load_expr(cursor)?,
            State::Ipo => {
                let mode = self.mode(cursor);
                self.mode_value(mode)
            }
            _ => match self.choice(*cursor, Table::Tool) {
                Some(Choice::Entry(number)) => self.number_value(number),
                Some(Choice::By(variable)) => Expr::Variable(variable),
                None => self.chosen(),
            },
        };
        Ok(value)
    }

    /// `#TCP`, `SIPO_MODE(FP1.IPO_FRAME)`
    fn mode(&mut self, cursor: &mut Cursor) -> Option<bool> {
        if cursor.take(b'#') {
            let name = cursor.next();
            return is_external(cursor.text(name));
        }
        let name = cursor.next();
        let is_function = cursor.text(name).eq_ignore_ascii_case(b"SIPO_MODE");
        let inner = inside(cursor).filter(|_| is_function)?;
        let mut inner = inner;
        if inner.take(b'#') {
            let name = inner.next();
            return is_external(inner.text(name));
        }
        let token = inner.next();
        let name = self.symbol(&inner, token);
        let at = Index::of(inner.brackets().ok()?, &inner);
        self.fdat_of(name, at)?.is_external
    }

    /// A tool or base up to a comma or the end of the line; one that is written out is called `name`.
    pub(super) fn frame(&mut self, table: Table, name: &str, cursor: &mut Cursor) -> Read<Expr> {
        let found = self.plain_frame(table, name, cursor)?;
        match cursor.blanks() {
            0 | b',' | b';' => Ok(found),
            // C_DIS behind the last WITH
            _ if cursor.peek().kind == Kind::Name => Ok(found),
            _ => {
                super::moves::skip_value(cursor);
                Ok(self.chosen())
            }
        }
    }

    fn plain_frame(&mut self, table: Table, called: &str, cursor: &mut Cursor) -> Read<Expr> {
        if cursor.blanks() == b'{' {
            let found = aggregate::read(cursor)?;
            let file = self.file;
            return Ok(match found.frame() {
                Some(numbers) => {
                    let parts = numbers.map(|number| part(number, file));
                    Expr::Value(record(&mut self.builder.script, called, &parts))
                }
                None => self.chosen(),
            });
        }
        let name = cursor.next();
        if name.kind != Kind::Name {
            return Ok(self.chosen());
        }
        let at = cursor.brackets()?;
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(name), &mut buffer);
        if let (Some(of @ (Table::Tool | Table::Base)), Some((start, end))) =
            (Table::named(word), at)
            && !matches!(cursor.blanks(), b'.' | b'(')
        {
            let choice = self.choice(cursor.part(start, end), of);
            return Ok(self.element(of, choice));
        }
        if matches!(cursor.blanks(), b'(') {
            let inner = inside(cursor);
            return Ok(match (word, inner) {
                (b"STOOL" | b"STOOL2", Some(inner)) => {
                    let choice = self.choice(inner, Table::Tool);
                    self.element(Table::Tool, choice)
                }
                (b"SBASE", Some(inner)) => {
                    let choice = self.choice(inner, Table::Base);
                    self.element(Table::Base, choice)
                }
                (b"EK", _) if table == Table::Base => self.unknown(moving()),
                _ => self.chosen(),
            });
        }
        if cursor.blanks() == b'.' {
            cursor.skip();
            return Ok(self.chosen());
        }
        match (table, word) {
            (_, b"$NULLFRAME") | (Table::Base, b"$WORLD") => {
                let script = &mut self.builder.script;
                let zero = &mut self.modal.zero[usize::from(word == b"$WORLD")];
                let name = std::str::from_utf8(word).unwrap_or_default();
                let parts = parts_of(PartValue::Number(0.0));
                let value = *zero.get_or_insert_with(|| record(script, name, &parts));
                Ok(Expr::Value(value))
            }
            (_, b"$TOOL") => Ok(self.modal.expr(State::Tool)),
            (_, b"$BASE") => Ok(self.modal.expr(State::Base)),
            _ => {
                let symbol = self.symbol(cursor, name);
                let at = Index::of(at, cursor);
                Ok(self.frame_named(symbol, at))
            }
        }
    }

    /// A tool or base that is a variable.
    fn frame_named(&mut self, name: crate::program::names::Symbol, at: Index) -> Expr {
        match self.named(name, at) {
            Some(Expr::Unknown(_)) => self.chosen(),
            Some(found) => found,
            None => {
                let script = &mut self.builder.script;
                let spelled = self.names.symbols.spelling(name);
                let known = self.modal.undeclared.get(spelled).copied();
                Expr::Value(known.unwrap_or_else(|| {
                    let made = record(script, spelled, &parts_of(PartValue::Missing));
                    self.modal.undeclared.insert(spelled.into(), made);
                    made
                }))
            }
        }
    }

    /// A load up to a comma or the end of the line.
    fn load_expr(&mut self, cursor: &mut Cursor) -> Read<Expr> {
        if cursor.blanks() == b'{' {
            let load = load(cursor)?;
            return Ok(self.load_value(load));
        }
        let name = cursor.next();
        let at = cursor.brackets()?;
        let mut buffer = [0; 24];
        let choice = match (capitals(cursor.text(name), &mut buffer), at) {
            (b"LOAD_DATA", Some((start, end))) => self.choice(cursor.part(start, end), Table::Load),
            (b"SLOAD", None) => inside(cursor).and_then(|inner| self.choice(inner, Table::Load)),
            _ => None,
        };
        let is_whole = !matches!(cursor.blanks(), b'.' | b':');
        Ok(match choice.filter(|_| is_whole) {
            None => {
                cursor.skip();
                self.load_value(None)
            }
            choice => self.element(Table::Load, choice),
        })
    }

    /// `BAS(#TOOL,1)`
    pub(super) fn bas(&mut self, first: Token, mut cursor: Cursor) {
        let place = self.place(first);
        cursor.take(b'(');
        if !cursor.take(b'#') {
            // a command that only the running program knows
            for state in [State::Tool, State::Base] {
                let chosen = self.chosen();
                self.set(place, state, chosen);
            }
            return;
        }
        let command = cursor.next();
        let argument = cursor.take(b',').then(|| {
            let start = cursor.at;
            cursor.skip();
            cursor.part(start, cursor.at)
        });
        let choice = |reader: &mut Self, table| match argument {
            Some(argument) => reader.choice(argument, table),
            None => Some(Choice::Entry(0)),
        };
        let mut buffer = [0; 24];
        match capitals(cursor.text(command), &mut buffer) {
            b"INITMOV" => {
                let [tool, base] = self.modal.initial.map(Expr::Value);
                self.set(place, State::Tool, tool);
                self.set(place, State::Base, base);
                self.set(place, State::Ipo, Expr::Value(self.modal.on));
            }
            b"TOOL" => {
                let choice = choice(self, Table::Tool);
                self.choose(place, Table::Tool, choice);
            }
            b"BASE" => {
                let choice = choice(self, Table::Base);
                self.choose(place, Table::Base, choice);
            }
            b"FRAMES" | b"PTP_PARAMS" | b"CP_PARAMS" | b"PARAMS" => {
                let [tool, base] = [State::FdatTool, State::FdatBase]
                    .map(|state| Choice::By(self.modal.states[state as usize]));
                self.choose(place, Table::Tool, Some(tool));
                self.choose(place, Table::Base, Some(base));
                self.set(place, State::Ipo, self.modal.expr(State::FdatIpo));
            }
            _ => {}
        }
    }

    /// Sets a tool with its load, or a base, of a table.
    fn choose(&mut self, place: Place, table: Table, choice: Option<Choice>) {
        let (state, active, name) = match table {
            Table::Base => (State::Base, State::ActBase, &b"$act_base"[..]),
            _ => (State::Tool, State::ActTool, &b"$act_tool"[..]),
        };
        let frame = self.element(table, choice);
        self.set(place, state, frame);
        if table == Table::Tool {
            let load = match choice {
                Some(_) => self.element(Table::Load, choice),
                None => self.load_value(None),
            };
            self.set(place, State::Load, load);
        }
        let used = self.names.symbols.find(name);
        if used.is_some_and(|name| self.names.choosing.contains(&name)) {
            let number = match choice {
                Some(Choice::Entry(number)) => self.number_value(number),
                Some(Choice::By(variable)) => Expr::Variable(variable),
                None => self.chosen(),
            };
            self.set(place, active, number);
        }
    }

    /// `FDAT_ACT=FP1`, `FDAT_ACT={...}`; the cursor stands behind `=`.
    pub(super) fn activate(&mut self, place: Place, cursor: &mut Cursor) -> Read<()> {
        let found = if cursor.blanks() == b'{' {
            Some(fdat(cursor)?)
        } else {
            let token = cursor.next();
            let name = self.symbol(cursor, token);
            let at = Index::of(cursor.brackets()?, cursor);
            self.fdat_of(name, at)
        };
        let fdat = found.unwrap_or_default();
        for (state, number) in [(State::FdatTool, fdat.tool), (State::FdatBase, fdat.base)] {
            let value = match number {
                Some(number) => {
                    self.foresee(number);
                    self.number_value(number)
                }
                None => self.chosen(),
            };
            self.set(place, state, value);
        }
        let mode = self.mode_value(fdat.is_external);
        self.set(place, State::FdatIpo, mode);
        Ok(())
    }

    /// `FDAT_ACT.TOOL_NO=3`; the cursor stands behind `=`.
    pub(super) fn activate_part(&mut self, place: Place, part: &[u8], cursor: &mut Cursor) {
        let state = match part {
            b"TOOL_NO" => State::FdatTool,
            b"BASE_NO" => State::FdatBase,
            b"IPO_FRAME" => {
                let mode = self.mode(cursor);
                let mode = self.mode_value(mode);
                return self.set(place, State::FdatIpo, mode);
            }
            _ => return,
        };
        let value = match self.choice(*cursor, Table::Tool) {
            Some(Choice::Entry(number)) => self.number_value(number),
            Some(Choice::By(variable)) => Expr::Variable(variable),
            None => self.chosen(),
        };
        self.set(place, state, value);
    }

    /// A write of a state, or of one of its parts; the cursor stands behind `=`.
    pub(super) fn write_state(
        &mut self,
        place: Place,
        state: State,
        part: Option<&[u8]>,
        cursor: &mut Cursor,
    ) -> Read<()> {
        let variable = Written::One(self.modal.states[state as usize]);
        match part {
            None => {
                let value = self.state_value(state, cursor)?;
                self.set(place, state, value);
            }
            Some(part) if matches!(state, State::Tool | State::Base) => {
                self.last = None;
                self.write_part(place, variable, part, *cursor);
            }
            Some(_) => {
                let unknown = self.load_value(None);
                self.set(place, state, unknown);
            }
        }
        Ok(())
    }

    /// `$TOOL.X=...`, `BASE_DATA[1].X=...`
    fn write_part(&mut self, place: Place, variable: Written, part: &[u8], mut cursor: Cursor) {
        let at = match part {
            [letter] => b"XYZABC".iter().position(|known| known == letter),
            _ => None,
        };
        let Some(at) = at else { return };
        cursor.blanks();
        let start = cursor.at;
        let text = &cursor.bytes[start..cursor.end];
        let text = text.split(|&b| b == b';').next().unwrap_or_default();
        let text = text.trim_ascii_end();
        let value = number::parse(text).filter(|value| value.abs() < aggregate::LARGEST);
        let script = &mut self.builder.script;
        script.parts.push(Part {
            value: value.map_or(PartValue::Computed, PartValue::Number),
            place: Place {
                offset: short(start),
                ..place
            },
            length: u16::try_from(text.len()).unwrap_or(u16::MAX),
        });
        let parts = short(script.parts.len() - 1)..short(script.parts.len());
        self.builder.write(Write {
            place,
            variable,
            how: How::Parts {
                first: short(at),
                parts,
            },
        });
    }

    /// `BASE_DATA[2]={...}`, `TOOL_DATA[n].X=...`; the cursor stands behind `=`.
    pub(super) fn write_entry(
        &mut self,
        place: Place,
        table: Table,
        at: Option<(usize, usize)>,
        part: Option<&[u8]>,
        cursor: &mut Cursor,
    ) -> Read<()> {
        let entry = match Index::of(at, cursor) {
            Index::At([entry, 0, 0]) => Some(entry),
            _ => None,
        };
        let variable = match entry {
            Some(entry) => Written::One(self.entry(table, entry)),
            None => Written::AnyOf(self.modal.tables[table as usize]),
        };
        if let Some(part) = part {
            if table == Table::Load {
                let how = How::Whole(self.load_value(None));
                self.builder.write(Write {
                    place,
                    variable,
                    how,
                });
            } else {
                self.write_part(place, variable, part, *cursor);
            }
            return Ok(());
        }
        let name = format!("{}[{}]", table.name(), entry.unwrap_or_default());
        let value = match table {
            Table::Load => self.load_expr(cursor)?,
            _ => match self.frame(table, &name, cursor)? {
                Expr::Unknown(_) => self.unknown(assigned()),
                known => known,
            },
        };
        self.builder.write(Write {
            place,
            variable,
            how: How::Whole(value),
        });
        Ok(())
    }

    /// The variable of a parameter or of a whole number.
    pub(super) fn variable_of(&mut self, datum: u32) -> VariableId {
        self.variable(Owner::Datum(datum), Index::Whole)
    }
}

/// What stands in the brackets in front, which are taken.
fn inside<'a>(cursor: &mut Cursor<'a>) -> Option<Cursor<'a>> {
    if !cursor.take(b'(') {
        return None;
    }
    let start = cursor.at;
    loop {
        cursor.skip();
        let end = cursor.at;
        if cursor.take(b')') {
            return Some(cursor.part(start, end));
        }
        if !cursor.take(b',') && !cursor.take(b':') {
            return None;
        }
    }
}
