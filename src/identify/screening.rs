//! Measurements that contradict the robot, the format or themselves, found before anything is believed.

use super::error::IdentifyError;
use super::measurements::{Measurements, Observed};
use super::start::{Carriers, Sight, Start, bare_arm, sights, solve, spreads};
use super::statistics::Quality;
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Vector, norm, sub};
use crate::model::Conditions;
use crate::model::profile::Profile;

/// A first guess that misses by less is not doubted, metres.
const GOOD_START_M: f64 = 0.02;
/// Another reading of the file must be better by this factor to be suggested.
const BETTER: f64 = 4.0;
/// Joints that move less than this over all rows stand still, radians.
const STILL_RAD: f64 = 0.5 * DEG;
/// A fit that misses by more is not of this robot, mm.
const HOPELESS_MM: f64 = 20.0;
/// A fit that misses by more is worth a warning, mm.
const POOR_MM: f64 = 2.0;
/// A tool this far from where the profile has it is worth a warning, metres.
const WRONG_TOOL_M: f64 = 0.005;
/// The way out where nothing fits.
const NOT_OF_THIS_ROBOT: &str = "is it this robot, this tool, this order of rows? every column in its unit? `--loss tukey` if single rows are wrong";
/// Rows that are enough to try other readings of the file.
const TRIED_ROWS: usize = 200;

/// Something about the measurements that a person should look at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Stable name in kebab-case.
    pub id: &'static str,
    /// Whether it is more than a note.
    pub warning: bool,
    /// Line of the measurements; 0 is the whole file.
    pub line: usize,
    /// What was found, with the evidence.
    pub message: String,
    /// The way out; empty where there is none.
    pub hint: String,
}

fn remark(id: &'static str, line: usize, message: String, hint: &str) -> Remark {
    Remark {
        id,
        warning: true,
        line,
        message,
        hint: hint.into(),
    }
}

fn suspicious(message: String, hint: &str) -> IdentifyError {
    IdentifyError::Suspicious {
        message,
        hint: hint.into(),
    }
}

/// What can be seen without a model: units of angles, joints that stand still, rows that repeat, points on a line.
///
/// # Errors
/// All poses alike; angles that must be radians; points on one line.
pub fn look(profile: &Profile, measurements: &Measurements) -> Result<Vec<Remark>, IdentifyError> {
    let rows = &measurements.rows;
    let mut remarks = Vec::new();
    let range = |i: usize| {
        let (low, high) = rows
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), r| {
                (low.min(r.q[i]), high.max(r.q[i]))
            });
        high - low
    };
    let still: Vec<usize> = (0..6).filter(|i| range(*i) < STILL_RAD).collect();
    if still.len() == 6 {
        let most = (0..6).map(range).fold(0.0, f64::max) / DEG;
        return Err(suspicious(
            format!(
                "all {} rows have the same pose: no joint moves by more than {most:.3} deg",
                rows.len()
            ),
            "measure configurations over the whole workspace: `poseshift plan` chooses them",
        ));
    }
    for joint in &still {
        remarks.push(remark(
            "joint-never-moved",
            0,
            format!(
                "joint {} never moves by more than {:.3} deg: its parameters cannot be told from those of its neighbours",
                joint + 1,
                range(*joint) / DEG
            ),
            "measure configurations in which every joint moves",
        ));
    }
    let mut first: std::collections::HashMap<Vec<u64>, usize> = std::collections::HashMap::new();
    let mut twice = Vec::new();
    for row in rows {
        let mut key: Vec<u64> = row.q.iter().map(|q| q.to_bits()).collect();
        match row.observed {
            Observed::Position(p) => key.extend(p.map(f64::to_bits)),
            Observed::Pose(pose) => key.extend(pose.translation.map(f64::to_bits)),
            Observed::Distance { distance_m, from_m } => {
                key.push(distance_m.to_bits());
                key.extend(from_m.map(f64::to_bits));
            }
            // the joint angles are the reading
            Observed::Contact(kind) => key.push(kind as u64),
        }
        if let Some(line) = first.insert(key, row.line) {
            twice.push((row.line, line));
        }
    }
    if let Some((line, earlier)) = twice.first() {
        remarks.push(remark(
            "duplicate-rows",
            *line,
            format!(
                "{} rows repeat an earlier one to the last digit, the first in line {line} that of line {earlier}: they count twice",
                twice.len()
            ),
            "a device never repeats itself exactly: leave copies out",
        ));
    }
    let beyond = rows.iter().find_map(|row| {
        let joint = profile.mechanism.beyond_limit(&row.q, 5.0 * DEG)?;
        Some((row.line, joint, row.q[joint]))
    });
    if let Some((line, joint, q)) = beyond {
        remarks.push(remark(
            "beyond-limit",
            line,
            format!(
                "joint {} stands at {:.3} deg, beyond its limit",
                joint + 1,
                q / DEG
            ),
            "check the order and the unit of the joint columns, and the limits in the profile",
        ));
    }
    let points: Vec<Vector> = rows.iter().filter_map(|r| r.observed.point_m()).collect();
    if points.len() == rows.len() && points.len() >= 3 {
        let [long, wide, _] = spreads(&points);
        if wide < 1e-3 * long.max(1e-6) {
            return Err(suspicious(
                format!(
                    "the measured points lie on one line: they spread {:.3} mm along it and {:.4} mm across",
                    mm_from_m(long),
                    mm_from_m(wide)
                ),
                "measure configurations over the whole workspace: `poseshift plan` chooses them",
            ));
        }
    }
    Ok(remarks)
}

/// Another reading of the file: what it supposes, and the way out.
struct Reading {
    supposes: String,
    hint: String,
    sights: Vec<Sight>,
}

fn reread(
    profile: &Profile,
    measurements: &Measurements,
    known: &[Sight],
    joints: impl Fn(&[f64; 6]) -> [f64; 6],
    seen: impl Fn(usize, Vector) -> Vector,
) -> Vec<Sight> {
    let arm = bare_arm(profile);
    let rows = measurements
        .rows
        .iter()
        .filter(|r| r.observed.point_m().is_some());
    rows.zip(known)
        .enumerate()
        .map(|(i, (row, sight))| Sight {
            flange: arm.forward(&joints(&row.q), &Conditions::default()),
            seen: seen(i, sight.seen),
            carrier: sight.carrier,
        })
        .collect()
}

fn readings(profile: &Profile, measurements: &Measurements, known: &[Sight]) -> Vec<Reading> {
    let mut all = Vec::new();
    let same = |q: &[f64; 6]| *q;
    let here = |_: usize, p: Vector| p;
    let mut add = |supposes: String, hint: String, sights: Vec<Sight>| {
        all.push(Reading {
            supposes,
            hint,
            sights,
        });
    };
    let read = |joints: &dyn Fn(&[f64; 6]) -> [f64; 6], seen: &dyn Fn(usize, Vector) -> Vector| {
        reread(profile, measurements, known, joints, seen)
    };
    add(
        "the joint angles are radians, not degrees".into(),
        "q1_deg…q6_deg are degrees".into(),
        read(&|q| q.map(|q| q / DEG), &here),
    );
    add(
        "the lengths are metres, not millimetres".into(),
        "x_mm,y_mm,z_mm are millimetres".into(),
        read(&same, &|_, p| p.map(|x| x * 1000.0)),
    );
    for (factor, name) in [(25.4, "inches"), (0.001, "micrometres")] {
        add(
            format!("the lengths are {name}, not millimetres"),
            "x_mm,y_mm,z_mm are millimetres".into(),
            read(&same, &|_, p| p.map(|x| x * factor)),
        );
    }
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        let names = ["x_mm", "y_mm", "z_mm"];
        add(
            format!("the columns {} and {} are swapped", names[a], names[b]),
            "or one of the axes points the other way: the device's frame must be right-handed"
                .into(),
            read(&same, &|_, mut p| {
                p.swap(a, b);
                p
            }),
        );
    }
    for a in 0..6 {
        for b in a + 1..6 {
            add(
                format!("the columns q{}_deg and q{}_deg are swapped", a + 1, b + 1),
                "check the order of the joint columns".into(),
                read(
                    &|q| {
                        let mut q = *q;
                        q.swap(a, b);
                        q
                    },
                    &here,
                ),
            );
        }
        add(
            format!("joint {} counts the other way", a + 1),
            format!(
                "negate q{}_deg, or set the sign of joint {} in the profile",
                a + 1,
                a + 1
            ),
            read(
                &|q| {
                    let mut q = *q;
                    q[a] = -q[a];
                    q
                },
                &here,
            ),
        );
    }
    let count = known.len();
    for by in [1, count - 1] {
        let word = if by == 1 {
            "one row later"
        } else {
            "one row earlier"
        };
        add(
            format!("the measured points belong to the joint angles {word}"),
            "check that joints and points are in the same order and none is missing".into(),
            read(&same, &|i, _| known[(i + by) % count].seen),
        );
    }
    add(
        "the measured points stand in the opposite order".into(),
        "check that joints and points are in the same order".into(),
        read(&same, &|i, _| known[count - 1 - i].seen),
    );
    all
}

/// Doubts a first guess that misses by far: tries other readings of the file, and says which one fits.
///
/// # Errors
/// Another reading fits much better; or none fits at all.
pub fn doubt_start(
    profile: &Profile,
    measurements: &Measurements,
    start: &Start,
) -> Result<Vec<Remark>, IdentifyError> {
    if start.rms_m < GOOD_START_M {
        return Ok(moved_tools(profile, start));
    }
    let sample = measurements.filtered(|i, _| i < TRIED_ROWS);
    let (known, _, carriers): (_, _, Carriers) = sights(profile, &sample);
    if known.len() < 4 {
        return Ok(Vec::new());
    }
    let as_is = solve(&known, &carriers).rms_m;
    let mut best: Option<(f64, Reading)> = None;
    for reading in readings(profile, &sample, &known) {
        let rms = solve(&reading.sights, &carriers).rms_m;
        if best.as_ref().is_none_or(|(other, _)| rms < *other) {
            best = Some((rms, reading));
        }
    }
    if let Some((rms, reading)) = best.filter(|(rms, _)| *rms * BETTER < as_is) {
        return Err(suspicious(
            format!(
                "the measurements do not fit the robot: {:.1} mm rms with the best base and tool; if {}, {:.1} mm",
                mm_from_m(as_is),
                reading.supposes,
                mm_from_m(rms)
            ),
            &reading.hint,
        ));
    }
    Ok(moved_tools(profile, start))
}

/// Tools that are elsewhere than the profile says.
fn moved_tools(profile: &Profile, start: &Start) -> Vec<Remark> {
    let mut remarks = Vec::new();
    if start.believed_rms_m.is_none() {
        return remarks;
    }
    for ((name, point), on_flange) in &start.points_on_flange_m {
        let Some(tool) = profile.tool(name) else {
            continue;
        };
        let known = point
            .as_ref()
            .map_or(Some([0.0; 3]), |p| profile.points.get(p).copied());
        let Some(known) = known else { continue };
        let gap = norm(sub(*on_flange, tool.flange_from_tool.transform(known)));
        if gap > WRONG_TOOL_M {
            remarks.push(remark(
                "tool-elsewhere",
                0,
                format!(
                    "the point measured on tool `{name}` is {:.1} mm from where the profile has it",
                    mm_from_m(gap)
                ),
                "is it the tool of the profile? its deviation is identified as tool_frame",
            ));
        }
    }
    remarks
}

/// Doubts measurements from which no fit comes to rest: where even the best base and tool miss by far, they are not of this
/// robot, and which parameters are identified does not matter.
pub fn doubt_rest(error: IdentifyError, start: &Start) -> IdentifyError {
    if !matches!(error, IdentifyError::NotConverged { .. }) || start.rms_m < GOOD_START_M {
        return error;
    }
    suspicious(
        format!(
            "the measurements do not fit the robot: {:.1} mm rms with the best base and tool, and with more parameters {error}",
            mm_from_m(start.rms_m)
        ),
        NOT_OF_THIS_ROBOT,
    )
}

/// Doubts a fit that misses by far more than any calibrated arm.
///
/// # Errors
/// The measurements are not of this robot.
pub fn doubt_fit(after: &Quality, frames_only: &Quality) -> Result<Vec<Remark>, IdentifyError> {
    let (Some(after), Some(frames)) = (after.main(), frames_only.main()) else {
        return Ok(Vec::new());
    };
    if after.rms > HOPELESS_MM {
        return Err(suspicious(
            format!(
                "the fitted model misses by {:.1} mm rms (base and tool alone fitted: {:.1} mm): no arm is that far from its drawing",
                after.rms, frames.rms
            ),
            NOT_OF_THIS_ROBOT,
        ));
    }
    if after.rms > POOR_MM {
        return Ok(vec![remark(
            "poor-fit",
            0,
            format!(
                "the fitted model misses by {:.3} mm rms, more than a calibrated arm does",
                after.rms
            ),
            "look at the outliers, the tool and the masses; `poseshift diagnose` looks for what is missing",
        )]);
    }
    Ok(Vec::new())
}
