//! What jobs mean.

use super::*;
use crate::program::{Before, Motion, Program};

mod posts;
mod robust;

fn read_files(texts: &[&str], settings: &Settings) -> Result<Program, ReadError> {
    let sources: Vec<_> = texts
        .iter()
        .enumerate()
        .map(|(i, text)| Source::new(format!("{i}.JBI"), text.as_bytes().to_vec()))
        .collect();
    crate::motion::read(&Inform, &sources, settings)
}

fn read(text: &str) -> Program {
    read_files(&[text], &Settings::default()).expect("a job")
}

/// A job of these positions and instructions.
fn job(positions: &str, instructions: &str) -> String {
    format!(
        "/JOB\n//NAME A\n//POS\n{positions}\n//INST\n///DATE 2024/01/01 10:00\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\n{instructions}\nEND\n"
    )
}

const USER: &str = "///USER 12\n///TOOL 3\n///POSTYPE USER\n///RECTAN\n///RCONF 1,0,0,0,0,0,0,0\n";
const P6: &str = "1.000,2.000,3.000,10.0000,20.0000,30.0000";

fn points(count: usize) -> String {
    (0..count).map(|i| format!("C{i:05}={P6}\n")).collect()
}

/// The ids of all findings but the one that most jobs here have: they start with a rectangular position.
fn ids(program: &Program) -> Vec<&str> {
    let all = program.findings.iter().map(|f| f.id);
    all.filter(|id| *id != "wrist-not-told").collect()
}

#[test]
fn header_lines_hold_until_they_are_set_anew() {
    let positions = format!(
        "///NPOS 4,0,0,1,0,0\n///TOOL 0\n///POSTYPE PULSE\n///PULSE\nC00000=0,10,-20,30,-40,50\n{USER}C00001={P6}\n\
         ///USER 4\nC00002= 1, -2.5 ,3,.5,+20.,-30,7.5\n///TOOL 5\n///POSTYPE BASE\nC00003={P6}\nP00018={P6}"
    );
    let moves = "MOVJ C00000 VJ=0.78\n'MOVL C00009\n  MOVL C00001 V=100.0\n//MOVL C00007 V=1\nMOVJ C00002 VJ=5\nMOVL C00003\nMOVL P018 V=5";
    let settings = Settings {
        pulses_per_deg: Some([1000.0; 6]),
        ..Settings::default()
    };
    let program = read_files(&[&job(&positions, moves)], &settings).expect("a job");
    assert_eq!(ids(&program), ["position-variable"]);
    let placed: Vec<_> = program
        .moves
        .iter()
        .map(|m| {
            let frame = &program.frames[m.frame];
            (
                program.targets[m.target.unwrap()]
                    .name
                    .as_deref()
                    .expect("a name"),
                program.tools[m.tool].name.as_str(),
                frame.name.as_str(),
                frame.world_from_frame.is_some(),
            )
        })
        .collect();
    assert_eq!(
        placed,
        [
            ("C00000", "0", "BASE", true),
            ("C00001", "3", "12", false),
            ("C00002", "3", "4", false),
            ("C00003", "5", "BASE", true),
            ("P018", "5", "BASE", true)
        ]
    );
    let configured: Vec<_> = program.moves.iter().map(|m| m.configured).collect();
    assert_eq!(configured, [true, false, true, false, false]);
    let numbers: Vec<_> = program
        .numbers_of(&program.targets[2])
        .iter()
        .map(|n| n.value)
        .collect();
    assert_eq!(numbers, [1.0, -2.5, 3.0, 0.5, 20.0, -30.0]);
}

#[test]
fn postype_of_rectangular_positions_does_not_matter_to_pulses() {
    // some posts write POSTYPE BASE behind pulses, and PULSE without POSTYPE
    let positions =
        format!("///TOOL 1\n///POSTYPE BASE\n///PULSE\nC00000=1,2,3,4,5,6\n///RECTAN\nC00001={P6}");
    let program = read(&job(&positions, "MOVJ C00000 VJ=1\nMOVL C00001 V=5"));
    assert_eq!(ids(&program), ["pulses-per-degree-unknown"]);
    assert!(program.targets[0].blocked && program.targets[0].numbers.is_empty());
    assert_eq!(program.targets[0].layout.shape, Shape::Joints);
    assert!(!program.targets[1].blocked);
    assert_eq!(program.targets[1].layout.shape, Shape::Pose);
}

#[test]
fn pulses_and_angles_are_joints() {
    let settings = Settings {
        pulses_per_deg: Some([1000.0, -2000.0, 500.0, 100.0, 200.0, 400.0]),
        ..Settings::default()
    };
    let decoded = |variant, numbers: &[f64]| {
        let shape = Shape::Joints;
        let decoded = Inform.decode(Layout { shape, variant }, numbers, &settings);
        match decoded.value {
            Value::Joints(joints) => joints.map(|angle| (angle / DEG * 1e6).round() / 1e6),
            Value::Pose(_) => panic!("joints"),
        }
    };
    let pulses = [90_000.0, 20_000.0, -5000.0, 0.0, 200.0, 400.0];
    assert_eq!(
        decoded(PULSES, &pulses),
        [90.0, -10.0, -10.0, 0.0, 1.0, 1.0]
    );
    let angles = [90.0, -10.0, -10.0, 0.0, 1.0, 1.0];
    assert_eq!(decoded(DEGREES, &angles), angles);
    let posture = Posture {
        joints_rad: [0.0; 6],
        behind_axis_1: false,
        behind_lower_arm: false,
    };
    let layout = Layout {
        shape: Shape::Joints,
        variant: PULSES,
    };
    let value = Value::Joints(angles.map(|angle| angle * DEG));
    let mut numbers = [0.0; 6];
    Inform.encode(layout, &value, &posture, &posture, &settings, &mut numbers);
    assert!(
        numbers
            .iter()
            .zip(pulses)
            .all(|(a, b)| (a - b).abs() < 1e-6)
    );
    let text = job(
        "///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\nC00000=1.0000,2.0,3.0,4.0,5.0,6.0",
        "MOVJ C00000",
    );
    assert_eq!(read(&text).targets[0].layout.variant, DEGREES);
}

#[test]
fn angles_stay_near_the_present_ones() {
    for (present, turned) in [
        (
            [179.9999, -40.0, -179.9995],
            [-179.9998, -40.0001, 179.9997],
        ),
        ([10.0, 89.0, 20.0], [10.001, 89.001, 20.001]),
        ([190.0, 20.0, -270.0], [190.001, 20.001, -270.001]),
        ([10.0, 100.0, -20.0], [10.001, 100.001, -20.001]),
    ] {
        let [rx, ry, rz] = turned.map(|a: f64| a * DEG);
        let found = angles_near(&Rotation::from_rzryrx([rz, ry, rx]), present);
        let gap = (0..3).map(|i| (found[i] - turned[i]).abs());
        assert!(gap.fold(0.0, f64::max) < 1e-9, "{present:?}: {found:?}");
    }
    // where Ry is 90 degrees Rx stays
    let straight = Rotation::from_rzryrx([30.0 * DEG, 90.0 * DEG, 10.0 * DEG]);
    let found = angles_near(&straight, [10.0, 90.0, 30.0]);
    assert!(
        (found[0] - 10.0).abs() < 1e-6 && (found[2] - 30.0).abs() < 1e-6,
        "{found:?}"
    );
}

#[test]
fn arcs_go_through_each_two_points_behind_the_first() {
    use Motion::{ArcEnd, ArcVia, Linear};
    let moves = "MOVL C00000\nMOVC C00001\nMOVC C00002\nTIMER T=1.00\nMOVC C00003\nMOVL C00004\nMOVC C00005\nMOVC C00006";
    let program = read(&job(&format!("{USER}{}", points(7)), moves));
    let motions: Vec<_> = program.moves.iter().map(|m| m.motion).collect();
    assert_eq!(
        motions,
        [Linear, Linear, ArcVia, ArcEnd, Linear, Linear, ArcEnd]
    );
}

#[test]
fn positions_that_no_move_goes_to_stay() {
    let positions = format!(
        "{USER}{}///POSTYPE ROBOT\nP00001=0,0,100.000,0,0,0\nBC00000=0\n///PULSE\nEC00000=1,2\nBP00000=1\nEX00001=3,4",
        points(2)
    );
    let program = read(&job(&positions, "MOVL C00001\nREFP 1 C00000\nSET D000 5"));
    let blocked: Vec<_> = program.targets.iter().map(|t| t.blocked).collect();
    assert_eq!(blocked, [true, false, true]);
    assert_eq!(ids(&program), ["target-unused-here"]);
}

/// The ids of errors.
fn errors(program: &Program) -> Vec<&str> {
    let errors = program
        .findings
        .iter()
        .filter(|f| f.severity == crate::finding::Severity::Error);
    errors.map(|f| f.id).collect()
}

/// A job in a user frame, with base, station and variables.
fn cell(instructions: &str) -> Program {
    let positions = format!(
        "{USER}{}P00001={P6}\n///PULSE\nBC00000=0\nBC00001=0,500\nEC00000=0.0\nEC00001=-45.0,0",
        points(3)
    );
    read(&job(&positions, instructions))
}

#[test]
fn moves_that_cannot_be_compensated_are_errors() {
    for (instructions, id) in [
        (
            "SMOVL C00000 BC00000 V=1000.0 +MOVJ EC00000",
            "coordinated-move",
        ),
        ("MOVL C00000 V=5 SRCH RIN#(1)=ON", "search-move"),
        ("IMOV P001 V=5.0 RF", "incremental-move"),
        ("MOVJ C00000 +MOVJ C00001", "second-robot"),
        ("SYMOVL C00000 V=5 CV#(1)", "move-not-supported"),
        ("MOVL V=5", "move-not-supported"),
        ("MOVL C00009 V=5", "target-not-in-files"),
        ("MOVL P077 V=5", "target-not-in-files"),
        ("MOVL C00000 BC00001 V=5", "external-axis"),
        ("MOVL C00000 BC00007 V=5", "external-axis"),
        ("MOVL C00000 LBP001 V=5", "external-axis"),
        ("MOVJ C00000 VJ=5.0  +MOVJ EC00001", "external-axis"),
        (
            "SFTON P001 UF#(1)\nMOVL C00000 V=5\nSFTOF",
            "displacement-active",
        ),
        (
            "MFRAME UF#(12) P001 P002 P003\nMOVL C00000",
            "frame-assigned-at-run-time",
        ),
        (
            "MFRAME UF#(I000) P001\nMOVL C00000",
            "frame-assigned-at-run-time",
        ),
        (
            "SETTOOL TL#(3) PX000\nMOVL C00000",
            "frame-assigned-at-run-time",
        ),
        (
            "MOVL P001 V=5\nSETE P001 (3) 100",
            "target-assigned-at-run-time",
        ),
        (
            "MOVL P001 V=5\nSUB P[B000] P002",
            "target-assigned-at-run-time",
        ),
        (
            "ADD P001 P002\nMOVL P001 V=5",
            "target-assigned-at-run-time",
        ),
    ] {
        let program = cell(instructions);
        assert_eq!(
            errors(&program),
            [id],
            "{instructions}: {:?}",
            program.findings
        );
        let line = program.findings.iter().find(|f| f.id == id).map(|f| f.line);
        assert!(line.is_some_and(|line| line > 3));
    }
}

#[test]
fn a_moved_axis_is_told_with_its_value() {
    let program = cell("MOVL C00000 BC00001 V=5");
    let found = program.findings.iter().find(|f| f.id == "external-axis");
    let message = &found.expect("an error").message;
    assert!(
        message.contains("axis 2 of the base stands at 500 (BC00001)"),
        "{message}"
    );
    for still in [
        "MOVL C00000 BC00000 V=5",
        "MOVJ C00000 EC00000 VJ=5",
        "MOVL C00000 V=5  +MOVJ EC00000 VJ=5",
    ] {
        assert_eq!(errors(&cell(still)), [""; 0], "{still}");
    }
}

#[test]
fn what_the_running_program_computes_stays_and_is_told_once_a_place() {
    for (instructions, ids_of) in [
        ("MOVL LP000 V=5", &["computed-target"][..]),
        ("MOVL P[I000] V=5", &["computed-target"]),
        ("MOVL LP[I000] V=5", &["computed-target"]),
        ("GETS PX077 $PX002\nMOVL P077 V=5", &["computed-target"]),
        (
            "MULMAT PX077 PX078 PX079\nMOVL P077 V=5",
            &["computed-target"],
        ),
        (
            "GETS LPX001 $PX000\nCNVRT LPX001 LPX001 BF\nMOVL LP001 V=5",
            &["run-time-position"],
        ),
        ("GETS PX077 $PX001\nMOVL P077 V=5", &["run-time-position"]),
        // the position of the files holds in the first run
        (
            "MOVL P001 V=5\nGETS PX001 $PX000",
            &["position-variable", "run-time-position"],
        ),
        (
            "GETS LPX001 $PX000\nADD LP001 P001\nMOVL LP001 V=5",
            &["computed-target"],
        ),
    ] {
        let program = cell(&format!("MOVL C00000\n{instructions}\nMOVL C00001"));
        assert_eq!(errors(&program), [""; 0], "{instructions}");
        let mut found = ids(&program);
        found.retain(|id| *id != "target-unused-here");
        found.sort_unstable();
        assert_eq!(found, ids_of, "{instructions}");
        // the move is there, and the next one comes from it
        let at = |name: &str| {
            let target = program
                .targets
                .iter()
                .position(|t| t.name.as_deref() == Some(name));
            program.moves.iter().position(|m| m.target == target)
        };
        let (first, last) = (at("C00000").expect("a move"), at("C00001").expect("a move"));
        assert!(last > first + 1, "{instructions}");
        assert_ne!(
            program.moves[last].before,
            Before::One(u32::try_from(first).expect("few moves")),
            "{instructions}"
        );
    }
}

#[test]
fn the_next_move_knows_that_an_incremental_one_moved_the_robot() {
    let program = cell("MOVL C00000\nIMOV P001 V=5.0 RF\nMOVL C00001");
    assert_eq!(errors(&program), ["incremental-move"]);
    assert_eq!(program.moves[1].target, None);
    assert_eq!(program.moves[2].before, Before::One(1));
}

#[test]
fn copies_of_positions_are_those_positions() {
    let program = cell("SET LP001 P001\nSET LP002 LP001\nMOVL LP002 V=5\nMOVL C00000");
    assert_eq!(errors(&program), [""; 0]);
    let motion = &program.moves[0];
    assert_eq!(
        program.target_of(motion).and_then(|t| t.name.as_deref()),
        Some("P001")
    );
    assert_eq!(program.tools[motion.tool].name, "3");
    assert_eq!(program.frames[motion.frame].name, "12");
    // one variable, two tools: whose tool the move has nobody knows
    let positions = format!("{USER}P00001={P6}\n///TOOL 4\nP00002={P6}");
    let moves = "IFTHEN IN#(1)=ON\nSET LP001 P001\nELSE\nSET LP001 P002\nENDIF\nMOVL LP001 V=5";
    let program = read(&job(&positions, moves));
    assert_eq!(errors(&program), ["frame-chosen-at-run-time"; 2]);
}

#[test]
fn frames_are_unknown_only_where_the_write_reaches() {
    // kept from run to run: the second run begins with what the first one left
    let after = "MOVL C00000\nMFRAME UF#(12) P001 P002 P003";
    assert_eq!(errors(&cell(after)), ["frame-assigned-at-run-time"]);
    let other = "MFRAME UF#(15) P001 P002 P003\nMOVL C00000";
    assert_eq!(errors(&cell(other)), [""; 0]);
}

#[test]
fn jobs_take_positions_as_arguments() {
    let positions = format!("{USER}P00001={P6}\nP00002={P6}\nC00000={P6}");
    let main = job(
        &positions,
        "CALL JOB:GO ARGFI001 ARGFP001\nCALL JOB:GO ARGF5 ARGF P002",
    );
    let go = job("", "GETARG LP003 IARG#(2)\nMOVL LP003 V=5").replace("//NAME A", "//NAME GO");
    let program = read_files(&[&main, &go], &Settings::default()).expect("jobs");
    assert_eq!(errors(&program), [""; 0]);
    let mut names: Vec<_> = program
        .moves
        .iter()
        .filter_map(|m| program.target_of(m)?.name.clone())
        .collect();
    names.sort_unstable();
    assert_eq!(names, ["P001".into(), "P002".into()] as [Box<str>; 2]);
    // to a job that nobody has
    let program = read(&job(&positions, "CALL JOB:GO ARGFP001\nMOVL P001"));
    assert_eq!(errors(&program), ["target-passed-to-routine"]);
}

#[test]
fn jobs_begin_where_their_callers_stand() {
    let positions = format!("{USER}{}", points(2));
    let named = |name: &str, text: &str| {
        job(&positions, text).replace("//NAME A", &format!("//NAME {name}"))
    };
    let befores = |main: &str, sub: &str| {
        let files = [named("MAIN", main), named("SUB", sub)];
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        let program = read_files(&files, &Settings::default()).expect("jobs");
        let told = program.findings.iter().filter(|f| f.id == "wrist-not-told");
        let told: Vec<_> = told.map(|f| f.file.clone()).collect();
        (
            program.moves.iter().map(|m| m.before).collect::<Vec<_>>(),
            told,
        )
    };
    let main = "MOVL C00000\nCALL JOB:SUB\nMOVL C00001";
    let (found, told) = befores(main, "MOVL C00000");
    assert_eq!(found, [Before::Start, Before::One(2), Before::One(0)]);
    assert_eq!(told, ["0.JBI"]);
    // JUMP does not come back: what follows is dead
    let (found, _) = befores("MOVL C00000\nJUMP JOB:SUB\nMOVL C00001", "MOVL C00000");
    assert_eq!(found, [Before::Start, Before::Anywhere, Before::One(0)]);
    // a job that runs beside
    let (found, told) = befores("PSTART JOB:SUB SUB1\nMOVL C00000", "MOVL C00000");
    assert_eq!(found, [Before::Start, Before::Anywhere]);
    assert_eq!(told.len(), 2);
}

#[test]
fn rconf_tells_the_wrist_where_a_job_begins_with_a_pose() {
    let begins = |fields: usize| {
        let rconf = format!("///RCONF 1{}\n", ",0".repeat(fields - 1));
        let positions = format!(
            "///TOOL 0\n///POSTYPE BASE\n///RECTAN\n{rconf}{}",
            points(1)
        );
        let program = read(&job(&positions, "MOVL C00000 V=5"));
        let numbers: Vec<f64> = program.numbers.iter().map(|n| n.value).collect();
        let layout = program.targets[0].layout;
        let decoded = Inform.decode(layout, &numbers, &Settings::default());
        let told = program.findings.iter().all(|f| f.id != "wrist-not-told");
        (told, decoded.configuration.joint_5_negative)
    };
    assert_eq!(begins(24), (true, Some(true)));
    assert_eq!(begins(8), (false, None));
}

#[test]
fn a_frame_that_the_header_does_not_tell_is_an_error() {
    for (header, id) in [
        ("///TOOL 0\n///RECTAN\n", "frame-not-named"),
        ("///TOOL 0\n///POSTYPE USER\n///RECTAN\n", "frame-not-named"),
        (
            "///TOOL 0\n///POSTYPE PULSE\n///RECTAN\n",
            "frame-not-named",
        ),
        (
            "///TOOL 0\n///POSTYPE TOOL\n///RECTAN\n",
            "tool-coordinates",
        ),
        (
            "///TOOL 0\n///POSTYPE MTOOL\n///RECTAN\n",
            "tool-coordinates",
        ),
        (
            "///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\n",
            "target-not-six-axes",
        ),
    ] {
        let seven = if id == "target-not-six-axes" {
            ",7"
        } else {
            ""
        };
        let program = read(&job(&format!("{header}C00000={P6}{seven}"), "MOVL C00000"));
        assert_eq!(ids(&program), [id], "{header}");
        assert!(program.targets[0].blocked);
    }
}

#[test]
fn what_tells_the_first_solution_is_told() {
    let found = |positions: &str, comment: &str, moves: &str| {
        let text = job(positions, moves).replace("///ATTR", &format!("///COMM {comment}\n///ATTR"));
        let program = read(&text);
        let ids: Vec<_> = program.findings.iter().map(|f| f.id).collect();
        let told = |target: &crate::program::Target| {
            let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
            let decoded = Inform.decode(target.layout, &numbers, &Settings::default());
            decoded.configuration.behind_axis_1
        };
        (ids, told(&program.targets[0]))
    };
    let joints = format!("{USER}C00001={P6}\n///POSTYPE ANGLE\n///ANGLE\nC00000={P6}");
    let moves = "MOVJ C00000 VJ=5\nMOVJ C00001 VJ=5\nMOVJ C00001 VJ=5";
    assert_eq!(found(&joints, "by hand", moves), (vec![], Some(false)));
    assert_eq!(
        found(&joints, "Generated using RoboDK", moves),
        (vec!["rconf-of-post"], None)
    );
    assert_eq!(
        found(&joints, "", "MOVL C00001\nMOVJ C00000"),
        (vec!["wrist-not-told"], Some(false))
    );
}

#[test]
fn a_moved_base_axis_does_not_matter_to_robot_coordinates_and_joints() {
    let positions = format!(
        "///TOOL 0\n///POSTYPE ROBOT\n///RECTAN\n{}///POSTYPE ANGLE\n///ANGLE\nC00005={P6}\nBC00001=500",
        points(1)
    );
    let program = read(&job(&positions, "MOVL C00000 BC00001\nMOVJ C00005 BC00001"));
    assert_eq!(ids(&program), [""; 0]);
}

#[test]
fn a_shift_is_followed_through_branches_loops_and_calls() {
    let body = |instructions: &str| {
        let program = read(&job(&format!("{USER}{}", points(3)), instructions));
        let target = |m: &crate::program::Move| program.target_of(m).expect("a target").blocked;
        program.moves.iter().map(target).collect::<Vec<_>>()
    };
    let (go, on) = ("MOVL C00000", "MOVL C00001");
    assert_eq!(
        body(&format!("{go}\nSFTON P000\n{on}\nSFTOF\nMOVL C00002")),
        [false, true, false]
    );
    assert_eq!(
        body(&format!(
            "IFTHEN IN#(1)=ON\nSFTON P000\nENDIF\n{on}\nSFTOF\n{go}"
        )),
        [true, false]
    );
    assert_eq!(
        body(&format!("SFTON P000\nIFTHEN IN#(1)=ON\nSFTOF\nENDIF\n{go}")),
        [true]
    );
    assert_eq!(
        body(&format!(
            "SFTON P000\nIFTHEN IN#(1)=ON\nSFTOF\nELSEIF IN#(2)=ON\nSFTOF\nELSE\nSFTOF\nENDIF\n{go}"
        )),
        [false]
    );
    assert_eq!(
        body(&format!(
            "SWITCH B000 CASE 1\nSFTON P000\n{on}\nCASE 2\n{go}\nENDSWITCH\nSFTOF\nMOVL C00002"
        )),
        [true, false, false]
    );
    assert_eq!(
        body(&format!("*L\n{go}\nSFTON P000\nJUMP *L IF IN#(1)=ON")),
        [true]
    );
    assert_eq!(
        body(&format!(
            "*L\n{go}\nJUMP *L IF IN#(1)=ON\nSFTON P000\nSFTOF"
        )),
        [false]
    );
    assert_eq!(
        body(&format!(
            "FOR I000= 0 TO 3\n{on}\nSFTON P000\nNEXT I000\nSFTOF\n{go}"
        )),
        [true, false]
    );
    assert_eq!(body(&format!("SFTOF3D\n{go}")), [false]);
    assert_eq!(body(&format!("SFTON3D P000\n{go}")), [true]);
    assert_eq!(
        body(&format!("SFTON P000\nSFTOF IF IN#(1)=ON\n{go}")),
        [true]
    );

    let positions = format!("{USER}{}", points(1));
    let named = |name: &str, text: &str| {
        job(&positions, text).replace("//NAME A", &format!("//NAME {name}"))
    };
    let main = named(
        "MAIN",
        "CALL JOB:ON\nMOVL C00000\nCALL JOB:OFF\nSFTOF\nCALL JOB:PART-2 IF IN#(1)=ON",
    );
    let on = named("ON", "SFTON P010 RF");
    let off = named("OFF", "MOVL C00000\nSFTOF");
    let part = named("PART-2", "MOVL C00000");
    let program = read_files(&[&main, &on, &off, &part], &Settings::default()).expect("jobs");
    let shifted: Vec<_> = program
        .moves
        .iter()
        .map(|m| program.target_of(m).expect("a target").blocked)
        .collect();
    assert_eq!(shifted, [true, true, false]);
}

#[test]
fn variables_belong_to_all_jobs() {
    let holder = job(&format!("{USER}P00018={P6}\nP00019={P6}"), "MOVL P019");
    let user = job("", "MOVJ P018 VJ=5").replace("//NAME A", "//NAME B");
    let program = read_files(&[&holder, &user], &Settings::default()).expect("jobs");
    assert_eq!(program.targets.len(), 2);
    assert_eq!(
        (program.moves[1].file, program.moves[1].target.unwrap()),
        (1, 0)
    );
    assert_eq!(ids(&program), ["position-variable"]);
    // the same variable with another value
    let other =
        job(&format!("{USER}P00018=5,5,5,0,0,0"), "MOVL P018").replace("//NAME A", "//NAME C");
    let program = read_files(&[&holder, &user, &other], &Settings::default()).expect("jobs");
    let ambiguous = program
        .findings
        .iter()
        .filter(|f| f.id == "target-name-ambiguous");
    assert_eq!(ambiguous.count(), 2);
    // the same value in a job that does not go there: whichever is loaded last counts, so both are targets
    let copy = job(&format!("{USER}P00018={P6}"), "").replace("//NAME A", "//NAME C");
    let program = read_files(&[&holder, &user, &copy], &Settings::default()).expect("jobs");
    let files: Vec<_> = program.targets.iter().map(|t| t.file).collect();
    assert_eq!(files, [0, 0, 2]);
    let mut gone: Vec<_> = program.moves.iter().map(|m| m.target.unwrap()).collect();
    gone.sort_unstable();
    assert_eq!(gone, [0, 1, 2]);
    // assigned in one job, used in the other
    let writer = job("", "SET P018 P019").replace("//NAME A", "//NAME D");
    let program = read_files(&[&holder, &user, &writer], &Settings::default()).expect("jobs");
    assert_eq!(ids(&program), ["position-variable", "write-not-called"]);
}

#[test]
fn condition_files_tell_tools_and_frames() {
    let sources = [
        Source::new("TOOL.CND", b"//TOOL 3\n///NAME GUN\n0.000,0.000,120.000,0.0000,0.0000,0.0000\n0.0,0.0,50.0\n2.000\n0,0,0\n".to_vec()),
        Source::new("UFRAME.CND", b"//UFRAME 12\n///NAME\n////BUSER 100.000,0.000,0.000,0.0000,0.0000,0.0000\n".to_vec()),
        Source::new("A.JBI", job(&format!("{USER}{}", points(1)), "MOVL C00000").into_bytes()),
    ];
    let program = crate::motion::read(&Inform, &sources, &Settings::default()).expect("files");
    let pose = program.tools[0].flange_from_tool.expect("a tool");
    assert!((pose.translation[2] - 0.12).abs() < 1e-12);
    assert!(program.tools[0].load.is_some());
    let frame = program.frames[0].world_from_frame.expect("a frame");
    assert!((frame.translation[0] - 0.1).abs() < 1e-12);
    assert_eq!((program.targets[0].file, program.moves[0].file), (2, 2));
}

#[test]
fn every_line_end_comment_and_second_job_is_read() {
    let text = job(
        &format!("///NPOS 2,0,0,0,0,0\n{USER}{}", points(2)),
        "MOVL C00000 V=5\n\tMOVL C00001",
    );
    for end in ["\n", "\r\n", "\r"] {
        let one = text.replace('\n', end);
        let program = read(&format!("'PP version 1{end}{one}"));
        assert_eq!(
            (program.targets.len(), program.moves.len()),
            (2, 2),
            "{end:?}"
        );
        assert_eq!(ids(&program), [""; 0]);
        let two = format!("\u{feff}{one}\u{1a}{end}{one}\u{1a}");
        let program = read(&two);
        assert_eq!(
            (program.targets.len(), program.moves.len()),
            (4, 4),
            "{end:?}"
        );
    }
    let local = text.replace(
        "NOP\n",
        "///LVARS 1,0,0,0,0,1,0,0\nLB000 counter\nLP000 P001\nNOP\n",
    );
    assert_eq!(ids(&read(&local)), [""; 0]);
    let short = text.replace("///NPOS 2", "///NPOS 3");
    assert_eq!(ids(&read(&short)), ["position-count"]);
    let double = text.replace("C00001=", "C00000=");
    assert!(ids(&read(&double)).contains(&"target-name-ambiguous"));
}

#[test]
fn broken_jobs_are_told_with_line_and_column() {
    let text = job(&format!("{USER}{}", points(1)), "MOVL C00000 V=5");
    for (broken, place, message) in [
        (text.replace("\nEND", ""), (1, 1), "is not closed"),
        (text.replace("//INST", "//OTHER"), (1, 1), "is not closed"),
        (
            text.replace("2.000", "2.0OO"),
            (9, 14),
            "found `2.0OO`, where a number",
        ),
        (
            text.replace("2.000,", ""),
            (9, 1),
            "where x, y, z, Rx, Ry and Rz",
        ),
        (text.replace("2.000", ""), (9, 14), "found nothing"),
        (
            text.replace("C00000=1", "C00000 1"),
            (9, 1),
            "where a position such as",
        ),
        (
            text.replace("C00000=", "C0x000="),
            (9, 1),
            "where the number of a position",
        ),
        (
            text.replace("///TOOL 3", "///TOOL x"),
            (5, 1),
            "the number of a tool",
        ),
        (
            text.replace("///RECTAN\n", "")
                .replace("///POSTYPE USER\n", ""),
            (7, 1),
            "where ///PULSE",
        ),
        (
            "NOP\nMOVL C00000\nEND\n".into(),
            (0, 0),
            "it has no line /JOB",
        ),
    ] {
        let error = read_files(&[&broken], &Settings::default()).expect_err("broken");
        let (_, line, column) = error.place();
        assert_eq!((line, column), place, "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
    let zero = Source::new("x", b"/JOB\n\0".to_vec());
    assert!(matches!(
        crate::motion::read(&Inform, &[zero], &Settings::default()),
        Err(ReadError::Binary { .. })
    ));
}

#[test]
fn jobs_and_condition_files_are_recognised_and_others_not() {
    let recognised = |text: &str| Inform.recognises(&Source::new("x", text.as_bytes().to_vec()));
    let text = job(USER, "MOVL C00000");
    assert!(recognised(&text) && recognised(&format!("'PP 1\r\n{text}")));
    assert!(recognised("//TOOL 0\n///NAME\n") && recognised("//UFRAME 1\n"));
    for other in [
        "",
        "/PROG A\n/MN\n",
        "/JOB\n",
        "/JOB\nMOVL C00000\n",
        "2024/01/01 //TOOL 1",
        "MODULE m\nENDMODULE",
        "//PARAM 1\n",
    ] {
        assert!(!recognised(other), "{other}");
    }
}

#[test]
fn the_marker_is_a_comment_behind_nop_in_short_lines() {
    let marker = Marker {
        version: "0.1.0".into(),
        profile_sha256: "a".repeat(64),
        source_sha256: "b".repeat(64),
    };
    for end in ["\n", "\r\n", "\r"] {
        let text = job(&format!("{USER}{}", points(1)), "MOVL C00000 V=5").replace('\n', end);
        let source = Source::new("x", text.clone().into_bytes());
        let (at, comment) = Inform.mark(&source, &marker);
        assert!(text[..at].ends_with(&format!("NOP{end}")));
        let marked = format!("{}{}{}", &text[..at], Source::text(&comment), &text[at..]);
        assert!(Marker::find(marked.as_bytes()).is_some());
        let lines: Vec<_> = Source::text(&comment)
            .split_terminator(end)
            .map(str::to_owned)
            .collect();
        assert!(
            lines
                .iter()
                .all(|line| line.starts_with('\'') && line.len() <= COMMENT + 1)
        );
        assert_eq!(lines.len(), 8);
        assert_eq!(read(&marked).moves.len(), 1);
    }
}
