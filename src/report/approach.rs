//! Programs that drive to measuring configurations, every joint arriving from below so that play shows on one side.
//!
//! # Source
//! A. Nubiola, thesis, sec. 2.5: each configuration is approached from 5° less on every joint.

use crate::geometry::units::DEG;

/// Languages a program can be written in.
pub const LANGUAGES: [&str; 5] = ["rapid", "krl", "urscript", "fanuc", "inform"];

fn degrees(q: &[f64; 6], less: f64) -> [String; 6] {
    q.map(|angle| format!("{:.4}", (angle - less) / DEG))
}

/// The program's text; `None` in a language not in [`LANGUAGES`], and in INFORM without `pulses_per_deg`. Joint angles in
/// radians.
#[must_use]
pub fn program(
    language: &str,
    joints: &[[f64; 6]],
    approach_rad: f64,
    pulses_per_deg: Option<[f64; 6]>,
) -> Option<String> {
    let stops = joints
        .iter()
        .enumerate()
        .map(|(i, q)| (i + 1, degrees(q, approach_rad), degrees(q, 0.0)));
    let mut out = String::new();
    match language {
        "rapid" => {
            out += "MODULE Measure\n  PROC main()\n";
            let target = |q: &[String; 6]| format!("[[{}],[9E9,9E9,9E9,9E9,9E9,9E9]]", q.join(","));
            for (n, before, at) in stops {
                out += &format!("    ! configuration {n}\n");
                out += &format!("    MoveAbsJ {},v200,fine,tool0;\n", target(&before));
                out += &format!(
                    "    MoveAbsJ {},v50,fine,tool0;\n    WaitTime 3;\n",
                    target(&at)
                );
            }
            out += "  ENDPROC\nENDMODULE\n";
        }
        "krl" => {
            out += "DEF measure()\nBAS(#INITMOV,0)\nBAS(#VEL_PTP,20)\n";
            let target = |q: &[String; 6]| {
                let axes: Vec<String> = q
                    .iter()
                    .enumerate()
                    .map(|(i, v)| format!("A{} {v}", i + 1))
                    .collect();
                format!("PTP {{{}}}\n", axes.join(","))
            };
            for (n, before, at) in stops {
                out += &format!(
                    "; configuration {n}\n{}{}WAIT SEC 3\n",
                    target(&before),
                    target(&at)
                );
            }
            out += "END\n";
        }
        "urscript" => {
            out += "def measure():\n";
            let target = |q: &[String; 6], speed: f64| {
                let axes: Vec<String> = q.iter().map(|v| format!("d2r({v})")).collect();
                format!("  movej([{}], a=0.5, v={speed})\n", axes.join(", "))
            };
            for (n, before, at) in stops {
                out += &format!(
                    "  # configuration {n}\n{}{}  sleep(3)\n",
                    target(&before, 0.5),
                    target(&at, 0.1)
                );
            }
            out += "end\n";
        }
        "fanuc" => return Some(fanuc(joints, approach_rad)),
        "inform" => return Some(inform(joints, approach_rad, pulses_per_deg?)),
        _ => return None,
    }
    Some(out)
}

/// Two positions a configuration, in joints; the controller's J3 counts as the profile's joint 3 does.
fn fanuc(joints: &[[f64; 6]], approach_rad: f64) -> String {
    let mut out = format!(
        "/PROG  MEASURE\n/ATTR\nLINE_COUNT\t= {};\nDEFAULT_GROUP\t= 1,*,*,*,*;\n/MN\n",
        3 * joints.len()
    );
    let mut places = String::new();
    for (i, q) in joints.iter().enumerate() {
        let (line, place) = (3 * i + 1, 2 * i + 1);
        out += &format!("{line:4}:J P[{place}] 20% FINE    ;\n");
        out += &format!("{:4}:J P[{}] 5% FINE    ;\n", line + 1, place + 1);
        out += &format!("{:4}:  WAIT   3.00(sec) ;\n", line + 2);
        for (place, less) in [(place, approach_rad), (place + 1, 0.0)] {
            let [a, b, c, d, e, f] = q.map(|angle| format!("{:9.3}", (angle - less) / DEG));
            places += &format!("P[{place}]{{\n   GP1:\n\tUF : 0, UT : 1,\t\n");
            places += &format!("\tJ1={a} deg,\tJ2={b} deg,\tJ3={c} deg,\n");
            places += &format!("\tJ4={d} deg,\tJ5={e} deg,\tJ6={f} deg\n}};\n");
        }
    }
    out + "/POS\n" + &places + "/END\n"
}

/// Two positions a configuration, in pulses; lines end as the controller's do.
fn inform(joints: &[[f64; 6]], approach_rad: f64, pulses_per_deg: [f64; 6]) -> String {
    let mut head = format!(
        "/JOB\n//NAME MEASURE\n//POS\n///NPOS {},0,0,0,0,0\n///TOOL 0\n///POSTYPE PULSE\n///PULSE\n",
        2 * joints.len()
    );
    let mut moves = "//INST\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\n".to_owned();
    for (i, q) in joints.iter().enumerate() {
        for (place, less) in [(2 * i, approach_rad), (2 * i + 1, 0.0)] {
            let pulses: [String; 6] = std::array::from_fn(|k| {
                format!(
                    "{:.0}",
                    ((q[k] - less) / DEG * pulses_per_deg[k]).round() + 0.0
                )
            });
            head += &format!("C{place:05}={}\n", pulses.join(","));
        }
        moves += &format!("MOVJ C{:05} VJ=20.00\n", 2 * i);
        moves += &format!("MOVJ C{:05} VJ=5.00 PL=0\nTIMER T=3.00\n", 2 * i + 1);
    }
    (head + &moves + "END\n").replace('\n', "\r\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_configuration_is_reached_from_below() {
        let joints = [[0.0, 0.1, -0.2, 0.3, 0.4, -0.5]];
        for language in LANGUAGES {
            let text = program(
                language,
                &joints,
                5.0 * DEG,
                Some([1000.0, -1000.0, 1000.0, 1000.0, 1000.0, 1000.0]),
            )
            .expect("a language of the list");
            let [first, at, last] = match language {
                "fanuc" => ["-5.000", "0.000", "22.918"],
                // joint 2 counts the other way: 0.1 rad
                "inform" => ["-5000,-730,", "0,-5730,", "22918"],
                _ => ["-5.0000", "0.0000", "22.9183"],
            };
            let before = text.find(first).expect("the approach");
            assert!(
                text[before + 1..].contains(at) && text.contains(last),
                "{language}: {text}"
            );
        }
        assert!(program("cobol", &joints, 0.0, None).is_none());
        assert!(program("inform", &joints, 0.0, None).is_none());
    }
}
