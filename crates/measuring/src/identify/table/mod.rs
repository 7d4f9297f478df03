//! Tables of measurements as devices, controllers and people write them.
//!
//! ```text
//! bytes → cells (encoding, separator, decimal sign) → columns of the format (names, units, exports) → joined rows → measurements
//! ```
//!
//! A name that is not of the format means nothing until a mapping or the layout of an export says
//! what: nothing is guessed.

mod columns;
mod euler;
mod exports;
mod join;
mod names;
mod text;
mod units;

pub use columns::{Column, Mapping, MappingError};
pub use euler::Euler;
pub use names::{Quantity, is_of_format, keys, proposal};
pub use text::{Grid, Separator};
pub use units::{Unit, Units};

use super::fault::{MeasurementError, MeasurementFault};
use super::input_checks::Remark;
use super::measurements::{
    DIRECTION_COLUMNS, JOINT_COLUMNS, POSITION_COLUMNS, QUATERNION_COLUMNS, last_directions,
    last_moves,
};
use crate::geometry::units::DEG;
use crate::model::Mechanism;

/// As many names of columns are listed.
const LISTED: usize = 6;

/// Rows of one file, or of two that are joined, with columns of the format.
#[derive(Clone, Debug)]
pub struct Table {
    /// The files.
    pub grids: Vec<Grid>,
    /// Their columns.
    pub columns: Vec<Column>,
    /// Points on the tool that have columns of their own: name, and columns of x, y, z.
    pub points: Vec<(String, [usize; 3])>,
    /// The rows.
    pub rows: Vec<Row>,
    /// How angles turn, where a mapping says it.
    pub euler: Option<Euler>,
    /// Whether directions follow from the order of the rows.
    pub is_driven: bool,
    /// What a person should know of how the files were read.
    pub remarks: Vec<Remark>,
}

/// A row of a table: a row of each file.
#[derive(Clone, Debug)]
pub struct Row {
    /// Index of the row in each grid.
    pub at: [usize; 2],
    /// The point on the tool, where points have columns of their own.
    pub point: Option<usize>,
    /// How each joint last moved, where it follows from the order.
    pub motion: Option<LastMotion>,
}

/// How the joints moved last, by the order in which they were driven.
#[derive(Clone, Copy, Debug)]
pub struct LastMotion {
    /// The direction of each.
    pub direction: [f64; 6],
    /// How far each moved, radians.
    pub moved: [f64; 6],
}

/// A note on how a file was read.
fn note(id: &'static str, message: String, hint: impl Into<String>) -> Remark {
    Remark {
        id,
        warning: false,
        line: 0.into(),
        message,
        hint: hint.into(),
    }
}

/// A fault of a file at a line; 0 is the whole file.
fn fault(file: usize, line: usize, message: String, hint: impl Into<String>) -> MeasurementError {
    MeasurementError {
        file,
        line,
        column: 1,
        length: 0,
        fault: MeasurementFault::Csv {
            message,
            hint: hint.into(),
        },
    }
}

impl Table {
    /// One file of joints and what was measured with them.
    ///
    /// # Errors
    /// A mapping that names columns the file does not have; columns of one point that are not
    /// complete.
    pub fn of(grid: Grid, mapping: &Mapping) -> Result<Self, MeasurementError> {
        Self::made(vec![grid], mapping)
    }

    /// A file of joints and a file of points, joined by `id`, else in their order.
    ///
    /// # Errors
    /// As [`Table::of`]; ids without a partner, other numbers of rows, columns in both files.
    pub fn joined(joints: Grid, points: Grid, mapping: &Mapping) -> Result<Self, MeasurementError> {
        Self::made(vec![joints, points], mapping)
    }

    fn made(mut grids: Vec<Grid>, mapping: &Mapping) -> Result<Self, MeasurementError> {
        let (columns, mut remarks) = mapping.columns_of(&mut grids)?;
        for grid in &grids {
            if let Some(encoding) = grid.encoding {
                let message = format!("{} is read as {encoding}: it is no UTF-8", grid.name);
                remarks.push(note(
                    "encoding",
                    message,
                    "save it as UTF-8 to be sure of its names",
                ));
            }
        }
        let mut table = Self {
            grids,
            columns,
            points: Vec::new(),
            rows: Vec::new(),
            euler: None,
            is_driven: mapping.driven.is_some(),
            remarks,
        };
        table.rows = if table.grids.len() > 1 {
            table.join()?
        } else {
            let all = 0..table.grids[0].rows.len();
            all.map(|row| Row {
                at: [row, row],
                point: None,
                motion: None,
            })
            .collect()
        };
        let has = |column: &&str| table.index(column).is_some();
        let euler = mapping
            .euler
            .filter(|(own, required)| *required || own.columns().iter().all(has));
        table.euler = euler.map(|(own, _)| own);
        table.spread_points()?;
        if let Some(driven) = &mapping.driven {
            table.derive_motions(driven)?;
        }
        table.remarks.extend(table.not_read());
        Ok(table)
    }

    /// Columns that nothing is read from.
    fn not_read(&self) -> Vec<Remark> {
        let mut remarks = Vec::new();
        let has = |column: &&str| self.index(column).is_some();
        let angles = Euler::all().find(|own| own.columns().iter().all(has));
        let quaternion = QUATERNION_COLUMNS.iter().all(has);
        if let Some(angles) = angles.filter(|_| self.euler.is_none() && !quaternion) {
            let message = format!(
                "the orientation in {} is not read: nothing names the convention of its angles",
                angles.columns().join(", ")
            );
            let hint =
                "--euler xyz, zyx, zyz, rotation-vector or the name of the controller's maker";
            remarks.push(Remark {
                warning: true,
                ..note("orientation-not-read", message, hint)
            });
        }
        let unknown = |column: &&Column| column.of_point().is_none() && !is_of_format(&column.name);
        let unknown = self.columns.iter().filter(unknown);
        let names: Vec<String> = unknown.map(|column| format!("`{}`", column.name)).collect();
        if let Some((first, more)) = names.split_at_checked(names.len().min(LISTED))
            && !first.is_empty()
        {
            let more = match more.len() {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            let message = format!("no column of the format: {}{more}", first.join(", "));
            let hint = "where one is, name it with --columns, as x=X,q1=J1";
            remarks.push(note("columns-not-read", message, hint));
        }
        remarks
    }

    /// The column of a name.
    #[must_use]
    pub fn index(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }

    /// The column of a name in this row: of a point with columns of its own, these.
    #[must_use]
    pub fn index_in(&self, row: &Row, name: &str) -> Option<usize> {
        if let Some((_, own)) = row.point.map(|point| &self.points[point])
            && let Some(axis) = POSITION_COLUMNS.iter().position(|column| *column == name)
        {
            return Some(own[axis]);
        }
        self.index(name)
    }

    /// A cell's text; `None` where it is empty.
    #[must_use]
    pub fn text(&self, row: &Row, column: usize) -> Option<&str> {
        let column = &self.columns[column];
        let (_, cells) = &self.grids[column.grid].rows[row.at[column.grid]];
        cells.get(column.field).filter(|text| !text.is_empty())
    }

    /// A cell's finite number in the unit of the format.
    #[must_use]
    pub fn number(&self, row: &Row, column: usize) -> Option<f64> {
        let own = &self.columns[column];
        let number = self.grids[own.grid].number(self.text(row, column)?)?;
        // the digits of the file where nothing is to be converted
        if own.factor == 1.0 {
            return Some(number);
        }
        Some(number * own.factor).filter(|number| number.is_finite())
    }

    /// A fault of a cell.
    #[must_use]
    pub fn error(&self, row: &Row, column: usize, fault: MeasurementFault) -> MeasurementError {
        let own = &self.columns[column];
        let grid = &self.grids[own.grid];
        let line = grid.rows[row.at[own.grid]].0;
        let (column, length) = grid.place(line, own.field);
        MeasurementError {
            file: own.grid,
            line,
            column,
            length,
            fault,
        }
    }

    /// The file whose lines name the rows: that of what was measured.
    #[must_use]
    pub fn main_file(&self) -> usize {
        self.grids.len() - 1
    }

    /// The line of a row in that file.
    #[must_use]
    pub fn line(&self, row: &Row) -> usize {
        let file = self.main_file();
        self.grids[file].rows[row.at[file]].0
    }

    /// Names of all columns as the format has them.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let own = self.columns.iter().map(|column| column.name.clone());
        let mut names: Vec<String> = own.collect();
        if self.is_driven {
            names.extend(DIRECTION_COLUMNS.map(str::to_owned));
        }
        if !self.points.is_empty() {
            names.extend(POSITION_COLUMNS.map(str::to_owned));
            names.push("point".into());
        }
        names
    }

    /// Rows of points that have columns of their own: one a point that was seen.
    fn spread_points(&mut self) -> Result<(), MeasurementError> {
        let mut points: Vec<(String, [Option<usize>; 3])> = Vec::new();
        for (index, column) in self.columns.iter().enumerate() {
            let Some((name, axis)) = column.of_point() else {
                continue;
            };
            let known = points.iter().position(|(known, _)| known == name);
            let at = known.unwrap_or_else(|| {
                points.push((name.to_owned(), [None; 3]));
                points.len() - 1
            });
            points[at].1[axis] = Some(index);
        }
        for (name, columns) in points {
            let [Some(x), Some(y), Some(z)] = columns else {
                let message =
                    format!("point `{name}` has not all of {name}.x, {name}.y and {name}.z");
                return Err(fault(
                    self.main_file(),
                    0,
                    message,
                    "map the three of them with --columns",
                ));
            };
            self.points.push((name, [x, y, z]));
        }
        if self.points.is_empty() {
            return Ok(());
        }
        if let Some(column) = ["x_mm", "point"]
            .into_iter()
            .find(|c| self.index(c).is_some())
        {
            let name = &self.points[0].0;
            let message =
                format!("points with columns of their own ({name}.x_mm) and a column {column}");
            let hint = "give all points columns of their own, or a row each with the column point";
            return Err(fault(self.main_file(), 0, message, hint));
        }
        let mut rows = Vec::new();
        for row in &self.rows {
            let before = rows.len();
            for (point, (_, columns)) in self.points.iter().enumerate() {
                if columns
                    .iter()
                    .any(|column| self.text(row, *column).is_some())
                {
                    rows.push(Row {
                        point: Some(point),
                        ..row.clone()
                    });
                }
            }
            if rows.len() == before {
                let message = "no point was measured: all cells are empty".to_owned();
                return Err(fault(
                    self.main_file(),
                    self.line(row),
                    message,
                    "leave the row out",
                ));
            }
        }
        self.rows = rows;
        Ok(())
    }

    /// How each joint last moved, from one row of the joints to the next, measured or not: its
    /// direction is that of the angle which turns the joint. Rows are put into the order of the
    /// joints' file.
    fn derive_motions(&mut self, arm: &Mechanism) -> Result<(), MeasurementError> {
        if DIRECTION_COLUMNS
            .iter()
            .any(|column| self.index(column).is_some())
        {
            let message = "the file has columns of directions, dir1 to dir6".to_owned();
            return Err(fault(
                0,
                0,
                message,
                "leave --driven-in-order out, or these columns",
            ));
        }
        let found: Option<Vec<usize>> = JOINT_COLUMNS.iter().map(|c| self.index(c)).collect();
        // what is missing is reported where joints are read
        let Some(columns) = found else { return Ok(()) };
        let file = self.columns[columns[0]].grid;
        let mut postures = Vec::with_capacity(self.grids[file].rows.len());
        for at in 0..self.grids[file].rows.len() {
            let row = Row {
                at: [at, at],
                point: None,
                motion: None,
            };
            let mut q = [0.0; 6];
            for ((slot, column), name) in q.iter_mut().zip(&columns).zip(JOINT_COLUMNS) {
                *slot = self.number(&row, *column).ok_or_else(|| {
                    let found = self.text(&row, *column).unwrap_or_default().to_owned();
                    let fault = MeasurementFault::NotFinite {
                        column: name,
                        found,
                    };
                    self.error(&row, *column, fault)
                })? * DEG;
            }
            postures.push(q);
        }
        let directions = last_directions(arm, &postures).into_iter();
        let motions = directions.zip(last_moves(&postures));
        let motions: Vec<LastMotion> = motions
            .map(|(direction, moved)| LastMotion { direction, moved })
            .collect();
        for row in &mut self.rows {
            row.motion = Some(motions[row.at[file]]);
        }
        self.rows.sort_by_key(|row| row.at[file]);
        Ok(())
    }
}
