//! Moves: what goes where with what, and what can be said of it once all jobs are read.

use super::instruction::{Kind, Operand, is_move};
use super::job::{Coordinates, Header, Origin};
use super::lines::{Line, placed_words, words};
use super::rconf;
use super::reader::{Arc, Reader};
use super::remarks::Cause;
use super::variables::Variables;
use crate::geometry::units::MM;
use crate::program::script::{
    Expr, Instruction, Modal, Remark, Script, Span, Turn, VariableId, Written, short,
};
use crate::program::{Motion, Place, Shape, SpeedZone, TargetId, number};
use foldhash::{HashMap, HashMapExt, HashSet};

/// Tags that say how fast and how near to go.
const PLAIN: &[&[u8]] = &[
    b"V=", b"VJ=", b"VR=", b"VE=", b"PL=", b"CR=", b"ACC=", b"DEC=",
];

/// One move of a line.
struct Words<'a> {
    /// First byte.
    start: usize,
    verb: &'a [u8],
    kind: Kind,
    robot: Option<(Operand, Span)>,
    /// Names of positions of the base and of a station.
    base: Option<&'a [u8]>,
    station: Option<&'a [u8]>,
    /// Behind the last word that does no more than go to the position.
    end: usize,
    /// `UNTIL`: the robot may stop on its path.
    may_stop: bool,
    speed_zone: SpeedZone,
}

impl<'a> Words<'a> {
    fn of(start: usize, verb: &'a [u8], kind: Kind) -> Self {
        Self {
            start,
            verb,
            kind,
            robot: None,
            base: None,
            station: None,
            may_stop: false,
            end: start + verb.len(),
            speed_zone: SpeedZone::default(),
        }
    }

    /// The next word, at this byte.
    fn add(&mut self, at: usize, word: &'a [u8], is_plain: &mut bool) {
        let end = at + word.len();
        match word {
            [b'B', b'C' | b'P', ..] | [b'L', b'B', b'P', ..] => {
                self.base = self.base.or(Some(word));
            }
            [b'E', b'C' | b'X', ..] | [b'L', b'E', b'X', ..] => {
                self.station = self.station.or(Some(word));
            }
            _ => {}
        }
        self.may_stop |= word == b"UNTIL";
        let operand = Operand::of(word).filter(|_| self.robot.is_none());
        if let Some(operand) = operand {
            let span = Span::of(at..end);
            self.robot = Some((operand, span));
        }
        *is_plain &= operand.is_some() || PLAIN.iter().any(|tag| word.starts_with(tag));
        if *is_plain {
            self.end = end;
        }
        tag(word, &mut self.speed_zone);
    }
}

/// Speeds are in mm/s, as controllers are set up unless they are changed.
fn tag(word: &[u8], speed_zone: &mut SpeedZone) {
    let value = |tag: &[u8]| word.strip_prefix(tag).and_then(number::parse);
    match word {
        [b'V', b'=', ..] => speed_zone.speed_m_s = value(b"V=").map(|speed_mm_s| speed_mm_s * MM),
        [b'P', b'L', b'=', ..] => match value(b"PL=") {
            // positioning level 0 is exact
            Some(0.0) => speed_zone.zone_m = Some(0.0),
            Some(_) => speed_zone.blends = true,
            None => {}
        },
        [b'C', b'R', b'=', ..] => {
            speed_zone.zone_m = value(b"CR=").map(|radius_mm| radius_mm * MM);
        }
        _ => {}
    }
}

impl<'a> Reader<'a> {
    /// A line with one or more moves: `MOVL C00001 EC00001 V=100.0 +MOVJ EC00002`.
    pub(super) fn moves(&mut self, line: Line<'a>) {
        let mut searches = false;
        let mut coordinated = false;
        let mut found: Vec<Words> = Vec::with_capacity(1);
        let mut is_plain = true;
        for (at, word) in placed_words(line.text) {
            if word.starts_with(b"//") {
                break;
            }
            let at = line.start + at;
            searches |= word.starts_with(b"SRCH");
            if is_move(word) {
                let kind = match word.strip_prefix(b"+") {
                    None => Kind::of(word),
                    Some(_) if coordinated => Kind::Coordinated,
                    Some(_) => Kind::SecondRobot,
                };
                coordinated |= kind == Kind::Coordinated;
                is_plain = true;
                found.push(Words::of(at, word, kind));
            } else if let Some(last) = found.last_mut() {
                last.add(at, word, &mut is_plain);
            }
        }
        // axes that go along with the robot
        let base = found.iter().find_map(|words| words.base);
        let station = found.iter().find_map(|words| words.station);
        let is_arm_still = found.iter().all(|words| words.robot.is_none());
        let is_alone = found.iter().filter(|words| words.robot.is_some()).count() == 1;
        for (at, mut words) in found.into_iter().enumerate() {
            if searches {
                words.kind = Kind::Search;
            } else if words.kind == Kind::Coordinated
                && is_alone
                && station.is_some()
                && self.external_names.carries_every_frame
            {
                // relative to what carries the work piece anyway
                words.kind = Kind::of(&words.verb[1..]);
            }
            // a station or the base moves alone; else it is a form that is not known
            if words.robot.is_some() || (at == 0 && base.is_none() && station.is_none()) {
                self.go(&words, base, station);
            } else if is_arm_still && at == 0 {
                self.go_alone(&words, base, station);
            }
        }
        let mut behind = words(line.text).skip_while(|word| *word != b"TRAP");
        if let Some(label) = behind.nth(1) {
            self.trap(self.place(line.start), label);
        }
    }

    /// `MOVJ EC00002 VJ=5.00`: the robot stands where it is.
    fn go_alone(&mut self, words: &Words<'a>, base: Option<&'a [u8]>, station: Option<&'a [u8]>) {
        self.end_arc();
        let at = short(self.builder.script.instructions.len());
        for name in [base, station].into_iter().flatten() {
            // what positions behind it say of their own axes is said there
            self.external(name);
        }
        let script = &self.builder.script;
        if script
            .externals_of_moves
            .last()
            .is_some_and(|(of, _)| *of == at)
        {
            let instruction = Instruction {
                end: short(words.end),
                turned: Some(Box::new([Turn::Stays; 6])),
                ..Instruction::at(self.place(words.start))
            };
            let modal = Modal {
                speed_zone: words.speed_zone,
                ..Modal::default()
            };
            self.builder.go(instruction, modal);
        }
    }

    fn go(&mut self, words: &Words<'a>, base: Option<&'a [u8]>, station: Option<&'a [u8]>) {
        let kind = words.kind;
        if kind != Kind::Circular {
            self.end_arc();
        }
        let place = self.place(words.start);
        let mut instruction = Instruction {
            end: short(words.end),
            motion: self.motion(kind),
            coordinated: words.verb.starts_with(b"SMOV"),
            ..Instruction::at(place)
        };
        let mut modal = Modal {
            speed_zone: words.speed_zone,
            ..Modal::default()
        };
        instruction.target = match words.robot {
            _ if kind == Kind::Incremental => self.unknown(Cause::Incremental),
            None => self.unknown(Cause::OtherMove),
            Some((operand, span)) => {
                instruction.target_span = span;
                self.destination(operand, place)
            }
        };
        let target = self.targets_of(instruction.target).first().copied();
        if let Some(target) = target {
            let header = *self.positions.header(target);
            (modal.tool, modal.frame) = self.frames_of(target);
            self.begin(target, kind, &header, place);
        }
        if kind == Kind::Joint {
            modal.configured = Expr::Value(self.honoured);
        }
        let of = &self.variables;
        let mut reasons = vec![of.shift, of.axes, of.seam];
        if let Some(cause) = cause_of(kind) {
            reasons.push(self.variables.reason(&mut self.builder, cause));
        }
        if self.several_robots {
            reasons.push(
                self.variables
                    .reason(&mut self.builder, Cause::SeveralRobots),
            );
        }
        let is_free = target.is_some_and(|target| {
            let header = self.positions.header(target);
            let is_pose = header.coordinates() == Some(Coordinates::Rectangular);
            !is_pose || header.origin() == Origin::Robot
        });
        if self.here.is_relative && !is_free {
            reasons.push(self.variables.reason(&mut self.builder, Cause::Relative));
        }
        if let Some(target) = target {
            let header = self.positions.header(target);
            if header.coordinates() == Some(Coordinates::Rectangular) {
                reasons.extend(self.here.frames.against(header));
            }
        }
        for name in [base, station].into_iter().flatten() {
            let reason = self.external(name);
            reasons.extend(reason.filter(|_| !is_free));
        }
        modal.guards = self.variables.guards(&mut self.builder, &reasons);
        self.builder.go(instruction, modal);
        if words.may_stop {
            self.builder.stop(place);
        }
    }

    fn motion(&mut self, kind: Kind) -> Motion {
        match kind {
            Kind::Joint => Motion::Joint,
            Kind::Spline => Motion::Spline,
            Kind::Circular => {
                let arc = &mut self.here.arc;
                arc.points += 1;
                arc.last = self.builder.script.instructions.len();
                match arc.points {
                    1 => Motion::Linear,
                    n if n % 2 == 0 => Motion::ArcVia,
                    _ => Motion::ArcEnd,
                }
            }
            _ => Motion::Linear,
        }
    }

    /// A last point without another behind it is on an arc that the controller alone knows.
    pub(super) fn end_arc(&mut self) {
        let arc = std::mem::take(&mut self.here.arc);
        if let Arc { points: 2.., last } = arc
            && arc.points.is_multiple_of(2)
        {
            self.builder.script.instructions[last].motion = Motion::Spline;
        }
    }

    /// Where a move goes; what it may be is named.
    fn destination(&mut self, operand: Operand, place: Place) -> Expr {
        let found = match operand {
            Operand::C(number) => match self.target(number) {
                Some(target) => Expr::Target(target),
                None => self.unknown(Cause::NotInFiles),
            },
            Operand::AnyP => self.any_position(place),
            _ => match self.written_by(operand, place) {
                Some(Written::One(variable)) => Expr::Variable(variable),
                _ => self.unknown(Cause::Computed),
            },
        };
        for target in self.targets_of(found) {
            self.named[target] = true;
        }
        found
    }

    /// The targets that an expression is, or that its variable is declared with.
    pub(super) fn targets_of(&self, value: Expr) -> Vec<TargetId> {
        let script = &self.builder.script;
        match value {
            Expr::Target(target) => vec![target],
            Expr::Variable(variable) => {
                self.targets_of(script.variables[variable as usize].declared)
            }
            Expr::Any { first, end } => {
                let list = &script.lists[first as usize..end as usize];
                let targets = list.iter().map(|value| self.targets_of(*value));
                targets.flatten().collect()
            }
            _ => Vec::new(),
        }
    }

    /// What is to be said of the first move to a position of the files.
    fn begin(&mut self, target: TargetId, kind: Kind, header: &Header, place: Place) {
        let is_first = !std::mem::replace(&mut self.here.is_moving, true);
        if header.coordinates() != Some(Coordinates::Rectangular) {
            return;
        }
        let variant = self.positions.targets[target].layout.variant;
        if is_first && !rconf::tells_wrist(variant) {
            self.starts.push((self.routine(), place));
        }
        let is_mixed = header.variant != variant;
        if kind == Kind::Joint && is_mixed && !self.here.said_rconf {
            self.here.said_rconf = true;
            let message =
                "the post that wrote this job mixes the fields of RCONF up: it is not used";
            let hint = "check the configuration of the joint moves on the robot";
            self.say(place, Remark::warning("rconf-of-post", message, hint));
        }
    }

    // ---- when all jobs are read

    /// The script, with what can only be said at the end.
    pub(super) fn finish(mut self) -> Script {
        let Variables {
            shift, axes, seam, ..
        } = self.variables;
        for (never, variable) in [
            (!self.shifts, shift),
            (!self.shifts_axes, axes),
            (!self.tracks_seams, seam),
        ] {
            for set in &mut self.builder.script.guards {
                if never {
                    *set = set.iter().copied().filter(|one| *one != variable).collect();
                }
            }
        }
        self.settle_macros();
        self.settle_indexed();
        self.place_variables();
        self.follow_copies();
        for number in self.numbers.finish() {
            self.builder.script.loops[number].most = None;
        }
        self.finish_parts();
        self.finish_shifts();
        self.judge_positions();
        self.say_starts();
        self.say_copied();
        self.builder.script.targets = std::mem::take(&mut self.positions.targets);
        self.builder.script.numbers = std::mem::take(&mut self.positions.numbers);
        self.builder.finish()
    }

    /// Moves to variables that nothing writes go to what is declared.
    fn place_variables(&mut self) {
        let (written, all) = (&self.written, &self.all_written);
        if all.contains(&self.variables.positions) {
            return;
        }
        let script = &mut self.builder.script;
        for instruction in &mut script.instructions {
            if let Expr::Variable(variable) = instruction.target
                && !written.contains(&variable)
                && script.variables[variable as usize].routine.is_none()
            {
                instruction.target = script.variables[variable as usize].declared;
            }
        }
    }

    /// The tool and the work frame that the header above a target tells.
    pub(super) fn frames_of(&self, target: TargetId) -> (Expr, Expr) {
        self.variables.of_headers[self.positions.points[target].header as usize]
    }

    /// Tool and frame of moves to variables: those of the positions that are copied into them.
    fn follow_copies(&mut self) {
        let mut known: HashMap<VariableId, Option<(Expr, Expr)>> = HashMap::new();
        for at in 0..self.builder.script.instructions.len() {
            let Expr::Variable(variable) = self.builder.script.instructions[at].target else {
                continue;
            };
            let frames = *known.entry(variable).or_insert_with(|| {
                let mut all = self.poses_of(variable).into_iter();
                let first = self.frames_of(all.next()?);
                let same = all.all(|target| self.frames_of(target) == first);
                Some(if same {
                    first
                } else {
                    self.frames_of_copy(variable).map(Expr::Variable).into()
                })
            });
            if let Some(frames) = frames {
                let script = &mut self.builder.script;
                let (tool, frame) = frames;
                let of = script.modals[script.instructions[at].modal as usize];
                script.instructions[at].modal = script.modal(Modal { tool, frame, ..of });
            }
        }
    }

    /// The poses that a variable may be, by its declaration or copied into it.
    pub(super) fn poses_of(&self, variable: VariableId) -> Vec<TargetId> {
        let (mut seen, mut open) = (HashSet::from_iter([variable]), vec![variable]);
        let mut found = Vec::new();
        while let Some(variable) = open.pop() {
            let targets = self.targets_of(Expr::Variable(variable)).into_iter();
            let is_pose = |t: &TargetId| self.positions.targets[*t].layout.shape == Shape::Pose;
            found.extend(targets.filter(is_pose));
            for copied in self.copies.get(&variable).into_iter().flatten() {
                match *copied {
                    Expr::Variable(from) if seen.insert(from) => open.push(from),
                    Expr::Target(target) if is_pose(&target) => found.push(target),
                    _ => {}
                }
            }
        }
        found
    }
}

/// Why the position of a move of this kind has to stay.
fn cause_of(kind: Kind) -> Option<Cause> {
    match kind {
        Kind::Joint | Kind::Linear | Kind::Spline | Kind::Circular | Kind::Incremental => None,
        Kind::Coordinated => Some(Cause::Coordinated),
        Kind::Conveyor => Some(Cause::Conveyor),
        Kind::Search => Some(Cause::Search),
        Kind::SecondRobot => Some(Cause::SecondRobot),
        Kind::Other => Some(Cause::OtherMove),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_and_corner_are_tags_of_the_line() {
        let of = |text: &str| {
            let mut speed_zone = SpeedZone::default();
            for (_, word) in placed_words(text.as_bytes()) {
                tag(word, &mut speed_zone);
            }
            speed_zone
        };
        let exact = of("MOVL C00001 V=30.0 PL=0");
        assert_eq!((exact.speed_m_s, exact.zone_m), (Some(0.03), Some(0.0)));
        assert!(of("MOVJ C00001 VJ=5.00 PL=2").cuts_corner());
        assert_eq!(of("MOVJ C00001 VJ=5.00 V=I004"), SpeedZone::default());
        assert_eq!(of("MOVL C00001 V=5 CR=12.5").zone_m, Some(12.5 * MM));
    }
}
