//! A program through configurations.

use crate::program::drive::{Step, add};

/// See [`crate::program::Language::drive`].
pub(super) fn drive(steps: &[Step]) -> String {
    let mut out = "MODULE Measure\n  PROC main()\n".to_owned();
    add(
        &mut out,
        steps,
        "    ! ",
        "    WaitTime 3;\n",
        |axes, measured| {
            let (axes, speed) = (axes.join(","), if measured { "v50" } else { "v200" });
            format!("    MoveAbsJ [[{axes}],[9E9,9E9,9E9,9E9,9E9,9E9]],{speed},fine,tool0;\n")
        },
    );
    out + "  ENDPROC\nENDMODULE\n"
}
