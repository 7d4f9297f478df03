//! Moves: the letter, one or two positions, and the words behind them.

use super::controller::{Kind, Why, kinds};
use super::lines::Line;
use super::offsets::Axes;
use super::reader::Reader;
use super::words::{Named, outside, position, word_length};
use crate::geometry::units::MM;
use crate::program::script::{Expr, Instruction, Modal, Remark, Span, short};
use crate::program::{Motion, SpeedZone, number};
use std::ops::Range;

/// What stands behind the positions of a move.
#[derive(Debug, Default)]
#[allow(clippy::struct_excessive_bools)]
struct Words {
    /// By the first four of [`Why`].
    against: [bool; 4],
    /// `Offset`, `Tool_Offset`, `VOFFSET` and the like, each with its register.
    offsets: Vec<(Axes, Option<Range<usize>>)>,
    /// `Wjnt`
    wrist_joint: bool,
    /// `Skip`, `Search[…]`: the robot may stop on the way.
    may_stop: bool,
    speed_zone: SpeedZone,
    /// Nothing but how fast and how near to go.
    is_plain: bool,
    /// Nothing but that and offsets.
    is_harmless: bool,
    /// What happens at the end: calls, jumps, writes.
    then: Vec<Range<usize>>,
}

/// Where a move goes, with what.
pub(super) struct Goal {
    target: Expr,
    tool: Expr,
    frame: Expr,
    expected: u32,
    /// Tool and frame that are active once the robot is there.
    numbers: [Option<u32>; 2],
}

/// The row of arcs that `A` moves belong to.
#[derive(Debug)]
pub(super) struct Row {
    /// How many points it has.
    points: u32,
    /// The instructions of its last point, and of the one before that.
    last: Range<usize>,
    before: Range<usize>,
}

impl<'a> Reader<'a> {
    /// What stands behind a move's positions, from a byte of its text on: mostly the same as behind
    /// the last one.
    fn words(&mut self, text: &'a [u8], behind: usize) -> Words {
        let tail = &text[behind..];
        if let Some((_, speed_zone)) = self.plain_words.filter(|(known, _)| *known == tail) {
            return Words {
                speed_zone,
                is_plain: true,
                is_harmless: true,
                ..Words::default()
            };
        }
        let words = Words::of(text, behind);
        if words.is_only_plain() {
            self.plain_words = Some((tail, words.speed_zone));
        }
        words
    }

    /// A move; its position starts at `at` of its text.
    pub(super) fn go(&mut self, line: &Line, letter: u8, at: usize) {
        let text = &self.bytes[line.text.clone()];
        let start = line.text.start;
        let Some((first, length)) = position(&text[at..]) else {
            return;
        };
        let mut points = vec![(first, at..at + length)];
        let mut behind = at + length;
        let end = (letter == b'C').then(|| end_of_arc(text, behind)).flatten();
        // what stands behind the middle of an arc and in front of its end
        let mut middle = None;
        if let Some((end, span)) = end {
            middle = Some(Words::of(&text[..span.start], behind));
            behind = span.end;
            points.push((end, span));
        }
        let mut words = self.words(text, behind);
        let of_middle = middle.map(|middle| words.add(middle)).unwrap_or_default();
        words.against[Why::LineTracking as usize] = self.listing.tracks_line;
        let coordinated = words.against[Why::Coordinated as usize];
        words.against[Why::Coordinated as usize] &= !self.listing.is_carried;
        let is_arc = points.len() == 2;
        let is_row = !is_arc && b"AC".contains(&letter);
        let is_rewritable = line.is_closed && self.state.rounds() == 1;
        let is_repeatable = words.is_plain && (is_arc || b"JL".contains(&letter));
        let instruction = Instruction {
            end: short(line.text.end + usize::from(line.is_closed)),
            free_orientation: words.wrist_joint,
            coordinated,
            ..Instruction::at(self.place)
        };
        let modal = Modal {
            configured: if words.wrist_joint {
                Expr::Absent
            } else {
                Expr::Value(self.controller.honoured)
            },
            guards: self
                .controller
                .guards(&mut self.builder.script, words.against),
            speed_zone: words.speed_zone,
            ..Modal::default()
        };
        let listed = self.builder.script.instructions.len();
        let named: Vec<Named> = points.iter().map(|(named, _)| *named).collect();
        let mut last = listed;
        for (index, (named, span)) in points.into_iter().enumerate() {
            let motion = match (letter, is_arc, index) {
                (b'J', ..) => Motion::Joint,
                (_, true, 0) => Motion::ArcVia,
                (_, true, _) => Motion::ArcEnd,
                _ => Motion::Linear,
            };
            last = self.builder.script.instructions.len();
            let goals = self.goals(named, &text[span.clone()]);
            self.go_to(
                goals,
                &Instruction {
                    motion,
                    target_span: if is_rewritable {
                        Span::of(start + span.start..start + span.end)
                    } else {
                        Span::default()
                    },
                    does_more: !is_repeatable,
                    ..instruction.clone()
                },
                modal,
            );
        }
        self.row(is_row, listed);
        self.known.moves();
        let end = self.builder.script.instructions.len();
        // options behind the middle of an arc are its own, else those behind the end are of both
        let (all, of_first) = if of_middle.is_empty() {
            (listed..end, listed..listed)
        } else {
            (last..end, listed..last)
        };
        for (here, offsets) in [(of_first, of_middle), (all, words.offsets)] {
            if !offsets.is_empty() {
                let offsets = offsets.into_iter();
                let offsets = offsets.map(|(axes, at)| (axes, at.map(|at| &text[at])));
                self.displace(here, &offsets.collect::<Vec<_>>(), &named);
            }
        }
        // what else it does may write registers
        if !words.is_harmless {
            self.known.clear();
            self.known.open();
        }
        let (stops, others): (Vec<_>, Vec<_>) = words.then.into_iter().partition(|part| {
            // where the robot does not stop on its way the program goes to the label
            words.may_stop && !is_call(&text[part.clone()])
        });
        for part in others {
            // it is done some time before or behind the end of the move, or not at all
            self.builder.begin_if(None);
            self.then(&text[part]);
            self.builder.end_choice();
        }
        if words.may_stop {
            self.stop(text, stops);
        }
        if !words.is_harmless {
            self.known.close();
        }
    }

    /// `Skip,LBL[1],PR[5]=LPOS`: where the signal comes a register becomes where the robot is, which stops
    /// on its way, and the program goes on with the next line; else with the label, at the end
    /// of the move. `Search[…]` stops likewise.
    fn stop(&mut self, text: &'a [u8], parts: Vec<Range<usize>>) {
        let is_label = |part: &Range<usize>| {
            let text = &text[part.clone()];
            is_label(&text[..word_length(text)])
        };
        let (labels, writes): (Vec<_>, Vec<_>) = parts.into_iter().partition(is_label);
        for part in &labels {
            self.then(&text[part.clone()]);
        }
        // it stops a little behind where it was when the signal came
        for part in writes {
            self.then(&text[part]);
        }
        self.builder.stop(self.place);
    }

    /// What stands behind the positions of a move: a label, a write, the name of a program that is
    /// called.
    fn then(&mut self, text: &[u8]) {
        let word = &text[..word_length(text)];
        if is_label(word) {
            self.jump(&text[word.len()..], true);
        } else if text.contains(&b'=') {
            self.statement(text, 1);
        } else {
            self.call(text);
        }
    }

    /// The first point of a row is reached on a straight line. Three are an arc; of any other number the
    /// controller alone knows how one arc goes over into the next.
    fn row(&mut self, is_row: bool, listed: usize) {
        let here = listed..self.builder.script.instructions.len();
        let open = self.state.row.take();
        if !is_row {
            return;
        }
        let mut set = |range: &Range<usize>, motion| {
            for instruction in &mut self.builder.script.instructions[range.clone()] {
                instruction.motion = motion;
            }
        };
        let (points, last, before) = match open {
            Some(open) => (open.points + 1, open.last, open.before),
            None => (1, 0..0, 0..0),
        };
        match points {
            1 => {}
            2 => set(&here, Motion::Spline),
            3 => {
                set(&last, Motion::ArcVia);
                set(&here, Motion::ArcEnd);
            }
            _ => {
                for range in [&before, &last, &here] {
                    set(range, Motion::Spline);
                }
            }
        }
        self.state.row = Some(Row {
            points,
            last: here,
            before: last,
        });
    }

    /// Adds the move to each of the positions that may be meant.
    fn go_to(&mut self, goals: Vec<Goal>, instruction: &Instruction, modal: Modal) {
        let several = goals.len() > 1;
        if several {
            self.builder.begin_choice();
        }
        let count = goals.len();
        for (index, goal) in goals.into_iter().enumerate() {
            if several {
                self.builder.next_branch(index + 1 == count);
            }
            let instruction = Instruction {
                target: goal.target,
                ..instruction.clone()
            };
            let modal = Modal {
                tool: goal.tool,
                frame: goal.frame,
                expected: goal.expected,
                ..modal
            };
            self.builder.go(instruction, modal);
            if self.listing.uses_active {
                self.arrived(goal.numbers);
            }
        }
        if several {
            self.builder.end_choice();
        }
    }

    /// The controller goes to a point only where the numbers are selected that it was taught with.
    fn arrived(&mut self, numbers: [Option<u32>; 2]) {
        for (kind, number) in kinds(None).zip(numbers) {
            if let Some(number) = number {
                let script = &mut self.builder.script;
                let value = self.controller.number(script, Some(kind), number);
                self.set(self.controller.of(kind).active, value);
            }
        }
    }

    /// What a position of this text may mean; nothing where it is one of another robot.
    fn goals(&mut self, named: Named, text: &[u8]) -> Vec<Goal> {
        let target = match named {
            Named::Point(number) => match self.listing.by_number.get(&number) {
                Some(&index) => return self.point(index).into_iter().collect(),
                None => Expr::Unknown(self.controller.missing),
            },
            Named::AnyPoint => return self.any_point(text),
            Named::Register(register) => {
                let at = self.builder.script.instructions.len();
                if let Some(number) = self.reads(register) {
                    self.goes_to_registers(at, vec![number]);
                    Expr::Variable(self.register(number))
                } else if let Some(numbers) = self.meant_in(text).all() {
                    self.goes_to_registers(at, numbers.clone());
                    let all = numbers.into_iter().map(|number| {
                        self.read.insert(number);
                        Expr::Variable(self.register(number))
                    });
                    let all: Vec<Expr> = all.collect();
                    self.builder.script.any(all)
                } else {
                    self.goes_to_registers(at, Vec::new());
                    self.to_any_register.push(at);
                    Expr::Unknown(self.controller.computed)
                }
            }
            Named::Computed => Expr::Unknown(self.controller.computed),
        };
        vec![self.goal(target, None, None, false)]
    }

    fn point(&mut self, index: u32) -> Option<Goal> {
        let point = self.listing.points[index as usize];
        let message = match point.target {
            None => Some("the point has no group 1: it is one of another group and stays"),
            Some(_) => point.has_other_arm.then_some(
                "the point is one of another robot too: only its group 1 is corrected, what it has \
                 of the other stays",
            ),
        };
        if let Some(message) = message
            && !std::mem::replace(&mut self.listing.reported_group, true)
        {
            self.say(self.place, Remark::note("other-group", message, ""));
        }
        let target = point.target?;
        let twin = point
            .twin
            .and_then(|twin| self.listing.points[twin as usize].target);
        let target = match twin {
            None => Expr::Target(target),
            Some(twin) => {
                let both = [Expr::Target(twin), Expr::Target(target)];
                self.builder.script.any(both)
            }
        };
        Some(self.goal(target, point.tool, point.frame, point.is_joints))
    }

    pub(super) fn goal(
        &mut self,
        target: Expr,
        tool: Option<u32>,
        frame: Option<u32>,
        is_joints: bool,
    ) -> Goal {
        let script = &mut self.builder.script;
        // joint targets have no work frame
        let (own, taught) = if is_joints {
            (frame.or(Some(0)), None)
        } else {
            (frame, frame)
        };
        Goal {
            target,
            tool: self.controller.selected(script, Kind::Tool, tool),
            frame: self.controller.selected(script, Kind::Frame, own),
            expected: self.controller.expected(script, tool, taught),
            numbers: [tool, taught],
        }
    }
}

/// Whether something behind a move is the name of a program that is called.
fn is_call(text: &[u8]) -> bool {
    !text.contains(&b'=') && !is_label(&text[..word_length(text)])
}

fn is_label(word: &[u8]) -> bool {
    word.eq_ignore_ascii_case(b"LBL") || word.eq_ignore_ascii_case(b"LABEL")
}

impl Words {
    /// The words from a byte of a move's text on.
    fn of(text: &[u8], from: usize) -> Self {
        let mut words = Self {
            is_plain: true,
            is_harmless: true,
            ..Self::default()
        };
        let mut at = from;
        let mut is_called = false;
        while let Some(token) = token(text, at) {
            at = token.end;
            let text = &text[token.clone()];
            if std::mem::take(&mut is_called) {
                words.then.push(token);
                continue;
            }
            words.is_plain &= is_plain(text);
            if let Some((_, register @ None)) = words.offsets.last_mut()
                && matches!(position(text), Some((Named::Register(_), _)))
            {
                *register = Some(token);
                continue;
            }
            let axes = Axes::of(&text.to_ascii_uppercase());
            if let Some(axes) = axes {
                words.offsets.push((axes, None));
                continue;
            }
            words.is_harmless &= is_plain(text) || text.starts_with(b"VR[");
            is_called = !words.speed_zone_of(text) && words.take(text, token);
        }
        words
    }

    /// Whether it says how fast and how near to go, and nothing else.
    fn is_only_plain(&self) -> bool {
        let says_more = self.wrist_joint || self.may_stop || self.against.contains(&true);
        self.is_plain && !says_more && self.offsets.is_empty() && self.then.is_empty()
    }

    /// With what stands behind the middle of an arc, but for its offsets, which come back.
    fn add(&mut self, middle: Self) -> Vec<(Axes, Option<Range<usize>>)> {
        for (of, more) in self.against.iter_mut().zip(middle.against) {
            *of |= more;
        }
        self.wrist_joint |= middle.wrist_joint;
        self.may_stop |= middle.may_stop;
        self.is_plain &= middle.is_plain;
        self.is_harmless &= middle.is_harmless;
        self.then.extend(middle.then);
        middle.offsets
    }

    /// One word; whether the name of a program that is called follows.
    fn take(&mut self, text: &[u8], at: Range<usize>) -> bool {
        let word = text[..word_length(text)].to_ascii_uppercase();
        match word.as_slice() {
            b"INC" | b"INK" => self.against[Why::Incremental as usize] = true,
            b"RTCP" => self.against[Why::StationaryTool as usize] = true,
            b"COORD" | b"KOORD" => self.against[Why::Coordinated as usize] = true,
            b"WJNT" => self.wrist_joint = true,
            b"SKIP" | b"SEARCH" => self.may_stop = true,
            b"CALL" | b"AUFRUF" => return true,
            b"LBL" | b"LABEL" => self.then.push(at),
            _ if text.contains(&b'=') => self.then.push(at),
            _ => {}
        }
        false
    }

    /// Whether a word tells how fast or how near to go.
    fn speed_zone_of(&mut self, text: &[u8]) -> bool {
        let numbered = |prefix: &[u8]| text.strip_prefix(prefix).and_then(number::parse);
        if matches!(text, b"FINE" | b"FEIN") || numbered(b"CNT") == Some(0.0) {
            self.speed_zone.zone_m = Some(0.0);
        } else if let Some(radius_mm) = numbered(b"CR") {
            self.speed_zone.zone_m = Some(radius_mm * MM);
        } else if text.starts_with(b"CNT") {
            self.speed_zone.blends = true;
        } else if text[0].is_ascii_digit() {
            self.speed_zone.speed_m_s = self.speed_zone.speed_m_s.or(speed(text));
        } else {
            return false;
        }
        true
    }
}

/// The position at the end of an arc, and its bytes: the next word behind the middle, or the first
/// of the next line where options stand in between.
fn end_of_arc(text: &[u8], behind: usize) -> Option<(Named, Range<usize>)> {
    let mut from = behind;
    loop {
        let gap = text[from..].iter();
        let gap = gap.take_while(|b| b.is_ascii_whitespace() || **b == b':');
        let at = from + gap.count();
        // behind a comma the register of an offset stands
        let is_register = text[behind..from].trim_ascii_end().ends_with(b",");
        if let Some((end, length)) = position(&text[at..]).filter(|_| !is_register) {
            return Some((end, at..at + length));
        }
        from = at + memchr::memchr2(b'\n', b'\r', &text[at..])?;
    }
}

/// The next word: up to a blank or comma that stands outside brackets.
fn token(text: &[u8], from: usize) -> Option<Range<usize>> {
    let is_gap = |b: &u8| b.is_ascii_whitespace() || matches!(b, b',' | b':');
    let start = from + text[from..].iter().position(|b| !is_gap(b))?;
    let mut depth = 0_u32;
    let ends = |&(_, byte): &(usize, u8)| {
        match byte {
            b'(' => depth += 1,
            b')' => depth = depth.saturating_sub(1),
            _ => return depth == 0 && is_gap(&byte),
        }
        false
    };
    let end = outside(&text[start..]).find(ends);
    Some(start..end.map_or(text.len(), |(length, _)| start + length))
}

/// Whether a word behind the position says no more than how fast and how near to go.
fn is_plain(word: &[u8]) -> bool {
    let numbered = |prefix: &[u8]| {
        word.strip_prefix(prefix).is_some_and(|rest| {
            rest.is_empty() || rest.iter().all(u8::is_ascii_digit) || rest.starts_with(b"R[")
        })
    };
    // a time is that of the whole way
    let is_number = word[0].is_ascii_digit() || word.starts_with(b"R[");
    // behind the register, whose comment may be anything: `R[5:t/4]sec`
    let unit = word.rsplit(|b| *b == b']').next().unwrap_or(word);
    let is_rate = unit.ends_with(b"%") || unit.contains(&b'/');
    is_number && (is_rate || word.iter().all(u8::is_ascii_digit))
        || ["FINE", "CNT", "CR", "ACC", "PTH", "Wjnt", "MROT"]
            .iter()
            .any(|known| numbered(known.as_bytes()))
}

/// Metres a second of `250mm/sec`, `150cm/min`, `40inch/min`.
fn speed(word: &[u8]) -> Option<f64> {
    let is_number = |b: &&u8| b.is_ascii_digit() || **b == b'.';
    let digits = word.iter().take_while(is_number).count();
    let unit_m_s = match word[digits..].to_ascii_lowercase().as_slice() {
        b"mm/sec" | b"mm/sek" => MM,
        b"cm/min" => 0.01 / 60.0,
        b"inch/min" => 0.0254 / 60.0,
        _ => return None,
    };
    number::parse(&word[..digits]).map(|value| value * unit_m_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Words {
        Words::of(text.as_bytes(), 0)
    }

    #[test]
    fn speed_and_corner_stand_behind_the_points() {
        let fine = words("250mm/sec FINE").speed_zone;
        assert_eq!((fine.speed_m_s, fine.zone_m), (Some(0.25), Some(0.0)));
        let blended = words("150cm/min CNT50").speed_zone;
        assert!(blended.speed_m_s.is_some_and(|v| (v - 0.025).abs() < 1e-15));
        assert_eq!((blended.zone_m, blended.blends), (None, true));
        assert_eq!(words("100mm/sec CR10").speed_zone.zone_m, Some(10.0 * MM));
        let joint = words("50% CNT0").speed_zone;
        assert_eq!((joint.speed_m_s, joint.zone_m), (None, Some(0.0)));
    }

    #[test]
    fn only_what_says_no_more_than_speed_and_corner_is_plain() {
        for plain in ["250mm/sec CNT50", "20% FINE ACC80", "R[3: a b]% CNT0"] {
            assert!(words(plain).is_only_plain(), "{plain}");
        }
        for more in [
            "FINE Wjnt",
            "FINE INC",
            "FINE Skip,LBL[1]",
            "FINE Offset,PR[1]",
            "FINE RTCP",
        ] {
            assert!(
                !words(&format!("250mm/sec {more}")).is_only_plain(),
                "{more}"
            );
        }
        assert!(!words("250mm/sec FINE TB .10sec,CALL A").is_only_plain());
    }

    #[test]
    fn what_follows_a_point_is_reported() {
        let plain = words("R[25:INC Offset]mm/sec FINE ACC100 TB .10sec,CALL RTCP(1),LBL[3:COORD]");
        assert_eq!(plain.against, [false; 4]);
        assert!(plain.offsets.is_empty() && plain.then.len() == 2);
        for text in [
            "Tool_Offset,PR[2]",
            "Offset,PR[60:Corr]",
            "WKZ_Offset",
            "VOFFSET,VR[1]",
        ] {
            let found = words(&format!("9mm/sec FINE {text}"));
            assert!(found.offsets.len() == 1 && found.is_harmless, "{text}");
        }
        assert!(words("9mm/sec FINE INC").against[0]);
        assert!(words("9mm/sec FINE RTCP").against[1]);
        assert!(words("WELD_SPEED CNT100 COORD PTH").against[2]);
        assert!(words("9mm/sec FINE Wjnt").wrist_joint);
        assert!(words("9mm/sec FINE Skip,LBL[1],PR[2]=LPOS").may_stop);
        assert!(words("9mm/sec FINE ACC80 R[3: a b]%").is_plain);
        assert!(words("R[3:a/b]mm/sec FINE").is_plain);
        assert!(!words("9sec FINE").is_plain);
        assert!(!words("R[5:t/4]sec FINE").is_plain);
    }
}
