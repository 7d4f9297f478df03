//! Arrays and points that programs are given.

use super::*;

const REFERENCE: &str = "type=\"pointRx\" xsi:type=\"array\" use=\"reference\"";

fn parameter(name: &str, attributes: &str) -> String {
    format!("<Parameters><Parameter name=\"{name}\" {attributes} /></Parameters>")
}

/// A project with `count` points in `pA`, tools `tA` and `tB`, and a program `sub(x_p)`.
fn given(count: usize, start: &str, attributes: &str, sub: &str) -> Program {
    let points: Vec<String> = (0..count)
        .map(|at| format!("key=\"{at}\" x=\"{at}.5\" fatherId=\"fA[0]\""))
        .collect();
    let points: Vec<&str> = points.iter().map(String::as_str).collect();
    let all = data("fA", "frame", &[FRAME])
        + &data("tA", "tool", &[TOOL])
        + &data("tB", "tool", &[TOOL])
        + &data("pA", "pointRx", &points);
    let deeper = parameter("y_p", attributes);
    read_files(&[
        ("m/m.dtx", dtx(&all)),
        ("m/start.pgx", pgx("start", "", start)),
        ("m/sub.pgx", pgx("sub", &parameter("x_p", attributes), sub)),
        ("m/sub2.pgx", pgx("sub2", &deeper, "movel(y_p[2],tB,m)")),
    ])
    .expect("a project")
}

/// The targets and tools of the moves that have a target.
fn moves(program: &Program) -> Vec<(&str, &str)> {
    let known = program.moves.iter().filter_map(|motion| {
        let tool = program.tools[motion.tool].name.as_str();
        Some((target(program, motion)?, tool))
    });
    known.collect()
}

fn refused(program: &Program) -> Vec<&str> {
    let refused = program.targets.iter().filter(|target| target.blocked);
    refused
        .filter_map(|target| target.name.as_deref())
        .collect()
}

#[test]
fn elements_of_an_array_are_those_of_the_call() {
    let start = "movel(pA[1],tA,m)\ncall sub(pA)";
    let by_value = REFERENCE.replace("reference", "value");
    for attributes in [REFERENCE, &*by_value] {
        let program = given(3, start, attributes, "movel(x_p[1],tB,m)");
        assert_eq!(moves(&program), [("pA[1]", "tA"), ("pA[1]", "tB")]);
        let mut found = program.findings.iter();
        assert!(!found.any(|found| found.severity == Severity::Error));
    }
    let program = given(3, start, REFERENCE, "movel(x_p[nI],tB,m)");
    let all = [
        ("pA[1]", "tA"),
        ("pA[0]", "tB"),
        ("pA[1]", "tB"),
        ("pA[2]", "tB"),
    ];
    assert_eq!(moves(&program), all);
    let program = given(3, start, REFERENCE, "call sub2(x_p)");
    assert_eq!(moves(&program), [("pA[1]", "tA"), ("pA[2]", "tB")]);
}

#[test]
fn what_a_program_writes_into_an_array_comes_back() {
    let start = "call sub(pA)\nmovel(pA[1],tA,m)\nmovel(pA[2],tA,m)";
    let program = given(3, start, REFERENCE, "x_p[1].trsf.z=5");
    assert!(refused(&program).contains(&"pA[1]"));
    assert_eq!(moves(&program), [("pA[2]", "tA")]);
    let program = given(3, start, REFERENCE, "x_p[1]=x_p[0]");
    assert_eq!(moves(&program)[0], ("pA[0]", "tA"));
    let by_value = REFERENCE.replace("reference", "value");
    let program = given(3, start, &by_value, "x_p[1].trsf.z=5");
    assert!(!refused(&program).contains(&"pA[1]"));
}

#[test]
fn arrays_that_are_not_followed_are_refused() {
    let passed = "target-passed-to-routine";
    for (count, start) in [
        (33, "movel(pA[1],tA,m)\ncall sub(pA)"),
        (3, "movel(pA[1],tA,m)\ncall sub(pA[1])"),
        (3, "movel(pA[1],tA,m)\ncall other:doit(pA)"),
        (
            3,
            "movel(pA[1],tA,m)\ncall other:doit(appro(pA[1],{0,0,-10,0,0,0}))",
        ),
        (33, "movel(pA[1],tA,m)\ncall other:doit(pA)"),
    ] {
        let program = given(count, start, REFERENCE, "movel(x_p[1],tB,m)");
        assert!(
            ids(&program).contains(&passed),
            "{start}: {:?}",
            program.findings
        );
        assert!(refused(&program).contains(&"pA[1]"), "{start}");
    }
}

#[test]
fn own_arrays_are_reached_by_unknown_numbers() {
    let local = "<Locals><Local name=\"l_p\" type=\"pointRx\" xsi:type=\"array\" size=\"2\" \
         /></Locals>";
    let code = "l_p[0]=pA[0]\nl_p[1]=pA[1]\nmovel(l_p[nI],tA,m)";
    let points = data(
        "pA",
        "pointRx",
        &[
            "key=\"0\" x=\"1\" fatherId=\"fA[0]\"",
            "key=\"1\" x=\"2\" fatherId=\"fA[0]\"",
        ],
    );
    let all = data("fA", "frame", &[FRAME]) + &data("tA", "tool", &[TOOL]) + &points;
    let files = [
        ("m/m.dtx", dtx(&all)),
        ("m/start.pgx", pgx("start", local, code)),
    ];
    let program = read_files(&files).expect("a project");
    assert_eq!(moves(&program), [("pA[0]", "tA"), ("pA[1]", "tA")]);
}

#[test]
fn a_parameter_is_composed_in_the_frame_of_what_it_is_given() {
    let attributes = "type=\"pointRx\" xsi:type=\"element\" use=\"value\"";
    let by = |frame: &str| {
        let sub = format!("movel(compose(x_p,{frame},{{0,300,0,0,0,0}}),tA,m)");
        let program = given(2, "call sub(pA[1])", attributes, &sub);
        assert_eq!(moves(&program), [("pA[1]", "tA")]);
        let Displacement::By(by) = &program.moves[0].displacement else {
            panic!("{:?}", program.moves[0].displacement);
        };
        by.in_frame.translation
    };
    assert_eq!(by("fA"), [0.0, 0.3, 0.0]);
    // y of the world is x of a frame that is rotated by a quarter
    let [x, y, _] = by("world");
    assert!((x - 0.3).abs() < 1e-12 && y.abs() < 1e-12);
}

/// Targets that moves go to in a project with points `pA[0]`, `pA[1]` and arrays of which `values`
/// are taught.
fn gone_to(values: &[&str], start: &str, fill: (&str, &str)) -> (Vec<String>, Vec<&'static str>) {
    let point = |key: u32| format!("key=\"{key}\" x=\"{key}.5\" fatherId=\"fA[0]\"");
    let all = data("fA", "frame", &[FRAME])
        + &data("tA", "tool", &[TOOL])
        + &data("pA", "pointRx", &[&point(0), &point(1)])
        + &data("pV", "pointRx", values);
    let program = read_files(&[
        ("m/m.dtx", dtx(&all)),
        ("m/start.pgx", pgx("start", "", start)),
        ("m/fill.pgx", pgx(fill.0, "", fill.1)),
    ]);
    let program = program.expect("a project");
    let mut names: Vec<String> = moves(&program)
        .iter()
        .map(|(name, _)| (*name).to_owned())
        .collect();
    names.sort_unstable();
    names.dedup();
    (names, program.findings.iter().map(|f| f.id).collect())
}

#[test]
fn an_array_without_values_is_what_programs_write_into_it() {
    let start = "for nI=0 to 1\npV[nI]=pA[nI]\nendFor\nmovel(pV[nI],tA,m)";
    let (names, said) = gone_to(&[], start, ("none", ""));
    assert_eq!(names, ["pA[0]", "pA[1]"]);
    assert!(said.contains(&"computed-target"), "{said:?}");
}

#[test]
fn a_value_that_a_program_further_down_writes_is_gone_to_as_well() {
    let taught = "key=\"0\" x=\"7\" fatherId=\"fA[0]\"";
    for name in ["afill", "zfill"] {
        let start = format!("call {name}()\nmovel(pV[nI],tA,m)");
        let (names, _) = gone_to(&[taught], &start, (name, "pV[1]=pA[1]"));
        assert_eq!(names, ["pA[1]", "pV"], "{name}");
    }
}

#[test]
fn an_array_that_a_loop_fills_may_be_gone_to() {
    let spare = ["key=\"0\"", "key=\"1\"", "key=\"2\""];
    let points = data("pX", "pointRx", &spare)
        + &data("nI", "num", &["key=\"0\" value=\"0\""])
        + &data("pB", "pointRx", &["key=\"0\" x=\"9\" fatherId=\"fA[0]\""]);
    let said = |code: &str| -> Vec<(Severity, bool)> {
        let program = project(&points, code);
        let found = program.findings.iter();
        let found = found.filter(|found| found.id == "target-uninitialised");
        let each = found.map(|found| (found.severity, found.message.contains("(p.trsf=…)")));
        each.collect()
    };
    let fill = "for nI=0 to 2\npX[nI]=appro(pB,{0,0,nI,0,0,0})\nendFor";
    for go in ["movel(pX[1],tA,m)", "movel(pX[nI],tA,m)"] {
        let found = said(&format!("{fill}\n{go}"));
        assert_eq!(found, [(Severity::Warning, false)], "{go}");
    }
    let parts = said("for nI=0 to 2\npX[nI].trsf=pB.trsf\nendFor\nmovel(pX[1],tA,m)");
    assert_eq!(parts, [(Severity::Error, true)]);
    assert_eq!(said("movel(pX[1],tA,m)"), [(Severity::Error, false)]);
}
