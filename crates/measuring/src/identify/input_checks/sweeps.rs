//! Sweeps of single joints that no base and tool of this robot explain.

use super::readings::{IN_DEGREES, LENGTHS, in_millimetres};
use super::screening::check_start;
use super::{Remark, WHOLE_FILE, remark};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, add, norm, scale, sub};
use crate::identify::error::IdentifyError;
use crate::identify::line::Line;
use crate::identify::measurements::{Measurement, Measurements, Observed};
use crate::identify::start;
use crate::model::Conditions;
use crate::model::external::Stand;
use crate::profile::Profile;
use crate::register::axes::relations::relations;
use crate::register::axes::{Axis, Sweep};

/// Base and tool that miss by more are not of this robot, metres.
const HOPELESS_M: f64 = 0.02;
/// Base and tool that miss by more are worth a warning: few arms are that far from their drawing,
/// metres.
const POOR_M: f64 = 0.005;
/// Axes that stand otherwise to one another than drawn by more are worth a warning: radians and
/// metres.
const UNLIKE: (f64, f64) = (0.5 * DEG, 0.005);
/// A tool this far from the profile's is worth a note, metres.
const ELSEWHERE_M: f64 = 0.005;
/// Rows that are enough to try other readings of the file.
const TRIED_ROWS: usize = 200;
/// Name of the swept point: no point of a profile, so that it is sought.
const SWEPT: &str = "the swept point";

/// The measured point on the flange: the mean of what the rows say.
#[must_use]
pub fn point_on_flange(profile: &Profile, sweeps: &[Sweep], world_from_base: &Pose) -> Vector {
    let arm = start::bare_arm(profile);
    let rows: Vec<_> = sweeps.iter().flat_map(|sweep| &sweep.rows).collect();
    let sum = rows.iter().fold([0.0; 3], |sum, row| {
        let flange = *world_from_base * arm.forward(&row.q, &Conditions::default());
        add(sum, flange.inverse().transform(row.point_m))
    });
    scale(1.0 / rows.len().max(1) as f64, sum)
}

/// Checks sweeps: whether base and tool explain every row, whether the axes stand to one another as
/// drawn, whether the tool is that of the profile.
///
/// # Errors
/// Base and tool miss by far: another reading of the file that fits, or the robot is another one.
pub fn input_checks(
    profile: &Profile,
    sweeps: &[Sweep],
    axes: &[Axis],
    base: Option<&Pose>,
    tool: Option<&Pose>,
) -> Result<Vec<Remark>, IdentifyError> {
    let mut remarks = Vec::new();
    if let Some(base) = base {
        let point = tool.map_or_else(
            || point_on_flange(profile, sweeps, base),
            |tool| tool.translation,
        );
        let missed_m = rms(profile, sweeps, base, point);
        if missed_m > HOPELESS_M {
            other_reading(profile, sweeps, missed_m)?;
        }
        if missed_m > POOR_M {
            remarks.push(remark(
                "poor-fit",
                WHOLE_FILE,
                format!(
                    "base and tool explain the sweeps to {:.2} mm rms only: few arms are so far \
                     from their drawing",
                    mm_from_m(missed_m)
                ),
                "is it this robot? does one joint move at a time, and the point not on the flange?",
            ));
        }
    }
    for relation in relations(axes, sweeps, profile) {
        let [angle, drawn] = relation.angle_rad;
        let [distance_m, drawn_m] = relation.distance_m;
        if (angle - drawn).abs() > UNLIKE.0 || (distance_m - drawn_m).abs() > UNLIKE.1 {
            remarks.push(remark(
                "axes-unlike",
                WHOLE_FILE,
                format!(
                    "axes {} and {} are {:.3} deg and {:.2} mm apart; in the profile {:.3} deg and \
                     {:.2} mm",
                    relation.joints[0] + 1,
                    relation.joints[1] + 1,
                    angle / DEG,
                    mm_from_m(distance_m),
                    drawn / DEG,
                    mm_from_m(drawn_m),
                ),
                "is it this robot? every column in its unit and its order?",
            ));
        }
    }
    let mut tools = profile.tools.keys();
    if let (Some(tool), Some(name), None) = (tool, tools.next(), tools.next()) {
        let known = profile.tool(name).map(|t| t.flange_from_tool.translation);
        let gap_m = known.map_or(0.0, |known| norm(sub(known, tool.translation)));
        if gap_m > ELSEWHERE_M {
            remarks.push(Remark {
                warning: false,
                ..remark(
                    "tool-elsewhere",
                    WHOLE_FILE,
                    format!(
                        "the measured point is {:.1} mm from where the profile has the tool \
                         `{name}`",
                        mm_from_m(gap_m)
                    ),
                    "is another point measured, or a joint counted the other way?",
                )
            });
        }
    }
    Ok(remarks)
}

fn rms(profile: &Profile, sweeps: &[Sweep], base: &Pose, point: Vector) -> f64 {
    let arm = start::bare_arm(profile);
    let rows: Vec<_> = sweeps.iter().flat_map(|sweep| &sweep.rows).collect();
    let squares: f64 = rows
        .iter()
        .map(|row| {
            let flange = *base * arm.forward(&row.q, &Conditions::default());
            norm(sub(flange.transform(point), row.point_m)).powi(2)
        })
        .sum();
    (squares / rows.len().max(1) as f64).sqrt()
}

/// Sweeps are read as they stand: their columns have no other names and units.
fn without_mapping(error: IdentifyError) -> IdentifyError {
    let IdentifyError::Suspicious { message, hint } = error else {
        return error;
    };
    let mut hint = hint.replace(IN_DEGREES, "q1_deg…q6_deg are degrees: convert them");
    for (_, _, unit) in LENGTHS {
        let own = "x_mm,y_mm,z_mm are millimetres: convert them";
        hint = hint.replace(&in_millimetres(unit), own);
    }
    IdentifyError::Suspicious { message, hint }
}

/// Fails where no base and tool explain the sweeps, with the reading of the file that does if there
/// is one.
fn other_reading(profile: &Profile, sweeps: &[Sweep], missed_m: f64) -> Result<(), IdentifyError> {
    let rows: Vec<_> = sweeps.iter().flat_map(|sweep| &sweep.rows).collect();
    let every = rows.len().div_ceil(TRIED_ROWS).max(1);
    let rows = rows.iter().step_by(every).map(|row| Measurement {
        line: Line::default(),
        id: String::new(),
        q: row.q,
        observed: Observed::Position(row.point_m),
        tool: None,
        point: Some(SWEPT.into()),
        point_in_tool_m: None,
        conditions: Conditions::default(),
        stand: Stand::default(),
        plate: None,
        sigma_m: None,
        sigma_rad: None,
        purpose: None,
        contact: None,
    });
    let measurements = Measurements {
        rows: rows.collect(),
        columns: Vec::new(),
    };
    if let Some(start) = start::find(profile, &measurements) {
        check_start(profile, &measurements, &start).map_err(without_mapping)?;
        if start.rms_m < HOPELESS_M {
            return Ok(());
        }
    }
    Err(IdentifyError::Suspicious {
        message: format!(
            "the sweeps do not fit the robot: base and tool from them miss the points by {:.1} mm \
             rms",
            mm_from_m(missed_m)
        ),
        hint:
            "is it this robot? every column in its unit and its order, and one joint moving at a \
            time?"
                .into(),
    })
}
