//! What the arms come near on a move, and how it is reported.

use super::Job;
use crate::check::MoveReport;
use crate::check::collision::{self, Clearance, Near};
use crate::check::walk::{Arms, Which};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::motion::leg::{Leg, Piece};

/// One of the two arms, and what is reported of it.
struct Reported {
    name: &'static str,
    other: &'static str,
    touches: &'static str,
    near: &'static str,
    severity: Severity,
}

const REAL: Reported = Reported {
    name: "real",
    other: "nominal",
    touches: "collision",
    near: "clearance",
    severity: Severity::Error,
};

const NOMINAL: Reported = Reported {
    name: "nominal",
    other: "real",
    touches: "nominal-collision",
    near: "nominal-clearance",
    severity: Severity::Warning,
};

impl Job<'_> {
    /// Clearances of both arms; `first` where the robot only stands at the target, as it comes from
    /// an unknown place.
    pub(super) fn judge_collisions(
        &self,
        index: usize,
        (leg, pieces): (&Leg, &[Piece]),
        arms: &Arms,
        first: bool,
        report: &mut MoveReport,
        findings: &mut Vec<Finding>,
    ) {
        let (scene, horizon) = (self.subject.scene, self.options.horizon_m);
        let found = collision::near(scene, &arms.mover(Which::Real), leg, pieces, horizon);
        report.clearance = Some(Box::new(found.nearest));
        let is_other = found.least_room.pair != found.nearest.pair;
        report.least_room = is_other.then(|| Box::new(found.least_room));
        // who comes into a body passes its surface, unless he was in it from the first
        let from_first = |start| self.walk.start(start).is_none();
        if first || self.walk.start(index).is_some_and(from_first) {
            for pair in collision::inside(scene, &arms.mover(Which::Real), leg, &leg.start) {
                report.clearance = Some(Box::new(Clearance {
                    clearance_m: 0.0,
                    sampled_m: 0.0,
                    required_m: scene.watched[pair].required_m,
                    pair: Some(pair),
                    ..found.nearest
                }));
                report.least_room = None;
                let (a, b) = scene.names_of(&scene.watched[pair]);
                let message = format!("{a} is inside {b}, or around a part of it");
                let hint = "is the cell in the robot's world frame?";
                findings.push(self.subject.finding(
                    self.walk.motion(index),
                    "collision",
                    Severity::Error,
                    message,
                    hint,
                ));
            }
        }
        if !found.nearest.certified && pieces.iter().all(|piece| piece.certified) {
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "clearance-uncertified",
                Severity::Warning,
                format!(
                    "bounds of the clearance cannot be guaranteed here: the arm moves too fast near \
                     a singularity; the nearest sample is {}",
                    match found.nearest.pair {
                        Some(_) => format!("{:.3} mm", mm_from_m(found.nearest.sampled_m)),
                        None => "beyond the horizon".to_owned(),
                    }
                ),
                "only samples were looked at: lead the path around the singularity",
            ));
        }
        let alike = arms.real_is_nominal && self.original.is_none();
        let nominal = if alike {
            Some(found)
        } else {
            self.nominal_clearance(index, leg, pieces, arms)
        };
        report.nominal_clearance_m =
            nominal.map(|near| [near.nearest.clearance_m, near.nearest.sampled_m]);
        let found = Some(found);
        findings.extend(self.encounter(index, &REAL, found.as_ref(), nominal.as_ref(), first));
        if !alike {
            findings.extend(self.encounter(
                index,
                &NOMINAL,
                nominal.as_ref(),
                found.as_ref(),
                first,
            ));
        }
    }

    /// What is reported of an arm that touches something or comes too near; nothing where it does
    /// not.
    fn encounter(
        &self,
        index: usize,
        reported: &Reported,
        found: Option<&Near>,
        other: Option<&Near>,
        first: bool,
    ) -> Option<Finding> {
        let found = found?.least_room;
        let touches = found.sampled_m <= 0.0;
        if found.clearance_m >= found.required_m && !touches {
            return None;
        }
        let scene = self.subject.scene;
        let (a, b) = scene.names_of(&scene.watched[found.pair?]);
        let joints = found.joints.map(|q| format!("{:.2}", q / DEG)).join(", ");
        let [x, y, z] = found.points[1].map(mm_from_m);
        let when = if first {
            "where it begins".to_owned()
        } else {
            format!("at {:.1} % of the move", 100.0 * found.at)
        };
        let place = format!("{when} (joints {joints} deg; point {x:.1}, {y:.1}, {z:.1} mm)");
        let comparison = compared(
            reported.other,
            found.pair,
            other.map(|near| near.least_room),
        );
        let name = reported.name;
        let (id, message) = if touches {
            let message = format!("the {name} arm's {a} touches {b} {place}{comparison}");
            (reported.touches, message)
        } else {
            let message = format!(
                "the {name} arm's {a} comes within {:.3} mm of {b}, required {:.3} mm, \
                 {place}{comparison}",
                mm_from_m(found.clearance_m),
                mm_from_m(found.required_m)
            );
            (reported.near, message)
        };
        let hint = if first {
            "this is where the program starts: is the cell in the robot's world frame?"
        } else {
            "`pairs` in the cell file allows what may touch"
        };
        Some(self.subject.finding(
            self.walk.motion(index),
            id,
            reported.severity,
            message,
            hint,
        ))
    }

    /// The arm as the simulation believes it: in the original program where there is one.
    fn nominal_clearance(
        &self,
        index: usize,
        leg: &Leg,
        pieces: &[Piece],
        arms: &Arms,
    ) -> Option<Near> {
        let (scene, horizon) = (self.subject.scene, self.options.horizon_m);
        let part = self.parts.and_then(|parts| parts[index]);
        if let (Some(original), Some(part)) = (self.original, part) {
            let stop = original.stops.all[part.stop]?;
            let arriving = original.leg(part.stop, self.options.turning);
            let leg = arriving.unwrap_or_else(|| original.standing(part.stop, &stop));
            if !scene.is_known(&leg) {
                return None;
            }
            let mover = original.arms(&stop).mover(Which::Controller);
            let pieces = leg.pieces();
            return Some(collision::near(scene, &mover, &leg, &pieces, horizon));
        }
        let mover = arms.mover(Which::Controller);
        Some(collision::near(scene, &mover, leg, pieces, horizon))
    }
}

/// What the other arm does meanwhile, by the pair of it that has the least room.
fn compared(who: &str, pair: Option<usize>, other: Option<Clearance>) -> String {
    let Some(other) = other else {
        return String::new();
    };
    let is_same = other.pair == pair;
    let by = mm_from_m(other.clearance_m);
    let keeps = other.clearance_m >= other.required_m && other.sampled_m > 0.0;
    match (keeps, other.pair) {
        (true, None) => format!("; the {who} arm stays clear"),
        (true, Some(_)) if is_same => format!("; the {who} arm stays clear by {by:.3} mm"),
        (true, Some(_)) => format!("; the {who} arm keeps what is required"),
        (false, _) if !is_same => {
            format!("; of the {who} arm another pair is nearer than required")
        }
        (false, _) if other.sampled_m <= 0.0 => format!("; so does the {who} arm"),
        (false, _) => format!("; the {who} arm comes within {by:.3} mm"),
    }
}
