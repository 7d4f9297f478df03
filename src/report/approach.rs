//! Programs that drive to measuring configurations, every joint arriving from below so that play shows on one side.
//!
//! # Source
//! A. Nubiola, thesis, sec. 2.5: each configuration is approached from 5° less on every joint.

use crate::geometry::units::DEG;

/// Languages a program can be written in.
pub const LANGUAGES: [&str; 3] = ["rapid", "krl", "urscript"];

fn degrees(q: &[f64; 6], less: f64) -> [String; 6] {
    q.map(|angle| format!("{:.4}", (angle - less) / DEG))
}

/// The program's text; `None` in a language not in [`LANGUAGES`]. Joint angles in radians.
#[must_use]
pub fn program(language: &str, joints: &[[f64; 6]], approach_rad: f64) -> Option<String> {
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
        _ => return None,
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_configuration_is_reached_from_below() {
        let joints = [[0.0, 0.1, -0.2, 0.3, 0.4, -0.5]];
        for language in LANGUAGES {
            let text = program(language, &joints, 5.0 * DEG).expect("a language of the list");
            let before = text.find("-5.0000").expect("the approach");
            assert!(
                text[before + 1..].contains("0.0000") && text.contains("22.9183"),
                "{language}"
            );
        }
        assert!(program("cobol", &joints, 0.0).is_none());
    }
}
