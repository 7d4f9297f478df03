//! Profiles that are not those of the robot that a program was made for: its base stands elsewhere,
//! or its rail goes another way.

use super::{CompensateError, Job, approach};
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::Rotation;
use crate::geometry::units::{DEG, mm_from_m};
use crate::profile::Profile;
use std::collections::BTreeSet;

/// Where fewer targets than this are all out of reach, each is reported on its own; and another
/// rail must fit so many more.
const FEW: usize = 3;
/// And so many times fewer targets must not fit it.
const CLEARLY: usize = 2;

/// The findings of the same program with another profile.
type With<'a> = &'a dyn Fn(&Profile) -> Result<Vec<Finding>, CompensateError>;

/// Where findings with one of these ids stand.
fn places<'a>(findings: &'a [Finding], ids: &[&str]) -> BTreeSet<(&'a str, usize, usize)> {
    findings
        .iter()
        .filter(|finding| ids.contains(&finding.id))
        .map(|finding| (finding.file.as_str(), finding.line, finding.column))
        .collect()
}

/// How many targets are out of reach.
fn beyond(findings: &[Finding]) -> usize {
    places(findings, &[crate::motion::OUT_OF_REACH]).len()
}

/// How many are nowhere where their configuration data say.
fn unfit(findings: &[Finding]) -> usize {
    let ids = [
        crate::motion::OUT_OF_REACH,
        "configuration-mismatch",
        "configuration-unknown",
    ];
    places(findings, &ids).len()
}

/// Refuses a profile with whose base not one of several targets is within reach, and says where
/// another rail fits the configuration data of the program better.
///
/// # Errors
/// Nothing is within reach.
pub(super) fn look(
    job: &Job,
    findings: &[Finding],
    with: With,
) -> Result<Option<Finding>, CompensateError> {
    let program = job.ground.program;
    let mut asked: Vec<usize> = program
        .moves
        .iter()
        .filter_map(|motion| motion.target)
        .filter(|target| !approach::stays(job, *target) && !job.ground.is_joints(*target))
        .collect();
    asked.sort_unstable();
    asked.dedup();
    let targets = asked.len();
    if targets < FEW {
        return Ok(None);
    }
    let profile = job.ground.profile;
    let rail = other_rail(profile, targets, unfit(findings), with);
    if beyond(findings) < targets {
        return Ok(rail.map(|rail| rail.finding(job, targets)));
    }
    if let Some(Rail { instead, fit, .. }) = rail {
        return Err(CompensateError::RailElsewhere {
            targets,
            fit,
            instead,
        });
    }
    let base = profile.world_from_base;
    if base != Pose::identity() {
        let at_origin = Profile {
            world_from_base: Pose::identity(),
            ..profile.clone()
        };
        let in_reach = with(&at_origin).map_or(0, |found| targets - beyond(&found).min(targets));
        if in_reach > 0 {
            return Err(CompensateError::BaseElsewhere {
                targets,
                in_reach,
                base_mm: base.translation.map(mm_from_m),
            });
        }
    }
    Err(CompensateError::NothingInReach { targets })
}

/// A rail that fits better than the profile's.
struct Rail {
    /// What of it is otherwise.
    instead: String,
    /// How many targets fit it, and how many the profile's.
    fit: usize,
    own: usize,
}

impl Rail {
    fn finding(&self, job: &Job, targets: usize) -> Finding {
        let Self { instead, fit, own } = self;
        let message = format!(
            "{own} of {targets} targets are reached as their configuration data say; with \
             {instead} {fit} are"
        );
        let hint = "is the direction of the rail, and `kinematics.base`, that of the cell that the \
            program was made for?";
        let severity = Severity::Warning;
        job.ground.sources[0].finding(0, "external-axis-direction", severity, message, hint)
    }
}

/// The rail that fits best where the profile's does not: an axis of the track the other way round,
/// or the base rotated on it by quarters.
fn other_rail(profile: &Profile, targets: usize, unfit_own: usize, with: With) -> Option<Rail> {
    if profile.external.track.is_empty() || unfit_own < FEW {
        return None;
    }
    let mut others: Vec<(String, Profile)> = Vec::new();
    for (k, axis) in profile.external.track.iter().enumerate() {
        let mut other = profile.clone();
        let direction = &mut other.external.track[k].direction;
        *direction = direction.map(|x| -x);
        others.push((format!("{} in the opposite direction", axis.axis), other));
    }
    for turns in 1..4 {
        let degrees = 90.0 * f64::from(turns);
        let mut other = profile.clone();
        let base = &mut other.world_from_base;
        base.rotation = Rotation::about_z(degrees * DEG) * base.rotation;
        others.push((format!("the base rotated by {degrees} deg about z"), other));
    }
    let tried = others.into_iter().filter_map(|(instead, other)| {
        let unfit = unfit(&with(&other).ok()?).min(targets);
        Some((unfit, instead))
    });
    let (least, instead) = tried.min_by_key(|(unfit, _)| *unfit)?;
    let unfit_own = unfit_own.min(targets);
    let is_clear = least + FEW <= unfit_own && CLEARLY * least <= unfit_own;
    is_clear.then(|| Rail {
        instead,
        fit: targets - least,
        own: targets - unfit_own,
    })
}
