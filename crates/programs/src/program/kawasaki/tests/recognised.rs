//! Files that are called as programs of this language.

use crate::program::kawasaki::Kawasaki;
use crate::program::{Language, Settings, Source};

/// What a save holds before its programs.
fn settings(lines: usize) -> String {
    let values = "ZSET 1 2 3 4 5 6 7 8 9\n".repeat(lines);
    format!(".*=== AS GROUP ===\n.NETCONF 192.168.0.2,\"x\"\n.ROBOTDATA1\n{values}.END\n")
}

#[test]
fn programs_that_move_nothing_are_recognised_by_their_ending() {
    for (text, is_accepted, is_recognised) in [
        (".PROGRAM sub()\n x = 1\n.END\n", true, false),
        (".PROGRAM sub()\n moves = 1\n.END\n", true, false),
        // V+
        (".PROGRAM a()\n MOVES p1\n.END\n", false, false),
        (".PROGRAM a()\n10 APPRO p1, 50\n.END\n", false, false),
        (".PROGRAM sub()\n x = 1\n", false, false),
        (".x = 1\n", false, false),
        ("x = 1\n", false, false),
    ] {
        let source = Source::new("x.as", text.into());
        assert_eq!(Kawasaki.accepts(&source), is_accepted, "{text}");
        assert_eq!(Kawasaki.recognises(&source), is_recognised, "{text}");
    }
}

#[test]
fn saves_are_recognised_however_late_their_programs_stand() {
    let programs = ".PROGRAM a()\nTOOL NULL\nBASE NULL\nJMOVE #[0,0,-90,0,-60,0]\n.END\n";
    for lines in [0, 2000, 20_000] {
        for front in [settings(lines), "; a comment of a transfer\n".repeat(lines)] {
            let source = Source::new("x", (front + programs).into());
            assert!(Kawasaki.recognises(&source), "{lines}");
        }
    }
    // parts of a save, which hold no programs
    for part in [
        ".AUXDATA\nA 1\n.END\n",
        ".SYSDATA\nB 1\n.END\n",
        ".NETCONF2 1.2.3.4\n",
        &settings(3),
    ] {
        let source = Source::new("x", part.into());
        assert!(Kawasaki.recognises(&source), "{part}");
        let read = Kawasaki.script(&[source], &Settings::default());
        assert!(read.is_ok(), "{part}");
    }
    // cut inside what it is set to
    let whole = settings(9);
    let cut = Source::new("x.as", whole[..whole.len() - 9].into());
    let error = Kawasaki.script(&[cut], &Settings::default());
    let error = error.expect_err("no end").to_string();
    assert!(error.contains("x.as:3:1"), "{error}");
}
