//! What the arm's own weight does to frames from sweeps: the arm bends while it sweeps, and a
//! circle fit takes that for geometry.

use super::{AxesError, Construction, Placed, Sweep, base_of, points_of, tool_of};
use crate::geometry::{Pose, Vector, sub};
use crate::model::effects::{Effect, Kind, MOST_PARAMETERS, Site};
use crate::model::{Conditions, Model};
use crate::profile::{Mounted, Profile};
use crate::register::uncertainty::PoseCovariance;
use nalgebra::{Matrix6, Vector6};

/// A joint of typical stiffness gives way by so much at its largest torque, at most, radians: that
/// of the IRB 120 in `robots/abb_irb120_thesis.yaml` by 1.4e-3 (joint 2 at 43 N·m).
const TYPICAL_RAD: f64 = 2e-3;

/// Which frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// `world_from_base`, from the sweeps of joints 1 and 2.
    Base,
    /// `flange_from_tool`, from the sweeps of joints 6 and 5.
    Tool,
}

/// The share of the arm's sag in a frame's uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sag {
    /// Whether it is that of a typical arm, because the profile has no compliance.
    pub typical: bool,
    /// How far the frame is moved: squares and products of the motion, as a covariance.
    pub covariance: PoseCovariance,
}

impl PoseCovariance {
    /// Two independent uncertainties of one motion, expressed about one centre.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        Self::new(self.centre_m, &(self.as_matrix() + other.as_matrix()))
    }
}

/// The arm, and where the point is on it.
#[derive(Clone, Copy, Debug)]
pub struct Arm<'a> {
    /// Where the base stands.
    pub world_from_base: Pose,
    /// What hangs on the flange.
    pub mounted: &'a Mounted,
    /// The measured point in the flange frame, metres.
    pub point_m: Vector,
}

/// The model of the arm with some effects alone.
fn model(profile: &Profile, arm: &Arm, effects: &[Effect]) -> Model {
    let mounted = Mounted {
        name: arm.mounted.name.clone(),
        flange_from_tool: Pose::from_translation(arm.point_m[0], arm.point_m[1], arm.point_m[2]),
        load: arm.mounted.load,
    };
    let mut geometry = profile.geometry(&mounted);
    geometry.world_from_base = arm.world_from_base;
    Model::build(
        &geometry,
        &profile.mechanism,
        effects,
        &Conditions::default(),
    )
}

/// What gives way: the profile's effects, or the joints of a typical arm, all of them: they give way
/// in the same direction, down.
fn compliance(profile: &Profile, arm: &Arm, sweeps: [&Sweep; 2]) -> (bool, Vec<Effect>) {
    let own: Vec<Effect> = profile
        .real_effects()
        .into_iter()
        .filter(|effect| effect.definition().deflects && !effect.is_zero())
        .collect();
    if !own.is_empty() {
        return (false, own);
    }
    let stiff = model(profile, arm, &[]);
    let nothing = Conditions::default();
    let mut most = [0.0_f64; 6];
    for row in sweeps.iter().flat_map(|sweep| &sweep.rows) {
        let torques = stiff.torques(&row.q, &nothing);
        most.iter_mut()
            .zip(torques)
            .for_each(|(m, t)| *m = m.max(t.abs()));
    }
    let prior = Kind::JointCompliance.definition().parameters[0].prior_sigma;
    let typical = most.iter().enumerate().filter(|(_, most)| **most > 0.0);
    let each = typical.map(|(index, most)| {
        let mut parameters = [0.0; MOST_PARAMETERS];
        parameters[0] = prior.min(TYPICAL_RAD / most);
        Effect {
            kind: Kind::JointCompliance,
            site: Site {
                index,
                ..Site::default()
            },
            parameters,
        }
    });
    (true, each.collect())
}

/// The share of the arm's sag in a frame's uncertainty: how far the frame moves if the sag is taken
/// off the points. It is not taken off the frame itself, which is that of the points as they were
/// measured. `None` where nothing weighs.
///
/// # Errors
/// As [`super::axis`].
pub fn sag(
    frame: Frame,
    sweeps: [&Sweep; 2],
    placed: &Placed,
    profile: &Profile,
    arm: &Arm,
) -> Result<Option<Sag>, AxesError> {
    let construct: Construction = match frame {
        Frame::Base => base_of,
        Frame::Tool => tool_of,
    };
    let (typical, effects) = compliance(profile, arm, sweeps);
    let stiff = model(profile, arm, &[]);
    let soft = model(profile, arm, &effects);
    let nothing = Conditions::default();
    let rows = sweeps.iter().flat_map(|sweep| &sweep.rows);
    let straight: Vec<Vector> = rows
        .zip(&points_of(sweeps))
        .map(|(row, point)| {
            let [soft, stiff] = [&soft, &stiff].map(|m| m.forward(&row.q, &nothing));
            sub(*point, sub(soft.translation, stiff.translation))
        })
        .collect();
    let other = construct(sweeps, &straight, profile)?;
    let turn = (placed.pose.rotation * other.rotation.transpose()).vector();
    let shift = sub(placed.pose.translation, other.translation);
    let moved = Vector6::new(turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]);
    let matrix: Matrix6<f64> = moved * moved.transpose();
    let covariance = PoseCovariance::new(placed.pose.translation, &matrix);
    Ok((matrix.norm() > 0.0).then_some(Sag {
        typical,
        covariance,
    }))
}
