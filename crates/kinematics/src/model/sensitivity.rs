//! How the tool moves when a parameter of an effect changes: exact, and without a derivative
//! written for any effect.
//!
//! Two facts make it fast. An effect that changes the geometry moves the fixed transforms of the
//! chain by twists that no posture changes, so one evaluation with dual numbers gives them for all
//! postures. An effect that deflects is evaluated with one dual number a posture; how a turned
//! joint, link, base or tool moves the tool is geometry.

mod four;

pub use four::{FourMotions, FourSensitivities};

use super::chain::{Chain, Hanging, Loads};
use super::effects::{Deflection, Effect, State};
use super::{Conditions, Geometry, Mechanism, Model};
use crate::geometry::{
    AxisRotation, Dual, Pose, Rotation, Scalar, Vector, add, constant, cross, dot, scale, sub,
};

/// Columns that one pass with dual numbers takes where links bend.
const CHUNK: usize = 8;

/// Motion of the tool for a parameter that grows by one SI unit, along the world's axes.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Motion {
    /// Rotation, radians.
    pub turn_rad: Vector,
    /// Displacement of the tool's origin, metres.
    pub shift_m: Vector,
}

/// A parameter: an effect in the list that a model is built of, and which of its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Slot {
    /// Index of the effect.
    pub effect: usize,
    /// Index of the parameter in the effect's definition.
    pub parameter: usize,
}

/// A twist of everything behind a fixed transform of the chain, in the frame behind it.
#[derive(Clone, Copy, Debug)]
struct Twist {
    at: usize,
    /// It is of the part of the transform before the link bends: in the frame of link `at` − 1
    /// (from 1), not behind the whole.
    unbent: bool,
    turn: Vector,
    shift: Vector,
}

/// Growth of the mass of one link and of its first moment in the frame that its joint turns.
#[derive(Clone, Copy, Debug)]
struct Growth {
    link: usize,
    mass: f64,
    moment: Vector,
}

#[derive(Clone, Debug)]
struct Column {
    twists: Vec<Twist>,
    /// Of the arm's bodies, and of the unit mass at the tool that an external force pulls.
    growths: [Vec<Growth>; 2],
    /// The effect with its parameter as the variable, where it deflects.
    deflecting: Option<Effect<Dual<1>>>,
}

/// A model with the derivatives of its tool pose by some parameters.
///
/// # Source
/// Geometric Jacobians (twists of the product of exponentials); torques by eqs. I.5–I.10 of the
/// thesis, differentiated.
#[derive(Clone, Debug)]
pub struct Sensitivity {
    model: Model,
    columns: Vec<Column>,
    /// The whole model with duals for columns that change the geometry, where links bend by
    /// moments.
    bending: Vec<(Vec<usize>, Model<Dual<CHUNK>>)>,
    /// The effects that read torques, with the six torques as variables.
    torque_effects: Vec<Effect<Dual<6>>>,
}

/// `Rᵀ dR` as a vector and `Rᵀ dt`: the twist of a transform in the frame behind it.
fn twist_of(pose: &Pose<Dual<1>>) -> (Vector, Vector) {
    let rotation = Rotation(pose.rotation.0.map(|row| row.map(|x| x.value)));
    let slope = Rotation(pose.rotation.0.map(|row| row.map(|x| x.slope[0])));
    let turn = (rotation.transpose() * slope).sine_axis();
    let shift = rotation.transpose() * pose.translation.map(|x| x.slope[0]);
    (turn, shift)
}

fn growths(hanging: &Hanging<Dual<1>>, chain: &Chain<Dual<1>>) -> Vec<Growth> {
    let value = |v: Vector<Dual<1>>| v.map(|x| x.value);
    let slope = |v: Vector<Dual<1>>| v.map(|x| x.slope[0]);
    let mut all = Vec::new();
    for link in 0..6 {
        let (mut mass, mut moment) = (
            hanging.mass_kg[link].slope[0],
            slope(hanging.fixed_moment[link]),
        );
        if link < 5 {
            let outer = hanging.mass_kg[link + 1];
            let to_next = chain.fixed[link + 1].translation;
            mass -= outer.slope[0];
            moment = sub(moment, scale(outer.slope[0], value(to_next)));
            moment = sub(moment, scale(outer.value, slope(to_next)));
        }
        // what is left is rounding where the masses do not depend on the parameter
        let largest = moment.iter().fold(mass.abs(), |most, x| most.max(x.abs()));
        if largest > 1e-12 {
            all.push(Growth { link, mass, moment });
        }
    }
    all
}

impl Column {
    fn of(
        geometry: &Geometry,
        mechanism: &Mechanism,
        effects: &[Effect],
        slot: Slot,
        conditions: &Conditions,
    ) -> Self {
        let mut dual: Vec<Effect<Dual<1>>> = effects.iter().map(Effect::cast).collect();
        dual[slot.effect].parameters[slot.parameter].slope = [1.0];
        let real = geometry.real(&dual, conditions);
        let chain = Chain::of(&real, mechanism);
        let loads = Loads::of(&real, &chain);
        let bends = effects.iter().any(|effect| effect.definition().bends);
        let mut parts: Vec<(usize, bool, Pose<Dual<1>>)> = Vec::new();
        for at in 0..7 {
            if bends && at > 0 {
                // a link bends about its own frame's origin, between the two parts of the transform
                let own = chain.turning_from_link[at - 1];
                parts.push((at, true, own));
                parts.push((at, false, own.inverse() * chain.fixed[at]));
            } else {
                parts.push((at, false, chain.fixed[at]));
            }
        }
        let twists = parts
            .into_iter()
            .map(|(at, unbent, pose)| (at, unbent, twist_of(&pose)))
            .filter(|(_, _, (turn, shift))| *turn != [0.0; 3] || *shift != [0.0; 3])
            .map(|(at, unbent, (turn, shift))| Twist {
                at,
                unbent,
                turn,
                shift,
            })
            .collect();
        let effect = dual.swap_remove(slot.effect);
        Self {
            twists,
            growths: [
                growths(&loads.masses, &chain),
                growths(&loads.unit_mass, &chain),
            ],
            deflecting: effect.definition().deflects.then_some(effect),
        }
    }

    fn changes_geometry(&self) -> bool {
        !self.twists.is_empty() || self.growths.iter().any(|g| !g.is_empty())
    }
}

/// What a torque at each joint does to the tool, folded over the joints a column acts on.
struct Torques<S = f64> {
    /// First moment of what hangs on each joint about its origin, and its mass.
    moments: [Vector<S>; 6],
    masses: [S; 6],
    rotations: [Rotation<S>; 6],
    origins: [Vector<S>; 6],
    before: [Rotation<S>; 6],
    /// dτ by a rigid turn of everything from this joint on.
    by_turn: [Vector<S>; 6],
    /// dτ by the first moment.
    by_moment: [Vector<S>; 6],
}

impl<S: Scalar> Torques<S> {
    #[inline(always)]
    fn of(
        chain: &Chain<S>,
        turns: &[AxisRotation<S>; 6],
        hanging: &Hanging<S>,
        field: Vector<S>,
    ) -> Self {
        let none = [[S::zero(); 3]; 6];
        let mut all = Self {
            moments: none,
            masses: hanging.mass_kg,
            rotations: [Rotation::identity(); 6],
            origins: none,
            before: [Rotation::identity(); 6],
            by_turn: none,
            by_moment: none,
        };
        let mut pose = chain.fixed[0];
        for i in 0..6 {
            let turning = pose.turned(turns[i]);
            all.before[i] = pose.rotation;
            all.rotations[i] = turning.rotation;
            all.origins[i] = turning.translation;
            pose = turning * chain.fixed[i + 1];
        }
        chain.pull(turns, hanging, field, |i, moment, _| {
            all.moments[i] = all.rotations[i] * moment;
        });
        for i in 0..6 {
            let axis = all.rotations[i].axis(2);
            all.by_turn[i] = cross(cross(axis, all.moments[i]), field);
            all.by_moment[i] = cross(field, axis);
        }
        all
    }

    /// dτ of every joint.
    #[inline(always)]
    fn add_slopes(&self, twists: &[Twist], growths: &[Growth], slopes: &mut [S; 6]) {
        for twist in twists.iter().filter(|twist| twist.at < 6) {
            let k = twist.at;
            let turn = self.before[k] * constant(twist.turn);
            let shift = self.before[k] * constant(twist.shift);
            let moment = add(cross(turn, self.moments[k]), scale(self.masses[k], shift));
            for i in 0..k {
                slopes[i] += dot(self.by_moment[i], moment);
            }
            for i in k..6 {
                slopes[i] += dot(self.by_turn[i], turn);
            }
        }
        for growth in growths {
            let moment = self.rotations[growth.link] * constant(growth.moment);
            for i in 0..=growth.link {
                let lever = sub(self.origins[growth.link], self.origins[i]);
                let moment = add(moment, scale(S::constant(growth.mass), lever));
                slopes[i] += dot(self.by_moment[i], moment);
            }
        }
    }
}

/// Where everything of the deflected arm is: what turns it, and where the tool ends.
struct Layout {
    /// Frames behind each fixed transform.
    before: [Pose; 7],
    /// Frames of the links before they bend; only where links bend.
    links: [Pose; 6],
    tool: Pose,
}

impl Layout {
    #[inline(always)]
    fn of(model: &Model, turns: &[AxisRotation; 6], deflection: &Deflection) -> Self {
        let chain = &model.chain;
        let mut before = [chain.fixed[0]; 7];
        let mut links = [Pose::identity(); 6];
        if model.bends {
            before[0] = Pose::from_xyz_rxryrz(deflection.world) * chain.fixed[0];
        }
        for i in 0..6 {
            let turning = before[i].turned(turns[i]);
            before[i + 1] = if model.bends {
                let own = chain.turning_from_link[i];
                links[i] = turning * own;
                let [x, y, z] = deflection.links[i];
                let bend = Rotation::about_x(x) * Rotation::about_y(y) * Rotation::about_z(z);
                links[i] * Pose::from_rotation(bend) * own.inverse() * chain.fixed[i + 1]
            } else {
                turning * chain.fixed[i + 1]
            };
        }
        let tool = if model.bends {
            before[6] * Pose::from_xyz_rxryrz(deflection.tool)
        } else {
            before[6]
        };
        Self {
            before,
            links,
            tool,
        }
    }

    fn turned(&self, axis: Vector, about: Vector) -> Motion {
        Motion {
            turn_rad: axis,
            shift_m: cross(axis, sub(self.tool.translation, about)),
        }
    }

    /// Rotation of a joint by one radian in the controller's sense.
    fn joint(&self, i: usize) -> Motion {
        self.turned(self.before[i].rotation.axis(2), self.before[i].translation)
    }

    /// Growth of one of the three angles of `Rx · Ry · Rz` in this frame.
    fn angle(&self, frame: &Pose, angles: Vector, k: usize) -> Motion {
        self.turned(frame.rotation * axis_of_angle(angles, k), frame.translation)
    }

    /// Adds the motion of a small change of the deflection.
    fn add(&self, by: &Deflection, at: &Deflection, bends: bool, motion: &mut Motion) {
        let mut take = |size: f64, of: &dyn Fn() -> Motion| {
            if size != 0.0 {
                let unit = of();
                motion.turn_rad = add(motion.turn_rad, scale(size, unit.turn_rad));
                motion.shift_m = add(motion.shift_m, scale(size, unit.shift_m));
            }
        };
        for i in 0..6 {
            take(by.joints[i], &|| self.joint(i));
        }
        if !bends {
            return;
        }
        let shifted = |axis: Vector| Motion {
            turn_rad: [0.0; 3],
            shift_m: axis,
        };
        for k in 0..3 {
            for i in 0..6 {
                take(by.links[i][k], &|| {
                    self.angle(&self.links[i], at.links[i], k)
                });
            }
            let unit = std::array::from_fn(|j| f64::from(u8::from(j == k)));
            take(by.world[k], &|| shifted(unit));
            take(by.tool[k], &|| shifted(self.before[6].rotation.axis(k)));
            let [x, y, z, rx, ry, rz] = at.world;
            let place = Pose::from_translation(x, y, z);
            take(by.world[3 + k], &|| self.angle(&place, [rx, ry, rz], k));
            let [_, _, _, rx, ry, rz] = at.tool;
            let place = Pose {
                rotation: self.before[6].rotation,
                translation: self.tool.translation,
            };
            take(by.tool[3 + k], &|| self.angle(&place, [rx, ry, rz], k));
        }
    }
}

/// The axis about which the `k`-th angle of `Rx · Ry · Rz` turns, in the frame before the three.
fn axis_of_angle([x, y, _]: Vector, k: usize) -> Vector {
    match k {
        0 => [1.0, 0.0, 0.0],
        1 => Rotation::about_x(x).axis(1),
        _ => (Rotation::about_x(x) * Rotation::about_y(y)).axis(2),
    }
}

impl Sensitivity {
    /// Prepares a model and its derivatives by the parameters `slots`. The conditions are those
    /// that change the geometry.
    #[must_use]
    pub fn build(
        geometry: &Geometry,
        mechanism: &Mechanism,
        effects: &[Effect],
        slots: &[Slot],
        conditions: &Conditions,
    ) -> Self {
        let model = Model::build(geometry, mechanism, effects, conditions);
        let columns: Vec<Column> = slots
            .iter()
            .map(|slot| Column::of(geometry, mechanism, effects, *slot, conditions))
            .collect();
        let mut bending = Vec::new();
        if model.bends {
            let changing: Vec<usize> = (0..slots.len())
                .filter(|i| columns[*i].changes_geometry())
                .collect();
            for chunk in changing.chunks(CHUNK) {
                let mut dual: Vec<Effect<Dual<CHUNK>>> = effects.iter().map(Effect::cast).collect();
                for (variable, column) in chunk.iter().enumerate() {
                    let Slot { effect, parameter } = slots[*column];
                    dual[effect].parameters[parameter].slope[variable] = 1.0;
                }
                let model = Model::build(geometry, mechanism, &dual, conditions);
                bending.push((chunk.to_vec(), model));
            }
        }
        let torque_effects = if model.bends {
            Vec::new()
        } else {
            let loaded = model.deflecting.iter();
            loaded
                .filter(|effect| effect.definition().needs_masses())
                .map(Effect::cast)
                .collect()
        };
        Self {
            model,
            columns,
            bending,
            torque_effects,
        }
    }

    /// The model itself.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// `world_from_tool` at the controller's joint angles `q` in radians; `motions` receives one
    /// motion a parameter.
    pub fn evaluate(&self, q: &[f64; 6], conditions: &Conditions, motions: &mut [Motion]) -> Pose {
        let model = &self.model;
        let commanded = model.mechanism.commanded(q);
        let turns = AxisRotation::of_each(&commanded);
        let mut deflection = Deflection::none();
        if !model.deflecting.is_empty() {
            model.deflect(&commanded, &turns, conditions, &mut deflection);
        }
        let mut real = turns;
        for i in 0..6 {
            real[i] = real[i].and(deflection.joints[i]);
        }
        let layout = Layout::of(model, &real, &deflection);
        for (column, motion) in self.columns.iter().zip(motions.iter_mut()) {
            *motion = Motion::default();
            for twist in &column.twists {
                let frame = if twist.unbent {
                    &layout.links[twist.at - 1]
                } else {
                    &layout.before[twist.at]
                };
                let turn = frame.rotation * twist.turn;
                let lever = sub(layout.tool.translation, frame.translation);
                let shift = add(frame.rotation * twist.shift, cross(turn, lever));
                motion.turn_rad = add(motion.turn_rad, turn);
                motion.shift_m = add(motion.shift_m, shift);
            }
        }
        self.add_own_deflections(
            &commanded,
            &turns,
            conditions,
            &deflection,
            &layout,
            motions,
        );
        if model.bends {
            self.add_bending(q, conditions, &deflection, &layout, motions);
        } else if !self.torque_effects.is_empty() {
            self.add_torques(&commanded, &turns, conditions, &layout, motions);
        }
        layout.tool
    }

    /// What a deflecting effect does by its own parameters.
    #[inline(always)]
    fn add_own_deflections(
        &self,
        commanded: &[f64; 6],
        turns: &[AxisRotation; 6],
        conditions: &Conditions,
        at: &Deflection,
        layout: &Layout,
        motions: &mut [Motion],
    ) {
        let model = &self.model;
        if self.columns.iter().all(|c| c.deflecting.is_none()) {
            return;
        }
        let torques = if model.loaded {
            model.chain.torques(turns, &model.loads, conditions.force_n)
        } else {
            [0.0; 6]
        };
        let frames = model.bends.then(|| {
            let frames = model.chain.frames(turns, &model.loads, conditions.force_n);
            frames.cast::<Dual<1>>()
        });
        let commanded = commanded.map(Dual::<1>::constant);
        let torques = torques.map(Dual::<1>::constant);
        let state = State {
            commanded: &commanded,
            torques: &torques,
            frames: frames.as_ref(),
            conditions,
        };
        for (column, motion) in self.columns.iter().zip(motions) {
            let Some(effect) = &column.deflecting else {
                continue;
            };
            // where links bend, the pass with the whole model's duals has this part already
            if model.bends && column.changes_geometry() {
                continue;
            }
            let mut dual = Deflection::none();
            effect.deflect(&state, &mut dual);
            layout.add(&slope_of(&dual, 0), at, effect.definition().bends, motion);
        }
    }

    /// What a changed geometry does by way of torques and moments, where links bend.
    fn add_bending(
        &self,
        q: &[f64; 6],
        conditions: &Conditions,
        at: &Deflection,
        layout: &Layout,
        motions: &mut [Motion],
    ) {
        let q = q.map(Dual::<CHUNK>::constant);
        for (columns, model) in &self.bending {
            let dual = model.deflection(&q, conditions);
            for (variable, column) in columns.iter().enumerate() {
                layout.add(&slope_of(&dual, variable), at, true, &mut motions[*column]);
            }
        }
    }

    /// What a changed geometry does by way of the torques.
    #[inline(always)]
    fn add_torques(
        &self,
        commanded: &[f64; 6],
        turns: &[AxisRotation; 6],
        conditions: &Conditions,
        layout: &Layout,
        motions: &mut [Motion],
    ) {
        let Model { chain, loads, .. } = &self.model;
        let torques = chain.torques(turns, loads, conditions.force_n);
        let variables = std::array::from_fn(|i| Dual::<6>::variable(torques[i], i));
        let state = State {
            commanded: &commanded.map(Dual::<6>::constant),
            torques: &variables,
            frames: None,
            conditions,
        };
        let mut dual = Deflection::none();
        for effect in &self.torque_effects {
            effect.deflect(&state, &mut dual);
        }
        // what one newton metre at each joint does to the tool
        let mut by_torque = [Motion::default(); 6];
        for j in 0..6 {
            for i in 0..6 {
                let size = dual.joints[i].slope[j];
                if size != 0.0 {
                    let unit = layout.joint(i);
                    let into = &mut by_torque[j];
                    into.turn_rad = add(into.turn_rad, scale(size, unit.turn_rad));
                    into.shift_m = add(into.shift_m, scale(size, unit.shift_m));
                }
            }
        }
        let gravity = Torques::of(chain, turns, &loads.masses, loads.gravity_m_s2);
        let force = (conditions.force_n != [0.0; 3])
            .then(|| Torques::of(chain, turns, &loads.unit_mass, conditions.force_n));
        for (column, motion) in self.columns.iter().zip(motions) {
            if !column.changes_geometry() {
                continue;
            }
            let mut slopes = [0.0; 6];
            gravity.add_slopes(&column.twists, &column.growths[0], &mut slopes);
            if let Some(force) = &force {
                force.add_slopes(&column.twists, &column.growths[1], &mut slopes);
            }
            for (slope, unit) in slopes.iter().zip(&by_torque) {
                motion.turn_rad = add(motion.turn_rad, scale(*slope, unit.turn_rad));
                motion.shift_m = add(motion.shift_m, scale(*slope, unit.shift_m));
            }
        }
    }
}

fn slope_of<const N: usize>(dual: &Deflection<Dual<N>>, variable: usize) -> Deflection {
    Deflection {
        joints: dual.joints.map(|x| x.slope[variable]),
        links: dual.links.map(|v| v.map(|x| x.slope[variable])),
        world: dual.world.map(|x| x.slope[variable]),
        tool: dual.tool.map(|x| x.slope[variable]),
    }
}
