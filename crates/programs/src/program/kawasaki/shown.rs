//! Numbers of targets that programs only show.

use super::keywords::find;
use super::reader::{Owned, Reader};
use super::sections::Statement;
use super::targets::Name;
use crate::program::script::RoutineId;
use crate::program::words::Words;
use foldhash::HashMap;

/// Statements that show numbers and do nothing else with them.
const SHOWING: [&[u8]; 3] = [b"PRINT", b"TYPE", b"IFPWPRINT"];

/// Whether names are only shown: `false` where a statement uses one otherwise. `DECOMPOSE` does
/// neither.
pub(super) type Shown = HashMap<Owned, bool>;

impl Reader<'_> {
    /// Whether statements show the numbers that `DECOMPOSE x[0]=p` takes apart, and nothing else in
    /// the files uses them.
    pub(super) fn is_only_shown(&self, part: Words, routine: RoutineId) -> bool {
        let Some((taken, _)) = Name::of(part.behind(1)) else {
            return false;
        };
        let shown = self.shown.get_or_init(|| self.find_shown());
        let owner = self.owner_in(&taken, routine);
        shown.get(&(owner, taken.stem)).copied().unwrap_or(false)
    }

    fn find_shown(&self) -> Shown {
        let mut shown = Shown::default();
        for (routine, program) in (0..).zip(&self.sections.programs) {
            let bytes = &self.sources[program.place.file as usize].bytes;
            let look = |line: &Statement| {
                let part = line.words;
                if find(part, "DECompose") == Some(0) {
                    return;
                }
                let shows = SHOWING.iter().any(|word| part.is_word(0, word));
                for (name, _) in (0..part.len()).filter_map(|at| Name::of(part.behind(at))) {
                    let owner = self.owner_in(&name, routine);
                    *shown.entry((owner, name.stem)).or_insert(true) &= shows;
                }
            };
            program.each(bytes, |_| true, look);
        }
        shown
    }
}
