//! OBJ: faces with notches as triangles, which the crate cuts from their first corner.

use super::polygons::cut;
use crate::geometry::Vector;
use std::borrow::Cow;
use std::ops::Range;

/// The same mesh with lines that go on in the next joined, concave faces as triangles, and faces without
/// comments behind them. What it does not understand stays; what would be a shape that is not looked at
/// is an error.
pub(super) fn with_triangles(bytes: &[u8]) -> Result<Cow<'_, [u8]>, String> {
    let joined = joined(bytes);
    let mut corners: Vec<Vector> = Vec::new();
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    let mut start = 0;
    for (number, line) in (1..).zip(joined.split_inclusive(|byte| *byte == b'\n')) {
        let range = start..start + line.trim_ascii_end().len();
        start += line.len();
        let Ok(text) = std::str::from_utf8(&joined[range.clone()]) else {
            continue;
        };
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let given: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
                if let [_, _, _, weight] = given[..]
                    && weight != 1.0
                {
                    return Err(format!(
                        "corner {} in line {number} has the weight {weight}, which is for curves: \
                         write corners without",
                        corners.len() + 1
                    ));
                }
                let number = |at: usize| given.get(at).copied().unwrap_or(f64::NAN);
                corners.push(std::array::from_fn(number));
            }
            Some("f") => {
                let plain = text.split('#').next().unwrap_or_default();
                let face: Vec<&str> = plain.split_ascii_whitespace().skip(1).collect();
                if face.iter().any(|word| word.split('/').next() == Some("0")) {
                    return Err(format!(
                        "a face in line {number} has a corner 0: they count from 1"
                    ));
                }
                let without =
                    || (plain.len() < text.len()).then(|| format!("f {}", face.join(" ")));
                let lines = in_triangles(&face, &corners).or_else(without);
                edits.extend(lines.map(|lines| (range, lines)));
            }
            Some("surf") => {
                return Err(format!(
                    "line {number} is a free-form surface, which is not read: export triangles"
                ));
            }
            _ => {}
        }
    }
    if edits.is_empty() {
        return Ok(joined);
    }
    let mut out = Vec::with_capacity(joined.len());
    let mut end = 0;
    for (range, lines) in edits {
        out.extend_from_slice(&joined[end..range.start]);
        out.extend_from_slice(lines.as_bytes());
        end = range.end;
    }
    out.extend_from_slice(&joined[end..]);
    Ok(Cow::Owned(out))
}

/// A face of more than three corners in lines of triangles, where it is not cut from its first one.
fn in_triangles(face: &[&str], corners: &[Vector]) -> Option<String> {
    if face.len() < 4 {
        return None;
    }
    let place = |word: &&str| {
        let number: i64 = word.split('/').next()?.parse().ok()?;
        // they count from 1, or back from the last
        let at = match number {
            1.. => usize::try_from(number - 1).ok()?,
            _ => corners.len().checked_sub(usize::try_from(-number).ok()?)?,
        };
        corners.get(at).copied()
    };
    let places: Option<Vec<Vector>> = face.iter().map(place).collect();
    let triangles = cut(&places?);
    let is_fan = |(k, triangle): (usize, &[usize; 3])| *triangle == [0, k + 1, k + 2];
    if triangles.iter().enumerate().all(is_fan) {
        return None;
    }
    let line = |of: &[usize; 3]| {
        let [a, b, c] = of.map(|k| face[k]);
        format!("f {a} {b} {c}")
    };
    let lines: Vec<String> = triangles.iter().map(line).collect();
    Some(lines.join("\n"))
}

/// Lines that end with `\` and the next as one.
fn joined(bytes: &[u8]) -> Cow<'_, [u8]> {
    let ends = [&b"\\\n"[..], b"\\\r\n"];
    let mut out = Cow::Borrowed(bytes);
    for end in ends {
        if memchr::memmem::find(&out, end).is_none() {
            continue;
        }
        let mut whole = Vec::with_capacity(out.len());
        let mut from = 0;
        for at in memchr::memmem::find_iter(&out, end) {
            whole.extend_from_slice(&out[from..at]);
            whole.push(b' ');
            from = at + end.len();
        }
        whole.extend_from_slice(&out[from..]);
        out = Cow::Owned(whole);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn concave_faces_are_triangles_and_all_else_stays() {
        let corners = "v 0 0 0\nv 6 0 0\nv 6 6 0\r\nv 3 1 0\nv 0 6 0\n";
        let text = |face: &str| format!("# a\n{corners}usemtl x\n{face}\nf 1 2 3\n");
        for (face, count) in [
            ("f 1 2 3 4 5", 3),
            ("f 1/1/1 2/2/2 3/3/3 4//4 5", 3),
            ("f -5 -4 \\\n-3 -2 -1", 3),
            ("f 1 2 3 4 5 # a face", 3),
        ] {
            let text = text(face);
            let made = with_triangles(text.as_bytes()).expect("a mesh");
            let made = std::str::from_utf8(&made).expect("text");
            let faces: Vec<&str> = made.lines().filter(|line| line.starts_with("f ")).collect();
            assert_eq!(faces.len(), count + 1, "{made}");
            assert!(
                faces.iter().all(|line| line.split(' ').count() == 4),
                "{made}"
            );
            assert!(made.starts_with(&format!("# a\n{corners}usemtl x\n")));
        }
        for face in ["f 1 2 3 5", "f 1 2 3 9 5", "f 1 2 x 4 5", "f"] {
            let text = text(face);
            let made = with_triangles(text.as_bytes());
            assert_eq!(made.as_deref(), Ok(text.as_bytes()), "{face}");
        }
        let made = with_triangles(b"f 1 2 3# x\nf 1 2 3 # f 4\n");
        assert_eq!(made.as_deref(), Ok(&b"f 1 2 3\nf 1 2 3\n"[..]));
    }

    #[test]
    fn shapes_that_would_not_be_looked_at_are_errors() {
        let of = |line: &str| with_triangles(line.as_bytes()).map(|_| ());
        for (line, said) in [
            ("v 1 2 3 2.0\n", "corner 1 in line 1 has the weight 2"),
            ("v 1 2 3\nf 0 1 2 3\n", "line 2 has a corner 0"),
            ("\nsurf 0 1 0 1 1 2 3 4\n", "line 2 is a free-form surface"),
        ] {
            let error = of(line).expect_err(line);
            assert!(error.contains(said), "{error}");
        }
        for line in [
            "v 1 2 3 1.0\n",
            "v 1 2 3 # 4\n",
            "v 1 2 3 0.5 0.5 0.5\n",
            "surface\n",
        ] {
            assert_eq!(of(line), Ok(()), "{line}");
        }
    }
}
