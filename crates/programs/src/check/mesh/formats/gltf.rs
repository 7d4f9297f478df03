//! The triangles of a glTF 2.0 file, upright.
//!
//! What its scene shows, with the transforms of its nodes. Every count, offset and index of the
//! file is compared with what is there before it is used; a file that requires an extension
//! (compressed meshes) is refused.
//!
//! # Limits
//! Nodes form a tree, as the format says, of at most 256 levels; 20 million triangles.
//!
//! # Source
//! Khronos, "glTF 2.0 Specification" (ISO/IEC 12113), sections 3.4 (metres, y up), 3.5 (nodes), 3.6
//! (buffers, accessors), 3.7 (meshes) and 4 (GLB).

use super::affine::Affine;
use super::{MOST, Neighbour, Triangle, fan};
use crate::geometry::{Quaternion, Vector};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;
use std::borrow::Cow;
use std::cell::Cell;

/// Nodes below each other.
const DEEPEST: usize = 256;
/// Points and indices of all that is shown.
const MOST_ITEMS: usize = 10 * MOST;
/// Items of an accessor without bytes of its own.
const MOST_ZEROS: usize = 1_000_000;
/// How far from one the square of a quaternion's length may be: written with few digits.
const UNIT: f64 = 1e-2;

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct File {
    scene: usize,
    scenes: Vec<Scene>,
    nodes: Vec<Node>,
    meshes: Vec<Primitives>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<View>,
    buffers: Vec<Buffer>,
    extensions_required: Vec<String>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Scene {
    nodes: Vec<usize>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Node {
    children: Vec<usize>,
    mesh: Option<usize>,
    /// Columns first.
    matrix: Option<[f64; 16]>,
    translation: Option<Vector>,
    /// x, y, z, w.
    rotation: Option<[f64; 4]>,
    scale: Option<Vector>,
}

#[derive(Deserialize)]
struct Primitives {
    primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
struct Primitive {
    attributes: Attributes,
    indices: Option<usize>,
    mode: Option<u64>,
}

#[derive(Deserialize)]
struct Attributes {
    #[serde(rename = "POSITION")]
    position: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: Option<usize>,
    #[serde(default)]
    byte_offset: usize,
    component_type: u32,
    count: usize,
    #[serde(rename = "type")]
    shape: String,
    sparse: Option<Sparse>,
}

/// Some items written over those of the accessor.
#[derive(Deserialize)]
struct Sparse {
    count: usize,
    indices: Part,
    values: Part,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Part {
    buffer_view: usize,
    #[serde(default)]
    byte_offset: usize,
    /// Of indices only.
    component_type: Option<u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
    byte_stride: Option<usize>,
}

#[derive(Deserialize)]
struct Buffer {
    uri: Option<String>,
}

/// A file and the bytes of its buffers.
struct Opened<'a> {
    file: File,
    buffers: Vec<Cow<'a, [u8]>>,
    /// How many items may still be read.
    left: Cell<usize>,
}

/// Triangles of all nodes of the scene, metres, z up.
pub(super) fn read(bytes: &[u8], neighbour: Neighbour) -> Result<Vec<Triangle>, String> {
    let opened = open(bytes, neighbour)?;
    let file = &opened.file;
    let scene = file.scenes.get(file.scene).ok_or_else(|| {
        format!(
            "scene {} of {}: nothing is shown",
            file.scene,
            file.scenes.len()
        )
    })?;
    let mut seen = vec![false; file.nodes.len()];
    let mut nodes: Vec<(usize, Affine, usize)> = Vec::new();
    nodes.extend(
        scene
            .nodes
            .iter()
            .map(|root| (*root, Affine::Z_FROM_Y_UP, 1)),
    );
    let mut triangles = Vec::new();
    while let Some((index, above, depth)) = nodes.pop() {
        let node = at(&file.nodes, index, "node")?;
        if std::mem::replace(&mut seen[index], true) {
            return Err(format!("node {index} has two parents: nodes form a tree"));
        }
        if depth > DEEPEST {
            return Err(format!("nodes are in each other deeper than {DEEPEST}"));
        }
        let world = above.after(&local(node)?);
        if let Some(mesh) = node.mesh {
            for primitive in &at(&file.meshes, mesh, "mesh")?.primitives {
                opened.primitive(primitive, &world, &mut triangles)?;
            }
        }
        nodes.extend(node.children.iter().map(|child| (*child, world, depth + 1)));
    }
    Ok(triangles)
}

fn at<'f, T>(list: &'f [T], index: usize, what: &str) -> Result<&'f T, String> {
    let of = list.len();
    list.get(index)
        .ok_or_else(|| format!("{what} {index} is named; there are {of}, from 0"))
}

fn open<'a>(bytes: &'a [u8], neighbour: Neighbour) -> Result<Opened<'a>, String> {
    let (json, mut binary) = if bytes.starts_with(b"glTF") {
        chunks(bytes)?
    } else {
        (bytes, None)
    };
    let file: File = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    if let [first, ..] = &file.extensions_required[..] {
        return Err(format!(
            "it requires the extension {first}, which is not read: export it without"
        ));
    }
    let mut buffers = Vec::new();
    for buffer in &file.buffers {
        buffers.push(match &buffer.uri {
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
    Ok(Opened {
        file,
        buffers,
        left: Cell::new(MOST_ITEMS),
    })
}

/// The JSON and the binary chunk of a GLB file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let mut rest = bytes.get(12..).ok_or("the header is cut off")?;
    if bytes[4..8] != 2u32.to_le_bytes() {
        return Err("a GLB of another version than 2".into());
    }
    let (mut json, mut binary) = (None, None);
    while let Some((head, data)) = rest.split_first_chunk::<8>() {
        let [l0, l1, l2, l3, kind @ ..] = *head;
        let length = u32::from_le_bytes([l0, l1, l2, l3]) as usize;
        let (data, others) = data.split_at_checked(length).ok_or("a chunk is cut off")?;
        match &kind {
            b"JSON" => json = Some(data),
            b"BIN\0" => binary = Some(data),
            _ => {}
        }
        rest = others;
    }
    Ok((json.ok_or("no JSON chunk")?, binary))
}

impl Opened<'_> {
    fn primitive(
        &self,
        primitive: &Primitive,
        world: &Affine,
        out: &mut Vec<Triangle>,
    ) -> Result<(), String> {
        let mode = primitive.mode.unwrap_or(4);
        let Some(position) = primitive.attributes.position.filter(|_| mode >= 4) else {
            // points and lines touch nothing, nor does what has no place
            return Ok(());
        };
        let points: Vec<Vector> = self.items(position, "VEC3", &[FLOAT])?;
        let points: Vec<Vector> = points.iter().map(|point| world.of(*point)).collect();
        let corners = match primitive.indices {
            None => points,
            Some(indices) => {
                let indices: Vec<[f64; 1]> = self.items(indices, "SCALAR", &WHOLE)?;
                let corner = |[index]: &[f64; 1]| at(&points, index_of(*index), "corner").copied();
                indices.iter().map(corner).collect::<Result<_, _>>()?
            }
        };
        if out.len() + corners.len() > MOST {
            return Err(format!("more than {MOST} triangles"));
        }
        match mode {
            4 if corners.len() % 3 != 0 => {
                return Err(format!("triangles of {} corners", corners.len()));
            }
            4 => out.extend(corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]])),
            5 => out.extend(corners.windows(3).map(|t| [t[0], t[1], t[2]])),
            6 => fan(&corners, out),
            mode => return Err(format!("primitives of mode {mode} are not known")),
        }
        Ok(())
    }

    /// The items of an accessor, which has this shape and one of these types.
    fn items<const N: usize>(
        &self,
        index: usize,
        shape: &str,
        types: &[u32],
    ) -> Result<Vec<[f64; N]>, String> {
        let accessor = at(&self.file.accessors, index, "accessor")?;
        let (count, found) = (accessor.count, accessor.component_type);
        if accessor.shape != shape || !types.contains(&found) {
            return Err(format!(
                "accessor {index} is {} of component type {found}; {shape} of {types:?} is needed",
                accessor.shape
            ));
        }
        let left = self.left.get().checked_sub(count);
        self.left.set(left.ok_or_else(|| {
            format!(
                "accessor {index} has {count} items; all that are shown have at most {MOST_ITEMS}"
            )
        })?);
        let mut items = match accessor.buffer_view {
            Some(view) => self.numbers::<N>(view, accessor.byte_offset, found, count)?,
            None if count > MOST_ZEROS => {
                return Err(format!(
                    "accessor {index} has {count} items without a buffer view; at most {MOST_ZEROS}"
                ));
            }
            // what is sparse without a base begins with zeros
            None => vec![[0.0; N]; count],
        };
        if let Some(sparse) = &accessor.sparse {
            let Sparse {
                count,
                indices,
                values,
            } = sparse;
            let kind = indices.component_type.filter(|kind| WHOLE.contains(kind));
            let kind = kind.ok_or("the indices of a sparse accessor are no whole numbers")?;
            let places =
                self.numbers::<1>(indices.buffer_view, indices.byte_offset, kind, *count)?;
            let values =
                self.numbers::<N>(values.buffer_view, values.byte_offset, found, *count)?;
            for ([place], value) in places.iter().zip(values) {
                let (place, of) = (index_of(*place), items.len());
                *items.get_mut(place).ok_or_else(|| {
                    format!("a sparse accessor writes item {place}; there are {of}, from 0")
                })? = value;
            }
        }
        Ok(items)
    }

    /// `count` items of N numbers from a place in a view.
    fn numbers<const N: usize>(
        &self,
        view: usize,
        first: usize,
        kind: u32,
        count: usize,
    ) -> Result<Vec<[f64; N]>, String> {
        let size = match kind {
            BYTE => 1,
            SHORT => 2,
            _ => 4,
        };
        let number = view;
        let view = at(&self.file.buffer_views, number, "buffer view")?;
        let buffer = at(&self.buffers, view.buffer, "buffer")?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let bytes = end
            .and_then(|end| buffer.get(view.byte_offset..end))
            .and_then(|bytes| bytes.get(first..))
            .ok_or_else(|| format!("buffer view {number} reaches beyond its buffer"))?;
        let stride = view.byte_stride.unwrap_or(N * size);
        if stride < N * size {
            return Err(format!("items of {} bytes are {stride} apart", N * size));
        }
        if count == 0 {
            return Ok(Vec::new());
        }
        let needed = (count - 1)
            .checked_mul(stride)
            .and_then(|last| last.checked_add(N * size));
        if needed.is_none_or(|needed| needed > bytes.len()) {
            return Err(format!(
                "{count} items of {} bytes, {stride} apart, in {} bytes of buffer view {number}",
                N * size,
                bytes.len()
            ));
        }
        let one = |bytes: &[u8]| match (kind, bytes) {
            (BYTE, b) => f64::from(b[0]),
            (SHORT, b) => f64::from(u16::from_le_bytes([b[0], b[1]])),
            (INT, b) => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            (_, b) => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        };
        let item = |item: usize| {
            let bytes = &bytes[item * stride..];
            std::array::from_fn(|part| one(&bytes[part * size..]))
        };
        Ok((0..count).map(item).collect())
    }
}

/// Component types, section 3.6.2.2.
const BYTE: u32 = 5121;
const SHORT: u32 = 5123;
const INT: u32 = 5125;
const FLOAT: u32 = 5126;
/// Those of indices.
const WHOLE: [u32; 3] = [BYTE, SHORT, INT];

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "read from at most 32 bits without a sign"
)]
fn index_of(number: f64) -> usize {
    number as usize
}

fn local(node: &Node) -> Result<Affine, String> {
    if let Some(m) = node.matrix {
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            return Err("the last row of a node's matrix is not 0 0 0 1".into());
        }
        let row = |i: usize| [m[i], m[i + 4], m[i + 8], m[i + 12]];
        return Ok(Affine([row(0), row(1), row(2)]));
    }
    let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let square: f64 = [w, x, y, z].iter().map(|part| part * part).sum();
    if !square.is_finite() || (square - 1.0).abs() >= UNIT {
        return Err(format!(
            "a node's rotation {x}, {y}, {z}, {w} is no unit quaternion"
        ));
    }
    let rotation = Quaternion([w, x, y, z].map(|part| part / square.sqrt())).rotation();
    let place = Affine::translation(node.translation.unwrap_or_default());
    let scale = Affine::scale(node.scale.unwrap_or([1.0; 3]));
    Ok(place.after(&Affine::rotation(rotation.0)).after(&scale))
}

#[cfg(test)]
mod tests;
