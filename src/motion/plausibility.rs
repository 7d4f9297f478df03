//! Units that cannot be meant: tools of tenths of a millimetre, masses that no robot of this kind
//! carries.

use super::ground::Ground;
use crate::finding::{Finding, Severity};
use crate::geometry::units::mm_from_m;
use crate::model::profile::is_tiny;

/// Checks the units of the tools that moves have, each at the first move that has it.
pub(crate) fn units(ground: &Ground, severity: Severity, findings: &mut Vec<Finding>) {
    let mut seen = vec![false; ground.program.tools.len()];
    for motion in &ground.program.moves {
        if std::mem::replace(&mut seen[motion.tool], true) {
            continue;
        }
        let Some(tool) = &ground.setting.tools[motion.tool] else {
            continue;
        };
        let name = &ground.program.tools[motion.tool].name;
        let named = if name.is_empty() {
            "the tool of this move".into()
        } else {
            format!("tool `{name}`")
        };
        // who writes metres into the text has not taken them for millimetres
        let of_text = ground.program.tools[motion.tool].flange_from_tool.is_some();
        let may_be_metres = !(of_text && ground.language.is_in_metres());
        if may_be_metres && is_tiny(&tool.flange_from_tool) {
            let off = tool.flange_from_tool.translation;
            let largest = off.iter().fold(0.0, |most: f64, m| most.max(m.abs()));
            let message = format!(
                "{named} is {} mm from the flange at most in each coordinate; below 1 mm the limit \
                 is reached where metres are \
                 taken for millimetres",
                (mm_from_m(largest) * 1e6).round() / 1e6
            );
            findings.push(ground.at_move(
                "tool-unit",
                severity,
                motion,
                message,
                "write it in the unit of the language (mm; metres in URScript), or 0 for the \
                 flange itself",
            ));
        }
        let (payload, load) = (ground.profile.payload_kg, tool.load);
        if let (Some(payload), Some((mass_kg, _))) = (payload, load)
            && mass_kg > payload
        {
            findings.push(ground.at_move(
                "load-beyond-payload",
                severity,
                motion,
                format!(
                    "the load of {named} is {mass_kg} kg; robot.payload_kg of the profile is \
                    {payload} kg"
                ),
                "masses are in kg; correct the load, or robot.payload_kg",
            ));
        }
    }
}
