//! Tools and frames.

use crate::geometry::{Pose, Vector};

/// A tool that moves name.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Its name in the program.
    pub name: String,
    /// Where its tip is; `None` where the files do not tell.
    pub flange_from_tool: Option<Pose>,
    /// Its load where the files give one.
    pub load: Option<Load>,
    /// What it carries as well, its centre of gravity in the tool's own frame.
    pub carried: Option<Load>,
    /// Where it stands on another tool, metres; `None` where it stands on the flange.
    pub on_tool: Option<Vector>,
}

/// The mass a flange carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of gravity in the flange frame, metres.
    pub cog_m: Vector,
}

impl Load {
    /// Together with what a tool carries, whose centre of gravity is in the tool's frame.
    #[must_use]
    pub fn with(self, carried: Self, flange_from_tool: &Pose) -> Self {
        let mass_kg = self.mass_kg + carried.mass_kg;
        let part = flange_from_tool.transform(carried.cog_m);
        let share = if mass_kg > 0.0 {
            carried.mass_kg / mass_kg
        } else {
            0.0
        };
        let cog_m =
            [0, 1, 2].map(|axis| self.cog_m[axis] + share * (part[axis] - self.cog_m[axis]));
        Self { mass_kg, cog_m }
    }
}

/// A work frame that moves name.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Its name in the program.
    pub name: String,
    /// Where it is; `None` where the files do not tell. On a mechanical unit, where it is on that.
    pub world_from_frame: Option<Pose>,
    /// The mechanical unit that carries it, by all its names; none where it stands still.
    pub on: Box<[Box<str>]>,
    /// Where external axes stand at the moves that have it, as far as the profile knows any.
    pub stand: Option<Stand>,
}

/// [`Frame::on`] of a frame that rides on the axes of the robot's own base.
pub const BASE_UNIT: &str = "the base";

impl Frame {
    /// Whether a mechanical unit besides the robot's own base carries it.
    #[must_use]
    pub fn is_carried(&self) -> bool {
        self.on.first().is_some_and(|unit| **unit != *BASE_UNIT)
    }

    /// Whether the robot's own base carries it.
    #[must_use]
    pub fn rides_on_base(&self) -> bool {
        !self.on.is_empty() && !self.is_carried()
    }
}

/// Where external axes stand at a move.
#[derive(Clone, Debug, PartialEq)]
pub struct Stand {
    /// By index in [`super::ExternalNames::listed`], metres and radians; those that no pose of the move
    /// depends on are not a number.
    pub values: Box<[f64]>,
    /// Direction in which each moves there: −1, +1, or 0 where it is unknown.
    pub directions: Box<[f64]>,
    /// Index of the positioner that carries the frame.
    pub positioner: Option<usize>,
    /// The frame rides on the base.
    pub on_base: bool,
    /// It is the frame of moves to joints: the world, seen from what carries the work piece.
    pub of_joints: bool,
    /// The same where axes come from the other side, where the robot comes to the end of the move
    /// now from one and now from the other.
    pub from_other_side: Option<super::FrameId>,
}
