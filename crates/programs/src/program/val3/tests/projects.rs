//! Which files, libraries and values belong together.

use super::*;

/// A project file that names data and a program, and one library.
pub(super) fn pjx(data: &str, library: &str) -> String {
    format!(
        "<Project xmlns=\"http://www.staubli.com/robotics/VAL3/Project/3\"><Parameters \
         millimeterUnit=\"true\" /><Programs><Program file=\"start.pgx\" /></Programs>\
         <Database><Data file=\"{data}\" /></Database><Libraries><Library alias=\"a\" \
         path=\"{library}\" /></Libraries></Project>"
    )
}

fn point(x: &str) -> String {
    dtx(&data("pA", "pointRx", &[&format!("key=\"0\" x=\"{x}\"")]))
}

#[test]
fn files_that_the_project_does_not_name_are_left_out() {
    let start = |x: &str| pgx("start", "", &format!("movej(pA[{x}],flange,m)"));
    let files = [
        ("m/m.pjx", pjx("m.dtx", "b")),
        ("m/m.dtx", point("1")),
        ("m/m_bak.dtx", point("2")),
        ("m/start.pgx", start("0")),
        ("m/start_old.pgx", start("7")),
    ];
    let program = read_files(&files).expect("a project");
    let found: Vec<_> = program.findings.iter().map(|f| (f.id, &*f.file)).collect();
    let left_out = "file-not-in-project";
    assert_eq!(
        found,
        [(left_out, "m/m_bak.dtx"), (left_out, "m/start_old.pgx")]
    );
    let files: Vec<u32> = program.targets.iter().map(|target| target.file).collect();
    assert_eq!(files, [1]);
}

#[test]
fn another_file_is_not_taken_for_one_that_the_project_names() {
    let start = || pgx("start", "", "movej(pA,flange,m)");
    let named = pjx("sub/real.dtx", "b");
    let files = [
        ("m/m.pjx", named.clone()),
        ("m/m.dtx", point("1")),
        ("m/start.pgx", start()),
    ];
    let program = read_files(&files).expect("a project");
    assert!(program.targets.is_empty());
    let missing = |file: &str| {
        let mut found = program.findings.iter();
        let found = found.find(|one| one.file == file && one.severity == Severity::Error);
        let found = found.expect("an error");
        (
            found.id,
            found.line,
            found.message.contains("m/sub/real.dtx"),
        )
    };
    assert_eq!(missing("m/m.pjx"), ("target-not-in-files", 1, true));
    // in the order of the files, whatever the case of their names
    let files = [
        ("m/start.pgx", start()),
        ("m/SUB/Real.dtx", point("1")),
        ("m/m.pjx", named),
        ("m/m.dtx", point("2")),
    ];
    let program = read_files(&files).expect("a project");
    assert_eq!(ids(&program), ["file-not-in-project"]);
    assert_eq!(program.targets.len(), 1);
    // so with programs
    let files = [
        ("m/m.pjx", pjx("m.dtx", "b")),
        ("m/m.dtx", point("1")),
        ("m/start_old.pgx", start()),
    ];
    let program = read_files(&files).expect("a project");
    let mut found = ids(&program);
    found.sort_unstable();
    assert_eq!(found, ["file-not-in-project", "target-not-in-files"]);
    assert!(program.moves.is_empty());
}

#[test]
fn tools_and_frames_are_asked_for_with_alias_and_index() {
    let points = [
        ("pA", "a:f[0]"),
        ("pB", "b:f[0]"),
        ("pC", "f[0]"),
        ("pD", "f[2]"),
        ("pE", "fA[3]"),
    ];
    let points: String = (points.iter())
        .map(|(name, father)| {
            let value = format!("key=\"0\" x=\"1\" fatherId=\"{father}\"");
            data(name, "pointRx", &[&value])
        })
        .collect();
    let program = project(
        &points,
        "movel(pA,a:t,m)\nmovel(pB,b:t,m)\nmovel(pC,t[0],m)\nmovel(pD,t[1],m)\nmovel(pE,t,m)\n\
         movel(pA,t[nI],m)",
    );
    let placed: Vec<_> = (program.moves.iter())
        .map(|m| (&*program.frames[m.frame].name, &*program.tools[m.tool].name))
        .take(5)
        .collect();
    assert_eq!(
        placed,
        [
            ("a:f", "a:t"),
            ("b:f", "b:t"),
            ("f", "t"),
            ("f[2]", "t[1]"),
            ("fA[3]", "t")
        ]
    );
    assert!(ids(&program).contains(&"frame-chosen-at-run-time"));
}

#[test]
fn names_that_are_declared_twice_are_refused() {
    let files = [
        ("m/a.dtx", point("1")),
        ("m/b.dtx", point("2")),
        ("m/start.pgx", pgx("start", "", "movej(pA,flange,m)")),
    ];
    let program = read_files(&files).expect("a project");
    let again = program.findings.iter();
    let again: Vec<_> = again
        .filter(|f| f.id == "target-name-ambiguous")
        .map(|f| (f.severity, &*f.file, f.line))
        .collect();
    assert_eq!(again, [(Severity::Error, "m/b.dtx", 3)]);
}

#[test]
fn a_library_is_the_one_of_its_own_cell() {
    let main = || pjx("Main.dtx", "../Rack/Rack.pjx");
    let rack = || pjx("Rack.dtx", "");
    let start = || pgx("start", "", "movej(a:pA,flange,m)");
    let files = [
        ("A/Main/Main.pjx", main()),
        ("A/Main/start.pgx", start()),
        ("A/Rack/Rack.pjx", rack()),
        ("A/Rack/Rack.dtx", point("1")),
        ("B/Main/Main.pjx", main()),
        ("B/Main/start.pgx", start()),
        ("B/Rack/Rack.pjx", rack()),
        ("B/Rack/Rack.dtx", point("2")),
    ];
    let program = read_files(&files).expect("two cells");
    let found: Vec<_> = (program.moves.iter())
        .map(|motion| (motion.file, program.target_of(motion).map(|of| of.file)))
        .collect();
    assert_eq!(found, [(1, Some(3)), (5, Some(7))]);
    // from elsewhere it may be either
    let files = [
        ("Main/Main.pjx", main()),
        ("Main/start.pgx", start()),
        ("A/Rack/Rack.pjx", rack()),
        ("A/Rack/Rack.dtx", point("1")),
        ("B/Rack/Rack.pjx", rack()),
        ("B/Rack/Rack.dtx", point("2")),
    ];
    let program = read_files(&files).expect("two cells");
    assert!(ids(&program).contains(&"target-not-in-files"));
}

#[test]
fn keys_of_several_numbers_may_have_blanks() {
    let points = data(
        "pL",
        "pointRx",
        &["key=\"0,0\" x=\"1\"", "key=\"0,1\" x=\"2\""],
    );
    let program = project(&points, "movel(pL[0, 1],tA,m)\nmovel(pL[ 0,0 ],tA,m)");
    let found: Vec<_> = program.moves.iter().map(|m| target(&program, m)).collect();
    assert_eq!(found, [Some("pL[0,1]"), Some("pL[0,0]")]);
}

#[test]
fn spare_points_of_an_array_are_reported_once() {
    let points = data(
        "pL",
        "pointRx",
        &[
            "key=\"0\" x=\"1\" fatherId=\"fA[0]\"",
            "key=\"1\" x=\"2\" fatherId=\"fA[0]\"",
            "key=\"2\" fatherId=\"fA[0]\"",
        ],
    );
    let program = project(&points, "movel(pL[nI],tA,m)\nmovej(pL[nI],tA,m)");
    let untaught = |program: &Program| -> Vec<Severity> {
        let all = program.findings.iter();
        let all = all.filter(|f| f.id == "target-uninitialised");
        all.map(|f| f.severity).collect()
    };
    assert_eq!(untaught(&program), [Severity::Warning]);
    assert_eq!(program.moves.len(), 4);
    // the one alone stays an error
    let program = project(&points, "movel(pL[2],tA,m)");
    assert_eq!(untaught(&program), [Severity::Error]);
}
