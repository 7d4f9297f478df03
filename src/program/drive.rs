//! Programs that drive through configurations, as measuring asks for them.

use crate::geometry::units::DEG;

/// One move in joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Number of the configuration, from 1, before its first move.
    pub begins: Option<usize>,
    /// The controller's joints, radians.
    pub q: [f64; 6],
    /// The arm comes slowly and stays, to be measured.
    pub measured: bool,
}

impl Step {
    /// The joints in degrees, as text.
    pub(super) fn degrees(&self) -> [String; 6] {
        self.q.map(|angle| format!("{:.4}", angle / DEG))
    }
}
