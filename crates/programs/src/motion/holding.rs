//! What a variable may hold: one value, several, or something that only the running program knows.

use crate::program::script::{DisplacementId, NOT_DISPLACED, RemarkId, ValueId, short};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// A write, as an index of the script's statements; or the declaration.
pub(super) type Site = u32;
/// The declaration of a variable.
pub(super) const DECLARED: Site = u32::MAX;

/// One thing that a variable may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Atom {
    /// A position with numbers in the files, displaced.
    Target {
        target: u32,
        displacement: DisplacementId,
    },
    /// A position with numbers in the files of which some are written over.
    Changed { target: u32 },
    /// A value of the script, or of the flow's own behind those.
    Value(ValueId),
    /// Only the running program knows.
    Unknown(RemarkId),
    /// More than are kept apart, or what a routine wrote that is not in the files.
    Anything,
    /// A routine that is not in the files may have set something else since.
    Uncertain,
}

/// Values that are distinguished.
pub(super) const MOST_VALUES: usize = 4;
/// Positions with numbers in the files that are distinguished: a routine may be called for each of
/// an array.
const MOST_TARGETS: usize = 64;
/// Likewise, each in so many displacements on average.
const MOST_DISPLACED: usize = 4 * MOST_TARGETS;

/// What a variable may hold, each with the write that put it there; by [`Atom`], an index of
/// [`Holdings`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Holding(u32);

/// Nothing.
pub(super) const NOTHING: Holding = Holding(0);

/// Every holding once.
#[derive(Debug)]
pub(super) struct Holdings {
    /// What is in all of them, one after the other.
    atoms: Vec<(Atom, Site)>,
    /// Where those of each holding end; they begin where those of the one before end.
    ends: Vec<u32>,
    /// Holdings of one thing.
    ones: HashMap<(Atom, Site), u32>,
    /// Those of one position as it is declared, by position; 0 where there is none yet.
    declared: Vec<u32>,
    /// Holdings of several.
    several: HashMap<Box<[(Atom, Site)]>, u32>,
    joins: HashMap<(u32, u32), u32>,
    /// Targets of holdings with more than are distinguished.
    pub lost: HashSet<u32>,
}

impl Holdings {
    pub(super) fn new() -> Self {
        Self {
            atoms: Vec::new(),
            ends: vec![0],
            ones: HashMap::new(),
            declared: Vec::new(),
            several: HashMap::new(),
            joins: HashMap::new(),
            lost: HashSet::new(),
        }
    }

    pub(super) fn of(&self, holding: Holding) -> &[(Atom, Site)] {
        let at = holding.0 as usize;
        let start = at.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.atoms[start as usize..self.ends[at] as usize]
    }

    /// One thing.
    pub(super) fn one(&mut self, atom: Atom, site: Site) -> Holding {
        let next = short(self.ends.len());
        let known = match atom {
            Atom::Target {
                target,
                displacement: NOT_DISPLACED,
            } if site == DECLARED => {
                let at = target as usize;
                if self.declared.len() <= at {
                    self.declared.resize(at + 1, 0);
                }
                &mut self.declared[at]
            }
            _ => self.ones.entry((atom, site)).or_default(),
        };
        if *known == 0 {
            *known = next;
        }
        let id = *known;
        if id == next {
            self.atoms.push((atom, site));
            self.ends.push(short(self.atoms.len()));
        }
        Holding(id)
    }

    /// Any of these.
    pub(super) fn intern(&mut self, mut atoms: Vec<(Atom, Site)>) -> Holding {
        match atoms[..] {
            [] => return NOTHING,
            [(atom, site)] => return self.one(atom, site),
            _ => {}
        }
        atoms.sort_unstable();
        atoms.dedup_by_key(|(atom, _)| *atom);
        let is_target = |atom: &Atom| matches!(atom, Atom::Target { .. } | Atom::Changed { .. });
        let targets = atoms.iter().filter(|(atom, _)| is_target(atom)).count();
        let mut different: Vec<u32> = Vec::new();
        if targets > MOST_TARGETS {
            different.extend(targets_of(&atoms));
            different.sort_unstable();
            different.dedup();
        }
        let are_lost = different.len() > MOST_TARGETS || targets > MOST_DISPLACED;
        let uncertain = atoms
            .iter()
            .filter(|(atom, _)| *atom == Atom::Uncertain)
            .count();
        if are_lost || atoms.len() - targets - uncertain > MOST_VALUES {
            let site = atoms.iter().map(|(_, site)| *site).min();
            atoms.push((Atom::Anything, site.unwrap_or(DECLARED)));
        }
        if are_lost {
            self.lost.extend(targets_of(&atoms));
            atoms.retain(|(atom, _)| !is_target(atom));
        }
        if atoms.iter().any(|(atom, _)| *atom == Atom::Anything) {
            atoms.retain(|(atom, _)| *atom == Atom::Anything || is_target(atom));
            atoms.sort_unstable();
            atoms.dedup_by_key(|(atom, _)| *atom);
        }
        if let [(atom, site)] = atoms[..] {
            return self.one(atom, site);
        }
        if let Some(&known) = self.several.get(&atoms[..]) {
            return Holding(known);
        }
        let id = short(self.ends.len());
        self.atoms.extend_from_slice(&atoms);
        self.ends.push(short(self.atoms.len()));
        self.several.insert(atoms.into_boxed_slice(), id);
        Holding(id)
    }

    /// Nothing is distinguished any more.
    pub(super) fn lose_all(&mut self) {
        self.lost.extend(targets_of(&self.atoms));
    }

    /// What either may hold.
    pub(super) fn join(&mut self, a: Holding, b: Holding) -> Holding {
        if a == b || b == NOTHING {
            return a;
        }
        if a == NOTHING {
            return b;
        }
        let key = (a.0.min(b.0), a.0.max(b.0));
        if let Some(&joined) = self.joins.get(&key) {
            return Holding(joined);
        }
        let both = [self.of(a), self.of(b)].concat();
        let joined = self.intern(both);
        self.joins.insert(key, joined.0);
        joined
    }
}

/// The positions with numbers in the files among these.
fn targets_of(atoms: &[(Atom, Site)]) -> impl Iterator<Item = u32> {
    atoms.iter().filter_map(|(atom, _)| match atom {
        Atom::Target { target, .. } | Atom::Changed { target } => Some(*target),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_either_may_hold_is_kept_once_with_its_first_write() {
        let mut all = Holdings::new();
        let (a, b) = (
            all.one(Atom::Value(1), 7),
            all.intern(vec![(Atom::Value(1), 3), (Atom::Value(2), 9)]),
        );
        let joined = all.join(a, b);
        assert_eq!(all.of(joined), [(Atom::Value(1), 3), (Atom::Value(2), 9)]);
        assert_eq!(all.join(joined, a), joined);
        assert_eq!(all.join(NOTHING, a), a);
    }

    #[test]
    fn more_than_four_are_not_distinguished() {
        let mut all = Holdings::new();
        let many = all.intern((0..5).map(|i| (Atom::Value(i), i)).collect());
        assert_eq!(all.of(many), [(Atom::Anything, 0)]);
    }

    #[test]
    fn targets_stay_next_to_what_is_not_known_and_are_kept_in_mind_where_they_are_too_many() {
        let mut all = Holdings::new();
        let target = |target| Atom::Target {
            target,
            displacement: 0,
        };
        let few = all.intern(vec![
            (target(1), 3),
            (Atom::Anything, 4),
            (Atom::Value(0), 5),
        ]);
        assert_eq!(all.of(few), [(target(1), 3), (Atom::Anything, 4)]);
        let many = all.intern((0..65).map(|i| (target(i), i)).collect());
        assert_eq!(all.of(many), [(Atom::Anything, 0)]);
        assert_eq!(all.lost.len(), 65);
    }
}
