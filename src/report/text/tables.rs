//! The texts of `simulate`, `fk` and `ik`: tables.

use crate::finding::Finding;
use crate::report::{Report, Style};
use crate::task::fk::Poses;
use crate::task::ik::Solutions;
use crate::task::simulate::Simulation;

impl Report for Simulation {
    fn text(&self, _: Style) -> String {
        match (&self.output, &self.csv) {
            (Some(path), _) => format!("{} rows written to {path}\n", self.rows),
            (None, csv) => csv.clone().unwrap_or_default(),
        }
    }

    fn findings(&self) -> &[Finding] {
        &self.findings
    }
}

impl Report for Poses {
    fn text(&self, _: Style) -> String {
        self.csv()
    }

    fn findings(&self) -> &[Finding] {
        &self.findings
    }
}

pub(super) fn solutions(found: &Solutions, _: Style) -> String {
    found.csv()
}
