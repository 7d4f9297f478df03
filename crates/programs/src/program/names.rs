//! Names, and what they mean where they are used.
//!
//! Names are case-insensitive. Data of a routine hide those of its module, those of a module hide
//! those of others; LOCAL data are seen in their own module only. What several modules share is one
//! thing in all of them.

use crate::program::Source;
use crate::program::script::short;
use foldhash::HashMap;
use foldhash::fast::RandomState;
use hashbrown::HashTable;
use hashbrown::hash_table::Entry as Found;
use std::collections::hash_map::Entry;
use std::hash::{BuildHasher, Hasher};

/// A name without its case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Symbol(pub u32);

/// Every name that was read, with its first spelling.
#[derive(Debug, Default)]
pub(super) struct Symbols {
    /// By the hash of the folded name.
    known: HashTable<Known>,
    spellings: Spellings,
    hasher: RandomState,
    recent: Recent,
}

/// Short names as they were spelled last, each at one place by its letters.
#[derive(Debug)]
struct Recent(Box<[(u128, u32); RECENT]>);

/// Names that are kept.
const RECENT: usize = 256;

impl Default for Recent {
    fn default() -> Self {
        Self(Box::new([(0, 0); RECENT]))
    }
}

impl Recent {
    /// A number for a name of up to 15 bytes, different for all and never 0.
    fn packed(name: &[u8]) -> Option<u128> {
        let mut packed = [0; 16];
        packed.get_mut(..name.len())?.copy_from_slice(name);
        packed[15] = u8::try_from(name.len())
            .ok()
            .filter(|length| (1..16).contains(length))?;
        Some(u128::from_le_bytes(packed))
    }

    /// The place of such a number.
    #[allow(clippy::cast_possible_truncation, reason = "halves of a number")]
    fn place(packed: u128) -> usize {
        let halves = packed as u64 ^ (packed >> 64) as u64;
        (halves.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 56) as usize
    }
}

/// A name in the table: the text is looked at where the hash agrees, and not where the table grows.
#[derive(Clone, Copy, Debug)]
struct Known {
    hash: u32,
    id: u32,
}

impl Known {
    /// The hash, spread over all bits that the table looks at.
    fn spread(hash: u32) -> u64 {
        u64::from(hash).wrapping_mul(0x9E37_79B9_7F4A_7C15)
    }
}

/// Texts, one after the other.
#[derive(Debug, Default)]
struct Spellings {
    text: String,
    /// Where each ends; it begins where the one before ends.
    ends: Vec<u32>,
}

impl Spellings {
    fn of(&self, id: u32) -> &str {
        let id = id as usize;
        let start = id.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.text[start as usize..self.ends[id] as usize]
    }
}

/// The bit that tells small letters from capital ones, in eight bytes.
const CASE: u64 = 0x2020_2020_2020_2020;

/// The hash of a name, whatever its case.
fn hash_of(hasher: &RandomState, name: &str) -> u32 {
    let mut hash = hasher.build_hasher();
    for part in name.as_bytes().chunks(8) {
        let mut eight = [0; 8];
        eight[..part.len()].copy_from_slice(part);
        hash.write_u64(u64::from_le_bytes(eight) | CASE);
    }
    (hash.finish() >> 32) as u32
}

impl Symbols {
    /// The symbol of a name.
    pub(super) fn intern(&mut self, name: &[u8]) -> Symbol {
        let Some(packed) = Recent::packed(name) else {
            return self.look_up(name);
        };
        let place = Recent::place(packed);
        let (known, id) = self.recent.0[place];
        if known == packed {
            return Symbol(id);
        }
        let symbol = self.look_up(name);
        self.recent.0[place] = (packed, symbol.0);
        symbol
    }

    fn look_up(&mut self, name: &[u8]) -> Symbol {
        let name = Source::text(name);
        let hash = hash_of(&self.hasher, &name);
        let Self {
            known, spellings, ..
        } = self;
        let is_same = |other: &Known| {
            other.hash == hash && spellings.of(other.id).eq_ignore_ascii_case(&name)
        };
        match known.entry(Known::spread(hash), is_same, |other| {
            Known::spread(other.hash)
        }) {
            Found::Occupied(known) => Symbol(known.get().id),
            Found::Vacant(free) => {
                let id = short(spellings.ends.len());
                free.insert(Known { hash, id });
                spellings.text.push_str(&name);
                spellings.ends.push(short(spellings.text.len()));
                Symbol(id)
            }
        }
    }

    /// How many names there are.
    pub(super) fn count(&self) -> usize {
        self.spellings.ends.len()
    }

    /// The symbol of a name that was read.
    pub(super) fn find(&self, name: &[u8]) -> Option<Symbol> {
        let name = Source::text(name);
        let hash = hash_of(&self.hasher, &name);
        let is_same = |other: &Known| {
            other.hash == hash && self.spellings.of(other.id).eq_ignore_ascii_case(&name)
        };
        let found = self.known.find(Known::spread(hash), is_same);
        found.map(|known| Symbol(known.id))
    }

    /// What a part of what has a name is called.
    pub(super) fn path(&self, name: Symbol, part: &[u8]) -> Vec<u8> {
        [self.spelling(name).as_bytes(), b".", part].concat()
    }

    /// How it was spelled first.
    pub(super) fn spelling(&self, symbol: Symbol) -> &str {
        self.spellings.of(symbol.0)
    }
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
    found: HashMap<u64, Meaning>,
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

    /// Adds the declarations of one thing that these modules declare: each of them, and all others,
    /// mean the same by its name.
    pub(super) fn add_shared(&mut self, name: Symbol, modules: &[u32], declarations: &[u32]) {
        let at = name.0 as usize;
        if self.slots.len() <= at {
            self.slots.resize(at + 1, Slot::Free);
        }
        if let Slot::Once {
            context,
            local,
            declaration,
        } = std::mem::replace(&mut self.slots[at], Slot::Often)
        {
            self.scope(name, context, local, declaration);
        }
        for &declaration in declarations {
            for &module in modules {
                self.insert(Scope::Module(module), name, declaration);
            }
            self.insert(Scope::Everywhere, name, declaration);
        }
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

    #[test]
    fn what_modules_share_is_the_same_in_all() {
        let (mut scopes, p, q) = (Scopes::default(), Symbol(0), Symbol(1));
        scopes.add(p, at(7, None), true, 9);
        scopes.add_shared(p, &[0, 1], &[2]);
        for module in [0, 1, 5] {
            assert_eq!(scopes.meaning(p, at(module, None)), Meaning::One(2));
        }
        assert_eq!(scopes.meaning(p, at(7, None)), Meaning::One(9));
        scopes.add_shared(q, &[0, 1], &[3, 4]);
        for module in [0, 1, 5] {
            let Meaning::Several(list) = scopes.meaning(q, at(module, None)) else {
                panic!("one meaning only");
            };
            assert_eq!(scopes.several(list), [3, 4]);
        }
    }
}
