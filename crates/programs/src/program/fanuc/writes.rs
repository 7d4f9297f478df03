//! Writes of tools, frames, registers and points.

use super::content::canonical;
use super::controller::{Kind, Mode, Which, kinds};
use super::numbers::{MOST_NUMBER, of_position};
use super::reader::Reader;
use super::statements::{is_one_of, kind_of, selects};
use super::words::{
    Named, Register, behind_group, bracket_end, concerns_group_1, each_position, element, indexed,
    is_word, local, position, register, whole, word_length,
};
use crate::program::script::{Expr, How, VariableId, Written};

impl Reader<'_> {
    pub(super) fn write(&mut self, variable: Written, how: How) {
        let place = self.place;
        self.builder.write(place, variable, how);
    }

    pub(super) fn set(&mut self, variable: VariableId, value: Expr) {
        self.write(Written::One(variable), How::Whole(value));
    }

    /// An instruction that nobody knows may write the registers that it names.
    pub(super) fn lose_registers(&mut self, text: &[u8]) {
        let text = canonical(text);
        for at in memchr::memmem::find_iter(&text, b"R[") {
            let is_position = at.checked_sub(1).is_some_and(|before| text[before] == b'P');
            let inside = &text[at + 2..];
            let number = register(&inside[..bracket_end(inside).unwrap_or(0)]).number;
            let Some(number) = number.filter(|number| *number < MOST_NUMBER) else {
                continue;
            };
            if is_position {
                for element in 0..6 {
                    self.known.lose(of_position(number, element));
                }
            } else if at == 0 || !is_word(text[at - 1]) {
                self.known.lose(number);
            }
        }
    }

    pub(super) fn mode(&mut self, name: &[u8], rest: &[u8]) {
        let Some((mode, variable, holds)) = self.controller.mode(name, rest) else {
            return;
        };
        self.set(variable, holds);
        if mode == Mode::Search && holds != Expr::Absent {
            // what is found goes into the register
            let mut found = None;
            each_position(rest, |named| found = found.or(Some(named)));
            if let Some(Named::Register(Register {
                number: Some(number),
                ..
            })) = found
            {
                let register = self.register(number);
                self.set(register, Expr::Unknown(self.controller.computed));
                self.lose_registers(rest);
            }
        }
    }

    /// `UTOOL_NUM=5`
    pub(super) fn select(&mut self, which: Which, value: &[u8]) {
        for kind in kinds(which) {
            let value = match which {
                Some(_) => self.selection(which, value),
                None => Expr::Unknown(self.controller.chosen),
            };
            let of = self.controller.of(kind);
            let (selected, active) = (of.selected, of.active);
            self.set(selected, value);
            self.set(active, value);
        }
    }

    /// A number that selects a tool or frame: written out, or an argument of the program's call,
    /// `AR[1]`.
    pub(super) fn selection(&mut self, which: Which, text: &[u8]) -> Expr {
        if let Some(number) = whole(text) {
            return self
                .controller
                .number(&mut self.builder.script, which, number);
        }
        // what the program has just written into a register
        let written = self.known.entered(u32::MAX, &canonical(text), 0).exact();
        let is_number =
            |value: &f64| value.fract() == 0.0 && (0.0..=f64::from(u8::MAX)).contains(value);
        if let Some(number) = written.filter(is_number) {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let number = number as u32;
            return self
                .controller
                .number(&mut self.builder.script, which, number);
        }
        match text.strip_prefix(b"AR").and_then(indexed).flatten() {
            Some(number) => Expr::Variable(self.argument(self.listing.routine, number)),
            None => Expr::Unknown(self.controller.chosen),
        }
    }

    /// `NAME[index]=value`, for each of what registers in it that stand for numbers may be.
    pub(super) fn assign(&mut self, name: &[u8], index: &[u8], value: &[u8]) {
        if !is_one_of(name, "P PR LPR R LR UFRAME UTOOL") {
            return self.assign_one(name, index, value);
        }
        let mut instances = self.instances(index, value);
        if let [(index, value)] = &instances[..] {
            return self.assign_one(name, index, value);
        }
        let last = instances.pop();
        self.known.open();
        self.builder.begin_choice();
        for (index, value) in instances {
            self.builder.next_branch(false);
            self.assign_one(name, &index, &value);
            self.known.branch();
        }
        self.builder.next_branch(true);
        if let Some((index, value)) = last {
            self.assign_one(name, &index, &value);
        }
        self.builder.end_choice();
        self.known.close();
    }

    fn assign_one(&mut self, name: &[u8], index: &[u8], value: &[u8]) {
        let is_ours = concerns_group_1(index);
        match name {
            b"P" => self.set_point(index, value),
            b"PR" | b"LPR" | b"UFRAME" | b"UTOOL" if !is_ours => {}
            b"PR" => self.set_register(index, value),
            b"R" => self.set_number(index, value),
            b"LPR" => self.set_register(&of_program(index), value),
            b"LR" => self.set_number(&of_program(index), value),
            b"UFRAME" | b"UTOOL" => {
                self.set_frame(kind_of(name), whole(behind_group(index)), value);
            }
            b"$MNUTOOLNUM" | b"$MNUFRAMENUM" => {
                if whole(index).is_none_or(|group| group == 1) {
                    self.select(kind_of(&name[3..]), value);
                }
            }
            b"$MNUTOOL" | b"$MNUFRAME" => {
                let mut parts = index.split(|&b| b == b',').map(<[u8]>::trim_ascii);
                let group = parts.next().and_then(whole);
                if group.is_none_or(|group| group == 1) {
                    let number = parts.next().and_then(whole);
                    self.set_frame(kind_of(&name[3..]), number, value);
                }
            }
            _ => match selects(name) {
                Some(which) if is_ours => self.select(which, value),
                Some(_) => {}
                // a position goes into nothing else, in any dictionary
                None if is_whole_position(value) && !is_data(name) => {
                    self.set_frame(None, whole(index), value);
                }
                None => {}
            },
        }
    }

    /// `UFRAME[6]=PR[60]`; without a number a register says which.
    fn set_frame(&mut self, which: Which, number: Option<u32>, value: &[u8]) {
        let assigned = Expr::Unknown(self.controller.assigned);
        let source = match position(value) {
            Some((Named::Register(register), _)) => self.reads(register),
            _ => None,
        };
        for kind in kinds(which).filter(|_| number != Some(0)) {
            let Some(number) = number else {
                let others = self.controller.of(kind).others;
                self.write(Written::AnyOf(others), How::Whole(assigned));
                continue;
            };
            let script = &mut self.builder.script;
            let entry = self.controller.entry(script, kind, number);
            let written = source.filter(|_| which.is_some());
            let numbers = written.and_then(|register| self.known.pose(register));
            if let Some(pose) = numbers {
                let value = Expr::Value(script.frame(number.to_string(), Some(pose)));
                self.set(entry, value);
                continue;
            }
            // whether the register is known depends on the other programs, too
            if let Some(register) = written {
                self.from_registers.push((script.writes.len(), register));
            }
            let value = self.other_frame(value).unwrap_or(assigned);
            self.set(entry, value);
        }
    }

    /// `UTOOL[1]` as a value.
    pub(super) fn other_frame(&mut self, value: &[u8]) -> Option<Expr> {
        let (word, index) = value.split_at(word_length(value));
        let kind = match word {
            b"UTOOL" => Kind::Tool,
            b"UFRAME" => Kind::Frame,
            _ => return None,
        };
        let number = indexed(index)??;
        let entry = self
            .controller
            .entry(&mut self.builder.script, kind, number);
        Some(Expr::Variable(entry))
    }
}

/// The index of `LPR[4,3]`, as that of a register that other programs do not have; `?` where
/// another register says it.
fn of_program(index: &[u8]) -> Vec<u8> {
    let of = register(index);
    let number = of.number.and_then(local);
    let number = number.map_or("?".into(), |number| number.to_string());
    let element = of.is_element.then(|| element(index)).flatten();
    let element = element.map(|element| format!(",{element}"));
    let element = element.unwrap_or_else(|| if of.is_element { ",?" } else { "" }.into());
    (number + &element).into_bytes()
}

/// Whether a value is a position, and not one number of it.
fn is_whole_position(value: &[u8]) -> bool {
    position(value).is_some_and(|(named, _)| match named {
        Named::Register(register) => !register.is_element,
        Named::Point(_) | Named::AnyPoint => true,
        Named::Computed => false,
    })
}

/// Registers and signals.
fn is_data(name: &[u8]) -> bool {
    is_one_of(name, "R AR SR VR DO RO GO AO DI RI GI AI F M TIMER")
}
