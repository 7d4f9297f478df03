//! The triangles of a glTF 2.0 file, upright.
//!
//! What its scene shows, with the transforms of its nodes. The crate gltf-json reads the text;
//! every count, offset and index of it is compared with what is there before it is used. A file
//! that requires an extension (compressed meshes) is refused.
//!
//! # Limits
//! Nodes form a tree, as the format says, of at most 256 levels; 20 million triangles; 10 million
//! values of JSON. The crate keeps what nodes are moved, rotated and scaled by in single precision:
//! 0.0005 mm at ten metres.
//!
//! # Source
//! Khronos, "glTF 2.0 Specification" (ISO/IEC 12113), sections 3.4 (metres, y up), 3.5 (nodes), 3.6
//! (buffers, accessors), 3.7 (meshes) and 4 (GLB).

mod text;

use super::affine::Affine;
use super::{MOST, Neighbour, Triangle, fan};
use crate::geometry::{Quaternion, Vector};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf_json::accessor::ComponentType::{self, F32, U8, U16, U32};
use gltf_json::accessor::sparse::Sparse;
use gltf_json::accessor::{Accessor, IndexComponentType, Type};
use gltf_json::buffer::{Buffer, View};
use gltf_json::mesh::{Mesh, Mode, Primitive, Semantic};
use gltf_json::validation::Checked::{Invalid, Valid};
use gltf_json::validation::USize64;
use gltf_json::{Index, Node, Value};
use serde::Deserialize;
use std::borrow::Cow;
use std::cell::Cell;
use text::{list, values};

/// Nodes below each other.
const DEEPEST: usize = 256;
/// Points and indices of all that is shown.
const MOST_ITEMS: usize = 10 * MOST;
/// Items of an accessor without bytes of its own.
const MOST_ZEROS: usize = 1_000_000;
/// How far from one the square of a quaternion's length may be: written with few digits.
const UNIT: f64 = 1e-2;

#[derive(Deserialize)]
struct Scene {
    /// A scene of nothing may be without.
    #[serde(default)]
    nodes: Vec<Index<Node>>,
}

/// Of a file, what its shapes are made of, and the bytes of its buffers.
struct Opened<'a> {
    nodes: Vec<Node>,
    meshes: Vec<Mesh>,
    accessors: Vec<Accessor>,
    views: Vec<View>,
    buffers: Vec<Cow<'a, [u8]>>,
    /// How many items may still be read.
    left: Cell<usize>,
}

/// Triangles of all nodes of the scene, metres, z up.
pub(super) fn read(bytes: &[u8], neighbour: Neighbour) -> Result<Vec<Triangle>, String> {
    let (opened, scene) = open(bytes, neighbour)?;
    let mut seen = vec![false; opened.nodes.len()];
    let roots = scene.nodes.iter();
    let mut nodes: Vec<_> = roots.map(|root| (root, Affine::Z_FROM_Y_UP, 1)).collect();
    let mut triangles = Vec::new();
    while let Some((index, above, depth)) = nodes.pop() {
        let node = at(&opened.nodes, index.value(), "node")?;
        if std::mem::replace(&mut seen[index.value()], true) {
            return Err(format!("node {index} has two parents: nodes form a tree"));
        }
        if depth > DEEPEST {
            return Err(format!("nodes are in each other deeper than {DEEPEST}"));
        }
        let world = above.after(&local(node)?);
        if let Some(mesh) = node.mesh {
            if node.skin.is_some() {
                return Err("a skin bends a mesh, which is not read: export it without".into());
            }
            let mesh = at(&opened.meshes, mesh.value(), "mesh")?;
            let weights = node.weights.as_ref().or(mesh.weights.as_ref());
            if weights.is_some_and(|weights| weights.iter().any(|weight| *weight != 0.0)) {
                let message = "weights of morph targets change a mesh, which is not read: export it \
                    without";
                return Err(message.into());
            }
            for primitive in &mesh.primitives {
                opened.primitive(primitive, &world, &mut triangles)?;
            }
        }
        let children = node.children.iter().flatten();
        nodes.extend(children.map(|child| (child, world, depth + 1)));
    }
    Ok(triangles)
}

fn at<'f, T>(list: &'f [T], index: usize, what: &str) -> Result<&'f T, String> {
    let of = list.len();
    list.get(index)
        .ok_or_else(|| format!("{what} {index} is named; there are {of}, from 0"))
}

/// A file and its scene.
fn open<'a>(bytes: &'a [u8], neighbour: Neighbour) -> Result<(Opened<'a>, Scene), String> {
    let (mut file, mut binary) = values(bytes)?;
    if let [first, ..] = &list::<String>(&mut file, "extensionsRequired")?[..] {
        return Err(format!(
            "it requires the extension {first}, which is not read: export it without"
        ));
    }
    let index = file.get("scene").map_or(Some(0), Value::as_u64);
    let index = index.and_then(|index| usize::try_from(index).ok());
    let index = index.ok_or("its scene is no index")?;
    let mut scenes: Vec<Scene> = list(&mut file, "scenes")?;
    at(&scenes, index, "scene").map_err(|error| error + ": nothing is shown")?;
    let mut buffers = Vec::new();
    for buffer in list::<Buffer>(&mut file, "buffers")? {
        buffers.push(match buffer.uri.as_deref() {
            None => binary.take().ok_or("a buffer has no data")?.into(),
            Some(uri) => match uri.split_once(";base64,") {
                Some((start, text)) if start.starts_with("data:") => STANDARD
                    .decode(text)
                    .map_err(|error| format!("a buffer is not base64: {error}"))?
                    .into(),
                _ => neighbour(uri)
                    .map_err(|error| format!("cannot read its buffer `{uri}`: {error}"))?
                    .into(),
            },
        });
    }
    let opened = Opened {
        nodes: list(&mut file, "nodes")?,
        meshes: list(&mut file, "meshes")?,
        accessors: list(&mut file, "accessors")?,
        views: list(&mut file, "bufferViews")?,
        buffers,
        left: Cell::new(MOST_ITEMS),
    };
    Ok((opened, scenes.swap_remove(index)))
}

impl Opened<'_> {
    fn primitive(
        &self,
        primitive: &Primitive,
        world: &Affine,
        out: &mut Vec<Triangle>,
    ) -> Result<(), String> {
        let position = primitive.attributes.get(&Valid(Semantic::Positions));
        let (mode, position) = match (primitive.mode, position) {
            // points and lines touch nothing, nor does what has no place
            (Valid(Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip), _)
            | (_, None) => return Ok(()),
            (Invalid, _) => return Err("primitives of a mode that is not known".into()),
            (Valid(mode), Some(position)) => (mode, *position),
        };
        let mut points = self.items(position, Type::Vec3, &[F32], point)?;
        for point in &mut points {
            *point = world.of(*point);
        }
        let corners = match primitive.indices {
            None => points,
            Some(indices) => {
                let indices = self.items(indices, Type::Scalar, &[U8, U16, U32], whole)?;
                let corner = |index: &usize| at(&points, *index, "corner").copied();
                indices.iter().map(corner).collect::<Result<_, _>>()?
            }
        };
        let more = match mode {
            Mode::Triangles => corners.len() / 3,
            _ => corners.len(),
        };
        if out.len() + more > MOST {
            return Err(format!("more than {MOST} triangles"));
        }
        match mode {
            Mode::TriangleStrip => out.extend(corners.windows(3).map(|t| [t[0], t[1], t[2]])),
            Mode::TriangleFan => fan(&corners, out),
            _ if corners.len() % 3 != 0 => {
                return Err(format!("triangles of {} corners", corners.len()));
            }
            _ => out.extend(corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]])),
        }
        Ok(())
    }

    /// The items of an accessor, which has this shape and one of these types.
    fn items<T: Clone + Default>(
        &self,
        index: Index<Accessor>,
        shape: Type,
        types: &[ComponentType],
        read: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, String> {
        let accessor = at(&self.accessors, index.value(), "accessor")?;
        let kind = match (accessor.type_, accessor.component_type) {
            (Valid(found), Valid(kind)) if found == shape && types.contains(&kind.0) => kind.0,
            (found, kind) => {
                return Err(format!(
                    "accessor {index} is {} of component type {}; {} of {} is needed",
                    written(&found),
                    written(&kind),
                    written(&shape),
                    written(&types)
                ));
            }
        };
        let (count, item) = (size(accessor.count), kind.size() * shape.multiplicity());
        let left = self.left.get().checked_sub(count);
        self.left.set(left.ok_or_else(|| {
            format!(
                "accessor {index} has {count} items; all that are shown have at most {MOST_ITEMS}"
            )
        })?);
        let mut items: Vec<T> = match accessor.buffer_view {
            Some(view) => {
                let first = accessor.byte_offset.unwrap_or_default();
                self.bytes(view, first, item, count)?.map(&read).collect()
            }
            None if count > MOST_ZEROS => {
                return Err(format!(
                    "accessor {index} has {count} items without a buffer view; at most {MOST_ZEROS}"
                ));
            }
            // what is sparse without a base begins with zeros
            None => vec![T::default(); count],
        };
        if let Some(Sparse {
            count,
            indices,
            values,
            ..
        }) = &accessor.sparse
        {
            let Valid(IndexComponentType(kind)) = indices.component_type else {
                return Err("the indices of a sparse accessor are no whole numbers".into());
            };
            let count = size(*count);
            let places =
                self.bytes(indices.buffer_view, indices.byte_offset, kind.size(), count)?;
            let values = self.bytes(values.buffer_view, values.byte_offset, item, count)?;
            for (place, value) in places.map(whole).zip(values) {
                let of = items.len();
                *items.get_mut(place).ok_or_else(|| {
                    format!("a sparse accessor writes item {place}; there are {of}, from 0")
                })? = read(value);
            }
        }
        Ok(items)
    }

    /// The bytes of each of `count` items of so many bytes, from a place in a view on.
    fn bytes(
        &self,
        number: Index<View>,
        first: USize64,
        item: usize,
        count: usize,
    ) -> Result<impl Iterator<Item = &[u8]>, String> {
        let view = at(&self.views, number.value(), "buffer view")?;
        let buffer = at(&self.buffers, view.buffer.value(), "buffer")?;
        let start = size(view.byte_offset.unwrap_or_default());
        let bytes = start
            .checked_add(size(view.byte_length))
            .and_then(|end| buffer.get(start..end))
            .and_then(|bytes| bytes.get(size(first)..))
            .ok_or_else(|| format!("buffer view {number} reaches beyond its buffer"))?;
        let stride = view.byte_stride.map_or(item, |stride| stride.0);
        if stride < item {
            return Err(format!("items of {item} bytes are {stride} apart"));
        }
        let last = count.saturating_sub(1).checked_mul(stride);
        let needed = last.and_then(|last| last.checked_add(item));
        if count > 0 && needed.is_none_or(|needed| needed > bytes.len()) {
            return Err(format!(
                "{count} items of {item} bytes, {stride} apart, in {} bytes of buffer view \
                 {number}",
                bytes.len()
            ));
        }
        Ok(bytes
            .chunks(stride)
            .take(count)
            .map(move |bytes| &bytes[..item]))
    }
}

/// As it stands in a file.
fn written(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|_| "unknown".into())
}

/// As a count or place in memory; what is longer is in no buffer.
fn size(number: USize64) -> usize {
    usize::try_from(number.0).unwrap_or(usize::MAX)
}

/// Of 1, 2 or 4 bytes.
fn whole(bytes: &[u8]) -> usize {
    let mut all = [0; 4];
    all[..bytes.len()].copy_from_slice(bytes);
    u32::from_le_bytes(all) as usize
}

/// Of 12 bytes.
fn point(bytes: &[u8]) -> Vector {
    let (numbers, _) = bytes.as_chunks();
    std::array::from_fn(|i| f32::from_le_bytes(numbers[i]).into())
}

fn local(node: &Node) -> Result<Affine, String> {
    if let Some(m) = node.matrix.map(|m| m.map(f64::from)) {
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            return Err("the last row of a node's matrix is not 0 0 0 1".into());
        }
        let row = |i: usize| [m[i], m[i + 4], m[i + 8], m[i + 12]];
        return Ok(Affine([row(0), row(1), row(2)]));
    }
    let [x, y, z, w] = node.rotation.unwrap_or_default().0.map(f64::from);
    let square: f64 = [w, x, y, z].iter().map(|part| part * part).sum();
    if !square.is_finite() || (square - 1.0).abs() >= UNIT {
        return Err(format!(
            "a node's rotation {x}, {y}, {z}, {w} is no unit quaternion"
        ));
    }
    let rotation = Quaternion([w, x, y, z].map(|part| part / square.sqrt())).rotation();
    let place = Affine::translation(node.translation.unwrap_or_default().map(f64::from));
    let scale = Affine::scale(node.scale.unwrap_or([1.0; 3]).map(f64::from));
    Ok(place.after(&Affine::rotation(rotation.0)).after(&scale))
}

#[cfg(test)]
mod tests;
