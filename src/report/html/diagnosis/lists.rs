//! Tables of a diagnosis: where it misses, what else would explain it, which rows tell nothing.

use crate::diagnose::Diagnosis;
use crate::diagnose::stand_ins::Impossible;
use crate::geometry::units::mm_from_m;
use crate::model::effects::Effect;
use crate::report::diagnosis::together;
use crate::report::html::numbers::{Column, Table, fixed, significant};
use crate::report::html::page::Page;

/// Every list that is not empty.
pub(super) fn show(page: &mut Page, found: &Diagnosis) {
    let all = [
        spots, rivals, groups, impossible, untested, outliers, followed,
    ];
    for list in all {
        list(page, found);
    }
}

fn labels(found: &Diagnosis, which: &[usize]) -> String {
    together(which.iter().map(|i| &found.found[*i].effect))
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
                list.iter().map(|s| significant(mm_from_m(s.size_m), 4)),
            ),
            Column::numbers(
                "largest",
                "mm",
                list.iter().map(|s| significant(mm_from_m(s.largest_m), 4)),
            ),
            Column::numbers("part", "%", list.iter().map(|s| fixed(100.0 * s.part, 1))),
            Column::numbers("p", "", list.iter().map(|s| significant(s.p_value, 2))),
        ],
    };
    let title = "Where the present model misses";
    page.show("where", title, "Strongest first.", table);
}

fn rivals(page: &mut Page, found: &Diagnosis) {
    let list = &found.rivals;
    if list.is_empty() {
        return;
    }
    let instead_of = |i: usize| found.found[i].effect.label();
    let table = Table {
        columns: vec![
            Column::texts("effect", list.iter().map(|r| r.effect.label())),
            Column::texts("instead of", list.iter().map(|r| instead_of(r.instead_of))),
            Column::numbers(
                "fall of chi squared",
                "",
                list.iter().map(|r| significant(r.gain, 4)),
            ),
            Column::numbers(
                "behind by",
                "",
                list.iter().map(|r| significant(r.behind, 3)),
            ),
        ],
    };
    let title = "What explains the measurements nearly as well";
    page.show("alternatives", title, "", table);
}

fn groups(page: &mut Page, found: &Diagnosis) {
    let list = &found.stand_ins;
    if list.is_empty() {
        return;
    }
    let table = Table {
        columns: vec![
            Column::texts("effects", list.iter().map(|s| together(s.effects.iter()))),
            Column::texts(
                "instead of",
                list.iter().map(|s| labels(found, &s.instead_of)),
            ),
            Column::numbers("part", "%", list.iter().map(|s| fixed(100.0 * s.part, 1))),
            Column::numbers(
                "left of a coordinate",
                "mm",
                list.iter().map(|s| significant(mm_from_m(s.left_m), 4)),
            ),
            Column::numbers(
                "behind by",
                "",
                list.iter().map(|s| significant(s.behind, 3)),
            ),
        ],
    };
    page.show(
        "groups",
        "What competes with several of the effects found",
        "The part of the fall of chi squared that they have in common.",
        table,
    );
}

/// A row for each parameter of an effect that would have to be what it cannot be.
fn impossible(page: &mut Page, found: &Diagnosis) {
    let each = |i: &'_ Impossible| -> Vec<(Effect, String, f64)> {
        let instead_of = labels(found, &i.instead_of);
        let effects = i.effects.iter();
        effects
            .map(|e| (e.clone(), instead_of.clone(), i.part))
            .collect()
    };
    let list: Vec<(Effect, String, f64)> = found.impossible.iter().flat_map(each).collect();
    if list.is_empty() {
        return;
    }
    // all of them have one parameter
    let parameter = |e: &Effect| &e.definition().parameters[0];
    let value = |e: &Effect| e.parameters[0] / parameter(e).unit.in_si();
    let table = Table {
        columns: vec![
            Column::texts("effect", list.iter().map(|(e, ..)| e.label())),
            Column::numbers(
                "it would need",
                "",
                list.iter().map(|(e, ..)| significant(value(e), 3)),
            ),
            Column::texts(
                "unit",
                list.iter()
                    .map(|(e, ..)| parameter(e).unit.symbol().to_owned()),
            ),
            Column::texts("instead of", list.iter().map(|(_, of, _)| of.clone())),
            Column::numbers(
                "part",
                "%",
                list.iter().map(|(.., part)| fixed(100.0 * part, 1)),
            ),
        ],
    };
    page.show(
        "impossible",
        "What would explain it, but cannot be",
        "The part of the fall of chi squared that all effects of the kind explain together, with these values: nothing springs against its load.",
        table,
    );
}

fn untested(page: &mut Page, found: &Diagnosis) {
    let list = &found.cannot_test;
    if list.is_empty() {
        return;
    }
    let id = |c: &crate::diagnose::candidates::CannotTest| c.kind.definition().id.to_owned();
    let table = Table {
        columns: vec![
            Column::texts("effect", list.iter().map(id)),
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
    let table = Table {
        columns: vec![
            Column::counts("line", list.iter().map(|o| o.line.number)),
            Column::texts("id", list.iter().map(|o| o.id.clone())),
            Column::numbers(
                "residual",
                "mm",
                list.iter().map(|o| significant(mm_from_m(o.length_m), 5)),
            ),
            Column::numbers(
                "times the noise",
                "",
                list.iter().map(|o| significant(o.times, 3)),
            ),
        ],
    };
    page.show("outliers", "Rows that fit no model", "", table);
}

fn followed(page: &mut Page, found: &Diagnosis) {
    let list = &found.followed;
    if list.is_empty() {
        return;
    }
    let table = Table {
        columns: vec![
            Column::counts("line", list.iter().map(|f| f.line.number)),
            Column::texts("id", list.iter().map(|f| f.id.clone())),
            Column::numbers(
                "leverage",
                "",
                list.iter().map(|f| significant(f.leverage, 3)),
            ),
        ],
    };
    page.show(
        "leverage",
        "Rows that decide alone",
        "The model follows them whatever they say: that they fit is no evidence for it.",
        table,
    );
}
