//! Tools and work objects: what they are where a move uses them.
//!
//! A value has parts ([`super::aggregate::TOOLDATA`], [`super::aggregate::WOBJDATA`]). Declared parts hold unless the program
//! assigns others. Where all assignments of a part agree, that value holds for every move. Where they differ, they hold one
//! after another if nothing but the text's order decides which: all assignments and moves are in one routine that runs from
//! top to bottom, and nothing it calls can come between.

use super::aggregate::{Leaf, MOST, UNIT_LIMIT};
use super::arguments::{LARGEST, is_unit};
use super::findings::Cause;
use super::names::{Context, Meaning, Symbol};
use super::syntax::{Component, Notes, Part, Place, StatementKind, Stored, Type, Verb, indices};
use super::tokens::Fault;
use super::world::World;
use crate::geometry::units::m_from_mm;
use crate::geometry::{Pose, Quaternion};
use crate::program::{Load, ReadError, Source};
use std::collections::HashMap;

/// A part and the file it stands in.
type Parts = [(Leaf, u32); MOST];

/// A tool or work object: a declaration, or a name that the files do not declare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Entity {
    Declared(u32),
    Undeclared(Symbol),
}

/// An assignment to a part.
#[derive(Clone, Copy, Debug)]
struct Assignment {
    statement: usize,
    first: usize,
    leaves: Option<Part>,
}

/// What holds for a tool or work object that the program assigns.
#[derive(Debug)]
enum Plan {
    /// The same for every move.
    Always(Box<Parts>),
    /// From each of these statements on.
    Versions(Vec<(usize, Box<Parts>)>),
    /// Only the running program knows; the assignment that says so.
    RunTime(Place),
}

/// Every assigned tool and work object.
#[derive(Debug, Default)]
pub struct Plans(HashMap<Entity, Plan>);

/// What a tool or work object is at a move.
pub enum Value {
    /// Its parts.
    Parts(Box<Parts>),
    /// The target has to stay.
    Blocked(Cause, Place),
}

/// The entity that a name stands for; `None` where it is ambiguous.
pub(super) fn entity(world: &World, name: Symbol, context: Context) -> Option<Entity> {
    match world.meaning(name, context) {
        Meaning::One(datum) => Some(Entity::Declared(datum)),
        Meaning::Nothing => Some(Entity::Undeclared(name)),
        Meaning::Several(_) => None,
    }
}

impl Plans {
    /// Works out what every assigned tool and work object is. `users` gives the statements whose moves use an entity, for
    /// those it is asked about.
    pub(super) fn new(world: &World, users: impl Fn(&[Entity]) -> Vec<(Entity, usize)>) -> Self {
        let assigned = assignments(world);
        let mut plans = HashMap::new();
        let mut conflicts = HashMap::new();
        for (entity, list) in assigned {
            let declared = declared(world, entity);
            match agreed(world, &declared, &list) {
                Ok(parts) => {
                    plans.insert(entity, Plan::Always(parts));
                }
                Err(Some(statement)) => {
                    let place = world.notes.statements[statement].place;
                    plans.insert(entity, Plan::RunTime(place));
                }
                Err(None) => {
                    conflicts.insert(entity, (declared, list));
                }
            }
        }
        if !conflicts.is_empty() {
            let mut asked: Vec<Entity> = conflicts.keys().copied().collect();
            asked.sort_unstable();
            let mut used: HashMap<Entity, Vec<usize>> = HashMap::new();
            for (entity, statement) in users(&asked) {
                used.entry(entity).or_default().push(statement);
            }
            for (entity, (declared, list)) in conflicts {
                let used = used.remove(&entity).unwrap_or_default();
                let plan = if in_order(world, entity, &list, &used) {
                    Plan::Versions(versions(world, &declared, &list))
                } else {
                    Plan::RunTime(world.notes.statements[list[0].statement].place)
                };
                plans.insert(entity, plan);
            }
        }
        Self(plans)
    }

    /// The value of an entity at a statement.
    pub(super) fn value(&self, world: &World, entity: Entity, statement: usize) -> Value {
        match self.0.get(&entity) {
            None => Value::Parts(Box::new(declared(world, entity))),
            Some(Plan::Always(parts)) => Value::Parts(parts.clone()),
            Some(Plan::RunTime(place)) => Value::Blocked(Cause::FrameAssigned, *place),
            Some(Plan::Versions(versions)) => {
                let at = versions.partition_point(|(from, _)| *from <= statement);
                let (_, parts) = &versions[at.saturating_sub(1)];
                Value::Parts(parts.clone())
            }
        }
    }

    /// Which value of an entity holds at a statement, to tell uses apart.
    pub fn version(&self, entity: Entity, statement: usize) -> usize {
        match self.0.get(&entity) {
            Some(Plan::Versions(versions)) => {
                versions.partition_point(|(from, _)| *from <= statement)
            }
            _ => 0,
        }
    }
}

/// Parts of a declaration; missing where there are none, computed where they are expressions.
fn declared(world: &World, entity: Entity) -> Parts {
    let mut parts = [(Leaf::Missing, 0); MOST];
    if let Entity::Declared(datum) = entity {
        let datum = world.datum(datum);
        match datum.value {
            Stored::Leaves(part) => set(&mut parts, 0, &world.notes, part, datum.place.file),
            Stored::Computed(_) => parts = [(Leaf::Computed, datum.place.file); MOST],
            _ => {}
        }
    }
    parts
}

fn set(parts: &mut Parts, first: usize, notes: &Notes, leaves: Part, file: u32) {
    let leaves = &notes.leaves[indices(leaves)];
    for (part, &leaf) in parts[first..].iter_mut().zip(leaves) {
        *part = (leaf, file);
    }
}

fn assignments(world: &World) -> Vec<(Entity, Vec<Assignment>)> {
    let mut assigned: HashMap<Entity, Vec<Assignment>> = HashMap::new();
    let mut note = |entity, assignment| {
        assigned.entry(entity).or_default().push(assignment);
    };
    for (at, statement) in world.notes.statements.iter().enumerate() {
        match statement.kind {
            StatementKind::Assign {
                name,
                component,
                leaves,
                ..
            } => {
                let Some(entity) = entity(world, name, statement.context) else {
                    continue;
                };
                let frame = match entity {
                    Entity::Declared(datum) => {
                        matches!(world.datum(datum).kind, Type::Tooldata | Type::Wobjdata)
                    }
                    Entity::Undeclared(_) => leaves.is_some(),
                };
                let first = match component {
                    Component::Leaves(first) => usize::from(first),
                    _ => 0,
                };
                if frame || matches!(component, Component::Leaves(_)) {
                    let assignment = Assignment {
                        statement: at,
                        first,
                        leaves,
                    };
                    note(entity, assignment);
                }
            }
            StatementKind::Call {
                verb: Verb::WritesTool,
                arguments,
                ..
            } => {
                for name in world.plain_names(arguments) {
                    if let Some(entity @ Entity::Declared(datum)) =
                        entity(world, name, statement.context)
                        && world.datum(datum).kind == Type::Tooldata
                    {
                        let assignment = Assignment {
                            statement: at,
                            first: 0,
                            leaves: None,
                        };
                        note(entity, assignment);
                    }
                }
            }
            StatementKind::Call { .. } => {}
        }
    }
    let mut all: Vec<_> = assigned.into_iter().collect();
    all.sort_unstable_by_key(|(entity, _)| *entity);
    all
}

/// The value where all assignments agree. The statement of one that is no number, or nothing where two differ.
fn agreed(
    world: &World,
    declared: &Parts,
    list: &[Assignment],
) -> Result<Box<Parts>, Option<usize>> {
    let mut parts = Box::new(*declared);
    let mut assigned = [false; MOST];
    let mut differ = false;
    for assignment in list {
        let part = assignment.leaves.ok_or(Some(assignment.statement))?;
        let file = world.notes.statements[assignment.statement].place.file;
        for (k, &leaf) in world.notes.leaves[indices(part)].iter().enumerate() {
            let k = assignment.first + k;
            if leaf == Leaf::Computed {
                return Err(Some(assignment.statement));
            }
            differ |= assigned[k] && !parts[k].0.agrees(leaf);
            assigned[k] = true;
            parts[k] = (leaf, file);
        }
    }
    if differ { Err(None) } else { Ok(parts) }
}

/// Whether only the order of the text decides which assignment holds at each use.
fn in_order(world: &World, entity: Entity, list: &[Assignment], used: &[usize]) -> bool {
    let statements = &world.notes.statements;
    let first = list[0].statement;
    let Some(routine) = statements[first].context.routine else {
        return false;
    };
    let inside = |at: usize| statements[at].context.routine == Some(routine) && at >= first;
    if !world.notes.routines[routine as usize].straight
        || !list.iter().all(|assignment| inside(assignment.statement))
        || !used.iter().all(|&at| inside(at))
    {
        return false;
    }
    let (reached, outside) = world.reached(world.calls(routine).iter().copied());
    let hidden = match entity {
        Entity::Declared(datum) => {
            let datum = world.datum(datum);
            datum.local || datum.context.routine.is_some()
        }
        Entity::Undeclared(_) => false,
    };
    !reached[routine as usize] && (!outside || hidden)
}

fn versions(world: &World, declared: &Parts, list: &[Assignment]) -> Vec<(usize, Box<Parts>)> {
    let mut parts = *declared;
    list.iter()
        .map(|assignment| {
            let file = world.notes.statements[assignment.statement].place.file;
            if let Some(part) = assignment.leaves {
                set(&mut parts, assignment.first, &world.notes, part, file);
            }
            (assignment.statement, Box::new(parts))
        })
        .collect()
}

/// Whether a tool hangs on the robot and a work object stands still.
pub fn usable(kind: Type, parts: &Parts) -> Result<(), Cause> {
    let is = |at: usize, truth: bool| parts[at].0 == Leaf::Bool(truth);
    if kind == Type::Tooldata {
        return if is(0, false) {
            Err(Cause::StationaryTool)
        } else {
            Ok(())
        };
    }
    if is(0, true) {
        return Err(Cause::HeldWorkPiece);
    }
    if is(1, false) || parts[2].0 == (Leaf::Text { empty: false }) {
        return Err(Cause::MovingFrame);
    }
    Ok(())
}

/// The pose whose seven parts start at `first`; `None` where one is missing.
///
/// # Errors
/// [`Cause::FrameAssigned`] inside where a part is an expression, outside where a number cannot be one.
pub fn pose(
    parts: &Parts,
    first: usize,
    sources: &[Source],
) -> Result<Result<Option<Pose>, Cause>, ReadError> {
    let parts = &parts[first..first + 7];
    if parts.iter().any(|(leaf, _)| *leaf == Leaf::Missing) {
        return Ok(Ok(None));
    }
    let mut values = [0.0; 7];
    for (value, (leaf, _)) in values.iter_mut().zip(parts) {
        let Some(number) = leaf.number() else {
            return Ok(Err(Cause::FrameAssigned));
        };
        *value = number;
    }
    let [x, y, z, quaternion @ ..] = values;
    let far = [x, y, z].iter().position(|v| v.abs() >= LARGEST);
    let wrong = match far {
        Some(at) => Some((at, "coordinate", "the limit is 1000000 mm either way")),
        None if !is_unit(quaternion) => Some((3, "unit quaternion", UNIT_LIMIT)),
        None => None,
    };
    if let Some((at, meaning, limit)) = wrong
        && let (Leaf::Number { start, length, .. }, file) = parts[at]
    {
        let fault = Fault::BadValue {
            start,
            end: start + u32::from(length),
            meaning,
            limit,
        };
        return Err(fault.in_source(&sources[file as usize]));
    }
    let translation = [x, y, z].map(m_from_mm);
    let rotation = Quaternion(quaternion).normalized();
    Ok(Ok(Some(Pose::from_parts(translation, rotation))))
}

/// The load of a tool, where it has a mass.
pub fn load(parts: &Parts) -> Option<Load> {
    let number = |at: usize| parts[at].0.number();
    let mass_kg = number(8).filter(|&mass| mass > 0.0 && mass < LARGEST)?;
    let cog_m = [number(9)?, number(10)?, number(11)?].map(m_from_mm);
    Some(Load { mass_kg, cog_m })
}
