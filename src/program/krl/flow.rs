//! Which tool, base and mode hold at each move, whatever way the program runs.
//!
//! Each routine is gone through in the order of the text, with the ways of branches and loops merged where they meet: what
//! differs there is unknown until it is set again. Calls to routines of the files take along what these set. A call to a
//! routine outside the files leaves a doubt, see [`super::places`].

use super::notes::{Action, Bas, Flow, Given, Index, Ipo, NO_WITH, Routine, Statement, Stored};
use super::state::{BASE, FDAT, IPO, Setting, Settings, Slot, State, States, TOOL, Value};
use super::tokens::Place;
use super::world::World;
use crate::program::rapid::names::{Context, Symbol};
use std::collections::HashMap;

/// Times that a routine is gone through before its loops are given up.
const MOST_PASSES: usize = 8;

/// What holds at the moves.
pub struct Flows {
    pub settings: Settings,
    /// Tool, base and mode at each statement that moves or calls.
    pub at: States,
}

/// Works out what holds at every move.
pub fn flows(world: &World) -> Flows {
    let mut analysis = Analysis {
        world,
        settings: Settings::default(),
        at: States::new(world.notes.statements.len()),
        exits: vec![None; world.notes.routines.len()],
        harmless: world.harmless(),
    };
    let order = world.callees_first();
    for &routine in &order {
        analysis.routine(routine);
    }
    analysis.enter(&order);
    Flows {
        settings: analysis.settings,
        at: analysis.at,
    }
}

struct Analysis<'a> {
    world: &'a World,
    settings: Settings,
    at: States,
    /// The state behind each routine, from its entry.
    exits: Vec<Option<State>>,
    harmless: Vec<Symbol>,
}

/// A branch or loop that is open.
enum Open {
    If {
        start: Option<State>,
        ends: Option<State>,
        other: bool,
    },
    Switch {
        start: Option<State>,
        ends: Option<State>,
        other: bool,
        any: bool,
    },
    Loop {
        head: usize,
        exits: Option<State>,
    },
}

/// States where ways meet again: loops by statement, labels by name.
#[derive(Default)]
struct Meetings {
    heads: HashMap<usize, State>,
    labels: HashMap<Symbol, State>,
    changed: bool,
}

impl Meetings {
    fn head(&mut self, at: usize, state: Option<State>, place: Place) -> Option<State> {
        let old = self.heads.get(&at).copied();
        let new = both(old, state, place)?;
        self.changed |= old != Some(new);
        self.heads.insert(at, new);
        Some(new)
    }

    fn label(&mut self, name: Symbol, state: Option<State>, place: Place) -> Option<State> {
        let old = self.labels.get(&name).copied();
        let new = both(old, state, place)?;
        self.changed |= old != Some(new);
        self.labels.insert(name, new);
        Some(new)
    }
}

fn both(a: Option<State>, b: Option<State>, at: Place) -> Option<State> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.merge(b, at)),
        (one, other) => one.or(other),
    }
}

impl Analysis<'_> {
    /// Goes through one routine from an open entry.
    fn routine(&mut self, routine: u32) {
        let mut meetings = Meetings::default();
        for pass in 0..=MOST_PASSES + 2 {
            meetings.changed = false;
            let exit = self.pass(routine, &mut meetings);
            self.exits[routine as usize] = Some(exit);
            if !meetings.changed {
                break;
            }
            if pass >= MOST_PASSES {
                let at = self.place_of(routine);
                for state in meetings
                    .heads
                    .values_mut()
                    .chain(meetings.labels.values_mut())
                {
                    *state = State::unknown(at);
                }
            }
        }
    }

    fn place_of(&self, routine: u32) -> Place {
        let Routine { statements, .. } = self.world.notes.routines[routine as usize];
        self.world.notes.statements[statements.0 as usize].place
    }

    fn pass(&mut self, routine: u32, meetings: &mut Meetings) -> State {
        let world = self.world;
        let range = world.notes.routines[routine as usize].statements;
        let mut open: Vec<Open> = Vec::new();
        let mut now = Some(State::entry());
        // what held last, for text that is never reached
        let mut last = State::entry();
        let mut spline = NO_WITH;
        let mut ends: Option<State> = None;
        for at in range.0 as usize..range.1 as usize {
            let statement = &world.notes.statements[at];
            let place = statement.place;
            last = now.unwrap_or(last);
            match statement.action {
                Action::Move { with, .. } => {
                    let mut state = last;
                    for with in [spline, with] {
                        if with != NO_WITH {
                            self.with(with, statement, &mut state);
                        }
                    }
                    self.at.set(at, state);
                }
                Action::Relative { .. } => self.at.set(at, last),
                Action::Call(_) => {
                    self.at.set(at, last);
                    now = now.map(|state| self.change(statement, state));
                }
                Action::Spline(with) => spline = with,
                Action::EndSpline => spline = NO_WITH,
                Action::Flow(flow) => {
                    if flow == Flow::Return {
                        ends = both(ends, now, place);
                        now = None;
                    } else {
                        now = step(flow, at, place, now, &mut open, meetings);
                    }
                }
                _ => now = now.map(|state| self.change(statement, state)),
            }
        }
        match both(ends, now, self.end_place(range)) {
            Some(exit) => exit,
            None => last,
        }
    }

    fn end_place(&self, range: (u32, u32)) -> Place {
        let last = (range.1 as usize).checked_sub(1);
        last.and_then(|at| self.world.notes.statements.get(at))
            .map_or(Place { file: 0, offset: 0 }, |statement| statement.place)
    }

    /// The state behind a statement that sets something or calls.
    fn change(&mut self, statement: &Statement, mut state: State) -> State {
        let place = statement.place;
        match statement.action {
            Action::Set(variable, given) => {
                let at = super::places::slot_of(variable);
                let given = self.world.notes.given[given as usize];
                state.0[at] = self.slot(given, at, statement);
            }
            Action::Bas(bas) => self.bas(bas, place, &mut state),
            Action::Call(name) => match self.world.routine(name, self.world.context(statement)) {
                Some(callee) => {
                    state = match self.exits[callee as usize] {
                        Some(exit) => exit.resolve(state),
                        // it calls itself
                        None => State::unknown(place),
                    };
                }
                None if self.harmless.contains(&name) => {}
                None => state = state.doubted(place),
            },
            _ => {}
        }
        state
    }

    fn bas(&mut self, bas: Bas, place: Place, state: &mut State) {
        let unknown = Slot::new(Value::Unknown(place));
        match bas {
            Bas::Init => {
                let initial = self.is(Setting::Initial);
                (state.0[TOOL], state.0[BASE]) = (initial, initial);
                state.0[IPO] = self.is(Setting::Ipo(Ipo::Base));
            }
            Bas::Tool(entry) => {
                state.0[TOOL] = entry.map_or(unknown, |entry| self.is(Setting::Entry(entry)));
            }
            Bas::Base(entry) => {
                state.0[BASE] = entry.map_or(unknown, |entry| self.is(Setting::Entry(entry)));
            }
            Bas::Frames => {
                let Slot { value, doubt } = state.0[FDAT];
                let fdat = match value {
                    Value::Is(id) => match self.settings.of(id) {
                        Setting::Fdat(fdat) => Some(fdat),
                        _ => None,
                    },
                    _ => None,
                };
                for at in [TOOL, BASE, IPO] {
                    let setting = fdat.and_then(|fdat| part_of(fdat, at));
                    let slot = setting.map_or(unknown, |setting| self.is(setting));
                    let value = match value {
                        Value::Unknown(_) => value,
                        _ => slot.value,
                    };
                    state.0[at] = Slot { value, doubt };
                }
            }
        }
    }

    fn is(&mut self, setting: Setting) -> Slot {
        Slot::new(Value::Is(self.settings.id(setting)))
    }

    fn with(&mut self, with: u32, statement: &Statement, state: &mut State) {
        let with = self.world.notes.withs[with as usize];
        for (at, given) in [(TOOL, with.tool), (BASE, with.base), (IPO, with.ipo)] {
            if let Some(given) = given {
                state.0[at] = self.slot(given, at, statement);
            }
        }
    }

    /// What a variable is after it was given a value.
    fn slot(&mut self, given: Given, at: usize, statement: &Statement) -> Slot {
        let world = self.world;
        let context = world.context(statement);
        let unknown = Slot::new(Value::Unknown(statement.place));
        let setting = match given {
            Given::Entry(entry) => Some(Setting::Entry(entry)),
            Given::Zero => Some(Setting::Zero),
            Given::Moving => Some(Setting::Moving),
            Given::Literal(numbers) => Some(Setting::Literal(numbers.map(f64::to_bits))),
            Given::Named(name, index) => Some(named(world, name, index, context)),
            Given::Fdat(fdat) => Some(Setting::Fdat(fdat)),
            Given::Ipo(mode) => Some(Setting::Ipo(mode)),
            Given::OfFdat(name, index) => {
                world.fdat(name, index, context).and_then(|fdat| match at {
                    FDAT => Some(Setting::Fdat(fdat)),
                    _ => part_of(fdat, at),
                })
            }
            Given::Computed => None,
        };
        let setting = setting.filter(|setting| !matches!(setting, Setting::Ipo(Ipo::Computed)));
        setting.map_or(unknown, |setting| self.is(setting))
    }

    /// Puts what callers have in the place of open entries.
    fn enter(&mut self, callees_first: &[u32]) {
        let world = self.world;
        let routines = &world.notes.routines;
        let initial = {
            let frame = self.is(Setting::Initial);
            let mode = self.is(Setting::Ipo(Ipo::Base));
            let mut state = State([frame; 4]);
            state.0[IPO] = mode;
            state
        };
        let mut entries: Vec<Option<State>> = vec![None; routines.len()];
        let calls = self.states_at_calls();
        let mut callers: Vec<Vec<(u32, State, Place)>> = vec![Vec::new(); routines.len()];
        for (caller, callee, state, place) in calls {
            callers[callee as usize].push((caller, state, place));
        }
        for &routine in callees_first.iter().rev() {
            let mut entry: Option<State> = None;
            for &(caller, state, place) in &callers[routine as usize] {
                let state = match entries[caller as usize] {
                    Some(from) => state.resolve(from),
                    None => State::unknown(place),
                };
                entry = both(entry, Some(state), place);
            }
            let entry = entry.unwrap_or(initial);
            entries[routine as usize] = Some(entry);
            let range = routines[routine as usize].statements;
            for at in range.0 as usize..range.1 as usize {
                if let Some(state) = self.at.get(at) {
                    self.at.set(at, state.resolve(entry));
                }
            }
        }
    }

    /// For each call to a routine of the files: caller, callee, and the state there from the caller's entry.
    fn states_at_calls(&self) -> Vec<(u32, u32, State, Place)> {
        let world = self.world;
        let statements = world.notes.statements.iter().zip(self.at.iter());
        let calls = statements.filter_map(|(statement, state)| match statement.action {
            Action::Call(name) => {
                let callee = world.routine(name, world.context(statement))?;
                Some((statement.routine, callee, state?, statement.place))
            }
            _ => None,
        });
        calls.collect()
    }
}

/// The state behind a branch, loop or jump.
fn step(
    flow: Flow,
    at: usize,
    place: Place,
    now: Option<State>,
    open: &mut Vec<Open>,
    meetings: &mut Meetings,
) -> Option<State> {
    match (flow, open.last_mut()) {
        (Flow::If, _) => {
            let (start, ends, other) = (now, None, false);
            open.push(Open::If { start, ends, other });
            now
        }
        (Flow::Else, Some(Open::If { start, ends, other })) => {
            *ends = both(*ends, now, place);
            *other = true;
            *start
        }
        (Flow::Switch, _) => {
            let (start, ends) = (now, None);
            let (other, any) = (false, false);
            open.push(Open::Switch {
                start,
                ends,
                other,
                any,
            });
            now
        }
        (
            Flow::Case | Flow::Default,
            Some(Open::Switch {
                start,
                ends,
                other,
                any,
            }),
        ) => {
            if *any {
                *ends = both(*ends, now, place);
            }
            *any = true;
            *other |= flow == Flow::Default;
            *start
        }
        (Flow::EndIf, Some(Open::If { start, ends, other }))
        | (
            Flow::EndSwitch,
            Some(Open::Switch {
                start, ends, other, ..
            }),
        ) => {
            let skipped = if *other { None } else { *start };
            let merged = both(both(*ends, now, place), skipped, place);
            open.pop();
            merged
        }
        (Flow::Repeat, _) => {
            open.push(Open::Loop {
                head: at,
                exits: None,
            });
            meetings.head(at, now, place)
        }
        (Flow::EndEndless | Flow::EndCounted | Flow::Until, Some(Open::Loop { head, exits })) => {
            let top = meetings.head(*head, now, place);
            let through = match flow {
                Flow::EndEndless => None,
                Flow::EndCounted => top,
                _ => now,
            };
            let merged = both(through, *exits, place);
            open.pop();
            merged
        }
        (Flow::Exit, _) => {
            let innermost = open.iter_mut().rev().find_map(|open| match open {
                Open::Loop { exits, .. } => Some(exits),
                _ => None,
            });
            match innermost {
                Some(exits) => {
                    *exits = both(*exits, now, place);
                    None
                }
                None => now,
            }
        }
        (Flow::Goto(label), _) => {
            meetings.label(label, now, place);
            None
        }
        (Flow::Label(label), _) => meetings.label(label, now, place),
        // what does not fit together
        _ => now,
    }
}

/// Tool, base or mode of an FDAT.
fn part_of(fdat: super::notes::Fdat, at: usize) -> Option<Setting> {
    match at {
        TOOL => fdat.tool.map(Setting::Entry),
        BASE => fdat.base.map(Setting::Entry),
        _ => Some(Setting::Ipo(fdat.ipo)).filter(|_| fdat.ipo != Ipo::Computed),
    }
}

fn named(world: &World, name: Symbol, index: Index, context: Context) -> Setting {
    match world.datum(name, context) {
        Some(Ok(datum)) => Setting::Declared(datum, index),
        _ => Setting::Undeclared(name),
    }
}

impl World {
    /// The FDAT of a name, where the files have it and no statement changes it.
    fn fdat(&self, name: Symbol, index: Index, context: Context) -> Option<super::notes::Fdat> {
        let datum = self.datum(name, context)?.ok()?;
        if self.is_assigned(datum) {
            return None;
        }
        match self.one(datum, index)? {
            Stored::Fdat(fdat) => Some(fdat),
            _ => None,
        }
    }
}
