//! What a running program writes: position variables, tools and user frames, shifts; and constant reasons against moves.

use super::cnd::Conditions;
use super::job::{Header, Letter, Origin, Positions};
use super::remarks::Cause;
use crate::geometry::Pose;
use crate::program::script::{
    Builder, Expr, Held, NamedFrame, Place, RoutineId, Table, TableId, Variable, VariableId, short,
};
use crate::program::{Load, TargetId};
use std::collections::HashMap;

/// Name of the tool of positions that tell none.
const NO_TOOL: &str = "none";

/// The variables of all jobs.
pub struct Variables {
    /// Position variables that hold everywhere, by number.
    positions: HashMap<u32, VariableId>,
    /// Those of one job.
    locals: HashMap<(RoutineId, u32), VariableId>,
    /// What callers give, by the argument's number from 1.
    parameters: HashMap<(RoutineId, u32), VariableId>,
    tools: HashMap<Option<u32>, Expr>,
    frames: HashMap<Origin, Expr>,
    /// Reasons against moves that always hold.
    reasons: HashMap<Cause, VariableId>,
    sets: HashMap<Box<[VariableId]>, u32>,
    /// Shifted or not.
    pub shift: VariableId,
    /// `P[…]`
    pub all_positions: TableId,
    /// `UF#(…)`
    pub all_frames: TableId,
    /// `TL#(…)`
    pub all_tools: TableId,
    all_locals: HashMap<RoutineId, TableId>,
}

/// A variable of the controller, kept from run to run.
fn kept(name: String, place: Place, declared: Expr) -> Variable {
    Variable {
        name: name.into(),
        place,
        declared,
        kept: true,
        shared: false,
        routine: None,
    }
}

fn table(builder: &mut Builder, name: &str) -> TableId {
    builder.script.tables.push(Table {
        name: name.into(),
        ..Table::default()
    });
    short(builder.script.tables.len() - 1)
}

/// The beginning of everything.
const NOWHERE: Place = Place { file: 0, offset: 0 };

impl Variables {
    /// Those that the headers and positions of all jobs name.
    pub fn of(builder: &mut Builder, positions: &Positions, conditions: &Conditions) -> Self {
        let off = builder.script.value(Held::Flag(false));
        let shift = builder.script.variable(Variable {
            kept: false,
            ..kept("SFTON".to_owned(), NOWHERE, Expr::Value(off))
        });
        let mut variables = Self {
            positions: HashMap::new(),
            locals: HashMap::new(),
            parameters: HashMap::new(),
            tools: HashMap::new(),
            frames: HashMap::new(),
            reasons: HashMap::new(),
            sets: HashMap::new(),
            shift,
            all_positions: table(builder, "P"),
            all_frames: table(builder, "UF#"),
            all_tools: table(builder, "TL#"),
            all_locals: HashMap::new(),
        };
        let mut holders: HashMap<u32, Vec<TargetId>> = HashMap::new();
        for (target, point) in positions.points.iter().enumerate() {
            if point.letter == Letter::P {
                holders.entry(point.number).or_default().push(target);
            }
        }
        let mut numbers: Vec<u32> = holders.keys().copied().collect();
        numbers.sort_unstable();
        for number in numbers {
            let targets = &holders[&number];
            let declared = match targets[..] {
                [one] => Expr::Target(one),
                // every job may be the one that was loaded last
                _ => builder.script.any(targets.iter().map(|t| Expr::Target(*t))),
            };
            let first = &positions.targets[targets[0]];
            let place = Place {
                file: first.file,
                offset: first.offset,
            };
            variables.add_position(builder, number, place, declared);
        }
        for header in &positions.headers {
            variables.add_tool(builder, conditions, header.tool);
            variables.add_frame(builder, conditions, header.origin());
        }
        variables
    }

    fn add_position(
        &mut self,
        builder: &mut Builder,
        number: u32,
        place: Place,
        declared: Expr,
    ) -> VariableId {
        let variable = kept(format!("P{number:03}"), place, declared);
        let made = builder.script.variable(variable);
        self.positions.insert(number, made);
        let table = &mut builder.script.tables[self.all_positions as usize];
        table.entries.insert(i64::from(number), made);
        made
    }

    fn add_tool(&mut self, builder: &mut Builder, conditions: &Conditions, number: Option<u32>) {
        if self.tools.contains_key(&number) {
            return;
        }
        let known = number.and_then(|n| conditions.tools.get(&n).copied().flatten());
        let name = number.map_or_else(|| NO_TOOL.to_owned(), |n| n.to_string());
        let made = frame_value(builder, name, known);
        let made = match number {
            None => made,
            Some(number) => {
                let name = format!("TL#({number})");
                let variable = builder.script.variable(kept(name, NOWHERE, made));
                let table = &mut builder.script.tables[self.all_tools as usize];
                table.entries.insert(i64::from(number), variable);
                Expr::Variable(variable)
            }
        };
        self.tools.insert(number, made);
    }

    fn add_frame(&mut self, builder: &mut Builder, conditions: &Conditions, origin: Origin) {
        if self.frames.contains_key(&origin) {
            return;
        }
        let fixed = Some((Pose::identity(), None));
        let made = match origin {
            Origin::Base => frame_value(builder, "BASE".to_owned(), fixed),
            Origin::Robot => frame_value(builder, "ROBOT".to_owned(), fixed),
            Origin::User(number) => {
                let known = conditions.frames.get(&number).copied().flatten();
                let known = known.map(|pose| (pose, None));
                let value = frame_value(builder, number.to_string(), known);
                let name = format!("UF#({number})");
                let variable = builder.script.variable(kept(name, NOWHERE, value));
                let table = &mut builder.script.tables[self.all_frames as usize];
                table.entries.insert(i64::from(number), variable);
                Expr::Variable(variable)
            }
            Origin::Tool => Expr::Unknown(builder.script.remark(Cause::ToolCoordinates.remark())),
            Origin::Unknown => Expr::Unknown(builder.script.remark(Cause::FrameNotNamed.remark())),
        };
        self.frames.insert(origin, made);
    }

    /// The tool and the work frame of positions below a header.
    pub fn frames_of(&self, header: &Header) -> (Expr, Expr) {
        (self.tools[&header.tool], self.frames[&header.origin()])
    }

    /// A P variable that the files hold or write.
    pub fn known(&self, number: u32) -> Option<VariableId> {
        self.positions.get(&number).copied()
    }

    /// A P variable; one that the files do not hold is unknown until it is written.
    pub fn position(&mut self, builder: &mut Builder, number: u32, place: Place) -> VariableId {
        if let Some(&known) = self.positions.get(&number) {
            return known;
        }
        let unknown = builder.script.remark(Cause::NotInFiles.remark());
        self.add_position(builder, number, place, Expr::Unknown(unknown))
    }

    /// An LP variable of a job.
    pub fn local(
        &mut self,
        builder: &mut Builder,
        routine: RoutineId,
        number: u32,
        place: Place,
    ) -> VariableId {
        if let Some(&known) = self.locals.get(&(routine, number)) {
            return known;
        }
        let made = own(builder, routine, format!("LP{number:03}"), place);
        self.locals.insert((routine, number), made);
        let table = self.locals_of(builder, routine);
        let entries = &mut builder.script.tables[table as usize].entries;
        entries.insert(i64::from(number), made);
        made
    }

    /// `LP[…]` of a job.
    pub fn locals_of(&mut self, builder: &mut Builder, routine: RoutineId) -> TableId {
        let made = || table(builder, "LP");
        *self.all_locals.entry(routine).or_insert_with(made)
    }

    /// What the callers of a job give as its argument of this number.
    pub fn parameter(
        &mut self,
        builder: &mut Builder,
        routine: RoutineId,
        number: u32,
        place: Place,
    ) -> VariableId {
        *self
            .parameters
            .entry((routine, number))
            .or_insert_with(|| own(builder, routine, format!("IARG#({number})"), place))
    }

    /// A variable that always holds a reason against moves.
    pub fn reason(&mut self, builder: &mut Builder, cause: Cause) -> VariableId {
        *self
            .reasons
            .entry(cause)
            .or_insert_with(|| always(builder, cause.remark()))
    }

    /// The index of reasons against a move.
    pub fn guards(&mut self, builder: &mut Builder, set: &[VariableId]) -> u32 {
        if let Some(&known) = self.sets.get(set) {
            return known;
        }
        builder.script.guards.push(set.into());
        let made = short(builder.script.guards.len() - 1);
        self.sets.insert(set.into(), made);
        made
    }
}

/// A variable that nothing writes, with a reason against moves.
pub fn always(builder: &mut Builder, remark: crate::program::script::Remark) -> VariableId {
    let remark = builder.script.remark(remark);
    let value = builder.script.value(Held::Remark(remark));
    builder
        .script
        .variable(kept(String::new(), NOWHERE, Expr::Value(value)))
}

/// A variable of a job: what it holds before it is written nobody knows.
fn own(builder: &mut Builder, routine: RoutineId, name: String, place: Place) -> VariableId {
    let unknown = builder.script.remark(Cause::Computed.remark());
    builder.script.variable(Variable {
        kept: false,
        routine: Some(routine),
        ..kept(name, place, Expr::Unknown(unknown))
    })
}

fn frame_value(builder: &mut Builder, name: String, known: Option<(Pose, Option<Load>)>) -> Expr {
    let value = builder.script.value(Held::Frame(NamedFrame {
        name: name.into(),
        pose: known.map(|(pose, _)| pose),
        load: known.and_then(|(_, load)| load),
    }));
    Expr::Value(value)
}
