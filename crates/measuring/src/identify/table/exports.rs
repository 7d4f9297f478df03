//! What the software of trackers and arms writes as text.
//!
//! # Source
//! `SpatialAnalyzer` User Manual, "Exporting ASCII Formatted Points" (`Collection Group Target x y
//! z`, blanks or commas, `//` comments); exported files of Leica Tracker Pilot and
//! `SpatialAnalyzer` in public data sets of robot calibrations; the columns of the standard table
//! of PolyWorks|Inspector (name, control, nominal, measured, tolerance, deviation, test, out of
//! tolerance). Tables of other software are known by what their columns are called.

use super::names::meant;
use super::text::{Grid, Separator};
use crate::identify::input_checks::csv::NotCsv;
use crate::nearest::plain;

/// A file that was recognised.
pub(super) struct Export {
    /// What wrote it, or how it is laid out.
    pub software: &'static str,
    /// Keys of a mapping and the file's columns.
    pub columns: Vec<(&'static str, String)>,
    /// The table with one row a point, where the file has one row a coordinate.
    pub pivoted: Option<Grid>,
}

/// Axes of a coordinate.
const AXES: [&str; 3] = ["x", "y", "z"];
/// What others call the column that says which coordinate a row is.
const CONTROLS: [&str; 6] = [
    "control",
    "characteristic",
    "axis",
    "property",
    "dimension",
    "component",
];
/// What others call a measured number.
const MEASURED: [&str; 6] = ["meas", "measured", "act", "actual", "ist", "realvalue"];
/// Most columns of names before the three of coordinates.
const MOST_NAMES: usize = 3;

/// The layout of a file of points that has no columns of the format.
///
/// # Errors
/// A table of one row a coordinate in which one is missing or no number.
pub(super) fn recognise(grid: &Grid) -> Result<Option<Export>, NotCsv> {
    if !grid.has_header {
        return Ok(list(grid));
    }
    if let Some(found) = long(grid)? {
        return Ok(Some(found));
    }
    Ok(leica(grid).or_else(|| nominal_and_measured(grid)))
}

/// Names and coordinates without a header.
fn list(grid: &Grid) -> Option<Export> {
    let names = grid.header.len().checked_sub(AXES.len())?;
    let numbers =
        |row: &csv::StringRecord| (names..names + 3).all(|i| grid.number(&row[i]).is_some());
    if names > MOST_NAMES || !grid.rows.iter().all(|(_, row)| numbers(row)) {
        return None;
    }
    let at = |field: usize| format!("#{}", field + 1);
    let mut columns: Vec<(&str, String)> =
        vec![("x", at(names)), ("y", at(names + 1)), ("z", at(names + 2))];
    if names > 0 {
        columns.push(("id", at(names - 1)));
    }
    Some(Export {
        software: "a list of names and coordinates, as SpatialAnalyzer exports",
        columns,
        pivoted: None,
    })
}

/// The first column that has one of these names.
fn named(grid: &Grid, names: &[&str]) -> Option<usize> {
    let mut header = grid.header.iter();
    header.position(|name| {
        let bare = super::units::in_name(name).map_or(name.as_str(), |(bare, _)| bare);
        names.contains(&plain(bare).as_str())
    })
}

/// One row a coordinate: name, control (X, Y, Z), measured.
fn long(grid: &Grid) -> Result<Option<Export>, NotCsv> {
    let (Some(control), Some(measured)) = (named(grid, &CONTROLS), named(grid, &MEASURED)) else {
        return Ok(None);
    };
    let Some(name) = grid
        .header
        .iter()
        .position(|name| meant(name) == Some("id"))
    else {
        return Ok(None);
    };
    let fault = |line: usize, field: usize, message: String| NotCsv {
        line,
        column: grid.place(line, field).0,
        message,
        hint: "each point has a row for X, for Y and for Z".into(),
    };
    let mut points: Vec<(usize, String, [Option<String>; 3])> = Vec::new();
    let mut before = String::new();
    for (line, row) in &grid.rows {
        let axis = AXES.iter().position(|axis| plain(&row[control]) == *axis);
        let Some(axis) = axis else { continue };
        // the name may stand in the first of the rows only
        let own = if row[name].is_empty() {
            before.clone()
        } else {
            row[name].to_owned()
        };
        before.clone_from(&own);
        if grid.number(&row[measured]).is_none() {
            let message = format!(
                "{} of `{own}`: `{}` is not a finite number",
                &row[control], &row[measured]
            );
            return Err(fault(*line, measured, message));
        }
        let known = points.iter().position(|(_, known, _)| *known == own);
        let at = known.unwrap_or_else(|| {
            points.push((*line, own.clone(), [None, None, None]));
            points.len() - 1
        });
        if points[at].2[axis]
            .replace(row[measured].to_owned())
            .is_some()
        {
            let message = format!("{} of `{own}` stands twice", &row[control]);
            return Err(fault(*line, control, message));
        }
    }
    let mut rows = Vec::with_capacity(points.len());
    for (line, own, cells) in points {
        let [Some(x), Some(y), Some(z)] = cells else {
            return Err(fault(
                line,
                name,
                format!("`{own}` has not all of X, Y and Z"),
            ));
        };
        rows.push((line, csv::StringRecord::from(vec![own, x, y, z])));
    }
    if rows.is_empty() {
        return Ok(None);
    }
    let unit = super::units::in_name(&grid.header[measured]).and_then(|(_, unit)| unit);
    let suffix = unit.map_or_else(String::new, |unit| format!(" [{}]", unit.symbol()));
    let names = AXES.map(|axis| axis.to_uppercase() + &suffix);
    let header = std::iter::once("id".to_owned()).chain(names.clone());
    Ok(Some(Export {
        software: "a table of one row a coordinate, as PolyWorks and CAM2 write",
        columns: AXES.into_iter().zip(names).collect(),
        pivoted: Some(Grid {
            header: header.collect(),
            rows,
            separator: Separator::Blanks,
            ..grid.clone()
        }),
    }))
}

/// The columns with these meanings, where each is there.
fn columns(grid: &Grid, keys: &[&'static str]) -> Option<Vec<(&'static str, String)>> {
    let find = |key: &&'static str| {
        let mut header = grid.header.iter();
        Some((*key, header.find(|name| meant(name) == Some(*key))?.clone()))
    };
    keys.iter().map(find).collect()
}

/// With the name of the points where there is one.
fn with_id(grid: &Grid, mut of: Vec<(&'static str, String)>) -> Vec<(&'static str, String)> {
    of.extend(columns(grid, &["id"]).into_iter().flatten());
    of
}

fn leica(grid: &Grid) -> Option<Export> {
    let has = |wanted: &str| {
        grid.header
            .iter()
            .any(|name| plain(name).starts_with(wanted))
    };
    if !has("u95") || !has("timestamp") {
        return None;
    }
    Some(Export {
        software: "an export of Leica Tracker Pilot",
        columns: with_id(grid, columns(grid, &["x", "y", "z"])?),
        pivoted: None,
    })
}

/// Wanted and measured coordinates, or wanted ones and differences, in one row.
fn nominal_and_measured(grid: &Grid) -> Option<Export> {
    columns(grid, &["target_x", "target_y", "target_z"])?;
    let measured = columns(grid, &["x", "y", "z"]);
    let found = measured.or_else(|| {
        columns(
            grid,
            &[
                "target_x", "target_y", "target_z", "diff_x", "diff_y", "diff_z",
            ],
        )
    })?;
    Some(Export {
        software: "a table of nominal and measured coordinates, as Verisurf and MetroLog write",
        columns: with_id(grid, found),
        pivoted: None,
    })
}
