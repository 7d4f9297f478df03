//! Three numbers as a rotation, by the name of their convention.

use crate::geometry::Rotation;
use crate::nearest;

/// How three angles turn the tool into the device's frame; rotations about moving axes, the first one first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Euler {
    /// `Rx(rx) · Ry(ry) · Rz(rz)`.
    Xyz,
    /// `Rz(rz) · Ry(ry) · Rx(rx)`.
    Zyx,
    /// `Rz(rz) · Ry(ry) · Rz(rz2)`.
    Zyz,
    /// Axis times angle.
    Vector,
}

/// Each convention with its name, names by makers, columns, and what it is.
pub const CONVENTIONS: [(Euler, &str, &[&str], [&str; 3], &str); 4] = [
    (
        Euler::Xyz,
        "xyz",
        &["staubli"],
        ["rx_deg", "ry_deg", "rz_deg"],
        "Rx(rx)·Ry(ry)·Rz(rz), as poses of profiles",
    ),
    (
        Euler::Zyx,
        "zyx",
        &["abc", "wpr", "rpy", "kuka", "fanuc", "yaskawa", "abb"],
        ["rx_deg", "ry_deg", "rz_deg"],
        "Rz(rz)·Ry(ry)·Rx(rx): A, B, C of KUKA are rz, ry, rx; W, P, R of FANUC are rx, ry, rz",
    ),
    (
        Euler::Zyz,
        "zyz",
        &["oat", "kawasaki"],
        ["rz_deg", "ry_deg", "rz2_deg"],
        "Rz(rz)·Ry(ry)·Rz(rz2): O, A, T of Kawasaki",
    ),
    (
        Euler::Vector,
        "rotation-vector",
        &["ur", "axis-angle"],
        ["rx_deg", "ry_deg", "rz_deg"],
        "axis times angle: rx, ry, rz of UR",
    ),
];

impl Euler {
    /// The convention of a name; what is wrong and may be meant where there is none.
    ///
    /// # Errors
    /// No such name.
    pub fn named(name: &str) -> Result<Self, (String, String)> {
        let plain = name.trim().to_lowercase();
        let all = CONVENTIONS.iter();
        let found = all
            .clone()
            .find(|row| row.1 == plain || row.2.contains(&plain.as_str()));
        found.map(|row| row.0).ok_or_else(|| {
            let names = all.flat_map(|row| std::iter::once(row.1).chain(row.2.iter().copied()));
            (
                format!("`{name}` is no convention of angles"),
                nearest::hint(&plain, "conventions", names),
            )
        })
    }

    /// The columns that hold its numbers.
    #[must_use]
    pub fn columns(self) -> [&'static str; 3] {
        let own = CONVENTIONS.iter().find(|row| row.0 == self);
        own.expect("every convention has a row").3
    }

    /// The rotation of numbers in the order of [`Euler::columns`], radians.
    #[must_use]
    pub fn rotation(self, [a, b, c]: [f64; 3]) -> Rotation {
        let (x, y, z) = (Rotation::about_x, Rotation::about_y, Rotation::about_z);
        match self {
            Self::Xyz => x(a) * y(b) * z(c),
            Self::Zyx => Rotation::from_rzryrx([c, b, a]),
            Self::Zyz => z(a) * y(b) * z(c),
            Self::Vector => Rotation::from_vector([a, b, c]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::units::DEG;

    #[test]
    fn conventions_turn_as_their_makers_say() {
        let quarter = 90.0 * DEG;
        // KUKA: A about z, then B about the new y, then C about the newest x
        let turned = Euler::Zyx.rotation([quarter, 0.0, quarter]);
        let expected = Rotation::about_z(quarter) * Rotation::about_x(quarter);
        assert!((turned.transpose() * expected).angle() < 1e-12);
        let turned = Euler::Xyz.rotation([quarter, 0.0, quarter]);
        let expected = Rotation::about_x(quarter) * Rotation::about_z(quarter);
        assert!((turned.transpose() * expected).angle() < 1e-12);
        // a turn about z is the same whatever its name
        for (own, _, _, columns, _) in CONVENTIONS {
            let numbers = columns.map(|c| if c == "rz_deg" { quarter } else { 0.0 });
            let angle = (own.rotation(numbers).transpose() * Rotation::about_z(quarter)).angle();
            assert!(angle < 1e-12, "{own:?}");
        }
        assert_eq!(Euler::named("KUKA"), Ok(Euler::Zyx));
        assert!(
            Euler::named("kukka")
                .expect_err("a typing error")
                .1
                .contains("`kuka`")
        );
    }
}
