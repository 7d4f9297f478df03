//! How high the powers of a rail go: as high as rows that are left out are better predicted.
//!
//! The arm stays as it was found with the usual degrees; one more degree of straightness and of
//! rotation is tried on parts of the rows after another, until the error on the rest falls no more.
//!
//! # Source
//! M. Stone, "Cross-validatory choice and assessment of statistical predictions" (1974).

use super::calibration::{Calibration, Options, identify};
use super::measurements::{Measurements, Purpose};
use super::parameters::{Level, Selection};
use super::pick::Pick;
use crate::profile::Profile;
use rayon::prelude::*;

/// Parts of the rows that are left out in turn.
const FOLDS: usize = 5;
/// A degree more is worth it where the squared error falls to this part: 2 % of the error.
const FALLS: f64 = 0.96;

/// What is sought of a rail beyond the usual degrees; nothing where a person says the degrees.
pub(super) fn of_rail(
    profile: &Profile,
    measurements: &Measurements,
    options: &Options,
    found: &Calibration,
) -> Vec<Pick> {
    if !is_open(profile, &options.selection) {
        return Vec::new();
    }
    let known = Profile {
        device: profile.device,
        ..found.profile()
    };
    let rows = measurements.filtered(|_, row| row.purpose != Some(Purpose::Validate));
    let error = |more: u32| {
        let selection = Selection {
            level: Level::Frames,
            identify: Pick::track_to(more),
            ..options.selection.clone()
        };
        let options = Options {
            selection,
            ..options.clone()
        };
        let parts: Option<Vec<f64>> = (0..FOLDS)
            .into_par_iter()
            .map(|part| left_out(&known, &rows, part, &options))
            .collect();
        parts.map(|parts| parts.iter().sum::<f64>())
    };
    let Some(mut least) = error(0) else {
        return Vec::new();
    };
    let mut more = 0;
    while more < Pick::MOST_MORE_OF_TRACK
        && let Some(next) = error(more + 1).filter(|next| *next < FALLS * least)
    {
        (least, more) = (next, more + 1);
    }
    if more == 0 {
        Vec::new()
    } else {
        Pick::track_to(more)
    }
}

/// Whether a rail is sought without a word about its degrees.
fn is_open(profile: &Profile, selection: &Selection) -> bool {
    let is_power = |pick: &&Pick| pick.kind.is_some_and(|kind| kind.definition().is_power());
    let is_sought = matches!(selection.level, Level::Geometry | Level::Compliance);
    let named: Vec<&Pick> = selection.identify.iter().filter(is_power).collect();
    !profile.external.track.is_empty()
        && (is_sought || !named.is_empty())
        && named.iter().all(|pick| pick.together)
        && !selection.fix.iter().any(|pick| is_power(&pick))
}

/// Sum of squares on a part of the rows when it is left out, mm².
fn left_out(known: &Profile, rows: &Measurements, part: usize, options: &Options) -> Option<f64> {
    let mut marked = rows.clone();
    for (index, row) in marked.rows.iter_mut().enumerate() {
        row.purpose = (index % FOLDS == part).then_some(Purpose::Validate);
    }
    let found = identify(known, &marked, options, &mut || ()).ok()?;
    let (_, with) = found.held_out?;
    let error = with.main()?;
    Some(error.rms.powi(2) * error.n as f64)
}
