//! Files that are tables, but not CSV as it is read here: said before columns are looked for.

/// What is wrong, where, and the way out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotCsv {
    /// Line, from 1; 0 is the whole file.
    pub line: usize,
    /// Column in bytes, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// The way out.
    pub hint: String,
}

/// Separators that other programs write.
const SEPARATORS: [(u8, &str, &str); 3] = [
    (b';', "semicolons", ";"),
    (b'\t', "tabs", "\\t"),
    (b'|', "bars", "|"),
];

/// A number with a decimal comma.
fn has_decimal_comma(cell: &[u8]) -> bool {
    let text = std::str::from_utf8(cell).unwrap_or_default().trim();
    text.contains(',') && text.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// The line of a row, from 1, whose reading began at this position: there the `\n` of the row before
/// and blank lines and comments may still stand.
#[must_use]
pub fn line_of_row(bytes: &[u8], position: Option<&csv::Position>) -> usize {
    let place = |position: &csv::Position| {
        let (line, byte) = (position.line(), position.byte());
        Some((usize::try_from(line).ok()?, usize::try_from(byte).ok()?))
    };
    let Some((line, byte)) = position.and_then(place) else {
        return 0;
    };
    let lines = bytes.get(byte..).unwrap_or_default().split(|b| *b == b'\n');
    line + lines
        .take_while(|line| matches!(line, [] | [b'\r'] | [b'#', ..]))
        .count()
}

/// A file without anything in it.
#[must_use]
pub fn empty() -> NotCsv {
    NotCsv {
        line: 0,
        column: 1,
        message: "the file is empty".into(),
        hint: "the first line names the columns, with commas between".into(),
    }
}

/// Columns of a table: measurements have some dozen, and loggers some hundred.
const MOST_COLUMNS: usize = 1000;

/// A header of more columns than any table has.
#[must_use]
pub fn too_wide(line: usize, columns: usize) -> Option<NotCsv> {
    (columns > MOST_COLUMNS).then(|| NotCsv {
        line,
        column: 1,
        message: format!("{columns} columns; at most {MOST_COLUMNS} are read"),
        hint: "is it a table? the first line names its columns; leave out those that are not \
            needed"
            .into(),
    })
}

/// The cells of a line, between any of these signs. A cell that begins with a quote may hold them between its quotes.
pub fn cells_of<'a>(line: &'a str, separators: &'a [u8]) -> impl Iterator<Item = &'a str> {
    let (mut begins, mut has_quotes, mut is_open) = (true, false, false);
    line.split(move |c: char| {
        if !is_open && separators.iter().any(|sign| char::from(*sign) == c) {
            (begins, has_quotes) = (true, false);
            return true;
        }
        if c == '"' && (begins || has_quotes) {
            (has_quotes, is_open) = (true, !is_open);
        }
        begins &= c.is_whitespace();
        false
    })
}

/// A row of twice as many cells as its header: every number with a decimal comma is two.
#[must_use]
pub fn doubled(line: usize, header: &str, first: Option<&str>) -> Option<NotCsv> {
    let cells = |line: &str| cells_of(line, b",").count();
    let (names, found) = (cells(header), first.map_or(0, cells));
    (names > 2 && found > names && found <= 2 * names).then(|| NotCsv {
        line: line + 1,
        column: 1,
        message: format!("{found} cells; the header has {names}"),
        hint: "are decimals written with a comma? write them with a point, or separate cells with \
            semicolons or tabs"
            .into(),
    })
}

/// What makes a file no CSV with commas: it is empty, no UTF-8, has other separators or decimal
/// commas. `None` where none of these is to be seen.
#[must_use]
pub fn not_csv(bytes: &[u8]) -> Option<NotCsv> {
    if let Err(error) = std::str::from_utf8(bytes) {
        let at = error.valid_up_to();
        let line = bytes[..at].split(|b| *b == b'\n').count();
        let start = bytes[..at]
            .iter()
            .rposition(|b| *b == b'\n')
            .map_or(0, |n| n + 1);
        return Some(NotCsv {
            line,
            column: at - start + 1,
            message: "not UTF-8 text".into(),
            hint: "save the table as CSV in UTF-8 (from Latin-1: `iconv -f latin1 -t utf8 FILE`; \
                from UTF-16: `iconv -f utf16 -t utf8 FILE`)"
                .into(),
        });
    }
    let mut lines = bytes
        .split(|b| *b == b'\n')
        .enumerate()
        .filter(|(_, line)| !line.trim_ascii().is_empty() && !line.starts_with(b"#"));
    let Some((number, header)) = lines.next() else {
        return Some(empty());
    };
    let first = lines.next().map(|(_, line)| line);
    let columns = header.split(|b| *b == b',').count();
    if let Some(found) = too_wide(number + 1, columns) {
        return Some(found);
    }
    // how many there are: the parts between, less one
    let count = |line: &[u8], separator: u8| line.split(|b| *b == separator).count() - 1;
    if count(header, b',') > 0 {
        let text = |line| std::str::from_utf8(line).unwrap_or_default();
        return doubled(number + 1, text(header), first.map(text));
    }
    let (separator, name, sign) = SEPARATORS
        .into_iter()
        .find(|(separator, ..)| count(header, *separator) > 0)?;
    let decimal = first.is_some_and(|line| line.split(|b| *b == separator).any(has_decimal_comma));
    let (and, points) = if decimal {
        (", and decimals are written with a comma", "s/,/./g; ")
    } else {
        ("", "")
    };
    Some(NotCsv {
        line: number + 1,
        column: 1,
        message: format!("columns are separated by {name}, not commas{and}"),
        hint: format!("convert it: `sed '{points}s/{sign}/,/g' FILE > NEW.csv`"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reported(text: &[u8]) -> (usize, usize, String, String) {
        let found = not_csv(text).expect("no CSV");
        (found.line, found.column, found.message, found.hint)
    }

    #[test]
    fn separators_decimals_and_encodings_are_named() {
        assert_eq!(not_csv(b"a,b\n1,2\n"), None);
        assert_eq!(not_csv(b"a\n1\n"), None);
        assert_eq!(not_csv("a,".repeat(999).as_bytes()), None);
        let (line, _, message, _) = reported(("# x\n".to_owned() + &"a,".repeat(1000)).as_bytes());
        assert_eq!(line, 2);
        assert!(message.contains("1001 columns; at most 1000"), "{message}");
        let (line, _, message, hint) = reported(b"# x\na;b\n1,5;2,5\n");
        assert_eq!(line, 2);
        assert!(
            message.contains("semicolons") && message.contains("comma"),
            "{message}"
        );
        assert!(hint.contains("s/,/./g; s/;/,/g"), "{hint}");
        let (_, _, message, hint) = reported(b"a\tb\n1.5\t2\n");
        assert!(
            message.contains("tabs") && hint.contains("'s/\\t/,/g'"),
            "{hint}"
        );
        let (line, _, message, hint) = reported(b"a,b,c\n1,5,2,5,3,5\n");
        assert!(line == 2 && message.contains("6 cells") && hint.contains("point"));
        let (_, _, message, _) = reported(b"\n# nothing\n");
        assert!(message.contains("empty"));
        let (line, column, message, hint) = reported(b"a,b\n1,\xb52\n");
        assert_eq!((line, column), (2, 3));
        assert!(message.contains("UTF-8") && hint.contains("iconv"));
    }

    #[test]
    fn a_separator_in_quotes_separates_nothing() {
        let cells = |line| cells_of(line, b",").collect::<Vec<_>>();
        assert_eq!(cells("a, \"b, c\",d"), ["a", " \"b, c\"", "d"]);
        assert_eq!(cells("\"a\"\", b\",,"), ["\"a\"\", b\"", "", ""]);
        // an inch is no quote
        assert_eq!(cells("1/2\",2,3\",4").len(), 4);
        assert_eq!(not_csv(b"a,b,c\n\"1, 2, 3\",2,3\n"), None);
    }
}
