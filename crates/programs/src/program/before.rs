//! Where the robot comes from.

/// The moves that may come before a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Before {
    /// None: the program starts with it.
    #[default]
    Start,
    /// Any, or ones that are not known.
    Anywhere,
    /// One, by its index in [`super::Program::moves`].
    One(u32),
    /// Several, by index in [`super::Program::befores`].
    Several(u32),
    /// Any of a row of [`super::Program::moves`], which are too many to be kept apart one by one.
    AnyOf {
        /// The first.
        first: u32,
        /// Behind the last.
        end: u32,
    },
}
