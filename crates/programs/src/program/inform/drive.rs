//! A program through configurations.

use crate::geometry::units::DEG;
use crate::program::drive::Step;

/// A position a move, in pulses; lines end as the controller's do.
pub(super) fn drive(steps: &[Step], pulses_per_deg: [f64; 6]) -> String {
    let mut head = format!(
        "/JOB\n//NAME MEASURE\n//POS\n///NPOS {},0,0,0,0,0\n///TOOL 0\n///POSTYPE \
         PULSE\n///PULSE\n",
        steps.len()
    );
    let mut moves = "//INST\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\n".to_owned();
    for (place, step) in steps.iter().enumerate() {
        let pulses: [String; 6] = std::array::from_fn(|k| {
            format!("{:.0}", (step.q[k] / DEG * pulses_per_deg[k]).round() + 0.0)
        });
        head += &format!("C{place:05}={}\n", pulses.join(","));
        moves += &if step.measured {
            format!("MOVJ C{place:05} VJ=5.00 PL=0\nTIMER T=3.00\n")
        } else {
            format!("MOVJ C{place:05} VJ=20.00\n")
        };
    }
    (head + &moves + "END\n").replace('\n', "\r\n")
}
