//! From what may hold at each move to moves, and what is wrong with their targets.

mod frames;
mod given;
mod report;
mod targets;
mod whole;

use super::before::Stop;
use super::flow::{Flow, Modes, OF_MOVE};
use super::holding::{Atom, DECLARED, Holding, NOTHING, Site};
use crate::finding::Severity;
use crate::program::script::{
    DisplacementId, Expr, Held, Instruction, NOT_DISPLACED, Place, Remark, RemarkId, Script,
    ValueId, VariableId, Written, short,
};
use crate::program::{
    Called, Displacement, ExternalState, FrameId, Language, Program, ReadError, Settings, Shape,
    Source, Target, TargetId, ToolId,
};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
use given::Given;
use report::Report;
use std::rc::Rc;

/// Uses of elements of arrays that are listed; beyond, an element is listed once.
const MOST_USES: usize = 500_000;

/// The moves of a script.
///
/// # Errors
/// Where a tool or frame that is used has a number no robot can use.
pub(super) fn resolve(
    language: &dyn Language,
    sources: &[Source],
    settings: &Settings,
    mut script: Script,
) -> Result<Program, ReadError> {
    let mut program = Program {
        targets: std::mem::take(&mut script.targets),
        numbers: std::mem::take(&mut script.numbers),
        findings: std::mem::take(&mut script.findings),
        named: std::mem::take(&mut script.named),
        externals: std::mem::take(&mut script.externals),
        externals_of_moves: std::mem::take(&mut script.externals_of_moves),
        axes_stay: std::mem::take(&mut script.axes_stay),
        external_shifts: std::mem::take(&mut script.external_shifts),
        ..Program::default()
    };
    program.externals.sort_by_key(|(target, _)| *target);
    program.externals_of_moves.sort_by_key(|(at, _)| *at);
    program.axes_stay.sort_unstable();
    program.external_shifts.sort_by_key(|(at, _)| *at);
    let is_joints = |target: &Target| target.layout.shape == Shape::Joints;
    let flow = Flow::of(&script, program.targets.iter().map(is_joints).collect());
    let mut resolver = Resolver {
        language,
        sources,
        settings,
        script: &script,
        flow,
        report: Report::new(sources, &mut program),
        tools: HashMap::new(),
        frames: HashMap::new(),
        unknown_tool: None,
        unknown_frame: None,
        own_frames: HashMap::new(),
        given: Given::of(&script),
        used: Vec::new(),
        as_written: Vec::new(),
        changed: Vec::new(),
        as_frames: HashMap::new(),
        uncertain: Vec::new(),
        choices: Vec::new(),
        stops: Vec::new(),
        revisits: Vec::new(),
        full: false,
    };
    resolver.used = vec![false; resolver.report.program.targets.len()];
    resolver.as_written.clone_from(&resolver.used);
    resolver.find_own_frames()?;
    resolver.list()?;
    resolver.link();
    resolver.judge_uncertain();
    resolver.judge_targets();
    resolver.report.finish();
    drop(resolver);
    program.writes_into = writes_into(&script);
    program.instructions = script.instructions;
    if !program.led.is_empty() {
        let calls = script.calls.into_iter();
        let called = calls.map(|call| Called {
            place: call.place,
            name: call.name,
            is_foreign: call.foreign,
        });
        program.calls = called.collect();
        program.led.sort_unstable();
    }
    program.speed_zones = script.modals.iter().map(|modal| modal.speed_zone).collect();
    Ok(program)
}

/// See [`Program::writes_into`].
fn writes_into(script: &Script) -> Vec<(u32, u32)> {
    let mut pairs = Vec::new();
    let mut tables = HashSet::new();
    let mut note = |file: u32, variable: VariableId| {
        let of = &script.variables[variable as usize];
        let is_data = matches!(of.declared, Expr::Target(_) | Expr::Value(_)) && !of.shared;
        if is_data && file != of.place.file && of.place != Place::NOWHERE {
            pairs.push((file, of.place.file));
        }
    };
    for write in &script.writes {
        let file = write.place.file;
        match write.variable {
            Written::One(variable) => note(file, variable),
            Written::AnyOf(table) if tables.insert((file, table)) => {
                let entries = script.tables[table as usize].entries.values();
                entries.for_each(|entry| note(file, *entry));
            }
            Written::AnyOf(_) => {}
        }
    }
    for call in &script.calls {
        let given = call.arguments.start as usize..call.arguments.end as usize;
        let back = script.arguments[given].iter().filter_map(|of| of.back);
        back.for_each(|variable| note(call.place.file, variable));
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Why a tool or frame is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Refused {
    /// A remark of the reader.
    Said(RemarkId),
    /// Several, or unknown ones.
    Chosen,
    /// A value that is no tool or frame.
    NoFrame,
}

struct Resolver<'a, 'p> {
    language: &'a dyn Language,
    sources: &'a [Source],
    settings: &'a Settings,
    script: &'a Script,
    flow: Flow<'a>,
    report: Report<'a, 'p>,
    tools: HashMap<(Atom, Option<ValueId>), Result<ToolId, Refused>>,
    frames: HashMap<Atom, Result<FrameId, Refused>>,
    /// Those of moves whose own nobody knows: another matter than a refused one.
    unknown_tool: Option<ToolId>,
    unknown_frame: Option<FrameId>,
    /// Those that targets have of their own.
    own_frames: HashMap<TargetId, Result<FrameId, Refused>>,
    /// What routines are given.
    given: Given,
    /// Targets that moves go to.
    used: Vec<bool>,
    /// Those of them whose numbers in the file a move goes to.
    as_written: Vec<bool>,
    /// Targets that the running program changes before a move goes to them, and where.
    changed: Vec<(TargetId, Option<Place>)>,
    /// Targets that are tools or frames, and where.
    as_frames: HashMap<TargetId, Place>,
    /// Moves whose tool, frame or mode is uncertain: target, the call, and whether it is the tool
    /// alone.
    uncertain: Vec<(TargetId, Site, bool)>,
    /// What [`Flow::modes`] mean, as far as moves have asked.
    choices: Vec<Option<Rc<Choices>>>,
    /// Moves of each stop.
    stops: Vec<(u32, u32)>,
    /// Moves to where the robot itself was, and the statement that read it.
    revisits: Vec<(u32, Option<Site>)>,
    full: bool,
}

/// The tools, frames and modes that a move may have, with the writes that set them.
#[derive(Default)]
struct Choices {
    /// The unknown one where none is known.
    tools: Vec<(ToolId, Site)>,
    frames: Vec<(FrameId, Site)>,
    /// Why others are not known, and which of the two that is.
    refused: Vec<(Refused, Site, &'static str)>,
    configured: Vec<bool>,
    /// A flag of the controller leaves the orientation free on the path.
    free_orientation: bool,
    /// The call that leaves tool, frame or mode uncertain, and whether it is the tool alone.
    uncertainty: Option<(Site, bool)>,
}

impl Resolver<'_, '_> {
    /// Lists the moves of all stops in the order of the text.
    fn list(&mut self) -> Result<(), ReadError> {
        let mut order: Vec<Stop> = (0..short(self.flow.reached.len()))
            .filter(|stop| self.flow.reached[*stop as usize].is_some())
            .collect();
        let place = |stop: &Stop| {
            let instruction = self.flow.instructions[*stop as usize];
            let place = self.script.instructions[instruction as usize].place;
            (place.file, place.offset, instruction, *stop)
        };
        if !order.is_sorted_by_key(place) {
            order.sort_unstable_by_key(place);
        }
        self.stops = vec![(0, 0); self.flow.reached.len()];
        self.report.program.moves.reserve(order.len());
        for stop in order {
            let first = short(self.report.program.moves.len());
            self.stop(stop)?;
            let end = short(self.report.program.moves.len());
            self.stops[stop as usize] = (first, end);
        }
        Ok(())
    }

    fn stop(&mut self, stop: Stop) -> Result<(), ReadError> {
        let script = self.script;
        let at = self.flow.instructions[stop as usize];
        let instruction = &script.instructions[at as usize];
        let reached = self.flow.reached[stop as usize].expect("stops that are reached are listed");
        let guard = self.flow.modes[reached.modes as usize].guard;
        let (guards, external_state) = self.guards(guard, instruction);
        let shifts = self.shifts(guard);
        let mut listed = Listed {
            at,
            stop,
            instruction,
            choices: self.choices(reached.modes, instruction.place)?,
            guards,
            external_state,
            is_dead: reached.is_dead,
            near: Vec::new(),
            displaced: Vec::new(),
            is_one_of: false,
            is_shifted: false,
        };
        if let Some(held) = reached.target {
            let atoms = self.flow.holdings.of(held).iter();
            if atoms.filter(|(atom, _)| *atom != Atom::Uncertain).count() == 0 {
                // nothing that runs before writes it
                self.computed(instruction.place);
            }
        }
        let first = self.report.program.moves.len();
        for shift in shifts {
            listed.is_shifted = shift != NOT_DISPLACED;
            for by in self
                .flow
                .displaced_again(instruction.displacement, shift, OF_MOVE)
            {
                match reached.target {
                    None => self.fixed(instruction.target, by, &mut listed),
                    Some(held) => self.go_to_each(held, by, &mut listed),
                }
            }
        }
        self.go_elsewhere(first, &listed);
        Ok(())
    }

    /// What displaces all that moves go to: each that may be set.
    fn shifts(&self, guard: Holding) -> Vec<DisplacementId> {
        let mut shifts = Vec::new();
        for (atom, _) in self.flow.holdings.of(guard) {
            if let Atom::Value(value) = atom
                && let Held::Shift(by) = self.flow.value(*value)
                && !shifts.contains(by)
            {
                shifts.push(*by);
            }
        }
        if shifts.is_empty() {
            shifts.push(NOT_DISPLACED);
        }
        shifts
    }

    /// The tools, frames and modes that a move may have: mostly those of others, too; `first` is the
    /// first move that has them.
    fn choices(&mut self, modes: u32, first: Place) -> Result<Rc<Choices>, ReadError> {
        let at = modes as usize;
        if let Some(Some(choices)) = self.choices.get(at) {
            return Ok(Rc::clone(choices));
        }
        let modes = self.flow.modes[at];
        let mut choices = Choices {
            configured: self.flags(modes.configured),
            free_orientation: self.flags(modes.wrist).contains(&true),
            uncertainty: self.uncertainty(&modes),
            ..Choices::default()
        };
        let loads = self.loads(modes.load);
        for (atom, site) in self.atoms(modes.tool) {
            if atom == Atom::Uncertain {
                continue;
            }
            for &(load, set) in &loads {
                let set = self.flow.place_of(set).unwrap_or(first);
                match self.tool(atom, (load, set))? {
                    Ok(tool) => choices.tools.push((tool, site)),
                    Err(why) => choices.refused.push((why, site, "tool")),
                }
            }
        }
        for (atom, site) in self.atoms(modes.frame) {
            if atom == Atom::Uncertain {
                continue;
            }
            match self.frame(atom)? {
                Ok(frame) => choices.frames.push((frame, site)),
                Err(why) => choices.refused.push((why, site, "work frame")),
            }
        }
        if choices.tools.is_empty() {
            choices.tools.push((self.unknown_tool(), DECLARED));
        }
        if choices.frames.is_empty() {
            choices.frames.push((self.unknown_frame(), DECLARED));
        }
        let choices = Rc::new(choices);
        self.choices.resize(self.flow.modes.len(), None);
        self.choices[at] = Some(Rc::clone(&choices));
        Ok(choices)
    }

    /// What a holding may be; where nothing is known that is one thing, too.
    fn atoms(&self, holding: Holding) -> Vec<(Atom, Site)> {
        let atoms = self.flow.holdings.of(holding);
        if atoms.iter().all(|(atom, _)| *atom == Atom::Uncertain) {
            let mut all = vec![(Atom::Value(ValueId::MAX), DECLARED)];
            all.extend_from_slice(atoms);
            return all;
        }
        atoms.to_vec()
    }

    /// Where something is written, where that is elsewhere than in the move.
    fn written(&self, site: Site, instruction: &Instruction) -> Option<Place> {
        let place = self.flow.place_of(site);
        place.filter(|place| *place != instruction.place)
    }

    /// The call that leaves tool, frame or mode uncertain, and whether it is the tool alone.
    fn uncertainty(&self, modes: &Modes) -> Option<(Site, bool)> {
        let of = |holding: Holding| {
            let atoms = self.flow.holdings.of(holding).iter();
            atoms
                .filter(|(atom, _)| *atom == Atom::Uncertain)
                .map(|(_, site)| *site)
                .next()
        };
        let others = of(modes.frame).or(of(modes.guard));
        others
            .map(|site| (site, false))
            .or(of(modes.tool).map(|site| (site, true)))
    }

    /// What speaks against a move; what is only worth a word is said.
    /// With that, what is done to external axes: an index in [`Program::external_states`].
    fn guards(
        &mut self,
        guard: Holding,
        instruction: &Instruction,
    ) -> (Vec<(RemarkId, Site)>, u32) {
        let mut refused = Vec::new();
        let mut offset: Option<[f64; 6]> = None;
        let mut state = ExternalState::default();
        if guard == NOTHING {
            return (refused, 0);
        }
        for (atom, site) in self.atoms(guard) {
            let remark = match atom {
                Atom::Value(value) if value != ValueId::MAX => match self.flow.value(value) {
                    Held::Remark(remark) => *remark,
                    Held::ExternalOffset(by) => {
                        let by = **by;
                        if offset.replace(by).is_none_or(|before| before == by) {
                            continue;
                        }
                        self.report.remark(several_offsets())
                    }
                    Held::AxesOff(axes) => {
                        state.off |= axes;
                        let place = self.flow.place_of(site);
                        state.since = state.since.or(place.map(|p| (p.file, p.offset)));
                        continue;
                    }
                    _ => continue,
                },
                Atom::Unknown(remark) => remark,
                // more than are kept apart
                Atom::Anything => self.report.remark(several_modes()),
                _ => continue,
            };
            if self.report.remark_of(self.script, remark).severity == Severity::Error {
                refused.push((remark, site));
            } else {
                let place = self.flow.place_of(site).unwrap_or(instruction.place);
                self.report
                    .say_once(&self.script.remarks[remark as usize], place);
            }
        }
        state.offset = offset.unwrap_or_default();
        let states = &mut self.report.program.external_states;
        let index = if state == ExternalState::default() {
            0
        } else {
            let known = states.iter().position(|known| *known == state);
            short(known.unwrap_or_else(|| {
                states.push(state);
                states.len() - 1
            })) + 1
        };
        (refused, index)
    }

    /// The loads that a holding may be, and where each is set.
    fn loads(&self, holding: Holding) -> Vec<(Option<ValueId>, Site)> {
        let loads = self.flow.holdings.of(holding).iter();
        let mut loads: Vec<_> = loads
            .filter_map(|(atom, site)| match atom {
                Atom::Value(value) => Some((Some(*value), *site)),
                Atom::Uncertain => None,
                _ => Some((None, *site)),
            })
            .collect();
        if loads.is_empty() {
            loads.push((None, DECLARED));
        }
        loads.dedup_by_key(|(load, _)| *load);
        loads
    }

    fn flags(&self, holding: Holding) -> Vec<bool> {
        let mut flags = Vec::with_capacity(1);
        for (atom, _) in self.flow.holdings.of(holding) {
            let flag = match atom {
                Atom::Value(value) => match self.flow.value(*value) {
                    Held::Flag(flag) => Some(*flag),
                    _ => None,
                },
                Atom::Uncertain => continue,
                _ => None,
            };
            let both = [true, false];
            let either = flag.as_ref().map_or(&both[..], std::slice::from_ref);
            for flag in either {
                if !flags.contains(flag) {
                    flags.push(*flag);
                }
            }
        }
        if flags.is_empty() {
            flags.push(false);
        }
        flags
    }
}

/// Moves of one stop that are kept apart one by one as predecessors.
const MOST_ALTERNATIVES: u32 = 16;

/// What a move has, before its targets are listed.
struct Listed<'a> {
    at: u32,
    stop: Stop,
    instruction: &'a Instruction,
    choices: Rc<Choices>,
    guards: Vec<(RemarkId, Site)>,
    external_state: u32,
    is_dead: bool,
    /// Targets that the move goes near: once for all that only the running program knows.
    near: Vec<TargetId>,
    /// Those that writes displace: once for each that comes to the same.
    displaced: Vec<(TargetId, Displacement)>,
    /// It may go to targets of the files, and to something else.
    is_one_of: bool,
    /// Something displaces all that moves go to.
    is_shifted: bool,
}

/// More that speaks against moves may be set than is kept apart.
fn several_modes() -> Remark {
    Remark::error(
        "displacement-active",
        "more shifts and modes may be on at this move than are kept apart",
        "switch shifts off before they are set anew, or give fewer programs in one run",
    )
}

/// External axes are shifted by one of several offsets.
fn several_offsets() -> Remark {
    Remark::error(
        "external-offset-unknown",
        "only the running program knows by how much external axes are shifted here",
        "switch the shift off, or set it with numbers before the move in the same routine",
    )
}
