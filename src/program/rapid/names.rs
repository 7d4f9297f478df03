//! Names, and what they mean where they are used.
//!
//! Names are case-insensitive. Data of a routine hide those of its module, those of a module hide those of others; LOCAL data
//! are seen in their own module only.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// A name without its case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// Every name that was read, with its first spelling.
#[derive(Debug, Default)]
pub struct Symbols {
    ids: HashMap<Box<[u8]>, u32>,
    spellings: Vec<Box<str>>,
}

/// Names up to this length are looked up without allocation; RAPID allows 32 letters.
const SHORT: usize = 64;

impl Symbols {
    /// The symbol of a name.
    pub fn intern(&mut self, name: &[u8]) -> Symbol {
        let mut short = [0; SHORT];
        let long;
        let folded: &[u8] = if let Some(copy) = short.get_mut(..name.len()) {
            copy.copy_from_slice(name);
            copy.make_ascii_lowercase();
            copy
        } else {
            long = name.to_ascii_lowercase();
            &long
        };
        if let Some(&id) = self.ids.get(folded) {
            return Symbol(id);
        }
        // a file of 4 GiB has fewer names
        #[allow(clippy::cast_possible_truncation)]
        let id = self.spellings.len() as u32;
        self.ids.insert(folded.into(), id);
        self.spellings
            .push(crate::program::Source::text(name).into());
        Symbol(id)
    }

    /// The symbol of a name that was read; `name` in lower case.
    pub fn find(&self, name: &[u8]) -> Option<Symbol> {
        self.ids.get(name).copied().map(Symbol)
    }

    /// How it was spelled first.
    pub fn spelling(&self, symbol: Symbol) -> &str {
        &self.spellings[symbol.0 as usize]
    }
}

/// Where something stands: its module and, inside a routine, that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Context {
    /// Index of the module.
    pub module: u32,
    /// Index of the routine.
    pub routine: Option<u32>,
}

/// Where a declaration is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Scope {
    Everywhere,
    Module(u32),
    Routine(u32),
}

/// What a name means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// This declaration.
    One(u32),
    /// Several declarations, and nothing tells which; index for [`Scopes::several`].
    Several(u32),
    /// It is not declared in the files.
    Nothing,
}

/// Declarations by scope and name.
#[derive(Debug, Default)]
pub struct Scopes {
    found: HashMap<(Scope, Symbol), Meaning>,
    several: Vec<Vec<u32>>,
    /// By symbol: whether it is declared somewhere, and whether in a routine.
    declared: Vec<(bool, bool)>,
}

impl Scopes {
    /// Adds a declaration; one outside routines that is not LOCAL is seen everywhere.
    pub fn add(&mut self, name: Symbol, context: Context, local: bool, declaration: u32) {
        let at = name.0 as usize;
        if self.declared.len() <= at {
            self.declared.resize(at + 1, (false, false));
        }
        self.declared[at].0 = true;
        if let Some(routine) = context.routine {
            self.declared[at].1 = true;
            self.insert(Scope::Routine(routine), name, declaration);
            return;
        }
        self.insert(Scope::Module(context.module), name, declaration);
        if !local {
            self.insert(Scope::Everywhere, name, declaration);
        }
    }

    fn insert(&mut self, scope: Scope, name: Symbol, declaration: u32) {
        match self.found.entry((scope, name)) {
            Entry::Vacant(free) => {
                free.insert(Meaning::One(declaration));
            }
            Entry::Occupied(mut taken) => match *taken.get() {
                Meaning::Several(list) => self.several[list as usize].push(declaration),
                Meaning::One(first) => {
                    let list = u32::try_from(self.several.len()).expect("fewer than declarations");
                    self.several.push(vec![first, declaration]);
                    taken.insert(Meaning::Several(list));
                }
                Meaning::Nothing => {}
            },
        }
    }

    /// The declarations that an ambiguous name may mean.
    pub fn several(&self, list: u32) -> &[u32] {
        &self.several[list as usize]
    }

    /// What a name means at a place.
    pub fn meaning(&self, name: Symbol, context: Context) -> Meaning {
        let (declared, in_routine) = self
            .declared
            .get(name.0 as usize)
            .copied()
            .unwrap_or_default();
        if !declared {
            return Meaning::Nothing;
        }
        let inner = context
            .routine
            .filter(|_| in_routine)
            .and_then(|routine| self.found.get(&(Scope::Routine(routine), name)));
        inner
            .or_else(|| self.found.get(&(Scope::Module(context.module), name)))
            .or_else(|| self.found.get(&(Scope::Everywhere, name)))
            .copied()
            .unwrap_or(Meaning::Nothing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(module: u32, routine: Option<u32>) -> Context {
        Context { module, routine }
    }

    #[test]
    fn case_does_not_matter() {
        let mut symbols = Symbols::default();
        let first = symbols.intern(b"pHome");
        assert_eq!(symbols.intern(b"PHOME"), first);
        assert_eq!(symbols.spelling(first), "pHome");
        let long = vec![b'x'; 200];
        assert_eq!(
            symbols.intern(&long),
            symbols.intern(&long.to_ascii_uppercase())
        );
    }

    #[test]
    fn inner_names_hide_outer_ones() {
        let (mut scopes, p) = (Scopes::default(), Symbol(3));
        scopes.add(p, at(0, None), false, 10);
        scopes.add(p, at(1, None), true, 11);
        scopes.add(p, at(1, Some(7)), false, 12);
        assert_eq!(scopes.meaning(p, at(1, Some(7))), Meaning::One(12));
        assert_eq!(scopes.meaning(p, at(1, Some(8))), Meaning::One(11));
        assert_eq!(scopes.meaning(p, at(2, Some(9))), Meaning::One(10));
        assert_eq!(scopes.meaning(Symbol(9), at(0, None)), Meaning::Nothing);
    }

    #[test]
    fn two_global_names_are_ambiguous_elsewhere_only() {
        let (mut scopes, p) = (Scopes::default(), Symbol(0));
        scopes.add(p, at(0, None), false, 1);
        scopes.add(p, at(1, None), false, 2);
        assert_eq!(scopes.meaning(p, at(1, None)), Meaning::One(2));
        let Meaning::Several(list) = scopes.meaning(p, at(5, None)) else {
            panic!("one meaning only");
        };
        assert_eq!(scopes.several(list), [1, 2]);
    }
}
