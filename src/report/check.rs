//! The text of `check`, and its `JUnit` XML.

use super::junit;
use super::text::{at_least, at_most, fixed, left_out};
use crate::check::baseline::{Comparison, text as baseline_text};
use crate::finding::{Finding, Severity};
use crate::task::check::{Checked, Move, Summary};
use std::collections::BTreeMap;

/// The text for people, without the findings.
#[must_use]
pub(crate) fn text(found: &Checked) -> String {
    let Summary {
        moves,
        unknown,
        max_path_error_deg,
        min_clearance_mm,
        collisions,
        nominal_collisions,
        too_near,
        uncertified,
        with_zone,
        ..
    } = found.summary;
    let mut lines = vec![format!(
        "{} file(s), {moves} moves",
        found.input.list().len()
    )];
    if unknown > 0 {
        lines.push(format!("  {unknown} moves could not be followed"));
    }
    let shown = |size_mm: Option<f64>, of: &Move| {
        let sigma = of.uncertainty_mm;
        let sigma = sigma.map_or(String::new(), |s| format!(" \u{b1} {s:.3}"));
        let file = match found.input.list() {
            [_] => String::new(),
            _ => format!("{} ", of.file),
        };
        format!("{}{sigma} mm ({file}line {})", fixed(size_mm, 3), of.line)
    };
    let most = |bound: Option<f64>| bound.map(|bound| at_most(bound, 3));
    let [mut at_poses, mut at_joints, mut along] = [const { None::<Move> }; 3];
    let larger = |worst: &mut Option<Move>, one: &Move, size: &dyn Fn(&Move) -> f64| {
        if worst.as_ref().is_none_or(|worst| size(one) >= size(worst)) {
            *worst = Some(one.clone());
        }
    };
    // where it is unknown where a move begins, its end alone is known
    let path_error = |one: &Move| one.max_path_error_mm.or(one.target_error_mm);
    let at_target = |one: &Move| one.target_error_mm.unwrap_or(0.0);
    for one in found.moves.iter() {
        let worst = if one.joint_target {
            &mut at_joints
        } else {
            &mut at_poses
        };
        larger(worst, &one, &at_target);
        if path_error(&one).is_some() {
            larger(&mut along, &one, &|one| path_error(one).unwrap_or(0.0));
        }
    }
    if let Some(worst) = at_poses {
        let worst = shown(worst.target_error_mm, &worst);
        lines.push(format!("  at targets     the real tool is up to {worst}"));
    }
    if let Some(worst) = at_joints {
        lines.push(format!(
            "  joint targets  up to {}; compensate leaves them as they are",
            shown(worst.target_error_mm, &worst)
        ));
    }
    if let Some(worst) = along {
        lines.push(format!(
            "  along the path never more than {}, {} deg",
            shown(most(path_error(&worst)), &worst),
            fixed(most(max_path_error_deg), 3)
        ));
    }
    if let Some(least) = min_clearance_mm {
        lines.push(format!(
            "  clearance      never less than {:.3} mm; {collisions} moves touch something, \
             {too_near} come too near",
            at_least(least, 3)
        ));
        if nominal_collisions > 0 {
            lines.push(format!(
                "                 the nominal arm touches something on {nominal_collisions} moves"
            ));
        }
    }
    if uncertified > 0 {
        lines.push(format!(
            "  {uncertified} moves are known by samples only (-v says which and why)"
        ));
    }
    if with_zone > 0 {
        lines.push(format!(
            "  {with_zone} moves have a corner that the robot cuts; the path here goes through it"
        ));
    }
    lines.extend(left_out(&found.summary.left_out));
    let mut text = lines.join("\n") + "\n";
    if let Some(comparison) = found.baseline {
        text += &baseline_text(comparison);
    }
    text
}

/// `JUnit` XML: one suite a file, one case a move; error findings and what got worse are failures.
#[must_use]
pub(crate) fn junit(found: &Checked, comparison: Option<&Comparison>) -> String {
    let mut failures: BTreeMap<(&str, usize), Vec<String>> = BTreeMap::new();
    let errors = found
        .findings
        .iter()
        .filter(|f| f.severity == Severity::Error);
    for Finding {
        id,
        file,
        line,
        message,
        ..
    } in errors
    {
        let list = failures.entry((file, *line)).or_default();
        list.push(format!("{id}: {message}"));
    }
    for difference in comparison.iter().flat_map(|c| &c.worse) {
        let line = usize::try_from(difference.line).unwrap_or(0);
        let message = format!(
            "worse: {} {} -> {}",
            difference.what, difference.before, difference.now
        );
        failures
            .entry((&difference.file, line))
            .or_default()
            .push(message);
    }
    let mut suites = Vec::new();
    let mut moves = found.moves.iter().peekable();
    for input in found.input.list() {
        let mut cases = Vec::new();
        // the moves of a file stand together, files in their order
        while let Some(entry) = moves.next_if(|entry| entry.file == *input) {
            let found = failures.remove(&(input.as_str(), entry.line));
            let target = entry.name.as_deref().unwrap_or("target");
            let name = format!("line {}: {} to {target}", entry.line, entry.kind);
            cases.push((name, found.unwrap_or_default()));
        }
        // what belongs to no move: the whole file, a declaration, a move that is gone
        let rest: Vec<_> = failures
            .keys()
            .filter(|key| key.0 == input)
            .copied()
            .collect();
        for key in rest {
            let found = failures.remove(&key);
            cases.push((format!("line {}", key.1), found.unwrap_or_default()));
        }
        suites.push(junit::Suite { name: input, cases });
    }
    // files that are no program of the run: a mesh, a program that is gone
    for ((name, line), found) in failures {
        let case = (format!("line {line}"), found);
        match suites.last_mut().filter(|suite| suite.name == name) {
            Some(suite) => suite.cases.push(case),
            None => suites.push(junit::Suite {
                name,
                cases: vec![case],
            }),
        }
    }
    junit::xml("poseshift check", &suites)
}
