use super::*;
use crate::finding::Severity;
use crate::geometry::Pose;
use crate::program::{
    Before, Displacement, Edits, Motion, Move, Program, Shape, Shift, Stride, Value,
};

mod asked;
mod deciding;
mod flow;
mod posts;
mod recognised;
mod robust;
mod samples;
mod steps;
mod structures;

fn read_file(text: &[u8]) -> Result<Program, ReadError> {
    read_sources(&[Source::new("a.script", text.to_vec())])
}

fn read_sources(sources: &[Source]) -> Result<Program, ReadError> {
    crate::motion::read(&UrScript, sources, &Settings::default())
}

fn read(text: &str) -> Program {
    read_file(text.as_bytes()).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// A function of these lines.
fn path(lines: &str) -> Program {
    read(&format!("def m():\n{lines}\nend\n"))
}

fn to(program: &Program) -> Vec<String> {
    let name = |used: &Move| {
        let Some(target) = program.target_of(used) else {
            return "?".to_owned();
        };
        let name = target.name.as_deref().unwrap_or("-");
        format!("{name}{}", if target.blocked { "!" } else { "" })
    };
    program.moves.iter().map(name).collect()
}

fn ids(program: &Program) -> Vec<&str> {
    program.findings.iter().map(|finding| finding.id).collect()
}

fn pose_of(program: &Program, target: usize) -> Pose {
    let target = &program.targets[target];
    let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
    match UrScript
        .decode(target.layout, &numbers, &Settings::default())
        .value
    {
        Value::Pose(pose) => pose,
        Value::Joints(_) => panic!("a pose"),
    }
}

fn tool_x(program: &Program, number: usize) -> Option<f64> {
    let tool = &program.tools[program.moves[number].tool];
    assert_eq!(tool.name, "tcp");
    tool.flange_from_tool.map(|pose| pose.translation[0])
}

#[test]
fn waypoints_of_the_pendant_are_rewritten_and_their_seeds_stay() {
    let text = "def Prog():\r\n  set_tcp(p[0.0,0.0,0.1,0.0,0.0,0.0])\r\n  set_payload(1.5, [0.01, \
        0, .05])\r\n  \
        global Waypoint_1_p=p[.433025361705, -.467959205379, .522310714714, 1.500318891221, \
            .521427297251, .530987104689]\r\n  \
        global Waypoint_1_q=[1.9942498207092285, -1.6684614620604457, 1.9330504576312464, \
            -0.2718423169902344, 1.32, 1.4000000000000001E-4]\r\n  \
        $ 8 \"corner\u{2254}pose_trans(a,p[1,2,3,4,5,6])\"\r\n  while (True):\r\n    $ 2 \
            \"movel(p[\"\r\n    \
        movej(get_inverse_kin(Waypoint_1_p, qnear=Waypoint_1_q), a=1.39, v=1.04)\r\n    \
            movel(Waypoint_1_p)\r\n  end\r\nend\r\n";
    let program = read(text);
    assert_eq!(to(&program), ["Waypoint_1_p", "Waypoint_1_p"]);
    assert_eq!(program.findings, []);
    assert_eq!(program.targets.len(), 1);
    let near = program.near(&program.moves[0]).expect("a seed");
    assert!((near[0] - 1.994_249_820_709_228_5).abs() < 1e-15 && (near[5] - 1.4e-4).abs() < 1e-15);
    assert_eq!(program.near(&program.moves[1]), None);
    let tool = &program.tools[program.moves[0].tool];
    let load = tool.load.expect("a load");
    assert!((load.mass_kg - 1.5).abs() < 1e-15 && (load.cog_m[2] - 0.05).abs() < 1e-15);
    assert_eq!(program.frames[program.moves[0].frame].name, "base");
    let numbers = program.numbers_of(&program.targets[0]);
    let first = numbers[0].start as usize;
    assert_eq!(
        &text[first..first + usize::from(numbers[0].length)],
        ".433025361705"
    );
}

#[test]
fn every_move_and_every_form_of_its_target_is_read() {
    let program = path(
        "movej([0,-1.5,1.5,0,1,0],a=1,v=1)\nmovej(p[.1,.2,.3,0,0,1])\nmovel(pose=p[.1,.2,.3,0,0,1],a=1)\nmovep(p [.1,.2,.3,0,0,1], r=.01)\n\
         movec(p[.1,.2,.3,0,0,1], pose_to=p[.1,.2,.4,0,0,1], a=0.01, \
             mode=0)\nmovej(get_inverse_kin(p[-.3,.2,.3,0,0,1], qnear=[-3.14,0,0,0,0,0]))\n\
         movel([0,d2r(1),1,0,1,0])\nmovej([d2r(0),d2r(-90),d2r(90.5), d2r( 0 \
             ),d2r(90),d2r(0)])\nmovel(p[.1,.2,.3,d2r(180),d2r(0),d2r(0)])\n\
         servoj([0,1,2,3,4,5], t=0.008)\nif movel(p[1,\n 2,3,4,\n5,6]): sync() end",
    );
    let kinds: Vec<_> = program.moves.iter().map(|m| m.motion).collect();
    use Motion::{ArcEnd, ArcVia, Joint, Linear};
    assert_eq!(
        kinds,
        [
            Joint, Joint, Linear, Linear, ArcVia, ArcEnd, Joint, Linear, Joint, Linear, Joint,
            Linear
        ]
    );
    assert_eq!(ids(&program), [""; 0]);
    let shapes: Vec<_> = program
        .targets
        .iter()
        .map(|t| {
            (
                t.layout.shape == Shape::Joints,
                t.layout.variant,
                t.numbers.len(),
            )
        })
        .collect();
    assert_eq!(shapes[0], (true, 0, 6));
    assert_eq!(shapes[7], (true, 0b00_0010, 6));
    assert_eq!(shapes[8], (true, 0b11_1111, 6));
    assert_eq!(shapes[9], (false, 0b11_1000, 6));
    let mixed = path("movel(p[.4,-.1,.3,0,d2r(180),0])\nmovel(p[.4,-.1,.3,d2r(-90),0,1.5])");
    let angles = [0, 1].map(|at| pose_of(&mixed, at).rotation.angle());
    let second = std::f64::consts::FRAC_PI_2.hypot(1.5);
    assert!((angles[0] - std::f64::consts::PI).abs() < 1e-9 && (angles[1] - second).abs() < 1e-9);
    let layout = mixed.targets[1].layout;
    let mut again: Vec<f64> = mixed
        .numbers_of(&mixed.targets[1])
        .iter()
        .map(|n| n.value)
        .collect();
    let before = again.clone();
    UrScript.write_pose(layout, &pose_of(&mixed, 1), &mut again);
    assert!(
        again.iter().zip(&before).all(|(a, b)| (a - b).abs() < 1e-9),
        "{again:?}"
    );
    let half = pose_of(&program, 9).rotation.angle();
    assert!((half - std::f64::consts::PI).abs() < 1e-9);
}

#[test]
fn comments_between_the_numbers_of_a_target_are_passed_over() {
    let program = path("movel(p[.4, -.1, # height, [7]\n  .3,0,# rotation\r\n3.1,0 # end\n])");
    assert_eq!(ids(&program), [""; 0]);
    let numbers = program.numbers_of(program.targets.last().expect("a target"));
    let values: Vec<f64> = numbers.iter().map(|number| number.value).collect();
    assert_eq!(values, [0.4, -0.1, 0.3, 0.0, 3.1, 0.0]);
}

#[test]
fn targets_that_nobody_can_correct_are_errors() {
    for (lines, id, moves) in [
        (
            "movel(p[-.80,.9,0,pi/2,0,0])",
            "target-has-expressions",
            "-!",
        ),
        ("movel(p[1,2,3])", "target-has-expressions", "-!"),
        ("movel(nowhere)", "target-not-in-files", "?"),
        (
            "x=p[1,2,3,0,0,0]\nmovel(x)\nx[2]=x[2]+.1\nmovel(x)",
            "target-assigned-at-run-time",
            "x!,?",
        ),
        (
            "f=p[1,0,0,0,0,0]\nf[0]=2\nmovel(pose_trans(f,p[1,2,3,0,0,0]))",
            "frame-assigned-at-run-time",
            "-!",
        ),
        (
            "movel(pose_trans(vision(),p[1,2,3,0,0,0]))",
            "frame-chosen-at-run-time",
            "-!",
        ),
        ("servoc(p[1,2,3,0,0,0])", "streamed-motion", "-!"),
        (
            "servoj(get_inverse_kin(p[1,2,3,0,0,0]))",
            "streamed-motion",
            "-!",
        ),
        (
            "path_offset_enable()\nmovel(p[1,2,3,0,0,0])",
            "moving-frame",
            "-!",
        ),
    ] {
        let program = path(lines);
        assert_eq!(to(&program).join(","), moves, "{lines}");
        assert_eq!(ids(&program), [id], "{lines}");
        assert!(program.findings[0].severity == Severity::Error && program.findings[0].line > 1);
    }
}

#[test]
fn arcs_with_which_the_tool_rotates_are_refused() {
    let arc = "movel(p[1,2,3,0,0,0])\nmovec(p[2,2,3,0,0,0],p[2,3,3,0,0,0],a=1,v=.1,r=0";
    for (mode, is_refused) in [
        (")", false),
        (",mode=0)", false),
        (",0)", false),
        (",mode=1)", true),
        (",1)", true),
        (",mode=m)", true),
    ] {
        let program = path(&format!("{arc}{mode}"));
        let all = ids(&program);
        assert_eq!(!all.is_empty(), is_refused, "{mode}");
        assert!(all.iter().all(|id| *id == "move-not-supported"), "{mode}");
    }
}

#[test]
fn what_the_program_computes_stays_and_is_reported() {
    for (lines, id, severity) in [
        ("movel(get_target())", "computed-target", Severity::Warning),
        ("movel(list[i])", "target-not-in-files", Severity::Error),
        ("movel(a+b)", "computed-target", Severity::Warning),
        (
            "movel(interpolate_pose(p[1,2,3,0,0,0],p[1,2,3,0,0,0],0.5))",
            "computed-target",
            Severity::Warning,
        ),
        (
            "x=get_actual_tcp_pose()\nmovel(x)",
            "run-time-position",
            Severity::Note,
        ),
        (
            "x=get_actual_tcp_pose()\nset_tcp(p[0,0,.2,0,0,0])\nmovel(x)",
            "computed-target",
            Severity::Warning,
        ),
        (
            "set_tcp(p[0,0,.1,0,0,0])\nx=get_actual_tcp_pose()\nmovel(x)\nset_tcp(p[0,0,.2,0,0,0])",
            "run-time-position",
            Severity::Note,
        ),
        (
            "while True:\nx=get_actual_tcp_pose()\nmovel(x)\nset_tcp(p[0,0,.2,0,0,0])\nend",
            "run-time-position",
            Severity::Note,
        ),
        (
            "while True:\nx=get_actual_tcp_pose()\nset_tcp(p[0,0,.2,0,0,0])\nmovel(x)\nend",
            "computed-target",
            Severity::Warning,
        ),
        (
            "movel(pose_trans(p[1,0,0,0,0,0],get_actual_tcp_pose()))",
            "computed-target",
            Severity::Warning,
        ),
        (
            "q=get_actual_joint_positions()\nset_tcp(p[0,0,.2,0,0,0])\nmovej(q)",
            "run-time-position",
            Severity::Note,
        ),
        (
            "q=get_actual_joint_positions()\nq[5]=0\nmovej(q)",
            "computed-target",
            Severity::Warning,
        ),
        (
            "movel(pose_trans(get_actual_tcp_pose(),p[0,0,.1,0,0,0]))",
            "run-time-position",
            Severity::Warning,
        ),
        (
            "d=p[0,0,.1,0,0,0]\nmovel(pose_add(d,get_actual_tcp_pose()))",
            "computed-target",
            Severity::Warning,
        ),
        (
            "d=p[0,0,.1,0,0,0]\nhere=get_actual_tcp_pose()\nmovel(pose_add(d,here))",
            "computed-target",
            Severity::Warning,
        ),
        (
            "x=get_target_tcp_pose()\nx=pose_add(x,p[0,0,.1,0,0,0])\nmovel(x)",
            "run-time-position",
            Severity::Warning,
        ),
        (
            "speedl([0,0,1,0,0,0])",
            "motion-without-target",
            Severity::Note,
        ),
    ] {
        let program = path(lines);
        assert_eq!(ids(&program), [id], "{lines}");
        assert_eq!(program.findings[0].severity, severity, "{lines}");
        // the next move is not judged from a false start
        assert_eq!(
            (to(&program), program.targets.len()),
            (vec!["?".to_owned()], 0),
            "{lines}"
        );
    }
}

#[test]
fn look_alikes_are_no_targets() {
    let program = path(
        "# movel(p[1,2,3,4,5,6])\ntextmsg(\"movel(p[1,2,3,4,5,6])\")\nforce_mode(p[1,2,3,4,5,6],[0,0,1,0,0,0],[0,0,1,0,0,0],2,[1,1,1,1,1,1])\n\
         plane=p[1,2,3,0,0,0]\nrpc.movel(p[1,2,3,4,5,6])\nx = \
             my_movel(p[1,2,3,4,5,6])\nset_gravity([0,0,9.8])",
    );
    assert_eq!((program.targets.len(), program.moves.len()), (0, 0));
    // what `my_movel` does nobody knows
    assert_eq!(
        ids(&program),
        ["motion-without-target", "pose-passed-to-routine"]
    );
}

#[test]
fn features_are_frames_and_offsets_of_targets_displacements() {
    let program = path(
        "global plane=p[1,0,0,0,0,1.5707963267948966]\nmovel(pose_trans(plane,p[.1,.2,.3,0,0,1]))\nmovel(pose_trans(p[0,2,0,0,0,0],p[.1,.2,.3,0,0,1]))\n\
         movel(pose_trans(from_installation,p[.1,.2,.3,0,0,1]))\nw=p[.4,.5,.6,0,0,0]\nmovel(pose_trans(w,p[0,0,-.1,0,0,0]))\nmovel(w)\n\
         up=pose_add(w,p[0,0,.2,0,0,0])\nmovej(up)\nmovel(pose_trans(plane,pose_trans(p[0,0,1,0,0,0],p[.1,.2,.3,0,0,1])))\nmovel(pose_trans(w,v))",
    );
    assert_eq!(program.findings, []);
    let frame = |number: usize| &program.frames[program.moves[number].frame];
    assert_eq!(frame(0).name, "plane");
    assert!(
        frame(0)
            .world_from_frame
            .is_some_and(|f| (f.rotation.angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-12)
    );
    assert_eq!(
        (frame(1).name.as_str(), frame(2).name.as_str()),
        ("feature", "from_installation")
    );
    assert_eq!(frame(2).world_from_frame, None);
    let nested = frame(6)
        .world_from_frame
        .expect("both are known")
        .translation;
    assert!((nested[0] - 1.0).abs() < 1e-12 && (nested[2] - 1.0).abs() < 1e-12);
    let shift = |number: usize| match &program.moves[number].displacement {
        Displacement::By(shift) => (shift.in_frame.translation[2], shift.in_tool.translation[2]),
        other => panic!("{other:?}"),
    };
    assert_eq!(to(&program)[3..6], ["w", "w", "w"].map(String::from));
    assert!((shift(3).1 + 0.1).abs() < 1e-15 && shift(3).0 == 0.0);
    assert!((shift(5).0 - 0.2).abs() < 1e-15 && shift(5).1 == 0.0);
    assert_eq!(program.moves[7].displacement, Displacement::Unknown);
}

#[test]
fn a_target_that_is_an_offset_elsewhere_is_an_error() {
    let program =
        path("w=p[.4,.5,.6,0,0,0]\no=p[0,0,.1,0,0,0]\nmovel(w)\nmovel(o)\nmovel(pose_trans(w,o))");
    assert!(
        ids(&program)
            .iter()
            .all(|id| *id == "target-used-as-offset"),
        "{:?}",
        program.findings
    );
    assert!(program.targets.iter().all(|target| target.blocked));
    // what is in a feature that is a target is displaced from it
    let program = path(
        "w=p[.4,.5,.6,0,0,0]\nf=pose_trans(w,p[0,0,.1,0,0,0])\nmovel(w)\nmovel(pose_trans(f,p[1,2,3,0,0,0]))",
    );
    assert_eq!(ids(&program), [""; 0]);
    let displacement = &program.moves[1].displacement;
    let Displacement::By(shift) = displacement else {
        panic!("{displacement:?}")
    };
    assert_eq!(shift.in_tool.translation, [1.0, 2.0, 3.1]);
}

#[test]
fn the_tool_is_the_one_that_is_set_where_the_move_stands() {
    let m = |text: &str| {
        path(
            &text
                .replace('M', "movel(p[.1,.2,.3,0,0,0])")
                .replace("T1", "set_tcp(p[1,0,0,0,0,0])")
                .replace("T2", "set_tcp(p[2,0,0,0,0,0])"),
        )
    };
    for (text, tools) in [
        ("M", vec![None]),
        ("T1\nM\nT2\nM", vec![Some(1.0), Some(2.0)]),
        (
            "T1\nif a:\nM\nelse:\nT2\nM\nend",
            vec![Some(1.0), Some(2.0)],
        ),
        ("T1\nwhile True:\nM\nT1\nend\nM", vec![Some(1.0); 2]),
        ("t=p[2,0,0,0,0,0]\nset_tcp(t)\nM", vec![Some(2.0)]),
        ("h=1.5\nset_tcp(p[h+0.5,0,0,0,0,0])\nM", vec![Some(2.0)]),
        (
            "def x(a):\nreturn a*2\nend\nt=p[x(1),0,0,0,0,d2r(90)]\nset_tcp(t)\nM",
            vec![Some(2.0)],
        ),
        ("def sub():\nM\nend\nT1\nsub()", vec![Some(1.0)]),
        ("def tool():\nT1\nend\ntool()\nM", vec![Some(1.0)]),
        ("T1\nif a:\nT2\nhalt\nend\nM", vec![Some(1.0)]),
        (
            "T1\nwhile a:\nif b:\nbreak\nend\nT1\nend\nM",
            vec![Some(1.0)],
        ),
    ] {
        let program = m(text);
        assert_eq!(program.findings, [], "{text}");
        let found: Vec<_> = (0..program.moves.len())
            .map(|k| tool_x(&program, k))
            .collect();
        assert_eq!(found, tools, "{text}");
    }
    for text in [
        "T1\nif a:\nT2\nend\nM",
        "T1\nwhile a:\nM\nT2\nend",
        "while a:\nM\nT1\nend",
        "set_tcp(tools[i])\nM",
        "h=1.5\nif a:\nh=2\nend\nset_tcp(p[h,0,0,0,0,0])\nM",
        "set_tcp(p[read_input_float_register(0),0,0,0,0,0])\nM",
        "q=p[0.2,0.2,0.2,0.2,0.2,0.2]\nmovel(q)\nset_tcp(p[q[0],0,0,0,0,0])\nM",
        "set_tcp(p[get_actual_tcp_pose()[0],0,0,0,0,0])\nM",
        "def sub():\nM\nend\nT1\nsub()\nT2\nsub()",
        "def sub():\nif a:\nT2\nreturn 1\nend\nT1\nend\nsub()\nM",
        "thread t():\nT2\nend\nT1\nrun t()\nM",
        "T1\nwhile a:\nif b:\nT2\ncontinue\nend\nM\nT1\nend",
    ] {
        let program = m(text);
        // one move for each of them; the tool that nobody names is one, too
        let mut found: Vec<_> = (0..program.moves.len())
            .map(|k| &program.tools[program.moves[k].tool])
            .map(|tool| {
                tool.flange_from_tool
                    .map(|pose| pose.translation[0].to_bits())
            })
            .collect();
        found.sort_unstable();
        found.dedup();
        let is_refused = ids(&program).contains(&"frame-chosen-at-run-time");
        assert!(found.len() == 2 || is_refused, "{text} {found:?}");
    }
}

#[test]
fn names_are_those_of_their_function() {
    let program = read(
        "def a():\nx=p[1,2,3,0,0,0]\nmovel(x)\nend\ndef b():\nlocal \
         x=p[1,2,3,0,0,1]\nmovel(x)\ndef c():\nmovel(x)\nend\nend\n",
    );
    assert_eq!(program.findings, []);
    assert_eq!(program.targets.len(), 2);
    assert_eq!(
        program
            .moves
            .iter()
            .map(|m| m.target.unwrap())
            .collect::<Vec<_>>(),
        [0, 1, 1]
    );
    let program =
        read("def a():\nglobal x=p[1,2,3,0,0,0]\nmovel(x)\nend\ndef b():\nx=p[1,2,3,0,0,1]\nend\n");
    // nothing calls b
    assert_eq!(ids(&program), ["target-unused-here"]);
}

#[test]
fn a_value_computed_from_a_target_is_a_warning() {
    let program = path("x=p[1,2,3,0,0,0]\nz=x[2]+0.1\nmovel(x)\ny=0.1+norm(x)");
    assert_eq!(ids(&program), ["target-copied"]);
    assert_eq!(program.findings[0].severity, Severity::Warning);
}

#[test]
fn broken_text_is_refused_with_its_place() {
    for (text, place, word) in [
        ("def a():\nmovel(p[1,2,3,0,0,0]\nend", (2, 6), "bracket"),
        ("def a():\nmovel(p[1,2,3,0,0,0)\nend", (2, 20), "`]`"),
        ("def a():\ntextmsg(\"x)\nend", (2, 9), "string"),
        ("def a():\nmovel(p[1,2,3,0,0,0])\n", (1, 1), "`def`"),
        ("movel(p[1,2,3,0,0,0])\nend\n", (2, 1), "end"),
        ("def a():\nelse:\nend\n", (2, 1), "else"),
        (
            "def a():\nmovel(p[1,2e999,3,0,0,0])\nend",
            (2, 11),
            "number",
        ),
        (
            "def a():\nmovel(p[1,-NaN,3,0,0,0])\nend",
            (2, 11),
            "not finite",
        ),
        (
            "def a():\nmovej([0,inf ,3,0,0,0])\nend",
            (2, 10),
            "not finite",
        ),
        ("def a:\nend", (1, 6), "bracket"),
        ("def a():\nx=1)\nend", (2, 4), "bracket"),
    ] {
        let error = read_file(text.as_bytes()).expect_err(text);
        let (_, line, column) = error.place();
        assert_eq!((line, column), place, "{text} {error}");
        assert!(error.to_string().contains(word), "{error}");
    }
    // a variable may have any name
    let named = path("inf = 0.4\nmovel(p[inf,2,3,0,0,0])\nmovel(p[infeed,2,3,0,0,0])");
    assert_eq!(
        ids(&named),
        ["target-has-expressions", "target-has-expressions"]
    );
    assert!(matches!(
        read_file(b"hello world"),
        Err(ReadError::NotThisLanguage { .. })
    ));
    assert!(matches!(read_file(b"def\0"), Err(ReadError::Binary { .. })));
}

#[test]
fn odd_bytes_and_line_ends_are_read() {
    for text in [
        &b"\xef\xbb\xbfdef m():\rmovel(p[1,2,3,0,0,0])\rend\r"[..],
        b" def m():\n\tmovel (p[1,2,3,0,0,0] ,a=1)\t# \xd6l\n  end\n\x1a",
        b"movel(p[1,2,3,0,0,0])",
        b"def m(): movel(p[1,2,3,0,0,0]) end",
        b"def m():\n gr\xf6\xdfe = p[1,2,3,0,0,0]; movel(gr\xf6\xdfe)\nend",
        b"sec m():\nmovel(p[+1,2.,3,-0.0,0,1E-4])\nend",
    ] {
        let program = read_file(text).expect("a program");
        assert_eq!((program.moves.len(), program.findings.len()), (1, 0));
        assert!(!program.targets[0].blocked);
        assert_eq!(Edits::default().apply(text), text);
    }
}

#[test]
fn the_marker_stands_behind_the_first_function_line() {
    let marker = Marker {
        version: "1".into(),
        profile_sha256: "a".into(),
        source_sha256: "b".into(),
        decided: Vec::new(),
    };
    for (text, before) in [
        (
            "# x\r\ndef m():\r\n  movel(p[1,2,3,0,0,0])\r\nend\r\n",
            "  movel",
        ),
        ("movel(p[1,2,3,0,0,0])\n", "movel"),
        ("def m(): movel(p[1,2,3,0,0,0]) end", "def"),
    ] {
        let source = Source::new("a", text.into());
        let (at, lines) = UrScript.mark(&source, &marker);
        assert!(source.bytes[at..].starts_with(before.as_bytes()), "{text}");
        assert!(lines.starts_with(b"  # ") && lines.ends_with(source.line_end()));
        let mut marked = source.bytes.clone();
        marked.splice(at..at, lines);
        assert_eq!(read_file(&marked).expect("a program").moves.len(), 1);
    }
}

#[test]
fn urscript_is_distinguished_from_other_text() {
    for text in [
        "def P():\n  set_tcp(p[0,0,0,0,0,0])\nend\n",
        " def P():\n  # c\n  movej([0,0,0,0,0,0])\n end\n",
        "movel(p[1,2,3,0,0,0])\n",
        "thread T():\n textmsg(\"a\")\nend",
        // libraries of poses
        "def getp():\n  return p[0.1,-0.2, 0.3,1.9,-2.4,0.4]\nend\n",
        "P1=p[0.1,-0.2,0.3,1.9,-2.4,0.4]\nglobal P2 = p[0.1,-0.2,0.3,1.9,-2.4,0.4]\n",
    ] {
        assert!(
            UrScript.recognises(&Source::new("a", text.into())),
            "{text}"
        );
    }
    // a function whose end is some megabytes behind
    let long = format!("def P():\n{}end\n", "  movej(q)\n".repeat(500_000));
    assert!(UrScript.recognises(&Source::new("a", long.into())));
    for text in [
        "import urx\ndef go():\n  movel(p)\nend\n",
        "def go():\n    robot.movel(p)\n",
        "def go(a)\n  movel(a)\nend\n",
        "MODULE m\nPROC a()\nMoveL p1,v5,z5,t;\nENDPROC\nENDMODULE",
        "/PROG A\n/MN\n",
        "DEF x()\nPTP HOME\nEND",
        "function movel(a)\nend",
        "def go():\n  return p[0,1]\nend\n",
        "",
    ] {
        assert!(
            !UrScript.recognises(&Source::new("a", text.into())),
            "{text}"
        );
    }
}
