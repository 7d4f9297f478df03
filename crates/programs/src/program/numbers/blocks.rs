//! Where in its routine a number is written: in which blocks, and behind what.

use super::flow::{Flow, Kind};

/// A block of statements, by its place in its routine; how often it runs at most, where the text
/// tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    pub(super) number: u32,
    pub(super) most: Option<u32>,
}

/// Where a number is written.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct Site {
    pub(super) routine: u32,
    pub(super) order: u32,
    /// Outermost first.
    pub(super) blocks: Vec<Block>,
    /// In [`Flow`]; `None` where the routine begins.
    pub(super) step: Option<u32>,
}

impl Site {
    /// Where a routine begins.
    pub(in crate::program) fn at_start(routine: u32) -> Self {
        Self {
            routine,
            order: 0,
            blocks: Vec::new(),
            step: None,
        }
    }
}

/// The blocks around the present statement.
#[derive(Clone, Debug, Default)]
pub(in crate::program) struct Blocks {
    routine: u32,
    order: u32,
    open: Vec<Block>,
    /// Where the routine goes.
    pub(in crate::program) flow: Flow,
}

impl Blocks {
    /// A routine begins.
    pub(in crate::program) fn begin(&mut self, routine: u32) {
        (self.routine, self.order) = (routine, 0);
        self.open.clear();
        self.flow = Flow::default();
    }

    /// A block begins: a loop, or one of several branches, which run once.
    pub(in crate::program) fn open(&mut self, most: Option<u32>) {
        if most == Some(1) {
            self.open_branch();
        } else {
            self.open_loop(most);
        }
    }

    /// A branch begins. The step of [`Flow`] from which its statements are the next.
    pub(in crate::program) fn open_branch(&mut self) -> u32 {
        self.begin_block(Some(1), Kind::Choice)
    }

    /// Likewise one of several branches that a statement leaves.
    pub(in crate::program) fn open_switch(&mut self) {
        self.begin_block(Some(1), Kind::Switch);
    }

    /// Likewise a loop, also one that the text says runs once.
    pub(in crate::program) fn open_loop(&mut self, most: Option<u32>) -> u32 {
        self.begin_block(most, Kind::Loop)
    }

    fn begin_block(&mut self, most: Option<u32>, kind: Kind) -> u32 {
        self.order += 1;
        let number = self.order;
        self.open.push(Block { number, most });
        self.flow.open(kind)
    }

    /// The block that began last, by its routine and number.
    pub(in crate::program) fn last(&self) -> (u32, u32) {
        (
            self.routine,
            self.open.last().map_or(0, |block| block.number),
        )
    }

    /// The routine, how much of it stands before, and the blocks that are open.
    pub(super) fn here(&self) -> (u32, u32, &[Block]) {
        (self.routine, self.order, &self.open)
    }

    /// Another branch begins.
    pub(in crate::program) fn branch(&mut self) {
        self.open.pop();
        self.order += 1;
        let number = self.order;
        self.open.push(Block {
            number,
            most: Some(1),
        });
        self.flow.branch();
    }

    pub(in crate::program) fn close(&mut self) {
        self.open.pop();
        self.flow.close();
    }

    /// A loop ends with a condition. The step of [`Flow`] from which what is behind it is the next; else it
    /// begins again.
    pub(in crate::program) fn close_or_repeat(&mut self) -> Option<u32> {
        self.open.pop();
        self.flow.close_or_repeat()
    }

    pub(in crate::program) fn site(&mut self) -> Site {
        self.order += 1;
        Site {
            routine: self.routine,
            order: self.order,
            blocks: self.open.clone(),
            step: Some(self.flow.write()),
        }
    }
}
