//! A program as it is walked: the models of its tools, and its moves as legs.

use super::Options;
use super::collision::Mover;
use super::course::{Course, Leg, ToolCourse, Turning};
use super::deviation::Models;
use super::uncertainty::Spread;
use crate::compensate::route::{Route, Stop, route};
use crate::compensate::{CompensateError, Equipped};
use crate::geometry::Jet;
use crate::model::Conditions;
use crate::model::profile::{Mounted, Profile};
use crate::program::{Language, Motion, Move, Source};

/// Models of one tool, for plain numbers and for bounds.
pub(super) struct Arms {
    pub plain: Models<f64>,
    pub jets: Models<Jet>,
    pub reaches: [[f64; 6]; 2],
    pub real_is_nominal: bool,
    pub spread: Option<Spread>,
}

impl Arms {
    pub fn of(equipped: &Equipped, profile: &Profile, tool: &Mounted) -> Self {
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
    pub fn mover(&self, which: Which) -> Mover<'_> {
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
        }
    }
}

/// Which of the two arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Which {
    Real,
    Controller,
}

/// A program that can be walked: its moves as legs.
pub(super) struct Walk {
    pub route: Route,
    pub arms: Vec<Option<Arms>>,
}

impl Walk {
    pub fn of(
        language: &dyn Language,
        sources: &[Source],
        profile: &Profile,
        options: &Options,
    ) -> Result<Self, CompensateError> {
        let route = route(language, sources, profile, &options.given)?;
        let arms = route
            .arms
            .iter()
            .zip(&route.tools)
            .map(|(equipped, tool)| Some(Arms::of(equipped.as_ref()?, profile, tool.as_ref()?)))
            .collect();
        Ok(Self { route, arms })
    }

    pub fn motion(&self, index: usize) -> &Move {
        &self.route.program.moves[index]
    }

    pub fn arms(&self, stop: &Stop) -> &Arms {
        self.arms[stop.tool]
            .as_ref()
            .expect("a stop's tool has an arm")
    }

    pub fn equipped(&self, stop: &Stop) -> &Equipped {
        self.route.arms[stop.tool]
            .as_ref()
            .expect("a stop's tool has an arm")
    }

    pub fn conditions(&self, stop: &Stop) -> Conditions {
        Conditions {
            direction: stop.direction.map(f64::from),
            ..Conditions::default()
        }
    }

    /// A stop alone, where it is unknown how the robot comes there.
    pub fn standing(&self, stop: &Stop) -> Leg<'_> {
        Leg {
            branch: stop.branch,
            equipped: self.equipped(stop),
            course: Course::Joint {
                from: stop.q,
                to: stop.q,
            },
            start: stop.q,
            conditions: self.conditions(stop),
        }
    }

    /// The move from the stop before, where both are known; arcs are one leg at their end.
    pub fn leg(&self, index: usize, turning: Turning) -> Option<Leg<'_>> {
        let moves = &self.route.program.moves;
        let (motion, stop) = (&moves[index], self.route.stops[index]?);
        if motion.motion == Motion::ArcVia {
            return None;
        }
        let (mut before, mut via) = (index.checked_sub(1)?, None);
        if motion.motion == Motion::ArcEnd && moves[before].motion == Motion::ArcVia {
            via = Some(self.route.stops[before]?);
            before = before.checked_sub(1)?;
        }
        if moves[before].file != motion.file {
            return None;
        }
        let start = self.route.stops[before]?;
        let equipped = self.equipped(&stop);
        // another tool on the same joints
        let from = if start.tool == stop.tool {
            start.pose
        } else {
            equipped
                .controller
                .forward(&start.q, &Conditions::default())
        };
        let course = match (motion.motion, via) {
            (Motion::Joint, _) => Course::Joint {
                from: start.q,
                to: stop.q,
            },
            (_, Some(via)) => {
                let through = via.pose.translation;
                Course::Tool(ToolCourse::arc(&from, through, &stop.pose, turning))
            }
            _ => Course::Tool(ToolCourse::straight(&from, &stop.pose, turning)),
        };
        Some(Leg {
            branch: equipped.arm.posture(&start.q).0,
            equipped,
            course,
            start: start.q,
            conditions: self.conditions(&stop),
        })
    }
}
