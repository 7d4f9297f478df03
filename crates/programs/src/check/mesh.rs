//! Triangle meshes from files: STL, OBJ, COLLADA and glTF.
//!
//! COLLADA and glTF say how long their unit is and which axis points up: what is read is in metres,
//! and z points up. STL and OBJ say neither: they are taken as they stand, and their unit, where
//! nobody says, as a millimetre.

use crate::geometry::units::m_from_mm;
use crate::geometry::{Vector, cross, norm, sub};
use std::collections::{HashMap, HashSet};
use std::path::Path;

#[cfg(feature = "mesh")]
mod formats;

/// A mesh with a longer side than this is in other units, metres.
const LARGEST_M: f64 = 100.0;
/// A mesh whose longest side is shorter than this is in other units, metres.
const SMALLEST_M: f64 = 0.5e-3;
/// A triangle whose area is below this part of its longest edge squared is degenerate.
const DEGENERATE: f64 = 1e-12;

/// Three corners.
type Triangle = [Vector; 3];

/// Reads a file that a mesh file names: it stands in the same folder or below it. An error says why
/// it cannot be read.
pub type Neighbour<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// Triangles in metres.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Mesh {
    /// Corners of each triangle.
    pub triangles: Vec<[Vector; 3]>,
    /// Triangles of the file that have no area; they are left out.
    pub degenerate: usize,
    /// Edges that belong to an odd number of triangles: a closed mesh has none.
    pub open_edges: usize,
    /// Triangles next to each other face to the same side.
    pub faces_alike: bool,
    /// The file that it was read from; empty where it is of none.
    pub file: String,
    /// Neither the file nor anybody else says how long its unit is: a millimetre is assumed.
    pub unit_assumed: bool,
    /// The file says how long its unit is, and a scale that was given makes it smaller.
    pub shrunk: bool,
}

/// Why a mesh cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// A file name that ends on no known format.
    #[error("`{ending}` is no mesh format; known are stl, obj, dae, gltf and glb")]
    Ending {
        /// What it ends on.
        ending: String,
    },
    /// The library was built without the readers of meshes.
    #[error("this library was built without the feature `mesh`")]
    NotBuilt,
    /// Not what its name says.
    #[error("not a readable mesh: {message}")]
    Unreadable {
        /// What the reader says.
        message: String,
    },
    /// No triangle with an area.
    #[error("no triangle has an area ({found} triangles in the file)")]
    Empty {
        /// Triangles in the file.
        found: usize,
    },
    /// Coordinates that are no numbers.
    #[error("a corner has a coordinate that is not finite")]
    NotFinite,
    /// A size that cannot be meant.
    #[error(
        "the mesh is {size_m} m long with scale {scale}; it should be between 0.0005 and 100 m"
    )]
    Size {
        /// Its longest side, metres.
        size_m: f64,
        /// Millimetres of a unit.
        scale: f64,
    },
}

impl MeshError {
    /// The way out.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Size { size_m, scale } if *size_m > LARGEST_M => format!(
                "is the file in millimetres already? `scale: {}` would make it {} m",
                scale / 1000.0,
                size_m / 1000.0
            ),
            Self::Size { size_m, scale } => format!(
                "is the file in metres? `scale: {}` would make it {} m",
                scale * 1000.0,
                size_m * 1000.0
            ),
            Self::NotBuilt => "switch on the feature `mesh` of the crate `poseshift`".into(),
            Self::Empty { .. } => "export triangles, not lines or points".into(),
            _ => String::new(),
        }
    }
}

/// Whether files of this name say how long their unit is: they are in metres once it is applied.
fn says_its_unit(name: &str) -> bool {
    matches!(ending(name).as_str(), "dae" | "gltf" | "glb")
}

fn ending(name: &str) -> String {
    let ending = Path::new(name).extension().and_then(|e| e.to_str());
    ending.unwrap_or_default().to_ascii_lowercase()
}

impl Mesh {
    /// Reads a mesh file's bytes; `scale` is millimetres of a unit on each axis, of files that say
    /// their unit of a metre in them. `neighbour` reads a file that this one names.
    ///
    /// # Errors
    /// If it is no mesh, has no area, or a size that cannot be meant.
    pub fn read(
        name: &str,
        bytes: &[u8],
        scale: Option<Vector>,
        neighbour: Neighbour,
    ) -> Result<Self, MeshError> {
        let default = if says_its_unit(name) { 1000.0 } else { 1.0 };
        let unit_assumed = scale.is_none() && !says_its_unit(name);
        let scale = scale.unwrap_or([default; 3]);
        let shrunk = says_its_unit(name) && scale.iter().all(|scale| scale.abs() < default);
        let raw = triangles(name, bytes, neighbour)?;
        let scaled = |point: Vector| std::array::from_fn(|i| m_from_mm(point[i] * scale[i]));
        let triangles: Vec<Triangle> = raw.iter().map(|t| t.map(scaled)).collect();
        Ok(Self {
            file: name.into(),
            unit_assumed,
            shrunk,
            ..Self::of(&triangles, scale[0])?
        })
    }

    /// A mesh of triangles in metres.
    ///
    /// # Errors
    /// If it has no area, or a size that cannot be meant.
    pub fn of(all: &[Triangle], scale: f64) -> Result<Self, MeshError> {
        if all.iter().flatten().flatten().any(|x| !x.is_finite()) {
            return Err(MeshError::NotFinite);
        }
        // a corner far away makes a triangle of which no area is left: its mesh is none, either
        let size_m = side_m(&bounds(all));
        if size_m > LARGEST_M {
            return Err(MeshError::Size { size_m, scale });
        }
        let has_area = |[a, b, c]: &&Triangle| {
            let (u, v, w) = (sub(*b, *a), sub(*c, *a), sub(*c, *b));
            let longest = norm(u).max(norm(v)).max(norm(w));
            norm(cross(u, v)) > DEGENERATE * longest * longest && longest > 0.0
        };
        let solid: Vec<Triangle> = all.iter().filter(has_area).copied().collect();
        if solid.is_empty() {
            return Err(MeshError::Empty { found: all.len() });
        }
        let degenerate = all.len() - solid.len();
        // drawings for the screen have each face twice, seen from both sides
        let mut seen = HashSet::new();
        let is_new = |triangle: &Triangle| {
            let mut corners = triangle.map(|corner| key(&corner));
            corners.sort_unstable();
            seen.insert(corners)
        };
        let triangles: Vec<Triangle> = solid.into_iter().filter(is_new).collect();
        let mesh = Self {
            degenerate,
            open_edges: open_edges(&triangles),
            faces_alike: faces_alike(&triangles),
            triangles,
            ..Self::default()
        };
        let size_m = mesh.longest_side_m();
        if !(SMALLEST_M..=LARGEST_M).contains(&size_m) {
            return Err(MeshError::Size { size_m, scale });
        }
        Ok(mesh)
    }

    /// The corner of least coordinates of the box about it, and that of largest, metres.
    #[must_use]
    pub fn bounds(&self) -> [Vector; 2] {
        bounds(&self.triangles)
    }

    /// The longest side of that box, metres.
    #[must_use]
    pub fn longest_side_m(&self) -> f64 {
        side_m(&self.bounds())
    }

    /// Whether a point is inside: an odd number of triangles lies on a ray from it, or, where all
    /// face alike, more are passed from one side than from the other: shells may overlap.
    /// Meaningless where the mesh is open.
    #[must_use]
    pub fn contains(&self, point: Vector) -> bool {
        // a direction that no drawing has: no ray along an edge
        let toward = [0.537_281, 0.712_934, 0.450_623];
        let passes = |[a, b, c]: &Triangle| {
            let (u, v) = (sub(*b, *a), sub(*c, *a));
            let across = cross(toward, v);
            let side = crate::geometry::dot(u, across);
            let by = 1.0 / side;
            let from = sub(point, *a);
            let s = by * crate::geometry::dot(from, across);
            let turned = cross(from, u);
            let t = by * crate::geometry::dot(toward, turned);
            let along = by * crate::geometry::dot(v, turned);
            let is_hit = s >= 0.0 && t >= 0.0 && s + t <= 1.0 && along > 0.0;
            match (is_hit, side > 0.0) {
                (false, _) => 0_i64,
                (true, true) => 1,
                (true, false) => -1,
            }
        };
        let (mut hits, mut sum) = (0_u64, 0_i64);
        for pass in self.triangles.iter().map(passes) {
            hits += pass.unsigned_abs();
            sum += pass;
        }
        hits % 2 == 1 || self.faces_alike && sum != 0
    }
}

#[cfg(feature = "mesh")]
use formats::triangles;

/// No format is read by a library without them.
#[cfg(not(feature = "mesh"))]
fn triangles(_: &str, _: &[u8], _: Neighbour) -> Result<Vec<Triangle>, MeshError> {
    Err(MeshError::NotBuilt)
}

/// The box about triangles: its corner of least coordinates, and that of largest.
fn bounds(triangles: &[Triangle]) -> [Vector; 2] {
    let corners = || triangles.iter().flatten();
    let of = |start: f64, pick: fn(f64, f64) -> f64| {
        std::array::from_fn(|i| corners().map(|c| c[i]).fold(start, pick))
    };
    [of(f64::INFINITY, f64::min), of(f64::NEG_INFINITY, f64::max)]
}

/// The longest side of a box.
fn side_m([low, high]: &[Vector; 2]) -> f64 {
    sub(*high, *low).into_iter().fold(0.0, f64::max)
}

/// A corner to be compared: 0.0 and -0.0 are one place.
fn key(point: &Vector) -> [u64; 3] {
    point.map(|x| (x + 0.0).to_bits())
}

/// Whether each edge is run along as often in one direction as in the other: triangles next to each
/// other then face to the same side.
fn faces_alike(triangles: &[Triangle]) -> bool {
    let mut edges: HashMap<[[u64; 3]; 2], i64> = HashMap::new();
    for triangle in triangles {
        for i in 0..3 {
            let (a, b) = (key(&triangle[i]), key(&triangle[(i + 1) % 3]));
            let (edge, sign) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
            *edges.entry(edge).or_default() += sign;
        }
    }
    edges.values().all(|sum| *sum == 0)
}

/// Edges that an odd number of triangles share; corners are the same where their coordinates are.
fn open_edges(triangles: &[Triangle]) -> usize {
    let mut edges: HashMap<[[u64; 3]; 2], usize> = HashMap::new();
    for triangle in triangles {
        for i in 0..3 {
            let (a, b) = (key(&triangle[i]), key(&triangle[(i + 1) % 3]));
            let edge = if a < b { [a, b] } else { [b, a] };
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges.values().filter(|count| *count % 2 == 1).count()
}

#[cfg(all(test, feature = "mesh"))]
mod tests {
    use super::*;

    fn tetrahedron(scale: f64) -> String {
        let p = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let corner = |i: usize| {
            let [x, y, z]: Vector = p[i];
            format!("vertex {} {} {}\n", x * scale, y * scale, z * scale)
        };
        let face = |f: &[usize; 3]| {
            let corners: String = f.iter().map(|i| corner(*i)).collect();
            format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        };
        let faces: String = faces.iter().map(face).collect();
        format!("solid t\n{faces}endsolid t\n")
    }

    #[test]
    fn a_corner_far_away_is_refused_however_far_it_is() {
        let near = tetrahedron(1000.0);
        for far in ["1e7", "1e10", "1e18", "1e160", "-1e300"] {
            let text = near.replacen("vertex 1000 0 0", &format!("vertex {far} 0 0"), 1);
            assert_ne!(text, near);
            let error = read("t.stl", &text, None).expect_err(far);
            let is_refused = matches!(error, MeshError::Size { .. } | MeshError::NotFinite);
            assert!(is_refused, "{far}: {error}");
        }
    }

    fn read(name: &str, text: &str, scale: Option<f64>) -> Result<Mesh, MeshError> {
        Mesh::read(name, text.as_bytes(), scale.map(|s| [s; 3]), &|_| {
            Err(String::new())
        })
    }

    #[test]
    fn a_closed_stl_in_millimetres_is_read() {
        let mesh = read("t.STL", &tetrahedron(100.0), None).expect("a mesh");
        assert_eq!(
            (mesh.triangles.len(), mesh.degenerate, mesh.open_edges),
            (4, 0, 0)
        );
        assert!(mesh.contains([0.02, 0.02, 0.02]));
        assert!(!mesh.contains([0.09, 0.09, 0.09]));
        assert!(!mesh.contains([-0.01, 0.02, 0.02]));
    }

    /// A box between two corners, and its faces seen from inside, too, where it is double.
    fn block(low: f64, high: f64, is_double: bool) -> Vec<Triangle> {
        let corner = |at: usize| [0, 1, 2].map(|i| if at >> i & 1 == 0 { low } else { high });
        let faces = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let halves = faces
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        let outside: Vec<Triangle> = halves.map(|half| half.map(corner)).collect();
        let inside = outside
            .iter()
            .filter(|_| is_double)
            .map(|&[a, b, c]| [a, c, b]);
        inside.chain(outside.iter().copied()).collect()
    }

    #[test]
    fn what_is_deep_in_a_double_or_overlapping_mesh_is_inside() {
        let (centre, outside) = ([0.03, 0.01, 0.02], [2.0, 0.1, 0.1]);
        let two = [block(-1.0, 0.5, false), block(-0.5, 1.0, false)].concat();
        for triangles in [block(-1.0, 1.0, false), block(-1.0, 1.0, true), two] {
            let mesh = Mesh::of(&triangles, 1.0).expect("a mesh");
            assert_eq!(
                (mesh.contains(centre), mesh.contains(outside)),
                (true, false)
            );
            assert_eq!(mesh.open_edges, 0);
        }
    }

    #[test]
    fn an_obj_with_an_open_and_a_degenerate_face_says_so() {
        let text = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 200 0 0\nf 1 2 3\nf 1 2 4\n";
        let mesh = read("t.obj", text, None).expect("a mesh");
        assert_eq!(
            (mesh.triangles.len(), mesh.degenerate, mesh.open_edges),
            (1, 1, 3)
        );
    }

    #[test]
    fn a_robot_of_2000_m_and_one_of_a_micrometre_are_other_units() {
        let error = read("t.stl", &tetrahedron(2000.0), Some(1000.0)).expect_err("2000 m");
        assert!(error.hint().contains("scale: 1`"), "{}", error.hint());
        let error = read("t.stl", &tetrahedron(0.2), None).expect_err("0.2 mm");
        assert!(error.hint().contains("scale: 1000"), "{}", error.hint());
    }

    #[test]
    fn what_is_no_mesh_is_an_error() {
        for (name, text) in [
            ("a.stl", "solid x"),
            ("a.obj", ""),
            ("a.step", "x"),
            ("a.glb", "glTF"),
            ("a.dae", "<x>"),
        ] {
            assert!(read(name, text, None).is_err(), "{name}");
        }
        let text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n";
        assert_eq!(
            read("t.obj", text, None),
            Err(MeshError::Empty { found: 1 })
        );
    }
}
