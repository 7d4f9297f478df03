//! The chain of six links, with everything that does not move folded into constants.

use super::effects::Deflection;
use super::geometry::{Body, Geometry, Link};
use crate::geometry::{Pose, Rotation, Scalar, Vector, add, cross, scale, sub};

/// Six revolute joints between seven fixed transforms: `world_from_tool = F0 · Rz(c1) · F1 · Rz(c2) · … · Rz(c6) · F6`.
///
/// `F0` is `world_from_base · X1`, `Fi` is `Trans(0, 0, di) · X(i+1)` and `F6` is `Trans(0, 0, d6) · link6_from_flange ·
/// flange_from_tool`, where `Xi = Rot(x, αi) · Trans(ai, 0, 0) · Rot(y, βi)`.
///
/// # Source
/// Thesis, Annex I, regrouped.
#[derive(Clone, Copy, Debug)]
pub struct Chain<S = f64> {
    fixed: [Pose<S>; 7],
    d_m: [S; 6],
}

/// The links at one posture, without deflections.
#[derive(Clone, Copy, Debug)]
pub struct Frames<S> {
    /// `world_from_link`, the frame after each row of the chain.
    pub links: [Pose<S>; 6],
    /// Moment of gravity and external force about the origin of each link's frame, along the world's axes, N·m.
    pub moments: [Vector<S>; 6],
}

impl<S: Scalar> Frames<S> {
    /// Moment about each joint's axis in the sense of the chain, N·m.
    #[inline(always)]
    #[must_use]
    pub fn torque(&self, joint: usize) -> S {
        crate::geometry::dot(self.moments[joint], self.links[joint].rotation.axis(2))
    }
}

/// What hangs on the chain, as gravity sees it.
#[derive(Clone, Debug)]
pub struct Loads<S = f64> {
    /// Bodies from the last link to the first, the tool's mass among the last link's; centres of gravity in link frames.
    bodies: Vec<Body<S>>,
    /// Where an external force acts, in the last link's frame, metres.
    force_point: Vector<S>,
    gravity_m_s2: Vector<S>,
}

impl<S: Scalar> Loads<S> {
    /// The masses of a geometry.
    pub fn of(geometry: &Geometry<S>) -> Self {
        let flange = geometry.link6_from_flange;
        let mut bodies = geometry.bodies.clone();
        bodies.extend(geometry.load.map(|(mass_kg, cog)| Body {
            link: 5,
            mass_kg,
            cog_m: flange.transform(cog),
        }));
        bodies.sort_by_key(|body| std::cmp::Reverse(body.link));
        Self {
            bodies,
            force_point: flange.transform(
                geometry
                    .flange_from_nominal_tool
                    .translation
                    .map(S::constant),
            ),
            gravity_m_s2: geometry.gravity_m_s2.map(S::constant),
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

impl<S: Scalar> Chain<S> {
    /// Folds a geometry into a chain; the angles of [`Chain::forward`] then include the rows' θ.
    #[must_use]
    pub fn of(geometry: &Geometry<S>) -> Self {
        let along_z = |d: S| Pose::from_translation(S::zero(), S::zero(), d);
        let links = &geometry.links;
        let fixed = std::array::from_fn(|i| match i {
            0 => geometry.world_from_base * crossing(&links[0]),
            6 => along_z(links[5].d_m) * geometry.link6_from_flange * geometry.flange_from_tool,
            _ => along_z(links[i - 1].d_m) * crossing(&links[i]),
        });
        Self {
            fixed,
            d_m: links.map(|l| l.d_m),
        }
    }

    /// `world_from_tool` at these chain angles, radians.
    #[inline(always)]
    #[must_use]
    pub fn forward(&self, angles: &[S; 6]) -> Pose<S> {
        let mut pose = self.fixed[0];
        for i in 0..6 {
            pose = turned(pose, angles[i]) * self.fixed[i + 1];
        }
        pose
    }

    /// `world_from_tool` with rotations of the links, the base and the tool on top of the joint angles.
    #[inline(always)]
    #[must_use]
    pub fn forward_deflected(&self, angles: &[S; 6], deflection: &Deflection<S>) -> Pose<S> {
        let mut pose = Pose::from_xyz_rxryrz(deflection.world) * self.fixed[0];
        for i in 0..6 {
            let [x, y, z] = deflection.links[i];
            let bend = Rotation::about_x(x) * Rotation::about_y(y) * Rotation::about_z(z);
            pose = turned(pose, angles[i]);
            // the bend turns about the link's origin, which lies d along z
            let along = [S::zero(), S::zero(), self.d_m[i]];
            let about = Pose {
                rotation: bend,
                translation: sub(along, bend * along),
            };
            pose = pose * about * self.fixed[i + 1];
        }
        pose * Pose::from_xyz_rxryrz(deflection.tool)
    }

    /// The links' frames and the moments that gravity and a force at the tool exert about their origins.
    ///
    /// # Source
    /// Thesis, eqs. I.5–I.10.
    #[inline(always)]
    #[must_use]
    pub fn frames(&self, angles: &[S; 6], loads: &Loads<S>, force_n: Vector) -> Frames<S> {
        let mut links = [self.fixed[0]; 6];
        let mut pose = self.fixed[0];
        for i in 0..6 {
            pose = turned(pose, angles[i]);
            links[i] = Pose {
                rotation: pose.rotation,
                translation: add(pose.translation, scale(self.d_m[i], pose.rotation.axis(2))),
            };
            if i < 5 {
                pose = pose * self.fixed[i + 1];
            }
        }
        let mut moments = [[S::zero(); 3]; 6];
        let mut mass = S::zero();
        let mut first_moment = [S::zero(); 3];
        let mut bodies = loads.bodies.iter().peekable();
        for i in (0..6).rev() {
            while let Some(body) = bodies.next_if(|b| b.link == i) {
                mass += body.mass_kg;
                first_moment = add(
                    first_moment,
                    scale(body.mass_kg, links[i].transform(body.cog_m)),
                );
            }
            let lever = sub(first_moment, scale(mass, links[i].translation));
            moments[i] = cross(lever, loads.gravity_m_s2);
        }
        if force_n != [0.0; 3] {
            let point = links[5].transform(loads.force_point);
            for i in 0..6 {
                let moment = cross(sub(point, links[i].translation), force_n.map(S::constant));
                moments[i] = add(moments[i], moment);
            }
        }
        Frames { links, moments }
    }
}

/// `pose · Rot(z, angle)`: only two columns change.
#[inline(always)]
fn turned<S: Scalar>(pose: Pose<S>, angle: S) -> Pose<S> {
    let (s, c) = angle.sin_cos();
    let m = &pose.rotation.0;
    let rotation = Rotation(std::array::from_fn(|i| {
        [
            c * m[i][0] + s * m[i][1],
            c * m[i][1] - s * m[i][0],
            m[i][2],
        ]
    }));
    Pose {
        rotation,
        translation: pose.translation,
    }
}

impl Chain {
    /// The same chain as constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Chain<S> {
        Chain {
            fixed: self.fixed.map(|p| p.cast()),
            d_m: self.d_m.map(S::constant),
        }
    }
}

impl Loads {
    /// The same loads as constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Loads<S> {
        Loads {
            bodies: self
                .bodies
                .iter()
                .map(|b| Body {
                    link: b.link,
                    mass_kg: S::constant(b.mass_kg),
                    cog_m: b.cog_m.map(S::constant),
                })
                .collect(),
            force_point: self.force_point.map(S::constant),
            gravity_m_s2: self.gravity_m_s2.map(S::constant),
        }
    }
}
