//! What conditions of loops say of numbers.

use super::numbers::Written;
use super::resolved::Resolved;
use crate::program::names::Context;
use crate::program::numbers::{Numbers, bounds_in, word};
use crate::program::script::short;

/// Bytes of a condition that is looked at.
const LONGEST_CONDITION: usize = 300;

impl Resolved<'_> {
    /// Notes what the condition of the loop that begins there bounds: `WHILE n<10 DO`.
    pub(super) fn bound(
        &self,
        (file, offset): (u32, u32),
        context: Context,
        block: (u32, u32),
        numbers: &mut Numbers<Written>,
    ) {
        let bytes = &self.sources[file as usize].bytes;
        let text = &bytes[offset as usize..];
        let is_while = text
            .get(..5)
            .is_some_and(|of| of.eq_ignore_ascii_case(b"while"));
        // conditions are short
        let text = &text[..text.len().min(LONGEST_CONDITION)];
        let Some(end) = word(&text.to_ascii_lowercase(), "do").filter(|_| is_while) else {
            return;
        };
        if text[..end].contains(&b'!') {
            return;
        }
        for (name, relation, limit) in bounds_in(&text[5..end]) {
            let name = self.parsed.symbols.find(name);
            let [number] = name.map_or(Vec::new(), |name| self.numbers_named(name, context))[..]
            else {
                continue;
            };
            let start = short(limit.as_ptr() as usize - bytes.as_ptr() as usize);
            let limit = Written::Text {
                file,
                bytes: (start, start + short(limit.len())),
                context,
            };
            numbers.bound(block, number, (relation, limit));
        }
    }
}
