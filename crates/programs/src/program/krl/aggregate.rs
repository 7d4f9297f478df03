//! Aggregates: `{X 1.0,Y 2.0,Z 3.0,A 0,B 90,C 0,S 2,T 35}`, `{E6AXIS: A1 0,...}`, keys in any case
//! and order.

use super::tokens::{Cursor, Kind, Token, bits_value, capitals};
use crate::program::kit::Fault;
use crate::program::script::short;
use crate::program::{Number, number};

/// Coordinates and angles beyond this are no robot's.
pub(super) const LARGEST: f64 = 1e6;
/// From here on the value of an external axis says that there is none.
const UNUSED: f64 = 8.9e9;
/// External axes in their order.
pub(super) const EXTERNAL: [&str; 6] = ["E1", "E2", "E3", "E4", "E5", "E6"];
/// S and T have fewer bits than this number needs.
const MOST_STATUS: f64 = 65_535.0;

/// The value of one component.
#[derive(Clone, Copy, Debug)]
pub(super) enum Field {
    /// A number, or a bit literal.
    Number(Number),
    /// `#NAME`; the name.
    Enum(Token),
    /// An aggregate inside; where it starts.
    Nested(usize),
    /// Anything else.
    Other,
}

/// Reads an aggregate: calls `visit` with each key in capitals and its value. Returns the type in
/// front of the colon.
///
/// # Errors
/// Where the aggregate is broken or `visit` says so.
pub(super) fn each(
    cursor: &mut Cursor,
    mut visit: impl FnMut(&[u8], Token, Field) -> Result<(), Fault>,
) -> Result<Option<Token>, Fault> {
    let open = cursor.at;
    let unclosed = Fault::unclosed(open, "an aggregate");
    cursor.take(b'{');
    let mut of_type = None;
    let mut ahead = *cursor;
    let first = ahead.next();
    if first.kind == Kind::Name && ahead.take(b':') {
        of_type = Some(first);
        *cursor = ahead;
    }
    if cursor.take(b'}') {
        return Ok(of_type);
    }
    loop {
        let key = cursor.next();
        if key.kind == Kind::End {
            return Err(unclosed);
        }
        if key.kind != Kind::Name {
            return Err(key.unexpected("a component"));
        }
        cursor.brackets()?;
        let (field, ended) = value(cursor).ok_or(unclosed)?;
        let mut buffer = [0; 24];
        visit(capitals(cursor.text(key), &mut buffer), key, field)?;
        if ended == b'}' {
            return Ok(of_type);
        }
    }
}

/// The value in front and the sign behind it, a comma or the closing brace, both taken; `None`
/// where the line ends.
fn value(cursor: &mut Cursor) -> Option<(Field, u8)> {
    let first = cursor.blanks();
    let start = cursor.at;
    let mut field = Field::Other;
    match first {
        b'-' | b'+' | b'.' | b'0'..=b'9' => {
            if let Some((value, length)) = number::parse_start(&cursor.bytes[start..cursor.end]) {
                cursor.at += length;
                field = Field::Number(spanned(start, length, value));
            } else {
                cursor.at += usize::from(matches!(first, b'-' | b'+'));
                let token = cursor.next();
                let text = &cursor.bytes[start..token.end as usize];
                if let Some(value) = number::parse(text) {
                    field = Field::Number(spanned(start, text.len(), value));
                }
            }
        }
        b'\'' => {
            let token = cursor.next();
            if let Some(value) = bits_value(cursor.text(token)) {
                let length = token.end as usize - start;
                field = Field::Number(spanned(start, length, f64::from(value)));
            }
        }
        b'#' => {
            cursor.at += 1;
            let name = cursor.next();
            if name.kind == Kind::Name {
                field = Field::Enum(name);
            }
        }
        b'{' => field = Field::Nested(start),
        b',' | b'}' => {
            cursor.at += 1;
            return Some((Field::Other, first));
        }
        _ => {}
    }
    match cursor.blanks() {
        end @ (b',' | b'}') if !matches!(field, Field::Other) => {
            cursor.at += 1;
            return Some((field, end));
        }
        _ => {}
    }
    // an expression, or something inside
    if !matches!(field, Field::Nested(_)) {
        field = Field::Other;
    }
    let mut depth = 0_u32;
    loop {
        let token = cursor.next();
        match token.kind {
            Kind::Sign(b'(' | b'[' | b'{') => depth += 1,
            Kind::Sign(b')' | b']') => depth = depth.saturating_sub(1),
            Kind::Sign(sign @ (b',' | b'}')) if depth == 0 => return Some((field, sign)),
            Kind::Sign(b'}') => depth -= 1,
            Kind::End => return None,
            _ => {}
        }
    }
}

fn spanned(start: usize, length: usize, value: f64) -> Number {
    Number {
        start: short(start),
        length: u16::try_from(length).unwrap_or(u16::MAX),
        value,
    }
}

const NOTHING: Number = Number {
    start: 0,
    length: 0,
    value: 0.0,
};

/// The components of a position or of axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aggregate {
    /// X Y Z A B C S T.
    pub position: [Number; 8],
    /// Which of them stand there, by bit.
    pub has: u8,
    /// A1 to A6.
    pub axes: [Number; 6],
    /// Which of them stand there, by bit.
    pub has_axes: u8,
    /// E1 to E6; not a number where it is an expression.
    pub external: [Option<f64>; 6],
    /// It says that it is AXIS or E6AXIS.
    pub is_of_axes: bool,
    /// A component is no number.
    pub computed: bool,
}

/// Bits of X Y Z A B C.
pub(super) const WHOLE: u8 = 0b11_1111;
/// Bit of S in [`Aggregate::has`].
pub(super) const STATUS: u8 = 1 << 6;
/// Bit of T.
pub(super) const TURN: u8 = 1 << 7;

impl Aggregate {
    /// Whether its components are axes.
    pub(super) fn is_axes(&self) -> bool {
        self.has_axes != 0 || self.is_of_axes
    }

    /// X Y Z A B C, where all stand there as numbers.
    pub(super) fn frame(&self) -> Option<[Number; 6]> {
        let whole = self.has & WHOLE == WHOLE && !self.computed;
        whole.then(|| std::array::from_fn(|i| self.position[i]))
    }

    /// See [`driven`].
    pub(super) fn driven(&self) -> impl Iterator<Item = (&'static str, f64)> {
        driven(&self.external)
    }
}

/// The external axes that are driven, and where to: absent and 9E+09 are axes that are not used.
pub(super) fn driven(external: &[Option<f64>; 6]) -> impl Iterator<Item = (&'static str, f64)> {
    let axes = EXTERNAL.into_iter().zip(*external);
    axes.filter_map(|(name, value)| Some((name, value.filter(|v| v.is_nan() || *v < UNUSED)?)))
}

/// Reads the aggregate of a position or of axes.
///
/// # Errors
/// Where it is broken.
pub(super) fn read(cursor: &mut Cursor) -> Result<Aggregate, Fault> {
    let mut found = Aggregate {
        position: [NOTHING; 8],
        has: 0,
        axes: [NOTHING; 6],
        has_axes: 0,
        external: [None; 6],
        is_of_axes: false,
        computed: false,
    };
    let of_type = each(cursor, |key, token, field| {
        let (list, mask, at): (&mut [Number], &mut u8, usize) = match *key {
            [letter] => {
                let Some(at) = b"XYZABCST".iter().position(|&known| known == letter) else {
                    found.computed = true;
                    return Ok(());
                };
                (&mut found.position, &mut found.has, at)
            }
            [b'A', digit @ b'1'..=b'6'] => (
                &mut found.axes,
                &mut found.has_axes,
                usize::from(digit - b'1'),
            ),
            [b'E', digit @ b'1'..=b'6'] => {
                found.external[usize::from(digit - b'1')] = Some(match field {
                    Field::Number(number) => number.value,
                    _ => f64::NAN,
                });
                return Ok(());
            }
            _ => {
                found.computed = true;
                return Ok(());
            }
        };
        if *mask & 1 << at != 0 {
            return Err(token.unexpected("a component that is not yet given"));
        }
        *mask |= 1 << at;
        match field {
            Field::Number(number) => {
                list[at] = check(number, at >= 6 && list.len() == 8)?;
            }
            _ => found.computed = true,
        }
        Ok(())
    })?;
    found.is_of_axes = of_type.is_some_and(|token| {
        let mut buffer = [0; 24];
        matches!(
            capitals(cursor.text(token), &mut buffer),
            b"AXIS" | b"E6AXIS"
        )
    });
    Ok(found)
}

fn check(number: Number, is_status: bool) -> Result<Number, Fault> {
    let wrong = |meaning, limit| Fault::BadValue {
        start: number.start,
        end: number.start + u32::from(number.length),
        meaning,
        limit,
    };
    if is_status {
        let whole = number.value.fract() == 0.0 && (0.0..=MOST_STATUS).contains(&number.value);
        if !whole {
            return Err(wrong(
                "status or turn",
                "it is a whole number from 0 to 65535",
            ));
        }
    } else if number.value.abs() >= LARGEST {
        return Err(wrong(
            "coordinate or angle",
            "the limit is 1000000 either way",
        ));
    }
    Ok(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Aggregate, Fault> {
        read(&mut Cursor {
            bytes: text.as_bytes(),
            at: 0,
            end: text.len(),
        })
    }

    #[test]
    fn keys_stand_in_any_case_and_order_with_or_without_a_type() {
        let found = parsed("{E6POS: z 3,Y -.5, x 1.0E-1 ,c 6,B +5,a 4,t 'B10',S 2,E1 q[1,2]}");
        let found = found.expect("an aggregate");
        let frame = found.frame().map(|numbers| numbers.map(|n| n.value));
        assert_eq!(frame, Some([0.1, -0.5, 3.0, 4.0, 5.0, 6.0]));
        assert_eq!(found.has, 0xff);
        let driven: Vec<_> = found.driven().collect();
        assert!(matches!(driven[..], [("E1", at)] if at.is_nan()));
        assert!((found.position[7].value - 2.0).abs() < 1e-12);
        assert_eq!(found.position[7].length, 5);
    }

    #[test]
    fn external_axes_that_are_not_used_are_absent_or_9e9() {
        let driven = |text: &str| -> Vec<(&str, f64)> {
            parsed(text).expect("an aggregate").driven().collect()
        };
        assert_eq!(driven("{X 1,E1 0.0,E2 9E+09,E3 9.0E9}"), [("E1", 0.0)]);
        assert_eq!(
            driven("{X 1,E1 0,E2 -1500.5}"),
            [("E1", 0.0), ("E2", -1500.5)]
        );
    }

    #[test]
    fn expressions_and_strange_keys_are_seen() {
        assert!(parsed("{X a+1,Y 2}").expect("an aggregate").computed);
        assert!(parsed("{X 1+1,Y 2}").expect("an aggregate").computed);
        assert!(parsed("{X - 1,Y 2}").expect("an aggregate").computed);
        assert!(parsed("{X 1,RX 2}").expect("an aggregate").computed);
        assert!(
            parsed("{X f({X 1},\"}\"),Y 2}")
                .expect("an aggregate")
                .computed
        );
        assert_eq!(parsed("{X 1,Y 2,Z 3}").expect("an aggregate").has, 0b111);
        assert!(parsed("{}").is_ok_and(|found| found.has == 0));
    }

    #[test]
    fn broken_ones_are_faults() {
        for text in [
            "{X 1,Y 2",
            "{X 1,,Y 2}",
            "{X 1,X 2}",
            "{X 1e7}",
            "{X 1,S -1}",
            "{X 1,T 2.5}",
            "{1,2}",
            "{X f(1}",
        ] {
            assert!(parsed(text).is_err(), "{text}");
        }
    }
}
