//! Whether bytes look like RAPID, and where the marker goes.

use super::syntax::Type;
use super::tokens::{Kind, Scanner, Token};
use super::verbs;
use crate::program::kit::{comments, line_behind};
use crate::program::{Marker, Source};

/// Tokens that are looked at: enough for long headers.
const TOKENS: usize = 4000;

/// Words in the brackets of a module's header.
const ATTRIBUTES: [&str; 5] = ["sysmodule", "noview", "nostepin", "viewonly", "readonly"];

/// Words that start what a module holds.
const CONTENT: [&str; 11] = [
    "local",
    "const",
    "pers",
    "var",
    "task",
    "proc",
    "func",
    "trap",
    "record",
    "alias",
    "endmodule",
];

/// Tokens of a text that need not be RAPID.
fn tokens(bytes: &[u8]) -> impl Iterator<Item = Token> {
    let start = super::reader::content_start(bytes).unwrap_or(bytes.len());
    let mut scanner = Scanner::new(bytes, start);
    std::iter::from_fn(move || scanner.next().ok()).take_while(|token| token.kind != Kind::End)
}

fn word(bytes: &[u8], token: Token) -> String {
    Source::text(&bytes[token.start as usize..token.end as usize]).to_ascii_lowercase()
}

/// Whether the bytes look like RAPID.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    let bytes_ok = memchr::memchr(0, &bytes[..bytes.len().min(1 << 16)]).is_none();
    let all: Vec<Token> = tokens(bytes).take(TOKENS).collect();
    let is = |at: usize, words: &[&str]| {
        all.get(at).is_some_and(|&token| {
            token.kind == Kind::Name && words.contains(&word(bytes, token).as_str())
        })
    };
    let module = |at: usize| {
        is(at, &["module"])
            && all.get(at + 1).is_some_and(|name| name.kind == Kind::Name)
            && match all.get(at + 2) {
                Some(open) if open.is(b'(') => is(at + 3, &ATTRIBUTES),
                _ => is(at + 2, &CONTENT),
            }
    };
    let data = |at: usize| {
        is(at, &["const", "pers", "var"])
            && all
                .get(at + 1)
                .is_some_and(|&token| Type::named(word(bytes, token).as_bytes()) != Type::Other)
            && all.get(at + 2).is_some_and(|name| name.kind == Kind::Name)
    };
    let goes = |at: usize| {
        all[at].kind == Kind::Name
            && verbs::is_move(word(bytes, all[at]).as_bytes())
            && (all.get(at + 1).is_some_and(|next| next.is(b'['))
                && all.get(at + 2).is_some_and(|next| next.is(b'['))
                || all.get(at + 1).is_some_and(|next| next.kind == Kind::Name)
                    && all.get(at + 2).is_some_and(|next| next.is(b',')))
    };
    bytes_ok && (0..all.len()).any(|at| module(at) || data(at) || goes(at))
}

/// Whether a line begins with a word that modules and what they hold begin with.
pub(super) fn has_words(bytes: &[u8]) -> bool {
    let lines = bytes.split(|b| matches!(b, b'\n' | b'\r'));
    lines.map(<[u8]>::trim_ascii_start).any(|line| {
        let end = line.iter().position(|b| !b.is_ascii_alphanumeric());
        let word = &line[..end.unwrap_or(line.len())];
        let is = |own: &str| word.eq_ignore_ascii_case(own.as_bytes());
        is("module") || CONTENT.into_iter().any(is)
    })
}

/// Where the marker goes, and its text: behind the line that opens the module, else at the top.
pub(super) fn mark(source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
    let bytes = &source.bytes;
    let text = comments(source, marker, "  ! ");
    let top = super::reader::content_start(bytes).unwrap_or(0);
    let header = module_header_end(bytes);
    let line = line_behind(bytes, header.unwrap_or(top));
    let at = match (header, line) {
        (Some(_), Some(at)) => at,
        (None, Some(at)) if top > 3 => at,
        // a file of one line, or data without a module
        _ => top.min(3),
    };
    (at, text)
}

/// The byte behind `MODULE name(attributes)`.
fn module_header_end(bytes: &[u8]) -> Option<usize> {
    let mut tokens = tokens(bytes).peekable();
    tokens.find(|&token| token.kind == Kind::Name && word(bytes, token) == "module")?;
    let mut end = tokens.next()?.end;
    if tokens.peek().is_some_and(|token| token.is(b'(')) {
        end = tokens.find(|token| token.is(b')'))?.end;
    }
    Some(end as usize)
}
