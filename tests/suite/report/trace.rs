//! The way that a page draws, against the bounds that `check` guarantees.

use crate::check::{THESIS, profile, rapid, run};
use poseshift::check::trace::trace;
use poseshift::check::{Options, Scene, Subject, ToolRotation};
use poseshift::program::rapid::Rapid;

const MOVES: &str = "    MoveAbsJ [[0,10,-10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,artifact;
    MoveJ [[430,-200,300],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v200,fine,artifact;
    MoveL [[430,200,300],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,z10,artifact;
    MoveC [[380,0,300],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],[[430,-200,300],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;
";

/// Length of the difference of two points.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn samples_stay_within_the_bounds_and_end_where_the_moves_end() {
    let (profile, sources) = (profile(THESIS), rapid(MOVES));
    let scene = Scene::default();
    for turning in [ToolRotation::Slerp, ToolRotation::Euler] {
        let options = Options {
            turning,
            ..Options::default()
        };
        let found = run(&profile, None, &sources, None, &options);
        let subject = Subject {
            language: &Rapid,
            sources: &sources,
            nominal: None,
            profile: &profile,
            scene: &scene,
        };
        let traced = trace(&subject, &options, 1000).expect("a way");
        assert_eq!(traced.len(), found.moves.len());
        assert!(!traced[0].continues && traced[1..].iter().all(|one| one.continues));
        for (one, reported) in traced.iter().zip(&found.moves) {
            assert_eq!(
                (one.motion, one.line),
                (reported.motion, reported.line as usize)
            );
            let far = one.places.iter().map(|p| apart(p.wanted_m, p.real_m));
            let far = far.fold(0.0, f64::max);
            if let Some(path) = reported.path {
                assert_eq!(one.places.len(), 24);
                assert!(far <= path.bound.distance_m + 1e-12, "{far} {path:?}");
                assert!(far >= 0.9 * path.bound.distance_m, "{far} {path:?}");
            }
            let end = one.places.last().expect("an end");
            let miss = apart(end.wanted_m, end.real_m) - reported.target_error.distance_m;
            assert!(miss.abs() < 1e-9, "{miss}");
        }
        // what is wanted is continuous: each move's places go on from the end of the move before
        for pair in traced.windows(2) {
            let (end, next) = (pair[0].places.last().expect("an end"), pair[1].places[0]);
            assert!(apart(end.wanted_m, next.wanted_m) < 0.06);
        }
    }
}

#[test]
fn every_move_has_a_place_however_few_samples_are_asked_for() {
    let (profile, sources) = (profile(THESIS), rapid(MOVES));
    let scene = Scene::default();
    let subject = Subject {
        language: &Rapid,
        sources: &sources,
        nominal: Some(&sources),
        profile: &profile,
        scene: &scene,
    };
    let traced = trace(&subject, &Options::default(), 0).expect("a way");
    assert!(traced.iter().all(|one| one.places.len() == 1));
    assert!(traced.iter().all(|one| one.counterpart == one.motion));
}
