//! Registration of points, surfaces and cameras; frames from sweeps and from a ballbar hexapod.

use crate::arrays::{Array, Numbers, array, column, one_pose, pose_array, poses, rows};
use crate::document::Document;
use crate::errors::Kind;
use crate::profile::Profile;
use crate::programs::word;
use crate::threads::long;
use poseshift::geometry::Pose;
use poseshift::geometry::units::m_from_mm;
use poseshift::program::Source;
use poseshift::register::handeye::{HandEye, Method, Setup};
use poseshift::register::icp as surfaces;
use poseshift::register::icp::Metric;
use poseshift::register::kabsch::{kabsch, noise_m};
use poseshift::task::{self, Failure};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;

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

/// Points with a size.
fn vectors(points: impl IntoIterator<Item = [f64; 3]>) -> Vec<f64> {
    points.into_iter().flatten().collect()
}

/// The rigid motion that lays a surface's points on another: `to_from_from`, root mean square
/// residual, what the roughness explains, overlap, covariance, and why it is no success.
#[pyfunction]
#[pyo3(signature = (from_m, to_m, *, normals=None, metric="plane", start=None, keep=0.9, min_overlap=0.6, sigma_m=None))]
pub(crate) fn icp<'py>(
    py: Python<'py>,
    from_m: Numbers<'py>,
    to_m: Numbers<'py>,
    normals: Option<Numbers<'py>>,
    metric: &str,
    start: Option<Numbers<'py>>,
    keep: f64,
    min_overlap: f64,
    sigma_m: Option<f64>,
) -> PyResult<(Array<'py>, f64, f64, f64, Option<Array<'py>>, Vec<String>)> {
    for (name, value) in [("keep", keep), ("min_overlap", min_overlap)] {
        if !(value > 0.0 && value <= 1.0) {
            let message = format!("{name} is {value}; it must be above 0 and at most 1");
            return Err(PyValueError::new_err(message));
        }
    }
    if let Some(sigma) = sigma_m.filter(|sigma| !(sigma.is_finite() && *sigma >= 0.0)) {
        let message = format!("sigma_m is {sigma}; it must be 0 or more");
        return Err(PyValueError::new_err(message));
    }
    let (from, to) = (rows::<3>("from_m", &from_m)?, rows::<3>("to_m", &to_m)?);
    let normals = normals.as_ref();
    let normals = normals
        .map(|array| rows::<3>("normals", array))
        .transpose()?;
    if let Some(normals) = normals
        .as_ref()
        .filter(|n| n.rows().len() != to.rows().len())
    {
        let (a, b) = (normals.rows().len(), to.rows().len());
        let message = format!("normals has {a} rows and to_m {b}");
        return Err(PyValueError::new_err(message));
    }
    let metrics = [
        ("plane", Metric::PointToPlane),
        ("point", Metric::PointToPoint),
    ];
    let start = start.as_ref().map(|pose| one_pose("start", pose));
    let options = surfaces::Options {
        metric: word("metric", metric, &metrics)?,
        start: start.transpose()?,
        kept: keep,
        min_overlap,
        sigma_m,
    };
    let (from, to) = (from.rows().to_vec(), to.rows().to_vec());
    let normals = normals.map(|normals| normals.rows().to_vec());
    let found = long(py, move |_| {
        surfaces::icp(&from, &to, normals.as_deref(), &options)
    })?;
    let found = found
        .map_err(|e| Kind::Register.raise(py, &Failure::with_hint(e.to_string(), e.hint())))?;
    let covariance = found.covariance.map(|c| {
        let matrix = c.matrix.into_iter().flatten().collect();
        array(py, matrix, &[6, 6], false)
    });
    Ok((
        pose_array(py, &[found.to_from_from], true)?,
        found.rms_m,
        found.expected_m,
        found.overlap,
        covariance.transpose()?,
        found.concerns.iter().map(ToString::to_string).collect(),
    ))
}

/// A file's name and bytes.
type File = (String, PyBackedBytes);

fn source((name, bytes): &File) -> Source {
    Source::new(name.as_str(), bytes.to_vec())
}

/// Tool poses of a ballbar hexapod in the frame of its base: the document, poses, and the points of
/// the tool.
#[pyfunction]
#[pyo3(signature = (lengths, *, sigma_m=1e-6))]
pub(crate) fn hexapod(
    py: Python<'_>,
    lengths: File,
    sigma_m: f64,
) -> PyResult<(Document, Array<'_>, Array<'_>)> {
    if !(sigma_m > 0.0 && sigma_m.is_finite()) {
        let message = format!("sigma_m is {sigma_m}; it must be above 0");
        return Err(PyValueError::new_err(message));
    }
    let lengths = source(&lengths);
    let found = py.detach(|| task::hexapod::poses(&lengths, sigma_m));
    let found = found.map_err(|failure| Kind::Register.raise(py, &failure))?;
    let all: Vec<Pose> = found.poses.iter().map(|row| (&row.pose).into()).collect();
    let points = found.poses.iter().flat_map(|row| row.tool_points_mm);
    let points = vectors(points.map(|point| point.map(m_from_mm)));
    let points = array(py, points, &[all.len(), 3, 3], false)?;
    let poses = pose_array(py, &all, false)?;
    Ok((Document::new(found), poses, points))
}

/// Frames from sweeps of single joints: the document, `world_from_base` and `flange_from_tool`.
#[pyfunction]
#[pyo3(signature = (profile, sweeps, *, point=None))]
pub(crate) fn axes<'py>(
    py: Python<'py>,
    profile: &Profile,
    sweeps: File,
    point: Option<&str>,
) -> PyResult<(Document, Option<Array<'py>>, Option<Array<'py>>)> {
    let sweeps = source(&sweeps);
    let file = &*profile.file;
    let found = py.detach(|| task::axes::axes(file, &sweeps, point));
    let found = found.map_err(|failure| Kind::Register.raise(py, &failure))?;
    let frame = |pose: Option<&task::parts::Pose>| {
        let array = pose.map(|pose| pose_array(py, &[pose.into()], true));
        array.transpose()
    };
    let (base, tool) = (frame(found.base.as_ref())?, frame(found.tool.as_ref())?);
    Ok((Document::new(found), base, tool))
}
