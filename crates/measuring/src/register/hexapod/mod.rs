//! The ballbar hexapod: six lengths between three base balls and three tool balls give a pose.
//!
//! Legs B1T1, B2T1, B3T1, B1T2, B2T2, B2T3 (design 1₁₂2₁₂₃3₁), after the balls are renamed by a
//! permutation of the base and one of the tool. The tool points follow one after the other by
//! trilateration:
//!
//! ```text
//! T1 = Tri(B1, B2, B3; ρ11, ρ21, ρ31)     the solution above the base
//! T2 = Tri(B1, B2, T1; ρ12, ρ22, t12)     two solutions
//! T3 = Tri(T2, B2, T1; t23, ρ23, t31)     two solutions each: four assembly modes
//! ```
//!
//! Coordinates: origin B1, x to B2, B3 in the xy plane with y > 0 (the balls' own names); the tool
//! stands at z > 0. The tool's frame has its origin at T1, x to T2, and T3 in the xy plane with
//! y > 0. Lengths are metres.
//!
//! # Source
//! A. Nubiola, thesis, chapter 3; M. Slamani, A. Nubiola, I. Bonev for the device.

mod base;
mod reach;
mod solve;

pub use base::{BaseFrame, set_base_frame};
pub use reach::{Device, Reached, measurable, reach};
pub use solve::{Solved, Spread, legs_at, modes, near, solve, spread};

/// Names of the twelve lengths in the order in which they are counted everywhere.
pub const NAMES: [&str; 12] = [
    "b12", "b23", "b31", "t12", "t23", "t31", "r11", "r21", "r31", "r12", "r22", "r23",
];

/// The twelve lengths of one setting, metres: base and tool by the balls' own names, legs by their
/// names in the design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lengths {
    /// B1B2, B2B3, B3B1.
    pub base_m: [f64; 3],
    /// T1T2, T2T3, T3T1.
    pub tool_m: [f64; 3],
    /// B1T1, B2T1, B3T1, B1T2, B2T2, B2T3 after renaming.
    pub legs_m: [f64; 6],
}

impl Lengths {
    /// In the order of [`NAMES`].
    #[must_use]
    pub fn all(&self) -> [f64; 12] {
        let mut all = [0.0; 12];
        all[..3].copy_from_slice(&self.base_m);
        all[3..6].copy_from_slice(&self.tool_m);
        all[6..].copy_from_slice(&self.legs_m);
        all
    }

    /// From the order of [`NAMES`].
    #[must_use]
    pub fn from_all(all: [f64; 12]) -> Self {
        Self {
            base_m: std::array::from_fn(|i| all[i]),
            tool_m: std::array::from_fn(|i| all[3 + i]),
            legs_m: std::array::from_fn(|i| all[6 + i]),
        }
    }
}

/// Which balls play the parts of B1 B2 B3 and T1 T2 T3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Design {
    /// `base[k]` is the ball (from 0) that plays B(k+1).
    pub base: [usize; 3],
    /// `tool[k]` is the ball (from 0) that plays T(k+1).
    pub tool: [usize; 3],
}

impl Design {
    /// All 36, base permutations outside.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let orders = permutations();
        let with = |base: &[usize; 3]| {
            let base = *base;
            orders.map(|tool| Self { base, tool })
        };
        orders.iter().flat_map(with).collect()
    }

    /// From text such as `231/123`.
    ///
    /// # Errors
    /// Anything that is not two orders of 1, 2 and 3.
    pub fn parse(text: &str) -> Result<Self, HexapodError> {
        let wrong = || HexapodError::Design { found: text.into() };
        let order = |text: &str| -> Option<[usize; 3]> {
            let digits: Option<Vec<usize>> = text.trim().chars().map(|c| "123".find(c)).collect();
            let order: [usize; 3] = digits?.try_into().ok()?;
            permutations().contains(&order).then_some(order)
        };
        let (base, tool) = text.split_once('/').ok_or_else(wrong)?;
        Ok(Self {
            base: order(base).ok_or_else(wrong)?,
            tool: order(tool).ok_or_else(wrong)?,
        })
    }

    /// Text such as `231/123`.
    #[must_use]
    pub fn name(&self) -> String {
        let text = |order: [usize; 3]| order.map(|k| (k + 1).to_string()).concat();
        format!("{}/{}", text(self.base), text(self.tool))
    }

    /// −1 where the base is renamed against its order, which turns everything over; else 1.
    fn hand(&self) -> f64 {
        if permutations()[..3].contains(&self.base) {
            1.0
        } else {
            -1.0
        }
    }
}

/// Rotations first, then the others.
fn permutations() -> [[usize; 3]; 6] {
    [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [2, 1, 0],
        [1, 0, 2],
    ]
}

/// Why lengths give no pose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HexapodError {
    /// Not two orders of 1, 2 and 3.
    #[error(
        "design `{found}` is not of the form 123/123: an order of the base balls and one of the \
         tool balls"
    )]
    Design {
        /// What was given.
        found: String,
    },
    /// A length that is no length.
    #[error("{name} is {found_mm} mm; a length is a finite number above 0")]
    Length {
        /// Which.
        name: &'static str,
        /// What was given, mm.
        found_mm: f64,
    },
    /// Three sides that are no triangle.
    #[error(
        "{which} is no triangle: {longest} = {found_mm:.4} mm is longer than the other two \
         together ({limit_mm:.4} mm)"
    )]
    Triangle {
        /// `the base` or `the tool`.
        which: &'static str,
        /// The longest side.
        longest: &'static str,
        /// Its length, mm.
        found_mm: f64,
        /// The two others, mm.
        limit_mm: f64,
    },
    /// Three spheres that do not meet.
    #[error("no solution for {point}: the spheres of {} do not meet; \
        {}", names(.lengths), culprit(.changes))]
    NoMeeting {
        /// T1, T2 or T3 of the design.
        point: &'static str,
        /// The lengths in it.
        lengths: Vec<&'static str>,
        /// What each length alone would have to change by to give a solution, mm, the smallest
        /// first.
        changes: Vec<(&'static str, f64)>,
    },
    /// No mode of this number.
    #[error("mode {found} is not a whole number from 1 to 4")]
    Mode {
        /// What was given.
        found: f64,
    },
    /// A rough pose that does not tell two modes apart.
    #[error(
        "the rough pose does not tell the modes {first} and {second} apart: {first_mm:.1} mm and \
         {second_mm:.1} mm away"
    )]
    Rough {
        /// The nearest.
        first: usize,
        /// The next.
        second: usize,
        /// Its distance, mm.
        first_mm: f64,
        /// Its distance, mm.
        second_mm: f64,
    },
    /// Taught points that contradict the distances.
    #[error(
        "the taught points contradict the ballbar: {name} is {taught_mm:.3} mm by the robot and \
         {exact_mm:.3} mm by the ballbar (limit {limit_mm} mm)"
    )]
    Taught {
        /// Which distance.
        name: &'static str,
        /// By the robot, mm.
        taught_mm: f64,
        /// By the ballbar, mm.
        exact_mm: f64,
        /// The most that is accepted, mm.
        limit_mm: f64,
    },
}

fn names(lengths: &[&str]) -> String {
    lengths.join(", ")
}

fn culprit(changes: &[(&'static str, f64)]) -> String {
    match changes {
        [] => "no single length can be at fault alone".to_owned(),
        [(name, mm), rest @ ..] => {
            let mut text = format!("{name} is likely wrong: {mm:+.3} mm would do");
            for (name, mm) in rest.iter().take(2) {
                text += &format!(", or {name} {mm:+.3} mm");
            }
            text
        }
    }
}
