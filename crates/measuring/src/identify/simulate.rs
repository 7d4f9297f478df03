//! Measurements of the robot that a profile describes: the truth that an identification must find
//! again.

use super::measurements::{Measurement, Observed, last_directions, last_moves};
use super::random::Random;
use crate::geometry::{Pose, Rotation, Vector, add, norm, sub};
use crate::model::external::Stand;
use crate::model::{Conditions, Model};
use crate::profile::{Mounted, Profile};

/// What the imagined device gives.
#[derive(Clone, Debug, PartialEq)]
pub enum Device {
    /// Positions.
    Position,
    /// Positions and orientations.
    Pose,
    /// Distances from these points of the world, in turn, metres.
    Distance(Vec<Vector>),
}

/// How to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// What the device gives.
    pub device: Device,
    /// Standard deviation of a coordinate or distance, metres.
    pub noise_m: f64,
    /// Standard deviation of an angle about each axis, radians.
    pub noise_rad: f64,
    /// Part of the rows that are wrong.
    pub outliers: f64,
    /// Size of a wrong row's error, metres.
    pub outlier_m: f64,
    /// Temperature of the first and last row, °C.
    pub temperature_c: Option<[f64; 2]>,
    /// Time from row to row, seconds.
    pub interval_s: Option<f64>,
    /// Seed.
    pub seed: u64,
}

impl Default for Session {
    fn default() -> Self {
        Self {
            device: Device::Position,
            noise_m: 0.0,
            noise_rad: 0.0,
            outliers: 0.0,
            outlier_m: 0.01,
            temperature_c: None,
            interval_s: None,
            seed: 1,
        }
    }
}

/// A configuration to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// Joint angles, radians.
    pub q: [f64; 6],
    /// Where external axes stand; their directions are those from the configuration before where
    /// they are not given.
    pub stand: Stand,
    /// Index of the positioner on whose plate the points are; else they are on the tool.
    pub plate: Option<usize>,
    /// From which side each joint comes; from the configuration before where it is not given.
    pub direction: Option<[f64; 6]>,
    /// Force of the process on the tool, newtons, as in [`Conditions`].
    pub force_n: Vector,
}

/// What is known of a configuration besides: the session says it where this does not.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given {
    /// Its id: with a number behind it where several points are measured there.
    pub id: Option<String>,
    /// Temperature of the arm, °C.
    pub temperature_c: Option<f64>,
    /// Time since the session began, seconds.
    pub time_s: Option<f64>,
}

/// From which side an external axis comes: −1, 0, or +1.
fn side(from: f64, to: f64) -> f64 {
    match to.total_cmp(&from) {
        std::cmp::Ordering::Less => -1.0,
        std::cmp::Ordering::Equal => 0.0,
        std::cmp::Ordering::Greater => 1.0,
    }
}

fn noise(random: &mut Random, sigma: f64) -> Vector {
    std::array::from_fn(|_| sigma * random.normal())
}

/// Measures a robot in these configurations, all of `points` (names with places in the tool frame,
/// metres) at each; where they are on a plate, those of its positioner.
///
/// The same seed gives the same noise for every profile: a difference between two files is that of
/// the robots.
#[must_use]
pub fn simulate(
    profile: &Profile,
    tool: &Mounted,
    points: &[(Option<String>, Vector)],
    commands: &[Command],
    session: &Session,
) -> Vec<Measurement> {
    simulate_given(profile, tool, points, (commands, &[]), session)
}

/// The same with what is known of the first configurations besides.
#[must_use]
pub fn simulate_given(
    profile: &Profile,
    tool: &Mounted,
    points: &[(Option<String>, Vector)],
    (commands, given): (&[Command], &[Given]),
    session: &Session,
) -> Vec<Measurement> {
    let mut random = Random::new(session.seed);
    let mut rows = Vec::new();
    let count = commands.len();
    let of_tool = commands.iter().filter(|command| command.plate.is_none());
    let postures: Vec<_> = of_tool.map(|command| command.q).collect();
    let directions = last_directions(&profile.mechanism, &postures);
    let mut motions = last_moves(&postures).into_iter().zip(directions);
    let on_plate = |positioner: usize| {
        let points = &profile.external.positioners[positioner].points;
        let named = points
            .iter()
            .map(|(name, point)| (Some(name.clone()), *point));
        named.collect::<Vec<_>>()
    };
    for (i, command) in commands.iter().enumerate() {
        let of_arm = command.plate.is_none().then(|| motions.next()).flatten();
        let (moved, direction) = of_arm.unwrap_or_default();
        let mut conditions = Conditions {
            direction: command.direction.unwrap_or(direction),
            moved,
            force_n: command.force_n,
            device_m: profile.world_from_device().translation,
            ..Conditions::default()
        };
        let mut stand = command.stand.clone();
        if stand.directions.is_empty() {
            let before = &commands[i.saturating_sub(1)].stand.values;
            let both = before.iter().zip(&stand.values);
            stand.directions = both.map(|(from, to)| side(*from, *to)).collect();
        }
        let part = i as f64 / (count.max(2) - 1) as f64;
        if let Some([first, last]) = session.temperature_c {
            conditions.temperature_c = Some(first + part * (last - first));
        }
        if let Some(interval) = session.interval_s {
            conditions.time_s = Some(interval * i as f64);
        }
        let known = given.get(i);
        conditions.temperature_c = known
            .and_then(|g| g.temperature_c)
            .or(conditions.temperature_c);
        conditions.time_s = known.and_then(|g| g.time_s).or(conditions.time_s);
        let pose_of = |conditions: &Conditions| match command.plate {
            None => {
                let model: Model = profile.real_model_at(tool, conditions, &stand);
                model.forward(&command.q, conditions)
            }
            Some(plate) => profile.external.plate(plate, stand.at(), &profile.effects),
        };
        let at_device = pose_of(&conditions);
        let own = command.plate.map(on_plate);
        let here = own.as_deref().unwrap_or(points);
        for (k, (name, point)) in here.iter().enumerate() {
            let (shift, turn) = (
                noise(&mut random, session.noise_m),
                noise(&mut random, session.noise_rad),
            );
            let direction = noise(&mut random, 1.0);
            let wrong = random.even() < session.outliers;
            let size = if wrong {
                session.outlier_m / norm(direction).max(1e-9)
            } else {
                0.0
            };
            let shift = add(shift, direction.map(|x| x * size));
            let pose = match &session.device {
                Device::Distance(from) => {
                    conditions.device_m = from[rows.len() % from.len().max(1)];
                    pose_of(&conditions)
                }
                Device::Position | Device::Pose => at_device,
            };
            let seen = add(pose.transform(*point), shift);
            let observed = match &session.device {
                Device::Position => Observed::Position(seen),
                Device::Pose => Observed::Pose(Pose {
                    rotation: Rotation::from_vector(turn) * pose.rotation,
                    translation: seen,
                }),
                Device::Distance(_) => {
                    let from_m = conditions.device_m;
                    let true_m = norm(sub(pose.transform(*point), from_m));
                    Observed::Distance {
                        distance_m: true_m + shift[0],
                        from_m,
                    }
                }
            };
            rows.push(Measurement {
                line: (rows.len() + 2).into(),
                id: match known.and_then(|g| g.id.as_ref()) {
                    None => (rows.len() + 1).to_string(),
                    Some(id) if here.len() == 1 => id.clone(),
                    Some(id) => format!("{id}-{}", k + 1),
                },
                q: command.q,
                observed,
                tool: command.plate.is_none().then(|| tool.name.clone()),
                point: name.clone(),
                point_in_tool_m: None,
                conditions,
                stand: stand.clone(),
                plate: command
                    .plate
                    .map(|plate| profile.external.positioners[plate].name.clone()),
                sigma_m: (session.noise_m > 0.0).then_some(session.noise_m),
                sigma_rad: (session.noise_rad > 0.0).then_some(session.noise_rad),
                purpose: None,
                contact: None,
            });
        }
    }
    rows
}
