//! A program through configurations.

use crate::program::drive::Step;

/// See [`crate::program::Language::drive`].
pub(super) fn drive(steps: &[Step]) -> String {
    let mut out = "def measure():\n".to_owned();
    for step in steps {
        if let Some(number) = step.begins {
            out += &format!("  # configuration {number}\n");
        }
        let axes = step.degrees().map(|v| format!("d2r({v})")).join(", ");
        let speed = if step.measured { 0.1 } else { 0.5 };
        out += &format!("  movej([{axes}], a=0.5, v={speed})\n");
        if step.measured {
            out += "  sleep(3)\n";
        }
    }
    out + "end\n"
}
