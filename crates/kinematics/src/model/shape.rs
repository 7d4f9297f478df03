//! Bodies that can touch something.

use crate::geometry::{Pose, Vector};

/// A body in a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// What it looks like.
    pub form: Form,
    /// Where it is.
    pub frame_from_shape: Pose,
}

/// What a body looks like, metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// All points within a radius of a segment.
    Capsule {
        /// One end of the segment.
        from_m: Vector,
        /// The other end.
        to_m: Vector,
        /// The radius.
        radius_m: f64,
    },
    /// A box about the origin.
    Box {
        /// Full lengths of its edges.
        size_m: Vector,
    },
    /// A ball about the origin.
    Sphere {
        /// The radius.
        radius_m: f64,
    },
    /// A cylinder about the z axis, centred on the origin.
    Cylinder {
        /// The radius.
        radius_m: f64,
        /// The full height.
        height_m: f64,
    },
    /// Everything below a plane: points p with `normal · p <= offset`.
    Plane {
        /// Unit normal out of the body.
        normal: Vector,
        /// Distance of the plane from the origin along the normal.
        offset_m: f64,
    },
    /// Triangles from a file.
    Mesh {
        /// The file's name as written, relative to the file that names it.
        file: String,
        /// Millimetres of one unit of the file on each axis; `None` where the file's format tells.
        scale: Option<Vector>,
    },
}

/// A body that belongs to a link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkShape {
    /// The link: 0 is the base, 1 to 6 the rows of the chain.
    pub link: usize,
    /// Its body in the link's frame (the base frame, or the frame after the row).
    pub shape: Shape,
}
