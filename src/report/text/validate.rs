//! The text of `validate`.

use crate::report::Style;
use crate::report::layout::{SPREAD_HEADER, aligned, spread_row};
use crate::task::parts::Statistics;
use crate::task::validate::{Models, Validation};

/// What is known of a model by this name.
fn of<'a, T>(models: Option<&'a Models<T>>, name: &str) -> Option<&'a T> {
    let mut named = models.into_iter().flat_map(Models::named);
    named.find(|(other, _)| *other == name).map(|(_, one)| one)
}

pub(super) fn text(found: &Validation, style: Style) -> String {
    let mut out = own(found, style);
    if let Some(plates) = &found.plates {
        out += "\nPoints on plates\n";
        out += &own(plates, style);
    }
    out
}

fn own(found: &Validation, style: Style) -> String {
    let mut out = format!("{} rows\n", found.rows);
    if let Some(note) = found.found.refit.note() {
        out += &format!("{note}\n");
    }
    if let Some(standing) = &found.as_calibrated {
        let [answer, power] = standing.sentences();
        out += &format!("{answer}\n{power}\n");
    }
    out.push('\n');
    let mut rows = vec![SPREAD_HEADER.map(str::to_owned).to_vec()];
    for name in ["controller", "frames only", "real"] {
        let row = |what: &str, s: &dyn Statistics| spread_row(&format!("{name}, {what}"), s);
        rows.extend(of(found.position.as_ref(), name).map(|s| row("position mm", s)));
        rows.extend(of(found.orientation.as_ref(), name).map(|s| row("orientation deg", s)));
        rows.extend(of(found.range.as_ref(), name).map(|s| row("distance mm", s)));
    }
    if let Some(folds) = &found.folds {
        for (name, q) in [("frames only", &folds.frames_only), ("real", &folds.real)] {
            let name = format!("{name}, {} folds", folds.count);
            rows.extend(q.main().map(|s| spread_row(&name, &s)));
        }
    }
    out += &aligned(&rows, style.width);
    let mut rows = vec![
        [
            "distance of pairs, mm",
            "pairs",
            "mean",
            "std",
            "mean + 3 std",
            "max",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    for (name, p) in found.distance.iter().flat_map(Models::named) {
        let numbers = [p.mean_mm, p.std_mm, p.mean_plus_3std_mm, p.max_mm];
        let mut row = vec![name.to_owned(), p.pairs.to_string()];
        row.extend(numbers.map(|v| format!("{v:.3}")));
        rows.push(row);
    }
    if rows.len() > 1 {
        out += &format!("\n{}", aligned(&rows, style.width));
    }
    if !found.parts.is_empty() {
        let mut rows = vec![SPREAD_HEADER.map(str::to_owned).to_vec()];
        rows[0][0] = "real model by part, mm".into();
        rows.extend(
            found
                .parts
                .iter()
                .map(|p| spread_row(&format!("{} {}", p.by, p.name), &p.error)),
        );
        out += &format!("\n{}", aligned(&rows, style.width));
    }
    if let Some(rms) = found.normalised_rms {
        out += &format!("\nresiduals are {rms:.2} times the given standard deviations (rms)\n");
    }
    out += &iso_9283(found, style);
    out
}

/// Repeated poses and the distances between them.
fn iso_9283(found: &Validation, style: Style) -> String {
    let most = if style.every { usize::MAX } else { 20 };
    let mut out = String::new();
    if found.iso_9283.is_empty() {
        return out;
    }
    let digits = |v: f64| format!("{v:.4}");
    let table = |header: &[&str], rows: Vec<Vec<String>>| {
        let header = header.iter().map(|name| (*name).to_owned()).collect();
        let all: Vec<_> = std::iter::once(header).chain(rows).collect();
        aligned(&all, style.width)
    };
    let more = |count: usize| match count.saturating_sub(most) {
        0 => String::new(),
        rest => format!("... and {rest} more (--verbose)\n"),
    };
    out += "\nrepeated poses, ISO 9283, mm; AP: the mean from the commanded pose, and from the \
        real model's\n";
    let rows = found.iso_9283.iter().take(most).map(|r| {
        let variation = r
            .multidirectional_variation_mm
            .map_or_else(|| "-".into(), digits);
        let [commanded, real, rp] =
            [r.commanded_accuracy_mm, r.accuracy_mm, r.repeatability_mm].map(digits);
        vec![
            r.file.line(r.line),
            r.count.to_string(),
            commanded,
            real,
            rp,
            variation,
        ]
    });
    out += &table(
        &["line", "count", "AP", "AP real", "RP", "vAP"],
        rows.collect(),
    );
    out += &more(found.iso_9283.len());
    if found.iso_9283_distances.is_empty() {
        return out;
    }
    out += "\ndistances of repeated poses, mm; AD: the mean from the commanded distance, and from \
        the real model's\n";
    let rows = found.iso_9283_distances.iter().take(most).map(|r| {
        let mut row = vec![
            format!("{} to {}", r.line(0), r.line(1)),
            r.count.to_string(),
            format!("{:.3}", r.distance_mm),
        ];
        let numbers = [r.commanded_accuracy_mm, r.accuracy_mm, r.repeatability_mm];
        row.extend(numbers.map(digits));
        row
    });
    out += &table(
        &["lines", "count", "distance", "AD", "AD real", "RD"],
        rows.collect(),
    );
    out += &more(found.iso_9283_distances.len());
    out
}
