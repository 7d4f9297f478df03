//! Seeded cases for `diagnose`: a robot with something hidden in it, measured by one of two
//! implementations of the physics.

mod device;
mod groups;
pub mod hidden;
pub mod robots;
pub mod truth;

use crate::physics::matrix::M4;
use crate::physics::{Fault, Moment, tool_pose};
pub use device::Device;
pub use groups::{GROUPS, Group, Start};
use hidden::{hidden, kinds, scaled};
use poseshift::identify::calibration::{Options as Calibrating, calibrate};
use poseshift::identify::measurements::{Measurements, last_moves};
use poseshift::model::effects::{Effect, Kind, MOST_PARAMETERS, Site};
use poseshift::model::profile::{Mounted, Profile};
use poseshift::model::{Conditions, Model};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use robots::{calibration, robot};
use truth::{faults, matrix_of, robot_of};

/// Noise of a coordinate, mm.
pub const NOISE_MM: f64 = 0.03;
/// Draws of an effect until one of a physical size shows.
const TRIES: usize = 50;

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
    /// What the robot has, but its calibration did not determine: right where it is named, and
    /// where not.
    pub undetermined: Vec<String>,
    /// The effects hidden.
    pub effects: Vec<Effect>,
    /// What is hidden, for the table: the effect's name, or what it is.
    pub what: String,
    /// Size, in root mean squares of the noise.
    pub size: f64,
    pub independent: bool,
    /// Its rows are positions of one point.
    pub reads_positions: bool,
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

pub fn normal(random: &mut StdRng) -> f64 {
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

/// Joint angles within 85 % of the limits.
pub fn joints_of(profile: &Profile, count: usize, random: &mut StdRng) -> Vec<[f64; 6]> {
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
    let device = Device::of(group, number);
    let (poses, times) = match device.rows_a_pose() {
        1 => (poses, times),
        each => (poses / each, each),
    };
    let rows = poses * times;
    let mut random =
        StdRng::seed_from_u64(seed.wrapping_mul(1_000_003).wrapping_add(number as u64));
    let which = number % group.robots;
    let round = number / group.robots;
    let independent = round % 2 == 1 || group.unregistered;
    let (yaml, soft) = robot(which);
    let nominal = Profile::from_yaml(&yaml).expect("a shipped profile with a tool");
    let name = nominal.tools.keys().next().expect("the tool").clone();
    let tool = nominal.tool(&name).expect("the tool");
    let own = calibration(&nominal, soft, &mut random);
    let mut profile = nominal.clone();
    let mut truth = nominal.clone();
    truth.effects.clone_from(&own);
    if group.start == Start::Measured {
        let count = 50 + (37 * number) % 101;
        let world = World {
            profile: &truth,
            tool: &tool,
            independent,
        };
        profile = measured(&nominal, &world, &device, count, &mut random);
    } else if group.start == Start::Calibrated {
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
            rows: u32::try_from(rows).expect("small"),
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
    let world = World {
        profile: &truth,
        tool: &tool,
        independent,
    };
    let see = |effects: &[Effect], more: &[Fault]| world.see(effects, more, &q, &conditions);
    let plain = see(&[], &[]);
    let rms = |other: &[M4]| {
        let squares: f64 = plain
            .iter()
            .zip(other)
            .map(|(a, b)| (0..3).map(|k| (a[k][3] - b[k][3]).powi(2)).sum::<f64>())
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
                all_kinds[(number / (2 * group.robots) + if group.robots > 2 { number } else { 0 })
                    % all_kinds.len()]
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
            // sizes stay physical, within four typical ones, where this robot and its tool show the
            // effect at all
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
    let seen = see(&device.moving(&effects), &more);
    let (text, noise) = device.table(&q, &seen, &conditions, &effects, &mut random);
    let missing = |e: &&Effect| !profile.effects.iter().any(|known| known.same_place(e));
    let undetermined = match group.start {
        Start::Measured => truth.effects.iter().filter(missing).map(label).collect(),
        _ => Vec::new(),
    };
    let mut answer: Vec<String> = effects.iter().map(label).collect();
    answer.sort();
    Case {
        profile_text: poseshift::model::profile::rewritten(&yaml, &profile)
            .expect("a plain layout"),
        profile,
        measurements: Measurements::from_csv(text.as_bytes()).expect("rows in the format"),
        csv: text,
        answer,
        undetermined,
        effects,
        what,
        size,
        independent,
        reads_positions: device.reads_positions(),
        noise_mm: noise,
    }
}

/// A robot as it really is, in one of two implementations of the physics.
struct World<'a> {
    profile: &'a Profile,
    tool: &'a Mounted,
    independent: bool,
}

impl World<'_> {
    /// Where the tool is at these joint angles, with more that is wrong.
    fn see(
        &self,
        effects: &[Effect],
        more: &[Fault],
        q: &[[f64; 6]],
        conditions: &[Conditions],
    ) -> Vec<M4> {
        let all: Vec<Effect> = self
            .profile
            .effects
            .iter()
            .chain(effects)
            .cloned()
            .collect();
        let each = q.iter().zip(conditions);
        if self.independent {
            let robot = robot_of(self.profile, self.tool);
            let all: Vec<Fault> = all.iter().map(faults).chain(more.iter().cloned()).collect();
            return each
                .map(|(q, c)| tool_pose(&robot, &all, q, &moment(c)))
                .collect();
        }
        let geometry = self.profile.geometry(self.tool);
        let model = Model::build(
            &geometry,
            &self.profile.mechanism,
            &all,
            &Conditions::default(),
        );
        each.map(|(q, c)| matrix_of(&model.forward(q, c))).collect()
    }
}

/// A calibration of the robot from this many noisy rows of the same device.
fn measured(
    nominal: &Profile,
    world: &World,
    device: &Device,
    count: usize,
    random: &mut StdRng,
) -> Profile {
    let times = device.rows_a_pose();
    let poses = joints_of(world.profile, count, random).into_iter();
    let q: Vec<[f64; 6]> = poses.flat_map(|q| std::iter::repeat_n(q, times)).collect();
    let conditions = vec![Conditions::default(); q.len()];
    let seen = world.see(&[], &[], &q, &conditions);
    let (text, _) = device
        .calibrating()
        .table(&q, &seen, &conditions, &[], random);
    let rows = Measurements::from_csv(text.as_bytes()).expect("rows in the format");
    let found = calibrate(nominal, &rows, &Calibrating::default()).expect("enough rows");
    let mut profile = found.profile();
    profile.provenance = Some(serde_json::json!({"rows": q.len()}));
    profile
}

fn moment(c: &Conditions) -> Moment {
    Moment {
        direction: c.direction,
        force: c.force_n,
        temperature: c.temperature_c.unwrap_or(20.0),
        time: c.time_s.unwrap_or(0.0),
        point: c.point,
        row: c.row.map_or(0, |r| r as usize),
        rows: c.rows as usize,
        moved: c.moved,
    }
}
