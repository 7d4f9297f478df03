//! Arrays of targets: with values in the files, or without any.

use super::resolved::Entity;
use super::syntax::{Element, Index, Part, Storage, Stored, Type, indices};
use super::translate::Translator;
use super::values::DEEPEST;
use crate::program::names::Symbol;
use crate::program::script::{Expr, How, TableId, VariableId, Written, short};

/// Elements without values of an array that are distinguished by an index that is not constant.
const MOST_ELEMENTS: usize = 64;

impl Translator<'_> {
    /// The position that a declaration with an index means.
    pub(super) fn position_of(
        &mut self,
        datum: u32,
        index: Index,
        wanted: Type,
        depth: u32,
    ) -> Expr {
        let declared = *self.resolved.datum(datum);
        if !declared.kind.is_target() {
            return self.not_in_files(declared.name, wanted);
        }
        let entity = Entity::Declared(datum);
        let Stored::Elements { elements, sizes } = declared.value else {
            let holds = self.computed_name(declared.name);
            let parameter = matches!(declared.storage, Storage::Parameter { .. });
            if parameter || self.resolved.is_written(entity) {
                return self.without_value(entity, index, holds);
            }
            return holds;
        };
        match index {
            Index::At(place) => match element(place, sizes, elements) {
                Some(one) => self.element(datum, one, depth),
                None => self.computed_name(declared.name),
            },
            Index::Whole | Index::Variable if elements.1 - elements.0 == 1 => {
                self.element(datum, elements.0, depth)
            }
            Index::Whole | Index::Variable => {
                let known = self.lists.get(&entity).copied();
                let (first, end) = known.unwrap_or_else(|| {
                    let all: Vec<Expr> = (elements.0..elements.1)
                        .map(|one| self.element(datum, one, depth))
                        .collect();
                    self.list(entity, all)
                });
                Expr::Any { first, end }
            }
        }
    }

    /// The list of what an array holds.
    fn list(&mut self, entity: Entity, all: Vec<Expr>) -> (u32, u32) {
        let Expr::Any { first, end } = self.builder.script.any(all) else {
            return (0, 0);
        };
        self.lists.insert(entity, (first, end));
        (first, end)
    }

    /// An element of a declaration, by its index in the parsed.
    fn element(&mut self, datum: u32, element: u32, depth: u32) -> Expr {
        let declared = *self.resolved.datum(datum);
        let entity = Entity::Declared(datum);
        let is_written = self.resolved.is_written(entity);
        let key = (entity, element);
        if is_written && let Some(&known) = self.variables.get(&key) {
            return Expr::Variable(known);
        }
        let holds = match self.resolved.parsed.elements[element as usize] {
            Element::Target(target) if self.is_dead(target) => {
                if is_written || declared.storage != Storage::Constant {
                    self.computed_name(declared.name)
                } else {
                    self.blank_constant(declared.name)
                }
            }
            Element::Target(target) => Expr::Target(target),
            Element::Named(_) | Element::Composed(_) if depth > DEEPEST => self.computed(),
            Element::Named(other) => self.position_in(
                other,
                Index::Whole,
                declared.kind,
                declared.context,
                depth + 1,
            ),
            Element::Composed(composed) => self.composed_apart(composed),
            Element::Computed => self.computed_name(declared.name),
        };
        if is_written {
            return Expr::Variable(self.variable(entity, element, holds));
        }
        holds
    }

    // ---- data without values in the files

    fn name_of(&self, entity: Entity) -> Symbol {
        match entity {
            Entity::Declared(datum) => self.resolved.datum(datum).name,
            Entity::Undeclared(name) => name,
        }
    }

    /// Whether it is an array whose elements are distinguished by how statements name them.
    fn is_array(&self, entity: Entity) -> bool {
        match entity {
            Entity::Declared(datum) => self.resolved.datum(datum).value == Stored::Computed,
            Entity::Undeclared(name) => self.resolved.parsed.places_of(name).next().is_some(),
        }
    }

    /// The number of the element that an index with constants names.
    fn number_of(&self, entity: Entity, index: Index) -> Option<u32> {
        let Index::At(place) = index else {
            return None;
        };
        let key = (self.name_of(entity), place);
        let number = self.resolved.parsed.places.get(&key).copied();
        number.filter(|_| self.is_array(entity))
    }

    /// Whether a write with this index leaves nothing of what its variable held before.
    pub(super) fn is_one(&self, entity: Entity, index: Index) -> bool {
        if let Entity::Declared(datum) = entity
            && let Stored::Elements { elements, .. } = self.resolved.datum(datum).value
        {
            return matches!(index, Index::At(_)) || elements.1 - elements.0 == 1;
        }
        self.number_of(entity, index).is_some() || index == Index::Whole && !self.is_array(entity)
    }

    /// What data hold that have no values in the files: elements that statements name by constants
    /// are a variable each, all others are one. `holds` is what nothing has written.
    pub(super) fn without_value(&mut self, entity: Entity, index: Index, holds: Expr) -> Expr {
        if let Some(number) = self.number_of(entity, index)
            && let Index::At(place) = index
        {
            return Expr::Variable(self.named_element(entity, place, number, holds));
        }
        if let Some(&(first, end)) = self.lists.get(&entity) {
            return Expr::Any { first, end };
        }
        if self.is_large(entity) {
            return Expr::Variable(self.variable(entity, 0, Expr::Absent));
        }
        let all = self.variables_of(entity, holds);
        if let [one] = all[..] {
            return Expr::Variable(one);
        }
        let (first, end) = self.list(entity, all.into_iter().map(Expr::Variable).collect());
        Expr::Any { first, end }
    }

    fn named_element(
        &mut self,
        entity: Entity,
        place: [u32; 3],
        number: u32,
        holds: Expr,
    ) -> VariableId {
        if let Some(&known) = self.variables.get(&(entity, number)) {
            return known;
        }
        let name = element_name(self.resolved.spelling(self.name_of(entity)), place);
        // what a routine fills is what it writes
        let holds = if self.resolved.is_filled(entity) {
            Expr::Absent
        } else {
            holds
        };
        let made = self.variable(entity, number, holds);
        self.builder.script.variables[made as usize].name = name.into();
        if self.is_large(entity) {
            let gathered = self.gathered(entity);
            self.gathers.insert(made, gathered);
        }
        made
    }

    /// Whether an array without values has more elements than an index that is not constant
    /// distinguishes. Its number 0 then holds what any of them has held: that is what such an index
    /// reads.
    fn is_large(&self, entity: Entity) -> bool {
        let mut places = self.resolved.parsed.places_of(self.name_of(entity));
        self.is_array(entity) && places.nth(MOST_ELEMENTS).is_some()
    }

    /// The table of number 0 alone: what is written there is added to what it holds.
    fn gathered(&mut self, entity: Entity) -> TableId {
        if let Some(&known) = self.gathered.get(&entity) {
            return known;
        }
        let all = self.variable(entity, 0, Expr::Absent);
        let name = self.resolved.spelling(self.name_of(entity));
        let script = &mut self.builder.script;
        let made = script.table(name);
        script.enter(made, all);
        self.gathered.insert(entity, made);
        made
    }

    /// What is written into an element of a large array is among what the array holds.
    pub(super) fn gather(&mut self, element: VariableId) {
        if let Some(&all) = self.gathers.get(&element) {
            self.builder.write(
                self.here,
                Written::AnyOf(all),
                How::Whole(Expr::Variable(element)),
            );
        }
    }

    /// Every variable of data without values: with number 0 what no statement names by constants.
    fn variables_of(&mut self, entity: Entity, holds: Expr) -> Vec<VariableId> {
        let resolved = self.resolved;
        let is_array = self.is_array(entity);
        let mut all = Vec::new();
        if is_array {
            for (place, number) in resolved.parsed.places_of(self.name_of(entity)) {
                all.push(self.named_element(entity, place, number, holds));
            }
        }
        if all.is_empty() || resolved.is_scattered(entity) || self.is_large(entity) {
            // an element that nothing has written is none to go to
            let holds = if is_array { Expr::Absent } else { holds };
            all.push(self.variable(entity, 0, holds));
        }
        all
    }

    /// The variables of all elements of an array, or the one of other data.
    pub(super) fn table(&mut self, entity: Entity) -> TableId {
        if let Some(&known) = self.tables.get(&entity) {
            return known;
        }
        let all = match entity {
            Entity::Declared(datum) => {
                if let Stored::Elements { elements, .. } = self.resolved.datum(datum).value {
                    indices(elements)
                        .filter_map(|one| match self.element(datum, short(one), 0) {
                            Expr::Variable(variable) => Some(variable),
                            _ => None,
                        })
                        .collect()
                } else {
                    let holds = self.computed_name(self.name_of(entity));
                    self.variables_of(entity, holds)
                }
            }
            Entity::Undeclared(name) => {
                let holds = self.undeclared(name);
                self.variables_of(entity, holds)
            }
        };
        let name = self.resolved.spelling(self.name_of(entity));
        let script = &mut self.builder.script;
        let made = script.table(name);
        for variable in all {
            script.enter(made, variable);
        }
        self.tables.insert(entity, made);
        made
    }
}

/// How an element is named in the program.
pub(super) fn element_name(name: &str, place: [u32; 3]) -> String {
    match place {
        [i, 0, _] => format!("{name}{{{i}}}"),
        [i, j, 0] => format!("{name}{{{i},{j}}}"),
        [i, j, k] => format!("{name}{{{i},{j},{k}}}"),
    }
}

/// The element at a place of an array.
fn element(place: [u32; 3], sizes: [u32; 3], elements: Part) -> Option<u32> {
    let count: u64 = sizes.iter().map(|&s| u64::from(s.max(1))).product();
    if count != u64::from(elements.1 - elements.0) {
        return None;
    }
    let mut offset = 0;
    for (&at, &size) in place.iter().zip(&sizes) {
        if (at == 0) != (size == 0) || at > size {
            return None;
        }
        offset = offset * size.max(1) + at.max(1) - 1;
    }
    Some(elements.0 + offset)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_of_arrays_are_counted_by_rows() {
        assert_eq!(element([2, 3, 0], [2, 4, 0], (10, 18)), Some(16));
        assert_eq!(element([3, 0, 0], [3, 0, 0], (0, 3)), Some(2));
        assert_eq!(element([4, 0, 0], [3, 0, 0], (0, 3)), None);
        assert_eq!(element([1, 1, 0], [3, 0, 0], (0, 3)), None);
        assert_eq!(element([1, 1, 0], [2, 2, 0], (0, 3)), None, "ragged");
    }
}
