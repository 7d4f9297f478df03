//! What a number of a program comes to, as far as the text tells: sums and products of numbers of
//! the text, of what loops count, and of what only the running program knows.
//!
//! All that a number may be is looked at, and more where that is simpler: two numbers count as if
//! each went its own way.

use super::TargetId;
use super::coordinates_read::Readings;
use super::number;

/// A number: `first`, with each of the steps made none or more times, and what only the running
/// program knows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Quantity {
    pub first: f64,
    pub steps: Vec<Step>,
    pub unknown: Option<Unknown>,
    /// Coordinates of targets in it, as they stand in the files.
    pub readings: Readings,
    /// How often the number itself that is assigned stands in it.
    own: f64,
}

/// A step, made 0 times up to `most`; `None` where nothing bounds that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    pub by: f64,
    pub most: Option<u32>,
}

/// What only the running program knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unknown {
    /// The product of the numbers in the text that it is multiplied by.
    scale: f64,
    /// Whether there are any.
    is_of_text: bool,
    /// It is added again and again.
    pub is_endless: bool,
}

/// So many steps are looked at between the ends of what is known by its ends alone.
const SPAN: u32 = 4096;
/// Brackets in brackets that are followed.
const DEEPEST: u32 = 32;
/// Numbers that are less apart are one.
const SAME: f64 = 1e-12;

impl Quantity {
    pub(super) fn exactly(first: f64) -> Self {
        Self {
            first,
            steps: Vec::new(),
            unknown: None,
            readings: Readings::default(),
            own: 0.0,
        }
    }

    /// A coordinate of a target.
    pub(super) fn coordinate(value: f64, target: TargetId, part: u8) -> Self {
        Self {
            readings: Readings::of(target, part),
            ..Self::exactly(value)
        }
    }

    /// Without the readings in it, and these.
    fn read_apart(mut self) -> (Self, Readings) {
        let readings = std::mem::take(&mut self.readings);
        (self, readings)
    }

    /// The greatest that it is, whatever its sign.
    fn largest(&self) -> Option<f64> {
        self.ends().map(|(a, b)| a.abs().max(b.abs()))
    }

    /// `first`, and up to so many times `by` more.
    pub(super) fn counted(first: f64, by: f64, most: Option<u32>) -> Self {
        let mut steps = vec![Step { by, most }];
        steps.retain(|step| step.by != 0.0 && step.most != Some(0));
        Self {
            steps,
            ..Self::exactly(first)
        }
    }

    /// What only the running program knows.
    pub(super) fn unknown() -> Self {
        Self {
            unknown: Some(Unknown {
                scale: 1.0,
                is_of_text: false,
                is_endless: false,
            }),
            ..Self::exactly(0.0)
        }
    }

    /// Likewise, and nothing bounds it.
    pub(super) fn endless() -> Self {
        let mut endless = Self::unknown();
        endless.unknown = endless.unknown.map(|unknown| Unknown {
            is_endless: true,
            ..unknown
        });
        endless
    }

    /// The number that is assigned, in what is assigned to it.
    pub(super) fn own() -> Self {
        Self {
            own: 1.0,
            ..Self::exactly(0.0)
        }
    }

    /// How often the number that is assigned stands in this, and the rest.
    pub(super) fn apart(self) -> (f64, Self) {
        (self.own, Self { own: 0.0, ..self })
    }

    /// The one number that it is, whatever becomes of targets.
    pub(super) fn exact(&self) -> Option<f64> {
        let is_one = self.steps.is_empty() && self.unknown.is_none() && self.own == 0.0;
        (is_one && self.readings.is_empty())
            .then_some(self.first)
            .filter(|first| first.is_finite())
    }

    /// Whether only the running program knows it, and the text tells no part of it but 0.
    pub(super) fn is_sensed(&self) -> bool {
        let of_text = self.first != 0.0 || self.own != 0.0 || !self.steps.is_empty();
        let is_plain = |unknown: Unknown| !unknown.is_of_text && !unknown.is_endless;
        !of_text && self.unknown.is_some_and(is_plain)
    }

    pub(super) fn is_endless(&self) -> bool {
        self.unknown.is_some_and(|unknown| unknown.is_endless)
    }

    /// Whether the number that is assigned stands in it, or what is added again and again.
    pub(super) fn adds_up(&self) -> bool {
        let is_unbounded = self.steps.iter().any(|step| step.most.is_none());
        self.own != 0.0 || self.is_endless() || is_unbounded
    }

    /// The least and the greatest that it is; `None` where nothing bounds it.
    pub(super) fn ends(&self) -> Option<(f64, f64)> {
        if self.unknown.is_some() || self.own != 0.0 || !self.readings.is_empty() {
            return None;
        }
        self.known_ends()
    }

    /// Likewise, of what the text tells.
    fn known_ends(&self) -> Option<(f64, f64)> {
        let (mut least, mut most) = (self.first, self.first);
        for step in &self.steps {
            let all = step.by * f64::from(step.most?);
            (least, most) = (least + all.min(0.0), most + all.max(0.0));
        }
        Some((least, most))
    }

    /// Whether the text tells any of it, and be it that it is nothing.
    pub(super) fn is_of_program(&self) -> bool {
        let is_known = self.unknown.is_none() || self.first != 0.0 || !self.steps.is_empty();
        is_known || self.own != 0.0 || self.is_endless() || self.of_text() > 0.0
    }

    /// What the numbers of the text in the unknown part come to.
    pub(super) fn of_text(&self) -> f64 {
        let of_text = self.unknown.filter(|unknown| unknown.is_of_text);
        of_text.map_or(0.0, |unknown| unknown.scale)
    }

    /// What all numbers of the text come to, whatever their signs; one that adds up counts once.
    fn magnitude(&self) -> f64 {
        let steps = self.steps.iter();
        let steps = steps.map(|step| (step.by * f64::from(step.most.unwrap_or(1))).abs());
        self.first.abs() + steps.sum::<f64>() + self.of_text()
    }

    pub(super) fn times(mut self, factor: f64) -> Self {
        if factor == 0.0 {
            return Self::exactly(0.0);
        }
        self.first *= factor;
        self.own *= factor;
        self.readings = self.readings.times(factor);
        for step in &mut self.steps {
            step.by *= factor;
        }
        if let Some(unknown) = &mut self.unknown {
            unknown.scale *= factor.abs();
            unknown.is_of_text |= (factor.abs() - 1.0).abs() > SAME;
        }
        self
    }

    /// In another unit: that is no factor of the text.
    pub(super) fn in_unit(self, unit: f64) -> Self {
        let is_of_text = self.unknown.is_some_and(|unknown| unknown.is_of_text);
        let mut scaled = self.times(unit);
        if let Some(unknown) = &mut scaled.unknown {
            unknown.is_of_text = is_of_text;
        }
        scaled
    }

    pub(super) fn plus(mut self, other: Self) -> Self {
        self.first += other.first;
        self.own += other.own;
        self.readings = self.readings.plus(other.readings);
        self.steps.extend(other.steps);
        self.unknown = match (self.unknown, other.unknown) {
            (Some(a), Some(b)) => {
                let of_text = |of: Unknown| if of.is_of_text { of.scale } else { 0.0 };
                let is_of_text = a.is_of_text || b.is_of_text;
                Some(Unknown {
                    scale: if is_of_text {
                        of_text(a) + of_text(b)
                    } else {
                        1.0
                    },
                    is_of_text,
                    is_endless: a.is_endless || b.is_endless,
                })
            }
            (a, b) => a.or(b),
        };
        self.tidied()
    }

    /// One step that is bounded at most, and one each way that is not.
    fn tidied(mut self) -> Self {
        if let [first, others @ ..] = &mut self.steps[..]
            && others.iter().all(|step| step.by == first.by)
            && let Some(most) = others
                .iter()
                .try_fold(first.most, |sum, step| Some(sum?.checked_add(step.most?)))
        {
            first.most = most;
            self.steps.truncate(1);
        }
        let bounded = |step: &&Step| step.most.is_some();
        if self.steps.iter().filter(bounded).count() > 1 {
            let (mut bounded, mut endless) = (Self::exactly(self.first), Vec::new());
            for step in std::mem::take(&mut self.steps) {
                if step.most.is_some() {
                    bounded.steps.push(step);
                } else {
                    endless.push(step);
                }
            }
            if let Some((least, most)) = bounded.known_ends() {
                let span = Self::between(least, most);
                (self.first, self.steps) = (span.first, span.steps);
            }
            self.steps.extend(endless);
        }
        for sign in [1.0, -1.0] {
            let is = |step: &Step| step.most.is_none() && step.by * sign > 0.0;
            let nearest = self.steps.iter().filter(|step| is(step));
            let nearest = nearest.map(|step| step.by.abs()).reduce(f64::min);
            if let Some(by) = nearest {
                self.steps.retain(|step| !is(step));
                self.steps.push(Step {
                    by: sign * by,
                    most: None,
                });
            }
        }
        self
    }

    /// Anything between two numbers.
    pub(super) fn between(least: f64, most: f64) -> Self {
        let (near, far) = by_size(least, most);
        Self::counted(near, (far - near) / f64::from(SPAN), Some(SPAN))
    }

    /// Any whole number from one to another.
    pub(super) fn whole_between(least: f64, most: f64) -> Self {
        let (near, far) = by_size(least, most);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let steps = (most - least).abs() as u32;
        Self::counted(near, (far - near).signum(), Some(steps))
    }

    /// Whether it is a whole number, whatever it is.
    fn is_whole(&self) -> bool {
        let mut parts = self.steps.iter().map(|step| step.by).chain([self.first]);
        self.unknown.is_none() && self.own == 0.0 && parts.all(|part| part.fract() == 0.0)
    }

    pub(super) fn by(self, other: Self) -> Self {
        if self.readings.is_empty() && other.readings.is_empty() {
            return self.by_known(other);
        }
        let ((one, of_one), (two, of_two)) = (self.read_apart(), other.read_apart());
        let scaled = |readings: Readings, by: &Self| match (by.exact(), by.largest()) {
            _ if readings.is_empty() => Some(readings),
            (Some(factor), _) => Some(readings.times(factor)),
            (None, Some(most)) => Some(readings.times_up_to(most)),
            (None, None) => None,
        };
        let (Some(of_one), Some(of_two)) = (scaled(of_one, &two), scaled(of_two, &one)) else {
            return Self::endless();
        };
        Self {
            readings: of_one.plus(of_two),
            ..one.by_known(two)
        }
    }

    fn by_known(self, other: Self) -> Self {
        if let Some(factor) = self.exact() {
            return other.times(factor);
        }
        if let Some(factor) = other.exact() {
            return self.times(factor);
        }
        if self.own != 0.0 || other.own != 0.0 {
            return Self::endless();
        }
        if self.unknown.is_some() || other.unknown.is_some() {
            let is_of_text = self.magnitude() > 0.0 || other.magnitude() > 0.0;
            // a factor that nobody knows is at least 1
            let scale = |of: &Self| {
                if of.unknown.is_some() {
                    of.magnitude().max(1.0)
                } else {
                    of.magnitude()
                }
            };
            let unbounded = |of: &Self| of.steps.iter().any(|step| step.most.is_none());
            return Self {
                unknown: Some(Unknown {
                    scale: scale(&self) * scale(&other),
                    is_of_text,
                    is_endless: self.is_endless()
                        || other.is_endless()
                        || unbounded(&self)
                        || unbounded(&other),
                }),
                ..Self::exactly(0.0)
            };
        }
        if let (Some((a, b)), Some((c, d))) = (self.ends(), other.ends()) {
            let corners = [a * c, a * d, b * c, b * d];
            let least = corners.into_iter().fold(f64::INFINITY, f64::min);
            let most = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
            return Self::between(least, most);
        }
        // along the line either way
        let by = self.magnitude() * other.magnitude();
        let each = [by, -by].map(|by| Step { by, most: None });
        Self {
            steps: each.into(),
            ..Self::exactly(0.0)
        }
    }

    fn over(self, other: &Self) -> Self {
        if !other.readings.is_empty() {
            return Self::endless();
        }
        if !self.readings.is_empty() {
            let (one, readings) = self.read_apart();
            let inverse = Self::exactly(1.0).over(other);
            let of_them = Self {
                readings,
                ..Self::exactly(0.0)
            };
            return one.over(other).plus(of_them.by(inverse));
        }
        if let Some(divisor) = other.exact() {
            return if divisor == 0.0 {
                Self::unknown()
            } else {
                self.times(1.0 / divisor)
            };
        }
        match other.ends() {
            Some((a, b)) if a > 0.0 || b < 0.0 => self.by(Self::between(1.0 / b, 1.0 / a)),
            // a divisor that nobody knows is at least 1, as factors are
            _ => self.by(Self::unknown()),
        }
    }

    /// A quotient or its whole part.
    fn or_whole(self) -> Self {
        if !self.readings.is_empty() {
            // no whole number is made of coordinates
            return self;
        }
        match self.ends() {
            Some((a, b)) if (a.trunc(), b.trunc()) != (a, b) => {
                Self::between(a.min(a.trunc()), b.max(b.trunc()))
            }
            _ => self,
        }
    }

    /// The whole part of a quotient.
    fn div(self, other: &Self) -> Self {
        if !self.readings.is_empty() || !other.readings.is_empty() {
            return Self::endless();
        }
        if let (Some(a), Some(b)) = (self.exact(), other.exact())
            && b != 0.0
        {
            return Self::exactly((a / b).trunc());
        }
        let quotient = self.over(other);
        match quotient.ends() {
            Some((a, b)) => Self::between(a.min(0.0), b.max(0.0)),
            None => quotient,
        }
    }

    /// What is left of a quotient.
    fn modulo(self, other: &Self) -> Self {
        if !self.readings.is_empty() || !other.readings.is_empty() {
            return Self::endless();
        }
        let least = self.ends().map_or(-1.0, |(least, _)| least);
        match other.exact() {
            _ if self.own != 0.0 => Self::endless(),
            Some(by) if by != 0.0 => {
                let most = by.abs();
                let span = |most: f64| (if least < 0.0 { -most } else { 0.0 }, most);
                if self.is_whole() && by.fract() == 0.0 && most < f64::from(SPAN) {
                    let (least, most) = span(most - 1.0);
                    Self::whole_between(least, most)
                } else {
                    let (least, most) = span(most);
                    Self::between(least, most)
                }
            }
            _ if self.is_endless() => Self::endless(),
            _ => Self::unknown(),
        }
    }

    /// Whether the one number that another is is among those that steps of this lead to.
    fn may_be(&self, other: &Self) -> bool {
        let [step] = self.steps[..] else { return false };
        let is_known = self.unknown.is_none() && self.own == 0.0;
        let count = other.exact().map(|other| (other - self.first) / step.by);
        count.filter(|_| is_known).is_some_and(|count| {
            let most = step.most.map_or(f64::INFINITY, f64::from);
            (count - count.round()).abs() < SAME && (0.0..=most).contains(&count.round())
        })
    }

    /// Any of several.
    pub(super) fn any(all: &[Self]) -> Self {
        if all.is_empty() {
            return Self::unknown();
        }
        if all[1..].iter().all(|one| *one == all[0]) {
            return all[0].clone();
        }
        if all.iter().any(|one| !one.readings.is_empty()) {
            let apart = all.iter().map(|one| one.clone().read_apart());
            let (numbers, readings): (Vec<Self>, Vec<Readings>) = apart.unzip();
            let each = readings.into_iter().map(|of| of.times_up_to(1.0));
            return Self {
                readings: each.fold(Readings::default(), Readings::plus),
                ..Self::any(&numbers)
            };
        }
        let covers = |of: &&Self| all.iter().all(|one| *of == one || of.may_be(one));
        if let Some(all_of_them) = all.iter().find(covers) {
            return all_of_them.clone();
        }
        if all.iter().any(|one| one.own != 0.0) {
            return Self::endless();
        }
        let mut steps: Vec<Step> = Vec::new();
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut unknown: Option<Unknown> = None;
        for one in all {
            let mut bounded = one.clone();
            bounded.steps.retain(|step| step.most.is_some());
            let (a, b) = bounded.known_ends().unwrap_or((one.first, one.first));
            (least, most) = (least.min(a), most.max(b));
            steps.extend(one.steps.iter().filter(|step| step.most.is_none()));
            unknown = match (unknown, one.unknown) {
                (Some(a), Some(b)) => Some(Unknown {
                    scale: match (a.is_of_text, b.is_of_text) {
                        (true, false) => a.scale,
                        (false, true) => b.scale,
                        _ => a.scale.max(b.scale),
                    },
                    is_of_text: a.is_of_text || b.is_of_text,
                    is_endless: a.is_endless || b.is_endless,
                }),
                (a, b) => a.or(b),
            };
        }
        let is_either = all
            .iter()
            .all(|one| one.exact().is_some_and(|v| v == least || v == most));
        let (near, far) = by_size(least, most);
        let mut span = if is_either {
            Self::counted(near, far - near, Some(1))
        } else {
            Self::between(least, most)
        };
        span.steps.extend(steps);
        Self { unknown, ..span }.tidied()
    }
}

/// Two numbers, the smaller one first whatever its sign: of a displacement between them that is
/// made before the rest.
fn by_size(a: f64, b: f64) -> (f64, f64) {
    if a.abs() <= b.abs() { (a, b) } else { (b, a) }
}

/// The value of an expression of numbers, names and `+ - * /` (`DIV`, `MOD`, `%`) with brackets;
/// `of` gives that of an operand that is none of these: a name with all that belongs to it, as
/// `p.trans.z`, `q[2]`, `Abs(x)`. `None` where anything else stands there.
pub(super) fn evaluate(text: &[u8], of: &mut dyn FnMut(&[u8]) -> Quantity) -> Option<Quantity> {
    evaluate_in(Arithmetic::Real, text, of)
}

/// What `/` makes of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arithmetic {
    /// Their quotient.
    Real,
    /// Its whole part, where both are whole numbers by their types, which are not looked at: either
    /// counts, unless one has a decimal point.
    Typed,
}

/// As [`evaluate`].
pub(super) fn evaluate_in(
    arithmetic: Arithmetic,
    text: &[u8],
    of: &mut dyn FnMut(&[u8]) -> Quantity,
) -> Option<Quantity> {
    let mut reader = Reader {
        arithmetic,
        text,
        at: 0,
        of,
    };
    let value = reader.sum(0)?;
    reader.blanks();
    let is_finite = value.first.is_finite() && value.steps.iter().all(|step| step.by.is_finite());
    (reader.at == text.len() && is_finite).then_some(value)
}

struct Reader<'a, 'b> {
    arithmetic: Arithmetic,
    text: &'a [u8],
    at: usize,
    of: &'b mut dyn FnMut(&[u8]) -> Quantity,
}

impl Reader<'_, '_> {
    fn blanks(&mut self) -> Option<u8> {
        let rest = &self.text[self.at..];
        self.at += rest.iter().take_while(|b| b.is_ascii_whitespace()).count();
        self.text.get(self.at).copied()
    }

    fn sum(&mut self, depth: u32) -> Option<Quantity> {
        if depth > DEEPEST {
            return None;
        }
        let mut sum = self.product(depth)?;
        while let Some(sign @ (b'+' | b'-')) = self.blanks() {
            self.at += 1;
            let next = self.product(depth)?;
            sum = sum.plus(if sign == b'-' { next.times(-1.0) } else { next });
        }
        Some(sum)
    }

    fn product(&mut self, depth: u32) -> Option<Quantity> {
        let start = self.at;
        let mut product = self.factor(depth)?;
        loop {
            let sign = match self.blanks() {
                Some(sign @ (b'*' | b'/' | b'%')) => sign,
                _ if self.is_word(*b"div") => b'd',
                _ if self.is_word(*b"mod") => b'%',
                _ => return Some(product),
            };
            self.at += if sign == b'd' || self.text[self.at] != sign {
                3
            } else {
                1
            };
            let next = self.factor(depth)?;
            product = match sign {
                b'*' => product.by(next),
                b'/' => {
                    let quotient = product.over(&next);
                    let is_real = self.text[start..self.at].contains(&b'.');
                    if self.arithmetic == Arithmetic::Real || is_real {
                        quotient
                    } else {
                        quotient.or_whole()
                    }
                }
                b'd' => product.div(&next),
                _ => product.modulo(&next),
            };
        }
    }

    fn is_word(&self, word: [u8; 3]) -> bool {
        let rest = &self.text[self.at..];
        let is = rest
            .get(..3)
            .is_some_and(|text| text.eq_ignore_ascii_case(&word));
        is && !rest.get(3).copied().is_some_and(is_letter)
    }

    fn factor(&mut self, depth: u32) -> Option<Quantity> {
        let mut sign = 1.0;
        while let Some(byte @ (b'+' | b'-')) = self.blanks() {
            sign = if byte == b'-' { -sign } else { sign };
            self.at += 1;
        }
        let rest = &self.text[self.at..];
        let value = match *rest.first()? {
            b'(' => {
                self.at += 1;
                let inside = self.sum(depth + 1)?;
                if self.blanks() != Some(b')') {
                    return None;
                }
                self.at += 1;
                inside
            }
            // names of a program's own begin with a dot in some languages
            b'.' if rest.get(1).is_some_and(u8::is_ascii_alphabetic) => {
                let start = self.at;
                self.operand()?;
                (self.of)(self.text[start..self.at].trim_ascii())
            }
            b'0'..=b'9' | b'.' => {
                let (value, length) = number::parse_start(rest)?;
                if rest.get(length).copied().is_some_and(is_letter) {
                    return None;
                }
                self.at += length;
                Quantity::exactly(value)
            }
            byte if is_letter(byte) => {
                let start = self.at;
                self.operand()?;
                (self.of)(self.text[start..self.at].trim_ascii())
            }
            _ => return None,
        };
        Some(value.times(sign))
    }

    /// Passes over a name and what belongs to it.
    fn operand(&mut self) -> Option<()> {
        loop {
            let rest = &self.text[self.at..];
            self.at += rest.iter().take_while(|b| is_letter(**b)).count();
            let behind = self.at;
            match self.blanks() {
                Some(b'.') => {
                    self.at += 1;
                    self.blanks();
                }
                Some(b'(' | b'[' | b'{') => self.brackets()?,
                _ => {
                    self.at = behind;
                    return Some(());
                }
            }
        }
    }

    fn brackets(&mut self) -> Option<()> {
        let mut depth = 0_u32;
        loop {
            match self.text.get(self.at)? {
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' => depth -= 1,
                b'"' | b'\'' => return None,
                _ => {}
            }
            self.at += 1;
            if depth == 0 {
                return Some(());
            }
        }
    }
}

/// Whether a byte is one of a name.
pub(super) fn is_letter(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'$' | 128..)
}

#[cfg(test)]
mod tests;
