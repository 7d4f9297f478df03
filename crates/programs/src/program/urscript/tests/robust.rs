//! Broken and huge text.

use super::*;
use std::fmt::Write;

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(256))]

    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(0_u8..=255, 0..400)) {
        let source = Source::new("x", bytes);
        let _ = UrScript.recognises(&source);
        let _ = read_sources(&[source]);
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
        let _ = UrScript.recognises(&source);
        let marker = Marker { version: "1".into(), profile_sha256: "a".into(), source_sha256: "b".into(), decided: Vec::new() };
        let (at, _) = UrScript.mark(&source, &marker);
        assert!(at <= source.bytes.len());
        if let Ok(program) = read_sources(std::slice::from_ref(&source)) {
            for number in &program.numbers {
                let start = number.start as usize;
                let text = &source.bytes[start..start + usize::from(number.length)];
                assert_eq!(crate::program::number::parse(text), Some(number.value));
            }
            for target in &program.targets {
                let count = target.numbers.len();
                assert!(count == 6 || (count == 0 && target.blocked));
            }
            let targets = program.targets.iter().map(|target| target.offset);
            assert!(targets.is_sorted());
            assert!(program.moves.iter().all(|used| used.target.is_none_or(|t| t < program.targets.len())));
        }
    }
}

/// What mutations cut, and put in its place.
const MUTATIONS: [(usize, &str); 22] = [
    (1, ""),
    (40, ""),
    (0, "["),
    (0, "]"),
    (0, "("),
    (0, ")"),
    (0, "\""),
    (0, "#"),
    (0, "$"),
    (1, ","),
    (0, "="),
    (0, "1e400"),
    (0, "-"),
    (0, "\nend\n"),
    (0, "\nif a:\n"),
    (0, "pose_trans("),
    (0, "\r"),
    (0, "\ndef x():\n"),
    (0, "global "),
    (0, "d2r("),
    (0, "movel(p["),
    (0, "get_inverse_kin("),
];

const SAMPLE: &str = "def P():\n set_tcp(p[0,0,.1,0,0,0])\n set_payload(1.5,[0,0,.05])\n global \
    W_p=p[.4,-.4,.5,1.5,.5,.53]\n global W_q=[1,-1,1,0,1,1E-4]\n\
    thread T():\n  run T()\n end\n def sub(x, y):\n  local z=x[2]+1\n  movel(x)\n  if z==1:\n   \
        return 1\n  elif z>2: halt\n  else:\n   set_tcp(y)\n  end\n end\n\
    $ 3 \"a\"\n while (True):\n  movej(get_inverse_kin(W_p,qnear=W_q),a=1,v=1)\n  \
        movec(p[1,2,3,0,0,0],W_p,mode=1)\n  W_p[2]=.4\n  f=pose_trans(W_p,p[0,0,1,0,0,0])\n\
    movel(pose_add(f,p[d2r(1),0,0,d2r(1),d2r(2),d2r(3)]))\n  movej([d2r(1),d2r(2),d2r(3),d2r(4),d2r(5),d2r(6)])\n  break\n end\n sub(W_p,p[1,2,3,0,0,0])\n textmsg(\"x\")\nend\nP()\n";

#[test]
fn brackets_without_end_do_not_overflow_the_stack() {
    for open in [
        "[",
        "(",
        "p[",
        "movel(",
        "pose_trans(",
        "movel(p[",
        "get_inverse_kin(",
        "f(",
        "x[",
        "if (",
        "d2r(",
        "-",
    ] {
        let deep = open.repeat(200_000);
        for text in [
            format!("def m():\nmovel({deep}"),
            format!("def m():\nx={deep}"),
            format!("def m():\nset_tcp({deep}"),
            format!("{deep}\nmovel({deep}"),
        ] {
            let _ = read_file(text.as_bytes());
        }
    }
    for open in ["def a():\n", "if a:\n", "while a:\n", "thread a():\n"] {
        let _ = read_file(open.repeat(200_000).as_bytes());
    }
}

#[test]
fn many_uses_and_names_stay_linear() {
    let mut text = String::from("def m():\n");
    for k in 0..20_000 {
        let _ = writeln!(
            text,
            "v{k}=v{}\nw{k}=p[1,2,3,0,0,0]\nmovel(pose_trans(w{k},v{k}))",
            k + 1
        );
    }
    for k in 0..2_000 {
        let _ = writeln!(
            text,
            "def f{k}():\nf{}()\nset_tcp(p[{k},0,0,0,0,0])\nmovel(q)\nend\nf{k}()",
            k + 1
        );
    }
    text += "end\n";
    let started = std::time::Instant::now();
    let program = read(&text);
    assert_eq!(program.instructions.len(), 22_000);
    assert!(started.elapsed().as_secs() < 5);
}
