//! The factory calibration of Universal Robots arms, as link geometry of a profile.
//!
//! Two files tell it. The controller's own `calibration.conf` has differences to the maker's table
//! of standard Denavit–Hartenberg parameters, metres and radians, joint 1 to 6:
//!
//! ```text
//! [mounting]
//! delta_theta = [ -8.2e-05, -0.10, 0.67, -0.57, -4.6e-05, 9.7e-07]
//! delta_a = [ -0.00016, 0.0030, 0.092, -9.6e-05, -3.0e-05, 0]
//! delta_d = [ 0.00051, 11.2, -92.5, 81.3, -0.00021, -0.00013]
//! delta_alpha = [ -0.00032, -0.0057, -0.0038, -0.0011, 0.0010, 0]
//! calibration_status = 2 # 0 == notInitialized / 1 == notLinearised / 2 == Linearised
//! ```
//!
//! Its row i is `Rz(q + θ) · Tz(d) · Tx(a) · Rx(α)`: a and α stand behind the joint, in ours before
//! it, so a and α of its row i belong to our row i + 1. Axes 2, 3 and 4 are nearly parallel, their
//! common normals lie far away, and d and θ of the three rows are large and cancel.
//!
//! The ROS driver's `ur_calibration` writes the same arm as `kinematics:` with a pose `x y z roll
//! pitch yaw` before each of the joints `shoulder … wrist_3`.
//!
//! Both become [`Axes`], and these rows with β instead of the large d ([`Axes::rows`]): the same
//! chain for all joint angles.
//!
//! # Limits
//! The controller also corrects each joint's encoder (`joint_selftest_data`); that happens before
//! its joint angles.

use super::Profile;
use super::file::Number;
use crate::geometry::{Pose, Rotation};
use crate::model::effects::{Effect, Kind, MOST_PARAMETERS, Site};
use crate::model::{Axes, RowsError};
use serde::Deserialize;
use std::f64::consts::PI;

/// Why a calibration cannot be imported.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UrError {
    /// Neither of the two files.
    #[error("neither a calibration.conf ([mounting], delta_theta, …) nor a kinematics: file")]
    Unknown,
    /// A list of calibration.conf is missing.
    #[error("there is no `{key}`")]
    Missing {
        /// Its key.
        key: &'static str,
    },
    /// A list stands there twice.
    #[error("`{key}` stands there twice")]
    Twice {
        /// Its key.
        key: &'static str,
        /// Line, from 1.
        line: usize,
    },
    /// A list that is not six numbers in brackets.
    #[error("`{key}` is not [ six finite numbers ]")]
    NotSix {
        /// Its key.
        key: &'static str,
        /// Line, from 1.
        line: usize,
    },
    /// The controller does not use its calibration.
    #[error("calibration_status is 0: this arm has no calibration")]
    NotCalibrated {
        /// Line, from 1.
        line: usize,
    },
    /// The kinematics file cannot be read.
    #[error("{message}")]
    Yaml {
        /// What the parser says.
        message: String,
        /// Line, from 1; 0 where the parser cannot tell.
        line: usize,
    },
    /// The profile's rows are not the maker's table.
    #[error("the profile's chain is not the maker's: {what} of row {row} is {found}, not {wanted}")]
    NotTheTable {
        /// Which number, with its unit.
        what: &'static str,
        /// Row, from 1.
        row: usize,
        /// Value in the profile.
        found: f64,
        /// Value of every arm of the maker.
        wanted: f64,
    },
    /// The axes are none of this arm.
    #[error(transparent)]
    Rows(#[from] RowsError),
}

impl UrError {
    /// The line to point at; 0 where there is none.
    #[must_use]
    pub fn line(&self) -> usize {
        match self {
            Self::Twice { line, .. }
            | Self::NotSix { line, .. }
            | Self::NotCalibrated { line }
            | Self::Yaml { line, .. } => *line,
            _ => 0,
        }
    }

    /// The way out; empty where the message says it all.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Unknown | Self::Missing { .. } => {
                "calibration.conf is in the folder .urcontrol of the controller; `ros2 launch \
                 ur_calibration` writes the other"
            }
            Self::NotTheTable { .. } => "take a built-in profile: `poseshift robots` lists them",
            Self::Rows(_) => "is this the nominal profile of this type of arm?",
            _ => "",
        }
    }
}

/// The link geometry of an arm's factory calibration, against the rows of its nominal profile.
///
/// # Errors
/// Where the text is neither file, or its axes are not those of an arm of the profile's type.
pub fn link_geometry(text: &str, nominal: &Profile) -> Result<Vec<Effect>, UrError> {
    let axes = axes(text, nominal)?;
    let rows = axes.rows(
        &nominal.links,
        &nominal.mechanism,
        &nominal.link6_from_flange,
    )?;
    let effect = |index: usize| {
        let (row, old) = (&rows[index], &nominal.links[index]);
        let mut parameters = [0.0; MOST_PARAMETERS];
        parameters[..5].copy_from_slice(&[
            row.alpha_rad - old.alpha_rad,
            row.a_m - old.a_m,
            row.beta_rad - old.beta_rad,
            row.theta_rad - old.theta_rad,
            row.d_m - old.d_m,
        ]);
        Effect {
            kind: Kind::LinkGeometry,
            site: Site {
                index,
                ..Site::default()
            },
            parameters,
        }
    };
    let effects = (0..6).map(effect);
    Ok(effects.filter(|effect| !effect.is_zero()).collect())
}

/// The axes that a calibration describes.
///
/// # Errors
/// Where the text is neither file.
pub fn axes(text: &str, nominal: &Profile) -> Result<Axes, UrError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let starts = |key: &str| text.lines().any(|line| line.trim_start().starts_with(key));
    if starts("delta_") || starts("[mounting]") {
        Ok(Deltas::read(text)?.axes(&standard_rows(nominal)?))
    } else if starts("kinematics") {
        from_ros(text)
    } else {
        Err(UrError::Unknown)
    }
}

/// `calibration.conf`: what is added to θ, a, d, α.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Deltas([[f64; 6]; 4]);

const KEYS: [&str; 4] = ["delta_theta", "delta_a", "delta_d", "delta_alpha"];

impl Deltas {
    fn read(text: &str) -> Result<Self, UrError> {
        let mut found: [Option<[f64; 6]>; 4] = [None; 4];
        for (index, line) in text.lines().enumerate() {
            let (line, number) = (line.split('#').next().unwrap_or(""), index + 1);
            let Some((key, value)) = line.split_once('=') else {
                continue;
            };
            let key = key.trim();
            if key == "calibration_status" && value.trim() == "0" {
                return Err(UrError::NotCalibrated { line: number });
            }
            let Some(which) = KEYS.iter().position(|known| *known == key) else {
                continue;
            };
            let key = KEYS[which];
            if found[which].is_some() {
                return Err(UrError::Twice { key, line: number });
            }
            let six = six(value).ok_or(UrError::NotSix { key, line: number })?;
            found[which] = Some(six);
        }
        let mut lists = [[0.0; 6]; 4];
        for ((list, found), key) in lists.iter_mut().zip(found).zip(KEYS) {
            *list = found.ok_or(UrError::Missing { key })?;
        }
        Ok(Self(lists))
    }

    /// The axes of `Rz(q + θ) · Tz(d) · Tx(a) · Rx(α)`, six times.
    fn axes(&self, rows: &[StandardRow; 6]) -> Axes {
        let [theta, a, d, alpha] = &self.0;
        let before = |i: usize| {
            Pose::from_rotation(Rotation::about_z(theta[i]))
                * Pose::from_translation(0.0, 0.0, rows[i].d_m + d[i])
        };
        let behind = |i: usize| {
            Pose::from_translation(rows[i].a_m + a[i], 0.0, 0.0)
                * Pose::from_rotation(Rotation::about_x(rows[i].alpha_rad + alpha[i]))
        };
        // a rotation about an axis and a shift along it change places with the joint's rotation
        Axes {
            steps: std::array::from_fn(|i| match i {
                0 => before(0),
                _ => behind(i - 1) * before(i),
            }),
            last: behind(5),
        }
    }
}

fn six(value: &str) -> Option<[f64; 6]> {
    let inside = value.trim().strip_prefix('[')?.strip_suffix(']')?;
    let numbers: Option<Vec<f64>> = inside
        .split(',')
        .map(|number| number.trim().parse().ok())
        .collect();
    let six: [f64; 6] = numbers?.try_into().ok()?;
    six.iter().all(|number| number.is_finite()).then_some(six)
}

/// A row of the maker's table.
struct StandardRow {
    d_m: f64,
    a_m: f64,
    alpha_rad: f64,
}

/// The maker's table from the rows of a profile, which must be that table in our form, with the x
/// axes of frames in either direction.
///
/// Where x of a row's frame is turned over (half a revolution about z, which θ of the row begins and
/// that of another ends), `Rz(π) · Rx(α) · Tx(a) = Rx(−α) · Tx(−a) · Rz(π)`: α and a of the next row
/// change their signs.
fn standard_rows(nominal: &Profile) -> Result<[StandardRow; 6], UrError> {
    const ALPHA_DEG: [f64; 6] = [0.0, 90.0, 0.0, 0.0, 90.0, -90.0];
    let links = &nominal.links;
    let mut rows = [const {
        StandardRow {
            d_m: 0.0,
            a_m: 0.0,
            alpha_rad: 0.0,
        }
    }; 6];
    let mut is_over = false;
    for (i, (link, joint)) in links.iter().zip(&nominal.mechanism.joints).enumerate() {
        let side = if is_over { -1.0 } else { 1.0 };
        let first_a = if i == 0 { link.a_m } else { 0.0 };
        let turned = (link.theta_rad + joint.offset_rad).to_degrees();
        let halves = (turned / 180.0).round();
        let checks = [
            (
                "alpha_deg",
                link.alpha_rad.to_degrees(),
                side * ALPHA_DEG[i],
            ),
            ("a_mm", 1e3 * first_a, 0.0),
            ("beta_deg", link.beta_rad.to_degrees(), 0.0),
            ("theta_deg + offset_deg", turned, 180.0 * halves),
            ("sign", joint.sign, 1.0),
        ];
        for (what, found, wanted) in checks {
            if (found - wanted).abs() > 1e-9 {
                return Err(UrError::NotTheTable {
                    what,
                    row: i + 1,
                    found,
                    wanted,
                });
            }
        }
        if i > 0 {
            rows[i - 1].a_m = side * link.a_m;
            rows[i - 1].alpha_rad = side * link.alpha_rad;
        }
        rows[i].d_m = link.d_m;
        is_over ^= halves.rem_euclid(2.0) > 0.5;
    }
    let back = if is_over { PI } else { 0.0 };
    let back = Pose::from_rotation(Rotation::about_z(back));
    let flange = nominal.link6_from_flange.separation(&back);
    if flange.distance_m > 1e-9 || flange.angle_rad > 1e-9 {
        return Err(UrError::NotTheTable {
            what: "the flange on link 6, distance in mm,",
            row: 6,
            found: 1e3 * flange.distance_m,
            wanted: 0.0,
        });
    }
    Ok(rows)
}

#[derive(Deserialize)]
struct RosFile {
    kinematics: RosJoints,
}

#[derive(Deserialize)]
struct RosJoints {
    shoulder: RosPose,
    upper_arm: RosPose,
    forearm: RosPose,
    wrist_1: RosPose,
    wrist_2: RosPose,
    wrist_3: RosPose,
}

/// `Trans(x, y, z) · Rz(yaw) · Ry(pitch) · Rx(roll)`, metres and radians.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RosPose {
    x: Number,
    y: Number,
    z: Number,
    roll: Number,
    pitch: Number,
    yaw: Number,
}

fn from_ros(text: &str) -> Result<Axes, UrError> {
    let file: RosFile = serde_yaml::from_str(text).map_err(|error| {
        let line = error.location().map_or(0, |at| at.line());
        let message = error.without_snippet().to_string();
        UrError::Yaml {
            message: message.split(" at line ").next().unwrap_or("").to_owned(),
            line: usize::try_from(line).unwrap_or(0),
        }
    })?;
    let k = file.kinematics;
    let joints = [
        k.shoulder,
        k.upper_arm,
        k.forearm,
        k.wrist_1,
        k.wrist_2,
        k.wrist_3,
    ];
    Ok(Axes {
        steps: joints.map(|p| {
            let turn = Rotation::about_z(p.yaw.0)
                * Rotation::about_y(p.pitch.0)
                * Rotation::about_x(p.roll.0);
            Pose::from_translation(p.x.0, p.y.0, p.z.0) * Pose::from_rotation(turn)
        }),
        // the frame behind wrist 3 is the flange
        last: Pose::identity(),
    })
}
