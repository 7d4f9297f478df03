//! Poses, rotations and the scalars they are computed with; knows no robots.
//!
//! A transform `a_from_b` maps coordinates in frame b to coordinates in frame a, so adjacent words
//! match in a product: `world_from_tool = world_from_base * base_from_flange * flange_from_tool`.
//! Lengths are metres, angles radians.
//!
//! # Example
//!
//! ```
//! use poseshift_kinematics::geometry::Pose;
//!
//! let world_from_base = Pose::<f64>::from_xyz_rxryrz([1.0, 0.0, 0.5, 0.0, 0.0, 0.3]);
//! let base_from_tool = Pose::from_translation(0.4, 0.1, 0.2);
//! let world_from_tool = world_from_base * base_from_tool;
//! let again = world_from_base.inverse() * world_from_tool;
//! assert!(again.separation(&base_from_tool).distance_m < 1e-15);
//! ```

mod axis_rotation;
mod convention;
mod dual;
mod four;
mod jet;
mod pose;
mod roots;
mod rotation;
mod scalar;
pub mod units;

pub use axis_rotation::AxisRotation;
pub use convention::Convention;
pub use dual::Dual;
pub use four::{Four, WIDTH};
pub use jet::{Ball, Jet};
pub use pose::{Pose, Separation};
pub(crate) use roots::roots;
pub use rotation::{Quaternion, Rotation, wrap};
pub use scalar::Scalar;

/// A vector or point of three coordinates.
pub type Vector<S = f64> = [S; 3];

/// `a + b`.
#[inline(always)]
pub fn add<S: Scalar>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a - b`.
#[inline(always)]
pub fn sub<S: Scalar>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `k a`.
#[inline(always)]
pub fn scale<S: Scalar>(k: S, a: Vector<S>) -> Vector<S> {
    [k * a[0], k * a[1], k * a[2]]
}

/// Scalar product.
#[inline(always)]
pub fn dot<S: Scalar>(a: Vector<S>, b: Vector<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product.
#[inline(always)]
pub fn cross<S: Scalar>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Euclidean length.
#[inline(always)]
pub fn norm<S: Scalar>(a: Vector<S>) -> S {
    dot(a, a).sqrt()
}

/// A vector of plain numbers as a vector of `S`.
#[inline(always)]
pub fn constant<S: Scalar>(a: Vector<f64>) -> Vector<S> {
    [S::constant(a[0]), S::constant(a[1]), S::constant(a[2])]
}
