//! Shapes as profile and cell files write them.

use super::file::{Number, PoseFile};
use super::reading::{MOST_FAR_MM, check_angles, check_lengths, metres, pose, within};
use super::{Fault, ProfileError, TINY_M};
use crate::geometry::units::{m_from_mm, mm_from_m};
use crate::geometry::{Pose, norm, scale, sub};
use crate::model::shape::Form;
pub use crate::model::shape::Shape;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_yaml::{Location, Spanned};

/// Defines a type of entry that holds a shape besides keys of its own. (A flattened struct would
/// lose the place of errors.)
#[macro_export]
macro_rules! with_shape {
    ($(#[$meta:meta])* $name:ident { $($(#[$field_meta:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$meta])*
        #[derive(Debug, serde::Deserialize, schemars::JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $($(#[$field_meta])* pub $field: $type,)*
            /// All points within a radius of a segment.
            #[serde(default)]
            pub capsule_mm: Option<$crate::shape::CapsuleFile>,
            /// Full edge lengths of a box about the origin.
            #[serde(default)]
            pub box_mm: Option<[$crate::file::Number; 3]>,
            /// A ball about the origin.
            #[serde(default)]
            pub sphere_mm: Option<$crate::shape::SphereFile>,
            /// A cylinder about z, centred on the origin.
            #[serde(default)]
            pub cylinder_mm: Option<$crate::shape::CylinderFile>,
            /// All below a plane.
            #[serde(default)]
            pub plane: Option<$crate::shape::PlaneFile>,
            /// A mesh file: STL, OBJ, DAE or glTF, relative to this file.
            #[serde(default)]
            pub mesh: Option<String>,
            /// Millimetres of one unit of the mesh file (default 1; DAE and glTF, in metres by their own unit, 1000).
            #[serde(default)]
            pub scale: Option<$crate::file::Number>,
            /// Where the shape is in its frame.
            #[serde(default)]
            #[schemars(with = "Option<poseshift_profile::file::PoseFile>")]
            pub at: Option<serde_yaml::Spanned<$crate::file::PoseFile>>,
        }

        impl $name {
            /// The shape of this entry, which stands at `place`.
            pub(crate) fn shape(
                &self,
                place: serde_yaml::Location,
            ) -> Result<$crate::shape::Shape, $crate::ProfileError> {
                $crate::shape::Keys {
                    capsule: self.capsule_mm.as_ref(),
                    size: self.box_mm.as_ref(),
                    sphere: self.sphere_mm.as_ref(),
                    cylinder: self.cylinder_mm.as_ref(),
                    plane: self.plane.as_ref(),
                    mesh: self.mesh.as_ref(),
                    scale: self.scale,
                    at: self.at.as_ref(),
                }
                .shape(place)
            }
        }
    };
}
with_shape! {
    /// A body of a link, for collisions.
    LinkShapeFile {
        /// The link: 0 is the base, 1 to 6 the rows of the chain.
        link: u8,
    }
}

/// A capsule.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CapsuleFile {
    /// One end of the segment.
    pub from: [Number; 3],
    /// The other end.
    pub to: [Number; 3],
    /// Radius.
    pub radius: Number,
}

/// A ball.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SphereFile {
    /// Radius.
    pub radius: Number,
}

/// A cylinder.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderFile {
    /// Radius.
    pub radius: Number,
    /// Full height.
    pub height: Number,
}

/// All below a plane.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneFile {
    /// Direction out of the body.
    pub normal: [Number; 3],
    /// Distance of the plane from the origin along the normal.
    pub offset_mm: Number,
}

/// The keys of one entry that make its shape; one of them says what it is.
pub struct Keys<'a> {
    /// All points within a radius of a segment.
    pub capsule: Option<&'a CapsuleFile>,
    /// Full edge lengths of a box about the origin, mm.
    pub size: Option<&'a [Number; 3]>,
    /// A ball about the origin.
    pub sphere: Option<&'a SphereFile>,
    /// A cylinder about z, centred on the origin.
    pub cylinder: Option<&'a CylinderFile>,
    /// All below a plane.
    pub plane: Option<&'a PlaneFile>,
    /// The name of a mesh file.
    pub mesh: Option<&'a String>,
    /// Millimetres of one unit of the mesh file.
    pub scale: Option<Number>,
    /// Where the shape is in its frame.
    pub at: Option<&'a Spanned<PoseFile>>,
}

impl Keys<'_> {
    /// The shape that these keys describe.
    ///
    /// # Errors
    /// None of the keys, several, or a number that is no size; at the key, or at `place`.
    pub fn shape(self, place: Location) -> Result<Shape, ProfileError> {
        let length = |key: &'static str, number: Number| {
            within(key, number, MOST_FAR_MM, place)?;
            if number.0 > 0.0 {
                Ok(m_from_mm(number.0))
            } else {
                let fault = Fault::NotPositive {
                    key,
                    found: number.0,
                };
                Err(fault.at(place))
            }
        };
        let mut forms = Vec::new();
        if let Some(c) = self.capsule {
            for number in c.from {
                within("from", number, MOST_FAR_MM, place)?;
            }
            for number in c.to {
                within("to", number, MOST_FAR_MM, place)?;
            }
            forms.push(Form::Capsule {
                from_m: metres(c.from),
                to_m: metres(c.to),
                radius_m: length("radius", c.radius)?,
            });
        }
        if let Some([x, y, z]) = self.size {
            let size_m = [
                length("box_mm", *x)?,
                length("box_mm", *y)?,
                length("box_mm", *z)?,
            ];
            forms.push(Form::Box { size_m });
        }
        if let Some(s) = self.sphere {
            let radius_m = length("radius", s.radius)?;
            forms.push(Form::Sphere { radius_m });
        }
        if let Some(c) = self.cylinder {
            forms.push(Form::Cylinder {
                radius_m: length("radius", c.radius)?,
                height_m: length("height", c.height)?,
            });
        }
        if let Some(p) = self.plane {
            let normal = p.normal.map(|n| n.0);
            // in parts of its largest: squares of any are finite
            let most = normal.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
            let part = normal.map(|n| n / most);
            let long = if most > 0.0 { most * norm(part) } else { 0.0 };
            if long < 1e-9 {
                return Err(Fault::NotPositive {
                    key: "the length of normal",
                    found: long,
                }
                .at(place));
            }
            forms.push(Form::Plane {
                normal: scale(norm(part).recip(), part),
                offset_m: m_from_mm(p.offset_mm.0),
            });
        }
        if let Some(file) = self.mesh {
            if let Some(scale) = self.scale
                && scale.0 <= 0.0
            {
                return Err(Fault::NotPositive {
                    key: "scale",
                    found: scale.0,
                }
                .at(place));
            }
            forms.push(Form::Mesh {
                file: file.clone(),
                scale: self.scale.map(|scale| [scale.0; 3]),
            });
        } else if self.scale.is_some() {
            return Err(Fault::ScaleWithoutMesh.at(place));
        }
        let found = forms.len();
        let [form]: [Form; 1] = forms
            .try_into()
            .map_err(|_| Fault::NotOneShape { found }.at(place))?;
        if let Some(largest_m) = largest_m(&form).filter(|largest| *largest < TINY_M) {
            let fault = Fault::TinyBody {
                largest_mm: mm_from_m(largest_m),
                limit_mm: mm_from_m(TINY_M),
            };
            return Err(fault.at(place));
        }
        if let Some(at) = self.at {
            check_angles(at)?;
            check_lengths(at, MOST_FAR_MM)?;
        }
        Ok(Shape {
            form,
            frame_from_shape: self.at.map_or(Ok(Pose::identity()), pose)?,
        })
    }
}

/// The largest dimension of a body that has one by itself: a plane has none, a mesh its file.
fn largest_m(form: &Form) -> Option<f64> {
    match form {
        Form::Capsule {
            from_m,
            to_m,
            radius_m,
        } => Some(norm(sub(*to_m, *from_m)) + 2.0 * radius_m),
        Form::Box { size_m } => Some(size_m.iter().copied().fold(0.0, f64::max)),
        Form::Sphere { radius_m } => Some(2.0 * radius_m),
        Form::Cylinder { radius_m, height_m } => Some(height_m.max(2.0 * radius_m)),
        Form::Plane { .. } | Form::Mesh { .. } => None,
    }
}
