//! The block `calibration.quality` of a profile: what a calibration says of its own errors.
//!
//! `calibrate` writes it; it is read strictly, and what contradicts itself is an error. What was
//! not finite stands in it as null, and is not judged.

use crate::model::effects::Kind;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// What a correlation may exceed one by, rounding.
const ROUNDED: f64 = 1e-6;
/// First words of parameters that belong to no effect: points, and features that are touched.
const NO_EFFECTS: [&str; 3] = ["point", "sphere", "plane"];

/// The keys of the block; all are optional, for what was not measured is not there.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[allow(dead_code)] // some keys are here to be known
struct QualityFile {
    middle_mm: Option<[Option<f64>; 3]>,
    before: Option<Errors>,
    frames_only: Option<Errors>,
    after: Option<Errors>,
    observability: Option<BTreeMap<String, Option<f64>>>,
    sigma_factor: Option<f64>,
    /// How many times larger sigmas are because rows of one configuration miss alike.
    shared_factor: Option<f64>,
    /// How many configurations the rows have.
    configurations: Option<f64>,
    degrees_of_freedom: Option<f64>,
    parameters: Vec<Parameter>,
    covariance_lower_triangle: Option<Vec<Vec<Option<f64>>>>,
    strong_correlations: Value,
    track_mm: Vec<[Option<f64>; 2]>,
    /// The same of points on the plates of positioners.
    plates: Option<Box<QualityFile>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Errors {
    position: Option<Spread>,
    orientation: Option<Spread>,
    range: Option<Spread>,
}

/// Of positions and distances in mm, of orientations in degrees.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code)]
struct Spread {
    n: Option<f64>,
    #[serde(alias = "mean_deg")]
    mean_mm: Option<f64>,
    #[serde(alias = "std_deg")]
    std_mm: Option<f64>,
    #[serde(alias = "mean_plus_3std_deg")]
    mean_plus_3std_mm: Option<f64>,
    #[serde(alias = "rms_deg")]
    rms_mm: Option<f64>,
    #[serde(alias = "p95_deg")]
    p95_mm: Option<f64>,
    #[serde(alias = "p997_deg")]
    p997_mm: Option<f64>,
    #[serde(alias = "max_deg")]
    max_mm: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code)]
struct Parameter {
    key: String,
    unit: Option<String>,
    sigma: Option<f64>,
}

/// What is wrong with a block `quality`; `None` where it may be believed.
pub(super) fn fault(quality: &Value) -> Option<String> {
    match QualityFile::deserialize(quality) {
        Ok(file) => file.fault(),
        Err(error) => Some(error.to_string()),
    }
}

impl QualityFile {
    fn fault(&self) -> Option<String> {
        let models = [
            ("before", &self.before),
            ("frames_only", &self.frames_only),
            ("after", &self.after),
        ];
        let mut spreads = models.into_iter().filter_map(|(model, errors)| {
            let errors = errors.as_ref()?;
            let kinds = [
                ("position", &errors.position, "mm"),
                ("orientation", &errors.orientation, "deg"),
                ("range", &errors.range, "mm"),
            ];
            let fault = |(kind, spread, unit): (&str, &Option<Spread>, &str)| {
                let fault = spread.as_ref()?.fault(unit)?;
                Some(format!("{model}.{kind}.{fault}"))
            };
            kinds.into_iter().find_map(fault)
        });
        let negative = [
            ("sigma_factor", self.sigma_factor),
            ("shared_factor", self.shared_factor),
            ("configurations", self.configurations),
            ("degrees_of_freedom", self.degrees_of_freedom),
        ];
        let negative = negative
            .into_iter()
            .find_map(|(key, value)| below(key, value));
        let plates = || Some(format!("plates.{}", self.plates.as_ref()?.fault()?));
        spreads
            .next()
            .or(negative)
            .or_else(|| self.parameters.iter().find_map(Parameter::fault))
            .or_else(|| self.covariance_fault())
            .or_else(plates)
    }

    /// The covariance is the lower triangle of one: as many rows as parameters, each longer by one,
    /// no variance negative and no correlation beyond one.
    fn covariance_fault(&self) -> Option<String> {
        let rows = self.covariance_lower_triangle.as_ref()?;
        let key = "covariance_lower_triangle";
        if rows.len() != self.parameters.len() {
            let (found, wanted) = (rows.len(), self.parameters.len());
            return Some(format!("{key} has {found} rows for {wanted} parameters"));
        }
        let short = rows
            .iter()
            .zip(1..)
            .find(|(row, width)| row.len() != *width);
        if let Some((row, width)) = short {
            let found = row.len();
            return Some(format!(
                "{key}: row {width} has {found} numbers, not {width}"
            ));
        }
        let variance = |i: usize| rows[i][i];
        let mut pairs = (0..rows.len()).flat_map(|i| (0..=i).map(move |j| (i, j)));
        pairs.find_map(|(i, j)| {
            let (own, a, b) = (rows[i][j]?, variance(i)?, variance(j)?);
            let place = format!("{key}: row {}, number {}, is {own}", i + 1, j + 1);
            if i == j {
                return (own < 0.0).then(|| format!("{place}; a variance is not negative"));
            }
            let most = (a * b).max(0.0).sqrt() * (1.0 + ROUNDED);
            (own.abs() > most)
                .then(|| format!("{place}; by the variances of the two it is at most {most:.3e}"))
        })
    }
}

/// A number that must not be negative, and is.
fn below(key: &str, value: Option<f64>) -> Option<String> {
    let value = value.filter(|value| *value < 0.0)?;
    Some(format!("{key} is {value}; it is not negative"))
}

impl Spread {
    fn fault(&self, unit: &str) -> Option<String> {
        let sizes = [
            ("mean", self.mean_mm),
            ("std", self.std_mm),
            ("rms", self.rms_mm),
            ("max", self.max_mm),
        ];
        let negative = |(key, value): (&str, _)| below(&format!("{key}_{unit}"), value);
        below("n", self.n)
            .or_else(|| sizes.into_iter().find_map(negative))
            .or_else(|| {
                // of any numbers the mean is at most the root mean square, and that the largest
                let (mean, rms, max) = (self.mean_mm?, self.rms_mm?, self.max_mm?);
                let is_between = mean <= rms * (1.0 + ROUNDED) && rms <= max * (1.0 + ROUNDED);
                (!is_between).then(|| {
                    format!(
                        "rms_{unit} is {rms}; it is between mean_{unit}, {mean}, and max_{unit}, \
                         {max}"
                    )
                })
            })
    }
}

impl Parameter {
    /// It is of no effect, or its deviation is negative.
    fn fault(&self) -> Option<String> {
        let key = &self.key;
        let first = key.split(' ').next().unwrap_or_default();
        let last = key.rsplit(' ').next().unwrap_or_default();
        let is_known = NO_EFFECTS.contains(&first)
            || Kind::by_id(first)
                .is_some_and(|kind| kind.definition().parameters.iter().any(|p| p.key == last));
        if !is_known {
            return Some(format!("parameters: no effect has the parameter `{key}`"));
        }
        below(&format!("sigma of the parameter `{key}`"), self.sigma)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// As `calibrate` writes it.
    fn written() -> Value {
        json!({
            "middle_mm": [40.0, -57.0, 517.0],
            "before": {"position": {"n": 3, "mean_mm": 1.5, "std_mm": 0.6, "rms_mm": 1.7,
                "mean_plus_3std_mm": 3.3, "p95_mm": 2.0, "p997_mm": 2.0, "max_mm": 2.0}},
            "after": {"position": {"n": 3, "mean_mm": 0.07, "rms_mm": 0.08, "max_mm": 0.2},
                "orientation": {"n": 3, "mean_deg": 0.02, "rms_deg": 0.03, "max_deg": 0.06}},
            "observability": {"o1": 0.4, "condition_number": null},
            "sigma_factor": 1.0,
            "degrees_of_freedom": 7,
            "parameters": [{"key": "link_geometry link 2 theta_deg", "unit": "deg", "sigma": 0.01},
                {"key": "point nest x_mm", "unit": "mm", "sigma": 0.05}],
            "covariance_lower_triangle": [[1e-4], [1e-4, 2.5e-3]],
            "strong_correlations": [],
            "track_mm": [[0.0, null]],
            "plates": {"after": {"range": {"n": 1, "rms_mm": 0.0}}},
        })
    }

    #[test]
    fn what_calibrate_writes_is_read_and_what_contradicts_itself_is_not() {
        assert_eq!(fault(&written()), None);
        assert_eq!(fault(&json!({})), None);
        for (pointer, value, wanted) in [
            (
                "/after/position/rms_mm",
                json!(27.5),
                "after.position.rms_mm is 27.5; it is between",
            ),
            (
                "/after/position/rms_mm",
                json!(-0.08),
                "rms_mm is -0.08; it is not negative",
            ),
            ("/after/orientation/rms_deg", json!(9.0), "max_deg, 0.06"),
            ("/degrees_of_freedom", json!(-1), "degrees_of_freedom is -1"),
            ("/degrees_of_freedom", json!("7"), "invalid type"),
            (
                "/parameters/0/key",
                json!("link_geometry link 2 theta"),
                "no effect has",
            ),
            ("/parameters/0/sigma", json!(-1.0), "theta_deg` is -1"),
            (
                "/covariance_lower_triangle/0/0",
                json!(-5.0),
                "row 1, number 1, is -5",
            ),
            (
                "/covariance_lower_triangle/1/0",
                json!(-5.0),
                "row 2, number 1, is -5",
            ),
            (
                "/covariance_lower_triangle/1",
                json!([1.0]),
                "row 2 has 1 numbers, not 2",
            ),
            (
                "/covariance_lower_triangle",
                json!([[1.0]]),
                "1 rows for 2 parameters",
            ),
            (
                "/plates/after/range/rms_mm",
                json!(-1.0),
                "plates.after.range.rms_mm is -1",
            ),
        ] {
            let mut changed = written();
            *changed.pointer_mut(pointer).expect("it is there") = value;
            let said = fault(&changed).unwrap_or_default();
            assert!(said.contains(wanted), "{pointer}: {said}");
        }
        let mut misspelt = written();
        misspelt["degrees_of_fredom"] = json!(7);
        let said = fault(&misspelt).unwrap_or_default();
        assert!(
            said.starts_with("unknown field `degrees_of_fredom`"),
            "{said}"
        );
    }
}
