//! Effects of one kind in the place of several of another: a group of like effects is dropped, and
//! others stand in.

use super::scan::View;
use super::{Chosen, Scored, World};
use crate::diagnose::estimator::refit::refit;
use crate::diagnose::judgement::attempt::Attempt;
use crate::identify::problem::Estimate;
use crate::model::JOINTS;
use crate::model::effects::{Effect, Kind, SiteKey, shown_by_tool};

/// Others compete where they explain this part of what the group explains.
const PART: f64 = 0.25;
/// At most so many are reported.
const MOST: usize = 6;

/// Effects that compete with a group of those found.
#[derive(Clone, Debug)]
pub struct StandIn {
    /// Indices of the effects found that they would stand for.
    pub instead_of: Vec<usize>,
    /// The effects, with their values.
    pub effects: Vec<Effect>,
    /// Fall of chi-squared.
    pub gain: f64,
    /// As a part of that of the group.
    pub part: f64,
    /// By how much the group is better, in twice a log likelihood, the choice counted.
    pub behind: f64,
    /// What they leave of a coordinate, metres.
    pub residual_m: f64,
    /// The model with them.
    pub(crate) estimate: Estimate,
}

/// Effects that would compete with a group of those found if they could be what they would have to
/// be.
#[derive(Clone, Debug, PartialEq)]
pub struct Impossible {
    /// Indices of the effects found that they would stand for.
    pub instead_of: Vec<usize>,
    /// Those of them that are impossible, with the values they would have.
    pub effects: Vec<Effect>,
    /// Fall of chi-squared by all of their kind, as a part of that of the group.
    pub part: f64,
}

/// Effects of one kind, and those of one kind at one joint.
fn groups(chosen: &[Chosen]) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = Vec::new();
    let mut push = |group: Vec<usize>| {
        if !group.is_empty() && !all.contains(&group) {
            all.push(group);
        }
    };
    for kind in shown_by_tool() {
        let definition = kind.definition();
        if definition.of_data {
            continue;
        }
        let like = |i: &usize| chosen[*i].candidate.effect.kind == kind;
        push((0..chosen.len()).filter(like).collect());
        if definition.site.contains(&SiteKey::Joint) {
            for joint in 0..JOINTS {
                let here = |i: &usize| like(i) && chosen[*i].candidate.effect.site.index == joint;
                push((0..chosen.len()).filter(here).collect());
            }
        }
    }
    all
}

struct Found {
    group: Vec<usize>,
    others: Vec<Chosen>,
    added: usize,
    gain: f64,
    part: f64,
    behind: f64,
}

/// Effects of this kind in the place of a group, as many as it has at most.
fn of_kind(
    world: &World,
    view: &View,
    chosen: &[Chosen],
    group: &[usize],
    first: &Scored,
    kind: Kind,
) -> (Vec<Chosen>, f64) {
    let mut others: Vec<Chosen> = (0..chosen.len())
        .filter(|i| !group.contains(i))
        .map(|i| chosen[i].clone())
        .collect();
    let mut gain = first.gain.gain;
    others.push(world.chosen(first));
    for _ in 1..group.len() {
        let scored = view.scan_others(world, &others);
        let next = scored
            .iter()
            .find(|s| world.candidates.list[s.index].effect.kind == kind);
        let Some(next) = next.filter(|s| s.merit() > 0.0) else {
            break;
        };
        gain += next.gain.gain;
        others.push(world.chosen(next));
    }
    (others, gain)
}

/// Springs that would explain as much as a group of other effects if some of them pushed against
/// their load.
pub(crate) fn impossible(attempt: &Attempt, world: &World) -> Vec<Impossible> {
    let chosen = &attempt.chosen;
    let mut view = View::of(world);
    view.show(world, chosen);
    let mut all: Vec<Impossible> = Vec::new();
    for group in groups(chosen) {
        if group.iter().any(|i| world.wanted(&chosen[*i].candidate)) {
            continue;
        }
        let keep: Vec<bool> = (0..chosen.len()).map(|i| !group.contains(&i)).collect();
        let loss = view.loss(&keep);
        let own = chosen[group[0]].candidate.effect.kind;
        let others = shown_by_tool().filter(|kind| *kind != own);
        for kind in others.filter(|kind| kind.definition().parameters.len() == 1) {
            let set = |bounded| view.set_of(world, (chosen, &keep), kind, bounded);
            let (Some((members, free)), Some((_, real))) = (set(false), set(true)) else {
                continue;
            };
            let part = free.gain / loss.max(1e-12);
            if part < PART || 2.0 * real.gain > free.gain {
                continue;
            }
            let list = &world.candidates.list;
            let values = members.iter().zip(&free.values);
            let beyond =
                values.filter(|(i, value)| list[**i].least[0].is_some_and(|least| **value < least));
            let effects = beyond.map(|(i, value)| {
                let mut effect = list[*i].effect.clone();
                let number = list[*i].sought[0];
                let parameter = &effect.definition().parameters[number];
                effect.parameters[number] += value * parameter.prior_sigma * parameter.unit.in_si();
                effect
            });
            all.push(Impossible {
                instead_of: group.clone(),
                effects: effects.collect(),
                part,
            });
        }
    }
    // of one kind what would stand for most
    all.sort_by_key(|i| std::cmp::Reverse(i.instead_of.len()));
    let mut listed: Vec<Kind> = Vec::new();
    all.retain(|i| {
        let kind = i.effects.first().map(|e| e.kind);
        let is_new = kind.is_some_and(|kind| !listed.contains(&kind));
        listed.extend(kind);
        is_new
    });
    all
}

/// What competes with groups of the effects found, the nearest first. Where the verdict is sure
/// only what explains nearly all is reported: `least` is the part.
pub(crate) fn stand_ins(attempt: &Attempt, world: &World, least: Option<f64>) -> Vec<StandIn> {
    let chosen = &attempt.chosen;
    let least = least.unwrap_or(PART);
    let mut view = View::of(world);
    view.show(world, chosen);
    let mut found: Vec<Found> = Vec::new();
    for group in groups(chosen) {
        // one in the place of one is reported with the effect itself
        if group.len() < 2 || group.iter().any(|i| world.wanted(&chosen[*i].candidate)) {
            continue;
        }
        let keep: Vec<bool> = (0..chosen.len()).map(|i| !group.contains(&i)).collect();
        let loss = view.loss(&keep);
        let own = chosen[group[0]].candidate.effect.kind;
        let scored = view.scan(world, chosen, &keep);
        let cost: f64 = group.iter().map(|i| chosen[*i].cost).sum();
        for kind in shown_by_tool() {
            if kind == own || kind.definition().of_data {
                continue;
            }
            let Some(first) = (scored.iter())
                .find(|s| world.candidates.list[s.index].effect.kind == kind)
                .filter(|s| s.gain.gain * group.len() as f64 >= least * loss)
            else {
                continue;
            };
            let (others, gain) = of_kind(world, &view, chosen, &group, first, kind);
            let added = others.len() + group.len() - chosen.len();
            let their: f64 = others.iter().rev().take(added).map(|c| c.cost).sum();
            let part = gain / loss.max(1e-12);
            if part >= least {
                found.push(Found {
                    group: group.clone(),
                    others,
                    added,
                    gain,
                    part,
                    behind: loss - cost - (gain - their),
                });
            }
        }
    }
    found.sort_by(|a, b| b.part.total_cmp(&a.part));
    // of one kind in the place of another the nearest
    let kinds = |f: &Found| {
        let last = &f.others[f.others.len() - 1];
        let own = &chosen[f.group[0]];
        (own.candidate.effect.kind, last.candidate.effect.kind)
    };
    let mut listed: Vec<(Kind, Kind)> = Vec::new();
    found.retain(|f| {
        let is_new = !listed.contains(&kinds(f));
        listed.push(kinds(f));
        is_new
    });
    found.truncate(MOST);
    let session = &attempt.session;
    let answer = |f: Found| {
        let (refitted, _) = refit(session.start(), &f.others, world.used);
        let effects = (f.others.iter().zip(&refitted.places))
            .skip(f.others.len() - f.added)
            .map(|(c, place)| {
                let mut effect = refitted.estimate.effects[*place].clone();
                effect.site = c.candidate.effect.site.clone();
                effect
            });
        StandIn {
            instead_of: f.group,
            effects: effects.collect(),
            gain: f.gain,
            part: f.part,
            behind: f.behind,
            residual_m: refitted.scale * attempt.sigma_m(),
            estimate: refitted.estimate,
        }
    };
    found.into_iter().map(answer).collect()
}
