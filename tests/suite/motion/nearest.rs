//! Which posture a joint move without configuration data comes to: the nearest one, by the joint that
//! changes most, and where several change that one alike by the next.

use super::{PLAIN, given, profile_of};
use poseshift::compensate::compensate;
use poseshift::program::{self, Source};

/// The joints, degrees, in which the robot stands at the last target of a program.
fn at_the_end(robot: &str, name: &str, text: &str) -> [f64; 6] {
    let files = [Source::new(name, text.as_bytes().to_vec())];
    let language = program::language_of(&files[0]).expect("a language");
    let done = compensate(language, &files, &profile_of(robot, &[PLAIN]), &given());
    let done = done.expect("read");
    let last = done.targets.last().expect("targets");
    last.q.expect("solved").map(f64::to_degrees)
}

fn near(found: [f64; 6], expected: [f64; 6]) {
    let apart = (0..6).map(|i| (found[i] - expected[i]).abs());
    assert!(apart.fold(0.0, f64::max) < 1.5, "{found:?} {expected:?}");
}

/// # Source
/// Joints by another inverse, of which both elbows turn joint 1 by 110 degrees.
#[test]
fn where_the_largest_change_is_the_same_the_next_one_decides() {
    let text = "MODULE m\nPERS tooldata t:=[TRUE,[[0,0,180],[1,0,0,0]],[2.5,[0,0,60],[1,0,0,0],0,0,0]];\nPROC \
        main()\nConfJ\\Off;\nMoveAbsJ \
        [[-60,10,-100,10,60,20],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\nMoveJ \
        [[99.3062,189.6389,975.6664],[0.65611048,-0.19142564,0.47796826,0.55174415],[0,0,0,0],[9E9,9E9,9E9,\
        9E9,9E9,9E9]],v100,fine,t;\nENDPROC\nENDMODULE\n";
    let found = at_the_end("robots/abb_irb120.yaml", "m.mod", text);
    near(found, [50.0, 12.0, -101.0, 12.0, 61.0, 18.0]);
}

/// # Source
/// Joints by another inverse: 13.9 degrees from those given; on their own side of axis 1 the nearest
/// are 40.6 degrees away.
#[test]
fn the_posture_nearest_to_given_joints_may_be_on_another_branch() {
    let text = "def prog():\n  set_tcp(p[0,0,0.15,0,0,0])\n  movej([-1.643309, -1.472014, -1.435478, \
        -0.832407, 1.080642, -0.595597])\n  movej(get_inverse_kin(p[-0.0799186, -0.1690993, 1.0084645, \
        -0.2510651, 1.4112439, -2.7113842], qnear=[-1.486682, -1.122791, -1.214368, -0.381829, 1.581345, \
        -0.099070]))\nend\n";
    let found = at_the_end("robots/universal_robots_ur5.yaml", "t.script", text);
    near(found, [-71.2, -61.4, -59.3, -24.8, 84.8, -11.2]);
}
