//! An arm for tests: the IRB 120-3/0.6 of `robots/abb_irb120.yaml`, row for row, with a tool.

use super::{Body, Geometry, JointSense, Link, Mechanism};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, MM};

/// The rows: alpha, theta in degrees, a, d in mm, and the limits of the joint in degrees.
const ROWS: [[f64; 6]; 6] = [
    [0.0, 0.0, 0.0, 290.0, -165.0, 165.0],
    [-90.0, -90.0, 0.0, 0.0, -110.0, 110.0],
    [0.0, 0.0, 270.0, 0.0, -110.0, 70.0],
    [-90.0, 0.0, 70.0, 302.0, -160.0, 160.0],
    [90.0, 0.0, 0.0, 0.0, -120.0, 120.0],
    [-90.0, 180.0, 0.0, 72.0, -400.0, 400.0],
];

/// The arm with its masses on the floor of the world, and a tool of 2 kg.
pub(crate) fn geometry() -> Geometry {
    let flange_from_tool = Pose::from_xyz_rxryrz([0.05, 0.02, 0.13, 0.1, -0.2, 0.3]);
    Geometry {
        world_from_base: Pose::identity(),
        links: ROWS.map(|[alpha, theta, a, d, ..]| Link {
            alpha_rad: alpha * DEG,
            a_m: a * MM,
            beta_rad: 0.0,
            theta_rad: theta * DEG,
            d_m: d * MM,
        }),
        link6_from_flange: Pose::identity(),
        flange_from_tool,
        flange_from_nominal_tool: flange_from_tool,
        bodies: vec![
            Body {
                link: 1,
                mass_kg: 4.2,
                cog_m: [0.14, 0.0, 0.0],
            },
            Body {
                link: 3,
                mass_kg: 5.0,
                cog_m: [0.0, 0.0, -0.1936],
            },
        ],
        load: Some((2.0, [0.02, 0.01, 0.08])),
        gravity_m_s2: [0.0, 0.0, -9.81],
        tool_name: "t".into(),
        carried: None,
    }
}

/// How its controller counts.
pub(crate) fn mechanism() -> Mechanism {
    Mechanism {
        joints: ROWS.map(|[.., min, max]| JointSense {
            sign: 1.0,
            offset_rad: 0.0,
            min_rad: min * DEG,
            max_rad: max * DEG,
        }),
        coupling: Vec::new(),
    }
}
