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
use crate::model::effects::{Kind, SiteKey};

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
    let mut all = Vec::new();
    for (i, own) in chosen.iter().enumerate() {
        let effect = &own.candidate.effect;
        let one = SiteKey::Order.one();
        if effect.definition().begins_at_a_row() {
            all.extend(slow(session, &world, chosen, i));
        } else if effect.definition().site.contains(&SiteKey::Order)
            && effect.site.order > MOST_ORDERS * one
            && session.layout.configurations().is_empty()
        {
            all.extend(scatter(session, &world, chosen, i));
        }
    }
    all
}

/// What moved at a row, moving evenly from the first row to the last instead: no row is chosen for
/// that.
fn slow(session: &Session, world: &World, chosen: &[Chosen], i: usize) -> Option<Instead> {
    let own = &chosen[i].candidate;
    let mut effect = own.effect.clone();
    effect.site.order = 1;
    let all = (0..effect.definition().parameters.len()).collect();
    let columns: Vec<Vec<Column>> =
        columns_of(&session.problem, &session.about, &[(effect.clone(), all)]);
    let layout = world.layout;
    let rows = layout.rows() as f64;
    let evenly = |mut column: Column| {
        for row in 0..layout.rows() {
            let part = (row as f64 + 0.5) / rows;
            layout.row(row).for_each(|number| column[number] *= part);
        }
        column
    };
    let columns: Vec<Column> = columns.into_iter().flatten().map(evenly).collect();
    let (base, fit) = world.fits(chosen);
    let effects: Vec<&[Column]> = chosen.iter().map(|c| c.columns.as_slice()).collect();
    let given = Given::of((&base, world.held), &fit, &effects);
    let others: Vec<bool> = (0..chosen.len()).map(|k| k != i).collect();
    let kept = given.kept(&others);
    let place = columns.len().min(3);
    let merit = |count: usize| {
        let columns = &columns[..count];
        let (group, cross) = group_of(world, &base, &given, columns);
        let cross: Vec<&[f64]> = cross.iter().map(Vec::as_slice).collect();
        let gain = given.gain(&group, &cross, &kept, &vec![None; count])?;
        // the place alone, or the whole
        let mut candidate = own.clone();
        candidate.peers = 2;
        Some(gain.gain - world.cost(&candidate, gain.gain, gain.count))
    };
    let each = [place, columns.len()].into_iter().filter_map(merit);
    let best = each.reduce(f64::max)?;
    let what = match effect.kind {
        Kind::FrameShift => "a measuring device or a base that moves slowly",
        _ => "a tool that moves slowly",
    };
    Some(Instead {
        of: i,
        what: what.to_owned(),
        behind: chosen[i].merit() - best,
    })
}

/// Products of columns, with one another and with the effects.
fn group_of(
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
