//! What the registry knows of an effect beside its equation.

use crate::geometry::units;

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
    pub site: &'static [Place],
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// What must be known for it to show.
    pub needs: &'static [Need],
    /// It depends on the posture.
    pub deflects: bool,
    /// It moves links, the base or the tool with the posture, not only joints.
    pub bends: bool,
}

impl Definition {
    /// Whether torques or moments enter.
    #[must_use]
    pub fn needs_masses(&self) -> bool {
        self.needs.contains(&Need::Masses)
    }
}

/// A key that says what an effect belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// `link: 1…6`
    Link,
    /// `joint: 1…6`
    Joint,
    /// `on: 1…6`, another joint
    On,
    /// `order: 1…`, periods in one turn
    Order,
    /// `tool: NAME`, optional: without it every tool
    Tool,
}

impl Place {
    /// Its key in profiles.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Link => "link",
            Self::Joint => "joint",
            Self::On => "on",
            Self::Order => "order",
            Self::Tool => "tool",
        }
    }

    /// Smallest and largest number; `None` where it is a name.
    #[must_use]
    pub const fn range(self) -> Option<(u32, u32)> {
        match self {
            Self::Link | Self::Joint | Self::On => Some((1, 6)),
            Self::Order => Some((1, 1000)),
            Self::Tool => None,
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
    /// How large it typically is on industrial arms, one standard deviation, in the profile's unit.
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
        }
    }

    /// One of this unit in SI units.
    #[must_use]
    pub const fn in_si(self) -> f64 {
        match self {
            Self::Millimetre => units::MM,
            Self::Degree => units::DEG,
            Self::Ratio | Self::RadPerNm => 1.0,
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
}

impl Need {
    /// What is missing, in words of the files.
    #[must_use]
    pub const fn describe(self) -> &'static str {
        match self {
            Self::Masses => "masses (bodies or tool mass_kg in the profile)",
            Self::Directions => "columns dir1…dir6",
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
