//! Where a routine goes from statement to statement, as far as numbers that add up need it: between
//! blocks, labels and jumps.

use foldhash::HashMap;

/// Where a routine ends; from there it may begin anew.
const END: u32 = u32::MAX;

/// Where a routine goes from a step.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// To the next one.
    Next,
    /// To another one.
    Other(u32),
    /// To the next one or another.
    Either(u32),
}

/// A block that is open.
#[derive(Clone, Debug)]
struct Open {
    start: u32,
    /// The last step from which one of its branches may be passed over.
    fork: u32,
    /// Steps that go to what is behind it.
    ends: Vec<u32>,
    kind: Kind,
}

/// What kind of block one is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// One of several branches.
    Choice,
    /// Likewise, that a statement leaves.
    Switch,
    Loop,
}

/// What a search comes past.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passed {
    /// A step.
    Step(u32),
    /// From a step to the next one (`true`), or to another.
    Edge(u32, bool),
    /// Where the routine begins, before its first step.
    Start,
}

/// The steps of a routine: those at which numbers are written, and those from which it goes elsewhere than to
/// the next one.
#[derive(Clone, Debug, Default)]
pub(in crate::program) struct Flow {
    steps: Vec<Step>,
    labels: HashMap<u64, u32>,
    jumps: Vec<(u32, u64)>,
    open: Vec<Open>,
}

impl Flow {
    pub(super) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether nothing is in it.
    pub(in crate::program) fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    fn here(&self) -> u32 {
        u32::try_from(self.steps.len()).unwrap_or(END - 1)
    }

    /// A step; what may follow it is not the next one alone.
    fn put(&mut self, step: Step) -> u32 {
        self.steps.push(step);
        self.here() - 1
    }

    /// A step at which a number is written.
    pub(super) fn write(&mut self) -> u32 {
        self.put(Step::Next)
    }

    /// A block begins that may be passed over. The step from which its statements are the next.
    pub(super) fn open(&mut self, kind: Kind) -> u32 {
        let fork = self.put(Step::Either(END));
        self.open.push(Open {
            start: fork,
            fork,
            ends: Vec::new(),
            kind,
        });
        fork
    }

    /// Another branch of it begins, which may be passed over, too.
    pub(super) fn branch(&mut self) {
        if self.open.last().is_none_or(|open| open.kind == Kind::Loop) {
            return;
        }
        let end = self.put(Step::Other(END));
        let fork = self.put(Step::Either(END));
        if let Some(open) = self.open.last_mut() {
            open.ends.push(end);
            let before = std::mem::replace(&mut open.fork, fork);
            self.steps[before as usize] = Step::Either(fork);
        }
    }

    /// The block ends; a loop begins again.
    pub(super) fn close(&mut self) {
        if let Some(open) = self.open.pop() {
            if open.kind == Kind::Loop {
                self.put(Step::Other(open.start));
            }
            self.end_block(open);
        }
    }

    /// A loop ends that begins again or does not. The step from which what is behind it is the next.
    pub(super) fn close_or_repeat(&mut self) -> Option<u32> {
        let open = self.open.pop()?;
        let end = self.put(Step::Either(open.start));
        self.end_block(open);
        Some(end)
    }

    fn end_block(&mut self, open: Open) {
        let behind = self.put(Step::Next);
        self.steps[open.fork as usize] = Step::Either(behind);
        for end in open.ends {
            self.steps[end as usize] = Step::Other(behind);
        }
    }

    /// Behind the innermost loop, or the block that `break` leaves.
    pub(in crate::program) fn leave(&mut self) {
        let at = self.put(Step::Other(END));
        let mut open = self.open.iter_mut().rev();
        if let Some(open) = open.find(|open| open.kind != Kind::Choice) {
            open.ends.push(at);
        }
    }

    /// A label.
    pub(in crate::program) fn label(&mut self, key: u64) {
        let here = self.put(Step::Next);
        self.labels.insert(key, here);
    }

    /// A jump to a label, or one that may be made. The step from which it is.
    pub(in crate::program) fn jump(&mut self, key: u64, may: bool) -> u32 {
        let at = if may {
            self.put(Step::Either(END))
        } else {
            self.put(Step::Other(END))
        };
        self.jumps.push((at, key));
        at
    }

    /// The routine ends here.
    pub(in crate::program) fn stop(&mut self) {
        self.put(Step::Other(END));
    }

    /// The text of the routine ends.
    pub(super) fn end(&mut self) {
        while !self.open.is_empty() {
            self.close();
        }
        for (at, key) in std::mem::take(&mut self.jumps) {
            let Some(&to) = self.labels.get(&key) else {
                continue;
            };
            let step = &mut self.steps[at as usize];
            *step = match step {
                Step::Either(_) => Step::Either(to),
                _ => Step::Other(to),
            };
        }
    }

    /// Whether the routine may come from a step to it again, in this run or the next, and in which states, one bit
    /// for each. `pass` says in which state a search that was in one (0 at first) is behind what it comes
    /// past, and where it does not go on.
    pub(super) fn again(&self, step: u32, pass: &dyn Fn(Passed, u8) -> Option<u8>) -> u8 {
        let mut states = vec![0_u8; self.steps.len()];
        let mut open = vec![(step, 0_u8)];
        let mut found = 0;
        while let Some((at, state)) = open.pop() {
            let here = self.steps[at as usize];
            let next = (!matches!(here, Step::Other(_))).then_some((at + 1, true));
            let other = match here {
                Step::Next => None,
                Step::Other(to) | Step::Either(to) => Some((to, false)),
            };
            for (to, is_next) in next.into_iter().chain(other) {
                let Some(mut state) = pass(Passed::Edge(at, is_next), state) else {
                    continue;
                };
                let mut to = to;
                if to as usize >= self.steps.len() {
                    let Some(anew) = pass(Passed::Start, state) else {
                        continue;
                    };
                    (to, state) = (0, anew);
                }
                if to == step {
                    found |= 1 << state;
                    continue;
                }
                let Some(state) = pass(Passed::Step(to), state) else {
                    continue;
                };
                let bit = 1 << state;
                if states[to as usize] & bit == 0 {
                    states[to as usize] |= bit;
                    open.push((to, state));
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_free(passed: Passed, wall: u32) -> Option<u8> {
        (passed != Passed::Step(wall)).then_some(0)
    }

    #[test]
    fn a_routine_comes_again_by_loops_jumps_and_its_next_run() {
        let mut flow = Flow::default();
        let reset = flow.write();
        flow.label(5);
        let step = flow.write();
        flow.open(Kind::Choice);
        let jump = flow.jump(5, false);
        flow.close();
        flow.end();
        // by the jump, and when the routine runs next
        assert_eq!(flow.again(step, &|_, _| Some(0)), 1);
        assert_eq!(flow.again(step, &|passed, _| is_free(passed, reset)), 1);
        let is_open = |passed: Passed| passed != Passed::Step(jump);
        assert_eq!(
            flow.again(step, &|passed, _| is_open(passed).then_some(0)),
            1
        );
        let neither = |passed: Passed, _| is_free(passed, reset).filter(|_| is_open(passed));
        assert_eq!(flow.again(step, &neither), 0);
    }

    #[test]
    fn branches_are_passed_over_and_loops_come_again() {
        let mut flow = Flow::default();
        let reset = flow.write();
        flow.open(Kind::Loop);
        let fork = flow.open(Kind::Choice);
        let first = flow.write();
        flow.branch();
        let alternative = flow.here() - 1;
        let second = flow.write();
        flow.close();
        flow.close();
        flow.end();
        let wall = |passed: Passed, _| is_free(passed, reset);
        assert_eq!(flow.again(first, &wall), 1);
        assert_eq!(flow.again(second, &wall), 1);
        let shut = |edge: Passed| {
            move |passed: Passed, _: u8| is_free(passed, reset).filter(|_| passed != edge)
        };
        assert_eq!(flow.again(first, &shut(Passed::Edge(fork, true))), 0);
        assert_eq!(flow.again(second, &shut(Passed::Edge(fork, false))), 0);
        assert_eq!(
            flow.again(second, &shut(Passed::Edge(alternative, true))),
            0
        );
        assert_eq!(flow.again(second, &shut(Passed::Edge(fork, true))), 1);
    }

    #[test]
    fn what_leaves_a_loop_goes_behind_it() {
        for leaves in [false, true] {
            let mut flow = Flow::default();
            let reset = flow.write();
            flow.open(Kind::Loop);
            let step = flow.write();
            flow.open(Kind::Choice);
            if leaves {
                flow.leave();
            }
            flow.close();
            let end = flow.close_or_repeat().expect("a loop");
            flow.end();
            let wall = |passed: Passed, _| {
                is_free(passed, reset).filter(|_| passed != Passed::Edge(end, false))
            };
            assert_eq!(flow.again(step, &wall), 0, "{leaves}");
            assert_eq!(flow.again(step, &|passed, _| is_free(passed, reset)), 1);
        }
    }
}
