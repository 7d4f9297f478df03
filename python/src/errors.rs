//! Failures as exceptions of `poseshift.errors`.

use poseshift::task::{Blame, Failure};
use pyo3::prelude::*;

/// Which exception a failure is.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    /// A profile.
    Profile,
    /// A program, its tools and frames.
    Program,
    /// An arm without an inverse.
    Arm,
    /// Measurements as a table.
    Measurement,
    /// What measurements do not determine.
    Identify,
    /// A check and its cell.
    Check,
    /// Points and poses to register.
    Register,
}

impl Kind {
    const fn class(self) -> &'static str {
        match self {
            Self::Profile => "ProfileError",
            Self::Program => "ProgramError",
            Self::Arm => "ArmError",
            Self::Measurement => "MeasurementError",
            Self::Identify => "IdentifyError",
            Self::Check => "CheckError",
            Self::Register => "RegisterError",
        }
    }

    /// The exception of a failure.
    pub(crate) fn raise(self, py: Python<'_>, failure: &Failure) -> PyErr {
        let class = match failure.blame {
            Blame::Given => self.class(),
            Blame::Program => "InternalError",
        };
        let place = failure.place.as_ref();
        let made = || {
            let class = py.import("poseshift.errors")?.getattr(class)?;
            class.call1((
                failure.message.as_str(),
                failure.hint.as_str(),
                place.map(|place| place.file.as_str()),
                place.map(|place| place.line),
                place.map(|place| place.column),
                place.map(|place| place.text.as_str()),
            ))
        };
        made().map_or_else(|error| error, PyErr::from_value)
    }
}
