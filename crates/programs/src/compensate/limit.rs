//! How far a correction may shift a target: what the profile's effects usually do, with room.

use super::Job;
use super::approach::{Approach, Solved};
use super::rewrite::largest;
use crate::finding::{Finding, Severity};
use crate::geometry::Separation;
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::model::Conditions;
use crate::motion::ground::Ground;
use crate::motion::placed::bases;
use crate::motion::plausibility;
use crate::profile::{Mounted, Profile};
use std::sync::OnceLock;

/// Postures at which the effects are looked at, and which of them in order of size counts: 95 in
/// 100.
const POSTURES: usize = 1000;
const COUNTS: usize = 949;
/// The limit is so many times what the effects do there.
const TIMES: f64 = 10.0;
/// No limit is larger unless the user raises it.
pub(crate) const MOST: Separation = Separation {
    distance_m: 20.0 * MM,
    angle_rad: 2.0 * DEG,
};
/// Nor smaller: what does nothing at most postures may do this much at others.
const LEAST: Separation = Separation {
    distance_m: 0.1 * MM,
    angle_rad: 0.05 * DEG,
};
const SEED: u64 = 0x706f_7365_7368_6966;

/// What the effects do with each tool of the program, looked at when it is asked for.
pub(super) struct Limits {
    raised: Option<Separation>,
    of_tools: Vec<OnceLock<Separation>>,
}

/// Id of the finding of a correction that shifts its target too far.
const TOO_LARGE: &str = "shift-too-large";

impl Limits {
    /// Of a program; `raised` where the user says the limit.
    pub(super) fn new(ground: &Ground, raised: Option<Separation>) -> Self {
        Self {
            raised,
            of_tools: ground.arms.iter().map(|_| OnceLock::new()).collect(),
        }
    }

    /// The limit for targets with a tool.
    fn of(&self, ground: &Ground, tool: usize) -> Separation {
        self.raised
            .unwrap_or_else(|| *self.of_tools[tool].get_or_init(|| usual(ground, tool)))
    }

    /// The limit for targets with each tool, where one was asked for.
    pub(super) fn asked_for(&self) -> Vec<Option<Separation>> {
        let of_tools = self.of_tools.iter();
        of_tools
            .map(|limit| self.raised.or(limit.get().copied()))
            .collect()
    }

    /// The finding of a correction that shifts its target too far, which is not written, and the
    /// limit that would allow it. What to do is said once all are known: [`advise`].
    pub(super) fn judge(
        &self,
        job: &Job,
        approach: &Approach,
        shift: &Separation,
    ) -> Option<(Finding, Separation)> {
        let limit = self.of(&job.ground, approach.tool as usize);
        if shift.distance_m <= limit.distance_m && shift.angle_rad <= limit.angle_rad {
            return None;
        }
        let (shift_mm, shift_deg) = (mm_from_m(shift.distance_m), shift.angle_rad / DEG);
        let whence = match self.raised {
            Some(_) => "--max-shift",
            None => {
                "ten times what this profile's effects usually do with loads that it knows, at most 20 mm and 2 deg"
            }
        };
        let message = format!(
            "the correction shifts {} by {shift_mm:.3} mm and {shift_deg:.3} deg; the limit is \
             {:.3} mm and {:.3} deg ({whence})",
            job.ground.name_of(approach.target as usize),
            mm_from_m(limit.distance_m),
            limit.angle_rad / DEG,
        );
        let target = approach.target as usize;
        let finding = (job.ground).at_target(TOO_LARGE, Severity::Error, target, message, "");
        Some((finding, largest(*shift, limit)))
    }
}

/// Says which limit allows all corrections that shift their targets too far.
pub(super) fn advise(findings: &mut [Finding], needed: &Separation) {
    let asked = |needed: f64| (1.05 * needed * 10.0).ceil() / 10.0;
    let hint = format!(
        "check the effects of the profile and the tool's load; --max-shift {}mm,{}deg allows every \
         one",
        asked(mm_from_m(needed.distance_m)),
        asked(needed.angle_rad / DEG),
    );
    for finding in findings.iter_mut().filter(|of| of.id == TOO_LARGE) {
        finding.hint.clone_from(&hint);
    }
}

/// A tool with no more load than the profile knows: that of its heaviest tool, or the payload of the arm.
/// What the program says it weighs may be wrong, and is not what the limit is measured by.
fn with_known_load(profile: &Profile, tool: &Mounted) -> Mounted {
    let loads = profile.tools.values().filter_map(|tool| tool.load);
    let masses = loads.map(|(mass_kg, _)| mass_kg).chain(profile.payload_kg);
    let known_kg = masses.fold(0.0, f64::max);
    Mounted {
        load: tool.load.map(|(mass_kg, centre)| {
            let is_known = known_kg == 0.0 || mass_kg <= known_kg;
            (if is_known { mass_kg } else { known_kg }, centre)
        }),
        ..tool.clone()
    }
}

/// What the effects do at most postures with a tool, times ten.
fn usual(ground: &Ground, tool: usize) -> Separation {
    let equipped = ground.arm_with(tool);
    let mounted = ground.setting.tools[tool].as_ref();
    let known = mounted.map(|mounted| with_known_load(ground.profile, mounted));
    let lighter = known.filter(|known| Some(known) != mounted);
    let real = match &lighter {
        Some(known) => &ground
            .profile
            .real_model(known, &equipped.inverse.conditions),
        None => &equipped.inverse.real,
    };
    let mut random = Random(SEED);
    let joints = &ground.profile.mechanism.joints;
    let mut gaps: Vec<Separation> = Vec::with_capacity(POSTURES);
    for _ in 0..POSTURES {
        let q = std::array::from_fn(|i| {
            let (low, high) = (joints[i].min_rad, joints[i].max_rad);
            low + (high - low) * random.draw()
        });
        let conditions = Conditions {
            direction: std::array::from_fn(|_| if random.draw() < 0.5 { -1.0 } else { 1.0 }),
            ..equipped.inverse.conditions
        };
        let real = real.forward(&q, &conditions);
        let commanded = equipped.controller.forward(&q, &Conditions::default());
        let [real_base, nominal_base] = bases(ground.profile, || random.draw());
        gaps.push((real_base * real).separation(&(nominal_base * commanded)));
    }
    let mut counts = |part: fn(&Separation) -> f64| {
        gaps.sort_unstable_by(|a, b| part(a).total_cmp(&part(b)));
        TIMES * part(&gaps[COUNTS])
    };
    let (distance_m, angle_rad) = (counts(|gap| gap.distance_m), counts(|gap| gap.angle_rad));
    // a number that is not finite gives the largest limit: it is reported where it arises
    let within = |value: f64, least: f64, most: f64| {
        if value.is_finite() {
            value.clamp(least, most)
        } else {
            most
        }
    };
    Separation {
        distance_m: within(distance_m, LEAST.distance_m, MOST.distance_m),
        angle_rad: within(angle_rad, LEAST.angle_rad, MOST.angle_rad),
    }
}

/// Numbers that look drawn, the same on every run (splitmix64).
struct Random(u64);

impl Random {
    /// From 0 up to 1.
    fn draw(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Whether all numbers are finite.
pub(super) fn are_finite(numbers: &[f64]) -> bool {
    numbers.iter().all(|number| number.is_finite())
}

/// What is not finite in the search for a target's joints.
pub(super) fn not_finite(job: &Job, solved: &Solved) -> Option<Finding> {
    let Solved {
        approach, outcome, ..
    } = solved;
    let what = if !solved.wanted(job).is_finite() {
        "the wanted pose"
    } else if !are_finite(&approach.nominal_q) {
        "a joint of the nominal arm"
    } else if !are_finite(&outcome.q)
        || !are_finite(&[outcome.residual.distance_m, outcome.residual.angle_rad])
    {
        "a joint of the real arm"
    } else {
        return None;
    };
    Some(not_finite_finding(job, approach, what))
}

/// A number that is none, and where it arises.
pub(super) fn not_finite_finding(job: &Job, approach: &Approach, what: &str) -> Finding {
    let target = approach.target as usize;
    let message = format!(
        "{what} for {} is not a finite number",
        job.ground.name_of(target)
    );
    job.ground.at_target(
        "not-finite",
        Severity::Error,
        target,
        message,
        plausibility::OUT_OF_BOUNDS,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_drawn_evenly_and_alike_on_every_run() {
        let mut random = Random(SEED);
        let drawn: Vec<f64> = (0..1000).map(|_| random.draw()).collect();
        let mean = drawn.iter().sum::<f64>() / 1000.0;
        assert!((mean - 0.5).abs() < 0.03, "{mean}");
        assert!(drawn.iter().all(|number| (0.0..1.0).contains(number)));
        assert_eq!(Random(SEED).draw().to_bits(), drawn[0].to_bits());
    }
}
