//! `robots`, `effects`, `languages`: what is built in.

use super::{Document, Failure};
use crate::finding::TABLE;
use crate::inverse::Arm;
use crate::model::effects::{self, REGISTRY};
use crate::model::profile::{Mounted, Profile, SHIPPED, catalogue};
use crate::nearest;
use crate::program::LANGUAGES;
use schemars::JsonSchema;
use serde::Serialize;

/// Where the numbers of a built-in robot are from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Origin {
    /// A profile that was put together by hand, with data sheets.
    Profile,
    /// A row of the catalogue, made of one public file.
    Catalogue,
}

/// A robot that is built in.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Robot {
    /// Its name here.
    pub name: String,
    /// Where its numbers are from.
    pub origin: Origin,
    /// Repository, commit and file of a row of the catalogue.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// Its maker.
    pub manufacturer: String,
    /// Its model.
    pub model: String,
    /// The language of its controller.
    pub language: Option<String>,
    /// The kind of its closed-form inverse, or `none`.
    pub closed_form_inverse: &'static str,
    /// How many effects its calibration has.
    pub effects: usize,
}

/// The robots that are built in.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Robots {
    /// By name.
    pub robots: Vec<Robot>,
}

impl Document for Robots {
    const KIND: &'static str = "robots/1";
}

impl Robot {
    fn of(name: &str, profile: Profile, source: Option<String>) -> Self {
        let arm = Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism);
        Self {
            name: name.into(),
            origin: match source {
                Some(_) => Origin::Catalogue,
                None => Origin::Profile,
            },
            source,
            closed_form_inverse: arm.map_or("none", |arm| arm.kind()),
            effects: profile.effects.len(),
            manufacturer: profile.manufacturer,
            model: profile.model,
            language: profile.language,
        }
    }

    /// Whether every word of a search stands in its name, maker or model, whatever the case and
    /// punctuation.
    fn is_found_by(&self, search: &str) -> bool {
        let all = nearest::plain(&format!("{}{}{}", self.name, self.manufacturer, self.model));
        let mut words = search.split_whitespace().map(nearest::plain);
        words.all(|word| all.contains(&word))
    }
}

/// The robots that are built in: those whose name, maker or model have every word of `search`.
///
/// # Errors
/// No robot is found.
///
/// # Panics
/// Never: the profiles are part of the program, and tested.
pub fn robots(search: Option<&str>) -> Result<Robots, Failure> {
    let shipped = SHIPPED.iter().map(|(name, text)| {
        let profile = Profile::from_yaml(text).expect("shipped profiles are tested");
        Robot::of(name, profile, None)
    });
    let rows = catalogue();
    let rows = rows
        .iter()
        .map(|arm| Robot::of(&arm.name, arm.profile(), Some(arm.source())));
    let mut robots: Vec<Robot> = shipped.chain(rows).collect();
    robots.sort_by(|a, b| a.name.cmp(&b.name));
    let Some(search) = search else {
        return Ok(Robots { robots });
    };
    let names: Vec<String> = robots.iter().map(|robot| robot.name.clone()).collect();
    robots.retain(|robot| robot.is_found_by(search));
    if robots.is_empty() {
        let names = names.iter().map(String::as_str);
        return Err(Failure::with_hint(
            format!("no built-in robot has `{search}` in its name, maker or model"),
            nearest::hint(search, "robots", names) + " (`poseshift robots` lists them)",
        ));
    }
    Ok(Robots { robots })
}

/// A parameter of an effect.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Parameter {
    /// Its key in profiles.
    pub key: &'static str,
    /// The unit of its value.
    pub unit: &'static str,
    /// Its typical size.
    pub prior_sigma: f64,
}

/// A physical effect that a calibration may have.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Effect {
    /// Its id.
    pub effect: &'static str,
    /// What it is.
    pub summary: &'static str,
    /// Its equation.
    pub equation: &'static str,
    /// Where that is from.
    pub source: &'static str,
    /// The keys of its place.
    pub site: Vec<&'static str>,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// What measurements it needs.
    pub needs: Vec<&'static str>,
}

/// The physical effects that a calibration may have.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Effects {
    /// In the order of the registry.
    pub effects: Vec<Effect>,
}

impl Document for Effects {
    const KIND: &'static str = "effects/1";
}

/// The physical effects that a calibration may have.
#[must_use]
pub fn effects() -> Effects {
    let parameter = |p: &effects::Parameter| Parameter {
        key: p.key,
        unit: p.unit.symbol(),
        prior_sigma: p.prior_sigma,
    };
    let effect = |kind: &effects::Kind| {
        let d = kind.definition();
        Effect {
            effect: d.id,
            summary: d.summary,
            equation: d.equation,
            source: d.source,
            site: d.site.iter().map(|s| s.key()).collect(),
            parameters: d.parameters.iter().map(parameter).collect(),
            needs: d.needs.iter().map(|n| n.describe()).collect(),
        }
    };
    Effects {
        effects: REGISTRY.iter().map(effect).collect(),
    }
}

/// A robot language.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Language {
    /// Name in profiles and on the command line.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// File name endings without the dot.
    pub extensions: &'static [&'static str],
    /// What is rewritten.
    pub rewrites: &'static [&'static str],
    /// What is seen and left as it is.
    pub leaves: &'static [&'static str],
    /// What is reported and blocks the file.
    pub refuses: &'static [&'static str],
    /// Ids of the findings that only its programs have.
    pub findings: Vec<&'static str>,
}

/// The robot languages.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Languages {
    /// In the order of the registry.
    pub languages: Vec<Language>,
}

impl Document for Languages {
    const KIND: &'static str = "languages/1";
}

/// The robot languages: what is rewritten, left alone, refused.
#[must_use]
pub fn languages() -> Languages {
    let language = |language: &&dyn crate::program::Language| {
        let a = language.about();
        Language {
            id: a.id,
            name: a.name,
            extensions: a.extensions,
            rewrites: a.rewrites,
            leaves: a.leaves,
            refuses: a.refuses,
            findings: TABLE
                .iter()
                .filter(|kind| kind.languages.contains(&a.id))
                .map(|kind| kind.id)
                .collect(),
        }
    };
    Languages {
        languages: LANGUAGES.iter().map(language).collect(),
    }
}
