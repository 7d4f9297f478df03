//! The measuring side of the cell: where the part, the camera and the base frame stand, with what
//! uncertainty.
//!
//! | module | from | to |
//! |---|---|---|
//! | [`kabsch`](mod@kabsch), [`robust`](mod@robust) | matched points | the motion between them, without bad touches |
//! | [`features`], [`frames`] | probe touches | spheres, planes, holes; 3-2-1 and 3-point frames |
//! | [`uncertainty`] | the noise of points | six standard uncertainties, error ellipsoids |
//!
//! Lengths are metres, angles radians. A motion found here maps coordinates of the first set (FROM:
//! the simulation, the nominal part) into the second (TO: the cell as measured).
//!
//! # Example
//!
//! ```
//! use poseshift_measuring::register::kabsch::kabsch;
//!
//! let simulated = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.3]];
//! let measured = simulated.map(|[x, y, z]| [x + 0.001, y, z - 0.002]);
//! let fit = kabsch(&simulated, &measured, None).expect("four points that are no line");
//! assert!((fit.to_from_from.translation[2] + 0.002).abs() < 1e-12);
//! ```

pub mod axes;
pub mod features;
pub mod frame_file;
pub mod frames;
pub mod handeye;
pub mod hexapod;
#[cfg(feature = "icp")]
pub mod icp;
pub mod kabsch;
mod linear;
pub mod robust;
pub mod uncertainty;

/// Why two sets of points give no frame.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RegisterError {
    /// Sets of different sizes.
    #[error("FROM has {from} points and TO has {to}: each needs its partner")]
    Counts {
        /// Points of FROM.
        from: usize,
        /// Points of TO.
        to: usize,
    },
    /// Fewer than three points.
    #[error("{found} points; a frame needs at least 3 that are not in a line")]
    TooFew {
        /// How many there are.
        found: usize,
    },
    /// A coordinate that is infinite or no number.
    #[error("a coordinate is not a finite number")]
    NotFinite,
    /// A weight that is negative or no number.
    #[error("the weight of point {row} is not a finite number from 0")]
    Weight {
        /// Which point, from 1.
        row: usize,
    },
    /// Points in one place.
    #[error(
        "the points of {set} coincide: they spread over {spread_mm:.6} mm (limit {limit_mm} mm)"
    )]
    Coincident {
        /// Which set.
        set: &'static str,
        /// Root mean square distance from their centre, mm.
        spread_mm: f64,
        /// The smallest that is accepted, mm.
        limit_mm: f64,
    },
    /// Points in a line.
    #[error(
        "collinear: {set} extends across its line by {across:.1e} of its length (limit \
         {limit:.0e}); the turn about the line is not determined"
    )]
    Collinear {
        /// Which set.
        set: &'static str,
        /// Extent across the longest direction, as a part of it.
        across: f64,
        /// The smallest that is accepted.
        limit: f64,
    },
    /// Points that have nothing to do with each other.
    #[error(
        "the sets are unlike each other: no rotation relates them (correlation across the main \
         direction {across:.1e}); are the rows in the same order?"
    )]
    Unlike {
        /// Ratio of singular values of the correlation.
        across: f64,
    },
    /// Different units.
    #[error("TO is {ratio:.5} times as large as FROM: {}", units(*.ratio))]
    Units {
        /// Extent of TO by extent of FROM.
        ratio: f64,
    },
    /// A mirror image.
    #[error(
        "mirrored: TO is a mirror image of FROM (rigid rmsd {rigid_mm:.3} mm, mirrored \
         {mirrored_mm:.3} mm)"
    )]
    Mirrored {
        /// What the best rotation leaves, mm.
        rigid_mm: f64,
        /// What the best reflection leaves, mm.
        mirrored_mm: f64,
    },
    /// A cloud of too few points.
    #[error("a cloud of {found} points; nearness takes at least {needed} on each side")]
    SmallCloud {
        /// Points of the smaller one.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// Too few points to reject one of them.
    #[error("{found} points are too few to tell a bad touch; it takes {needed}")]
    TooFewToJudge {
        /// How many there are.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// No motion that most points agree with.
    #[error("no motion agrees with more than half of the {points} points")]
    NoAgreement {
        /// How many there are.
        points: usize,
    },
}

impl RegisterError {
    /// The way out; empty where the message says it all.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Collinear { .. } => "measure at least one more point well off the line",
            Self::Coincident { .. } => "are the coordinates in metres? files are in mm",
            Self::Mirrored { .. } => {
                "one of the sets has an axis turned round, or two coordinates swapped: check the \
                 measuring device's frame"
            }
            Self::Units { .. } => "files are in mm; convert the other set",
            Self::NoAgreement { .. } => "check that the rows of the files belong together",
            _ => "",
        }
    }
}

/// What a ratio of extents says about units.
fn units(ratio: f64) -> String {
    let known = [
        (1e3, "FROM is in metres, or TO in micrometres"),
        (1e-3, "TO is in metres, or FROM in micrometres"),
        (25.4, "FROM is in inches"),
        (1.0 / 25.4, "TO is in inches"),
        (10.0, "FROM is in centimetres"),
        (0.1, "TO is in centimetres"),
    ];
    let near = |(value, _): &&(f64, &str)| (ratio / value - 1.0).abs() < 0.1;
    known.iter().find(near).map_or_else(
        || "other units, or not the same points".to_owned(),
        |(_, what)| format!("it seems that {what}"),
    )
}

/// Repeatable pseudo-random numbers for searches: the same on every machine and in every version.
///
/// # Source
/// S. Vigna, "`SplitMix64`".
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draw(u64);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below `limit`.
    #[allow(clippy::cast_possible_truncation)]
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (self.bits() % limit as u64) as usize
    }
}
