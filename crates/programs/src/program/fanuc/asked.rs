//! What branches ask of the arguments of programs: `IF AR[1]=2,JMP LBL[2]`, `SELECT AR[1]=1,…`. Where a
//! call gives a number, it runs the branch that it is given: a program cannot write its arguments.

use super::content::canonical;
use super::reader::Reader;
use super::words::{comma, indexed, whole};
use crate::program::numbers::{First, equality, logic};
use crate::program::script::{Test, Tests, VariableId, Wanted};

/// The number of the argument that a text is.
fn argument(text: &[u8]) -> Option<u32> {
    text.strip_prefix(b"AR").and_then(indexed).flatten()
}

impl Reader<'_> {
    /// What a condition asks of arguments.
    pub(super) fn tests(&mut self, condition: &[u8]) -> Tests {
        let text = canonical(condition.trim_ascii());
        logic(&text, true, First::Comparisons).map(&mut |part| self.test(part.text, part.holds))
    }

    fn test(&mut self, comparison: &[u8], holds: bool) -> Option<Test> {
        let (before, behind, is_equal) = equality(comparison)?;
        let mut sides = [(before, behind), (behind, before)].into_iter();
        let (of, number) = sides.find_map(|(of, number)| argument(of).zip(whole(number)))?;
        let wanted = if is_equal == holds {
            Wanted::Number
        } else {
            Wanted::NotNumber
        };
        let of = self.argument(self.listing.routine, of);
        Some((of, wanted(number.into())))
    }

    /// The argument that `SELECT AR[1]=1,…` asks about.
    pub(super) fn selected(&mut self, text: &[u8]) -> Option<VariableId> {
        let text = canonical(&text[..memchr::memchr(b'=', text)?]);
        let of = argument(text.trim_ascii())?;
        Some(self.argument(self.listing.routine, of))
    }
}

/// The number of a case, from its sign on: `=2,CALL A`.
pub(super) fn case(text: &[u8]) -> Option<i64> {
    let behind = text[..comma(text)?].strip_prefix(b"=")?;
    whole(behind.trim_ascii()).map(i64::from)
}
