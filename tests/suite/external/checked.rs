//! `check` on a rail: its bounds hold against dense samples of the reference, and what the arm only
//! touches because its base moved is found.

use super::landing::{arm, joints};
use super::measured::{put, with_tool};
use super::programs::{Said, numbers_of};
use super::{rapid, tool};
use crate::physics::external::{Rail, RailFault, carried};
use crate::physics::matrix::{M4, V3, dot, frame, sub};
use crate::physics::{Fault, Moment, Robot, tool_pose};
use crate::support::{poseshift, scratch};
use crate::trial::truth::robot_of;
use poseshift::geometry::Pose;
use poseshift::model::profile::{Mounted, Profile};
use serde_json::Value;
use std::path::Path;

const TRACK: &str = "external_axes:\n  track:\n    - {axis: eax_a, direction: [0.6, 0.8, 0.0], up: [0, 0, 1], zero_mm: 500, min_mm: 0, max_mm: 3000}\n";
/// Parts of a move that the reference looks at.
const SAMPLES: u32 = 400;

/// The rail as the controller has it, and as it is: it does not lean.
pub(super) fn rails() -> [Rail; 2] {
    let rad = f64::to_radians;
    let plain = Rail {
        direction: [0.6, 0.8, 0.0],
        up: [0.0, 0.0, 1.0],
        zero: 0.5,
        low: 0.0,
        high: 3.0,
        faults: Vec::new(),
    };
    let bent = Rail {
        faults: vec![
            RailFault::Scale(2.5e-4),
            RailFault::Direction(rad(0.05), rad(-0.04)),
            RailFault::Bent(1, 2, 0.8e-3),
            RailFault::Bent(2, 3, -0.5e-3),
        ],
        ..plain.clone()
    };
    [plain, bent]
}

const EFFECTS: [&str; 4] = [
    "{effect: track_scale, axis: 1, ratio: 2.5e-4}",
    "{effect: track_direction, axis: 1, y_deg: 0.05, z_deg: -0.04}",
    "{effect: track_straightness, axis: 1, along: y, degree: 2, mm: 0.8}",
    "{effect: track_straightness, axis: 1, along: z, degree: 3, mm: -0.5}",
];

/// The profile, and what the reference makes of it with a tool.
pub(super) fn robot(mounted: &Mounted) -> (String, Robot, Vec<Fault>) {
    let (arm_effects, faults) = arm();
    let effects: Vec<&str> = arm_effects
        .iter()
        .map(String::as_str)
        .chain(EFFECTS)
        .collect();
    let text = with_tool(TRACK, &effects);
    let profile = Profile::from_yaml(&text).expect("a profile");
    let robot = robot_of(&profile, mounted);
    (text, robot, faults)
}

/// The same robot with its base where the rail carries it.
pub(super) fn at(robot: &Robot, rail: &Rail, e: f64) -> Robot {
    Robot {
        base: carried(rail, &robot.base, e, 1.0),
        ..robot.clone()
    }
}

fn degrees(q: &[f64; 6]) -> String {
    q.map(|q| format!("{:.9}", q.to_degrees())).join(",")
}

pub(super) fn list(numbers: &[f64]) -> String {
    let each: Vec<String> = numbers.iter().map(|x| format!("{x:.9}")).collect();
    each.join(",")
}

/// The tool of these programs.
pub(super) fn tooldata() -> String {
    let tool = frame(&[0.03, -0.02, 0.11, 0.1, 0.2, -0.3]);
    let n = numbers_of(Said::Rapid, &tool);
    format!(
        "PERS tooldata t:=[TRUE,[[{}],[{}]],[2,[10,0,60],[1,0,0,0],0,0,0]];",
        list(&n[..3]),
        list(&n[3..])
    )
}

pub(super) fn joint_move(q: &[f64; 6], e: f64) -> String {
    format!(
        "MoveAbsJ [[{}],[{},9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n",
        degrees(q),
        1e3 * e
    )
}

/// Status and report of `check`.
pub(super) fn check(
    folder: &Path,
    profile: &str,
    body: &str,
    cell: Option<&str>,
) -> (Option<i32>, Value) {
    let program = put(folder, "t.mod", &rapid(&tooldata(), body));
    let profile = put(folder, "p.yaml", profile);
    let mut command = poseshift();
    command
        .args(["check", "--json"])
        .arg(&program)
        .arg("--profile")
        .arg(&profile);
    if let Some(cell) = cell {
        command.arg("--cell").arg(put(folder, "cell.yaml", cell));
    }
    let done = command.output().expect("the program starts");
    let reported = String::from_utf8_lossy(&done.stderr).into_owned();
    let report = serde_json::from_slice(&done.stdout).unwrap_or_else(|_| panic!("{reported}"));
    (done.status.code(), report)
}

pub(super) fn place(m: &M4) -> V3 {
    [m[0][3], m[1][3], m[2][3]]
}

pub(super) fn far(a: V3, b: V3) -> f64 {
    let by = sub(a, b);
    dot(by, by).sqrt()
}

pub(super) const FIRST: [f64; 6] = [0.4, 0.3, -0.2, 0.5, 1.0, -0.4];
const ENDS: [f64; 2] = [0.4, 1.4];

/// Numbers of a report.
pub(super) fn number(of: &Value, key: &str) -> f64 {
    of[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} of {of:#}"))
}

#[test]
fn bounds_of_the_path_hold_while_the_rail_moves() {
    let folder = scratch();
    let [plain, bent] = rails();
    let (profile, robot, faults) = robot(&tool());
    let nominal =
        |q: &[f64; 6], e: f64| tool_pose(&at(&robot, &plain, e), &[], q, &Moment::default());
    let real =
        |q: &[f64; 6], e: f64| tool_pose(&at(&robot, &bent, e), &faults, q, &Moment::default());
    // a straight line while the base goes a metre, and one that the base does not follow
    for by in [[0.6, 0.8, 0.05], [0.55, 0.85, -0.02]] {
        let from = nominal(&FIRST, ENDS[0]);
        let mut to = from;
        for (row, by) in to.iter_mut().zip(by) {
            row[3] += by;
        }
        let n = numbers_of(Said::Rapid, &to);
        let line = format!(
            "MoveL [[{}],[{}],[0,0,0,0],[{},9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n",
            list(&n[..3]),
            list(&n[3..]),
            1e3 * ENDS[1]
        );
        let (status, report) = check(
            folder.path(),
            &profile,
            &(joint_move(&FIRST, ENDS[0]) + &line),
            None,
        );
        assert!(status == Some(0) || status == Some(1), "{report:#}");
        let (mut most, mut q) = (0.0_f64, FIRST);
        for k in 0..=SAMPLES {
            let s = f64::from(k) / f64::from(SAMPLES);
            let e = ENDS[0] + s * (ENDS[1] - ENDS[0]);
            let mut wanted = from;
            for (row, by) in wanted.iter_mut().zip(by) {
                row[3] += s * by;
            }
            q = joints(&at(&robot, &plain, e), &wanted, &q);
            most = most.max(far(place(&real(&q, e)), place(&wanted)));
        }
        let found = report["moves"]
            .as_array()
            .expect("moves")
            .last()
            .expect("one")
            .clone();
        let bound = number(&found, "max_path_error_mm");
        assert_eq!(found["path_certified"], true, "{found:#}");
        assert!(1e3 * most > 0.5, "{most}");
        assert!(
            bound >= 1e3 * most - 1e-6 && bound <= 1.03e3 * most + 0.003,
            "{bound} of {} mm",
            1e3 * most
        );
    }
    // joints and rail at once
    let last = [0.1, 0.5, -0.1, 0.2, 0.8, 0.3];
    let body = joint_move(&FIRST, ENDS[0]) + &joint_move(&last, ENDS[1]);
    let (_, report) = check(folder.path(), &profile, &body, None);
    let mut most = 0.0_f64;
    for k in 0..=SAMPLES {
        let s = f64::from(k) / f64::from(SAMPLES);
        let q: [f64; 6] = std::array::from_fn(|i| FIRST[i] + s * (last[i] - FIRST[i]));
        let e = ENDS[0] + s * (ENDS[1] - ENDS[0]);
        most = most.max(far(place(&real(&q, e)), place(&nominal(&q, e))));
    }
    let found = report["moves"]
        .as_array()
        .expect("moves")
        .last()
        .expect("one")
        .clone();
    let bound = number(&found, "max_path_error_mm");
    assert_eq!(found["path_certified"], true, "{found:#}");
    assert!(
        bound >= 1e3 * most - 1e-6 && bound <= 1.03e3 * most + 0.003,
        "{bound} of {} mm",
        1e3 * most
    );
}

/// The arm across the rail.
const ACROSS: [f64; 6] = [-1.1, 0.3, -0.2, 0.5, 1.0, -0.4];
/// Where the ball on the flange is, in its frame, mm; and its radius.
const BALL: [f64; 3] = [0.0, 0.0, 160.0];
const RADIUS_MM: f64 = 12.0;
const POST_MM: f64 = 25.0;

/// A cell with a ball on the flange and a post that is one as well.
fn cell(post: V3) -> String {
    let [x, y, z] = post.map(|m| 1e3 * m);
    let [a, b, c] = BALL;
    format!(
        "poseshift: cell/1\nclearance_mm: 3\nbodies:\n  - {{name: post, sphere_mm: {{radius: {POST_MM}}}, at: {{x_mm: {x:.6}, y_mm: {y:.6}, z_mm: {z:.6}, rx_deg: 0, ry_deg: 0, rz_deg: 0}}}}\nattached:\n  - {{name: ball, to: flange, sphere_mm: {{radius: {RADIUS_MM}}}, at: {{x_mm: {a}, y_mm: {b}, z_mm: {c}, rx_deg: 0, ry_deg: 0, rz_deg: 0}}}}\n"
    )
}

#[test]
fn what_only_the_moving_base_touches_is_found() {
    let folder = scratch();
    let [_, bent] = rails();
    let [a, b, c] = BALL.map(|mm| 1e-3 * mm);
    let ball = Mounted {
        flange_from_tool: Pose::from_xyz_rxryrz([a, b, c, 0.0, 0.0, 0.0]),
        ..tool()
    };
    let (_, with_ball, _) = robot(&ball);
    let (profile, _, faults) = robot(&tool());
    // the arm bends by its real tool, and the ball is on its flange
    let loaded = Robot { ..with_ball };
    let real = |e: f64| {
        place(&tool_pose(
            &at(&loaded, &bent, e),
            &faults,
            &ACROSS,
            &Moment::default(),
        ))
    };
    let middle = f64::midpoint(ENDS[0], ENDS[1]);
    let body = joint_move(&ACROSS, ENDS[0]) + &joint_move(&ACROSS, ENDS[1]);
    let stays = joint_move(&ACROSS, ENDS[0]) + &joint_move(&ACROSS, ENDS[0]);
    for (out_mm, is_hit) in [(30.0, true), (44.0, false)] {
        let mut post = real(middle);
        // away from the arm, across the rail
        let out = sub(post, place(&at(&loaded, &bent, middle).base));
        let along = dot(out, [0.6, 0.8, 0.0]);
        let out = [out[0] - 0.6 * along, out[1] - 0.8 * along, 0.0];
        let length = dot(out, out).sqrt();
        for (x, o) in post.iter_mut().zip(out) {
            *x += 1e-3 * out_mm * o / length;
        }
        let cell = cell(post);
        let (status, report) = check(folder.path(), &profile, &body, Some(&cell));
        let found = report["moves"]
            .as_array()
            .expect("moves")
            .last()
            .expect("one")
            .clone();
        let least = (0..=SAMPLES)
            .map(|k| real(ENDS[0] + f64::from(k) / f64::from(SAMPLES) * (ENDS[1] - ENDS[0])))
            .map(|ball| 1e3 * far(ball, post) - RADIUS_MM - POST_MM)
            .fold(f64::INFINITY, f64::min);
        let ids: Vec<&str> = report["findings"]
            .as_array()
            .expect("a list")
            .iter()
            .filter_map(|f| f["id"].as_str())
            .collect();
        assert_eq!(ids.contains(&"collision"), is_hit, "{ids:?} {found:#}");
        assert_eq!(status == Some(0), !is_hit, "{report:#}");
        if !is_hit {
            let bound = number(&found, "clearance_mm");
            assert!(
                bound <= least + 1e-6 && bound >= least - 0.02,
                "{bound} of {least}"
            );
            let names = found["clearance"].to_string();
            assert!(names.contains("ball") && names.contains("post"), "{names}");
        }
        // the same joints where the base stays
        let (_, report) = check(folder.path(), &profile, &stays, Some(&cell));
        assert!(
            !report["findings"].to_string().contains("\"collision\""),
            "{report:#}"
        );
    }
}

#[test]
fn the_carriage_is_kept_from_what_stands_next_to_the_rail() {
    let folder = scratch();
    let [plain, _] = rails();
    let (profile, robot, _) = robot(&tool());
    let middle = at(&robot, &plain, f64::midpoint(ENDS[0], ENDS[1])).base;
    // 100 mm under the base, and a foot that the base stands on at home
    let below = |base: &M4, up: f64| -> V3 {
        std::array::from_fn(|i| base[i][3] - 0.1 * base[i][2] + if i == 2 { up } else { 0.0 })
    };
    let post = below(&middle, -0.05).map(|m| 1e3 * m);
    let foot = place(&robot.base).map(|m| 1e3 * m);
    let ball = |name: &str, [x, y, z]: V3, radius: f64| {
        format!(
            "  - {{name: {name}, sphere_mm: {{radius: {radius}}}, at: {{x_mm: {x:.6}, y_mm: {y:.6}, z_mm: {z:.6}, rx_deg: 0, ry_deg: 0, rz_deg: 0}}}}\n"
        )
    };
    let carriage =
        ball("carriage", [0.0, 0.0, -100.0], 40.0).replace("sphere_mm", "to: track, sphere_mm");
    let cell = format!(
        "poseshift: cell/1\nbodies:\n{}{}attached:\n{carriage}",
        ball("post", post, 20.0),
        ball("foot", foot, 25.0)
    );
    let goes = joint_move(&FIRST, ENDS[0]) + &joint_move(&FIRST, ENDS[1]);
    let stays = joint_move(&FIRST, ENDS[0]) + &joint_move(&FIRST, ENDS[0]);
    let (status, report) = check(folder.path(), &profile, &goes, Some(&cell));
    let reported = report["findings"].to_string();
    assert!(
        status != Some(0)
            && reported.contains("\"collision\"")
            && reported.contains("carriage")
            && reported.contains("post"),
        "{report:#}"
    );
    assert!(!reported.contains("foot"), "{reported}");
    let (_, report) = check(folder.path(), &profile, &stays, Some(&cell));
    assert!(
        !report["findings"].to_string().contains("\"collision\""),
        "{report:#}"
    );
}

#[test]
fn targets_are_inserted_where_the_rail_stands_and_refused_where_it_moves() {
    let folder = scratch();
    let [plain, _] = rails();
    let (profile, robot, _) = robot(&tool());
    let line = |e: f64, by: V3| {
        let mut to = tool_pose(
            &at(&robot, &plain, ENDS[0]),
            &[],
            &FIRST,
            &Moment::default(),
        );
        for (row, by) in to.iter_mut().zip(by) {
            row[3] += by;
        }
        let n = numbers_of(Said::Rapid, &to);
        format!(
            "MoveL [[{}],[{}],[0,0,0,0],[{},9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n",
            list(&n[..3]),
            list(&n[3..]),
            1e3 * e
        )
    };
    let to = |e: f64, by: V3| joint_move(&FIRST, ENDS[0]) + &line(ENDS[0], [0.0; 3]) + &line(e, by);
    let profile = put(folder.path(), "p.yaml", &profile);
    let run = |body: &str, out: &str| {
        let program = put(folder.path(), "t.mod", &rapid(&tooldata(), body));
        let done = poseshift()
            .args(["compensate", "--max-path-error", "0.002"])
            .arg(&program)
            .arg("--profile")
            .arg(&profile)
            .arg("-o")
            .arg(folder.path().join(out))
            .output()
            .expect("the program starts");
        let text = [done.stdout, done.stderr].concat();
        (
            done.status.code(),
            String::from_utf8_lossy(&text).into_owned(),
        )
    };
    let (status, reported) = run(&to(ENDS[0], [0.03, 0.12, -0.06]), "stands.mod");
    assert_eq!(status, Some(0), "{reported}");
    let text = std::fs::read_to_string(folder.path().join("stands.mod")).expect("written");
    assert!(text.matches("MoveL").count() > 2, "{text}");
    let place = format!("[{},9E9", 1e3 * ENDS[0]);
    assert_eq!(
        text.matches(&place).count(),
        1 + text.matches("MoveL").count()
    );
    let (status, reported) = run(&to(ENDS[1], [0.6, 0.8, 0.05]), "moves.mod");
    assert!(
        status != Some(0) && reported.contains("external axes move on it"),
        "{status:?} {reported}"
    );
    assert!(!folder.path().join("moves.mod").exists());
}

/// The original says where the tool is wanted with the axis where it has it.
#[test]
fn an_axis_that_stands_elsewhere_than_in_the_original_is_an_error() {
    let folder = scratch();
    for (case, file, line, from, to) in [
        ("rail", "Beam.mod", 16, "[700.00,", "[701.00,"),
        ("positioner", "Pipe.mod", 16, "", ""),
    ] {
        let at = |part: &str| format!("programs/rapid/{case}/{part}");
        let text = crate::support::text(&at(&format!("out/{file}")));
        let own = text.lines().nth(line - 1).expect("a move");
        let changed = if from.is_empty() {
            // the second axis, which stands behind the first
            let (head, tail) = own.rsplit_once(",9E9,9E9,9E9,9E9]").expect("external axes");
            let (head, value) = head.rsplit_once(',').expect("two axes");
            let value: f64 = value.parse().expect("a number");
            format!("{head},{},9E9,9E9,9E9,9E9]{tail}", value - 1.0)
        } else {
            assert!(own.contains(from), "{own}");
            own.replace(from, to)
        };
        let program = folder.path().join(file);
        let name = program.to_str().expect("UTF-8");
        let (nominal, profile) = (at(&format!("in/{file}")), at("profile.yaml"));
        let check = |text: &str| {
            std::fs::write(&program, text).expect("scratch");
            let (status, out, error) =
                crate::support::run(&["check", name, "--nominal", &nominal, "--profile", &profile]);
            (status, out + &error)
        };
        assert_eq!(check(&text).0, 0, "{case}");
        let (status, said) = check(&text.replace(own, &changed));
        assert_eq!(status, 1, "{case}: {said}");
        assert!(said.contains("external-not-original"), "{case}: {said}");
        assert!(said.contains(&format!("{file}:{line}:")), "{case}: {said}");
    }
}

/// What the base on a rail only comes near at home it may drive into: it is kept from all but what it
/// stands on, and from that, too, where the cell says so.
#[test]
fn the_base_on_a_rail_drives_into_what_stood_next_to_it() {
    let folder = scratch();
    let profile = "external_axes:\n  track:\n    - {axis: eax_a, direction: [1, 0, 0], up: [0, 0, 1], \
        zero_mm: 0, min_mm: 0, max_mm: 3000}\n";
    let text = super::profile_text(
        profile,
        &["{effect: link_geometry, link: 3, theta_deg: 0.1}"],
    );
    let base = "base: {x_mm: 250, y_mm: -100, z_mm: 400, rx_deg: 0.5, ry_deg: -0.3, rz_deg: 30}";
    let level = "base: {x_mm: 0, y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0}";
    std::fs::write(folder.path().join("p.yaml"), text.replace(base, level)).expect("scratch");
    let program = "MODULE A\n  PROC main()\n    MoveAbsJ [[0,0,0,0,30,0],[0,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n    \
        MoveAbsJ [[0,0,0,0,30,0],[500,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n  ENDPROC\nENDMODULE\n";
    std::fs::write(folder.path().join("a.mod"), program).expect("scratch");
    let place = "rx_deg: 0, ry_deg: 0, rz_deg: 0}}";
    let checked = |gap_mm: f64, more: &str| {
        let cell = format!(
            "poseshift: cell/1\nbodies:\n  - {{name: cabinet, box_mm: [100, 300, 300], at: {{x_mm: {}, y_mm: 0, \
             z_mm: 150, {place}\nattached:\n  - {{name: skirt, to: link0, box_mm: [400, 400, 200], at: {{x_mm: 0, \
             y_mm: 0, z_mm: 100, {place}\n{more}",
            250.0 + gap_mm
        );
        std::fs::write(folder.path().join("cell.yaml"), cell).expect("scratch");
        let run = poseshift()
            .current_dir(folder.path())
            .args([
                "check",
                "a.mod",
                "--profile",
                "p.yaml",
                "--cell",
                "cell.yaml",
            ])
            .output()
            .expect("the program starts");
        let said = String::from_utf8(run.stdout).expect("UTF-8");
        let error = String::from_utf8(run.stderr).expect("UTF-8");
        let all = format!("{said}{error}");
        let words: Vec<&str> = all.split_whitespace().collect();
        let touches = words.join(" ").contains("skirt touches cabinet");
        (run.status.code(), touches)
    };
    // the arm's own shape goes there, too
    let foot = "pairs: [{a: link0, b: cabinet, allow: true}, {a: link1, b: cabinet, allow: true}, \
        {a: link2, b: cabinet, allow: true}";
    let pair = ", {a: skirt, b: cabinet, clearance_mm: 20}";
    for (gap_mm, clearance, pair) in [
        (6.0, "", ""),
        (6.0, "clearance_mm: 5\n", ""),
        (6.0, "clearance_mm: 20\n", ""),
        (6.0, "", pair),
        (0.5, "", pair),
    ] {
        let more = format!("{clearance}{foot}{pair}]\n");
        assert_eq!(checked(gap_mm, &more), (Some(1), true), "{gap_mm} {more}");
    }
    // it stands on it, or the cell allows it
    let allowed = ", {a: skirt, b: cabinet, allow: true}";
    for (gap_mm, pair) in [(0.5, ""), (6.0, allowed)] {
        let more = format!("{foot}{pair}]\n");
        assert_eq!(checked(gap_mm, &more), (Some(0), false), "{gap_mm} {more}");
    }
}
