//! Measurements: `calibrate`, `validate`, `diagnose`, `plan`, `simulate`.

use crate::arrays::{Array, Numbers, array, column, judge_directions, poses, rows};
use crate::document::Document;
use crate::errors::Kind;
use crate::profile::Profile;
use crate::programs::{Files, sources, word};
use crate::threads::long;
use poseshift::diagnose as engine;
use poseshift::geometry::units::DEG;
use poseshift::identify::base::BasePolicy;
use poseshift::identify::calibration::Options;
use poseshift::identify::measurements::{Measurement, Observed};
use poseshift::identify::parameters::{Level, Selection};
use poseshift::identify::pick::Pick;
use poseshift::identify::plan::{Constraints, Request};
use poseshift::identify::robust::Shape;
use poseshift::identify::simulate::{Command, Device, Session};
use poseshift::identify::statistics::misses;
use poseshift::identify::validation::Folds;
use poseshift::model::Conditions;
use poseshift::model::external::Stand;
use poseshift::task::plan::Wanted;
use poseshift::task::simulate::{measurements_csv, simulate_at};
use poseshift::task::{self, Failure, ProfileFile, Rows, Said};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// Tables of measurements and what is said of their columns: files, columns, units, euler, driven
/// in order, and whether the two files are joints and points to be joined.
pub(crate) type Tables = (
    Files,
    Option<String>,
    Option<String>,
    Option<String>,
    bool,
    bool,
);

/// The rows of tables, as the reader of files has them.
pub(crate) fn read(py: Python<'_>, profile: &ProfileFile, tables: Tables) -> PyResult<Rows> {
    let (files, columns, units, euler, in_order, joined) = tables;
    let said = Said {
        columns,
        units,
        euler,
        in_order,
    };
    let sources = sources(&files);
    let rows = match &*sources {
        [joints, points] if joined => Rows::joined(joints, points, &said, &profile.profile),
        all => Rows::read(all, &said, &profile.profile),
    };
    rows.map_err(|failure| Kind::Measurement.raise(py, &failure))
}

fn picks(option: &str, text: &str) -> PyResult<Vec<Pick>> {
    Pick::parse_list(text)
        .map_err(|error| PyValueError::new_err(format!("{option}: {error}; {}", error.hint())))
}

/// How much of the arm is identified.
fn level(name: &str) -> PyResult<Level> {
    let levels = [
        ("frames", Level::Frames),
        ("joints", Level::Joints),
        ("geometry", Level::Geometry),
        ("compliance", Level::Compliance),
    ];
    word("level", name, &levels)
}

/// What is identified.
pub(crate) fn selection(
    level: &str,
    identify: &str,
    fix: &str,
    priors: bool,
) -> PyResult<Selection> {
    Ok(Selection {
        level: self::level(level)?,
        identify: picks("identify", identify)?,
        fix: picks("fix", fix)?,
        priors,
    })
}

fn shape(loss: &str) -> PyResult<Shape> {
    word(
        "loss",
        loss,
        &[
            ("squares", Shape::Squares),
            ("huber", Shape::Huber),
            ("tukey", Shape::Tukey),
        ],
    )
}

/// How to identify.
pub(crate) fn options(selection: Selection, loss: &str, base: &str) -> PyResult<Options> {
    Ok(Options {
        selection,
        shape: shape(loss)?,
        base: word(
            "base",
            base,
            &[
                ("controller", BasePolicy::Controller),
                ("auto", BasePolicy::Nearest),
                ("device", BasePolicy::Device),
                ("profile", BasePolicy::Profile),
            ],
        )?,
    })
}

fn identified<T>(py: Python<'_>, found: Result<T, Failure>) -> PyResult<T> {
    found.map_err(|failure| Kind::Identify.raise(py, &failure))
}

/// Effects of measurements: the document, the profile's text, the names of the parameters with
/// their covariance in SI units, and the residuals of the rows.
#[pyfunction]
#[pyo3(signature = (profile, tables, *, level="compliance", identify="", fix="", priors=false, loss="huber", base="controller", date=None))]
pub(crate) fn calibrate<'py>(
    py: Python<'py>,
    profile: &Profile,
    tables: Tables,
    level: &str,
    identify: &str,
    fix: &str,
    priors: bool,
    loss: &str,
    base: &str,
    date: Option<String>,
) -> PyResult<(Document, String, Vec<String>, Array<'py>, Array<'py>)> {
    let options = options(selection(level, identify, fix, priors)?, loss, base)?;
    let file = Arc::clone(&profile.file);
    let rows = read(py, &file, tables)?;
    let found = long(py, move |stop| {
        let found = task::calibrate::calibrate(&file, rows, &options, &mut || stop.here())?;
        let text = found.profile_text(&file, date.as_deref())?;
        Ok((found, text))
    })?;
    let (found, text) = identified(py, found)?;
    let solution = &found.found.solution;
    let (parameters, covariance) = (&solution.parameters, &found.found.uncertainty.covariance);
    let names = parameters.iter().map(|p| p.key.clone()).collect();
    let p = parameters.len();
    let entry = |k: usize| {
        let (i, j) = (k / p, k % p);
        covariance[(i, j)] * parameters[i].scale * parameters[j].scale
    };
    let covariance = array(py, (0..p * p).map(entry).collect(), &[p, p], false)?;
    let missed = misses(&found.found.problem, &solution.estimate);
    let gaps: Vec<f64> = missed
        .iter()
        .flat_map(|m| [m.gap[0], m.gap[1], m.gap[2]])
        .collect();
    let residuals = array(py, gaps, &[missed.len(), 3], false)?;
    Ok((Document::new(found), text, names, covariance, residuals))
}

/// Errors of a profile's models on measurements.
#[pyfunction]
#[pyo3(signature = (profile, tables, *, refit_frames=false, folds=None, level=None, priors=false, all_sets=false, as_calibrated=false))]
pub(crate) fn validate(
    py: Python<'_>,
    profile: &Profile,
    tables: Tables,
    refit_frames: bool,
    folds: Option<usize>,
    level: Option<&str>,
    priors: bool,
    all_sets: bool,
    as_calibrated: bool,
) -> PyResult<Document> {
    if folds.is_some_and(|folds| !(2..=1000).contains(&folds)) {
        return Err(PyValueError::new_err("folds must be from 2 to 1000"));
    }
    if folds.is_none() && (level.is_some() || priors) {
        return Err(PyValueError::new_err("level and priors are of the folds"));
    }
    let level = level.map(self::level).transpose()?;
    let folds = folds.map(|count| Folds {
        count,
        level,
        priors,
    });
    let options = task::validate::Options {
        refit_frames,
        folds,
        all_sets,
        as_calibrated,
    };
    let file = Arc::clone(&profile.file);
    let rows = read(py, &file, tables)?;
    let found = long(py, move |stop| {
        task::validate::validate(&file, rows, &options, &mut |_, _| stop.here())
    })?;
    Ok(Document::new(identified(py, found)?))
}

/// The effects that a profile lacks: the document, whether it is sure, the better profile where it
/// is, and the configurations that would tell alternatives apart.
#[pyfunction]
#[pyo3(signature = (profile, tables, *, accept="", reject="", quick=false, steps=false, runs=false))]
pub(crate) fn diagnose(
    py: Python<'_>,
    profile: &Profile,
    tables: Tables,
    accept: &str,
    reject: &str,
    quick: bool,
    steps: bool,
    runs: bool,
) -> PyResult<(Document, bool, Option<String>, Option<String>)> {
    let options = engine::Options {
        accept: picks("accept", accept)?,
        reject: picks("reject", reject)?,
        quick,
        steps,
        ..engine::Options::default()
    };
    let file = Arc::clone(&profile.file);
    let rows = read(py, &file, tables)?;
    let found = long(py, move |stop| {
        let hear = &mut |_: &str| stop.here();
        let found = if runs {
            task::drift::diagnose_runs(&file, &rows, &options, hear)?
        } else {
            task::diagnose::diagnose(&file, rows, &options, hear)?
        };
        let better = found
            .is_sure()
            .then(|| found.profile_text(&file))
            .transpose()?;
        Ok((found, better))
    })?;
    let (found, better) = identified(py, found)?;
    let (is_sure, poses) = (found.is_sure(), found.poses_csv());
    Ok((Document::new(found), is_sure, better, poses))
}

/// Changes of an error run by run: the first run with each and the one in which it was noticed,
/// from 0, and the error before and since.
#[pyfunction]
pub(crate) fn changes(errors: Numbers<'_>) -> PyResult<Vec<(usize, usize, f64, f64)>> {
    let errors = column("errors", &errors)?;
    if let Some(wrong) = errors.iter().find(|e| **e < 0.0) {
        let message = format!("an error is {wrong}; none is below 0");
        return Err(PyValueError::new_err(message));
    }
    let found = engine::drift::changes(&errors).into_iter();
    Ok(found
        .map(|c| (c.since, c.noticed, c.before, c.after))
        .collect())
}

/// A box of the world from two corners.
fn corners(name: &str, array: &Numbers<'_>) -> PyResult<[[f64; 3]; 2]> {
    let found = rows::<3>(name, array)?;
    match found.rows() {
        [a, b] => Ok([
            std::array::from_fn(|k| a[k].min(b[k])),
            std::array::from_fn(|k| a[k].max(b[k])),
        ]),
        _ => Err(PyValueError::new_err(format!(
            "{name} must be two corners: (2, 3)"
        ))),
    }
}

/// Configurations to measure: the document, their joint angles, their table, and the program where
/// one is asked for.
#[pyfunction]
#[pyo3(signature = (profile, count, *, tool=None, level="compliance", identify="", fix="", candidates=5000, starts=4, seed=1,
    sigma_m=50e-6, poses=false, given_rad=None, margin_rad=DEG, approach_rad=5.0 * DEG, inside_m=None, keep_out_m=vec![],
    device_m=None, cone_rad=30.0 * DEG, program=None, language=None))]
pub(crate) fn plan<'py>(
    py: Python<'py>,
    profile: &Profile,
    count: usize,
    tool: Option<&str>,
    level: &str,
    identify: &str,
    fix: &str,
    candidates: usize,
    starts: usize,
    seed: u64,
    sigma_m: f64,
    poses: bool,
    given_rad: Option<Numbers<'py>>,
    margin_rad: f64,
    approach_rad: f64,
    inside_m: Option<Numbers<'py>>,
    keep_out_m: Vec<Numbers<'py>>,
    device_m: Option<[f64; 3]>,
    cone_rad: f64,
    program: Option<&str>,
    language: Option<&str>,
) -> PyResult<(Document, Array<'py>, String, Option<String>)> {
    let given = match &given_rad {
        None => Vec::new(),
        Some(array) => rows::<6>("given_rad", array)?.rows().to_vec(),
    };
    let inside = inside_m.map(|array| corners("inside_m", &array));
    let keep_out = keep_out_m.iter().map(|array| corners("keep_out_m", array));
    let request = Request {
        count,
        candidates,
        starts,
        seed,
        sigma_m,
        poses,
        given,
        given_stands: Vec::new(),
        stations: STATIONS,
        constraints: Constraints {
            margin_rad,
            approach_rad,
            inside: inside.transpose()?,
            keep_out: keep_out.collect::<PyResult<_>>()?,
            sight: device_m.map(|at| (at, cone_rad)),
        },
    };
    let selection = selection(level, identify, fix, false)?;
    let [tool, program, language] = [tool, program, language].map(|text| text.map(str::to_owned));
    let file = Arc::clone(&profile.file);
    let found = long(py, move |stop| {
        let wanted = program.as_deref().map(|name| Wanted {
            name,
            language: language.as_deref(),
        });
        let read = |path: &std::path::Path| std::fs::read(path);
        let tell = &mut |_, _| stop.here();
        task::plan::plan(
            &file,
            tool.as_deref(),
            &selection,
            &request,
            wanted.as_ref(),
            &read,
            tell,
        )
    })?;
    let found = identified(py, found)?;
    let q: Vec<f64> = found.joints_deg.iter().flatten().map(|q| q * DEG).collect();
    let q = array(py, q, &[found.joints_deg.len(), 6], false)?;
    let (csv, text) = (found.csv(), found.program.clone());
    Ok((Document::new(found), q, csv, text))
}

/// Measurements of the robot that a profile describes, as a table.
#[pyfunction]
#[pyo3(signature = (profile, q_rad, *, tool=None, kind="position", noise_m=0.0, noise_rad=0.0, seed=1, from_m=None, outliers=0.0,
    outlier_m=0.01, temperature_c=None, interval_s=None, direction=None, force_n=None))]
pub(crate) fn simulate(
    py: Python<'_>,
    profile: &Profile,
    q_rad: Numbers<'_>,
    tool: Option<&str>,
    kind: &str,
    noise_m: f64,
    noise_rad: f64,
    seed: u64,
    from_m: Option<Numbers<'_>>,
    outliers: f64,
    outlier_m: f64,
    temperature_c: Option<[f64; 2]>,
    interval_s: Option<f64>,
    direction: Option<Numbers<'_>>,
    force_n: Option<Numbers<'_>>,
) -> PyResult<String> {
    let found = rows::<6>("q_rad", &q_rad)?;
    let q = found.rows();
    let from = match &from_m {
        None => Vec::new(),
        Some(array) => rows::<3>("from_m", array)?.rows().to_vec(),
    };
    if (kind == "distance") == from.is_empty() {
        return Err(PyValueError::new_err(
            "kind=\"distance\" and from_m belong together",
        ));
    }
    let device = match kind {
        "distance" => Device::Distance(from),
        other => word("kind", other, &[("position", false), ("pose", true)]).map(|is_pose| {
            if is_pose {
                Device::Pose
            } else {
                Device::Position
            }
        })?,
    };
    let session = Session {
        device,
        noise_m,
        noise_rad,
        outliers,
        outlier_m,
        temperature_c,
        interval_s,
        seed,
    };
    let directions = each("direction", direction.as_ref(), q.len())?;
    judge_directions(directions.as_deref().unwrap_or_default())?;
    let forces = each("force_n", force_n.as_ref(), q.len())?;
    let commands: Vec<Command> = q
        .iter()
        .enumerate()
        .map(|(i, q)| Command {
            q: *q,
            stand: Stand::default(),
            plate: None,
            direction: directions.as_ref().map(|all| all[i]),
            force_n: forces.as_ref().map_or([0.0; 3], |all| all[i]),
        })
        .collect();
    let file = &*profile.file;
    let made = py.detach(|| {
        let tool = file.tool(tool)?;
        simulate_at(file, &commands, forces.is_some(), &tool, &session)
    });
    Ok(identified(py, made)?.csv.unwrap_or_default())
}

/// Places of each axis of a track that a plan chooses among.
const STATIONS: usize = 11;

/// A row a configuration.
fn each<const N: usize>(
    name: &str,
    array: Option<&Numbers<'_>>,
    count: usize,
) -> PyResult<Option<Vec<[f64; N]>>> {
    let Some(array) = array else {
        return Ok(None);
    };
    let found = rows::<N>(name, array)?.rows().to_vec();
    if found.len() == count {
        return Ok(Some(found));
    }
    let message = format!(
        "{name} has {} rows; there are {count} configurations",
        found.len()
    );
    Err(PyValueError::new_err(message))
}

/// Arrays as a table of measurements.
#[pyfunction]
#[pyo3(signature = (q_rad, *, position_m=None, pose=None, sigma_m=None, direction=None, tool=None, point=None))]
pub(crate) fn measurements_of_arrays(
    q_rad: Numbers<'_>,
    position_m: Option<Numbers<'_>>,
    pose: Option<Numbers<'_>>,
    sigma_m: Option<Numbers<'_>>,
    direction: Option<Numbers<'_>>,
    tool: Option<Vec<String>>,
    point: Option<Vec<String>>,
) -> PyResult<String> {
    let found = rows::<6>("q_rad", &q_rad)?;
    let n = found.rows().len();
    let observed: Vec<Observed> = match (&position_m, &pose) {
        (Some(position), None) => {
            let all = rows::<3>("position_m", position)?;
            all.rows().iter().map(|p| Observed::Position(*p)).collect()
        }
        (None, Some(pose)) => poses("pose", pose)?
            .0
            .into_iter()
            .map(Observed::Pose)
            .collect(),
        _ => {
            return Err(PyValueError::new_err(
                "give position_m or pose, one of them",
            ));
        }
    };
    let sigma = sigma_m
        .as_ref()
        .map(|array| column("sigma_m", array))
        .transpose()?;
    let directions = each::<6>("direction", direction.as_ref(), n)?;
    judge_directions(directions.as_deref().unwrap_or_default())?;
    let counts = [
        ("what was measured", Some(observed.len())),
        ("sigma_m", sigma.as_ref().map(|all| all.len())),
        ("tool", tool.as_ref().map(Vec::len)),
        ("point", point.as_ref().map(Vec::len)),
    ];
    for (name, count) in counts {
        if count.is_some_and(|count| count != n) {
            let message = format!(
                "{name} has {} rows; q_rad has {n}",
                count.unwrap_or_default()
            );
            return Err(PyValueError::new_err(message));
        }
    }
    let all: Vec<Measurement> = (0..n)
        .map(|i| Measurement {
            conditions: Conditions {
                direction: directions.as_ref().map_or([0.0; 6], |all| all[i]),
                ..Conditions::default()
            },
            stand: Stand::default(),
            plate: None,
            tool: tool.as_ref().map(|all| all[i].clone()),
            point: point.as_ref().map(|all| all[i].clone()),
            sigma_m: sigma.as_ref().map(|all| all[i]),
            sigma_rad: None,
            line: (i + 2).into(),
            id: (i + 1).to_string(),
            q: found.rows()[i],
            observed: observed[i],
            point_in_tool_m: None,
            purpose: None,
            contact: None,
        })
        .collect();
    Ok(measurements_csv(
        &all,
        (directions.is_some(), false),
        &[],
        tool.is_some(),
    ))
}
