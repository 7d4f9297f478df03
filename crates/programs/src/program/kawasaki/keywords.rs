//! Keywords, whole or cut short: `LM` and `LMOV` are `LMOVE`.
//!
//! # Source
//! Kawasaki AS Language Reference Manual, E series (90209-1022DED), appendix 5.

use crate::program::words::Words;

/// Keywords, and how many of their letters suffice.
const SHORT: &[(&[u8], usize)] = &[
    (b"ABOVE", 2),
    (b"ACCEL", 4),
    (b"ACCURACY", 4),
    (b"ALIGN", 2),
    (b"BASE", 2),
    (b"BELOW", 2),
    (b"C1MOVE", 2),
    (b"C2MOVE", 2),
    (b"CALL", 2),
    (b"DECEL", 4),
    (b"DELAY", 3),
    (b"DRAW", 3),
    (b"DRIVE", 3),
    (b"DWRIST", 2),
    (b"ELSE", 2),
    (b"END", 2),
    (b"EXTCALL", 2),
    (b"GOTO", 2),
    (b"HALT", 2),
    (b"HERE", 2),
    (b"HMOVE", 2),
    (b"HOME", 2),
    (b"IGNORE", 2),
    (b"JAPPRO", 2),
    (b"JDEPART", 2),
    (b"JMOVE", 2),
    (b"LAPPRO", 2),
    (b"LDEPART", 2),
    (b"LEFTY", 2),
    (b"LMOVE", 2),
    (b"PCEXECUTE", 4),
    (b"POINT", 2),
    (b"RETURN", 3),
    (b"RIGHTY", 2),
    (b"SCALL", 3),
    (b"SPEED", 2),
    (b"STABLE", 3),
    (b"STOP", 3),
    (b"TDRAW", 2),
    (b"UNTIL", 2),
    (b"UWRIST", 2),
    (b"WHILE", 2),
    (b"XMOVE", 1),
];

fn is_short(text: &[u8], keyword: &[u8]) -> bool {
    let begins = |part: &[u8]| part.eq_ignore_ascii_case(text);
    keyword.get(..text.len()).is_some_and(begins)
        && (SHORT.iter()).any(|(known, least)| *known == keyword && text.len() >= *least)
}

/// Whether a statement begins with a keyword; `po = 3` and `x[1] = 3` set a variable.
pub(super) fn begins_with(statement: Words, keyword: &[u8]) -> bool {
    let is_variable = || statement.is(1, b'=') || statement.is(1, b'[');
    statement.is_word(0, keyword)
        || statement.is_name(0) && is_short(statement.text(0), keyword) && !is_variable()
}

/// Where a statement has a keyword.
pub(super) fn find(statement: Words, keyword: &[u8]) -> Option<usize> {
    let short = |at: &usize| statement.is_name(*at) && is_short(statement.text(*at), keyword);
    let whole = statement.find(keyword);
    whole.or_else(|| (0..statement.len()).find(short))
}
