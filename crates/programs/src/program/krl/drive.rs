//! A program through configurations.

use crate::program::drive::Step;

/// See [`crate::program::Language::drive`].
pub(super) fn drive(steps: &[Step]) -> String {
    let mut out = "DEF measure()\nBAS(#INITMOV,0)\nBAS(#VEL_PTP,20)\n".to_owned();
    for step in steps {
        if let Some(number) = step.begins {
            out += &format!("; configuration {number}\n");
        }
        let axes = step.degrees().into_iter().enumerate();
        let axes: Vec<String> = axes.map(|(i, v)| format!("A{} {v}", i + 1)).collect();
        out += &format!("PTP {{{}}}\n", axes.join(","));
        if step.measured {
            out += "WAIT SEC 3\n";
        }
    }
    out + "END\n"
}
