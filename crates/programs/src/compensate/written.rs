//! The files' new bytes: changes and marker put in, read again, and every number compared with what
//! was meant.

use super::{Added, Compensation};
use crate::program::script::Script;
use crate::program::{Edits, Language, Marker, Number, Role, Settings, Source, Target, number};
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// What is written does not read back as what was meant: a fault of this program.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{file}: what would be written does not read back as what was meant: {what}")]
pub struct Differs {
    /// The file.
    pub file: String,
    /// The difference.
    pub what: String,
}

/// Program files as they are to be written.
#[derive(Debug)]
pub struct Written {
    /// All files that were read, in their order.
    pub sources: Vec<Source>,
    /// Whether each is to be written: none that is read for its declarations only.
    pub is_written: Vec<bool>,
}

/// What files with their changes and markers must say when they are read again. Nothing may be put
/// in place before that.
#[derive(Debug)]
pub struct Check {
    /// What each file is to hold.
    meant: Vec<Meant>,
    added: Added,
    settings: Settings,
    /// How many moves there were; `None` where not all files are written.
    moves: Option<usize>,
}

impl Compensation {
    /// The files with their changes and markers, read again. Takes the compensation, so that a long
    /// program is not in memory twice.
    ///
    /// `only_good`: files that are refused, or share targets or calls with one that is, stay as
    /// they are.
    ///
    /// # Errors
    /// What is written would not read back, number by number, as what was meant.
    pub fn written(
        self,
        language: &dyn Language,
        sources: &[Source],
        profile_sha256: &str,
        only_good: bool,
    ) -> Result<Written, Differs> {
        let (written, check) = self.draft(language, sources, profile_sha256, only_good);
        check.read_again(&written, language)?;
        Ok(written)
    }

    /// As [`Compensation::written`], still to be read again.
    #[must_use]
    pub fn draft(
        mut self,
        language: &dyn Language,
        sources: &[Source],
        profile_sha256: &str,
        only_good: bool,
    ) -> (Written, Check) {
        let is_written: Vec<bool> = sources
            .iter()
            .zip(&self.refused)
            .map(|(source, refused)| !(source.is_context || only_good && *refused))
            .collect();
        let mut all_edits = Vec::with_capacity(sources.len());
        for (file, source) in sources.iter().enumerate() {
            let mut edits = std::mem::take(&mut self.edits[file]);
            if !is_written[file] {
                edits = Edits::default();
            } else if self.compensated[file] {
                let marker = Marker {
                    version: env!("CARGO_PKG_VERSION").into(),
                    profile_sha256: profile_sha256.into(),
                    source_sha256: std::mem::take(&mut self.source_sha256[file]),
                    decided: self.decided.clone(),
                };
                let (at, text) = language.mark(source, &marker);
                edits.insert(at, &text);
            }
            all_edits.push(edits);
        }
        let new_bytes = || -> Vec<Source> {
            let all = sources.iter().zip(&all_edits);
            let written = all.map(|(source, edits)| {
                let bytes = edits.apply(&source.bytes);
                if source.is_context {
                    Source::context(source.name.clone(), bytes)
                } else {
                    Source::new(source.name.clone(), bytes)
                }
            });
            written.collect()
        };
        let new_numbers = || -> Vec<Meant> {
            let program = &self.program;
            let numbers = numbers_by_file(&program.targets, &program.numbers, sources.len());
            let all = numbers.into_iter().zip(&all_edits);
            all.map(|(own, edits)| Meant::of(&self, own, edits))
                .collect()
        };
        let (written, meant) = rayon::join(new_bytes, new_numbers);
        let all_written = is_written
            .iter()
            .zip(sources)
            .all(|(is, s)| *is || s.is_context);
        let check = Check {
            meant,
            moves: all_written.then_some(self.program.instructions.len()),
            added: self.added,
            settings: self.settings,
        };
        let written = Written {
            sources: written,
            is_written,
        };
        // what was computed goes now, so that a long program is not in memory twice
        let done = (self.program, self.targets, all_edits);
        rayon::spawn(move || drop(done));
        (written, check)
    }
}

impl Check {
    /// Reads the files again and compares every number with what was meant.
    ///
    /// # Errors
    /// One differs: a fault of this program.
    pub fn read_again(self, written: &Written, language: &dyn Language) -> Result<(), Differs> {
        let sources = &written.sources;
        let differs = |file: usize, what: String| Differs {
            file: sources[file].name.clone(),
            what,
        };
        let after = language.script(sources, &self.settings);
        let after = after.map_err(|error| differs(0, error.to_string()))?;
        let mut new: Vec<Vec<f64>> = Vec::new();
        let found = numbers_by_file(&after.targets, &after.numbers, sources.len());
        for (file, (meant, found)) in self.meant.iter().zip(found).enumerate() {
            meant
                .compare(&after, (file, found), language, &mut new)
                .map_err(|what| differs(file, what))?;
        }
        if let Some(moves) = self.moves {
            let added = &self.added;
            if after.instructions.len() != moves + added.moves {
                let what = format!(
                    "{} moves where {} are meant",
                    after.instructions.len(),
                    moves + added.moves
                );
                return Err(differs(0, what));
            }
            let mut targets: Vec<&Vec<f64>> = added.targets.iter().collect();
            targets.sort_by(|a, b| order(a, b));
            new.sort_by(|a, b| order(a, b));
            if !targets.into_iter().eq(&new) {
                let what = format!("{} new targets are not those that are meant", new.len());
                return Err(differs(0, what));
            }
        }
        Ok(())
    }
}

fn order(a: &[f64], b: &[f64]) -> std::cmp::Ordering {
    let each = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
    each.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
        .then(a.len().cmp(&b.len()))
}

/// What one file is to hold.
#[derive(Debug)]
struct Meant {
    /// The numbers that stay and those that replace others, in the order of the file.
    numbers: Vec<f64>,
    /// Those of targets that no move goes to any more, by place in the list, and where they stand in
    /// the written file.
    freed: BTreeMap<usize, usize>,
    /// Text that is new, in the written file.
    new: Vec<Range<usize>>,
}

impl Meant {
    /// `numbers`: those of the file's targets, in its order.
    fn of(compensation: &Compensation, numbers: Vec<u32>, edits: &Edits) -> Self {
        let program = &compensation.program;
        let mut next = numbers.into_iter().peekable();
        let mut meant = Self {
            numbers: Vec::with_capacity(next.len()),
            freed: BTreeMap::new(),
            new: Vec::new(),
        };
        let freed = &compensation.added.freed;
        let freed: Vec<&Range<u32>> = freed.iter().map(|t| &program.targets[*t].numbers).collect();
        let start_of_freed = |index: u32| {
            let is_freed = freed.iter().any(|numbers| numbers.contains(&index));
            is_freed.then(|| program.numbers[index as usize].start as usize)
        };
        let computed = |index: u32| {
            let computed = &compensation.meant;
            let at = computed.binary_search_by_key(&index, |(index, _)| *index);
            at.ok().map(|at| computed[at].1)
        };
        // what is reported of a number counts where the file is written
        let kept = |index: u32| {
            let number = &program.numbers[index as usize];
            let put_in = computed(index).filter(|_| number.length == 0 && !edits.is_empty());
            put_in.unwrap_or(number.value)
        };
        let (mut behind, mut before) = (0, 0);
        // where numbers are put in that the text leaves out
        let mut missing = None;
        for (span, text) in edits.changes() {
            let start = crate::program::script::short(span.start);
            while let Some(index) = next.next_if(|i| {
                let number = &program.numbers[*i as usize];
                number.start < start || number.start == start && number.length == 0
            }) {
                if program.numbers[index as usize].length == 0 {
                    missing = Some(program.numbers[index as usize].start);
                }
                let start = start_of_freed(index).map(|start| start + behind - before);
                meant.keep(kept(index), start);
            }
            if span.is_empty() && missing == Some(start) {
                behind += text.len();
                continue;
            }
            let here = next.peek().copied().filter(|index| {
                let number = &program.numbers[*index as usize];
                number.start == start && usize::from(number.length) == span.len()
            });
            let at = span.start + behind - before;
            if let Some(index) = here.filter(|_| !span.is_empty()) {
                next.next();
                let value = computed(index).or_else(|| number::parse(text.trim_ascii_start()));
                // what is no number equals none
                let freed = start_of_freed(index).map(|_| at);
                meant.keep(value.unwrap_or(f64::NAN), freed);
            } else {
                while next
                    .next_if(|i| (program.numbers[*i as usize].start as usize) < span.end)
                    .is_some()
                {}
                if !text.is_empty() {
                    meant.new.push(at..at + text.len());
                }
            }
            behind += text.len();
            before += span.len();
        }
        for index in next {
            let start = start_of_freed(index).map(|start| start + behind - before);
            meant.keep(kept(index), start);
        }
        meant
    }

    /// `freed`: where a number stands that no move needs any more.
    fn keep(&mut self, number: f64, freed: Option<usize>) {
        if let Some(start) = freed {
            self.freed.insert(self.numbers.len(), start);
        }
        self.numbers.push(number);
    }

    /// Compares with what was read again: a file and the numbers of its targets. Adds the numbers
    /// of new targets.
    fn compare(
        &self,
        after: &Script,
        (file, mut found): (usize, Vec<u32>),
        language: &dyn Language,
        new: &mut Vec<Vec<f64>>,
    ) -> Result<(), String> {
        let is_new = |offset: u32| {
            let behind = self
                .new
                .partition_point(|range| range.end <= offset as usize);
            self.new
                .get(behind)
                .is_some_and(|range| range.contains(&(offset as usize)))
        };
        if !self.new.is_empty() {
            found.retain(|index| !is_new(after.numbers[*index as usize].start));
            let of_file = after.targets.iter().filter(|t| t.file as usize == file);
            for target in of_file {
                let numbers =
                    &after.numbers[target.numbers.start as usize..target.numbers.end as usize];
                if numbers.first().is_some_and(|first| is_new(first.start)) {
                    new.push(without_configuration(language, target, |i| {
                        numbers[i].value
                    }));
                }
            }
        }
        // a language may know no target that nothing goes to
        let starts = |index: &u32| after.numbers[*index as usize].start as usize;
        let is_gone = |start: &usize| found.binary_search_by_key(start, starts).is_err();
        let all_there = found.len() == self.numbers.len();
        let freed = self.freed.iter().filter(|_| !all_there);
        let gone = freed.filter(|(_, start)| is_gone(start));
        let gone: BTreeSet<usize> = gone.map(|(at, _)| *at).collect();
        if found.len() + gone.len() != self.numbers.len() {
            return Err(format!(
                "{} numbers where {} are meant",
                found.len(),
                self.numbers.len() - gone.len()
            ));
        }
        let numbers = if gone.is_empty() {
            Cow::from(&self.numbers)
        } else {
            let meant = self.numbers.iter().enumerate();
            let meant = meant.filter(|(at, _)| !gone.contains(at));
            meant.map(|(_, meant)| *meant).collect()
        };
        let pairs = found.par_iter().zip(&*numbers);
        let wrong = pairs.find_first(|(index, meant)| {
            // what is no number equals none
            after.numbers[**index as usize].value != **meant
        });
        match wrong {
            None => Ok(()),
            Some((index, meant)) => {
                let number = &after.numbers[*index as usize];
                Err(format!(
                    "{} at byte {} where {meant} is meant",
                    number.value, number.start
                ))
            }
        }
    }
}

/// The numbers of a target in the order of its roles; 0 for configuration data.
pub(super) fn without_configuration(
    language: &dyn Language,
    target: &Target,
    value: impl Fn(usize) -> f64,
) -> Vec<f64> {
    let roles = language.roles(target.layout).iter().enumerate();
    roles
        .map(|(i, role)| match role {
            Role::Configuration => 0.0,
            _ => value(i),
        })
        .collect()
}

/// The numbers of each file's targets in the order of the file, each place once.
fn numbers_by_file(targets: &[Target], numbers: &[Number], files: usize) -> Vec<Vec<u32>> {
    let start = |index: &u32| numbers[*index as usize].start;
    // mostly one file has the numbers in their order
    let follow = |pair: &[Target]| pair[0].numbers.end == pair[1].numbers.start;
    let is_in_order = files == 1
        && targets.par_windows(2).all(follow)
        && numbers
            .par_windows(2)
            .all(|pair| pair[0].start < pair[1].start);
    if let (true, [first, .., last]) = (is_in_order, targets) {
        return vec![(first.numbers.start..last.numbers.end).collect()];
    }
    let mut room = vec![0; files];
    for target in targets {
        room[target.file as usize] += target.numbers.len();
    }
    let mut all: Vec<Vec<u32>> = room.into_iter().map(Vec::with_capacity).collect();
    // mostly they come in the order of the file, or those of each target next to each other
    let mut last = vec![None; files];
    let mut in_order = vec![true; files];
    for target in targets {
        let file = target.file as usize;
        let from = all[file].len();
        all[file].extend(target.numbers.clone());
        let own = &mut all[file][from..];
        if !own.is_sorted_by_key(start) {
            own.sort_by_key(start);
        }
        for index in own {
            let next = Some(start(index));
            in_order[file] &= last[file] < next;
            last[file] = next;
        }
    }
    for (found, in_order) in all.iter_mut().zip(in_order) {
        if in_order {
            continue;
        }
        found.sort_by_key(start);
        // numbers that the text leaves out may belong to one place
        let is_there = |index: &u32| numbers[*index as usize].length > 0;
        found.dedup_by(|a, b| start(a) == start(b) && is_there(a) && is_there(b));
    }
    all
}
