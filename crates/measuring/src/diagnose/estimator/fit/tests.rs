//! The fit against dense matrices.

use super::*;
use crate::diagnose::estimator::table::noise;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * (1.0 + a.abs())
}

fn matrix(columns: &[Column]) -> DMatrix<f64> {
    DMatrix::from_fn(columns[0].len(), columns.len(), |i, j| columns[j][i])
}

/// `P` of columns of which the first so many are free and the others have Zellner's g-prior.
fn prior(x: &DMatrix<f64>, free: usize, g: f64) -> DMatrix<f64> {
    let (n, p) = x.shape();
    let (a, b) = (x.columns(0, free), x.columns(free, p - free));
    let part = (a.transpose() * a)
        .try_inverse()
        .expect("independent columns");
    let left = (DMatrix::identity(n, n) - a * part * a.transpose()) * b;
    let mut precision = DMatrix::zeros(p, p);
    let own = left.transpose() * &left / g;
    precision
        .view_mut((free, free), (p - free, p - free))
        .copy_from(&own);
    precision
}

#[test]
fn values_are_those_of_generalised_least_squares() {
    let layout = Layout::even(30, 3);
    let mut used = vec![true; 30];
    used[7] = false;
    let (free, g) = (3, 0.6);
    let held: Vec<Column> = (1..8).map(|seed| noise(seed, 90)).collect();
    let sought: Vec<Column> = (8..10).map(|seed| noise(seed, 90)).collect();
    let mut shares = vec![1.0; 3];
    shares.resize(7, g / (1.0 + g));
    let residual: Column = noise(20, 90).iter().map(|x| 3.0 * x).collect();
    let normal = Normal::of((&layout, &used), &residual, (&held, &shares), 0.1);
    let slices: Vec<&[f64]> = sought.iter().map(Vec::as_slice).collect();
    for lighter in [vec![], vec![3], vec![0, 12, 29]] {
        let mut roots = normal.plain.clone();
        for (k, row) in lighter.iter().enumerate() {
            roots[layout.row(*row)].fill(0.9 / (1.0 + 30.0 * k as f64));
        }
        let fit = normal.with(&slices).at(roots.clone());
        // M = I − X (XᵀX + P)⁻¹ Xᵀ of weighted columns, then least squares of those sought
        let of = |columns: &[Column]| -> Vec<Column> {
            columns.iter().map(|c| weighted(c, &roots)).collect()
        };
        let x = matrix(&of(&held));
        let e = matrix(&of(&sought));
        let r = DVector::from_vec(weighted(&residual, &roots));
        let n = x.transpose() * &x + prior(&x, free, g);
        let inverse = n.try_inverse().expect("a prior and enough rows");
        let m = DMatrix::identity(90, 90) - &x * &inverse * x.transpose();
        let of_sought = (e.transpose() * &m * &e)
            .try_inverse()
            .expect("two columns");
        let v = &of_sought * e.transpose() * &m * &r;
        let rest = &r - &e * &v;
        let beta = &inverse * x.transpose() * &rest;
        assert!(near((rest.transpose() * &m * &rest)[0], fit.deviance));
        let values = fit.values(9);
        for (value, expected) in values.iter().zip(beta.iter().chain(v.iter())) {
            assert!(near(*expected, *value), "{expected} {value}");
        }
        let left = &rest - &x * &beta;
        assert!(left.iter().zip(&fit.left).all(|(a, b)| near(*a, *b)));
        assert!(near(of_sought[(1, 1)].sqrt(), fit.deviation(8)));
        // the pull at what is held: of the residual along it, the free columns' part taken
        let pull = x.transpose() * &rest;
        let own = x.transpose() * &x;
        let gain = |p: usize| {
            let part = own.view((0, 0), (p, p)).into_owned().try_inverse();
            let pull = pull.rows(0, p);
            (pull.transpose() * part.expect("independent columns") * pull)[0]
        };
        assert!(near(gain(7) - gain(3), fit.strain.0) && fit.strain.1 == 4);
        // those held stay, those free fit the rest
        let as_calibrated = fit.values_as_calibrated(9);
        let a = x.columns(0, free);
        let solved = (a.transpose() * a).try_inverse().expect("three columns");
        let solved = solved * a.transpose() * &rest;
        let both = solved
            .iter()
            .copied()
            .chain([0.0; 4])
            .chain(v.iter().copied());
        assert!(both.zip(as_calibrated).all(|(a, b)| near(a, b)));
        // products with what is left of a column are those of the Schur complement
        let base = normal.at(roots.clone());
        let column = noise(31, 90);
        let c = DVector::from_vec(weighted(&column, &roots));
        let partial = base.partial(&held, &column);
        let taken = normal.taken(&base, &column, &normal.products(&column));
        let expected = (c.transpose() * &m * &c)[0];
        assert!(near(expected, dot(&partial, c.as_slice())));
        assert!(near(expected, c.norm_squared() - dot(&taken, &taken)));
    }
}

#[test]
fn a_column_that_a_weight_takes_away_stays_out() {
    let layout = Layout::even(10, 3);
    let mut columns = vec![noise(1, 30), vec![0.0; 30], noise(2, 30)];
    // a parameter of one row alone
    columns[1][12..15].fill(1.0);
    let mut residual = noise(5, 30);
    residual[12..15].fill(1e9);
    let (used, shares) = ([true; 10], [1.0; 3]);
    let normal = Normal::of((&layout, &used), &residual, (&columns, &shares), 0.1);
    let mut roots = vec![1.0; 30];
    roots[12..15].fill(1e-7);
    let fit = normal.at(roots.clone());
    let values = fit.values(3);
    assert!(values.iter().all(|v| v.is_finite()), "{values:?}");
    assert!(values[1] == 0.0 && fit.left.iter().all(|x| x.is_finite()));
    columns.remove(1);
    let others = Normal::of((&layout, &used), &residual, (&columns, &shares[..2]), 0.1);
    let others = others.at(roots).values(2);
    assert!((values[0] - others[0]).abs() < 1e-3 && (values[2] - others[1]).abs() < 1e-3);
}

#[test]
fn a_gross_error_counts_as_a_row_at_the_limit() {
    let layout = Layout::even(60, 3);
    let columns: Vec<Column> = (1..5).map(|seed| noise(seed, 180)).collect();
    let (clean, sought) = (noise(9, 180), noise(40, 180));
    let value = |gross: f64| {
        let both = clean.iter().zip(&sought);
        let mut residual: Column = both.map(|(x, s)| x + 2.0 * s).collect();
        residual[30] += gross;
        let (used, shares) = ([true; 60], [1.0, 1.0, 0.4, 0.4]);
        let normal = Normal::of((&layout, &used), &residual, (&columns, &shares), 1e-6);
        let (base, full) = normal.fits(&[&sought]);
        assert!(near(base.scale, full.scale) && base.roots == full.roots);
        (full.values(5)[4], full.scale)
    };
    let (plain, scale) = value(0.0);
    assert!((plain - 2.0).abs() < 0.2, "{plain}");
    for gross in [1e2, 1e6] {
        let (moved, other) = value(gross);
        assert!((moved - plain).abs() < 0.1, "{gross}: {moved} {plain}");
        assert!((other / scale - 1.0).abs() < 0.2, "{gross}: {other}");
    }
}

#[test]
fn a_row_that_decides_a_parameter_alone_is_followed() {
    let layout = Layout::even(20, 3);
    let mut base = vec![noise(1, 60), vec![0.0; 60]];
    // one number alone says what the second parameter is
    base[1][7] = 2.0;
    let residual = noise(3, 60);
    let normal = Normal::of((&layout, &[true; 20]), &residual, (&base, &[1.0; 2]), 0.1);
    let leverage = normal.fit(&[]).leverage(&layout, &base);
    // as many parts of rows are followed as there are parameters
    let sum: f64 = leverage.iter().sum();
    assert!((sum * 3.0 - 2.0).abs() < 1e-9, "{sum}");
    let most = (0..20).max_by(|a, b| leverage[*a].total_cmp(&leverage[*b]));
    assert_eq!(most, Some(2));
    assert!(leverage[2] > 1.0 / 3.0 - 1e-9);
}
