//! The effects that were found, each with its evidence.

use crate::diagnose as engine;
use crate::model::effects::Effect as ModelEffect;
use crate::task::parts::{SpreadMm, finite};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value, json};

/// An effect with its place and its parameters in the units of files.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Effect {
    /// Its id `effect`, and its place: `joint`, `link`, `on`, `order`, `row`, `tool`.
    #[serde(flatten)]
    pub head: Map<String, Value>,
    /// Its values by the keys of files.
    pub parameters: Map<String, Value>,
    /// Its name and place for people.
    #[serde(skip)]
    pub label: String,
    /// Key, value and unit of each parameter.
    #[serde(skip)]
    pub values: Vec<(&'static str, f64, &'static str)>,
}

impl Effect {
    /// Its id.
    #[must_use]
    pub fn id(&self) -> &str {
        self.head
            .get("effect")
            .and_then(Value::as_str)
            .unwrap_or_default()
    }
}

impl From<&ModelEffect> for Effect {
    fn from(effect: &ModelEffect) -> Self {
        let definition = effect.definition();
        let (mut head, mut parameters) = (Map::new(), Map::new());
        for (key, value) in effect.to_entry() {
            if definition.parameters.iter().any(|p| p.key == key) {
                parameters.insert(key.into(), value);
            } else {
                head.insert(key.into(), value);
            }
        }
        let known = definition.parameters.iter().zip(effect.parameters);
        Self {
            head,
            parameters,
            label: effect.label(),
            values: known
                .map(|(p, x)| (p.key, x / p.unit.in_si(), p.unit.symbol()))
                .collect(),
        }
    }
}

/// Why an effect is believed.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Evidence {
    /// Fall of chi squared when it is added to the others.
    pub chi_squared_fall: Option<f64>,
    /// Probability of that by chance, times the number of tests made.
    pub p_value: Option<f64>,
    /// Fall of the information criterion.
    pub bic_fall: Option<f64>,
    /// In how many of the parts of the measurements it was found without them.
    pub found_again: usize,
    /// How many parts there are.
    pub found_again_of: usize,
    /// Whether a person asked for it.
    pub accepted_by_hand: bool,
}

/// An effect that was found.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct FoundEffect {
    /// The effect, with the values that the improved profile gets; those of `base_frame` and
    /// `tool_frame` say how the frame moved.
    #[serde(flatten)]
    pub effect: Effect,
    /// Values of the profile, of what was sought; none where it does not have the effect.
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub was: Map<String, Value>,
    /// Standard deviations by the keys of files.
    pub sigma: Map<String, Value>,
    /// Why it is believed.
    pub evidence: Evidence,
    /// Errors on rows not used for its choice, with the effects before it.
    pub before: Option<SpreadMm>,
    /// With it.
    pub after: Option<SpreadMm>,
    /// Whether it is of the session and not of the robot.
    pub of_data: bool,
    /// Whether the improved profile has it, or (of the session) stands where it left the robot.
    pub in_profile: bool,
    /// `certain`, `likely` or `possible`.
    pub standing: &'static str,
    /// What it may be instead, the likeliest first.
    pub against: Vec<Against>,
    /// It in a sentence.
    pub sentence: String,
}

/// An effect of the profile that was fitted anew, frames and geometry with it, and is not what it
/// was; the values are those that came out.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ChangedEffect {
    /// The effect.
    #[serde(flatten)]
    pub effect: Effect,
    /// Values of the profile, of what was fitted, by the keys of files.
    pub was: Map<String, Value>,
    /// Standard deviations of what came out.
    pub sigma: Map<String, Value>,
    /// How far the farthest value is from where it was, in its standard deviations.
    pub times_sigma: Option<f64>,
}

impl ChangedEffect {
    /// Of each parameter its key, the value before and after, and the standard deviation.
    pub fn values(&self) -> impl Iterator<Item = (&str, [Option<f64>; 3])> {
        self.was.iter().map(|(key, was)| {
            let now = self.effect.values.iter().find(|(own, ..)| own == key);
            let sigma = self.sigma.get(key).and_then(Value::as_f64);
            (key.as_str(), [was.as_f64(), now.map(|(_, x, _)| *x), sigma])
        })
    }
}

impl From<&engine::Changed> for ChangedEffect {
    fn from(c: &engine::Changed) -> Self {
        let parameters = c.before.definition().parameters;
        let of_each = |value: &dyn Fn(usize, f64) -> f64| {
            let each = c.sigmas.iter().map(|(number, sigma)| {
                let p = &parameters[*number];
                let value = value(*number, *sigma) / p.unit.in_si();
                (p.key.to_owned(), json!(finite(value)))
            });
            each.collect()
        };
        Self {
            effect: (&c.after).into(),
            was: of_each(&|number, _| c.before.parameters[number]),
            sigma: of_each(&|_, sigma| sigma),
            times_sigma: finite(c.times),
        }
    }
}

/// A sentence with what the profile has in the place of an effect found.
fn changed(f: &engine::Found) -> String {
    let Some(was) = &f.was else {
        return String::new();
    };
    let parameters = f.effect.definition().parameters;
    let each = f.sought.iter().map(|n| {
        let p = &parameters[*n];
        let [before, now] = [was, &f.effect].map(|of| of.parameters[*n] / p.unit.in_si());
        format!("{} {before:.3e}, and {now:.3e} now", p.key)
    });
    let each: Vec<String> = each.collect();
    format!(" The profile has {}.", each.join("; "))
}

/// What may be in the place of an effect found.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Against {
    /// An effect, several, or a function outside the registry.
    pub what: String,
    /// Odds of the effect found against it.
    pub odds: f64,
}

impl From<&engine::Found> for FoundEffect {
    fn from(f: &engine::Found) -> Self {
        let definition = f.effect.definition();
        let sought = f.sought.iter().copied().zip(f.sigmas.iter().copied());
        let sigma = sought.chain(f.listed).map(|(n, s)| {
            let p = &definition.parameters[n];
            (p.key.to_owned(), json!(finite(s / p.unit.in_si())))
        });
        let was = f.was.iter().flat_map(|was| {
            f.sought.iter().map(|n| {
                let p = &definition.parameters[*n];
                let value = was.parameters[*n] / p.unit.in_si();
                (p.key.to_owned(), json!(finite(value)))
            })
        });
        let was: Map<String, Value> = was.collect();
        let (found_again, found_again_of) = f.found_again;
        let profile = match (f.in_profile, definition.of_data) {
            (true, _) => "",
            (false, false) => " It is found again too seldom: the profile is without it.",
            (false, true) => " It is not sure enough: the profile does not follow it.",
        };
        Self {
            effect: (&f.effect).into(),
            sigma: sigma.collect(),
            evidence: Evidence {
                chi_squared_fall: finite(f.gain),
                p_value: finite(f.p_value),
                bic_fall: finite(f.bic),
                found_again,
                found_again_of,
                accepted_by_hand: f.accepted,
            },
            before: f.before.map(Into::into),
            after: f.after.map(Into::into),
            of_data: definition.of_data,
            in_profile: f.in_profile,
            standing: f.standing.id(),
            against: (f.against.iter())
                .map(|a| Against {
                    what: a.what.clone(),
                    odds: a.odds,
                })
                .collect(),
            sentence: f.effect.sentence(&f.seen) + &changed(f) + profile,
            was,
        }
    }
}
