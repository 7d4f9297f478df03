//! Moves put between those of a program, and targets of their own for moves that share one.

use super::written::without_configuration;
use super::{Added, Compensation};
use crate::finding::Severity;
use crate::program::{
    Before, Edits, Insertion, Insertions, Language, Motion, Program, Replacements, Source, number,
};
use std::collections::{BTreeMap, BTreeSet};

impl Compensation {
    /// Puts moves and targets into a file, in the place of what was to be changed there; for each
    /// insertion whether its move can be written so. A move that was given a target of its own
    /// before keeps it, but for the point on the way of an arc that passes through other points now.
    pub fn insert(
        &mut self,
        language: &dyn Language,
        sources: &[Source],
        program: &Program,
        file: usize,
        insertions: &[Insertion],
    ) -> Vec<bool> {
        let of_file = |motion: &usize| program.moves[*motion].file as usize == file;
        let before: BTreeMap<usize, Insertion> = self
            .inserted
            .iter()
            .filter(|(motion, _)| of_file(motion))
            .map(|(motion, insertion)| (*motion, insertion.clone()))
            .collect();
        let mut wanted = before.clone();
        for insertion in insertions {
            let mut insertion = insertion.clone();
            let own = before.get(&insertion.motion).and_then(|b| b.own.clone());
            insertion.own = insertion.own.or(own);
            wanted.insert(insertion.motion, insertion);
        }
        // what cannot be written goes back to what was there before, if anything
        let (spans, elsewhere) = loop {
            let passed = |one: &&Insertion| !is_passed_elsewhere(program, &wanted, one);
            let list: Vec<Insertion> = wanted.values().filter(passed).cloned().collect();
            let text = language.insert(&Insertions {
                sources,
                program,
                file,
                list: &list,
            });
            let failed = list
                .iter()
                .zip(&text.moves)
                .filter(|(_, text)| text.is_none());
            let failed: Vec<usize> = failed.map(|(one, _)| one.motion).collect();
            if failed.is_empty() {
                let mut spans: Replacements = text.moves.into_iter().flatten().flatten().collect();
                spans.extend(text.rest);
                break (spans, text.elsewhere);
            }
            for motion in failed {
                let gone = wanted.remove(&motion);
                let earlier = before
                    .get(&motion)
                    .filter(|earlier| gone.as_ref() != Some(*earlier));
                wanted.extend(earlier.map(|earlier| (motion, earlier.clone())));
            }
        };
        let gone: Vec<usize> = wanted
            .values()
            .filter(|one| is_passed_elsewhere(program, &wanted, one))
            .map(|one| one.motion)
            .collect();
        wanted.retain(|motion, _| !gone.contains(motion));
        let is_done = |one: &Insertion| {
            let written = wanted.get(&one.motion);
            written.is_some_and(|written| written.between == one.between)
        };
        let done: Vec<bool> = insertions.iter().map(is_done).collect();
        let mut concerned: BTreeSet<usize> = self.put_into(file).collect();
        self.put_in.retain(|(from, _), _| *from != file);
        self.put_in.insert((file, file), spans);
        for (other, spans) in elsewhere {
            self.put_in.insert((file, other), spans);
        }
        concerned.extend(self.put_into(file));
        for file in concerned {
            self.put_together(file);
            self.compensated[file] |= done.contains(&true);
        }
        self.report_forms(language, &sources[file], program, &wanted);
        self.inserted.retain(|motion, _| !of_file(motion));
        self.inserted.extend(wanted);
        self.added = Added::default();
        for insertion in std::mem::take(&mut self.inserted).into_values() {
            self.count(language, program, &insertion);
            self.inserted.insert(insertion.motion, insertion);
        }
        done
    }

    /// Lines of forms that were written over: once a file.
    fn report_forms(
        &mut self,
        language: &dyn Language,
        source: &Source,
        program: &Program,
        written: &BTreeMap<usize, Insertion>,
    ) {
        let id = "form-overwritten";
        self.findings
            .retain(|finding| finding.id != id || finding.file != source.name);
        let moves = written.keys().map(|motion| &program.moves[*motion]);
        let mut forms: Vec<usize> = moves
            .map(|motion| motion.offset as usize)
            .filter(|at| language.is_in_form(&source.bytes, *at))
            .collect();
        forms.sort_unstable();
        let Some(first) = forms.first() else {
            return;
        };
        let message = format!(
            "targets were written into {} of this file (the first is here): Change on the pendant \
             writes the old lines again, and Touch-Up teaches a point that they no longer go to",
            match forms.len() {
                1 => "one inline form".to_owned(),
                count => format!("{count} inline forms"),
            }
        );
        let hint = "change and teach these points in the original program, and compensate it again";
        let finding = source.finding(*first, id, Severity::Note, message, hint);
        self.findings.push(finding);
    }

    /// The files that what is inserted for a file concerns.
    fn put_into(&self, file: usize) -> impl Iterator<Item = usize> {
        let of_file = self.put_in.keys().filter(move |(from, _)| *from == file);
        of_file.map(|(_, to)| *to)
    }

    /// The changes of a file with all that is put into it.
    fn put_together(&mut self, file: usize) {
        let untouched = self.untouched.entry(file);
        let mut edits = untouched
            .or_insert_with(|| self.edits[file].clone())
            .clone();
        let mut some = Edits::default();
        for (_, spans) in self.put_in.iter().filter(|((_, to), _)| *to == file) {
            for (span, text) in spans {
                edits.take_back(span);
                some.replace(span.clone(), |out| out.extend(text));
            }
        }
        edits.append(&some);
        self.edits[file] = edits;
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
        // its parts pass through other points
        let vias = program
            .before(motion)
            .iter()
            .filter_map(|before| match before {
                Before::One(via) => Some(&program.moves[*via as usize]),
                _ => None,
            });
        let vias = vias.filter(|via| is_arc && via.motion == Motion::ArcVia);
        self.added.freed.extend(vias.filter_map(|via| via.target));
        for (at, part) in insertion.between.iter().enumerate() {
            texts.extend(&part.via);
            // the last part of an arc ends at the move's own target
            if !is_arc || at + 1 < insertion.between.len() {
                texts.push(&part.end);
                self.added.moves += each;
                self.added.arcs += usize::from(is_arc);
            }
        }
        for text in texts {
            let value = |i: usize| number::parse(text[i].trim_ascii_start()).unwrap_or(f64::NAN);
            let numbers = without_configuration(language, target, value);
            self.added.targets.push(numbers);
        }
    }
}

/// Whether a target of its own for the point on the way of an arc is needed no more: the arc's parts
/// pass through other points.
fn is_passed_elsewhere(
    program: &Program,
    wanted: &BTreeMap<usize, Insertion>,
    one: &Insertion,
) -> bool {
    let via = &program.moves[one.motion];
    let mut arcs = wanted.values().filter(|other| other.is_arc());
    via.motion == Motion::ArcVia
        && arcs.any(|arc| program.moves[arc.motion].instruction == via.instruction + 1)
}
