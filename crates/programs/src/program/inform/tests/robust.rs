//! Broken and huge text.

use super::*;

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]

    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(0_u8..=255, 0..400)) {
        let source = Source::new("x", bytes);
        let _ = Inform.recognises(&source);
        let _ = crate::motion::read(&Inform, &[source], &Settings::default());
    }

    #[test]
    fn mutated_jobs_never_panic(
        changes in proptest::collection::vec((0_usize..2000, proptest::sample::select(&MUTATIONS[..])), 1..6)
    ) {
        let mut bytes = SAMPLE.as_bytes().to_vec();
        for (at, (cut, text)) in changes {
            let at = at % bytes.len().max(1);
            let end = (at + cut).min(bytes.len());
            bytes.splice(at..end, text.bytes());
        }
        let source = Source::new("x", bytes);
        let _ = Inform.recognises(&source);
        let marker = Marker { version: "1".into(), profile_sha256: "a".into(), source_sha256: "b".into(), decided: Vec::new() };
        let (at, _) = Inform.mark(&source, &marker);
        assert!(at <= source.bytes.len());
        if let Ok(program) = crate::motion::read(&Inform, std::slice::from_ref(&source), &Settings::default()) {
            for number in &program.numbers {
                let start = number.start as usize;
                let text = &source.bytes[start..start + usize::from(number.length)];
                assert_eq!(crate::program::number::parse(text), Some(number.value));
            }
            for target in &program.targets {
                let count = target.numbers.len();
                assert!(count == Inform.roles(target.layout).len() || (count == 0 && target.blocked));
                let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
                if count > 0 {
                    let _ = Inform.decode(target.layout, &numbers, &Settings::default());
                }
            }
        }
    }
}

/// What mutations cut, and put in its place.
const MUTATIONS: [(usize, &str); 26] = [
    (1, ""),
    (40, ""),
    (0, "/"),
    (0, "\n"),
    (0, "\r"),
    (0, "/JOB\n"),
    (0, "\nEND\n"),
    (0, "\n//INST\n"),
    (0, "\n///PULSE\n"),
    (0, "\n///RECTAN\n"),
    (0, "\n///POSTYPE TOOL\n"),
    (0, "9E9"),
    (0, "1e400"),
    (0, "-"),
    (0, ","),
    (0, "="),
    (0, "'"),
    (0, "*"),
    (0, "+MOVL P018 "),
    (0, "\nCALL JOB:A\n"),
    (0, "\nSFTON P001\n"),
    (0, "\nENDIF\n"),
    (0, "P[B000] "),
    (0, "\u{ff}"),
    (0, "\nSET P018 LP001\n"),
    (0, "\nGETARG P018 IARG#(1)\n"),
];

const SAMPLE: &str = "/JOB\n//NAME A\n//POS\n///NPOS 3,1,1,1,0,0\n///TOOL 0\n///POSTYPE \
    PULSE\n///PULSE\n\
    C00000=1,2,3,4,5,6\nBC00000=0\nEC00000=1,2\n///USER 1\n///POSTYPE USER\n///RECTAN\n///RCONF \
        1,0,0,0,0,0,0,0\n\
    C00001=1.0,2.0,3.0,4.0,5.0,6.0\nC00002=1,2,3,4,5,6,7\nP00018=1,2,3,4,5,6\n//INST\n///DATE \
        x\n///LVARS 1,0,0,0,0,0,0,0\n\
    LB000 n\nNOP\n*LOOP\nMOVJ C00000 VJ=5.0\nMOVL C00001 BC00000 V=5\nMOVC C00002 V=5 +MOVJ \
        EC00000\nSFTON P001 UF#(1)\n\
    IFTHEN IN#(1)=ON\nMOVL P018 V=5\nELSE\nSMOVL C00001 +MOVL C00002\nENDIF\nSFTOF\nSETE P018 (1) \
        5\nIMOV P018 V=5\n\
    MFRAME UF#(2) P001 P002 P003\nSETTOOL TL#(0) PX001\nCALL JOB:A IF IN#(2)=ON\nJUMP \
        *LOOP\nRET\nEND\n";

#[test]
fn a_chain_of_jobs_that_hand_on_a_shift_stays_linear_and_safe() {
    let count = 3000;
    let mut text = String::new();
    for k in 0..count {
        // each is called by the one behind it
        let name = format!("//NAME J{}", count - k);
        let call = format!("CALL JOB:J{}\nMOVL C00000", count - k + 1);
        let first = if k + 1 == count { "SFTON P000\n" } else { "" };
        let one = job(&format!("{USER}{}", points(1)), &format!("{first}{call}"));
        text += &one.replace("//NAME A", &name);
    }
    let program = read(&text);
    assert_eq!(program.moves.len(), count);
    assert!(program.targets.iter().all(|target| target.blocked));
}

#[test]
fn long_lines_and_many_blocks_are_read() {
    let text = job(USER, &"IFTHEN\n".repeat(100_000));
    assert_eq!(read(&text).moves.len(), 0);
    let text = job(
        &format!("{USER}C00000={P6}{}", ",1".repeat(100_000)),
        "MOVL C00000",
    );
    let error = read_files(&[&text], &Settings::default()).expect_err("too many numbers");
    assert!(error.to_string().len() < 300, "{error}");
    let text = job(USER, &format!("MOVL {}", "+MOVL ".repeat(100_000)));
    let _ = read(&text);
    let long = format!("{USER}C00000={}1,2,3,4,5,6", "0".repeat(100_000));
    assert!(read_files(&[&job(&long, "MOVL C00000")], &Settings::default()).is_err());
}
