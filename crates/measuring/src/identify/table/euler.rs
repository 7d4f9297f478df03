//! Three numbers as a rotation, by the name of their convention.

use crate::geometry::Rotation;
use crate::nearest;

/// How three angles turn the tool into the device's frame; rotations about moving axes, the first
/// one first.
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

/// A convention as users name it.
#[derive(Clone, Copy, Debug)]
struct Named {
    euler: Euler,
    name: &'static str,
    /// Names by makers.
    others: &'static [&'static str],
    /// The columns of its three numbers.
    columns: [&'static str; 3],
}

/// Rx, ry, rz.
const EACH: [&str; 3] = ["rx_deg", "ry_deg", "rz_deg"];

/// Every convention.
const CONVENTIONS: [Named; 4] = [
    Named {
        euler: Euler::Xyz,
        name: "xyz",
        others: &["staubli"],
        columns: EACH,
    },
    // A, B, C of KUKA are rz, ry, rx; W, P, R of FANUC are rx, ry, rz
    Named {
        euler: Euler::Zyx,
        name: "zyx",
        others: &["abc", "wpr", "rpy", "kuka", "fanuc", "yaskawa", "abb"],
        columns: EACH,
    },
    // O, A, T of Kawasaki
    Named {
        euler: Euler::Zyz,
        name: "zyz",
        others: &["oat", "kawasaki"],
        columns: ["rz_deg", "ry_deg", "rz2_deg"],
    },
    Named {
        euler: Euler::Vector,
        name: "rotation-vector",
        others: &["ur", "axis-angle"],
        columns: EACH,
    },
];

impl Euler {
    /// The convention of a name; what is wrong and may be meant where there is none.
    ///
    /// # Errors
    /// No such name.
    pub fn named(name: &str) -> Result<Self, (String, String)> {
        let plain = name.trim().to_lowercase();
        let mut all = CONVENTIONS.iter();
        let found = all.find(|own| own.name == plain || own.others.contains(&plain.as_str()));
        found.map(|own| own.euler).ok_or_else(|| {
            let all = CONVENTIONS.iter();
            let names = all.flat_map(|own| own.others.iter().chain([&own.name]).copied());
            (
                format!("`{name}` is no convention of angles"),
                nearest::hint(&plain, "conventions", names),
            )
        })
    }

    /// Every convention.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        CONVENTIONS.iter().map(|own| own.euler)
    }

    /// The columns that hold its numbers.
    #[must_use]
    pub fn columns(self) -> [&'static str; 3] {
        let own = CONVENTIONS.iter().find(|own| own.euler == self);
        own.map_or(EACH, |own| own.columns)
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
        // a rotation about z is the same whatever its name
        for Named {
            euler: own,
            columns,
            ..
        } in CONVENTIONS
        {
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
