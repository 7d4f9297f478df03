//! Moves on which a positioner moves the part, with and without words that make the tool go with it, and
//! such on which a rail goes.

use crate::support::{run, scratch, text};
use serde_json::Value;

/// A table that rotates about z in front of the arm.
const TABLE: &str = "external_axes:\n  positioners:\n    - name: G2\n      follows: always\n      axes:\n        \
     - {axis: G2J1, at: {x_mm: 565.52, y_mm: 0, z_mm: -46.21, rx_deg: 0, ry_deg: 0, rz_deg: 0}, min_deg: -180, \
     max_deg: 180}\n      plate: {x_mm: 0, y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0}\n";

/// The work frame on it.
const PLATE: &str = "1=0,0,0,0,0,0";

fn listing(words: &str, table_deg: [f64; 2]) -> String {
    let group = |deg: f64| format!("   GP2:\n\tUF : 1, UT : 1,\t\n\tJ1 = {deg:.3} deg\n}};\n");
    let pose = |number: u32, y: f64, r: f64, deg: f64| {
        format!(
            "P[{number}]{{\n   GP1:\n\tUF : 1, UT : 1,\tCONFIG : 'N U T, 0, 0, 0',\n\tX = -40.000 mm,\tY = {y:.3} \
             mm,\tZ = 120.000 mm,\n\tW = 180.000 deg,\tP = 0.000 deg,\tR = {r:.3} deg\n{}",
            group(deg)
        )
    };
    format!(
        "/PROG  T\n/ATTR\nDEFAULT_GROUP = 1,1,*,*,*;\n/MN\n   1:  UFRAME_NUM=1 ;\n   2:  UTOOL_NUM=1 ;\n   3:  J P[1] \
         50% FINE ;\n   4:  L P[2] 100mm/sec FINE{words} ;\n/POS\n{}{}/END\n",
        pose(1, -60.0, 0.0, table_deg[0]),
        pose(2, 60.0, 0.0, table_deg[1])
    )
}

/// What `check` finds of the straight move, and whether it knows its path.
fn found(program: &str, external: &str, frame: &str) -> (Vec<String>, Value) {
    let folder = scratch();
    let at = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("scratch");
        path.display().to_string()
    };
    let program = at("t.ls", program.to_owned());
    let profile = at(
        "p.yaml",
        text("robots/fanuc_lrmate200ic.yaml").trim_end().to_owned() + "\n" + external,
    );
    let given = ["--tool", "1=0,0,100,0,0,0", "--frame", frame];
    let command = ["check", &program, "--profile", &profile, "--json"];
    let (status, out, said) = run(&[&command[..], &given].concat());
    let report: Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{status}: {said}"));
    let about = report["findings"].as_array().expect("a list").iter();
    let about = about.filter(|f| f["id"] == "path-uncertified");
    let messages = about.map(|f| f["message"].as_str().expect("a text").to_owned());
    (
        messages.collect(),
        report["moves"][1]["path_certified"].clone(),
    )
}

#[test]
fn a_path_that_does_not_go_with_the_part_is_not_certified() {
    let turning = [-20.0, 20.0];
    let (said, certified) = found(&listing("", turning), TABLE, PLATE);
    assert!(
        said.len() == 1 && said[0].contains("no COORD") && certified == false,
        "{said:?}"
    );
    for (words, table_deg) in [(" COORD", turning), ("", [20.0, 20.0])] {
        let (said, certified) = found(&listing(words, table_deg), TABLE, PLATE);
        assert!(
            said.is_empty() && certified == true,
            "{words}: {said:?} {certified}"
        );
    }
}

/// The table rotates from -100 to 120 degrees under a tool that points down, 100 mm from its middle. The tool
/// goes to the left on the straight line, and comes back from there on the part: y is 100 mm times the
/// sine. Joint 1 has 0.1 degrees of backlash, and is the angle of the tool about the arm.
#[test]
fn a_joint_comes_from_the_side_of_the_path_that_the_words_say() {
    let profile = text("robots/fanuc_lrmate200ic.yaml");
    let nominal = profile.split("\ncalibration:").next().expect("a profile");
    let profile = format!(
        "{nominal}\n{TABLE}calibration:\n  effects:\n    - {{effect: backlash, joint: 1, width_deg: 0.1}}\n"
    );
    let angles = [-100.0_f64, 120.0];
    let pose = |number: u32, deg: f64| {
        format!(
            "P[{number}]{{\n   GP1:\n\tUF : 1, UT : 1,\tCONFIG : 'N U T, 0, 0, 0',\n\tX = 100.000 mm,\tY = 0.000 \
             mm,\tZ = 120.000 mm,\n\tW = 180.000 deg,\tP = 0.000 deg,\tR = {:.3} deg\n   GP2:\n\tUF : 1, UT : \
             1,\t\n\tJ1 = {deg:.3} deg\n}};\n",
            -deg
        )
    };
    let shift_deg = |words: &str| -> f64 {
        let folder = scratch();
        let at = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).expect("scratch");
            path.display().to_string()
        };
        let program = format!(
            "/PROG  T\n/ATTR\nDEFAULT_GROUP = 1,1,*,*,*;\n/MN\n   1:  UFRAME_NUM=1 ;\n   2:  UTOOL_NUM=1 ;\n   3:  \
             J P[1] 50% FINE ;\n   4:  L P[2] 100mm/sec FINE{words} ;\n/POS\n{}{}/END\n",
            pose(1, angles[0]),
            pose(2, angles[1])
        );
        let (from, to) = (at("t.ls", &program), folder.path().join("out.ls"));
        let to = to.display().to_string();
        let profile = at("p.yaml", &profile);
        let (status, _, said) = run(&[
            "compensate",
            &from,
            "--profile",
            &profile,
            "-o",
            &to,
            "--tool",
            "1=0,0,100,0,0,0",
            "--frame",
            PLATE,
            "--start-joints",
            "0,0,0,0,-90,0,-100",
        ]);
        assert!(status < 2, "{said}");
        let fake = std::fs::read_to_string(&to).expect("a program");
        let number = |key: &str| -> f64 {
            let behind = fake.split("P[2]{").nth(1).and_then(|p| p.split(key).nth(1));
            let number = behind.and_then(|text| text.split_whitespace().next());
            number.expect("a number").parse().expect("a number")
        };
        let angle = |x: f64, y: f64| {
            let (sin, cos) = angles[1].to_radians().sin_cos();
            (sin * x + cos * y)
                .atan2(565.52 + cos * x - sin * y)
                .to_degrees()
        };
        angle(number("X ="), number("Y =")) - angle(100.0, 0.0)
    };
    // what comes from the right is 0.05 degrees too far to the left
    for (words, by) in [("", -0.05), (" COORD", 0.05)] {
        approx::assert_abs_diff_eq!(shift_deg(words), by, epsilon = 1e-3);
    }
}

#[test]
fn a_path_on_which_the_rail_goes_is_certified() {
    let rail = "external_axes:\n  track:\n    - {axis: E1, direction: [0, 1, 0], up: [0, 0, 1], zero_mm: 0, \
        min_mm: -1000, max_mm: 1000}\n";
    let program = listing("", [0.0, 0.0]);
    let on_rail = |text: &str, group: &str, e1: f64| {
        let (before, behind) = text.split_once("   GP2:").expect("a group");
        let end = behind.find("};").expect("an end");
        format!(
            "{},\tE1 = {e1:.3} mm\n{}{group}",
            before.trim_end(),
            &behind[end..]
        )
    };
    let program = on_rail(&on_rail(&program, "", 0.0), "", 150.0).replace("1,1,*", "1,*,*");
    let (said, certified) = found(&program, rail, "1=565.52,0,-46.21,0,0,0");
    assert!(said.is_empty() && certified == true, "{said:?} {certified}");
}
