//! Measurements that contradict the robot, the format or themselves, found before anything is
//! believed.

use super::readings::{Reading, readings};
use super::{BETTER, NOT_OF_THIS_ROBOT, Remark, WHOLE_FILE, remark, suspicious};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, dot, norm, sub};
use crate::identify::error::{FAR_OFF, IdentifyError};
use crate::identify::line::Line;
use crate::identify::measurements::{Measurement, Measurements, Observed};
use crate::identify::problem::{Estimate, Problem};
use crate::identify::start::{self, Start, spreads};
use crate::identify::statistics::quantile;
use crate::model::effects::{Effect, Kind};
use crate::profile::Profile;

/// A first guess that misses by less is not questioned, metres, if it is also less than
/// [`GOOD_PART`].
const GOOD_START_M: f64 = 0.003;
/// Of how far the measurements spread.
const GOOD_PART: f64 = 0.02;
/// A first guess that misses by more is of no arm, metres.
const BAD_START_M: f64 = 0.02;
/// Another reading of the file must miss by less than this part of the spread, and than
/// [`BAD_START_M`].
const FITS_PART: f64 = 0.1;
/// Readings that fit as well but for this factor are named as well.
const AS_WELL: f64 = 1.5;
/// Orientations further from each other than this are not of one tool, radians.
const TURNED_RAD: f64 = 3.0 * DEG;
/// A device whose z is farther than this from upward is reported, radians: where it is level, gravity
/// acts elsewhere than the profile has it.
const TILTED_RAD: f64 = 3.0 * DEG;
/// Exchanged columns are sure that leave axis 1 as near as this to where the profile has it, and
/// others farther than [`TURNED_DEG`], degrees.
const LEVEL_DEG: f64 = 15.0;
const TURNED_DEG: f64 = 45.0;
/// Joints that move less than this over all rows stand still, radians.
const STILL_RAD: f64 = 0.5 * DEG;
/// A tool that is fixed this far from where it was measured contradicts the measurements, metres.
const CONTRADICTED_TOOL_M: f64 = 0.02;
/// A tool this far from where the profile has it is worth a warning, metres.
const WRONG_TOOL_M: f64 = 0.005;
/// A diagnosis does not begin with a tool that is rotated by more, radians.
const ROTATED_TOOL_RAD: f64 = 5.0 * DEG;
/// The way out of poses that are alike.
const VARIETY: &str =
    "measure configurations over the whole workspace: `poseshift plan` chooses them";
/// Points that are less apart are in one place, metres.
const ONE_PLACE_M: f64 = 1e-6;
/// Points that are no farther than this from the middle of all are not questioned for it, metres.
const NEAR_M: f64 = 10.0;
/// Rows that are enough to try other readings of the file.
const TRIED_ROWS: usize = 150;

/// What was asked for and cannot be.
#[must_use]
pub fn check_masses(problem: &Problem, compliance_asked: bool) -> Option<Remark> {
    if !compliance_asked {
        return None;
    }
    let weightless: Vec<&str> = (problem.tools.iter())
        .filter(|tool| tool.load.is_none())
        .map(|tool| tool.name.as_str())
        .collect();
    if problem.profile.bodies.is_empty() && weightless.len() == problem.tools.len() {
        return Some(remark(
            "no-masses",
            WHOLE_FILE,
            "the profile has no masses: compliance of the joints is not identified".into(),
            "give `bodies` and the tool's mass, or --level 2 if the arm is light and stiff",
        ));
    }
    let message = format!(
        "tools without a mass: {}: what they weigh goes into the compliance of the joints",
        weightless.join(", ")
    );
    let hint = "give the tool `mass_kg` and `cog_mm` in the profile";
    (!weightless.is_empty()).then(|| remark("no-tool-mass", WHOLE_FILE, message, hint))
}

/// What can be seen without a model: units of angles, joints that stand still, rows that repeat,
/// points on a line.
///
/// # Errors
/// All poses alike; the same orientation everywhere; a point far from all others; points in one
/// place or on one line.
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
    if rows.len() == 1 {
        return Err(suspicious(
            "there is one row: nothing of the arm follows from one pose".into(),
            VARIETY,
        ));
    }
    if still.len() == 6 {
        let most = (0..6).map(range).fold(0.0, f64::max) / DEG;
        return Err(suspicious(
            format!(
                "all {} rows have the same pose: no joint moves by more than {most:.3} deg, and \
                 {:.1} deg are needed{}",
                rows.len(),
                STILL_RAD / DEG,
                duplicates(rows).map_or_else(String::new, |copies| format!("; {}", copies.message))
            ),
            VARIETY,
        ));
    }
    for joint in &still {
        remarks.push(remark(
            "joint-never-moved",
            WHOLE_FILE,
            format!(
                "joint {} never moves by more than {:.3} deg: its parameters cannot be \
                 distinguished from those of its neighbours",
                joint + 1,
                range(*joint) / DEG
            ),
            "measure configurations in which every joint moves",
        ));
    }
    remarks.extend(duplicates(rows));
    let beyond = rows.iter().find_map(|row| {
        let joint = profile.mechanism.beyond_limit(&row.q, 5.0 * DEG)?;
        Some((row.line.clone(), joint, row.q[joint]))
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
    if rows.len() > 2 && still.len() < 3 && same_orientation(measurements) {
        return Err(suspicious(
            format!(
                "all {} rows have the same orientation though the joints move",
                rows.len()
            ),
            "leave the columns of the orientation out where the device measures positions only",
        ));
    }
    let points: Vec<Vector> = rows.iter().filter_map(|r| r.observed.point_m()).collect();
    if points.len() == rows.len() && points.len() >= 3 {
        let [long, wide, _] = spreads(&points);
        if long < ONE_PLACE_M {
            let most = (0..6).map(range).fold(0.0, f64::max) / DEG;
            return Err(suspicious(
                format!(
                    "all {} measured points are in one place, within {:.4} mm, though the joints \
                     move by up to {most:.1} deg",
                    rows.len(),
                    mm_from_m(long)
                ),
                "was the reflector followed? x_mm,y_mm,z_mm are what the device saw in each row",
            ));
        }
        // orientations tell what points on a line do not
        let is_turned = rows.iter().any(|r| matches!(r.observed, Observed::Pose(_)));
        if wide < 1e-3 * long.max(1e-6) && !is_turned {
            refuse_far_off(measurements)?;
            return Err(suspicious(
                format!(
                    "the measured points lie on one line: they spread {:.3} mm along it and {:.4} \
                     mm across",
                    mm_from_m(long),
                    mm_from_m(wide)
                ),
                VARIETY,
            ));
        }
    }
    Ok(remarks)
}

/// Rows that repeat an earlier one to the last digit.
pub fn duplicates(rows: &[Measurement]) -> Option<Remark> {
    let mut first: std::collections::HashMap<Vec<u64>, (&Line, usize)> =
        std::collections::HashMap::new();
    let (mut twice, mut most) = (Vec::new(), 0);
    for row in rows {
        let mut key: Vec<u64> = row.q.iter().map(|q| q.to_bits()).collect();
        key.extend(row.stand.bits());
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
        let (earlier, times) = first.entry(key).or_insert((&row.line, 0));
        *times += 1;
        if *times > 1 {
            twice.push((&row.line, *earlier));
            most = most.max(*times);
        }
    }
    let (line, earlier) = twice.first()?;
    Some(remark(
        "duplicate-rows",
        (*line).clone(),
        format!(
            "{} rows repeat an earlier one to the last digit, the first in {line} that of \
             {earlier}: they count {}",
            twice.len(),
            if most == 2 {
                "twice".to_owned()
            } else {
                format!("up to {most} times")
            }
        ),
        "a device never repeats itself exactly: leave copies out",
    ))
}

/// Where the middle of some numbers is.
fn middle(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    quantile(&numbers, 0.5)
}

/// Refuses a point that is far from all others.
///
/// # Errors
/// The farthest one, if there is any: no loss holds against it.
pub fn refuse_far_off(measurements: &Measurements) -> Result<(), IdentifyError> {
    let rows = measurements.rows.iter();
    let seen: Vec<(&Line, Vector)> = rows
        .filter_map(|row| Some((&row.line, row.observed.point_m()?)))
        .collect();
    if seen.len() < 3 {
        return Ok(());
    }
    let centre: Vector = std::array::from_fn(|k| middle(seen.iter().map(|(_, p)| p[k]).collect()));
    let away = |point: Vector| norm(sub(point, centre));
    let half_m = middle(seen.iter().map(|(_, p)| away(*p)).collect());
    let far = seen
        .iter()
        .max_by(|a, b| away(a.1).total_cmp(&away(b.1)))
        .filter(|(_, p)| away(*p) > NEAR_M.max(FAR_OFF * half_m));
    far.map_or(Ok(()), |(line, point)| {
        Err(IdentifyError::FarOff {
            line: (*line).clone(),
            away_mm: mm_from_m(away(*point)),
            half_mm: mm_from_m(half_m),
        })
    })
}

fn same_orientation(measurements: &Measurements) -> bool {
    let mut first = None;
    measurements.rows.iter().all(|row| match row.observed {
        Observed::Pose(pose) => *first.get_or_insert(pose.rotation) == pose.rotation,
        _ => false,
    })
}

/// How a reading of the file fits the drawing of the robot.
struct Fit {
    reading: Reading,
    start: Start,
}

impl Fit {
    /// What is missed as a part of how far the measurements spread.
    fn part(start: &Start) -> f64 {
        start.rms_m / start.spread_m.max(1e-9)
    }

    /// Angle between axis 1 and where the profile has it, degrees: devices are level more often
    /// than not.
    fn tilt_deg(&self, profile: &Profile) -> f64 {
        let axis = |rotation: &crate::geometry::Rotation| rotation.axis(2);
        let base = &self.start.world_from_base.rotation;
        let cosine = dot(axis(base), axis(&profile.world_from_base.rotation));
        cosine.clamp(-1.0, 1.0).acos() / DEG
    }
}

/// Checks a first guess that misses by far: tries other readings of the file, and says which one
/// fits.
///
/// # Errors
/// Another reading fits much better; orientations that are not of one tool.
pub fn check_start(
    profile: &Profile,
    measurements: &Measurements,
    start: &Start,
) -> Result<Vec<Remark>, IdentifyError> {
    let own = Fit::part(start);
    if start.rms_m > GOOD_START_M || own > GOOD_PART {
        check_reading(profile, measurements)?;
    }
    if let Some(apart) = start.turned_apart_rad.filter(|apart| *apart > TURNED_RAD)
        && start.rms_m < BAD_START_M
    {
        return Err(suspicious(
            format!(
                "the orientations do not fit the positions: half of them are more than {:.1} deg \
                 from any one orientation of the tool on the flange, and positions fit to {:.1} mm",
                apart / DEG,
                mm_from_m(start.rms_m)
            ),
            "qw,qx,qy,qz turn the tool into the world's frame, the scalar first; without these \
             columns positions alone count",
        ));
    }
    let mut remarks = moved_tools(profile, start);
    // a levelled device has its z upward, whichever side it looks to
    let down = profile.gravity_m_s2;
    let device_from_world =
        start.world_from_base.rotation * profile.world_from_base.rotation.transpose();
    let cosine = -(device_from_world * down)[2] / norm(down);
    let tilt = cosine.clamp(-1.0, 1.0).acos();
    if norm(down) > 0.0 && tilt > TILTED_RAD && start.fixed_points.is_none() {
        remarks.push(remark(
            "base-tilted",
            WHOLE_FILE,
            format!(
                "the robot is tilted by {:.1} deg from how the profile has it: so far is the device's z \
                 from upward",
                tilt / DEG
            ),
            "right where the device is tilted: gravity stays as `kinematics.base` has it; where \
             the robot is mounted so, write that into `kinematics.base`",
        ));
    }
    if let Some(count) = start.fixed_points.filter(|count| *count < 3) {
        remarks.push(remark(
            "base-not-determined",
            WHOLE_FILE,
            format!(
                "distances from {count} fixed point{} do not tell how the base is turned: it is as \
                 in the profile, and its place follows from that",
                if count == 1 { "" } else { "s" }
            ),
            "believe the arm's own values only; distances from three fixed points, or some \
             positions, determine the base",
        ));
    }
    Ok(remarks)
}

/// Gravity is along the device's z in what was identified.
#[must_use]
pub fn gravity_by_device(tilt_rad: f64, better: f64, gravity_m_s2: Vector) -> Remark {
    let [x, y, z] = gravity_m_s2;
    remark(
        "gravity-by-device",
        WHOLE_FILE,
        format!(
            "the device's z is {:.1} deg from upward as the profile has it, and the arm bends as if \
             the device were level: chi-squared is {better:.0} less than with gravity as the profile has it; gravity_m_s2 \
                 is ({x:.3}, {y:.3}, {z:.3}) now",
            tilt_rad / DEG
        ),
        "right where the robot is mounted so; where the device was tilted, look for what else \
         bends the arm",
    )
}

fn check_reading(profile: &Profile, measurements: &Measurements) -> Result<(), IdentifyError> {
    let sample = measurements.filtered(|i, _| i < TRIED_ROWS);
    if sample.rows.len() < 4 {
        return Ok(());
    }
    let Some(start) = start::find(profile, &sample) else {
        return Ok(());
    };
    let mut fits: Vec<Fit> = readings(&sample)
        .into_iter()
        .filter_map(|reading| {
            let start = start::find(profile, &reading.measurements)?;
            Some(Fit { reading, start })
        })
        .filter(|fit| fit.start.rms_m < BAD_START_M && Fit::part(&fit.start) < FITS_PART)
        .collect();
    let part = |fit: &Fit| Fit::part(&fit.start);
    let Some(least) = fits.iter().map(part).min_by(f64::total_cmp) else {
        return Ok(());
    };
    let own = Fit::part(&start);
    let sure = start.rms_m > BAD_START_M || own > FITS_PART;
    let factor = if sure { BETTER } else { 2.0 * BETTER };
    if least * factor > own {
        return Ok(());
    }
    fits.retain(|fit| part(fit) <= AS_WELL * least);
    fits.sort_by(|a, b| a.tilt_deg(profile).total_cmp(&b.tilt_deg(profile)));
    let best = &fits[0];
    let (supposes, as_well) = expected(&fits, profile);
    Err(suspicious(
        format!(
            "the measurements do not fit the robot: {:.1} mm rms with the best base and tool, \
             where they spread {:.1} mm; if {}, {:.1} of {:.1} mm{as_well}",
            mm_from_m(start.rms_m),
            mm_from_m(start.spread_m),
            supposes,
            mm_from_m(best.start.rms_m),
            mm_from_m(best.start.spread_m)
        ),
        &best.reading.hint,
    ))
}

/// What the first of some readings supposes, and what the others do.
///
/// A mirror image is mended by the exchange of any two coordinates: the exchanges differ only in
/// how the base then stands.
fn expected(fits: &[Fit], profile: &Profile) -> (String, String) {
    let as_well = |others: &mut dyn Iterator<Item = &Fit>| -> String {
        let others = others.take(2);
        others
            .map(|fit| format!("; as well if {}", fit.reading.supposes))
            .collect()
    };
    let exchanges: Vec<([&str; 2], f64)> = fits
        .iter()
        .filter_map(|fit| Some((fit.reading.exchanged?, fit.tilt_deg(profile))))
        .collect();
    let supposes = fits[0].reading.supposes.clone();
    if fits[0].reading.exchanged.is_none() || exchanges.len() == 1 {
        return (supposes, as_well(&mut fits.iter().skip(1)));
    }
    let tilts: Vec<String> = exchanges
        .iter()
        .map(|([a, b], tilt)| format!("{tilt:.1} deg with {a} and {b} exchanged"))
        .collect();
    let tilts = tilts.join(", ");
    let others = fits.iter().filter(|fit| fit.reading.exchanged.is_none());
    let others = as_well(&mut others.into_iter());
    if exchanges[0].1 < LEVEL_DEG && exchanges[1].1 > TURNED_DEG {
        let why = format!("; axis 1 then is off where the profile has it by {tilts}");
        return (supposes, why + &others);
    }
    (
        "they are a mirror image (two of the columns x_mm, y_mm, z_mm are swapped, or an axis \
         points the other way)"
            .into(),
        format!(
            "; which it is does not show: axis 1 then is off where the profile has it by \
            {tilts}"
        ) + &others,
    )
}

/// Tools that are elsewhere than the profile says.
fn moved_tools(profile: &Profile, start: &Start) -> Vec<Remark> {
    let points = start.points_on_flange_m.iter().zip(&start.moved_m);
    let moved = points.filter_map(|(((name, _), _), gap)| Some((name.as_str(), (*gap)?)));
    tools_elsewhere(moved.filter(|(name, _)| profile.tool(name).is_some()))
}

/// Fitted tools that are elsewhere than the profile says, where the first guess knows none.
#[must_use]
pub fn moved_fitted_tools(profile: &Profile, estimate: &Estimate) -> Vec<Remark> {
    // each stands on the one before
    let offset = |effects: &[Effect], name: &str| {
        let own = effects
            .iter()
            .filter(|e| e.kind == Kind::ToolFrame && e.site.is_of_tool(name));
        let frames = own.map(|e| Pose::from_xyz_rxryrz(e.parameters));
        frames
            .fold(Pose::identity(), |all, next| all * next)
            .translation
    };
    let tools = profile.tools.keys().map(|name| {
        let (before, now) = (
            offset(&profile.effects, name),
            offset(&estimate.effects, name),
        );
        (name.as_str(), norm(sub(now, before)))
    });
    tools_elsewhere(tools)
}

/// Names tools by how far their points are from where the profile has them, metres.
fn tools_elsewhere<'a>(moved: impl Iterator<Item = (&'a str, f64)>) -> Vec<Remark> {
    let mut gaps: Vec<(&str, f64)> = Vec::new();
    for (name, gap) in moved {
        // of several points with columns of their own the farthest
        match gaps.iter_mut().find(|(known, _)| *known == name) {
            Some((_, most)) => *most = most.max(gap),
            None => gaps.push((name, gap)),
        }
    }
    let far = gaps.into_iter().filter(|(_, gap)| *gap > WRONG_TOOL_M);
    let named = far.map(|(name, gap)| {
        remark(
            "tool-elsewhere",
            WHOLE_FILE,
            format!(
                "the point measured on tool `{name}` is {:.1} mm from where the profile has it",
                mm_from_m(gap)
            ),
            "is it the tool of the profile? px_mm, py_mm, pz_mm are in the tool's own frame; where \
             tool_frame is identified its deviation is found",
        )
    });
    named.collect()
}

/// Checks points of tools that are to stay where the profile has them.
///
/// # Errors
/// They lie otherwise to one another: no place of the tool explains them.
pub fn check_points(start: &Start) -> Result<(), IdentifyError> {
    let apart = start.mountings.iter();
    let apart = apart.max_by(|a, b| a.differs_m().total_cmp(&b.differs_m()));
    let Some(apart) = apart.filter(|mounting| mounting.differs_m() > WRONG_TOOL_M) else {
        return Ok(());
    };
    let ([a, b], [found, believed]) = (&apart.points, apart.apart_m.map(mm_from_m));
    Err(suspicious(
        format!(
            "the points `{a}` and `{b}` of tool `{}` are {found:.1} mm apart, and {believed:.1} mm \
             in the profile",
            apart.tool
        ),
        "are the names in their rows? where the reflectors were mounted anew, `poseshift calibrate \
         --identify points` finds where they are now",
    ))
}

/// Checks tools near which a diagnosis begins.
///
/// # Errors
/// One is rotated on the flange from where the profile has it.
pub fn check_rotated_tools(profile: &Profile, start: &Start) -> Result<(), IdentifyError> {
    let of_points = start.mountings.iter();
    let of_points = of_points.map(|mounting| (mounting.tool.as_str(), mounting.rotated_rad));
    let of_poses = start.turned.iter().filter_map(|(tool, rotation)| {
        let mounted = profile.tool(tool)?;
        let is_own = |e: &&Effect| e.kind == Kind::ToolFrame && e.site.is_of_tool(tool);
        let real = profile.effects.iter().find(is_own);
        let real = real.map_or(Pose::identity(), |e| Pose::from_xyz_rxryrz(e.parameters));
        let believed = mounted.flange_from_tool.rotation * real.rotation;
        Some((tool.as_str(), (believed.transpose() * *rotation).angle()))
    });
    let most = of_points.chain(of_poses).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((tool, angle)) = most.filter(|(_, angle)| *angle > ROTATED_TOOL_RAD) else {
        return Ok(());
    };
    Err(suspicious(
        format!(
            "tool `{tool}` is rotated on the flange by {:.1} deg from where the profile has it \
             (limit {:.0} deg): a diagnosis begins near the robot that the profile describes",
            angle / DEG,
            ROTATED_TOOL_RAD / DEG
        ),
        "`poseshift calibrate --level 0` writes a profile with the tool where it is; diagnose with \
         that",
    ))
}

/// Checks a tool that is to stay where the profile has it and was measured elsewhere.
///
/// # Errors
/// It is far away.
pub fn check_fixed_tool(profile: &Profile, start: &Start) -> Result<(), IdentifyError> {
    let Some(believed) = start
        .believed_rms_m
        .filter(|rms| *rms > CONTRADICTED_TOOL_M)
    else {
        return Ok(());
    };
    if start.rms_m * BETTER > believed {
        return Ok(());
    }
    let listed: Vec<String> = moved_tools(profile, start)
        .into_iter()
        .map(|remark| remark.message)
        .collect();
    Err(suspicious(
        format!(
            "with the tool where the profile has it the measurements miss the robot by {:.1} mm \
             rms, else by {:.1} mm: {}",
            mm_from_m(believed),
            mm_from_m(start.rms_m),
            listed.join("; ")
        ),
        "correct the tool in the profile, or do not --fix tool_frame",
    ))
}

/// Checks measurements from which no fit comes to rest: where even the best base and tool miss by
/// far, they are not of this robot, and which parameters are identified does not matter.
pub fn check_rest(error: IdentifyError, start: &Start) -> IdentifyError {
    if !matches!(error, IdentifyError::NotConverged { .. }) || start.rms_m < BAD_START_M {
        return error;
    }
    suspicious(
        format!(
            "the measurements do not fit the robot: {:.1} mm rms with the best base and tool, and \
             with more parameters {error}",
            mm_from_m(start.rms_m)
        ),
        NOT_OF_THIS_ROBOT,
    )
}
