//! Points, joints, tools and frames: what a name in the code is, and what it holds.

use super::data::{Datum, Father, Kind};
use super::line::{Index, Line, Reference};
use super::project::World;
use super::reader::Reader;
use super::remarks::{computed, frame_chosen, not_in_files, not_taught, other_arm};
use crate::geometry::Pose;
use crate::program::script::{
    Builder, Expr, Held, Place as At, Remark, RoutineId, Table, TableId, ValueId, Variable,
    VariableId, short,
};
use crate::program::{Displacement, Layout, Number, Shape, Shift, Source, Target, TargetId};
use foldhash::HashMap;

/// What a name is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Of the program itself.
    Local,
    /// Of a project: index in [`World::data`].
    Datum(u32),
    Missing,
}

/// What is written or read by a name.
#[derive(Clone, Debug)]
pub(super) enum Slot {
    One(VariableId),
    /// Only the running program knows which one.
    Any(TableId),
    Nothing(Remark),
}

/// A parameter of a program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parameter {
    pub variable: VariableId,
    pub by_reference: bool,
    pub is_array: bool,
}

/// A name of a program's own.
#[derive(Debug)]
struct Local {
    kind: Kind,
    routine: RoutineId,
    table: TableId,
}

/// Variables of the script.
#[derive(Debug, Default)]
pub(super) struct Variables<'a> {
    /// The target of each value of each datum.
    targets: Vec<Vec<Option<TargetId>>>,
    /// By datum and key.
    elements: HashMap<(u32, &'a [u8]), VariableId>,
    /// The value of a datum that a variable is declared with.
    pub declared: HashMap<VariableId, (u32, usize)>,
    tables: HashMap<u32, TableId>,
    any: HashMap<u32, (Expr, Vec<VariableId>)>,
    locals: HashMap<(RoutineId, &'a [u8]), Local>,
    local_elements: HashMap<(TableId, &'a [u8]), VariableId>,
    parameters: HashMap<(RoutineId, usize), Parameter>,
    /// Work frames by project and name, and what they are.
    pub frames: HashMap<(u32, Father<'a>), Expr>,
    /// Configuration data count.
    pub honoured: ValueId,
    /// Index in the script's guards: the path is altered.
    pub altered: u32,
}

/// The pose of `x y z rx ry rz`.
pub(super) fn pose_of(numbers: &[Number; 6]) -> Pose {
    super::pose_of(numbers.map(|number| number.value))
}

/// `appro` and `compose` in each other.
const DEEPEST: u32 = 32;

fn new_table(builder: &mut Builder, name: &[u8]) -> TableId {
    builder.script.tables.push(Table {
        name: Source::text(name).into(),
        ..Table::default()
    });
    short(builder.script.tables.len() - 1)
}

impl<'a> Variables<'a> {
    pub(super) fn of(builder: &mut Builder, world: &World<'a>) -> Self {
        let altered = builder.script.remark(super::remarks::altered());
        let altered = Expr::Value(builder.script.value(Held::Remark(altered)));
        let nowhere = At { file: 0, offset: 0 };
        let altered = builder
            .script
            .variable(Variable::new("alter", nowhere, altered));
        builder.script.guards.push([altered].into());
        let mut variables = Self {
            honoured: builder.script.value(Held::Flag(true)),
            altered: short(builder.script.guards.len() - 1),
            ..Self::default()
        };
        for datum in &world.data {
            let targets = datum.elements.iter().enumerate();
            let targets = targets.map(|(at, _)| target_of(builder, datum, at));
            variables.targets.push(targets.collect());
        }
        for (routine, program) in world.programs.iter().enumerate() {
            let mut number = 0;
            for declared in &program.declared {
                let table = new_table(builder, declared.name);
                let local = Local {
                    kind: declared.kind,
                    routine: short(routine),
                    table,
                };
                let place = At {
                    file: program.file,
                    offset: program.at,
                };
                if declared.is_parameter {
                    let variable = variables.local_element(builder, &local, b"0", place);
                    let parameter = Parameter {
                        variable,
                        by_reference: declared.by_reference,
                        is_array: declared.is_array,
                    };
                    variables
                        .parameters
                        .insert((local.routine, number), parameter);
                    number += 1;
                }
                variables
                    .locals
                    .insert((local.routine, declared.name), local);
            }
        }
        variables
    }

    /// What the callers of a program give as its argument of this number.
    pub(super) fn parameter(&self, routine: RoutineId, number: usize) -> Option<Parameter> {
        self.parameters.get(&(routine, number)).copied()
    }

    fn local_element(
        &mut self,
        builder: &mut Builder,
        local: &Local,
        key: &'a [u8],
        place: At,
    ) -> VariableId {
        if let Some(known) = self.local_elements.get(&(local.table, key)) {
            return *known;
        }
        let script = &mut builder.script;
        let declared = Expr::Unknown(script.remark(match local.kind {
            Kind::Tool => frame_chosen(),
            _ => computed(),
        }));
        let name = script.tables[local.table as usize].name.clone();
        let made = script.variable(Variable {
            routine: Some(local.routine),
            ..Variable::new(name, place, declared)
        });
        let entries = &mut script.tables[local.table as usize].entries;
        entries.insert(i64::try_from(entries.len()).expect("few"), made);
        self.local_elements.insert((local.table, key), made);
        made
    }
}

/// The target that a value is; `None` where it is none, or was never taught.
fn target_of(builder: &mut Builder, datum: &Datum, at: usize) -> Option<TargetId> {
    let element = &datum.elements[at];
    if !datum.kind.is_place() || !element.is_given {
        return None;
    }
    let mut numbers = element.numbers.to_vec();
    let mut variant = 0;
    let shape = match datum.kind {
        Kind::Joint => Shape::Joints,
        _ => Shape::Pose,
    };
    if shape == Shape::Pose {
        for (side, given) in element.sides.iter().enumerate() {
            numbers.extend(given);
            variant |=
                u8::from(given.is_some()) << side | u8::from(element.free[side]) << (3 + side);
        }
    }
    let target = Target {
        name: Some(datum.name_of(at).into()),
        file: datum.file,
        offset: element.at,
        end: element.end,
        layout: Layout { shape, variant },
        numbers: 0..0,
        blocked: false,
    };
    Some(builder.script.target(target, numbers))
}

impl<'a> Reader<'a> {
    /// What a name is where it is used.
    pub(super) fn meaning(&self, name: &Reference<'a>) -> Place {
        let own = name.alias.is_empty();
        let local = (self.here.routine, name.name);
        if own && self.variables.locals.contains_key(&local) {
            return Place::Local;
        }
        let project = if own {
            Some(self.here.project)
        } else {
            self.world.library(self.here.project, name.alias)
        };
        let datum = project.and_then(|project| {
            let data = &self.world.projects[project as usize].data;
            data.get(name.name)
        });
        datum.map_or(Place::Missing, |datum| Place::Datum(*datum))
    }

    pub(super) fn kind_of(&self, name: &Reference<'a>) -> Kind {
        match self.meaning(name) {
            Place::Local => self.variables.locals[&(self.here.routine, name.name)].kind,
            Place::Datum(datum) => self.world.data[datum as usize].kind,
            Place::Missing if name.name == b"flange" => Kind::Tool,
            Place::Missing => Kind::Other,
        }
    }

    /// What a name reads or writes.
    pub(super) fn slot(&mut self, name: &Reference<'a>) -> Slot {
        let key = match name.index {
            Index::None => Some(&b"0"[..]),
            Index::Key(key) => Some(key),
            Index::Any => None,
        };
        match self.meaning(name) {
            Place::Local => {
                let place = self.place(0);
                let local = &self.variables.locals[&(self.here.routine, name.name)];
                let local = Local { ..*local };
                match key {
                    Some(key) => {
                        let builder = &mut self.builder;
                        let made = self.variables.local_element(builder, &local, key, place);
                        Slot::One(made)
                    }
                    None => Slot::Any(local.table),
                }
            }
            Place::Datum(datum) => match key {
                Some(key) => Slot::One(self.element(datum, key)),
                None => Slot::Any(self.table(datum)),
            },
            Place::Missing => {
                let alias = Source::text(name.alias);
                let colon = if alias.is_empty() { "" } else { ":" };
                let name = format!("{alias}{colon}{}", Source::text(name.name));
                Slot::Nothing(not_in_files(&name))
            }
        }
    }

    /// The variables that a name may be, as far as they are known.
    pub(super) fn variables_of(&mut self, name: &Reference<'a>) -> Vec<VariableId> {
        match self.slot(name) {
            Slot::One(variable) => vec![variable],
            Slot::Any(table) => {
                let entries = &self.builder.script.tables[table as usize].entries;
                entries.values().copied().collect()
            }
            Slot::Nothing(_) => Vec::new(),
        }
    }

    /// The variable of a value of a project.
    fn element(&mut self, datum: u32, key: &'a [u8]) -> VariableId {
        if let Some(known) = self.variables.elements.get(&(datum, key)) {
            return *known;
        }
        let of = &self.world.data[datum as usize];
        let at = of.element(key);
        let name = match at {
            Some(at) => of.name_of(at),
            None => format!("{}[{}]", Source::text(of.name), Source::text(key)),
        };
        let place = At {
            file: of.file,
            offset: of.at,
        };
        let declared = match (of.kind, at) {
            (Kind::Tool, Some(at)) => self.tool_value(datum, at, &name),
            (Kind::Tool, None) => self.unknown_frame(&name),
            (Kind::OtherArm, _) => self.unknown(other_arm(&name)),
            (_, at) => match at.and_then(|at| self.variables.targets[datum as usize][at]) {
                Some(target) => Expr::Target(target),
                None => self.unknown(not_taught(&name)),
            },
        };
        // the controller keeps data as long as the project is loaded
        let made = self.builder.script.variable(Variable {
            kept: true,
            ..Variable::new(name, place, declared)
        });
        self.variables.elements.insert((datum, key), made);
        if let Some(at) = at {
            self.variables.declared.insert(made, (datum, at));
        }
        if let Some(table) = self.variables.tables.get(&datum) {
            let entries = &mut self.builder.script.tables[*table as usize].entries;
            entries.insert(i64::try_from(entries.len()).expect("few"), made);
        }
        made
    }

    fn table(&mut self, datum: u32) -> TableId {
        if let Some(known) = self.variables.tables.get(&datum) {
            return *known;
        }
        let name = self.world.data[datum as usize].name;
        let made = new_table(&mut self.builder, name);
        let keys: Vec<&[u8]> = self.world.data[datum as usize]
            .elements
            .iter()
            .map(|element| element.key)
            .collect();
        let known: Vec<VariableId> = keys.iter().map(|key| self.element(datum, key)).collect();
        let more = self.variables.elements.iter();
        let more = more.filter(|((of, key), _)| *of == datum && !keys.contains(key));
        let mut more: Vec<VariableId> = more.map(|(_, variable)| *variable).collect();
        more.sort_unstable();
        let entries = (0..).zip(known.into_iter().chain(more)).collect();
        self.builder.script.tables[made as usize].entries = entries;
        self.variables.tables.insert(datum, made);
        made
    }

    pub(super) fn unknown(&mut self, remark: Remark) -> Expr {
        Expr::Unknown(self.builder.script.remark(remark))
    }

    /// Any value of a name, and the variables that it may be.
    fn any(&mut self, name: &Reference<'a>) -> (Expr, Vec<VariableId>) {
        let Place::Datum(datum) = self.meaning(name) else {
            let remark = match self.kind_of(name) {
                Kind::Tool => frame_chosen(),
                _ => computed(),
            };
            return (self.unknown(remark), Vec::new());
        };
        if let Some(known) = self.variables.any.get(&datum) {
            return known.clone();
        }
        let table = self.table(datum);
        let script = &mut self.builder.script;
        let entries = script.tables[table as usize].entries.values();
        let all: Vec<VariableId> = entries.copied().collect();
        let made = script.any(all.iter().map(|variable| Expr::Variable(*variable)));
        self.variables.any.insert(datum, (made, all.clone()));
        (made, all)
    }

    /// What a name holds, and the variables that it may be.
    pub(super) fn named(&mut self, name: &Reference<'a>) -> (Expr, Vec<VariableId>) {
        match self.slot(name) {
            Slot::One(variable) => (Expr::Variable(variable), vec![variable]),
            Slot::Any(_) => self.any(name),
            Slot::Nothing(remark) => (self.unknown(remark), Vec::new()),
        }
    }

    // ---- positions

    /// Where a move goes, or what is written; and the variables that its points are of.
    pub(super) fn position(&mut self, text: &Line<'a, '_>) -> (Expr, Vec<VariableId>) {
        self.position_within(text, 0)
    }

    fn position_within(&mut self, text: &Line<'a, '_>, depth: u32) -> (Expr, Vec<VariableId>) {
        let is_call = text.is_name(0) && text.is(1, b'(');
        if is_call && depth < DEEPEST {
            let (arguments, close) = text.list(1);
            if close + 1 == text.tokens.len() {
                match (text.text(0), &arguments[..]) {
                    (b"here" | b"herej", _) => return (self.value(Held::Actual), Vec::new()),
                    (b"appro", [point, by]) => {
                        let (base, of) = self.position_within(point, depth + 1);
                        let by = self.transformation(by).map(|in_tool| Shift {
                            in_frame: Pose::identity(),
                            in_tool,
                        });
                        return (self.displaced(base, by), of);
                    }
                    (b"compose", [point, frame, by]) => {
                        let (base, of) = self.position_within(point, depth + 1);
                        let by = self.transformation(by);
                        let by = by.and_then(|by| self.composed(&of, frame, by));
                        return (self.displaced(base, by), of);
                    }
                    _ => {}
                }
            }
        }
        match text.reference(0) {
            Some(name) if name.words == text.tokens.len() && !name.has_field => self.named(&name),
            _ => (self.unknown(computed()), Vec::new()),
        }
    }

    /// Joints that are written out: `{0,-20,110,0,90,0}`.
    pub(super) fn joints(&mut self, text: &Line<'a, '_>) -> Option<Expr> {
        let (parts, close) = text.list(0);
        let is_whole = text.is(0, b'{') && close + 1 == text.tokens.len();
        let numbers: Option<Vec<Number>> = parts.iter().map(Line::number).collect();
        let numbers: [Number; 6] = numbers.filter(|_| is_whole)?.try_into().ok()?;
        let target = Target {
            name: None,
            file: self.here.file,
            offset: short(text.tokens[0].start),
            end: short(text.tokens[close].end),
            layout: Layout {
                shape: Shape::Joints,
                variant: 0,
            },
            numbers: 0..0,
            blocked: false,
        };
        Some(Expr::Target(self.builder.script.target(target, numbers)))
    }

    fn displaced(&mut self, base: Expr, by: Option<Shift>) -> Expr {
        let script = &mut self.builder.script;
        let by = by.map_or(Displacement::Unknown, |by| Displacement::By(Box::new(by)));
        let by = script.displacement(by);
        script.displaced(base, by)
    }

    /// A transformation with numbers: written out, or a `trsf` that nothing changes.
    fn transformation(&self, text: &Line<'a, '_>) -> Option<Pose> {
        if text.is(0, b'{') {
            let (parts, _) = text.list(0);
            let number = |part: &Line| part.number().map(|number| number.value);
            let numbers: Option<Vec<f64>> = parts.iter().map(number).collect();
            let numbers: [f64; 6] = numbers?.try_into().ok()?;
            return Some(super::pose_of(numbers));
        }
        let name = text.reference(0).filter(|name| !name.has_field)?;
        let Place::Datum(datum) = self.meaning(&name) else {
            return None;
        };
        let of = &self.world.data[datum as usize];
        let key = match name.index {
            Index::None => b"0",
            Index::Key(key) => key,
            Index::Any => return None,
        };
        let is_constant = of.kind == Kind::Trsf && !self.assigned.contains(&datum);
        let at = of.element(key).filter(|_| is_constant)?;
        Some(pose_of(&of.elements[at].numbers))
    }
}
