//! A program through configurations.

use crate::program::drive::{Step, add};

/// See [`crate::program::Language::drive`].
pub(super) fn drive(steps: &[Step]) -> String {
    let mut out = "DEF measure()\nBAS(#INITMOV,0)\nBAS(#VEL_PTP,20)\n".to_owned();
    add(&mut out, steps, "; ", "WAIT SEC 3\n", |axes, _| {
        let axes = axes.into_iter().enumerate();
        let axes: Vec<String> = axes.map(|(i, v)| format!("A{} {v}", i + 1)).collect();
        format!("PTP {{{}}}\n", axes.join(","))
    });
    out + "END\n"
}
