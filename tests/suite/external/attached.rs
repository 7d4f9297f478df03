//! Bodies on the plate of a positioner: what the arm, or what stands, only touches because the
//! plate rotated is found, and the bound of the clearance holds against dense samples of the
//! reference.

use super::checked::tooldata;
use super::landing::{Cell, arm, inverse, table_cell};
use super::measured::{put, with_tool};
use super::{rapid, tool};
use crate::physics::external::{Table, plate};
use crate::physics::matrix::{M4, V3, add, cross, dot, point, sub};
use crate::physics::{Fault, Moment, Robot, tool_pose};
use crate::support::{poseshift, scratch};
use crate::trial::truth::robot_of;
use poseshift::geometry::Pose;
use poseshift::model::profile::{Mounted, Profile};
use serde_json::Value;
use std::path::Path;

/// Parts of a move that the reference looks at.
const SAMPLES: u32 = 2000;
/// The arm goes from the one to the other while the plate rotates.
const FROM: [f64; 6] = [0.1, 0.5, -0.1, 0.2, 0.8, 0.3];
const TO: [f64; 6] = [-0.1, 0.6, -0.2, 0.1, 0.9, 0.1];
/// Where both axes of the positioner begin and end, degrees.
const TURNS: [[f64; 2]; 2] = [[-70.0, -50.0], [60.0, 80.0]];
/// The ball on the flange, mm in its frame, and the radii of both bodies.
const BALL: V3 = [0.0, 60.0, 30.0];
const RADII: [f64; 2] = [25.0, 30.0];

/// A positioner of two axes with everything wrong, and the arm.
struct Scene {
    cell: Cell,
    profile: String,
    with_ball: Robot,
    faults: Vec<Fault>,
}

fn external(cell: &Cell) -> String {
    let named = cell.external.replace("AXIS1", "eax_b");
    let named = named.replace("AXIS2", "eax_c").replace("UNIT", "STN1");
    named.replace("FOLLOWS", "frame")
}

fn scene() -> Scene {
    let cell = table_cell(2);
    let (arm_effects, faults) = arm();
    let effects: Vec<&str> = arm_effects
        .iter()
        .chain(&cell.effects)
        .map(String::as_str)
        .collect();
    let profile = with_tool(&external(&cell), &effects);
    let read = Profile::from_yaml(&profile).expect("a profile");
    let [a, b, c] = BALL.map(|mm| 1e-3 * mm);
    let ball = Mounted {
        flange_from_tool: Pose::from_xyz_rxryrz([a, b, c, 0.0, 0.0, 0.0]),
        ..tool()
    };
    let with_ball = robot_of(&read, &ball);
    Scene {
        cell,
        profile,
        with_ball,
        faults,
    }
}

fn place(m: &M4) -> V3 {
    [m[0][3], m[1][3], m[2][3]]
}

fn length(v: V3) -> f64 {
    dot(v, v).sqrt()
}

impl Scene {
    /// The ball of the real arm, or of the controller's.
    fn ball(&self, real: bool, s: f64) -> V3 {
        let q: [f64; 6] = std::array::from_fn(|i| FROM[i] + s * (TO[i] - FROM[i]));
        let faults = if real { self.faults.as_slice() } else { &[] };
        place(&tool_pose(&self.with_ball, faults, &q, &Moment::default()))
    }

    /// The plate.
    fn plate(&self, real: bool, s: f64) -> M4 {
        let e: Vec<f64> = (0..2)
            .map(|k| (TURNS[0][k] + s * (TURNS[1][k] - TURNS[0][k])).to_radians())
            .collect();
        if real {
            return plate(
                &self.cell.tables,
                &self.cell.on_axis,
                &self.cell.plate_fault,
                &e,
            );
        }
        let without = |table: &Table| Table {
            faults: Vec::new(),
            ..table.clone()
        };
        let tables: Vec<Table> = self.cell.tables.iter().map(without).collect();
        plate(&tables, &self.cell.on_axis, &[0.0; 6], &e)
    }

    /// The body of the plate, in its frame, that is so far from something halfway, mm: across the
    /// direction in which they pass each other.
    fn passing(&self, other: &dyn Fn(f64) -> V3, gap_mm: f64) -> V3 {
        let middle = other(0.5);
        let into = inverse(&self.plate(true, 0.5));
        let here = point(&into, middle);
        let before = point(&inverse(&self.plate(true, 0.499)), other(0.499));
        let along = sub(here, before);
        let across = cross(along, [0.3, -0.5, 0.8]);
        let by = 1e-3 * (RADII[0] + RADII[1] + gap_mm) / length(across);
        add(here, across.map(|x| by * x))
    }

    /// The least distance of a body of the plate from something on the way, mm.
    fn least(&self, real: bool, body: V3, other: &dyn Fn(f64) -> V3, turning: bool) -> f64 {
        let all = (0..=SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES));
        let far = all.map(|s| {
            let plate = self.plate(real, if turning { s } else { 0.0 });
            1e3 * length(sub(point(&plate, body), other(s))) - RADII[0] - RADII[1]
        });
        far.fold(f64::INFINITY, f64::min)
    }

    /// A program: the arm's move, with or without the positioner.
    fn program(&self, folder: &Path, turns: [[f64; 2]; 2]) -> std::path::PathBuf {
        let line = |q: &[f64; 6], [b, c]: [f64; 2]| {
            let q = q.map(|q| format!("{:.9}", q.to_degrees())).join(",");
            format!("MoveAbsJ [[{q}],[9E9,{b},{c},9E9,9E9,9E9]],v100,fine,t;\n")
        };
        let body = line(&FROM, turns[0]) + &line(&TO, turns[1]);
        put(folder, "t.mod", &rapid(&tooldata(), &body))
    }
}

fn sphere(name: &str, to: &str, at: V3, radius_mm: f64) -> String {
    let [x, y, z] = at.map(|m| 1e3 * m);
    format!(
        "  - {{name: {name}, {to}sphere_mm: {{radius: {radius_mm}}}, at: {{x_mm: {x:.6}, y_mm: \
         {y:.6}, z_mm: {z:.6}, rx_deg: 0, ry_deg: 0, rz_deg: 0}}}}\n"
    )
}

fn cell_of(bodies: &str, attached: &str) -> String {
    let bodies = match bodies {
        "" => String::new(),
        some => format!("bodies:\n{some}"),
    };
    // the arm goes through what only its tool is to meet
    let links: Vec<String> = (0..=6)
        .map(|link| format!("{{a: link{link}, b: part, allow: true}}"))
        .collect();
    let links = links.join(", ");
    format!("poseshift: cell/1\n{bodies}attached:\n{attached}pairs: [{links}]\n")
}

/// Status and report of `check`, or what it says where there is none.
fn check(folder: &Path, profile: &str, program: &Path, cell: &str) -> (Option<i32>, Value) {
    let done = poseshift()
        .args(["check", "--json"])
        .arg(program)
        .arg("--profile")
        .arg(put(folder, "p.yaml", profile))
        .arg("--cell")
        .arg(put(folder, "cell.yaml", cell))
        .arg("--report")
        .arg(folder.join("page.html"))
        .output()
        .expect("the program starts");
    let reported = String::from_utf8_lossy(&done.stderr).into_owned();
    let report = serde_json::from_slice(&done.stdout).unwrap_or(Value::String(reported));
    (done.status.code(), report)
}

fn last(report: &Value) -> Value {
    let moves = report["moves"]
        .as_array()
        .unwrap_or_else(|| panic!("{report:#}"));
    moves.last().expect("a move").clone()
}

fn number(of: &Value, key: &str) -> f64 {
    of[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} of {of:#}"))
}

/// A body of the plate that something passes: at `hits` they touch, at the other they do not, and
/// where the plate stays they do not either.
fn passes(scene: &Scene, bodies: &str, attached: &str, carrier: &str, other: &dyn Fn(f64) -> V3) {
    let folder = scratch();
    let radius = RADII[1];
    for (gap_mm, hits) in [(-4.0, true), (9.0, false)] {
        let body = scene.passing(other, gap_mm);
        let part = sphere("part", &format!("to: {carrier}, "), body, radius);
        let cell = cell_of(bodies, &(attached.to_owned() + &part));
        let program = scene.program(folder.path(), TURNS);
        let (status, report) = check(folder.path(), &scene.profile, &program, &cell);
        let least = scene.least(true, body, other, true);
        assert_eq!(least < 0.0, hits, "the reference: {least} mm");
        let found = report["findings"].to_string();
        assert_eq!(found.contains("\"collision\""), hits, "{report:#}");
        assert_eq!(status == Some(0), !hits, "{report:#}");
        if !hits {
            let found = last(&report);
            let bound = number(&found, "clearance_mm");
            assert!(
                bound <= least + 1e-6 && bound >= least - 0.02,
                "{bound} of {least} mm"
            );
            assert!(found["clearance"].to_string().contains("part"), "{found:#}");
        }
        let stays = scene.program(folder.path(), [TURNS[0]; 2]);
        let (_, report) = check(folder.path(), &scene.profile, &stays, &cell);
        assert!(
            scene.least(true, body, other, false) > 0.0,
            "it passes for another reason"
        );
        assert!(
            !report["findings"].to_string().contains("\"collision\""),
            "{report:#}"
        );
    }
}

#[test]
fn what_the_arm_only_touches_because_the_plate_rotated_is_found() {
    let scene = scene();
    let ball = sphere("ball", "to: flange, ", BALL.map(|mm| 1e-3 * mm), RADII[0]);
    passes(&scene, "", &ball, "positioner1", &|s| scene.ball(true, s));
}

#[test]
fn the_controllers_own_arm_and_plate_are_compared_likewise() {
    let scene = scene();
    let folder = scratch();
    let ball = sphere("ball", "to: flange, ", BALL.map(|mm| 1e-3 * mm), RADII[0]);
    let body = scene.passing(&|s| scene.ball(true, s), 12.0);
    let part = sphere("part", "to: positioner STN1, ", body, RADII[1]);
    let program = scene.program(folder.path(), TURNS);
    let cell = cell_of("", &(ball + &part));
    let (_, report) = check(folder.path(), &scene.profile, &program, &cell);
    let found = last(&report);
    let nominal = scene.least(false, body, &|s| scene.ball(false, s), true);
    let real = scene.least(true, body, &|s| scene.ball(true, s), true);
    assert!((nominal - real).abs() > 0.3, "{nominal} and {real} mm");
    for (key, least) in [("nominal_clearance_mm", nominal), ("clearance_mm", real)] {
        let bound = number(&found, key);
        assert!(
            bound <= least + 1e-6 && bound >= least - 0.02,
            "{key}: {bound} of {least} mm"
        );
    }
}

#[test]
fn what_stands_next_to_the_plate_is_touched_by_what_rides_on_it() {
    let scene = scene();
    // beyond the plate, seen from the arm
    let post = point(&scene.plate(true, 0.5), [0.25, 0.1, 0.05]);
    let standing = sphere("post", "", post, RADII[0]);
    passes(&scene, &standing, "", "positioner STN1", &|_| post);
}

#[test]
fn the_page_has_the_plate_and_where_it_stands_at_each_move() {
    let scene = scene();
    let folder = scratch();
    let part = sphere("part", "to: positioner1, ", [0.0, 0.3, 0.4], 20.0);
    let program = scene.program(folder.path(), TURNS);
    check(folder.path(), &scene.profile, &program, &cell_of("", &part));
    let page = crate::report::data(&folder.path().join("page.html"));
    let sections = page["sections"].as_array().expect("sections");
    let cell = sections
        .iter()
        .find(|section| section["robot"].is_object())
        .unwrap_or_else(|| panic!("{page:#}"));
    let station = &cell["robot"]["external"]["positioners"][0];
    assert_eq!(station["axes"].as_array().map(Vec::len), Some(2));
    assert_eq!(station["shapes"][0]["name"], "part", "{station:#}");
    let at = cell["points"]["external"].as_array().expect("places");
    let at: Vec<Option<f64>> = at.iter().map(Value::as_f64).collect();
    assert_eq!(at, TURNS.concat().into_iter().map(Some).collect::<Vec<_>>());
}

#[test]
fn a_plate_is_followed_from_where_it_stood_at_a_move_that_it_does_not_matter_to() {
    let folder = scratch();
    let profile = crate::support::text("programs/rapid/positioner/profile.yaml");
    let post = "  - {name: post, sphere_mm: {radius: 10}, at: {x_mm: 1243, y_mm: 100, z_mm: 690, \
                rx_deg: 0, ry_deg: 0, rz_deg: 0}}\n";
    let gun = "  - {name: gun, to: flange, capsule_mm: {from: [0, 0, 0], to: [0, 0, 175], radius: \
               5}}\n";
    let cell = format!(
        "poseshift: cell/1\nclearance_mm: 20\nbodies:\n{post}attached:\n{gun}pairs: [{{a: gun, \
         b: link4, allow: true}}, {{a: gun, b: link5, allow: true}}, {{a: gun, b: link6, allow: \
         true}}]\n"
    );
    let data = "PERS tooldata tMill:=[TRUE,[[0,0,180],[1,0,0,0]],[4.5,[0,0,90],[1,0,0,0],0,0,0]];\n\
        PERS wobjdata w:=[FALSE,FALSE,\"STN1\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];";
    // the same pose, in the world and on the plate: from there on the plate rotates
    let from = [
        "MoveJ [[1250,100,760],[0,1,0,0],[0,0,0,0],[9E9,0,9E9,9E9,9E9,9E9]],v60,fine,tMill;",
        "MoveJ [[0,-200,0],[0.70710678,-0.70710678,0,0],[0,0,0,0],[9E9,0,9E9,9E9,9E9,9E9]],v60,\
         fine,tMill\\WObj:=w;",
    ];
    for start in from {
        let body = format!(
            "MoveAbsJ [[0,10,20,0,60,0],[9E9,0,9E9,9E9,9E9,9E9]]\\NoEOffs,v500,fine,tMill;\n\
             {start}\nMoveL [[-240,0,0],[0.47314679,-0.47314679,0.52548275,-0.52548275],\
             [0,0,0,0],[9E9,90,9E9,9E9,9E9,9E9]],v60,fine,tMill\\WObj:=w;\n"
        );
        let program = put(folder.path(), "t.mod", &rapid(data, &body));
        let (status, report) = check(folder.path(), &profile, &program, &cell);
        let found = report["findings"].to_string();
        assert!(
            status == Some(1) && found.contains("post"),
            "{start}\n{report:#}"
        );
    }
}

#[test]
fn where_nobody_knows_the_plate_nothing_is_guessed() {
    let scene = scene();
    let folder = scratch();
    let part = |to: &str| {
        cell_of(
            "",
            &sphere("part", &format!("to: {to}, "), [0.0, 0.3, 0.4], 20.0),
        )
    };
    // the program does not say where the plate stands
    let q = FROM.map(|q| format!("{:.9}", q.to_degrees())).join(",");
    let line = format!("MoveAbsJ [[{q}],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n");
    let program = put(folder.path(), "t.mod", &rapid(&tooldata(), &line));
    let (status, report) = check(
        folder.path(),
        &scene.profile,
        &program,
        &part("positioner1"),
    );
    let found = report["findings"].to_string();
    assert!(
        status == Some(1)
            && found.contains("external-value-unknown")
            && found.contains("eax_b")
            && found.contains("carries bodies of the cell"),
        "{report:#}"
    );
    assert_eq!(last(&report)["clearance_mm"], Value::Null, "{report:#}");
    // nor does the profile know the unit
    for (to, says) in [
        ("positioner2", "positioner1"),
        ("positioner STN2", "positioner STN1"),
    ] {
        let (status, reported) = check(folder.path(), &scene.profile, &program, &part(to));
        let reported = reported.as_str().expect("no report").to_owned();
        assert!(
            status == Some(2)
                && reported.contains("cell.yaml")
                && reported.contains(to)
                && reported.contains(says),
            "{status:?} {reported}"
        );
    }
}
