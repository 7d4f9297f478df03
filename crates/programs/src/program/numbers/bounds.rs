//! Counters of loops whose condition bounds them: `WHILE n<10`.

use super::super::quantity::{Quantity, is_letter};
use super::{Numbers, Site, rounds, word};

/// Where each round of a block begins, a number is below another, or above it.
#[derive(Debug)]
pub(super) struct Bound<W> {
    block: (u32, u32),
    number: u32,
    is_below: bool,
    limit: W,
}

impl<W> Numbers<W> {
    /// Each round of a block begins with a number below a limit, or above it.
    pub(in crate::program) fn bound(
        &mut self,
        block: (u32, u32),
        number: u32,
        is_below: bool,
        limit: W,
    ) {
        self.bounds.push(Bound {
            block,
            number,
            is_below,
            limit,
        });
    }

    /// How often at most a number grows by a write in a loop whose condition bounds it, from these
    /// values on.
    pub(super) fn rounds_within(
        &self,
        number: u32,
        site: &Site,
        by: &Quantity,
        start: &[Quantity],
        limit: &mut dyn FnMut(&W) -> Quantity,
    ) -> Option<u32> {
        if self.jumping.contains(&site.routine) || self.runs_inside_itself(site.routine) {
            return None;
        }
        let by = by.exact()?;
        let ends: Option<Vec<_>> = start.iter().map(Quantity::ends).collect();
        let ends = ends?.into_iter();
        let from = if by > 0.0 {
            ends.map(|(least, _)| least).reduce(f64::min)?
        } else {
            ends.map(|(_, greatest)| greatest).reduce(f64::max)?
        };
        site.blocks.iter().enumerate().find_map(|(at, block)| {
            let is_of = |bound: &&Bound<W>| {
                bound.block == (site.routine, block.number)
                    && self.one(bound.number) == number
                    && bound.is_below == (by > 0.0)
            };
            let bound = self.bounds.iter().find(is_of)?;
            // so often in one round
            let each = site.blocks[at + 1..]
                .iter()
                .try_fold(1_u32, |each, inner| {
                    let is_bounded = !self.unbounded.contains(&(site.routine, inner.number));
                    Some(each.saturating_mul(inner.most.filter(|_| is_bounded)?))
                })?;
            let (least, greatest) = limit(&bound.limit).ends()?;
            let to = if by > 0.0 { greatest } else { least };
            Some(rounds(from, to, by)?.saturating_add(each - 1))
        })
    }
}

/// What a condition says of names in each of its parts that `AND` joins: the name, whether it is
/// below what is behind (`n<10`, `n<=m`, `10>n`), and that.
pub(in crate::program) fn bounds_in(condition: &[u8]) -> Vec<(&[u8], bool, &[u8])> {
    let capitals = condition.to_ascii_uppercase();
    if word(&capitals, "OR").is_some() || word(&capitals, "NOT").is_some() {
        return Vec::new();
    }
    let (mut all, mut from) = (Vec::new(), 0);
    loop {
        let and = word(&capitals[from..], "AND");
        let part = &condition[from..and.map_or(condition.len(), |at| from + at)];
        all.extend(bound_in(part));
        match and {
            Some(at) => from += at + 3,
            None => return all,
        }
    }
}

fn bound_in(mut part: &[u8]) -> Option<(&[u8], bool, &[u8])> {
    part = part.trim_ascii();
    while let Some(inside) = part
        .strip_prefix(b"(")
        .and_then(|part| part.strip_suffix(b")"))
    {
        part = inside.trim_ascii();
    }
    let at = part.iter().position(|b| matches!(b, b'<' | b'>'))?;
    let is_below = part[at] == b'<';
    let behind = part[at + 1..].strip_prefix(b"=").unwrap_or(&part[at + 1..]);
    let [before, behind] = [&part[..at], behind].map(<[u8]>::trim_ascii);
    // n<>10, and brackets that do not stand around the whole
    let is_one = |text: &[u8]| {
        let open = memchr::memchr_iter(b'(', text).count();
        !text.is_empty()
            && !text.iter().any(|b| matches!(b, b'<' | b'>' | b'='))
            && open == memchr::memchr_iter(b')', text).count()
    };
    if !is_one(before) || !is_one(behind) {
        return None;
    }
    let is_name = |text: &[u8]| text.iter().all(|b| is_letter(*b)) && !text[0].is_ascii_digit();
    if is_name(before) {
        return Some((before, is_below, behind));
    }
    is_name(behind).then_some((behind, !is_below, before))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_bound_names() {
        let of = |text: &str| -> Vec<(String, bool, String)> {
            let owned = |text: &[u8]| String::from_utf8_lossy(text).into_owned();
            bounds_in(text.as_bytes())
                .into_iter()
                .map(|(name, is_below, limit)| (owned(name), is_below, owned(limit)))
                .collect()
        };
        let one =
            |name: &str, is_below: bool, limit: &str| (name.to_owned(), is_below, limit.to_owned());
        assert_eq!(of(" n<10 "), [one("n", true, "10")]);
        assert_eq!(of("(n <= 2*m) and di1=1"), [one("n", true, "2*m")]);
        assert_eq!(
            of("0<n AND m>-5"),
            [one("n", false, "0"), one("m", false, "-5")]
        );
        for text in [
            "n<10 OR x",
            "NOT n<10",
            "n<>10",
            "n=10",
            "TRUE",
            "(n<10",
            "f(n)<10",
        ] {
            assert_eq!(of(text), [], "{text}");
        }
    }
}
