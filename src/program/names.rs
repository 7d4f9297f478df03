//! Names, and what they mean where they are used.
//!
//! Names are case-insensitive. Data of a routine hide those of its module, those of a module hide those of others; LOCAL data
//! are seen in their own module only.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::hash::{BuildHasher, BuildHasherDefault, Hasher, RandomState};

/// A name without its case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Symbol(pub u32);

/// Every name that was read, with its first spelling.
#[derive(Debug)]
pub(super) struct Symbols {
    ids: HashMap<Box<[u8]>, u32, Seed>,
    spellings: Vec<Box<str>>,
    /// The last name of each of some checksums: most names are met again soon.
    recent: Vec<u32>,
}

/// Starts the checksums of names at a number that no text can know, so that none can make many names meet.
#[derive(Clone, Copy, Debug)]
struct Seed(u64);

impl BuildHasher for Seed {
    type Hasher = Spread;

    fn build_hasher(&self) -> Spread {
        Spread(self.0)
    }
}

/// Names up to this length are looked up without allocation; RAPID allows 32 letters.
const SHORT: usize = 64;
/// Names that are remembered; a power of two.
const RECENT: usize = 1024;

impl Default for Symbols {
    fn default() -> Self {
        Self {
            ids: HashMap::with_hasher(Seed(RandomState::new().build_hasher().finish())),
            spellings: Vec::new(),
            recent: vec![u32::MAX; RECENT],
        }
    }
}

impl Symbols {
    /// The symbol of a name.
    pub(super) fn intern(&mut self, name: &[u8]) -> Symbol {
        let at = checksum(name);
        let recent = self.recent[at];
        let spelling = self.spellings.get(recent as usize);
        if spelling.is_some_and(|spelling| spelling.as_bytes() == name) {
            return Symbol(recent);
        }
        let id = self.insert(name);
        self.recent[at] = id;
        Symbol(id)
    }

    fn insert(&mut self, name: &[u8]) -> u32 {
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
            return id;
        }
        // a file of 4 GiB has fewer names
        #[allow(clippy::cast_possible_truncation)]
        let id = self.spellings.len() as u32;
        self.ids.insert(folded.into(), id);
        self.spellings
            .push(crate::program::Source::text(name).into());
        id
    }

    /// The symbol of a name that was read; `name` in lower case.
    pub(super) fn find(&self, name: &[u8]) -> Option<Symbol> {
        self.ids.get(name).copied().map(Symbol)
    }

    /// How it was spelled first.
    pub(super) fn spelling(&self, symbol: Symbol) -> &str {
        &self.spellings[symbol.0 as usize]
    }
}

/// A place in the list of recent names. Names with one checksum only push each other out.
fn checksum(name: &[u8]) -> usize {
    let sum = name.iter().fold(name.len(), |sum, &byte| {
        sum.wrapping_mul(31).wrapping_add(usize::from(byte))
    });
    (sum ^ (sum >> 10)) % RECENT
}

/// Where something stands: its module and, inside a routine, that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Context {
    /// Index of the module.
    pub module: u32,
    /// Index of the routine.
    pub routine: Option<u32>,
}

/// Where a declaration is seen.
#[derive(Clone, Copy, Debug)]
enum Scope {
    Everywhere,
    Module(u32),
    Routine(u32),
}

impl Scope {
    /// A number for a name in this scope, different for all.
    fn key(self, name: Symbol) -> u64 {
        let scope = match self {
            Self::Everywhere => 0,
            Self::Module(module) => 1 + 2 * u64::from(module),
            Self::Routine(routine) => 2 + 2 * u64::from(routine),
        };
        // fewer than 2^31 modules and routines fit in 4 GiB
        scope << 32 | u64::from(name.0)
    }
}

/// Spreads numbers over 64 bits, each to another: keys of [`Scope::key`], which count up, and names from a [`Seed`] on.
#[derive(Default)]
struct Spread(u64);

impl Hasher for Spread {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u64(self.0 ^ u64::from_le_bytes(word));
        }
    }

    fn write_usize(&mut self, length: usize) {
        self.write_u64(self.0 ^ length as u64);
    }

    /// The finaliser of splitmix64.
    fn write_u64(&mut self, key: u64) {
        let z = key.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        self.0 = z ^ (z >> 31);
    }
}

/// What a name means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// This declaration.
    One(u32),
    /// Several declarations, and nothing tells which; index for [`Scopes::several`].
    Several(u32),
    /// It is not declared in the files.
    Nothing,
}

/// What is known of a symbol.
#[derive(Clone, Copy, Debug, Default)]
enum Slot {
    /// It is not declared.
    #[default]
    Free,
    /// It is declared once.
    Once {
        context: Context,
        local: bool,
        declaration: u32,
    },
    /// [`Scopes::found`] has its declarations.
    Often,
}

/// Declarations by scope and name.
#[derive(Debug, Default)]
pub(super) struct Scopes {
    /// By symbol.
    slots: Vec<Slot>,
    found: HashMap<u64, Meaning, BuildHasherDefault<Spread>>,
    several: Vec<Vec<u32>>,
}

impl Scopes {
    /// Adds a declaration; one outside routines that is not LOCAL is seen everywhere.
    pub(super) fn add(&mut self, name: Symbol, context: Context, local: bool, declaration: u32) {
        let at = name.0 as usize;
        if self.slots.len() <= at {
            self.slots.resize(at + 1, Slot::Free);
        }
        match self.slots[at] {
            Slot::Free => {
                self.slots[at] = Slot::Once {
                    context,
                    local,
                    declaration,
                };
                return;
            }
            Slot::Once {
                context,
                local,
                declaration,
            } => {
                self.slots[at] = Slot::Often;
                self.scope(name, context, local, declaration);
            }
            Slot::Often => {}
        }
        self.scope(name, context, local, declaration);
    }

    fn scope(&mut self, name: Symbol, context: Context, local: bool, declaration: u32) {
        if let Some(routine) = context.routine {
            self.insert(Scope::Routine(routine), name, declaration);
            return;
        }
        self.insert(Scope::Module(context.module), name, declaration);
        if !local {
            self.insert(Scope::Everywhere, name, declaration);
        }
    }

    fn insert(&mut self, scope: Scope, name: Symbol, declaration: u32) {
        match self.found.entry(scope.key(name)) {
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
    pub(super) fn several(&self, list: u32) -> &[u32] {
        &self.several[list as usize]
    }

    /// What a name means at a place.
    pub(super) fn meaning(&self, name: Symbol, context: Context) -> Meaning {
        match self.slots.get(name.0 as usize) {
            None | Some(Slot::Free) => Meaning::Nothing,
            Some(&Slot::Once {
                context: there,
                local,
                declaration,
            }) => {
                let seen = match there.routine {
                    Some(_) => there.routine == context.routine,
                    None => !local || there.module == context.module,
                };
                if seen {
                    Meaning::One(declaration)
                } else {
                    Meaning::Nothing
                }
            }
            Some(Slot::Often) => {
                let of = |scope: Scope| self.found.get(&scope.key(name));
                context
                    .routine
                    .and_then(|routine| of(Scope::Routine(routine)))
                    .or_else(|| of(Scope::Module(context.module)))
                    .or_else(|| of(Scope::Everywhere))
                    .copied()
                    .unwrap_or(Meaning::Nothing)
            }
        }
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
