//! How often what is added to a number is, in routines that go from label to label: conditions that the routine
//! comes past between two of these bound it, by themselves or by a number that counts along.

use super::super::quantity::Quantity;
use super::bounds::Relation;
use super::flow::{Flow, Passed};
use super::{Evaluate, Gathered, Numbers, Site, rounds};
use std::rc::Rc;

/// Steps and conditions that are looked at in all programs of a run: what would take more is not
/// bounded.
pub(super) const MOST_WORK: usize = 50_000_000;

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

/// A number whose own conditions bound how often it grows between two places that set it anew.
#[derive(Debug)]
pub(super) struct Bounded {
    most: u32,
    /// Where these conditions are.
    edges: Vec<Passed>,
    routine: u32,
    /// The step at which it grows.
    grows: u32,
    /// Where the routine sets it anew; `None` where something else does, too.
    resets: Option<Resets>,
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
        if gathered.is_elsewhere || self.runs_inside_itself(site.routine) {
            return None;
        }
        let resets = Resets::of(&gathered.resets, site.routine);
        let anew = |passed: Passed| resets.are_at(passed);
        if self.again(flow, step, &|passed, _| (!anew(passed)).then_some(0))? == 0 {
            return Some(1);
        }
        if let Some(own) = self.bounded(number, gathered, evaluate, open) {
            return Some(own.most);
        }
        // a number that counts along
        self.can_afford(self.checks.len())?;
        let of_routine = self.checks.iter().filter(|of| of.routine == site.routine);
        let mut others: Vec<u32> = of_routine.map(|of| self.one(of.number)).collect();
        others.sort_unstable();
        others.dedup();
        let along = others.into_iter().filter_map(|other| {
            if other == number || open.contains(&other) {
                return None;
            }
            let known = self.bounded.borrow().get(&other).cloned();
            let other = known.unwrap_or_else(|| {
                open.push(other);
                let of = self.gathered(other, evaluate, open);
                let found = of.and_then(|of| self.bounded(other, &of, evaluate, open));
                open.pop();
                self.bounded.borrow_mut().insert(other, found.clone());
                found
            })?;
            self.counted_along(&other, (flow, site.routine, step), &anew)
        });
        along.min()
    }

    /// A number that grows, where its own conditions bound that.
    fn bounded(
        &self,
        number: u32,
        gathered: &Gathered,
        evaluate: &Evaluate<W>,
        open: &mut Vec<u32>,
    ) -> Option<Rc<Bounded>> {
        let [(by, Some(site))] = &gathered.growing[..] else {
            return None;
        };
        let by = by.exact().filter(|_| gathered.is_alone())?;
        let (grows, flow) = (site.step?, self.flows.get(&site.routine)?);
        if gathered.is_elsewhere || self.runs_inside_itself(site.routine) {
            return None;
        }
        self.can_afford(self.checks.len())?;
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
        let resets = Resets::of(&gathered.resets, site.routine);
        let is_bounded = |edges: &[Passed]| {
            let is_wall = |passed: Passed| resets.are_at(passed) || edges.contains(&passed);
            self.again(flow, grows, &|passed, _| (!is_wall(passed)).then_some(0)) == Some(0)
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
        let (most, edges) = each.min_by_key(|(most, _)| *most)?;
        let is_here = |reset: &&Site| reset.routine == site.routine;
        Some(Rc::new(Bounded {
            most,
            edges,
            routine: site.routine,
            grows,
            resets: gathered.resets.iter().all(is_here).then_some(resets),
        }))
    }

    /// How often at most a routine comes to a step without setting its number anew (`anew`), where
    /// another number counts along.
    fn counted_along(
        &self,
        other: &Bounded,
        (flow, routine, step): (&Flow, u32, u32),
        anew: &dyn Fn(Passed) -> bool,
    ) -> Option<u32> {
        let resets = other.resets.as_ref().filter(|_| other.routine == routine)?;
        // the other number begins anew on the way
        let restarts = self.again(flow, step, &|passed, state| match passed {
            _ if anew(passed) => None,
            _ if resets.are_at(passed) => Some(1),
            _ => Some(state),
        })?;
        if restarts & 2 != 0 {
            return None;
        }
        // each time the other number grows, and is compared behind that
        let before = self.again(flow, step, &|passed, state| match (passed, state) {
            _ if anew(passed) => None,
            (Passed::Step(at), _) if at == other.grows => Some(1),
            (_, 1) if other.edges.contains(&passed) => None,
            _ => Some(state),
        })?;
        if before == 0 {
            return Some(other.most);
        }
        // each time the other number grows
        let is_without = |passed| !anew(passed) && passed != Passed::Step(other.grows);
        let without = self.again(flow, step, &|passed, _| is_without(passed).then_some(0))?;
        (without == 0).then_some(other.most.saturating_add(1))
    }

    /// As [`Flow::again`], as long as there is work left.
    fn again(&self, flow: &Flow, step: u32, pass: &dyn Fn(Passed, u8) -> Option<u8>) -> Option<u8> {
        self.can_afford(flow.len())?;
        Some(flow.again(step, pass))
    }

    fn can_afford(&self, work: usize) -> Option<()> {
        let left = self.work_left.get().checked_sub(work);
        self.work_left.set(left.unwrap_or(0));
        left.map(|_| ())
    }
}

/// Where a routine sets a number anew.
#[derive(Clone, Debug, Default)]
struct Resets {
    /// In order.
    steps: Vec<u32>,
    /// Where the routine begins.
    at_start: bool,
}

impl Resets {
    fn of(resets: &[&Site], routine: u32) -> Self {
        let here = || resets.iter().filter(|reset| reset.routine == routine);
        let mut steps: Vec<u32> = here().filter_map(|reset| reset.step).collect();
        steps.sort_unstable();
        Self {
            steps,
            at_start: here().any(|reset| reset.step.is_none()),
        }
    }

    /// Whether that is one of them.
    fn are_at(&self, passed: Passed) -> bool {
        match passed {
            Passed::Step(at) => self.steps.binary_search(&at).is_ok(),
            Passed::Edge(..) => false,
            Passed::Start => self.at_start,
        }
    }
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
