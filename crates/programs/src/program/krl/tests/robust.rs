//! Broken and huge text.

use super::*;

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]

    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(0_u8..=255, 0..400)) {
        let source = Source::new("x", bytes);
        let _ = Krl.recognises(&source);
        let _ = crate::motion::read(&Krl, &[source], &Settings::default());
    }

    #[test]
    fn mutated_programs_never_panic(
        changes in proptest::collection::vec((0_usize..3000, proptest::sample::select(&MUTATIONS[..])), 1..6)
    ) {
        let mut bytes = SAMPLE.as_bytes().to_vec();
        for (at, (cut, text)) in changes {
            let at = at % bytes.len().max(1);
            let end = (at + cut).min(bytes.len());
            bytes.splice(at..end, text.bytes());
        }
        let source = Source::new("m.src", bytes);
        let data = Source::new("m.dat", DATA.as_bytes().to_vec());
        let _ = Krl.recognises(&source);
        let marker = Marker { version: "1".into(), profile_sha256: "a".into(), source_sha256: "b".into(), decided: Vec::new() };
        let (at, _) = Krl.mark(&source, &marker);
        assert!(at <= source.bytes.len());
        let sources = [source, data];
        if let Ok(program) = crate::motion::read(&Krl, &sources, &Settings::default()) {
            check(&sources, &program);
        }
    }
}

/// Numbers are those of the text, in its order, and targets have as many as their layout says.
fn check(sources: &[Source], program: &Program) {
    for target in &program.targets {
        let count = target.numbers.len();
        assert!(count == Krl.roles(target.layout).len() || (count == 0 && target.blocked));
        let mut places = Vec::new();
        for number in program.numbers_of(target) {
            let start = number.start as usize;
            let end = start + usize::from(number.length);
            let text = &sources[target.file as usize].bytes[start..end];
            let value = tokens::bits_value(text).map(f64::from);
            assert_eq!(
                value.or(crate::program::number::parse(text)),
                Some(number.value)
            );
            places.push((start, end));
        }
        places.sort_unstable();
        assert!(places.windows(2).all(|pair| pair[0].1 <= pair[1].0));
    }
    for used in &program.moves {
        assert!(
            used.target
                .is_none_or(|target| target < program.targets.len())
        );
        assert!(used.tool < program.tools.len() && used.frame < program.frames.len());
    }
}

/// What mutations cut, and put in its place.
const MUTATIONS: [(usize, &str); 26] = [
    (1, ""),
    (40, ""),
    (0, "["),
    (0, "]"),
    (0, "{"),
    (0, "}"),
    (0, ")"),
    (0, "\""),
    (0, "'B1"),
    (0, ";"),
    (1, ","),
    (0, ":"),
    (0, "="),
    (0, "\n"),
    (0, "\r"),
    (0, "1e400"),
    (0, "-"),
    (0, "\nEND\n"),
    (0, "\nENDIF\n"),
    (0, "\nEXIT\n"),
    (0, "\nENDLOOP\n"),
    (0, "\nGOTO l\n"),
    (0, "\nDEF m()\n"),
    (0, "\nDEFDAT m\n"),
    (0, "E6POS "),
    (0, " WITH $BASE="),
];

const SAMPLE: &str = "&ACCESS RVP\nDEF m(a:IN)\nDECL E6POS \
    q,r[3]\nBAS(#INITMOV,0)\nBAS(#TOOL,1)\n$BASE=BASE_DATA[2]\n\
    TOOL_DATA[1]={FRAME: X 1,Y 2,Z 3,A 4,B 5,C 6}\nFDAT_ACT=FP1\nBAS(#FRAMES)\nFDAT_ACT={TOOL_NO \
        1,BASE_NO 2,IPO_FRAME #TCP}\n\
    IF $IN[1] THEN\nPTP XP1 C_PTP\nELSE\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0,S 'B010',T 35,E1 0.0} \
        C_DIS\nENDIF\n\
    l:\nLOOP\nCIRC XP2,XP3,CA 90\nEXIT\nENDLOOP\nFOR i=1 TO 3\nLIN r[i]\nENDFOR\nSWITCH a\nCASE \
        1\nsub(XP2,q)\nDEFAULT\nRETURN\nENDSWITCH\n\
    SPLINE WITH $BASE=BASE_DATA[3]\nSPL XP1\nSLIN XP2 WITH \
        $TOOL=STOOL2(FP1),$IPO_MODE=SIPO_MODE(FP1.IPO_FRAME)\nENDSPLINE\n\
    LIN XP1:{X 0,Y 0,Z 5,A 0,B 0,C 0}:q\nLIN_REL {Z 10} #TOOL\nPTP_REL {A6 \
        -0.001}\nq=XP1\nq.X=3\nr[2]={X 1,Y 2}\nGOTO l\n\
    REPEAT\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}\nUNTIL TRUE\nm(1)\nEND\nGLOBAL DEF \
        sub(b:OUT,c:IN)\n$IPO_MODE=#TCP\nPTP $AXIS_ACT\nEND\n";

#[test]
fn the_sample_of_the_mutations_reads() {
    let program = read_files(&[("m.src", SAMPLE), ("m.dat", DATA)]);
    assert!(program.moves.len() > 3);
}

#[test]
fn brackets_without_end_do_not_overflow_the_stack() {
    for open in [
        "[",
        "(",
        "{",
        "{X {",
        "XP1:",
        "f(",
        "-",
        "XP1[",
        ".a",
        "IF ",
        "LOOP\n",
        "IF a THEN\n",
        "SWITCH a\nCASE 1\n",
        "DEF a()\n",
    ] {
        let deep = open.repeat(200_000);
        for text in [
            format!("DEF m()\nLIN {deep}"),
            format!("DEF m()\n{deep}\nEND"),
            format!("DEFDAT m\nDECL E6POS p={deep}\nENDDAT"),
            format!("DEFDAT m\nTOOL_DATA[1]={deep}\nENDDAT"),
            format!("DEF m()\n$BASE={deep}\nEND"),
            format!("DEF m()\nLIN XP1 WITH $BASE={deep}\nEND"),
        ] {
            let _ = read_with(&[("m.src", &text)], &Settings::default());
        }
    }
}

#[test]
fn many_uses_of_large_arrays_stay_linear() {
    let elements: String = (1..=3000)
        .map(|k| format!("p[{k}]={{X {k},Y 0,Z 0,A 0,B 0,C 0}}\n"))
        .collect();
    let data = format!("DEFDAT m\nDECL E6POS p[3000]\n{elements}ENDDAT\n");
    let moves = "LIN p[i]\np[i].X=1\nLIN p[i]:{X 0,Y 0,Z 5,A 0,B 0,C 0}\nsub(p[i])\n".repeat(3000);
    let text = format!("DEF m()\nBAS(#TOOL,1)\nBAS(#BASE,1)\n{moves}END\n");
    let program = read_files(&[("m.dat", &data), ("m.src", &text)]);
    assert_eq!(program.targets.len(), 3000);
    let errors = program.findings.iter().filter(|f| f.id != "too-many-uses");
    assert_eq!(errors.count(), 6000, "each target once for each cause");
}

#[test]
fn deep_and_long_control_flow_stays_linear() {
    let open = "LOOP\nIF $IN[1] THEN\nBAS(#BASE,1)\n".repeat(3000);
    let close = "EXIT\nENDIF\nENDLOOP\n".repeat(3000);
    let text = format!("DEF m()\n{open}LIN {{X 1,Y 2,Z 3,A 0,B 0,C 0}}\n{close}END\n");
    assert_eq!(read(&text).targets.len(), 1);
    let calls: String = (0..3000)
        .map(|k| {
            format!(
                "DEF r{k}()\nr{}()\nr{}()\nLIN {{X 1,Y 2,Z 3,A 0,B 0,C 0}}\nEND\n",
                k + 1,
                k / 2
            )
        })
        .collect();
    assert_eq!(read(&calls).targets.len(), 3000);
}

#[test]
fn broken_text_is_refused_with_its_place() {
    let head = "DEF M()\n";
    for (text, line, column, what) in [
        ("LIN {X 1,Y 2\nEND", 2, 5, "an aggregate"),
        ("LIN {X 1,Y 2,Z 1e7,A 0,B 0,C 0}\nEND", 2, 16, "1e7"),
        ("LIN {X 1,X 2}\nEND", 2, 10, "X"),
        ("LIN {X 1,S -1}\nEND", 2, 12, "-1"),
        ("LIN\nEND", 2, 4, "the end of the line"),
        ("LIN XP1[1\nEND", 2, 8, "a bracket"),
        ("LIN XP1", 1, 1, "DEF without END"),
    ] {
        let files = [("dir/m.src", &*format!("{head}{text}"))];
        let error = read_with(&files, &Settings::default()).expect_err(text);
        assert_eq!(error.place(), ("dir/m.src", line, column), "{error}");
        assert!(error.to_string().contains(what), "{error}");
    }
    let error = read_with(
        &[("a.dat", "DEFDAT A\nDECL E6POS x={X 1}\n")],
        &Settings::default(),
    );
    assert!(error.is_err_and(|e| e.to_string().contains("DEFDAT without ENDDAT")));
    let error = read_with(&[("a.src", "PROC main()\n")], &Settings::default());
    assert!(matches!(error, Err(ReadError::NotThisLanguage { .. })));
    let zero = Source::new("a.src", b"DEF a()\0".to_vec());
    assert!(matches!(
        crate::motion::read(&Krl, &[zero], &Settings::default()),
        Err(ReadError::Binary { .. })
    ));
}

#[test]
fn machine_data_with_another_robot_root_are_an_error() {
    let machine = |root: &str| {
        format!("DEFDAT $MACHINE PUBLIC\nINT $NUM_AX=6\nFRAME $ROBROOT={root}\nENDDAT\n")
    };
    let program = |root: &str, base: Option<Pose>| {
        let settings = Settings {
            world_from_base: base,
            ..Settings::default()
        };
        let text = "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,2)\nLIN XP1\nEND\n";
        let files = [
            ("m.src", text),
            ("m.dat", DATA),
            ("$machine.dat", &*machine(root)),
        ];
        read_with(&files, &settings).expect("a program")
    };
    let above = Pose::from_translation(0.0, 0.0, 0.5);
    let root = "{X 0.0,Y 0.0,Z 500.0,A 0.0,B 0.0,C 0.0}";
    let same = "{FRAME: X 0.0,Y 0.05,Z 500.0,A 0.005,B 0.0,C 0.0}";
    for (root, base, expected) in [
        (root, Some(above), 0),
        (same, Some(above), 0),
        (root, None, 0),
        (root, Some(Pose::identity()), 1),
        ("{X 0,Y 0.2,Z 500,A 0,B 0,C 0}", Some(above), 1),
        ("{X 0,Y 0,Z 500,A 0,B 0,C 0.1}", Some(above), 1),
    ] {
        let program = program(root, base);
        let differs = program
            .findings
            .iter()
            .filter(|f| f.id == "robot-root-differs");
        let differs: Vec<_> = differs.collect();
        assert_eq!(differs.len(), expected, "{root} {base:?}");
        for found in differs {
            assert_eq!((found.severity, found.line), (Severity::Error, 3));
            assert!(
                found.message.contains("$ROBROOT is X 0.000, Y 0."),
                "{}",
                found.message
            );
        }
    }
}
