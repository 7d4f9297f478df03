//! Profiles from URDF files.
//!
//! The reader takes the axes of six rotating joints on the way from a base to a tip, in any frames
//! and in any directions, and derives rows of modified Denavit–Hartenberg parameters from them;
//! base and flange take up what is left. The profile's text is read again and its chain compared
//! with the URDF's own at random postures.
//!
//! # Source
//! ROS, "URDF/XML" (joint, link, origin: roll, pitch, yaw about fixed axes); J. J. Craig,
//! "Introduction to Robotics" for the rows.
//!
//! # Example
//!
//! ```
//! use poseshift::urdf::{Choice, UrdfArm};
//!
//! let joint = |k: usize, axis: &str| format!(
//!     "<link name='l{k}'/><joint name='j{k}' type='revolute'><parent link='l{}'/><child link='l{k}'/>\
//!      <origin xyz='0.1 0 0.2'/><axis xyz='{axis}'/><limit lower='-2' upper='2' effort='1' velocity='1'/></joint>", k - 1);
//! let axes = ["0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"];
//! let joints: String = axes.iter().enumerate().map(|(k, axis)| joint(k + 1, axis)).collect();
//! let arm = UrdfArm::read(&format!("<robot name='r'><link name='l0'/>{joints}</robot>"), &Choice::default())?;
//! assert_eq!(arm.joints.len(), 6);
//! assert!((arm.forward(&[0.0; 6]).translation[2] - 1.2).abs() < 1e-12);
//! # Ok::<(), poseshift::urdf::UrdfError>(())
//! ```

mod chain;
mod error;
mod export;
mod names;
mod parallel;
mod text;
mod tree;
mod write;

pub use error::UrdfError;
pub use export::{Drawing, is_name, urdf_text};
#[cfg(feature = "cli")]
pub(crate) use text::is_xacro;
pub use tree::MOST_M;
pub use write::{About, Meshes, profile_text};

use crate::geometry::{Pose, Vector};
use std::collections::BTreeSet;

/// What to take of a URDF.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    /// The link where the world is; by default `base`, by convention where the controller counts
    /// from, else the one without a parent. Only fixed joints may be between it and the arm.
    pub base: Option<String>,
    /// The link that the tool is mounted on; by default `tool0`, `fanuc_flange`, `flange`, or the
    /// only end.
    pub tip: Option<String>,
    /// Take the collision shapes.
    pub shapes: bool,
    /// Take every angle of a frame as it is written, also one near a multiple of 45°.
    pub exact: bool,
}

/// An arm of six axes as a URDF has it. Metres, radians.
#[derive(Clone, Debug)]
pub struct UrdfArm {
    /// The robot's name.
    pub name: String,
    /// The links between which it is.
    pub ends: [String; 2],
    /// The six joints, from the base.
    pub joints: Vec<UrdfJoint>,
    /// The tip in the frame of the last joint.
    pub last_from_tip: Pose,
    /// Masses by how many joints move them (1 to 6): in the frame of the last of these.
    pub masses: Vec<(usize, f64, Vector)>,
    /// Collision shapes, likewise, from 0.
    pub shapes: Vec<UrdfShape>,
    /// Names of the packages that its meshes are in.
    pub packages: BTreeSet<String>,
    /// What was taken differently from what stands there.
    pub notes: Vec<String>,
}

/// One rotating joint.
#[derive(Clone, Debug)]
pub struct UrdfJoint {
    /// Its name.
    pub name: String,
    /// Its frame seen from the frame of the joint before, at zero.
    pub before_from_joint: Pose,
    /// Its axis in its frame, unit.
    pub axis: Vector,
    /// Smallest angle.
    pub min_rad: f64,
    /// Largest angle.
    pub max_rad: f64,
    /// Largest speed, rad/s.
    pub speed_rad_s: Option<f64>,
}

/// A collision shape.
#[derive(Clone, Debug)]
pub struct UrdfShape {
    /// How many joints move it, 0 to 6.
    pub moved_by: usize,
    /// Its link.
    pub link: String,
    /// Where it is in the frame of the last joint that moves it.
    pub joint_from_shape: Pose,
    /// What it is.
    pub form: UrdfForm,
}

/// What a collision shape is.
#[derive(Clone, Debug, PartialEq)]
pub enum UrdfForm {
    /// Full edge lengths.
    Box(Vector),
    /// Radius and length along z.
    Cylinder(f64, f64),
    /// Radius and length of the cylinder between the caps, along z.
    Capsule(f64, f64),
    /// Radius.
    Sphere(f64),
    /// A mesh as the file names it, and metres of one of its units.
    Mesh(String, f64),
}

impl UrdfArm {
    /// Reads a URDF's text.
    ///
    /// # Errors
    /// If it is no URDF, or the way from base to tip is no chain of six rotating joints.
    pub fn read(text: &str, choice: &Choice) -> Result<Self, UrdfError> {
        tree::read(text, choice)
    }

    /// `base_from_tip` at these joint angles, by the URDF's own frames.
    #[must_use]
    pub fn forward(&self, q: &[f64; 6]) -> Pose {
        let mut pose = Pose::identity();
        for (joint, angle) in self.joints.iter().zip(q) {
            pose = pose * joint.before_from_joint * turn(&joint.axis, *angle);
        }
        pose * self.last_from_tip
    }

    /// Frames of the base and of the joints at zero.
    fn frames(&self) -> [Pose; 7] {
        let mut frames = [Pose::identity(); 7];
        for (i, joint) in self.joints.iter().enumerate().take(6) {
            frames[i + 1] = frames[i] * joint.before_from_joint;
        }
        frames
    }
}

/// Rotation about a unit axis.
fn turn(axis: &Vector, angle: f64) -> Pose {
    let (half_sine, half_cosine) = (0.5 * angle).sin_cos();
    let [x, y, z] = axis.map(|a| a * half_sine);
    Pose::from_rotation(crate::geometry::Quaternion([half_cosine, x, y, z]).rotation())
}

#[cfg(test)]
mod tests {
    use super::{Choice, UrdfArm};

    #[test]
    fn frames_in_degrees_are_refused() {
        let text = include_str!("../../tests/data/walk/arm.urdf");
        let choice = Choice::default();
        assert!(UrdfArm::read(text, &choice).is_ok());
        let degrees = text.replace("1.5707963267948966", "90");
        assert_ne!(degrees, text);
        let error = UrdfArm::read(&degrees, &choice).expect_err("degrees");
        assert!(error.to_string().contains("looks like degrees"), "{error}");
    }
}
