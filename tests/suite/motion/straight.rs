//! Straight moves, walked by an independent inverse along the path between fake targets: the real tool must end where it is wanted.
//!
//! Nothing here is the product's but the program that it writes: kinematics are those of `rs-opw-kinematics`, the real arm is that
//! of `tests/physics`, rotations are nalgebra's.

use crate::physics::{Fault, Moment, Robot, matrix, tool_pose};
use crate::support::repository;
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use poseshift::compensate::{Given, Options, compensate};
use poseshift::geometry::Pose;
use poseshift::model::profile::{Mounted, Profile};
use poseshift::program::{self, Source};
use rand::{RngExt, SeedableRng};
use rs_opw_kinematics::glam::{DMat3, DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use rs_opw_kinematics::pose::Pose as PeerPose;

/// Moves of each language.
const CASES: usize = 100;
/// Steps in which a path is walked.
const STEPS: usize = 400;
/// Decimals of the file (0.0005 mm, 0.0005 deg at some 0.1 m from the last axes) and second-order terms of the two models.
const TOLERANCE_M: f64 = 4e-6;
/// Rates nearer to zero than this at the end (rad/m) are left out: which way such a joint comes is a matter of rounding.
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

/// The nominal IRB 120 in modified Denavit-Hartenberg rows (alpha, a, beta, theta, d), without masses.
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

    /// The joints at the end of a straight path and their rates there (rad/m); `None` where a joint leaps or the path
    /// leaves the reach, the limits, or comes near a singularity.
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

/// A random straight move with its start in joints; turned by 60 to 130 degrees, or by little where joints turn back.
fn random_move(
    random: &mut impl rand::Rng,
    peer: &Peer,
    turned: bool,
) -> Option<([f64; 6], At, At)> {
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
    clear.then_some((start, from, to))
}

/// One way to write a joint move and a straight move, and to read the straight move's numbers again.
struct Form {
    file: &'static str,
    program: fn(&[f64; 6], &At) -> String,
    read: fn(&str) -> At,
}

/// Numbers in a text, in their order.
fn numbers(text: &str) -> Vec<f64> {
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E');
    text.split(|c| !is_part(c))
        .filter_map(|word| word.parse().ok())
        .collect()
}

fn line_with<'a>(text: &'a str, word: &str) -> &'a str {
    text.lines()
        .find(|line| line.contains(word))
        .expect("the straight move")
}

/// Angles about z, y, x in degrees.
fn zyx(rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let (x, y, z) = rotation.euler_angles();
    [z, y, x].map(f64::to_degrees)
}

fn from_zyx([z, y, x]: [f64; 3]) -> UnitQuaternion<f64> {
    let [z, y, x] = [z, y, x].map(f64::to_radians);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_euler_angles(x, y, z))
}

fn mm(at: &At) -> [f64; 3] {
    [
        at.position.x * 1e3,
        at.position.y * 1e3,
        at.position.z * 1e3,
    ]
}

fn metres(n: &[f64]) -> Vector3<f64> {
    Vector3::new(n[0], n[1], n[2]) * 1e-3
}

const FORMS: [Form; 5] = [
    Form {
        file: "t.mod",
        program: |q, at| {
            let [a, b, c, d, e, f] = q.map(f64::to_degrees);
            let [x, y, z] = mm(at);
            let r = at.rotation.quaternion();
            format!(
                "MODULE t\nPROC main()\nConfL\\Off;\nMoveAbsJ [[{a:.9},{b:.9},{c:.9},{d:.9},{e:.9},{f:.9}],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n\
                 MoveL [[{x:.6},{y:.6},{z:.6}],[{:.10},{:.10},{:.10},{:.10}],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nENDPROC\nENDMODULE\n",
                r.w, r.i, r.j, r.k
            )
        },
        read: |text| {
            let n = numbers(
                line_with(text, "MoveL")
                    .split_once("[[")
                    .expect("a target")
                    .1,
            );
            let r = nalgebra::Quaternion::new(n[3], n[4], n[5], n[6]);
            At {
                position: metres(&n),
                rotation: UnitQuaternion::from_quaternion(r),
            }
        },
    },
    Form {
        file: "t.src",
        program: |q, at| {
            let [a, b, c, d, e, f] = q.map(f64::to_degrees);
            let [x, y, z] = mm(at);
            let [rz, ry, rx] = zyx(&at.rotation);
            format!(
                "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nPTP {{A1 {a:.9},A2 {b:.9},A3 {c:.9},A4 {d:.9},A5 {e:.9},A6 {f:.9}}}\n\
                 LIN {{X {x:.6},Y {y:.6},Z {z:.6},A {rz:.8},B {ry:.8},C {rx:.8}}}\nEND\n"
            )
        },
        read: |text| {
            let line = line_with(text, "LIN ");
            let value = |key: &str| {
                let at = line.find(key).expect("a component") + key.len();
                numbers(&line[at..])[0]
            };
            let n = ["X ", "Y ", "Z ", "A ", "B ", "C "].map(value);
            At {
                position: metres(&n),
                rotation: from_zyx([n[3], n[4], n[5]]),
            }
        },
    },
    Form {
        file: "t.ls",
        program: |q, at| {
            let [a, b, c, d, e, f] = q.map(f64::to_degrees);
            let [x, y, z] = mm(at);
            let [r, p, w] = zyx(&at.rotation);
            format!(
                "/PROG  T\n/ATTR\nOWNER = MNEDITOR;\n/MN\n   1:  UFRAME_NUM=0 ;\n   2:  UTOOL_NUM=0 ;\n   3:J P[1] 100% FINE    ;\n   4:L P[2] 100mm/sec FINE    ;\n/POS\n\
                 P[1]{{\n   GP1:\n\tUF : 0, UT : 0,\t\n\tJ1= {a:.9} deg,\tJ2= {b:.9} deg,\tJ3= {c:.9} deg,\n\tJ4= {d:.9} deg,\tJ5= {e:.9} deg,\tJ6= {f:.9} deg\n}};\n\
                 P[2]{{\n   GP1:\n\tUF : 0, UT : 0,\t\tCONFIG : '',\n\tX = {x:.6}  mm,\tY = {y:.6}  mm,\tZ = {z:.6}  mm,\n\tW = {w:.8} deg,\tP = {p:.8} deg,\tR = {r:.8} deg\n}};\n/END\n"
            )
        },
        read: |text| {
            let block = text.split_once("P[2]{").expect("the point").1;
            let n = numbers(block.split_once("X =").expect("its coordinates").1);
            At {
                position: metres(&n),
                rotation: from_zyx([n[5], n[4], n[3]]),
            }
        },
    },
    Form {
        file: "t.script",
        program: |q, at| {
            let [a, b, c, d, e, f] = *q;
            let [x, y, z] = [at.position.x, at.position.y, at.position.z];
            let v = at.rotation.scaled_axis();
            format!(
                "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  movej([{a:.11},{b:.11},{c:.11},{d:.11},{e:.11},{f:.11}])\n  movel(p[{x:.9},{y:.9},{z:.9},{:.10},{:.10},{:.10}])\nend\nt()\n",
                v.x, v.y, v.z
            )
        },
        read: |text| {
            let n = numbers(
                line_with(text, "movel(p[")
                    .split_once("p[")
                    .expect("a pose")
                    .1,
            );
            At {
                position: Vector3::new(n[0], n[1], n[2]),
                rotation: UnitQuaternion::from_scaled_axis(Vector3::new(n[3], n[4], n[5])),
            }
        },
    },
    Form {
        file: "t.jbi",
        program: |q, at| {
            let [a, b, c, d, e, f] = q.map(f64::to_degrees);
            let [x, y, z] = mm(at);
            let [rz, ry, rx] = zyx(&at.rotation);
            format!(
                "/JOB\n//NAME T\n//POS\n///NPOS 2,0,0,0,0,0\n///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\nC00000={a:.9},{b:.9},{c:.9},{d:.9},{e:.9},{f:.9}\n\
                 ///POSTYPE BASE\n///RECTAN\n///RCONF 0,0,0,0,0,0,0,0\nC00001={x:.6},{y:.6},{z:.6},{rx:.8},{ry:.8},{rz:.8}\n//INST\n///DATE 2024/03/02 09:15\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\nMOVJ C00000 VJ=20.00\nMOVL C00001 V=100.0\nEND\n"
            )
        },
        read: |text| {
            let n = numbers(
                line_with(text, "C00001=")
                    .split_once('=')
                    .expect("a position")
                    .1,
            );
            At {
                position: metres(&n),
                rotation: from_zyx([n[5], n[4], n[3]]),
            }
        },
    },
];

#[test]
fn straight_moves_land_in_every_language_walked_by_an_independent_inverse() {
    let text = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("a profile");
    let plain = &text[..text.find("calibration:").expect("a list of effects")];
    let profile = Profile::from_yaml(&format!("{plain}{EFFECTS}")).expect("a profile");
    let mut given = Given::default();
    given.tools.insert(None, Mounted::flange());
    given.frames.insert(None, Pose::identity());
    let options = Options {
        given,
        ..Options::default()
    };
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
    for form in &FORMS {
        let mut random = rand::rngs::StdRng::seed_from_u64(20_261_122);
        let (mut landed, mut improved, mut turned_back) = (0, 0, 0);
        while landed < CASES {
            let Some((start, from, to)) = random_move(&mut random, &peer, landed % 2 == 0) else {
                continue;
            };
            let program = (form.program)(&start, &to);
            let wanted = (form.read)(&program);
            let source = [Source::new(form.file, program.clone().into_bytes())];
            let language = program::language_of(&source[0]).expect("a language");
            let mut done = compensate(language, &source, &profile, &options)
                .unwrap_or_else(|error| panic!("{error}\n{program}"));
            assert!(!done.is_refused(), "{:?}\n{program}", done.findings);
            let written =
                String::from_utf8(done.edits.remove(0).apply(&source[0].bytes)).expect("text");
            let fake = (form.read)(&written);
            let ends = |to: &At| {
                let (q, rates) = peer.walk(&from, to, &start)?;
                if rates[..3].iter().any(|rate| rate.abs() < 0.5 * CLEAR_RATE) {
                    return None;
                }
                let moment = Moment {
                    direction: rates.map(f64::signum),
                    ..Moment::default()
                };
                let m = tool_pose(&robot, &faults, &q, &moment);
                let real = Vector3::new(m[0][3], m[1][3], m[2][3]);
                let by = (0..3).any(|i| (q[i] - start[i]).signum() != rates[i].signum());
                Some(((real - wanted.position).norm(), by))
            };
            let (Some((miss, by)), Some((before, _))) = (ends(&fake), ends(&wanted)) else {
                continue;
            };
            assert!(
                miss < TOLERANCE_M,
                "{}: {:.4} mm off (before {:.4})\n{program}\n{written}",
                form.file,
                miss * 1e3,
                before * 1e3
            );
            landed += 1;
            improved += usize::from(before > 1e-4);
            turned_back += usize::from(by);
        }
        assert!(improved > CASES / 2, "{}: {improved}", form.file);
        assert!(
            turned_back > CASES / 20,
            "{}: {turned_back} with a joint that turns back",
            form.file
        );
    }
}

#[test]
fn bounds_hold_where_a_joint_turns_back_on_the_way() {
    // the bound of the path's error is for both sides from which a joint comes on it
    let text = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("a profile");
    let plain = &text[..text.find("calibration:").expect("a list of effects")];
    let profile = Profile::from_yaml(&format!("{plain}{EFFECTS}")).expect("a profile");
    let (peer, robot, faults) = (Peer::new(), robot(), faults());
    let form = &FORMS[0];
    let mut random = rand::rngs::StdRng::seed_from_u64(7);
    let (mut seen, mut wider, mut tight) = (0, 0, 0);
    while seen < 40 {
        let Some((start, from, to)) = random_move(&mut random, &peer, false) else {
            continue;
        };
        let program = (form.program)(&start, &to);
        let to = (form.read)(&program);
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
        let sources = [Source::new(form.file, program.into_bytes())];
        let scene = poseshift::check::Scene::default();
        let subject = poseshift::check::Subject {
            language: program::language_of(&sources[0]).expect("a language"),
            sources: &sources,
            nominal: None,
            profile: &profile,
            scene: &scene,
        };
        let options = super::given();
        let options = poseshift::check::Options {
            given: options.given,
            ..poseshift::check::Options::default()
        };
        let checked = poseshift::check::check(&subject, &options).expect("checked");
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
