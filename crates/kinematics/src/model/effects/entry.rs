//! An effect as an entry of a profile: `{effect: ID, joint: 2, rad_per_n_m: 3.2e-5}`.

use super::definition::{Definition, LETTERS, MOST_PERIOD_MM, Parameter, SiteKey, Unit};
use super::{BASE, Effect, Kind, MOST_PARAMETERS, REGISTRY, Site};
use crate::nearest;
use serde_json::{Map, Value, json};

/// What is wrong with an entry, and which of its keys is to blame.
#[derive(Debug, thiserror::Error, Clone, PartialEq)]
pub enum EntryError {
    /// There is no `effect` key.
    #[error("an entry of effects has no key `effect`")]
    NoEffect,
    /// No effect has this name.
    #[error("no effect is called `{id}`")]
    UnknownEffect {
        /// The name.
        id: String,
    },
    /// The effect has no such key.
    #[error("`{id}` has no key `{key}`")]
    UnknownKey {
        /// The effect.
        id: &'static str,
        /// The key.
        key: String,
    },
    /// A key the effect cannot do without.
    #[error("`{id}` needs the key `{key}`")]
    MissingKey {
        /// The effect.
        id: &'static str,
        /// The key.
        key: &'static str,
    },
    /// A value of the wrong kind.
    #[error("`{key}` of `{id}` is {found}; it must be {expected}")]
    BadValue {
        /// The effect.
        id: &'static str,
        /// The key.
        key: String,
        /// What stands there.
        found: String,
        /// What belongs there.
        expected: String,
    },
    /// A joint on which its own motion leaks.
    #[error("`{id}` couples joint {joint} on itself")]
    SameJoint {
        /// The effect.
        id: &'static str,
        /// The joint, from 1.
        joint: usize,
    },
}

impl EntryError {
    /// The key to point at; `None` is the whole entry.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::NoEffect | Self::MissingKey { .. } => None,
            Self::UnknownEffect { .. } => Some("effect"),
            Self::UnknownKey { key, .. } | Self::BadValue { key, .. } => Some(key),
            Self::SameJoint { .. } => Some(SiteKey::On.key()),
        }
    }

    /// The way out.
    #[must_use]
    #[allow(clippy::missing_panics_doc)]
    pub fn hint(&self) -> String {
        match self {
            Self::NoEffect => nearest::hint("", "effects", ids()),
            Self::UnknownEffect { id } => nearest::hint(id, "effects", ids()),
            Self::UnknownKey { id, .. } | Self::MissingKey { id, .. } => {
                let kind = Kind::by_id(id).expect("the name came from the registry");
                let meant = match self {
                    Self::UnknownKey { key, .. } => key,
                    _ => "",
                };
                nearest::hint(meant, &format!("keys of `{id}`"), keys(kind.definition()))
            }
            Self::BadValue { .. } | Self::SameJoint { .. } => {
                "`poseshift effects` lists every key with its unit".into()
            }
        }
    }
}

/// Angles above this, degrees, lengths above this, mm, and compliances from this on, rad/(N m), are
/// none of an arm's errors.
const MOST_DEG: f64 = 2.0;
const MOST_MM: f64 = 20.0;
const MOST_RAD_PER_N_M: f64 = 5e-3;
/// And centres of gravity farther away, mm, are on no tool.
const MOST_COG_MM: f64 = 2000.0;
/// What units cost in digits.
const ROUNDED: f64 = 1e-12;

/// The largest value of a parameter that a profile takes without a reason; `None` where any is.
fn usual_limit(kind: Kind, parameter: &Parameter) -> Option<f64> {
    let own = kind.largest().iter().find(|(key, _)| *key == parameter.key);
    if let Some((_, largest)) = own {
        return Some(*largest);
    }
    match parameter.unit {
        Unit::Degree => Some(MOST_DEG),
        // where a load has its centre is no error of the arm
        Unit::Millimetre if parameter.key.starts_with("cog_") => Some(MOST_COG_MM),
        Unit::Millimetre => Some(MOST_MM),
        Unit::RadPerNm => Some(MOST_RAD_PER_N_M),
        _ => None,
    }
}

fn ids() -> impl Iterator<Item = &'static str> {
    REGISTRY.iter().map(|kind| kind.definition().id)
}

fn keys(definition: &Definition) -> impl Iterator<Item = &'static str> {
    let places = definition.site.iter().map(|place| place.key());
    places.chain(definition.parameters.iter().map(|parameter| parameter.key))
}

/// Whether an entry may leave out this parameter (it is then zero): an effect's only parameter may
/// not be left out.
fn optional(definition: &Definition) -> bool {
    definition.parameters.len() > 1
}

impl Effect {
    /// Reads an entry's keys and values.
    ///
    /// # Errors
    /// An unknown effect, an unknown or missing key, a value of the wrong kind, out of range or not
    /// finite.
    pub fn from_entry(entry: &Map<String, Value>) -> Result<Self, EntryError> {
        let id = entry.get("effect").ok_or(EntryError::NoEffect)?;
        let kind = id
            .as_str()
            .and_then(Kind::by_id)
            .ok_or_else(|| EntryError::UnknownEffect { id: plain(id) })?;
        let definition = kind.definition();
        let known = |key: &String| key == "effect" || keys(definition).any(|k| k == key);
        if let Some(key) = entry.keys().find(|key| !known(key)) {
            return Err(EntryError::UnknownKey {
                id: definition.id,
                key: key.clone(),
            });
        }
        let mut site = Site::default();
        for place in definition.site {
            let value = entry.get(place.key());
            match (place, value) {
                (SiteKey::Tool, None) => {}
                (SiteKey::JointOrBase, None) => site.index = BASE,
                (_, None) => {
                    return Err(EntryError::MissingKey {
                        id: definition.id,
                        key: place.key(),
                    });
                }
                (SiteKey::Tool, Some(value)) => site.tool = Some(name(definition, *place, value)?),
                (
                    SiteKey::Link
                    | SiteKey::Joint
                    | SiteKey::JointOrBase
                    | SiteKey::Axis
                    | SiteKey::Point,
                    Some(value),
                ) => {
                    site.index = whole(definition, *place, value)? as usize - 1;
                }
                (SiteKey::On, Some(value)) => {
                    site.on = whole(definition, *place, value)? as usize - 1;
                }
                (SiteKey::Order, Some(value)) => site.order = order(definition, value)?,
                (SiteKey::Row | SiteKey::Degree(..), Some(value)) => {
                    site.order = whole(definition, *place, value)?;
                }
                (SiteKey::Along(letters) | SiteKey::About(letters), Some(value)) => {
                    site.on = letter(definition, *place, letters, value)?;
                }
                (SiteKey::Period, Some(value)) => {
                    site.order = micrometres(definition, *place, value)?;
                }
            }
        }
        if definition.site.contains(&SiteKey::On) && site.index == site.on {
            return Err(EntryError::SameJoint {
                id: definition.id,
                joint: site.index + 1,
            });
        }
        let mut parameters = [0.0; MOST_PARAMETERS];
        for (slot, parameter) in parameters.iter_mut().zip(definition.parameters) {
            match entry.get(parameter.key) {
                Some(value) => {
                    *slot = number(definition, parameter, value)? * parameter.unit.in_si();
                }
                None if optional(definition) => {}
                None => {
                    return Err(EntryError::MissingKey {
                        id: definition.id,
                        key: parameter.key,
                    });
                }
            }
        }
        Ok(Self {
            kind,
            site,
            parameters,
        })
    }

    /// The entry's keys and values in the order of the definition; parameters that are zero and may
    /// be left out are.
    #[must_use]
    pub fn to_entry(&self) -> Vec<(&'static str, Value)> {
        let definition = self.definition();
        let mut entry = vec![("effect", json!(definition.id))];
        for place in definition.site {
            match place {
                SiteKey::JointOrBase if self.site.index == BASE => {}
                SiteKey::Link
                | SiteKey::Joint
                | SiteKey::JointOrBase
                | SiteKey::Axis
                | SiteKey::Point => {
                    entry.push((place.key(), json!(self.site.index + 1)));
                }
                SiteKey::On => entry.push((place.key(), json!(self.site.on + 1))),
                SiteKey::Order | SiteKey::Row | SiteKey::Degree(..) | SiteKey::Period => {
                    entry.push((place.key(), place.in_files(self.site.order)));
                }
                SiteKey::Along(_) | SiteKey::About(_) => {
                    let on = self.site.on;
                    entry.push((place.key(), json!(LETTERS[on..=on])));
                }
                SiteKey::Tool => entry.extend(
                    self.site
                        .tool
                        .as_ref()
                        .map(|tool| (place.key(), json!(tool))),
                ),
            }
        }
        for (value, parameter) in self.parameters.iter().zip(definition.parameters) {
            if *value != 0.0 || !optional(definition) {
                entry.push((parameter.key, json!(value / parameter.unit.in_si())));
            }
        }
        entry
    }

    /// A parameter beyond what arms usually have, its value and the limit, both in the profile's
    /// unit: a profile has to say that it means it.
    #[must_use]
    pub fn beyond_usual(&self) -> Option<(&'static Parameter, f64, f64)> {
        let parameters = self.parameters.iter().zip(self.definition().parameters);
        parameters
            .filter_map(|(value, parameter)| {
                let limit = usual_limit(self.kind, parameter)?;
                Some((parameter, value / parameter.unit.in_si(), limit))
            })
            .find(|(parameter, value, limit)| {
                let reaches = parameter.unit == Unit::RadPerNm;
                let limit = limit
                    * if reaches {
                        1.0 - ROUNDED
                    } else {
                        1.0 + ROUNDED
                    };
                if reaches {
                    value.abs() >= limit
                } else {
                    value.abs() > limit
                }
            })
    }

    /// What it is and belongs to, in words: `joint_harmonic joint 6 order 2`.
    #[must_use]
    pub fn label(&self) -> String {
        let definition = self.definition();
        let count = 1 + definition.site.len();
        let words = self.to_entry().into_iter().take(count).filter(|(key, _)| {
            keys(definition).all(|k| k != *key) || definition.site.iter().any(|p| p.key() == *key)
        });
        words
            .map(|(key, value)| {
                if key == "effect" {
                    plain(&value)
                } else {
                    format!("{key} {}", plain(&value))
                }
            })
            .collect::<Vec<_>>()
            .join(" ")
    }

    /// Whether two entries are the same effect of the same place.
    #[must_use]
    pub fn same_place(&self, other: &Self) -> bool {
        let (mine, others) = (&self.site, &other.site);
        let same = |place: &SiteKey| match place {
            SiteKey::Link
            | SiteKey::Joint
            | SiteKey::JointOrBase
            | SiteKey::Axis
            | SiteKey::Point => mine.index == others.index,
            SiteKey::On | SiteKey::Along(_) | SiteKey::About(_) => mine.on == others.on,
            SiteKey::Order | SiteKey::Row | SiteKey::Degree(..) | SiteKey::Period => {
                mine.order == others.order
            }
            SiteKey::Tool => mine.tool == others.tool,
        };
        self.kind == other.kind && self.definition().site.iter().all(same)
    }
}

fn plain(value: &Value) -> String {
    value
        .as_str()
        .map_or_else(|| value.to_string(), str::to_owned)
}

fn bad(definition: &Definition, key: &str, found: &Value, expected: String) -> EntryError {
    EntryError::BadValue {
        id: definition.id,
        key: key.into(),
        found: plain(found),
        expected,
    }
}

fn name(definition: &Definition, place: SiteKey, value: &Value) -> Result<String, EntryError> {
    let text = value.as_str().filter(|text| !text.is_empty());
    text.map(str::to_owned)
        .ok_or_else(|| bad(definition, place.key(), value, "a name".into()))
}

fn whole(definition: &Definition, place: SiteKey, value: &Value) -> Result<u32, EntryError> {
    let (low, high) = place.range().expect("a place that is counted");
    let number = value
        .as_u64()
        .and_then(|n| u32::try_from(n).ok())
        .filter(|n| (low..=high).contains(n));
    number.ok_or_else(|| {
        bad(
            definition,
            place.key(),
            value,
            format!("a whole number from {low} to {high}"),
        )
    })
}

fn order(definition: &Definition, value: &Value) -> Result<u32, EntryError> {
    let place = SiteKey::Order;
    let number = value
        .as_f64()
        .and_then(|n| place.from_files(&n.to_string()));
    number.ok_or_else(|| {
        bad(
            definition,
            place.key(),
            value,
            "a number from 0.5 to 1000, to three decimals".into(),
        )
    })
}

/// The number of a direction.
fn letter(
    definition: &Definition,
    place: SiteKey,
    letters: &str,
    value: &Value,
) -> Result<usize, EntryError> {
    // to YAML a bare y is true
    let text = value
        .as_bool()
        .map_or(value.as_str(), |yes| yes.then_some("y"));
    let found = text.filter(|text| text.len() == 1);
    let found = found.filter(|text| letters.contains(*text));
    found.and_then(|text| LETTERS.find(text)).ok_or_else(|| {
        let one_of: Vec<String> = letters.chars().map(String::from).collect();
        bad(
            definition,
            place.key(),
            value,
            format!("one of {}", one_of.join(", ")),
        )
    })
}

/// A period in whole micrometres: what belongs to one place is compared exactly.
fn micrometres(definition: &Definition, place: SiteKey, value: &Value) -> Result<u32, EntryError> {
    let mm = value
        .as_f64()
        .filter(|mm| (0.001..=f64::from(MOST_PERIOD_MM)).contains(mm));
    let whole = mm.map(|mm| (mm * 1000.0).round());
    let exact = whole
        .zip(mm)
        .filter(|(um, mm)| (um / 1000.0 - mm).abs() < 1e-9 * mm);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    exact.map(|(um, _)| um as u32).ok_or_else(|| {
        let expected =
            format!("a length from 0.001 to {MOST_PERIOD_MM} mm with at most three decimals");
        bad(definition, place.key(), value, expected)
    })
}

fn number(
    definition: &Definition,
    parameter: &Parameter,
    value: &Value,
) -> Result<f64, EntryError> {
    let is_time = parameter.unit == Unit::Second;
    let number = value.as_f64().filter(|n| n.is_finite());
    number.filter(|n| !is_time || *n > 0.0).ok_or_else(|| {
        let above = if is_time { " above 0" } else { "" };
        let expected = format!("a finite number{above} in {}", parameter.unit.symbol());
        bad(definition, parameter.key, value, expected)
    })
}

/// The JSON Schema of one entry, from the registry.
#[must_use]
pub fn entry_schema() -> Value {
    let one = |definition: &Definition| {
        let mut properties =
            Map::from_iter([("effect".to_owned(), json!({"const": definition.id}))]);
        let mut required = vec!["effect"];
        for place in definition.site {
            let schema = match (place, place.range(), place.letters()) {
                (_, Some((low, high)), _) => {
                    json!({
                        "type": if place.one() == 1 { "integer" } else { "number" },
                        "minimum": place.in_files(low),
                        "maximum": place.in_files(high),
                    })
                }
                (_, _, Some(letters)) => {
                    json!({"enum": letters.chars().map(String::from).collect::<Vec<_>>()})
                }
                _ => json!({"type": "string"}),
            };
            properties.insert(place.key().into(), schema);
            if !place.optional() {
                required.push(place.key());
            }
        }
        for parameter in definition.parameters {
            let schema = if parameter.unit == Unit::Second {
                json!({"type": "number", "exclusiveMinimum": 0})
            } else {
                json!({"type": "number"})
            };
            properties.insert(parameter.key.into(), schema);
            if !optional(definition) {
                required.push(parameter.key);
            }
        }
        properties.insert("large".into(), json!({"type": "boolean"}));
        properties.insert("reason".into(), json!({"type": "string", "minLength": 1}));
        json!({
            "title": definition.id,
            "description": definition.summary,
            "type": "object",
            "properties": properties,
            "required": required,
            "additionalProperties": false,
        })
    };
    let of_robot = REGISTRY.iter().map(|kind| kind.definition());
    let of_robot = of_robot.filter(|definition| !definition.of_data);
    json!({"oneOf": of_robot.map(one).collect::<Vec<_>>()})
}
