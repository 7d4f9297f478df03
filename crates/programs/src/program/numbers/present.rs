//! What a number is at a statement: what its routine has written last, where nothing else can have written it since.

use super::super::quantity::Quantity;
use super::blocks::{Block, Blocks};
use super::{Evaluate, Numbers};
use std::rc::Rc;

/// Writes that are made of the one before that are followed.
const DEEPEST: u32 = 24;

/// Blocks in blocks that are followed.
const DEEPEST_BLOCK: usize = 32;

/// From which byte on a routine stands behind so many writes, in these blocks.
#[derive(Debug)]
pub(super) struct Mark {
    offset: u32,
    order: u32,
    blocks: Vec<Block>,
}

/// The statements that write a number, all of one routine.
#[derive(Debug)]
pub(super) struct Own {
    routine: u32,
    /// Among all that is written into it, in the order of the text.
    writes: Vec<usize>,
}

/// Where a number is looked at.
#[derive(Clone, Copy)]
struct Looked<'a> {
    number: u32,
    order: u32,
    blocks: &'a [Block],
}

impl<W> Numbers<W> {
    /// A statement begins at this byte of the routine that `blocks` are of.
    pub(in crate::program) fn stands(&mut self, offset: u32, blocks: &Blocks) {
        let (routine, order, open) = blocks.here();
        if open.len() > DEEPEST_BLOCK {
            self.jumping.insert(routine);
            return;
        }
        let marks = self.marks.entry(routine).or_default();
        if let Some(last) = marks.last() {
            if last.offset > offset {
                // the text of a routine in parts
                self.jumping.insert(routine);
                return;
            }
            if last.order == order && last.blocks == open {
                return;
            }
        }
        marks.push(Mark {
            offset,
            order,
            blocks: open.to_vec(),
        });
    }

    /// What a number is at a statement of a routine; `None` where several writes may be the last.
    /// `of` gives what other numbers are.
    pub(in crate::program) fn present(
        &self,
        number: u32,
        (routine, offset): (u32, u32),
        evaluate: &Evaluate<W>,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Option<Quantity> {
        let number = self.one(number);
        let marks = self.marks.get(&routine)?;
        let at = marks.partition_point(|mark| mark.offset <= offset);
        let mark = marks.get(at.checked_sub(1)?)?;
        let own = self.own(number).filter(|own| own.routine == routine)?;
        let looked = Looked {
            number,
            order: mark.order,
            blocks: &mark.blocks,
        };
        self.last_written(&own, looked, evaluate, of, DEEPEST)
    }

    fn last_written(
        &self,
        own: &Own,
        Looked {
            number,
            order,
            blocks,
        }: Looked,
        evaluate: &Evaluate<W>,
        of: &mut dyn FnMut(u32) -> Quantity,
        depth: u32,
    ) -> Option<Quantity> {
        let depth = depth.checked_sub(1)?;
        let writes = &self.facts.get(&number)?.writes;
        let site = |at: usize| writes[at].1.as_ref();
        let behind = own
            .writes
            .partition_point(|at| site(*at).is_some_and(|site| site.order <= order));
        let last = *own.writes.get(behind.checked_sub(1)?)?;
        let (what, Some(written)) = &writes[last] else {
            return None;
        };
        // it was written in each case, and no round of a loop since then may write it again
        let since = blocks.strip_prefix(&written.blocks[..])?;
        let next = own.writes.get(behind).and_then(|at| site(*at));
        let is_again = |block: &Block| {
            let is_once =
                block.most == Some(1) && !self.unbounded.contains(&(own.routine, block.number));
            !is_once && next.is_some_and(|next| next.blocks.contains(block))
        };
        if since.iter().any(is_again) {
            return None;
        }
        let value = evaluate(what, &mut |other| {
            if self.one(other) == number {
                Quantity::own()
            } else {
                of(other)
            }
        });
        let (count, rest) = value.apart();
        if count == 0.0 {
            return Some(rest);
        }
        let looked = Looked {
            number,
            order: written.order - 1,
            blocks: &written.blocks,
        };
        let before = self.last_written(own, looked, evaluate, of, depth)?;
        Some(before.times(count).plus(rest))
    }

    /// The statements that write a number, where they are of one routine and are followed one by one.
    fn own(&self, number: u32) -> Option<Rc<Own>> {
        if let Some(known) = self.owns.borrow().get(&number) {
            return known.clone();
        }
        let found = self.find_own(number).map(Rc::new);
        self.owns.borrow_mut().insert(number, found.clone());
        found
    }

    /// Whether a routine goes from statement to statement, and never runs while it does so already.
    fn is_followed(&self, routine: u32) -> bool {
        if let Some(known) = self.followed.borrow().get(&routine) {
            return *known;
        }
        let mut at_any_time = self.called_by(self.concurrent.iter().copied().collect());
        at_any_time.extend(&self.concurrent);
        let found = !self.calls_any
            && !self.jumping.contains(&routine)
            && !at_any_time.contains(&routine)
            && !self.runs_inside_itself(routine);
        self.followed.borrow_mut().insert(routine, found);
        found
    }

    fn find_own(&self, number: u32) -> Option<Own> {
        let facts = self.facts.get(&number)?;
        if facts.is_lost || facts.is_endless || facts.is_elsewhere || facts.is_scattered {
            return None;
        }
        let sites = facts.writes.iter().enumerate();
        let sites: Vec<_> = sites
            .filter_map(|(at, (_, site))| Some((at, site.as_ref()?)))
            .collect();
        let routine = sites.first()?.1.routine;
        let is_of_one = sites.iter().all(|(_, site)| site.routine == routine);
        if !is_of_one || !self.is_followed(routine) {
            return None;
        }
        // what it begins with does not change where it is written
        let statements = sites.into_iter().filter(|(_, site)| site.step.is_some());
        let mut writes: Vec<(u32, usize)> = statements.map(|(at, site)| (site.order, at)).collect();
        writes.sort_unstable();
        Some(Own {
            routine,
            writes: writes.into_iter().map(|(_, at)| at).collect(),
        })
    }
}
