//! Long rows of moves are walked in parts side by side: on one processor and on several everything
//! that is found is the same.

use super::{BACKLASH, PLAIN, given, profile};
use poseshift::compensate::compensate;
use poseshift::geometry::units::{DEG, mm_from_m};
use poseshift::model::Conditions;
use poseshift::model::profile::Mounted;
use poseshift::program::{Source, language_of};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::fmt::Write;

const MOVES: usize = 9_000;

/// What moves do besides going on in small steps.
#[derive(Clone, Copy, Debug)]
struct Kind {
    /// The wrist goes from one side to the other.
    flips: bool,
    /// Joint 6 goes on and on, beyond its limit and back by joint moves.
    winds: bool,
    /// One in so many moves is an arc, a step from where the robot stands, or joints.
    others: Option<u32>,
}

/// A KRL program along joints that go on from move to move.
fn program(kind: Kind, seed: u64) -> String {
    let mut random = StdRng::seed_from_u64(seed);
    let arm = profile(&[]).controller_model(&Mounted::flange());
    let mut text =
        "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nPTP {A1 0,A2 10,A3 10,A4 20,A5 50,A6 0}\n"
            .to_owned();
    let mut q: [f64; 6] = [0.0, 10.0, 10.0, 20.0, 50.0, 0.0];
    let low = [
        -90.0,
        -20.0,
        -20.0,
        -60.0,
        if kind.flips { -60.0 } else { 25.0 },
        -90.0,
    ];
    let high = [90.0, 50.0, 40.0, 60.0, 80.0, 90.0];
    let mut by = [0.0; 6];
    for at in 0..MOVES {
        for i in 0..6 {
            // joints keep their direction for a while
            if random.random_ratio(1, 20) {
                by[i] = random.random_range(-1.5..1.5);
            }
            q[i] += by[i];
            if i < 5 || !kind.winds {
                q[i] = q[i].clamp(low[i], high[i]);
            }
        }
        if kind.winds && q[5].abs() > 350.0 {
            q[5] = 0.0;
            let [a, b, c, d, e, f] = q;
            writeln!(
                text,
                "PTP {{A1 {a:.4},A2 {b:.4},A3 {c:.4},A4 {d:.4},A5 {e:.4},A6 {f:.4}}}"
            )
            .expect("text");
        }
        let pose = arm.forward(&q.map(|q| q * DEG), &Conditions::default());
        let [x, y, z] = pose.translation.map(mm_from_m);
        let [a, b, c] = pose.rotation.rzryrx(0.0).map(|angle| angle / DEG);
        let pose = format!("X {x:.4},Y {y:.4},Z {z:.4},A {a:.5},B {b:.5},C {c:.5}");
        let is_other = kind
            .others
            .is_some_and(|one_in| random.random_ratio(1, one_in));
        match (is_other, at % 3) {
            (false, _) => writeln!(text, "LIN {{{pose}}}"),
            (true, 0) => writeln!(
                text,
                "CIRC {{X {:.4},Y {:.4},Z {z:.4},A {a:.5},B {b:.5},C {c:.5}}},{{{pose}}}",
                x + 7.0,
                y - 4.0
            ),
            (true, 1) => writeln!(text, "LIN_REL {{X 0.5,Z -0.25}}\nLIN {{{pose}}}"),
            (true, _) => writeln!(text, "PTP {{{pose}}}"),
        }
        .expect("text");
    }
    text + "END\n"
}

/// What is found, and the new bytes.
fn found(effect: &str, text: &str, processors: usize) -> String {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(processors);
    let pool = pool.build().expect("threads");
    pool.install(|| {
        let sources = [Source::new("t.src", text.as_bytes().to_vec())];
        let language = language_of(&sources[0]).expect("a language");
        let done = compensate(language, &sources, &profile(&[effect]), &given()).expect("read");
        let bytes = done.edits[0].apply(&sources[0].bytes);
        format!(
            "{:?}\n{:?}\n{:?}\n{}",
            done.findings,
            done.summary,
            done.targets,
            String::from_utf8_lossy(&bytes)
        )
    })
}

#[test]
fn rows_walked_in_parts_are_found_as_in_one_go() {
    let plain = Kind {
        flips: false,
        winds: false,
        others: None,
    };
    let kinds = [
        plain,
        Kind {
            others: Some(2_000),
            ..plain
        },
        Kind {
            flips: true,
            ..plain
        },
        Kind {
            winds: true,
            others: Some(300),
            ..plain
        },
    ];
    for (seed, kind) in kinds.into_iter().enumerate() {
        let text = program(kind, seed as u64);
        for effect in [PLAIN, BACKLASH] {
            let one = found(effect, &text, 1);
            for processors in [2, 5] {
                let several = found(effect, &text, processors);
                let first = one.lines().zip(several.lines()).find(|(a, b)| a != b);
                let shown = first.map(|(a, b)| {
                    let at = a.bytes().zip(b.bytes()).take_while(|(a, b)| a == b).count();
                    let part = |text: &str| {
                        text.chars()
                            .skip(at.saturating_sub(200))
                            .take(400)
                            .collect::<String>()
                    };
                    (part(a), part(b))
                });
                assert!(one == several, "{kind:?} {effect} {processors}: {shown:?}");
            }
        }
    }
}
