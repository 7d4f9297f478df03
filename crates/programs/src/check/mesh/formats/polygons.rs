//! Polygons as triangles.
//!
//! # Source
//! Ear clipping: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82 (1975).

use crate::geometry::{Vector, cross, dot, norm, sub};

/// Looks at corners that are spent on one corner of a polygon at most; a polygon that asks for more is
/// cut from a corner on, as one that crosses itself.
const MOST_LOOKS: usize = 2_000;

/// The triangles of a polygon, by the numbers of its corners. A convex one is cut from its first
/// corner.
pub(super) fn cut(corners: &[Vector]) -> Vec<[usize; 3]> {
    let all: Vec<usize> = (0..corners.len()).collect();
    let Some(flat) = flat(corners).filter(|flat| !is_convex(flat)) else {
        return fan(&all);
    };
    let mut left = all;
    let mut triangles = Vec::with_capacity(left.len());
    let mut looks = MOST_LOOKS * left.len();
    let mut at = 0;
    let mut passed = 0;
    while left.len() > 3 {
        let count = left.len();
        let ear = [at + count - 1, at, at + 1].map(|k| left[k % count]);
        if is_ear(&flat, &left, ear, &mut looks) {
            triangles.push(ear);
            left.remove(at % count);
            (at, passed) = (at % count, 0);
            at %= left.len();
        } else {
            (at, passed) = ((at + 1) % count, passed + 1);
        }
        if passed > left.len() || looks == 0 {
            break;
        }
    }
    triangles.extend(fan(&left));
    triangles
}

/// Triangles about the first of some corners.
fn fan(corners: &[usize]) -> Vec<[usize; 3]> {
    let [first, others @ ..] = corners else {
        return Vec::new();
    };
    others
        .windows(2)
        .map(|two| [*first, two[0], two[1]])
        .collect()
}

/// The corners in the plane of the polygon, going round to the left; none of one without area.
fn flat(corners: &[Vector]) -> Option<Vec<[f64; 2]>> {
    let first = corners.first()?;
    let mut normal = [0.0; 3];
    for two in corners.windows(2) {
        let part = cross(sub(two[0], *first), sub(two[1], *first));
        normal = [0, 1, 2].map(|i| normal[i] + part[i]);
    }
    let long = norm(normal);
    let along = corners.iter().map(|corner| sub(*corner, *first));
    let along = along.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
    let across = cross(normal, along);
    let [x, y] = [along, across].map(|axis| axis.map(|value| value / norm(axis)));
    let is_usable = long > 0.0 && x.iter().chain(&y).all(|value| value.is_finite());
    let in_plane = corners.iter().map(|corner| {
        let from_first = sub(*corner, *first);
        [dot(from_first, x), dot(from_first, y)]
    });
    is_usable.then(|| in_plane.collect())
}

/// Twice the area of a triangle; above 0 where it goes round to the left.
fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn is_convex(flat: &[[f64; 2]]) -> bool {
    let count = flat.len();
    let turn = |k: usize| area([flat[k], flat[(k + 1) % count], flat[(k + 2) % count]]);
    let most = (0..count).map(|k| turn(k).abs()).fold(0.0, f64::max);
    // what is straight rounds to either side
    (0..count).all(|k| turn(k) >= -1e-9 * most)
}

/// Whether the corner in the middle of three can be cut off: no other one lies in their triangle.
fn is_ear(flat: &[[f64; 2]], left: &[usize], ear: [usize; 3], looks: &mut usize) -> bool {
    let triangle = ear.map(|k| flat[k]);
    if area(triangle) < 0.0 {
        return false;
    }
    let [a, b, c] = triangle;
    *looks = looks.saturating_sub(left.len());
    left.iter().map(|k| flat[*k]).all(|other| {
        // corners at one place, as where a hole is joined to the outline
        triangle.contains(&other)
            || area([a, b, other]) < 0.0
            || area([b, c, other]) < 0.0
            || area([c, a, other]) < 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A U that is open at the top, from one of its corners on, either way round.
    fn outline(first: usize, is_reversed: bool) -> Vec<Vector> {
        let mut corners = vec![
            [0.0, 0.0],
            [6.0, 0.0],
            [6.0, 6.0],
            [4.0, 6.0],
            [4.0, 2.0],
            [2.0, 2.0],
            [2.0, 6.0],
            [0.0, 6.0],
        ];
        corners.rotate_left(first);
        if is_reversed {
            corners.reverse();
        }
        corners.into_iter().map(|[y, z]| [3.0, y, z]).collect()
    }

    fn covered(corners: &[Vector]) -> (f64, bool) {
        let mut sum = 0.0;
        let mut is_notch_free = true;
        for triangle in cut(corners) {
            let [a, b, c] = triangle.map(|k| corners[k]);
            sum += 0.5 * norm(cross(sub(b, a), sub(c, a)));
            let flat = [a, b, c].map(|of| [of[1], of[2]]);
            let sides = [0, 1, 2].map(|k| area([flat[k], flat[(k + 1) % 3], [3.0, 4.0]]));
            let is_inside = sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0);
            is_notch_free &= !is_inside;
        }
        (sum, is_notch_free)
    }

    #[test]
    fn notches_of_polygons_stay_open_from_whichever_corner_they_are_listed() {
        for first in 0..8 {
            for is_reversed in [false, true] {
                let (area, is_notch_free) = covered(&outline(first, is_reversed));
                assert!((area - 28.0).abs() < 1e-12, "{first} {is_reversed}: {area}");
                assert!(is_notch_free, "{first} {is_reversed}");
            }
        }
        // a convex one as ever, with a corner on a side
        let square = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let square = square.map(|[x, y]| [x, y, 0.0]);
        assert_eq!(cut(&square), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
        // and what is none
        assert_eq!(cut(&square[..2]), [[0; 3]; 0]);
        assert_eq!(cut(&[[1.0; 3]; 4]), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(cut(&[[f64::NAN; 3]; 4]).len(), 2);
    }

    #[test]
    fn a_comb_of_many_teeth_keeps_its_area() {
        let mut corners: Vec<Vector> = vec![[0.0, -1.0, 0.0], [400.0, -1.0, 0.0]];
        for tooth in (0..200).rev() {
            let x = 2.0 * f64::from(tooth);
            corners.extend([[x + 2.0, 0.0, 0.0], [x + 1.0, 5.0, 0.0]]);
        }
        corners.push([0.0, 0.0, 0.0]);
        let triangles = cut(&corners);
        let area = |of: &[usize; 3]| {
            let [a, b, c] = of.map(|k| corners[k]);
            0.5 * norm(cross(sub(b, a), sub(c, a)))
        };
        let sum: f64 = triangles.iter().map(area).sum();
        assert!((sum - (400.0 + 200.0 * 5.0)).abs() < 1e-9, "{sum}");
    }
}
