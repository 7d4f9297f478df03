//! The triangles of a COLLADA file, at its true size and upright.
//!
//! The geometries that the file's scene shows, with the transforms of its nodes; `unit` makes
//! metres of them, and what `up_axis` names points along z. Polygons are cut into fans about their
//! first corner: all of their area is covered.
//!
//! # Limits
//! Elements in each other as XML is read, as many nodes in each other through references, 100 000
//! nodes shown, 20 million triangles. Skins, splines, `lookat` and `skew` are errors.
//!
//! # Source
//! Khronos, "COLLADA – Digital Asset Schema Release 1.4.1" (and 1.5.0), chapter 5: `asset`, `node`,
//! `geometry`, `mesh`, `source`, `accessor`, `triangles`, `polylist`, `polygons`, `tristrips`,
//! `trifans`.

use super::affine::Affine;
use super::polygons::cut;
use super::{MOST, Triangle, fan};
use crate::geometry::Vector;
use crate::geometry::units::DEG;
use crate::xml::{self, Element, XmlError};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Nodes in each other, those that others name included.
const DEEPEST: usize = 256;
/// Nodes that a scene shows, with what stands in them.
const MOST_NODES: usize = 100_000;

struct Document<'e, 'a> {
    root: &'e Element<'a>,
    /// Elements by their names and ids.
    by_id: HashMap<(&'e str, &'e str), &'e Element<'a>>,
}

/// Triangles of all that the scene shows, metres, z up.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| format!("not UTF-8: {error}"))?;
    let root = xml::read(text).map_err(|error| error.to_string())?;
    triangles(&root).map_err(|error| error.to_string())
}

fn triangles(root: &Element) -> Result<Vec<Triangle>, XmlError> {
    if root.name != "COLLADA" {
        let message = format!("the file is a <{}>, not a <COLLADA>", root.name);
        return Err(root.fault(message));
    }
    let document = Document::of(root);
    let place = placing(root)?;
    let mut shown = document.scene()?;
    for triangle in &mut shown {
        *triangle = triangle.map(|corner| place.of(corner));
    }
    Ok(shown)
}

/// From the file's units and axes to metres and z up.
fn placing(root: &Element) -> Result<Affine, XmlError> {
    let asset = root.first("asset");
    let of_asset = |name: &str| asset.and_then(|asset| asset.first(name));
    let metres = match of_asset("unit").and_then(|unit| Some((unit, unit.attribute("meter")?))) {
        None => 1.0,
        Some((unit, text)) => match text.trim().parse::<f64>() {
            Ok(metres) if metres > 0.0 && metres.is_finite() => metres,
            _ => return Err(unit.fault(format!("the unit of `{text}` m is no length"))),
        },
    };
    let upright = match of_asset("up_axis").map(|axis| (axis, axis.text.trim())) {
        None | Some((_, "Y_UP")) => Affine::Z_FROM_Y_UP,
        Some((_, "Z_UP")) => Affine::IDENTITY,
        Some((_, "X_UP")) => Affine::Z_FROM_X_UP,
        Some((axis, other)) => {
            let message = format!("the up axis is `{other}`; X_UP, Y_UP and Z_UP are known");
            return Err(axis.fault(message));
        }
    };
    Ok(upright.after(&Affine::scale([metres; 3])))
}

impl<'e, 'a> Document<'e, 'a> {
    fn of(root: &'e Element<'a>) -> Self {
        let mut by_id = HashMap::new();
        let mut open = vec![root];
        while let Some(element) = open.pop() {
            if let Some(id) = element.attribute("id") {
                by_id.insert((element.name.as_str(), id), element);
            }
            open.extend(&element.children);
        }
        Self { root, by_id }
    }

    /// The element that an attribute of another one names.
    fn named(
        &self,
        by: &'e Element<'a>,
        attribute: &str,
        name: &'static str,
    ) -> Result<&'e Element<'a>, XmlError> {
        let Some(url) = by.attribute(attribute) else {
            return Err(by.fault(format!("<{}> has no `{attribute}`", by.name)));
        };
        let found = url.strip_prefix('#').and_then(|id| {
            let id = self.by_id.get_key_value(&(name, id));
            id.map(|(_, element)| *element)
        });
        found.ok_or_else(|| by.fault(format!("there is no <{name}> `{url}` in this file")))
    }

    fn scene(&self) -> Result<Vec<Triangle>, XmlError> {
        let instance = self.root.first("scene");
        let instance = instance.and_then(|scene| scene.first("instance_visual_scene"));
        let Some(instance) = instance else {
            let message = "no <scene> with an <instance_visual_scene>: nothing is shown";
            return Err(self.root.fault(message));
        };
        let scene = self.named(instance, "url", "visual_scene")?;
        let mut open: Vec<(&Element, Affine, usize)> = Vec::new();
        open.extend(scene.all("node").map(|node| (node, Affine::IDENTITY, 1)));
        let mut geometries: HashMap<*const Element, Vec<Triangle>> = HashMap::new();
        let (mut out, mut nodes) = (Vec::new(), 0);
        while let Some((node, above, depth)) = open.pop() {
            nodes += 1 + node.children.len();
            if nodes > MOST_NODES || depth > DEEPEST {
                return Err(node.fault(format!(
                    "more than {MOST_NODES} nodes, or {DEEPEST} in each other: do nodes name each \
                     other in a circle?"
                )));
            }
            let world = above.after(&local(node)?);
            for child in &node.children {
                match child.name.as_str() {
                    "node" => open.push((child, world, depth + 1)),
                    "instance_node" => {
                        open.push((self.named(child, "url", "node")?, world, depth + 1));
                    }
                    "instance_geometry" => {
                        let geometry = self.named(child, "url", "geometry")?;
                        let known = geometries.entry(std::ptr::from_ref(geometry));
                        let triangles = match known {
                            Entry::Occupied(known) => known.into_mut(),
                            Entry::Vacant(new) => new.insert(self.geometry(geometry)?),
                        };
                        if out.len() + triangles.len() > MOST {
                            return Err(child.fault(format!("more than {MOST} triangles")));
                        }
                        out.extend(triangles.iter().map(|t| t.map(|corner| world.of(corner))));
                    }
                    "instance_controller" => {
                        let message = "a skin bends a mesh, which is not read: export it without";
                        return Err(child.fault(message));
                    }
                    _ => {}
                }
            }
        }
        Ok(out)
    }

    fn geometry(&self, geometry: &'e Element<'a>) -> Result<Vec<Triangle>, XmlError> {
        let mesh = geometry
            .first("mesh")
            .or_else(|| geometry.first("convex_mesh"));
        let Some(mesh) = mesh else {
            return Err(geometry.fault("a geometry that is no mesh: export triangles"));
        };
        let mut out = Vec::new();
        // the points of each <vertices>
        let mut points: HashMap<*const Element, Vec<Vector>> = HashMap::new();
        for primitive in &mesh.children {
            let name = primitive.name.as_str();
            if !["triangles", "polylist", "polygons", "tristrips", "trifans"].contains(&name) {
                continue;
            }
            let mut stride = 0;
            let mut vertex = None;
            for input in primitive.all("input") {
                let offset = whole(input, input.attribute("offset").unwrap_or("0"))?;
                stride = stride.max(offset.saturating_add(1));
                if input.attribute("semantic") == Some("VERTEX") {
                    vertex = Some((input, offset));
                }
            }
            let Some((input, offset)) = vertex else {
                return Err(primitive.fault(format!("<{name}> has no input VERTEX")));
            };
            let vertices = self.named(input, "source", "vertices")?;
            let points = match points.entry(std::ptr::from_ref(vertices)) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(new) => new.insert(self.points(vertices)?),
            };
            let corners = Corners {
                points,
                stride,
                offset,
            };
            corners.primitive(primitive, &mut out)?;
        }
        Ok(out)
    }

    /// The points that <vertices> name.
    fn points(&self, vertices: &'e Element<'a>) -> Result<Vec<Vector>, XmlError> {
        let mut inputs = vertices.all("input");
        let position = inputs.find(|input| input.attribute("semantic") == Some("POSITION"));
        let Some(position) = position else {
            return Err(vertices.fault("<vertices> has no input POSITION"));
        };
        let source = self.named(position, "source", "source")?;
        let accessor = source
            .first("technique_common")
            .and_then(|technique| technique.first("accessor"));
        let Some(accessor) = accessor else {
            return Err(source.fault("a source without an <accessor>"));
        };
        let array = self.named(accessor, "source", "float_array")?;
        let numbers: Vec<f64> = array
            .text
            .split_ascii_whitespace()
            .map(|word| number(array, word))
            .collect::<Result<_, _>>()?;
        let of = |name: &str, otherwise: &'static str| {
            whole(accessor, accessor.attribute(name).unwrap_or(otherwise))
        };
        let (count, stride, first) = (of("count", "0")?, of("stride", "1")?, of("offset", "0")?);
        let end = count
            .checked_mul(stride)
            .and_then(|length| length.checked_add(first));
        if stride < 3 || end.is_none_or(|end| end > numbers.len()) {
            return Err(accessor.fault(format!(
                "{count} points of {stride} numbers from number {first} on, of {} numbers",
                numbers.len()
            )));
        }
        let own = &numbers[first..first + count * stride];
        Ok(own
            .chunks_exact(stride)
            .map(|p| [p[0], p[1], p[2]])
            .collect())
    }
}

/// What the indices of a primitive mean.
struct Corners<'p> {
    points: &'p [Vector],
    /// Numbers of a corner.
    stride: usize,
    /// Which of them is its point.
    offset: usize,
}

impl Corners<'_> {
    fn primitive(&self, primitive: &Element, out: &mut Vec<Triangle>) -> Result<(), XmlError> {
        let before = out.len();
        self.faces(primitive, out)?;
        // it counts what it has: triangles, else polygons, fans or strips, of which each is one at
        // least
        let found = out.len() - before;
        match primitive.attribute("count") {
            Some(word) if whole(primitive, word)? > found => Err(primitive.fault(format!(
                "it is cut off, or its polygons have no area: count is {word}, and there are \
                 {found} triangles"
            ))),
            _ => Ok(()),
        }
    }

    fn faces(&self, primitive: &Element, out: &mut Vec<Triangle>) -> Result<(), XmlError> {
        match primitive.name.as_str() {
            "triangles" => {
                for list in primitive.all("p") {
                    let corners = self.of(list)?;
                    if corners.len() % 3 != 0 {
                        let message = format!("triangles of {} corners", corners.len());
                        return Err(list.fault(message));
                    }
                    out.extend(corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]));
                }
            }
            "polylist" => {
                let counts = primitive.first("vcount");
                let words = counts.map_or("", |counts| &counts.text);
                let counts: Vec<usize> = words
                    .split_ascii_whitespace()
                    .map(|word| whole(primitive, word))
                    .collect::<Result<_, _>>()?;
                let list = primitive.first("p");
                let corners = list.map_or(Ok(Vec::new()), |list| self.of(list))?;
                let all: Option<usize> =
                    counts.iter().try_fold(0usize, |all, n| all.checked_add(*n));
                if all != Some(corners.len()) {
                    return Err(primitive.fault(format!(
                        "the polygons of <vcount> have not the {} corners of <p>",
                        corners.len()
                    )));
                }
                let mut rest = corners.as_slice();
                for count in counts {
                    let (polygon, others) = rest.split_at(count);
                    put(polygon, out);
                    rest = others;
                }
            }
            "polygons" => {
                // holes are filled
                let plain = primitive.all("p");
                let holed = primitive.all("ph").filter_map(|holed| holed.first("p"));
                for list in plain.chain(holed) {
                    put(&self.of(list)?, out);
                }
            }
            "trifans" => {
                for list in primitive.all("p") {
                    fan(&self.of(list)?, out);
                }
            }
            _ => {
                for list in primitive.all("p") {
                    out.extend(self.of(list)?.windows(3).map(|t| [t[0], t[1], t[2]]));
                }
            }
        }
        Ok(())
    }

    /// The points of a list of indices.
    fn of(&self, list: &Element) -> Result<Vec<Vector>, XmlError> {
        let indices: Vec<usize> = list
            .text
            .split_ascii_whitespace()
            .map(|word| whole(list, word))
            .collect::<Result<_, _>>()?;
        if !indices.len().is_multiple_of(self.stride) {
            return Err(list.fault(format!(
                "{} indices are no corners of {} each",
                indices.len(),
                self.stride
            )));
        }
        let point = |corner: &[usize]| {
            let index = corner[self.offset];
            self.points.get(index).copied().ok_or_else(|| {
                let of = self.points.len();
                list.fault(format!(
                    "a face names corner {index}; there are {of}, from 0"
                ))
            })
        };
        indices.chunks_exact(self.stride).map(point).collect()
    }
}

fn whole(element: &Element, word: &str) -> Result<usize, XmlError> {
    let number = word.trim().parse();
    number.map_err(|_| element.fault(format!("`{word}` is no index or count")))
}

fn number(element: &Element, word: &str) -> Result<f64, XmlError> {
    let number = word.parse();
    number.map_err(|_| element.fault(format!("`{word}` is no number")))
}

fn numbers<const N: usize>(element: &Element) -> Result<[f64; N], XmlError> {
    let words = element.text.split_ascii_whitespace();
    let all: Vec<f64> = words
        .map(|word| number(element, word))
        .collect::<Result<_, _>>()?;
    let found = all.len();
    all.try_into()
        .map_err(|_| element.fault(format!("<{}> has {N} numbers, here {found}", element.name)))
}

/// The transforms of a node, the last of them first on a point.
fn local(node: &Element) -> Result<Affine, XmlError> {
    let mut out = Affine::IDENTITY;
    for child in &node.children {
        let step = match child.name.as_str() {
            "matrix" => {
                let m = numbers::<16>(child)?;
                if m[12..] != [0.0, 0.0, 0.0, 1.0] {
                    return Err(child.fault("the last row of a <matrix> is not 0 0 0 1"));
                }
                let row = |i: usize| [m[i], m[i + 1], m[i + 2], m[i + 3]];
                Affine([row(0), row(4), row(8)])
            }
            "translate" => Affine::translation(numbers(child)?),
            "scale" => Affine::scale(numbers(child)?),
            "rotate" => {
                let [x, y, z, degrees] = numbers::<4>(child)?;
                let long = x.hypot(y).hypot(z);
                // an axis without length rotates by nothing, if the angle is none
                if long == 0.0 && degrees != 0.0 {
                    return Err(child.fault("a <rotate> about no axis"));
                }
                let long = if long > 0.0 { long } else { 1.0 };
                let (sine, cosine) = (0.5 * degrees * DEG).sin_cos();
                let [x, y, z] = [x, y, z].map(|part| part / long * sine);
                let rotation = crate::geometry::Quaternion([cosine, x, y, z]).rotation();
                Affine::rotation(rotation.0)
            }
            "lookat" | "skew" => {
                return Err(child.fault(format!("<{}> is not read", child.name)));
            }
            _ => continue,
        };
        out = out.after(&step);
    }
    Ok(out)
}
/// A polygon as triangles.
fn put(polygon: &[Vector], out: &mut Vec<Triangle>) {
    let triangles = cut(polygon).into_iter();
    out.extend(triangles.map(|of| of.map(|k| polygon[k])));
}
