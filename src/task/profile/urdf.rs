//! A profile of a URDF, and back.

use super::export::tools;
use super::inverse;
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::profile::{MAKERS, Maker, Profile, ToolOfProfile};
use crate::model::{Chain, Conditions, Geometry, Model};
use crate::nearest;
use crate::printable::printable;
use crate::program::Source;
use crate::task::programs::language_by_id;
use crate::task::{Document, Failure, text};
use crate::urdf::{
    About, Choice, Drawing, MOST_M, Meshes, UrdfArm, UrdfError, is_name, profile_text, urdf_text,
};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// A URDF and what to take of it.
pub struct Inputs<'a> {
    /// The URDF.
    pub urdf: &'a Source,
    /// Its name in the profile's comments.
    pub origin: &'a str,
    /// What to take of it.
    pub choice: Choice,
    /// Where its meshes are.
    pub meshes: Meshes<'a>,
    /// The maker, the controller's language and the serial number where they are given.
    pub about: [Option<&'a str>; 3],
    /// Tools by name.
    pub tools: BTreeMap<String, ToolOfProfile>,
}

/// A profile made of a URDF.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct FromUrdf {
    /// The robot's name.
    pub robot: String,
    /// The link where the world is.
    pub base: String,
    /// The link that tools are mounted on.
    pub tip: String,
    /// Whether and how the arm has an inverse.
    pub inverse: String,
    /// What was taken differently from what stands in the URDF, what was added, and what is
    /// missing.
    pub notes: Vec<String>,
    /// The profile's text.
    pub profile: String,
    /// The file written.
    pub output: Option<String>,
}

impl Document for FromUrdf {
    const KIND: &'static str = "new-profile/1";
}

/// Makes a profile of a URDF: its six axes, limits, masses and collision shapes.
///
/// # Errors
/// A URDF that is no arm of six rotary joints, an unknown language.
pub fn from_urdf(inputs: &Inputs) -> Result<FromUrdf, Failure> {
    let name = &inputs.urdf.name;
    let failure = |error: UrdfError| Failure::with_hint(format!("{name}: {error}"), error.hint());
    let [maker, language, serial] = inputs.about;
    if let Some(language) = language {
        language_by_id(language)?;
    }
    let arm = UrdfArm::read(&text(inputs.urdf)?, &inputs.choice).map_err(failure)?;
    let about = About {
        maker,
        language,
        serial,
        tools: inputs.tools.clone(),
        ..About::of(inputs.origin, inputs.meshes)
    };
    let (yaml, mut notes) = profile_text(&arm, &about).map_err(failure)?;
    notes.extend(maker.and_then(unknown_maker));
    let profile =
        Profile::from_yaml(&yaml).map_err(|error| Failure::profile(name, &yaml, &error))?;
    if profile.language.is_none() {
        notes.push("the controller's language is not known: --language names it".into());
    }
    let [base, tip] = arm.ends;
    Ok(FromUrdf {
        robot: arm.name,
        base,
        tip,
        inverse: inverse(&profile),
        notes,
        profile: yaml,
        output: None,
    })
}

/// Refuses lengths that no URDF has.
fn refuse_far(profile: &Profile) -> Result<(), Failure> {
    let mut all: Vec<(String, f64)> = Vec::new();
    for (link, number) in profile.links.iter().zip(1..) {
        all.push((
            format!("kinematics.joints: a_mm of joint {number}"),
            link.a_m,
        ));
        all.push((
            format!("kinematics.joints: d_mm of joint {number}"),
            link.d_m,
        ));
    }
    let mut frame = |key: String, pose: &Pose| {
        for (axis, value) in ["x_mm", "y_mm", "z_mm"].iter().zip(pose.translation) {
            all.push((format!("{key}: {axis}"), value));
        }
    };
    frame("kinematics.base".into(), &profile.world_from_base);
    frame("kinematics.flange".into(), &profile.link6_from_flange);
    for (name, tool) in tools(profile) {
        frame(format!("tools.{}.frame", printable(name)), &tool);
    }
    match all.into_iter().find(|(_, value)| value.abs() > MOST_M) {
        Some((key, value)) => Err(Failure::with_hint(
            format!(
                "{key} is {}; a URDF has no length beyond {} mm",
                mm_from_m(value),
                mm_from_m(MOST_M)
            ),
            "correct it in the profile: lengths are in mm",
        )),
        None => Ok(()),
    }
}

/// The text of a URDF of a profile with this geometry up to the flange.
///
/// # Errors
/// A name that no URDF can have; a text that, read again, is another arm.
pub(super) fn to_urdf(
    profile: &Profile,
    flange: &Geometry,
    comments: &[String],
) -> Result<String, Failure> {
    let keyed = profile.tools.keys().map(|name| ("tools", name));
    let mut names = keyed.chain([("robot.model", &profile.model)]);
    if let Some((key, name)) = names.find(|(_, name)| !is_name(name)) {
        return Err(Failure::with_hint(
            format!(
                "{key}: the name {} holds signs that no URDF can have",
                printable(name)
            ),
            "change it in the profile",
        ));
    }
    refuse_far(profile)?;
    let chain = Chain::of(flange, &profile.mechanism);
    let axes = chain.axes();
    let mut limits = profile.mechanism.joints.map(|j| [j.min_rad, j.max_rad]);
    for c in &profile.mechanism.coupling {
        let by = limits[c.on].map(|angle| c.ratio * angle);
        limits[c.joint][0] += by[0].min(by[1]);
        limits[c.joint][1] += by[0].max(by[1]);
    }
    let masses = std::array::from_fn(|i| {
        let own = || flange.bodies.iter().filter(|body| body.link == i);
        let mass: f64 = own().map(|body| body.mass_kg).sum();
        let centre = own().fold([0.0; 3], |sum: [f64; 3], body| {
            let cog = chain.turning_from_link(i).transform(body.cog_m);
            std::array::from_fn(|k| sum[k] + body.mass_kg * cog[k])
        });
        (mass > 0.0).then(|| (mass, centre.map(|moment| moment / mass)))
    });
    let text = urdf_text(&Drawing {
        name: &profile.model,
        comments,
        axes: &axes,
        limits,
        speeds: profile.joint_speeds,
        masses,
        tools: tools(profile).collect(),
    });
    // what is written is read again
    let choice = Choice {
        tip: Some("tool0".into()),
        ..Choice::default()
    };
    let again = UrdfArm::read(&text, &choice);
    let again = again.map_err(|error| {
        Failure::with_hint(
            format!("the profile's geometry is beyond what a URDF has: {error}"),
            "correct the lengths, limits and masses of the profile",
        )
    })?;
    let model = Model::build(flange, &profile.mechanism, &[], &Conditions::default());
    for k in 0..100 {
        let q = std::array::from_fn(|i| {
            let [low, high] = limits[i];
            low + (high - low) * (0.5 + 0.5 * (f64::from(k) * (i as f64 + 1.7)).sin())
        });
        let forward: Pose =
            model.forward(&profile.mechanism.controller(&q), &Conditions::default());
        let gap = forward.separation(&again.forward(&q));
        if gap.distance_m > 1e-9 || gap.angle_rad > 1e-9 {
            return Err(Failure::internal(format!(
                "the URDF made is {} mm and {} deg off the profile",
                mm_from_m(gap.distance_m),
                gap.angle_rad / DEG
            )));
        }
    }
    Ok(text)
}

/// A maker that may be a misspelt one.
fn unknown_maker(maker: &str) -> Option<String> {
    if Maker::by_name(maker).is_some() {
        return None;
    }
    let near = nearest::nearest(maker, MAKERS.iter().map(|maker| maker.name));
    let meant = near.first()?;
    Some(format!(
        "nothing is known of the controllers of `{maker}`; did you mean `{meant}`?"
    ))
}
