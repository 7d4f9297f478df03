//! A program as it is walked: the models of its tools, and its moves as legs.

use super::deviation::Models;
use super::mover::Mover;
use super::uncertainty::Spread;
use super::{Options, Subject};
use crate::compensate::CompensateError;
use crate::finding::{Finding, Severity};
use crate::geometry::Jet;
use crate::geometry::{Pose, Vector};
use crate::inverse::Branch;
use crate::model::Conditions;
use crate::motion::arms::Equipped;
use crate::motion::bare;
use crate::motion::course::{Course, ToolCourse, ToolRotation};
use crate::motion::external;
use crate::motion::ground::Ground;
use crate::motion::leg::Leg;
use crate::motion::passed::Fakes;
use crate::motion::placed::Placed;
use crate::motion::plausibility;
use crate::motion::ride::{Ride, through};
use crate::motion::setting::Setting;
use crate::motion::sides;
use crate::motion::unreached;
use crate::motion::walk::{self, Arrival, WalkOptions};
use crate::profile::{Mounted, Profile};
use crate::program::script::short;
use crate::program::{Motion, Move, Program, Shape, Source};
use std::sync::Arc;

/// Models of one tool, for plain numbers and for bounds.
pub(super) struct Arms {
    pub plain: Models<f64>,
    pub jets: Models<Jet>,
    pub reaches: [[f64; 6]; 2],
    pub real_is_nominal: bool,
    pub spread: Option<Spread>,
}

impl Arms {
    pub(super) fn of(equipped: &Equipped, profile: &Profile, tool: &Mounted) -> Self {
        let plain = Models {
            real: equipped.inverse.real.clone(),
            controller: equipped.controller.clone(),
        };
        Self {
            jets: Models {
                real: plain.real.cast(),
                controller: plain.controller.cast(),
            },
            reaches: [plain.real.reaches(), plain.controller.reaches()],
            real_is_nominal: profile.real_effects() == profile.controller_effects(),
            spread: Spread::of(profile, tool),
            plain,
        }
    }

    /// One of the arms, to look for what it comes near.
    pub(super) fn mover(&self, which: Which) -> Mover<'_> {
        let (model, jet, reaches) = match which {
            Which::Real => (&self.plain.real, &self.jets.real, self.reaches[0]),
            Which::Controller => {
                let (model, jet) = (&self.plain.controller, &self.jets.controller);
                (model, jet, self.reaches[1])
            }
        };
        Mover {
            model,
            jet,
            reaches,
            is_real: which == Which::Real,
        }
    }
}

/// Which of the two arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Which {
    Real,
    Controller,
}

/// The end of one move, reached from one other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// Index of the tool in the program.
    tool: u32,
    /// Index in [`Stops::carried`]; beyond its end where no external axis counts.
    carried: u32,
    /// Where the controller believes the tool to be, in the world of an arm at home.
    pub pose: Pose,
    /// The branch of the inverse that the program means.
    pub branch: Branch,
    /// The controller's joint angles, radians.
    pub q: [f64; 6],
    /// Direction in which each joint last moved.
    pub direction: [i8; 6],
    /// The stop where the move begins; beyond all of them where that is not known.
    before: u32,
}

/// What external axes do at a stop.
#[derive(Clone, Copy, Debug)]
struct Carried {
    /// Where the controller believes the tool to be, in the world.
    commanded: Pose,
    /// Where the real arm wants its tool for that, in the world of its own at home.
    wanted: Pose,
    /// Gravity where the base leans.
    gravity_m_s2: Option<Vector>,
}

/// The ends of all moves.
#[derive(Debug, Default)]
pub(super) struct Stops {
    /// In the order of the text, one for each stop that a move begins at; `None` where it is
    /// unknown where the robot is then.
    pub all: Vec<Option<Stop>>,
    carried: Vec<Carried>,
}

impl Stops {
    fn carried(&self, stop: &Stop) -> Option<&Carried> {
        self.carried.get(stop.carried as usize)
    }

    /// Where the controller believes the tool to be, in the world.
    pub(super) fn commanded<'a>(&'a self, stop: &'a Stop) -> &'a Pose {
        self.carried(stop)
            .map_or(&stop.pose, |carried| &carried.commanded)
    }

    /// Where the real arm wants its tool, in the world of its own at home.
    pub(super) fn wanted<'a>(&'a self, stop: &'a Stop) -> &'a Pose {
        self.carried(stop)
            .map_or(&stop.pose, |carried| &carried.wanted)
    }

    /// The stop where the move to a stop begins.
    pub(super) fn before(&self, stop: usize) -> Option<usize> {
        let before = self.all[stop]?.before as usize;
        (before < self.all.len()).then_some(before)
    }
}

/// A program that can be walked: its moves as legs.
pub(super) struct Walk {
    pub program: Program,
    pub findings: Vec<Finding>,
    pub stops: Stops,
    /// The move of each stop.
    pub motions: Vec<u32>,
    /// By index of the program's work frames, as far as anybody knows them.
    pub frames: Vec<Option<Placed>>,
    profile: Profile,
    equipped: Vec<Option<Equipped>>,
    arms: Vec<Option<Arms>>,
}

impl Walk {
    /// Of these files in the language, with the robot and the scene of what is checked.
    pub(super) fn of(
        subject: &Subject,
        sources: &[Source],
        options: &Options,
    ) -> Result<Self, CompensateError> {
        let (language, profile) = (subject.language, subject.profile);
        // nothing is rewritten
        let settings = external::settings_of(profile, true);
        let mut program = crate::motion::read(language, sources, &settings)?;
        program.shrink_to_fit();
        let mut findings = std::mem::take(&mut program.findings);
        let plates = &subject.scene.plates;
        external::settle(
            (language, &settings),
            &mut program,
            sources,
            (profile, plates),
            (&options.given, &options.start_external),
            &Fakes::new(),
            &mut findings,
        );
        let has_numbers = |program: &Program, motion: &Move| {
            let target = program.target_of(motion);
            target.is_some_and(|target| !program.numbers_of(target).is_empty())
        };
        let of_moves = (profile, &options.given);
        unreached::leave(
            language,
            &mut program,
            sources,
            of_moves,
            &mut findings,
            has_numbers,
        );
        let has_numbers = |motion: &Move| has_numbers(&program, motion);
        if let Some(refused) = refused_place(&program, sources, &findings, has_numbers) {
            return Err(CompensateError::Refused(Box::new(refused.clone())));
        }
        let given = bare::flange_for_joints(
            language,
            &program,
            sources,
            of_moves,
            &mut findings,
            has_numbers,
        );
        let ground = Ground::new::<CompensateError>(
            language,
            &settings,
            &program,
            sources,
            profile,
            &given,
            has_numbers,
        )?;
        plausibility::bounds(&ground)?;
        plausibility::units(&ground, Severity::Warning, &mut findings);
        plausibility::names(&ground, &mut findings);
        plausibility::models(&ground, &mut findings);
        plausibility::left_out(&ground, &mut findings);
        let walk_options = WalkOptions {
            start_joints: options.start_joints,
            exact: true,
            strict: true,
            directed: true,
            turning: options.turning,
            ..WalkOptions::default()
        };
        let arrivals = walk::walk(&ground, &walk_options, &mut findings);
        sides::unknown(&ground, &arrivals, &mut findings);
        sides::revisits(&ground, &arrivals, &walk_options, &mut findings);
        let mut order: Vec<usize> = (0..arrivals.all.len()).collect();
        let key = |at: usize| (arrivals.all[at].motion, arrivals.all[at].from);
        order.sort_by_key(|&at| key(at));
        let mut places = vec![0; order.len()];
        for (place, &at) in order.iter().enumerate() {
            places[at] = short(place);
        }
        let mut carried = Vec::new();
        let mut stop = |arrival: &Arrival| {
            let pose = stop_pose(&ground, arrival)?;
            let motion = &program.moves[arrival.motion as usize];
            let here = ground.ride(None, motion).map(|ride| Carried {
                commanded: ride.world_from_nominal_home(1.0) * pose,
                wanted: ride.real_from_nominal(1.0) * pose,
                gravity_m_s2: ground.setting.frames[ground.frame_of(motion)]
                    .as_ref()
                    .and_then(|placed| placed.gravity_m_s2),
            });
            let index = here.map_or(u32::MAX, |_| short(carried.len()));
            carried.extend(here);
            Some(Stop {
                tool: short(motion.tool),
                carried: index,
                pose,
                branch: arrival.branch,
                q: arrival.q,
                direction: arrival.direction,
                before: places
                    .get(arrival.from as usize)
                    .copied()
                    .unwrap_or(u32::MAX),
            })
        };
        let stops = order.iter().map(|&at| stop(&arrivals.all[at])).collect();
        let stops = Stops {
            all: stops,
            carried,
        };
        let motions = order.iter().map(|&at| arrivals.all[at].motion).collect();
        let Ground {
            arms: equipped,
            setting: Setting { tools, frames },
            ..
        } = ground;
        let arms = equipped
            .iter()
            .zip(&tools)
            .map(|(equipped, tool)| Some(Arms::of(equipped.as_ref()?, profile, tool.as_ref()?)))
            .collect();
        Ok(Self {
            program,
            findings,
            stops,
            motions,
            frames,
            profile: profile.clone(),
            equipped,
            arms,
        })
    }

    /// The stops at which a move ends.
    pub(super) fn stops_of(&self, motion: usize) -> std::ops::Range<usize> {
        let motion = short(motion);
        let first = self.motions.partition_point(|of| *of < motion);
        first..first + self.motions[first..].partition_point(|of| *of == motion)
    }

    /// Whether the path to a stop is known between its points: not that of a spline, nor one on
    /// which the tool rotates as the joints of the wrist do, or the part moves and the path is not
    /// relative to it.
    pub(super) fn is_followed(&self, stop: usize) -> bool {
        let motion = self.motion(stop);
        motion.motion == Motion::Joint
            || motion.motion != Motion::Spline
                && !motion.free_orientation
                && !self.leaves_the_part(stop)
    }

    /// Whether what carries the work frame moves on the path to a stop that is not relative to it.
    pub(super) fn leaves_the_part(&self, stop: usize) -> bool {
        let motion = self.motion(stop);
        let stand = self.program.frames[motion.frame].stand.as_ref();
        let Some(carrier) = stand.and_then(|stand| stand.positioner) else {
            return false;
        };
        let external = &self.profile.external;
        let first = external.first_of(carrier);
        let own = first..first + external.positioners[carrier].axes.len();
        let stands = |stop: usize| self.program.stands_at(self.index(stop)).get(own.clone());
        let before = self.stops.before(stop);
        !motion.coordinated && before.is_some_and(|before| stands(before) != stands(stop))
    }

    /// Index of the move of a stop.
    pub(super) fn index(&self, stop: usize) -> usize {
        self.motions[stop] as usize
    }

    /// The move of a stop.
    pub(super) fn motion(&self, stop: usize) -> &Move {
        &self.program.moves[self.index(stop)]
    }

    pub(super) fn arms(&self, stop: &Stop) -> &Arms {
        self.arms[stop.tool as usize]
            .as_ref()
            .expect("a stop's tool has an arm")
    }

    pub(super) fn equipped(&self, stop: &Stop) -> &Equipped {
        self.equipped[stop.tool as usize]
            .as_ref()
            .expect("a stop's tool has an arm")
    }

    pub(super) fn conditions(&self, stop: &Stop) -> Conditions {
        Conditions {
            direction: stop.direction.map(f64::from),
            gravity_m_s2: self
                .stops
                .carried(stop)
                .and_then(|carried| carried.gravity_m_s2),
            ..Conditions::default()
        }
    }

    /// What external axes do on the way to a stop, from another where that is known.
    fn ride(&self, from: Option<usize>, to: usize) -> Option<Arc<Ride>> {
        let from = from.map_or(&[][..], |from| self.program.stands_at(self.index(from)));
        let motion = self.motion(to);
        let stand = self.program.frames[motion.frame].stand.as_ref();
        stand.map(|stand| Ride::of(&self.profile, from, stand, motion.coordinated))
    }

    /// A stop alone, where it is unknown how the robot comes there.
    pub(super) fn standing(&self, index: usize, stop: &Stop) -> Leg<'_> {
        Leg {
            ride: self.stand(index),
            branch: stop.branch,
            equipped: self.equipped(stop),
            course: Course::Joint {
                from: stop.q,
                to: stop.q,
            },
            start: stop.q,
            conditions: self.conditions(stop),
            crossing: None,
        }
    }

    /// Where external axes stand at a stop.
    fn stand(&self, stop: usize) -> Option<Arc<Ride>> {
        self.ride(Some(stop), stop)
    }

    /// The point on the way of the arc that ends at a stop.
    pub(super) fn via(&self, stop: usize) -> Option<usize> {
        if self.motion(stop).motion != Motion::ArcEnd {
            return None;
        }
        let before = self.stops.before(stop)?;
        (self.motion(before).motion == Motion::ArcVia).then_some(before)
    }

    /// The stop where the move to a stop begins; of an arc that before the point on its path.
    pub(super) fn start(&self, stop: usize) -> Option<usize> {
        let last = self.via(stop).unwrap_or(stop);
        self.stops.before(last)
    }

    /// The move from the stop before, where both are known; arcs are one leg at their end.
    pub(super) fn leg(&self, index: usize, turning: ToolRotation) -> Option<Leg<'_>> {
        let (motion, stop) = (self.motion(index), self.stops.all[index]?);
        if motion.motion == Motion::ArcVia {
            return None;
        }
        let (via, via_ride) = match self.via(index) {
            Some(via) => (Some(self.stops.all[via]?), self.stand(via)),
            None => (None, None),
        };
        let start = self.stops.all[self.start(index)?]?;
        let equipped = self.equipped(&stop);
        // another tool on the same joints
        let from = if start.tool == stop.tool {
            start.pose
        } else {
            equipped
                .controller
                .forward(&start.q, &Conditions::default())
        };
        let ride = self.ride(self.start(index), index);
        let course = match (motion.motion, via) {
            (Motion::Joint, _) => Course::Joint {
                from: start.q,
                to: stop.q,
            },
            (_, via) => {
                let via = via.map(|via| through(&via.pose, via_ride.as_deref(), ride.as_deref()));
                Course::Tool(ToolCourse::of(
                    &from,
                    via.as_ref(),
                    &stop.pose,
                    turning,
                    ride.clone(),
                ))
            }
        };
        let leg = Leg {
            ride,
            // the branch of the path's end is that of the whole path; at its beginning it may be
            // open
            branch: match motion.motion {
                Motion::Joint => equipped.arm.posture(&start.q).0,
                _ => stop.branch,
            },
            equipped,
            course,
            start: start.q,
            conditions: self.conditions(&stop),
            crossing: None,
        };
        Some(leg.with_crossing())
    }
}

/// Where the controller believes the tool to be at the end of a move; `None` where that is not
/// known.
fn stop_pose(ground: &Ground, arrival: &Arrival) -> Option<Pose> {
    let motion = &ground.program.moves[arrival.motion as usize];
    let target = motion
        .target
        .filter(|_| arrival.known && !arrival.displaced)?;
    let value = ground.goal(motion)?.value;
    ground.equipped(motion.tool)?;
    let frame = ground.frame_of(motion);
    let is_pose = ground.program.targets[target].layout.shape == Shape::Pose;
    (!is_pose || ground.setting.frames[frame].is_some())
        .then(|| ground.meant(&value, motion.tool, frame))
}

/// The error of a move whose tool or work frame the reader refuses: it has no name that an option
/// could give it by.
fn refused_place<'a>(
    program: &Program,
    sources: &[Source],
    findings: &'a [Finding],
    needs: impl Fn(&Move) -> bool,
) -> Option<&'a Finding> {
    let is_refused = |motion: &&Move| {
        let (tool, frame) = (&program.tools[motion.tool], &program.frames[motion.frame]);
        let no_tool = tool.flange_from_tool.is_none() && tool.name.is_empty();
        let no_frame = frame.world_from_frame.is_none() && frame.name.is_empty();
        let target = program.target_of(motion);
        target.is_some_and(|target| target.blocked) && (no_tool || no_frame) && needs(motion)
    };
    program.moves.iter().filter(is_refused).find_map(|motion| {
        let target = program.target_of(motion)?;
        let source = &sources[target.file as usize];
        let (line, _) = source.line_column(target.offset as usize);
        findings.iter().find(|finding| {
            finding.severity == Severity::Error
                && finding.line == line
                && finding.file == source.name
        })
    })
}
