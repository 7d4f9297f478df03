//! The closed forms for `A X = X B`.

use super::Motion;
use crate::geometry::{Pose, Quaternion, Rotation, Vector, dot, scale, sub};
use crate::register::linear::svd;
use crate::register::uncertainty::crossing;
use nalgebra::{DMatrix, Matrix3, Matrix4, Vector3};

/// The translation for a rotation: least squares of `(R_A − 1) t = R_X t_B − t_A`.
fn with_translation(motions: &[Motion], rotation: Rotation) -> Option<Pose> {
    let mut n = Matrix3::zeros();
    let mut r = Vector3::zeros();
    for motion in motions {
        let rows = Matrix3::from_fn(|i, j| motion.a.rotation.0[i][j]) - Matrix3::identity();
        let right = sub(rotation * motion.b.translation, motion.a.translation);
        n += rows.transpose() * rows;
        r += rows.transpose() * Vector3::from(right);
    }
    let t = n.cholesky()?.solve(&r);
    Some(Pose {
        rotation,
        translation: [t[0], t[1], t[2]],
    })
}

/// Axis times twice the sine of half the angle.
fn rodrigues(rotation: &Rotation) -> Vector {
    let [_, x, y, z] = rotation.quaternion().0;
    [2.0 * x, 2.0 * y, 2.0 * z]
}

/// Rotations outside these say little about the axis, or too much where noise turns half a turn
/// over; radians.
const TSAI_RANGE_RAD: std::ops::RangeInclusive<f64> = 0.261_8..=2.879_8;

/// Tsai and Lenz: `(P_A + P_B) × P' = P_B − P_A` over pairs that turn neither little nor about half
/// a turn, then the translation over all. Where too few pairs are left, all are taken.
pub(super) fn tsai(motions: &[Motion]) -> Option<Pose> {
    let good = |m: &&Motion| {
        [m.a, m.b]
            .iter()
            .all(|p| TSAI_RANGE_RAD.contains(&p.rotation.angle()))
    };
    let chosen: Vec<&Motion> = motions.iter().filter(good).collect();
    let p = tsai_vector(&chosen).or_else(|| tsai_vector(&motions.iter().collect::<Vec<_>>()))?;
    // P' = tan(θ/2) axis
    let cosine = 1.0 / (1.0 + dot(p, p)).sqrt();
    let [x, y, z] = scale(cosine, p);
    with_translation(motions, Quaternion([cosine, x, y, z]).rotation())
}

fn tsai_vector(motions: &[&Motion]) -> Option<Vector> {
    let mut n = Matrix3::zeros();
    let mut r = Vector3::zeros();
    for motion in motions {
        let (a, b) = (rodrigues(&motion.a.rotation), rodrigues(&motion.b.rotation));
        let rows = crossing(crate::geometry::add(a, b));
        n += rows.transpose() * rows;
        r += rows.transpose() * Vector3::from(sub(b, a));
    }
    let p = n.cholesky()?.solve(&r);
    Some([p[0], p[1], p[2]])
}

/// Park and Martin: the rotation nearest to `Σ α βᵀ` of the rotation vectors.
pub(super) fn park(motions: &[Motion]) -> Option<Pose> {
    let mut sum = Matrix3::zeros();
    for motion in motions {
        let (a, b) = (motion.a.rotation.vector(), motion.b.rotation.vector());
        sum += Vector3::from(a) * Vector3::from(b).transpose();
    }
    with_translation(motions, crate::register::axes::nearest_rotation(&sum))
}

/// Horaud and Dornaika: the quaternion with the least `|q_A x − x q_B|²`.
pub(super) fn horaud(motions: &[Motion]) -> Option<Pose> {
    let mut sum = Matrix4::zeros();
    for motion in motions {
        let rows = left(motion.a.rotation.quaternion().0) - right(motion.b.rotation.quaternion().0);
        sum += rows.transpose() * rows;
    }
    let eigen = sum.symmetric_eigen();
    let least = (0..4).min_by(|i, j| eigen.eigenvalues[*i].total_cmp(&eigen.eigenvalues[*j]))?;
    let q = eigen.eigenvectors.column(least);
    let quaternion = Quaternion([q[0], q[1], q[2], q[3]]).normalized();
    with_translation(motions, quaternion.rotation())
}

/// `left(p) q = p q`.
fn left([w, x, y, z]: [f64; 4]) -> Matrix4<f64> {
    Matrix4::new(w, -x, -y, -z, x, w, -z, y, y, z, w, -x, z, -y, x, w)
}

/// `right(p) q = q p`.
fn right([w, x, y, z]: [f64; 4]) -> Matrix4<f64> {
    Matrix4::new(w, -x, -y, -z, x, w, z, -y, y, -z, w, x, z, y, -x, w)
}

fn product(p: [f64; 4], q: [f64; 4]) -> [f64; 4] {
    let v = left(p) * nalgebra::Vector4::from(q);
    [v[0], v[1], v[2], v[3]]
}

/// Dual part of a pose's dual quaternion: `½ t q`.
fn dual(pose: &Pose, real: [f64; 4]) -> [f64; 4] {
    let [x, y, z] = scale(0.5, pose.translation);
    product([0.0, x, y, z], real)
}

/// Daniilidis: the two directions that `T (q, q') = 0` leaves open, combined so that the dual
/// quaternion is one of a motion.
pub(super) fn daniilidis(motions: &[Motion]) -> Option<Pose> {
    let mut t = DMatrix::zeros(6 * motions.len(), 8);
    for (index, motion) in motions.iter().enumerate() {
        let (qa, qb) = (
            motion.a.rotation.quaternion().0,
            motion.b.rotation.quaternion().0,
        );
        let (da, db) = (dual(&motion.a, qa), dual(&motion.b, qb));
        let vector = |q: [f64; 4]| [q[1], q[2], q[3]];
        let (a, b) = (vector(qa), vector(qb));
        let (a_dual, b_dual) = (vector(da), vector(db));
        let row = 6 * index;
        let real = crossing(crate::geometry::add(a, b));
        let shift = crossing(crate::geometry::add(a_dual, b_dual));
        for i in 0..3 {
            t[(row + i, 0)] = a[i] - b[i];
            t[(row + 3 + i, 0)] = a_dual[i] - b_dual[i];
            t[(row + 3 + i, 4)] = a[i] - b[i];
            for j in 0..3 {
                t[(row + i, 1 + j)] = real[(i, j)];
                t[(row + 3 + i, 1 + j)] = shift[(i, j)];
                t[(row + 3 + i, 5 + j)] = real[(i, j)];
            }
        }
    }
    let svd = svd(&t);
    let column = |k: usize| -> ([f64; 4], [f64; 4]) {
        let c = svd.right.column(k);
        ([c[0], c[1], c[2], c[3]], [c[4], c[5], c[6], c[7]])
    };
    let ((u1, v1), (u2, v2)) = (column(6), column(7));
    let dot4 = |p: [f64; 4], q: [f64; 4]| -> f64 { (0..4).map(|i| p[i] * q[i]).sum() };
    // λ1 (u1, v1) + λ2 (u2, v2) with real · dual = 0 and |real| = 1; s = λ1 / λ2
    let (a, b, c) = (dot4(u1, v1), dot4(u1, v2) + dot4(u2, v1), dot4(u2, v2));
    let roots = if a.abs() > 1e-14 {
        let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
        // the larger root without cancellation
        let q = -0.5 * (b + b.signum() * root);
        [q / a, if q == 0.0 { 0.0 } else { c / q }]
    } else {
        [-c / b, -c / b]
    };
    let value = |s: f64| s * s * dot4(u1, u1) + 2.0 * s * dot4(u1, u2) + dot4(u2, u2);
    let s = if value(roots[0]) > value(roots[1]) {
        roots[0]
    } else {
        roots[1]
    };
    let size = value(s);
    if !(size > 0.0 && s.is_finite()) {
        return None;
    }
    let second = 1.0 / size.sqrt();
    let first = s * second;
    let real: [f64; 4] = std::array::from_fn(|i| first * u1[i] + second * u2[i]);
    let moment: [f64; 4] = std::array::from_fn(|i| first * v1[i] + second * v2[i]);
    let quaternion = Quaternion(real).normalized();
    let [w, x, y, z] = quaternion.0;
    let translation = product(moment.map(|m| 2.0 * m), [w, -x, -y, -z]);
    Some(Pose::from_parts(
        [translation[1], translation[2], translation[3]],
        quaternion,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quaternion_products_are_those_of_rotations() {
        let p = Quaternion([0.5, -0.1, 0.7, 0.2]).normalized();
        let q = Quaternion([0.3, 0.4, -0.2, 0.9]).normalized();
        let both = Quaternion(product(p.0, q.0)).rotation();
        let gap = (both.transpose() * (p.rotation() * q.rotation())).angle();
        assert!(gap < 1e-15);
        let right_first = right(q.0) * nalgebra::Vector4::from(p.0);
        assert!((right_first - nalgebra::Vector4::from(product(p.0, q.0))).norm() < 1e-15);
    }
}
