//! Measurements in the shape of those of real robots (rows, columns, reflectors, noise), made by
//! the independent physics: a robot with errors of its geometry, springs, an effect that level 3
//! lacks and one that nobody knows.

use crate::physics::matrix::{self, M4};
use crate::physics::{Fault, Moment, tool_pose};
use crate::trial::robots::{calibration, robot};
use crate::trial::truth::{faults, robot_of, unregistered};
use crate::trial::{joints_of, normal};
use poseshift::identify::measurements::last_moves;
use poseshift::model::profile::Profile;
use rand::SeedableRng;
use rand::rngs::StdRng;

/// The shape of a set.
pub struct Shape {
    pub name: &'static str,
    /// Index in the robots of the trial.
    robot: usize,
    pub configurations: usize,
    /// Places of reflectors on the tool, mm; one in its origin where there are none.
    reflectors: &'static [[f64; 3]],
    /// Orientations as quaternions, too, with this noise, rad.
    orientation_rad: Option<f64>,
    noise_mm: f64,
    /// Whether the file says how large the noise is.
    is_noise_stated: bool,
    /// What level 3 lacks.
    missing: fn() -> Fault,
    /// Index in the faults that no effect describes, with its size.
    unknown: (usize, f64),
}

/// Three reflectors on a small arm, one on a welding arm, 6D of a precise one, one on a cobot.
pub const SHAPES: [Shape; 4] = [
    Shape {
        name: "three reflectors",
        robot: 0,
        configurations: 486,
        reflectors: &[[30.0, 0.0, 20.0], [-20.0, 60.0, 0.0], [0.0, -50.0, 40.0]],
        orientation_rad: None,
        noise_mm: 0.01,
        is_noise_stated: true,
        missing: || Fault::Harmonic(0, 1.0, 1.5e-4, 0.5e-4),
        unknown: (7, 5e-6),
    },
    Shape {
        name: "one reflector, directions",
        robot: 7,
        configurations: 219,
        reflectors: &[],
        orientation_rad: None,
        noise_mm: 0.03,
        is_noise_stated: true,
        missing: || Fault::Leak(0, 1, 4e-4),
        unknown: (5, 1e-5),
    },
    Shape {
        name: "poses",
        robot: 6,
        configurations: 300,
        reflectors: &[],
        orientation_rad: Some(2e-5),
        noise_mm: 0.005,
        is_noise_stated: true,
        missing: || Fault::Backlash(1, 6e-5),
        unknown: (8, 4e-6),
    },
    Shape {
        name: "one reflector, noise unknown",
        robot: 2,
        configurations: 1000,
        reflectors: &[],
        orientation_rad: None,
        noise_mm: 0.03,
        is_noise_stated: false,
        missing: || Fault::Harmonic(1, 2.0, 1e-4, -1e-4),
        unknown: (0, 2e-6),
    },
];

/// What a file of the shape holds, and what is known of it.
pub struct Set {
    /// The nominal profile; where the robot stands in the device's frame is not in it.
    pub profile: String,
    pub csv: String,
    /// Mean length of noise and of what nobody knows, mm.
    pub floor_mm: f64,
    /// Mean length with what level 3 lacks, mm.
    pub level_3_mm: f64,
}

/// The set of this shape.
pub fn set(shape: &Shape, seed: u64) -> Set {
    let mut random = StdRng::seed_from_u64(seed);
    let (yaml, soft) = robot(shape.robot);
    let nominal = Profile::from_yaml(&yaml).expect("a shipped profile with a tool");
    let tool = nominal.tool("probe").expect("the tool");
    let mut arm = robot_of(&nominal, &tool);
    // the device is level and stands three metres away, the robot's foot is nearly upright
    arm.base = matrix::frame(&[2.7, 0.4, -0.8, 0.004, -0.006, 0.7]);
    let known: Vec<Fault> = calibration(&nominal, soft, &mut random)
        .iter()
        .map(faults)
        .collect();
    let with = |more: Vec<Fault>| [known.clone(), more].concat();
    let missing = with(vec![(shape.missing)()]);
    let (index, size) = shape.unknown;
    let unknown = (unregistered()[index].1)(2, size);
    let all = with(vec![(shape.missing)(), unknown]);

    let q = joints_of(&nominal, shape.configurations, &mut random);
    let moves = last_moves(&q);
    let reflectors = match shape.reflectors {
        [] => &[[0.0; 3]][..],
        some => some,
    };
    let mut csv = header(shape);
    let (mut floor_mm, mut level_3_mm) = (0.0, 0.0);
    for (r, q) in q.iter().enumerate() {
        let at = Moment {
            direction: moves[r].map(|m| if m == 0.0 { 0.0 } else { m.signum() }),
            moved: moves[r],
            row: r + 1,
            ..Moment::default()
        };
        let see = |faults: &[Fault]| tool_pose(&arm, faults, q, &at);
        let (real, known, missing) = (see(&all), see(&known), see(&missing));
        for (k, place) in reflectors.iter().enumerate() {
            let on = |pose: &M4| matrix::point(pose, place.map(|mm| 1e-3 * mm)).map(|m| 1e3 * m);
            let seen = on(&real).map(|mm| mm + shape.noise_mm * normal(&mut random));
            let off = |other: &M4| {
                let d = matrix::sub(seen, on(other));
                matrix::dot(d, d).sqrt()
            };
            floor_mm += off(&missing);
            level_3_mm += off(&known);
            let mut cells = Vec::new();
            if reflectors.len() > 1 {
                cells.push(format!("smr{}", k + 1));
            }
            cells.extend(q.map(|a| format!("{:.6}", a.to_degrees())));
            cells.extend(seen.map(|mm| format!("{mm:.6}")));
            if let Some(noise_rad) = shape.orientation_rad {
                let turned: [f64; 3] = std::array::from_fn(|_| noise_rad * normal(&mut random));
                let small = matrix::frame(&[0.0, 0.0, 0.0, turned[0], turned[1], turned[2]]);
                let quaternion = quaternion(&matrix::times(&real, &small));
                cells.extend(quaternion.map(|part| format!("{part:.9}")));
            }
            cells.extend(at.direction.map(|d| d.to_string()));
            if shape.is_noise_stated {
                cells.push(shape.noise_mm.to_string());
            }
            csv += &(cells.join(",") + "\n");
        }
    }
    let rows = (shape.configurations * reflectors.len()) as f64;
    Set {
        profile: yaml,
        csv,
        floor_mm: floor_mm / rows,
        level_3_mm: level_3_mm / rows,
    }
}

fn header(shape: &Shape) -> String {
    let mut names = vec!["q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm"];
    if shape.reflectors.len() > 1 {
        names.insert(0, "point");
    }
    if shape.orientation_rad.is_some() {
        names.push("qw,qx,qy,qz");
    }
    names.push("dir1,dir2,dir3,dir4,dir5,dir6");
    if shape.is_noise_stated {
        names.push("sigma_mm");
    }
    names.join(",") + "\n"
}

/// w, x, y, z of a rotation, by the largest of the four.
fn quaternion(m: &M4) -> [f64; 4] {
    let squares = [
        1.0 + m[0][0] + m[1][1] + m[2][2],
        1.0 + m[0][0] - m[1][1] - m[2][2],
        1.0 - m[0][0] + m[1][1] - m[2][2],
        1.0 - m[0][0] - m[1][1] + m[2][2],
    ];
    let largest = (0..4).max_by(|a, b| squares[*a].total_cmp(&squares[*b]));
    let largest = largest.expect("four");
    let s = 2.0 * squares[largest].sqrt();
    let (x, y, z) = (m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]);
    let (xy, xz, yz) = (m[0][1] + m[1][0], m[0][2] + m[2][0], m[1][2] + m[2][1]);
    let parts = match largest {
        0 => [0.25 * s * s, x, y, z],
        1 => [x, 0.25 * s * s, xy, xz],
        2 => [y, xy, 0.25 * s * s, yz],
        _ => [z, xz, yz, 0.25 * s * s],
    };
    parts.map(|part| part / s)
}
