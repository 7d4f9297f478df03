//! Straight moves, walked by an independent inverse along the path between fake targets: the real
//! tool must end where it is wanted.
//!
//! Nothing here is the product's but the program that it writes: kinematics are those of
//! `rs-opw-kinematics`, the real arm is that of `tests/physics`, rotations are nalgebra's.

mod above;
mod forms;

use super::{checked, given};
use crate::physics::{Fault, Moment, Robot, matrix, tool_pose};
use crate::support::repository;
use forms::FORMS;
use nalgebra::{UnitQuaternion, Vector3};
use poseshift::compensate::compensate;
use poseshift::model::profile::Profile;
use poseshift::program::{self, Source};
use rand::{RngExt, SeedableRng};
use rs_opw_kinematics::glam::{DMat3, DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use rs_opw_kinematics::pose::Pose as PeerPose;

/// Moves that land in each language.
const CASES: usize = 500;
/// Moves that are tried: on some a joint nearly stands at the end of the path between fake targets,
/// and these are left out.
const TRIED: usize = CASES + 20;
/// Steps in which a path is walked.
const STEPS: usize = 400;
/// Decimals of the file (0.0005 mm, 0.0005 deg at some 0.1 m from the last axes) and second-order
/// terms of the two models.
const TOLERANCE_M: f64 = 4e-6;
/// Rates nearer to zero than this at the end (rad/m) are left out: which way such a joint comes is
/// a matter of rounding.
const CLEAR_RATE: f64 = 0.01;

/// Backlash of joints 1 to 3 and an error of link 3: degrees and millimetres.
const EFFECTS: &str = "calibration:
  effects:
    - {effect: backlash, joint: 1, width_deg: 0.06}
    - {effect: backlash, joint: 2, width_deg: -0.1}
    - {effect: backlash, joint: 3, width_deg: 0.08}
    - {effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}
";

fn faults() -> Vec<Fault> {
    let degrees = f64::to_radians;
    vec![
        Fault::Backlash(0, degrees(0.06)),
        Fault::Backlash(1, degrees(-0.1)),
        Fault::Backlash(2, degrees(0.08)),
        Fault::Link(2, [0.0, 0.3e-3, 0.0, degrees(0.1), 0.0]),
    ]
}

/// The IRB 120 with these effects.
fn profile() -> Profile {
    let text = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("a profile");
    let plain = &text[..text.find("calibration:").expect("a list of effects")];
    Profile::from_yaml(&format!("{plain}{EFFECTS}")).expect("a profile")
}

/// The nominal IRB 120 in modified Denavit-Hartenberg rows (alpha, a, beta, theta, d), without
/// masses.
fn robot() -> Robot {
    let quarter = std::f64::consts::FRAC_PI_2;
    Robot {
        base: matrix::shift([0.0; 3]),
        rows: [
            [0.0, 0.0, 0.0, 0.0, 0.29],
            [-quarter, 0.0, 0.0, -quarter, 0.0],
            [0.0, 0.27, 0.0, 0.0, 0.0],
            [-quarter, 0.07, 0.0, 0.0, 0.302],
            [quarter, 0.0, 0.0, 0.0, 0.0],
            [-quarter, 0.0, 0.0, 2.0 * quarter, 0.072],
        ],
        sign: [1.0; 6],
        offset: [0.0; 6],
        counted: Vec::new(),
        flange: matrix::shift([0.0; 3]),
        tool: matrix::shift([0.0; 3]),
        masses: Vec::new(),
        load: (0.0, [0.0; 3]),
        gravity: [0.0; 3],
    }
}

/// A place of the tool.
#[derive(Clone, Copy, Debug)]
struct At {
    position: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
}

impl At {
    fn between(&self, to: &Self, s: f64) -> Self {
        Self {
            position: self.position.lerp(&to.position, s),
            rotation: self.rotation.slerp(&to.rotation, s),
        }
    }
}

struct Peer(OPWKinematics);

impl Peer {
    fn new() -> Self {
        Self(OPWKinematics::new(Parameters::irb120_3_58()))
    }

    fn forward(&self, q: &[f64; 6]) -> At {
        let pose = self.0.forward(q);
        let (t, r) = (pose.translation, pose.rotation);
        At {
            position: Vector3::new(t.x, t.y, t.z),
            rotation: UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(
                r.w, r.x, r.y, r.z,
            )),
        }
    }

    /// The joints nearest to others.
    fn inverse(&self, at: &At, near: &[f64; 6]) -> Option<[f64; 6]> {
        let m = at.rotation.to_rotation_matrix();
        let column = |j: usize| DVec3::new(m[(0, j)], m[(1, j)], m[(2, j)]);
        let rotation = DQuat::from_mat3(&DMat3::from_cols(column(0), column(1), column(2)));
        let position = DVec3::new(at.position.x, at.position.y, at.position.z);
        let turn = std::f64::consts::TAU;
        let nearest = |q: [f64; 6]| -> [f64; 6] {
            std::array::from_fn(|i| q[i] + turn * ((near[i] - q[i]) / turn).round())
        };
        let far = |q: &[f64; 6]| (0..6).map(|i| (q[i] - near[i]).abs()).fold(0.0, f64::max);
        let all = self.0.inverse(&PeerPose::from_parts(position, rotation));
        let all = all.into_iter().map(nearest);
        all.min_by(|a, b| far(a).total_cmp(&far(b)))
    }

    /// The joints at the end of a straight path and their rates there (rad/m); `None` where a joint
    /// leaps or the path leaves the reach, the limits, or comes near a singularity.
    fn walk(&self, from: &At, to: &At, start: &[f64; 6]) -> Option<([f64; 6], [f64; 6])> {
        let limits = [165.0, 110.0, 70.0, 160.0, 120.0, 400.0_f64].map(f64::to_radians);
        let mut q = *start;
        for step in 1..=STEPS {
            let s = step as f64 / STEPS as f64;
            let next = self.inverse(&from.between(to, s), &q)?;
            let leap = (0..6).map(|i| (next[i] - q[i]).abs()).fold(0.0, f64::max);
            let inside = (0..6).all(|i| next[i].abs() < limits[i] - 0.05);
            if leap > 0.12 || !inside || next[4].abs() < 0.2 {
                return None;
            }
            // the wrist centre stays clear of axis 1, the elbow of the straight arm
            let elbow = next[2] + (0.07_f64).atan2(0.302);
            let wrist = from.between(to, s);
            let centre = wrist.position - wrist.rotation * Vector3::new(0.072, 0.0, 0.0);
            let clear =
                centre.x.hypot(centre.y) > 0.1 && (elbow - std::f64::consts::FRAC_PI_2).abs() > 0.2;
            if !clear {
                return None;
            }
            q = next;
        }
        let length = (to.position - from.position).norm() + from.rotation.angle_to(&to.rotation);
        let back = 1e-5;
        let before = self.inverse(&from.between(to, 1.0 - back), &q)?;
        Some((
            q,
            std::array::from_fn(|i| (q[i] - before[i]) / (back * length)),
        ))
    }
}

/// A straight move behind a joint move.
#[derive(Clone, Copy)]
struct Case {
    start: [f64; 6],
    from: At,
    to: At,
}

impl Case {
    /// A random one; rotated by 60 to 130 degrees, or by little where joints turn back.
    fn random(random: &mut impl rand::Rng, peer: &Peer, turned: bool) -> Option<Self> {
        let ranges = [100.0, 50.0, 40.0, 110.0, 80.0, 150.0_f64];
        let start: [f64; 6] =
            std::array::from_fn(|i| (ranges[i] * random.random_range(-1.0..1.0)).to_radians());
        let from = peer.forward(&start);
        let mut unit = || {
            let v = Vector3::from_fn(|_, _| random.random_range(-1.0..1.0));
            nalgebra::Unit::try_new(v, 1e-3)
        };
        let (axis, along) = (unit()?, unit()?);
        let (angle, distance) = if turned {
            (
                random.random_range(60.0..130.0_f64),
                random.random_range(0.02..0.3),
            )
        } else {
            (
                random.random_range(0.0..15.0_f64),
                random.random_range(0.15..0.5),
            )
        };
        // the numbers of the file are those that are wanted
        let round = |v: f64| (v * 1e6).round() / 1e6;
        let to = At {
            position: (from.position + along.into_inner() * distance).map(round),
            rotation: UnitQuaternion::from_axis_angle(&axis, angle.to_radians()) * from.rotation,
        };
        let (_, rates) = peer.walk(&from, &to, &start)?;
        let clear = rates[..3].iter().all(|rate| rate.abs() > CLEAR_RATE);
        clear.then_some(Self { start, from, to })
    }

    /// The solution of the inverse that the start is, as CSV has it: 4 behind axis 1, 1 joint 5
    /// negative. The elbow never bends the other way: the wrist is not behind the lower arm.
    fn branch(&self) -> u8 {
        let centre = self.from.position - self.from.rotation * Vector3::new(0.072, 0.0, 0.0);
        let ahead = centre.x * self.start[0].cos() + centre.y * self.start[0].sin();
        4 * u8::from(ahead < 0.0) + u8::from(self.start[4] < 0.0)
    }
}

#[test]
fn straight_moves_land_in_every_language_walked_by_an_independent_inverse() {
    let profile = profile();
    let options = given();
    let (peer, robot, faults) = (Peer::new(), robot(), faults());
    let gap = peer.forward(&[0.1, 0.2, -0.3, 0.4, 0.5, 0.6]).position - {
        let m = tool_pose(
            &robot,
            &[],
            &[0.1, 0.2, -0.3, 0.4, 0.5, 0.6],
            &Moment::default(),
        );
        Vector3::new(m[0][3], m[1][3], m[2][3])
    };
    assert!(gap.norm() < 1e-9, "the two nominal arms are one: {gap}");
    let mut random = rand::rngs::StdRng::seed_from_u64(20_261_122);
    let mut cases = Vec::with_capacity(TRIED);
    while cases.len() < TRIED {
        cases.extend(Case::random(&mut random, &peer, cases.len() % 2 == 0));
    }
    // where the real tool ends, and whether a joint turned back on the way
    let end = |from: &At, to: &At, start: &[f64; 6]| {
        let (q, rates) = peer.walk(from, to, start)?;
        if rates[..3].iter().any(|rate| rate.abs() < 0.5 * CLEAR_RATE) {
            return None;
        }
        let moment = Moment {
            direction: rates.map(f64::signum),
            ..Moment::default()
        };
        let m = tool_pose(&robot, &faults, &q, &moment);
        let by = (0..3).any(|i| (q[i] - start[i]).signum() != rates[i].signum());
        Some((Vector3::new(m[0][3], m[1][3], m[2][3]), by))
    };
    let before: Vec<_> = cases
        .iter()
        .map(|case| end(&case.from, &case.to, &case.start))
        .collect();
    for form in &FORMS {
        let files = (form.files)(&cases);
        let name = &files[0].name;
        let wanted = (form.read)(&files);
        let language = program::language_of(&files[0]).expect("a language");
        let done = compensate(language, &files, &profile, &options)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(!done.is_refused(), "{name}: {:?}", done.findings);
        let written: Vec<Source> = files
            .iter()
            .zip(&done.edits)
            .map(|(file, edits)| Source::new(file.name.clone(), edits.apply(&file.bytes)))
            .collect();
        let fakes = (form.read)(&written);
        assert_eq!((wanted.len(), fakes.len()), (TRIED, TRIED), "{name}");
        let (mut landed, mut improved, mut turned_back) = (0, 0, 0);
        for (at, case) in cases.iter().enumerate() {
            let (wanted, (from, fake)) = (&wanted[at].1, &fakes[at]);
            let (from, start) = match from {
                Some(from) => (*from, peer.inverse(from, &case.start)),
                None => (case.from, Some(case.start)),
            };
            let start = start.expect("the start is in reach");
            let (Some((real, by)), Some((uncorrected, _))) = (end(&from, fake, &start), before[at])
            else {
                continue;
            };
            let miss = (real - wanted.position).norm();
            let uncorrected = (uncorrected - wanted.position).norm();
            assert!(
                miss < TOLERANCE_M,
                "{name}: move {at} from {:?} to {wanted:?} goes to {fake:?} and is {:.4} mm off \
                 (before {:.4})",
                case.start,
                miss * 1e3,
                uncorrected * 1e3
            );
            landed += 1;
            improved += usize::from(uncorrected > 1e-4);
            turned_back += usize::from(by);
        }
        assert!(landed >= CASES, "{name}: {landed} could be followed");
        assert!(improved > CASES / 2, "{name}: {improved}");
        assert!(
            turned_back > CASES / 20,
            "{name}: {turned_back} with a joint that turns back"
        );
    }
}

#[test]
fn bounds_hold_where_a_joint_turns_back_on_the_way() {
    // the bound of the path's error is for both sides from which a joint comes on it
    let profile = profile();
    let (peer, robot, faults) = (Peer::new(), robot(), faults());
    let form = &FORMS[0];
    let mut random = rand::rngs::StdRng::seed_from_u64(7);
    let (mut seen, mut wider, mut tight) = (0, 0, 0);
    while seen < 40 {
        let Some(case) = Case::random(&mut random, &peer, false) else {
            continue;
        };
        let sources = (form.files)(&[case]);
        let (start, from, to) = (case.start, case.from, (form.read)(&sources)[0].1);
        // the largest error on the way, each joint from the side from which it comes there
        let (mut near, mut turns_back) = (start, false);
        let (mut largest, mut at_end_sides, mut any_side) = (0.0_f64, 0.0_f64, 0.0_f64);
        let Some((_, last)) = peer.walk(&from, &to, &start) else {
            continue;
        };
        for step in 0..1000 {
            let s = |k: f64| (f64::from(step) + k) / 1000.0;
            let here = peer
                .inverse(&from.between(&to, s(0.5)), &near)
                .expect("on the way");
            let [before, after] = [0.4, 0.6].map(|k| {
                peer.inverse(&from.between(&to, s(k)), &here)
                    .expect("there")
            });
            let direction: [f64; 6] = std::array::from_fn(|i| (after[i] - before[i]).signum());
            turns_back |= (0..3).any(|i| direction[i] != last[i].signum());
            let wanted = from.between(&to, s(0.5)).position;
            let error = |direction: [f64; 6]| {
                let moment = Moment {
                    direction,
                    ..Moment::default()
                };
                let m = tool_pose(&robot, &faults, &here, &moment);
                (Vector3::new(m[0][3], m[1][3], m[2][3]) - wanted).norm()
            };
            largest = largest.max(error(direction));
            at_end_sides = at_end_sides.max(error(last.map(f64::signum)));
            for sides in 0..8 {
                let side = |i: usize| if sides >> i & 1 == 1 { 1.0 } else { -1.0 };
                any_side = any_side.max(error([side(0), side(1), side(2), 0.0, 0.0, 0.0]));
            }
            near = here;
        }
        if !turns_back {
            continue;
        }
        let checked = checked(&profile, &sources, None);
        let path = checked.moves[1].path.expect("a path");
        assert!(path.certified);
        let bound = path.bound.distance_m;
        assert!(bound > largest - 1e-7, "{bound} is no bound of {largest}");
        // where two joints turn back in one piece, both sides of both are looked at
        assert!(
            bound < 1.02 * any_side + 2e-5,
            "{bound} is beyond any side: {any_side}"
        );
        tight += usize::from(bound < 1.05 * largest + 2e-5);
        seen += 1;
        wider += usize::from(largest > at_end_sides + 1e-5);
    }
    assert!(
        tight > 30,
        "{tight} of {seen} bounds are near the largest error"
    );
    assert!(
        wider > 3,
        "{wider} of {seen} are worse on the way than with the sides of the end"
    );
}
