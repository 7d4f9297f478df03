//! Moves between those of a program: the instruction again, with a target written out.

use crate::program::insert::{DOES_MORE, Manner, starts_with_word};
use crate::program::quantity::is_letter;
use crate::program::{Program, Source, Target};

/// See [`crate::program::Language::insert`].
pub(super) const MANNER: Manner = Manner {
    forbids,
    external: Some(external),
    longest: usize::MAX,
    comment: b'!',
};

/// Instructions that do nothing but go to their target, or go on with their process on the way.
/// Others switch outputs, count distances or call procedures at their target, and would do so again
/// at each new one.
const REPEATED: &[&str] = &[
    "movej", "movel", "movec", "arcl", "arcc", "displ", "dispc", "paintl", "paintc",
];

/// Optional arguments that are of the whole move.
///
/// # Source
/// ABB, Technical reference manual RAPID Instructions, Functions and Data types, `MoveL`: `\\T` is
/// the total time of the move; in all tasks of `SyncMoveOn` moves have the same `\\ID`s, one after
/// another; `\\Conc` lets the program run on, over five moves at most.
const OF_WHOLE: [(&[u8], &str); 3] = [
    (b"t", "its argument \\T is the time of the whole move"),
    (
        b"id",
        "its argument \\ID is that of one move of the other robot",
    ),
    (
        b"conc",
        "with its argument \\Conc the program runs on before it ends",
    ),
];

/// Strings and comments do not stand in an instruction that only moves.
fn forbids(text: &[u8]) -> Option<&'static str> {
    let is_plain = text.ends_with(b";") && !text.contains(&b'!') && !text.contains(&b'"');
    if !is_plain || !starts_with_word(text, REPEATED) {
        return Some(DOES_MORE);
    }
    let options = memchr::memchr_iter(b'\\', text).map(|at| {
        let behind = text[at + 1..].trim_ascii_start();
        let length = behind.iter().take_while(|b| is_letter(**b)).count();
        &behind[..length]
    });
    let of_whole = |option| OF_WHOLE.iter().find(|of| of.0.eq_ignore_ascii_case(option));
    options.filter_map(of_whole).map(|of| of.1).next()
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
