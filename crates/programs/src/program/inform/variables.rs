//! What a running program writes: position variables, tools and user frames, shifts; and constant
//! reasons against moves.

use super::cnd::Conditions;
use super::job::{Letter, Origin, Positions};
use super::remarks::Cause;
use crate::geometry::Pose;
use crate::program::script::{
    Builder, Expr, Held, NOT_DISPLACED, NamedFrame, Place, Remark, RoutineId, TableId, Variable,
    VariableId, short,
};
use crate::program::{BASE_UNIT, Load, TargetId};
use foldhash::{HashMap, HashMapExt};
use std::collections::BTreeMap;

/// Name of the tool of positions that tell none.
const NO_TOOL: &str = "none";
/// The variables of all jobs.
pub(super) struct Variables {
    /// Shifted or not.
    pub shift: VariableId,
    /// What a shift adds to the axes of the base and of a station.
    pub axes: VariableId,
    /// Corrected by the arc (COM-ARC) or not.
    pub seam: VariableId,
    /// `P[…]`
    pub positions: TableId,
    /// `UF#(…)`
    pub frames: TableId,
    /// `TL#(…)`
    pub tools: TableId,
    /// The tool and the work frame of positions below each header.
    pub of_headers: Vec<(Expr, Expr)>,
    /// `LP[…]` and the arguments, from 1, of each job.
    locals: HashMap<RoutineId, [TableId; 2]>,
    /// Reasons against moves that always hold.
    reasons: HashMap<Cause, VariableId>,
    sets: HashMap<Box<[VariableId]>, u32>,
}

/// An entry of a table; where there is none yet it is a variable of the controller, kept from run
/// to run, or a job's own.
fn entry(
    builder: &mut Builder,
    table: TableId,
    number: u32,
    routine: Option<RoutineId>,
    place: Place,
    declared: impl FnOnce(&mut Builder) -> Expr,
) -> VariableId {
    let key = i64::from(number);
    if let Some(known) = builder.script.tables[table as usize].entries.get(&key) {
        return *known;
    }
    let name = &builder.script.tables[table as usize].name;
    let name = match name.strip_suffix('#') {
        Some(_) => format!("{name}({number})"),
        None => format!("{name}{number:03}"),
    };
    let declared = declared(builder);
    let made = builder.script.variable(Variable {
        kept: routine.is_none(),
        routine,
        ..Variable::new(name, place, declared)
    });
    let entries = &mut builder.script.tables[table as usize].entries;
    entries.insert(key, made);
    made
}

impl Variables {
    /// Those that the headers and positions of all jobs name.
    pub(super) fn of(
        builder: &mut Builder,
        positions: &Positions,
        conditions: &Conditions,
    ) -> Self {
        let mut variables = Self {
            shift: constant(builder, Held::Shift(NOT_DISPLACED)),
            axes: (builder.script).variable(Variable::new("", Place::NOWHERE, Expr::Absent)),
            seam: (builder.script).variable(Variable::new("", Place::NOWHERE, Expr::Absent)),
            positions: builder.script.table("P"),
            frames: builder.script.table("UF#"),
            tools: builder.script.table("TL#"),
            of_headers: Vec::new(),
            locals: HashMap::new(),
            reasons: HashMap::new(),
            sets: HashMap::new(),
        };
        let mut holders: BTreeMap<u32, Vec<TargetId>> = BTreeMap::new();
        for (target, point) in positions.points.iter().enumerate() {
            if point.letter == Letter::P {
                holders.entry(point.number).or_default().push(target);
            }
        }
        for (number, targets) in holders {
            let first = &positions.targets[targets[0]];
            let place = Place::new(first.file, first.offset);
            entry(builder, variables.positions, number, None, place, |b| {
                match targets[..] {
                    [one] => Expr::Target(one),
                    // every job may be the one that was loaded last
                    _ => b.script.any(targets.iter().map(|t| Expr::Target(*t))),
                }
            });
        }
        variables.read_headers(builder, positions, conditions);
        variables
    }

    fn read_headers(
        &mut self,
        builder: &mut Builder,
        positions: &Positions,
        conditions: &Conditions,
    ) {
        let fixed = Some((Pose::identity(), None));
        let none = frame(builder, NO_TOOL.into(), None);
        let base = frame(builder, "BASE".into(), fixed);
        let robot = riding(builder, positions.world_from_robot);
        let mut unknown = |cause: Cause| builder.script.unknown(cause.remark());
        let (relative, not_named) = (
            unknown(Cause::ToolCoordinates),
            unknown(Cause::FrameNotNamed),
        );
        for header in &positions.headers {
            let tool = header.tool.map_or(none, |number| {
                let made = entry(
                    builder,
                    self.tools,
                    number,
                    None,
                    Place::NOWHERE,
                    |builder| {
                        let known = conditions.tools.get(&number).copied();
                        match known {
                            Some(None) => builder.script.unknown(Cause::FrameAmbiguous.remark()),
                            _ => frame(builder, number.to_string(), known.flatten()),
                        }
                    },
                );
                Expr::Variable(made)
            });
            let frame = match header.origin() {
                Origin::Base => base,
                Origin::Robot => robot,
                Origin::User(number) => {
                    let made = entry(
                        builder,
                        self.frames,
                        number,
                        None,
                        Place::NOWHERE,
                        |builder| {
                            let known = conditions.frames.get(&number).copied();
                            let pose = known.flatten().map(|pose| (pose, None));
                            match known {
                                Some(None) => {
                                    builder.script.unknown(Cause::FrameAmbiguous.remark())
                                }
                                _ => frame(builder, number.to_string(), pose),
                            }
                        },
                    );
                    Expr::Variable(made)
                }
                Origin::Tool => relative,
                Origin::Unknown => not_named,
            };
            self.of_headers.push((tool, frame));
        }
    }

    /// A P variable; one that the files do not hold is unknown until it is written.
    pub(super) fn position(
        &mut self,
        builder: &mut Builder,
        number: u32,
        place: Place,
    ) -> VariableId {
        entry(builder, self.positions, number, None, place, |builder| {
            builder.script.unknown(Cause::NotInFiles.remark())
        })
    }

    /// `LP[…]` and the arguments of a job.
    pub(super) fn locals(&mut self, builder: &mut Builder, routine: RoutineId) -> [TableId; 2] {
        let made = || [builder.script.table("LP"), builder.script.table("IARG#")];
        *self.locals.entry(routine).or_insert_with(made)
    }

    /// An LP variable of a job.
    pub(super) fn local(
        &mut self,
        builder: &mut Builder,
        routine: RoutineId,
        number: u32,
        place: Place,
    ) -> VariableId {
        let [table, _] = self.locals(builder, routine);
        entry(builder, table, number, Some(routine), place, computed)
    }

    /// What the callers of a job give as its argument of this number.
    pub(super) fn parameter(
        &mut self,
        builder: &mut Builder,
        routine: RoutineId,
        number: u32,
        place: Place,
    ) -> VariableId {
        let [_, table] = self.locals(builder, routine);
        entry(builder, table, number, Some(routine), place, computed)
    }

    /// A variable that always holds a reason against moves.
    pub(super) fn reason(&mut self, builder: &mut Builder, cause: Cause) -> VariableId {
        let made = || always(builder, cause.remark());
        *self.reasons.entry(cause).or_insert_with(made)
    }

    /// The index of reasons against a move.
    pub(super) fn guards(&mut self, builder: &mut Builder, set: &[VariableId]) -> u32 {
        if let Some(&known) = self.sets.get(set) {
            return known;
        }
        builder.script.guards.push(set.into());
        let made = short(builder.script.guards.len() - 1);
        self.sets.insert(set.into(), made);
        made
    }
}

/// What a variable of a job holds before it is written.
fn computed(builder: &mut Builder) -> Expr {
    builder.script.unknown(Cause::Computed.remark())
}

/// A variable that holds a reason against moves, and that nothing writes.
pub(super) fn always(builder: &mut Builder, remark: Remark) -> VariableId {
    let remark = builder.script.remark(remark);
    constant(builder, Held::Remark(remark))
}

/// A state of the controller.
fn constant(builder: &mut Builder, value: Held) -> VariableId {
    let declared = Expr::Value(builder.script.value(value));
    builder
        .script
        .variable(Variable::new("", Place::NOWHERE, declared))
}

/// The coordinates of the robot itself, which ride on the axes of its base, from where that stands
/// with all of them at zero.
fn riding(builder: &mut Builder, world_from_robot: Option<Pose>) -> Expr {
    let value = builder.script.value(Held::Frame(NamedFrame {
        on: [BASE_UNIT.into()].into(),
        ..NamedFrame::still("ROBOT", Some(world_from_robot.unwrap_or(Pose::identity())))
    }));
    Expr::Value(value)
}

/// A tool or work frame.
fn frame(builder: &mut Builder, name: String, known: Option<(Pose, Option<Load>)>) -> Expr {
    let value = builder.script.value(Held::Frame(NamedFrame {
        load: known.and_then(|(_, load)| load),
        ..NamedFrame::still(name, known.map(|(pose, _)| pose))
    }));
    Expr::Value(value)
}
