//! What a move asks of the joints: limits, singularities, rates, turns.

use crate::geometry::units::DEG;
use crate::inverse::Margins;
use crate::motion::course::Course;
use crate::motion::follow::Crossing;
use crate::motion::leg::{Leg, Piece};

/// The least room of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Least distance of a joint from its limits anywhere along the move, radians; negative
    /// beyond.
    pub margin_rad: f64,
    /// Which joint, from 0.
    pub joint: usize,
    /// Least distances from the singularities, of samples.
    pub margins: Margins,
    /// Largest rate of any joint anywhere along the move, radians for the whole move at a constant
    /// rate of s.
    pub rate_rad: f64,
    /// Programmed time of the move, seconds.
    pub duration_s: Option<f64>,
}

/// What one move asks of each of the joints.
pub(crate) struct Asked {
    pub limits: Limits,
    /// How far each joint turns, radians.
    pub turn_rad: [f64; 6],
    /// Largest rate of each joint anywhere along the move, as [`Limits::rate_rad`].
    pub rate_rad: [f64; 6],
    /// Least distance of each joint from its limits, as [`Limits::margin_rad`].
    pub margin_rad: [f64; 6],
}

/// Samples of the distance from singularities in each piece.
const SAMPLES: usize = 4;
/// A bound of a rate that is above what is seen by more than this part of the fastest joint's rate
/// bounds nothing.
const SLACK: f64 = 0.02;
/// Parts of one piece in which rates are looked at.
const MOST_PARTS: usize = 64;
/// A joint cannot be said to leave the straight line between two samples by more than this,
/// radians.
const MOST_BULGE_RAD: f64 = 0.5;

/// A bound of an angle is made no better where it is within this of what is seen, radians.
const EXACT_RAD: f64 = 0.001 * DEG;
/// Or where it keeps this far from the joint's limits, radians.
const FAR_RAD: f64 = 5.0 * DEG;
/// Parts of one piece in which angles are looked at near the limits.
const MOST_ANGLES: f64 = 256.0;

/// How far an angle may go beyond what is seen of it at the ends of equal parts of a piece, radians.
fn bulge(leg: &Leg, piece: &Piece, joint: usize, parts: usize) -> f64 {
    let (jet, long) = (&piece.joints[joint], piece.to - piece.from);
    let is_passed = |of: &Crossing| piece.from < of.region[1] && piece.to > of.region[0];
    // what never turns back is between its ends; past a singularity samples say it
    if jet.slope.mignitude() > 0.0 || leg.crossing.as_ref().is_some_and(is_passed) {
        return 0.0;
    }
    let long = long / parts as f64;
    let bulge = jet.bend.magnitude() * long * long / 8.0;
    // near a singularity the bound says nothing: samples do
    if bulge < MOST_BULGE_RAD { bulge } else { 0.0 }
}

/// The least and the largest angle of each joint at the ends of equal parts of a piece.
fn seen_in(leg: &Leg, piece: &Piece, parts: usize) -> [[f64; 6]; 2] {
    let long = piece.to - piece.from;
    let mut at = leg.turned(piece.from, &piece.start);
    let (mut low, mut high) = (at, at);
    for k in 1..=parts {
        at = leg.turned(piece.from + long * k as f64 / parts as f64, &at);
        low = std::array::from_fn(|i| low[i].min(at[i]));
        high = std::array::from_fn(|i| high[i].max(at[i]));
    }
    [low, high]
}

/// Largest mean rates of the joints over as many equal parts of a piece, from the joints where it
/// begins.
fn mean_rates(leg: &Leg, piece: &Piece, begin: &[f64; 6], parts: usize) -> [f64; 6] {
    let long = piece.to - piece.from;
    let (mut at, mut most) = (*begin, [0.0_f64; 6]);
    for k in 1..=parts {
        let last = at;
        at = leg.turned(piece.from + long * k as f64 / parts as f64, &last);
        for i in 0..6 {
            most[i] = most[i].max((at[i] - last[i]).abs() * parts as f64 / long);
        }
    }
    most
}

/// The largest rate of each joint in a piece: a bound where it is within [`SLACK`] of what is seen,
/// else what is seen. No rate is farther from the mean of a part than half the part's length times
/// the largest curvature.
fn rates(leg: &Leg, piece: &Piece, begin: &[f64; 6], seen: [f64; 6], fastest: f64) -> [f64; 6] {
    let long = piece.to - piece.from;
    let fastest = seen.iter().fold(fastest, |a, b| a.max(*b));
    let slack = SLACK * fastest;
    let rise =
        |i: usize, parts: usize| piece.joints[i].bend.magnitude() * long / (2.0 * parts as f64);
    let slope = |i: usize| piece.joints[i].slope.magnitude();
    let mut parts = SAMPLES;
    for i in (0..6).filter(|&i| slope(i) > seen[i] + slack && rise(i, 1).is_finite()) {
        while parts < MOST_PARTS && rise(i, parts) > slack {
            parts *= 2;
        }
    }
    let seen = if parts > SAMPLES {
        mean_rates(leg, piece, begin, parts)
    } else {
        seen
    };
    std::array::from_fn(|i| {
        let bound = slope(i).min(seen[i] + rise(i, parts));
        if bound <= seen[i] + slack {
            bound
        } else {
            seen[i]
        }
    })
}

/// A tool that has to rotate faster is slowed down by most controllers, rad/s. By speed data of ABB's
/// own it rotates at most 500 deg/s (Technical reference manual, RAPID, `speeddata`), by default of
/// KUKA 200 deg/s (`$VEL.ORI1`).
const USUAL_ROTATION_RAD_S: f64 = 200.0 * DEG;

/// What one move asks of the joints.
///
/// The slower of translation and rotation decides how long it takes. `rotation_rad_s`: how fast the
/// tool rotates at most; where that is not known, neither is how long a move takes on which it would
/// have to rotate faster than [`USUAL_ROTATION_RAD_S`].
pub(crate) fn asked(
    leg: &Leg,
    pieces: &[Piece],
    speed_m_s: Option<f64>,
    rotation_rad_s: Option<f64>,
) -> Asked {
    let arm = &leg.equipped.arm;
    let joints = &arm.mechanism().joints;
    let mut found = Limits {
        margin_rad: f64::INFINITY,
        joint: 0,
        margins: arm.posture(&leg.start).1,
        rate_rad: 0.0,
        duration_s: None,
    };
    let (mut rate_rad, mut margin_rad) = ([0.0_f64; 6], [f64::INFINITY; 6]);
    let mut at = leg.start;
    for piece in pieces {
        // a piece in which a joint may turn back stands there once for each side
        let begin = leg.turned(piece.from, &piece.start);
        at = begin;
        let long = piece.to - piece.from;
        let (mut low, mut high, mut seen) = (at, at, [0.0_f64; 6]);
        for k in 1..=SAMPLES {
            let s = piece.from + long * k as f64 / SAMPLES as f64;
            let last = at;
            at = leg.turned(s, &at);
            for i in 0..6 {
                (low[i], high[i]) = (low[i].min(at[i]), high[i].max(at[i]));
                let rate = (at[i] - last[i]).abs() * SAMPLES as f64 / long;
                seen[i] = seen[i].max(rate);
            }
            let here = arm.posture(&leg.joints(s, &at)).1;
            let least = &mut found.margins;
            least.wrist_rad = least.wrist_rad.min(here.wrist_rad);
            least.elbow_rad = least.elbow_rad.min(here.elbow_rad);
            least.shoulder_m = least.shoulder_m.min(here.shoulder_m);
        }
        let fastest = rate_rad.iter().fold(0.0_f64, |a, b| a.max(*b));
        let rates = rates(leg, piece, &begin, seen, fastest);
        let margins = |low: &[f64; 6], high: &[f64; 6], parts: usize| -> [f64; 6] {
            std::array::from_fn(|i| {
                let room = (low[i] - joints[i].min_rad).min(joints[i].max_rad - high[i]);
                room - bulge(leg, piece, i, parts)
            })
        };
        let mut margins_here = margins(&low, &high, SAMPLES);
        let beyond = (0..6).filter(|&i| margins_here[i] < FAR_RAD);
        let beyond = beyond.map(|i| bulge(leg, piece, i, SAMPLES));
        let beyond = beyond.fold(0.0, f64::max);
        if beyond > EXACT_RAD {
            let more = (beyond / EXACT_RAD).sqrt().ceil() * SAMPLES as f64;
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let parts = more.min(MOST_ANGLES) as usize;
            let [low, high] = seen_in(leg, piece, parts);
            margins_here = margins(&low, &high, parts);
        }
        for i in 0..6 {
            let margin = margins_here[i];
            margin_rad[i] = margin_rad[i].min(margin);
            if margin < found.margin_rad {
                (found.margin_rad, found.joint) = (margin, i);
            }
            rate_rad[i] = rate_rad[i].max(rates[i]);
        }
    }
    found.rate_rad = rate_rad.iter().fold(0.0, |a, b| a.max(*b));
    if let (Course::Tool(course), Some(speed)) = (&leg.course, speed_m_s) {
        let by_length = course.length_m() / speed;
        let usual = rotation_rad_s.unwrap_or(USUAL_ROTATION_RAD_S);
        let by_rotation = course.rotation_rad() / usual;
        let duration = by_length.max(by_rotation);
        let is_known = by_length >= by_rotation || rotation_rad_s.is_some();
        if speed > 0.0 && duration > 0.0 && is_known {
            found.duration_s = Some(duration);
        }
    }
    Asked {
        limits: found,
        turn_rad: std::array::from_fn(|i| at[i] - leg.start[i]),
        rate_rad,
        margin_rad,
    }
}
