//! The text of `diagnose`.

use super::fixed;
use crate::diagnose::{NoiseSource, Verdict};
use crate::report::layout::{SPREAD_HEADER, aligned, spread_row};
use crate::report::{LEAST_PROBABILITY, Style};
use crate::task::diagnose::{
    ChangedEffect, Diagnosis, Effect, FoundEffect, Group, ImpossibleGroup, PositionerDiagnosis,
};
use crate::task::parts::Statistics;

/// The answer: the verdict in one line, each effect with its standing, the residual.
fn summary(d: &Diagnosis) -> String {
    let mut out = d
        .drift
        .as_ref()
        .map_or_else(String::new, |drift| drift.sentence() + "\n");
    out += &(verdict(d) + "\n");
    for effect in &d.effects {
        out += &found(effect);
    }
    out += &d.changed.iter().map(changed).collect::<String>();
    out += &residual(d);
    if !d.reasons.is_empty() {
        out += match d.found.verdict {
            Verdict::Undetermined => "\nwhy it cannot be decided\n",
            _ => "\nwhy that is not all\n",
        };
        for reason in &d.reasons {
            out += &format!("  - {reason}\n");
        }
    }
    out += &d.positioners.iter().map(positioner).collect::<String>();
    out
}

/// What was found of a positioner, by the rows of points on its plate.
fn positioner(of: &PositionerDiagnosis) -> String {
    let words = match of.answer {
        Verdict::Explained => "the effects found account for the disagreement",
        Verdict::Improved => "predicted better with what was found; something is still missing",
        Verdict::NothingMissing => "nothing is missing",
        Verdict::Undetermined => "what is missing cannot be determined",
    };
    let mut out = format!(
        "\npositioner {}, {} rows at {} stops: {words}.\n",
        of.positioner, of.rows, of.stops
    );
    for effect in &of.effects {
        out += &found(effect);
    }
    if let Some((before, after)) = of.before.zip(of.after).filter(|_| !of.effects.is_empty()) {
        let [before, after] = [before, after].map(|spread| spread.numbers().mean);
        out += &format!("{before:.3} → {after:.3} mm at stops that were left out in turn.\n");
    }
    out += &format!(
        "{:<9} {} mm a coordinate.\n",
        "residual",
        fixed(of.left_mm, 4)
    );
    for reason in &of.reasons {
        out += &format!("  - {reason}\n");
    }
    if !of.effects.is_empty() {
        out += "`poseshift calibrate` puts them into the profile.\n";
    }
    out
}

/// An effect with its standing and what it may be instead.
fn found(effect: &FoundEffect) -> String {
    let mut out = format!("{:<9} {}", effect.standing, effect.sentence);
    if let Some(first) = effect.against.first() {
        out += &format!(" Or {}: {}.", first.what, odds(first.odds));
    }
    out + "\n"
}

/// An effect of the profile that is not what it was.
fn changed(effect: &ChangedEffect) -> String {
    let values = effect.values().map(|(key, [was, now, sigma])| {
        let [was, now] = [was, now].map(|x| x.unwrap_or(f64::NAN));
        format!(
            "{key} {was:.4e} → {now:.4e} ± {:.1e}",
            sigma.unwrap_or(f64::NAN)
        )
    });
    format!(
        "{:<9} {}: {} ({} standard deviations; the profile was fitted again).\n",
        "changed",
        effect.effect.label,
        values.collect::<Vec<_>>().join(", "),
        fixed(effect.times_sigma, 0),
    )
}

/// The verdict in words, with what it is worth on rows that were not used.
pub(in crate::report) fn verdict(d: &Diagnosis) -> String {
    let words = match d.found.verdict {
        Verdict::Explained => "Explained: the effects found account for the disagreement.",
        Verdict::Improved => {
            "Improved: rows left out are predicted better; something is still missing."
        }
        Verdict::NothingMissing if d.found.noise_source == NoiseSource::Residuals => {
            "Nothing is missing that these measurements can show."
        }
        Verdict::NothingMissing => {
            "Nothing is missing: the model agrees with the measurements within the noise."
        }
        Verdict::Undetermined => "What is missing cannot be determined.",
    };
    let Some(compared) = (d.held_out.compared.as_ref())
        .filter(|_| !d.effects.is_empty() && d.found.verdict != Verdict::Undetermined)
    else {
        return words.to_owned();
    };
    let (before, after) = (compared.before.numbers(), compared.after.numbers());
    let start = if compared.refitted {
        "not used, the profile fitted again without them"
    } else {
        "not used"
    };
    format!(
        "{words}\n{:.0} % of the disagreement goes: {:.3} → {:.3} mm on {} poses {start}.",
        100.0 * (1.0 - after.mean / before.mean.max(1e-12)),
        before.mean,
        after.mean,
        after.n
    )
}

/// Odds in words: `20 to 1`, `1 to 3`.
pub(in crate::report) fn odds(odds: f64) -> String {
    if odds >= 1.0 {
        format!("odds {odds:.0} to 1")
    } else {
        format!("odds 1 to {:.0}", (1.0 / odds).min(1e6))
    }
}

/// The residual that remains, and what it depends on most.
pub(in crate::report) fn residual(d: &Diagnosis) -> String {
    let mut out = format!("{:<9} {} mm a coordinate", "residual", fixed(d.left_mm, 4));
    if let Some(function) = &d.unexplained.function {
        out += &format!(", mostly of {function}");
    } else if let Some(spot) = d.unexplained.spots.first() {
        out += &format!(", mostly with {} (largest at {})", spot.column, spot.values);
    }
    out + ".\n"
}

/// A probability in few characters; what is too small for a number is said to be below one.
fn probability(p: Option<f64>) -> String {
    let p = p.unwrap_or(f64::NAN);
    if p < LEAST_PROBABILITY {
        format!("< {LEAST_PROBABILITY:e}")
    } else {
        format!("{p:.0e}")
    }
}

/// Labels of effects with those of one kind together: `joint_harmonic joint 1 order 4, joint 2
/// order 1`.
pub(in crate::report) fn together<'a>(effects: impl IntoIterator<Item = &'a Effect>) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut last = None;
    for effect in effects {
        let place = effect.label.strip_prefix(effect.id()).unwrap_or_default();
        match words.last_mut() {
            Some(word) if last == Some(effect.id()) => *word += &format!(", {}", place.trim()),
            _ => words.push(effect.label.clone()),
        }
        last = Some(effect.id());
    }
    words.join("; ")
}

/// The effects found of these labels.
pub(in crate::report) fn labelled<'a>(
    found: &'a Diagnosis,
    labels: &'a [String],
) -> impl Iterator<Item = &'a Effect> {
    let of = |label: &String| {
        let mut effects = found.effects.iter().map(|f| &f.effect);
        effects.find(|effect| effect.label == *label)
    };
    labels.iter().filter_map(of)
}

/// A group of effects, those that compete with it, and the residual with either, in one sentence.
fn competes(s: &Group, d: &Diagnosis) -> String {
    format!(
        "{} instead of {}: {} % as much, a residual of {} mm instead of {} mm (behind by {})",
        together(&s.effects),
        together(labelled(d, &s.instead_of)),
        fixed(s.part.map(|part| 100.0 * part), 0),
        fixed(s.left_mm, 4),
        fixed(d.left_mm, 4),
        fixed(s.behind, 1)
    )
}

/// What would compete with a group of the effects found if it were possible.
fn impossibly(i: &ImpossibleGroup, d: &Diagnosis) -> String {
    let values = i.effects.iter().map(|effect| {
        let numbers = effect
            .values
            .iter()
            .map(|(_, x, unit)| format!("{x:.1e} {unit}"));
        numbers.collect::<Vec<_>>().join(", ")
    });
    format!(
        "{} would explain {} % as much as {}, but only with {}: nothing springs against its load",
        together(&i.effects),
        fixed(i.part.map(|part| 100.0 * part), 0),
        together(labelled(d, &i.instead_of)),
        values.collect::<Vec<_>>().join(" and ")
    )
}

/// An effect found with its evidence, and its values under it.
fn values(f: &FoundEffect) -> String {
    let e = &f.evidence;
    let mut out = format!(
        "\n{}: fall of chi-squared {}, p {}",
        f.effect.label,
        fixed(e.chi_squared_fall, 0),
        probability(e.p_value)
    );
    if e.found_again_of > 0 {
        out += &format!(", again {}/{}", e.found_again, e.found_again_of);
    }
    out.push('\n');
    for (key, sigma) in &f.sigma {
        let value = f.effect.values.iter().find(|(name, ..)| name == key);
        out += &format!(
            "  {key:<16} {:>11.4e} ± {:.1e}\n",
            value.map_or(f64::NAN, |(_, value, _)| *value),
            sigma.as_f64().unwrap_or(f64::NAN)
        );
    }
    out
}

/// The report for people.
pub(super) fn text(found: &Diagnosis, style: Style) -> String {
    let mut out = summary(found);
    if let Some(drift) = &found.drift {
        let most = if style.every { usize::MAX } else { 30 };
        let mut rows = vec![["run", "rows", "rms mm"].map(str::to_owned).to_vec()];
        let skipped = drift.runs.len().saturating_sub(most);
        for (run, number) in drift.runs.iter().zip(1..).skip(skipped) {
            let changed = drift.changes.iter().any(|change| change.run == number);
            let mark = if changed { " changed" } else { "" };
            rows.push(vec![
                run.file.clone(),
                run.rows.to_string(),
                format!("{:.3}{mark}", run.rms_mm),
            ]);
        }
        out += &format!("\nerrors run by run\n{}", aligned(&rows, style.width));
    }
    let steps = found.steps();
    if !steps.is_empty() {
        let mut rows = vec![SPREAD_HEADER.map(str::to_owned).to_vec()];
        rows.extend(steps.iter().map(|(name, s)| spread_row(name, s)));
        out += "\nerrors in mm on rows not used for the choice\n";
        out += &aligned(&rows, style.width);
    }
    let source = match found.found.noise_source {
        NoiseSource::Given => "sigma_mm",
        NoiseSource::Repeats => "repeated poses",
        NoiseSource::Residuals => "what no model explains",
    };
    out += &format!(
        "\nnoise {} mm a coordinate by {source}; residual {} mm\n",
        fixed(found.noise_mm, 4),
        fixed(found.left_mm, 4)
    );
    out.extend(found.effects.iter().map(values));
    let most = if style.every { usize::MAX } else { 5 };
    if !found.spots.is_empty() {
        out += "\nwhere the present model misses, strongest first\n";
        let mut rows = vec![
            ["column", "most at", "rms mm", "largest mm", "part", "p"]
                .map(str::to_owned)
                .to_vec(),
        ];
        for s in found.spots.iter().take(most) {
            rows.push(vec![
                s.column.clone(),
                s.values.clone(),
                format!("{:.3}", s.size_mm),
                format!("{:.3}", s.largest_mm),
                format!("{} %", fixed(s.part.map(|part| 100.0 * part), 0)),
                probability(s.p_value),
            ]);
        }
        out += &aligned(&rows, style.width);
    }
    if !found.alternatives.is_empty() {
        out += "\nexplain the measurements nearly as well\n";
        for r in found.alternatives.iter().take(most) {
            out += &format!(
                "  {} instead of {} (behind by {})\n",
                r.effect.label,
                r.instead_of,
                fixed(r.behind, 1)
            );
        }
    }
    if !found.alternative_groups.is_empty() {
        out += "\ncompete with several of the effects found\n";
        for s in &found.alternative_groups {
            out += &format!("  {}\n", competes(s, found));
        }
    }
    for i in &found.impossible {
        out += &format!("\n{}\n", impossibly(i, found));
    }
    let apart = found.telling_poses.iter().map(|t| t.apart_mm);
    if let Some(most) = apart.reduce(f64::max) {
        out += &format!(
            "\n{} poses separate alternatives, by up to {most:.3} mm: --poses FILE writes them\n",
            found.telling_poses.len()
        );
    }
    if !found.cannot_test.is_empty() {
        out += "\ncould not be tested\n";
        for c in &found.cannot_test {
            out += &format!("  {}: needs {}\n", c.effect, c.missing);
        }
    }
    if !found.outliers.is_empty() {
        out += &format!(
            "\n{} rows fit no model and hardly count\n",
            found.outliers.len()
        );
        for o in found.outliers.iter().take(most) {
            out += &format!(
                "  {}: {}, {} times the noise\n",
                o.file.words(o.line),
                o.off,
                fixed(o.times_noise, 0)
            );
        }
    }
    if !found.leverage.is_empty() {
        out += &format!(
            "\n{} rows decide alone what the model says of them: no evidence for it\n",
            found.leverage.len()
        );
        for f in found.leverage.iter().take(most) {
            out += &format!(
                "  {}: leverage {}\n",
                f.file.words(f.line),
                fixed(f.leverage, 2)
            );
        }
    }
    out
}
