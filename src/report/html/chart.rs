//! Charts of columns of a page's tables.

use super::numbers::Number;
use serde::Serialize;

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Kind {
    /// A line through its points.
    Line,
    /// Points.
    Dots,
    /// Bars from x to x2.
    Histogram,
    /// Bars that stand, one for each name.
    Bars,
    /// Bars that lie, one for each name, with y2 as their error.
    Rows,
    /// A dashed level.
    Level,
}

/// Colours by meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Tone {
    /// No meaning.
    One,
    /// As it was.
    Before,
    /// With frames alone.
    Frames,
    /// As it is now.
    After,
    /// As it should be.
    Wanted,
    /// Not beyond this.
    Limit,
}

/// Columns of a table drawn together, by their indices.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Series {
    /// How.
    pub kind: Kind,
    /// Column of x, or of names.
    pub x: usize,
    /// Column of y.
    pub y: usize,
    /// Column of the other end of a bar.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x2: Option<usize>,
    /// Column of the error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y2: Option<usize>,
    /// Its name; empty where there is one series only.
    pub name: String,
    /// Its colour.
    pub tone: Tone,
}

impl Series {
    /// Two columns.
    #[must_use]
    pub(crate) fn new(kind: Kind, x: usize, y: usize, name: &str, tone: Tone) -> Self {
        Self {
            kind,
            x,
            y,
            x2: None,
            y2: None,
            name: name.into(),
            tone,
        }
    }
}

/// What an axis shows.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Axis {
    /// Its name.
    pub label: String,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// Powers of ten are as far apart as one another.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub log: bool,
}

impl Axis {
    /// A name and a unit.
    #[must_use]
    pub(crate) fn new(label: &str, unit: &'static str) -> Self {
        Self {
            label: label.into(),
            unit,
            log: false,
        }
    }
}

/// A chart of columns of one of the page's tables.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Chart {
    /// Its title.
    pub title: String,
    /// What it says.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// The table's name.
    pub table: String,
    /// Across.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// What is drawn.
    pub series: Vec<Series>,
    /// It has the whole width.
    pub wide: bool,
    /// x are names in the order of the rows.
    pub bands: bool,
    /// Its rows are items of the view in space.
    pub picks: bool,
}

impl Chart {
    /// A chart without series.
    #[must_use]
    pub(crate) fn new(title: &str, table: &str, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            note: String::new(),
            table: table.into(),
            x,
            y,
            series: Vec::new(),
            wide: false,
            bands: false,
            picks: false,
        }
    }
}

/// Correlations.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Heat {
    /// Its title.
    pub title: String,
    /// What it says.
    pub note: String,
    /// Of what.
    pub names: Vec<String>,
    /// The lower triangle, row by row.
    pub values: Vec<Vec<Number>>,
}
