//! Text as terminals may have it: what would steer one is shown by its code instead.

use std::borrow::Cow;
use std::path::Path;

/// Control characters, and the signs that turn the direction of writing.
fn steers(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn replaced(text: &str, stays: impl Fn(char, Option<char>) -> bool) -> Cow<'_, str> {
    if !text.chars().any(steers) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        if steers(letter) && !stays(letter, letters.peek().copied()) {
            out.extend(letter.escape_unicode());
        } else {
            out.push(letter);
        }
    }
    Cow::Owned(out)
}

/// A text of one line.
pub fn printable(text: &str) -> Cow<'_, str> {
    replaced(text, |_, _| false)
}

/// A text of several lines: their ends and tabs stay.
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    replaced(text, |letter, next| {
        matches!(letter, '\n' | '\t') || (letter == '\r' && next == Some('\n'))
    })
}

/// A value in JSON that YAML takes, too: signs that YAML does not print are escaped.
pub fn flow(value: &serde_json::Value) -> String {
    let mut out = String::new();
    for letter in value.to_string().chars() {
        if steers(letter) || matches!(letter, '\u{2028}' | '\u{2029}' | '\u{feff}') {
            out += &format!("\\u{:04x}", u32::from(letter));
        } else {
            out.push(letter);
        }
    }
    out
}

/// A name as YAML and JSON have it in quotes.
pub fn quoted(text: &str) -> String {
    flow(&text.into())
}

/// A word as a shell takes it for one: in quotes where it would take it apart.
pub fn shell_word(word: &str) -> Cow<'_, str> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./=,:+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        Cow::Borrowed(word)
    } else {
        Cow::Owned(format!("'{}'", printable(word).replace('\'', "'\\''")))
    }
}

/// A file's name as messages and reports have it.
pub fn name_of(path: &Path) -> String {
    printable(&path.to_string_lossy()).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_shown_by_its_code() {
        assert_eq!(printable("a\x1b[2Jb"), "a\\u{1b}[2Jb");
        assert_eq!(printable("a\nb\u{9b}1m"), "a\\u{a}b\\u{9b}1m");
        assert_eq!(printable_lines("a\r\nb\rc\td\n"), "a\r\nb\\u{d}c\td\n");
        assert_eq!(printable("\u{202e}dom.a"), "\\u{202e}dom.a");
        assert_eq!(printable("Düse 3"), "Düse 3");
        assert_eq!(shell_word("a/b.mod"), "a/b.mod");
        assert_eq!(shell_word("it's p10"), "'it'\\''s p10'");
        assert_eq!(quoted("no: \"\u{1b}\u{85}"), "\"no: \\\"\\u001b\\u0085\"");
    }
}
