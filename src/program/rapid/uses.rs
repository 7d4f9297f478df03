//! Tools and work objects as moves name them.

use super::findings::Cause;
use super::findings::Report;
use super::frames::{Entity, Plans, Value, entity, load, pose, usable};
use super::names::Symbol;
use super::syntax::{Base, Expression, Index, Place, Statement, StatementKind, Type, indices};
use super::world::World;
use crate::finding::Severity;
use crate::geometry::Pose;
use crate::program::{Frame, FrameId, ReadError, Tool, ToolId};
use std::collections::HashMap;

/// A tool or frame that is found, or why the target has to stay.
pub(super) type Used<Id> = Result<Id, (Cause, Place, Symbol)>;

/// The symbol of a move without work object: no name has it.
const WOBJ0: Symbol = Symbol(u32::MAX);

/// A tool or work object, its element, and which of its values.
type Key = (Entity, Index, usize);

/// Tools and work objects that were used so far.
pub(super) struct Uses<'a> {
    world: &'a World,
    plans: Plans,
    tools: HashMap<Key, Used<ToolId>>,
    frames: HashMap<Key, Used<FrameId>>,
    /// The last ones: neighbours mostly use the same.
    last_tool: Option<(Key, Used<ToolId>)>,
    last_frame: Option<(Key, Used<FrameId>)>,
}

impl<'a> Uses<'a> {
    pub fn new(world: &'a World) -> Self {
        Self {
            world,
            plans: Plans::new(world, |asked| users(world, asked)),
            tools: HashMap::new(),
            frames: HashMap::new(),
            last_tool: None,
            last_frame: None,
        }
    }

    /// The tool that a move names.
    ///
    /// # Errors
    /// Where it has a number no robot can use.
    pub fn tool(
        &mut self,
        report: &mut Report,
        at: usize,
        statement: &Statement,
        tool: Option<(Symbol, Index)>,
    ) -> Result<Used<ToolId>, ReadError> {
        let Some((name, index)) = tool else {
            return Ok(Err((Cause::FrameChosen, statement.place, Symbol(0))));
        };
        let entity = match self.entity(statement, name, index) {
            Ok(entity) => entity,
            Err(cause) => return Ok(Err((cause, statement.place, name))),
        };
        let key = (entity, index, self.plans.version(entity, at));
        if let Some((last, used)) = self.last_tool
            && last == key
        {
            return Ok(used);
        }
        if let Some(used) = self.tools.get(&key) {
            self.last_tool = Some((key, *used));
            return Ok(*used);
        }
        let spelled = self.spelled(name, index);
        let is_tool0 = spelled.eq_ignore_ascii_case("tool0");
        let used = match self.plans.value(self.world, entity, at) {
            Value::Blocked(cause, place) => {
                self.say_assigned(report, name, place);
                Err((cause, place, name))
            }
            Value::Parts(parts) => match usable(Type::Tooldata, &parts) {
                Err(cause) => Err((cause, self.declared_at(entity, statement), name)),
                Ok(()) if index != Index::Whole => Ok((None, None)),
                Ok(()) => match pose(&parts, 1, report.sources)? {
                    Err(cause) => Err((cause, self.declared_at(entity, statement), name)),
                    Ok(None) if is_tool0 => Ok((Some(Pose::identity()), load(&parts))),
                    Ok(pose) => Ok((pose, load(&parts))),
                },
            },
        };
        let used = used.map(|(flange_from_tool, load)| {
            report.program.tools.push(Tool {
                name: spelled,
                flange_from_tool,
                load,
            });
            report.program.tools.len() - 1
        });
        self.tools.insert(key, used);
        Ok(used)
    }

    /// The work object that a move names.
    ///
    /// # Errors
    /// Where it has a number no robot can use.
    pub fn frame(
        &mut self,
        report: &mut Report,
        at: usize,
        statement: &Statement,
        frame: Option<(Symbol, Index)>,
    ) -> Result<Used<FrameId>, ReadError> {
        // without a work object it is wobj0, which no program can change
        let (name, index) = frame.unwrap_or((WOBJ0, Index::Whole));
        let entity = if name == WOBJ0 {
            Entity::Undeclared(WOBJ0)
        } else {
            match self.entity(statement, name, index) {
                Ok(entity) => entity,
                Err(cause) => return Ok(Err((cause, statement.place, name))),
            }
        };
        let key = (entity, index, self.plans.version(entity, at));
        if let Some((last, used)) = self.last_frame
            && last == key
        {
            return Ok(used);
        }
        if let Some(used) = self.frames.get(&key) {
            self.last_frame = Some((key, *used));
            return Ok(*used);
        }
        let spelled = if name == WOBJ0 {
            "wobj0".to_owned()
        } else {
            self.spelled(name, index)
        };
        let is_wobj0 = spelled.eq_ignore_ascii_case("wobj0");
        let used = match self.plans.value(self.world, entity, at) {
            Value::Blocked(cause, place) => {
                self.say_assigned(report, name, place);
                Err((cause, place, name))
            }
            Value::Parts(parts) => match usable(Type::Wobjdata, &parts) {
                Err(cause) => Err((cause, self.declared_at(entity, statement), name)),
                Ok(()) if index != Index::Whole => Ok(None),
                Ok(()) => {
                    let user = pose(&parts, 3, report.sources)?;
                    let object = pose(&parts, 10, report.sources)?;
                    match (user, object) {
                        (Err(cause), _) | (_, Err(cause)) => {
                            Err((cause, self.declared_at(entity, statement), name))
                        }
                        (Ok(Some(user)), Ok(Some(object))) => Ok(Some(user * object)),
                        _ if is_wobj0 => Ok(Some(Pose::identity())),
                        _ => Ok(None),
                    }
                }
            },
        };
        let used = used.map(|world_from_frame| {
            report.program.frames.push(Frame {
                name: spelled,
                world_from_frame,
            });
            report.program.frames.len() - 1
        });
        self.frames.insert(key, used);
        Ok(used)
    }

    /// The line that makes a tool or work object unknown.
    fn say_assigned(&self, report: &mut Report, name: Symbol, place: Place) {
        let (id, wrong, hint) = Cause::FrameAssigned.words();
        let message = format!("{}: {wrong}", self.world.notes.symbols.spelling(name));
        report.say(id, Severity::Error, place, message, hint);
    }

    fn entity(&self, statement: &Statement, name: Symbol, index: Index) -> Result<Entity, Cause> {
        let entity = entity(self.world, name, statement.context).ok_or(Cause::FrameAmbiguous)?;
        let parameter = match entity {
            Entity::Declared(datum) => self.world.datum(datum).parameter,
            Entity::Undeclared(_) => false,
        };
        if parameter || index == Index::Variable {
            return Err(Cause::FrameChosen);
        }
        Ok(entity)
    }

    fn declared_at(&self, entity: Entity, statement: &Statement) -> Place {
        match entity {
            Entity::Declared(datum) => self.world.datum(datum).place,
            Entity::Undeclared(_) => statement.place,
        }
    }

    fn spelled(&self, name: Symbol, index: Index) -> String {
        let name = self.world.notes.symbols.spelling(name);
        match index {
            Index::At([i, 0, _]) => format!("{name}{{{i}}}"),
            Index::At([i, j, 0]) => format!("{name}{{{i},{j}}}"),
            Index::At([i, j, k]) => format!("{name}{{{i},{j},{k}}}"),
            _ => name.to_owned(),
        }
    }
}

/// The statements whose moves use one of these tools or work objects.
fn users(world: &World, asked: &[Entity]) -> Vec<(Entity, usize)> {
    let mut found = Vec::new();
    for (at, statement) in world.notes.statements.iter().enumerate() {
        let StatementKind::Call { arguments, .. } = statement.kind else {
            continue;
        };
        for argument in &world.notes.arguments[indices(arguments)] {
            if let Expression::Point {
                base: Base::Named { name, .. },
                ..
            } = argument.expression
                && let Some(entity) = entity(world, name, statement.context)
                && asked.binary_search(&entity).is_ok()
            {
                found.push((entity, at));
            }
        }
    }
    found
}
