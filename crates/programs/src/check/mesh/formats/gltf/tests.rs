//! Files that are read, and those whose numbers fit nothing.

use super::*;

fn none(_: &str) -> Result<Vec<u8>, String> {
    Err("there is none".into())
}

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
    // y of the file is z of the world, and z points to the viewer: -y
    let expected = [[[0.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, -2.0, 2.0]]];
    let text = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    let inline = json(&format!(
        r#""uri":"data:application/octet-stream;base64,{text}","#
    ));
    assert_eq!(read(inline.as_bytes(), &none).expect("glTF"), expected);
    let named = json(r#""uri":"t.bin","#);
    assert_eq!(
        read(named.as_bytes(), &|name| (name == "t.bin")
            .then(|| data.clone())
            .ok_or_else(String::new))
        .expect("glTF"),
        expected
    );
    assert!(read(named.as_bytes(), &none).is_err());
    let mut glb = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    for (kind, chunk) in [(b"JSON", json("").into_bytes()), (b"BIN\0", data.clone())] {
        glb.extend(u32::try_from(chunk.len()).expect("short").to_le_bytes());
        glb.extend(kind);
        glb.extend(chunk);
    }
    assert_eq!(read(&glb, &none).expect("GLB"), expected);
    glb.truncate(glb.len() - 10);
    assert!(read(&glb, &none).is_err());
}

/// A triangle of six points, of which three are shown.
const PLAIN: &str = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
                 {"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],
    "buffers":[{"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC"}]}"#;

#[test]
fn a_number_that_fits_nothing_is_an_error() {
    assert_eq!(read(PLAIN.as_bytes(), &none).expect("glTF").len(), 1);
    let most = u64::MAX.to_string();
    let offset = format!(r#""byteOffset":{most},"byteLength":3"#);
    let long = format!(r#""buffer":0,"byteLength":{most}"#);
    for (from, to, says) in [
        (
            r#""byteOffset":36,"byteLength":3"#,
            offset.as_str(),
            "beyond",
        ),
        (r#""buffer":0,"byteLength":36"#, &long, "beyond"),
        (
            r#""componentType":5126,"#,
            r#""componentType":5126,"byteOffset":18446744073709551615,"#,
            "beyond",
        ),
        (
            r#""byteLength":36}"#,
            r#""byteLength":36,"byteStride":0}"#,
            "0 apart",
        ),
        (
            r#""byteLength":36}"#,
            r#""byteLength":36,"byteStride":9223372036854775807}"#,
            "apart, in 36 bytes",
        ),
        (
            r#""count":3,"type":"VEC3""#,
            r#""count":4,"type":"VEC3""#,
            "4 items",
        ),
        (
            r#""count":3,"type":"VEC3""#,
            r#""count":-1,"type":"VEC3""#,
            "-1",
        ),
        (
            r#""count":3,"type":"SCALAR""#,
            r#""count":2,"type":"SCALAR""#,
            "2 corners",
        ),
        (
            r#""count":3,"type":"VEC3""#,
            r#""count":2,"type":"VEC3""#,
            "corner 2",
        ),
        (r#""bufferView":1,"#, "", "5126"),
        (
            r#""bufferView":1,"componentType":5121,"count":3"#,
            r#""componentType":5121,"count":99999999"#,
            "99999999",
        ),
        ("5121", "5126", "5126"),
        ("VEC3", "VEC2", "VEC2"),
        (r#""indices":1"#, r#""indices":7"#, "accessor 7"),
        (r#""mesh":0"#, r#""mesh":1"#, "mesh 1"),
        // the lower 32 bits of these are an index or a type that is there
        (
            r#""indices":1"#,
            r#""indices":4294967297"#,
            "4294967297 is named",
        ),
        (r#""nodes":[0]"#, r#""nodes":[4294967296]"#, "4294967296"),
        ("5121", "4294972417", "4294972417"),
        ("5121", "5120", "5120"),
        ("5121", "1", "unknown"),
        ("VEC3", "vec3", "unknown"),
        (
            r#""indices":1"#,
            r#""indices":1,"mode":7"#,
            "mode that is not known",
        ),
        (r#""bufferView":1"#, r#""bufferView":2"#, "buffer view 2"),
        (r#""POSITION":0"#, r#""POSITION":2"#, "accessor 2"),
        (r#""nodes":[0]"#, r#""nodes":[0,0]"#, "two parents"),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"children":[0]}"#,
            "two parents",
        ),
        (r#"{"mesh":0}"#, r#"{"mesh":0,"children":[1]}"#, "node 1"),
        (r#"{"mesh":0}"#, r#"{"mesh":0,"skin":0}"#, "a skin bends"),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"weights":[0.0,0.5]}"#,
            "weights of morph targets",
        ),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"rotation":[0,0,0,0]}"#,
            "quaternion",
        ),
        (r#""scenes":[{"nodes":[0]}],"#, "", "nothing is shown"),
        (
            "data:application/octet-stream;base64,",
            "data:application/octet-stream;base64,!",
            "base64",
        ),
        (
            "data:application/octet-stream;base64,",
            "x.bin#",
            "there is none",
        ),
        (
            r#""asset""#,
            r#""extensionsRequired":["KHR_draco_mesh_compression"],"asset""#,
            "KHR_draco",
        ),
    ] {
        assert!(PLAIN.contains(from), "{from}");
        let text = PLAIN.replacen(from, to, 1);
        match read(text.as_bytes(), &none) {
            // indices without bytes are zeros: a triangle without area
            Ok(found) if to.is_empty() => assert_eq!(found[0][0], found[0][1], "{from}"),
            Ok(found) => panic!("{to}: {found:?}"),
            Err(error) => assert!(error.contains(says), "{to}: {error}"),
        }
    }
}

#[test]
fn what_has_no_shape_is_not_looked_at() {
    // a scene of nothing, an attribute of a maker, a texture without an image, an animation of
    // something else than a node
    for (from, to) in [
        (r#""scenes":["#, r#""scene":1,"scenes":[{},"#),
        (r#""POSITION":0"#, r#""POSITION":0,"_PART":9"#),
        (r#""asset""#, r#""textures":[{}],"materials":7,"asset""#),
        (
            r#""asset""#,
            r#""animations":[{"channels":[{"sampler":0,"target":{"path":"pointer"}}],"samplers":[]}],"asset""#,
        ),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"extras":{"saved":1700000000000}}"#,
        ),
    ] {
        assert!(PLAIN.contains(from), "{from}");
        let text = PLAIN.replacen(from, to, 1);
        let found = read(text.as_bytes(), &none);
        assert_eq!(found.map(|found| found.len()), Ok(1), "{to}");
    }
}

#[test]
fn a_text_of_more_values_than_any_scene_is_an_error() {
    let text = format!("[0{}]", ",0".repeat(text::MOST_VALUES));
    let error = read(text.as_bytes(), &none).expect_err("values");
    assert!(error.contains("more than 10000000 values"), "{error}");
}

#[test]
fn sparse_items_take_the_place_of_those_of_the_accessor() {
    let sparse = r#""type":"VEC3","sparse":{"count":1,"indices":{"bufferView":1,"byteOffset":1,"componentType":5121},
        "values":{"bufferView":0,"byteOffset":24}}"#;
    let text = PLAIN.replacen(r#""type":"VEC3""#, sparse, 1);
    let found = read(text.as_bytes(), &none).expect("glTF");
    // item 1 becomes (0, 1, 0)
    assert_eq!(found[0][1], [0.0, 0.0, 1.0]);
    let base = r#""bufferView":0,"componentType":5126"#;
    let bare = text.replacen(base, r#""componentType":5126"#, 1);
    assert_eq!(
        read(bare.as_bytes(), &none).expect("glTF")[0],
        [[0.0; 3], [0.0, 0.0, 1.0], [0.0; 3]]
    );
    for (from, to, says) in [
        (
            r#""sparse":{"count":1"#,
            r#""sparse":{"count":3"#,
            "3 items",
        ),
        (
            r#""byteOffset":1,"componentType":5121"#,
            r#""componentType":5126"#,
            "whole",
        ),
        (r#""byteOffset":24"#, r#""byteOffset":30"#, "1 items"),
        (
            r#""byteOffset":24"#,
            r#""byteOffset":18446744073709551615"#,
            "beyond",
        ),
        (
            r#""sparse":{"count":1"#,
            r#""sparse":{"count":18446744073709551615"#,
            "18446744073709551615 items",
        ),
        (
            r#""count":3,"type":"VEC3""#,
            r#""count":1,"type":"VEC3""#,
            "item 1",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let error = read(text.replacen(from, to, 1).as_bytes(), &none).expect_err(to);
        assert!(error.contains(says), "{to}: {error}");
    }
}

#[test]
fn nodes_deeper_than_any_scene_are_an_error() {
    let chain: Vec<String> = (1..20_000)
        .map(|k| format!("{{\"children\":[{k}]}}"))
        .collect();
    let text = PLAIN.replacen(
        r#"{"mesh":0}"#,
        &format!("{},{{\"mesh\":0}}", chain.join(",")),
        1,
    );
    let error = read(text.as_bytes(), &none).expect_err("20 000 levels");
    assert!(error.contains("deeper than 256"), "{error}");
    // and JSON itself
    let nested = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(read(nested.as_bytes(), &none).is_err());
}
