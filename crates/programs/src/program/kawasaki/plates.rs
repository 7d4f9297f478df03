//! Objects on a plate: `LMOVE plate+obj` where no move goes to `plate` itself. The plate is a work
//! frame on the base then, and the object the target in it. A plate may be a sum itself:
//! `LMOVE pallet+place+obj`.

use super::moves::Verb;
use super::pose_of;
use super::reader::Reader;
use super::remarks::ASSIGNED;
use super::sections::Statement;
use super::targets::{Name, shifted};
use crate::geometry::Pose;
use crate::program::script::{Expr, Held, How, Place, Variable, VariableId, Written};
use crate::program::words::{Words, six};
use foldhash::{HashMap, HashSet};

/// A plate as a work frame.
#[derive(Clone, Debug)]
pub(super) struct Plate {
    text: String,
    pub pose: Pose,
    /// Holds the base with the plate on it.
    pub frame: VariableId,
}

/// The plates of all programs, by the names that are added up.
pub(super) type Plates = HashMap<Vec<Name>, Plate>;

/// What stands on each plate.
#[derive(Debug, Default)]
struct Sums {
    /// Names without their indices.
    objects: HashMap<Vec<Name>, HashSet<Vec<u8>>>,
    /// Objects that `HERE` teaches on their plate.
    taught: HashSet<Vec<u8>>,
}

/// Whether names that are added up are one plate.
type IsPlate<'p> = &'p dyn Fn(&[Name]) -> bool;

/// What stands on a plate.
#[derive(Clone, Debug)]
pub(super) enum Object {
    Named(Name),
    /// `TRANS(…)` with its six numbers.
    Literal,
}

impl Object {
    fn stem(&self) -> Option<&[u8]> {
        match self {
            Self::Named(name) => Some(&name.stem),
            Self::Literal => None,
        }
    }
}

/// The plate and the object that a sum begins with, and the words of the object. Of several names
/// the last is the object where those before it are one plate, else the second.
fn sum<'a, 'w>(
    position: Words<'a, 'w>,
    is_plate: IsPlate,
) -> Option<(Vec<Name>, Object, Words<'a, 'w>)> {
    let terms = position.terms();
    let name = |part: Words| {
        let (name, words) = Name::of(part)?;
        let is_pose = !name.is_joints() && !name.stem.starts_with(b".");
        (is_pose && words == part.len()).then_some(name)
    };
    let mut names = Vec::new();
    for (at, (sign, term)) in terms.iter().enumerate() {
        match name(*term).filter(|_| *sign == b'+' || at == 0) {
            Some(name) => names.push(name),
            None => break,
        }
    }
    let known = names.iter().take_while(|name| name.key.is_some()).count();
    let count = names.len().saturating_sub(1);
    if count > 1 && known >= count && is_plate(&names[..count]) {
        let object = Object::Named(names.pop()?);
        return Some((names, object, terms[count].1));
    }
    let [_, (b'+', second), ..] = terms[..] else {
        return None;
    };
    if known == 0 {
        return None;
    }
    let is_literal = || {
        let numbers = second.rest_list(1).and_then(|list| six(&list));
        second.is_word(0, b"TRANS") && second.is(1, b'(') && numbers.is_some()
    };
    names.truncate(2);
    let object = match (names.len(), is_literal()) {
        (2, _) => Object::Named(names.pop()?),
        (_, true) => Object::Literal,
        _ => return None,
    };
    Some((names, object, second))
}

/// The sum that a move goes to, in a SHIFT or not, or that `HERE` teaches.
fn sum_of<'a, 'w>(
    statement: &Statement<'a, 'w>,
    own: &[Vec<u8>],
    is_plate: IsPlate,
) -> Option<(Vec<Name>, Object, Words<'a, 'w>)> {
    let first = *statement.words.behind(1).list().first()?;
    let position = if statement.keyword == "HEre" {
        first
    } else {
        let verb = Verb::of(statement)?;
        if !matches!(verb, Verb::To(..) | Verb::Arc(_) | Verb::Near(_)) {
            return None;
        }
        let mut position = first;
        while let Some((inside, _)) = shifted(position) {
            position = inside;
        }
        position
    };
    // parameters of the program are what its callers say
    let is_own = |stem: &[u8]| own.iter().any(|own| own == stem);
    sum(position, is_plate).filter(|(plate, object, _)| {
        let mut stems = plate.iter().map(|name| &*name.stem).chain(object.stem());
        !stems.any(is_own)
    })
}

impl<'a> Reader<'a> {
    /// Finds the plates: names that all moves only add objects to, which no other plate has and
    /// nothing else uses. Where no file tells any base they would hide that it is missing.
    pub(super) fn find_plates(&mut self, start: Option<Pose>) {
        let mut found = self.free_plates(&|_| true, start.is_some());
        let is_sum = |(names, _): &(Vec<Name>, Pose)| names.len() > 1;
        loop {
            let sums: HashSet<Vec<Name>> = (found.iter().filter(|one| is_sum(one)))
                .map(|(names, _)| names.clone())
                .collect();
            found = self.free_plates(&|names| sums.contains(names), start.is_some());
            if found.iter().filter(|one| is_sum(one)).count() == sums.len() {
                break;
            }
        }
        let key = |names: &[Name]| -> Vec<_> {
            let keys = names
                .iter()
                .map(|name| (name.stem.clone(), name.key.clone()));
            keys.collect()
        };
        found.sort_by_cached_key(|(names, _)| key(names));
        for (names, pose) in found {
            let texts: Vec<String> = names.iter().map(Name::text).collect();
            let text = texts.join("+");
            let value = self.frame_value(&format!("BASE+{text}"), start.map(|base| base * pose));
            let place = Place::NOWHERE;
            let frame = Variable::new(text.as_str(), place, value);
            let frame = self.builder.script.variable(frame);
            self.plates.insert(names, Plate { text, pose, frame });
        }
    }

    /// The sums of all programs.
    fn sums(&self, is_plate: IsPlate) -> Sums {
        let mut sums = Sums::default();
        let has_sum = |line: &[u8]| memchr::memchr(b'+', line).is_some();
        self.each_line(has_sum, |line, own| {
            let Some((plate, object, _)) = sum_of(line, own, is_plate) else {
                return;
            };
            let object = object.stem().map(<[u8]>::to_vec);
            if line.keyword == "HEre" {
                sums.taught.extend(object.clone());
            }
            sums.objects.entry(plate).or_default().extend(object);
        });
        sums
    }

    /// Those of sums whose names nothing else uses, and where they are.
    fn free_plates(&self, is_plate: IsPlate, mut has_base: bool) -> Vec<(Vec<Name>, Pose)> {
        let Sums { objects, taught } = self.sums(is_plate);
        if objects.is_empty() {
            return Vec::new();
        }
        let plates: HashSet<&[u8]> = objects.keys().flatten().map(|name| &*name.stem).collect();
        let mut times: HashMap<&[u8], u32> = HashMap::default();
        for object in objects.values().flatten() {
            *times.entry(object).or_default() += 1;
        }
        let mut others: HashSet<Vec<u8>> = HashSet::default();
        self.each_line(
            |_| true,
            |line, own| {
                let part = line.words;
                has_base |= line.keyword == "BAse";
                let sum = sum_of(line, own, is_plate);
                let end = sum.map_or(0, |(_, _, object)| object.span().end);
                for at in 1..part.len() {
                    // the first names behind the verb are the sum
                    if part.part(at..at + 1).span().start >= end
                        && let Some((name, _)) = Name::of(part.behind(at))
                        && (plates.contains(&*name.stem) || times.contains_key(&*name.stem))
                    {
                        others.insert(name.stem);
                    }
                }
            },
        );
        let is_free = |stem: &[u8]| {
            let is_assigned = self.assigned.contains(&(None, stem.to_vec()));
            let is_assigned = is_assigned && !taught.contains(stem);
            !others.contains(stem) && !is_assigned
        };
        let shared = self.names.get(&None);
        let is_object = |stem: &Vec<u8>| {
            let elements = shared.and_then(|names| names.get(stem));
            let elements = elements.map(|of| &of.variables);
            let mut all = elements.into_iter().flat_map(HashMap::values);
            let is_known = elements.is_some_and(|all| !all.is_empty())
                && all.all(|one| self.declared_pose(*one).is_some() || taught.contains(stem));
            is_known && is_free(stem) && times[&**stem] == 1 && !plates.contains(&**stem)
        };
        let pose_at = |name: &Name| {
            let variables = &shared?.get(&name.stem)?.variables;
            self.declared_pose(*variables.get(name.key.as_deref()?)?)
        };
        let place = |(names, objects): (&Vec<Name>, &HashSet<Vec<u8>>)| {
            let is_plate = |name: &Name| !times.contains_key(&*name.stem) && is_free(&name.stem);
            if !names.iter().all(is_plate) || !objects.iter().all(is_object) {
                return None;
            }
            let mut pose = Pose::identity();
            for name in names {
                pose = pose * pose_at(name)?;
            }
            Some((names.clone(), pose))
        };
        let found = objects.iter().filter_map(place);
        found.filter(|_| has_base).collect()
    }

    /// Visits the lines of all programs whose text is wanted, with the parameters of their program.
    fn each_line(
        &self,
        is_wanted: impl Fn(&[u8]) -> bool + Copy,
        mut visit: impl FnMut(&Statement, &[Vec<u8>]),
    ) {
        for (program, own) in self.sections.programs.iter().zip(&self.parameters) {
            let source = &self.sources[program.place.file as usize];
            program.each(&source.bytes, is_wanted, |line| visit(line, own));
        }
    }

    /// The pose that a variable is declared with.
    fn declared_pose(&self, variable: VariableId) -> Option<Pose> {
        let script = &self.builder.script;
        let Expr::Target(target) = script.variables[variable as usize].declared else {
            return None;
        };
        let numbers = script.numbers_of(target);
        (numbers.len() == 6).then(|| pose_of(std::array::from_fn(|i| numbers[i].value)))
    }

    /// The plate that a sum begins with (the work frame, where that is on the base, and how many
    /// names it has), its object, and the words of that.
    pub(super) fn on_plate<'w>(
        &self,
        position: Words<'a, 'w>,
    ) -> Option<((VariableId, Pose, usize), Object, Words<'a, 'w>)> {
        if self.plates.is_empty() {
            return None;
        }
        let is_plate = |names: &[Name]| self.plates.contains_key(names);
        let (names, object, words) = sum(position, &is_plate)?;
        let plate = self.plates.get(&names)?;
        Some(((plate.frame, plate.pose, names.len()), object, words))
    }

    /// The plate on which `HERE plate+obj` teaches an object.
    pub(super) fn taught_on(&self, sum: Words<'a, '_>) -> Option<VariableId> {
        let ((frame, _, names), object, _) = self.on_plate(sum)?;
        let is_whole = sum.terms().len() == names + 1;
        (is_whole && object.stem().is_some()).then_some(frame)
    }

    /// The base is another: so are the plates on it.
    pub(super) fn move_plates(&mut self, base: Expr, words: Words<'a, '_>) {
        let mut plates: Vec<Plate> = self.plates.values().cloned().collect();
        plates.sort_unstable_by_key(|plate| plate.frame);
        if plates.is_empty() {
            return;
        }
        let known = if let Expr::Value(value) = base {
            match &self.builder.script.values[value as usize] {
                Held::Frame(frame) => Some((frame.name.to_string(), frame.pose)),
                _ => None,
            }
        } else {
            let first = words.list().first().copied().unwrap_or(words);
            let name = crate::program::Source::text(first.whole());
            let pose = self.steps(first).all.exact();
            pose.map(|pose| (name.into(), Some(pose)))
        };
        for plate in plates {
            let value = match &known {
                Some((name, pose)) if name == "NULL" => {
                    self.frame_value(&plate.text, pose.map(|base| base * plate.pose))
                }
                Some((name, pose)) => {
                    let name = format!("{name}+{}", plate.text);
                    self.frame_value(&name, pose.map(|base| base * plate.pose))
                }
                None => self.unknown(ASSIGNED),
            };
            self.write(Written::One(plate.frame), How::Whole(value));
        }
    }
}
