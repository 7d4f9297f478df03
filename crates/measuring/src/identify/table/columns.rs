//! Which column of a file is which of the format: by its name, by a mapping, by the layout of an
//! export.

use super::euler::Euler;
use super::exports;
use super::names::{Quantity, column, in_another_unit, keys};
use super::text::Grid;
use super::units::{Unit, Units, in_name};
use super::{fault, note};
use crate::identify::fault::MeasurementError;
use crate::identify::input_checks::Remark;
use crate::identify::measurements::{JOINT_COLUMNS, POSITION_COLUMNS};
use crate::model::Mechanism;
use crate::nearest;

/// A column of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name in the format; where it is none of it, the file's own.
    pub name: String,
    /// Index of the file.
    pub grid: usize,
    /// Its place in the file's rows.
    pub field: usize,
    /// How many units of the format its unit is.
    pub factor: f64,
}

impl Column {
    /// The point on the tool that the column is of, and which axis, where it is of one.
    #[must_use]
    pub fn of_point(&self) -> Option<(&str, usize)> {
        let (point, axis) = self.name.rsplit_once('.')?;
        let axis = POSITION_COLUMNS.iter().position(|name| *name == axis)?;
        (!point.is_empty()).then_some((point, axis))
    }
}

/// What the user says of a file's columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mapping {
    columns: Vec<Entry>,
    units: Units,
    /// How angles turn, and whether every file must have such.
    pub euler: Option<(Euler, bool)>,
    /// The arm, where rows are in the order in which it drove to them.
    pub driven: Option<Mechanism>,
}

#[derive(Clone, Debug, PartialEq)]
struct Entry {
    /// The column of the format.
    name: String,
    quantity: Quantity,
    /// The file's own name, or `#` and its number.
    theirs: String,
    /// Whether a file must have it: what a profile keeps is for files that do.
    required: bool,
}

/// What is wrong with a mapping, and the way out.
pub type MappingError = (String, String);

impl Mapping {
    /// Adds pairs of a name of the format and the file's own (`q1`, `J1`). Those of a profile
    /// (`required` false) count only where a file has such a column, and where no other pair
    /// maps the same name.
    ///
    /// # Errors
    /// A name that is none of the format; no name of theirs.
    pub fn add<'a>(
        &mut self,
        pairs: impl IntoIterator<Item = (&'a str, &'a str)>,
        required: bool,
    ) -> Result<(), MappingError> {
        for (key, theirs) in pairs {
            let (key, theirs) = (key.trim(), theirs.trim());
            let Some((name, quantity)) = column(key) else {
                let message = format!("`{key}` is no column of the format");
                let near = nearest::nearest(key, keys());
                let meant = near.first().map(|near| format!("did you mean `{near}`? "));
                let hint =
                    "names are x, y, z, q1 to q6, id, point and those of docs/calibration.md";
                return Err((message, meant.unwrap_or_default() + hint));
            };
            if theirs.is_empty() {
                let message = format!("`{key}=` names no column of the file");
                return Err((
                    message,
                    "name=Their name, and #3 for their third column".into(),
                ));
            }
            // what is said now is more than what a profile keeps; of two files each may have its
            // own name
            if !required
                && self
                    .columns
                    .iter()
                    .any(|entry| entry.required && entry.name == name)
            {
                continue;
            }
            self.columns.push(Entry {
                name,
                quantity,
                theirs: theirs.to_owned(),
                required,
            });
        }
        Ok(())
    }

    /// Adds `x=X,y=Y,q1=J1`.
    ///
    /// # Errors
    /// As [`Mapping::add`]; a word without `=`.
    pub fn add_text(&mut self, text: &str) -> Result<(), MappingError> {
        let pairs = text.split(',').filter(|pair| !pair.trim().is_empty());
        let pairs = pairs.map(|pair| {
            pair.split_once('=').ok_or_else(|| {
                (
                    format!("`{pair}` is no pair"),
                    "name=Their name,… as x=X,q1=J1".to_owned(),
                )
            })
        });
        let pairs: Vec<(&str, &str)> = pairs.collect::<Result<_, _>>()?;
        self.add(pairs, true)
    }

    /// Adds units; those that are known stay.
    pub fn add_units(&mut self, units: Units) {
        self.units.length = self.units.length.or(units.length);
        self.units.angle = self.units.angle.or(units.angle);
    }

    /// Pairs of names, and the names of the units, as a profile keeps them.
    #[must_use]
    pub fn kept(&self) -> (Vec<(&str, &str)>, Vec<&'static str>) {
        let pairs = self
            .columns
            .iter()
            .map(|e| (e.name.as_str(), e.theirs.as_str()));
        let units = [self.units.length, self.units.angle];
        (
            pairs.collect(),
            units.into_iter().flatten().map(Unit::symbol).collect(),
        )
    }

    /// The columns of some files, of which one that is an export with other rows is replaced by its
    /// points.
    pub(super) fn columns_of(
        &self,
        grids: &mut [Grid],
    ) -> Result<(Vec<Column>, Vec<Remark>), MeasurementError> {
        let (mut all, mut remarks) = (Vec::new(), Vec::new());
        let mut used = [false; 2];
        let mut found = vec![false; self.columns.len()];
        let points = grids.len() - 1;
        for (index, grid) in grids.iter_mut().enumerate() {
            let mut own = self.own((index, points > 0), grid, &mut found, &mut used)?;
            if index == points && !is_of_points(&own) {
                let export = exports::recognise(grid).map_err(|error| MeasurementError {
                    file: index,
                    ..error.into()
                })?;
                if let Some(export) = export {
                    if let Some(pivoted) = export.pivoted {
                        *grid = pivoted;
                    }
                    let listed: Vec<String> = export
                        .columns
                        .iter()
                        .map(|(key, theirs)| format!("{theirs} as {key}"))
                        .collect();
                    let message = format!(
                        "{} is read as {}: {}",
                        grid.name,
                        export.software,
                        listed.join(", ")
                    );
                    let hint =
                        "if that is not so, say what its columns are with --columns and --units";
                    remarks.push(note("export-recognised", message, hint));
                    let mut layout = self.clone();
                    let pairs = export
                        .columns
                        .iter()
                        .map(|(key, theirs)| (*key, theirs.as_str()));
                    layout
                        .add(pairs, false)
                        .map_err(|(message, hint)| fault(index, 0, message, hint))?;
                    let mut more = vec![false; layout.columns.len()];
                    own = layout.own((index, points > 0), grid, &mut more, &mut used)?;
                }
            }
            all.extend(own);
        }
        let missing = self
            .columns
            .iter()
            .zip(&found)
            .find(|(entry, found)| entry.required && !**found);
        if let Some((entry, _)) = missing {
            let names = grids
                .iter()
                .map(|grid| grid.name.as_str())
                .collect::<Vec<_>>()
                .join(" or ");
            let message = format!(
                "no column `{}` for {}: it is not in {names}",
                entry.theirs, entry.name
            );
            let header = grids
                .iter()
                .flat_map(|grid| grid.header.iter().map(String::as_str));
            let hint = nearest::hint(&entry.theirs, "columns", header);
            return Err(fault(points, 0, message, hint));
        }
        for (unit, used) in [self.units.length, self.units.angle].into_iter().zip(used) {
            if let Some(unit) = unit.filter(|_| !used && self.columns.iter().all(|e| e.required)) {
                let message = format!(
                    "no column takes the unit {}: names of the format have their own",
                    unit.symbol()
                );
                let hint = "map columns with --columns x=X,q1=J1, or leave the unit out of --units";
                return Err(fault(points, 0, message, hint));
            }
        }
        Ok((all, remarks))
    }

    /// The columns of one file; notes which entries and units it uses.
    fn own(
        &self,
        (index, several): (usize, bool),
        grid: &Grid,
        found: &mut [bool],
        used: &mut [bool; 2],
    ) -> Result<Vec<Column>, MeasurementError> {
        let mut own = Vec::new();
        // where each entry's column is: names as they are first, then whatever their case
        let field_of = |entry: &Entry| {
            let theirs = entry.theirs.as_str();
            let number = theirs
                .strip_prefix('#')
                .and_then(|n| n.parse::<usize>().ok());
            if let Some(number) = number {
                // of two files it is a column of the one that has what it is
                let joints = JOINT_COLUMNS.contains(&entry.name.as_str());
                let here = !several || entry.name == "id" || joints == (index == 0);
                let field = number
                    .checked_sub(1)
                    .filter(|field| *field < grid.header.len());
                return field.filter(|_| here);
            }
            let exact = grid.header.iter().position(|name| name == theirs);
            exact.or_else(|| {
                let alike = |name: &String| nearest::plain(name) == nearest::plain(theirs);
                let mut all = grid
                    .header
                    .iter()
                    .enumerate()
                    .filter(|(_, name)| alike(name));
                all.next()
                    .filter(|_| all.next().is_none())
                    .map(|(field, _)| field)
            })
        };
        let mut by_field: Vec<Option<&Entry>> = vec![None; grid.header.len()];
        for (entry, found) in self.columns.iter().zip(found) {
            if let Some(field) = field_of(entry) {
                if let Some(other) = by_field[field].replace(entry) {
                    let message = format!(
                        "`{}` is both {} and {}",
                        grid.header[field], other.name, entry.name
                    );
                    let hint = "one column of the format for each of the file";
                    return Err(fault(index, 0, message, hint));
                }
                *found = true;
            }
        }
        let mapped: Vec<&str> = by_field
            .iter()
            .flatten()
            .map(|entry| entry.name.as_str())
            .collect();
        let twice = (1..mapped.len()).find(|i| mapped[..*i].contains(&mapped[*i]));
        if let Some(twice) = twice {
            let message = format!("two columns of {} are {}", grid.name, mapped[twice]);
            return Err(fault(
                index,
                0,
                message,
                "one column of each file for each of the format",
            ));
        }
        for (field, theirs) in grid.header.iter().enumerate() {
            let (name, factor) = if let Some(entry) = by_field[field] {
                (entry.name.clone(), self.factor(index, entry, theirs, used)?)
            } else if mapped.contains(&theirs.as_str()) {
                // another column stands for it
                continue;
            } else if let Some((name, unit)) = in_another_unit(theirs) {
                (name, unit.factor())
            } else {
                (theirs.clone(), 1.0)
            };
            own.push(Column {
                name,
                grid: index,
                field,
                factor,
            });
        }
        Ok(own)
    }

    fn factor(
        &self,
        index: usize,
        entry: &Entry,
        theirs: &str,
        used: &mut [bool; 2],
    ) -> Result<f64, MeasurementError> {
        let said = self.units.of(entry.quantity);
        let own = in_name(theirs).and_then(|(_, unit)| unit);
        let own = own.filter(|unit| unit.quantity() == entry.quantity);
        let slot = match entry.quantity {
            Quantity::Length => &mut used[0],
            Quantity::Angle => &mut used[1],
            Quantity::Other => return Ok(1.0),
        };
        *slot = true;
        if let Some((said, own)) = said.zip(own).filter(|(said, own)| said != own) {
            let message = format!(
                "the column `{theirs}` is in {}, --units says {}",
                own.symbol(),
                said.symbol()
            );
            return Err(fault(
                index,
                0,
                message,
                "leave the unit out of --units, or correct it",
            ));
        }
        Ok(own.or(said).map_or(1.0, Unit::factor))
    }
}

/// Whether a file has columns of what was measured.
fn is_of_points(columns: &[Column]) -> bool {
    let has = |name: &str| columns.iter().any(|column| column.name == name);
    let position = POSITION_COLUMNS.iter().any(|name| has(name));
    let other = ["distance_mm", "contact", "target_x_mm"]
        .iter()
        .any(|name| has(name));
    position || other || columns.iter().any(|column| column.of_point().is_some())
}

/// Whether a file has all columns of joints.
pub(super) fn has_joints(columns: &[Column], grid: usize) -> bool {
    let own = |name: &str| columns.iter().any(|c| c.grid == grid && c.name == name);
    JOINT_COLUMNS.iter().all(|name| own(name))
}
