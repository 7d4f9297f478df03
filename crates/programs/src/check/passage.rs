//! Moves of joints that no program describes: whether the arm is clear everywhere on its path.

use super::collision::least_room;
use super::scene::Scene;
use super::walk::{Arms, Which};
use crate::geometry::units::MM;
use crate::inverse::Unsupported;
use crate::model::Conditions;
use crate::motion::arms::Equipped;
use crate::motion::course::Course;
use crate::motion::leg::Leg;
use crate::profile::{Mounted, Profile};

/// Bodies farther apart than this beyond what is required are only known to be, metres.
const HORIZON_M: f64 = 1.0 * MM;

/// The real arm with one tool, on moves of its joints at constant rates.
pub struct Passage {
    equipped: Equipped,
    arms: Arms,
}

impl Passage {
    /// For one tool.
    ///
    /// # Errors
    /// An arm without a closed-form inverse.
    pub fn new(profile: &Profile, tool: &Mounted) -> Result<Self, Unsupported> {
        let equipped = Equipped::of(profile, tool)?;
        let arms = Arms::of(&equipped, profile, tool);
        Ok(Self { equipped, arms })
    }

    /// Whether nothing comes nearer than required and `room_m` beyond (at most a millimetre),
    /// guaranteed between these joints (radians) and not only at samples.
    #[must_use]
    pub fn is_clear(&self, scene: &Scene, from: &[f64; 6], to: &[f64; 6], room_m: f64) -> bool {
        let leg = Leg {
            equipped: &self.equipped,
            course: Course::Joint {
                from: *from,
                to: *to,
            },
            start: *from,
            branch: self.equipped.arm.posture(from).0,
            conditions: Conditions::default(),
            ride: None,
            crossing: None,
        };
        let mover = self.arms.mover(Which::Real);
        let found = least_room(scene, &mover, &leg, &leg.pieces(), HORIZON_M);
        found.certified && found.room_m() > room_m.min(0.5 * HORIZON_M)
    }
}
