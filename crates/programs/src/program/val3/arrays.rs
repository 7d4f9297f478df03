//! Arrays that programs are given: their elements are bound one by one.

use super::code::Reference;
use super::project::Declared;
use super::reader::{Reader, functions};
use super::remarks::{COMPUTED, UNFOLLOWED};
use super::targets::{Known, Of};
use crate::program::TargetId;
use crate::program::script::{Argument, Expr, RoutineId, TableId, VariableId};
use crate::program::words::Words;
use foldhash::{HashMap, HashSet};
use std::collections::BTreeSet;

/// Elements of an array that are followed each.
const MOST_ELEMENTS: usize = 32;
/// Their keys in arrays of a program's own.
const KEYS: [&[u8]; MOST_ELEMENTS] = [
    b"0", b"1", b"2", b"3", b"4", b"5", b"6", b"7", b"8", b"9", b"10", b"11", b"12", b"13", b"14",
    b"15", b"16", b"17", b"18", b"19", b"20", b"21", b"22", b"23", b"24", b"25", b"26", b"27",
    b"28", b"29", b"30", b"31",
];

/// What is known of arrays that calls give.
#[derive(Debug, Default)]
pub(super) struct Arrays<'a> {
    /// Keys of the elements that a parameter may be given.
    given: HashMap<(RoutineId, &'a [u8]), BTreeSet<&'a [u8]>>,
    /// Tables of arrays whose elements are not followed.
    unfollowed: HashSet<TableId>,
}

impl<'a> Reader<'a> {
    /// The keys of the elements that a name may have; `None` where they are too many.
    pub(super) fn keys(&self, known: Known, name: &[u8]) -> Option<Vec<&'a [u8]>> {
        let routine = match known.of {
            Of::Project(datum) => {
                let is_written = self.assigned.contains_key(&datum);
                let all = self.world.data[datum as usize].elements.iter();
                // spare ones that were never taught are left out
                let used = all.filter(|one| one.is_given || is_written || !known.kind.is_place());
                let keys: Vec<_> = used.map(|one| one.key).collect();
                return (keys.len() <= MOST_ELEMENTS).then_some(keys);
            }
            Of::Program(routine) => routine,
        };
        let mut declared = self.world.programs[routine as usize].declared.iter();
        let declared = declared.find(|one| one.name == name)?;
        if declared.is_parameter {
            let given = self.arrays.given.get(&(routine, declared.name));
            return Some(given.into_iter().flatten().copied().collect());
        }
        let keys = KEYS.get(..declared.size.max(1) as usize)?;
        Some(keys.iter().map(|key| -> &'a [u8] { key }).collect())
    }

    /// Notes which elements the parameters of programs may be given; whether any is new.
    pub(super) fn note_given(&mut self, line: Words<'a, '_>) {
        for at in functions(line) {
            let Some((Some(callee), _)) = self.callee(line, at) else {
                continue;
            };
            for (number, given) in line.inside(at + 1).0.list().into_iter().enumerate() {
                let parameter = self.parameter(callee, number).filter(|one| one.is_array);
                let (Some(parameter), Some(name)) = (parameter, whole_array(given)) else {
                    continue;
                };
                let known = self.meaning(&name);
                let keys = known.and_then(|known| self.keys(known, name.name));
                let parameter = (callee, parameter.name);
                let known = self.arrays.given.entry(parameter).or_default();
                let before = known.len();
                known.extend(keys.unwrap_or_default());
                self.is_settled &= known.len() == before;
            }
        }
    }

    /// Gives an array to a parameter, element by element; whether they are followed.
    pub(super) fn give_array(
        &mut self,
        (callee, parameter): (RoutineId, Declared<'a>),
        given: Words<'a, '_>,
        arguments: &mut Vec<Argument>,
    ) -> bool {
        let array = whole_array(given);
        let known = array.and_then(|array| Some((self.meaning(&array)?, array)));
        let keys = known.and_then(|(known, array)| self.keys(known, array.name));
        let all = self.arrays.given.get(&(callee, parameter.name)).cloned();
        for key in all.unwrap_or_default() {
            let own = self.local_element(callee, parameter.name, key);
            let is_given = keys.as_ref().is_some_and(|keys| keys.contains(&key));
            let of = known.filter(|_| is_given);
            let variable = of.map(|(known, _)| self.element(known, key));
            let value = match variable {
                Some(variable) => Expr::Variable(variable),
                // what another call gave is there no more
                None => self.unknown(COMPUTED),
            };
            self.copies.entry(own).or_default().extend(variable);
            arguments.push(Argument::new(
                Some(own),
                value,
                variable.filter(|_| parameter.by_reference),
            ));
        }
        if keys.is_none() {
            self.do_not_follow(given);
        }
        keys.is_some()
    }

    /// Gives all elements of an array to a program that the files do not have.
    pub(super) fn give_away(&mut self, given: Words<'a, '_>, arguments: &mut Vec<Argument>) {
        let array = whole_array(given);
        let known = array.and_then(|array| Some((self.meaning(&array)?, array)));
        let Some((known, array)) = known else { return };
        match self.keys(known, array.name) {
            Some(keys) => {
                // the first is given already
                for key in keys.into_iter().filter(|key| *key != b"0") {
                    let value = Expr::Variable(self.element(known, key));
                    arguments.push(Argument::new(None, value, None));
                }
            }
            None => self.do_not_follow(given),
        }
    }

    /// The targets of an array stay as they are.
    fn do_not_follow(&mut self, given: Words<'a, '_>) {
        let known = Reference::of(given).and_then(|name| Some((self.meaning(&name)?, name)));
        if let Some((known, name)) = known {
            let table = self.all(known, name.name);
            self.arrays.unfollowed.insert(table);
        }
    }

    /// Refuses the targets of arrays that are not followed, once all copies are known.
    pub(super) fn refuse_arrays(&mut self) {
        let mut open: Vec<_> = Vec::new();
        for table in &self.arrays.unfollowed {
            let entries = &self.builder.script.tables[*table as usize].entries;
            open.extend(entries.values().copied());
        }
        for target in self.declared_targets(open) {
            self.builder.script.refuse(target, UNFOLLOWED);
        }
    }

    /// The targets that variables, or those that they may be copies of, are declared with.
    pub(super) fn declared_targets(&self, mut open: Vec<VariableId>) -> Vec<TargetId> {
        let (mut seen, mut found) = (HashSet::default(), Vec::new());
        while let Some(variable) = open.pop() {
            if !seen.insert(variable) {
                continue;
            }
            open.extend(self.copies.get(&variable).into_iter().flatten());
            let declared = self.builder.script.variables[variable as usize].declared;
            if let Expr::Target(target) = declared {
                found.push(target);
            }
        }
        found
    }
}

/// The array that words name as a whole: `p`, or `p[0]`.
fn whole_array<'a>(words: Words<'a, '_>) -> Option<Reference<'a>> {
    Reference::whole(words).filter(|name| name.key == Some(b"0"))
}
