//! Parameters by the words of the command line.

use super::error::SelectionError;
use crate::model::effects::{Effect, Kind, MOST_PARAMETERS, REGISTRY, Site, SiteKey, Unit};
use crate::profile::{Profile, is_of_profile};

/// The number that the base has among joints.
const BASE_NUMBER: u32 = 7;
/// And its word.
const BASE_WORD: &str = "base";

/// Parameters by the words of the command line: `link_geometry`, `joint_compliance:2-6`,
/// `joint_harmonic:6:2`, `link_geometry:3.beta_deg`, `track_straightness:1:y:2-4`, `points`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pick {
    /// The effect; none are the measured points.
    pub kind: Option<Kind>,
    /// First and last number of each place the effect has, from 1, as far as given.
    pub places: Vec<(u32, u32)>,
    /// One parameter alone.
    pub key: Option<&'static str>,
    /// It is one of several that a word means together: what the data hardly tell of it is left as
    /// it is.
    pub together: bool,
}

/// The word for what is wrong with a track.
const TRACK: &str = "track";

/// The word for what is wrong with a positioner.
const POSITIONER: &str = "positioner";
/// What it means: the axes and how far they go; along them the first order, across them the second,
/// since the first is where the plate is.
const OF_POSITIONER: [&str; 5] = [
    "positioner_axis",
    "positioner_scale",
    "positioner_runout:1-12:z:1",
    "positioner_runout:1-12:x-y:2",
    "positioner_ripple:1-12:1-2",
];

/// Words that are meant together.
fn together(words: &[&str]) -> Vec<Pick> {
    let words = words.iter().map(|word| Pick {
        together: true,
        ..Pick::parse(word).expect("words of effects")
    });
    words.collect()
}

impl Pick {
    /// What is wrong with a positioner, as far as points on its plate usually tell it.
    ///
    /// # Panics
    /// Never: the words are ours.
    #[must_use]
    pub fn positioner() -> Vec<Self> {
        together(&OF_POSITIONER)
    }

    /// What is wrong with a track, as far as measurements usually tell it.
    #[must_use]
    pub fn track() -> Vec<Self> {
        Self::track_to(0)
    }

    /// So many degrees there are at most beyond those that a rail of some metres usually has.
    pub(super) const MOST_MORE_OF_TRACK: u32 = 3;

    /// The same in every direction, so many degrees beyond those that a rail of some metres usually
    /// has.
    ///
    /// # Panics
    /// Never: the words are ours.
    #[must_use]
    pub(super) fn track_to(more: u32) -> Vec<Self> {
        let straightness = format!("track_straightness:1-12:y-z:2-{}", 3 + more.min(3));
        let rotation = format!("track_rotation:1-12:x-z:1-{}", 2 + more.min(2));
        together(&["track_scale", "track_direction", &straightness, &rotation])
    }

    /// Reads one word.
    ///
    /// # Errors
    /// An unknown effect or key, too many places, a number out of range.
    #[allow(
        clippy::missing_panics_doc,
        reason = "what is expected holds by construction"
    )]
    pub fn parse(text: &str) -> Result<Self, SelectionError> {
        // an order may have decimals, a key begins with a letter
        let is_key = |(at, _): &(usize, &str)| {
            let rest = &text[at + 1..];
            !rest.starts_with(|c: char| c.is_ascii_digit())
        };
        let (head, key) = match text.match_indices('.').find(is_key) {
            Some((at, _)) => (&text[..at], Some(&text[at + 1..])),
            None => (text, None),
        };
        let mut words = head.split(':');
        let id = words.next().unwrap_or_default();
        if id == "points" && head == id && key.is_none() {
            return Ok(Self {
                kind: None,
                places: Vec::new(),
                key: None,
                together: false,
            });
        }
        let kind =
            Kind::by_id(id).ok_or_else(|| SelectionError::UnknownEffect { id: id.into() })?;
        let definition = kind.definition();
        let counted: Vec<SiteKey> = definition
            .site
            .iter()
            .copied()
            .filter(|place| place.numbers().is_some())
            .collect();
        let mut places = Vec::new();
        for word in words {
            let bad = |expected: String| SelectionError::BadPlace {
                id: definition.id,
                found: word.into(),
                expected,
            };
            let place = counted
                .get(places.len())
                .ok_or_else(|| bad("no more numbers".into()))?;
            let (low, high) = place.numbers().expect("a counted place");
            let (first, last) = word.split_once('-').unwrap_or((word, word));
            let parsed = place.from_word(first).zip(place.from_word(last));
            let range = parsed.filter(|(a, b)| a <= b);
            let is_base = *place == SiteKey::JointOrBase && word == BASE_WORD;
            let range = range.or(is_base.then_some((BASE_NUMBER, BASE_NUMBER)));
            let name = place.key();
            places.push(range.ok_or_else(|| {
                let (low, high) = (place.in_word(low), place.in_word(high));
                bad(format!("{name}: a number or range from {low} to {high}"))
            })?);
        }
        if counted.contains(&SiteKey::Period) && places.len() < counted.len() {
            return Err(SelectionError::BadPlace {
                id: definition.id,
                found: head.into(),
                expected: "axis, direction and period in mm: track_ripple:1:x:25".into(),
            });
        }
        let key = match key {
            None => None,
            Some(key) => {
                let found = definition.parameters.iter().find(|p| p.key == key);
                let found = found.ok_or_else(|| SelectionError::UnknownKey {
                    id: definition.id,
                    key: key.into(),
                });
                Some(found?.key)
            }
        };
        Ok(Self {
            kind: Some(kind),
            places,
            key,
            together: false,
        })
    }

    /// The word that means this effect: `joint_harmonic:6:2`.
    #[must_use]
    pub fn word(effect: &Effect) -> String {
        let definition = effect.definition();
        let places = definition.site.iter();
        let words = places.filter_map(|place| {
            let number = number(effect, *place)?;
            Some(match place {
                SiteKey::JointOrBase if number == BASE_NUMBER => format!(":{BASE_WORD}"),
                _ => format!(":{}", place.in_word(number)),
            })
        });
        definition.id.to_owned() + &words.collect::<String>()
    }

    /// The word that this was read from.
    #[must_use]
    pub fn to_word(&self) -> String {
        let Some(definition) = self.kind.map(Kind::definition) else {
            return "points".to_owned();
        };
        let counted = definition.site.iter().filter(|p| p.numbers().is_some());
        let places = counted.zip(&self.places).map(|(place, (first, last))| {
            let word = |number: u32| match place {
                SiteKey::JointOrBase if number == BASE_NUMBER => BASE_WORD.to_owned(),
                _ => place.in_word(number),
            };
            if first == last {
                format!(":{}", word(*first))
            } else {
                format!(":{}-{}", word(*first), word(*last))
            }
        });
        let key = self.key.map(|key| format!(".{key}"));
        definition.id.to_owned() + &places.collect::<String>() + &key.unwrap_or_default()
    }

    /// What means this effect alone.
    #[must_use]
    pub fn of(effect: &Effect) -> Self {
        let places = effect.definition().site.iter();
        let numbers = places.filter_map(|place| number(effect, *place));
        Self {
            kind: Some(effect.kind),
            places: numbers.map(|n| (n, n)).collect(),
            key: None,
            together: false,
        }
    }

    /// Every word of a list separated by commas.
    ///
    /// # Errors
    /// As [`Pick::parse`].
    pub fn parse_list(text: &str) -> Result<Vec<Self>, SelectionError> {
        let words = text.split(',').map(str::trim).filter(|w| !w.is_empty());
        let mut all = Vec::new();
        for word in words {
            match word {
                TRACK => all.extend(Self::track()),
                POSITIONER => all.extend(Self::positioner()),
                word => all.push(Self::parse(word)?),
            }
        }
        Ok(all)
    }

    /// Whether it means the parameter of this key of an effect.
    pub(super) fn holds(&self, effect: &Effect, key: &str) -> bool {
        self.means(effect) && self.key.is_none_or(|k| k == key)
    }

    /// Whether it means an effect, or one of its parameters.
    #[must_use]
    pub fn means(&self, effect: &Effect) -> bool {
        let numbers = effect
            .definition()
            .site
            .iter()
            .filter_map(|p| number(effect, *p));
        self.kind == Some(effect.kind)
            && self
                .places
                .iter()
                .zip(numbers)
                .all(|((a, b), n)| (*a..=*b).contains(&n))
    }

    /// Whether it names one effect, not a range of them.
    pub(super) fn is_of_one(&self) -> bool {
        let site = self.kind.map_or(0, |kind| kind.definition().site.len());
        match self.places.last() {
            Some((low, high)) if self.places.len() == site => low == high,
            _ => false,
        }
    }

    /// Whether an effect that this means may show: of an external axis, that the profile has it,
    /// and that it stood at more places than the effect has numbers. A degree that is named
    /// alone is sought in any case.
    pub(super) fn is_shown(&self, effect: &Effect, profile: &Profile, places: &[usize]) -> bool {
        let site = effect.definition().site;
        if !effect.definition().of_external_axis() {
            return true;
        }
        let by_name = self.is_of_one();
        let is_power = site
            .iter()
            .any(|place| matches!(place, SiteKey::Degree(..)));
        let degree = if is_power { effect.site.order } else { 0 };
        let stood = places.get(effect.site.index).copied().unwrap_or(0);
        is_of_profile(effect, &profile.external) && (by_name || stood >= degree as usize + 2)
    }

    /// The effects this means, as they are begun with.
    #[must_use]
    pub fn effects(&self) -> Vec<Effect> {
        let Some(kind) = self.kind else {
            return Vec::new();
        };
        let mut sites = vec![Site::default()];
        let counted = kind
            .definition()
            .site
            .iter()
            .filter(|p| p.numbers().is_some());
        for (n, place) in counted.enumerate() {
            let default = match place {
                SiteKey::Order | SiteKey::Row | SiteKey::Point => (place.one(), place.one()),
                SiteKey::JointOrBase => (BASE_NUMBER, BASE_NUMBER),
                SiteKey::Link | SiteKey::Joint | SiteKey::On => (1, 6),
                other => other.numbers().unwrap_or_default(),
            };
            let (low, high) = self.places.get(n).copied().unwrap_or(default);
            sites = sites
                .iter()
                .flat_map(|site| {
                    let values = (low..=high).step_by(place.one() as usize);
                    values.map(move |value| with(site, *place, value))
                })
                .collect();
        }
        let on = kind.definition().site.contains(&SiteKey::On);
        sites.retain(|site| !on || site.index != site.on);
        let begun = |site| Effect {
            kind,
            site,
            parameters: first_values(kind),
        };
        sites.into_iter().map(begun).collect()
    }
}

/// What an effect begins with: nothing but a typical time constant, which only shows once there is
/// a drift.
fn first_values(kind: Kind) -> [f64; MOST_PARAMETERS] {
    let mut values = [0.0; MOST_PARAMETERS];
    for (value, parameter) in values.iter_mut().zip(kind.definition().parameters) {
        if matches!(parameter.unit, Unit::Second | Unit::Row) {
            *value = parameter.prior_sigma * parameter.unit.in_si();
        }
    }
    values
}

fn number(effect: &Effect, place: SiteKey) -> Option<u32> {
    let index = match place {
        SiteKey::Link | SiteKey::Joint | SiteKey::JointOrBase | SiteKey::Axis | SiteKey::Point => {
            effect.site.index + 1
        }
        SiteKey::On | SiteKey::Along(_) | SiteKey::About(_) => effect.site.on + 1,
        SiteKey::Order | SiteKey::Row | SiteKey::Degree(..) | SiteKey::Period => {
            return Some(effect.site.order);
        }
        SiteKey::Tool => return None,
    };
    u32::try_from(index).ok()
}

fn with(site: &Site, place: SiteKey, value: u32) -> Site {
    let mut site = site.clone();
    match place {
        SiteKey::Link | SiteKey::Joint | SiteKey::JointOrBase | SiteKey::Axis | SiteKey::Point => {
            site.index = value as usize - 1;
        }
        SiteKey::On | SiteKey::Along(_) | SiteKey::About(_) => site.on = value as usize - 1,
        SiteKey::Order | SiteKey::Row | SiteKey::Degree(..) | SiteKey::Period => {
            site.order = value;
        }
        SiteKey::Tool => {}
    }
    site
}

/// Every word that names parameters on the command line.
#[must_use]
pub fn words() -> Vec<&'static str> {
    let ids = REGISTRY.iter().map(|kind| kind.definition().id);
    ids.chain(["points", TRACK, POSITIONER]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::parameters::at;

    #[test]
    fn words_name_effects_places_and_keys() {
        let pick = Pick::parse("joint_compliance:2-6").expect("a range of joints");
        assert_eq!(pick.effects().len(), 5);
        let pick = Pick::parse("joint_harmonic:6:2").expect("a joint and an order");
        assert_eq!(pick.effects()[0].label(), "joint_harmonic joint 6 order 2");
        for word in [
            "joint_harmonic:6:2",
            "joint_harmonic:1:13.5",
            "joint_harmonic:2:17",
            "warm_up_drift:base",
            "warm_up_drift:6",
            "tool_slip:77",
            "reflector_slip:2:77",
        ] {
            let pick = Pick::parse(word).expect("a word of an effect");
            let effects = pick.effects();
            assert_eq!(effects.len(), 1, "{word}");
            assert_eq!(Pick::word(&effects[0]), word);
            assert!(pick.means(&effects[0]));
        }
        let pick = Pick::parse("link_geometry:3.beta_deg").expect("one key");
        assert!(pick.holds(&at(Kind::LinkGeometry, 2), "beta_deg"));
        assert!(!pick.holds(&at(Kind::LinkGeometry, 2), "a_mm"));
        assert!(!pick.holds(&at(Kind::LinkGeometry, 1), "beta_deg"));
        assert_eq!(
            Pick::parse("joint_coupling").expect("all").effects().len(),
            30
        );
        for bad in [
            "nothing",
            "joint_scale:7",
            "joint_scale:1:1",
            "link_geometry.b_mm",
            "joint_scale:3-2",
            "joint_harmonic:1:0.1",
            "joint_harmonic:1:2.33333",
            "joint_scale:1.5",
            "points:1",
        ] {
            assert!(Pick::parse(bad).is_err(), "{bad}");
        }
    }
}
