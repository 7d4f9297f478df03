//! Programs that drive to measuring configurations, every gearbox arriving from below so that
//! backlash shows on one side.
//!
//! # Source
//! A. Nubiola, thesis, sec. 2.5: each configuration is approached from 5° less on every joint, which
//! on his arm are the gearboxes.

use crate::program::{LANGUAGES, Language, Settings, Step};

/// A configuration and the poses that the arm goes over before it comes to where it is approached
/// from; joints in radians.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stop {
    /// What it goes over.
    pub over: Vec<[f64; 6]>,
    /// Where it is approached from.
    pub from: [f64; 6],
    /// Where it is measured.
    pub q: [f64; 6],
}

/// The moves of all configurations: what they go over, where they are approached from, the
/// configuration.
fn steps(stops: &[Stop]) -> Vec<Step> {
    let mut steps = Vec::new();
    for (i, stop) in stops.iter().enumerate() {
        let places = stop.over.iter().chain([&stop.from, &stop.q]);
        let last = stop.over.len() + 1;
        steps.extend(places.enumerate().map(|(k, q)| Step {
            begins: (k == 0).then_some(i + 1),
            q: *q,
            measured: k == last,
        }));
    }
    steps
}

/// The program's text; `None` in a language that cannot be written, and in INFORM without pulses.
#[must_use]
pub(super) fn program(language: &str, stops: &[Stop], settings: &Settings) -> Option<String> {
    let language = LANGUAGES
        .iter()
        .find(|known| known.about().id == language)?;
    language.drive(&steps(stops), settings)
}

/// Languages that a program can be written in.
#[must_use]
pub(super) fn languages(settings: &Settings) -> Vec<&'static str> {
    let writes = |language: &&&dyn Language| language.drive(&[], settings).is_some();
    LANGUAGES
        .iter()
        .filter(writes)
        .map(|language| language.about().id)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::units::DEG;

    #[test]
    fn every_configuration_is_reached_from_below() {
        let q = [0.0, 0.1, -0.2, 0.3, 0.4, -0.5];
        let stops = [Stop {
            over: vec![[0.5; 6]],
            from: q.map(|angle| angle - 5.0 * DEG),
            q,
        }];
        let settings = Settings {
            pulses_per_deg: Some([1000.0, -1000.0, 1000.0, 1000.0, 1000.0, 1000.0]),
            ..Settings::default()
        };
        assert_eq!(
            languages(&settings),
            [
                "rapid", "krl", "fanuc", "urscript", "inform", "val3", "kawasaki"
            ]
        );
        for language in languages(&settings) {
            let text = program(language, &stops, &settings).expect("a language of the list");
            let [over, first, at, last] = match language {
                "fanuc" => ["28.648", "-5.000", "0.000", "22.918"],
                // joint 2 counts in the other direction: 0.1 rad
                "inform" => ["28648,-28648", "-5000,-730,", "0,-5730,", "22918"],
                _ => ["28.6479", "-5.0000", "0.0000", "22.9183"],
            };
            let between = text.find(over).expect("the pose between");
            let before = text.find(first).expect("the approach");
            assert!(
                between < before && text[before + 1..].contains(at) && text.contains(last),
                "{language}: {text}"
            );
        }
        let no_pulses = Settings::default();
        assert!(program("cobol", &stops, &no_pulses).is_none());
        assert!(program("inform", &stops, &no_pulses).is_none());
    }
}
