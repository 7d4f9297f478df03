//! Which move of the original program each move of a compensated one is, or is a part of.
//!
//! A refined program has targets between those of the original. A move belongs to the original's
//! next move whose end its own landing is at; what comes before it on the same path are parts of
//! that move.

use super::walk::Walk;
use super::{CheckError, Options, Subject};
use crate::geometry::units::MM;
use crate::geometry::{Pose, norm, sub};
use crate::motion::course::Course;
use crate::program::{Motion, Move, Source};

/// A landing this near to a wanted pose is the landing at it, metres.
const LANDED_M: f64 = 0.5 * MM;
/// Joints of the two programs that differ by less are the same, radians.
const KEPT_RAD: f64 = 1e-9;

/// A part of a move of the original.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    /// Index of the stop in the original at which its move ends.
    pub stop: usize,
    /// Where in it the part begins, 0 to 1.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

impl Part {
    /// Where the tool is wanted at its end.
    pub(super) fn end_pose(&self, original: &Walk, options: &Options) -> Pose {
        let stop = original.stops.all[self.stop].expect("a part's move ends at a stop");
        if self.to >= 1.0 {
            return *original.stops.wanted(&stop);
        }
        let leg = original.leg(self.stop, options.turning);
        leg.map_or(*original.stops.wanted(&stop), |leg| {
            let joints = leg.joints(self.to, &leg.start);
            let pose = leg.controller_pose(self.to, &joints, &leg.equipped.controller);
            leg.real_from_nominal(self.to, pose)
        })
    }
}

/// For each stop of the program the part of the original that its move is; `None` for those that
/// cannot be followed.
pub(crate) fn align(
    walk: &Walk,
    original: &Walk,
    subject: &Subject,
    options: &Options,
) -> Result<Vec<Option<Part>>, CheckError> {
    let of_moves = align_moves(walk, original, subject, options)?;
    let part = |stop: usize| {
        let part = of_moves[walk.index(stop)]?;
        let theirs = original.index(part.stop);
        let same = alike(walk, original, stop, theirs, &of_moves)?;
        Some(Part { stop: same, ..part })
    };
    Ok((0..walk.stops.all.len()).map(part).collect())
}

/// The stop of the original's move that the robot comes to as to a stop of ours: from the same
/// moves, else along the nearest joints.
fn alike(
    walk: &Walk,
    original: &Walk,
    stop: usize,
    theirs: usize,
    of_moves: &[Option<Part>],
) -> Option<usize> {
    walk.stops.all[stop]?;
    let ours = passed(walk, stop);
    let of_ours = |at: usize| of_moves[walk.index(at)].map(|part| original.index(part.stop));
    let gap = |at: usize| {
        let theirs = passed(original, at);
        let (mut other_moves, mut joints_rad) = (0, 0.0);
        for pair in ours.iter().zip(theirs) {
            let (Some(mine), Some(their)) = (*pair.0, pair.1) else {
                other_moves += u32::from(pair.0.is_some() != pair.1.is_some());
                continue;
            };
            other_moves += u32::from(of_ours(mine) != Some(original.index(their)));
            let known = walk.stops.all[mine].zip(original.stops.all[their]);
            joints_rad += known.map_or(0.0, |(mine, their)| {
                let gaps = (0..6).map(|k| (mine.q[k] - their.q[k]).abs());
                gaps.fold(0.0, f64::max)
            });
        }
        (other_moves, joints_rad)
    };
    let known = original.stops_of(theirs);
    let known = known.filter(|at| original.stops.all[*at].is_some());
    let gaps = known.map(|at| (at, gap(at)));
    let nearest = gaps.min_by(|(_, a), (_, b)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    nearest.map(|(at, _)| at)
}

/// A stop and those before it from which its path begins: of an arc its middle, and its beginning.
fn passed(walk: &Walk, stop: usize) -> [Option<usize>; 3] {
    let before = walk.stops.before(stop);
    let is_middle = |at: &usize| walk.motion(*at).motion == Motion::ArcVia;
    let first = before
        .filter(is_middle)
        .and_then(|at| walk.stops.before(at));
    [Some(stop), before, first]
}

/// For each move of the program the part of the original that it is, with the first stop of the
/// original's move.
fn align_moves(
    walk: &Walk,
    original: &Walk,
    subject: &Subject,
    options: &Options,
) -> Result<Vec<Option<Part>>, CheckError> {
    let ours = &walk.program.moves;
    let theirs = &original.program.moves;
    let counterpart = |at: usize| {
        let sources = subject.nominal.unwrap_or(&[]);
        let (file, line) = theirs.get(at).map_or((String::new(), 0), |motion| {
            let source = &sources[motion.file as usize];
            (
                source.name.clone(),
                source.line_column(motion.offset as usize).0,
            )
        });
        CheckError::NoCounterpart { file, line }
    };
    let known_stop = |walk: &Walk, motion: usize| {
        let mut stops = walk.stops_of(motion);
        stops.find(|stop| walk.stops.all[*stop].is_some())
    };
    let whole = |stop: usize| Part {
        stop,
        from: 0.0,
        to: 1.0,
    };
    if ours.len() == theirs.len() {
        let alike = (0..ours.len()).find(|&i| ours[i].motion != theirs[i].motion);
        if let Some(at) = alike {
            return Err(counterpart(at));
        }
        return Ok((0..ours.len())
            .map(|motion| known_stop(original, motion).map(whole))
            .collect());
    }
    // of files that are read for their declarations only nothing is compared
    let is_own = |sources: &[Source], motion: &Move| !sources[motion.file as usize].is_context;
    let is_theirs = |at: &usize| is_own(subject.nominal.unwrap_or(&[]), &theirs[*at]);
    let own = |at: &usize| is_own(subject.sources, &ours[*at]);
    let own: Vec<usize> = (0..ours.len()).filter(own).collect();
    let of_theirs: Vec<usize> = (0..theirs.len()).filter(is_theirs).collect();
    let mut parts = vec![None; ours.len()];
    if own.len() == of_theirs.len() {
        for (at, its) in own.into_iter().zip(of_theirs) {
            if ours[at].motion != theirs[its].motion {
                return Err(counterpart(its));
            }
            parts[at] = known_stop(original, its).map(whole);
        }
        return Ok(parts);
    }
    let (mut mine, mut next) = (0, 0);
    while next < theirs.len() {
        if !is_theirs(&next) {
            next += 1;
            continue;
        }
        // the points of arcs go with their ends
        if theirs[next].motion == Motion::ArcVia {
            next += 1;
            continue;
        }
        let their_stop = known_stop(original, next);
        let Some((their_stop, stop)) =
            their_stop.and_then(|at| Some((at, original.stops.all[at]?)))
        else {
            if mine >= ours.len() {
                return Err(counterpart(next));
            }
            mine += 1;
            next += 1;
            continue;
        };
        let first = mine;
        let wanted = original.stops.wanted(&stop);
        let lands = |at: usize| {
            let ours = walk.stops.all[known_stop(walk, at)?]?;
            // a joint target that was kept does not land where the original wanted it
            let kept = (0..6).all(|k| (ours.q[k] - stop.q[k]).abs() < KEPT_RAD);
            let conditions = walk.conditions(&ours);
            let landed = walk.arms(&ours).plain.real.forward(&ours.q, &conditions);
            Some((
                landed,
                kept || landed.separation(wanted).distance_m <= LANDED_M,
            ))
        };
        let end = (first..ours.len())
            .filter(|&at| ours[at].motion != Motion::ArcVia)
            .find(|&at| lands(at).is_some_and(|(_, there)| there))
            .ok_or_else(|| counterpart(next))?;
        let leg = original.leg(their_stop, options.turning);
        let mut from = 0.0;
        for at in first..=end {
            if ours[at].motion == Motion::ArcVia {
                continue;
            }
            let to = match (&leg, lands(at)) {
                _ if at == end => 1.0,
                (Some(leg), Some((landed, _))) => {
                    let along = |s: f64| {
                        let joints = leg.joints(s, &leg.start);
                        let pose = leg.controller_pose(s, &joints, &leg.equipped.controller);
                        leg.real_from_nominal(s, pose)
                    };
                    nearest_on(
                        &along,
                        &landed,
                        from,
                        matches!(leg.course, Course::Joint { .. }),
                    )
                }
                _ => return Err(counterpart(next)),
            };
            parts[at] = Some(Part {
                stop: their_stop,
                from,
                to,
            });
            from = to;
        }
        mine = end + 1;
        next += 1;
    }
    Ok(parts)
}

/// Where beyond `from` a path is nearest to a pose, in position and, where the tool only turns, in
/// orientation.
fn nearest_on(along: &dyn Fn(f64) -> Pose, landed: &Pose, from: f64, fine: bool) -> f64 {
    let gap = |s: f64| {
        let pose = along(s);
        norm(sub(pose.translation, landed.translation)) + 0.1 * pose.separation(landed).angle_rad
    };
    let count = if fine { 400 } else { 200 };
    let step = (1.0 - from) / f64::from(count);
    let best = (0..=count)
        .map(|k| from + step * f64::from(k))
        .min_by(|a, b| gap(*a).total_cmp(&gap(*b)))
        .unwrap_or(from);
    // golden section about the best of the steps
    let (mut low, mut high) = ((best - step).max(from), (best + step).min(1.0));
    let part = 0.618_033_988_75;
    for _ in 0..60 {
        let (a, b) = (high - part * (high - low), low + part * (high - low));
        if gap(a) < gap(b) {
            high = b;
        } else {
            low = a;
        }
    }
    // inserted targets stand at round fractions of the rest: decimals of the file blur them by less
    // than this
    0.5 * (low + high)
}
