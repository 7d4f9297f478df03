//! Points, joints, tools: what a name in the code is, and what it holds.

use super::code::{Reference, plain_key};
use super::data::{Datum, Element, Father, Kind};
use super::project::{Declared, World};
use super::reader::Reader;
use super::remarks::{
    ALTERED, COMPUTED, FRAME_CHOSEN, filled, joints_not_taught, not_in_files, not_taught,
    other_arm, some_not_taught,
};
use crate::geometry::Pose;
use crate::program::contexts::{Varied, nothing};
use crate::program::displacing::Displacing;
use crate::program::script::{
    Builder, Expr, Held, Place, Remark, RoutineId, TableId, ValueId, Variable, VariableId, Written,
    short,
};
use crate::program::words::{Words, six};
use crate::program::{Layout, Number, Shape, Source, Target, TargetId};
use foldhash::{HashMap, HashSet};
use std::borrow::Cow;
use std::ops::Range;

/// What a name is: its values are the entries of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub kind: Kind,
    pub table: TableId,
    pub of: Of,
}

/// What a name belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Of {
    /// A program.
    Program(RoutineId),
    /// A project: index in [`World::data`].
    Project(u32),
}

/// What a value of a datum is in the script.
#[derive(Clone, Copy, Debug, Default)]
struct Value {
    target: Option<TargetId>,
    /// Once it is used.
    variable: Option<VariableId>,
}

/// How a program names a tool: alias, name, index.
type Asked<'a> = (&'a [u8], &'a [u8], Option<&'a [u8]>);

/// Variables of the script.
#[derive(Debug, Default)]
pub(super) struct Variables<'a> {
    /// The table of each datum.
    tables: Vec<TableId>,
    /// Each value of each datum.
    values: Vec<Vec<Value>>,
    /// What points of the data hang on: project and father; the world is one of all projects.
    pub fathers: Vec<(u32, Father<'a>)>,
    /// Of each target of the data the index of its father.
    pub father_of: Vec<u32>,
    locals: HashMap<(RoutineId, &'a [u8]), Known>,
    /// Of names that no datum has a value for, by table and key.
    others: HashMap<(TableId, Cow<'a, [u8]>), VariableId>,
    /// Tables that have all their values.
    filled: HashSet<TableId>,
    /// Any value of a table.
    any: HashMap<TableId, Expr>,
    /// The work frame that each father is, once it is asked for.
    pub frames: Vec<Option<Expr>>,
    /// Tools that the files do not have, by the name that is asked for and what has it.
    pub tools: HashMap<(String, String), Expr>,
    /// The same by project and the words of the program: alias, name, index.
    pub tools_by_words: HashMap<(u32, Asked<'a>), Expr>,
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

impl<'a> Variables<'a> {
    pub(super) fn of(builder: &mut Builder, world: &World<'a>) -> Self {
        let script = &mut builder.script;
        let remark = script.remark(ALTERED);
        let altered = script.held(Held::Remark(remark));
        let altered = script.variable(Variable::new("alter", Place::NOWHERE, altered));
        let mut variables = Self {
            honoured: script.value(Held::Flag(true)),
            altered: script.guard([altered]),
            ..Self::default()
        };
        let mut known = HashMap::default();
        for datum in &world.data {
            let table = builder.script.table(Source::text(datum.name));
            variables.tables.push(table);
            let values = (0..datum.elements.len()).map(|at| {
                let target = target_of(builder, datum, at);
                if target.is_some() {
                    let father = datum.elements[at].father;
                    let father = if father.is_world() {
                        (0, Father::default())
                    } else {
                        (datum.project, father)
                    };
                    let fathers = &mut variables.fathers;
                    let last = variables.father_of.last().copied();
                    let same = last.filter(|last| fathers[*last as usize] == father);
                    variables.father_of.push(same.unwrap_or_else(|| {
                        *known.entry(father).or_insert_with(|| {
                            fathers.push(father);
                            short(fathers.len() - 1)
                        })
                    }));
                }
                Value {
                    target,
                    variable: None,
                }
            });
            variables.values.push(values.collect());
        }
        variables.frames = vec![None; variables.fathers.len()];
        for (routine, program) in world.programs.iter().enumerate() {
            let routine = short(routine);
            for declared in &program.declared {
                let known = Known {
                    kind: declared.kind,
                    table: builder.script.table(Source::text(declared.name)),
                    of: Of::Program(routine),
                };
                variables.locals.insert((routine, declared.name), known);
            }
        }
        variables
    }
}

impl Variables<'_> {
    /// The table of a datum.
    pub(super) fn table_of(&self, datum: usize) -> TableId {
        self.tables[datum]
    }

    /// The targets of the data that the programs name.
    pub(super) fn named(&self) -> Vec<TargetId> {
        let named = self.values.iter().flatten();
        let named = named.filter(|value| value.variable.is_some());
        named.filter_map(|value| value.target).collect()
    }

    /// That of a name of a program's own.
    pub(super) fn table_of_local(&self, routine: RoutineId, name: &[u8]) -> TableId {
        self.locals[&(routine, name)].table
    }
}

/// The key of what stands for all values of an array of which none is taught.
const ANY: &[u8] = b"...";

/// The target that a value is; `None` where it is none, or was never taught.
fn target_of(builder: &mut Builder, datum: &Datum, at: usize) -> Option<TargetId> {
    let element = &datum.elements[at];
    if !datum.kind.is_place() || !element.is_given {
        return None;
    }
    let is_point = datum.kind == Kind::Point;
    let sides = element.sides.iter().filter(|_| is_point);
    let variant = (0..3).filter(|_| is_point).map(|side| {
        u8::from(element.sides[side].is_some()) << side | u8::from(element.free[side]) << (3 + side)
    });
    let layout = Layout {
        shape: if is_point { Shape::Pose } else { Shape::Joints },
        variant: variant.sum(),
    };
    let place = Place::new(datum.file, element.at);
    let target = Target {
        name: Some(datum.name_of(at).into()),
        ..Target::new(place, element.end, layout)
    };
    let numbers = element.numbers.iter().chain(sides.flatten());
    Some(builder.script.target(target, numbers.copied()))
}

impl<'a> Reader<'a> {
    /// What a name is where it is used; `None` where the files do not have it.
    pub(super) fn meaning(&self, name: &Reference) -> Option<Known> {
        self.meaning_in(name, self.here.routine)
    }

    /// Likewise in a program.
    pub(super) fn meaning_in(&self, name: &Reference, routine: RoutineId) -> Option<Known> {
        let local = self.variables.locals.get(&(routine, name.name));
        if let Some(known) = local.filter(|_| name.alias.is_empty()) {
            return Some(*known);
        }
        let project = self.world.programs[routine as usize].project;
        let datum = self.world.datum(project, name.alias, name.name)?;
        Some(Known {
            kind: self.world.data[datum as usize].kind,
            table: self.variables.tables[datum as usize],
            of: Of::Project(datum),
        })
    }

    pub(super) fn kind_of(&self, name: &Reference<'a>) -> Kind {
        match self.meaning(name) {
            Some(known) => known.kind,
            None if name.name == b"flange" => Kind::Tool,
            None => Kind::Other,
        }
    }

    /// The value of this kind that words name, where nothing changes it.
    pub(super) fn constant(&self, words: Words<'a, '_>, kind: Kind) -> Option<&Element<'a>> {
        self.constant_in(&Reference::whole(words)?, kind, self.here.routine)
    }

    /// Likewise in a program.
    pub(super) fn constant_in(
        &self,
        name: &Reference,
        kind: Kind,
        routine: RoutineId,
    ) -> Option<&Element<'a>> {
        let known = self.meaning_in(name, routine);
        let known = known.filter(|known| known.kind == kind)?;
        let Of::Project(datum) = known.of else {
            return None;
        };
        let of = &self.world.data[datum as usize];
        let at = of.element(name.key?)?;
        (!self.assigned.contains_key(&datum)).then(|| &of.elements[at])
    }

    /// A parameter of a program by its number.
    pub(super) fn parameter(&self, routine: RoutineId, number: usize) -> Option<Declared<'a>> {
        let declared = self.world.programs[routine as usize].declared.iter();
        declared.filter(|one| one.is_parameter).nth(number).copied()
    }

    /// The variable of a name of a program's own.
    pub(super) fn local(&mut self, routine: RoutineId, name: &'a [u8]) -> VariableId {
        self.local_element(routine, name, b"0")
    }

    /// The variable of an element of a program's own.
    pub(super) fn local_element(
        &mut self,
        routine: RoutineId,
        name: &'a [u8],
        key: &'a [u8],
    ) -> VariableId {
        let known = self.variables.locals[&(routine, name)];
        self.element(known, key)
    }

    /// The variable of a value.
    pub(super) fn element(&mut self, known: Known, key: &'a [u8]) -> VariableId {
        let value = match known.of {
            Of::Project(datum) => {
                let at = self.world.data[datum as usize].element(key);
                at.map(|at| (datum as usize, at))
            }
            Of::Program(_) => None,
        };
        let made = if let Some((datum, at)) = value {
            self.variables.values[datum][at].variable
        } else {
            let key = (known.table, plain_key(key));
            self.variables.others.get(&key).copied()
        };
        if let Some(made) = made {
            return made;
        }
        let variable = match known.of {
            Of::Project(datum) => self.declared(datum, value.map(|(_, at)| at), key),
            Of::Program(routine) => {
                let program = &self.world.programs[routine as usize];
                let place = Place::new(program.file, program.at);
                let script = &mut self.builder.script;
                let name = script.tables[known.table as usize].name.clone();
                let declared = script.unknown(unknown_value(known.kind));
                Variable {
                    routine: Some(routine),
                    ..Variable::new(name, place, declared)
                }
            }
        };
        let script = &mut self.builder.script;
        let made = script.variable(variable);
        script.enter(known.table, made);
        if let Some((datum, at)) = value {
            self.variables.values[datum][at].variable = Some(made);
        } else {
            let key = (known.table, plain_key(key));
            self.variables.others.insert(key, made);
        }
        made
    }

    /// A value of a project: where it stands among those of its name, if it does, and its key.
    fn declared(&mut self, datum: u32, at: Option<usize>, key: &[u8]) -> Variable {
        let of = &self.world.data[datum as usize];
        let target = at.and_then(|at| self.variables.values[datum as usize][at].target);
        let known = target.and_then(|target| self.builder.script.targets[target].name.clone());
        let name = known.unwrap_or_else(|| match at {
            Some(at) => of.name_of(at).into(),
            None => format!("{}[{}]", Source::text(of.name), Source::text(key)).into(),
        });
        let place = Place::new(of.file, of.at);
        let declared = match (of.kind, at) {
            (Kind::Tool, Some(at)) => self.tool_value(datum, at, &name),
            (Kind::Tool, None) => self.frame_value(&name, None),
            (Kind::OtherArm, _) => self.unknown(other_arm(&name)),
            _ => match target {
                Some(target) => Expr::Target(target),
                None if key == ANY => self.builder.script.unknown(unknown_value(of.kind)),
                None if of.kind == Kind::Joint => self.unknown(joints_not_taught(&name)),
                None if self.filled_anywhere.contains(&datum) => self.unknown(filled(&name)),
                None => self.unknown(not_taught(&name, self.assigned.contains_key(&datum))),
            },
        };
        // the controller keeps data as long as the project is loaded
        Variable {
            kept: true,
            ..Variable::new(name, place, declared)
        }
    }

    /// The table of a name with all its values in it.
    pub(super) fn all(&mut self, known: Known, name: &[u8]) -> TableId {
        if !self.variables.filled.insert(known.table) {
            return known.table;
        }
        let keys = match known.of {
            Of::Project(datum) => {
                let elements = self.world.data[datum as usize].elements.iter();
                let all: Vec<_> = elements.map(|element| element.key).collect();
                // none is taught: one stands for all that programs write
                if all.is_empty() { vec![ANY] } else { all }
            }
            Of::Program(_) => self.keys(known, name).unwrap_or_default(),
        };
        for key in keys {
            self.element(known, key);
        }
        known.table
    }

    /// What a name writes; why none where the files do not have it.
    pub(super) fn written_by(&mut self, name: &Reference<'a>) -> Result<Written, Remark> {
        match (self.meaning(name), name.key) {
            (Some(known), Some(key)) => Ok(Written::One(self.element(known, key))),
            (Some(known), None) => Ok(Written::AnyOf(self.all(known, name.name))),
            (None, _) => {
                let alias = Source::text(name.alias);
                let colon = if alias.is_empty() { "" } else { ":" };
                let name = format!("{alias}{colon}{}", Source::text(name.name));
                Err(not_in_files(&name))
            }
        }
    }

    /// The variables that a name may be, as far as they are known.
    pub(super) fn variables_of(&mut self, name: &Reference<'a>) -> Vec<VariableId> {
        match self.written_by(name) {
            Ok(Written::One(variable)) => vec![variable],
            Ok(Written::AnyOf(table)) => {
                let entries = &self.builder.script.tables[table as usize].entries;
                entries.values().copied().collect()
            }
            Err(_) => Vec::new(),
        }
    }

    pub(super) fn unknown(&mut self, remark: Remark) -> Expr {
        self.builder.script.unknown(remark)
    }

    /// What a name holds.
    pub(super) fn named(&mut self, name: &Reference<'a>) -> Expr {
        let meaning = self.meaning(name);
        let is_own = |known: &Known| matches!(known.of, Of::Program(_));
        if let Some(own) = meaning.filter(is_own)
            && name.key.is_none()
            && self.keys(own, name.name).is_none_or(|keys| keys.is_empty())
        {
            return self.unknown(unknown_value(own.kind));
        }
        let table = match self.written_by(name) {
            Ok(Written::One(variable)) => return Expr::Variable(variable),
            Ok(Written::AnyOf(table)) => table,
            Err(remark) => return self.unknown(remark),
        };
        if let Some(known) = self.variables.any.get(&table) {
            return *known;
        }
        let all = self.any_of(table, meaning);
        let any = self.builder.script.any(all.into_iter().map(Expr::Variable));
        self.variables.any.insert(table, any);
        any
    }

    /// The values of a table that a move may go to by an index that only the running program knows:
    /// spare points without numbers are left out where nothing writes them.
    fn any_of(&mut self, table: TableId, meaning: Option<Known>) -> Vec<VariableId> {
        let script = &self.builder.script;
        let entries = &script.tables[table as usize].entries;
        let all: Vec<VariableId> = entries.values().copied().collect();
        let datum = match meaning.filter(|known| known.kind.is_place()) {
            Some(Known {
                of: Of::Project(datum),
                ..
            }) if !self.assigned.contains_key(&datum) => datum,
            _ => return all,
        };
        let is_taught = |one: &VariableId| {
            let declared = script.variables[*one as usize].declared;
            matches!(declared, Expr::Target(_))
        };
        let (taught, spare): (Vec<_>, Vec<_>) = all.iter().partition(|one| is_taught(one));
        let Some(first) = spare.first().filter(|_| !taught.is_empty()) else {
            return all;
        };
        let of = &self.world.data[datum as usize];
        let first = &script.variables[*first as usize].name;
        let remark = some_not_taught(&Source::text(of.name), first);
        let place = Place::new(of.file, of.at);
        self.builder.script.say(self.sources, place, remark);
        taught
    }

    // ---- positions

    /// The variables that an expression is of.
    pub(super) fn roots(&self, of: Expr) -> Vec<VariableId> {
        let script = &self.builder.script;
        match of {
            Expr::Variable(variable) => vec![variable],
            Expr::Displaced { base, .. } | Expr::DisplacedByCall { base, .. } => {
                self.roots(script.lists[base as usize])
            }
            Expr::Any { first, end } => {
                let all = &script.lists[first as usize..end as usize];
                all.iter().flat_map(|one| self.roots(*one)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Where a move goes, or what is written.
    pub(super) fn position(&mut self, words: Words<'a, '_>) -> Expr {
        self.position_within(words, 0)
    }

    /// What `appro` starts from, several of them inside each other; each adds its steps.
    fn approached(
        &mut self,
        words: Words<'a, '_>,
        depth: u32,
        displacing: &mut Varied<Displacing>,
    ) -> Expr {
        let is_appro = words.text(0) == b"appro" && words.is(1, b'(') && depth < DEEPEST;
        let arguments = if is_appro { words.rest_list(1) } else { None };
        let Some([point, by]) = arguments.as_deref() else {
            return self.position_within(words, depth);
        };
        let base = self.approached(*point, depth + 1, displacing);
        displacing.with(self.varied_steps(*by), |displacing, by| {
            by.in_tool(displacing);
        });
        base
    }

    fn position_within(&mut self, words: Words<'a, '_>, depth: u32) -> Expr {
        let is_call = words.is_name(0) && words.is(1, b'(') && depth < DEEPEST;
        let arguments = if is_call { words.rest_list(1) } else { None };
        match (words.text(0), arguments.as_deref()) {
            (b"herej", Some(_)) => self.builder.script.held(Held::Actual),
            (b"here", Some([tool, ..])) => {
                let (tool, frame) = (self.tool(*tool), Expr::Absent);
                self.builder.script.held(Held::ActualWith { tool, frame })
            }
            (b"appro", Some([_, _])) => {
                let mut displacing = nothing();
                let base = self.approached(words, depth, &mut displacing);
                let (routine, script) = (self.here.routine, &mut self.builder.script);
                (self.by_calls).displaced(base, displacing, routine, script)
            }
            (b"compose", Some([point, frame, by])) => {
                let base = self.position_within(*point, depth + 1);
                let by = self.steps(*by);
                let by = self.compose(base, *frame, by);
                self.builder.script.displaced(base, by)
            }
            _ => match Reference::whole(words) {
                Some(name) => self.named(&name),
                None => self.unknown(COMPUTED),
            },
        }
    }

    /// Joints that are written out: `{0,-20,110,0,90,0}`.
    pub(super) fn joints(&mut self, words: Words<'a, '_>) -> Option<Expr> {
        let parts = words.rest_list(0).filter(|_| words.is(0, b'{'))?;
        let numbers = six(&parts)?;
        let Range { start, end } = words.span();
        let target = Target::new(self.place(start), short(end), Layout::of(Shape::Joints));
        Some(Expr::Target(self.builder.script.target(target, numbers)))
    }
}

/// Why nobody knows what a program's own name holds.
fn unknown_value(kind: Kind) -> Remark {
    match kind {
        Kind::Tool => FRAME_CHOSEN,
        _ => COMPUTED,
    }
}
