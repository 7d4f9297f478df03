//! Broken and huge text.

use super::*;

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]

    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(0_u8..=255, 0..400)) {
        let source = Source::new("x", bytes);
        let _ = Fanuc.recognises(&source);
        let _ = crate::motion::read(&Fanuc, &[source], &Settings::default());
    }

    #[test]
    fn mutated_programs_never_panic(
        changes in proptest::collection::vec((0_usize..4000, proptest::sample::select(&MUTATIONS[..])), 1..6)
    ) {
        let mut bytes = sample().into_bytes();
        for (at, (cut, text)) in changes {
            let at = at % bytes.len().max(1);
            let end = (at + cut).min(bytes.len());
            bytes.splice(at..end, text.bytes());
        }
        let source = Source::new("x", bytes);
        let _ = Fanuc.recognises(&source);
        let marker = Marker { version: "1".into(), profile_sha256: "a".into(), source_sha256: "b".into(), decided: Vec::new() };
        let (at, _) = Fanuc.mark(&source, &marker);
        assert!(at <= source.bytes.len());
        if let Ok(program) = crate::motion::read(&Fanuc, std::slice::from_ref(&source), &Settings::default()) {
            for target in &program.targets {
                let numbers = program.numbers_of(target);
                let roles = Fanuc.roles(target.layout);
                assert!(numbers.len() == roles.len() || (numbers.is_empty() && target.blocked));
                for (number, role) in numbers.iter().zip(roles) {
                    let start = number.start as usize;
                    let text = &source.bytes[start..start + usize::from(number.length)];
                    let parsed = crate::program::number::parse(text.trim_ascii_start());
                    assert!(parsed == Some(number.value) || *role == Role::Configuration);
                }
            }
        }
    }

    #[test]
    fn mutated_lists_of_frames_never_panic(
        variables in proptest::prelude::any::<bool>(),
        changes in proptest::collection::vec((0_usize..700, proptest::sample::select(&MUTATIONS[..])), 1..6)
    ) {
        let mut bytes = if variables { VARIABLES } else { LIST }.as_bytes().to_vec();
        for (at, (cut, text)) in changes {
            let at = at % bytes.len().max(1);
            let end = (at + cut).min(bytes.len());
            bytes.splice(at..end, text.bytes());
        }
        let sources = [Source::new("x", bytes), Source::new("a", sample().into_bytes())];
        let _ = Fanuc.recognises(&sources[0]);
        let _ = crate::motion::read(&Fanuc, &sources, &Settings::default());
    }
}

const VARIABLES: &str = "[*SYSTEM*]$MNUFRAME  Storage: SHADOW  Access: RW  : ARRAY[1,2] OF \
    POSITION\n    [1,1] = \n  Group: 1   Config: N D B, 0, 0, 0\n  X:   884.000   Y: -3329.790   \
    Z:  -133.190\n  W:     0.000   P:      .370   R:    90.000\n    [1,2] =  \
    Uninitialized\n[*SYSTEM*]$MNUTOOL  Storage: CMOS  Access: RW  : ARRAY[1,1] OF POSITION\n  \
    [1,1] = 'GRIP' Group: 1\n    X:   0.000   Y:   0.000   Z: 150.000\n    W:   0.000   P:   \
    0.000   R:   0.000\n";
const LIST: &str = "F Number: F000000\n\nTool Frame\n  -1.3  -90.6   150.1  -180.0     0.0   -90.0 \
    SSW\n\nJog Frame\n   5.0     0.0     0.0     0.0     0.0     0.0 \n\nUser Frame\n ****** \
    ****** ****** ****** ****** ******\n 884.0  -3329.8   -133.2      .1      .0    90.0 FIX 1\n";

/// What mutations cut, and put in its place.
const MUTATIONS: [(usize, &str); 24] = [
    (1, ""),
    (40, ""),
    (0, "["),
    (0, "]"),
    (0, "{"),
    (0, "}"),
    (0, "\""),
    (0, "!"),
    (0, ";"),
    (1, ","),
    (0, "'"),
    (0, ":"),
    (0, "="),
    (0, "\n/POS\n"),
    (0, "\n/MN\n"),
    (0, "1e400"),
    (0, "********"),
    (0, "-"),
    (0, "GP2:"),
    (0, "P[R["),
    (0, "\r"),
    (0, "J P["),
    (0, "99999999999999999999"),
    (0, "UFRAME[1]=PR[1] ;"),
];

fn sample() -> String {
    listing(
        "   1:  UFRAME_NUM=2 ;\n   2:J P[1:a] 100% FINE TB .1sec,P-SPS ;\n      1:  CALL \
         X(P[2],'a;b') ;\n       ------ ;\n   3:C P[2]\n    :  P[R[1]] 9mm/sec CNT5 Offset,PR[1] \
         ;\n   4:  //L P[1] ;\n   5:  LBL[1:x] ;\n   6:A P[3] 9mm/sec FINE INC ;\n   7:  \
         PR[1]=P[3] ;\n   8:L PR[1] 9mm/sec FINE ;",
        &(usual("1:\"a]b\"")
            + &joints("2")
            + &usual("3").replace("};", "   GP2:\n\tUF : F, UT : F,\n\tJ1= 1.0 mm\n};")),
    )
}

#[test]
fn text_without_end_stays_linear() {
    for open in [
        "P[",
        "P[1",
        "[",
        "J P[",
        "'",
        "P['",
        "! ",
        "/",
        " /",
        "\n/",
        ": ",
        ";",
        "1:",
        "\n1:",
        "CALL ",
        "LBL[1] ;\n",
    ] {
        let deep = open.repeat(300_000);
        let _ = read_files(&[("a", &listing(&deep, ""))]);
        let _ = read_files(&[("a", &listing("", &deep))]);
        let _ = read_files(&[("a", &format!("/PROG {deep}"))]);
        let _ = read_files(&[("a", &format!("[*SYSTEM*]$MNUTOOL  Storage: X\n{deep}"))]);
    }
}

#[test]
fn many_points_and_moves_stay_linear() {
    let points: String = (1..=3000).map(|k| usual(&k.to_string())).collect();
    let doubled = points.clone() + &points;
    let moves = "L P[R[1]] 9mm/sec FINE ;\nA P[1] 9mm/sec FINE INC ;\nX P[R[1]] ;\n".repeat(300);
    let program = read(&moves, &doubled);
    assert!(program.targets.iter().all(|target| target.blocked));
}
