//! Moves between those of a program: the instruction again, with a target written out.

use crate::program::insert::{Manner, starts_with_word};
use crate::program::{Program, Source, Target};

/// See [`crate::program::Language::insert`].
pub(super) const MANNER: Manner = Manner {
    repeats,
    external: Some(external),
    longest: usize::MAX,
};

/// Instructions that do nothing but go to their target, or go on with their process on the way.
/// Others switch outputs, count distances or call procedures at their target, and would do so again
/// at each new one.
const REPEATED: &[&str] = &[
    "movej", "movel", "movec", "arcl", "arcc", "displ", "dispc", "paintl", "paintc",
];

/// Strings and comments do not stand in an instruction that only moves.
fn repeats(text: &[u8]) -> bool {
    text.ends_with(b";")
        && !text.contains(&b'!')
        && !text.contains(&b'"')
        && starts_with_word(text, REPEATED)
}

/// External axes of a target, as they are written behind its other numbers.
fn external(sources: &[Source], program: &Program, target: &Target) -> Option<Vec<u8>> {
    let last = program.numbers_of(target).last()?;
    let start = last.start as usize + usize::from(last.length);
    let text = sources[target.file as usize]
        .bytes
        .get(start..target.end as usize)?;
    Some(text.to_vec())
}
