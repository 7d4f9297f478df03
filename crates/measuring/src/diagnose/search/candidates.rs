//! Every effect that the columns allow, at every joint, order and time constant it may have.

use super::tried::{Tried, choice, variants};
use super::waves;
use crate::diagnose::estimator::fit::Normal;
use crate::diagnose::estimator::gain::shows;
use crate::diagnose::estimator::table::{Numbers, Stored, dot, table_into};
use crate::identify::clock::Late;
use crate::identify::external::places;
use crate::identify::measurements::{DIRECTION_COLUMNS, Measurements, Observed};
use crate::identify::needs::{has_points, too_even_c};
use crate::identify::parameters::{Parameter, Subject};
use crate::identify::problem::{Estimate, Problem};
use crate::model::effects::{
    BASE, Effect, Kind, MOST_PARAMETERS, Need, Site, SiteKey, shown_by_tool,
};
use crate::model::{JOINTS, Slot};
use crate::profile::{Mounted, Profile};
use rayon::prelude::*;

/// Harmonics are sought up to this many periods a revolution.
pub const MOST_ORDERS: u32 = 12;
/// Odds of a moved zero against backlash where a joint comes from one side only, which do the same:
/// zeros are in every calibration, and rows from one side are measured to keep backlash out.
const ODDS_OF_A_ZERO: usize = 12;
/// One effect at one place, with the parameters that are sought; others are held.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The effect: its place, and the values of the parameters that are not sought (a knee's
    /// torque, a time constant).
    pub effect: Effect,
    /// Which parameters are sought.
    pub sought: Vec<usize>,
    /// Indices of their columns, in the parameters' typical sizes.
    pub columns: Vec<usize>,
    /// Smallest values, in typical sizes.
    pub least: Vec<Option<f64>>,
    /// First row, from 1, for an effect that begins during the session; the columns hold from row
    /// 1.
    pub row: Option<u32>,
    /// Parameters that were chosen from a list (a torque, a time constant): they count like fitted
    /// ones.
    pub chosen: usize,
    /// How many of its kind it was chosen from, places or first rows times the sets of parameters
    /// that may be sought there: the choice costs twice the logarithm.
    pub peers: usize,
    /// For a drift with a short constant the candidate that is the same from the first row on: it
    /// counts where it explains clearly more than that.
    pub steady: Option<usize>,
    /// It is no answer, but what others are held against.
    pub is_measure: bool,
}

impl Candidate {
    /// The effect with values of the parameters sought, in their typical sizes, on top of its own.
    #[must_use]
    pub fn with(&self, values: &[f64]) -> Effect {
        let mut effect = self.effect.clone();
        for (number, value) in self.sought.iter().zip(values) {
            let definition = &effect.definition().parameters[*number];
            effect.parameters[*number] += value * definition.prior_sigma * definition.unit.in_si();
        }
        effect
    }

    /// Whether an arm may have these values. Where a base or a tool stands is no error of an arm.
    #[must_use]
    pub fn is_usual(&self, values: &[f64]) -> bool {
        matches!(self.effect.kind, Kind::BaseFrame | Kind::ToolFrame)
            || self.with(values).beyond_usual().is_none()
    }

    /// The same effect at the same place, whatever its values.
    #[must_use]
    pub fn same_effect(&self, other: &Self) -> bool {
        let (a, b) = (&self.effect, &other.effect);
        let steps = self.row.is_some() && a.site.index == b.site.index;
        a.kind == b.kind && (a.site == b.site || steps)
    }
}

/// An effect that cannot be tested, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CannotTest {
    /// The effect.
    pub kind: Kind,
    /// What is missing, in words of the files.
    pub missing: String,
}

/// All candidates with their columns.
#[derive(Clone, Debug, Default)]
pub struct Candidates {
    /// The candidates.
    pub list: Vec<Candidate>,
    /// Their columns.
    pub columns: Vec<Stored>,
    /// Effects that cannot be tested.
    pub cannot_test: Vec<CannotTest>,
    /// Joints that come to all rows from one side: of these backlash is a moved zero.
    pub one_sided: [bool; JOINTS],
    /// Length of the session, seconds and rows.
    pub(super) length: (f64, f64),
}

/// Whether an effect at a tool is one of the tool that is measured: the profile has others, and no
/// such effect of all.
fn is_of_one_tool(kind: Kind, profile: &Profile, measured: usize) -> bool {
    let mut own = profile.effects.iter().filter(|own| own.kind == kind);
    let is_of_all = own.any(|own| own.site.tool.is_none());
    // where a frame is, is written into the tool itself
    measured > 1 || kind != Kind::ToolFrame && profile.tools.len() > 1 && !is_of_all
}

/// `tools`: names of the tools measured, where an effect is of each. `stood`: at how many places each
/// axis of the track stood. `points`: how many of the tool are named.
fn sites(kind: Kind, tools: &[String], stood: &[usize], points: usize) -> Vec<Site> {
    let mut all = vec![Site {
        order: 1,
        ..Site::default()
    }];
    for place in kind.definition().site {
        let each = |site: &Site| -> Vec<Site> {
            let with = |change: &dyn Fn(&mut Site)| {
                let mut site = site.clone();
                change(&mut site);
                site
            };
            match place {
                SiteKey::Link | SiteKey::Joint => {
                    (0..JOINTS).map(|i| with(&|s| s.index = i)).collect()
                }
                SiteKey::JointOrBase => (0..=BASE).map(|i| with(&|s| s.index = i)).collect(),
                SiteKey::On => (0..JOINTS).map(|i| with(&|s| s.on = i)).collect(),
                SiteKey::Order => (1..=MOST_ORDERS)
                    .map(|n| with(&|s| s.order = n * place.one()))
                    .collect(),
                SiteKey::Tool if !tools.is_empty() => tools
                    .iter()
                    .map(|t| with(&|s| s.tool = Some(t.clone())))
                    .collect(),
                SiteKey::Tool | SiteKey::Row => vec![site.clone()],
                SiteKey::Point => (0..points).map(|i| with(&|s| s.index = i)).collect(),
                SiteKey::Axis => (0..stood.len()).map(|i| with(&|s| s.index = i)).collect(),
                SiteKey::Along(_) | SiteKey::About(_) => {
                    let (low, high) = place.numbers().unwrap_or_default();
                    let letters = (low..=high).map(|n| n as usize - 1);
                    letters.map(|on| with(&|s| s.on = on)).collect()
                }
                SiteKey::Degree(low, high) => {
                    // more places than numbers
                    let most = stood.get(site.index).map_or(0, |n| n.saturating_sub(2));
                    let most = u32::try_from(most).unwrap_or(u32::MAX).min(*high);
                    (*low..=most).map(|n| with(&|s| s.order = n)).collect()
                }
                // a period is not sought
                SiteKey::Period => Vec::new(),
            }
        };
        all = all.iter().flat_map(each).collect();
    }
    let on = kind.definition().site.contains(&SiteKey::On);
    all.retain(|site| !on || site.index != site.on);
    all
}

/// The smallest value of a parameter that is physical, SI.
pub(crate) fn least(problem: &Problem, effect: &Effect, parameter: usize) -> Option<f64> {
    let search = &effect.definition().search;
    if search.mass == Some(parameter) {
        let own = |tool: &&Mounted| effect.site.is_of_tool(&tool.name);
        let masses = problem.tools.iter().filter(own);
        let masses = masses.map(|tool| tool.load.map_or(0.0, |(mass, _)| mass));
        return masses.reduce(f64::min).map(|mass| -mass);
    }
    search.never_negative.contains(&parameter).then_some(0.0)
}

/// Largest less smallest.
pub(crate) fn range(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    (high - low).max(0.0)
}

/// Joints that come to all rows from one side, where that is known.
fn one_sided(problem: &Problem, measurements: &Measurements) -> [bool; JOINTS] {
    let is_known = measurements.has(&DIRECTION_COLUMNS);
    std::array::from_fn(|joint| {
        let mut all = problem.rows.iter().map(|r| r.conditions.direction[joint]);
        let first = all.next().unwrap_or_default();
        is_known && first != 0.0 && all.all(|direction| direction == first)
    })
}

/// What an effect lacks.
fn missing(kind: Kind, problem: &Problem, measurements: &Measurements) -> Option<String> {
    let rows = &problem.rows;
    for need in kind.definition().needs {
        let lacks = match need {
            Need::Masses => {
                let any = !problem.profile.bodies.is_empty()
                    || problem.tools.iter().any(|t| t.load.is_some());
                (!any).then(|| need.describe().to_owned())
            }
            Need::Directions if !measurements.has(&DIRECTION_COLUMNS) => {
                Some(need.describe().to_owned())
            }
            Need::Directions => {
                let still = rows.iter().all(|r| r.conditions.direction == [0.0; 6]);
                still.then(|| "a direction in dir1…dir6: all are 0".to_owned())
            }
            Need::ExternalDirections => {
                let still = !rows.iter().any(|row| row.stand.is_directed());
                still.then(|| need.describe().to_owned())
            }
            Need::Temperature if !measurements.has(&["temperature_c"]) => {
                Some(need.describe().to_owned())
            }
            Need::Temperature => too_even_c(rows).map(|by| {
                format!("temperatures that differ: temperature_c ranges over {by:.2} degrees")
            }),
            Need::Time if !measurements.has(&["time_s"]) => Some(need.describe().to_owned()),
            Need::Time => {
                let times = || rows.iter().filter_map(|r| r.conditions.time_s);
                let constant = (range(times()) <= 0.0)
                    .then(|| "times that differ: time_s is constant".to_owned());
                constant.or_else(|| {
                    let late = Late::of(&measurements.rows)?;
                    Some(format!("times from switching the cold robot on: {late}"))
                })
            }
            Need::Order | Need::NoTime | Need::NoTemperature => {
                (rows.len() < 20).then(|| "at least 20 rows in order".to_owned())
            }
            Need::Moves => {
                let still = rows.iter().all(|r| r.conditions.moved == [0.0; 6]);
                still.then(|| need.describe().to_owned())
            }
            Need::Points => (!has_points(rows)).then(|| need.describe().to_owned()),
            Need::Load => {
                let none = problem.tools.iter().all(|t| t.load.is_none());
                none.then(|| need.describe().to_owned())
            }
            Need::Places => {
                let others = rows
                    .iter()
                    .any(|r| matches!(r.observed, Observed::Contact(_)));
                others.then(|| need.describe().to_owned())
            }
        };
        if lacks.is_some() {
            return lacks;
        }
    }
    None
}

/// The parameter of an effect that stands at this place of an estimate.
pub(crate) fn parameter(effect: usize, at: &Effect, number: usize) -> Parameter {
    let definition = &at.definition().parameters[number];
    Parameter {
        key: String::new(),
        subject: Subject::Effect(Slot {
            effect,
            parameter: number,
        }),
        unit: definition.unit,
        scale: definition.prior_sigma * definition.unit.in_si(),
        rank: 0,
        prior: None,
        asked: false,
    }
}

/// The columns of some parameters of effects that are not in the model, each on its own.
///
/// Effects that only deflect are added to the model at zero, all at once; others change the
/// geometry and are added one by one, or found in the model.
pub(crate) fn columns_of<C: Numbers>(
    problem: &Problem,
    estimate: &Estimate,
    wanted: &[(Effect, Vec<usize>)],
) -> Vec<Vec<C>> {
    let mut out: Vec<Vec<C>> = wanted.iter().map(|_| Vec::new()).collect();
    for deflecting in [true, false] {
        let mut with = estimate.clone();
        let mut parameters = Vec::new();
        let mut owners = Vec::new();
        for (index, (effect, sought)) in wanted.iter().enumerate() {
            if effect.definition().deflects != deflecting {
                continue;
            }
            let known = (!deflecting)
                .then(|| with.effects.iter().position(|e| e.same_place(effect)))
                .flatten();
            let at = known.unwrap_or_else(|| {
                with.effects.push(effect.clone());
                with.effects.len() - 1
            });
            for number in sought {
                parameters.push(parameter(at, effect, *number));
                owners.push(index);
            }
        }
        if parameters.is_empty() {
            continue;
        }
        let (_, columns) = table_into(problem, &with, &parameters);
        for (owner, column) in owners.into_iter().zip(columns) {
            out[owner].push(column);
        }
    }
    out
}

impl Candidates {
    /// Every candidate of the registry but those that `leave` out.
    #[must_use]
    pub fn of(
        problem: &Problem,
        estimate: &Estimate,
        measurements: &Measurements,
        tried: &Tried,
        leave: &dyn Fn(&Effect) -> bool,
    ) -> Self {
        let tools: Vec<String> = problem.tools.iter().map(|t| t.name.clone()).collect();
        let mut all = Self {
            one_sided: one_sided(problem, measurements),
            ..Self::default()
        };
        // one effect for each place and chosen value, with every parameter that some variant seeks
        let mut wanted: Vec<(Effect, Vec<usize>)> = Vec::new();
        let mut groups: Vec<(usize, Vec<usize>, usize, usize)> = Vec::new();
        let mut of_kind: Vec<usize> = Vec::new();
        let times = || problem.rows.iter().filter_map(|r| r.conditions.time_s);
        let length_s = range(times());
        // what a clock that begins late says is in the order of rows, too
        let has_time = length_s > 0.0 && Late::of(&measurements.rows).is_none();
        let has_temperature = measurements.has(&["temperature_c"]);
        let has_points = has_points(&problem.rows);
        let track = problem.profile.external.track.len();
        let mut stood = places(&problem.profile.external, measurements);
        stood.truncate(track);
        for kind in shown_by_tool().filter(|kind| track > 0 || !kind.of_track()) {
            let needs = kind.definition().needs;
            if has_time && needs.contains(&Need::NoTime)
                || has_temperature && needs.contains(&Need::NoTemperature)
                || !has_points && needs.contains(&Need::Points)
            {
                continue;
            }
            if let Some(missing) = missing(kind, problem, measurements) {
                all.cannot_test.push(CannotTest { kind, missing });
                continue;
            }
            let by_side = kind.definition().needs.contains(&Need::Directions);
            let mut places = 0;
            let each = is_of_one_tool(kind, &problem.profile, tools.len());
            let of_tools = if each { &tools[..] } else { &[] };
            for site in sites(kind, of_tools, &stood, problem.points.len()) {
                let mut any = false;
                let variants = variants(kind, &site, tried);
                let mut sets: Vec<&[usize]> = variants.iter().map(|(s, _)| s.as_slice()).collect();
                sets.dedup();
                let mut sets = sets.len();
                if by_side && all.one_sided[site.index] {
                    sets *= ODDS_OF_A_ZERO;
                }
                for (sought, value) in variants {
                    let mut parameters = [0.0; MOST_PARAMETERS];
                    if let Some((number, value)) = value {
                        parameters[number] = value;
                    }
                    let effect = Effect {
                        kind,
                        site: site.clone(),
                        parameters,
                    };
                    if leave(&effect) {
                        continue;
                    }
                    any = true;
                    let known = wanted.iter().rposition(|(e, _)| *e == effect);
                    let at = known.unwrap_or_else(|| {
                        wanted.push((effect, Vec::new()));
                        wanted.len() - 1
                    });
                    for number in &sought {
                        if !wanted[at].1.contains(number) {
                            wanted[at].1.push(*number);
                        }
                    }
                    let is_choice = choice(problem, &wanted[at].0).is_some();
                    groups.push((at, sought, usize::from(is_choice), sets));
                }
                places += usize::from(any);
            }
            of_kind.resize(groups.len(), places);
        }
        let columns = columns_of(problem, estimate, &wanted);
        let mut first = Vec::new();
        for own in columns {
            first.push(all.columns.len());
            all.columns.extend(own);
        }
        for ((at, sought, chosen, sets), places) in groups.into_iter().zip(of_kind) {
            let (effect, numbers) = &wanted[at];
            let definition = effect.definition();
            let present = estimate.effects.iter().find(|e| e.same_place(effect));
            let bound = |number: &usize| {
                let scale = definition.parameters[*number].prior_sigma
                    * definition.parameters[*number].unit.in_si();
                let now = present.map_or(0.0, |e| e.parameters[*number]);
                // where the profile has what no arm has, it may come nearer to what is possible
                least(problem, effect, *number).map(|low| ((low - now) / scale).min(0.0))
            };
            let place = |n: &usize| numbers.iter().position(|known| known == n);
            let columns = sought.iter().filter_map(place).map(|p| first[at] + p);
            let begins = definition.begins_at_a_row();
            all.list.push(Candidate {
                columns: columns.collect(),
                least: sought.iter().map(bound).collect(),
                effect: effect.clone(),
                sought,
                row: begins.then_some(1),
                steady: None,
                is_measure: false,
                chosen,
                peers: sets * if begins { problem.rows.len() } else { places },
            });
        }
        all.length = (length_s, problem.rows.len() as f64);
        all.hold_drifts(problem, estimate);
        all
    }

    /// Says of effects that they cannot be tested where `fitted` ones do all that they do.
    pub(crate) fn say_absorbed(&mut self, normal: &Normal, fitted: &[Effect]) {
        let fit = normal.plain();
        let columns = self.columns.par_iter().map(|column| {
            let column = column.column();
            let taken = normal.taken(&fit, &column, &normal.products(&column));
            let all = fit.weighted(&column);
            let square = dot(&all, &all);
            (
                shows(square, square),
                shows(square - dot(&taken, &taken), square),
            )
        });
        let columns: Vec<(bool, bool)> = columns.collect();
        let any = |kind: Kind, is: &dyn Fn(&(bool, bool)) -> bool| {
            let own = self.list.iter().filter(|c| c.row.is_none());
            let mut own = own.filter(|c| c.effect.kind == kind);
            own.any(|c| c.columns.iter().any(|i| is(&columns[*i])))
        };
        let is_absorbed = |kind: &Kind| any(*kind, &|c| c.0) && !any(*kind, &|c| c.1);
        let is_fitted = |kind: &Kind| fitted.iter().any(|effect| effect.kind == *kind);
        let absorbed = shown_by_tool().filter(|kind| !is_fitted(kind) && is_absorbed(kind));
        let absorbed: Vec<CannotTest> = absorbed
            .map(|kind| CannotTest {
                kind,
                missing: "a calibrated profile: what is fitted along does the same".to_owned(),
            })
            .collect();
        self.cannot_test.extend(absorbed);
    }

    /// Whether no candidate is this effect at this place.
    pub(crate) fn is_new(&self, effect: &Effect) -> bool {
        let is_it = |c: &Candidate| c.effect.kind == effect.kind && c.effect.site == effect.site;
        !self.list.iter().any(is_it)
    }

    /// Adds waves of orders that are not in the list.
    pub(crate) fn add_waves(
        &mut self,
        problem: &Problem,
        estimate: &Estimate,
        effects: Vec<Effect>,
    ) {
        let all = |e: Effect| (0..e.definition().parameters.len()).collect::<Vec<_>>();
        let wanted: Vec<_> = effects.into_iter().map(|e| (e.clone(), all(e))).collect();
        let columns = columns_of(problem, estimate, &wanted);
        for ((effect, sought), own) in wanted.into_iter().zip(columns) {
            let first = self.columns.len();
            self.columns.extend(own);
            self.list.push(Candidate {
                effect,
                columns: (first..self.columns.len()).collect(),
                least: vec![None; sought.len()],
                sought,
                row: None,
                steady: None,
                is_measure: false,
                chosen: 0,
                peers: waves::places(),
            });
        }
    }
}
