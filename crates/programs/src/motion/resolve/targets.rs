//! Where moves go.

use super::{Choices, Listed, MOST_USES, Refused, Resolver};
use crate::finding::Severity;
use crate::motion::flow::OF_MOVE;
use crate::motion::holding::{Atom, DECLARED, Holding, Site};
use crate::program::script::{
    DisplacementId, Expr, Held, Instruction, NOT_DISPLACED, Place, RemarkId, ValueId, short,
};
use crate::program::{Before, Displacement, Frame, FrameId, Move, Shape, TargetId, Tool, ToolId};

impl Resolver<'_, '_> {
    /// Lists the moves to an expression that says the same whatever was before, or to each of
    /// several.
    pub(super) fn fixed(&mut self, value: Expr, displacement: u32, listed: &mut Listed) {
        let script = self.script;
        match value {
            Expr::Absent | Expr::Element { .. } => self.go_nowhere(listed),
            Expr::Variable(variable) => {
                let held = self.flow.chosen_at(listed.stop, variable);
                self.go_to_each(held, displacement, listed);
            }
            Expr::Target(target) => self.go_target(target, displacement, listed),
            Expr::Value(value) => self.go_to(Atom::Value(value), None, displacement, listed),
            Expr::Unknown(remark) => self.go_to(Atom::Unknown(remark), None, displacement, listed),
            Expr::Product(product) => {
                let remark = script.products[product as usize].otherwise;
                self.go_to(Atom::Unknown(remark), None, displacement, listed);
            }
            Expr::Displaced { base, by } => {
                for by in self.flow.displaced_again(by, displacement, OF_MOVE) {
                    self.fixed(script.lists[base as usize], by, listed);
                }
            }
            Expr::DisplacedByCall { base, by } => {
                let of = &script.by_calls[by as usize];
                let call = self.flow.chosen_at(listed.stop, of.call);
                for by in self.flow.by_call(of, call) {
                    for by in self.flow.displaced_again(by, displacement, OF_MOVE) {
                        self.fixed(script.lists[base as usize], by, listed);
                    }
                }
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

    pub(super) fn too_many(&mut self, place: Place) {
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

    /// Lists the moves to all that a variable may hold.
    pub(super) fn go_to_each(&mut self, held: Holding, displacement: u32, listed: &mut Listed) {
        let atoms = self.atoms(held);
        let is_target = |(atom, _): &(Atom, Site)| matches!(atom, Atom::Target { .. });
        listed.is_one_of = atoms.iter().any(is_target);
        for (atom, site) in atoms {
            self.go_to(atom, Some(site), displacement, listed);
        }
    }

    fn go_to(&mut self, atom: Atom, site: Option<Site>, displacement: u32, listed: &mut Listed) {
        let script = self.script;
        match atom {
            Atom::Target {
                target,
                displacement: of,
            } => {
                for by in self.flow.displaced_again(of, displacement, OF_MOVE) {
                    self.go_target(target as usize, by, listed);
                }
            }
            Atom::Changed { target } => {
                let because = site.and_then(|site| self.flow.place_of(site));
                self.used[target as usize] = true;
                self.changed.push((target as usize, because));
                self.go_nowhere(listed);
            }
            Atom::Value(ValueId::MAX) | Atom::Uncertain => self.go_nowhere(listed),
            Atom::Value(value) => {
                match self.flow.value(value) {
                    Held::Actual | Held::ActualWith { .. } if displacement == NOT_DISPLACED => {
                        let is_as_read = self.flow.is_as_read(value, listed.stop);
                        self.at_robot(is_as_read, listed.instruction.place);
                        if is_as_read {
                            let at = short(self.report.program.moves.len());
                            self.revisits.push((at, site));
                        }
                    }
                    Held::Actual | Held::ActualWith { .. } | Held::NearActual
                        if self.flow.is_said(displacement)
                            && self.flow.is_as_read(value, listed.stop) =>
                    {
                        let by = self.flow.near_by(value, displacement);
                        let stood = by.map(|by| self.stood(by, site, listed));
                        if let Some(stood) = stood.filter(|stood| !stood.is_empty()) {
                            return self.go_to_stood(stood, listed);
                        }
                        self.near_robot(listed.instruction.place);
                    }
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
                let place = listed.instruction.place;
                let is_step = self.step(listed).is_some();
                let stood = is_step.then(|| self.stood(displacement, None, listed));
                if let Some(stood) = stood.filter(|stood| !stood.is_empty()) {
                    return self.go_to_stood(stood, listed);
                }
                if remark.id == "computed-target" && listed.is_one_of {
                    self.computed_too(place, remark.hint);
                } else if remark.id.starts_with("frame-") {
                    // data that may be tools and frames, gone to as a position
                    self.computed(place);
                } else {
                    self.report.say_once(remark, place);
                }
                self.go_nowhere(listed);
            }
            Atom::Anything => {
                self.computed(listed.instruction.place);
                self.go_nowhere(listed);
            }
        }
    }

    /// A move to where the robot itself was.
    fn at_robot(&mut self, is_as_read: bool, place: Place) {
        let (id, severity, message, hint) = if is_as_read {
            let message = "this move goes to where the robot itself was; that is right as it is";
            ("run-time-position", Severity::Note, message, "")
        } else {
            let message = "this move goes to where the robot itself was, as a pose of another tool or \
                in another work frame, or of one that only the running program knows: with this \
                move's own it is not corrected";
            let hint = "read the position with the tool and the work frame of the move";
            ("computed-target", Severity::Warning, message, hint)
        };
        self.report.say(id, severity, place, message.into(), hint);
    }

    /// A move to where the robot itself was, displaced.
    fn near_robot(&mut self, place: Place) {
        let message = "this move goes to where the robot itself was, displaced as the program says: \
            it stays as it is, and lands as far off as the arm's error differs between the two";
        let hint = "write the position with numbers where it must be exact";
        let severity = Severity::Warning;
        self.report
            .say("run-time-position", severity, place, message.into(), hint);
    }

    pub(super) fn computed(&mut self, place: Place) {
        let message = "the position that this move goes to is known at run time only; the move \
            stays as it is";
        let hint = "write the position with numbers where it must be exact";
        let severity = Severity::Warning;
        self.report
            .say("computed-target", severity, place, message.into(), hint);
    }

    /// Likewise of a move that may go to targets of the files, too.
    fn computed_too(&mut self, place: Place, hint: &str) {
        let message = "this move goes to targets of the files, or to a position that is known at \
            run time only: to that it stays as it is";
        let severity = Severity::Warning;
        self.report
            .say("computed-target", severity, place, message.into(), hint);
    }

    /// A move to somewhere: nothing is rewritten, and what follows does not know where it comes
    /// from.
    pub(super) fn go_nowhere(&mut self, listed: &Listed) {
        let (tool, _) = listed.choices.tools[0];
        let (frame, _) = listed.choices.frames[0];
        let step = self.step(listed).unwrap_or(Displacement::None);
        self.push(None, (tool, None), (frame, None), false, step, listed);
    }

    /// By what the text displaces a move from where the robot stands.
    fn step(&self, listed: &Listed) -> Option<Displacement> {
        let script = self.script;
        let (base, by) = match listed.instruction.target {
            Expr::Displaced { base, by } => (script.lists[base as usize], by),
            other => (other, listed.instruction.displacement),
        };
        let modal = &script.modals[listed.instruction.modal as usize];
        let is_here = match base {
            Expr::Unknown(remark) => script.remarks[remark as usize].id.starts_with("relative-"),
            Expr::Value(value) => match script.values[value as usize] {
                Held::ActualWith { tool, frame } => (modal.tool, modal.frame) == (tool, frame),
                _ => false,
            },
            _ => false,
        };
        let choices = &listed.choices;
        let is_one = choices.tools.len() == 1
            && choices.frames.len() == 1
            && choices.refused.is_empty()
            && choices.uncertainty.is_none();
        let by = self.flow.displacement(by);
        let is_said = matches!(by, Displacement::By(_)) && !listed.is_shifted;
        (is_here && is_one && is_said).then(|| by.clone())
    }

    /// The targets at which the robot may stand when a move displaces it by as much from there, with
    /// all that displaces it then: where it stopped after moves to targets with the tool and in the
    /// work frame of this one. None where it may stand elsewhere.
    fn stood(
        &self,
        by: DisplacementId,
        read: Option<Site>,
        listed: &Listed,
    ) -> Vec<(TargetId, Displacement)> {
        let choices = &listed.choices;
        let ([(tool, _)], [(frame, _)]) = (&choices.tools[..], &choices.frames[..]) else {
            return Vec::new();
        };
        let is_sure = choices.refused.is_empty() && choices.uncertainty.is_none();
        if !is_sure || listed.is_shifted || self.flow.has_concurrent {
            return Vec::new();
        }
        let before = match (read, self.flow.reached[listed.stop as usize]) {
            (Some(read), _) => self.flow.stood.get(&read).copied(),
            (None, Some(reached)) if reached.led.is_none() => Some(reached.before),
            _ => None,
        };
        let mut stood = Vec::new();
        for stop in before.iter().flat_map(|before| self.flow.sets.of(before)) {
            let (first, end) = self.stops.get(*stop as usize).copied().unwrap_or_default();
            let moves = &self.report.program.moves[first as usize..end as usize];
            let there = moves.iter().map(|there| {
                let is_equipped = (there.tool, there.frame) == (*tool, *frame);
                self.displaced_from(there, by).filter(|_| is_equipped)
            });
            match there.collect::<Option<Vec<_>>>() {
                Some(there) if !there.is_empty() => stood.extend(there),
                _ => return Vec::new(),
            }
        }
        stood
    }

    /// The target to which a move leads, and by what it is displaced with `by` in addition.
    fn displaced_from(&self, there: &Move, by: DisplacementId) -> Option<(TargetId, Displacement)> {
        let target = there.target?;
        let modal = self.script.instructions[there.instruction as usize].modal;
        let speed_zone = self.script.modals[modal as usize].speed_zone;
        let is_pose = self.report.program.targets[target].layout.shape == Shape::Pose;
        if speed_zone.cuts_corner() || !is_pose || self.own_frames.contains_key(&target) {
            return None;
        }
        let displacement = match (&there.displacement, self.flow.displacement(by)) {
            (Displacement::None, Displacement::By(by)) => by.clone(),
            (Displacement::By(shift), Displacement::By(by)) => Box::new(shift.then(by)),
            _ => return None,
        };
        Some((target, Displacement::By(displacement)))
    }

    fn go_to_stood(&mut self, stood: Vec<(TargetId, Displacement)>, listed: &mut Listed) {
        for (target, displacement) in stood {
            self.go_displaced(target, displacement, true, listed);
        }
    }

    pub(super) fn go_target(&mut self, target: TargetId, displacement: u32, listed: &mut Listed) {
        let is_made = self.flow.is_made(displacement);
        let displacement = self.flow.displacement(displacement).clone();
        self.go_displaced(target, displacement, is_made, listed);
    }

    /// Lists the moves to a target; `is_made`: what displaces it is put together of several.
    fn go_displaced(
        &mut self,
        target: TargetId,
        displacement: Displacement,
        is_made: bool,
        listed: &mut Listed,
    ) {
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
        // of another joint the correction is another one
        let displacement = if is_joints && listed.is_shifted {
            Displacement::Unbounded
        } else {
            displacement
        };
        if matches!(
            displacement,
            Displacement::Unknown | Displacement::Unbounded
        ) {
            if listed.near.contains(&target) {
                return;
            }
            listed.near.push(target);
        } else if is_made {
            let all = &mut listed.displaced;
            if all
                .iter()
                .any(|(of, by)| *of == target && *by == displacement)
            {
                return;
            }
            all.push((target, displacement.clone()));
        }
        let choices = &*listed.choices;
        if !is_joints {
            for &(why, site, what) in &choices.refused {
                self.refuse(target, why, site, what, listed.instruction);
            }
        }
        let own = self.own_frames.get(&target).copied();
        let own = own.map(|frame| {
            let known = frame.unwrap_or_else(|why| {
                self.refuse(target, why, DECLARED, "work frame", listed.instruction);
                self.unknown_frame()
            });
            [(known, DECLARED)]
        });
        let frames = own.as_ref().map_or(&choices.frames[..], |own| own);
        for &(tool, tool_site) in &choices.tools {
            for &(frame, frame_site) in frames {
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

    /// With a tool or frame that only the running program knows a move to a pose goes elsewhere,
    /// besides where it goes with those that are known; `first` is its first move.
    pub(super) fn go_elsewhere(&mut self, first: usize, listed: &Listed) {
        let Choices {
            tools,
            frames,
            refused,
            ..
        } = &*listed.choices;
        let is_known = tools
            .iter()
            .all(|(tool, _)| Some(*tool) != self.unknown_tool)
            && frames
                .iter()
                .all(|(frame, _)| Some(*frame) != self.unknown_frame);
        let program = &self.report.program;
        let is_pose = |motion: &Move| {
            let target = program.target_of(motion);
            target.is_some_and(|target| target.layout.shape == Shape::Pose)
        };
        if !refused.is_empty() && is_known && program.moves[first..].iter().any(is_pose) {
            self.go_nowhere(listed);
        }
    }

    /// The tool of a joint target whose tool nobody knows.
    pub(super) fn unknown_tool(&mut self) -> ToolId {
        if let Some(known) = self.unknown_tool {
            return known;
        }
        let tools = &mut self.report.program.tools;
        tools.push(Tool {
            name: String::new(),
            flange_from_tool: None,
            load: None,
            carried: None,
            on_tool: None,
        });
        let made = tools.len() - 1;
        self.unknown_tool = Some(made);
        made
    }

    pub(super) fn unknown_frame(&mut self) -> FrameId {
        if let Some(known) = self.unknown_frame {
            return known;
        }
        let frames = &mut self.report.program.frames;
        frames.push(Frame {
            name: String::new(),
            world_from_frame: None,
            on: Box::default(),
            stand: None,
        });
        let made = frames.len() - 1;
        self.unknown_frame = Some(made);
        made
    }

    /// Whether a remark is about where a move goes, not about its tool or frame.
    fn is_of_a_position(&self, remark: RemarkId) -> bool {
        self.report.remark_of(self.script, remark).id == "computed-target"
    }

    pub(super) fn refuse(
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
            Refused::Said(remark) if !self.is_of_a_position(remark) => {
                let remark = self.report.remark_of(self.script, remark).clone();
                self.report
                    .block(target, remark.id, &remark.text, remark.hint, because);
            }
            // a tool or frame that is a copy of a position, too
            Refused::Said(_) | Refused::Chosen => self.report.block(
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

    pub(super) fn push(
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
        let targets = &self.report.program.targets;
        let is_given = self.given.is_given(self.script, targets, instruction);
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
            coordinated: instruction.coordinated,
            instruction: *at,
            before: Before::Start,
            tool_written,
            frame_written,
            external_state: listed.external_state,
            is_dead: listed.is_dead,
            is_given,
        });
    }
}
