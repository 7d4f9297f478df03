//! Which of the inverse's solutions a target means by itself: by its configuration data where the
//! controller honours them, and by the joints before.

use super::ground::Ground;
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::inverse::{Ambiguous, Answer, Arm, Branch, Margins};
use crate::model::JointSense;
use crate::program::{BORDER_RAD, Configuration, TargetId};
use std::cmp::Ordering;

/// Likewise where another posture is on the side that is asked for: the controller takes that one.
const ROUNDED_RAD: f64 = 0.01 * DEG;
/// Likewise of the wrist centre at axis 1.
const BORDER_M: f64 = 1e-5;
/// Changes of joints that differ by less are equal.
const SAME_CHANGE_RAD: f64 = 1e-4 * DEG;
/// A wrist centre as far from its border at axis 1 has joint 1 more than 45 degrees from there, with
/// links that are offset sideways by up to so much.
const FAR_FROM_AXIS_1_M: f64 = 0.25;
/// How far beyond its limits a joint of the nominal arm may stand; the real one is judged exactly.
pub(super) const LIMIT_RAD: f64 = 2.0 * DEG;
/// Name of the finding about a target that the nominal arm does not reach.
pub(crate) const OUT_OF_REACH: &str = "out-of-reach";

/// A way to stand at a target with the nominal arm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Posture {
    pub branch: Branch,
    pub q: [f64; 6],
    /// It is all that the configuration data ask for.
    pub configured: bool,
    /// Its joints stand where that asks, but for rounding.
    pub exactly: bool,
    /// Its joints are in the ranges that the configuration data name.
    pub in_ranges: bool,
}

/// A target whose branch is to be found.
pub(crate) struct Asked<'a> {
    pub target: TargetId,
    pub arm: &'a Arm,
    pub wanted: Pose,
    pub configuration: Configuration,
    /// The controller goes by the configuration data.
    pub honoured: bool,
    /// The joints from which the robot comes, or from which its inverse starts.
    pub start: Option<[f64; 6]>,
    /// Joints near which another move names its posture at this target, or in which the robot stood
    /// when that was last known: looked at where it is not known from where the robot comes.
    pub elsewhere: Option<[f64; 6]>,
    /// The robot stood there last: its branch goes on.
    pub goes_on: bool,
}

impl Asked<'_> {
    /// The joints to which the posture is nearest where nothing else decides.
    fn near(&self) -> [f64; 6] {
        let middle = |joint: &JointSense| 0.0_f64.clamp(joint.min_rad, joint.max_rad);
        let joints = &self.arm.mechanism().joints;
        self.start
            .or(self.elsewhere)
            .unwrap_or_else(|| joints.each_ref().map(middle))
    }
}

/// The posture that configuration data and the joints before ask for; `None` where there is none,
/// with a finding.
pub(crate) fn choose(
    ground: &Ground,
    asked: &Asked,
    findings: &mut Vec<Finding>,
) -> Option<Posture> {
    // what the controller does not go by says nothing of rotations either, once it is known from
    // where it comes
    let counts = asked.honoured || !(asked.start.is_some() || asked.goes_on);
    let asked = &Asked {
        configuration: if counts {
            with_kept(asked)
        } else {
            Configuration::default()
        },
        ..*asked
    };
    let Asked {
        target,
        arm,
        wanted,
        configuration,
        honoured,
        start,
        ..
    } = asked;
    if arm.has_offset_wrist() {
        match on_track(asked) {
            Ok(None) => {}
            Ok(posture) => return posture,
            Err(ambiguous) => {
                findings.push(unclear(ground, *target, &ambiguous));
                return None;
            }
        }
    }
    // mostly the nearest posture is on the branch of the last one; the others are tried where it
    // does not fit, or one of them may be nearer
    let is_certain = !honoured || !configuration.partly_understood;
    if let Some(before) = start.as_ref().filter(|_| is_certain) {
        let (branch, margins) = arm.posture(before);
        let same = on_branch(arm, wanted, branch, before, configuration);
        let fits = |same: &Posture| same.configured && same.exactly;
        let is_nearest = |same: &Posture| is_nearest(changes(&same.q, before)[0], &margins);
        if let Some(same) = same.filter(|same| fits(same) && is_nearest(same)) {
            return Some(same);
        }
    }
    let near = asked.near();
    let postures: Vec<Posture> = Branch::ALL
        .iter()
        .filter_map(|&branch| on_branch(arm, wanted, branch, &near, configuration))
        .collect();
    // the largest change of a joint, then the next one; equal ones but for rounding are equal
    let distance = |posture: &Posture| {
        changes(&posture.q, &near).map(|change| (change / SAME_CHANGE_RAD).round())
    };
    let compared = |a: &Posture, b: &Posture| {
        let pairs = distance(a).into_iter().zip(distance(b));
        pairs.fold(Ordering::Equal, |order, (a, b)| order.then(a.total_cmp(&b)))
    };
    let kept = (asked.goes_on && start.is_none()).then(|| arm.posture(&near).0);
    let nearest = |accept: &dyn Fn(&Posture) -> bool| {
        let accepted = postures.iter().filter(|posture| accept(posture)).copied();
        let is_other = |posture: &Posture| kept.is_some_and(|kept| kept != posture.branch);
        accepted.min_by(|a, b| {
            let others = is_other(a).cmp(&is_other(b));
            others.then_with(|| compared(a, b))
        })
    };
    if postures.is_empty() {
        return out_of_reach(ground, asked, &near, findings);
    }
    if !honoured && (start.is_some() || asked.goes_on) {
        let posture = nearest(&|_| true)?;
        if start.is_none() && postures.len() > 1 {
            findings.push(assumed(ground, *target, &posture));
        }
        return Some(posture);
    }
    let by_ranges = || {
        let suffice = configuration.ranges_suffice || !honoured;
        nearest(&|posture| posture.in_ranges && suffice)
    };
    let exactly = nearest(&|posture| posture.configured && posture.exactly);
    let about = || nearest(&|posture| posture.configured);
    if let Some(posture) = exactly.or_else(about).or_else(by_ranges) {
        // what the controller does not go by says nothing
        let is_other =
            |other: &Posture| (other.configured || !honoured) && other.branch != posture.branch;
        if let Some(other) = postures.iter().find(|other| is_other(other)) {
            if start.is_none() {
                findings.push(assumed(ground, *target, &posture));
            } else if configuration.partly_understood {
                findings.push(nearest_assumed(ground, *target, [&posture, other]));
            }
        }
        return Some(posture);
    }
    let in_ranges = postures.iter().filter(|posture| posture.in_ranges).copied();
    let agreeing = in_ranges.min_by(|a, b| {
        let [off_a, off_b] = [a, b].map(|posture| sides_off(configuration, posture.branch));
        off_a.cmp(&off_b).then_with(|| compared(a, b))
    });
    let (taken, which) = match agreeing {
        Some(agreeing) => (agreeing, "the one that agrees with it most"),
        None => (nearest(&|_| true)?, "the one nearest to the target before"),
    };
    let name = ground.name_of(*target);
    let shown = taken.q.map(|q| format!("{:.1}", q / DEG)).join(", ");
    if start.is_some() {
        let message = format!(
            "no solution at {name} has the configuration that the file gives; {which} is taken \
             (joints {shown} deg)"
        );
        let hint =
            "check the configuration data, and that robot, tool and frame are those of the program";
        findings.push(ground.at_target(
            "configuration-mismatch",
            Severity::Warning,
            *target,
            message,
            hint,
        ));
        return Some(taken);
    }
    let message = format!(
        "no solution at {name} has the configuration that the file gives, and no target before \
         tells how the robot comes here \
         (nearest: joints {shown} deg)"
    );
    let hint =
        "check that robot, tool and frame are those of the program; start with a joint target";
    findings.push(ground.at_target(
        "configuration-unknown",
        Severity::Error,
        *target,
        message,
        hint,
    ));
    None
}

/// The configuration with the sides that are to stay as they are before.
fn with_kept(asked: &Asked) -> Configuration {
    let mut all = asked.configuration;
    let Some(start) = asked.start.filter(|_| all.kept != [false; 3]) else {
        return all;
    };
    let before = asked.arm.posture(&start).0;
    let keep = |stated: &mut Option<bool>, kept: bool, before: bool| {
        *stated = stated.or(kept.then_some(before));
    };
    keep(&mut all.behind_axis_1, all.kept[0], before.behind_axis_1);
    keep(
        &mut all.behind_lower_arm,
        all.kept[1],
        before.behind_lower_arm,
    );
    keep(
        &mut all.joint_5_negative,
        all.kept[2],
        before.joint_5_negative,
    );
    all
}

/// The answer of an arm with an offset wrist that the configuration means, by its track from the
/// posture before where several have it. `None` where none has it.
fn on_track(asked: &Asked) -> Result<Option<Posture>, Ambiguous> {
    let (arm, wanted) = (asked.arm, &asked.wanted);
    let before = asked.start.as_ref();
    // a robot that does not honour its configuration goes on as it came
    let free = !asked.honoured && before.is_some();
    let fits = |posture: &Posture| free || posture.configured;
    if let Some(q) = before.and_then(|before| arm.follow(before, wanted).ok()) {
        let posture = configured(arm, arm.posture(&q).0, q, &asked.configuration);
        if let Some(posture) = posture.filter(fits) {
            return Ok(Some(posture));
        }
    }
    let near = asked.near();
    let posture = |answer: &Answer| configured(arm, answer.branch, answer.q, &asked.configuration);
    let is_meant = |answer: &Answer| posture(answer).as_ref().is_some_and(fits);
    let chosen = arm.choose(wanted, &near, before, is_meant)?;
    Ok(chosen.as_ref().and_then(posture))
}

/// Several postures of one branch have the configuration that the file gives.
fn unclear(ground: &Ground, target: TargetId, ambiguous: &Ambiguous) -> Finding {
    let joints = |answer: &Answer| {
        let q = answer.q.map(|q| format!("{:.1}", q / DEG));
        format!("({})", q.join(", "))
    };
    let candidates: Vec<String> = ambiguous.candidates.iter().map(joints).collect();
    let message = format!(
        "{} postures at {} have the configuration that the file gives, and no straight path from a \
         target before leads to one of \
         them (joints {} deg)",
        candidates.len(),
        ground.name_of(target),
        candidates.join(" or ")
    );
    ground.at_target(
        "configuration-ambiguous",
        Severity::Error,
        target,
        message,
        "put a joint target before it",
    )
}

/// Neither the file nor the move before tells the posture.
fn assumed(ground: &Ground, target: TargetId, posture: &Posture) -> Finding {
    let message = format!(
        "neither configuration data nor a move before tell in which posture the robot comes to {}: \
         joints {} deg are assumed",
        ground.name_of(target),
        posture.q.map(|q| format!("{:.1}", q / DEG)).join(", ")
    );
    ground.at_target(
        "posture-assumed",
        Severity::Warning,
        target,
        message,
        "begin with a joint move to joints, or give --start-joints",
    )
}

/// The file tells which of these postures is meant in a way that is not understood.
fn nearest_assumed(ground: &Ground, target: TargetId, postures: [&Posture; 2]) -> Finding {
    let [taken, other] = postures.map(|posture| {
        let q = posture.q.map(|q| format!("{:.1}", q / DEG));
        q.join(", ")
    });
    let message = format!(
        "two postures at {} agree with what is understood of its configuration data: joints {taken} \
         deg, nearest to the target before, are assumed; {other} deg have it too",
        ground.name_of(target),
    );
    ground.at_target(
        "posture-assumed",
        Severity::Warning,
        target,
        message,
        "see that the controller stands so, or teach the joints",
    )
}

/// By how much each joint changes from one posture to another, the largest first.
fn changes(q: &[f64; 6], before: &[f64; 6]) -> [f64; 6] {
    let mut changes = std::array::from_fn(|i| (q[i] - before[i]).abs());
    changes.sort_unstable_by(|a: &f64, b: &f64| b.total_cmp(a));
    changes
}

/// Whether no posture on another branch is as near to the joints before, with these margins, as one
/// on their own branch whose largest change of a joint is this: another one has joint 5 or the elbow
/// as far on the other side of its border, or joint 1 elsewhere.
fn is_nearest(change: f64, margins: &Margins) -> bool {
    let border = margins.wrist_rad.min(margins.elbow_rad).min(45.0 * DEG);
    change < border && margins.shoulder_m > FAR_FROM_AXIS_1_M
}

/// Whether a posture is the one that configuration data ask for; at a singularity it is on both of
/// its sides.
pub(super) fn holds(
    arm: &Arm,
    configuration: &Configuration,
    branch: Branch,
    q: &[f64; 6],
) -> bool {
    let margins = arm.posture(q).1;
    let agrees = |flag: Option<bool>, is: bool, margin: f64, border: f64| {
        flag.is_none_or(|flag| flag == is || margin < border)
    };
    let (shoulder, elbow, wrist) = (margins.shoulder_m, margins.elbow_rad, margins.wrist_rad);
    let sides = configuration;
    agrees(
        sides.behind_axis_1,
        branch.behind_axis_1,
        shoulder,
        BORDER_M,
    ) && agrees(
        sides.behind_lower_arm,
        branch.behind_lower_arm,
        elbow,
        ROUNDED_RAD,
    ) && agrees(
        sides.joint_5_negative,
        branch.joint_5_negative,
        wrist,
        ROUNDED_RAD,
    ) && (0..6).all(|i| configuration.has_joint(i, q[i], BORDER_RAD))
}

/// On how many sides a branch is not where configuration data ask for; and whether joint 5 is one
/// of them.
fn sides_off(configuration: &Configuration, branch: Branch) -> (usize, bool) {
    let is_off = |flag: Option<bool>, is: bool| flag.is_some_and(|flag| flag != is);
    let joint_5 = is_off(configuration.joint_5_negative, branch.joint_5_negative);
    let all = [
        is_off(configuration.behind_axis_1, branch.behind_axis_1),
        is_off(configuration.behind_lower_arm, branch.behind_lower_arm),
        joint_5,
    ];
    (all.into_iter().filter(|off| *off).count(), joint_5)
}

/// The solution on one branch with the turns that the configuration data and the limits ask for;
/// `None` out of reach or beyond a limit.
pub(crate) fn on_branch(
    arm: &Arm,
    wanted: &Pose,
    branch: Branch,
    near: &[f64; 6],
    configuration: &Configuration,
) -> Option<Posture> {
    let solution = arm.solve_branch(wanted, branch, near);
    if solution.beyond > 0.0 {
        return None;
    }
    configured(arm, branch, solution.q, configuration)
}

/// A solution with the rotations that the configuration data and the limits ask for; `None` beyond
/// a limit.
fn configured(
    arm: &Arm,
    branch: Branch,
    mut q: [f64; 6],
    configuration: &Configuration,
) -> Option<Posture> {
    let mechanism = arm.mechanism();
    let (mut in_ranges, mut exactly) = (true, true);
    for i in 0..6 {
        let limits = (
            mechanism.joints[i].min_rad - LIMIT_RAD,
            mechanism.joints[i].max_rad + LIMIT_RAD,
        );
        // a border belongs to both sides, but what is inside goes first
        let turned = |range: (f64, f64)| turned_into(q[i], range, limits);
        let nearest = |border: f64| {
            let ranges = ranges_of(configuration, i, border).into_iter();
            let angles = ranges.flatten().filter_map(turned);
            angles.min_by(|a, b| (a - q[i]).abs().total_cmp(&(b - q[i]).abs()))
        };
        if let Some(angle) = nearest(0.0).or_else(|| nearest(ROUNDED_RAD)) {
            q[i] = angle;
        } else if let Some(angle) = nearest(BORDER_RAD) {
            (q[i], exactly) = (angle, false);
        } else {
            in_ranges = false;
            q[i] = turned((f64::NEG_INFINITY, f64::INFINITY))?;
        }
    }
    let agrees = |flag: Option<bool>, is: bool| flag.is_none_or(|flag| flag == is);
    let configured = in_ranges
        && agrees(configuration.behind_axis_1, branch.behind_axis_1)
        && agrees(configuration.behind_lower_arm, branch.behind_lower_arm)
        && agrees(configuration.joint_5_negative, branch.joint_5_negative);
    Some(Posture {
        branch,
        q,
        configured,
        exactly,
        in_ranges,
    })
}

/// The ranges that configuration data name for a joint, wider by a border at each end.
fn ranges_of(configuration: &Configuration, joint: usize, border: f64) -> [Option<(f64, f64)>; 2] {
    let (low, high) = configuration.joints[joint].unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    let (low, high) = (low - border, high + border);
    match configuration.beyond[joint].map(|least| least - border) {
        None => [Some((low, high)), None],
        Some(least) => [Some((low.max(least), high)), Some((low, high.min(-least)))],
    }
}

/// The angle, by as few whole revolutions as can be, that lies in both ranges.
fn turned_into(angle: f64, range: (f64, f64), limits: (f64, f64)) -> Option<f64> {
    let (low, high) = (range.0.max(limits.0), range.1.min(limits.1));
    let turn = std::f64::consts::TAU;
    if (low..=high).contains(&angle) {
        return Some(angle);
    }
    let moved = if angle < low {
        angle + turn * ((low - angle) / turn).ceil()
    } else {
        angle - turn * ((angle - high) / turn).ceil()
    };
    (low..=high).contains(&moved).then_some(moved)
}

/// A pose that the nominal arm does not reach within its limits: the real one may, so the branch of
/// the posture before or of the stretched arm goes on; with neither it is an error.
fn out_of_reach(
    ground: &Ground,
    asked: &Asked,
    near: &[f64; 6],
    findings: &mut Vec<Finding>,
) -> Option<Posture> {
    let Asked {
        target,
        arm,
        wanted,
        ..
    } = asked;
    let branch = arm.posture(near).0;
    let stretched = arm.solve_branch(wanted, branch, near);
    // squared cosine of the elbow beyond 1: a few millimetres at full stretch
    if stretched.beyond > 0.0 && stretched.beyond < 0.02 {
        return Some(Posture {
            branch,
            q: stretched.q,
            configured: false,
            exactly: false,
            in_ranges: false,
        });
    }
    let message = if stretched.beyond > 0.0 {
        format!(
            "{} is out of the nominal robot's reach",
            ground.name_of(*target)
        )
    } else {
        let q = stretched.q;
        let joint = arm.mechanism().beyond_limit(&q, LIMIT_RAD).unwrap_or(0);
        let limits = &arm.mechanism().joints[joint];
        format!(
            "{} is reachable on no branch within the joint limits (nearest: joint {} at {:.2} deg, \
             limits {:.2} to {:.2})",
            ground.name_of(*target),
            joint + 1,
            q[joint] / DEG,
            limits.min_rad / DEG,
            limits.max_rad / DEG
        )
    };
    let hint = elsewhere(ground, asked, near)
        .unwrap_or_else(|| "check that robot, tool and frame are those of the program".to_owned());
    findings.push(ground.at_target(OUT_OF_REACH, Severity::Error, *target, message, &hint));
    None
}

/// What is said where the arm would reach a pose if its base stood at the origin.
fn elsewhere(ground: &Ground, asked: &Asked, near: &[f64; 6]) -> Option<String> {
    let base = ground.profile.world_from_base;
    if base == Pose::identity() {
        return None;
    }
    // the base at the origin sees a pose where this one sees it moved along
    let moved = base * asked.wanted;
    let free = Configuration::default();
    let reaches = |branch| on_branch(asked.arm, &moved, branch, near, &free).is_some();
    Branch::ALL.into_iter().any(reaches).then(|| {
        let [x, y, z] = base.translation.map(mm_from_m);
        format!(
            "with the base at the origin it is within reach: kinematics.base of the profile is at \
             ({x:.0}, {y:.0}, {z:.0}) mm"
        )
    })
}
