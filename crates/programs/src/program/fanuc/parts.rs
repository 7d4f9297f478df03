//! Parts of a long section of points that are read side by side.
//!
//! A part begins at a line that begins with `P[`. It counts where the reader of what stands before
//! it comes to its first byte as to a point; else the text is read on from where that reader is.

use super::points::{Point, Points};
use crate::program::Number;
use rayon::prelude::*;
use std::ops::Range;

/// Bytes of a part, at least.
#[cfg(not(test))]
const SHORTEST: usize = 256 << 10;
#[cfg(test)]
const SHORTEST: usize = 256;

/// Points that were read ahead.
pub(super) struct Part {
    /// First byte.
    pub start: usize,
    /// Where the next point begins; one that is broken is not among these.
    pub end: usize,
    pub points: Vec<Point>,
    pub numbers: Vec<Number>,
}

/// The bytes that may be read ahead, in as many parts as there are processors but the first, which
/// reads what stands before them.
pub(super) fn parts(bytes: &[u8], start: usize) -> Vec<Range<usize>> {
    let length = bytes.len().saturating_sub(start);
    let count = rayon::current_num_threads().min(length / SHORTEST);
    let begins = memchr::memmem::Finder::new(b"\nP[");
    let starts = (1..count).filter_map(|at| {
        let from = start + length / count * at;
        let found = begins.find(&bytes[from..])?;
        Some(from + found + 1)
    });
    let mut starts: Vec<usize> = starts.collect();
    starts.dedup();
    let ends = starts.iter().skip(1).copied().chain([usize::MAX]);
    starts
        .iter()
        .copied()
        .zip(ends)
        .map(|(a, b)| a..b)
        .collect()
}

/// Reads parts side by side.
pub(super) fn read(bytes: &[u8], parts: &[Range<usize>]) -> Vec<Part> {
    let one = |part: &Range<usize>| {
        let mut reader = Points::new(bytes, part.start);
        let mut points = Vec::new();
        let mut end = part.start;
        while let Ok(point) = reader.next_before(part.end) {
            end = reader.at();
            match point {
                Some(point) => points.push(point),
                None => break,
            }
        }
        Part {
            start: part.start,
            end,
            points,
            numbers: reader.numbers,
        }
    };
    parts.par_iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const TEXTS: [&str; 9] = [
        "P[1]{\n   GP1:\n\tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n\tX =   400.000  mm,\tY =     0.000  mm,\tZ \
         =   300.000  mm,\n\tW =   180.000 deg,\tP =     0.000 deg,\tR =     0.000 deg\n};\n",
        "P[2:\"a ] name\"]{\n   GP1:\n\tUF : 1, UT : F,\n\tJ1=     0.000 deg,\tJ2=    10.000 deg,\tJ3=   -10.000 \
         deg,\n\tJ4=     0.000 deg,\tJ5=   -60.000 deg,\tJ6=     0.000 deg\n};\n",
        "P[3]{\n   GP2:\n\tUF : 0, UT : 1,\n\tJ1=     5.000 deg\n};\n",
        "P[4]{\n};\n",
        "! P[5]{\n",
        "\n;\n",
        "P[6]{\n   GP1:\n\tX =  broken\n};\n",
        "P[7]{ GP1: UF : 0,\nP[ 1 ] };\n",
        "/END\n",
    ];

    /// All points up to the end of the section or what is broken, and their numbers.
    fn read_all(bytes: &[u8], parts: &[Range<usize>]) -> (Vec<Point>, Vec<Number>, usize, bool) {
        let mut reader = Points::new(bytes, 0);
        let mut all = Vec::new();
        let limit = parts.first().map_or(usize::MAX, |part| part.start);
        for (limit, ahead) in [(limit, read(bytes, parts)), (usize::MAX, Vec::new())] {
            loop {
                match reader.next_before(limit) {
                    Ok(Some(point)) => all.push(point),
                    Ok(None) => break,
                    Err(_) => {
                        let at = reader.at();
                        return (all, reader.numbers, at, false);
                    }
                }
            }
            for part in ahead {
                match reader.take(part) {
                    Some(points) => all.extend(points),
                    None => break,
                }
            }
        }
        let at = reader.at();
        (all, reader.numbers, at, true)
    }

    proptest! {
        #[test]
        fn parts_read_ahead_give_the_same_points(texts in prop::collection::vec(0..TEXTS.len(), 1..30)) {
            // what is broken, or ends the section, is rare
            let texts = texts.into_iter().enumerate().map(|(at, text)| if at % 7 == 6 { text } else { text % 6 });
            let text: String = texts.map(|at| TEXTS[at]).collect();
            let starts: Vec<usize> = text.match_indices("\nP[").map(|(at, _)| at + 1).collect();
            let ends = starts.iter().skip(1).copied().chain([usize::MAX]);
            let parts: Vec<Range<usize>> = starts.iter().copied().zip(ends).map(|(a, b)| a..b).collect();
            prop_assert_eq!(read_all(text.as_bytes(), &parts), read_all(text.as_bytes(), &[]));
        }
    }
}
