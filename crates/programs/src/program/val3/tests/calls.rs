//! What calls hand over: points with their frames, numbers that choose a branch.

use super::*;

fn parameter(name: &str, kind: &str, usage: &str) -> String {
    format!(
        "<Parameters><Parameter name=\"{name}\" type=\"{kind}\" use=\"{usage}\" \
         xsi:type=\"element\" /></Parameters>"
    )
}

/// A project with `pA` in `fA`, `pW` in the world, untaught `pX`, tools `tA` and `tB`, and these
/// programs.
fn programs(all: &[(&str, &str, &str)]) -> Program {
    let point = |x: u32, father: &str| format!("key=\"0\" x=\"{x}.5\" fatherId=\"{father}\"");
    let data = data("fA", "frame", &[FRAME])
        + &data("tA", "tool", &[TOOL])
        + &data("tB", "tool", &[&TOOL.replace("120", "80")])
        + &data("tNow", "tool", &[])
        + &data("nX", "num", &["key=\"0\" value=\"1\""])
        + &data("pA", "pointRx", &[&point(1, "fA[0]")])
        + &data("pW", "pointRx", &[&point(2, "world[0]")])
        + &data("pX", "pointRx", &[]);
    let mut files = vec![("m/m.dtx".to_owned(), dtx(&data))];
    for (name, more, code) in all {
        files.push((format!("m/{name}.pgx"), pgx(name, more, code)));
    }
    let files: Vec<(&str, String)> = files.iter().map(|(n, t)| (n.as_str(), t.clone())).collect();
    read_files(&files).expect("a project")
}

/// Targets, frames and tools of the moves that have a target.
fn placed(program: &Program) -> Vec<(&str, &str, &str)> {
    let known = program.moves.iter().filter_map(|m| {
        let (frame, tool) = (&program.frames[m.frame], &program.tools[m.tool]);
        Some((target(program, m)?, &*frame.name, &*tool.name))
    });
    let mut known: Vec<_> = known.collect();
    known.sort_unstable();
    known
}

fn errors(program: &Program) -> Vec<&str> {
    let all = program.findings.iter();
    let errors = all.filter(|found| found.severity == Severity::Error);
    errors.map(|found| found.id).collect()
}

#[test]
fn a_point_keeps_its_frame_wherever_it_is_handed() {
    let expected = [("pA", "fA", "tA"), ("pW", "world", "tA")];
    let value = parameter("x_p", "pointRx", "value");
    let reference = parameter("x_p", "pointRx", "reference");
    let local = "<Locals><Local name=\"l_p\" type=\"pointRx\" xsi:type=\"element\" /></Locals>";
    let go = ("go", &*value, "movel(x_p,tA,m)");
    let get = ("get", &*reference, "x_p=pW");
    for all in [
        vec![("start", "", "call go(pA)\ncall go(pW)"), go],
        vec![(
            "start",
            local,
            "l_p=pA\nmovel(l_p,tA,m)\nl_p=pW\nmovel(l_p,tA,m)",
        )],
        vec![
            (
                "start",
                "",
                "pX=pA\nmovel(pX,tA,m)\ncall get(pX)\nmovel(pX,tA,m)",
            ),
            get,
        ],
        vec![(
            "start",
            local,
            "if nX==1\nl_p=pA\nelse\nl_p=pW\nendIf\nmovel(l_p,tA,m)",
        )],
    ] {
        let program = programs(&all);
        assert_eq!(placed(&program), expected, "{all:?}");
        assert!(errors(&program).is_empty(), "{:?}", program.findings);
    }
    // a frame that is changed concerns the points in it alone
    let program = programs(&[("start", "", "fA.trsf.z=nX\ncall go(pA)\ncall go(pW)"), go]);
    assert_eq!(errors(&program), ["frame-assigned-at-run-time"]);
    let blocked = program.targets.iter().filter(|target| target.blocked);
    let blocked: Vec<_> = blocked
        .filter_map(|target| target.name.as_deref())
        .collect();
    assert_eq!(blocked, ["pA"]);
}

const ALTERNATIVES: [&str; 8] = [
    "if x_n==1\ntNow=tA\nelse\ntNow=tB\nendIf",
    "if (x_n!=1)\ntNow=tB\nelse\ntNow=tA\nendIf",
    "if !(x_n!=1)\ntNow=tA\nelse\ntNow=tB\nendIf",
    "if x_n==1 or (x_n==3 and nX==2)\ntNow=tA\nelseIf x_n!=1 and x_n!=3\ntNow=tB\nendIf",
    "if x_n==7\nelseIf x_n==1\ntNow=tA\nelseIf x_n==2\ntNow=tB\nendIf",
    "switch x_n\ncase 1\ntNow=tA\nbreak\ncase 2\ntNow=tB\nbreak\nendSwitch",
    "switch x_n\ncase 1\ntNow=tA\nbreak\ndefault\ntNow=tB\nbreak\nendSwitch",
    "switch x_n\ncase 3, 2\ntNow=tB\nbreak\ncase 7, 1\ntNow=tA\nbreak\nendSwitch",
];

#[test]
fn a_number_that_a_call_gives_chooses_the_branch() {
    let given = parameter("x_n", "num", "value");
    let start = "call take(1)\nmovel(pA,tNow,m)\ncall take(2)\nmovel(pW,tNow,m)";
    for take in ALTERNATIVES {
        let program = programs(&[("start", "", start), ("take", &given, take)]);
        let expected = [("pA", "fA", "tA"), ("pW", "world", "tB")];
        assert_eq!(placed(&program), expected, "{take}");
    }
    // through another program
    let inner = parameter("y_n", "num", "value");
    let program = programs(&[
        ("start", "", &start.replace("take", "hand")),
        ("hand", &inner, "call take(y_n)"),
        ("take", &given, ALTERNATIVES[0]),
    ]);
    let expected = [("pA", "fA", "tA"), ("pW", "world", "tB")];
    assert_eq!(placed(&program), expected);
}

#[test]
fn a_number_that_may_be_another_takes_either_branch() {
    let given = parameter("x_n", "num", "value");
    let reference = parameter("y_n", "num", "reference");
    let choice = ALTERNATIVES[0];
    let either = [("pA", "fA", "tA"), ("pA", "fA", "tB")];
    let more = ("more", &*reference, "y_n=y_n+1");
    for (number, before) in [
        ("nX", ""),
        ("1.5*2", ""),
        ("1", "x_n=x_n+1"),
        ("1", "x_n=nX"),
        ("1", "for x_n=1 to 3\nendFor"),
        ("1", "toNum(\"2\",x_n,b)"),
        ("1", "call more(x_n)"),
        ("1", "call elsewhere(x_n)"),
    ] {
        let start = format!("call take({number})\nmovel(pA,tNow,m)");
        let take = format!("{before}\n{choice}");
        let program = programs(&[("start", "", &start), ("take", &given, &take), more]);
        assert_eq!(placed(&program), either, "{number} {before}");
    }
    for condition in [
        "x_n==1 and nX==2",
        "x_n>=1",
        "!(x_n==2 or nX==1)",
        "x_n==nX",
    ] {
        let take = choice.replace("x_n==1", condition);
        let start = "call take(1)\nmovel(pA,tNow,m)";
        let program = programs(&[("start", "", start), ("take", &given, &take)]);
        assert_eq!(placed(&program), either, "{condition}");
    }
}

#[test]
fn what_is_said_of_positions_that_are_not_known_is_what_is_so() {
    let local = "<Locals><Local name=\"l_p\" type=\"pointRx\" xsi:type=\"array\" size=\"2\" />\
        </Locals>";
    let program = programs(&[("start", local, "l_p[nX]=pA\nmovel(l_p[nX],tA,m)")]);
    assert_eq!(placed(&program)[..], [("pA", "fA", "tA"); 2]);
    let said: Vec<_> = program
        .findings
        .iter()
        .map(|f| f.message.as_str())
        .collect();
    let is_said = |text: &&str| text.contains("to targets of the files, or");
    assert!(said.iter().any(is_said), "{said:?}");
    let program = programs(&[("start", "", "pX.trsf=pA.trsf\nmovel(pX,tA,m)")]);
    let said: Vec<_> = program
        .findings
        .iter()
        .map(|f| f.message.as_str())
        .collect();
    assert!(
        said.iter().any(|text| text.contains("(p.trsf=…)")),
        "{said:?}"
    );
}

#[test]
fn an_element_that_the_running_program_chooses_is_what_programs_make_of_it() {
    let point = |key: u32| format!("key=\"{key}\" x=\"{key}.5\" fatherId=\"fA[0]\"");
    let data = data("fA", "frame", &[FRAME])
        + &data("tA", "tool", &[TOOL])
        + &data("nI", "num", &["key=\"0\" value=\"1\""])
        + &data("pA", "pointRx", &[&point(0), &point(1)])
        + &data("pQ", "pointRx", &[&point(0)]);
    let code = "for nI=0 to 1\ncall rd(pA[nI])\nendFor\nmovel(pA[1],tA,m)";
    let reads = |usage: &str| {
        let own = parameter("x_p", "pointRx", usage);
        let program = read_files(&[
            ("m/m.dtx", dtx(&data)),
            ("m/start.pgx", pgx("start", "", code)),
            ("m/rd.pgx", pgx("rd", &own, "x_p=pQ")),
        ]);
        let program = program.expect("a project");
        let found = placed(&program);
        let names = found.iter().map(|(name, ..)| (*name).to_owned());
        names.collect::<Vec<_>>()
    };
    assert_eq!(reads("reference"), ["pA[1]", "pQ"]);
    assert_eq!(reads("value"), ["pA[1]"]);
}

#[test]
fn a_position_that_a_call_works_out_of_a_point_displaces_it() {
    let own = parameter("x_p", "pointRx", "value");
    for given in [
        "appro(pW,{0,0,50,0,0,0})",
        "compose(pW,world,{0,0,50,0,0,0})",
    ] {
        let displaced = |all: &[(&str, &str, &str)]| {
            let program = programs(all);
            assert!(errors(&program).is_empty(), "{:?}", program.findings);
            let moves = program.moves.iter();
            let moves = moves.map(|m| {
                (
                    target(&program, m).map(str::to_owned),
                    m.displacement.clone(),
                )
            });
            moves.collect::<Vec<_>>()
        };
        let here = displaced(&[("start", "", &format!("movel({given},tA,m)"))]);
        assert!(here.iter().all(|(target, by)| {
            target.as_deref() == Some("pW") && matches!(by, Displacement::By(_))
        }));
        let handed = displaced(&[
            ("start", "", &format!("call go({given})")),
            ("go", &own, "movel(x_p,tA,m)"),
        ]);
        assert_eq!(handed, here, "{given}");
    }
    // joints that are written out are known, too
    let own = parameter("x_j", "jointRx", "value");
    let program = programs(&[
        ("start", "", "call go({0,-20,110,0,90,0})"),
        ("go", &own, "movej(x_j,tA,m)"),
    ]);
    let goes = program.moves.iter().filter(|m| m.target.is_some());
    assert_eq!(goes.count(), 1, "{:?}", program.findings);
}
