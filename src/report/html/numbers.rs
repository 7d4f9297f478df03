//! Numbers and columns of a page: rounded, short, and never anything but a number.

use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// A number for a page: what is not finite becomes `null`, what is whole is written without a point.
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
    /// Decimals that are shown, so that points stand below one another; all that there are where it is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decimals: Option<u8>,
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
}

/// Edges of bars and how many values are between them: about the square root of their number of bars, at most 60.
#[must_use]
pub(crate) fn histogram(label: &str, unit: &'static str, values: &[f64]) -> Table {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (mut from, mut to, mut counts) = (Vec::new(), Vec::new(), Vec::new());
    if let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most 60"
        )]
        let wished = (sorted.len() as f64).sqrt().ceil().clamp(8.0, 60.0);
        // a round width: 1, 2 or 5 times a power of ten
        let rough = ((high - low) / wished).max(high.abs().max(low.abs()) * 1e-6);
        let rough = if rough > 0.0 { rough } else { 1.0 };
        let power = 10.0_f64.powf(rough.log10().floor());
        let width = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|step| step * power)
            .find(|step| *step >= rough * 0.999)
            .unwrap_or(10.0 * power);
        let start = (low / width).floor();
        let mut at = 0;
        let mut bar = 0.0;
        while at < sorted.len() {
            let edges = ((start + bar) * width, (start + bar + 1.0) * width);
            let first = at;
            while at < sorted.len() && (sorted[at] < edges.1) {
                at += 1;
            }
            from.push(significant(edges.0, 8));
            to.push(significant(edges.1, 8));
            counts.push(at - first);
            bar += 1.0;
        }
    }
    Table {
        columns: vec![
            Column::numbers(&format!("{label} from"), unit, from),
            Column::numbers(&format!("{label} to"), unit, to),
            Column::counts("count", counts),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(table: &Table) -> Vec<f64> {
        match &table.columns[2].values {
            Values::Numbers(values) => values.iter().map(|n| n.map_or(f64::NAN, |n| n.0)).collect(),
            _ => Vec::new(),
        }
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
        let table = histogram("x", "mm", &with_holes);
        assert_eq!(counts(&table).iter().sum::<f64>(), 1000.0);
        assert!((8..=61).contains(&table.rows()), "{}", table.rows());
    }

    #[test]
    fn histograms_of_nothing_and_of_one_value_end() {
        assert_eq!(histogram("x", "mm", &[]).rows(), 0);
        for value in [0.0, 1e-12, 5.0, -3e8] {
            let table = histogram("x", "mm", &[value; 7]);
            assert_eq!(counts(&table).iter().sum::<f64>(), 7.0, "{value}");
            assert!(table.rows() < 5, "{value}: {}", table.rows());
        }
    }

    #[test]
    fn names_are_kept_once() {
        let column = Column::names("tool", [Some("a"), None, Some("b"), Some("a")]);
        let text = serde_json::to_string(&column.values).expect("JSON");
        assert_eq!(text, r#"{"names":["a","b"],"index":[0,null,1,0]}"#);
    }
}
