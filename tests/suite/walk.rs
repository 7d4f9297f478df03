//! From a URDF, a tracker's file and the controller's joints to a corrected program, in six
//! commands.
//!
//! The real robot is a model of its own: the chain of the URDF as matrices, with every joint a
//! little elsewhere and soft. It shares no code with the product; `POSESHIFT_BLESS=1` writes the
//! files of `tests/data/walk` from it.

use crate::physics::matrix::{M4, V3, add, cross, dot, frame, point, shift, sub, times};
use crate::physics::matrix::{turn_x, turn_y, turn_z};
use crate::support::{poseshift, repository, scratch, text};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::Path;

/// Origins of the joints in the link before, metres, and their axes: `tests/data/walk/arm.urdf`.
const JOINTS: [(V3, V3); 6] = [
    ([0.0, 0.0, 0.45], [0.0, 0.0, 1.0]),
    ([0.15, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ([0.0, 0.0, 0.6], [0.0, -1.0, 0.0]),
    ([0.0, 0.0, 0.2], [-1.0, 0.0, 0.0]),
    ([0.64, 0.0, 0.0], [0.0, -1.0, 0.0]),
    ([0.1, 0.0, 0.0], [-1.0, 0.0, 0.0]),
];
/// Masses of the links, kg, and where they are.
const MASSES: [(f64, V3); 5] = [
    (60.0, [0.05, 0.0, -0.1]),
    (35.0, [0.0, 0.0, 0.28]),
    (25.0, [0.08, 0.0, 0.12]),
    (12.0, [0.35, 0.0, 0.0]),
    (3.0, [0.03, 0.0, 0.0]),
];
const LIMITS: [(f64, f64); 6] = [
    (-2.8, 2.8),
    (-1.5, 2.1),
    (-2.0, 2.4),
    (-3.1, 3.1),
    (-2.0, 2.0),
    (-6.0, 6.0),
];
/// The tool on the flange, metres, and its mass.
const TOOL: (V3, f64) = ([0.05, 0.02, 0.13], 4.0);
/// What the real robot has that its drawing has not: of each joint x, y, z in mm, rx, ry, rz in
/// mrad, and its compliance in µrad/(N m).
const FAULTS: [([f64; 6], f64); 6] = [
    ([0.3, -0.2, 0.4, 0.3, -0.4, 0.5], 0.0),
    ([0.8, 0.3, -0.9, 1.4, 2.3, -1.2], 3.0),
    ([-0.6, 0.5, 1.0, -1.1, -2.6, 0.8], 4.5),
    ([0.2, 0.4, -0.4, 1.9, 0.8, -0.9], 8.0),
    ([-0.6, 0.2, 0.3, -1.2, 2.1, 0.7], 12.0),
    ([0.4, -0.2, 0.2, 1.4, -0.9, 0.5], 0.0),
];
/// Where the reflector really is, offset from the tool's origin, metres: nests are not exact.
const NEST: V3 = [0.4e-3, -0.3e-3, 0.2e-3];
/// Noise of the tracker in each coordinate, metres.
const NOISE_M: f64 = 0.01e-3;
const POSES: usize = 120;
const HELD_OUT: usize = 40;
const TARGETS: usize = 150;

/// Where the controller counts from, seen from there: `base` is half a rotation about z and 0.45 m
/// up.
fn base_from_base_link() -> M4 {
    times(&turn_z(-PI), &shift([0.0, 0.0, -0.45]))
}

/// The tracker in the controller's world.
fn world_from_device() -> M4 {
    times(&shift([2.1, -3.4, 0.7]), &turn_z(130_f64.to_radians()))
}

fn about(axis: V3, angle: f64) -> M4 {
    // the axes of this arm are those of coordinates
    times(
        &times(&turn_x(axis[0] * angle), &turn_y(axis[1] * angle)),
        &turn_z(axis[2] * angle),
    )
}

fn origin(m: &M4) -> V3 {
    [m[0][3], m[1][3], m[2][3]]
}

/// The frames of the links in the controller's world, at joint angles.
fn links(q: &[f64; 6], real: bool) -> [M4; 6] {
    let mut at = base_from_base_link();
    std::array::from_fn(|i| {
        let (place, axis) = JOINTS[i];
        at = times(&at, &shift(place));
        if real {
            let [x, y, z, rx, ry, rz] = FAULTS[i].0.map(|fault| fault * 1e-3);
            at = times(&at, &frame(&[x, y, z, rx, ry, rz]));
        }
        at = times(&at, &about(axis, q[i]));
        at
    })
}

fn flange_from_tool() -> M4 {
    times(&turn_y(PI / 2.0), &shift(TOOL.0))
}

/// Where the tool is, by the drawing or really.
fn tool(q: &[f64; 6], real: bool) -> M4 {
    let mut bent = *q;
    if real {
        let at = links(q, true);
        for (i, (_, soft)) in FAULTS.iter().enumerate() {
            let (place, axis) = (origin(&at[i]), JOINTS[i].1);
            let axis: V3 = std::array::from_fn(|r| (0..3).map(|c| at[i][r][c] * axis[c]).sum());
            let masses = MASSES
                .iter()
                .zip(&at)
                .skip(i)
                .map(|((kg, cog), link)| (*kg, point(link, *cog)));
            let torque: f64 = masses
                // the centre of gravity of the tool is on the flange
                .chain([(TOOL.1, origin(&at[5]))])
                .map(|(kg, cog)| dot(axis, cross(sub(cog, place), [0.0, 0.0, -9.81 * kg])))
                .sum();
            bent[i] += soft * 1e-6 * torque;
        }
    }
    let tip = times(&links(&bent, real)[5], &flange_from_tool());
    if real { times(&tip, &shift(NEST)) } else { tip }
}

fn normal(random: &mut StdRng) -> f64 {
    let (a, b): (f64, f64) = (
        random.random_range(f64::MIN_POSITIVE..1.0),
        random.random_range(0.0..1.0),
    );
    (-2.0 * a.ln()).sqrt() * (TAU * b).cos()
}

/// A number as the controller and the tracker write it, with a decimal comma.
fn cell(number: f64) -> String {
    format!("{number:.7}").replace('.', ",")
}

/// The tables of the controller and of the tracker, by names that neither of them shares with the
/// product.
fn session(count: usize, seed: u64) -> (String, String) {
    let mut random = StdRng::seed_from_u64(seed);
    let device = world_from_device();
    let device_from_world = |p: V3| -> V3 {
        let d = sub(p, origin(&device));
        std::array::from_fn(|c| (0..3).map(|r| device[r][c] * d[r]).sum())
    };
    let mut joints = String::from("Pose;J1;J2;J3;J4;J5;J6\r\n");
    let mut points = String::from("Punkt;X;Y;Z;Zeit\r\n");
    for pose in 1..=count {
        let q = LIMITS.map(|(low, high)| (random.random_range(low..high) * 1e7_f64).round() / 1e7);
        let seen = device_from_world(origin(&tool(&q, true)));
        let seen = seen.map(|x| cell(x + NOISE_M * normal(&mut random)));
        writeln!(joints, "P{pose:03};{}\r", q.map(cell).join(";")).expect("text");
        writeln!(
            points,
            "P{pose:03};{};10:{:02}:{:02}\r",
            seen.join(";"),
            pose / 60,
            pose % 60
        )
        .expect("text");
    }
    (joints, points)
}

/// A pose as KRL writes it: mm, and A, B, C in degrees of Rz(A)·Ry(B)·Rx(C).
fn krl(m: &M4) -> [f64; 6] {
    let b = (-m[2][0]).atan2(m[0][0].hypot(m[1][0]));
    let (a, c) = (m[1][0].atan2(m[0][0]), m[2][1].atan2(m[2][2]));
    let [x, y, z] = origin(m).map(|x| 1e3 * x);
    [x, y, z, a.to_degrees(), b.to_degrees(), c.to_degrees()]
}

/// The joints of the program's targets: a path on which no joint turns far between two of them.
fn driven_joints() -> Vec<[f64; 6]> {
    let middle = [0.3, 0.35, -0.2, 0.4, -0.9, 0.5];
    let width = [1.2, 0.45, 0.5, 0.6, 0.3, 1.0];
    let at = |k: usize, i: usize| {
        let phase = TAU * k as f64 / TARGETS as f64;
        middle[i] + width[i] * ((i + 1) as f64 * 0.7 * phase + i as f64).sin()
    };
    (0..TARGETS)
        .map(|k| std::array::from_fn(|i| at(k, i)))
        .collect()
}

fn program() -> String {
    let [x, y, z] = TOOL.0.map(|x| 1e3 * x);
    let path = driven_joints();
    let start = path[0].map(|q| format!("{:.6}", q.to_degrees()));
    let axes: Vec<String> = start
        .iter()
        .enumerate()
        .map(|(i, q)| format!("A{} {q}", i + 1))
        .collect();
    let mut out = format!(
        "DEF WELD()\r\nTOOL_DATA[1] = {{FRAME: X {x:.1}, Y {y:.1}, Z {z:.1}, A 0, B 0, C 0}}\r\n\
         LOAD_DATA[1] = {{M {:.1}, CM {{X 0, Y 0, Z 0, A 0, B 0, C 0}}, J {{X 0, Y 0, Z 0}}}}\r\n\
         BASE_DATA[1] = {{FRAME: X 0, Y 0, Z 0, A 0, B 0, C \
             0}}\r\nBAS(#TOOL,1)\r\nBAS(#BASE,1)\r\nPTP {{E6AXIS: {}}}\r\n",
        TOOL.1,
        axes.join(", ")
    );
    for q in &path {
        let [x, y, z, a, b, c] = krl(&tool(q, false));
        writeln!(
            out,
            "LIN {{X {x:.4}, Y {y:.4}, Z {z:.4}, A {a:.5}, B {b:.5}, C {c:.5}}}\r"
        )
        .expect("text");
    }
    out + "END\r\n"
}

/// The targets of a program.
fn targets(program: &str) -> Vec<[f64; 6]> {
    let lines = program
        .lines()
        .filter_map(|line| line.strip_prefix("LIN {"));
    lines
        .map(|line| {
            let numbers = line.trim_end().trim_end_matches('}').split(", ");
            let numbers: Vec<f64> = numbers
                .map(|pair| {
                    pair.split(' ')
                        .nth(1)
                        .expect("a number")
                        .parse()
                        .expect("a number")
                })
                .collect();
            numbers.try_into().expect("six numbers")
        })
        .collect()
}

/// Mean and largest distance of two lists of points after the rotation and shift that fit best, mm.
fn apart(wanted: &[V3], real: &[V3]) -> (f64, f64) {
    use nalgebra::{Matrix3, Vector3};
    let count = wanted.len() as f64;
    let mean = |of: &[V3]| {
        of.iter()
            .fold([0.0; 3], |sum, p| add(sum, *p))
            .map(|x| x / count)
    };
    let (a, b) = (mean(wanted), mean(real));
    let mut product = Matrix3::zeros();
    for (w, r) in wanted.iter().zip(real) {
        product += Vector3::from(sub(*w, a)) * Vector3::from(sub(*r, b)).transpose();
    }
    let svd = product.svd(true, true);
    let (u, v) = (svd.u.expect("three columns"), svd.v_t.expect("three rows"));
    let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, (u * v).determinant().signum()));
    let turn = u * mirror * v;
    let gaps = wanted
        .iter()
        .zip(real)
        .map(|(w, r)| 1e3 * (Vector3::from(sub(*w, a)) - turn * Vector3::from(sub(*r, b))).norm());
    let gaps: Vec<f64> = gaps.collect();
    (
        gaps.iter().sum::<f64>() / count,
        gaps.iter().copied().fold(0.0, f64::max),
    )
}

fn run(folder: &Path, line: &str) -> String {
    let walk = repository("tests/data/walk");
    let words = line
        .split_whitespace()
        .map(|word| word.replace('@', &format!("{}/", walk.display())));
    let output = poseshift()
        .current_dir(folder)
        .args(words)
        .output()
        .expect("the program starts");
    let reported = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{line}: {reported}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn json(folder: &Path, line: &str) -> Value {
    serde_json::from_str(&run(folder, &format!("{line} --json"))).expect("JSON")
}

#[test]
fn the_files_of_the_walk_are_those_of_its_robot() {
    let (joints, points) = session(POSES, 1);
    let (others, held_out) = session(HELD_OUT, 2);
    for (name, content) in [
        ("joints.csv", joints),
        ("tracker.csv", points),
        ("joints_held_out.csv", others),
        ("tracker_held_out.csv", held_out),
        ("weld.src", program()),
    ] {
        let name = format!("tests/data/walk/{name}");
        if std::env::var_os("POSESHIFT_BLESS").is_some() {
            std::fs::write(repository(&name), &content).expect("a writable file");
        }
        assert!(
            text(&name) == content,
            "{name}: POSESHIFT_BLESS=1 writes it anew"
        );
    }
}

#[test]
fn a_urdf_and_a_tracker_file_become_a_program_that_lands_where_it_should() {
    let folder = scratch();
    let path = folder.path();
    let [x, y, z] = TOOL.0.map(|x| 1e3 * x);
    run(
        path,
        &format!(
            "profile from-urdf @arm.urdf --language krl --tool TOOL_DATA[1]={x},{y},{z},0,0,0,{} \
             -o arm.yaml",
            TOOL.1
        ),
    );
    run(
        path,
        "plan --profile arm.yaml --count 20 --candidates 500 -o plan.csv",
    );
    let found = json(
        path,
        "calibrate --profile arm.yaml --joints @joints.csv --points @tracker.csv \
         --columns id=Pose,id=Punkt,q1=J1,q2=J2,q3=J3,q4=J4,q5=J5,q6=J6,x=X,y=Y,z=Z --units m,rad \
             -o calibrated.yaml",
    );
    // the base is the controller's; the tracker stands where it stands, but for what of the base
    // cannot be distinguished from it
    let device = &found["world_from_device"];
    for (key, wanted, near) in [
        ("x_mm", 2100.0, 3.0),
        ("y_mm", -3400.0, 3.0),
        ("z_mm", 700.0, 3.0),
        ("rz_deg", 130.0, 0.1),
    ] {
        let number = device[key].as_f64().expect("a number");
        assert!((number - wanted).abs() < near, "{key}: {number}");
    }
    assert!(
        found["world_from_device_sigma"]["x_mm"]
            .as_f64()
            .expect("a sigma")
            < 0.2
    );
    let before = std::fs::read_to_string(path.join("arm.yaml")).expect("a profile");
    let after = std::fs::read_to_string(path.join("calibrated.yaml")).expect("a profile");
    let base = |text: &str| {
        text.lines()
            .find(|l| l.trim().starts_with("base:"))
            .map(str::to_owned)
    };
    assert!(
        base(&before).is_some() && base(&before) == base(&after),
        "{after}"
    );
    // the profile keeps how the tables name their columns
    let judged = json(
        path,
        "validate --profile calibrated.yaml --joints @joints_held_out.csv --points \
         @tracker_held_out.csv",
    );
    let mean = |model: &str| {
        judged["position"][model]["mean_mm"]
            .as_f64()
            .expect("a mean")
    };
    assert!(mean("frames_only") > 1.5, "{judged}");
    assert!(mean("real") < 0.05, "{judged}");
    // what such a device would see of the calibrated robot is what the profile says of it
    run(
        path,
        "simulate --profile calibrated.yaml --joints plan.csv -o seen.csv",
    );
    let own = json(
        path,
        "validate --profile calibrated.yaml --measurements seen.csv",
    );
    let largest = own["position"]["real"]["max_mm"]
        .as_f64()
        .expect("a number");
    assert!(largest < 1e-6, "{largest} mm");
    let report = json(
        path,
        "compensate @weld.src --profile calibrated.yaml -o weld.src",
    );
    run(
        path,
        "check weld.src --nominal @weld.src --profile calibrated.yaml",
    );
    let written = std::fs::read_to_string(path.join("weld.src")).expect("written");
    let (wanted, fake) = (targets(&program()), targets(&written));
    let reported = report["targets"].as_array().expect("a list").iter();
    let driven: Vec<[f64; 6]> = reported
        .filter(|target| !target["joints_deg"].is_null())
        .map(|target| {
            let joints = target["joints_deg"].as_array().expect("six joints").iter();
            let joints: Vec<f64> = joints
                .map(|q| q.as_f64().expect("a number").to_radians())
                .collect();
            joints.try_into().expect("six joints")
        })
        .collect();
    assert_eq!(
        (wanted.len(), fake.len(), driven.len()),
        (TARGETS, TARGETS, TARGETS)
    );
    // these joints are what a controller that knows the drawing makes of the written numbers
    for (target, q) in fake.iter().zip(&driven) {
        let nominal = krl(&tool(q, false));
        let gap = (0..3)
            .map(|i| (nominal[i] - target[i]).abs())
            .fold(0.0, f64::max);
        assert!(gap < 2e-3, "{nominal:?} {target:?}");
    }
    let place = |t: &[f64; 6]| [t[0], t[1], t[2]].map(|x| x / 1e3);
    let wanted: Vec<V3> = wanted.iter().map(place).collect();
    let real = |q: &[f64; 6]| origin(&tool(q, true));
    let uncorrected: Vec<V3> = driven_joints().iter().map(real).collect();
    let corrected: Vec<V3> = driven.iter().map(real).collect();
    let (before, _) = apart(&wanted, &uncorrected);
    let (after, most) = apart(&wanted, &corrected);
    println!("150 targets: {before:.3} mm before, {after:.4} mm after, {most:.4} at most");
    assert!((0.5..2.0).contains(&before), "{before}");
    assert!(after <= 0.03, "{after}");
}
