//! Which moves may run while a shift (`SFTON`) is on.
//!
//! The flow of each job is followed with one bit: a shift may be on. Branches and loops join, labels take what any jump
//! brings, and a call hands the bit to the job it calls and takes what that leaves behind. The bit is only ever too often
//! on.

use super::instruction::Event;
use super::job::Job;
use std::collections::HashMap;

/// Times that all jobs are gone through before every job is taken to run shifted: jobs that hand on a shift in a chain.
const MOST_ROUNDS: usize = 12;

/// What is known of one job.
#[derive(Clone, Copy, Default)]
struct Flow {
    /// It may be entered with a shift on.
    entry: bool,
    /// It may leave one on.
    exit: bool,
    /// A jump or the end of a loop may bring one to a label.
    jumps: bool,
}

/// For each job and each of its events: a shift may be on.
pub fn active(jobs: &[Job]) -> Vec<Vec<bool>> {
    let any = jobs
        .iter()
        .flat_map(|job| &job.events)
        .any(|event| matches!(event, Event::ShiftOn));
    if !any {
        return jobs.iter().map(|_| Vec::new()).collect();
    }
    let names: HashMap<&[u8], usize> = jobs.iter().map(|job| job.name).zip(0..).collect();
    let mut flows = vec![Flow::default(); jobs.len()];
    let mut states: Vec<Vec<bool>> = jobs.iter().map(|_| Vec::new()).collect();
    for round in 0..=MOST_ROUNDS {
        let mut changed = false;
        if round == MOST_ROUNDS {
            let all = Flow {
                entry: true,
                exit: true,
                jumps: true,
            };
            flows.fill(all);
        }
        for index in 0..jobs.len() {
            changed |= follow(jobs, index, &names, &mut flows, &mut states[index]);
        }
        if !changed {
            break;
        }
    }
    states
}

/// An open IF, SWITCH or loop: the bit before it, and that at the end of its branches so far.
struct Block {
    before: bool,
    branches: bool,
}

/// Goes through one job; whether anything new came out.
fn follow(
    jobs: &[Job],
    index: usize,
    names: &HashMap<&[u8], usize>,
    flows: &mut [Flow],
    state: &mut Vec<bool>,
) -> bool {
    let mut flow = flows[index];
    let mut on = flow.entry;
    let mut blocks: Vec<Block> = Vec::new();
    let mut changed = false;
    state.clear();
    for event in &jobs[index].events {
        match event {
            Event::ShiftOn => on = true,
            Event::ShiftOff => on = false,
            Event::Label => on |= flow.jumps,
            Event::Jump => flow.jumps |= on,
            Event::Return => flow.exit |= on,
            Event::Call { job } => {
                if let Some(&called) = names.get(job) {
                    if called == index {
                        flow.entry |= on;
                        on |= flow.exit;
                    } else {
                        changed |= on && !flows[called].entry;
                        flows[called].entry |= on;
                        on |= flows[called].exit;
                    }
                }
            }
            Event::OpenBlock { is_loop } => {
                let before = on;
                on |= *is_loop && flow.jumps;
                blocks.push(Block {
                    before,
                    branches: before,
                });
            }
            Event::NextBranch => {
                if let Some(block) = blocks.last_mut() {
                    block.branches |= on;
                    on = block.before;
                }
            }
            Event::CloseBlock { is_loop } => {
                flow.jumps |= *is_loop && on;
                if let Some(block) = blocks.pop() {
                    on |= block.branches;
                }
            }
            _ => {}
        }
        state.push(on);
    }
    flow.exit |= on;
    let old = flows[index];
    // what this job handed to itself is in `flow` already
    flows[index] = Flow {
        entry: flow.entry | old.entry,
        ..flow
    };
    changed || (flow.entry, flow.exit, flow.jumps) != (old.entry, old.exit, old.jumps)
}
