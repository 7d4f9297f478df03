//! How text for people is laid out: tables that fit a width, lines that are broken.

use crate::task::parts::Statistics;

/// Signs that begin and end a colour in a text for people, and what a terminal takes for it.
/// Unicode keeps them for use inside a program: whatever else steers a terminal can be kept from
/// it.
const COLOURS: [(char, &str); 4] = [
    (RED, "\x1b[1;31m"),
    (YELLOW, "\x1b[1;33m"),
    (BLUE, "\x1b[1;34m"),
    (PLAIN, "\x1b[0m"),
];
pub(crate) const RED: char = '\u{fdd0}';
pub(crate) const YELLOW: char = '\u{fdd1}';
pub(crate) const BLUE: char = '\u{fdd2}';
pub(crate) const PLAIN: char = '\u{fdd3}';

/// A text with the colours of a terminal.
pub(crate) fn coloured(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match COLOURS.iter().find(|(sign, _)| *sign == letter) {
            Some((_, colour)) => out += colour,
            None => out.push(letter),
        }
    }
    out
}

/// Letters that are seen: colours are not.
fn letters(text: &str) -> usize {
    let is_seen = |letter: &char| !(RED..=PLAIN).contains(letter);
    text.chars().filter(is_seen).count()
}

/// Where the rest of a broken line begins: below what stands behind its label, else a little
/// further in.
fn indent_of_rest(line: &str, width: usize) -> usize {
    let indent = line.chars().take_while(|c| *c == ' ').count();
    let letters: Vec<char> = line.chars().collect();
    let label_ends = (indent + 1..letters.len().saturating_sub(1))
        .take_while(|at| *at <= width / 2)
        .find(|at| letters[*at] == ' ' && letters[at + 1] == ' ');
    let value = label_ends.and_then(|at| (at..letters.len()).find(|k| letters[*k] != ' '));
    value.filter(|at| *at <= width / 2).unwrap_or(indent + 2)
}

/// A line broken at spaces where it is wider than `width`. A space that does not break (U+00A0) is
/// written as a space.
pub(crate) fn wrapped(line: &str, width: usize) -> String {
    broken(line, width, indent_of_rest(line, width)) + "\n"
}

/// A line broken, all but the first of its lines behind so many spaces.
fn broken(line: &str, width: usize, rest: usize) -> String {
    let indent = line.len() - line.trim_start_matches(' ').len();
    let mut out = " ".repeat(indent);
    let mut length = indent;
    // spaces that wait for a word on the same line
    let mut gap = 0;
    let mut is_empty = true;
    for (n, word) in line[indent..].split(' ').enumerate() {
        if n > 0 {
            gap += 1;
        }
        if word.is_empty() {
            continue;
        }
        let long = letters(word);
        if !is_empty && length + gap + long > width {
            out += &format!("\n{}", " ".repeat(rest));
            length = rest;
        } else {
            out += &" ".repeat(gap);
            length += gap;
        }
        (gap, is_empty) = (0, false);
        out += word;
        length += long;
    }
    out.replace('\u{a0}', " ")
}

/// A text broken at spaces, every line from the margin.
pub(crate) fn flush(text: &str, width: usize) -> String {
    let lines: Vec<String> = text.lines().map(|line| broken(line, width, 0)).collect();
    lines.join("\n")
}

/// Every line of a text broken.
pub(crate) fn wrapped_lines(text: &str, width: usize) -> String {
    text.lines().map(|line| wrapped(line, width)).collect()
}

/// Columns of text, the first to the left and the others to the right. Columns for which there is
/// no room follow below, again behind the first.
pub(crate) fn aligned(rows: &[Vec<String>], width: usize) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> = (0..count)
        .map(|column| {
            let cells = rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| letters(cell)).max().unwrap_or(0)
        })
        .collect();
    let least = blocks(&widths, width).len();
    // as many blocks as it takes, about equally wide
    let even = (1..width).find(|narrower| blocks(&widths, *narrower).len() <= least);
    let parts: Vec<String> = blocks(&widths, even.unwrap_or(width))
        .into_iter()
        .map(|columns| block(rows, &widths, &columns))
        .collect();
    parts.join("\n")
}

/// The columns of each block: as many as have room, the first in every one.
fn blocks(widths: &[usize], width: usize) -> Vec<Vec<usize>> {
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    let mut used = 0;
    for (column, long) in widths.iter().enumerate().skip(1) {
        match blocks.last_mut() {
            Some(block) if used + 2 + long <= width => {
                used += 2 + long;
                block.push(column);
            }
            _ => {
                used = widths[0] + 2 + long;
                blocks.push(vec![0, column]);
            }
        }
    }
    if blocks.is_empty() {
        blocks.push((0..widths.len()).collect());
    }
    blocks
}

fn block(rows: &[Vec<String>], widths: &[usize], columns: &[usize]) -> String {
    let mut out = String::new();
    for row in rows {
        let mut line = String::new();
        for column in columns {
            let cell = row.get(*column).map_or("", String::as_str);
            let pad = " ".repeat(widths[*column] - letters(cell));
            if *column == 0 {
                line += &format!("{cell}{pad}");
            } else {
                line += &format!("  {pad}{cell}");
            }
        }
        out += line.trim_end();
        out.push('\n');
    }
    out
}

/// A row of a table.
pub(crate) fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

/// Header of a table of statistics.
pub(crate) const SPREAD_HEADER: [&str; 8] =
    ["error", "n", "mean", "std", "rms", "95 %", "99.7 %", "max"];

/// Statistics as a row of such a table.
pub(crate) fn spread_row(name: &str, of: &dyn Statistics) -> Vec<String> {
    let s = of.numbers();
    let mut row = vec![name.to_owned(), s.n.to_string()];
    // small errors have digits too
    let decimals = if s.max < 1e-3 { 7 } else { 3 };
    row.extend([s.mean, s.std, s.rms, s.p95, s.p997, s.max].map(|v| format!("{v:.decimals$}")));
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<String> {
        text.split_whitespace().map(str::to_owned).collect()
    }

    fn widest(text: &str) -> usize {
        text.lines().map(letters).max().unwrap_or(0)
    }

    #[test]
    fn long_lines_are_broken_at_spaces_and_keep_their_words() {
        let line = "  a line of many words that is wider than the terminal it stands on";
        let broken = wrapped(line, 40);
        assert!(widest(&broken) <= 40, "{broken}");
        assert!(broken.lines().skip(1).all(|line| line.starts_with("    ")));
        assert_eq!(words(&broken), words(line));
        assert_eq!(wrapped("  short", 40), "  short\n");
        // a word that is too long stands alone
        assert_eq!(wrapped("x yyyyyyyyyy z", 5), "x\n  yyyyyyyyyy\n  z\n");
    }

    #[test]
    fn what_stands_behind_a_label_stays_behind_it() {
        let line = "  clearance  never less than 76.8 mm; 0 moves touch something";
        let broken = wrapped(line, 40);
        assert!(widest(&broken) <= 40, "{broken}");
        assert!(
            broken
                .lines()
                .skip(1)
                .all(|l| l.starts_with("             ") && !l.starts_with("              "))
        );
        assert_eq!(words(&broken), words(line));
    }

    #[test]
    fn colours_take_no_room_and_spaces_that_do_not_break_do_not() {
        let line = &format!("{RED}error{PLAIN}[id]: a word and another");
        assert_eq!(wrapped(line, 29), format!("{line}\n"));
        assert_eq!(wrapped(line, 28).lines().count(), 2);
        assert!(coloured(line).starts_with("\x1b[1;31merror\x1b[0m[id]"));
        assert_eq!(wrapped("aaaa bb\u{a0}cc dd", 9), "aaaa\n  bb cc\n  dd\n");
    }

    #[test]
    fn a_table_without_room_goes_on_below_behind_its_first_column() {
        let rows: Vec<Vec<String>> = (0..3)
            .map(|row| {
                let cells = (0..8).map(|column| format!("{}", 1000 * row + column));
                std::iter::once(format!("name {row}"))
                    .chain(cells)
                    .collect()
            })
            .collect();
        assert_eq!(aligned(&rows, 80).lines().count(), 3);
        for width in [20, 30, 40, 50] {
            let text = aligned(&rows, width);
            assert!(widest(&text) <= width, "{text}");
            for cell in rows.iter().flatten() {
                assert!(text.contains(cell.as_str()), "{cell} is lost: {text}");
            }
            let first = text.lines().filter(|line| !line.is_empty());
            assert!(
                first.clone().all(|line| line.starts_with("name ")),
                "{text}"
            );
        }
        assert_eq!(aligned(&[vec!["alone".into()]], 80), "alone\n");
        assert_eq!(aligned(&[], 80), "");
    }
}
