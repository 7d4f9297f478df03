//! Broken and huge text.

use super::*;

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]

    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(0_u8..=255, 0..400)) {
        let source = Source::new("x", bytes);
        let _ = Rapid.recognises(&source);
        let _ = motion::read(&Rapid, &[source], &Settings::default());
    }

    #[test]
    fn mutated_programs_never_panic(
        changes in proptest::collection::vec((0_usize..2000, proptest::sample::select(&MUTATIONS[..])), 1..6)
    ) {
        let mut bytes = SAMPLE.as_bytes().to_vec();
        for (at, (cut, text)) in changes {
            let at = at % bytes.len().max(1);
            let end = (at + cut).min(bytes.len());
            bytes.splice(at..end, text.bytes());
        }
        let source = Source::new("x", bytes);
        let _ = Rapid.recognises(&source);
        let marker = Marker { version: "1".into(), profile_sha256: "a".into(), source_sha256: "b".into(), decided: Vec::new() };
        let (at, _) = Rapid.mark(&source, &marker);
        assert!(at <= source.bytes.len());
        if let Ok(program) = motion::read(&Rapid, std::slice::from_ref(&source), &Settings::default()) {
            for number in &program.numbers {
                let start = number.start as usize;
                let text = &source.bytes[start..start + usize::from(number.length)];
                assert_eq!(crate::program::number::parse(text), Some(number.value));
            }
            for target in &program.targets {
                let count = target.numbers.len();
                assert!(count == Rapid.roles(target.layout).len() || (count == 0 && target.blocked));
            }
        }
    }
}

/// What mutations cut, and put in its place.
const MUTATIONS: [(usize, &str); 22] = [
    (1, ""),
    (40, ""),
    (0, "["),
    (0, "]"),
    (0, "{"),
    (0, ")"),
    (0, "\""),
    (0, "!"),
    (0, ";"),
    (1, ","),
    (0, "\\"),
    (0, ":="),
    (0, "%"),
    (0, "9E9"),
    (0, "1e400"),
    (0, "-"),
    (0, "ENDPROC"),
    (0, "IF a "),
    (0, "Offs("),
    (0, "\r"),
    (0, "MODULE x"),
    (0, "LOCAL "),
];

const SAMPLE: &str = "%%%\n VERSION:1\n%%%\nMODULE m(SYSMODULE)\nLOCAL CONST robtarget \
    p{2}:=[[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],q];\n\
    PERS robtarget q:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
    TASK PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1.5,[0,0,50],[1,0,0,0],0,0,0]];\n\
    PERS wobjdata w:=[FALSE,TRUE,\"\",[[100,0,0],[1,0,0,0]],[[10,0,0],[1,0,0,0]]];\n\
    PROC main(robtarget a, \\switch on | num x)\n IF di1=1 MoveL p{1}, v100,\\Z:=3, \
        z10,t\\WObj:=w;\n w.uframe:=[[1,2,3],[1,0,0,0]];\n\
    MoveC Offs(q,1,-2,3),RelTool(Offs(q,0,0,1),1,2,3\\Rx:=90),v100,z10,t\\WObj:=w;\n\
    MoveAbsJ [[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v100,z10,t;\n \
        SearchL\\Stop,d,q,p{i},v1,t;\n\
    PDispOn q,t;\n sub q;\n FOR i FROM 1 TO 2 DO\n lab: GOTO lab;\n ENDFOR\n TPWrite \"x\"\"y\";\n \
        %\"a\"%;\nERROR\n RETRY;\nENDPROC\nENDMODULE\n";

#[test]
fn brackets_without_end_do_not_overflow_the_stack() {
    for open in [
        "[",
        "(",
        "{",
        "Offs(",
        "RelTool(Offs(",
        "[[",
        "IF (",
        "-",
        "\\a:=",
        "x{",
        "[[[1,2,3]",
    ] {
        let deep = open.repeat(200_000);
        for text in [
            format!("MODULE m\nPROC a()\nMoveL {deep}"),
            format!("MODULE m\nCONST robtarget p:={deep}"),
            format!("MODULE m\nCONST robtarget p{{2,2}}:={deep}"),
            format!("MODULE m\nPERS tooldata t:={deep}"),
            format!("MODULE m\nPROC a()\n w.uframe:={deep};\nENDPROC\nENDMODULE"),
        ] {
            let _ = read_files(&[&text]);
        }
    }
}

#[test]
fn many_uses_of_large_arrays_stay_linear() {
    let elements = vec![format!("[[1,2,3],[1,0,0,0],{CONF}"); 3000].join(",");
    let moves = "MoveL Offs(p{i},0,0,5),v5,z5,t;\np{i}.trans.x:=1;\nMoveL p{i},v5,z5,tools{k};\n"
        .repeat(3000);
    let text = format!(
        "MODULE m\nPERS robtarget p{{3000}}:=[{elements}];\nPROC a()\n{moves}ENDPROC\nENDMODULE"
    );
    let program = read(&text);
    assert_eq!(program.targets.len(), 3000);
    assert!(
        (490_000..500_000).contains(&program.moves.len()),
        "the most that are listed"
    );
    assert_eq!(
        program.findings.len(),
        6001,
        "each target once for each cause, and that there are more uses"
    );
}

#[test]
fn what_is_behind_numbers_that_are_written_often_is_looked_up_once() {
    // each move asks for all that is written into x: a minute for so many where each looks itself
    let moves = "x:=x+0.5;\nMoveL [[x,0,4],[1,0,0,0],CONF,v5,z5,t;\n".replace("CONF", CONF);
    let program = read(&format!(
        "MODULE m\nVAR num x:=0;\nPROC a()\n{}ENDPROC\nENDMODULE",
        moves.repeat(20_000)
    ));
    assert_eq!(program.moves.len(), 20_000);
    assert!(program.moves.iter().all(|of| of.target.is_none()));
}

#[test]
fn more_uses_of_arrays_than_are_listed_are_an_error_that_says_so() {
    let elements = vec![format!("[[1,2,3],[1,0,0,0],{CONF}"); 1000].join(",");
    let moves: String = (0..600)
        .map(|z| format!("MoveL Offs(p{{i}},0,0,{z}),v5,z5,t;\n"))
        .collect();
    let text = format!(
        "MODULE m\nPERS robtarget p{{1000}}:=[{elements}];\nPROC a()\n{moves}ENDPROC\nENDMODULE"
    );
    let program = read(&text);
    assert_eq!(program.moves.len(), 500_000);
    let ids: Vec<_> = program.findings.iter().map(|finding| finding.id).collect();
    assert_eq!(ids, ["too-many-uses"]);
    assert_eq!(program.findings[0].line, 4 + 500);
}
