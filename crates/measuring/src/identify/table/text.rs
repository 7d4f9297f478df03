//! A table's bytes as text, and how its cells are written: encoding, separator, decimal sign,
//! header.

use crate::identify::input_checks::csv::{NotCsv, cells_of, doubled, empty, line_of_row, too_wide};
use std::ops::Range;

/// What stands between cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// One sign; cells may be in quotes.
    Sign(u8),
    /// Any number of blanks.
    Blanks,
}

/// Signs that separate cells, the one that a header must not have by chance last.
const SIGNS: [u8; 4] = [b'\t', b';', b'|', b','];
/// Numbers in a first line from which on it is a row and no header.
const ROW_NUMBERS: usize = 3;

/// One file's cells.
#[derive(Clone, Debug)]
pub struct Grid {
    /// The file as the user named it.
    pub name: String,
    /// Its text; comments are blank lines.
    pub text: String,
    /// What stands between cells.
    pub separator: Separator,
    /// Whether decimals have a comma.
    pub decimal_comma: bool,
    /// Whether the first line names the columns; else they are `#1`, `#2` and so on.
    pub has_header: bool,
    /// Names of the columns.
    pub header: Vec<String>,
    /// Rows with their lines, from 1.
    pub rows: Vec<(usize, csv::StringRecord)>,
    /// The encoding where it is not UTF-8.
    pub encoding: Option<&'static str>,
}

/// A fault of the text at its place.
fn fault(line: usize, column: usize, message: impl Into<String>, hint: &str) -> NotCsv {
    NotCsv {
        line,
        column,
        message: message.into(),
        hint: hint.into(),
    }
}

/// UTF-8, UTF-16 with its mark, else Latin-1; lines that end with CR alone end with LF.
fn decoded(bytes: &[u8]) -> Result<(String, Option<&'static str>), NotCsv> {
    let wide = |from: fn([u8; 2]) -> u16| {
        let units = bytes[2..]
            .chunks_exact(2)
            .map(|pair| from([pair[0], pair[1]]));
        let text: Result<String, _> = char::decode_utf16(units).collect();
        text.map_err(|_| {
            fault(
                0,
                1,
                "not UTF-16 text, though it begins so",
                "save it as UTF-8",
            )
        })
    };
    let (text, encoding) = match bytes {
        [0xff, 0xfe, ..] => (wide(u16::from_le_bytes)?, Some("UTF-16")),
        [0xfe, 0xff, ..] => (wide(u16::from_be_bytes)?, Some("UTF-16")),
        _ => match std::str::from_utf8(bytes) {
            Ok(text) => (text.trim_start_matches('\u{feff}').to_owned(), None),
            Err(_) => (
                bytes.iter().copied().map(char::from).collect(),
                Some("Latin-1"),
            ),
        },
    };
    // names may hold any sign; a file in another encoding that has control characters is no table
    let odd = |c: char| c == '\0' || encoding.is_some() && c < ' ' && !"\t\n\r\u{c}".contains(c);
    if let Some(at) = text.find(odd) {
        let before = &text[..at];
        let line = before.matches('\n').count() + 1;
        let column = at - before.rfind('\n').map_or(0, |n| n + 1) + 1;
        let hint = "save the table as text: CSV in UTF-8";
        return Err(fault(line, column, "this is no text", hint));
    }
    if !text.contains('\n') && text.contains('\r') {
        return Ok((text.replace('\r', "\n"), encoding));
    }
    Ok((text, encoding))
}

/// Whether a cell is a number, with a decimal point or a decimal comma.
fn is_number(cell: &str) -> bool {
    let cell = cell.trim().trim_matches('"');
    let digits = cell.bytes().any(|b| b.is_ascii_digit());
    digits && cell.replacen(',', ".", 1).parse::<f64>().is_ok()
}

impl Separator {
    /// What separates the cells of a line, by the line itself.
    fn of(line: &str) -> Self {
        let cells = cells_of(line, &SIGNS).map(|cell| range_in(line, cell));
        let between: Vec<u8> = cells
            .filter_map(|cell| line.as_bytes().get(cell.end).copied())
            .collect();
        let sign = SIGNS.into_iter().find(|sign| between.contains(sign));
        let several = line.split_whitespace().count() > 1;
        match sign {
            Some(sign) => Self::Sign(sign),
            None if several => Self::Blanks,
            None => Self::Sign(b','),
        }
    }

    /// Where the cells of a line are, in bytes.
    #[must_use]
    pub fn cells(self, line: &str) -> Vec<Range<usize>> {
        let range = |cell| range_in(line, cell);
        match self {
            Self::Sign(sign) => cells_of(line, &[sign]).map(range).collect(),
            Self::Blanks => line.split_ascii_whitespace().map(range).collect(),
        }
    }
}

/// Where a part of a line is, in bytes.
fn range_in(line: &str, part: &str) -> Range<usize> {
    let start = part.as_ptr().addr() - line.as_ptr().addr();
    start..start + part.len()
}

/// Whether a line tells nothing: blank, or a comment.
fn is_silent(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with('#') || line.starts_with("//")
}

impl Grid {
    /// Reads a file's bytes. Lines that begin with `#` or `//` are comments.
    ///
    /// # Errors
    /// No text, nothing in it, rows with other numbers of cells than the header.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, NotCsv> {
        let (text, encoding) = decoded(bytes)?;
        let spoken: Vec<&str> = text
            .lines()
            .map(|l| if is_silent(l) { "" } else { l })
            .collect();
        let text = spoken.join("\n");
        let mut lines = text
            .lines()
            .enumerate()
            .filter(|(_, line)| !line.trim().is_empty());
        let Some((number, first)) = lines.next() else {
            return Err(empty());
        };
        let second = lines.next().map(|(_, line)| line);
        let separator = Separator::of(first);
        if separator == Separator::Sign(b',')
            && let Some(found) = doubled(number + 1, first, second)
        {
            return Err(found);
        }
        let of_line = |line: &str| -> Vec<String> {
            let cells = separator
                .cells(line)
                .into_iter()
                .map(|cell| line[cell].trim());
            cells
                .map(|cell| cell.trim_matches('"').trim().to_owned())
                .collect()
        };
        let names = of_line(first);
        if let Some(found) = too_wide(number + 1, names.len()) {
            return Err(found);
        }
        let numbers = names.iter().filter(|cell| is_number(cell)).count();
        let has_header = numbers < ROW_NUMBERS;
        let header = if has_header {
            names
        } else {
            (1..=names.len()).map(|n| format!("#{n}")).collect()
        };
        let (separator_sign, rows) = (separator, Self::rows(&text, separator, has_header)?);
        let commas = |cell: &str| cell.contains(',') && is_number(cell);
        let decimal_comma = separator_sign != Separator::Sign(b',')
            && rows.iter().any(|(_, row)| row.iter().any(commas));
        for (line, row) in &rows {
            if row.len() != header.len() {
                let message = format!("{} cells; the header has {}", row.len(), header.len());
                let hint = "is it a table? the first line names its columns, and every row has as \
                    many cells";
                return Err(fault(*line, 1, message, hint));
            }
        }
        Ok(Self {
            name: name.to_owned(),
            separator,
            decimal_comma,
            has_header,
            header,
            rows,
            encoding,
            text,
        })
    }

    fn rows(
        text: &str,
        separator: Separator,
        has_header: bool,
    ) -> Result<Vec<(usize, csv::StringRecord)>, NotCsv> {
        let skipped = usize::from(has_header);
        let Separator::Sign(sign) = separator else {
            let lines = text
                .lines()
                .enumerate()
                .filter(|(_, l)| !l.trim().is_empty());
            let rows = lines.skip(skipped);
            return Ok(rows
                .map(|(number, line)| (number + 1, line.split_whitespace().collect()))
                .collect());
        };
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(sign)
            .trim(csv::Trim::All)
            .has_headers(false)
            .flexible(true)
            .from_reader(text.as_bytes());
        let line_of = |position: Option<&csv::Position>| line_of_row(text.as_bytes(), position);
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record
                .map_err(|error| fault(line_of(error.position()), 1, error.to_string(), ""))?;
            rows.push((line_of(record.position()), record));
        }
        rows.drain(..skipped.min(rows.len()));
        Ok(rows)
    }

    /// Where a cell of a row's line is: column in bytes, from 1, and length.
    #[must_use]
    pub fn place(&self, line: usize, field: usize) -> (usize, usize) {
        let text = self
            .text
            .lines()
            .nth(line.saturating_sub(1))
            .unwrap_or_default();
        let cells = self.separator.cells(text);
        let cell = cells.get(field).cloned().unwrap_or(0..0);
        let blank = text[cell.clone()].len() - text[cell.clone()].trim_start().len();
        (cell.start + blank + 1, text[cell].trim().len())
    }

    /// The number in a cell; `None` where it is none. With decimal commas a point is no decimal
    /// sign, and the other way round.
    #[must_use]
    pub fn number(&self, text: &str) -> Option<f64> {
        let plain = text.strip_prefix('\u{2212}').map(|rest| format!("-{rest}"));
        let text = plain.as_deref().unwrap_or(text);
        let number = if self.decimal_comma {
            if text.contains('.') {
                return None;
            }
            text.replacen(',', ".", 1).parse()
        } else {
            text.parse()
        };
        number.ok().filter(|n: &f64| n.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(bytes: &[u8]) -> Grid {
        Grid::read("t", bytes).expect("a table")
    }

    #[test]
    fn separators_and_decimal_signs_are_recognised() {
        for (text, comma) in [
            ("a,b,c\n1.5,2,x\n", false),
            ("a;b;c\n1,5;2;x\n", true),
            ("a\tb\tc\n1,5\t2\tx\n", true),
            ("a b c\n1.5  2   x\n", false),
            ("// frame\na | b | c\n\n1.5|2|x\n", false),
        ] {
            let read = grid(text.as_bytes());
            assert_eq!(read.header, ["a", "b", "c"], "{text}");
            assert_eq!(read.decimal_comma, comma, "{text}");
            let row = &read.rows[0].1;
            let numbers: Vec<_> = (0..2).map(|i| read.number(&row[i])).collect();
            assert_eq!(numbers, [Some(1.5), Some(2.0)], "{text}");
        }
        // a file has one decimal sign: the other one may be of thousands
        let read = grid(b"a;b\n1,5;1.234\n");
        assert_eq!(read.number("1.234"), None);
        assert_eq!(read.place(2, 1), (5, 5));
    }

    #[test]
    fn quoted_cells_may_hold_separators() {
        let read = grid(b"note,x,\"y; mm\",z\n\"a, b, c; d\",1,2,3\n");
        assert_eq!(read.separator, Separator::Sign(b','));
        assert_eq!(read.header, ["note", "x", "y; mm", "z"]);
        assert_eq!(read.rows[0].1, ["a, b, c; d", "1", "2", "3"][..]);
        assert_eq!(read.place(2, 1), (14, 1));
    }

    #[test]
    fn encodings_other_than_utf_8_are_read() {
        let latin = grid(b"Temp [\xb0C],b\r\n1,2\r\n");
        assert_eq!(latin.header[0], "Temp [\u{b0}C]");
        assert_eq!(latin.encoding, Some("Latin-1"));
        let mut wide = vec![0xff, 0xfe];
        wide.extend("x;y\n1,5;2\n".encode_utf16().flat_map(u16::to_le_bytes));
        assert_eq!(grid(&wide).rows[0].1[0], *"1,5");
        assert!(Grid::read("t", b"a,b\n\0\x01,2\n").is_err());
    }

    #[test]
    fn a_list_without_a_header_has_numbered_columns() {
        let read = grid(b"1,  1975.568420,  -310.198889,  -257.870805\n3, 2, 3, 4\n");
        assert_eq!(read.header, ["#1", "#2", "#3", "#4"]);
        assert_eq!(read.rows.len(), 2);
        assert_eq!(read.rows[1].0, 2);
    }

    #[test]
    fn a_table_of_more_columns_than_any_has_is_refused_with_their_number() {
        assert!(Grid::read("t", ";".repeat(999).as_bytes()).is_ok());
        for header in [";".repeat(1000), "c\t".repeat(2_000_000)] {
            let error = Grid::read("t", header.as_bytes()).expect_err("too wide");
            let columns = header.matches([';', '\t']).count() + 1;
            assert!(
                error
                    .message
                    .contains(&format!("{columns} columns; at most 1000")),
                "{}",
                error.message
            );
        }
    }

    #[test]
    fn rows_of_another_length_are_refused_with_their_line() {
        let error = Grid::read("t", b"a,b\n# c\n1,2\n1\n").expect_err("one cell");
        assert_eq!(error.line, 4);
        assert!(error.message.contains("1 cells; the header has 2"));
    }
}
