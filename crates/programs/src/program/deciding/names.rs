//! Which names have numbers of which targets.

use super::Decided;
use crate::program::script::{Place, short};
use crate::program::{Program, Source, TargetId};
use foldhash::{HashMap, HashSet};
use std::collections::BTreeMap;

/// Index of a name.
pub(super) type NameId = u32;
/// Names of one file have its number above this, in the place of a routine's.
const OF_FILE: u32 = 1 << 31;
/// Numbers pass through so many names one after the other.
const LONGEST: usize = 32;
/// So many targets and places are kept of a name.
const MOST: usize = 64;

/// A name in an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Named {
    pub name: NameId,
    /// Its numbers are read, not the position as a whole.
    pub is_read: bool,
}

/// A statement gives one name what another has.
#[derive(Clone, Copy, Debug)]
struct Given {
    to: NameId,
    from: Named,
    place: Place,
}

/// What a name has of targets.
#[derive(Clone, Debug, Default)]
struct Had {
    /// It is a position that is one of these.
    positions: Vec<NameId>,
    /// It has numbers of these, which were read there.
    numbers: Vec<(NameId, Place)>,
}

/// What the statements of all files do with names.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// By the routine whose own they are, or 0, and their spelling.
    known: HashMap<u32, HashMap<Box<[u8]>, NameId>>,
    all: Vec<(u32, Box<[u8]>)>,
    given: Vec<Given>,
    decisions: Vec<(Named, Place)>,
    /// Routines so far.
    pub routines: u32,
    /// Some routine has parameters.
    pub has_parameters: bool,
    /// The parameters of routines, by the names of these.
    parameters: HashMap<NameId, Vec<NameId>>,
    /// What calls give to which parameter.
    calls: Vec<(NameId, usize, Named, Place)>,
}

impl Names {
    /// What [`Self::name`] takes for a file's own names.
    pub(super) const fn of_file(file: u32) -> u32 {
        OF_FILE | file
    }

    /// A name of a routine's or a file's own, or of all (0).
    pub(super) fn name(&mut self, routine: u32, spelling: &[u8]) -> NameId {
        let own = self.known.entry(routine).or_default();
        if let Some(&known) = own.get(spelling) {
            return known;
        }
        let name = short(self.all.len());
        own.insert(spelling.into(), name);
        self.all.push((routine, spelling.into()));
        name
    }

    fn find(&self, routine: u32, spelling: &[u8]) -> Option<NameId> {
        self.known.get(&routine)?.get(spelling).copied()
    }

    pub(super) fn give(&mut self, to: NameId, from: Named, place: Place) {
        if to != from.name {
            self.given.push(Given { to, from, place });
        }
    }

    pub(super) fn decide(&mut self, by: Named, place: Place) {
        self.decisions.push((by, place));
    }

    pub(super) fn declare(&mut self, routine: NameId, parameters: Vec<NameId>) {
        self.parameters.insert(routine, parameters);
    }

    pub(super) fn call(&mut self, routine: NameId, parameter: usize, from: Named, place: Place) {
        self.calls.push((routine, parameter, from, place));
    }

    /// Calls give what they are given to the parameters.
    fn bind(&mut self) {
        for (routine, at, from, place) in std::mem::take(&mut self.calls) {
            let of = self.parameters.get(&routine);
            if let Some(&to) = of.and_then(|parameters| parameters.get(at)) {
                self.give(to, from, place);
            }
        }
    }

    /// Who reads or writes an array with an index that only the running program knows reads or
    /// writes its elements.
    fn spread(&mut self) {
        let mut elements: BTreeMap<NameId, Vec<NameId>> = BTreeMap::new();
        for (at, (routine, spelling)) in (0..).zip(&self.all) {
            if let Some(array) = array_of(spelling)
                && let Some(array) = self.find(*routine, array)
            {
                elements.entry(array).or_default().push(at);
            }
        }
        if elements.is_empty() {
            return;
        }
        for at in 0..self.given.len() {
            let given = self.given[at];
            for &name in elements.get(&given.to).into_iter().flatten() {
                self.given.push(Given { to: name, ..given });
            }
            for &name in elements.get(&given.from.name).into_iter().flatten() {
                let from = Named { name, ..given.from };
                self.given.push(Given { from, ..given });
            }
        }
        for at in 0..self.decisions.len() {
            let (by, place) = self.decisions[at];
            for &name in elements.get(&by.name).into_iter().flatten() {
                self.decisions.push((Named { name, ..by }, place));
            }
        }
    }

    /// The targets of each name that moves go to and that may be rewritten.
    fn targets(&self, program: &Program) -> HashMap<NameId, Vec<TargetId>> {
        let mut by_spelling: HashMap<&[u8], Vec<NameId>> = HashMap::default();
        for (at, (_, spelling)) in (0..).zip(&self.all) {
            by_spelling.entry(spelling).or_default().push(at);
        }
        let mut used = vec![false; program.targets.len()];
        for target in program.moves.iter().filter_map(|motion| motion.target) {
            used[target] = !program.targets[target].blocked;
        }
        let mut found: HashMap<NameId, Vec<TargetId>> = HashMap::default();
        let mut spelling = Vec::new();
        for (at, target) in program.targets.iter().enumerate() {
            let Some(name) = target.name.as_deref().filter(|_| used[at]) else {
                continue;
            };
            spell(name.as_bytes(), &mut spelling);
            let whole = spelling.len();
            let array = array_of(&spelling).map_or(whole, <[u8]>::len);
            spelling.extend_from_slice(b"[0]");
            // of one value alone the index may be left out
            let alone = (array == whole).then_some(whole + 3);
            let ends = [Some(whole), alone, (array < whole).then_some(array)];
            for end in ends.into_iter().flatten() {
                for &name in by_spelling.get(&spelling[..end]).into_iter().flatten() {
                    let scope = self.all[name as usize].0;
                    if scope < OF_FILE || scope == Self::of_file(target.file) {
                        found.entry(name).or_default().push(at);
                    }
                }
            }
        }
        found
    }

    /// What each name has of targets.
    fn follow(&self, is_target: &dyn Fn(NameId) -> bool) -> Vec<Had> {
        let mut had = vec![Had::default(); self.all.len()];
        let mut open: Vec<bool> = (0..short(self.all.len())).map(is_target).collect();
        for _ in 0..LONGEST {
            let mut next = vec![false; open.len()];
            for given in &self.given {
                let from = given.from.name as usize;
                if !open[from] {
                    continue;
                }
                let mut positions = had[from].positions.clone();
                if is_target(given.from.name) {
                    positions.push(given.from.name);
                }
                let mut numbers = had[from].numbers.clone();
                if given.from.is_read {
                    numbers.extend(positions.drain(..).map(|of| (of, given.place)));
                }
                let to = &mut had[given.to as usize];
                let before = (to.positions.len(), to.numbers.len());
                add(&mut to.positions, positions);
                add(&mut to.numbers, numbers);
                next[given.to as usize] |= before != (to.positions.len(), to.numbers.len());
            }
            if !next.contains(&true) {
                break;
            }
            open = next;
        }
        had
    }

    /// The statements that read numbers of targets by which the program decides.
    pub(super) fn decided(mut self, sources: &[Source], program: &Program) -> Vec<Decided> {
        if self.decisions.is_empty() {
            return Vec::new();
        }
        self.bind();
        self.spread();
        let targets = self.targets(program);
        if targets.is_empty() {
            return Vec::new();
        }
        let is_target = |name: NameId| targets.contains_key(&name);
        let had = self.follow(&is_target);
        let mut found: BTreeMap<(Place, NameId), Option<Place>> = BTreeMap::new();
        for &(by, place) in &self.decisions {
            let of = &had[by.name as usize];
            let own = is_target(by.name).then_some(by.name);
            for &name in own.iter().chain(&of.positions) {
                found.insert((place, name), None);
            }
            for &(name, read) in &of.numbers {
                let first = found.entry((read, name)).or_insert(Some(place));
                *first = first.map(|first| first.min(place));
            }
        }
        let arrays: HashSet<(Place, NameId)> = found.keys().copied().collect();
        let said = |(place, name): (Place, NameId)| {
            let (routine, spelling) = &self.all[name as usize];
            let array = array_of(spelling)?;
            let array = self.find(*routine, array)?;
            arrays.contains(&(place, array)).then_some(())
        };
        let found = found.into_iter().filter(|(key, _)| said(*key).is_none());
        let found = found.map(|((place, name), decides)| {
            let targets = match self.all[name as usize].0 {
                OF_FILE.. => targets[&name].as_slice().into(),
                _ => nearest(sources, program, place, &targets[&name]),
            };
            let of = &program.targets[targets[0]];
            let spelling = of.name.as_deref().unwrap_or_default();
            let is_array = array_of(&self.all[name as usize].1).is_none() && targets.len() > 1;
            let end = spelling.find(['[', '{']).filter(|_| is_array);
            Decided {
                place,
                decides: decides.filter(|decides| *decides != place),
                name: spelling[..end.unwrap_or(spelling.len())].into(),
                targets,
            }
        });
        found.collect()
    }
}

fn add<T: PartialEq>(to: &mut Vec<T>, more: Vec<T>) {
    for one in more {
        if to.len() < MOST && !to.contains(&one) {
            to.push(one);
        }
    }
}

/// Of targets in several files those of the file of a place, or of one that is called like it.
fn nearest(
    sources: &[Source],
    program: &Program,
    place: Place,
    all: &[TargetId],
) -> Box<[TargetId]> {
    let stem = |file: u32| {
        let name = &sources[file as usize].name;
        name.rsplit_once('.').map_or(&name[..], |(stem, _)| stem)
    };
    let is_near = |target: &&TargetId| {
        let file = program.targets[**target].file;
        file == place.file || stem(file) == stem(place.file)
    };
    let near: Box<[TargetId]> = all.iter().filter(is_near).copied().collect();
    if near.is_empty() { all.into() } else { near }
}

/// Spells a name as all are: in small letters, a number alone in its bracket.
pub(super) fn spell(name: &[u8], into: &mut Vec<u8>) {
    into.clear();
    for byte in name {
        match byte {
            b'{' => into.push(b'['),
            b'}' => into.push(b']'),
            byte => into.push(byte.to_ascii_lowercase()),
        }
    }
}

/// The name of the array that an element is of.
fn array_of(spelling: &[u8]) -> Option<&[u8]> {
    memchr::memchr(b'[', spelling).map(|at| &spelling[..at])
}
