//! The moves before each, and what concerns the whole program.

use super::{MOST_ALTERNATIVES, Resolver};
use crate::finding::Severity;
use crate::motion::before::{ANYWHERE, Before as Stops, START};
use crate::program::script::{Call, Expr, Held, Place, RoutineId, Start, Statement, short};
use crate::program::{Before, FrameId, Interrupt, Shape, TargetId, Tool, ToolId};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// The routines that run between any two moves of others.
struct Roots {
    /// Each, and all that it comes to.
    all: Vec<(RoutineId, HashSet<RoutineId>)>,
    /// Those that are started as what may move the robot.
    moving: HashSet<RoutineId>,
}

impl Roots {
    /// Those that come to a routine.
    fn of(&self, routine: RoutineId) -> impl Iterator<Item = RoutineId> + '_ {
        let all = self.all.iter();
        all.filter(move |(_, reached)| reached.contains(&routine))
            .map(|(root, _)| *root)
    }

    fn moves(&self, root: RoutineId) -> bool {
        self.moving.contains(&root)
    }
}

impl Resolver<'_, '_> {
    /// Puts moves in the place of stops.
    pub(super) fn link(&mut self) {
        let roots = self.roots();
        let mut lists: HashMap<u32, Before> = HashMap::new();
        for stop in 0..self.flow.reached.len() {
            let Some(reached) = self.flow.reached[stop] else {
                continue;
            };
            let (first, end) = self.stops[stop];
            let before = if let Some(before) = lists.get(&reached.before.0) {
                *before
            } else {
                let before = self.moves_of(reached.before);
                if !matches!(before, Before::One(_)) {
                    lists.insert(reached.before.0, before);
                }
                before
            };
            for motion in &mut self.report.program.moves[first as usize..end as usize] {
                motion.before = before;
            }
            if reached.is_concurrent && first != end {
                for root in roots.of(self.flow.routine_of(stop)) {
                    self.interrupt(root).moves.extend(first..end);
                }
            }
            if let Some(call) = reached.led {
                let called = (first..end).map(|motion| (motion, call));
                self.report.program.led.extend(called);
            }
        }
        for (motion, site) in std::mem::take(&mut self.revisits) {
            let stood = site.and_then(|site| self.flow.stood.get(&site)).copied();
            let stood = stood.map_or(Before::Anywhere, |stood| self.moves_of(stood));
            self.report.program.revisits.push((motion, stood));
        }
        let script = self.script;
        for (call, routine) in std::mem::take(&mut self.flow.at_any_time) {
            let call = &script.calls[call as usize];
            let Some(routine) = routine else {
                self.foreign_interrupt(call);
                continue;
            };
            for root in roots.of(routine).filter(|root| roots.moves(*root)) {
                // what an interrupt does without a routine of its own has no name
                if script.routines[root as usize].name.is_empty() {
                    self.foreign_interrupt(call);
                } else {
                    let foreign = &mut self.interrupt(root).foreign;
                    foreign.get_or_insert_with(|| call.name.clone());
                }
            }
        }
        for of in &mut self.report.program.interrupts {
            of.moves.sort_unstable();
        }
    }

    /// What runs at any time.
    fn roots(&self) -> Roots {
        let script = self.script;
        let of = (0..).zip(&script.routines);
        let roots = of.filter(|(_, of)| of.start == Start::Concurrent);
        let all = roots.map(|(root, _)| (root, script.reached_from(&[root])));
        let starts = script.statements.iter().filter_map(|statement| {
            let Statement::Start(call) = statement else {
                return None;
            };
            let call = &script.calls[*call as usize];
            call.leads.then_some(&*call.callees)
        });
        Roots {
            all: all.collect(),
            moving: starts.flatten().copied().collect(),
        }
    }

    /// What is noted of a routine that runs between any two moves of others.
    fn interrupt(&mut self, routine: RoutineId) -> &mut Interrupt {
        let of = &self.script.routines[routine as usize];
        let is_same = |other: &Interrupt| (other.place, &other.name) == (of.place, &of.name);
        self.interrupt_where(is_same, of.place, &of.name)
    }

    /// Likewise of one that is not in the files; once, wherever it is started.
    fn foreign_interrupt(&mut self, call: &Call) {
        let is_same = |other: &Interrupt| {
            other.name == call.name && other.foreign.as_ref() == Some(&call.name)
        };
        let of = self.interrupt_where(is_same, call.place, &call.name);
        of.foreign = Some(call.name.clone());
    }

    fn interrupt_where(
        &mut self,
        is_same: impl Fn(&Interrupt) -> bool,
        place: Place,
        name: &str,
    ) -> &mut Interrupt {
        let interrupts = &mut self.report.program.interrupts;
        let at = interrupts.iter().position(is_same).unwrap_or_else(|| {
            interrupts.push(Interrupt {
                place,
                name: name.into(),
                moves: Vec::new(),
                foreign: None,
            });
            interrupts.len() - 1
        });
        &mut interrupts[at]
    }

    /// The moves of a set of stops.
    pub(super) fn moves_of(&mut self, stops: Stops) -> Before {
        let mut all = Vec::new();
        for &stop in self.flow.sets.of(&stops) {
            match stop {
                START => all.push(Before::Start),
                ANYWHERE => all.push(Before::Anywhere),
                stop => {
                    let (first, end) = self.stops[stop as usize];
                    if first == end {
                        all.push(Before::Anywhere);
                    } else if end - first > MOST_ALTERNATIVES {
                        all.push(Before::AnyOf { first, end });
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

    /// A routine that is not in the files may set another tool or frame: that matters where moves
    /// use more than one.
    pub(super) fn judge_uncertain(&mut self) {
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
            let (wrong, hint) = if self.flow.calls_one_of(site) {
                (
                    "which routine is called is known only while the program runs, and some may \
                     set another tool or work frame",
                    "call the routine by its name, or set both behind the call",
                )
            } else {
                (
                    "a routine that is not in the files is called and may set another tool or work \
                     frame",
                    "give the file with the routine too, or set both behind the call",
                )
            };
            self.report
                .block(target, "frame-chosen-at-run-time", wrong, hint, because);
        }
    }

    /// Targets that the running program changes: where a move goes to their numbers in the file
    /// too, these cannot be replaced.
    pub(super) fn judge_changed(&mut self) {
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
    pub(super) fn judge_targets(&mut self) {
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
        let offsets = &self.script.offsets;
        let placed = offsets
            .iter()
            .map(|target| (*target, self.report.program.targets[*target].place()));
        let mut as_frames: Vec<_> = self.as_frames.drain().chain(placed).collect();
        as_frames.sort_unstable();
        as_frames.dedup_by_key(|(target, _)| *target);
        for (target, place) in as_frames {
            if self.used[target] {
                self.report.block(
                    target,
                    "target-used-as-frame",
                    "this target is a tool, a work frame or a displacement, too",
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
    pub(super) fn tell_unused(&mut self) {
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
    pub(super) fn tell_operators(&mut self) {
        let mut said = HashSet::new();
        for (variable, site) in std::mem::take(&mut self.flow.left) {
            let Some(place) = self.flow.place_of(site).filter(|_| said.insert(variable)) else {
                continue;
            };
            let message = format!(
                "a routine that nothing in the files calls goes with {0}, which is written here: it \
                 is taken to have what is declared, and not what the last run has left",
                self.script.variables[variable as usize].name
            );
            let hint = "give the file that calls it too, or set the data in the routine";
            self.report
                .say("write-not-called", Severity::Warning, place, message, hint);
        }
        for (variable, site) in std::mem::take(&mut self.flow.by_operator) {
            let of = &self.script.variables[variable as usize];
            // a mode that is off is off when another routine starts
            let is_mode = matches!(of.declared, Expr::Value(value)
                if matches!(self.flow.value(value), Held::Flag(_) | Held::Shift(_) | Held::ExternalOffset(_) | Held::AxesOff(_)));
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
