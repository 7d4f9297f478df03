//! The lengths, angles and masses that make an arm.

use super::conditions::Conditions;
use super::effects::Effect;
use super::external::Carried;
use crate::geometry::{Pose, Rotation, Scalar, Vector};
use std::f64::consts::{PI, TAU};

/// One row of modified Denavit–Hartenberg parameters with Hayati's angle β:
/// `A = Rot(x, α) · Trans(a, 0, 0) · Rot(y, β) · Rot(z, θ + joint) · Trans(0, 0, d)`, metres and
/// radians.
///
/// # Source
/// J. J. Craig, "Introduction to Robotics"; S. Hayati and M. Mirmirani, "Improving the absolute
/// positioning accuracy of robot manipulators", J. Robotic Systems 2 (1985): β keeps the
/// description continuous where axes are nearly parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<S = f64> {
    /// Angle between the axes, about x.
    pub alpha_rad: S,
    /// Distance of the axes, along x.
    pub a_m: S,
    /// Angle between nearly parallel axes, about y; nominally zero.
    pub beta_rad: S,
    /// Angle about z where the joint stands at zero.
    pub theta_rad: S,
    /// Distance along z.
    pub d_m: S,
}

/// A rigid mass on a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body<S = f64> {
    /// Index of the link that carries it, 0 to 5.
    pub link: usize,
    /// Mass, kg.
    pub mass_kg: S,
    /// Centre of gravity in the link's frame, metres.
    pub cog_m: Vector<S>,
}

/// How a controller's joint angle rotates the chain: `chain angle = sign · (q + Σ ratio · q_on) +
/// offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSense {
    /// +1 or −1.
    pub sign: f64,
    /// Chain angle where the controller shows zero, radians.
    pub offset_rad: f64,
    /// Smallest controller's angle, radians.
    pub min_rad: f64,
    /// Largest controller's angle, radians.
    pub max_rad: f64,
}

/// Writes a chain whose base stands upside down, since axis 1 of its file rotates about a line that
/// points down, with z up and a first joint that rotates against it: the base is where the robot
/// stands, then, and not how its file has axis 1. Whether it was one.
pub fn set_upright(base: &mut Pose, links: &mut [Link; 6], first: &mut JointSense) -> bool {
    const DOWN: f64 = -1.0 + 1e-9;
    let Link {
        alpha_rad,
        a_m,
        beta_rad,
        ..
    } = links[0];
    if base.rotation.axis(2)[2] > DOWN || [alpha_rad, a_m, beta_rad] != [0.0; 3] {
        return false;
    }
    *base = *base * UPSIDE_DOWN;
    // rounding of half a rotation
    for row in &mut base.rotation.0 {
        for entry in row {
            if (*entry - entry.round()).abs() < 1e-15 {
                *entry = entry.round() + 0.0;
            }
        }
    }
    // Rx(180°) · Rz(θ) · Trans(0, 0, d) = Rz(−θ) · Trans(0, 0, −d) · Rx(180°)
    (links[0].theta_rad, links[0].d_m) = (0.0 - links[0].theta_rad, 0.0 - links[0].d_m);
    (first.sign, first.offset_rad) = (-first.sign, 0.0 - first.offset_rad);
    let turned = links[1].alpha_rad - PI;
    links[1].alpha_rad = if turned <= -PI { turned + TAU } else { turned };
    true
}

/// Half a rotation about x: what stands before and behind a row that is written the other way up.
pub const UPSIDE_DOWN: Pose = Pose {
    rotation: Rotation([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]),
    translation: [0.0; 3],
};

/// A controller's joint that counts another joint's angle in (FANUC: J3 on J2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// Index of the joint, 0 to 5.
    pub joint: usize,
    /// Index of the joint whose angle is counted in.
    pub on: usize,
    /// How much of it.
    pub ratio: f64,
}

/// The part of an arm that no error changes: how the controller counts angles.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// Sense, zero and limits of each joint.
    pub joints: [JointSense; 6],
    /// Couplings between joints; each refers to a joint whose own couplings stand before it.
    pub coupling: Vec<Coupling>,
}

impl Mechanism {
    /// The commanded angle of each mechanical joint in the controller's sense: `u = q + Σ ratio ·
    /// q_on`, radians.
    #[inline(always)]
    #[must_use]
    pub fn commanded<S: Scalar>(&self, q: &[S; 6]) -> [S; 6] {
        let mut u = *q;
        for c in &self.coupling {
            u[c.joint] += S::constant(c.ratio) * q[c.on];
        }
        u
    }

    /// Counts a joint together with another one from now on. Whether the joint's limits are those
    /// of the controller's own angle or of the chain's is not known where they come from a file
    /// without couplings: they are widened to hold both.
    pub fn couple(&mut self, coupling: Coupling) {
        let on = &self.joints[coupling.on];
        let by = [coupling.ratio * on.min_rad, coupling.ratio * on.max_rad];
        let joint = &mut self.joints[coupling.joint];
        joint.min_rad -= by[0].max(by[1]).max(0.0);
        joint.max_rad -= by[0].min(by[1]).min(0.0);
        self.coupling.push(coupling);
    }

    /// The controller's joint angles of these mechanical ones: the inverse of
    /// [`Mechanism::commanded`].
    #[inline(always)]
    #[must_use]
    pub fn controller<S: Scalar>(&self, u: &[S; 6]) -> [S; 6] {
        let mut q = *u;
        for c in &self.coupling {
            // the order of the couplings makes q[c.on] final here
            q[c.joint] -= S::constant(c.ratio) * q[c.on];
        }
        q
    }

    /// The controller's joint angles, moved by whole revolutions of mechanical joints so that each
    /// is as near as can be to `near`.
    #[must_use]
    pub fn nearest_turns(&self, q: &[f64; 6], near: &[f64; 6]) -> [f64; 6] {
        let (mut u, near) = (self.commanded(q), self.commanded(near));
        for i in 0..6 {
            u[i] += TAU * ((near[i] - u[i]) / TAU).round();
        }
        self.controller(&u)
    }

    /// The first joint outside its limits by more than `tolerance_rad`, with its angle.
    #[must_use]
    pub fn beyond_limit(&self, q: &[f64; 6], tolerance_rad: f64) -> Option<usize> {
        (0..6).find(|&i| {
            let joint = &self.joints[i];
            q[i] < joint.min_rad - tolerance_rad || q[i] > joint.max_rad + tolerance_rad
        })
    }
}

/// Everything about an arm, its tool and its place that an effect may change.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry<S = f64> {
    /// Where the base stands.
    pub world_from_base: Pose<S>,
    /// The rows of the chain.
    pub links: [Link<S>; 6],
    /// The flange on the last link.
    pub link6_from_flange: Pose<S>,
    /// The tool on the flange.
    pub flange_from_tool: Pose<S>,
    /// The tool as the controller knows it: an external force acts at its origin.
    pub flange_from_nominal_tool: Pose,
    /// Masses of the arm.
    pub bodies: Vec<Body<S>>,
    /// The mass on the flange; the centre of gravity in the flange frame, metres.
    pub load: Option<(S, Vector<S>)>,
    /// Gravity in the world, m/s².
    pub gravity_m_s2: Vector,
    /// Name of the tool, for effects that belong to one tool.
    pub tool_name: String,
    /// What carries the base away from where it stands at home, and how far.
    pub carried: Option<Carried>,
}

impl Geometry {
    /// The same geometry as constants of another scalar.
    #[must_use]
    pub fn cast<S: Scalar>(&self) -> Geometry<S> {
        Geometry {
            world_from_base: self.world_from_base.cast(),
            links: self.links.map(|l| Link {
                alpha_rad: S::constant(l.alpha_rad),
                a_m: S::constant(l.a_m),
                beta_rad: S::constant(l.beta_rad),
                theta_rad: S::constant(l.theta_rad),
                d_m: S::constant(l.d_m),
            }),
            link6_from_flange: self.link6_from_flange.cast(),
            flange_from_tool: self.flange_from_tool.cast(),
            flange_from_nominal_tool: self.flange_from_nominal_tool,
            bodies: self
                .bodies
                .iter()
                .map(|b| Body {
                    link: b.link,
                    mass_kg: S::constant(b.mass_kg),
                    cog_m: b.cog_m.map(S::constant),
                })
                .collect(),
            load: self
                .load
                .map(|(mass, cog)| (S::constant(mass), cog.map(S::constant))),
            gravity_m_s2: self.gravity_m_s2,
            tool_name: self.tool_name.clone(),
            carried: self.carried.clone(),
        }
    }

    /// What the effects make of it, with the base where it is carried to.
    #[must_use]
    pub fn real<S: Scalar>(&self, effects: &[Effect<S>], conditions: &Conditions) -> Geometry<S> {
        let mut real: Geometry<S> = self.cast();
        for effect in effects {
            effect.change_geometry(conditions, &mut real);
        }
        if let Some(carried) = &self.carried {
            real.world_from_base = carried.carry(real.world_from_base, effects);
        }
        real
    }
}
