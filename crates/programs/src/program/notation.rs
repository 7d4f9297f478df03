//! How targets are written as numbers, where several languages write them so: poses, and
//! configuration data.

use super::{BORDER_RAD, Displacement, Posture, Role, Shift, Stride};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Quaternion, Rotation};

/// So near to a border, in degrees, configuration data of either side are right, unless a whole
/// rotation lies between them.
const BORDER_DEG: f64 = 0.01;
/// So near to a border, in degrees, the file's own rounding tells on which side of it a joint is.
const ROUNDED_DEG: f64 = 0.0005;

/// x, y, z, three angles, and at most six configuration data.
pub(super) static WITH_ANGLES: [Role; 12] = roles(3);
/// x, y, z, a quaternion, and at most four configuration data.
pub(super) static WITH_QUATERNION: [Role; 11] = roles(4);

const fn roles<const COUNT: usize>(orientation: usize) -> [Role; COUNT] {
    let mut roles = [Role::Configuration; COUNT];
    let mut at = 0;
    while at < 3 + orientation {
        roles[at] = if at < 3 {
            Role::Position
        } else {
            Role::Orientation
        };
        at += 1;
    }
    roles
}

/// The pose of x, y, z in mm and a quaternion, its scalar first; its length does not count.
pub(super) fn pose_of_quaternion(n: &[f64]) -> Pose {
    let rotation = Quaternion([n[3], n[4], n[5], n[6]]).normalized();
    Pose::from_parts([n[0], n[1], n[2]].map(m_from_mm), rotation)
}

/// Writes these numbers: of the two quaternions of a rotation the one near the present numbers.
pub(super) fn write_quaternion(pose: &Pose, n: &mut [f64]) {
    let present = Quaternion([n[3], n[4], n[5], n[6]]);
    n[..3].copy_from_slice(&pose.translation.map(mm_from_m));
    n[3..7].copy_from_slice(&pose.rotation.quaternion().nearest_to(&present).0);
}

/// The pose of x, y, z in mm and angles about x, y, z in degrees: `Rz · Ry · Rx`.
pub(super) fn pose_of_angles(n: [f64; 6]) -> Pose {
    Pose {
        rotation: Rotation::from_rzryrx([n[5] * DEG, n[4] * DEG, n[3] * DEG]),
        translation: [n[0], n[1], n[2]].map(m_from_mm),
    }
}

/// What a position is displaced by whose number `at` of those grows by so much; the last two angles
/// rotate it about no axis of the tool.
pub(super) fn grown_by(at: usize, by: f64) -> Option<Displacement> {
    let mut n = [0.0; 6];
    *n.get_mut(at)? = by;
    let (along, still) = (pose_of_angles(n), Pose::identity());
    let (in_frame, in_tool) = match at {
        0..=2 => (along, still),
        3 => (still, along),
        _ => return Some(turned_by(by)),
    };
    Some(Displacement::By(Box::new(Shift { in_frame, in_tool })))
}

/// Whether a value has something in it that a word by itself names: `p.Z` in `hop+p.Z`, and not in
/// `up.Z`.
pub(super) fn mentions(value: &[u8], word: &[u8]) -> bool {
    let is_letter = |at: Option<usize>| {
        let byte = at.and_then(|at| value.get(at));
        byte.is_some_and(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'$'))
    };
    memchr::memmem::find_iter(value, word)
        .any(|at| !is_letter(at.checked_sub(1)) && !is_letter(Some(at + word.len())))
}

/// What a position is displaced by one of whose angles grows by so many degrees.
pub(super) fn turned_by(degrees: f64) -> Displacement {
    Displacement::Within(Box::new([Stride::Turned(Some(degrees * DEG))]))
}

/// Writes these numbers, the angles as [`nearest_angles`].
pub(super) fn write_angles(pose: &Pose, beyond_deg: f64, n: &mut [f64]) {
    let present = [n[3], n[4], n[5]];
    n[..3].copy_from_slice(&pose.translation.map(mm_from_m));
    n[3..6].copy_from_slice(&nearest_angles(&pose.rotation, present, beyond_deg));
}

/// Angles about x, y, z in degrees, `Rz · Ry · Rx`, as the present ones are written: of the two
/// triples that every rotation has the one with y beyond a quarter revolution only where the
/// present one is; of the turns of each angle that nearest to the present angle, but within a half
/// revolution, and `beyond_deg` that cannot be seen in the file, where the present one is.
pub(super) fn nearest_angles(rotation: &Rotation, present: [f64; 3], beyond_deg: f64) -> [f64; 3] {
    let [z, y, x] = rotation.rzryrx(present[0] * DEG).map(|angle| angle / DEG);
    let usual = [x, y, z];
    let other = [x + 180.0, 180.0 - y, z + 180.0];
    let other = if present[1].abs() > 90.0 {
        other
    } else {
        usual
    };
    nearest_of(usual, other, present, beyond_deg)
}

/// Angles in degrees, each by whole rotations as near to the present ones as can be.
pub(super) fn near(angles: [f64; 3], present: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| angles[i] + 360.0 * ((present[i] - angles[i]) / 360.0).round())
}

/// Of two triples of one rotation the one nearer to the present, by whole rotations, but each
/// angle within a half revolution and `beyond_deg` where the present one is.
pub(super) fn nearest_of(
    usual: [f64; 3],
    other: [f64; 3],
    present: [f64; 3],
    beyond_deg: f64,
) -> [f64; 3] {
    let far = |angles: &[f64; 3]| (0..3).map(|i| (angles[i] - present[i]).abs()).sum::<f64>();
    let (usual, other) = (near(usual, present), near(other, present));
    let chosen = if far(&other) < far(&usual) {
        other
    } else {
        usual
    };
    std::array::from_fn(|i| {
        let is_over = present[i].abs() <= 180.0 && chosen[i].abs() > 180.0 + beyond_deg;
        chosen[i]
            - if is_over {
                360.0_f64.copysign(chosen[i])
            } else {
                0.0
            }
    })
}

/// The pose of x, y, z in mm and angles in degrees about x, then the new y, then the new z: `Rx ·
/// Ry · Rz`.
pub(super) fn pose_of_turning_angles(n: [f64; 6]) -> Pose {
    let inverse = Rotation::from_rzryrx([-n[5] * DEG, -n[4] * DEG, -n[3] * DEG]);
    Pose {
        rotation: inverse.transpose(),
        translation: [n[0], n[1], n[2]].map(m_from_mm),
    }
}

/// Writes these numbers, the angles as [`nearest_angles`].
pub(super) fn write_turning_angles(pose: &Pose, n: &mut [f64]) {
    let present = [-n[3], -n[4], -n[5]];
    let angles = nearest_angles(&pose.rotation.transpose(), present, 0.0);
    n[..3].copy_from_slice(&pose.translation.map(mm_from_m));
    n[3..6].copy_from_slice(&angles.map(|angle| -angle));
}

/// Whether what configuration data say was `right` of the posture before, as near to a border as they
/// are read, and is not of that after.
/// It hangs on one joint. Near a border of that both sides are right; but not where the data would
/// then mean another rotation of the joint, and the robot would go the other way round: that is
/// left to chance only where the file's rounding has done so before.
pub(super) fn truly_changes(
    before: &Posture,
    after: &Posture,
    joint: usize,
    right: impl Fn(&Posture) -> bool,
) -> bool {
    let turned = |posture: &Posture, by_deg: f64| {
        let mut near = *posture;
        near.joints_rad[joint] += by_deg * DEG;
        right(&near)
    };
    let within = |posture: &Posture, deg: f64| [-deg, 0.0, deg].map(|by| turned(posture, by));
    let is_near = |posture: &Posture, deg: f64| within(posture, deg).contains(&true);
    let is_on_border = |posture: &Posture| {
        let all = within(posture, ROUNDED_DEG);
        all.contains(&true) && all.contains(&false)
    };
    if right(after) || !is_near(before, BORDER_RAD / DEG) {
        return false;
    }
    let means_other = [-360.0, 360.0].into_iter().any(|by| turned(after, by));
    let stays = is_on_border(before) && is_on_border(after);
    !is_near(after, BORDER_DEG) || means_other && !stays
}

/// Changes each of the present configuration data that truly changes to that of the posture after;
/// leaves the others. `of` gives those of a posture, `joints` the joint of each.
pub(super) fn update<const COUNT: usize>(
    of: impl Fn(&Posture) -> [f64; COUNT],
    joints: [usize; COUNT],
    before: &Posture,
    after: &Posture,
    present: &mut [f64],
) {
    let new = of(after);
    for (k, number) in present.iter_mut().enumerate().take(COUNT) {
        let is = |posture: &Posture| (of(posture)[k] - *number).abs() < 0.5;
        if truly_changes(before, after, joints[k], is) {
            *number = new[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_about_x_turns_first_and_that_about_z_last() {
        let of = |angles: [f64; 3]| {
            pose_of_angles([0.0, 0.0, 0.0, angles[0], angles[1], angles[2]]).rotation
        };
        let about_z = of([0.0, 0.0, 90.0]) * [1.0, 0.0, 0.0];
        assert!((about_z[1] - 1.0).abs() < 1e-12);
        // the first turns z to -y, the second leaves that, the third turns -y to x
        let all = of([90.0, 30.0, 90.0]) * [0.0, 0.0, 1.0];
        assert!((all[0] - 1.0).abs() < 1e-12, "{all:?}");
    }

    #[test]
    fn angles_stay_near_the_present_ones() {
        for (present, turned) in [
            (
                [179.9999, -40.0, -179.9995],
                [-179.9998, -40.0001, 179.9997],
            ),
            ([10.0, 89.0, 20.0], [10.001, 89.001, 20.001]),
            ([190.0, 20.0, -270.0], [190.001, 20.001, -270.001]),
            ([10.0, 100.0, -20.0], [10.001, 100.001, -20.001]),
            ([-179.9999, 100.0, 20.0], [179.9999, 100.001, 20.001]),
            ([-179.532, 0.193, -120.974], [-179.532, 0.193, -120.974]),
            ([180.0, 0.0, 180.0], [180.0, 0.0, 180.0]),
            ([270.0, -20.0, -350.0], [270.0, -20.0, -350.0]),
            ([30.0, 90.0, 40.0], [30.0, 90.0, 40.0]),
        ] {
            let [x, y, z] = turned.map(|angle: f64| angle * DEG);
            let found = nearest_angles(&Rotation::from_rzryrx([z, y, x]), present, 0.0);
            let gap = (0..3).map(|i| (found[i] - turned[i]).abs());
            assert!(gap.fold(0.0, f64::max) < 1e-6, "{present:?}: {found:?}");
        }
    }

    #[test]
    fn a_half_turn_keeps_its_sign_only_where_it_prints_the_same() {
        let back = |x: f64, beyond: f64| {
            let rotation = Rotation::from_rzryrx([0.0, 0.0, x * DEG]);
            nearest_angles(&rotation, [180.0, 0.0, 0.0], beyond)[0]
        };
        assert!((back(-179.9997, 0.0005) - 180.0003).abs() < 1e-9);
        assert!((back(-179.99, 0.0005) + 179.99).abs() < 1e-9);
        assert!((back(-179.9997, 0.0) + 179.9997).abs() < 1e-9);
    }
}
