//! The catalogue: nominal arms from public sources, one row of one table an arm.
//!
//! The rows of a chain, limits and speeds are those of a file that each row names (repository,
//! commit, path); world and flange are the controller's where the file has them. Nothing of it was
//! checked on a robot.
//!
//! # Source
//! `robots/catalogue.csv`; what was checked and where sources disagree is in `robots/README.md`.

use super::Profile;
use super::makers::Maker;
use super::text::{Comments, made};
use crate::geometry::Pose;
use crate::geometry::units::DEG;
use crate::geometry::units::m_from_mm;
use crate::model::{Coupling, JointSense, Link, Mechanism, set_upright};
use serde::Deserialize;

/// The table, a part of the program; it is read where it is asked for.
const TABLE: &str = include_str!("../../../robots/catalogue.csv");

/// One arm of the catalogue, as its row has it.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct CatalogueArm {
    /// Its name here.
    pub name: String,
    /// Maker.
    pub manufacturer: String,
    /// Type.
    pub model: String,
    base: String,
    joint1: String,
    joint2: String,
    joint3: String,
    joint4: String,
    joint5: String,
    joint6: String,
    coupling: String,
    flange: String,
    /// The repository of the file that the numbers are from.
    pub repository: String,
    /// Its commit.
    pub commit: String,
    /// The file.
    pub path: String,
    /// What xacro was given with it.
    pub arguments: String,
    tip: String,
    root: String,
    pedestal_mm: String,
    /// What other files of the same arm say.
    pub second_source: String,
    note: String,
}

/// Every arm of the catalogue, by name.
///
/// # Panics
/// Never: the table is part of the program, and tested.
#[must_use]
pub fn catalogue() -> Vec<CatalogueArm> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(TABLE.as_bytes());
    reader
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("the catalogue is tested")
}

fn numbers<const N: usize>(text: &str) -> [f64; N] {
    let numbers: Vec<f64> = text
        .split(' ')
        .map(|n| n.parse().expect("the catalogue is tested"))
        .collect();
    numbers.try_into().expect("the catalogue is tested")
}

fn pose(text: &str) -> Pose {
    let [x, y, z, rx, ry, rz] = numbers(text);
    let [x, y, z] = [x, y, z].map(m_from_mm);
    Pose::from_xyz_rxryrz([x, y, z, rx * DEG, ry * DEG, rz * DEG])
}

impl CatalogueArm {
    fn joints(&self) -> [&str; 6] {
        let Self {
            joint1,
            joint2,
            joint3,
            joint4,
            joint5,
            joint6,
            ..
        } = self;
        [joint1, joint2, joint3, joint4, joint5, joint6].map(String::as_str)
    }

    /// The nominal arm.
    ///
    /// # Panics
    /// Never: the table is part of the program, and tested.
    #[must_use]
    pub fn profile(&self) -> Profile {
        let rows = self.joints().map(|row| {
            let (row, speed) = match row.splitn(7, ' ').nth(6) {
                Some(speed) => (&row[..row.len() - speed.len() - 1], Some(speed)),
                None => (row, None),
            };
            let [alpha, a, theta, d, min, max] = numbers(row);
            let link = Link {
                alpha_rad: alpha * DEG,
                a_m: m_from_mm(a),
                beta_rad: 0.0,
                theta_rad: theta * DEG,
                d_m: m_from_mm(d),
            };
            let sense = JointSense {
                sign: 1.0,
                offset_rad: 0.0,
                min_rad: min * DEG,
                max_rad: max * DEG,
            };
            (link, sense, speed.map(|speed| numbers::<1>(speed)[0] * DEG))
        });
        let mut links = rows.map(|row| row.0);
        let mut mechanism = Mechanism {
            joints: rows.map(|row| row.1),
            coupling: Vec::new(),
        };
        let mut base = pose(&self.base);
        set_upright(&mut base, &mut links, &mut mechanism.joints[0]);
        if !self.coupling.is_empty() {
            let mut words = self.coupling.split(' ');
            let mut index = || {
                let number: usize = words.next()?.parse().ok()?;
                number.checked_sub(1)
            };
            let pair = index().zip(index());
            let (joint, on) = pair.expect("the catalogue is tested");
            let [_, _, ratio] = numbers(&self.coupling);
            mechanism.couple(Coupling { joint, on, ratio });
        }
        Profile {
            manufacturer: self.manufacturer.clone(),
            model: self.model.clone(),
            language: Maker::by_name(&self.manufacturer).map(|maker| maker.language.into()),
            world_from_base: base,
            joint_speeds: rows.map(|row| row.2),
            link6_from_flange: pose(&self.flange),
            ..Profile::nominal(links, mechanism)
        }
    }

    /// Where the numbers are from: repository, commit and file.
    #[must_use]
    pub fn source(&self) -> String {
        let arguments = if self.arguments.is_empty() {
            String::new()
        } else {
            format!(" ({})", self.arguments)
        };
        format!(
            "{} at {}, {}{arguments}",
            self.repository, self.commit, self.path
        )
    }

    /// A profile's text, its comments saying where each number is from and what is to be set.
    #[must_use]
    pub fn text(&self) -> String {
        let profile = self.profile();
        let mut top = vec![
            format!(
                "{} {}, nominal, from the catalogue of poseshift; not checked on a robot.",
                self.manufacturer, self.model
            ),
            format!("Numbers: {}.", self.source()),
        ];
        if !self.second_source.is_empty() {
            top.push(format!("A second file: {}.", self.second_source));
        }
        top.push(
            "Lengths agree in 28 of 29 pairs of independent files of one arm; ranges differ in 17: \
             set min_deg, max_deg and".into(),
        );
        top.push("  speed_deg_s from the data sheet of this very variant.".into());
        if let Some(c) = profile.mechanism.coupling.first() {
            top.extend(coupled(c));
        }
        top.push(self.world());
        top.push(self.tip());
        top.extend(flange_remark(&profile.link6_from_flange));
        top.push(
            "Senses and zeros of the joints are the file's: compare them, and the flange with tool \
             0, with the pendant in two postures.".into(),
        );
        top.push(
            "Masses: none here. Effects of compliance see the tool alone until `bodies` has the \
             masses of the links."
                .into(),
        );
        if !self.note.is_empty() {
            top.push(format!("Note: {}.", self.note));
        }
        let comments = Comments {
            top,
            ..Comments::default()
        };
        made(&profile, &comments)
    }

    fn world(&self) -> String {
        match self.root.as_str() {
            "" => "World: the foot of the arm.".into(),
            "base" | "wbase" => format!(
                "World: link `{}` of the file, by convention where the controller counts from.",
                self.root
            ),
            root if self.pedestal_mm.is_empty() => format!(
                "World: link `{root}` of the file; whether the controller counts from there is not \
                 known: compare a pose with the pendant."
            ),
            root => format!(
                "World: link `{root}`, the foot; the file puts it {} mm above its own world, on a \
                 pedestal that is left out here.",
                self.pedestal_mm
            ),
        }
    }

    fn tip(&self) -> String {
        match self.tip.as_str() {
            "" => "Flange: tool 0, z out.".into(),
            "tool0" | "fanuc_flange" => format!(
                "Flange: link `{}` of the file, the controller's tool 0, z out.",
                self.tip
            ),
            tip => format!(
                "Flange: link `{tip}` of the file, where it ends; compare its distance and its \
                 axes with tool 0 on the pendant."
            ),
        }
    }
}

/// The flange's z is on axis 6 within an angle of this cosine.
const ALONG: f64 = 0.999;

/// What is to be said of a flange that cannot be a controller's tool 0.
pub fn flange_remark(link6_from_flange: &Pose) -> Option<String> {
    let is_along = link6_from_flange.rotation.0[2][2].abs() > ALONG;
    (!is_along).then(|| {
        "The flange's z is not along axis 6, as it is of a controller's tool 0: turn `flange` \
         until both agree."
            .into()
    })
}

/// What is to be known of a coupled joint, in lines.
pub fn coupled(c: &Coupling) -> [String; 2] {
    let (joint, on) = (c.joint + 1, c.on + 1);
    let sign = if c.ratio < 0.0 { '-' } else { '+' };
    [
        format!(
            "Coupling: the controller counts J{joint} together with J{on}: the joint turns by \
             J{joint} {sign} J{on} (`coupling`). Compare a posture with"
        ),
        format!(
            "  J{on} away from zero with the pendant. The range of J{joint} holds whichever of the \
             two the file means: set it from the data sheet."
        ),
    ]
}
