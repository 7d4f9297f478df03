//! An identification as a function of its parameters.

use crate::arrays::{Array, Numbers, array, column};
use crate::errors::Kind;
use crate::measuring::{Tables, options, read, selection};
use crate::profile::Profile;
use crate::threads::long;
use poseshift::identify::residuals::Residuals;
use poseshift::task::{self, Failure};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// Residuals of measurements and their exact Jacobian, for solvers such as
/// `scipy.optimize.least_squares`.
#[pyclass(frozen, module = "poseshift")]
pub(crate) struct Problem {
    residuals: Residuals,
    x0: Vec<f64>,
}

impl Problem {
    /// As many numbers as parameters.
    fn values(&self, x: &Numbers<'_>) -> PyResult<Vec<f64>> {
        let values = column("x", x)?;
        if values.len() == self.x0.len() {
            return Ok(values.into_owned());
        }
        let (found, wanted) = (values.len(), self.x0.len());
        Err(PyValueError::new_err(format!(
            "x has {found} numbers; there are {wanted} parameters"
        )))
    }
}

#[pymethods]
impl Problem {
    #[new]
    #[pyo3(signature = (profile, tables, *, level="compliance", identify="", fix=""))]
    fn new(
        py: Python<'_>,
        profile: &Profile,
        tables: Tables,
        level: &str,
        identify: &str,
        fix: &str,
    ) -> PyResult<Self> {
        let options = options(
            selection(level, identify, fix, false)?,
            "squares",
            "controller",
        )?;
        let file = Arc::clone(&profile.file);
        let rows = read(py, &file, tables)?;
        let found = long(py, move |stop| -> Result<_, Failure> {
            let hear = &mut || stop.here();
            let found = task::calibrate::calibrate(&file, rows, &options, hear)?;
            let residuals = Residuals::of(&found.found);
            let x0 = residuals.start(&file.profile);
            Ok(Self { residuals, x0 })
        })?;
        found.map_err(|failure| Kind::Identify.raise(py, &failure))
    }

    /// The parameters.
    #[getter]
    fn names(&self) -> Vec<&str> {
        let parameters = self.residuals.parameters().iter();
        parameters.map(|p| p.key.as_str()).collect()
    }

    /// (p,): the profile's own values; frames, tools and points as `calibrate` finds them.
    #[getter]
    fn x0<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        array(py, self.x0.clone(), &[self.x0.len()], false)
    }

    /// (p,): what `calibrate` finds.
    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let found = self.residuals.found();
        let p = found.len();
        array(py, found, &[p], false)
    }

    /// (m,): measured minus expected in standard deviations, row by row.
    fn residuals<'py>(&self, py: Python<'py>, x: Numbers<'py>) -> PyResult<Array<'py>> {
        let values = self.values(&x)?;
        let found = py.detach(|| self.residuals.residuals(&values));
        let m = found.len();
        array(py, found, &[m], false)
    }

    /// (m, p): their derivatives.
    fn jacobian<'py>(&self, py: Python<'py>, x: Numbers<'py>) -> PyResult<Array<'py>> {
        let values = self.values(&x)?;
        let found = py.detach(|| self.residuals.jacobian(&values));
        let p = values.len();
        array(py, found, &[self.residuals.count(), p], false)
    }
}
