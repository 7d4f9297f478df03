//! Where the nodes of a scene put their meshes.

use crate::geometry::Vector;

/// The upper three rows of a transform of points: columns of turning, scale and shear, then the
/// displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine(pub(super) [[f64; 4]; 3]);

impl Affine {
    /// All stays where it is.
    pub(super) const IDENTITY: Self = Self([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ]);
    /// x, y, z of a file whose y points up, in a world whose z does: both right-handed, x stays.
    pub(super) const Z_FROM_Y_UP: Self = Self([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
    ]);
    /// x, y, z of a file whose x points up and whose z points to the viewer, likewise.
    pub(super) const Z_FROM_X_UP: Self = Self([
        [0.0, -1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, 0.0],
        [1.0, 0.0, 0.0, 0.0],
    ]);

    /// A displacement.
    pub(super) fn translation(by: Vector) -> Self {
        let mut out = Self::IDENTITY;
        for i in 0..3 {
            out.0[i][3] = by[i];
        }
        out
    }

    /// A factor on each axis.
    pub(super) fn scale(by: Vector) -> Self {
        let mut out = Self::IDENTITY;
        for i in 0..3 {
            out.0[i][i] = by[i];
        }
        out
    }

    /// A rotation, rows first.
    pub(super) fn rotation(rows: [Vector; 3]) -> Self {
        Self(rows.map(|[x, y, z]| [x, y, z, 0.0]))
    }

    /// Where a point comes.
    pub(super) fn of(&self, p: Vector) -> Vector {
        self.0
            .map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3])
    }

    /// First `other`, then this.
    pub(super) fn after(&self, other: &Self) -> Self {
        let mut out = [[0.0; 4]; 3];
        for (row, mine) in out.iter_mut().zip(&self.0) {
            for (c, number) in row.iter_mut().enumerate() {
                *number = (0..3).map(|k| mine[k] * other.0[k][c]).sum();
            }
            row[3] += mine[3];
        }
        Self(out)
    }
}
