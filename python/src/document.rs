//! What a command found: its JSON, its text, its page.

use poseshift::Readable;
use pyo3::prelude::*;

/// What is reported of a result.
pub(crate) trait Reported: Send + Sync {
    fn json(&self) -> String;
    fn words(&self) -> String;
    /// `made` stands at the foot of the page.
    fn html(&self, made: &str) -> Option<String>;
}

impl<R: Readable + Send + Sync> Reported for R {
    fn json(&self) -> String {
        poseshift::task::Document::json(self)
    }

    fn words(&self) -> String {
        Readable::words(self)
    }

    fn html(&self, made: &str) -> Option<String> {
        Readable::html(self, made)
    }
}

/// What a command found.
#[pyclass(frozen, module = "poseshift._poseshift")]
pub(crate) struct Document(Box<dyn Reported>);

impl Document {
    pub(crate) fn new(reported: impl Reported + 'static) -> Self {
        Self(Box::new(reported))
    }
}

#[pymethods]
impl Document {
    /// The JSON that the command prints with --json.
    fn json(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.json())
    }

    /// The text that the command prints.
    fn words(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.words())
    }

    /// The page that the command writes with --report.
    fn html(&self, py: Python<'_>, made: &str) -> Option<String> {
        py.detach(|| self.0.html(made))
    }
}
