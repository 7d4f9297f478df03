//! Records and cells of a table, as places in its bytes.
//!
//! Cells are separated by commas; a cell in double quotes may hold commas and line ends, and a
//! quote as two. Blanks around a cell do not belong to it. Lines end with LF, CR LF or CR; empty
//! ones and those that start with `#` are passed over.

use crate::program::kit::content_start;

/// Where a cell's text stands, without its quotes and the blanks around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    pub start: usize,
    pub end: usize,
    pub quoted: bool,
}

/// Reads one record after the other.
#[derive(Debug)]
pub(super) struct Records<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Records<'a> {
    /// The records behind a byte order mark.
    pub(super) fn of(bytes: &'a [u8]) -> Self {
        let at = content_start(bytes);
        Self { bytes, at }
    }

    /// Puts the cells of the next record into `cells`; `false` at the end of the table.
    ///
    /// # Errors
    /// The place of a quote that is not closed.
    pub(super) fn next(&mut self, cells: &mut Vec<Cell>) -> Result<bool, usize> {
        cells.clear();
        while let Some(&byte) = self.bytes.get(self.at) {
            if byte == b'#' {
                self.at = self.line_end(self.at);
            } else if is_line_end(byte) {
                self.at += 1;
            } else if is_blank(byte) && self.is_blank_line() {
                self.at = self.line_end(self.at);
            } else {
                return self.record(cells).map(|()| true);
            }
        }
        Ok(false)
    }

    fn record(&mut self, cells: &mut Vec<Cell>) -> Result<(), usize> {
        loop {
            let cell = self.cell()?;
            cells.push(cell);
            match self.bytes.get(self.at) {
                Some(b',') => self.at += 1,
                _ => return Ok(()),
            }
        }
    }

    /// The cell here; then the place is that of its comma, line end, or the end.
    fn cell(&mut self) -> Result<Cell, usize> {
        let blank = |b: &&u8| is_blank(**b);
        let first = self.at + self.bytes[self.at..].iter().take_while(blank).count();
        if self.bytes.get(first) == Some(&b'"') {
            let start = first + 1;
            let mut end = start;
            loop {
                let length = memchr::memchr(b'"', &self.bytes[end..]).ok_or(first)?;
                end += length;
                if self.bytes.get(end + 1) != Some(&b'"') {
                    break;
                }
                end += 2;
            }
            // what stands between the quote and the comma belongs to no cell
            self.at = self.cell_end(end + 1);
            let (start, end) = self.trimmed(start, end);
            return Ok(Cell {
                start,
                end,
                quoted: true,
            });
        }
        self.at = self.cell_end(first);
        let (start, end) = self.trimmed(first, self.at);
        Ok(Cell {
            start,
            end,
            quoted: false,
        })
    }

    fn cell_end(&self, from: usize) -> usize {
        let length = memchr::memchr3(b',', b'\n', b'\r', &self.bytes[from..]);
        length.map_or(self.bytes.len(), |length| from + length)
    }

    fn line_end(&self, from: usize) -> usize {
        let length = memchr::memchr2(b'\n', b'\r', &self.bytes[from..]);
        length.map_or(self.bytes.len(), |length| from + length)
    }

    fn is_blank_line(&self) -> bool {
        self.bytes[self.at..self.line_end(self.at)]
            .iter()
            .all(|&b| is_blank(b))
    }

    fn trimmed(&self, start: usize, end: usize) -> (usize, usize) {
        let text = &self.bytes[start..end];
        let before = text.iter().take_while(|&&b| is_blank(b)).count();
        let behind = text[before..].iter().rev().take_while(|&&b| is_blank(b));
        (start + before, end - behind.count())
    }
}

fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

/// Blanks, tabs, and the Ctrl-Z that some editors put at the end.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x1a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Result<Vec<Vec<&str>>, usize> {
        let mut records = Records::of(text.as_bytes());
        let (mut cells, mut found) = (Vec::new(), Vec::new());
        while records.next(&mut cells)? {
            found.push(cells.iter().map(|c| &text[c.start..c.end]).collect());
        }
        Ok(found)
    }

    #[test]
    fn cells_are_places_in_the_text() {
        let text = "\u{feff}# x,\"y\r\na , b,\"c\",\r\n\r\n  \n\"1,\"\"2\n3\" ,\" 4 \"\r#\r5,";
        let found = all(text).expect("a table");
        assert_eq!(
            found,
            [
                vec!["a", "b", "c", ""],
                vec!["1,\"\"2\n3", "4"],
                vec!["5", ""]
            ]
        );
        assert_eq!(all("a,\"b\n"), Err(2));
        assert_eq!(all(""), Ok(vec![]));
        assert_eq!(all("a,\"\"\"\"").expect("a table"), [vec!["a", "\"\""]]);
    }
}
