//! A program through configurations.

use crate::geometry::units::DEG;
use crate::program::drive::Step;

/// A position a move, in joints; the controller's J3 counts as the profile's joint 3 does.
pub(super) fn drive(steps: &[Step]) -> String {
    let measured = steps.iter().filter(|step| step.measured).count();
    let mut out = format!(
        "/PROG  MEASURE\n/ATTR\nLINE_COUNT\t= {};\nDEFAULT_GROUP\t= 1,*,*,*,*;\n/MN\n",
        steps.len() + measured
    );
    let mut places = String::new();
    let mut line = 0;
    let mut add = |text: &str| {
        line += 1;
        out += &format!("{line:4}:{text} ;\n");
    };
    for (i, step) in steps.iter().enumerate() {
        let (place, speed) = (i + 1, if step.measured { 5 } else { 20 });
        add(&format!("J P[{place}] {speed}% FINE   "));
        if step.measured {
            add("  WAIT   3.00(sec)");
        }
        let [a, b, c, d, e, f] = step.q.map(|angle| format!("{:9.3}", angle / DEG));
        places += &format!("P[{place}]{{\n   GP1:\n\tUF : 0, UT : 1,\t\n");
        places += &format!("\tJ1={a} deg,\tJ2={b} deg,\tJ3={c} deg,\n");
        places += &format!("\tJ4={d} deg,\tJ5={e} deg,\tJ6={f} deg\n}};\n");
    }
    out + "/POS\n" + &places + "/END\n"
}
