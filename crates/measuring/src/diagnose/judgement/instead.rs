//! What else may have done what an effect found does, and is no effect of the registry: a device
//! that moves slowly in the place of one that moved at once, and a joint that scatters in the place
//! of one that has a wave.

use super::EVIDENT;
use super::conclusion::corrected;
use crate::diagnose::estimator::fit::Fit;
use crate::diagnose::estimator::gain::{Given, Group};
use crate::diagnose::estimator::table::{Column, dot};
use crate::diagnose::question::Session;
use crate::diagnose::search::candidates::{MOST_ORDERS, columns_of};
use crate::diagnose::search::waves::wave;
use crate::diagnose::search::{Chosen, World};
use crate::model::effects::{Effect, Kind, SiteKey};

/// What may be in the place of an effect found.
pub(crate) struct Instead {
    /// Index of the effect found.
    pub of: usize,
    /// In words.
    pub what: String,
    /// By how much the effect found is better, in twice a log likelihood, its choice counted.
    pub behind: f64,
}

/// What may be in the place of the effects found.
pub(crate) fn instead(session: &Session, used: &[bool], chosen: &[Chosen]) -> Vec<Instead> {
    let world = session.world(used, &[]);
    let (mut all, mut kinds) = (Vec::new(), Vec::new());
    for (i, own) in chosen.iter().enumerate() {
        let effect = &own.candidate.effect;
        let one = SiteKey::Order.one();
        if effect.definition().begins_at_a_row() {
            if !kinds.contains(&(effect.kind, effect.site.index)) {
                kinds.push((effect.kind, effect.site.index));
                all.extend(slow(session, &world, chosen, effect));
            }
        } else if effect.definition().site.contains(&SiteKey::Order)
            && effect.site.order > MOST_ORDERS * one
            && session.layout.configurations().is_empty()
        {
            all.extend(scatter(session, &world, chosen, i));
        }
    }
    all
}

/// What moves at rows, moving slowly from the first row to the last instead: along a polynomial of
/// the row, for which no row is chosen. Effects at rows of one kind are steps of one thing: one
/// polynomial is in the place of them all.
fn slow(session: &Session, world: &World, chosen: &[Chosen], of: &Effect) -> Vec<Instead> {
    let is_own = |c: &Chosen| {
        let effect = &c.candidate.effect;
        effect.definition().begins_at_a_row()
            && (effect.kind, effect.site.index) == (of.kind, of.site.index)
    };
    let members: Vec<usize> = (0..chosen.len()).filter(|i| is_own(&chosen[*i])).collect();
    let Some(first) = members.first().map(|i| &chosen[*i].candidate) else {
        return Vec::new();
    };
    let (base, fit) = world.fits(chosen);
    let effects: Vec<&[Column]> = chosen.iter().map(|c| c.columns.as_slice()).collect();
    let given = Given::of((&base, world.held), &fit, &effects);
    let gain = |columns: &[Column], kept: &[bool]| {
        let (group, cross) = group_of(world, &base, &given, columns);
        let cross: Vec<&[f64]> = cross.iter().map(Vec::as_slice).collect();
        let none = vec![None; columns.len()];
        given.gain(&group, &cross, &given.kept(kept), &none)
    };
    let mut effect = first.effect.clone();
    effect.site.order = 1;
    let all = (0..effect.definition().parameters.len()).collect();
    let columns = columns_of(&session.problem, &session.about, &[(effect, all)]);
    let columns: Vec<Column> = columns.into_iter().flatten().collect();
    let layout = world.layout;
    let along = |column: &Column, degree: usize| {
        let mut column = column.clone();
        for row in 0..layout.rows() {
            let part = 2.0 * (row as f64 + 0.5) / layout.rows() as f64 - 1.0;
            let times = legendre(degree, part);
            layout.row(row).for_each(|number| column[number] *= times);
        }
        column
    };
    let merit = |degree: usize, count: usize, kept: &[bool]| {
        let powers = (1..=degree).flat_map(|d| columns[..count].iter().map(move |c| (c, d)));
        let powers: Vec<Column> = powers.map(|(c, d)| along(c, d)).collect();
        let gain = gain(&powers, kept)?;
        // the place alone or the whole, and how many powers
        let mut candidate = first.clone();
        (candidate.peers, candidate.chosen) = (2 * MOST_POWERS, 0);
        Some(gain.gain - world.cost(&candidate, gain.gain, gain.count))
    };
    let place = columns.len().min(3);
    let best = |most: usize, kept: &[bool]| {
        let all = (1..=most).flat_map(|d| [(d, place), (d, columns.len())]);
        let each = all.filter_map(|(degree, count)| merit(degree, count, kept));
        each.reduce(f64::max)
    };
    let others: Vec<bool> = chosen.iter().map(|c| !is_own(c)).collect();
    let own = members.iter().flat_map(|i| &chosen[*i].columns);
    let own: Vec<Column> = own.cloned().collect();
    let cost: f64 = members.iter().map(|i| chosen[*i].cost).sum();
    let steps = gain(&own, &others).map(|gain| gain.gain - cost);
    let slowly = best(MOST_POWERS, &others);
    let together = steps.zip(slowly).map(|(steps, slowly)| steps - slowly);
    let what = match of.kind {
        Kind::FrameShift => "a measuring device or a base that moves slowly",
        _ if of.definition().of_point() => "a reflector that moves slowly",
        _ => "a tool that moves slowly",
    };
    let instead = |i: &usize| {
        // one of them alone, moving evenly
        let kept: Vec<bool> = (0..chosen.len()).map(|k| k != *i).collect();
        let alone = best(1, &kept).map(|evenly| chosen[*i].merit() - evenly);
        Some(Instead {
            of: *i,
            what: what.to_owned(),
            behind: alone.into_iter().chain(together).reduce(f64::min)?,
        })
    };
    members.iter().filter_map(instead).collect()
}

/// Powers of the row that are tried: a session that warms up and cools down again has a few bends.
const MOST_POWERS: usize = 6;

/// A Legendre polynomial, of −1 to 1.
///
/// # Source
/// M. Abramowitz, I. Stegun, *Handbook of Mathematical Functions* (1964), 22.7.10.
fn legendre(degree: usize, x: f64) -> f64 {
    let (mut last, mut here) = (0.0, 1.0);
    for n in 0..degree {
        let n = n as f64;
        (last, here) = (here, ((2.0 * n + 1.0) * x * here - n * last) / (n + 1.0));
    }
    here
}

/// Products of columns, with one another and with the effects.
pub(super) fn group_of(
    world: &World,
    base: &Fit,
    given: &Given,
    columns: &[Column],
) -> (Group, Vec<Vec<f64>>) {
    let taken = columns
        .iter()
        .map(|c| world.normal.taken(base, c, &world.normal.products(c)));
    let taken: Vec<Vec<f64>> = taken.collect();
    let own: Vec<Column> = columns.iter().map(|c| base.weighted(c)).collect();
    let with = |others: &[Column], c: &Column| others.iter().map(|o| dot(o, c)).collect();
    let gram = own.iter().map(|c| with(&own, c)).collect();
    let slopes = own.iter().map(|c| dot(c, &base.left)).collect();
    let cross = own.iter().map(|c| with(given.partial(), c)).collect();
    (Group::of(gram, slopes, &taken), cross)
}

/// A joint with a wave of a gear's teeth that scatters instead: a wave explains some of any
/// scatter, and where that is larger than the noise more than chance by the noise alone.
///
/// Along what the joint moves, a row varies by the noise, which is seen across that, and by what
/// the joint scatters by. `None` where the wave is beyond chance by both.
///
/// # Source
/// H. Scheffé, *The Analysis of Variance* (1959), 7.2: two components of variance, by moments.
fn scatter(session: &Session, world: &World, chosen: &[Chosen], i: usize) -> Option<Instead> {
    let own = &chosen[i];
    let site = &own.candidate.effect.site;
    let mut others = chosen.to_vec();
    others.remove(i);
    let rest = world.rest(&others);
    let turn = [(wave(site.index, 0), vec![0])];
    let turn: Vec<Vec<Column>> = columns_of(&session.problem, &session.about, &turn);
    let turn = &turn[0][0];
    let layout = world.layout;
    let mechanism = session.problem.mechanism();
    let mut seen: Vec<Along> = Vec::new();
    let (mut across, mut numbers) = (0.0, 0.0);
    for row in (0..layout.rows()).filter(|row| world.used[*row]) {
        let range = layout.row(row);
        let (turn, rest) = (&turn[range.clone()], &rest[range.clone()]);
        let square = dot(turn, turn);
        if square > 0.0 {
            let length = square.sqrt();
            let along = dot(turn, rest) / length;
            across += dot(rest, rest) - along * along;
            numbers += range.len() as f64 - 1.0;
            let angle = mechanism.commanded(&session.problem.rows[row].q)[site.index];
            seen.push(Along {
                along,
                length,
                phase: site.periods() * angle,
            });
        }
    }
    if numbers == 0.0 {
        return None;
    }
    let noise = (across / numbers).max(session.floor().powi(2));
    let left = gain_of(&seen, |_| 1.0)?.1;
    let squares = seen.iter().zip(&left);
    let (mut beyond, mut weight) = (0.0, 0.0);
    for (s, left) in squares {
        beyond += s.length.powi(2) * (left * left - noise);
        weight += s.length.powi(4);
    }
    let scatter = (beyond / weight).max(0.0);
    let (gain, _) = gain_of(&seen, |s| noise + scatter * s.length.powi(2))?;
    let parameters = own.values.len() + own.candidate.chosen;
    let is_chance = corrected(gain, parameters, own.candidate.peers) > EVIDENT;
    is_chance.then(|| Instead {
        of: i,
        what: format!("joint {} scattering from row to row", site.index + 1),
        behind: (gain - own.cost).max(0.0),
    })
}

/// A row along what a joint moves.
struct Along {
    /// Its residual, standard deviations.
    along: f64,
    /// How far the joint moves it.
    length: f64,
    phase: f64,
}

/// What a wave gains with rows of this variance, and what it leaves of each.
fn gain_of(seen: &[Along], variance: impl Fn(&Along) -> f64) -> Option<(f64, Vec<f64>)> {
    let (mut a, mut b, mut cc, mut cs, mut ss) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for s in seen {
        let (sin, cos) = s.phase.sin_cos();
        let (x, y) = (s.length * cos, s.length * sin);
        let weight = 1.0 / variance(s);
        a += weight * s.along * x;
        b += weight * s.along * y;
        cc += weight * x * x;
        cs += weight * x * y;
        ss += weight * y * y;
    }
    let size = cc * ss - cs * cs;
    if size <= 1e-9 * cc * ss {
        return None;
    }
    let (p, q) = ((a * ss - b * cs) / size, (b * cc - a * cs) / size);
    let left = seen.iter().map(|s| {
        let (sin, cos) = s.phase.sin_cos();
        s.along - s.length * (p * cos + q * sin)
    });
    Some((a * p + b * q, left.collect()))
}
