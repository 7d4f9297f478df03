//! What projects mean.

use super::*;
use crate::finding::Severity;
use crate::geometry::Convention;
use crate::geometry::units::DEG;
use crate::program::{Displacement, Motion, Move, Program, Shift, Stride, Value};

mod arrays;
mod calls;
mod deciding;
mod inserted;
mod numbers;
mod projects;
mod robust;
mod written;

/// A data file of these declarations.
fn dtx(data: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Database \
         xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
         xmlns=\"http://www.staubli.com/robotics/VAL3/Data/2\"><Datas>\n{data}</Datas></Database>"
    )
}

fn data(name: &str, kind: &str, values: &[&str]) -> String {
    let values: String = values.iter().map(|v| format!("<Value {v} />\n")).collect();
    format!(
        "<Data name=\"{name}\" access=\"private\" xsi:type=\"array\" type=\"{kind}\" \
         size=\"9\">\n{values}</Data>\n"
    )
}

fn pgx(name: &str, more: &str, code: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Programs \
         xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">\
         <Program name=\"{name}\" access=\"public\">{more}<Code><![CDATA[begin\n{code}\nend]]></Code></Program></Programs>"
    )
}

fn read_files(files: &[(&str, String)]) -> Result<Program, ReadError> {
    let source = |(name, text): &(&str, String)| Source::new(*name, text.as_bytes().to_vec());
    let sources: Vec<_> = files.iter().map(source).collect();
    crate::motion::read(&Val3, &sources, &Settings::default())
}

const FRAME: &str = "key=\"0\" x=\"100\" rz=\"90\" fatherId=\"world[0]\"";
const TOOL: &str = "key=\"0\" z=\"120\" fatherId=\"flange[0]\"";

/// Points of a project, and its code.
fn project(points: &str, code: &str) -> Program {
    let all = data("fA", "frame", &[FRAME]) + &data("tA", "tool", &[TOOL]) + points;
    read_files(&[
        ("m/m.dtx", dtx(&all)),
        ("m/start.pgx", pgx("start", "", code)),
    ])
    .expect("a project")
}

fn ids(program: &Program) -> Vec<&str> {
    program.findings.iter().map(|f| f.id).collect()
}

fn target<'p>(program: &'p Program, motion: &Move) -> Option<&'p str> {
    program.target_of(motion).and_then(|t| t.name.as_deref())
}

#[test]
fn numbers_that_are_left_out_are_zero_and_have_their_place() {
    let text = dtx(&data(
        "pA",
        "pointRx",
        &["key=\"0\" y=\"2.5\" rx=\"180\" elbow=\"enegative\" fatherId=\"fA[0]\""],
    ));
    let code = pgx("start", "", "movej(pA,flange,m)");
    let program = read_files(&[("m.dtx", text.clone()), ("start.pgx", code)]).expect("a project");
    let found = program.numbers_of(&program.targets[0]);
    let values: Vec<f64> = found.iter().map(|n| n.value).collect();
    assert_eq!(values, [0.0, 2.5, 0.0, 180.0, 0.0, 0.0, 1.0]);
    // what would be put in stands behind what comes before it in the format
    let mut whole = text.clone();
    for (index, number) in found.iter().enumerate().rev() {
        if number.length == 0 {
            let (before, behind) = Val3.around_missing(program.targets[0].layout, index);
            whole.insert_str(number.start as usize, &format!("{before}0{behind}"));
        }
    }
    assert!(
        whole.contains(
            "key=\"0\" x=\"0\" y=\"2.5\" z=\"0\" rx=\"180\" ry=\"0\" rz=\"0\" elbow=\"enegative\" \
             fatherId"
        ),
        "{whole}"
    );
    let meant = crate::program::meaning(&Val3, &program, &Settings::default(), 0).expect("numbers");
    assert_eq!(meant.configuration.kept, [true, false, true]);
    assert_eq!(
        meant.configuration.joints[2],
        Some((f64::NEG_INFINITY, 0.0))
    );
}

#[test]
fn angles_turn_about_the_axes_that_the_one_before_has_turned() {
    // rx turns last about the fixed axes: z of the tool goes to -y, whatever rz
    let z = pose_of([0.0, 0.0, 0.0, 90.0, 0.0, 33.0]).rotation * [0.0, 0.0, 1.0];
    assert!((z[1] + 1.0).abs() < 1e-12, "{z:?}");
    // as the pendant shows it
    let rotation = pose_of([0.0, 0.0, 0.0, 20.0, 40.0, -70.0]).rotation;
    let shown = Convention::Staubli.numbers(&rotation);
    assert!(
        shown
            .iter()
            .zip([20.0, 40.0, -70.0])
            .all(|(a, b)| (a - b).abs() < 1e-9)
    );
    for numbers in [
        [1.0, 2.0, 3.0, -176.2, -20.2, 174.3],
        [1.0, 2.0, 3.0, 25.0, 90.0, 0.0],
        [1.0, 2.0, 3.0, 25.0, -90.0, 40.0],
        [0.0, 0.0, 0.0, 200.0, 12.0, -350.0],
    ] {
        let mut written = numbers;
        notation::write_turning_angles(&pose_of(numbers), &mut written);
        let gap = (0..6).map(|i| (written[i] - numbers[i]).abs());
        assert!(gap.fold(0.0, f64::max) < 1e-6, "{numbers:?} {written:?}");
    }
}

#[test]
fn frames_hang_on_fathers_and_tools_on_tools() {
    let points = data("fB", "frame", &["key=\"0\" y=\"10\" fatherId=\"fA[0]\""])
        + &data("tB", "tool", &["key=\"0\" x=\"5\" fatherId=\"tA[0]\""])
        + &data(
            "pA",
            "pointRx",
            &["key=\"0\" x=\"1\" fatherId=\"fB[0]\"", "key=\"1\" x=\"2\""],
        );
    let program = project(
        &points,
        "movej(pA,tB,m)\nmovel(pA[1],flange[0],m)\nmovel(pA[1],tC,m)",
    );
    let placed: Vec<_> = program
        .moves
        .iter()
        .map(|m| (&program.frames[m.frame], &program.tools[m.tool]))
        .collect();
    let at = placed[0].0.world_from_frame.expect("known").translation;
    assert!(
        (at[0] - 0.09).abs() < 1e-12 && at[1].abs() < 1e-12,
        "{at:?}"
    );
    let tip = placed[0].1.flange_from_tool.expect("known").translation;
    assert_eq!(tip, [0.005, 0.0, 0.12]);
    assert_eq!(placed[1].0.name, "world");
    assert_eq!(placed[1].1.name, "flange");
    assert_eq!(
        (placed[2].1.name.as_str(), placed[2].1.flange_from_tool),
        ("tC", None)
    );
}

#[test]
fn approaches_are_displaced_and_others_are_reported() {
    let points = data("trA", "trsf", &["key=\"0\" z=\"-50\""])
        + &data("trB", "trsf", &["key=\"0\" z=\"-50\""])
        + &data("pA", "pointRx", &["key=\"0\" x=\"1\" fatherId=\"fA[0]\""]);
    let program = project(
        &points,
        "trB.z=nUp\nmovej(appro(pA,trA),tA,m)\nmovel(appro(pA,{0,-1.5,0,0,0,0}),tA,m)\nmovel(appro(pA,trB),tA,m)\n\
         movel(compose(pA,fA,{0,7,0,0,0,0}),tA,m)\nmovel(compose(pA,world,{0,7,0,0,0,0}),tA,m)",
    );
    let shifts: Vec<_> = program
        .moves
        .iter()
        .map(|m| match &m.displacement {
            Displacement::By(by) => Some((by.in_frame.translation, by.in_tool.translation)),
            _ => None,
        })
        .collect();
    assert_eq!(shifts[0], Some(([0.0; 3], [0.0, 0.0, -0.05])));
    assert_eq!(shifts[1], Some(([0.0; 3], [0.0, -0.0015, 0.0])));
    assert_eq!(shifts[2], None);
    assert_eq!(shifts[3], Some(([0.0, 0.007, 0.0], [0.0; 3])));
    // y of the world is x of a frame that is rotated by a quarter
    let (in_frame, _) = shifts[4].expect("both are known");
    assert!((in_frame[0] - 0.007).abs() < 1e-12 && in_frame[1].abs() < 1e-12);
}

#[test]
fn a_number_of_the_text_displaces_by_what_it_says() {
    let points = data("pA", "pointRx", &["key=\"0\" x=\"1\" fatherId=\"fA[0]\""])
        + &data("pB", "pointRx", &["key=\"0\" x=\"2\" fatherId=\"fA[0]\""]);
    let by = |line: &str| {
        let code = format!("pB=pA\n{line}\nmovel(pB,tA,m)");
        project(&points, &code).moves[0].displacement.clone()
    };
    let along = |by| Displacement::By(Box::new(Shift::along(by)));
    for (line, wanted) in [
        ("pB.trsf.z=pB.trsf.z+200", along([0.0, 0.0, 0.2])),
        (
            "pB.trsf.x = 10 + pB.trsf.x\npB.trsf.z=pB.trsf.z-20",
            along([0.01, 0.0, -0.02]),
        ),
        ("pB.trsf.z=pA.trsf.z+200", along([0.0, 0.0, 0.2])),
        ("pB.trsf.z=pA.trsf.x+200", Displacement::Overwritten),
        ("pB.trsf.z=nZ", Displacement::Overwritten),
        (
            "pB.trsf.rx=pB.trsf.rx+20",
            Displacement::Within(Box::new([Stride::Turned(Some(20_f64.to_radians()))])),
        ),
        ("pB.trsf.z=pB.trsf.z+nZ", Displacement::Unknown),
    ] {
        assert_eq!(by(line), wanted, "{line}");
    }
}

#[test]
fn moves_are_found_in_statements_and_not_in_comments_or_texts() {
    let points = data(
        "pA",
        "pointRx",
        &[
            "key=\"0\" x=\"1\" fatherId=\"fA[0]\"",
            "key=\"1\" x=\"2\" fatherId=\"fA[0]\"",
        ],
    ) + &data("jA", "jointRx", &["key=\"0\" j3=\"90\""])
        + &data(
            "m",
            "mdesc",
            &["key=\"0\" tmax=\"250\" blend=\"joint\" leave=\"5\" reach=\"5\""],
        );
    let program = project(
        &points,
        "nId=movej(jA,tA,m)\n//movel(pA,tA,m)\nputln(\"movel(pA,tA,m)\")\nmovec(pA[1],pA,tA,m)\n$movejSync(pA,tA,m)\nalterMovel(pA,tA,m)",
    );
    let found: Vec<_> = program
        .moves
        .iter()
        .map(|m| (m.motion, target(&program, m)))
        .collect();
    assert_eq!(
        found,
        [
            (Motion::Joint, Some("jA")),
            (Motion::ArcVia, Some("pA[1]")),
            (Motion::ArcEnd, Some("pA[0]")),
            (Motion::Joint, None),
            (Motion::Linear, Some("pA[0]")),
        ]
    );
    assert_eq!(ids(&program), ["move-not-supported", "corrected-by-sensor"]);
    let zone = program.speed_zone(&program.moves[0]);
    assert_eq!((zone.speed_m_s, zone.zone_m), (Some(0.25), Some(0.005)));
}

#[test]
fn joints_written_out_are_targets_of_joint_moves() {
    let joints = data("jA", "jointRx", &["key=\"0\" j3=\"90\""]);
    let program = project(
        &joints,
        "movej({0,-20.5,+110, 0 ,90,-0},tA,m)\njA={1,2,3,4,5,6}\nmovej(jA,tA,m)\nmovej({0,1,2,3,4,nA},tA,m)\nmovel({0,1,2,3,4,5},tA,m)",
    );
    let values: Vec<Option<Vec<f64>>> = (program.moves.iter())
        .map(|motion| {
            let target = program.target_of(motion)?;
            Some(program.numbers_of(target).iter().map(|n| n.value).collect())
        })
        .collect();
    let known = |values: [f64; 6]| Some(values.to_vec());
    assert_eq!(
        values,
        [
            known([0.0, -20.5, 110.0, 0.0, 90.0, 0.0]),
            known([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
            None,
            None
        ]
    );
}

#[test]
fn points_are_followed_through_parameters_and_copies() {
    let points = data("pA", "pointRx", &["key=\"0\" x=\"1\" fatherId=\"fA[0]\""])
        + &data("pB", "pointRx", &["key=\"0\" x=\"2\" fatherId=\"fA[0]\""])
        + &data("pD", "pointRx", &[]);
    let all = data("fA", "frame", &[FRAME])
        + &data("tA", "tool", &[TOOL])
        + &data("tNow", "tool", &[])
        + &points;
    let parameter = "<Parameters><Parameter name=\"x_p\" type=\"pointRx\" use=\"value\" \
        xsi:type=\"element\" /></Parameters>";
    let files = |code: &str| {
        [
            ("m.dtx", dtx(&all)),
            ("start.pgx", pgx("start", "", code)),
            ("go.pgx", pgx("go", parameter, "movel(x_p,tNow,m)")),
        ]
    };
    let program =
        read_files(&files("tNow=tA\ncall go(pA)\npD=pB\nmovel(pD,tA,m)")).expect("a project");
    let mut found: Vec<_> = program
        .moves
        .iter()
        .map(|m| {
            (
                target(&program, m),
                program.frames[m.frame].name.as_str(),
                program.tools[m.tool].name.as_str(),
            )
        })
        .collect();
    found.sort_unstable();
    assert_eq!(found, [(Some("pA"), "fA", "tA"), (Some("pB"), "fA", "tA")]);
}

#[test]
fn what_the_running_program_changes_is_refused_or_reported() {
    let points = data(
        "pA",
        "pointRx",
        &[
            "key=\"0\" x=\"1\" fatherId=\"fA[0]\"",
            "key=\"1\" x=\"2\" fatherId=\"fA[0]\"",
        ],
    ) + &data("pNo", "pointRx", &["key=\"0\" fatherId=\"fA[0]\""])
        + &data("jNo", "jointRx", &[])
        + &data("pRs", "pointRs", &["key=\"0\" x=\"1\""]);
    for (code, expected) in [
        ("fA.trsf.z=nZ\nmovel(pA,tA,m)", "frame-assigned-at-run-time"),
        (
            "setFrame(pA,pA,pA,fA)\nmovel(pA,tA,m)",
            "frame-assigned-at-run-time",
        ),
        (
            "tA.trsf=tA.trsf*{0,0,nL,0,0,0}\nmovel(pA,tA,m)",
            "frame-assigned-at-run-time",
        ),
        ("movel(pA,tA.other,m)", "frame-chosen-at-run-time"),
        (
            "pA.trsf.x=nX\nmovel(pA,tA,m)",
            "target-assigned-at-run-time",
        ),
        ("movel(l_p,tA,m)", "target-not-in-files"),
        ("movel(lib:pA,tA,m)", "target-not-in-files"),
        ("movel(pNo,tA,m)", "target-uninitialised"),
        ("movej(jNo,tA,m)", "joint-target-not-in-files"),
        ("movel(pRs,tA,m)", "target-not-six-axes"),
        ("lib:libLoad(sName)\nmovel(pA,tA,m)", "library-at-run-time"),
        (
            "pNo=jointToPoint(tA,fA,j)\nmovel(pNo,tA,m)",
            "computed-target",
        ),
    ] {
        let program = project(&points, code);
        assert!(
            ids(&program).contains(&expected),
            "{code}: {:?}",
            program.findings
        );
    }
    // where the robot itself stood is right
    let program = project(&points, "pNo=here(tA,fA)\nmovel(pNo,tA,m)");
    assert!(ids(&program).contains(&"run-time-position"));
    // as a pose of the flange it is not where the tool goes
    let program = project(&points, "pNo=here(flange,world)\nmovel(pNo,tA,m)");
    assert!(ids(&program).contains(&"computed-target"));
    // any element of one frame
    let program = project(&points, "movel(pA[nIndex],tA,m)");
    assert_eq!(program.moves.len(), 2);
    assert!(
        program
            .findings
            .iter()
            .all(|f| f.severity != Severity::Error)
    );
}

#[test]
fn coordinates_in_capitals_and_seventh_joints_are_errors() {
    for (kind, value, said) in [
        ("pointRx", "key=\"0\" X=\"60\" z=\"80\"", "in small letters"),
        ("jointRx", "key=\"0\" J5=\"60\"", "in small letters"),
        ("jointRx", "key=\"0\" j1=\"1\" j7=\"5\"", "six joints"),
    ] {
        let all = data("fA", "frame", &[FRAME]) + &data("pA", kind, &[value]);
        let start = ("m/start.pgx", pgx("start", "", "movej(pA,flange,m)"));
        let error = read_files(&[("m/m.dtx", dtx(&all)), start]).expect_err(value);
        assert!(error.to_string().contains(said), "{error}");
    }
}

#[test]
fn a_change_of_a_frame_is_named_where_it_stands() {
    let points = data("pA", "pointRx", &["key=\"0\" x=\"1\" fatherId=\"fB[0]\""])
        + &data("fB", "frame", &["key=\"0\" fatherId=\"fA[0]\""])
        + &data("tB", "tool", &["key=\"0\" fatherId=\"tA[0]\""]);
    for change in [
        "fA.trsf.x=610",
        "link(fB,fA)",
        "setFrame(pA,pA,pA,fA)",
        "tA.trsf.z=100",
    ] {
        let program = project(
            &points,
            &format!("movej(jR,tB,m)\n{change}\nmovel(pA,tB,m)"),
        );
        let found = program.findings.iter();
        let mut found = found.filter(|found| found.id == "frame-assigned-at-run-time");
        let message = &found.next().expect("refused").message;
        assert!(message.contains("(m/start.pgx line 4)"), "{message}");
    }
}

#[test]
fn a_point_that_is_hung_elsewhere_is_named() {
    let points = data("pA", "pointRx", &["key=\"0\" x=\"1\" fatherId=\"fA[0]\""])
        + &data("pB", "pointRx", &["key=\"0\" x=\"2\" fatherId=\"fA[0]\""])
        + &data("fB", "frame", &["key=\"0\" z=\"9\""]);
    let program = project(&points, "link(pA,fB)\nmovej(pA,tA,m)\nmovel(pB,tA,m)");
    let [only] = &program.findings[..] else {
        panic!("{:?}", program.findings);
    };
    assert_eq!(only.id, "target-assigned-at-run-time");
    assert!(only.message.starts_with("`pA`") || only.message.starts_with("pA"));
    assert!(only.message.contains("line 3"), "{}", only.message);
    // the correction of a copy is that of another place then
    let program = project(
        &points,
        "pB=pA\nlink(pB,fB)\nmovej(pB,tA,m)\nmovel(pA,tA,m)",
    );
    assert_eq!(program.moves[0].displacement, Displacement::Unbounded);
}

#[test]
fn fathers_in_a_circle_are_reported_as_that() {
    let points = data("pA", "pointRx", &["key=\"0\" x=\"1\" fatherId=\"fB[0]\""])
        + &data("fB", "frame", &["key=\"0\" fatherId=\"fC[0]\""])
        + &data("fC", "frame", &["key=\"0\" fatherId=\"fB[0]\""]);
    let program = project(&points, "movel(pA,tA,m)");
    let found = program
        .findings
        .iter()
        .find(|found| found.id == "frame-unknown");
    let message = &found.expect("refused").message;
    assert!(message.contains("lead back to it"), "{message}");
}

#[test]
fn libraries_are_found_by_their_paths() {
    let pjx = "<Project xmlns=\"http://www.staubli.com/robotics/VAL3/Project/3\"><Parameters \
        millimeterUnit=\"true\" />\
        <Programs><Program file=\"start.pgx\" /></Programs><Libraries><Library alias=\"a\" \
            path=\"Disk://Rack/Rack.pjx\" /></Libraries></Project>";
    let rack = "<Project xmlns=\"http://www.staubli.com/robotics/VAL3/Project/3\"><Parameters \
        millimeterUnit=\"true\" />\
        <Database><Data file=\"Rack.dtx\" /></Database></Project>";
    let points = dtx(&data("pA", "pointRx", &["key=\"0\" x=\"1\""]));
    let code = pgx(
        "start",
        "",
        "a:libLoad(\"Disk://Rack\")\nmovej(a:pA[0],flange,m)",
    );
    let files = [
        ("c/Main/Main.pjx", pjx.to_owned()),
        ("c/Main/start.pgx", code),
        ("c/Rack/Rack.pjx", rack.to_owned()),
        ("c/Rack/Rack.dtx", points),
    ];
    let program = read_files(&files).expect("a project");
    assert_eq!(target(&program, &program.moves[0]), Some("pA"));
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
    for unit in ["false", " false ", "FALSE", "0", ""] {
        let inches = [("m.pjx", pjx.replace("\"true\"", &format!("\"{unit}\"")))];
        let error = read_files(&inches).expect_err(unit).to_string();
        assert!(
            error.contains("millimeterUnit") && error.contains(":1:"),
            "{error}"
        );
    }
}

#[test]
fn a_file_that_two_projects_name_is_refused() {
    let pjx = "<Project xmlns=\"http://www.staubli.com/robotics/VAL3/Project/3\"><Parameters \
        millimeterUnit=\"true\" /><Programs><Program file=\"start.pgx\" /></Programs></Project>";
    let code = pgx("start", "", "delay(1)");
    let one = ("c/cell.pjx", pjx.to_owned());
    let other = ("c/old.pjx", pjx.to_owned());
    let start = ("c/start.pgx", code);
    assert!(read_files(&[one.clone(), start.clone()]).is_ok());
    let error = read_files(&[one, other, start]).expect_err("two projects");
    let error = error.to_string();
    assert!(error.contains("another project names it"), "{error}");
}

#[test]
fn sides_change_where_their_joint_truly_crosses() {
    let layout = Layout {
        shape: Shape::Pose,
        variant: 0b111,
    };
    let posture = |degrees: [f64; 6]| Posture {
        joints_rad: degrees.map(|d| d * DEG),
        behind_axis_1: false,
        behind_lower_arm: false,
    };
    let before = posture([0.0, 30.0, 80.0, 0.0, 0.05, 0.0]);
    let after = posture([0.0, 30.0, 80.0, 0.0, -0.05, 0.0]);
    let mut numbers = [0.0; 9];
    Val3.update_configuration(layout, &before, &after, &mut numbers);
    assert_eq!(numbers[6..], [0.0, 0.0, 1.0]);
    for (value, old, new) in [(1.0, "wpositive", "wnegative"), (0.0, "righty", "lefty")] {
        let mut out = Vec::new();
        Val3.write_configuration(layout, 6, value, old.as_bytes(), &mut out);
        assert_eq!(out, new.as_bytes());
    }
    let value = Val3.decode(layout, &numbers, &Settings::default());
    assert!(matches!(value.value, Value::Pose(_)));
    assert_eq!(value.configuration.behind_axis_1, Some(false));
}
