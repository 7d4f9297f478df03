//! Numbers of position registers that a program has just written: `PR[9,1]=(-30)` to `PR[9,6]=0`,
//! then `UTOOL[9]=PR[9]`.

use super::words::{assigned, concerns_group_1, element, register, word_length};
use crate::geometry::Pose;
use crate::program::notation::pose_of_angles;
use crate::program::number;
use std::collections::BTreeMap;

/// Instructions behind which what was written is still there: neither branches nor calls, and they
/// write no other register.
const PLAIN: &[&[u8]] = &[
    b"R",
    b"DO",
    b"RO",
    b"GO",
    b"AO",
    b"UFRAME",
    b"UTOOL",
    b"UFRAME_NUM",
    b"UTOOL_NUM",
    b"MESSAGE",
    b"PAYLOAD",
    b"OVERRIDE",
    b"PAUSE",
];

/// The numbers of registers of group 1, from the last branch, label or call on.
#[derive(Debug, Default)]
pub(super) struct Constants {
    written: BTreeMap<u32, [Option<f64>; 6]>,
}

impl Constants {
    /// The pose of a register all of whose numbers are known.
    pub(super) fn pose(&self, register: u32) -> Option<Pose> {
        let mut values = [0.0; 6];
        for (value, known) in values.iter_mut().zip(self.written.get(&register)?) {
            *value = (*known)?;
        }
        Some(pose_of_angles(values))
    }

    /// Nothing is known any more.
    pub(super) fn clear(&mut self) {
        self.written.clear();
    }

    /// What is known behind an instruction that is no move.
    pub(super) fn follow(&mut self, text: &[u8]) {
        let (name, rest) = text.split_at(word_length(text));
        if text.starts_with(b"!") || text.starts_with(b"--") {
            return;
        }
        match (name, assigned(rest.trim_ascii_start())) {
            (b"PR", Some((index, _))) if !concerns_group_1(index) => {}
            (b"PR", Some((index, value))) => self.write(index, value),
            _ if PLAIN.contains(&name) => {}
            _ => self.clear(),
        }
    }

    fn write(&mut self, index: &[u8], value: &[u8]) {
        let of = register(index);
        let Some(number) = of.number else {
            return self.clear();
        };
        if !of.is_element {
            self.written.remove(&number);
            return;
        }
        let element = element(index).and_then(|element| (element as usize).checked_sub(1));
        let inside = value
            .strip_prefix(b"(")
            .and_then(|value| value.strip_suffix(b")"));
        let value = number::parse(inside.unwrap_or(value).trim_ascii());
        match element {
            // an axis besides the arm's
            Some(6..) => {}
            Some(element) => self.written.entry(number).or_default()[element] = value,
            None => _ = self.written.remove(&number),
        }
    }
}
