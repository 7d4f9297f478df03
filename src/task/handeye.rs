//! `handeye`: where a camera is.

use super::Document;
use super::circumstances::Circumstances;
use super::copies::{self, copies, without};
use super::failure::Failure;
use super::parts::{Ellipsoid, Pose, Sigma};
use super::profile_file::ProfileFile;
use super::register::provenance;
use super::table::{JOINTS, POSE, Row as TableRow, Table, pose};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose as Motion, Vector};
use crate::model::Conditions;
use crate::model::effects::{Effect, Need};
use crate::model::profile::Mounted;
use crate::program::Source;
use crate::register::frame_file::{Frame, Sigma as Six};
use crate::register::handeye::{
    Corners as Refinement, HandEye as Problem, Method, Refined, Setup, WEAK_RAD, refine_by_corners,
};
use schemars::JsonSchema;
use serde::Serialize;

/// Robot poses, and what else is known.
pub struct Inputs<'a> {
    /// `base_from_flange`, or joints with `profile`.
    pub robot: &'a Source,
    /// `camera_from_board`, row by row.
    pub board: &'a Source,
    /// The model that makes poses of joints.
    pub profile: Option<&'a ProfileFile>,
    /// The tool whose load the arm carried.
    pub tool: Option<&'a str>,
    /// Corners seen by the camera and touched by the robot.
    pub corners: Option<&'a Source>,
}

/// What each method finds of the camera; `null` where it finds nothing.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Methods {
    /// R. Y. Tsai, R. K. Lenz.
    pub tsai: Option<Pose>,
    /// F. C. Park, B. J. Martin.
    pub park: Option<Pose>,
    /// R. Horaud, F. Dornaika.
    pub horaud: Option<Pose>,
    /// K. Daniilidis.
    pub daniilidis: Option<Pose>,
    /// All rows fitted together.
    pub refined: Pose,
}

impl Methods {
    /// Each with its name, in the order of the keys.
    #[must_use]
    pub fn named(&self) -> [(&'static str, Option<&Pose>); 5] {
        [
            ("tsai", self.tsai.as_ref()),
            ("park", self.park.as_ref()),
            ("horaud", self.horaud.as_ref()),
            ("daniilidis", self.daniilidis.as_ref()),
            ("refined", Some(&self.refined)),
        ]
    }
}

/// The residual of a row, in the fit and when it is left out of it.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Row {
    /// In the fit.
    pub residual_mm: f64,
    /// In the fit.
    pub residual_deg: f64,
    /// `PoseResidual` out of it.
    pub left_out_mm: f64,
    /// `PoseResidual` out of it.
    pub left_out_deg: f64,
    /// Where the flange was, in the frame of the robot's poses; of joints the controller's world.
    pub place_mm: [f64; 3],
}

/// The refinement by corners that the robot touched.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Corners {
    /// Whether left-out corners improve.
    pub accepted: bool,
    /// Root mean square distance of the corners without it.
    pub before_mm: f64,
    /// With it.
    pub after_mm: f64,
    /// Of each corner with a refinement by the others.
    pub left_out_mm: f64,
    /// What is applied to the camera's pose.
    pub correction: Pose,
}

/// Where the camera and the board are.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct HandEye {
    /// `eye-to-hand` or `eye-in-hand`.
    pub setup: &'static str,
    /// `base_from_camera`, or `flange_from_camera` of an eye in hand; the base is the frame that the
    /// robot's poses are in, and of joints the controller's world.
    pub camera: Pose,
    /// `flange_from_board`, or `base_from_board` of an eye in hand.
    pub board: Pose,
    /// What each method finds of the camera.
    pub by_method: Methods,
    /// Root mean square residual.
    pub residual_mm: f64,
    /// Root mean square residual.
    pub residual_deg: f64,
    /// The same of rows left out of the fit.
    pub left_out_mm: f64,
    /// The same of rows left out of the fit.
    pub left_out_deg: f64,
    /// Standard uncertainties of the camera; `null` where so few poses do not show them.
    pub sigma: Option<Sigma>,
    /// Standard uncertainties of the board; `null` likewise.
    pub board_sigma: Option<Sigma>,
    /// Standard deviation of one coordinate of a row; `null` likewise.
    pub noise_mm: Option<f64>,
    /// Standard deviation of one rotation coordinate of a row; `null` likewise.
    pub noise_deg: Option<f64>,
    /// Root mean square rotations about the main directions, largest first.
    pub rotation_spread_deg: [f64; 3],
    /// Residuals of the rows.
    pub poses: Vec<Row>,
    /// The refinement by corners.
    pub corners: Option<Corners>,
    /// Error ellipsoids of the camera and of the board, as far as they are known.
    pub ellipsoids: Vec<Ellipsoid>,
    /// What a person should look at.
    pub findings: Vec<Finding>,
    /// How the robot's and the board's file are named.
    #[serde(skip)]
    pub names: [String; 2],
    /// The frame file's text.
    #[serde(skip)]
    pub frame_text: String,
}

impl Document for HandEye {
    const KIND: &'static str = "handeye/1";
}

/// Finds the camera's pose from robot and board poses (AX = XB).
///
/// # Errors
/// Rows that are too few, do not rotate about two directions, or do not belong together.
pub fn handeye(inputs: &Inputs, setup: Setup) -> Result<HandEye, Failure> {
    let robot = robot_poses(inputs)?;
    let board = poses(inputs.board)?;
    let names = [&inputs.robot.name, &inputs.board.name];
    let named = |error: &dyn std::fmt::Display| {
        Failure::new(format!("{} and {}: {error}", names[0], names[1]))
    };
    let (repeated, own) = distinct(&robot, &board);
    let named = |error: &dyn std::fmt::Display| match repeated.len() {
        0 => named(error),
        count => {
            let message = format!("{} and {}: {error}", names[0], names[1]);
            let hint = format!("{count} row(s) that repeat an earlier one count once");
            Failure::with_hint(message, hint)
        }
    };
    let kept = [&robot, &board].map(|poses| without(poses.clone(), &repeated));
    let problem = Problem::new(setup, &kept[0], &kept[1]).map_err(|error| named(&error))?;
    let refined = problem.refined().map_err(|error| named(&error))?;
    let corners = inputs
        .corners
        .map(|source| refine(source, setup, &robot, &refined.camera))
        .transpose()?;
    let accepted = corners.as_ref().filter(|c| c.accepted);
    let camera = accepted.map_or(&refined.camera, |c| &c.camera);
    let of_rows = refined.shows_noise();
    // corners show their own noise
    let covariance = accepted
        .map(|c| &c.covariance)
        .or_else(|| of_rows.then_some(&refined.camera_covariance));
    let board_covariance = of_rows.then_some(&refined.board_covariance);
    let sigma = covariance.map(|covariance| Six::of(covariance, camera));
    let by = |method: Method| problem.by(method).ok().as_ref().map(Into::into);
    let (left_out_m, left_out_rad) = left_out(&refined);
    let mut findings = Vec::new();
    findings.extend(copies::finding(&repeated, names[0], |row| {
        format!("row {}", row + 1)
    }));
    findings.extend(few_poses(&refined, names[0]));
    findings.extend(weak_rotation(&problem, names[0]));
    findings.extend(outliers(&refined, &own, names[0]));
    findings.extend(other_scale(&refined, names[1]));
    findings.extend(corners.as_ref().and_then(|c| not_accepted(c, names[0])));
    let frame = Frame {
        to_from_from: *camera,
        sigma,
        rmsd_m: Some(refined.distance_m),
        points: Some(problem.count()),
        provenance: provenance([
            ("method", "hand-eye"),
            ("robot", names[0]),
            ("board", names[1]),
        ]),
    };
    Ok(HandEye {
        setup: match setup {
            Setup::EyeToHand => "eye-to-hand",
            Setup::EyeInHand => "eye-in-hand",
        },
        camera: camera.into(),
        board: (&refined.board).into(),
        by_method: Methods {
            tsai: by(Method::Tsai),
            park: by(Method::Park),
            horaud: by(Method::Horaud),
            daniilidis: by(Method::Daniilidis),
            refined: (&refined.camera).into(),
        },
        residual_mm: mm_from_m(refined.distance_m),
        residual_deg: refined.rotation_rad / DEG,
        left_out_mm: mm_from_m(left_out_m),
        left_out_deg: left_out_rad / DEG,
        sigma: sigma.as_ref().map(Into::into),
        board_sigma: board_covariance.map(|c| (&Six::of(c, &refined.board)).into()),
        noise_mm: of_rows.then(|| mm_from_m(refined.sigma_position_m)),
        noise_deg: of_rows.then(|| refined.sigma_rotation_rad / DEG),
        rotation_spread_deg: problem.spread_rad.map(|s| s / DEG),
        poses: own
            .iter()
            .zip(&robot)
            .map(|(own, robot)| (&refined.rows[*own], robot))
            .map(|(row, robot)| Row {
                residual_mm: mm_from_m(row.distance_m),
                residual_deg: row.rotation_rad / DEG,
                left_out_mm: mm_from_m(row.out_distance_m),
                left_out_deg: row.out_rotation_rad / DEG,
                place_mm: robot.translation.map(mm_from_m),
            })
            .collect(),
        corners: corners.as_ref().map(|c| Corners {
            accepted: c.accepted,
            before_mm: mm_from_m(c.before_m),
            after_mm: mm_from_m(c.after_m),
            left_out_mm: mm_from_m(c.left_out_m),
            correction: (&c.correction).into(),
        }),
        ellipsoids: [
            covariance.map(|c| Ellipsoid::new("camera", c, camera.translation)),
            board_covariance.map(|c| Ellipsoid::new("board", c, refined.board.translation)),
        ]
        .into_iter()
        .flatten()
        .collect(),
        findings,
        names: names.map(Clone::clone),
        frame_text: frame.to_yaml(),
    })
}

/// Rows that repeat an earlier one, and of each row its place among the others.
fn distinct(robot: &[Motion], board: &[Motion]) -> (Vec<copies::Copy>, Vec<usize>) {
    let rows = robot.iter().zip(board);
    let numbers = |(robot, board)| copies::numbers(robot).chain(copies::numbers(board));
    let repeated = copies(rows.map(numbers));
    let mut own: Vec<usize> = Vec::with_capacity(robot.len());
    let mut next = 0;
    for row in 0..robot.len() {
        let copy = repeated.iter().find(|copy| copy[0] == row);
        own.push(copy.map_or(next, |copy| own[copy[1]]));
        next += usize::from(copy.is_none());
    }
    (repeated, own)
}

/// Up to so many poses the noise is hardly known.
const FEW: usize = 8;

/// Poses that do not show the noise, or hardly.
fn few_poses(refined: &Refined, name: &str) -> Option<Finding> {
    let count = refined.rows.len();
    let message = if !refined.shows_noise() {
        format!(
            "{count} poses do not show their noise: a turn of the camera lays all positions on each \
             other; how far camera and board are off is not known"
        )
    } else if count <= FEW {
        let [rotations, positions] = refined.redundancy;
        format!(
            "{count} poses hardly show their noise: it comes from {positions:.0} redundant \
             coordinates of positions and {rotations:.0} of rotations; in one case of twenty sigma \
             is more than {:.1} times as large",
            refined.sigma_times()
        )
    } else {
        return None;
    };
    let finding = Finding::of_file("few-points", Severity::Warning, name, message);
    Some(finding.hint("take about 15 poses"))
}

fn weak_rotation(problem: &Problem, name: &str) -> Option<Finding> {
    (problem.spread_rad[1] < WEAK_RAD).then(|| {
        let message = format!(
            "the poses rotate by {:.2} deg only about the second direction: above {:.0} deg is \
             well",
            problem.spread_rad[1] / DEG,
            WEAK_RAD / DEG
        );
        Finding::of_file("weak-rotation", Severity::Warning, name, message)
            .hint("add poses that tilt the flange in another direction")
    })
}

/// A board's scale that differs from 1 by less is its making and the lens.
const SCALE: f64 = 1e-3;
/// A scale is off beyond so many standard deviations.
const SCALE_CHANCE: f64 = 5.0;

/// A board whose squares are of another size than the camera was given.
fn other_scale(refined: &Refined, name: &str) -> Option<Finding> {
    let sigma = refined.board_scale_sigma?;
    let off = refined.board_scale - 1.0;
    let enough = refined.rows.len() >= FEWEST_JUDGED;
    (enough && off.abs() > SCALE && off.abs() > SCALE_CHANCE * sigma).then(|| {
        let message = format!(
            "BOARD's positions times {:.5} (\u{b1} {sigma:.5}) fit better: its squares are larger or \
             smaller than the camera was given by {:+.2} %",
            refined.board_scale,
            off * 100.0
        );
        Finding::of_file("scale", Severity::Warning, name, message)
            .hint("measure the board's squares, and see the camera's focal length")
    })
}

/// Fewer rows do not show which of them is off.
const FEWEST_JUDGED: usize = 6;
/// A row stands out whose left-out residual is more than this many times the median.
const STANDS_OUT: f64 = 5.0;
/// Residuals below these are nobody's outliers, metres and radians.
const SMALL: [f64; 2] = [1e-5, 1e-5];

/// Rows that the others contradict; they are in the fit.
fn outliers(refined: &Refined, own: &[usize], name: &str) -> Vec<Finding> {
    let left = |kind: usize| -> Vec<f64> {
        let rows = refined.rows.iter();
        rows.map(|row| [row.out_distance_m, row.out_rotation_rad][kind])
            .collect()
    };
    if refined.rows.len() < FEWEST_JUDGED {
        return Vec::new();
    }
    let limits = [0, 1].map(|kind| {
        let mut sorted = left(kind);
        sorted.sort_by(f64::total_cmp);
        (STANDS_OUT * sorted[sorted.len() / 2]).max(SMALL[kind])
    });
    let rows = left(0).into_iter().zip(left(1)).enumerate();
    rows.filter(|(_, (distance, turn))| *distance > limits[0] || *turn > limits[1])
        .map(|(index, (distance, turn))| {
            let row = own.iter().position(|at| *at == index).unwrap_or(index);
            let message = format!(
                "row {} is {:.3} mm and {:.3} deg from where the others have it; it is in the fit",
                row + 1,
                mm_from_m(distance),
                turn / DEG
            );
            Finding::of_file("outlier", Severity::Warning, name, message)
                .hint("measure it again, or leave it out")
        })
        .collect()
}

fn not_accepted(corners: &Refinement, name: &str) -> Option<Finding> {
    (!corners.accepted).then(|| {
        let message = format!(
            "the refinement by corners is left out: left-out corners are {:.4} mm off with it and \
             {:.4} mm without",
            mm_from_m(corners.left_out_m),
            mm_from_m(corners.before_m)
        );
        Finding::of_file("corners-not-accepted", Severity::Warning, name, message)
    })
}

pub(super) fn robot_poses(inputs: &Inputs) -> Result<Vec<Motion>, Failure> {
    let table = Table::read(inputs.robot)?;
    let Some(file) = inputs.profile else {
        if table.has(JOINTS[0]) && !table.has(POSE[3]) {
            return Err(Failure::with_hint(
                format!("{}: joints, not poses", inputs.robot.name),
                "--profile gives the model that makes poses of them",
            ));
        }
        return poses(inputs.robot);
    };
    table.require(&JOINTS)?;
    let mut mounted = Mounted::flange();
    let feels = |effect: &Effect| effect.definition().needs.contains(&Need::Masses);
    // where nothing bends several tools are as good as none
    if inputs.tool.is_some() || file.profile.effects.iter().any(feels) {
        mounted.load = file.tool(inputs.tool)?.load;
    }
    let model = file.profile.real_model(&mounted, &Conditions::default());
    // of a track: the base at home, in which the poses are wherever it carries the arm
    let circumstances = Circumstances::of(&table, &file.profile)?;
    let pose = |row: TableRow| {
        let (q, conditions) = (row.joints()?, circumstances.conditions(&row)?);
        let stand = circumstances.stand(&row)?;
        let own = circumstances
            .is_of_chain()
            .then(|| file.profile.real_model_at(&mounted, &conditions, &stand));
        // where the pendant and `fk` have the flange
        Ok(own.as_ref().unwrap_or(&model).forward(&q, &conditions))
    };
    let poses = table.rows().map(pose).collect();
    table.refuse_misspelt()?;
    poses
}

fn poses(source: &Source) -> Result<Vec<Motion>, Failure> {
    let table = Table::read(source)?;
    table.require(&POSE)?;
    table.rows().map(|row| pose(&row)).collect()
}

fn refine(
    source: &Source,
    setup: Setup,
    robot: &[Motion],
    camera: &Motion,
) -> Result<Refinement, Failure> {
    let table = Table::read(source)?;
    let (touched_columns, seen_columns) = (["x_mm", "y_mm", "z_mm"], ["cx_mm", "cy_mm", "cz_mm"]);
    table.require(&touched_columns)?;
    table.require(&seen_columns)?;
    if setup == Setup::EyeInHand {
        table.require(&["row"])?;
    }
    let (mut seen, mut touched): (Vec<Vector>, Vec<Vector>) = (Vec::new(), Vec::new());
    for row in table.rows() {
        let point = row.numbers(touched_columns)?.map(m_from_mm);
        touched.push(match setup {
            Setup::EyeToHand => point,
            Setup::EyeInHand => {
                let number = row.number("row")?;
                let pose = (1..=robot.len())
                    .find(|n| *n as f64 == number)
                    .map(|n| robot[n - 1])
                    .ok_or_else(|| {
                        row.failure(format!("row {number}: ROBOT has rows 1 to {}", robot.len()))
                    })?;
                pose.inverse().transform(point)
            }
        });
        seen.push(row.numbers(seen_columns)?.map(m_from_mm));
    }
    refine_by_corners(camera, &seen, &touched)
        .map_err(|error| Failure::with_hint(format!("{}: {error}", source.name), error.hint()))
}

/// Root mean square residual of the rows left out of the fit, metres and radians.
fn left_out(refined: &Refined) -> (f64, f64) {
    let n = refined.rows.len() as f64;
    let sum = refined.rows.iter().fold((0.0, 0.0), |(d, r), row| {
        (
            d + row.out_distance_m.powi(2),
            r + row.out_rotation_rad.powi(2),
        )
    });
    ((sum.0 / n).sqrt(), (sum.1 / n).sqrt())
}
