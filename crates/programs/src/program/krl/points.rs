//! Positions as moves and assignments have them: numbers, a name, or a product of frames.

use super::aggregate;
use super::components::part_of;
use super::frames::{State, pose_of};
use super::names::{DataKind, Index};
use super::reader::Reader;
use super::remarks::{COMPUTED, COPIED, WITHOUT_AXES};
use super::states::inside;
use super::tokens::{Cursor, Kind, Read, capitals};
use crate::geometry::Pose;
use crate::geometry::units::MM;
use crate::program::displacing::Displacing;
use crate::program::names::Symbol;
use crate::program::numbers::parts;
use crate::program::quantity::Quantity;
use crate::program::script::{DisplacementId, Expr, Held, NOT_DISPLACED, Span, short};
use crate::program::{Displacement, Shape, Shift, TargetId};

/// A position as it is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub target: Expr,
    pub displacement: DisplacementId,
    /// Where the robot is: it stays there.
    pub is_here: bool,
    /// Numbers of its own or a name alone: another may stand in its place.
    pub is_plain: bool,
    /// It is a pose, as far as is known.
    pub is_pose: bool,
    /// Which parts it has: FRAME has no S and T, and no external axes, POS has no external axes.
    pub kind: DataKind,
    pub span: Span,
}

/// One part of a product of frames.
#[derive(Clone, Copy)]
enum Operand {
    Inline(TargetId),
    Named(Symbol, Index),
    /// What a function of the files returned.
    Returned(Expr, DataKind),
    /// Where the robot is, and whether that is asked as a pose.
    Here(bool),
    /// Where the robot was, and whether that is asked as a pose.
    Actual(bool),
    /// Of the controller, and no position of the robot.
    System,
    Other,
}

/// Whether a position ends here: a word such as `C_DIS` is none of it.
fn ends_operand(mut cursor: Cursor) -> bool {
    matches!(cursor.blanks(), 0 | b';' | b':' | b',' | b')' | b'}')
        || cursor.peek().kind == Kind::Name
}

impl Reader {
    pub(super) fn shift_of(&self, point: &Point) -> Option<Shift> {
        match self
            .builder
            .script
            .displacements
            .get(point.displacement as usize)?
        {
            Displacement::None => Some(Shift::along([0.0; 3])),
            _ => None,
        }
    }

    /// A position: numbers, a name, or a product of them.
    ///
    /// # Errors
    /// Where nothing stands there, or it is broken.
    pub(super) fn point(&mut self, cursor: &mut Cursor) -> Read<Point> {
        cursor.blanks();
        let start = short(cursor.at);
        let mut operands = [Operand::Other; 8];
        let mut count = 0;
        let mut mentions = false;
        loop {
            let operand = self.operand(cursor, &mut mentions)?;
            if let Some(slot) = operands.get_mut(count) {
                *slot = operand;
            }
            count += 1;
            if !cursor.take(b':') {
                break;
            }
        }
        let text = &cursor.bytes[start as usize..cursor.at];
        let end = start + short(text.trim_ascii_end().len());
        let mut point = Point {
            target: Expr::Absent,
            displacement: NOT_DISPLACED,
            is_here: false,
            is_plain: false,
            is_pose: false,
            kind: DataKind::Position,
            span: Span { start, end },
        };
        match operands.get(..count) {
            Some([one]) => {
                point.is_plain = true;
                self.one(*one, mentions, &mut point);
            }
            Some(many) => self.product(cursor.bytes, many, &mut point),
            None => point.target = self.computed(mentions),
        }
        Ok(point)
    }

    fn operand(&mut self, cursor: &mut Cursor, mentions: &mut bool) -> Read<Operand> {
        match cursor.blanks() {
            b'{' => {
                let start = cursor.at;
                let aggregate = aggregate::read(cursor)?;
                return Ok(Operand::Inline(self.add(
                    &aggregate,
                    start..cursor.at,
                    None,
                )));
            }
            0 | b';' => return Err(cursor.next().unexpected("a position")),
            _ => {}
        }
        let before = *cursor;
        let name = cursor.next();
        if name.kind == Kind::Name {
            let mut buffer = [0; 24];
            match capitals(cursor.text(name), &mut buffer) {
                word @ (b"$AXIS_ACT" | b"$POS_ACT" | b"$AXIS_ACT_MEAS" | b"$AXIS_ACT_MES"
                | b"$POS_ACT_MES") => {
                    cursor.brackets()?;
                    return Ok(if cursor.blanks() == b'.' {
                        cursor.skip();
                        Operand::Other
                    } else {
                        Operand::Here(word.starts_with(b"$POS"))
                    });
                }
                b"$NULLFRAME" => return Ok(Operand::System),
                word @ (b"$AXIS_INT" | b"$AXIS_RET" | b"$AXIS_BACK" | b"$AXIS_FOR"
                | b"$POS_INT" | b"$POS_RET" | b"$POS_BACK" | b"$POS_FOR") => {
                    cursor.brackets()?;
                    return Ok(Operand::Actual(word.starts_with(b"$POS")));
                }
                _ => {}
            }
            let at = cursor.brackets()?;
            let symbol = self.symbol(cursor, name);
            let (symbol, at) = self.member(symbol, at, cursor)?;
            if !matches!(cursor.blanks(), b'.' | b'(' | b'+' | b'-' | b'*' | b'/') {
                return Ok(Operand::Named(symbol, at));
            }
            let mut behind = *cursor;
            if inside(&mut behind).is_some() && ends_operand(behind) {
                *cursor = behind;
                if let Some((result, kind)) = self.returned(name) {
                    return Ok(Operand::Returned(result, kind));
                }
                *mentions |= self.mentions_position(before.part(before.at, behind.at));
                return Ok(Operand::Other);
            }
        }
        *cursor = before;
        cursor.skip();
        let inner = before.part(before.at, cursor.at);
        *mentions |= self.mentions_position(inner);
        let text = inner.bytes[inner.at..inner.end].trim_ascii();
        let is_system = text.starts_with(b"$");
        Ok(if is_system {
            Operand::System
        } else {
            Operand::Other
        })
    }

    /// A position of one part.
    fn one(&mut self, operand: Operand, mentions: bool, point: &mut Point) {
        point.target = match operand {
            Operand::Inline(target) => {
                let shape = self.builder.script.targets[target].layout.shape;
                point.is_pose = shape == Shape::Pose;
                Expr::Target(target)
            }
            Operand::Named(name, at) => {
                let kind = self.names.kind(name, self.context());
                point.is_pose = kind.is_some_and(DataKind::is_pose);
                point.kind = kind.unwrap_or(point.kind);
                match self.named(name, at) {
                    Some(found) => found,
                    None => self.not_in_files(name),
                }
            }
            Operand::Here(is_pose) => {
                (point.is_here, point.is_pose) = (true, is_pose);
                self.actual(is_pose)
            }
            Operand::Actual(is_pose) => self.actual(is_pose),
            Operand::Returned(value, kind) => {
                point.kind = kind;
                value
            }
            Operand::System | Operand::Other => self.computed(mentions),
        };
        point.is_plain &= matches!(operand, Operand::Inline(_) | Operand::Named(..));
    }

    fn actual(&mut self, is_pose: bool) -> Expr {
        let [tool, frame] = [State::Tool, State::Base].map(|of| self.states.expr(of));
        self.builder.script.held(if is_pose {
            Held::ActualWith { tool, frame }
        } else {
            Held::Actual
        })
    }

    /// A position that only the running program knows.
    pub(super) fn computed(&mut self, mentions: bool) -> Expr {
        let remark = if mentions { COPIED } else { COMPUTED };
        self.unknown(remark)
    }

    /// `a : b : c`: the one operand that is a position is the target, the others displace it.
    fn product(&mut self, bytes: &[u8], operands: &[Operand], point: &mut Point) {
        let context = self.context();
        let of_kind = |is_it: fn(DataKind) -> bool| {
            let is = |operand: &Operand| match *operand {
                Operand::Named(name, _) => self.names.kind(name, context).is_some_and(is_it),
                _ => false,
            };
            let all = (0..operands.len()).filter(|&at| is(&operands[at]));
            all.collect::<Vec<_>>()
        };
        let positions = of_kind(DataKind::is_position);
        let frames = of_kind(|kind| kind == DataKind::Frame);
        // a FRAME alone with numbers is a position as well
        let is_inline = |operand: &&Operand| matches!(operand, Operand::Inline(_));
        let inline = operands.iter().filter(is_inline).count();
        let displaced = match (positions.as_slice(), frames.as_slice()) {
            ([at], _) => Some(*at),
            ([], [at]) if inline + 1 == operands.len() => Some(*at),
            _ => self.displaced_one(operands, &positions),
        };
        let Some(at) = displaced else {
            point.target = self.computed(!positions.is_empty());
            return;
        };
        if let Some(Operand::Inline(last)) = operands[at + 1..].last()
            && self
                .builder
                .script
                .externals
                .last()
                .is_some_and(|(of, _)| of == last)
        {
            point.target = self.computed(true);
            return;
        }
        let before = self.constant_product(&operands[..at]);
        let behind = self.constant_product(&operands[at + 1..]);
        let exactly = before
            .zip(behind)
            .map(|(in_frame, in_tool)| Shift { in_frame, in_tool });
        if exactly.is_none() && positions.len() > 1 {
            point.target = self.computed(true);
            return;
        }
        let exactly = exactly.map(|shift| Displacement::By(Box::new(shift)));
        let displacement = exactly.or_else(|| self.amounts(bytes, operands, at));
        let others = (0..operands.len()).filter(|other| *other != at);
        let is_known = others
            .map(|other| operands[other])
            .any(|operand| self.is_of_text(operand));
        let displacement = displacement.unwrap_or(if is_known {
            Displacement::Unbounded
        } else {
            Displacement::Unknown
        });
        self.one(operands[at], false, point);
        // the last factor decides the type
        if at + 1 < operands.len() {
            point.kind = match operands.last() {
                Some(Operand::Returned(_, kind)) => *kind,
                _ => DataKind::Frame,
            };
        }
        point.displacement = self.builder.script.displacement(displacement);
    }

    /// Which of several positions the others displace, where these are declared CONST.
    fn displaced_one(&self, operands: &[Operand], positions: &[usize]) -> Option<usize> {
        let context = self.context();
        let mut others = positions.iter().filter(|&&at| match operands[at] {
            Operand::Named(name, _) => {
                let datum = self.names.datum(name, context);
                !datum.is_some_and(|datum| self.names.data[datum as usize].constant)
            }
            _ => true,
        });
        others.next().copied().filter(|_| others.next().is_none())
    }

    /// Whether a frame is one of the text, and not of the running robot or of files that are not
    /// here.
    fn is_of_text(&self, operand: Operand) -> bool {
        match operand {
            Operand::Inline(_) | Operand::Returned(..) | Operand::Other => true,
            Operand::Named(name, _) => {
                let datum = self.names.datum(name, self.context());
                let has_value = |datum| !self.names.values(datum, Index::Variable).is_empty();
                datum.is_some_and(has_value) || self.names.touched.contains(&name)
            }
            // where the robot is may be anywhere
            Operand::Here(_) | Operand::Actual(_) => true,
            Operand::System => false,
        }
    }

    /// The components of a frame that is written out with some left out, or with expressions.
    fn inline(&self, bytes: &[u8], frame: TargetId) -> Option<[Quantity; 6]> {
        let frame = &self.builder.script.targets[frame];
        let text = bytes.get(frame.span())?;
        let inside = text.strip_prefix(b"{")?.strip_suffix(b"}")?;
        let inside = inside.rsplit(|byte| *byte == b':').next()?;
        let mut amounts = [0.0; 6].map(Quantity::exactly);
        for part in parts(inside) {
            let part = part.trim_ascii();
            let (key, value) = part.split_at(part.iter().position(u8::is_ascii_whitespace)?);
            if let Some(at) = part_of(key) {
                amounts[usize::from(at)] = self.quantity(value.trim_ascii(), &mut |_| None);
            }
        }
        Some(amounts)
    }

    /// Likewise, of one frame whose X, Y and Z may be any of several numbers.
    fn amounts(&self, bytes: &[u8], operands: &[Operand], at: usize) -> Option<Displacement> {
        let [first, second] = operands else {
            return None;
        };
        let amounts = match if at == 0 { *second } else { *first } {
            Operand::Inline(frame) => self.inline(bytes, frame)?,
            Operand::Named(name, _) => self.components(name)?,
            _ => return None,
        };
        let [x, y, z, rotation @ ..] = amounts;
        let mut along = [x, y, z].map(|by| by.in_unit(MM));
        if rotation.iter().any(Quantity::is_sensed) {
            // a sensor that turns is judged as one that displaces
            along[0] = along[0].clone().plus(Quantity::unknown());
        }
        let exact = |angle: Quantity| {
            if angle.is_sensed() {
                Some(0.0)
            } else {
                angle.exact()
            }
        };
        let [a, b, c] = rotation.map(exact);
        let turned = pose_of([0.0, 0.0, 0.0, a?, b?, c?]);
        let mut by = Displacing::new();
        if at == 0 {
            let none = || Quantity::exactly(0.0);
            let [x, y, z] = along;
            by.in_tool(&[x, y, z, none(), none(), none()]);
            by.in_tool_exactly(turned);
        } else if turned.rotation.angle() == 0.0 {
            by.along_frame(&along);
        } else {
            return None;
        }
        Some(by.displacement())
    }

    fn constant_product(&mut self, operands: &[Operand]) -> Option<Pose> {
        let mut pose = Pose::identity();
        for operand in operands {
            pose = pose
                * match *operand {
                    Operand::Inline(target) => self.pose_in(target)?,
                    Operand::Named(name, at) => self.constant_frame(name, at)?,
                    _ => return None,
                };
        }
        Some(pose)
    }

    /// Whether what is given has none of the external axes that it is given to.
    pub(super) fn lacks_axes(&self, given: DataKind, to: DataKind) -> bool {
        to == DataKind::Position && given.lacks_axes() && !self.external.listed.is_empty()
    }

    /// What a variable of a kind is after an assignment.
    pub(super) fn value_of(&mut self, point: &Point, into: DataKind) -> Expr {
        if self.lacks_axes(point.kind, into) {
            return self.unknown(WITHOUT_AXES);
        }
        self.builder
            .script
            .displaced(point.target, point.displacement)
    }
}
