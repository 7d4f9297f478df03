//! The page of `calibrate`.

use super::{Judged, Rows, robot_lead, show_improvement, show_rows, summary};
use crate::identify::calibration::STRONG_CORRELATION;
use crate::identify::statistics::misses;
use crate::report::html::chart::{Axis, Chart, Heat, Kind, Series, Tone};
use crate::report::html::frames::{pose_text, sigma_text};
use crate::report::html::numbers::{Column, DIGITS, Table, fixed, significant};
use crate::report::html::page::{Level, Page, Section};
use crate::report::text::{fixed as decimals, scientific};
use crate::task::calibrate::{Calibration, Parameter};
use crate::task::parts::Quality;

/// Parameters in the square of correlations.
const MOST_NAMES: usize = 60;

/// The page of `calibrate`.
#[must_use]
pub(crate) fn calibrate_page(of: &Calibration) -> Page {
    let found = &of.found;
    let profile = found.profile();
    let main = |q: &Quality| q.main().and_then(|s| s.mean_mm).unwrap_or(f64::NAN);
    let (frames, after) = (main(&of.frames_only), main(&of.after));
    let mut answer =
        format!("Mean error {frames:.3} mm with the frames alone, {after:.3} mm with everything");
    if let Some(held) = &of.held_out {
        answer += &format!("; {:.3} mm on rows held out", main(&held.after));
    }
    let mut page = Page::new("Calibration".into(), Level::of(&of.findings), answer);
    robot_lead(&mut page, &of.name, &profile);
    if let Some(written) = &of.output {
        page.lead.push(format!("\u{2192} {written}"));
    }
    let what = "frames alone \u{2192} everything";
    let both = (&of.frames_only, &of.after);
    show_improvement(&mut page, what, both, of.worst_row.as_ref());
    page.fact("rows", of.rows.to_string());
    let determined = of.parameters.iter().filter(|p| p.identifiable).count();
    page.fact(
        "parameters determined",
        format!("{determined} of {}", of.parameters.len()),
    );
    let o = &of.observability;
    page.fact("observability O1", decimals(o.o1, 4));
    page.fact("condition number", scientific(o.condition_number));
    page.fact(
        "residuals in standard deviations",
        format!("{:.2}", of.sigma_factor),
    );
    page.fact("rows that do not fit", of.outliers.len().to_string());
    if of.base_replaced {
        page.fact("base in the device's frame", pose_text(&of.base));
    }
    if let Some(device) = &of.world_from_device {
        page.fact("device in the controller's world", pose_text(device));
    }
    if let Some(sigma) = &of.world_from_device_sigma {
        page.fact("its sigma", sigma_text(sigma));
    }
    let mut models = vec![
        ("before", &of.before),
        ("frames only", &of.frames_only),
        ("after", &of.after),
    ];
    if let Some(held) = &of.held_out {
        models.push(("held out, frames only", &held.frames_only));
        models.push(("held out, after", &held.after));
    }
    page.summary = Some(summary(&models));
    let problem = &found.problem;
    let frames = misses(problem, &found.frames_only.estimate);
    let after = misses(problem, &found.solution.estimate);
    let rows = Rows {
        problem,
        measurements: &of.found.fit,
        models: vec![
            Judged {
                name: "before",
                tone: Tone::Before,
                misses: &found.before_misses,
            },
            Judged {
                name: "frames only",
                tone: Tone::Frames,
                misses: &frames,
            },
            Judged {
                name: "after",
                tone: Tone::After,
                misses: &after,
            },
        ],
        centre_m: None,
    };
    show_rows(&mut page, &rows, &profile);
    show_parameters(&mut page, of);
    if let Some(plates) = &of.plates {
        let (frames, after) = (main(&plates.frames_only), main(&plates.after));
        page.fact(
            "points on plates, mean error, points alone \u{2192} everything",
            format!("{frames:.4} \u{2192} {after:.4} mm"),
        );
        show_values(
            &mut page,
            ("plates", "Parameters of positioners"),
            &plates.parameters,
        );
    }
    show_correlations(&mut page, of);
    show_outliers(&mut page, of);
    page.findings(&of.findings);
    page
}

/// The table of parameters, by its name and title.
fn show_values(page: &mut Page, (name, title): (&str, &str), list: &[Parameter]) {
    let key = |p: &Parameter| p.key.clone();
    let value = |p: &Parameter| significant(p.value, 6);
    let table = Table {
        columns: vec![
            Column::texts("parameter", list.iter().map(key)),
            Column::numbers("value", "", list.iter().map(value)),
            Column::numbers(
                "sigma",
                "",
                list.iter().map(|p| p.sigma.map(|s| significant(s, 3))),
            ),
            Column::texts("unit", list.iter().map(|p| p.unit.to_owned())),
            Column::texts(
                "determined",
                list.iter()
                    .map(|p| if p.identifiable { "yes" } else { "no" }.to_owned()),
            ),
            Column::texts("like", list.iter().map(|p| p.confounded_with.join(", "))),
        ],
    };
    page.show(
        name,
        title,
        "What these data do not determine stays as it was; \"like\" names what it cannot be \
         separated from.",
        table,
    );
}

fn show_parameters(page: &mut Page, of: &Calibration) {
    let list = &of.parameters;
    show_values(page, ("parameters", "Parameters"), list);
    let key = |p: &Parameter| p.key.clone();
    let value = |p: &Parameter| significant(p.value, 6);
    let determined: Vec<&Parameter> = list.iter().filter(|p| p.identifiable).collect();
    let mut units: Vec<&'static str> = Vec::new();
    for parameter in &determined {
        if !units.contains(&parameter.unit) {
            units.push(parameter.unit);
        }
    }
    for unit in units {
        let list: Vec<&Parameter> = determined
            .iter()
            .copied()
            .filter(|p| p.unit == unit)
            .collect();
        let twice = |p: &&Parameter| p.sigma.map(|s| significant(2.0 * s, 3));
        let table = Table {
            columns: vec![
                Column::texts("parameter", list.iter().copied().map(key)),
                Column::numbers("value", unit, list.iter().copied().map(value)),
                Column::numbers("two sigma", unit, list.iter().map(twice)),
            ],
        };
        let name = format!("parameters-{unit}");
        page.tables.insert(name.clone(), table);
        let mut chart = Chart::new(
            &format!("Parameters in {unit}"),
            &name,
            Axis::new("parameter", ""),
            Axis::new("value, with two standard deviations", unit),
        );
        let mut series = Series::new(Kind::Rows, 0, 1, "", Tone::One);
        series.y2 = Some(2);
        chart.series.push(series);
        page.sections.push(Section::Chart(chart));
    }
}

fn show_correlations(page: &mut Page, of: &Calibration) {
    let found = &of.found;
    let parameters = &found.solution.parameters;
    let count = parameters.len().min(MOST_NAMES);
    if count < 2 {
        return;
    }
    let mut note = format!(
        "Pairs beyond \u{b1}{STRONG_CORRELATION} move together: these data hardly separate one \
         from the other."
    );
    if parameters.len() > count {
        note += &format!(" The first {count} of {} parameters.", parameters.len());
    }
    page.sections.push(Section::Heat(Heat {
        title: "Correlations of parameters".into(),
        note,
        names: parameters[..count].iter().map(|p| p.key.clone()).collect(),
        values: (0..count)
            .map(|i| {
                (0..=i)
                    .map(|j| fixed(found.uncertainty.correlation(i, j), 3))
                    .collect()
            })
            .collect(),
    }));
}

fn show_outliers(page: &mut Page, of: &Calibration) {
    let list = &of.outliers;
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
            .to(4),
            Column::numbers(
                "times typical",
                "",
                list.iter().map(|o| significant(o.times_typical, DIGITS)),
            )
            .to(1)
            .worst_first(),
            Column::numbers(
                "weight",
                "",
                list.iter().map(|o| significant(o.weight, DIGITS)),
            )
            .to(3),
        ],
    };
    let rotated: Vec<Option<f64>> = list.iter().map(|o| o.residual_deg).collect();
    table.insert_rotations(3, &rotated);
    page.show("outliers", "Rows that do not fit the others", "", table);
}
