//! How well the calibration knows where the real tool is: the covariance of the parameters, pushed
//! through the model.

use crate::geometry::{Vector, dot, sub};
use crate::model::{Conditions, Model};
use crate::profile::{Mounted, Profile};
use serde_json::Value;

/// Part of a parameter's standard deviation by which it is moved to see what it does.
const STEP: f64 = 0.5;

/// The model with each parameter moved to either side, and how the parameters vary together.
pub(crate) struct Spread {
    /// For each parameter that the profile has: moved down, moved up.
    moved: Vec<[Model; 2]>,
    /// Correlations of those parameters: the covariance in units of their standard deviations.
    correlation: Vec<Vec<f64>>,
}

/// Names and standard deviations of parameters, and their covariance.
type Named<'a> = (Vec<(&'a str, f64)>, Vec<Vec<f64>>);

/// Covariance and names as `calibrate` writes them into `calibration.quality`.
fn covariance(quality: &Value) -> Option<Named<'_>> {
    let parameters = quality["parameters"].as_array()?;
    let names = parameters
        .iter()
        .map(|p| Some((p["key"].as_str()?, p["sigma"].as_f64()?)))
        .collect::<Option<Vec<_>>>()?;
    let rows = quality["covariance_lower_triangle"]
        .as_array()?
        .iter()
        .map(|row| row.as_array()?.iter().map(Value::as_f64).collect())
        .collect::<Option<Vec<Vec<f64>>>>()?;
    let whole = rows.len() == names.len() && rows.iter().enumerate().all(|(i, r)| r.len() == i + 1);
    whole.then_some((names, rows))
}

impl Spread {
    /// The spread of a profile with a tool; `None` where the calibration says nothing of its
    /// covariance.
    pub(super) fn of(profile: &Profile, tool: &Mounted) -> Option<Self> {
        let (names, rows) = covariance(profile.quality.as_ref()?)?;
        let mut moved = Vec::new();
        let mut kept = Vec::new();
        for (index, (name, sigma)) in names.iter().enumerate() {
            let Some((effect, parameter)) = parameter(profile, name) else {
                continue;
            };
            if *sigma <= 0.0 {
                continue;
            }
            let unit = profile.effects[effect].definition().parameters[parameter].unit;
            let step = STEP * sigma * unit.in_si();
            moved.push([-step, step].map(|by| {
                let mut changed = profile.clone();
                changed.effects[effect].parameters[parameter] += by;
                changed.real_model(tool, &Conditions::default())
            }));
            kept.push(index);
        }
        let entry = |i: usize, j: usize| if i >= j { rows[i][j] } else { rows[j][i] };
        let correlation = kept
            .iter()
            .map(|&i| {
                kept.iter()
                    .map(|&j| entry(i, j) / (names[i].1 * names[j].1))
                    .collect()
            })
            .collect();
        (!kept.is_empty()).then_some(Self { moved, correlation })
    }

    /// One standard deviation of the tool's position along a unit direction, metres; along the
    /// worst axis of the world where there is none.
    pub(super) fn sigma_m(
        &self,
        q: &[f64; 6],
        conditions: &Conditions,
        direction: Option<Vector>,
    ) -> f64 {
        let slopes: Vec<Vector> = self
            .moved
            .iter()
            .map(|models| {
                let [low, high] = models
                    .each_ref()
                    .map(|m| m.forward(q, conditions).translation);
                sub(high, low).map(|x| x / (2.0 * STEP))
            })
            .collect();
        let along = |axis: Vector| {
            let by: Vec<f64> = slopes.iter().map(|slope| dot(*slope, axis)).collect();
            let mut variance = 0.0;
            for (i, row) in self.correlation.iter().enumerate() {
                for (j, c) in row.iter().enumerate() {
                    variance += c * by[i] * by[j];
                }
            }
            variance.max(0.0).sqrt()
        };
        match direction {
            Some(axis) => along(axis),
            None => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
                .map(along)
                .into_iter()
                .fold(0.0, f64::max),
        }
    }
}

/// The effect and parameter of a name such as `link_geometry link 2 alpha_deg`.
fn parameter(profile: &Profile, name: &str) -> Option<(usize, usize)> {
    profile
        .effects
        .iter()
        .enumerate()
        .find_map(|(index, effect)| {
            let key = name.strip_prefix(&effect.label())?.strip_prefix(' ')?;
            let parameters = effect.definition().parameters;
            let parameter = parameters.iter().position(|p| p.key == key)?;
            Some((index, parameter))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::units::{DEG, MM};
    use serde_json::json;

    #[test]
    fn a_joint_offset_of_known_spread_moves_the_tool_by_its_lever() {
        let text = include_str!("../../../../robots/abb_irb120_thesis.yaml");
        let mut profile = Profile::from_yaml(text).expect("a shipped profile");
        let tool = profile.tool("artifact").expect("its tool");
        assert!(Spread::of(&profile, &tool).is_none());
        profile.quality = Some(json!({
            "parameters": [{"key": "link_geometry link 2 theta_deg", "unit": "deg", "sigma": 0.01},
                {"key": "base_frame x_mm", "unit": "mm", "sigma": 0.05},
                {"key": "point nest x_mm", "unit": "mm", "sigma": 9.0}],
            "covariance_lower_triangle": [[1e-4], [0.0, 2.5e-3], [0.0, 0.0, 81.0]],
        }));
        let spread = Spread::of(&profile, &tool).expect("a spread");
        let q = [0.0, 0.3, 0.2, 0.0, 0.7, 0.0];
        let real = profile
            .real_model(&tool, &Conditions::default())
            .forward(&q, &Conditions::default());
        // joint 2 rotates about y at a height of 290 mm
        let (x, z) = (real.translation[0], real.translation[2] - 0.29);
        let up = spread.sigma_m(&q, &Conditions::default(), Some([0.0, 0.0, 1.0]));
        let forward = spread.sigma_m(&q, &Conditions::default(), Some([1.0, 0.0, 0.0]));
        assert!((up - x * 0.01 * DEG).abs() < 1e-6, "{up}");
        assert!(
            (forward - (z * 0.01 * DEG).hypot(0.05 * MM)).abs() < 1e-6,
            "{forward}"
        );
    }
}
