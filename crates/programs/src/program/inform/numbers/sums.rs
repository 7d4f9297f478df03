//! Positions that are copies of others, or sums.

use super::{Known, Now, OF_POSITION, Written};
use crate::program::quantity::Quantity;
use crate::program::script::VariableId;
use foldhash::HashSet;

/// Positions in a sum that others are made of.
const MOST_TERMS: usize = 16;

/// A position as it is where an instruction adds it, as far as the job has just written it.
pub(in crate::program::inform) type Amounts = [Option<Amount>; OF_POSITION];

#[derive(Clone, Debug)]
pub(in crate::program::inform) enum Amount {
    Exactly(f64),
    /// Other numbers, each so often.
    Sum(Terms),
}

/// Other numbers, each so often.
pub(super) type Terms = Box<[(f64, u32)]>;

/// What a sum comes to.
pub(super) fn summed(terms: &[(f64, u32)], of: &mut dyn FnMut(u32) -> Quantity) -> Quantity {
    let each = terms
        .iter()
        .map(|(times, number)| of(*number).times(*times));
    each.fold(Quantity::exactly(0.0), Quantity::plus)
}

impl Known {
    /// A position becomes another one, or the sum of several, each so often.
    pub(in crate::program::inform) fn add_up(
        &mut self,
        position: VariableId,
        of: &[(f64, VariableId)],
    ) {
        let others = of.iter().map(|(_, other)| *other);
        let others = others.filter(|other| *other != position);
        self.sources.entry(position).or_default().extend(others);
        self.now
            .retain(|_, now| now.of.is_none_or(|(of, _)| of != position));
        for at in 0..OF_POSITION {
            let terms = of.iter().map(|(times, of)| (*times, self.element(*of, at)));
            let terms: Terms = terms.collect();
            for (_, number) in &terms {
                self.reads_element(*number);
            }
            let each = terms.iter().map(|(times, number)| {
                let now = self.now.get(number).filter(|now| now.of.is_none())?;
                Some(times * now.value)
            });
            let value = each.sum::<Option<f64>>();
            let present = value.map(|value| Now { of: None, value });
            let element = self.element(position, at);
            // a sum that the job has just written is what stands in its place
            let terms = terms.iter().flat_map(|(times, number)| {
                let sum = self.sums.get(number).filter(|sum| sum.len() < MOST_TERMS);
                let of_sum = sum
                    .into_iter()
                    .flatten()
                    .map(move |(each, of)| (times * each, *of));
                let alone = Some((*times, *number)).filter(|_| sum.is_none());
                of_sum.chain(alone)
            });
            let terms: Terms = terms.collect();
            self.put(element, present, Written::Sum(terms));
        }
    }

    /// A position, and those of which it is a copy or a sum.
    pub(in crate::program::inform) fn sources(&self, position: VariableId) -> HashSet<VariableId> {
        let mut all = HashSet::from_iter([position]);
        let mut open = vec![position];
        while let Some(of) = open.pop().map(|one| self.sources.get(&one)) {
            for &source in of.into_iter().flatten() {
                if all.insert(source) {
                    open.push(source);
                }
            }
        }
        all
    }

    /// A position as it was just written, where it was.
    pub(in crate::program::inform) fn position_now(&mut self, position: VariableId) -> Amounts {
        std::array::from_fn(|at| {
            let element = self.element(position, at);
            self.reads_element(element);
            let now = self.now.get(&element).filter(|now| now.of.is_none());
            let exactly = now.map(|now| Amount::Exactly(now.value));
            exactly.or_else(|| self.sums.get(&element).cloned().map(Amount::Sum))
        })
    }

    /// A number of a position is read: it is what only the running program knows, too, where nothing
    /// says that it was set before.
    fn reads_element(&mut self, element: u32) {
        let now = self.now.get(&element).filter(|now| now.of.is_none());
        let is_set = self.declared.contains(&element)
            || self.set.contains_key(&element)
            || self.sums.contains_key(&element);
        if now.is_none() && !is_set {
            self.numbers.lose(element);
        }
    }

    /// The numbers of a position: as it was, or any that the text writes into it.
    pub(in crate::program::inform) fn amounts(
        &mut self,
        position: VariableId,
        now: &Amounts,
    ) -> [Quantity; OF_POSITION] {
        std::array::from_fn(|at| {
            match &now[at] {
                Some(Amount::Exactly(value)) => return Quantity::exactly(*value),
                Some(Amount::Sum(terms)) => return summed(terms, &mut |of| self.value(of)),
                None => {}
            }
            let element = self.element(position, at);
            self.value(element)
        })
    }
}
