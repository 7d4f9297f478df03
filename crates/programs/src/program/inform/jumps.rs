//! Jumps to labels, and what may stand behind them, behind calls and behind RET.

use super::lines::words;
use super::reader::Reader;
use crate::program::kit::label_key;
use crate::program::script::Place;

/// Words behind the job of a call that say with what it runs.
const GIVEN: [&[u8]; 2] = [b"ARGF", b"UF#"];

/// Whether an instruction may be passed over: a condition stands behind it, or, behind a jump, a
/// call or RET, something that is not known.
pub(super) fn is_conditional(text: &[u8]) -> bool {
    let mut rest = words(text).take_while(|word| !word.starts_with(b"//"));
    match rest.next() {
        Some(b"RET") => {}
        Some(b"JUMP" | b"CALL") => _ = rest.next(),
        _ => return rest.any(is_condition),
    }
    while let Some(word) = rest.next() {
        if word == b"ARGF" {
            // what it gives stands behind a blank
            rest.next();
        } else if !GIVEN.iter().any(|given| word.starts_with(given)) {
            return true;
        }
    }
    false
}

/// The condition of an instruction that may be passed over; empty where it is not known.
pub(super) fn condition(text: &[u8]) -> Option<&[u8]> {
    if !is_conditional(text) {
        return None;
    }
    let Some(word) = words(text).find(|word| is_condition(word)) else {
        return Some(&[]);
    };
    let at = word.as_ptr() as usize - text.as_ptr() as usize;
    let length = word.iter().take_while(|b| b.is_ascii_uppercase()).count();
    let behind = &text[at + length..];
    let end = memchr::memmem::find(behind, b"//").unwrap_or(behind.len());
    Some(&behind[..end])
}

/// Whether a condition begins with this word: `IF`, `IFEXP`, `IFEXPRESS`, blank or not behind it.
pub(super) fn is_condition(word: &[u8]) -> bool {
    word == b"IF" || word.starts_with(b"IF(") || word.starts_with(b"IFEXP")
}

/// Whether a word names a label: `*A`, `LABEL:B000`.
pub(super) fn is_label(word: &[u8]) -> bool {
    word.starts_with(b"*") || word.starts_with(b"LABEL:")
}

/// Stands for all labels of a job; none has a blank in it.
fn any_label() -> u64 {
    label_key(b" any")
}

impl Reader<'_> {
    /// The key of a label; of one that only the running program knows that of all.
    fn key_of_label(&mut self, word: &[u8]) -> u64 {
        if let [b'*', name @ ..] = word {
            return label_key(name);
        }
        self.here.jumps_anywhere = true;
        any_label()
    }

    /// `JUMP *A`, `JUMP LABEL:B000`
    pub(super) fn jump(&mut self, to: &[u8], condition: Option<&[u8]>) {
        let key = self.key_of_label(to);
        self.numbers.jump(key, condition);
        if condition.is_some() {
            self.builder.may_go_to(key);
        } else {
            self.builder.go_to(key);
        }
    }

    /// A label of the text.
    pub(super) fn label(&mut self, name: &[u8]) {
        let key = label_key(name);
        self.here.labels.push(key);
        self.numbers.label(key);
        self.builder.label(key);
    }

    /// At the end of a job: from where a jump by a number comes it goes on to each of the labels.
    pub(super) fn end_labels(&mut self) {
        self.numbers.end(!self.here.jumps_anywhere);
        if !self.here.jumps_anywhere {
            return;
        }
        self.builder.back();
        self.builder.label(any_label());
        for key in std::mem::take(&mut self.here.labels) {
            self.builder.may_go_to(key);
        }
    }

    /// `MOVL … TRAP *E`: the move that was put last may end anywhere, and there the job goes on.
    pub(super) fn trap(&mut self, place: Place, label: &[u8]) {
        self.builder.begin_if(None);
        self.builder.stop(place);
        let key = self.key_of_label(label);
        self.numbers.jump(key, Some(&[]));
        self.builder.go_to(key);
        self.builder.end_choice();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_behind_a_jump_is_a_condition() {
        for (text, expected) in [
            ("JUMP *A", false),
            ("JUMP *A IF IN#(1)=ON", true),
            ("JUMP *A IFEXP IN#(1)=ON AND B000=1", true),
            ("JUMP *A IFEXPRESS (IN#(1)=ON AND IN#(2)=ON)", true),
            ("JUMP *A IFEXPRESS(B000=1)", true),
            ("JUMP LABEL:B000", false),
            ("JUMP LABEL:B000 SOMETIMES", true),
            ("JUMP JOB:S IFEXPRESS (B000=1)", true),
            ("CALL JOB:S", false),
            ("CALL JOB:S UF#(3) ARGF1 ARGF B000 ARGFP001", false),
            ("CALL JOB:S ARGF1 IFEXPRESS (B000=1)", true),
            ("CALL IG#(1) PERHAPS", true),
            ("CALL JOB:S // as before", false),
            ("RET", false),
            ("RET IFEXPRESS (B000=1)", true),
            ("PAUSE IFEXPRESS (B000=1)", true),
            ("SFTOF IF IN#(1)=ON", true),
            ("SET B000 1", false),
        ] {
            assert_eq!(is_conditional(text.as_bytes()), expected, "{text}");
        }
    }
}
