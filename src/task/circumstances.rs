//! What a row of a table says besides joint angles: directions, forces, temperature, time, and where
//! a track stood.

use super::failure::Failure;
use super::simulate::stand;
use super::table::{Row, Table};
use crate::geometry::units::DEG;
use crate::identify::external::{column_of, from_files, in_files, track_columns};
use crate::identify::measurements::beyond;
use crate::identify::measurements::{
    DIRECTION_COLUMNS, EXTERNAL_MM_COLUMNS, FORCE_COLUMNS, MOVE_COLUMNS,
};
use crate::model::Conditions;
use crate::model::external::Stand;
use crate::model::profile::Profile;

/// Directions from which a joint comes.
const STEPS: [f64; 3] = [-1.0, 0.0, 1.0];
/// How far beyond its limits an axis may stand: controllers round. Metres.
const BORDER_M: f64 = 1e-6;
const TEMPERATURE: &str = "temperature_c";
const TIME: &str = "time_s";

/// The columns of a track.
pub(super) struct Track<'a> {
    profile: &'a Profile,
    is_carried: bool,
}

/// Which columns a table has.
pub(super) struct Circumstances<'a> {
    track: Track<'a>,
    directions: bool,
    moves: bool,
    forces: bool,
    /// Temperature or time: what the chain is built from.
    heat: bool,
}

impl<'a> Track<'a> {
    /// # Errors
    /// Columns of some of its axes only, or of a linear axis that the profile does not have.
    pub(super) fn of(table: &Table, profile: &'a Profile) -> Result<Self, Failure> {
        let own = track_columns(&profile.external);
        let is_filled = |column: &str| {
            let mut rows = table.rows();
            let filled = |row: Row| row.text(column).is_some_and(|text| !text.is_empty());
            table.has(column) && rows.any(filled)
        };
        let mut others = EXTERNAL_MM_COLUMNS.iter().filter(|c| !own.contains(c));
        if let Some(column) = others.find(|column| is_filled(column)) {
            return Err(Failure::with_hint(
                format!(
                    "the table has a column {column}, and `external_axes` of the profile lists {} \
                     axes of a track",
                    own.len()
                ),
                "describe the axis under `external_axes` (`poseshift profile add-track`), or leave \
                 the column out",
            ));
        }
        Ok(Self {
            profile,
            is_carried: table.group(&own)?,
        })
    }

    /// Where it stood in a row; nothing without its columns: the base is at home then.
    ///
    /// # Errors
    /// A cell that is empty, no number, or beyond the limits.
    pub(super) fn stand(&self, row: &Row) -> Result<Stand, Failure> {
        if !self.is_carried {
            return Ok(Stand::default());
        }
        let axes = self.profile.external.listed().enumerate();
        for (k, axis) in axes.filter(|(_, axis)| axis.is_linear()) {
            let column = column_of(&axis, k);
            // an empty cell is no number
            let value = from_files(&axis, row.number(column)?);
            let (low, high) = axis.limits();
            if value < low - BORDER_M || value > high + BORDER_M {
                let [value, low, high] = [value, low, high].map(|m| in_files(&axis, m));
                let message = format!(
                    "column {column}: {value}; the limits of {} in the profile are {low} and {high}",
                    axis.name()
                );
                return Err(row.failure_in(column, message));
            }
        }
        stand(self.profile, row)
    }
}

impl<'a> Circumstances<'a> {
    /// # Errors
    /// Some columns of a group only; those of [`Track::of`].
    pub(super) fn of(table: &Table, profile: &'a Profile) -> Result<Self, Failure> {
        Ok(Self {
            track: Track::of(table, profile)?,
            directions: table.group(&DIRECTION_COLUMNS)?,
            moves: table.group(&MOVE_COLUMNS)?,
            forces: table.group(&FORCE_COLUMNS)?,
            heat: table.has(TEMPERATURE) || table.has(TIME),
        })
    }

    /// Passes over their columns: a model that knows nothing of them takes the same tables.
    pub(super) fn pass_over(table: &Table) {
        let groups = [&DIRECTION_COLUMNS[..], &MOVE_COLUMNS, &FORCE_COLUMNS];
        table.pass_over(&groups.concat());
        table.pass_over(&[TEMPERATURE, TIME]);
    }

    /// Whether there are none: every row is as the first.
    pub(super) fn is_none(&self) -> bool {
        !(self.directions || self.moves || self.forces || self.is_of_chain())
    }

    /// Whether the chain itself differs from row to row.
    pub(super) fn is_of_chain(&self) -> bool {
        self.heat || self.track.is_carried
    }

    /// Those of a row.
    ///
    /// # Errors
    /// A cell that is no number, or no direction.
    pub(super) fn conditions(&self, row: &Row) -> Result<Conditions, Failure> {
        let mut conditions = Conditions::default();
        if self.directions {
            conditions.direction = directions(row)?;
        }
        if self.moves {
            conditions.moved = row.numbers(MOVE_COLUMNS)?.map(|moved| moved * DEG);
        }
        if self.forces {
            conditions.force_n = row.numbers(FORCE_COLUMNS)?;
        }
        conditions.temperature_c = temperature_c(row)?;
        conditions.time_s = time_s(row)?;
        Ok(conditions)
    }

    /// As [`Track::stand`].
    ///
    /// # Errors
    /// As [`Track::stand`].
    pub(super) fn stand(&self, row: &Row) -> Result<Stand, Failure> {
        self.track.stand(row)
    }
}

/// From which side each joint comes.
///
/// # Errors
/// Another number than −1, 0, 1.
pub(super) fn directions(row: &Row) -> Result<[f64; 6], Failure> {
    let given: [f64; 6] = row.numbers(DIRECTION_COLUMNS)?;
    let mut steps = given.iter().zip(DIRECTION_COLUMNS);
    match steps.find(|(step, _)| !STEPS.contains(*step)) {
        Some((step, column)) => Err(row.failure(format!(
            "column {column}: {step} is no direction: -1, 0 or 1"
        ))),
        None => Ok(given),
    }
}

/// The temperature of the arm where a row says it, °C.
///
/// # Errors
/// A cell that is no number.
pub(super) fn temperature_c(row: &Row) -> Result<Option<f64>, Failure> {
    where_said(row, TEMPERATURE)
}

/// Seconds since the session began where a row says them.
///
/// # Errors
/// A cell that is no number.
pub(super) fn time_s(row: &Row) -> Result<Option<f64>, Failure> {
    where_said(row, TIME)
}

fn where_said(row: &Row, column: &str) -> Result<Option<f64>, Failure> {
    if row.text(column).is_none() {
        return Ok(None);
    }
    let number = row.number(column)?;
    match beyond(column, number) {
        Some(limit) => {
            let message = format!("column {column}: {number:?} is beyond {limit}");
            Err(row.failure_in(column, message))
        }
        None => Ok(Some(number)),
    }
}

#[cfg(test)]
mod tests;
