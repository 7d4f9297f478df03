//! Effects in sentences that a person understands.

use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, norm, sub};
use crate::model::JOINTS;
use crate::model::effects::{BASE, Effect, Kind};

fn digits(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (0.01..1000.0).contains(&size) {
        format!("{value:.3}")
    } else {
        format!("{value:.1e}")
    }
}

/// An effect in one sentence a person understands; the robot stands at `base_m` in the world.
#[must_use]
pub(super) fn sentence(effect: &Effect, base_m: Vector) -> String {
    let (p, site) = (&effect.parameters, &effect.site);
    let joint = format!("J{}", site.index + 1);
    let axis = format!("external axis {}", site.index + 1);
    let deg = |value: f64| digits(value / DEG);
    let mm = |value: f64| digits(mm_from_m(value));
    let length = |x: &[f64]| x.iter().map(|v| v * v).sum::<f64>().sqrt();
    let text = match effect.kind {
        Kind::BaseFrame => format!(
            "The base stands {} mm from where the profile has it and rotated by {}°",
            mm(length(&p[..3])),
            deg(length(&p[3..]))
        ),
        Kind::ToolFrame => format!(
            "The tool's tip is {} mm from where the profile has it",
            mm(length(&p[..3]))
        ),
        Kind::LinkGeometry => format!("Link {} differs from the profile", site.index + 1),
        Kind::JointScale => format!("{joint} rotates {}° too far in 90°", deg(p[0] * 90.0 * DEG)),
        Kind::JointCompliance => {
            format!("{joint} yields by {}° under 100 N m", deg(100.0 * p[0]))
        }
        Kind::JointHarmonic => format!(
            "{joint} runs fast and slow by {}°, {} times a revolution (eccentric gear or encoder)",
            deg(length(&p[..2])),
            site.periods()
        ),
        Kind::JointCoupling => format!(
            "{joint} is taken along by J{}: {}° in 90°",
            site.on + 1,
            deg(p[0] * 90.0 * DEG)
        ),
        Kind::Backlash if p[0] < 0.0 => {
            format!("{joint} loses {}° when it reverses", deg(-p[0]))
        }
        Kind::Backlash => format!("{joint} runs {}° ahead when it reverses", deg(p[0])),
        Kind::PayloadError => format!(
            "The load on the flange is {} kg heavier than the profile says, its centre of gravity \
             {} mm elsewhere",
            digits(p[0]),
            mm(length(&p[1..4]))
        ),
        Kind::ComplianceKnee => format!(
            "{joint} is soft near zero load: {}° more up to {} N m",
            deg(p[0] * p[1]),
            digits(p[0])
        ),
        Kind::LinkCompliance => format!(
            "Link {} bends: {}° under 100 N m",
            site.index + 1,
            deg(100.0 * length(&p[..2]))
        ),
        Kind::BaseCompliance => format!(
            "The pedestal tilts: {}° under 100 N m",
            deg(100.0 * length(&p[..2]))
        ),
        Kind::ThermalGrowth => format!(
            "The arm grows with temperature: {} mm a metre in 10 K",
            mm(10.0 * p[0])
        ),
        Kind::WarmUpDrift if site.index == BASE => format!(
            "The base drifts by {} mm while it warms up, in some {:.0} min",
            mm(length(&p[1..4])),
            p[4] / 60.0
        ),
        Kind::WarmUpDrift => format!(
            "{joint} drifts by {}° while it warms up, in some {:.0} min",
            deg(p[0]),
            p[4] / 60.0
        ),
        Kind::SessionDrift => format!(
            "{} drifts by {} in the course of the session, most of it in {:.0} rows",
            if site.index == BASE {
                "The base or the measuring device".to_owned()
            } else {
                joint
            },
            if site.index == BASE {
                mm(length(&p[1..4])) + " mm"
            } else {
                deg(p[0]) + "°"
            },
            p[4]
        ),
        Kind::Settling => format!(
            "{joint} is read before it rests: {} % of its last move {}",
            digits(100.0 * p[0].abs()),
            if p[0] < 0.0 { "too far" } else { "is missing" }
        ),
        Kind::FrictionBacklash => format!(
            "{joint} {} {}° under 100 N m by the side it comes from",
            if p[0] < 0.0 {
                "is held back"
            } else {
                "runs ahead"
            },
            deg(100.0 * p[0].abs())
        ),
        Kind::ToolCompliance => format!(
            "The tool bends at the flange: {}° under 10 N m",
            deg(10.0 * length(&p[..2]))
        ),
        Kind::MeasurementScale => format!(
            "The measuring device's lengths are {} ppm too {}",
            digits(1e6 * p[0].abs()),
            if p[0] < 0.0 { "short" } else { "long" }
        ),
        Kind::FrameShift => format!(
            "The measuring device or the base moved before row {} by {} mm where the robot stands",
            site.order,
            // a rotation about the device far away moves it by the lever
            mm(norm(sub(
                Pose::from_xyz_rxryrz(*p).transform(base_m),
                base_m
            )))
        ),
        Kind::ToolSlip => format!(
            "The tool or the reflector slipped before row {} by {} mm",
            site.order,
            mm(length(&p[..3]))
        ),
        Kind::TrackScale => format!("{axis} goes {} mm too far in a metre", mm(p[0])),
        Kind::TrackDirection => format!(
            "{axis} runs {}° off the direction of the profile",
            deg(length(&p[..2]))
        ),
        Kind::TrackStraightness => format!("{axis} is bent by {} mm at its ends", mm(p[0])),
        Kind::TrackRipple => format!(
            "The error of {axis} repeats every {} mm, by {} mm",
            mm(site.period_m()),
            mm(length(&p[..2]))
        ),
        Kind::TrackRotation => format!(
            "The carriage of {axis} rotates by {}° to its ends",
            deg(p[0])
        ),
        Kind::TrackBacklash => format!("{axis} loses {} mm when it reverses", mm(p[0])),
        Kind::PositionerAxis => format!(
            "{axis} is {} mm and {}° from where the profile has it",
            mm(length(&p[..2])),
            deg(length(&p[2..4]))
        ),
        Kind::PositionerZero => format!("{axis} has its zero {}° elsewhere", deg(p[0])),
        Kind::PositionerScale => {
            format!("{axis} rotates {}° too far in 90°", deg(p[0] * 90.0 * DEG))
        }
        Kind::PositionerRipple => format!(
            "{axis} runs fast and slow by {}°, {} times a revolution",
            deg(length(&p[..2])),
            site.periods()
        ),
        Kind::PositionerRunout => format!(
            "{axis} wobbles by {} mm, {} times a revolution",
            mm(length(&p[..2])),
            site.periods()
        ),
        Kind::PositionerPlate => format!(
            "The plate on {axis} sits {} mm and {}° from where the profile has it",
            mm(length(&p[..3])),
            deg(length(&p[3..]))
        ),
    };
    debug_assert!(site.index <= JOINTS || effect.definition().of_external_axis());
    format!("{text} ({}).", effect.definition().id)
}
