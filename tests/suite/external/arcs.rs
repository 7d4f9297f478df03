//! Arcs while the base moves: they go through their point in the work frame, whatever is written for
//! external axes there, and the point is corrected for where the robot passes it.

use super::checked::{
    FIRST, at, check, far, joint_move, list, number, place, rails, robot, tooldata,
};
use super::landing::{inverse, joints};
use super::measured::put;
use super::programs::{Said, numbers_of, pose_of};
use super::{rapid, run, tool, written};
use crate::physics::external::Rail;
use crate::physics::matrix::{M4, frame, times, turn_x, turn_z};
use crate::physics::{Moment, tool_pose};
use crate::support::{poseshift, scratch, text};
use crate::trial::truth::robot_of;
use poseshift::model::profile::Profile;

/// Where the rail stands at the ends, metres.
const ENDS: [f64; 2] = [0.4, 0.6];
/// Half of its way: the arc goes as far along the rail.
const RADIUS_M: f64 = 0.1;
/// Where the point of the arc stands, of half a circle.
const PART: f64 = 0.3;

/// The tool on half a circle in a plane that leans, beginning at `from`; its orientation stays.
fn on_circle(from: &M4, s: f64) -> M4 {
    let angle = std::f64::consts::PI * s;
    let (along, across) = (RADIUS_M * (1.0 - angle.cos()), RADIUS_M * angle.sin());
    let mut to = *from;
    for (row, by) in to.iter_mut().zip([
        0.6 * along - 0.64 * across,
        0.8 * along + 0.48 * across,
        0.6 * across,
    ]) {
        row[3] += by;
    }
    to
}

fn target(pose: &M4, e: f64) -> String {
    let n = numbers_of(Said::Rapid, pose);
    format!(
        "[[{}],[{}],[0,0,0,0],[{},9E9,9E9,9E9,9E9,9E9]]",
        list(&n[..3]),
        list(&n[3..]),
        1e3 * e
    )
}

/// A joint move, and half a circle behind it while the rail goes from end to end; the point is
/// written for the rail at `e`.
fn program(from: &M4, e: f64) -> String {
    let start = target(from, ENDS[0]);
    let [via, end] = [(PART, e), (1.0, ENDS[1])].map(|(s, e)| target(&on_circle(from, s), e));
    joint_move(&FIRST, ENDS[0])
        + &format!("MoveL {start},v100,fine,t;\nMoveC {via},{end},v100,fine,t;\n")
}

#[test]
fn an_arc_goes_through_its_point_while_the_rail_moves() {
    let folder = scratch();
    let [plain, bent] = rails();
    let (profile, robot, faults) = robot(&tool());
    let real =
        |q: &[f64; 6], e: f64| tool_pose(&at(&robot, &bent, e), &faults, q, &Moment::default());
    let first = at(&robot, &plain, ENDS[0]);
    let from = tool_pose(&first, &[], &FIRST, &Moment::default());
    let passed = ENDS[0] + PART * (ENDS[1] - ENDS[0]);
    let (mut most, mut q) = (0.0_f64, FIRST);
    for k in 0..=400 {
        let s = f64::from(k) / 400.0;
        let (e, wanted) = (ENDS[0] + s * (ENDS[1] - ENDS[0]), on_circle(&from, s));
        q = joints(&at(&robot, &plain, e), &wanted, &q);
        most = most.max(far(place(&real(&q, e)), place(&wanted)));
    }
    assert!(1e3 * most > 0.5, "{most}");
    for e in [passed, ENDS[0], ENDS[1]] {
        let (_, report) = check(folder.path(), &profile, &program(&from, e), None);
        let moves = report["moves"].as_array().expect("moves");
        let arc = moves.last().expect("one");
        assert_eq!(arc["path_certified"], true, "{arc:#}");
        let bound = number(arc, "max_path_error_mm");
        assert!(
            bound >= 1e3 * most - 1e-6 && bound <= 1.03e3 * most + 0.003,
            "{bound} of {} mm, written for {e}",
            1e3 * most
        );
    }
}

#[test]
fn the_point_of_an_arc_is_corrected_for_where_the_rail_is_then() {
    let folder = scratch();
    let (profile, robot, _) = robot(&tool());
    let [plain, _] = rails();
    let first = at(&robot, &plain, ENDS[0]);
    let from = tool_pose(&first, &[], &FIRST, &Moment::default());
    let profile = put(folder.path(), "p.yaml", &profile);
    let passed = ENDS[0] + PART * (ENDS[1] - ENDS[0]);
    let compensated = |e: f64| {
        let text = rapid(&tooldata(), &program(&from, e));
        let (given, out) = (
            put(folder.path(), "t.mod", &text),
            folder.path().join("out.mod"),
        );
        let mut command = poseshift();
        command
            .arg("compensate")
            .arg(&given)
            .arg("--profile")
            .arg(&profile);
        let done = command
            .arg("-o")
            .arg(&out)
            .arg("--force")
            .output()
            .expect("it starts");
        let reported = String::from_utf8_lossy(&done.stdout).into_owned();
        assert_eq!(done.status.code(), Some(0), "{reported}");
        let text = std::fs::read_to_string(&out).expect("written");
        let arc = text
            .lines()
            .find(|line| line.contains("MoveC"))
            .expect("an arc")
            .to_owned();
        // the point's own axis stays as it is written
        let written = format!("[{},9E9", 1e3 * e);
        assert!(arc.contains(&written), "{arc}");
        (
            arc.replacen(&written, "[", 1),
            reported.contains("arc-external"),
        )
    };
    let (right, is_reported) = compensated(passed);
    assert!(!is_reported);
    for e in [ENDS[0], ENDS[1]] {
        assert_eq!(compensated(e), (right.clone(), true));
    }
}

/// The fake target of the point of an arc that begins with the rail at a metre and goes on to there,
/// with a base that turns back on it.
fn point_with_backlash(goes_to_mm: f64) -> [f64; 3] {
    let nominal = text("robots/abb_irb2600_12_165.yaml");
    let effects = "effects: [{effect: backlash, joint: 1, width_deg: 0.05}]";
    let track = "external_axes: {track: [{axis: eax_a, direction: [0, 1, 0], up: [0, 0, 1], \
                 zero_mm: 0, min_mm: 0, max_mm: 3000}]}\n";
    let profile = nominal.replace("effects: []", effects) + track;
    let profile = Profile::from_yaml(&profile).expect("a profile");
    let target = |x: f64, y: f64, e: f64| {
        format!("[[{x},{y},571.458],[0,0,-1,0],[0,0,0,0],[{e},9E9,9E9,9E9,9E9,9E9]]")
    };
    let tool = "PERS tooldata t:=[TRUE,[[0,0,180],[1,0,0,0]],[4.5,[0,0,90],[1,0,0,0],0,0,0]];";
    let body = format!(
        "MoveAbsJ [[-20,10,20,0,60,0],[1000,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\n\
         MoveJ {},v100,fine,t;\nMoveC {},{},v100,fine,t;\n",
        target(1017.544, 1000.0, 1000.0),
        target(1177.544, 1098.0, goes_to_mm),
        target(1217.544, 1000.0, goes_to_mm)
    );
    let done = run(&profile, &[("t.mod", &rapid(tool, &body))]).expect("compensated");
    let point = done.targets.get(2).expect("the point");
    point.fake.expect("a fake target").translation
}

#[test]
fn joints_come_to_the_point_of_an_arc_as_they_go_on_it_while_the_rail_moves() {
    let stands = point_with_backlash(1000.0);
    for goes_to_mm in [1000.01, 1000.1] {
        let moves = point_with_backlash(goes_to_mm);
        let off_mm: f64 = (0..3).map(|k| 1e3 * (moves[k] - stands[k]).abs()).sum();
        assert!(off_mm < 0.01, "{goes_to_mm}: {off_mm}");
    }
}

/// The tool, another one, and a work frame.
const TOOL: [f64; 6] = [0.03, -0.02, 0.11, 0.1, 0.2, -0.3];
const OTHER: [f64; 6] = [-0.02, 0.015, 0.07, 0.3, -0.2, 0.4];
const WORK: [f64; 6] = [0.2, -0.1, 0.05, 0.02, 0.1, 0.5];

/// As [`on_circle`], and the tool turns on the way.
fn turning(from: &M4, s: f64) -> M4 {
    turned_at(&on_circle(from, s), &turn_x(0.3 * s))
}

/// The tool rotated where it is.
fn turned_at(pose: &M4, by: &M4) -> M4 {
    let mut to = times(by, pose);
    for (row, at) in to.iter_mut().zip(place(pose)) {
        row[3] = at;
    }
    to
}

fn written_as(pose: &M4) -> String {
    let n = numbers_of(Said::Rapid, pose);
    format!("[{}],[{}]", list(&n[..3]), list(&n[3..]))
}

/// The arc that turns, its point written at a pose with the rail at `e`, behind a move; what else
/// the program says is given with it.
fn arc_behind(before: &str, via: &M4, e: f64, from: &M4) -> String {
    let data = format!(
        "{}\nPERS tooldata u:=[TRUE,[{}],[2,[10,0,60],[1,0,0,0],0,0,0]];\n\
         PERS wobjdata w:=[FALSE,TRUE,\"\",[{}],[[0,0,0],[1,0,0,0]]];\nVAR robtarget p9;",
        tooldata(),
        written_as(&frame(&OTHER)),
        written_as(&frame(&WORK))
    );
    let [via, end] = [(*via, e), (turning(from, 1.0), ENDS[1])].map(|(at, e)| target(&at, e));
    let first = joint_move(&FIRST, ENDS[0]);
    rapid(
        &data,
        &format!("{first}{before}MoveC {via},{end},v100,fine,t;\n"),
    )
}

#[test]
fn the_point_lands_in_the_rotation_of_the_path_behind_another_tool_and_work_frame() {
    let (text, robot, faults) = robot(&tool());
    let profile = Profile::from_yaml(&text).expect("a profile");
    let [plain, bent] = rails();
    let first = at(&robot, &plain, ENDS[0]);
    let from = tool_pose(&first, &[], &FIRST, &Moment::default());
    let with_other = times(&times(&from, &inverse(&frame(&TOOL))), &frame(&OTHER));
    let in_work = |pose: &M4| times(&inverse(&frame(&WORK)), pose);
    let line = |pose: &M4, with: &str| {
        let start = target(pose, ENDS[0]);
        format!("MoveL {start},v100,fine,{with};\n")
    };
    let befores = [
        line(&from, "t"),
        line(&with_other, "u"),
        line(&in_work(&from), "t\\WObj:=w"),
        line(&in_work(&with_other), "u\\WObj:=w"),
        // joints alone
        String::new(),
        // back from elsewhere to a position that was read
        line(&from, "t")
            + "p9:=CRobT(\\Tool:=t\\WObj:=wobj0);\n"
            + &joint_move(&FIRST, ENDS[1])
            + "MoveL p9,v100,fine,t;\n",
    ];
    let passed = ENDS[0] + PART * (ENDS[1] - ENDS[0]);
    let wanted = turning(&from, PART);
    for before in befores {
        for (e, by) in [(passed, 0.0), (passed, 0.4), (ENDS[1], 0.0), (0.9, 0.4)] {
            let via = turned_at(&wanted, &turn_z(by));
            let program = arc_behind(&before, &via, e, &from);
            let files = [("t.mod", program.as_str())];
            let done = run(&profile, &files).expect("read");
            let is_said = done.findings.iter().any(|f| f.id == "arc-external");
            assert_eq!(is_said, e != passed, "{before} {e}: {:?}", done.findings);
            let text = written(&profile, &files);
            let arc = text.split("MoveC ").nth(1).expect("an arc");
            let numbers = arc.split(['[', ']', ',']).filter_map(|n| n.parse().ok());
            let numbers: Vec<f64> = numbers.take(7).collect();
            // the controller has the tool there in the rotation of its path
            let fake = pose_of(Said::Rapid, &numbers);
            let mut there = times(&times(&fake, &inverse(&via)), &wanted);
            for (row, at) in there.iter_mut().zip(place(&fake)) {
                row[3] = at;
            }
            let q = joints(&at(&robot, &plain, passed), &there, &FIRST);
            let robot = at(&robot, &bent, passed);
            let real = tool_pose(&robot, &faults, &q, &Moment::default());
            let off_mm = 1e3 * far(place(&real), place(&wanted));
            assert!(off_mm < 0.002, "{before} {e} {by}: {off_mm}");
        }
    }
}

#[test]
fn an_arc_that_begins_where_nobody_knows_says_so_of_its_axes() {
    let (text, robot, _) = robot(&tool());
    let profile = Profile::from_yaml(&text).expect("a profile");
    let first = at(&robot, &rails()[0], ENDS[0]);
    let from = tool_pose(&first, &[], &FIRST, &Moment::default());
    let said = |before: &str| {
        let program = arc_behind(before, &turning(&from, PART), 0.46, &from);
        let done = run(&profile, &[("t.mod", program.as_str())]).expect("read");
        let found = done.findings.iter();
        let found = found.filter(|f| f.message.contains("nobody knows where this arc begins"));
        found.map(|f| f.id).collect::<Vec<_>>()
    };
    let read = "p9:=CRobT(\\Tool:=t\\WObj:=wobj0);\n";
    let go = "MoveL p9,v100,fine,t;\n";
    assert_eq!(said(&format!("{read}{go}")), [""; 0]);
    let sensed = format!("{read}p9.trans.z:=AInput(ai1);\n{go}");
    assert_eq!(said(&sensed), ["arc-external", "arc-rotation"]);
}

#[test]
fn an_arc_that_begins_here_and_there_says_with_which_value_its_point_is_passed() {
    let (text, robot, _) = robot(&tool());
    let profile = Profile::from_yaml(&text).expect("a profile");
    let first = at(&robot, &rails()[0], ENDS[0]);
    let from = tool_pose(&first, &[], &FIRST, &Moment::default());
    let passed = ENDS[0] + PART * (ENDS[1] - ENDS[0]);
    let program = |second: f64| {
        let via = target(&on_circle(&from, PART), passed);
        let end = target(&on_circle(&from, 1.0), ENDS[1]);
        let to = |e: f64| format!("MoveL {},v100,fine,t;\narc;\n", target(&from, e));
        let body = joint_move(&FIRST, ENDS[0]) + &to(ENDS[0]) + &to(second);
        let arc = format!("ENDPROC\nPROC arc()\nMoveC {via},{end},v100,fine,t;\n");
        rapid(&tooldata(), &(body + &arc))
    };
    for (second, is_other) in [(ENDS[0], false), (0.45, true)] {
        let done = run(&profile, &[("t.mod", &program(second))]).expect("read");
        let mut said = done.findings.iter().filter(|f| f.id == "arc-external");
        let message = said.next().map(|f| f.message.as_str()).unwrap_or_default();
        assert_eq!(
            message.contains("passes it at 495 mm"),
            is_other,
            "{message}"
        );
        assert_eq!(said.count(), 0);
        // its numbers have to serve both calls
        let mut ids = done.findings.iter().map(|f| f.id);
        let is_shared = ids.any(|id| matches!(id, "arc-shared" | "target-shared"));
        assert_eq!(is_shared, is_other, "{:?}", done.findings);
    }
}

#[test]
fn an_arc_that_begins_in_either_branch_says_both_values() {
    let (text, robot, _) = robot(&tool());
    let profile = Profile::from_yaml(&text).expect("a profile");
    let first = at(&robot, &rails()[0], ENDS[0]);
    let from = tool_pose(&first, &[], &FIRST, &Moment::default());
    let passed = ENDS[0] + PART * (ENDS[1] - ENDS[0]);
    let via = target(&on_circle(&from, PART), passed);
    let end = target(&on_circle(&from, 1.0), ENDS[1]);
    let to = |e: f64| format!("MoveL {},v100,fine,t;\n", target(&from, e));
    let branch = format!(
        "IF DInput(di1)=1 THEN\n{}ELSE\n{}ENDIF\n",
        to(ENDS[0]),
        to(0.45)
    );
    let body = joint_move(&FIRST, ENDS[0]) + &branch + &format!("MoveC {via},{end},v100,fine,t;\n");
    let done = run(&profile, &[("t.mod", &rapid(&tooldata(), &body))]).expect("read");
    let said = done.findings.iter().filter(|f| f.id == "arc-external");
    let said: Vec<&str> = said.map(|f| f.message.as_str()).collect();
    assert!(
        matches!(said[..], [one] if one.contains("at 460 mm or at 495 mm")),
        "{said:?} {:?}",
        done.findings
    );
}

#[test]
fn a_rail_with_backlash_comes_to_the_point_as_it_goes_on_the_arc() {
    let (text, robot, _) = robot(&tool());
    let backlash = "{effect: track_backlash, axis: 1, width_mm: 0.2}";
    let text = text.replacen("effects: [", &format!("effects: [{backlash}, "), 1);
    let profile = Profile::from_yaml(&text).expect("a profile");
    let first = at(&robot, &rails()[0], ENDS[0]);
    let from = tool_pose(&first, &[], &FIRST, &Moment::default());
    let point = |e: f64| {
        let before = joint_move(&FIRST, 0.2);
        let text = rapid(&tooldata(), &(before + &program(&from, e)));
        let done = run(&profile, &[("t.mod", &text)]).expect("read");
        let unsure = done
            .findings
            .iter()
            .filter(|f| f.id == "direction-uncertain" && f.message.contains("external axis"));
        // where the program begins
        assert!(unsure.count() <= 1, "{:?}", done.findings);
        let found = done.targets.iter().filter_map(|of| of.fake).nth(1);
        found.expect("the point").translation
    };
    let passed = ENDS[0] + PART * (ENDS[1] - ENDS[0]);
    // written behind the beginning, as if the rail went back
    assert_eq!(point(0.3), point(passed));
}

#[test]
fn the_point_is_corrected_for_where_the_arc_through_the_written_points_passes_it() {
    let external = "external_axes:\n  track: [{axis: E1, direction: [1, 0, 0], min_mm: 0, max_mm: \
        3000}]\n";
    let ripple = "{effect: track_ripple, axis: 1, along: x, period_mm: 25, cos_mm: 0, sin_mm: 0.2}";
    let profile = super::profile(external, &[ripple]);
    let rail = Rail {
        direction: [1.0, 0.0, 0.0],
        up: [0.0, 0.0, 1.0],
        zero: 0.0,
        low: 0.0,
        high: 3.0,
        faults: Vec::new(),
    };
    let plain = robot_of(&profile, &tool());
    let start = at(&plain, &rail, 1.525);
    let q_deg = [0.0, 20.0, -10.0, 0.0, 60.0, 0.0];
    let pose = tool_pose(&start, &[], &q_deg.map(f64::to_radians), &Moment::default());
    let numbers = numbers_of(Said::Krl, &pose);
    let point = |by: [f64; 2], e: f64| {
        let n = &numbers;
        format!(
            "{{X {:.4},Y {:.4},Z {:.4},A {:.5},B {:.5},C {:.5},E1 {e:.3}}}",
            n[0] + by[0],
            n[1] + by[1],
            n[2],
            n[3],
            n[4],
            n[5]
        )
    };
    let ends = [1525.0, 1625.0];
    let text = format!(
        "DEF t()\n$TOOL=TOOL_DATA[1]\n$BASE=$WORLD\nPTP {{A1 0,A2 20,A3 -10,A4 0,A5 60,A6 0,E1 1525}}\nLIN \
         {}\nCIRC {},{}\nEND\n",
        point([0.0, 0.0], ends[0]),
        point([15.0, 8.660_254], ends[0] + 200.0 / 3.0),
        point([20.0, 0.0], ends[1])
    );
    let done = written(&profile, &[("t.src", &text)]);
    let found: Vec<[f64; 3]> = done
        .split("{X ")
        .skip(1)
        .map(|rest| {
            let all = rest.split([',', ' ']);
            [0, 2, 4].map(|at: usize| {
                let mut own = all.clone();
                own.nth(at).expect("a number").parse().expect("a number")
            })
        })
        .collect();
    let [from, via, end] = found[..] else {
        panic!("{done}")
    };
    // the angles at the centre of the circle through the three, in its plane
    let sub = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i: usize| a[i] - b[i]);
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
    let (a, b) = (sub(via, from), sub(end, from));
    let (aa, bb, ab) = (dot(a, a), dot(b, b), dot(a, b));
    let area = 2.0 * (aa * bb - ab * ab);
    let (s, t) = (bb * (aa - ab) / area, aa * (bb - ab) / area);
    let centre = [0, 1, 2].map(|i: usize| from[i] + s * a[i] + t * b[i]);
    let turned = |to: [f64; 3]| {
        let (one, two) = (sub(from, centre), sub(to, centre));
        (dot(one, two) / (dot(one, one) * dot(two, two)).sqrt()).acos()
    };
    // the end lies about half a circle from the beginning, on either side
    let whole = turned(via) + {
        let (one, two) = (sub(via, centre), sub(end, centre));
        (dot(one, two) / (dot(one, one) * dot(two, two)).sqrt()).acos()
    };
    let e = ends[0] + turned(via) / whole * (ends[1] - ends[0]);
    let off = 0.2 * (std::f64::consts::TAU * (e - 1500.0) / 25.0).sin();
    let wanted = [numbers[0] + 15.0, numbers[1] + 8.660_254];
    let miss = (via[0] + off - wanted[0]).hypot(via[1] - wanted[1]);
    assert!(miss < 0.003, "{miss}: {done}");
}
