//! Programs that drive to measuring configurations, every joint arriving from below so that play shows on one side.
//!
//! # Source
//! A. Nubiola, thesis, sec. 2.5: each configuration is approached from 5° less on every joint.

use crate::geometry::units::DEG;

/// Languages a program can be written in.
pub const LANGUAGES: [&str; 5] = ["rapid", "krl", "urscript", "fanuc", "inform"];

/// A configuration and the poses that the arm goes over before it comes to where it is approached from; joints in radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// What it goes over.
    pub over: Vec<[f64; 6]>,
    /// Where it is measured.
    pub q: [f64; 6],
}

/// One move.
struct Step {
    /// Number of the configuration, before its first move.
    begins: Option<usize>,
    q: [f64; 6],
    /// Whether the arm comes slowly and stays to be measured.
    measured: bool,
}

/// The moves of all configurations: what they go over, where they are approached from, the configuration.
fn steps(stops: &[Stop], approach_rad: f64) -> Vec<Step> {
    let mut steps = Vec::new();
    for (i, stop) in stops.iter().enumerate() {
        let approach = stop.q.map(|angle| angle - approach_rad);
        let places = stop.over.iter().chain([&approach, &stop.q]);
        let last = stop.over.len() + 1;
        steps.extend(places.enumerate().map(|(k, q)| Step {
            begins: (k == 0).then_some(i + 1),
            q: *q,
            measured: k == last,
        }));
    }
    steps
}

fn degrees(q: &[f64; 6]) -> [String; 6] {
    q.map(|angle| format!("{:.4}", angle / DEG))
}

/// The program's text; `None` in a language not in [`LANGUAGES`], and in INFORM without `pulses_per_deg`.
#[must_use]
pub fn program(
    language: &str,
    stops: &[Stop],
    approach_rad: f64,
    pulses_per_deg: Option<[f64; 6]>,
) -> Option<String> {
    let steps = steps(stops, approach_rad);
    let mut out = String::new();
    match language {
        "rapid" => {
            out += "MODULE Measure\n  PROC main()\n";
            for step in &steps {
                if let Some(number) = step.begins {
                    out += &format!("    ! configuration {number}\n");
                }
                let speed = if step.measured { "v50" } else { "v200" };
                let axes = degrees(&step.q).join(",");
                out += &format!(
                    "    MoveAbsJ [[{axes}],[9E9,9E9,9E9,9E9,9E9,9E9]],{speed},fine,tool0;\n"
                );
                if step.measured {
                    out += "    WaitTime 3;\n";
                }
            }
            out += "  ENDPROC\nENDMODULE\n";
        }
        "krl" => {
            out += "DEF measure()\nBAS(#INITMOV,0)\nBAS(#VEL_PTP,20)\n";
            for step in &steps {
                if let Some(number) = step.begins {
                    out += &format!("; configuration {number}\n");
                }
                let axes = degrees(&step.q).into_iter().enumerate();
                let axes: Vec<String> = axes.map(|(i, v)| format!("A{} {v}", i + 1)).collect();
                out += &format!("PTP {{{}}}\n", axes.join(","));
                if step.measured {
                    out += "WAIT SEC 3\n";
                }
            }
            out += "END\n";
        }
        "urscript" => {
            out += "def measure():\n";
            for step in &steps {
                if let Some(number) = step.begins {
                    out += &format!("  # configuration {number}\n");
                }
                let axes: Vec<String> = degrees(&step.q).map(|v| format!("d2r({v})")).into();
                let speed = if step.measured { 0.1 } else { 0.5 };
                out += &format!("  movej([{}], a=0.5, v={speed})\n", axes.join(", "));
                if step.measured {
                    out += "  sleep(3)\n";
                }
            }
            out += "end\n";
        }
        "fanuc" => return Some(fanuc(&steps)),
        "inform" => return Some(inform(&steps, pulses_per_deg?)),
        _ => return None,
    }
    Some(out)
}

/// A position a move, in joints; the controller's J3 counts as the profile's joint 3 does.
fn fanuc(steps: &[Step]) -> String {
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

/// A position a move, in pulses; lines end as the controller's do.
fn inform(steps: &[Step], pulses_per_deg: [f64; 6]) -> String {
    let mut head = format!(
        "/JOB\n//NAME MEASURE\n//POS\n///NPOS {},0,0,0,0,0\n///TOOL 0\n///POSTYPE PULSE\n///PULSE\n",
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_configuration_is_reached_from_below() {
        let stops = [Stop {
            over: vec![[0.5; 6]],
            q: [0.0, 0.1, -0.2, 0.3, 0.4, -0.5],
        }];
        for language in LANGUAGES {
            let text = program(
                language,
                &stops,
                5.0 * DEG,
                Some([1000.0, -1000.0, 1000.0, 1000.0, 1000.0, 1000.0]),
            )
            .expect("a language of the list");
            let [over, first, at, last] = match language {
                "fanuc" => ["28.648", "-5.000", "0.000", "22.918"],
                // joint 2 counts the other way: 0.1 rad
                "inform" => ["28648,-28648", "-5000,-730,", "0,-5730,", "22918"],
                _ => ["28.6479", "-5.0000", "0.0000", "22.9183"],
            };
            let between = text.find(over).expect("the pose between");
            let before = text.find(first).expect("the approach");
            assert!(
                between < before && text[before + 1..].contains(at) && text.contains(last),
                "{language}: {text}"
            );
        }
        assert!(program("cobol", &stops, 0.0, None).is_none());
        assert!(program("inform", &stops, 0.0, None).is_none());
    }
}
