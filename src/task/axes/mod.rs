//! `axes`: base and tool from sweeps of single joints, and the axes of positioners.

pub mod positioner;

use self::positioner::{PositionerAxis, positioner_axes, put, swept, values};
use super::Document;
use super::circumstances::Track;
use super::copies::{self, copies, without};
use super::failure::Failure;
use super::measurements::identify_failure;
use super::parts::{Pose, Sigma, findings as remarks};
use super::profile_file::ProfileFile;
use super::table::{JOINTS, Table, unit};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{self, Quaternion};
use crate::identify::input_checks::sweeps::{input_checks, point_on_flange};
use crate::identify::measurements::{DIRECTION_COLUMNS, POSITION_COLUMNS, QUATERNION_COLUMNS};
use crate::model::Conditions;
use crate::model::external::Stand;
use crate::model::profile::{Mounted, Profile};
use crate::program::Source;
use crate::register::axes::outliers::{Outlier, without_outliers};
use crate::register::axes::positioner::{Row as OnPlateRow, Sweep as OnPlate};
use crate::register::axes::sag::{Arm, Frame, Sag as ArmSag, sag};
use crate::register::axes::{
    AxesError, Axis, Circle as Round, Placed, Row, Sweep, axis, base, tool,
};
use crate::register::frame_file::Sigma as Six;
use crate::register::uncertainty::PoseCovariance;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeSet;

/// What the arm's sag under gravity does to a frame.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Sag {
    /// Its standard uncertainties.
    #[serde(flatten)]
    pub sigma: Sigma,
    /// Whose compliance: that of the `profile`, or a `typical` arm's.
    pub from: &'static str,
}

/// The residuals of each row of a sweep.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Rows {
    /// Angle on the circle minus the commanded one.
    pub tangential_deg: Vec<f64>,
    /// Distance from the circle in its plane.
    pub radial_mm: Vec<f64>,
    /// Distance from its plane.
    pub axial_mm: Vec<f64>,
    /// The commanded angle.
    pub angle_deg: Vec<f64>,
}

/// How round a sweep is.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Circle {
    /// The circle's centre in the world.
    pub centre_mm: [f64; 3],
    /// The circle's radius.
    pub radius_mm: f64,
    /// Root mean square of the residual along the circle.
    pub tangential_deg: f64,
    /// Root mean square of the residual in the circle's plane.
    pub radial_mm: f64,
    /// Root mean square of the residual out of the circle's plane.
    pub axial_mm: f64,
    /// Largest residual along the circle.
    pub max_tangential_deg: f64,
    /// Largest residual in the circle's plane.
    pub max_radial_mm: f64,
    /// Largest residual out of the circle's plane.
    pub max_axial_mm: f64,
    /// Each row.
    pub rows: Rows,
    /// Standard deviation of a coordinate; `null` where three rows leave nothing to estimate it
    /// from.
    pub noise_mm: Option<f64>,
}

impl Circle {
    /// With the commanded angle of each row, radians.
    fn of(circle: &Round, angles: impl Iterator<Item = f64>) -> Self {
        let mm = |values: &[f64]| values.iter().map(|v| mm_from_m(*v)).collect();
        Self {
            centre_mm: circle.line.point_m.map(mm_from_m),
            radius_mm: mm_from_m(circle.radius_m),
            tangential_deg: rms(&circle.tangential_rad) / DEG,
            radial_mm: mm_from_m(rms(&circle.radial_m)),
            axial_mm: mm_from_m(rms(&circle.axial_m)),
            max_tangential_deg: largest(&circle.tangential_rad) / DEG,
            max_radial_mm: mm_from_m(largest(&circle.radial_m)),
            max_axial_mm: mm_from_m(largest(&circle.axial_m)),
            rows: Rows {
                tangential_deg: circle.tangential_rad.iter().map(|t| t / DEG).collect(),
                radial_mm: mm(&circle.radial_m),
                axial_mm: mm(&circle.axial_m),
                angle_deg: angles.map(|angle| angle / DEG).collect(),
            },
            noise_mm: circle.noise_m.map(mm_from_m),
        }
    }
}

/// What a sweep says of its joint.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Joint {
    /// From 1.
    pub joint: usize,
    /// Direction of its axis in the world.
    pub axis: [f64; 3],
    /// The circle of the point.
    #[serde(flatten)]
    pub circle: Circle,
    /// Full width of the backlash; `null` where one direction was measured.
    pub backlash_deg: Option<f64>,
    /// Its standard deviation.
    pub backlash_sigma_deg: Option<f64>,
}

/// Frames from sweeps of single joints.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Axes {
    /// `world_from_base`, of a track with it at home; needs the sweeps of joints 1 and 2.
    pub base: Option<Pose>,
    /// Its standard uncertainties where it was measured, the sag in them; `null` where the noise is
    /// not known.
    pub base_sigma: Option<Sigma>,
    /// The sag in them; `null` where the profile has no masses.
    pub base_sag: Option<Sag>,
    /// `flange_from_tool`; needs the sweeps of joints 5 and 6.
    pub tool: Option<Pose>,
    /// Its standard uncertainties, the sag in them; `null` where the noise is not known.
    pub tool_sigma: Option<Sigma>,
    /// The sag in them; `null` where the profile has no masses.
    pub tool_sag: Option<Sag>,
    /// Whether the tool's orientation was measured.
    pub tool_oriented: Option<bool>,
    /// Readings were moved into the controller's world by the profile's
    /// `calibration.world_from_device`; else the device's frame is the world.
    pub device_known: bool,
    /// The joints that were swept.
    pub joints: Vec<Joint>,
    /// The axes of positioners that were swept.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub positioner_axes: Vec<PositionerAxis>,
    /// What a person should look at.
    pub findings: Vec<Finding>,
    /// How the file is named.
    #[serde(skip)]
    pub name: String,
}

impl Document for Axes {
    const KIND: &'static str = "axes/1";
}

/// Finds base and tool frames from single-joint sweeps; `point` names the rows that count.
///
/// # Errors
/// Sweeps that are no circles, in which another joint moves, or of several points.
pub fn axes(file: &ProfileFile, source: &Source, point: Option<&str>) -> Result<Axes, Failure> {
    let (profile, name) = (&file.profile, &source.name);
    let fail = |error: AxesError| Failure::new(format!("{name}: {error}"));
    let mut findings = Vec::new();
    let mut sweeps = Vec::new();
    let device = profile.device.map(|device| device.world_from_device);
    let (of_joints, mut of_plates, stand) = read(profile, source, point)?;
    for (mut sweep, mut lines) in of_joints {
        findings.extend(once(&mut sweep, &mut lines, name));
        if let Some(world_from_device) = &device {
            place(&mut sweep, world_from_device);
        }
        let (kept, outliers) = without_outliers(&sweep, profile).map_err(fail)?;
        sweeps.push(kept);
        let reported = |outlier: &Outlier| left_out(outlier, sweep.joint, lines[outlier.row], name);
        findings.extend(outliers.iter().map(reported));
    }
    for sweep in &mut of_plates {
        findings.extend(once_on_plate(sweep, name));
    }
    let found = sweeps
        .iter()
        .map(|sweep| axis(sweep, profile).map_err(fail))
        .collect::<Result<Vec<_>, _>>()?;
    let pair = |a: usize, b: usize| -> Option<[&Sweep; 2]> {
        let of = |joint: usize| sweeps.iter().find(|sweep| sweep.joint == joint);
        Some([of(a)?, of(b)?])
    };
    let placed_base = pair(0, 1).map(|[first, second]| base(first, second, profile));
    let placed_tool = pair(4, 5).map(|[fifth, sixth]| tool(fifth, sixth, profile));
    let placed_base = placed_base.transpose().map_err(fail)?;
    let placed_tool = placed_tool.transpose().map_err(fail)?;
    let pose = |placed: &Option<Placed>| placed.as_ref().map(|placed| placed.pose);
    let (base_pose, tool_pose) = (pose(&placed_base), pose(&placed_tool));
    let checked = input_checks(
        profile,
        &sweeps,
        &found,
        base_pose.as_ref(),
        tool_pose.as_ref(),
    )
    .map_err(|error| identify_failure(name, &error))?;
    findings.extend(remarks(&checked, name));
    let mounted = only_tool(profile);
    let world_from_base = base_pose.unwrap_or(profile.world_from_base);
    let arm = Arm {
        world_from_base,
        mounted: &mounted,
        point_m: tool_pose.map_or_else(
            || point_on_flange(profile, &sweeps, &world_from_base),
            |tool| tool.translation,
        ),
    };
    let sag_of = |frame, pair: Option<[&Sweep; 2]>, placed: &Option<Placed>| {
        let (Some(pair), Some(placed)) = (pair, placed) else {
            return Ok(None);
        };
        sag(frame, pair, placed, profile, &arm).map_err(fail)
    };
    let base_sag = sag_of(Frame::Base, pair(0, 1), &placed_base)?;
    let tool_sag = sag_of(Frame::Tool, pair(5, 4), &placed_tool)?;
    if mounted.load.is_none() && (base_sag.is_some() || tool_sag.is_some()) {
        let message = "no tool of the profile says what hangs on the flange: the sag in sigma is that \
                       of the arm alone";
        let found = Finding::of_file("no-tool-mass", Severity::Note, name, message.to_owned());
        findings.push(found.hint("give the tool `mass_kg` and `cog_mm` in the profile"));
    }
    // the device is where the profile has it, or where the base that it sees is the profile's
    let home = base_pose.map(|base| at_home(profile, &stand, &base));
    let found_device = home.map(|base| profile.world_from_base * base.inverse());
    let in_world = device.or(found_device);
    for row in of_plates.iter_mut().flat_map(|sweep| &mut sweep.rows) {
        if let Some(world_from_device) = &in_world {
            row.point_m = world_from_device.transform(row.point_m);
        }
    }
    let positioner_axes = positioner_axes(profile, &of_plates)
        .map_err(|error| Failure::new(format!("{name}: {error}")))?;
    Ok(Axes {
        positioner_axes,
        base: home.as_ref().map(Into::into),
        base_sigma: sigma(placed_base.as_ref(), base_sag.as_ref()),
        base_sag: base_sag.as_ref().map(Into::into),
        tool: tool_pose.as_ref().map(Into::into),
        tool_sigma: sigma(placed_tool.as_ref(), tool_sag.as_ref()),
        tool_sag: tool_sag.as_ref().map(Into::into),
        tool_oriented: placed_tool.map(|placed| placed.oriented),
        device_known: device.is_some(),
        joints: found
            .iter()
            .zip(&sweeps)
            .map(|(axis, sweep)| joint(axis, sweep))
            .collect(),
        findings,
        name: name.clone(),
    })
}

/// Leaves out rows of a sweep that repeat an earlier one.
fn once(sweep: &mut Sweep, lines: &mut Vec<usize>, name: &str) -> Option<Finding> {
    let numbers = |row: &Row| {
        let turn = row.rotation.into_iter().flat_map(|r| r.0).flatten();
        let place = row.q.into_iter().chain(row.point_m);
        place.chain([row.direction]).chain(turn)
    };
    let repeated = copies(sweep.rows.iter().map(numbers));
    let named = |row: usize| format!("line {}", lines[row]);
    let found = copies::finding(&repeated, name, named)?;
    let line = lines[repeated[0][0]];
    sweep.rows = without(std::mem::take(&mut sweep.rows), &repeated);
    *lines = without(std::mem::take(lines), &repeated);
    Some(Finding {
        line,
        column: 1,
        ..found
    })
}

/// The same of the sweep of an axis of a positioner.
fn once_on_plate(sweep: &mut OnPlate, name: &str) -> Option<Finding> {
    let rows = sweep.rows.iter();
    let repeated = copies(rows.map(|row| row.values.iter().copied().chain(row.point_m)));
    let axis = sweep.axis + 1;
    let named = |row: usize| format!("row {} of the sweep of e{axis}", row + 1);
    let found = copies::finding(&repeated, name, named);
    sweep.rows = without(std::mem::take(&mut sweep.rows), &repeated);
    found
}

fn left_out(outlier: &Outlier, joint: usize, line: usize, name: &str) -> Finding {
    let message = format!(
        "left out: {:.3} mm from where the other rows of joint {}'s sweep have it; they are off by \
         {:.4} mm (rms)",
        mm_from_m(outlier.off_m),
        joint + 1,
        mm_from_m(outlier.others_m)
    );
    Finding {
        line,
        column: 1,
        ..Finding::of_file("outlier", Severity::Warning, name, message).hint("measure it again")
    }
}

/// Moves what the device gave into the controller's world.
fn place(sweep: &mut Sweep, world_from_device: &geometry::Pose) {
    for row in &mut sweep.rows {
        row.point_m = world_from_device.transform(row.point_m);
        row.rotation = row.rotation.map(|r| world_from_device.rotation * r);
    }
}

/// The profile's only tool, else the flange.
fn only_tool(profile: &Profile) -> Mounted {
    let mut tools = profile.tools.keys();
    let only = tools.next().filter(|_| tools.next().is_none());
    only.and_then(|name| profile.tool(name))
        .unwrap_or_else(Mounted::flange)
}

/// The sweeps by joint with the lines of their rows, those of axes of positioners, and where a track
/// stood meanwhile.
type Sweeps = (Vec<(Sweep, Vec<usize>)>, Vec<OnPlate>, Stand);

fn read(profile: &Profile, source: &Source, only: Option<&str>) -> Result<Sweeps, Failure> {
    let table = Table::read(source)?;
    table.require(&POSITION_COLUMNS)?;
    table.require(&["sweep"])?;
    let has_poses = table.group(&QUATERNION_COLUMNS)?;
    let mut points = BTreeSet::new();
    let mut sweeps: Vec<(Sweep, Vec<usize>)> = Vec::new();
    let mut on_plates: Vec<OnPlate> = Vec::new();
    let track = Track::of(&table, profile)?;
    let mut stood: Option<Stand> = None;
    for row in table.rows() {
        let point = row.text("point").unwrap_or_default();
        if only.is_some_and(|name| name != point) {
            continue;
        }
        let axis = swept(profile, &row)?;
        points.insert((axis.is_some(), point.to_owned()));
        if let Some(axis) = axis {
            let seen = OnPlateRow {
                values: values(profile, &table, &row)?,
                point_m: row.numbers(POSITION_COLUMNS)?.map(m_from_mm),
            };
            put(&mut on_plates, axis, seen);
            continue;
        }
        table.require(&JOINTS)?;
        let stand = track.stand(&row)?;
        if is_elsewhere(stood.get_or_insert_with(|| stand.clone()), &stand) {
            return Err(row.failure(
                "the track stands elsewhere than in the rows before: sweep joints with it at one place"
                    .into(),
            ));
        }
        let number = row.number("sweep")?;
        let joint = (0..6).find(|j| (j + 1) as f64 == number).ok_or_else(|| {
            row.failure(format!(
                "sweep {number} is not a whole number from 1 to 6, nor an external axis as e1"
            ))
        })?;
        let rotation = if has_poses {
            let q = unit(&row, Quaternion(row.numbers(QUATERNION_COLUMNS)?))?;
            Some(q.rotation())
        } else {
            None
        };
        let direction = if table.has(DIRECTION_COLUMNS[joint]) {
            row.number(DIRECTION_COLUMNS[joint])?
        } else {
            0.0
        };
        let measured = Row {
            q: row.joints()?,
            point_m: row.numbers(POSITION_COLUMNS)?.map(m_from_mm),
            rotation,
            direction,
        };
        let known = sweeps.iter_mut().find(|(sweep, _)| sweep.joint == joint);
        if let Some((sweep, lines)) = known {
            sweep.rows.push(measured);
            lines.push(row.line);
        } else {
            let rows = vec![measured];
            sweeps.push((Sweep { joint, rows }, vec![row.line]));
        }
    }
    table.refuse_misspelt()?;
    let several = |plate: bool| points.iter().filter(|(own, _)| *own == plate).count() > 1;
    if several(true) || several(false) {
        let names: Vec<_> = points.into_iter().map(|(_, name)| name).collect();
        let message = format!(
            "{}: several measured points: {}",
            source.name,
            names.join(", ")
        );
        return Err(Failure::with_hint(message, "choose one with --point"));
    }
    if sweeps.is_empty() && on_plates.is_empty() {
        return Err(Failure::new(format!("{}: no rows", source.name)));
    }
    sweeps.sort_by_key(|(sweep, _)| sweep.joint);
    Ok((sweeps, on_plates, stood.unwrap_or_default()))
}

/// Places of a track that differ by less are one, metres.
const SAME_PLACE_M: f64 = 1e-4;

fn is_elsewhere(a: &Stand, b: &Stand) -> bool {
    let mut both = a.values.iter().zip(&b.values);
    both.any(|(a, b)| (a - b).abs() > SAME_PLACE_M)
}

/// Where the base stands at home, of one that was found on a track.
fn at_home(profile: &Profile, stand: &Stand, found: &geometry::Pose) -> geometry::Pose {
    if stand.values.is_empty() {
        return *found;
    }
    let (flange, conditions) = (Mounted::flange(), Conditions::default());
    let base = |stand: &Stand| {
        let model = profile.real_model_at(&flange, &conditions, stand);
        model.link_frames(&[0.0; 6], &conditions)[0]
    };
    *found * base(stand).inverse() * base(&Stand::default())
}

fn as_sigma(covariance: &PoseCovariance) -> Sigma {
    (&Six {
        position_m: covariance.sigma_at_m(covariance.centre_m),
        rotation_rad: covariance.rotation_sigma_rad(),
    })
        .into()
}

/// Noise and sag together; `None` where the noise is not known.
fn sigma(placed: Option<&Placed>, sag: Option<&ArmSag>) -> Option<Sigma> {
    let noise = placed?.covariance?;
    let whole = sag.map_or(noise, |sag| noise.and(&sag.covariance));
    Some(as_sigma(&whole))
}

impl From<&ArmSag> for Sag {
    fn from(sag: &ArmSag) -> Self {
        Self {
            sigma: as_sigma(&sag.covariance),
            from: if sag.typical { "typical" } else { "profile" },
        }
    }
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().map(|v| v.abs()).fold(0.0, f64::max)
}

fn joint(axis: &Axis, sweep: &Sweep) -> Joint {
    let angles = sweep.rows.iter().map(|row| row.q[axis.joint]);
    Joint {
        joint: axis.joint + 1,
        axis: axis.circle.line.direction,
        circle: Circle::of(&axis.circle, angles),
        backlash_deg: axis.backlash_rad.map(|b| b.0 / DEG),
        backlash_sigma_deg: axis.backlash_rad.map(|b| b.1 / DEG),
    }
}
