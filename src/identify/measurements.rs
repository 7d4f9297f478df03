//! Measurements: what a device saw of the tool, one row a reading, read strictly from a CSV file.

use crate::geometry::units::{DEG, m_from_mm};
use crate::geometry::{Pose, Quaternion, Vector};
use crate::model::Conditions;

use super::contact::{self, Contact, ContactKind};
use super::doubt::csv::not_csv;
use super::line::Line;

pub use super::fault::{MeasurementError, MeasurementFault};

use super::fault::{UNIT_TOLERANCE, beyond};

/// Columns of joint angles.
pub const JOINT_COLUMNS: [&str; 6] = ["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"];
/// Columns of a position.
pub const POSITION_COLUMNS: [&str; 3] = ["x_mm", "y_mm", "z_mm"];
/// Columns of an orientation.
pub const QUATERNION_COLUMNS: [&str; 4] = ["qw", "qx", "qy", "qz"];
/// Columns of a distance from a fixed point of the world.
pub const DISTANCE_COLUMNS: [&str; 4] = ["distance_mm", "from_x_mm", "from_y_mm", "from_z_mm"];
/// Columns of the measured point in the tool frame.
pub const POINT_COLUMNS: [&str; 3] = ["px_mm", "py_mm", "pz_mm"];
/// Columns of the directions in which the joints last moved.
pub const DIRECTION_COLUMNS: [&str; 6] = ["dir1", "dir2", "dir3", "dir4", "dir5", "dir6"];
/// Columns of the external force on the tool.
pub const FORCE_COLUMNS: [&str; 3] = ["fx_n", "fy_n", "fz_n"];

/// Smallest standard deviation, metres.
const LEAST_SIGMA_M: f64 = 1e-12;

/// Columns of a touched sphere's centre, of a point of a touched plane, or of a touched point.
pub const CENTRE_COLUMNS: [&str; 3] = ["cx_mm", "cy_mm", "cz_mm"];
/// Columns of the outward normal of a touched plane.
pub const NORMAL_COLUMNS: [&str; 3] = ["nx", "ny", "nz"];

/// What the device gave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Observed {
    /// The measured point in the world, metres.
    Position(Vector),
    /// The measured point with the tool's axes in the world.
    Pose(Pose),
    /// Distance of the measured point from a point of the world, metres.
    Distance {
        /// The distance.
        distance_m: f64,
        /// Where it is measured from.
        from_m: Vector,
    },
    /// Contact with something of which not all is known; see [`Measurement::contact`].
    Contact(ContactKind),
}

impl Observed {
    /// How many numbers are compared: 3, 6, 1, or those of the contact.
    #[must_use]
    pub const fn count(&self) -> usize {
        match self {
            Self::Position(_) => 3,
            Self::Pose(_) => 6,
            Self::Distance { .. } => 1,
            Self::Contact(kind) => kind.count(),
        }
    }

    /// The measured point in the world, where it was seen.
    #[must_use]
    pub const fn point_m(&self) -> Option<Vector> {
        match self {
            Self::Position(p) => Some(*p),
            Self::Pose(pose) => Some(pose.translation),
            Self::Distance { .. } | Self::Contact(_) => None,
        }
    }
}

/// What a row is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Purpose {
    /// To identify with.
    Fit,
    /// To judge with.
    Validate,
}

impl Purpose {
    /// Its name in the column `set`.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Fit => "fit",
            Self::Validate => "validate",
        }
    }
}

/// One reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Where it stands.
    pub line: Line,
    /// The column `id`, else the row's number from 1.
    pub id: String,
    /// Commanded joint angles in the controller's sense, radians.
    pub q: [f64; 6],
    /// What the device gave.
    pub observed: Observed,
    /// Name of the tool.
    pub tool: Option<String>,
    /// Name of the measured point.
    pub point: Option<String>,
    /// The measured point in the tool frame, metres.
    pub point_in_tool_m: Option<Vector>,
    /// Direction, force, temperature, time.
    pub conditions: Conditions,
    /// Standard uncertainty of a coordinate or distance, metres.
    pub sigma_m: Option<f64>,
    /// What the row is for.
    pub purpose: Option<Purpose>,
    /// What the probe touched.
    pub contact: Option<Contact>,
}

/// A file's readings in the order in which they were measured.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Measurements {
    /// The readings.
    pub rows: Vec<Measurement>,
    /// Names of the columns, as the file has them.
    pub columns: Vec<String>,
}

fn whole_file(fault: MeasurementFault) -> MeasurementError {
    MeasurementError {
        line: 0,
        column: 1,
        length: 0,
        fault,
    }
}

/// The header and where each column of the format stands.
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    header: Vec<String>,
}

pub(super) struct Cells<'a> {
    pub(super) reader: &'a Reader<'a>,
    line: usize,
    record: csv::StringRecord,
}

impl Reader<'_> {
    fn index(&self, column: &str) -> Option<usize> {
        self.header.iter().position(|name| name == column)
    }

    pub(super) fn has(&self, columns: &[&str]) -> bool {
        columns.iter().all(|column| self.index(column).is_some())
    }

    /// None of these columns is there, or all are.
    fn group(&self, columns: &[&'static str]) -> Result<bool, MeasurementError> {
        for column in columns {
            if self.header.iter().filter(|name| name == column).count() > 1 {
                return Err(whole_file(MeasurementFault::TwiceColumn { column }));
            }
        }
        let present = columns.iter().filter(|c| self.index(c).is_some()).count();
        if present != 0 && present != columns.len() {
            return Err(self.missing(columns));
        }
        Ok(present != 0)
    }

    fn missing(&self, columns: &[&'static str]) -> MeasurementError {
        let missing = columns.iter().filter(|c| self.index(c).is_none());
        whole_file(MeasurementFault::MissingColumns {
            missing: missing.copied().collect(),
            header: self.header.clone(),
        })
    }
}

impl Cells<'_> {
    pub(super) fn text(&self, column: &str) -> Option<&str> {
        let text = self.record.get(self.reader.index(column)?)?;
        (!text.is_empty()).then_some(text)
    }

    pub(super) fn error(&self, column: &'static str, fault: MeasurementFault) -> MeasurementError {
        let index = self.reader.index(column).unwrap_or(0);
        let mut lines = self.reader.bytes.split(|b| *b == b'\n');
        let line = lines.nth(self.line.saturating_sub(1)).unwrap_or_default();
        let commas = line.iter().enumerate().filter(|(_, b)| **b == b',');
        let starts = std::iter::once(0).chain(commas.map(|(at, _)| at + 1));
        MeasurementError {
            line: self.line,
            column: starts.clone().nth(index).unwrap_or(0) + 1,
            length: self.text(column).map_or(0, str::len),
            fault,
        }
    }

    pub(super) fn number(&self, column: &'static str) -> Result<f64, MeasurementError> {
        let text = self.text(column).unwrap_or_default();
        let number = text.parse().ok().filter(|n: &f64| n.is_finite());
        let found = text.to_owned();
        let Some(number) = number else {
            return Err(self.error(column, MeasurementFault::NotFinite { column, found }));
        };
        if let Some(limit) = beyond(column, number) {
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
        match self.reader.index(column) {
            Some(_) => self.number(column).map(Some),
            None => Ok(None),
        }
    }

    fn name(&self, column: &'static str) -> Result<Option<String>, MeasurementError> {
        match (self.reader.index(column), self.text(column)) {
            (None, _) => Ok(None),
            (Some(_), Some(text)) => Ok(Some(text.to_owned())),
            (Some(_), None) => {
                let found = "an empty cell".to_owned();
                let allowed = "a name";
                Err(self.not_allowed(column, found, allowed))
            }
        }
    }

    pub(super) fn is_empty(&self, columns: &[&str]) -> bool {
        columns.iter().all(|column| self.text(column).is_none())
    }

    fn observed(&self, kinds: Kinds) -> Result<Observed, MeasurementError> {
        let (mut point, mut distance) = (kinds.position, kinds.distance);
        if point && distance {
            let mut position_cells = POSITION_COLUMNS.to_vec();
            position_cells.extend(QUATERNION_COLUMNS.iter().filter(|_| kinds.quaternion));
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
        let position = self.numbers(POSITION_COLUMNS)?.map(m_from_mm);
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

    fn measurement(&self, number: usize, kinds: Kinds) -> Result<Measurement, MeasurementError> {
        let q = self.numbers(JOINT_COLUMNS)?.map(|q| q * DEG);
        let point = self.name("point")?;
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
        if kinds.directions {
            for (slot, column) in conditions.direction.iter_mut().zip(DIRECTION_COLUMNS) {
                *slot = self.number(column)?;
                if ![-1.0, 0.0, 1.0].contains(slot) {
                    let (found, allowed) = (slot.to_string(), "-1, 0 or 1");
                    return Err(self.not_allowed(column, found, allowed));
                }
            }
        }
        if kinds.force {
            conditions.force_n = self.numbers(FORCE_COLUMNS)?;
        }
        let sigma_m = self.optional("sigma_mm")?.map(m_from_mm);
        if sigma_m.is_some_and(|sigma| sigma < LEAST_SIGMA_M) {
            let (column, allowed) = ("sigma_mm", "greater than zero: 1e-9 mm or more");
            let found = self.text(column).unwrap_or_default().to_owned();
            return Err(self.not_allowed(column, found, allowed));
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
        Ok(Measurement {
            line: self.line.into(),
            id: self
                .text("id")
                .map_or_else(|| number.to_string(), str::to_owned),
            q,
            observed: match &contact {
                Some(contact) => contact.observed(),
                None => self.observed(kinds)?,
            },
            tool: self.name("tool")?,
            point,
            point_in_tool_m,
            conditions,
            sigma_m,
            purpose,
            contact,
        })
    }
}

/// Which groups of columns a file has.
#[derive(Clone, Copy)]
#[allow(clippy::struct_excessive_bools, reason = "one a group of columns")]
pub(super) struct Kinds {
    position: bool,
    quaternion: bool,
    distance: bool,
    point: bool,
    directions: bool,
    force: bool,
    contact: bool,
    pub(super) probe: bool,
}

impl Measurements {
    /// Reads a file's bytes: a CSV with a header, columns in any order, lines that start with `#` left out.
    ///
    /// Where a file has columns of both a position and a distance, or of a position and an orientation, a row leaves the
    /// cells empty of what was not measured. Every other empty or non-finite cell is an error.
    ///
    /// # Errors
    /// Anything the format does not allow, with line and column.
    pub fn from_csv(bytes: &[u8]) -> Result<Self, MeasurementError> {
        if let Some(found) = not_csv(bytes) {
            return Err(found.into());
        }
        let mut source = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(bytes);
        let fault = |error: &csv::Error| {
            let line = error.position().map_or(0, csv::Position::line);
            let message = match error.kind() {
                csv::ErrorKind::UnequalLengths {
                    expected_len, len, ..
                } => format!("{len} cells; the header has {expected_len}"),
                csv::ErrorKind::Utf8 { .. } => "not UTF-8 text".into(),
                _ => error.to_string(),
            };
            MeasurementError {
                line: usize::try_from(line).unwrap_or(0),
                column: 1,
                length: 0,
                fault: MeasurementFault::Csv {
                    message,
                    hint: String::new(),
                },
            }
        };
        let header: Vec<String> = source
            .headers()
            .map_err(|error| fault(&error))?
            .iter()
            .map(|name| name.trim_start_matches('\u{feff}').to_owned())
            .collect();
        let reader = Reader { bytes, header };
        if !reader.group(&JOINT_COLUMNS)? {
            return Err(reader.missing(&JOINT_COLUMNS));
        }
        let kinds = Kinds {
            position: reader.group(&POSITION_COLUMNS)?,
            quaternion: reader.group(&QUATERNION_COLUMNS)?,
            distance: reader.group(&DISTANCE_COLUMNS)?,
            point: reader.group(&POINT_COLUMNS)?,
            directions: reader.group(&DIRECTION_COLUMNS)?,
            force: reader.group(&FORCE_COLUMNS)?,
            contact: reader.group(&["contact"])?,
            probe: reader.group(&["probe_radius_mm"])?,
        };
        for single in [
            "id",
            "tool",
            "point",
            "temperature_c",
            "time_s",
            "sigma_mm",
            "set",
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
        let mut rows = Vec::new();
        for record in source.records() {
            let record = record.map_err(|error| fault(&error))?;
            let line = record.position().map_or(0, csv::Position::line);
            let cells = Cells {
                reader: &reader,
                line: usize::try_from(line).unwrap_or(0),
                record,
            };
            rows.push(cells.measurement(rows.len() + 1, kinds)?);
        }
        if rows.is_empty() {
            return Err(whole_file(MeasurementFault::NoRows));
        }
        contact::settle(&mut rows).map_err(|conflict| MeasurementError {
            line: conflict.line,
            column: 1,
            length: 0,
            fault: MeasurementFault::Contradiction {
                feature: conflict.feature,
                earlier: conflict.earlier,
            },
        })?;
        Ok(Self {
            rows,
            columns: reader.header.clone(),
        })
    }

    /// Whether the file has all these columns.
    #[must_use]
    pub fn has(&self, columns: &[&str]) -> bool {
        let reader = Reader {
            bytes: &[],
            header: self.columns.clone(),
        };
        reader.has(columns)
    }

    /// Those rows that `keep` wants.
    #[must_use]
    pub fn filtered(&self, mut keep: impl FnMut(usize, &Measurement) -> bool) -> Self {
        let kept = self
            .rows
            .iter()
            .enumerate()
            .filter(|(i, row)| keep(*i, row));
        Self {
            rows: kept.map(|(_, row)| row.clone()).collect(),
            columns: self.columns.clone(),
        }
    }

    /// The number of the configuration of each row: rows in sequence with the same joint angles are one, from 0.
    #[must_use]
    pub fn configurations(&self) -> Vec<usize> {
        let mut number = 0;
        let mut all = Vec::with_capacity(self.rows.len());
        for (i, row) in self.rows.iter().enumerate() {
            if i > 0 && row.q != self.rows[i - 1].q {
                number += 1;
            }
            all.push(number);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,";

    fn read(columns: &str, rows: &[&str]) -> Result<Measurements, MeasurementError> {
        let mut text = format!("# a comment\n{HEADER}{columns}\n");
        for row in rows {
            text += &format!("1,2,3,4,5,6,{row}\n");
        }
        Measurements::from_csv(text.as_bytes())
    }

    fn fault(columns: &str, rows: &[&str]) -> MeasurementError {
        read(columns, rows).expect_err("it should be refused")
    }

    #[test]
    fn positions_poses_and_distances_stand_in_one_file() {
        let columns = "x_mm,y_mm,z_mm,qw,qx,qy,qz,distance_mm,from_x_mm,from_y_mm,from_z_mm";
        let rows = ["1,2,3,,,,,,,,", "1,2,3,1,0,0,0,,,,", ",,,,,,,500,1,2,3"];
        let all = read(columns, &rows).expect("a mixed file");
        assert_eq!(
            all.rows
                .iter()
                .map(|r| r.observed.count())
                .collect::<Vec<_>>(),
            [3, 6, 1]
        );
        assert_eq!(all.rows[0].q[1], 2.0 * DEG);
        assert_eq!(all.rows[2].line, Line::from(5));
        let both = fault(columns, &["1,2,3,,,,,500,1,2,3"]);
        assert_eq!(both.fault, MeasurementFault::Kind { both: true });
        let neither = fault(columns, &[",,,,,,,,,,"]);
        assert_eq!(neither.fault, MeasurementFault::Kind { both: false });
    }

    #[test]
    fn a_bad_cell_is_named_with_its_line_and_column() {
        let error = fault("x_mm,y_mm,z_mm", &["1,2,3", "1,NaN,3"]);
        assert_eq!((error.line, error.column, error.length), (4, 15, 3));
        assert!(error.to_string().contains("y_mm"));
        for (columns, row) in [
            ("x_mm,y_mm,z_mm", "1,,3"),
            ("x_mm,y_mm,z_mm", "1,2"),
            ("x_mm,y_mm", "1,2"),
            ("x_mm,x_mm,y_mm,z_mm", "1,1,2,3"),
            ("x_mm,y_mm,z_mm,sigma_mm", "1,2,3,0"),
            ("x_mm,y_mm,z_mm,set", "1,2,3,other"),
            ("x_mm,y_mm,z_mm,point", "1,2,3,"),
            (
                "x_mm,y_mm,z_mm,dir1,dir2,dir3,dir4,dir5,dir6",
                "1,2,3,1,1,1,1,1,2",
            ),
            ("x_mm,y_mm,z_mm,qw,qx,qy,qz", "1,2,3,1,1,0,0"),
            ("distance_mm,from_x_mm,from_y_mm,from_z_mm", "-1,0,0,0"),
            ("sigma_mm", "1"),
        ] {
            assert!(read(columns, &[row]).is_err(), "{columns} {row}");
        }
        assert_eq!(fault("x_mm,y_mm,z_mm", &[]).fault, MeasurementFault::NoRows);
    }

    #[test]
    fn named_points_may_have_no_coordinates() {
        let all = read(
            "x_mm,y_mm,z_mm,point,px_mm,py_mm,pz_mm",
            &["1,2,3,a,,,", "1,2,3,b,4,5,6"],
        );
        let all = all.expect("a file of two points");
        assert_eq!(all.rows[0].point_in_tool_m, None);
        assert_eq!(all.rows[1].point_in_tool_m, Some([0.004, 0.005, 0.006]));
        assert_eq!(all.configurations(), [0, 0]);
    }
}
