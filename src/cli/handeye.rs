//! `handeye`: where a camera is.

use super::failure::Failure;
use super::layout::{aligned, print_findings, print_text, row};
use super::page::ReportFile;
use super::registration::sigma_json;
use super::table::{JOINTS, POSE, Table};
use super::{Answer, Output, files, print, print_json};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Quaternion, Vector};
use crate::model::Conditions;
use crate::model::profile::Mounted;
use crate::register::frame_file::{Frame, Sigma};
use crate::register::handeye::{
    Corners, HandEye, Method, Refined, Setup, WEAK_RAD, refine_by_corners,
};
use crate::register::uncertainty::PoseCovariance;
use crate::report;
use crate::report::html::frames::{HandEyeRow, Uncertain, add_hand_eye, frame_page, pose_text};
use crate::report::html::page::Page;
use clap::{Args, ValueEnum};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Find a camera's pose from robot and board poses (AX = XB)
#[derive(Args)]
#[command(
    after_help = "ROBOT: poses base_from_flange (x_mm,y_mm,z_mm,qw,qx,qy,qz), or joints q1_deg…q6_deg with --profile: then the \
calibrated model says where the flange is. BOARD: poses camera_from_board, row by row.\nCorners: x_mm,y_mm,z_mm as touched by \
the robot in its base, cx_mm,cy_mm,cz_mm as seen by the camera; eye in hand also row, the row of ROBOT from which it was seen."
)]
pub struct Handeye {
    /// Robot poses, or joints with --profile
    #[arg(value_name = "ROBOT.csv")]
    robot: PathBuf,
    /// Board poses in the camera
    #[arg(value_name = "BOARD.csv")]
    board: PathBuf,
    /// Where the camera is mounted
    #[arg(long, value_enum)]
    setup: SetupArg,
    /// Robot profile (YAML) for joints
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
    /// Tool whose load the arm carried (with --profile)
    #[arg(long, value_name = "NAME", requires = "profile")]
    tool: Option<String>,
    /// Corners seen by the camera and touched by the robot: refine the camera's pose if left-out corners improve
    #[arg(long, value_name = "CORNERS.csv")]
    corners: Option<PathBuf>,
    /// Write the camera's pose as a frame file
    #[arg(short, long, value_name = "FRAME.yaml")]
    output: Option<PathBuf>,
    #[command(flatten)]
    report: ReportFile,
}

/// Where the camera is mounted
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SetupArg {
    /// The camera stands in the cell, the board is on the flange
    EyeToHand,
    /// The camera is on the flange, the board stands in the cell
    EyeInHand,
}

struct Outcome {
    problem: HandEye,
    by_method: Vec<(Method, Option<Pose>)>,
    refined: Refined,
    corners: Option<Corners>,
    findings: Vec<Finding>,
}

impl Handeye {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let read = [&self.robot, &self.board].into_iter();
        let read = read.chain(&self.corners).chain(&self.profile);
        let outputs = self.output.iter().map(PathBuf::as_path);
        self.report
            .refuse_over(read.map(PathBuf::as_path), outputs)?;
        let robot = self.read_robot()?;
        let board = read_poses(&self.board)?;
        let setup = match self.setup {
            SetupArg::EyeToHand => Setup::EyeToHand,
            SetupArg::EyeInHand => Setup::EyeInHand,
        };
        let named = |error: &dyn std::fmt::Display| {
            Failure::new(format!(
                "{} and {}: {error}",
                self.robot.display(),
                self.board.display()
            ))
        };
        let problem = HandEye::new(setup, &robot, &board).map_err(|error| named(&error))?;
        let refined = problem.refined().map_err(|error| named(&error))?;
        let by_method = Method::ALL
            .iter()
            .map(|method| (*method, problem.by(*method).ok()))
            .collect();
        let mut findings = Vec::new();
        if problem.spread_rad[1] < WEAK_RAD {
            findings.push(self.finding(
                "weak-rotation",
                Severity::Warning,
                format!(
                    "the poses turn by {:.2} deg only about the second direction: above {:.0} deg is well",
                    problem.spread_rad[1] / DEG,
                    WEAK_RAD / DEG
                ),
                "add poses that tilt the flange the other way",
            ));
        }
        let corners = self
            .corners
            .as_ref()
            .map(|path| self.refine(path, setup, &robot, &refined.camera))
            .transpose()?;
        if let Some(corners) = corners.as_ref().filter(|c| !c.accepted) {
            findings.push(self.finding(
                "corners-not-accepted",
                Severity::Warning,
                format!(
                    "the refinement by corners is left out: left-out corners are {:.4} mm off with it and {:.4} mm without",
                    mm_from_m(corners.left_out_m),
                    mm_from_m(corners.before_m)
                ),
                "",
            ));
        }
        let result = Outcome {
            problem,
            by_method,
            refined,
            corners,
            findings,
        };
        let mut outputs = Vec::new();
        if let Some(path) = &self.output {
            let text = self.frame(&result).to_yaml();
            outputs.push((path.clone(), text.into_bytes()));
        }
        if self.report.is_wanted() {
            outputs.extend(self.report.output(Some(&self.drawn(&result, &robot))));
        }
        files::write_all(&outputs)?;
        if output.json {
            print_json(&as_json(&result))?;
        } else {
            print_findings(&result.findings, output.verbose);
            if !output.quiet {
                print_text(&as_text(&result, output.verbose))?;
                print(&self.report.told())?;
            }
        }
        Ok(Answer::Yes)
    }

    /// The page: the camera's and the board's uncertainty, what is left of each row, what each method found.
    fn drawn(&self, result: &Outcome, robot: &[Pose]) -> Page {
        let refined = &result.refined;
        let (camera, _) = camera_of(result);
        let uncertain = |name: &str, covariance: &PoseCovariance, place_m: Vector| {
            let ellipsoid = covariance.ellipsoid(place_m);
            Uncertain {
                name: name.into(),
                place_m,
                half_axes_m: ellipsoid.half_axes_m,
                axes: std::array::from_fn(|i| ellipsoid.axes.axis(i)),
            }
        };
        let corners = result.corners.as_ref().filter(|c| c.accepted);
        let of_camera = corners.map_or(&refined.camera_covariance, |c| &c.covariance);
        let of_camera = uncertain("camera", of_camera, camera.translation);
        let of_board = uncertain(
            "board",
            &refined.board_covariance,
            refined.board.translation,
        );
        let (out_m, out_rad) = left_out(refined);
        let mut page = frame_page(&report::html::frames::Frame {
            title: "Hand-eye calibration".into(),
            lead: vec![format!(
                "{} and {}, {}",
                self.robot.display(),
                self.board.display(),
                match result.problem.setup() {
                    Setup::EyeToHand => "eye to hand",
                    Setup::EyeInHand => "eye in hand",
                }
            )],
            answer: format!(
                "{} poses agree to {:.4} mm and {:.5} deg; a pose left out of the fit to {:.4} mm and {:.5} deg",
                result.problem.count(),
                mm_from_m(refined.distance_m),
                refined.rotation_rad / DEG,
                mm_from_m(out_m),
                out_rad / DEG
            ),
            facts: vec![
                ("camera".into(), pose_text(&camera)),
                ("board".into(), pose_text(&refined.board)),
            ],
            points: Vec::new(),
            ellipsoids: vec![of_camera.clone(), of_board.clone()],
            findings: result.findings.clone(),
        });
        let rows = refined
            .rows
            .iter()
            .zip(robot)
            .map(|(row, robot)| HandEyeRow {
                place_m: robot.translation,
                distance_m: row.distance_m,
                rotation_rad: row.rotation_rad,
                out_distance_m: row.out_distance_m,
                out_rotation_rad: row.out_rotation_rad,
            });
        let mut methods: Vec<(String, Option<Pose>)> = result
            .by_method
            .iter()
            .map(|(method, pose)| (method.id().to_owned(), *pose))
            .collect();
        methods.push(("refined".into(), Some(refined.camera)));
        let in_base = match result.problem.setup() {
            Setup::EyeToHand => &of_camera,
            Setup::EyeInHand => &of_board,
        };
        add_hand_eye(&mut page, &rows.collect::<Vec<_>>(), in_base, &methods);
        page
    }

    fn finding(
        &self,
        id: &'static str,
        severity: Severity,
        message: String,
        hint: &str,
    ) -> Finding {
        Finding {
            hint: hint.into(),
            ..super::register::note(id, severity, &self.robot.display().to_string(), message)
        }
    }

    fn read_robot(&self) -> Result<Vec<Pose>, Failure> {
        let Some(path) = &self.profile else {
            let table = Table::read(&self.robot)?;
            if table.has(JOINTS[0]) && !table.has(POSE[3]) {
                return Err(Failure::with_hint(
                    format!("{}: joints, not poses", self.robot.display()),
                    "--profile gives the model that makes poses of them",
                ));
            }
            return read_poses(&self.robot);
        };
        let (profile, _) = files::read_profile(path)?;
        let table = Table::read(&self.robot)?;
        table.require(&JOINTS)?;
        let mut mounted = Mounted::flange();
        if let Some(name) = &self.tool {
            let tool = super::values::chosen_tool(Some(name), &profile)?;
            mounted.load = tool.load;
        }
        let model = profile.real_model(&mounted, &Conditions::default());
        let base = profile.world_from_base.inverse();
        let mut poses = Vec::new();
        for row in table.rows() {
            let q = row.numbers(JOINTS)?.map(|q| q * DEG);
            poses.push(base * model.forward(&q, &Conditions::default()));
        }
        Ok(poses)
    }

    fn refine(
        &self,
        path: &Path,
        setup: Setup,
        robot: &[Pose],
        camera: &Pose,
    ) -> Result<Corners, Failure> {
        let table = Table::read(path)?;
        let (touched_columns, seen_columns) =
            (["x_mm", "y_mm", "z_mm"], ["cx_mm", "cy_mm", "cz_mm"]);
        table.require(&touched_columns)?;
        table.require(&seen_columns)?;
        let (mut seen, mut touched): (Vec<Vector>, Vec<Vector>) = (Vec::new(), Vec::new());
        for row in table.rows() {
            let point = row.numbers(touched_columns)?.map(m_from_mm);
            touched.push(match setup {
                Setup::EyeToHand => point,
                Setup::EyeInHand => {
                    table.require(&["row"])?;
                    let number = row.number("row")?;
                    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
                    let index = (number as usize).checked_sub(1);
                    let pose = index
                        .filter(|_| number.fract() == 0.0)
                        .and_then(|index| robot.get(index))
                        .ok_or_else(|| {
                            row.failure(format!(
                                "row {number}: ROBOT has rows 1 to {}",
                                robot.len()
                            ))
                        })?;
                    pose.inverse().transform(point)
                }
            });
            seen.push(row.numbers(seen_columns)?.map(m_from_mm));
        }
        refine_by_corners(camera, &seen, &touched).map_err(|error| {
            Failure::with_hint(format!("{}: {error}", path.display()), error.hint())
        })
    }

    fn frame(&self, result: &Outcome) -> Frame {
        let (camera, sigma) = camera_of(result);
        let provenance = BTreeMap::from([
            ("method".to_owned(), "hand-eye".to_owned()),
            ("robot".to_owned(), self.robot.display().to_string()),
            ("board".to_owned(), self.board.display().to_string()),
            ("version".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
        ]);
        Frame {
            to_from_from: camera,
            sigma: Some(sigma),
            rmsd_m: Some(result.refined.distance_m),
            points: Some(result.problem.count()),
            provenance,
        }
    }
}

/// The camera's pose after all refinements, and its uncertainty.
fn camera_of(result: &Outcome) -> (Pose, Sigma) {
    if let Some(corners) = result.corners.as_ref().filter(|c| c.accepted) {
        let sigma = Sigma::of(&corners.covariance, &corners.camera);
        return (corners.camera, sigma);
    }
    let camera = result.refined.camera;
    let sigma = Sigma::of(&result.refined.camera_covariance, &camera);
    (camera, sigma)
}

fn read_poses(path: &Path) -> Result<Vec<Pose>, Failure> {
    let table = Table::read(path)?;
    table.require(&POSE)?;
    let mut poses = Vec::new();
    for row in table.rows() {
        let [x, y, z, w, i, j, k] = row.numbers(POSE)?;
        let quaternion = Quaternion([w, i, j, k]);
        let norm = quaternion.norm();
        if (norm - 1.0).abs() > 1e-3 {
            return Err(row.failure(format!(
                "the quaternion's length is {norm:.6}; it may differ from 1 by 0.001"
            )));
        }
        poses.push(Pose::from_parts(
            [x, y, z].map(m_from_mm),
            quaternion.normalized(),
        ));
    }
    Ok(poses)
}

fn left_out(refined: &Refined) -> (f64, f64) {
    #[allow(clippy::cast_precision_loss)]
    let n = refined.rows.len() as f64;
    let sum = refined.rows.iter().fold((0.0, 0.0), |(d, r), row| {
        (
            d + row.out_distance_m.powi(2),
            r + row.out_rotation_rad.powi(2),
        )
    });
    ((sum.0 / n).sqrt(), (sum.1 / n).sqrt())
}

fn as_json(result: &Outcome) -> Value {
    let refined = &result.refined;
    let (camera, sigma) = camera_of(result);
    let mut by_method: Map<String, Value> = result
        .by_method
        .iter()
        .map(|(method, pose)| {
            (
                method.id().to_owned(),
                pose.as_ref().map(report::pose).into(),
            )
        })
        .collect();
    by_method.insert("refined".into(), report::pose(&refined.camera));
    let (out_m, out_rad) = left_out(refined);
    let rows: Vec<Value> = refined
        .rows
        .iter()
        .map(|row| {
            json!({"residual_mm": mm_from_m(row.distance_m), "residual_deg": row.rotation_rad / DEG,
                   "left_out_mm": mm_from_m(row.out_distance_m), "left_out_deg": row.out_rotation_rad / DEG})
        })
        .collect();
    let corners = result.corners.as_ref().map(|c| {
        json!({"accepted": c.accepted, "before_mm": mm_from_m(c.before_m), "after_mm": mm_from_m(c.after_m),
               "left_out_mm": mm_from_m(c.left_out_m), "correction": report::pose(&c.correction)})
    });
    json!({
        "poseshift": "handeye/1",
        "setup": match result.problem.setup() { Setup::EyeToHand => "eye-to-hand", Setup::EyeInHand => "eye-in-hand" },
        "camera": report::pose(&camera), "board": report::pose(&refined.board),
        "by_method": by_method,
        "residual_mm": mm_from_m(refined.distance_m), "residual_deg": refined.rotation_rad / DEG,
        "left_out_mm": mm_from_m(out_m), "left_out_deg": out_rad / DEG,
        "sigma": sigma_json(&sigma),
        "board_sigma": sigma_json(&Sigma::of(&refined.board_covariance, &refined.board)),
        "noise_mm": mm_from_m(refined.sigma_position_m), "noise_deg": refined.sigma_rotation_rad / DEG,
        "rotation_spread_deg": result.problem.spread_rad.map(|s| s / DEG),
        "poses": rows, "corners": corners, "findings": result.findings,
    })
}

fn as_text(result: &Outcome, every: bool) -> String {
    let refined = &result.refined;
    let ok = "a string takes all text";
    let (what, board) = match result.problem.setup() {
        Setup::EyeToHand => ("base_from_camera", "flange_from_board"),
        Setup::EyeInHand => ("flange_from_camera", "base_from_board"),
    };
    let named = |name: &str, pose: &Pose| {
        let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
        let mut cells = vec![format!("  {name}")];
        cells.extend([x, y, z].map(|x| format!("{:.3}", mm_from_m(x))));
        cells.extend([rx, ry, rz].map(|r| format!("{:.4}", r / DEG)));
        cells
    };
    let mut rows = vec![row([
        what, "x mm", "y mm", "z mm", "rx deg", "ry deg", "rz deg",
    ])];
    for (method, found) in &result.by_method {
        rows.push(found.as_ref().map_or_else(
            || row([&format!("  {}", method.id()), "-", "-", "-", "-", "-", "-"]),
            |pose| named(method.id(), pose),
        ));
    }
    rows.push(named("refined", &refined.camera));
    if let Some(corners) = &result.corners {
        rows.push(named("corners", &corners.camera));
    }
    let (_, sigma) = camera_of(result);
    let mut cells = vec!["  sigma".to_owned()];
    cells.extend(sigma.position_m.map(|m| format!("{:.4}", mm_from_m(m))));
    cells.extend(sigma.rotation_rad.map(|r| format!("{:.5}", r / DEG)));
    rows.push(cells);
    rows.push(row([board]));
    rows.push(named("refined", &refined.board));
    let mut text = aligned(&rows);
    writeln!(
        text,
        "{} poses; sigma of the turn about the axes of the {}",
        result.problem.count(),
        what.split('_').next().unwrap_or_default()
    )
    .expect(ok);
    if let Some(corners) = &result.corners {
        writeln!(
            text,
            "corners {:.4} mm before, {:.4} mm after, {:.4} mm when left out: {}",
            mm_from_m(corners.before_m),
            mm_from_m(corners.after_m),
            mm_from_m(corners.left_out_m),
            if corners.accepted {
                "accepted"
            } else {
                "not accepted"
            }
        )
        .expect(ok);
    }
    let (out_m, out_rad) = left_out(refined);
    writeln!(
        text,
        "left over: {:.4} mm, {:.5} deg; left out of the fit: {:.4} mm, {:.5} deg",
        mm_from_m(refined.distance_m),
        refined.rotation_rad / DEG,
        mm_from_m(out_m),
        out_rad / DEG
    )
    .expect(ok);
    if every {
        let mut rows = vec![row(["row", "residual mm", "deg", "left out mm", "deg"])];
        for (index, one) in refined.rows.iter().enumerate() {
            rows.push(vec![
                (index + 1).to_string(),
                format!("{:.4}", mm_from_m(one.distance_m)),
                format!("{:.5}", one.rotation_rad / DEG),
                format!("{:.4}", mm_from_m(one.out_distance_m)),
                format!("{:.5}", one.out_rotation_rad / DEG),
            ]);
        }
        text += &aligned(&rows);
    }
    text
}
