//! Numbers of targets that programs only show.

use super::keywords::find;
use super::reader::Reader;
use super::sections::Statement;
use super::targets::Name;
use crate::program::script::RoutineId;
use crate::program::words::Words;

/// Statements that show numbers and do nothing else with them.
const SHOWING: [&[u8]; 3] = [b"PRINT", b"TYPE", b"IFPWPRINT"];

impl Reader<'_> {
    /// Whether statements show the numbers that `DECOMPOSE x[0]=p` takes apart, and nothing else in
    /// the files uses them.
    pub(super) fn is_only_shown(&self, part: Words, routine: RoutineId) -> bool {
        let Some((taken, _)) = Name::of(part.behind(1)) else {
            return false;
        };
        let is_own = taken.stem.starts_with(b".");
        let (mut is_shown, mut is_used) = (false, false);
        for (at, program) in (0..).zip(&self.sections.programs) {
            if is_own && at != routine {
                continue;
            }
            let bytes = &self.sources[program.place.file as usize].bytes;
            program.each(
                bytes,
                |_| true,
                |line: &Statement| {
                    let part = line.words;
                    if find(part, "DECompose") == Some(0) {
                        return;
                    }
                    let mut names = (0..part.len()).filter_map(|at| Name::of(part.behind(at)));
                    if names.any(|(name, _)| name.stem == taken.stem) {
                        let shows = SHOWING.iter().any(|word| part.is_word(0, word));
                        is_shown |= shows;
                        is_used |= !shows;
                    }
                },
            );
        }
        is_shown && !is_used
    }
}
