//! Tools and bases of moves: from settings to values.

use super::findings::Cause;
use super::notes::{Action, DataKind, Entry, Index, Ipo, Stored, Table, Variable};
use super::state::{BASE, FDAT, IPO, Setting, Settings, Slot, TOOL, Value};
use super::tokens::Place;
use super::world::World;
use crate::geometry::units::{DEG, m_from_mm};
use crate::geometry::{Pose, Rotation};
use crate::program::{Frame, Load, Program, TargetId, Tool};
use std::collections::HashMap;

/// The slot of a variable in a state.
pub fn slot_of(variable: Variable) -> usize {
    match variable {
        Variable::Tool => TOOL,
        Variable::Base => BASE,
        Variable::Ipo => IPO,
        Variable::Fdat => FDAT,
    }
}

/// `X Y Z A B C` in mm and degrees as a pose.
pub fn pose_of([x, y, z, a, b, c]: [f64; 6]) -> Pose {
    Pose {
        rotation: Rotation::from_rzryrx([a * DEG, b * DEG, c * DEG]),
        translation: [x, y, z].map(m_from_mm),
    }
}

/// A tool or base that is found, or why the target has to stay: the place that says so and a name there.
pub type Used = Result<usize, (Cause, Place, String)>;

/// Stands for the move itself.
pub const HERE: Place = Place {
    file: u32::MAX,
    offset: 0,
};

/// What is known of one entry of a table.
#[derive(Clone, Copy, Debug)]
enum Known {
    Value([f64; 6]),
    Missing,
    RunTime(Place),
    Ambiguous(Place),
}

/// What is said of one entry by data lists and by statements.
#[derive(Debug, Default)]
struct Said {
    declared: Option<Known>,
    assigned: Option<(Known, Place)>,
}

/// `TOOL_DATA` or `BASE_DATA`.
#[derive(Debug, Default)]
struct Values {
    entries: HashMap<u32, Said>,
    /// An assignment to an entry that only the running program knows.
    any: Option<Place>,
    /// The only file with moves, where there is one: what it assigns replaces what is declared.
    alone: Option<u32>,
}

impl Values {
    fn add(&mut self, entry: &Entry) {
        let place = entry.place;
        let Some(index) = entry.index else {
            if entry.assigned {
                self.any = Some(place);
            }
            return;
        };
        let said = self.entries.entry(index).or_default();
        if entry.assigned {
            let known = match (entry.value, said.assigned) {
                (Some(value), None) => Known::Value(value),
                (Some(value), Some((Known::Value(other), _))) if is_same(&value, &other) => {
                    Known::Value(other)
                }
                _ => Known::RunTime(place),
            };
            said.assigned = Some((known, place));
        } else {
            said.declared = Some(match (entry.value, said.declared) {
                (Some(value), None | Some(Known::Missing)) => Known::Value(value),
                (Some(value), Some(Known::Value(other))) if is_same(&value, &other) => {
                    Known::Value(other)
                }
                (None, None | Some(Known::Missing)) => Known::Missing,
                _ => Known::Ambiguous(place),
            });
        }
    }

    fn get(&self, index: u32) -> Known {
        if let Some(place) = self.any {
            return Known::RunTime(place);
        }
        let Some(said) = self.entries.get(&index) else {
            return Known::Missing;
        };
        match (said.declared, said.assigned) {
            (declared, None) => declared.unwrap_or(Known::Missing),
            // programs that do not write the entry may run before it is written
            (Some(Known::Value(old)), Some((Known::Value(new), place)))
                if self.alone != Some(place.file) && !is_same(&old, &new) =>
            {
                Known::Ambiguous(place)
            }
            (_, Some((known, _))) => known,
        }
    }
}

/// Whether two frames are one, as far as the controller's numbers of 32 bits tell.
fn is_same(a: &[f64; 6], b: &[f64; 6]) -> bool {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-6 * a.abs().max(1.0);
    a.iter().zip(b).all(near)
}

/// The only file with moves, where there is one.
fn only_file_with_moves(world: &World) -> Option<u32> {
    let statements = world.notes.statements.iter();
    let mut moves = statements.filter(|statement| matches!(statement.action, Action::Move { .. }));
    let first = moves.next()?.place.file;
    moves
        .all(|other| other.place.file == first)
        .then_some(first)
}

/// Every tool and base that moves use.
pub struct Places<'a> {
    world: &'a World,
    settings: Settings,
    tables: [Values; 2],
    found: [HashMap<u32, Used>; 2],
    /// How many different values moves use of tool, base and mode: with one, calls outside the files cannot matter.
    many: [bool; 3],
    /// Targets that are frames, too.
    pub frames: Vec<(TargetId, Place)>,
}

impl<'a> Places<'a> {
    /// `used` are the states of all moves to poses.
    pub fn new(
        world: &'a World,
        settings: Settings,
        used: impl Iterator<Item = [Slot; 3]>,
    ) -> Self {
        let alone = only_file_with_moves(world);
        let mut tables = [(); 2].map(|()| Values {
            alone,
            ..Values::default()
        });
        for entry in &world.notes.entries {
            tables[usize::from(entry.table == Table::Base)].add(entry);
        }
        let mut first: [Option<Value>; 3] = [None; 3];
        let mut many = [false; 3];
        for slots in used {
            for (i, slot) in slots.into_iter().enumerate() {
                if matches!(slot.value, Value::Is(_)) {
                    many[i] |= *first[i].get_or_insert(slot.value) != slot.value;
                }
            }
        }
        Self {
            world,
            settings,
            tables,
            found: [HashMap::new(), HashMap::new()],
            many,
            frames: Vec::new(),
        }
    }

    /// The value of a slot.
    fn settled(&self, slot: Slot, at: usize) -> Result<u32, (Cause, Place, String)> {
        let chosen = |place, what: &str| Err((Cause::FrameChosen, place, what.to_owned()));
        match (slot.value, slot.doubt) {
            (Value::Is(_), Some(place)) if self.many[at] => {
                chosen(place, "the call of a routine that is not in the files")
            }
            (Value::Is(id), _) => Ok(id),
            (Value::Unknown(place), _) => chosen(place, "the statement"),
            // entries are resolved
            (Value::Entry, _) => unreachable!("a state of a move has no open entry"),
        }
    }

    /// Whether the robot holds the tool.
    pub fn mode(&self, slot: Slot) -> Result<(), (Cause, Place, String)> {
        let id = self.settled(slot, IPO)?;
        match self.settings.of(id) {
            Setting::Ipo(Ipo::Tcp) => Err((Cause::ExternalTcp, HERE, String::new())),
            _ => Ok(()),
        }
    }

    /// The tool of a slot.
    pub fn tool(&mut self, slot: Slot, program: &mut Program) -> Used {
        let id = self.settled(slot, TOOL)?;
        if let Some(used) = self.found[0].get(&id) {
            return used.clone();
        }
        let setting = self.settings.of(id);
        let used = self.frame_of(setting, Table::Tool).map(|(name, pose)| {
            let load = match setting {
                Setting::Entry(entry) => self.load(entry),
                _ => None,
            };
            program.tools.push(Tool {
                name,
                flange_from_tool: pose,
                load,
            });
            program.tools.len() - 1
        });
        self.found[0].insert(id, used.clone());
        used
    }

    /// The base of a slot.
    pub fn base(&mut self, slot: Slot, program: &mut Program) -> Used {
        let id = self.settled(slot, BASE)?;
        if let Some(used) = self.found[1].get(&id) {
            return used.clone();
        }
        let setting = self.settings.of(id);
        let used = self.frame_of(setting, Table::Base).map(|(name, pose)| {
            program.frames.push(Frame {
                name,
                world_from_frame: pose,
            });
            program.frames.len() - 1
        });
        self.found[1].insert(id, used.clone());
        used
    }

    fn load(&self, entry: u32) -> Option<Load> {
        let mut all = self.world.notes.loads.iter();
        let first = all.find(|load| load.index == entry)?;
        Some(Load {
            mass_kg: first.mass_kg,
            cog_m: first.cog_mm.map(m_from_mm),
        })
    }

    /// Name and value of a setting.
    fn frame_of(
        &mut self,
        setting: Setting,
        table: Table,
    ) -> Result<(String, Option<Pose>), (Cause, Place, String)> {
        let world = self.world;
        let (variable, array) = match table {
            Table::Tool => ("$TOOL", "TOOL_DATA"),
            Table::Base => ("$BASE", "BASE_DATA"),
        };
        match setting {
            Setting::Initial | Setting::Fdat(_) | Setting::Ipo(_) => {
                Ok((variable.to_owned(), None))
            }
            Setting::Zero => {
                let name = if table == Table::Tool {
                    "$NULLFRAME"
                } else {
                    "$WORLD"
                };
                Ok((name.to_owned(), Some(Pose::identity())))
            }
            Setting::Literal(bits) => {
                Ok((variable.to_owned(), Some(pose_of(bits.map(f64::from_bits)))))
            }
            Setting::Undeclared(name) => Ok((world.notes.symbols.spelling(name).to_owned(), None)),
            Setting::Entry(entry) => {
                let name = format!("{array}[{entry}]");
                if entry == 0 {
                    return Ok((name, Some(Pose::identity())));
                }
                if table == Table::Base && world.notes.moving_bases.contains(&entry) {
                    return Err((Cause::MovingFrame, HERE, name));
                }
                match self.tables[usize::from(table == Table::Base)].get(entry) {
                    Known::Value(value) => Ok((name, Some(pose_of(value)))),
                    Known::Missing => Ok((name, None)),
                    Known::RunTime(place) => Err((Cause::FrameAssigned, place, name)),
                    Known::Ambiguous(place) => Err((Cause::FrameAmbiguous, place, name)),
                }
            }
            Setting::Moving => Err((Cause::MovingFrame, HERE, String::new())),
            Setting::Declared(datum, index) => self.variable(datum, index),
        }
    }

    /// A tool or base that is a variable.
    fn variable(
        &mut self,
        datum: u32,
        index: Index,
    ) -> Result<(String, Option<Pose>), (Cause, Place, String)> {
        let world = self.world;
        let declared = world.declared(datum);
        let spelled = world.notes.symbols.spelling(declared.name).to_owned();
        if world.is_assigned(datum) {
            return Err((Cause::FrameAssigned, declared.place, spelled));
        }
        let chosen = Err((Cause::FrameChosen, declared.place, spelled.clone()));
        if !matches!(declared.kind, DataKind::Frame | DataKind::Position) {
            return chosen;
        }
        let Some(Stored::Target(target)) = world.one(datum, index) else {
            return chosen;
        };
        self.frames.push((target, declared.place));
        let range = world.notes.targets[target].numbers.clone();
        let numbers = &world.notes.numbers[range.start as usize..range.end as usize];
        if numbers.len() < 6 || world.notes.targets[target].blocked {
            return chosen;
        }
        let numbers = std::array::from_fn(|i| numbers[i].value);
        let name = world.notes.targets[target].name.as_deref();
        Ok((name.unwrap_or(&spelled).to_owned(), Some(pose_of(numbers))))
    }
}
