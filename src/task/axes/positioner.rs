//! The axes of positioners from circles of a reflector on the plate.

use super::Circle;
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose as Motion, norm};
use crate::identify::external::{column_of, from_files};
use crate::model::external::Listed;
use crate::model::profile::Profile;
use crate::register::axes::positioner::{Found, PositionerError, Row as Seen, Sweep, find};
use crate::register::frame_file::Sigma as Six;
use crate::register::uncertainty::PoseCovariance;
use crate::task::failure::Failure;
use crate::task::parts::{Pose, Sigma};
use crate::task::table::{Row, Table};
use schemars::JsonSchema;
use serde::Serialize;

/// What a sweep says of an axis of a positioner.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PositionerAxis {
    /// Its name in programs.
    pub axis: String,
    /// The positioner.
    pub positioner: String,
    /// Its number among the external axes of the profile, from 1.
    pub external_axis: usize,
    /// Its direction in the world: growing angles turn about it by the right hand.
    pub direction: [f64; 3],
    /// The circle of the point.
    #[serde(flatten)]
    pub circle: Circle,
    /// Where it is, as `at` in the profile: z is the axis; the first in the world, another in the
    /// frame of the axis before. What a circle does not show, along and about the axis, is the
    /// profile's.
    pub at: Pose,
    /// Its standard uncertainties: of the origin along the axes in which `at` is given, of rotations
    /// about its own x, y and z; `null` where the noise is not known.
    pub at_sigma: Option<Sigma>,
    /// How far it is from where the profile has it.
    pub moved_mm: f64,
    /// By what angle it is rotated from there.
    pub rotated_deg: f64,
}

/// The axis that a cell of the column `sweep` names, `e2`, by its index; none where it is a joint.
pub(super) fn swept(profile: &Profile, row: &Row) -> Result<Option<usize>, Failure> {
    let text = row.text("sweep").unwrap_or_default();
    let Some(number) = text.strip_prefix(['e', 'E']) else {
        return Ok(None);
    };
    let listed: Vec<Listed> = profile.external.listed().collect();
    let axis = number.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
    if let Some(axis) = axis
        && let Some(Listed::Rotary(..)) = listed.get(axis)
    {
        return Ok(Some(axis));
    }
    let rotary = listed.iter().enumerate();
    let rotary = rotary.filter(|(_, axis)| !axis.is_linear());
    let names: Vec<String> = rotary
        .map(|(k, axis)| format!("e{} ({})", k + 1, axis.name()))
        .collect();
    let known = if names.is_empty() {
        "none: `poseshift profile add-positioner` describes them".to_owned()
    } else {
        names.join(", ")
    };
    Err(row.failure(format!(
        "sweep {text} is no axis of a positioner; the profile has {known}"
    )))
}

/// Where the axes of positioners stood in a row.
pub(super) fn values(profile: &Profile, table: &Table, row: &Row) -> Result<Vec<f64>, Failure> {
    let listed = profile.external.listed().enumerate();
    let each = listed.map(|(k, axis)| {
        let column = column_of(&axis, k);
        let there = table.has(column) && row.text(column).is_some_and(|text| !text.is_empty());
        if there {
            Ok(from_files(&axis, row.number(column)?))
        } else {
            Ok(f64::NAN)
        }
    });
    each.collect()
}

/// Adds a row to the sweep of its axis.
pub(super) fn put(sweeps: &mut Vec<Sweep>, axis: usize, row: Seen) {
    match sweeps.iter_mut().find(|sweep| sweep.axis == axis) {
        Some(sweep) => sweep.rows.push(row),
        None => sweeps.push(Sweep {
            axis,
            rows: vec![row],
        }),
    }
}

/// The swept axes of a profile's positioners.
pub(super) fn positioner_axes(
    profile: &Profile,
    sweeps: &[Sweep],
) -> Result<Vec<PositionerAxis>, PositionerError> {
    let found = find(&profile.external, sweeps)?;
    let each = found.iter().map(|found| {
        let sweep = sweeps.iter().find(|sweep| sweep.axis == found.axis);
        one(profile, found, sweep.expect("its own sweep"))
    });
    Ok(each.collect())
}

fn one(profile: &Profile, found: &Found, sweep: &Sweep) -> PositionerAxis {
    let listed = profile.external.listed().nth(found.axis);
    let Some(Listed::Rotary(axis, of, _)) = listed else {
        unreachable!("an axis of a positioner was swept")
    };
    let gap = axis.at.inverse() * found.at;
    let angles = sweep.rows.iter().map(|row| row.values[found.axis]);
    PositionerAxis {
        axis: axis.axis.clone(),
        positioner: profile.external.positioners[of].name.clone(),
        external_axis: found.axis + 1,
        direction: found.circle.line.direction,
        circle: Circle::of(&found.circle, angles),
        at: (&found.at).into(),
        at_sigma: found.covariance.as_ref().map(|of| sigma(of, &found.at)),
        moved_mm: mm_from_m(norm(gap.translation)),
        rotated_deg: gap.rotation.angle() / DEG,
    }
}

/// Of the origin as it is given, and of rotations about the axis's own axes.
fn sigma(covariance: &PoseCovariance, at: &Motion) -> Sigma {
    let position_m = covariance.sigma_at_m(covariance.centre_m);
    let rotation_rad = [0, 1, 2].map(|k| covariance.rotation_sigma_about_rad(at.rotation.axis(k)));
    (&Six {
        position_m,
        rotation_rad,
    })
        .into()
}
