//! What is missing of a positioner, from points on its plate that a device sees.
//!
//! The same search as of the arm's effects, on the rows of one positioner: its axes, zeros, scales,
//! waves and plate are the candidates; points whose coordinates nobody knows are fitted with them.
//!
//! Where the device stands, rows of the tool say. How well they do counts: with the
//! information `S` that these rows have of the base (what else was fitted with them projected out)
//! and the columns `D` of the device's place here (points projected out), what the place may have
//! absorbed is integrated out:
//!
//! ```text
//! I − D (S + DᵀD)⁻¹ Dᵀ = I − Σ a q qᵀ      a: eigenvalues of L⁻¹ DᵀD L⁻ᵀ, L Lᵀ = S + DᵀD;  q: columns of D L⁻ᵀ U, of length 1
//! ```
//!
//! so that each of these columns is held with the share `a` (see [`crate::diagnose::estimator::fit`]). An axis is
//! not blamed for a device that is known no better.

use crate::diagnose::diagnosis::{Diagnosis, Found, Options, Verdict};
use crate::diagnose::estimator::chances::{chi_squared_tail, normal_tail};
use crate::diagnose::estimator::fit::{Fit, Normal};
use crate::diagnose::estimator::table::{
    Column, Layout, Stored, add_scaled, dot, lengths_m, table,
};
use crate::diagnose::judgement::attempt::LOUDER;
use crate::diagnose::judgement::conclusion::corrected;
use crate::diagnose::judgement::{AGAIN, Against, CLEAR, EVIDENT, Standing, TIE, odds_of};
use crate::diagnose::question::LEAST;
use crate::diagnose::search::candidates::{Candidate, Candidates, columns_of};
use crate::diagnose::search::{Chosen, World, by_gain};
use crate::geometry::units::mm_from_m;
use crate::geometry::{Pose, Vector, sub};
use crate::identify::IdentifyError;
use crate::identify::measurements::Measurements;
use crate::identify::parameters::Subject;
use crate::identify::pick::Pick;
use crate::identify::plates::{Shown, shown};
use crate::identify::problem::{Estimate, Problem};
use crate::identify::statistics::Spread;
use crate::model::Motion;
use crate::model::effects::{Effect, Kind, MOST_PARAMETERS, Parameter, Seen, Site};
use crate::model::external::Listed;
use nalgebra::DMatrix;

/// Numbers of a place.
const PLACE: usize = 6;
/// Parts of the stops that are left out in turn.
const FOLDS: usize = 5;
/// Steps of a derivative, metres and radians.
const STEP: f64 = 1e-6;

/// What was found of one positioner.
#[derive(Clone, Debug)]
pub struct PlateDiagnosis {
    /// Its name.
    pub positioner: String,
    /// Rows looked at.
    pub rows: usize,
    /// At how many stops of its axes.
    pub stops: usize,
    /// The answer.
    pub verdict: Verdict,
    /// Why it is not more than that, one sentence each.
    pub reasons: Vec<String>,
    /// Effects, those first without which most is lost.
    pub found: Vec<Found>,
    /// Errors at stops that were left out in turn: of the present model, and with the effects
    /// found, mm.
    pub held_out: Option<(Spread, Spread)>,
    /// Noise of a coordinate, metres.
    pub noise_m: f64,
    /// The residual of a coordinate, metres.
    pub residual_m: f64,
}

/// Looks for what is missing of each positioner whose plate these rows are on, after the arm was
/// diagnosed with rows of the tool of the same session.
///
/// # Errors
/// Points that are nowhere near where the axes take them, or whose coordinates do not follow.
pub fn diagnose_plates(
    arm: &Diagnosis,
    plates: &Measurements,
    options: &Options,
) -> Result<Vec<PlateDiagnosis>, IdentifyError> {
    let profile = &arm.profile;
    let all = &*plates.in_world_of(profile)?;
    let device = Device::of(arm);
    let mut found = Vec::new();
    for positioner in &profile.external.positioners {
        let own = |name: &Option<String>| {
            let name = name.as_deref().unwrap_or_default();
            positioner.name.eq_ignore_ascii_case(name)
        };
        let rows = all.filtered(|_, row| own(&row.plate));
        if rows.rows.is_empty() {
            continue;
        }
        let shown = shown(profile, &rows)?;
        found.push(One::of(shown, &device).diagnosis(&positioner.name, options));
    }
    Ok(found)
}

/// How well the place of the device is known.
struct Device {
    /// The information that rows of the tool have of the base's six numbers, in their typical
    /// sizes; none where the device's frame is the world.
    known: Option<DMatrix<f64>>,
    /// Where what is seen goes in the world with each number a step smaller, and larger.
    moved: Vec<[Pose; 2]>,
}

impl Device {
    fn of(arm: &Diagnosis) -> Self {
        let base = arm.profile.world_from_real_base();
        let (problem, estimate) = (&arm.problem, &arm.estimate);
        let effect = base_frame(estimate);
        let at = |by: Option<(usize, f64)>| {
            let mut p = effect.parameters;
            if let Some((k, by)) = by {
                p[k] += by;
            }
            Pose::from_xyz_rxryrz(p)
        };
        // what is seen moves against the base
        let moved = |k, by| base * at(Some((k, by))).inverse() * at(None) * base.inverse();
        let is_seen = arm.profile.device.is_some();
        Self {
            known: is_seen.then(|| information(problem, estimate, arm.absorbed)),
            moved: (0..PLACE)
                .map(|k| [moved(k, -STEP), moved(k, STEP)])
                .collect(),
        }
    }

    /// What a point that is seen there does when a number of the device's place grows, metres by
    /// metre or radian.
    fn slope(&self, k: usize, seen_m: Vector) -> Vector {
        let [low, high] = &self.moved[k];
        sub(high.transform(seen_m), low.transform(seen_m)).map(|x| x / (2.0 * STEP))
    }

    /// What each number of the place does to every number measured, in its typical size.
    fn columns(&self, problem: &Problem, estimate: &Estimate) -> Vec<Column> {
        let models = problem.models(estimate, &[]);
        let of = |(k, definition): (usize, &Parameter)| {
            let size = definition.prior_sigma * definition.unit.in_si();
            let rows = problem.rows.iter().flat_map(|row| {
                let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut []);
                let seen = problem.observe(estimate, row, pose);
                let slope = seen.slope(&Motion {
                    turn_rad: [0.0; 3],
                    shift_m: self.slope(k, seen.expected_m()),
                });
                let weights = seen.weights();
                let numbers = 0..row.observed.count();
                numbers.map(move |i| -slope[i] * weights[i] * size)
            });
            rows.collect()
        };
        let parameters = Kind::BaseFrame.definition().parameters;
        parameters.iter().enumerate().map(of).collect()
    }

    /// Columns of the place and how freely each is fitted, next to others that are free.
    fn held(&self, columns: &[Column], free: &[Column]) -> Vec<(Column, f64)> {
        let Some(known) = &self.known else {
            return Vec::new();
        };
        let (gram, _) = without(free, columns);
        let Some(factor) = (known + &gram).cholesky() else {
            return Vec::new();
        };
        let lower = factor.l();
        let solved = lower.solve_lower_triangular(&gram);
        let turned = solved.and_then(|x| lower.solve_lower_triangular(&x.transpose()));
        let Some(turned) = turned else {
            return Vec::new();
        };
        let eigen = turned.symmetric_eigen();
        let Some(modes) = lower
            .transpose()
            .solve_upper_triangular(&eigen.eigenvectors)
        else {
            return Vec::new();
        };
        let of = |mode: usize| {
            let mut column = vec![0.0; columns[0].len()];
            for (k, own) in columns.iter().enumerate() {
                add_scaled(&mut column, modes[(k, mode)], own);
            }
            (column, eigen.eigenvalues[mode].clamp(0.0, 1.0))
        };
        (0..PLACE).map(of).collect()
    }
}

/// The Gram matrix of columns when others that are free have taken their part, and how many of those
/// are not redundant.
fn without(free: &[Column], columns: &[Column]) -> (DMatrix<f64>, usize) {
    let numbers = columns.first().map_or(0, Vec::len);
    let (layout, used) = (Layout::of_counts([numbers]), [true]);
    let (nothing, shares) = (vec![0.0; numbers], vec![1.0; free.len()]);
    let fit = Normal::of((&layout, &used), &nothing, (free, &shares), 0.0).plain();
    let partial: Vec<Column> = columns.iter().map(|c| fit.partial(free, c)).collect();
    let gram = |i: usize, j: usize| dot(&partial[i], &partial[j]);
    let count = columns.len();
    (DMatrix::from_fn(count, count, gram), fit.shares.len())
}

fn base_frame(estimate: &Estimate) -> Effect {
    let mut effects = estimate.effects.iter();
    let known = effects.find(|effect| effect.kind == Kind::BaseFrame);
    known.cloned().unwrap_or_else(|| Effect {
        kind: Kind::BaseFrame,
        site: Site::default(),
        parameters: [0.0; MOST_PARAMETERS],
    })
}

/// The information about the base's six numbers, in their typical sizes: all else that was fitted is
/// projected out.
fn information(problem: &Problem, estimate: &Estimate, absorbed: bool) -> DMatrix<f64> {
    let base = (base_frame(estimate), (0..PLACE).collect::<Vec<_>>());
    let own: Vec<Column> = columns_of(problem, estimate, &[base]).remove(0);
    let (residual, columns) = table(problem, estimate, &problem.parameters);
    let fitted = |subject: Subject| match subject {
        Subject::Effect(slot) => absorbed && estimate.effects[slot.effect].kind != Kind::BaseFrame,
        Subject::Point { .. } | Subject::Feature { .. } => true,
    };
    let both = problem.parameters.iter().zip(columns);
    let others = both.filter(|(parameter, _)| fitted(parameter.subject));
    let others: Vec<Column> = others.map(|(_, column)| column).collect();
    let (gram, fitted) = without(&others, &own);
    let freedom = residual.len().saturating_sub(fitted + PLACE).max(1);
    let mut variance = dot(&residual, &residual) / freedom as f64;
    if !problem.sigma_assumed {
        variance = variance.max(1.0);
    }
    gram / variance.max(LEAST)
}

/// The rows of one positioner.
struct One {
    problem: Problem,
    estimate: Estimate,
    layout: Layout,
    residual: Column,
    held: Vec<Column>,
    /// How freely each is fitted.
    shares: Vec<f64>,
    effects: Vec<Effect>,
    stops: Vec<usize>,
    still: Vec<String>,
}

impl One {
    fn of(shown: Shown, device: &Device) -> Self {
        let Shown {
            problem,
            estimate,
            effects,
            still,
        } = shown;
        let (residual, mut held) = table(&problem, &estimate, &problem.parameters);
        let mut shares = vec![1.0; held.len()];
        for (column, share) in device.held(&device.columns(&problem, &estimate), &held) {
            held.push(column);
            shares.push(share);
        }
        let mut seen: Vec<Vec<u64>> = Vec::new();
        let stops = problem.rows.iter().map(|row| {
            let bits = row.stand.bits();
            let known = seen.iter().position(|known| *known == bits);
            known.unwrap_or_else(|| {
                seen.push(bits);
                seen.len() - 1
            })
        });
        Self {
            stops: stops.collect(),
            layout: Layout::of(&problem),
            problem,
            estimate,
            residual,
            held,
            shares,
            effects,
            still,
        }
    }

    fn candidates(&self, options: &Options) -> Candidates {
        let is_left = |effect: &Effect| options.reject.iter().any(|pick| pick.means(effect));
        let all = |effect: &Effect| (0..effect.definition().parameters.len()).collect();
        let kept = self.effects.iter().filter(|effect| !is_left(effect));
        let wanted: Vec<(Effect, Vec<usize>)> =
            kept.map(|effect| (effect.clone(), all(effect))).collect();
        let columns = columns_of::<Stored>(&self.problem, &self.estimate, &wanted);
        let mut candidates = Candidates::default();
        for ((effect, sought), own) in wanted.iter().cloned().zip(columns) {
            let first = candidates.columns.len();
            candidates.columns.extend(own);
            let alike = wanted.iter().filter(|(other, _)| other.kind == effect.kind);
            candidates.list.push(Candidate {
                columns: (first..candidates.columns.len()).collect(),
                least: vec![None; sought.len()],
                row: None,
                chosen: 0,
                steady: None,
                is_measure: false,
                peers: alike.count(),
                effect,
                sought,
            });
        }
        candidates
    }

    fn world<'a>(
        &'a self,
        candidates: &'a Candidates,
        used: &'a [bool],
        accepted: &'a [Pick],
    ) -> World<'a> {
        let floor = if self.problem.sigma_assumed {
            LEAST
        } else {
            1.0
        };
        let own = (&self.held[..], &self.shares[..]);
        World {
            layout: &self.layout,
            held: &self.held,
            candidates,
            used,
            normal: Normal::of((&self.layout, used), &self.residual, own, floor),
            numbers: self.problem.numbers() as f64,
            accepted,
        }
    }

    fn diagnosis(&self, name: &str, options: &Options) -> PlateDiagnosis {
        let of_positioner =
            |pick: &&Pick| pick.kind.is_some_and(|k| k.definition().of_positioner());
        let accepted: Vec<Pick> = options
            .accept
            .iter()
            .filter(of_positioner)
            .cloned()
            .collect();
        let candidates = self.candidates(options);
        let every = vec![true; self.layout.rows()];
        let world = self.world(&candidates, &every, &accepted);
        let chosen = by_gain(world.search(Vec::new()));
        let fit = world.fit(&chosen);
        let unused = LeftOut::of(self, &candidates, &chosen);
        let mut found = self.found(&world, &fit, &chosen, &accepted);
        let mut reasons = self.still.clone();
        for (one, times) in found.iter_mut().zip(&unused.again) {
            one.found_again = (*times, unused.parts);
            let is_plate = self.is_as_well_of_the_plate(&one.effect);
            stand(one, is_plate);
            if is_plate {
                reasons.push(format!(
                    "{} is the same as rz_deg of positioner_plate: no measurement separates them",
                    one.effect.label()
                ));
            }
        }
        let scale = fit.scale;
        let is_louder = !self.problem.sigma_assumed
            && chi_squared_tail(scale * scale * fit.freedom, fit.freedom) < normal_tail(LOUDER);
        if is_louder {
            reasons.push(format!(
                "the residual is {scale:.2} times the noise that sigma_mm states"
            ));
        }
        let is_better = unused
            .spreads
            .is_some_and(|(before, after)| after.rms < before.rms);
        let verdict = match (found.is_empty(), is_louder) {
            (true, false) => Verdict::NothingMissing,
            (false, false) => Verdict::Explained,
            (false, true) if is_better => Verdict::Improved,
            (_, true) => Verdict::Undetermined,
        };
        let mut sigmas: Vec<f64> = self.problem.rows.iter().map(|row| row.sigma_m).collect();
        sigmas.sort_by(f64::total_cmp);
        let sigma_m = sigmas[sigmas.len() / 2];
        let residual_m = scale * sigma_m;
        PlateDiagnosis {
            positioner: name.to_owned(),
            rows: self.problem.rows.len(),
            stops: self.stops.iter().max().map_or(0, |last| last + 1),
            verdict,
            reasons,
            found,
            held_out: unused.spreads,
            noise_m: if self.problem.sigma_assumed {
                residual_m
            } else {
                sigma_m
            },
            residual_m,
        }
    }

    /// Whether it is the zero of the last axis: the plate rotated on it is the same.
    fn is_as_well_of_the_plate(&self, effect: &Effect) -> bool {
        let axis = self
            .problem
            .profile
            .external
            .listed()
            .nth(effect.site.index);
        effect.kind == Kind::PositionerZero && matches!(axis, Some(Listed::Rotary(_, _, true)))
    }

    fn found(&self, world: &World, fit: &Fit, chosen: &[Chosen], accepted: &[Pick]) -> Vec<Found> {
        let first = self.held.len();
        let sought = chosen
            .iter()
            .map(|c| c.candidate.sought.len())
            .sum::<usize>();
        let values = fit.values(first + sought);
        let mut at = 0;
        let of = |one: &Chosen| {
            let candidate = &one.candidate;
            let range = at..at + candidate.sought.len();
            at = range.end;
            let mut effect = candidate.effect.clone();
            effect.parameters = [0.0; MOST_PARAMETERS];
            let mut sigmas = Vec::new();
            for (number, k) in candidate.sought.iter().zip(range) {
                let definition = &effect.definition().parameters[*number];
                let size = definition.prior_sigma * definition.unit.in_si();
                effect.parameters[*number] = values[first + k] * size;
                sigmas.push(fit.deviation(first + k) * size);
            }
            let against = one.alternatives.iter().map(|other| {
                let label = world.candidates.list[other.index].effect.label();
                (label, one.merit() - other.merit())
            });
            let against = against.filter(|(_, behind)| *behind < CLEAR);
            let mut against: Vec<Against> = against
                .map(|(what, behind)| Against {
                    what,
                    odds: odds_of(behind),
                })
                .collect();
            against.sort_by(|a, b| a.odds.total_cmp(&b.odds));
            let count = candidate.sought.len();
            Found {
                accepted: accepted.iter().any(|pick| pick.means(&effect)),
                p_value: corrected(one.gain, count, candidate.peers),
                bic: one.gain - count as f64 * fit.freedom.ln(),
                effect,
                was: None,
                sought: candidate.sought.clone(),
                sigmas,
                listed: None,
                gain: one.gain,
                before: None,
                after: None,
                found_again: (0, 0),
                seen: Seen::default(),
                in_profile: true,
                standing: Standing::Possible,
                against,
            }
        };
        chosen.iter().map(of).collect()
    }
}

/// How sure an effect is, by its own evidence and what may be in its place; one that is another as
/// well is no more than likely.
fn stand(one: &mut Found, is_another: bool) {
    let (times, of) = one.found_again;
    let tied = one.against.first().is_some_and(|a| a.odds < odds_of(TIE));
    let again = times as f64 >= AGAIN * of as f64;
    one.standing = if tied || 2 * times < of {
        Standing::Possible
    } else if one.against.is_empty() && again && !is_another && one.p_value < EVIDENT {
        Standing::Certain
    } else {
        Standing::Likely
    };
}

/// What the effects found are worth at stops that were not used.
struct LeftOut {
    parts: usize,
    /// In how many parts each is found again.
    again: Vec<usize>,
    spreads: Option<(Spread, Spread)>,
}

impl LeftOut {
    fn of(one: &One, candidates: &Candidates, chosen: &[Chosen]) -> Self {
        let parts = FOLDS.min(one.stops.iter().max().map_or(0, |last| last + 1));
        let mut again = vec![0; chosen.len()];
        let mut lengths = [Vec::new(), Vec::new()];
        for part in 0..parts {
            let is_out = |row: usize| one.stops.get(row).is_some_and(|stop| stop % parts == part);
            let used: Vec<bool> = (0..one.layout.rows()).map(|row| !is_out(row)).collect();
            let world = one.world(candidates, &used, &[]);
            let anew = world.search(Vec::new());
            let same = |a: &Effect, b: &Effect| a.kind == b.kind && a.site == b.site;
            for (times, own) in again.iter_mut().zip(chosen) {
                let own = &own.candidate.effect;
                *times += usize::from(anew.iter().any(|c| same(&c.candidate.effect, own)));
            }
            for (lengths, model) in lengths.iter_mut().zip([&[][..], chosen]) {
                let all = lengths_m(&one.problem, &one.layout, &world.rest(model));
                let out = all.into_iter().enumerate().filter(|(row, _)| is_out(*row));
                lengths.extend(out.map(|(_, length)| mm_from_m(length)));
            }
        }
        let [before, after] = lengths;
        Self {
            parts,
            again,
            spreads: Spread::of(&before).zip(Spread::of(&after)),
        }
    }
}
