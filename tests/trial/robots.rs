//! Robots of the trial: shipped profiles with a tool, masses, and the errors of one of them.

use super::{at, normal};
use poseshift::model::effects::{Effect, Kind};
use poseshift::model::profile::Profile;
use rand::RngExt;
use rand::rngs::StdRng;

/// A shipped profile, and what it lacks.
struct Shipped {
    yaml: &'static str,
    tool: &'static str,
    /// Masses, where it has none.
    bodies: &'static str,
    /// Typical compliance of joint 2, rad/(N m).
    soft: f64,
}

/// Elbow arms with a spherical wrist, with parallel axes, with coupled axes; 6 to 210 kg.
const ROBOTS: [Shipped; 8] = [
    Shipped {
        yaml: include_str!("../../robots/abb_irb120.yaml"),
        tool: "frame: {x_mm: 50, y_mm: 25, z_mm: 100, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: \
            2.6, cog_mm: [-23, 0, 100]",
        bodies: "",
        soft: 3e-5,
    },
    Shipped {
        yaml: include_str!("../../robots/kuka_kr210_r2700.yaml"),
        tool: "frame: {x_mm: 120, y_mm: -80, z_mm: 250, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: \
            90, cog_mm: [40, 20, 160]",
        bodies: "",
        soft: 2e-7,
    },
    Shipped {
        yaml: include_str!("../../robots/universal_robots_ur5.yaml"),
        tool: "frame: {x_mm: 40, y_mm: -30, z_mm: 120, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: \
            2.2, cog_mm: [10, 15, 60]",
        bodies: "",
        soft: 8e-6,
    },
    Shipped {
        yaml: include_str!("../../robots/universal_robots_ur10.yaml"),
        tool: "frame: {x_mm: -60, y_mm: 45, z_mm: 150, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: \
            6, cog_mm: [-20, 10, 80]",
        bodies: "",
        soft: 4e-6,
    },
    Shipped {
        yaml: include_str!("../../robots/fanuc_lrmate200ic.yaml"),
        tool: "frame: {x_mm: 70, y_mm: -20, z_mm: 110, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: \
            2, cog_mm: [30, 0, 60]",
        bodies: "",
        soft: 3e-5,
    },
    Shipped {
        yaml: include_str!("../../robots/fanuc_r2000ic_165f.yaml"),
        tool: "frame: {x_mm: 180, y_mm: 60, z_mm: 300, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: \
            110, cog_mm: [60, -30, 180]",
        bodies: "",
        soft: 2e-7,
    },
    Shipped {
        yaml: include_str!("../../robots/staubli_tx2_90l.yaml"),
        tool: "frame: {x_mm: 60, y_mm: 30, z_mm: 140, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: \
            5, cog_mm: [20, 10, 70]",
        bodies: "bodies:\n  - {link: 2, mass_kg: 28, cog_mm: [230, 0, 180]}\n  - {link: 3, \
            mass_kg: 16, cog_mm: [20, 0, 40]}\n  - {link: 4, mass_kg: 12, cog_mm: [0, 0, -180]}\n",
        soft: 3e-6,
    },
    Shipped {
        yaml: include_str!("../../robots/yaskawa_ma1400.yaml"),
        tool: "frame: {x_mm: -40, y_mm: 20, z_mm: 320, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: \
            3, cog_mm: [-30, 5, 120]",
        bodies: "bodies:\n  - {link: 2, mass_kg: 26, cog_mm: [260, 0, 60]}\n  - {link: 3, mass_kg: \
            24, cog_mm: [60, 20, 30]}\n  - {link: 4, mass_kg: 12, cog_mm: [0, 0, -250]}\n",
        soft: 2e-6,
    },
];

/// A robot as a profile file, and the typical compliance of its joint 2.
pub fn robot(which: usize) -> (String, f64) {
    let Shipped {
        yaml,
        tool,
        bodies,
        soft,
    } = &ROBOTS[which];
    let mut text = yaml.replace("tools: {}\n", &format!("tools:\n  probe: {{{tool}}}\n"));
    if !bodies.is_empty() {
        text = text.replace("bodies: []\n", bodies);
    }
    (text, *soft)
}

/// Geometry errors and compliances of one robot.
pub fn calibration(profile: &Profile, soft: f64, random: &mut StdRng) -> Vec<Effect> {
    let mut effects = Vec::new();
    for link in 1..6 {
        let parallel = profile.links[link].alpha_rad.sin().abs() < 0.1;
        let next = link < 5 && profile.links[link + 1].alpha_rad.sin().abs() < 0.1;
        let mut p = [0.0; 5];
        p[0] = 5e-4 * normal(random);
        p[1] = 2e-4 * normal(random);
        p[2] = if parallel { 5e-4 * normal(random) } else { 0.0 };
        p[3] = 1e-3 * normal(random);
        p[4] = if next { 0.0 } else { 2e-4 * normal(random) };
        effects.push(at(Kind::LinkGeometry, link, &p));
    }
    for joint in 1..6 {
        let size = soft * 10.0_f64.powf(0.25 * joint as f64);
        effects.push(at(
            Kind::JointCompliance,
            joint,
            &[size * random.random_range(0.5..1.5)],
        ));
    }
    effects
}
