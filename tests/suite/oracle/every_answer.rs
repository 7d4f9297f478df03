//! All answers of arms with an offset wrist against another method (`tests/data/inverse_general`).

use crate::support::{offset_wrist_arms, table};
use poseshift::geometry::wrap;
use poseshift::inverse::Arm;
use poseshift::model::{Conditions, Model};

/// The other method stops at some 1e-9, and near a fold an answer moves by the root of that.
const SAME_RAD: f64 = 1e-4;
/// Answers that one method has and the other has not, of all: pairs about to merge at a fold.
const MOST_MISSING: usize = 2;

#[test]
fn answers_are_those_of_the_general_method_and_no_others() {
    let rows = table("tests/data/inverse_general/answers.csv");
    let conditions = Conditions::default();
    let (mut poses, mut theirs, mut missing, mut extra) = (0, 0, 0, 0);
    for (name, geometry, mechanism) in offset_wrist_arms() {
        let arm = Arm::of(&geometry, &mechanism).expect("an inverse");
        let model: Model = Model::build(&geometry, &mechanism, &[], &conditions);
        let of_arm: Vec<_> = rows.iter().filter(|row| row.text("arm") == name).collect();
        for group in of_arm.chunk_by(|a, b| a.text("pose") == b.text("pose")) {
            let wanted = model.forward(&group[0].joints("q{}_deg"), &conditions);
            let found = arm.solve_all(&wanted, &[0.0; 6]);
            poses += 1;
            theirs += group.len();
            let mut matched = vec![false; found.len()];
            for row in group {
                let q = row.joints("q{}_deg");
                let gap = model.forward(&q, &conditions).separation(&wanted);
                assert!(
                    gap.distance_m < 1e-6 && gap.angle_rad < 1e-6,
                    "{name} {gap:?}"
                );
                let is_same =
                    |mine: &[f64; 6]| (0..6).all(|i| wrap(mine[i] - q[i]).abs() < SAME_RAD);
                match found.iter().position(|answer| is_same(&answer.q)) {
                    Some(index) => matched[index] = true,
                    None => missing += 1,
                }
            }
            extra += matched.iter().filter(|matched| !**matched).count();
        }
    }
    println!("{poses} poses, {theirs} answers, {missing} of them missing, {extra} more");
    assert_eq!(poses, 250);
    assert!(theirs > 7 * poses);
    assert!(missing + extra <= MOST_MISSING, "{missing} {extra}");
}
