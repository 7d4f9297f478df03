//! What programs mean.

use super::*;
use crate::finding::Severity;
use crate::geometry::Convention;
use crate::program::{Displacement, Motion, Move, Program, Shape};

mod deciding;
mod inserted;
mod numbers;
mod others;
mod recognised;
mod robust;
mod runs;

const POINTS: &str = ".TRANS\np1 100.000000 900.000000 200.000000 10.000000 180.000000 \
    0.000000\np[1] 1 2 3 4 5 6\np[2] 1 2 3 4 5 7\n\
    grip 0 0 150 0 0 0\noff 0 0 -50 0 0 0\n.END\n.JOINTS\n#home 0.000000 20.000000 -80.000000 \
        0.000000 -80.000000 0.000000\n.END\n";

fn read_files(texts: &[&str]) -> Result<Program, ReadError> {
    let sources: Vec<_> = texts
        .iter()
        .enumerate()
        .map(|(i, text)| Source::new(format!("{i}.as"), text.as_bytes().to_vec()))
        .collect();
    crate::motion::read(&Kawasaki, &sources, &Settings::default())
}

/// A program with these lines, and the points.
fn read(code: &str) -> Program {
    let text = format!(".PROGRAM main() #3;made by hand\n{code}\n.END\n{POINTS}");
    read_files(&[&text]).expect("a program")
}

fn ids(program: &Program) -> Vec<&str> {
    program
        .findings
        .iter()
        .map(|f| f.id)
        .filter(|id| *id != "target-unused-here")
        .collect()
}

fn target<'p>(program: &'p Program, motion: &Move) -> Option<&'p str> {
    program
        .target_of(motion)
        .map(|t| t.name.as_deref().unwrap_or("here"))
}

#[test]
fn o_turns_about_z_then_a_about_y_then_t_about_z() {
    let turned = |angles: [f64; 3], v: [f64; 3]| {
        pose_of([0.0, 0.0, 0.0, angles[0], angles[1], angles[2]]).rotation * v
    };
    // the last angle turns first: x to y, which stays under A, and O turns it to -x
    let x = turned([90.0, 40.0, 90.0], [1.0, 0.0, 0.0]);
    assert!((x[0] + 1.0).abs() < 1e-12, "{x:?}");
    let z = turned([90.0, 90.0, 17.0], [0.0, 0.0, 1.0]);
    assert!((z[1] - 1.0).abs() < 1e-12, "{z:?}");
    // as the pendant shows it
    let rotation = pose_of([0.0, 0.0, 0.0, 20.0, 40.0, -70.0]).rotation;
    let shown = Convention::Kawasaki.numbers(&rotation);
    assert!(
        shown
            .iter()
            .zip([20.0, 40.0, -70.0])
            .all(|(a, b)| (a - b).abs() < 1e-9)
    );
}

#[test]
fn angles_stay_on_the_branch_of_the_file() {
    for present in [
        [10.0, 20.0, 30.0],
        [10.0, -20.0, 30.0],
        [-170.0, 179.0, 175.0],
        [89.997, 89.996, 120.955],
        [200.0, 40.0, -253.94],
        // O stays where only its sum or difference with T counts
        [33.0, 0.0, 20.0],
        [33.0, 180.0, -89.4777],
        [0.0, 180.0, 0.0],
    ] {
        let rotation = pose_of([0.0, 0.0, 0.0, present[0], present[1], present[2]]).rotation;
        let found = nearest_angles(&rotation, present);
        let gap = (0..3).map(|i| (found[i] - present[i]).abs());
        assert!(gap.fold(0.0, f64::max) < 1e-6, "{present:?} {found:?}");
    }
    let numbers = [1.0, 2.0, 3.0, 10.0, 180.0, 0.0];
    let mut written = numbers;
    let tilted = pose_of([1.0, 2.0, 3.0, 77.0, 179.9, 67.0]);
    Kawasaki.write_pose(
        Layout {
            shape: Shape::Pose,
            variant: 0,
        },
        &tilted,
        &mut written,
    );
    let gap = pose_of(written).separation(&tilted);
    assert!(gap.angle_rad < 1e-9 && gap.distance_m < 1e-12);
}

#[test]
fn moves_go_to_names_and_to_what_is_written_out() {
    let program = read(
        "SPEED 250 MM/S ALWAYS\nACCURACY 2 ALWAYS\nTOOL grip\nBASE NULL\nJMOVE #home ; LMOVE \
         p1\n10 LMOVE P1\nSPEED 10 MM/S\n\
         HMOVE TRANS(1, 2,-3.5,4,5,6)\nC1MOVE p[1]\nC2MOVE p[2]\nJMOVE #[1,2,3,4,5,6]\nLAPPRO p1,50\nLDEPART 30\nTYPE \"LMOVE p1\"",
    );
    let found: Vec<_> = program
        .moves
        .iter()
        .map(|m| (m.motion, target(&program, m)))
        .collect();
    assert_eq!(
        found,
        [
            (Motion::Joint, Some("#home")),
            (Motion::Linear, Some("p1")),
            (Motion::Linear, Some("here")),
            (Motion::ArcVia, Some("p[1]")),
            (Motion::ArcEnd, Some("p[2]")),
            (Motion::Joint, Some("here")),
            (Motion::Linear, Some("p1")),
            (Motion::Linear, Some("p1")),
        ]
    );
    let near = |m: &Move| match &m.displacement {
        Displacement::By(by) => by.in_tool.translation[2],
        _ => 0.0,
    };
    let z: Vec<f64> = program.moves.iter().map(near).collect();
    assert_eq!(z[6], -0.05);
    assert!((z[7] + 0.08).abs() < 1e-12, "{z:?}");
    assert!(program.moves[2].free_orientation && !program.moves[1].free_orientation);
    let speed = |m: usize| program.speed_zone(&program.moves[m]);
    assert_eq!(
        (speed(1).speed_m_s, speed(1).zone_m),
        (Some(0.25), Some(0.002))
    );
    assert_eq!(
        (speed(2).speed_m_s, speed(3).speed_m_s),
        (Some(0.01), Some(0.25))
    );
    let (tool, base) = (
        &program.tools[program.moves[1].tool],
        &program.frames[program.moves[1].frame],
    );
    let tip = tool.flange_from_tool.expect("known").translation;
    assert_eq!((tool.name.as_str(), tip), ("grip", [0.0, 0.0, 0.15]));
    assert!(base.world_from_frame.is_some());
    // targets stand in the order of the text
    let places: Vec<u32> = program.targets.iter().map(|t| t.offset).collect();
    assert!(places.is_sorted());
    let inline = program
        .targets
        .iter()
        .find(|t| t.name.is_none())
        .expect("one");
    assert_eq!(program.numbers_of(inline)[2].value, -3.5);
}

#[test]
fn what_is_added_to_a_position_displaces_it() {
    let program = read(
        "TOOL NULL\nBASE NULL\nJMOVE #home\nLMOVE p1+off\nLMOVE p1-off\nLMOVE SHIFT(p1 BY \
         10,,-5)\nLMOVE p1+RZ(90)\nLMOVE p1+q\nLMOVE p1\nDRAW 0,5\nTDRAW 0,0,7\nDRAW x",
    );
    let shifts: Vec<_> = program
        .moves
        .iter()
        .map(|m| match &m.displacement {
            Displacement::By(by) => Some((by.in_frame.translation, by.in_tool.translation)),
            Displacement::None => Some(([0.0; 3], [0.0; 3])),
            _ => None,
        })
        .collect();
    assert_eq!(shifts[1], Some(([0.0; 3], [0.0, 0.0, -0.05])));
    assert_eq!(shifts[2], Some(([0.0; 3], [0.0, 0.0, 0.05])));
    assert_eq!(shifts[3], Some(([0.01, 0.0, -0.005], [0.0; 3])));
    assert_eq!(shifts[5], None);
    assert_eq!(shifts[7], Some(([0.0, 0.005, 0.0], [0.0; 3])));
    assert_eq!(shifts[8], Some(([0.0, 0.005, 0.0], [0.0, 0.0, 0.007])));
    let last = &program.moves[9].displacement;
    assert!(matches!(last, Displacement::AtLeast(_)), "{last:?}");
    assert_eq!(ids(&program), [""; 0]);
    // a statement behind a line number writes, too
    let program = read("TOOL NULL\nBASE NULL\nLMOVE p1+off\n10 POINT off = x");
    let by = &program.moves[0].displacement;
    assert!(matches!(by, Displacement::AtLeast(_)), "{by:?}");
}

#[test]
fn numbers_that_a_transformation_leaves_out_are_put_in() {
    let program =
        read("TOOL NULL\nBASE NULL\nJMOVE #home\nLMOVE TRANS(100,900.5)\nLMOVE TRANS(1,2,3)");
    assert_eq!(ids(&program), [""; 0]);
    let targets: Vec<_> = program
        .targets
        .iter()
        .filter(|t| t.name.is_none())
        .collect();
    let values = |at: usize| program.numbers_of(targets[at]).iter().map(|of| of.value);
    assert!(values(0).eq([100.0, 900.5, 0.0, 0.0, 0.0, 0.0]));
    assert!(values(1).eq([1.0, 2.0, 3.0, 0.0, 0.0, 0.0]));
    let lengths = program.numbers_of(targets[1]).iter().map(|of| of.length);
    assert!(lengths.eq([1, 1, 1, 0, 0, 0]));
    assert_eq!(
        Kawasaki.around_missing(targets[1].layout, 3),
        (",".into(), "")
    );
    assert!(Kawasaki.has_missing_in_order());
}

#[test]
fn one_joint_turns_from_where_the_robot_is() {
    use crate::program::script::Turn;
    let program = read("TOOL NULL\nBASE NULL\nJMOVE #home\nDRIVE 3,-5.5,20\nLMOVE p1");
    let turned = program.turned(&program.moves[1]).expect("a turn");
    assert_eq!(turned[2], Turn::By((-5.5_f64).to_radians()));
    assert!((0..6).all(|at| at == 2 || turned[at] == Turn::Stays));
}

#[test]
fn a_tool_that_draw_turns_turns_by_no_more_than_its_angles() {
    use crate::program::Stride;
    let program = read("TOOL NULL\nBASE NULL\nJMOVE #home\nLMOVE p1\nDRAW 0,5,0,0,10,-20,100");
    let Displacement::Within(strides) = &program.moves[2].displacement else {
        panic!("{:?}", program.moves[2].displacement);
    };
    let turned = strides.iter().find_map(|stride| match stride {
        Stride::Turned(angle) => *angle,
        _ => None,
    });
    assert!((turned.expect("an angle") - 30_f64.to_radians()).abs() < 1e-12);
}

#[test]
fn tools_are_followed_and_programs_called() {
    let text = format!(
        ".PROGRAM main()\nTOOL grip\nBASE TRANS(10,0,0)\nCALL go(p1,3)\nIF x>2 THEN\nJMOVE \
         #home\nELSE\nGOTO 100\nEND\nFOR i=1 TO 2\nLMOVE p[i]\nEND\n100 LMOVE p[1]\n.END\n\
         .PROGRAM go(.a,.n)\nLMOVE .a\n.END\n{POINTS}"
    );
    let program = read_files(&[&text]).expect("a program");
    let mut found: Vec<_> = program
        .moves
        .iter()
        .filter_map(|m| target(&program, m))
        .collect();
    found.sort_unstable();
    found.dedup();
    assert_eq!(found, ["#home", "p1", "p[1]", "p[2]"]);
    for motion in program
        .moves
        .iter()
        .filter(|m| target(&program, m) != Some("#home"))
    {
        assert_eq!(program.tools[motion.tool].name, "grip");
        let base = program.frames[motion.frame]
            .world_from_frame
            .expect("known");
        assert_eq!(base.translation, [0.01, 0.0, 0.0]);
    }
    assert!(
        program
            .findings
            .iter()
            .all(|f| f.severity != Severity::Error),
        "{:?}",
        program.findings
    );
}

#[test]
fn what_is_not_sure_is_refused_or_reported() {
    for (code, expected) in [
        ("LMOVE TRANS(1,2,3,,5)", "partial-target"),
        ("DRIVE 3,5", "relative-joint-move"),
        ("DRIVE 7,5", "relative-move"),
        ("DRIVE 3,x", "relative-move"),
        ("LMOVE TRANS(1,2,3,4,-1e999,6)", "partial-target"),
        ("LMOVE TRANS(1,2,3,4,5,x)", "computed-target"),
        ("LMOVE TRANS(1,2,3,4,5,6,7)", "target-not-six-axes"),
        ("JMOVE #[1,2,3,4,5,6,0,0.5]", "target-not-six-axes"),
        ("POINT p1 = FRAME(a,b,c,d)\nLMOVE p1", "computed-target"),
        ("POINT/X p1 = dx\nLMOVE p1", "target-assigned-at-run-time"),
        ("HERE p1\nLMOVE p1", "run-time-position"),
        ("HERE q\nTOOL grip\nLMOVE q", "computed-target"),
        (
            "POINT q = HERE+TRANS(0,0,-200)\nLMOVE q",
            "run-time-position",
        ),
        ("POINT q = HERE\nBASE grip\nLMOVE q", "computed-target"),
        ("HERE #q\nTOOL grip\nJMOVE #q", "run-time-position"),
        ("LMOVE q7", "target-not-in-files"),
        ("RIGHTY\nJMOVE p1", "configuration-not-understood"),
        ("XMOVE p1 TILL 3", "search-move"),
        ("L3LMOVE p1", "move-not-supported"),
        ("cvlappro p1,50", "move-not-supported"),
        ("JMOVE #elsewhere", "joint-target-not-in-files"),
        ("C1MOVE p[1]\nC1MOVE p[2]\nC2MOVE p1", "arc-chain"),
        ("HERE .#q\nJMOVE .#q", "run-time-position"),
        ("LDEPART 5", "relative-move"),
        ("LMOVE p1\nTOOL grip\nLDEPART 5", "relative-move"),
        ("TOOL grip+q\nLMOVE p1", "frame-assigned-at-run-time"),
        ("TOOL TRANS(0,0,150,0,1000,0)\nLMOVE p1", "angle-too-large"),
        ("BASE p[2]+TRANS(0,0,0,-1500)\nLMOVE p1", "angle-too-large"),
        ("CALL elsewhere(p1)", "target-passed-to-routine"),
    ] {
        let program = read(&format!("TOOL NULL\nBASE NULL\n{code}"));
        assert!(
            ids(&program).contains(&expected),
            "{code}: {:?}",
            program.findings
        );
    }
    // a variable may be called so
    let program = read("TOOL NULL\nBASE NULL\ndomove = 3\nLMOVE p1");
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
    // what is behind a move that is not read starts nobody knows where
    let program = read("TOOL NULL\nBASE NULL\nLMOVE p1\nFLMOVE p[1]\nLDEPART 5");
    assert!(ids(&program).contains(&"relative-move"));
    // joints tell the configuration again
    let program = read("TOOL NULL\nBASE NULL\nRIGHTY\nJMOVE #home\nLMOVE p1");
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
    let program =
        read("TOOL NULL\nBASE NULL\nRIGHTY\nJOINT SPEED9 ACCU1 TOOL1 #[1,2,3,4,5,6]\nLMOVE p1");
    assert!(!ids(&program).contains(&"configuration-not-understood"));
    // an axis besides the arm's that stands at zero
    let program = read(
        "TOOL NULL\nBASE NULL\nJMOVE #[1,2,3,4,5,6,0]\nLMOVE p1\nLMOVE TRANS(100,500,300,0,180,0,0.0)",
    );
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
    // the same name with other values in two files
    let again = POINTS.replace("100.000000", "101.000000");
    let code = format!(".PROGRAM a()\nTOOL NULL\nBASE NULL\nLMOVE p1\n.END\n{POINTS}");
    let program = read_files(&[&code, &again]).expect("programs");
    assert!(ids(&program).contains(&"target-name-ambiguous"));
}

#[test]
fn other_sections_are_passed_over() {
    let text = format!(
        ".NETCONF 192.168.0.2,\"x\"\n.ROBOTDATA1\nZSYSTEM 1 2 3\np1 not \
         numbers\n.END\n.SYSDATA\nTOOL 0.0\n.END\n.AUXDATA\nLMOVE p1\n.END\n\
         .PROGRAM a()\n.x[1] = 3\n  .tool = 5\nTOOL NULL\nBASE NULL\nLMOVE \
             p1\n.END\n{POINTS}.REALS\nx = 5\n.END\n"
    );
    let program = read_files(&[&text]).expect("a save");
    assert_eq!(program.moves.len(), 1);
    for (text, is) in [
        (".PROGRAM a()\nLMOVE p1\n.END\n", true),
        (".PROGRAM a()\nMOVES p1\n.END\n", false),
        ("\u{feff}.TRANS\r\n", true),
        ("mov ax, bx\n", false),
    ] {
        assert_eq!(
            Kawasaki.recognises(&Source::new("x.as", text.into())),
            is,
            "{text}"
        );
    }
    // a line in front of a section
    let height = |before: &str| {
        let text = format!(
            "{before}.REALS\nhh = 30\n.END\n.PROGRAM a()\nTOOL NULL\nBASE NULL\nLAPPRO \
             p1,hh\n.END\n{POINTS}"
        );
        format!(
            "{:?}",
            read_files(&[&text]).expect("a save").moves[0].displacement
        )
    };
    for before in [".*header\n", ".NETCONF 192.168.0.2,\"x\"\n"] {
        assert_eq!(height(before), height(""));
    }
    assert_ne!(height(".REALS\nhh = 40\n.END\n"), height(""));
    let error = read_files(&[".TRANS\np1 1 2 x\n.END\n"]).expect_err("no number");
    assert!(error.to_string().contains("0.as:2:8"), "{error}");
    // what a transfer has cut
    for (text, place) in [
        (".TRANS\np1 1 2 3 4 5 6\n", "0.as:1:1"),
        (".TRANS\n.END\n.PROGRAM a()\nLMOVE p1\n.EN", "0.as:3:1"),
        (".SYSDATA\nTOOL 0 0 1 0 0 0\n", "0.as:1:1"),
    ] {
        let error = read_files(&[text]).expect_err("cut").to_string();
        assert!(
            error.contains(place) && error.contains("is not closed"),
            "{error}"
        );
    }
}

#[test]
fn tool_and_base_begin_as_they_were_saved_and_a_move_with_them_says_so() {
    let save = ".SYSDATA\nREG_POINT       0\nBASE           -120.000   143.000     0.000     \
        0.000     0.000     0.000\nSWITCH CP ON\n.END\n";
    let read = |saves: &[&str], code: &str| {
        let text = format!(".PROGRAM a()\n{code}\n.END\n{POINTS}");
        let texts: Vec<&str> = saves.iter().copied().chain([&text[..]]).collect();
        read_files(&texts).expect("a save")
    };
    let base = |program: &Program, at: usize| {
        let frame = &program.frames[program.moves[at].frame];
        frame.world_from_frame.map(|pose| pose.translation)
    };
    let program = read(&[save], "TOOL NULL\nLMOVE p1\nBASE NULL\nLMOVE p1");
    assert_eq!(base(&program, 0), Some([-0.12, 0.143, 0.0]));
    assert_eq!(base(&program, 1), Some([0.0; 3]));
    let found: Vec<_> = (program.findings.iter())
        .filter(|finding| finding.id == "frame-as-saved")
        .map(|finding| (finding.line, finding.severity))
        .collect();
    assert_eq!(found, [(3, Severity::Warning)]);
    // two saves that differ, and one that is not whole, tell nothing
    let other = save.replace("143", "144");
    for saves in [&[save, &other][..], &[".SYSDATA\nBASE 1 2 3\n.END\n"]] {
        let program = read(saves, "TOOL NULL\nLMOVE p1");
        assert_eq!(base(&program, 0), None);
        assert!(!ids(&program).contains(&"frame-as-saved"));
    }
}

#[test]
fn the_marker_stands_in_a_program() {
    let marker = Marker {
        version: "1".into(),
        profile_sha256: "a".repeat(64),
        source_sha256: "b".repeat(64),
        decided: Vec::new(),
    };
    for text in [
        ".PROGRAM a()\r\nLMOVE p1\r\n.END\r\n",
        ".TRANS\np1 1 2 3 4 5 6\n.END",
    ] {
        let source = Source::new("x.as", text.into());
        let (at, comments) = Kawasaki.mark(&source, &marker);
        let mut whole = source.bytes.clone();
        whole.splice(at..at, comments);
        assert!(Marker::find(&whole).is_some());
        let before = sections::read(&source).expect("sections").entries.len();
        let whole = Source::new("x.as", whole);
        let after = sections::read(&whole).expect("sections");
        assert_eq!(after.entries.len(), before);
    }
}

#[test]
fn a_weight_is_that_of_the_moves_behind_it() {
    let program = read(
        "TOOL grip\nLMOVE p1\nWEIGHT 6,0,0,80\nLMOVE p[1]\n.END\n.PROGRAM other()\nWEIGHT 9,0,0,80",
    );
    let loads: Vec<_> = program
        .moves
        .iter()
        .map(|of| program.tools[of.tool].load)
        .collect();
    assert_eq!(loads[0], None);
    assert_eq!(loads[1].map(|load| load.mass_kg), Some(6.0));
}
