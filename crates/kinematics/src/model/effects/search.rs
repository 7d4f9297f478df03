//! What a diagnosis knows of an effect: how it is sought, and what it shows against.

use super::Kind;

/// How a diagnosis seeks an effect.
#[derive(Clone, Copy, Debug)]
pub struct Search {
    /// Only some arms have it: a structure that bends, a gear with two stiffnesses, a load that is
    /// not what was stated, axes that take each other along. Frames, geometry, the gears' ratio,
    /// stiffness, backlash and waves are in every arm, and what needs a column of its own (time,
    /// temperature, order) is distinguished from them by that.
    pub rare: bool,
    /// All places have it together: a load bends all joints at once.
    pub as_a_set: bool,
    /// A profile that has it is not fitted anew in it: what it does is hard to distinguish from
    /// what is sought.
    pub held: bool,
    /// Which of its parameters are sought together.
    pub sets: Sets,
    /// Those of its parameters that are negative on no arm.
    pub never_negative: &'static [usize],
    /// The parameter that is more, or less, of a mass: no mass is negative.
    pub mass: Option<usize>,
    /// Effects that do nearly the same where a column is missing that would tell them.
    pub alternatives: &'static [Kind],
    /// At the base, or of the whole arm, it does what the measuring device may do itself: no row
    /// tells them apart.
    pub or_of_device: bool,
}

impl Search {
    /// An effect that every arm has, with all its parameters at once.
    pub(super) const PLAIN: Self = Self {
        rare: false,
        as_a_set: false,
        held: false,
        sets: Sets::All,
        never_negative: &[],
        mass: None,
        alternatives: &[],
        or_of_device: false,
    };

    /// A structure that bends about x and y.
    pub(super) const BENDING: Self = Self {
        rare: true,
        sets: EITHER,
        never_negative: &[0, 1],
        ..Self::PLAIN
    };
}

/// Which parameters of an effect are sought together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sets {
    /// All.
    All,
    /// These.
    Of(&'static [&'static [usize]]),
    /// Those of a link that a complete and minimal model has: each alone, and all.
    Minimal,
    /// All others that mean something at the place, with this one at each value of a list.
    At(usize, List),
}

/// The place of a frame, and the whole of it.
pub(super) const FRAME: Sets = Sets::Of(&[&[0, 1, 2], &[0, 1, 2, 3, 4, 5]]);

/// The same of the base, and its rotation about the first axis, which is the zero of joint 1.
pub(super) const BASE_FRAME: Sets = Sets::Of(&[&[5], &[0, 1, 2], &[0, 1, 2, 3, 4, 5]]);

/// Each of two alone, and both.
pub(super) const EITHER: Sets = Sets::Of(&[&[0], &[1], &[0, 1]]);

/// Values that are tried one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum List {
    /// Temperatures at which the arm may be as its profile says.
    Temperatures,
    /// Parts of the largest torque of a joint.
    Torques,
    /// Parts of the session's length.
    Times,
    /// Parts of the number of rows.
    Rows,
}

/// What the residual without an effect is drawn against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// The angle of its joint.
    Angle,
    /// The angle of the joint that takes it along.
    OtherAngle,
    /// The torque of its joint, or of this one.
    Torque(Option<usize>),
    /// The last move of its joint.
    Move,
    /// The direction of its joint.
    Direction,
    /// The temperature.
    Temperature,
    /// The time where it is known, else the row.
    Time,
    /// The row.
    Order,
}
