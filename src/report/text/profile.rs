//! The texts of `profile`.

use crate::printable::printable;
use crate::report::Style;
use crate::task::profile::{
    Changed, Deviation, Diff, Difference, Exported, Facts, FromUrdf, Imported, NewProfile,
};
use std::collections::BTreeMap;

pub(super) fn new(found: &NewProfile, _: Style) -> String {
    let Some(path) = &found.output else {
        return found.profile.clone().unwrap_or_default();
    };
    let mut text: String = found.notes.iter().map(|note| format!("{note}\n")).collect();
    text += &format!("written to {path}; set the serial number, the base and the tools\n");
    text
}

pub(super) fn from_urdf(found: &FromUrdf, _: Style) -> String {
    let Some(path) = &found.output else {
        return found.profile.clone();
    };
    let mut text = format!(
        "{}: {} to {}, the same as the URDF at 1000 postures\ninverse: {}\n",
        found.robot, found.base, found.tip, found.inverse
    );
    text.extend(found.notes.iter().map(|note| format!("note: {note}\n")));
    text + &format!("written to {path}\n")
}

pub(super) fn imported(found: &Imported, _: Style) -> String {
    let d = &found.deviation;
    format!(
        "written to {}: the controller's chain is {} the nominal one over {} random postures\n",
        found.output,
        apart(d, 3),
        d.postures
    )
}

/// How far two tools are from one another, in words that go on with the other.
fn apart(d: &Deviation, decimals: usize) -> String {
    let [mean, most] = [d.mean_mm, d.max_mm];
    if mean.is_finite() && most.is_finite() {
        format!("{mean:.decimals$} mm (mean), at most {most:.decimals$} mm, from")
    } else {
        "at no finite distance (a value of the profile is beyond any arm) from".into()
    }
}

pub(super) fn facts(found: &Facts, _: Style) -> String {
    let [robot, serial, language] = found.robot.each_ref().map(Option::as_deref);
    let mut text = format!(
        "{}, serial {}\ncontroller: {}, {}\ninverse: {}\n\njoints\n",
        printable(robot.unwrap_or_default()),
        printable(serial.unwrap_or("not given")),
        language.unwrap_or("language not given"),
        found.controller,
        found.inverse
    );
    for (title, key) in [
        ("", "joint "),
        ("couplings", "coupling "),
        ("bodies", "body "),
        ("external axes", "external axis "),
        ("tools", "tool "),
        ("points", "point "),
        (
            "effects in the controller's own chain",
            "controller effect ",
        ),
        ("effects", "effect "),
    ] {
        let rows = found
            .ordered
            .iter()
            .filter(|(name, _)| name.starts_with(key));
        let mut rows = rows.peekable();
        if !title.is_empty() && rows.peek().is_some() {
            text += &format!("\n{title}\n");
        }
        for (name, value) in rows {
            let short = name.strip_prefix(key).unwrap_or(name);
            let value = if key == "effect " {
                with_sigmas(short, value, &found.sigmas)
            } else {
                value.clone()
            };
            text += &format!("  {short}  {}\n", glued(name, &value));
        }
    }
    if !found.worth.is_empty() {
        text += "\ncalibration\n";
        let lines = found.worth.iter().map(|line| with_short_hashes(line));
        text.extend(lines.map(|line| format!("  {line}\n")));
    }
    if found.is_calibrated {
        let d = &found.deviation;
        text += &format!(
            "\nthe real tool is {} the controller's over {} random postures\n",
            apart(d, 3),
            d.postures
        );
    } else {
        text += "\nno calibration: compensation changes nothing\n";
    }
    text
}

pub(super) fn changed(found: &Changed, _: Style) -> String {
    let mut text = differences(&found.differences);
    text.extend(found.notes.iter().map(|note| format!("note: {note}\n")));
    text + &format!("written to {}\n", found.output)
}

pub(super) fn exported(found: &Exported, _: Style) -> String {
    if let Some(text) = &found.text {
        return text.clone();
    }
    let mut text = String::new();
    text.extend(
        found
            .not_carried
            .iter()
            .map(|what| format!("not in it: {what}\n")),
    );
    let d = &found.deviation;
    text += &format!(
        "the real tool is {} where it has it, over {} postures\n",
        apart(d, 4),
        d.postures
    );
    if let Some(path) = &found.output {
        text += &format!("written to {path}\n");
    }
    text
}

pub(super) fn diff(found: &Diff, _: Style) -> String {
    differences(&found.differences)
}

fn differences(found: &[Difference]) -> String {
    let mut text = String::new();
    for difference in found {
        let key = &difference.key;
        let line = |sign: char, value: &String| format!("  {sign} {}\n", glued(key, value));
        text += &format!("{key}\n");
        text.extend(difference.a.as_ref().map(|value| line('-', value)));
        text.extend(difference.b.as_ref().map(|value| line('+', value)));
    }
    text
}

/// Values of an effect with their standard deviations where these are known: `a_mm 0.134 ± 0.003`.
fn with_sigmas(effect: &str, values: &str, sigmas: &BTreeMap<String, f64>) -> String {
    let words: Vec<&str> = values.split(' ').collect();
    let pairs = words.chunks(2).map(|pair| {
        let sigma = sigmas.get(&format!("{effect} {}", pair[0]));
        let sigma = sigma.map_or_else(String::new, |sigma| format!(" ± {sigma:.2e}"));
        pair.join(" ") + &sigma
    });
    pairs.collect::<Vec<_>>().join("  ")
}

/// A line in which hashes show their first digits; `--json` has them whole.
fn with_short_hashes(line: &str) -> String {
    let short = |word: &str| {
        let is_hash = word.len() == 64 && word.bytes().all(|b| b.is_ascii_hexdigit());
        if is_hash {
            format!("{}\u{2026}", &word[..16])
        } else {
            word.to_owned()
        }
    };
    let words: Vec<String> = line.split(' ').map(short).collect();
    words.join(" ")
}

/// A fact that is names and numbers in alternation, so that a line breaks before a name only.
fn glued(name: &str, value: &str) -> String {
    if !(name.starts_with("joint ") || name.contains("effect ")) {
        return value.to_owned();
    }
    let words: Vec<&str> = value.split(' ').collect();
    let pairs: Vec<String> = words.chunks(2).map(|pair| pair.join("\u{a0}")).collect();
    pairs.join(" ")
}
