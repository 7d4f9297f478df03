//! What the registry knows of an effect besides its equation.

use super::search::{List, Search, Sets, Shown};
use crate::geometry::units;
use serde_json::{Value, json};

/// What decimal fractions cost.
const ROUNDED: f64 = 1e-6;

/// An effect in words and numbers.
#[derive(Debug)]
pub struct Definition {
    /// Name in profiles.
    pub id: &'static str,
    /// What it does, one sentence.
    pub summary: &'static str,
    /// The equation, symbols as in the files' keys.
    pub equation: &'static str,
    /// Where the equation comes from.
    pub source: &'static str,
    /// What it belongs to.
    pub site: &'static [SiteKey],
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// What must be known for it to show.
    pub needs: &'static [Need],
    /// It depends on the posture.
    pub deflects: bool,
    /// It moves links, the base or the tool with the posture, not only joints.
    pub bends: bool,
    /// It is an effect of the data, not of the robot: it repairs the analysis of measurements and
    /// never enters a profile.
    pub of_data: bool,
    /// What the residual without it is drawn against.
    pub shown_against: Shown,
    /// How a diagnosis seeks it.
    pub search: Search,
}

impl Definition {
    /// Whether it is a step from a row of the measurements on.
    #[must_use]
    pub fn begins_at_a_row(&self) -> bool {
        self.site.contains(&SiteKey::Row)
    }

    /// Whether it belongs to one of the points that are measured.
    #[must_use]
    pub fn of_point(&self) -> bool {
        self.site.contains(&SiteKey::Point)
    }

    /// Whether it belongs to an external axis.
    #[must_use]
    pub fn of_external_axis(&self) -> bool {
        self.site.contains(&SiteKey::Axis)
    }

    /// Whether it belongs to an axis of a positioner.
    #[must_use]
    pub fn of_positioner(&self) -> bool {
        self.of_external_axis() && self.id.starts_with("positioner_")
    }

    /// Whether it belongs to a joint, or to each of them.
    #[must_use]
    pub fn of_joint(&self) -> bool {
        self.site.contains(&SiteKey::Joint)
    }

    /// Whether it is a function of its joint's angle alone.
    #[must_use]
    pub fn of_joint_angle(&self) -> bool {
        self.of_joint() && self.shown_against == Shown::Angle
    }

    /// Whether it repeats with its joint's angle.
    #[must_use]
    pub fn is_wave(&self) -> bool {
        self.of_joint() && self.has_periods()
    }

    /// Whether it has a number of periods in one revolution.
    #[must_use]
    pub fn has_periods(&self) -> bool {
        self.site.contains(&SiteKey::Order)
    }

    /// Whether it is a power of the place of its axis, which grows beyond what was measured.
    #[must_use]
    pub fn is_power(&self) -> bool {
        self.site
            .iter()
            .any(|key| matches!(key, SiteKey::Degree(..)))
    }

    /// Whether it depends on the side its external axis comes from.
    #[must_use]
    pub fn needs_external_directions(&self) -> bool {
        self.needs.contains(&Need::ExternalDirections)
    }

    /// The parameter whose value is chosen from a list, and the list.
    #[must_use]
    pub fn listed(&self) -> Option<(usize, List)> {
        match self.search.sets {
            Sets::At(number, list) => Some((number, list)),
            _ => None,
        }
    }

    /// Whether torques or moments enter.
    #[must_use]
    pub fn needs_masses(&self) -> bool {
        self.needs.contains(&Need::Masses) || self.needs.contains(&Need::Load)
    }
}

/// A key that says what an effect belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiteKey {
    /// `link: 1…6`
    Link,
    /// `joint: 1…6`
    Joint,
    /// `on: 1…6`, another joint
    On,
    /// `joint: 1…6`, optional: without it the base
    JointOrBase,
    /// `order: 1…`, periods in one revolution: whole, or in thousandths where the gear's ratio is
    /// not
    Order,
    /// `row: 1…`, the row of the measurements from which on it holds
    Row,
    /// `tool: NAME`, optional: without it every tool
    Tool,
    /// `point: 1…`, one of the points that the measurements name, in the order of their names
    Point,
    /// `axis: 1…`, which of the profile's external axes in the order of the file
    Axis,
    /// `along: x`, one of these letters
    Along(&'static str),
    /// `about: x`, one of these letters
    About(&'static str),
    /// `degree: 2…6`, of a power, from and to
    Degree(u32, u32),
    /// `period_mm: 12.5`
    Period,
}

/// An order is counted in thousandths.
const MILLI: u32 = 1000;
/// Longest period along a rail, mm.
pub(super) const MOST_PERIOD_MM: u32 = 100_000;
/// External axes of one profile.
pub const MOST_EXTERNAL_AXES: u32 = 12;
/// Directions by letter.
pub(super) const LETTERS: &str = "xyz";

impl SiteKey {
    /// How many of its numbers are one in files.
    #[must_use]
    pub const fn one(self) -> u32 {
        match self {
            Self::Order | Self::Period => MILLI,
            _ => 1,
        }
    }

    /// Its number as files have it: `13.5`.
    #[must_use]
    pub fn in_files(self, number: u32) -> Value {
        let one = self.one();
        if number.is_multiple_of(one) {
            json!(number / one)
        } else {
            json!(f64::from(number) / f64::from(one))
        }
    }

    /// Its number from that of a file; `None` where there is no such number.
    #[must_use]
    pub fn from_files(self, text: &str) -> Option<u32> {
        let (low, high) = self.range()?;
        let number = match self.one() {
            1 => text.parse().ok()?,
            one => {
                let thousandths = text.parse::<f64>().ok()? * f64::from(one);
                let whole = thousandths.round();
                if (thousandths - whole).abs() > ROUNDED
                    || !(0.0..=f64::from(high)).contains(&whole)
                {
                    return None;
                }
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "whole and within the range"
                )]
                let number = whole as u32;
                number
            }
        };
        (low..=high).contains(&number).then_some(number)
    }

    /// Its key in profiles.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Link => "link",
            Self::Joint | Self::JointOrBase => "joint",
            Self::On => "on",
            Self::Order => "order",
            Self::Row => "row",
            Self::Tool => "tool",
            Self::Point => "point",
            Self::Axis => "axis",
            Self::Along(_) => "along",
            Self::About(_) => "about",
            Self::Degree(..) => "degree",
            Self::Period => "period_mm",
        }
    }

    /// Whether an entry may leave it out.
    #[must_use]
    pub const fn optional(self) -> bool {
        matches!(self, Self::Tool | Self::JointOrBase)
    }

    /// The letters that it may be; `None` where it is no direction.
    #[must_use]
    pub const fn letters(self) -> Option<&'static str> {
        match self {
            Self::Along(letters) | Self::About(letters) => Some(letters),
            _ => None,
        }
    }

    /// Smallest and largest number; `None` where it is a name or a letter.
    #[must_use]
    pub const fn range(self) -> Option<(u32, u32)> {
        match self {
            Self::Link | Self::Joint | Self::JointOrBase | Self::On => Some((1, 6)),
            Self::Order => Some((MILLI / 2, 1000 * MILLI)),
            Self::Row | Self::Point => Some((1, 1_000_000_000)),
            Self::Axis => Some((1, MOST_EXTERNAL_AXES)),
            Self::Degree(low, high) => Some((low, high)),
            Self::Period => Some((1, MOST_PERIOD_MM * MILLI)),
            Self::Tool | Self::Along(_) | Self::About(_) => None,
        }
    }

    /// Smallest and largest number that a word of the command line may have: letters are counted
    /// from x, 1.
    #[must_use]
    pub fn numbers(self) -> Option<(u32, u32)> {
        let of = |letter: Option<char>| {
            let at = LETTERS.find(letter?)?;
            u32::try_from(at + 1).ok()
        };
        self.range().or_else(|| {
            let letters = self.letters()?;
            Some((of(letters.chars().next())?, of(letters.chars().last())?))
        })
    }

    /// Its number from a word of the command line.
    #[must_use]
    pub fn from_word(self, text: &str) -> Option<u32> {
        let Some(letters) = self.letters() else {
            return self.from_files(text);
        };
        let is_own = text.len() == 1 && letters.contains(text);
        let at = LETTERS.find(text).filter(|_| is_own)?;
        u32::try_from(at + 1).ok()
    }

    /// Its number as a word of the command line.
    #[must_use]
    pub fn in_word(self, number: u32) -> String {
        let at = (number as usize).saturating_sub(1);
        match self.letters().and_then(|_| LETTERS.get(at..=at)) {
            Some(letter) => letter.to_owned(),
            None => self.in_files(number).to_string(),
        }
    }
}

/// One number of an effect.
#[derive(Debug)]
pub struct Parameter {
    /// Its key in profiles, which ends in its unit.
    pub key: &'static str,
    /// Its unit in profiles.
    pub unit: Unit,
    /// How large it typically is on industrial arms, one standard deviation, in the profile's
    /// unit.
    pub prior_sigma: f64,
}

/// The unit of a parameter in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Millimetres.
    Millimetre,
    /// Degrees.
    Degree,
    /// A plain ratio.
    Ratio,
    /// Radians a newton metre.
    RadPerNm,
    /// Kilograms.
    Kilogram,
    /// Newton metres.
    NewtonMetre,
    /// One a kelvin.
    PerKelvin,
    /// Degrees Celsius.
    Celsius,
    /// Seconds.
    Second,
    /// Parts in a million.
    Ppm,
    /// Rows of measurements.
    Row,
}

impl Unit {
    /// How it is printed.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Degree => "deg",
            Self::Ratio => "1",
            Self::RadPerNm => "rad/(N m)",
            Self::Kilogram => "kg",
            Self::NewtonMetre => "N m",
            Self::PerKelvin => "1/K",
            Self::Celsius => "°C",
            Self::Second => "s",
            Self::Ppm => "ppm",
            Self::Row => "rows",
        }
    }

    /// One of this unit in SI units.
    #[must_use]
    pub const fn in_si(self) -> f64 {
        match self {
            Self::Millimetre => units::MM,
            Self::Degree => units::DEG,
            Self::Ratio
            | Self::RadPerNm
            | Self::Kilogram
            | Self::NewtonMetre
            | Self::PerKelvin
            | Self::Celsius
            | Self::Second
            | Self::Row => 1.0,
            Self::Ppm => 1e-6,
        }
    }
}

/// What must be known for an effect to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// Masses of bodies or tool in the profile.
    Masses,
    /// Columns `dir1…dir6` in measurements; the direction of motion.
    Directions,
    /// Columns `dir_e1…`; the direction in which external axes moved.
    ExternalDirections,
    /// Column `temperature_c`.
    Temperature,
    /// Column `time_s`.
    Time,
    /// Rows in the order in which they were measured.
    Order,
    /// The posture before each row.
    Moves,
    /// The mass of the tool.
    Load,
    /// Places or distances, not contacts.
    Places,
    /// Column `point`, which names two points of the tool or more.
    Points,
    /// Rows in order and no column `time_s`, which says more; unless it begins late.
    NoTime,
    /// Rows in order and no column `temperature_c`, which says more.
    NoTemperature,
}

impl Need {
    /// What is missing, in words of the files.
    #[must_use]
    pub const fn describe(self) -> &'static str {
        match self {
            Self::Masses => "masses (bodies or tool mass_kg in the profile)",
            Self::Directions => "columns dir1…dir6",
            Self::ExternalDirections => "columns dir_e1…",
            Self::Temperature => "column temperature_c",
            Self::Time => "column time_s",
            Self::Order => "rows in the order in which they were measured",
            Self::Moves => {
                "columns move1_deg…move6_deg, or rows in the order in which they were measured"
            }
            Self::Load => "the tool's mass_kg in the profile",
            Self::Places => "places or distances, not contacts",
            Self::Points => "a column point that names two points or more",
            Self::NoTime => "rows in order and no column time_s",
            Self::NoTemperature => "rows in order and no column temperature_c",
        }
    }
}

/// The six parameters of a frame, in the order of [`crate::geometry::Pose::from_xyz_rxryrz`].
pub(super) const fn frame_parameters(length_sigma_mm: f64, angle_sigma_deg: f64) -> [Parameter; 6] {
    const fn parameter(key: &'static str, unit: Unit, prior_sigma: f64) -> Parameter {
        Parameter {
            key,
            unit,
            prior_sigma,
        }
    }
    [
        parameter("x_mm", Unit::Millimetre, length_sigma_mm),
        parameter("y_mm", Unit::Millimetre, length_sigma_mm),
        parameter("z_mm", Unit::Millimetre, length_sigma_mm),
        parameter("rx_deg", Unit::Degree, angle_sigma_deg),
        parameter("ry_deg", Unit::Degree, angle_sigma_deg),
        parameter("rz_deg", Unit::Degree, angle_sigma_deg),
    ]
}
