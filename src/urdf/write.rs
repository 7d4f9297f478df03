//! A profile from an arm.

use super::chain::rows;
use super::{UrdfArm, UrdfError, UrdfForm};
use crate::geometry::Pose;
use crate::model::profile::{
    Comments, MAKERS, Maker, Mounted, Profile, ToolOfProfile, coupled, flange_remark, made,
};
use crate::model::shape::{Form, LinkShape, Shape};
use crate::model::{Body, Conditions, JointSense, Mechanism, UPSIDE_DOWN, set_upright};
use std::collections::BTreeMap;

/// How far the profile's chain may be from the URDF's own, metres and radians.
const AGREES: f64 = 1e-9;
/// Postures at which they are compared.
const POSTURES: u64 = 1000;
/// The path that a mesh's name in the URDF stands for; `None` where there is no such file.
pub type Meshes<'a> = &'a dyn Fn(&str) -> Option<String>;

/// What a URDF does not say.
pub struct About<'a> {
    /// The URDF's name in the profile's comments.
    pub source: &'a str,
    /// The maker; where it is not given, the one whose name stands in the robot's or its packages'
    /// names.
    pub maker: Option<&'a str>,
    /// The controller's language; where it is not given, the one of the maker's controllers.
    pub language: Option<&'a str>,
    /// The robot's serial number.
    pub serial: Option<&'a str>,
    /// Tools by name.
    pub tools: BTreeMap<String, ToolOfProfile>,
    /// Where meshes are.
    pub meshes: Meshes<'a>,
}

impl<'a> About<'a> {
    /// Nothing but the URDF's name, and where its meshes are.
    #[must_use]
    pub fn of(source: &'a str, meshes: Meshes<'a>) -> Self {
        Self {
            source,
            maker: None,
            language: None,
            serial: None,
            tools: BTreeMap::new(),
            meshes,
        }
    }
}

/// The text of a profile for an arm, its chain compared with the URDF's own, and what is to be
/// known of it.
///
/// # Errors
/// If two axes are one line, a mesh is not found, or the chains differ.
pub fn profile_text(arm: &UrdfArm, about: &About) -> Result<(String, Vec<String>), UrdfError> {
    let mut notes = arm.notes.clone();
    let profile = profile(arm, about, &mut notes)?;
    let mut top = vec![format!(
        "Made by `poseshift profile from-urdf` from {}, {} to {}.",
        about.source, arm.ends[0], arm.ends[1]
    )];
    top.extend(notes.iter().cloned());
    top.push(
        "Joints of the controller are taken to be those of the URDF: compare sense and zero with \
         the pendant."
            .into(),
    );
    let names: Vec<String> = arm.joints.iter().map(|joint| joint.name.clone()).collect();
    let comments = Comments {
        top,
        joints: names.try_into().unwrap_or_default(),
    };
    let text = made(&profile, &comments);
    compare(arm, &text)?;
    Ok((text, notes))
}

fn profile(arm: &UrdfArm, about: &About, notes: &mut Vec<String>) -> Result<Profile, UrdfError> {
    let mut rows = rows(arm)?;
    let mut mechanism = Mechanism {
        joints: std::array::from_fn(|i| JointSense {
            sign: 1.0,
            offset_rad: 0.0,
            min_rad: arm.joints[i].min_rad,
            max_rad: arm.joints[i].max_rad,
        }),
        coupling: Vec::new(),
    };
    let first = &mut mechanism.joints[0];
    if set_upright(&mut rows.base, &mut rows.links, first) {
        rows.frames[0] = rows.base;
        rows.frames[1] = rows.frames[1] * UPSIDE_DOWN;
    }
    let maker = maker(arm, about, notes);
    if let Some(coupling) = maker.and_then(|maker| maker.coupling) {
        notes.extend(coupled(&coupling));
        mechanism.couple(coupling);
    }
    notes.extend(
        maker
            .map(|maker| maker.remark.to_owned())
            .filter(|remark| !remark.is_empty()),
    );
    notes.extend(flange_remark(&rows.flange));
    // from a joint's frame to the frame after its row, both at zero
    let urdf = arm.frames();
    let seen = |moved_by: usize| rows.frames[moved_by].inverse() * urdf[moved_by];
    let body = |(moved_by, mass_kg, cog): &(usize, f64, _)| Body {
        link: moved_by - 1,
        mass_kg: *mass_kg,
        cog_m: seen(*moved_by).transform(*cog),
    };
    let bodies: Vec<Body> = arm.masses.iter().map(body).collect();
    notes.extend(missing_masses(&bodies));
    let mut shapes = Vec::new();
    for shape in &arm.shapes {
        shapes.push(LinkShape {
            link: shape.moved_by,
            shape: Shape {
                form: form(&shape.form, &shape.link, about.meshes)?,
                frame_from_shape: seen(shape.moved_by) * shape.joint_from_shape,
            },
        });
    }
    let language = about.language.or(maker.map(|maker| maker.language));
    let manufacturer = maker.map(|maker| maker.name).or(about.maker);
    Ok(Profile {
        manufacturer: manufacturer.unwrap_or("unknown").into(),
        model: arm.name.clone(),
        serial: about.serial.map(Into::into),
        language: language.map(Into::into),
        world_from_base: rows.base,
        joint_speeds: std::array::from_fn(|i| arm.joints[i].speed_rad_s),
        link6_from_flange: rows.flange,
        bodies,
        shapes,
        tools: about.tools.clone(),
        ..Profile::nominal(rows.links, mechanism)
    })
}

/// The maker that is given, or that the names tell, or whose controllers alone have the language.
fn maker(arm: &UrdfArm, about: &About, notes: &mut Vec<String>) -> Option<&'static Maker> {
    if let Some(given) = about.maker {
        return Maker::by_name(given);
    }
    let packages: Vec<&str> = arm.packages.iter().map(String::as_str).collect();
    let named = Maker::marked_in(&format!("{} {}", arm.name, packages.join(" ")));
    let by = match named {
        Some(_) => "the names of the robot and its packages",
        None => "the language of its controller",
    };
    let speaks = |maker: &&Maker| Some(maker.language) == about.language;
    let found = named.or_else(|| MAKERS.iter().find(speaks))?;
    notes.push(format!(
        "the maker is {}, by {by}; --maker names another",
        found.name
    ));
    Some(found)
}

/// What effects of compliance cannot know without the masses that the file does not have.
fn missing_masses(bodies: &[Body]) -> Option<String> {
    let without: Vec<String> = (0..6)
        .filter(|link| !bodies.iter().any(|body| body.link == *link))
        .map(|link| (link + 1).to_string())
        .collect();
    let add = "add them under `bodies` (link, mass_kg, cog_mm in the link's frame)";
    match bodies {
        [] => Some(format!(
            "no link has a mass: effects of compliance see the tool alone; {add}"
        )),
        [first, rest @ ..] if rest.len() > 2 && rest.iter().all(|b| b.mass_kg == first.mass_kg) => {
            Some(format!(
                "every mass is {} kg, which is no arm: before a calibration with compliance put \
                 the real ones under `bodies`",
                first.mass_kg
            ))
        }
        _ if without.is_empty() => None,
        _ => Some(format!("links {} have no mass: {add}", without.join(", "))),
    }
}

fn form(form: &UrdfForm, link: &str, meshes: Meshes) -> Result<Form, UrdfError> {
    Ok(match form {
        UrdfForm::Box(size) => Form::Box { size_m: *size },
        UrdfForm::Cylinder(radius, long) => Form::Cylinder {
            radius_m: *radius,
            height_m: *long,
        },
        UrdfForm::Capsule(radius, long) => Form::Capsule {
            from_m: [0.0, 0.0, -0.5 * long],
            to_m: [0.0, 0.0, 0.5 * long],
            radius_m: *radius,
        },
        UrdfForm::Sphere(radius) => Form::Sphere { radius_m: *radius },
        UrdfForm::Mesh(file, scale) => Form::Mesh {
            file: meshes(file).ok_or_else(|| UrdfError::Mesh {
                file: file.clone(),
                link: link.into(),
            })?,
            scale: Some([1000.0 * scale; 3]),
        },
    })
}

/// Reads the text again and compares its chain with the URDF's.
fn compare(arm: &UrdfArm, text: &str) -> Result<(), UrdfError> {
    let profile = Profile::from_yaml(text).map_err(|error| UrdfError::Unreadable {
        message: format!("the profile made of it: {error}"),
    })?;
    let model = profile.controller_model(&Mounted::flange());
    let (mut gap_m, mut gap_rad) = (0.0_f64, 0.0_f64);
    // splitmix64: the same postures always
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut part = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    for _ in 0..POSTURES {
        let u: [f64; 6] = std::array::from_fn(|i| {
            let joint = &arm.joints[i];
            joint.min_rad + (joint.max_rad - joint.min_rad) * part()
        });
        let real: Pose = model.forward(&profile.mechanism.controller(&u), &Conditions::default());
        let gap = real.separation(&arm.forward(&u));
        gap_m = gap_m.max(gap.distance_m);
        gap_rad = gap_rad.max(gap.angle_rad);
    }
    if gap_m <= AGREES && gap_rad <= AGREES {
        Ok(())
    } else {
        Err(UrdfError::Differs { gap_m, gap_rad })
    }
}
