//! What columns gain given effects that come and go: products with the effects' columns are made
//! once, and every choice of effects that are kept takes a small triangle only.

use super::fit::{Fit, Gain, Projection, REDUNDANT, gain_of};
use super::table::{Column, dot};

/// Effects in the model, seen from a fit of everything else.
#[derive(Clone, Debug)]
pub struct Given {
    deviance: f64,
    evidence: f64,
    ridge: f64,
    /// Columns of the effects times the fit's M.
    turned: Vec<Column>,
    owners: Vec<usize>,
    squares: Vec<f64>,
    slopes: Vec<f64>,
    gram: Vec<Vec<f64>>,
}

/// Which effects are kept, and the triangle of their products.
#[derive(Clone, Debug)]
pub struct Kept {
    columns: Vec<usize>,
    triangle: Vec<Vec<f64>>,
    parts: Vec<f64>,
}

/// Products of a group of columns that is tried.
#[derive(Clone, Debug)]
pub struct Group {
    gram: Vec<Vec<f64>>,
    slopes: Vec<f64>,
    squares: Vec<f64>,
}

impl Group {
    /// Of columns seen from the fit of everything but effects.
    #[must_use]
    pub fn of(fit: &Fit, columns: &[&Projection]) -> Self {
        let each = |a: &&Projection| columns.iter().map(|b| fit.product(a, b)).collect();
        Self {
            gram: columns.iter().map(each).collect(),
            slopes: columns.iter().map(|p| p.slope).collect(),
            squares: columns.iter().map(|p| p.square).collect(),
        }
    }
}

impl Group {
    /// Products that are known: of the columns with one another and with the residual, all
    /// projected, and their squares before.
    #[must_use]
    pub const fn known(gram: Vec<Vec<f64>>, slopes: Vec<f64>, squares: Vec<f64>) -> Self {
        Self {
            gram,
            slopes,
            squares,
        }
    }
}

impl Given {
    /// Of a fit without effects, with the evidence of `full`, the fit with all of them.
    #[must_use]
    pub fn of(fit: &Fit, full: &Fit, effects: &[&[Column]]) -> Self {
        let mut owners = Vec::new();
        let mut columns = Vec::new();
        for (owner, own) in effects.iter().enumerate() {
            owners.extend(own.iter().map(|_| owner));
            columns.extend(own.iter().cloned());
        }
        let seen = fit.projections(&columns);
        let turned: Vec<Column> = seen.iter().map(|p| fit.turned(p)).collect();
        let products = |t: &Column| seen.iter().map(|p| dot(t, &p.column)).collect();
        Self {
            deviance: fit.deviance,
            evidence: full.evidence(),
            ridge: full.ridge(),
            gram: turned.iter().map(products).collect(),
            squares: seen.iter().map(|p| p.square).collect(),
            slopes: seen.iter().map(|p| p.slope).collect(),
            turned,
            owners,
        }
    }

    /// Columns of the effects times the fit's M.
    pub(crate) fn turned(&self) -> &[Column] {
        &self.turned
    }

    /// Products of a column with those of the effects.
    #[must_use]
    pub fn cross(&self, column: &Projection) -> Vec<f64> {
        let products = self.turned.iter().map(|t| dot(t, &column.column));
        products.collect()
    }

    /// Some of the effects: one flag for each.
    #[must_use]
    pub fn kept(&self, keep: &[bool]) -> Kept {
        let mut kept = Kept {
            columns: Vec::new(),
            triangle: Vec::new(),
            parts: Vec::new(),
        };
        for column in (0..self.owners.len()).filter(|c| keep[self.owners[*c]]) {
            let mut row = kept.solved(&self.gram[column]);
            let left = self.gram[column][column] - dot(&row, &row);
            if left <= REDUNDANT * self.squares[column] {
                continue;
            }
            let part = (self.slopes[column] - dot(&row, &kept.parts)) / left.sqrt();
            row.push(left.sqrt());
            kept.columns.push(column);
            kept.triangle.push(row);
            kept.parts.push(part);
        }
        kept
    }

    /// The deviance with the effects kept.
    #[must_use]
    pub fn deviance(&self, kept: &Kept) -> f64 {
        self.deviance - dot(&kept.parts, &kept.parts)
    }

    /// What a group of columns gains given the effects kept; `cross` are each column's products
    /// with all effects.
    #[must_use]
    pub fn gain(
        &self,
        group: &Group,
        cross: &[&[f64]],
        kept: &Kept,
        least: &[Option<f64>],
    ) -> Option<Gain> {
        let along: Vec<Vec<f64>> = cross.iter().map(|c| kept.solved(c)).collect();
        let mut gram = group.gram.clone();
        for (i, row) in gram.iter_mut().enumerate() {
            for (j, x) in row.iter_mut().enumerate() {
                *x -= dot(&along[i], &along[j]);
            }
        }
        let slopes = group.slopes.iter().zip(&along);
        let slopes: Vec<f64> = slopes.map(|(s, a)| s - dot(a, &kept.parts)).collect();
        gain_of(
            &gram,
            &slopes,
            &group.squares,
            least,
            self.evidence,
            self.ridge,
        )
    }
}

impl Kept {
    /// `L⁻¹ x` for products x of a column with all effects.
    fn solved(&self, products: &[f64]) -> Vec<f64> {
        let mut solved: Vec<f64> = Vec::with_capacity(self.columns.len());
        for (row, column) in self.triangle.iter().zip(&self.columns) {
            let known = dot(&row[..solved.len()], &solved);
            solved.push((products[*column] - known) / row[row.len() - 1]);
        }
        solved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::estimator::fit::Held;
    use crate::diagnose::estimator::table::{Layout, noise};

    fn held(columns: &[Column], share: f64, sought: bool) -> Vec<Held<'_>> {
        let each = columns.iter();
        each.map(|column| Held {
            column,
            share,
            sought,
        })
        .collect()
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-9 * (1.0 + a.abs())
    }

    #[test]
    fn products_that_are_kept_give_what_a_fit_made_anew_gives() {
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
            let all: Vec<Held> = [held(&base, share, false), held(&effects, 1.0, true)].concat();
            let full = Fit::of(&layout, &used, &residual, &all, 0.1);
            let plain = full.with_held(&residual, &held(&base, share, false));
            let groups: Vec<&[Column]> = vec![&effects[..2], &effects[2..3], &effects[3..]];
            let given = Given::of(&plain, &full, &groups);
            for keep in [
                [true, true, true],
                [false, true, true],
                [true, false, false],
            ] {
                let own: Vec<Column> = (groups.iter().zip(keep))
                    .filter(|(_, keep)| *keep)
                    .flat_map(|(g, _)| g.to_vec())
                    .collect();
                let some = [held(&base, share, false), held(&own, 1.0, true)].concat();
                let anew = full.with_held(&residual, &some);
                let kept = given.kept(&keep);
                assert!(near(anew.deviance, given.deviance(&kept)), "{share}");
                let seen = plain.projections(&tried);
                let group = Group::of(&plain, &seen.iter().collect::<Vec<_>>());
                let cross: Vec<Vec<f64>> = seen.iter().map(|p| given.cross(p)).collect();
                let cross: Vec<&[f64]> = cross.iter().map(Vec::as_slice).collect();
                let gain = given
                    .gain(&group, &cross, &kept, &[None; 3])
                    .expect("a gain");
                let seen = anew.projections(&tried);
                let expected = anew.gain(&seen.iter().collect::<Vec<_>>(), &[None; 3]);
                let expected = expected.expect("a gain");
                assert!(near(expected.gain, gain.gain), "{share}");
                for (a, b) in expected.values.iter().zip(&gain.values) {
                    assert!(near(*a, *b), "{share}");
                }
            }
        }
    }

    #[test]
    fn a_row_that_decides_a_parameter_alone_is_followed() {
        let layout = Layout::even(20, 3);
        let mut base = vec![noise(1, 60), vec![0.0; 60]];
        // one number alone says what the second parameter is
        base[1][7] = 2.0;
        let fit = Fit::of(
            &layout,
            &[true; 20],
            &noise(3, 60),
            &held(&base, 1.0, false),
            0.1,
        );
        let leverage = fit.leverage(&layout);
        // as many parts of rows are followed as there are parameters
        let sum: f64 = leverage.iter().sum();
        assert!((sum * 3.0 - 2.0).abs() < 1e-9, "{sum}");
        let most = (0..20).max_by(|a, b| leverage[*a].total_cmp(&leverage[*b]));
        assert_eq!(most, Some(2));
        assert!(leverage[2] > 1.0 / 3.0 - 1e-9);
    }
}
