//! What commands that read measurements share.

use super::files::Files;
use crate::identify::parameters::Level;
use crate::identify::pick::Pick;
use crate::task::{Failure, ProfileFile, Rows, Said};
use clap::Args;
use std::path::PathBuf;

/// Files of measurements.
#[derive(Args)]
pub(super) struct MeasurementFiles {
    /// Measurements (CSV); several files are one after another
    #[arg(
        long,
        value_name = "FILE",
        required_unless_present = "joints",
        conflicts_with_all = ["joints", "points"]
    )]
    measurements: Vec<PathBuf>,
    /// Joint angles (CSV) of the rows of --points
    #[arg(long, value_name = "FILE", requires = "points")]
    joints: Option<PathBuf>,
    /// What the device saw at the joint angles of --joints: joined by the column id, else in the
    /// order of the rows
    #[arg(long, value_name = "FILE", requires = "joints")]
    points: Option<PathBuf>,
    /// Names of columns: `x=X,y=Y,q1=J1`, `#3` for the third; `nest1.x=X1` where each reflector
    /// has columns of its own
    #[arg(long, value_name = "NAME=THEIRS,…")]
    columns: Option<String>,
    /// Units of these columns: `m,rad` (mm m cm um in ft; deg rad)
    #[arg(long, value_name = "UNITS")]
    units: Option<String>,
    /// How angles rotate the tool (of columns such as `rx_deg`): xyz, zyx (kuka, fanuc, yaskawa), zyz
    /// (kawasaki), rotation-vector (ur)
    #[arg(long, value_name = "NAME")]
    euler: Option<String>,
    /// The rows (of --joints) are in the order in which the robot drove to them: directions
    /// follow, dir1 to dir6, and how far each joint moved last
    #[arg(long)]
    driven_in_order: bool,
}

impl MeasurementFiles {
    /// All rows, with columns as the options and the profile say.
    pub(super) fn read(&self, files: &Files, profile: &ProfileFile) -> Result<Rows, Failure> {
        let said = Said {
            columns: self.columns.clone(),
            units: self.units.clone(),
            euler: self.euler.clone(),
            in_order: self.driven_in_order,
        };
        let profile = &profile.profile;
        if let (Some(joints), Some(points)) = (&self.joints, &self.points) {
            return Rows::joined(
                &files.source(joints)?,
                &files.source(points)?,
                &said,
                profile,
            );
        }
        let sources = self.measurements.iter().map(|path| files.source(path));
        Rows::read(&sources.collect::<Result<Vec<_>, _>>()?, &said, profile)
    }
}

/// Words of `--identify` and `--fix`.
pub(super) fn picks(option: &str, text: Option<&str>) -> Result<Vec<Pick>, Failure> {
    Pick::parse_list(text.unwrap_or_default())
        .map_err(|error| Failure::with_hint(format!("{option}: {error}"), error.hint()))
}

/// What `--level` means.
pub(super) fn level(number: u8) -> Level {
    match number {
        0 => Level::Frames,
        1 => Level::Joints,
        2 => Level::Geometry,
        _ => Level::Compliance,
    }
}
