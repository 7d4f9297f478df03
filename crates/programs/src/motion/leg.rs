//! A move of an arm: the joints along its path, and bounds of them over parts of it.

use super::arms::Equipped;
use super::course::Course;
use super::follow::{self, Crossing};
use super::ride::Ride;
use crate::geometry::{Jet, Pose, Scalar};
use crate::inverse::Branch;
use crate::model::{Conditions, Model};
use std::sync::Arc;

/// An interval shorter than this whose bounds are not finite is not halved again.
const SHORTEST: f64 = 1.0 / 512.0;
/// Pieces in which a joint with backlash may turn back are not shorter.
const SHORTEST_TURN: f64 = 1.0 / 256.0;
/// The part of a piece about its middle in which rates are bounded for the middle.
const MIDDLE_PART: f64 = 1.0 / 32.0;
/// A joint whose rate is less than this stands, radians per metre.
pub(super) const STANDSTILL_RAD_M: f64 = 1e-3;
/// A joint that moves by less keeps the direction in which it moved before, radians.
pub(super) const STANDSTILL_RAD: f64 = 1e-6;
/// At the ends of that many parts of a path it is seen whether a joint stands on it.
const STANDING_PARTS: u32 = 4;
/// What the search for joints leaves, radians.
const SLACK_RAD: f64 = 1e-8;

/// A move of an arm: the path, and the posture in which it begins.
pub(crate) struct Leg<'a> {
    pub equipped: &'a Equipped,
    pub course: Course,
    /// The controller's joints where it begins, radians.
    pub start: [f64; 6],
    /// The branch of the inverse on which a path of the tool is followed.
    pub branch: Branch,
    pub conditions: Conditions,
    /// What external axes do meanwhile.
    pub ride: Option<Arc<Ride>>,
    /// Where joint 5 goes through the wrist's singularity.
    pub crossing: Option<Crossing>,
}

/// A part of a move over which the joints' rates are bounded.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub from: f64,
    pub to: f64,
    /// The controller's joints where it begins, radians.
    pub start: [f64; 6],
    /// The controller's joints, in radians, and their derivatives by s.
    pub joints: [Jet; 6],
    /// The conditions of the arm in it: from which side joints with backlash come.
    pub conditions: Conditions,
    /// The bounds hold everywhere in the piece; else it is near a singularity or the controller
    /// has a chain of its own.
    pub certified: bool,
}

impl Piece {
    /// Whether the joints' values and rates have bounds that say something.
    pub(crate) fn is_bounded(&self) -> bool {
        self.joints.iter().all(|joint| {
            joint.value.radius < 1.0
                && joint.slope.radius.is_finite()
                && joint.bend.radius.is_finite()
        })
    }

    /// Whether these joints lie within the bounds: with those of both ends in one piece the way
    /// between them has no leap.
    pub(crate) fn holds(&self, joints: &[f64; 6]) -> bool {
        let within =
            |(jet, q): (&Jet, &f64)| (q - jet.value.middle).abs() <= jet.value.radius + SLACK_RAD;
        self.joints.iter().zip(joints).all(within)
    }
}

impl Leg<'_> {
    /// The same with where it changes the branch, if it begins with joint 5 on the other side of the
    /// wrist's singularity than it ends.
    pub(crate) fn with_crossing(mut self) -> Self {
        if let Course::Tool(course) = &self.course {
            self.crossing = follow::crossing(self.equipped, course, &self.start, self.branch);
        }
        self
    }

    fn branch_at(&self, s: f64) -> Branch {
        match self.crossing {
            Some(crossing) if s < crossing.at => crossing.before,
            _ => self.branch,
        }
    }

    /// The controller's joints at `s`, by whole revolutions nearest to `near`.
    pub(crate) fn joints(&self, s: f64, near: &[f64; 6]) -> [f64; 6] {
        match &self.course {
            Course::Joint { from, to } => std::array::from_fn(|i| from[i] + s * (to[i] - from[i])),
            Course::Tool(course) => {
                let pose = course.pose(s);
                match &self.equipped.calibrated_controller {
                    None => {
                        self.equipped
                            .arm
                            .solve_along(&pose, self.branch_at(s), near)
                            .q
                    }
                    Some(controller) => controller.solve(&pose, self.branch_at(s), near).q,
                }
            }
        }
    }

    /// The joints that the controller turns to at `s`: where joint 5 goes through the wrist's singularity
    /// all go evenly past it, and joint 4 does not sweep to where the path alone would have it.
    pub(crate) fn turned(&self, s: f64, near: &[f64; 6]) -> [f64; 6] {
        let Some(Crossing {
            region: [from, to], ..
        }) = self.crossing
        else {
            return self.joints(s, near);
        };
        if s <= from || s >= to {
            return self.joints(s, near);
        }
        let enters = self.joints(from, near);
        let leaves = self.joints(to, &enters);
        let part = (s - from) / (to - from);
        std::array::from_fn(|i| enters[i] + part * (leaves[i] - enters[i]))
    }

    /// How far beyond reach the controller's nominal arm is asked to go at `s`; 0 within.
    pub(crate) fn beyond(&self, s: f64) -> f64 {
        match &self.course {
            Course::Joint { .. } => 0.0,
            Course::Tool(course) => {
                let pose = course.pose(s);
                self.equipped
                    .arm
                    .solve_along(&pose, self.branch_at(s), &self.start)
                    .beyond
            }
        }
    }

    /// Where the real arm wants its tool at `s` for the controller's to be at a pose: both at home.
    pub fn real_from_nominal<S: Scalar>(&self, s: S, pose: Pose<S>) -> Pose<S> {
        match &self.ride {
            None => pose,
            Some(ride) => ride.real_from_nominal(s) * pose,
        }
    }

    /// Where the controller, with this model, believes the tool to be.
    pub(crate) fn controller_pose<S: Scalar>(
        &self,
        s: S,
        joints: &[S; 6],
        controller: &Model<S>,
    ) -> Pose<S> {
        match &self.course {
            Course::Joint { .. } => controller.forward(joints, &Conditions::default()),
            Course::Tool(course) => course.pose(s),
        }
    }

    /// Bounds of the joints between `from` and `to`, given the joints in the middle.
    pub(crate) fn enclose(&self, from: f64, to: f64, middle: &[f64; 6]) -> Piece {
        let s = Jet::variable(from, to);
        let (joints, certified) = match &self.course {
            Course::Joint { from, to } => (
                std::array::from_fn(|i| {
                    Jet::constant(from[i]) + Jet::constant(to[i] - from[i]) * s
                }),
                true,
            ),
            Course::Tool(course) => {
                let half_width = 0.5 * (to - from);
                let arm = &self.equipped.arm;
                let half = 0.5 * (from + to);
                let branch = self.branch_at(half);
                let enclosed = arm.enclose(&course.pose(s), half_width, branch.signs(), middle);
                let exact = self.equipped.calibrated_controller.is_none();
                let is_crossed = (self.crossing).is_some_and(|of| from < of.at && of.at < to);
                let joints = if exact {
                    enclosed
                } else {
                    let middle_pose = course.pose(half);
                    let nominal = arm.solve_along(&middle_pose, branch, middle).q;
                    std::array::from_fn(|i| shifted(enclosed[i], middle[i] - nominal[i]))
                };
                (joints, exact && !is_crossed)
            }
        };
        let mut piece = Piece {
            from,
            to,
            start: *middle,
            joints,
            conditions: self.conditions,
            certified,
        };
        piece.certified &= piece.is_bounded();
        // gravity is taken as it is at the end, and what begins nobody knows where is taken to
        // stand
        piece.certified &= self
            .ride
            .as_ref()
            .is_none_or(|ride| ride.is_known() && !(ride.moves() && ride.leans()));
        piece
    }

    /// The whole move in pieces whose bounds are tight enough to work with. A piece in which a
    /// joint with backlash may turn back stands there once for each side from which it may
    /// come.
    pub(crate) fn pieces(&self) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut near = self.start;
        self.split((0.0, 1.0), &mut near, self.standing(), &mut pieces);
        pieces
    }

    fn split(
        &self,
        (from, to): (f64, f64),
        near: &mut [f64; 6],
        stands: [bool; 6],
        out: &mut Vec<Piece>,
    ) {
        let middle = self.joints(0.5 * (from + to), near);
        let mut piece = self.enclose(from, to, &middle);
        let end = self.joints(to, &middle);
        piece.certified &= piece.holds(near) && piece.holds(&end);
        piece.start = *near;
        let long = to - from;
        let mut sides = self.sides(&piece.joints, stands);
        if piece.certified && sides.iter().any(|sides| sides.len() > 1) {
            sides = self.sides(&self.narrowed(&piece, &middle), stands);
        }
        let is_one_sided = sides.iter().all(|sides| sides.len() == 1);
        let steady = piece.joints.iter().all(|joint| {
            let change = joint.bend.magnitude() * long;
            change <= 0.5 * joint.slope.magnitude() + 0.2 && joint.slope.magnitude() * long < 1.0
        });
        let exact = self.equipped.calibrated_controller.is_none();
        let is_fine = steady && (piece.certified || !exact);
        if (is_fine && (is_one_sided || long <= SHORTEST_TURN)) || long <= SHORTEST {
            // where nothing bounds the rates, samples say from where joints come
            let sides = if piece.certified || long > SHORTEST {
                sides
            } else {
                self.sampled_sides([near, &middle, &end], sides)
            };
            *near = end;
            each_side(&piece, &sides, out);
        } else {
            let half = 0.5 * (from + to);
            self.split((from, half), near, stands, out);
            self.split((half, to), near, stands, out);
        }
    }
}

impl Leg<'_> {
    /// The joints in a piece with rates that are those in its middle and what they change by from
    /// there, where these bounds are the narrower ones.
    fn narrowed(&self, piece: &Piece, middle: &[f64; 6]) -> [Jet; 6] {
        let (half, at) = (0.5 * (piece.to - piece.from), 0.5 * (piece.from + piece.to));
        let near = MIDDLE_PART * half;
        let inner = self.enclose(at - near, at + near, middle);
        let mut joints = piece.joints;
        if !inner.certified || !inner.holds(middle) {
            return joints;
        }
        for (joint, inner) in joints.iter_mut().zip(&inner.joints) {
            let radius = inner.slope.radius + joint.bend.magnitude() * half;
            if radius < joint.slope.radius {
                (joint.slope.middle, joint.slope.radius) = (inner.slope.middle, radius);
            }
        }
        joints
    }

    /// From which sides each joint may come in a piece where they are so. A joint that stands on the
    /// whole move keeps the side that it has at its end.
    fn sides(&self, joints: &[Jet; 6], stands: [bool; 6]) -> [Vec<f64>; 6] {
        let Course::Tool(_) = &self.course else {
            return self.conditions.direction.map(|side| vec![side]);
        };
        let turning = self.equipped.mechanism.commanded(joints);
        std::array::from_fn(|i| {
            let slope = &turning[i].slope;
            let (low, high) = (slope.middle - slope.radius, slope.middle + slope.radius);
            if stands[i] {
                vec![self.conditions.direction[i]]
            } else if low > 0.0 {
                vec![1.0]
            } else if high < 0.0 {
                vec![-1.0]
            } else {
                vec![-1.0, 1.0]
            }
        })
    }

    /// From which of its sides each joint comes between three samples.
    fn sampled_sides(&self, samples: [&[f64; 6]; 3], mut sides: [Vec<f64>; 6]) -> [Vec<f64>; 6] {
        let [a, b, c] = samples.map(|q| self.equipped.mechanism.commanded(q));
        for (i, sides) in sides.iter_mut().enumerate() {
            let steps = [b[i] - a[i], c[i] - b[i]];
            if sides.len() > 1 && steps.iter().all(|step| *step > 0.0) {
                *sides = vec![1.0];
            } else if sides.len() > 1 && steps.iter().all(|step| *step < 0.0) {
                *sides = vec![-1.0];
            }
        }
        sides
    }

    /// Joints that keep their side on the whole move: those without backlash, and those that stand.
    fn standing(&self) -> [bool; 6] {
        let equipped = self.equipped;
        let mut stands = equipped.has_backlash.map(|has| !has);
        if stands.contains(&false) {
            let mut q = self.start;
            let commanded = |q: &[f64; 6]| equipped.mechanism.commanded(q);
            let first = commanded(&q);
            let mut all = [true; 6];
            for part in 1..=STANDING_PARTS {
                q = self.joints(f64::from(part) / f64::from(STANDING_PARTS), &q);
                let here = commanded(&q);
                all =
                    std::array::from_fn(|i| all[i] && (here[i] - first[i]).abs() < STANDSTILL_RAD);
            }
            stands = std::array::from_fn(|i| stands[i] || all[i]);
        }
        stands
    }
}

/// The piece with the joints on each of their sides.
fn each_side(piece: &Piece, sides: &[Vec<f64>; 6], out: &mut Vec<Piece>) {
    let mut all = vec![[0.0; 6]];
    for (joint, sides) in sides.iter().enumerate() {
        all = sides
            .iter()
            .flat_map(|side| {
                let of = |direction: &[f64; 6]| {
                    let mut direction = *direction;
                    direction[joint] = *side;
                    direction
                };
                all.iter().map(of).collect::<Vec<_>>()
            })
            .collect();
    }
    out.extend(all.into_iter().map(|direction| Piece {
        conditions: Conditions {
            direction,
            ..piece.conditions
        },
        ..piece.clone()
    }));
}

/// Bounds of a joint of a controller whose own chain is calibrated: those of the nominal one,
/// shifted and widened. Its chain differs by thousandths; the widening is ten times that.
fn shifted(nominal: Jet, by: f64) -> Jet {
    let mut joint = nominal + Jet::constant(by);
    joint.value.radius += 0.5 * by.abs();
    joint.slope.radius += 0.05 * nominal.slope.magnitude();
    joint.bend.radius += 0.05 * (nominal.bend.magnitude() + nominal.slope.magnitude());
    joint
}
