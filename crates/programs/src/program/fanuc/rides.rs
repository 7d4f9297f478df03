//! External axes of position registers: elements 7 to 9 are `E1` to `E3` of group 1.

use super::content::Entered;
use super::numbers::{OF_ARM, of_position};
use super::offsets::{Copied, EXTENDED, is_in};
use super::reader::Reader;
use crate::program::script::{How, Remark, short};
use crate::program::{External, ExternalUse};
use foldhash::HashSet;
use std::rc::Rc;

/// A move to registers, and what the program has just written into the numbers of other axes.
#[derive(Debug)]
pub(super) struct Riding {
    instruction: usize,
    registers: Vec<u32>,
    now: [Option<Rc<Entered>>; 3],
}

impl Reader<'_> {
    /// What `PR[4,7]=` makes of a register: the place of the arm is another one then. Axes that the
    /// profile lists are looked at where a move goes to the register.
    pub(super) fn axis_becomes(&mut self, at: u32, text: &[u8]) -> How {
        let name = EXTENDED[(at - OF_ARM) as usize];
        let value = self.known.entered(u32::MAX, text, 0).exact();
        let is_unknown = self.names.meaning(name) == ExternalUse::Unknown && value != Some(0.0);
        How::Axis(is_unknown.then(|| {
            let remark = Remark::external_unknown(name, value.unwrap_or(f64::NAN));
            self.builder.script.remark(remark)
        }))
    }

    /// A move that has just been read goes to one of these registers; to any where there are none.
    pub(super) fn goes_to_registers(&mut self, instruction: usize, registers: Vec<u32>) {
        let is_listed = |name: &&str| matches!(self.names.meaning(name), ExternalUse::Listed(_));
        if !EXTENDED.iter().any(is_listed) {
            return;
        }
        let now = match registers[..] {
            [one] => [6, 7, 8].map(|at| self.known.now(of_position(one, at))),
            _ => [None, None, None],
        };
        self.known.settle();
        self.rides.push(Riding {
            instruction,
            registers,
            now,
        });
    }

    /// Where external axes stand in moves to registers of which programs write these.
    pub(super) fn finish_rides(&mut self, copied: &Copied) {
        let rides = std::mem::take(&mut self.rides);
        for (at, name) in (OF_ARM..).zip(EXTENDED) {
            let ExternalUse::Listed(axis) = self.names.meaning(name) else {
                continue;
            };
            let written = self.known.axes.iter().filter(|(_, of)| *of == at);
            let written: HashSet<Option<u32>> = written.map(|(register, _)| *register).collect();
            let written = Copied::spread(copied.forms.iter().copied(), &written);
            for ride in &rides {
                let all = &ride.registers;
                let is_any = all.is_empty() && !written.is_empty();
                if !is_any && !all.iter().any(|one| is_in(&written, Some(*one))) {
                    continue;
                }
                let now = ride.now[(at - OF_ARM) as usize].as_deref();
                // as the point has it
                if now.is_some_and(Entered::is_of_point) {
                    continue;
                }
                let value = now.and_then(|now| self.known.value(now, None).exact());
                let value = value.unwrap_or(f64::NAN);
                let external = (short(ride.instruction), External { axis, value });
                self.builder.script.externals_of_moves.push(external);
            }
        }
    }
}
