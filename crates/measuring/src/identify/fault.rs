//! What can be wrong with a file of measurements, and where.

use super::input_checks::csv::NotCsv;
use super::table::{is_of_format, proposal};
use crate::nearest;

/// How far a quaternion's length may be from 1.
pub(super) const UNIT_TOLERANCE: f64 = 1e-3;

/// Largest numbers by how the column's name ends, and what they are called.
const MOST: [(&str, (f64, &str)); 4] = [
    ("_mm", (1e8, "100 km: 1e8 mm")),
    ("_deg", (1e5, "277 turns: 1e5 deg")),
    // seconds since 1970 are fewer, milliseconds are more
    ("_s", (1e10, "317 years: 1e10 s")),
    ("_n", (1e7, "the weight of 1000 tonnes: 1e7 N")),
];
/// Of the other columns.
const MOST_OTHERS: (f64, &str) = (1e12, "1e12");
/// Temperatures that a robot may have, degrees Celsius.
const TEMPERATURES_C: (std::ops::RangeInclusive<f64>, &str) =
    (-273.15..=1000.0, "-273 to 1000 degrees Celsius");

/// The limit that a number of a column is beyond, by the unit that ends its name.
pub fn beyond(column: &str, number: f64) -> Option<&'static str> {
    if column == "temperature_c" {
        let (range, limit) = TEMPERATURES_C;
        return (!range.contains(&number)).then_some(limit);
    }
    let own = MOST.iter().find(|(ending, _)| column.ends_with(ending));
    let (most, limit) = own.map_or(MOST_OTHERS, |(_, most)| *most);
    (number.abs() > most).then_some(limit)
}

/// A fault at its place in the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{fault}")]
pub struct MeasurementError {
    /// Which of the files, from 0.
    pub file: usize,
    /// Line, from 1; 0 is the whole file.
    pub line: usize,
    /// Column in bytes, from 1.
    pub column: usize,
    /// Length of what is to blame, bytes; 0 where it is not known.
    pub length: usize,
    /// What is wrong.
    pub fault: MeasurementFault,
}

impl From<NotCsv> for MeasurementError {
    fn from(found: NotCsv) -> Self {
        Self {
            file: 0,
            line: found.line,
            column: found.column,
            length: 0,
            fault: MeasurementFault::Csv {
                message: found.message,
                hint: found.hint,
            },
        }
    }
}

/// What is wrong with a file of measurements.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeasurementFault {
    /// No CSV.
    #[error("{message}")]
    Csv {
        /// What the parser says.
        message: String,
        /// The way out; may be empty.
        hint: String,
    },
    /// Columns that must be there are not.
    #[error("columns are missing: {}", missing.join(", "))]
    MissingColumns {
        /// Which.
        missing: Vec<&'static str>,
        /// Those that are there.
        header: Vec<String>,
    },
    /// A column of the format that stands twice.
    #[error("the column {column} stands twice")]
    TwiceColumn {
        /// Which.
        column: &'static str,
    },
    /// Nothing was measured.
    #[error("no rows")]
    NoRows,
    /// A cell that is no finite number.
    #[error("column {column}: {} is not a finite number", if found.is_empty() { "an empty \
        cell".to_owned() } else { format!("`{found}`") })]
    NotFinite {
        /// The column.
        column: &'static str,
        /// What stands there.
        found: String,
    },
    /// A number that nothing measured has.
    #[error("column {column}: {found} is beyond {limit}")]
    TooLarge {
        /// The column.
        column: &'static str,
        /// What stands there.
        found: String,
        /// The limit, with its unit.
        limit: &'static str,
    },
    /// A number outside its range.
    #[error("column {column}: {found} is not {allowed}")]
    NotAllowed {
        /// The column.
        column: &'static str,
        /// What stands there.
        found: String,
        /// What may stand there.
        allowed: &'static str,
    },
    /// A quaternion that is no rotation.
    #[error("the quaternion's length is {norm:.6}; it may differ from 1 by {UNIT_TOLERANCE}")]
    NotUnit {
        /// Its length.
        norm: f64,
    },
    /// Rows that say different things of one touched feature.
    #[error("feature `{feature}` is another one in line {earlier}")]
    Contradiction {
        /// Its name.
        feature: String,
        /// Line of the earlier row.
        earlier: usize,
    },
    /// A row with both a position and a distance, or with neither.
    #[error("the row has {} a position and a distance; it must have one of \
        them", if *both { "both" } else { "neither" })]
    Kind {
        /// Both, or neither.
        both: bool,
    },
}

impl MeasurementError {
    /// The way out; empty where the message says it all.
    #[must_use]
    pub fn hint(&self) -> String {
        match &self.fault {
            MeasurementFault::Csv { hint, .. } => hint.clone(),
            MeasurementFault::MissingColumns { missing, header } => {
                let proposal = proposal(header);
                let names = || header.iter().map(String::as_str);
                let meant = missing.iter().filter_map(|column| {
                    let near = nearest::nearest(column, names().filter(|name| !is_of_format(name)));
                    Some(nearest::instead_of_column(near.first()?, column))
                });
                let mut hint: Vec<String> = if proposal.is_empty() {
                    meant.collect()
                } else {
                    vec![format!("is it `{proposal}`?")]
                };
                hint.push(format!("the header has: {}", header.join(", ")));
                hint.join(" ")
            }
            MeasurementFault::NotFinite { found, .. } if found.contains(',') => {
                "decimals have a comma or a point, all of a file the same, and thousands have no \
                 sign"
                    .into()
            }
            MeasurementFault::NotFinite { .. } => {
                "leave the row out where it was not measured, or all cells of the kind that was \
                 not"
                .into()
            }
            MeasurementFault::NotUnit { .. } => {
                "qw,qx,qy,qz, the scalar first; angles are read with --euler".into()
            }
            MeasurementFault::TooLarge { .. } => {
                "is a decimal point lost, or is it an error code of the device? correct the number \
                 or leave the row out"
                    .into()
            }
            MeasurementFault::Kind { .. } => {
                "leave the cells of the other kind empty: x_mm,y_mm,z_mm or \
                 distance_mm,from_x_mm,from_y_mm,from_z_mm"
                    .into()
            }
            MeasurementFault::Contradiction { .. } => {
                "one name is one feature: the same contact, cx_mm,cy_mm,cz_mm, radius_mm and \
                 nx,ny,nz in every row, or empty cells"
                    .into()
            }
            _ => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::measurements::Measurements;

    fn read(row: &str) -> Result<Measurements, MeasurementError> {
        let header =
            "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,sigma_mm,temperature_c";
        Measurements::from_csv(format!("{header}\n{row}\n").as_bytes())
    }

    fn fault(row: &str) -> MeasurementError {
        read(row).expect_err("it should be refused")
    }

    #[test]
    fn numbers_that_nothing_measured_has_are_refused_with_their_limit() {
        for (row, column, limit) in [
            ("1e300,2,3,1,20", "x_mm", "1e8 mm"),
            ("1,2,-2e8,1,20", "z_mm", "1e8 mm"),
            ("1,2,3,1e-320,20", "sigma_mm", "1e-9 mm"),
            ("1,2,3,1,1e13", "temperature_c", "-273 to 1000"),
            ("1,2,3,1,-400", "temperature_c", "-273 to 1000"),
        ] {
            let error = fault(&format!("1,2,3,4,5,6,{row}"));
            let text = error.to_string();
            assert_eq!(error.line, 2, "{row}");
            assert!(text.contains(column) && text.contains(limit), "{text}");
        }
        let text = fault("1,2,3,-1e300,5,6,1,2,3,1,20").to_string();
        assert!(text.contains("q4_deg: -1e300 is beyond"), "{text}");
        // micrometres of a tracker far away
        assert!(read("1,2,3,4,5,6,9e7,2,3,1,20").is_ok());
    }
}
