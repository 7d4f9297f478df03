//! What one move does, and what of it a person should look at.

mod encounter;
mod joints;

use super::deviation::{self, PathError, Wanted};
use super::walk::{Arms, Walk};
use super::{MoveReport, Options, Subject, limits, nominal};
use crate::compensate::MOST_SHIFT;
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Separation, norm, scale, sub};
use crate::model::Conditions;
use crate::motion::leg::{Leg, Piece};
use crate::motion::plausibility::OUT_OF_BOUNDS;
use crate::motion::setting::agrees;
use crate::program::Motion;
use crate::program::script::short;

/// What every move is judged with.
pub(super) struct Job<'a> {
    pub subject: &'a Subject<'a>,
    pub options: &'a Options,
    pub walk: &'a Walk,
    pub original: Option<&'a Walk>,
    /// For each move, the part of the original's move that it is.
    pub parts: Option<&'a [Option<nominal::Part>]>,
}

impl Job<'_> {
    /// What the move does, and what a person should look at.
    pub(super) fn judge(&self, index: usize) -> (Option<MoveReport>, Vec<Finding>) {
        let mut findings = Vec::new();
        let motion = self.walk.motion(index);
        let Some(stop) = self.walk.stops.all[index] else {
            return (None, findings);
        };
        if motion.motion == Motion::ArcVia {
            return (None, findings);
        }
        let arms = self.walk.arms(&stop);
        let source = &self.subject.sources[motion.file as usize];
        let part = self.parts.and_then(|parts| parts[index]);
        let wanted_end = match (self.original, part) {
            (Some(original), Some(part)) => part.end_pose(original, self.options),
            _ => *self.walk.stops.wanted(&stop),
        };
        let conditions = self.walk.conditions(&stop);
        let landed = arms.plain.real.forward(&stop.q, &conditions);
        let mut report = MoveReport {
            motion: self.walk.index(index),
            stop: short(index),
            line: short(source.line_column(motion.offset as usize).0),
            target_error: landed.separation(&wanted_end),
            uncertainty_m: arms.spread.as_ref().map(|spread| {
                let by = sub(landed.translation, wanted_end.translation);
                let long = norm(by);
                let direction = (long > 1e-9).then(|| scale(long.recip(), by));
                spread.sigma_m(&stop.q, &conditions, direction)
            }),
            path: None,
            clearance: None,
            least_room: None,
            nominal_clearance_m: None,
            limits: None,
        };
        let arriving = self.walk.leg(index, self.options.turning);
        let comes = arriving.is_some();
        let leg = arriving.unwrap_or_else(|| self.walk.standing(index, &stop));
        let pieces = leg.pieces();
        if comes {
            let path = self.path_error(&leg, &pieces, arms, index);
            report.path = Some(PathError {
                certified: path.certified && self.walk.is_followed(index),
                ..path
            });
        }
        // where it is unknown how the robot comes there, at the target alone
        let speed = self.walk.program.speed_zone(motion).speed_m_s;
        let rotation = self.subject.language.rotation_speed_rad_s();
        let asked = limits::asked(&leg, &pieces, speed, rotation);
        self.judge_limits(index, &leg, &stop, &asked, &mut findings);
        report.limits = Some(asked.limits);
        let scene = self.subject.scene;
        if !scene.is_empty() && scene.is_known(&leg) {
            self.judge_collisions(
                index,
                (&leg, &pieces),
                arms,
                !comes,
                &mut report,
                &mut findings,
            );
        }
        if let Some(clearance) = &mut report.clearance {
            clearance.certified &= self.walk.is_followed(index);
        }
        self.judge_path(index, &report, &mut findings);
        let elsewhere = self.is_another(index, &report);
        findings.extend(elsewhere.or_else(|| self.goes_elsewhere(index, &report)));
        findings.extend(self.has_another_tool(index));
        findings.extend(self.stands_elsewhere(index));
        findings.extend(self.not_finite(index, &landed, &report));
        (Some(report), findings)
    }

    fn path_error(&self, leg: &Leg, pieces: &[Piece], arms: &Arms, index: usize) -> PathError {
        let part = self.parts.and_then(|parts| parts[index]);
        if let (Some(original), Some(part)) = (self.original, part)
            && let Some(wanted) = original.leg(part.stop, self.options.turning)
        {
            let stop = original.stops.all[part.stop].expect("a leg ends at a stop");
            let of_original = original.arms(&stop);
            let wanted = Wanted {
                leg: &wanted,
                from: part.from,
                to: part.to,
                controller: &of_original.plain.controller,
                controller_jet: &of_original.jets.controller,
                own: false,
            };
            return deviation::path_error(leg, pieces, &wanted, &arms.plain, &arms.jets);
        }
        let wanted = Wanted {
            leg,
            from: 0.0,
            to: 1.0,
            controller: &arms.plain.controller,
            controller_jet: &arms.jets.controller,
            own: true,
        };
        deviation::path_error(leg, pieces, &wanted, &arms.plain, &arms.jets)
    }

    /// That a move ends farther from where the original has it than corrections go.
    fn is_another(&self, index: usize, report: &MoveReport) -> Option<Finding> {
        let (off, most) = (&report.target_error, MOST_SHIFT);
        let is_far = off.distance_m > most.distance_m || off.angle_rad > most.angle_rad;
        self.original.filter(|_| is_far)?;
        let message = format!(
            "the real tool ends {:.3} mm and {:.3} deg from where the original program wants it; no \
             correction goes farther than {:.0} mm and {:.0} deg",
            mm_from_m(off.distance_m),
            off.angle_rad / DEG,
            mm_from_m(most.distance_m),
            most.angle_rad / DEG
        );
        Some(self.subject.finding(
            self.walk.motion(index),
            "target-elsewhere",
            Severity::Warning,
            message,
            "is --nominal the original of this program, and was the part moved (--work-offset)? \
             compensate the original again",
        ))
    }

    /// That a move goes to where the original has it by another path: joints rotate the other way, or
    /// the arm stands otherwise.
    fn goes_elsewhere(&self, index: usize, report: &MoveReport) -> Option<Finding> {
        let (off, most) = (report.path.as_ref()?.sampled, MOST_SHIFT);
        let is_far = off.distance_m > most.distance_m || off.angle_rad > most.angle_rad;
        self.original.filter(|_| is_far)?;
        let message = format!(
            "on its path the real tool is up to {:.3} mm and {:.3} deg from where the original program wants it, though \
             it ends there: joints rotate the other way, or the arm stands otherwise",
            mm_from_m(off.distance_m),
            off.angle_rad / DEG
        );
        Some(self.subject.finding(
            self.walk.motion(index),
            "path-elsewhere",
            Severity::Warning,
            message,
            "look at the joints of both moves; configuration data, or a target between, say which way it goes",
        ))
    }

    /// That a move has another tool than in the original: that tool comes to where the other one is
    /// wanted.
    fn has_another_tool(&self, index: usize) -> Option<Finding> {
        let (original, part) = (self.original?, self.parts?[index]?);
        let of = |walk: &Walk, at: usize| {
            let stop = walk.stops.all[at]?;
            let tool = &walk.program.tools[walk.motion(at).tool];
            let controller = &walk.equipped(&stop).controller;
            // where the same joints have the tool
            let at_zero = controller.forward(&[0.0; 6], &Conditions::default());
            Some((tool.name.clone(), at_zero))
        };
        let ((ours, here), (theirs, there)) = of(self.walk, index).zip(of(original, part.stop))?;
        if agrees(&here, &there) {
            return None;
        }
        let message = if ours.eq_ignore_ascii_case(&theirs) {
            format!("tool `{ours}` has other numbers than in the original program")
        } else {
            format!("this move has tool `{ours}`, and tool `{theirs}` in the original program")
        };
        Some(self.subject.finding(
            self.walk.motion(index),
            "tool-not-original",
            Severity::Error,
            format!("{message}: another tool comes to where that one is wanted"),
            "is --nominal the original of this program? compensate the original again",
        ))
    }

    /// That an external axis stands elsewhere than in the original: what is wanted is wanted with the
    /// axis there.
    fn stands_elsewhere(&self, index: usize) -> Option<Finding> {
        let (original, part) = (self.original?, self.parts?[index]?);
        if part.to < 1.0 {
            // a target between those of the original
            return None;
        }
        let ours = self.walk.program.stands_at(self.walk.index(index));
        let theirs = original.program.stands_at(original.index(part.stop));
        let each = self.subject.profile.external.listed();
        let all = each.zip(ours.iter().zip(theirs));
        let (axis, (here, there)) = all.into_iter().find(|(_, (here, there))| here != there)?;
        let shown = |value: &Option<f64>| match (value, axis.is_linear()) {
            (None, _) => "at a place that nobody knows".to_owned(),
            (Some(value), true) => format!("at {:.4} mm", mm_from_m(*value)),
            (Some(value), false) => format!("at {:.5} deg", value / DEG),
        };
        let message = format!(
            "external axis {} stands {} at the end of this move, and {} in the original program: what that one wants is \
             wanted with the axis there",
            axis.name(),
            shown(here),
            shown(there)
        );
        Some(self.subject.finding(
            self.walk.motion(index),
            "external-not-original",
            Severity::Error,
            message,
            "is --nominal the original of this program? compensate the original again",
        ))
    }

    /// What is no finite number is neither near nor far.
    fn not_finite(&self, index: usize, landed: &Pose, report: &MoveReport) -> Option<Finding> {
        let is_finite = |gap: &Separation| gap.distance_m.is_finite() && gap.angle_rad.is_finite();
        let what = if !landed.is_finite() || !is_finite(&report.target_error) {
            "where the real tool arrives"
        } else if report.path.is_some_and(|path| !is_finite(&path.bound)) {
            "the error of the real tool's path"
        } else if (report.clearance.as_ref()).is_some_and(|near| near.clearance_m.is_nan()) {
            "the clearance of the real arm"
        } else {
            return None;
        };
        Some(self.subject.finding(
            self.walk.motion(index),
            "not-finite",
            Severity::Error,
            format!("{what} is not a finite number"),
            OUT_OF_BOUNDS,
        ))
    }

    /// Of a move that begins nobody knows where its end alone is known.
    fn judge_known_end(&self, index: usize, report: &MoveReport, findings: &mut Vec<Finding>) {
        let missed_m = report.target_error.distance_m;
        let limit = self.options.max_path_error_m;
        if let Some(limit) = limit.filter(|limit| missed_m > *limit) {
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "path-error",
                Severity::Error,
                format!(
                    "the real tool ends {:.3} mm from the wanted target (limit {:.3} mm; where the \
                     move begins nobody knows)",
                    mm_from_m(missed_m),
                    mm_from_m(limit)
                ),
                "compensate the program",
            ));
        }
    }

    fn judge_path(&self, index: usize, report: &MoveReport, findings: &mut Vec<Finding>) {
        let Some(path) = &report.path else {
            self.judge_known_end(index, report, findings);
            return;
        };
        if !path.certified {
            let motion = self.walk.motion(index);
            let is_spline = motion.motion == Motion::Spline;
            let leaves_the_part = self.walk.leaves_the_part(index);
            let is_free = !is_spline && !self.walk.is_followed(index);
            let message = if leaves_the_part {
                "the part moves on this path, and the tool does not go with it (no COORD, no SMOV): \
                 it was looked at as going straight, and the positioner at a constant rate meanwhile; \
                 how fast each of them goes is not known"
            } else if is_free {
                "the tool rotates on this path as the joints of the wrist do: it was looked at as \
                 if it rotated evenly from beginning to end"
            } else if is_spline {
                "the controller alone knows the curve of a spline, or of a row of arcs: its points are \
                 exact, between them straight lines were looked at"
            } else {
                "bounds between samples cannot be guaranteed here: the move passes near a \
                 singularity, external axes lean the base or begin nobody knows where, the \
                 controller's own chain is calibrated, or an effect of the profile has a kink"
            };
            let (severity, hint) = if leaves_the_part {
                (
                    Severity::Warning,
                    "move the positioner first, or coordinate the move; check the path on the robot",
                )
            } else if is_free {
                (
                    Severity::Warning,
                    "check the orientation on the way on the robot, or let the tool rotate evenly",
                )
            } else if is_spline {
                (
                    Severity::Warning,
                    "check the curve on the robot, or write straight moves",
                )
            } else {
                (Severity::Note, "only samples were looked at")
            };
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "path-uncertified",
                severity,
                message.into(),
                hint,
            ));
        }
        let Some(limit) = self.options.max_path_error_m else {
            return;
        };
        if path.bound.distance_m > limit {
            let message = format!(
                "the real tool is up to {:.3} mm from the wanted path (limit {:.3} mm; {:.3} mm at \
                 {:.0} % of the move)",
                mm_from_m(path.bound.distance_m),
                mm_from_m(limit),
                mm_from_m(path.sampled.distance_m),
                100.0 * path.at
            );
            findings.push(self.subject.finding(
                self.walk.motion(index),
                "path-error",
                Severity::Error,
                message,
                "`poseshift compensate --max-path-error` inserts targets where the path needs them",
            ));
        }
    }
}
