//! Joint targets on what a positioner carries, and how axes of points are written.

use super::{errors, options, profile, rapid, sources};
use poseshift::compensate::{Compensation, Options, compensate};
use poseshift::model::profile::Profile;
use poseshift::program;

const TABLE: &str = "external_axes:\n  positioners:\n    - name: STN1\n      follows: FOLLOWS\n      axes:\n        - {axis: AXIS, at: {x_mm: 600, y_mm: 0, z_mm: 300, rx_deg: 0, ry_deg: 0, rz_deg: 0}, min_deg: -180, max_deg: 180}\n";
const EFFECTS: [&str; 2] = [
    "{effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}",
    "{effect: positioner_zero, axis: 1, deg: 0.2}",
];
const WORK: &str =
    "PERS wobjdata w:=[FALSE,FALSE,\"STN1\",[[0,0,0],[1,0,0,0]],[[15,-25,35],[1,0,0,0]]];";

fn table(follows: &str, axis: &str) -> Profile {
    profile(
        &TABLE.replace("FOLLOWS", follows).replace("AXIS", axis),
        &EFFECTS,
    )
}

fn corrected(profile: &Profile, name: &str, text: &str) -> Compensation {
    let sources = sources(&[(name, text)]);
    let language = program::language_of(&sources[0]).expect("a language");
    let options = Options {
        correct_joint_targets: true,
        ..options()
    };
    compensate(language, &sources, profile, &options).expect("read")
}

#[test]
fn joints_for_a_work_object_on_a_plate_are_corrected_on_it() {
    let joints = |follows: &str, wobj: &str| {
        let line =
            format!("MoveAbsJ [[0,10,20,0,60,0],[9E9,30,9E9,9E9,9E9,9E9]],v100,fine,t{wobj};\n");
        let done = corrected(&table(follows, "eax_b"), "t.mod", &rapid(WORK, &line));
        assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
        done.targets[0].q.expect("it is corrected")
    };
    let apart = |a: [f64; 6], b: [f64; 6]| (0..6).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
    let on_plate = joints("frame", "\\WObj:=w");
    assert!(apart(on_plate, joints("always", "")) < 1e-9);
    // a zero that is off by 0.2 degrees turns the plate, and nothing in the world
    let in_world = joints("frame", "");
    assert!(apart(on_plate, in_world) > 1e-4);
    assert!(apart(in_world, joints("frame", "\\WObj:=wobj0")) < 1e-12);
    // an undeclared work object says nothing, and is not asked for
    assert!(apart(in_world, joints("frame", "\\WObj:=other")) < 1e-12);
}

/// A point of two groups.
fn listing(first: &str, second: &str) -> String {
    format!(
        "/PROG  T\n/ATTR\nLINE_COUNT = 2;\n/MN\n   1:  UTOOL_NUM=1 ;\n   2:J P[1] 20% FINE    ;\n/POS\n\
         P[1]{{\n   GP1:\n\tUF : 0, UT : 1,\n\tJ1=  0.000 deg,\tJ2=  10.000 deg,\tJ3=  20.000 deg,\n\
         \tJ4=  0.000 deg,\tJ5=  -60.000 deg,\tJ6=  0.000 deg{first}\n   GP2:\n\tUF : 0, UT : 1,\n\
         \tJ1=  {second}\n}};\n/END\n"
    )
}

#[test]
fn other_axes_of_a_group_that_is_described_and_other_units_are_refused() {
    let table = table("always", "G2J1");
    let found = |first: &str, second: &str| {
        let done = corrected(&table, "t.ls", &listing(first, second));
        let unknown = done
            .findings
            .iter()
            .filter(|f| f.id == "external-axis-unknown");
        unknown.count()
    };
    assert_eq!(found("", "20.000 deg"), 0);
    assert_eq!(found("", "20.000 deg,\tJ2=  0.000 deg"), 0);
    assert_eq!(found("", "20.000 deg,\tJ2=  10.000 deg"), 1);
    assert_eq!(found("", "20.000  mm"), 1);
    // another group is nobody's
    let third = "20.000 deg\n   GP3:\n\tUF : 0, UT : 1,\n\tJ1=  15.000 deg";
    assert_eq!(found("", third), 0);
}

#[test]
fn a_rail_in_another_unit_is_refused() {
    let rail = "external_axes:\n  track:\n    - {axis: E1, direction: [1, 0, 0], zero_mm: 0, min_mm: 0, max_mm: 2000}\n";
    let profile = profile(rail, &EFFECTS[..1]);
    for (value, wanted) in [
        ("50.0  mm", None),
        ("50.0  cm", Some("`cm`")),
        ("50.0 deg", Some("`deg`")),
    ] {
        let text = listing(&format!(",\n\tE1=  {value}"), "1.000 deg");
        let done = corrected(&profile, "t.ls", &text);
        let said = done
            .findings
            .iter()
            .find(|f| f.id == "external-axis-unknown");
        match wanted {
            None => assert_eq!(said, None),
            Some(unit) => assert!(said.expect(unit).message.contains(unit)),
        }
    }
}

#[test]
fn an_axis_is_not_known_behind_a_routine_that_is_not_in_the_files() {
    let rail = "external_axes:\n  track:\n    - {axis: E1, direction: [1, 0, 0], zero_mm: 0, min_mm: 0, max_mm: 2000}\n";
    let profile = profile(rail, &EFFECTS[..1]);
    let ids = |call: &str, again: &str| {
        let text = format!(
            "DEF t()\n$TOOL={{X 0,Y 0,Z 100,A 0,B 0,C 0}}\n$BASE=$WORLD\n\
             PTP {{A1 0,A2 10,A3 20,A4 0,A5 60,A6 0,E1 500}}\n{call}\
             PTP {{X 640,Y 200,Z 900,A 0,B 90,C 0{again}}}\nEND\n"
        );
        let done = corrected(&profile, "t.src", &text);
        let unknown = done
            .findings
            .iter()
            .filter(|f| f.id == "external-value-unknown");
        unknown
            .map(|f| f.message.contains("`foo`"))
            .collect::<Vec<bool>>()
    };
    assert_eq!(ids("", ""), [false; 0]);
    assert_eq!(ids("foo()\n", ""), [true]);
    assert_eq!(ids("foo()\n", ",E1 500"), [false; 0]);
}
