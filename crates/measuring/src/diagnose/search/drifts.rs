//! Drifts with a short constant, held against what is there from the first row on.

use super::candidates::{Candidate, Candidates, columns_of};
use crate::identify::problem::{Estimate, Problem};
use crate::model::effects::{Effect, List};

/// A drift with a constant up to this part of the session's length is nearly one that was there from
/// the first row on: of its squares the part `constant / (2 · length)` is in what it lacks of that,
/// up to a twentieth.
const SHORT: f64 = 0.1;

/// The constant of an effect that drifts, with the list it is chosen from.
fn constant_of(effect: &Effect) -> Option<(usize, List)> {
    let listed = effect.definition().listed();
    listed.filter(|(_, list)| matches!(list, List::Times | List::Rows))
}

impl Candidates {
    /// Adds what is there from the first row on in the place of each drift, and holds those with a
    /// short constant against it.
    pub(super) fn hold_drifts(&mut self, problem: &Problem, estimate: &Estimate) {
        let mut wanted: Vec<(Effect, Vec<usize>)> = Vec::new();
        for candidate in &self.list {
            if let Some((number, _)) = constant_of(&candidate.effect) {
                let mut effect = candidate.effect.clone();
                effect.parameters[number] = 0.0;
                if !wanted.iter().any(|(known, _)| *known == effect) {
                    wanted.push((effect, candidate.sought.clone()));
                }
            }
        }
        let columns = columns_of(problem, estimate, &wanted);
        for ((effect, sought), own) in wanted.into_iter().zip(columns) {
            let first = self.columns.len();
            self.columns.extend(own);
            self.list.push(Candidate {
                effect,
                columns: (first..self.columns.len()).collect(),
                least: vec![None; sought.len()],
                sought,
                row: None,
                chosen: 0,
                peers: 1,
                steady: None,
                is_measure: true,
            });
        }
        for i in 0..self.list.len() {
            self.list[i].steady = self.steady(&self.list[i].effect);
        }
    }

    /// The candidate that a drift with a short constant is held against.
    pub(crate) fn steady(&self, effect: &Effect) -> Option<usize> {
        let (number, list) = constant_of(effect)?;
        let length = match list {
            List::Times => self.length.0,
            _ => self.length.1,
        };
        let of_place = |c: &Candidate| {
            c.is_measure && c.effect.kind == effect.kind && c.effect.site == effect.site
        };
        (effect.parameters[number] <= SHORT * length)
            .then(|| self.list.iter().position(of_place))
            .flatten()
    }
}
