//! The page of `validate`.

use super::{Judged, Rows, robot_lead, show_improvement, show_rows, summary};
use crate::geometry::units::m_from_mm;
use crate::identify::statistics;
use crate::identify::validation::Refit;
use crate::report::html::chart::Tone;
use crate::report::html::numbers::{Column, DIGITS, Table, fixed, significant};
use crate::report::html::page::{Level, Page};
use crate::task::parts::{Quality, Statistics};
use crate::task::validate::{AsCalibrated, Repeated, RepeatedDistance, Validation};

/// The page of `validate`.
#[must_use]
pub(crate) fn validate_page(of: &Validation) -> Page {
    let (found, profile) = (&of.found, &of.profile);
    let mean = |q: &statistics::Quality| q.main().map_or(f64::NAN, |s| s.mean);
    let (controller, real) = (mean(&found.controller.quality), mean(&found.real.quality));
    let standing = of.as_calibrated.as_ref();
    let level = match standing {
        Some(standing) if !standing.is_so() => Level::Error,
        None if real > controller => Level::Warning,
        _ => Level::Good,
    };
    let mut answer = format!(
        "Mean error {real:.3} mm of the real model, {controller:.3} mm of the controller's"
    );
    if let Some([sentence, _]) = standing.map(AsCalibrated::sentences) {
        answer = sentence;
    }
    let mut page = Page::new("Validation".into(), level, answer);
    robot_lead(&mut page, &of.name, profile);
    page.lead.extend(found.refit.note().map(Into::into));
    let quality = |of: &statistics::Quality| Quality::from(of);
    let (controller, real) = (
        quality(&found.controller.quality),
        quality(&found.real.quality),
    );
    let what = "controller's model \u{2192} real model";
    let worst = of.worst_row.as_ref();
    show_improvement(&mut page, what, (&controller, &real), worst);
    page.lead.extend(standing.map(|standing| {
        let [_, power] = standing.sentences();
        power
    }));
    page.fact("rows", of.rows.to_string());
    if let Some(pairs) = of.distance.as_ref().and_then(|models| models.real) {
        page.fact("distances between points", pairs.pairs.to_string());
        page.fact("their error, mean", format!("{:.4} mm", pairs.mean_mm));
        page.fact(
            "their error, mean + 3 std",
            format!("{:.4} mm", pairs.mean_plus_3std_mm),
        );
        page.fact("their error, largest", format!("{:.4} mm", pairs.max_mm));
    }
    if let Some(rms) = of.normalised_rms {
        page.fact("residuals in standard deviations", format!("{rms:.2}"));
    }
    if let Some(plates) = &of.plates {
        let [before, after] =
            [&plates.found.controller, &plates.found.real].map(|m| mean(&m.quality));
        page.fact(
            "points on plates, mean error, controller's model \u{2192} real model",
            format!("{before:.4} \u{2192} {after:.4} mm"),
        );
    }
    page.summary = Some(summary(&[
        ("controller", &controller),
        ("frames only", &quality(&found.frames_only.quality)),
        ("real", &real),
    ]));
    // of the frame that the device had then
    let known = profile
        .quality
        .as_ref()
        .filter(|_| found.refit == Refit::No);
    let middle = known.and_then(|quality| {
        let numbers = quality["middle_mm"].as_array()?;
        let number = |k: usize| numbers.get(k)?.as_f64();
        Some([number(0)?, number(1)?, number(2)?].map(m_from_mm))
    });
    let rows = Rows {
        problem: &found.problem,
        measurements: &found.measurements,
        models: vec![
            Judged {
                name: "controller",
                tone: Tone::Before,
                misses: &found.controller.misses,
            },
            Judged {
                name: "frames only",
                tone: Tone::Frames,
                misses: &found.frames_only.misses,
            },
            Judged {
                name: "real",
                tone: Tone::After,
                misses: &found.real.misses,
            },
        ],
        centre_m: middle,
    };
    show_rows(&mut page, &rows, profile);
    if !of.parts.is_empty() {
        let parts = &of.parts;
        let spread = |p: &crate::task::validate::Part| p.error.numbers();
        let table = Table {
            columns: vec![
                Column::texts("part", parts.iter().map(|p| format!("{} {}", p.by, p.name))),
                Column::counts("n", parts.iter().map(|p| p.error.n)),
                Column::numbers(
                    "mean",
                    "mm",
                    parts.iter().map(|p| significant(spread(p).mean, DIGITS)),
                )
                .to(4),
                Column::numbers(
                    "std",
                    "mm",
                    parts.iter().map(|p| significant(spread(p).std, DIGITS)),
                )
                .to(4),
                Column::numbers(
                    "largest",
                    "mm",
                    parts.iter().map(|p| significant(spread(p).max, DIGITS)),
                )
                .to(4)
                .worst_first(),
            ],
        };
        page.show("parts", "Real model by parts", "", table);
    }
    if !of.iso_9283.is_empty() {
        let list = &of.iso_9283;
        let mm = |of: &dyn Fn(&Repeated) -> f64| -> Vec<_> {
            list.iter().map(|r| significant(of(r), DIGITS)).collect()
        };
        let table = Table {
            columns: vec![
                Column::counts("line", list.iter().map(|r| r.line)),
                Column::counts("count", list.iter().map(|r| r.count)),
                Column::numbers("AP", "mm", mm(&|r| r.commanded_accuracy_mm)).to(4),
                Column::numbers("AP, real model", "mm", mm(&|r| r.accuracy_mm))
                    .to(4)
                    .worst_first(),
                Column::numbers("RP", "mm", mm(&|r| r.repeatability_mm)).to(4),
                Column::numbers(
                    "vAP",
                    "mm",
                    list.iter().map(|r| {
                        r.multidirectional_variation_mm
                            .map(|v| significant(v, DIGITS))
                    }),
                )
                .to(4),
            ],
        };
        let note = "AP: the mean from the commanded pose, and from the real model's";
        page.show("repeated", "Repeated poses, ISO 9283", note, table);
    }
    if !of.iso_9283_distances.is_empty() {
        let list = &of.iso_9283_distances;
        let mm = |of: &dyn Fn(&RepeatedDistance) -> f64| -> Vec<_> {
            list.iter().map(|r| significant(of(r), DIGITS)).collect()
        };
        let table = Table {
            columns: vec![
                Column::counts("line", list.iter().map(|r| r.lines[0])),
                Column::counts("to line", list.iter().map(|r| r.lines[1])),
                Column::counts("count", list.iter().map(|r| r.count)),
                Column::numbers(
                    "distance",
                    "mm",
                    list.iter().map(|r| fixed(r.distance_mm, 3)),
                )
                .to(3),
                Column::numbers("AD", "mm", mm(&|r| r.commanded_accuracy_mm)).to(4),
                Column::numbers("AD, real model", "mm", mm(&|r| r.accuracy_mm))
                    .to(4)
                    .worst_first(),
                Column::numbers("RD", "mm", mm(&|r| r.repeatability_mm)).to(4),
            ],
        };
        let note = "AD: the mean from the commanded distance, and from the real model's";
        page.show(
            "distances",
            "Distances of repeated poses, ISO 9283",
            note,
            table,
        );
    }
    page.findings(&of.findings);
    page
}
