//! What a write leaves in a variable, whole or in parts.

use super::{Flow, State, bits};
use crate::motion::holding::{Atom, DECLARED, Holding, Site};
use crate::program::script::{
    DisplacementId, Expr, Held, How, NOT_DISPLACED, OVERWRITTEN, Part, PartValue, RemarkId,
    UNBOUNDED, ValueId, VariableId, Write, Written, short,
};

impl Flow<'_> {
    pub(super) fn write(&mut self, write: &Write, site: Site, state: &mut State) {
        match write.variable {
            Written::One(variable) => {
                let holding = self.written(write, variable, site, state);
                self.set(state, variable, holding);
            }
            Written::AnyOf(table) if self.loose.contains(&table) => {}
            Written::AnyOf(table) => {
                for variable in self.script.tables[table as usize].entries.values() {
                    let held = self.variable(state, *variable);
                    if !matches!(write.how, How::Whole(_)) && self.is_in_parts(held, *variable) {
                        continue;
                    }
                    let holding = self.written(write, *variable, site, state);
                    let either = self.holdings.join(held, holding);
                    self.set(state, *variable, either);
                }
            }
        }
    }

    /// What a variable holds that something may have written: its own position with other numbers,
    /// or anything.
    pub(super) fn changed(&self, variable: VariableId) -> Atom {
        match self.script.variables[variable as usize].declared {
            Expr::Target(target) => Atom::Changed {
                target: short(target),
            },
            _ => Atom::Anything,
        }
    }

    /// Whether a variable holds its own target, of which some parts may be written over: once more
    /// changes nothing.
    pub(super) fn is_in_parts(&self, held: Holding, variable: VariableId) -> bool {
        let Expr::Target(own) = self.script.variables[variable as usize].declared else {
            return false;
        };
        let atoms = self.holdings.of(held).iter().map(|(atom, _)| *atom);
        let own = short(own);
        atoms
            .clone()
            .any(|atom| atom == Atom::Changed { target: own })
            && atoms.clone().all(|atom| match atom {
                Atom::Changed { target } => target == own,
                Atom::Target {
                    target,
                    displacement,
                } => target == own && displacement == NOT_DISPLACED,
                _ => false,
            })
    }

    /// What a variable holds behind a write.
    pub(super) fn written(
        &mut self,
        write: &Write,
        variable: VariableId,
        site: Site,
        state: &State,
    ) -> Holding {
        let (first, parts, somehow) = match &write.how {
            How::Whole(value) => {
                let held = self.evaluate(state, *value, site);
                let atoms = self.holdings.of(held).to_vec();
                // of a copy the write that made it another says more than the copying
                let is_copy = matches!(value, Expr::Variable(_) | Expr::Element { .. });
                let here = atoms
                    .into_iter()
                    .map(|(atom, of)| match of {
                        of if is_copy && of != DECLARED => (atom, of),
                        _ => (atom, site),
                    })
                    .collect();
                return self.holdings.intern(here);
            }
            How::Parts { first, parts } => (*first, parts.clone(), None),
            How::Axis(_) => (0, 0..0, None),
            How::PartSomehow(remark)
            | How::PartNumber(remark)
            | How::PartBy(remark, _)
            | How::PartOf { remark, .. } => (0, 0..0, Some(*remark)),
        };
        let of = match write.how {
            How::PartOf { of, axis, by, .. } => Some((self.evaluate(state, of, site), axis, by)),
            _ => None,
        };
        let own = match self.script.variables[variable as usize].declared {
            Expr::Target(target) => Some(short(target)),
            _ => None,
        };
        let held = self.variable(state, variable);
        let atoms = self.holdings.of(held).to_vec();
        let mut changed = Vec::with_capacity(atoms.len());
        for (atom, of_atom) in atoms {
            if let How::Axis(why) = write.how {
                changed.push(self.with_other_axis(atom, of_atom, why, site));
                continue;
            }
            let atom = match atom {
                Atom::Target { target, .. } if own == Some(target) => Atom::Changed { target },
                Atom::Target {
                    target,
                    displacement,
                } => {
                    let all = if self.joints[target as usize] {
                        // of another joint the correction is another one
                        vec![UNBOUNDED]
                    } else if let Some((of, axis, by)) = of {
                        self.part_of((target, displacement), of, (axis, by), site)
                    } else {
                        let by = Self::added_by(&write.how);
                        self.displaced_again(displacement, by, site)
                    };
                    changed.extend(all.into_iter().map(|displacement| {
                        (
                            Atom::Target {
                                target,
                                displacement,
                            },
                            site,
                        )
                    }));
                    continue;
                }
                // a part of where the robot was is computed
                Atom::Value(value) if somehow.is_some() && self.is_of_robot(value) => {
                    match write.how {
                        How::PartBy(_, by) => self.near_robot(value, by),
                        _ => Atom::Anything,
                    }
                }
                Atom::Value(value) => match somehow {
                    Some(remark) => Atom::Unknown(remark),
                    None => match self.with_parts(value, first, parts.clone()) {
                        Some(record) => Atom::Value(record),
                        // one whose parts nobody knows
                        None if self.is_of_robot(value)
                            || matches!(self.value(value), Held::Frame(_)) =>
                        {
                            Atom::Anything
                        }
                        None => atom,
                    },
                },
                other => other,
            };
            changed.push((atom, site));
        }
        self.holdings.intern(changed)
    }

    /// What a position is of which an external axis is written.
    fn with_other_axis(
        &self,
        atom: Atom,
        of: Site,
        why: Option<RemarkId>,
        site: Site,
    ) -> (Atom, Site) {
        match (atom, why) {
            (Atom::Target { .. } | Atom::Changed { .. }, Some(remark)) => {
                (Atom::Unknown(remark), site)
            }
            // from another place the arm comes there otherwise
            (Atom::Value(value), _) if self.is_of_robot(value) => (Atom::Anything, site),
            _ => (atom, of),
        }
    }

    /// What displaces a copy of a target a part of which becomes that of another position and
    /// something more: what is added, where the other one is that target, displaced or not.
    fn part_of(
        &mut self,
        (target, before): (u32, DisplacementId),
        of: Holding,
        along: (usize, DisplacementId),
        site: Site,
    ) -> Vec<DisplacementId> {
        let of = match self.holdings.of(of) {
            [
                (
                    Atom::Target {
                        target: of,
                        displacement,
                    },
                    _,
                ),
            ] if *of == target => *displacement,
            _ => return vec![OVERWRITTEN],
        };
        self.replaced((before, of), along, site)
    }

    /// What a write of a part adds to a copy of a target.
    fn added_by(how: &How) -> DisplacementId {
        match *how {
            // numbers of the text do not know of a correction
            How::Parts { .. } | How::PartNumber(_) | How::PartOf { .. } => OVERWRITTEN,
            How::PartBy(_, by) => by,
            _ => UNBOUNDED,
        }
    }

    /// A record with other parts; `None` where it is none.
    pub(super) fn with_parts(
        &mut self,
        value: ValueId,
        first: u32,
        parts: std::ops::Range<u32>,
    ) -> Option<ValueId> {
        let key = (value, first, parts.start);
        if let Some(known) = self.made_parts.get(&key) {
            return *known;
        }
        let made = self.make_record(value, first, parts);
        self.made_parts.insert(key, made);
        made
    }

    pub(super) fn make_record(
        &mut self,
        value: ValueId,
        first: u32,
        parts: std::ops::Range<u32>,
    ) -> Option<ValueId> {
        let Held::Record {
            name,
            parts: old,
            on,
        } = self.value(value).clone()
        else {
            return None;
        };
        let script = self.script;
        let mut all = self.parts_of(&old);
        let end = first as usize + parts.len();
        if all.len() < end {
            let place = script.parts[parts.start as usize].place;
            all.resize(
                end,
                Part {
                    value: PartValue::Missing,
                    place,
                    length: 0,
                },
            );
        }
        all[first as usize..end]
            .copy_from_slice(&script.parts[parts.start as usize..parts.end as usize]);
        let before = self.parts_of(&old);
        let same =
            before.len() == all.len() && before.iter().zip(&all).all(|(a, b)| a.value == b.value);
        if same {
            return Some(value);
        }
        let content = (
            name.clone(),
            all.iter().map(|part| bits(part.value)).collect(),
        );
        if let Some(&known) = self.made_records.get(&content) {
            return Some(known);
        }
        let start = short(script.parts.len() + self.more_parts.len());
        self.more_parts.extend(all);
        let end = short(script.parts.len() + self.more_parts.len());
        self.made.push(Held::Record {
            name,
            parts: start..end,
            on,
        });
        let made = short(script.values.len() + self.made.len() - 1);
        self.made_records.insert(content, made);
        Some(made)
    }

    /// The parts of a record.
    pub(in crate::motion) fn parts_of(&self, parts: &std::ops::Range<u32>) -> Vec<Part> {
        let own = short(self.script.parts.len());
        let (list, by) = if parts.start < own || parts.is_empty() {
            (&self.script.parts, 0)
        } else {
            (&self.more_parts, own)
        };
        list[(parts.start - by) as usize..(parts.end - by) as usize].to_vec()
    }
}
