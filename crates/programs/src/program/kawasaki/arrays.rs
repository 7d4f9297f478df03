//! Arrays that programs are handed as a whole: their elements are bound one by one.

use super::calls::{Handed, stem_of};
use super::reader::Reader;
use super::remarks::UNFOLLOWED;
use super::targets::Name;
use crate::program::script::{Expr, RoutineId};
use foldhash::HashMap;
use std::collections::BTreeSet;

/// Elements of an array that are followed each.
const MOST_ELEMENTS: usize = 32;

/// Keys of elements, in the order of the text.
type Keys = BTreeSet<Vec<u8>>;
/// Keys of the elements that a parameter may be given, by program and name.
pub(super) type Given = HashMap<(RoutineId, Vec<u8>), Keys>;

/// Whether a name is that of a whole array: `p[]`, `p[,]`.
pub(super) fn is_array(name: &Name) -> bool {
    let key = name.key.as_deref().unwrap_or_default();
    key.starts_with(b"[") && !key.iter().any(u8::is_ascii_digit)
}

impl Reader<'_> {
    /// Notes which elements of arrays programs are handed, and makes them those of the parameters.
    pub(super) fn note_arrays(&mut self, handed: &[Handed]) {
        let arrays = || handed.iter().filter(|one| is_array(&one.name));
        let mut is_settled = false;
        while !std::mem::replace(&mut is_settled, true) {
            for one in arrays() {
                let keys = self.keys_of(&one.name, one.by).unwrap_or_default();
                for callee in self.programs_of(&one.to) {
                    let parameter = self.parameters[callee as usize].get(one.number);
                    let Some(parameter) = parameter else { continue };
                    let given = (callee, stem_of(parameter, &one.name));
                    let known = self.given.entry(given).or_default();
                    let before = known.len();
                    known.extend(keys.iter().cloned());
                    is_settled &= known.len() == before;
                }
            }
        }
        let mut all: Vec<_> = self.given.clone().into_iter().collect();
        all.sort_unstable();
        for ((routine, stem), keys) in all {
            for key in keys {
                self.parameter(routine, stem.clone(), key);
            }
        }
    }

    /// The keys of the elements of a name that a program uses; `None` where they are too many.
    fn keys_of(&self, name: &Name, by: RoutineId) -> Option<Keys> {
        let plain = name.plain();
        let own = &self.parameters[by as usize];
        if own.iter().any(|parameter| parameter == plain) {
            let given = self.given.get(&(by, name.stem.clone()));
            return Some(given.cloned().unwrap_or_default());
        }
        let owner = plain.starts_with(b".").then_some(by);
        let elements = self
            .names
            .get(&owner)
            .and_then(|names| names.get(&name.stem));
        let keys = elements.into_iter().flat_map(|of| of.variables.keys());
        let keys: Keys = keys.filter(|key| !key.is_empty()).cloned().collect();
        (keys.len() <= MOST_ELEMENTS).then_some(keys)
    }

    /// The elements of an array that is handed over as a whole, by key.
    pub(super) fn elements_given(&mut self, name: &Name) -> Vec<(Vec<u8>, Expr)> {
        let keys = self.keys_of(name, self.here.routine);
        if keys.is_none()
            && let Some(table) = self.table(name)
        {
            // they are not followed, and stay as they are
            self.builder.script.refuse_all(table, UNFOLLOWED);
        }
        let mut found = Vec::new();
        for key in keys.unwrap_or_default() {
            let variable = self.variable(&Name {
                stem: name.stem.clone(),
                key: Some(key.clone()),
            });
            found.push((key, Expr::Variable(variable)));
        }
        found
    }
}
