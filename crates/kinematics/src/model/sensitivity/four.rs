//! The same derivatives, four postures side by side.

use super::{Sensitivity, Torques};
use crate::geometry::{
    AxisRotation, Dual, Four, Pose, Scalar, Vector, WIDTH, add, constant, cross, scale, sub,
};
use crate::model::effects::{Deflection, Need, State};
use crate::model::{Conditions, Model};

/// Motion of the tool for a parameter that grows by one SI unit, in four postures.
#[derive(Clone, Copy, Debug)]
pub struct FourMotions {
    /// Rotation, radians.
    pub turn_rad: Vector<Four>,
    /// Displacement of the tool's origin, metres.
    pub shift_m: Vector<Four>,
}

impl FourMotions {
    /// No motion.
    pub fn none() -> Self {
        let zero = [Four::zero(); 3];
        Self {
            turn_rad: zero,
            shift_m: zero,
        }
    }

    #[inline(always)]
    fn add(&mut self, size: Four, unit: &Self) {
        self.turn_rad = add(self.turn_rad, scale(size, unit.turn_rad));
        self.shift_m = add(self.shift_m, scale(size, unit.shift_m));
    }
}

/// A model and its derivatives for four postures under the same conditions; links do not bend and
/// no force acts.
#[derive(Clone, Debug)]
pub struct FourSensitivities<'a> {
    one: &'a Sensitivity,
    model: Model<Four>,
    /// Whether a posture's deflection depends on nothing but its angles and torques.
    indifferent: bool,
}

impl Sensitivity {
    /// The same for four postures at once; `None` where links bend.
    pub fn four(&self) -> Option<FourSensitivities<'_>> {
        let needs = |effect: &super::Effect| effect.definition().needs;
        let plain = |need: &Need| matches!(need, Need::Masses);
        (!self.model.bends).then(|| FourSensitivities {
            one: self,
            model: self.model.cast(),
            indifferent: self
                .model
                .deflecting
                .iter()
                .all(|effect| needs(effect).iter().all(plain)),
        })
    }
}

impl FourSensitivities<'_> {
    /// Whether postures under these conditions may stand side by side.
    #[inline(always)]
    pub fn may_join(&self, a: &Conditions, b: &Conditions) -> bool {
        let unforced = a.force_n == [0.0; 3] && b.force_n == [0.0; 3];
        unforced && (self.indifferent || a == b)
    }

    /// As [`Sensitivity::evaluate`].
    #[inline(always)]
    pub fn evaluate(
        &self,
        q: &[Four; 6],
        conditions: &Conditions,
        motions: &mut [FourMotions],
    ) -> Pose<Four> {
        let chain = &self.model.chain;
        let commanded = self.model.mechanism.commanded(q);
        let turns = AxisRotation::of_each(&commanded);
        let mut torques = [Four::zero(); 6];
        let mut real = turns;
        if !self.model.deflecting.is_empty() {
            if self.model.loaded {
                torques = chain.torques(&turns, &self.model.loads, [0.0; 3]);
            }
            let mut deflection = Deflection::none();
            let state = State {
                commanded: &commanded,
                torques: &torques,
                frames: None,
                conditions,
            };
            for effect in &self.model.deflecting {
                effect.deflect(&state, &mut deflection);
            }
            for i in 0..6 {
                real[i] = real[i].and(deflection.joints[i]);
            }
        }
        let mut before = [chain.fixed[0]; 7];
        for i in 0..6 {
            before[i + 1] = before[i].turned(real[i]) * chain.fixed[i + 1];
        }
        let tool = before[6];
        let joints: [FourMotions; 6] = std::array::from_fn(|i| {
            let axis = before[i].rotation.axis(2);
            FourMotions {
                turn_rad: axis,
                shift_m: cross(axis, sub(tool.translation, before[i].translation)),
            }
        });
        for (column, motion) in self.one.columns.iter().zip(motions.iter_mut()) {
            *motion = FourMotions::none();
            for twist in &column.twists {
                let frame = &before[twist.at];
                let turn = frame.rotation * constant::<Four>(twist.turn);
                let lever = sub(tool.translation, frame.translation);
                let shift = frame.rotation * constant::<Four>(twist.shift);
                motion.turn_rad = add(motion.turn_rad, turn);
                motion.shift_m = add(motion.shift_m, add(shift, cross(turn, lever)));
            }
        }
        self.add_own_deflections(&commanded, &torques, conditions, &joints, motions);
        if !self.one.torque_effects.is_empty() {
            self.add_torques(&commanded, &turns, &torques, conditions, &joints, motions);
        }
        tool
    }

    /// What a deflecting effect does by its own parameters, posture by posture.
    #[inline(always)]
    fn add_own_deflections(
        &self,
        commanded: &[Four; 6],
        torques: &[Four; 6],
        conditions: &Conditions,
        joints: &[FourMotions; 6],
        motions: &mut [FourMotions],
    ) {
        for (column, motion) in self.one.columns.iter().zip(motions) {
            let Some(effect) = &column.deflecting else {
                continue;
            };
            let mut slopes = [Four::zero(); 6];
            for lane in 0..WIDTH {
                let state = State {
                    commanded: &commanded.map(|x| Dual::<1>::constant(x.0[lane])),
                    torques: &torques.map(|x| Dual::<1>::constant(x.0[lane])),
                    frames: None,
                    conditions,
                };
                let mut dual = Deflection::none();
                effect.deflect(&state, &mut dual);
                for i in 0..6 {
                    slopes[i].0[lane] = dual.joints[i].slope[0];
                }
            }
            for i in 0..6 {
                if slopes[i].0 != [0.0; WIDTH] {
                    motion.add(slopes[i], &joints[i]);
                }
            }
        }
    }

    /// What a changed geometry does by way of the torques.
    #[inline(always)]
    fn add_torques(
        &self,
        commanded: &[Four; 6],
        turns: &[AxisRotation<Four>; 6],
        torques: &[Four; 6],
        conditions: &Conditions,
        joints: &[FourMotions; 6],
        motions: &mut [FourMotions],
    ) {
        // what one newton metre at each joint does to the tool
        let mut slopes = [[Four::zero(); 6]; 6];
        for lane in 0..WIDTH {
            let variables = std::array::from_fn(|i| Dual::<6>::variable(torques[i].0[lane], i));
            let state = State {
                commanded: &commanded.map(|x| Dual::<6>::constant(x.0[lane])),
                torques: &variables,
                frames: None,
                conditions,
            };
            let mut dual = Deflection::none();
            for effect in &self.one.torque_effects {
                effect.deflect(&state, &mut dual);
            }
            for i in 0..6 {
                for j in 0..6 {
                    slopes[j][i].0[lane] = dual.joints[i].slope[j];
                }
            }
        }
        let mut by_torque = [FourMotions::none(); 6];
        for j in 0..6 {
            for i in 0..6 {
                if slopes[j][i].0 != [0.0; WIDTH] {
                    by_torque[j].add(slopes[j][i], &joints[i]);
                }
            }
        }
        let Model { chain, loads, .. } = &self.model;
        let gravity = Torques::of(chain, turns, &loads.masses, loads.gravity_m_s2);
        for (column, motion) in self.one.columns.iter().zip(motions) {
            if !column.changes_geometry() {
                continue;
            }
            let mut slopes = [Four::zero(); 6];
            gravity.add_slopes(&column.twists, &column.growths[0], &mut slopes);
            for (slope, unit) in slopes.iter().zip(&by_torque) {
                motion.add(*slope, unit);
            }
        }
    }
}
