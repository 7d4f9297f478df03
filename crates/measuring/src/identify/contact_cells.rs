//! The cells of a row that say what the probe touched.

use super::contact::{Contact, ContactKind};
use super::fault::{MeasurementError, MeasurementFault, UNIT_TOLERANCE};
use super::measurements::{
    CENTRE_COLUMNS, DISTANCE_COLUMNS, NORMAL_COLUMNS, POSITION_COLUMNS, QUATERNION_COLUMNS,
};
use super::reading::{Cells, Kinds};
use crate::geometry::units::m_from_mm;
use crate::geometry::{Vector, norm};

impl Cells<'_> {
    pub(super) fn not_allowed(
        &self,
        column: &'static str,
        found: String,
        allowed: &'static str,
    ) -> MeasurementError {
        self.error(
            column,
            MeasurementFault::NotAllowed {
                column,
                found,
                allowed,
            },
        )
    }

    /// Numbers that are all there or all left empty.
    fn group(&self, columns: [&'static str; 3]) -> Result<Option<Vector>, MeasurementError> {
        if !self.reader.has(&columns) || self.is_empty(&columns) {
            return Ok(None);
        }
        self.numbers(columns).map(Some)
    }

    /// A length in metres, from mm; none where the column or the cell is not there.
    fn length(&self, column: &'static str) -> Result<Option<f64>, MeasurementError> {
        if self.text(column).is_none() {
            return Ok(None);
        }
        let found = self.number(column)?;
        if found <= 0.0 {
            return Err(self.not_allowed(column, found.to_string(), "greater than zero"));
        }
        Ok(Some(m_from_mm(found)))
    }

    /// What was touched, if this row is a contact.
    pub(super) fn contact(&self, kinds: Kinds) -> Result<Option<Contact>, MeasurementError> {
        const ALLOWED: &str = "sphere, plane or point";
        let Some(text) = self.text("contact") else {
            let columns = [
                "feature",
                "radius_mm",
                "cx_mm",
                "cy_mm",
                "cz_mm",
                "nx",
                "ny",
                "nz",
            ];
            if let Some(column) = columns.into_iter().find(|c| self.text(c).is_some()) {
                let found = format!(
                    "a cell without contact, `{}`",
                    self.text(column).unwrap_or("")
                );
                return Err(self.not_allowed(column, found, "empty, or the contact is missing"));
            }
            return Ok(None);
        };
        let kind = ContactKind::ALL.into_iter().find(|k| k.id() == text);
        let kind = kind.ok_or_else(|| self.not_allowed("contact", format!("`{text}`"), ALLOWED))?;
        let others = [
            &POSITION_COLUMNS[..],
            &QUATERNION_COLUMNS,
            &DISTANCE_COLUMNS,
        ];
        if others.iter().any(|columns| !self.is_empty(columns)) {
            let found = format!("`{text}` next to a position or a distance");
            return Err(self.not_allowed("contact", found, "alone in its row"));
        }
        let Some(feature) = self.text("feature") else {
            return Err(self.not_allowed("feature", "an empty cell".into(), "a name"));
        };
        let centre_m = self.group(CENTRE_COLUMNS)?.map(|c| c.map(m_from_mm));
        let radius_m = self.length("radius_mm")?;
        let mut normal = self.group(NORMAL_COLUMNS)?;
        if kind != ContactKind::Sphere && radius_m.is_some() {
            let found = format!("`{}`", self.text("radius_mm").unwrap_or(""));
            return Err(self.not_allowed("radius_mm", found, "empty: only a sphere has a radius"));
        }
        if let Some(given) = &mut normal {
            let length = norm(*given);
            if kind != ContactKind::Plane {
                let found = format!("`{}`", self.text("nx").unwrap_or(""));
                return Err(self.not_allowed("nx", found, "empty: only a plane has a normal"));
            }
            if (length - 1.0).abs() > UNIT_TOLERANCE {
                let found = format!("a normal of length {length:.4}");
                return Err(self.not_allowed("nx", found, "of length 1 (within 0.001)"));
            }
            *given = given.map(|x| x / length);
        }
        let probe = if kinds.probe {
            self.length("probe_radius_mm")?
        } else {
            None
        };
        Ok(Some(Contact {
            feature: feature.to_owned(),
            kind,
            centre_m,
            radius_m,
            normal,
            probe_radius_m: probe.unwrap_or(0.0),
        }))
    }
}
