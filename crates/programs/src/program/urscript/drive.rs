//! A program through configurations.

use crate::program::drive::{Step, add};

/// See [`crate::program::Language::drive`].
pub(super) fn drive(steps: &[Step]) -> String {
    let mut out = "def measure():\n".to_owned();
    add(&mut out, steps, "  # ", "  sleep(3)\n", |axes, measured| {
        let axes = axes.map(|v| format!("d2r({v})")).join(", ");
        let speed = if measured { 0.1 } else { 0.5 };
        format!("  movej([{axes}], a=0.5, v={speed})\n")
    });
    out + "end\n"
}
