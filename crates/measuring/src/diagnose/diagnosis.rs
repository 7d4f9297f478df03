//! The answer, and how the profile's own calibration is trusted on the way to it.

use crate::diagnose::estimator::refit::Changed;
use crate::diagnose::judgement::accepted::NotTaken;
use crate::diagnose::judgement::attempt::{Attempt, attempt};
use crate::diagnose::judgement::conclusion::conclude;
use crate::diagnose::judgement::poses::Telling;
use crate::diagnose::judgement::whereabouts::Spot;
use crate::diagnose::judgement::{Against, Standing};
use crate::diagnose::outside::Unknown;
use crate::diagnose::proof::Compared;
use crate::diagnose::question::{Trust, for_choice, is_nominal};
use crate::diagnose::search::candidates::CannotTest;
use crate::diagnose::search::stand_ins::{Impossible, StandIn};
use crate::identify::input_checks::Remark;
use crate::identify::measurements::Measurements;
use crate::identify::off::Off;
use crate::identify::pick::Pick;
use crate::identify::problem::{Estimate, Problem};
use crate::identify::statistics::Spread;
use crate::identify::{IdentifyError, Line};
use crate::model::effects::{Effect, Seen};
use crate::profile::Profile;

/// A calibration of unknown worth is taken to be worth as much as these measurements.
const DEFAULT_G: f64 = 1.0;

/// What a person may ask for.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Effects that are in the model whatever the evidence.
    pub accept: Vec<Pick>,
    /// Effects that are not considered.
    pub reject: Vec<Pick>,
    /// The profile was calibrated with other measurements than these.
    pub is_new: bool,
    /// Leave out cross-validation.
    pub quick: bool,
    /// Fit the model again without each effect found, for a report that shows what it changed.
    pub steps: bool,
}

/// A row that decides parameters alone: its residual is small whatever it says, and no evidence for
/// the model.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowedRow {
    /// Where it stands.
    pub line: Line,
    /// Its id.
    pub id: String,
    /// How much of its own numbers the model follows, from 0 to 1.
    pub leverage: f64,
}

/// The answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The effects found explain the disagreement down to the noise.
    Explained,
    /// Rows left out are predicted better with the effects found than without, beyond chance;
    /// something else is missing too, or one of them is another.
    Improved,
    /// The model agrees with the measurements within the noise.
    NothingMissing,
    /// Something is missing and it cannot be known what.
    Undetermined,
}

impl Diagnosis {
    /// Words of `--accept` that make this model again, without a search.
    #[must_use]
    pub fn accept(&self) -> String {
        let words = self.found.iter().map(|f| Pick::word(&f.effect));
        words.collect::<Vec<_>>().join(",")
    }
}

impl Verdict {
    /// Its name in reports.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::Improved => "improved",
            Self::NothingMissing => "nothing_missing",
            Self::Undetermined => "undetermined",
        }
    }
}

/// An effect that explains the data nearly as well as one that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Alternative {
    /// The effect, with its values.
    pub effect: Effect,
    /// Index of the effect found that it would stand for.
    pub instead_of: usize,
    /// Fall of chi-squared.
    pub gain: f64,
    /// By how much the effect found is better, in twice a log likelihood, its choice counted.
    pub behind: f64,
}

/// An effect that was found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The effect with its values.
    pub effect: Effect,
    /// It as the profile has it, where its values are new ones in the place of those.
    pub was: Option<Effect>,
    /// Indices of the parameters that were sought.
    pub sought: Vec<usize>,
    /// Standard deviations of those, SI.
    pub sigmas: Vec<f64>,
    /// The parameter that was chosen from a list, and its standard deviation, SI.
    pub listed: Option<(usize, f64)>,
    /// Fall of chi-squared when it is added to the others.
    pub gain: f64,
    /// Probability of that by chance, times the number of tests made.
    pub p_value: f64,
    /// Fall of the information criterion.
    pub bic: f64,
    /// A person asked for it.
    pub accepted: bool,
    /// Errors on rows not used for its choice, with the effects before it and with it too, mm.
    pub before: Option<Spread>,
    /// With it.
    pub after: Option<Spread>,
    /// In how many of the parts of the measurements it was found again without them.
    pub found_again: (usize, usize),
    /// Where it was seen.
    pub seen: Seen,
    /// The improved profile has it, or (of the session) stands where it left the robot.
    pub in_profile: bool,
    /// How sure it is.
    pub standing: Standing,
    /// What it may be instead, the likeliest first.
    pub against: Vec<Against>,
}

/// Where the noise's size comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseSource {
    /// The column `sigma_mm`.
    Given,
    /// Poses measured more than once.
    Repeats,
    /// What every model leaves.
    Residuals,
}

/// A row that no model explains.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlierRow {
    /// Where it stands.
    pub line: Line,
    /// Its id.
    pub id: String,
    /// How far it is off.
    pub off: Off,
    /// In standard deviations of the noise.
    pub times: f64,
}

/// Everything found.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The answer.
    pub verdict: Verdict,
    /// Why, one sentence each.
    pub reasons: Vec<String>,
    /// Effects, those first without which most is lost.
    pub found: Vec<Found>,
    /// Configurations that would tell the strongest alternative from the effect found.
    pub telling: Vec<Telling>,
    /// Effects that explain the data nearly as well.
    pub alternatives: Vec<Alternative>,
    /// Effects of one kind that compete with several of those found.
    pub stand_ins: Vec<StandIn>,
    /// Effects that would compete if their values were possible.
    pub impossible: Vec<Impossible>,
    /// Models fitted again without each of the effects found, where they were asked for.
    pub without: Vec<Estimate>,
    /// And without any of them.
    pub bare: Option<Estimate>,
    /// Rows that the model follows whatever they say.
    pub followed: Vec<FollowedRow>,
    /// Functions outside the registry that explain more.
    pub unknown: Vec<Unknown>,
    /// Where the disagreement lies.
    pub spots: Vec<Spot>,
    /// Effects that cannot be tested.
    pub cannot_test: Vec<CannotTest>,
    /// Whether frames, geometry (and compliance) were fitted anew.
    pub absorbed: bool,
    /// Effects of the profile, frames and geometry left out, that were fitted anew and are not what
    /// they were: the clearest first.
    pub changed: Vec<Changed>,
    /// Whether the base was fitted: the device is elsewhere than the profile says.
    pub elsewhere: bool,
    /// Errors on rows not used: the present model, then with everything.
    pub held_out: Option<(Spread, Spread)>,
    /// Rows that neither model was fitted to: the comparison that judges the effects found.
    pub judged: Option<Compared>,
    /// With frames, geometry and what the profile has fitted anew, without effects found.
    pub absorbed_only: Option<Spread>,
    /// Noise of a coordinate, metres, and where it comes from.
    pub noise_m: f64,
    /// Where from.
    pub noise_source: NoiseSource,
    /// The residual of a coordinate, metres.
    pub residual_m: f64,
    /// Where the residual lies.
    pub residual_spots: Vec<Spot>,
    /// Effects that a person wants and that are not in the model.
    pub not_taken: Vec<NotTaken>,
    /// Rows that do not fit.
    pub outliers: Vec<OutlierRow>,
    /// What a person should look at.
    pub remarks: Vec<Remark>,
    /// Present residuals and those that remain, metres, a length for each row.
    pub lengths: (Vec<f64>, Vec<f64>),
    /// How far each row is off with what was found.
    pub offs: Vec<Off>,
    /// The improved robot: effects of the data left out.
    pub profile: Profile,
    /// The comparison and the values, to go on from.
    pub problem: Problem,
    /// The values.
    pub estimate: Estimate,
}

/// How many rows a profile's calibration was made with, from its provenance.
fn calibrated_rows(profile: &Profile) -> Option<f64> {
    profile
        .provenance
        .as_ref()?
        .get("rows")?
        .as_f64()
        .filter(|n| *n > 0.0)
}

/// Diagnoses measurements against a profile. `progress` is called with what is being done.
///
/// # Errors
/// Measurements that contradict the robot or themselves, or are too few for the parameters that
/// have to be fitted.
pub fn diagnose(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<Diagnosis, IdentifyError> {
    let measurements = &*measurements.in_world_of(profile)?;
    let used = for_choice(measurements);
    let (best, remarks) = if is_nominal(profile) {
        attempt(profile, measurements, Trust::Nothing, options, progress)?
    } else {
        let rows = used.iter().filter(|u| **u).count() as f64;
        let g = calibrated_rows(profile).map_or(DEFAULT_G, |n| (rows / n).clamp(0.1, 10.0));
        let trusted = attempt(
            profile,
            measurements,
            Trust::Calibrated { g },
            options,
            progress,
        )?;
        if trusted.0.clean() {
            trusted
        } else {
            // the calibration itself may be out of date
            match attempt(profile, measurements, Trust::Nothing, options, progress) {
                Ok(anew) => {
                    let evidence = anew.0.refit.evidence().min(trusted.0.refit.evidence());
                    let better = |a: &Attempt| a.merit_at(evidence.powi(2));
                    if better(&anew.0) + 10.0 < better(&trusted.0) {
                        anew
                    } else {
                        trusted
                    }
                }
                // the rows are fit for a diagnosis, but not for a calibration of everything
                Err(_) => trusted,
            }
        }
    };
    conclude(profile, measurements, options, &best, remarks, progress)
}
