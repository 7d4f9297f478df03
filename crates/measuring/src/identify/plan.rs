//! Which configurations to measure, before anything is measured.

pub use super::candidates::{Box3, Breach, Constraints, Guard, candidates};

use super::candidates::candidates_where;
use super::error::IdentifyError;
use super::exchange::{Chooser, Improved, SHORTLIST};
use super::identifiability::{
    Identifiable, Observability, identifiable, observability, singular_values,
};
use super::imagined::{Derivatives, imagined};
use super::parameters::{Parameter, Selection};
use super::problem::DEFAULT_SIGMA_M;
use super::random::Random;
use crate::model::external::Stand;
use crate::profile::{Mounted, Profile};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::ops::Range;

/// Parameters that random configurations tell too badly are given up only where even this part of
/// their standard deviations is too much: a chosen set tells more, and what was measured decides in
/// the end.
const GIVEN_UP: f64 = 0.3;
/// Candidates that each start is tried to be improved with at a time; the best of them with a whole
/// [`SHORTLIST`].
const TRIED: usize = 4;
/// Places of the base that configurations are drawn at.
const MOST_PLACES: usize = 2000;
/// Configurations that tell which parameters can be determined.
const SAMPLE: usize = 1000;

/// What to choose.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// How many configurations.
    pub count: usize,
    /// How many to choose from.
    pub candidates: usize,
    /// How many random sets to start from.
    pub starts: usize,
    /// Seed.
    pub seed: u64,
    /// Standard deviation of a coordinate, metres.
    pub sigma_m: f64,
    /// Whether orientations are measured too.
    pub poses: bool,
    /// Configurations that are in the set already, radians.
    pub given: Vec<[f64; 6]>,
    /// Where external axes stand in these; nothing without a track.
    pub given_stands: Vec<Stand>,
    /// At how many places of each axis of a track, evenly over its limits.
    pub stations: usize,
    /// What they must meet.
    pub constraints: Constraints,
}

/// A chosen set.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Joint angles, radians: the given ones first.
    pub joints: Vec<[f64; 6]>,
    /// Where external axes stand in each; nothing without a track.
    pub stands: Vec<Stand>,
    /// Indices of the candidates chosen.
    pub chosen: Vec<usize>,
    /// Parameters, determined or not.
    pub parameters: Vec<Parameter>,
    /// Which are determined.
    pub identifiable: Identifiable,
    /// Expected standard deviation of each determined parameter, SI.
    pub sigma: Vec<f64>,
    /// Indices of the set in SI units: metres a metre, a radian, a radian a newton metre.
    pub observability: Observability,
    /// O1 of each start, before the best of them is improved once more.
    pub starts_o1: Vec<f64>,
    /// Exchanges of the best start.
    pub exchanges: usize,
    /// Part of the random configurations that met the constraints.
    pub admitted: f64,
}

/// Chooses configurations that tell the parameters best: the largest determinant of the information
/// matrix, which is the largest O1, by exchanges from random sets.
///
/// # Errors
/// Constraints that cannot be met; fewer numbers than parameters; parameters that cannot be
/// determined at all.
pub fn plan(
    profile: &Profile,
    tool: &Mounted,
    selection: &Selection,
    request: &Request,
) -> Result<Plan, IdentifyError> {
    plan_telling(profile, tool, selection, request, &|_| true, &mut |_, _| ())
}

/// As [`plan`]; configurations that are not `admitted`, with the path from where they are
/// approached, are not drawn; `tell` hears how many of how many starts are done.
///
/// # Errors
/// As [`plan`].
#[allow(
    clippy::missing_panics_doc,
    reason = "what is expected holds by construction"
)]
pub fn plan_telling(
    profile: &Profile,
    tool: &Mounted,
    selection: &Selection,
    request: &Request,
    admitted: &(dyn Fn(&[f64; 6]) -> bool + Sync),
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Plan, IdentifyError> {
    let grid = stations(profile, request)?;
    let standing: Vec<Profile> = grid.iter().map(|stand| standing(profile, stand)).collect();
    let guards: Vec<Guard> = standing
        .iter()
        .map(|profile| Guard::new(profile, tool, &request.constraints))
        .collect();
    let (drawn, admitted) = candidates_where(&guards, request.candidates, request.seed, admitted)?;
    let (drawn_at, pool): (Vec<usize>, Vec<[f64; 6]>) = drawn.into_iter().unzip();
    let mut all = request.given.clone();
    all.extend(&pool);
    let (places, at) = placed(profile, request, drawn_at.iter().map(|place| &grid[*place]));
    // what some hundreds of configurations cannot tell apart, none can
    let every = all.len().div_ceil(SAMPLE).max(1);
    let mut sample: Vec<usize> = (0..all.len()).step_by(every).collect();
    // with every place that is used
    let used: BTreeSet<usize> = at.iter().copied().collect();
    for place in &used {
        if !sample.iter().any(|i| at[*i] == *place) {
            sample.extend(at.iter().position(|own| own == place));
        }
    }
    let joints: Vec<[f64; 6]> = sample.iter().map(|i| all[*i]).collect();
    let stands: Vec<&Stand> = sample.iter().map(|i| &places[at[*i]]).collect();
    let (problem, estimate) =
        imagined(profile, tool, selection, (&joints, &stands), request.poses)?;
    let each = problem.rows.len() / sample.len().max(1);
    let rows_of: Vec<Range<usize>> = (0..places.len())
        .map(|place| {
            let first = sample.iter().position(|i| at[*i] == place);
            let first = first.unwrap_or(0) * each;
            first..first + each
        })
        .collect();
    let derivatives =
        Derivatives::of_places(&problem, &estimate, (&all, &at), &rows_of, request.sigma_m);
    let given = request.given.len();
    let parameters = problem.parameters;
    let mut found = select(derivatives, parameters, (given, every), request, tell)?;
    found.joints.clone_from(&request.given);
    let chosen = found.chosen.iter();
    found.joints.extend(chosen.clone().map(|i| pool[*i]));
    let all = (0..given).chain(chosen.map(|i| given + i));
    found.stands = all.map(|i| places[at[i]].clone()).collect();
    found.admitted = admitted;
    Ok(found)
}

/// The best set of some candidates by their derivatives, those that are in the set already first;
/// every so manieth of them tells which parameters can be determined. Where the candidates are, the
/// caller knows.
///
/// # Errors
/// As [`plan`].
pub(super) fn select(
    derivatives: Derivatives,
    sought: Vec<Parameter>,
    (given, every): (usize, usize),
    request: &Request,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Plan, IdentifyError> {
    let pool = derivatives.count() - given;
    // standard deviations of as many configurations as are asked for
    let planned = (request.count + given) as f64;
    let noise = GIVEN_UP * request.sigma_m / DEFAULT_SIGMA_M
        * (derivatives.count().div_ceil(every) as f64 / planned).sqrt();
    let normal = derivatives.normal(every, DEFAULT_SIGMA_M / request.sigma_m, &sought);
    let known = identifiable(&normal, &sought, Some(noise));
    if known.kept.is_empty() {
        return Err(IdentifyError::Suspicious {
            message: format!(
                "none of {} parameters shows in these configurations",
                sought.len()
            ),
            hint: "look for a number out of all bounds in the masses and effects of the profile \
                   and in the tool"
                .into(),
        });
    }
    let parameters: Vec<Parameter> = known.kept.iter().map(|i| sought[*i].clone()).collect();
    let per_row = derivatives.height;
    if (request.count + given) * per_row < parameters.len() || request.count > pool {
        return Err(IdentifyError::TooFew {
            numbers: (request.count + given) * per_row,
            rows: request.count.min(pool) + given,
            parameters: parameters.len(),
        });
    }
    let derivatives = derivatives.by(&known.kept).in_fewer_rows();
    let width = parameters.len();
    let chooser = Chooser::new(&derivatives, given);
    let count = request.count + given;
    // O1 in SI units: the scales and the standard deviation are taken out again
    let scales: f64 = parameters
        .iter()
        .map(|p| (p.scale / request.sigma_m).ln())
        .sum();
    let o1 = |log_determinant: f64| {
        ((0.5 * log_determinant - scales) / width as f64).exp() / (count as f64).sqrt()
    };
    let mut random = Random::new(request.seed ^ 0x5eed);
    let starts = request.starts.max(1);
    let mut starts_o1 = Vec::new();
    let mut best: Option<Improved> = None;
    while starts_o1.len() < starts {
        tell(starts_o1.len(), starts);
        let side_by_side = rayon::current_num_threads().min(starts - starts_o1.len());
        let drawn: Vec<Vec<usize>> = (0..side_by_side)
            .map(|_| chooser.draw(request.count, &mut random))
            .collect();
        let improve = |set| chooser.improve(set, TRIED);
        let improved: Vec<Improved> = drawn.into_par_iter().map(improve).collect();
        for found in improved {
            starts_o1.push(o1(found.log_determinant));
            let least = best.as_ref().map(|best| best.log_determinant);
            if least.is_none_or(|least| found.log_determinant > least) {
                best = Some(found);
            }
        }
    }
    let best = best.expect("at least one start");
    let (mut chosen, mut exchanges) = (best.set, best.exchanges);
    // the best of them once more, with more candidates
    let more = chooser.improve(chosen, SHORTLIST);
    chosen = more.set;
    exchanges += more.exchanges;
    chosen.sort_unstable();
    let information = chooser.information(&chosen);
    let Some(factor) = information.clone().cholesky() else {
        return Err(IdentifyError::NoStart {
            reason: "no set of these configurations determines every parameter".into(),
        });
    };
    let covariance = factor.inverse();
    let sigma = parameters
        .iter()
        .enumerate()
        .map(|(i, p)| p.scale * covariance[(i, i)].sqrt())
        .collect();
    let mut r = factor.l().transpose();
    for (i, p) in parameters.iter().enumerate() {
        let by = request.sigma_m / p.scale;
        r.column_mut(i).scale_mut(by);
    }
    Ok(Plan {
        joints: Vec::new(),
        stands: Vec::new(),
        chosen,
        identifiable: known,
        parameters: sought,
        sigma,
        observability: observability(singular_values(&r), count),
        starts_o1,
        exchanges,
        admitted: 1.0,
    })
}

/// Where external axes may stand: every place of every axis of a track. Without a track there is
/// one, where nothing is said.
fn stations(profile: &Profile, request: &Request) -> Result<Vec<Stand>, IdentifyError> {
    let track = &profile.external.track;
    let mut grid = vec![Stand::default()];
    if track.is_empty() {
        return Ok(grid);
    }
    let given = request.given.len();
    let many = request
        .stations
        .saturating_pow(u32::try_from(track.len()).unwrap_or(u32::MAX));
    if request.stations < 2 || many > MOST_PLACES || given != request.given_stands.len() {
        return Err(IdentifyError::Suspicious {
            message: format!(
                "{} places along each axis of the track, and {} of {given} given configurations \
                 say where they are: at least 2 places and at most {MOST_PLACES} in all, and all",
                request.stations,
                request.given_stands.len()
            ),
            hint: "--stations 11, and columns e1_mm … in --given".into(),
        });
    }
    for axis in track {
        let places = (0..request.stations).map(|k| {
            let part = k as f64 / (request.stations - 1) as f64;
            axis.min_m + part * (axis.max_m - axis.min_m)
        });
        let places: Vec<f64> = places.collect();
        let longer = |stand: &Stand, place: f64| Stand {
            values: stand.values.iter().copied().chain([place]).collect(),
            directions: Vec::new(),
        };
        grid = grid
            .iter()
            .flat_map(|stand| places.iter().map(move |place| longer(stand, *place)))
            .collect();
    }
    Ok(grid)
}

/// The arm where a track has carried its base.
fn standing(profile: &Profile, stand: &Stand) -> Profile {
    if stand.values.is_empty() {
        return profile.clone();
    }
    let (origin, effects) = (profile.world_from_base.translation, profile.real_effects());
    let carried = profile.external.base_real(stand.at(), origin, &effects);
    Profile {
        world_from_base: carried * profile.world_from_base,
        ..profile.clone()
    }
}

/// The places that are used, and at which of them each configuration is: the given ones first.
fn placed<'a>(
    profile: &Profile,
    request: &'a Request,
    drawn: impl Iterator<Item = &'a Stand>,
) -> (Vec<Stand>, Vec<usize>) {
    let axes = profile.external.track.len();
    let given = request.given.iter().enumerate().map(|(k, _)| {
        let stand = request.given_stands.get(k);
        let values = stand.map_or(&[][..], |stand| &stand.values);
        Stand {
            values: values[..axes.min(values.len())].to_vec(),
            directions: Vec::new(),
        }
    });
    let mut places: Vec<Stand> = Vec::new();
    let at = given.chain(drawn.cloned()).map(|stand| {
        let known = places.iter().position(|known| *known == stand);
        known.unwrap_or_else(|| {
            places.push(stand);
            places.len() - 1
        })
    });
    let at = at.collect();
    (places, at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::normal::Normal;
    use crate::identify::parameters::Level;
    use crate::identify::robust::Loss;
    use nalgebra::DMatrix;

    #[test]
    fn an_exchanged_set_is_better_than_random_ones_and_meets_the_limits() {
        let profile = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))
            .expect("a shipped profile");
        let tool = profile.tool("artifact").expect("its tool");
        let mut selection = Selection::level(Level::Compliance);
        selection.fix = super::super::pick::Pick::parse_list("tool_frame").expect("a word");
        let request = |starts| Request {
            count: 20,
            candidates: 400,
            starts,
            seed: 3,
            sigma_m: 5e-5,
            poses: false,
            given: Vec::new(),
            given_stands: Vec::new(),
            stations: 11,
            constraints: Constraints {
                approach_rad: 0.09,
                ..Constraints::default()
            },
        };
        let one = plan(&profile, &tool, &selection, &request(1)).expect("a plan");
        let random: f64 = {
            let (pool, _) =
                candidates(&profile, &tool, &request(1).constraints, 400, 3).expect("a pool");
            let (problem, estimate) = imagined(
                &profile,
                &tool,
                &selection,
                (&pool[..20], &[&Stand::default(); 20]),
                false,
            )
            .expect("rows");
            let kept: Vec<Parameter> = one
                .identifiable
                .kept
                .iter()
                .map(|i| one.parameters[*i].clone())
                .collect();
            let mut r = Normal::of(&problem, &estimate, &kept, Loss::squares())
                .factor()
                .expect("full rank");
            for (i, p) in kept.iter().enumerate() {
                r.column_mut(i).scale_mut(DEFAULT_SIGMA_M / p.scale);
            }
            observability(singular_values(&r), 20).o1
        };
        assert!(
            one.observability.o1 > 1.1 * random,
            "{} {random}",
            one.observability.o1
        );
        assert!(one.observability.o1 > one.starts_o1[0] * (1.0 - 1e-6));
        for q in &one.joints {
            assert!(
                profile
                    .mechanism
                    .beyond_limit(&q.map(|x| x - 0.09), 1e-9)
                    .is_none()
            );
        }
        let several = plan(&profile, &tool, &selection, &request(4)).expect("a plan");
        let lonely = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .expect("a thread")
            .install(|| plan(&profile, &tool, &selection, &request(4)).expect("a plan"));
        assert_eq!(
            (&several.chosen, &several.starts_o1),
            (&lonely.chosen, &lonely.starts_o1)
        );
        assert!(several.observability.o1 >= one.observability.o1);
        // the set that is there already counts
        let mut grown = request(1);
        grown.given.clone_from(&one.joints);
        grown.count = 5;
        let grown = plan(&profile, &tool, &selection, &grown).expect("a plan");
        assert_eq!(grown.joints.len(), 25);
        assert!(
            grown
                .sigma
                .iter()
                .zip(&one.sigma)
                .all(|(new, old)| new < old)
        );
    }

    #[test]
    fn an_exchanged_set_beats_random_ones_by_what_a_numpy_exchange_does() {
        let profile = Profile::from_yaml(include_str!("../../../../robots/abb_irb120_thesis.yaml"))
            .expect("a shipped profile");
        let tool = profile.tool("artifact").expect("its tool");
        let mut selection = Selection::level(Level::Compliance);
        selection.fix =
            super::super::pick::Pick::parse_list("tool_frame,link_geometry:6.d_mm").expect("words");
        let request = Request {
            count: 50,
            candidates: 5000,
            starts: 10,
            seed: 1,
            sigma_m: 5e-5,
            poses: false,
            given: Vec::new(),
            given_stands: Vec::new(),
            stations: 11,
            constraints: Constraints::default(),
        };
        let found = plan(&profile, &tool, &selection, &request).expect("a plan");
        let (pool, _) = candidates(&profile, &tool, &request.constraints, 5000, 1).expect("a pool");
        let (problem, estimate) = {
            let none = Stand::default();
            let stands = vec![&none; pool.len()];
            imagined(&profile, &tool, &selection, (&pool, &stands), false).expect("rows")
        };
        let all = Derivatives::of_joints(&problem, &estimate, &pool, 0..1, 1.0);
        let all: Vec<DMatrix<f64>> = (0..5000).map(|i| all.columns(i).transpose()).collect();
        let mut random = Random::new(9);
        let width = problem.parameters.len();
        assert_eq!((width, found.identifiable.kept.len()), (30, 30));
        let scales: f64 = problem.parameters.iter().map(|p| p.scale.ln()).sum();
        let o1 = |set: &mut dyn Iterator<Item = usize>| {
            let mut m = DMatrix::zeros(width, width);
            for i in set {
                m.gemm_tr(1.0, &all[i], &all[i], 1.0);
            }
            let l = m.cholesky().expect("full rank").l();
            let logs: f64 = l.diagonal().iter().map(|x| x.ln()).sum();
            ((logs - scales) / 30.0).exp() / 50.0_f64.sqrt()
        };
        let same = o1(&mut found.chosen.iter().copied());
        assert!((same / found.observability.o1 - 1.0).abs() < 1e-6);
        let mean = (0..200)
            .map(|_| {
                o1(&mut (0..50)
                    .map(|_| random.below(5000))
                    .collect::<Vec<_>>()
                    .into_iter())
            })
            .sum::<f64>()
            / 200.0;
        println!(
            "random {mean:.4}, exchanged {same:.4}: {:.4} times",
            same / mean
        );
        // best of ten starts 0.2745, random 0.239 in the reference, in units of its own
        assert!(same > 0.2745 / 0.239 * mean, "{same} {mean}");

        // no exchange of one for another is worth it: det(M − JᵀJ + KᵀK) = det(M − JᵀJ) · det(I + K
        // (M − JᵀJ)⁻¹ Kᵀ)
        let sum = |set: &[usize]| {
            let mut m = DMatrix::zeros(width, width);
            for i in set {
                m.gemm_tr(1.0, &all[*i], &all[*i], 1.0);
            }
            m
        };
        let whole = sum(&found.chosen).determinant();
        let mut tried = 0;
        for out in 0..50 {
            let mut rest = found.chosen.clone();
            rest.remove(out);
            let rest = sum(&rest);
            let (without, inverse) = (
                rest.determinant(),
                rest.try_inverse().expect("49 are enough"),
            );
            for other in (out..5000)
                .step_by(50)
                .filter(|i| !found.chosen.contains(i))
            {
                let one = &all[other];
                let gain =
                    (DMatrix::identity(3, 3) + one * &inverse * one.transpose()).determinant();
                assert!(without * gain < whole * (1.0 + 1e-4), "{out} {other}");
                tried += 1;
            }
        }
        assert!(tried > 4900, "{tried}");
    }
}
