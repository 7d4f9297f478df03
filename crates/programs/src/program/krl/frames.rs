//! Tools, bases, loads and modes: `$TOOL`, `$BASE`, `$LOAD`, `$IPO_MODE`, the tables they are taken
//! from, BAS and FDAT.

use super::names::{Index, Stored, Turning};
use super::reader::Reader;
use super::remarks::{
    ANGLE, CHOSEN, DECLARED_TWICE, FRAME_ASSIGNED, IGNORES_ORIENTATION, KEEPS_ORIENTATION,
    KEEPS_SAME_ORIENTATION, MOVING, OF_ANOTHER_ROBOT, carried, not_in_files,
};
use super::targets::Owner;
use super::tokens::capitals;
use crate::geometry::Pose;
use crate::program::kit;
use crate::program::names::Symbol;
use crate::program::notation::{pose_of_angles, write_angles};
use crate::program::script::{
    Expr, Held, NamedFrame, Part, PartValue, Place, Remark, Script, TableId, ValueId, Variable,
    VariableId, short,
};
use crate::program::{Load, MOST_ANGLE_DEG, Number, Shape, TargetId};
use foldhash::{HashMap, HashMapExt};

/// A table of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Table {
    Tool,
    Base,
    Load,
}

impl Table {
    /// The table of a name in capitals.
    pub(super) fn named(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"TOOL_DATA" => Self::Tool,
            b"BASE_DATA" => Self::Base,
            b"LOAD_DATA" => Self::Load,
            _ => return None,
        })
    }

    pub(super) fn name(self) -> &'static str {
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

/// What data lists say of one load.
#[derive(Clone, Copy, Debug)]
enum Carrying {
    /// None is that of the tool.
    One(Option<Load>),
    /// Several data lists say several things.
    Ambiguous,
}

/// Tools, bases and loads of data lists.
#[derive(Debug, Default)]
pub(super) struct Declared {
    entries: HashMap<(Table, u32), Entry>,
    loads: HashMap<u32, Carrying>,
    /// Bases that hang on another kinematic, and the number of that.
    pub moving: HashMap<u32, u32>,
    /// Bases that hang on a kinematic of another controller.
    pub of_others: std::collections::HashSet<u32>,
    /// `$ROBROOT` of machine data, and where.
    pub roots: Vec<(Place, Pose)>,
    /// Some file speaks of tools that stand still.
    pub has_fixed_tools: bool,
}

impl Declared {
    pub(super) fn add(&mut self, table: Table, at: u32, frame: Option<[Number; 6]>, file: u32) {
        let new = frame.map(|numbers| numbers.map(|number| part(number, file)));
        let entry = self.entries.entry((table, at)).or_insert(Entry::Missing);
        *entry = match (&*entry, new) {
            (Entry::Missing, Some(parts)) => Entry::Frame(parts),
            (Entry::Missing, None) => Entry::Missing,
            (Entry::Frame(old), Some(new)) if is_same(old, &new) => Entry::Frame(new),
            _ => Entry::Ambiguous,
        };
    }

    /// A load; none is that of the tool.
    pub(super) fn add_load(&mut self, at: u32, new: Option<Load>) {
        let entry = self.loads.entry(at).or_insert(Carrying::One(new));
        match entry {
            Carrying::One(old) if is_same_load(*old, new) => {}
            _ => *entry = Carrying::Ambiguous,
        }
    }

    /// The load that belongs to a tool of the table.
    fn load_of_tool(&self, at: u32) -> Option<Load> {
        match self.loads.get(&at) {
            Some(Carrying::One(load)) => *load,
            _ => None,
        }
    }

    /// A tool, or a base that stands still.
    fn still(&self, table: Table, at: u32) -> Option<Pose> {
        let is_on_other = self.moving.contains_key(&at) || self.of_others.contains(&at);
        let is_still = table != Table::Load && !(table == Table::Base && is_on_other);
        let parts = match self.entries.get(&(table, at)).filter(|_| is_still) {
            Some(Entry::Frame(parts)) => parts,
            None if at == 0 && is_still => return Some(Pose::identity()),
            _ => return None,
        };
        let mut numbers = [0.0; 6];
        for (number, part) in numbers.iter_mut().zip(parts) {
            let PartValue::Number(value) = part.value else {
                return None;
            };
            *number = value;
        }
        Some(pose_of(numbers))
    }
}

pub(super) fn part(number: Number, file: u32) -> Part {
    Part {
        value: PartValue::Number(number.value),
        place: Place::new(file, number.start),
        length: number.length,
    }
}

/// Whether two numbers are one, as far as the controller's of 32 bits tell.
fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * a.abs().max(1.0)
}

/// Likewise two frames.
fn is_same(a: &[Part; 6], b: &[Part; 6]) -> bool {
    let near = |(a, b): (&Part, &Part)| match (a.value, b.value) {
        (PartValue::Number(a), PartValue::Number(b)) => is_near(a, b),
        _ => false,
    };
    a.iter().zip(b).all(near)
}

/// Likewise two loads.
fn is_same_load(a: Option<Load>, b: Option<Load>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => {
            let near = |(a, b): (&f64, &f64)| is_near(*a, *b);
            is_near(a.mass_kg, b.mass_kg) && a.cog_m.iter().zip(&b.cog_m).all(near)
        }
        (a, b) => a.is_none() && b.is_none(),
    }
}

/// A state of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Tool,
    Base,
    Load,
    Ipo,
    FdatTool,
    FdatBase,
    FdatIpo,
    ActTool,
    ActBase,
    /// Whether straight moves and arcs keep their orientation.
    Orientation,
    LdatOrientation,
}

impl State {
    const NAMES: [&str; 11] = [
        "$TOOL",
        "$BASE",
        "$LOAD",
        "$IPO_MODE",
        "FDAT_ACT.TOOL_NO",
        "FDAT_ACT.BASE_NO",
        "FDAT_ACT.IPO_FRAME",
        "$ACT_TOOL",
        "$ACT_BASE",
        "$ORI_TYPE",
        "LDAT_ACT.ORI_TYP",
    ];

    /// The state of a name in capitals.
    pub(super) fn named(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"$TOOL" => Self::Tool,
            b"$BASE" => Self::Base,
            b"$LOAD" => Self::Load,
            b"$IPO_MODE" => Self::Ipo,
            b"$ACT_TOOL" => Self::ActTool,
            b"$ACT_BASE" => Self::ActBase,
            b"$ORI_TYPE" => Self::Orientation,
            _ => return None,
        })
    }
}

/// A number that chooses an entry of a table.
#[derive(Clone, Copy, Debug)]
pub(super) enum Choice {
    Entry(u32),
    /// The number that a variable holds.
    By(VariableId),
}

/// States of the controller in the script, and values that are needed often.
#[derive(Debug)]
pub(super) struct States {
    pub states: [VariableId; 11],
    pub tables: [TableId; 3],
    entries: HashMap<(Table, u32), VariableId>,
    /// What $TOOL and $BASE were before the program.
    pub initial: [ValueId; 2],
    /// Frames that the files do not declare, and those that are zero, by name.
    known: HashMap<Box<str>, ValueId>,
    numbers: HashMap<u32, ValueId>,
    pub on: ValueId,
    off: ValueId,
    external: ValueId,
    /// The orientation stays what it is.
    keeps: ValueId,
    /// Likewise, of moves to the orientation that they start in.
    keeps_same: ValueId,
    /// That of the point does not count.
    ignored: ValueId,
    /// Guards of moves: an angle (CA), and what `$ORI_TYPE` ignores.
    pub angle: VariableId,
    pub ignoring: VariableId,
    /// What is said of moves to the orientation that they start in: by `$ORI_TYPE` and by `LDAT_ACT`.
    pub keeping: [VariableId; 2],
    /// A sensor corrects moves (KUKA.RobotSensorInterface).
    pub sensor: VariableId,
    /// External axes that move independently of the program, and those that it does not move.
    pub apart: [VariableId; 2],
}

/// A kinematic of the controller by its names.
pub(super) fn unit(number: u32) -> Box<[Box<str>]> {
    [format!("MACHINE_DEF[{number}]"), number.to_string()]
        .map(Into::into)
        .into()
}

pub(super) fn record(script: &mut Script, name: &str, parts: &[Part]) -> ValueId {
    carried_record(script, name, parts, Box::default())
}

/// A frame on a kinematic.
pub(super) fn carried_record(
    script: &mut Script,
    name: &str,
    parts: &[Part],
    on: Box<[Box<str>]>,
) -> ValueId {
    let first = short(script.parts.len());
    script.parts.extend_from_slice(parts);
    let parts = first..short(script.parts.len());
    script.value(Held::Record {
        name: name.into(),
        parts,
        on,
    })
}

/// A part that stands nowhere.
pub(super) fn part_of(value: PartValue) -> Part {
    Part {
        value,
        place: Place::NOWHERE,
        length: 0,
    }
}

pub(super) fn parts_of(value: PartValue) -> [Part; 6] {
    [part_of(value); 6]
}

impl States {
    pub(super) fn new(script: &mut Script) -> Self {
        let missing = parts_of(PartValue::Missing);
        let initial = ["$TOOL", "$BASE"].map(|name| record(script, name, &missing));
        let [on, off] = [true, false].map(|flag| script.value(Held::Flag(flag)));
        let tables = [Table::Tool, Table::Base, Table::Load].map(|table| {
            let unknown = (table == Table::Load).then(|| script.remark(carried()));
            let made = script.table(table.name());
            script.tables[made as usize].unknown = unknown;
            made
        });
        let chosen = script.remark(CHOSEN);
        let states = std::array::from_fn(|at| {
            let declared = match at {
                0 | 1 => Expr::Value(initial[at]),
                2 | 9 | 10 => Expr::Value(off),
                3 => Expr::Value(on),
                _ => Expr::Unknown(chosen),
            };
            script.variable(Variable {
                shared: true,
                ..Variable::new(State::NAMES[at], Place::NOWHERE, declared)
            })
        });
        let external = script.remark(Remark::error(
            "held-work-piece",
            "the robot holds the work piece and the tool stands still (#TCP)",
            "moves with a fixed tool are not compensated",
        ));
        let external = script.value(Held::Remark(external));
        let angle = script.remark(ANGLE);
        let angle = script.value(Held::Remark(angle));
        let remarks = [
            KEEPS_ORIENTATION,
            KEEPS_SAME_ORIENTATION,
            IGNORES_ORIENTATION,
        ];
        let [keeps, keeps_same, ignored] = remarks.map(|remark| {
            let remark = script.remark(remark);
            script.value(Held::Remark(remark))
        });
        let mut variable =
            |name, value| script.variable(Variable::new(name, Place::NOWHERE, Expr::Value(value)));
        Self {
            angle: variable("the move", angle),
            ignoring: variable("$ORI_TYPE", off),
            keeping: ["$ORI_TYPE", "LDAT_ACT.ORI_TYP"].map(|name| variable(name, off)),
            sensor: variable("the sensor", off),
            apart: ["$ASYNC_AXIS", "$ACT_EX_AX"].map(|name| variable(name, on)),
            states,
            tables,
            entries: HashMap::new(),
            initial,
            known: HashMap::new(),
            numbers: HashMap::new(),
            on,
            off,
            external,
            keeps,
            keeps_same,
            ignored,
        }
    }

    /// What a state holds.
    pub(super) fn expr(&self, state: State) -> Expr {
        Expr::Variable(self.states[state as usize])
    }
}

/// `X Y Z A B C` in mm and degrees as a pose.
pub(super) fn pose_of([x, y, z, a, b, c]: [f64; 6]) -> Pose {
    pose_of_angles([x, y, z, c, b, a])
}

/// Writes a pose as X Y Z A B C, the angles as near to the present ones as they can be.
pub(super) fn write_pose(pose: &Pose, numbers: &mut [f64]) {
    // A, B, C: that about z first
    numbers[3..6].reverse();
    write_angles(pose, 0.0, numbers);
    numbers[3..6].reverse();
}

/// See [`crate::program::Language::frame_of`]: X Y Z A B C, and of a tool of the table its load.
pub(super) fn frame_of(name: &str, parts: &[Part]) -> Result<NamedFrame, Remark> {
    let mut numbers = [0.0; 10];
    let (mut missing, mut given) = (0, 0);
    for (at, part) in parts.iter().enumerate().take(10) {
        match part.value {
            PartValue::Number(value) => {
                numbers[at] = value;
                given += u32::from(at < 6);
            }
            PartValue::Missing => missing += u32::from(at < 6),
            _ => return Err(FRAME_ASSIGNED),
        }
    }
    if missing > 0 && given > 0 {
        return Err(Remark {
            text: "the running program changes a part of the tool or base, and the files do not \
                tell the rest"
                .into(),
            hint: "give the $config.dat that declares it, too",
            ..FRAME_ASSIGNED
        });
    }
    if let Some(angle) = numbers[3..6]
        .iter()
        .find(|angle| angle.abs() > MOST_ANGLE_DEG)
    {
        let hint = "A, B and C are in degrees: write them between -360 and 360";
        return Err(kit::angle_too_large(name, *angle, hint));
    }
    let [frame @ .., mass_kg, x, y, z] = numbers;
    let pose = (missing == 0).then(|| pose_of(frame));
    Ok(NamedFrame {
        load: (parts.len() == 10).then_some(Load {
            mass_kg,
            cog_m: [x, y, z],
        }),
        ..NamedFrame::still(name, pose)
    })
}

impl Reader {
    /// A tool or base that only the running program knows.
    pub(super) fn chosen(&mut self) -> Expr {
        self.unknown(CHOSEN)
    }

    pub(super) fn unknown(&mut self, remark: Remark) -> Expr {
        self.builder.script.unknown(remark)
    }

    /// An entry of a table.
    pub(super) fn entry(&mut self, table: Table, at: u32) -> VariableId {
        if let Some(&known) = self.states.entries.get(&(table, at)) {
            return known;
        }
        let name = format!("{}[{at}]", table.name());
        let declared = self.declared.entries.get(&(table, at)).copied();
        let declared = match declared.unwrap_or(Entry::Missing) {
            _ if table == Table::Load => match self.declared.loads.get(&at) {
                Some(Carrying::Ambiguous) => self.unknown(DECLARED_TWICE),
                _ => self.load_value(self.declared.load_of_tool(at)),
            },
            _ if table == Table::Base && self.declared.of_others.contains(&at) => {
                self.unknown(OF_ANOTHER_ROBOT)
            }
            Entry::Ambiguous => self.unknown(DECLARED_TWICE),
            Entry::Frame(parts) => Expr::Value(self.frame_value(table, &name, at, &parts)),
            Entry::Missing if table == Table::Base && self.declared.moving.contains_key(&at) => {
                self.unknown(MOVING)
            }
            Entry::Missing => {
                let value = match at {
                    0 => PartValue::Number(0.0),
                    _ => PartValue::Missing,
                };
                Expr::Value(self.frame_value(table, &name, at, &parts_of(value)))
            }
        };
        let script = &mut self.builder.script;
        let made = script.variable(Variable {
            kept: true,
            ..Variable::new(name, Place::NOWHERE, declared)
        });
        let entries = &mut script.tables[self.states.tables[table as usize] as usize].entries;
        entries.insert(i64::from(at), made);
        self.states.entries.insert((table, at), made);
        made
    }

    /// A frame, and behind it the load that belongs to a tool.
    fn frame_value(&mut self, table: Table, name: &str, at: u32, parts: &[Part; 6]) -> ValueId {
        let load = self.declared.load_of_tool(at);
        let load = load.filter(|load| load.mass_kg > 0.0);
        let mut parts = parts.to_vec();
        if let (Table::Tool, Some(load)) = (table, load) {
            let [x, y, z] = load.cog_m;
            let numbers = [load.mass_kg, x, y, z];
            parts.extend(numbers.map(|value| part_of(PartValue::Number(value))));
        }
        let machine = self
            .declared
            .moving
            .get(&at)
            .filter(|_| table == Table::Base);
        let on = machine.map_or_else(Box::default, |machine| unit(*machine));
        carried_record(&mut self.builder.script, name, &parts, on)
    }

    pub(super) fn load_value(&mut self, load: Option<Load>) -> Expr {
        Expr::Value(match load {
            // none by the files: the profile may know one of the tool
            Some(_) => {
                let load = load.filter(|load| load.mass_kg > 0.0);
                self.builder.script.value(Held::Load(load))
            }
            // the tool's own, if any
            None => self.states.off,
        })
    }

    /// An entry of loads that neither the files have nor a statement writes: that of the tool of its
    /// number, as far as is known.
    pub(super) fn load_of_nobody(&mut self, at: u32) -> Option<Expr> {
        let name = self.names.symbols.find(b"load_data");
        let is_written = name.is_some_and(|name| self.names.touched.contains(&name));
        if at == 0 || is_written || self.declared.loads.contains_key(&at) {
            return None;
        }
        let script = &mut self.builder.script;
        let otherwise = script.remark(not_in_files(at));
        let tool = format!("{}[{at}]", Table::Tool.name()).into();
        Some(Expr::Value(script.value(Held::LoadOf { tool, otherwise })))
    }

    /// A number that may choose an entry: that is one, then.
    pub(super) fn number_value(&mut self, number: u32) -> Expr {
        if let Some(&known) = self.states.numbers.get(&number) {
            return Expr::Value(known);
        }
        for table in [Table::Tool, Table::Base, Table::Load] {
            self.entry(table, number);
        }
        let made = self.builder.script.value(Held::Number(i64::from(number)));
        self.states.numbers.insert(number, made);
        Expr::Value(made)
    }

    /// A frame that has no value of the files' own.
    pub(super) fn known_frame(&mut self, name: &str, value: PartValue) -> Expr {
        let script = &mut self.builder.script;
        let known = self.states.known.get(name).copied();
        Expr::Value(known.unwrap_or_else(|| {
            let made = record(script, name, &parts_of(value));
            self.states.known.insert(name.into(), made);
            made
        }))
    }

    /// A frame of these numbers.
    pub(super) fn fixed_frame(&mut self, name: &str, pose: &Pose) -> Expr {
        let mut numbers = [0.0; 6];
        write_pose(pose, &mut numbers);
        let parts = numbers.map(|number| part_of(PartValue::Number(number)));
        Expr::Value(record(&mut self.builder.script, name, &parts))
    }

    /// A frame that no statement changes: one of the controller, an entry of a table or a variable.
    pub(super) fn constant_frame(&mut self, name: Symbol, at: Index) -> Option<Pose> {
        let mut buffer = [0; 24];
        let spelled = self.names.symbols.spelling(name).as_bytes();
        match capitals(spelled, &mut buffer) {
            b"$NULLFRAME" | b"$WORLD" => return Some(Pose::identity()),
            b"$ROBROOT" => return self.root,
            word => {
                if let Some(table) = Table::named(word) {
                    let written = [at, Index::Whole, Index::Variable];
                    let is_kept = |at| !self.names.elements.contains(&(name, at));
                    let entry = at.first().filter(|_| written.into_iter().all(is_kept))?;
                    return self.declared.still(table, entry);
                }
            }
        }
        let context = self.context();
        if !self.names.kind(name, context)?.is_pose() {
            return None;
        }
        match self.names.constant(name, at, context)? {
            Stored::Target(target) => {
                self.builder.script.offsets.push(target);
                self.pose_in(target)
            }
            _ => None,
        }
    }

    /// The pose that is written out in a target.
    pub(super) fn pose_in(&self, target: TargetId) -> Option<Pose> {
        let script = &self.builder.script;
        let is_pose = script.targets[target].layout.shape == Shape::Pose;
        let numbers = script.numbers_of(target).first_chunk::<6>()?;
        is_pose.then(|| pose_of(numbers.each_ref().map(|number| number.value)))
    }

    /// The number of a choice.
    pub(super) fn number_of(&mut self, choice: Option<Choice>) -> Expr {
        match choice {
            Some(Choice::Entry(number)) => self.number_value(number),
            Some(Choice::By(variable)) => Expr::Variable(variable),
            None => self.chosen(),
        }
    }

    pub(super) fn mode_value(&mut self, is_external: Option<bool>) -> Expr {
        match is_external {
            Some(false) => Expr::Value(self.states.on),
            Some(true) => Expr::Value(self.states.external),
            None => self.chosen(),
        }
    }

    /// How the tool rotates on straight moves and arcs.
    pub(super) fn orientation_value(&self, turning: Turning) -> Expr {
        Expr::Value(match turning {
            Turning::Kept => self.states.keeps,
            Turning::Ignored => self.states.ignored,
            Turning::Evenly => self.states.off,
            Turning::AsWrist => self.states.on,
        })
    }

    /// What is said of moves to the orientation that they start in, by what turns the tool.
    pub(super) fn kept_same(&self, turning: Expr) -> Expr {
        let [_, by_ldat] = self.states.keeping;
        match turning {
            Expr::Value(value) if value == self.states.keeps => Expr::Value(self.states.keeps_same),
            _ if turning == self.states.expr(State::LdatOrientation) => Expr::Variable(by_ldat),
            _ => Expr::Value(self.states.off),
        }
    }

    /// What the chosen entry of a table holds.
    pub(super) fn element(&mut self, table: Table, choice: Option<Choice>) -> Expr {
        match choice {
            Some(Choice::Entry(at)) => Expr::Variable(self.entry(table, at)),
            Some(Choice::By(number)) => Expr::Element {
                table: self.states.tables[table as usize],
                number,
            },
            None => self.chosen(),
        }
    }

    /// The variable of a parameter or of a whole number.
    pub(super) fn variable_of(&mut self, datum: u32) -> VariableId {
        self.variable(Owner::Datum(datum), Index::Whole)
    }
}
