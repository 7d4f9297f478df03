//! From what may hold at each move to moves, and what is wrong with their targets.

use super::before::{ANYWHERE, START, Stop};
use super::flow::{Flow, Modes, Reached};
use super::holding::{Atom, DECLARED, Holding, NOTHING, Site};
use crate::finding::{Finding, Severity};
use crate::program::script::{
    DISPLACED_SOMEHOW, Expr, Held, Instruction, NOT_DISPLACED, NamedFrame, OVERWRITTEN, Place,
    Remark, RemarkId, Script, ValueId, short,
};
use crate::program::{
    Before, Displacement, ExternalState, Frame, FrameId, Language, Load, Move, Program, ReadError,
    Settings, Shape, Source, TargetId, Tool, ToolId, Value as Meaning,
};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
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
        externals: std::mem::take(&mut script.externals),
        externals_of_moves: std::mem::take(&mut script.externals_of_moves),
        ..Program::default()
    };
    program.externals.sort_by_key(|(target, _)| *target);
    program.externals_of_moves.sort_by_key(|(at, _)| *at);
    let flow = Flow::of(&script);
    let mut resolver = Resolver {
        language,
        sources,
        settings,
        script: &script,
        flow,
        report: Report::new(sources, &mut program),
        tools: HashMap::new(),
        frames: HashMap::new(),
        used: Vec::new(),
        as_written: Vec::new(),
        changed: Vec::new(),
        as_frames: HashMap::new(),
        uncertain: Vec::new(),
        choices: Vec::new(),
        stops: Vec::new(),
        full: false,
    };
    resolver.used = vec![false; resolver.report.program.targets.len()];
    resolver.as_written.clone_from(&resolver.used);
    resolver.list()?;
    resolver.link();
    resolver.judge_uncertain();
    resolver.judge_targets();
    resolver.report.finish();
    drop(resolver);
    program.instructions = script.instructions;
    program.speed_zones = script.modals.iter().map(|modal| modal.speed_zone).collect();
    Ok(program)
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
        let mut listed = Listed {
            at,
            stop,
            instruction,
            choices: self.choices(reached.modes)?,
            guards,
            external_state,
        };
        match reached.target {
            None => self.fixed(instruction.target, instruction.displacement, &mut listed),
            Some(held) => {
                let atoms = self.flow.holdings.of(held).iter();
                if atoms.filter(|(atom, _)| *atom != Atom::Uncertain).count() == 0 {
                    // nothing that runs before writes it
                    self.computed(instruction.place);
                }
                for (atom, site) in self.atoms(held) {
                    self.go_to(atom, Some(site), instruction.displacement, &mut listed);
                }
            }
        }
        Ok(())
    }

    /// The tools, frames and modes that a move may have: mostly those of others, too.
    fn choices(&mut self, modes: u32) -> Result<Rc<Choices>, ReadError> {
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
            for &load in &loads {
                match self.tool(atom, load)? {
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

    fn loads(&self, holding: Holding) -> Vec<Option<ValueId>> {
        let loads = self.flow.holdings.of(holding).iter();
        let mut loads: Vec<Option<ValueId>> = loads
            .filter_map(|(atom, _)| match atom {
                Atom::Value(value) => Some(Some(*value)),
                Atom::Uncertain => None,
                _ => Some(None),
            })
            .collect();
        if loads.is_empty() {
            loads.push(None);
        }
        loads.dedup();
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

    // ---- tools and frames

    /// The pose, name and load of what a move has as a tool or frame.
    fn named(
        &mut self,
        atom: Atom,
        is_tool: bool,
    ) -> Result<Result<NamedFrame, Refused>, ReadError> {
        let nameless = NamedFrame {
            on: Box::default(),
            name: Box::default(),
            pose: None,
            load: None,
        };
        Ok(match atom {
            Atom::Value(ValueId::MAX) => Ok(nameless),
            Atom::Value(value) => match self.flow.value(value).clone() {
                Held::Frame(frame) => Ok(frame),
                Held::Record { name, parts, on } => {
                    let parts = self.flow.parts_of(&parts);
                    let found = self
                        .language
                        .frame_of(is_tool, &name, &parts, self.sources)?;
                    match found {
                        Ok(mut frame) => {
                            frame.on = if on.is_empty() { frame.on } else { on };
                            Ok(frame)
                        }
                        Err(remark) => {
                            let known = self.report.remark(remark);
                            Err(Refused::Said(known))
                        }
                    }
                }
                Held::Number(number) => Ok(NamedFrame {
                    name: number.to_string().into(),
                    ..nameless
                }),
                Held::Remark(remark) => Err(Refused::Said(remark)),
                Held::Actual
                | Held::Load(_)
                | Held::Flag(_)
                | Held::ExternalOffset(_)
                | Held::AxesOff(_) => Err(Refused::NoFrame),
            },
            Atom::Target {
                target,
                displacement: NOT_DISPLACED,
            } => self.target_as_frame(target as usize),
            Atom::Target { .. } | Atom::Changed { .. } | Atom::Anything | Atom::Uncertain => {
                Err(Refused::Chosen)
            }
            Atom::Unknown(remark) => Err(Refused::Said(remark)),
        })
    }

    /// A position that stands for a tool or frame.
    fn target_as_frame(&mut self, target: TargetId) -> Result<NamedFrame, Refused> {
        let program = &*self.report.program;
        let found = &program.targets[target];
        let place = Place {
            file: found.file,
            offset: found.offset,
        };
        let name = found.name.clone().unwrap_or_default();
        let meaning = crate::program::meaning(self.language, program, self.settings, target);
        self.as_frames.entry(target).or_insert(place);
        match meaning.map(|decoded| decoded.value) {
            Some(Meaning::Pose(pose)) => Ok(NamedFrame {
                on: Box::default(),
                name,
                pose: Some(pose),
                load: None,
            }),
            _ => Err(Refused::NoFrame),
        }
    }

    fn tool(
        &mut self,
        atom: Atom,
        load: Option<ValueId>,
    ) -> Result<Result<ToolId, Refused>, ReadError> {
        if let Some(known) = self.tools.get(&(atom, load)) {
            return Ok(*known);
        }
        let named = self.named(atom, true)?;
        let own_load = match load.map(|load| self.flow.value(load)) {
            Some(Held::Load(load)) => Some(*load),
            _ => None,
        };
        let made = named.map(|frame| {
            let load: Option<Load> = own_load.unwrap_or(frame.load);
            let tools = &mut self.report.program.tools;
            tools.push(Tool {
                name: frame.name.into(),
                flange_from_tool: frame.pose,
                load,
            });
            tools.len() - 1
        });
        self.tools.insert((atom, load), made);
        Ok(made)
    }

    fn frame(&mut self, atom: Atom) -> Result<Result<FrameId, Refused>, ReadError> {
        if let Some(known) = self.frames.get(&atom) {
            return Ok(*known);
        }
        let named = self.named(atom, false)?;
        let made = named.map(|frame| {
            let frames = &mut self.report.program.frames;
            frames.push(Frame {
                name: frame.name.into(),
                world_from_frame: frame.pose,
                on: frame.on,
                stand: None,
            });
            frames.len() - 1
        });
        self.frames.insert(atom, made);
        Ok(made)
    }

    // ---- targets

    /// Lists the moves to an expression that says the same whatever was before, or to each of
    /// several.
    fn fixed(&mut self, value: Expr, displacement: u32, listed: &mut Listed) {
        let script = self.script;
        match value {
            Expr::Absent | Expr::Element { .. } => self.go_nowhere(listed),
            Expr::Variable(variable) => {
                let held = self.flow.chosen_at(listed.stop, variable);
                for (atom, site) in self.atoms(held) {
                    self.go_to(atom, Some(site), displacement, listed);
                }
            }
            Expr::Target(target) => self.go_target(target, displacement, listed),
            Expr::Value(value) => self.go_to(Atom::Value(value), None, displacement, listed),
            Expr::Unknown(remark) => self.go_to(Atom::Unknown(remark), None, displacement, listed),
            Expr::Displaced { base, by } => {
                let by = both(displacement, by);
                self.fixed(script.lists[base as usize], by, listed);
            }
            Expr::Any { first, end } => {
                let many = self.report.program.moves.len() + (end - first) as usize > MOST_USES;
                for inner in &script.lists[first as usize..end as usize] {
                    let own = match *inner {
                        Expr::Variable(variable) => script.variables[variable as usize].declared,
                        other => other,
                    };
                    if many && matches!(own, Expr::Target(target) if self.used[target]) {
                        self.too_many(listed.instruction.place);
                        continue;
                    }
                    self.fixed(*inner, displacement, listed);
                }
                if first == end {
                    self.go_nowhere(listed);
                }
            }
        }
    }

    fn too_many(&mut self, place: Place) {
        if std::mem::replace(&mut self.full, true) {
            return;
        }
        let message = format!(
            "from here on moves to elements of arrays are not checked: there are more than \
             {MOST_USES}"
        );
        let hint = "give fewer files in one call";
        let severity = Severity::Error;
        self.report
            .say("too-many-uses", severity, place, message, hint);
    }

    fn go_to(&mut self, atom: Atom, site: Option<Site>, displacement: u32, listed: &mut Listed) {
        let script = self.script;
        match atom {
            Atom::Target {
                target,
                displacement: of,
            } => self.go_target(target as usize, both(displacement, of), listed),
            Atom::Changed { target } => {
                let because = site.and_then(|site| self.flow.place_of(site));
                self.used[target as usize] = true;
                self.changed.push((target as usize, because));
                self.go_nowhere(listed);
            }
            Atom::Value(ValueId::MAX) | Atom::Uncertain => self.go_nowhere(listed),
            Atom::Value(value) => {
                match self.flow.value(value) {
                    Held::Actual if displacement == NOT_DISPLACED => self.report.say(
                        "run-time-position",
                        Severity::Note,
                        listed.instruction.place,
                        "this move goes to where the robot itself was; that is right as it is"
                            .into(),
                        "",
                    ),
                    Held::Remark(remark) => {
                        let remark = &script.remarks[*remark as usize];
                        self.report.say_once(remark, listed.instruction.place);
                    }
                    _ => self.computed(listed.instruction.place),
                }
                self.go_nowhere(listed);
            }
            Atom::Unknown(remark) => {
                let remark = &script.remarks[remark as usize];
                self.report.say_once(remark, listed.instruction.place);
                self.go_nowhere(listed);
            }
            Atom::Anything => {
                self.computed(listed.instruction.place);
                self.go_nowhere(listed);
            }
        }
    }

    fn computed(&mut self, place: Place) {
        let message = "the position that this move goes to is known at run time only; the move \
            stays as it is";
        let hint = "write the position with numbers where it must be exact";
        let severity = Severity::Warning;
        self.report
            .say("computed-target", severity, place, message.into(), hint);
    }

    /// A move to somewhere: nothing is rewritten, and what follows does not know where it comes
    /// from.
    fn go_nowhere(&mut self, listed: &Listed) {
        let (tool, _) = listed.choices.tools[0];
        let (frame, _) = listed.choices.frames[0];
        self.push(
            None,
            (tool, None),
            (frame, None),
            false,
            Displacement::None,
            listed,
        );
    }

    fn go_target(&mut self, target: TargetId, displacement: u32, listed: &Listed) {
        self.used[target] = true;
        self.as_written[target] = true;
        for &(remark, site) in &listed.guards {
            let because = self.flow.place_of(site);
            let remark = self.report.remark_of(self.script, remark).clone();
            let because = because.or(Some(listed.instruction.place));
            self.report
                .block(target, remark.id, &remark.text, remark.hint, because);
        }
        if let Some((site, tool_alone)) = listed.choices.uncertainty {
            self.uncertain.push((target, site, tool_alone));
        }
        let is_joints = self.report.program.targets[target].layout.shape == Shape::Joints;
        let displacement = match self.script.displacements.get(displacement as usize) {
            Some(displacement) => displacement.clone(),
            None => Displacement::Unknown,
        };
        let choices = &*listed.choices;
        if !is_joints {
            for &(why, site, what) in &choices.refused {
                self.refuse(target, why, site, what, listed.instruction);
            }
        }
        for &(tool, tool_site) in &choices.tools {
            for &(frame, frame_site) in &choices.frames {
                let tool = (tool, self.written(tool_site, listed.instruction));
                let frame = (frame, self.written(frame_site, listed.instruction));
                for &configured in &choices.configured {
                    self.push(
                        Some(target),
                        tool,
                        frame,
                        configured,
                        displacement.clone(),
                        listed,
                    );
                }
            }
        }
    }

    /// The tool of a joint target whose tool nobody knows.
    fn unknown_tool(&mut self) -> ToolId {
        let key = (Atom::Anything, None);
        if let Some(Ok(known)) = self.tools.get(&key) {
            return *known;
        }
        let tools = &mut self.report.program.tools;
        tools.push(Tool {
            name: String::new(),
            flange_from_tool: None,
            load: None,
        });
        let made = tools.len() - 1;
        self.tools.insert(key, Ok(made));
        made
    }

    fn unknown_frame(&mut self) -> FrameId {
        let key = Atom::Anything;
        if let Some(Ok(known)) = self.frames.get(&key) {
            return *known;
        }
        let frames = &mut self.report.program.frames;
        frames.push(Frame {
            name: String::new(),
            world_from_frame: None,
            on: Box::default(),
            stand: None,
        });
        let made = frames.len() - 1;
        self.frames.insert(key, Ok(made));
        made
    }

    fn refuse(
        &mut self,
        target: TargetId,
        why: Refused,
        written: Site,
        what: &str,
        instruction: &Instruction,
    ) {
        let because = self
            .written(written, instruction)
            .or(Some(instruction.place));
        match why {
            Refused::Said(remark) => {
                let remark = self.report.remark_of(self.script, remark).clone();
                self.report
                    .block(target, remark.id, &remark.text, remark.hint, because);
            }
            Refused::Chosen => self.report.block(
                target,
                "frame-chosen-at-run-time",
                &format!("only the running program knows the {what}"),
                "set the tool and the work frame before the move in the same routine",
                because,
            ),
            Refused::NoFrame => self.report.block(
                target,
                "frame-chosen-at-run-time",
                &format!("what the program gives as its {what} is none"),
                "set the tool and the work frame before the move in the same routine",
                because,
            ),
        }
    }

    fn push(
        &mut self,
        target: Option<TargetId>,
        (tool, tool_written): (ToolId, Option<Place>),
        (frame, frame_written): (FrameId, Option<Place>),
        configured: bool,
        displacement: Displacement,
        listed: &Listed,
    ) {
        let Listed {
            at, instruction, ..
        } = listed;
        self.report.program.moves.push(Move {
            file: instruction.place.file,
            offset: instruction.place.offset,
            motion: instruction.motion,
            target,
            tool,
            frame,
            displacement,
            configured,
            free_orientation: instruction.free_orientation || listed.choices.free_orientation,
            instruction: *at,
            before: Before::Start,
            tool_written,
            frame_written,
            external_state: listed.external_state,
        });
    }

    // ---- the moves before

    /// Puts moves in the place of stops.
    fn link(&mut self) {
        let mut lists: HashMap<u32, Before> = HashMap::new();
        for stop in 0..self.flow.reached.len() {
            let Some(reached) = self.flow.reached[stop] else {
                continue;
            };
            let (first, end) = self.stops[stop];
            let before = if let Some(before) = lists.get(&reached.before.0) {
                *before
            } else {
                let before = self.moves_of(&reached);
                if !matches!(before, Before::One(_)) {
                    lists.insert(reached.before.0, before);
                }
                before
            };
            for motion in &mut self.report.program.moves[first as usize..end as usize] {
                motion.before = before;
            }
        }
    }

    /// The moves of the stops before one.
    fn moves_of(&mut self, reached: &Reached) -> Before {
        let mut all = Vec::new();
        for &stop in self.flow.sets.of(&reached.before) {
            match stop {
                START => all.push(Before::Start),
                ANYWHERE => all.push(Before::Anywhere),
                stop => {
                    let (first, end) = self.stops[stop as usize];
                    if first == end || end - first > MOST_ALTERNATIVES {
                        all.push(Before::Anywhere);
                    } else {
                        all.extend((first..end).map(Before::One));
                    }
                }
            }
        }
        match all.as_slice() {
            [] => Before::Anywhere,
            [one] => *one,
            _ => {
                let lists = &mut self.report.program.befores;
                lists.push(all.into());
                Before::Several(short(lists.len() - 1))
            }
        }
    }

    // ---- what concerns the whole

    /// A routine that is not in the files may set another tool or frame: that matters where moves
    /// use more than one.
    fn judge_uncertain(&mut self) {
        let uncertain = std::mem::take(&mut self.uncertain);
        if uncertain.is_empty() {
            return;
        }
        let program = &*self.report.program;
        let poses = program.moves.iter().filter(|motion| {
            let target = motion.target.map(|target| &program.targets[target]);
            target.is_some_and(|target| target.layout.shape == Shape::Pose)
        });
        let mut ids: Vec<(ToolId, FrameId)> = poses.map(|m| (m.tool, m.frame)).collect();
        ids.sort_unstable();
        ids.dedup();
        let frames: HashSet<FrameId> = ids.iter().map(|(_, frame)| *frame).collect();
        // tools that differ in their load alone are one here
        let mut tools: Vec<&Tool> = Vec::new();
        let used: HashSet<ToolId> = ids.iter().map(|(tool, _)| *tool).collect();
        for tool in used.into_iter().map(|tool| &program.tools[tool]) {
            let same = |known: &&Tool| {
                known.name == tool.name && known.flange_from_tool == tool.flange_from_tool
            };
            if tools.len() < 2 && !tools.iter().any(same) {
                tools.push(tool);
            }
        }
        let (several_tools, several_frames) = (tools.len() > 1, frames.len() > 1);
        for (target, site, tool_alone) in uncertain {
            if !several_tools && (tool_alone || !several_frames) {
                continue;
            }
            if self.report.program.targets[target].layout.shape == Shape::Joints {
                continue;
            }
            let because = self.flow.place_of(site);
            self.report.block(
                target,
                "frame-chosen-at-run-time",
                "a routine that is not in the files is called and may set another tool or work \
                 frame",
                "give the file with the routine too, or set both behind the call",
                because,
            );
        }
    }

    /// Targets that the running program changes: where a move goes to their numbers in the file
    /// too, these cannot be replaced.
    fn judge_changed(&mut self) {
        for (target, because) in std::mem::take(&mut self.changed) {
            let severity = if self.as_written[target] {
                Severity::Error
            } else {
                Severity::Warning
            };
            self.report.block_as(
                severity,
                target,
                "target-assigned-at-run-time",
                "the running program changes this target; it stays as it is",
                "correct the value where the program computes it, or keep the target out of the \
                 path",
                because,
            );
        }
    }

    /// Targets that are given away, that are frames too, or that nothing uses; writes that nothing
    /// sees.
    fn judge_targets(&mut self) {
        self.judge_changed();
        for &(target, remark) in &self.script.refused {
            if self.used[target] {
                let remark = &self.script.remarks[remark as usize];
                self.report
                    .block(target, remark.id, &remark.text, remark.hint, None);
            }
        }
        for (target, site) in std::mem::take(&mut self.flow.given_away) {
            let because = self.flow.place_of(site);
            self.used[target as usize] = true;
            self.report.block(
                target as usize,
                "target-passed-to-routine",
                "this target is given to a routine that is not in the files, which may use it with \
                 any tool and work frame",
                "give the file with the routine too, or move to the target where its tool and work \
                 frame are named",
                because,
            );
        }
        let mut lost: Vec<u32> = self.flow.holdings.lost.drain().collect();
        lost.sort_unstable();
        for target in lost {
            self.used[target as usize] = true;
            self.report.block(
                target as usize,
                "too-many-uses",
                "a move may go to this and to so many other targets that they are not \
                 distinguished",
                "give fewer files in one call",
                None,
            );
        }
        let mut as_frames: Vec<_> = self.as_frames.drain().collect();
        as_frames.sort_unstable();
        for (target, place) in as_frames {
            if self.used[target] {
                self.report.block(
                    target,
                    "target-used-as-frame",
                    "this target is a tool or work frame, too",
                    "give the frame a variable of its own",
                    Some(place),
                );
            } else {
                // a frame is no target: it stays
                self.report.program.targets[target].blocked = true;
                self.used[target] = true;
            }
        }
        self.tell_unused();
        self.tell_operators();
    }

    /// Targets that no move uses stay where others are used; once a file.
    fn tell_unused(&mut self) {
        if !self.script.is_closed && !self.used.contains(&true) {
            return;
        }
        let mut by_file: Vec<(u32, TargetId, usize)> = Vec::new();
        for target in 0..self.used.len() {
            if self.used[target] {
                continue;
            }
            let found = &mut self.report.program.targets[target];
            found.blocked = true;
            match by_file.last_mut() {
                Some((file, _, count)) if *file == found.file => *count += 1,
                _ => by_file.push((found.file, target, 1)),
            }
        }
        for (file, first, count) in by_file {
            let found = &self.report.program.targets[first];
            let place = Place {
                file,
                offset: found.offset,
            };
            let name = found.name.as_deref().unwrap_or("at this place");
            let message = format!(
                "no move uses {count} of the targets (the first is {name}); they stay as they are"
            );
            let hint = "give the files that use them too, if there are any";
            self.report
                .say("target-unused-here", Severity::Note, place, message, hint);
        }
    }

    /// Writes of routines that nothing calls reach no other routine.
    fn tell_operators(&mut self) {
        let mut said = HashSet::new();
        for (variable, site) in std::mem::take(&mut self.flow.by_operator) {
            let of = &self.script.variables[variable as usize];
            // a mode that is off is off when another routine starts
            let is_mode = matches!(of.declared, Expr::Value(value)
                if matches!(self.flow.value(value), Held::Flag(_) | Held::ExternalOffset(_) | Held::AxesOff(_)));
            let is_unknown = matches!(of.declared, Expr::Absent | Expr::Unknown(_));
            if of.shared || is_mode || is_unknown {
                continue;
            }
            let Some(place) = self.flow.place_of(site) else {
                continue;
            };
            if said.insert(variable) {
                let message = format!(
                    "nothing in the files calls the routine that writes {} here: other routines \
                     are taken to have what is declared",
                    of.name
                );
                let hint = "give the file that calls it too";
                self.report
                    .say("write-not-called", Severity::Warning, place, message, hint);
            }
        }
    }
}

/// Moves of one stop that are distinguished as predecessors.
const MOST_ALTERNATIVES: u32 = 16;

/// Two displacements one after another.
fn both(a: u32, b: u32) -> u32 {
    match (a, b) {
        (NOT_DISPLACED, other) | (other, NOT_DISPLACED) => other,
        (OVERWRITTEN, _) | (_, OVERWRITTEN) => OVERWRITTEN,
        _ => DISPLACED_SOMEHOW,
    }
}

/// What a move has, before its targets are listed.
struct Listed<'a> {
    at: u32,
    stop: Stop,
    instruction: &'a Instruction,
    choices: Rc<Choices>,
    guards: Vec<(RemarkId, Site)>,
    external_state: u32,
}

/// External axes are shifted by one of several offsets.
fn several_offsets() -> Remark {
    Remark::error(
        "external-offset-unknown",
        "only the running program knows by how much external axes are shifted here",
        "switch the shift off, or set it with numbers before the move in the same routine",
    )
}

/// Collects findings.
struct Report<'a, 'p> {
    sources: &'a [Source],
    program: &'p mut Program,
    /// Remarks of tools and frames, behind those of the script.
    remarks: Vec<Remark>,
    said: HashSet<(TargetId, &'static str)>,
    once: HashSet<(&'static str, Place)>,
    places: Vec<(Place, Finding)>,
}

/// Identifiers of the report's own remarks begin here.
const OWN_REMARKS: RemarkId = 1 << 31;

impl<'a, 'p> Report<'a, 'p> {
    fn new(sources: &'a [Source], program: &'p mut Program) -> Self {
        Self {
            sources,
            program,
            remarks: Vec::new(),
            said: HashSet::new(),
            once: HashSet::new(),
            places: Vec::new(),
        }
    }

    fn remark(&mut self, remark: Remark) -> RemarkId {
        self.remarks.push(remark);
        OWN_REMARKS + short(self.remarks.len() - 1)
    }

    fn remark_of<'r>(&'r self, script: &'r Script, remark: RemarkId) -> &'r Remark {
        match remark.checked_sub(OWN_REMARKS) {
            Some(own) => &self.remarks[own as usize],
            None => &script.remarks[remark as usize],
        }
    }

    fn say(
        &mut self,
        id: &'static str,
        severity: Severity,
        place: Place,
        message: String,
        hint: &str,
    ) {
        if self.once.insert((id, place)) {
            let source = &self.sources[place.file as usize];
            let finding = source.finding(place.offset as usize, id, severity, message, hint);
            self.places.push((place, finding));
        }
    }

    /// A remark at a place, once.
    fn say_once(&mut self, remark: &Remark, place: Place) {
        let text = remark.text.to_string();
        self.say(remark.id, remark.severity, place, text, remark.hint);
    }

    /// The target has to stay as it is; `because` is where the program says so. Joint targets stay
    /// unless they are asked for.
    fn block(
        &mut self,
        target: TargetId,
        id: &'static str,
        wrong: &str,
        hint: &str,
        because: Option<Place>,
    ) {
        self.block_as(Severity::Error, target, id, wrong, hint, because);
    }

    fn block_as(
        &mut self,
        of_pose: Severity,
        target: TargetId,
        id: &'static str,
        wrong: &str,
        hint: &str,
        because: Option<Place>,
    ) {
        if !self.said.insert((target, id)) {
            return;
        }
        let blocked = &mut self.program.targets[target];
        blocked.blocked = true;
        let place = Place {
            file: blocked.file,
            offset: blocked.offset,
        };
        let severity = match blocked.layout.shape {
            Shape::Pose => of_pose,
            Shape::Joints => Severity::Warning,
        };
        let name = blocked.name.as_deref().unwrap_or("target");
        let see = match because.filter(|because| *because != place) {
            None => String::new(),
            Some(because) => {
                let source = &self.sources[because.file as usize];
                let (line, _) = source.line_column(because.offset as usize);
                format!(" (see {} line {line})", source.name)
            }
        };
        let message = format!("{name}: {wrong}{see}");
        let source = &self.sources[place.file as usize];
        let finding = source.finding(place.offset as usize, id, severity, message, hint);
        self.places.push((place, finding));
    }

    /// Adds the findings to those of the reader, by file and place.
    fn finish(&mut self) {
        let order: HashMap<&str, usize> = self
            .sources
            .iter()
            .map(|s| s.name.as_str())
            .zip(0..)
            .collect();
        let found = std::mem::take(&mut self.places);
        let findings = &mut self.program.findings;
        findings.extend(found.into_iter().map(|(_, finding)| finding));
        findings
            .sort_by_cached_key(|f| (order.get(f.file.as_str()).copied(), f.line, f.column, f.id));
    }
}
