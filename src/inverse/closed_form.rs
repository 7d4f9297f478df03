//! The nominal inverse in closed form, from the numbers of the chain.
//!
//! Both kinds of arm share the shoulder (axis 1 turns the arm's plane) and the planar pair of links; they differ in the
//! wrist. Every step is written over [`Scalar`] without branches, so that several targets are solved side by side.

use super::branch::Branch;
use crate::geometry::{Pose, Rotation, Scalar, Vector, add};
use crate::model::{Geometry, Link, Mechanism};

/// How far an angle or length of the chain may be from what the closed form needs, radians or metres.
const TOLERANCE: f64 = 1e-9;
/// Below this sine of joint 5 the angles of the two joints beside it cannot be told apart in 64-bit numbers.
const WRIST_SINE: f64 = 1e-12;

/// Which condition of the closed forms an arm does not meet.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Unsupported {
    /// An angle between axes.
    #[error(
        "no closed-form inverse: alpha of row {row} is {found_deg} deg; both kinds of arm need {needed}"
    )]
    Alpha {
        /// Row, from 1.
        row: usize,
        /// Its α.
        found_deg: f64,
        /// What would do.
        needed: &'static str,
    },
    /// Neither a spherical wrist nor three parallel axes.
    #[error(
        "no closed-form inverse: alpha of row 4 is {alpha_4_deg} deg, so axes 2, 3 and 4 are not parallel; and the wrist is \
         not spherical: {key} of row {row} is {found_mm} mm where 0 is needed"
    )]
    Wrist {
        /// α of row 4.
        alpha_4_deg: f64,
        /// `a` or `d`.
        key: &'static str,
        /// Row, from 1.
        row: usize,
        /// The length that is in the way.
        found_mm: f64,
    },
    /// An offset that three parallel axes do not allow.
    #[error(
        "no closed-form inverse: axes 2, 3 and 4 are parallel, and a of row {row} is {found_mm} mm where 0 is needed"
    )]
    ParallelOffset {
        /// Row, from 1.
        row: usize,
        /// The length that is in the way.
        found_mm: f64,
    },
    /// A link without length.
    #[error("no closed-form inverse: {link} has no length")]
    NoLength {
        /// Which link.
        link: &'static str,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wrist {
    /// Axes 4, 5 and 6 meet in one point.
    Spherical,
    /// Axes 2, 3 and 4 are parallel.
    Parallel,
}

/// An arm whose inverse has a closed form: (a) ortho-parallel base and spherical wrist, with shoulder, lateral and elbow
/// offsets; (b) three parallel axes.
///
/// # Source
/// Derived here from the rows of the chain. The conditions are those of M. Brandstötter, A. Angerer, M. Hofbaur, "An
/// analytical solution of the inverse kinematics problem of industrial serial manipulators with an ortho-parallel basis and
/// a spherical wrist" (2014), with the lateral offsets of every row.
#[derive(Clone, Debug)]
pub struct Arm {
    wrist: Wrist,
    mechanism: Mechanism,
    /// θ of each row plus the controller's offset.
    home: [f64; 6],
    sign: [f64; 6],
    /// From the world to the frame that axis 1 turns, and from the tool to the last row's frame without its d.
    turning_from_world: Pose,
    tool_from_link6: Pose,
    /// Sines of α2, α5, α6 and cosines of α3, α4: +1 or −1 (α4 is free on a spherical wrist).
    e2: f64,
    e5: f64,
    e6: f64,
    s3: f64,
    s4: f64,
    link4_from_wrist: Rotation,
    /// Distance of the arm's plane from axis 1, along y of the frame that axis 1 turned.
    lateral_m: f64,
    a2_m: f64,
    a3_m: f64,
    /// The forearm in frame 3: its length and its direction.
    forearm_m: f64,
    forearm_rad: f64,
    a5_m: f64,
    d5_m: f64,
    /// Sign that turns "in front of the lower arm" into the sine of the elbow.
    elbow_sign: f64,
    /// Sign that turns the controller's joint 5 into the sine of the chain's.
    wrist_sign: f64,
}

/// A solution on one branch.
#[derive(Clone, Copy, Debug)]
pub struct Solution<S = f64> {
    /// The controller's joint angles, radians.
    pub q: [S; 6],
    /// Zero where the pose is in reach; else how far it is beyond (squared cosine or relative lengths, not metres).
    pub beyond: S,
}

/// How near a posture is to the three singularities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// Angle of joint 5 from alignment of axes 4 and 6, radians, in [0, π/2].
    pub wrist_rad: f64,
    /// Angle of the elbow from stretched or folded, radians, in [0, π/2].
    pub elbow_rad: f64,
    /// Distance of the wrist centre from the plane where the shoulder turns freely, metres.
    pub shoulder_m: f64,
}

fn near(angle: f64, wanted: f64) -> bool {
    let turn = std::f64::consts::TAU;
    let gap = (angle - wanted).rem_euclid(turn);
    gap.min(turn - gap) < TOLERANCE
}

fn right_angle(row: usize, link: &Link) -> Result<f64, Unsupported> {
    let quarter = std::f64::consts::FRAC_PI_2;
    if near(link.alpha_rad, quarter) {
        Ok(1.0)
    } else if near(link.alpha_rad, -quarter) {
        Ok(-1.0)
    } else {
        Err(Unsupported::Alpha {
            row,
            found_deg: link.alpha_rad.to_degrees(),
            needed: "90 or -90",
        })
    }
}

fn straight_angle(link: &Link) -> Option<f64> {
    if near(link.alpha_rad, 0.0) {
        Some(1.0)
    } else if near(link.alpha_rad, std::f64::consts::PI) {
        Some(-1.0)
    } else {
        None
    }
}

impl Arm {
    /// Recognises the kind of arm.
    ///
    /// # Errors
    /// The first condition that fails.
    pub fn of(geometry: &Geometry, mechanism: &Mechanism) -> Result<Self, Unsupported> {
        let l = &geometry.links;
        let e2 = right_angle(2, &l[1])?;
        let s3 = straight_angle(&l[2]).ok_or(Unsupported::Alpha {
            row: 3,
            found_deg: l[2].alpha_rad.to_degrees(),
            needed: "0 or 180",
        })?;
        let e5 = right_angle(5, &l[4])?;
        let e6 = right_angle(6, &l[5])?;
        let (sine_4, cosine_4) = l[3].alpha_rad.sin_cos();
        let parallel = straight_angle(&l[3]);
        let offsets = [("a", 5, l[4].a_m), ("d", 5, l[4].d_m), ("a", 6, l[5].a_m)];
        let in_the_way = offsets
            .iter()
            .find(|(_, _, length)| length.abs() > TOLERANCE);
        let (wrist, forearm, lateral) = match (in_the_way, parallel) {
            (None, _) => {
                let forearm = [l[3].a_m, -sine_4 * l[3].d_m];
                (
                    Wrist::Spherical,
                    forearm,
                    l[1].d_m + s3 * (l[2].d_m + cosine_4 * l[3].d_m),
                )
            }
            (Some(_), Some(s4)) => {
                if l[5].a_m.abs() > TOLERANCE {
                    return Err(Unsupported::ParallelOffset {
                        row: 6,
                        found_mm: 1e3 * l[5].a_m,
                    });
                }
                (
                    Wrist::Parallel,
                    [l[3].a_m, 0.0],
                    l[1].d_m + s3 * (l[2].d_m + s4 * l[3].d_m),
                )
            }
            (Some(&(key, row, length)), None) => {
                let alpha_4_deg = l[3].alpha_rad.to_degrees();
                return Err(Unsupported::Wrist {
                    alpha_4_deg,
                    key,
                    row,
                    found_mm: 1e3 * length,
                });
            }
        };
        let forearm_m = forearm[0].hypot(forearm[1]);
        for (link, length) in [
            ("the upper arm (a of row 3)", l[2].a_m),
            ("the forearm (a and d of row 4)", forearm_m),
        ] {
            if length.abs() < TOLERANCE {
                return Err(Unsupported::NoLength { link });
            }
        }
        let home: [f64; 6] =
            std::array::from_fn(|i| l[i].theta_rad + mechanism.joints[i].offset_rad);
        let sign = std::array::from_fn(|i| mechanism.joints[i].sign);
        let base_from_turning = Pose {
            rotation: Rotation::about_x(l[0].alpha_rad),
            translation: Rotation::about_x(l[0].alpha_rad) * [0.0, 0.0, l[0].d_m],
        };
        let base_from_turning = Pose::from_translation(l[0].a_m, 0.0, 0.0) * base_from_turning;
        let link6_from_tool = geometry.link6_from_flange * geometry.flange_from_tool;
        let back = Pose::from_translation(0.0, 0.0, -l[5].d_m);
        Ok(Self {
            wrist,
            mechanism: mechanism.clone(),
            home,
            sign,
            turning_from_world: (geometry.world_from_base * base_from_turning).inverse(),
            tool_from_link6: link6_from_tool.inverse() * back,
            e2,
            e5,
            e6,
            s3,
            s4: parallel.unwrap_or(0.0),
            link4_from_wrist: Rotation::about_x(-l[3].alpha_rad),
            lateral_m: -e2 * lateral,
            a2_m: l[1].a_m,
            a3_m: l[2].a_m,
            forearm_m,
            forearm_rad: forearm[1].atan2(forearm[0]),
            a5_m: l[4].a_m,
            d5_m: l[4].d_m,
            elbow_sign: -e2 * s3 * l[2].a_m.signum(),
            wrist_sign: sign[4]
                * if home[4].cos() < -TOLERANCE {
                    -1.0
                } else {
                    1.0
                },
        })
    }

    /// A name for the kind of arm.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self.wrist {
            Wrist::Spherical => "spherical wrist",
            Wrist::Parallel => "three parallel axes",
        }
    }

    /// How the controller counts the joints of this arm.
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// The joint angles on one branch that bring the nominal tool to `world_from_tool`, by whole turns nearest to `near`.
    ///
    /// Where the pose is out of reach the nearest posture of the stretched or folded arm is returned, and
    /// [`Solution::beyond`] is positive. Where joint 5 aligns axes 4 and 6, joint 4 (on arms with three parallel axes joint
    /// 6) is that of `near`.
    #[inline(always)]
    #[must_use]
    pub fn solve<S: Scalar>(
        &self,
        world_from_tool: &Pose<S>,
        signs: [S; 3],
        near: &[S; 6],
    ) -> Solution<S> {
        // the frame of the last row without its d, seen from the frame that axis 1 turns
        let target =
            self.turning_from_world.cast() * *world_from_tool * self.tool_from_link6.cast();
        let near = self.mechanism.commanded(near);
        let (angles, beyond) = match self.wrist {
            Wrist::Spherical => self.solve_spherical(&target, signs, &near),
            Wrist::Parallel => self.solve_parallel(&target, signs, &near),
        };
        let turn = S::constant(std::f64::consts::TAU);
        let per_turn = S::constant(std::f64::consts::TAU.recip());
        let u = std::array::from_fn(|i| {
            let u = S::constant(self.sign[i]) * (angles[i] - S::constant(self.home[i]));
            u + turn * ((near[i] - u) * per_turn).round()
        });
        Solution {
            q: self.mechanism.controller(&u),
            beyond,
        }
    }

    /// The solution on one branch for plain numbers.
    #[must_use]
    pub fn solve_branch(
        &self,
        world_from_tool: &Pose,
        branch: Branch,
        near: &[f64; 6],
    ) -> Solution {
        self.solve(world_from_tool, branch.signs(), near)
    }

    /// Sine and cosine of joint 1 and the distance of the wrist centre from axis 1 within the arm's plane.
    #[inline(always)]
    fn shoulder<S: Scalar>(&self, p: Vector<S>, front: S) -> ([S; 2], S, S) {
        let b = S::constant(self.lateral_m);
        let squared = p[0] * p[0] + p[1] * p[1];
        let beyond = (b * b - squared).max(S::zero());
        let r = front * (squared - b * b).max(S::zero()).sqrt();
        let scale = S::one() / (r * r + b * b).max(squared).max(S::constant(1e-300));
        let sine = (r * p[1] - b * p[0]) * scale;
        let cosine = (r * p[0] + b * p[1]) * scale;
        ([sine, cosine], r, beyond)
    }

    /// Sines and cosines of joints 2 and 3 that bring the end of the forearm to (u, v) in the arm's plane.
    #[inline(always)]
    fn planar<S: Scalar>(&self, u: S, v: S, before: S) -> ([S; 2], [S; 2], S) {
        let (upper, fore) = (S::constant(self.a3_m), S::constant(self.forearm_m));
        let squared = u * u + v * v;
        let inverse = S::constant((2.0 * self.a3_m * self.forearm_m).recip());
        let raw = (squared - upper * upper - fore * fore) * inverse;
        let (one, low) = (S::one(), -S::one());
        let cosine = raw.max(low).min(one);
        let beyond = (raw.abs() - one).max(S::zero());
        let sine =
            before * S::constant(self.elbow_sign) * (one - cosine * cosine).max(S::zero()).sqrt();
        let along = upper + fore * cosine;
        let across = S::constant(self.s3) * fore * sine;
        let length = ((along * along + across * across) * squared)
            .max(S::constant(1e-300))
            .sqrt();
        let scale = one / length;
        let second = [
            (along * v - across * u) * scale,
            (along * u + across * v) * scale,
        ];
        // joint 3 is the elbow's angle less the direction of the forearm in its frame
        let (s, c) = self.forearm_rad.sin_cos();
        let (s, c) = (S::constant(s), S::constant(c));
        let third = [sine * c - cosine * s, cosine * c + sine * s];
        (second, third, beyond)
    }

    #[inline(always)]
    fn solve_spherical<S: Scalar>(
        &self,
        target: &Pose<S>,
        [front, before, positive]: [S; 3],
        near: &[S; 6],
    ) -> ([S; 6], S) {
        let p = target.translation;
        let (first, r, beyond_1) = self.shoulder(p, front);
        let v = S::constant(self.e2) * p[2];
        let (second, third, beyond_2) = self.planar(r - S::constant(self.a2_m), v, before);
        // rotation of row 3 seen from the turning frame: Rz(1) · Rx(α2) · Rz(2 ± 3) · Rx(α3)
        let s3 = S::constant(self.s3);
        let sum = [
            second[0] * third[1] + s3 * second[1] * third[0],
            second[1] * third[1] - s3 * second[0] * third[0],
        ];
        let third_from_turning = arm_rotation(first, sum, S::constant(self.e2), s3).transpose();
        let n = self.link4_from_wrist.cast() * (third_from_turning * target.rotation);
        let m = &n.0;
        let (e5, e6) = (S::constant(self.e5), S::constant(self.e6));
        let side = positive * S::constant(self.wrist_sign);
        let sine = side * (m[0][2] * m[0][2] + m[1][2] * m[1][2]).sqrt();
        let cosine = -(e5 * e6) * m[2][2];
        let fifth = sine.atan2(cosine);
        let fourth = (side * e6 * m[1][2]).atan2(side * e6 * m[0][2]);
        let given = S::constant(self.sign[3]) * near[3] + S::constant(self.home[3]);
        let limit = S::constant(WRIST_SINE);
        let fourth = sine.abs().choose_less(limit, given, fourth);
        // Rz(−4) · n = M · Rz(6); the row of M with cosine of joint 5, or the last row, whichever is not small
        let (s4, c4) = fourth.sin_cos();
        let row: [S; 2] = std::array::from_fn(|j| c4 * m[0][j] + s4 * m[1][j]);
        let c6 = cosine * row[0] + e5 * sine * m[2][0];
        let s6 = -(cosine * row[1] + e5 * sine * m[2][1]);
        let sixth = s6.atan2(c6);
        let angles = [
            first[0].atan2(first[1]),
            second[0].atan2(second[1]),
            third[0].atan2(third[1]),
            fourth,
            fifth,
            sixth,
        ];
        (angles, beyond_1 + beyond_2)
    }

    #[inline(always)]
    fn solve_parallel<S: Scalar>(
        &self,
        target: &Pose<S>,
        [front, before, positive]: [S; 3],
        near: &[S; 6],
    ) -> ([S; 6], S) {
        let p = target.translation;
        let (first, r, beyond_1) = self.shoulder(p, front);
        let (e2, e5, e6) = (
            S::constant(self.e2),
            S::constant(self.e5),
            S::constant(self.e6),
        );
        let (s3, s34) = (S::constant(self.s3), S::constant(self.s3 * self.s4));
        // axis 4 in the last frame: (s5·e5·c6, −s5·e5·s6, −e5·e6·c5)
        let axis_4 = [s34 * e2 * first[0], -(s34 * e2 * first[1]), S::zero()];
        let m = target.rotation.transpose() * axis_4;
        let side = positive * S::constant(self.wrist_sign);
        let sine = side * (m[0] * m[0] + m[1] * m[1]).sqrt();
        let cosine = -(e5 * e6) * m[2];
        let fifth = sine.atan2(cosine);
        let given = S::constant(self.sign[5]) * near[5] + S::constant(self.home[5]);
        let sixth = (-(side * e5) * m[1]).atan2(side * e5 * m[0]);
        let sixth = sine
            .abs()
            .choose_less(S::constant(WRIST_SINE), given, sixth);
        let wrist = Rotation([
            [cosine, S::zero(), e6 * sine],
            [S::zero(), -(e5 * e6), S::zero()],
            [e5 * sine, S::zero(), -(e5 * e6) * cosine],
        ]) * Rotation::about_z(sixth);
        let fourth_in_turning = target.rotation * wrist.transpose();
        // into the plane: Rx(−α2) · Rz(−1)
        let turned = arm_rotation(first, [S::zero(), S::one()], e2, S::one()).transpose()
            * fourth_in_turning;
        let k = &turned.0;
        let sum = k[1][0].atan2(k[0][0]);
        let (a5, d5) = (S::constant(self.a5_m), S::constant(self.d5_m));
        let end = turned * [a5, -(d5 * e5), S::zero()];
        let [u, v] = [r - S::constant(self.a2_m) - end[0], e2 * p[2] - end[1]];
        let (second, third, beyond_2) = self.planar(u, v, before);
        let (second, third) = (second[0].atan2(second[1]), third[0].atan2(third[1]));
        let fourth = s34 * (sum - second - s3 * third);
        (
            [
                first[0].atan2(first[1]),
                second,
                third,
                fourth,
                fifth,
                sixth,
            ],
            beyond_1 + beyond_2,
        )
    }

    /// A pose moved across axis 1 by `radius_m` in the direction `angle_rad` about it.
    #[must_use]
    pub fn displaced(&self, world_from_tool: &Pose, radius_m: f64, angle_rad: f64) -> Pose {
        let (sine, cosine) = angle_rad.sin_cos();
        let across = self.turning_from_world.rotation.transpose()
            * [radius_m * cosine, radius_m * sine, 0.0];
        Pose {
            translation: add(world_from_tool.translation, across),
            ..*world_from_tool
        }
    }

    /// The branch of a posture and its distances from the singularities.
    #[must_use]
    pub fn posture(&self, q: &[f64; 6]) -> (Branch, Margins) {
        let u = self.mechanism.commanded(q);
        let angle: [f64; 6] = std::array::from_fn(|i| self.sign[i] * u[i] + self.home[i]);
        let elbow = angle[2] + self.forearm_rad;
        let (sine, cosine) = elbow.sin_cos();
        let along = self.a3_m + self.forearm_m * cosine;
        let across = self.s3 * self.forearm_m * sine;
        let (s2, c2) = angle[1].sin_cos();
        let mut reach = self.a2_m + c2 * along - s2 * across;
        if self.wrist == Wrist::Parallel {
            let sum = angle[1] + self.s3 * angle[2] + self.s3 * self.s4 * angle[3];
            let (s, c) = sum.sin_cos();
            let across = -self.d5_m * self.e5 * self.s3 * self.s4;
            reach += c * self.a5_m - s * across;
        }
        let wrist = angle[4].sin() * self.wrist_sign;
        let branch = Branch {
            behind_axis_1: reach < 0.0,
            behind_lower_arm: sine * self.elbow_sign < 0.0,
            joint_5_negative: wrist < 0.0,
        };
        let margins = Margins {
            wrist_rad: wrist.abs().asin(),
            elbow_rad: sine.abs().asin(),
            shoulder_m: reach.abs(),
        };
        (branch, margins)
    }
}

/// `Rz(first) · Rx(±90°) · Rz(sum) · Rx(0 or 180°)` from sines and cosines.
#[inline(always)]
fn arm_rotation<S: Scalar>([s1, c1]: [S; 2], [s, c]: [S; 2], e2: S, flip: S) -> Rotation<S> {
    // Rx(±90°) takes (x, y, z) to (x, −e2 z, e2 y)
    Rotation([
        [c1 * c, -(flip * c1 * s), flip * e2 * s1],
        [s1 * c, -(flip * s1 * s), -(flip * e2 * c1)],
        [e2 * s, flip * e2 * c, S::zero()],
    ])
}
