//! Changes to a file by byte spans.

use std::ops::Range;

/// Replacements of byte ranges of one file; everything outside them stays.
#[derive(Debug, Default)]
pub struct Edits {
    spans: Vec<(Range<usize>, Range<usize>)>,
    text: Vec<u8>,
}

impl Edits {
    /// Replaces the bytes of `span` with what `write` appends. An empty span inserts.
    pub fn replace(&mut self, span: Range<usize>, write: impl FnOnce(&mut Vec<u8>)) {
        let start = self.text.len();
        write(&mut self.text);
        self.spans.push((span, start..self.text.len()));
    }

    /// Whether nothing is replaced.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// The file with the replacements made.
    ///
    /// # Panics
    /// If two spans overlap or one lies outside the file: the caller's bug.
    #[must_use]
    pub fn apply(mut self, bytes: &[u8]) -> Vec<u8> {
        self.spans.sort_by_key(|(span, _)| (span.start, span.end));
        let mut out = Vec::with_capacity(bytes.len() + self.text.len());
        let mut done = 0;
        for (span, text) in &self.spans {
            assert!(
                span.start >= done,
                "two changes of one span at byte {}",
                span.start
            );
            out.extend_from_slice(&bytes[done..span.start]);
            out.extend_from_slice(&self.text[text.clone()]);
            done = span.end;
        }
        out.extend_from_slice(&bytes[done..]);
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_outside_the_spans_stay() {
        let mut edits = Edits::default();
        edits.replace(6..7, |out| out.extend(b"22"));
        edits.replace(0..1, |out| out.extend(b"1"));
        edits.replace(3..3, |out| out.extend(b"+"));
        assert_eq!(edits.apply(b"a\r\nb\xffcd."), b"1\r\n+b\xffc22.");
    }
}
