//! The product's effects in the words of the independent physics, and faults the product does not
//! know.

use crate::physics::{Fault, Mass, Robot, matrix};
use poseshift::geometry::Pose;
use poseshift::model::effects::{BASE, Effect, Kind};
use poseshift::model::profile::{Mounted, Profile};

/// A pose as a matrix.
pub fn matrix_of(pose: &Pose) -> matrix::M4 {
    let (r, t) = (pose.rotation.0, pose.translation);
    [
        [r[0][0], r[0][1], r[0][2], t[0]],
        [r[1][0], r[1][1], r[1][2], t[1]],
        [r[2][0], r[2][1], r[2][2], t[2]],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

/// A profile's numbers, without its effects.
pub fn robot_of(profile: &Profile, tool: &Mounted) -> Robot {
    let masses = profile.bodies.iter().map(|b| Mass {
        link: b.link,
        kg: b.mass_kg,
        cog: b.cog_m,
    });
    Robot {
        base: matrix_of(&profile.world_from_base),
        rows: profile
            .links
            .map(|l| [l.alpha_rad, l.a_m, l.beta_rad, l.theta_rad, l.d_m]),
        sign: profile.mechanism.joints.map(|j| j.sign),
        offset: profile.mechanism.joints.map(|j| j.offset_rad),
        counted: profile
            .mechanism
            .coupling
            .iter()
            .map(|c| (c.joint, c.on, c.ratio))
            .collect(),
        flange: matrix_of(&profile.link6_from_flange),
        tool: matrix_of(&tool.flange_from_tool),
        masses: masses.collect(),
        load: tool.load.unwrap_or_default(),
        gravity: profile.gravity_m_s2,
    }
}

/// An effect as a fault.
pub fn faults(effect: &Effect) -> Fault {
    let (p, s) = (&effect.parameters, &effect.site);
    let (i, row) = (s.index, s.order as usize);
    match effect.kind {
        Kind::BaseFrame => Fault::Base(*p),
        Kind::ToolFrame => Fault::Tool(*p),
        Kind::LinkGeometry => Fault::Link(i, [p[0], p[1], p[2], p[3], p[4]]),
        Kind::JointScale => Fault::Scale(i, p[0]),
        Kind::JointCompliance => Fault::Compliance(i, p[0]),
        Kind::JointHarmonic => Fault::Harmonic(i, f64::from(s.order) / 1000.0, p[0], p[1]),
        Kind::JointCoupling => Fault::Leak(i, s.on, p[0]),
        Kind::Backlash => Fault::Backlash(i, p[0]),
        Kind::PayloadError => Fault::Payload(p[0], [p[1], p[2], p[3]]),
        Kind::ComplianceKnee => Fault::Knee(i, p[0], p[1]),
        Kind::LinkCompliance => Fault::Bending(i, p[0], p[1]),
        Kind::BaseCompliance => Fault::Pedestal(p[0], p[1]),
        Kind::ThermalGrowth => Fault::Growth(p[0], p[1]),
        Kind::WarmUpDrift if i == BASE => Fault::BaseDrift([p[1], p[2], p[3]], p[4]),
        Kind::WarmUpDrift => Fault::JointDrift(i, p[0], p[4]),
        Kind::FrameShift => Fault::Shift(row, *p),
        Kind::ToolSlip => Fault::Slip(row, [p[0], p[1], p[2]]),
        Kind::ReflectorSlip => {
            Fault::Reflector(u32::try_from(i).expect("small"), row, [p[0], p[1], p[2]])
        }
        Kind::Settling => Fault::Unsettled(i, p[0]),
        Kind::FrictionBacklash => Fault::Friction(i, p[0]),
        Kind::ToolCompliance => Fault::Adapter(p[0], p[1]),
        Kind::MeasurementScale => Fault::Longer(p[0]),
        Kind::SessionDrift if i == BASE => Fault::BaseCreep([p[1], p[2], p[3]], p[4]),
        Kind::SessionDrift => Fault::JointCreep(i, p[0], p[4]),
        Kind::SessionGrowth => Fault::Lengthening(p[0], p[1]),
        other => unreachable!("{} is no effect of the arm", other.definition().id),
    }
}

type Make = fn(usize, f64) -> Fault;

/// Faults that no effect of the registry describes.
pub fn unregistered() -> Vec<(&'static str, Make)> {
    vec![
        ("square of the angle", |i, k| {
            Fault::Joint(i.max(1), SQUARES[i.max(1)], k)
        }),
        ("product of two angles", |_, k| {
            Fault::Joint(1, |u, _, _| u[1] * u[2], k)
        }),
        ("square of the torque", |_, k| {
            Fault::Joint(1, |_, t, _| t[1] * t[1].abs(), k)
        }),
        ("step of the encoder", |_, k| {
            Fault::Joint(2, |u, _, _| f64::from(u8::from(u[2] > 0.3)), k)
        }),
        ("harmonic of a half order", |_, k| {
            Fault::Joint(0, |u, _, _| (2.5 * u[0]).sin(), k)
        }),
        ("wave that is rectified", |_, k| {
            Fault::Joint(2, |u, _, _| (1.7 * u[2]).sin().abs(), k)
        }),
        ("oscillation in time", |_, k| {
            Fault::World(
                |_, _, at| [(at.time / 900.0).sin(), 0.0, 0.5 * (at.time / 900.0).cos()],
                k,
            )
        }),
        ("cable that pulls", |_, k| {
            Fault::Joint(0, |u, _, _| u[0].abs() * u[3].cos(), k)
        }),
        ("wrist that follows the elbow", |_, k| {
            Fault::Joint(4, |u, _, _| u[2].sin() * u[3].cos(), k)
        }),
        ("joint that warms by its temperature", |_, k| {
            Fault::Joint(2, |u, _, at| (at.temperature - 23.0) * u[2], k)
        }),
        ("device that refracts by distance", |_, k| {
            Fault::World(
                |pose, _, _| {
                    let d = (pose[0][3].powi(2) + pose[1][3].powi(2)).sqrt();
                    [pose[0][3] * d, pose[1][3] * d, 0.0]
                },
                k,
            )
        }),
        ("dead zone", |_, k| {
            Fault::Joint(3, |u, _, _| (u[3] - 0.5).max(0.0), k)
        }),
    ]
}

type Of = fn(&[f64; 6], &[f64; 6], &crate::physics::Moment) -> f64;

const SQUARES: [Of; 6] = [
    |u, _, _| u[0] * u[0],
    |u, _, _| u[1] * u[1],
    |u, _, _| u[2] * u[2],
    |u, _, _| u[3] * u[3],
    |u, _, _| u[4] * u[4],
    |u, _, _| u[5] * u[5],
];
