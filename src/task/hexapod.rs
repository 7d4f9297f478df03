//! `hexapod`: ballbar lengths to poses with uncertainty, the base frame, and the poses that a robot
//! can measure.

use super::Document;
use super::failure::Failure;
use super::parts::{Ellipsoid, Pose, Sigma};
use super::profile_file::ProfileFile;
use super::register::points::Points;
use super::table::{JOINTS, POSE, Row, Table, cell, text_cell};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose as Motion, Quaternion, Vector, norm};
use crate::model::profile::{Mounted, Profile};
use crate::program::Source;
use crate::register::frame_file::{Frame, Sigma as Six};
use crate::register::hexapod::{
    Design, Device, HexapodError, Lengths, NAMES, Solved, Spread, measurable, modes, near, reach,
    set_base_frame, solve, spread,
};
use crate::register::uncertainty::PoseCovariance;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// A pose of the tool balls in the frame of the base balls.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ToolPose {
    /// The row's id, or its number from 1.
    pub id: String,
    /// The order of the balls.
    pub design: String,
    /// Assembly mode, 1 to 4.
    pub mode: usize,
    /// T1, T2, T3.
    pub tool_points_mm: [[f64; 3]; 3],
    /// Their standard deviations in multiples of that of a length.
    pub sigma_tool_points: [[f64; 3]; 3],
    /// The tool's frame.
    pub pose: Pose,
    /// Its standard uncertainties.
    pub sigma: Sigma,
    /// The largest standard deviation of a ball, all coordinates together.
    pub largest_sigma_mm: f64,
    /// Error ellipsoids of T1, T2, T3.
    pub ellipsoids: [Ellipsoid; 3],
}

/// Poses of the tool.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Poses {
    /// One a row and assembly mode.
    pub poses: Vec<ToolPose>,
    /// Standard deviation of a length.
    pub sigma_mm: f64,
    /// Rows with more than one mode.
    pub undecided: usize,
    /// What should be looked at.
    pub findings: Vec<Finding>,
    /// How the file is named.
    #[serde(skip)]
    pub name: String,
    /// Rows of the file.
    #[serde(skip)]
    pub rows: usize,
    /// For each pose how many modes its row has, and the controller's joint angles, degrees, where
    /// the file has them.
    #[serde(skip)]
    settings: Vec<(usize, Option<[f64; 6]>)>,
}

impl Document for Poses {
    const KIND: &'static str = "hexapod/1";
}

/// Solves every row of lengths; `sigma_m` is the standard deviation of each length, metres.
///
/// # Errors
/// Lengths without a solution, a mode or a design that does not exist.
pub fn poses(lengths: &Source, sigma_m: f64) -> Result<Poses, Failure> {
    let table = Table::read(lengths)?;
    let columns = NAMES.map(|name| format!("{name}_mm"));
    table.require(&columns.each_ref().map(String::as_str))?;
    table.require(&["design"])?;
    table.group(&["mode"])?;
    table.group(&POSE)?;
    let has_joints = table.group(&JOINTS)?;
    let mut found = Poses {
        poses: Vec::new(),
        sigma_mm: mm_from_m(sigma_m),
        undecided: 0,
        findings: Vec::new(),
        name: lengths.name.clone(),
        rows: 0,
        settings: Vec::new(),
    };
    let mut fixed = Vec::new();
    for (number, row) in table.rows().enumerate() {
        let id = row.id(number + 1);
        let (all, design, solved) = setting(&table, &row)?;
        fixed.push((row.line, [0, 1, 2, 3, 4, 5].map(|i| all[i])));
        let joints = has_joints.then(|| row.numbers(JOINTS)).transpose()?;
        found.rows += 1;
        found.undecided += usize::from(solved.len() > 1);
        let modes = solved.len();
        for (solved, spread) in solved {
            let pose = tool_pose(&id, &design, &solved, &spread, sigma_m);
            found.poses.push(pose);
            found.settings.push((modes, joints));
        }
    }
    table.refuse_misspelt()?;
    found.findings = unlike_others(&fixed, &lengths.name);
    Ok(found)
}

/// Distances between the balls of the base, and of the tool, stay what they are: a ballbar finds them
/// within hundredths of a millimetre again, metres.
const STEADY_M: f64 = 0.1e-3;

/// Rows whose first six lengths, those between balls of the base and of the tool, are not those of
/// the file's middle row.
fn unlike_others(fixed: &[(usize, [f64; 6])], name: &str) -> Vec<Finding> {
    let usual: [f64; 6] = std::array::from_fn(|i| {
        let mut all: Vec<f64> = fixed.iter().map(|(_, lengths)| lengths[i]).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    });
    let mut findings = Vec::new();
    for (line, lengths) in fixed {
        let off = (0..6).find(|i| (lengths[*i] - usual[*i]).abs() > STEADY_M);
        let Some(i) = off else { continue };
        let message = format!(
            "{} is {:.4} mm, and {:.4} mm in most rows (limit {} mm)",
            NAMES[i],
            mm_from_m(lengths[i]),
            mm_from_m(usual[i]),
            mm_from_m(STEADY_M)
        );
        let finding = Finding::of_file("balls-moved", Severity::Warning, name, message);
        findings.push(Finding {
            line: *line,
            column: 1,
            ..finding.hint("measure it again, or give a file to each setting of the balls")
        });
    }
    findings
}

/// A device whose longest length is shorter is in another unit: balls and bars are longer, metres.
const SHORTEST_M: f64 = 0.05;
/// And no bar is as long as this, metres.
const LONGEST_M: f64 = 20.0;

/// Refuses lengths in metres, inches or micrometres.
fn refuse_unit(what: &str, lengths_m: &[f64]) -> Result<(), String> {
    let longest = lengths_m.iter().copied().fold(0.0, f64::max);
    let (limit, units) = if longest < SHORTEST_M {
        (SHORTEST_M, "metres or inches")
    } else if longest > LONGEST_M {
        (LONGEST_M, "micrometres")
    } else {
        return Ok(());
    };
    Err(format!(
        "{what} are {:.4} mm at most (limit {:.0} mm): are they in {units}? they are mm",
        mm_from_m(longest),
        mm_from_m(limit)
    ))
}

/// A row's lengths, metres, and what they give.
type Setting = ([f64; 12], Design, Vec<(Solved, Spread)>);

/// Solves a row.
fn setting(table: &Table, row: &Row) -> Result<Setting, Failure> {
    let fail = |error: HexapodError| row.failure(error.to_string());
    let mut all = [0.0; 12];
    for (slot, name) in all.iter_mut().zip(NAMES) {
        *slot = m_from_mm(row.number(&format!("{name}_mm"))?);
    }
    refuse_unit("the lengths", &all).map_err(|message| row.failure(message))?;
    let lengths = Lengths::from_all(all);
    let design = Design::parse(row.text("design").unwrap_or_default()).map_err(fail)?;
    let solved = if table.has("mode") {
        let mode = row.number("mode")?;
        let whole = (1..=4_u8).find(|m| f64::from(*m) == mode);
        let whole = whole.ok_or_else(|| fail(HexapodError::Mode { found: mode }))?;
        vec![solve(&lengths, &design, usize::from(whole)).map_err(fail)?]
    } else if table.has(POSE[0]) {
        let [x, y, z, w, i, j, k] = row.numbers(POSE)?;
        // a rough pose need not be a unit quaternion
        let rotation = Quaternion([w, i, j, k]).normalized();
        let rough = Motion::from_parts([x, y, z].map(m_from_mm), rotation);
        vec![near(&lengths, &design, &rough).map_err(fail)?]
    } else {
        modes(&lengths, &design).map_err(fail)?
    };
    let with_spread = |s: Solved| (s, spread(&lengths, &design, s.mode));
    Ok((all, design, solved.into_iter().map(with_spread).collect()))
}

fn tool_pose(
    id: &str,
    design: &Design,
    solved: &Solved,
    spread: &Spread,
    sigma_m: f64,
) -> ToolPose {
    let covariance = PoseCovariance {
        centre_m: solved.pose.translation,
        matrix: spread.pose.map(|row| row.map(|v| v * sigma_m.powi(2))),
    };
    let length = |s: &[f64; 3]| s.iter().map(|s| s * s).sum::<f64>().sqrt();
    let largest = spread.points.iter().map(length).fold(0.0, f64::max);
    ToolPose {
        id: id.into(),
        design: design.name(),
        mode: solved.mode,
        tool_points_mm: solved.tool_points_m.map(|p| p.map(mm_from_m)),
        sigma_tool_points: spread.points,
        pose: (&solved.pose).into(),
        sigma: (&Six::of(&covariance, &solved.pose)).into(),
        largest_sigma_mm: largest * mm_from_m(sigma_m),
        ellipsoids: std::array::from_fn(|k| {
            let name = format!("{id} mode {} T{}", solved.mode, k + 1);
            Ellipsoid::new(name, &covariance, solved.tool_points_m[k])
        }),
    }
}

impl Poses {
    /// Measurements for `calibrate`: the three tool balls of each row with joints;
    /// `world_from_base` says where the base balls stand.
    ///
    /// # Errors
    /// A row without joints or with several modes.
    pub fn measurements(&self, world_from_base: &Motion) -> Result<String, Failure> {
        let mut text = format!("id,{},point,x_mm,y_mm,z_mm,sigma_mm\n", JOINTS.join(","));
        for (pose, (modes, q)) in self.poses.iter().zip(&self.settings) {
            let row = format!("{}: row {}", self.name, pose.id);
            let q = q.ok_or_else(|| {
                let hint = "measurements need the columns q1_deg…q6_deg";
                Failure::with_hint(format!("{row}: no joints"), hint)
            })?;
            if *modes > 1 {
                return Err(Failure::with_hint(
                    format!("{row}: {modes} assembly modes"),
                    "a column mode or a rough pose chooses",
                ));
            }
            for (k, point) in pose.tool_points_mm.iter().enumerate() {
                let p = world_from_base
                    .transform(point.map(m_from_mm))
                    .map(mm_from_m);
                let square: f64 = pose.sigma_tool_points[k].iter().map(|s| s * s).sum();
                let sigma = self.sigma_mm * (square / 3.0).sqrt();
                let numbers =
                    |list: &[f64]| list.iter().map(|v| cell(*v)).collect::<Vec<_>>().join(",");
                text += &format!(
                    "{},{},T{},{},{}\n",
                    text_cell(&format!("{}-T{}", pose.id, k + 1)),
                    numbers(&q),
                    k + 1,
                    numbers(&p),
                    cell(sigma)
                );
            }
        }
        Ok(text)
    }
}

/// Where the base balls stand.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Base {
    /// `robot_from_base`: origin B1, x to B2, B3 in the xy plane with y > 0.
    pub base: Pose,
    /// Root mean square residual of the taught points.
    pub rmsd_mm: f64,
    /// Their residuals.
    pub residuals_mm: [[f64; 3]; 3],
    /// The length of the largest of them.
    pub max_residual_mm: f64,
    /// B1, B2, B3 as the robot was taught them.
    pub taught_mm: [[f64; 3]; 3],
    /// What should be looked at.
    pub findings: Vec<Finding>,
    /// How the file is named.
    #[serde(skip)]
    pub name: String,
    /// The frame file's text.
    #[serde(skip)]
    pub frame_text: String,
}

impl Document for Base {
    const KIND: &'static str = "hexapod/1";
}

/// Over the size of the device even an arm that was never calibrated errs by less, metres.
const WELL_TAUGHT_M: f64 = 1e-3;

/// Finds the frame of the base balls from their taught places and their exact distances B1B2, B2B3,
/// B3B1, metres.
///
/// # Errors
/// Not three points; distances that are no triangle or contradict the points.
pub fn base(taught: &Source, base_m: [f64; 3]) -> Result<Base, Failure> {
    let name = &taught.name;
    let points = Points::read(taught)?.positions();
    let taught: [Vector; 3] = points.try_into().map_err(|points: Vec<Vector>| {
        let count = points.len();
        Failure::new(format!(
            "{name}: {count} points; the base has three: B1, B2, B3"
        ))
    })?;
    refuse_unit("the distances of the base balls", &base_m).map_err(Failure::new)?;
    let found =
        set_base_frame(taught, base_m).map_err(|error| Failure::new(format!("{name}: {error}")))?;
    let frame = Frame {
        to_from_from: found.robot_from_base,
        sigma: None,
        rmsd_m: Some(found.rms_m),
        points: Some(3),
        provenance: BTreeMap::from([
            ("method".into(), "three taught points".into()),
            ("to".into(), name.clone()),
        ]),
    };
    let residuals_mm = found.residual_m.map(|v| v.map(mm_from_m));
    let max_residual_mm = residuals_mm.iter().map(|r| norm(*r)).fold(0.0, f64::max);
    let mut findings = Vec::new();
    if max_residual_mm > mm_from_m(WELL_TAUGHT_M) {
        let message = format!(
            "a taught point is {max_residual_mm:.3} mm from where the exact distances have it \
             (limit {} mm)",
            mm_from_m(WELL_TAUGHT_M)
        );
        findings.push(
            Finding::of_file("taught-off", Severity::Warning, name, message)
                .hint("teach the balls again in the order B1, B2, B3, with the tool's own frame"),
        );
    }
    Ok(Base {
        base: (&found.robot_from_base).into(),
        rmsd_mm: mm_from_m(found.rms_m),
        residuals_mm,
        max_residual_mm,
        findings,
        taught_mm: taught.map(|v| v.map(mm_from_m)),
        name: name.clone(),
        frame_text: frame.to_yaml(),
    })
}

/// How the robot stands in a pose.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Posture {
    /// Its branch.
    pub branch: u8,
    /// The controller's joint angles.
    pub joints_deg: [f64; 6],
}

/// A pose of the device, and how the robot stands there.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Reached {
    /// Its number, from 1.
    pub id: usize,
    /// The order of the balls.
    pub design: String,
    /// Assembly mode, 1 to 4.
    pub mode: usize,
    /// The tool's frame in that of the base balls.
    pub pose: Pose,
    /// Postures within the joint limits.
    pub postures: Vec<Posture>,
    /// Largest difference of a leg from the ballbar's nominal length; `null` where the robot does
    /// not reach the pose.
    pub leg_error_mm: Option<f64>,
    /// Whether a posture keeps all legs in the ballbar's range.
    pub measurable: bool,
    /// Where the origin of the tool balls is in the world, metres.
    #[serde(skip)]
    pub place_m: Vector,
}

/// Which poses of the device a robot can measure.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Reach {
    /// How many.
    pub measurable: usize,
    /// Every pose of the device.
    pub reach: Vec<Reached>,
    /// The ballbar's nominal length.
    pub leg_mm: f64,
    /// How far from it the ballbar measures, to each side.
    pub range_mm: f64,
    /// What the page draws: the robot, its tool, the balls B1, B2, B3 in the world (metres), how
    /// the frame file is named.
    #[serde(skip)]
    pub drawn: (Profile, Mounted, [Vector; 3], String),
}

impl Document for Reach {
    const KIND: &'static str = "hexapod/1";
}

/// Lists the 72 poses of the device and whether the robot reaches them; `frame` says where the base
/// balls stand.
///
/// # Errors
/// Lengths without a solution, an arm without an inverse.
pub fn measurable_poses(
    file: &ProfileFile,
    tool: Option<&str>,
    frame: &Source,
    device: &Device,
) -> Result<Reach, Failure> {
    let world_from_base = super::frame(frame)?.to_from_from;
    let tool = file.tool(tool)?;
    measurable(device).map_err(|error| Failure::new(error.to_string()))?;
    let all = reach(device, &world_from_base, &file.profile, &tool)
        .map_err(|error| Failure::new(error.to_string()))?;
    let reach: Vec<Reached> = all
        .iter()
        .enumerate()
        .map(|(number, r)| Reached {
            id: number + 1,
            design: r.design.name(),
            mode: r.solved.mode,
            pose: (&r.solved.pose).into(),
            postures: r
                .postures
                .iter()
                .map(|(branch, q)| Posture {
                    branch: branch.number(),
                    joints_deg: q.map(|q| q / DEG),
                })
                .collect(),
            leg_error_mm: r.leg_error_m.map(mm_from_m),
            measurable: r.measurable,
            place_m: world_from_base.transform(r.solved.pose.translation),
        })
        .collect();
    let balls = device.base_balls_m().map(|p| world_from_base.transform(p));
    Ok(Reach {
        measurable: reach.iter().filter(|r| r.measurable).count(),
        reach,
        leg_mm: mm_from_m(device.leg_m),
        range_mm: mm_from_m(device.range_m),
        drawn: (file.profile.clone(), tool, balls, frame.name.clone()),
    })
}

impl Reach {
    /// The table of postures.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut csv = format!("id,design,mode,branch,{}\n", JOINTS.join(","));
        for r in &self.reach {
            for posture in &r.postures {
                let q: Vec<String> = posture.joints_deg.iter().map(|v| cell(*v)).collect();
                csv += &format!(
                    "{},{},{},{},{}\n",
                    r.id,
                    r.design,
                    r.mode,
                    posture.branch,
                    q.join(",")
                );
            }
        }
        csv
    }
}

#[cfg(test)]
mod tests {
    use super::{base, poses};
    use crate::program::Source;

    #[test]
    fn a_device_in_metres_or_inches_is_refused() {
        let head = "design,b12_mm,b23_mm,b31_mm,t12_mm,t23_mm,t31_mm,r11_mm,r21_mm,r31_mm,r12_mm,\
                    r22_mm,r23_mm,mode\n";
        let table = |unit: f64| {
            let lengths = [300, 300, 300, 150, 150, 150, 300, 300, 300, 300, 300, 300];
            let cells = lengths.map(|mm| (f64::from(mm) / unit).to_string());
            let text = format!("{head}123/123,{},1\n", cells.join(","));
            Source::new("lengths.csv", text.into_bytes())
        };
        assert!(poses(&table(1.0), 1e-6).is_ok());
        for unit in [1000.0, 25.4] {
            let failure = poses(&table(unit), 1e-6).expect_err("other units");
            assert!(failure.message.contains("in metres or inches"), "{failure}");
        }
        let taught = "x_mm,y_mm,z_mm\n0,0,0\n0.3,0,0\n0.15,0.26,0\n";
        let taught = Source::new("taught.csv", taught.into());
        let failure = base(&taught, [3e-4; 3]).expect_err("metres");
        assert!(failure.message.contains("in metres or inches"), "{failure}");
    }
}
