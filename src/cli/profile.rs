//! `profile`: make and inspect profiles.

use super::failure::Failure;
use super::layout::print_text;
use super::{Answer, Output, files, print, print_json};
use crate::inverse::Arm;
use crate::model::Conditions;
use crate::model::profile::{ControllerModel, Mounted, Profile, SHIPPED};
use crate::report::profile::{facts, typical_deviation};
use crate::urdf::{Choice, UrdfArm, UrdfError, profile_text};
use clap::{Args, Subcommand};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Make and inspect robot profiles
#[derive(Args)]
pub struct ProfileCommand {
    #[command(subcommand)]
    command: Sub,
}

#[derive(Subcommand)]
enum Sub {
    /// Start a profile from a built-in robot
    New {
        /// Name of the robot, as `poseshift robots` lists it
        #[arg(long, value_name = "NAME")]
        robot: String,
        /// Where to write it (default: standard output)
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Print what a person wants to know of a profile
    Show {
        /// The profile
        profile: PathBuf,
    },
    /// Print how two profiles differ; status 1 where they do
    Diff {
        /// The one profile
        a: PathBuf,
        /// The other profile
        b: PathBuf,
    },
    ImportUr(super::import_ur::ImportUr),
    /// Print the JSON Schema of the format
    Schema,
    /// Make a profile of a URDF: its six axes, limits, masses and collision shapes
    FromUrdf(FromUrdf),
}

/// A URDF and what to take of it
#[derive(Args)]
struct FromUrdf {
    /// The URDF (what xacro makes of a xacro file)
    file: PathBuf,
    /// The link that stands still (default: the one without a parent)
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// The link that tools are mounted on (default: tool0, flange, or the only end)
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// Where packages are: a folder that holds them, or NAME=FOLDER of one
    #[arg(long, value_name = "[NAME=]FOLDER")]
    package_path: Vec<String>,
    /// Leave the collision shapes out
    #[arg(long)]
    no_shapes: bool,
    /// Where to write it (default: standard output)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl ProfileCommand {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        match &self.command {
            Sub::New {
                robot,
                output: file,
            } => new(robot, file.as_ref(), output),
            Sub::Show { profile } => show(&files::read_profile(profile)?.0, output),
            Sub::Diff { a, b } => diff(
                &files::read_profile(a)?.0,
                &files::read_profile(b)?.0,
                output,
            ),
            Sub::ImportUr(command) => command.run(output),
            Sub::Schema => print_json(&Profile::schema()).map(|()| Answer::Yes),
            Sub::FromUrdf(command) => command.run(output),
        }
    }
}

impl FromUrdf {
    fn run(&self, output: Output) -> Result<Answer, Failure> {
        let text = files::read_text(&self.file)?;
        let told = |error: &UrdfError| {
            let message = format!("{}: {error}", self.file.display());
            Failure::with_hint(message, error.hint())
        };
        let choice = Choice {
            base: self.base.clone(),
            tip: self.tip.clone(),
            shapes: !self.no_shapes,
        };
        let arm = UrdfArm::read(&text, &choice).map_err(|error| told(&error))?;
        let source = self.file.file_name().unwrap_or_default().to_string_lossy();
        let yaml =
            profile_text(&arm, &source, &|file| self.mesh(file)).map_err(|error| told(&error))?;
        let profile = Profile::from_yaml(&yaml)
            .map_err(|error| Failure::profile(&self.file, &yaml, &error))?;
        let inverse = Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism)
            .as_ref()
            .map_or_else(ToString::to_string, |arm| {
                format!("closed form, {}", arm.kind())
            });
        match &self.output {
            Some(path) if path.exists() => {
                return Err(Failure::new(format!(
                    "{} exists; profiles are not written over",
                    path.display()
                )));
            }
            Some(path) => files::write_all(&[(path.clone(), yaml.clone().into_bytes())])?,
            None => {}
        }
        if output.json {
            print_json(&json!({
                "poseshift": "new-profile/1", "robot": arm.name, "base": arm.ends[0], "tip": arm.ends[1],
                "inverse": inverse, "notes": arm.notes, "profile": yaml,
                "output": self.output.as_ref().map(|path| path.display().to_string()),
            }))?;
            return Ok(Answer::Yes);
        }
        let Some(path) = &self.output else {
            print(&yaml)?;
            return Ok(Answer::Yes);
        };
        if !output.quiet {
            let mut told = format!(
                "{}: {} to {}, the same as the URDF at 1000 postures\ninverse: {inverse}\n",
                arm.name, arm.ends[0], arm.ends[1]
            );
            told.extend(arm.notes.iter().map(|note| format!("note: {note}\n")));
            told += &format!("written to {}\n", path.display());
            print_text(&told)?;
        }
        Ok(Answer::Yes)
    }

    /// Where a mesh is; `None` where it is not.
    fn mesh(&self, file: &str) -> Option<String> {
        let beside = self.file.parent().unwrap_or(Path::new(""));
        let candidates: Vec<PathBuf> = if let Some(rest) = file.strip_prefix("package://") {
            let (package, inside) = rest.split_once('/')?;
            let place = |given: &String| match given.split_once('=') {
                Some((name, folder)) if name == package => Some(Path::new(folder).join(inside)),
                Some(_) => None,
                None => Some(Path::new(given).join(rest)),
            };
            self.package_path.iter().filter_map(place).collect()
        } else {
            let plain = file.strip_prefix("file://").unwrap_or(file);
            vec![beside.join(plain)]
        };
        let found = candidates.into_iter().find(|path| path.is_file())?;
        // profiles name meshes relative to themselves, wherever they are written
        let whole = std::fs::canonicalize(&found).ok()?;
        Some(whole.display().to_string())
    }
}

fn new(robot: &str, file: Option<&PathBuf>, output: Output) -> Result<Answer, Failure> {
    let found = SHIPPED.iter().find(|(name, _)| *name == robot);
    let (name, text) = found.ok_or_else(|| {
        let names: Vec<_> = SHIPPED.iter().map(|(name, _)| *name).collect();
        Failure::with_hint(
            format!("no built-in robot is called `{robot}`"),
            format!("robots are: {}", names.join(", ")),
        )
    })?;
    match file {
        None if output.json => {
            print_json(&json!({"poseshift": "new-profile/1", "robot": name, "profile": text}))?;
        }
        None => print(text)?,
        Some(path) => {
            if path.exists() {
                return Err(Failure::new(format!(
                    "{} exists; profiles are not written over",
                    path.display()
                )));
            }
            files::write_all(&[(path.clone(), text.as_bytes().to_vec())])?;
            if output.json {
                print_json(
                    &json!({"poseshift": "new-profile/1", "robot": name, "output": path.display().to_string()}),
                )?;
            } else if !output.quiet {
                print_text(&format!(
                    "written to {}; set the serial number, the base and the tools\n",
                    path.display()
                ))?;
            }
        }
    }
    Ok(Answer::Yes)
}

/// What a calibrated profile says of where its effects come from and what they are worth, a line each.
fn worth(profile: &Profile) -> Vec<String> {
    let mut lines = Vec::new();
    let said = |key: &str| profile.provenance.as_ref()?.get(key);
    let word = |value: &Value| {
        let text = value.as_str().map(str::to_owned);
        text.unwrap_or_else(|| value.to_string())
    };
    for (name, key) in [
        ("date", "date"),
        ("program", "program"),
        ("rows", "rows"),
        ("temperature, C", "temperature_c"),
        ("measurements, SHA-256", "measurements_sha256"),
    ] {
        let Some(value) = said(key) else { continue };
        match value.as_array() {
            Some(list) => lines.extend(list.iter().map(|v| format!("{name}  {}", word(v)))),
            None => lines.push(format!("{name}  {}", word(value))),
        }
    }
    for (name, key) in [
        ("error before", "before"),
        ("error with base and tool fitted", "frames_only"),
        ("error after", "after"),
    ] {
        let kinds = [("position", "mm"), ("orientation", "deg"), ("range", "mm")];
        for (kind, unit) in kinds {
            let spread = profile
                .quality
                .as_ref()
                .and_then(|quality| quality.get(key)?.get(kind));
            let number = |what: &str| spread?.get(format!("{what}_{unit}"))?.as_f64();
            if let (Some(mean), Some(max)) = (number("mean"), number("max")) {
                lines.push(format!(
                    "{name}, {kind}  mean {mean:.4} {unit}, at most {max:.4} {unit}"
                ));
            }
        }
    }
    lines
}

/// The standard deviations that a calibrated profile tells, by the keys of its parameters.
fn sigmas(profile: &Profile) -> BTreeMap<String, f64> {
    let list = profile
        .quality
        .as_ref()
        .and_then(|quality| quality.get("parameters")?.as_array());
    let one = |entry: &Value| {
        let key = entry.get("key")?.as_str()?.to_owned();
        Some((key, entry.get("sigma")?.as_f64()?))
    };
    list.into_iter().flatten().filter_map(one).collect()
}

/// Values of an effect with their standard deviations where they are told: `a_mm 0.134 ± 0.003`.
fn with_sigmas(effect: &str, values: &str, sigmas: &BTreeMap<String, f64>) -> String {
    let words: Vec<&str> = values.split(' ').collect();
    let pairs = words.chunks(2).map(|pair| {
        let told = sigmas.get(&format!("{effect} {}", pair[0]));
        let told = told.map_or_else(String::new, |sigma| format!(" ± {sigma:.2e}"));
        pair.join(" ") + &told
    });
    pairs.collect::<Vec<_>>().join("  ")
}

/// A line in which hashes show their first digits; `--json` has them whole.
fn with_short_hashes(line: &str) -> String {
    let short = |word: &str| {
        let is_hash = word.len() == 64 && word.bytes().all(|b| b.is_ascii_hexdigit());
        if is_hash {
            format!("{}\u{2026}", &word[..16])
        } else {
            word.to_owned()
        }
    };
    let words: Vec<String> = line.split(' ').map(short).collect();
    words.join(" ")
}

fn show(profile: &Profile, output: Output) -> Result<Answer, Failure> {
    let inverse = Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism);
    let inverse = inverse.as_ref().map_or_else(ToString::to_string, |arm| {
        format!("closed form, {}", arm.kind())
    });
    let deviation = typical_deviation(profile, &Conditions::default());
    if output.json {
        let facts: BTreeMap<_, _> = facts(profile).into_iter().collect();
        print_json(&json!({
            "poseshift": "profile-facts/1", "facts": facts, "inverse": inverse,
            "deviation": {"mean_mm": deviation.mean_mm, "max_mm": deviation.max_mm, "postures": deviation.postures},
            "worth": worth(profile), "sigmas": sigmas(profile),
        }))?;
        return Ok(Answer::Yes);
    }
    let controller = match (profile.controller, &profile.own_effects) {
        (ControllerModel::Nominal, _) => "computes with the nominal chain",
        (ControllerModel::Calibrated, Some(_)) => "computes with a calibrated chain of its own",
        (ControllerModel::Calibrated, None) => "computes with a calibrated chain",
    };
    let mut text = format!(
        "{} {}, serial {}\ncontroller: {}, {controller}\ninverse: {inverse}\n\njoints\n",
        profile.manufacturer,
        profile.model,
        profile.serial.as_deref().unwrap_or("not given"),
        profile.language.as_deref().unwrap_or("language not given"),
    );
    let facts = facts(profile);
    let sigmas = sigmas(profile);
    let start = |key: &str| {
        facts
            .iter()
            .filter(move |(k, _)| k.starts_with(key))
            .cloned()
            .collect::<Vec<_>>()
    };
    for (title, key) in [
        ("", "joint "),
        ("bodies", "body "),
        ("tools", "tool "),
        ("points", "point "),
        (
            "effects in the controller's own chain",
            "controller effect ",
        ),
        ("effects", "effect "),
    ] {
        let rows = start(key);
        if !title.is_empty() && !rows.is_empty() {
            text += &format!("\n{title}\n");
        }
        for (name, value) in rows {
            let value = if key == "effect " {
                with_sigmas(name.strip_prefix(key).unwrap_or(&name), &value, &sigmas)
            } else {
                value
            };
            let value = glued(&name, &value);
            text += &format!("  {}  {value}\n", name.strip_prefix(key).unwrap_or(&name));
        }
    }
    let worth = worth(profile);
    if !worth.is_empty() {
        text += "\ncalibration\n";
        text.extend(
            worth
                .iter()
                .map(|line| format!("  {}\n", with_short_hashes(line))),
        );
    }
    if profile.effects.is_empty() {
        text += "\nno calibration: compensation changes nothing\n";
    } else {
        text += &format!(
            "\nthe real tool is {:.3} mm (mean), at most {:.3} mm, beside the controller's over {} random postures\n",
            deviation.mean_mm, deviation.max_mm, deviation.postures
        );
    }
    print_text(&text)?;
    Ok(Answer::Yes)
}

/// A fact that is names and numbers in turn, so that a line breaks before a name only.
fn glued(name: &str, value: &str) -> String {
    if !(name.starts_with("joint ") || name.contains("effect ")) {
        return value.to_owned();
    }
    let words: Vec<&str> = value.split(' ').collect();
    let pairs: Vec<String> = words.chunks(2).map(|pair| pair.join("\u{a0}")).collect();
    pairs.join(" ")
}

fn diff(a: &Profile, b: &Profile, output: Output) -> Result<Answer, Failure> {
    let (a, b): (BTreeMap<_, _>, BTreeMap<_, _>) = (
        facts(a).into_iter().collect(),
        facts(b).into_iter().collect(),
    );
    let keys: std::collections::BTreeSet<_> = a.keys().chain(b.keys()).collect();
    let changed: Vec<_> = keys
        .into_iter()
        .filter(|key| a.get(*key) != b.get(*key))
        .collect();
    if output.json {
        let rows: Vec<_> = changed
            .iter()
            .map(|key| json!({"key": key, "a": a.get(*key), "b": b.get(*key)}))
            .collect();
        print_json(&json!({"poseshift": "profile-diff/1", "differences": rows}))?;
    } else {
        let mut text = String::new();
        for key in &changed {
            text += &format!("{key}\n");
            let line = |sign: char, value: &String| format!("  {sign} {}\n", glued(key, value));
            text.extend(a.get(*key).map(|value| line('-', value)));
            text.extend(b.get(*key).map(|value| line('+', value)));
        }
        print_text(&text)?;
    }
    Ok(if changed.is_empty() {
        Answer::Yes
    } else {
        Answer::No
    })
}
