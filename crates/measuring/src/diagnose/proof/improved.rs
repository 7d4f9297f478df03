//! The profile with what was found.
//!
//! Effects of the data repair the analysis and are none of the robot's, but what they moved stays
//! where it is: base, tool and zeros are those of the last row.

use crate::diagnose::question::Session;
use crate::geometry::Pose;
use crate::identify::problem::Estimate;
use crate::model::Conditions;
use crate::model::effects::{Deflection, Effect, Kind, MOST_PARAMETERS, REGISTRY, Site, State};
use crate::profile::{DevicePlace, Mounted, Profile};

/// Index of a joint's zero in its link's geometry.
const THETA: usize = 3;

/// What effects of the data have moved by the last row, for a named point or for none. What depends
/// on where the tool is stays with the measurements.
fn moved(effects: &[Effect], rows: usize, point: Option<usize>) -> Deflection {
    let conditions = Conditions {
        row: u32::try_from(rows).ok(),
        point: point.and_then(|point| u32::try_from(point).ok()),
        ..Conditions::default()
    };
    let state = State {
        commanded: &[0.0; 6],
        torques: &[0.0; 6],
        frames: None,
        conditions: &conditions,
    };
    let mut moved = Deflection::none();
    for effect in effects.iter().filter(|e| e.definition().of_data) {
        effect.deflect(&state, &mut moved);
    }
    moved
}

/// The effect of this kind at a place, which is put into the list where it is not there yet.
fn at(effects: &mut Vec<Effect>, kind: Kind, site: Site) -> &mut Effect {
    let own = Effect {
        kind,
        site,
        parameters: [0.0; MOST_PARAMETERS],
    };
    let known = effects.iter().position(|e| e.same_place(&own));
    let index = known.unwrap_or_else(|| {
        effects.push(own);
        effects.len() - 1
    });
    &mut effects[index]
}

/// Makes one of the deviations of the only tool's frame, each of which stands on the one before.
fn join_tool_frames(effects: &mut Vec<Effect>, tools: &[Mounted]) {
    let [tool] = tools else { return };
    let is_own = |effect: &Effect| {
        let name = effect.site.tool.as_ref();
        effect.kind == Kind::ToolFrame && name.is_none_or(|name| *name == tool.name)
    };
    let own = effects.iter().filter(|effect| is_own(effect));
    if own.clone().count() < 2 {
        return;
    }
    let poses = own.clone().map(|e| Pose::from_xyz_rxryrz(e.parameters));
    let joined = poses.fold(Pose::identity(), |all, next| all * next);
    let named = own
        .clone()
        .find(|e| e.site.tool.is_some())
        .or(own.clone().next());
    let site = named.map_or_else(Site::default, |e| e.site.clone());
    effects.retain(|effect| !is_own(effect));
    effects.push(Effect {
        kind: Kind::ToolFrame,
        site,
        parameters: joined.xyz_rxryrz(),
    });
}

/// The profile with what was found, as the robot stands after the last row; what an `unsure` effect
/// of the session moved is not.
pub(crate) fn improved(
    profile: &Profile,
    session: &Session,
    estimate: &Estimate,
    unsure: &[Effect],
) -> Profile {
    let mut improved = profile.clone();
    // a device that stands elsewhere, or that the profile knows of, says nothing of the robot
    let keep_base = session.elsewhere || profile.device.is_some();
    let mut effects = estimate.effects.clone();
    let sure = effects
        .iter()
        .filter(|e| !unsure.iter().any(|u| u.same_place(e)));
    let sure: Vec<Effect> = sure.cloned().collect();
    let moved_by = |point| moved(&sure, session.problem.rows.len(), point);
    let moved = moved_by(None);
    effects.retain(|e| !(e.definition().of_data || keep_base && e.kind == Kind::BaseFrame));
    let world_from_base = Pose::from_xyz_rxryrz(moved.world) * estimate.world_from_base;
    if keep_base {
        let mut fitted = improved.clone();
        fitted.world_from_base = world_from_base;
        fitted.effects.clone_from(&estimate.effects);
        let nearer = profile.world_from_real_base() * fitted.world_from_real_base().inverse();
        improved.device = Some(DevicePlace {
            world_from_device: nearer * session.world_from_device,
            sigma: None,
        });
        let own = profile.effects.iter().filter(|e| e.kind == Kind::BaseFrame);
        effects.extend(own.cloned());
    } else {
        improved.world_from_base = world_from_base;
    }
    if moved.tool != [0.0; 6] {
        let tool = effects.iter().find(|e| e.kind == Kind::ToolFrame);
        let site = tool.map_or_else(Site::default, |e| e.site.clone());
        let tool = at(&mut effects, Kind::ToolFrame, site);
        let slipped = Pose::from_xyz_rxryrz(tool.parameters) * Pose::from_xyz_rxryrz(moved.tool);
        tool.parameters = slipped.xyz_rxryrz();
    }
    for (index, by) in moved.joints.into_iter().enumerate() {
        if by != 0.0 {
            let site = Site {
                index,
                ..Site::default()
            };
            let sign = profile.mechanism.joints[index].sign;
            at(&mut effects, Kind::LinkGeometry, site).parameters[THETA] += sign * by;
        }
    }
    join_tool_frames(&mut effects, &session.problem.tools);
    effects.retain(|e| !e.is_zero());
    effects.sort_by_key(|e| REGISTRY.iter().position(|kind| *kind == e.kind));
    improved.effects = effects;
    let points = session.problem.points.iter().zip(&estimate.points_m);
    for (index, (point, value)) in points.enumerate() {
        // what all points moved by is in the tool's frame
        let own = moved_by(Some(index)).tool;
        let value = std::array::from_fn(|k| value[k] + own[k] - moved.tool[k]);
        improved.points.insert(point.name.clone(), value);
    }
    improved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moved_stays_where_it_is_after_the_last_row() {
        let step = |kind, order, parameters: [f64; 6]| Effect {
            kind,
            site: Site {
                order,
                ..Site::default()
            },
            parameters,
        };
        let effects = [
            step(Kind::FrameShift, 10, [0.001, 0.0, 0.0, 0.0, 0.0, 0.002]),
            step(Kind::ToolSlip, 30, [0.0, 0.0, 0.003, 0.0, 0.0, 0.0]),
            // of the robot, and of where the tool is: not moved by the session
            step(Kind::BaseFrame, 1, [0.1; 6]),
            step(Kind::MeasurementScale, 1, [1e-4, 0.0, 0.0, 0.0, 0.0, 0.0]),
        ];
        let after = |rows| moved(&effects, rows, None);
        assert_eq!(after(9), Deflection::none());
        assert_eq!(after(20).world, [0.001, 0.0, 0.0, 0.0, 0.0, 0.002]);
        assert_eq!(after(20).tool, [0.0; 6]);
        assert_eq!(after(40).tool, [0.0, 0.0, 0.003, 0.0, 0.0, 0.0]);
        assert_eq!(after(40).world, after(20).world);
    }
}
