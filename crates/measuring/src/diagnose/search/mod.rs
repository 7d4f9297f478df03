//! Which effects explain the residuals: forward, with exchange and removal after every step.

pub mod candidates;
mod drifts;
pub(crate) mod scan;
pub mod stand_ins;
pub mod tried;
pub(crate) mod waves;

use self::candidates::{Candidate, Candidates};
use self::scan::View;
use crate::diagnose::estimator::chances::occam;
use crate::diagnose::estimator::fit::{Fit, Normal};
use crate::diagnose::estimator::gain::Gain;
use crate::diagnose::estimator::table::{Column, Layout};
use crate::identify::pick::Pick;
use crate::model::effects::{Effect, of_arm};

/// An effect must be better than nothing by this, in units of twice a log likelihood.
const MARGIN: f64 = 3.0;
/// Most effects found.
pub(crate) const MOST_EFFECTS: usize = 12;
/// Up to so many, exchange goes on until nothing changes, and two may become one; beyond, one
/// revolution a step.
const FEW_EFFECTS: usize = 4;
/// Turns of exchange and removal after a step.
const MOST_TURNS: usize = 4;
/// Another effect takes the place of one found where it is better by this.
const BETTER: f64 = 0.3;
/// Rows from which on effects hold are the same where they are this near.
const SAME_ROW: u32 = 3;
/// Odds of an effect that every arm has in some measure against one that only some have.
pub(crate) const ODDS: f64 = 5.0;

/// Everything that the search looks at.
#[derive(Clone, Debug)]
pub struct World<'a> {
    /// Where the numbers of rows stand.
    pub layout: &'a Layout,
    /// Columns of the parameters that are fitted with them.
    pub held: &'a [Column],
    /// What is tried.
    pub candidates: &'a Candidates,
    /// Rows in use.
    pub used: &'a [bool],
    /// Their normal equations.
    pub normal: Normal<'a>,
    /// How many numbers are in use.
    pub numbers: f64,
    /// Effects that a person wants, whatever the evidence.
    pub accepted: &'a [Pick],
}

/// An effect in the model.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// Which, with its first row if it has one.
    pub candidate: Candidate,
    /// Its columns.
    pub columns: Vec<Column>,
    /// Fall of chi-squared when it is added to all others.
    pub gain: f64,
    /// What its parameters, and its choice among others, cost.
    pub cost: f64,
    /// Values, in typical sizes.
    pub values: Vec<f64>,
    /// The best of the other effects in its place, with what they gain and cost, best first.
    pub alternatives: Vec<Scored>,
}

impl Chosen {
    /// Its merit: gain less cost.
    #[must_use]
    pub fn merit(&self) -> f64 {
        self.gain - self.cost
    }
}

/// A candidate's merit given all others in the model.
#[derive(Clone, Debug)]
pub struct Scored {
    /// Index of the candidate.
    pub index: usize,
    /// Its first row, from 1, if it has one.
    pub row: Option<u32>,
    /// What it gains.
    pub gain: Gain,
    /// What it costs.
    pub cost: f64,
}

impl Scored {
    /// Gain less cost.
    #[must_use]
    pub fn merit(&self) -> f64 {
        self.gain.gain - self.cost
    }
}

/// An effect that begins at a row, with that row in its place.
fn with_row(effect: &Effect, row: Option<u32>) -> Effect {
    let mut effect = effect.clone();
    effect.site.order = row.unwrap_or(effect.site.order);
    effect
}

fn same(a: &Candidate, row: Option<u32>, b: &Candidate) -> bool {
    let kinds = a.effect.kind == b.effect.kind;
    match (row, b.row) {
        (Some(x), Some(y)) => {
            let of_one = a.effect.site.index == b.effect.site.index;
            kinds && of_one && x.abs_diff(y) <= SAME_ROW
        }
        _ => kinds && a.effect.site == b.effect.site,
    }
}

/// Sought twice: the same place and a parameter in common.
pub(crate) fn overlaps(a: &Candidate, row: Option<u32>, b: &Candidate) -> bool {
    let listed = a.effect.definition().listed().is_some();
    same(a, row, b) && (listed || row.is_some() || a.sought.iter().any(|n| b.sought.contains(n)))
}

impl World<'_> {
    /// What naming this effect costs with `count` parameters and this gain: those parameters and
    /// those chosen from a list, the choice among its peers and among all kinds, and the odds
    /// against a rare one.
    pub(crate) fn cost(&self, candidate: &Candidate, gain: f64, count: usize) -> f64 {
        let kinds = of_arm().count() as f64;
        occam(gain, (count + candidate.chosen) as f64, self.numbers)
            + 2.0 * (candidate.peers as f64).ln()
            + 2.0 * kinds.ln()
            + if candidate.effect.definition().search.rare {
                2.0 * ODDS.ln()
            } else {
                0.0
            }
            + MARGIN
    }

    /// The columns of a candidate, from its first row on.
    pub(crate) fn columns(&self, candidate: &Candidate) -> Vec<Column> {
        let all = candidate
            .columns
            .iter()
            .map(|i| self.candidates.columns[*i].column());
        let mut columns: Vec<Column> = all.collect();
        if let Some(row) = candidate.row {
            let start = self.layout.row(row as usize - 1).start;
            for column in &mut columns {
                column[..start].fill(0.0);
            }
        }
        columns
    }

    /// The robust fit with these effects, and before it that of the columns held at its weights and
    /// scale.
    #[must_use]
    pub fn fits(&self, chosen: &[Chosen]) -> (Fit, Fit) {
        let own = chosen.iter().flat_map(|c| &c.columns);
        let own: Vec<&[f64]> = own.map(Vec::as_slice).collect();
        self.normal.fits(&own)
    }

    /// The robust fit with these effects.
    #[must_use]
    pub fn fit(&self, chosen: &[Chosen]) -> Fit {
        self.fits(chosen).1
    }

    /// Residuals of all rows with these effects fitted to those in use, without weights.
    #[must_use]
    pub fn rest(&self, chosen: &[Chosen]) -> Column {
        let own = chosen.iter().flat_map(|c| &c.columns);
        let own: Vec<&[f64]> = own.map(Vec::as_slice).collect();
        self.normal.rest(&own)
    }

    /// An effect of a scan, ready to be in the model.
    #[must_use]
    pub fn chosen(&self, scored: &Scored) -> Chosen {
        let mut candidate = self.candidates.list[scored.index].clone();
        if let Some(row) = scored.row {
            candidate.row = Some(row);
            candidate.effect.site.order = row;
        }
        // a parameter at its bound or redundant is not in the model
        let live: Vec<usize> = (0..candidate.sought.len())
            .filter(|i| scored.gain.values[*i] != 0.0)
            .collect();
        let pick = |list: &[usize]| live.iter().map(|i| list[*i]).collect::<Vec<_>>();
        candidate.sought = pick(&candidate.sought);
        candidate.columns = pick(&candidate.columns);
        candidate.least = live.iter().map(|i| candidate.least[*i]).collect();
        Chosen {
            columns: self.columns(&candidate),
            values: live.iter().map(|i| scored.gain.values[*i]).collect(),
            candidate,
            gain: scored.gain.gain,
            cost: scored.cost,
            alternatives: Vec::new(),
        }
    }

    /// Looks at every effect in the model: exchanges it where another is better in its place,
    /// removes it where it is needless. Whether anything changed.
    fn revise(&self, chosen: &mut Vec<Chosen>, view: &mut View) -> bool {
        let mut changed = false;
        let mut i = 0;
        while i < chosen.len() {
            view.show(self, chosen);
            let keep: Vec<bool> = (0..chosen.len()).map(|k| k != i).collect();
            let scored = view.scan(self, chosen, &keep);
            let current = &chosen[i].candidate;
            if self.wanted(current) {
                // it stays, as well as it fits
                let is_own = |s: &&Scored| self.is_of(s, current);
                if let Some(best) = scored.iter().find(is_own) {
                    let mut renewed = self.chosen(best);
                    let others = scored.iter().filter(|s| !is_own(s));
                    renewed.alternatives = best_of_each(self, others);
                    changed |= renewed.columns != chosen[i].columns;
                    chosen[i] = renewed;
                }
                i += 1;
                continue;
            }
            let is_current = |s: &Scored| {
                let other = &self.candidates.list[s.index];
                same(other, s.row, current)
                    && s.row == current.row
                    && current.columns.iter().all(|c| other.columns.contains(c))
                    && other.effect.parameters == current.effect.parameters
            };
            let own = scored.iter().find(|s| is_current(s));
            let Some(best) = scored.first() else { break };
            match own {
                Some(own) if best.merit() <= own.merit() + BETTER || is_current(best) => {
                    if own.merit() <= 0.0 {
                        chosen.remove(i);
                        changed = true;
                        continue;
                    }
                    let mut renewed = self.chosen(own);
                    let alternatives = scored
                        .iter()
                        .filter(|s| !same(&self.candidates.list[s.index], s.row, current));
                    renewed.alternatives = best_of_each(self, alternatives);
                    chosen[i] = renewed;
                    i += 1;
                }
                _ if best.merit() > 0.0 => {
                    chosen[i] = self.chosen(best);
                    changed = true;
                    i += 1;
                }
                _ => {
                    chosen.remove(i);
                    changed = true;
                }
            }
        }
        changed
    }

    /// Whether a person wants it; without such wishes the evidence decides.
    pub(crate) fn wanted(&self, candidate: &Candidate) -> bool {
        let own = &candidate.effect;
        self.accepted.iter().any(|pick| pick.means(own))
    }

    /// Whether a candidate may be in the model: where a person has said what is, nothing else is
    /// sought.
    fn allowed(&self, scored: &Scored) -> bool {
        let candidate = &self.candidates.list[scored.index];
        let of_row = |row| with_row(&candidate.effect, row);
        self.accepted.is_empty()
            || (self.accepted.iter()).any(|pick| pick.means(&of_row(scored.row)))
    }

    /// The same effect at the same place, from the same row on.
    fn is_of(&self, scored: &Scored, current: &Candidate) -> bool {
        let other = &self.candidates.list[scored.index];
        other.effect.kind == current.effect.kind
            && with_row(&other.effect, scored.row).site == current.effect.site
    }

    /// The effects that a person wants, each as well as it fits.
    fn first(&self, view: &mut View) -> Vec<Chosen> {
        let mut chosen: Vec<Chosen> = Vec::new();
        for pick in self.accepted {
            // one effect is wanted whatever the evidence; of several, those that the search finds
            let mut sites: Vec<&Candidate> = Vec::new();
            for candidate in &self.candidates.list {
                let means = pick.means(&candidate.effect)
                    || candidate.row.is_some() && pick.kind == Some(candidate.effect.kind);
                if means && !sites.iter().any(|c| c.effect.site == candidate.effect.site) {
                    sites.push(candidate);
                }
            }
            if sites.len() != 1 {
                continue;
            }
            let scored = view.best(self, &chosen);
            let means = |s: &&Scored| {
                let effect = &self.candidates.list[s.index].effect;
                pick.means(&with_row(effect, s.row))
            };
            let known = |c: &Chosen| pick.means(&c.candidate.effect);
            if !chosen.iter().any(known) {
                chosen.extend(scored.iter().find(means).map(|s| self.chosen(s)));
            }
        }
        chosen
    }

    /// Puts one effect in the place of two where it is better. Whether anything changed.
    fn merge(&self, chosen: &mut Vec<Chosen>, view: &mut View) -> bool {
        if chosen.len() < 2 || chosen.len() > FEW_EFFECTS {
            return false;
        }
        view.show(self, chosen);
        for i in 0..chosen.len() {
            for j in i + 1..chosen.len() {
                if self.wanted(&chosen[i].candidate) || self.wanted(&chosen[j].candidate) {
                    continue;
                }
                let keep: Vec<bool> = (0..chosen.len()).map(|k| k != i && k != j).collect();
                let both = view.loss(&keep) - chosen[i].cost - chosen[j].cost;
                let scored = view.scan(self, chosen, &keep);
                let better = |s: &&Scored| s.merit() > both + BETTER;
                if let Some(best) = scored.first().filter(better) {
                    let one = self.chosen(best);
                    chosen.remove(j);
                    chosen[i] = one;
                    return true;
                }
            }
        }
        false
    }

    /// The effects that explain the residuals, in the order found, beginning with `first`.
    #[must_use]
    pub fn search(&self, first: Vec<Chosen>) -> Vec<Chosen> {
        let mut view = View::of(self);
        let mut chosen = if first.is_empty() {
            self.first(&mut view)
        } else {
            first
        };
        let mut seen: Vec<String> = Vec::new();
        for _ in 0..2 * MOST_EFFECTS {
            let turns = if chosen.len() > FEW_EFFECTS && self.accepted.is_empty() {
                1
            } else {
                MOST_TURNS
            };
            for _ in 0..turns {
                let revised = self.revise(&mut chosen, &mut view);
                if !revised && !self.merge(&mut chosen, &mut view) {
                    break;
                }
            }
            let mut names: Vec<String> =
                chosen.iter().map(|c| c.candidate.effect.label()).collect();
            names.sort();
            let state = names.join(";");
            if chosen.len() >= MOST_EFFECTS || seen.contains(&state) && !chosen.is_empty() {
                break;
            }
            seen.push(state);
            let scored = view.best(self, &chosen);
            let best = scored.into_iter().find(|s| self.allowed(s));
            let Some(best) = best.filter(|best| best.merit() > 0.0) else {
                break;
            };
            let merit = |set: &[Scored]| set.iter().map(Scored::merit).sum::<f64>();
            let set = of_arm()
                .filter(|kind| kind.definition().search.as_a_set)
                .map(|kind| {
                    let mut all = view.all_of(self, &chosen, kind);
                    all.retain(|s| self.allowed(s));
                    all
                })
                .filter(|set| set.len() > 1 && merit(set) > best.merit())
                .max_by(|a, b| merit(a).total_cmp(&merit(b)));
            match set {
                Some(set) => chosen.extend(set.iter().map(|s| self.chosen(s))),
                None => chosen.push(self.chosen(&best)),
            }
        }
        chosen
    }
}

/// The effect first without which most is lost.
pub(crate) fn by_gain(mut chosen: Vec<Chosen>) -> Vec<Chosen> {
    chosen.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    chosen
}

/// The best variant of each effect.
fn best_of_each<'a>(world: &World, scored: impl Iterator<Item = &'a Scored>) -> Vec<Scored> {
    let mut best: Vec<Scored> = Vec::new();
    for s in scored {
        let candidate = &world.candidates.list[s.index];
        let known = best.iter().any(|b| {
            let other = &world.candidates.list[b.index];
            other.effect.kind == candidate.effect.kind
                && (s.row.is_some() || other.effect.site == candidate.effect.site)
        });
        if !known {
            best.push(s.clone());
        }
        if best.len() >= 8 {
            break;
        }
    }
    best
}
