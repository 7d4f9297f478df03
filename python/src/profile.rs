//! Profiles.

use crate::arm::Arm;
use crate::arrays::{Array, Numbers, array, fixed, judge_directions};
use crate::errors::Kind;
use poseshift::model::Conditions;
use poseshift::model::profile::{SHIPPED, catalogue};
use poseshift::program::Source;
use poseshift::task::diagnose::Effect;
use poseshift::task::fk::Which;
use poseshift::task::profile::diff;
use poseshift::task::{Document as _, ProfileFile};
use pyo3::exceptions::{PyKeyError, PyOSError, PyValueError};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// What is known of a robot: kinematics, tools, effects.
#[pyclass(frozen, module = "poseshift")]
pub(crate) struct Profile {
    pub(crate) file: Arc<ProfileFile>,
}

impl Profile {
    pub(crate) fn read(py: Python<'_>, text: String, name: &str) -> PyResult<Self> {
        let file = ProfileFile::read(&Source::new(name, text.into_bytes()))
            .map_err(|failure| Kind::Profile.raise(py, &failure))?;
        Ok(Self {
            file: Arc::new(file),
        })
    }
}

/// The arm that a word means.
pub(crate) fn which(model: &str) -> PyResult<Which> {
    match model {
        "real" => Ok(Which::Real),
        "controller" => Ok(Which::Controller),
        other => Err(PyValueError::new_err(format!(
            "model is \"{other}\"; it must be \"real\" or \"controller\""
        ))),
    }
}

#[pymethods]
impl Profile {
    /// The profile that this YAML text is; `name` is what errors call it.
    #[staticmethod]
    #[pyo3(signature = (text, name="profile.yaml"))]
    fn from_yaml(py: Python<'_>, text: String, name: &str) -> PyResult<Self> {
        Self::read(py, text, name)
    }

    /// The profile in this file.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let bytes = std::fs::read(&path).map_err(|error| {
            // OSError makes the class of the number
            PyOSError::new_err((error.raw_os_error(), error.to_string(), path.clone()))
        })?;
        let file = ProfileFile::read(&Source::new(path.to_string_lossy(), bytes))
            .map_err(|failure| Kind::Profile.raise(py, &failure))?;
        Ok(Self {
            file: Arc::new(file),
        })
    }

    /// A profile that comes with poseshift, by its name.
    #[staticmethod]
    fn shipped(py: Python<'_>, name: &str) -> PyResult<Self> {
        let shipped = SHIPPED.iter().find(|(known, _)| *known == name);
        let text = if let Some((_, text)) = shipped {
            (*text).to_owned()
        } else {
            let arm = catalogue().into_iter().find(|arm| arm.name == name);
            let arm = arm.ok_or_else(|| {
                PyKeyError::new_err(format!("no profile `{name}`; Profile.names() lists them"))
            })?;
            arm.text()
        };
        Self::read(py, text, &format!("{name}.yaml"))
    }

    /// The names of the profiles that come with poseshift.
    #[staticmethod]
    fn names() -> Vec<String> {
        let shipped = SHIPPED.iter().map(|(name, _)| (*name).to_owned());
        shipped
            .chain(catalogue().into_iter().map(|arm| arm.name))
            .collect()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.file.name
    }

    #[getter]
    fn manufacturer(&self) -> &str {
        &self.file.profile.manufacturer
    }

    #[getter]
    fn model(&self) -> &str {
        &self.file.profile.model
    }

    #[getter]
    fn serial(&self) -> Option<&str> {
        self.file.profile.serial.as_deref()
    }

    #[getter]
    fn language(&self) -> Option<&str> {
        self.file.profile.language.as_deref()
    }

    #[getter]
    fn sha256(&self) -> &str {
        &self.file.sha256
    }

    #[getter]
    fn tools(&self) -> Vec<&str> {
        let tools = self.file.profile.tools.keys();
        tools.map(String::as_str).collect()
    }

    /// (6, 2): the least and the largest angle of each joint.
    #[getter]
    fn limits_rad<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let joints = &self.file.profile.mechanism.joints;
        let limits = joints.iter().flat_map(|j| [j.min_rad, j.max_rad]);
        array(py, limits.collect(), &[6, 2], false)
    }

    /// Its effects: label, parameter, value and unit of each number.
    fn effects(&self) -> Vec<(String, String, f64, String)> {
        let effects = self.file.profile.effects.iter().map(Effect::from);
        effects
            .flat_map(|effect| {
                let row = |(key, value, unit): &(&str, f64, &str)| {
                    (
                        effect.label.clone(),
                        (*key).to_owned(),
                        *value,
                        (*unit).to_owned(),
                    )
                };
                effect.values.iter().map(row).collect::<Vec<_>>()
            })
            .collect()
    }

    /// Its text.
    fn to_yaml(&self) -> &str {
        &self.file.text
    }

    /// How another one differs: the JSON of `poseshift profile diff`.
    fn diff_json(&self, other: &Self) -> String {
        diff(&self.file.profile, &other.file.profile).json()
    }

    /// The arm with a tool: built once, for many calls.
    #[pyo3(signature = (tool=None, *, model="real", direction=None, force_n=None, temperature_c=None, time_s=None))]
    fn arm(
        &self,
        py: Python<'_>,
        tool: Option<&str>,
        model: &str,
        direction: Option<Numbers<'_>>,
        force_n: Option<Numbers<'_>>,
        temperature_c: Option<f64>,
        time_s: Option<f64>,
    ) -> PyResult<Arm> {
        let which = which(model)?;
        for (name, value) in [("temperature_c", temperature_c), ("time_s", time_s)] {
            if value.is_some_and(|value| !value.is_finite()) {
                return Err(PyValueError::new_err(format!("{name} is not finite")));
            }
        }
        let direction = direction.map(|array| {
            let direction = fixed("direction", &array)?;
            judge_directions(&[direction]).map(|()| direction)
        });
        let force_n = force_n.map(|array| fixed("force_n", &array));
        let conditions = Conditions {
            direction: direction.transpose()?.unwrap_or_default(),
            force_n: force_n.transpose()?.unwrap_or_default(),
            temperature_c,
            time_s,
            ..Conditions::default()
        };
        let tool = self.file.tool(tool);
        let tool = tool.map_err(|failure| Kind::Profile.raise(py, &failure))?;
        Ok(Arm::new(&self.file.profile, &tool, which, conditions))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, String))> {
        let file = &slf.get().file;
        let make = slf.get_type().getattr("from_yaml")?;
        Ok((make, (file.text.clone(), file.name.clone())))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.file.text == other.file.text
    }

    fn __hash__(&self) -> u64 {
        let digits = self.file.sha256.get(..16).unwrap_or_default();
        u64::from_str_radix(digits, 16).unwrap_or_default()
    }

    fn __repr__(&self) -> String {
        let profile = &self.file.profile;
        let (maker, model) = (&profile.manufacturer, &profile.model);
        let (effects, tools) = (profile.effects.len(), self.tools().join(", "));
        format!("<Profile {maker} {model}: {effects} effects; tools: {tools}>")
    }
}
