//! Which moves a program makes, with what, and where the robot comes from.
//!
//! ```text
//! statements (program::script) → flow → moves with tool, frame, load, target and the moves before → legs → approaches
//! ```
//!
//! This is once for all languages: a reader translates text into statements and knows no flow; here no text is known.

pub(crate) mod arms;
mod before;
pub(crate) mod course;
mod flow;
pub(crate) mod ground;
mod holding;
mod posture;
mod readers;
mod resolve;
pub(crate) mod setting;
pub(crate) mod walk;

pub use course::Turning;
pub(crate) use posture::OUT_OF_REACH;
pub use setting::{Given, MeasuredFrameError, Missing, PlacementError};

use crate::program::{Language, Program, ReadError, Settings, Source};

/// Reads program files that belong together, and follows them.
///
/// # Errors
/// Where the text is not a program of the language or is broken.
pub fn read(
    language: &dyn Language,
    sources: &[Source],
    settings: &Settings,
) -> Result<Program, ReadError> {
    let script = language.script(sources, settings)?;
    resolve::resolve(language, sources, settings, script)
}
