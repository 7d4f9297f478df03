//! `profile set`, `profile add-tool`, and what puts external axes into a profile.

use super::super::ending::{Ending, finish};
use super::super::files::{Files, refuse_existing};
use super::super::values::{numbers, pose};
use super::super::{Answer, Output};
use super::Over;
use crate::geometry::Pose;
use crate::geometry::units::{DEG, m_from_mm};
use crate::model::external::{Coordinates, Follows, Positioner, RotaryAxis, TrackAxis};
use crate::printable::name_of;
use crate::task::profile::{
    Changed, add_positioner, add_tool, add_track, import_krc, import_moc, set, tool,
};
use crate::task::{Failure, ProfileFile};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Where a changed profile goes.
#[derive(Args)]
struct Target {
    /// The profile
    profile: PathBuf,
    /// Where to write the changed profile
    #[arg(
        short,
        long,
        value_name = "FILE",
        required_unless_present = "in_place",
        conflicts_with = "in_place"
    )]
    output: Option<PathBuf>,
    /// Change the profile itself
    #[arg(long)]
    in_place: bool,
    #[command(flatten)]
    over: Over,
}

impl Target {
    fn path(&self) -> &Path {
        self.output.as_deref().unwrap_or(&self.profile)
    }

    /// Reads the profile, changes it and writes what came out; everything that is not changed stays
    /// byte by byte.
    fn change(
        &self,
        files: &Files,
        output: Output,
        change: impl FnOnce(&ProfileFile, &str) -> Result<Changed, Failure>,
    ) -> Result<Answer, Failure> {
        if let Some(path) = &self.output {
            refuse_existing(path, self.over.force)?;
        }
        let path = self.path();
        let found = change(&files.profile(&self.profile)?, &name_of(path))?;
        if self.in_place {
            files.replace(&self.profile);
        }
        let ending = Ending {
            written: vec![(path.to_owned(), found.text.as_bytes().into())],
            ..Ending::default()
        };
        finish(files, &found, ending, output)
    }
}

/// Set values of a profile, its comments and layout kept: robot.serial=120-500123
#[derive(Args)]
pub(super) struct Set {
    #[command(flatten)]
    target: Target,
    /// What to set: keys with dots between, joints and other lists counted from 1
    #[arg(required = true, value_name = "PATH=VALUE")]
    values: Vec<String>,
}

impl Set {
    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        self.target
            .change(files, output, |file, name| set(file, &self.values, name))
    }
}

/// Add a tool to a profile
#[derive(Args)]
pub(super) struct AddTool {
    #[command(flatten)]
    target: Target,
    /// The tool on the flange in mm, degrees, kg, and mm of the centre of gravity
    #[arg(value_name = "NAME=X,Y,Z,RX,RY,RZ[,KG[,CX,CY,CZ]]")]
    tool: String,
}

impl AddTool {
    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        let tool = tool(&self.tool)?;
        self.target
            .change(files, output, |file, name| add_tool(file, &tool, name))
    }
}

/// What the controller's poses are relative to
#[derive(Clone, Copy, ValueEnum)]
enum CoordinatesName {
    /// The world: they include the axis
    World,
    /// The base: they do not, and work frames ride along
    Base,
}

/// Which work frames a positioner carries
#[derive(Clone, Copy, ValueEnum)]
enum FollowsName {
    /// Those of which the program says so
    Frame,
    /// All
    Always,
    /// None
    Never,
}

/// Add a linear axis that carries the base to a profile, above those it has
#[derive(Args)]
pub(super) struct AddTrack {
    #[command(flatten)]
    target: Target,
    /// The axis in programs: `eax_a`…`eax_f`, `E1`…`E6`, `BC1`…
    axis: String,
    /// Its direction in the world, as the controller has it
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    direction: String,
    /// Roughly up, in the world
    #[arg(
        long,
        value_name = "X,Y,Z",
        default_value = "0,0,1",
        allow_hyphen_values = true
    )]
    up: String,
    /// Its value where the base stands as kinematics.base says
    #[arg(
        long,
        value_name = "MM",
        default_value_t = 0.0,
        allow_hyphen_values = true
    )]
    zero_mm: f64,
    /// Smallest value
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    min_mm: f64,
    /// Largest value
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    max_mm: f64,
    /// What the controller's poses are relative to
    #[arg(long, value_enum, default_value = "world")]
    coordinates: CoordinatesName,
    /// Encoder pulses of one millimetre, for programs that count in pulses
    #[arg(long, value_name = "N")]
    pulses_per_mm: Option<f64>,
}

impl AddTrack {
    fn axis(&self) -> Result<TrackAxis, Failure> {
        Ok(TrackAxis {
            axis: self.axis.clone(),
            direction: numbers::<3>("--direction", &self.direction)?,
            up: numbers::<3>("--up", &self.up)?,
            zero_m: m_from_mm(self.zero_mm),
            min_m: m_from_mm(self.min_mm),
            max_m: m_from_mm(self.max_mm),
            coordinates: match self.coordinates {
                CoordinatesName::World => Coordinates::World,
                CoordinatesName::Base => Coordinates::Base,
            },
            pulses_per_mm: self.pulses_per_mm,
        })
    }

    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        let axis = self.axis()?;
        self.target
            .change(files, output, |file, name| add_track(file, axis, name))
    }
}

/// Add a positioner that carries work pieces to a profile
#[derive(Args)]
pub(super) struct AddPositioner {
    #[command(flatten)]
    target: Target,
    /// Its name in programs: the unit of RAPID, the number of `MACHINE_DEF` of KRL, ST1 of INFORM
    name: String,
    /// An axis: its name, its frame (z is the axis; a second one in the frame of the first) in mm
    /// and degrees, its limits in degrees, its sense 1 or -1, and its value at zero
    #[arg(
        long,
        required = true,
        value_name = "NAME=X,Y,Z,RX,RY,RZ,MIN,MAX[,SIGN[,ZERO]]"
    )]
    axis: Vec<String>,
    /// The plate on the last axis
    #[arg(long, value_name = "X,Y,Z,RX,RY,RZ", allow_hyphen_values = true)]
    plate: Option<String>,
    /// Which work frames it carries
    #[arg(long, value_enum, default_value = "frame")]
    follows: FollowsName,
}

impl AddPositioner {
    fn positioner(&self) -> Result<Positioner, Failure> {
        let axes = self.axis.iter().map(|text| rotary(text));
        let plate = self.plate.as_deref().map(|text| {
            pose(text).ok_or_else(|| {
                let message = format!("--plate {text}: these are not six finite numbers");
                Failure::with_hint(message, "x,y,z,rx,ry,rz in mm and degrees")
            })
        });
        Ok(Positioner {
            name: self.name.clone(),
            follows: match self.follows {
                FollowsName::Frame => Follows::Frame,
                FollowsName::Always => Follows::Always,
                FollowsName::Never => Follows::Never,
            },
            axes: axes.collect::<Result<_, _>>()?,
            plate: plate.transpose()?.unwrap_or(Pose::identity()),
            points: std::collections::BTreeMap::new(),
        })
    }

    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        let positioner = self.positioner()?;
        self.target.change(files, output, |file, name| {
            add_positioner(file, positioner, name)
        })
    }
}

/// `E2=900,-250,300,0,90,180,-90,90`
fn rotary(text: &str) -> Result<RotaryAxis, Failure> {
    let refused = |why: &str| {
        let hint = "NAME=X,Y,Z,RX,RY,RZ,MIN,MAX[,SIGN[,ZERO]] in mm and degrees";
        Failure::with_hint(format!("--axis {text}: {why}"), hint)
    };
    let (name, values) = text
        .split_once('=')
        .ok_or_else(|| refused("there is no `=` behind its name"))?;
    let numbers: Option<Vec<f64>> = values
        .split(',')
        .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
        .collect();
    let numbers = numbers.ok_or_else(|| refused("not all of its values are finite numbers"))?;
    let (sign, zero) = match numbers[..] {
        [_, _, _, _, _, _, _, _] => (1.0, 0.0),
        [_, _, _, _, _, _, _, _, sign] => (sign, 0.0),
        [_, _, _, _, _, _, _, _, sign, zero] => (sign, zero),
        _ => {
            return Err(refused(&format!(
                "{} numbers; 8 to 10 are taken",
                numbers.len()
            )));
        }
    };
    if sign != 1.0 && sign != -1.0 {
        return Err(refused(&format!("its sense is {sign}; it must be 1 or -1")));
    }
    let [x, y, z] = [numbers[0], numbers[1], numbers[2]].map(m_from_mm);
    let [rx, ry, rz, min_rad, max_rad, zero_rad] = [
        numbers[3], numbers[4], numbers[5], numbers[6], numbers[7], zero,
    ]
    .map(|a| a * DEG);
    Ok(RotaryAxis {
        axis: name.trim().to_owned(),
        at: Pose::from_xyz_rxryrz([x, y, z, rx, ry, rz]),
        sign,
        zero_rad,
        min_rad,
        max_rad,
        pulses_per_deg: None,
    })
}

/// Put base frame, track and stations of an ABB controller into a profile
#[derive(Args)]
pub(super) struct ImportMoc {
    /// MOC.cfg of a backup (folder SYSPAR)
    moc: PathBuf,
    /// The profile of this arm
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Where to write the profile
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    over: Over,
    /// The robot of the file (default: its only one)
    #[arg(long, value_name = "NAME")]
    robot: Option<String>,
    /// The track's axis in programs, where the file does not say its logical axis: `eax_a` is 7
    #[arg(long, value_name = "NAME")]
    axis: Option<String>,
}

impl ImportMoc {
    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        let moc = files.source(&self.moc)?;
        let chosen = (self.robot.as_deref(), self.axis.as_deref());
        let target = Target {
            profile: self.profile.clone(),
            output: Some(self.output.clone()),
            in_place: false,
            over: self.over,
        };
        target.change(files, output, |file, name| {
            import_moc(&moc, file, chosen, name)
        })
    }
}

/// Put base frame, track and positioners of a KUKA controller into a profile
#[derive(Args)]
pub(super) struct ImportKrc {
    /// Folder of an archive with $machine.dat and $config.dat
    folder: PathBuf,
    /// The profile of this arm
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// Where to write the profile
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    over: Over,
}

/// Folders within folders of an archive.
const DEEPEST: usize = 6;

impl ImportKrc {
    /// The files of these names in the folder and those within.
    fn found(folder: &Path, deeper: usize, all: &mut Vec<PathBuf>) -> Result<(), Failure> {
        let failed = |error: std::io::Error| Failure::new(format!("{}: {error}", name_of(folder)));
        let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
            .map_err(failed)?
            .map(|entry| entry.map(|entry| entry.path()).map_err(failed))
            .collect::<Result<_, _>>()?;
        entries.sort();
        for path in entries {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let is_wanted = ["$machine.dat", "$config.dat"]
                .iter()
                .any(|wanted| name.eq_ignore_ascii_case(wanted));
            if is_wanted && path.is_file() {
                all.push(path);
            } else if path.is_dir() && deeper > 0 {
                Self::found(&path, deeper - 1, all)?;
            }
        }
        Ok(())
    }

    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        let mut paths = Vec::new();
        Self::found(&self.folder, DEEPEST, &mut paths)?;
        let named = |wanted: &str| {
            let is = |path: &&PathBuf| {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                name.eq_ignore_ascii_case(wanted)
            };
            paths.iter().filter(is).count()
        };
        let (machines, configs) = (named("$machine.dat"), named("$config.dat"));
        if machines != 1 || configs > 1 {
            return Err(Failure::with_hint(
                format!(
                    "{}: {machines} files $machine.dat and {configs} files $config.dat",
                    name_of(&self.folder)
                ),
                "give the folder of one robot, such as KRC/R1 of an archive",
            ));
        }
        let sources = paths.iter().map(|path| files.source(path));
        let sources = sources.collect::<Result<Vec<_>, _>>()?;
        let target = Target {
            profile: self.profile.clone(),
            output: Some(self.output.clone()),
            in_place: false,
            over: self.over,
        };
        target.change(files, output, |file, name| import_krc(&sources, file, name))
    }
}
