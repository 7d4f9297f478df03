//! A program through configurations.

use crate::program::drive::Step;

/// See [`crate::program::Language::drive`].
pub(super) fn drive(steps: &[Step]) -> String {
    let mut out = "MODULE Measure\n  PROC main()\n".to_owned();
    for step in steps {
        if let Some(number) = step.begins {
            out += &format!("    ! configuration {number}\n");
        }
        let speed = if step.measured { "v50" } else { "v200" };
        let axes = step.degrees().join(",");
        out += &format!("    MoveAbsJ [[{axes}],[9E9,9E9,9E9,9E9,9E9,9E9]],{speed},fine,tool0;\n");
        if step.measured {
            out += "    WaitTime 3;\n";
        }
    }
    out + "  ENDPROC\nENDMODULE\n"
}
