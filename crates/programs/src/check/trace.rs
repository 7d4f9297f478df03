//! The path of the real tool and the wanted one, move by move, in samples to draw: nothing is
//! judged and nothing bounded.

use super::deviation::Wanted;
use super::{CheckError, Options, Subject, Walk, nominal};
use crate::geometry::{Pose, Vector};
use crate::motion::leg::Leg;
use crate::program::Motion;
use rayon::prelude::*;

/// A place on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Where the tool is wanted, in the world, metres.
    pub wanted_m: Vector,
    /// Where the real tool is.
    pub real_m: Vector,
}

/// One move.
#[derive(Clone, Debug)]
pub struct Traced {
    /// Index in the program's moves.
    pub motion: usize,
    /// Index of the move of the original that it is, or is a part of; its own where there is no
    /// original.
    pub counterpart: usize,
    /// Index of the program's target at its end.
    pub target: usize,
    /// Index of its file in the sources.
    pub file: usize,
    /// Its line, from 1.
    pub line: usize,
    /// Where the controller believes the tool to be at its end, in the world.
    pub commanded: Pose,
    /// The controller's joints there, radians.
    pub joints: [f64; 6],
    /// It continues the move before it; else its first place is where it ends.
    pub continues: bool,
    /// From its beginning to its end; of a move that continues another the beginning is the
    /// other's end and left out.
    pub places: Vec<PathPoint>,
}

/// Follows a program in samples: about `total` of them, and at least one for each move.
///
/// # Errors
/// As [`check`](super::check()).
pub fn trace(
    subject: &Subject,
    options: &Options,
    total: usize,
) -> Result<Vec<Traced>, CheckError> {
    let walk = Walk::of(subject, subject.sources, options)?;
    let original = subject
        .nominal
        .map(|sources| Walk::of(subject, sources, options))
        .transpose()
        .map_err(CheckError::Nominal)?;
    let parts = original
        .as_ref()
        .map(|original| nominal::align(&walk, original, subject, options))
        .transpose()?;
    let count = walk.stops.all.len();
    let samples = (total / count.max(1)).clamp(1, MOST);
    let tracer = Tracer {
        subject,
        options,
        walk: &walk,
        original: original.as_ref(),
        parts: parts.as_deref(),
        samples: u32::try_from(samples).unwrap_or(1),
    };
    let traced: Vec<Option<Traced>> = (0..count)
        .into_par_iter()
        .with_min_len(64)
        .map(|index| tracer.trace(index))
        .collect();
    Ok(traced.into_iter().flatten().collect())
}

/// Samples of one move at most.
const MOST: usize = 24;

struct Tracer<'a> {
    subject: &'a Subject<'a>,
    options: &'a Options,
    walk: &'a Walk,
    original: Option<&'a Walk>,
    parts: Option<&'a [Option<nominal::Part>]>,
    samples: u32,
}

impl Tracer<'_> {
    fn trace(&self, index: usize) -> Option<Traced> {
        let motion = self.walk.motion(index);
        let is_context = self.subject.sources[motion.file as usize].is_context;
        if motion.motion == Motion::ArcVia || is_context {
            return None;
        }
        let stop = self.walk.stops.all[index]?;
        let part = match self.parts {
            Some(parts) => Some(parts[index]?),
            None => None,
        };
        let source = &self.subject.sources[motion.file as usize];
        let leg = self.walk.leg(index, self.options.turning);
        let mut traced = Traced {
            motion: self.walk.index(index),
            counterpart: match (self.original, part) {
                (Some(original), Some(part)) => original.index(part.stop),
                _ => self.walk.index(index),
            },
            target: motion.target?,
            file: motion.file as usize,
            line: source.line_column(motion.offset as usize).0,
            commanded: *self.walk.stops.commanded(&stop),
            joints: stop.q,
            continues: leg.is_some(),
            places: Vec::new(),
        };
        let arms = self.walk.arms(&stop);
        let Some(leg) = leg else {
            let conditions = self.walk.conditions(&stop);
            let wanted = match (self.original, part) {
                (Some(original), Some(part)) => part.end_pose(original, self.options),
                _ => *self.walk.stops.wanted(&stop),
            };
            traced.places.push(PathPoint {
                wanted_m: wanted.translation,
                real_m: arms.plain.real.forward(&stop.q, &conditions).translation,
            });
            return Some(traced);
        };
        let of_original = match (self.original, part) {
            (Some(original), Some(part)) => {
                let leg = original.leg(part.stop, self.options.turning);
                leg.map(|leg| (leg, original, part))
            }
            _ => None,
        };
        let wanted = match &of_original {
            Some((leg, original, part)) => {
                let stop = original.stops.all[part.stop]?;
                let arms = original.arms(&stop);
                Wanted {
                    leg,
                    from: part.from,
                    to: part.to,
                    controller: &arms.plain.controller,
                    controller_jet: &arms.jets.controller,
                    own: false,
                }
            }
            None => Wanted {
                leg: &leg,
                from: 0.0,
                to: 1.0,
                controller: &arms.plain.controller,
                controller_jet: &arms.jets.controller,
                own: true,
            },
        };
        traced.places = self.places(&leg, &wanted, &arms.plain.real);
        Some(traced)
    }

    fn places(&self, leg: &Leg, wanted: &Wanted, real: &crate::model::Model) -> Vec<PathPoint> {
        let mut near = leg.start;
        (1..=self.samples)
            .map(|k| {
                let s = f64::from(k) / f64::from(self.samples);
                let joints = leg.joints(s, &near);
                near = joints;
                let (wanted, real) = (
                    wanted.at(s, &joints),
                    real.forward(&joints, &leg.conditions),
                );
                let carried = leg.ride.as_ref().map(|ride| ride.world_from_real_home(s));
                let place = |pose: Pose| match &carried {
                    None => pose.translation,
                    Some(carried) => carried.transform(pose.translation),
                };
                PathPoint {
                    wanted_m: place(wanted),
                    real_m: place(real),
                }
            })
            .collect()
    }
}
