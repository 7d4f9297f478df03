//! Puts statements together: blocks become labels, branches and jumps.

use super::{
    Call, Condition, How, Instruction, Label, Loop, Modal, Place, Routine, RoutineId, Script,
    Start, Statement, Tests, VariableId, Wanted, Write, Written, short,
};
use crate::program::Displacement;
use foldhash::HashMap;

/// Adds the statements of routines to a script, one routine after another.
///
/// What does not fit together (an end without a beginning, a block left open) is passed over:
/// readers say what is wrong with the text, and the flow then is that of the text without the lone
/// word.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    /// What is put together.
    pub script: Script,
    open: Vec<Block>,
    /// Labels of the present routine by the reader's own key.
    named: HashMap<u64, Label>,
    /// Begin of the present routine's statements and moves.
    routine: Option<(RoutineId, u32, u32)>,
}

/// A block that is open.
#[derive(Clone, Debug)]
enum Block {
    Choice {
        /// Where the next branch begins.
        next: Option<Label>,
        end: Label,
        /// Begun by [`Builder::begin_choice`] or [`Builder::begin_switch`].
        is_switch: bool,
        /// What the variable is that its branches ask for.
        of: Option<VariableId>,
    },
    Loop {
        top: Label,
        end: Label,
        /// Index in [`Script::loops`].
        number: u32,
    },
}

impl Builder {
    /// Begins a routine that is already among the script's routines.
    pub fn open(&mut self, routine: RoutineId) {
        self.close();
        let statements = short(self.script.statements.len());
        let instructions = short(self.script.instructions.len());
        self.routine = Some((routine, statements, instructions));
    }

    /// Adds a routine without statements yet, so that calls can name it.
    pub fn declare(&mut self, name: impl Into<Box<str>>, place: Place, start: Start) -> RoutineId {
        self.script.routines.push(Routine {
            name: name.into(),
            place,
            start,
            statements: 0..0,
            instructions: 0..0,
        });
        short(self.script.routines.len() - 1)
    }

    /// Ends the present routine; blocks that are open end there.
    pub fn close(&mut self) {
        while let Some(block) = self.open.pop() {
            self.end(&block);
        }
        self.named.clear();
        if let Some((routine, statements, instructions)) = self.routine.take() {
            let ends = (
                short(self.script.statements.len()),
                short(self.script.instructions.len()),
            );
            let routine = &mut self.script.routines[routine as usize];
            routine.statements = statements..ends.0;
            routine.instructions = instructions..ends.1;
        }
    }

    /// The script, finished.
    #[must_use]
    pub fn finish(mut self) -> Script {
        self.close();
        self.script
    }

    /// A move, and with what it runs.
    pub fn go(&mut self, mut instruction: Instruction, modal: Modal) {
        let at = short(self.script.instructions.len());
        instruction.modal = self.script.modal(modal);
        self.script.instructions.push(instruction);
        self.script.statements.push(Statement::Move(at));
    }

    /// The robot may stop on the way of the last move, behind which the program goes on: where it
    /// stands then is known to nobody.
    pub fn stop(&mut self, place: Place) {
        let script = &self.script;
        let Some(last) = script.instructions.last() else {
            return;
        };
        let Modal { tool, frame, .. } = script.modals[last.modal as usize];
        let stopped = Modal {
            tool,
            frame,
            ..Modal::default()
        };
        self.go(Instruction::at(place), stopped);
    }

    /// A write.
    pub fn write(&mut self, place: Place, variable: Written, how: How) {
        let mut write = Write {
            place,
            variable,
            how,
        };
        self.join_shifts(&mut write);
        let at = short(self.script.writes.len());
        self.script.writes.push(write);
        self.script.statements.push(Statement::Write(at));
    }

    /// Several parts of one position that grow in a row are one displacement.
    fn join_shifts(&mut self, write: &mut Write) {
        let script = &mut self.script;
        let Some(Statement::Write(last)) = script.statements.last() else {
            return;
        };
        let last = &script.writes[*last as usize];
        if last.variable != write.variable || !matches!(write.variable, Written::One(_)) {
            return;
        }
        let of = |by: u32| &script.displacements[by as usize];
        match (&last.how, &mut write.how) {
            (How::PartBy(_, before), How::PartBy(_, by)) => {
                let (Displacement::By(before), Displacement::By(shift)) = (of(*before), of(*by))
                else {
                    return;
                };
                let both = Displacement::By(Box::new(before.then(shift)));
                *by = script.displacement(both);
            }
            (How::PartSomehow(_), How::PartSomehow(_)) => {}
            _ => return,
        }
        script.statements.pop();
    }

    /// A call.
    pub fn call(&mut self, call: Call) {
        let at = short(self.script.calls.len());
        self.script.calls.push(call);
        self.script.statements.push(Statement::Call(at));
    }

    /// A start of routines that then run concurrently with this one, and may move the robot or not.
    pub fn start(&mut self, call: Call, moves: bool) {
        for routine in &*call.callees {
            self.script.routines[*routine as usize].start = Start::Concurrent;
        }
        let at = short(self.script.calls.len());
        self.script.calls.push(Call {
            leads: moves,
            ..call
        });
        self.script.statements.push(Statement::Start(at));
    }

    fn new_label(&mut self) -> Label {
        self.script.labels += 1;
        self.script.labels - 1
    }

    fn put(&mut self, label: Label) {
        self.script.statements.push(Statement::Label(label));
    }

    fn jump(&mut self, label: Label) {
        self.script.statements.push(Statement::Jump(label));
    }

    fn branch(&mut self, label: Label) {
        self.script.statements.push(Statement::Branch(label));
    }

    fn branch_unless(&mut self, tests: &Tests, otherwise: Label) {
        match tests {
            Tests::One(Some(test)) => {
                let at = short(self.script.conditions.len());
                let test = *test;
                self.script.conditions.push(Condition { test, otherwise });
                self.script.statements.push(Statement::BranchUnless(at));
            }
            _ if tests.parts().into_iter().all(Option::is_none) => self.branch(otherwise),
            Tests::All(all) => {
                for tests in all {
                    self.branch_unless(tests, otherwise);
                }
            }
            Tests::Any(all) => {
                let inside = self.new_label();
                for (at, tests) in all.iter().enumerate() {
                    if at + 1 == all.len() {
                        self.branch_unless(tests, otherwise);
                    } else {
                        let next = self.new_label();
                        self.branch_unless(tests, next);
                        self.jump(inside);
                        self.put(next);
                    }
                }
                self.put(inside);
            }
            Tests::One(None) => {}
        }
    }

    /// `IF … THEN`: the statements that follow may be passed over; where variables tell, they are
    /// run as these do.
    pub fn begin_if(&mut self, tests: impl Into<Tests>) {
        let (next, end) = (self.new_label(), self.new_label());
        self.branch_unless(&tests.into(), next);
        self.open.push(Block::Choice {
            next: Some(next),
            end,
            is_switch: false,
            of: None,
        });
    }

    /// `TEST`, `SWITCH`: statements follow in branches, each begun by [`Self::next_branch`].
    pub fn begin_choice(&mut self) {
        self.begin_switch(None);
    }

    /// Likewise, of what a variable holds; each has its [`Self::pass_cases`].
    pub fn begin_switch(&mut self, of: Option<VariableId>) {
        let (next, end) = (self.new_label(), self.new_label());
        self.jump(next);
        self.open.push(Block::Choice {
            next: Some(next),
            end,
            is_switch: true,
            of,
        });
    }

    /// `ELSEIF`, `CASE`: another branch that may be passed over; `ELSE`, `DEFAULT`: the last one.
    pub fn next_branch(&mut self, is_last: bool) {
        let Some(Block::Choice { next, end, .. }) = self.open.last_mut() else {
            return;
        };
        let (before, end) = (next.take(), *end);
        self.jump(end);
        if let Some(before) = before {
            self.put(before);
        }
        if !is_last {
            self.pass_branch(None);
        }
    }

    /// What follows in the last branch may be passed over, unlike what stands before in it: the
    /// calls of its condition.
    pub fn pass_branch(&mut self, tests: impl Into<Tests>) {
        let following = self.new_label();
        self.branch_unless(&tests.into(), following);
        if let Some(Block::Choice { next, .. }) = self.open.last_mut() {
            *next = Some(following);
        }
    }

    /// Likewise of a `CASE` of these numbers; of what is not known where they are none.
    pub fn pass_cases(&mut self, numbers: &[i64]) {
        let of = match self.open.last() {
            Some(Block::Choice { of, .. }) => *of,
            _ => None,
        };
        let Some(of) = of.filter(|_| !numbers.is_empty()) else {
            return self.pass_branch(None);
        };
        let test = |number: &i64| Tests::One(Some((of, Wanted::Number(*number))));
        self.pass_branch(Tests::Any(numbers.iter().map(test).collect()));
    }

    /// `ENDIF`, `ENDTEST`, `ENDSWITCH`.
    pub fn end_choice(&mut self) {
        let is_choice = |block: &mut Block| matches!(block, Block::Choice { .. });
        if let Some(block) = self.open.pop_if(is_choice) {
            self.end(&block);
        }
    }

    /// Begins a loop. `may_pass`: its statements may be passed over (`WHILE`, `FOR`; not `REPEAT`,
    /// `LOOP`).
    pub fn begin_loop(&mut self, may_pass: bool) {
        self.begin_rounds(may_pass, None);
    }

    /// Begins a loop of so many rounds at most, where the text tells.
    pub fn begin_rounds(&mut self, may_pass: bool, most: Option<u32>) {
        let (top, end) = (self.new_label(), self.new_label());
        let number = short(self.script.loops.len());
        let is_counted = |number: u32| self.script.loops[number as usize].most.is_some();
        let is_outer = !self.innermost_loop().is_some_and(|(.., of)| is_counted(of));
        if is_outer {
            self.script.statements.push(Statement::Enter(number));
        }
        let start = short(self.script.statements.len());
        self.script.loops.push(Loop {
            statements: start..start,
            most,
            is_outer,
        });
        self.put(top);
        if may_pass {
            self.branch(end);
        }
        self.open.push(Block::Loop { top, end, number });
    }

    /// Ends a loop. `endless`: it is left by [`Self::leave_loop`] only.
    pub fn end_loop(&mut self, endless: bool) {
        let Some(&Block::Loop { top, end, number }) = self.open.last() else {
            return;
        };
        self.open.pop();
        if endless {
            self.jump(top);
        } else {
            self.branch(top);
        }
        self.end_rounds(number);
        self.put(end);
    }

    fn end_rounds(&mut self, number: u32) {
        self.script.loops[number as usize].statements.end = short(self.script.statements.len());
    }

    /// `END` of whatever block is open, where all end with the same word.
    pub fn end_block(&mut self) {
        if let Some(block) = self.open.pop() {
            self.end(&block);
        }
    }

    /// Ends what is open: a loop as one that may be left, or a choice.
    fn end(&mut self, block: &Block) {
        match *block {
            Block::Choice { next, end, .. } => {
                if let Some(next) = next {
                    self.put(next);
                }
                self.put(end);
            }
            Block::Loop { top, end, number } => {
                self.branch(top);
                self.end_rounds(number);
                self.put(end);
            }
        }
    }

    fn innermost_loop(&self) -> Option<(Label, Label, u32)> {
        self.open.iter().rev().find_map(|block| match block {
            Block::Loop { top, end, number } => Some((*top, *end, *number)),
            Block::Choice { .. } => None,
        })
    }

    /// `break` where it leaves what is innermost, a loop or a `switch`.
    pub fn leave_block(&mut self) {
        let end = self.open.iter().rev().find_map(|block| match block {
            Block::Loop { end, .. } => Some(*end),
            Block::Choice { end, is_switch, .. } => is_switch.then_some(*end),
        });
        if let Some(end) = end {
            self.jump(end);
        }
    }

    /// `EXIT`, `break`: behind the innermost loop.
    pub fn leave_loop(&mut self) {
        if let Some((_, end, _)) = self.innermost_loop() {
            self.jump(end);
        }
    }

    /// `continue`: the top of the innermost loop.
    pub fn repeat_loop(&mut self) {
        if let Some((top, ..)) = self.innermost_loop() {
            self.jump(top);
        }
    }

    fn named(&mut self, key: u64) -> Label {
        if let Some(label) = self.named.get(&key) {
            return *label;
        }
        let label = self.new_label();
        self.named.insert(key, label);
        label
    }

    /// A label of the text, by a key of the reader's own in this routine.
    pub fn label(&mut self, key: u64) {
        // what jumps here goes round without a count
        for block in &self.open {
            if let Block::Loop { number, .. } = block {
                self.script.loops[*number as usize].most = None;
            }
        }
        self.place(key);
    }

    /// Likewise one that only statements before it go to.
    pub fn place(&mut self, key: u64) {
        let label = self.named(key);
        self.put(label);
    }

    /// `GOTO`, `JMP LBL`.
    pub fn go_to(&mut self, key: u64) {
        let label = self.named(key);
        self.jump(label);
    }

    /// A jump that may be made, or not: `IF …, JMP LBL[…]`, `Skip,LBL[…]`.
    pub fn may_go_to(&mut self, key: u64) {
        let label = self.named(key);
        self.branch(label);
    }

    /// Back to the caller.
    pub fn back(&mut self) {
        self.script.statements.push(Statement::Return);
    }

    /// The routine ends with an error.
    pub fn raise(&mut self) {
        self.script.statements.push(Statement::Raise);
    }

    /// Where the program goes on if a routine that the last call runs ends with an error.
    pub fn catch(&mut self, key: u64) {
        let label = self.named(key);
        self.script.statements.push(Statement::Catch(label));
    }

    /// The program ends.
    pub fn exit(&mut self) {
        self.script.statements.push(Statement::Exit);
    }
}
