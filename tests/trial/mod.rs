//! Seeded cases for `diagnose`: a robot with something hidden in it, measured by one of two implementations of the physics.

mod hidden;
pub mod truth;

use crate::physics::{Fault, Moment, Robot, tool_pose};
use hidden::{hidden, kinds, scaled};
use poseshift::identify::measurements::{Measurements, last_moves};
use poseshift::model::effects::{Effect, Kind, MOST_PARAMETERS, Site};
use poseshift::model::profile::{Mounted, Profile};
use poseshift::model::{Conditions, Model};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use truth::{faults, robot_of};

/// Noise of a coordinate, mm.
pub const NOISE_MM: f64 = 0.03;
/// Draws of an effect until one of a physical size shows.
const TRIES: usize = 50;

/// Where a diagnosis starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// The profile has the true geometry and compliance.
    Calibrated,
    /// The profile is a drawing.
    Nominal,
}

/// What a group of cases has.
#[derive(Clone, Debug)]
pub struct Group {
    pub name: &'static str,
    pub start: Start,
    /// Effects hidden in each case.
    pub hidden: usize,
    /// Root mean square of what they do, in that of the noise: smallest and largest.
    pub size: (f64, f64),
    /// Heavy tails, gross errors in 3 % of the rows, no column `sigma_mm`.
    pub rough: bool,
    /// Something the registry does not have.
    pub unregistered: bool,
    /// Part of the cases that must be right.
    pub goal: f64,
}

/// Every group of the trial.
pub const GROUPS: [Group; 7] = [
    Group {
        name: "calibrated",
        start: Start::Calibrated,
        hidden: 1,
        size: (2.0, 15.0),
        rough: false,
        unregistered: false,
        goal: 0.98,
    },
    Group {
        name: "nominal",
        start: Start::Nominal,
        hidden: 1,
        size: (2.0, 15.0),
        rough: false,
        unregistered: false,
        goal: 0.95,
    },
    Group {
        name: "small",
        start: Start::Calibrated,
        hidden: 1,
        size: (0.5, 1.0),
        rough: false,
        unregistered: false,
        goal: 0.90,
    },
    Group {
        name: "rough",
        start: Start::Calibrated,
        hidden: 1,
        size: (2.0, 15.0),
        rough: true,
        unregistered: false,
        goal: 0.95,
    },
    Group {
        name: "pairs",
        start: Start::Calibrated,
        hidden: 2,
        size: (2.0, 15.0),
        rough: false,
        unregistered: false,
        goal: 0.90,
    },
    Group {
        name: "clean",
        start: Start::Calibrated,
        hidden: 0,
        size: (0.0, 0.0),
        rough: false,
        unregistered: false,
        goal: 0.99,
    },
    Group {
        name: "unregistered",
        start: Start::Calibrated,
        hidden: 0,
        size: (2.0, 15.0),
        rough: false,
        unregistered: true,
        goal: 0.90,
    },
];

/// One case.
pub struct Case {
    pub profile: Profile,
    /// The profile as a file.
    pub profile_text: String,
    pub measurements: Measurements,
    /// The measurements as a file.
    pub csv: String,
    /// The answer, as [`label`] writes it, sorted.
    pub answer: Vec<String>,
    /// The effects hidden.
    pub effects: Vec<Effect>,
    /// What is hidden, for the table: the effect's name, or what it is.
    pub what: String,
    /// Size, in root mean squares of the noise.
    pub size: f64,
    pub independent: bool,
    /// Length of each row's noise.
    pub noise_mm: Vec<f64>,
}

/// An effect without its values: rows from which on it holds are rounded away.
pub fn label(effect: &Effect) -> String {
    if effect.definition().begins_at_a_row() {
        effect.definition().id.to_owned()
    } else {
        let mut plain = effect.clone();
        plain.site.tool = None;
        plain.label()
    }
}

fn normal(random: &mut StdRng) -> f64 {
    let (u, v): (f64, f64) = (
        random.random_range(1e-300..1.0),
        random.random_range(0.0..1.0),
    );
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

fn at(kind: Kind, index: usize, parameters: &[f64]) -> Effect {
    let mut all = [0.0; MOST_PARAMETERS];
    all[..parameters.len()].copy_from_slice(parameters);
    Effect {
        kind,
        site: Site {
            index,
            ..Site::default()
        },
        parameters: all,
    }
}

const ROBOTS: [&str; 2] = [
    include_str!("../../robots/abb_irb120.yaml"),
    include_str!("../../robots/kuka_kr210_r2700.yaml"),
];
const TOOLS: [&str; 2] = [
    "tools:\n  probe: {frame: {x_mm: 50, y_mm: 25, z_mm: 100, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: 2.6, cog_mm: [-23, 0, 100]}\n",
    "tools:\n  probe: {frame: {x_mm: 120, y_mm: -80, z_mm: 250, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: 90, cog_mm: [40, 20, 160]}\n",
];

/// Geometry errors and compliances of one robot.
fn calibration(profile: &Profile, big: bool, random: &mut StdRng) -> Vec<Effect> {
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
        let size = if big {
            2e-7 * 10.0_f64.powf(0.25 * joint as f64)
        } else {
            3e-5 * 10.0_f64.powf(0.25 * joint as f64)
        };
        effects.push(at(
            Kind::JointCompliance,
            joint,
            &[size * random.random_range(0.5..1.5)],
        ));
    }
    effects
}

fn joints_of(profile: &Profile, count: usize, random: &mut StdRng) -> Vec<[f64; 6]> {
    (0..count)
        .map(|_| {
            profile.mechanism.joints.map(|j| {
                let (middle, half) = (
                    0.5 * (j.min_rad + j.max_rad),
                    (0.5 * (j.max_rad - j.min_rad)).min(2.9),
                );
                middle + 0.85 * half * random.random_range(-1.0..1.0)
            })
        })
        .collect()
}

/// Builds a case. The kinds hidden follow from its number, everything else from the seed.
pub fn case(group: &Group, number: usize, seed: u64, rows: usize) -> Case {
    case_of(group, number, seed, (rows, 1))
}

/// A case in which each pose is measured so many times, one after another.
pub fn case_of(group: &Group, number: usize, seed: u64, (poses, times): (usize, usize)) -> Case {
    let rows = poses * times;
    let mut random =
        StdRng::seed_from_u64(seed.wrapping_mul(1_000_003).wrapping_add(number as u64));
    let which = number % 2;
    let independent = (number / 2) % 2 == 1 || group.unregistered;
    let yaml = ROBOTS[which].replace("tools: {}\n", TOOLS[which]);
    let nominal = Profile::from_yaml(&yaml).expect("a shipped profile with a tool");
    let name = nominal.tools.keys().next().expect("the tool").clone();
    let tool = nominal.tool(&name).expect("the tool");
    let own = calibration(&nominal, which == 1, &mut random);
    let mut profile = nominal.clone();
    let mut truth = nominal.clone();
    truth.effects.clone_from(&own);
    if group.start == Start::Calibrated {
        profile.effects = own;
    } else {
        // the device stands elsewhere and the tool is a guess
        let p = |random: &mut StdRng, size: f64| size * random.random_range(-1.0..1.0);
        let base: [f64; 6] = std::array::from_fn(|k| p(&mut random, if k < 3 { 2.0 } else { 3.0 }));
        let upright = [
            base[0],
            base[1],
            base[2],
            0.01 * base[3],
            0.01 * base[4],
            base[5],
        ];
        truth.world_from_base = poseshift::geometry::Pose::from_xyz_rxryrz(upright);
        // the robot is mounted as its profile says: what is tilted is the device
        let own = nominal.world_from_base.rotation.transpose();
        truth.gravity_m_s2 = truth.world_from_base.rotation * own * nominal.gravity_m_s2;
        let tip: Vec<f64> = (0..3).map(|_| p(&mut random, 1e-3)).collect();
        truth.effects.push(at(Kind::ToolFrame, 0, &tip));
    }
    let q = joints_of(&truth, poses, &mut random).into_iter();
    let q: Vec<[f64; 6]> = q.flat_map(|q| std::iter::repeat_n(q, times)).collect();
    let mut conditions = Vec::new();
    let (mut last, mut direction) = ([0.0; 6], [0.0; 6]);
    let moves = last_moves(&q);
    let length_s = 45.0 * rows as f64;
    let wave = random.random_range(0.0..6.0);
    for (r, joints) in q.iter().enumerate() {
        let warm =
            23.0 + 4.0 * (wave + 5.0 * r as f64 / rows as f64).sin() + 0.2 * normal(&mut random);
        if *joints != last {
            direction = std::array::from_fn(|i| (joints[i] - last[i]).signum());
        }
        conditions.push(Conditions {
            direction,
            temperature_c: Some((warm * 100.0).round() / 100.0),
            time_s: Some(45.0 * r as f64 + random.random_range(0.0..5.0_f64).round()),
            row: u32::try_from(r + 1).ok(),
            moved: moves[r],
            ..Conditions::default()
        });
        last = *joints;
    }
    let model = truth.real_model(&tool, &Conditions::default());
    let mut torques = [0.0_f64; 6];
    for joints in &q {
        for (most, t) in torques
            .iter_mut()
            .zip(model.torques(joints, &Conditions::default()))
        {
            *most = most.max(t.abs());
        }
    }
    let robot = robot_of(&truth, &tool);
    let own_faults: Vec<Fault> = truth.effects.iter().map(faults).collect();
    let see = |effects: &[Effect], more: &[Fault]| -> Vec<[f64; 3]> {
        if independent {
            let mut all = own_faults.clone();
            all.extend(effects.iter().map(faults));
            all.extend(more.iter().cloned());
            seen_by_physics(&robot, &all, &q, &conditions)
        } else {
            let mut all = truth.effects.clone();
            all.extend(effects.iter().cloned());
            seen_by_model(&truth, &tool, &all, &q, &conditions)
        }
    };
    let plain = see(&[], &[]);
    let rms = |other: &[[f64; 3]]| {
        let squares: f64 = plain
            .iter()
            .zip(other)
            .map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>())
            .sum();
        (squares / rows as f64).sqrt()
    };
    let noise_m = NOISE_MM * 1e-3;
    let mut effects: Vec<Effect> = Vec::new();
    let mut more: Vec<Fault> = Vec::new();
    let mut what = "nothing".to_owned();
    let mut size = 0.0;
    let all_kinds = kinds(group.start);
    for k in 0..group.hidden {
        let wanted = random.random_range(group.size.0..group.size.1);
        let mut kind;
        let mut tries = 0;
        loop {
            tries += 1;
            kind = if k == 0 {
                all_kinds[(number / 4) % all_kinds.len()]
            } else {
                all_kinds[random.random_range(0..all_kinds.len())]
            };
            size = wanted;
            let unit = hidden(kind, rows, length_s, &torques, &mut random);
            let moved = rms(&see(std::slice::from_ref(&unit), &[]));
            let again = effects.iter().any(|e: &Effect| label(e) == label(&unit));
            if moved < 1e-9 || again {
                continue;
            }
            let mut by = size * noise_m * 3.0_f64.sqrt() / moved;
            // sizes stay physical, within four typical ones, where this robot and its tool show the effect at all
            let most = |e: &Effect| {
                let typical = e
                    .definition()
                    .parameters
                    .iter()
                    .map(|p| p.prior_sigma * p.unit.in_si());
                let sizes = scaled(e, by)
                    .parameters
                    .into_iter()
                    .zip(scaled(e, 0.0).parameters)
                    .zip(typical);
                sizes
                    .filter(|((_, fixed), _)| *fixed == 0.0)
                    .map(|((p, _), t)| p.abs() / t)
                    .fold(0.0, f64::max)
            };
            let largest = most(&unit);
            if largest > 4.0 && tries < TRIES {
                size *= 4.0 / largest;
                if size < group.size.0 {
                    continue;
                }
                by *= 4.0 / largest;
            }
            effects.push(scaled(&unit, by));
            break;
        }
        what = if k == 0 {
            kind.definition().id.to_owned()
        } else {
            format!("{what} + {}", kind.definition().id)
        };
    }
    if group.unregistered {
        let all = truth::unregistered();
        let (name, make) = &all[number % all.len()];
        let joint = random.random_range(0..6);
        let unit = make(joint, 1e-4);
        let moved = rms(&see(&[], std::slice::from_ref(&unit)));
        size = random.random_range(group.size.0..group.size.1);
        more.push(make(
            joint,
            1e-4 * size * noise_m * 3.0_f64.sqrt() / moved.max(1e-12),
        ));
        (*name).clone_into(&mut what);
    }
    let seen = see(&effects, &more);
    let mut text = String::from(
        "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,dir1,dir2,dir3,dir4,dir5,dir6,temperature_c,time_s",
    );
    if !group.rough {
        text += ",sigma_mm";
    }
    text += "\n";
    let mut noise = Vec::new();
    for r in 0..rows {
        let mut p = seen[r].map(|x| x * 1e3);
        // Student's t with three degrees of freedom, and gross errors
        let heavy = if group.rough {
            let chi: f64 = (0..3).map(|_| normal(&mut random).powi(2)).sum();
            (3.0 / chi).sqrt()
        } else {
            1.0
        };
        let gross = if group.rough && random.random_range(0.0..1.0) < 0.03 {
            random.random_range(1.0..10.0)
        } else {
            0.0
        };
        for x in &mut p {
            *x += NOISE_MM * heavy * normal(&mut random) + gross * normal(&mut random);
        }
        noise.push(
            (0..3)
                .map(|k| (p[k] - 1e3 * seen[r][k]).powi(2))
                .sum::<f64>()
                .sqrt(),
        );
        let cells: Vec<String> = q[r]
            .iter()
            .map(|a| format!("{:.9}", a.to_degrees()))
            .chain(p.iter().map(|x| format!("{x:.6}")))
            .collect();
        let c = &conditions[r];
        let directions: Vec<String> = c.direction.iter().map(|d| format!("{d}")).collect();
        text += &format!(
            "{},{},{},{}",
            cells.join(","),
            directions.join(","),
            c.temperature_c.unwrap_or(0.0),
            c.time_s.unwrap_or(0.0)
        );
        if !group.rough {
            text += &format!(",{NOISE_MM}");
        }
        text += "\n";
    }
    let mut answer: Vec<String> = effects.iter().map(label).collect();
    answer.sort();
    Case {
        profile_text: poseshift::model::profile::rewritten(&yaml, &profile)
            .expect("a plain layout"),
        profile,
        measurements: Measurements::from_csv(text.as_bytes()).expect("rows in the format"),
        csv: text,
        answer,
        effects,
        what,
        size,
        independent,
        noise_mm: noise,
    }
}

fn seen_by_model(
    profile: &Profile,
    tool: &Mounted,
    effects: &[Effect],
    q: &[[f64; 6]],
    conditions: &[Conditions],
) -> Vec<[f64; 3]> {
    let model = Model::build(
        &profile.geometry(tool),
        &profile.mechanism,
        effects,
        &Conditions::default(),
    );
    q.iter()
        .zip(conditions)
        .map(|(q, c)| model.forward(q, c).translation)
        .collect()
}

fn seen_by_physics(
    robot: &Robot,
    faults: &[Fault],
    q: &[[f64; 6]],
    conditions: &[Conditions],
) -> Vec<[f64; 3]> {
    let each = q.iter().zip(conditions).map(|(q, c)| {
        let moment = Moment {
            direction: c.direction,
            force: c.force_n,
            temperature: c.temperature_c.unwrap_or(20.0),
            time: c.time_s.unwrap_or(0.0),
            row: c.row.map_or(0, |r| r as usize),
            moved: c.moved,
        };
        let pose = tool_pose(robot, faults, q, &moment);
        [pose[0][3], pose[1][3], pose[2][3]]
    });
    each.collect()
}
