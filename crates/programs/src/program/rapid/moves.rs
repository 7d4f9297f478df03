//! Instructions that move: what each goes to, with which tool, in which work object.

use super::records::load_of;
use super::resolved::Entity;
use super::syntax::{Argument, Base, Callee, Expression, Index, Part, Path, Type, Verb, indices};
use super::translate::Translator;
use super::verbs::Led;
use crate::geometry::units::MM;
use crate::program::names::{Meaning, Symbol};
use crate::program::script::{Call, Expr, Held, How, Instruction, Modal, Remark, Span, Written};
use crate::program::{Motion, SpeedZone, number};

/// The parts of a move instruction, as indices of its arguments.
struct Parts {
    /// Arguments that are or should be targets.
    targets: std::ops::Range<usize>,
    tool: Option<usize>,
    frame: Option<usize>,
    load: Option<usize>,
    /// It has an ID for synchronised robots.
    synchronised: bool,
    /// The option with which a sensor corrects its path.
    corrected: Option<&'static str>,
    /// External axes are not shifted in it.
    unshifted: bool,
    /// Speed and zone where they are predefined ones.
    speed_zone: SpeedZone,
}

/// Predefined speeds (`v100`), mm/s, and zones (`z10`), mm.
///
/// # Source
/// ABB, "Technical reference manual: RAPID Instructions, Functions and Data types", speeddata and
/// zonedata.
const SPEEDS: [u16; 25] = [
    5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500, 2000, 2500,
    3000, 4000, 5000, 6000, 7000,
];
const ZONES: [u16; 14] = [0, 1, 5, 10, 15, 20, 30, 40, 50, 60, 80, 100, 150, 200];

/// What leads the robot elsewhere than its targets.
const FORCE: &str = "a force that leads the arm";

/// The number that a predefined name ends on.
fn predefined(name: &str, letter: char, known: &[u16]) -> Option<f64> {
    let rest = name.strip_prefix([letter, letter.to_ascii_uppercase()])?;
    let number = rest.parse().ok().filter(|number| known.contains(number))?;
    Some(f64::from(number))
}

/// What a predefined name says of a move's speed and zone.
fn read_speed_zone(name: &str, speed_zone: &mut SpeedZone) {
    if let Some(mm) = predefined(name, 'v', &SPEEDS) {
        speed_zone.speed_m_s = speed_zone.speed_m_s.or(Some(mm * MM));
    } else if let Some(mm) = predefined(name, 'z', &ZONES) {
        // z0 is 0.3 mm
        speed_zone.zone_m = speed_zone.zone_m.or(Some(mm.max(0.3) * MM));
    } else if name.eq_ignore_ascii_case("fine") {
        speed_zone.zone_m = speed_zone.zone_m.or(Some(0.0));
    }
}

/// The name that an argument is.
pub(super) fn plain(argument: &Argument) -> Option<Symbol> {
    match argument.expression {
        Expression::Point {
            base: Base::Named { name, .. },
            steps,
        } if steps.0 == steps.1 && argument.option.is_none() => Some(name),
        _ => None,
    }
}

/// Whether an argument is what a function gives, or a part of a record.
fn is_given(argument: &Argument) -> bool {
    matches!(
        argument.expression,
        Expression::Member { .. }
            | Expression::Point {
                base: Base::Function(_),
                ..
            }
    )
}

/// The index of the argument with this option.
fn option(all: &[Argument], word: Option<Symbol>) -> Option<usize> {
    let word = word?;
    all.iter()
        .position(|argument| argument.option == Some(word))
}

impl Translator<'_> {
    /// Whether an argument can be a target.
    pub(super) fn is_target(&self, argument: &Argument) -> bool {
        match argument.expression {
            Expression::Point { steps, base } => match base {
                Base::Target(_) => true,
                Base::Named { name, .. } => {
                    let kind = self.resolved.kind(name, self.context);
                    steps.0 < steps.1 || kind.is_some_and(Type::is_target)
                }
                Base::Function(_) => steps.0 < steps.1,
            },
            Expression::Composed(_) => true,
            _ => false,
        }
    }

    pub(super) fn is_tool(&self, argument: &Argument) -> bool {
        plain(argument)
            .is_some_and(|name| self.resolved.kind(name, self.context) == Some(Type::Tooldata))
    }

    /// Takes a move instruction apart; `None` where it has no argument for a target.
    fn parts(&self, all: &[Argument], path: Path, led: Led, tool_inside: bool) -> Option<Parts> {
        let positional = || {
            all.iter()
                .enumerate()
                .filter(|(_, argument)| argument.option.is_none())
        };
        let candidates = || positional().skip(usize::from(led.first()));
        let mut start = candidates()
            .find(|(_, argument)| self.is_target(argument))
            .or_else(|| candidates().next())?
            .0;
        if path == Path::Arc
            && let Some((before, _)) = candidates().take_while(|(at, _)| *at < start).last()
            && !positional()
                .find(|(at, _)| *at > start)
                .is_some_and(|(_, behind)| self.is_target(behind) || is_given(behind))
        {
            // the first that is known to be a target ends the arc: a function's result, a part of
            // a record or a name that is not declared is the point on its way
            start = before;
        }
        let end = if path == Path::Arc {
            let next = positional().find(|(at, _)| *at > start);
            next.map_or(start + 1, |(at, _)| at + 1)
        } else {
            start + 1
        };
        // options stand behind the argument they belong to
        let option = |word| option(all, word);
        let words = &self.words;
        let wobj = option(words.wobj);
        let (mut declared, mut last, mut before_wobj, mut inside) = (None, None, None, None);
        let mut speed_zone = SpeedZone::default();
        for (place, (at, argument)) in positional().filter(|(at, _)| *at >= end).enumerate() {
            last = Some(at);
            // what the files declare hides a predefined name
            let undeclared =
                plain(argument).filter(|name| self.resolved.kind(*name, self.context).is_none());
            if let Some(name) = undeclared {
                read_speed_zone(self.resolved.spelling(name), &mut speed_zone);
            }
            // speed, zone and tool: a zone of the program's own is mostly no stop
            speed_zone.blends = place >= 2 && speed_zone.zone_m.is_none();
            if place == 2 {
                inside = Some(at);
            }
            if wobj.is_some_and(|wobj| at < wobj) {
                before_wobj = Some(at);
            }
            if self.is_tool(argument) {
                declared = Some(at);
            }
        }
        let tool = declared
            .or(before_wobj)
            .or(if tool_inside && wobj.is_none() {
                inside
            } else {
                last
            });
        Some(Parts {
            targets: start..end,
            tool,
            frame: wobj,
            load: option(words.tload),
            synchronised: option(words.id).is_some(),
            corrected: [(words.corr, "\\Corr"), (words.track, "\\Track")]
                .into_iter()
                .find_map(|(word, name)| option(word).map(|_| name)),
            unshifted: option(words.noeoffs).is_some(),
            speed_zone,
        })
    }

    /// Speed and zone of a move with what `\V`, `\T` and `\Z` replace of them: with a time for the
    /// whole path the speed is not known.
    fn switched(&self, all: &[Argument], mut speed_zone: SpeedZone) -> SpeedZone {
        let words = &self.words;
        if let Some(at) = option(all, words.v) {
            speed_zone.speed_m_s = self.millimetres(&all[at]);
        }
        if option(all, words.t).is_some() {
            speed_zone.speed_m_s = None;
        }
        // the robot stops at `fine`, whatever the size of the zone
        if let Some(at) = option(all, words.z)
            && speed_zone.zone_m != Some(0.0)
        {
            speed_zone.zone_m = self.millimetres(&all[at]);
            speed_zone.blends = speed_zone.zone_m.is_none();
        }
        speed_zone
    }

    /// The length of `\Z:=3`, in metres; `None` where it is no literal number.
    fn millimetres(&self, argument: &Argument) -> Option<f64> {
        let (start, end) = argument.span;
        let bytes = &self.resolved.sources[self.here.file as usize].bytes;
        let text = &bytes[start as usize..end as usize];
        let value = text.rsplit(|byte| *byte == b'=').next()?;
        number::parse(value.trim_ascii()).map(|mm| mm * MM)
    }

    /// Names that a move instruction uses as targets or frames.
    pub(super) fn wants_of_move(
        &self,
        all: &[Argument],
        path: Path,
        led: Led,
        tool_inside: bool,
    ) -> Vec<(Symbol, Type)> {
        let Some(parts) = self.parts(all, path, led, tool_inside) else {
            return Vec::new();
        };
        let kind = if path == Path::Absolute {
            Type::Jointtarget
        } else {
            Type::Robtarget
        };
        let name = |at: usize| match all[at].expression {
            Expression::Point {
                base: Base::Named { name, .. },
                ..
            } => Some(name),
            _ => None,
        };
        let targets = parts.targets.clone().filter_map(name);
        let mut wants: Vec<_> = targets.map(|name| (name, kind)).collect();
        let tool = parts.tool.and_then(name);
        wants.extend(tool.map(|name| (name, Type::Tooldata)));
        let frame = parts.frame.and_then(name);
        wants.extend(frame.map(|name| (name, Type::Wobjdata)));
        wants
    }

    /// Whether what joints are written for may ride on a positioner: a declared work object.
    fn may_carry(&self, argument: &Argument) -> bool {
        let Expression::Point {
            base: Base::Named { name, .. },
            ..
        } = argument.expression
        else {
            return false;
        };
        self.has_positioners && self.resolved.kind(name, self.context) == Some(Type::Wobjdata)
    }

    /// A move instruction up to `end`.
    pub(super) fn go(&mut self, callee: Callee, verb: Verb, arguments: Part, end: u32) {
        let Verb::Move {
            path,
            led,
            tool_inside,
        } = verb
        else {
            return;
        };
        let resolved = self.resolved;
        let all = &resolved.parsed.arguments[indices(arguments)];
        let absolute = path == Path::Absolute;
        let Some(parts) = self.parts(all, path, led, tool_inside) else {
            let target = self.computed();
            let instruction = Instruction {
                end,
                target,
                ..Instruction::at(self.here)
            };
            self.emit_move(instruction, Modal::default());
            return;
        };
        let load = match parts.load.map_or(Expr::Absent, |at| self.carried(&all[at])) {
            Expr::Absent => self.gripped(),
            load => load,
        };
        let speed_zone = self.switched(all, parts.speed_zone);
        self.tell(&parts, callee, led);
        let tool = match parts.tool {
            Some(at) => self.frame_from(all[at].expression),
            None => self.frame_chosen(),
        };
        let frame = match parts.frame {
            Some(at) if !absolute || self.may_carry(&all[at]) => {
                self.frame_from(all[at].expression)
            }
            _ => Expr::Value(self.wobj0),
        };
        let modes = &self.modes;
        let (configured, wrist) = match path {
            Path::Joint => (Expr::Variable(modes.conf_j), Expr::Absent),
            Path::Absolute => (Expr::Absent, Expr::Absent),
            Path::Linear | Path::Arc => (Expr::Variable(modes.conf_l), Expr::Variable(modes.wrist)),
        };
        let wanted = if absolute {
            Type::Jointtarget
        } else {
            Type::Robtarget
        };
        for at in parts.targets.clone() {
            // an option between the two targets of an arc
            if all[at].option.is_some() {
                continue;
            }
            self.ambiguous = false;
            let target = match all[at].expression {
                Expression::Member { name, .. } => self.in_record(name, all[at].span),
                expression => self.position_of_move(expression, wanted),
            };
            let guards = match (absolute, self.ambiguous) {
                (true, false) if parts.unshifted => self.modes.unshifted_guards,
                (true, false) => self.modes.absolute_guards,
                (false, false) if path == Path::Arc => self.modes.arc_guards,
                (false, false) => self.modes.guards,
                (_, true) => self.modes.ambiguous_guards,
            };
            let motion = match path {
                Path::Joint | Path::Absolute => Motion::Joint,
                Path::Linear => Motion::Linear,
                Path::Arc if at == parts.targets.start => Motion::ArcVia,
                Path::Arc => Motion::ArcEnd,
            };
            let (start, behind) = all[at].span;
            let instruction = Instruction {
                end,
                motion,
                target,
                target_span: Span { start, end: behind },
                ..Instruction::at(self.here)
            };
            let modal = Modal {
                tool,
                frame,
                load,
                configured,
                wrist,
                guards,
                expected: 0,
                speed_zone,
            };
            self.emit_move(instruction, modal);
        }
        match led {
            Led::Alone | Led::Guided => {}
            Led::Search => {
                self.found(all, tool, frame);
                if self.stops(all) {
                    self.ends_elsewhere("a search that stops");
                }
            }
            Led::Contact => self.ends_elsewhere("a move that contact ends"),
            Led::Pressed => self.ends_elsewhere(FORCE),
        }
    }

    /// Whether a search stops at the signal.
    fn stops(&self, all: &[Argument]) -> bool {
        let is_stop = |argument: &Argument| {
            let spelling = argument.option.map(|name| self.resolved.spelling(name));
            let stops = ["Stop", "PStop", "SStop"];
            spelling.is_some_and(|of| stops.iter().any(|stop| of.eq_ignore_ascii_case(stop)))
        };
        all.iter().any(is_stop)
    }

    /// What ended here need not have come to its target: the next move begins anywhere.
    fn ends_elsewhere(&mut self, what: &str) {
        self.emit_call(Call {
            foreign: false,
            leads: true,
            ..Call::of(self.here, [].into(), what, 0..0)
        });
    }

    /// What has not run yet of the path before is dropped.
    pub(super) fn clear_path(&mut self) {
        self.ends_elsewhere("a path that is cleared");
    }

    /// The arm goes where forces lead it, from here on or no longer.
    pub(super) fn yields(&mut self, callee: Callee, begins: bool) {
        if begins {
            self.tell_corrected(callee);
        }
        self.ends_elsewhere(FORCE);
    }

    /// A search writes where the robot was when the signal came.
    fn found(&mut self, all: &[Argument], tool: Expr, frame: Expr) {
        let mut found = all.iter().filter(|argument| argument.option.is_none());
        if let Some(argument) = found.nth(1) {
            let actual = self.builder.script.held(Held::ActualWith { tool, frame });
            self.write_argument(argument, How::Whole(actual));
        }
    }

    /// The load of a move that is not that of its tool.
    fn carried(&mut self, argument: &Argument) -> Expr {
        let known = match argument.expression {
            Expression::Nothing => return Expr::Absent,
            // load0 stands for none: the tool's own counts
            Expression::Point {
                base: Base::Named { name, .. },
                ..
            } if self.resolved.spelling(name).eq_ignore_ascii_case("load0") => return Expr::Absent,
            Expression::Point {
                base: Base::Named { name, index: 0 },
                steps: (a, b),
            } if a == b => self.load(name),
            Expression::Load(leaves) => {
                let leaves = &self.resolved.parsed.leaves[indices(leaves)];
                let mass = leaves.first().and_then(|mass| mass.number());
                if mass.is_some_and(|mass| mass <= 0.0) {
                    return Expr::Absent;
                }
                load_of(leaves)
            }
            _ => None,
        };
        let Some(load) = known else {
            let message = "only the running program knows the load of this move, or it is not in \
                the files; that of the tool is taken";
            let hint = "write the load with numbers, in the move or in data that nothing writes";
            self.say(Remark::warning("load-chosen-at-run-time", message, hint));
            return Expr::Absent;
        };
        self.held_load(load)
    }

    fn tell(&mut self, parts: &Parts, callee: Callee, led: Led) {
        if parts.synchronised {
            let message = "this move runs together with one of another robot";
            let hint = "both robots' programs have to be compensated";
            self.say(Remark::note("sync-move", message, hint));
        }
        if let Some(option) = parts.corrected {
            self.tell_of_sensor(option);
        } else if matches!(led, Led::Guided | Led::Pressed) {
            self.tell_corrected(callee);
        }
    }

    /// An instruction goes where a sensor leads it.
    fn tell_corrected(&mut self, callee: Callee) {
        if let Callee::Named(name) = callee {
            self.tell_of_sensor(self.resolved.spelling(name));
        }
    }

    fn tell_of_sensor(&mut self, by: &str) {
        let message = format!(
            "a sensor corrects the path here ({by}): the targets are compensated, what the sensor \
             adds is not"
        );
        self.say(Remark::warning_about("corrected-by-sensor", message, ""));
    }

    /// An instruction that goes along a recorded path, or where a sensor says.
    pub(super) fn wander(&mut self, back: bool, end: u32) {
        let target = if back {
            Expr::Value(self.actual)
        } else {
            self.builder.script.unknown(Remark::warning(
                "computed-target",
                "a sensor tells where this instruction goes to; it stays as it is",
                "",
            ))
        };
        let instruction = Instruction {
            end,
            motion: Motion::Linear,
            target,
            ..Instruction::at(self.here)
        };
        self.emit_move(instruction, Modal::default());
    }

    /// Writes the data that an argument names, or a part of it.
    pub(super) fn write_argument(&mut self, argument: &Argument, how: How) {
        let (name, index, is_part) = match argument.expression {
            Expression::Point {
                base: Base::Named { name, index },
                steps: (a, b),
            } if a == b => (name, index, false),
            Expression::Member { name, index } => (name, index, true),
            _ => return,
        };
        let how = match how {
            How::Whole(_) if is_part => How::PartNumber(self.changed()),
            _ => how,
        };
        let index: Index = self.resolved.parsed.index(index);
        for variable in self.written(name, index) {
            let place = self.here;
            let how = how.clone();
            self.emit_write(place, variable, how);
        }
    }

    /// What a variable is a part of which the running program computes.
    pub(super) fn changed(&mut self) -> u32 {
        let remark = super::records::ASSIGNED;
        self.builder.script.remark(remark)
    }

    /// What a write of a name concerns.
    pub(super) fn written(&mut self, name: Symbol, index: Index) -> Vec<Written> {
        let resolved = self.resolved;
        let data = match resolved.meaning(name, self.context) {
            Meaning::Nothing => {
                if !self.wanted.contains_key(&name) {
                    return Vec::new();
                }
                let entity = Entity::Undeclared(name);
                let holds = self.undeclared(name);
                if matches!(holds, Expr::Value(_)) {
                    return vec![Written::One(self.variable(entity, 0, holds))];
                }
                if !self.is_one(entity, index) {
                    return vec![Written::AnyOf(self.table(entity))];
                }
                return match self.without_value(entity, index, holds) {
                    Expr::Variable(variable) => vec![Written::One(variable)],
                    _ => Vec::new(),
                };
            }
            Meaning::One(datum) => vec![datum],
            Meaning::Several(list) => resolved.several(list).to_vec(),
        };
        let several = data.len() > 1;
        let mut all = Vec::new();
        for datum in data {
            let entity = Entity::Declared(datum);
            let kind = resolved.datum(datum).kind;
            let (value, is_one) = if kind.is_target() {
                let value = self.position_of_datum(datum, index);
                (value, !several && self.is_one(entity, index))
            } else if kind.is_frame() && !several {
                (self.frame(name, Index::Whole), true)
            } else {
                continue;
            };
            match value {
                Expr::Variable(variable) if is_one => all.push(Written::One(variable)),
                Expr::Variable(_) | Expr::Any { .. } if resolved.is_written(entity) => {
                    all.push(Written::AnyOf(self.table(entity)));
                }
                _ => {}
            }
        }
        all
    }
}
