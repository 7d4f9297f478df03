//! Tables of a diagnosis: where it misses, what else would explain it, which rows say nothing.

use crate::report::html::numbers::{Column, DIGITS, Number, Table, fixed, significant};
use crate::report::html::page::Page;
use crate::report::text::{fixed as decimals, labelled, together};
use crate::task::diagnose::{Diagnosis, Effect, FoundEffect, ImpossibleGroup};

/// The least sure first.
pub(super) const STANDINGS: [&str; 3] = ["possible", "likely", "certain"];

/// Every list that is not empty.
pub(super) fn show(page: &mut Page, found: &Diagnosis) {
    let all = [
        changed,
        spots,
        alternatives,
        groups,
        impossible,
        untested,
        outliers,
        followed,
    ];
    for list in all {
        list(page, found);
    }
}

/// How sure each effect is, the least sure first, and the residual.
pub(super) fn show_standing(page: &mut Page, found: &Diagnosis) {
    if found.effects.is_empty() {
        return;
    }
    let mut list: Vec<&FoundEffect> = found.effects.iter().collect();
    list.sort_by_key(|f| STANDINGS.iter().position(|s| *s == f.standing));
    let first = |f: &FoundEffect| f.against.first().map(|a| (a.what.clone(), a.odds));
    let others: Vec<Option<(String, f64)>> = list.iter().map(|f| first(f)).collect();
    let name = |r: &Option<(String, f64)>| r.as_ref().map_or(String::new(), |r| r.0.clone());
    let odds = |r: &Option<(String, f64)>| r.as_ref().map(|r| significant(r.1, 2));
    let table = Table {
        columns: vec![
            Column::texts("standing", list.iter().map(|f| f.standing.to_owned())),
            Column::texts("effect", list.iter().map(|f| f.effect.label.clone())),
            Column::texts("may be instead", others.iter().map(name)),
            Column::numbers("odds against that", "to 1", others.iter().map(odds)),
        ],
    };
    let residual = crate::report::text::residual(found);
    let residual = residual.split_whitespace().collect::<Vec<_>>().join(" ");
    page.show("standing", "How sure each effect is", &residual, table);
}

/// What was found of positioners, each effect a row.
pub(super) fn show_positioners(page: &mut Page, found: &Diagnosis) {
    for (number, of) in found.positioners.iter().enumerate() {
        let table = Table {
            columns: vec![
                Column::texts("standing", of.effects.iter().map(|f| f.standing.to_owned())),
                Column::texts("effect", of.effects.iter().map(|f| f.effect.label.clone())),
                Column::texts("what it is", of.effects.iter().map(|f| f.sentence.clone())),
                Column::texts(
                    "may be instead",
                    of.effects.iter().map(|f| {
                        let first = f.against.first();
                        first.map_or_else(String::new, |against| against.what.clone())
                    }),
                ),
            ],
        };
        let errors = match (&of.before, &of.after) {
            (Some(before), Some(after)) => format!(
                "; {} \u{2192} {} mm at stops that were left out in turn",
                decimals(before.mean_mm, 3),
                decimals(after.mean_mm, 3)
            ),
            _ => String::new(),
        };
        let note = format!(
            "{}: {} rows at {} stops{errors}. {}",
            of.verdict.replace('_', " "),
            of.rows,
            of.stops,
            of.reasons.join("; ")
        );
        let title = format!("Positioner {}", of.positioner);
        page.show(
            &format!("positioner{}", number + 1),
            &title,
            note.trim(),
            table,
        );
    }
}

fn labels(found: &Diagnosis, which: &[String]) -> String {
    together(labelled(found, which))
}

/// A share in per cent.
fn percent(part: Option<f64>) -> Option<Number> {
    part.map(|part| fixed(100.0 * part, 1))
}

/// A number that may be none, rounded.
fn rounded(value: Option<f64>, digits: usize) -> Option<Number> {
    value.map(|value| significant(value, digits))
}

fn spots(page: &mut Page, found: &Diagnosis) {
    let list = &found.spots;
    if list.is_empty() {
        return;
    }
    let table = Table {
        columns: vec![
            Column::texts("column", list.iter().map(|s| s.column.clone())),
            Column::texts("most at", list.iter().map(|s| s.values.clone())),
            Column::numbers(
                "rms",
                "mm",
                list.iter().map(|s| significant(s.size_mm, DIGITS)),
            )
            .to(4),
            Column::numbers(
                "largest",
                "mm",
                list.iter().map(|s| significant(s.largest_mm, DIGITS)),
            )
            .to(4),
            Column::numbers("part", "%", list.iter().map(|s| percent(s.part))),
            Column::probabilities("p", list.iter().map(|s| s.p_value)),
        ],
    };
    let title = "Where the present model misses";
    page.show("where", title, "Strongest first.", table);
}

/// Effects of the profile that are not what they were, a row for each parameter.
fn changed(page: &mut Page, found: &Diagnosis) {
    let list: Vec<_> = (found.changed.iter())
        .flat_map(|c| c.values().map(move |values| (c, values)))
        .collect();
    if list.is_empty() {
        return;
    }
    let number = |at: usize, digits: usize| {
        let numbers = list
            .iter()
            .map(move |(_, (_, values))| rounded(values[at], digits));
        numbers.collect::<Vec<_>>()
    };
    let table = Table {
        columns: vec![
            Column::texts("effect", list.iter().map(|(c, _)| c.effect.label.clone())),
            Column::texts("value", list.iter().map(|(_, (key, _))| (*key).to_owned())),
            Column::numbers("profile", "", number(0, DIGITS)),
            Column::numbers("fitted", "", number(1, DIGITS)),
            Column::numbers("standard deviation", "", number(2, 2)),
            Column::numbers(
                "farthest, times that",
                "",
                list.iter().map(|(c, _)| rounded(c.times_sigma, 3)),
            ),
        ],
    };
    page.show(
        "changed",
        "What is not as the profile has it",
        "Frames, geometry and the profile's effects were fitted anew.",
        table,
    );
}

fn alternatives(page: &mut Page, found: &Diagnosis) {
    let list = &found.alternatives;
    if list.is_empty() {
        return;
    }
    let table = Table {
        columns: vec![
            Column::texts("effect", list.iter().map(|r| r.effect.label.clone())),
            Column::texts("instead of", list.iter().map(|r| r.instead_of.clone())),
            Column::numbers(
                "fall of chi-squared",
                "",
                list.iter().map(|r| rounded(r.chi_squared_fall, 4)),
            ),
            Column::numbers("behind by", "", list.iter().map(|r| rounded(r.behind, 3))),
        ],
    };
    let title = "What explains the measurements nearly as well";
    page.show("alternatives", title, "", table);
}

fn groups(page: &mut Page, found: &Diagnosis) {
    let list = &found.alternative_groups;
    if list.is_empty() {
        return;
    }
    let table = Table {
        columns: vec![
            Column::texts("effects", list.iter().map(|s| together(&s.effects))),
            Column::texts(
                "instead of",
                list.iter().map(|s| labels(found, &s.instead_of)),
            ),
            Column::numbers("part", "%", list.iter().map(|s| percent(s.part))),
            Column::numbers(
                "residual of a coordinate",
                "mm",
                list.iter().map(|s| rounded(s.left_mm, 4)),
            )
            .to(4),
            Column::numbers("behind by", "", list.iter().map(|s| rounded(s.behind, 3))),
        ],
    };
    page.show(
        "groups",
        "What competes with several of the effects found",
        "The part of the fall of chi-squared that they have in common.",
        table,
    );
}

/// A row for each parameter of an effect that would have to be what it cannot be.
fn impossible(page: &mut Page, found: &Diagnosis) {
    let each = |i: &'_ ImpossibleGroup| -> Vec<(Effect, String, Option<f64>)> {
        let instead_of = labels(found, &i.instead_of);
        let effects = i.effects.iter();
        effects
            .map(|e| (e.clone(), instead_of.clone(), i.part))
            .collect()
    };
    let list: Vec<_> = found.impossible.iter().flat_map(each).collect();
    if list.is_empty() {
        return;
    }
    // all of them have one parameter
    let (value, unit) = (|e: &Effect| e.values[0].1, |e: &Effect| e.values[0].2);
    let table = Table {
        columns: vec![
            Column::texts("effect", list.iter().map(|(e, ..)| e.label.clone())),
            Column::numbers(
                "it would need",
                "",
                list.iter().map(|(e, ..)| significant(value(e), 3)),
            ),
            Column::texts("unit", list.iter().map(|(e, ..)| unit(e).to_owned())),
            Column::texts("instead of", list.iter().map(|(_, of, _)| of.clone())),
            Column::numbers("part", "%", list.iter().map(|(.., part)| percent(*part))),
        ],
    };
    page.show(
        "impossible",
        "What would explain it, but cannot be",
        "The part of the fall of chi-squared that all effects of the kind explain together, with \
         these values: nothing springs against its load.",
        table,
    );
}

fn untested(page: &mut Page, found: &Diagnosis) {
    let list = &found.cannot_test;
    if list.is_empty() {
        return;
    }
    let table = Table {
        columns: vec![
            Column::texts("effect", list.iter().map(|c| c.effect.to_owned())),
            Column::texts("needs", list.iter().map(|c| c.missing.clone())),
        ],
    };
    page.show("cannot-test", "What could not be tested", "", table);
}

fn outliers(page: &mut Page, found: &Diagnosis) {
    let list = &found.outliers;
    if list.is_empty() {
        return;
    }
    let mut table = Table {
        columns: vec![
            Column::counts("line", list.iter().map(|o| o.line)),
            Column::texts("id", list.iter().map(|o| o.id.clone())),
            Column::numbers(
                "residual",
                "mm",
                list.iter().map(|o| significant(o.residual_mm, DIGITS)),
            )
            .to(4)
            .worst_first(),
            Column::numbers(
                "times the noise",
                "",
                list.iter().map(|o| rounded(o.times_noise, 3)),
            )
            .to(1),
        ],
    };
    let rotated: Vec<Option<f64>> = list.iter().map(|o| o.residual_deg).collect();
    table.insert_rotations(3, &rotated);
    page.show("outliers", "Rows that fit no model", "", table);
}

fn followed(page: &mut Page, found: &Diagnosis) {
    let list = &found.leverage;
    if list.is_empty() {
        return;
    }
    let table = Table {
        columns: vec![
            Column::counts("line", list.iter().map(|f| f.line)),
            Column::texts("id", list.iter().map(|f| f.id.clone())),
            Column::numbers("leverage", "", list.iter().map(|f| rounded(f.leverage, 3)))
                .to(3)
                .worst_first(),
        ],
    };
    page.show(
        "leverage",
        "Rows that decide alone",
        "The model follows them whatever they say: that they fit is no evidence for it.",
        table,
    );
}
