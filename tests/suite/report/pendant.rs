//! `--convention`: frames as a maker's teach pendant shows them, against the quaternion of the
//! JSON.

use super::{data, name};
use crate::support::{run, scratch};
use serde_json::Value;

const REGISTER: [&str; 3] = [
    "register",
    "docs/measuring/nominal.csv",
    "docs/measuring/probed.csv",
];

type Matrix = [[f64; 3]; 3];

/// Rotation by an angle in degrees about x (0), y (1) or z (2), by its definition.
fn about(axis: usize, degrees: f64) -> Matrix {
    let (s, c) = degrees.to_radians().sin_cos();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut m = [[0.0; 3]; 3];
    m[axis][axis] = 1.0;
    (m[u][u], m[u][v], m[v][u], m[v][v]) = (c, -s, s, c);
    m
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The rotation of a quaternion w, x, y, z.
fn of_quaternion([w, x, y, z]: [f64; 4]) -> Matrix {
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}

/// The values behind these names in a line.
fn values<const N: usize>(line: &str, names: [&str; N]) -> [f64; N] {
    let words: Vec<&str> = line.split_whitespace().collect();
    names.map(|name| {
        let at = words.iter().rposition(|word| *word == name);
        let value = words[at.unwrap_or_else(|| panic!("{name} in {line}")) + 1];
        value
            .parse()
            .unwrap_or_else(|_| panic!("{value} in {line}"))
    })
}

#[test]
fn every_maker_shows_the_rotation_that_the_json_has() {
    let (status, json, error) = run(&[&REGISTER[..], &["--json"]].concat());
    assert_eq!(status, 0, "{error}");
    let report: Value = serde_json::from_str(&json).expect("JSON");
    let quaternion = report["quaternion"].as_array().expect("a quaternion");
    let quaternion: Vec<f64> = quaternion.iter().filter_map(Value::as_f64).collect();
    let quaternion: [f64; 4] = quaternion.try_into().expect("four");
    let wanted = of_quaternion(quaternion);
    for maker in [
        "abb", "kuka", "fanuc", "ur", "yaskawa", "staubli", "kawasaki",
    ] {
        let (status, text, error) = run(&[&REGISTER[..], &["--convention", maker]].concat());
        assert_eq!(status, 0, "{maker}: {error}");
        let (_, shown) = text
            .split_once("as a teach pendant shows it")
            .expect("frames");
        let line = shown.lines().skip(1).collect::<Vec<_>>().join(" ");
        let by = |names: [&str; 3], axes: [usize; 3]| {
            let angles = values(&line, names);
            let [a, b, c] = std::array::from_fn(|i| about(axes[i], angles[i]));
            product(&product(&a, &b), &c)
        };
        let found = match maker {
            "abb" => of_quaternion(values(&line, ["q1", "q2", "q3", "q4"])),
            "kuka" => by(["A", "B", "C"], [2, 1, 0]),
            "fanuc" => by(["R", "P", "W"], [2, 1, 0]),
            "yaskawa" => by(["Rz", "Ry", "Rx"], [2, 1, 0]),
            "staubli" => by(["rx", "ry", "rz"], [0, 1, 2]),
            "kawasaki" => by(["O", "A", "T"], [2, 1, 2]),
            _ => {
                let [x, y, z] = values(&line, ["RX", "RY", "RZ"]);
                let angle = (x * x + y * y + z * z).sqrt();
                let (s, c) = ((angle / 2.0).sin() / angle, (angle / 2.0).cos());
                of_quaternion([c, s * x, s * y, s * z])
            }
        };
        for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
            assert!(
                (found - wanted).abs() < 3e-6,
                "{maker}: {found} is not {wanted}\n{text}"
            );
        }
    }
}

#[test]
fn the_page_shows_them_and_other_names_are_refused_with_the_right_ones() {
    let folder = scratch();
    let page = folder.path().join("page.html");
    let options = ["--convention", "kuka", "--report", name(&page)];
    let (status, _, error) = run(&[&REGISTER[..], &options].concat());
    assert_eq!(status, 0, "{error}");
    let html = std::fs::read_to_string(&page).expect("a page");
    assert!(html.contains("TO from FROM, as a teach pendant shows it"));
    assert!(!data(&page).is_null());
    let (status, _, error) = run(&[&REGISTER[..], &["--convention", "kukka"]].concat());
    assert_eq!(status, 2);
    assert!(error.contains("kuka"), "{error}");
}
