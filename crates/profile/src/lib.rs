//! A robot's profile: read strictly, written, and made into models.
//!
//! It is a crate of its own because reading files into structures is much code that runs once:
//! it is compiled for size, next to the kernels of `poseshift_kinematics` on which it stands.

#![forbid(unsafe_code)]

// the macro of shapes names its types the same here and elsewhere
extern crate self as poseshift_profile;

mod catalogue;
mod device;
mod edit;
mod error;
pub(crate) mod external;
pub mod file;
mod makers;
mod quality;
mod reading;
mod rewrite;
pub mod shape;
mod shipped;
mod text;
pub mod universal_robots;
mod write;

pub use catalogue::{CatalogueArm, catalogue};
pub use catalogue::{coupled, flange_remark};
pub use device::DevicePlace;
pub use edit::{EditError, with_value};
pub use error::{Fault, ProfileError};
pub use external::is_of_profile;
pub use file::{ControllerModel, FORMAT, ProfileFile, Tables, Theirs};
pub use makers::{MAKERS, Maker};
pub use reading::{check_angles, pose};
pub use rewrite::{with_controller, with_external};
pub use shipped::SHIPPED;
pub use text::flow_pose;
pub use text::flow_tool;
pub use text::{Comments, made};
pub use write::{WriteError, rewritten};

pub use file::{Number, PoseFile};
use geometry::{Pose, Vector};
use model::effects::{Effect, Kind, same_tool};
use model::external::{Carried, ExternalAxes, Stand};
use model::shape::LinkShape;
use model::{Body, Conditions, Geometry, Link, Mechanism, Model};
use poseshift_kinematics::{geometry, model, nearest, printable};
use std::collections::BTreeMap;

/// A tool that is nearer to the flange in each coordinate is in another unit, or none.
const TINY_M: f64 = 1e-3;
/// Lengths below this are zero.
const NO_LENGTH_M: f64 = 1e-9;
/// One robot: its nominal arm, tools, and what was identified of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Maker.
    pub manufacturer: String,
    /// Type.
    pub model: String,
    /// Serial number.
    pub serial: Option<String>,
    /// The largest mass that the flange may carry, where the file gives it.
    pub payload_kg: Option<f64>,
    /// Programming language of the controller.
    pub language: Option<String>,
    /// What the controller computes with.
    pub controller: ControllerModel,
    /// The effects of the controller's own calibrated chain, where the file gives them.
    pub own_effects: Option<Vec<Effect>>,
    /// Encoder pulses of one degree of each joint, for programs that count in pulses.
    pub pulses_per_deg: Option<[f64; 6]>,
    /// Where the base stands.
    pub world_from_base: Pose,
    /// The nominal rows of the chain.
    pub links: [Link; 6],
    /// How the controller counts joint angles.
    pub mechanism: Mechanism,
    /// Largest speed of each joint where it is given, rad/s.
    pub joint_speeds: [Option<f64>; 6],
    /// The flange on the last link.
    pub link6_from_flange: Pose,
    /// Masses of the links.
    pub bodies: Vec<Body>,
    /// Bodies of the links, for collisions.
    pub shapes: Vec<LinkShape>,
    /// What stands around the arm and moves.
    pub external: ExternalAxes,
    /// Gravity in the world, m/s².
    pub gravity_m_s2: Vector,
    /// Tools by name.
    pub tools: BTreeMap<String, ToolOfProfile>,
    /// Measured points in the tool frame by name, metres.
    pub points: BTreeMap<String, Vector>,
    /// The identified effects.
    pub effects: Vec<Effect>,
    /// Why effects may be beyond the usual.
    pub large: Reasons,
    /// How the columns of measurements are named.
    pub tables: Tables,
    /// Where the device stood that the calibration was measured with; what reads measurements
    /// applies it.
    pub device: Option<DevicePlace>,
    /// Statistics of the calibration, as the file has them.
    pub quality: Option<serde_json::Value>,
    /// Where the calibration comes from, as the file has it.
    pub provenance: Option<serde_json::Value>,
}

/// Why effects of a profile may be beyond the usual (`large: true` with a `reason`), by
/// [`Effect::label`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reasons {
    /// Those of the controller's own chain.
    pub controller: BTreeMap<String, String>,
    /// Those of the calibration.
    pub calibration: BTreeMap<String, String>,
}

/// A tool of the profile.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolOfProfile {
    /// Where its tip is.
    pub flange_from_tool: Pose,
    /// Mass in kg and centre of gravity in the flange frame in metres.
    pub load: Option<(f64, Vector)>,
}

/// A tool to build a model with.
#[derive(Clone, Debug, PartialEq)]
pub struct Mounted {
    /// Name, for effects that belong to one tool.
    pub name: String,
    /// Where its tip is.
    pub flange_from_tool: Pose,
    /// Mass in kg and centre of gravity in the flange frame in metres.
    pub load: Option<(f64, Vector)>,
}

impl Mounted {
    /// No tool: the flange itself.
    #[must_use]
    pub fn flange() -> Self {
        Self {
            name: "flange".into(),
            flange_from_tool: Pose::identity(),
            load: None,
        }
    }
}

impl Profile {
    /// Reads a profile file's text.
    ///
    /// # Errors
    /// Anything the format does not allow, with line and column.
    pub fn from_yaml(text: &str) -> Result<Self, ProfileError> {
        let file: ProfileFile =
            serde_yaml::from_str(text).map_err(|error| ProfileError::of(text, FORMAT, error))?;
        Self::from_file(file)
    }

    /// A nominal arm of these rows that stands at the world's origin, without anything else.
    #[must_use]
    pub fn nominal(links: [Link; 6], mechanism: Mechanism) -> Self {
        Self {
            manufacturer: "unknown".into(),
            model: "unknown".into(),
            serial: None,
            payload_kg: None,
            language: None,
            controller: ControllerModel::Nominal,
            own_effects: None,
            pulses_per_deg: None,
            world_from_base: Pose::identity(),
            links,
            mechanism,
            joint_speeds: [None; 6],
            link6_from_flange: Pose::identity(),
            bodies: Vec::new(),
            shapes: Vec::new(),
            external: ExternalAxes::default(),
            gravity_m_s2: file::earth().map(|n| n.0),
            tools: BTreeMap::new(),
            points: BTreeMap::new(),
            effects: Vec::new(),
            large: Reasons::default(),
            tables: Tables::default(),
            device: None,
            quality: None,
            provenance: None,
        }
    }

    /// The JSON Schema of the format.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        file::schema::<ProfileFile>(FORMAT)
    }

    /// The tool of this name ready to be mounted. Case, blanks and leading zeros of numbers do not
    /// count.
    #[must_use]
    pub fn tool(&self, name: &str) -> Option<Mounted> {
        let (name, tool) = self
            .tools
            .get_key_value(name)
            .or_else(|| self.tools.iter().find(|(of, _)| same_tool(of, name)))?;
        Some(Mounted {
            name: name.clone(),
            flange_from_tool: tool.flange_from_tool,
            load: tool.load,
        })
    }

    /// The nominal arm with a tool.
    #[must_use]
    pub fn geometry(&self, tool: &Mounted) -> Geometry {
        Geometry {
            world_from_base: self.world_from_base,
            links: self.links,
            link6_from_flange: self.link6_from_flange,
            flange_from_tool: tool.flange_from_tool,
            flange_from_nominal_tool: tool.flange_from_tool,
            bodies: self.bodies.clone(),
            load: tool.load,
            gravity_m_s2: self.gravity_m_s2,
            tool_name: tool.name.clone(),
            carried: None,
        }
    }

    /// What carries the base where external axes stand so; `None` without a track, and where
    /// nothing is said of them. `with_base`: the track goes along with the base, wherever that
    /// is seen.
    #[must_use]
    pub fn carried(&self, stand: &Stand, with_base: bool) -> Option<Carried> {
        let is_carried = !self.external.track.is_empty() && !stand.values.is_empty();
        is_carried.then(|| Carried {
            axes: self.external.clone(),
            stand: stand.clone(),
            origin: self.world_from_base.translation,
            home: with_base.then(|| self.world_from_real_base()),
        })
    }

    /// The effects that the controller already applies itself: those of its own calibrated chain;
    /// where the profile does not give them, the link geometry of the calibration.
    #[must_use]
    pub fn controller_effects(&self) -> Vec<Effect> {
        match (self.controller, &self.own_effects) {
            (ControllerModel::Nominal, _) => Vec::new(),
            (ControllerModel::Calibrated, Some(effects)) => effects.clone(),
            (ControllerModel::Calibrated, None) => self
                .effects
                .iter()
                .filter(|effect| effect.kind == Kind::LinkGeometry)
                .cloned()
                .collect(),
        }
    }

    /// Farther from its frame, in metres, the centre of gravity of a body or load of this arm is not:
    /// twice the lengths of all rows.
    #[must_use]
    pub fn farthest_cog_m(&self) -> f64 {
        reading::MOST_REACHES * reading::reach_m(&self.links)
    }

    /// The effects of the arm as it really is: those of the calibration. Where there are none,
    /// nothing better is known than what the controller computes with.
    #[must_use]
    pub fn real_effects(&self) -> Vec<Effect> {
        if self.effects.is_empty() {
            self.controller_effects()
        } else {
            self.effects.clone()
        }
    }

    /// The arm as the controller computes with it.
    #[must_use]
    pub fn controller_model(&self, tool: &Mounted) -> Model {
        Model::build(
            &self.geometry(tool),
            &self.mechanism,
            &self.controller_effects(),
            &Conditions::default(),
        )
    }

    /// The arm as it really is, with the base where it stands at home.
    #[must_use]
    pub fn real_model(&self, tool: &Mounted, conditions: &Conditions) -> Model {
        self.real_model_at(tool, conditions, &Stand::default())
    }

    /// The arm as it really is where external axes stand so.
    #[must_use]
    pub fn real_model_at(&self, tool: &Mounted, conditions: &Conditions, stand: &Stand) -> Model {
        let geometry = Geometry {
            carried: self.carried(stand, false),
            ..self.geometry(tool)
        };
        Model::build(&geometry, &self.mechanism, &self.real_effects(), conditions)
    }
}

/// Whether a point is off the origin, and by less than a millimetre in each coordinate: metres are
/// meant.
pub fn is_tiny(point_m: &Vector) -> bool {
    let off = point_m.map(f64::abs);
    off.iter().all(|m| *m < TINY_M) && off.iter().any(|m| *m > NO_LENGTH_M)
}

#[cfg(test)]
mod tests;
