//! Moves between those of a program.

use super::*;
use crate::program::{Between, Insertion};

fn numbers(first: &str) -> Vec<Vec<u8>> {
    [first, "2", "3", "4", "5", "6"]
        .map(|number| number.as_bytes().to_vec())
        .into()
}

/// A program whose move has these targets before its own; nothing where it cannot be repeated.
fn with(code: &str, motion: usize, between: Vec<Between>) -> Option<String> {
    let text = format!(".PROGRAM main()\n{code}\n.END\n{POINTS}");
    let source = Source::new("x.as", text.clone().into());
    let sources = [source];
    let program =
        crate::motion::read(&Kawasaki, &sources, &Settings::default()).expect("a program");
    let insertion = Insertion {
        motion,
        between,
        own: None,
    };
    let mut inserted = Kawasaki.insert(&Insertions {
        sources: &sources,
        program: &program,
        file: 0,
        list: &[insertion],
    });
    let mut changes = inserted.moves.pop().expect("one move")?;
    changes.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
    let mut bytes = text.into_bytes();
    for (range, with) in changes {
        bytes.splice(range, with);
    }
    let text = String::from_utf8(bytes).expect("a text");
    let (code, _) = text.split_once("\n.END").expect("the end");
    Some(code.replace(".PROGRAM main()\n", ""))
}

fn with_one(code: &str, motion: usize) -> Option<String> {
    let one = Between {
        via: None,
        end: numbers("1"),
    };
    with(code, motion, vec![one])
}

#[test]
fn only_the_last_piece_has_the_clamp_and_each_its_own_settings() {
    let found = with_one(
        "TOOL NULL\nJMOVE #home\n  SPEED 10 MM/S ; slow\n  ACCURACY 1\n  LMOVE p1,-1",
        1,
    );
    let expected = "TOOL NULL\nJMOVE #home\n  SPEED 10 MM/S ; slow\n  ACCURACY 1\n  LMOVE \
        TRANS(1,2,3,4,5,6)\n  SPEED 10 MM/S\n  ACCURACY 1\n  LMOVE p1,-1";
    assert_eq!(found.as_deref(), Some(expected));
    let found = with_one("JMOVE #home,1\nSPEED 10 ALWAYS\nLMOVE p1,-1", 1);
    let expected = "JMOVE #home,1\nSPEED 10 ALWAYS\nLMOVE TRANS(1,2,3,4,5,6)\nLMOVE p1,-1";
    assert_eq!(found.as_deref(), Some(expected));
    // nobody knows with what each run of the move goes
    for code in [
        "JMOVE #home\nIF x THEN\nSPEED 10\nEND\nLMOVE p1",
        "JMOVE #home\nSPEED 10\n5\nLMOVE p1",
        "JMOVE #home\nSPEED 10\nSPEED 20 ALWAYS\nLMOVE p1",
        "JMOVE #home\nSPEED 10\nIF x GOTO 5\n5\nLMOVE p1",
        "JMOVE #home\nON 1 GOTO 5\n5\nLMOVE p1\nSPEED 10\nLMOVE p[1]",
        "JMOVE #home\nCALL slow\nLMOVE p1\n.END\n.PROGRAM slow()\nSPEED 10",
        // a time is that of the whole move
        "JMOVE #home\nSPEED 5 S\nLMOVE p1",
        "SPEED 5S ALWAYS\nJMOVE #home\nLMOVE p1",
        // it asks for what is left of the move
        "JMOVE #home\nLMOVE p1\nSIGNAL 3\nMVWAIT 100mm",
    ] {
        assert_eq!(with_one(code, 1), None, "{code}");
    }
    for code in [
        // a pause uses it up
        "JMOVE #home\nSPEED 10\nDELAY 1\nLMOVE p1",
        "JMOVE #home\nIF x THEN\nSPEED 10 MM/S\nLMOVE p1\nEND\nLMOVE p[1]",
        "JMOVE #home\nSPEED 5 S ALWAYS\nSPEED 10 MM/S\nLMOVE p1",
        "JMOVE #home\n10\nLMOVE p1\nGOTO 10",
    ] {
        let found = with_one(code, 1).expect(code);
        let times = |text: &str| text.matches("SPEED 10 MM/S\n").count();
        assert_eq!(times(&found), 2 * times(code), "{found}");
    }
}

#[test]
fn arcs_are_cut_with_the_settings_of_both_statements() {
    let piece = |via: &str, end: &str| Between {
        via: Some(numbers(via)),
        end: numbers(end),
    };
    let pieces = || vec![piece("11", "12"), piece("13", "14")];
    let code = "JMOVE #home\nSPEED 10\nC1MOVE p[1]\nACCURACY 1\nC2MOVE p[2],1";
    let expected = "JMOVE #home\nSPEED 10\nC1MOVE TRANS(11,2,3,4,5,6)\nACCURACY 1\nC2MOVE \
        TRANS(12,2,3,4,5,6)\nSPEED 10\nC1MOVE TRANS(13,2,3,4,5,6)\nACCURACY 1\nC2MOVE p[2],1";
    assert_eq!(with(code, 2, pieces()).as_deref(), Some(expected));
    // the clamp would act at another point of the arc
    let code = "JMOVE #home\nC1MOVE p[1],1\nC2MOVE p[2]";
    assert_eq!(with(code, 2, pieces()), None);
    // and so would the signal
    let code = "JMOVE #home\nC1MOVE p[1]\nSIGNAL 5\nC2MOVE p[2]";
    assert_eq!(with(code, 2, pieces()), None);
}
