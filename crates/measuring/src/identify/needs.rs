//! What effects need: loads that change, columns, axes that the profile has.

use super::error::IdentifyError;
use super::measurements::{DIRECTION_COLUMNS, Measurements, Observed};
use super::parameters::{Selection, Subject};
use super::pick::Pick;
use super::problem::{Problem, Row};
use crate::model::Conditions;
use crate::model::effects::{Effect, Kind, List, Need, SiteKey};
use crate::profile::{Mounted, Profile, is_of_profile};

/// A joint's torque must change by this part of the largest change to tell its compliance.
const TORQUE_PART: f64 = 1e-3;
/// And that of joint 1, which carries none where the arm stands upright: 1 % is half a degree of
/// tilt.
const UPRIGHT_PART: f64 = 0.02;

/// Joints whose gravity torque changes enough over the rows to tell their compliance.
pub(super) fn loaded(
    profile: &Profile,
    tools: &[Mounted],
    rows: &[Row],
    gravity_known: bool,
) -> [bool; 6] {
    if !gravity_known {
        return [false; 6];
    }
    let models: Vec<_> = tools
        .iter()
        .map(|tool| profile.real_model(tool, &Conditions::default()))
        .collect();
    let (mut sum, mut squares) = ([0.0; 6], [0.0; 6]);
    for row in rows {
        let torques = models[row.tool].torques(&row.q, &row.conditions);
        for i in 0..6 {
            sum[i] += torques[i];
            squares[i] += torques[i] * torques[i];
        }
    }
    let count = rows.len() as f64;
    let spread: [f64; 6] = std::array::from_fn(|i| {
        (squares[i] / count - (sum[i] / count).powi(2))
            .max(0.0)
            .sqrt()
    });
    let largest = spread.iter().copied().fold(0.0, f64::max);
    std::array::from_fn(|i| {
        let part = if i == 0 { UPRIGHT_PART } else { TORQUE_PART };
        spread[i] > part * largest
    })
}

/// Effects that are asked for by name must be of axes that the profile has, and that the measured
/// tool shows; points on a plate show nothing of the arm.
pub(super) fn refuse_others_axes(
    profile: &Profile,
    measurements: &Measurements,
    asked: &[Pick],
) -> Result<(), IdentifyError> {
    if let Some(row) = measurements.rows.iter().find(|row| row.plate.is_some()) {
        return Err(IdentifyError::Suspicious {
            message: format!("{}: a point on a plate shows nothing of the arm", row.line),
            hint: "keep rows on plates apart from rows of the tool".into(),
        });
    }
    for pick in asked {
        let Some(kind) = pick
            .kind
            .filter(|kind| kind.definition().of_external_axis())
        else {
            continue;
        };
        let id = kind.definition().id;
        if id.starts_with("positioner_") {
            let need =
                "points on the plate: a tool that a device sees shows nothing of a positioner";
            return Err(IdentifyError::Missing { id, need });
        }
        let effects = pick.effects();
        if !pick.together && !effects.iter().any(|e| is_of_profile(e, &profile.external)) {
            let need = "a linear axis of that number under `external_axes: track:` of the profile";
            return Err(IdentifyError::Missing { id, need });
        }
    }
    Ok(())
}

/// Temperatures must range over this to show an effect, °C.
pub(crate) const WARMER_C: f64 = 0.5;

/// How far temperatures range where that is too little to show an effect, °C.
pub(crate) fn too_even_c(rows: &[Row]) -> Option<f64> {
    let all = rows.iter().filter_map(|row| row.conditions.temperature_c);
    let ends = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| {
        [low.min(t), high.max(t)]
    });
    let by = (ends[1] - ends[0]).max(0.0);
    (by < WARMER_C).then_some(by)
}

/// Whether the rows are of two named points of the tool or more.
pub(crate) fn has_points(rows: &[Row]) -> bool {
    let points = || rows.iter().filter_map(|row| row.conditions.point);
    points().any(|point| Some(point) != points().next())
}

/// Refuses effects that begin at a row where none is named, or one that these rows do not show.
fn refuse_other_rows(asked: &[Pick], rows: usize) -> Result<(), IdentifyError> {
    for pick in asked {
        let definition = pick.kind.map(Kind::definition);
        let Some(definition) = definition.filter(|d| d.begins_at_a_row()) else {
            continue;
        };
        let id = definition.id;
        let counted = definition.site.iter().filter(|key| key.numbers().is_some());
        let before = counted.take_while(|key| **key != SiteKey::Row).count();
        let message = match pick.places.get(before) {
            None => format!("`{id}` cannot be identified: it begins at a row, and none is named"),
            Some((first, last)) if *first < 2 || *last as usize > rows => {
                format!(
                    "`{}`: the row is from 2 to {rows}, the last",
                    pick.to_word()
                )
            }
            Some(_) => continue,
        };
        return Err(IdentifyError::Suspicious {
            message,
            hint: format!(
                "`poseshift diagnose` finds the row; `{id}:{}{}` means from the row in the middle on",
                "1:".repeat(before),
                (rows / 2).max(2)
            ),
        });
    }
    Ok(())
}

/// Refuses effects that lack what they need where they were asked for.
pub(super) fn check_needs(
    problem: &Problem,
    measurements: &Measurements,
    effects: &[Effect],
    selection: &Selection,
) -> Result<(), IdentifyError> {
    refuse_other_rows(&selection.identify, measurements.rows.len())?;
    let masses =
        !problem.profile.bodies.is_empty() || problem.tools.iter().any(|t| t.load.is_some());
    for parameter in &problem.parameters {
        let Subject::Effect(slot) = parameter.subject else {
            continue;
        };
        let effect = &effects[slot.effect];
        let definition = effect.definition();
        let listed = definition
            .listed()
            .filter(|(_, list)| *list == List::Torques);
        if listed.is_some_and(|(number, _)| effect.parameters[number] == 0.0) {
            return Err(IdentifyError::Missing {
                id: definition.id,
                need: "a torque_n_m in the profile to begin with (`poseshift diagnose` \
                    searches it)",
            });
        }
        let asked = selection
            .identify
            .iter()
            .any(|p| p.kind == Some(effects[slot.effect].kind));
        for need in definition
            .needs
            .iter()
            .filter(|_| asked || definition.needs_masses())
        {
            let met = match need {
                Need::Masses => masses,
                Need::Directions => measurements.has(&DIRECTION_COLUMNS),
                Need::ExternalDirections => problem.rows.iter().any(|row| row.stand.is_directed()),
                Need::Temperature => measurements.has(&["temperature_c"]),
                Need::Time => measurements.has(&["time_s"]),
                Need::Order | Need::NoTime | Need::NoTemperature => true,
                Need::Moves => problem.rows.iter().any(|r| r.conditions.moved != [0.0; 6]),
                Need::Load => problem.tools.iter().any(|t| t.load.is_some()),
                Need::Points => has_points(&problem.rows),
                Need::Places => problem
                    .rows
                    .iter()
                    .all(|r| !matches!(r.observed, Observed::Contact(_))),
            };
            let too_even_c = (*need == Need::Temperature && met).then(|| too_even_c(&problem.rows));
            if let Some(by) = too_even_c.flatten() {
                return Err(IdentifyError::Suspicious {
                    message: format!(
                        "`{}` cannot be identified: temperature_c ranges over {by:.2} degrees, and \
                         {WARMER_C} are needed",
                        definition.id
                    ),
                    hint:
                        "measure when the arm is colder and when it is warmer, or leave it out of \
                           --identify"
                            .into(),
                });
            }
            if !met {
                return Err(IdentifyError::Missing {
                    id: definition.id,
                    need: need.describe(),
                });
            }
        }
    }
    Ok(())
}
