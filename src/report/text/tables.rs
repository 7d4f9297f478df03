//! The texts of `simulate`, `fk` and `ik`: tables.

use crate::report::Style;
use crate::task::fk::Poses;
use crate::task::ik::Solutions;
use crate::task::simulate::Simulation;

pub(super) fn simulation(found: &Simulation, _: Style) -> String {
    match (&found.output, &found.csv) {
        (Some(path), _) => format!("{} rows written to {path}\n", found.rows),
        (None, csv) => csv.clone().unwrap_or_default(),
    }
}

pub(super) fn poses(found: &Poses, _: Style) -> String {
    found.csv()
}

pub(super) fn solutions(found: &Solutions, _: Style) -> String {
    found.csv()
}
