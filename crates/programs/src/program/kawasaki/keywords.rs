//! Keywords, whole or cut short: `LM` and `LMOV` are `LMOVE`.
//!
//! # Source
//! Kawasaki AS Language Reference Manual, E series (90209-1022DED), appendix 5.

use crate::program::words::Words;

/// Keywords, of which the letters in capitals suffice; the commonest first.
const KEYWORDS: &str = "LMove JMove SPeed ACCUracy JOINT LINEAR LIN2 CIR1 CIR2 POint TOOL BAse \
    IF ENd CAll HMove C1move C2move LAppro JAppro LDepart JDepart DRAw TDraw Xmove DRIve ALign \
    HOme HEre GOto ELse ELSEIF CASE SCASE VALUE SVALUE ANY WHile FOR DO UNtil RETurn RETURNE \
    STOp HAlt HSENSE SCAll EXtcall JUMP SJUMP PCEXecute ON ONI ONE IGnore MVWAIT DELay STAble ACCEl \
    DECEl LEfty RIghty ABove BElow UWrist DWrist WEight";

/// Whether a text is a keyword, in any case, cut short to its capitals at most.
fn is_short(text: &[u8], keyword: &str) -> bool {
    let begins = |part: &[u8]| part.eq_ignore_ascii_case(text);
    let capitals = keyword.bytes().filter(|b| !b.is_ascii_lowercase());
    keyword.as_bytes().get(..text.len()).is_some_and(begins) && text.len() >= capitals.count()
}

/// The keyword that a statement begins with, as [`KEYWORDS`] has it, or nothing; `po = 3` and
/// `x[1] = 3` set a variable.
pub(super) fn keyword(statement: Words) -> &'static str {
    let text = statement.text(0);
    if !statement.is_name(0) {
        return "";
    }
    let is_whole = |keyword: &&str| keyword.as_bytes().eq_ignore_ascii_case(text);
    let is_variable = statement.is(1, b'=') || statement.is(1, b'[');
    let is_cut = |keyword: &&str| !is_variable && is_short(text, keyword);
    let mut all = KEYWORDS.split_ascii_whitespace();
    let whole = all.clone().find(is_whole);
    whole.or_else(|| all.find(is_cut)).unwrap_or_default()
}

/// Where a statement has a keyword.
pub(super) fn find(statement: Words, keyword: &str) -> Option<usize> {
    let short = |at: &usize| statement.is_name(*at) && is_short(statement.text(*at), keyword);
    let whole = statement.find(keyword.as_bytes());
    whole.or_else(|| (0..statement.len()).find(short))
}
