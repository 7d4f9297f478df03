//! Which moves a program makes, with what, and where the robot comes from.
//!
//! ```text
//! statements (program::script) → flow → moves with tool, frame, load, target and the moves before → legs → approaches
//! ```
//!
//! This is once for all languages: a reader translates text into statements and knows no flow; here
//! no text is known.
//!
//! # Example
//!
//! ```
//! use poseshift_programs::motion;
//! use poseshift_programs::program::{Before, Settings, Source, language_of};
//!
//! let text = "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 30,A6 0}\nsub()\nEND\n\
//!     DEF sub()\nLIN {X 500,Y 0,Z 600,A 0,B 90,C 0}\nEND\n";
//! let sources = [Source::new("t.src", text.into())];
//! let language = language_of(&sources[0]).expect("a language");
//! let program = motion::read(language, &sources, &Settings::default())?;
//! // the line in the routine begins where the move before its call ends
//! assert_eq!(program.before(&program.moves[1]), [Before::One(0)]);
//! # Ok::<(), poseshift_programs::program::ReadError>(())
//! ```

pub(crate) mod arms;
pub(crate) mod backlash;
pub(crate) mod bare;
mod before;
pub(crate) mod course;
mod crowds;
pub mod external;
mod external_values;
mod flow;
pub(crate) mod follow;
pub(crate) mod ground;
mod holding;
mod inherited;
pub(crate) mod leg;
pub(crate) mod middle;
pub(crate) mod passed;
pub(crate) mod placed;
pub(crate) mod plausibility;
pub(crate) mod posture;
mod readers;
mod resolve;
pub(crate) mod ride;
mod rows;
pub(crate) mod setting;
pub(crate) mod sides;
mod standing;
mod stepped;
pub(crate) mod unreached;
pub(crate) mod walk;

pub use course::ToolRotation;
pub(crate) use posture::OUT_OF_REACH;
pub use setting::{Given, GivenError, MeasuredFrameError, Missing, PlacementError};

use crate::program::{self, Language, Program, ReadError, Settings, Source, check_bytes};

/// Reads program files that belong together, and follows them.
///
/// # Errors
/// Where the text is not a program of the language or is broken.
pub fn read(
    language: &dyn Language,
    sources: &[Source],
    settings: &Settings,
) -> Result<Program, ReadError> {
    sources.iter().try_for_each(check_bytes)?;
    let script = language.script(sources, settings)?;
    let decides = program::may_decide(&script);
    let mut program = resolve::resolve(language, sources, settings, script)?;
    if decides {
        program.decided = program::decided(language, sources, &program);
    }
    Ok(program)
}
