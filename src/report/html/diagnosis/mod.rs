//! The page of `diagnose`: the gap shrinking step by step, and for each step what gave the effect
//! away.

mod lists;

use super::cell::{Along, Cell, Path, Points, Robot};
use super::chart::{Axis, Chart, Kind, Series, Tone};
use super::numbers::{Column, DIGITS, Number, Table, fixed, significant};
use super::page::{Level, Page, Section};
use crate::check::Meshes;
use crate::diagnose::{Found, NoiseSource, Verdict};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Vector, dot, scale, sub};
use crate::identify::problem::{Estimate, Problem, Row};
use crate::identify::statistics::{Miss, misses};
use crate::model::JOINTS;
use crate::model::effects::Shown;
use crate::report::text::fixed as decimals;
use crate::task::diagnose::{Diagnosis, FoundEffect};
use crate::task::drift::Drift;
use crate::task::parts::Statistics;
use std::sync::Arc;

/// A joint whose rotation moves the measured point by less than this, metres a radian, shows
/// nothing of its angle.
const ARM_M: f64 = 0.05;
/// A rotation by which the motion of a point is found, radians.
const STEP_RAD: f64 = 1e-6;

/// The page of `diagnose`.
#[must_use]
pub(crate) fn page(of: &Diagnosis) -> Page {
    let found = &of.found;
    let (level, answer) = match found.verdict {
        Verdict::Explained => (
            Level::Good,
            "Explained: the effects found account for the disagreement down to the noise",
        ),
        Verdict::Improved => (
            Level::Good,
            "Improved: rows left out are predicted better with what was found; something is still \
             missing",
        ),
        Verdict::NothingMissing => (
            Level::Good,
            "Nothing is missing: the model agrees with the measurements within the noise",
        ),
        Verdict::Undetermined => (
            Level::Warning,
            "Undetermined: something is missing, and what it is cannot be determined",
        ),
    };
    let mut page = Page::new("Diagnosis".into(), level, answer.into());
    page.lead.push(of.name.clone());
    page.lead
        .push(super::programs::robot_name(&found.problem.profile));
    let rank = |f: &&FoundEffect| lists::STANDINGS.iter().position(|s| *s == f.standing);
    if let Some(one) = of.effects.iter().min_by_key(rank) {
        page.fact(
            "the least sure effect",
            format!("{} ({})", one.effect.label, one.standing),
        );
    }
    if let Some(row) = &of.worst_row {
        page.fact(
            &format!("largest residual, {}", row.file.words(row.line)),
            row.off.clone(),
        );
    }
    page.fact("rows", of.rows.to_string());
    page.fact("effects found", of.effects.len().to_string());
    let source = match found.noise_source {
        NoiseSource::Given => "sigma_mm",
        NoiseSource::Repeats => "repeated poses",
        NoiseSource::Residuals => "what no model explains",
    };
    page.fact(
        &format!("noise of a coordinate, by {source}"),
        decimals(of.noise_mm, 4) + " mm",
    );
    page.fact("residual of a coordinate", decimals(of.left_mm, 4) + " mm");
    if let (Some(before), Some(after)) = (&of.held_out.before, &of.held_out.after) {
        let [before, after] = [before, after].map(|s| decimals(s.mean_mm, 4));
        page.fact(
            "mean error, rows not used",
            format!("{before} \u{2192} {after} mm"),
        );
    }
    if let Some(compared) = of.held_out.compared.as_ref().filter(|c| c.refitted) {
        let [before, after] = [compared.before, compared.after].map(|s| decimals(s.mean_mm, 4));
        page.fact(
            "mean error, the profile fitted again without these rows",
            format!("{before} \u{2192} {after} mm"),
        );
    }
    let drift = of.drift.iter().map(Drift::sentence);
    let sentences = of.effects.iter().map(|f| &f.sentence).chain(&of.reasons);
    let sentences: Vec<String> = drift.chain(sentences.cloned()).collect();
    if !sentences.is_empty() {
        page.sections.push(Section::Text(super::page::Text {
            title: "What was found".into(),
            lines: sentences,
        }));
    }
    lists::show_standing(&mut page, of);
    lists::show_positioners(&mut page, of);
    show_steps(&mut page, of);
    for (number, one) in found.found.iter().enumerate() {
        show_effect(&mut page, of, number, one);
    }
    show_evidence(&mut page, of);
    show_residuals(&mut page, of);
    lists::show(&mut page, of);
    page.findings(&of.findings);
    page
}

/// A bar a step, with the noise floor.
fn show_steps(page: &mut Page, of: &Diagnosis) {
    let found = &of.found;
    let mut steps: Vec<(String, f64)> = of
        .steps()
        .into_iter()
        .map(|(name, s)| (name, s.numbers().rms))
        .collect();
    if steps.is_empty() {
        let rms = |lengths: &[f64]| {
            let sum: f64 = lengths.iter().map(|l| l * l).sum();
            mm_from_m((sum / lengths.len().max(1) as f64).sqrt())
        };
        steps.push(("present model".into(), rms(&found.lengths.0)));
        steps.push(("with everything found".into(), rms(&found.lengths.1)));
    }
    let seen = found
        .problem
        .rows
        .iter()
        .filter(|row| row.observed.point_m().is_some())
        .count();
    let coordinates = if 2 * seen > found.problem.rows.len() {
        3.0_f64
    } else {
        1.0
    };
    let floor = mm_from_m(found.noise_m) * coordinates.sqrt();
    let table = Table {
        columns: vec![
            Column::texts("step", steps.iter().map(|(name, _)| name.clone())),
            Column::numbers(
                "error, rms",
                "mm",
                steps.iter().map(|(_, rms)| significant(*rms, 5)),
            ),
            Column::numbers("noise", "mm", steps.iter().map(|_| significant(floor, 4))),
        ],
    };
    page.tables.insert("steps".into(), table);
    let mut chart = Chart::new(
        "The gap, step by step",
        "steps",
        Axis::new("", ""),
        Axis::new("error, rms", "mm"),
    );
    chart.note = if found.held_out.is_some() {
        "Errors on rows that were not used for the choice; the dashed line is the noise of the \
         measurements."
            .into()
    } else {
        "The dashed line is the noise of the measurements.".into()
    };
    chart.bands = true;
    chart.wide = true;
    chart
        .series
        .push(Series::new(Kind::Bars, 0, 1, "error", Tone::Before));
    chart
        .series
        .push(Series::new(Kind::Level, 0, 2, "noise", Tone::Limit));
    page.sections.push(Section::Chart(chart));
}

/// What an effect shows itself against.
struct Variable {
    label: String,
    unit: &'static str,
    values: Vec<Option<f64>>,
}

fn variable(problem: &Problem, estimate: &Estimate, one: &Found) -> Variable {
    let rows = &problem.rows;
    let site = &one.effect.site;
    let joint = |index: usize| Variable {
        label: format!("joint {}", index + 1),
        unit: "deg",
        values: rows.iter().map(|row| Some(row.q[index] / DEG)).collect(),
    };
    let torque = |index: usize| {
        let models = problem.models(estimate, &[]);
        let of = |row: &Row| models[row.rig].torques(&row.q, &row.conditions)[index];
        Variable {
            label: format!("torque of joint {}", index + 1),
            unit: "N m",
            values: rows.iter().map(|row| Some(of(row))).collect(),
        }
    };
    let each = |label: String, unit, of: &dyn Fn(&Row) -> Option<f64>| Variable {
        label,
        unit,
        values: rows.iter().map(of).collect(),
    };
    let timed = rows.iter().all(|row| row.conditions.time_s.is_some());
    let name = site.index + 1;
    match one.effect.definition().shown_against {
        Shown::Angle if site.index < JOINTS => joint(site.index),
        Shown::OtherAngle if site.on < JOINTS => joint(site.on),
        Shown::Torque(Some(index)) => torque(index),
        Shown::Torque(None) if site.index < JOINTS => torque(site.index),
        Shown::Move if site.index < JOINTS => {
            each(format!("last move of joint {name}"), "deg", &|row| {
                Some(row.conditions.moved[site.index] / DEG)
            })
        }
        Shown::Direction if site.index < JOINTS => {
            each(format!("direction of joint {name}"), "", &|row| {
                Some(row.conditions.direction[site.index])
            })
        }
        Shown::Temperature => each("temperature".into(), "\u{b0}C", &|row| {
            row.conditions.temperature_c
        }),
        Shown::Time if timed => each("time".into(), "s", &|row| row.conditions.time_s),
        _ => Variable {
            label: "row".into(),
            unit: "",
            values: (1..=rows.len()).map(|k| Some(k as f64)).collect(),
        },
    }
}

/// How far each row's expected point moves with a joint, metres a radian.
fn arms(problem: &Problem, estimate: &Estimate, joint: usize) -> Vec<Vector> {
    let mut rotated = problem.clone();
    for row in Arc::make_mut(&mut rotated.rows) {
        row.q[joint] += STEP_RAD;
    }
    let (a, b) = (misses(problem, estimate), misses(&rotated, estimate));
    let by = |(a, b): (&Miss, &Miss)| scale(1.0 / STEP_RAD, sub(b.expected_m, a.expected_m));
    a.iter().zip(&b).map(by).collect()
}

/// A row's residual as an angle of a joint, degrees; `None` where the joint hardly moves the point.
fn as_angle(miss: &Miss, arm: Vector) -> Option<f64> {
    let squared = dot(arm, arm);
    let gap = [miss.gap[0], miss.gap[1], miss.gap[2]];
    (squared > ARM_M * ARM_M).then(|| dot(gap, arm) / squared / DEG)
}

/// The residual before and after an effect, against what gave it away.
fn show_effect(page: &mut Page, of: &Diagnosis, number: usize, one: &Found) {
    let found = &of.found;
    let problem = &found.problem;
    let Some(without) = found.without.get(number) else {
        return;
    };
    let before = misses(problem, without);
    let after = misses(problem, &found.estimate);
    let against = variable(problem, &found.estimate, one);
    let site = one.effect.site.index;
    let of_joint = one.effect.definition().of_joint()
        && site < JOINTS
        && problem
            .rows
            .iter()
            .all(|row| row.observed.point_m().is_some());
    let sizes = |misses: &[Miss]| -> Vec<Option<Number>> {
        misses
            .iter()
            .map(|m| Some(significant(mm_from_m(m.length_m), 4)))
            .collect()
    };
    let (label, unit, first, second) = if of_joint {
        let arms = arms(problem, &found.estimate, site);
        let angles = |misses: &[Miss]| -> Vec<Option<Number>> {
            let pairs = misses.iter().zip(&arms);
            pairs
                .map(|(m, arm)| as_angle(m, *arm).map(|a| significant(a, 4)))
                .collect()
        };
        (
            format!("residual as an angle of joint {}", site + 1),
            "deg",
            angles(&before),
            angles(&after),
        )
    } else {
        ("residual".to_owned(), "mm", sizes(&before), sizes(&after))
    };
    let name = format!("effect-{}", number + 1);
    let values = against.values.iter().map(|v| v.map(|v| significant(v, 6)));
    let table = Table {
        columns: vec![
            Column::numbers(&against.label, against.unit, values),
            Column::numbers(&format!("{label} without it"), unit, first),
            Column::numbers(&format!("{label} with it"), unit, second),
        ],
    };
    page.tables.insert(name.clone(), table);
    let mut chart = Chart::new(
        &format!("{}. {}", number + 1, one.effect.label()),
        &name,
        Axis::new(&against.label, against.unit),
        Axis::new(&label, unit),
    );
    chart.note = format!(
        "{} Without it: everything else fitted again.",
        of.effects[number].sentence
    );
    chart
        .series
        .push(Series::new(Kind::Dots, 0, 1, "without it", Tone::Before));
    chart
        .series
        .push(Series::new(Kind::Dots, 0, 2, "with it", Tone::After));
    page.sections.push(Section::Chart(chart));
}

fn show_evidence(page: &mut Page, of: &Diagnosis) {
    if of.effects.is_empty() {
        return;
    }
    // a row for each parameter
    type Row<'a> = (&'a FoundEffect, &'static str, f64, f64, &'static str);
    let rows: Vec<Row> = of
        .effects
        .iter()
        .flat_map(|f| {
            let sought = f.effect.values.iter();
            sought.filter_map(move |(key, value, unit)| {
                let sigma = f.sigma.get(*key)?.as_f64().unwrap_or(f64::NAN);
                Some((f, *key, *value, sigma, *unit))
            })
        })
        .collect();
    let evidence = |row: &Row| row.0.evidence.clone();
    let table = Table {
        columns: vec![
            Column::texts("effect", rows.iter().map(|r| r.0.effect.label.clone())),
            Column::texts("parameter", rows.iter().map(|r| r.1.to_owned())),
            Column::numbers("value", "", rows.iter().map(|r| significant(r.2, 5))),
            Column::numbers("sigma", "", rows.iter().map(|r| significant(r.3, 2))),
            Column::texts("unit", rows.iter().map(|r| r.4.to_owned())),
            Column::numbers(
                "fall of chi-squared",
                "",
                rows.iter()
                    .map(|r| evidence(r).chi_squared_fall.map(|x| significant(x, 4))),
            ),
            Column::probabilities("p", rows.iter().map(|r| evidence(r).p_value)),
            Column::texts(
                "found again",
                rows.iter().map(|r| {
                    let e = evidence(r);
                    format!("{} of {}", e.found_again, e.found_again_of)
                }),
            ),
            Column::texts(
                "by hand",
                rows.iter()
                    .map(|r| Some("yes".to_owned()).filter(|_| evidence(r).accepted_by_hand)),
            ),
        ],
    };
    page.show(
        "evidence",
        "Evidence",
        "The fall of chi-squared and its probability by chance \
        belong to the effect, not to the single parameter.",
        table,
    );
}

fn show_residuals(page: &mut Page, of: &Diagnosis) {
    let (found, lines) = (&of.found, &of.lines);
    let problem = &found.problem;
    let after = misses(problem, &found.estimate);
    let line = |row: &Row| lines.get(row.measurement).copied().unwrap_or(0);
    let lengths = |list: &[f64]| -> Vec<Number> {
        list.iter()
            .map(|l| significant(mm_from_m(*l), DIGITS))
            .collect()
    };
    let table = Table {
        columns: vec![
            Column::counts("line", problem.rows.iter().map(line)),
            Column::names(
                "tool",
                problem
                    .rows
                    .iter()
                    .map(|row| problem.tools[row.tool].name.as_str()),
            ),
            Column::numbers("residual, present model", "mm", lengths(&found.lengths.0)).to(4),
            Column::numbers("residual", "mm", lengths(&found.lengths.1)).to(4),
        ],
    };
    if table.rows() != found.lengths.0.len() || table.rows() != found.lengths.1.len() {
        return;
    }
    page.tables.insert("rows".into(), table);
    let mut points = Points {
        name: "points",
        title: "Measurements".into(),
        by: "residual",
        ..Points::default()
    };
    let mut at = Vec::new();
    for (row, miss) in problem.rows.iter().zip(&after) {
        let place = row.observed.point_m().unwrap_or(miss.expected_m);
        points.push(Some(place), Some(row.q));
        points.tool.push(u32::try_from(row.tool).unwrap_or(0));
        at.push(place);
    }
    points.error = found
        .lengths
        .1
        .iter()
        .map(|l| fixed(mm_from_m(*l), 5))
        .collect();
    points.first = super::programs::largest(&points.error);
    let seen = problem
        .rows
        .iter()
        .all(|row| row.observed.point_m().is_some());
    let vectors = |misses: &[Miss]| -> Vec<Vector> {
        misses
            .iter()
            .map(|m| [-m.gap[0], -m.gap[1], -m.gap[2]])
            .collect()
    };
    let mut paths = Vec::new();
    if seen {
        if let Some(bare) = found.bare.as_ref().filter(|_| !found.found.is_empty()) {
            paths.push(Path::vectors(
                "without the effects found",
                Tone::Before,
                &at,
                &vectors(&misses(problem, bare)),
            ));
        }
        paths.push(Path::vectors(
            "residual",
            Tone::After,
            &at,
            &vectors(&after),
        ));
    }
    let mut profile = problem.profile.clone();
    profile.world_from_base = found.estimate.world_from_base;
    let tools: Vec<_> = problem.tools.iter().map(|t| t.flange_from_tool).collect();
    page.sections.push(Section::Cell(Box::new(Cell {
        title: "Residuals in space".into(),
        note: "From each measured point to where the model expects it, magnified; the points' \
            colour is the residual."
            .into(),
        table: "rows".into(),
        robot: Some(Robot::of(&profile, &tools, None, &Meshes::default())),
        bodies: Vec::new(),
        points,
        paths,
        ellipsoids: Vec::new(),
        along: Along::No(false),
    })));
}
