//! The chain of six links, with everything that does not move folded into constants.

#![allow(
    clippy::needless_range_loop,
    reason = "one index runs over several arrays"
)]

use super::effects::Deflection;
use super::geometry::{Body, Geometry, Link, Mechanism};
use super::rows::Axes;
use crate::geometry::{AxisRotation, Pose, Rotation, Scalar, Vector, add, cross, norm, scale, sub};

/// Six revolute joints between seven fixed transforms: `world_from_tool = F0 · Rz(u1) · F1 · Rz(u2)
/// · … · Rz(u6) · F6`, with the mechanical joint angles u in the controller's sense.
///
/// Row i of the chain is `Xi · Rz(homei ± ui) · Trans(0, 0, di)` with `Xi = Rot(x, αi) · Trans(ai,
/// 0, 0) · Rot(y, βi)`, and a joint that turns in the negative sense is turned over: `Rz(−u) = D ·
/// Rz(u) · D` with `D = Rot(x, 180°)`. So `F0` is `world_from_base · X1 · Rz(home1) · D1`, `Fi` is
/// `Di · Trans(0, 0, di) · X(i+1) · Rz(home(i+1)) · D(i+1)`, and `F6` is `D6 · Trans(0, 0, d6) ·
/// link6_from_flange · flange_from_tool`.
///
/// # Source
/// Thesis, Annex I, regrouped.
#[derive(Clone, Copy, Debug)]
pub struct Chain<S = f64> {
    pub(super) fixed: [Pose<S>; 7],
    /// `Di · Trans(0, 0, di)`: the frame after each row, seen from the frame that its joint turns.
    pub(super) turning_from_link: [Pose<S>; 6],
    pub(super) world_from_base: Pose<S>,
}

/// The links at one posture, without deflections.
#[derive(Clone, Copy, Debug)]
pub struct Frames<S> {
    /// `world_from_link`, the frame after each row of the chain.
    pub links: [Pose<S>; 6],
    /// Moment of gravity and external force about the origin of each link's frame, along the
    /// world's axes, N·m.
    pub moments: [Vector<S>; 6],
    /// `world_from_base`.
    pub base: Pose<S>,
    /// Gravity and external force on the whole arm, along the world's axes, N.
    pub force: Vector<S>,
    /// `world_from_flange`.
    pub flange: Pose<S>,
    /// `world_from_tool`.
    pub tool: Pose<S>,
    /// Moment of the tool's own weight about the flange, along the world's axes, N·m.
    pub tool_moment: Vector<S>,
}

/// What a field of acceleration acts on: the mass on each link and all links farther out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hanging<S = f64> {
    pub(super) mass_kg: [S; 6],
    /// First moment of that mass about the origin of the rotating frame, in that frame, as far as
    /// no joint farther out moves it, kg·m.
    pub(super) fixed_moment: [Vector<S>; 6],
}

/// What hangs on the chain: masses that gravity pulls, and the point where an external force acts.
#[derive(Clone, Copy, Debug)]
pub struct Loads<S = f64> {
    pub(super) masses: Hanging<S>,
    pub(super) gravity_m_s2: Vector<S>,
    /// One kilogram at the controller's tool: a field of so many m/s² pulls it with so many
    /// newton.
    pub(super) unit_mass: Hanging<S>,
    /// Mass of the tool and its centre of gravity in the flange frame.
    tool: Option<(S, Vector<S>)>,
    link6_from_flange: Pose<S>,
}

impl<S: Scalar> Hanging<S> {
    fn of(chain: &Chain<S>, bodies: &[Body<S>]) -> Self {
        let mut mass_kg = [S::zero(); 6];
        let mut fixed_moment = [[S::zero(); 3]; 6];
        for i in (0..6).rev() {
            if i < 5 {
                mass_kg[i] = mass_kg[i + 1];
                fixed_moment[i] = scale(mass_kg[i], chain.fixed[i + 1].translation);
            }
            for body in bodies.iter().filter(|body| body.link == i) {
                let cog = chain.turning_from_link[i].transform(body.cog_m);
                mass_kg[i] += body.mass_kg;
                fixed_moment[i] = add(fixed_moment[i], scale(body.mass_kg, cog));
            }
        }
        Self {
            mass_kg,
            fixed_moment,
        }
    }
}

impl<S: Scalar> Loads<S> {
    /// The masses of a geometry, on its chain.
    pub fn of(geometry: &Geometry<S>, chain: &Chain<S>) -> Self {
        let on_flange = |mass_kg, point| Body {
            link: 5,
            mass_kg,
            cog_m: geometry.link6_from_flange.transform(point),
        };
        let mut bodies = geometry.bodies.clone();
        bodies.extend(geometry.load.map(|(mass_kg, cog)| on_flange(mass_kg, cog)));
        let tool = geometry.flange_from_nominal_tool.translation;
        let unit_mass = on_flange(S::one(), tool.map(S::constant));
        Self {
            masses: Hanging::of(chain, &bodies),
            gravity_m_s2: geometry.gravity_m_s2.map(S::constant),
            unit_mass: Hanging::of(chain, &[unit_mass]),
            tool: geometry.load,
            link6_from_flange: geometry.link6_from_flange,
        }
    }
}

fn crossing<S: Scalar>(link: &Link<S>) -> Pose<S> {
    let turn_x = Rotation::about_x(link.alpha_rad);
    Pose {
        rotation: turn_x * Rotation::about_y(link.beta_rad),
        translation: [link.a_m, S::zero(), S::zero()],
    }
}

impl Chain {
    /// The axes with what stands between them.
    #[must_use]
    pub fn axes(&self) -> Axes {
        let [a, b, c, d, e, f, last] = self.fixed;
        Axes {
            steps: [a, b, c, d, e, f],
            last,
        }
    }

    /// The frame after a row, seen from the frame that its joint turns.
    #[must_use]
    pub fn turning_from_link(&self, row: usize) -> Pose {
        self.turning_from_link[row]
    }
}

impl<S: Scalar> Chain<S> {
    /// Folds a geometry and the controller's way to count its joints into a chain.
    #[must_use]
    pub fn of(geometry: &Geometry<S>, mechanism: &Mechanism) -> Self {
        let links = &geometry.links;
        let turned_over = |i: usize| {
            let (zero, sign) = (S::zero(), S::constant(mechanism.joints[i].sign));
            Rotation([
                [S::one(), zero, zero],
                [zero, sign, zero],
                [zero, zero, sign],
            ])
        };
        let turning_from_link: [Pose<S>; 6] = std::array::from_fn(|i| {
            Pose::from_rotation(turned_over(i))
                * Pose::from_translation(S::zero(), S::zero(), links[i].d_m)
        });
        let link_from_turning = |i: usize| {
            let home = links[i].theta_rad + S::constant(mechanism.joints[i].offset_rad);
            crossing(&links[i]) * Pose::from_rotation(Rotation::about_z(home) * turned_over(i))
        };
        let fixed = std::array::from_fn(|i| match i {
            0 => geometry.world_from_base * link_from_turning(0),
            6 => turning_from_link[5] * geometry.link6_from_flange * geometry.flange_from_tool,
            _ => turning_from_link[i - 1] * link_from_turning(i),
        });
        Self {
            fixed,
            turning_from_link,
            world_from_base: geometry.world_from_base,
        }
    }

    /// `world_from_tool` with these rotations of the mechanical joints.
    #[inline(always)]
    #[must_use]
    pub fn forward(&self, turns: &[AxisRotation<S>; 6]) -> Pose<S> {
        let mut pose = self.fixed[0];
        for i in 0..6 {
            pose = pose.turned(turns[i]) * self.fixed[i + 1];
        }
        pose
    }

    /// `world_from_tool` with rotations of the links, the base and the tool on top of the turns of
    /// the joints.
    #[inline(always)]
    #[must_use]
    pub fn forward_deflected(
        &self,
        turns: &[AxisRotation<S>; 6],
        deflection: &Deflection<S>,
    ) -> Pose<S> {
        let mut pose = Pose::from_xyz_rxryrz(deflection.world) * self.fixed[0];
        for i in 0..6 {
            let [x, y, z] = deflection.links[i];
            let bend = Rotation::about_x(x) * Rotation::about_y(y) * Rotation::about_z(z);
            let turning_from_link = self.turning_from_link[i];
            let bent = turning_from_link
                * Pose::from_rotation(bend)
                * turning_from_link.inverse()
                * self.fixed[i + 1];
            pose = pose.turned(turns[i]) * bent;
        }
        pose * Pose::from_xyz_rxryrz(deflection.tool)
    }

    /// `world_from_link`, the frame after each row, with rotations of the links and the base where
    /// there are any.
    #[must_use]
    pub fn links(
        &self,
        turns: &[AxisRotation<S>; 6],
        deflection: Option<&Deflection<S>>,
    ) -> [Pose<S>; 6] {
        let mut pose = self.fixed[0];
        if let Some(deflection) = deflection {
            pose = Pose::from_xyz_rxryrz(deflection.world) * pose;
        }
        let mut links = [pose; 6];
        for i in 0..6 {
            let turning = pose.turned(turns[i]);
            links[i] = turning * self.turning_from_link[i];
            let Some(deflection) = deflection else {
                pose = turning * self.fixed[i + 1];
                continue;
            };
            let [x, y, z] = deflection.links[i];
            let bend = Rotation::about_x(x) * Rotation::about_y(y) * Rotation::about_z(z);
            links[i] = links[i] * Pose::from_rotation(bend);
            pose = links[i] * self.turning_from_link[i].inverse() * self.fixed[i + 1];
        }
        links
    }

    /// Lengths of the way from the origin of each link's frame to the next, the base's first,
    /// metres.
    #[must_use]
    pub fn reaches(&self, world_from_base: &Pose<S>) -> [S; 6] {
        let zero = [AxisRotation::none(); 6];
        let links = self.links(&zero, None);
        std::array::from_fn(|i| {
            let before = if i == 0 {
                world_from_base.translation
            } else {
                links[i - 1].translation
            };
            norm(sub(links[i].translation, before))
        })
    }

    /// `world_from_link`: the frame after each row of the chain.
    #[must_use]
    pub fn link_frames(&self, turns: &[AxisRotation<S>; 6]) -> [Pose<S>; 6] {
        let mut pose = self.fixed[0];
        std::array::from_fn(|i| {
            let turning = pose.turned(turns[i]);
            pose = turning * self.fixed[i + 1];
            turning * self.turning_from_link[i]
        })
    }

    /// Torque of gravity and an external force about each joint in the controller's sense, N·m.
    ///
    /// The field is carried outward and the first moment inward, from frame to frame; no pose is
    /// needed. The torque about a joint is the z component of `first moment × field` in the
    /// frame that it turns.
    ///
    /// # Source
    /// Thesis, eqs. I.5–I.10, by the recursion of J. Luh, M. Walker, R. Paul, "On-line
    /// computational scheme for mechanical manipulators" (1980).
    #[inline(always)]
    #[must_use]
    pub fn torques(
        &self,
        turns: &[AxisRotation<S>; 6],
        loads: &Loads<S>,
        force_n: Vector,
    ) -> [S; 6] {
        let mut torques = [S::zero(); 6];
        self.pull(
            turns,
            &loads.masses,
            loads.gravity_m_s2,
            |i, moment, field| {
                torques[i] = moment[0] * field[1] - moment[1] * field[0];
            },
        );
        if force_n != [0.0; 3] {
            let force = force_n.map(S::constant);
            self.pull(turns, &loads.unit_mass, force, |i, moment, field| {
                torques[i] += moment[0] * field[1] - moment[1] * field[0];
            });
        }
        torques
    }

    /// The links' frames and the moments that gravity and a force at the tool exert about their
    /// origins.
    #[must_use]
    pub fn frames(
        &self,
        turns: &[AxisRotation<S>; 6],
        loads: &Loads<S>,
        force_n: Vector,
    ) -> Frames<S> {
        let mut pose = self.fixed[0];
        let mut turning = [pose; 6];
        for i in 0..6 {
            turning[i] = pose.turned(turns[i]);
            pose = turning[i] * self.fixed[i + 1];
        }
        let mut moments = [[S::zero(); 3]; 6];
        let mut force = force_n.map(S::constant);
        force = add(force, scale(loads.masses.mass_kg[0], loads.gravity_m_s2));
        for (hanging, field) in [
            (&loads.masses, loads.gravity_m_s2),
            (&loads.unit_mass, force_n.map(S::constant)),
        ] {
            self.pull(turns, hanging, field, |i, moment, field| {
                let origin = self.turning_from_link[i].translation;
                let about_link = sub(moment, scale(hanging.mass_kg[i], origin));
                let moment = turning[i].rotation * cross(about_link, field);
                moments[i] = add(moments[i], moment);
            });
        }
        let links: [Pose<S>; 6] = std::array::from_fn(|i| turning[i] * self.turning_from_link[i]);
        let flange = links[5] * loads.link6_from_flange;
        let tool_moment = loads.tool.map_or([S::zero(); 3], |(mass_kg, cog)| {
            cross(flange.rotation * cog, scale(mass_kg, loads.gravity_m_s2))
        });
        Frames {
            links,
            moments,
            base: self.world_from_base,
            force,
            flange,
            tool: pose,
            tool_moment,
        }
    }

    /// Calls `each` with the index of a joint, the first moment of all that hangs on it and the
    /// field, both in the frame that it turns, from the last joint to the first.
    #[inline(always)]
    pub(super) fn pull(
        &self,
        turns: &[AxisRotation<S>; 6],
        hanging: &Hanging<S>,
        field_in_world: Vector<S>,
        mut each: impl FnMut(usize, Vector<S>, Vector<S>),
    ) {
        let mut field = field_in_world;
        let mut fields = [field; 6];
        for i in 0..6 {
            let [x, y, z] = self.fixed[i].rotation.transpose() * field;
            let AxisRotation { sine, cosine } = turns[i];
            field = [cosine * x + sine * y, cosine * y - sine * x, z];
            fields[i] = field;
        }
        let mut moment = [S::zero(); 3];
        for i in (0..6).rev() {
            moment = add(hanging.fixed_moment[i], moment);
            each(i, moment, fields[i]);
            let AxisRotation { sine, cosine } = turns[i];
            let [x, y, z] = moment;
            moment = self.fixed[i].rotation * [cosine * x - sine * y, sine * x + cosine * y, z];
        }
    }
}

impl Frames<f64> {
    /// The same frames as constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Frames<S> {
        Frames {
            links: self.links.map(|link| link.cast()),
            moments: self.moments.map(|moment| moment.map(S::constant)),
            base: self.base.cast(),
            force: self.force.map(S::constant),
            flange: self.flange.cast(),
            tool: self.tool.cast(),
            tool_moment: self.tool_moment.map(S::constant),
        }
    }
}

impl Chain {
    /// The same chain as constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Chain<S> {
        Chain {
            fixed: self.fixed.map(|p| p.cast()),
            turning_from_link: self.turning_from_link.map(|p| p.cast()),
            world_from_base: self.world_from_base.cast(),
        }
    }
}

impl Hanging {
    fn cast<S: Scalar>(&self) -> Hanging<S> {
        Hanging {
            mass_kg: self.mass_kg.map(S::constant),
            fixed_moment: self.fixed_moment.map(|v| v.map(S::constant)),
        }
    }
}

impl Loads {
    /// The same loads as constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Loads<S> {
        Loads {
            masses: self.masses.cast(),
            gravity_m_s2: self.gravity_m_s2.map(S::constant),
            unit_mass: self.unit_mass.cast(),
            tool: self
                .tool
                .map(|(mass_kg, cog)| (S::constant(mass_kg), cog.map(S::constant))),
            link6_from_flange: self.link6_from_flange.cast(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dot;
    use crate::model::example;

    /// Rounding of moments of some hundred newton metres.
    const TOLERANCE_N_M: f64 = 1e-11;

    #[test]
    fn torques_and_moments_are_those_of_every_mass_about_every_origin() {
        let (mut geometry, mechanism) = (example::geometry(), example::mechanism());
        // hangs from a ceiling that is not level
        geometry.world_from_base = Pose::from_xyz_rxryrz([1.2345, -0.321, 2.5, 3.1, 0.05, -0.4]);
        let chain = Chain::of(&geometry, &mechanism);
        let loads = Loads::of(&geometry, &chain);
        let force = [30.0, -20.0, 50.0];
        for k in 0..100_i32 {
            let q = std::array::from_fn(|i| (f64::from(k) * (0.7 + i as f64)).sin() * 3.0);
            let turns = AxisRotation::of_each(&mechanism.commanded(&q));
            let torques = chain.torques(&turns, &loads, force);
            let frames = chain.frames(&turns, &loads, force);
            let last = frames.links[5] * geometry.link6_from_flange;
            let mut pulls: Vec<(usize, Vector, Vector)> = vec![(
                5,
                last.transform(geometry.flange_from_nominal_tool.translation),
                force,
            )];
            for body in &geometry.bodies {
                let point = frames.links[body.link].transform(body.cog_m);
                pulls.push((body.link, point, scale(body.mass_kg, geometry.gravity_m_s2)));
            }
            if let Some((mass, cog)) = geometry.load {
                pulls.push((5, last.transform(cog), scale(mass, geometry.gravity_m_s2)));
            }
            for (i, link) in frames.links.iter().enumerate() {
                let mut moment = [0.0; 3];
                for (_, point, pull) in pulls.iter().filter(|pull| pull.0 >= i) {
                    moment = add(moment, cross(sub(*point, link.translation), *pull));
                }
                let torque = mechanism.joints[i].sign * dot(moment, link.rotation.axis(2));
                assert!((torques[i] - torque).abs() < TOLERANCE_N_M, "joint {i}");
                for (a, b) in moment.iter().zip(frames.moments[i]) {
                    assert!((a - b).abs() < TOLERANCE_N_M, "link {i}");
                }
            }
        }
    }
}
