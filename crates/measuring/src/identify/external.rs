//! External axes in measurements: whether readings and profile speak of the same ones.

use super::error::IdentifyError;
use super::measurements::{EXTERNAL_DEG_COLUMNS, EXTERNAL_MM_COLUMNS, Measurement, Measurements};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::model::external::{ExternalAxes, Listed};
use crate::nearest;
use crate::profile::Profile;

/// How far beyond its limits an axis may stand: controllers round. Metres and radians.
const BORDER: f64 = 1e-6;

/// The column of a listed axis, by its index.
#[must_use]
pub fn column_of(axis: &Listed, index: usize) -> &'static str {
    if axis.is_linear() {
        EXTERNAL_MM_COLUMNS[index]
    } else {
        EXTERNAL_DEG_COLUMNS[index]
    }
}

/// The columns of a track.
#[must_use]
pub fn track_columns(axes: &ExternalAxes) -> Vec<&'static str> {
    EXTERNAL_MM_COLUMNS[..axes.track.len()].to_vec()
}

/// A value in the unit of files.
#[must_use]
pub fn in_files(axis: &Listed, value: f64) -> f64 {
    if axis.is_linear() {
        mm_from_m(value)
    } else {
        value / DEG
    }
}

/// A value from the unit of files.
#[must_use]
pub fn from_files(axis: &Listed, value: f64) -> f64 {
    if axis.is_linear() {
        m_from_mm(value)
    } else {
        value * DEG
    }
}

/// Places that differ by less are one, metres and radians.
const SAME_PLACE: f64 = 1e-4;

/// At how many places each listed axis stood.
#[must_use]
pub fn places(axes: &ExternalAxes, measurements: &Measurements) -> Vec<usize> {
    let of = |k: usize| {
        let rows = measurements.rows.iter();
        let mut values: Vec<f64> = rows
            .filter_map(|row| row.stand.values.get(k).copied())
            .filter(|value| value.is_finite())
            .collect();
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| (*a - *b).abs() < SAME_PLACE);
        values.len()
    };
    (0..axes.listed().count()).map(of).collect()
}

fn refused(message: String, hint: &str) -> IdentifyError {
    IdentifyError::Suspicious {
        message,
        hint: hint.into(),
    }
}

/// The positioner on whose plate a row's point is, by its index.
///
/// # Errors
/// The profile has none of this name.
pub fn plate_of(row: &Measurement, axes: &ExternalAxes) -> Result<Option<usize>, IdentifyError> {
    let Some(name) = &row.plate else {
        return Ok(None);
    };
    let all = &axes.positioners;
    if let Some(at) = all
        .iter()
        .position(|own| own.name.eq_ignore_ascii_case(name))
    {
        return Ok(Some(at));
    }
    let message = format!(
        "{}: the point is on the plate of `{name}`, and the profile has no such positioner",
        row.line
    );
    let names = all.iter().map(|own| own.name.as_str());
    let hint = nearest::hint(name, "positioners of the profile", names);
    Err(refused(message, &hint))
}

/// Whether readings and profile speak of the same external axes. Those of a track must be read
/// where the point is on the tool, and those of a positioner where it is on its plate: what a
/// positioner does, no tool of the arm shows.
///
/// # Errors
/// Both sides are named: the column and the axis.
pub fn agree(measurements: &Measurements, profile: &Profile) -> Result<(), IdentifyError> {
    let axes: Vec<Listed> = profile.external.listed().collect();
    let rows = measurements.rows.iter();
    let plates = rows.map(|row| plate_of(row, &profile.external));
    let plates: Vec<Option<usize>> = plates.collect::<Result<_, _>>()?;
    let described = |k: usize| format!("{} (external axis {})", axes[k].name(), k + 1);
    let stood = |k: usize| {
        move |row: &Measurement| {
            row.stand
                .values
                .get(k)
                .is_some_and(|value| value.is_finite())
        }
    };
    let all = EXTERNAL_MM_COLUMNS.iter().zip(&EXTERNAL_DEG_COLUMNS);
    for (k, (mm, deg)) in all.enumerate() {
        let found = [mm, deg].into_iter().find(|c| measurements.has(&[c]));
        let Some(axis) = axes.get(k) else {
            if measurements.rows.iter().any(stood(k)) {
                let message = format!(
                    "the measurements have a column {}, and `external_axes` of the profile lists \
                     {} axes",
                    found.unwrap_or(mm),
                    axes.len()
                );
                let hint = "describe the axis under `external_axes` (`poseshift profile \
                    add-track`), or leave the column out";
                return Err(refused(message, hint));
            }
            continue;
        };
        let own = column_of(axis, k);
        let other = found.filter(|found| **found != own);
        if let Some(other) = other {
            let message = format!(
                "the measurements have a column {other}, and {} of the profile needs {own}",
                described(k)
            );
            let hint =
                "columns are numbered as the profile lists its axes, those of the track first";
            return Err(refused(message, hint));
        }
        let carries = match axis {
            Listed::Track(_) => None,
            Listed::Rotary(_, of, _) => Some(*of),
        };
        let both = measurements.rows.iter().zip(&plates);
        let mut carried = both.filter(|(_, plate)| **plate == carries);
        if let Some((row, _)) = carried.find(|(row, _)| !stood(k)(row)) {
            let message = format!(
                "the profile has {}, and {} of the measurements has no {own}",
                described(k),
                row.line
            );
            let hint = "say where the axis stood in every row; where it was locked at its zero, \
                measure with a profile without `external_axes`";
            return Err(refused(message, hint));
        }
    }
    for row in &measurements.rows {
        for (k, axis) in axes.iter().enumerate() {
            let value = row.stand.values.get(k).copied().unwrap_or(f64::NAN);
            let (low, high) = axis.limits();
            if value < low - BORDER || value > high + BORDER {
                let [value, low, high] = [value, low, high].map(|x| in_files(axis, x));
                let message = format!(
                    "{}: {} is {value}; the limits of {} are {low} and {high}",
                    row.line,
                    column_of(axis, k),
                    described(k)
                );
                let hint = "correct the value, or the limits under `external_axes` of the profile";
                return Err(refused(message, hint));
            }
        }
    }
    Ok(())
}
