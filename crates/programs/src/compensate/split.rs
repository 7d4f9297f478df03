//! Targets written out at each of their moves, where one set of numbers does not serve all.

use super::Job;
use super::approach::Solved;
use super::outcome::TargetReport;
use super::rewrite::{Portion, ROUNDING_LIMIT, largest, text, uncorrected, worst};
use super::shared::{self, Fake};
use crate::finding::Finding;
use crate::geometry::Separation;
use crate::motion::walk::NOWHERE;
use crate::program::number::Fraction;
use crate::program::script::Expr;
use crate::program::{Insertion, Move, Program};
use std::collections::{BTreeMap, BTreeSet};

/// A move that is to get a target of its own, and what is said where its text cannot have one.
#[derive(Clone, Debug)]
pub(super) struct Split {
    pub insertion: Insertion,
    /// The controller's joints there.
    pub joints: [f64; 6],
    pub refusal: Finding,
}

/// What speaks against writing a target out at each of its moves: what to do instead.
pub(super) fn obstacle(
    job: &Job,
    bases: &BTreeSet<usize>,
    group: &[Solved],
) -> Option<&'static str> {
    let (program, sources) = (job.ground.program, job.ground.sources);
    if bases.contains(&(group[0].approach.target as usize)) {
        return Some(
            "give each use a target of its own: the program derives points from this one, and \
             --split-targets leaves such a target whole",
        );
    }
    for solved in group {
        if solved.approach.motion == NOWHERE {
            return Some("give each use a target of its own");
        }
        let motion = &program.moves[solved.approach.motion as usize];
        if sources[motion.file as usize].is_context {
            return Some(
                "give each use a target of its own: one of these moves stands in a file that is \
                 only read, where --split-targets writes nothing",
            );
        }
        if !goes_to_one(program, motion) {
            return Some(
                "give each use a target of its own: one of these moves goes to it by a parameter or an \
                 index, or by a variable that another routine writes, and --split-targets leaves such \
                 moves as they are",
            );
        }
    }
    None
}

/// Whether the text of a move goes to its target, or a copy of that, whoever runs it: not to what a call
/// gives or what an index chooses.
fn goes_to_one(program: &Program, motion: &Move) -> bool {
    let instruction = &program.instructions[motion.instruction as usize];
    !motion.is_given && matches!(instruction.target, Expr::Target(_) | Expr::Variable(_))
}

impl Portion<'_> {
    /// Gives each of the moves a target of its own; false where one of them cannot be served alone.
    pub(super) fn split(
        &mut self,
        job: &Job,
        group: &[Solved],
        fractions: &[Fraction],
        refusal: &Finding,
        report: &mut TargetReport,
    ) -> bool {
        let target = group[0].approach.target as usize;
        let moves = &job.ground.program.moves;
        let mut each: BTreeMap<u32, Vec<Solved>> = BTreeMap::new();
        for one in group {
            let instruction = moves[one.approach.motion as usize].instruction;
            each.entry(instruction).or_default().push(*one);
        }
        let numbers = job
            .ground
            .program
            .numbers_of(&job.ground.program.targets[target]);
        let mut splits = Vec::with_capacity(each.len());
        let [mut shifted, mut before, mut after] = [Separation::default(); 3];
        for alone in each.values() {
            let Ok(fake) = shared::common(job, alone) else {
                return false;
            };
            let approach = alone[0].approach;
            let frame = job.ground.placed(approach.frame as usize).nominal;
            let meant = alone[0].meant(job);
            let shift = meant.separation(&(frame * approach.taken(fake.frame_from_tool)));
            if let Some((finding, needed)) = job.limits.judge(job, approach, &shift) {
                self.findings.push(finding);
                self.needed = largest(self.needed, needed);
                return false;
            }
            shifted = largest(shifted, shift);
            let Some(written) = self.written(job, approach, &fake, fractions) else {
                return false;
            };
            let meant = Fake::meant(job, approach, &written.numbers);
            let [landed, passed] = shared::landings(job, alone, &meant);
            self.findings.extend(shared::passed(job, approach, &passed));
            if landed.distance_m > ROUNDING_LIMIT.distance_m
                || landed.angle_rad > ROUNDING_LIMIT.angle_rad
            {
                return false;
            }
            let own = worst(alone.iter().map(|solved| uncorrected(job, solved)));
            (before, after) = (largest(before, own), largest(after, landed));
            let target = &job.ground.program.targets[target];
            let mut texts: Vec<Vec<u8>> = numbers
                .iter()
                .map(|number| text(job, target, number).trim_ascii().to_vec())
                .collect();
            for (index, _, digits) in &written.texts {
                texts[*index] = match numbers[*index].length {
                    0 => written.numbers[*index].to_string().into_bytes(),
                    _ => written.digits[digits.clone()].trim_ascii().to_vec(),
                };
            }
            splits.push(Split {
                insertion: Insertion {
                    motion: approach.motion as usize,
                    between: Vec::new(),
                    own: Some(texts),
                },
                joints: fake.q,
                refusal: refusal.clone(),
            });
        }
        report.changed = true;
        report.shift = shifted;
        (report.before, report.rounding) = (Some(before), Some(after));
        self.splits.extend(splits);
        true
    }
}
