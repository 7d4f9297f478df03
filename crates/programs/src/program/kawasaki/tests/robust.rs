//! Broken text.

use super::*;

/// What mutations cut, and put in its place.
const MUTATIONS: [(usize, &str); 25] = [
    (1, ""),
    (40, ""),
    (0, "\n"),
    (0, "\r"),
    (0, "\n.END\n"),
    (0, "\n.PROGRAM b(.a)\n"),
    (0, "\n.TRANS\n"),
    (0, "\n.JOINTS\n"),
    (0, "#"),
    (0, "["),
    (0, ")"),
    (0, ","),
    (0, "+"),
    (0, "-"),
    (0, ";"),
    (0, "\""),
    (0, " TRANS("),
    (0, " SHIFT("),
    (0, "\nEND\n"),
    (0, "\nHERE p1\n"),
    (0, "&"),
    (0, "="),
    (0, "\nSCALL $n\n"),
    (0, "\nJUMP a\n"),
    (0, "\nONI 1 GOTO 2\n"),
];

const SAMPLE: &str = ".PROGRAM a(.p)\nTOOL grip\nBASE NULL\nJMOVE #home\nIF x THEN\nLMOVE \
    p1+off\nEND\nCASE n OF\nVALUE 1:\nC1MOVE p[1]\nC2MOVE p[i]\n\
    ANY:\nLAPPRO SHIFT(p1 BY 1,2,3),5\nEND\nLDEPART 3\nCALL a(p1)\nLMOVE TRANS(1,2,3,4,5,6)\nJOINT \
        SPEED9 TOOL1 #[1,2,3,4,5,6]\n.END\n";

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]

    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(0_u8..=255, 0..400)) {
        let mut text = b".PROGRAM a()\n".to_vec();
        text.extend(bytes);
        let source = Source::new("x", text);
        let _ = Kawasaki.recognises(&source);
        let _ = crate::motion::read(&Kawasaki, &[source], &Settings::default());
    }

    #[test]
    fn mutated_programs_never_panic(
        changes in proptest::collection::vec((0_usize..2000, proptest::sample::select(&MUTATIONS[..])), 1..6)
    ) {
        let mut bytes = format!("{SAMPLE}{POINTS}").into_bytes();
        for (at, (cut, text)) in changes {
            let at = at % bytes.len().max(1);
            let end = (at + cut).min(bytes.len());
            bytes.splice(at..end, text.bytes());
        }
        let source = Source::new("x", bytes);
        let _ = Kawasaki.recognises(&source);
        let marker = Marker { version: "1".into(), profile_sha256: "a".into(), source_sha256: "b".into(), decided: Vec::new() };
        let (at, _) = Kawasaki.mark(&source, &marker);
        assert!(at <= source.bytes.len());
        if let Ok(program) = crate::motion::read(&Kawasaki, std::slice::from_ref(&source), &Settings::default()) {
            for number in &program.numbers {
                assert_eq!(crate::program::number::parse(number.text(&source.bytes)), Some(number.value));
            }
        }
    }
}
