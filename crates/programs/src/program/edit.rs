//! Changes to a file by byte spans.

use std::ops::Range;

/// Replacements of byte ranges of one file; everything outside them stays.
#[derive(Clone, Debug, Default)]
pub struct Edits {
    spans: Vec<Span>,
    text: Vec<u8>,
}

/// A replaced range, and where its new text begins in [`Edits::text`]: it ends where that of the
/// next span begins. Files are smaller than 4 GiB.
#[derive(Clone, Copy, Debug)]
struct Span {
    start: u32,
    end: u32,
    text: u32,
}

fn short(offset: usize) -> u32 {
    u32::try_from(offset).expect("program files are smaller than 4 GiB")
}

impl Edits {
    /// None yet, with room for `spans` replacements by `bytes` of text: lists that grow leave holes
    /// in the memory.
    #[must_use]
    pub fn with_room(spans: usize, bytes: usize) -> Self {
        Self {
            spans: Vec::with_capacity(spans),
            text: Vec::with_capacity(bytes),
        }
    }

    /// Replaces the bytes of `span` with what `write` appends. An empty span inserts.
    ///
    /// # Panics
    /// If the file or all new text together has 4 GiB or more.
    pub fn replace(&mut self, span: Range<usize>, write: impl FnOnce(&mut Vec<u8>)) {
        self.spans.push(Span {
            start: short(span.start),
            end: short(span.end),
            text: short(self.text.len()),
        });
        write(&mut self.text);
    }

    /// The replaced range and the new text of one change.
    fn change(&self, index: usize) -> (Range<usize>, &[u8]) {
        let span = self.spans[index];
        let next = self.spans.get(index + 1);
        let end = next.map_or(self.text.len(), |next| next.text as usize);
        let replaced = span.start as usize..span.end as usize;
        (replaced, &self.text[span.text as usize..end])
    }

    /// Takes back the replacements inside a range.
    pub fn take_back(&mut self, range: &Range<usize>) {
        let mut left = Self::default();
        for (span, text) in (0..self.spans.len()).map(|i| self.change(i)) {
            let inside = span.start >= range.start && span.end <= range.end && !span.is_empty();
            if !inside {
                left.replace(span, |out| out.extend_from_slice(text));
            }
        }
        *self = left;
    }

    /// Adds the replacements of another list for the same file.
    pub fn append(&mut self, other: &Self) {
        let by = short(self.text.len());
        self.text.extend_from_slice(&other.text);
        let moved = |span: &Span| Span {
            text: span.text + by,
            ..*span
        };
        self.spans.extend(other.spans.iter().map(moved));
    }

    /// Inserts a text: before all replacements where it comes first, so that they stay in the order
    /// of the file.
    ///
    /// # Panics
    /// If the file or all new text together has 4 GiB or more.
    pub fn insert(&mut self, at: usize, text: &[u8]) {
        let first = self.spans.first().map_or(at, |first| first.start as usize);
        if at >= first {
            return self.replace(at..at, |out| out.extend_from_slice(text));
        }
        let (start, by) = (short(at), short(text.len()));
        self.text.splice(0..0, text.iter().copied());
        for span in &mut self.spans {
            span.text += by;
        }
        let first = Span {
            start,
            end: start,
            text: 0,
        };
        self.spans.insert(0, first);
    }

    /// Whether nothing is replaced.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// The replaced ranges and their new text, in the order of the file.
    pub fn changes(&self) -> impl Iterator<Item = (Range<usize>, &[u8])> {
        let place = |span: &Span| (span.start, span.end);
        let mut order = Vec::new();
        // mostly they come in the order of the file
        if !self.spans.is_sorted_by_key(place) {
            order.extend(0..short(self.spans.len()));
            order.sort_by_key(|i| place(&self.spans[*i as usize]));
        }
        let change = move |i: usize| self.change(order.get(i).map_or(i, |i| *i as usize));
        (0..self.spans.len()).map(change)
    }

    /// The file with the replacements made.
    ///
    /// # Panics
    /// If two spans overlap or one lies outside the file: the caller's bug.
    #[must_use]
    pub fn apply(&self, bytes: &[u8]) -> Vec<u8> {
        let replaced = |span: &Span| (span.end - span.start) as usize;
        let gone: usize = self.spans.iter().map(replaced).sum();
        let mut out = Vec::with_capacity((bytes.len() + self.text.len()).saturating_sub(gone));
        let mut done = 0;
        for (span, text) in self.changes() {
            let start = span.start;
            assert!(start >= done, "two changes of one span at byte {start}");
            out.extend_from_slice(&bytes[done..start]);
            out.extend_from_slice(text);
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

    #[test]
    fn what_is_taken_back_stays_as_it_was() {
        let mut edits = Edits::default();
        edits.replace(0..1, |out| out.extend(b"1"));
        edits.replace(2..4, |out| out.extend(b"22"));
        edits.replace(3..3, |out| out.extend(b"+"));
        let mut more = Edits::default();
        more.replace(5..6, |out| out.extend(b"333"));
        edits.append(&more);
        edits.take_back(&(2..4));
        assert_eq!(edits.apply(b"abcdef"), b"1bc+de333");
    }
}
