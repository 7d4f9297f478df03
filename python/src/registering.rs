//! Registration of points and cameras.

use crate::arrays::{Array, Numbers, array, column, pose_array, poses, rows};
use crate::errors::Kind;
use crate::programs::word;
use poseshift::register::handeye::{HandEye, Method, Setup};
use poseshift::register::kabsch::{kabsch, noise_m};
use poseshift::task::Failure;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The rigid motion between matched points: `to_from_from`, residuals, root mean square distance,
/// noise, covariance.
#[pyfunction]
#[pyo3(signature = (from_m, to_m, weights=None))]
pub(crate) fn register<'py>(
    py: Python<'py>,
    from_m: Numbers<'py>,
    to_m: Numbers<'py>,
    weights: Option<Numbers<'py>>,
) -> PyResult<(Array<'py>, Array<'py>, f64, f64, Array<'py>)> {
    let (from, to) = (rows::<3>("from_m", &from_m)?, rows::<3>("to_m", &to_m)?);
    let weights = weights
        .as_ref()
        .map(|array| column("weights", array))
        .transpose()?;
    let (from, to, weights) = (from.rows(), to.rows(), weights.as_deref());
    if from.len() != to.len() || weights.is_some_and(|w| w.len() != from.len()) {
        let (a, b) = (from.len(), to.len());
        let message =
            format!("from_m has {a} rows and to_m {b}; weights, where given, are as many");
        return Err(PyValueError::new_err(message));
    }
    let found = py.detach(|| {
        let fit = kabsch(from, to, weights)?;
        let residuals = fit.residuals_m(from, to);
        let rmsd = fit.rmsd_m(from, to, weights);
        let noise = noise_m(&residuals, weights);
        let covariance = fit.covariance(from, weights, noise);
        Ok((fit, residuals, rmsd, noise, covariance))
    });
    let (fit, residuals, rmsd, noise, covariance) =
        found.map_err(|error: poseshift::register::RegisterError| {
            Kind::Register.raise(py, &Failure::with_hint(error.to_string(), error.hint()))
        })?;
    let n = residuals.len();
    let residuals = array(
        py,
        residuals.into_iter().flatten().collect(),
        &[n, 3],
        false,
    )?;
    let matrix = covariance.matrix.into_iter().flatten().collect();
    Ok((
        pose_array(py, &[fit.to_from_from], true)?,
        residuals,
        rmsd,
        noise,
        array(py, matrix, &[6, 6], false)?,
    ))
}

/// Where a camera is: camera, board, by each method, residuals of the rows in metres and radians.
#[pyfunction]
#[pyo3(signature = (robot, board, *, setup))]
pub(crate) fn hand_eye<'py>(
    py: Python<'py>,
    robot: Numbers<'py>,
    board: Numbers<'py>,
    setup: &str,
) -> PyResult<(
    Array<'py>,
    Array<'py>,
    Vec<(&'static str, Option<Array<'py>>)>,
    Array<'py>,
    Array<'py>,
)> {
    let setup = word(
        "setup",
        setup,
        &[
            ("eye-to-hand", Setup::EyeToHand),
            ("eye-in-hand", Setup::EyeInHand),
        ],
    )?;
    let (robot, _) = poses("robot", &robot)?;
    let (board, _) = poses("board", &board)?;
    let methods = [
        Method::Tsai,
        Method::Park,
        Method::Horaud,
        Method::Daniilidis,
    ];
    let found = py.detach(|| {
        let problem = HandEye::new(setup, &robot, &board)?;
        let refined = problem.refined()?;
        let each = methods.map(|method| (method.id(), problem.by(method).ok()));
        Ok((refined, each))
    });
    let (refined, each) = found.map_err(|error: poseshift::register::handeye::HandEyeError| {
        Kind::Register.raise(py, &Failure::new(error.to_string()))
    })?;
    let by_method = each.into_iter().map(|(id, pose)| {
        let pose = pose.map(|pose| pose_array(py, &[pose], true));
        Ok((id, pose.transpose()?))
    });
    let rows = &refined.rows;
    let distances = rows.iter().map(|row| row.distance_m).collect();
    let angles = rows.iter().map(|row| row.rotation_rad).collect();
    Ok((
        pose_array(py, &[refined.camera], true)?,
        pose_array(py, &[refined.board], true)?,
        by_method.collect::<PyResult<_>>()?,
        array(py, distances, &[rows.len()], false)?,
        array(py, angles, &[rows.len()], false)?,
    ))
}
