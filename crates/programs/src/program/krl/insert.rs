//! Moves between those of a program: the instruction again, with a position written out.

use super::LONGEST_LINE;
use super::aggregate;
use super::tokens::Cursor;
use crate::program::insert::{DOES_MORE, Manner, starts_with_word};
use crate::program::{Program, Source, Target};

/// See [`crate::program::Language::insert`].
pub(super) const MANNER: Manner = Manner {
    forbids: |text| (!starts_with_word(text, REPEATED)).then_some(DOES_MORE),
    external: Some(external),
    longest: LONGEST_LINE,
    comment: b';',
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

/// Lines above a move that its inline form may begin in.
const MOST_LINES: usize = 200;

/// Whether a line stands between `;FOLD …;%{PE}…` and its `;ENDFOLD`: an inline form, whose lines
/// the pendant writes again.
pub(super) fn is_in_form(bytes: &[u8], at: usize) -> bool {
    let mut open = 0_u32;
    let lines = bytes[..at].rsplit(|b| matches!(b, b'\n' | b'\r'));
    for line in lines.skip(1).take(MOST_LINES) {
        let Some(words) = line.trim_ascii_start().strip_prefix(b";") else {
            continue;
        };
        if starts_with_word(words, &["ENDFOLD"]) {
            open += 1;
        } else if starts_with_word(words, &["FOLD"]) {
            if open == 0 && memchr::memmem::find(line, b"%{PE}").is_some() {
                return true;
            }
            open = open.saturating_sub(1);
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_are_folds_of_the_pendant_whatever_folds_are_in_them() {
        let text =
            b"DEF m()\nLIN XP1 ;none\n;FOLD LIN P1 CONT Vel=2 m/s;%{PE}%R 8.3\n;FOLD Parameters \
            ;%{h}\n;ENDFOLD\nLIN XP2 ;in\n;ENDFOLD\n;FOLD mine\nLIN XP3 ;own\n;ENDFOLD\nEND\n";
        for (mark, is_in) in [(";none", false), (";in", true), (";own", false)] {
            let at = memchr::memmem::find(text, mark.as_bytes()).expect("it stands there");
            assert_eq!(is_in_form(text, at), is_in, "{mark}");
        }
    }
}
