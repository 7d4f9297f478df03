//! Numbers in program text: read, and written again in the style of what stood there.

use super::Number;
use super::script::short;

/// Digits after the point that a number may get at most: what a 64-bit number holds.
pub const MOST_DECIMALS: usize = 17;
/// Decimals of a number whose group has no number in fixed notation: controllers print six digits.
const CONTROLLER_DECIMALS: usize = 6;
/// Below this a number whose old text had an exponent is written with one again.
const EXPONENT_BELOW: f64 = 1e-4;

/// The value of a decimal number: `12`, `-.5`, `3.`, `+1.5E-04`. `None` where the text is anything
/// else or not finite.
#[must_use]
pub fn parse(text: &[u8]) -> Option<f64> {
    if let Some((value, length)) = parse_start(text)
        && length == text.len()
    {
        return Some(value);
    }
    let digits = text
        .iter()
        .all(|b| matches!(b, b'0'..=b'9' | b'.' | b'+' | b'-' | b'e' | b'E'));
    let text = std::str::from_utf8(text).ok().filter(|_| digits)?;
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

/// The number that is all of a text, which begins at a byte of its file.
pub(crate) fn placed(text: &[u8], start: usize) -> Option<Number> {
    Some(Number {
        start: short(start),
        length: u16::try_from(text.len()).ok()?,
        value: parse(text)?,
    })
}

/// Powers of ten that a 64-bit number holds exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// The value and length of the number that `text` starts with, where its digits make a whole number
/// below 2^53 and its power of ten is at most 22: one exact product or quotient rounds it as well
/// as any longer way does. `None` for all others, and where no number stands.
///
/// # Source
/// W. D. Clinger, "How to read floating point numbers accurately", PLDI 1990, section 5.
#[inline]
#[must_use]
pub fn parse_start(text: &[u8]) -> Option<(f64, usize)> {
    let first = text.first()?;
    let sign = usize::from(matches!(first, b'+' | b'-'));
    let (mut whole, mut at) = digits(text, sign, 0);
    let (mut count, mut power) = (at - sign, 0);
    if text.get(at) == Some(&b'.') {
        let point = at + 1;
        (whole, at) = digits(text, point, whole);
        count += at - point;
        power = i32::try_from(point).ok()? - i32::try_from(at).ok()?;
    }
    // 18 digits cannot overflow
    if !(1..=18).contains(&count) || whole >= 1 << 53 {
        return None;
    }
    if let Some(b'e' | b'E') = text.get(at) {
        let negative = text.get(at + 1) == Some(&b'-');
        at += 1 + usize::from(negative || text.get(at + 1) == Some(&b'+'));
        let exponent = text[at..].iter().take(4).take_while(|b| b.is_ascii_digit());
        let (mut size, mut length) = (0_i32, 0);
        for byte in exponent {
            size = 10 * size + i32::from(byte - b'0');
            length += 1;
        }
        if !(1..=3).contains(&length) {
            return None;
        }
        at += length;
        power += if negative { -size } else { size };
    }
    let scale = EXACT_POWERS.get(power.unsigned_abs() as usize)?;
    // below 2^53 every whole number is exact
    #[allow(clippy::cast_precision_loss)]
    let whole = whole as f64;
    let value = if power < 0 {
        whole / scale
    } else {
        whole * scale
    };
    Some((if *first == b'-' { -value } else { value }, at))
}

/// The digits from `at` on behind those of `whole`, and where they end; more than 19 overflow.
#[inline]
fn digits(text: &[u8], mut at: usize, mut whole: u64) -> (u64, usize) {
    while let Some(digit) = text.get(at).map(|byte| byte.wrapping_sub(b'0'))
        && digit < 10
    {
        whole = whole.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    (whole, at)
}

/// The whole number without sign that `text` starts with, and how many digits it has: nine at most.
pub(crate) fn whole_start(text: &[u8]) -> Option<(u32, usize)> {
    let digits = text.iter().take_while(|b| b.is_ascii_digit()).count();
    (1..=9).contains(&digits).then(|| {
        let text = text[..digits].iter();
        let value = text.fold(0, |value, b| 10 * value + u32::from(b - b'0'));
        (value, digits)
    })
}

/// The whole number without sign that is all of a text.
pub(crate) fn whole(text: &[u8]) -> Option<u32> {
    let (value, digits) = whole_start(text)?;
    (digits == text.len()).then_some(value)
}

/// How the numbers of one file write magnitudes below one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fraction {
    /// `0.5`
    Zero,
    /// `.5`
    Bare,
}

impl Fraction {
    /// The habit this text shows; `None` where its magnitude is not below one or it has no point.
    #[must_use]
    pub fn shown_by(text: &[u8]) -> Option<Self> {
        match unsigned(text) {
            [b'.', ..] => Some(Self::Bare),
            [b'0', b'.', rest @ ..] if rest.iter().any(|b| matches!(b, b'1'..=b'9')) => {
                Some(Self::Zero)
            }
            _ => None,
        }
    }
}

/// How the numbers of one group (the coordinates of one position, the parts of one orientation) are
/// written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// Digits after the point.
    pub decimals: usize,
    /// Magnitudes below one.
    pub fraction: Fraction,
}

impl Style {
    /// The style of a group: as many decimals as its most precise number in fixed notation has, so
    /// that a `0` or `500` among numbers with decimals is not taken for one that may not have
    /// any. `at_least` raises them.
    pub fn of_group<'a>(
        texts: impl Iterator<Item = &'a [u8]>,
        at_least: usize,
        fraction: Fraction,
    ) -> Self {
        Self::of_most(
            texts.map(fixed_decimals).max().flatten(),
            at_least,
            fraction,
        )
    }

    /// The style of a group whose most precise number has so many decimals, if any is in fixed
    /// notation.
    pub(crate) fn of_most(most: Option<usize>, at_least: usize, fraction: Fraction) -> Self {
        let decimals = most.unwrap_or(CONTROLLER_DECIMALS).max(at_least);
        Self {
            decimals: decimals.min(MOST_DECIMALS),
            fraction,
        }
    }

    /// Appends `value` in this style, with the sign habit, exponent letter and column width of the
    /// text it replaces.
    ///
    /// A field that starts with blanks keeps its last column where the new number fits. Zero never
    /// gets a minus sign, and an exponent is written only where the old text had one and the
    /// number is below 1e-4.
    pub fn write(self, old: &[u8], value: f64, out: &mut Vec<u8>) {
        let start = out.len();
        let text = trimmed(old);
        match exponent_at(text) {
            Some(at) if value != 0.0 && value.abs() < EXPONENT_BELOW => {
                write_exponent(&text[..at], &text[at..], value, out);
            }
            _ => write_fixed(value, self.decimals, out),
        }
        if text.first() == Some(&b'+') && value >= 0.0 {
            out.insert(start, b'+');
        }
        if self.fraction == Fraction::Bare && value != 0.0 && exponent_at(&out[start..]).is_none() {
            drop_leading_zero(out, start);
        }
        if self.decimals == 0 && text.last() == Some(&b'.') {
            out.push(b'.');
        }
        if old.len() > text.len() {
            let padding = old.len().saturating_sub(out.len() - start).max(1);
            out.splice(start..start, std::iter::repeat_n(b' ', padding));
        }
    }
}

fn trimmed(text: &[u8]) -> &[u8] {
    text.trim_ascii_start()
}

fn unsigned(text: &[u8]) -> &[u8] {
    let text = trimmed(text);
    text.strip_prefix(b"+")
        .or_else(|| text.strip_prefix(b"-"))
        .unwrap_or(text)
}

fn exponent_at(text: &[u8]) -> Option<usize> {
    text.iter().position(|b| matches!(b, b'e' | b'E'))
}

/// The decimals of a number in fixed notation; `None` where it has an exponent.
pub(crate) fn fixed_decimals(text: &[u8]) -> Option<usize> {
    // an exponent stands behind the point
    for (behind, byte) in text.iter().rev().enumerate() {
        match byte {
            b'e' | b'E' => return None,
            b'.' => return Some(behind),
            _ => {}
        }
    }
    Some(0)
}

fn decimals(text: &[u8]) -> usize {
    text.iter()
        .position(|&b| b == b'.')
        .map_or(0, |point| text.len() - point - 1)
}

/// Removes the `0` of `0.5` and `-0.5` behind `start`; leaves an exact zero alone.
fn drop_leading_zero(digits: &mut Vec<u8>, start: usize) {
    let at = start + usize::from(matches!(digits.get(start), Some(b'+' | b'-')));
    if digits.get(at) == Some(&b'0')
        && digits.get(at + 1) == Some(&b'.')
        && digits[start..].iter().any(|b| matches!(b, b'1'..=b'9'))
    {
        digits.remove(at);
    }
}

fn write_fixed(value: f64, decimals: usize, out: &mut Vec<u8>) {
    const POWERS: [f64; 16] = [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
    ];
    const EXACT: f64 = 9_007_199_254_740_992.0;
    let scaled = POWERS
        .get(decimals)
        .map_or(f64::INFINITY, |power| (value.abs() * power).round());
    if scaled >= EXACT {
        let text = format!("{value:.decimals$}");
        let zero = !text.bytes().any(|b| matches!(b, b'1'..=b'9'));
        out.extend_from_slice(
            if zero {
                text.trim_start_matches('-')
            } else {
                &text
            }
            .as_bytes(),
        );
        return;
    }
    // below 2^53 the product is a whole number without loss
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let whole = scaled as u64;
    if value < 0.0 && whole != 0 {
        out.push(b'-');
    }
    // from the last digit on: at most 16, and zeros up to the one before the point
    let mut digits = [b'0'; 18];
    let (mut at, mut rest) = (digits.len(), whole);
    while rest > 0 {
        at -= 1;
        #[allow(clippy::cast_possible_truncation)]
        let digit = (rest % 10) as u8;
        digits[at] += digit;
        rest /= 10;
    }
    let point = digits.len() - decimals;
    out.extend_from_slice(&digits[at.min(point - 1)..point]);
    if decimals > 0 {
        out.push(b'.');
        out.extend_from_slice(&digits[point..]);
    }
}

/// Mantissa digits as in the old text, exponent letter, sign and width too: `7.16612E-05`, `-9E-9`.
fn write_exponent(old_mantissa: &[u8], old_exponent: &[u8], value: f64, out: &mut Vec<u8>) {
    let text = format!(
        "{value:.*e}",
        decimals(old_mantissa).max(CONTROLLER_DECIMALS - 1)
    );
    let (mantissa, exponent) = text.split_once('e').expect("the format has an exponent");
    let power = exponent.trim_start_matches('-');
    let width = old_exponent[1..]
        .iter()
        .filter(|b| b.is_ascii_digit())
        .count();
    out.extend_from_slice(mantissa.as_bytes());
    out.push(old_exponent[0]);
    out.push(b'-');
    out.extend(std::iter::repeat_n(b'0', width.saturating_sub(power.len())));
    out.extend_from_slice(power.as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(old: &str, siblings: &[&str], value: f64) -> String {
        let texts = siblings.iter().chain([&old]).map(|t| t.as_bytes());
        let fraction = Fraction::shown_by(old.as_bytes()).unwrap_or(Fraction::Zero);
        let mut out = Vec::new();
        Style::of_group(texts, 0, fraction).write(old.as_bytes(), value, &mut out);
        String::from_utf8(out).expect("digits")
    }

    #[test]
    fn decimals_signs_and_zeros_follow_the_old_text() {
        for (old, value, new) in [
            ("583.66", 583.7049, "583.70"),
            ("583.66", -0.001, "0.00"),
            ("500", 499.6, "500"),
            ("500.", 499.6, "500."),
            ("0.000", -12.3456, "-12.346"),
            ("-.287", -0.2864, "-.286"),
            (".193", 0.0, "0.000"),
            (".193", 1.5, "1.500"),
            ("+12.50", 12.625, "+12.63"),
            ("0.60710678118654757", 0.607_106_78, "0.60710677999999996"),
            ("1.0", 99_999_999.96, "100000000.0"),
        ] {
            assert_eq!(written(old, &[], value), new, "{old} becomes {value}");
        }
    }

    #[test]
    fn a_short_number_gets_the_decimals_of_its_siblings() {
        assert_eq!(written("0", &["583.66", "-1.2"], 0.127), "0.13");
        assert_eq!(written("1", &["0", "0"], 0.99), "1");
    }

    #[test]
    fn exponents_stay_small_numbers_and_become_fixed_when_large() {
        assert_eq!(
            written("7.16612E-05", &["0.707107"], 1.234_567e-5),
            "1.23457E-05"
        );
        assert_eq!(written("-9E-9", &["0.707107"], -3.1e-8), "-3.10000E-8");
        assert_eq!(written("7.16612E-05", &["0.707107"], 0.0012), "0.001200");
        assert_eq!(written("2.204e-14", &[], 0.25), "0.250000");
        assert_eq!(written("0.000012", &[], 0.000_001_2), "0.000001");
    }

    #[test]
    fn a_field_keeps_its_last_column() {
        assert_eq!(written("  1922.978", &[], -54.3281), "   -54.328");
        assert_eq!(written(" 9.999", &[], 12_345.678), " 12345.678");
    }

    #[test]
    fn only_finite_plain_numbers_are_read() {
        for (text, value) in [
            ("12", 12.0),
            ("-.5", -0.5),
            ("3.", 3.0),
            ("+1.5E-04", 1.5e-4),
            ("9E9", 9e9),
        ] {
            assert_eq!(parse(text.as_bytes()), Some(value));
        }
        for text in [
            "0.1",
            "-0.70710678",
            "9007199254740991",
            "9007199254740993",
            "0.00000000000000000001",
        ] {
            assert_eq!(parse(text.as_bytes()), text.parse().ok(), "{text}");
        }
        assert!(parse(b"-0").is_some_and(f64::is_sign_negative));
        for text in [
            "", "-", ".", " 1", "1e400", "nan", "inf", "1,5", "0x10", "--1", "1_000",
        ] {
            assert_eq!(parse(text.as_bytes()), None, "{text}");
        }
    }
}
