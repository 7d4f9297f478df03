//! Mesh files from the command line: one wall in every format, and files that mean harm.

use crate::support::{run, scratch};
use serde_json::Value;
use std::path::Path;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const PROGRAM: &str = "programs/rapid/olp/in/Deburr.mod";

/// Least and largest coordinates of the wall, mm: between the arm and what it reaches for.
const LOW: [f64; 3] = [350.0, -1000.0, -500.0];
const HIGH: [f64; 3] = [360.0, 1000.0, 1500.0];
/// Numbers of 32 bits, and the millionth that reports round to, mm.
const SAME_MM: f64 = 1e-3;

/// Corners and triangles of the wall, mm.
fn wall() -> ([[f64; 3]; 8], [[usize; 3]; 12]) {
    let corners = std::array::from_fn(|k| {
        std::array::from_fn(|i| if k >> i & 1 == 0 { LOW[i] } else { HIGH[i] })
    });
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    (corners, faces)
}

#[allow(clippy::cast_possible_truncation, reason = "formats of 32 bits")]
fn f32_of(number: f64) -> f32 {
    number as f32
}

fn stl_ascii() -> Vec<u8> {
    stl(1.0)
}

/// The wall in a unit of so many per millimetre.
fn stl(per_mm: f64) -> Vec<u8> {
    let (corners, faces) = wall();
    let mut text = "solid wall\n".to_owned();
    for face in faces {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in face.map(|k| corners[k].map(|mm| mm * per_mm)) {
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    (text + "endsolid wall\n").into_bytes()
}

fn stl_binary() -> Vec<u8> {
    let (corners, faces) = wall();
    let mut bytes = vec![b' '; 80];
    bytes.extend(12u32.to_le_bytes());
    for face in faces {
        bytes.extend([0; 12]);
        for number in face.iter().flat_map(|k| corners[*k]) {
            bytes.extend(f32_of(number).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn obj() -> Vec<u8> {
    let (corners, faces) = wall();
    let points = corners.map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = faces.map(|f| format!("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1));
    (points.concat() + &faces.concat()).into_bytes()
}

/// The wall in a unit of so many metres; `turned` gives file coordinates from those of the world.
fn dae(metre: f64, up: &str, turned: fn([f64; 3]) -> [f64; 3]) -> String {
    let (corners, faces) = wall();
    // half of the displacement stands in the node
    let shift = turned([100.0, 0.0, 0.0]).map(|v| v / 1000.0 / metre);
    let numbers: String = corners
        .iter()
        .map(|[x, y, z]| turned([x - 100.0, *y, *z]).map(|v| v / 1000.0 / metre))
        .map(|[x, y, z]| format!("{x} {y} {z} "))
        .collect();
    let indices: String = faces.iter().flatten().map(|k| format!("{k} 0 ")).collect();
    let [x, y, z] = shift;
    format!(
        "<?xml version='1.0' encoding='utf-8'?>\n\
         <COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>\n\
         <asset><unit name='unit' meter='{metre}'/><up_axis>{up}</up_axis></asset>\n\
         <library_geometries><geometry id='g'><mesh>\n\
         <source id='s'><float_array id='a' count='24'>{numbers}</float_array><technique_common>\
         <accessor source='#a' count='8' stride='3'><param name='X' \
             type='float'/></accessor></technique_common></source>\n\
         <vertices id='v'><input semantic='POSITION' source='#s'/></vertices>\n\
         <triangles count='12'><input semantic='VERTEX' source='#v' offset='0'/>\
         <input semantic='NORMAL' source='#s' offset='1'/>\n<p>{indices}</p></triangles>\n\
         </mesh></geometry></library_geometries>\n\
         <library_visual_scenes><visual_scene id='scene'><node id='n'><translate>{x} {y} \
             {z}</translate>\
         <node><instance_geometry url='#g'/></node></node></visual_scene></library_visual_scenes>\n\
         <scene><instance_visual_scene url='#scene'/></scene>\n</COLLADA>\n"
    )
}

fn same(world: [f64; 3]) -> [f64; 3] {
    world
}

/// Coordinates in a file whose y points up: z of the world is y, and its y goes away from the
/// viewer.
fn y_up([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, z, -y]
}

fn x_up([x, y, z]: [f64; 3]) -> [f64; 3] {
    [z, -x, -y]
}

/// The glTF text, with `buffer` as the keys of its buffer, and the bytes of that.
fn gltf(buffer: &str) -> (String, Vec<u8>) {
    let (corners, faces) = wall();
    let mut bytes = Vec::new();
    for number in corners.iter().flat_map(|c| y_up(*c)) {
        bytes.extend(f32_of(number / 1000.0).to_le_bytes());
    }
    bytes.extend(
        faces
            .iter()
            .flatten()
            .map(|k| u8::try_from(*k).expect("8 corners")),
    );
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"}},
        {{"bufferView":1,"componentType":5121,"count":36,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":96}},{{"buffer":0,"byteOffset":96,"byteLength":36}}],
        "buffers":[{{{buffer}"byteLength":132}}]}}"#
    );
    (text, bytes)
}

/// The wall as points that are all zero but for eight items that stand apart.
fn sparse() -> (String, Vec<u8>) {
    let (text, mut bytes) = gltf(r#""uri":"sparse.bin","#);
    bytes.extend(0..8);
    let text = text.replace(
        r#""bufferView":0,"componentType":5126,"count":8,"type":"VEC3""#,
        r#""componentType":5126,"count":8,"type":"VEC3","sparse":{"count":8,
        "indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":0}}"#,
    );
    let text = text.replace(
        r#""byteOffset":96,"byteLength":36}]"#,
        r#""byteOffset":96,"byteLength":36},{"buffer":0,"byteOffset":132,"byteLength":8}]"#,
    );
    (
        text.replace(r#""byteLength":132}"#, r#""byteLength":140}"#),
        bytes,
    )
}

fn glb() -> Vec<u8> {
    let (mut json, bytes) = gltf("");
    while json.len() % 4 != 0 {
        json.push(' ');
    }
    let mut out = b"glTF\x02\0\0\0".to_vec();
    let length = 12 + 8 + json.len() + 8 + bytes.len();
    out.extend(u32::try_from(length).expect("short").to_le_bytes());
    for (kind, chunk) in [(b"JSON", json.as_bytes()), (b"BIN\0", &bytes)] {
        out.extend(u32::try_from(chunk.len()).expect("short").to_le_bytes());
        out.extend(kind);
        out.extend(chunk);
    }
    out
}

fn cell(folder: &Path, body: &str) -> String {
    let path = folder.join("cell.yaml");
    let text = format!("poseshift: cell/1\nbodies:\n  - {{name: wall, {body}}}\n");
    std::fs::write(&path, text).expect("scratch");
    path.display().to_string()
}

fn check(cell: &str, more: &[&str]) -> (i32, String, String) {
    let command = ["check", PROGRAM, "--profile", PROFILE, "--cell", cell];
    run(&[&command[..], more].concat())
}

/// The exit status, and the least clearance and its place of each move.
fn clearances(cell: &str) -> (i32, Vec<Option<f64>>) {
    let (status, out, error) = check(cell, &["--json"]);
    let found: Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{out} {error}"));
    let moves = found["moves"].as_array().expect("moves");
    let one = |entry: &Value| entry["clearance_mm"].as_f64();
    (status, moves.iter().map(one).collect())
}

#[test]
fn a_wall_is_the_same_wall_in_every_format() {
    let folder = scratch();
    let size: Vec<String> = (0..3).map(|i| (HIGH[i] - LOW[i]).to_string()).collect();
    let [x, y, z]: [f64; 3] = std::array::from_fn(|i| 0.5 * (LOW[i] + HIGH[i]));
    let plain = format!(
        "box_mm: [{}], at: {{x_mm: {x}, y_mm: {y}, z_mm: {z}, rx_deg: 0, ry_deg: 0, rz_deg: 0}}",
        size.join(", ")
    );
    let (status, expected) = clearances(&cell(folder.path(), &plain));
    assert_eq!(status, 1, "the arm is in the wall");
    assert!(expected.iter().flatten().count() > 3);
    let (named, bytes) = gltf(r#""uri":"the%20wall.bin","#);
    std::fs::write(folder.path().join("the wall.bin"), bytes).expect("scratch");
    let (sparse, bytes) = sparse();
    std::fs::write(folder.path().join("sparse.bin"), bytes).expect("scratch");
    for (file, bytes) in [
        ("ascii.stl", stl_ascii()),
        ("binary.stl", stl_binary()),
        ("wall.obj", obj()),
        ("mm.dae", dae(0.001, "Z_UP", same).into_bytes()),
        ("metre.dae", dae(1.0, "Y_UP", y_up).into_bytes()),
        ("inch.dae", dae(0.0254, "X_UP", x_up).into_bytes()),
        ("wall.gltf", named.into_bytes()),
        ("sparse.gltf", sparse.into_bytes()),
        ("wall.glb", glb()),
    ] {
        std::fs::write(folder.path().join(file), bytes).expect("scratch");
        let path = cell(folder.path(), &format!("mesh: {file}"));
        let (status, found) = clearances(&path);
        assert_eq!((status, found.len()), (1, expected.len()), "{file}");
        for (found, expected) in found.iter().zip(&expected) {
            // in a mesh, as in a box, how deep something is is not compared: only that it touches
            let (found, expected) = (found.unwrap_or(0.0), expected.unwrap_or(0.0));
            assert!(
                (found.max(0.0) - expected.max(0.0)).abs() < SAME_MM,
                "{file}: {found} and {expected}"
            );
        }
        let (_, out, _) = check(&path, &["-v"]);
        let bounds = "12 triangles, x 350.0 to 360.0, y -1000.0 to 1000.0, z -500.0 to 1500.0 mm";
        let words: Vec<&str> = out.split_whitespace().collect();
        assert!(words.join(" ").contains(bounds), "{file}: {out}");
    }
}

#[test]
fn a_mesh_in_metres_is_not_taken_for_one_in_millimetres() {
    let folder = scratch();
    let text = String::from_utf8(obj()).expect("text");
    let metres = |word: &str| match word.parse::<f64>() {
        Ok(number) if word.contains("00") || number.abs() > 300.0 => (number / 1000.0).to_string(),
        _ => word.to_owned(),
    };
    let lines = text.lines().map(|line| {
        let words: Vec<String> = if line.starts_with('v') {
            line.split(' ').map(metres).collect()
        } else {
            vec![line.to_owned()]
        };
        words.join(" ") + "\n"
    });
    std::fs::write(folder.path().join("m.obj"), lines.collect::<String>()).expect("scratch");
    let (status, out, _) = check(&cell(folder.path(), "mesh: m.obj"), &[]);
    assert_eq!(status, 1, "{out}");
    assert!(
        out.contains("mesh-unit") && out.contains("scale: 1000"),
        "{out}"
    );
    // said, it is believed: a wall, and a crumb
    let (status, found) = clearances(&cell(folder.path(), "mesh: m.obj, scale: 1000"));
    assert!(status == 1 && found.iter().flatten().any(|mm| *mm <= 0.0));
    let (_, out, _) = check(&cell(folder.path(), "mesh: m.obj, scale: 1"), &[]);
    assert!(!out.contains("mesh-unit"), "{out}");
    // a file that says its unit is in metres once it is applied
    std::fs::write(folder.path().join("m.dae"), dae(0.001, "Z_UP", |p| p)).expect("scratch");
    let (status, out, _) = check(&cell(folder.path(), "mesh: m.dae, scale: 1"), &[]);
    assert!(status == 1 && out.contains("mesh-unit"), "{out}");
    assert!(out.contains("leave `scale` out"), "{out}");
    let (status, found) = clearances(&cell(folder.path(), "mesh: m.dae, scale: 1000"));
    assert!(status == 1 && found.iter().flatten().any(|mm| *mm <= 0.0));
    // an STL in metres, next to a body whose size is known and that is larger than the arm
    std::fs::write(folder.path().join("m.stl"), stl(1e-3)).expect("scratch");
    let hall = "mesh: m.stl}\n  - {name: hall, at: {x_mm: 0, y_mm: 0, z_mm: -4000, rx_deg: 0, ry_deg: 0, rz_deg: 0}, box_mm: [9000, 9000, 100]";
    let (status, out, error) = check(&cell(folder.path(), hall), &[]);
    assert!(
        status == 1 && out.contains("`hall` is"),
        "{status} {out} {error}"
    );
}

/// What a mesh or its neighbour is refused for: status 2 and one line, no panic and no crash.
fn refused(folder: &Path, file: &str, bytes: &[u8], says: &str) {
    std::fs::write(folder.join(file), bytes).expect("scratch");
    let (status, out, error) = check(&cell(folder, &format!("mesh: {file}")), &[]);
    assert_eq!(status, 2, "{file}: {out} {error}");
    assert!(
        error.contains(says) && error.contains(file),
        "{says}: {error}"
    );
}

#[test]
fn meshes_that_mean_harm_are_errors() {
    let folder = scratch();
    let given = scratch();
    std::fs::write(given.path().join("out.bin"), [0; 132]).expect("scratch");
    let outside = format!(
        "../{}/out.bin",
        given.path().file_name().expect("a name").display()
    );
    for (uri, says) in [
        (outside.as_str(), "in the mesh's folder"),
        ("%2e%2e/out.bin", "in the mesh's folder"),
        ("/dev/zero", "in the mesh's folder"),
        ("file:///dev/zero", "in the mesh's folder"),
        ("none.bin", "none.bin"),
    ] {
        let (text, _) = gltf(&format!(r#""uri":"{uri}","#));
        refused(folder.path(), "outside.gltf", text.as_bytes(), says);
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/dev/zero", folder.path().join("zero.bin")).expect("a link");
        std::os::unix::fs::symlink(given.path().join("out.bin"), folder.path().join("out.bin"))
            .expect("a link");
        for uri in ["zero.bin", "out.bin"] {
            let (text, _) = gltf(&format!(r#""uri":"{uri}","#));
            let says = "in the mesh's folder";
            refused(folder.path(), "linked.gltf", text.as_bytes(), says);
        }
        let (status, _, error) = check(&cell(folder.path(), "mesh: /dev/zero"), &[]);
        assert!(status == 2 && error.contains("no plain file"), "{error}");
    }
    let (text, _) = gltf("");
    let with_text = |text: &str| -> Vec<u8> {
        let mut bytes = glb();
        // the header counts the JSON chunk
        let count = u32::from_le_bytes(bytes[12..16].try_into().expect("four"));
        let binary = bytes.split_off(20 + count as usize);
        bytes.truncate(12);
        bytes.extend(u32::try_from(text.len()).expect("short").to_le_bytes());
        bytes.extend(b"JSON");
        bytes.extend(text.as_bytes());
        bytes.extend(binary);
        bytes
    };
    let offset = text.replace(r#""byteOffset":96"#, r#""byteOffset":18446744073709551615"#);
    let circle = text.replace(r#"{"mesh":0}"#, r#"{"mesh":0,"children":[0]}"#);
    for (file, text, says) in [
        ("offset.glb", offset, "beyond its buffer"),
        ("circle.glb", circle, "node 0 has two parents"),
    ] {
        refused(folder.path(), file, &with_text(&text), says);
    }
    let plain = dae(0.001, "Z_UP", same);
    for (file, from, to, says) in [
        (
            "index.dae",
            "<p>0 0",
            "<p>99 0",
            "line 8: a face names corner 99",
        ),
        (
            "count.dae",
            "count='8'",
            "count='9999999999999999999'",
            "points of 3",
        ),
        (
            "faces.dae",
            "<triangles count='12'>",
            "<triangles count='13'>",
            "it is cut off",
        ),
        (
            "stride.dae",
            "stride='3'",
            "stride='6148914691236517206'",
            "numbers",
        ),
        ("unit.dae", "meter='0.001'", "meter='0'", "no length"),
        ("axis.dae", "Z_UP", "W_UP", "up axis"),
        ("nowhere.dae", "url='#g'", "url='#h'", "no <geometry>"),
        (
            "circle.dae",
            "<node><instance_geometry url='#g'/>",
            "<node><instance_node url='#n'/>",
            "circle",
        ),
        (
            "scene.dae",
            "<scene><instance_visual_scene url='#scene'/></scene>",
            "",
            "nothing is shown",
        ),
        ("cut.dae", "</COLLADA>", "", "ends inside"),
    ] {
        assert!(plain.contains(from), "{from}");
        refused(
            folder.path(),
            file,
            plain.replacen(from, to, 1).as_bytes(),
            says,
        );
    }
    let deep = format!(
        "{}<instance_geometry url='#g'/>{}",
        "<node>".repeat(20_000),
        "</node>".repeat(20_000)
    );
    let deep = plain.replace("<node><instance_geometry url='#g'/></node>", &deep);
    refused(
        folder.path(),
        "deep.dae",
        deep.as_bytes(),
        "deeper than 256",
    );
    // each node shows the next one twice: 2^40 walls
    let doubled: String = (0..40)
        .map(|k| {
            format!(
                "<node id='d{k}'><instance_node url='#d{0}'/><instance_node url='#d{0}'/></node>",
                k + 1
            )
        })
        .collect();
    let doubled = plain.replace(
        "<node><instance_geometry url='#g'/></node>",
        &(doubled + "<node id='d40'/>"),
    );
    refused(
        folder.path(),
        "doubled.dae",
        doubled.as_bytes(),
        "100000 nodes",
    );
}

#[test]
fn a_urdf_that_means_harm_is_an_error() {
    let folder = scratch();
    let path = folder.path().join("r.urdf");
    let link = |k: usize| {
        let joint = format!(
            "<joint name='j{k}' type='revolute'><parent link='l{k}'/><child link='l{}'/>\
             <limit lower='-1' upper='1' effort='1' velocity='1'/></joint>",
            k + 1
        );
        format!(
            "<link name='l{k}'/>{}",
            if k < 20_000 { joint } else { String::new() }
        )
    };
    let chain: String = (0..=20_000).map(link).collect();
    for (text, says) in [
        ("<a>".repeat(100_000), "deeper than 256"),
        (
            format!("<robot name='r'>{}</robot>", "<link>".repeat(100_000)),
            "deeper than 256",
        ),
        (
            format!("<robot name='r'>{chain}</robot>"),
            "20001 links or joints",
        ),
        ("<robot name='r'><link name='a'>".into(), "ends inside"),
    ] {
        std::fs::write(&path, text).expect("scratch");
        let (status, out, error) = run(&["profile", "from-urdf", path.to_str().expect("UTF-8")]);
        assert_eq!(status, 2, "{out} {error}");
        assert!(error.contains(says), "{error}");
    }
}
