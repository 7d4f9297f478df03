//! Moves between those of a program: the instruction again, with a position written out.

use super::LONGEST_LINE;
use super::aggregate;
use super::tokens::Cursor;
use crate::program::insert::{Manner, starts_with_word};
use crate::program::{Program, Source, Target};

/// See [`crate::program::Language::insert`].
pub(super) const MANNER: Manner = Manner {
    repeats: |text| starts_with_word(text, REPEATED),
    external: Some(external),
    longest: LONGEST_LINE,
};

/// Moves whose path is given by their targets alone.
const REPEATED: &[&str] = &["PTP", "LIN", "CIRC", "SPTP", "SLIN", "SCIRC"];

/// Values of the external axes: one that is not given stands at zero.
fn external(sources: &[Source], _: &Program, target: &Target) -> Option<Vec<u8>> {
    let mut cursor = Cursor {
        bytes: &sources[target.file as usize].bytes,
        at: target.offset as usize,
        end: target.end as usize,
    };
    let axes = aggregate::read(&mut cursor).ok()?.external;
    let values = axes.map(|axis| axis.unwrap_or_default().to_le_bytes());
    Some(values.concat())
}
