//! The real arm: a chain with the effects on it.

use super::chain::{Chain, Frames, Loads};
use super::conditions::Conditions;
use super::effects::{Deflection, Effect, State};
use super::geometry::{Geometry, Mechanism};
use crate::geometry::{Dual, Pose, Scalar};

/// An arm with one tool, ready to be evaluated: joint angles in the controller's sense in, tool pose in the world out.
///
/// Every joint effect is evaluated at the commanded angles, and gravity torques on the calibrated geometry at the commanded
/// angles: small perturbations superpose (thesis, Annex I).
#[derive(Clone, Debug)]
pub struct Model<S = f64> {
    chain: Chain<S>,
    loads: Loads<S>,
    mechanism: Mechanism,
    /// θ of each row plus the controller's offset, radians.
    home: [S; 6],
    sign: [S; 6],
    /// The effects that depend on the posture.
    deflecting: Vec<Effect<S>>,
    loaded: bool,
    bends: bool,
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
        let mut real: Geometry<S> = geometry.cast();
        for effect in effects {
            effect.change_geometry(conditions, &mut real);
        }
        let deflecting: Vec<_> = effects
            .iter()
            .filter(|e| e.definition().deflects)
            .cloned()
            .collect();
        Self {
            chain: Chain::of(&real),
            loads: Loads::of(&real),
            mechanism: mechanism.clone(),
            home: std::array::from_fn(|i| {
                real.links[i].theta_rad + S::constant(mechanism.joints[i].offset_rad)
            }),
            sign: std::array::from_fn(|i| S::constant(mechanism.joints[i].sign)),
            loaded: deflecting.iter().any(|e| e.definition().needs_masses()),
            bends: deflecting.iter().any(|e| e.definition().bends),
            deflecting,
        }
    }

    /// How the controller counts the joints of this arm.
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// `world_from_tool` at the controller's joint angles `q`, radians.
    #[inline(always)]
    #[must_use]
    pub fn forward(&self, q: &[S; 6], conditions: &Conditions) -> Pose<S> {
        let commanded = self.mechanism.commanded(q);
        if self.deflecting.is_empty() {
            return self.chain.forward(&self.chain_angles(&commanded));
        }
        let deflection = self.deflection_of(commanded, conditions);
        let real = std::array::from_fn(|i| commanded[i] + deflection.joints[i]);
        let angles = self.chain_angles(&real);
        if self.bends {
            self.chain.forward_deflected(&angles, &deflection)
        } else {
            self.chain.forward(&angles)
        }
    }

    /// What the posture does to joints, links, base and tool at the controller's joint angles `q`, radians.
    #[must_use]
    pub fn deflection(&self, q: &[S; 6], conditions: &Conditions) -> Deflection<S> {
        self.deflection_of(self.mechanism.commanded(q), conditions)
    }

    /// Torque of gravity and external force about each joint in the controller's sense, N·m.
    #[must_use]
    pub fn torques(&self, q: &[S; 6], conditions: &Conditions) -> [S; 6] {
        let angles = self.chain_angles(&self.mechanism.commanded(q));
        let frames = self.chain.frames(&angles, &self.loads, conditions.force_n);
        self.torques_of(&frames)
    }

    #[inline(always)]
    fn torques_of(&self, frames: &Frames<S>) -> [S; 6] {
        std::array::from_fn(|i| self.sign[i] * frames.torque(i))
    }

    #[inline(always)]
    fn deflection_of(&self, commanded: [S; 6], conditions: &Conditions) -> Deflection<S> {
        let mut state = State {
            commanded,
            torques: [S::zero(); 6],
            frames: None,
            conditions: *conditions,
        };
        if self.loaded {
            let frames = self.chain.frames(
                &self.chain_angles(&commanded),
                &self.loads,
                conditions.force_n,
            );
            state.torques = self.torques_of(&frames);
            state.frames = self.bends.then_some(frames);
        }
        let mut deflection = Deflection::none();
        for effect in &self.deflecting {
            effect.deflect(&state, &mut deflection);
        }
        deflection
    }

    #[inline(always)]
    fn chain_angles(&self, mechanical: &[S; 6]) -> [S; 6] {
        std::array::from_fn(|i| self.sign[i] * mechanical[i] + self.home[i])
    }
}

impl Model {
    /// The same model as constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Model<S> {
        Model {
            chain: self.chain.cast(),
            loads: self.loads.cast(),
            mechanism: self.mechanism.clone(),
            home: self.home.map(S::constant),
            sign: self.sign.map(S::constant),
            deflecting: self.deflecting.iter().map(Effect::cast).collect(),
            loaded: self.loaded,
            bends: self.bends,
        }
    }

    /// The pose at `q` with its exact derivatives by the six joint angles.
    #[must_use]
    pub fn forward_with_slopes(&self, q: &[f64; 6], conditions: &Conditions) -> Pose<Dual<6>> {
        let variables = std::array::from_fn(|i| Dual::variable(q[i], i));
        self.cast::<Dual<6>>().forward(&variables, conditions)
    }
}
