//! The parts of a diagnosis: spots, alternatives, functions, rows that stand out.

use super::Effect;
use crate::diagnose as engine;
use crate::geometry::units::mm_from_m;
use crate::task::parts::{File, SpreadMm, finite};
use schemars::JsonSchema;
use serde::Serialize;

/// The residual that remains.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Unexplained {
    /// Root mean square of a coordinate.
    pub rms_mm: Option<f64>,
    /// What it depends on, strongest first.
    #[serde(rename = "where")]
    pub spots: Vec<Spot>,
    /// The function outside the registry that explains most of it.
    pub function: Option<String>,
}

/// Where the disagreement lies.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Spot {
    /// By which column.
    pub column: String,
    /// At which values most.
    pub values: String,
    /// Root mean square.
    pub size_mm: f64,
    /// Largest.
    pub largest_mm: f64,
    /// Its part of the whole, 0 to 1.
    pub part: Option<f64>,
    /// Probability by chance.
    pub p_value: Option<f64>,
}

/// An effect that explains the data nearly as well as one found.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Alternative {
    /// The effect.
    #[serde(flatten)]
    pub effect: Effect,
    /// The effect found that it would stand for.
    pub instead_of: String,
    /// Fall of chi squared.
    pub chi_squared_fall: Option<f64>,
    /// By how much the effect found is better, in twice a log likelihood.
    pub behind: Option<f64>,
}

/// Effects that would compete with some of those found, with values that cannot be.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ImpossibleGroup {
    /// The effects.
    pub effects: Vec<Effect>,
    /// The effects found that they would stand for.
    pub instead_of: Vec<String>,
    /// Fall of chi squared, as a part of that of the group.
    pub part: Option<f64>,
}

/// Effects that together explain the data nearly as well as some of those found.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Group {
    /// The effects.
    pub effects: Vec<Effect>,
    /// The effects found that they would stand for.
    pub instead_of: Vec<String>,
    /// Fall of chi squared.
    pub chi_squared_fall: Option<f64>,
    /// As a part of that of the group.
    pub part: Option<f64>,
    /// By how much the group is better, in twice a log likelihood.
    pub behind: Option<f64>,
    /// The residual of a coordinate with them.
    pub left_mm: Option<f64>,
}

/// A function outside the registry that explains more.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Unregistered {
    /// Its name.
    pub function: String,
    /// Fall of chi squared.
    pub chi_squared_fall: Option<f64>,
}

/// A configuration that would separate alternatives.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct TellingPose {
    /// The controller's joint angles.
    pub joints_deg: [f64; 6],
    /// How far apart the alternatives are there.
    pub apart_mm: f64,
    /// The alternatives.
    pub tells: [String; 2],
}

/// An effect that cannot be tested.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Untested {
    /// The effect.
    pub effect: &'static str,
    /// The column that is missing.
    pub missing: String,
}

/// Errors on rows that were not used for the choice.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct HeldOut {
    /// The present model.
    pub before: Option<SpreadMm>,
    /// With what was fitted along with it.
    pub absorbed: Option<SpreadMm>,
    /// With everything found.
    pub after: Option<SpreadMm>,
    /// The comparison that judges the effects found: rows that neither model was fitted to.
    pub compared: Option<Compared>,
}

/// Two models on rows that neither was fitted to.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Compared {
    /// Without the effects found.
    pub before: SpreadMm,
    /// With them.
    pub after: SpreadMm,
    /// All that the profile has was fitted again without these rows, for both; else the profile is
    /// taken as it is.
    pub refitted: bool,
    /// Probability that the effects found are better by so much by chance.
    pub p_value: Option<f64>,
}

/// A row that fits no model.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct OutlierRow {
    /// Line, from 1.
    pub line: usize,
    /// Its id.
    pub id: String,
    /// Its residual, of the place.
    pub residual_mm: f64,
    /// Of the orientation, of a pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_deg: Option<f64>,
    /// The part that is wrong in words.
    #[serde(skip)]
    pub off: String,
    /// In multiples of the noise.
    pub times_noise: Option<f64>,
    /// Its file.
    #[serde(flatten)]
    pub file: File,
}

/// A row that decides parameters alone.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct LeverageRow {
    /// Line, from 1.
    pub line: usize,
    /// Its id.
    pub id: String,
    /// 1 is alone.
    pub leverage: Option<f64>,
    /// Its file.
    #[serde(flatten)]
    pub file: File,
}

impl From<&engine::judgement::whereabouts::Spot> for Spot {
    fn from(s: &engine::judgement::whereabouts::Spot) -> Self {
        Self {
            column: s.column.clone(),
            values: s.values.clone(),
            size_mm: mm_from_m(s.size_m),
            largest_mm: mm_from_m(s.largest_m),
            part: finite(s.part),
            p_value: finite(s.p_value),
        }
    }
}
