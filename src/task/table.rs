//! CSV tables with a header: columns in any order, errors by line and column.

use super::failure::Failure;
use crate::geometry::units::{DEG, m_from_mm};
use crate::geometry::{Pose, Quaternion};
use crate::identify::input_checks::csv::{line_of_row, not_csv};
use crate::nearest;
use crate::program::Source;
use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

/// A table read whole.
pub(super) struct Table<'a> {
    source: &'a Source,
    header: Vec<String>,
    rows: Vec<(usize, csv::StringRecord)>,
    /// Which columns somebody asked for.
    read: Vec<Cell<bool>>,
    /// What was asked for and is not there.
    absent: RefCell<BTreeSet<String>>,
}

/// One row of a table.
pub(super) struct Row<'a> {
    table: &'a Table<'a>,
    /// Line in the file, from 1.
    pub line: usize,
    cells: &'a csv::StringRecord,
}

impl<'a> Table<'a> {
    /// Reads a table; lines that start with `#` are comments.
    ///
    /// # Errors
    /// Text that is no table, with line and column; a table without rows.
    pub(super) fn read(source: &'a Source) -> Result<Self, Failure> {
        if let Some(fault) = not_csv(&source.bytes) {
            let (line, column) = (fault.line, fault.column);
            return Err(Failure::at(
                source,
                line,
                column,
                None,
                fault.message,
                fault.hint,
            ));
        }
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(source.bytes.as_slice());
        let failure = |error: &csv::Error| {
            let line = line_of_row(&source.bytes, error.position());
            let message = match error.kind() {
                csv::ErrorKind::UnequalLengths {
                    expected_len, len, ..
                } => format!("{len} cells; the header has {expected_len}"),
                csv::ErrorKind::Utf8 { .. } => "not UTF-8 text".into(),
                _ => error.to_string(),
            };
            Failure::at(source, line, 1, None, message, "")
        };
        let header: Vec<String> = reader
            .headers()
            .map_err(|error| failure(&error))?
            .iter()
            .map(str::to_owned)
            .collect();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| failure(&error))?;
            rows.push((line_of_row(&source.bytes, record.position()), record));
        }
        if rows.is_empty() {
            return Err(Failure::with_hint(
                format!("{}: no rows", source.name),
                "the first line names the columns, and the rows stand below it",
            ));
        }
        let read = vec![Cell::new(false); header.len()];
        Ok(Self {
            source,
            header,
            rows,
            read,
            absent: RefCell::default(),
        })
    }

    /// Whether it has this column.
    pub(super) fn has(&self, column: &str) -> bool {
        self.index_of(column).is_some()
    }

    /// Counts columns that it may have as read.
    pub(super) fn pass_over(&self, columns: &[&str]) {
        for column in columns {
            self.index_of(column);
        }
    }

    /// Which column has this name.
    fn index_of(&self, column: &str) -> Option<usize> {
        let index = self.header.iter().position(|name| name == column);
        match index {
            Some(index) => self.read[index].set(true),
            None if !self.absent.borrow().contains(column) => {
                self.absent.borrow_mut().insert(column.to_owned());
            }
            None => {}
        }
        index
    }

    /// That no column, once all is read, was meant as one that was asked for and is not there.
    ///
    /// # Errors
    /// A misspelt column: what stands in it would not count.
    pub(super) fn refuse_misspelt(&self) -> Result<(), Failure> {
        let absent = self.absent.borrow();
        let unread = self.header.iter().zip(&self.read);
        for (name, _) in unread.filter(|(_, read)| !read.get()) {
            if let Some(meant) = nearest::misspelt(name, absent.iter().map(String::as_str)) {
                return Err(Failure::with_hint(
                    format!("{}: the column `{name}` is not read", self.source.name),
                    format!("is `{meant}` meant? rename the column, or leave it out"),
                ));
            }
        }
        Ok(())
    }

    /// That it has these columns.
    ///
    /// # Errors
    /// One of them is missing or stands twice.
    pub(super) fn require(&self, columns: &[&str]) -> Result<(), Failure> {
        for column in columns {
            self.index_of(column);
        }
        let count = |column: &str| self.header.iter().filter(|name| *name == column).count();
        let missing: Vec<_> = columns
            .iter()
            .filter(|column| count(column) == 0)
            .copied()
            .collect();
        if !missing.is_empty() {
            let header = || self.header.iter().map(String::as_str);
            let meant = missing.iter().filter_map(|column| {
                let near = nearest::nearest(column, header());
                let near = near.into_iter().find(|name| !columns.contains(name))?;
                Some(nearest::instead_of_column(near, column))
            });
            let mut hint: Vec<String> = meant.collect();
            let numbers = self.header.iter().filter(|n| n.parse::<f64>().is_ok());
            hint.push(if numbers.count() * 2 > self.header.len() {
                "the first line holds numbers: it must name the columns".into()
            } else {
                format!("the header has: {}", self.header.join(", "))
            });
            let hint = hint.join(" ");
            return Err(Failure::with_hint(
                format!(
                    "{}: columns are missing: {}",
                    self.source.name,
                    missing.join(", ")
                ),
                hint,
            ));
        }
        match columns.iter().find(|column| count(column) > 1) {
            Some(twice) => Err(Failure::new(format!(
                "{}: the column {twice} stands twice",
                self.source.name
            ))),
            None => Ok(()),
        }
    }

    /// Whether it has these columns: all of them or none.
    ///
    /// # Errors
    /// It has some of them, or one twice.
    pub(super) fn group(&self, columns: &[&str]) -> Result<bool, Failure> {
        let any = columns.iter().any(|column| self.has(column));
        if any {
            self.require(columns)?;
        }
        Ok(any)
    }

    /// The rows in the order of the file; `tell` hears how many of how many are done.
    pub(super) fn rows_telling<'t>(
        &'t self,
        tell: &'t mut dyn FnMut(usize, usize),
    ) -> impl Iterator<Item = Row<'t>> {
        let all = self.rows.len();
        self.rows().enumerate().map(move |(number, row)| {
            if number.is_multiple_of(PORTION) {
                tell(number, all);
            }
            row
        })
    }

    /// The rows in the order of the file.
    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|(line, cells)| Row {
            table: self,
            line: *line,
            cells,
        })
    }
}

/// Rows that are done from one word of it to the next.
const PORTION: usize = 1024;
/// A larger number is no length, angle or weight: sums of its squares and sines of it mean nothing.
const LARGEST: f64 = 1e12;

impl Row<'_> {
    /// A cell's text; `None` where there is no such column.
    pub(super) fn text(&self, column: &str) -> Option<&str> {
        self.cells.get(self.table.index_of(column)?)
    }

    /// A number in a required column, not larger than [`LARGEST`].
    ///
    /// # Errors
    /// The cell is none.
    pub(super) fn number(&self, column: &str) -> Result<f64, Failure> {
        let text = self.text(column).unwrap_or_default();
        let number = text.parse().ok().filter(|n: &f64| n.is_finite());
        number.filter(|n| n.abs() <= LARGEST).ok_or_else(|| {
            let message = match (text, number) {
                ("", _) => format!("column {column}: an empty cell is not a finite number"),
                (_, None) => format!("column {column}: `{text}` is not a finite number"),
                _ => format!("column {column}: `{text}` is beyond \u{b1}{LARGEST:e}"),
            };
            self.failure_in(column, message)
        })
    }

    /// A failure at a cell of this row.
    pub(super) fn failure_in(&self, column: &str, message: String) -> Failure {
        Failure::at(
            self.table.source,
            self.line,
            self.column_of(column),
            self.text(column).map(str::len).or(Some(0)),
            message,
            "",
        )
    }

    /// Finite numbers in required columns.
    ///
    /// # Errors
    /// One of the cells is none.
    pub(super) fn numbers<const N: usize>(&self, columns: [&str; N]) -> Result<[f64; N], Failure> {
        let mut out = [0.0; N];
        for (slot, column) in out.iter_mut().zip(columns) {
            *slot = self.number(column)?;
        }
        Ok(out)
    }

    /// The six joint angles of the controller, radians.
    ///
    /// # Errors
    /// One of the cells is no finite number.
    pub(super) fn joints(&self) -> Result<[f64; 6], Failure> {
        Ok(self.numbers(JOINTS)?.map(|q| q * DEG))
    }

    /// A failure at this row.
    pub(super) fn failure(&self, message: String) -> Failure {
        Failure::at(self.table.source, self.line, 1, None, message, "")
    }

    /// The `id` column, else the row's number from 1.
    pub(super) fn id(&self, number: usize) -> String {
        self.text("id")
            .map_or_else(|| number.to_string(), str::to_owned)
    }

    fn column_of(&self, column: &str) -> usize {
        let index = self
            .table
            .header
            .iter()
            .position(|name| name == column)
            .unwrap_or(0);
        let line = self
            .table
            .source
            .line(self.line.saturating_sub(1))
            .unwrap_or_default();
        let commas = line
            .iter()
            .enumerate()
            .filter(|(_, b)| **b == b',')
            .map(|(at, _)| at + 1);
        std::iter::once(0).chain(commas).nth(index).unwrap_or(0) + 1
    }
}

/// How far a quaternion of a table may be from length 1.
pub(super) const UNIT_TOLERANCE: f64 = 1e-3;
/// Joint columns.
pub(super) const JOINTS: [&str; 6] = ["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"];
/// Pose columns.
pub(super) const POSE: [&str; 7] = ["x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"];

/// A number for output tables: every digit that a reader needs to get the same number back.
pub(super) fn cell(value: f64) -> String {
    format!("{}", if value == 0.0 { 0.0 } else { value })
}

/// A cell with text, in quotes where it needs them.
pub(super) fn text_cell(text: &str) -> Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) || text.starts_with(['#', ' ']) {
        format!("\"{}\"", text.replace('"', "\"\"")).into()
    } else {
        text.into()
    }
}

/// Seven columns of a pose, mm and a quaternion whose length is 1 to [`UNIT_TOLERANCE`].
///
/// # Errors
/// A cell that is no number; another length of the quaternion.
pub(super) fn pose(row: &Row) -> Result<Pose, Failure> {
    let [x, y, z, w, i, j, k] = row.numbers(POSE)?;
    Ok(Pose::from_parts(
        [x, y, z].map(m_from_mm),
        unit(row, Quaternion([w, i, j, k]))?,
    ))
}

/// A quaternion of a row, normalised.
///
/// # Errors
/// Its length differs from 1 by more than [`UNIT_TOLERANCE`].
pub(super) fn unit(row: &Row, quaternion: Quaternion) -> Result<Quaternion, Failure> {
    let norm = quaternion.norm();
    if (norm - 1.0).abs() > UNIT_TOLERANCE {
        return Err(row.failure(format!(
            "the quaternion's length is {norm:.6}; it may differ from 1 by {UNIT_TOLERANCE}"
        )));
    }
    Ok(quaternion.normalized())
}
