//! Moves put between those of a program, and targets of their own for moves that share one.

use super::Compensation;
use super::written::without_configuration;
use crate::program::{Edits, Insertion, Language, Program, Replacements, Source, number};

impl Compensation {
    /// Puts moves and targets into a file, in the place of what was to be changed there; for each insertion whether its move
    /// can be written so.
    pub fn insert(
        &mut self,
        language: &dyn Language,
        sources: &[Source],
        program: &Program,
        file: usize,
        insertions: &[Insertion],
    ) -> Vec<bool> {
        let inserted = language.insert(sources, program, file, insertions);
        let mut spans: Replacements = Vec::new();
        let mut done = Vec::with_capacity(insertions.len());
        for (insertion, text) in insertions.iter().zip(inserted.moves) {
            done.push(text.is_some());
            let Some(text) = text else { continue };
            spans.extend(text);
            self.count(language, program, insertion);
        }
        spans.extend(inserted.rest);
        let mut some = Edits::default();
        for (span, text) in spans {
            self.edits[file].take_back(&span);
            some.replace(span, |out| out.extend(text));
        }
        self.edits[file].append(&some);
        self.compensated[file] |= done.contains(&true);
        done
    }

    fn count(&mut self, language: &dyn Language, program: &Program, insertion: &Insertion) {
        let motion = &program.moves[insertion.motion];
        let target = program
            .target_of(motion)
            .expect("inserted moves have a target");
        let is_arc = insertion.between.iter().any(|part| part.via.is_some());
        let each = if is_arc { 2 } else { 1 };
        let mut texts: Vec<&Vec<Vec<u8>>> = insertion.own.iter().collect();
        if insertion.own.is_some() {
            self.added.freed.extend(motion.target);
        }
        for (at, part) in insertion.between.iter().enumerate() {
            texts.extend(&part.via);
            // the last part of an arc ends at the move's own target
            if !is_arc || at + 1 < insertion.between.len() {
                texts.push(&part.end);
                self.added.moves += each;
            }
        }
        for text in texts {
            let value = |i: usize| number::parse(text[i].trim_ascii_start()).unwrap_or(f64::NAN);
            let numbers = without_configuration(language, target, value);
            self.added.targets.push(numbers);
        }
    }
}
