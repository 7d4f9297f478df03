//! Broken text.

use super::super::data::read as data_of;
use super::*;

/// What mutations cut, and put in its place.
const MUTATIONS: [(usize, &str); 22] = [
    (1, ""),
    (40, ""),
    (0, "<"),
    (0, ">"),
    (0, "\""),
    (0, "/>"),
    (0, "]]>"),
    (0, "<!--"),
    (0, "&quot;"),
    (0, "&"),
    (0, "\n"),
    (0, "("),
    (0, "]"),
    (0, ",,"),
    (0, "appro("),
    (0, "compose(pA,fA,"),
    (0, " key=\"1\""),
    (0, " x=\"1e400\""),
    (0, " fatherId=\"fB[0]\""),
    (0, "break\n"),
    (0, "endIf\n"),
    (0, "pA=pB\n"),
];

#[test]
fn an_attribute_that_stands_twice_is_refused() {
    for twice in [
        "x=\"1\" y=\"2\" x=\"1\"",
        "x=\"1\" note=\"\" y=\"2\" note=\"\"",
    ] {
        let value = format!("<Value key=\"0\" {twice} />");
        let text = dtx(&format!(
            "<Data name=\"pA\" type=\"pointRx\">{value}</Data>"
        ));
        assert!(data_of(text.as_bytes(), 0, 0).is_err(), "{twice}");
    }
    // letters that are alike are no names that are
    let value = "<Value key=\"0\" x=\"1\" ab=\"\" fW=\"\" ba=\"\" />";
    let text = dtx(&format!(
        "<Data name=\"pA\" type=\"pointRx\">{value}</Data>"
    ));
    assert!(data_of(text.as_bytes(), 0, 0).is_ok());
}

#[test]
fn numbers_of_one_value_in_two_tags_are_refused() {
    // the second tag has no y: that of the first would be written where the second ends
    let values =
        "<valuePoint index=\"0\"><tpValue x=\"1\" y=\"2\" /><tpValue x=\"3\" /></valuePoint>";
    let sides = "<valuePoint index=\"0\"><tpValue x=\"1\" /><cpValue wrist=\"wpositive\" \
        /><cpValue wrist=\"wfree\" /></valuePoint>";
    for text in [values, sides] {
        let text = dtx(&format!("<point name=\"pA\">{text}</point>"));
        let error = data_of(text.as_bytes(), 0, 0).expect_err("two tags");
        assert!(
            format!("{error:?}").contains("one tag with the numbers"),
            "{error:?}"
        );
    }
}

#[test]
fn values_that_may_be_read_in_two_ways_are_refused() {
    let point = |values: &[&str]| data("pA", "pointRx", values);
    let old = |inside: &str| format!("<point name=\"pA\">{inside}</point>");
    let father = "<pFather alias=\"\" name=\"fP\" fatherIndex=\"0\" />";
    let place = "<tpValue x=\"1\" /><cpValue wrist=\"wsame\" />";
    let value = format!("<valuePoint index=\"0\">{place}</valuePoint>");
    for (text, line, expected) in [
        (
            point(&["key=\"0\" wrist=\"wnegativ\""]),
            4,
            "wpositive, wnegative",
        ),
        (
            point(&["key=\"0\" elbow=\"wfree\""]),
            4,
            "epositive, enegative",
        ),
        (point(&["key=\"0\" shoulder=\"\""]), 4, "lefty, righty"),
        (
            point(&["key=\"1\" x=\"1\"", "key=\"1\" x=\"2\""]),
            5,
            "a key that no",
        ),
        (
            point(&["key=\"0,1\" x=\"1\"", "key=\"0, 1\" x=\"2\""]),
            5,
            "a key that no",
        ),
        (old(&format!("{value}{value}")), 3, "a key that no"),
        (
            old(&format!("<valuePoint>{father}{place}</valuePoint>")),
            3,
            "one father",
        ),
        (old(&format!("{value}{father}")), 3, "one father"),
        (old(&format!("{father}{father}{value}")), 3, "one father"),
    ] {
        let text = dtx(&text);
        let files = [
            ("m/m.dtx", text.clone()),
            ("m/start.pgx", pgx("start", "", "")),
        ];
        let error = read_files(&files).expect_err(&text).to_string();
        let place = format!("m/m.dtx:{line}:");
        assert!(
            error.starts_with(&place) && error.contains(expected),
            "{error}"
        );
    }
    let sides = "shoulder=\"same\" elbow=\"efree\" wrist=\"wsame\"";
    for text in [
        old(&format!("{father}{value}")),
        point(&[&format!("key=\"0\" x=\"1\" {sides}"), "key=\"1\" x=\"2\""]),
        // fields of a structure have keys of their own
        data("sA", "Structure", &["key=\"0\"", "key=\"0\""]),
    ] {
        data_of(dtx(&text).as_bytes(), 0, 0).expect(&text);
    }
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]

    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(0_u8..=255, 0..400)) {
        let mut text = b"<Database xmlns=\"http://www.staubli.com/robotics/VAL3/Data/2\">".to_vec();
        text.extend(bytes);
        let source = Source::new("x", text);
        let _ = Val3.recognises(&source);
        let _ = crate::motion::read(&Val3, &[source], &Settings::default());
    }

    #[test]
    fn mutated_projects_never_panic(
        changes in proptest::collection::vec((0_usize..4000, proptest::sample::select(&MUTATIONS[..])), 1..6)
    ) {
        let points = data("fA", "frame", &[FRAME, "key=\"1\" fatherId=\"fA[1]\""])
            + &data("tA", "tool", &[TOOL])
            + &data("pA", "pointRx", &["key=\"0\" y=\"1\" rx=\"180\" wrist=\"wpositive\" \
                fatherId=\"fA[0]\"", "key=\"1\" x=\"2\""])
            + &data("pB", "pointRx", &["key=\"0\" x=\"2\" fatherId=\"fA[1]\""])
            + &data("jA", "jointRx", &["key=\"0\" j2=\"20\""]);
        let code = "movej(jA,tA,m)\nif \
            bOn==true\nmovel(appro(pA,{0,0,-1,0,0,0}),tA,m)\nendIf\nswitch nN\ncase \
            1\nmovec(pA[1],pB,tA,m)\n\
            break\ndefault\npB=compose(pA[nI],fA,trA)\nendSwitch\nwhile true\ncall \
                start()\nendWhile";
        let texts = [dtx(&points), pgx("start", "", code)];
        let mut bytes = texts.map(String::into_bytes);
        for (at, (cut, text)) in changes {
            let bytes = &mut bytes[at % 2];
            let at = at % bytes.len().max(1);
            let end = (at + cut).min(bytes.len());
            bytes.splice(at..end, text.bytes());
        }
        let [data, program] = bytes;
        let sources = [Source::new("m.dtx", data), Source::new("start.pgx", program)];
        let marker = Marker { version: "1".into(), profile_sha256: "a".into(), source_sha256: "b".into(), decided: Vec::new() };
        for source in &sources {
            let _ = Val3.recognises(source);
            let (at, _) = Val3.mark(source, &marker);
            assert!(at <= source.bytes.len());
        }
        if let Ok(program) = crate::motion::read(&Val3, &sources, &Settings::default()) {
            for target in &program.targets {
                let numbers = program.numbers_of(target);
                assert_eq!(numbers.len(), Val3.roles(target.layout).len());
                let bytes = &sources[target.file as usize].bytes;
                for (number, role) in numbers.iter().zip(Val3.roles(target.layout)) {
                    if *role != Role::Configuration {
                        assert_eq!(crate::program::number::parse(number.text(bytes)), Some(number.value));
                    }
                }
            }
        }
    }
}
