//! How often what is added to a number is, in routines that go from label to label: conditions that the routine
//! comes past between two of these bound it, by themselves or by a number that counts along.

use super::super::quantity::Quantity;
use super::bounds::Relation;
use super::flow::{Flow, Passed};
use super::{Evaluate, Gathered, Numbers, Site, rounds};
use foldhash::HashSet;

/// What is so of a number where a routine goes from a step to the next, or to another.
#[derive(Debug)]
pub(super) struct Check<W> {
    routine: u32,
    edge: Passed,
    number: u32,
    relation: Relation,
    limit: W,
}

/// A condition that bounds how often a number grows.
struct Bounding {
    edge: Passed,
    most: u32,
    /// The number comes to its limit, and is not compared with what is beyond.
    passes_none: bool,
}

impl<W> Numbers<W> {
    /// Where a routine goes from a step of its [`Flow`] to the next, or to another, a number is to a limit as
    /// given.
    pub(in crate::program) fn check(
        &mut self,
        routine: u32,
        (step, is_next): (u32, bool),
        number: u32,
        (relation, limit): (Relation, W),
    ) {
        self.checks.push(Check {
            routine,
            edge: Passed::Edge(step, is_next),
            number,
            relation,
            limit,
        });
    }

    /// How often at most a number grows between two places that set it anew; `None` where nothing bounds
    /// that.
    pub(super) fn rounds_between(
        &self,
        number: u32,
        gathered: &Gathered,
        evaluate: &Evaluate<W>,
        open: &mut Vec<u32>,
    ) -> Option<u32> {
        let [(_, Some(site))] = gathered.growing[..] else {
            return None;
        };
        let (step, flow) = (site.step?, self.flows.get(&site.routine)?);
        if self.also_elsewhere.contains(&number) || self.runs_inside_itself(site.routine) {
            return None;
        }
        let resets = steps_of(&gathered.resets, site.routine);
        let anew = |passed: Passed| matches!(passed, Passed::Step(at) if resets.contains(&at));
        if flow.again(step, &|passed, _| (!anew(passed)).then_some(0)) == 0 {
            return Some(1);
        }
        if let Some((most, _)) = self.checked(number, gathered, evaluate, open) {
            return Some(most);
        }
        // a number that counts along
        let of_routine = self
            .checks
            .iter()
            .filter(|check| check.routine == site.routine);
        let others: HashSet<u32> = of_routine.map(|check| self.one(check.number)).collect();
        let mut others: Vec<u32> = others.into_iter().filter(|one| *one != number).collect();
        others.sort_unstable();
        let along = others.into_iter().filter_map(|other| {
            if open.contains(&other) || self.also_elsewhere.contains(&other) {
                return None;
            }
            open.push(other);
            let of = self.gathered(other, evaluate, open);
            let most = of.and_then(|of| {
                let (most, edges) = self.checked(other, &of, evaluate, open)?;
                counted_along(&of, (most, &edges), (flow, site), &anew)
            });
            open.pop();
            most
        });
        along.min()
    }

    /// How often at most a number grows whose own conditions bound it, and where these are.
    fn checked(
        &self,
        number: u32,
        gathered: &Gathered,
        evaluate: &Evaluate<W>,
        open: &mut Vec<u32>,
    ) -> Option<(u32, Vec<Passed>)> {
        let [(by, Some(site))] = &gathered.growing[..] else {
            return None;
        };
        let by = by.exact().filter(|_| gathered.is_alone())?;
        let (step, flow) = (site.step?, self.flows.get(&site.routine)?);
        if self.runs_inside_itself(site.routine) {
            return None;
        }
        let checks = self
            .checks
            .iter()
            .filter(|check| check.routine == site.routine && self.one(check.number) == number);
        let bounds: Vec<Bounding> = checks
            .filter_map(|check| {
                let limit = evaluate(&check.limit, &mut |other| {
                    self.value_in(other, evaluate, open)
                });
                Some(Bounding {
                    edge: check.edge,
                    most: growths(check.relation, &gathered.all, by, &limit)?,
                    passes_none: check.relation == Relation::NotEqual,
                })
            })
            .collect();
        let resets = steps_of(&gathered.resets, site.routine);
        let is_bounded = |edges: &[Passed]| {
            let is_wall = |passed: Passed| match passed {
                Passed::Step(at) => resets.contains(&at),
                Passed::Edge(..) => edges.contains(&passed),
            };
            flow.again(step, &|passed, _| (!is_wall(passed)).then_some(0)) == 0
        };
        // between two limits it may pass one that it never equals where that is looked at
        let joined = bounds.iter().filter(|bounding| !bounding.passes_none);
        let joined: Vec<&Bounding> = joined.collect();
        let each = bounds.iter().map(|bounding| vec![bounding]).chain([joined]);
        let each = each.filter_map(|of| {
            let edges: Vec<Passed> = of.iter().map(|bounding| bounding.edge).collect();
            let most = of.iter().map(|bounding| bounding.most).max()?;
            is_bounded(&edges).then_some((most, edges))
        });
        each.min_by_key(|(most, _)| *most)
    }
}

/// How often at most a routine comes to a place without setting its number anew (`anew`), where
/// another number that grows so often, by conditions on these edges, counts along.
fn counted_along(
    of: &Gathered,
    (most, edges): (u32, &[Passed]),
    (flow, site): (&Flow, &Site),
    anew: &dyn Fn(Passed) -> bool,
) -> Option<u32> {
    let is_here = |other: &Site| other.routine == site.routine && other.step.is_some();
    let [(_, Some(grows))] = of.growing[..] else {
        return None;
    };
    if !is_here(grows) || !of.resets.iter().all(|reset| is_here(reset)) {
        return None;
    }
    let (step, grows) = (site.step?, grows.step?);
    let resets = steps_of(&of.resets, site.routine);
    // the other number begins anew on the way
    let restarts = flow.again(step, &|passed, state| match passed {
        _ if anew(passed) => None,
        Passed::Step(at) if resets.contains(&at) => Some(1),
        _ => Some(state),
    });
    if restarts & 2 != 0 {
        return None;
    }
    // each time the other number grows, and is compared behind that
    let before = flow.again(step, &|passed, state| match (passed, state) {
        _ if anew(passed) => None,
        (Passed::Step(at), _) if at == grows => Some(1),
        (_, 1) if edges.contains(&passed) => None,
        _ => Some(state),
    });
    if before == 0 {
        return Some(most);
    }
    // each time the other number grows
    let is_without = |passed| !anew(passed) && passed != Passed::Step(grows);
    let without = flow.again(step, &|passed, _| is_without(passed).then_some(0));
    (without == 0).then_some(most.saturating_add(1))
}

/// The steps at which a routine sets a number anew.
fn steps_of(resets: &[&Site], routine: u32) -> Vec<u32> {
    let here = resets.iter().filter(|reset| reset.routine == routine);
    here.filter_map(|reset| reset.step).collect()
}

/// How often a number grows at most that is one of these at first, where each time but the first it
/// is to a limit as given.
pub(super) fn growths(
    relation: Relation,
    start: &[Quantity],
    by: f64,
    limit: &Quantity,
) -> Option<u32> {
    let ends: Option<Vec<(f64, f64)>> = start.iter().map(Quantity::ends).collect();
    let ends = ends?;
    let (least, greatest) = limit.ends()?;
    let (is_strict, to) = match relation {
        Relation::Below { is_strict } if by > 0.0 => (is_strict, greatest),
        Relation::Above { is_strict } if by < 0.0 => (is_strict, least),
        Relation::NotEqual => {
            let all = ends.into_iter().map(|(first, last)| {
                let is_one = first == last && least == greatest;
                let times = (least - first) / by;
                let is_hit = is_one && [first, least, by].iter().all(|n| n.fract() == 0.0);
                (is_hit && times.fract() == 0.0 && times >= 1.0).then(|| rounds(first, least, by))
            });
            // the last of them would be beyond the limit
            let most = all.collect::<Option<Option<Vec<u32>>>>()??;
            return most.into_iter().max().map(|most| most - 1);
        }
        _ => return None,
    };
    let from = ends
        .into_iter()
        .map(|(first, last)| if by > 0.0 { first } else { last });
    let from = from.reduce(|a, b| if by > 0.0 { a.min(b) } else { a.max(b) })?;
    // sums of whole numbers are exact: below 4 is not 4
    let is_whole = [from, to, by].iter().all(|number| number.fract() == 0.0);
    let is_short = is_strict && is_whole && ((to - from) / by).fract() == 0.0;
    let most = rounds(from, to, by)?;
    Some(if is_short {
        most.saturating_sub(1).max(1)
    } else {
        most
    })
}
