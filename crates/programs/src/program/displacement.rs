//! What a program adds to a target before the robot goes there.

use super::{Move, Readings, TargetId};
use crate::geometry::{Pose, Vector};

/// What is added to a target before the robot goes there.
#[derive(Clone, Debug, PartialEq)]
pub enum Displacement {
    /// Nothing: the robot goes to the target.
    None,
    /// A motion that the text tells.
    By(Box<Shift>),
    /// One of the places that these steps lead to, one after another: the text tells the steps, and
    /// not which of them the program makes.
    Within(Box<[Stride]>),
    /// Something that only the running program knows.
    Unknown,
    /// Likewise; what the text tells of it comes to the places that these steps lead to, with 1 for
    /// each factor that only the running program knows.
    AtLeast(Box<[Stride]>),
    /// Something that only the running program knows, again and again, or that is worked out in a
    /// way that is not followed: nothing bounds it.
    Unbounded,
    /// The running program puts numbers of its own in the place of some of a copy's: these lose
    /// their correction.
    Overwritten,
}

impl Displacement {
    /// Gives the targets whose coordinates it is worked out from their new numbers.
    pub(super) fn renumber(&mut self, new: impl Fn(TargetId) -> Option<TargetId>) {
        if let Self::Within(strides) | Self::AtLeast(strides) = self {
            for stride in strides {
                if let Stride::Read { of, .. } = stride {
                    of.renumber(&new);
                }
            }
        }
    }
}

/// One of the steps of [`Displacement::Within`].
#[derive(Clone, Debug, PartialEq)]
pub enum Stride {
    /// A motion that the text tells.
    By {
        /// The motion.
        shift: Shift,
        /// How often it is made at most; `None` where the text does not tell.
        most: Option<u32>,
    },
    /// The tool turns about its origin, by this angle (radians) where the text tells it; about which
    /// axis it does not tell.
    Turned(Option<f64>),
    /// What becomes of an amount that is worked out from coordinates of targets where these are
    /// rewritten.
    Read {
        /// By one metre.
        shift: Shift,
        /// The coordinates; metres for each mm and degree.
        of: Readings,
    },
}

/// `shifted frame_from_tool = in_frame · frame_from_tool · in_tool`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// A motion in the work frame (RAPID `Offs`).
    pub in_frame: Pose,
    /// A motion in the tool frame (RAPID `RelTool`).
    pub in_tool: Pose,
}

impl Shift {
    /// None.
    #[must_use]
    pub fn none() -> Self {
        Self::along([0.0; 3])
    }

    /// A translation in the work frame alone, metres.
    #[must_use]
    pub fn along([x, y, z]: Vector) -> Self {
        Self {
            in_frame: Pose::from_translation(x, y, z),
            in_tool: Pose::identity(),
        }
    }

    /// This one, and then another.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            in_frame: next.in_frame * self.in_frame,
            in_tool: self.in_tool * next.in_tool,
        }
    }

    /// `frame_from_tool`, shifted.
    #[must_use]
    pub fn apply(&self, frame_from_tool: &Pose) -> Pose {
        self.in_frame * *frame_from_tool * self.in_tool
    }

    /// What is shifted to a pose.
    #[must_use]
    pub fn undo(&self, shifted: &Pose) -> Pose {
        self.in_frame.inverse() * *shifted * self.in_tool.inverse()
    }
}

impl Move {
    /// How far a move goes from where the robot stands, where the text says that and no target.
    pub(crate) fn step(&self) -> Option<&Shift> {
        match &self.displacement {
            Displacement::By(shift) if self.target.is_none() => Some(shift),
            _ => None,
        }
    }
}
