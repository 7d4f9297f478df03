//! Poses and parts of them that the text tells: numbers, data that nothing writes, and what
//! functions make of those.

use super::aggregate::Leaf;
use super::arguments::is_unit;
use super::declarations::part;
use super::records::part_of;
use super::resolved::Entity;
use super::syntax::{Component, Datum, Storage, Stored, indices};
use super::translate::Translator;
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose, Quaternion, Rotation};
use crate::program::names::Meaning;
use crate::program::number;
use crate::program::numbers::parts;
use crate::program::quantity::is_letter;
use crate::program::script::{Part, PartValue, short};

impl Translator<'_> {
    /// The numbers of a value in small letters and without blanks, one after another: of a pose
    /// seven. `None` where the text does not tell them.
    pub(super) fn constant_parts(&self, text: &[u8]) -> Option<Vec<Part>> {
        let inside = text.strip_prefix(b"[");
        if let Some(inside) = inside.and_then(|inside| inside.strip_suffix(b"]")) {
            let all: Option<Vec<_>> = parts(inside).map(|one| self.constant_parts(one)).collect();
            return Some(all?.concat());
        }
        let length = text.iter().take_while(|b| is_letter(**b)).count();
        let (name, behind) = text.split_at(length);
        if let Some(made) = self.made_by(name, behind) {
            return Some(made);
        }
        if let Some(parts) = self.parts_of_data(name, behind) {
            return Some(parts);
        }
        let value = self
            .resolved
            .quantity(text, self.here, self.context, &mut |_| None);
        Some(self.numbers_here(&[value.exact()?]))
    }

    /// Numbers that stand nowhere by themselves.
    fn numbers_here(&self, numbers: &[f64]) -> Vec<Part> {
        let part = |number: &f64| Part {
            value: PartValue::Number(*number),
            place: self.here,
            length: 0,
        };
        numbers.iter().map(part).collect()
    }

    /// What a function of the language makes of constants.
    ///
    /// # Source
    /// ABB, Technical reference manual RAPID Instructions, Functions and Data types, `OrientZYX`,
    /// `PoseMult`, `PoseInv`.
    fn made_by(&self, name: &[u8], behind: &[u8]) -> Option<Vec<Part>> {
        let given = behind.strip_prefix(b"(")?.strip_suffix(b")")?;
        let symbol = self.resolved.parsed.symbols.find(name);
        if symbol.is_some_and(|name| self.resolved.is_routine(name, self.context)) {
            return None;
        }
        let given: Option<Vec<_>> = parts(given).map(|one| self.constant_parts(one)).collect();
        let made = match (name, &given?[..]) {
            (b"orientzyx", [z, y, x]) => {
                let angle = |of: &[Part]| Some(numbers_of::<1>(of)?[0] * DEG);
                let [z, y, x] = [angle(z)?, angle(y)?, angle(x)?];
                let turned = Rotation::about_z(z) * Rotation::about_y(y) * Rotation::about_x(x);
                return Some(self.numbers_here(&turned.quaternion().0));
            }
            (b"posemult", [a, b]) => pose_of(a)? * pose_of(b)?,
            (b"poseinv", [one]) => pose_of(one)?.inverse(),
            _ => return None,
        };
        let numbers = [
            &made.translation.map(mm_from_m)[..],
            &made.rotation.quaternion().0,
        ];
        Some(self.numbers_here(&numbers.concat()))
    }

    /// The numbers of data that nothing writes, or of a part of such a tool or work object.
    fn parts_of_data(&self, name: &[u8], behind: &[u8]) -> Option<Vec<Part>> {
        let resolved = self.resolved;
        let name = resolved.parsed.symbols.find(name)?;
        let Meaning::One(at) = resolved.meaning(name, self.context) else {
            return None;
        };
        let datum = resolved.datum(at);
        let is_parameter = matches!(datum.storage, Storage::Parameter { .. });
        if is_parameter || resolved.is_written(Entity::Declared(at)) {
            return None;
        }
        let leaves = match datum.value {
            Stored::Leaves(leaves) => {
                let all = &resolved.parsed.leaves[indices(leaves)];
                let words = match behind {
                    b"" => behind,
                    behind => behind.strip_prefix(b".")?,
                };
                let mut words = words.split(|byte| *byte == b'.');
                let inside = words.try_fold(Component::Whole, |inside, word| match word {
                    b"" => Some(inside),
                    word => part(inside, word).map(|found| found.0),
                });
                match inside? {
                    Component::Leaves(first, count) => all
                        .get(usize::from(first)..usize::from(first) + usize::from(count))?
                        .to_vec(),
                    _ => all.to_vec(),
                }
            }
            _ if datum.storage == Storage::Constant => {
                let all = self.constant_numbers(datum)?;
                match (behind, all.len()) {
                    (b"", _) => all,
                    (b".trans", 7) => all[..3].to_vec(),
                    (b".rot", 7) => all[3..].to_vec(),
                    (b".x", 3) | (b".trans.x", 7) => all[..1].to_vec(),
                    (b".y", 3) | (b".trans.y", 7) => all[1..2].to_vec(),
                    (b".z", 3) | (b".trans.z", 7) => all[2..3].to_vec(),
                    _ => return None,
                }
            }
            _ => return None,
        };
        let parts = leaves.into_iter().map(|leaf| part_of(leaf, datum.place));
        Some(parts.collect())
    }

    /// What a constant is declared with, where that is numbers and brackets.
    fn constant_numbers(&self, datum: &Datum) -> Option<Vec<Leaf>> {
        let from = datum.place.offset as usize;
        let bytes = &self.resolved.sources[datum.place.file as usize].bytes[from..];
        let text = &bytes[..memchr::memchr(b';', bytes)?];
        let value = memchr::memmem::find(text, b":=")? + 2;
        let parts = text[value..].split(|byte| matches!(byte, b'[' | b']' | b','));
        let parts = parts
            .map(<[u8]>::trim_ascii)
            .filter(|part| !part.is_empty());
        let leaf = |part: &[u8]| {
            let at = part.as_ptr() as usize - bytes.as_ptr() as usize;
            Some(Leaf::Number {
                value: number::parse(part)?,
                start: datum.place.offset + short(at),
                length: u16::try_from(part.len()).ok()?,
            })
        };
        parts.map(leaf).collect()
    }
}

fn numbers_of<const COUNT: usize>(parts: &[Part]) -> Option<[f64; COUNT]> {
    let number = |part: &Part| match part.value {
        PartValue::Number(number) => Some(number),
        _ => None,
    };
    let numbers: Option<Vec<f64>> = parts.iter().map(number).collect();
    numbers?.try_into().ok()
}

fn pose_of(parts: &[Part]) -> Option<Pose> {
    let [x, y, z, quaternion @ ..] = numbers_of::<7>(parts)?;
    let rotation = Quaternion(quaternion);
    is_unit(quaternion).then(|| Pose::from_parts([x, y, z].map(m_from_mm), rotation.normalized()))
}
