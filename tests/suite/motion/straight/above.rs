//! Approaches from a point above: a target that the program displaces by a known shift, and then the
//! target itself. A joint that stands between the two comes from the side of the move before.

use super::{At, CLEAR_RATE, Case, Peer, TOLERANCE_M, faults, given, profile, robot};
use crate::physics::{Moment, tool_pose};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use poseshift::compensate::compensate;
use poseshift::finding::Severity;
use poseshift::program::{self, Source};
use rand::SeedableRng;
use std::fmt::Write;

/// Approaches.
const CASES: usize = 200;
const ABOVE_M: f64 = 0.08;

fn above(at: &At) -> At {
    At {
        position: at.position + Vector3::z() * ABOVE_M,
        ..*at
    }
}

fn rapid(cases: &[Case]) -> String {
    let mut text = "MODULE t\n".to_owned();
    for (k, Case { to, .. }) in cases.iter().enumerate() {
        let (p, r) = (to.position * 1e3, to.rotation);
        let _ = writeln!(
            text,
            "CONST robtarget p{k} := [[{:.4},{:.4},{:.4}],[{:.9},{:.9},{:.9},{:.9}],[0,0,0,0],\
             [9E9,9E9,9E9,9E9,9E9,9E9]];",
            p.x, p.y, p.z, r.w, r.i, r.j, r.k
        );
    }
    text += "PROC main()\nConfL\\Off;\n";
    for (k, case) in cases.iter().enumerate() {
        let q: Vec<String> = case
            .start
            .iter()
            .map(|q| format!("{:.9}", q.to_degrees()))
            .collect();
        let _ = writeln!(
            text,
            "MoveAbsJ [[{}],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveL \
             Offs(p{k},0,0,{}),v100,fine,tool0;\nMoveL p{k},v100,fine,tool0;",
            q.join(","),
            ABOVE_M * 1e3
        );
    }
    text + "ENDPROC\nENDMODULE\n"
}

fn targets(text: &str) -> Vec<At> {
    let lines = text.lines().filter_map(|line| line.split_once(":= [["));
    lines
        .map(|(_, numbers)| {
            let all: Vec<f64> = numbers
                .split([',', '[', ']'])
                .filter_map(|word| word.parse().ok())
                .collect();
            At {
                position: Vector3::new(all[0], all[1], all[2]) * 1e-3,
                rotation: UnitQuaternion::from_quaternion(Quaternion::new(
                    all[3], all[4], all[5], all[6],
                )),
            }
        })
        .collect()
}

#[test]
fn targets_that_are_approached_from_above_land_walked_by_an_independent_inverse() {
    let profile = profile();
    let (peer, robot, faults) = (Peer::new(), robot(), faults());
    // the sides from which joints come to the target, and the joints there
    let arrive = |from: &At, to: &At, start: &[f64; 6]| {
        let (near, on_way) = peer.walk(from, &above(to), start)?;
        let (q, rates) = peer.walk(&above(to), to, &near)?;
        let stands = |rate: &f64| rate.abs() < 1e-3;
        let is_clear = |rate: &f64| rate.abs() > CLEAR_RATE;
        let each = rates[..3].iter().zip(&on_way[..3]);
        let clear = each
            .clone()
            .all(|(rate, before)| is_clear(rate) || stands(rate) && is_clear(before));
        let direction: Vec<f64> = rates
            .iter()
            .zip(&on_way)
            .map(|(rate, before)| if stands(rate) { before } else { rate }.signum())
            .collect();
        clear.then(|| {
            (
                q,
                direction.try_into().expect("six joints"),
                stands(&rates[0]),
            )
        })
    };
    let mut random = rand::rngs::StdRng::seed_from_u64(8);
    let mut cases = Vec::with_capacity(CASES);
    while cases.len() < CASES {
        let case = Case::random(&mut random, &peer, false);
        cases.extend(case.filter(|case| arrive(&case.from, &case.to, &case.start).is_some()));
    }
    let written = rapid(&cases);
    let sources = [Source::new("t.mod", written.clone().into_bytes())];
    let language = program::language_of(&sources[0]).expect("a language");
    let options = given();
    let done = compensate(language, &sources, &profile, &options).expect("read");
    let severe = done
        .findings
        .iter()
        .filter(|f| f.severity == Severity::Error);
    // how far off the displaced points land is another matter
    assert!(
        severe
            .clone()
            .all(|f| f.id == "displacement-unknown" || f.id == "displaced-target"),
        "{:?}",
        severe.collect::<Vec<_>>()
    );
    let edited = done.edits[0].apply(&sources[0].bytes);
    let edited = String::from_utf8(edited).expect("text");
    let (wanted, fakes) = (targets(&written), targets(&edited));
    assert_eq!((wanted.len(), fakes.len()), (CASES, CASES));
    let (mut landed, mut stood) = (0, 0);
    for (at, case) in cases.iter().enumerate() {
        let Some((q, direction, stands)) = arrive(&case.from, &fakes[at], &case.start) else {
            continue;
        };
        let moment = Moment {
            direction,
            ..Moment::default()
        };
        let m = tool_pose(&robot, &faults, &q, &moment);
        let miss = (Vector3::new(m[0][3], m[1][3], m[2][3]) - wanted[at].position).norm();
        assert!(
            miss < TOLERANCE_M,
            "p{at} from {:?} goes to {:?} and is {:.4} mm off",
            case.start,
            fakes[at],
            miss * 1e3
        );
        landed += 1;
        stood += usize::from(stands);
    }
    assert!(
        landed > CASES * 9 / 10 && stood > CASES / 2,
        "{landed} {stood}"
    );
}
