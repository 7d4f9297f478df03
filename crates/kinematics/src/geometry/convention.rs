//! Orientations as the teach pendants of makers show them.

use super::units::DEG;
use super::{Pose, Rotation};

/// How a controller shows an orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// ABB: quaternion q1 to q4, the real part first.
    Abb,
    /// KUKA: A, B, C about z, the new y, the new x: `Rz(A) · Ry(B) · Rx(C)`.
    Kuka,
    /// FANUC: W, P, R about the fixed x, y, z: `Rz(R) · Ry(P) · Rx(W)`.
    Fanuc,
    /// Universal Robots: rotation vector, radians.
    Ur,
    /// Yaskawa: Rx, Ry, Rz about the fixed x, y, z: `Rz · Ry · Rx`.
    Yaskawa,
    /// Stäubli: rx, ry, rz about x, the new y, the new z: `Rx · Ry · Rz`.
    Staubli,
    /// Kawasaki: O, A, T about z, the new y, the new z: `Rz(O) · Ry(A) · Rz(T)`.
    Kawasaki,
}

/// Decimals of a coordinate in millimetres.
const DECIMALS_MM: usize = 3;
/// Decimals of an angle in degrees.
const DECIMALS_DEG: usize = 4;
/// Decimals of a quaternion's parts and of a rotation vector.
const DECIMALS: usize = 6;

impl Convention {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Abb,
        Self::Kuka,
        Self::Fanuc,
        Self::Ur,
        Self::Yaskawa,
        Self::Staubli,
        Self::Kawasaki,
    ];

    /// Its name on a command line.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Abb => "abb",
            Self::Kuka => "kuka",
            Self::Fanuc => "fanuc",
            Self::Ur => "ur",
            Self::Yaskawa => "yaskawa",
            Self::Staubli => "staubli",
            Self::Kawasaki => "kawasaki",
        }
    }

    /// The names of its numbers.
    #[must_use]
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Self::Abb => &["q1", "q2", "q3", "q4"],
            Self::Kuka => &["A", "B", "C"],
            Self::Fanuc => &["W", "P", "R"],
            Self::Ur => &["RX", "RY", "RZ"],
            Self::Yaskawa => &["Rx", "Ry", "Rz"],
            Self::Staubli => &["rx", "ry", "rz"],
            Self::Kawasaki => &["O", "A", "T"],
        }
    }

    /// The numbers: degrees; of ABB a quaternion, of UR radians.
    #[must_use]
    pub fn numbers(self, rotation: &Rotation) -> Vec<f64> {
        match self {
            Self::Abb => {
                let q = rotation.quaternion();
                let q = if q.0[0] < 0.0 { q.negated() } else { q };
                q.0.to_vec()
            }
            Self::Kuka => rotation.rzryrx(0.0).map(|a| a / DEG).to_vec(),
            Self::Fanuc | Self::Yaskawa => {
                let [r, p, w] = rotation.rzryrx(0.0).map(|a| a / DEG);
                vec![w, p, r]
            }
            Self::Ur => rotation.vector().to_vec(),
            Self::Staubli => rotation.rxryrz().map(|a| a / DEG).to_vec(),
            Self::Kawasaki => rotation.rzryrz().map(|a| a / DEG).to_vec(),
        }
    }

    /// A pose as the pendant shows it, with the names of its numbers.
    #[must_use]
    pub fn shown(self, pose: &Pose) -> String {
        let at = pose.translation.map(|x| x / super::units::MM);
        let [x, y, z] = at.map(|x| format!("{:.*}", DECIMALS_MM, unsigned_zero(x, DECIMALS_MM)));
        let (decimals, unit) = match self {
            Self::Abb => (DECIMALS, ""),
            Self::Ur => (DECIMALS, " rad"),
            _ => (DECIMALS_DEG, " deg"),
        };
        let numbers = self.numbers(&pose.rotation);
        let turned = self.names().iter().zip(numbers).map(|(name, value)| {
            let value = unsigned_zero(value, decimals);
            format!("{name} {value:.decimals$}")
        });
        let turned: Vec<String> = turned.collect();
        format!("X {x} Y {y} Z {z} mm, {}{unit}", turned.join(" "))
    }
}

/// A number that so many decimals show as zero has no sign.
fn unsigned_zero(value: f64, decimals: usize) -> f64 {
    let text = format!("{value:.decimals$}");
    if text.bytes().any(|b| matches!(b, b'1'..=b'9')) {
        value
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(convention: Convention, n: &[f64]) -> Rotation {
        let about = |axis: u8, degrees: f64| match axis {
            b'x' => Rotation::about_x(degrees * DEG),
            b'y' => Rotation::about_y(degrees * DEG),
            _ => Rotation::about_z(degrees * DEG),
        };
        let product = |axes: [(u8, f64); 3]| {
            let [a, b, c] = axes.map(|(axis, degrees)| about(axis, degrees));
            a * b * c
        };
        match convention {
            Convention::Abb => super::super::Quaternion([n[0], n[1], n[2], n[3]]).rotation(),
            Convention::Ur => Rotation::from_vector([n[0], n[1], n[2]]),
            Convention::Kuka => product([(b'z', n[0]), (b'y', n[1]), (b'x', n[2])]),
            Convention::Fanuc | Convention::Yaskawa => {
                product([(b'z', n[2]), (b'y', n[1]), (b'x', n[0])])
            }
            Convention::Staubli => product([(b'x', n[0]), (b'y', n[1]), (b'z', n[2])]),
            Convention::Kawasaki => product([(b'z', n[0]), (b'y', n[1]), (b'z', n[2])]),
        }
    }

    #[test]
    fn every_convention_says_the_same_rotation() {
        let mut rotations: Vec<Rotation> = (0..200)
            .map(|k| {
                let k = f64::from(k);
                Rotation::from_vector([
                    (k * 1.7).sin() * 3.0,
                    (k * 0.9).cos() * 2.0,
                    (k * 2.3).sin(),
                ])
            })
            .collect();
        // where angles are not determined alone
        for (y, z) in [(90.0, 20.0), (-90.0, -170.0), (0.0, 33.0), (180.0, 15.0)] {
            rotations.push(Rotation::about_z(z * DEG) * Rotation::about_y(y * DEG));
        }
        for convention in Convention::ALL {
            for rotation in &rotations {
                let again = turned(convention, &convention.numbers(rotation));
                let off = (again.transpose() * *rotation).angle();
                assert!(off < 1e-7, "{}: {off}", convention.id());
            }
        }
    }

    #[test]
    fn a_pose_reads_as_on_the_pendant() {
        let pose = Pose {
            rotation: Rotation::about_z(90.0 * DEG) * Rotation::about_x(180.0 * DEG),
            translation: [0.1, -0.2, 0.3],
        };
        for (convention, text) in [
            (
                Convention::Abb,
                "q1 0.000000 q2 0.707107 q3 0.707107 q4 0.000000",
            ),
            (Convention::Kuka, "A 90.0000 B 0.0000 C 180.0000 deg"),
            (Convention::Fanuc, "W 180.0000 P 0.0000 R 90.0000 deg"),
        ] {
            let shown = convention.shown(&pose);
            assert_eq!(shown, format!("X 100.000 Y -200.000 Z 300.000 mm, {text}"));
        }
    }
}
