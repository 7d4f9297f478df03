//! Effects added to real measurements: how often `diagnose` names them first, and what it names
//! where nothing was added.
//!
//! `cargo run --release --example injected_trial -- FOLDER`, with a folder for each robot that has
//! `profile.yaml` and `fit.csv`. Each robot is calibrated (level 3) and diagnosed with all its
//! rows, what was found is taken into the profile, and so on until nothing new is found: that is
//! where the diagnosis of the rows with an effect added starts.

#[path = "../tests/physics/mod.rs"]
#[allow(dead_code)]
mod physics;
#[path = "../tests/trial/mod.rs"]
#[allow(dead_code, unused_imports)]
mod trial;

use clap::Parser;
use poseshift::diagnose::{Diagnosis, Found, Options, diagnose};
use poseshift::geometry::Pose;
use poseshift::identify::calibration::{Options as Calibrating, calibrate};
use poseshift::identify::measurements::{Measurements, Observed};
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
    let measurements = Measurements::from_csv(&read("fit.csv")).expect("measurements");
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
        let of_robot = |f: &&Found| !f.effect.definition().of_data;
        if alarms.is_empty() || !found.found.iter().any(|f| of_robot(&f)) {
            break;
        }
        profile = found.profile;
    }
    let name = profile.tools.keys().next().expect("a tool").clone();
    Robot {
        tool: profile.tool(&name).expect("the tool"),
        known,
        alarms,
        residual_m,
        profile,
        measurements,
    }
}

impl Robot {
    /// How far an effect moves the tool at each row, as displacements of the world.
    fn moved(&self, effect: &Effect) -> Vec<Pose> {
        let mut with = self.profile.clone();
        with.effects.push(effect.clone());
        let rows = self.measurements.rows.iter().enumerate();
        let at = rows.map(|(number, row)| {
            let mut conditions = row.conditions;
            conditions.row = u32::try_from(number + 1).ok();
            let [before, after] = [&self.profile, &with].map(|profile| {
                let model = profile.real_model(&self.tool, &conditions);
                model.forward(&row.q, &conditions)
            });
            after * before.inverse()
        });
        at.collect()
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
                let by = device.inverse() * by * device;
                match &mut row.observed {
                    Observed::Position(point) => {
                        let moved = by.transform(*point);
                        squares += (0..3).map(|k| (moved[k] - point[k]).powi(2)).sum::<f64>();
                        *point = moved;
                    }
                    Observed::Pose(pose) => {
                        let moved = by * *pose;
                        squares += moved.separation(pose).distance_m.powi(2);
                        *pose = moved;
                    }
                    _ => {}
                }
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
