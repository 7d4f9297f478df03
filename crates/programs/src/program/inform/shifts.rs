//! Shifts of all moves (SFTON … SFTOF), as far as the text tells them.
//!
//! A shift along the axes of one frame displaces positions in that frame. Where the files have
//! positions that moves go to in others, the shift is not followed; nor is one that rotates. In which
//! coordinates a shift without a frame counts is *not verified on a controller*: it is followed where
//! the base is meant in any case.

use super::instruction::{Operand, numbered};
use super::job::{Coordinates, Origin};
use super::jumps::is_condition;
use super::lines::{Line, words};
use super::numbers::Amounts;
use super::reader::Reader;
use super::remarks::Cause;
use crate::geometry::units::MM;
use crate::program::Displacement;
use crate::program::displacing::Displacing;
use crate::program::quantity::Quantity;
use crate::program::script::{Expr, Held, How, NOT_DISPLACED, VariableId, Written};

/// Numbers in variables count in thousandths of a millimetre.
pub(super) const PER_MM: f64 = 1e3;

/// A shift that is switched on.
#[derive(Debug)]
pub(super) struct Shifted {
    write: usize,
    variable: VariableId,
    now: Amounts,
    /// The frame that it names.
    frame: Option<Origin>,
}

impl Reader<'_> {
    pub(super) fn shift(&mut self, line: Line, is_on: bool) {
        self.shifts |= is_on;
        let value = if is_on {
            self.note_shift(line);
            let remark = self.builder.script.remark(Cause::Shifted.remark());
            Held::Remark(remark)
        } else {
            Held::Shift(NOT_DISPLACED)
        };
        let value = Expr::Value(self.builder.script.value(value));
        let variable = self.variables.shift;
        self.write(line, Written::One(variable), How::Whole(value));
    }

    /// The arc corrects moves from COMARCON to COMARCOF.
    pub(super) fn track_seam(&mut self, line: Line, is_on: bool) {
        self.tracks_seams |= is_on;
        let value = if is_on {
            let script = &mut self.builder.script;
            let remark = script.remark(Cause::SeamTracked.remark());
            Expr::Value(script.value(Held::Remark(remark)))
        } else {
            Expr::Absent
        };
        let variable = self.variables.seam;
        self.write(line, Written::One(variable), How::Whole(value));
    }

    /// Notes what the next write switches on, until all jobs are read.
    fn note_shift(&mut self, line: Line) {
        let mut words = words(line.text).take_while(|word| !is_condition(word));
        let (first, second, third) = (words.next(), words.next(), words.next());
        let operand = second.and_then(Operand::of);
        let frame = match third {
            None => None,
            Some(b"BF") => Some(Origin::Base),
            Some(b"RF") => Some(Origin::Robot),
            Some(word) => match numbered(word, b"UF#") {
                Some(number) => Some(Origin::User(number)),
                None => return,
            },
        };
        let place = self.place(line.start);
        let written = operand.map(|operand| self.written_by(operand, place));
        let Some(Some(Written::One(variable))) = written.filter(|_| first == Some(b"SFTON")) else {
            return;
        };
        let now = self.numbers.position_now(variable);
        self.shifted.push(Shifted {
            write: self.builder.script.writes.len(),
            variable,
            now,
            frame,
        });
    }

    // ---- when all jobs are read

    /// Shifts that the text tells are no more than that.
    pub(super) fn finish_shifts(&mut self) {
        for shifted in std::mem::take(&mut self.shifted) {
            if !self.is_in_its_frame(&shifted) {
                continue;
            }
            let by = self.displacing(shifted.variable, &shifted.now, 1.0);
            if let Some(by @ (Displacement::None | Displacement::By(_) | Displacement::Within(_))) =
                by
            {
                let script = &mut self.builder.script;
                let by = script.displacement(by);
                let value = script.value(Held::Shift(by));
                script.writes[shifted.write].how = How::Whole(Expr::Value(value));
            }
        }
    }

    /// Whether all positions that moves go to are in the frame of a shift.
    fn is_in_its_frame(&self, shifted: &Shifted) -> bool {
        // without axes of a base both stand still
        let is_still = self.external_names.listed.is_empty();
        let one = |origin| match origin {
            Origin::Robot if is_still => Origin::Base,
            other => other,
        };
        let declared = self.targets_of(Expr::Variable(shifted.variable));
        let own = match declared[..] {
            [one] => Some(self.positions.header(one).origin()),
            _ => None,
        };
        let frame = match shifted.frame.or(own).map(one) {
            Some(frame) if shifted.frame.is_some() || frame == Origin::Base => frame,
            _ => return false,
        };
        let named = (0..self.named.len()).filter(|target| self.named[*target]);
        let copied = self.copies.values().flatten();
        let copied = copied.flat_map(|value| self.targets_of(*value));
        let mut headers = named
            .chain(copied)
            .map(|target| self.positions.header(target));
        headers.all(|header| {
            header.coordinates() != Some(Coordinates::Rectangular) || one(header.origin()) == frame
        })
    }

    /// What the numbers of a position, that nothing rewrites, displace another by; `None` where that
    /// is not followed.
    pub(super) fn displacing(
        &mut self,
        variable: VariableId,
        now: &Amounts,
        sign: f64,
    ) -> Option<Displacement> {
        let targets = self.targets_of(Expr::Variable(variable));
        let mut copies = self.copies.values();
        let is_copied = copies.any(|from| from.contains(&Expr::Variable(variable)));
        if is_copied || targets.iter().any(|target| self.named[*target]) {
            return None;
        }
        let [x, y, z, angles @ ..] = self.numbers.amounts(variable, now);
        let is_unknown = angles.iter().any(Quantity::is_sensed);
        let is_still = |of: &Quantity| of.exact() == Some(0.0) || of.is_sensed();
        let along = [x, y, z].map(|of| of.in_unit(1.0 / PER_MM).in_unit(sign * MM));
        if !angles.iter().all(is_still) || along.iter().any(Quantity::is_endless) {
            return None;
        }
        let mut by = Displacing::new();
        by.along_frame(&along);
        if is_unknown {
            let none = || Quantity::exactly(0.0);
            by.along_frame(&[Quantity::unknown(), none(), none()]);
        }
        Some(by.displacement())
    }
}
