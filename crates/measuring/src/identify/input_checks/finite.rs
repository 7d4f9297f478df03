//! A model that gives no finite numbers: nothing can be compared with it.

use crate::identify::error::IdentifyError;
use crate::identify::measurements::Measurements;
use crate::identify::problem::tool_of;
use crate::model::{Conditions, Model};
use crate::profile::Profile;

/// Refuses a profile whose arm has no finite pose at a row, or torques whose squares are not
/// finite: its compliances are found by these.
///
/// # Errors
/// The first such row.
pub(crate) fn check(profile: &Profile, measurements: &Measurements) -> Result<(), IdentifyError> {
    let mut last: Option<(_, Model)> = None;
    for row in measurements.rows.iter().filter(|row| row.plate.is_none()) {
        // a tool that nobody knows is an error of its own
        let Ok(tool) = tool_of(profile, row) else {
            continue;
        };
        let conditions = Conditions {
            temperature_c: row.conditions.temperature_c,
            time_s: row.conditions.time_s,
            ..Conditions::default()
        };
        let key = (tool, conditions, row.stand.bits());
        let (_, model) = match last.take() {
            Some(same) if same.0 == key => last.insert(same),
            _ => {
                let model = profile.real_model_at(&key.0, &key.1, &row.stand);
                last.insert((key, model))
            }
        };
        let torques = model.torques(&row.q, &row.conditions);
        let squares: f64 = torques.iter().map(|torque| torque * torque).sum();
        if !squares.is_finite() || !model.forward(&row.q, &row.conditions).is_finite() {
            return Err(IdentifyError::NotFinite {
                line: row.line.clone(),
            });
        }
    }
    Ok(())
}
