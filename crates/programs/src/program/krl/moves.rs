//! Moves: where they go, and with what.

use super::aggregate::{self, Aggregate, WHOLE};
use super::frames::State;
use super::names::DataKind;
use super::points::Point;
use super::reader::Reader;
use super::remarks::{FROM_NOWHERE, SOME_AXES, TURNED, carried};
use super::tokens::{Cursor, Kind, Read, Token, capitals};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, m_from_mm};
use crate::program::script::{
    Expr, Instruction, Modal, NOT_DISPLACED, Place, Remark, Turn, VariableId, short,
};
use crate::program::{
    Displacement, External, ExternalUse, Motion, Shape, Shift, SpeedZone, number,
};

/// How the robot goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Path {
    Joint,
    Linear,
    Spline,
    Arc,
}

/// A motion keyword in capitals, and whether the move is relative.
pub(super) fn motion(word: &[u8]) -> Option<(Path, bool)> {
    Some(match word {
        b"PTP" | b"SPTP" => (Path::Joint, false),
        b"LIN" | b"SLIN" => (Path::Linear, false),
        b"SPL" => (Path::Spline, false),
        b"CIRC" | b"SCIRC" => (Path::Arc, false),
        b"PTP_REL" | b"SPTP_REL" => (Path::Joint, true),
        b"LIN_REL" | b"SLIN_REL" => (Path::Linear, true),
        b"SPL_REL" => (Path::Spline, true),
        b"CIRC_REL" | b"SCIRC_REL" => (Path::Arc, true),
        _ => return None,
    })
}

/// What a move or a spline block sets for itself.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct With {
    tool: Option<Expr>,
    base: Option<Expr>,
    pub load: Option<Expr>,
    pub mode: Option<Expr>,
    pub orientation: Option<Expr>,
    /// By [`super::turning::Arc`].
    pub circles: [Option<Expr>; 3],
    /// External axes stand elsewhere than the target says.
    pub axes_off: Option<VariableId>,
}

impl With {
    /// What a move has that stands in a spline block.
    fn within(self, block: Self) -> Self {
        Self {
            tool: self.tool.or(block.tool),
            base: self.base.or(block.base),
            load: self.load.or(block.load),
            mode: self.mode.or(block.mode),
            orientation: self.orientation.or(block.orientation),
            circles: std::array::from_fn(|at| self.circles[at].or(block.circles[at])),
            axes_off: self.axes_off.or(block.axes_off),
        }
    }

    /// Whether it has a tool or base of its own.
    pub(super) fn has_frame(&self) -> bool {
        self.tool.is_some() || self.base.is_some()
    }
}

/// The orientation of a position in the base, for the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heading {
    /// A, B and C, 0.001 deg.
    angles: [f64; 3],
    tool: Expr,
    base: Expr,
}

/// Where the robot is, for moves relative to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Last {
    target: Expr,
    shift: Shift,
    /// What was added to each external axis.
    external: [Option<f64>; 6],
}

/// What stands behind the positions of a move.
#[derive(Clone, Copy, Debug, Default)]
struct Rest {
    with: With,
    speed_zone: SpeedZone,
    /// An arc goes on beyond its end, or stops short.
    has_angle: bool,
    /// A relative move goes along the axes of the tool (`#TOOL`), not of the base; nothing where it
    /// says something else.
    in_tool: Option<bool>,
    end: u32,
}

impl Reader {
    /// `LIN target C_DIS WITH ...`, `CIRC via, end, CA 90`
    pub(super) fn motion(&mut self, first: Token, path: Path, mut cursor: Cursor) -> Read<()> {
        if path == Path::Joint && cursor.blanks() == b'{' {
            let mut behind = cursor;
            if let Some(step) = Step::of_some_axes(&aggregate::read(&mut behind)?)
                && behind.blanks() != b':'
            {
                (self.last, self.heading, self.is_referred) = (None, None, false);
                let rest = self.rest(behind)?;
                self.turn(first, &step, &rest);
                return Ok(());
            }
        }
        let mut points = [self.point(&mut cursor)?; 2];
        let mut count = 1;
        if path == Path::Arc && cursor.take(b',') {
            points[1] = self.point(&mut cursor)?;
            count = 2;
        }
        let rest = self.rest(cursor)?;
        let (place, context) = (self.place(first), rest.with);
        self.last = None;
        let is_referred = std::mem::take(&mut self.is_referred);
        for (at, point) in points[..count].iter().enumerate() {
            if point.is_here {
                // to its joints a program goes before its first move
                self.stays.extend(point.is_pose.then_some(place));
                continue;
            }
            let is_via = path == Path::Arc && at == 0 && count == 2;
            let motion = match path {
                Path::Joint => Motion::Joint,
                Path::Linear => Motion::Linear,
                Path::Spline => Motion::Spline,
                Path::Arc if is_via => Motion::ArcVia,
                Path::Arc => Motion::ArcEnd,
            };
            let mut may_turn = false;
            if !is_via {
                let heading = self.heading_of(point, &rest.with);
                let before = std::mem::replace(&mut self.heading, heading);
                may_turn = before.is_none() || before != self.heading;
            }
            let mut modal = self.modal_of(place, motion, point.target, &rest, may_turn);
            let mut instruction = move_to(point.target, place, motion, &rest);
            instruction.displacement = point.displacement;
            if point.kind == DataKind::Frame {
                modal.configured = Expr::Absent;
            }
            if point.kind.lacks_axes() {
                // external axes stay where they stand
                let script = &mut self.builder.script;
                script.axes_stay.push(short(script.instructions.len()));
            }
            if point.is_plain && !rest.has_angle && !is_referred {
                instruction.target_span = point.span;
            }
            self.builder.go(instruction, modal);
            let plain = !context.has_frame();
            if !is_via && plain && !rest.has_angle && point.is_pose {
                self.last = self.shift_of(point).map(|shift| Last {
                    shift,
                    ..Last::at(point.target)
                });
            }
        }
        Ok(())
    }

    /// The orientation of a position; none where it is not known.
    fn heading_of(&self, point: &Point, with: &With) -> Option<Heading> {
        let with = with.within(self.spline);
        let [tool, base] = [(with.tool, State::Tool), (with.base, State::Base)].map(|(own, of)| {
            let own = own.unwrap_or(self.states.expr(of));
            // what chooses an entry may change before the next move
            matches!(own, Expr::Value(_) | Expr::Variable(_)).then_some(own)
        });
        let (tool, base) = (tool?, base?);
        let script = &self.builder.script;
        // a variable may be written
        let Expr::Target(target) = point.target else {
            return None;
        };
        let target = &script.targets[target];
        let numbers = &script.numbers[target.numbers.start as usize..target.numbers.end as usize];
        let angles = numbers
            .get(3..6)
            .filter(|_| target.layout.shape == Shape::Pose)?;
        let rounded = |at: usize| (angles[at].value * 1e3).round();
        (point.displacement == NOT_DISPLACED).then(|| Heading {
            angles: [0, 1, 2].map(rounded),
            tool,
            base,
        })
    }

    /// With what a move runs; `may_turn` as in [`Self::guards_of_pose`].
    fn modal_of(
        &mut self,
        place: Place,
        motion: Motion,
        target: Expr,
        rest: &Rest,
        may_turn: bool,
    ) -> Modal {
        let mut with = rest.with.within(self.spline);
        let is_joints = matches!(target, Expr::Target(target)
            if self.builder.script.targets[target].layout.shape == Shape::Joints);
        with.load = with.load.map(|load| self.watched(place, load).0);
        let guards = if is_joints {
            self.guards_of_axes(&with)
        } else {
            self.guards_of_pose(place, motion, &with, may_turn, rest.has_angle)
        };
        let state = |own: Option<Expr>, state| own.unwrap_or(self.states.expr(state));
        Modal {
            tool: state(with.tool, State::Tool),
            frame: state(with.base, State::Base),
            load: state(with.load, State::Load),
            configured: match motion {
                Motion::Joint => Expr::Value(self.states.on),
                _ => Expr::Absent,
            },
            wrist: match motion {
                Motion::Joint => Expr::Absent,
                _ => state(with.orientation, State::Orientation),
            },
            guards,
            speed_zone: rest.speed_zone,
            ..Modal::default()
        }
    }

    /// What stands behind the positions.
    fn rest(&mut self, mut cursor: Cursor) -> Read<Rest> {
        let mut rest = Rest {
            end: short(cursor.at),
            in_tool: Some(false),
            ..Rest::default()
        };
        // in a spline the robot does not stop
        rest.speed_zone.zone_m = (!self.in_spline).then_some(0.0);
        let mut before = b' ';
        loop {
            let token = cursor.next();
            if token.kind == Kind::End {
                return Ok(rest);
            }
            rest.end = token.end;
            if token.kind == Kind::Name {
                let mut buffer = [0; 24];
                match capitals(cursor.text(token), &mut buffer) {
                    word if before == b'#' => {
                        rest.in_tool = match word {
                            b"TOOL" => Some(true),
                            b"BASE" => Some(false),
                            _ => None,
                        };
                    }
                    b"C_DIS" | b"C_VEL" | b"C_ORI" | b"C_PTP" | b"C_SPL" => {
                        (rest.speed_zone.zone_m, rest.speed_zone.blends) = (None, true);
                    }
                    b"CA" if before == b',' => rest.has_angle = true,
                    b"WITH" => {
                        rest.with = self.with(&mut cursor, &mut rest.speed_zone)?;
                        rest.end = short(cursor.at);
                    }
                    _ => {}
                }
            }
            before = match token.kind {
                Kind::Sign(sign) => sign,
                _ => b' ',
            };
        }
    }

    /// What stands behind WITH.
    pub(super) fn with(&mut self, cursor: &mut Cursor, speed_zone: &mut SpeedZone) -> Read<With> {
        let mut with = With::default();
        loop {
            let name = cursor.next();
            cursor.brackets()?;
            let mut part = None;
            while cursor.take(b'.') {
                part = Some(cursor.next());
            }
            if name.kind != Kind::Name || !cursor.take(b'=') {
                return Ok(with);
            }
            let mut buffer = [0; 24];
            let word = capitals(cursor.text(name), &mut buffer);
            match (word, part) {
                (b"$TOOL", None) => with.tool = Some(self.state_value(State::Tool, cursor)?),
                (b"$BASE", None) => with.base = Some(self.state_value(State::Base, cursor)?),
                (b"$LOAD", None) => with.load = Some(self.state_value(State::Load, cursor)?),
                (b"$LOAD", Some(_)) => {
                    with.load = Some(self.unknown(carried()));
                    skip_value(cursor);
                }
                (b"$IPO_MODE", None) => with.mode = Some(self.state_value(State::Ipo, cursor)?),
                (b"$ORI_TYPE", None) => with.orientation = Some(self.orientation(cursor)),
                (b"$CIRC_TYPE" | b"$CIRC_MODE", _) => {
                    let set = self.circle(name, cursor);
                    let before = std::mem::take(&mut with.circles);
                    with.circles = std::array::from_fn(|at| set[at].or(before[at]));
                }
                (b"$EX_AX_IGNORE", None) => {
                    let start = cursor.at;
                    skip_value(cursor);
                    with.axes_off = self.ignored_axes(&cursor.bytes[start..cursor.at]);
                }
                (b"$TOOL", Some(_)) => {
                    with.tool = Some(self.chosen());
                    skip_value(cursor);
                }
                (b"$BASE", Some(_)) => {
                    with.base = Some(self.chosen());
                    skip_value(cursor);
                }
                (b"$VEL", _) => speed_zone.speed_m_s = speed(cursor, part)?,
                _ => skip_value(cursor),
            }
            // what is not understood hides nothing behind it
            if matches!(cursor.peek().kind, Kind::Sign(_)) {
                skip_value(cursor);
            }
            if !cursor.take(b',') {
                return Ok(with);
            }
        }
    }

    /// `LIN_REL {Z 100} #BASE`, `CIRC_REL via, end`, both from where the arc begins
    pub(super) fn relative(&mut self, first: Token, path: Path, mut cursor: Cursor) -> Read<()> {
        let last = self.last.take();
        (self.heading, self.is_referred) = (None, false);
        let mut steps = vec![Step::relative(&mut cursor)?];
        while path == Path::Arc && steps.len() < 2 && cursor.take(b',') {
            steps.push(Step::relative(&mut cursor)?);
        }
        let rest = self.rest(cursor)?;
        if let (Path::Joint, [Some(step)]) = (path, &steps[..])
            && let Way::Turned(_) = step.way
        {
            self.turn(first, step, &rest);
            return Ok(());
        }
        let place = self.place(first);
        let motions: &[Motion] = match path {
            Path::Joint => &[Motion::Joint],
            Path::Linear => &[Motion::Linear],
            Path::Spline => &[Motion::Spline],
            Path::Arc => &[Motion::ArcVia, Motion::ArcEnd],
        };
        let is_known = steps.len() == motions.len() && !rest.with.has_frame();
        for (at, motion) in motions.iter().enumerate() {
            let step = steps.get(at).and_then(Option::as_ref);
            let there = match (last, step, rest.in_tool) {
                (Some(last), Some(step), Some(in_tool)) if is_known => last.moved(step, in_tool),
                _ => None,
            };
            let is_from_target = there.is_some();
            // both points of a relative arc are from where it begins
            let step = step.filter(|_| is_known && motions.len() == 1);
            let target = self.unknown(FROM_NOWHERE);
            let there = there.or_else(|| Last::at(target).moved(step?, rest.in_tool?));
            let Some(mut there) = there else {
                let modal = self.modal_of(place, *motion, target, &rest, false);
                self.builder
                    .go(move_to(target, place, *motion, &rest), modal);
                continue;
            };
            if let Some(unknown) = self.axes_of_move(&there.external, true) {
                there.target = unknown;
            }
            let displacement = Displacement::By(Box::new(there.shift));
            let mut instruction = move_to(there.target, place, *motion, &rest);
            instruction.displacement = self.builder.script.displacement(displacement);
            let modal = self.modal_of(place, *motion, there.target, &rest, false);
            self.builder.go(instruction, modal);
            let is_end = *motion != Motion::ArcVia && !rest.has_angle;
            self.last = (is_end && is_from_target).then_some(there);
        }
        Ok(())
    }

    /// `PTP_REL {A1 5}`, `PTP {A1 -30}`: joints turn from where the robot is.
    fn turn(&mut self, first: Token, step: &Step, rest: &Rest) {
        let Way::Turned(turned) = step.way else {
            return;
        };
        let unknown = self.axes_of_move(&step.external, step.is_relative);
        let remark = if step.is_relative { TURNED } else { SOME_AXES };
        let target = unknown.unwrap_or_else(|| self.unknown(remark));
        let place = self.place(first);
        let mut instruction = move_to(target, place, Motion::Joint, rest);
        instruction.turned = unknown.is_none().then(|| Box::new(turned));
        let modal = self.modal_of(place, Motion::Joint, target, rest, false);
        self.builder.go(instruction, modal);
    }

    /// Where the next move takes external axes, or what it adds to them; why nobody knows where it
    /// goes, where the profile does not say what one carries.
    fn axes_of_move(&mut self, external: &[Option<f64>; 6], is_relative: bool) -> Option<Expr> {
        let at = short(self.builder.script.instructions.len());
        let mut unknown = None;
        for (name, value) in aggregate::driven(external) {
            let script = &mut self.builder.script;
            match self.external.meaning(name) {
                ExternalUse::Listed(axis) => {
                    let list = if is_relative {
                        &mut script.external_shifts
                    } else {
                        &mut script.externals_of_moves
                    };
                    list.push((at, External { axis, value }));
                }
                ExternalUse::Unknown if value != 0.0 => {
                    unknown = Some(script.unknown(Remark::external_unknown(name, value)));
                }
                _ => {}
            }
        }
        unknown
    }
}

/// What a move from where the robot is adds to that.
struct Step {
    way: Way,
    external: [Option<f64>; 6],
    is_relative: bool,
}

enum Way {
    /// Along the axes of base or tool, metres.
    Along([f64; 3]),
    Turned([Turn; 6]),
}

impl Step {
    /// `{A1 -30}`: the other axes stay where they are.
    fn of_some_axes(found: &Aggregate) -> Option<Self> {
        let is_some = found.is_axes() && found.has_axes != WHOLE;
        (is_some && found.has == 0 && !found.computed).then(|| Self {
            way: Way::Turned(turned(found, Turn::To)),
            external: found.external,
            is_relative: false,
        })
    }

    /// `{Z 100}`, `{A1 5}` of a relative move; `None` where only the running program knows it, or it
    /// turns the tool: turns are added to the angles, which is no motion of its own.
    fn relative(cursor: &mut Cursor) -> Read<Option<Self>> {
        if cursor.blanks() != b'{' {
            cursor.skip();
            return Ok(None);
        }
        let found = aggregate::read(cursor)?;
        let way = match (found.is_axes(), found.has) {
            _ if found.computed => return Ok(None),
            (true, 0) => Way::Turned(turned(&found, Turn::By)),
            (false, has) if has & !WHOLE == 0 && is_straight(&found) => {
                let part = |i: usize| match has & 1 << i {
                    0 => 0.0,
                    _ => m_from_mm(found.position[i].value),
                };
                Way::Along(std::array::from_fn(part))
            }
            _ => return Ok(None),
        };
        Ok(Some(Self {
            way,
            external: found.external,
            is_relative: true,
        }))
    }
}

/// Whether no angle of a relative move turns the tool.
fn is_straight(found: &Aggregate) -> bool {
    (3..6).all(|at| found.position[at].value == 0.0)
}

fn turned(found: &Aggregate, turn: fn(f64) -> Turn) -> [Turn; 6] {
    std::array::from_fn(|i| match found.has_axes & 1 << i {
        0 => Turn::Stays,
        _ => turn(found.axes[i].value * DEG),
    })
}

impl Last {
    fn at(target: Expr) -> Self {
        Self {
            target,
            shift: Shift::none(),
            external: [None; 6],
        }
    }

    /// Where the robot is behind a relative move.
    fn moved(mut self, step: &Step, in_tool: bool) -> Option<Self> {
        let Way::Along([x, y, z]) = step.way else {
            return None;
        };
        let Shift {
            in_frame,
            in_tool: of_tool,
        } = &mut self.shift;
        if in_tool {
            *of_tool = *of_tool * Pose::from_translation(x, y, z);
        } else {
            let [a, b, c] = in_frame.translation;
            in_frame.translation = [a + x, b + y, c + z];
        }
        for (sum, by) in self.external.iter_mut().zip(step.external) {
            *sum = by.map(|by| by + sum.unwrap_or(0.0)).or(*sum);
        }
        Some(self)
    }
}

/// The speed of `$VEL={CP 0.25}`, `$VEL.CP=0.25`, where it is a number.
fn speed(cursor: &mut Cursor, part: Option<Token>) -> Read<Option<f64>> {
    if cursor.blanks() == b'{' {
        let mut found = None;
        aggregate::each(cursor, |key, _, field| {
            if let (b"CP", aggregate::Field::Number(number)) = (key, field) {
                found = Some(number.value);
            }
            Ok(())
        })?;
        return Ok(found);
    }
    let is_path = part.is_some_and(|part| cursor.text(part).eq_ignore_ascii_case(b"CP"));
    let mut ahead = *cursor;
    let token = ahead.next();
    let found = number::parse(ahead.text(token)).filter(|_| is_path);
    skip_value(cursor);
    Ok(found)
}

/// Skips a value of WITH: up to a comma, or a word behind it such as `C_DIS`.
pub(super) fn skip_value(cursor: &mut Cursor) {
    let mut depth = 0_u32;
    let mut ends = false;
    loop {
        let before = cursor.at;
        let token = cursor.next();
        match token.kind {
            Kind::End => return,
            Kind::Sign(b',') if depth == 0 => {
                cursor.at = before;
                return;
            }
            Kind::Name | Kind::Number if depth == 0 && ends => {
                cursor.at = before;
                return;
            }
            Kind::Sign(b'(' | b'[' | b'{') => depth += 1,
            Kind::Sign(b')' | b']' | b'}') => {
                depth = depth.saturating_sub(1);
                ends = depth == 0;
            }
            Kind::Sign(_) => ends = false,
            _ => ends = true,
        }
    }
}

/// The words of a move.
fn move_to(target: Expr, place: Place, motion: Motion, rest: &Rest) -> Instruction {
    Instruction {
        end: rest.end,
        motion,
        target,
        ..Instruction::at(place)
    }
}
