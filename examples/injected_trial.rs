//! Effects added to real measurements: how often `diagnose` names them first, and what it names
//! where nothing was added.
//!
//! `cargo run --release --example injected_trial -- FOLDER`, with a folder for each robot that has
//! `profile.yaml` and `fit.csv`. Each robot is calibrated (level 3) and diagnosed with all its
//! rows, what was found is taken into the profile, and so on until nothing new is found: that is
//! where the diagnosis of the rows with an effect added starts. What was found of the session, such
//! as a drift of the base, no profile can have: it is taken out of the rows.

#[path = "../tests/physics/mod.rs"]
#[allow(dead_code)]
mod physics;
#[path = "../tests/trial/mod.rs"]
#[allow(dead_code, unused_imports)]
mod trial;

use clap::Parser;
use poseshift::diagnose::{Diagnosis, Options, diagnose};
use poseshift::geometry::Pose;
use poseshift::identify::calibration::{Options as Calibrating, calibrate};
use poseshift::identify::measurements::{Measurement, Measurements, Observed};
use poseshift::model::Conditions;
use poseshift::model::effects::{Effect, Kind};
use poseshift::model::profile::{Mounted, Profile};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use trial::hidden::{hidden, scaled};
use trial::label;

/// Add effects to real measurements and count how often they are named first
#[derive(Parser)]
struct Trial {
    /// Folder with a folder for each robot
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Robots, by the names of their folders; all without
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Seeds
    #[arg(long, value_delimiter = ',', default_value = "1")]
    seed: Vec<u64>,
    /// Sizes, in root mean squares of the residual
    #[arg(long, value_delimiter = ',', default_value = "0.5,1,2")]
    sizes: Vec<f64>,
    /// Print each case that is wrong
    #[arg(long)]
    list: bool,
}

/// Most diagnoses, one after another, whose findings are taken into the start.
const ROUNDS: usize = 8;
/// The largest size that has to be possible, in root mean squares of the residual.
const LARGEST: f64 = 2.0;

/// An effect is drawn again where it would have to be beyond this many times its typical size: a
/// reflector on the axis of a joint does not show how far that rotates.
const MOST_TIMES: f64 = 20.0;
/// And at most so often.
const DRAWS: usize = 100;

/// Whether an arm may have it.
fn may_be(effect: &Effect) -> bool {
    let parameters = effect.parameters.iter().zip(effect.definition().parameters);
    let mut times = parameters.map(|(value, p)| value.abs() / (p.prior_sigma * p.unit.in_si()));
    effect.beyond_usual().is_none() && times.all(|times| times <= MOST_TIMES)
}

/// What is added: seven kinds, backlash only where directions are known.
fn kinds(measurements: &Measurements) -> [Kind; 7] {
    let directed = (measurements.rows.iter()).any(|row| row.conditions.direction != [0.0; 6]);
    [
        Kind::JointCompliance,
        if directed {
            Kind::Backlash
        } else {
            Kind::ToolSlip
        },
        Kind::JointHarmonic,
        Kind::JointScale,
        Kind::LinkGeometry,
        Kind::JointCoupling,
        Kind::Settling,
    ]
}

/// A robot with its measurements and what its own diagnosis says.
struct Robot {
    profile: Profile,
    tool: Mounted,
    measurements: Measurements,
    /// Labels of what is named where nothing was added.
    known: Vec<String>,
    alarms: Vec<String>,
    /// Root mean square of a coordinate's residual, metres.
    residual_m: f64,
}

fn labels(found: &Diagnosis) -> Vec<String> {
    found.found.iter().map(|f| label(&f.effect)).collect()
}

fn asked(profile: &Profile, measurements: &Measurements, options: &Options) -> Option<Diagnosis> {
    diagnose(profile, measurements, options, &mut |_| ()).ok()
}

fn robot(folder: &Path) -> Robot {
    let read = |name: &str| std::fs::read(folder.join(name)).expect("a file of the folder");
    let text = String::from_utf8(read("profile.yaml")).expect("a text");
    let nominal = Profile::from_yaml(&text).expect("a profile");
    let mut measurements = Measurements::from_csv(&read("fit.csv")).expect("measurements");
    let calibrated = calibrate(&nominal, &measurements, &Calibrating::default());
    let mut profile = calibrated.expect("enough rows").profile();
    let (mut known, mut alarms, mut residual_m) = (Vec::new(), Vec::new(), 0.0);
    for _ in 0..ROUNDS {
        let found = asked(&profile, &measurements, &Options::default());
        let found = found.expect("a diagnosis of the rows as they are");
        residual_m = found.residual_m;
        let named = labels(&found);
        alarms = (named.iter().filter(|l| !known.contains(*l)).cloned()).collect();
        known = named;
        if alarms.is_empty() {
            break;
        }
        profile = found.profile;
        let of_session = found.found.iter().map(|f| &f.effect);
        let of_session: Vec<Effect> =
            (of_session.filter(|e| e.definition().of_data).cloned()).collect();
        as_at_the_end(&profile, &mut measurements, &of_session);
    }
    Robot {
        tool: the_tool(&profile),
        known,
        alarms,
        residual_m,
        profile,
        measurements,
    }
}

fn the_tool(profile: &Profile) -> Mounted {
    let name = profile.tools.keys().next().expect("a tool");
    profile.tool(name).expect("the tool")
}

/// Where a profile has the tool at a row's joints, at the time of the row of this number.
fn at(profile: &Profile, tool: &Mounted, row: &Measurement, number: usize) -> Pose {
    let mut conditions = row.conditions;
    conditions.row = u32::try_from(number + 1).ok();
    let model = profile.real_model(tool, &conditions);
    model.forward(&row.q, &conditions)
}

/// What is seen at a row, displaced in the world; its squared length, square metres.
fn displace(row: &mut Measurement, by: &Pose, device: &Pose) -> f64 {
    let by = device.inverse() * *by * *device;
    match &mut row.observed {
        Observed::Position(point) => {
            let moved = by.transform(*point);
            let squared = (0..3).map(|k| (moved[k] - point[k]).powi(2)).sum();
            *point = moved;
            squared
        }
        Observed::Pose(pose) => {
            let moved = by * *pose;
            let squared = moved.separation(pose).distance_m.powi(2);
            *pose = moved;
            squared
        }
        _ => 0.0,
    }
}

/// Takes what was found of the session out of the rows: all are then as the last one, which is what
/// a diagnosis writes into the profile.
fn as_at_the_end(profile: &Profile, measurements: &mut Measurements, of_session: &[Effect]) {
    let mut with = profile.clone();
    with.effects.extend_from_slice(of_session);
    let (tool, device) = (the_tool(profile), profile.world_from_device());
    let last = measurements.rows.len() - 1;
    for (number, row) in measurements.rows.iter_mut().enumerate() {
        let [then, at_last] = [number, last].map(|number| at(&with, &tool, row, number));
        displace(row, &(at_last * then.inverse()), &device);
    }
}

impl Robot {
    /// How far an effect moves the tool at each row, as displacements of the world.
    fn moved(&self, effect: &Effect) -> Vec<Pose> {
        let mut with = self.profile.clone();
        with.effects.push(effect.clone());
        let rows = self.measurements.rows.iter().enumerate();
        let moved = rows.map(|(number, row)| {
            let [before, after] = [&self.profile, &with].map(|p| at(p, &self.tool, row, number));
            after * before.inverse()
        });
        moved.collect()
    }

    /// An effect of this kind whose displacements have this root mean square, and the measurements
    /// with it.
    fn with(&self, kind: Kind, size: f64, random: &mut StdRng) -> (Effect, Measurements) {
        let mut torques = [0.0_f64; 6];
        let model = self.profile.real_model(&self.tool, &Conditions::default());
        for row in &self.measurements.rows {
            let of = model.torques(&row.q, &row.conditions);
            torques
                .iter_mut()
                .zip(of)
                .for_each(|(most, t)| *most = most.max(t.abs()));
        }
        let count = self.measurements.rows.len();
        let device = self.profile.world_from_device();
        let seen = |effect: &Effect| -> (Measurements, f64) {
            let mut seen = self.measurements.clone();
            let mut squares = 0.0;
            for (row, by) in seen.rows.iter_mut().zip(self.moved(effect)) {
                squares += displace(row, &by, &device);
            }
            (seen, (squares / (3.0 * count as f64)).sqrt())
        };
        for _ in 0..DRAWS {
            let unit = hidden(kind, count, 45.0 * count as f64, &torques, random);
            let (_, rms) = seen(&unit);
            let of_size = |size: f64| scaled(&unit, size * self.residual_m / rms);
            if may_be(&of_size(LARGEST)) {
                let effect = of_size(size);
                let (measurements, _) = seen(&effect);
                return (effect, measurements);
            }
        }
        panic!(
            "{DRAWS} of {} are larger than any arm has it",
            kind.definition().id
        )
    }

    /// What is named beyond what is named anyway, in the order of the report: the proof says how
    /// sure each of them is, and names nothing.
    fn named(&self, measurements: &Measurements) -> Vec<String> {
        let quick = Options {
            quick: true,
            ..Options::default()
        };
        let found = asked(&self.profile, measurements, &quick);
        let mut named = found.as_ref().map_or_else(Vec::new, labels);
        named.retain(|label| !self.known.contains(label));
        named
    }
}

fn main() {
    let asked = Trial::parse();
    let mut folders: Vec<PathBuf> = std::fs::read_dir(&asked.folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.join("profile.yaml").is_file())
        .collect();
    folders.sort();
    let (mut all, mut right_ones) = (0, 0);
    for folder in folders {
        let name = folder
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        if !asked.only.is_empty() && !asked.only.contains(&name) {
            continue;
        }
        let robot = robot(&folder);
        println!(
            "{name}: residual {:.4} mm, named as it is: {}, false alarms: {}",
            1e3 * robot.residual_m,
            robot.known.join(", "),
            if robot.alarms.is_empty() {
                "none".into()
            } else {
                robot.alarms.join(", ")
            }
        );
        let kinds = kinds(&robot.measurements);
        let mut cases = Vec::new();
        for seed in &asked.seed {
            for (kind, k) in kinds.iter().zip(0..) {
                let seed = seed.wrapping_mul(1_000_003).wrapping_add(k);
                cases.extend(asked.sizes.iter().map(|size| (*kind, *size, seed)));
            }
        }
        let answers: Vec<(String, f64, Vec<String>)> = cases
            .par_iter()
            .map(|(kind, size, seed)| {
                let mut random = StdRng::seed_from_u64(*seed);
                let (effect, measurements) = robot.with(*kind, *size, &mut random);
                (label(&effect), *size, robot.named(&measurements))
            })
            .collect();
        let is_right =
            |(label, _, named): &&(String, f64, Vec<String>)| named.first() == Some(label);
        for size in &asked.sizes {
            let of_size = answers.iter().filter(|(_, s, _)| s == size);
            let right = of_size.clone().filter(is_right).count();
            println!("  size {size} x residual: {right} of {}", of_size.count());
        }
        all += answers.len();
        right_ones += answers.iter().filter(is_right).count();
        for (label, size, named) in answers
            .iter()
            .filter(|answer| asked.list && !is_right(answer))
        {
            let named = if named.is_empty() {
                "nothing".to_owned()
            } else {
                named.join(", ")
            };
            println!("    {label} at {size}: {named}");
        }
    }
    println!("named first: {right_ones} of {all}");
}
