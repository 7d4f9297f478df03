//! What columns would gain: Rao's score test given everything that is fitted, and effects in the
//! model that come and go.
//!
//! Products of the effects' columns are made once; every choice of effects that are kept takes a
//! small factor only (leave some out).
//!
//! # Source
//! C. R. Rao (1948) for the score test; R. Frisch, F. V. Waugh (1933) and M. C. Lovell (1963) for
//! what columns do beyond those that are fitted with them.

use super::factor::Factor;
use super::fit::{Fit, REDUNDANT};
use super::table::{Column, dot};
use rayon::prelude::*;

/// A candidate's parameter has to move all numbers together by so many standard deviations with its
/// typical size: less is never found.
const INVISIBLE: f64 = 0.1;
/// Within a group a column is redundant where less than this part of it is left given the others:
/// candidates have the digits of [`Stored`](super::table::Stored) columns.
const ALIKE: f64 = 1e-6;

/// Whether a column does anything, by its square and by what is left of that.
pub(crate) fn shows(left: f64, square: f64) -> bool {
    square.sqrt() > INVISIBLE && left > REDUNDANT * square
}

/// Products of a group of columns, the fit's part of them taken: with one another, with the
/// residual, and their squares before.
#[derive(Clone, Debug)]
pub struct Group {
    pub(crate) gram: Vec<Vec<f64>>,
    pub(crate) slopes: Vec<f64>,
    pub(crate) squares: Vec<f64>,
}

impl Group {
    /// Of products before, and what the fit takes of each column.
    #[must_use]
    pub(crate) fn of(mut gram: Vec<Vec<f64>>, slopes: Vec<f64>, taken: &[Vec<f64>]) -> Self {
        let squares = (0..gram.len()).map(|i| gram[i][i]).collect();
        for (row, a) in gram.iter_mut().zip(taken) {
            for (product, b) in row.iter_mut().zip(taken) {
                *product -= dot(a, b);
            }
        }
        Self {
            gram,
            slopes,
            squares,
        }
    }
}

/// What a group of columns gains.
#[derive(Clone, Debug, PartialEq)]
pub struct Gain {
    /// Fall of the deviance in units of the variance by which evidence counts: chi-squared where
    /// the columns do nothing.
    pub gain: f64,
    /// Values of the group's parameters in their typical sizes; zero where a column is redundant
    /// or at its bound.
    pub values: Vec<f64>,
    /// How many of them are determined.
    pub count: usize,
}

/// Effects in the model, seen from a fit of everything else.
#[derive(Clone, Debug)]
pub struct Given {
    deviance: f64,
    variance: f64,
    ridge: f64,
    /// Columns of the effects, the fit's part of them taken.
    partial: Vec<Column>,
    owners: Vec<usize>,
    squares: Vec<f64>,
    slopes: Vec<f64>,
    gram: Vec<Vec<f64>>,
}

/// Which effects are kept: the factor of their products.
#[derive(Clone, Debug)]
pub struct Kept {
    factor: Factor,
    slopes: Vec<f64>,
}

impl Given {
    /// Of a fit of these columns without effects, with the evidence of `full`, the fit with all of
    /// them.
    #[must_use]
    pub fn of((fit, columns): (&Fit, &[Column]), full: &Fit, effects: &[&[Column]]) -> Self {
        let own = effects.iter().enumerate();
        let owners = own.flat_map(|(owner, own)| own.iter().map(move |_| owner));
        let all: Vec<&Column> = effects.iter().flat_map(|own| own.iter()).collect();
        let partial = all.par_iter().map(|column| fit.partial(columns, column));
        let partial: Vec<Column> = partial.collect();
        let seen = all.iter().map(|column| fit.weighted(column));
        let seen: Vec<Column> = seen.collect();
        let products = |p: &Column| seen.iter().map(|c| dot(p, c)).collect();
        Self {
            deviance: fit.deviance,
            variance: full.evidence().powi(2),
            ridge: full.ridge(),
            gram: partial.iter().map(products).collect(),
            squares: seen.iter().map(|c| dot(c, c)).collect(),
            slopes: seen.iter().map(|c| dot(c, &fit.left)).collect(),
            partial,
            owners: owners.collect(),
        }
    }

    /// Columns of the effects, weighted, the fit's part of them taken: products with them are those
    /// of the Schur complement.
    pub(crate) fn partial(&self) -> &[Column] {
        &self.partial
    }

    /// Some of the effects: one flag for each.
    #[must_use]
    pub fn kept(&self, keep: &[bool]) -> Kept {
        let mut factor = Factor::default();
        for column in (0..self.owners.len()).filter(|c| keep[self.owners[*c]]) {
            let least = REDUNDANT * self.squares[column];
            factor.add(column, |other| self.gram[column][other], (least, 0.0));
        }
        let slopes = factor.forward(|column| self.slopes[column]);
        Kept { factor, slopes }
    }

    /// The deviance with the effects kept.
    #[must_use]
    pub fn deviance(&self, kept: &Kept) -> f64 {
        self.deviance - dot(&kept.slopes, &kept.slopes)
    }

    /// What a group of columns gains given the effects kept, none of its values below `least`;
    /// `cross` are each column's products with all effects.
    #[must_use]
    pub fn gain(
        &self,
        group: &Group,
        cross: &[&[f64]],
        kept: &Kept,
        least: &[Option<f64>],
    ) -> Option<Gain> {
        let taken = cross
            .iter()
            .map(|c| kept.factor.forward(|column| c[column]));
        let taken: Vec<Vec<f64>> = taken.collect();
        let own = |i: usize, j: usize| group.gram[i][j] - dot(&taken[i], &taken[j]);
        let slope = |i: usize| group.slopes[i] - dot(&taken[i], &kept.slopes);
        let is_seen = |i: &usize| shows(own(*i, *i), group.squares[*i]);
        let mut active: Vec<usize> = (0..cross.len()).filter(is_seen).collect();
        // a value beyond its bound stays at what the profile has
        while !active.is_empty() {
            let mut factor = Factor::default();
            for &i in &active {
                factor.add(i, |other| own(i, other), (ALIKE * own(i, i), self.ridge));
            }
            let along = factor.forward(slope);
            let solved = factor.backward(&along);
            let both = || factor.kept.iter().zip(&solved);
            let beyond = both().filter_map(|(i, value)| Some((*i, least[*i]? - value)));
            let beyond = beyond.filter(|(_, by)| *by > 0.0);
            if let Some((worst, _)) = beyond.max_by(|a, b| a.1.total_cmp(&b.1)) {
                active.retain(|i| *i != worst);
                continue;
            }
            let mut values = vec![0.0; cross.len()];
            for (i, value) in both() {
                values[*i] = *value;
            }
            return Some(Gain {
                gain: dot(&along, &along) / self.variance,
                values,
                count: factor.kept.len(),
            });
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::estimator::fit::Normal;
    use crate::diagnose::estimator::steps::Steps;
    use crate::diagnose::estimator::table::{Layout, noise};

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-9 * (1.0 + a.abs())
    }

    fn slices(columns: &[Column]) -> Vec<&[f64]> {
        columns.iter().map(Vec::as_slice).collect()
    }

    /// A group of columns and their products with the effects.
    fn seen(
        normal: &Normal,
        fit: &Fit,
        given: &Given,
        columns: &[Column],
    ) -> (Group, Vec<Vec<f64>>) {
        let own: Vec<Column> = columns.iter().map(|c| fit.weighted(c)).collect();
        let with = |others: &[Column], c: &Column| others.iter().map(|o| dot(o, c)).collect();
        let taken = columns
            .iter()
            .map(|c| normal.taken(fit, c, &normal.products(c)));
        let group = Group::of(
            own.iter().map(|c| with(&own, c)).collect(),
            own.iter().map(|c| dot(c, &fit.left)).collect(),
            &taken.collect::<Vec<_>>(),
        );
        let cross = own.iter().map(|c| with(given.partial(), c)).collect();
        (group, cross)
    }

    #[test]
    fn gains_given_effects_that_are_kept_are_falls_of_the_deviance() {
        let (rows, each) = (40, 3);
        let layout = Layout::even(rows, each);
        let column = |seed| noise(seed, rows * each);
        let (base, tried): (Vec<Column>, Vec<Column>) =
            ((1..6).map(column).collect(), (11..14).map(column).collect());
        // effects partly in the span of what is held
        let effects: Vec<Column> = (21..25)
            .zip(&base)
            .map(|(s, base)| {
                let both = column(s).into_iter().zip(base);
                both.map(|(x, b)| x + 2.0 * b).collect()
            })
            .collect();
        let residual: Column = (effects[1].iter().zip(column(31)))
            .map(|(e, x)| 3.0 * e + x)
            .collect();
        let used = vec![true; rows];
        for share in [1.0, 0.5, 0.1] {
            let shares = [share; 5];
            let normal = Normal::of((&layout, &used), &residual, (&base, &shares), 0.1);
            let (plain, full) = normal.fits(&slices(&effects));
            let groups: Vec<&[Column]> = vec![&effects[..2], &effects[2..3], &effects[3..]];
            let given = Given::of((&plain, &base), &full, &groups);
            // without the prior's width on what is tried
            let given = Given {
                ridge: 0.0,
                ..given
            };
            for keep in [
                [true, true, true],
                [false, true, true],
                [true, false, false],
            ] {
                let own: Vec<Column> = (groups.iter().zip(keep))
                    .filter(|(_, keep)| *keep)
                    .flat_map(|(g, _)| g.to_vec())
                    .collect();
                // rows are normal: every fit has the same weights
                let anew = |columns: &[Column]| normal.fit(&slices(columns));
                let (before, after) = (anew(&own), anew(&[&own[..], &tried[..]].concat()));
                let kept = given.kept(&keep);
                assert!(near(before.deviance, given.deviance(&kept)), "{share}");
                let (group, cross) = seen(&normal, &plain, &given, &tried);
                let gain = given.gain(&group, &slices(&cross), &kept, &[None; 3]);
                let gain = gain.expect("a gain");
                let fall = (before.deviance - after.deviance) / full.evidence().powi(2);
                assert!(near(fall, gain.gain), "{share}: {fall} {}", gain.gain);
                let values = after.values(5 + own.len() + 3);
                for (a, b) in values[5 + own.len()..].iter().zip(&gain.values) {
                    assert!(near(*a, *b), "{share}");
                }
                // a bound above the value leaves it out
                let bound = gain.values[0] + 1.0;
                let least = [Some(bound), None, None];
                let bounded = given.gain(&group, &slices(&cross), &kept, &least);
                let bounded = bounded.expect("two others");
                assert!(bounded.values[0] == 0.0 && bounded.count == 2);
                assert!(bounded.gain < gain.gain);
            }
        }
    }

    #[test]
    fn steps_are_columns_that_are_zero_before_their_row() {
        let layout = Layout::even(12, 3);
        let base: Vec<Column> = (1..4).map(|seed| noise(seed, 36)).collect();
        let columns: Vec<Column> = (5..7).map(|seed| noise(seed, 36)).collect();
        let effect = noise(9, 36);
        let residual = noise(10, 36);
        let mut used = [true; 12];
        used[4] = false;
        let shares = [1.0, 1.0, 0.3];
        let normal = Normal::of((&layout, &used), &residual, (&base, &shares), 0.1);
        let (plain, full) = normal.fits(&[&effect]);
        let effects = [effect];
        let given = Given::of((&plain, &base), &full, &[&effects]);
        let steps = Steps::of((&plain, &base), &layout, &columns, 2);
        let cross = steps.cross(&plain, &layout, &columns, &given);
        assert_eq!(steps.rows.first(), Some(&10));
        assert_eq!(steps.rows.last(), Some(&2));
        assert!(!steps.rows.contains(&4));
        for (k, row) in steps.rows.iter().enumerate() {
            let mut own = columns.clone();
            for column in &mut own {
                column[..3 * row].fill(0.0);
            }
            let (group, expected) = seen(&normal, &plain, &given, &own);
            let own = &steps.groups[k];
            assert!((group.slopes.iter().zip(&own.slopes)).all(|(a, b)| near(*a, *b)));
            assert!((group.squares.iter().zip(&own.squares)).all(|(a, b)| near(*a, *b)));
            let both = group.gram.concat().into_iter().zip(own.gram.concat());
            assert!(both.into_iter().all(|(a, b)| near(a, b)));
            let both = expected.concat().into_iter().zip(cross[k].concat());
            assert!(both.into_iter().all(|(a, b)| near(a, b)));
        }
    }
}
