//! What holds at each move and which moves come before it, whichever way the program runs.
//!
//! Forward data flow to a fixed point over the statements of all routines. A routine is gone
//! through once for each call of it, up to a depth; beyond, and where routines call themselves, its
//! callers are joined. What variables hold is a [`Holding`], where the robot comes from a
//! [`Before`]; both only grow, so that it ends.
//!
//! # Source
//! G. A. Kildall, "A unified approach to global program optimization" (1973).

mod calls;
mod entries;
mod moved;
mod statements;
mod variables;
mod writes;

pub(super) use moved::OF_MOVE;

use super::before::{Before, Sets, Stop};
use super::holding::{Holding, Holdings, Site};
use crate::program::script::{
    DisplacementId, Expr, Factor, Held, Label, ModalId, Part, PartValue, RemarkId, RoutineId,
    Script, Start, Statement, TableId, ValueId, VariableId, short,
};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
use std::collections::{BTreeSet, BinaryHeap};
use std::rc::Rc;

/// Calls inside calls that are distinguished.
const DEEPEST: u32 = 6;
/// Statements of all instances of routines: so many times those of the script, and so many more.
const MOST_TIMES: usize = 3;
const MOST_MORE: usize = 20_000;
/// Times that what is kept from run to run, or written at any time, is gone through.
const MOST_ROUNDS: usize = 8;
/// Entries of a table that all its writes by unknown numbers may reach; beyond, they hold anywhere.
const MOST_WRITES: usize = 1_000_000;
/// Displaced positions of the robot that are distinguished.
const MOST_NEAR: usize = 1000;
/// Statements gone through, times those of the instances, after which the flow gives up.
const MOST_VISITS: usize = 200;

/// Factors of a product of frames, those of its factors counted, that are followed.
const MOST_FACTORS: usize = 8;

/// No caller, or several.
const NO_INSTANCE: u32 = u32::MAX;

/// What holds where a move begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    /// Index in [`Flow::modes`].
    pub modes: u32,
    /// `None` where the instruction's own expression says it whatever was before.
    pub target: Option<Holding>,
    pub before: Before,
    /// A call between the moves before and this one that may have led the robot elsewhere: index in
    /// [`Script::calls`].
    pub led: Option<u32>,
    /// A routine that runs between any two statements of the others came here.
    pub is_concurrent: bool,
    /// Nothing reaches it.
    pub is_dead: bool,
}

/// With what a move runs, whichever way the program came to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Modes {
    pub tool: Holding,
    pub frame: Holding,
    pub load: Holding,
    pub configured: Holding,
    pub wrist: Holding,
    /// What speaks against the move.
    pub guard: Holding,
}

/// A routine as one call of it runs.
#[derive(Debug)]
struct Instance {
    routine: RoutineId,
    depth: u32,
    /// Instance that calls it; [`NO_INSTANCE`] where several or none do.
    caller: u32,
    /// Its parameters that are by reference, and what each is in the end: no other one's parameter.
    same: Rc<[(VariableId, VariableId)]>,
    /// Stop of its first move.
    first_stop: Stop,
    entry: Option<State>,
    exit: Option<State>,
    /// Where it ends with an error.
    raised: Option<State>,
    /// It counts by what it writes alone ([`Call::writes_only`]): its moves are passed over.
    writes_only: bool,
    /// Calls that wait for its end: instance and statement.
    waiting: BTreeSet<(u32, u32)>,
}

#[derive(Clone, Debug, PartialEq)]
struct State {
    /// By slot of the variables that are tracked.
    holds: Rc<Vec<Holding>>,
    before: Before,
    /// A call since the move before that may have led the robot elsewhere: index in
    /// [`Script::calls`].
    led: Option<u32>,
    /// Nothing has started what runs concurrently.
    is_alone: bool,
}

/// Where to go on, the deepest routine first and there the first statement: [`BinaryHeap`] gives
/// the largest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Item {
    depth: u32,
    /// Counted down from the last one.
    statement: std::cmp::Reverse<u32>,
    instance: u32,
    from: From,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum From {
    Entry,
    Label(Label),
    Call,
    /// Text that nothing reaches.
    Dead,
}

/// The name of a record and what its parts are.
type Content = (Box<str>, Vec<(u8, u64)>);

/// What a part is, to compare.
fn bits(value: PartValue) -> (u8, u64) {
    match value {
        PartValue::Number(number) => (0, number.to_bits()),
        PartValue::Flag(flag) => (1, flag.into()),
        PartValue::Text { empty } => (2, empty.into()),
        PartValue::Missing => (3, 0),
        PartValue::Computed => (4, 0),
    }
}

/// The flow through a script.
pub(super) struct Flow<'a> {
    script: &'a Script,
    /// Which targets are joints.
    joints: Vec<bool>,
    displacements: moved::Displacements,
    pub holdings: Holdings,
    pub sets: Sets,
    /// Values that writes of parts made, behind those of the script.
    pub made: Vec<Held>,
    more_parts: Vec<Part>,
    made_parts: HashMap<(ValueId, u32, u32), Option<ValueId>>,
    /// Records that writes of parts made, by what is in them: what comes round again is the same.
    made_records: HashMap<Content, ValueId>,
    /// Products of frames, by what they are made of.
    products: HashMap<(Box<str>, Vec<Factor>, RemarkId), ValueId>,
    /// Positions of the robot itself: what holds the tool and the work frame of each.
    reads: Vec<(ValueId, [Holding; 2])>,
    /// Such a position as long as nothing has written the variables that held its tool and its work
    /// frame since it was read; these, and what it is then.
    fresh: Vec<(ValueId, [Expr; 2], ValueId)>,
    /// Which moves may come before a statement that reads such a position.
    pub stood: HashMap<Site, Before>,
    /// Those positions displaced, each by so much where that is distinguished, and by how much each of
    /// them is.
    near: HashMap<(ValueId, Option<DisplacementId>), ValueId>,
    near_by: HashMap<ValueId, Option<DisplacementId>>,
    /// The position of the robot itself that a move reads and goes to.
    here: Option<ValueId>,
    /// Slots of the variables of each routine's own.
    locals: HashMap<RoutineId, Vec<u32>>,
    /// The slot of each variable that is tracked.
    slots: Vec<Option<u32>>,
    /// What the others hold.
    fixed: Vec<Holding>,
    /// Variables in slots.
    tracked: Vec<VariableId>,
    /// Tables that are written at so many places by numbers that only the running program knows,
    /// that what is written holds anywhere.
    loose: HashSet<TableId>,
    /// What routines that run at any time may write, by variable.
    anytime: HashMap<VariableId, Holding>,
    label_places: Vec<u32>,
    /// Routines that change nothing that is tracked and move nothing: behind a call of one all is as
    /// before.
    idle: Vec<bool>,
    /// Slots of what routines that are not in the files may change.
    changing: Vec<u32>,
    instances: Vec<Instance>,
    by_call: HashMap<(u32, u32, RoutineId), u32>,
    /// Instances for several calls; those that count by what they write alone on their own.
    merged: HashMap<(RoutineId, bool), u32>,
    /// Slots of what such routines may write.
    slots_written: HashMap<RoutineId, Rc<[u32]>>,
    at_labels: HashMap<(u32, Label), (State, bool)>,
    at_calls: HashMap<(u32, u32), State>,
    work: BinaryHeap<Item>,
    visited: Vec<bool>,
    /// Statements of all instances.
    size: usize,
    /// By stop.
    pub reached: Vec<Option<Reached>>,
    /// With what moves run, each once.
    pub modes: Vec<Modes>,
    mode_ids: HashMap<Modes, u32>,
    /// Those of the last move, for a move with the same words where variables hold the same.
    last_modes: Option<(ModalId, Rc<Vec<Holding>>, u32)>,
    /// What variables hold where a move goes to one of several positions.
    chosen: HashMap<Stop, Rc<Vec<Holding>>>,
    /// Instruction of each stop.
    pub instructions: Vec<u32>,
    /// Calls of routines that are not in the files, and run between any two moves of others: index
    /// in [`Script::calls`], and the routine that calls them; none where what is not in the files is
    /// started so itself.
    pub at_any_time: BTreeSet<(u32, Option<RoutineId>)>,
    /// Targets that are given to routines that are not in the files, and the call's statement.
    pub given_away: Vec<(u32, Site)>,
    /// Where variables are written in routines that nothing in the files calls.
    pub by_operator: Vec<(VariableId, Site)>,
    /// Where the program writes variables that moves of such routines take as they are declared.
    pub left: Vec<(VariableId, Site)>,
    is_concurrent: bool,
    /// Whether routines run at any time, or concurrently with others.
    pub has_concurrent: bool,
    /// All of these are started by statements of the files.
    all_are_started: bool,
    /// With what routines are started concurrently with others.
    started: HashMap<RoutineId, State>,
    /// What the others write, by the routine that writes and by variable.
    concurrent: HashMap<(RoutineId, VariableId), Holding>,
    /// The routine whose statements are gone through.
    writer: RoutineId,
    /// Whether each routine starts others.
    starts_others: Vec<bool>,
    /// The routines that run together with one that is started.
    started_with: HashMap<RoutineId, Rc<HashSet<RoutineId>>>,
    /// The instance whose text is gone through that nothing reaches.
    dead: Option<u32>,
    /// Instances of routines that only text calls that nothing reaches.
    called_by_dead: HashSet<u32>,
}

impl<'a> Flow<'a> {
    /// Follows a script.
    pub(super) fn of(script: &'a Script, joints: Vec<bool>) -> Self {
        let mut label_places = vec![u32::MAX; script.labels as usize];
        for (at, statement) in script.statements.iter().enumerate() {
            if let Statement::Label(label) = statement {
                label_places[*label as usize] = short(at);
            }
        }
        let mut flow = Self {
            script,
            joints,
            displacements: moved::Displacements::new(),
            holdings: Holdings::new(),
            sets: Sets::new(),
            made: Vec::new(),
            more_parts: Vec::new(),
            made_parts: HashMap::new(),
            made_records: HashMap::new(),
            products: HashMap::new(),
            reads: Vec::new(),
            fresh: Vec::new(),
            stood: HashMap::new(),
            near: HashMap::new(),
            near_by: HashMap::new(),
            here: None,
            locals: HashMap::new(),
            slots: Vec::new(),
            fixed: Vec::new(),
            tracked: Vec::new(),
            loose: HashSet::new(),
            anytime: HashMap::new(),
            label_places,
            idle: Vec::new(),
            changing: Vec::new(),
            instances: Vec::new(),
            by_call: HashMap::new(),
            merged: HashMap::new(),
            slots_written: HashMap::new(),
            at_labels: HashMap::new(),
            at_calls: HashMap::new(),
            work: BinaryHeap::new(),
            visited: vec![false; script.statements.len()],
            size: 0,
            reached: Vec::new(),
            modes: Vec::new(),
            mode_ids: HashMap::new(),
            last_modes: None,
            chosen: HashMap::new(),
            instructions: Vec::new(),
            at_any_time: BTreeSet::new(),
            given_away: Vec::new(),
            by_operator: Vec::new(),
            left: Vec::new(),
            is_concurrent: false,
            has_concurrent: false,
            all_are_started: true,
            started: HashMap::new(),
            concurrent: HashMap::new(),
            writer: 0,
            starts_others: (script.routines.iter())
                .map(|of| {
                    let own = of.statements.start as usize..of.statements.end as usize;
                    let mut own = script.statements[own].iter();
                    own.any(|statement| matches!(statement, Statement::Start(_)))
                })
                .collect(),
            started_with: HashMap::new(),
            dead: None,
            called_by_dead: HashSet::new(),
        };
        let mut routines = script.routines.iter();
        flow.has_concurrent = routines.any(|routine| routine.start == Start::Concurrent);
        let by_others = flow.started_by_others();
        let all = script.routines.iter().zip(by_others);
        let mut concurrent = all.filter(|(routine, _)| routine.start == Start::Concurrent);
        flow.all_are_started = concurrent.all(|(_, is_started)| is_started);
        flow.track();
        flow.find_idle();
        flow.find_changing();
        for _ in 0..MOST_ROUNDS {
            let before = (
                flow.started.clone(),
                flow.concurrent.clone(),
                flow.anytime.clone(),
            );
            flow.forget();
            flow.run_concurrent();
            flow.run_entries();
            if !flow.has_concurrent
                || before
                    == (
                        flow.started.clone(),
                        flow.concurrent.clone(),
                        flow.anytime.clone(),
                    )
            {
                break;
            }
        }
        flow.run_dead();
        flow.given_away.sort_unstable();
        flow.given_away.dedup();
        flow
    }

    /// The value of an identifier, the flow's own included.
    pub(super) fn value(&self, value: ValueId) -> &Held {
        let at = value as usize;
        let own = self.script.values.len();
        if at < own {
            &self.script.values[at]
        } else {
            &self.made[at - own]
        }
    }

    /// Where a write stands, or the declaration of what a variable holds.
    pub(super) fn place_of(&self, site: Site) -> Option<crate::program::script::Place> {
        let script = self.script;
        Some(match script.statements.get(site as usize)? {
            Statement::Move(at) => script.instructions[*at as usize].place,
            Statement::Write(at) => script.writes[*at as usize].place,
            Statement::Call(at) | Statement::Start(at) => script.calls[*at as usize].place,
            _ => return None,
        })
    }
}
