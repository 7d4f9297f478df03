//! Loops that count, and what is known behind a call.

use super::super::content::{Content, Entered};
use super::super::indices::ends;
use super::{Known, Loop, Written};
use crate::program::numbers::rounds;
use crate::program::script::RoutineId;
use std::rc::Rc;

impl Known {
    /// `FOR R[1]=1 TO 4`, the next loop of a script; the counter where it is known. How often it runs
    /// at most.
    pub(in crate::program::fanuc) fn begin_loop(
        &mut self,
        next: usize,
        counter: Option<(u32, &[u8])>,
        before: Option<&Self>,
    ) -> Option<u32> {
        let counting = counter.and_then(|(number, range)| {
            let (from, to, is_down) = ends(range)?;
            Some((number, from, to, is_down))
        });
        let exact = |text: &[u8]| self.entered(u32::MAX, text.trim_ascii(), 0).exact();
        let mut most = None;
        if let Some((_, from, to, is_down)) = counting {
            let step = if is_down { -1.0 } else { 1.0 };
            let ends = exact(from).zip(exact(to));
            most = ends.and_then(|(from, to)| rounds(from, to, step));
        }
        for text in counting.iter().flat_map(|(_, from, to, _)| [*from, *to]) {
            let entered = self.entered(u32::MAX, text.trim_ascii(), 0);
            self.reads(&entered);
        }
        self.clear();
        let mut inside = None;
        if let Some((number, from, to, is_down)) = counting {
            let text = |text: &[u8]| Rc::from(text.trim_ascii());
            let (from, to) = (text(from), text(to));
            let content = Content::Counted { from, to, is_down };
            let entered = Rc::new(Entered::of(content, self.path.routine));
            let site = self.blocks.site();
            self.all.insert(number);
            self.numbers
                .write(number, Rc::clone(&entered), Some(site.clone()));
            self.note_written(number);
            // in the loop it is what is counted, where nothing else writes it
            let is_alone = before.is_some_and(|before| before.is_only_counted(number));
            if is_alone && !self.is_concurrent {
                let is_settled = true;
                let written = Written {
                    entered,
                    site,
                    is_settled,
                };
                inside = Some((number, written));
            }
        } else if let Some((number, _)) = counter {
            self.lose(number);
        }
        self.path.depth += 1;
        self.path.written.push(Vec::new());
        self.blocks.open_loop(most);
        if let Some((number, written)) = inside {
            self.now.insert(number, written);
            self.note_written(number);
        }
        self.loops.extend(counter.map(|(counter, _)| Loop {
            counter,
            block: self.blocks.last(),
            number: next,
        }));
        most
    }

    pub(in crate::program::fanuc) fn end_loop(&mut self) {
        self.close();
    }

    /// Another program runs: what was written may not be there any more, but for what loops of this
    /// program alone count.
    pub(in crate::program::fanuc) fn leave(&mut self, before: Option<&Self>) {
        self.settle();
        let routine = self.path.routine;
        self.now.retain(|number, _| {
            before.is_some_and(|before| before.is_counted_by(*number, routine))
        });
    }

    /// Whether nothing but loops of a program write a number.
    fn is_counted_by(&self, number: u32, routine: RoutineId) -> bool {
        let mut loops = self.loops.iter().filter(|of| of.counter == number);
        self.is_only_counted(number) && loops.all(|of| of.block.0 == routine)
    }

    /// Whether nothing but loops that count write a number.
    pub(in crate::program::fanuc) fn is_only_counted(&self, number: u32) -> bool {
        !self.assigned.contains(&number)
    }

    /// The next round of a loop that is gone through round by round.
    pub(in crate::program::fanuc) fn count(&mut self, counter: u32, number: f64) {
        let is_assigned = self.assigned.contains(&counter);
        let entered = Entered::of(Content::Exactly(number), self.path.routine);
        self.write(counter, entered);
        if !is_assigned {
            self.assigned.remove(&counter);
        }
    }
}
