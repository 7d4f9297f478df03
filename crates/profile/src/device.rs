//! Where the measuring device stood in the controller's world.

use super::file::{DeviceFile, Number};
use super::{Fault, Profile, ProfileError, pose};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::model::UPSIDE_DOWN;
use crate::model::effects::Kind;
use serde_json::json;

/// The frame of the device that a calibration was measured with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DevicePlace {
    /// `world_from_device`: maps what the device gives into the controller's world.
    pub world_from_device: Pose,
    /// Standard deviations of `x, y, z, rx, ry, rz` of that pose, metres and radians, where they
    /// are known.
    pub sigma: Option<[f64; 6]>,
}

/// What an entry of `sigma` is in: lengths and angles.
const UNITS: [f64; 6] = [MM, MM, MM, DEG, DEG, DEG];
/// Keys of `sigma`.
const KEYS: [&str; 6] = ["x_mm", "y_mm", "z_mm", "rx_deg", "ry_deg", "rz_deg"];

impl DevicePlace {
    pub(super) fn from_file(file: &DeviceFile) -> Result<Self, ProfileError> {
        let world_from_device = pose(&file.pose)?;
        super::reading::check_angles(&file.pose)?;
        let Some(sigma) = &file.sigma else {
            return Ok(Self {
                world_from_device,
                sigma: None,
            });
        };
        let (at, s) = (sigma.defined, sigma.value);
        let numbers = [s.x_mm, s.y_mm, s.z_mm, s.rx_deg, s.ry_deg, s.rz_deg];
        for (key, Number(found)) in KEYS.into_iter().zip(numbers) {
            if found < 0.0 {
                let (low, high) = (0.0, f64::INFINITY);
                return Err(Fault::OutOfRange {
                    key,
                    found,
                    low,
                    high,
                }
                .at(at));
            }
        }
        Ok(Self {
            world_from_device,
            sigma: Some(std::array::from_fn(|i| numbers[i].0 * UNITS[i])),
        })
    }

    /// The lines of a profile file.
    pub(super) fn lines(&self) -> String {
        let pose = super::write::flow_pose(&self.world_from_device);
        let mut out = format!("  world_from_device:\n    pose: {pose}\n");
        if let Some(sigma) = self.sigma {
            let number = |i: usize| format!("{}: {}", KEYS[i], json!(sigma[i] / UNITS[i]));
            let numbers: Vec<String> = (0..6).map(number).collect();
            out += &format!("    sigma: {{{}}}\n", numbers.join(", "));
        }
        out
    }

    /// x, y, z in mm.
    #[must_use]
    pub fn xyz_mm(&self) -> [f64; 3] {
        self.world_from_device.translation.map(mm_from_m)
    }
}

impl Profile {
    /// `world_from_device`; the device's frame is the world where the profile does not say.
    #[must_use]
    pub fn world_from_device(&self) -> Pose {
        self.device
            .map_or_else(Pose::identity, |device| device.world_from_device)
    }

    /// Whether the chain begins upside down: axis 2 stands against axis 1 from the base.
    fn begins_upside_down(&self) -> bool {
        self.links[0].d_m < 0.0
    }

    /// Where the robot stands, as machine data have it: `kinematics.base`, or that turned over where
    /// the chain begins upside down.
    #[must_use]
    pub fn world_from_foot(&self) -> Pose {
        self.base_and_foot(self.world_from_base)
    }

    /// `kinematics.base` of a robot that stands there, and the other way round.
    #[must_use]
    pub fn base_and_foot(&self, pose: Pose) -> Pose {
        if self.begins_upside_down() {
            pose * UPSIDE_DOWN
        } else {
            pose
        }
    }

    /// Where the real base stands: `kinematics.base` with the effects `base_frame`.
    #[must_use]
    pub fn world_from_real_base(&self) -> Pose {
        let own = self.effects.iter().filter(|e| e.kind == Kind::BaseFrame);
        own.fold(self.world_from_base, |base, effect| {
            base * Pose::from_xyz_rxryrz(effect.parameters)
        })
    }
}
