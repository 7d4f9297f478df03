//! Numbers and columns of a page: rounded, short, and never anything but a number.

use crate::report::LEAST_PROBABILITY;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// A number for a page: what is not finite becomes `null`, what is whole is written without a
/// point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number(pub f64);

/// Whole numbers below this are exact.
const EXACT: f64 = 9e15;

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(value) = *self;
        if !value.is_finite() {
            serializer.serialize_none()
        } else if value.fract() == 0.0 && value.abs() < EXACT {
            #[allow(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
            serializer.serialize_i64(value as i64)
        } else {
            serializer.serialize_f64(value)
        }
    }
}

/// Rounded to so many decimals.
#[must_use]
pub(crate) fn fixed(value: f64, decimals: i32) -> Number {
    let scale = 10.0_f64.powi(decimals);
    Number((value * scale).round() / scale)
}

/// Significant digits of a number whose column has decimals of its own: none that is shown is made
/// up.
pub(crate) const DIGITS: usize = 7;

/// Rounded to so many significant digits.
#[must_use]
pub(crate) fn significant(value: f64, digits: usize) -> Number {
    if value == 0.0 || !value.is_finite() {
        return Number(value);
    }
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    Number(text.parse().unwrap_or(value))
}

/// A column of a table.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Column {
    /// Its heading.
    pub label: String,
    /// The unit of its numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<&'static str>,
    /// A value for each row.
    pub values: Values,
    /// A line of a program.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub code: bool,
    /// For charts only.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub hidden: bool,
    /// For what is said of one row only.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub detail: bool,
    /// Decimals that are shown; all that there are where it is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decimals: Option<u8>,
    /// A table opens with the largest of these numbers.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub worst: bool,
    /// A smaller number is said to be below this one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
}

/// The values of a column.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub(crate) enum Values {
    /// Numbers; `None` where there is none.
    Numbers(Vec<Option<Number>>),
    /// Texts, each its own.
    Texts(Vec<Option<String>>),
    /// Few names that repeat.
    Names {
        /// Each name once.
        names: Vec<String>,
        /// For each row the index of its name.
        index: Vec<Option<u32>>,
    },
}

impl Values {
    /// Rows.
    #[must_use]
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Texts(values) => values.len(),
            Self::Names { index, .. } => index.len(),
        }
    }
}

impl Column {
    fn new(label: &str, unit: &'static str, values: Values) -> Self {
        Self {
            label: label.into(),
            unit: Some(unit).filter(|unit| !unit.is_empty()),
            values,
            code: false,
            hidden: false,
            detail: false,
            decimals: None,
            worst: false,
            least: None,
        }
    }

    /// A column of numbers in a unit; an empty unit is none.
    #[must_use]
    pub(crate) fn numbers<N: Into<Option<Number>>>(
        label: &str,
        unit: &'static str,
        values: impl IntoIterator<Item = N>,
    ) -> Self {
        let values = values.into_iter().map(Into::into);
        let finite = |number: Option<Number>| number.filter(|n| n.0.is_finite());
        Self::new(label, unit, Values::Numbers(values.map(finite).collect()))
    }

    /// A column of probabilities: one that no number can hold is said to be below the least that
    /// can.
    #[must_use]
    pub(crate) fn probabilities(
        label: &str,
        values: impl IntoIterator<Item = Option<f64>>,
    ) -> Self {
        let values = values.into_iter().map(|p| p.map(|p| significant(p, 2)));
        let column = Self::numbers(label, "", values);
        Self {
            least: Some(LEAST_PROBABILITY),
            ..column
        }
    }

    /// A column of counts.
    #[must_use]
    pub(crate) fn counts(label: &str, values: impl IntoIterator<Item = usize>) -> Self {
        Self::numbers(label, "", values.into_iter().map(|n| Number(n as f64)))
    }

    /// A column of texts that hardly repeat.
    #[must_use]
    pub(crate) fn texts<T: Into<Option<String>>>(
        label: &str,
        values: impl IntoIterator<Item = T>,
    ) -> Self {
        let values = values.into_iter().map(Into::into).collect();
        Self::new(label, "", Values::Texts(values))
    }

    /// A column of few names that repeat.
    #[must_use]
    pub(crate) fn names<'a, T: Into<Option<&'a str>>>(
        label: &str,
        values: impl IntoIterator<Item = T>,
    ) -> Self {
        let mut known: BTreeMap<&str, u32> = BTreeMap::new();
        let mut names = Vec::new();
        let index = values
            .into_iter()
            .map(|name| {
                name.into().map(|name: &str| {
                    *known.entry(name).or_insert_with(|| {
                        names.push(name.to_owned());
                        u32::try_from(names.len() - 1).unwrap_or(u32::MAX)
                    })
                })
            })
            .collect();
        Self::new(label, "", Values::Names { names, index })
    }

    /// Charts draw it, tables do not show it.
    #[must_use]
    pub(crate) fn for_charts(mut self) -> Self {
        self.hidden = true;
        self
    }

    /// Tables leave it out; where one row is shown it is there.
    #[must_use]
    pub(crate) fn in_detail(mut self) -> Self {
        self.detail = true;
        self
    }

    /// All its numbers are shown with so many decimals.
    #[must_use]
    pub(crate) fn to(mut self, decimals: u8) -> Self {
        self.decimals = Some(decimals);
        self
    }

    /// The table opens with its largest number.
    #[must_use]
    pub(crate) fn worst_first(mut self) -> Self {
        self.worst = true;
        self
    }

    /// It holds lines of a program.
    #[must_use]
    pub(crate) fn of_code(mut self) -> Self {
        self.code = true;
        self.hidden = true;
        self
    }
}

/// A table: columns of the same length.
#[derive(Clone, Debug, Serialize, Default)]
pub(crate) struct Table {
    /// The columns.
    pub columns: Vec<Column>,
}

impl Table {
    /// Rows.
    #[must_use]
    pub(crate) fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Puts a column in front of the one at an index: by how much each row is rotated, degrees, where
    /// any is.
    pub(crate) fn insert_rotations(&mut self, at: usize, rotated_deg: &[Option<f64>]) {
        if rotated_deg.iter().any(Option::is_some) {
            let shown = |angle: &Option<f64>| angle.map(|angle| significant(angle, DIGITS));
            let column = Column::numbers("rotated", "deg", rotated_deg.iter().map(shown)).to(3);
            self.columns.insert(at, column);
        }
    }
}

/// Medians of several that are so many times apart are counted on an axis of powers of ten.
const FAR_APART: f64 = 10.0;

/// Bars on one axis and how many values of each series are in them, and whether the axis is one of
/// powers of ten: about the square root of their number of bars, at most 60.
#[must_use]
pub(crate) fn histogram(
    label: &str,
    unit: &'static str,
    series: &[(&str, &[f64])],
) -> (Table, bool) {
    let sorted = |values: &[f64]| {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        sorted
    };
    let each: Vec<Vec<f64>> = series.iter().map(|(_, values)| sorted(values)).collect();
    let all = sorted(&each.concat());
    let (mut from, mut to) = (Vec::new(), Vec::new());
    let mut counts: Vec<Vec<usize>> = vec![Vec::new(); each.len()];
    let medians = each
        .iter()
        .filter_map(|values| values.get(values.len() / 2));
    let medians: Vec<f64> = medians.copied().collect();
    let (least, most) = medians
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(a, b), m| (a.min(*m), b.max(*m)));
    let mut log = false;
    if let (Some(&low), Some(&high)) = (all.first(), all.last()) {
        let longest = each.iter().map(Vec::len).max().unwrap_or(0);
        let wished = (longest as f64).sqrt().ceil().clamp(8.0, 60.0);
        log = low > 0.0 && most > FAR_APART * least;
        let (start, width) = if log {
            // so many bars for each power of ten
            let bars = (wished / (high / low).log10()).ceil().clamp(2.0, 20.0);
            ((low.log10() * bars).floor(), 1.0 / bars)
        } else {
            let width = round_width((high - low) / wished, high.abs().max(low.abs()));
            ((low / width).floor(), width)
        };
        let edge = |bar: usize| {
            let at = (start + bar as f64) * width;
            if log { 10.0_f64.powf(at) } else { at }
        };
        let mut at = vec![0; each.len()];
        let mut bar = 0;
        while at.iter().zip(&each).any(|(at, values)| *at < values.len()) {
            let end = edge(bar + 1);
            for ((at, values), counts) in at.iter_mut().zip(&each).zip(&mut counts) {
                let inside = values[*at..].iter().take_while(|v| **v < end).count();
                *at += inside;
                counts.push(inside);
            }
            let digits = if log { 4 } else { 8 };
            from.push(significant(edge(bar), digits));
            to.push(significant(end, digits));
            bar += 1;
        }
    }
    let mut columns = vec![
        Column::numbers(&format!("{label} from"), unit, from),
        Column::numbers(&format!("{label} to"), unit, to),
    ];
    for ((name, _), counts) in series.iter().zip(counts) {
        let name = if name.is_empty() { "count" } else { name };
        columns.push(Column::counts(name, counts));
    }
    (Table { columns }, log)
}

/// A width of bars that is 1, 2 or 5 times a power of ten, not below `rough` nor below what differs
/// at this size.
fn round_width(rough: f64, size: f64) -> f64 {
    let rough = rough.max(size * 1e-6);
    let rough = if rough > 0.0 { rough } else { 1.0 };
    let power = 10.0_f64.powf(rough.log10().floor());
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|step| step * power)
        .find(|step| *step >= rough * 0.999)
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(column: &Column) -> Vec<f64> {
        match &column.values {
            Values::Numbers(values) => values.iter().map(|n| n.map_or(f64::NAN, |n| n.0)).collect(),
            _ => Vec::new(),
        }
    }

    fn counts(table: &Table) -> Vec<f64> {
        numbers(&table.columns[2])
    }

    #[test]
    fn numbers_are_short_and_what_is_none_is_null() {
        let numbers = [
            fixed(1.23456, 2),
            fixed(-0.0001, 2),
            Number(3.0),
            Number(f64::NAN),
            Number(f64::INFINITY),
            significant(1.234_567e-9, 3),
        ];
        let text = serde_json::to_string(&numbers).expect("numbers are JSON");
        assert_eq!(text, "[1.23,0,3,null,null,1.23e-9]");
    }

    #[test]
    fn a_histogram_counts_every_finite_value_once() {
        let values: Vec<f64> = (0..1000).map(|k| f64::from(k).sin() * 3.0 + 5.0).collect();
        let with_holes: Vec<f64> = values.iter().copied().chain([f64::NAN]).collect();
        let (table, log) = histogram("x", "mm", &[("", &with_holes)]);
        assert!(!log);
        assert_eq!(counts(&table).iter().sum::<f64>(), 1000.0);
        assert!((8..=61).contains(&table.rows()), "{}", table.rows());
    }

    #[test]
    fn histograms_of_nothing_and_of_one_value_end() {
        assert_eq!(histogram("x", "mm", &[("", &[])]).0.rows(), 0);
        for value in [0.0, 1e-12, 5.0, -3e8] {
            let (table, _) = histogram("x", "mm", &[("", &[value; 7])]);
            assert_eq!(counts(&table).iter().sum::<f64>(), 7.0, "{value}");
            assert!(table.rows() < 5, "{value}: {}", table.rows());
        }
    }

    #[test]
    fn several_share_their_bars_and_those_far_apart_powers_of_ten() {
        let near: Vec<f64> = (1..200).map(|k| f64::from(k) * 0.01).collect();
        for (times, far_apart) in [(3.0, false), (500.0, true)] {
            let far: Vec<f64> = near.iter().map(|v| v * times).collect();
            let (table, log) = histogram("x", "mm", &[("before", &far), ("after", &near)]);
            assert_eq!(log, far_apart);
            let (from, to) = (numbers(&table.columns[0]), numbers(&table.columns[1]));
            for (column, values) in [(2, &far), (3, &near)] {
                for (bar, count) in numbers(&table.columns[column]).iter().enumerate() {
                    // values at an edge to the digits shown may be on either side
                    let slack = 1e-3 * to[bar];
                    let within = |slack: f64| {
                        let inside = |v: &&f64| (from[bar] - slack..to[bar] + slack).contains(*v);
                        values.iter().filter(inside).count() as f64
                    };
                    assert!(
                        (within(-slack)..=within(slack)).contains(count),
                        "bar {bar}"
                    );
                }
                assert_eq!(numbers(&table.columns[column]).iter().sum::<f64>(), 199.0);
            }
            assert!(table.rows() < 90, "{}", table.rows());
        }
    }

    #[test]
    fn names_are_kept_once() {
        let column = Column::names("tool", [Some("a"), None, Some("b"), Some("a")]);
        let text = serde_json::to_string(&column.values).expect("JSON");
        assert_eq!(text, r#"{"names":["a","b"],"index":[0,null,1,0]}"#);
    }
}
