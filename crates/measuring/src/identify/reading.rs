//! The rows of a table as measurements: strictly, each fault with its file, line and column.

use super::contact;
use super::fault::{MeasurementError, MeasurementFault, UNIT_TOLERANCE, beyond};
use super::measurements::{
    CENTRE_COLUMNS, DIFFERENCE_COLUMNS, DIRECTION_COLUMNS, DISTANCE_COLUMNS, EXTERNAL_DEG_COLUMNS,
    EXTERNAL_DIRECTION_COLUMNS, EXTERNAL_MM_COLUMNS, FORCE_COLUMNS, JOINT_COLUMNS, MOVE_COLUMNS,
    Measurement, Measurements, NORMAL_COLUMNS, Observed, POINT_COLUMNS, POSITION_COLUMNS, Purpose,
    QUATERNION_COLUMNS, TARGET_COLUMNS, last_moves,
};
use super::table::{Euler, Grid, Mapping, Row, Table};
use crate::geometry::units::{DEG, m_from_mm};
use crate::geometry::{Pose, Quaternion, Vector, add};
use crate::model::Conditions;
use crate::model::external::Stand;

/// Smallest standard deviation, metres.
const LEAST_SIGMA_M: f64 = 1e-12;
/// And of an orientation, radians.
const LEAST_SIGMA_RAD: f64 = 1e-11;

/// The columns of a table as groups of the format.
pub(super) struct Reader<'a> {
    table: &'a Table,
}

/// The cells of a row.
pub(super) struct Cells<'a> {
    pub(super) reader: &'a Reader<'a>,
    row: &'a Row,
}

impl Reader<'_> {
    pub(super) fn has(&self, columns: &[&str]) -> bool {
        columns
            .iter()
            .all(|column| self.table.index(column).is_some())
    }

    /// None of these columns is there, or all are.
    fn group(&self, columns: &[&'static str]) -> Result<bool, MeasurementError> {
        let all = &self.table.columns;
        for column in columns {
            if all.iter().filter(|own| own.name == *column).count() > 1 {
                return Err(self.whole_file(MeasurementFault::TwiceColumn { column }));
            }
        }
        let present = columns.iter().filter(|c| self.has(&[c])).count();
        if present != 0 && present != columns.len() {
            return Err(self.missing(columns));
        }
        Ok(present != 0)
    }

    fn whole_file(&self, fault: MeasurementFault) -> MeasurementError {
        MeasurementError {
            file: self.table.main_file(),
            line: 0,
            column: 1,
            length: 0,
            fault,
        }
    }

    fn missing(&self, columns: &[&'static str]) -> MeasurementError {
        let missing = columns.iter().filter(|c| !self.has(&[c]));
        let missing: Vec<&'static str> = missing.copied().collect();
        let of_joints = missing.iter().any(|column| JOINT_COLUMNS.contains(column));
        // of two files, the one that should have them
        let file = if of_joints { 0 } else { self.table.main_file() };
        let header = self.table.grids[file].header.clone();
        MeasurementError {
            file,
            ..self.whole_file(MeasurementFault::MissingColumns { missing, header })
        }
    }
}

impl Cells<'_> {
    pub(super) fn text(&self, column: &str) -> Option<&str> {
        let table = self.reader.table;
        table.text(self.row, table.index_in(self.row, column)?)
    }

    pub(super) fn error(&self, column: &'static str, fault: MeasurementFault) -> MeasurementError {
        let table = self.reader.table;
        match table.index_in(self.row, column) {
            Some(index) => table.error(self.row, index, fault),
            None => MeasurementError {
                line: table.line(self.row),
                ..self.reader.whole_file(fault)
            },
        }
    }

    pub(super) fn number(&self, column: &'static str) -> Result<f64, MeasurementError> {
        let table = self.reader.table;
        let index = table.index_in(self.row, column);
        let Some(number) = index.and_then(|index| table.number(self.row, index)) else {
            let found = self.text(column).unwrap_or_default().to_owned();
            return Err(self.error(column, MeasurementFault::NotFinite { column, found }));
        };
        if let Some(limit) = beyond(column, number) {
            let found = self.text(column).unwrap_or_default().to_owned();
            let fault = MeasurementFault::TooLarge {
                column,
                found,
                limit,
            };
            return Err(self.error(column, fault));
        }
        Ok(number)
    }

    pub(super) fn numbers<const N: usize>(
        &self,
        columns: [&'static str; N],
    ) -> Result<[f64; N], MeasurementError> {
        let mut out = [0.0; N];
        for (slot, column) in out.iter_mut().zip(columns) {
            *slot = self.number(column)?;
        }
        Ok(out)
    }

    /// A number that is there where the column is.
    fn optional(&self, column: &'static str) -> Result<Option<f64>, MeasurementError> {
        if self.reader.has(&[column]) {
            self.number(column).map(Some)
        } else {
            Ok(None)
        }
    }

    fn name(&self, column: &'static str) -> Result<Option<String>, MeasurementError> {
        match self.text(column) {
            _ if !self.reader.has(&[column]) => Ok(None),
            Some(text) => Ok(Some(text.to_owned())),
            None => Err(self.not_allowed(column, "an empty cell".to_owned(), "a name")),
        }
    }

    pub(super) fn is_empty(&self, columns: &[&str]) -> bool {
        columns.iter().all(|column| self.text(column).is_none())
    }

    /// The measured position in mm; where only a wanted one and the difference are there, their
    /// sum.
    fn position(&self, kinds: Kinds) -> Result<Vector, MeasurementError> {
        if kinds.by_sum {
            let (target, difference) = (
                self.numbers(TARGET_COLUMNS)?,
                self.numbers(DIFFERENCE_COLUMNS)?,
            );
            return Ok(add(target, difference));
        }
        self.numbers(POSITION_COLUMNS)
    }

    fn observed(&self, kinds: Kinds) -> Result<Observed, MeasurementError> {
        let (mut point, mut distance) = (kinds.position, kinds.distance);
        if point && distance {
            let mut position_cells = POSITION_COLUMNS.to_vec();
            position_cells.extend(QUATERNION_COLUMNS.iter().filter(|_| kinds.quaternion));
            position_cells.extend(kinds.euler.iter().flat_map(|euler| euler.columns()));
            point = !self.is_empty(&position_cells);
            distance = !self.is_empty(&DISTANCE_COLUMNS);
            if point == distance {
                return Err(self.error("x_mm", MeasurementFault::Kind { both: point }));
            }
        }
        if !point && !distance {
            return Err(self.error("contact", MeasurementFault::Kind { both: false }));
        }
        if distance {
            let [distance, x, y, z] = self.numbers(DISTANCE_COLUMNS)?;
            if distance < 0.0 {
                let (column, allowed) = ("distance_mm", "zero or more");
                let found = distance.to_string();
                return Err(self.not_allowed(column, found, allowed));
            }
            return Ok(Observed::Distance {
                distance_m: m_from_mm(distance),
                from_m: [x, y, z].map(m_from_mm),
            });
        }
        let position = self.position(kinds)?.map(m_from_mm);
        if let Some(euler) = kinds.euler
            && !self.is_empty(&euler.columns())
        {
            let angles = self.numbers(euler.columns())?.map(|angle| angle * DEG);
            return Ok(Observed::Pose(Pose {
                rotation: euler.rotation(angles),
                translation: position,
            }));
        }
        // a row without orientation in a file where others have one
        if !kinds.quaternion || self.is_empty(&QUATERNION_COLUMNS) {
            return Ok(Observed::Position(position));
        }
        let quaternion = Quaternion(self.numbers(QUATERNION_COLUMNS)?);
        let norm = quaternion.norm();
        if (norm - 1.0).abs() > UNIT_TOLERANCE {
            return Err(self.error("qw", MeasurementFault::NotUnit { norm }));
        }
        Ok(Observed::Pose(Pose::from_parts(
            position,
            quaternion.normalized(),
        )))
    }

    /// The positioner on whose plate the point is; none of a point on the tool.
    fn plate(&self) -> Result<Option<String>, MeasurementError> {
        let on = self.name("on")?;
        match on
            .as_deref()
            .map(|on| on.split_once(':').unwrap_or((on, "")))
        {
            None | Some(("tool", "")) => Ok(None),
            Some(("plate", name)) if !name.is_empty() => Ok(Some(name.to_owned())),
            Some(_) => {
                let allowed =
                    "tool, or plate:NAME of a positioner; a tool seen from a part is not read";
                let found = format!("`{}`", on.unwrap_or_default());
                Err(self.not_allowed("on", found, allowed))
            }
        }
    }

    /// Where external axes stood.
    fn stand(&self) -> Result<Stand, MeasurementError> {
        let mut stand = Stand::default();
        let columns = EXTERNAL_MM_COLUMNS.into_iter().zip(EXTERNAL_DEG_COLUMNS);
        let columns = columns.zip(EXTERNAL_DIRECTION_COLUMNS);
        for (k, ((mm, deg), direction)) in columns.enumerate() {
            // an axis that does not carry the point may be left empty
            let there =
                |column: &'static str| Some(column).filter(|column| self.text(column).is_some());
            let value = match (there(mm), there(deg)) {
                (Some(mm), _) => Some(m_from_mm(self.number(mm)?)),
                (_, Some(deg)) => Some(self.number(deg)? * DEG),
                _ => None,
            };
            put(&mut stand.values, k, value, f64::NAN);
            let moved = match there(direction) {
                Some(direction) => Some(self.number(direction)?),
                None => None,
            };
            if let Some(moved) = moved.filter(|moved| ![-1.0, 0.0, 1.0].contains(moved)) {
                return Err(self.not_allowed(direction, moved.to_string(), "-1, 0 or 1"));
            }
            put(&mut stand.directions, k, moved, 0.0);
        }
        Ok(stand)
    }

    fn measurement(&self, number: usize, kinds: Kinds) -> Result<Measurement, MeasurementError> {
        let plate = self.plate()?;
        let q = match &plate {
            Some(_) if self.is_empty(&JOINT_COLUMNS) => [0.0; 6],
            None if !self.reader.has(&JOINT_COLUMNS) => {
                return Err(self.reader.missing(&JOINT_COLUMNS));
            }
            _ => self.numbers(JOINT_COLUMNS)?.map(|q| q * DEG),
        };
        let own_columns = self
            .row
            .point
            .map(|point| &self.reader.table.points[point].0);
        let point = match own_columns {
            Some(name) => Some(name.clone()),
            None => self.name("point")?,
        };
        let unnamed = point.is_none();
        let point_in_tool_m = if kinds.point && (unnamed || !self.is_empty(&POINT_COLUMNS)) {
            Some(self.numbers(POINT_COLUMNS)?.map(m_from_mm))
        } else {
            None
        };
        let mut conditions = Conditions {
            temperature_c: self.optional("temperature_c")?,
            time_s: self.optional("time_s")?,
            ..Conditions::default()
        };
        if let Some(motion) = self.row.motion {
            conditions.direction = motion.direction;
        } else if kinds.directions && plate.is_none() {
            for (slot, column) in conditions.direction.iter_mut().zip(DIRECTION_COLUMNS) {
                *slot = self.number(column)?;
                if ![-1.0, 0.0, 1.0].contains(slot) {
                    let (found, allowed) = (slot.to_string(), "-1, 0 or 1");
                    return Err(self.not_allowed(column, found, allowed));
                }
            }
        }
        if kinds.moves && plate.is_none() {
            conditions.moved = self.numbers(MOVE_COLUMNS)?.map(|q| q * DEG);
        }
        if kinds.force && plate.is_none() {
            conditions.force_n = self.numbers(FORCE_COLUMNS)?;
        }
        let sigma_m = self.optional("sigma_mm")?.map(m_from_mm);
        let sigma_rad = self.optional("sigma_deg")?.map(|sigma| sigma * DEG);
        for (sigma, least, column, allowed) in [
            (
                sigma_m,
                LEAST_SIGMA_M,
                "sigma_mm",
                "greater than zero: 1e-9 mm or more",
            ),
            (
                sigma_rad,
                LEAST_SIGMA_RAD,
                "sigma_deg",
                "greater than zero: 1e-9 deg or more",
            ),
        ] {
            if sigma.is_some_and(|sigma| sigma < least) {
                let found = self.text(column).unwrap_or_default().to_owned();
                return Err(self.not_allowed(column, found, allowed));
            }
        }
        let purpose = match self.name("set")?.as_deref() {
            None => None,
            Some("fit") => Some(Purpose::Fit),
            Some("validate") => Some(Purpose::Validate),
            Some(found) => {
                let (column, allowed, found) = ("set", "fit or validate", format!("`{found}`"));
                return Err(self.not_allowed(column, found, allowed));
            }
        };
        let contact = self.contact(kinds)?;
        if plate.is_some() {
            if contact.is_some() {
                let (found, allowed) = ("a contact".into(), "points that the device sees");
                return Err(self.not_allowed("on", found, allowed));
            }
            if point.is_none() && point_in_tool_m.is_none() {
                let allowed = "the name of the point on the plate, or its px_mm,py_mm,pz_mm there";
                return Err(self.not_allowed("point", "an empty cell".into(), allowed));
            }
        }
        let observed = match &contact {
            Some(contact) => contact.observed(),
            None => self.observed(kinds)?,
        };
        if let (Observed::Distance { from_m, .. }, None) = (observed, &contact) {
            // a distance is read from where it begins
            conditions.device_m = from_m;
        }
        let stand = if kinds.external {
            self.stand()?
        } else {
            Stand::default()
        };
        Ok(Measurement {
            line: self.reader.table.line(self.row).into(),
            id: self
                .text("id")
                .map_or_else(|| number.to_string(), str::to_owned),
            q,
            observed,
            tool: match plate {
                None => self.name("tool")?,
                Some(_) => None,
            },
            point,
            point_in_tool_m,
            conditions,
            stand,
            plate,
            sigma_m,
            sigma_rad,
            purpose,
            contact,
        })
    }
}

/// Puts a number at its place; what is between it and the others is `unknown`.
fn put(into: &mut Vec<f64>, at: usize, value: Option<f64>, unknown: f64) {
    if let Some(value) = value {
        into.resize(at, unknown);
        into.push(value);
    }
}

/// Which groups of columns a file has.
#[derive(Clone, Copy)]
#[allow(clippy::struct_excessive_bools, reason = "one a group of columns")]
pub(super) struct Kinds {
    position: bool,
    quaternion: bool,
    /// How three angles turn, where there are such.
    euler: Option<Euler>,
    /// Whether a position is a wanted one and a difference.
    by_sum: bool,
    distance: bool,
    point: bool,
    directions: bool,
    moves: bool,
    force: bool,
    contact: bool,
    external: bool,
    pub(super) probe: bool,
}

impl Measurements {
    /// Reads a file's bytes: a table with a header, columns in any order, lines that start with `#`
    /// left out.
    ///
    /// Where a file has columns of both a position and a distance, or of a position and an
    /// orientation, a row leaves the cells empty of what was not measured. Every other empty or
    /// non-finite cell is an error.
    ///
    /// # Errors
    /// Anything the format does not allow, with line and column.
    pub fn from_csv(bytes: &[u8]) -> Result<Self, MeasurementError> {
        let table = Table::of(Grid::read("", bytes)?, &Mapping::default())?;
        Self::from_table(&table)
    }

    /// Reads a table whose columns are known.
    ///
    /// # Errors
    /// As [`Measurements::from_csv`].
    pub fn from_table(table: &Table) -> Result<Self, MeasurementError> {
        let reader = Reader { table };
        // of points on a plate the arm's joints say nothing
        if !reader.group(&JOINT_COLUMNS)? && !reader.has(&["on"]) {
            return Err(reader.missing(&JOINT_COLUMNS));
        }
        let own_columns = !table.points.is_empty();
        let position = reader.group(&POSITION_COLUMNS)? || own_columns;
        let targets = reader.group(&TARGET_COLUMNS)? && reader.group(&DIFFERENCE_COLUMNS)?;
        let by_sum = targets && !position;
        let quaternion = reader.group(&QUATERNION_COLUMNS)?;
        if let Some(euler) = table.euler {
            if !reader.group(&euler.columns())? {
                return Err(reader.missing(&euler.columns()));
            }
            if quaternion {
                let message = "the file has both a quaternion and angles".to_owned();
                let hint = "leave --euler out, or map other columns".to_owned();
                return Err(reader.whole_file(MeasurementFault::Csv { message, hint }));
            }
        }
        let mut external = false;
        for (mm, deg) in EXTERNAL_MM_COLUMNS.into_iter().zip(EXTERNAL_DEG_COLUMNS) {
            let [has_mm, has_deg] = [reader.group(&[mm])?, reader.group(&[deg])?];
            if has_mm && has_deg {
                let message = format!("the file has both {mm} and {deg}");
                let hint = "an external axis is linear or rotary: one column each".to_owned();
                return Err(reader.whole_file(MeasurementFault::Csv { message, hint }));
            }
            external |= has_mm || has_deg;
        }
        for direction in EXTERNAL_DIRECTION_COLUMNS {
            external |= reader.group(&[direction])?;
        }
        let kinds = Kinds {
            position: position || by_sum,
            quaternion,
            euler: table.euler,
            by_sum,
            distance: reader.group(&DISTANCE_COLUMNS)?,
            point: reader.group(&POINT_COLUMNS)?,
            directions: reader.group(&DIRECTION_COLUMNS)?,
            moves: reader.group(&MOVE_COLUMNS)?,
            force: reader.group(&FORCE_COLUMNS)?,
            contact: reader.group(&["contact"])?,
            external,
            probe: reader.group(&["probe_radius_mm"])?,
        };
        for single in [
            "id",
            "tool",
            "point",
            "temperature_c",
            "time_s",
            "sigma_mm",
            "sigma_deg",
            "set",
            "on",
        ] {
            reader.group(&[single])?;
        }
        let centre = reader.group(&CENTRE_COLUMNS)?;
        let described = reader.group(&NORMAL_COLUMNS)? | centre | reader.group(&["radius_mm"])?;
        let named = reader.group(&["feature"])?;
        if kinds.contact != named || described && !named {
            return Err(reader.missing(&["contact", "feature"]));
        }
        let others = kinds.position || kinds.distance && !kinds.quaternion;
        if !others && !kinds.contact {
            return Err(reader.missing(&POSITION_COLUMNS));
        }
        let mut rows = Vec::with_capacity(table.rows.len());
        for row in &table.rows {
            let cells = Cells {
                reader: &reader,
                row,
            };
            rows.push(cells.measurement(rows.len() + 1, kinds)?);
        }
        if rows.is_empty() {
            return Err(reader.whole_file(MeasurementFault::NoRows));
        }
        if !kinds.moves {
            let of_tool = |row: &&Measurement| row.plate.is_none();
            let postures: Vec<_> = rows.iter().filter(of_tool).map(|row| row.q).collect();
            let mut moves = last_moves(&postures).into_iter();
            for (row, cells) in rows.iter_mut().zip(&table.rows) {
                if row.plate.is_none() {
                    let before = moves.next().unwrap_or_default();
                    row.conditions.moved = cells.motion.map_or(before, |own| own.moved);
                }
            }
        }
        contact::settle(&mut rows).map_err(|conflict| MeasurementError {
            line: conflict.line,
            ..reader.whole_file(MeasurementFault::Contradiction {
                feature: conflict.feature,
                earlier: conflict.earlier,
            })
        })?;
        Ok(Self {
            rows,
            columns: table.names(),
        })
    }
}
