//! Units of tables: by `--units`, or in the name of a column.

use super::names::Quantity;
use crate::geometry::units::DEG;
use crate::nearest;

/// A unit of lengths or angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Millimetre.
    Millimetre,
    /// Metre.
    Metre,
    /// Centimetre.
    Centimetre,
    /// Micrometre.
    Micrometre,
    /// Inch.
    Inch,
    /// Foot.
    Foot,
    /// Degree.
    Degree,
    /// Radian.
    Radian,
}

/// Each unit: its names, what it measures, and how many mm or degrees it is.
const UNITS: [(Unit, &[&str], Quantity, f64); 8] = [
    (Unit::Millimetre, &["mm"], Quantity::Length, 1.0),
    (Unit::Metre, &["m", "meter", "metre"], Quantity::Length, 1e3),
    (Unit::Centimetre, &["cm"], Quantity::Length, 10.0),
    (
        Unit::Micrometre,
        &["um", "\u{b5}m", "\u{3bc}m", "micron"],
        Quantity::Length,
        1e-3,
    ),
    (Unit::Inch, &["in", "inch", "\""], Quantity::Length, 25.4),
    (Unit::Foot, &["ft", "feet"], Quantity::Length, 304.8),
    (
        Unit::Degree,
        &["deg", "degree", "degrees", "\u{b0}"],
        Quantity::Angle,
        1.0,
    ),
    (
        Unit::Radian,
        &["rad", "radian", "radians"],
        Quantity::Angle,
        1.0 / DEG,
    ),
];

impl Unit {
    fn row(self) -> &'static (Self, &'static [&'static str], Quantity, f64) {
        UNITS
            .iter()
            .find(|row| row.0 == self)
            .expect("every unit has a row")
    }

    /// The unit of a name, in either case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let name = name.trim().to_lowercase();
        UNITS
            .iter()
            .find(|row| row.1.contains(&name.as_str()))
            .map(|row| row.0)
    }

    /// What it measures.
    #[must_use]
    pub fn quantity(self) -> Quantity {
        self.row().2
    }

    /// How many millimetres or degrees it is.
    #[must_use]
    pub fn factor(self) -> f64 {
        self.row().3
    }

    /// Its name.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        self.row().1[0]
    }
}

/// The unit that a column's name ends with, in brackets (`X [mm]`, `J1 (rad)`) or behind a blank,
/// and the name without it. The unit is `None` where what is in brackets is not known.
#[must_use]
pub(super) fn in_name(name: &str) -> Option<(&str, Option<Unit>)> {
    let name = name.trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((bare, unit)) = name.strip_suffix(close).and_then(|n| n.rsplit_once(open)) {
            return Some((bare.trim_end(), Unit::named(unit)));
        }
    }
    let (bare, unit) = name.rsplit_once([' ', '_', '/'])?;
    // a single letter may be a name: `T m`
    let unit = Unit::named(unit).filter(|unit| unit.symbol() != "m" || bare.len() <= 2)?;
    Some((bare.trim_end(), Some(unit)))
}

/// Units that `--units` names: one of lengths, one of angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// Of lengths.
    pub length: Option<Unit>,
    /// Of angles.
    pub angle: Option<Unit>,
}

impl Units {
    /// Reads `m,rad`.
    ///
    /// # Errors
    /// A name that is no unit; two of one kind.
    pub fn parse<'a>(words: impl IntoIterator<Item = &'a str>) -> Result<Self, (String, String)> {
        let mut units = Self::default();
        for word in words {
            let Some(unit) = Unit::named(word) else {
                let names = UNITS.iter().map(|row| row.1[0]);
                let hint = nearest::hint(word.trim(), "units", names);
                return Err((format!("`{}` is no unit", word.trim()), hint));
            };
            let slot = match unit.quantity() {
                Quantity::Length => &mut units.length,
                _ => &mut units.angle,
            };
            if let Some(earlier) = slot.replace(unit) {
                let message = format!(
                    "{} and {} are units of one kind",
                    earlier.symbol(),
                    unit.symbol()
                );
                return Err((
                    message,
                    "one unit of lengths and one of angles: m,rad".into(),
                ));
            }
        }
        Ok(units)
    }

    /// The unit of a quantity.
    #[must_use]
    pub fn of(&self, quantity: Quantity) -> Option<Unit> {
        match quantity {
            Quantity::Length => self.length,
            Quantity::Angle => self.angle,
            Quantity::Other => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read_alone_and_in_names() {
        let units = Units::parse("m, rad".split(',')).expect("two units");
        assert_eq!(units.of(Quantity::Length), Some(Unit::Metre));
        assert_eq!(units.of(Quantity::Angle), Some(Unit::Radian));
        assert!((Unit::Radian.factor() - 57.295_779_513_082_32).abs() < 1e-12);
        assert!(Units::parse(["m", "mm"]).is_err());
        assert!(
            Units::parse(["grad"])
                .expect_err("no unit")
                .1
                .contains("`rad`")
        );
        assert_eq!(in_name("X  [mm]"), Some(("X", Some(Unit::Millimetre))));
        assert_eq!(in_name("J1 (rad)"), Some(("J1", Some(Unit::Radian))));
        assert_eq!(in_name("Humidity [%]"), Some(("Humidity", None)));
        assert_eq!(in_name("x_m"), Some(("x", Some(Unit::Metre))));
        assert_eq!(in_name("Name"), None);
    }
}
