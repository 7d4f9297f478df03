//! Whether bytes look like KRL, and where the marker goes.

use super::names::DataKind;
use super::statements::is_motion;
use super::tokens::{Cursor, Kind, capitals, lines};
use crate::program::kit::{comments, content_start, line_behind};
use crate::program::{Marker, Source};

/// Bytes that are looked at: enough for long comments in front.
const LOOKED_AT: usize = 1 << 16;

/// Whether the bytes look like KRL.
///
/// A header line such as `&ACCESS`, a data list, a declaration of a position or a move says so;
/// `DEF name(...)` alone is other languages' too, so something else of KRL's has to come with it.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    let bytes = &bytes[..bytes.len().min(LOOKED_AT)];
    if memchr::memchr(0, bytes).is_some() {
        return false;
    }
    let (mut defines, mut hints) = (false, false);
    for (start, end) in lines(bytes, content_start(bytes)) {
        let mut cursor = Cursor {
            bytes,
            at: start,
            end,
        };
        let mut buffer = [0; 24];
        if cursor.take(b'&') {
            let word = cursor.next();
            let word = capitals(cursor.text(word), &mut buffer);
            if matches!(
                word,
                b"ACCESS" | b"REL" | b"PARAM" | b"COMMENT" | b"USER" | b"KD"
            ) {
                return true;
            }
            continue;
        }
        if cursor.take(b';') {
            let word = cursor.next();
            let word = capitals(cursor.text(word), &mut buffer);
            hints |= matches!(word, b"FOLD" | b"ENDFOLD");
            continue;
        }
        let mut first = cursor.next();
        if cursor.text(first).eq_ignore_ascii_case(b"GLOBAL") {
            first = cursor.next();
        }
        if first.kind != Kind::Name {
            continue;
        }
        let text = cursor.text(first);
        let word = capitals(text, &mut buffer);
        let next = cursor.next();
        let behind = cursor.peek();
        match word {
            b"DEF" | b"DEFFCT" if next.kind == Kind::Name => {
                let text = bytes[start..end].trim_ascii();
                defines |= text.last() != Some(&b':') && text.contains(&b'(');
            }
            b"DECL" if next.kind == Kind::Name && behind.kind == Kind::Name => {
                let mut buffer = [0; 24];
                let word = capitals(cursor.text(next), &mut buffer);
                let kind = DataKind::named(word);
                if kind.is_place() || kind == DataKind::Fdat {
                    return true;
                }
                hints = true;
            }
            b"DEFDAT" | b"E6POS" | b"E6AXIS" if next.kind == Kind::Name => return true,
            b"BAS" if next.is(b'(') && behind.is(b'#') => return true,
            word if is_motion(word) && next.is(b'{') => return true,
            // another maker writes END in lower case
            b"END" | b"ENDFCT" if text[0] == b'E' && next.kind == Kind::End => hints = true,
            word if is_motion(word) && next.kind == Kind::Name => hints = true,
            b"$TOOL" | b"$BASE" | b"$OUT" | b"$ADVANCE" => hints = true,
            _ => {}
        }
        if defines && hints {
            return true;
        }
    }
    false
}

/// Whether a line begins with a word that lines of programs and data lists begin with.
pub(super) fn has_words(bytes: &[u8]) -> bool {
    lines(bytes, content_start(bytes)).any(|(at, end)| {
        let mut cursor = Cursor { bytes, at, end };
        if matches!(cursor.blanks(), b'&' | b'$') {
            return true;
        }
        let is_comment = cursor.take(b';');
        let word = cursor.next();
        let mut buffer = [0; 24];
        match capitals(cursor.text(word), &mut buffer) {
            b"FOLD" | b"ENDFOLD" => is_comment,
            b"DEF" | b"DEFFCT" | b"DEFDAT" | b"ENDDAT" | b"DECL" | b"GLOBAL" | b"EXT"
            | b"EXTFCT" | b"STRUC" | b"ENUM" | b"E6POS" | b"E6AXIS" | b"E3POS" | b"POS"
            | b"AXIS" | b"FRAME" => !is_comment,
            _ => false,
        }
    })
}

/// Where the marker goes, and its text: behind the line that opens the first routine or the data
/// list, else at the top.
pub(super) fn mark(source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
    let bytes = &source.bytes;
    let text = comments(source, marker, "; ");
    let top = content_start(bytes);
    let mut behind_header = top;
    for (start, stop) in lines(bytes, top) {
        let mut cursor = Cursor {
            bytes,
            at: start,
            end: stop,
        };
        if cursor.blanks() == b'&' {
            behind_header = line_behind(bytes, stop).unwrap_or(behind_header);
            continue;
        }
        let mut buffer = [0; 24];
        let mut word = cursor.next();
        if capitals(cursor.text(word), &mut buffer) == b"GLOBAL" {
            word = cursor.next();
        }
        let mut buffer = [0; 24];
        let opens = matches!(
            capitals(cursor.text(word), &mut buffer),
            b"DEF" | b"DEFFCT" | b"DEFDAT"
        );
        if opens && let Some(at) = line_behind(bytes, stop) {
            return (at, text);
        }
    }
    (behind_header, text)
}
