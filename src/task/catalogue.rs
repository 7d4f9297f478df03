//! `robots`, `effects`, `languages`: what is built in.

use super::Document;
use crate::finding::TABLE;
use crate::inverse::Arm;
use crate::model::effects::{self, REGISTRY};
use crate::model::profile::{Mounted, Profile, SHIPPED};
use crate::program::LANGUAGES;
use schemars::JsonSchema;
use serde::Serialize;

/// A robot whose profile is built in.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Robot {
    /// Its name here.
    pub name: &'static str,
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

/// The robots whose profiles are built in.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Robots {
    /// By name.
    pub robots: Vec<Robot>,
}

impl Document for Robots {
    const KIND: &'static str = "robots/1";
}

/// The robots whose profiles are built in.
///
/// # Panics
/// Never: the profiles are part of the program, and tested.
#[must_use]
pub fn robots() -> Robots {
    let robot = |(name, text): &(&'static str, &str)| {
        let profile = Profile::from_yaml(text).expect("shipped profiles are tested");
        let arm = Arm::of(&profile.geometry(&Mounted::flange()), &profile.mechanism);
        Robot {
            name,
            closed_form_inverse: arm.map_or("none", |arm| arm.kind()),
            effects: profile.effects.len(),
            manufacturer: profile.manufacturer,
            model: profile.model,
            language: profile.language,
        }
    };
    Robots {
        robots: SHIPPED.iter().map(robot).collect(),
    }
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
