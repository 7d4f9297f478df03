//! Moves: what goes where with what, and what can be said of it once all jobs are read.

use super::instruction::{Kind, Operand, is_move};
use super::job::{Coordinates, Header, Letter, Origin};
use super::lines::{Line, placed_words};
use super::rconf;
use super::reader::{Arc, Reader};
use super::remarks::Cause;
use crate::finding::Severity;
use crate::geometry::units::MM;
use crate::program::script::{Expr, Instruction, Script, Span, VariableId, Written, short};
use crate::program::{Motion, Pace, Shape, TargetId, number};
use std::collections::{HashMap, HashSet};

/// Tags that say how fast and how near to go.
const PLAIN: &[&[u8]] = &[
    b"V=", b"VJ=", b"VR=", b"VE=", b"PL=", b"CR=", b"ACC=", b"DEC=",
];

/// One move of a line.
struct Words<'a> {
    /// First byte.
    start: usize,
    kind: Kind,
    robot: Option<(Operand, Span)>,
    /// Names of positions of the base and of a station.
    base: Option<&'a [u8]>,
    station: Option<&'a [u8]>,
    /// Behind the last word that does no more than go to the position.
    end: usize,
    pace: Pace,
}

impl<'a> Words<'a> {
    fn of(start: usize, verb: &'a [u8], kind: Kind) -> Self {
        Self {
            start,
            kind,
            robot: None,
            base: None,
            station: None,
            end: start + verb.len(),
            pace: Pace::default(),
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
        let operand = Operand::of(word).filter(|_| self.robot.is_none());
        if let Some(operand) = operand {
            let span = Span {
                start: short(at),
                end: short(end),
            };
            self.robot = Some((operand, span));
        }
        *is_plain &= operand.is_some() || PLAIN.iter().any(|tag| word.starts_with(tag));
        if *is_plain {
            self.end = end;
        }
        tag(word, &mut self.pace);
    }
}

/// Speeds are in mm/s, as controllers are set up unless they are changed.
fn tag(word: &[u8], pace: &mut Pace) {
    let value = |tag: &[u8]| word.strip_prefix(tag).and_then(number::parse);
    match word {
        [b'V', b'=', ..] => pace.speed_m_s = value(b"V=").map(|speed_mm_s| speed_mm_s * MM),
        [b'P', b'L', b'=', ..] => match value(b"PL=") {
            // positioning level 0 is exact
            Some(0.0) => pace.zone_m = Some(0.0),
            Some(_) => pace.blends = true,
            None => {}
        },
        [b'C', b'R', b'=', ..] => {
            pace.zone_m = value(b"CR=").map(|radius_mm| radius_mm * MM);
        }
        _ => {}
    }
}

impl<'a> Reader<'a> {
    /// A line with one or more moves: `MOVL C00001 EC00001 V=100.0 +MOVJ EC00002`.
    pub fn moves(&mut self, line: Line<'a>) {
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
        for (at, mut words) in found.into_iter().enumerate() {
            if searches {
                words.kind = Kind::Search;
            }
            // a station or the base moves alone; else it is a form that is not known
            if words.robot.is_some() || (at == 0 && base.is_none() && station.is_none()) {
                self.go(&words, base, station);
            }
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
            pace: words.pace,
            ..Instruction::at(place)
        };
        let unknown = |reader: &mut Self, cause: Cause| {
            Expr::Unknown(reader.builder.script.remark(cause.remark()))
        };
        instruction.target = match words.robot {
            _ if kind == Kind::Incremental => unknown(self, Cause::Incremental),
            None => unknown(self, Cause::OtherMove),
            Some((operand, span)) => {
                instruction.target_span = span;
                self.destination(operand, place)
            }
        };
        let target = match instruction.target {
            Expr::Target(target) => Some(target),
            Expr::Variable(_) => match words.robot {
                Some((Operand::P(number), _)) => self.held(number),
                _ => None,
            },
            _ => None,
        };
        if let Some(target) = target {
            let header = *self.positions.header(target);
            (instruction.tool, instruction.frame) = self.variables.frames_of(&header);
            self.begin(target, kind, &header, instruction.place);
        }
        if kind == Kind::Joint {
            instruction.configured = Expr::Value(self.honoured);
        }
        let mut reasons = vec![self.variables.shift];
        if let Some(cause) = cause_of(kind) {
            reasons.push(self.variables.reason(&mut self.builder, cause));
        }
        let is_free = target.is_some_and(|target| {
            let header = self.positions.header(target);
            let is_pose = header.coordinates() == Some(Coordinates::Rectangular);
            !is_pose || header.origin() == Origin::Robot
        });
        if !is_free {
            for name in [base, station].into_iter().flatten() {
                reasons.extend(self.external(name));
            }
        }
        instruction.guards = self.variables.guards(&mut self.builder, &reasons);
        self.builder.go(instruction);
    }

    fn motion(&mut self, kind: Kind) -> Motion {
        match kind {
            Kind::Joint => Motion::Joint,
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

    /// The last point of an arc is its end.
    pub fn end_arc(&mut self) {
        let arc = std::mem::take(&mut self.here.arc);
        if let Arc { points: 2.., last } = arc {
            self.builder.script.instructions[last].motion = Motion::ArcEnd;
        }
    }

    /// Where a move goes; what it may be is named.
    fn destination(&mut self, operand: Operand, place: crate::program::Place) -> Expr {
        let mut unknown = |cause: Cause| {
            let remark = self.builder.script.remark(cause.remark());
            Expr::Unknown(remark)
        };
        match operand {
            Operand::AnyP | Operand::AnyLocal => unknown(Cause::Computed),
            Operand::C(number) => match self.target(Letter::C, number) {
                Some(target) => {
                    self.named[target] = true;
                    Expr::Target(target)
                }
                None => {
                    let remark = self.builder.script.remark(Cause::NotInFiles.remark());
                    Expr::Unknown(remark)
                }
            },
            Operand::P(_) | Operand::Local(_) => match self.written_by(operand, place) {
                Some(Written::One(variable)) => {
                    self.name(variable);
                    Expr::Variable(variable)
                }
                _ => Expr::Absent,
            },
        }
    }

    /// The targets that a variable is declared with.
    fn declared(&self, variable: VariableId) -> Vec<TargetId> {
        let script = &self.builder.script;
        let list = match script.variables[variable as usize].declared {
            Expr::Any { first, end } => script.lists[first as usize..end as usize].to_vec(),
            other => vec![other],
        };
        let target = |value: Expr| match value {
            Expr::Target(target) => Some(target),
            _ => None,
        };
        list.into_iter().filter_map(target).collect()
    }

    fn name(&mut self, variable: VariableId) {
        for target in self.declared(variable) {
            self.named[target] = true;
        }
    }

    /// A position of the files that a P variable of this number is.
    fn held(&mut self, number: u32) -> Option<TargetId> {
        let own = self.target(Letter::P, number);
        own.or_else(|| {
            let variable = self.variables.known(number)?;
            self.declared(variable).first().copied()
        })
    }

    /// What is to be said of the first move to a position of the files.
    fn begin(
        &mut self,
        target: TargetId,
        kind: Kind,
        header: &Header,
        place: crate::program::Place,
    ) {
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
            self.say(
                "rconf-of-post",
                Severity::Warning,
                place,
                message.into(),
                hint,
            );
        }
    }

    // ---- when all jobs are read

    /// The script, with what can only be said at the end.
    pub fn finish(mut self) -> Script {
        if !self.shifts {
            let shift = self.variables.shift;
            for set in &mut self.builder.script.guards {
                *set = set.iter().copied().filter(|one| *one != shift).collect();
            }
        }
        self.place_variables();
        self.follow_copies();
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
        if all.contains(&self.variables.all_positions) {
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

    /// Tool and frame of moves to variables: those of the positions that are copied into them.
    fn follow_copies(&mut self) {
        let mut known: HashMap<VariableId, Option<Vec<u32>>> = HashMap::new();
        for at in 0..self.builder.script.instructions.len() {
            let Expr::Variable(variable) = self.builder.script.instructions[at].target else {
                continue;
            };
            let headers = known
                .entry(variable)
                .or_insert_with(|| self.headers_of(variable));
            let Some(headers) = headers else {
                let remark = Cause::FrameCopied.remark();
                let unknown = Expr::Unknown(self.builder.script.remark(remark));
                self.builder.script.instructions[at].tool = unknown;
                continue;
            };
            if let [header, ..] = headers[..] {
                let header = &self.positions.headers[header as usize];
                let (tool, frame) = self.variables.frames_of(header);
                let instruction = &mut self.builder.script.instructions[at];
                (instruction.tool, instruction.frame) = (tool, frame);
            }
        }
    }

    /// The headers above the poses that a variable may be; none where these differ in tool or frame.
    fn headers_of(&self, variable: VariableId) -> Option<Vec<u32>> {
        let mut seen = HashSet::from([variable]);
        let mut open = vec![variable];
        let mut found: Vec<u32> = Vec::new();
        while let Some(variable) = open.pop() {
            for target in self.declared(variable) {
                if self.positions.targets[target].layout.shape == Shape::Pose {
                    found.push(self.positions.points[target].header);
                }
            }
            for from in self.copies.get(&variable).into_iter().flatten() {
                if seen.insert(*from) {
                    open.push(*from);
                }
            }
        }
        let of = |header: u32| {
            let header = &self.positions.headers[header as usize];
            (header.tool, header.origin())
        };
        found
            .windows(2)
            .all(|two| of(two[0]) == of(two[1]))
            .then_some(found)
    }
}

/// Why the position of a move of this kind has to stay.
fn cause_of(kind: Kind) -> Option<Cause> {
    match kind {
        Kind::Joint | Kind::Linear | Kind::Circular | Kind::Incremental => None,
        Kind::Coordinated => Some(Cause::Coordinated),
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
            let mut pace = Pace::default();
            for (_, word) in placed_words(text.as_bytes()) {
                tag(word, &mut pace);
            }
            pace
        };
        let exact = of("MOVL C00001 V=30.0 PL=0");
        assert_eq!((exact.speed_m_s, exact.zone_m), (Some(0.03), Some(0.0)));
        assert!(of("MOVJ C00001 VJ=5.00 PL=2").cuts_corner());
        assert_eq!(of("MOVJ C00001 VJ=5.00 V=I004"), Pace::default());
        assert_eq!(of("MOVL C00001 V=5 CR=12.5").zone_m, Some(12.5 * MM));
    }
}
