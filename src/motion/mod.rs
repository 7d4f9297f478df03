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
mod readers;
mod posture;
mod resolve;
pub(crate) mod setting;
pub(crate) mod walk;

pub use course::Turning;
pub(crate) use posture::OUT_OF_REACH;
pub use setting::{Given, MeasuredFrameError, Missing, PlacementError};

use crate::program::{Before, Language, Program, ReadError, Settings, Source};

/// Reads program files that belong together, and follows them.
///
/// # Errors
/// Where the text is not a program of the language or is broken.
pub fn read(
    language: &dyn Language,
    sources: &[Source],
    settings: &Settings,
) -> Result<Program, ReadError> {
    match language.script(sources, settings) {
        Some(script) => resolve::resolve(language, sources, settings, script?),
        None => {
            let mut program = language.read(sources, settings)?;
            chain(&mut program);
            Ok(program)
        }
    }
}

/// Each move follows the one before it in its file.
fn chain(program: &mut Program) {
    for at in 1..program.moves.len() {
        let (file, before) = (
            program.moves[at - 1].file,
            crate::program::script::short(at - 1),
        );
        let motion = &mut program.moves[at];
        if motion.file == file {
            motion.before = Before::One(before);
        }
    }
}
