//! A profile's text with another controller, everything else as it was.

use super::Profile;
use super::file::ControllerModel;
use crate::model::effects::Effect;
use crate::model::external::ExternalAxes;
use crate::printable::{flow, quoted};
use std::fmt::Write;

/// The text of a profile with a calibrated controller that has these effects; comments and all
/// other blocks stay.
///
/// `None` where the text does not have `controller` as a block of its own, as in one long line:
/// nothing is guessed.
#[must_use]
pub fn with_controller(
    text: &str,
    profile: &Profile,
    effects: &[Effect],
    note: &str,
) -> Option<String> {
    let (start, end) = block(text, "controller")?;
    let line_end = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let mut lines = vec!["controller:".to_owned()];
    if let Some(language) = &profile.language {
        lines.push(format!("  language: {}", quoted(language)));
    }
    lines.push("  model: calibrated".into());
    if let Some(pulses) = profile.pulses_per_deg {
        lines.push(format!("  pulses_per_deg: {pulses:?}"));
    }
    lines.push(format!("  effects:   # {note}"));
    for effect in effects {
        lines.push(format!("    - {}", entry(effect)));
    }
    let mut new = lines.join(line_end);
    new += line_end;
    let mut out = String::with_capacity(text.len() + new.len());
    out.push_str(&text[..start]);
    out.push_str(&new);
    out.push_str(&text[end..]);
    // the writer above may not know every way in which YAML can be written: what came out must be
    // what was meant
    let meant = Profile {
        controller: ControllerModel::Calibrated,
        own_effects: Some(effects.to_vec()),
        ..profile.clone()
    };
    let written = Profile::from_yaml(&out).ok()?;
    let near = |a: &Effect, b: &Effect| {
        a.same_place(b)
            && a.parameters
                .iter()
                .zip(b.parameters)
                .all(|(a, b)| (a - b).abs() <= 1e-15 * a.abs().max(1.0))
    };
    let own = written.own_effects.clone().unwrap_or_default();
    let same = own.len() == effects.len() && own.iter().zip(effects).all(|(a, b)| near(a, b));
    let rest = Profile {
        own_effects: meant.own_effects.clone(),
        large: meant.large.clone(),
        ..written
    };
    (same && rest == meant).then_some(out)
}

/// The text of a profile with these external axes: their block is written anew, before the
/// calibration where there was none; every other byte stays.
///
/// `None` where what came out is not what was meant, as in one long line: nothing is guessed.
#[must_use]
pub fn with_external(text: &str, axes: &ExternalAxes) -> Option<String> {
    let (start, end) = block(text, "external_axes")
        .or_else(|| block(text, "calibration").map(|(start, _)| (start, start)))
        .unwrap_or((text.len(), text.len()));
    let line_end = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let before = &text[..start];
    let gap = if before.is_empty() || before.ends_with('\n') {
        ""
    } else {
        line_end
    };
    let section = super::external::section(axes).replace('\n', line_end);
    let out = format!("{before}{gap}{section}{}", &text[end..]);
    let without = |text: &str| {
        let mut data: serde_json::Value = serde_yaml::from_str(text).ok()?;
        data.as_object_mut()?.remove("external_axes");
        Some(data)
    };
    (without(text)? == without(&out)?).then_some(out)
}

/// First byte of a top-level block and the byte behind its last line.
fn block(text: &str, key: &str) -> Option<(usize, usize)> {
    let mut at = 0;
    let mut found: Option<(usize, usize)> = None;
    for line in text.split_inclusive('\n') {
        let (from, to) = (at, at + line.len());
        at = to;
        let content = line.trim_end();
        match &mut found {
            None => {
                let rest = content.strip_prefix(key);
                if rest.is_some_and(|rest| rest.trim_start().starts_with(':')) {
                    found = Some((from, to));
                }
            }
            Some((_, end)) => {
                // what is indented belongs to the block; blank lines and comments only where more
                // of it follows
                let indented = line.starts_with([' ', '\t', '-', '}']);
                if indented && !content.is_empty() && !content.trim_start().starts_with('#') {
                    *end = to;
                } else if !content.is_empty() && !content.trim_start().starts_with('#') {
                    break;
                }
            }
        }
    }
    found
}

/// `{effect: link_geometry, link: 2, …}`
fn entry(effect: &Effect) -> String {
    let mut out = String::from("{");
    for (number, (key, value)) in effect.to_entry().iter().enumerate() {
        let comma = if number == 0 { "" } else { ", " };
        let value = match value.as_str() {
            Some(id) if *key == "effect" => id.to_owned(),
            _ => flow(value),
        };
        write!(out, "{comma}{key}: {value}").expect("a text takes all");
    }
    if effect.beyond_usual().is_some() {
        out += ", large: true, reason: \"the controller computes with it\"";
    }
    out + "}"
}
