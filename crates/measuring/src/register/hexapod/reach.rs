//! The poses that the device can measure, and which of them a robot reaches.

use super::solve::{Solved, base_points, legs_at, solve};
use super::{Design, HexapodError, Lengths};
use crate::geometry::{Pose, Vector};
use crate::inverse::{Arm, Branch, Unsupported};
use crate::model::Conditions;
use crate::profile::{Mounted, Profile};

/// The device at its nominal lengths, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Device {
    /// B1B2, B2B3, B3B1.
    pub base_m: [f64; 3],
    /// T1T2, T2T3, T3T1.
    pub tool_m: [f64; 3],
    /// The ballbar's nominal length.
    pub leg_m: f64,
    /// How far from it the ballbar measures, to each side.
    pub range_m: f64,
}

impl Device {
    /// Where the balls B1, B2, B3 are in the base's frame, metres.
    #[must_use]
    pub fn base_balls_m(&self) -> [Vector; 3] {
        base_points(self.base_m).0
    }
}

/// A measurable pose and how the robot stands there.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// The design.
    pub design: Design,
    /// The nominal pose.
    pub solved: Solved,
    /// Branch and the controller's joint angles (radians) of every posture within the joint
    /// limits.
    pub postures: Vec<(Branch, [f64; 6])>,
    /// Largest difference of a leg of the real arm from the ballbar's nominal length in the first
    /// posture that is in range, or the least of all, metres; none where the robot does not
    /// reach the pose.
    pub leg_error_m: Option<f64>,
    /// Whether a posture within the joint limits keeps all legs in the ballbar's range.
    pub measurable: bool,
}

/// The 72 poses: six base orders, three turns of the tool, four modes.
///
/// # Errors
/// If the device's lengths have no solution.
pub fn measurable(device: &Device) -> Result<Vec<(Design, Solved)>, HexapodError> {
    let lengths = Lengths {
        base_m: device.base_m,
        tool_m: device.tool_m,
        legs_m: [device.leg_m; 6],
    };
    let turns = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
    let mut poses = Vec::with_capacity(72);
    for design in Design::all()
        .into_iter()
        .filter(|design| turns.contains(&design.tool))
    {
        for mode in 1..=4 {
            poses.push((design, solve(&lengths, &design, mode)?));
        }
    }
    Ok(poses)
}

/// Which of the measurable poses a robot reaches: all joints within their limits, and the real
/// arm's legs in range when the controller goes to the nominal pose.
///
/// `world_from_device` is where the base balls stand, `tool` the triangle of tool balls (its frame
/// as in [`super`]).
///
/// # Errors
/// If the arm has no closed-form inverse; a device without solutions has no poses.
pub fn reach(
    device: &Device,
    world_from_device: &Pose,
    profile: &Profile,
    tool: &Mounted,
) -> Result<Vec<Reached>, Unsupported> {
    let arm = Arm::of(&profile.geometry(tool), &profile.mechanism)?;
    let real = profile.real_model(tool, &Conditions::default());
    let device_from_world = world_from_device.inverse();
    let joints = &profile.mechanism.joints;
    let middle = joints.map(|j| 0.5 * (j.min_rad + j.max_rad));
    let mut all = Vec::new();
    for (design, solved) in measurable(device).unwrap_or_default() {
        let wanted = *world_from_device * solved.pose;
        let mut reached = Reached {
            design,
            solved,
            postures: Vec::new(),
            leg_error_m: None,
            measurable: false,
        };
        for branch in Branch::ALL {
            let solution = arm.solve_branch(&wanted, branch, &middle);
            let inside =
                (0..6).all(|i| (joints[i].min_rad..=joints[i].max_rad).contains(&solution.q[i]));
            if solution.beyond > 0.0 || !inside {
                continue;
            }
            let back = solved.pose.inverse();
            let landed = device_from_world * real.forward(&solution.q, &Conditions::default());
            let points = solved
                .tool_points_m
                .map(|p| landed.transform(back.transform(p)));
            let error = legs_at(device.base_m, &points, &design)
                .iter()
                .map(|leg| (leg - device.leg_m).abs())
                .fold(0.0, f64::max);
            let in_range = error <= device.range_m;
            if in_range {
                reached.postures.push((branch, solution.q));
            }
            if !reached.measurable && (in_range || reached.leg_error_m.is_none_or(|e| error < e)) {
                reached.leg_error_m = Some(error);
            }
            reached.measurable |= in_range;
        }
        all.push(reached);
    }
    Ok(all)
}
