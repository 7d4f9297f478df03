//! The real arm: a chain with the effects on it.

#![allow(
    clippy::needless_range_loop,
    reason = "one index runs over several arrays"
)]

use super::chain::{Chain, Loads};
use super::conditions::Conditions;
use super::effects::{Deflection, Effect, State};
use super::geometry::{Geometry, Mechanism};
use crate::geometry::{AxisRotation, Dual, Pose, Scalar};
use std::borrow::Cow;

/// An arm with one tool, ready to be evaluated: joint angles in the controller's sense in, tool
/// pose in the world out.
///
/// Every joint effect is evaluated at the commanded angles, and gravity torques on the calibrated
/// geometry at the commanded angles: small perturbations superpose (thesis, Annex I).
#[derive(Clone, Debug)]
pub struct Model<S = f64> {
    pub(super) chain: Chain<S>,
    world_from_base: Pose<S>,
    pub(super) loads: Loads<S>,
    pub(super) mechanism: Mechanism,
    /// The effects that depend on the posture.
    pub(super) deflecting: Vec<Effect<S>>,
    pub(super) loaded: bool,
    pub(super) bends: bool,
    reads_angles: bool,
}

impl<S: Scalar> Model<S> {
    /// Applies the effects that change the geometry and keeps the others for [`Model::forward`].
    #[must_use]
    pub fn build(
        geometry: &Geometry,
        mechanism: &Mechanism,
        effects: &[Effect<S>],
        conditions: &Conditions,
    ) -> Self {
        let real = geometry.real(effects, conditions);
        let deflecting: Vec<_> = effects
            .iter()
            .filter(|e| e.definition().deflects)
            .cloned()
            .collect();
        let chain = Chain::of(&real, mechanism);
        Self {
            loads: Loads::of(&real, &chain),
            chain,
            world_from_base: real.world_from_base,
            mechanism: mechanism.clone(),
            loaded: deflecting.iter().any(|e| e.definition().needs_masses()),
            bends: deflecting.iter().any(|e| e.definition().bends),
            reads_angles: deflecting.iter().any(Effect::reads_angles),
            deflecting,
        }
    }

    /// How the controller counts the joints of this arm.
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// `world_from_tool` at the controller's joint angles `q`, radians.
    #[must_use]
    pub fn forward(&self, q: &[S; 6], conditions: &Conditions) -> Pose<S> {
        self.forward_here(q, conditions)
    }

    /// [`Model::forward`] as a part of the caller, which a vector kernel needs; elsewhere it would be
    /// compiled once a call.
    #[inline(always)]
    pub(super) fn forward_here(&self, q: &[S; 6], conditions: &Conditions) -> Pose<S> {
        let commanded = self.mechanism.commanded(q);
        self.forward_turned(&commanded, &AxisRotation::of_each(&commanded), conditions)
    }

    /// [`Model::forward`] from the mechanical angles in the controller's sense and their sines and
    /// cosines. The angles themselves are not looked at unless [`Model::reads_angles`].
    #[inline(always)]
    #[must_use]
    pub(crate) fn forward_turned(
        &self,
        commanded: &[S; 6],
        turns: &[AxisRotation<S>; 6],
        conditions: &Conditions,
    ) -> Pose<S> {
        let mut real = *turns;
        if !self.deflecting.is_empty() {
            let mut deflection = Deflection::none();
            self.deflect(commanded, turns, conditions, &mut deflection);
            for i in 0..6 {
                real[i] = real[i].and(deflection.joints[i]);
            }
            if self.bends {
                return self.chain.forward_deflected(&real, &deflection);
            }
        }
        self.chain.forward(&real)
    }

    /// Where the base and the frame after each row of the chain are in the world, `world_from_link`
    /// of link 0 to 6, with all that the posture does to them.
    #[must_use]
    pub fn link_frames(&self, q: &[S; 6], conditions: &Conditions) -> [Pose<S>; 7] {
        let commanded = self.mechanism.commanded(q);
        let turns = AxisRotation::of_each(&commanded);
        let mut deflection = Deflection::none();
        if !self.deflecting.is_empty() {
            self.deflect(&commanded, &turns, conditions, &mut deflection);
        }
        let real = std::array::from_fn(|i| turns[i].and(deflection.joints[i]));
        let mut frames = [self.world_from_base; 7];
        let links = self.chain.links(&real, self.bends.then_some(&deflection));
        if self.bends {
            frames[0] = Pose::from_xyz_rxryrz(deflection.world) * self.world_from_base;
        }
        frames[1..].copy_from_slice(&links);
        frames
    }

    /// Distance from the origin of the base or a link's frame to the origin of the next, the base's
    /// first, metres: no posture changes it.
    #[must_use]
    pub fn reaches(&self) -> [S; 6] {
        self.chain.reaches(&self.world_from_base)
    }

    /// Whether some effect depends on the joint angles themselves, not only on their sines and
    /// cosines.
    pub(crate) fn reads_angles(&self) -> bool {
        self.reads_angles
    }

    /// What the posture does to joints, links, base and tool at the controller's joint angles `q`,
    /// radians.
    #[must_use]
    pub fn deflection(&self, q: &[S; 6], conditions: &Conditions) -> Deflection<S> {
        let commanded = self.mechanism.commanded(q);
        let turns = AxisRotation::of_each(&commanded);
        let mut deflection = Deflection::none();
        self.deflect(&commanded, &turns, conditions, &mut deflection);
        deflection
    }

    /// Torque of gravity and external force about each joint in the controller's sense, N·m.
    #[must_use]
    pub fn torques(&self, q: &[S; 6], conditions: &Conditions) -> [S; 6] {
        let turns = AxisRotation::of_each(&self.mechanism.commanded(q));
        let loads = self.loads_in(conditions);
        self.chain.torques(&turns, &loads, conditions.force_n)
    }

    /// What hangs on the chain, pulled as the base leans.
    #[inline(always)]
    fn loads_in(&self, conditions: &Conditions) -> Cow<'_, Loads<S>> {
        match conditions.gravity_m_s2 {
            None => Cow::Borrowed(&self.loads),
            Some(gravity) => Cow::Owned({
                let mut loads = self.loads;
                loads.gravity_m_s2 = gravity.map(S::constant);
                loads
            }),
        }
    }

    #[inline(always)]
    pub(super) fn deflect(
        &self,
        commanded: &[S; 6],
        turns: &[AxisRotation<S>; 6],
        conditions: &Conditions,
        deflection: &mut Deflection<S>,
    ) {
        let mut torques = [S::zero(); 6];
        let loads = self.loads_in(conditions);
        if self.loaded {
            torques = self.chain.torques(turns, &loads, conditions.force_n);
        }
        let bent;
        let frames = if self.bends {
            bent = self.chain.frames(turns, &loads, conditions.force_n);
            Some(&bent)
        } else {
            None
        };
        let state = State {
            commanded,
            torques: &torques,
            frames,
            conditions,
        };
        for effect in &self.deflecting {
            effect.deflect(&state, deflection);
        }
    }
}

impl Model {
    /// The same model as constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Model<S> {
        Model {
            chain: self.chain.cast(),
            world_from_base: self.world_from_base.cast(),
            loads: self.loads.cast(),
            mechanism: self.mechanism.clone(),
            deflecting: self.deflecting.iter().map(Effect::cast).collect(),
            loaded: self.loaded,
            bends: self.bends,
            reads_angles: self.reads_angles,
        }
    }

    /// The pose at `q` with its exact derivatives by the six joint angles.
    #[must_use]
    pub fn forward_with_slopes(&self, q: &[f64; 6], conditions: &Conditions) -> Pose<Dual<6>> {
        let variables = std::array::from_fn(|i| Dual::variable(q[i], i));
        self.cast::<Dual<6>>().forward(&variables, conditions)
    }
}
