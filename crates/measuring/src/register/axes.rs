//! Joint axes from sweeps of one joint at a time: circles, and from pairs of them the base and the
//! tool.
//!
//! Two skew lines carry a frame: z along the first, x the part of the second's direction across it,
//! the origin where their common perpendicular meets the first. The frame of the nominal axes 1 and
//! 2 in the base, laid on the same frame of the measured axes, gives `world_from_base`; axes 6 and
//! 5 give `world_from_flange` and so the measured point in the flange frame.
//!
//! # Source
//! A. Nubiola, thesis, sec. 2.3 and table 2.3.

use super::features::{self, FeatureError, Round, noise_of};
use super::frames::propagate;
use super::linear;
use super::uncertainty::PoseCovariance;
use crate::geometry::{Pose, Rotation, Vector, add, cross, dot, norm, scale, sub};
use crate::profile::Profile;
use nalgebra::{DMatrix, DVector};

pub mod outliers;
pub mod positioner;
pub mod relations;
pub mod sag;

/// Joints that should stand still may move by so much, radians.
const STILL_RAD: f64 = 1e-4;
/// A sweep shorter than this says little about its axis, radians.
const SHORT_RAD: f64 = 0.17;
/// Angles on the circle and commanded ones that differ by this part of the sweep do not belong
/// together.
const UNLIKE: f64 = 0.1;
/// Axes nearer to parallel than this carry no frame, sine of the angle.
const PARALLEL: f64 = 0.05;

/// One measurement of a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The controller's joint angles, radians.
    pub q: [f64; 6],
    /// The measured point in the world, metres.
    pub point_m: Vector,
    /// The tool's orientation in the world, where it was measured.
    pub rotation: Option<Rotation>,
    /// Direction in which the swept joint last moved: −1, 0 (not known), 1.
    pub direction: f64,
}

/// The measurements while one joint moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The joint, from 0.
    pub joint: usize,
    /// In the order in which they were measured.
    pub rows: Vec<Row>,
}

/// A line in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A point of it, metres.
    pub point_m: Vector,
    /// Unit vector.
    pub direction: Vector,
}

/// The circle on which a point goes while one axis moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Circle {
    /// The axis in the world through the centre; growing angles rotate about it by the right hand.
    pub line: Line,
    /// Its radius, metres.
    pub radius_m: f64,
    /// Standard deviation of a coordinate off the circle, metres; `None` where three rows leave
    /// nothing to estimate it from.
    pub noise_m: Option<f64>,
    /// Largest minus smallest angle on the circle, radians.
    pub span_rad: f64,
    /// Angle on the circle minus the commanded one, mean taken off, radians.
    pub tangential_rad: Vec<f64>,
    /// Distance from the circle in its plane, metres.
    pub radial_m: Vec<f64>,
    /// Distance from its plane, metres.
    pub axial_m: Vec<f64>,
}

impl Circle {
    /// Through points at these angles of the axis, radians.
    fn of(points: &[Vector], turned: &[f64]) -> Result<Self, FeatureError> {
        let round = features::circle(points)?;
        let (angles, direction) = angles(&round, points, turned);
        let noise = noise_of(&round.residuals_m, 3).zip(noise_of(&round.axial_m, 3));
        Ok(Self {
            line: Line {
                point_m: round.centre_m,
                direction,
            },
            radius_m: round.radius_m,
            noise_m: noise.map(|(r, a)| (0.5 * (r * r + a * a)).sqrt()),
            span_rad: span(&angles),
            tangential_rad: tangential(&angles, turned),
            radial_m: round.residuals_m,
            axial_m: round.axial_m,
        })
    }

    /// Whether the points go round otherwise than the angles say.
    fn is_unlike(&self, turned: &[f64]) -> bool {
        span(&self.tangential_rad) > UNLIKE * span(turned)
    }
}

/// What a sweep says about its joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The joint, from 0.
    pub joint: usize,
    /// The circle of the point.
    pub circle: Circle,
    /// Full width of the backlash and its standard uncertainty, radians; where both directions
    /// were measured.
    pub backlash_rad: Option<(f64, f64)>,
}

/// A frame found from two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Base: `world_from_base`. Tool: `flange_from_tool`.
    pub pose: Pose,
    /// What the noise of the points does to it, along the axes of the frame mapped into; `None`
    /// where the noise is not known.
    pub covariance: Option<PoseCovariance>,
    /// Whether the orientation was measured (a base always is; a tool where rows have poses).
    pub oriented: bool,
}

/// Why sweeps give no axes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AxesError {
    /// No circle.
    #[error("sweep of joint {joint}: {error}")]
    Circle {
        /// From 1.
        joint: usize,
        /// Why.
        error: FeatureError,
    },
    /// Another joint moves.
    #[error("sweep of joint {joint}: joint {other} moves too, by {moved_deg:.4} deg (limit \
        {limit_deg:.4} deg){}", coupling_hint(*.coupled))]
    Moves {
        /// From 1.
        joint: usize,
        /// From 1.
        other: usize,
        /// How far.
        moved_deg: f64,
        /// The most that is accepted.
        limit_deg: f64,
        /// Whether the controller counts the swept joint in.
        coupled: bool,
    },
    /// The swept joint hardly moves.
    #[error(
        "sweep of joint {joint}: it rotates by {rotated_deg:.3} deg only (limit {limit_deg:.1} \
         deg); is the column sweep right, and are the angles in degrees?"
    )]
    Short {
        /// From 1.
        joint: usize,
        /// How far.
        rotated_deg: f64,
        /// The least that is accepted.
        limit_deg: f64,
    },
    /// Measured and commanded angles do not belong together.
    #[error(
        "sweep of joint {joint}: the points rotate by {measured_deg:.2} deg where the joint \
         rotates by {commanded_deg:.2} deg: angles in radians, another joint, or rows in another \
         order"
    )]
    Unlike {
        /// From 1.
        joint: usize,
        /// On the circle.
        measured_deg: f64,
        /// By the joint column.
        commanded_deg: f64,
    },
    /// Sweeps that should share a posture do not.
    #[error(
        "sweeps of joints {first} and {second} differ in joint {other} by {gap_deg:.4} deg: both \
         must be made in one posture"
    )]
    Posture {
        /// From 1.
        first: usize,
        /// From 1.
        second: usize,
        /// From 1.
        other: usize,
        /// How far.
        gap_deg: f64,
    },
    /// Axes that are parallel.
    #[error("axes {first} and {second} are parallel to {angle_deg:.2} deg: they carry no frame")]
    Parallel {
        /// From 1.
        first: usize,
        /// From 1.
        second: usize,
        /// Angle between them.
        angle_deg: f64,
    },
}

fn coupling_hint(coupled: bool) -> &'static str {
    if coupled {
        ": the controller's angle counts the swept joint in; command it so that the mechanical \
         joint stands still"
    } else {
        ""
    }
}

/// Fits the axis of one sweep.
///
/// # Errors
/// If other joints move, the swept one hardly does, or the points are on no circle.
pub fn axis(sweep: &Sweep, profile: &Profile) -> Result<Axis, AxesError> {
    let found = fitted(sweep, profile)?;
    let turned = mechanical(sweep, profile)?;
    if found.circle.is_unlike(&turned) {
        return Err(AxesError::Unlike {
            joint: sweep.joint + 1,
            measured_deg: found.circle.span_rad.to_degrees(),
            commanded_deg: span(&turned).to_degrees(),
        });
    }
    Ok(found)
}

/// Largest minus smallest.
fn span(values: &[f64]) -> f64 {
    let (low, high) = values
        .iter()
        .fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(*x), b.max(*x)));
    high - low
}

/// The axis of one sweep, whatever the angles on the circle are.
fn fitted(sweep: &Sweep, profile: &Profile) -> Result<Axis, AxesError> {
    let joint = sweep.joint + 1;
    let turned = mechanical(sweep, profile)?;
    let points: Vec<Vector> = sweep.rows.iter().map(|row| row.point_m).collect();
    let circle =
        Circle::of(&points, &turned).map_err(|error| AxesError::Circle { joint, error })?;
    Ok(Axis {
        joint: sweep.joint,
        backlash_rad: backlash(sweep, &circle.tangential_rad, &turned),
        circle,
    })
}

/// The swept joint's mechanical angles in the controller's sense, after a check that the others
/// stand still.
fn mechanical(sweep: &Sweep, profile: &Profile) -> Result<Vec<f64>, AxesError> {
    let joint = sweep.joint + 1;
    let all: Vec<[f64; 6]> = sweep
        .rows
        .iter()
        .map(|row| profile.mechanism.commanded(&row.q))
        .collect();
    let range = |k: usize| {
        let (low, high) = all
            .iter()
            .fold((f64::MAX, f64::MIN), |(a, b), u| (a.min(u[k]), b.max(u[k])));
        high - low
    };
    for other in (0..6).filter(|k| *k != sweep.joint) {
        if range(other) > STILL_RAD {
            let couplings = &profile.mechanism.coupling;
            return Err(AxesError::Moves {
                joint,
                other: other + 1,
                moved_deg: range(other).to_degrees(),
                limit_deg: STILL_RAD.to_degrees(),
                coupled: couplings
                    .iter()
                    .any(|c| c.joint == other && c.on == sweep.joint),
            });
        }
    }
    let turned_rad = range(sweep.joint);
    if turned_rad.is_nan() || turned_rad < SHORT_RAD {
        return Err(AxesError::Short {
            joint,
            rotated_deg: turned_rad.to_degrees(),
            limit_deg: SHORT_RAD.to_degrees(),
        });
    }
    Ok(all.iter().map(|u| u[sweep.joint]).collect())
}

/// Angle of each point on the circle, about the axis in the sense in which the joint turns.
fn angles(circle: &Round, points: &[Vector], turned: &[f64]) -> (Vec<f64>, Vector) {
    let along = |direction: Vector| -> Vec<f64> {
        let first = sub(points[0], circle.centre_m);
        let x = sub(first, scale(dot(direction, first), direction));
        let y = cross(direction, x);
        let of = |p: &Vector| {
            let d = sub(*p, circle.centre_m);
            dot(y, d).atan2(dot(x, d))
        };
        points.iter().map(of).collect()
    };
    // the right sense is the one in which angle minus command stays together
    let agreement = |angles: &[f64]| {
        let sums = angles
            .iter()
            .zip(turned)
            .fold((0.0, 0.0), |(c, s), (a, t)| {
                (c + (a - t).cos(), s + (a - t).sin())
            });
        sums.0.hypot(sums.1)
    };
    let back = scale(-1.0, circle.axis);
    let (plus, minus) = (along(circle.axis), along(back));
    if agreement(&plus) >= agreement(&minus) {
        (plus, circle.axis)
    } else {
        (minus, back)
    }
}

fn wrap(angle: f64) -> f64 {
    crate::geometry::wrap(angle)
}

/// Measured minus commanded angle, mean taken off.
fn tangential(angles: &[f64], turned: &[f64]) -> Vec<f64> {
    let sums = angles
        .iter()
        .zip(turned)
        .fold((0.0, 0.0), |(c, s), (a, t)| {
            (c + (a - t).cos(), s + (a - t).sin())
        });
    let offset = sums.1.atan2(sums.0);
    angles
        .iter()
        .zip(turned)
        .map(|(a, t)| wrap(a - t - offset))
        .collect()
}

/// Backlash besides what compliance and eccentricity do smoothly: least squares of `o + (b/2) dir +
/// c cos q + s sin q`.
fn backlash(sweep: &Sweep, left: &[f64], turned: &[f64]) -> Option<(f64, f64)> {
    let directions: Vec<f64> = sweep.rows.iter().map(|row| row.direction).collect();
    let both = [1.0, -1.0].map(|d| directions.iter().filter(|x| **x == d).count());
    if both.iter().any(|n| *n < 2) {
        return None;
    }
    let columns = if left.len() >= 8 { 4 } else { 2 };
    let rows = DMatrix::from_fn(left.len(), columns, |i, j| match j {
        0 => 1.0,
        1 => 0.5 * directions[i],
        2 => turned[i].cos(),
        _ => turned[i].sin(),
    });
    let svd = linear::svd(&rows);
    if svd.values[columns - 1] < 1e-3 * svd.values[0] {
        return None;
    }
    let right = DVector::from_column_slice(left);
    let x = &svd.right * (svd.left.transpose() * &right).component_div(&svd.values);
    let rest = (&rows * &x - right).norm_squared();
    #[allow(clippy::cast_precision_loss)]
    let variance = rest / (left.len() - columns).max(1) as f64;
    let spread: f64 = (0..columns)
        .map(|k| (svd.right[(1, k)] / svd.values[k]).powi(2))
        .sum();
    Some((x[1], (variance * spread).sqrt()))
}

/// The frame that two skew lines carry.
fn carried(first: &Line, second: &Line, names: [usize; 2]) -> Result<Pose, AxesError> {
    let (z, d) = (first.direction, second.direction);
    let cosine = dot(z, d);
    let across = sub(d, scale(cosine, z));
    let sine = norm(across);
    if sine < PARALLEL {
        return Err(AxesError::Parallel {
            first: names[0],
            second: names[1],
            angle_deg: sine.asin().to_degrees(),
        });
    }
    let x = scale(1.0 / sine, across);
    let between = sub(second.point_m, first.point_m);
    let along = dot(between, sub(z, scale(cosine, d))) / (sine * sine);
    let y = cross(z, x);
    Ok(Pose {
        rotation: Rotation(std::array::from_fn(|i| [x[i], y[i], z[i]])),
        translation: add(first.point_m, scale(along, z)),
    })
}

/// The nominal axes in the base and the flange in it, at the controller's joint angles.
fn nominal(profile: &Profile, q: &[f64; 6]) -> ([Line; 6], Pose) {
    let u = profile.mechanism.commanded(q);
    let mut pose = Pose::identity();
    let lines = std::array::from_fn(|i| {
        let (link, sense) = (&profile.links[i], &profile.mechanism.joints[i]);
        pose = pose
            * Pose::from_rotation(Rotation::about_x(link.alpha_rad))
            * Pose::from_translation(link.a_m, 0.0, 0.0)
            * Pose::from_rotation(Rotation::about_y(link.beta_rad))
            * Pose::from_rotation(Rotation::about_z(
                link.theta_rad + sense.offset_rad + sense.sign * u[i],
            ))
            * Pose::from_translation(0.0, 0.0, link.d_m);
        Line {
            point_m: pose.translation,
            direction: scale(sense.sign, pose.rotation.axis(2)),
        }
    });
    (lines, pose * profile.link6_from_flange)
}

/// A frame that two sweeps carry, from the points of both one after the other.
type Construction = fn([&Sweep; 2], &[Vector], &Profile) -> Result<Pose, AxesError>;

/// `world_from_base` from the sweeps of joints 1 and 2.
fn base_of(sweeps: [&Sweep; 2], points: &[Vector], profile: &Profile) -> Result<Pose, AxesError> {
    let (lines, _) = nominal(profile, &sweeps[1].rows[0].q);
    let measured = lines_of(sweeps, points, profile)?;
    let world = carried(&measured[0], &measured[1], [1, 2])?;
    let base = carried(&lines[0], &lines[1], [1, 2])?;
    Ok(world * base.inverse())
}

/// `flange_from_tool` from the sweeps of joints 6 and 5.
fn tool_of(sweeps: [&Sweep; 2], points: &[Vector], profile: &Profile) -> Result<Pose, AxesError> {
    let sixth = sweeps[0];
    let measured = lines_of(sweeps, points, profile)?;
    let world = carried(&measured[0], &measured[1], [6, 5])?;
    let mut sum = [0.0; 3];
    let mut turns = nalgebra::Matrix3::zeros();
    let oriented = is_oriented(sixth);
    for (row, point) in sixth.rows.iter().zip(points) {
        let (lines, base_from_flange) = nominal(profile, &row.q);
        let in_base = carried(&lines[5], &lines[4], [6, 5])?;
        let world_from_flange = world * in_base.inverse() * base_from_flange;
        let back = world_from_flange.inverse();
        sum = add(sum, back.transform(*point));
        if let Some(rotation) = row.rotation {
            let turn = (back.rotation * rotation).0;
            turns += nalgebra::Matrix3::from_fn(|i, j| turn[i][j]);
        }
    }
    let rotation = if oriented {
        nearest_rotation(&turns)
    } else {
        Rotation::identity()
    };
    #[allow(clippy::cast_precision_loss)]
    let translation = scale(1.0 / sixth.rows.len() as f64, sum);
    Ok(Pose {
        rotation,
        translation,
    })
}

fn is_oriented(sweep: &Sweep) -> bool {
    sweep.rows.iter().all(|row| row.rotation.is_some())
}

/// `world_from_base` from the sweeps of joints 1 and 2.
///
/// # Errors
/// As [`axis`]; or parallel axes.
pub fn base(first: &Sweep, second: &Sweep, profile: &Profile) -> Result<Placed, AxesError> {
    let axes = [axis(first, profile)?, axis(second, profile)?];
    placed(base_of, [first, second], &axes, profile, true)
}

/// The measured point, and the tool's orientation where it was measured, in the flange frame, from
/// the sweeps of joints 5 and 6 made in one posture of the others.
///
/// # Errors
/// As [`axis`]; sweeps in different postures; parallel axes.
pub fn tool(fifth: &Sweep, sixth: &Sweep, profile: &Profile) -> Result<Placed, AxesError> {
    let axes = [axis(sixth, profile)?, axis(fifth, profile)?];
    let (a, b) = (&fifth.rows[0].q, &sixth.rows[0].q);
    if let Some(other) = (0..4).find(|k| (a[*k] - b[*k]).abs() > STILL_RAD) {
        return Err(AxesError::Posture {
            first: 5,
            second: 6,
            other: other + 1,
            gap_deg: (a[other] - b[other]).abs().to_degrees(),
        });
    }
    placed(tool_of, [sixth, fifth], &axes, profile, is_oriented(sixth))
}

/// The frame with what the noise of the points does to it.
fn placed(
    construct: Construction,
    sweeps: [&Sweep; 2],
    axes: &[Axis; 2],
    profile: &Profile,
    oriented: bool,
) -> Result<Placed, AxesError> {
    let points = points_of(sweeps);
    let noise: Option<Vec<f64>> = axes.iter().map(|axis| axis.circle.noise_m).collect();
    let covariance = match noise {
        None => None,
        Some(noise) => {
            let each = sweeps.iter().zip(noise);
            let sigmas: Vec<f64> = each
                .flat_map(|(sweep, noise)| std::iter::repeat_n(noise, sweep.rows.len()))
                .collect();
            let build = |points: &[Vector]| construct(sweeps, points, profile);
            Some(propagate(&points, &sigmas, build)?)
        }
    };
    Ok(Placed {
        pose: construct(sweeps, &points, profile)?,
        covariance,
        oriented,
    })
}

/// The rotation nearest to a sum of rotations.
pub(super) fn nearest_rotation(sum: &nalgebra::Matrix3<f64>) -> Rotation {
    let svd = linear::svd(&DMatrix::from_fn(3, 3, |i, j| sum[(i, j)]));
    let column = |m: &DMatrix<f64>, j: usize| [m[(0, j)], m[(1, j)], m[(2, j)]];
    let handed = |m: &DMatrix<f64>| {
        let (x, y) = (column(m, 0), column(m, 1));
        [x, y, cross(x, y)]
    };
    let (u, v) = (handed(&svd.left), handed(&svd.right));
    Rotation(std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..3).map(|k| u[k][i] * v[k][j]).sum())
    }))
}

/// The points of two sweeps one after the other.
fn points_of(sweeps: [&Sweep; 2]) -> Vec<Vector> {
    let rows = sweeps.iter().flat_map(|sweep| &sweep.rows);
    rows.map(|row| row.point_m).collect()
}

fn lines_of(
    sweeps: [&Sweep; 2],
    points: &[Vector],
    profile: &Profile,
) -> Result<[Line; 2], AxesError> {
    let (first, second) = points.split_at(sweeps[0].rows.len());
    let line = |sweep: &Sweep, points: &[Vector]| -> Result<Line, AxesError> {
        let turned = mechanical(sweep, profile)?;
        let joint = sweep.joint + 1;
        let circle =
            features::circle(points).map_err(|error| AxesError::Circle { joint, error })?;
        let (_, direction) = angles(&circle, points, &turned);
        Ok(Line {
            point_m: circle.centre_m,
            direction,
        })
    };
    Ok([line(sweeps[0], first)?, line(sweeps[1], second)?])
}
