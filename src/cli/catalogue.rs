//! `robots`, `effects`, `languages`: what is built in.

use super::failure::Failure;
use super::layout::print_text;
use super::{Answer, Output, print_json};
use crate::model::effects::REGISTRY;
use crate::model::profile::{Mounted, Profile, SHIPPED};
use crate::program::LANGUAGES;
use clap::Args;
use serde_json::json;

/// List the robots whose profiles are built in
#[derive(Args)]
pub struct Robots {}

/// List the physical effects that a calibration may have, with their keys and units
#[derive(Args)]
pub struct Effects {}

/// List the robot languages: what is rewritten, left alone, refused
#[derive(Args)]
pub struct Languages {}

impl Robots {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let robots: Vec<_> = SHIPPED
            .iter()
            .map(|(name, text)| {
                let profile = Profile::from_yaml(text).expect("shipped profiles are tested");
                let geometry = profile.geometry(&Mounted::flange());
                let inverse = crate::inverse::Arm::of(&geometry, &profile.mechanism);
                (name, profile, inverse.map_or("none", |arm| arm.kind()))
            })
            .collect();
        if output.json {
            let rows: Vec<_> = robots
                .iter()
                .map(|(name, p, inverse)| {
                    json!({"name": name, "manufacturer": p.manufacturer, "model": p.model, "language": p.language,
                           "closed_form_inverse": inverse, "effects": p.effects.len()})
                })
                .collect();
            print_json(&json!({"poseshift": "robots/1", "robots": rows}))?;
        } else {
            let mut text = String::new();
            for (name, p, inverse) in &robots {
                let calibrated = if p.effects.is_empty() {
                    ""
                } else {
                    ", calibrated"
                };
                text += &format!(
                    "{name:24} {} {} ({inverse}{calibrated})\n",
                    p.manufacturer, p.model
                );
            }
            text += "`poseshift profile new --robot NAME` starts a profile from one of them\n";
            print_text(&text)?;
        }
        Ok(Answer::Yes)
    }
}

impl Effects {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let definitions = REGISTRY.iter().map(|kind| kind.definition());
        if output.json {
            let rows: Vec<_> = definitions
                .map(|d| {
                    let parameters: Vec<_> = d
                        .parameters
                        .iter()
                        .map(|p| json!({"key": p.key, "unit": p.unit.symbol(), "prior_sigma": p.prior_sigma}))
                        .collect();
                    json!({"effect": d.id, "summary": d.summary, "equation": d.equation, "source": d.source,
                           "site": d.site.iter().map(|s| s.key()).collect::<Vec<_>>(), "parameters": parameters,
                           "needs": d.needs.iter().map(|n| n.describe()).collect::<Vec<_>>()})
                })
                .collect();
            print_json(&json!({"poseshift": "effects/1", "effects": rows}))?;
        } else {
            let mut text = String::new();
            for d in definitions {
                let site: String = d.site.iter().map(|s| format!("{}, ", s.key())).collect();
                let keys: Vec<_> = d.parameters.iter().map(|p| p.key).collect();
                text += &format!(
                    "{}\n  {}\n  keys: {site}{}\n  {}\n",
                    d.id,
                    d.summary,
                    keys.join(", "),
                    d.equation
                );
                for need in d.needs {
                    text += &format!("  needs {}\n", need.describe());
                }
                text += &format!("  source: {}\n\n", d.source);
            }
            print_text(&text)?;
        }
        Ok(Answer::Yes)
    }
}

impl Languages {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        let abouts = LANGUAGES.iter().map(|language| language.about());
        if output.json {
            let rows: Vec<_> = abouts
                .map(|a| {
                    json!({"id": a.id, "name": a.name, "extensions": a.extensions, "rewrites": a.rewrites,
                           "leaves": a.leaves, "refuses": a.refuses})
                })
                .collect();
            print_json(&json!({"poseshift": "languages/1", "languages": rows}))?;
        } else {
            let mut text = String::new();
            for a in abouts {
                text += &format!("{}  {} (.{})\n", a.id, a.name, a.extensions.join(" ."));
                for (what, items) in [
                    ("rewrites", a.rewrites),
                    ("leaves", a.leaves),
                    ("refuses", a.refuses),
                ] {
                    text += &format!("  {what}\n");
                    text.extend(items.iter().map(|item| format!("    {item}\n")));
                }
            }
            print_text(&text)?;
        }
        Ok(Answer::Yes)
    }
}
