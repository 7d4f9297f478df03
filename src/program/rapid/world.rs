//! Names resolved over all files: data, routines, who calls whom, and where a displacement may be active.

use super::names::{Context, Meaning, Scopes, Symbol};
use super::reader::index;
use super::syntax::{
    Datum, Element, Index, Notes, Part, Place, StatementKind, Stored, Verb, indices,
};

/// All that was noted, with its names resolved.
pub(super) struct World {
    pub notes: Notes,
    data: Scopes,
    routines: Scopes,
    /// Routines that each routine calls; `None` stands for one outside the files.
    calls: Vec<Vec<Option<u32>>>,
}

/// What the name of a target leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Points {
    /// Elements of this declaration, part of [`Notes::elements`].
    Elements { datum: u32, elements: Part },
    /// Declared, but its value is not written out.
    Computed,
    /// Several declarations, by [`World::several`].
    Ambiguous(u32),
    /// Not in the files.
    Unknown,
    /// Data of another type.
    Other,
}

impl World {
    pub fn new(notes: Notes) -> Self {
        let (mut data, mut routines) = (Scopes::default(), Scopes::default());
        for (at, datum) in notes.data.iter().enumerate() {
            data.add(datum.name, datum.context, datum.local, index(at));
        }
        for (at, routine) in notes.routines.iter().enumerate() {
            let context = Context {
                module: routine.module,
                routine: None,
            };
            routines.add(routine.name, context, routine.local, index(at));
        }
        let calls = vec![Vec::new(); notes.routines.len()];
        let mut world = Self {
            notes,
            data,
            routines,
            calls,
        };
        for at in 0..world.notes.statements.len() {
            let statement = world.notes.statements[at];
            if let (Some(routine), StatementKind::Call { name, .. }) =
                (statement.context.routine, statement.kind)
                && let Some(callee) = world.callee(at, name)
            {
                world.calls[routine as usize].push(callee);
            }
        }
        world
    }

    #[allow(clippy::option_option)]
    /// The routine that a statement calls: `Some(None)` for one outside the files, `None` where it is an instruction.
    fn callee(&self, statement: usize, name: Option<Symbol>) -> Option<Option<u32>> {
        let statement = &self.notes.statements[statement];
        let StatementKind::Call { verb, .. } = statement.kind else {
            return None;
        };
        let found = name.map(|name| self.routines.meaning(name, statement.context));
        match found {
            Some(Meaning::One(routine)) => Some(Some(routine)),
            Some(Meaning::Nothing) if verb != Verb::Other => None,
            _ => Some(None),
        }
    }

    /// Whether a call names a routine of the files.
    pub fn is_routine(&self, name: Symbol, context: Context) -> bool {
        self.routines.meaning(name, context) != Meaning::Nothing
    }

    pub fn datum(&self, datum: u32) -> &Datum {
        &self.notes.data[datum as usize]
    }

    pub fn meaning(&self, name: Symbol, context: Context) -> Meaning {
        self.data.meaning(name, context)
    }

    pub fn several(&self, list: u32) -> &[u32] {
        self.data.several(list)
    }

    /// What a name of a target leads to.
    pub fn points(&self, name: Symbol, at: Index, context: Context) -> Points {
        match self.meaning(name, context) {
            Meaning::Nothing => Points::Unknown,
            Meaning::Several(list) => {
                let targets = |&datum: &u32| self.datum(datum).kind.is_target();
                if self.several(list).iter().any(targets) {
                    Points::Ambiguous(list)
                } else {
                    Points::Other
                }
            }
            Meaning::One(datum) => self.points_of(datum, at),
        }
    }

    fn points_of(&self, datum: u32, at: Index) -> Points {
        let declared = self.datum(datum);
        if !declared.kind.is_target() {
            return Points::Other;
        }
        let Stored::Elements { elements, sizes } = declared.value else {
            return Points::Computed;
        };
        let elements = match at {
            Index::At(place) => match element(place, sizes, elements) {
                Some(one) => (one, one + 1),
                None => return Points::Computed,
            },
            Index::Whole | Index::Variable => elements,
        };
        Points::Elements { datum, elements }
    }

    /// Targets of a declaration with their own numbers.
    pub fn own_targets(&self, part: Part) -> impl Iterator<Item = usize> {
        self.notes.elements[indices(part)]
            .iter()
            .filter_map(|element| match element {
                Element::Target(target) => Some(*target),
                _ => None,
            })
    }

    /// Routines that are reached from these, themselves included only where they are called again; and whether one outside
    /// the files is.
    pub fn reached(&self, from: impl IntoIterator<Item = Option<u32>>) -> (Vec<bool>, bool) {
        let mut reached = vec![false; self.calls.len()];
        let mut outside = false;
        let mut open: Vec<Option<u32>> = from.into_iter().collect();
        while let Some(next) = open.pop() {
            match next {
                None => outside = true,
                Some(routine) if reached[routine as usize] => {}
                Some(routine) => {
                    reached[routine as usize] = true;
                    open.extend_from_slice(&self.calls[routine as usize]);
                }
            }
        }
        (reached, outside)
    }

    /// Routines that this one calls.
    pub fn calls(&self, routine: u32) -> &[Option<u32>] {
        &self.calls[routine as usize]
    }

    /// For each statement, the `PDispOn`, `PDispSet`, `EOffsOn` or `EOffsSet` that may be active there.
    ///
    /// In a routine that runs from top to bottom a displacement lasts to its `PDispOff`; in any other one its whole text is
    /// displaced. Routines that are called meanwhile are displaced, and everything is where a routine ends displaced.
    pub fn displacements(&self) -> Vec<Option<Place>> {
        let statements = &self.notes.statements;
        let mut displaced = vec![None; statements.len()];
        let starts = |verb| matches!(verb, Verb::ProgramDisplacement | Verb::ExternalOffset);
        let verb_of = |at: usize| match statements[at].kind {
            StatementKind::Call { verb, .. } => verb,
            StatementKind::Assign { .. } => Verb::Harmless,
        };
        if !(0..statements.len()).any(|at| starts(verb_of(at))) {
            return displaced;
        }
        let mut everywhere = None;
        let mut settled = vec![false; statements.len()];
        let mut called = Vec::new();
        let mut first = 0;
        while first < statements.len() {
            let context = statements[first].context;
            let same = |at: &usize| statements[*at].context == context;
            let last = (first..statements.len()).take_while(same).count() + first;
            let straight = context
                .routine
                .is_some_and(|routine| self.notes.routines[routine as usize].straight);
            let any = (first..last).find(|&at| starts(verb_of(at)));
            // program displacement and external offset
            let mut active = [None, None];
            let mut off = [false, false];
            if let (Some(at), false) = (any, straight) {
                active = [Some(statements[at].place); 2];
            }
            for at in first..last {
                match verb_of(at) {
                    Verb::ProgramDisplacement => active[0] = Some(statements[at].place),
                    Verb::ExternalOffset => active[1] = Some(statements[at].place),
                    Verb::ProgramDisplacementOff => {
                        off[0] = true;
                        active[0] = active[0].filter(|_| !straight);
                    }
                    Verb::ExternalOffsetOff => {
                        off[1] = true;
                        active[1] = active[1].filter(|_| !straight);
                    }
                    _ => {}
                }
                displaced[at] = active[0].or(active[1]);
                settled[at] = straight && off == [true, true];
                if let (Some(cause), StatementKind::Call { name, .. }) =
                    (displaced[at], statements[at].kind)
                    && let Some(callee) = self.callee(at, name)
                {
                    called.push((callee, cause));
                }
            }
            let ends_displaced = (first..last).rev().find_map(|at| match verb_of(at) {
                Verb::ProgramDisplacement | Verb::ExternalOffset => Some(Some(at)),
                Verb::ProgramDisplacementOff | Verb::ExternalOffsetOff => Some(None),
                _ => None,
            });
            let left = if straight {
                active[0].or(active[1])
            } else {
                ends_displaced.flatten().map(|at| statements[at].place)
            };
            everywhere = everywhere.or(left);
            first = last;
        }
        let (reached, _) = self.reached(called.iter().map(|(callee, _)| *callee));
        for (at, statement) in statements.iter().enumerate() {
            let in_called = statement
                .context
                .routine
                .is_some_and(|r| reached[r as usize]);
            if displaced[at].is_none() && !settled[at] {
                displaced[at] = everywhere.or_else(|| {
                    called
                        .first()
                        .filter(|_| in_called)
                        .map(|(_, cause)| *cause)
                });
            }
        }
        displaced
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
