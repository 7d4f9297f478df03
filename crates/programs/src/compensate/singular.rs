//! Targets so near the wrist's singularity that the real arm has no posture on the meant side:
//! joints 4 and 6 would have to turn far for nothing.
//!
//! Two alternatives, both for the user to choose: to go through (joint 5 changes its sign, the tool
//! lands), or to stay with joint 4 where it is (the tip lands, the orientation nearly).

use super::approach::Approach;
use super::{AtSingularity, Job};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::inverse::{Branch, Inverse, Outcome, Status};

/// Nearer than this to the singularity of the wrist the two alternatives are offered, radians.
const NEAR_RAD: f64 = 0.1 * DEG;
const JOINT_4: usize = 3;

/// What either of them gives, where it gives anything.
struct Answers {
    flip: Option<(Branch, Outcome)>,
    nearest: Option<Outcome>,
}

fn answers(job: &Job, approach: &Approach) -> Option<Answers> {
    let ground = &job.ground;
    let equipped = ground.arm_with(approach.tool as usize);
    let margins = equipped.arm.posture(&approach.nominal_q).1;
    if margins.wrist_rad > NEAR_RAD || ground.is_joints(approach.target as usize) {
        return None;
    }
    let inverse = Inverse {
        conditions: approach.conditions(job),
        ..equipped.inverse.clone()
    };
    let wanted = approach.wanted(job);
    let other = Branch {
        joint_5_negative: !approach.branch.joint_5_negative,
        ..approach.branch
    };
    let lands = |outcome: &Outcome| outcome.status == Status::Converged;
    let flip = inverse.solve_by(job.options.methods, &wanted, other, &approach.nominal_q);
    let nearest = inverse.solve_held(&wanted, &approach.nominal_q, JOINT_4);
    Some(Answers {
        flip: Some((other, flip)).filter(|(_, outcome)| lands(outcome)),
        nearest: Some(nearest).filter(lands),
    })
}

/// What the two alternatives would give, for the message of a target that is refused.
pub(super) fn offers(job: &Job, approach: &Approach) -> Option<String> {
    let answers = answers(job, approach)?;
    let mut offers = Vec::new();
    if let Some((_, outcome)) = &answers.flip {
        offers.push(format!(
            "--at-singularity flip: it lands with joint 5 at {:.3} deg and joint 4 turned by {:.1} \
             deg",
            outcome.q[4] / DEG,
            (outcome.q[JOINT_4] - approach.nominal_q[JOINT_4]).abs() / DEG
        ));
    }
    if let Some(outcome) = &answers.nearest {
        offers.push(format!(
            "--at-singularity nearest: the tip lands, the orientation is {:.4} deg off",
            outcome.residual.angle_rad / DEG
        ));
    }
    (!offers.is_empty()).then(|| offers.join("; "))
}

/// Takes the alternative that the user has chosen; whether it was taken anywhere.
pub(super) fn settle(
    job: &Job,
    approaches: &mut [Approach],
    outcomes: &mut [Option<Outcome>],
    findings: &mut Vec<Finding>,
) -> bool {
    let mut is_settled = false;
    if job.options.at_singularity == AtSingularity::Refuse {
        return is_settled;
    }
    for (approach, outcome) in approaches.iter_mut().zip(outcomes) {
        let Some(outcome) = outcome.as_mut().filter(|o| o.status != Status::Converged) else {
            continue;
        };
        let Some(answers) = answers(job, approach) else {
            continue;
        };
        let how = match job.options.at_singularity {
            AtSingularity::Refuse => continue,
            AtSingularity::Flip => answers.flip.map(|(branch, flipped)| {
                approach.branch = branch;
                *outcome = flipped;
                format!("joint 5 passes zero to {:.3} deg", flipped.q[4] / DEG)
            }),
            AtSingularity::Nearest => answers.nearest.map(|nearest| {
                let arm = &job.ground.arm_with(approach.tool as usize).arm;
                approach.branch = arm.posture(&nearest.q).0;
                *outcome = nearest;
                format!(
                    "joint 4 stays: {:.6} mm and {:.4} deg off its wanted pose",
                    mm_from_m(nearest.residual.distance_m),
                    nearest.residual.angle_rad / DEG
                )
            }),
        };
        if let Some(how) = how {
            is_settled = true;
            let message = format!(
                "{} is at the wrist's singularity, where the real arm has no posture on the meant \
                 side; {how}",
                job.ground.name_of(approach.target as usize)
            );
            findings.push(job.ground.at_target(
                "at-singularity",
                Severity::Warning,
                approach.target as usize,
                message,
                "check the move slowly, or move the target",
            ));
        }
    }
    is_settled
}
