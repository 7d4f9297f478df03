//! `profile export`: what was identified in the forms that other programs read.

use super::Deviation;
use super::facts::{deviation, first_tool};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Rotation};
use crate::model::effects::{Effect, Kind};
use crate::model::profile::{Mounted, Profile};
use crate::model::{Axes, Chain, Conditions, Geometry, Link, Model, classic};
use crate::task::{Document, Failure, ProfileFile, parts};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// A form that other programs read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// A URDF.
    #[cfg(feature = "urdf")]
    Urdf,
    /// Classic (distal) Denavit–Hartenberg parameters as CSV.
    DhCsv,
    /// Modified (proximal, Craig's) ones with Hayati's β as CSV.
    MdhCsv,
    /// The `kinematics:` file of the ROS driver of Universal Robots.
    UrKinematics,
}

/// A row of the chain with what was identified of it.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Row {
    /// Angle between the axes, degrees.
    pub alpha_deg: f64,
    /// Distance of the axes, mm.
    pub a_mm: f64,
    /// Angle between nearly parallel axes, about y, degrees.
    pub beta_deg: f64,
    /// Angle where the joint stands at zero, degrees.
    pub theta_deg: f64,
    /// Distance along the axis, mm.
    pub d_mm: f64,
    /// −1 where the controller counts against the axis.
    pub sign: f64,
    /// Smallest angle of the controller, degrees.
    pub min_deg: f64,
    /// Largest angle of the controller, degrees.
    pub max_deg: f64,
}

/// A joint that the controller counts together with another one.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Coupled {
    /// The joint, from 1.
    pub joint: usize,
    /// The joint counted in, from 1.
    pub on: usize,
    /// How much of it.
    pub ratio: f64,
}

/// The geometry of the real arm.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ExportedChain {
    /// `world_from_base`.
    pub base: parts::Pose,
    /// `Rot(x, α) · Trans(a, 0, 0) · Rot(y, β) · Rot(z, θ + sign · q) · Trans(0, 0, d)`, joint 1
    /// to 6.
    pub rows: Vec<Row>,
    /// Joints that are counted together.
    pub coupling: Vec<Coupled>,
    /// `link6_from_flange`.
    pub flange: parts::Pose,
    /// `flange_from_tool` by name.
    pub tools: BTreeMap<String, parts::Pose>,
}

/// What a profile says in another form.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Exported {
    /// Which form; none where the JSON alone was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form: Option<Form>,
    /// The geometry with what was identified of it.
    pub chain: ExportedChain,
    /// Every effect of the calibration, as in profiles.
    pub effects: Vec<BTreeMap<String, Value>>,
    /// What the form, or the chain where there is none, does not carry.
    pub not_carried: Vec<String>,
    /// How far the real tool is from that of what was exported.
    pub deviation: Deviation,
    /// Its text, where it is not written to a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// The file written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
}

impl Document for Exported {
    const KIND: &'static str = "exported-profile/1";
}

/// The effects that are numbers of a chain, a base or a tool.
fn is_geometry(effect: &Effect) -> bool {
    matches!(
        effect.kind,
        Kind::LinkGeometry | Kind::BaseFrame | Kind::ToolFrame
    )
}

/// The real arm's geometry with a tool.
fn geometry(profile: &Profile, tool: &Mounted) -> Geometry {
    let mut geometry = profile.geometry(tool);
    for effect in profile.real_effects().iter().filter(|e| is_geometry(e)) {
        effect.change_geometry(&Conditions::default(), &mut geometry);
    }
    geometry
}

/// What a profile says, in a form that other programs read.
///
/// # Errors
/// The form cannot hold this arm; a text that, read again, is another arm.
pub fn export(file: &ProfileFile, form: Option<Form>) -> Result<Exported, Failure> {
    let profile = &file.profile;
    let flange = geometry(profile, &Mounted::flange());
    let mut not_carried = left_out(profile);
    let tool = first_tool(profile);
    let mut exported = geometry(profile, &tool);
    match form {
        None => {}
        Some(Form::UrKinematics) => {
            if profile.manufacturer != "Universal Robots" {
                return Err(Failure::with_hint(
                    format!(
                        "{}: the arm's maker is {}; the kinematics file is one of Universal \
                         Robots' driver",
                        file.name, profile.manufacturer
                    ),
                    "--urdf, --dh-csv or --mdh-csv",
                ));
            }
            let nominal = Pose::identity();
            for (what, pose) in [
                ("where the base stands", &mut exported.world_from_base),
                ("the flange on link 6", &mut exported.link6_from_flange),
            ] {
                let gap = pose.separation(&nominal);
                if gap.distance_m > 1e-12 || gap.angle_rad > 1e-12 {
                    not_carried.push(format!(
                        "{what}: the file begins at the base and ends at link 6"
                    ));
                    *pose = nominal;
                }
            }
            not_carried.push("tools, limits, masses".into());
        }
        #[cfg(feature = "urdf")]
        Some(Form::Urdf) => not_carried.push("collision shapes, moments of inertia".into()),
        Some(Form::DhCsv | Form::MdhCsv) => {
            not_carried.push(
                "masses, collision shapes; base, flange and tools stand in its comments".into(),
            );
        }
    }
    let coupled: Vec<Coupled> = profile
        .mechanism
        .coupling
        .iter()
        .map(|c| Coupled {
            joint: c.joint + 1,
            on: c.on + 1,
            ratio: c.ratio,
        })
        .collect();
    if form.is_some() {
        not_carried.extend(coupled.iter().map(|c| {
            format!(
                "the coupling: joint {0} here rotates by the controller's J{0} {1:+} J{2}",
                c.joint, c.ratio, c.on
            )
        }));
    }
    let conditions = Conditions::default();
    let written = Model::build(&exported, &profile.mechanism, &[], &conditions);
    let deviation = deviation(
        profile,
        &profile.real_model(&tool, &conditions),
        &written,
        &conditions,
    );
    let comments = comments(file, &not_carried, &deviation);
    let text = form
        .map(|form| match form {
            #[cfg(feature = "urdf")]
            Form::Urdf => super::urdf::to_urdf(profile, &flange, &comments),
            Form::DhCsv => Ok(dh_csv(profile, &flange, &comments)),
            Form::MdhCsv => Ok(mdh_csv(profile, &flange, &comments)),
            Form::UrKinematics => Ok(ur_kinematics(profile, &exported, &comments)),
        })
        .transpose()?;
    Ok(Exported {
        form,
        chain: chain(profile, &flange, coupled),
        effects: profile
            .effects
            .iter()
            .map(|effect| {
                let entry = effect.to_entry().into_iter();
                entry.map(|(key, value)| (key.to_owned(), value)).collect()
            })
            .collect(),
        not_carried,
        deviation,
        text,
        output: None,
    })
}

/// The effects that no chain of fixed numbers has, a line each.
fn left_out(profile: &Profile) -> Vec<String> {
    let effects = profile.real_effects();
    let others = effects.iter().filter(|effect| !is_geometry(effect));
    others
        .map(|effect| format!("{}: {}", effect.label(), effect.definition().summary))
        .collect()
}

/// What stands at the top of every form.
fn comments(file: &ProfileFile, not_carried: &[String], deviation: &Deviation) -> Vec<String> {
    let profile = &file.profile;
    let mut lines = vec![format!(
        "{} {}, serial {}: the real arm, exported by {} from a profile with SHA-256 {}",
        profile.manufacturer,
        profile.model,
        profile.serial.as_deref().unwrap_or("unknown"),
        crate::task::PROGRAM,
        file.sha256
    )];
    lines.extend(
        not_carried
            .iter()
            .map(|what| format!("not in here: {what}")),
    );
    lines.push(format!(
        "the real tool is {:.4} mm (mean), at most {:.4} mm, from where this has it, over {} \
         postures",
        deviation.mean_mm, deviation.max_mm, deviation.postures
    ));
    lines
}

fn chain(profile: &Profile, flange: &Geometry, coupling: Vec<Coupled>) -> ExportedChain {
    let row = |i: usize| {
        let (link, joint) = (&flange.links[i], &profile.mechanism.joints[i]);
        Row {
            alpha_deg: link.alpha_rad / DEG,
            a_mm: mm_from_m(link.a_m),
            beta_deg: link.beta_rad / DEG,
            theta_deg: (link.theta_rad + joint.offset_rad) / DEG,
            d_mm: mm_from_m(link.d_m),
            sign: joint.sign,
            min_deg: joint.min_rad / DEG,
            max_deg: joint.max_rad / DEG,
        }
    };
    ExportedChain {
        base: (&flange.world_from_base).into(),
        rows: (0..6).map(row).collect(),
        coupling,
        flange: (&flange.link6_from_flange).into(),
        tools: tools(profile)
            .map(|(name, pose)| (name.to_owned(), (&pose).into()))
            .collect(),
    }
}

/// Where the real tools are on the flange.
pub(super) fn tools(profile: &Profile) -> impl Iterator<Item = (&str, Pose)> {
    profile.tools.keys().filter_map(|name| {
        let tool = profile.tool(name)?;
        Some((name.as_str(), geometry(profile, &tool).flange_from_tool))
    })
}

/// A pose in a comment.
fn stated(what: &str, pose: &Pose) -> String {
    let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
    let [x, y, z] = [x, y, z].map(|x| mm_from_m(x) + 0.0);
    let [rx, ry, rz] = [rx, ry, rz].map(|a| a / DEG + 0.0);
    format!(
        "{what}: x_mm {x}, y_mm {y}, z_mm {z}, rx_deg {rx}, ry_deg {ry}, rz_deg {rz} (Trans Rx Ry \
         Rz)"
    )
}

/// The comments of a table, with where it begins and ends.
fn head(profile: &Profile, comments: &[String], ends: [(&str, &Pose); 2], row: &str) -> String {
    let mut lines = comments.to_vec();
    lines.push(format!("row: {row}"));
    lines.extend(ends.map(|(what, pose)| stated(what, pose)));
    lines.extend(
        tools(profile).map(|(name, pose)| stated(&format!("tool {name} on the flange"), &pose)),
    );
    lines
        .iter()
        .map(|line| format!("# {}\n", line.replace(['\n', '\r'], " ")))
        .collect()
}

fn dh_csv(profile: &Profile, flange: &Geometry, comments: &[String]) -> String {
    let mechanism = &profile.mechanism;
    let links: [Link; 6] = std::array::from_fn(|i| Link {
        theta_rad: flange.links[i].theta_rad + mechanism.joints[i].offset_rad,
        ..flange.links[i]
    });
    let (first, rows) = classic(&links);
    let before = flange.world_from_base * first;
    let mut out = head(
        profile,
        comments,
        [
            ("before row 1", &before),
            ("behind row 6, the flange", &flange.link6_from_flange),
        ],
        "Rz(theta + sign q) Tz(d) Tx(a) Rx(alpha)",
    );
    out += "joint,theta_deg,d_mm,a_mm,alpha_deg,sign,min_deg,max_deg\n";
    for (i, (row, joint)) in rows.iter().zip(&mechanism.joints).enumerate() {
        out += &format!(
            "{},{},{},{},{},{},{},{}\n",
            i + 1,
            row.theta_rad / DEG,
            mm_from_m(row.d_m),
            mm_from_m(row.a_m),
            row.alpha_rad / DEG,
            joint.sign,
            joint.min_rad / DEG,
            joint.max_rad / DEG
        );
    }
    out
}

fn mdh_csv(profile: &Profile, flange: &Geometry, comments: &[String]) -> String {
    let mut out = head(
        profile,
        comments,
        [
            ("before row 1, the base", &flange.world_from_base),
            ("behind row 6, the flange", &flange.link6_from_flange),
        ],
        "Rx(alpha) Tx(a) Ry(beta) Rz(theta + sign q) Tz(d)",
    );
    out += "joint,alpha_deg,a_mm,beta_deg,theta_deg,d_mm,sign,min_deg,max_deg\n";
    for (i, row) in chain(profile, flange, Vec::new()).rows.iter().enumerate() {
        out += &format!(
            "{},{},{},{},{},{},{},{},{}\n",
            i + 1,
            row.alpha_deg,
            row.a_mm,
            row.beta_deg,
            row.theta_deg,
            row.d_mm,
            row.sign,
            row.min_deg,
            row.max_deg
        );
    }
    out
}

fn ur_kinematics(profile: &Profile, exported: &Geometry, comments: &[String]) -> String {
    let flange = Geometry {
        flange_from_tool: Pose::identity(),
        ..exported.clone()
    };
    let Axes { mut steps, last } = Chain::of(&flange, &profile.mechanism).axes();
    // a shift along axis 6, and nothing else, is left behind joint 6: it changes places with the
    // joint's rotation
    steps[5] = steps[5]
        * Pose {
            rotation: Rotation::identity(),
            translation: last.translation,
        };
    let mut out: String = comments.iter().map(|line| format!("# {line}\n")).collect();
    out += "kinematics:\n";
    let names = [
        "shoulder",
        "upper_arm",
        "forearm",
        "wrist_1",
        "wrist_2",
        "wrist_3",
    ];
    for (name, step) in names.iter().zip(&steps) {
        let [x, y, z] = step.translation.map(|x| x + 0.0);
        let [yaw, pitch, roll] = step.rotation.yaw_pitch_roll();
        out += &format!(
            "  {name}:\n    x: {x}\n    y: {y}\n    z: {z}\n    roll: {roll}\n    pitch: \
             {pitch}\n    yaw: {yaw}\n"
        );
    }
    out
}
