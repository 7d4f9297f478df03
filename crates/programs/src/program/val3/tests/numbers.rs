//! Displacements by what statements write into numbers and transformations.

use super::*;
use crate::geometry::Pose;

fn points() -> String {
    data("trA", "trsf", &["key=\"0\" z=\"-50\""])
        + &data("tOff", "trsf", &["key=\"0\""])
        + &data("nUp", "num", &["key=\"0\" value=\"200\""])
        + &data("nH", "num", &["key=\"0\""])
        + &data("nI", "num", &["key=\"0\""])
        + &data("pA", "pointRx", &["key=\"0\" x=\"1\" fatherId=\"fA[0]\""])
        + &data(
            "pX",
            "pointRx",
            &["key=\"0\" x=\"1\" fatherId=\"lib:f[0]\""],
        )
        + &data("pB", "pointRx", &["key=\"0\" x=\"2\" fatherId=\"fA[0]\""])
}

/// What the last move of code is displaced by.
fn by(code: &str) -> Displacement {
    let program = project(&points(), code);
    program.moves.last().expect("a move").displacement.clone()
}

fn in_tool(numbers: [f64; 3]) -> Displacement {
    let [x, y, z] = numbers;
    let in_tool = Pose::from_translation(x, y, z);
    Displacement::By(Box::new(Shift {
        in_tool,
        ..Shift::none()
    }))
}

#[test]
fn quotients_of_counters_have_ends() {
    let farthest = |code: &str| -> f64 {
        let Displacement::Within(strides) = by(code) else {
            panic!("{code}: {:?}", by(code));
        };
        let far = strides.iter().map(|stride| match stride {
            Stride::By { shift, most } => {
                shift.in_tool.translation[0] * f64::from(most.expect("they end"))
            }
            _ => panic!("nothing turns"),
        });
        far.sum()
    };
    for (x, expected) in [
        ("(nI%4)*30", 0.09),
        ("roundDown(nI/4)*20", 0.02),
        ("roundUp(nI/4)*20", 0.04),
        ("roundDown(nUp*nI/800)*20", 0.02),
    ] {
        let code = format!("for nI=0 to 6\nmovel(appro(pA,{{{x},0,0,0,0,0}}),tA,m)\nendFor");
        let found = farthest(&code);
        assert!((found - expected).abs() < 1e-9, "{x}: {found}");
    }
    let code = "movel(appro(pA,{rand(nI),0,0,0,0,0}),tA,m)";
    assert_eq!(by(code), Displacement::Unbounded);
}

#[test]
fn what_the_text_writes_displaces_by_that() {
    for code in [
        "movel(appro(pA,{0,0,nUp,0,0,0}),tA,m)",
        "movel(appro(pA,{0,0,nUp*2-200,0,0,0}),tA,m)",
        "movel(appro(pA,trA*!trA*{0,0,200,0,0,0}),tA,m)",
        "movel(appro(appro(pA,trA),{0,0,250,0,0,0}),tA,m)",
    ] {
        assert_eq!(by(code), in_tool([0.0, 0.0, 0.2]), "{code}");
    }
    let turned = by("movel(appro(pA,{0,0,0,0,180,0}*trA),tA,m)");
    let Displacement::By(turned) = turned else {
        panic!("{turned:?}");
    };
    assert!((turned.in_tool.translation[2] - 0.05).abs() < 1e-12);
    let raised = by("pB=pA\npB.trsf.z=pB.trsf.z+nUp\nmovel(pB,tA,m)");
    assert_eq!(
        raised,
        Displacement::By(Box::new(Shift::along([0.0, 0.0, 0.2])))
    );
    let of_other = by("pB=pA\npB.trsf.z=pA.trsf.z+nUp\nmovel(pB,tA,m)");
    assert_eq!(of_other, raised);
}

#[test]
fn numbers_of_a_call_are_those_of_that_call() {
    let own = "<Parameters><Parameter name=\"x_p\" type=\"pointRx\" use=\"value\" xsi:type=\"element\" /><Parameter \
        name=\"x_n\" type=\"num\" use=\"value\" xsi:type=\"element\" /></Parameters>";
    let all = data("fA", "frame", &[FRAME]) + &data("tA", "tool", &[TOOL]) + &points();
    let go = |code: &str, pick: &str| -> Vec<(String, Displacement)> {
        let program = read_files(&[
            ("m/m.dtx", dtx(&all)),
            ("m/start.pgx", pgx("start", "", code)),
            ("m/pick.pgx", pgx("pick", own, pick)),
            ("m/by.pgx", pgx("by", own, "call pick(x_p,x_n*2)")),
        ])
        .expect("a project");
        // nothing calls one of them in some
        let moves = program.moves.iter().filter(|one| one.target.is_some());
        let named = |one: &Move| target(&program, one).unwrap_or_default().to_owned();
        moves
            .map(|one| (named(one), one.displacement.clone()))
            .collect()
    };
    let each = [
        ("pA".to_owned(), in_tool([0.0, 0.0, -0.02])),
        ("pB".to_owned(), in_tool([0.0, 0.0, -0.06])),
    ];
    let near = "movel(appro(x_p,{0,0,-x_n,0,0,0}),tA,m)";
    for (code, pick) in [
        ("call pick(pA,20)\ncall pick(pB,60)", near),
        ("call by(pA,10)\ncall pick(pB,60)", near),
        ("call by(pA,10)\ncall by(pB,30)", near),
    ] {
        let found = go(code, pick);
        assert_eq!(found, each, "{code}");
    }
    // a number that something else writes is any of them
    let found = go(
        "call pick(pA,20)\ncall pick(pB,60)",
        &format!("x_n=x_n+1\n{near}"),
    );
    assert!(
        found
            .iter()
            .all(|(_, by)| !matches!(by, Displacement::By(_)))
    );
}

#[test]
fn a_copy_in_another_configuration_has_the_correction_of_this_one() {
    let other = by("pB=pA\npB.config.shoulder=lefty\nmovel(pA,tA,m)\nmovej(pB,tA,m)");
    assert_eq!(other, Displacement::Overwritten);
}

#[test]
fn what_a_program_writes_into_a_transformation_counts() {
    // it begins as what the data say, and is that or the other
    for code in [
        "tOff.z=200",
        "tOff={0,0,200,0,0,0}",
        "tOff={0,0,nUp,0,0,0}",
        "tOff=trA*{0,0,250,0,0,0}",
    ] {
        let Displacement::Within(found) = by(&format!("{code}\nmovel(appro(pA,tOff),tA,m)")) else {
            panic!("{code}");
        };
        let [
            Stride::By {
                shift,
                most: Some(1),
            },
        ] = &found[..]
        else {
            panic!("{code}: {found:?}");
        };
        let z = shift.in_tool.translation[2];
        assert!((z - 0.2).abs() < 1e-12, "{code}: {z}");
    }
    let counted = by("for nI=0 to 3\nmovel(appro(pA,{0,0,-nI*10,0,0,0}),tA,m)\nendFor");
    assert!(matches!(counted, Displacement::Within(_)), "{counted:?}");
    let composed = by("for nI=0 to 3\nmovel(compose(pA,world,{nI*10,0,0,0,0,0}),tA,m)\nendFor");
    assert!(matches!(composed, Displacement::Within(_)), "{composed:?}");
}

/// How far along x or z steps lead at most, with the last of them, mm.
fn at_most(found: &Displacement) -> f64 {
    let Displacement::Within(strides) = found else {
        panic!("{found:?}");
    };
    let each = strides.iter().map(|stride| match stride {
        Stride::By { shift, most } => {
            let [x, _, z] = shift.in_tool.translation;
            (x + z).abs() * f64::from(most.expect("counted"))
        }
        _ => panic!("it turns nothing"),
    });
    each.sum::<f64>() * 1e3
}

#[test]
fn a_counter_that_the_data_give_a_value_is_what_its_loop_counts() {
    // from 200, as declared, to 4, which it is behind the loop, one by one
    let go = "movel(appro(pA,{nUp*30,0,0,0,0,0}),tA,m)";
    for code in [
        format!("for nUp=0 to 3\n{go}\nendFor"),
        format!("for nUp=3 to 0 step -1\n{go}\nendFor"),
        format!("for nUp=0 to 3\nendFor\n{go}"),
        format!("{go}\nfor nUp=0 to 3\nendFor"),
        "for nUp=0 to 3\ntOff.x=nUp*30\nmovel(appro(pA,tOff),tA,m)\nendFor".to_owned(),
    ] {
        let reach = at_most(&by(&code));
        assert!(reach >= 90.0 - 1e-9, "{code}: {reach}");
    }
    for (code, expected) in [
        (
            format!("for nI=0 to 1\n{}\nendFor", go.replace("nUp", "nI")),
            30.0,
        ),
        (
            format!("for nI=1 to 2\n{}\nendFor", go.replace("nUp", "(nI-1)")),
            30.0,
        ),
        (
            format!(
                "for nI=0 to 1\nfor nI=0 to 8\nendFor\n{}\nendFor",
                go.replace("nUp", "nI")
            ),
            270.0,
        ),
        // an element of an array that is another
        (
            format!("for nI[0]=0 to 1\n{}\nendFor", go.replace("nUp", "nI[1]")),
            60.0,
        ),
    ] {
        let reach = at_most(&by(&code));
        assert!((reach - expected).abs() < 1e-9, "{code}: {reach}");
    }
    for code in [
        "for nUp=0 to 3\npX=compose(pB,fA,{nUp*30,0,0,0,0,0})\nmovel(pX,tA,m)\nendFor",
        "for nUp=0 to 3\npB=pA\npB.trsf.x=pA.trsf.x+nUp*30\nmovel(pB,tA,m)\nendFor",
    ] {
        let found = by(code);
        assert!(
            matches!(found, Displacement::Within(_)),
            "{code}: {found:?}"
        );
    }
}

#[test]
fn conditions_of_loops_bound_what_adds_up() {
    let go = "movel(appro(pA,{nI*30,0,0,0,0,0}),tA,m)\nnI=nI+1";
    let leave = "if nI>=4\nbreak\nendIf";
    for code in [
        format!("nI=0\nwhile nI<4\n{go}\nendWhile"),
        format!("nI=0\nwhile (nI<4) and bIn\n{go}\nendWhile"),
        format!("nI=0\ndo\n{go}\nuntil nI>=4"),
        format!("nI=0\nnH=0\ndo\n{go}\nnH=nH+1\nuntil nH==4"),
        format!("nI=0\nwhile true\n{go}\n{leave}\nendWhile"),
        format!("nI=0\nwhile true\n{go}\nif nI>=4\nreturn\nendIf\nendWhile"),
    ] {
        let reach = at_most(&by(&code));
        assert!((reach - 120.0).abs() < 1e-9, "{code}: {reach}");
    }
    for code in [
        format!("nI=0\nwhile bIn\n{go}\nendWhile"),
        format!("nI=0\ndo\n{go}\nuntil nI>=4 and bIn"),
        format!("do\n{go}\nuntil nI>=4"),
        // it leaves the choice, not the loop
        format!("nI=0\nwhile true\n{go}\nswitch nH\ncase 1\n{leave}\nbreak\nendSwitch\nendWhile"),
    ] {
        let found = by(&code);
        let is_bounded = match &found {
            Displacement::Within(all) => all
                .iter()
                .all(|stride| matches!(stride, Stride::By { most: Some(_), .. })),
            _ => false,
        };
        assert!(!is_bounded, "{code}: {found:?}");
    }
}

/// A program's own numbers begin at 0 in each run of it; those of the project are kept.
#[test]
fn what_a_program_adds_up_of_its_own_begins_anew_with_it() {
    let local =
        "<Locals><Local name=\"tOwn\" type=\"trsf\" xsi:type=\"array\" size=\"1\" /></Locals>";
    let all = data("fA", "frame", &[FRAME]) + &data("tA", "tool", &[TOOL]) + &points();
    let of = |name: &str| {
        let code = format!(
            "while true\nif bIn\n{name}.z={name}.z-20\nmovel(appro(pA,{name}),tA,m)\nreturn\nendIf\n\
             endWhile"
        );
        let files = [
            ("m/m.dtx", dtx(&(all.clone() + &data("tKept", "trsf", &[])))),
            ("m/start.pgx", pgx("start", local, &code)),
        ];
        let program = read_files(&files).expect("a project");
        program.moves[0].displacement.clone()
    };
    let is_endless = |found: &Displacement| match found {
        Displacement::Within(all) | Displacement::AtLeast(all) => {
            let is = |stride: &Stride| matches!(stride, Stride::By { most: None, .. });
            all.iter().any(is)
        }
        other => *other == Displacement::Unbounded,
    };
    for (name, expected) in [("tOwn", false), ("tKept", true)] {
        let found = of(name);
        assert_eq!(is_endless(&found), expected, "{found:?}");
    }
}

#[test]
fn a_counter_in_a_program_that_is_given_it_or_in_a_task_counts() {
    let all = data("fA", "frame", &[FRAME]) + &data("tA", "tool", &[TOOL]) + &points();
    let parameter = "<Parameters><Parameter name=\"x\" type=\"num\" use=\"reference\" \
        xsi:type=\"element\" /></Parameters>";
    let go = "movel(appro(pA,{nUp*30,0,0,0,0,0}),tA,m)";
    for (start, declared, sub) in [
        ("call sub(nUp)\n", parameter, "for x=0 to 3\nendFor"),
        ("call sub()\n", "", "for nUp=0 to 3\nendFor"),
        ("taskCreate \"t\",10,sub()\n", "", "for nUp=0 to 3\nendFor"),
    ] {
        let files = [
            ("m/m.dtx", dtx(&all)),
            ("m/start.pgx", pgx("start", "", &format!("{start}{go}"))),
            ("m/sub.pgx", pgx("sub", declared, sub)),
        ];
        let program = read_files(&files).expect("a project");
        let found = &program.moves[0].displacement;
        // what comes back may be what was given
        let is_judged = *found == Displacement::Unbounded || at_most(found) >= 90.0 - 1e-9;
        assert!(is_judged, "{start}: {found:?}");
    }
}

#[test]
fn only_what_no_text_tells_is_taken_for_a_sensor() {
    for (code, wanted) in [
        ("movel(appro(pA,trCam),tA,m)", Displacement::Unknown),
        (
            "movel(appro(pA,{0,0,aioGet(ai),0,0,0}),tA,m)",
            Displacement::Unknown,
        ),
        ("movel(compose(pA,fA,trCam),tA,m)", Displacement::Unknown),
        (
            "movel(appro(pA,{0,0,abs(-nUp),0,0,0}),tA,m)",
            in_tool([0.0, 0.0, 0.2]),
        ),
        ("movel(appro(pA,pB.trsf),tA,m)", Displacement::Unbounded),
        (
            "movel(compose(pA,fA*trA,trA),tA,m)",
            Displacement::Unbounded,
        ),
        ("movel(compose(pX,fA,trA),tA,m)", Displacement::Unbounded),
        (
            "tOff=pB.trsf*!pA.trsf\nmovel(appro(pA,tOff),tA,m)",
            Displacement::Unbounded,
        ),
        (
            "pB=pA\npB.trsf.z=pB.trsf.z*2\nmovel(pB,tA,m)",
            Displacement::Unbounded,
        ),
    ] {
        assert_eq!(by(code), wanted, "{code}");
    }
}

#[test]
fn numbers_are_those_that_calls_give_and_programs_bring_back() {
    let parameter = |by: &str, kind: &str| {
        format!(
            "<Parameters><Parameter name=\"x\" type=\"{kind}\" use=\"{by}\" \
             xsi:type=\"element\" /></Parameters>"
        )
    };
    let all = data("fA", "frame", &[FRAME]) + &data("tA", "tool", &[TOOL]) + &points();
    let by = |start: &str, parameter: String, sub: &str| {
        let files = [
            ("m/m.dtx", dtx(&all)),
            ("m/start.pgx", pgx("start", "", start)),
            ("m/sub.pgx", pgx("sub", &parameter, sub)),
        ];
        let program = read_files(&files).expect("a project");
        program.moves.last().expect("a move").displacement.clone()
    };
    let go = "movel(appro(pA,{0,0,x,0,0,0}),tA,m)";
    let given = by("call sub(nUp)", parameter("value", "num"), go);
    assert_eq!(given, in_tool([0.0, 0.0, 0.2]));
    let given = by(
        "call sub(trA)",
        parameter("value", "trsf"),
        "movel(appro(pA,x),tA,m)",
    );
    assert_eq!(given, in_tool([0.0, 0.0, -0.05]));
    // what comes back may be what was given
    let back = by(
        "call sub(nH)\nmovel(appro(pA,{0,0,nH,0,0,0}),tA,m)",
        parameter("reference", "num"),
        "x=300",
    );
    assert_eq!(back, Displacement::Unbounded);
}

#[test]
fn a_frame_of_a_program_of_its_own_is_not_the_one_of_the_project() {
    let all = data("fA", "frame", &[FRAME]) + &data("tA", "tool", &[TOOL]) + &points();
    let local =
        "<Locals><Local name=\"fA\" type=\"frame\" xsi:type=\"array\" size=\"1\" /></Locals>";
    let code = "movel(compose(pA,fA,trA),tA,m)";
    for (declared, is_followed) in [("", true), (local, false)] {
        let files = [
            ("m/m.dtx", dtx(&all)),
            ("m/start.pgx", pgx("start", declared, code)),
        ];
        let program = read_files(&files).expect("a project");
        let found = &program.moves[0].displacement;
        assert_eq!(
            matches!(found, Displacement::By(_)),
            is_followed,
            "{found:?}"
        );
    }
}

#[test]
fn arrays_that_are_moved_about_are_refused() {
    let points = data(
        "pC",
        "pointRx",
        &[
            "key=\"0\" x=\"1\" fatherId=\"fA[0]\"",
            "key=\"1\" x=\"2\" fatherId=\"fA[0]\"",
        ],
    );
    for code in ["insert(pC,0)", "delete(pC,0)", "resize(pC,1,5)"] {
        let program = project(&points, &format!("movel(pC[1],tA,m)\n{code}"));
        let found = program.findings.iter();
        let mut found = found.filter(|found| found.severity == Severity::Error);
        let first = found.next().expect("refused");
        assert_eq!(first.id, "target-assigned-at-run-time", "{code}");
    }
    let program = project(&points, "movel(pC[1],tA,m)\nappend(pC)");
    assert!(ids(&program).iter().all(|id| *id == "target-unused-here"));
}

#[test]
fn frames_of_two_projects_under_one_alias_have_the_name_of_the_project() {
    let pjx = |name: &str, library: &str| {
        format!(
            "<Project xmlns=\"http://www.staubli.com/robotics/VAL3/Project/3\"><Parameters \
             millimeterUnit=\"true\" /><Programs><Program file=\"{name}.pgx\" /></Programs>\
             <Database><Data file=\"{name}.dtx\" /></Database><Libraries><Library alias=\"a\" \
             path=\"{library}\" /></Libraries></Project>"
        )
    };
    let names = |second: &str| {
        let mut files = Vec::new();
        for (name, library) in [("One", "../A/A.pjx"), ("Two", second)] {
            let points = dtx(&data(
                "pA",
                "pointRx",
                &["key=\"0\" x=\"1\" fatherId=\"a:f[0]\""],
            ));
            files.push((format!("c/{name}/{name}.pjx"), pjx(name, library)));
            files.push((format!("c/{name}/{name}.dtx"), points));
            let code = pgx("start", "", "movej(pA,flange,m)");
            files.push((format!("c/{name}/{name}.pgx"), code));
        }
        let files: Vec<(&str, String)> = files.iter().map(|(n, t)| (&**n, t.clone())).collect();
        let program = read_files(&files).expect("projects");
        let frames = program
            .moves
            .iter()
            .map(|m| program.frames[m.frame].name.clone());
        frames.collect::<Vec<_>>()
    };
    assert_eq!(names("../B/B.pjx"), ["One/a:f", "Two/a:f"]);
    assert_eq!(names("../A/A.pjx"), ["a:f", "a:f"]);
}

#[test]
fn points_that_a_frame_is_made_of_keep_their_numbers() {
    let points = data("fS", "frame", &[FRAME])
        + &data(
            "pA",
            "pointRx",
            &[
                "key=\"0\" x=\"1\" fatherId=\"world[0]\"",
                "key=\"1\" x=\"2\" fatherId=\"world[0]\"",
                "key=\"2\" y=\"2\" fatherId=\"world[0]\"",
            ],
        )
        + &data("pS", "pointRx", &["key=\"0\" x=\"3\" fatherId=\"fS[0]\""])
        + &data("pX", "pointRx", &[]);
    let go = "movel(pA[0],tA,m)\nmovel(pA[1],tA,m)";
    let set = "nErr=setFrame(pA[0],pA[1],pA[2],fS)";
    let severities = |code: &str| -> Vec<Severity> {
        let program = project(&points, code);
        let found = program.findings.iter();
        let found = found.filter(|found| found.id == "target-used-as-frame");
        found.map(|found| found.severity).collect()
    };
    for (uses, count) in [
        ("movel(pS[0],tA,m)", 2),
        ("movel(compose(pA[2],fS,{0,0,5,0,0,0}),tA,m)", 3),
        ("link(pX,fS)", 2),
        ("pX=here(tA,fS)", 2),
    ] {
        let code = format!("{go}\n{set}\n{uses}");
        assert_eq!(severities(&code), vec![Severity::Error; count], "{uses}");
    }
    // through a copy, and in a frame that the files do not tell
    let copied = format!("{go}\npX=pA[0]\nnErr=setFrame(pX,pA[2],pA[2],fElse)");
    assert_eq!(severities(&copied), [Severity::Error]);
    // nothing uses it
    assert_eq!(severities(&format!("{go}\n{set}")), [Severity::Note]);
}

#[test]
fn what_a_loop_adds_to_a_copy_counts_as_often_as_the_text_says() {
    let grown = |most| {
        let shift = Shift::along([0.012, 0.0, 0.0]);
        Displacement::Within(Box::new([Stride::By { shift, most }]))
    };
    let step = "pB.trsf.x=pB.trsf.x+12\nmovel(pB,tA,mA)\nendFor";
    for (text, most) in [
        (format!("for nI=1 to 3\n{step}"), Some(3)),
        (format!("for nI=3 to 1 step -1\n{step}"), Some(3)),
        (format!("for nI=1 to nUp\n{step}"), None),
        (format!("for nI=1 to 3\nif bA\nnI=1\nendIf\n{step}"), None),
    ] {
        assert_eq!(by(&format!("pB=pA\n{text}")), grown(most), "{text}");
    }
}
