//! Why an effect that a person wants is not in the model.

use super::attempt::Attempt;
use crate::diagnose::estimator::gain::shows;
use crate::diagnose::estimator::table::dot;
use crate::diagnose::search::World;
use crate::diagnose::search::candidates::{Candidate, least};
use crate::diagnose::search::scan::ROWS_GIVEN;
use crate::model::effects::Need;

/// An effect that a person wants and that is not in the model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotTaken {
    /// As a person asks for it.
    pub word: String,
    /// Why.
    pub why: String,
}

/// Effects that a person wants and that are not in the model, with the reason for each. What cannot
/// be tested for want of a column, or is not named wholly, is not among them.
pub(crate) fn not_taken(attempt: &Attempt, world: &World) -> Vec<NotTaken> {
    let mut all = Vec::new();
    for pick in world.accepted {
        let is_taken = attempt
            .chosen
            .iter()
            .any(|c| pick.means(&c.candidate.effect));
        let own: Vec<&Candidate> = (world.candidates.list.iter())
            .filter(|c| {
                let is_step = c.row.is_some() && pick.kind == Some(c.effect.kind);
                !c.is_measure && (is_step || pick.means(&c.effect))
            })
            .collect();
        if is_taken || own.is_empty() {
            continue;
        }
        all.push(NotTaken {
            word: pick.to_word(),
            why: why(attempt, world, &own),
        });
    }
    all
}

/// Why none of some candidates is in the model.
fn why(attempt: &Attempt, world: &World, own: &[&Candidate]) -> String {
    if own[0].row.is_some() {
        return format!(
            "what begins at a row is sought where {ROWS_GIVEN} rows or more are before and behind it"
        );
    }
    let normal = &world.normal;
    let fit = normal.plain();
    let columns = own.iter().flat_map(|c| &c.columns);
    let (mut any, mut more) = (false, false);
    for index in columns {
        let column = world.candidates.columns[*index].column();
        let taken = normal.taken(&fit, &column, &normal.products(&column));
        let all = fit.weighted(&column);
        let square = dot(&all, &all);
        any |= shows(square, square);
        more |= shows(square - dot(&taken, &taken), square);
    }
    let definition = own[0].effect.definition();
    if !any {
        return if definition.needs.contains(&Need::Masses) {
            "no load acts along it in these rows that would show it".to_owned()
        } else {
            "these rows do not show it: of its usual size it moves nothing by a tenth of the noise"
                .to_owned()
        };
    }
    if !more {
        return "it cannot be separated from what is fitted along: that does the same to these rows"
            .to_owned();
    }
    let problem = &attempt.session.problem;
    let bound = own.iter().find_map(|c| {
        let number = c
            .sought
            .iter()
            .find(|n| least(problem, &c.effect, **n).is_some())?;
        let parameter = &definition.parameters[*number];
        let low = least(problem, &c.effect, *number)? / parameter.unit.in_si();
        Some(format!(
            "its {} comes out below what is possible, {low}, and stays there",
            parameter.key
        ))
    });
    bound.unwrap_or_else(|| {
        "these rows ask for a value that no arm has, or do not determine it next to what else is \
         in the model"
            .to_owned()
    })
}
