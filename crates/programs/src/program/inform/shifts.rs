//! Shifts of all moves (SFTON … SFTOF), as far as the text tells them.
//!
//! A shift along the axes of one frame displaces positions in that frame. Where the files have
//! positions that moves go to in others, the shift is not followed; nor is one that rotates. In which
//! coordinates a shift without a frame counts is *not verified on a controller*: it is followed where
//! the base is meant in any case.

use super::instruction::{Operand, numbered};
use super::job::{Coordinates, Origin, external};
use super::jumps::is_condition;
use super::lines::{Line, words};
use super::numbers::Amounts;
use super::reader::Reader;
use super::remarks::Cause;
use crate::geometry::units::MM;
use crate::program::displacing::Displacing;
use crate::program::quantity::Quantity;
use crate::program::script::{Expr, Held, How, NOT_DISPLACED, VariableId, Written};
use crate::program::{Displacement, ExternalUse};

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

/// Whether a word is a variable with the axes of a base or a station.
fn is_axes(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"L").unwrap_or(word);
    word.starts_with(b"BP") || word.starts_with(b"EX")
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
        let axes = self.axes_shifted(line).filter(|_| is_on);
        let axes = axes.filter(|by| *by != [0.0; 6]);
        self.shifts_axes |= axes.is_some();
        let axes = axes.map(|by| Held::ExternalOffset(Box::new(by)));
        let value = axes.map_or(Expr::Absent, |axes| self.builder.script.held(axes));
        let variable = self.variables.axes;
        self.write(line, Written::One(variable), How::Whole(value));
    }

    /// By what a shift shifts the axes of the base and of a station, `SFTON P000 BP000 EX000 BF`, in the
    /// order of the language; `None` where that is not known.
    fn axes_shifted(&self, line: Line) -> Option<[f64; 6]> {
        let known = &self.positions.jobs[self.here.job].external;
        let named = words(line.text).skip(2);
        let mut by = [0.0; 6];
        for name in named.take_while(|word| !is_condition(word)) {
            if !is_axes(name) {
                continue;
            }
            let named = external(name).filter(|named| !self.is_written_external(*named))?;
            let moved = known.get(&named)?;
            let counts = moved.coordinates == Some(Coordinates::Pulses);
            let of_station = name.starts_with(b"E");
            for (n, value) in moved.values.iter().enumerate() {
                let letters = if of_station { "EC" } else { "BC" };
                match self.external_names.meaning(&format!("{letters}{}", n + 1)) {
                    ExternalUse::Listed(axis) => {
                        let value = value / self.pulses_of(axis, counts);
                        let at = n + if of_station { 3 } else { 0 };
                        *by.get_mut(at)? = Some(value).filter(|value| value.is_finite())?;
                    }
                    ExternalUse::Unknown if *value != 0.0 => return None,
                    _ => {}
                }
            }
        }
        Some(by)
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
        let (first, second) = (words.next(), words.next());
        let third = words.find(|word| !is_axes(word));
        if self.axes_shifted(line).is_none() {
            return;
        }
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
        let sources = self.numbers.sources(variable);
        let is_rewritten = sources.iter().any(|source| {
            let others = self.copies.iter().filter(|(to, _)| !sources.contains(to));
            let mut copies = others.map(|(_, from)| from);
            let mut poses = self.poses_of(*source).into_iter();
            copies.any(|from| from.contains(&Expr::Variable(*source)))
                || poses.any(|target| self.named[target])
        });
        if is_rewritten {
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
