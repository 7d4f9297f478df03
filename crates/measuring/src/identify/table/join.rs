//! Joints of one file with points of another: by `id`, else in their order.

use super::columns::has_joints;
use super::{Row, Table, fault, note};
use crate::identify::fault::MeasurementError;
use crate::nearest;
use std::collections::BTreeMap;

/// Ids that are written out at most.
const MOST_LISTED: usize = 5;

/// The first few of some names.
fn few(names: &[&str]) -> String {
    let mut listed = names[..names.len().min(MOST_LISTED)].join(", ");
    if names.len() > MOST_LISTED {
        listed += ", …";
    }
    listed
}

impl Table {
    /// Rows of the points, each with its row of the joints.
    pub(super) fn join(&mut self) -> Result<Vec<Row>, MeasurementError> {
        let [joints, points] = [0, 1].map(|file| self.grids[file].name.clone());
        if !has_joints(&self.columns, 0) && has_joints(&self.columns, 1) {
            let message = format!(
                "{points} has the joints, {joints} has not: are --joints and --points swapped?"
            );
            return Err(fault(
                1,
                0,
                message,
                format!("--joints {points} --points {joints}"),
            ));
        }
        let ids: Vec<usize> = (0..self.columns.len())
            .filter(|i| self.columns[*i].name == "id")
            .collect();
        let id_of = |file: usize| ids.iter().copied().find(|i| self.columns[*i].grid == file);
        let both = id_of(0).zip(id_of(1));
        let twice = self.columns.iter().find(|column| {
            let mut others = self.columns.iter();
            column.grid == 0
                && column.name != "id"
                && others.any(|o| o.grid == 1 && o.name == column.name)
                && super::names::column(&column.name).is_some_and(|(name, _)| name == column.name)
        });
        if let Some(column) = twice {
            let message = format!(
                "the column {} stands in {joints} and in {points}",
                column.name
            );
            return Err(fault(1, 0, message, "leave it out of one of them"));
        }
        let rows = match both {
            Some((of_joints, of_points)) => {
                let rows = self.by_id(of_joints, of_points)?;
                // one of the two names the rows
                self.columns.remove(of_points);
                rows
            }
            None => self.in_order(&joints, &points)?,
        };
        Ok(rows)
    }

    fn in_order(&mut self, joints: &str, points: &str) -> Result<Vec<Row>, MeasurementError> {
        let counts = [0, 1].map(|file| self.grids[file].rows.len());
        if counts[0] != counts[1] {
            let message = format!(
                "{joints} has {} rows, {points} has {}: without a column id in both they are \
                 joined in their order",
                counts[0], counts[1]
            );
            let hint = "give both a column id (--columns id=Their name), or leave out the rows \
                that were not measured";
            return Err(fault(1, 0, message, hint));
        }
        let message = format!(
            "{joints} and {points} are joined in their order, row by row: not both have a column id"
        );
        let hint = "with a column id in both (--columns id=Their name) a missing row is found";
        self.remarks.push(note("joined-in-order", message, hint));
        let rows = 0..counts[0];
        Ok(rows
            .map(|row| Row {
                at: [row, row],
                point: None,
                motion: None,
            })
            .collect())
    }

    fn by_id(&mut self, of_joints: usize, of_points: usize) -> Result<Vec<Row>, MeasurementError> {
        let row_of = |at: usize| Row {
            at: [at, at],
            point: None,
            motion: None,
        };
        let [joints, points] = [0, 1].map(|file| self.grids[file].name.clone());
        let line = |file: usize, at: usize| self.grids[file].rows[at].0;
        let mut known: BTreeMap<&str, usize> = BTreeMap::new();
        for at in 0..self.grids[0].rows.len() {
            let row = row_of(at);
            let Some(id) = self.text(&row, of_joints) else {
                return Err(fault(
                    0,
                    line(0, at),
                    "a row without an id".into(),
                    "every row needs one",
                ));
            };
            if let Some(earlier) = known.insert(id, at) {
                let message = format!(
                    "the id `{id}` stands in line {}, too: which joints are those of its points?",
                    line(0, earlier)
                );
                return Err(fault(
                    0,
                    line(0, at),
                    message,
                    "give every pose an id of its own",
                ));
            }
        }
        let several =
            self.index("point").is_some() || self.columns.iter().any(|c| c.of_point().is_some());
        let mut measured: BTreeMap<usize, usize> = BTreeMap::new();
        let mut rows = Vec::with_capacity(self.grids[1].rows.len());
        for at in 0..self.grids[1].rows.len() {
            let row = row_of(at);
            let Some(id) = self.text(&row, of_points) else {
                return Err(fault(
                    1,
                    line(1, at),
                    "a row without an id".into(),
                    "every row needs one",
                ));
            };
            let Some(pose) = known.get(id).copied() else {
                let message = format!(
                    "the id `{id}` is not in {joints}, whose ids are {}",
                    few(&known.keys().copied().collect::<Vec<_>>())
                );
                let near = nearest::nearest(id, known.keys().copied());
                let hint = near.first().map_or_else(
                    || {
                        "other names in both files? without a column id in one of them rows are \
                        joined in their order"
                            .to_owned()
                    },
                    |near| format!("did you mean `{near}`?"),
                );
                return Err(fault(1, line(1, at), message, hint));
            };
            if let Some(earlier) = measured.insert(pose, at)
                && !several
            {
                let message = format!(
                    "the id `{id}` stands in line {}, too, of {points}",
                    line(1, earlier)
                );
                let hint = "of several reflectors each row needs its name in a column point; other \
                    readings need other ids";
                return Err(fault(1, line(1, at), message, hint));
            }
            rows.push(Row {
                at: [pose, at],
                ..row
            });
        }
        let left: Vec<&str> = known
            .iter()
            .filter(|(_, at)| !measured.contains_key(at))
            .map(|(id, _)| *id)
            .collect();
        if !left.is_empty() {
            let message = format!(
                "{} of {} poses of {joints} have no point in {points}: {}",
                left.len(),
                known.len(),
                few(&left)
            );
            self.remarks.push(note(
                "not-measured",
                message,
                "were they not seen, or are they named otherwise?",
            ));
        }
        Ok(rows)
    }
}
