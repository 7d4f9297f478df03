//! The triangles of a glTF 2.0 file.
//!
//! # Source
//! Khronos, "glTF 2.0 Specification" (ISO/IEC 12113), sections 3.6 (buffers, accessors), 3.7 (meshes) and 4 (GLB).

use crate::geometry::Vector;
use serde_json::Value;

type Matrix = [[f64; 4]; 4];

/// Nodes below each other; a file with more is broken or turns in a circle.
const DEEPEST: usize = 64;
/// Most triangles that are taken.
const MOST: usize = 20_000_000;

struct File<'a> {
    json: Value,
    buffers: Vec<std::borrow::Cow<'a, [u8]>>,
}

/// Triangles of all nodes of the scene, in the file's units.
pub(super) fn read(
    bytes: &[u8],
    beside: &dyn Fn(&str) -> Option<Vec<u8>>,
) -> Result<Vec<[Vector; 3]>, String> {
    let file = open(bytes, beside)?;
    let mut triangles = Vec::new();
    let scene = file.json["scene"].as_u64().unwrap_or(0);
    let roots = &file.json["scenes"][index(scene)?]["nodes"];
    let roots = roots.as_array().ok_or("no scene with nodes")?;
    let mut identity = [[0.0; 4]; 4];
    for (i, row) in identity.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for root in roots {
        file.node(root, &identity, 0, &mut triangles)?;
    }
    Ok(triangles)
}

fn index(value: u64) -> Result<usize, String> {
    usize::try_from(value).map_err(|_| "an index is too large".to_owned())
}

fn open<'a>(bytes: &'a [u8], beside: &dyn Fn(&str) -> Option<Vec<u8>>) -> Result<File<'a>, String> {
    let (json, mut binary) = if bytes.starts_with(b"glTF") {
        chunks(bytes)?
    } else {
        (bytes, None)
    };
    let json: Value = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    let mut buffers = Vec::new();
    for buffer in json["buffers"].as_array().unwrap_or(&Vec::new()) {
        let data: std::borrow::Cow<'a, [u8]> = match buffer["uri"].as_str() {
            None => binary.take().ok_or("a buffer has no data")?.into(),
            Some(uri) => match uri.split_once(";base64,") {
                Some((start, text)) if start.starts_with("data:") => base64(text)?.into(),
                _ => beside(uri)
                    .ok_or_else(|| format!("cannot read the buffer `{uri}` beside it"))?
                    .into(),
            },
        };
        buffers.push(data);
    }
    Ok(File { json, buffers })
}

/// The JSON and the binary chunk of a GLB file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let mut rest = bytes.get(12..).ok_or("the header is cut off")?;
    let (mut json, mut binary) = (None, None);
    while rest.len() >= 8 {
        let length = u32::from_le_bytes([rest[0], rest[1], rest[2], rest[3]]) as usize;
        let data = rest.get(8..8 + length).ok_or("a chunk is cut off")?;
        match &rest[4..8] {
            b"JSON" => json = Some(data),
            b"BIN\0" => binary = Some(data),
            _ => {}
        }
        rest = &rest[8 + length..];
    }
    Ok((json.ok_or("no JSON chunk")?, binary))
}

fn base64(text: &str) -> Result<Vec<u8>, String> {
    let mut out = Vec::with_capacity(text.len() * 3 / 4);
    let (mut bits, mut count) = (0u32, 0);
    for byte in text
        .bytes()
        .filter(|b| !b.is_ascii_whitespace() && *b != b'=')
    {
        let six = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return Err("a buffer is not base64".into()),
        };
        bits = (bits << 6) | u32::from(six);
        count += 6;
        if count >= 8 {
            count -= 8;
            out.push((bits >> count & 0xff).to_le_bytes()[0]);
        }
    }
    Ok(out)
}

impl File<'_> {
    fn node(
        &self,
        id: &Value,
        world: &Matrix,
        depth: usize,
        out: &mut Vec<[Vector; 3]>,
    ) -> Result<(), String> {
        let id = id.as_u64().ok_or("a node's index is no number")?;
        let node = &self.json["nodes"][index(id)?];
        if !node.is_object() || depth > DEEPEST {
            return Err("a node is missing, or the nodes turn in a circle".into());
        }
        let world = product(world, &local(node)?);
        if let Some(mesh) = node["mesh"].as_u64() {
            let primitives = &self.json["meshes"][index(mesh)?]["primitives"];
            for primitive in primitives.as_array().ok_or("a mesh has no primitives")? {
                self.primitive(primitive, &world, out)?;
            }
        }
        for child in node["children"].as_array().unwrap_or(&Vec::new()) {
            self.node(child, &world, depth + 1, out)?;
        }
        Ok(())
    }

    fn primitive(
        &self,
        primitive: &Value,
        world: &Matrix,
        out: &mut Vec<[Vector; 3]>,
    ) -> Result<(), String> {
        match primitive["mode"].as_u64().unwrap_or(4) {
            // points and lines touch nothing
            0..=3 => return Ok(()),
            4 => {}
            mode => {
                return Err(format!(
                    "triangle strips and fans (mode {mode}) are not read"
                ));
            }
        }
        let flat = self.numbers(&primitive["attributes"]["POSITION"])?;
        let points: Vec<Vector> = flat
            .chunks_exact(3)
            .map(|p| {
                std::array::from_fn(|i| {
                    world[i][0] * p[0] + world[i][1] * p[1] + world[i][2] * p[2] + world[i][3]
                })
            })
            .collect();
        let indices: Vec<usize> = if primitive["indices"].is_null() {
            (0..points.len()).collect()
        } else {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            self.numbers(&primitive["indices"])?
                .iter()
                .map(|i| *i as usize)
                .collect()
        };
        if out.len() + indices.len() / 3 > MOST {
            return Err(format!("more than {MOST} triangles"));
        }
        for face in indices.chunks_exact(3) {
            let corner = |i: usize| points.get(i).copied().ok_or("a face names no corner");
            out.push([corner(face[0])?, corner(face[1])?, corner(face[2])?]);
        }
        Ok(())
    }

    /// The numbers of an accessor, one after another.
    fn numbers(&self, accessor: &Value) -> Result<Vec<f64>, String> {
        let id = accessor
            .as_u64()
            .ok_or("an accessor's index is no number")?;
        let accessor = &self.json["accessors"][index(id)?];
        let number = |value: &Value| value.as_u64().map_or(Ok(0), index);
        let wide = match accessor["type"].as_str() {
            Some("SCALAR") => 1,
            Some("VEC3") => 3,
            other => return Err(format!("an accessor of type {other:?} is not read")),
        };
        let kind = accessor["componentType"].as_u64().unwrap_or(0);
        let size = match kind {
            5121 => 1,
            5123 => 2,
            5125 | 5126 => 4,
            _ => return Err(format!("component type {kind} is not read")),
        };
        let id = accessor["bufferView"]
            .as_u64()
            .ok_or("sparse accessors are not read")?;
        let view = &self.json["bufferViews"][index(id)?];
        let buffer = self
            .buffers
            .get(number(&view["buffer"])?)
            .ok_or("a buffer is missing")?;
        let start = number(&view["byteOffset"])?.saturating_add(number(&accessor["byteOffset"])?);
        let stride = match number(&view["byteStride"])? {
            0 => wide * size,
            stride => stride,
        };
        let count = number(&accessor["count"])?;
        let end = count
            .checked_sub(1)
            .and_then(|last| last.checked_mul(stride))
            .and_then(|last| last.checked_add(start + wide * size));
        if count > 0 && end.is_none_or(|end| end > buffer.len()) {
            return Err("an accessor reaches beyond its buffer".into());
        }
        let mut out = Vec::with_capacity(count * wide);
        for item in 0..count {
            for part in 0..wide {
                let at = start + item * stride + part * size;
                let b = &buffer[at..at + size];
                out.push(match kind {
                    5121 => f64::from(b[0]),
                    5123 => f64::from(u16::from_le_bytes([b[0], b[1]])),
                    5125 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
                    _ => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
                });
            }
        }
        Ok(out)
    }
}

fn floats<const N: usize>(value: &Value, otherwise: [f64; N]) -> Result<[f64; N], String> {
    let Some(list) = value.as_array() else {
        return Ok(otherwise);
    };
    let numbers: Option<Vec<f64>> = list.iter().map(Value::as_f64).collect();
    let numbers = numbers.and_then(|n| n.try_into().ok());
    numbers.ok_or_else(|| "a node's transform is not made of numbers".to_owned())
}

fn local(node: &Value) -> Result<Matrix, String> {
    if node["matrix"].is_array() {
        let m = floats::<16>(&node["matrix"], [0.0; 16])?;
        // columns first
        return Ok(std::array::from_fn(|r| {
            std::array::from_fn(|c| m[4 * c + r])
        }));
    }
    let t = floats(&node["translation"], [0.0; 3])?;
    let [x, y, z, w] = floats(&node["rotation"], [0.0, 0.0, 0.0, 1.0])?;
    let s = floats(&node["scale"], [1.0; 3])?;
    let rotation = crate::geometry::Quaternion([w, x, y, z]).rotation().0;
    let mut out = [[0.0, 0.0, 0.0, 1.0]; 4];
    for r in 0..3 {
        for c in 0..3 {
            out[r][c] = rotation[r][c] * s[c];
        }
        out[r][3] = t[r];
    }
    out[3][..3].fill(0.0);
    Ok(out)
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|r| std::array::from_fn(|c| (0..4).map(|k| a[r][k] * b[k][c]).sum()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_in_a_moved_node_is_read_from_base64_and_from_a_glb() {
        let mut data = Vec::new();
        for number in [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
            data.extend(number.to_le_bytes());
        }
        let json = |uri: &str| {
            format!(
                r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
                "nodes":[{{"children":[1],"translation":[0,0,2]}},{{"mesh":0,"scale":[2,2,2]}}],
                "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
                "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
                "bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{{uri}"byteLength":36}}]}}"#
            )
        };
        let expected = [[[0.0, 0.0, 2.0], [2.0, 0.0, 2.0], [0.0, 2.0, 2.0]]];
        let text = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
        let inline = json(&format!(
            r#""uri":"data:application/octet-stream;base64,{text}","#
        ));
        assert_eq!(read(inline.as_bytes(), &|_| None).expect("glTF"), expected);
        let named = json(r#""uri":"t.bin","#);
        assert_eq!(
            read(named.as_bytes(), &|name| (name == "t.bin")
                .then(|| data.clone()))
            .expect("glTF"),
            expected
        );
        assert!(read(named.as_bytes(), &|_| None).is_err());
        let mut glb = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
        for (kind, chunk) in [(b"JSON", json("").into_bytes()), (b"BIN\0", data.clone())] {
            glb.extend(u32::try_from(chunk.len()).expect("short").to_le_bytes());
            glb.extend(kind);
            glb.extend(chunk);
        }
        assert_eq!(read(&glb, &|_| None).expect("GLB"), expected);
        glb.truncate(glb.len() - 10);
        assert!(read(&glb, &|_| None).is_err());
    }
}
